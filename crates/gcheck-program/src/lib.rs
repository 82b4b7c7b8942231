//! Part programs after syntax: blocks with their words resolved against a control, expressions, labels, calls.
//!
//! Knows: the block table of a chunk, the facts of a whole file that jumps and calls need, the map back to the source. Must
//! not know: values of expressions, motion.
//!
//! Everything but [`FileIndex`] depends on one chunk alone.

mod block;
mod control_comment;
mod control_flow_graph;
mod evidence;
mod expression;
mod file_index;
mod headings;
mod line_length;
mod line_starts;
mod loaded;
mod lower;
mod number;
mod plain;
mod statement;
mod tool_names;

pub use block::{Block, BlockFlags, BlockIx, BlockTable, Value, Word};
pub use control_comment::{ControlComment, control_comment};
pub use control_flow_graph::{
    ChunkFlow, ControlFlowGraph, ControlFlowGraphBuilder, OWordLinks, Program, Skeleton,
};
pub use evidence::{EVIDENCE_BYTES, collect_evidence, evidence_of_file};
pub use expression::{BinaryOp, Expr, ExprIx, Function, Op};
pub use file_index::{
    Call, CallKind, DataLeftOpen, EndMark, FileIndex, Jump, Label, Loop, NeverGiven, OWord, ProgramNumber,
    TapeMarks, code_region,
};
pub use headings::{Heading, Headings, is_comment_alone, is_name};
pub use line_length::{counted_characters, places_that_count};
pub use line_starts::line_starts;
pub use loaded::{Loaded, Place, Touched};
pub use lower::{Dialect, lower, lower_tree, profile};
pub use number::NumberShape;
pub use statement::{OKeyword, OLabel, Statement, StatementKind, Target};
pub use tool_names::{ToolNames, remark};
