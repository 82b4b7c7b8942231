//! A configuration is read or refused in words, and what it says of a program does not depend on when it is asked.
//!
//! Knows: keys of `gcheck.toml`, from its schema, and values. Must not know: what they mean.

use std::path::Path;
use std::sync::LazyLock;

use gcheck::config::{PathPattern, schema};
use gcheck::of_bytes;
use serde_json::Value;

use crate::choices::Choices;

/// Every key that the schema names.
static KEYS: LazyLock<Vec<String>> = LazyLock::new(|| {
    let mut keys = Vec::new();
    let schema: Value = serde_json::from_str(&schema()).unwrap_or_default();
    collect(&schema, &mut keys);
    keys.sort();
    keys.dedup();
    keys
});

fn collect(schema: &Value, keys: &mut Vec<String>) {
    match schema {
        Value::Object(map) => {
            if let Some(Value::Object(properties)) = map.get("properties") {
                keys.extend(properties.keys().cloned());
            }
            map.values().for_each(|value| collect(value, keys));
        }
        Value::Array(list) => list.iter().for_each(|value| collect(value, keys)),
        _ => {}
    }
}

const TABLES: &[&str] = &[
    "",
    "[machine]",
    "[machine.travel]",
    "[settings]",
    "[variables]",
    "[offsets]",
    "[tools]",
    "[tools.1]",
    "[tools.1.offset]",
    "[codes]",
    "[codes.M77]",
    "[search]",
    "[rules]",
    "[per-file-ignores]",
    "[[overrides]]",
    "[files]",
    "[format]",
    "[machine.rapid]",
    "[machine.rotary_sign]",
    "[machine.rotary_direction]",
    "[overrides.machine]",
];

const OTHER_KEYS: &[&str] = &[
    "X",
    "Z",
    "A",
    "G54",
    "\"#100\"",
    "\"#<a>\"",
    "1",
    "162",
    "M77",
    "G77.1",
    "words",
    "unknown-code",
    "\"*.nc\"",
    "\"legacy/**\"",
    "\"{a,b}\"",
    "table",
    "machine.travel.X",
    "\"\"",
    "a.b.c",
];

const VALUES: &[&str] = &[
    "1",
    "-1",
    "0",
    "1.5",
    "1e400",
    "nan",
    "inf",
    "-inf",
    "true",
    "false",
    "\"\"",
    "\"mm\"",
    "\"inch\"",
    "\"off\"",
    "\"error\"",
    "[]",
    "[1, 2]",
    "[0.0, -1.0]",
    "[\"X\", \"Z\"]",
    "[\"*.nc\"]",
    "[\"[\"]",
    "[\"{a,{b,c}}\"]",
    "{}",
    "{ X = 1.0 }",
    "{ length = 1.0 }",
    "\"O9010\"",
    "\"O99999999999\"",
    "[\"all\"]",
    "[\"no-such\"]",
    "9223372036854775807",
    "-9223372036854775808",
    "1979-05-27",
    "\"\\u0000\"",
    "\"é\"",
    "\"head-head\"",
    "\"arm\"",
    "{ table = \"x.tbl\" }",
    "[[\"a\"]]",
    "\"G54\"",
    "10",
    "\"upper\"",
    "\"drop\"",
];

pub(crate) fn run(bytes: &[u8]) {
    let mut choices = Choices::new(bytes);
    match choices.below(4) {
        0 => {
            let text = String::from_utf8_lossy(choices.rest()).into_owned();
            of_bytes::configuration(&text);
        }
        1 => pattern(choices.rest()),
        _ => {
            of_bytes::configuration(&made(&mut choices));
        }
    }
}

fn made(choices: &mut Choices<'_>) -> String {
    let mut text = String::new();
    for _ in 0..60 {
        if choices.is_empty() {
            break;
        }
        match choices.below(5) {
            0 => text.push_str(choices.text(TABLES)),
            1 => {
                text.push_str(choices.text(OTHER_KEYS));
                text.push_str(" = ");
                text.push_str(choices.text(VALUES));
            }
            _ => {
                text.push_str(choices.one(&KEYS).map_or("", String::as_str));
                text.push_str(" = ");
                text.push_str(choices.text(VALUES));
            }
        }
        text.push('\n');
    }
    text
}

/// A pattern fits what it fits, and a folder that fits holds what is in it.
fn pattern(bytes: &[u8]) {
    let text = String::from_utf8_lossy(bytes);
    let (pattern, path) = text.split_once('\n').unwrap_or((&text, "a/b.nc"));
    let Ok(pattern) = PathPattern::new(Path::new("/work"), pattern) else { return };
    let path = Path::new("/work").join(path.trim_start_matches('/'));
    // The folder itself is not a program.
    if path != Path::new("/work") && pattern.fits(&path) {
        assert!(pattern.fits_or_holds(&path), "what fits is held");
        assert!(pattern.fits_or_holds(&path.join("deeper.nc")), "what fits holds what is in it");
    }
}
