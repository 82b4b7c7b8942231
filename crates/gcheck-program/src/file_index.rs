//! The facts of a whole file that do not depend on values: labels, jumps, calls, loops, program numbers, ends.
//!
//! Knows: block tables in order, with the offset of each chunk. Must not know: which of these facts are mistakes.

use std::collections::HashSet;
use std::ops::Range;
use std::sync::OnceLock;

use gcheck_controls::{Code, CodeIx, CodeNumber, DataOpening, Effect, Ends, Letter, LetterSet, WordKind};

use crate::block::{Block, BlockFlags, BlockIx, BlockTable, Value, Word};
use crate::lower::Dialect;
use crate::statement::{OKeyword, OLabel, StatementKind, Target};

/// The part of a file that the control reads, as bytes.
///
/// A `%` at the head of a line marks the beginning and the end of the tape. What is after the closing mark is not
/// read; a single mark closes unless nothing but remarks comes before it.
pub fn code_region(text: &str) -> Range<usize> {
    let marks: Vec<usize> =
        memchr::memchr_iter(b'%', text.as_bytes()).filter(|at| is_line_head(text, *at)).take(2).collect();
    match marks.as_slice() {
        [only] if !is_remark(text.get(..*only).unwrap_or_default()) => 0..end_of_line(text, *only),
        [_, second] => 0..end_of_line(text, *second),
        _ => 0..text.len(),
    }
}

/// Where tape marks are in a chunk: what [`code_region`] asks of it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct TapeMarks {
    /// The first two marks at the head of a line: where each line ends, in bytes of the chunk.
    line_ends: [Option<u32>; 2],
    /// Nothing but blanks and comments is before the first mark, or in the whole chunk.
    is_remark: bool,
}

impl TapeMarks {
    /// Of a chunk's text.
    pub fn new(text: &str) -> Self {
        let heads = memchr::memchr_iter(b'%', text.as_bytes()).filter(|at| is_line_head(text, *at));
        let mut line_ends = [None; 2];
        let mut first = text.len();
        for (slot, at) in line_ends.iter_mut().zip(heads) {
            first = first.min(at);
            *slot = Some(end_of_line(text, at) as u32);
        }
        Self { line_ends, is_remark: is_remark(text.get(..first).unwrap_or_default()) }
    }

    /// Where the part of a file ends that the control reads, by its chunks: the offset of each and its marks, and the length
    /// of the file.
    pub fn region_end<'t>(chunks: impl Iterator<Item = (u32, &'t Self)>, len: u32) -> u32 {
        let mut is_remark = true;
        let mut only = None;
        for (base, marks) in chunks {
            for end in marks.line_ends.into_iter().flatten() {
                if only.is_some() {
                    return base + end;
                }
                only = Some((base + end, is_remark && marks.is_remark));
            }
            is_remark &= marks.is_remark;
        }
        match only {
            Some((end, false)) => end,
            _ => len,
        }
    }
}

/// Is each line empty, or a comment from its head to its end?
fn is_remark(text: &str) -> bool {
    text.split(['\n', '\r']).all(|line| {
        let line = line.trim_matches(['\u{FEFF}', ' ', '\t', '\0']);
        line.is_empty()
            || line.starts_with(';')
            || line.starts_with('(') && line.find(')') == Some(line.len() - 1)
    })
}

fn is_line_head(text: &str, at: usize) -> bool {
    let before = text.get(..at).unwrap_or_default().trim_end_matches([' ', '\t', '\u{FEFF}']);
    before.is_empty() || before.ends_with(['\n', '\r'])
}

fn end_of_line(text: &str, at: usize) -> usize {
    at + gcheck_syntax::line_len(text.as_bytes().get(at..).unwrap_or_default())
}

/// A sequence number at the head of a block.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Label {
    /// `N`'s value.
    pub number: u32,
    /// Bytes of the file.
    pub range: Range<u32>,
}

/// An `O` number at the head of a block.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ProgramNumber {
    /// `None` when it is not a whole number.
    pub number: Option<u32>,
    /// Bytes of the file.
    pub range: Range<u32>,
}

/// A jump to a sequence number.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Jump {
    /// `None` when it is computed.
    pub target: Option<u32>,
    /// The code that jumps; [`CodeIx::NONE`] for `GOTO`.
    pub code: CodeIx,
    /// Only under a condition or block delete, or a code that does more than jump.
    pub conditional: bool,
    /// Bytes of the file: the word or statement that names the target.
    pub range: Range<u32>,
}

/// What a call names.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum CallKind {
    /// A program number.
    Program(u32),
    /// An O-word subroutine.
    OWord(OLabel),
    /// Computed.
    Unknown,
}

/// A call of another program.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Call {
    /// What is called.
    pub target: CallKind,
    /// The code that calls; [`CodeIx::NONE`] for an O-word.
    pub code: CodeIx,
    /// Bytes of the file.
    pub range: Range<u32>,
}

/// `DO n` or `END n`.
#[derive(Debug, Clone, PartialEq)]
pub struct Loop {
    /// `DO`, else `END`.
    pub begins: bool,
    /// `n`; `None` when missing or computed.
    pub number: Option<f64>,
    /// Bytes of the file.
    pub range: Range<u32>,
}

