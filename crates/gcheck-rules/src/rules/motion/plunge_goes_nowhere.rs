//! A feed move down to where the tool already is.

use std::ops::Range;

use gcheck_controls::{Letter, LetterSet};
use gcheck_engine::{Axis, Event, Position, Travel, TravelKind};
use gcheck_geometry::{Mm, Plane};

use crate::declare::declare_rule;
use crate::facts::cuts::{LEVEL, SURFACE, distance, point};
use crate::{Finding, FollowedCx, PathCx, PathRule, Report, Run, Severity, Watch};
use crate::{Remembers, remembers};

declare_rule! {
    /// A rapid move ends below the zero of the part, and the feed move in Z after it does not go down: the tool is
    /// already at that depth, or deeper.
    ///
    /// So is a feed move in Z to the depth at which the tool has just come across at feed, if the tool is elsewhere fed down to this depth at
    /// two or more places, from above the part, and never was at this place: the retract and its `G0` are missing.
    ///
    /// A program that does so more than twice does it on purpose, and is not reported.
    ///
    /// ## Why it matters
    /// The tool should enter the part at feed, and it entered at rapid: the clearance height before it has a wrong
    /// minus sign, or the retract before it is missing and the tool came sideways through the part.
    ///
    /// ## Reported
    /// ```nc,reported,haas-mill
    /// G21 G90 G54 G0 X10. Y10.
    /// G43 H1 Z-2.
    /// G1 Z-2. F100.
    /// X40.
    /// G0 Z5.
    /// M30
    /// ```
    /// ```nc,reported,haas-mill
    /// G21 G90 G54 G0 X10. Y10.
    /// G43 H1 Z2.
    /// G1 Z-2. F100.
    /// X40.
    /// G0 X60.
    /// G1 Z-2.
    /// X80.
    /// G0 Z5.
    /// M30
    /// ```
    /// ## Not reported
    /// ```nc,quiet,haas-mill
    /// G21 G90 G54 G0 X10. Y10.
    /// G43 H1 Z2.
    /// G1 Z-2. F100.
    /// X40.
    /// G0 Z2.
    /// X30.
    /// Z-1.9
    /// G1 Z-4.
    /// G0 Z5.
    /// M30
    /// ```
    /// A cutter that feeds up from below.
    /// ```nc,quiet,haas-mill
    /// G21 G90 G54 G0 X10. Y10.
    /// G43 H1 Z2.
    /// Z-30.
    /// G1 Z-25. F100.
    /// G0 Z-30.
    /// Z5.
    /// M30
    /// ```
    rule "plunge-goes-nowhere" in "motion" {
        summary: "feed move down, but the tool is already as deep",
        severity: Warning,
        tier: Path,
        since: "0.1.0",
        run: Run::Path {
            watch: Watch::MOVES.union(Watch::CHANGES).union(Watch::FOLLOWED),
            make: || Box::new(PlungeGoesNowhere::default()),
        },
    }
}

#[derive(Default, Clone, PartialEq)]
struct PlungeGoesNowhere {
    /// What the move before was.
    before: Option<Before>,
    /// What was found, in text order.
    found: Vec<Finding>,
    /// Where the tool is fed straight down, to which level, up to [`PLACES`].
    plunges: Vec<[f64; 3]>,
    /// Feed moves down to where the tool is, after a cut sideways, with their level.
    across: Vec<(f64, Finding)>,
}

remembers!(PlungeGoesNowhere: before, found, across);

#[derive(Clone, PartialEq)]
struct Before {
    way: Way,
    /// Where it ended.
    z: f64,
    /// The block of the rapid move.
    bytes: Range<u32>,
    /// A cut went along X and Y at once: not to the next row of a surface.
    is_slanting: bool,
}

remembers!(Before: bytes);

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Way {
    /// A cut.
    Cut,
    /// Down at rapid.
    Down,
    /// Sideways at rapid, from a cut at the same depth.
    Along,
    /// Up at feed, after a rapid move sideways.
    Up,
}

