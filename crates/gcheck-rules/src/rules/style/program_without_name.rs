//! A program number without a name.

use crate::declare::declare_rule;
use crate::facts::sections::keeps_programs_by_number;
use crate::{FileCx, Finding, Report, Run};

declare_rule! {
    /// No comment after the program's number names its part.
    ///
    /// ## Why it matters
    /// The control's list of programs shows the number and this comment. With a number alone, the operator can start
    /// the wrong program.
    ///
    /// ## Reported
    /// ```nc,reported,fanuc-mill
    /// O1234
    /// G0 X10.
    /// M30
    /// ```
    /// ## Not reported
    /// ```nc,quiet,fanuc-mill
    /// O1234 (FLANGE, SIDE 2)
    /// G0 X10.
    /// M30
    /// ```
    rule "program-without-name" in "style" {
        summary: "program number without a name",
        severity: Hint,
        tier: Program,
        recommended: false,
        sets: [HouseStyle],
        since: "0.1.0",
        run: Run::Program { check },
    }
}

fn check(cx: &FileCx<'_>, report: &mut Report<'_>) {
    if !keeps_programs_by_number(cx) {
        return;
    }
    for program in cx.file_index.programs.iter().filter(|program| program.number.is_some()) {
        let behind = cx.slice(program.range.end..cx.region.end);
        // In the block of the number, or alone on the next line.
        let mut lines = behind.lines().map(str::trim_start);
        let is_named = lines.next().is_some_and(|line| line.contains('('))
            || lines.next().is_some_and(|line| line.starts_with('('));
        if !is_named {
            let number = cx.slice(program.range.clone());
            report.add(
                Finding::new(&META, program.range.clone(), format!("program `{number}` has no name"))
                    .label("only a number")
                    .help(format!("name the part in a comment: `{number} (PART, SIDE)`")),
            );
        }
    }
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::check_rule;

    #[test]
    fn the_name_may_stand_on_the_next_line() {
        check_rule(&RULE, "haas-mill", "%\nO00010\n(PLATE)\nG0 X1.\nM30\n%\n", &expect![[""]]);
    }

    #[test]
    fn where_o_numbers_no_programs() {
        check_rule(&RULE, "linuxcnc", "o100 sub\no100 endsub\nM2\n", &expect![[""]]);
    }
}
