//! A zero instead of the letter O of a program number.

use gcheck_syntax::{SyntaxError, SyntaxErrorKind};

use crate::declare::declare_rule;
use crate::facts::program_numbers::is_number_with_zero;
use crate::{BlockCx, Finding, Fix, Report, Run};

declare_rule! {
    /// A block begins with a zero and four digits or more: `01234` for `O1234`.
    ///
    /// ## Why it matters
    /// The control does not find the program under its number, or refuses to load it.
    ///
    /// ## Reported
    /// ```nc,reported,haas-mill
    /// %
    /// 01234 (BRACKET)
    /// ```
    /// ```nc,reported,fanuc-lathe
    /// %
    /// 00020
    /// ```
    /// ## Not reported
    /// ```nc,quiet,haas-mill
    /// %
    /// O1234 (BRACKET)
    /// ```
    rule "zero-for-letter-o" in "syntax" {
        summary: "zero instead of the letter O of a program number",
        severity: Error,
        tier: Token,
        fixable: OnRequest,
        since: "0.1.0",
        run: Run::Token { on: |kind| kind == SyntaxErrorKind::ValueWithoutAddress, check },
    }
}

fn check(cx: &BlockCx<'_>, error: &SyntaxError, report: &mut Report<'_>) {
    if is_number_with_zero(cx, error) {
        report.add(finding(cx, error));
    }
}

fn finding(cx: &BlockCx<'_>, error: &SyntaxError) -> Finding {
    let number = cx.slice(error.range.clone());
    let meant = format!("O{}", number.get(1..).unwrap_or_default());
    let start = error.range.start;
    Finding::new(
        &META,
        cx.in_file(error.range.clone()),
        format!("program number `{number}` begins with a zero, not the letter O"),
    )
    .label("this is a number without an address")
    .help(format!("write `{meant}`"))
    .fix(Fix::risky(format!("write `{meant}`"), cx.in_file(start..start + 1), "O"))
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::{World, check_rule, findings, fixed, only};

    #[test]
    fn at_the_head_of_a_program() {
        check_rule(
            &RULE,
            "haas-mill",
            "%\n01234 (BRACKET)\nG0 X1.\n",
            &expect![[r#"
            2 | 01234 (BRACKET)
              | ^^^^^ error[zero-for-letter-o] program number `01234` begins with a zero, not the letter O
        "#]],
        );
    }

    #[test]
    fn other_numbers_are_no_program_numbers() {
        check_rule(&RULE, "fanuc-mill", "0.5\n05\n0123 X1.\n", &expect![[""]]);
    }

    #[test]
    fn the_zero_becomes_the_letter() {
        let program = "00020\n";
        let found = findings(&only(&RULE), "fanuc-lathe", program, &World::default());
        expect![[r#"
            O0020
        "#]]
        .assert_eq(&found.iter().map(|f| fixed(program, f)).collect::<String>());
    }
}
