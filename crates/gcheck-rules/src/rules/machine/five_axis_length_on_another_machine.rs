//! 5-axis tool length compensation on a machine without a tilting head.

use gcheck_controls::Letter;
use gcheck_geometry::Arrangement;

use crate::declare::declare_rule;
use crate::facts::five_axis::is_along_tool;
use crate::{PathCx, PathRule, Report, Run, Watch, limit};

declare_rule! {
    /// 5-axis tool length compensation (`G143`) is used on a machine whose configuration has no `A` or no `B` axis, or whose
    /// rotary axes turn the part.
    ///
    /// ## Why it matters
    /// The compensation turns the length with the tool: it works only where two rotary axes, `A` and `B`, tilt the tool. On
    /// other machines the control does not have the option, or moves the axes wrongly.
    ///
    /// The rule needs `[machine] axes` and `rotary` in the configuration. The examples hold for a machine with the axes
    /// X, Y, Z and A.
    ///
    /// ## Reported
    /// ```nc,reported,haas-mill
    /// G90 G143 H1 X0. Y0. Z1. A0.
    /// G49
    /// M30
    /// ```
    /// ## Not reported
    /// ```nc,quiet,haas-mill
    /// G90 G43 H1 Z1.
    /// G0 X0. Y0. A0.
    /// G49
    /// M30
    /// ```
    /// ## How to fix it
    /// * Compensate with `G43` on this machine.
    /// * If two rotary axes tilt the tool, correct `axes` and `rotary` under `[machine]`.
    rule "five-axis-length-on-another-machine" in "machine" {
        summary: "5-axis tool length compensation on a machine without a tilting head",
        severity: Error,
        tier: Path,
        since: "0.1.0",
        run: Run::Path { watch: Watch::BLOCKS, make: || Box::new(FiveAxisLengthOnAnotherMachine) },
    }
}

struct FiveAxisLengthOnAnotherMachine;

impl PathRule for FiveAxisLengthOnAnotherMachine {
    fn block(&mut self, cx: &PathCx<'_>, report: &mut Report<'_>) {
        let codes = cx.codes();
        let Some(code) = codes.iter().copied().find(|code| is_along_tool(cx.model.effect(*code))) else {
            return;
        };
        let Some(code) = cx.control().code_at(code) else { return };
        let (name, entry) = (code.number(), code.entry());
        let machine = cx.environment.machine;
        let lacks: Vec<&str> = ["A", "B"]
            .into_iter()
            .filter(|axis| {
                let letter = Letter::parse(axis);
                machine.axes.is_some_and(|axes| letter.is_some_and(|letter| !axes.contains(letter)))
            })
            .collect();
        let turns_part =
            machine.engine.kinematics.is_some_and(|told| told.arrangement != Arrangement::HeadHead);
        let (message, key) = match lacks.as_slice() {
            [] if turns_part => {
                (format!("this machine's rotary axes do not both tilt the tool (`{name}`)"), "rotary")
            }
            [] => return,
            [axis] => (format!("this machine has no `{axis}` axis to tilt the tool (`{name}`)"), "axes"),
            _ => (format!("this machine has no `A` and `B` axes to tilt the tool (`{name}`)"), "axes"),
        };
        report.add(
            cx.finding(&META, cx.effect_range(is_along_tool), message)
                .label(format!("from `[machine] {key}`"))
                .note(format!(
                    "`{name}` ({}) is for machines on which two rotary axes, A and B, move the tool  [{}]",
                    entry.title, entry.source
                ))
                .help(format!("compensate with `G43` on this machine, or correct `[machine] {key}`"))
                .at_most(limit(entry.confidence)),
        );
    }
}

#[cfg(test)]
mod tests {
    use expect_test::expect;
    use gcheck_controls::LetterSet;
    use gcheck_geometry::{Arrangement, Kinematics, Mm, RotaryAxis};

    use super::RULE;
    use crate::testing::{World, check_rule, check_rule_in};

    const PROGRAM: &str = "G90 G143 H1 X1. Y1. Z1. A5. B5.\nG49\nM30\n";

    fn with_axes(axes: &str) -> World<'static> {
        let mut world = World::default();
        world.machine.axes = Some(LetterSet::of(axes));
        world
    }

    #[test]
    fn nothing_told_nothing_said() {
        check_rule(&RULE, "haas-mill", PROGRAM, &expect![[""]]);
        check_rule_in(&RULE, "haas-mill", PROGRAM, &with_axes("XYZAB"), &expect![[""]]);
    }

    #[test]
    fn an_axis_that_is_not_there() {
        check_rule_in(
            &RULE,
            "haas-mill",
            PROGRAM,
            &with_axes("XYZA"),
            &expect![[r#"
            1 | G90 G143 H1 X1. Y1. Z1. A5. B5.
              |     ^^^^ error[five-axis-length-on-another-machine] this machine has no `B` axis to tilt the tool (`G143`)
        "#]],
        );
        check_rule_in(
            &RULE,
            "haas-mill",
            PROGRAM,
            &with_axes("XYZ"),
            &expect![[r#"
            1 | G90 G143 H1 X1. Y1. Z1. A5. B5.
              |     ^^^^ error[five-axis-length-on-another-machine] this machine has no `A` and `B` axes to tilt the tool (`G143`)
        "#]],
        );
    }

    #[test]
    fn a_table_that_tilts_the_part() {
        let mut world = with_axes("XYZAB");
        world.machine.engine.kinematics = Some(Kinematics {
            arrangement: Arrangement::TableTable,
            order: [RotaryAxis::A, RotaryAxis::B],
            sign: [1.0; 2],
            inclined: [None; 2],
            pivot_length: None,
            offset: [Mm(0.0); 3],
        });
        check_rule_in(
            &RULE,
            "haas-mill",
            PROGRAM,
            &world,
            &expect![[r#"
            1 | G90 G143 H1 X1. Y1. Z1. A5. B5.
              |     ^^^^ error[five-axis-length-on-another-machine] this machine's rotary axes do not both tilt the tool (`G143`)
        "#]],
        );
    }
}
