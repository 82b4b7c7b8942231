//! A canned cycle whose retract plane lies below its bottom.

use std::collections::BTreeSet;

use gcheck_controls::{CodeIx, Effect, Letter};
use gcheck_engine::{At, CycleFault, Event, Fact, Fault, Role};
use gcheck_geometry::Mm;

use crate::declare::declare_rule;
use crate::facts::cycles::{cycle_name, cycle_range, is_cycle, is_own_operation};
use crate::{Finding, PathCx, PathRule, Report, Run, Severity, Uses, Watch, limit};
use crate::{Remembers, remembers};

declare_rule! {
    /// The retract plane (`R`) of a canned cycle lies below the bottom of its hole (`Z`): the bottom is above `R`.
    ///
    /// ## Why it matters
    /// The control stops with an alarm, or the tool moves at rapid to below the bottom and feeds upward. The sign of
    /// `R` or `Z` is wrong, or one of them was meant as a distance.
    ///
    /// ## Reported
    /// ```nc,reported,linuxcnc
    /// G21 G90 G0 X0 Y0 Z10
    /// G81 X10 Z5 R2 F100
    /// M2
    /// ```
    /// ```nc,reported,haas-mill
    /// G20 G90 G0 X0 Y0 Z1.
    /// G81 X1. Z.5 R.1 F10.
    /// G80
    /// M30
    /// ```
    /// ## Not reported
    /// ```nc,quiet,haas-mill
    /// G20 G90 G0 X0 Y0 Z1.
    /// G81 X1. Z-.5 R.1 F10.
    /// G80
    /// M30
    /// ```
    rule "cycle-r-below-bottom" in "cycles" {
        summary: "canned cycle whose R lies below its bottom",
        severity: Error,
        tier: Path,
        since: "0.1.0",
        run: Run::Path {
            watch: Watch::FAULTS.union(Watch::CUTS),
            make: || Box::new(CycleRBelowBottom::default()),
        },
    }
}

#[derive(Default, Clone, PartialEq)]
struct CycleRBelowBottom {
    /// Blocks that began the reported cycles.
    told: BTreeSet<Option<At>>,
}

remembers!(CycleRBelowBottom: told);

impl PathRule for CycleRBelowBottom {
    fn memory(&mut self) -> Remembers<'_> {
        Remembers::All(self)
    }

    fn concerns(&self, program: &Uses<'_>) -> bool {
        program.may(is_cycle)
    }

    fn fault(&mut self, cx: &PathCx<'_>, fault: &Fault, report: &mut Report<'_>) {
        // A bottom that the block does not give is what is missing.
        let has_depth = !is_own_operation(cx) || cx.origin().letters.contains(Letter::of('Z'));
        if *fault != Fault::Cycle(CycleFault::RBelowBottom)
            || !has_depth
            || !self.told.insert(cx.definitions().set_by(Fact::Mode(Role::Cycle)))
        {
            return;
        }
        report.add(finding(cx).at_most(limit(cx.model.semantics().confidence)));
    }

    fn cut(&mut self, cx: &PathCx<'_>, event: &Event, report: &mut Report<'_>) {
        let Event::Travel(travel) = event else { return };
        let Some(code) = cx.state().active_cycle(cx.model).filter(|ix: &CodeIx| ix.is_some()) else { return };
        // A back bore enters the hole and cuts on the way up; a tool across the spindle may cut from the bore outward.
        if !travel.expanded || cx.model.effect(code) == Effect::CycleBackBore || cx.model.drills_across(code)
        {
            return;
        }
        let words = cx.state().cycle();
        let upward = words.z - words.r;
        // False for unknown numbers.
        if upward > 1e-4 && self.told.insert(cx.definitions().set_by(Fact::Mode(Role::Cycle))) {
            report.add(finding(cx).at_most(Severity::Warning));
        }
    }
}

fn finding(cx: &PathCx<'_>) -> Finding {
    let words = cx.state().cycle();
    let name = cycle_name(cx);
    let what = if is_own_operation(cx) {
        "the bottom of the cut is above `R`"
    } else {
        "canned cycle with the bottom of its hole above `R`"
    };
    let above = words.z - words.r;
    let finding = cx
        .finding(&META, cycle_range(cx), format!("{what} (`{name}`)"))
        .help("check the signs of `R` and `Z`");
    if above.is_finite() {
        finding.label(format!("the bottom is {} above the retract plane", cx.shown(Mm(above))))
    } else {
        finding.label("the bottom is above the retract plane")
    }
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::check_rule;

    #[test]
    fn the_code_is_marked_once() {
        check_rule(
            &RULE,
            "fanuc-mill",
            "G21 G90 G0 X0 Y0 Z50.\nG81 X10. Z5. R2. F100.\nX20.\nX30.\nG80\nG81 Z-5. R2.\nX40. Z2.\nG80\nM30\n",
            &expect![[r#"
                2 | G81 X10. Z5. R2. F100.
                  | ^^^ warning[cycle-r-below-bottom] canned cycle with the bottom of its hole above `R` (`G81`)
            "#]],
        );
    }

    #[test]
    fn increments_count_the_bottom_from_r() {
        check_rule(
            &RULE,
            "fanuc-mill",
            "G21 G90 G0 X0 Y0 Z0\nG91 G81 X10. R-10. Z-20. F100.\nG81 X10. R-10. Z20.\nG80\nM30\n",
            &expect![[r#"
                3 | G81 X10. R-10. Z20.
                  | ^^^ warning[cycle-r-below-bottom] canned cycle with the bottom of its hole above `R` (`G81`)
            "#]],
        );
    }

    #[test]
    fn a_back_bore_has_its_retract_plane_below() {
        check_rule(
            &RULE,
            "fanuc-mill",
            "G21 G90 G0 X0 Y0 Z50.\nG87 Z-10. R-30. Q1. F100.\nG80\nM30\n",
            &expect![[""]],
        );
    }
}
