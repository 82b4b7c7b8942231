//! The shape of `gcheck.toml`: every key, its type, its meaning. The JSON schema is made from these structs.
//!
//! Knows: keys and types. Must not know: files, inheritance between configurations, whether a name exists (see
//! [`super::validate`]).

use std::collections::BTreeMap;
use std::fmt;

use gcheck_diagnostics::Severity;
use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::de::{self, MapAccess, Visitor};
use serde::{Deserialize, Deserializer};
use serde_json::Value;

use super::listed_names::{ControlName, RuleSelector, list_rules};
use super::{FormatTable, Placed, PresetName};

/// Configuration of gcheck: `gcheck.toml` or `.gcheck.toml` in the folder of the programs or above it.
#[derive(Debug, Clone, Default, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, rename_all = "kebab-case", default)]
#[schemars(title = "gcheck.toml")]
pub struct ConfigFile {
    /// Another configuration that this one builds on; a path from this file's folder. What is here wins.
    pub extend: Option<Placed<String>>,
    /// The control that runs the programs. `gcheck controls` lists the names. Without it the control is detected.
    #[schemars(with = "Option<ControlName>")]
    pub control: Option<Placed<String>>,
    /// The machine: axes, travels, limits.
    pub machine: MachineTable,
    /// The control's own numbered settings, values as its page words them: `162 = false`, `34 = 6.0`, `40 = "diameter"`.
    pub settings: BTreeMap<Placed<String>, Placed<Scalar>>,
    /// Macro variables and named parameters set before a program starts: `"#3100" = 2.5`, `"#<name>" = 1`.
    pub variables: BTreeMap<Placed<String>, f64>,
    /// Work offsets in machine coordinates: `G54 = { X = -400.0, Y = -200.0 }`. An axis that is left out is zero.
    pub offsets: BTreeMap<Placed<String>, BTreeMap<Placed<String>, f64>>,
    /// Tools by number, or `table = "tool.tbl"`: then there are no others.
    pub tools: ToolsTable,
    /// Codes of the shop: M codes of the builder, aliases of macros.
    pub codes: BTreeMap<Placed<String>, CodeTable>,
    /// Where called programs live.
    pub search: SearchTable,
    /// Which rules run, and how severe they are.
    pub rules: RulesTable,
    /// Rules that are off for some files: `"legacy/**" = ["words"]`. Patterns count from this file's folder; one without
    /// a slash fits file names in any folder.
    #[schemars(with = "BTreeMap<String, Vec<RuleSelector>>")]
    pub per_file_ignores: BTreeMap<Placed<String>, Vec<Placed<String>>>,
    /// Differences for some files, the later ones over the earlier.
    pub overrides: Vec<OverrideTable>,
    /// Which files of a folder are read.
    pub files: FilesTable,
    /// How `gcheck fmt` writes programs.
    pub format: FormatTable,
}

/// What differs for the files that fit a pattern. Keys without a description here have that of [`ConfigFile`], which
/// [`describe_overrides`] copies.
#[derive(Debug, Clone, Default, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, rename_all = "kebab-case", default)]
#[schemars(rename = "Override", description = "What differs for the files that fit a pattern.")]
#[expect(missing_docs, reason = "the schema takes them from the keys of the file")]
pub struct OverrideTable {
    /// Patterns as in `per-file-ignores`.
    #[schemars(required)]
    pub files: Vec<Placed<String>>,
    #[schemars(with = "Option<ControlName>")]
    pub control: Option<Placed<String>>,
    pub machine: MachineTable,
    pub settings: BTreeMap<Placed<String>, Placed<Scalar>>,
    pub variables: BTreeMap<Placed<String>, f64>,
    pub offsets: BTreeMap<Placed<String>, BTreeMap<Placed<String>, f64>>,
    pub tools: ToolsTable,
    pub codes: BTreeMap<Placed<String>, CodeTable>,
    pub search: SearchTable,
    pub rules: RulesTable,
    pub format: FormatTable,
}

/// Gives the keys of an override the descriptions that the same keys of the file have.
pub(super) fn describe_overrides(schema: &mut Schema) {
    let described = schema.get("properties").and_then(Value::as_object).cloned().unwrap_or_default();
    let overrides = schema.pointer_mut("/$defs/Override/properties").and_then(Value::as_object_mut);
    for (key, property) in overrides.into_iter().flatten() {
        let description = described.get(key).and_then(|key| key.get("description"));
        if let (Some(property), Some(description)) = (property.as_object_mut(), description) {
            property.entry("description").or_insert_with(|| description.clone());
        }
    }
}

