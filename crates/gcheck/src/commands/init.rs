//! `gcheck init`: a `gcheck.toml` with comments.
//!
//! Knows: the text of a first configuration. Must not know: what its keys do.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use crate::args::Global;
use crate::config::{Configs, FILE_NAMES, SCHEMA_FILE, validate_control};
use crate::{Problem, config, detection, discovery, output, reading};

/// Programs that are looked at to find the control of the folder, at most.
const LOOKED_AT: usize = 200;

/// Writes the file, and the schema that it names if `with_schema`; refuses to write over one.
pub(crate) fn run(global: &Global, with_schema: bool) -> Result<u8, Problem> {
    let names = FILE_NAMES.iter().chain(with_schema.then_some(&SCHEMA_FILE));
    if let Some(existing) = names.map(Path::new).find(|path| path.symlink_metadata().is_ok()) {
        return Err(Problem::with_file(existing, "is here already; it was left as it is"));
    }
    let (line, remark, control) = match &global.control {
        Some(name) => {
            validate_control(name).map_err(Problem::new)?;
            (format!("control = \"{name}\""), format!("the control is {name}"), Some(name.clone()))
        }
        None => {
            let counts = detected()?;
            let control = agreed(&counts).map(|(name, _)| name.clone());
            (control_line(&counts), remark(&counts), control)
        }
    };
    let names = gcheck_controls::names().join(", ");
    let setting = setting_line(control.as_deref());
    let schema = if with_schema { format!("#:schema ./{SCHEMA_FILE}\n") } else { String::new() };
    let text = TEMPLATE
        .replace("{schema}", &schema)
        .replace("{control}", &line)
        .replace("{setting}", &setting)
        .replace("{names}", &names);
    let path = Path::new(FILE_NAMES.first().copied().unwrap_or_default());
    output::to_file(path, |out| out.write_all(text.as_bytes()))?;
    if with_schema {
        output::to_file(Path::new(SCHEMA_FILE), |out| out.write_all(config::schema().as_bytes()))?;
    }
    let beside = if with_schema { format!(" and {SCHEMA_FILE}") } else { String::new() };
    output::print(&format!("wrote {}{beside}: {remark}\nnext: `gcheck check`\n", path.display()))
}

/// The controls that programs of the folder show of themselves, with how many do.
fn detected() -> Result<BTreeMap<String, usize>, Problem> {
    let mut configs = Configs::new(&[], true)?;
    let found = discovery::find(&[PathBuf::from(".")], &mut configs);
    let mut counts: BTreeMap<String, usize> = BTreeMap::new();
    // From everywhere in the folder: neighbours are often for one machine.
    let step = found.files.len().div_ceil(LOOKED_AT).max(1);
    for path in found.files.iter().step_by(step) {
        let Ok(source) = reading::file(path) else { continue };
        if let Some(guess) = detection::detected(path, source.text()) {
            *counts.entry(guess.control).or_default() += 1;
        }
    }
    Ok(counts)
}

/// The control that nine of ten programs show.
fn agreed(counts: &BTreeMap<String, usize>) -> Option<(&String, usize)> {
    let all: usize = counts.values().sum();
    let (name, count) = counts.iter().max_by_key(|(_, count)| **count)?;
    (count * 10 >= all * 9).then_some((name, *count))
}

/// What the user should know about the control of the new file.
fn remark(counts: &BTreeMap<String, usize>) -> String {
    match agreed(counts) {
        Some((name, 1)) => format!("the control is {name}, detected from 1 program"),
        Some((name, count)) => format!("the control is {name}, detected from {count} programs"),
        None if counts.is_empty() => {
            "write the control into it, because no program here shows one (`gcheck controls` lists them)"
                .to_owned()
        }
        None => "the programs here look like those of several controls, and it lists them".to_owned(),
    }
}

/// A setting of the control as an example: the one that decides about decimal points, where there is one.
fn setting_line(control: Option<&str>) -> String {
    let control = gcheck_controls::load(control.unwrap_or_else(|| gcheck_controls::fallback())).ok();
    let example = control.as_ref().and_then(|control| {
        let decides = control.numbers().unpointed_setting.as_deref();
        decides.and_then(|number| control.setting(number)).or_else(|| control.settings().first())
    });
    let Some(setting) = example else {
        return "# gcheck reads none of this control.".to_owned();
    };
    let value = setting.as_written.as_ref().or(setting.default.as_ref()).or_else(|| setting.values.first());
    let value = value.map_or("…", String::as_str);
    format!("# \"{}\" = \"{value}\"  # {}", setting.number, setting.title)
}

/// Says the control where the programs agree on one. Where they do not, a line for all would be wrong for many of them.
fn control_line(counts: &BTreeMap<String, usize>) -> String {
    if let Some((name, count)) = agreed(counts) {
        return format!("control = \"{name}\"  # detected from {count} of the programs here");
    }
    let Some((name, _)) = counts.iter().max_by_key(|(_, count)| **count) else {
        return format!("# control = \"{}\"", gcheck_controls::fallback());
    };
    let mut counts: Vec<(&String, &usize)> = counts.iter().collect();
    counts.sort_by_key(|(_, count)| std::cmp::Reverse(**count));
    let list: Vec<String> = counts.iter().map(|(name, count)| format!("{name} ({count})")).collect();
    format!(
        "# The programs here look like several: {}.\n\
         # Without this line each is read as what it looks like; `[[overrides]]` below says it for a folder.\n\
         # control = \"{name}\"",
        list.join(", ")
    )
}

const TEMPLATE: &str = r#"{schema}# Configuration of gcheck for the programs in this folder and below.
# `gcheck schema` prints every key (`gcheck init --schema` has editors read it); `gcheck check --show-settings` what is in force for a program.

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
{setting}

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
# select = ["recommended"]  # also "strict", "restart-safe", "house-style"
# missing-decimal-point = "info"

# How `gcheck fmt` writes programs; what is left out follows the customs of the control.
[format]
# leading-zeros = "add"      # G01
# comment-column = 40

# Rules that are off for some programs.
[per-file-ignores]
# "legacy/**" = ["words"]

# What holds for some programs only.
# [[overrides]]
# files = ["lathe/**"]
# control = "…"
"#;
