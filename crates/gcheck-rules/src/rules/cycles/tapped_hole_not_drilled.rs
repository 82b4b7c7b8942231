//! A tap that goes down where nothing is drilled.

use std::ops::Range;

use gcheck_engine::{Abstract, At, Axis, Domain, Event, Fact, FeedMode, Position, Role, Travel, TravelKind};
use gcheck_geometry::{Mm, Plane};

use crate::declare::declare_rule;
use crate::facts::compensation::may_be_on;
use crate::facts::cuts::distance;
use crate::facts::cycles::is_tapping;
use crate::{Finding, FollowedCx, PathCx, PathRule, Report, Run, Uses, Watch};
use crate::{Remembers, remembers};

declare_rule! {
    /// A tapping cycle goes down at a point where the program has drilled no hole, and drills the other holes that the
    /// same tool taps. Or it taps a pattern of holes that is drilled in another place: turned, mirrored or shifted.
    ///
    /// A hole counts as drilled if a cycle, a straight move down, or a circle around its centre went at least half as
    /// deep there. A program that drills none of the holes is quiet: they are prepared. A program that drills the first of them
    /// and fewer than half is reported once.
    ///
    /// A tap that goes deeper than a cycle has drilled there, by more than four pitches, is reported too. With less, it may
    /// run out of a through hole.
    ///
    /// ## Why it matters
    /// The tap goes into solid metal and breaks. Often digits of a coordinate are swapped, or one point is missing in the
    /// list of the drill.
    ///
    /// ## Reported
    /// ```nc,reported,haas-mill
    /// G21 G90 G54 G0 X10. Y10.
    /// G43 H1 Z20.
    /// G83 Z-15. R3. Q3. F100.
    /// X40.
    /// X70.
    /// G80
    /// T2 M6
    /// S400 M3
    /// G0 X10. Y10.
    /// G43 H2 Z20.
    /// G84 Z-12. R5. F400.
    /// X40.
    /// X79.
    /// G80
    /// M30
    /// ```
    /// ## Not reported
    /// ```nc,quiet,haas-mill
    /// G21 G90 G54 G0 X10. Y10.
    /// G43 H1 Z20.
    /// G83 Z-15. R3. Q3. F100.
    /// X40.
    /// X70.
    /// G80
    /// T2 M6
    /// S400 M3
    /// G0 X10. Y10.
    /// G43 H2 Z20.
    /// G84 Z-12. R5. F400.
    /// X40.
    /// X70.
    /// G80
    /// M30
    /// ```
    rule "tapped-hole-not-drilled" in "cycles" {
        summary: "tapping cycle where the program drills no hole, or a shorter one",
        severity: Warning,
        tier: Path,
        since: "0.1.0",
        run: Run::Path {
            watch: Watch::MOVES.union(Watch::FOLLOWED),
            make: || Box::new(TappedHoleNotDrilled::default()),
        },
    }
}

#[derive(Default, Clone, PartialEq)]
struct TappedHoleNotDrilled {
    holes: Vec<Hole>,
    taps: Vec<Tap>,
    /// Cycles that tap deeper than their holes are drilled, by the block that began each.
    short: Vec<(Option<At>, Finding)>,
    /// Something went down at a place that is not known.
    is_blind: bool,
}

remembers!(TappedHoleNotDrilled: holes, taps, short);

/// Where coordinates count from, and how the part is turned to the tool.
type Frame = (u16, Plane, [u64; 3]);

/// A place where the part is open.
#[derive(Clone, PartialEq)]
struct Hole {
    frame: Frame,
    at: [f64; 2],
    /// The lowest level.
    bottom: f64,
    /// Where its tool was put in.
    tool: Option<At>,
    is_cycle: bool,
    bytes: Range<u32>,
}

remembers!(Hole: tool, bytes);

/// A stroke of a tapping cycle.
#[derive(Clone, PartialEq)]
struct Tap {
    frame: Frame,
    at: [f64; 2],
    tool: Option<At>,
    /// At least so deep must the hole be.
    enough: f64,
    /// In a hole that a cycle drilled.
    is_drilled: bool,
    /// Without a hole.
    missed: Option<Finding>,
}

