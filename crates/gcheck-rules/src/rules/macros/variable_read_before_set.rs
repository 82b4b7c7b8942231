//! A local variable that is read before it is set.

use std::collections::HashSet;

use crate::declare::declare_rule;
use crate::facts::empty_variables::{Use, argument_of, is_assigned_before, is_in_macro, usage};
use crate::{PathCx, PathRule, Report, Run, Severity, Watch};
use crate::{Remembers, remembers};

declare_rule! {
    /// A local variable is used, and no block on this path has set it: neither the program nor, in a macro, the call.
    ///
    /// ## Why it matters
    /// It is null. In arithmetic null counts as zero, and the control ignores a word with it: `G1 Z#3` does not move Z.
    ///
    /// ## Reported
    /// ```nc,reported,fanuc-mill
    /// O0001
    /// #1=10.
    /// G0 X#1 Y#2
    /// M30
    /// ```
    /// ```nc,reported,haas-mill
    /// O0001
    /// G65 P9100 X1.
    /// M30
    /// O9100
    /// #30= #24 + #26
    /// G0 Z#30
    /// M99
    /// ```
    /// ## Not reported
    /// A test for null, arguments that are passed on, and a program that is called from elsewhere.
    /// ```nc,quiet,fanuc-mill
    /// O0001
    /// IF [#2 EQ #0] THEN #2=5.
    /// G65 P9100 X#2 Y#3
    /// M30
    /// O9100
    /// G0 X#24 Y#25
    /// M99
    /// ```
    /// ```nc,quiet,fanuc-mill
    /// O9100
    /// G0 X#24 Y#25
    /// M99
    /// ```
    rule "variable-read-before-set" in "macros" {
        summary: "variable read before it is set",
        severity: Warning,
        tier: Path,
        since: "0.1.0",
        run: Run::Path { watch: Watch::READS, make: || Box::new(VariableReadBeforeSet::default()) },
    }
}

#[derive(Default, Clone, PartialEq)]
struct VariableReadBeforeSet {
    told: HashSet<u32>,
}

remembers!(VariableReadBeforeSet);

impl PathRule for VariableReadBeforeSet {
    fn memory(&mut self) -> Remembers<'_> {
        Remembers::All(self)
    }

    fn vacant_read(&mut self, cx: &PathCx<'_>, variable: u32, report: &mut Report<'_>) {
        if self.told.contains(&variable) {
            return;
        }
        let [first, last] = cx.model.semantics().locals;
        if !(first..=last).contains(&variable) {
            return;
        }
        let in_macro = is_in_macro(cx);
        if !in_macro && cx.file_index.is_called_from_elsewhere() || is_assigned_before(cx, variable) {
            return;
        }
        let Some(place) = cx.place() else { return };
        let Some((usage, range)) = usage(cx, &place, variable) else { return };
        let argument = argument_of(cx, variable).filter(|_| in_macro);
        let severity = match usage {
            Use::Tested | Use::HandedOn => return,
            // A macro that moves the axes of its arguments ignores the others on purpose.
            Use::Word(_) if in_macro => return,
            Use::Counted => Severity::Info,
            Use::Computed | Use::Word(_) => Severity::Warning,
        };
        self.told.insert(variable);
        let message = match argument {
            Some(letter) => {
                format!(
                    "the call does not give `{letter}`, but the macro uses it in arithmetic (`#{variable}`)"
                )
            }
            None => format!("variable `#{variable}` is read before it is set"),
        };
        let label = match usage {
            Use::Word(_) => "holds nothing here: the control ignores the word",
            _ => "holds nothing here, and counts as zero",
        };
        let help = match argument {
            Some(letter) => {
                format!("give `{letter}` in the call, or test `#{variable}` for `#0` before it is used")
            }
            None => format!("set `#{variable}` before this block"),
        };
        report.add(cx.finding(&META, range, message).label(label).help(help).at_most(severity));
    }
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::check_rule;

    #[test]
    fn each_variable_is_told_once_where_it_is_read_first() {
        check_rule(
            &RULE,
            "fanuc-mill",
            "O1\nG0 X#1\nY[#2*2.]\nIF [#3 GT 5.] GOTO 10\nX#1\nN10 M30\n",
            &expect![[r#"
                2 | G0 X#1
                  |    ^^^ warning[variable-read-before-set] variable `#1` is read before it is set
                3 | Y[#2*2.]
                  | ^^^^^^^^ warning[variable-read-before-set] variable `#2` is read before it is set
                4 | IF [#3 GT 5.] GOTO 10
                  | ^^^^^^^^^^^^^ warning[variable-read-before-set] variable `#3` is read before it is set
            "#]],
        );
    }

    #[test]
    fn counting_from_nothing_is_worth_knowing() {
        check_rule(
            &RULE,
            "haas-mill",
            "O1\n#1= #1 + 1\nG0 X#1\nM30\n",
            &expect![[r#"
            2 | #1= #1 + 1
              | ^^^^^^^^^^ info[variable-read-before-set] variable `#1` is read before it is set
        "#]],
        );
    }

    #[test]
    fn an_argument_that_the_call_does_not_give() {
        check_rule(
            &RULE,
            "fanuc-mill",
            "O1\nG65 P2 A1.\nM30\nO2\nIF [#3 EQ #0] THEN #3=1.\n#30=#1/2+#2\nG0 X#30 Y#25\nM99\n",
            &expect![[r#"
                6 | #30=#1/2+#2
                  | ^^^^^^^^^^^ warning[variable-read-before-set] the call does not give `B`, but the macro uses it in arithmetic (`#2`)
            "#]],
        );
    }

    #[test]
    fn common_variables_hold_what_the_last_program_left() {
        check_rule(&RULE, "fanuc-mill", "O1\nG0 X#100\nM30\n", &expect![[""]]);
    }

    #[test]
    fn a_control_where_unset_variables_are_zero() {
        check_rule(&RULE, "linuxcnc", "G0 X#1\nM2\n", &expect![[""]]);
    }

    #[test]
    fn a_variable_that_another_way_may_have_set() {
        check_rule(&RULE, "fanuc-mill", "O1\nIF [#500 EQ 1] GOTO 10\n#1=5.\nN10 G0 X#1\nM30\n", &expect![""]);
    }
}
