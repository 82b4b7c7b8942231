//! The JSON schema of what `json` and `jsonl` print.
//!
//! Knows: that the schema follows the types. Must not know: any member of a finding.

use schemars::generate::SchemaSettings;

use super::json::JsonReport;
use super::jsonl::Line;

/// The JSON schema of `json`; `$defs/Line` is that of a line of `jsonl`.
pub fn findings_schema() -> String {
    let settings = SchemaSettings::draft2020_12().for_serialize();
    let mut generator = settings.into_generator();
    generator.subschema_for::<Line<'_>>();
    let schema = generator.into_root_schema_for::<JsonReport<'_>>();
    let mut text = serde_json::to_string_pretty(&schema).unwrap_or_default();
    text.push('\n');
    text
}
