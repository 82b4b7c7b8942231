//! Axes that go home while the tool is in the part.

use gcheck_controls::Effect;
use gcheck_engine::{At, Axis, Event, Travel};
use gcheck_geometry::{Mm, Plane};

use crate::declare::declare_rule;
use crate::facts::depth::Depth;
use crate::{MakeShared, PathCx, PathRule, Report, Run, Uses, Watch};
use crate::{Remembers, remembers};

declare_rule! {
    /// X or Y goes to the reference position (`G28`, `G30`) or to a machine position (`G53`), and the tool is still as deep
    /// in the part as its last cut left it. That is so too if Z goes home in the same block: all axes leave at once.
    ///
    /// Only mills are looked at. The level is in the part if it is below the zero of the part, or below another cut of the
    /// same tool.
    ///
    /// ## Why it matters
    /// The tool leaves at rapid, sideways or on a slant, through whatever is beside the cut: part, clamps, vice. Z has to go
    /// up in a block of its own before the other axes move.
    ///
    /// ## Reported
    /// ```nc,reported,haas-mill
    /// T1 M6
    /// G20 G90 G54 G0 X-1. Y0 S4000 M3
    /// G43 H1 Z.1
    /// G1 Z-.4 F20.
    /// X3.
    /// G91 G28 X0 Y0 Z0
    /// M30
    /// ```
    /// ```nc,reported,haas-mill
    /// T1 M6
    /// G20 G90 G54 G0 X-1. Y0 S4000 M3
    /// G43 H1 Z.1
    /// G1 Z-.4 F20.
    /// X3.
    /// G53 G0 X0 Y0
    /// G53 Z0
    /// M30
    /// ```
    /// ## Not reported
    /// ```nc,quiet,haas-mill
    /// T1 M6
    /// G20 G90 G54 G0 X-1. Y0 S4000 M3
    /// G43 H1 Z.1
    /// G1 Z-.4 F20.
    /// X3.
    /// G91 G28 Z0
    /// G28 X0 Y0
    /// M30
    /// ```
    rule "home-before-retract" in "motion" {
        summary: "X or Y goes home while the tool is in the part",
        severity: Warning,
        tier: Path,
        since: "0.1.0",
        run: Run::Path { watch: Watch::RAPIDS, make: || Box::new(HomeBeforeRetract { told: None }) },
    }
}

#[derive(Clone, PartialEq)]
struct HomeBeforeRetract {
    /// The cut after which a return was reported.
    told: Option<At>,
}

remembers!(HomeBeforeRetract: told);

impl PathRule for HomeBeforeRetract {
    fn memory(&mut self) -> Remembers<'_> {
        Remembers::All(self)
    }

    fn shares(&self) -> Option<MakeShared> {
        Some(Depth::shared)
    }

    fn concerns(&self, program: &Uses<'_>) -> bool {
        program.may(Effect::goes_to_machine_place)
            && program.environment.control().machine() == gcheck_controls::Machine::Mill
    }

    fn rapid(&mut self, cx: &PathCx<'_>, event: &Event, report: &mut Report<'_>) {
        let Event::Travel(travel) = event else { return };
        if !cx.has_effect(Effect::goes_to_machine_place) {
            cx.rest();
            return;
        }
        // A mill's control may drive a lathe, whose tools leave the part across.
        let turns = cx.state().plane(cx.model) == Some(Plane::Zx);
        if !cx.is_on_every_path() || turns {
            return;
        }
        let Some(z) = travel.from.get(Axis::Z).filter(|_| leaves_sideways(travel)) else { return };
        let Some(cut) = cx.shared::<Depth>().and_then(|depth| depth.last_cut_in_part(z)) else { return };
        if self.told.replace(cut) == Some(cut) {
            return;
        }
        let is_slant = travel.to.get(Axis::Z).is_none_or(|to| to > z);
        let (message, label) = if is_slant {
            ("the tool goes home on a slant, from inside the part", "all axes leave at once, at rapid")
        } else {
            ("the tool goes home sideways while it is in the part", "this moves X and Y at rapid, and not Z")
        };
        let finding = cx.finding(&META, cx.effect_range(Effect::goes_to_machine_place), message).label(label);
        let finding = match cx.range_of(cut) {
            Some(range) => {
                let at = cx.shown(Mm(z));
                finding.also(range, format!("the tool's last cut; the tool is still at Z {at}"))
            }
            None => finding,
        };
        report.add(
            finding
                .assuming("the tool has not left the part sideways")
                .help("retract Z in a block of its own first (`G91 G28 Z0`, `G53 G0 Z0`), then move X and Y"),
        );
    }
}

