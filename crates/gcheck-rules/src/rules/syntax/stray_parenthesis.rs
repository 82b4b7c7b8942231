//! A closing parenthesis without an opening one.

use gcheck_syntax::{SyntaxError, SyntaxErrorKind};

use crate::declare::declare_rule;
use crate::{BlockCx, Finding, Fix, Report, Run};

declare_rule! {
    /// There is a `)` while no comment is open.
    ///
    /// ## Why it matters
    /// The control refuses the block. Often the `(` is missing, and the control reads the words before the `)` as code,
    /// not as a comment.
    ///
    /// ## Reported
    /// ```nc,reported,haas-mill
    /// G0 X1. START)
    /// ```
    /// Parentheses are not brackets: an expression in parentheses is a comment here.
    /// ```nc,reported,linuxcnc
    /// G0 X1 )
    /// ```
    /// ## Not reported
    /// ```nc,quiet,haas-mill
    /// G0 X1. (START)
    /// ```
    rule "stray-parenthesis" in "syntax" {
        summary: "`)` without `(`",
        severity: Error,
        tier: Token,
        fixable: OnRequest,
        since: "0.1.0",
        run: Run::Token { on: |kind| kind == SyntaxErrorKind::StrayParenthesis, check },
    }
}

fn check(cx: &BlockCx<'_>, error: &SyntaxError, report: &mut Report<'_>) {
    report.add(finding(cx, error));
}

fn finding(cx: &BlockCx<'_>, error: &SyntaxError) -> Finding {
    Finding::new(&META, cx.in_file(error.range.clone()), "`)` closes no comment")
        .label("no `(` before it")
        .note("a comment is between `(` and `)` on one line")
        .help("add the `(` where the comment begins, or remove the `)`")
        .fix(Fix::risky("remove the `)`", cx.in_file(cx.with_blanks_before(error.range.clone())), ""))
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::check_rule;

    #[test]
    fn the_parenthesis_is_marked() {
        check_rule(
            &RULE,
            "haas-mill",
            "G0 X1. )\nG0 (A)\n",
            &expect![[r#"
            1 | G0 X1. )
              |        ^ error[stray-parenthesis] `)` closes no comment
        "#]],
        );
    }

    #[test]
    fn behind_a_macro_value_too() {
        check_rule(
            &RULE,
            "fanuc-mill",
            "G0 X#1 )\n",
            &expect![[r#"
            1 | G0 X#1 )
              |        ^ error[stray-parenthesis] `)` closes no comment
        "#]],
        );
    }
}
