//! What the schema of `gcheck.toml` says of a path: meaning, type, values, keys.
//!
//! Knows: the forms of JSON schema that ours has. Must not know: any key, texts in TOML.

use std::sync::LazyLock;

use serde_json::Value;

use super::outline::Step;

/// The schema, made once.
static SCHEMA: LazyLock<Value> = LazyLock::new(|| crate::config::json_schema().to_value());

/// What may be at a path.
#[derive(Debug, Clone)]
pub(super) struct Shape {
    /// As the place that names it says.
    node: &'static Value,
    /// Every form that it may have; references are followed.
    forms: Vec<&'static Value>,
}

/// A value that may be written, as text in TOML.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Allowed {
    /// Without quotation marks.
    pub(super) text: String,
    pub(super) description: &'static str,
    pub(super) is_text: bool,
}

/// The kinds of values that are written in different ways.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Kind {
    Text,
    Table,
    List,
    ListOfTables,
    Other,
}

impl Shape {
    /// The whole file.
    pub(super) fn top() -> Self {
        Self::of(&SCHEMA)
    }

    /// What may be at a path; `None` where nothing may.
    pub(super) fn at(path: &[Step]) -> Option<Self> {
        path.iter().try_fold(Self::top(), |shape, step| match step {
            Step::Key(key) => shape.value_of(key),
            Step::Item(_) => shape.item(),
        })
    }

    fn of(node: &'static Value) -> Self {
        let mut forms = Vec::new();
        collect(node, &mut forms);
        Self { node, forms }
    }

    /// The value of a key.
    pub(super) fn value_of(&self, key: &str) -> Option<Self> {
        let listed = self.forms.iter().find_map(|form| form.get("properties")?.get(key));
        if let Some(node) = listed {
            return Some(Self::of(node));
        }
        let other = self.forms.iter().find_map(|form| form.get("additionalProperties"));
        other.filter(|node| node.is_object()).map(Self::of)
    }

    fn item(&self) -> Option<Self> {
        let node = self.forms.iter().find_map(|form| form.get("items"))?;
        Some(Self::of(node))
    }

    /// The keys that a table lists, with their values.
    pub(super) fn keys(&self) -> Vec<(&'static str, Self)> {
        let properties = self.forms.iter().filter_map(|form| form.get("properties")?.as_object());
        properties.flatten().map(|(key, node)| (key.as_str(), Self::of(node))).collect()
    }

    /// Is it a table of tables whose names are not listed, such as the tools?
    pub(super) fn is_of_tables(&self) -> bool {
        let mut others = self.forms.iter().filter_map(|form| form.get("additionalProperties"));
        others.any(|node| node.is_object() && Self::of(node).kind() == Kind::Table)
    }

    /// May it be a table?
    pub(super) fn may_be_table(&self) -> bool {
        self.forms.iter().any(|form| is(form, "object"))
    }

    /// What it means.
    pub(super) fn description(&self) -> &'static str {
        let mut own = std::iter::once(&self.node).chain(&self.forms);
        own.find_map(|node| node.get("description")?.as_str()).unwrap_or_default()
    }

    /// The values that may be written, where they are listed.
    pub(super) fn allowed(&self) -> Vec<Allowed> {
        let mut all = Vec::new();
        for form in &self.forms {
            if is(form, "boolean") {
                all.extend(["true", "false"].map(|text| Allowed {
                    text: text.to_owned(),
                    description: "",
                    is_text: false,
                }));
            }
            let listed = form.get("oneOf").and_then(Value::as_array).into_iter().flatten();
            all.extend(listed.filter_map(|entry| {
                Some(Allowed {
                    text: entry.get("const")?.as_str()?.to_owned(),
                    description: entry.get("description").and_then(Value::as_str).unwrap_or_default(),
                    is_text: true,
                })
            }));
        }
        all
    }

    /// How it is written.
    pub(super) fn kind(&self) -> Kind {
        let has = |name: &str| self.forms.iter().any(|form| is(form, name));
        if has("string") || self.allowed().iter().any(|allowed| allowed.is_text) {
            if has("number") || has("boolean") { Kind::Other } else { Kind::Text }
        } else if has("array") {
            let is_of_tables = self.item().is_some_and(|item| item.kind() == Kind::Table);
            if is_of_tables { Kind::ListOfTables } else { Kind::List }
        } else if has("object") && !has("number") {
            Kind::Table
        } else {
            Kind::Other
        }
    }

    /// Its type in words.
    pub(super) fn type_in_words(&self) -> String {
        let mut words: Vec<String> = Vec::new();
        for form in &self.forms {
            for word in self.words_of(form) {
                if !words.contains(&word) {
                    words.push(word);
                }
            }
        }
        words.join(" or ")
    }

    fn words_of(&self, form: &'static Value) -> Vec<String> {
        if form.get("oneOf").is_some() {
            return vec!["text".to_owned()];
        }
        let bound = |name: &str| form.get(name).and_then(Value::as_i64);
        let names = ["boolean", "integer", "number", "string", "array", "object"];
        let names = names.into_iter().filter(|name| is(form, name));
        names
            .map(|name| match name {
                "boolean" => "`true` or `false`".to_owned(),
                "integer" => match (bound("minimum"), bound("maximum")) {
                    (Some(least), Some(most)) => format!("whole number from {least} to {most}"),
                    (Some(least), None) => format!("whole number from {least}"),
                    _ => "whole number".to_owned(),
                },
                "number" => "number".to_owned(),
                "string" => "text".to_owned(),
                "array" => {
                    let item = self.item();
                    let of = item.map(|item| item.type_in_words()).unwrap_or_default();
                    match (bound("minItems"), bound("maxItems")) {
                        (Some(2), Some(2)) => format!("list of two: {of}"),
                        _ => format!("list: {of}"),
                    }
                }
                _ => "table".to_owned(),
            })
            .collect()
    }
}