/// Programs that do it more often do so on purpose: a cutter that is fed up step by step.
const MOST: usize = 2;
/// So many other places at which the tool is fed down to a depth make a habit.
const HABIT: usize = 2;
/// A program that feeds down at more places comes from a system.
const PLACES: usize = 200;
/// Places that are nearer than this are one: millimetres.
const NEAR: f64 = 1.0;
/// Clearance heights are no higher: millimetres. Cutters that are fed up from below begin deeper.
const CLEARANCE: f64 = 5.1;

impl PathRule for PlungeGoesNowhere {
    fn memory(&mut self) -> Remembers<'_> {
        Remembers::All(self)
    }

    fn changed(&mut self, _: &PathCx<'_>, event: &Event, _: &mut Report<'_>) {
        // The machine decides where the change leaves the tool.
        if matches!(event, Event::ToolChange(_)) {
            self.before = None;
        }
    }

    fn moved(&mut self, cx: &PathCx<'_>, event: &Event, _: &mut Report<'_>) {
        if !cx.is_mill() {
            cx.enough();
            return;
        }
        let before = self.before.take();
        // There a program may turn: Z is not a depth.
        if cx.state().plane(cx.model) == Some(Plane::Zx) {
            return;
        }
        let z_of = |position: &Position| position.get(Axis::Z);
        match event {
            Event::Travel(travel) if travel.expanded => cx.rest(),
            Event::Travel(travel) if travel.kind == TravelKind::Rapid => {
                self.before = rapid(cx, before, z_of(&travel.from), z_of(&travel.programmed));
            }
            Event::Travel(travel) if travel.kind == TravelKind::Feed => {
                let z = z_of(&travel.programmed);
                self.before = z.filter(|z| *z < SURFACE).map(|z| cut(cx, z, is_slanting(travel)));
                let letters = cx.origin().letters;
                let is_straight =
                    letters.contains(Letter::of('Z')) && !letters.intersects(LetterSet::of("XYUVABC"));
                if is_straight && let Some([x, y, z]) = point(&travel.programmed) {
                    self.straight(cx, before.as_ref(), [x, y, z], travel.from.get(Axis::Z));
                }
                if let (Some(before), Some(z)) = (before.filter(|_| is_straight), z) {
                    self.plunge(cx, before, z);
                }
            }
            Event::Arc(arc) if !arc.expanded => {
                self.before = z_of(&arc.programmed).filter(|z| *z < SURFACE).map(|z| cut(cx, z, false));
            }
            _ => {}
        }
    }

    fn followed(&mut self, _: &FollowedCx<'_>, report: &mut Report<'_>) {
        let found = std::mem::take(&mut self.found);
        if found.len() <= MOST {
            for finding in found {
                report.add(finding);
            }
        }
        let across = std::mem::take(&mut self.across);
        let is_habit = across.len() > MOST;
        for (level, finding) in across.into_iter().filter(|_| !is_habit) {
            let others = self.plunges.iter().filter(|[_, _, z]| (z - level).abs() < LEVEL).count();
            if others >= HABIT && self.plunges.len() < PLACES {
                report.add(finding);
            }
        }
    }
}

fn cut(cx: &PathCx<'_>, z: f64, is_slanting: bool) -> Before {
    Before { way: Way::Cut, z, bytes: cx.range(), is_slanting }
}

/// Does a move go along X and along Y?
fn is_slanting(travel: &Travel) -> bool {
    [Axis::X, Axis::Y].into_iter().all(|axis| (travel.to.raw(axis) - travel.from.raw(axis)).abs() > NEAR)
}

/// What a rapid move is for the feed move after it.
fn rapid(cx: &PathCx<'_>, before: Option<Before>, from: Option<f64>, to: Option<f64>) -> Option<Before> {
    let to = to.filter(|z| *z < SURFACE)?;
    let is_level = before.as_ref().is_some_and(|before| (before.z - to).abs() < LEVEL);
    match before {
        Some(before) if is_level && before.way == Way::Cut => {
            Some(Before { way: Way::Along, z: to, bytes: cx.range(), is_slanting: false })
        }
        Some(before) if is_level && before.way != Way::Up => Some(before),
        // From an unknown height, a tool comes from above.
        _ => {
            let is_down =
                cx.origin().letters.contains(Letter::of('Z')) && from.is_none_or(|from| from >= 0.0);
            is_down.then(|| Before { way: Way::Down, z: to, bytes: cx.range(), is_slanting: false })
        }
    }
}

