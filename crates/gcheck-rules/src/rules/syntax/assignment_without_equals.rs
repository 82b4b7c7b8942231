//! A variable at the head of a block without `=`.

use gcheck_syntax::{SyntaxError, SyntaxErrorKind};

use crate::declare::declare_rule;
use crate::{BlockCx, Finding, Report, Run};

declare_rule! {
    /// A block begins with a variable and does not assign a value to it.
    ///
    /// ## Why it matters
    /// The control refuses the block. Either the `=` is missing, or the address before the variable.
    ///
    /// ## Reported
    /// ```nc,reported,haas-mill
    /// #100 5.
    /// ```
    /// ```nc,reported,linuxcnc
    /// #<depth> [#1 + 2]
    /// ```
    /// ## Not reported
    /// ```nc,quiet,haas-mill
    /// #100= 5.
    /// X#100
    /// ```
    rule "assignment-without-equals" in "syntax" {
        summary: "variable without `=`",
        severity: Error,
        tier: Token,
        since: "0.1.0",
        run: Run::Token { on: |kind| kind == SyntaxErrorKind::MissingEquals, check },
    }
}

fn check(cx: &BlockCx<'_>, error: &SyntaxError, report: &mut Report<'_>) {
    report.add(finding(cx, error));
}

fn finding(cx: &BlockCx<'_>, error: &SyntaxError) -> Finding {
    let variable = cx.slice(error.range.clone()).trim_end();
    Finding::new(&META, cx.in_file(error.range.clone()), format!("variable `{variable}` gets no value"))
        .label("neither the value of an address nor followed by `=`")
        .help(format!("write `{variable}=` and its value, or the address before it"))
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::check_rule;

    #[test]
    fn the_variable_is_marked() {
        check_rule(
            &RULE,
            "haas-mill",
            "#100 5.\nG0 #5\n",
            &expect![[r#"
                1 | #100 5.
                  | ^^^^ error[assignment-without-equals] variable `#100` gets no value
                2 | G0 #5
                  |    ^^ error[assignment-without-equals] variable `#5` gets no value
            "#]],
        );
    }

    #[test]
    fn named_parameters_too() {
        check_rule(
            &RULE,
            "linuxcnc",
            "#<depth>\n",
            &expect![[r#"
                1 | #<depth>
                  | ^^^^^^^^ error[assignment-without-equals] variable `#<depth>` gets no value
            "#]],
        );
    }
}
