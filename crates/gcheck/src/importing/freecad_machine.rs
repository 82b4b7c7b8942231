//! A machine of FreeCAD (`.fcm`): axes with limits and velocities, and its spindle.
//!
//! Knows: the keys of that file: `machine` with `name`, `units`, `axes` and `toolheads`; limits count in the unit of the file,
//! velocities in that unit a minute or degrees a minute. Must not know: other formats, how TOML is written.
//!
//! The program gives a new machine limits of 0 to 1000 and velocities of its own; such values say nothing of a machine.

use std::ops::Range;

use serde_json::Value as Json;

use super::json;
use super::sheet::{NO_KEY, Sheet, Tells, Value, is_rotary};
use crate::config::Units;

/// Ends and velocity of a new linear axis.
const NEW_LINEAR: ([f64; 2], f64) = ([0.0, 1000.0], 10_000.0);
/// Ends and velocity of a new rotary axis.
const NEW_ROTARY: ([f64; 2], f64) = ([-360.0, 360.0], 36_000.0);
/// A rotary axis with as much travel, in degrees, has no ends.
const FULL_TURN: f64 = 360.0;
/// Axes that a machine may have.
const AXES: &str = "XYZABCUVW";
/// Why a default is not taken.
const DEFAULT: &str = "it is what FreeCAD gives a new machine, and says nothing of this one";

/// Is it such a file?
pub(super) fn is_one(document: &Json) -> bool {
    document.get("machine").is_some_and(|machine| machine.get("axes").is_some())
}

/// Reads the file.
pub(super) fn read(sheet: &mut Sheet<'_>, document: &Json) {
    let Some(machine) = document.get("machine") else {
        return sheet.refuse(&(0..1), "the file has no `machine`");
    };
    sheet.tells = Tells::Machine;
    match machine.get("units").and_then(Json::as_str) {
        Some("metric") => sheet.put_units(Units::Mm, &place(sheet, "units")),
        Some("imperial") => sheet.put_units(Units::Inch, &place(sheet, "units")),
        Some(other) => {
            let range = place(sheet, "units");
            sheet.refuse(&range, format!("`units` is `{other}`; known are metric and imperial"));
        }
        None => {}
    }
    if let Some(name) = machine.get("name").and_then(Json::as_str).filter(|name| !name.trim().is_empty()) {
        let range = place(sheet, "name");
        sheet.put(&["machine", "name"], Value::Text(name.trim().to_owned()), &range, "name");
    }
    let axes = machine.get("axes").and_then(Json::as_object);
    let mut found: Vec<(usize, char, &Json)> = Vec::new();
    for (name, axis) in axes.into_iter().flat_map(|axes| axes.iter()) {
        match letter(name) {
            Some(letter) => found.push((AXES.find(letter).unwrap_or_default(), letter, axis)),
            None => {
                let range = place(sheet, name);
                sheet.leave(
                    &range,
                    format!("axis `{name}`"),
                    "it is not one of X, Y, Z, A, B, C, U, V and W",
                );
            }
        }
    }
    found.sort_unstable_by_key(|(order, ..)| *order);
    if !found.is_empty() {
        let names = found.iter().map(|(_, letter, _)| letter.to_string()).collect();
        let range = place(sheet, "axes");
        sheet.put(&["machine", "axes"], Value::List(names), &range, "axes");
    }
    for (_, letter, axis) in found {
        let range = place(sheet, &letter.to_string());
        one(sheet, letter, axis, &range);
    }
    toolheads(sheet, machine);
    for key in ["output", "postprocessor", "processing"] {
        if document.get(key).is_some() {
            let range = place(sheet, key);
            sheet.leave(&range, format!("`{key}`"), NO_KEY);
        }
    }
}

/// What the file says of an axis.
fn one(sheet: &mut Sheet<'_>, letter: char, axis: &Json, range: &Range<usize>) {
    let name = letter.to_string();
    let (ends, velocity) = if is_rotary(letter) { NEW_ROTARY } else { NEW_LINEAR };
    let same = |a: f64, b: f64| (a - b).abs() < 1e-9;
    let limits = axis.get("limits");
    let end = |key: &str| limits.and_then(|limits| limits.get(key)).and_then(json::number);
    if let (Some(low), Some(high)) = (end("min"), end("max")) {
        let what = format!("limits of {letter}");
        if same(low, ends[0]) && same(high, ends[1]) {
            sheet.leave(range, what, DEFAULT);
        } else if is_rotary(letter) && high - low >= FULL_TURN {
            sheet.leave(range, what, "the axis turns all the way round, and has no end of travel");
        } else if low >= high {
            sheet.refuse(range, format!("{what}: max is {high}, which is not above min ({low})"));
        } else {
            let both = [low, high];
            let value = if is_rotary(letter) { Value::Plain(both) } else { Value::Ends(both) };
            sheet.put(&["machine", "travel", &name], value, range, &format!("limits of {letter}"));
        }
    }
    if let Some(rate) = axis.get("max_velocity").and_then(json::number) {
        if rate <= 0.0 {
            sheet.refuse(range, format!("max_velocity of {letter} is {rate}: it must be greater than zero"));
        } else if same(rate, velocity) {
            sheet.leave(range, format!("max_velocity of {letter}"), DEFAULT);
        } else {
            let place = format!("max_velocity of {letter}");
            sheet.put(&["machine", "rapid", &name], Value::of_axis(letter, rate), range, &place);
        }
    }
    if axis.get("role").and_then(Json::as_str).is_some_and(|role| role.ends_with("_rotary")) {
        sheet.leave(
            range,
            format!("role of {letter}"),
            "which rotary axis carries which is not read: write `rotary` and `rotary_order`",
        );
    }
}

/// The speed of the only spindle that turns.
fn toolheads(sheet: &mut Sheet<'_>, machine: &Json) {
    let heads = ["toolheads", "spindles"].into_iter().find_map(|key| machine.get(key)?.as_array());
    let speeds: Vec<f64> = heads
        .into_iter()
        .flatten()
        .filter(|head| head.get("toolhead_type").and_then(Json::as_str).is_none_or(|kind| kind == "rotary"))
        .filter_map(|head| head.get("max_rpm").and_then(json::number))
        .collect();
    let range = place(sheet, "max_rpm");
    match speeds.as_slice() {
        [] => {}
        [speed] if *speed > 0.0 => {
            sheet.put(&["machine", "max_rpm"], Value::Number(*speed), &range, "max_rpm");
        }
        [speed] => sheet.refuse(&range, format!("max_rpm is {speed}: it must be greater than zero")),
        _ => sheet.leave(&range, "max_rpm", "the machine has several spindles"),
    }
}

/// The letter of an axis: `X`, `x`.
fn letter(name: &str) -> Option<char> {
    let mut letters = name.chars();
    let letter = letters.next()?.to_ascii_uppercase();
    (letters.next().is_none() && AXES.contains(letter)).then_some(letter)
}

/// Where a key is first, for messages.
fn place(sheet: &Sheet<'_>, key: &str) -> Range<usize> {
    let quoted = format!("\"{key}\"");
    let at = sheet.text.find(&quoted).unwrap_or(0);
    at..at + 1
}
