//! Findings that depend on the switch of block delete.
//!
//! Knows: the two conditions, and how a finding names them. Must not know: any rule, how blocks are executed.

use gcheck_diagnostics::{Certainty, Finding, Severity};
use gcheck_program::BlockFlags;

/// A finding of a block with these flags. It holds with one position of the switch only where the block begins with `/`, or
/// where only an analysis that skips such blocks makes it.
pub(crate) fn name_condition(mut finding: Finding, block: BlockFlags, skips: bool) -> Finding {
    let condition = if skips {
        "it holds with block delete on, when the control skips blocks with `/`"
    } else if block.contains(BlockFlags::BLOCK_DELETE) {
        "it holds with block delete off: the block has a `/`"
    } else {
        return finding;
    };
    finding.certainty = Certainty::Maybe;
    if finding.severity >= Severity::Warning {
        finding.notes.push(condition.to_owned());
    }
    finding
}
