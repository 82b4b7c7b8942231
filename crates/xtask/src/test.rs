//! `cargo xtask test`: everything that CI runs, the test runner last so that its verdict closes the output.
//!
//! Knows: the steps and their tools. Must not know: what is tested.

mod book;

use std::env;
use std::fs;
use std::path::Path;
use std::process::{Command, ExitCode, Stdio};

use anyhow::Context as _;

use crate::workspace;

/// Tools of tests that are no crates, git-ignored. Tests find them there, and skip themselves where they are missing.
const TOOLS: &str = ".test-tools";

/// The SARIF validator, as an npm package with its own runtime.
const SARIF_VALIDATOR: &str = "@microsoft/sarif-multitool-linux";
const SARIF_VALIDATOR_VERSION: &str = "5.7.0";

/// Runs every step, and all of them whatever fails.
pub(crate) fn run(arguments: &[String]) -> anyhow::Result<ExitCode> {
    let quick = arguments.first().is_some_and(|a| a == "--quick");
    let for_tests = if quick { arguments.get(1..).unwrap_or_default() } else { arguments };
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
        if has_cargo_command("deny") {
            step("deny", &["deny", "check"])?;
        } else {
            say(
                "cargo-deny is not installed: advisories are not checked; licences and bans are, by the tests of xtask",
            );
        }
    }
    if !failed.is_empty() {
        say(&format!("failed so far: {}", failed.join(", ")));
    }
    let mut test = vec!["test", "--workspace", "--no-fail-fast"];
    if !for_tests.is_empty() {
        test.push("--");
        test.extend(for_tests.iter().map(String::as_str));
    }
    let passed = cargo(&test)?;
    if !failed.is_empty() {
        say(&format!("failed before the tests: {}", failed.join(", ")));
    }
    Ok(if passed && failed.is_empty() { ExitCode::SUCCESS } else { ExitCode::FAILURE })
}

fn say(message: &str) {
    eprintln!("xtask test: {message}");
}

/// Runs cargo on the workspace; true if it succeeds.
fn cargo(arguments: &[&str]) -> anyhow::Result<bool> {
    say(&format!("cargo {}", arguments.join(" ")));
    let status = cargo_command().args(arguments).status().context("cargo does not start")?;
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

/// Installs what is missing; a tool that cannot be had is said, not fatal, because its tests skip themselves.
fn install_tools() -> anyhow::Result<()> {
    book::install(&workspace::root().join(TOOLS));
    install_interpreter();
    install_validator()
}

/// The Debian package of the LinuxCNC interpreter, `rs274`, that tests compare the engine with.
const INTERPRETER: &str = "linuxcnc-uspace";

fn install_interpreter() {
    if !cfg!(target_os = "linux") || is_in_path("rs274") {
        return;
    }
    let without = "the engine is not compared with the LinuxCNC interpreter";
    if !is_in_path("apt-get") {
        say(&format!("rs274 (Debian's {INTERPRETER}) is not installed and there is no apt-get: {without}"));
        return;
    }
    say(&format!("installing {INTERPRETER}"));
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
    let is_installed = apt(&["update"]) && apt(&["install", "-y", "--no-install-recommends", INTERPRETER]);
    if !is_installed || !is_in_path("rs274") {
        say(&format!("apt-get could not install {INTERPRETER} (root may): {without}"));
    }
}

fn is_in_path(program: &str) -> bool {
    let folders = env::var_os("PATH").unwrap_or_default();
    env::split_paths(&folders).any(|folder| folder.join(program).is_file())
}

fn install_validator() -> anyhow::Result<()> {
    if !cfg!(all(target_os = "linux", target_arch = "x86_64")) {
        say("the SARIF validator is made for Linux on x86-64: SARIF output is not validated here");
        return Ok(());
    }
    let tools = workspace::root().join(TOOLS);
    let package = tools.join("node_modules").join(SARIF_VALIDATOR);
    if is_installed(&package) {
        return Ok(());
    }
    fs::create_dir_all(&tools)?;
    say(&format!("installing {SARIF_VALIDATOR} into {TOOLS}"));
    let install = Command::new("npm")
        .args(["install", "--ignore-scripts", "--no-audit", "--no-fund", "--no-package-lock", "--prefix"])
        .arg(&tools)
        .arg(format!("{SARIF_VALIDATOR}@{SARIF_VALIDATOR_VERSION}"))
        .status();
    match install {
        Ok(status) if status.success() => make_executable(&package.join("Sarif.Multitool")),
        Ok(_) => {
            say("npm could not install the SARIF validator: SARIF output is not validated");
            Ok(())
        }
        Err(_) => {
            say("npm is not installed: SARIF output is not validated");
            Ok(())
        }
    }
}

fn is_installed(package: &Path) -> bool {
    let version = format!("\"version\": \"{SARIF_VALIDATOR_VERSION}\"");
    fs::read_to_string(package.join("package.json")).is_ok_and(|text| text.contains(&version))
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