/// `[machine]`.
#[derive(Debug, Clone, Default, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
#[schemars(rename = "Machine")]
pub struct MachineTable {
    /// A model whose published figures count below those of this table; `gcheck machine list` shows what there is.
    pub preset: Option<Placed<PresetName>>,
    /// The machine's name, for people.
    pub name: Option<String>,
    /// Axes the machine has: `["X", "Y", "Z", "A"]`.
    pub axes: Option<Placed<Vec<Placed<String>>>>,
    /// Unit of every length in this file, and the one active at power-on. No G20 or G21 reinterprets it.
    pub units: Option<Units>,
    /// Unit in which the control keeps its offsets and tools, and in which a tool table on disk is read; `units` without it.
    pub table_units: Option<Units>,
    /// Ends of travel by axis, in machine coordinates and `units`: `travel.X = [-762.0, 0.0]`.
    pub travel: BTreeMap<Placed<String>, Placed<[f64; 2]>>,
    /// Highest spindle speed, in 1/min.
    pub max_rpm: Option<Placed<f64>>,
    /// Highest feed rate, in `units` a minute.
    pub max_feed: Option<Placed<f64>>,
    /// Rapid traverse of the linear axes, in `units` a minute; or by axis, `{ X = 25400.0, Z = 18000.0 }`.
    pub rapid: Option<Placed<ByAxis>>,
    /// Rapid traverse of the rotary axes, in degrees a minute.
    pub rotary_rapid: Option<Placed<f64>>,
    /// Position of the feed override switch that times are computed for, in percent; 100 without it.
    pub feed_override: Option<Placed<f64>>,
    /// Position of the rapid override switch that times are computed for, in percent; 100 without it.
    pub rapid_override: Option<Placed<f64>>,
    /// Acceleration of the linear axes, in `units` a second squared; or by axis, with degrees for the rotary ones. With it
    /// times come from a planner; without it they are a lower bound.
    pub acceleration: Option<Placed<ByAxis>>,
    /// Jerk of the linear axes, in `units` a second cubed; or by axis. Without it acceleration changes at once.
    pub jerk: Option<Placed<ByAxis>>,
    /// Seconds that the control takes to prepare a block: 0.0005 for 2,000 blocks a second.
    pub block_time: Option<Placed<f64>>,
    /// Stretches of path that the control looks ahead, in place of what is known of it.
    pub look_ahead: Option<Placed<u32>>,
    /// By how much the speed of an axis may change at a corner, in `units` a minute, on a control that slows down for it.
    pub corner_speed_change: Option<Placed<f64>>,
    /// What the spindle gains or loses, in 1/min a second.
    pub spindle_acceleration: Option<Placed<f64>>,
    /// Duration of turning the spindle to an angle, from rest, in seconds.
    pub spindle_orient_seconds: Option<Placed<f64>>,
    /// Duration of an auxiliary function (coolant, chuck, codes of the shop), in seconds.
    pub auxiliary_seconds: Option<Placed<f64>>,
    /// Duration of a tool change, in seconds.
    pub tool_change_seconds: Option<Placed<f64>>,
    /// Seconds that the magazine takes to pass one pocket.
    pub pocket_seconds: Option<Placed<f64>>,
    /// Pockets around the magazine.
    pub pockets: Option<Placed<u32>>,
    /// How tools come from the magazine.
    pub tool_changer: Option<ToolChanger>,
    /// Where the rotary axes sit.
    pub rotary: Option<Placed<Rotary>>,
    /// Rotary axes from the machine outward; as written in `axes` without it.
    pub rotary_order: Option<Vec<Placed<String>>>,
    /// Sense of rotation by axis, 1 or -1.
    pub rotary_sign: BTreeMap<Placed<String>, Placed<i8>>,
    /// The line that a rotary axis turns about at zero angles, by its parts along X, Y and Z and of any length:
    /// `{ B = [0.0, 1.0, 1.0] }` for a head at 45 degrees. Without it A turns about X, B about Y and C about Z.
    pub rotary_direction: BTreeMap<Placed<String>, Placed<[f64; 3]>>,
    /// From the pivot of a tilting head to the spindle nose, in `units`.
    pub pivot_length: Option<Placed<f64>>,
    /// Where the rotary axes of the table meet, in machine coordinates: `{ X = -381.0, Y = -203.2, Z = -550.0 }`.
    pub rotary_centre: BTreeMap<Placed<String>, Placed<f64>>,
    /// From the first rotary axis to the second, in `units`, where both turn the same side and do not meet: `{ Y = 35.0 }`.
    /// `rotary_centre` is then a point on the first axis.
    pub rotary_offset: BTreeMap<Placed<String>, Placed<f64>>,
    /// Rotary axes that reach an angle the shorter way round.
    pub rotary_shorter_way: Option<Vec<Placed<String>>>,
    /// Length of a new bar in `units`, for a lathe with a bar feeder.
    pub bar_length: Option<Placed<f64>>,
    /// Bars to be used up, the one in the chuck among them: `run` and `stats` repeat a main program that feeds bar until then.
    pub bars: Option<Placed<u32>>,
}

