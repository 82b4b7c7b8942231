//! `gcheck init`: a `gcheck.toml` with comments.
//!
//! Knows: the text of a first configuration. Must not know: what its keys do.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use crate::args::Global;
use crate::config::{Configs, FILE_NAMES, validate_control};
use crate::{Problem, discovery, output, reading};

/// Programs that are looked at to find the control of the folder.
const LOOKED_AT: usize = 50;

/// Writes the file; refuses to write over one.
pub(crate) fn run(global: &Global) -> Result<u8, Problem> {
    if let Some(existing) = FILE_NAMES.iter().map(Path::new).find(|path| path.symlink_metadata().is_ok()) {
        return Err(Problem::with_file(existing, "is here already; it was left as it is"));
    }
    let (control, why) = match &global.control {
        Some(name) => {
            validate_control(name).map_err(Problem::new)?;
            (Some(name.clone()), String::new())
        }
        None => {
            let (control, programs) = most_common_control()?;
            let why = control
                .as_ref()
                .map_or_else(String::new, |_| format!("  # detected from {programs} of the programs here"));
            (control, why)
        }
    };
    let line = match &control {
        Some(name) => format!("control = \"{name}\"{why}"),
        None => format!("# control = \"{}\"", gcheck_controls::fallback()),
    };
    let names = gcheck_controls::names().join(", ");
    let text = TEMPLATE.replace("{control}", &line).replace("{names}", &names);
    let path = Path::new(FILE_NAMES.first().copied().unwrap_or_default());
    output::to_file(path, |out| out.write_all(text.as_bytes()))?;
    output::print(&format!("wrote {}\n", path.display()))
}

/// The control that most programs of the folder show, and how many do.
fn most_common_control() -> Result<(Option<String>, usize), Problem> {
    let mut configs = Configs::new(&[], true)?;
    let found = discovery::find(&[PathBuf::from(".")], &mut configs);
    let mut counts: BTreeMap<String, usize> = BTreeMap::new();
    for path in found.files.iter().take(LOOKED_AT) {
        let Ok(source) = reading::file(path) else { continue };
        if let Some(guess) = gcheck_controls::guess(&gcheck_rules::collect_evidence(&source)) {
            *counts.entry(guess.control).or_default() += 1;
        }
    }
    let most = counts.into_iter().max_by_key(|(_, count)| *count);
    Ok(most.map_or((None, 0), |(name, count)| (Some(name), count)))
}

const TEMPLATE: &str = r#"# Configuration of gcheck for the programs in this folder and below.
# `gcheck schema` prints every key; `gcheck check --show-settings` what is in force for a program.

# The control that runs the programs: {names}.
{control}

# The machine. Lengths are in `units`.
[machine]
# name = "VF-2"
# axes = ["X", "Y", "Z"]
# units = "inch"
# rapid = 1000.0
# tool_change_seconds = 4.0

# Settings of the control that change what a program means, as its page words them.
[settings]
# 162 = true        # X1 is X1.

# What is measured at the machine; `gcheck run` and `gcheck stats` say what they lack.
[offsets]
# G54 = { X = -15.0, Y = -8.0, Z = 0.0 }

[tools]
# 1 = { length = 4.5, diameter = 0.5 }

# M codes of the shop and aliases of macros, so that they are known.
[codes]
# M51 = { title = "air blast on" }
# G150 = { alias = "O9010" }

# Folders with called programs, besides the program's own.
[search]
# paths = ["macros/"]

[rules]
# select = ["recommended"]
# missing-decimal-point = "info"

# How `gcheck fmt` writes programs; what is left out follows the customs of the control.
[format]
# leading-zeros = "add"      # G01
# comment-column = 40

# Rules that are off for some programs.
[per-file-ignores]
# "legacy/**" = ["words"]

# [[overrides]]
# files = ["lathe/**"]
# control = "…"
"#;
