//! Whether what a configuration names exists: controls, axes, settings, codes, rules.
//!
//! Knows: where to ask, and how to say what is wrong at its place. Must not know: how TOML is read.

use std::collections::BTreeMap;
use std::sync::Arc;

use gcheck_controls::{CodeNumber, Control, Letter, UserCode};
use gcheck_geometry::RotaryAxis;
use gcheck_rules::Selection;

use super::Placed;
use super::file::{CodeTable, MachineTable, RulesTable, Scalar, ToolsTable};
use super::layer::{ExecutionFacts, Text};
use crate::Problem;
use crate::nearest::did_you_mean;

/// Axis addresses of RS-274, which bound what a machine can have when its control is not known.
const AXES: &str = "XYZABCUVW";

/// The rotary axis of a name.
pub(crate) fn rotary_axis(name: &str) -> Option<RotaryAxis> {
    match name.to_ascii_uppercase().as_str() {
        "A" => Some(RotaryAxis::A),
        "B" => Some(RotaryAxis::B),
        "C" => Some(RotaryAxis::C),
        _ => None,
    }
}

/// Values that stand for a kind of value in the list of a setting's values.
const KINDS_OF_VALUES: [&str; 3] = ["length", "number", "on/off"];

/// Checks the parts of one text against the control that it names, if it names one.
pub(super) struct Checked<'t> {
    text: Text<'t>,
    control: Option<Arc<Control>>,
}

impl<'t> Checked<'t> {
    pub(super) fn new(text: Text<'t>, control: Option<&Placed<String>>) -> Result<Self, Problem> {
        let control = control.map(|name| {
            gcheck_controls::load(&name.value)
                .map_err(|error| text.problem(name, unknown_control(&name.value, &error)))
        });
        Ok(Self { text, control: control.transpose()? })
    }

    pub(super) fn machine(&self, table: &MachineTable) -> Result<MachineTable, Problem> {
        let lists = [&table.axes, &table.rotary_order].into_iter().flatten().flatten();
        for axis in lists.chain(table.travel.keys()).chain(table.rotary_sign.keys()) {
            self.axis(axis)?;
        }
        for (axis, travel) in &table.travel {
            let [low, high] = travel.value;
            if low >= high {
                let message = format!("travel of {} must go from the lower end to the upper", axis.value);
                return Err(self.text.problem(travel, message));
            }
        }
        if let Some(order) = &table.rotary_order {
            let axes: Vec<Option<RotaryAxis>> = order.iter().map(|name| rotary_axis(&name.value)).collect();
            if let Some((name, _)) = order.iter().zip(&axes).find(|(_, axis)| axis.is_none()) {
                return Err(self.text.problem(name, format!("`{}` is no rotary axis", name.value)));
            }
            if !matches!(axes.as_slice(), [first, second] if first != second)
                && let Some(name) = order.last()
            {
                return Err(self.text.problem(name, "rotary_order names two different axes"));
            }
        }
        for sign in table.rotary_sign.values() {
            if !matches!(sign.value, 1 | -1) {
                return Err(self.text.problem(sign, "a sense of rotation is 1 or -1"));
            }
        }
        let positive = [
            &table.max_rpm,
            &table.max_feed,
            &table.rapid,
            &table.rotary_rapid,
            &table.feed_override,
            &table.bar_length,
        ];
        if let Some(number) = positive.into_iter().flatten().find(|n| n.value.is_nan() || n.value <= 0.0) {
            return Err(self.text.problem(number, "must be greater than zero"));
        }
        let not_negative = [&table.tool_change_seconds, &table.pivot_length];
        if let Some(number) = not_negative.into_iter().flatten().find(|n| n.value.is_nan() || n.value < 0.0) {
            return Err(self.text.problem(number, "must not be negative"));
        }
        Ok(table.clone())
    }

