//! How a program falls into sections: programs, tool sections, operations, comments.
//!
//! Knows: what begins and ends a part. Must not know: which feature shows it.

use std::ops::Range;

use gcheck_controls::{Effect, Letter, LetterSet};
use gcheck_db::Snapshot;
use gcheck_program::{
    Block, BlockFlags, BlockTable, Heading, Headings, ToolNames, Word, is_comment_alone, is_name, remark,
};

use crate::remarks::is_directive;
use crate::symbols::{code_end, program_around};

/// Operations of a file that are kept: a program with a comment at every line has none that matters.
const MOST_OPERATIONS: usize = 5_000;

/// What one tool does: from its change, with the comments above it, to the next.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct ToolSection {
    /// The tool; `None` when its number is computed or was never said.
    pub(crate) tool: Option<u32>,
    pub(crate) range: Range<u32>,
    /// Bytes of the block that changes the tool.
    pub(crate) change: Range<u32>,
    /// Bytes of the word that names it, or of the change.
    pub(crate) word: Range<u32>,
    /// The block that changes the tool names it too.
    pub(crate) is_named: bool,
    /// What the program calls it; may be empty.
    pub(crate) name: String,
}

/// From a comment on a line of its own to the next one.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct OperationSection {
    pub(crate) name: String,
    pub(crate) range: Range<u32>,
    /// Bytes of the block with the comment.
    pub(crate) comment: Range<u32>,
}

/// The sections of a file.
#[derive(Debug, Clone, Default)]
pub(crate) struct Sections {
    pub(crate) tools: Vec<ToolSection>,
    pub(crate) operations: Vec<OperationSection>,
    /// Comments on lines of their own, those that follow each other together.
    pub(crate) comments: Vec<Range<u32>>,
}

/// Finds the sections of a file.
pub(crate) fn sections(snapshot: &Snapshot) -> Sections {
    let end = code_end(snapshot);
    let mut names = ToolNames::new(snapshot.control());
    let mut sections = find(snapshot, 0..snapshot.chunks().len(), end, Some(&mut names));
    close(snapshot, &mut sections, end);
    for part in &mut sections.tools {
        if let Some(name) = part.tool.and_then(|tool| names.get(tool)).filter(|name| !is_directive(name)) {
            name.clone_into(&mut part.name);
        }
    }
    sections
}

/// The operations and tool sections that hold an offset. Of the file no more is read than the section goes.
pub(crate) fn sections_around(snapshot: &Snapshot, offset: u32) -> Vec<Range<u32>> {
    let end = code_end(snapshot);
    let Some(own) = snapshot.chunk_at(offset).map(|chunk| chunk.index) else { return Vec::new() };
    let changes = |chunk: usize| {
        let tools = if may_change_tool(snapshot, chunk) {
            find(snapshot, chunk..chunk + 1, end, None).tools
        } else {
            Vec::new()
        };
        tools.into_iter().map(|tool| tool.change.start)
    };
    // From the change in front, with the comments above it …
    let mut first = own;
    while first > 0 && changes(first).all(|change| change > offset) {
        first -= 1;
    }
    while first > 0 && may_go_on_above(snapshot, first) {
        first -= 1;
    }
    // … to the one after, or the next program.
    let limit = program_around(snapshot, offset).end.min(end);
    let is_before = |chunk: usize| snapshot.chunk(chunk).is_some_and(|chunk| chunk.base < limit);
    let mut last = own;
    while is_before(last + 1) && changes(last).all(|change| change <= offset) {
        last += 1;
    }
    let mut sections = find(snapshot, first..last + 1, end, None);
    close(snapshot, &mut sections, end);
    let operations = sections.operations.into_iter().map(|part| part.range);
    let tools = sections.tools.into_iter().map(|part| part.range);
    operations.chain(tools).filter(|range| range.contains(&offset)).collect()
}

/// Does a chunk begin with a comment or with a tool change, so that comments at the end of the chunk in front may belong to it?
fn may_go_on_above(snapshot: &Snapshot, chunk: usize) -> bool {
    if is_plain(snapshot, chunk) {
        return false;
    }
    let Some(table) = snapshot.table(chunk) else { return false };
    let first = table.blocks().next();
    first.is_some_and(|(_, block)| is_comment_alone(block) || block.letters.intersects(CHANGES))
}

