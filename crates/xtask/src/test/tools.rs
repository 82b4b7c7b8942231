//! Tools of tests: where they are, and how one is installed.
//!
//! Knows: the folder of tools, npm. Must not know: which tools tests need.

use std::path::PathBuf;
use std::process::Command;
use std::{env, fs};

use crate::workspace;

/// The folder of tools that are not crates, ignored by git. Tests look for their tools there, and skip without them.
pub(super) const TOOLS: &str = ".test-tools";

/// Prints a line on standard error.
pub(super) fn say(message: &str) {
    eprintln!("xtask test: {message}");
}

/// Can the program be started by its name?
pub(super) fn is_in_path(program: &str) -> bool {
    let folders = env::var_os("PATH").unwrap_or_default();
    env::split_paths(&folders).any(|folder| folder.join(program).is_file())
}

/// Installs an npm package into the folder of tools, unless it is there; its folder if it was installed.
pub(super) fn install_from_npm(name: &str, version: &str, without: &str) -> anyhow::Result<Option<PathBuf>> {
    let tools = workspace::root().join(TOOLS);
    let package = tools.join("node_modules").join(name);
    let version_line = format!("\"version\": \"{version}\"");
    if fs::read_to_string(package.join("package.json")).is_ok_and(|text| text.contains(&version_line)) {
        return Ok(None);
    }
    fs::create_dir_all(&tools)?;
    say(&format!("installing {name} into {TOOLS}"));
    let install = Command::new("npm")
        .args(["install", "--ignore-scripts", "--no-audit", "--no-fund", "--no-package-lock", "--prefix"])
        .arg(&tools)
        .arg(format!("{name}@{version}"))
        .status();
    match install {
        Ok(status) if status.success() => return Ok(Some(package)),
        Ok(_) => say(&format!("npm could not install {name}: {without}")),
        Err(_) => say(&format!("npm is not installed: {without}")),
    }
    Ok(None)
}
