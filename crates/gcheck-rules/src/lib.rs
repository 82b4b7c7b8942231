//! The findings of gcheck: their vocabulary, the rules that make them, suppressions.
//!
//! Knows: what is wrong with a program and how to say so. Must not know: salsa, LSP, terminals, files.
//!
//! A rule is one file under `rules/<group>/`; `cargo xtask new-rule` scaffolds it and [`all`] lists them.

mod assumptions;
mod bar_feeder;
mod boundary;
mod carried;
mod check;
mod context;
mod contract;
mod coolant;
mod evidence;
mod finding;
mod five_axis;
mod fixing;
mod incremental;
mod loops;
mod memory;
mod mending;
mod meta;
mod mistakes;
mod parting;
mod paths;
mod probing;
mod rereading;
mod rules;
mod schemes;
mod sections;
mod selection;
mod suppression;
#[cfg(test)]
mod testing;
mod text;
mod turning;
mod usage;
mod writing;

pub use assumptions::{Described, describe, describe_all, pins, work_offset_name};
pub use check::{Execution, Job, MAX_FINDINGS, Omitted, Outcome, check};
pub use context::{
    BlockCx, FileCx, MachineFacts, NoPrograms, Programs, Report, Run, Scene, WordFacts, limit,
};
pub use evidence::{EVIDENCE_BYTES, collect_evidence};
pub use finding::{Certainty, Edit, Finding, Fix, Label, Severity};
pub use fixing::{FixKinds, Mended, mend};
pub use incremental::{ChunkFacts, ChunkFindings, ChunkSource, Edited, Incremental, Stopped, Whole, Work};
pub use memory::{Memory, Placed, Places, Remembers};
pub use meta::{DocExample, Mends, RuleEntry, RuleMeta, RuleSet, Tier};
pub use paths::{FinishCx, Ledger, PathCx, PathRule, Watch};
pub use rules::{all, by_id};
pub use sections::{LabelIndex, Section};
pub use selection::{Selection, UnknownRule, suggest};
pub use text::ProgramText;
pub use usage::Uses;
