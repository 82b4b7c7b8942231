//! A program without a block.

use crate::declare::declare_rule;
use crate::{FileCx, Finding, Report, Run, Severity};

declare_rule! {
    /// A file has no block with a word or statement: it is empty, or has only comments or `%`.
    ///
    /// ## Why it matters
    /// The transfer or the post-processor lost the program; some controls refuse to load such a file.
    ///
    /// ## Reported
    /// ```nc,reported,haas-mill
    /// %
    /// (BRACKET, OP 10)
    /// %
    /// ```
    /// ```nc,reported,linuxcnc
    /// ; bracket, op 10
    /// ```
    /// ## Not reported
    /// ```nc,quiet,haas-mill
    /// %
    /// O1234 (BRACKET, OP 10)
    /// M30
    /// %
    /// ```
    rule "empty-program" in "syntax" {
        summary: "program without a block",
        severity: Warning,
        tier: Program,
        since: "0.1.0",
        run: Run::Program { check },
    }
}

fn check(cx: &FileCx<'_>, report: &mut Report<'_>) {
    if cx.file_index.first_block.is_none() && !cx.file_index.has_mistakes {
        report.add(finding(cx));
    }
}

fn finding(cx: &FileCx<'_>) -> Finding {
    let text = cx.slice(cx.region.clone());
    let start = text.len() - text.trim_start().len();
    let end = text.get(start..).and_then(|t| t.find(['\r', '\n'])).map_or(text.len(), |at| start + at);
    // The file may be meant as notes.
    let (message, severity) = match text.trim() {
        "" => ("file is empty", Severity::Warning),
        marks if marks.chars().all(|c| c == '%' || c.is_whitespace()) => {
            ("program has no block between its `%`", Severity::Info)
        }
        _ => ("program has comments only", Severity::Info),
    };
    Finding::new(&META, start as u32..end.max(start) as u32, message)
        .label("no block with a word or statement from here to the end")
        .help("write the program again from its source, or exclude the file from the check")
        .at_most(severity)
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::check_rule;

    #[test]
    fn comments_are_no_program() {
        check_rule(
            &RULE,
            "haas-mill",
            "%\n(A)\n%\n",
            &expect![[r#"
                1 | %
                  | ^ info[empty-program] program has comments only
            "#]],
        );
        check_rule(
            &RULE,
            "linuxcnc",
            "",
            &expect![[r#"
            1 | 
              | ^ warning[empty-program] file is empty
        "#]],
        );
    }

    #[test]
    fn what_cannot_be_read_is_not_nothing() {
        check_rule(&RULE, "linuxcnc", "5\n", &expect![[""]]);
        check_rule(&RULE, "fanuc-mill", "#1=2.\n", &expect![[""]]);
    }
}
