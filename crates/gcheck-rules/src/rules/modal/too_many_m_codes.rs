//! More M codes in a block than the control accepts.

use gcheck_controls::Letter;
use gcheck_program::{BlockFlags, Word};

use crate::declare::declare_rule;
use crate::{BlockCx, Finding, Report, Run, limit};

declare_rule! {
    /// A block has more M codes than the control accepts in one block.
    ///
    /// ## Why it matters
    /// The control stops with an alarm, or carries out only one of them: the spindle starts and the coolant stays off.
    ///
    /// ## Reported
    /// ```nc,reported,haas-mill
    /// M3 S1000 M8
    /// ```
    /// ## Not reported
    /// ```nc,quiet,linuxcnc
    /// M3 S1000 M8
    /// ```
    rule "too-many-m-codes" in "modal" {
        summary: "more M codes in a block than the control accepts",
        severity: Error,
        tier: Block,
        control_specific: true,
        since: "0.1.0",
        run: Run::Block { trigger: BlockFlags::CODE, check },
    }
}

fn check(cx: &BlockCx<'_>, report: &mut Report<'_>) {
    let Some(max) = cx.control().limits().m_codes_per_block else { return };
    let mut codes = cx.code_words().filter(|w| w.letter == Letter::of('M'));
    if let Some(over) = codes.nth(usize::from(max))
        && !cx.block().flags.contains(BlockFlags::ERROR)
        && !cx.words_may_be_arguments()
    {
        let count = usize::from(max) + 1 + codes.count();
        report.add(finding(cx, over, max, count));
    }
}

fn finding(cx: &BlockCx<'_>, over: &Word, max: u8, count: usize) -> Finding {
    let limits = cx.control().limits();
    let source = limits.source.as_ref().map(|source| format!("  [{source}]")).unwrap_or_default();
    let codes = if max == 1 { "M code" } else { "M codes" };
    Finding::new(&META, cx.range(over), format!("{count} M codes in one block"))
        .label(format!("one too many: {max} {codes} per block"))
        .note(format!("this control accepts {max} {codes} in a block{source}"))
        .help("put the M codes in separate blocks")
        .at_most(limit(limits.m_codes_confidence.unwrap_or(gcheck_controls::Confidence::Assumed)))
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::{World, check_rule, findings, only, words};

    #[test]
    fn the_first_over_the_limit_is_marked() {
        check_rule(
            &RULE,
            "linuxcnc",
            "M3 S100 M8 M48 M62 P1 M100\nM3 S#1 M8\n",
            &expect![[r#"
                1 | M3 S100 M8 M48 M62 P1 M100
                  |                       ^^^^ error[too-many-m-codes] 5 M codes in one block
            "#]],
        );
    }

    #[test]
    fn an_m_word_of_a_macro_call_is_an_argument() {
        check_rule(
            &RULE,
            "fanuc-mill",
            "G65 P9010 M1 M2 M3 M4\nM3 M8 M51 M59\n",
            &expect![[r#"
                2 | M3 M8 M51 M59
                  |           ^^^ info[too-many-m-codes] 4 M codes in one block
            "#]],
        );
    }

    #[test]
    fn words_name_the_limit() {
        let found = findings(&only(&RULE), "haas-mill", "M3 S1000 M8\n", &World::default());
        let text = words(&found[0]);
        assert!(text.contains("here: one too many: 1 M code per block"), "{text}");
    }
}
