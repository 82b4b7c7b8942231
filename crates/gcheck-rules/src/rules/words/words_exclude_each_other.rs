//! Words that a code does not accept together.

use gcheck_controls::{Code, Confidence, LetterSet};
use gcheck_program::{BlockFlags, Word};

use crate::declare::declare_rule;
use crate::{BlockCx, Finding, Reads, Report, Run, limit};

declare_rule! {
    /// Two words of a block give the same thing in different ways, and the code accepts only one of them.
    ///
    /// ## Why it matters
    /// A radius and a centre may contradict each other. The control stops with an alarm, or uses one of the two.
    ///
    /// ## Reported
    /// ```nc,reported,linuxcnc
    /// G2 X10. Y0. I5. R5. F100.
    /// ```
    /// ## Not reported
    /// ```nc,quiet,linuxcnc
    /// G2 X10. Y0. I5. J0. F100.
    /// ```
    rule "words-exclude-each-other" in "words" {
        summary: "words that a code does not accept together",
        severity: Error,
        tier: Block,
        control_specific: true,
        since: "0.1.0",
        run: Run::BlockAndValues { trigger: BlockFlags::CODE, reads: Reads::Numbers, check },
    }
}

fn check(cx: &BlockCx<'_>, report: &mut Report<'_>) {
    for (_, code) in cx.codes() {
        for items in &code.entry().not_together {
            let mut given = items.iter().filter_map(|item| first_given(cx, LetterSet::of_item(item)));
            if let Some(one) = given.next()
                && let Some(other) = given.next()
                && cx.words_are_plain()
            {
                let (first, second) =
                    if one.range().start < other.range().start { (one, other) } else { (other, one) };
                report.add(finding(cx, code, first, second));
            }
        }
    }
}

/// The first word of these addresses that is sure to have a value.
fn first_given<'a>(cx: &BlockCx<'a>, letters: LetterSet) -> Option<&'a Word> {
    cx.words().iter().find(|word| letters.contains(word.letter) && !cx.may_be_left_out(word))
}

fn finding(cx: &BlockCx<'_>, code: Code<'_>, first: &Word, second: &Word) -> Finding {
    let entry = code.entry();
    let (a, b) = (first.letter, second.letter);
    let confidence = entry.choice_confidence.unwrap_or(entry.confidence);
    let note = if confidence == Confidence::Assumed && entry.confidence > confidence {
        format!("gcheck assumes that `{}` ({}) takes `{a}` or `{b}`, not both", entry.code, entry.title)
    } else {
        format!("`{}` ({}) accepts `{a}` or `{b}`, not both", entry.code, entry.title)
    };
    Finding::new(&META, cx.range(second), format!("`{a}` and `{b}` together with `{}`", cx.written(code)))
        .label(meaning(code, second))
        .also(cx.range(first), meaning(code, first))
        .note(format!("{note}  [{}]", entry.source))
        .help(format!("keep `{a}` or `{b}`"))
        .alarm(cx.alarm_of(META.id, &entry.code))
        .at_most(limit(confidence))
}

fn meaning<'a>(code: Code<'a>, word: &Word) -> &'a str {
    let mut words = code.entry().words.iter();
    words
        .find(|w| gcheck_controls::Letter::parse(&w.letter) == Some(word.letter))
        .map_or("", |w| w.is.as_str())
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::{World, check_rule, findings, only, words};

    #[test]
    fn radius_and_centre() {
        check_rule(
            &RULE,
            "linuxcnc",
            "G2 X10. Y0. R#1 I5. F100.\nG2 X10. I5. J0.\nM66 P1 E0 L0\n",
            &expect![[r#"
                1 | G2 X10. Y0. R#1 I5. F100.
                  |                 ^^^ error[words-exclude-each-other] `R` and `I` together with `G2`
                3 | M66 P1 E0 L0
                  |        ^^ error[words-exclude-each-other] `P` and `E` together with `M66`
            "#]],
        );
    }

    #[test]
    fn another_control_another_pair() {
        check_rule(
            &RULE,
            "haas-lathe",
            "G83 Z-1. Q0.1 I0.2 F0.1\nG83 Z-1. I0.2 J0.1 K0.05 F0.1\n",
            &expect![[r#"
                1 | G83 Z-1. Q0.1 I0.2 F0.1
                  |               ^^^^ error[words-exclude-each-other] `Q` and `I` together with `G83`
            "#]],
        );
    }

    #[test]
    fn what_is_only_assumed_is_a_warning() {
        check_rule(
            &RULE,
            "generic-mill",
            "G4 P500 X0.5\nG4 U0.5 X0.5\nG4 P500\nG4\n",
            &expect![[r#"
                1 | G4 P500 X0.5
                  |         ^^^^ warning[words-exclude-each-other] `P` and `X` together with `G4`
                2 | G4 U0.5 X0.5
                  |         ^^^^ warning[words-exclude-each-other] `U` and `X` together with `G4`
            "#]],
        );
    }

    #[test]
    fn an_empty_variable_takes_its_word_out() {
        let program = |value: &str| format!("O1\n#1={value}\nG107 Y0. A0. Q2. R#1\nG107\nM30\n");
        check_rule(&RULE, "haas-mill", &program("#0"), &expect![[""]]);
        check_rule(&RULE, "haas-mill", &program("#500"), &expect![[""]]);
        check_rule(
            &RULE,
            "haas-mill",
            &program("1."),
            &expect![[r#"
                3 | G107 Y0. A0. Q2. R#1
                  |                  ^^^ error[words-exclude-each-other] `Q` and `R` together with `G107`
            "#]],
        );
    }

    #[test]
    fn words_name_both() {
        let found = findings(&only(&RULE), "linuxcnc", "G2 X10. I5. R5.\n", &World::default());
        let text = words(&found[0]);
        assert!(text.contains("accepts `I` or `R`, not both"), "{text}");
    }
}
