//! A spindle that turns while the probe touches.

use gcheck_controls::Effect;
use gcheck_engine::{Event, Fact, Spindle};

use crate::declare::declare_rule;
use crate::facts::compensation::may_be_on;
use crate::facts::probing::is_probing_move;
use crate::{PathCx, PathRule, Report, Run, Watch};

declare_rule! {
    /// A work offset is measured (`G36`, `G136`) with the probe in a turning spindle, or a tool's size (`G35`) with the
    /// spindle turning forward, or a mill probes (`G31`, `G38.2`) with the spindle turning forward.
    ///
    /// ## Why it matters
    /// The first touch destroys a spindle probe that turns. A right-hand cutter that turns forward cuts into the tool
    /// probe; the manual asks for backward rotation (`M4`).
    ///
    /// ## Reported
    /// ```nc,reported,haas-mill
    /// S500 M3
    /// G90 G54 G0 X0. Y5.
    /// G91 G36 Y-1. F10.
    /// G90
    /// M30
    /// ```
    /// ```nc,reported,linuxcnc
    /// G21 G90 S500 M3
    /// G38.2 Z-5 F60
    /// M2
    /// ```
    /// ## Not reported
    /// ```nc,quiet,haas-mill
    /// S500 M3
    /// G90 G54 G0 X0. Y5.
    /// M5
    /// G91 G36 Y-1. F10.
    /// G90
    /// M30
    /// ```
    rule "spindle-turns-while-probing" in "probing" {
        summary: "spindle turns while the probe touches",
        severity: Warning,
        tier: Path,
        since: "0.1.0",
        run: Run::Path { watch: Watch::CUTS, make: || Box::new(SpindleTurnsWhileProbing) },
    }
}

struct SpindleTurnsWhileProbing;

impl PathRule for SpindleTurnsWhileProbing {
    fn cut(&mut self, cx: &PathCx<'_>, event: &Event, report: &mut Report<'_>) {
        let is_measuring =
            |effect| matches!(effect, Effect::ProbeOffset | Effect::ProbeCentre | Effect::ProbeDiameter);
        // The program does not show what such a code touches with; the spindle of a lathe turns the part.
        let is_touching = |effect| {
            matches!(effect, Effect::Skip | Effect::ProbeToward | Effect::ProbeTowardOptional)
                && !cx.model.semantics().tools.change_by_t
        };
        let is_either = |effect| is_measuring(effect) || is_touching(effect);
        if !is_probing_move(event) || !cx.has_effect(is_either) || may_be_on(cx) {
            return;
        }
        let is_unsure = !cx.has_effect(is_measuring);
        let of_tool = cx.has_effect(|effect| effect == Effect::ProbeDiameter);
        let (message, label, help) = match cx.state().spindle() {
            Some(Spindle::Clockwise) if of_tool => (
                "the tool turns forward while it is measured (`M3`)",
                "a right-hand cutter cuts into the tool probe",
                "turn the tool backward (`M4`) while it touches",
            ),
            Some(Spindle::Clockwise) if is_unsure => (
                "the spindle turns forward while it probes (`M3`)",
                "a probe in the spindle breaks, and a cutter cuts into a tool probe",
                "stop the spindle (`M5`) first; a cutter that touches a tool probe turns backward (`M4`)",
            ),
            Some(Spindle::Clockwise | Spindle::CounterClockwise) if !of_tool && !is_unsure => (
                "the spindle turns while its probe touches",
                "the probe turns with the spindle",
                "stop the spindle (`M5`) before the probing move",
            ),
            _ => return,
        };
        let finding = cx.finding(&META, cx.effect_range(is_either), message).label(label).help(help);
        report.add(cx.resting_on(finding, Fact::Spindle, "spindle"));
    }
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::check_rule;

    #[test]
    fn a_tool_may_turn_backward() {
        check_rule(
            &RULE,
            "haas-mill",
            "S200 M4\nG91 G31 X-1. F5. M75\nG0 X-2.\nG35 X1. D1 F5.\nM3\nG35 X1. D1 F5.\nM5\nG90\nM30\n",
            &expect![[r#"
                6 | G35 X1. D1 F5.
                  | ^^^ warning[spindle-turns-while-probing] the tool turns forward while it is measured (`M3`)
            "#]],
        );
    }

    #[test]
    fn a_probing_move_with_the_spindle_on() {
        check_rule(
            &RULE,
            "linuxcnc",
            "G21 G90 S500 M3\nG38.3 Z-5 F60\nM5\nG38.2 Z-6\nM4\nG38.2 Z-7\nM2\n",
            &expect![[r#"
                2 | G38.3 Z-5 F60
                  | ^^^^^ warning[spindle-turns-while-probing] the spindle turns forward while it probes (`M3`)
            "#]],
        );
        check_rule(&RULE, "haas-lathe", "G97 S500 M3\nG31 X1. F10.\nM30\n", &expect![[""]]);
    }

    #[test]
    fn a_spindle_that_may_turn_is_named_with_its_condition() {
        check_rule(
            &RULE,
            "haas-mill",
            "S200 M3\nIF [#100 EQ 1] GOTO10\nM5\nN10 G91 G36 X1. F5.\nG90\nM30\n",
            &expect![[r#"
                4 | N10 G91 G36 X1. F5.
                  |         ^^^ info[spindle-turns-while-probing] the spindle turns while its probe touches, when `#100` is 1
            "#]],
        );
    }
}
