//! The blocks of a program between two tools: which belong to the tool before, and which to the one after.
//!
//! Knows: headings, retracts, what changes nothing but modes. Must not know: where a section goes.
//!
//! A section begins with its heading: the comments and block numbers nearest above its tool change, as far as nothing is
//! between that cuts or goes to a point of the part. Without a heading it begins with its tool change, or with the `T` alone
//! that names the tool for it.

use std::collections::BTreeSet;
use std::ops::Range;

use gcheck_controls::{Effect, Letter, LetterSet};
use gcheck_engine::{Model, Program};
use gcheck_program::{Block, BlockFlags, FileIndex, Loaded, Place, Value, Word, is_comment_alone};

use crate::refusal::Refusal;

const N: Letter = Letter::of('N');
const T: Letter = Letter::of('T');
const STATED: BlockFlags = BlockFlags::STATEMENT.union(BlockFlags::TAPE_MARK).union(BlockFlags::ERROR);

/// A section of the text.
pub(crate) struct Section {
    pub(crate) tool: u32,
    pub(crate) bytes: Range<u32>,
}

/// The blocks of the main program, down to the one that ends it.
pub(crate) struct Lines<'l, 'p> {
    pub(crate) loaded: &'l Loaded<'p>,
    pub(crate) model: &'l Model<'l>,
    /// Jumps, loops and O-words of the file.
    pub(crate) index: FileIndex,
    text: String,
    /// Number of the first block.
    first: u32,
    pub(crate) blocks: Vec<Line>,
    /// The last block ends the program, and stays where it is.
    is_ended: bool,
    /// A number of a block heads what follows; not where most blocks have one.
    heads: bool,
}

/// What a block is between two sections.
pub(crate) struct Line {
    pub(crate) place: Place,
    pub(crate) start: u32,
    kind: Kind,
    /// It goes to a place of the machine, such as that of a tool change.
    goes_home: bool,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Kind {
    /// The number of the program, a statement, a mark of the tape.
    Border,
    /// A comment or a block number, and nothing else.
    Heading,
    /// Nothing at all.
    Blank,
    /// A tool is named, and nothing else is.
    Call(u32),
    /// Modes, commands, places of the machine: nothing of the part.
    Neutral,
    /// Moves to points of the part.
    Work,
}

impl<'l, 'p> Lines<'l, 'p> {
    /// `end` is the block in which a run ended.
    pub(crate) fn new(end: u32, program: &Program<'_>, loaded: &'l Loaded<'p>, model: &'l Model<'l>) -> Self {
        let main = loaded.flow_graph().part_of(end);
        let place = |number| loaded.place(number, program.dialect());
        let numbered = |number: &u32| place(*number).is_some_and(|place| place.block().letters.contains(N));
        let all = main.start..(end + 1).min(main.end);
        // Where most blocks have a number, it heads nothing.
        let heads = (all.clone().filter(numbered).count() * 4) < all.len();
        let blocks: Vec<Line> =
            all.clone().filter_map(place).map(|place| line(place, model, heads)).collect();
        let ends = |line: &Line| {
            let words = line.place.table.words(line.place.block());
            words.iter().any(|word| model.effect(word.code).leaves_program())
        };
        let is_ended = blocks.last().is_some_and(ends);
        let index = loaded.file_index(program.dialect());
        Self {
            loaded,
            model,
            index,
            text: loaded.text().into_owned(),
            first: main.start,
            blocks,
            is_ended,
            heads,
        }
    }

    /// The place of a block among these; none for another program, and for the end.
    pub(crate) fn index(&self, number: u32) -> Option<usize> {
        let index = number.checked_sub(self.first)? as usize;
        let is_there = index + usize::from(self.is_ended) < self.blocks.len();
        is_there.then_some(index)
    }