remembers!(Tap: tool, missed);

/// Points that are nearer than this are one: millimetres.
const NEAR: f64 = 0.1;
/// Programs with more holes come from a system that takes the points of drill and tap from one model.
const MOST: usize = 3000;
/// A tap may run out of a through hole by its chamfer, less the tip of the drill: pitches.
const CHAMFER: f64 = 4.0;
/// A pattern of fewer holes may agree with another one by chance.
const PATTERN: usize = 3;

impl PathRule for TappedHoleNotDrilled {
    fn memory(&mut self) -> Remembers<'_> {
        Remembers::All(self)
    }

    fn concerns(&self, program: &Uses<'_>) -> bool {
        program.may(is_tapping) && program.environment.control().machine() == gcheck_controls::Machine::Mill
    }

    fn moved(&mut self, cx: &PathCx<'_>, event: &Event, _: &mut Report<'_>) {
        if self.holes.len() + self.taps.len() > MOST || cx.is_after_unknown_program() {
            self.is_blind = true;
        }
        if self.is_blind {
            *self = Self { is_blind: true, ..Self::default() };
            cx.enough();
            return;
        }
        match event {
            Event::Travel(travel) if travel.kind == TravelKind::Feed => self.fed(cx, travel),
            Event::Arc(arc) => {
                let Some(frame) = frame(cx, &arc.to) else { return };
                let (plane, shift) = (arc.plane, shift(cx, arc.plane));
                let levels = [&arc.from, &arc.to].map(|end| local(plane, end)[2]);
                let at = [arc.centre.0.0 + shift[0], arc.centre.1.0 + shift[1]];
                // Cutter compensation with an unknown offset: mostly a contour.
                if at.iter().any(|coordinate| coordinate.is_nan()) {
                    return;
                }
                self.open(cx, frame, at, levels[0].min(levels[1]) + shift[2], false);
            }
            _ => {}
        }
    }

    fn followed(&mut self, _: &FollowedCx<'_>, report: &mut Report<'_>) {
        for (_, finding) in std::mem::take(&mut self.short) {
            report.add(finding);
        }
        let mut tools: Vec<Option<At>> = self.taps.iter().map(|tap| tap.tool).collect();
        tools.dedup();
        tools.sort_unstable();
        tools.dedup();
        for tool in tools {
            self.judge(tool, report);
        }
    }
}

impl TappedHoleNotDrilled {
    /// A cut along a straight line.
    fn fed(&mut self, cx: &PathCx<'_>, travel: &Travel) {
        let Some(plane) = cx.state().plane(cx.model) else { return };
        let (from, to, shift) = (local(plane, &travel.from), local(plane, &travel.to), shift(cx, plane));
        let cycle = cx.state().active_cycle(cx.model).filter(|code| code.is_some() && travel.expanded);
        let taps = cycle.is_some_and(|code| is_tapping(cx.model.effect(code)));
        // An unknown cutter offset hides where a contour is, and a contour opens no hole.
        if may_be_on(cx) && to.iter().any(|coordinate| coordinate.is_nan()) {
            return;
        }
        // A cut to the side opens no hole.
        let is_aside = distance([from[0], from[1]], [to[0], to[1]]) > NEAR;
        if is_aside || to[2] >= from[2] {
            return;
        }
        let Some(frame) = frame(cx, &travel.to) else {
            self.is_blind = true;
            return;
        };
        let (at, bottom) = ([to[0] + shift[0], to[1] + shift[1]], to[2] + shift[2]);
        if taps {
            self.tap(cx, frame, at, [from[2] + shift[2], bottom]);
        } else {
            self.open(cx, frame, at, bottom, travel.expanded);
        }
    }