/// A number for all linear axes, or one by axis.
#[derive(Debug, Clone, PartialEq)]
pub enum ByAxis {
    /// For all linear axes.
    All(f64),
    /// By axis.
    Each(BTreeMap<Placed<String>, Placed<f64>>),
}

impl<'de> Deserialize<'de> for ByAxis {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(ByAxisVisitor)
    }
}

struct ByAxisVisitor;

impl<'de> Visitor<'de> for ByAxisVisitor {
    type Value = ByAxis;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a number, or a table of numbers by axis")
    }

    #[expect(clippy::cast_precision_loss, reason = "no machine is as fast")]
    fn visit_i64<E: de::Error>(self, value: i64) -> Result<ByAxis, E> {
        Ok(ByAxis::All(value as f64))
    }

    fn visit_f64<E: de::Error>(self, value: f64) -> Result<ByAxis, E> {
        Ok(ByAxis::All(value))
    }

    fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<ByAxis, A::Error> {
        let mut each = BTreeMap::new();
        while let Some((axis, value)) = map.next_entry()? {
            each.insert(axis, value);
        }
        Ok(ByAxis::Each(each))
    }
}

impl JsonSchema for ByAxis {
    fn schema_name() -> std::borrow::Cow<'static, str> {
        "ByAxis".into()
    }

    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        json_schema!({
            "description": "A number for all linear axes, or one by axis.",
            "anyOf": [
                { "type": "number" },
                { "type": "object", "additionalProperties": { "type": "number" } },
            ]
        })
    }
}

/// How tools come from the magazine.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum ToolChanger {
    /// The spindle fetches each tool from the magazine itself, which turns while the machine waits.
    Carousel,
    /// An arm brings the tool that the magazine has turned to meanwhile.
    Arm,
}

/// Unit of lengths.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum Units {
    /// Millimetres.
    Mm,
    /// Inches.
    Inch,
}

/// Where the rotary axes sit.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Rotary {
    /// Both turn the tool.
    HeadHead,
    /// One turns the tool, one the part.
    HeadTable,
    /// Both turn the part.
    TableTable,
}

/// A code of the shop.
#[derive(Debug, Clone, Default, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
#[schemars(rename = "Code")]
pub struct CodeTable {
    /// What it does, in a few words.
    pub title: Option<String>,
    /// Modal group; user codes form one of their own.
    pub group: Option<String>,
    /// The program that it calls: `"O9010"`.
    pub alias: Option<Placed<String>>,
}

/// `[search]`.
#[derive(Debug, Clone, Default, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
#[schemars(rename = "Search")]
pub struct SearchTable {
    /// Folders with called programs; paths from this file's folder. The folder of the calling file is always searched.
    pub paths: Vec<Placed<String>>,
}

/// `[files]`.
#[derive(Debug, Clone, Default, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
#[schemars(rename = "Files")]
pub struct FilesTable {
    /// Patterns of the files that are read from a folder, in place of the usual extensions.
    pub include: Option<Vec<Placed<String>>>,
    /// Patterns of files and folders that are passed over. A file named on the command line is read all the same.
    pub exclude: Vec<Placed<String>>,
}

/// `[rules]`: `select`, `ignore`, `extend-select`, and severities by rule or group.
#[derive(Debug, Clone, Default, JsonSchema)]
#[schemars(rename = "Rules", rename_all = "kebab-case", transform = list_rules)]
pub struct RulesTable {
    /// Rules, groups and sets that run, in place of `["recommended"]`.
    #[schemars(with = "Option<Vec<RuleSelector>>")]
    pub select: Option<Vec<Placed<String>>>,
    /// Rules, groups and sets that do not run.
    #[schemars(with = "Option<Vec<RuleSelector>>")]
    pub ignore: Vec<Placed<String>>,
    /// Rules, groups and sets that run as well.
    #[schemars(with = "Option<Vec<RuleSelector>>")]
    pub extend_select: Vec<Placed<String>>,
    /// A rule or group that runs with this severity, or is `"off"`.
    #[schemars(flatten)]
    pub severities: BTreeMap<Placed<String>, Level>,
}

/// Severity of a rule in a configuration.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum Level {
    /// The rule does not run.
    Off,
    /// Style.
    Hint,
    /// Worth knowing.
    Info,
    /// A likely crash, scrap or trap.
    Warning,
    /// The control alarms, or the move is certainly wrong.
    Error,
}

impl Level {
    /// The severity, `None` when off.
    pub fn severity(self) -> Option<Severity> {
        match self {
            Self::Off => None,
            Self::Hint => Some(Severity::Hint),
            Self::Info => Some(Severity::Info),
            Self::Warning => Some(Severity::Warning),
            Self::Error => Some(Severity::Error),
        }
    }
}

