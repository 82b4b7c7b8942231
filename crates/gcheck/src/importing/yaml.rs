//! A configuration of FluidNC: axes with rates, accelerations and travels.
//!
//! Knows: the keys `axes`, `max_rate_mm_per_min`, `acceleration_mm_per_sec2`, `max_travel_mm` and those of `homing`, and lines
//! of that YAML: a key and a value, deeper by its indentation. Must not know: other formats, how TOML is written.
//!
//! The travel of an axis ends where it homes: at `mpos_mm`, its upper end where `positive_direction` is true. Rotary axes
//! count degrees under the same keys.

use std::collections::BTreeMap;
use std::ops::Range;

use super::sheet::{Sheet, Tells, Value, is_rotary, lines};
use crate::config::Units;

/// Axes that the control has.
const AXES: [char; 6] = ['X', 'Y', 'Z', 'A', 'B', 'C'];
/// Keys that show the format.
const MARKS: [&str; 2] = ["max_rate_mm_per_min:", "acceleration_mm_per_sec2:"];

/// Does a text look like such a file?
pub(super) fn is_one(text: &str) -> bool {
    text.lines().any(|line| line.trim() == "axes:")
        && text.lines().any(|line| MARKS.iter().any(|mark| line.trim_start().starts_with(mark)))
}

/// A value with its place.
#[derive(Debug, Clone)]
struct Given {
    text: String,
    range: Range<usize>,
}

/// Reads the file.
pub(super) fn read(sheet: &mut Sheet<'_>) {
    sheet.tells = Tells::Machine;
    let given = values(sheet);
    if given.is_empty() {
        return sheet.refuse(&(0..1), "the file has no `axes`");
    }
    let first = given.values().map(|given| given.range.clone()).min_by_key(|range| range.start);
    sheet.put_units(Units::Mm, &first.unwrap_or(0..1));
    if let Some(name) = given.get("name").filter(|name| !name.text.is_empty()) {
        sheet.put(&["machine", "name"], Value::Text(name.text.clone()), &name.range, "name");
    }
    let has = |axis: char| {
        let prefix = format!("axes.{}.", axis.to_ascii_lowercase());
        given.keys().any(|key| key.starts_with(&prefix))
    };
    let axes: Vec<char> = AXES.into_iter().filter(|axis| has(*axis)).collect();
    let names = axes.iter().map(char::to_string).collect();
    let range =
        given.iter().find(|(key, _)| key.starts_with("axes.")).map_or(0..1, |(_, given)| given.range.clone());
    sheet.put(&["machine", "axes"], Value::List(names), &range, "axes");
    for axis in axes {
        one(sheet, axis, &given);
    }
}

/// What the file says of an axis.
fn one(sheet: &mut Sheet<'_>, axis: char, given: &BTreeMap<String, Given>) {
    let prefix = format!("axes.{}", axis.to_ascii_lowercase());
    let name = axis.to_string();
    for (key, target) in [("max_rate_mm_per_min", "rapid"), ("acceleration_mm_per_sec2", "acceleration")] {
        if let Some(value) = given.get(&format!("{prefix}.{key}"))
            && let Some(number) = sheet.positive(&value.text, &value.range, &format!("{key} of {axis}"))
        {
            let place = format!("{prefix}.{key}");
            sheet.put(&["machine", target, &name], Value::of_axis(axis, number), &value.range, &place);
        }
    }
    let Some(travel) = given.get(&format!("{prefix}.max_travel_mm")) else { return };
    let what = format!("max_travel_mm of {axis}");
    let Some(length) = sheet.positive(&travel.text, &travel.range, &what) else { return };
    let of_homing = |key: &str| given.get(&format!("{prefix}.homing.{key}"));
    let homes =
        of_homing("cycle").is_some_and(|cycle| cycle.text.parse::<i32>().is_ok_and(|cycle| cycle >= 0));
    let (Some(home), Some(direction)) = (of_homing("mpos_mm"), of_homing("positive_direction")) else {
        return sheet.leave(
            &travel.range,
            what,
            "the axis does not home, so that nothing tells where its travel ends",
        );
    };
    if !homes {
        return sheet.leave(
            &travel.range,
            what,
            "the axis does not home, so that nothing tells where its travel ends",
        );
    }
    let Some(home) = sheet.number(&home.text, &home.range, &format!("mpos_mm of {axis}")) else { return };
    let both = match direction.text.as_str() {
        "true" => [home - length, home],
        "false" => [home, home + length],
        other => {
            let message = format!("positive_direction of {axis} is `{other}`, not true or false");
            return sheet.refuse(&direction.range, message);
        }
    };
    let value = if is_rotary(axis) { Value::Plain(both) } else { Value::Ends(both) };
    let place = format!("{prefix}.max_travel_mm from where it homes");
    sheet.put(&["machine", "travel", &name], value, &travel.range, &place);
}

/// The values of the file by their path: `axes.x.homing.mpos_mm`. The first of equal keys counts.
fn values(sheet: &Sheet<'_>) -> BTreeMap<String, Given> {
    let mut open: Vec<(usize, String)> = Vec::new();
    let mut values = BTreeMap::new();
    for (start, line) in lines(sheet.text) {
        let told = line.split('#').next().unwrap_or_default().trim_end();
        let text = told.trim_start();
        let Some((key, value)) = text.split_once(':') else { continue };
        let indent = told.len() - text.len();
        open.retain(|(depth, _)| *depth < indent);
        let parents = open.iter().map(|(_, key)| key.as_str());
        let path: Vec<&str> = parents.chain([key.trim()]).collect();
        let value = value.trim().trim_matches(['"', '\'']);
        if !value.is_empty() {
            let range = start + indent..start + told.len();
            values.entry(path.join(".")).or_insert(Given { text: value.to_owned(), range });
        }
        open.push((indent, key.trim().to_owned()));
    }
    values
}
