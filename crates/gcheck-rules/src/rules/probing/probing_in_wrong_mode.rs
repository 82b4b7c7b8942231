//! A probing code in a mode in which it does not work.

use gcheck_engine::Fact;

use crate::declare::declare_rule;
use crate::facts::modes::{ModeInBlock, mode_in_block};
use crate::facts::probing::{ModeDemand, mode_demands, mode_finding};
use crate::{PathCx, PathRule, Report, Run, Watch};

declare_rule! {
    /// A probing or measuring code runs in a wrong mode: with cutter compensation on, with tool length compensation on
    /// while it measures a work offset (`G36`, `G136`), or off while it measures a tool length (`G37`).
    ///
    /// ## Why it matters
    /// The control stops with an alarm, or writes a value to its table that is wrong by the tool's length or radius,
    /// and the next tool cuts in the wrong place.
    ///
    /// ## Reported
    /// ```nc,reported,haas-mill
    /// G90 G54 G0 X0. Y5.
    /// G43 H1 Z1.
    /// G91 G36 Y-1. F10.
    /// G90
    /// M30
    /// ```
    /// ```nc,reported,haas-mill
    /// T1 M6
    /// G90 G54 G0 X0. Y0.
    /// G49
    /// G37 H1 Z0. F10.
    /// M30
    /// ```
    /// ## Not reported
    /// ```nc,quiet,haas-mill
    /// G90 G54 G0 X0. Y5.
    /// G43 H1 Z1.
    /// G49
    /// G91 G36 Y-1. F10.
    /// G90
    /// M30
    /// ```
    rule "probing-in-wrong-mode" in "probing" {
        summary: "probing code in a mode in which it does not work",
        severity: Error,
        tier: Path,
        since: "0.1.0",
        run: Run::Path { watch: Watch::BLOCKS, make: || Box::new(ProbingInWrongMode) },
    }
}

struct ProbingInWrongMode;

impl PathRule for ProbingInWrongMode {
    fn block(&mut self, cx: &PathCx<'_>, report: &mut Report<'_>) {
        for ModeDemand { role, code, most, is_wrong } in mode_demands(cx) {
            let (mode, is_written) = match mode_in_block(cx, role) {
                ModeInBlock::Written(mode) => (mode, true),
                ModeInBlock::Before(mode) => (mode, false),
                ModeInBlock::Several(_) => continue,
            };
            let is_callers =
                !is_written && cx.is_called_only() && cx.definitions().set_by(Fact::Mode(role)).is_none();
            if is_callers || !is_wrong(mode) {
                continue;
            }
            let mode = cx.name_of(mode);
            let finding = mode_finding(cx.finding(&META, cx.range(), String::new()), role, code, &mode, cx);
            let finding = finding.at_most(most);
            report.add(if is_written {
                finding
            } else {
                cx.resting_on(finding, Fact::Mode(role), &format!("`{mode}`"))
            });
        }
    }
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::{World, check_rule, findings, only};

    #[test]
    fn cutter_compensation() {
        check_rule(
            &RULE,
            "haas-mill",
            "G41 D1 G1 X1. F10.\nG91 G31 Y-1. F10.\nG40 X1.\nG90\nM30\n",
            &expect![[r#"
                2 | G91 G31 Y-1. F10.
                  |     ^^^ error[probing-in-wrong-mode] probing with cutter compensation on (`G41`)
            "#]],
        );
    }

    #[test]
    fn modes_of_the_block_itself_act_before_its_move() {
        check_rule(
            &RULE,
            "haas-mill",
            "G90 G43 H1 Z1.\nG91 G49 G36 Y-1. F10.\nG43 G136 Y1. F10. H1\nG90\nM30\n",
            &expect![[r#"
                3 | G43 G136 Y1. F10. H1
                  |     ^^^^ error[probing-in-wrong-mode] work offset measured with a tool length on (`G43`)
            "#]],
        );
    }

    #[test]
    fn a_length_of_nothing_is_off() {
        check_rule(&RULE, "haas-mill", "G90 G43 H0 Z1.\nG91 G36 Y-1. F10.\nG90\nM30\n", &expect![[""]]);
    }

    #[test]
    fn a_length_without_a_number_is_one() {
        let program = |on: &str| {
            format!("G90 G54 G0 X0. Y5.\n{on}\nG91 G31 Y-1. F10. M75\nG0 Y-8.\nG136 Y1. F10.\nG90 G49\nM30\n")
        };
        let found = |on: &str| findings(&only(&RULE), "haas-mill", &program(on), &World::default()).len();
        assert_eq!([found("G43"), found("G43 H1"), found("G43 H0"), found("G49")], [1, 1, 0, 0]);
    }

    #[test]
    fn a_mode_as_at_power_on_is_a_warning() {
        check_rule(
            &RULE,
            "haas-mill",
            "G37 H1 Z0. F10.\nM30\n",
            &expect![[r#"
                1 | G37 H1 Z0. F10.
                  | ^^^ warning[probing-in-wrong-mode] tool length measured with no length in effect (`G49`)
            "#]],
        );
    }

    #[test]
    fn a_caller_may_have_set_the_mode() {
        check_rule(&RULE, "haas-mill", "O9100\nG37 H1 Z0. F10.\nM99\n", &expect![[""]]);
        check_rule(&RULE, "haas-mill", "G65 P9100\nG37 H1 Z0. F10.\nM30\n", &expect![[""]]);
    }

    #[test]
    fn what_the_data_recommends_is_a_warning() {
        check_rule(
            &RULE,
            "fanuc-mill",
            "G21 G41 D1 G1 X10. F100.\nG31 Y-1. F10.\nG40 X20.\nM30\n",
            &expect![[r#"
                2 | G31 Y-1. F10.
                  | ^^^ warning[probing-in-wrong-mode] probing with cutter compensation on (`G41`)
            "#]],
        );
    }

    #[test]
    fn a_lathe_has_nose_compensation() {
        check_rule(
            &RULE,
            "haas-lathe",
            "G18 T101\nG42 G1 X1. F.01\nG31 Z-1. F5.\nG40 X2.\nM30\n",
            &expect![[r#"
                3 | G31 Z-1. F5.
                  | ^^^ error[probing-in-wrong-mode] probing with cutter compensation on (`G42`)
            "#]],
        );
    }
}
