//! A contour above the part, after a plunge at its start that comes up again.

use std::ops::Range;

use gcheck_controls::LetterSet;
use gcheck_engine::{Axis, Event, TravelKind};
use gcheck_geometry::{Mm, Plane};

use crate::declare::declare_rule;
use crate::{Finding, PathCx, PathRule, Remembers, Report, Run, Watch, remembers};

declare_rule! {
    /// The tool is fed down into the part and, at the same place, up out of it again, and then cuts a contour of three or more pieces there, above the
    /// zero of the part, up to the next rapid move.
    ///
    /// ## Why it matters
    /// The contour is run in the air, and the part stays as it was. Two blocks have changed places, or a retract was written for the depth.
    ///
    /// ## Reported
    /// ```nc,reported,haas-mill
    /// G21 G90 G54 G0 X0. Y0. S5000 M3
    /// G43 H1 Z25.
    /// G1 Z-5. F100.
    /// Z2.
    /// X40. F400.
    /// Y40.
    /// X0.
    /// Y0.
    /// G0 Z25.
    /// M30
    /// ```
    /// ## Not reported
    /// ```nc,quiet,haas-mill
    /// G21 G90 G54 G0 X0. Y0. S5000 M3
    /// G43 H1 Z25.
    /// Z2.
    /// G1 Z-5. F100.
    /// X40. F400.
    /// Y40.
    /// X0.
    /// Y0.
    /// G0 Z25.
    /// M30
    /// ```
    rule "contour-in-air" in "motion" {
        summary: "contour above the part, after a plunge that comes up again",
        severity: Warning,
        tier: Path,
        since: "0.1.0",
        run: Run::Path { watch: Watch::MOVES, make: || Box::new(ContourInAir::default()) },
    }
}

#[derive(Default, Clone, PartialEq)]
struct ContourInAir {
    step: Step,
    /// The block that was fed down.
    bytes: Range<u32>,
}

remembers!(ContourInAir: bytes);

/// How far the pattern has come.
#[derive(Default, Clone, Copy, PartialEq)]
enum Step {
    #[default]
    None,
    /// Fed straight down to this level.
    Down(f64),
    /// Fed straight up, and so many pieces since, at this level.
    Up { depth: f64, level: f64, pieces: usize },
}

/// Words of a move that is not straight down or up.
const SIDEWAYS: LetterSet = LetterSet::of("XYUVIJR");
/// Levels that differ by less are one: millimetres.
const SLACK: f64 = 0.01;
/// Fewer pieces are a way to the next place.
const FEWEST: usize = 3;

impl PathRule for ContourInAir {
    fn memory(&mut self) -> Remembers<'_> {
        Remembers::All(self)
    }

    fn moved(&mut self, cx: &PathCx<'_>, event: &Event, report: &mut Report<'_>) {
        // Hardly any block is a plunge: the rest is asked of few.
        let goes_sideways = cx.origin().letters.intersects(SIDEWAYS);
        if goes_sideways && self.step == Step::None {
            return;
        }
        if !cx.is_mill() {
            cx.enough();
            return;
        }
        let (kind, programmed, from) = match event {
            Event::Travel(travel) if !travel.expanded => (travel.kind, &travel.programmed, &travel.from),
            Event::Arc(arc) if !arc.expanded => (TravelKind::Feed, &arc.programmed, &arc.from),
            // A piece that compensation puts in, or a stroke of a cycle.
            _ => return,
        };
        let step = std::mem::take(&mut self.step);
        if kind == TravelKind::Rapid {
            if let Step::Up { depth, level, pieces } = step
                && pieces >= FEWEST
            {
                report.add(finding(cx, depth, self.bytes.clone(), level, pieces));
            }
            return;
        }
        let is_in_plane = cx.state().plane(cx.model) == Some(Plane::Xy);
        let Some(z) = programmed.get(Axis::Z).filter(|_| kind == TravelKind::Feed && is_in_plane) else {
            return;
        };
        // Only the direction: beside the programmed path the axes are elsewhere.
        let goes_down = || from.get(Axis::Z).is_some_and(|from| z < from - SLACK);
        self.step = match step {
            _ if !goes_sideways && z < -SLACK && goes_down() => {
                self.bytes = cx.range();
                Step::Down(z)
            }
            Step::Down(depth) if !goes_sideways && z > SLACK => Step::Up { depth, level: z, pieces: 0 },
            Step::Up { depth, level, pieces } if goes_sideways && (z - level).abs() < SLACK => {
                Step::Up { depth, level, pieces: pieces + 1 }
            }
            _ => Step::None,
        };
    }
}

fn finding(cx: &PathCx<'_>, depth: f64, bytes: Range<u32>, level: f64, pieces: usize) -> Finding {
    let [depth, level] = [depth, level].map(|z| cx.shown(Mm(z)));
    cx.finding(&META, bytes, "the tool is fed down and up again before the contour")
        .label(format!("down to Z {depth}, and then up to Z {level}"))
        .note(format!("the contour after it, {pieces} pieces, runs at Z {level}, above the part"))
        .help("check the order of the two blocks, and the Z of the second")
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::check_rule;

    fn contour(down: &str) -> String {
        format!(
            "G20 G90 G54 G0 X-.6 Y-.6 S6000 M3\nG43 H2 Z1.\n{down}G41 D2 X0. Y-0.4 F40.\nY2.75\nG2 X0.25 Y3. R0.25\nG1 X5.75\nG40 X-0.6\nG0 Z1.\nM30\n"
        )
    }

    #[test]
    fn two_blocks_have_changed_places() {
        check_rule(&RULE, "haas-mill", &contour("Z0.1\nG1 Z-0.5 F20.\n"), &expect![[""]]);
        check_rule(
            &RULE,
            "haas-mill",
            &contour("G1 Z-0.5 F20.\nZ0.1\n"),
            &expect![[r#"
            3 | G1 Z-0.5 F20.
              | ^^^^^^^^^^^^^ warning[contour-in-air] the tool is fed down and up again before the contour
        "#]],
        );
    }

    #[test]
    fn a_dot_and_a_way_to_the_next_one() {
        check_rule(
            &RULE,
            "haas-mill",
            "G21 G90 G54 G0 X0. Y0. S6000 M3\nG43 H2 Z5.\nG1 Z-1. F200.\nZ1.\nX5.\nZ-1.\nZ1.\nX10. Y5.\nX20.\nZ-1.\nG0 Z5.\nM30\n",
            &expect![[""]],
        );
    }
}
