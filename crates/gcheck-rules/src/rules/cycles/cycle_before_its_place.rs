//! A hole that is made without a move after the shift that should have moved it.

use gcheck_controls::{Effect, LetterSet};
use gcheck_engine::{At, Axis, Event, Travel, TravelKind};

use crate::declare::declare_rule;
use crate::facts::cycles::is_cycle;
use crate::{Finding, PathCx, PathRule, Remembers, Report, Run, Uses, Watch, remembers};

declare_rule! {
    /// A shift of X or Y (`G52`) comes after the move that goes to the hole, and the cycle after it names neither X nor Y: the hole is
    /// made where the tool is, and the shift has moved nothing.
    ///
    /// ## Why it matters
    /// The hole is as far from its place as the shift is long. The shift belongs before the move.
    ///
    /// ## Reported
    /// ```nc,reported,haas-mill
    /// G21 G90 G54 G0 X0. Y0. S2000 M3
    /// G43 H1 Z25.
    /// G0 X0. Y0.
    /// G52 X0. Y25.
    /// G81 Z-10. R2. F100.
    /// G80
    /// G52 X0. Y0.
    /// M30
    /// ```
    /// ## Not reported
    /// ```nc,quiet,haas-mill
    /// G21 G90 G54 G0 X0. Y0. S2000 M3
    /// G43 H1 Z25.
    /// G52 X0. Y25.
    /// G0 X0. Y0.
    /// G81 Z-10. R2. F100.
    /// G80
    /// G52 X0. Y0.
    /// M30
    /// ```
    rule "cycle-before-its-place" in "cycles" {
        summary: "hole made before the tool goes to where the shift has moved it",
        severity: Warning,
        tier: Path,
        since: "0.1.0",
        run: Run::Path {
            watch: Watch::BLOCKS.union(Watch::MOVES),
            make: || Box::new(CycleBeforeItsPlace::default()),
        },
    }
}

#[derive(Default, Clone, PartialEq)]
struct CycleBeforeItsPlace {
    /// The shift in X and Y, as bits, when the tool moved in one of them last.
    moved: Option<[u64; 2]>,
    /// The block that shifted since.
    shifted: Option<At>,
    /// What is reported when the cycle of the block makes a hole: one that repeats zero times makes none.
    waiting: Option<Finding>,
}

remembers!(CycleBeforeItsPlace: shifted, waiting);

/// Words that name the place of a hole.
const PLACE: LetterSet = LetterSet::of("XYUV");

impl PathRule for CycleBeforeItsPlace {
    fn memory(&mut self) -> Remembers<'_> {
        Remembers::All(self)
    }

    fn concerns(&self, program: &Uses<'_>) -> bool {
        program.may(|effect| effect == Effect::LocalShift)
    }

    fn block(&mut self, cx: &PathCx<'_>, _: &mut Report<'_>) {
        self.waiting = None;
        if cx.has_effect(|effect| effect == Effect::LocalShift) {
            self.shifted = Some(cx.origin().at);
        }
        if cx.origin().letters.intersects(PLACE)
            || !cx.has_effect(is_cycle)
            || !cx.is_certain()
            || cx.is_malformed()
        {
            return;
        }
        let (Some(moved), Some(now), Some(at)) = (self.moved, shift(cx), self.shifted) else { return };
        // Where the shift is taken back, the next cycle works at the same place once more.
        if moved == now || now == [0; 2] {
            return;
        }
        self.shifted = None;
        let mut finding = cx
            .finding(&META, cx.effect_range(is_cycle), "the hole is made before the tool goes to its place")
            .label("names neither X nor Y, and the tool has not moved since the shift")
            .help("put the shift before the move to the hole, or name X and Y in the block of the cycle");
        if let Some(range) = cx.range_of(at) {
            finding = finding.also(range, "shifts the zero, and moves nothing");
        }
        self.waiting = Some(finding);
    }

    fn moved(&mut self, cx: &PathCx<'_>, event: &Event, report: &mut Report<'_>) {
        if cx.origin().letters.intersects(PLACE) {
            self.waiting = None;
        }
        let is_stroke = |travel: &Travel| travel.expanded && travel.kind != TravelKind::Rapid;
        if let Some(finding) =
            self.waiting.take_if(|_| matches!(event, Event::Travel(travel) if is_stroke(travel)))
        {
            report.add(finding);
        }
        let [from, to] = match event {
            Event::Travel(travel) => [&travel.from, &travel.to],
            Event::Arc(arc) => [&arc.from, &arc.to],
            _ => {
                self.moved = None;
                return;
            }
        };
        let moves = |axis| (from.raw(axis) - to.raw(axis)).abs() > 0.0 || to.raw(axis).is_nan();
        if cx.origin().letters.intersects(PLACE) || moves(Axis::X) || moves(Axis::Y) {
            (self.moved, self.shifted) = (shift(cx), None);
        }
    }
}

/// The shift in X and Y, where it is known.
fn shift(cx: &PathCx<'_>) -> Option<[u64; 2]> {
    let shift = cx.state().shift();
    let known = [Axis::X, Axis::Y].map(|axis| shift.get(axis).map(f64::to_bits));
    Some([known[0]?, known[1]?])
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::check_rule;

    fn bore(blocks: &str) -> String {
        format!("G21 G90 G54 G0 X40. Y0. S2000 M3\nG43 H1 Z25.\n{blocks}G80\nG52 X0. Y0.\nM30\n")
    }

    #[test]
    fn the_shift_comes_too_late() {
        check_rule(
            &RULE,
            "haas-mill",
            &bore("G52 X0. Y25.\nG0 X0. Y0.\nG73 Z-30. R2. Q4. F180.\n"),
            &expect![[""]],
        );
        check_rule(
            &RULE,
            "haas-mill",
            &bore("G0 X0. Y0.\nG52 X0. Y25.\nG73 Z-30. R2. Q4. F180.\n"),
            &expect![[r#"
            5 | G73 Z-30. R2. Q4. F180.
              | ^^^ warning[cycle-before-its-place] the hole is made before the tool goes to its place
        "#]],
        );
    }

    #[test]
    fn a_cycle_that_names_its_place_goes_there() {
        check_rule(
            &RULE,
            "haas-mill",
            &bore("G0 X0. Y0.\nG52 X0. Y25.\nG73 X0. Z-30. R2. Q4. F180.\n"),
            &expect![[""]],
        );
    }

    #[test]
    fn a_shift_of_z_moves_no_hole() {
        check_rule(
            &RULE,
            "haas-mill",
            &bore("G0 X0. Y0.\nG52 Z-5.\nG73 Z-30. R2. Q4. F180.\n"),
            &expect![[""]],
        );
    }

    #[test]
    fn cycles_that_make_no_hole_there() {
        let pattern = |cycle: &str| bore(&format!("G52 X50. Y0.\n{cycle}X10. Y10.\nX20.\n"));
        check_rule(&RULE, "haas-mill", &pattern("G81 Z-10. R2. F100. L0\n"), &expect![[""]]);
        check_rule(&RULE, "fanuc-mill", &pattern("G81 Z-10. R2. F100. K0\n"), &expect![[""]]);
    }

    #[test]
    fn a_second_cycle_after_the_shift_is_taken_back() {
        let blocks =
            "G52 X0. Y25.\nG0 X0. Y0.\nG81 Z-3. R2. F100.\nG80\nG52 X0. Y0.\nG83 Z-30. R2. Q4. F100.\n";
        check_rule(&RULE, "haas-mill", &bore(blocks), &expect![[""]]);
    }
}
