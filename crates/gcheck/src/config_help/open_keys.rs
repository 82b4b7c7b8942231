//! Keys that no schema lists, because they depend on the control: axes, settings, work offsets, codes.
//!
//! Knows: which tables have such keys, where to ask. Must not know: texts in TOML.

use std::sync::Arc;

use gcheck_controls::{CodeNumber, Control, Effect};

use super::outline::{Outline, Step};

/// Axes that a machine may have.
const AXES: [&str; 9] = ["X", "Y", "Z", "A", "B", "C", "U", "V", "W"];
/// Work offsets that nearly every control has.
const USUAL_OFFSETS: [&str; 6] = ["G54", "G55", "G56", "G57", "G58", "G59"];

/// A name that may be a key, or a text in a list.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Name {
    pub(super) name: String,
    pub(super) description: String,
}

/// What the names in a table or list are.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Of {
    Axes,
    Settings,
    Offsets,
    Codes,
}

/// The names that fit the keys of a table, or the items of a list.
pub(super) fn names(path: &[Step], control: Option<&Control>) -> Vec<Name> {
    match of(path) {
        Some(Of::Axes) => AXES.iter().map(|axis| named(axis, "axis")).collect(),
        Some(Of::Settings) => {
            let settings = control.map(Control::settings).unwrap_or_default();
            settings.iter().map(|setting| named(&setting.number, &setting.title)).collect()
        }
        Some(Of::Offsets) => offsets(control),
        Some(Of::Codes) | None => Vec::new(),
    }
}

/// What is told of such a key.
pub(super) fn told(path: &[Step], control: Option<&Control>) -> Option<String> {
    let (last, table) = path.split_last()?;
    let key = last.key()?;
    let control = control?;
    match of(table)? {
        Of::Settings => {
            let setting = control.setting(key)?;
            let default =
                setting.default.as_ref().map(|value| format!("\n\nWithout it: {value}.")).unwrap_or_default();
            let values = setting.values.join(", ");
            Some(format!(
                "**Setting {key}** of {}: {}\n\n{}\n\nValues: {values}.{default}\n\n{}",
                control.name(),
                setting.title,
                setting.changes,
                setting.source
            ))
        }
        Of::Offsets => {
            let code =
                control.code(CodeNumber::parse(&key.split_whitespace().next()?.to_ascii_uppercase())?)?;
            Some(format!("**{key}**: {}", code.entry().title))
        }
        Of::Codes => {
            let code = control.code(CodeNumber::parse(&key.to_ascii_uppercase())?)?;
            let (name, title) = (control.name(), &code.entry().title);
            Some(format!("**{key}** on {name} without this entry: {title}"))
        }
        Of::Axes => None,
    }
}

/// The control that a place of the text is for, where the text names it.
pub(super) fn control_at(outline: &Outline, text: &str, path: &[Step]) -> Option<Arc<Control>> {
    texts_for(outline, text, path, &["control"]).find_map(|name| gcheck_controls::load(name).ok())
}

/// What the text writes for a key that counts at `path`: in the item of `[[overrides]]` that the path leads through, then for all
/// programs.
pub(super) fn texts_for<'t>(
    outline: &Outline,
    text: &'t str,
    path: &[Step],
    keys: &[&str],
) -> impl Iterator<Item = &'t str> {
    let own = match path {
        [list @ Step::Key(name), item @ Step::Item(_), ..] if name == "overrides" => {
            Some(vec![list.clone(), item.clone()])
        }
        _ => None,
    };
    own.into_iter().chain([Vec::new()]).filter_map(move |mut path| {
        path.extend(keys.iter().map(|key| Step::Key((*key).to_owned())));
        let value = outline.values_of(&path).next()?;
        Some(text.get(value.range.clone())?.trim_matches(['"', '\'']))
    })
}

fn named(name: &str, description: &str) -> Name {
    Name { name: name.to_owned(), description: description.to_owned() }
}

fn offsets(control: Option<&Control>) -> Vec<Name> {
    let Some(control) = control else {
        return USUAL_OFFSETS.iter().map(|name| named(name, "work offset")).collect();
    };
    let codes = control.codes().filter_map(|code| {
        let name = code.number().to_string();
        match code.effect() {
            Effect::WorkOffset(_) => Some(named(&name, &code.entry().title)),
            Effect::WorkOffsetByP(_) => Some(named(&format!("{name} P1"), &code.entry().title)),
            _ => None,
        }
    });
    codes.collect()
}

/// What the keys of a table, or the items of a list, name.
fn of(path: &[Step]) -> Option<Of> {
    let rest = match path {
        [Step::Key(list), Step::Item(_), rest @ ..] if list == "overrides" => rest,
        all => all,
    };
    let keys: Vec<&str> = rest.iter().filter_map(Step::key).collect();
    Some(match keys.as_slice() {
        ["settings"] => Of::Settings,
        ["offsets"] => Of::Offsets,
        ["codes"] => Of::Codes,
        ["offsets", _]
        | ["tools", _, "offset"]
        | [
            "machine",
            "travel" | "rapid" | "acceleration" | "jerk" | "rotary_sign" | "rotary_direction"
            | "rotary_centre" | "rotary_offset" | "axes" | "rotary_order" | "rotary_shorter_way",
        ] => Of::Axes,
        _ => return None,
    })
}
