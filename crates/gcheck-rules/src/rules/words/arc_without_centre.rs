//! An arc without centre or radius.

use gcheck_controls::{Code, Effect, Letter, LetterSet, Machine, Motion};
use gcheck_program::{BlockFlags, Word};

use crate::declare::declare_rule;
use crate::facts::word_sets::choice;
use crate::{BlockCx, Finding, Reads, Report, Run, Severity, limit};

declare_rule! {
    /// An arc gives its end point, but neither its centre nor its radius.
    ///
    /// ## Why it matters
    /// The arc is not defined. The control stops with an alarm, or moves in a straight line through the part; if a
    /// setting decides between the two and is not configured, this is a warning.
    ///
    /// ## Reported
    /// ```nc,reported,haas-mill
    /// G2 X10. Y5. F100.
    /// ```
    /// ## Not reported
    /// A code that only chooses the mode, and an arc whose radius is computed.
    /// ```nc,quiet,haas-mill
    /// G2
    /// G3 X10. Y5. R#100
    /// ```
    rule "arc-without-centre" in "words" {
        summary: "arc without centre or radius",
        severity: Error,
        tier: Block,
        since: "0.1.0",
        run: Run::BlockAndValues { trigger: BlockFlags::CODE, reads: Reads::Numbers, check },
    }
}

fn check(cx: &BlockCx<'_>, report: &mut Report<'_>) {
    for (word, code) in cx.codes().filter(|(_, code)| code.motion() == Motion::Arc) {
        for items in &code.entry().one_of {
            let letters = items.iter().fold(LetterSet::EMPTY, |set, item| set.or(LetterSet::of_item(item)));
            // Another code of the block may use the axis words.
            if !cx.block().letters.intersects(letters)
                && let Some(end) = cx.words().iter().find(|w| is_end_point(cx, code, w))
                && cx.words_are_plain()
                && !cx.codes().any(|(_, other)| other.entry().takes_axes)
            {
                report.add(finding(cx, word, end, code, letters));
            }
        }
    }
}

fn is_end_point(cx: &BlockCx<'_>, code: Code<'_>, word: &Word) -> bool {
    code.reads().contains(word.letter) && cx.control().letter(word.letter).is_some_and(|entry| entry.axis)
}

fn finding(cx: &BlockCx<'_>, word: &Word, end: &Word, code: Code<'_>, letters: LetterSet) -> Finding {
    let entry = code.entry();
    let planes = planes(cx);
    let radius = Letter::of('R');
    let (needs, note) = match planes.as_slice() {
        // The block tells the plane, or the control has no other.
        [(_, centre)] => {
            let mut fit = centre.and(letters);
            if letters.contains(radius) {
                fit.insert(radius);
            }
            (choice(fit), format!("`{}` needs {} in its block", entry.code, choice(fit)))
        }
        _ => {
            let of_plane =
                |(code, centre): &(String, LetterSet)| format!("{} in `{code}`", choice(centre.and(letters)));
            let each: Vec<String> = planes.iter().map(of_plane).collect();
            let or_radius = if letters.contains(radius) { " or `R`" } else { "" };
            (
                format!("a centre in its plane{or_radius}"),
                format!("the centre of `{}` is {}", entry.code, each.join(", ")),
            )
        }
    };
    let finding =
        Finding::new(&META, cx.range(word), format!("arc without centre or radius: `{}`", cx.text(word)))
            .label(format!("needs {needs}"))
            .also(cx.range(end), "an end point alone does not define an arc")
            .note(format!("{note}  [{}]", entry.source))
            .help("add the centre or the radius, or write a straight move (`G1`)")
            .at_most(limit(entry.choice_confidence.unwrap_or(entry.confidence)));
    match cx.control().semantics().arcs.straight_setting.as_deref() {
        Some(setting) if cx.environment.setting(setting).is_none_or(|(value, _)| value != "alarm") => finding
            .note(format!("setting {setting} decides: a straight line, or an alarm"))
            .at_most(Severity::Warning),
        _ => finding,
    }
}

/// The planes that the arc may be in, each with its code and the words of a centre: the plane of the block, or those that the
/// control can choose from.
fn planes(cx: &BlockCx<'_>) -> Vec<(String, LetterSet)> {
    let centre = |effect| match effect {
        Effect::PlaneXy => Some(LetterSet::of("IJ")),
        Effect::PlaneZx => Some(LetterSet::of("IK")),
        Effect::PlaneYz => Some(LetterSet::of("JK")),
        _ => None,
    };
    let plane = |code: Code<'_>| Some((code.number().to_string(), centre(code.effect())?));
    let own: Vec<_> = cx.codes().filter_map(|(_, code)| plane(code)).collect();
    if let [_] = own.as_slice() {
        return own;
    }
    let all: Vec<_> = cx.control().codes().filter_map(plane).collect();
    if !all.is_empty() {
        return all;
    }
    let only = if cx.control().machine() == Machine::Mill { "IJ" } else { "IK" };
    vec![(String::new(), LetterSet::of(only))]
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::{World, check_rule, check_rule_in, findings, only};

    #[test]
    fn the_code_is_marked() {
        check_rule(
            &RULE,
            "linuxcnc",
            "G2 X10. Y5. F100.\nG3 I5.\nG2\nG17 G3 X1. R#1\n",
            &expect![[r#"
                1 | G2 X10. Y5. F100.
                  | ^^ error[arc-without-centre] arc without centre or radius: `G2`
            "#]],
        );
    }

    #[test]
    fn increments_are_end_points_too() {
        check_rule(
            &RULE,
            "fanuc-lathe",
            "G02 U10. W-5. F0.1\nG02 U10. W-5. R5. F0.1\n",
            &expect![[r#"
                1 | G02 U10. W-5. F0.1
                  | ^^^ warning[arc-without-centre] arc without centre or radius: `G02`
            "#]],
        );
    }

    #[test]
    fn a_setting_that_is_told_decides() {
        let mut alarms = World::default();
        alarms.machine.settings.insert("3403#5".to_owned(), "alarm".to_owned());
        check_rule_in(
            &RULE,
            "fanuc-mill",
            "G2 X10. Y5. F100.\n",
            &alarms,
            &expect![[r#"
            1 | G2 X10. Y5. F100.
              | ^^ error[arc-without-centre] arc without centre or radius: `G2`
        "#]],
        );
    }

    #[test]
    fn words_name_what_fits_the_plane() {
        let label = |control: &str, program: &str| {
            let found = findings(&only(&RULE), control, program, &World::default());
            let [found] = found.as_slice() else { panic!("{control}: {program}") };
            format!("{}; {}", found.label, found.notes.join("; "))
        };
        for (block, needs) in [
            ("G17 G2 X10. Y5. F100.", "needs `I`, `J` or `R`;"),
            ("G18 G2 X10. Z5. F100.", "needs `I`, `K` or `R`;"),
            ("G19 G2 Y10. Z5. F100.", "needs `J`, `K` or `R`;"),
            (
                "G2 X10. Y5. F100.",
                "needs a centre in its plane or `R`; the centre of `G2` is `I` or `J` in `G17`, ",
            ),
        ] {
            let said = label("haas-mill", block);
            assert!(said.starts_with(needs), "{block}: {said}");
        }
    }
}
