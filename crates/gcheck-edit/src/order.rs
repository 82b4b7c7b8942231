//! What must not come in another order: what a person does, what is not followed, ways from one section into another.
//!
//! Knows: commands whose effect a run does not show. Must not know: how a section is moved.

use std::collections::HashMap;
use std::ops::Range;

use gcheck_controls::{Effect, Letter};
use gcheck_program::{BlockFlags, OKeyword};

use crate::refusal::Refusal;
use crate::section_lines::{Line, Lines, Section};

/// Sections of which some come in another order.
pub(crate) struct Order<'o, 'p> {
    pub(crate) sections: &'o [Section],
    /// The one that moves, and those that it passes.
    pub(crate) moved: Range<usize>,
    pub(crate) lines: &'o Lines<'o, 'p>,
}

impl Order<'_, '_> {
    /// # Errors
    /// The sections depend on their order in a way that the proof does not see.
    pub(crate) fn check(&self) -> Result<(), Refusal> {
        for line in &self.lines.blocks {
            if self.section_of(line.start).is_some_and(|section| self.moved.contains(&section))
                && let Some(reason) = self.depends_on_order(line)
            {
                return Err(Refusal::at(line.place.range(), reason)
                    .help("move the section by hand, if this may come at another time"));
            }
        }
        self.check_ways()
    }

    /// The section that a byte is in.
    fn section_of(&self, at: u32) -> Option<usize> {
        self.sections.iter().position(|section| section.bytes.contains(&at))
    }

    /// Why a block may not come before or after other work.
    fn depends_on_order(&self, line: &Line) -> Option<&'static str> {
        let words = line.place.table.words(line.place.block());
        let is_computed = line.place.block().flags.contains(BlockFlags::EXPRESSION);
        words.iter().filter(|word| word.code.is_some()).find_map(|word| {
            let effect = self.lines.model.effect(word.code);
            match effect {
                Effect::Stop | Effect::PalletStop | Effect::AskOperator => {
                    Some("the operator does something here, which would come before or after other work")
                }
                _ if effect.measures() => {
                    Some("what is measured here would be measured before or after other work")
                }
                Effect::WriteOffsets if is_computed => {
                    Some("the offset that is computed here would be set before or after other work")
                }
                Effect::None | Effect::UserCommand if word.letter == Letter::of('M') => Some(
                    "what this command does is not followed, and it would come before or after other work",
                ),
                _ => None,
            }
        })
    }

    /// No way leads from one section into another but by the end of the first.
    fn check_ways(&self) -> Result<(), Refusal> {
        let lines = self.lines;
        let graph = lines.loaded.flow_graph();
        let index = &lines.index;
        let refuse = |range: &Range<u32>, reason: &str| {
            Err(Refusal::at(range.clone(), reason)
                .help("sections move only where the program runs them one after the other, each by itself"))
        };
        for jump in &index.jumps {
            let Some(from) = lines.block_at(jump.range.start) else { continue };
            let to = jump.target.and_then(|target| graph.label(target, from, false));
            let to = to.and_then(|block| lines.start_of(block)).map(|start| self.section_of(start));
            if to != Some(self.section_of(jump.range.start)) {
                return refuse(&jump.range, "this jump leads from one section to another, or out of all");
            }
        }
        let mut open: Vec<(Option<u64>, u32)> = Vec::new();
        for mark in &index.loops {
            let number = mark.number.map(f64::to_bits);
            if mark.begins {
                open.push((number, mark.range.start));
            } else if let Some(at) = open.iter().rposition(|(opened, _)| *opened == number)
                && let Some((_, start)) = open.drain(at..).next()
                && self.section_of(start) != self.section_of(mark.range.start)
            {
                return refuse(&mark.range, "this loop begins in another section than it ends");
            }
        }
        let mut first_section = HashMap::new();
        for word in index.o_words.iter().filter(|word| word.keyword != OKeyword::Call) {
            let section = self.section_of(word.range.start);
            if *first_section.entry(&word.label).or_insert(section) != section {
                return refuse(&word.range, "this statement belongs to one in another section");
            }
        }
        Ok(())
    }
}
