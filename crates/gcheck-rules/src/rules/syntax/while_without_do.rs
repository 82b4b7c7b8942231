//! A `WHILE` without its `DO`.

use gcheck_syntax::{SyntaxError, SyntaxErrorKind};

use crate::declare::declare_rule;
use crate::{BlockCx, Finding, Fix, Report, Run};

declare_rule! {
    /// A `WHILE` with its condition is not followed by `DO` and a number.
    ///
    /// ## Why it matters
    /// The control refuses the block. A zero instead of the letter O makes it a `D` word: `D01` is not `DO1`.
    ///
    /// ## Reported
    /// ```nc,reported,haas-mill
    /// WHILE [#1 LT 5.] D01
    /// #1= #1 + 1.
    /// END1
    /// ```
    /// ```nc,reported,fanuc-mill
    /// WHILE [#1 LT 5.]
    /// ```
    /// ## Not reported
    /// ```nc,quiet,haas-mill
    /// WHILE [#1 LT 5.] DO1
    /// #1= #1 + 1.
    /// END1
    /// ```
    rule "while-without-do" in "syntax" {
        summary: "`WHILE` without `DO`",
        severity: Error,
        tier: Token,
        fixable: OnRequest,
        since: "0.1.0",
        run: Run::Token { on: |kind| kind == SyntaxErrorKind::WhileWithoutDo, check },
    }
}

fn check(cx: &BlockCx<'_>, error: &SyntaxError, report: &mut Report<'_>) {
    report.add(finding(cx, error));
}

fn finding(cx: &BlockCx<'_>, error: &SyntaxError) -> Finding {
    let finding = Finding::new(&META, cx.in_file(error.range.clone()), "`WHILE` has no `DO`")
        .label("`DO` and a number must follow");
    let behind = cx.slice(error.range.end..cx.block().range.end);
    let word = behind.trim_start();
    if let [b'D' | b'd', b'0', b'1'..=b'9', ..] = word.as_bytes() {
        let zero = error.range.end + (behind.len() - word.len()) as u32 + 1;
        return finding
            .also(cx.in_file(zero..zero + 1), "this is a zero")
            .help("write the letter O in `DO`")
            .fix(Fix::risky("replace the zero by the letter O", cx.in_file(zero..zero + 1), "O"));
    }
    finding.help("add `DO1` after the condition")
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::{World, check_rule, findings, fixed, only, words};

    #[test]
    fn the_condition_is_marked() {
        check_rule(
            &RULE,
            "fanuc-mill",
            "WHILE [#1 LT 5.]\nWHILE [#1 LT 5.] DO1\n",
            &expect![[r#"
            1 | WHILE [#1 LT 5.]
              | ^^^^^^^^^^^^^^^^ error[while-without-do] `WHILE` has no `DO`
        "#]],
        );
    }

    #[test]
    fn a_zero_for_the_letter() {
        let program = "WHILE [#1 LT 5.] D01\n";
        let found = findings(&only(&RULE), "haas-mill", program, &World::default());
        expect![[r#"
            WHILE [#1 LT 5.] DO1
        "#]]
        .assert_eq(&found.iter().map(|f| fixed(program, f)).collect::<String>());
    }

    #[test]
    fn words_point_at_the_zero() {
        let program = "WHILE[#1LT5.]D01\n";
        let found = findings(&only(&RULE), "haas-mill", program, &World::default());
        expect![[r#"
            `WHILE` has no `DO`
              here: `DO` and a number must follow
              there: this is a zero
              help: write the letter O in `DO`
              fix (unsafe): replace the zero by the letter O
        "#]]
        .assert_eq(&found.iter().map(words).collect::<String>());
    }
}
