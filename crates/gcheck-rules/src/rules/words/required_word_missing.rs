//! A code without a word that it needs.

use gcheck_controls::{Code, Confidence, Letter, LetterSet, Need, WordEntry};
use gcheck_program::{BlockFlags, Word};

use crate::declare::declare_rule;
use crate::facts::dwell::time_in_other_word;
use crate::{BlockCx, Finding, Reads, Report, Run, limit};

declare_rule! {
    /// A code is in a block without a word that it needs every time.
    ///
    /// ## Why it matters
    /// The control stops with an alarm, or uses zero for the missing value. This rule does not cover words that last
    /// from earlier blocks.
    ///
    /// ## Reported
    /// ```nc,reported,linuxcnc
    /// G4
    /// ```
    /// ```nc,reported,haas-mill
    /// G154
    /// ```
    /// ```nc,reported,linuxcnc
    /// G10 L2 X0 Y0
    /// ```
    /// ## Not reported
    /// ```nc,quiet,linuxcnc
    /// G4 P0.5
    /// G4 P#1
    /// ```
    rule "required-word-missing" in "words" {
        summary: "code without a word that it needs",
        severity: Error,
        tier: Block,
        control_specific: true,
        since: "0.1.0",
        run: Run::BlockAndValues { trigger: BlockFlags::CODE, reads: Reads::Numbers, check },
    }
}

fn check(cx: &BlockCx<'_>, report: &mut Report<'_>) {
    for (word, code) in cx.codes() {
        for needed in code
            .entry()
            .words
            .iter()
            .filter(|w| w.need == Need::Required || w.unless_comment || !w.required_with.is_empty())
        {
            let with = beside(cx, needed);
            // A comment may be the path of a file.
            let named = !needed.unless_comment || cx.block().flags.contains(BlockFlags::COMMENT);
            if needed.need != Need::Required && with.is_none() && named {
                continue;
            }
            let stands =
                Letter::parse(&needed.letter).is_none_or(|letter| cx.block().letters.contains(letter));
            if is_excluded(cx, code, needed) {
                continue;
            }
            // Another rule reports a time in a word of another control.
            let is_elsewhere = !stands && time_in_other_word(cx, code).is_some();
            if !stands && !is_elsewhere && is_certain(cx, word, code) {
                report.add(finding(cx, word, code, needed, with));
            }
        }
    }
}

/// Does the code not take the word beside another one of the block? Then the other one is at fault.
fn is_excluded(cx: &BlockCx<'_>, code: Code<'_>, needed: &WordEntry) -> bool {
    code.entry().not_together.iter().any(|items| {
        let (own, others): (Vec<_>, Vec<_>) = items.iter().partition(|item| {
            Letter::parse(&needed.letter).is_some_and(|letter| LetterSet::of_item(item).contains(letter))
        });
        !own.is_empty() && others.iter().any(|item| cx.block().letters.intersects(LetterSet::of_item(item)))
    })
}

/// The word of the block beside which the code needs another one, as data writes it: `L2`, or `J` for any value.
fn beside<'a>(cx: &BlockCx<'a>, needed: &'a WordEntry) -> Option<&'a str> {
    let stands = |item: &&String| {
        if let Some(letter) = Letter::parse(item) {
            return cx.block().letters.contains(letter);
        }
        let (letter, value) = item.split_at_checked(1).unwrap_or_default();
        let value: Option<f64> = value.parse().ok();
        let is = |word: &Word| Some(word.letter) == Letter::parse(letter) && word.number() == value;
        value.is_some() && cx.words().iter().any(is)
    };
    needed.required_with.iter().find(stands).map(String::as_str)
}

/// Nothing hides the word: no syntax error, and the code is not an argument of a macro.
fn is_certain(cx: &BlockCx<'_>, word: &Word, code: Code<'_>) -> bool {
    !cx.block().flags.contains(BlockFlags::ERROR)
        && !code.is_user()
        && (code.entry().any_words || !cx.words_may_be_arguments())
        // If one code is written twice, the first one is reported.
        && cx.words().iter().find(|w| w.code == word.code).is_some_and(|w| w.range() == word.range())
}

