//! What is told of the key or value at a place of a configuration.
//!
//! Knows: how it is worded. Must not know: any key.

use std::fmt::Write as _;

use gcheck_server::ConfigurationHover;

use super::open_keys::{control_at, texts_for, told};
use super::outline::{Outline, Spot, Step};
use super::shape::Shape;

/// Values that a hover lists; of more it says only how many there are.
const MOST_VALUES: usize = 12;

/// All about the key or value at a byte.
pub(crate) fn hover(text: &str, offset: usize) -> Option<ConfigurationHover> {
    let outline = Outline::read(text);
    match outline.at(offset) {
        Spot::Key(key, path) => {
            let shape = Shape::at(&path)?;
            let markdown = of_key(&outline, text, &path, &shape);
            Some(ConfigurationHover { markdown, range: key.range.clone() })
        }
        Spot::Value(value, path) => {
            let shape = Shape::at(&path)?;
            let written = text.get(value.range.clone())?.trim_matches(['"', '\'']);
            let allowed = shape.allowed().into_iter().find(|allowed| allowed.text == written);
            let markdown = match allowed.filter(|allowed| !allowed.description.is_empty()) {
                Some(allowed) => format!("**{}**\n\n{}", allowed.text, flowing(allowed.description)),
                None => of_key(&outline, text, &path, &shape),
            };
            Some(ConfigurationHover { markdown, range: value.range.clone() })
        }
        Spot::NewKey(..) | Spot::NewValue(_) | Spot::Nothing => None,
    }
}

fn of_key(outline: &Outline, text: &str, path: &[Step], shape: &Shape) -> String {
    let control = control_at(outline, text, path);
    if let Some(told) = told(path, control.as_deref()) {
        return told;
    }
    let mut markdown = format!("**{}**: {}", shown(path), shape.type_in_words());
    let description = shape.description();
    if !description.is_empty() {
        let _ = write!(markdown, "\n\n{}", flowing(description));
    }
    if description.contains("`units`") && !path.ends_with(&[Step::Key("units".to_owned())]) {
        let _ = write!(markdown, "\n\n{}", units(outline, text, path));
    }
    let item = [path, &[Step::Item(0)]].concat();
    let allowed = match shape.allowed() {
        none if none.is_empty() => Shape::at(&item).map(|item| item.allowed()).unwrap_or_default(),
        own => own,
    };
    let allowed: Vec<_> = allowed.into_iter().filter(|allowed| allowed.is_text).collect();
    if allowed.len() > MOST_VALUES {
        let _ = write!(markdown, "\n\nThere are {} values; completion lists them.", allowed.len());
    } else if !allowed.is_empty() {
        let _ = write!(markdown, "\n\nValues:");
        for value in &allowed {
            let _ = write!(markdown, "\n* `\"{}\"`: {}", value.text, flowing(value.description));
        }
    }
    markdown
}

/// A path as a configuration writes it.
fn shown(path: &[Step]) -> String {
    let keys: Vec<&str> = path.iter().filter_map(Step::key).collect();
    keys.join(".")
}

/// The unit of lengths in this file.
fn units(outline: &Outline, text: &str, path: &[Step]) -> String {
    let written = texts_for(outline, text, path, &["machine", "units"]).next();
    match written {
        Some(units) => format!("`units` of this file: {units}."),
        None => {
            "This file sets no `units`: lengths are in the unit that the control has at power-on.".to_owned()
        }
    }
}

/// The text as one line.
fn flowing(text: &str) -> String {
    text.replace('\n', " ")
}

#[cfg(test)]
mod tests {
    use expect_test::{Expect, expect};

    use super::hover;

    fn check(text: &str, expected: &Expect) {
        let offset = text.find("$0").unwrap();
        let text = text.replace("$0", "");
        let hover = hover(&text, offset);
        let shown = hover.map_or_else(
            || "nothing\n".to_owned(),
            |hover| format!("[{}]\n{}\n", &text[hover.range], hover.markdown),
        );
        expected.assert_eq(&shown);
    }

