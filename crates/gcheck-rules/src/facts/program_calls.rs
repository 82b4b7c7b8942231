//! Calls of programs: which numbers a call means, which of them are not here, and how a program that is called ends.
//!
//! Knows: packed repeats, labels in place of programs, numbers that builders reserve. Must not know: any rule, how the number
//! is written.

use std::collections::BTreeSet;

use gcheck_controls::{Effect, WordEntry};
use gcheck_engine::At;
use gcheck_program::{CallKind, FileIndex};

use crate::{Environment, PathCx};

/// Some controls take a number of repeats before the last four digits of the program that is called.
const PACKED: u32 = 10_000;

/// The programs and labels of a file, as calls ask for them.
pub(crate) struct Programs<'a> {
    environment: Environment<'a>,
    file_index: &'a FileIndex,
    here: BTreeSet<u32>,
}

impl<'a> Programs<'a> {
    pub(crate) fn new(environment: Environment<'a>, file_index: &'a FileIndex) -> Self {
        Self { environment, file_index, here: file_index.programs.iter().filter_map(|p| p.number).collect() }
    }

    /// The number of the program that a call means and that is neither in the file nor beside it; `word` is the one that
    /// names it.
    pub(crate) fn missing(&self, number: u32, word: &WordEntry) -> Option<u32> {
        let is_label = || word.or_label && self.file_index.labels.iter().any(|label| label.number == number);
        if word.elsewhere || self.is_known(number) || is_label() {
            return None;
        }
        let packed = if word.packed_repeats && number >= PACKED { Some(number % PACKED) } else { None };
        (!packed.is_some_and(|packed| self.is_known(packed))).then_some(packed.unwrap_or(number))
    }

    fn is_known(&self, number: u32) -> bool {
        let programs = self.environment.programs;
        is_reserved(number)
            || self.here.contains(&number)
            || programs.has_number(number)
            || programs.has_name(&number.to_string())
    }
}

/// Is a program called by a number that no program and no block of the file has?
pub(crate) fn calls_other_files(file_index: &FileIndex) -> bool {
    if file_index.calls.is_empty() {
        return false;
    }
    let programs = file_index.programs.iter().filter_map(|program| program.number);
    let here: BTreeSet<u32> = programs.chain(file_index.labels.iter().map(|label| label.number)).collect();
    let is_here = |number: u32| here.contains(&number) || here.contains(&(number % PACKED));
    file_index.calls.iter().any(|call| matches!(call.target, CallKind::Program(number) if !is_here(number)))
}

/// Numbers that begin with 8 or 9 belong to builders and makers of probes by custom: 8000 to 9999, and longer ones alike.
fn is_reserved(number: u32) -> bool {
    let mut head = number;
    while head >= 10_000 {
        head /= 10;
    }
    head >= 8000
}

/// Blocks of a program that are looked at.
const MOST_BLOCKS: u32 = 20_000;

/// How the text of a program ends, on any of its ways.
#[derive(Debug, Clone, Copy)]
pub(crate) struct ProgramEnds {
    /// A block goes back to the caller.
    pub(crate) returns: bool,
    /// A block ends the whole job.
    pub(crate) the_job: bool,
}

impl ProgramEnds {
    /// Of the program, in whatever file it is, that begins with this block; `None` for one that is too long to be read again.
    pub(crate) fn of(cx: &PathCx<'_>, entry: At) -> Option<Self> {
        let part = cx.program.file(entry.file)?.loaded.flow_graph().part_of(entry.block);
        if part.end.saturating_sub(part.start) > MOST_BLOCKS {
            return None;
        }
        let mut ends = Self { returns: false, the_job: false };
        for place in part.filter_map(|block| cx.place_of(At { file: entry.file, block })) {
            let words = place.table.words(place.block()).iter();
            for effect in words.filter(|word| word.code.is_some()).map(|word| cx.model.effect(word.code)) {
                ends.returns |= effect == Effect::Return;
                ends.the_job |= effect.ends_program();
            }
        }
        Some(ends)
    }
}
