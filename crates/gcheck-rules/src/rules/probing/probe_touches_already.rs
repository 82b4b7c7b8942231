//! A probing move that begins with the probe at the surface.

use gcheck_controls::{Effect, LetterSet};
use gcheck_engine::{At, Event, TravelKind};

use crate::declare::declare_rule;
use crate::{PathCx, PathRule, Report, Run, Uses, Watch};
use crate::{Remembers, remembers};

declare_rule! {
    /// A probing move toward the work follows another one that touched, and nothing moved the probe away between them.
    /// Often the second one is meant to be the way back, and `G0` is missing: the probing code is still active.
    ///
    /// ## Why it matters
    /// The probe touches already when the move begins. The control refuses that, and the program stops.
    ///
    /// ## Reported
    /// ```nc,reported,linuxcnc
    /// G21 G90 G94 G54
    /// G0 X0 Y0 Z10
    /// G38.2 Z-5 F60
    /// Z10
    /// M2
    /// ```
    /// ## Not reported
    /// ```nc,quiet,linuxcnc
    /// G21 G90 G94 G54
    /// G0 X0 Y0 Z10
    /// G38.2 Z-5 F60
    /// G0 Z10
    /// M2
    /// ```
    rule "probe-touches-already" in "probing" {
        summary: "probing move begins while the probe touches",
        severity: Warning,
        tier: Path,
        since: "0.1.0",
        run: Run::Path {
            watch: Watch::MOVES.union(Watch::BLOCKS),
            make: || Box::new(ProbeTouchesAlready { touched: None }),
        },
    }
}

#[derive(Clone, PartialEq)]
struct ProbeTouchesAlready {
    /// The block with the last move, if that one ended at a surface.
    touched: Option<At>,
}

remembers!(ProbeTouchesAlready: touched);

impl PathRule for ProbeTouchesAlready {
    fn memory(&mut self) -> Remembers<'_> {
        Remembers::All(self)
    }

    fn concerns(&self, program: &Uses<'_>) -> bool {
        program.may(Effect::probes_toward)
    }

    /// Stops, tool changes and the M codes of a shop may take the probe or its plate away.
    fn block(&mut self, cx: &PathCx<'_>, _: &mut Report<'_>) {
        if cx.origin().letters.intersects(LetterSet::of("MT")) {
            self.touched = None;
        }
    }

    fn moved(&mut self, cx: &PathCx<'_>, event: &Event, report: &mut Report<'_>) {
        let kind = match event {
            Event::Travel(travel) => travel.kind,
            _ => TravelKind::Rapid,
        };
        let TravelKind::Probe { toward: true, required, skip: false } = kind else {
            self.touched = None;
            return;
        };
        let at = cx.origin().at;
        let before = self.touched.replace(at).filter(|before| *before != at);
        if !required {
            // It may have found nothing.
            self.touched = None;
        }
        let Some(range) = before.and_then(|before| cx.range_of(before)) else { return };
        report.add(
            cx.finding(&META, cx.range(), "probing move begins while the probe touches")
                .label("the control refuses to probe from a surface")
                .also(range, "touches here, and nothing moves away after it")
                .help("go away from the surface with `G0`, or with a probing code that moves away"),
        );
    }
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::check_rule;

    #[test]
    fn two_touches_without_a_way_back() {
        check_rule(
            &RULE,
            "linuxcnc",
            "G21 G90 G94\nG38.2 Z-5 F60\nG38.2 Z-6 F20\nG38.4 Z5\nG38.2 Z-6 F20\nG0 Z5\nM2\n",
            &expect![[r#"
                3 | G38.2 Z-6 F20
                  | ^^^^^^^^^^^^^ warning[probe-touches-already] probing move begins while the probe touches
            "#]],
        );
    }

    #[test]
    fn a_touch_that_may_be_missing_and_a_plate_that_is_taken_away() {
        check_rule(&RULE, "linuxcnc", "G21 G90 G94\nG38.3 Z-5 F60\nG38.2 Z-6 F20\nM2\n", &expect![[""]]);
        check_rule(&RULE, "linuxcnc", "G21 G90 G94\nG38.2 Z-5 F60\nM0\nG38.2 X6 F20\nM2\n", &expect![[""]]);
    }
}
