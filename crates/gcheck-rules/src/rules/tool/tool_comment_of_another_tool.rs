//! A comment at a tool change that names another tool.

use std::ops::Range;

use gcheck_controls::Effect;
use gcheck_program::{BlockFlags, Word};

use crate::declare::declare_rule;
use crate::{BlockCx, Finding, Report, Run};

declare_rule! {
    /// The comment in the block of a tool change has another tool number than the block: `T3 M6 (T5 1/4 DRILL)`.
    ///
    /// ## Why it matters
    /// One of the two was changed and the other forgotten. The operator loads tools by the comments, the control by the code.
    ///
    /// ## Reported
    /// ```nc,reported,haas-mill
    /// T3 M6 (T5 - 1/4 DRILL)
    /// G0 X1.
    /// M30
    /// ```
    /// ## Not reported
    /// ```nc,quiet,haas-mill
    /// T3 M6 (T03 - 1/4 DRILL)
    /// T4 M6 (T-SLOT CUTTER, NOT T5)
    /// T5 M6 (T5, REPLACES T4)
    /// M30
    /// ```
    rule "tool-comment-of-another-tool" in "tool" {
        summary: "comment of a tool change names another tool",
        severity: Info,
        tier: Block,
        since: "0.1.0",
        run: Run::Block { trigger: BlockFlags::COMMENT, check },
    }
}

fn check(cx: &BlockCx<'_>, report: &mut Report<'_>) {
    let tools = &cx.control().semantics().tools;
    let Some(word) = cx.word('T') else { return };
    let changes = tools.change_by_t || cx.codes().any(|(_, code)| code.effect() == Effect::ToolChange);
    if !changes || cx.block().flags.contains(BlockFlags::ERROR) {
        return;
    }
    let Some(called) = word.integer() else { return };
    let tool = |number: u32| if tools.offset_in_t && number >= 100 { number / 100 } else { number };
    // A comment that begins with a tool number names its tool; the rest of it may be about any tool.
    let Some(comment) = cx.tree().and_then(|block| block.comments().next()) else { return };
    let Some((named, range)) = named_tool(comment.text()) else { return };
    if tool(called) != 0 && tool(named) != tool(called) && named != called {
        let start = cx.of_tree(comment.range()).start + 1;
        report.add(finding(cx, word, start + range.start as u32..start + range.end as u32));
    }
}

/// The tool number at the beginning of what a comment says, and its place there.
fn named_tool(comment: &str) -> Option<(u32, Range<usize>)> {
    let blanks = comment.len() - comment.trim_start_matches([' ', '\t']).len();
    let named = comment.get(blanks..)?;
    let head = ["TOOL NO.", "TOOL #", "TOOL", "T"]
        .into_iter()
        .find(|head| named.get(..head.len()).is_some_and(|start| start.eq_ignore_ascii_case(head)))?;
    let rest = named.get(head.len()..)?;
    let gap = rest.len() - rest.trim_start_matches([' ', '#', '=', ':']).len();
    // `T 5` may be anything, `TOOL 5` is a number.
    let digits = rest.get(if head == "T" { 0 } else { gap }..)?;
    let gap = if head == "T" { 0 } else { gap };
    let length = digits.bytes().take_while(u8::is_ascii_digit).count();
    let rest = digits.get(length..)?;
    let ends =
        rest.is_empty() || rest.starts_with(|c: char| !c.is_ascii_alphanumeric() && c != '.' && c != '/');
    let number = digits.get(..length)?.parse().ok().filter(|_| ends && length <= 4)?;
    Some((number, blanks..blanks + head.len() + gap + length))
}

fn finding(cx: &BlockCx<'_>, word: &Word, comment: Range<u32>) -> Finding {
    let base = cx.block_range().start - cx.block().range.start;
    let (called, named) = (cx.text(word), cx.slice(comment.start - base..comment.end - base));
    Finding::new(&META, comment, format!("the comment names `{named}`, the block calls `{called}`"))
        .label("another tool than the code calls")
        .also(cx.range(word), "the tool that comes")
        .help("correct the wrong one")
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::check_rule;

    #[test]
    fn lathes_name_tool_and_offset_in_one() {
        check_rule(
            &RULE,
            "fanuc-lathe",
            "T0303 (T3 BORING BAR)\nT0404 (T0404)\nT0505 (TOOL 6 - GROOVE)\nM30\n",
            &expect![[r#"
                3 | T0505 (TOOL 6 - GROOVE)
                  |        ^^^^^^ info[tool-comment-of-another-tool] the comment names `TOOL 6`, the block calls `T0505`
            "#]],
        );
    }

    #[test]
    fn comments_that_name_no_tool() {
        check_rule(
            &RULE,
            "haas-mill",
            "T1 M6 (T-SLOT)\nT2 M6 (T2.5 CUTTER)\nT3 M6 (TAP M6)\nT4 M6 (T 5)\nT5 M6 (TOOLING 7)\n",
            &expect![[""]],
        );
    }
}
