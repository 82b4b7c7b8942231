//! A value that cylindrical mapping ignores.

use gcheck_controls::{Code, Effect, WordKind};
use gcheck_program::{BlockFlags, Word};

use crate::declare::declare_rule;
use crate::{BlockCx, Finding, Reads, Report, Run, limit};

declare_rule! {
    /// An axis word of cylindrical mapping has a value other than zero.
    ///
    /// ## Why it matters
    /// The word only selects the axis. Nothing moves: a part that should be turned to 90 degrees does not turn, and the
    /// contour is cut in another place.
    ///
    /// ## Reported
    /// ```nc,reported,haas-mill
    /// G107 Y0. A90. Q2.5
    /// ```
    /// ## Not reported
    /// ```nc,quiet,haas-mill
    /// G0 A90.
    /// G107 Y0. A0. Q2.5
    /// ```
    rule "cylinder-word-value-ignored" in "mapping" {
        summary: "value of an axis word that cylindrical mapping ignores",
        severity: Warning,
        tier: Block,
        since: "0.1.0",
        run: Run::BlockAndValues { trigger: BlockFlags::CODE, reads: Reads::Numbers, check },
    }
}

fn check(cx: &BlockCx<'_>, report: &mut Report<'_>) {
    if cx.control().semantics().cylinder.is_none() {
        return;
    }
    let Some((_, code)) = cx.codes().find(|(_, code)| code.effect() == Effect::CylinderMapping) else {
        return;
    };
    let is_flag = |word: &&Word| cx.facts(word).is_some_and(|facts| facts.kind == WordKind::Flag);
    let ignored = |word: &&Word| word.number().is_some_and(|value| value != 0.0);
    let moves = cx.codes().any(|(_, other)| other.entry().takes_axes && other.number() != code.number());
    if !moves && cx.words_are_plain() {
        for word in cx.words().iter().filter(is_flag).filter(ignored) {
            report.add(finding(cx, code, word));
        }
    }
}

fn finding(cx: &BlockCx<'_>, code: Code<'_>, word: &Word) -> Finding {
    let (entry, letter, text) = (code.entry(), word.letter, cx.text(word));
    let is_rotary = matches!(letter.ascii(), b'A' | b'B' | b'C');
    let label = if is_rotary {
        format!("selects the axis that turns the part; {letter} does not turn here")
    } else {
        format!("selects the axis to wrap; {letter} does not move here")
    };
    Finding::new(
        &META,
        cx.range(word),
        format!("the value of `{text}` does not count (`{}`)", cx.written(code)),
    )
    .label(label)
    .note(format!(
        "`{}` ({}) ignores the values of its axis words  [{}]",
        entry.code, entry.title, entry.source
    ))
    .help(format!("write `{letter}0.`, and move the axis in an earlier block if it must be elsewhere"))
    .at_most(limit(entry.confidence))
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::{World, check_rule, findings, only, words};

    #[test]
    fn each_value_is_marked_and_sizes_are_not() {
        check_rule(
            &RULE,
            "haas-mill",
            "G107 Y1.5 A-90. Q2.5\nG107 Y#1 A0 R1.\nG107 A[90.] Q3.\nG107\n",
            &expect![[r#"
                1 | G107 Y1.5 A-90. Q2.5
                  |      ^^^^ warning[cylinder-word-value-ignored] the value of `Y1.5` does not count (`G107`)
                1 | G107 Y1.5 A-90. Q2.5
                  |           ^^^^^ warning[cylinder-word-value-ignored] the value of `A-90.` does not count (`G107`)
                3 | G107 A[90.] Q3.
                  |      ^^^^^^ warning[cylinder-word-value-ignored] the value of `A[90.]` does not count (`G107`)
            "#]],
        );
    }

    #[test]
    fn a_radius_in_the_axis_word_counts() {
        check_rule(&RULE, "fanuc-mill", "G107 C50.\n", &expect![[""]]);
    }

    #[test]
    fn what_it_says() {
        let found = findings(&only(&RULE), "haas-mill", "G107 Y2. A90. Q2.5\n", &World::default());
        expect![[r#"
            the value of `Y2.` does not count (`G107`)
              here: selects the axis to wrap; Y does not move here
              note: `G107` (cylindrical mapping) ignores the values of its axis words  [Haas 96-8000 June 1999 p.203 (printed); gcodes.net, G107; Haas online manual, inverse time and feed per minute modes; HM17 p.307]
              help: write `Y0.`, and move the axis in an earlier block if it must be elsewhere
            the value of `A90.` does not count (`G107`)
              here: selects the axis that turns the part; A does not turn here
              note: `G107` (cylindrical mapping) ignores the values of its axis words  [Haas 96-8000 June 1999 p.203 (printed); gcodes.net, G107; Haas online manual, inverse time and feed per minute modes; HM17 p.307]
              help: write `A0.`, and move the axis in an earlier block if it must be elsewhere
        "#]].assert_eq(&found.iter().map(words).collect::<String>());
    }
}
