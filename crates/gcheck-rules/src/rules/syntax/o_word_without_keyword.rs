//! An O-word without a keyword.

use gcheck_syntax::{SyntaxError, SyntaxErrorKind};

use crate::declare::declare_rule;
use crate::{BlockCx, Finding, Report, Run, Severity};

declare_rule! {
    /// An `O<name>` is not followed by `sub`, `call`, `if` or another keyword.
    ///
    /// ## Why it matters
    /// The control refuses the block, or takes the name as the head of a subprogram: the call or the branch does not happen.
    ///
    /// ## Reported
    /// ```nc,reported,linuxcnc
    /// o<probe> cal [1]
    /// ```
    /// ## Not reported
    /// ```nc,quiet,linuxcnc
    /// o<probe> call [1]
    /// ```
    rule "o-word-without-keyword" in "syntax" {
        summary: "O-word without a keyword",
        severity: Error,
        tier: Token,
        since: "0.1.0",
        run: Run::Token { on: |kind| kind == SyntaxErrorKind::OWordWithoutKeyword, check },
    }
}

fn check(cx: &BlockCx<'_>, error: &SyntaxError, report: &mut Report<'_>) {
    report.add(finding(cx, error));
}

fn finding(cx: &BlockCx<'_>, error: &SyntaxError) -> Finding {
    let name = cx.slice(error.range.clone()).trim_end();
    let alone = cx.slice(error.range.end..cx.block().range.end).trim_start().trim_end_matches(')');
    let finding = Finding::new(&META, cx.in_file(error.range.clone()), format!("`{name}` has no keyword"))
        .label("`sub`, `call`, `if` or the like must follow")
        .help(format!("write the keyword for `{name}`, for example `{name} call`"));
    // Alone in its block it may be the head of a subprogram.
    if alone.is_empty() || alone.starts_with(['(', ';']) {
        return finding.at_most(Severity::Warning);
    }
    finding
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::check_rule;

    #[test]
    fn a_misspelt_keyword() {
        check_rule(
            &RULE,
            "linuxcnc",
            "o<probe> cal [1]\no<probe>\n",
            &expect![[r#"
            1 | o<probe> cal [1]
              | ^^^^^^^^ error[o-word-without-keyword] `o<probe>` has no keyword
            2 | o<probe>
              | ^^^^^^^^ warning[o-word-without-keyword] `o<probe>` has no keyword
        "#]],
        );
    }

    #[test]
    fn with_its_keyword() {
        check_rule(&RULE, "linuxcnc", "o<probe> call [1]\no1 else if [#1]\n", &expect![[""]]);
    }
}
