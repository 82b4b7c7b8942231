//! The outline of a general pocket.
//!
//! Knows: which blocks hold it. Must not know: any rule, what an outline may hold.

use std::ops::Range;

use gcheck_program::ControlFlowGraph;

use crate::PathCx;
use crate::facts::offset_schemes::whole;

/// The blocks of the main file that hold the outline, to the end of its program.
pub(crate) fn outline_of(cx: &PathCx<'_>) -> Option<Range<u32>> {
    let number = whole(cx.known_number('P')?)?;
    let file = cx.program.file(0)?;
    let graph: &ControlFlowGraph = file.loaded.flow_graph();
    let first = match graph.label(number, cx.origin().at.block, true) {
        Some(block) => block,
        None => graph.program(number)?.blocks.start,
    };
    Some(first..graph.part_of(first).end)
}
