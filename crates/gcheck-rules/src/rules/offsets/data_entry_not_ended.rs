//! Lines of data that nothing ends.

use gcheck_controls::Code;
use gcheck_program::DataLeftOpen;

use crate::declare::declare_rule;
use crate::{FileCx, Finding, Report, Run, Severity, limit};

declare_rule! {
    /// A code opens lines of data (`G10 L50`), and nothing ends them (`G11`) before the next command.
    ///
    /// ## Why it matters
    /// The blocks after it are rows of a table to the control: parameters, tool lives, pitch errors. It does not execute them.
    /// The first block that is not a row stops the program with an alarm.
    /// A block without a code looks like a row, and changes the machine's parameters.
    ///
    /// Where the next command calls a subprogram or returns from one, that program may end the data. Then the finding is an info.
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
    for open in cx.file_index.data_left_open() {
        if let Some(code) = cx.control().code_at(open.code) {
            report.add(finding(cx, code, open));
        }
    }
}

fn finding(cx: &FileCx<'_>, code: Code<'_>, open: DataLeftOpen) -> Finding {
    let entry = code.entry();
    let ends = entry.cancelled_by.iter().map(|code| format!("`{code}`")).collect::<Vec<_>>().join(" or ");
    let elsewhere = open.leads_elsewhere.and_then(|code| cx.control().code_at(code));
    let title = if elsewhere.is_some() {
        format!("lines of data that `{}` opens may be left open", entry.code)
    } else {
        format!("nothing ends the lines of data that `{}` opens", entry.code)
    };
    let finding = Finding::new(&META, open.block, title)
        .label("the control reads the blocks after this one as rows of a table")
        .help(format!("write {ends} after the last row"))
        .at_most(limit(entry.confidence));
    match elsewhere {
        Some(code) => finding
            .note(format!(
                "the program that `{}` leads to may have {ends}  [{}]",
                code.number(),
                entry.source
            ))
            .at_most(Severity::Info),
        None => finding.note(format!(
            "up to {ends} it takes rows only, and stops with an alarm at any other command  [{}]",
            entry.source
        )),
    }
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
    fn a_program_that_is_called_or_returned_to_may_end_the_rows() {
        check_rule(
            &RULE,
            "fanuc-mill",
            "O1\nM98 P2\nN1320 P1 R500000\nG11\nM30\nO2\nG10 L50\nM99\nO3\nG10 L50\nM98 P4\nM99\n",
            &expect![[r#"
                7 | G10 L50
                  | ^^^^^^^ info[data-entry-not-ended] lines of data that `G10` opens may be left open
                10 | G10 L50
                   | ^^^^^^^ info[data-entry-not-ended] lines of data that `G10` opens may be left open
            "#]],
        );
    }

    #[test]
    fn a_program_that_begins_shows_that_the_rows_are_over() {
        check_rule(
            &RULE,
            "fanuc-mill",
            "O1\nG10 L50\nN1320 P1 R500000\nO2\nG11\nM99\n",
            &expect![[r#"
            2 | G10 L50
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