impl<'de> Deserialize<'de> for RulesTable {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_map(RulesVisitor)
    }
}

/// By hand, because `flatten` loses where the keys are.
struct RulesVisitor;

impl<'de> Visitor<'de> for RulesVisitor {
    type Value = RulesTable;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a table")
    }

    fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<RulesTable, A::Error> {
        let mut table = RulesTable::default();
        while let Some(key) = map.next_key::<Placed<String>>()? {
            match key.value.as_str() {
                "select" => table.select = Some(map.next_value()?),
                "ignore" => table.ignore = map.next_value()?,
                "extend-select" => table.extend_select = map.next_value()?,
                _ => {
                    table.severities.insert(key, map.next_value()?);
                }
            }
        }
        Ok(table)
    }
}

/// `[tools]`.
#[derive(Debug, Clone, Default, JsonSchema)]
#[schemars(rename = "Tools")]
pub struct ToolsTable {
    /// A tool table on disk: LinuxCNC's, or CSV; a path from this file's folder.
    pub table: Option<Placed<String>>,
    /// Tools by number.
    #[schemars(flatten)]
    pub tools: BTreeMap<Placed<String>, ToolTable>,
}

/// A tool.
#[derive(Debug, Clone, Default, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
#[schemars(rename = "Tool")]
pub struct ToolTable {
    /// Length offset, in `units`.
    pub length: Option<f64>,
    /// Offsets by axis, in place of `length`: the geometry of a turning tool, `{ X = -3.0, Z = 120.0 }`.
    pub offset: BTreeMap<Placed<String>, f64>,
    /// Length of the tool that programs were posted for, where `length` corrects for another one along a tilting head.
    pub posted_length: Option<f64>,
    /// Diameter, in `units`.
    pub diameter: Option<f64>,
    /// Radius at the corner of the tip, in `units`.
    pub corner_radius: Option<f64>,
    /// Where the tip of a turning tool points, 0 to 9 as the control numbers it.
    pub orientation: Option<Placed<u8>>,
    /// Its place in the changer; that of its number without it.
    pub pocket: Option<u32>,
    /// Its teeth: with them the chip load is shown, and held to `chip_load`.
    pub teeth: Option<Placed<u32>>,
    /// The class of material that `chip_load` and `surface_speed` hold for (`"P"`, `"aluminium"`), for people.
    pub material: Option<String>,
    /// Lowest and highest chip load, in `units` a tooth: `[0.02, 0.06]`.
    pub chip_load: Option<Placed<[f64; 2]>>,
    /// Lowest and highest surface speed, in metres a minute, or feet a minute where `units` are inches: `[80.0, 160.0]`.
    pub surface_speed: Option<Placed<[f64; 2]>>,
}

impl<'de> Deserialize<'de> for ToolsTable {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_map(ToolsVisitor)
    }
}

/// By hand, because `flatten` loses where the keys are.
struct ToolsVisitor;

impl<'de> Visitor<'de> for ToolsVisitor {
    type Value = ToolsTable;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a table")
    }

    fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<ToolsTable, A::Error> {
        let mut table = ToolsTable::default();
        while let Some(key) = map.next_key::<Placed<String>>()? {
            if key.value == "table" {
                table.table = Some(map.next_value()?);
            } else {
                table.tools.insert(key, map.next_value()?);
            }
        }
        Ok(table)
    }
}

/// A setting's value in the words of its page: `false` is `off`, `6.0` is `6`, text is lower case.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Scalar(pub String);

impl<'de> Deserialize<'de> for Scalar {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(ScalarVisitor)
    }
}

struct ScalarVisitor;

impl Visitor<'_> for ScalarVisitor {
    type Value = Scalar;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("`true`, `false`, a number or a text")
    }

    fn visit_bool<E: de::Error>(self, value: bool) -> Result<Scalar, E> {
        Ok(Scalar(if value { "on" } else { "off" }.to_owned()))
    }

    fn visit_i64<E: de::Error>(self, value: i64) -> Result<Scalar, E> {
        Ok(Scalar(value.to_string()))
    }

    fn visit_f64<E: de::Error>(self, value: f64) -> Result<Scalar, E> {
        Ok(Scalar(value.to_string()))
    }

    fn visit_str<E: de::Error>(self, value: &str) -> Result<Scalar, E> {
        Ok(Scalar(value.trim().to_lowercase()))
    }
}

impl JsonSchema for Scalar {
    fn inline_schema() -> bool {
        true
    }

    fn schema_name() -> std::borrow::Cow<'static, str> {
        "SettingValue".into()
    }

    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        json_schema!({ "type": ["boolean", "number", "string"] })
    }
}
