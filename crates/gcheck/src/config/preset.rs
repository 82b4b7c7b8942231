//! Presets: what is published of models of machines, which `[machine] preset` takes over by name.
//!
//! Knows: the shape of their files, how a configuration inherits one. Must not know: any model, what its figures are used for.

use std::collections::BTreeMap;

use serde::Deserialize;

use super::execution_facts::ExecutionFacts;
use super::file::MachineTable;
use super::text::Text;
use crate::Problem;
use crate::nearest::did_you_mean;

/// What is published of a model.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Preset {
    /// For people.
    pub title: String,
    /// How far the axes go. Where the ends lie in machine coordinates is seldom published.
    pub extent: String,
    /// The keys of `[machine]`, in its own units.
    pub machine: MachineTable,
    /// Where each key is from.
    pub sources: BTreeMap<String, String>,
}

impl Preset {
    /// The preset of a name; `None` where there is none, which cannot be for a name of the list: a test reads all.
    pub fn of(name: &str) -> Option<Self> {
        let model = gcheck_controls::machine_models().iter().find(|model| model.name == name)?;
        toml::from_str(model.text).ok()
    }

    /// What a table inherits, to count below its own values; nothing where it names no preset.
    pub(super) fn inherited(table: &MachineTable, text: Text<'_>) -> Result<Option<ExecutionFacts>, Problem> {
        let Some(named) = &table.preset else { return Ok(None) };
        let name = &named.value.0;
        let Some(preset) = Self::of(name) else {
            let known = gcheck_controls::machine_models().iter().map(|model| model.name);
            let near = did_you_mean(name, known);
            let list =
                if near.is_empty() { "; `gcheck machine list` shows what there is".to_owned() } else { near };
            return Err(text.problem(named, format!("no preset is called `{name}`{list}")));
        };
        Ok(Some(ExecutionFacts {
            units: preset.machine.units,
            is_preset: true,
            machine: preset.machine,
            ..ExecutionFacts::default()
        }))
    }
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use super::Preset;
    use crate::config::text::Text;
    use crate::config::validate::Checked;

    #[test]
    fn every_preset_can_be_read_and_tells_the_source_of_each_value() {
        for model in gcheck_controls::machine_models() {
            let preset: Preset =
                toml::from_str(model.text).unwrap_or_else(|error| panic!("{}: {error}", model.name));
            let file: toml::Table = toml::from_str(model.text).unwrap();
            let keys = file["machine"].as_table().unwrap().keys().map(String::as_str);
            for key in keys.filter(|key| *key != "units").chain(["extent"]) {
                assert!(preset.sources.contains_key(key), "{}: {key} has no source", model.name);
            }
            assert!(preset.machine.units.is_some(), "{}: its lengths have no unit", model.name);
            let unused: Vec<&String> = preset
                .sources
                .keys()
                .filter(|key| *key != "extent" && !file["machine"].as_table().unwrap().contains_key(*key))
                .collect();
            assert!(unused.is_empty(), "{}: sources of nothing: {unused:?}", model.name);
            let text = Text { name: model.name, text: model.text, folder: Path::new("/") };
            let checked = Checked::new(text, None).unwrap().machine(&preset.machine, true);
            assert!(checked.is_ok(), "{}", checked.err().unwrap());
        }
    }
}
