//! `cargo xtask blind`: first looks at programs and mistakes that nobody tuned gcheck to.
//!
//! Knows: the order of the protocol (`docs/dev/blind.md`): seal, look once, judge, seal. Must not know: what a verdict should
//! be, any rule or control.

mod look;
mod page;
mod seal;

use std::process::ExitCode;

use anyhow::bail;

pub(crate) use seal::{path as seals, problems as broken_seals};

/// `seal FILE…`, `look NAME`, `page`.
pub(crate) fn run(arguments: &[String]) -> anyhow::Result<ExitCode> {
    let words: Vec<&str> = arguments.iter().map(String::as_str).collect();
    match words.as_slice() {
        ["seal", names @ ..] if !names.is_empty() => seal::seal(names)?,
        #[cfg(feature = "product")]
        ["look", name] => look::look(name)?,
        #[cfg(feature = "product")]
        ["page"] => page::write()?,
        #[cfg(not(feature = "product"))]
        ["look", _] | ["page"] => return crate::product::rerun("blind", arguments, false),
        _ => bail!(
            "blind takes `seal FILE…` (names of tests/blind), `look draw-N`, `look mistakes-N`, or `page`"
        ),
    }
    Ok(ExitCode::SUCCESS)
}
