//! A form of block delete that the control does not have.

use std::ops::Range;

use gcheck_controls::Confidence;
use gcheck_program::BlockFlags;

use crate::declare::declare_rule;
use crate::{BlockCx, Finding, Fix, Report, Run, limit};

declare_rule! {
    /// A block-delete sign has a level (`/2`) or is inside the block, and the control does not have this form.
    ///
    /// ## Why it matters
    /// The control refuses the block, or skips by the wrong switch or from the wrong place.
    ///
    /// ## Reported
    /// ```nc,reported,linuxcnc
    /// /2 G0 X1
    /// G0 X1 / Y2
    /// ```
    /// ## Not reported
    /// ```nc,quiet,linuxcnc
    /// / G0 X1
    /// #1=[#2/3]
    /// ```
    /// ```nc,quiet,fanuc-mill
    /// /2 G0 X1.
    /// G0 X1. /3 Y2.
    /// ```
    rule "block-delete-level" in "syntax" {
        summary: "form of block delete that the control does not have",
        severity: Error,
        tier: Block,
        control_specific: true,
        fixable: OnRequest,
        since: "0.1.0",
        run: Run::Block { trigger: BlockFlags::BLOCK_DELETE, check },
    }
}

fn check(cx: &BlockCx<'_>, report: &mut Report<'_>) {
    let syntax = cx.control().syntax();
    if !syntax.block_delete
        || syntax.block_delete_levels && syntax.block_delete_inside
        || cx.block().flags.contains(BlockFlags::ERROR)
    {
        return;
    }
    let Some(block) = cx.tree() else { return };
    let Some(mark) = block.block_delete() else { return };
    let is_first = block.first().is_some_and(|first| mark.syntax().first_token() == Some(first));
    let range = cx.of_tree(mark.range());
    if !is_first && !syntax.block_delete_inside {
        report.add(inside_finding(cx, range));
    } else if mark.level().is_some() && !syntax.block_delete_levels {
        report.add(level_finding(cx, range));
    }
}

fn confidence(cx: &BlockCx<'_>) -> Confidence {
    cx.control().syntax().block_delete_confidence.unwrap_or(Confidence::Assumed)
}

fn inside_finding(cx: &BlockCx<'_>, range: Range<u32>) -> Finding {
    Finding::new(&META, range, "block delete inside a block")
        .label("there is text before the `/`")
        .note("this control reads `/` only at the head of a block")
        .help("put `/` first, or write the skipped words in a block of their own")
        .at_most(limit(confidence(cx)))
}

fn level_finding(cx: &BlockCx<'_>, range: Range<u32>) -> Finding {
    let slash = range.clone();
    Finding::new(&META, range, "block delete with a level")
        .label("the digit names a switch")
        .note("this control has one block-delete switch and no levels")
        .help("write `/` alone")
        .fix(Fix::risky("write `/` alone", slash, "/"))
        .at_most(limit(confidence(cx)))
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::{World, check_rule, findings, only, words};

    #[test]
    fn levels_and_places() {
        check_rule(
            &RULE,
            "linuxcnc",
            "/2 G0 X1\nG0 X1 / Y2\n/ G0 X[#1/2]\n/(a/b) G0 X1\n",
            &expect![[r#"
            1 | /2 G0 X1
              | ^^ error[block-delete-level] block delete with a level
            2 | G0 X1 / Y2
              |       ^ error[block-delete-level] block delete inside a block
        "#]],
        );
    }

    #[test]
    fn weaker_where_it_is_only_assumed() {
        check_rule(
            &RULE,
            "haas-mill",
            "/2 G0 X1.\nG0 X#1 / Y2.\n",
            &expect![[r#"
            1 | /2 G0 X1.
              | ^^ warning[block-delete-level] block delete with a level
        "#]],
        );
        check_rule(&RULE, "fanuc-mill", "/2 G0 X1.\nG0 X#1 /3 Y2.\n", &expect![[""]]);
    }

    #[test]
    fn words_tell_the_form() {
        let found = findings(&only(&RULE), "linuxcnc", "/2 G0 X1\n", &World::default());
        expect![[r#"
            block delete with a level
              here: the digit names a switch
              note: this control has one block-delete switch and no levels
              note: it holds with block delete off: the block has a `/`
              help: write `/` alone
              fix (unsafe): write `/` alone
        "#]]
        .assert_eq(&found.iter().map(words).collect::<String>());
    }
}