/// Finds sections among some chunks; none but the last of its kind has its end yet.
fn find(
    snapshot: &Snapshot,
    chunks: Range<usize>,
    end: u32,
    mut names: Option<&mut ToolNames<'_>>,
) -> Sections {
    let mut finder = Finder { snapshot, called: None, comments: None, sections: Sections::default() };
    let chunks = chunks.filter_map(|chunk| snapshot.chunk(chunk)).take_while(|chunk| chunk.base < end);
    for chunk in chunks {
        if is_plain(snapshot, chunk.index) {
            if !snapshot.flow_graph().blocks_of(chunk.index).is_empty() {
                finder.pass_over();
            }
            if has_words(snapshot, chunk.index)
                && let Some(names) = names.as_deref_mut()
            {
                names.pass_over();
            }
            continue;
        }
        let Some(table) = snapshot.table(chunk.index) else { continue };
        if let Some(names) = names.as_deref_mut() {
            names.look(&table, chunk.text);
        }
        for (_, block) in table.blocks() {
            if chunk.base + block.range.start >= end {
                break;
            }
            finder.block(&table, block, chunk.base, chunk.text);
        }
    }
    let Finder { comments, mut sections, .. } = finder;
    sections.comments.extend(comments);
    sections
}

/// What the program calls its tools.
pub(crate) fn tool_names(snapshot: &Snapshot) -> ToolNames<'_> {
    let end = code_end(snapshot);
    let mut names = ToolNames::new(snapshot.control());
    for chunk in snapshot.chunks().take_while(|chunk| chunk.base < end) {
        if is_plain(snapshot, chunk.index) {
            if has_words(snapshot, chunk.index) {
                names.pass_over();
            }
        } else if let Some(table) = snapshot.table(chunk.index) {
            names.look(&table, chunk.text);
        }
    }
    names
}

/// What comments on lines of their own call the blocks after them.
pub(crate) fn headings(snapshot: &Snapshot) -> Vec<Heading> {
    let end = code_end(snapshot);
    let mut headings = Headings::default();
    for chunk in snapshot.chunks().take_while(|chunk| chunk.base < end) {
        // Most chunks of a large file have no comments, and need not be read.
        let is_needed = headings.is_waiting() || !is_plain(snapshot, chunk.index);
        if let Some(table) = is_needed.then(|| snapshot.table(chunk.index)).flatten() {
            headings.look(chunk.base, &table, chunk.text);
        }
    }
    headings.into_found()
}

/// Has a chunk neither comments nor tools? Of a large file most have not, and need not be read for its sections.
fn is_plain(snapshot: &Snapshot, chunk: usize) -> bool {
    snapshot.facts(chunk).is_some_and(|facts| !facts.flags().contains(BlockFlags::COMMENT))
        && !may_change_tool(snapshot, chunk)
}

/// May a tool be called for or changed in a chunk?
fn may_change_tool(snapshot: &Snapshot, chunk: usize) -> bool {
    let Some(facts) = snapshot.facts(chunk) else { return true };
    let control = snapshot.control();
    let changes = |number| control.code(number).is_some_and(|code| code.effect() == Effect::ToolChange);
    facts.file_index().letters.contains(Letter::of('T'))
        || facts.file_index().codes.iter().any(|(number, _)| changes(*number))
}

fn has_words(snapshot: &Snapshot, chunk: usize) -> bool {
    snapshot.facts(chunk).is_none_or(|facts| !facts.file_index().letters.is_empty())
}

