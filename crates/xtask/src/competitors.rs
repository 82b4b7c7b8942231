//! `cargo xtask competitors`: other checkers on the mistakes that our own suite makes, in `tests/competitors.tsv`.
//!
//! Knows: how the cases are written down, where the other checkers come from. Must not know: the kinds of mistakes, or what
//! each checker says; `judge.py` counts that. No part of the tests: it installs what others publish.

use std::env;
use std::fs;
use std::process::{Command, ExitCode};

use anyhow::{Context as _, bail, ensure};

use crate::workspace;

const TABLE: &str = "tests/competitors.tsv";

/// Checkers that `PyPI` offers, at the versions that were measured. They ask for a later Python than some machines have and
/// run on an earlier one all the same.
const PACKAGES: [&str; 3] = ["nctab==0.2.0", "ncplot7py==0.2.0", "mcp-server-gcodeclean==0.2.0"];

/// Writes the cases, installs the checkers, counts what they find.
pub(crate) fn run(arguments: &[String]) -> anyhow::Result<ExitCode> {
    if !arguments.is_empty() {
        bail!("competitors takes no arguments");
    }
    let target = workspace::members()?.target_directory.into_std_path_buf();
    let folder = target.join("competitors");
    let cases = folder.join("cases");
    if cases.exists() {
        fs::remove_dir_all(&cases).context("the cases of the last time cannot be removed")?;
    }
    fs::create_dir_all(&cases)?;
    let cargo = env::var_os("CARGO").unwrap_or_else(|| "cargo".into());
    let status = Command::new(cargo)
        .current_dir(workspace::root())
        .args(["test", "--quiet", "--package", "gcheck-tests", "--test", "seeded"])
        .args(["--", "the_cases_are_written"])
        .env("GCHECK_SEEDED_CASES", &cases)
        .status()?;
    ensure!(status.success(), "the cases cannot be written");

    let environment = folder.join("python");
    let python = environment.join("bin/python");
    if !python.exists() {
        let status = Command::new("python3").args(["-m", "venv"]).arg(&environment).status()?;
        ensure!(status.success(), "python3 makes no environment");
    }
    let status = Command::new(&python)
        .args(["-m", "pip", "install", "--quiet", "--ignore-requires-python"])
        .args(PACKAGES)
        .status()?;
    ensure!(status.success(), "pip does not install {PACKAGES:?}");

    let judge = workspace::root().join("crates/xtask/src/competitors/judge.py");
    let output = Command::new(&python).arg(judge).arg(&cases).output()?;
    let errors = String::from_utf8_lossy(&output.stderr);
    ensure!(output.status.success(), "judge.py fails: {errors}");
    let date = Command::new("date").arg("+%Y-%m-%d").output().context("date does not start")?;
    let date = String::from_utf8_lossy(&date.stdout);
    let about = format!(
        "about\tRun on {} by `cargo xtask competitors`. A mistake counts as found when the checker says anything, anywhere in the program, that it does not say about the program without the mistake.\n",
        date.trim()
    );
    let rows = String::from_utf8(output.stdout).context("judge.py writes no text")?;
    fs::write(workspace::root().join(TABLE), about + &rows)?;
    println!(
        "wrote  {TABLE}\nnow write docs/recall.md: UPDATE_EXPECT=1 cargo test -p gcheck-tests --test seeded"
    );
    Ok(ExitCode::SUCCESS)
}
