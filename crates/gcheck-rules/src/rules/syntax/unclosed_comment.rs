//! A parenthesis comment that does not end on its line.

use gcheck_syntax::{SyntaxError, SyntaxErrorKind};

use crate::declare::declare_rule;
use crate::{BlockCx, Finding, Fix, Report, Run};

declare_rule! {
    /// A comment begins with `(` and does not end on its line.
    ///
    /// ## Why it matters
    /// The control either refuses the block or takes the rest of the line as a comment, including code. A comment never
    /// continues on the next line.
    ///
    /// ## Reported
    /// ```nc,reported,haas-mill
    /// G0 X1. (move to start
    /// ```
    /// ## Not reported
    /// ```nc,quiet,haas-mill
    /// G0 X1. (move to start)
    /// ```
    rule "unclosed-comment" in "syntax" {
        summary: "comment is not closed",
        severity: Error,
        tier: Token,
        fixable: Safely,
        since: "0.1.0",
        run: Run::Token { on: |kind| kind == SyntaxErrorKind::UnclosedComment, check },
    }
}

fn check(cx: &BlockCx<'_>, error: &SyntaxError, report: &mut Report<'_>) {
    report.add(finding(cx, error));
}

fn finding(cx: &BlockCx<'_>, error: &SyntaxError) -> Finding {
    let range = cx.in_file(error.range.clone());
    let written = cx.slice(error.range.clone()).trim_end();
    let end = range.start + written.len() as u32;
    Finding::new(&META, range.clone(), "comment is not closed")
        .label("no `)` on this line")
        .note("a comment ends with its line; what follows on the next line is code")
        .help("close the comment with `)`")
        // The control already ignores the words of the comment, so closing it at the line end changes no motion.
        .fix(Fix::safe("close the comment at the end of the line", end..end, ")"))
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::check_rule;

    #[test]
    fn the_comment_is_shown_to_the_end_of_its_line() {
        check_rule(
            &RULE,
            "haas-mill",
            "G0 X1. (start\nG1 X2. F10.\n",
            &expect![[r#"
                1 | G0 X1. (start
                  |        ^^^^^^ error[unclosed-comment] comment is not closed
            "#]],
        );
    }
}
