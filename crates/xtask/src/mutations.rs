//! `cargo xtask mutations`: forgets each field of the machine's state once where two states become one, and writes
//! `docs/dev/law-4.md` with the program for which law 4 then fails.
//!
//! Knows: which test does it, in which build. Must not know: fields, programs, what the law compares.

use std::env;
use std::process::{Command, ExitCode};

use anyhow::{Context as _, ensure};

use crate::workspace;

const PAGE: &str = "docs/dev/law-4.md";

/// Builds the engine so that it can forget, and runs the test that makes it do so.
pub(crate) fn run(arguments: &[String]) -> anyhow::Result<ExitCode> {
    ensure!(arguments.is_empty(), "mutations takes no arguments");
    let cargo = env::var_os("CARGO").unwrap_or_else(|| "cargo".into());
    let status = Command::new(cargo)
        .current_dir(workspace::root())
        .args(["test", "--package", "gcheck-engine", "--features", "forgetful", "--test", "flow_covers_run"])
        .args(["--", "the_law_fails_for_every_field_that_is_forgotten"])
        .env("GCHECK_MUTATIONS", workspace::root().join(PAGE))
        .status()
        .context("cargo does not start")?;
    if status.success() {
        println!("wrote  {PAGE}");
        return Ok(ExitCode::SUCCESS);
    }
    println!("a field was forgotten, and law 4 held: see above");
    Ok(ExitCode::FAILURE)
}
