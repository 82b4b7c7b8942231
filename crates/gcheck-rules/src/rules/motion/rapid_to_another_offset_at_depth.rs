//! A rapid move to another work offset with the tool still at the depth of its last cut.

use std::ops::Range;

use gcheck_controls::{Effect, LetterSet};
use gcheck_engine::{Axis, Event, Position, TravelKind};
use gcheck_geometry::{Mm, Plane};

use crate::declare::declare_rule;
use crate::{PathCx, PathRule, Remembers, Report, Run, Uses, Watch, remembers};

declare_rule! {
    /// The tool has cut below the zero of the part, has not been lifted since, and goes at rapid to a place of another work offset.
    ///
    /// Cuts of 3 mm or less may be of the face, across a row of blanks, and are not judged.
    ///
    /// ## Why it matters
    /// Between two fixtures are the wall of the part, the jaws and the clamps. The tool goes through them at rapid. Mostly the retract at
    /// the end of a subprogram is missing.
    ///
    /// ## Reported
    /// ```nc,reported,haas-mill
    /// G21 G90 G54 G0 X0. Y0. S5000 M3
    /// G43 H1 Z25.
    /// Z2.
    /// G1 Z-4. F200.
    /// X12.
    /// G55 G0 X0. Y0.
    /// Z2.
    /// M30
    /// ```
    /// ## Not reported
    /// ```nc,quiet,haas-mill
    /// G21 G90 G54 G0 X0. Y0. S5000 M3
    /// G43 H1 Z25.
    /// Z2.
    /// G1 Z-4. F200.
    /// X12.
    /// G0 Z25.
    /// G55 X0. Y0.
    /// Z2.
    /// M30
    /// ```
    rule "rapid-to-another-offset-at-depth" in "motion" {
        summary: "rapid move to another work offset with the tool still down",
        severity: Warning,
        tier: Path,
        since: "0.1.0",
        run: Run::Path {
            watch: Watch::MOVES.union(Watch::CHANGES),
            make: || Box::new(RapidToAnotherOffsetAtDepth::default()),
        },
    }
}

#[derive(Default, Clone, PartialEq)]
struct RapidToAnotherOffsetAtDepth {
    /// The last cut, as long as the tool is as deep.
    cut: Option<Cut>,
}

remembers!(RapidToAnotherOffsetAtDepth: cut);

#[derive(Clone, PartialEq)]
struct Cut {
    work: u16,
    /// Of its end, in its work offset: millimetres, below zero.
    z: f64,
    bytes: Range<u32>,
}

remembers!(Cut: bytes);

/// A cut that is less deep may be of the face: millimetres.
const SHALLOW: f64 = 3.0;

impl PathRule for RapidToAnotherOffsetAtDepth {
    fn memory(&mut self) -> Remembers<'_> {
        Remembers::All(self)
    }

    fn concerns(&self, program: &Uses<'_>) -> bool {
        program.may(|effect| matches!(effect, Effect::WorkOffset(_) | Effect::WorkOffsetByP(_)))
    }

    fn changed(&mut self, _: &PathCx<'_>, event: &Event, _: &mut Report<'_>) {
        if matches!(event, Event::ToolChange(_)) {
            self.cut = None;
        }
    }

    fn moved(&mut self, cx: &PathCx<'_>, event: &Event, report: &mut Report<'_>) {
        if !cx.is_mill() {
            cx.enough();
            return;
        }
        match event {
            Event::Travel(travel) if travel.kind == TravelKind::Feed && !travel.expanded => {
                self.cut = cut(cx, &travel.programmed);
            }
            Event::Arc(arc) if !arc.expanded => self.cut = cut(cx, &arc.programmed),
            Event::Travel(travel) if travel.kind == TravelKind::Rapid && !travel.expanded => {
                let Some(cut) = self.cut.take() else { return };
                let names = |letters: &str| cx.origin().letters.intersects(LetterSet::of(letters));
                // A word of Z lifts the tool, or another rule judges it. Turned, the part is elsewhere.
                if names("ZWUVABC") || cx.has_effect(Effect::goes_to_machine_place) {
                    return;
                }
                if cx.state().work() == Some(cut.work) {
                    self.cut = Some(cut);
                } else if names("XY")
                    && cx.state().work().is_some()
                    && cx.state().plane(cx.model) == Some(Plane::Xy)
                    && cx.is_certain()
                {
                    report.add(
                        cx.finding(
                            &META,
                            cx.range(),
                            "rapid move to another work offset with the tool still down",
                        )
                        .label("the tool was not lifted after its last cut")
                        .also(cut.bytes, format!("cuts at Z {} here", cx.shown(Mm(cut.z))))
                        .help("lift the tool before the move, above all parts and clamps"),
                    );
                }
            }
            _ => {
                self.cut = None;
                if matches!(event, Event::Travel(travel) if travel.expanded) {
                    cx.rest();
                }
            }
        }
    }
}

/// A cut that ends below the zero of the part.
fn cut(cx: &PathCx<'_>, programmed: &Position) -> Option<Cut> {
    let z = programmed.get(Axis::Z).filter(|z| *z < -SHALLOW)?;
    Some(Cut { work: cx.state().work()?, z, bytes: cx.range() })
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::check_rule;

    fn two_vises(retract: &str) -> String {
        format!(
            "O1\nG21 G17 G90 G54 G0 X0. Y0. S5000 M3\nG43 H5 Z25.\nM98 P2\nG0 G90 G55 X0. Y0.\nM98 P2\nG0 Z25.\nM30\nO2\nG0 X0. Y0.\nZ2.\nG1 Z-4. F200.\nG91 X12.\nG3 I-12.\nG1 X-12.\nG90\n{retract}M99\n"
        )
    }

    #[test]
    fn the_retract_of_a_subprogram_is_missing() {
        check_rule(&RULE, "haas-mill", &two_vises("G0 Z25.\n"), &expect![[""]]);
        check_rule(
            &RULE,
            "haas-mill",
            &two_vises(""),
            &expect![[r#"
            5 | G0 G90 G55 X0. Y0.
              | ^^^^^^^^^^^^^^^^^^ warning[rapid-to-another-offset-at-depth] rapid move to another work offset with the tool still down
        "#]],
        );
    }
}
