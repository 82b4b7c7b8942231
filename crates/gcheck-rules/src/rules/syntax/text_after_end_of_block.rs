//! Text after the end-of-block character.

use gcheck_syntax::{SyntaxError, SyntaxErrorKind};

use crate::declare::declare_rule;
use crate::{BlockCx, Finding, Fix, Report, Run};

declare_rule! {
    /// There is text that is not code after a `;`.
    ///
    /// ## Why it matters
    /// On this control `;` ends a block, and the text after it is the next block. The control reads a remark there as
    /// code: it refuses it, or executes what happens to be a word.
    ///
    /// ## Reported
    /// ```nc,reported,haas-mill
    /// G0 X1. ; move to start
    /// ```
    /// ## Not reported
    /// ```nc,quiet,haas-mill
    /// G0 X1. ; (move to start)
    /// ```
    /// If `;` begins a comment, any text may follow.
    /// ```nc,quiet,linuxcnc
    /// G0 X1 ; move to start
    /// ```
    rule "text-after-end-of-block" in "syntax" {
        summary: "text after the end-of-block character",
        severity: Warning,
        tier: Token,
        control_specific: true,
        fixable: OnRequest,
        since: "0.1.0",
        run: Run::Token { on: |kind| kind == SyntaxErrorKind::TextAfterEndOfBlock, check },
    }
}

fn check(cx: &BlockCx<'_>, error: &SyntaxError, report: &mut Report<'_>) {
    report.add(finding(cx, error));
}

fn finding(cx: &BlockCx<'_>, error: &SyntaxError) -> Finding {
    let text = cx.slice(error.range.clone()).trim_end();
    let start = error.range.start;
    let range = cx.in_file(start..start + text.len() as u32);
    let finding = Finding::new(&META, range.clone(), "remark after `;` is read as code")
        .label("a block of its own on this control")
        .note("`;` is the end-of-block character here, not the beginning of a comment")
        .help("put the remark in parentheses");
    if text.contains(['(', ')']) {
        return finding;
    }
    finding.fix(Fix::risky("put the remark in parentheses", range, format!("({text})")))
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::{World, check_rule, findings, fixed, only};

    #[test]
    fn the_remark_is_marked() {
        check_rule(
            &RULE,
            "haas-mill",
            "G0 X1. ; move to start\nG0 X1. ; (move)\nG0 X1. ; G1 F5.\n",
            &expect![[r#"
            1 | G0 X1. ; move to start
              |          ^^^^^^^^^^^^^ warning[text-after-end-of-block] remark after `;` is read as code
        "#]],
        );
    }

    #[test]
    fn where_a_semicolon_is_a_comment() {
        check_rule(&RULE, "linuxcnc", "G0 X1 ; move to start\n", &expect![[""]]);
    }

    #[test]
    fn the_remark_becomes_a_comment() {
        let program = "G0 X1. ; move to start\n";
        let found = findings(&only(&RULE), "fanuc-mill", program, &World::default());
        expect![[r#"
            G0 X1. ; (move to start)
        "#]]
        .assert_eq(&found.iter().map(|f| fixed(program, f)).collect::<String>());
    }
}
