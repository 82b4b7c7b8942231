//! An address twice in a block.

use gcheck_controls::{Handling, LetterSet};
use gcheck_program::{BlockFlags, Word};

use crate::declare::declare_rule;
use crate::{BlockCx, Finding, Fix, Reads, Report, Run, Severity, limit};

declare_rule! {
    /// One block has the same address twice.
    ///
    /// ## Why it matters
    /// Only one value can count. Some controls refuse the block, others silently use the last value, so the other one
    /// is lost. Often an end of line is missing.
    ///
    /// ## Reported
    /// ```nc,reported,linuxcnc
    /// G1 X1. Y2. X3. F100.
    /// ```
    /// If the value is the same twice, the fix removes the second word.
    /// ```nc,reported,fanuc-mill
    /// G1 X1. Y2. X1. F100.
    /// ```
    /// ## Not reported
    /// Arguments of a macro: a second `I` is another argument.
    /// ```nc,quiet,fanuc-mill
    /// G65 P9010 I1. J2. I3. J4.
    /// ```
    rule "word-given-twice" in "words" {
        summary: "address twice in a block",
        severity: Error,
        tier: Block,
        fixable: Safely,
        since: "0.1.0",
        run: Run::BlockAndValues { trigger: BlockFlags::REPEATED, reads: Reads::Numbers, check },
    }
}

fn check(cx: &BlockCx<'_>, report: &mut Report<'_>) {
    if !cx.words_are_plain() {
        return;
    }
    let mut seen = LetterSet::EMPTY;
    for word in cx.words() {
        // A sequence number at the head and a parameter number after a code are two things.
        let is_datum = cx.codes().any(|(_, code)| code.reads().contains(word.letter));
        let is_label = cx.words().first().is_some_and(|first| first.letter == word.letter)
            && is_datum
            && word.letter.ascii() == b'N';
        let repeatable = cx.control().letter(word.letter).is_none_or(|entry| entry.repeatable);
        if !seen.insert(word.letter)
            && !repeatable
            && !is_label
            && let Some(first) = cx.words().iter().find(|w| w.letter == word.letter)
        {
            report.add(finding(cx, first, word));
        }
    }
}

fn finding(cx: &BlockCx<'_>, first: &Word, second: &Word) -> Finding {
    let rules = cx.control().block_rules();
    let letter = second.letter;
    let (does, severity) = match rules.word_twice {
        Handling::Refused => ("refuses the block", Severity::Error),
        Handling::LastWins | Handling::Ignored | Handling::Accepted => {
            ("uses the last one", Severity::Warning)
        }
    };
    // If both have one value, removing the second loses nothing.
    let is_same = first.number().is_some() && cx.text(first).eq_ignore_ascii_case(cx.text(second));
    let fix = is_same
        .then(|| Fix::safe(format!("remove the second `{}`", cx.text(second)), cx.with_blanks(second), ""));
    Finding::new(&META, cx.range(second), format!("two `{letter}` words in one block"))
        .label(format!("`{letter}` again"))
        .also(cx.range(first), format!("`{letter}` is already here"))
        .note(format!("an address may be in a block once; this control {does}  [{}]", rules.source))
        .help("keep one of the two, or begin a new block before the second")
        .fix_if(fix)
        .at_most(severity)
        .at_most(limit(rules.confidence))
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::{World, check_rule, findings, only, words};

    #[test]
    fn the_second_word_is_marked() {
        check_rule(
            &RULE,
            "linuxcnc",
            "G1 X1. Y2. X3. F100.\nG90 G1 X1. Y1.\n",
            &expect![[r#"
                1 | G1 X1. Y2. X3. F100.
                  |            ^^^ error[word-given-twice] two `X` words in one block
            "#]],
        );
    }

    #[test]
    fn a_control_that_takes_the_last_gives_a_warning() {
        check_rule(
            &RULE,
            "fanuc-mill",
            "G1 X1. X#1 F100.\nN10 G10 L50 N3401 R1\n",
            &expect![[r#"
                1 | G1 X1. X#1 F100.
                  |        ^^^ warning[word-given-twice] two `X` words in one block
            "#]],
        );
    }

    #[test]
    fn words_say_which_control_does_what() {
        let found = findings(&only(&RULE), "linuxcnc", "G1 X1. X3. F100.\n", &World::default());
        expect![[r#"
            two `X` words in one block
              here: `X` again
              there: `X` is already here
              note: an address may be in a block once; this control refuses the block  [LCNC-SRC; RS274-2.9]
              help: keep one of the two, or begin a new block before the second
        "#]]
        .assert_eq(&words(&found[0]));
    }
}
