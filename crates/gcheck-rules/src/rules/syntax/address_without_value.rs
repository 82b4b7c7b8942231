//! An address without a number or expression.

use gcheck_syntax::{SyntaxError, SyntaxErrorKind};

use crate::declare::declare_rule;
use crate::{BlockCx, Finding, Report, Run};

declare_rule! {
    /// A letter has no number after it.
    ///
    /// ## Why it matters
    /// The control refuses the block. On some controls the letter takes the number of the next word instead, and the machine moves
    /// elsewhere.
    ///
    /// ## Reported
    /// ```nc,reported,haas-mill
    /// G1 X Y1. F10.
    /// ```
    /// ```nc,reported,linuxcnc
    /// G1 X[1.] Y F10
    /// ```
    /// ## Not reported
    /// The value may be a variable or an expression, with blanks before it.
    /// ```nc,quiet,haas-mill
    /// G1 X#101 Y[#102 * 2.] Z 1. F10.
    /// ```
    rule "address-without-value" in "syntax" {
        summary: "address without a value",
        severity: Error,
        tier: Token,
        since: "0.1.0",
        run: Run::Token { on: |kind| kind == SyntaxErrorKind::AddressWithoutValue, check },
    }
}

fn check(cx: &BlockCx<'_>, error: &SyntaxError, report: &mut Report<'_>) {
    report.add(finding(cx, error));
}

fn finding(cx: &BlockCx<'_>, error: &SyntaxError) -> Finding {
    let letter = cx.slice(error.range.clone());
    let finding =
        Finding::new(&META, cx.in_file(error.range.clone()), format!("address `{letter}` has no value"))
            .label("a number or an expression must follow")
            .note("every word is an address and its value");
    if cx.slice(error.range.end..error.range.end + 1) == "(" {
        return finding.help("write an expression in `[ ]`: text in parentheses is a comment");
    }
    finding.help(format!("add the number after `{letter}`, or remove the letter"))
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::{World, check_rule, findings, only, words};

    #[test]
    fn the_letter_is_marked() {
        check_rule(
            &RULE,
            "haas-mill",
            "G1 X Y1. F10.\nG1 X1. F\n",
            &expect![[r#"
            1 | G1 X Y1. F10.
              |    ^ error[address-without-value] address `X` has no value
            2 | G1 X1. F
              |        ^ error[address-without-value] address `F` has no value
        "#]],
        );
    }

    #[test]
    fn an_expression_is_a_value() {
        check_rule(
            &RULE,
            "fanuc-mill",
            "G1 X#101 Y-[#102] Z F10.\n",
            &expect![[r#"
            1 | G1 X#101 Y-[#102] Z F10.
              |                   ^ error[address-without-value] address `Z` has no value
        "#]],
        );
    }

    #[test]
    fn parentheses_are_no_brackets() {
        let program = "G1 X(#101 + 1.) F10.\n";
        let found = findings(&only(&RULE), "haas-mill", program, &World::default());
        expect![[r#"
            address `X` has no value
              here: a number or an expression must follow
              note: every word is an address and its value
              help: write an expression in `[ ]`: text in parentheses is a comment
        "#]]
        .assert_eq(&found.iter().map(words).collect::<String>());
    }
}
