//! `docs/reference/keys.md`: every key of `gcheck.toml`, from its JSON schema.
//!
//! Knows: the words of JSON schemas that the schema has, that rules are keys. Must not know: any other key.

use std::collections::BTreeSet;
use std::path::PathBuf;

use serde_json::Value;

use super::generated::Generated;
use super::markdown::{codes, header, table};

const PAGE: &str = "docs/reference/keys.md";

/// So many words of a choice are shown: rules are many, and have pages of their own.
const MOST: usize = 24;

/// The page.
///
/// # Errors
/// When the schema is not what a reader of it expects.
pub(super) fn generate() -> anyhow::Result<Generated> {
    let schema: Value = serde_json::from_str(&gcheck::config::schema())?;
    let mut text = header("the schema of `gcheck.toml`");
    text.push_str("# Keys of gcheck.toml\n\n");
    text.push_str("`NAME` is a name of your own: a code, a tool's number, an axis, a pattern of files.\n");
    text.push_str("Below `rules` each [rule](../rules/README.md) is a key as well.\n");
    text.push_str("[gcheck.schema.json](../gcheck.schema.json) says the same to editors; `gcheck schema` prints it.\n\n");
    let mut rows = Vec::new();
    Keys { schema: &schema, rows: &mut rows }.of(&schema, "", &mut BTreeSet::new());
    text.push_str(&table(&["key", "is", "means"], &rows));
    Ok(vec![(PathBuf::from(PAGE), text)])
}

struct Keys<'s, 'r> {
    schema: &'s Value,
    rows: &'r mut Vec<Vec<String>>,
}

impl<'s> Keys<'s, '_> {
    /// Adds the keys of a table. `within` are the definitions that it is in: a table that is in itself is told once.
    fn of(&mut self, table: &'s Value, before: &str, within: &mut BTreeSet<&'s str>) {
        let properties = table.get("properties").and_then(Value::as_object);
        for (name, key) in properties.into_iter().flatten().filter(|(name, _)| !is_rule(name)) {
            let name = format!("{before}{name}");
            let words = key.get("description").and_then(Value::as_str).unwrap_or_default();
            self.rows.push(vec![format!("`{name}`"), self.kind(key), words.to_owned()]);
            self.below(key, &name, within);
        }
    }

    /// Adds the keys of what a key holds.
    fn below(&mut self, value: &'s Value, name: &str, within: &mut BTreeSet<&'s str>) {
        for choice in choices(value) {
            if let Some(reference) = choice.get("$ref").and_then(Value::as_str) {
                if within.insert(reference) {
                    if let Some(definition) = self.definition(reference) {
                        self.below(definition, name, within);
                    }
                    within.remove(reference);
                }
                continue;
            }
            self.of(choice, &format!("{name}."), within);
            if let Some(items) = choice.get("items") {
                self.below(items, name, within);
            }
            if let Some(others) = choice.get("additionalProperties").filter(|others| others.is_object()) {
                self.below(others, &format!("{name}.NAME"), within);
            }
        }
    }

    /// What a value is, in words.
    fn kind(&self, value: &Value) -> String {
        let mut kinds: Vec<String> = Vec::new();
        for choice in choices(value) {
            if kinds.len() == MOST {
                kinds.push("…".to_owned());
                break;
            }
            let kind = self.kind_of(choice);
            if !kind.is_empty() && !kinds.contains(&kind) {
                kinds.push(kind);
            }
        }
        kinds.join(" or ")
    }

    fn kind_of(&self, value: &Value) -> String {
        if let Some(reference) = value.get("$ref").and_then(Value::as_str) {
            return self.definition(reference).map(|definition| self.kind(definition)).unwrap_or_default();
        }
        let text = |value: &Value| value.as_str().map(str::to_owned);
        if let Some(words) = value.get("enum").and_then(Value::as_array) {
            let shown = codes(words.iter().take(MOST).filter_map(text));
            return if words.len() > MOST { format!("{shown}, …") } else { shown };
        }
        if let Some(word) = value.get("const").and_then(text) {
            return codes([word]);
        }
        let types = match value.get("type") {
            Some(Value::Array(types)) => types.iter().filter_map(text).collect(),
            Some(one) => text(one).into_iter().collect(),
            None => Vec::new(),
        };
        let words: Vec<String> = types.iter().filter_map(|kind| self.word(kind, value)).collect();
        words.join(" or ")
    }

    /// The word for a type of JSON.
    fn word(&self, kind: &str, value: &Value) -> Option<String> {
        let word = match kind {
            "null" => return None,
            "boolean" => "`true` or `false`",
            "integer" => "a whole number",
            "number" => "a number",
            "string" => "a text",
            "object" => "a table",
            "array" => {
                let items = value.get("items").map(|items| self.kind(items)).unwrap_or_default();
                return Some(if items.is_empty() {
                    "a list".to_owned()
                } else {
                    format!("a list: each {items}")
                });
            }
            other => other,
        };
        Some(word.to_owned())
    }

    fn definition(&self, reference: &str) -> Option<&'s Value> {
        self.schema.pointer(reference.strip_prefix('#')?)
    }
}

/// Each rule is a key; they have pages of their own.
fn is_rule(name: &str) -> bool {
    gcheck_rules::RULES.iter().any(|rule| rule.meta.id == name)
}

/// The choices that a value has, or itself.
fn choices(value: &Value) -> Vec<&Value> {
    let of = |name: &str| value.get(name).and_then(Value::as_array);
    of("anyOf").or_else(|| of("oneOf")).map_or_else(|| vec![value], |choices| choices.iter().collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The names of all properties, wherever they are.
    fn names<'v>(value: &'v Value, found: &mut BTreeSet<&'v str>) {
        if let Some(properties) = value.get("properties").and_then(Value::as_object) {
            found.extend(properties.keys().map(String::as_str));
        }
        match value {
            Value::Object(members) => members.values().for_each(|value| names(value, found)),
            Value::Array(items) => items.iter().for_each(|value| names(value, found)),
            _ => {}
        }
    }

    #[test]
    fn every_key_of_the_schema_is_on_the_page() {
        let (_, page) = generate().unwrap().pop().unwrap();
        let schema: Value = serde_json::from_str(&gcheck::config::schema()).unwrap();
        let mut found = BTreeSet::new();
        names(&schema, &mut found);
        assert!(found.len() > 60, "{found:?}");
        for name in found.into_iter().filter(|name| !is_rule(name)) {
            assert!(page.contains(&format!("`{name}`")) || page.contains(&format!(".{name}`")), "{name}");
        }
        for line in page.lines().filter(|line| line.starts_with("| `")) {
            assert!(line.split(" | ").all(|cell| !cell.trim_matches(['|', ' ']).is_empty()), "{line}");
        }
    }
}
