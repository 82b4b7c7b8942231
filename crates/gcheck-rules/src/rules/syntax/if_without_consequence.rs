//! An `IF` without `GOTO` or `THEN`.

use gcheck_syntax::{SyntaxError, SyntaxErrorKind};

use crate::declare::declare_rule;
use crate::{BlockCx, Finding, Report, Run};

declare_rule! {
    /// An `IF` with its condition is followed by neither `GOTO` nor `THEN`.
    ///
    /// ## Why it matters
    /// The control refuses the block.
    ///
    /// ## Reported
    /// ```nc,reported,fanuc-mill
    /// IF [#1 GT 5.] N20
    /// ```
    /// ```nc,reported,haas-mill
    /// IF [#1 GT 5.]
    /// ```
    /// ## Not reported
    /// Some controls allow an assignment without `THEN`.
    /// ```nc,quiet,haas-mill
    /// IF [#1 GT 5.] GOTO 20
    /// IF [#1 GT 5.] THEN #1= 5.
    /// IF [#1 GT 5.] #1= 5.
    /// N20 M30
    /// ```
    rule "if-without-consequence" in "syntax" {
        summary: "`IF` without `GOTO` or `THEN`",
        severity: Error,
        tier: Token,
        since: "0.1.0",
        run: Run::Token { on: |kind| kind == SyntaxErrorKind::IfWithoutConsequence, check },
    }
}

fn check(cx: &BlockCx<'_>, error: &SyntaxError, report: &mut Report<'_>) {
    report.add(finding(cx, error));
}

fn finding(cx: &BlockCx<'_>, error: &SyntaxError) -> Finding {
    Finding::new(&META, cx.in_file(error.range.clone()), "`IF` has neither `GOTO` nor `THEN`")
        .label("no action follows this condition")
        .help("add `GOTO` and a sequence number, or `THEN` and an assignment")
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::check_rule;

    #[test]
    fn the_condition_is_marked() {
        check_rule(
            &RULE,
            "fanuc-mill",
            "IF [#1 GT 5.] N20\n",
            &expect![[r#"
            1 | IF [#1 GT 5.] N20
              | ^^^^^^^^^^^^^ error[if-without-consequence] `IF` has neither `GOTO` nor `THEN`
        "#]],
        );
    }

    #[test]
    fn with_a_consequence() {
        check_rule(&RULE, "haas-mill", "IF [#1 GT 5.] GOTO 20\nIF [#1 GT 5.] THEN #1=5.\n", &expect![[""]]);
    }
}
