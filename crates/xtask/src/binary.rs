//! The gcheck binary of this checkout, and its reports.
//!
//! Knows: how it is built and called. Must not know: what a report is read for.

use std::env;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use anyhow::ensure;

use crate::workspace;

/// Builds gcheck and tells where it is; `release` for measurements of time.
pub(crate) fn build(release: bool) -> anyhow::Result<PathBuf> {
    let mut cargo = Command::new(env::var_os("CARGO").unwrap_or_else(|| "cargo".into()));
    cargo.current_dir(workspace::root()).args(["build", "--quiet", "--package", "gcheck"]);
    if release {
        cargo.arg("--release");
    }
    ensure!(cargo.status()?.success(), "the build fails");
    let target = workspace::members()?.target_directory.into_std_path_buf();
    let profile = if release { "release" } else { "debug" };
    Ok(target.join(profile).join(format!("gcheck{}", env::consts::EXE_SUFFIX)))
}

/// What `gcheck check` reports about programs of a folder, as JSON.
pub(crate) fn check(
    gcheck: &Path,
    folder: &Path,
    options: &[&str],
    paths: &[&str],
) -> anyhow::Result<Output> {
    let output = Command::new(gcheck)
        .current_dir(folder)
        .args(["check", "--no-cache", "--output-format", "json"])
        .args(options)
        .arg("--")
        .args(paths)
        .output()?;
    let words = String::from_utf8_lossy(&output.stderr);
    ensure!(matches!(output.status.code(), Some(0 | 1)), "gcheck check {options:?} fails: {words}");
    Ok(output)
}
