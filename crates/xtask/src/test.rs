//! `cargo xtask test`: everything that CI runs, the test runner last so that its verdict closes the output.
//!
//! Knows: the steps and their tools. Must not know: what is tested.

mod audit;
mod editors;
mod python;
mod tools;

use std::env;
use std::fs;
use std::path::Path;
use std::process::{Command, ExitCode, Stdio};

use anyhow::Context as _;

use crate::{browser_target, workspace};
use tools::{TOOLS, install_from_npm, is_in_path, say};

/// Asks the editor tests for the editors of the system.
const ALL_EDITORS: &str = "GCHECK_ALL_EDITORS";

/// Makes a missing cargo-deny a failure, and a registry of npm without an answer, where the advisories are within reach of
/// the network.
const REQUIRE_ADVISORIES: &str = "GCHECK_REQUIRE_ADVISORIES";

/// Runs hooks of git; an npm package that carries the program.
const LEFTHOOK: &str = "lefthook";
const LEFTHOOK_VERSION: &str = "2.2.2";

/// The SARIF validator, as an npm package with its own runtime.
const SARIF_VALIDATOR: &str = "@microsoft/sarif-multitool-linux";
const SARIF_VALIDATOR_VERSION: &str = "5.7.0";

/// Tells the soak test how many edits and requests to make.
const SOAK: &str = "GCHECK_SOAK";
/// Edits and requests that `--soak` makes at the language server.
const SOAK_ROUNDS: &str = "20000";

/// Runs every step, and all of them whatever fails.
///
/// `--quick` leaves out what takes long; `--editors` runs the editors of the system as well; `--soak` types at the language
/// server for as long as an afternoon does. The rest is for the tests.
pub(crate) fn run(arguments: &[String]) -> anyhow::Result<ExitCode> {
    let is_ours = |argument: &&String| ["--quick", "--editors", "--soak"].contains(&argument.as_str());
    let (ours, for_tests) = arguments.split_at(arguments.iter().take_while(is_ours).count());
    let is_asked = |name: &str| ours.iter().any(|argument| argument == name);
    let quick = is_asked("--quick");
    let mut failed = Vec::new();
    if !quick {
        install_tools()?;
    }
    let mut step = |name: &'static str, arguments: &[&str]| -> anyhow::Result<()> {
        if !cargo(arguments)? {
            failed.push(name);
        }
        Ok(())
    };
    // A toolchain of the profile `minimal` has neither.
    if has_cargo_command("fmt") {
        step("fmt", &["fmt", "--all", "--check"])?;
    } else {
        say("rustfmt is not installed (`rustup component add rustfmt`): formatting is not checked");
    }
    if !quick {
        if has_cargo_command("clippy") {
            step("clippy", &["clippy", "--workspace", "--all-targets", "--", "-D", "warnings"])?;
        } else {
            say("clippy is not installed (`rustup component add clippy`): lints are not checked");
        }
        step("release build", &["build", "--release", "--package", "gcheck"])?;
        failed.extend(failed_advisories()?);
    }
    if !failed.is_empty() {
        say(&format!("failed so far: {}", failed.join(", ")));
    }
    let mut test = vec!["test", "--workspace", "--no-fail-fast"];
    if !for_tests.is_empty() {
        test.push("--");
        test.extend(for_tests.iter().map(String::as_str));
    }
    let mut tests = cargo_command();
    if is_asked("--editors") {
        tests.env(ALL_EDITORS, "1");
    }
    if is_asked("--soak") {
        tests.env(SOAK, SOAK_ROUNDS);
    }
    let passed = succeeds(tests.args(&test))?;
    if !failed.is_empty() {
        say(&format!("failed before the tests: {}", failed.join(", ")));
    }
    Ok(if passed && failed.is_empty() { ExitCode::SUCCESS } else { ExitCode::FAILURE })
}

/// The steps that find advisories, or may not be left out.
fn failed_advisories() -> anyhow::Result<Vec<&'static str>> {
    // `.github/workflows/ci.yml` installs cargo-deny and asks for this; nothing else tells when it no longer does.
    let must = env::var_os(REQUIRE_ADVISORIES).is_some();
    let mut failed = Vec::new();
    let denied = if has_cargo_command("deny") {
        !cargo(&["deny", "check"])?
    } else {
        say(
            "cargo-deny is not installed: advisories are not checked; licences and bans are, by the tests of xtask",
        );
        must
    };
    if denied {
        failed.push("deny");
    }
    if !audit::passes(must) {
        failed.push("npm audit");
    }
    Ok(failed)
}

/// Runs cargo on the workspace; true if it succeeds.
fn cargo(arguments: &[&str]) -> anyhow::Result<bool> {
    succeeds(cargo_command().args(arguments))
}

fn succeeds(command: &mut Command) -> anyhow::Result<bool> {
    let arguments: Vec<_> =
        command.get_args().map(|argument| argument.to_string_lossy().into_owned()).collect();
    say(&format!("cargo {}", arguments.join(" ")));
    let status = command.status().context("cargo does not start")?;
    Ok(status.success())
}