/// An O-word statement.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct OWord {
    /// The label.
    pub label: OLabel,
    /// The keyword.
    pub keyword: OKeyword,
    /// Bytes of the file.
    pub range: Range<u32>,
}

/// A code that ends a program or subprogram.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct EndMark {
    /// What ends.
    pub ends: Ends,
    /// Only under a condition or block delete.
    pub conditional: bool,
    /// The block names where to go on: a main program jumps there.
    pub jumps: bool,
    /// Bytes of the file.
    pub range: Range<u32>,
}

/// A code that relies on an earlier value of a word which no earlier block gives.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct NeverGiven {
    /// The code.
    pub code: CodeIx,
    /// The word's address.
    pub letter: Letter,
    /// Bytes of the file: the code's word.
    pub range: Range<u32>,
}

/// A code that opens lines of data which nothing ends before the next command.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct DataLeftOpen {
    /// The code.
    pub code: CodeIx,
    /// Bytes of the file: its block.
    pub block: Range<u32>,
    /// The next command, where it leads to another program: it calls one or returns to one, which may end the data.
    pub leads_elsewhere: Option<CodeIx>,
}

/// A block that matters to lines of data.
#[derive(Debug, Clone, PartialEq, Eq)]
struct DataMark {
    kind: DataMarkKind,
    /// The code that makes it so; of another command the one that leads to another program, else none.
    code: CodeIx,
    /// Bytes of the file: the block.
    block: Range<u32>,
}

impl DataMark {
    /// The same mark of a chunk that begins at this byte.
    fn moved(&self, base: u32) -> Self {
        Self { block: shift(&self.block, base), ..*self }
    }
}

/// Lines of data that nothing has ended so far.
#[derive(Debug, Clone, PartialEq, Eq)]
struct OpenData {
    /// The block that opens them.
    opened: DataMark,
    /// The rows between it and the last macro statement.
    rows: Vec<Range<u32>>,
    /// Bytes of the file: where the rows after that begin.
    from: u32,
}

/// What a block is to lines of data.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum DataMarkKind {
    /// Its code opens them: `G10 L50`.
    Opens,
    /// Its code opens them if a later block ends them: `G10 L#1`, `G10 L75`.
    MayOpen,
    /// Its code may end them: `G11`.
    MayEnd,
    /// It is a macro statement, which is executed among rows.
    Statement,
    /// It has another code, which shows that the block is a command, or begins a program.
    Command,
}

impl DataMarkKind {
    const fn may_open(self) -> bool {
        matches!(self, Self::Opens | Self::MayOpen)
    }
}

/// Everything collected from the chunks of one file.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct FileIndex {
    /// Sequence numbers in text order.
    pub labels: Vec<Label>,
    /// Program numbers in text order.
    pub programs: Vec<ProgramNumber>,
    /// Jumps in text order.
    pub jumps: Vec<Jump>,
    /// Calls in text order.
    pub calls: Vec<Call>,
    /// `DO` and `END` in text order.
    pub loops: Vec<Loop>,
    /// O-words in text order.
    pub o_words: Vec<OWord>,
    /// Program ends in text order.
    pub ends: Vec<EndMark>,
    /// Tape marks.
    pub tape_marks: Vec<Range<u32>>,
    /// Distinct codes with the place of their first use, in order of that place; unknown codes by number.
    pub codes: Vec<(CodeNumber, Range<u32>)>,
    /// Addresses used anywhere.
    pub letters: gcheck_controls::LetterSet,
    /// Lasting words in whose place another one was given.
    pub(crate) given_otherwise: gcheck_controls::LetterSet,
    /// Numbered variables that are assigned to, with the place of the first assignment.
    pub assigned: Vec<(u32, Range<u32>)>,
    /// The first block that is more than a comment or tape mark.
    pub first_block: Option<Range<u32>>,
    /// The last block that is more than a comment or tape mark.
    pub last_block: Option<Range<u32>>,
    /// The first block with lower-case letters, on a control that does not read them.
    pub lower_case: Option<Range<u32>>,
    /// Blocks with a value whose missing decimal point may change it, in text order.
    pub unpointed: Vec<Range<u32>>,
    /// Blocks with a number of more digits than the control takes, in text order.
    pub long_numbers: Vec<Range<u32>>,
    /// How many blocks with axis words are not among `unpointed`.
    pub pointed: usize,
    /// A block has a mistake in form.
    pub has_mistakes: bool,
    /// A block has a code whose number is computed (`G#1`).
    pub has_computed_codes: bool,
    /// A block with the code of a cut gives a speed above zero (`G1 X10. S500`), and does not start the spindle: lasers are
    /// switched so.
    pub has_speed_in_cuts: bool,
    /// Codes that rely on an earlier value which no block before them gives, in text order.
    pub never_given: Vec<NeverGiven>,
    /// Lines of data from the block that opens them to the next command, in text order: rows of a table. See
    /// [`FileIndex::is_data`].
    data: Vec<Range<u32>>,
    /// Blocks that matter to lines of data, for a file that this chunk is joined to.
    data_marks: Vec<DataMark>,
    /// The block that opened lines of data, if no command has come after it.
    data_opened: Option<OpenData>,
    /// Codes that opened lines of data which a command follows before any end.
    data_left_open: Vec<DataLeftOpen>,
    /// Levels of block delete that are used: bit 0 for a plain `/`.
    pub block_deletes: u16,
    /// How many blocks there are.
    pub blocks: usize,
    /// What `codes` and `assigned` hold, for the question "seen before?".
    seen: (HashSet<CodeNumber>, HashSet<u32>),
    /// See [`FileIndex::is_called_from_elsewhere`].
    is_called: Answer,
}

