//! Arithmetic outside brackets.

use gcheck_syntax::{SyntaxError, SyntaxErrorKind};

use crate::declare::declare_rule;
use crate::{BlockCx, Finding, Fix, Report, Run};

declare_rule! {
    /// An expression with an operator is not in brackets, and the control requires them.
    ///
    /// ## Why it matters
    /// The control refuses the block, or uses the first value and ignores the rest.
    ///
    /// ## Reported
    /// ```nc,reported,fanuc-mill
    /// G1 X#101+2. F100.
    /// ```
    /// Some controls require brackets in assignments too.
    /// ```nc,reported,linuxcnc
    /// #101=#102+2
    /// ```
    /// ## Not reported
    /// ```nc,quiet,fanuc-mill
    /// #101=#102+2.
    /// G1 X[#101+2.] F100.
    /// ```
    rule "expression-needs-brackets" in "syntax" {
        summary: "expression is not in brackets",
        severity: Error,
        tier: Token,
        control_specific: true,
        fixable: OnRequest,
        since: "0.1.0",
        run: Run::Token { on: |kind| kind == SyntaxErrorKind::NeedsBrackets, check },
    }
}

fn check(cx: &BlockCx<'_>, error: &SyntaxError, report: &mut Report<'_>) {
    report.add(finding(cx, error));
}

fn finding(cx: &BlockCx<'_>, error: &SyntaxError) -> Finding {
    let range = cx.in_file(error.range.clone());
    let before = cx.slice(cx.block().range.start..error.range.start);
    let written = cx.slice(error.range.clone());
    let finding = Finding::new(&META, range.clone(), "expression needs brackets")
        .label("is outside `[ ]`")
        .note("this control reads an operator only between `[` and `]`");
    if before.trim_end().ends_with('=') {
        return finding.help(format!("write `[{written}]`")).fix(Fix::risky(
            format!("write `[{written}]`"),
            range,
            format!("[{written}]"),
        ));
    }
    finding.help("put the whole value of the address in `[ ]`")
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::{World, check_rule, findings, fixed, only};

    #[test]
    fn behind_an_address() {
        check_rule(
            &RULE,
            "fanuc-mill",
            "G1 X#101+2. F100.\nG1 X5.-2. F100.\n",
            &expect![[r#"
            1 | G1 X#101+2. F100.
              |         ^^^ error[expression-needs-brackets] expression needs brackets
            2 | G1 X5.-2. F100.
              |       ^^^ error[expression-needs-brackets] expression needs brackets
        "#]],
        );
    }

    #[test]
    fn in_an_assignment() {
        check_rule(
            &RULE,
            "linuxcnc",
            "#101=#102+2\n#101=[#102+2]\n",
            &expect![[r#"
            1 | #101=#102+2
              |      ^^^^^^ error[expression-needs-brackets] expression needs brackets
        "#]],
        );
    }

    #[test]
    fn the_value_is_put_in_brackets() {
        let program = "#101 = #102 + 2 (A)\n";
        let found = findings(&only(&RULE), "linuxcnc", program, &World::default());
        expect![[r#"
            #101 = [#102 + 2] (A)
        "#]]
        .assert_eq(&found.iter().map(|f| fixed(program, f)).collect::<String>());
    }
}
