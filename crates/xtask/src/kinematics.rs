//! `cargo xtask kinematics`: where LinuxCNC's kinematics of five axes put the linear axes, in `fixtures/kinematics/measured.tsv`.
//!
//! Knows: the script that asks them. Must not know: what gcheck says of the same tips; the test `measured_kinematics` of
//! `gcheck-geometry` compares the two.

use std::fs;
use std::process::{Command, ExitCode};

use anyhow::{Context as _, bail, ensure};

use crate::{headless, workspace};

const SCRIPT: &str = include_str!("kinematics/follow.py");
const TABLE: &str = "fixtures/kinematics/measured.tsv";

/// Asks, and writes the table.
pub(crate) fn run(arguments: &[String]) -> anyhow::Result<ExitCode> {
    if !arguments.is_empty() {
        bail!("kinematics takes no arguments");
    }
    let folder = tempfile::tempdir()?;
    let script = headless::write(folder.path(), "follow.py", SCRIPT)?;
    let output = Command::new("python3").arg(&script).output().context("`python3` does not start")?;
    ensure!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let table = workspace::root().join(TABLE);
    if let Some(folder) = table.parent() {
        fs::create_dir_all(folder)?;
    }
    fs::write(table, output.stdout)?;
    println!("wrote  {TABLE}");
    Ok(ExitCode::SUCCESS)
}