/// An answer that is worked out when somebody first asks. Whether somebody has, makes no two surveys differ.
#[derive(Debug, Clone, Default)]
struct Answer(OnceLock<bool>);

impl PartialEq for Answer {
    fn eq(&self, _: &Self) -> bool {
        true
    }
}

impl FileIndex {
    /// The first program of the file returns (`M99`) before it ends the job, if it does: other programs call it, and give
    /// it its variables and modes.
    pub fn is_called_from_elsewhere(&self) -> bool {
        *self.is_called.0.get_or_init(|| self.returns_first())
    }

    fn returns_first(&self) -> bool {
        let second = self.programs.get(1).map_or(u32::MAX, |second| second.range.start);
        let first = self.first_end(second);
        let any = first.or_else(|| self.ends.iter().find(|end| end.range.start < second));
        any.is_some_and(|end| end.ends == Ends::Subprogram)
    }

    /// The first end before `limit` that the first program comes to if no condition holds: not one that `GOTO` leads over.
    fn first_end(&self, limit: u32) -> Option<&EndMark> {
        // A program of jumps alone is followed for a while only.
        const FOLLOWED: usize = 32;
        // A return to a block is a jump in a program that ends the job itself.
        let ends_job = |end: &EndMark| end.ends == Ends::Program && end.range.start < limit;
        let has_job = self.ends.iter().any(ends_job);
        let mut jumps = self.jumps.iter().filter(|jump| !jump.conditional).take(FOLLOWED);
        let mut at = 0;
        loop {
            let is_ahead = |start: u32| (at..limit).contains(&start);
            let end = self
                .ends
                .iter()
                .find(|end| is_ahead(end.range.start) && !end.conditional && !(end.jumps && has_job));
            let before = end.map_or(limit, |end| end.range.start);
            let jump = jumps.find(|jump| is_ahead(jump.range.start));
            let Some(jump) = jump.filter(|jump| end.is_some() && jump.range.start < before) else {
                return end;
            };
            // A jump back, or to nowhere, leads over no end.
            let to = self.labels.iter().find(|label| {
                Some(label.number) == jump.target && (jump.range.end..limit).contains(&label.range.start)
            });
            at = to.map_or(jump.range.end, |label| label.range.start);
        }
    }

    /// Adds the next chunk; `base` is its offset in the file, `end` the end of the region that the control reads.
    pub fn add(&mut self, table: &BlockTable, base: u32, end: u32, dialect: &Dialect<'_>) {
        self.is_called = Answer::default();
        if table.flags().is_empty() && table.blocks.last().is_some_and(|last| base + last.range.start < end) {
            self.add_plain(table, base, dialect);
            return;
        }
        // Of the commands in a row, the first one of a chunk shows that lines of data are over.
        let mut may_be_data = dialect.has_data_codes();
        for (ix, block) in table.blocks() {
            if base + block.range.start >= end {
                break;
            }
            self.blocks += 1;
            if block.delete > 0 {
                self.block_deletes |= 1 << (block.delete - 1).min(15);
            }
            let is_row = self.is_data_open() && is_row(block);
            let is_pointed = block.letters.intersects(dialect.control().axes())
                && !block.flags.contains(BlockFlags::UNPOINTED);
            self.pointed += usize::from(is_pointed && !is_row);
            if block.flags.contains(BlockFlags::LONG_NUMBER) && !is_row {
                self.long_numbers.push(shift(&block.range, base));
            }
            if block.flags.contains(BlockFlags::UNPOINTED) && !is_row {
                self.unpointed.push(shift(&block.range, base));
            }
            if block.flags.contains(BlockFlags::TAPE_MARK) {
                self.tape_marks.push(shift(&block.range, base));
            }
            self.has_mistakes |= block.flags.contains(BlockFlags::ERROR);
            if block.flags.contains(BlockFlags::LOWER_CASE) {
                self.lower_case.get_or_insert(shift(&block.range, base));
            }
            if !block.letters.is_empty() || block.flags.contains(BlockFlags::STATEMENT) {
                let range = shift(&block.range, base);
                self.first_block.get_or_insert(range.clone());
                self.last_block = Some(range);
            }
            let interesting =
                BlockFlags::CODE | BlockFlags::LABEL | BlockFlags::PROGRAM_NUMBER | BlockFlags::STATEMENT;
            if block.flags.intersects(interesting) {
                self.add_block(table, ix, block, base, is_row, dialect);
                if let Some(mark) = data_mark(table, block, base, dialect)
                    && (may_be_data || mark.kind != DataMarkKind::Command)
                {
                    may_be_data = mark.kind.may_open() || mark.kind == DataMarkKind::Statement;
                    self.take_data_mark(&mark, dialect);
                    self.data_marks.push(mark);
                }
            }
            self.letters = self.letters.or(block.letters);
            self.has_speed_in_cuts = self.has_speed_in_cuts || gives_speed_in_cut(table, block, dialect);
        }
    }

