//! Tool length compensation with offset number zero.

use gcheck_program::BlockFlags;

use crate::declare::declare_rule;
use crate::{BlockCx, Finding, Reads, Report, Run};

declare_rule! {
    /// A block moves Z with tool length compensation and offset number zero: `G43 H0 Z1.`.
    ///
    /// ## Why it matters
    /// Offset zero has no length: the spindle nose goes where the tool tip should. On some controls `H0` even ends the
    /// compensation.
    ///
    /// ## Reported
    /// ```nc,reported,haas-mill
    /// T1 M6
    /// G43 H0 Z1.
    /// M30
    /// ```
    /// ## Not reported
    /// Alone in its block it ends the compensation.
    /// ```nc,quiet,haas-mill
    /// T1 M6
    /// G43 H1 Z1.
    /// G43 H0
    /// M30
    /// ```
    rule "length-offset-zero" in "tool" {
        summary: "tool length compensation with offset number zero",
        severity: Warning,
        tier: Block,
        since: "0.1.0",
        run: Run::BlockAndValues { trigger: BlockFlags::CODE, reads: Reads::Numbers, check },
    }
}

fn check(cx: &BlockCx<'_>, report: &mut Report<'_>) {
    let Some((_, code)) = cx.codes().find(|(_, code)| code.effect().is_length_compensation()) else { return };
    let Some(word) = cx.word('H').filter(|word| word.number() == Some(0.0)) else { return };
    // If it means the tool in the spindle, it has a length.
    let is_of_the_tool = cx.control().semantics().tools.length_from_tool;
    if is_of_the_tool || cx.word('Z').is_none() || !cx.words_are_plain() {
        return;
    }
    let name = cx.written(code);
    report.add(
        Finding::new(
            &META,
            cx.range(word),
            format!("tool length compensation with offset zero (`{name} {}`)", cx.text(word)),
        )
        .label("offset zero has no length")
        .help("give the number of the tool's length offset"),
    );
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::check_rule;

    #[test]
    fn computed_numbers_are_not_judged() {
        check_rule(
            &RULE,
            "fanuc-mill",
            "T1 M6\nG43 Z1. H#1\nG43 Z1. H00\nM30\n",
            &expect![[r#"
            3 | G43 Z1. H00
              |         ^^^ warning[length-offset-zero] tool length compensation with offset zero (`G43 H00`)
        "#]],
        );
    }
}
