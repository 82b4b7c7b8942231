//! A section of one tool that goes to another place among those of the other tools.
//!
//! Knows: where the sections of a run are in the text, which words call a tool early. Must not know: what the sections do;
//! whether each still does the same is for the proof.
//!
//! A section begins with its tool change, the comments right above it and a `T` alone that the change takes its tool from. The
//! last one ends in front of the block that ends the program.

use std::collections::{BTreeMap, BTreeSet};
use std::ops::Range;

use gcheck_controls::{Letter, LetterSet, Machine};
use gcheck_engine::{At, Event, Model, Program};
use gcheck_program::{Block, BlockFlags, Loaded, Place, Value, Word, is_comment_alone};

use crate::change::Destination;
use crate::refusal::Refusal;
use crate::scope::Scope;
use crate::sheet::Sheet;

const T: Letter = Letter::of('T');

/// The tool changes of runs. Has to see every block before it is executed, and every event.
pub(crate) struct ToolSections<'c> {
    destination: Destination,
    scope: Scope,
    model: &'c Model<'c>,
    /// The block of the program that is under way, in another file or not.
    block: Option<(u32, Range<u32>)>,
    /// The block of the change before, in this run.
    last_change: Option<u32>,
    /// By number of the block: its bytes and the tool that it changes to.
    changes: BTreeMap<u32, (Range<u32>, u32)>,
    /// The blocks in which the runs before ended.
    ends: BTreeSet<u32>,
}

/// A section of the text.
struct Section {
    tool: u32,
    bytes: Range<u32>,
}

/// A word that calls a tool while another one works.
struct EarlyCall {
    /// Index of the section that it is in.
    section: usize,
    tool: u32,
    /// Bytes of its number.
    value: Range<u32>,
}

impl<'c> ToolSections<'c> {
    pub(crate) fn new(destination: Destination, scope: &Scope, model: &'c Model<'c>) -> Self {
        Self {
            destination,
            scope: scope.clone(),
            model,
            block: None,
            last_change: None,
            changes: BTreeMap::new(),
            ends: BTreeSet::new(),
        }
    }

    pub(crate) fn begin(&mut self) {
        self.ends.extend(self.block.take().map(|(number, _)| number));
        self.last_change = None;
    }

    pub(crate) fn before(&mut self, at: At, place: &Place) {
        if at.file == 0 {
            self.block = Some((at.block, place.range()));
        }
    }

    pub(crate) fn event(&mut self, event: &Event) -> Result<(), Refusal> {
        let Event::ToolChange(tool) = event else { return Ok(()) };
        let Some((number, range)) = self.block.clone() else { return Ok(()) };
        let refuse = |reason: &str| Err(Refusal::at(range.clone(), reason));
        let Some(tool) = *tool else { return refuse("the number of this tool is not known") };
        if self.last_change.is_some_and(|last| last >= number) {
            return refuse("the tool changes do not run in the order of the text, each of them once");
        }
        self.last_change = Some(number);
        match self.changes.insert(number, (range.clone(), tool)) {
            Some((_, other)) if other != tool => refuse("this block changes to another tool each time"),
            _ => Ok(()),
        }
    }

    /// Writes the sections in their new order. The answer is what the person has to know.
    pub(crate) fn write(
        &self,
        sheet: &mut Sheet<'_, '_>,
        program: &Program<'_>,
        loaded: &Loaded<'_>,
    ) -> Result<Vec<String>, Refusal> {
        let sections = self.sections(program, loaded)?;
        let from = self.chosen(&sections)?;
        let to = self.target(&sections, from)?;
        if from == to {
            return Ok(Vec::new());
        }
        let mut order: Vec<usize> = (0..sections.len()).collect();
        let moved = order.remove(from);
        order.insert(to, moved);
        let (calls, mut notes) = self.early_calls(&sections, program, loaded);
        let rewritten = following(&sections, &order, &calls);
        self.put(sheet, &sections, from, to, &rewritten);
        notes.push(
            "the way to the first point of a section begins where the section above it ends: check that the tool clears the part there"
                .to_owned(),
        );
        Ok(notes)
    }

