//! A block number after other words.

use gcheck_controls::Handling;
use gcheck_program::BlockFlags;

use crate::declare::declare_rule;
use crate::{BlockCx, Finding, Report, Run, limit};

declare_rule! {
    /// A block number (`N`) comes after another word of its block.
    ///
    /// ## Why it matters
    /// The control reads a block number at the beginning only, where nothing but a block delete (`/`) is before it. It stops
    /// with an error at this block.
    ///
    /// ## Reported
    /// ```nc,reported,linuxcnc
    /// G0 N10 X1
    /// M2
    /// ```
    /// ## Not reported
    /// ```nc,quiet,linuxcnc
    /// N10 G0 X1
    /// /N20 X2
    /// M2
    /// ```
    /// Other controls read it anywhere.
    /// ```nc,quiet,fanuc-mill
    /// G0 N10 X1.
    /// M30
    /// ```
    rule "block-number-not-first" in "words" {
        summary: "block number after other words",
        severity: Error,
        tier: Block,
        since: "0.1.0",
        run: Run::Block { trigger: BlockFlags::LABEL, check },
    }
}

fn check(cx: &BlockCx<'_>, report: &mut Report<'_>) {
    let rules = cx.control().block_rules();
    let Some(number) = cx.word('N').filter(|_| rules.late_number == Handling::Refused) else { return };
    if cx.block().flags.contains(BlockFlags::ERROR) || cx.words_may_be_arguments() {
        return;
    }
    let before = cx.slice(cx.block().range.start..number.range().start).trim();
    if before.is_empty() || before == "/" {
        return;
    }
    let text = cx.text(number);
    report.add(
        Finding::new(&META, cx.range(number), format!("block number after other words: `{text}`"))
            .label("the control refuses the block")
            .note(format!("a block number comes first in its block  [{}]", rules.source))
            .help(format!("write `{text}` at the beginning of the block"))
            .at_most(limit(rules.confidence)),
    );
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::check_rule;

    #[test]
    fn the_number_is_marked() {
        check_rule(
            &RULE,
            "linuxcnc",
            "G0 N10 X1\n/ N20 X2\n  N30 X3\n(START) N40 X4\nX5 N50\nM2\n",
            &expect![[r#"
                1 | G0 N10 X1
                  |    ^^^ error[block-number-not-first] block number after other words: `N10`
                4 | (START) N40 X4
                  |         ^^^ error[block-number-not-first] block number after other words: `N40`
                5 | X5 N50
                  |    ^^^ error[block-number-not-first] block number after other words: `N50`
            "#]],
        );
    }
}
