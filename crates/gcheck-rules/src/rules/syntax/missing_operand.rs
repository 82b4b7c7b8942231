//! An operator or function without its operand.

use gcheck_syntax::{SyntaxError, SyntaxErrorKind};

use crate::declare::declare_rule;
use crate::{BlockCx, Finding, Report, Run};

declare_rule! {
    /// An operator, a sign, a function or a bracket has no operand.
    ///
    /// ## Why it matters
    /// The control cannot read the expression and refuses the block. The usual cause is parentheses instead of
    /// brackets: text in parentheses is a comment, so the control sees nothing there.
    ///
    /// ## Reported
    /// ```nc,reported,haas-mill
    /// #100= #1 - (#2 + 1.)
    /// ```
    /// ```nc,reported,linuxcnc
    /// #100=SQRT(#1)
    /// ```
    /// ## Not reported
    /// ```nc,quiet,haas-mill
    /// #100= #1 - [#2 + 1.]
    /// ```
    rule "missing-operand" in "syntax" {
        summary: "operator or function without its operand",
        severity: Error,
        tier: Token,
        since: "0.1.0",
        run: Run::Token { on: |kind| kind == SyntaxErrorKind::MissingOperand, check },
    }
}

fn check(cx: &BlockCx<'_>, error: &SyntaxError, report: &mut Report<'_>) {
    report.add(finding(cx, error));
}

fn finding(cx: &BlockCx<'_>, error: &SyntaxError) -> Finding {
    let written = cx.slice(error.range.clone());
    let message = match written {
        "[" => "the bracket has no value inside".to_owned(),
        "" => "expression has no value here".to_owned(),
        _ if written.ends_with('=') => format!("assignment `{}` has no value", written.trim_end()),
        _ => format!("`{}` has no operand", written.trim_end()),
    };
    let behind = cx.slice(error.range.end..cx.block().range.end);
    if written.trim_end().eq_ignore_ascii_case("EXISTS") && behind.trim_start().starts_with('[') {
        return Finding::new(
            &META,
            cx.in_file(error.range.clone()),
            format!("`{}` without a parameter", written.trim_end()),
        )
        .label("asks for one parameter, and for nothing else")
        .help("write one parameter in the brackets: `EXISTS[#<name>]`");
    }
    let finding = Finding::new(&META, cx.in_file(error.range.clone()), message)
        .label("a number, a variable or a `[` must follow");
    if behind.trim_start().starts_with('(') {
        return finding.note("text in parentheses is a comment").help("write `[ ]` in expressions");
    }
    finding.help("complete the expression")
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::{World, check_rule, findings, only, words};

    #[test]
    fn parentheses_are_comments() {
        check_rule(
            &RULE,
            "haas-mill",
            "#100=#1-(#2+1.)\n#101=ABS(#2)\n#102=\n#103=[]\n",
            &expect![[r#"
                1 | #100=#1-(#2+1.)
                  |        ^ error[missing-operand] `-` has no operand
                2 | #101=ABS(#2)
                  |      ^^^ error[missing-operand] `ABS` has no operand
                3 | #102=
                  | ^^^^^ error[missing-operand] assignment `#102=` has no value
                4 | #103=[]
                  |      ^ error[missing-operand] the bracket has no value inside
            "#]],
        );
    }

    #[test]
    fn a_named_parameter_without_its_sign() {
        check_rule(
            &RULE,
            "linuxcnc",
            "G0 X[#<x> - <gap>]\n",
            &expect![[r#"
                1 | G0 X[#<x> - <gap>]
                  |           ^ error[missing-operand] `-` has no operand
            "#]],
        );
    }

    #[test]
    fn a_function_may_give_the_number_of_a_parameter() {
        check_rule(&RULE, "linuxcnc", "#fix[5.2]=1\nG0 X[#sqrt[16] + 1]\n", &expect![[""]]);
        check_rule(
            &RULE,
            "haas-mill",
            "#FIX[5.2]=1\n",
            &expect![[r#"
                1 | #FIX[5.2]=1
                  | ^ error[missing-operand] `#` has no operand
            "#]],
        );
    }

    #[test]
    fn words_name_the_remedy() {
        let program = "#101=ABS(#2)\n";
        let found = findings(&only(&RULE), "haas-mill", program, &World::default());
        expect![[r#"
            `ABS` has no operand
              here: a number, a variable or a `[` must follow
              note: text in parentheses is a comment
              help: write `[ ]` in expressions
        "#]]
        .assert_eq(&found.iter().map(words).collect::<String>());
    }
}
