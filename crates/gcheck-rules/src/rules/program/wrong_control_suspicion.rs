//! A program that looks written for another control.

use std::ops::Range;

use gcheck_controls::{CodeNumber, Control, Score, scores};

use crate::declare::declare_rule;
use crate::{FileCx, Finding, Report, Run};

declare_rule! {
    /// The program uses codes or forms that the chosen control does not have and another control has.
    ///
    /// ## Why it matters
    /// A check for the wrong control reports false mistakes and misses real ones. On the wrong machine the program
    /// stops with an alarm, or moves in an unintended way.
    ///
    /// ## Reported
    /// ```nc,reported,fanuc-mill
    /// o<square> sub
    /// G38.2 Z-10 F50
    /// #<depth> = [#1 * 2]
    /// o<square> endsub
    /// ```
    /// ## Not reported
    /// A single unknown code is not enough.
    /// ```nc,quiet,fanuc-mill
    /// O0001
    /// G187 P3
    /// G0 X1.
    /// M30
    /// ```
    /// ```nc,quiet,linuxcnc
    /// o<square> sub
    /// G38.2 Z-10 F50
    /// o<square> endsub
    /// ```
    rule "wrong-control-suspicion" in "program" {
        summary: "program looks written for another control",
        severity: Warning,
        tier: Program,
        since: "0.1.0",
        run: Run::Program { check },
    }
}

/// By so many points another control must lead: more than one strong hint.
const LEAD: i32 = 8;

fn check(cx: &FileCx<'_>, report: &mut Report<'_>) {
    // A guessed control is already the best guess.
    if !cx.environment.control_is_chosen() || cx.file_index.first_block.is_none() {
        return;
    }
    let scores = scores(cx.text.evidence());
    let own = scores.iter().find(|s| s.guess.control == cx.control().name());
    let own_points = own.map_or(0, |s| s.points);
    let [best, ..] = scores.as_slice() else { return };
    if best.guess.control == cx.control().name() || best.points - own_points < LEAD {
        return;
    }
    let Ok(other) = gcheck_controls::load(&best.guess.control) else { return };
    let unknown = codes_of_the_other(cx, &other);
    // Points alone may come from a comment; the text must show something that this control does not have.
    if unknown.len() + own.map_or(0, |s| s.against) >= 2 {
        report.add(finding(cx, best, &other, &unknown));
    }
}

/// Codes of the program that only the other control has.
fn codes_of_the_other<'a>(cx: &FileCx<'a>, other: &Control) -> Vec<&'a (CodeNumber, Range<u32>)> {
    let codes = cx.file_index.codes.iter();
    codes
        .filter(|(number, _)| cx.control().code(*number).is_none() && other.code(*number).is_some())
        .collect()
}

fn finding(cx: &FileCx<'_>, best: &Score, other: &Control, unknown: &[&(CodeNumber, Range<u32>)]) -> Finding {
    let first = cx.file_index.first_block.clone().unwrap_or_default();
    let name = other.name();
    let mut finding = Finding::new(
        &META,
        first,
        format!("program looks written for `{name}`, not for `{}`", cx.control().name()),
    )
    .label(format!("checked for: {}", cx.control().title()))
    .note(format!("{} points to: {}", shown(&best.guess.because), other.title()))
    .help(format!("choose the control with `--control {name}`, or `control = \"{name}\"` in `gcheck.toml`"));
    for (number, range) in unknown.iter().take(3) {
        finding = finding.also(range.clone(), format!("only the other control has `{number}`"));
    }
    finding
}

/// A code as programs write it is in backticks, words are not.
fn shown(because: &str) -> String {
    if because.contains([' ', '`']) { because.to_owned() } else { format!("`{because}`") }
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::{World, check_rule, check_rule_in, findings, only, words};

    const LATHE: &str = "O1 (ST-20)\nG28 U0. W0.\nT0101\nG241 X1. Z-1. R0.1 F0.01\nG105 J1.\nM30\n";

    #[test]
    fn a_lathe_program_on_a_mill_is_told_once() {
        check_rule(
            &RULE,
            "haas-mill",
            LATHE,
            &expect![[r#"
            1 | O1 (ST-20)
              | ^^^^^^^^^^ warning[wrong-control-suspicion] program looks written for `haas-lathe`, not for `haas-mill`
        "#]],
        );
        check_rule(&RULE, "haas-lathe", LATHE, &expect![[""]]);
    }

    #[test]
    fn a_guessed_control_is_not_doubted() {
        let world = World { control_is_guessed: true, ..World::default() };
        check_rule_in(&RULE, "haas-mill", LATHE, &world, &expect![[""]]);
    }

    #[test]
    fn the_reason_is_said() {
        let found = findings(&only(&RULE), "haas-mill", LATHE, &World::default());
        expect![[r#"
            program looks written for `haas-lathe`, not for `haas-mill`
              here: checked for: Haas mill (classic control and NGC)
              there: only the other control has `G241`
              there: only the other control has `G105`
              note: `G105` points to: Haas lathe (ST, DS, SL, TL; NGC and classic)
              help: choose the control with `--control haas-lathe`, or `control = "haas-lathe"` in `gcheck.toml`
        "#]].assert_eq(&found.first().map(words).unwrap_or_default());
    }
}
