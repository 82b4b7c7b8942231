//! Offset numbers by tool: the scheme that the tools of a program follow, and the tools that break it.
//!
//! Knows: pairs of tool and offset number. Must not know: which offset it is, any rule.

use std::collections::BTreeSet;
use std::ops::Range;

use crate::remembers;
use crate::{Finding, Fix};
use gcheck_engine::At;

/// Which tool worked with which offset, each pair with the finding to make of it if it is odd.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Pairs {
    pairs: Vec<Pair>,
}

remembers!(Pairs: pairs);

#[derive(Debug, Clone, PartialEq)]
struct Pair {
    tool: u32,
    offset: u32,
    /// Where the tool came.
    section: Option<At>,
    finding: Finding,
    /// The word that gives the offset by its number alone.
    word: Option<Range<u32>>,
}

remembers!(Pair: section, finding, word);

/// What the other tools of the program do.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Scheme {
    /// Offset less tool.
    step: i64,
    /// The offset that the tool would have.
    pub(crate) expected: i64,
    /// The tool that the offset belongs to.
    pub(crate) owner: i64,
    /// How many tools follow it.
    followers: usize,
    /// The program has that tool.
    is_owned: bool,
    /// Elsewhere the tool has the offset that it would have: this one may be meant.
    pub(crate) is_unsure: bool,
}

impl Scheme {
    /// Whose the offset is: "the length offset of tool 2".
    pub(crate) fn label(&self, what: &str) -> String {
        if !self.is_owned {
            return format!("no tool of the program has this {what} by its number");
        }
        format!("the {what} of tool {}", self.owner)
    }

    /// The scheme: "3 other tools of the program have the length offset of their own number".
    pub(crate) fn note(&self, what: &str, letter: char) -> String {
        let tools = if self.followers == 1 {
            "the program's other tool has".to_owned()
        } else {
            format!("{} other tools of the program have", self.followers)
        };
        match self.step {
            0 => format!("{tools} the {what} of the tool's own number ({letter} = T)"),
            step if step > 0 => {
                format!("{tools} the {what} of the tool's number and {step} ({letter} = T + {step})")
            }
            step => {
                format!("{tools} the {what} of the tool's number less {} ({letter} = T - {})", -step, -step)
            }
        }
    }
}

/// So many tools with the offset of their own number make another number odd, whichever tool it belongs to.
const MANY: usize = 2;

/// Is the offset the tool's number with a slip of the finger: one more or less, or its two digits exchanged?
fn is_slip(tool: u32, offset: u32) -> bool {
    let exchanged = (10..100).contains(&tool).then_some(tool % 10 * 10 + tool / 10);
    tool.abs_diff(offset) == 1 || exchanged == Some(offset)
}

/// Turrets have no more stations than this.
const MOST_STATIONS: u32 = 24;

/// More pairs than this say nothing clear.
const MOST_PAIRS: usize = 1000;

impl Pairs {
    /// None yet.
    pub(crate) const fn new() -> Self {
        Self { pairs: Vec::new() }
    }

    /// A tool worked with an offset.
    pub(crate) fn add(
        &mut self,
        tool: u32,
        offset: u32,
        section: Option<At>,
        finding: impl FnOnce() -> (Finding, Option<Range<u32>>),
    ) {
        let is_known = |pair: &Pair| (pair.tool, pair.offset, pair.section) == (tool, offset, section);
        let is_known = self.pairs.iter().any(is_known);
        if tool > 0 && offset > 0 && !is_known && self.pairs.len() < MOST_PAIRS {
            let (finding, word) = finding();
            self.pairs.push(Pair { tool, offset, section, finding, word });
        }
    }

    /// The pairs that break the scheme which the other tools fix, and take another tool's offset, or one of no tool where
    /// many tools have their own. Their findings can be fixed where a word of this letter gives the offset. `seconds` looks
    /// for second offsets of no tool as well: a tool works with one that works with its own elsewhere.
    pub(crate) fn take_odd(&mut self, letter: char, seconds: bool) -> Vec<(Finding, Scheme)> {
        let Some((step, followers)) = self.step() else { return Vec::new() };
        let is_used = |tool: i64| self.pairs.iter().any(|p| i64::from(p.tool) == tool && p.step() == step);
        let has_own_here = |pair: &Pair| {
            let is_own = |p: &Pair| p.tool == pair.tool && p.section == pair.section && p.step() == step;
            self.pairs.iter().any(is_own)
        };
        let mut odd: Vec<(u32, u32, Option<At>, Scheme)> = Vec::new();
        for pair in self.pairs.iter().filter(|pair| pair.step() != step) {
            let owner = i64::from(pair.offset) - step;
            let is_unsure = is_used(i64::from(pair.tool));
            // A second offset of a tool is beside the first: the intended one works with both.
            if is_unsure && has_own_here(pair) {
                continue;
            }
            let is_near = seconds && is_slip(pair.tool, pair.offset);
            let is_stray = step == 0 && (followers >= MANY || is_near) && (seconds || !is_unsure);
            let is_told = odd.iter().any(|(tool, offset, ..)| (*tool, *offset) == (pair.tool, pair.offset));
            if !is_told && (is_used(owner) || is_stray) {
                let (expected, is_owned) = (i64::from(pair.tool) + step, is_used(owner));
                let scheme = Scheme { step, expected, owner, followers, is_owned, is_unsure };
                odd.push((pair.tool, pair.offset, pair.section, scheme));
            }
        }
        let mut found = Vec::new();
        for pair in std::mem::take(&mut self.pairs) {
            if let Some((.., scheme)) = odd.iter().find(|(tool, offset, section, _)| {
                (*tool, *offset, *section) == (pair.tool, pair.offset, pair.section)
            }) {
                found.push((pair.with_fix(letter, scheme.expected), *scheme));
            } else {
                self.pairs.push(pair);
            }
        }
        found
    }

