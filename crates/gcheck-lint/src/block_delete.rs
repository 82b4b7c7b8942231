//! Findings that depend on the switch of block delete.
//!
//! Knows: the two conditions, and how a finding names them. Must not know: any rule, how blocks are executed.

use std::collections::HashSet;

use gcheck_diagnostics::{Certainty, Finding, Severity};
use gcheck_program::BlockFlags;

/// What tells one finding of a file from another: its rule, its first byte, its message.
pub(crate) type Key = (&'static str, u32, String);

/// See [`Key`].
pub(crate) fn key(finding: &Finding) -> Key {
    (finding.rule.id, finding.range.start, finding.message.clone())
}

/// A finding of a block with these flags. It holds with one position of the switch only where the block begins with `/`, or
/// where only an analysis that skips such blocks makes it.
pub(crate) fn name_condition(mut finding: Finding, block: BlockFlags, skips: bool) -> Finding {
    if skips {
        // Which position the operator chooses is not known; what a block with `/` itself does wrong is wrong in any case.
        finding.severity = finding.severity.min(Severity::Warning);
        holds_when(&mut finding, "it holds with block delete on, when the control skips blocks with `/`");
    } else if block.contains(BlockFlags::BLOCK_DELETE) {
        holds_when(&mut finding, "it holds with block delete off: the block has a `/`");
    }
    finding
}

/// What the first analysis found, and what those that skip blocks found again.
#[derive(Default)]
pub(crate) struct Positions {
    /// Found with the switch off, and not with every other position so far.
    off_only: HashSet<Key>,
}

impl Positions {
    /// What the analysis with the switch off found.
    pub(crate) fn new(found: impl Iterator<Item = Key>) -> Self {
        Self { off_only: found.collect() }
    }

    /// Of findings that every one of several analyses made, none depends on the switch.
    pub(crate) fn found_again(&mut self, by_all: impl IntoIterator<Item = Key>) {
        for key in by_all {
            self.off_only.remove(&key);
        }
    }

    /// Names the condition of a finding that holds with the switch off alone.
    pub(crate) fn name(&self, finding: &mut Finding) {
        if finding.certainty == Certainty::Always && self.off_only.contains(&key(finding)) {
            holds_when(finding, "it holds with block delete off, when the control executes blocks with `/`");
        }
    }
}

/// What every one of several analyses found.
pub(crate) fn found_by_all(mut analyses: impl Iterator<Item = HashSet<Key>>) -> HashSet<Key> {
    let first = analyses.next().unwrap_or_default();
    analyses.fold(first, |all, next| all.intersection(&next).cloned().collect())
}

fn holds_when(finding: &mut Finding, condition: &str) {
    finding.certainty = Certainty::Maybe;
    if finding.severity >= Severity::Warning {
        finding.notes.push(condition.to_owned());
    }
}