    /// What one chunk holds, in bytes of the chunk; blocks that begin at `end` or after it are left out. It is to be
    /// [joined](Self::join) to others, and knows of never given words only what the chunk itself tells.
    pub fn of_chunk(table: &BlockTable, end: u32, dialect: &Dialect<'_>) -> Self {
        let mut file_index = Self::default();
        file_index.add(table, 0, end, dialect);
        file_index.seen = Default::default();
        (file_index.data, file_index.data_opened) = (Vec::new(), None);
        file_index.data_left_open = Vec::new();
        file_index
    }

    /// Opens lines of data, or ends those that are open.
    fn take_data_mark(&mut self, mark: &DataMark, dialect: &Dialect<'_>) {
        let code = |mark: &DataMark| dialect.control().code_at(mark.code);
        if mark.kind == DataMarkKind::Statement {
            if let Some(open) = &mut self.data_opened {
                open.rows.push(open.from..mark.block.start);
                open.from = mark.block.end;
            }
            return;
        }
        if let Some(OpenData { opened, mut rows, from }) = self.data_opened.take() {
            rows.push(from..mark.block.start);
            let is_ended = mark.kind == DataMarkKind::MayEnd
                && code(mark).zip(code(&opened)).is_some_and(|(end, opener)| end.ends_data_of(opener));
            if opened.kind == DataMarkKind::Opens {
                if !is_ended {
                    let leads_elsewhere = (mark.kind == DataMarkKind::Command)
                        .then_some(mark.code)
                        .filter(|code| code.is_some());
                    let DataMark { code, block, .. } = opened;
                    self.data_left_open.push(DataLeftOpen { code, block, leads_elsewhere });
                }
                self.data.extend(rows);
            } else if is_ended {
                // Only now are they known for rows, when they have been counted as blocks.
                for data in &rows {
                    drain(&mut self.labels, data, |label| label.range.start);
                    drain(&mut self.unpointed, data, |block| block.start);
                    drain(&mut self.long_numbers, data, |block| block.start);
                }
                self.data.extend(rows);
            }
        }
        if mark.kind.may_open() {
            let from = mark.block.end;
            self.data_opened = Some(OpenData { opened: mark.clone(), rows: Vec::new(), from });
        }
    }

    /// Are blocks without a code rows, as far as the file goes so far?
    fn is_data_open(&self) -> bool {
        self.data_opened.as_ref().is_some_and(|open| open.opened.kind == DataMarkKind::Opens)
    }

    /// The codes that open lines of data which nothing ends before the next command, in text order.
    pub fn data_left_open(&self) -> impl Iterator<Item = DataLeftOpen> {
        let last = self.data_opened.as_ref().filter(|_| self.is_data_open()).map(|open| DataLeftOpen {
            code: open.opened.code,
            block: open.opened.block.clone(),
            leads_elsewhere: None,
        });
        self.data_left_open.iter().cloned().chain(last)
    }

    /// Has the file lines of data?
    pub fn has_data(&self) -> bool {
        !self.data.is_empty() || self.is_data_open()
    }

    /// Is the place in lines of data? They are rows of a table, not commands, and their `N` are not labels. So are the lines
    /// after a code that may open data, if another code ends these.
    pub fn is_data(&self, at: u32) -> bool {
        let open = self.data_opened.as_ref().filter(|_| self.is_data_open());
        is_in(&self.data, at) || open.is_some_and(|open| open.from <= at || is_in(&open.rows, at))
    }

