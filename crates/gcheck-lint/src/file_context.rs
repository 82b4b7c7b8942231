//! What a rule of the program tier sees: a whole file.
//!
//! Knows: how to read a file again, in pieces, lines and blocks; facts that are found out once for several rules. Must not
//! know: any rule, what words mean.

use std::any::{Any, TypeId};
use std::cell::RefCell;
use std::collections::BTreeMap;
use std::ops::Range;
use std::rc::Rc;

use gcheck_controls::Control;
use gcheck_diagnostics::Finding;
use gcheck_program::{BlockFlags, FileIndex, lower};
use gcheck_syntax::line_len;

use crate::block_delete::name_condition;
use crate::{BlockCx, Environment, ProgramText};

/// What several rules ask of a file: found out once, when the first of them asks.
pub trait FileFact: Any {
    /// Of a file.
    fn of(cx: &FileCx<'_>) -> Self;
}

/// A whole file, as a rule of the program tier sees it.
pub struct FileCx<'a> {
    /// Control, machine, other programs.
    pub environment: Environment<'a>,
    /// The text.
    pub text: &'a ProgramText<'a>,
    /// The part of the file that the control reads.
    pub region: Range<u32>,
    /// Labels, jumps, calls, loops, ends.
    pub file_index: &'a FileIndex,
    /// Facts that a rule has asked for.
    facts: RefCell<Vec<(TypeId, Rc<dyn Any>)>>,
}

impl<'a> FileCx<'a> {
    /// A file with its file index; `region` is the part that the control reads.
    pub fn new(
        environment: Environment<'a>,
        text: &'a ProgramText<'a>,
        region: Range<u32>,
        file_index: &'a FileIndex,
    ) -> Self {
        Self { environment, text, region, file_index, facts: RefCell::default() }
    }

    /// A fact about the file.
    pub fn fact<F: FileFact>(&self) -> Rc<F> {
        let id = TypeId::of::<F>();
        let known = self.facts.borrow().iter().find(|(of, _)| *of == id).map(|(_, fact)| Rc::clone(fact));
        if let Some(fact) = known.and_then(|fact| fact.downcast().ok()) {
            return fact;
        }
        let fact = Rc::new(F::of(self));
        self.facts.borrow_mut().push((id, Rc::<F>::clone(&fact)));
        fact
    }

    /// The control.
    pub fn control(&self) -> &'a Control {
        self.environment.control()
    }

    /// Text of a range of the file.
    pub fn slice(&self, range: Range<u32>) -> &'a str {
        self.text.slice(range)
    }

    /// Reads a block again whose place the file index holds, and gives it to `look`.
    pub fn reread(&self, place: Range<u32>, mut look: impl FnMut(&BlockCx<'_>)) {
        let base = place.start;
        let text = self.slice(place);
        let table = lower(text, self.environment.dialect);
        for (ix, _) in table.blocks() {
            look(&BlockCx::new(self.environment, &table, ix, text, base));
        }
    }

    /// A finding about what blocks do. Where every one of them has a block delete, the finding names that condition: with the
    /// switch on it does not hold.
    pub fn if_run(&self, finding: Finding, blocks: &[Range<u32>]) -> Finding {
        let may_be_skipped =
            |place: &Range<u32>| self.flags_at(place.clone()).contains(BlockFlags::BLOCK_DELETE);
        let all_may_be_skipped =
            self.file_index.block_deletes != 0 && !blocks.is_empty() && blocks.iter().all(may_be_skipped);
        let flags = if all_may_be_skipped { BlockFlags::BLOCK_DELETE } else { BlockFlags::empty() };
        name_condition(finding, flags, false)
    }

    /// Places by what they do, for [`FileCx::if_run`]; empty where the file has no block delete.
    pub fn places<K: Ord>(&self, of: impl Iterator<Item = (K, Range<u32>)>) -> BTreeMap<K, Vec<Range<u32>>> {
        let mut places: BTreeMap<K, Vec<Range<u32>>> = BTreeMap::new();
        if self.file_index.block_deletes != 0 {
            for (key, place) in of {
                places.entry(key).or_default().push(place);
            }
        }
        places
    }

    /// What the block at a place has.
    fn flags_at(&self, place: Range<u32>) -> BlockFlags {
        let (start, mut flags) = (place.start, BlockFlags::empty());
        self.reread(self.line_around(place), |block| {
            if block.block_range().contains(&start) {
                flags = block.block().flags;
            }
        });
        flags
    }

    /// Reads the file again, block by block. A rule that is on by default must not: it asks the file index.
    pub fn each_block(&self, mut look: impl FnMut(&BlockCx<'_>)) {
        for (start, run) in self.runs() {
            for chunk in gcheck_syntax::cuts(run) {
                let base = start + chunk.start as u32;
                let text = run.get(chunk).unwrap_or_default();
                let table = lower(text, self.environment.dialect);
                for (ix, _) in table.blocks() {
                    look(&BlockCx::new(self.environment, &table, ix, text, base));
                }
            }
        }
    }

    /// What the control reads, in runs of whole lines, each with its offset. Never copied, however long it is.
    pub fn runs(&self) -> impl Iterator<Item = (u32, &'a str)> + use<'a> {
        let end = self.region.end;
        let runs = self.text.from(0).take_while(move |(base, _)| *base < end);
        runs.map(move |(base, run)| (base, run.get(..(end - base) as usize).unwrap_or(run)))
    }

    /// [`Self::runs`] line by line, each line with its end.
    pub fn lines(&self) -> impl Iterator<Item = (u32, &'a str)> + use<'a> {
        self.runs().flat_map(|(mut at, mut rest)| {
            std::iter::from_fn(move || {
                let (line, after) = rest.split_at_checked(line_len(rest.as_bytes()))?;
                let start = at;
                (at, rest) = (start + line.len() as u32, after);
                (!line.is_empty()).then_some((start, line))
            })
        })
    }

    /// The numbers of the lines of places, from 1; the places ascend.
    pub fn line_numbers<const N: usize>(&self, places: [u32; N]) -> [u32; N] {
        let mut starts = self.lines().map(|(start, _)| start).peekable();
        let mut line = 0;
        places.map(|place| {
            while starts.next_if(|start| *start <= place).is_some() {
                line += 1;
            }
            line
        })
    }

    /// The line around a place, at most [`LINE`] bytes of it on either side.
    pub fn line_around(&self, place: Range<u32>) -> Range<u32> {
        let (base, text) = self.text.around(place.start);
        let is_end = |byte: &&u8| matches!(byte, b'\n' | b'\r');
        let inside = place.start.saturating_sub(base) as usize;
        let (head, tail) = text.as_bytes().split_at_checked(inside).unwrap_or_default();
        let before = head.iter().rev().take(LINE).take_while(|byte| !is_end(byte)).count() as u32;
        let after = tail.iter().take(LINE).take_while(|byte| !is_end(byte)).count() as u32;
        place.start - before..place.start + after
    }
}

/// Controls read no longer lines; a file of one long line is not read again and again.
const LINE: usize = 1024;