    fn axis(&self, name: &Placed<String>) -> Result<(), Problem> {
        let letter = Letter::parse(&name.value.to_ascii_uppercase()).filter(|_| name.value.len() == 1);
        let (exists, axes) = match &self.control {
            Some(control) => {
                let axes: Vec<String> = control.axes().iter().map(|a| a.to_string()).collect();
                (letter.is_some_and(|l| control.axes().contains(l)), axes.join(", "))
            }
            None => {
                let axes: Vec<String> = AXES.chars().map(String::from).collect();
                (letter.is_some() && AXES.contains(&name.value.to_ascii_uppercase()), axes.join(", "))
            }
        };
        if exists {
            return Ok(());
        }
        let of = self.control.as_ref().map_or_else(String::new, |control| format!(" of {}", control.name()));
        Err(self.text.problem(name, format!("`{}` is no axis{of}; the axes are {axes}", name.value)))
    }

    /// Settings in the words of the control. One that the knowledge base does not list is kept: its list may have gaps.
    pub(super) fn settings(
        &self,
        settings: &BTreeMap<Placed<String>, Placed<Scalar>>,
    ) -> Result<Vec<(String, String)>, Problem> {
        for (number, value) in settings {
            let Some(entry) = self.control.as_ref().and_then(|control| control.setting(&number.value)) else {
                continue;
            };
            let listed: Vec<&str> = entry.values.iter().map(String::as_str).collect();
            let is_open =
                listed.iter().any(|v| KINDS_OF_VALUES.contains(v)) || listed.iter().any(|v| v.contains(' '));
            if !is_open && !listed.contains(&value.value.0.as_str()) {
                let near = did_you_mean(&value.value.0, listed.iter().copied());
                return Err(self.text.problem(
                    value,
                    format!("setting {} ({}) is one of {}{near}", number.value, entry.title, quoted(&listed)),
                ));
            }
        }
        Ok(settings.iter().map(|(number, value)| (number.value.clone(), value.value.0.clone())).collect())
    }

    pub(super) fn codes(
        &self,
        codes: &BTreeMap<Placed<String>, CodeTable>,
    ) -> Result<Vec<UserCode>, Problem> {
        codes
            .iter()
            .map(|(name, table)| {
                let number = CodeNumber::parse(&name.value.to_ascii_uppercase()).ok_or_else(|| {
                    self.text.problem(name, format!("`{}` is no code; write `M51` or `G150`", name.value))
                })?;
                if let Some(alias) = &table.alias
                    && !is_program(&alias.value)
                {
                    let message = format!("`{}` is no program; write `O9010`", alias.value);
                    return Err(self.text.problem(alias, message));
                }
                let alias = table.alias.as_ref().map(|a| a.value.clone());
                let title =
                    table.title.clone().or_else(|| alias.as_ref().map(|program| format!("calls {program}")));
                Ok(UserCode {
                    number,
                    title: title.unwrap_or_else(|| "a code of this shop".to_owned()),
                    alias,
                })
            })
            .collect()
    }

    pub(super) fn rules(&self, table: &RulesTable) -> Result<RulesTable, Problem> {
        self.selectors(table.select.iter().flatten())?;
        self.selectors(&table.ignore)?;
        self.selectors(&table.extend_select)?;
        let keys = ["select", "ignore", "extend-select"];
        for name in table.severities.keys() {
            if let Err(problem) = self.selectors([name]) {
                let near = did_you_mean(&name.value, keys);
                let is_key = !near.is_empty();
                let message = format!("`{}` is no rule, group or key of [rules]{near}", name.value);
                return Err(if is_key { self.text.problem(name, message) } else { problem });
            }
        }
        Ok(table.clone())
    }

