//! A jump or loop without its number.

use gcheck_syntax::{SyntaxError, SyntaxErrorKind};

use crate::declare::declare_rule;
use crate::{BlockCx, Finding, Fix, Report, Run};

declare_rule! {
    /// `GOTO`, `DO` or `END` is not followed by its number.
    ///
    /// ## Why it matters
    /// The control refuses the block. `GOTO` takes the number without `N`; `DO` and `END` of one loop have the same
    /// digit.
    ///
    /// ## Reported
    /// ```nc,reported,fanuc-mill
    /// GOTO N10
    /// ```
    /// ```nc,reported,haas-mill
    /// WHILE [#1 LT 5.] DO
    /// ```
    /// ## Not reported
    /// ```nc,quiet,fanuc-mill
    /// GOTO 10
    /// N10 M30
    /// ```
    rule "statement-number-missing" in "syntax" {
        summary: "`GOTO`, `DO` or `END` without its number",
        severity: Error,
        tier: Token,
        fixable: OnRequest,
        since: "0.1.0",
        run: Run::Token { on: |kind| kind == SyntaxErrorKind::MissingNumber, check },
    }
}

fn check(cx: &BlockCx<'_>, error: &SyntaxError, report: &mut Report<'_>) {
    report.add(finding(cx, error));
}

fn finding(cx: &BlockCx<'_>, error: &SyntaxError) -> Finding {
    let keyword = cx.slice(error.range.clone());
    let finding = Finding::new(&META, cx.in_file(error.range.clone()), format!("`{keyword}` has no number"))
        .label("a number must follow");
    let behind = cx.slice(error.range.end..cx.block().range.end);
    let label = behind.trim_start();
    let digits = label
        .strip_prefix(['N', 'n'])
        .map(|rest| rest.len() - rest.trim_start_matches(|c: char| c.is_ascii_digit()).len());
    match digits {
        Some(digits) if digits > 0 && keyword.eq_ignore_ascii_case("GOTO") => {
            let n = error.range.end + (behind.len() - label.len()) as u32;
            finding
                .help(format!(
                    "write the number without `N`: `{keyword} {}`",
                    label.get(1..=digits).unwrap_or_default()
                ))
                .fix(Fix::risky("remove the `N`", cx.in_file(n..n + 1), ""))
        }
        _ => finding.help(format!("add the number after `{keyword}`")),
    }
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::{World, check_rule, findings, fixed, only};

    #[test]
    fn the_keyword_is_marked() {
        check_rule(
            &RULE,
            "fanuc-mill",
            "GOTO N10\nGOTO\nEND\nGOTO #1\n",
            &expect![[r#"
            1 | GOTO N10
              | ^^^^ error[statement-number-missing] `GOTO` has no number
            2 | GOTO
              | ^^^^ error[statement-number-missing] `GOTO` has no number
            3 | END
              | ^^^ error[statement-number-missing] `END` has no number
        "#]],
        );
    }

    #[test]
    fn a_loop_without_number() {
        check_rule(
            &RULE,
            "haas-mill",
            "WHILE [#1 LT 5.] DO\n",
            &expect![[r#"
            1 | WHILE [#1 LT 5.] DO
              |                  ^^ error[statement-number-missing] `DO` has no number
        "#]],
        );
    }

    #[test]
    fn a_label_becomes_its_number() {
        let program = "GOTO N10\n";
        let found = findings(&only(&RULE), "fanuc-lathe", program, &World::default());
        expect![[r#"
            GOTO 10
        "#]]
        .assert_eq(&found.iter().map(|f| fixed(program, f)).collect::<String>());
    }
}