    /// Adds the next chunk by what it holds; `base` is its offset in the file.
    pub fn join(&mut self, chunk: &Self, base: u32, dialect: &Dialect<'_>) {
        self.is_called = Answer::default();
        let moved = |range: &Range<u32>| shift(range, base);
        // Up to its first command the chunk is rows and macro statements, if lines of data are open.
        let marks = &chunk.data_marks;
        let first = marks.iter().position(|mark| mark.kind != DataMarkKind::Statement).unwrap_or(marks.len());
        let (statements, commands) = marks.split_at_checked(first).unwrap_or_default();
        let first_command = commands.first().map_or(u32::MAX, |mark| mark.block.start);
        let commands_from = if self.is_data_open() { first_command } else { 0 };
        let is_statement = |range: &Range<u32>| {
            let after = statements.partition_point(|mark| mark.block.end <= range.start);
            statements.get(after).is_some_and(|mark| mark.block.contains(&range.start))
        };
        let is_command = |range: &Range<u32>| range.start >= commands_from || is_statement(range);
        let labels = chunk.labels.iter().filter(|label| is_command(&label.range));
        self.labels.extend(labels.map(|l| Label { range: moved(&l.range), ..*l }));
        self.unpointed.extend(chunk.unpointed.iter().filter(|block| is_command(block)).map(moved));
        self.long_numbers.extend(chunk.long_numbers.iter().filter(|block| is_command(block)).map(moved));
        self.programs.extend(chunk.programs.iter().map(|p| ProgramNumber { range: moved(&p.range), ..*p }));
        self.jumps.extend(chunk.jumps.iter().map(|j| Jump { range: moved(&j.range), ..*j }));
        self.calls.extend(chunk.calls.iter().map(|c| Call { range: moved(&c.range), ..c.clone() }));
        self.loops.extend(chunk.loops.iter().map(|l| Loop { range: moved(&l.range), ..*l }));
        self.o_words.extend(chunk.o_words.iter().map(|o| OWord { range: moved(&o.range), ..o.clone() }));
        self.ends.extend(chunk.ends.iter().map(|e| EndMark { range: moved(&e.range), ..*e }));
        for mark in &chunk.data_marks {
            self.take_data_mark(&mark.moved(base), dialect);
        }
        self.tape_marks.extend(chunk.tape_marks.iter().map(moved));
        for (code, range) in &chunk.codes {
            if self.seen.0.insert(*code) {
                self.codes.push((*code, moved(range)));
            }
        }
        for (variable, range) in &chunk.assigned {
            if self.seen.1.insert(*variable) {
                self.assigned.push((*variable, moved(range)));
            }
        }
        let given = self.letters;
        let is_missing = |missing: &&NeverGiven| {
            let mut lasting = dialect.lasting(missing.code).iter();
            lasting.any(|word| {
                let is_given = given.contains(word.letter) || given.intersects(word.instead);
                word.letter == missing.letter && !is_given && !self.given_otherwise.contains(word.letter)
            })
        };
        let missing = chunk.never_given.iter().filter(is_missing);
        self.never_given.extend(missing.map(|n| NeverGiven { range: moved(&n.range), ..*n }));
        if self.first_block.is_none() {
            self.first_block = chunk.first_block.as_ref().map(moved);
        }
        if let Some(last) = &chunk.last_block {
            self.last_block = Some(moved(last));
        }
        if self.lower_case.is_none() {
            self.lower_case = chunk.lower_case.as_ref().map(moved);
        }
        self.letters = self.letters.or(chunk.letters);
        self.given_otherwise = self.given_otherwise.or(chunk.given_otherwise);
        self.pointed += chunk.pointed;
        self.has_mistakes |= chunk.has_mistakes;
        self.has_computed_codes |= chunk.has_computed_codes;
        self.has_speed_in_cuts |= chunk.has_speed_in_cuts;
        self.block_deletes |= chunk.block_deletes;
        self.blocks += chunk.blocks;
    }

    /// Adds a chunk in which no block has anything but words to look at.
    fn add_plain(&mut self, table: &BlockTable, base: u32, dialect: &Dialect<'_>) {
        let axes = dialect.control().axes();
        self.blocks += table.len();
        self.pointed += table.blocks.iter().filter(|block| block.letters.intersects(axes)).count();
        self.letters = table.blocks.iter().fold(self.letters, |all, block| all.or(block.letters));
        self.has_speed_in_cuts = self.has_speed_in_cuts
            || table.blocks.iter().any(|block| gives_speed_in_cut(table, block, dialect));
        let mut with_words = table.blocks.iter().filter(|block| !block.letters.is_empty());
        if let Some(first) = with_words.next() {
            let last = with_words.next_back().unwrap_or(first);
            self.first_block.get_or_insert(shift(&first.range, base));
            self.last_block = Some(shift(&last.range, base));
        }
    }

    fn add_block(
        &mut self,
        table: &BlockTable,
        ix: BlockIx,
        block: &Block,
        base: u32,
        is_row: bool,
        dialect: &Dialect<'_>,
    ) {
        let words = table.words(block);
        // `N10 O1234` is as good a head as `O1234`.
        for (position, word) in words.iter().enumerate().take(2) {
            let is_head =
                position == 0 || words.first().is_some_and(|w| matches!(w.letter.ascii(), b'N' | b'O'));
            match word.letter {
                letter if letter == Letter::of('N') && is_head && !is_row => {
                    if let Some(number) = word.integer() {
                        self.labels.push(Label { number, range: shift(&word.range(), base) });
                    }
                }
                letter if letter == Letter::of('O') && is_head => {
                    self.programs
                        .push(ProgramNumber { number: word.integer(), range: shift(&word.range(), base) });
                }
                _ => {}
            }
        }
        if block.flags.contains(BlockFlags::CODE) {
            self.add_codes(table, ix, block, base, dialect);
        }
        for statement in table.statements(ix) {
            let range = shift(&statement.range, base);
            let constant = |expr: Option<crate::ExprIx>| expr.and_then(|e| table.constant(e));
            match &statement.kind {
                StatementKind::Goto { target } => {
                    self.jumps.push(Jump {
                        target: constant(*target).and_then(whole),
                        code: CodeIx::NONE,
                        conditional: is_conditional(table, ix, block),
                        range,
                    });
                }
                StatementKind::Do { number, .. } => {
                    self.loops.push(Loop { begins: true, number: constant(*number), range });
                }
                StatementKind::End { number } => {
                    self.loops.push(Loop { begins: false, number: constant(*number), range });
                }
                StatementKind::OWord { label, keyword, .. } => {
                    if *keyword == OKeyword::Call {
                        let target = CallKind::OWord(label.clone());
                        self.calls.push(Call { target, code: CodeIx::NONE, range: range.clone() });
                    }
                    self.o_words.push(OWord { label: label.clone(), keyword: *keyword, range });
                }
                StatementKind::Assign { target: Target::Variable(number), .. } => {
                    if self.seen.1.insert(*number) {
                        self.assigned.push((*number, range));
                    }
                }
                _ => {}
            }
        }
    }