impl PlungeGoesNowhere {
    /// A feed move in Z alone, to this place.
    fn straight(&mut self, cx: &PathCx<'_>, before: Option<&Before>, to: [f64; 3], from: Option<f64>) {
        let [x, y, z] = to;
        let is_known = cx.is_certain() && self.plunges.len() < PLACES;
        if !is_known || z >= SURFACE {
            return;
        }
        if from.is_some_and(|from| from > SURFACE) {
            self.plunges.push(to);
            return;
        }
        let is_new = self.plunges.iter().all(|[own_x, own_y, _]| distance([x, y], [*own_x, *own_y]) > NEAR);
        let came_across = before
            .filter(|before| before.way == Way::Cut && before.is_slanting && (before.z - z).abs() < LEVEL);
        let is_here = |before: &&Before| {
            before.bytes != cx.range() && from.is_some_and(|from| (from - z).abs() < LEVEL)
        };
        if let Some(before) = came_across.filter(is_here).filter(|_| is_new && self.across.len() <= MOST) {
            let finding = cx
                .finding(&META, cx.range(), "feed move down to where the tool already is, at a new place")
                .label(format!(
                    "the tool is {} below the zero of the part, and was not lifted",
                    cx.shown(Mm(-z))
                ))
                .also(before.bytes.clone(), "the tool comes across here at feed")
                .help("retract the tool before it goes to this place, and go there at rapid (`G0`)");
            self.across.push((z, finding));
        }
    }

    /// A feed move in Z alone.
    fn plunge(&mut self, cx: &PathCx<'_>, before: Before, z: f64) {
        let is_same = (z - before.z).abs() < LEVEL;
        let is_up = z > before.z && !is_same;
        let is_odd = match before.way {
            Way::Cut => false,
            Way::Down => is_same || is_up && z <= 0.0 && before.z >= -CLEARANCE,
            Way::Along if is_up && z > SURFACE => {
                // The next move shows whether the way up was deliberate.
                self.before = Some(Before { way: Way::Up, z, ..before });
                return;
            }
            Way::Along => is_same || is_up,
            Way::Up => z < SURFACE,
        };
        // A loop repeats it.
        let is_known = self.found.iter().any(|finding| finding.range == before.bytes);
        if !is_odd || is_known || self.found.len() > MOST {
            return;
        }
        // A tool that works its way up may be meant.
        let is_step = before.way == Way::Along && is_up;
        let depth = cx.shown(Mm(if before.way == Way::Up { -z } else { -before.z }));
        let (label, next) = match before.way {
            Way::Down => (
                format!("goes down at rapid to {depth} below the zero of the part"),
                "does not go down: the tool is already there",
            ),
            _ => (
                format!("goes sideways {depth} below the zero of the part"),
                "feeds down, but the tool is already as deep",
            ),
        };
        let help = match before.way {
            Way::Down => "check the sign and the height at which the rapid move ends",
            _ => "retract the tool from the part before the rapid move",
        };
        self.found.push(
            cx.finding(&META, before.bytes, "rapid move goes as deep as the feed move after it")
                .label(label)
                .also(cx.range(), next)
                .help(help)
                .at_most(if is_step { Severity::Info } else { Severity::Warning }),
        );
    }
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::check_rule;