    /// Where the section of a tool begins that a block changes to.
    ///
    /// # Errors
    /// The section does not name its tool itself.
    pub(crate) fn head(&self, change: usize, tool: u32, range: &Range<u32>) -> Result<usize, Refusal> {
        let Some(own) = self.blocks.get(change) else { return Ok(change) };
        let words = own.place.table.words(own.place.block());
        let mut is_named = words.iter().any(|word| word.letter == T && number_of(word).is_some());
        let mut has_heading = self.is_headed(own);
        let (mut start, mut named) = (change, change);
        for (index, line) in self.blocks.iter().enumerate().take(change).rev() {
            match line.kind {
                Kind::Blank => {}
                Kind::Call(called) if called == tool && !is_named => {
                    (start, named, is_named) = (index, index, true);
                    has_heading |= self.is_headed(line);
                }
                Kind::Heading => (start, has_heading) = (index, true),
                Kind::Neutral if !has_heading => {}
                Kind::Neutral | Kind::Border | Kind::Call(_) | Kind::Work => break,
            }
        }
        if !is_named {
            let reason =
                format!("the section does not name its tool: T{tool} is called in the section above it");
            return Err(Refusal::at(range.clone(), reason).help(format!("write `T{tool}` in this block")));
        }
        let mut above = self.blocks.get(..start).unwrap_or_default().iter().rev().map(|line| line.kind);
        let is_top = above.find(|kind| *kind != Kind::Blank).is_none_or(|kind| kind == Kind::Border);
        // Comments at the top of a program are about all of it.
        Ok(if is_top { named } else { start })
    }

    /// Does a block with a tool begin a section by its number or comment as well?
    fn is_headed(&self, line: &Line) -> bool {
        let block = line.place.block();
        block.flags.contains(BlockFlags::COMMENT) || self.heads && block.letters.contains(N)
    }

    /// The number of the block that holds a byte.
    pub(crate) fn block_at(&self, at: u32) -> Option<u32> {
        let index = self.blocks.partition_point(|line| line.start <= at).checked_sub(1)?;
        let line = self.blocks.get(index)?;
        (at < line.place.range().end).then_some(self.first + index as u32)
    }

    /// The first byte of a block.
    pub(crate) fn start_of(&self, number: u32) -> Option<u32> {
        self.blocks.get(number.checked_sub(self.first)? as usize).map(|line| line.start)
    }

    /// Where the last section ends, and a note about its last lines.
    ///
    /// It ends with its last move, or with the last line that other sections end with as well. What is after that closes the
    /// program.
    pub(crate) fn last_section(&self, starts: &[(usize, u32)]) -> (usize, Option<String>) {
        let end = self.blocks.len() - usize::from(self.is_ended);
        let lines = |range: Range<usize>| self.blocks.iter().enumerate().take(range.end).skip(range.start);
        let tail = |range: Range<usize>| {
            let is_work = |line: &Line| matches!(line.kind, Kind::Work | Kind::Call(_));
            let work = lines(range.clone()).rfind(|(_, line)| is_work(line));
            work.map_or(range.start, |(index, _)| index + 1)..range.end
        };
        let Some((last, tool)) = starts.last() else { return (end, None) };
        let mut usual = BTreeSet::new();
        for ((start, _), (next, _)) in starts.iter().zip(starts.iter().skip(1)) {
            usual.extend(lines(tail(*start..*next)).map(|(_, line)| self.words(line)));
        }
        let own = tail(*last..end);
        let after = |is_last: &dyn Fn(&Line) -> bool| {
            lines(own.clone()).rfind(|(_, line)| is_last(line)).map_or(own.start, |(index, _)| index + 1)
        };
        let usual_end = after(&|line| line.kind != Kind::Blank && usual.contains(&self.words(line)));
        let end = after(&|line| line.goes_home).max(usual_end);
        let mut unusual = lines(usual_end..end).filter(|(_, line)| line.kind != Kind::Blank);
        let first = unusual.next().map(|(_, line)| self.loaded.line_number(line.start));
        let last = unusual.next_back().map(|(_, line)| self.loaded.line_number(line.start));
        let note = first.map(|first| {
            let (lines, goes, they) = match last {
                Some(last) => (format!("lines {first} to {last}"), "go", "them by hand if they close"),
                None => (format!("line {first}"), "goes", "it by hand if it closes"),
            };
            format!("{lines} of the program before the change {goes} with T{tool}: move {they} the program")
        });
        (end, note)
    }