    fn add_codes(
        &mut self,
        table: &BlockTable,
        ix: BlockIx,
        block: &Block,
        base: u32,
        dialect: &Dialect<'_>,
    ) {
        let words = table.words(block);
        // A block may be as long as a file: what the references of its codes ask for is gathered once.
        let mut references = None;
        for word in words.iter().filter(|w| matches!(w.letter.ascii(), b'G' | b'M') && !w.letter.is_corner())
        {
            self.has_computed_codes |= matches!(word.value, Value::Expr(_));
            if let Some(number) = word.number().and_then(|n| CodeNumber::from_value(word.letter.ascii(), n))
                && self.seen.0.insert(number)
            {
                self.codes.push((number, shift(&word.range(), base)));
            }
            let Some(code) = dialect.control().code_at(word.code) else { continue };
            let entry = code.entry();
            let given = self.letters.or(block.letters);
            for lasting in dialect.lasting(word.code) {
                let letter = lasting.letter;
                if block.letters.intersects(lasting.here) {
                    self.given_otherwise.insert(letter);
                }
                let is_given = given.contains(letter) || given.intersects(lasting.instead);
                if !is_given && !self.given_otherwise.contains(letter) {
                    let range = shift(&word.range(), base);
                    self.never_given.push(NeverGiven { code: word.code, letter, range });
                }
            }
            if let Some(ends) = entry.ends {
                let conditional = is_conditional(table, ix, block);
                let is_target = |word: &gcheck_controls::WordEntry| {
                    word.kind == WordKind::Label
                        && Letter::parse(&word.letter).is_some_and(|letter| block.letters.contains(letter))
                };
                let jumps = entry.words.iter().any(is_target);
                self.ends.push(EndMark { ends, conditional, jumps, range: shift(&word.range(), base) });
            }
            if !dialect.refers(word.code) {
                continue;
            }
            let references = references.get_or_insert_with(|| References::of(words, dialect));
            for target in &entry.words {
                let Some(letter) = Letter::parse(&target.letter) else { continue };
                // `G4 P1 M99`: which of two codes the word belongs to is not for us to say.
                if references.by_several.contains(letter) {
                    continue;
                }
                let Some(found) = references.first(letter) else { continue };
                let range = shift(&found.range(), base);
                match target.kind {
                    WordKind::Label => {
                        let target = found.integer();
                        self.jumps.push(Jump { target, code: word.code, conditional: true, range });
                    }
                    WordKind::Program => {
                        let target = found.integer().map_or(CallKind::Unknown, CallKind::Program);
                        self.calls.push(Call { target, code: word.code, range });
                    }
                    _ => {}
                }
            }
        }
    }
}

/// Which words of a block its codes may refer with.
struct References<'t> {
    /// By address: its first word.
    first: [Option<&'t Word>; Letter::COUNT],
    /// Addresses that several codes of the block read.
    by_several: LetterSet,
}

impl<'t> References<'t> {
    fn of(words: &'t [Word], dialect: &Dialect<'_>) -> Self {
        let mut first = [None; Letter::COUNT];
        let (mut by_one, mut by_several) = (LetterSet::EMPTY, LetterSet::EMPTY);
        let mut by_all = 0_u32;
        for word in words {
            if let Some(slot) = first.get_mut(word.letter.index()) {
                slot.get_or_insert(word);
            }
            let Some(code) = dialect.control().code_at(word.code) else { continue };
            if code.is_user() {
                by_all += 1;
                continue;
            }
            by_several = by_several.or(by_one.and(code.reads()));
            by_one = by_one.or(code.reads());
        }
        match by_all {
            0 => {}
            1 => by_several = by_several.or(by_one),
            _ => by_several = first.iter().flatten().map(|word| word.letter).collect(),
        }
        Self { first, by_several }
    }

    fn first(&self, letter: Letter) -> Option<&'t Word> {
        self.first.get(letter.index()).copied().flatten()
    }
}

/// What a block with a code, or the head of a program, is to lines of data.
fn data_mark(table: &BlockTable, block: &Block, base: u32, dialect: &Dialect<'_>) -> Option<DataMark> {
    if !dialect.has_data_codes() || is_row(block) {
        return None;
    }
    if may_be_among_rows(block) {
        return Some(DataMark {
            kind: DataMarkKind::Statement,
            code: CodeIx::NONE,
            block: shift(&block.range, base),
        });
    }
    let words = table.words(block);
    let control = dialect.control();
    // A number that is computed is not known.
    let number = |letter| words.iter().find(|word| word.letter == letter).map(Word::number);
    let kind = |word: &Word| match control.code_at(word.code)?.data_opening(number) {
        DataOpening::Certain => Some(DataMarkKind::Opens),
        DataOpening::IfEnded => Some(DataMarkKind::MayOpen),
        DataOpening::Never => dialect.ends_data(word.code).then_some(DataMarkKind::MayEnd),
    };
    let mark = |kind, code| DataMark { kind, code, block: shift(&block.range, base) };
    let found = words.iter().find_map(|word| Some(mark(kind(word)?, word.code)));
    Some(found.unwrap_or_else(|| {
        let mut codes =
            words.iter().filter_map(|word| control.code_at(word.code).map(|code| (word.code, code)));
        let elsewhere = codes.find(|(_, code)| leads_elsewhere(*code)).map_or(CodeIx::NONE, |(ix, _)| ix);
        mark(DataMarkKind::Command, elsewhere)
    }))
}

