//! A bracket that is not closed.

use gcheck_syntax::{SyntaxError, SyntaxErrorKind};

use crate::declare::declare_rule;
use crate::{BlockCx, Finding, Report, Run};

declare_rule! {
    /// A `[` has no `]` in its block.
    ///
    /// ## Why it matters
    /// The control cannot read the expression and refuses the block.
    ///
    /// ## Reported
    /// ```nc,reported,haas-mill
    /// #100= [#1 + [#2 * 3.
    /// ```
    /// ```nc,reported,linuxcnc
    /// G0 X[#1 + 2
    /// ```
    /// ## Not reported
    /// ```nc,quiet,haas-mill
    /// #100= [#1 + [#2 * 3.]]
    /// ```
    rule "unclosed-bracket" in "syntax" {
        summary: "`[` is not closed",
        severity: Error,
        tier: Token,
        since: "0.1.0",
        run: Run::Token { on: |kind| kind == SyntaxErrorKind::UnclosedBracket, check },
    }
}

fn check(cx: &BlockCx<'_>, error: &SyntaxError, report: &mut Report<'_>) {
    report.add(finding(cx, error));
}

fn finding(cx: &BlockCx<'_>, error: &SyntaxError) -> Finding {
    // From a `<` on everything is taken for a name.
    let rest = cx.slice(error.range.start..cx.block().range.end);
    if let Some((before, after)) = rest.split_once('<')
        && after.contains(']')
        && !before.ends_with('#')
    {
        let operator = if after.starts_with('=') { "LE" } else { "LT" };
        return Finding::new(
            &META,
            cx.in_file(error.range.clone()),
            "expression with `<`, which is not an operator",
        )
        .label("its `]` is not read: it is after the `<`")
        .note("a control reads comparisons as words")
        .help(format!("write `{operator}` in place of the sign"));
    }
    Finding::new(&META, cx.in_file(error.range.clone()), "bracket `[` is not closed")
        .label("there is no `]` for this bracket")
        .note("an expression ends with its block")
        .help("add a `]` where the expression ends")
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::check_rule;

    #[test]
    fn the_innermost_open_bracket_is_marked() {
        check_rule(
            &RULE,
            "haas-mill",
            "#100=[#1+[#2*3.\n",
            &expect![[r#"
            1 | #100=[#1+[#2*3.
              |          ^ error[unclosed-bracket] bracket `[` is not closed
        "#]],
        );
    }

    #[test]
    fn a_sign_for_a_comparison_is_named() {
        check_rule(
            &RULE,
            "fanuc-mill",
            "IF [#10 < #4] GOTO 5\nIF [#10 <= 4] GOTO 5\nN5 M30\n",
            &expect![[r#"
                1 | IF [#10 < #4] GOTO 5
                  |    ^ error[unclosed-bracket] expression with `<`, which is not an operator
                2 | IF [#10 <= 4] GOTO 5
                  |    ^ error[unclosed-bracket] expression with `<`, which is not an operator
            "#]],
        );
    }

    #[test]
    fn text_of_a_print_statement_counts_brackets_too() {
        check_rule(
            &RULE,
            "haas-mill",
            "DPRNT[X#100[53]\nDPRNT[X#100[53]]\n",
            &expect![[r#"
            1 | DPRNT[X#100[53]
              |      ^ error[unclosed-bracket] bracket `[` is not closed
        "#]],
        );
    }
}