fn finding(cx: &BlockCx<'_>, word: &Word, code: Code<'_>, needed: &WordEntry, with: Option<&str>) -> Finding {
    let (text, letter, entry) = (cx.text(word), &needed.letter, code.entry());
    let when = with.map_or_else(|| "every time".to_owned(), |with| format!("with `{with}`"));
    let confidence = needed.confidence.unwrap_or(Confidence::Manual).min(entry.confidence);
    Finding::new(&META, cx.range(word), format!("`{text}` without `{letter}`"))
        .label(format!("needs `{letter}`: {}", needed.is))
        .note(format!(
            "`{}` ({}) needs `{letter}` in its block {when}  [{}]",
            entry.code, entry.title, entry.source
        ))
        .help(format!("add `{letter}` to the block"))
        .alarm(cx.alarm_of(META.id, &entry.code))
        .at_most(limit(confidence))
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::{World, check_rule, findings, only, words};

    #[test]
    fn the_code_is_marked() {
        check_rule(
            &RULE,
            "linuxcnc",
            "G90 G4\nG4 P#1\nG4 P\nM61\n",
            &expect![[r#"
                1 | G90 G4
                  |     ^^ error[required-word-missing] `G4` without `P`
                4 | M61
                  | ^^^ error[required-word-missing] `M61` without `Q`
            "#]],
        );
    }

    #[test]
    fn arguments_of_a_macro_need_nothing() {
        check_rule(
            &RULE,
            "fanuc-mill",
            "G65 P9010 M198\nG65 A1.\nG4\n",
            &expect![[r#"
                2 | G65 A1.
                  | ^^^ error[required-word-missing] `G65` without `P`
            "#]],
        );
    }

    #[test]
    fn a_word_that_another_one_asks_for() {
        check_rule(
            &RULE,
            "linuxcnc",
            "G10 L2 X0 Y0\nG10 L2 P0 X0 Y0\nG10 L20 P#1 X0\nG10 L0\nG10 L[1+1] X0\n",
            &expect![[r#"
                1 | G10 L2 X0 Y0
                  | ^^^ error[required-word-missing] `G10` without `P`
                5 | G10 L[1+1] X0
                  | ^^^ error[required-word-missing] `G10` without `P`
            "#]],
        );
        let found = findings(&only(&RULE), "linuxcnc", "G10 L2 X0 Y0\n", &World::default());
        let text = words(&found[0]);
        assert!(text.contains("needs `P` in its block with `L2`"), "{text}");
    }

    #[test]
    fn a_letter_asks_for_another_with_any_value() {
        check_rule(
            &RULE,
            "haas-mill",
            "G83 Z-1. R.1 I.2 F5.\nG83 Z-1. R.1 I.2 J.05 K.1 F5.\nG83 Z-1. R.1 Q.3 K.5 F5.\nG73 Z-1. R.1 Q.3 K.5 F5.\nG73 Z-1. R.1 J#1 F5.\n",
            &expect![[r#"
                1 | G83 Z-1. R.1 I.2 F5.
                  | ^^^ warning[required-word-missing] `G83` without `J`
                1 | G83 Z-1. R.1 I.2 F5.
                  | ^^^ warning[required-word-missing] `G83` without `K`
                5 | G73 Z-1. R.1 J#1 F5.
                  | ^^^ warning[required-word-missing] `G73` without `I`
            "#]],
        );
        check_rule(
            &RULE,
            "haas-lathe",
            "G72 W0.05 R0.02\nG72 P10 Q20 U0.01 W0.005 F0.01\nG71 U0.05 R0.02\nG71 P10 Q20 U0.01 W0.005 F0.01\nG71 U0.01 W0.005 D0.05 F0.01\n",
            &expect![[r#"
                5 | G71 U0.01 W0.005 D0.05 F0.01
                  | ^^^ error[required-word-missing] `G71` without `P`
                5 | G71 U0.01 W0.005 D0.05 F0.01
                  | ^^^ error[required-word-missing] `G71` without `Q`
            "#]],
        );
    }

    #[test]
    fn words_say_what_is_missing() {
        let found = findings(&only(&RULE), "haas-mill", "G154\n", &World::default());
        let text = words(&found[0]);
        assert!(text.contains("here: needs `P`: "), "{text}");
        assert!(text.contains("help: add `P` to the block"), "{text}");
    }
}
