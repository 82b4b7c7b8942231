//! Blocks that the block delete switch of the panel leaves out.
//!
//! Knows: the sign and where it is in a block. Must not know: any rule, the position of the switch.

use gcheck_program::BlockFlags;

use crate::PathCx;

/// Does the sign (`/`) at the head of the block leave all of it to the switch?
pub(crate) fn is_optional(cx: &PathCx<'_>) -> bool {
    cx.origin().flags.contains(BlockFlags::BLOCK_DELETE)
        && cx.place().is_some_and(|place| place.block().delete > 0)
}