fn cargo_command() -> Command {
    let mut command = Command::new(env::var_os("CARGO").unwrap_or_else(|| "cargo".into()));
    command.current_dir(workspace::root());
    command
}

fn has_cargo_command(name: &str) -> bool {
    let probe =
        cargo_command().args([name, "--version"]).stdout(Stdio::null()).stderr(Stdio::null()).status();
    probe.is_ok_and(|status| status.success())
}

/// Installs what is missing; a tool that cannot be installed is reported and not fatal, because its tests skip
/// themselves.
fn install_tools() -> anyhow::Result<()> {
    python::install(&workspace::root().join(TOOLS));
    install_from_npm(LEFTHOOK, LEFTHOOK_VERSION, "the recipe for lefthook is not tried with it")?;
    install_interpreter();
    install_linter_server();
    install_schema_validator();
    install_browser_target()?;
    install_browser()?;
    editors::install(&workspace::root().join(TOOLS));
    install_validator()
}

/// The Debian package of the LinuxCNC interpreter, `rs274`, that tests compare the engine with.
const INTERPRETER: &str = "linuxcnc-uspace";

fn install_interpreter() {
    if cfg!(target_os = "linux") && !is_in_path("rs274") {
        install_package(INTERPRETER, "rs274", "the engine is not compared with the LinuxCNC interpreter");
    }
}

/// The server that runs linters for editors, by whose recipe the documentation runs gcheck.
const LINTER_SERVER: &str = "efm-langserver";

fn install_linter_server() {
    if cfg!(target_os = "linux") && !is_in_path(LINTER_SERVER) {
        install_package(LINTER_SERVER, LINTER_SERVER, "the recipe for efm-langserver is not tried with it");
    }
}

/// The browser that looks at pages of `gcheck plot`, as a Debian package and by its other names.
const BROWSER: &str = "chromium";
const OTHER_BROWSERS: [&str; 3] = ["chromium-browser", "google-chrome", "google-chrome-stable"];
/// What steers it: an npm package without a browser of its own.
const DRIVER: &str = "playwright-core";
const DRIVER_VERSION: &str = "1.65.1";

fn install_browser() -> anyhow::Result<()> {
    let without = "pages of `gcheck plot` are not looked at in a browser";
    if cfg!(target_os = "linux") && !is_in_path(BROWSER) && !OTHER_BROWSERS.into_iter().any(is_in_path) {
        install_package(BROWSER, BROWSER, without);
    }
    install_from_npm(DRIVER, DRIVER_VERSION, without)?;
    Ok(())
}

/// The program that holds XML against a schema.
const SCHEMA_VALIDATOR: &str = "xmllint";

fn install_schema_validator() {
    if cfg!(target_os = "linux") && !is_in_path(SCHEMA_VALIDATOR) {
        install_package("libxml2-utils", SCHEMA_VALIDATOR, "JUnit output is not held against a schema");
    }
}

/// What the playground is built for.
fn install_browser_target() -> anyhow::Result<()> {
    if browser_target::is_installed()? {
        return Ok(());
    }
    say(&format!("installing the target {} of Rust", browser_target::NAME));
    if !browser_target::install()? {
        say("rustup could not add it (it needs a network): the playground is not tried in a browser");
    }
    Ok(())
}

/// Installs a Debian package for the sake of a program in it; says what is left out without it.
fn install_package(package: &str, program: &str, without: &str) {
    if !is_in_path("apt-get") {
        say(&format!("{program} (Debian's {package}) is not installed and there is no apt-get: {without}"));
        return;
    }
    say(&format!("installing {package}"));
    let apt = |arguments: &[&str]| {
        let mut command = Command::new("apt-get");
        command
            .args(arguments)
            .env("DEBIAN_FRONTEND", "noninteractive")
            .stdin(Stdio::null())
            .stdout(Stdio::null());
        command.status().is_ok_and(|status| status.success())
    };
    // Only root may; the package's name is looked up in lists that may be old or missing.
    let is_installed = apt(&["update"]) && apt(&["install", "-y", "--no-install-recommends", package]);
    if !is_installed || !is_in_path(program) {
        say(&format!("apt-get could not install {package} (root may): {without}"));
    }
}

fn install_validator() -> anyhow::Result<()> {
    let without = "SARIF output is not validated";
    if !cfg!(all(target_os = "linux", target_arch = "x86_64")) {
        say(&format!("the SARIF validator is made for Linux on x86-64: {without} here"));
        return Ok(());
    }
    if let Some(package) = install_from_npm(SARIF_VALIDATOR, SARIF_VALIDATOR_VERSION, without)? {
        make_executable(&package.join("Sarif.Multitool"))?;
    }
    Ok(())
}

/// npm unpacks the program without its permission to run, because install scripts are off.
fn make_executable(program: &Path) -> anyhow::Result<()> {
    #[cfg(unix)]
    {
        use std::os::unix::fs::PermissionsExt as _;
        fs::set_permissions(program, fs::Permissions::from_mode(0o755))
            .with_context(|| program.display().to_string())?;
    }
    Ok(())
}
