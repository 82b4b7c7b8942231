//! Names that a configuration may use, listed for the schema: controls, rules, groups and sets of rules.
//!
//! Knows: names and what each is. Must not know: what a name does, whether one is written.

use std::borrow::Cow;
use std::collections::BTreeMap;

use gcheck_diagnostics::RuleSet;
use gcheck_rules::RULES;
use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde_json::{Value, json};

/// The name of a control, for the schema.
pub(super) struct ControlName;

impl JsonSchema for ControlName {
    fn schema_name() -> Cow<'static, str> {
        "Control".into()
    }

    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        let title = |name: &&str| {
            gcheck_controls::load(name).map(|control| control.title().to_owned()).unwrap_or_default()
        };
        let names = gcheck_controls::names().iter();
        let names: Vec<Value> =
            names.map(|name| json!({ "const": name, "description": title(name) })).collect();
        json_schema!({ "description": "A control.", "oneOf": names })
    }
}

/// What selects rules, for the schema.
pub(super) struct RuleSelector;

impl JsonSchema for RuleSelector {
    fn schema_name() -> Cow<'static, str> {
        "RuleSelector".into()
    }

    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        let sets = [("recommended", "the rules that are on by default"), ("all", "every rule")].into_iter();
        let sets = sets.chain(RuleSet::ALL.into_iter().map(|set| (set.name(), set.summary())));
        let mut all: BTreeMap<&str, String> = rules_and_groups();
        all.extend(sets.map(|(name, what)| (name, format!("Set: {what}."))));
        let all: Vec<Value> = all
            .into_iter()
            .map(|(name, description)| json!({ "const": name, "description": description }))
            .collect();
        json_schema!({ "description": "A rule, a group or a set of rules.", "oneOf": all })
    }
}

/// Lists rules and groups among the keys of `[rules]`.
pub(super) fn list_rules(schema: &mut Schema) {
    if let Some(Value::Object(properties)) = schema.get_mut("properties") {
        for (name, description) in rules_and_groups() {
            properties
                .insert(name.to_owned(), json!({ "description": description, "$ref": "#/$defs/Level" }));
        }
    }
}

/// Rules, with their former names, and groups; what each is.
fn rules_and_groups() -> BTreeMap<&'static str, String> {
    let mut all = BTreeMap::new();
    for rule in RULES.iter() {
        let meta = rule.meta;
        all.insert(meta.group, format!("Group: all rules of `{}`.", meta.group));
    }
    for rule in RULES.iter() {
        let meta = rule.meta;
        let on = if meta.recommended { "on by default" } else { "off by default" };
        all.insert(meta.id, format!("Rule: {}; {}, {on}.", meta.summary, meta.severity));
        for alias in meta.aliases {
            all.insert(alias, format!("Former name of `{}`.", meta.id));
        }
    }
    all
}
