//! A tool change without a comment.

use std::ops::Range;

use gcheck_controls::{Effect, Semicolon};
use gcheck_program::BlockFlags;

use crate::declare::declare_rule;
use crate::{FileCx, Finding, Report, Run};

declare_rule! {
    /// No comment at a tool change names the tool: not in its block, and not on the line above or below.
    ///
    /// ## Why it matters
    /// The operator loads tools by these comments, and finds the place for a restart by them. A number alone does not
    /// tell a drill from a tap.
    ///
    /// ## Reported
    /// ```nc,reported,haas-mill
    /// T1 M6
    /// G0 X1.
    /// M30
    /// ```
    /// ## Not reported
    /// ```nc,quiet,haas-mill
    /// (1/4 DRILL)
    /// T1 M6
    /// G0 X1.
    /// T2 M6 (TAP M6)
    /// M30
    /// ```
    rule "tool-change-without-comment" in "style" {
        summary: "tool change without a comment",
        severity: Hint,
        tier: Program,
        recommended: false,
        sets: [HouseStyle],
        since: "0.1.0",
        run: Run::Program { check },
    }
}

fn check(cx: &FileCx<'_>, report: &mut Report<'_>) {
    let tools = &cx.control().semantics().tools;
    let mut last = None;
    cx.each_block(|block| {
        if block.block().flags.contains(BlockFlags::ERROR) {
            return;
        }
        let word = if tools.change_by_t {
            block.word('T').filter(|word| {
                let tool = word
                    .integer()
                    .map(|number| if tools.offset_in_t && number >= 100 { number / 100 } else { number });
                let is_new = tool != last && tool.is_some_and(|tool| tool > 0);
                last = if is_new { tool } else { last };
                is_new
            })
        } else {
            block.codes().find(|(_, code)| code.effect() == Effect::ToolChange).map(|(word, _)| word)
        };
        if let Some(word) = word
            && !is_described(cx, &block.block_range())
        {
            let name = block.text(block.word('T').unwrap_or(word));
            report.add(
                Finding::new(&META, block.range(word), format!("no comment names the tool (`{name}`)"))
                    .label("only a tool number")
                    .help("write the tool's name in a comment in this block, or on the line above"),
            );
        }
    });
}

/// Is there a comment on the line of a block, above it or below it?
fn is_described(cx: &FileCx<'_>, block: &Range<u32>) -> bool {
    let own = cx.line_around(block.clone());
    let above = cx.line_around(own.start.saturating_sub(1)..own.start.saturating_sub(1));
    let (base, text) = cx.text.around(own.end);
    let behind = text.as_bytes().get((own.end - base) as usize..).unwrap_or_default();
    // One line end, so that an empty line is the line below.
    let next = own.end
        + match behind {
            [b'\r', b'\n', ..] => 2,
            [b'\r' | b'\n', ..] => 1,
            _ => 0,
        };
    let below = cx.line_around(next..next);
    let above = if above.end == own.end { own.clone() } else { above };
    let is_comment =
        |byte: char| byte == '(' || byte == ';' && cx.control().syntax().semicolon == Semicolon::Comment;
    [above, own, below].into_iter().any(|line| cx.slice(line).contains(is_comment))
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::check_rule;

    #[test]
    fn the_line_above_or_below_may_name_it() {
        check_rule(
            &RULE,
            "linuxcnc",
            "; drill\nT1 M6\nG0 X1\n\nT2 M6\n(tap)\nG0 X2\nG0 X3\nT3 M6\nG0 X4\nM2\n",
            &expect![[r#"
                9 | T3 M6
                  |    ^^ hint[tool-change-without-comment] no comment names the tool (`T3`)
            "#]],
        );
    }

    #[test]
    fn an_offset_of_the_same_tool_is_no_change() {
        check_rule(
            &RULE,
            "fanuc-lathe",
            "(TURN)\nT0101\nG0 X1.\nX2.\nT0111\nX3.\nX4.\nT0202\nM30\n",
            &expect![[r#"
                8 | T0202
                  | ^^^^^ hint[tool-change-without-comment] no comment names the tool (`T0202`)
            "#]],
        );
    }
}
