//! A block-delete sign on a control that ignores it.

use gcheck_controls::Confidence;
use gcheck_program::BlockFlags;

use crate::declare::declare_rule;
use crate::{BlockCx, Finding, Report, Run, Severity, limit};

declare_rule! {
    /// A block begins with `/`, and the control has no switch that skips such blocks.
    ///
    /// ## Why it matters
    /// The control passes over the sign and runs the block every time. What was meant for a first part, or for a
    /// measurement by hand, happens on every part.
    ///
    /// ## Reported
    /// ```nc,reported,grbl
    /// /G0 X10
    /// ```
    /// ## Not reported
    /// ```nc,quiet,linuxcnc
    /// /G0 X10
    /// ```
    /// ```nc,quiet,grbl
    /// G0 X10 (with / in a comment)
    /// ```
    rule "block-delete-not-read" in "syntax" {
        summary: "block-delete sign that the control ignores",
        severity: Warning,
        tier: Block,
        control_specific: true,
        since: "0.1.0",
        run: Run::Block { trigger: BlockFlags::BLOCK_DELETE, check },
    }
}

fn check(cx: &BlockCx<'_>, report: &mut Report<'_>) {
    let syntax = cx.control().syntax();
    if syntax.block_delete || cx.block().flags.contains(BlockFlags::ERROR) {
        return;
    }
    let confidence = syntax.block_delete_confidence.unwrap_or(Confidence::Assumed);
    report.add(finding(cx).at_most(limit(confidence)).at_most(if confidence == Confidence::Manual {
        Severity::Warning
    } else {
        Severity::Info
    }));
}

fn finding(cx: &BlockCx<'_>) -> Finding {
    let mark = cx.tree().and_then(|block| block.block_delete());
    let slash = mark.map_or_else(|| cx.block_range(), |mark| cx.of_tree(mark.range()));
    Finding::new(&META, slash.start..slash.start + 1, "block delete `/` does not skip this block")
        .label("the control ignores this sign")
        .note(format!("{} has no block delete: the block runs every time", cx.control().title()))
        .help("remove the block, or make a second program without it")
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::check_rule;

    #[test]
    fn the_sign_is_marked_wherever_it_is() {
        check_rule(
            &RULE,
            "grbl",
            "/G0 X1\n  /G0 X2\nG0 X3\n",
            &expect![[r#"
                1 | /G0 X1
                  | ^ warning[block-delete-not-read] block delete `/` does not skip this block
                2 |   /G0 X2
                  |   ^ warning[block-delete-not-read] block delete `/` does not skip this block
            "#]],
        );
    }
}