    /// Each names a rule, a group or a set.
    pub(super) fn selectors<'s>(
        &self,
        selectors: impl IntoIterator<Item = &'s Placed<String>>,
    ) -> Result<(), Problem> {
        let mut selection = Selection::none();
        for selector in selectors {
            if let Err(unknown) = selection.enable(&selector.value) {
                return Err(self.text.problem(selector, unknown_rule(&unknown)));
            }
        }
        Ok(())
    }

    /// What only the execution of programs uses.
    pub(super) fn execution(
        &self,
        machine: &MachineTable,
        variables: &BTreeMap<Placed<String>, f64>,
        offsets: &BTreeMap<Placed<String>, BTreeMap<Placed<String>, f64>>,
        tools: &ToolsTable,
    ) -> Result<ExecutionFacts, Problem> {
        for (name, value) in variables {
            let inner = name.value.strip_prefix('#').unwrap_or_default();
            let is_named = inner.len() > 2 && inner.starts_with('<') && inner.ends_with('>');
            if !is_named && inner.parse::<u32>().is_err() {
                let message = format!("`{}` is no variable; write \"#3100\" or \"#<name>\"", name.value);
                return Err(self.text.problem(name, message));
            }
            self.finite(name, *value)?;
        }
        for (name, axes) in offsets {
            let code = name.value.split_whitespace().next().and_then(CodeNumber::parse);
            let exists =
                code.is_some_and(|number| self.control.as_ref().is_none_or(|c| c.code(number).is_some()));
            if !exists {
                let of = self
                    .control
                    .as_ref()
                    .map_or_else(String::new, |control| format!(" of {}", control.name()));
                let message = format!("`{}` is no work offset{of}; write `G54` or \"G154 P1\"", name.value);
                return Err(self.text.problem(name, message));
            }
            self.by_axis(axes)?;
        }
        let mut by_number = Vec::with_capacity(tools.tools.len());
        for (number, tool) in &tools.tools {
            let Ok(parsed) = number.value.parse::<u32>() else {
                let message = format!("`{}` is no tool number, nor `table`", number.value);
                return Err(self.text.problem(number, message));
            };
            let sizes = [tool.length, tool.posted_length, tool.diameter, tool.corner_radius];
            for size in sizes.into_iter().flatten() {
                self.finite(number, size)?;
            }
            if let Some(orientation) = tool.orientation.as_ref().filter(|o| o.value > 9) {
                return Err(self.text.problem(orientation, "a tip points in one of the directions 0 to 9"));
            }
            self.by_axis(&tool.offset)?;
            by_number.push((parsed, tool.clone()));
        }
        Ok(ExecutionFacts {
            units: machine.units,
            machine: machine.clone(),
            variables: variables.iter().map(|(name, value)| (name.value.clone(), *value)).collect(),
            offsets: offsets
                .iter()
                .map(|(name, axes)| {
                    let axes = axes.iter().map(|(axis, value)| (axis.value.to_ascii_uppercase(), *value));
                    (name.value.clone(), axes.collect())
                })
                .collect(),
            tools: by_number,
            table: tools.table.as_ref().map(|table| self.text.path(&table.value)),
        })
    }

    fn by_axis(&self, axes: &BTreeMap<Placed<String>, f64>) -> Result<(), Problem> {
        for (axis, value) in axes {
            self.axis(axis)?;
            self.finite(axis, *value)?;
        }
        Ok(())
    }

    /// TOML has `inf` and `nan`; machines have not.
    fn finite(&self, key: &Placed<String>, value: f64) -> Result<(), Problem> {
        if value.is_finite() {
            return Ok(());
        }
        Err(self.text.problem(key, format!("`{}` must be a finite number", key.value)))
    }
}

fn is_program(name: &str) -> bool {
    let digits = name.strip_prefix(['O', 'o']).unwrap_or(name);
    !digits.is_empty() && digits.bytes().all(|b| b.is_ascii_digit())
}

fn quoted(values: &[&str]) -> String {
    values.iter().map(|v| format!("`{v}`")).collect::<Vec<_>>().join(", ")
}

/// Whether there is a control of this name; the error is in words.
pub(crate) fn validate_control(name: &str) -> Result<(), String> {
    gcheck_controls::load(name).map(|_| ()).map_err(|error| unknown_control(name, &error))
}

/// Words for a control that cannot be loaded.
fn unknown_control(name: &str, error: &gcheck_controls::LoadError) -> String {
    match error {
        gcheck_controls::LoadError::Unknown { .. } => {
            let names = gcheck_controls::names();
            let near = did_you_mean(name, names.iter().copied());
            let list = if near.is_empty() { format!("; there are {}", names.join(", ")) } else { near };
            format!("no control is called `{name}`{list}")
        }
        data @ gcheck_controls::LoadError::Data { .. } => data.to_string(),
    }
}

/// Words for a selector that names nothing.
pub(crate) fn unknown_rule(unknown: &gcheck_rules::UnknownRule) -> String {
    let near = unknown.suggestion.map_or_else(
        || "; `gcheck rules` lists them".to_owned(),
        |suggestion| format!("; did you mean `{suggestion}`?"),
    );
    format!("`{}` is no rule, group or set of rules{near}", unknown.name)
}