    fn open(&mut self, cx: &PathCx<'_>, frame: Frame, at: [f64; 2], bottom: f64, is_cycle: bool) {
        if at.iter().any(|coordinate| coordinate.is_nan()) {
            self.is_blind = true;
            return;
        }
        let tool = cx.definitions().set_by(Fact::Tool);
        // Pecks go down again and again.
        if let Some(last) = self.holes.last_mut()
            && last.frame == frame
            && last.tool == tool
            && last.is_cycle == is_cycle
            && distance(last.at, at) < f64::EPSILON
        {
            last.bottom = last.bottom.min(bottom);
            return;
        }
        self.holes.push(Hole { frame, at, bottom, tool, is_cycle, bytes: cx.range() });
    }

    fn tap(&mut self, cx: &PathCx<'_>, frame: Frame, at: [f64; 2], [top, bottom]: [f64; 2]) {
        // An uncertain place proves nothing, neither for nor against.
        if !cx.is_on_every_path() || at.iter().any(|coordinate| coordinate.is_nan()) {
            self.is_blind = true;
            return;
        }
        let enough = f64::midpoint(top, bottom);
        let near = |hole: &&Hole| hole.frame == frame && (hole.bottom.is_nan() || hole.bottom <= enough);
        let nearest = self.holes.iter().filter(near).min_by(|a, b| {
            let (a, b) = (distance(a.at, at), distance(b.at, at));
            a.total_cmp(&b)
        });
        let tool = cx.definitions().set_by(Fact::Tool);
        let is_drilled = nearest.is_some_and(|hole| hole.is_cycle && distance(hole.at, at) <= NEAR);
        let missed = match nearest {
            Some(hole) if distance(hole.at, at) <= NEAR => {
                self.below(cx, frame, at, bottom);
                None
            }
            // A place where a cutter went down to mill was not meant for this tap.
            _ => {
                let drilled = self.holes.iter().filter(near).filter(|hole| hole.is_cycle);
                let away = |hole: &&Hole| distance(hole.at, at);
                Some(finding(cx, drilled.min_by(|a, b| away(a).total_cmp(&away(b))), at))
            }
        };
        // A loop or a call taps it again.
        let is_again = |tap: &Tap| tap.frame == frame && tap.tool == tool && distance(tap.at, at) <= NEAR;
        if !self.taps.iter().any(is_again) {
            self.taps.push(Tap { frame, at, tool, enough, is_drilled, missed });
        }
    }

    /// A tap in a drilled hole, which may be too short for it.
    fn below(&mut self, cx: &PathCx<'_>, frame: Frame, at: [f64; 2], bottom: f64) {
        let holes = || self.holes.iter().filter(|hole| hole.frame == frame && distance(hole.at, at) <= NEAR);
        // A NaN is a hole of unknown depth.
        if holes().any(|hole| !hole.is_cycle || hole.bottom.is_nan()) {
            return;
        }
        let Some(hole) = holes().min_by(|a, b| a.bottom.total_cmp(&b.bottom)) else { return };
        let Some(pitch) = pitch(cx).filter(|pitch| hole.bottom - bottom > CHAMFER * pitch) else { return };
        let series = cx.definitions().set_by(Fact::Mode(Role::Cycle));
        if self.short.iter().any(|(own, _)| *own == series) {
            return;
        }
        let short = cx.shown(Mm(hole.bottom - bottom));
        let finding = cx
            .finding(&META, cx.range(), "the tap goes deeper than the hole is drilled")
            .label(format!("the bottom of the drilled hole is {short} higher"))
            .also(hole.bytes.clone(), "drilled here")
            .note(format!("that is more than {CHAMFER} pitches ({} each)", cx.shown(Mm(pitch))))
            .assuming("the part has no deeper hole there before the program starts")
            .help("drill deeper, or tap less deep");
        self.short.push((series, finding));
    }

