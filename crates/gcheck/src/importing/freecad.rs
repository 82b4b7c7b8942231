//! Tool bits of FreeCAD (`.fctb`) and the libraries that number them (`.fctl`).
//!
//! Knows: the keys of both formats: a bit has a `shape` and `parameter`s with their units, a library has `tools` with `nr` and
//! `path`; bits are in the folder `Bit` beside that of the library, or in its own. Must not know: other formats, how TOML is
//! written.

use std::ops::Range;
use std::path::{Component, Path, PathBuf};

use serde_json::Value;

use super::json;
use super::sheet::{MARK, Sheet, rounded};
use super::tools::{Besides, Library, LibraryTool, MOST_TOOLS};
use crate::config::Units;
use crate::reading;

/// A larger file is not a bit.
const MOST_BYTES: u64 = 64 << 10;
/// Folders of bits, from that of the library.
const FOLDERS: [&str; 4] = ["", "../Bit", "../bit", "../../Bit"];

/// Reads a library with its bits.
pub(super) fn read_library(sheet: &mut Sheet<'_>, document: &Value, folder: &Path) {
    let places = json::elements(sheet.text, "tools");
    let mut library = Library::default();
    let mut lengths = Besides::default();
    for (ix, tool) in document.get("tools").and_then(Value::as_array).into_iter().flatten().enumerate() {
        let range = places.get(ix).cloned().unwrap_or(0..1);
        let range = range.start..range.start + 1;
        if ix >= MOST_TOOLS {
            sheet.refuse(&range, format!("more than {MOST_TOOLS} tools"));
            break;
        }
        let number = tool.get("nr").and_then(json::number);
        let Some(name) = tool.get("path").and_then(Value::as_str) else {
            sheet.leave(&range, "a tool", "it names no bit (`path`)");
            continue;
        };
        match bit_of(folder, name) {
            Ok(bit) => {
                if has(&bit, "parameter", "Length") {
                    lengths.add(&range);
                }
                if let Some(found) = sizes(sheet, &bit, range.clone(), name) {
                    library.add(sheet, number, found);
                }
            }
            Err(why) => sheet.leave(&range, format!("`{name}`"), why),
        }
    }
    library.put(sheet);
    lengths.leave(sheet, "`Length`", "it is the length of the whole tool, not the length offset");
}

/// A bit alone: it has no number.
pub(super) fn read_bit(sheet: &mut Sheet<'_>, document: &Value) {
    let name = document.get("name").and_then(Value::as_str).unwrap_or("a bit").to_owned();
    sheet.leave(
        &(0..1),
        format!("`{name}`"),
        "a bit has no tool number: import the library (`.fctl`) that names it",
    );
}

fn has(bit: &Value, table: &str, key: &str) -> bool {
    bit.get(table).is_some_and(|table| table.get(key).is_some())
}

/// Reads the bit that a library names; nothing of the file is shown but its name.
fn bit_of(folder: &Path, name: &str) -> Result<Value, String> {
    let path = Path::new(name);
    let is_inside = path.components().all(|part| matches!(part, Component::Normal(_) | Component::CurDir));
    if !is_inside {
        return Err("the path of the bit leads out of the folder of bits".to_owned());
    }
    let candidates: Vec<PathBuf> = FOLDERS.iter().map(|bits| folder.join(bits).join(path)).collect();
    let Some(found) = candidates.iter().find(|path| path.exists()) else {
        return Err("there is no such bit beside the library or in `../Bit`".to_owned());
    };
    let bytes =
        reading::regular(found, MOST_BYTES).map_err(|reason| format!("cannot read the bit: {reason}"))?;
    let bytes = bytes.strip_prefix(MARK).unwrap_or(&bytes);
    let bit: Value =
        serde_json::from_slice(bytes).map_err(|_| "the bit is not JSON; is it cut short?".to_owned())?;
    if bit.get("parameter").is_some_and(Value::is_object) {
        Ok(bit)
    } else {
        Err("the file has no `parameter`, so it is not a bit".to_owned())
    }
}