    #[test]
    fn the_retract_and_its_rapid_move_are_missing() {
        let slots = |third: &str| {
            format!(
                "G21 G17 G90 G54 G0 X20. Y20. S3000 M3\nG43 H1 Z2.\nG1 Z-5. F100.\nX60. F300.\nG0 Z2.\nX20. Y40.\nG1 Z-5. F100.\nX60. F300.\n{third}G1 Z-5. F100.\nX60. F300.\nG0 Z30.\nM30\n"
            )
        };
        check_rule(
            &RULE,
            "fanuc-mill",
            &slots("X20. Y60.\n"),
            &expect![[r#"
            10 | G1 Z-5. F100.
               | ^^^^^^^^^^^^^ warning[plunge-goes-nowhere] feed move down to where the tool already is, at a new place
        "#]],
        );
        // The next row of a surface, with its depth again.
        check_rule(&RULE, "fanuc-mill", &slots("Y60.\n"), &expect![[""]]);
        // Again from the place where it was fed down, deeper, and after a retract.
        for third in ["X20. Y40.\n", "G0 Z2.\nX20. Y60.\n", ""] {
            let text = slots(third).replace("X60. F300.\nG1 Z-5.", "X60. F300.\nG1 Z-6.");
            check_rule(&RULE, "fanuc-mill", &text, &expect![[""]]);
        }
        check_rule(
            &RULE,
            "fanuc-mill",
            &slots("X20. Y60.\n").replace("Z2.\nX20. Y40.\nG1 Z-5.", "Z2.\nX20. Y40.\nG1 Z-9."),
            &expect![[""]],
        );
    }

    #[test]
    fn a_minus_sign_too_many() {
        check_rule(
            &RULE,
            "fanuc-mill",
            "G21 G90 G54 G0 X0. Y0. Z50.\nZ-2.\nG1 Z-1. F90.\nX9.\nG0 Z50.\nX20.\nZ-2.\nG1 Z-5.\nG0 Z50.\nM30\n",
            &expect![[r#"
                2 | Z-2.
                  | ^^^^ warning[plunge-goes-nowhere] rapid move goes as deep as the feed move after it
            "#]],
        );
    }

    #[test]
    fn a_retract_that_is_missing() {
        check_rule(
            &RULE,
            "linuxcnc",
            "G21 G90 G54 G0 X0 Y0 Z5\nG1 Z-2 F90\nX9\nG0 X20\nY5\nG1 Z-1\nX30\nG0 X40\nG1 Z5\nZ-2\nG0 Z5\nM2\n",
            &expect![[r#"
                4 | G0 X20
                  | ^^^^^^ info[plunge-goes-nowhere] rapid move goes as deep as the feed move after it
                8 | G0 X40
                  | ^^^^^^ warning[plunge-goes-nowhere] rapid move goes as deep as the feed move after it
            "#]],
        );
    }

    #[test]
    fn steps_from_below_are_cut_on_purpose() {
        let steps = |count: usize| {
            let step = |n: usize| format!("G0 X60.\nG1 Z-{}.\nX45.\n", 50 - n);
            let steps: String = (1..=count).map(step).collect();
            format!("G21 G90 G54 G0 X60. Y0. Z5.\nZ-50.\nG1 X45. F90.\n{steps}G0 X60.\nZ5.\nM30\n")
        };
        check_rule(
            &RULE,
            "fanuc-mill",
            &steps(1),
            &expect![[r#"
            4 | G0 X60.
              | ^^^^^^^ info[plunge-goes-nowhere] rapid move goes as deep as the feed move after it
        "#]],
        );
        check_rule(&RULE, "fanuc-mill", &steps(3), &expect![[""]]);
    }

    #[test]
    fn a_tool_change_lifts_the_tool() {
        check_rule(
            &RULE,
            "haas-mill",
            "G21 G90 G54 G0 X0. Y0. Z5.\nG1 Z-2. F90.\nX9.\nT2 M6\nG0 X20.\nG1 Z-2.\nG0 Z5.\nM30\n",
            &expect![[""]],
        );
    }

    #[test]
    fn a_tool_that_leaves_the_part_sideways_and_is_fed_up() {
        check_rule(
            &RULE,
            "linuxcnc",
            "G21 G90 G54 G0 X0 Y0 Z5\nG1 Z-2 F90\nX9\nG0 X20\nG1 Z5\nG0 X0\nM2\n",
            &expect![[""]],
        );
    }

    #[test]
    fn a_height_that_nobody_knows_is_not_judged() {
        check_rule(&RULE, "fanuc-mill", "G21 G90 G54 G0 X0. Y0.\nZ#100\nG1 Z-1. F90.\nM30\n", &expect![[""]]);
    }
}
