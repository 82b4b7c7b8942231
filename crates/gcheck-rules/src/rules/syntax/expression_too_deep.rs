//! A block that is nested too deeply to be read.

use gcheck_syntax::{MAX_EXPRESSION_DEPTH, MAX_LINE_BYTES, MAX_OPERATORS, SyntaxError, SyntaxErrorKind};

use crate::declare::declare_rule;
use crate::{BlockCx, Finding, Report, Run};

declare_rule! {
    /// Brackets, functions, signs or `IF … THEN` are nested deeper than gcheck reads, or a line has more operators or bytes than it reads.
    ///
    /// ## Why it matters
    /// No control evaluates a block of this depth; most stop at five levels. gcheck does not read the rest of the block.
    ///
    /// ## Reported
    /// ```nc,reported,linuxcnc
    /// #1=-----------------------------------------------------------------------2
    /// ```
    /// ## Not reported
    /// ```nc,quiet,linuxcnc
    /// #1=[[[[2]]]]
    /// ```
    rule "expression-too-deep" in "syntax" {
        summary: "expression nested too deeply to be read",
        severity: Error,
        tier: Token,
        since: "0.1.0",
        run: Run::Token {
            on: |kind| matches!(kind, SyntaxErrorKind::TooDeep | SyntaxErrorKind::LineTooLong),
            check,
        },
    }
}

fn check(cx: &BlockCx<'_>, error: &SyntaxError, report: &mut Report<'_>) {
    report.add(finding(cx, error));
}

fn finding(cx: &BlockCx<'_>, error: &SyntaxError) -> Finding {
    if error.kind == SyntaxErrorKind::LineTooLong {
        // The place where reading ends: the rest may be most of the file.
        let start = error.range.start;
        return Finding::new(&META, cx.in_file(start..start), "line is longer than gcheck reads")
            .label(format!("more than {} MB before this", MAX_LINE_BYTES >> 20))
            .note("the rest of the line was not read")
            .help("put each block on a line of its own");
    }
    Finding::new(&META, cx.in_file(error.range.clone()), "expression is nested too deeply")
        .label(format!("more than {MAX_EXPRESSION_DEPTH} levels, or {MAX_OPERATORS} operators in the line"))
        .note("the rest of the block was not read")
        .help("compute it in steps: assign intermediate results to variables")
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::{World, check_rule, findings, only};

    #[test]
    fn only_the_level_too_many_is_marked() {
        let deep = |levels: usize| format!("#1={}2{}", "[".repeat(levels), "]".repeat(levels));
        for (levels, count) in [(64, 0), (65, 1), (300, 1)] {
            let found = findings(&only(&RULE), "haas-mill", &deep(levels), &World::default());
            assert_eq!(found.len(), count, "{levels}");
        }
    }

    #[test]
    fn consequences_of_conditions_count_too() {
        for (levels, count) in [(64, 0), (65, 1), (100_000, 1)] {
            let block = format!("{}#2=1", "IF[#1EQ1]THEN ".repeat(levels));
            let found = findings(&only(&RULE), "fanuc-mill", &block, &World::default());
            assert_eq!(found.len(), count, "{levels}");
        }
    }

    #[test]
    fn operators_of_a_line_are_counted() {
        for (operators, count) in [(1_000, 0), (1_001, 1), (100_000, 1)] {
            let block = format!("#1=[1{}]", "+1".repeat(operators));
            let found = findings(&only(&RULE), "fanuc-mill", &block, &World::default());
            assert_eq!(found.len(), count, "{operators}");
        }
    }

    #[test]
    fn a_line_is_read_up_to_a_megabyte() {
        for (words, count) in [(262_144, 0), (262_145, 1), (1_000_000, 1)] {
            let line = "X1.5".repeat(words);
            let found = findings(&only(&RULE), "fanuc-mill", &line, &World::default());
            assert_eq!(found.len(), count, "{words}");
        }
    }

    #[test]
    fn signs_count_too() {
        check_rule(
            &RULE,
            "linuxcnc",
            "#1=-----------------------------------------------------------------------2\n",
            &expect![[r#"
            1 | #1=-----------------------------------------------------------------------2
              |                                                                    ^ error[expression-too-deep] expression is nested too deeply
        "#]],
        );
    }
}