    /// What one tool taps.
    fn judge(&mut self, tool: Option<At>, report: &mut Report<'_>) {
        let count = self.taps.iter().filter(|tap| tap.tool == tool).count();
        let missed = self.taps.iter().filter(|tap| tap.tool == tool && tap.missed.is_some()).count();
        let found = count - missed;
        if missed == 0 {
            return;
        }
        if found >= missed {
            let note = format!("the program drills {found} of the {count} holes that this tool taps");
            let taps = self.taps.iter_mut().filter(|tap| tap.tool == tool);
            for finding in taps.filter_map(|tap| tap.missed.take()) {
                report.add(finding.note(note.clone()));
            }
            return;
        }
        let is_displaced = found <= 1 && self.is_displaced(tool);
        // A drill that stops after the first hole; of others, some may be prepared.
        let begins_drilled = self.taps.iter().find(|tap| tap.tool == tool).is_some_and(|tap| tap.is_drilled);
        if is_displaced || begins_drilled {
            let note = if is_displaced {
                format!("a tool drills the same pattern of {count} holes in another place")
            } else {
                format!("the program drills {found} of the {count} holes that this tool taps")
            };
            let first = self.taps.iter_mut().filter(|tap| tap.tool == tool).find_map(|tap| tap.missed.take());
            if let Some(finding) = first {
                report.add(finding.note(note));
            }
        }
    }

    /// Does a tool drill the pattern that another one taps, but turned, mirrored or shifted?
    fn is_displaced(&self, tool: Option<At>) -> bool {
        let taps: Vec<&Tap> = self.taps.iter().filter(|tap| tap.tool == tool).collect();
        let Some(first) = taps.first() else { return false };
        if taps.len() < PATTERN || taps.iter().any(|tap| tap.frame != first.frame) {
            return false;
        }
        let tapped = spread(taps.iter().map(|tap| tap.at));
        let drills = || {
            self.holes
                .iter()
                .filter(|hole| hole.is_cycle && hole.frame == first.frame && hole.bottom <= first.enough)
        };
        let mut tools: Vec<Option<At>> = drills().map(|hole| hole.tool).collect();
        tools.dedup();
        tools.into_iter().any(|tool| {
            let drilled = spread(drills().filter(|hole| hole.tool == tool).map(|hole| hole.at));
            let agree = |(a, b): (&f64, &f64)| (a - b).abs() <= NEAR;
            drilled.len() == tapped.len() && drilled.iter().zip(&tapped).all(agree)
        })
    }
}

/// What the tap goes in a turn, millimetres.
fn pitch(cx: &PathCx<'_>) -> Option<f64> {
    let (state, known) = (cx.state(), |value: &_| Abstract::known(value));
    let feed = known(state.feed()).filter(|feed| *feed > 0.0)?;
    match state.feed_mode(cx.model)? {
        FeedMode::PerRevolution => Some(feed),
        FeedMode::PerMinute => Some(feed / known(state.speed()).filter(|speed| *speed > 0.0)?),
        FeedMode::InverseTime => None,
    }
}

/// Distances of points from their middle, in order.
fn spread(points: impl Iterator<Item = [f64; 2]> + Clone) -> Vec<f64> {
    let count = points.clone().count();
    let sum = points.clone().fold([0.0; 2], |[x, y], at| [x + at[0], y + at[1]]);
    #[expect(clippy::cast_precision_loss, reason = "a few thousand holes at most")]
    let middle = sum.map(|sum| sum / count.max(1) as f64);
    let mut spread: Vec<f64> = points.map(|at| distance(at, middle)).collect();
    spread.sort_by(f64::total_cmp);
    spread
}

/// In the plane's first and second axis, and along its normal.
fn local(plane: Plane, position: &Position) -> [f64; 3] {
    plane.to_local([Axis::X, Axis::Y, Axis::Z].map(|axis| position.raw(axis)))
}

/// The shift of the coordinates, in the plane's axes.
fn shift(cx: &PathCx<'_>, plane: Plane) -> [f64; 3] {
    local(plane, &cx.state().shift())
}

fn frame(cx: &PathCx<'_>, position: &Position) -> Option<Frame> {
    let turned = [Axis::A, Axis::B, Axis::C].map(|axis| position.raw(axis).to_bits());
    Some((cx.state().work()?, cx.state().plane(cx.model)?, turned))
}