    #[test]
    fn a_key_tells_meaning_type_unit_and_values() {
        check(
            "[machine]\nmax_r$0pm = 1\n",
            &expect![[r#"
            [max_rpm]
            **machine.max_rpm**: number

            Highest spindle speed, in 1/min.
        "#]],
        );
        check(
            "[machine]\nunits = \"inch\"\nmax_f$0eed = 1\n",
            &expect![[r#"
            [max_feed]
            **machine.max_feed**: number

            Highest feed rate, in `units` a minute.

            `units` of this file: inch.
        "#]],
        );
        check(
            "[mach$0ine]\n",
            &expect![[r#"
            [machine]
            **machine**: table

            The machine: axes, travels, limits.
        "#]],
        );
        check(
            "[machine]\nuni$0ts = \"in\"\n",
            &expect![[r#"
            [units]
            **machine.units**: text

            Unit of every length in this file, and the one active at power-on. No G20 or G21 reinterprets it.

            Values:
            * `"mm"`: Millimetres.
            * `"inch"`: Inches.
        "#]],
        );
        check(
            "[tools]\n3 = { leng$0th",
            &expect![[r#"
            [length]
            **tools.3.length**: number

            Length offset, in `units`.

            This file sets no `units`: lengths are in the unit that the control has at power-on.
        "#]],
        );
        check(
            "[[overrides]]\n[overrides.machine]\nlook$0_ahead = 3\n",
            &expect![[r#"
            [look_ahead]
            **overrides.machine.look_ahead**: whole number from 0

            Stretches of path that the control looks ahead, in place of what is known of it.
        "#]],
        );
        check(
            "control = \"haas-mill\"\n[settings]\n34$0 = 6.0\n",
            &expect![[r#"
            [34]
            **Setting 34** of haas-mill: 4th axis diameter

            Diameter that turns a surface feed into degrees a minute on the 4th axis under G94, and default diameter of G107.

            Values: length.

            HM17 chapter 9
        "#]],
        );
        check(
            "control = \"haas-mill\"\n[offsets]\nG54$0 = { X = 1 }\n",
            &expect![[r#"
            [G54]
            **G54**: work offset 1
        "#]],
        );
        check(
            "[rules]\nunknown-$0code = \"off\"\n",
            &expect![[r#"
            [unknown-code]
            **rules.unknown-code**: text

            Rule: code that the control does not have; error, on by default.

            Values:
            * `"off"`: The rule does not run.
            * `"hint"`: Style.
            * `"info"`: Worth knowing.
            * `"warning"`: A likely crash, scrap or trap.
            * `"error"`: The control alarms, or the move is certainly wrong.
        "#]],
        );
        check(
            "[rules]\nsel$0ect = [\"words\"]\n",
            &expect![[r#"
                [select]
                **rules.select**: list: text

                Rules, groups and sets that run, in place of `["recommended"]`.

                There are 478 values; completion lists them.
            "#]],
        );
    }

    #[test]
    fn a_value_tells_what_it_does() {
        check(
            "[machine]\nunits = \"in$0ch\"\n",
            &expect![[r#"
            ["inch"]
            **inch**

            Inches.
        "#]],
        );
        check(
            "control = \"haas$0-mill\"\n",
            &expect![[r#"
            ["haas-mill"]
            **haas-mill**

            Haas mill (classic control and NGC)
        "#]],
        );
        check(
            "[rules]\nselect = [\"word$0s\"]\n",
            &expect![[r#"
            ["words"]
            **words**

            Group: all rules of `words`.
        "#]],
        );
        check(
            "[machine]\nmax_rpm = 12$00\n",
            &expect![[r#"
            [120]
            **machine.max_rpm**: number

            Highest spindle speed, in 1/min.
        "#]],
        );
    }

    #[test]
    fn what_is_not_a_key_tells_nothing() {
        check(
            "[machine]\nmax_$0revs = 1\n",
            &expect![[r#"
            nothing
        "#]],
        );
        check(
            "# a com$0ment\n",
            &expect![[r#"
            nothing
        "#]],
        );
        check(
            "$0",
            &expect![[r#"
            nothing
        "#]],
        );
    }
}
