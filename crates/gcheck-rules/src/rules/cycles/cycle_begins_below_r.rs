//! A canned cycle that begins with the tool below its R plane, and below the zero of the part.

use gcheck_controls::Effect;
use gcheck_engine::{At, Axis, Event};
use gcheck_geometry::Mm;

use crate::declare::declare_rule;
use crate::facts::cycles::{cycle_name, cycle_range, is_cycle};
use crate::{PathCx, PathRule, Report, Run, Uses, Watch};
use crate::{Remembers, remembers};

declare_rule! {
    /// A drilling cycle begins with the tool below the zero of the part and below the cycle's R plane, so the tool goes back
    /// up before it drills.
    ///
    /// ## Why it matters
    /// The R plane is where the tool is clear of the part. A tool that is below it is in the part, and may go to the hole at rapid at
    /// that depth. Mostly the sign of the approach is wrong.
    ///
    /// ## Reported
    /// ```nc,reported,haas-lathe
    /// G20 G99 T303
    /// G97 S900 M3
    /// G0 X0. Z-0.2
    /// G83 Z-1.9 R0.1 Q0.25 F0.008
    /// G80
    /// M30
    /// ```
    /// ```nc,reported,haas-mill
    /// G21 G90 G54 G0 X10. Y10. S900 M3
    /// G43 H1 Z-3.
    /// G81 Z-10. R2. F100.
    /// G80
    /// M30
    /// ```
    /// ## Not reported
    /// ```nc,quiet,haas-mill
    /// G21 G90 G54 G0 X10. Y10. S900 M3
    /// G43 H1 Z3.
    /// G81 Z-10. R5. F100.
    /// G80
    /// M30
    /// ```
    rule "cycle-begins-below-r" in "cycles" {
        summary: "cycle that begins below its R plane and below the zero of the part",
        severity: Warning,
        tier: Path,
        since: "0.1.0",
        run: Run::Path { watch: Watch::MOVES, make: || Box::new(CycleBeginsBelowR::default()) },
    }
}

/// Heights that differ by less are one: millimetres.
const LEVEL: f64 = 0.01;
/// So far below the zero of the part the tool is in it: millimetres.
const UNDER: f64 = 0.5;

#[derive(Default, Clone, PartialEq)]
struct CycleBeginsBelowR {
    /// The block that moves: only its first move begins the cycle.
    block: Option<At>,
}

remembers!(CycleBeginsBelowR: block);

impl PathRule for CycleBeginsBelowR {
    fn memory(&mut self) -> Remembers<'_> {
        Remembers::All(self)
    }

    fn concerns(&self, program: &Uses<'_>) -> bool {
        program.may(is_cycle)
    }

    fn moved(&mut self, cx: &PathCx<'_>, event: &Event, report: &mut Report<'_>) {
        let at = cx.origin().at;
        if self.block.replace(at) == Some(at) || !cx.has_effect(is_cycle) {
            return;
        }
        let Event::Travel(travel) = event else { return };
        let Some(code) = cx.state().active_cycle(cx.model).filter(|code| code.is_some()) else { return };
        let is_back_bore = cx.model.effect(code) == Effect::CycleBackBore;
        if !travel.expanded || is_back_bore || cx.model.drills_across(code) {
            return;
        }
        let Some(z) = travel.from.get(Axis::Z) else { return };
        let r = cx.state().cycle().r;
        // False for an R plane that is not known.
        if z < -UNDER && r > z + LEVEL {
            let name = cycle_name(cx);
            report.add(
                cx.finding(
                    &META,
                    cycle_range(cx),
                    format!("the tool is below the R plane of the cycle (`{name}`)"),
                )
                .label(format!("it is at Z {}, and R is {} higher", cx.shown(Mm(z)), cx.shown(Mm(r - z))))
                .note("an earlier move took the tool below the zero of the part")
                .help("check the sign of Z in the approach"),
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
    fn the_next_hole_begins_where_the_last_one_ends() {
        check_rule(
            &RULE,
            "haas-mill",
            "G21 G90 G54 G0 X10. Y10. S900 M3\nG43 H1 Z5.\nG98 G81 Z-10. R2. F100.\nX20.\nG80\nG1 Z-8. F100.\nG98 G81 Z-20. R-7. F100.\nG80\nG0 Z-9.\nG99 G81 Z-20. R-9. F100.\nG80\nM30\n",
            &expect![[r#"
                7 | G98 G81 Z-20. R-7. F100.
                  |     ^^^ warning[cycle-begins-below-r] the tool is below the R plane of the cycle (`G81`)
            "#]],
        );
    }
}
