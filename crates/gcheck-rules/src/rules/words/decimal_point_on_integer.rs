//! A decimal point on an address that takes whole numbers.

use gcheck_controls::{Motion, WordKind};
use gcheck_program::{BlockFlags, Word};

use crate::declare::declare_rule;
use crate::{BlockCx, Finding, Fix, Reads, Report, Run, WordFacts, limit};

declare_rule! {
    /// A word that takes a whole number is written with a decimal point.
    ///
    /// ## Why it matters
    /// Tool, offset, program and repeat numbers are counts. A control that requires whole numbers stops with an alarm.
    ///
    /// ## Reported
    /// ```nc,reported,fanuc-mill
    /// G43 H1. Z50.
    /// ```
    /// ## Not reported
    /// ```nc,quiet,fanuc-mill
    /// G43 H1 Z50.
    /// ```
    /// A control that reads whole numbers with a point:
    /// ```nc,quiet,linuxcnc
    /// T1.0 M6
    /// ```
    rule "decimal-point-on-integer" in "words" {
        summary: "decimal point on an address that takes whole numbers",
        severity: Error,
        tier: Block,
        control_specific: true,
        fixable: Safely,
        since: "0.1.0",
        run: Run::BlockAndValues { trigger: BlockFlags::POINT_ON_INTEGER, reads: Reads::Numbers, check },
    }
}

fn check(cx: &BlockCx<'_>, report: &mut Report<'_>) {
    for word in cx.words().iter().filter(|w| w.shape.point) {
        let general = cx.control().letter(word.letter);
        if let Some(facts) = cx.facts(word)
            && takes_no_point(facts.kind)
            && cx.is_plain(&facts)
            // The meaning of a word that no code of the block reads is unknown here.
            && (facts.code.is_some() || general.is_some_and(|entry| entry.free))
        {
            report.add(finding(cx, word, &facts));
        }
    }
}

fn takes_no_point(kind: WordKind) -> bool {
    kind.is_whole() || kind == WordKind::Milliseconds
}

fn finding(cx: &BlockCx<'_>, word: &Word, facts: &WordFacts<'_>) -> Finding {
    let text = cx.text(word);
    // That an address is whole everywhere is more certain than its meaning with one code.
    let general = cx
        .control()
        .letter(word.letter)
        .filter(|entry| takes_no_point(entry.kind))
        .map(|entry| entry.confidence);
    let confidence = general.map_or(facts.confidence, |general| general.max(facts.confidence));
    let help = match word.number() {
        // A time in milliseconds with a point may have been meant as seconds.
        Some(number) if facts.kind == WordKind::Milliseconds => {
            format!(
                "write whole milliseconds: `{}{}` for {number} seconds",
                word.letter,
                (number * 1000.0).round()
            )
        }
        _ => "write the number without a decimal point".to_owned(),
    };
    let finding = Finding::new(&META, cx.range(word), format!("decimal point on a whole number: `{text}`"))
        .label(facts.is)
        .note(format!("`{}` takes a whole number here  [{}]", word.letter, facts.source))
        .help(help)
        .at_most(limit(confidence));
    // Two codes that read one word may each take its point another way.
    let is_shared = cx.codes().filter(|(_, code)| code.reads().contains(word.letter)).count() > 1;
    // A step of a cycle that is written in millimetres is another number in least increments.
    let is_of_cycle = facts.code.is_some_and(|code| code.motion() != Motion::None);
    match whole(text) {
        Some(whole) if facts.kind != WordKind::Milliseconds && !is_shared && !is_of_cycle => {
            finding.fix(Fix::safe(format!("write `{text}` as `{whole}`"), cx.range(word), whole))
        }
        _ => finding,
    }
}

/// The word without its point, if only zeros follow the point.
fn whole(text: &str) -> Option<&str> {
    let (whole, decimals) = text.split_once('.')?;
    (whole.ends_with(|c: char| c.is_ascii_digit()) && decimals.bytes().all(|b| b == b'0')).then_some(whole)
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::{World, check_rule, findings, fixed, only, words};

    #[test]
    fn counts_are_whole() {
        check_rule(
            &RULE,
            "fanuc-mill",
            "T5. M6\nG43 H#1 Z50.\nG65 P9010 H1.\nG4 P1.5\n",
            &expect![[r#"
                1 | T5. M6
                  | ^^^ error[decimal-point-on-integer] decimal point on a whole number: `T5.`
                4 | G4 P1.5
                  |    ^^^^ error[decimal-point-on-integer] decimal point on a whole number: `P1.5`
            "#]],
        );
    }

    #[test]
    fn a_step_in_least_increments() {
        let program = |step: &str| format!("G21 G99\nG0 X0. Z5.\nG74 R1.\nG74 Z-60. Q{step} F.1\nM30\n");
        check_rule(
            &RULE,
            "fanuc-lathe",
            &program("15."),
            &expect![[r#"
            4 | G74 Z-60. Q15. F.1
              |           ^^^^ warning[decimal-point-on-integer] decimal point on a whole number: `Q15.`
        "#]],
        );
        check_rule(&RULE, "fanuc-lathe", &program("15000"), &expect![[""]]);
        // Without the point it would be a step of 15 thousandths.
        let found = findings(&only(&RULE), "fanuc-lathe", &program("15."), &World::default());
        assert!(found.iter().all(|finding| finding.fixes.is_empty()));
    }

    #[test]
    fn a_time_that_may_be_seconds_keeps_its_point() {
        check_rule(&RULE, "haas-mill", "G4 P1.5\n", &expect![[""]]);
        check_rule(&RULE, "linuxcnc", "T1.0 M6\n", &expect![[""]]);
    }

    #[test]
    fn the_fix_takes_the_point_away() {
        let program = "G43 H01. Z50.\n";
        let found = findings(&only(&RULE), "fanuc-mill", program, &World::default());
        expect![[r#"
            G43 H01 Z50.
        "#]]
        .assert_eq(&fixed(program, &found[0]));
        assert!(words(&found[0]).starts_with("decimal point on a whole number: `H01.`\n  here: "));
    }
}
