//! Where the analysis of all paths stopped at a limit.

use gcheck_engine::{At, FlowResult, GivenUp, Limit};

use crate::declare::declare_rule;
use crate::{Finding, FinishCx, PathRule, Report, Run, Watch};

declare_rule! {
    /// A program can be short and run for years: each of nine programs calls the next ten times. The analysis follows such
    /// a program up to a limit, which grows with the length of the text. Here the limit was reached.
    ///
    /// ## Why it matters
    /// Where this is reported, silence about what comes after does not mean that it is right. Blocks that were not seen are
    /// not called unreachable or unused either.
    ///
    /// ## Reported
    /// ```nc,reported,fanuc-mill
    /// O0001
    /// IF [#500 EQ 1] GOTO 10
    /// M98 P2
    /// N10 M30
    /// O0002
    /// M98 P3
    /// M98 P3
    /// M98 P3
    /// M98 P3
    /// M98 P3
    /// M99
    /// O0003
    /// M98 P4
    /// M98 P4
    /// M98 P4
    /// M98 P4
    /// M98 P4
    /// M99
    /// O0004
    /// M98 P5
    /// M98 P5
    /// M98 P5
    /// M98 P5
    /// M98 P5
    /// M99
    /// O0005
    /// M98 P6
    /// M98 P6
    /// M98 P6
    /// M98 P6
    /// M98 P6
    /// M99
    /// O0006
    /// M98 P7
    /// M98 P7
    /// M98 P7
    /// M98 P7
    /// M98 P7
    /// M99
    /// O0007
    /// G0 X1.
    /// M99
    /// ```
    /// ## Not reported
    /// Loops and calls of programs that machines run. A loop that takes more than 10,000 turns is analysed for any number of
    /// turns.
    /// ```nc,quiet,fanuc-mill
    /// O0001
    /// #1=0
    /// WHILE [#1 LT 1000000] DO1
    /// G0 X#1
    /// #1=#1+1
    /// END1
    /// M30
    /// ```
    /// ## How to fix it
    /// * If the limit for executed blocks was reached, allow more with `--fuel BLOCKS`.
    /// * If the limit for paths or for turns of a loop was reached, say what the program cannot: give a variable its
    ///   value with `--set '#500=1'`, or a switch its position with `--block-skip on`.
    /// * Check a long subprogram as a program of its own.
    /// * In a pipeline, `--fail-on-incomplete` makes it count.
    rule "analysis-incomplete" in "flow" {
        summary: "analysis that stopped at a limit",
        severity: Info,
        tier: Path,
        since: "0.1.0",
        run: Run::Path { watch: Watch::FINISH, make: || Box::new(AnalysisIncomplete) },
    }
}

struct AnalysisIncomplete;

impl PathRule for AnalysisIncomplete {
    fn finish(&mut self, cx: &FinishCx<'_>, report: &mut Report<'_>) {
        // One finding a limit, at the first place; more of them say nothing else.
        let mut named: Vec<Limit> = Vec::new();
        let results = std::iter::once(cx.result).chain(cx.others);
        for given_up in results.flat_map(|result: &FlowResult| &result.given_up) {
            if named.contains(&given_up.limit) {
                continue;
            }
            if let Some(finding) = in_main_file(given_up).and_then(|at| finding(cx, at, given_up)) {
                named.push(given_up.limit);
                report.add(finding);
            }
        }
    }
}

/// The innermost block of the main file on the way to where it stopped.
fn in_main_file(given_up: &GivenUp) -> Option<At> {
    std::iter::once(given_up.at).chain(given_up.calls.iter().rev().copied()).find(|at| at.file == 0)
}

fn finding(cx: &FinishCx<'_>, at: At, given_up: &GivenUp) -> Option<Finding> {
    // At the end of the text there is no block any more: then the one before it.
    let range = cx.range_of(at).or_else(|| cx.range_of(At { block: at.block.checked_sub(1)?, ..at }))?;
    let (label, note) = match given_up.limit {
        Limit::Work => (
            "the limit for executed blocks was reached here",
            "without `--fuel` it is 2,000,000 blocks, and 64 more for each block of the program",
        ),
        Limit::States => (
            "the limit for separate paths was reached here",
            "conditions and calls of calls lead here in more ways than are kept apart",
        ),
        Limit::Turns => (
            "the limit for turns of a loop was reached here",
            "each turn of the loop changes something that the analysis does not know",
        ),
    };
    let mut finding = Finding::new(&META, range, "not everything after this block is checked")
        .label(label)
        .note(note)
        .note("mistakes that come after it on some paths may not be reported");
    if given_up.limit == Limit::Work {
        finding = finding.help("`--fuel BLOCKS` allows more");
    }
    if let Some(call) = given_up.calls.first().filter(|call| call.file == 0 && **call != at)
        && let Some(range) = cx.range_of(*call)
    {
        finding = finding.also(range, "in the program that is called here");
    }
    Some(finding)
}

#[cfg(test)]
mod tests {
    use std::fmt::Write as _;

    use expect_test::expect;

    use super::RULE;
    use crate::testing::check_rule;

    /// Nine programs of ten calls each: a billion blocks.
    fn calls_of_calls() -> String {
        let mut text = format!("O1\n{}M30\n", "M98 P1001\n".repeat(10));
        for level in 1..9 {
            let calls = format!("M98 P{}\n", 1001 + level).repeat(10);
            let _ = write!(text, "O{}\n{calls}M99\n", 1000 + level);
        }
        text + "O1009\nG0 X1.\nM99\n"
    }

    #[test]
    fn the_block_at_which_the_work_is_done_is_named() {
        check_rule(
            &RULE,
            "fanuc-mill",
            &calls_of_calls(),
            &expect![[r#"
            104 | M98 P1009
                | ^^^^^^^^^ info[analysis-incomplete] not everything after this block is checked
        "#]],
        );
    }

    #[test]
    fn a_long_loop_is_analysed_to_its_end() {
        let program = "O1\n#1=0\nWHILE [#1 LT 3000000] DO1\nG0 X#1\n#1=#1+1\nEND1\nM30\n";
        check_rule(&RULE, "fanuc-mill", program, &expect![[""]]);
    }
}
