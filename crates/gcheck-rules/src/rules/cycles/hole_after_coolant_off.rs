//! A hole that a canned cycle makes after the coolant of its holes was switched off.

use gcheck_engine::{At, Coolant, Event, Fact, Role, Truth};

use crate::declare::declare_rule;
use crate::facts::cycles::{cycle_name, is_cycle};
use crate::{PathCx, PathRule, Report, Run, Uses, Watch};
use crate::{Remembers, remembers};

declare_rule! {
    /// A canned cycle makes holes with coolant, the coolant is switched off, and the next block with a position makes
    /// another hole, because nothing has ended the cycle.
    ///
    /// ## Why it matters
    /// A program that switches the coolant off is done with the holes: the block was meant as a move, away from the part or
    /// over the clamps. The tool drills there instead.
    ///
    /// ## Reported
    /// ```nc,reported,haas-mill
    /// T2 M6
    /// G20 G90 G54 G0 X1. Y1. S3000 M3
    /// G43 H2 Z1. M8
    /// G99 G81 Z-.75 R.1 F10.
    /// X2.
    /// M9
    /// X8. Y6.
    /// G53 G0 Z0.
    /// M30
    /// ```
    /// ## Not reported
    /// ```nc,quiet,haas-mill
    /// T2 M6
    /// G20 G90 G54 G0 X1. Y1. S3000 M3
    /// G43 H2 Z1. M8
    /// G99 G81 Z-.75 R.1 F10.
    /// X2. M9
    /// G80
    /// X8. Y6.
    /// G53 G0 Z0.
    /// M30
    /// ```
    rule "hole-after-coolant-off" in "cycles" {
        summary: "hole made after the coolant was switched off",
        severity: Warning,
        tier: Path,
        since: "0.1.0",
        run: Run::Path {
            watch: Watch::CUTS.union(Watch::CHANGES).union(Watch::MODES),
            make: || Box::new(HoleAfterCoolantOff::default()),
        },
    }
}

#[derive(Default, Clone, PartialEq)]
struct HoleAfterCoolantOff {
    /// The block that began the last cycle with a hole under coolant.
    cooled: Option<At>,
    /// The block that switched the coolant off under that cycle.
    off: Option<At>,
    /// Coolant goes through the tool.
    through: bool,
}

remembers!(HoleAfterCoolantOff: cooled, off);

impl PathRule for HoleAfterCoolantOff {
    fn memory(&mut self) -> Remembers<'_> {
        Remembers::All(self)
    }

    fn concerns(&self, program: &Uses<'_>) -> bool {
        program.may(is_cycle)
    }

    fn changed(&mut self, cx: &PathCx<'_>, event: &Event, _: &mut Report<'_>) {
        if let Event::Coolant { kind: Coolant::Through, on } = event {
            self.through = *on;
        }
        match event {
            Event::Coolant { kind: Coolant::Flood | Coolant::Mist, on: false } => {
                let begun = cx.definitions().set_by(Fact::Mode(Role::Cycle));
                let is_under_it = begun.is_some() && begun == self.cooled;
                self.off = Some(cx.origin().at).filter(|_| is_under_it);
            }
            Event::Coolant { on: true, .. } | Event::Modal(_) => self.off = None,
            _ => {}
        }
    }

    fn cut(&mut self, cx: &PathCx<'_>, event: &Event, report: &mut Report<'_>) {
        let is_stroke = match event {
            Event::Travel(travel) => travel.expanded,
            Event::RigidTap { .. } => true,
            _ => false,
        };
        let cycle = cx.state().active_cycle(cx.model).filter(|code| code.is_some());
        if cycle.is_none() || !is_stroke {
            return;
        }
        let (flood, mist) = cx.state().coolant();
        if flood == Truth::True || mist == Truth::True {
            self.cooled = cx.definitions().set_by(Fact::Mode(Role::Cycle));
            return;
        }
        let Some(off) = self.off.take().filter(|off| *off != cx.origin().at) else { return };
        let is_off = flood == Truth::False && mist == Truth::False;
        let is_of_cycle = cx.definitions().set_by(Fact::Mode(Role::Cycle)) == self.cooled;
        if !is_off || self.through || !is_of_cycle || !cx.is_on_every_path() || cx.has_effect(is_cycle) {
            return;
        }
        let message = format!("the cycle is still on and makes a hole here (`{}`)", cycle_name(cx));
        let finding =
            cx.finding(&META, cx.range(), message).label("without coolant, unlike the holes before it");
        let finding = match cx.range_of(off) {
            Some(range) => finding.also(range, "the coolant is switched off here"),
            None => finding,
        };
        let end = "if this is to be a move, end the cycle before it (`G80`) and write `G0` in it";
        let finding = cx.resting_on(finding, Fact::Mode(Role::Cycle), &format!("`{}`", cycle_name(cx)));
        report.add(finding.help(end));
    }
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::check_rule;

    fn program(after: &str) -> String {
        format!(
            "T2 M6\nG21 G90 G54 G0 X10. Y10. S900 M3\nG43 H2 Z25. M8\nG81 Z-9. R2. F90.\nX20.\n{after}\nM30\n"
        )
    }

    #[test]
    fn a_park_position_is_drilled() {
        check_rule(
            &RULE,
            "fanuc-mill",
            &program("M9\nX200. Y150.\nG80"),
            &expect![[r#"
            7 | X200. Y150.
              | ^^^^^^^^^^^ warning[hole-after-coolant-off] the cycle is still on and makes a hole here (`G81`)
        "#]],
        );
        check_rule(
            &RULE,
            "linuxcnc",
            &program("M9\nX200. Y150.\nG80").replace("M30", "M2"),
            &expect![[r#"
            7 | X200. Y150.
              | ^^^^^^^^^^^ warning[hole-after-coolant-off] the cycle is still on and makes a hole here (`G81`)
        "#]],
        );
        check_rule(
            &RULE,
            "fanuc-mill",
            &program("M9 M5\nX200. Y150.\nG80"),
            &expect![[r#"
            7 | X200. Y150.
              | ^^^^^^^^^^^ warning[hole-after-coolant-off] the cycle is still on and makes a hole here (`G81`)
        "#]],
        );
    }

    #[test]
    fn a_cycle_that_has_ended_makes_no_hole() {
        for after in ["M9\nG80\nX200.", "M9\nG0 X200.", "G80 M9\nX200.", "G0 Z50. M9\nX200."] {
            check_rule(&RULE, "fanuc-mill", &program(after), &expect![[""]]);
        }
    }

    #[test]
    fn the_last_hole_may_switch_it_off() {
        check_rule(&RULE, "fanuc-mill", &program("X30. M9\nG80"), &expect![[""]]);
        check_rule(&RULE, "linuxcnc", &program("X30. M9\nG80").replace("M30", "M2"), &expect![[""]]);
    }

    #[test]
    fn holes_that_were_dry_throughout() {
        check_rule(&RULE, "fanuc-mill", &program("M9\nX200.\nG80").replace(" M8", ""), &expect![[""]]);
        check_rule(&RULE, "fanuc-mill", &program("M9\nM8\nX200.\nG80"), &expect![[""]]);
    }

    #[test]
    fn a_new_cycle_is_meant() {
        check_rule(&RULE, "fanuc-mill", &program("M9\nG83 X50. Z-20. R2. Q3. F50.\nG80"), &expect![[""]]);
    }
}