/// `drilled` is the nearest hole that a drilling cycle makes, deep enough for the tap.
fn finding(cx: &PathCx<'_>, drilled: Option<&Hole>, at: [f64; 2]) -> Finding {
    let label = match drilled {
        Some(hole) => {
            let away = cx.shown(Mm(distance(hole.at, at)));
            format!("the nearest hole that is drilled before, and so deep, is {away} away")
        }
        None => "no hole of this depth is drilled before".to_owned(),
    };
    let finding = cx
        .finding(&META, cx.range(), "the tap goes down where no hole is drilled")
        .label(label)
        .assuming("the part has no holes there before the program starts")
        .help("give the point of the drilled hole, or drill a hole here first");
    match drilled {
        Some(hole) if hole.bytes != cx.range() => {
            finding.also(hole.bytes.clone(), "the nearest hole that is drilled")
        }
        _ => finding,
    }
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::{World, check_rule, findings, only, words};

    /// Four holes are drilled, then tapped at the points given.
    fn program(drilled: &str, tapped: &str) -> String {
        format!(
            "T1 M6\nG21 G90 G54 G0 X0. Y0.\nG43 H1 Z20.\nG83 Z-15. R3. Q3. F100. L0\n{drilled}G80\nT2 M6\nS400 M3\nG0 X0. Y0.\nG43 H2 Z20.\nG84 Z-12. R5. F400. L0\n{tapped}G80\nM30\n"
        )
    }

    const SQUARE: &str = "X10. Y10.\nX40.\nY40.\nX10.\n";

    #[test]
    fn swapped_digits_miss_the_hole() {
        check_rule(
            &RULE,
            "haas-mill",
            &program(SQUARE, "X10. Y10.\nX40.\nX40. Y04.\nX10. Y40.\n"),
            &expect![[r#"
                17 | X40. Y04.
                   | ^^^^^^^^^ warning[tapped-hole-not-drilled] the tap goes down where no hole is drilled
            "#]],
        );
    }

    #[test]
    fn the_holes_of_the_drill_are_tapped() {
        check_rule(&RULE, "haas-mill", &program(SQUARE, SQUARE), &expect![[""]]);
    }

    #[test]
    fn a_tap_that_is_longer_than_its_hole() {
        let deep = |z: &str| program(SQUARE, SQUARE).replace("Z-12.", z);
        check_rule(
            &RULE,
            "haas-mill",
            &deep("Z-19.5"),
            &expect![[r#"
            15 | X10. Y10.
               | ^^^^^^^^^ warning[tapped-hole-not-drilled] the tap goes deeper than the hole is drilled
        "#]],
        );
        // A through hole: the tap runs out by its chamfer.
        check_rule(&RULE, "haas-mill", &deep("Z-18."), &expect![[""]]);
        let pre = deep("Z-19.5").replace("G83 Z-15.", "G83 Z#500");
        check_rule(&RULE, "haas-mill", &pre, &expect![[""]]);
    }

    #[test]
    fn a_drill_that_stops_after_the_first_hole() {
        check_rule(
            &RULE,
            "haas-mill",
            &program("X10. Y10.\n", SQUARE),
            &expect![[r#"
                13 | X40.
                   | ^^^^ warning[tapped-hole-not-drilled] the tap goes down where no hole is drilled
            "#]],
        );
    }

    #[test]
    fn prepared_holes_are_tapped() {
        check_rule(&RULE, "haas-mill", &program(SQUARE, "X60. Y60.\nX90.\nY70.\nX55.\n"), &expect![[""]]);
        check_rule(&RULE, "haas-mill", &program("", SQUARE), &expect![[""]]);
    }

    #[test]
    fn a_pattern_in_another_place_is_one_finding() {
        check_rule(
            &RULE,
            "haas-mill",
            &program(SQUARE, "X10. Y50.\nX40.\nY80.\nX10.\n"),
            &expect![[r#"
                15 | X10. Y50.
                   | ^^^^^^^^^ warning[tapped-hole-not-drilled] the tap goes down where no hole is drilled
            "#]],
        );
    }

    #[test]
    fn loops_count() {
        let holes = "G0 X50. Y0.\n#100=0\nWHILE [#100 LT 6] DO1\n#101=50.*SIN[#100*60.]\n#102=50.*COS[#100*60.]\nG83 X#101 Y#102 Z-15. R3. Q3. F90.\n#100=#100+1\nEND1\n";
        let taps = "G84 X50. Y0. Z-12. R5. F400.\nX25. Y43.301\nX-25.\nX-50. Y0.\nX-25. Y-43.301\nX25.\n";
        check_rule(
            &RULE,
            "fanuc-mill",
            &program(holes, taps),
            &expect![[r#"
            19 | G84 X50. Y0. Z-12. R5. F400.
               | ^^^^^^^^^^^^^^^^^^^^^^^^^^^^ warning[tapped-hole-not-drilled] the tap goes down where no hole is drilled
        "#]],
        );
        let right = holes.replace("SIN", "TAN").replace("COS", "SIN").replace("TAN", "COS");
        check_rule(&RULE, "fanuc-mill", &program(&right, taps), &expect![[""]]);
    }

    #[test]
    fn a_spot_is_not_a_hole() {
        let spots = "G81 Z-1. R3. F90. L0\nX40. Y10.\n";
        check_rule(
            &RULE,
            "haas-mill",
            &program(&format!("X10. Y10.\n{spots}"), "X10. Y10.\nX40.\n"),
            &expect![[r#"
                15 | X40.
                   | ^^^^ warning[tapped-hole-not-drilled] the tap goes down where no hole is drilled
            "#]],
        );
    }

    #[test]
    fn a_distance_is_that_to_a_hole_that_is_drilled() {
        let milled = "X10. Y10.\nG80\nG0 X41. Y10.\nG1 Z-14. F90.\nG0 Z20.\n";
        let found =
            findings(&only(&RULE), "haas-mill", &program(milled, "X10. Y10.\nX40.\n"), &World::default());
        expect![[r#"
            the tap goes down where no hole is drilled
              here: the nearest hole that is drilled before, and so deep, is 30 mm away
              there: the nearest hole that is drilled
              note: the program drills 1 of the 2 holes that this tool taps
              assuming: the part has no holes there before the program starts
              help: give the point of the drilled hole, or drill a hole here first
        "#]]
        .assert_eq(&found.iter().map(words).collect::<String>());
    }

    #[test]
    fn milled_and_shifted_holes_are_open() {
        let milled = "X10. Y10.\nG80\nG0 X40. Y10.\nG1 X42. Z-14. F90.\nG3 I-2.\nG0 Z20.\n";
        check_rule(&RULE, "haas-mill", &program(milled, "X10. Y10.\nX40.\n"), &expect![[""]]);
        let shifted = "X10. Y10.\nG80\nG52 X30.\nG83 X10. Z-15. R3. Q3. F100.\nG80\nG52 X0.\n";
        check_rule(&RULE, "haas-mill", &program(shifted, "X10. Y10.\nX40.\n"), &expect![[""]]);
    }

    #[test]
    fn a_contour_with_an_unknown_cutter_hides_no_hole() {
        let contour =
            "X10. Y10.\nG80\nG0 X0. Y0.\nG1 Z-8. F90.\nG41 D1 X30.\nG3 I-30.\nG40 G1 X0.\nG0 Z20.\n";
        check_rule(
            &RULE,
            "fanuc-mill",
            &program(contour, "X10. Y10.\nX40.\n"),
            &expect![[r#"
            20 | X40.
               | ^^^^ warning[tapped-hole-not-drilled] the tap goes down where no hole is drilled
        "#]],
        );
    }

    #[test]
    fn a_hole_at_a_point_that_nobody_knows() {
        check_rule(&RULE, "haas-mill", &program("X10. Y10.\nX#500\n", "X10. Y10.\nX40.\n"), &expect![[""]]);
    }
}
