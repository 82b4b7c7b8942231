//! A number without an address.

use gcheck_syntax::{SyntaxError, SyntaxErrorKind};

use crate::declare::declare_rule;
use crate::facts::program_numbers::is_number_with_zero;
use crate::{BlockCx, Finding, Report, Run};

declare_rule! {
    /// A number has no letter before it.
    ///
    /// ## Why it matters
    /// The control refuses the block.
    ///
    /// ## Reported
    /// ```nc,reported,haas-mill
    /// G1 X1. F10.
    /// 1.5
    /// ```
    /// ```nc,reported,fanuc-mill
    /// G1 X1. 2. F10.
    /// ```
    /// ## Not reported
    /// If a control allows blanks inside numbers, both sides are one number.
    /// ```nc,quiet,linuxcnc
    /// G1 X1. 25 F10
    /// ```
    rule "value-without-address" in "syntax" {
        summary: "number without an address",
        severity: Error,
        tier: Token,
        since: "0.1.0",
        run: Run::Token { on: |kind| kind == SyntaxErrorKind::ValueWithoutAddress, check },
    }
}

fn check(cx: &BlockCx<'_>, error: &SyntaxError, report: &mut Report<'_>) {
    if !is_number_with_zero(cx, error) {
        report.add(finding(cx, error));
    }
}

fn finding(cx: &BlockCx<'_>, error: &SyntaxError) -> Finding {
    let number = cx.slice(error.range.clone());
    Finding::new(&META, cx.in_file(error.range.clone()), format!("number `{number}` has no address"))
        .label("no letter before it")
        .note("every word is an address and its value")
        .help("add the letter before the number, or remove the number")
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::check_rule;

    #[test]
    fn the_number_is_marked() {
        check_rule(
            &RULE,
            "fanuc-mill",
            "G1 X1. 2. F10.\n",
            &expect![[r#"
            1 | G1 X1. 2. F10.
              |        ^^ error[value-without-address] number `2.` has no address
        "#]],
        );
    }

    #[test]
    fn at_the_head_of_a_block() {
        check_rule(
            &RULE,
            "haas-mill",
            "1.5 X2.\n",
            &expect![[r#"
            1 | 1.5 X2.
              | ^^^ error[value-without-address] number `1.5` has no address
        "#]],
        );
    }
}
