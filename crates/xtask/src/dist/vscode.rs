//! The VS Code extension as npm packs it, without a server.
//!
//! Knows: `editors/vscode` and npm. Must not know: the server.

use std::fs;
use std::path::Path;
use std::process::Command;

use anyhow::{Context as _, ensure};

use crate::workspace;

/// Packs the extension; needs Node, and the registry of npm where the extension's packages are not installed yet.
pub(super) fn extension(work: &Path) -> anyhow::Result<Vec<u8>> {
    let folder = workspace::root().join("editors/vscode");
    let server = folder.join("server");
    ensure!(!server.exists(), "{} is in the way: move it elsewhere", server.display());
    let modules = folder.join("node_modules");
    if !modules.join("@vscode/vsce").is_dir() {
        // npm is a script on Windows.
        let npm = if cfg!(windows) { "npm.cmd" } else { "npm" };
        run(&folder, npm, &["ci", "--ignore-scripts", "--no-audit", "--no-fund"])?;
    }
    run(&folder, "node", &["build.mjs", "--production"])?;
    let packed = work.join("gcheck-vscode-without-server.vsix");
    let out = packed.display().to_string();
    let vsce = modules.join("@vscode/vsce/vsce").display().to_string();
    run(&folder, "node", &[&vsce, "package", "--no-dependencies", "--skip-license", "--out", &out])?;
    let bytes = fs::read(&packed).with_context(|| packed.display().to_string())?;
    fs::remove_file(&packed)?;
    Ok(bytes)
}

fn run(folder: &Path, program: &str, arguments: &[&str]) -> anyhow::Result<()> {
    let status = Command::new(program).args(arguments).current_dir(folder).status();
    let status = status.with_context(|| format!("{program} does not start"))?;
    ensure!(status.success(), "{program} {} fails", arguments.join(" "));
    Ok(())
}