/// Is a form of this type?
fn is(form: &Value, name: &str) -> bool {
    match form.get("type") {
        Some(Value::String(own)) => own == name,
        Some(Value::Array(list)) => list.iter().any(|own| own == name),
        _ => false,
    }
}

/// The forms that a node may have.
fn collect(node: &'static Value, forms: &mut Vec<&'static Value>) {
    if let Some(name) = node.get("$ref").and_then(Value::as_str) {
        if let Some(target) = name.strip_prefix('#').and_then(|pointer| SCHEMA.pointer(pointer)) {
            collect(target, forms);
        }
    } else if let Some(list) = node.get("anyOf").and_then(Value::as_array) {
        for node in list {
            collect(node, forms);
        }
    } else if !is(node, "null") || node.get("type").is_some_and(Value::is_array) {
        forms.push(node);
    }
}

#[cfg(test)]
mod tests {
    use super::{Kind, Shape, Step};

    fn at(path: &str) -> Shape {
        let step = |step: &str| step.parse().map_or_else(|_| Step::Key(step.to_owned()), Step::Item);
        let path: Vec<Step> = path.split('.').map(step).collect();
        Shape::at(&path).unwrap()
    }

    #[test]
    fn types_in_words() {
        for (path, words, kind) in [
            ("control", "text", Kind::Text),
            ("extend", "text", Kind::Text),
            ("machine", "table", Kind::Table),
            ("machine.max_rpm", "number", Kind::Other),
            ("machine.rapid", "number or table", Kind::Other),
            ("machine.rapid.X", "number", Kind::Other),
            ("machine.travel.X", "list of two: number", Kind::List),
            ("machine.rotary_sign.A", "whole number from -128 to 127", Kind::Other),
            ("machine.units", "text", Kind::Text),
            ("machine.axes", "list: text", Kind::List),
            ("settings.S", "`true` or `false` or number or text", Kind::Other),
            ("tools.T3.teeth", "whole number from 0", Kind::Other),
            ("overrides", "list: table", Kind::ListOfTables),
            ("overrides.0.machine.units", "text", Kind::Text),
            ("rules.unknown-code", "text", Kind::Text),
            ("rules.select", "list: text", Kind::List),
        ] {
            let shape = at(path);
            assert_eq!((shape.type_in_words().as_str(), shape.kind()), (words, kind), "{path}");
        }
    }

    #[test]
    fn each_listed_key_and_value_says_what_it_is() {
        fn look(shape: &Shape, path: &str, seen: &mut usize) {
            for (key, value) in shape.keys() {
                let path = format!("{path}.{key}");
                assert!(!value.description().is_empty(), "{path}");
                assert!(!value.type_in_words().is_empty(), "{path}");
                for allowed in value.allowed().iter().filter(|allowed| allowed.is_text) {
                    assert!(!allowed.description.is_empty(), "{path} = {}", allowed.text);
                }
                *seen += 1;
                look(&value, &path, seen);
            }
        }
        let mut seen = 0;
        look(&Shape::top(), "", &mut seen);
        assert!(seen > 200, "{seen} keys");
    }

    #[test]
    fn names_that_code_knows_are_listed() {
        let texts = |path: &str| at(path).allowed().into_iter().map(|a| a.text).collect::<Vec<_>>();
        assert_eq!(texts("control").len(), gcheck_controls::names().len());
        let selectors = texts("rules.select.0");
        for name in ["all", "recommended", "strict", "unknown-code", "words"] {
            assert!(selectors.iter().any(|known| known == name), "{name}");
        }
        assert_eq!(texts("rules.unknown-code"), ["off", "hint", "info", "warning", "error"]);
    }
}
