//! An address that the control does not have.

use gcheck_program::{BlockFlags, Word};

use crate::declare::declare_rule;
use crate::{BlockCx, Finding, Report, Run, limit};

declare_rule! {
    /// A word has an address that the control does not have.
    ///
    /// ## Why it matters
    /// The control stops with an alarm. The program may be written for another control, or the letter is mistyped.
    ///
    /// ## Reported
    /// ```nc,reported,linuxcnc
    /// G1 X10. ,R2. F100.
    /// ```
    /// ```nc,reported,haas-mill
    /// G1 @10. ^45. F100.
    /// ```
    /// ## Not reported
    /// ```nc,quiet,haas-mill
    /// G1 X10. ,R2. F100.
    /// ```
    rule "unknown-address" in "words" {
        summary: "address that the control does not have",
        severity: Error,
        tier: Block,
        control_specific: true,
        since: "0.1.0",
        run: Run::Block { trigger: BlockFlags::UNKNOWN_ADDRESS, check },
    }
}

fn check(cx: &BlockCx<'_>, report: &mut Report<'_>) {
    if cx.block().flags.contains(BlockFlags::ERROR) || cx.words_may_be_arguments() {
        return;
    }
    for word in cx.words() {
        if cx.control().letter(word.letter).is_none() {
            report.add(finding(cx, word));
        }
    }
}

fn finding(cx: &BlockCx<'_>, word: &Word) -> Finding {
    let letter = word.letter;
    Finding::new(&META, cx.range(word), format!("unknown address `{letter}`"))
        .label("no such address")
        .note(format!("{} has no address `{letter}`", cx.control().title()))
        .help("correct the letter, or use the equivalent of this control")
        .at_most(limit(cx.control().numbers().confidence))
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::{World, check_rule, findings, only, words};

    #[test]
    fn corner_words_are_not_everywhere() {
        check_rule(
            &RULE,
            "linuxcnc",
            "G1 X10. ,R2. F100.\nG1 @#1\n",
            &expect![[r#"
                1 | G1 X10. ,R2. F100.
                  |         ^^^^ error[unknown-address] unknown address `,R`
            "#]],
        );
    }

    #[test]
    fn polar_words_are_not_everywhere() {
        check_rule(
            &RULE,
            "fanuc-mill",
            "G1 @10. F100.\nG1 X10. ,R2.\n",
            &expect![[r#"
                1 | G1 @10. F100.
                  |    ^^^^ warning[unknown-address] unknown address `@`
            "#]],
        );
    }

    #[test]
    fn words_name_the_control() {
        let found = findings(&only(&RULE), "linuxcnc", "G1 X10. ,R2. F100.\n", &World::default());
        let text = words(&found[0]);
        assert!(text.contains("note: LinuxCNC has no address `,R`"), "{text}");
    }
}