    /// The words of a block without its number.
    fn words(&self, line: &Line) -> String {
        let words = line.place.table.words(line.place.block()).iter();
        let words = words.filter(|word| word.letter != N);
        let range = |word: &Word| line.place.base + word.range().start..line.place.base + word.range().end;
        words.map(|word| self.loaded.slice(range(word)).to_ascii_uppercase()).collect()
    }

    /// The first byte of the line of a block; the end of the last line for the one after all.
    ///
    /// # Errors
    /// Another block is in front of it on its line, or the last line has no end.
    pub(crate) fn start_of_line(&self, index: usize) -> Result<u32, Refusal> {
        let Some(line) = self.blocks.get(index) else {
            let end = self.blocks.last().map_or(0, |line| line.place.range().end);
            let rest = self.text.get(end as usize..).unwrap_or_default();
            let Some(at) = rest.find(['\n', '\r']) else {
                return Err(Refusal::at(end..end, "the last line of the program has no line end"));
            };
            let len = if rest.get(at..).is_some_and(|rest| rest.starts_with("\r\n")) { 2 } else { 1 };
            return Ok(end + (at + len) as u32);
        };
        let before = self.text.get(..line.start as usize).unwrap_or_default();
        // A byte order mark stays at the top of the file.
        let top = if self.text.starts_with('\u{feff}') { '\u{feff}'.len_utf8() } else { 0 };
        let start = before.rfind(['\n', '\r']).map_or(top, |end| end + 1);
        if before.get(start..).unwrap_or_default().trim().is_empty() {
            Ok(start as u32)
        } else {
            Err(Refusal::at(line.place.range(), "this block shares its line with another one"))
        }
    }
}

fn line(place: Place, model: &Model<'_>, numbers_head: bool) -> Line {
    let block = place.block();
    let words = place.table.words(block);
    let effects = || words.iter().map(|word| model.effect(word.code));
    let goes_home = effects().any(Effect::goes_to_machine_place);
    let only = |letters: LetterSet| block.letters.without(letters).is_empty();
    let call = words.iter().find(|word| word.letter == T).and_then(number_of);
    let kind = if block.flags.intersects(STATED.union(BlockFlags::PROGRAM_NUMBER)) {
        Kind::Border
    } else if is_comment_alone(block) || numbers_head && is_number_alone(block) {
        Kind::Heading
    } else if block.letters.is_empty() {
        Kind::Blank
    } else if let (Some(tool), true) = (call, only(LetterSet::of("NT"))) {
        Kind::Call(tool)
    } else if call.is_some() || !goes_home && block.letters.intersects(model.control().axes()) {
        Kind::Work
    } else if numbers_head && block.letters.contains(N) {
        // A number in front of the modes with which a section begins.
        Kind::Heading
    } else {
        Kind::Neutral
    };
    Line { start: place.range().start, kind, goes_home, place }
}

/// Does a block have nothing but its number?
fn is_number_alone(block: &Block) -> bool {
    !block.letters.is_empty() && block.letters.without(LetterSet::of("N")).is_empty()
}

/// The number of a tool as a word gives it.
pub(crate) fn number_of(word: &Word) -> Option<u32> {
    match word.value {
        #[expect(clippy::cast_sign_loss, reason = "checked")]
        Value::Number(number) if number >= 0.0 && number.fract() == 0.0 => Some(number as u32),
        _ => None,
    }
}
