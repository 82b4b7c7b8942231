//! `gcheck machine list` and `gcheck machine show`: the models of machines that a configuration inherits by name.
//!
//! Knows: what a list and a table of a model show. Must not know: any model.

use std::fmt::Write as _;

use serde::Serialize;

use super::{columns, json};
use crate::args::{ListFormat, ListOptions};
use crate::config::Preset;
use crate::nearest::did_you_mean;
use crate::{Problem, output};

/// A model in JSON.
#[derive(Debug, Serialize)]
struct Row {
    name: &'static str,
    title: String,
    extent: String,
    /// The keys of `[machine]` that it gives.
    keys: Vec<String>,
}

/// What the unit of a table is, beside a preset.
const UNITS: &str = "  # of the lengths below; a preset leaves the unit of the file as it is";

/// Prints the list.
pub(crate) fn list(options: &ListOptions) -> Result<u8, Problem> {
    let mut rows = Vec::new();
    for model in gcheck_controls::machine_models() {
        let Some(preset) = Preset::of(model.name) else { continue };
        rows.push(Row {
            name: model.name,
            title: preset.title,
            extent: preset.extent,
            keys: preset.sources.into_keys().filter(|key| key != "extent").collect(),
        });
    }
    match options.output_format {
        ListFormat::Json => output::print(&json(&rows)?),
        ListFormat::Text => {
            let row = |r: &Row| vec![r.name.to_owned(), r.title.clone(), r.keys.join(", ")];
            output::print(&columns(&rows.iter().map(row).collect::<Vec<_>>()))
        }
    }
}

/// Prints one model.
pub(crate) fn show(name: &str) -> Result<u8, Problem> {
    let Some(model) = gcheck_controls::machine_models().iter().find(|model| model.name == name) else {
        let names = gcheck_controls::machine_models().iter().map(|model| model.name);
        let near = did_you_mean(name, names);
        let list =
            if near.is_empty() { "; `gcheck machine list` shows what there is".to_owned() } else { near };
        return Err(Problem::new(format!("no machine is called `{name}`{list}")));
    };
    let own_mistake = |what: &str| Problem::new(format!("the file of the machine `{name}` {what}"));
    let preset = Preset::of(name).ok_or_else(|| own_mistake("cannot be read"))?;
    let file: toml_edit::DocumentMut = model.text.parse().map_err(|_| own_mistake("is not TOML"))?;
    let table = file.get("machine").and_then(toml_edit::Item::as_table_like);
    let mut text = format!("# {}\n[machine]\n", preset.title);
    // Writing to a string cannot fail.
    let _ = writeln!(text, "# preset = \"{name}\" gives the same, below what else is here");
    for (key, value) in table.into_iter().flat_map(toml_edit::TableLike::iter) {
        let source = preset.sources.get(key).map_or_else(String::new, |source| format!("  # {source}"));
        // A preset has no other unit than that of its own lengths.
        let source = if key == "units" { UNITS.to_owned() } else { source };
        match value.as_table_like() {
            // `travel.X` and the like are shown as they are written.
            Some(axes) if !value.is_inline_table() => {
                for (axis, value) in axes.iter() {
                    let _ = writeln!(text, "{key}.{axis} = {}{source}", value.to_string().trim());
                }
            }
            _ => {
                let _ = writeln!(text, "{key} = {}{source}", value.to_string().trim());
            }
        }
    }
    if !preset.sources.contains_key("travel") {
        let source = preset.sources.get("extent").map_or("", String::as_str);
        let _ = writeln!(
            text,
            "# the axes go {} ({source}); write `travel` with the ends in machine coordinates",
            preset.extent
        );
    }
    output::print(&text)
}