/// The sizes of a bit, in millimetres; `None` if one is not clear.
fn sizes(sheet: &mut Sheet<'_>, bit: &Value, range: Range<usize>, name: &str) -> Option<LibraryTool> {
    let parameter = bit.get("parameter")?;
    let asked = sheet.asked;
    let flutes = |table: &str| bit.get(table)?.get("Flutes");
    let teeth = flutes("parameter").or_else(|| flutes("attribute")).and_then(count);
    let mut tool = LibraryTool { teeth, range, ..LibraryTool::default() };
    let title = bit.get("name").and_then(Value::as_str).unwrap_or(name);
    title.trim().clone_into(&mut tool.title);
    let shape = bit.get("shape").and_then(Value::as_str).unwrap_or_default().to_ascii_lowercase();
    for (key, value) in parameter.as_object()? {
        let size = match key.as_str() {
            "Diameter" => &mut tool.diameter,
            "CornerRadius" | "TorusRadius" => &mut tool.corner_radius,
            "FlatRadius" => {
                let why = "versions of the format mean different radii by it";
                sheet.leave(&tool.range.clone(), format!("`FlatRadius` of `{name}`"), why);
                continue;
            }
            _ => continue,
        };
        match in_mm(value, asked) {
            Ok(mm) => *size = Some(mm),
            Err(why) => {
                sheet.leave(&tool.range.clone(), format!("`{key}` of `{name}`"), why);
                return None;
            }
        }
    }
    if shape.starts_with("ballend") {
        tool.corner_radius = tool.diameter.map(|diameter| diameter / 2.0);
    }
    sheet.units = Some(Units::Mm);
    sheet.converted = true;
    if sheet.units_at.is_none() {
        sheet.units_at = Some(tool.range.clone());
    }
    Some(tool)
}

/// A count, `4` or `"4"`.
fn count(value: &Value) -> Option<f64> {
    match value {
        Value::Number(number) => number.as_f64(),
        Value::String(text) => text.trim().parse().ok(),
        _ => None,
    }
}

/// A length with its unit, `"5.0000 mm"`, in millimetres.
fn in_mm(value: &Value, asked: Option<Units>) -> Result<f64, String> {
    let text = match value {
        Value::String(text) => text.trim().to_owned(),
        Value::Number(number) => number.to_string(),
        _ => return Err("it is not a length".to_owned()),
    };
    let end = text.find(|c: char| !matches!(c, '0'..='9' | '.' | ',' | '-' | '+')).unwrap_or(text.len());
    let (number, unit) = text.split_at(end);
    if let Some(other) = without_comma(number) {
        return Err(format!(
            "`{text}` may be {} or {other}: write it without the comma",
            number.replace(',', ".")
        ));
    }
    let number: f64 = number.replace(',', ".").parse().map_err(|_| format!("`{text}` is not a length"))?;
    let factor = match (unit.trim(), asked) {
        ("mm", _) | ("", Some(Units::Mm)) => 1.0,
        ("cm", _) => 10.0,
        ("m", _) => 1000.0,
        ("µm" | "um", _) => 0.001,
        ("in" | "\"" | "inch", _) | ("", Some(Units::Inch)) => 25.4,
        ("", None) => return Err("it has no unit: name it with `--units mm` or `--units inch`".to_owned()),
        (other, _) => return Err(format!("`{other}` is not a unit of length that is known")),
    };
    Ok(if (factor - 1.0_f64).abs() < f64::EPSILON { number } else { rounded(number * factor) })
}

/// What a number is if its comma parts thousands, where it may as well be a decimal comma: `1,250`.
fn without_comma(number: &str) -> Option<String> {
    let (whole, rest) = number.trim_start_matches(['+', '-']).split_once(',')?;
    let is_group = |text: &str| text.bytes().all(|byte| byte.is_ascii_digit());
    let may_be = (1..=3).contains(&whole.len()) && !whole.starts_with('0') && rest.len() == 3;
    (may_be && is_group(whole) && is_group(rest)).then(|| number.replace(',', ""))
}