/// Does X or Y move, to wherever it is?
fn leaves_sideways(travel: &Travel) -> bool {
    let moves = |axis: Axis| {
        let (from, to) = (travel.from.raw(axis), travel.to.raw(axis));
        // The place of home is unknown.
        to.is_nan() && !from.is_nan() || (from - to).abs() > 0.001
    };
    moves(Axis::X) || moves(Axis::Y)
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::check_rule;

    fn program(after: &str) -> String {
        format!(
            "T1 M6\nG21 G90 G54 G0 X-10. Y0. S4000 M3\nG43 H1 Z50.\nZ2.\nG1 Z-5. F200.\nX50.\n{after}\nM30\n"
        )
    }

    #[test]
    fn every_way_home_counts() {
        check_rule(
            &RULE,
            "fanuc-mill",
            &program("G91 G28 X0 Y0 Z0"),
            &expect![[r#"
                7 | G91 G28 X0 Y0 Z0
                  |     ^^^ warning[home-before-retract] the tool goes home on a slant, from inside the part
            "#]],
        );
        check_rule(
            &RULE,
            "fanuc-mill",
            &program("G91 G28 Y0\nG28 Z0"),
            &expect![[r#"
            7 | G91 G28 Y0
              |     ^^^ warning[home-before-retract] the tool goes home sideways while it is in the part
        "#]],
        );
        check_rule(
            &RULE,
            "fanuc-mill",
            &program("G91 G30 X0 Y0 Z0"),
            &expect![[r#"
            7 | G91 G30 X0 Y0 Z0
              |     ^^^ warning[home-before-retract] the tool goes home on a slant, from inside the part
        "#]],
        );
        check_rule(
            &RULE,
            "fanuc-mill",
            &program("G53 X0 Y0"),
            &expect![[r#"
            7 | G53 X0 Y0
              | ^^^ warning[home-before-retract] the tool goes home sideways while it is in the part
        "#]],
        );
        check_rule(
            &RULE,
            "haas-mill",
            &program("G28"),
            &expect![[r#"
            7 | G28
              | ^^^ warning[home-before-retract] the tool goes home on a slant, from inside the part
        "#]],
        );
    }

    #[test]
    fn a_lathe_leaves_the_part_across() {
        let turned = "G7 G18 G21 G90 G95\nT1 M6 G43\nS800 M4\nG0 X42 Z2\nG1 X30 F.2\nZ-20\nX42\nG53 G0 X0\nG53 G0 Z0\nM2\n";
        check_rule(&RULE, "linuxcnc", turned, &expect![[""]]);
    }

    #[test]
    fn a_tool_that_was_lifted_is_free() {
        for lift in ["G0 Z2.\n", "G0 Z50.\n", "G1 Z2.\n", "G91 G28 Z0\n", "G53 G0 Z0\n"] {
            check_rule(&RULE, "haas-mill", &program(&format!("{lift}G91 G28 X0 Y0")), &expect![[""]]);
        }
        check_rule(&RULE, "haas-mill", &program("G91 G28 Z0 M9\nG28 X0 Y0"), &expect![[""]]);
        // The point on the way is above the part.
        check_rule(&RULE, "haas-mill", &program("G91 G28 X0 Y0 Z20."), &expect![[""]]);
    }

    #[test]
    fn a_lift_that_ends_in_the_part_is_none() {
        check_rule(
            &RULE,
            "haas-mill",
            &program("G0 Z-3.\nG53 X0 Y0"),
            &expect![[r#"
            8 | G53 X0 Y0
              | ^^^ warning[home-before-retract] the tool goes home sideways while it is in the part
        "#]],
        );
    }

    #[test]
    fn a_zero_below_the_part_shows_by_the_cuts() {
        let bed = |home: &str| {
            format!(
                "T1 M6\nG21 G90 G54 G0 X0 Y0 S4000 M3\nG43 H1 Z50.\nZ22.\nG1 Z15. F200.\nX50.\nZ10.\nX0\n{home}\nM30\n"
            )
        };
        check_rule(
            &RULE,
            "haas-mill",
            &bed("G53 G0 X0 Y0"),
            &expect![[r#"
            9 | G53 G0 X0 Y0
              | ^^^ warning[home-before-retract] the tool goes home sideways while it is in the part
        "#]],
        );
        check_rule(&RULE, "haas-mill", &bed("G0 Z22.\nG53 G0 X0 Y0"), &expect![[""]]);
        // One level alone is the surface that the tool faces.
        check_rule(&RULE, "haas-mill", &program("G53 X0 Y0").replace("Z-5.", "Z0."), &expect![[""]]);
    }

    #[test]
    fn drilling_cycles_end_above_the_part() {
        let drilled =
            program("G81 Z-9. R2. F90.\nG80\nG91 G28 X0 Y0 Z0").replace("G1 Z-5. F200.\nX50.\n", "");
        check_rule(&RULE, "haas-mill", &drilled, &expect![[""]]);
    }

    #[test]
    fn a_pocket_of_a_cutter_without_a_size_shows_no_moves() {
        let pocket = |lift: &str| {
            format!(
                "T1 M6\nG21 G90 G54 G0 X0 Y0 S4000 M3\nG43 H1 Z50.\nZ2.\nG13 D1 I10. Z-5. F300.\n{lift}G91 G28 X0 Y0 Z0\nM30\n"
            )
        };
        check_rule(&RULE, "haas-mill", &pocket(""), &expect![[""]]);
        check_rule(&RULE, "haas-mill", &pocket("G0 Z2.\n"), &expect![[""]]);
    }

    #[test]
    fn in_a_called_program_and_in_a_loop() {
        let called = "O1\nT1 M6\nG21 G90 G54 G0 X0 Y0 S900 M3\nG43 H1 Z5.\nM98 P2\nG91 G28 X0 Y0 Z0\nM30\nO2\nG1 Z-5. F90.\nX50.\nM99\n";
        check_rule(
            &RULE,
            "fanuc-mill",
            called,
            &expect![[r#"
            6 | G91 G28 X0 Y0 Z0
              |     ^^^ warning[home-before-retract] the tool goes home on a slant, from inside the part
        "#]],
        );
        let lifted = called.replace("X50.\nM99", "X50.\nG0 Z5.\nM99");
        check_rule(&RULE, "fanuc-mill", &lifted, &expect![[""]]);
    }

    #[test]
    fn the_reference_interpreters_control_too() {
        let program = |lift: &str| {
            format!("G21 G90 G54 G17\nT1 M6\nG43 H1\nS900 M3\nG0 X0 Y0 Z5\nG1 Z-3 F90\nX40\n{lift}G28\nM2\n")
        };
        check_rule(
            &RULE,
            "linuxcnc",
            &program(""),
            &expect![[r#"
            8 | G28
              | ^^^ warning[home-before-retract] the tool goes home on a slant, from inside the part
        "#]],
        );
        check_rule(&RULE, "linuxcnc", &program("G0 Z5\n"), &expect![[""]]);
    }
}
