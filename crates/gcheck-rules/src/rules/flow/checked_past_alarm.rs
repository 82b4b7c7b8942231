//! Where the check goes on past an alarm.

use gcheck_engine::Fault;

use crate::declare::declare_rule;
use crate::facts::past_alarm::loses_way;
use crate::{PathCx, PathRule, Report, Run, Watch};
use crate::{Remembers, remembers};

declare_rule! {
    /// The control stops at this block, because it does not find where the program goes on: the block of a jump, a
    /// subprogram, the other end of a loop. The check does not stop. It goes on as if the block were corrected: a jump
    /// falls through, a missing subprogram is passed over, a loop without its other end is straight code. It is reported
    /// once a file, at the first such block.
    ///
    /// ## Why it matters
    /// What is reported after this block holds once the block is corrected. What a missing subprogram changes is not
    /// known, so that mistakes after it may not be reported.
    ///
    /// ## Reported
    /// ```nc,reported,fanuc-mill
    /// O0001
    /// G21 G90 G0 X0. Y0.
    /// GOTO 999
    /// G0 X10.
    /// M30
    /// ```
    /// ## Not reported
    /// Other alarms: after an arc off its circle, or a cut without feed, the program goes on with the next block in any case.
    /// ```nc,quiet,fanuc-mill
    /// O0001
    /// G21 G90 G0 X0. Y0.
    /// G1 X10.
    /// M30
    /// ```
    rule "checked-past-alarm" in "flow" {
        summary: "where the check goes on past an alarm",
        severity: Info,
        tier: Path,
        since: "0.1.0",
        run: Run::Path { watch: Watch::FAULTS, make: || Box::new(CheckedPastAlarm::default()) },
    }
}

#[derive(Default, Clone, PartialEq)]
struct CheckedPastAlarm {
    /// It was reported.
    told: bool,
}

remembers!(CheckedPastAlarm);

impl PathRule for CheckedPastAlarm {
    fn memory(&mut self) -> Remembers<'_> {
        Remembers::All(self)
    }

    /// The analysis of all paths came by this block too.
    fn counts_on_some_path(&self) -> bool {
        false
    }

    fn fault(&mut self, cx: &PathCx<'_>, fault: &Fault, report: &mut Report<'_>) {
        if self.told || !loses_way(fault) {
            return;
        }
        // `M99 P…` of a program that is called from another file names a block there.
        let is_elsewhere = matches!(fault, Fault::NoSuchLabel(_) | Fault::JumpTarget(_))
            && cx.file_index.is_called_from_elsewhere()
            && cx.state().frames().len() <= 1;
        // What the machine's builder or user added is not in the file.
        if is_elsewhere || cx.has_code(gcheck_controls::Code::is_user) {
            return;
        }
        self.told = true;
        let finding =
            crate::Finding::new(&META, cx.range(), "the rest is checked past the alarm of this block")
                .label(match fault {
                    Fault::NoSuchProgram => "the control stops here if it does not have the program",
                    Fault::NoSuchLabel(_) | Fault::JumpTarget(_) => {
                        "the control stops when it takes this jump"
                    }
                    _ => "the control stops here",
                })
                .note("gcheck checks the rest as if this block were corrected")
                .help("correct this block first");
        report.add(finding);
    }
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::check_rule;

    #[test]
    fn the_first_alarm_of_a_file_is_marked() {
        check_rule(
            &RULE,
            "fanuc-mill",
            "O1\nG0 X1.\nGOTO 20\nG0 X2.\nGOTO 30\nM30\n",
            &expect![[r#"
            3 | GOTO 20
              | ^^^^^^^ info[checked-past-alarm] the rest is checked past the alarm of this block
        "#]],
        );
    }

    #[test]
    fn an_alarm_in_a_loop_or_in_a_subprogram_called_twice_is_one() {
        check_rule(
            &RULE,
            "fanuc-mill",
            "O1\n#1=0\nWHILE [#1 LT 3] DO1\nM98 P2\n#1=#1+1\nEND1\nM30\nO2\nGOTO 9\nG0 X1.\nM99\n",
            &expect![[r#"
                9 | GOTO 9
                  | ^^^^^^ info[checked-past-alarm] the rest is checked past the alarm of this block
            "#]],
        );
    }

    #[test]
    fn a_missing_subroutine_is_passed_over() {
        check_rule(
            &RULE,
            "linuxcnc",
            "G0 X1\no1 call\nG0 X2\nM2\n",
            &expect![[r#"
            2 | o1 call
              | ^^^^^^^ info[checked-past-alarm] the rest is checked past the alarm of this block
        "#]],
        );
    }

    #[test]
    fn a_block_of_a_caller_in_another_file_is_not_known() {
        check_rule(&RULE, "fanuc-mill", "O2\nG0 X1.\nM99 P50\n", &expect![[""]]);
    }
}
