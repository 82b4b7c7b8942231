//! JSON of tool libraries: values, and where the elements of a list begin.
//!
//! Knows: JSON. Must not know: what a library says.
//!
//! `serde_json` bounds the depth, and gives no places; the places come from a scan of a text that it has accepted.

use std::ops::Range;

use serde_json::Value;

use super::sheet::Sheet;

/// Reads a text; a mistake in its form refuses the file.
pub(super) fn parse(sheet: &mut Sheet<'_>) -> Option<Value> {
    match serde_json::from_str(sheet.text) {
        Ok(value) => Some(value),
        Err(error) => {
            let at = offset(sheet.text, error.line(), error.column());
            let message = if error.is_eof() {
                "the file ends in the middle of its JSON; is it cut short?".to_owned()
            } else {
                let words = error.to_string();
                let words = words.split(" at line ").next().unwrap_or_default();
                format!("the JSON cannot be read: {words}")
            };
            sheet.refuse(&(at..at + 1), message);
            None
        }
    }
}

fn offset(text: &str, line: usize, column: usize) -> usize {
    let start = super::sheet::lines(text).nth(line.saturating_sub(1)).map_or(text.len(), |(start, _)| start);
    let mut at = (start + column.saturating_sub(1)).min(text.len());
    while !text.is_char_boundary(at) {
        at -= 1;
    }
    at
}

/// Where each object of the list under a key of the root is, in bytes of the text; of JSON that was read.
pub(super) fn elements(text: &str, key: &str) -> Vec<Range<usize>> {
    let mut found = Vec::new();
    let (mut depth, mut begin) = (0_usize, 0);
    let (mut in_text, mut escaped, mut text_start) = (false, false, 0);
    let (mut last_text, mut inside) = ("", false);
    for (at, byte) in text.bytes().enumerate() {
        if in_text {
            match byte {
                _ if escaped => escaped = false,
                b'\\' => escaped = true,
                b'"' => {
                    in_text = false;
                    last_text = text.get(text_start..at).unwrap_or_default();
                }
                _ => {}
            }
            continue;
        }
        match byte {
            b'"' => (in_text, text_start) = (true, at + 1),
            b'{' | b'[' => {
                if depth == 1 {
                    inside = byte == b'[' && last_text == key;
                }
                if depth == 2 && inside {
                    begin = at;
                }
                depth += 1;
            }
            b'}' | b']' => {
                depth = depth.saturating_sub(1);
                if depth == 2 && inside && byte == b'}' {
                    found.push(begin..at + 1);
                }
            }
            _ => {}
        }
    }
    found
}

/// A number, or a text that is one.
pub(super) fn number(value: &Value) -> Option<f64> {
    let number = match value {
        Value::Number(number) => number.as_f64(),
        Value::String(text) => text.trim().parse().ok(),
        _ => None,
    };
    number.filter(|number| number.is_finite())
}

#[cfg(test)]
mod tests {
    use super::elements;

    #[test]
    fn objects_of_the_list_are_found_and_no_others() {
        let text =
            r#"{"other": [{"a": 1}], "data": [ {"b": "}]{\""} , {"c": [{}, {}]} ], "z": {"data": [{}]}}"#;
        let found: Vec<&str> = elements(text, "data").into_iter().map(|range| &text[range]).collect();
        assert_eq!(found, [r#"{"b": "}]{\""}"#, r#"{"c": [{}, {}]}"#]);
    }
}
