//! Two runs compared section by section, wherever the partner of a section is.
//!
//! Knows: which sections are compared in which pass over the runs. Must not know: when paths are the same, words.
//!
//! No act is kept: sections that changed their order are compared in further passes, in each of which the sections are in the
//! same order in both runs.

use std::iter::Peekable;
use std::ops::Range;

use super::alignment::{Alignment, align};
use super::cursor::{Cursor, Placed};
use super::curve::{Curve, apart};
use super::difference::{Again, Aspect, Change, Differences, Rest, SectionAt, SectionChange, Value};
use super::outline::{MOST_CLOSING, Outline, Splitter};
use crate::trail::{Act, Doing, Driven, Stand};

/// More passes over the runs are not made: sections that would need one are not compared.
const MOST_PASSES: usize = 32;

/// How the sections of two runs are compared.
#[derive(Debug)]
pub struct Sections {
    pub(super) outlines: [Outline; 2],
    pub(super) alignment: Alignment,
    /// Pairs of sections, in order in both runs.
    pub(super) passes: Vec<Vec<(usize, usize)>>,
    pub(super) tolerance: f64,
    pub(super) rest: Rest,
}

impl Sections {
    /// Pairs the sections of two runs; `None` where neither has two of them, or one has too many.
    pub fn new(outlines: [Outline; 2], tolerance: f64, rest: Rest) -> Option<Self> {
        let [a, b] = &outlines;
        let is_worth = a.sections.len().max(b.sections.len()) > 2;
        if !is_worth || a.is_too_long() || b.is_too_long() {
            return None;
        }
        let alignment = align(&a.sections, &b.sections, tolerance);
        let mut passes = vec![alignment.in_order.clone()];
        for &(a, b) in &alignment.moved {
            let is_full = passes.len() >= MOST_PASSES;
            let follows = |pass: &&mut Vec<(usize, usize)>| pass.last().is_none_or(|(_, last)| *last < b);
            match passes.iter_mut().skip(1).find(follows) {
                Some(pass) => pass.push((a, b)),
                None if is_full => {}
                None => passes.push(vec![(a, b)]),
            }
        }
        Some(Self { outlines, alignment, passes, tolerance, rest })
    }

    /// How often both programs have to run.
    pub const fn passes(&self) -> usize {
        self.passes.len()
    }

    /// What is found before any section is compared: those that have no partner, and those at other places.
    pub fn begun(&self) -> Differences {
        let [a, b] = &self.outlines;
        let at =
            |outline: &Outline, index: usize| outline.sections.get(index).map(|section| section.at(index));
        let Alignment { in_order, moved } = &self.alignment;
        let pairs = || in_order.iter().chain(moved);
        let is_void = |outline: &Outline, index: usize| {
            outline.sections.get(index).is_none_or(super::outline::Section::is_void)
        };
        let of_b = (0..b.sections.len()).filter_map(|index| {
            if let Some(pair) = moved.iter().find(|(_, b)| *b == index) {
                let is_compared = self.passes.iter().skip(1).any(|pass| pass.contains(pair));
                let change = Change::Moved { is_compared };
                return Some(SectionChange { change, a: at(a, pair.0), b: at(b, index) });
            }
            let is_added = pairs().all(|(_, b)| *b != index) && !is_void(b, index);
            is_added.then(|| SectionChange { change: Change::Added, a: None, b: at(b, index) })
        });
        let removed = (0..a.sections.len())
            .filter(|index| pairs().all(|(a, _)| a != index) && !is_void(a, *index))
            .map(|index| SectionChange { change: Change::Removed, a: at(a, index), b: None });
        let mut found = Differences::of_sections(a.by(), of_b.chain(removed).collect(), self.rest);
        match (&a.end, &b.end) {
            (Some(end), None) => {
                let value = Some(Value::Stand(Stand::End));
                found.add_once(Aspect::Stop, (Some(end.clone()), None), [value, None]);
            }
            (None, Some(end)) => {
                let value = Some(Value::Stand(Stand::End));
                found.add_once(Aspect::Stop, (None, Some(end.clone())), [None, value]);
            }
            _ => {}
        }
        found
    }

    /// Has a section no partner?
    pub(super) fn is_alone(&self, index: usize, side: usize) -> bool {
        let Alignment { in_order, moved } = &self.alignment;
        let is_it = |&(a, b): &(usize, usize)| index == if side == 0 { a } else { b };
        let is_in_order = match side {
            0 => in_order.binary_search_by_key(&index, |(a, _)| *a).is_ok(),
            _ => in_order.binary_search_by_key(&index, |(_, b)| *b).is_ok(),
        };
        !is_in_order && !moved.iter().any(is_it)
    }
}

/// Sections that follow each other in both runs.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Stretch {
    pub(super) a: usize,
    pub(super) b: usize,
    pub(super) count: usize,
}

pub(super) fn stretches(pairs: &[(usize, usize)]) -> Vec<Stretch> {
    let mut found: Vec<Stretch> = Vec::new();
    for &(a, b) in pairs {
        match found.last_mut() {
            Some(last) if (last.a + last.count, last.b + last.count) == (a, b) => last.count += 1,
            _ => found.push(Stretch { a, b, count: 1 }),
        }
    }
    found
}

