//! A work offset that stays rotated when the program ends.

use gcheck_controls::Effect;
use gcheck_engine::{At, Ending, Event};

use crate::declare::declare_rule;
use crate::facts::boundary::{Boundary, boundary, boundary_range, ends_at_tape_mark};
use crate::facts::offset_schemes::whole;
use crate::{PathCx, PathRule, Remembers, Report, Run, Uses, Watch, remembers};

declare_rule! {
    /// The program writes a rotation into a work offset (`G10 L2 … R30`), cuts with it, and ends without taking it back.
    ///
    /// ## Why it matters
    /// The rotation stays in the table, over the end of the program and over power off. The next job that uses this offset is cut
    /// turned by that angle.
    ///
    /// ## Reported
    /// ```nc,reported,linuxcnc
    /// G21 G90
    /// G10 L2 P2 R30
    /// G55 G0 X20 Y0
    /// G1 X35 F500
    /// M2
    /// ```
    /// ## Not reported
    /// ```nc,quiet,linuxcnc
    /// G21 G90
    /// G10 L2 P2 R30
    /// G55 G0 X20 Y0
    /// G1 X35 F500
    /// G10 L2 P2 R0
    /// M2
    /// ```
    rule "offset-rotation-left" in "offsets" {
        summary: "work offset stays rotated after the program",
        severity: Warning,
        tier: Path,
        since: "0.1.0",
        run: Run::Path {
            watch: Watch::BLOCKS.union(Watch::CUTS).union(Watch::ENDS),
            make: || Box::new(OffsetRotationLeft::default()),
        },
    }
}

#[derive(Default, Clone, PartialEq)]
struct OffsetRotationLeft {
    /// Work offsets by number, with the block that wrote a rotation last.
    written: Vec<(u16, At)>,
    /// Of these the numbers of those in which the program cut then: what only sets offsets up is meant to leave them so.
    used: Vec<u16>,
}

remembers!(OffsetRotationLeft: written);

impl PathRule for OffsetRotationLeft {
    fn memory(&mut self) -> Remembers<'_> {
        Remembers::All(self)
    }

    fn concerns(&self, program: &Uses<'_>) -> bool {
        program.environment.control().semantics().work_offsets_rotate
            && program.may(|effect| effect == Effect::WriteOffsets)
    }

    fn block(&mut self, cx: &PathCx<'_>, report: &mut Report<'_>) {
        if cx.has_effect(|effect| effect == Effect::WriteOffsets)
            && cx.word('R').is_some()
            && matches!(cx.known_number('L').and_then(whole), Some(2 | 20))
            && let Some(number) = written_offset(cx)
        {
            self.written.retain(|(known, _)| *known != number);
            self.written.push((number, cx.origin().at));
        }
        if boundary(cx) == Some(Boundary::ProgramEnd) {
            self.end(cx, report);
        }
    }

    fn cut(&mut self, cx: &PathCx<'_>, _: &Event, _: &mut Report<'_>) {
        if let Some(work) = cx.state().work().filter(|work| !self.used.contains(work))
            && self.written.iter().any(|(number, _)| *number == work)
        {
            self.used.push(work);
        }
    }

    fn ended(&mut self, cx: &PathCx<'_>, ending: Ending, report: &mut Report<'_>) {
        if ends_at_tape_mark(cx, ending) {
            self.end(cx, report);
        }
    }
}

/// The work offset that the block writes: 0 stands for the active one.
fn written_offset(cx: &PathCx<'_>) -> Option<u16> {
    match cx.known_number('P').and_then(whole)? {
        0 => cx.state().work(),
        number => u16::try_from(number).ok(),
    }
}

impl OffsetRotationLeft {
    fn end(&self, cx: &PathCx<'_>, report: &mut Report<'_>) {
        if cx.is_called_only() {
            return;
        }
        for (number, at) in self.written.iter().filter(|(number, _)| self.used.contains(number)) {
            let angle = cx.state().tables().offset(*number).rotation;
            // Full turns turn nothing, and an unknown angle may be one.
            let off = angle - 360.0 * (angle / 360.0).round();
            if off.is_nan() || off.abs() < 1e-6 {
                continue;
            }
            let range = cx.range_of(*at).unwrap_or_else(|| boundary_range(cx, Boundary::ProgramEnd));
            let angle = format!("{angle:.3}");
            let angle = angle.trim_end_matches('0').trim_end_matches('.');
            report.add(
                cx.finding(&META, range, format!("work offset P{number} stays rotated by {angle} degrees"))
                    .label("the program ends without taking it back")
                    .help(format!("write `R0` into offset P{number} before the program ends")),
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
    fn the_last_angle_counts() {
        let program = |last: &str| {
            format!(
                "G21 G90\n#<a> = 0\no200 repeat [3]\nG10 L2 P2 R#<a>\nG55 G0 X20 Y0\nG1 X35 F500\n#<a> = [#<a> + 60]\no200 endrepeat\n{last}M2\n"
            )
        };
        check_rule(
            &RULE,
            "linuxcnc",
            &program(""),
            &expect![[r#"
            4 | G10 L2 P2 R#<a>
              | ^^^^^^^^^^^^^^^ warning[offset-rotation-left] work offset P2 stays rotated by 120 degrees
        "#]],
        );
        check_rule(&RULE, "linuxcnc", &program("G10 L2 P2 R0\n"), &expect![[""]]);
        check_rule(&RULE, "linuxcnc", &program("G10 L2 P2 R#<_angle>\n"), &expect![[""]]);
    }

    #[test]
    fn a_program_that_sets_offsets_up_is_meant_to_leave_them() {
        check_rule(&RULE, "linuxcnc", "G21 G90\nG10 L2 P2 R30\nM2\n", &expect![[""]]);
    }

    #[test]
    fn full_turns_turn_nothing() {
        let program = |angle: &str| format!("G21 G90\nG10 L2 P2 R{angle}\nG55 G0 X20 Y0\nG1 X35 F500\nM2\n");
        check_rule(&RULE, "linuxcnc", &program("360"), &expect![[""]]);
        check_rule(
            &RULE,
            "linuxcnc",
            &program("-315"),
            &expect![[r#"
            2 | G10 L2 P2 R-315
              | ^^^^^^^^^^^^^^^ warning[offset-rotation-left] work offset P2 stays rotated by -315 degrees
        "#]],
        );
    }

    #[test]
    fn offset_zero_is_the_active_one() {
        let program = "G21 G90\nG55\nG10 L2 P0 R30\nG0 X20 Y0\nG1 X35 F500\nM2\n";
        check_rule(
            &RULE,
            "linuxcnc",
            program,
            &expect![[r#"
            3 | G10 L2 P0 R30
              | ^^^^^^^^^^^^^ warning[offset-rotation-left] work offset P2 stays rotated by 30 degrees
        "#]],
        );
    }

    #[test]
    fn another_r_turns_nothing() {
        let program = |write: &str| format!("G21 G90\n{write}\nG55 G0 X20. Y0.\nG1 X35. F500.\nM2\n");
        // The radius of a tool.
        check_rule(&RULE, "linuxcnc", &program("G10 L1 P2 R5."), &expect![[""]]);
        // Offsets of these controls do not turn.
        for control in ["fanuc-mill", "haas-mill", "grbl"] {
            check_rule(&RULE, control, &program("G10 L2 P2 X1. R30."), &expect![[""]]);
        }
    }
}