/// Parts end where the next one of their kind or of a larger kind begins.
fn close(snapshot: &Snapshot, sections: &mut Sections, end: u32) {
    let programs: Vec<u32> = snapshot
        .file_index()
        .programs
        .iter()
        .map(|program| line_start(snapshot, program.range.start))
        .collect();
    let next_program =
        |from: u32| programs.get(programs.partition_point(|start| *start <= from)).copied().unwrap_or(end);
    let starts: Vec<u32> = sections.tools.iter().map(|tool| tool.range.start).collect();
    for (index, tool) in sections.tools.iter_mut().enumerate() {
        let next = starts.get(index + 1).copied().unwrap_or(end);
        tool.range.end = next.min(next_program(tool.change.start)).max(tool.change.end);
    }
    // The comments above a change name the tool, not an operation of the one before.
    let tools: Vec<(u32, u32)> =
        sections.tools.iter().map(|tool| (tool.range.start, tool.change.start)).collect();
    sections.operations.retain(|operation| {
        let before = tools.partition_point(|(start, _)| *start <= operation.comment.start);
        let heading = before.checked_sub(1).and_then(|index| tools.get(index));
        heading.is_some_and(|(_, change)| operation.comment.start > *change)
    });
    sections.operations.truncate(MOST_OPERATIONS);
    let starts: Vec<u32> = sections.operations.iter().map(|operation| operation.comment.start).collect();
    for (index, operation) in sections.operations.iter_mut().enumerate() {
        let next = starts.get(index + 1).copied().unwrap_or(end);
        let tool = tools.get(tools.partition_point(|(start, _)| *start <= operation.comment.start));
        let tool = tool.map_or(end, |(start, _)| *start);
        let limit = next.min(tool).min(next_program(operation.comment.start));
        operation.range.end = limit.max(operation.comment.end);
    }
}

fn line_start(snapshot: &Snapshot, offset: u32) -> u32 {
    snapshot.line_range(snapshot.line_at(offset)).start
}

struct Finder<'s> {
    snapshot: &'s Snapshot,
    /// The tool called for last, and its word.
    called: Option<(Option<u32>, Range<u32>)>,
    /// Comments on lines of their own right before the block under way.
    comments: Option<Range<u32>>,
    sections: Sections,
}

/// Addresses that a tool change may have.
const CHANGES: LetterSet = LetterSet::of("TM");

impl Finder<'_> {
    /// Blocks without comments come between.
    fn pass_over(&mut self) {
        self.sections.comments.extend(self.comments.take());
    }

    fn block(&mut self, table: &BlockTable, block: &Block, base: u32, text: &str) {
        let range = base + block.range.start..base + block.range.end;
        if is_comment_alone(block) {
            match &mut self.comments {
                Some(comments) => comments.end = range.end,
                None => {
                    self.comments = Some(range.clone());
                    let written = text.get(block.range.start as usize..block.range.end as usize);
                    if let Some(name) = written.and_then(remark).filter(|name| is_name(name)) {
                        self.sections.operations.push(OperationSection {
                            name: name.to_owned(),
                            range: range.clone(),
                            comment: range,
                        });
                    }
                }
            }
            return;
        }
        // An empty comment, or a mark of the tape, begins nothing.
        let above = self.comments.take();
        self.sections.comments.extend(above.clone());
        if block.letters.intersects(CHANGES) {
            self.tool(table.words(block), &range, base, above);
        }
    }

    fn tool(&mut self, words: &[Word], range: &Range<u32>, base: u32, above: Option<Range<u32>>) {
        let control = self.snapshot.control();
        let rules = &control.semantics().tools;
        let effects =
            || words.iter().filter_map(|word| control.code_at(word.code)).map(gcheck_controls::Code::effect);
        // The arguments of a macro call are not tools.
        if effects().any(Effect::calls_macro) {
            return;
        }
        let word = words.iter().find(|word| word.letter == Letter::of('T'));
        if let Some(word) = word {
            let tool = word.integer().map(|tool| if rules.offset_in_t { tool / 100 } else { tool });
            self.called = Some((tool, base + word.range().start..base + word.range().end));
        }
        let changes =
            effects().any(|effect| effect == Effect::ToolChange) || word.is_some() && rules.change_by_t;
        // `T0` empties the spindle, and `T0100` only cancels the offset of the tool that is in place.
        let cancels = rules.offset_in_t
            && word.and_then(Word::integer).is_some_and(|tool| tool.is_multiple_of(100) && tool > 0);
        if !changes || cancels {
            return;
        }
        let (tool, word, is_named) = match &self.called {
            Some((tool, word)) if range.start <= word.start => (*tool, word.clone(), true),
            Some((tool, _)) => (*tool, range.clone(), false),
            None => (None, range.clone(), false),
        };
        let start = above.map_or(range.start, |above| above.start);
        self.sections.tools.push(ToolSection {
            tool,
            range: start..range.end,
            change: range.clone(),
            word,
            is_named,
            name: String::new(),
        });
    }
}