/// Where a comparison is among all sections.
pub(super) struct Within<'s> {
    pub(super) of: &'s Sections,
    pub(super) pass: usize,
    pub(super) stretch: Stretch,
}

impl Within<'_> {
    /// Does it begin where the runs do?
    pub(super) const fn is_from_start(&self) -> bool {
        self.stretch.a == 0 && self.stretch.b == 0
    }

    fn ends(&self) -> [bool; 2] {
        let Stretch { a, b, count } = self.stretch;
        let [of_a, of_b] = &self.of.outlines;
        [a + count == of_a.sections.len(), b + count == of_b.sections.len()]
    }

    /// Does one of the programs end after it, while the other one goes on with a further section?
    pub(super) fn ends_one_program(&self) -> bool {
        let [a, b] = self.ends();
        a != b
    }

    /// Does the first program end after it, and the second one not?
    pub(super) fn ends_a_alone(&self) -> bool {
        self.ends() == [true, false]
    }

    /// Does the second program end after it, and the first one not?
    pub(super) fn ends_b_alone(&self) -> bool {
        self.ends() == [false, true]
    }

    /// A section of the stretch in both runs, and the next one that is compared.
    pub(super) fn at(&self, section: u32) -> Option<([SectionAt; 2], Option<Again>)> {
        let [of_a, of_b] = &self.of.outlines;
        let at = |(a, b): (usize, usize)| Some([of_a.sections.get(a)?.at(a), of_b.sections.get(b)?.at(b)]);
        let own = (self.stretch.a + section as usize, self.stretch.b + section as usize);
        let mut pairs = self.of.passes.get(self.pass).into_iter().flatten().copied();
        let next = pairs.find(|(a, _)| *a > own.0).and_then(at);
        let again = next.map(|[a, b]| Again { title: a.title, a: a.first, b: b.first });
        Some((at(own)?, again))
    }

    /// A run has moves left where the other one goes on with another section. Are these the moves with which the other program
    /// closes as well? Then they are no part of the section; otherwise they are left to be read.
    pub(super) fn closes<I: Iterator<Item = Placed>>(
        &self,
        cursor: &mut Cursor<I>,
        other: usize,
        tolerance: f64,
    ) -> bool {
        if cursor.section as usize + 1 != self.stretch.count {
            return false;
        }
        let Some(closing) = self.of.outlines.get(other).map(Outline::closing) else { return false };
        let rest: Vec<Placed> = std::iter::from_fn(|| cursor.next()).take(MOST_CLOSING).collect();
        let is_rapid = |act: &Act| !matches!(&act.doing, Doing::Move(made) if made.driven != Driven::Rapid);
        let ends = rest.iter().filter_map(|(_, act)| match &act.doing {
            Doing::Move(made) if !Curve::new(made).is_nothing() => Some(made.to),
            _ => None,
        });
        let own: Vec<_> = cursor.piece.iter().map(|piece| piece.curve.end()).chain(ends).collect();
        let are_rapid = cursor.piece.iter().all(|piece| piece.driven == Driven::Rapid)
            && rest.iter().all(|(_, act)| is_rapid(act))
            && rest.len() < MOST_CLOSING;
        let is_like = own.len() <= closing.len()
            && own.iter().rev().zip(closing.rev()).all(|(own, other)| apart(own, other) <= tolerance);
        if are_rapid && is_like {
            return true;
        }
        cursor.back.extend(rest);
        false
    }
}

/// The acts of a run by section.
pub(super) struct Source<I: Iterator<Item = Act>> {
    acts: Peekable<I>,
    splitter: Splitter,
    section: usize,
    /// What was read too far.
    next: Option<(usize, Act)>,
}

impl<I: Iterator<Item = Act>> Source<I> {
    pub(super) fn new(acts: I, splitter: Splitter) -> Self {
        Self { acts: acts.peekable(), splitter, section: 0, next: None }
    }

    /// The acts of some sections; what is before them is `skipped`.
    pub(super) fn stretch(
        &mut self,
        from: usize,
        count: usize,
        mut skipped: impl FnMut(usize, &Act),
    ) -> impl Iterator<Item = Placed> {
        let Range { start, end } = from..from + count;
        std::iter::from_fn(move || {
            loop {
                let (section, act) = self.next()?;
                if section >= end {
                    self.next = Some((section, act));
                    return None;
                }
                if section >= start {
                    return Some((u32::try_from(section - start).unwrap_or(u32::MAX), act));
                }
                skipped(section, &act);
            }
        })
    }
}

impl<I: Iterator<Item = Act>> Iterator for Source<I> {
    type Item = (usize, Act);

    /// The next act; the end of a program is not one of a section.
    fn next(&mut self) -> Option<(usize, Act)> {
        if let Some(next) = self.next.take() {
            return Some(next);
        }
        let is_end = |act: &Act| act.doing == Doing::Stand(Stand::End);
        loop {
            let act = self.acts.next()?;
            if self.splitter.begins(&act).is_some() {
                self.section += 1;
            }
            let is_shuttle = act.doing == Doing::Stand(Stand::Pallet) && self.acts.peek().is_some_and(is_end);
            if !is_end(&act) && !is_shuttle {
                return Some((self.section, act));
            }
        }
    }
}
