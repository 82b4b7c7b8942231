//! A contour above the part, after a plunge at its start that comes up again.

use std::ops::Range;

use gcheck_controls::{Effect, LetterSet};
use gcheck_engine::{Axis, Event, TravelKind};
use gcheck_geometry::{Mm, Plane};

use crate::declare::declare_rule;
use crate::{Finding, FollowedCx, PathCx, PathRule, Remembers, Report, Run, Watch, remembers};

declare_rule! {
    /// The tool is fed down into the part and, at the same place, up out of it again, and then cuts a contour of four or more pieces there, above the
    /// zero of the part, up to the next move away from it.
    ///
    /// Programs that cut above their zero elsewhere have it on the table, and are not judged.
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
        run: Run::Path {
            watch: Watch::MOVES.union(Watch::FOLLOWED),
            make: || Box::new(ContourInAir::default()),
        },
    }
}

#[derive(Default, Clone, PartialEq)]
struct ContourInAir {
    step: Step,
    /// The block that was fed down.
    bytes: Range<u32>,
    /// Something else was cut above the zero, and below it.
    above: bool,
    below: bool,
    found: Vec<Found>,
}

remembers!(ContourInAir: bytes, found);

/// A contour in the air, unless the zero is below the part.
#[derive(Clone, PartialEq)]
struct Found {
    finding: Finding,
    /// The tool went as far down as it came up above the zero: further than through a plate.
    is_deep: bool,
}

remembers!(Found: finding);

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
const FEWEST: usize = 4;
/// Findings that are kept.
const MOST: usize = 64;

impl PathRule for ContourInAir {
    fn memory(&mut self) -> Remembers<'_> {
        Remembers::All(self)
    }

    fn moved(&mut self, cx: &PathCx<'_>, event: &Event, _: &mut Report<'_>) {
        // Hardly any block is a plunge: the rest is asked of few.
        let goes_sideways = cx.origin().letters.intersects(SIDEWAYS);
        if goes_sideways && self.step == Step::None {
            self.note(event);
            if matches!(event, Event::Travel(travel) if travel.expanded) {
                cx.rest();
            }
            return;
        }
        if !cx.is_mill() {
            cx.enough();
            return;
        }
        let (kind, programmed, from) = match event {
            Event::Travel(travel) if !travel.expanded || cx.has_effect(Effect::goes_to_machine_place) => {
                (travel.kind, &travel.programmed, &travel.from)
            }
            Event::Arc(arc) if !arc.expanded => (TravelKind::Feed, &arc.programmed, &arc.from),
            // A piece that compensation puts in, or a stroke of a cycle.
            Event::Travel(_) => {
                cx.rest();
                return;
            }
            _ => return,
        };
        let step = std::mem::take(&mut self.step);
        let is_left = |level: f64| {
            kind == TravelKind::Rapid || !goes_sideways && programmed.raw(Axis::Z) > level + SLACK
        };
        if let Step::Up { depth, level, pieces } = step
            && is_left(level)
            && pieces >= FEWEST
            && self.found.len() < MOST
        {
            let finding = finding(cx, depth, self.bytes.clone(), level, pieces);
            self.found.push(Found { finding, is_deep: -depth >= level });
        }
        if kind == TravelKind::Rapid {
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
            _ => {
                if goes_sideways {
                    self.note(event);
                }
                Step::None
            }
        };
    }

    fn followed(&mut self, _: &FollowedCx<'_>, report: &mut Report<'_>) {
        let found = std::mem::take(&mut self.found);
        for found in found.into_iter().filter(|found| !self.above && (found.is_deep || self.below)) {
            report.add(found.finding);
        }
    }
}

impl ContourInAir {
    /// A cut sideways that is not of the pattern. Above the zero only a level one counts: ramps lead in and out.
    fn note(&mut self, event: &Event) {
        let [from, to] = match event {
            Event::Travel(travel) if travel.kind == TravelKind::Feed && !travel.expanded => {
                [&travel.from, &travel.to]
            }
            Event::Arc(arc) if !arc.expanded => [&arc.from, &arc.to],
            _ => return,
        };
        let [from, to] = [from, to].map(|at| at.raw(Axis::Z));
        self.above |= to > SLACK && (to - from).abs() < SLACK;
        self.below |= to < -SLACK;
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
            "G21 G90 G54 G0 X0. Y0. S6000 M3\nG43 H2 Z5.\nG1 Z-1. F200.\nZ1.\nX5.\nZ-1.\nZ1.\nX10. Y5.\nX20.\nY8.\nG0 Z5.\nM30\n",
            &expect![[""]],
        );
    }

    fn frame(down: &str, before: &str, end: &str) -> String {
        format!(
            "G21 G90 G54 G0 X0. Y0. S6000 M3\nG43 H2 Z25.\n{before}{down}X40. F400.\nY40.\nX0.\nY0.\n{end}\nM30\n"
        )
    }

    #[test]
    fn zero_on_the_table() {
        // A plate of 6 mm: a hole through it, then a first layer at half of its height.
        check_rule(&RULE, "haas-mill", &frame("G1 Z-0.2 F100.\nZ3.\n", "", "G0 Z25."), &expect![[""]]);
        let layer = "G1 Z4. F100.\nX10. F400.\nG0 Z25.\nX0.\n";
        check_rule(&RULE, "haas-mill", &frame("G1 Z-5. F100.\nZ3.\n", layer, "G0 Z25."), &expect![[""]]);
    }

    #[test]
    fn ramps_and_cycles_are_not_cuts_above_the_zero() {
        let found = expect![[r#"
            3 | G1 Z-5. F100.
              | ^^^^^^^^^^^^^ warning[contour-in-air] the tool is fed down and up again before the contour
        "#]];
        let down = "G1 Z-5. F100.\nZ2.\n";
        check_rule(
            &RULE,
            "haas-mill",
            &frame(down, "", "G0 Z25.\nG85 X60. Y60. Z-5. R2. F100.\nG80"),
            &found,
        );
        check_rule(
            &RULE,
            "haas-mill",
            &frame(down, "", "G0 Z25.\nX60.\nZ2.\nG1 Z-1.\nX85. Z3.\nG0 Z25."),
            &found,
        );
    }

    #[test]
    fn a_way_round_a_clamp_to_the_next_hole() {
        let program = "G21 G90 G54 G0 X0. Y0. S6000 M3\nG43 H2 Z25.\nG1 Z-5. F100.\nZ2.\nX10.\nY40.\nX40.\nY20.\nZ-5.\nZ2.\nG0 Z25.\nM30\n";
        check_rule(&RULE, "haas-mill", program, &expect![[""]]);
    }

    #[test]
    fn left_home_or_at_feed() {
        let found = expect![[r#"
            3 | G1 Z-5. F100.
              | ^^^^^^^^^^^^^ warning[contour-in-air] the tool is fed down and up again before the contour
        "#]];
        check_rule(&RULE, "haas-mill", &frame("G1 Z-5. F100.\nZ2.\n", "", "G1 Z25."), &found);
        check_rule(&RULE, "haas-mill", &frame("G1 Z-5. F100.\nZ2.\n", "", "G28 G91 Z0."), &found);
    }
}