    /// The pairs with one of these offsets, where tools have their own number otherwise: each belongs to a tool that works
    /// nowhere. With each the offset. A number that is tens more than the tool's own is a second offset of the tool.
    pub(crate) fn take_of_absent(&mut self, offsets: &BTreeSet<u32>) -> Vec<(Finding, u32)> {
        let pairs = std::mem::take(&mut self.pairs);
        let has_scheme = pairs.iter().any(|pair| pair.step() == 0);
        let (absent, others) = pairs.into_iter().partition(|pair| {
            has_scheme && pair.step() != 0 && !pair.is_tens_more() && offsets.contains(&pair.offset)
        });
        self.pairs = others;
        absent.into_iter().map(|pair: Pair| (pair.finding, pair.offset)).collect()
    }

    /// The pairs with the number of another one of these tools, which no scheme explains: the tool never has its own number,
    /// and no other pair is as far from its tool. With each the tool and the one whose number it is.
    pub(crate) fn take_named_after(&mut self, letter: char, tools: &[u32]) -> Vec<(Finding, u32, u32)> {
        let pairs = std::mem::take(&mut self.pairs);
        let is_odd = |pair: &Pair| is_alone(pair, &pairs) && tools.contains(&pair.offset);
        let odd: Vec<bool> = pairs.iter().map(is_odd).collect();
        let mut found = Vec::new();
        for (pair, is_odd) in pairs.into_iter().zip(odd) {
            if is_odd {
                let (tool, owner) = (pair.tool, pair.offset);
                found.push((pair.with_fix(letter, i64::from(tool)), tool, owner));
            } else {
                self.pairs.push(pair);
            }
        }
        found
    }

    /// The pairs with the number of another station of a turret, which no scheme explains. Second offsets of a tool are
    /// numbered past the stations, or ten or twenty more than the tool.
    pub(crate) fn take_strangers(&mut self, letter: Option<char>) -> Vec<(Finding, u32)> {
        let pairs = std::mem::take(&mut self.pairs);
        let is_odd =
            |pair: &&Pair| is_alone(pair, &pairs) && pair.offset <= MOST_STATIONS && !pair.is_tens_more();
        let found = |pair: &Pair| match letter {
            Some(letter) => pair.clone().with_fix(letter, i64::from(pair.tool)),
            None => pair.finding.clone(),
        };
        pairs.iter().filter(is_odd).map(|pair| (found(pair), pair.tool)).collect()
    }

    /// The step that most tools follow, with their number: the plain one needs one tool, any other two, and more tools must
    /// follow it than any other step.
    fn step(&self) -> Option<(i64, usize)> {
        let mut steps: Vec<(i64, usize)> = Vec::new();
        for (ix, pair) in self.pairs.iter().enumerate() {
            let before = self.pairs.get(..ix).unwrap_or_default();
            if before.iter().any(|p| (p.tool, p.offset) == (pair.tool, pair.offset)) {
                continue;
            }
            match steps.iter_mut().find(|(step, _)| *step == pair.step()) {
                Some((_, count)) => *count += 1,
                None => steps.push((pair.step(), 1)),
            }
        }
        let (step, count) = steps.iter().copied().max_by_key(|(step, count)| (*count, *step == 0))?;
        let rivals =
            steps.iter().filter(|(other, rival)| *other != step && *rival >= count && *other == 0).count();
        let tied = steps.iter().filter(|(other, rival)| *other != step && *rival == count).count();
        let is_fixed = if step == 0 { count >= 1 } else { count >= 2 && tied == 0 && rivals == 0 };
        is_fixed.then_some((step, count))
    }
}

/// Does the tool use another number than its own, and never its own, and is there no other pair with this difference?
fn is_alone(pair: &Pair, pairs: &[Pair]) -> bool {
    let is_same = |p: &&Pair| (p.tool, p.offset) == (pair.tool, pair.offset);
    let has_fellow = pairs.iter().any(|p| p.step() == pair.step() && !is_same(&p));
    let has_own = pairs.iter().any(|p| p.tool == pair.tool && p.step() == 0);
    pair.step() != 0 && !has_fellow && !has_own
}

impl Pair {
    /// The finding, with the fix that gives the tool the offset that it would have.
    fn with_fix(self, letter: char, expected: i64) -> Finding {
        let written = format!("{letter}{expected}");
        let fix = self.word.filter(|_| expected > 0);
        self.finding.fix_if(fix.map(|word| Fix::risky(format!("write `{written}`"), word, written)))
    }

    /// As shops number the second offset of a tool.
    fn is_tens_more(&self) -> bool {
        self.step() % 10 == 0 && self.step() > 0
    }

    fn step(&self) -> i64 {
        i64::from(self.offset) - i64::from(self.tool)
    }
}

/// A count, of a number that is one.
pub(crate) fn whole(number: f64) -> Option<u32> {
    #[expect(clippy::cast_sign_loss, reason = "the range is checked")]
    let count = (0.0..=9_999_999.0).contains(&number).then_some(number as u32)?;
    (f64::from(count).to_bits() == number.to_bits()).then_some(count)
}
