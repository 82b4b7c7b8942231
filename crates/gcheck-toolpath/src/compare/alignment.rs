//! Which sections of two runs belong together.
//!
//! Knows: what sections are and what their prints say, the longest sequence that two orders share. Must not know: acts, how
//! sections are compared.

use std::convert::Infallible;

use similar::algorithms::{DiffHook, myers};

use super::difference::Title;
use super::outline::Section;

/// Pairs of sections by their indexes; no section is in two of them.
#[derive(Debug, Default, PartialEq, Eq)]
pub(super) struct Alignment {
    /// Those that are in the same order in both runs.
    pub(super) in_order: Vec<(usize, usize)>,
    /// Those that are not, in the order of the first run.
    pub(super) moved: Vec<(usize, usize)>,
}

/// Pairs the sections of two runs: what is surely the same first, and then what is likely to be one that was changed.
pub(super) fn align(a: &[Section], b: &[Section], tolerance: f64) -> Alignment {
    let mut aligner =
        Aligner { a, b, is_used: [vec![false; a.len()], vec![false; b.len()]], found: Alignment::default() };
    // What comes before all others is where it is.
    aligner.in_order(vec![(0, 0)]);
    let is_like = |a: &Section, b: &Section| a.print.is_like(&b.print, tolerance);
    let is_same = |a: &Section, b: &Section| a.title == b.title && is_like(a, b);
    let has_name = |a: &Section, b: &Section| a.title == b.title && a.name == b.name && !a.name.is_empty();
    // Another number for a tool that cuts the same.
    let cuts_same = |a: &Section, b: &Section| !a.print.is_empty() && is_like(a, b);
    let has_title = |a: &Section, b: &Section| a.title == b.title;
    aligner.between(&is_same);
    aligner.anywhere(&is_same);
    aligner.between(&has_name);
    aligner.between(&cuts_same);
    aligner.between(&has_title);
    let count = |sections: &[Section], of: &Section| {
        sections.iter().filter(|section| section.title == of.title && section.name == of.name).count()
    };
    let is_only = |a_section: &Section, b_section: &Section| {
        a_section.title == b_section.title
            && a_section.name == b_section.name
            && !matches!(a_section.title, Title::Start | Title::Tool(None))
            && count(a, a_section) == 1
            && count(b, b_section) == 1
    };
    aligner.anywhere(&is_only);
    aligner.anywhere(&cuts_same);
    aligner.found.moved.sort_unstable();
    aligner.found
}

/// May a section of the first run be paired with one of the second? Not generic: the search is large, and would be there for
/// each question.
type IsPair<'p> = &'p dyn Fn(&Section, &Section) -> bool;

struct Aligner<'s> {
    a: &'s [Section],
    b: &'s [Section],
    is_used: [Vec<bool>; 2],
    found: Alignment,
}

impl Aligner<'_> {
    fn use_up(&mut self, (a, b): (usize, usize)) {
        for (is_used, index) in self.is_used.iter_mut().zip([a, b]) {
            if let Some(is_used) = is_used.get_mut(index) {
                *is_used = true;
            }
        }
    }

    fn in_order(&mut self, pairs: Vec<(usize, usize)>) {
        for pair in &pairs {
            self.use_up(*pair);
        }
        self.found.in_order.extend(pairs);
        self.found.in_order.sort_unstable();
    }

    fn unused(&self, side: usize, range: std::ops::Range<usize>) -> Vec<usize> {
        let is_used = self.is_used.get(side);
        range.filter(|index| is_used.and_then(|is_used| is_used.get(*index)) == Some(&false)).collect()
    }

    /// Pairs as many sections as fit between those that are paired in order.
    fn between(&mut self, is_pair: IsPair<'_>) {
        let ends = self.found.in_order.iter().copied().skip(1).chain([(self.a.len(), self.b.len())]);
        let gaps = self.found.in_order.iter().zip(ends);
        let mut pairs = Vec::new();
        for (&(from_a, from_b), (to_a, to_b)) in gaps {
            let (left_a, left_b) = (self.unused(0, from_a + 1..to_a), self.unused(1, from_b + 1..to_b));
            let wrap = |section| Seen { section, is_pair };
            let a: Vec<_> = left_a.iter().filter_map(|index| self.a.get(*index)).map(wrap).collect();
            let b: Vec<_> = left_b.iter().filter_map(|index| self.b.get(*index)).map(wrap).collect();
            let mut equal = Equal(Vec::new());
            // It cannot fail, as its error says.
            let Ok(()) = myers::diff_deadline_raw(
                &mut equal,
                a.as_slice(),
                0..a.len(),
                b.as_slice(),
                0..b.len(),
                None,
            );
            pairs.extend(equal.0.into_iter().filter_map(|(a, b)| Some((*left_a.get(a)?, *left_b.get(b)?))));
        }
        self.in_order(pairs);
    }

    /// Pairs sections wherever they are.
    fn anywhere(&mut self, is_pair: IsPair<'_>) {
        let left_a = self.unused(0, 0..self.a.len());
        for b in self.unused(1, 0..self.b.len()) {
            let Some(of_b) = self.b.get(b) else { continue };
            let is_free = |a: usize| self.is_used[0].get(a) == Some(&false);
            let partner = left_a
                .iter()
                .copied()
                .find(|a| is_free(*a) && self.a.get(*a).is_some_and(|of_a| is_pair(of_a, of_b)));
            if let Some(a) = partner {
                self.use_up((a, b));
                self.found.moved.push((a, b));
            }
        }
    }
}

/// A section as the search for a shared order sees it: equal to those that it may be paired with.
struct Seen<'s> {
    section: &'s Section,
    is_pair: IsPair<'s>,
}

impl PartialEq for Seen<'_> {
    /// The search asks sections of the second run about those of the first.
    fn eq(&self, of_a: &Self) -> bool {
        (self.is_pair)(of_a.section, self.section)
    }
}

/// The pairs of a shared order.
struct Equal(Vec<(usize, usize)>);

impl DiffHook for Equal {
    type Error = Infallible;

    fn equal(&mut self, a: usize, b: usize, len: usize) -> Result<(), Infallible> {
        self.0.extend((a..a + len).zip(b..));
        Ok(())
    }
}
