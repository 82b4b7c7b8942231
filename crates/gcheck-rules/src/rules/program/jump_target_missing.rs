//! A jump to a sequence number that the program does not have.

use crate::meta::declare_rule;
use crate::{FileCx, Finding, Report, Run};

declare_rule! {
    /// A jump names a sequence number that stands nowhere in the program.
    ///
    /// ## Why it matters
    /// The control searches the program for the number and stops with an alarm when the block runs, often in the middle of
    /// a cut.
    ///
    /// ## Reported
    /// ```nc,reported,fanuc-mill
    /// O0001
    /// IF [#100 GT 5] GOTO 20
    /// N10 M30
    /// ```
    /// ## Not reported
    /// A computed target is not known here.
    /// ```nc,quiet,fanuc-mill
    /// O0001
    /// IF [#100 GT 5] GOTO 10
    /// GOTO #101
    /// N10 M30
    /// ```
    rule "jump-target-missing" in "program" {
        summary: "jump to a sequence number that does not exist",
        severity: Error,
        tier: Program,
        since: "0.1.0",
        run: Run::Program { check },
    }
}

fn check(cx: &FileCx<'_>, report: &mut Report<'_>) {
    for jump in &cx.survey.jumps {
        let Some(target) = jump.target else { continue };
        let program = program_of(cx, jump.range.start);
        let mut labels = cx.survey.labels.iter().filter(|l| program.contains(&l.range.start));
        if !labels.any(|l| l.number == target) {
            report.add(finding(cx, jump, target));
        }
    }
}

/// Bytes of the program in which an offset lies: from its `O` number to the next.
fn program_of(cx: &FileCx<'_>, offset: u32) -> std::ops::Range<u32> {
    let starts = || cx.survey.programs.iter().map(|p| p.range.start);
    let start = starts().rfind(|s| *s <= offset).unwrap_or(0);
    let end = starts().find(|s| *s > offset).unwrap_or(u32::MAX);
    // Blocks in front of the first number belong to the first program.
    if starts().next() == Some(start) { 0..end } else { start..end }
}

fn finding(cx: &FileCx<'_>, jump: &gcheck_program::Jump, target: u32) -> Finding {
    let by = cx.control().code_at(jump.code).map_or_else(|| "GOTO".to_owned(), |code| code.entry().code.clone());
    let elsewhere = cx.survey.labels.iter().find(|l| l.number == target);
    let finding = Finding::new(&META, jump.range.clone(), format!("`N{target}` does not exist in this program"))
        .label(format!("`{by}` looks for `N{target}`"))
        .note("the control looks for the number when the block runs, and alarms if it is not found")
        .help(format!("add `N{target}` at the block to go to, or correct the number"));
    match elsewhere {
        Some(label) => finding.also(label.range.clone(), "this one belongs to another program of the file"),
        None => finding,
    }
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::check_rule;

    #[test]
    fn labels_of_another_program_in_the_file_do_not_count() {
        check_rule(
            &RULE,
            "fanuc-mill",
            "O1\nGOTO 10\nM30\nO2\nN10 M99\n",
            &expect![[r#"
                2 | GOTO 10
                  | ^^^^^^^ error[jump-target-missing] `N10` does not exist in this program
            "#]],
        );
    }
}
