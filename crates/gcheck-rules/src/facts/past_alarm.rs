//! What an alarm leaves open about the way of the program.
//!
//! Knows: after which alarms execution may go on elsewhere once the block is corrected. Must not know: any rule, wording.

use gcheck_engine::Fault;

/// Does the control not find where the program goes on? Corrected, the block may lead to any block.
pub(crate) fn loses_way(fault: &Fault) -> bool {
    matches!(
        fault,
        Fault::NoSuchLabel(_)
            | Fault::JumpTarget(_)
            | Fault::NoSuchProgram
            | Fault::LoopMismatch
            | Fault::StrayReturn
            | Fault::TooDeep
            | Fault::NoProgramEnd
    )
}
