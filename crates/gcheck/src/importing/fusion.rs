//! Tool libraries of Autodesk Fusion, exported as JSON.
//!
//! Knows: the keys of that format: `data` with a tool each, its `unit`, `post-process`, `geometry`, `holder`. Must not know:
//! other formats, how TOML is written.

use std::ops::Range;

use serde_json::Value;

use super::json::{self, number};
use super::sheet::{Sheet, rounded};
use super::tools::{Besides, Library, LibraryTool};
use crate::config::Units;

/// Reads a library.
pub(super) fn read(sheet: &mut Sheet<'_>, document: &Value) {
    let Some(data) = document.get("data").and_then(Value::as_array) else {
        return sheet
            .refuse(&(0..1), "the library has no list `data`; export it as JSON from the tool library");
    };
    let places = json::elements(sheet.text, "data");
    let mut library = Library::default();
    file_units(sheet, data, &places);
    let mut bodies = Besides::default();
    for (ix, tool) in data.iter().enumerate() {
        let range = places.get(ix).cloned().unwrap_or(0..1);
        let head = range.start..range.start + 1;
        if !tool.is_object() {
            sheet.refuse(&head, "an entry of `data` is not a tool");
            continue;
        }
        let kind = tool.get("type").and_then(Value::as_str).unwrap_or_default();
        let title = title(tool);
        if kind == "holder" {
            sheet.leave(&head, format!("`{title}`"), "it is a holder, not a tool");
            continue;
        }
        let Some(scale) = scale(sheet, tool, &title, &head) else { continue };
        let geometry = tool.get("geometry").unwrap_or(&Value::Null);
        let size = |key: &str| geometry.get(key).and_then(number);
        let length = gauge_length(tool, geometry);
        if length.is_none() && size("LB").is_some() {
            bodies.add(&head);
        }
        // A turning tool has a nose and no diameter.
        let diameter = if kind.starts_with("turning") { None } else { size("DC") };
        let corner_radius = size("RE").filter(|radius| *radius != 0.0);
        let is_ball = kind == "ball end mill";
        let corner_radius =
            corner_radius.or(if is_ball { diameter.map(|diameter| diameter / 2.0) } else { None });
        let process = tool.get("post-process").and_then(|process| process.get("number"));
        let [diameter, length, corner_radius] = [diameter, length, corner_radius].map(|size| size.map(scale));
        let found = LibraryTool { diameter, length, corner_radius, teeth: size("NOF"), range: head, title };
        library.add(sheet, process.and_then(number), found);
    }
    library.put(sheet);
    bodies.leave(sheet, "`LB`", "it is the length below the holder, not the length offset");
}

/// The unit that a tool names, if it is known.
fn unit_of(tool: &Value) -> Option<Units> {
    match tool.get("unit").and_then(Value::as_str)? {
        "millimeters" | "mm" => Some(Units::Mm),
        "inches" | "in" => Some(Units::Inch),
        _ => None,
    }
}

/// The unit of the file is that of its first tool that has one; the others come to it.
fn file_units(sheet: &mut Sheet<'_>, data: &[Value], places: &[Range<usize>]) {
    let is_holder = |tool: &Value| tool.get("type").and_then(Value::as_str) == Some("holder");
    let tools = data.iter().enumerate().filter(|(_, tool)| !is_holder(tool));
    if let Some((ix, units)) = tools.into_iter().find_map(|(ix, tool)| Some((ix, unit_of(tool)?))) {
        let start = places.get(ix).map_or(0, |place| place.start);
        sheet.put_units(units, &(start..start + 1));
        sheet.converted = true;
    }
}

/// Brings a size of a tool to the unit of the file.
fn scale(sheet: &mut Sheet<'_>, tool: &Value, title: &str, head: &Range<usize>) -> Option<fn(f64) -> f64> {
    let units = match (tool.get("unit").and_then(Value::as_str), unit_of(tool)) {
        (Some(_), Some(units)) => units,
        (Some(other), None) => {
            sheet.refuse(
                head,
                format!("the unit of `{title}` is `{other}`; known are millimeters and inches"),
            );
            return None;
        }
        (None, _) => match sheet.asked {
            Some(asked) => asked,
            None if sheet.units_at.is_some() => {
                let why = "the tool has no `unit`, and others of the library do: name it with `--units`";
                sheet.leave(head, format!("`{title}`"), why);
                return None;
            }
            // No tool has one: it is asked for.
            None => return Some(|size| size),
        },
    };
    Some(match (units, sheet.units) {
        (Units::Mm, Some(Units::Inch)) => |size| rounded(size / 25.4),
        (Units::Inch, Some(Units::Mm)) => |size| rounded(size * 25.4),
        _ => |size| size,
    })
}

/// What a tool is called.
fn title(tool: &Value) -> String {
    let text = |value: Option<&Value>| value.and_then(Value::as_str).unwrap_or_default().trim().to_owned();
    let description = text(tool.get("description"));
    if description.is_empty() { text(tool.get("type")) } else { description }
}

/// From the gauge line of the holder to the tip: as the library computed it, or the holder and the body together.
fn gauge_length(tool: &Value, geometry: &Value) -> Option<f64> {
    let told = geometry.get("assemblyGaugeLength").and_then(number).filter(|length| *length > 0.0);
    told.or_else(|| {
        let holder = tool.get("holder")?;
        if holder.get("unit").is_some() && holder.get("unit") != tool.get("unit") {
            return None;
        }
        let holder = holder.get("gaugeLength").and_then(number).filter(|length| *length > 0.0)?;
        let body = geometry.get("LB").and_then(number).filter(|length| *length > 0.0)?;
        Some(holder + body)
    })
}
