//! Running xtask again with the product's crates, or with those that one command needs, built in.
//!
//! Knows: the features of xtask. Must not know: what is read from the product.

use std::env;
use std::process::{Command, ExitCode};

use anyhow::Context as _;

use crate::workspace;

/// True in a build that has the product's crates.
pub(crate) const BUILT_IN: bool = cfg!(feature = "product");

/// Runs an xtask command in a build with the product; `measures` takes the profile of published builds.
pub(crate) fn rerun(command: &str, arguments: &[String], measures: bool) -> anyhow::Result<ExitCode> {
    let mut cargo = Command::new(env::var_os("CARGO").unwrap_or_else(|| "cargo".into()));
    cargo.current_dir(workspace::root()).args(["run", "--quiet", "--package", "xtask"]);
    if measures {
        cargo.args(["--profile", "dist"]);
    }
    let status = cargo.args(["--", command]).args(arguments).status().context("cargo does not start")?;
    Ok(workspace::exit_code(status))
}

/// Runs an xtask command in a build with one feature, such as that for packing releases, and with nothing of the product.
#[cfg(not(all(feature = "packages", feature = "playground")))]
pub(crate) fn rerun_with(feature: &str, command: &str, arguments: &[String]) -> anyhow::Result<ExitCode> {
    let mut cargo = Command::new(env::var_os("CARGO").unwrap_or_else(|| "cargo".into()));
    // From where the user is: paths among the arguments count from there.
    cargo
        .args(["run", "--quiet", "--package", "xtask", "--manifest-path"])
        .arg(workspace::root().join("Cargo.toml"));
    cargo.args(["--no-default-features", "--features", feature, "--", command]).args(arguments);
    Ok(workspace::exit_code(cargo.status().context("cargo does not start")?))
}