/// Is the place in one of the ranges, which are in text order?
fn is_in(ranges: &[Range<u32>], at: u32) -> bool {
    let after = ranges.partition_point(|range| range.end <= at);
    ranges.get(after).is_some_and(|range| range.contains(&at))
}

/// May it be among rows where lines of data are open: one of them, or a macro statement, which is executed?
pub(crate) fn may_be_among_rows(block: &Block) -> bool {
    !block.flags.intersects(BlockFlags::CODE | BlockFlags::PROGRAM_NUMBER)
}

/// Is it a row where lines of data are open?
fn is_row(block: &Block) -> bool {
    may_be_among_rows(block) && !block.flags.contains(BlockFlags::STATEMENT)
}

/// Does the code call another program, or return to the one that called?
fn leads_elsewhere(code: Code<'_>) -> bool {
    let entry = code.entry();
    entry.ends == Some(Ends::Subprogram)
        || code.alias().is_some()
        || entry.words.iter().any(|word| word.kind == WordKind::Program)
}

/// Takes out what begins in a range; the list is in text order.
fn drain<T>(list: &mut Vec<T>, range: &Range<u32>, start: impl Fn(&T) -> u32) {
    let first = list.partition_point(|item| start(item) < range.start);
    let end = list.partition_point(|item| start(item) < range.end);
    list.drain(first..end.max(first));
}

fn whole(value: f64) -> Option<u32> {
    #[expect(clippy::cast_sign_loss, reason = "the range is checked")]
    ((0.0..=f64::from(u32::MAX)).contains(&value) && value.fract() == 0.0).then_some(value as u32)
}

/// See [`FileIndex::has_speed_in_cuts`].
fn gives_speed_in_cut(table: &BlockTable, block: &Block, dialect: &Dialect<'_>) -> bool {
    let speed = Letter::of('S');
    if !block.letters.contains(speed) || !block.letters.intersects(dialect.control().axes()) {
        return false;
    }
    let words = table.words(block);
    let effects = || {
        words
            .iter()
            .filter_map(|word| dialect.control().code_at(word.code))
            .map(gcheck_controls::Code::effect)
    };
    words.iter().any(|word| word.letter == speed && word.number().is_some_and(|number| number > 0.0))
        && effects().any(|effect| effect == Effect::Linear || effect.is_arc())
        && !effects().any(Effect::starts_spindle)
}

fn shift(range: &Range<u32>, base: u32) -> Range<u32> {
    range.start + base..range.end + base
}

/// Does a condition or block delete decide whether the block is executed?
fn is_conditional(table: &BlockTable, ix: BlockIx, block: &Block) -> bool {
    block.delete > 0
        || table
            .statements(ix)
            .any(|statement| matches!(statement.kind, StatementKind::If { .. } | StatementKind::Guard { .. }))
}

#[cfg(test)]
mod tests {
    use super::{FileIndex, TapeMarks, code_region};
    use crate::Dialect;

    fn region(text: &str) -> &str {
        // However the file is cut into chunks of whole lines, it is the same.
        let mut at = 0;
        let lines: Vec<(u32, TapeMarks)> = text
            .split_inclusive('\n')
            .map(|line| {
                at += line.len();
                ((at - line.len()) as u32, TapeMarks::new(line))
            })
            .collect();
        let end = TapeMarks::region_end(lines.iter().map(|(base, marks)| (*base, marks)), text.len() as u32);
        assert_eq!(end as usize, code_region(text).end, "{text:?}");
        &text[code_region(text)]
    }

    #[test]
    fn what_stands_behind_the_closing_tape_mark_is_not_read() {
        assert_eq!(region("%\nG0\n%\nnotes\n"), "%\nG0\n%\n");
        assert_eq!(region("\n  %\nG0\n % \nnotes"), "\n  %\nG0\n % \n");
    }

    #[test]
    fn a_return_that_a_jump_leads_over_ends_no_program() {
        let is_called = |text: &str| {
            let Ok(control) = gcheck_controls::load("haas-mill") else { panic!("a control of ours") };
            let dialect = Dialect::new(&control);
            let table = crate::lower(text, &dialect);
            let mut file_index = FileIndex::default();
            file_index.add(&table, 0, text.len() as u32, &dialect);
            file_index.is_called_from_elsewhere()
        };
        assert!(is_called("O1\nG0 X1.\nM99\n"));
        assert!(!is_called("O1\nGOTO3\nN1 G0 X1.\nM99\nN3 M97 P1\nM30\n"));
        assert!(is_called("O1\nIF [#1 EQ 2] GOTO3\nN1 G0 X1.\nM99\nN3 M97 P1\nM30\n"));
        assert!(is_called("O1\nN3 G0 X1.\nGOTO3\nM99\n"));
        assert!(is_called("O1\nGOTO3\nN2 M30\nN3 M99\n"));
        assert!(!is_called("O1\nG0 X1.\nM99 P7\nN7 M30\n"));
        assert!(is_called("O1\nG0 X1.\nM99 P7\n"));
    }

    #[test]
    fn one_mark_opens_or_closes() {
        assert_eq!(region("%\nG0\nM30\n"), "%\nG0\nM30\n");
        assert_eq!(region("G0\nM30\n%\nnotes\n"), "G0\nM30\n%\n");
        assert_eq!(region("(part 12)\n; rev B\n\n%\nG0\nM30\n"), "(part 12)\n; rev B\n\n%\nG0\nM30\n");
        assert_eq!(region("(slot) G0 X1\n%\nnotes\n"), "(slot) G0 X1\n%\n");
    }

