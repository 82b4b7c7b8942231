//! A rule as the runner takes it: its metadata with the way it runs, and the table of all rules.
//!
//! Knows: the tiers' entry points. Must not know: any rule. The table comes from outside, because this crate is compiled
//! before the rules are: [`Selection`](crate::Selection) holds it, and everything else asks the selection.

use gcheck_diagnostics::{RuleMeta, RuleSet};
use gcheck_program::BlockFlags;
use gcheck_syntax::{SyntaxError, SyntaxErrorKind};

use crate::values::WithValues;
use crate::{BlockCx, FileCx, PathRule, Report, Suppressions, Watch};

/// A rule: what it is and how it runs.
#[derive(Debug)]
pub struct RuleEntry {
    /// What it is.
    pub meta: &'static RuleMeta,
    /// How it runs.
    pub run: Run,
}

/// How a rule runs, by tier.
pub enum Run {
    /// For each mistake in form of a kind that `on` accepts.
    Token {
        /// Does the rule report this kind of mistake?
        on: fn(SyntaxErrorKind) -> bool,
        /// Reports it.
        check: fn(&BlockCx<'_>, &SyntaxError, &mut Report<'_>),
    },
    /// For each block that has any of the flags.
    Block {
        /// Blocks without any of these are skipped.
        trigger: BlockFlags,
        /// Looks at the block.
        check: fn(&BlockCx<'_>, &mut Report<'_>),
    },
    /// As [`Run::Block`]; and again while all paths are executed, with a number in each computed word that has the same
    /// value on every path that comes to the block. For rules that judge values and codes, not how they are written.
    BlockAndValues {
        /// Blocks without any of these are skipped.
        trigger: BlockFlags,
        /// What it judges of the values.
        reads: Reads,
        /// Looks at the block.
        check: fn(&BlockCx<'_>, &mut Report<'_>),
    },
    /// Once for the file.
    Program {
        /// Looks at the file.
        check: fn(&FileCx<'_>, &mut Report<'_>),
    },
    /// While all paths of the program are executed.
    Path {
        /// What the rule wants to see.
        watch: Watch,
        /// Makes the rule for one file.
        make: fn() -> Box<dyn PathRule>,
    },
    /// Once for the file, after its suppressions have silenced what they silence.
    Suppressions {
        /// Looks at the suppressions.
        check: fn(&Suppressions, &mut Report<'_>),
    },
}

/// What a rule judges of a block whose computed words have values.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Reads {
    /// Its codes and its addresses: a number counts where it names a code, as in `G#1`, and an empty variable where it takes
    /// its address out of the block.
    Codes,
    /// Its numbers too.
    Numbers,
}

impl Run {
    /// What the rule watches while all paths are executed, if it does, and how.
    pub(crate) fn watcher(&self) -> Option<(Watch, Box<dyn PathRule>)> {
        match *self {
            Self::Path { watch, make } => Some((watch, make())),
            Self::BlockAndValues { trigger, reads, check } => {
                let watch = match reads {
                    Reads::Codes => Watch::COMPUTED_CODES,
                    Reads::Numbers => Watch::COMPUTED,
                };
                Some((watch, Box::new(WithValues { trigger, check })))
            }
            Self::Token { .. } | Self::Block { .. } | Self::Program { .. } | Self::Suppressions { .. } => {
                None
            }
        }
    }
}

impl std::fmt::Debug for Run {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(match self {
            Self::Token { .. } => "Token",
            Self::Block { .. } => "Block",
            Self::BlockAndValues { .. } => "BlockAndValues",
            Self::Program { .. } => "Program",
            Self::Path { .. } => "Path",
            Self::Suppressions { .. } => "Suppressions",
        })
    }
}

/// All rules that there are.
#[derive(Debug, Clone, Copy)]
pub struct RuleTable(&'static [&'static RuleEntry]);

impl RuleTable {
    /// No rules.
    pub const EMPTY: Self = Self(&[]);

    /// Of a list that is sorted by group and id.
    pub const fn new(rules: &'static [&'static RuleEntry]) -> Self {
        Self(rules)
    }

    /// Every rule, sorted by group and id.
    pub fn iter(self) -> impl DoubleEndedIterator<Item = &'static RuleEntry> + ExactSizeIterator {
        self.0.iter().copied()
    }

    /// The rule of an id or alias.
    pub fn by_id(self, id: &str) -> Option<&'static RuleEntry> {
        self.iter().find(|rule| rule.meta.is_called(id))
    }

    /// Does a selector name a rule, a group or a set?
    pub fn knows(self, selector: &str) -> bool {
        self.iter().any(|rule| rule.meta.is_selected_by(selector))
    }

    /// The rule, group or set whose name is nearest, if one is near.
    pub fn suggest(self, name: &str) -> Option<&'static str> {
        let sets = RuleSet::ALL.into_iter().map(RuleSet::name);
        let names =
            self.iter().flat_map(|r| [r.meta.id, r.meta.group]).chain(["recommended", "all"]).chain(sets);
        names
            .map(|candidate| (strsim::levenshtein(name, candidate), candidate))
            .filter(|(distance, candidate)| *distance <= 1 + candidate.len() / 4)
            .min()
            .map(|(_, candidate)| candidate)
    }
}
