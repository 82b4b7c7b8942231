//! Lines of data that nothing ends.

use std::ops::Range;

use gcheck_controls::Code;

use crate::declare::declare_rule;
use crate::{FileCx, Finding, Report, Run, limit};

declare_rule! {
    /// A code opens lines of data (`G10 L50`), and nothing ends them (`G11`) before the next command.
    ///
    /// ## Why it matters
    /// The blocks after it are rows of a table to the control: parameters, tool lives, pitch errors. It does not execute them. The first
    /// block that does not look like a row stops the program with an alarm. One that does look like a row changes the machine's parameters.
    ///
    /// ## Reported
    /// ```nc,reported,fanuc-mill
    /// G10 L50
    /// N1320 P1 R500000
    /// G0 X0. Y0.
    /// M30
    /// ```
    /// ## Not reported
    /// ```nc,quiet,fanuc-mill
    /// G10 L50
    /// N1320 P1 R500000
    /// G11
    /// G90 G54 G0 X0. Y0.
    /// M30
    /// ```
    /// ```nc,quiet,fanuc-mill
    /// G10 L2 P1 X-200. Y-150. Z0.
    /// G90 G54 G0 X0. Y0.
    /// M30
    /// ```
    rule "data-entry-not-ended" in "offsets" {
        summary: "lines of data are opened, and nothing ends them",
        severity: Warning,
        tier: Program,
        since: "0.1.0",
        run: Run::Program { check },
    }
}

fn check(cx: &FileCx<'_>, report: &mut Report<'_>) {
    for (code, block) in cx.file_index.data_left_open() {
        if let Some(code) = cx.control().code_at(code) {
            report.add(finding(code, block.clone()));
        }
    }
}

fn finding(code: Code<'_>, block: Range<u32>) -> Finding {
    let entry = code.entry();
    let ends = entry.cancelled_by.iter().map(|code| format!("`{code}`")).collect::<Vec<_>>().join(" or ");
    Finding::new(&META, block, format!("nothing ends the lines of data that `{}` opens", entry.code))
        .label("the control reads the blocks after this one as rows of a table")
        .note(format!("it executes none of them up to {ends}  [{}]", entry.source))
        .help(format!("write {ends} after the last row"))
        .at_most(limit(entry.confidence))
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::check_rule;

    #[test]
    fn the_last_opening_counts() {
        check_rule(
            &RULE,
            "fanuc-mill",
            "G10 L3\nP1 L20\nT1 H1 D1\nG11\nG10 L50\nN3411 R47\nM30\n",
            &expect![[r#"
                5 | G10 L50
                  | ^^^^^^^ warning[data-entry-not-ended] nothing ends the lines of data that `G10` opens
            "#]],
        );
    }

    #[test]
    fn a_command_shows_that_the_rows_are_over() {
        check_rule(
            &RULE,
            "fanuc-mill",
            "G10 L50\nN1320 P1 R500000\nG90 G54 G0 X0. Y0.\nG10 L50\nN1320 P1 R400000\nG11\nM30\n",
            &expect![[r#"
                1 | G10 L50
                  | ^^^^^^^ warning[data-entry-not-ended] nothing ends the lines of data that `G10` opens
            "#]],
        );
    }

    #[test]
    fn other_forms_of_the_code_open_nothing() {
        check_rule(
            &RULE,
            "fanuc-mill",
            "G10 L2 P1 X0. Y0. Z0.\nG10 L#1 P1 R1.\nG10 P1 R1.\nM30\n",
            &expect![[""]],
        );
        check_rule(&RULE, "haas-mill", "G10 L2 P1 X0. Y0. Z0.\nM30\n", &expect![[""]]);
    }
}
