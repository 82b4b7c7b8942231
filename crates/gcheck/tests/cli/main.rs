//! End-to-end tests: the `gcheck` program as people and other programs run it, in a folder of its own.
//!
//! Knows: arguments, files, exit codes, what is printed. Must not know: how any of it is computed.

#![expect(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::indexing_slicing,
    reason = "a test that meets the unexpected is to fail"
)]

mod bad_input;
mod baseline;
mod cache;
mod ci_files;
mod configuration;
mod control;
mod determinism;
mod diff;
mod diff_folders;
mod editing;
mod exit_codes;
mod fixes;
mod formats;
mod formatting;
mod hostile;
mod lists;
mod machine;
mod machine_files;
mod output;
mod pages;
mod plot;
mod presets;
mod rare_infos;
mod readers;
mod resources;
mod run;
mod shop;
mod stats;
mod suppressions;
mod tour;
mod walking;
mod watch;
