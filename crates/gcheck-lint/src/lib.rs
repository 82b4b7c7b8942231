//! Runs rules over a program: by tier, over every path, with suppressions, again after every edit.
//!
//! Knows: when a rule is called and what it may ask then, which of its findings are kept. Must not know: any rule, files,
//! terminals, editors.
//!
//! The rules come from outside. The caller makes a [`Selection`] of a [`RuleTable`], and that is the only way in which
//! rules get here: this crate knows the type of a rule ([`RuleEntry`]) and no rule, so that a rule can be changed
//! without compiling the runner again, and a test can run a table of its own.

mod assumptions;
mod block_context;
mod block_delete;
mod check;
mod collector;
mod containment;
mod contract;
mod directives;
mod environment;
mod evaluated;
pub mod fault_words;
mod file_context;
mod fix;
mod incremental;
mod memories;
mod memory;
mod partitions;
mod path_context;
mod path_rule;
mod proposed_fixes;
mod report;
mod rule;
mod selection;
mod shared_memory;
mod suppression;
mod syntax_errors;
mod text;
mod text_memo;
mod uses;
mod values;
mod watchers;

pub use assumptions::{describe, describe_all, in_picture, work_offset_name};
pub use block_context::{BlockCx, WordFacts};
pub use check::{Assumptions, Execution, Job, Outcome, check};
pub use collector::{MAX_FINDINGS, Omitted};
pub use environment::{ControlBasis, Environment, MachineFacts, NoPrograms, Programs};
pub use file_context::{FileCx, FileFact};
pub use fix::{Fixed, fix_all};
pub use incremental::{
    ChunkFacts, ChunkFindings, ChunkSource, EditedFile, FileFacts, Incremental, Stopped, Work,
};
pub use memory::{Memory, Placed, Places, Remembers};
pub use path_context::{FinishCx, FollowedCx, PathCx};
pub use path_rule::{PathRule, Watch};
pub use proposed_fixes::line_end;
pub use report::{Report, limit};
pub use rule::{Reads, RuleEntry, RuleTable, Run};
pub use selection::{Selection, UnknownRule};
pub use shared_memory::{MakeShared, SharedMemory};
pub use suppression::{MalformedDirective, Suppression, Suppressions};
pub use syntax_errors::{foreign_characters, is_foreign_character, letter_o};
pub use text::ProgramText;
pub use uses::Uses;
