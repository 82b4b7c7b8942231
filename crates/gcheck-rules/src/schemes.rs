//! Offset numbers by tool: the scheme that the tools of a program follow, and the tools that break it.
//!
//! Knows: pairs of tool and offset number. Must not know: which offset it is, any rule.

use std::ops::Range;

use crate::memory::remembers;
use crate::{Finding, Fix};

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
    finding: Finding,
    /// The word that gives the offset by its number alone.
    word: Option<Range<u32>>,
}

remembers!(Pair: finding, word);

/// What the other tools of the program do.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Scheme {
    /// Offset less tool.
    step: i64,
    /// The offset that the tool would have.
    pub(crate) expected: i64,
    /// The tool that the offset belongs to.
    owner: i64,
    /// How many tools follow it.
    followers: usize,
    /// The program has that tool.
    is_owned: bool,
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

/// So many tools with the offset of their own number make another number odd, whoever it belongs to.
const MANY: usize = 2;

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
        finding: impl FnOnce() -> (Finding, Option<Range<u32>>),
    ) {
        let is_known = self.pairs.iter().any(|pair| (pair.tool, pair.offset) == (tool, offset));
        if tool > 0 && offset > 0 && !is_known && self.pairs.len() < MOST_PAIRS {
            let (finding, word) = finding();
            self.pairs.push(Pair { tool, offset, finding, word });
        }
    }

    /// The pairs that break the scheme which the other tools fix, and take another tool's offset, or one of no tool where
    /// many tools have their own. Their findings can be mended where a word of this letter gives the offset.
    pub(crate) fn take_odd(&mut self, letter: char) -> Vec<(Finding, Scheme)> {
        let Some((step, followers)) = self.step() else { return Vec::new() };
        let follows = |tool: u32| self.pairs.iter().any(|p| p.tool == tool && p.step() == step);
        let is_used = |tool: i64| self.pairs.iter().any(|p| i64::from(p.tool) == tool && p.step() == step);
        let odd: Vec<(u32, u32, Scheme)> = self
            .pairs
            .iter()
            .filter(|pair| pair.step() != step && !follows(pair.tool))
            .map(|pair| {
                let owner = i64::from(pair.offset) - step;
                (
                    pair.tool,
                    pair.offset,
                    Scheme {
                        step,
                        expected: i64::from(pair.tool) + step,
                        owner,
                        followers,
                        is_owned: is_used(owner),
                    },
                )
            })
            .filter(|(_, _, scheme)| is_used(scheme.owner) || (step == 0 && followers >= MANY))
            .collect();
        let mut found = Vec::new();
        for pair in std::mem::take(&mut self.pairs) {
            if let Some((.., scheme)) =
                odd.iter().find(|(tool, offset, _)| (*tool, *offset) == (pair.tool, pair.offset))
            {
                let written = format!("{letter}{}", scheme.expected);
                let fix = pair.word.filter(|_| scheme.expected > 0);
                let fix = fix.map(|word| Fix::risky(format!("write `{written}`"), word, written));
                found.push((pair.finding.fix_if(fix), *scheme));
            }
        }
        found
    }

    /// The step that most tools follow, with their number: the plain one needs one tool, any other two, and more tools must
    /// follow it than any other step.
    fn step(&self) -> Option<(i64, usize)> {
        let mut steps: Vec<(i64, usize)> = Vec::new();
        for pair in &self.pairs {
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

impl Pair {
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
