//! The rules of gcheck, one file each, and the facts of machining that they share.
//!
//! Knows: what is wrong with a program and how to say so. Must not know: how rules are called, files, terminals, editors.
//!
//! A rule is one file under `rules/<group>/`; `cargo xtask new-rule` scaffolds it and [`RULES`] lists them. Rules share nothing
//! but `facts/`: no rule names another. The imports below are the vocabulary that rules and facts have in common.

mod declare;
mod facts;
mod rules;
#[cfg(test)]
mod testing;
#[cfg(test)]
mod tests;

use gcheck_diagnostics::{Certainty, Edit, Finding, Fix, RuleMeta, Severity};
use gcheck_lint::{
    BlockCx, Environment, FileCx, FileFact, FinishCx, FollowedCx, MakeShared, PathCx, PathRule, ProgramText,
    Reads, Remembers, Report, Run, SharedMemory, Suppression, Suppressions, Uses, Watch, WordFacts, limit,
    remembers,
};
#[cfg(test)]
use gcheck_lint::{MachineFacts, Programs};

pub use rules::RULES;
