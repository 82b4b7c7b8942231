//! A closing bracket without an opening one.

use gcheck_syntax::{SyntaxError, SyntaxErrorKind};

use crate::declare::declare_rule;
use crate::{BlockCx, Finding, Fix, Report, Run};

declare_rule! {
    /// There is a `]` while no `[` is open.
    ///
    /// ## Why it matters
    /// The control refuses the block. Often an extra `]` ends an expression too early.
    ///
    /// ## Reported
    /// ```nc,reported,haas-mill
    /// G0 X[#1 + 2.]]
    /// ```
    /// ```nc,reported,linuxcnc
    /// G0 X[#1 + 2]]
    /// ```
    /// ## Not reported
    /// ```nc,quiet,haas-mill
    /// G0 X[[#1 + 2.] / 2.]
    /// ```
    rule "stray-bracket" in "syntax" {
        summary: "`]` without `[`",
        severity: Error,
        tier: Token,
        fixable: OnRequest,
        since: "0.1.0",
        run: Run::Token { on: |kind| kind == SyntaxErrorKind::StrayBracket, check },
    }
}

fn check(cx: &BlockCx<'_>, error: &SyntaxError, report: &mut Report<'_>) {
    report.add(finding(cx, error));
}

fn finding(cx: &BlockCx<'_>, error: &SyntaxError) -> Finding {
    Finding::new(&META, cx.in_file(error.range.clone()), "bracket `]` closes nothing")
        .label("every `[` before it is closed already")
        .help("remove the `]`, or add a `[` where the expression begins")
        .fix(Fix::risky("remove the `]`", cx.in_file(error.range.clone()), ""))
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::check_rule;

    #[test]
    fn the_bracket_too_many_is_marked() {
        check_rule(
            &RULE,
            "haas-mill",
            "G0 X[#1+2.]]\n",
            &expect![[r#"
            1 | G0 X[#1+2.]]
              |            ^ error[stray-bracket] bracket `]` closes nothing
        "#]],
        );
    }

    #[test]
    fn in_a_condition() {
        check_rule(
            &RULE,
            "fanuc-mill",
            "WHILE [ABS[#5]] LT 1.] DO1\n",
            &expect![[r#"
            1 | WHILE [ABS[#5]] LT 1.] DO1
              |                      ^ error[stray-bracket] bracket `]` closes nothing
        "#]],
        );
    }
}