    #[test]
    fn a_percent_sign_inside_a_line_is_no_mark() {
        assert_eq!(region("%\nG0 (50%)\nM30\n"), "%\nG0 (50%)\nM30\n");
    }

    /// The lines of data of a program, and the codes that open some which nothing ends; the same however the file is cut into
    /// chunks.
    fn data_of(text: &str) -> (Vec<&str>, usize) {
        let control = gcheck_controls::load("fanuc-mill").unwrap();
        let dialect = Dialect::new(&control);
        let mut whole = FileIndex::default();
        whole.add(&crate::lower(text, &dialect), 0, text.len() as u32, &dialect);
        let mut joined = FileIndex::default();
        let mut at = 0;
        for line in text.split_inclusive('\n') {
            let chunk = FileIndex::of_chunk(&crate::lower(line, &dialect), u32::MAX, &dialect);
            joined.join(&chunk, at, &dialect);
            at += line.len() as u32;
        }
        let lists = |of: &FileIndex| (of.data.clone(), of.labels.clone(), of.unpointed.clone());
        assert_eq!(lists(&whole), lists(&joined), "{text}");
        let open: Vec<_> = whole.data_left_open().collect();
        assert_eq!(open, joined.data_left_open().collect::<Vec<_>>(), "{text}");
        let mut at = 0;
        let lines = text.split_inclusive('\n').filter(|line| {
            at += line.len() as u32;
            whole.is_data(at - line.len() as u32)
        });
        (lines.map(str::trim).collect(), open.len())
    }

    #[test]
    fn rows_between_the_code_that_opens_data_and_the_one_that_ends_it() {
        let rows = "N1320 P1 R500000";
        assert_eq!(data_of(&format!("N5 G10 L50\n{rows}\nG11\nN5 G0 X1.\n")), (vec![rows], 0));
        assert_eq!(data_of("G10 L2 P1 X0.\nG0 X1.\nG11\n"), (vec![], 0));
        // A command shows that nothing ended them.
        let two = format!("G10 L50\n{rows}\nG0 X1.\nG0 X2.\nG10 L50\n{rows}\nG11\n");
        assert_eq!(data_of(&two), (vec![rows, rows], 1));
        // What follows the rows is another program, or nothing.
        assert_eq!(data_of(&format!("G10 L50\n{rows}\nO2\nN7 X1.\nG11\n")), (vec![rows], 1));
        assert_eq!(data_of(&format!("G10 L50\n{rows}\nN7 R1\n")), (vec![rows, "N7 R1"], 1));
    }

    #[test]
    fn macro_statements_among_rows_are_not_rows() {
        let (first, last) = ("N1320 P1 R#5", "N1321 P1 R7");
        for opens in ["G10 L50", "G10 L75"] {
            let text = format!("{opens}\n{first}\nN3 #5=#6\nIF [#5 EQ 1] GOTO 3\n{last}\nG11\n");
            assert_eq!(data_of(&text), (vec![first, last], 0));
        }
        assert_eq!(data_of(&format!("G10 L50\n{first}\n#5=1\n{last}\n")), (vec![first, last], 1));
    }

    #[test]
    fn a_code_that_may_open_data_opens_it_if_a_code_ends_it() {
        let rows = "N1320 P1 R500000\nN7 R1";
        for opens in ["G10 L#1", "N3 G10 L#500 P1", "G10 L75 P1"] {
            assert_eq!(
                data_of(&format!("{opens}\n{rows}\nN9 G11\nN5 G0 X1.\n")),
                (rows.lines().collect(), 0)
            );
            assert_eq!(data_of(&format!("{opens}\n{rows}\nG0 X1.\nG11\n")), (vec![], 0));
            assert_eq!(data_of(&format!("{opens}\n{rows}\n")), (vec![], 0));
        }
        assert_eq!(data_of(&format!("G10 L2 P1 X0.\n{rows}\nG11\n")), (vec![], 0));
        assert_eq!(data_of(&format!("G10 P1 R1.\n{rows}\nG11\n")), (vec![], 0));
    }

    #[test]
    fn numbers_of_rows_are_neither_labels_nor_without_a_point() {
        let labels = |text: &str| {
            let control = gcheck_controls::load("fanuc-mill").unwrap();
            let dialect = Dialect::new(&control);
            let mut whole = FileIndex::default();
            whole.add(&crate::lower(text, &dialect), 0, text.len() as u32, &dialect);
            let numbers: Vec<_> = whole.labels.iter().map(|label| label.number).collect();
            (numbers, whole.unpointed.len())
        };
        assert_eq!(labels("N1 G10 L50\nN2 R1\nN3 G11\nN4 G0 X1\n"), (vec![1, 3, 4], 1));
        assert_eq!(labels("N1 G10 L50\nN2 R1\nN3 G0 X1.\n"), (vec![1, 3], 0));
        assert_eq!(labels("N1 G10 L75\nN2 R1\nN3 G11\n"), (vec![1, 3], 0));
        assert_eq!(labels("N1 G10 L75\nN2 R1\nN3 G0 X1.\n"), (vec![1, 2, 3], 1));
    }
}
