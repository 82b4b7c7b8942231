//! A word that is not allowed with a code.

use gcheck_controls::{Code, Letter};
use gcheck_program::{BlockFlags, Word};

use crate::declare::declare_rule;
use crate::{BlockCx, Finding, Reads, Report, Run, limit};

declare_rule! {
    /// A word shares a block with a code that does not allow it, although another code could use it.
    ///
    /// ## Why it matters
    /// The control stops with an alarm at the block.
    ///
    /// ## Reported
    /// ```nc,reported,linuxcnc
    /// G33 Z-10. K1.5 F100.
    /// ```
    /// ## Not reported
    /// ```nc,quiet,linuxcnc
    /// G33 Z-10. K1.5
    /// ```
    rule "word-forbidden" in "words" {
        summary: "word that is not allowed with a code",
        severity: Error,
        tier: Block,
        control_specific: true,
        since: "0.1.0",
        run: Run::BlockAndValues { trigger: BlockFlags::CODE, reads: Reads::Numbers, check },
    }
}

fn check(cx: &BlockCx<'_>, report: &mut Report<'_>) {
    for (_, code) in cx.codes() {
        for letter in code.entry().forbidden.iter().filter_map(|letter| Letter::parse(letter)) {
            if let Some(word) = cx.words().iter().find(|w| w.letter == letter && !cx.may_be_left_out(w))
                && cx.words_are_plain()
            {
                report.add(finding(cx, code, word));
            }
        }
    }
}

fn finding(cx: &BlockCx<'_>, code: Code<'_>, word: &Word) -> Finding {
    let entry = code.entry();
    let written = cx.written(code);
    Finding::new(&META, cx.range(word), format!("`{}` in a block with `{written}`", cx.text(word)))
        .label(format!("`{written}` does not allow `{}` in its block", word.letter))
        .note(format!(
            "`{}` ({}) must not share its block with `{}`  [{}]",
            entry.code, entry.title, word.letter, entry.source
        ))
        .help("put the word in another block")
        .alarm(cx.alarm_of(META.id, &entry.code))
        .at_most(limit(entry.confidence))
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::{World, check_rule, findings, only, words};

    #[test]
    fn the_word_is_marked() {
        check_rule(
            &RULE,
            "linuxcnc",
            "G33 Z-10. K1.5 F100.\nG33 Z-10. K1.5\n",
            &expect![[r#"
                1 | G33 Z-10. K1.5 F100.
                  |                ^^^^^ error[word-forbidden] `F100.` in a block with `G33`
            "#]],
        );
    }

    #[test]
    fn corner_words_are_meant_too() {
        check_rule(
            &RULE,
            "fanuc-lathe",
            "G32 Z-10. F1.5 ,R[#1+1.]\nG4 X1. T0101\n",
            &expect![[r#"
                1 | G32 Z-10. F1.5 ,R[#1+1.]
                  |                ^^^^^^^^^ error[word-forbidden] `,R[#1+1.]` in a block with `G32`
                2 | G4 X1. T0101
                  |        ^^^^^ error[word-forbidden] `T0101` in a block with `G4`
            "#]],
        );
    }

    #[test]
    fn words_name_the_code() {
        let found = findings(&only(&RULE), "linuxcnc", "G33 Z-10. K1.5 F100.\n", &World::default());
        let text = words(&found[0]);
        assert!(text.contains("here: `G33` does not allow `F` in its block"), "{text}");
    }
}
