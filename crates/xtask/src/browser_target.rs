//! The target of Rust that modules for browsers are built for.
//!
//! Knows: its name, whether it is installed, how rustup adds it. Must not know: what is built.

use std::env;
use std::path::Path;
use std::process::{Command, Stdio};

use anyhow::Context as _;

use crate::workspace;

/// Its name.
pub(crate) const NAME: &str = "wasm32-unknown-unknown";

/// Can this Rust build modules?
pub(crate) fn is_installed() -> anyhow::Result<bool> {
    let rustc = env::var_os("RUSTC").unwrap_or_else(|| "rustc".into());
    let output = Command::new(rustc)
        .current_dir(workspace::root())
        .args(["--print", "target-libdir", "--target", NAME])
        .output()
        .context("rustc does not start")?;
    let folder = String::from_utf8_lossy(&output.stdout).trim().to_owned();
    Ok(output.status.success() && Path::new(&folder).is_dir())
}

/// Adds it; false where that fails, as without a network.
///
/// `rust-toolchain.toml` does not ask for it: where rustup cannot install it, every cargo command would fail.
pub(crate) fn install() -> anyhow::Result<bool> {
    let mut rustup = Command::new("rustup");
    rustup.args(["target", "add", NAME]).current_dir(workspace::root()).stdin(Stdio::null());
    let is_added = rustup.status().is_ok_and(|status| status.success());
    Ok(is_added && is_installed()?)
}
