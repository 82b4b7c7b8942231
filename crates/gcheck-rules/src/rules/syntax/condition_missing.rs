//! A statement without its condition.

use gcheck_syntax::{SyntaxError, SyntaxErrorKind};

use crate::declare::declare_rule;
use crate::{BlockCx, Finding, Report, Run};

declare_rule! {
    /// `IF`, `WHILE`, `ELSEIF` or `REPEAT` is not followed by a condition in brackets.
    ///
    /// ## Why it matters
    /// The control refuses the block.
    ///
    /// ## Reported
    /// ```nc,reported,fanuc-mill
    /// IF #1 GT 5. GOTO 20
    /// ```
    /// ```nc,reported,linuxcnc
    /// o100 while
    /// ```
    /// ## Not reported
    /// ```nc,quiet,fanuc-mill
    /// IF [#1 GT 5.] GOTO 20
    /// N20 M30
    /// ```
    rule "condition-missing" in "syntax" {
        summary: "statement without a condition in brackets",
        severity: Error,
        tier: Token,
        since: "0.1.0",
        run: Run::Token { on: |kind| kind == SyntaxErrorKind::MissingCondition, check },
    }
}

fn check(cx: &BlockCx<'_>, error: &SyntaxError, report: &mut Report<'_>) {
    report.add(finding(cx, error));
}

fn finding(cx: &BlockCx<'_>, error: &SyntaxError) -> Finding {
    let keyword = cx.slice(error.range.clone());
    let finding = Finding::new(
        &META,
        cx.in_file(error.range.clone()),
        format!("`{keyword}` has no condition in brackets"),
    )
    .label("a a `[` must follow");
    if cx.slice(error.range.end..cx.block().range.end).trim_start().starts_with('(') {
        return finding.note("text in parentheses is a comment").help("write the condition in `[ ]`");
    }
    finding.help("put the condition in `[ ]`")
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::check_rule;

    #[test]
    fn the_keyword_is_marked() {
        check_rule(
            &RULE,
            "fanuc-mill",
            "IF #1 GT 5. GOTO 20\nWHILE (#1 LT 5) DO1\n",
            &expect![[r#"
            1 | IF #1 GT 5. GOTO 20
              | ^^ error[condition-missing] `IF` has no condition in brackets
            2 | WHILE (#1 LT 5) DO1
              | ^^^^^ error[condition-missing] `WHILE` has no condition in brackets
        "#]],
        );
    }

    #[test]
    fn o_words_too() {
        check_rule(
            &RULE,
            "linuxcnc",
            "o100 while\no100 endwhile\n",
            &expect![[r#"
            1 | o100 while
              |      ^^^^^ error[condition-missing] `while` has no condition in brackets
        "#]],
        );
    }
}