    /// The sections in the order of the text.
    fn sections(&self, program: &Program<'_>, loaded: &Loaded<'_>) -> Result<Vec<Section>, Refusal> {
        let mut ends = self.ends.clone();
        ends.extend(self.block.as_ref().map(|(number, _)| *number));
        let (Some(end), true) = (ends.first().copied(), ends.len() == 1) else {
            return Err(Refusal::whole("the program ends in another block when block delete is on"));
        };
        let main = loaded.flow_graph().part_of(end);
        let text = loaded.text();
        let head = |block: u32, tool: Option<u32>| head(block, tool, &main, program, loaded, &text);
        let mut starts: Vec<(u32, u32)> = Vec::new();
        for (number, (range, tool)) in &self.changes {
            if !main.contains(number) || *number >= end {
                let reason = "this block changes the tool, and it is not above the end of the program";
                return Err(Refusal::at(range.clone(), reason));
            }
            // A lathe calls the same tool again with another offset.
            if starts.last().is_none_or(|(_, last)| last != tool) {
                starts.push((head(*number, Some(*tool))?, *tool));
            }
        }
        let end = head(end, None)?;
        let ends: Vec<u32> = starts.iter().skip(1).map(|(start, _)| *start).chain([end]).collect();
        let section = |((start, tool), end): ((u32, u32), u32)| Section { tool, bytes: start..end };
        Ok(starts.into_iter().zip(ends).map(section).collect())
    }

    /// The section that somebody chose, by its tool or one of its lines.
    fn chosen(&self, sections: &[Section]) -> Result<usize, Refusal> {
        let is_chosen = |section: &&Section| match &self.scope {
            Scope::All => false,
            Scope::Bytes(lines) => {
                lines.start < section.bytes.end && section.bytes.start < lines.end.max(lines.start + 1)
            }
            Scope::Tool(tool) => section.tool == *tool,
        };
        let help = "name a tool with --tool, or a line of its section with --lines";
        match sections.iter().filter(is_chosen).count() {
            1 => Ok(sections.iter().position(|section| is_chosen(&section)).unwrap_or(0)),
            0 if self.scope == Scope::All => Err(Refusal::whole("one section moves at a time").help(help)),
            0 => Err(Refusal::whole("these lines are not in the section of a tool").help(help)),
            _ => Err(Refusal::whole("more than one section is chosen")
                .help("choose a line of one of them with --lines")),
        }
    }

    /// The place of the chosen section among all of them when it has moved.
    fn target(&self, sections: &[Section], from: usize) -> Result<usize, Refusal> {
        let missing = |tool: u32| Refusal::whole(format!("no other section of the program uses T{tool}"));
        let is = |tool: u32| move |(at, section): &(usize, &Section)| *at != from && section.tool == tool;
        let mut others = sections.iter().enumerate();
        match self.destination {
            Destination::Up if from == 0 => Err(Refusal::whole("it is the first section already")),
            Destination::Up => Ok(from - 1),
            Destination::Down if from + 1 == sections.len() => {
                Err(Refusal::whole("it is the last section already"))
            }
            Destination::Down => Ok(from + 1),
            Destination::Before(tool) => {
                let (at, _) = others.find(is(tool)).ok_or_else(|| missing(tool))?;
                Ok(if at > from { at - 1 } else { at })
            }
            Destination::After(tool) => {
                let (at, _) = others.rfind(is(tool)).ok_or_else(|| missing(tool))?;
                Ok(if at > from { at } else { at + 1 })
            }
        }
    }

    /// The words that call the tool of the next section early, where all of them do; else a note that they stay.
    fn early_calls(
        &self,
        sections: &[Section],
        program: &Program<'_>,
        loaded: &Loaded<'_>,
    ) -> (Vec<EarlyCall>, Vec<String>) {
        if self.model.control().machine() == Machine::Lathe {
            return (Vec::new(), Vec::new());
        }
        let mut calls: Vec<EarlyCall> = Vec::new();
        let (first, last) = (self.changes.keys().next(), loaded.flow_graph().blocks());
        for number in first.copied().unwrap_or(last)..last {
            let Some(place) = loaded.place(number, program.dialect()) else { continue };
            let start = place.range().start;
            let Some(section) = sections.iter().position(|section| section.bytes.contains(&start)) else {
                continue;
            };
            let words = place.table.words(place.block());
            let Some(word) = words.iter().find(|word| word.letter == T) else { continue };
            let own = sections.get(section).map(|section| section.tool);
            let tool = number_of(word);
            if self.changes.contains_key(&number) || tool == own {
                continue;
            }
            let Some(tool) = tool else { return (Vec::new(), vec![stays()]) };
            calls.retain(|call| call.section != section);
            let value = Sheet::range(&place, word);
            let digits = loaded.slice(value.clone()).trim_start_matches(|c: char| !c.is_ascii_digit());
            calls.push(EarlyCall { section, tool, value: value.end - digits.len() as u32..value.end });
        }
        let next = |section: usize| sections.get(section + 1).or(sections.first());
        let calls_next = |call: &EarlyCall| next(call.section).is_some_and(|next| next.tool == call.tool);
        if calls.iter().all(calls_next) { (calls, Vec::new()) } else { (Vec::new(), vec![stays()]) }
    }

