//! A variable that keeps something of the control off after the program.

use gcheck_controls::{Access, Variable};

use crate::declare::declare_rule;
use crate::facts::boundary::{Boundary, boundary, boundary_range};
use crate::{PathCx, PathRule, Report, Run, Severity, Uses, Watch, limit};

declare_rule! {
    /// The program ends while a variable keeps single block, feed hold or the overrides off.
    ///
    /// ## Why it matters
    /// They may stay off in the next program: the operator presses feed hold, and the machine moves on. Whether the end of a
    /// program switches them on again is in no page.
    ///
    /// ## Reported
    /// ```nc,reported,haas-mill
    /// #3004=1
    /// G4 P1.
    /// M30
    /// ```
    /// ## Not reported
    /// ```nc,quiet,haas-mill
    /// #3004=1
    /// G4 P1.
    /// #3004=0
    /// M30
    /// ```
    rule "switched-off-at-end" in "macros" {
        summary: "program ends while single block or feed hold is switched off",
        severity: Info,
        tier: Path,
        since: "0.1.0",
        run: Run::Path { watch: Watch::BLOCKS, make: || Box::new(SwitchedOffAtEnd) },
    }
}

struct SwitchedOffAtEnd;

impl PathRule for SwitchedOffAtEnd {
    fn concerns(&self, program: &Uses<'_>) -> bool {
        let control = program.environment.control();
        let is_kept = |number: u32| matches!(control.variable(number), Variable::Known(v) if v.zero_at_end);
        program.file_index.assigned.iter().any(|(number, _)| is_kept(*number))
    }

    fn block(&mut self, cx: &PathCx<'_>, report: &mut Report<'_>) {
        if boundary(cx) != Some(Boundary::ProgramEnd) {
            return;
        }
        for (number, range) in &cx.file_index.assigned {
            let Variable::Known(entry) = cx.control().variable(*number) else { continue };
            let value = cx.known_variable(*number).filter(|value| *value != 0.0);
            let Some(value) = value.filter(|_| entry.zero_at_end && entry.access != Access::Read) else {
                continue;
            };
            report.add(
                cx.finding(
                    &META,
                    boundary_range(cx, Boundary::ProgramEnd),
                    format!("`#{number}` is still {value} at the end of the program"),
                )
                .label(entry.title.as_str())
                .also(range.clone(), "first set here")
                .note(format!("the variable keeps its value until something sets it  [{}]", entry.source))
                .assuming("the end of the program leaves the variable as it is")
                .help(format!("set it back before the program ends: `#{number}=0`"))
                .at_most(Severity::Info)
                .at_most(limit(entry.confidence)),
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
    fn only_a_value_that_is_known_and_not_zero_is_reported() {
        check_rule(
            &RULE,
            "fanuc-mill",
            "#3003=1\n#3004=#100\nG4 P100\nM30\n",
            &expect![[r#"
            4 | M30
              | ^^^ info[switched-off-at-end] `#3003` is still 1 at the end of the program
        "#]],
        );
        check_rule(&RULE, "fanuc-mill", "#3003=1\nG4 P100\n#3003=0\nM30\n", &expect![[""]]);
    }
}
