//! The name of a preset, with the list of those that there are for the schema.
//!
//! Knows: names and titles. Must not know: what a preset says.

use std::borrow::Cow;

use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::{Deserialize, Deserializer};

/// The name of a preset.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct PresetName(pub String);

impl<'de> Deserialize<'de> for PresetName {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        String::deserialize(deserializer).map(Self)
    }
}

impl JsonSchema for PresetName {
    fn schema_name() -> Cow<'static, str> {
        "Preset".into()
    }

    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        let models: Vec<serde_json::Value> = gcheck_controls::machine_models()
            .iter()
            .map(|model| {
                let file: toml::Table = toml::from_str(model.text).unwrap_or_default();
                let title = file.get("title").and_then(toml::Value::as_str).unwrap_or_default();
                serde_json::json!({ "const": model.name, "description": title })
            })
            .collect();
        json_schema!({ "description": "A model of a machine.", "oneOf": models })
    }
}
