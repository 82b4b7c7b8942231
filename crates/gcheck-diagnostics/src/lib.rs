//! The vocabulary of findings: what is wrong, how bad it is, where, and how to fix it.
//!
//! Knows: findings, severities, labels, fixes and edits as bytes of a text, the metadata of rules. Must not know: programs
//! and how they run, which rules exist, files, terminals, editors.
//!
//! Everything that makes, carries or shows findings depends on this crate, and so does the formatter: an [`Edit`] is the same
//! thing whoever proposes it.

mod assumption;
mod edit;
mod example;
mod finding;
mod fix;
mod repeats;
mod rule;
mod severity;

pub use assumption::{StatedAssumption, pins};
pub use edit::{Edit, apply, apply_to_bytes};
pub use example::DocExample;
pub use finding::{Finding, Label, alarm_name};
pub use fix::{Fix, FixKinds};
pub use repeats::{SHOWN_OF_A_RULE, Told, fold_repeats};
pub use rule::{Fixability, RuleMeta, RuleSet, Tier};
pub use severity::{Certainty, Severity};