    /// Moves the text of a section, with the words that are to be written otherwise.
    fn put(
        &self,
        sheet: &mut Sheet<'_, '_>,
        sections: &[Section],
        from: usize,
        to: usize,
        words: &[(Range<u32>, String)],
    ) {
        let (Some(moved), Some(target)) = (sections.get(from), sections.get(to)) else { return };
        let range = moved.bytes.start as usize..moved.bytes.end as usize;
        let mut text = sheet.loaded.text().get(range).unwrap_or_default().to_owned();
        for (range, word) in words.iter().rev() {
            if moved.bytes.contains(&range.start) {
                let at = (range.start - moved.bytes.start) as usize;
                text.replace_range(at..at + range.len(), word);
            } else {
                sheet.replace(range.clone(), word.clone());
            }
        }
        sheet.remove(moved.bytes.clone());
        sheet.insert(if to > from { target.bytes.end } else { target.bytes.start }, text);
    }
}

fn stays() -> String {
    "`T` words that call a tool early stay as they are: they do not all name the tool of the next section"
        .to_owned()
}

/// The number of a tool as a word gives it.
fn number_of(word: &Word) -> Option<u32> {
    match word.value {
        #[expect(clippy::cast_sign_loss, reason = "checked")]
        Value::Number(number) if number >= 0.0 && number.fract() == 0.0 => Some(number as u32),
        _ => None,
    }
}

/// The first byte of what belongs to a block that changes the tool, or ends the program: its line, a line that names the tool
/// alone, and comments and numbers of blocks above it, as far as nothing else is between.
fn head(
    block: u32,
    tool: Option<u32>,
    main: &Range<u32>,
    program: &Program<'_>,
    loaded: &Loaded<'_>,
    text: &str,
) -> Result<u32, Refusal> {
    let place_of = |number: u32| loaded.place(number, program.dialect());
    let Some(own) = place_of(block) else { return Err(Refusal::whole("a tool change is not in the text")) };
    let mut start = own.range().start;
    let mut headings = Vec::new();
    let mut reaches_top = true;
    for number in (main.start..block).rev() {
        let Some(place) = place_of(number) else { continue };
        let block = place.block();
        if is_comment_alone(block) || is_number_alone(block) {
            headings.push(place.range().start);
        } else if headings.is_empty() && calls_alone(&place, tool) {
            start = place.range().start;
        } else if !block.letters.is_empty() || block.flags.intersects(STATED) {
            reaches_top = block.flags.contains(BlockFlags::PROGRAM_NUMBER);
            break;
        }
    }
    // The comments at the top of a program are about all of it, but for the last one.
    let of_section = if reaches_top { headings.first() } else { headings.last() };
    let start = of_section.copied().unwrap_or(start);
    let before = text.get(..start as usize).unwrap_or_default();
    let line = before.rfind(['\n', '\r']).map_or(0, |end| end + 1);
    if before.get(line..).unwrap_or_default().trim().is_empty() {
        Ok(line as u32)
    } else {
        Err(Refusal::at(own.range(), "this block shares its line with another one"))
    }
}

const STATED: BlockFlags = BlockFlags::STATEMENT.union(BlockFlags::TAPE_MARK).union(BlockFlags::ERROR);

/// Does a block have nothing but its number?
fn is_number_alone(block: &Block) -> bool {
    !block.letters.is_empty()
        && block.letters.without(LetterSet::of("N")).is_empty()
        && !block.flags.intersects(STATED)
}

/// Does a block name the tool, and nothing else but its own number?
fn calls_alone(place: &Place, tool: Option<u32>) -> bool {
    let block = place.block();
    let words = place.table.words(block);
    tool.is_some()
        && block.letters.without(LetterSet::of("NT")).is_empty()
        && !block.flags.intersects(STATED)
        && words.iter().any(|word| word.letter == T && number_of(word) == tool)
}

/// What the early calls become in another order: each names the tool of the section that follows its own.
fn following(sections: &[Section], order: &[usize], calls: &[EarlyCall]) -> Vec<(Range<u32>, String)> {
    let next = |section: usize| {
        let place = order.iter().position(|at| *at == section)?;
        let next = order.get(place + 1).or(order.first())?;
        sections.get(*next)
    };
    let word = |call: &EarlyCall| {
        let digits = call.value.len();
        Some((call.value.clone(), format!("{:0digits$}", next(call.section)?.tool)))
    };
    calls.iter().filter_map(word).collect()
}
