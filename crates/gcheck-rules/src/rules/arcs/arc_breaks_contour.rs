//! An arc that bulges to the wrong side of an otherwise smooth contour.

use std::ops::Range;

use gcheck_controls::Effect;
use gcheck_engine::{ArcMove, Axis, Ending, Event, Position, TravelKind};
use gcheck_geometry::{ArcDirection, Plane};

use crate::declare::declare_rule;
use crate::facts::arcs::by_its_words;
use crate::{Finding, PathCx, PathRule, Report, Run, Severity, Uses, Watch};
use crate::{Remembers, remembers};

declare_rule! {
    /// An arc meets the cuts before and after it at an angle, and the same arc the other way round, or with the other sign of
    /// `R`, would go on smoothly from both. Or an arc that is made to round a corner begins or ends in the corner itself.
    ///
    /// ## Why it matters
    /// `G2` and `G3` are mixed up, `R` has a wrong sign, or a point is wrong: the tool cuts into the part where the corner
    /// should be rounded, goes around the outside of it, or leaves it sharp.
    ///
    /// ## Reported
    /// ```nc,reported,fanuc-mill
    /// G21 G17 G90 G54 S3000 M3
    /// G0 X0. Y0. Z-2.
    /// G1 X40. F300.
    /// G2 X50. Y10. R10.
    /// G1 Y40.
    /// G0 Z50.
    /// M30
    /// ```
    /// ```nc,reported,linuxcnc
    /// G21 G17 G90 G54 G94 S3000 M3
    /// G0 X0 Y0 Z-2
    /// G1 X40 F300
    /// G3 X50 Y10 R-10
    /// G1 Y40
    /// G0 Z50
    /// M2
    /// ```
    /// ```nc,reported,haas-mill
    /// G21 G17 G90 G54 S3000 M3
    /// G0 X0. Y0. Z-2.
    /// G1 Y50. F300.
    /// G2 X10. Y50. R10.
    /// G1 X60.
    /// G0 Z50.
    /// M30
    /// ```
    /// ## Not reported
    /// ```nc,quiet,fanuc-mill
    /// G21 G17 G90 G54 S3000 M3
    /// G0 X0. Y0. Z-2.
    /// G1 X40. F300.
    /// G3 X50. Y10. R10.
    /// G1 Y40.
    /// G0 Z50.
    /// M30
    /// ```
    /// A notch has corners both ways.
    /// ```nc,quiet,fanuc-mill
    /// G21 G17 G90 G54 S3000 M3
    /// G0 X0. Y0. Z-2.
    /// G1 X40. F300.
    /// G2 X60. Y0. R10.
    /// G1 X100.
    /// G0 Z50.
    /// M30
    /// ```
    rule "arc-breaks-contour" in "arcs" {
        summary: "arc to the wrong side of an otherwise smooth contour",
        severity: Warning,
        tier: Path,
        since: "0.1.0",
        run: Run::Path {
            watch: Watch::MOVES.union(Watch::ENDS),
            make: || Box::new(ArcBreaksContour::default()),
        },
    }
}

/// Directions that differ by less are one: 3 degrees.
const SMOOTH: f64 = 0.052;
/// Directions that differ by more make a corner: 20 degrees.
const CORNER: f64 = 0.349;
/// A shorter way has no direction: millimetres.
const NOTHING: f64 = 1e-4;
/// Lengths that differ by a smaller part are one.
const EQUAL: f64 = 0.01;
/// A shorter cut beside an arc is a step on the way: parts of the arc's chord.
const STEP: f64 = 0.5;

/// X, Y and Z, millimetres, if they are known.
type Place = [Option<f64>; 3];

/// A direction in the plane, in radians; or a point in it, millimetres.
type Vector = [f64; 2];

#[derive(Default, Clone, PartialEq)]
struct ArcBreaksContour {
    /// Where the last move ends as it is programmed, beside a cutter or not.
    at: Option<Place>,
    /// The plane of the last cut, and the cut as it ends.
    last: Option<(Plane, Way)>,
    /// An arc with a corner before it, which the next cut decides.
    pending: Option<Pending>,
    /// Arcs around a corner itself: two words were exchanged, or the cutter makes room for a corner (a dog bone). Room is made in more
    /// than one corner.
    around_corners: Vec<AroundCorner>,
    /// Radii of arcs of less than half a turn, as roundings have them: millimetres.
    roundings: Vec<f64>,
}

remembers!(ArcBreaksContour: pending, around_corners, roundings);

/// An arc of more than half a turn around the point where the cuts beside it meet.
#[derive(Debug, Clone, PartialEq)]
struct AroundCorner {
    /// Its block.
    bytes: Range<u32>,
    /// Millimetres.
    radius: f64,
}

remembers!(AroundCorner: bytes);

/// More corners with room, and more radii of roundings, are not counted.
const MOST_CORNERS: usize = 16;

/// A cut, at one of its ends.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Way {
    /// Its direction there, radians.
    direction: f64,
    /// From its start to its end: millimetres.
    length: f64,
}

impl Way {
    /// Straight from one point to another; `None` where they are one.
    fn between(from: Vector, to: Vector) -> Option<Self> {
        let step = [to[0] - from[0], to[1] - from[1]];
        let length = step[0].hypot(step[1]);
        (length > NOTHING).then(|| Self { direction: step[1].atan2(step[0]), length })
    }

    /// Are both as long, and in one direction?
    fn is_as(self, other: Self) -> bool {
        turn(self.direction, other.direction) < SMOOTH && (self.length / other.length - 1.0).abs() < SMOOTH
    }
}

/// An arc that would go on smoothly from the cut before it in another form.
#[derive(Clone, PartialEq)]
struct Pending {
    /// The block of the arc.
    bytes: Range<u32>,
    /// The arc as it ends.
    end: Way,
    /// The forms that begin smoothly, with their directions where they end.
    others: Vec<(Other, f64)>,
    /// The cut before the arc, the arc's chord, and its radius in millimetres.
    before: Way,
    chord: Way,
    radius: f64,
    /// The cut before the arc came from its centre: the way back there, which makes a sector of a disc.
    back: Option<Way>,
    /// The cut before the arc leads to its centre, and the arc is more than half a turn: the direction from its end to the centre.
    corner: Option<f64>,
    /// Its block gives the centre, not the radius.
    has_centre: bool,
}

remembers!(Pending: bytes);

/// How else the arc may be meant.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Other {
    /// The other way round.
    Way,
    /// The other sign of `R`.
    Sign,
    /// Begun before the corner in which it begins.
    Before,
    /// Ended after the corner in which it ends.
    After,
    /// With its two centre words exchanged.
    Exchanged,
}

impl PathRule for ArcBreaksContour {
    fn memory(&mut self) -> Remembers<'_> {
        Remembers::All(self)
    }

    fn concerns(&self, program: &Uses<'_>) -> bool {
        program.may(Effect::is_arc)
    }

    fn moved(&mut self, cx: &PathCx<'_>, event: &Event, report: &mut Report<'_>) {
        let end = match event {
            Event::Travel(travel) => Some(place(&travel.programmed)),
            Event::Arc(arc) => Some(place(&arc.programmed)),
            _ => None,
        };
        let start = std::mem::replace(&mut self.at, end);
        // A move around a corner of the contour ends where the one before it ends.
        if start.is_some() && start == end && !matches!(event, Event::Arc(arc) if arc.turns.abs() > 1) {
            return;
        }
        let (last, pending) = (self.last.take(), self.pending.take());
        let (Some(start), Some(end)) = (start, end) else { return };
        // Of several paths, this move may follow another one.
        if !cx.is_on_every_path() || cx.is_called_only() {
            return;
        }
        match event {
            Event::Travel(travel) if travel.kind == TravelKind::Feed && !travel.expanded => {
                let plane = last.map(|(plane, _)| plane).or_else(|| cx.state().plane(cx.model));
                let Some((plane, way)) = plane.and_then(|plane| Some((plane, straight(start, end, plane)?)))
                else {
                    return;
                };
                self.last = Some((plane, way));
                self.tell(cx, pending, way, report);
            }
            Event::Arc(arc) if !arc.expanded => {
                let Some(Forms { own: [start, end], spokes, others, chord, is_long }) =
                    Forms::of(cx, arc, start, end)
                else {
                    return;
                };
                let [out, _] = spokes;
                let is_known = |radius: &f64| (radius / out.length - 1.0).abs() < EQUAL;
                if !is_long && self.roundings.len() < MOST_CORNERS && !self.roundings.iter().any(is_known) {
                    self.roundings.push(out.length);
                }
                let way = |direction| Way { direction, length: chord.length };
                self.last = Some((arc.plane, way(end)));
                let Some((_, before)) = last.filter(|(plane, _)| *plane == arc.plane) else { return };
                self.tell(cx, pending, way(start), report);
                if turn(before.direction, start) > CORNER && before.length > chord.length * STEP {
                    let is_smooth =
                        |(_, [start, _]): &(Other, [f64; 2])| turn(before.direction, *start) < SMOOTH;
                    let others = others.into_iter().filter(is_smooth);
                    let others: Vec<_> = others.map(|(other, [_, end])| (other, end)).collect();
                    let [_, back] = spokes;
                    let meets = is_long && is_opposite(before.direction, out.direction);
                    let corner = meets.then_some(back.direction);
                    let back = before.is_as(out).then_some(back);
                    let (bytes, end, radius) = (cx.range(), way(end), out.length);
                    let has_centre = cx.word('R').is_none();
                    self.pending =
                        Some(Pending { bytes, end, others, before, chord, radius, back, corner, has_centre });
                }
            }
            _ => {}
        }
    }

    fn ended(&mut self, cx: &PathCx<'_>, _: Ending, report: &mut Report<'_>) {
        for AroundCorner { bytes, radius } in &self.around_corners {
            let is_alike = |other: &&AroundCorner| (other.radius / radius - 1.0).abs() < EQUAL;
            if self.around_corners.iter().filter(is_alike).count() == 1 {
                let finding = finding(cx, bytes.clone(), Other::Exchanged);
                // Without a rounding like it, it may make room in the one corner that needs it.
                let is_like_others = self.roundings.iter().any(|other| (other / radius - 1.0).abs() < EQUAL);
                report.add(if is_like_others { finding } else { finding.at_most(Severity::Info) });
            }
        }
    }
}

impl ArcBreaksContour {
    /// The arc is reported when one of its other forms goes on smoothly to the next cut, and the arc itself does not.
    fn tell(&mut self, cx: &PathCx<'_>, pending: Option<Pending>, next: Way, report: &mut Report<'_>) {
        let Some(pending) = pending else { return };
        // A radius has no words to exchange.
        if pending.has_centre && pending.corner.is_some_and(|back| is_opposite(back, next.direction)) {
            let Pending { bytes, radius, .. } = pending;
            let is_new = self.around_corners.iter().all(|other| other.bytes != bytes);
            if is_new && self.around_corners.len() < MOST_CORNERS {
                self.around_corners.push(AroundCorner { bytes, radius });
            }
        } else if let Some(other) = meant(&pending, next) {
            report.add(finding(cx, pending.bytes, other));
        }
    }
}

/// Do two directions lead opposite ways?
fn is_opposite(one: f64, other: f64) -> bool {
    turn(one, other) > std::f64::consts::PI - SMOOTH
}

/// The arc, as it is and as it may be meant: its direction at its start and at its end.
struct Forms {
    own: [f64; 2],
    /// From its centre to its start, and from its end to its centre.
    spokes: [Way; 2],
    others: Vec<(Other, [f64; 2])>,
    /// From its start to its end.
    chord: Way,
    /// It is more than half a turn.
    is_long: bool,
}

impl Forms {
    fn of(cx: &PathCx<'_>, arc: &ArcMove, start: Place, end: Place) -> Option<Self> {
        let (start, end) = (point(start, arc.plane)?, point(end, arc.plane)?);
        let way = f64::from(arc.turns.signum());
        // The offset of a cutter of unknown size hides the centre.
        let of_words = || {
            let direction = if arc.turns < 0 { ArcDirection::Cw } else { ArcDirection::Ccw };
            by_its_words(cx, [start, end], direction).filter(|_| arc.plane == Plane::Xy)
        };
        let (centre, sweep) = if arc.centre.0.0.is_finite() && arc.centre.1.0.is_finite() {
            (arc.centre, arc.sweep)
        } else {
            let arc = of_words()?;
            (arc.centre(), arc.sweep())
        };
        let centre = [centre.0.0, centre.1.0];
        let chord = [end[0] - start[0], end[1] - start[1]];
        let straight = Way::between(start, end)?;
        if arc.turns.abs() != 1 {
            return None;
        }
        let directions = |centre: Vector, way: f64| [start, end].map(|at| tangent(at, centre, way));
        let mut others = if cx.word('R').is_some() {
            // The centre on the other side of the chord.
            let mirrored = mirror(centre, start, chord);
            vec![(Other::Way, directions(mirrored, -way)), (Other::Sign, directions(mirrored, way))]
        } else if sweep.abs() > std::f64::consts::PI {
            vec![(Other::Way, directions(centre, -way))]
        } else {
            // A path that comes back on the arc before it would be smooth the long way round.
            Vec::new()
        };
        if cx.word('R').is_none() {
            let exchanged = [start[0] + centre[1] - start[1], start[1] + centre[0] - start[0]];
            let radii = [start, end].map(|at| (at[0] - exchanged[0]).hypot(at[1] - exchanged[1]));
            if (radii[0] / radii[1] - 1.0).abs() < EQUAL {
                others.push((Other::Exchanged, directions(exchanged, way)));
            }
        }
        let spokes = [Way::between(centre, start)?, Way::between(end, centre)?];
        let is_long = sweep.abs() > std::f64::consts::PI;
        Some(Self { own: directions(centre, way), spokes, others, chord: straight, is_long })
    }
}

/// The form of the arc that goes on smoothly to the next cut, where the arc itself does not.
fn meant(pending: &Pending, next: Way) -> Option<Other> {
    if turn(pending.end.direction, next.direction) <= CORNER || next.length <= pending.end.length * STEP {
        return None;
    }
    // From the centre out, along the arc, and back to the centre: a sector has corners.
    if pending.back.is_some_and(|back| next.is_as(back)) {
        return None;
    }
    let is_smooth = |(_, end): &&(Other, f64)| turn(*end, next.direction) < SMOOTH;
    let in_other_form = pending.others.iter().find(is_smooth).map(|(other, _)| *other);
    in_other_form.or_else(|| in_corner(pending.before, pending.chord, pending.radius, next))
}

fn finding(cx: &PathCx<'_>, bytes: Range<u32>, other: Other) -> Finding {
    let (meant, help) = match other {
        Other::Way => ("the other way round", "check `G2` and `G3` of this arc"),
        Other::Sign => {
            ("with the other sign of `R`", "check the sign of `R`: below zero it means the longer arc")
        }
        Other::Exchanged => {
            ("with its centre words exchanged", "check which of the centre words has which value")
        }
        Other::Before => {
            ("begun so far before the corner", "end the block before at the point where the rounding begins")
        }
        Other::After => ("ended so far after the corner", "end the arc at the point where the rounding ends"),
    };
    cx.finding(&META, bytes, "the arc breaks the contour: corners before and after it")
        .label(format!("{meant} it goes on smoothly from the cut before, and to the one after"))
        .help(help)
}

/// An arc whose chord lies on one of two cuts that meet at an angle, and is as long as a rounding of that corner by this radius
/// takes away of each: its other end is the corner itself.
fn in_corner(before: Way, chord: Way, radius: f64, next: Way) -> Option<Other> {
    let corner = turn(before.direction, next.direction);
    let taken = radius * (corner / 2.0).tan();
    if !(CORNER..std::f64::consts::PI - CORNER).contains(&corner)
        || (chord.length / taken - 1.0).abs() > EQUAL
    {
        return None;
    }
    if turn(chord.direction, next.direction) < SMOOTH {
        Some(Other::Before)
    } else if turn(chord.direction, before.direction) < SMOOTH {
        Some(Other::After)
    } else {
        None
    }
}

/// The angle between two directions, from 0 to half a turn; NaN where one is not known.
fn turn(from: f64, to: f64) -> f64 {
    let turn = (to - from).rem_euclid(std::f64::consts::TAU);
    turn.min(std::f64::consts::TAU - turn)
}

/// The direction of an arc at one of its points.
fn tangent(at: Vector, centre: Vector, way: f64) -> f64 {
    let spoke = [at[0] - centre[0], at[1] - centre[1]];
    (spoke[0] * way).atan2(-spoke[1] * way)
}

/// The point mirrored in the line through `start` along `chord`.
fn mirror(centre: Vector, start: Vector, chord: Vector) -> Vector {
    let spoke = [centre[0] - start[0], centre[1] - start[1]];
    let along = (spoke[0] * chord[0] + spoke[1] * chord[1]) / (chord[0] * chord[0] + chord[1] * chord[1]);
    let across = [spoke[0] - along * chord[0], spoke[1] - along * chord[1]];
    [centre[0] - 2.0 * across[0], centre[1] - 2.0 * across[1]]
}

/// A straight cut in the plane; `None` where it does not move in it.
fn straight(from: Place, to: Place, plane: Plane) -> Option<Way> {
    Way::between(point(from, plane)?, point(to, plane)?)
}

fn place(at: &Position) -> Place {
    [Axis::X, Axis::Y, Axis::Z].map(|axis| at.get(axis))
}

/// A point in the plane; `None` where it is not known.
fn point([x, y, z]: Place, plane: Plane) -> Option<Vector> {
    let [across, up] = match plane {
        Plane::Xy => [x, y],
        Plane::Zx => [z, x],
        Plane::Yz => [y, z],
    };
    Some([across?, up?])
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::{World, check_rule, check_rule_in, findings, only, words};

    fn program(moves: &str) -> String {
        format!("G21 G17 G90 G54 S3000 M3\nG0 X0. Y0. Z-2.\n{moves}G0 Z50.\nM30\n")
    }

    #[test]
    fn arcs_to_and_fro_are_meant() {
        check_rule(
            &RULE,
            "fanuc-mill",
            "G21 G19 G90 G94 G54 S3000 M3\nG0 X0. Y6. Z-12.\nG3 X1. Y-12. Z6. J-18. K0. F300.\nG2 X2. Y6. Z-12. J0. K-18.\nG3 X3. Y-12. Z6. J-18. K0.\nG17 G1 Y25.\nG0 Z50.\nM30\n",
            &expect![[""]],
        );
    }

    #[test]
    fn a_rounding_that_ends_in_the_corner() {
        check_rule(
            &RULE,
            "haas-mill",
            &program("G1 Y40. F300.\nG2 X0. Y50. R10.\nG1 X60.\n"),
            &expect![[r#"
                4 | G2 X0. Y50. R10.
                  | ^^^^^^^^^^^^^^^^ warning[arc-breaks-contour] the arc breaks the contour: corners before and after it
            "#]],
        );
        check_rule(
            &RULE,
            "haas-mill",
            &program("G1 Y40. F300.\nG2 X0. Y52. R10.\nG1 X60.\n"),
            &expect![[""]],
        );
    }

    #[test]
    fn a_sector_of_a_disc_has_corners() {
        let sector = |after: &str| program(&format!("G1 Y10. F300.\nX10.\nG3 X0. Y20. R10.\n{after}\n"));
        check_rule(&RULE, "fanuc-mill", &sector("G1 Y10."), &expect![[""]]);
        check_rule(
            &RULE,
            "fanuc-mill",
            &sector("G1 Y-20."),
            &expect![[r#"
                5 | G3 X0. Y20. R10.
                  | ^^^^^^^^^^^^^^^^ warning[arc-breaks-contour] the arc breaks the contour: corners before and after it
            "#]],
        );
    }

    #[test]
    fn beside_a_cutter() {
        for (radius, expected) in [
            (
                "R-10.",
                expect![[r#"
            6 | G2 X10. Y50. R-10.
              | ^^^^^^^^^^^^^^^^^^ warning[arc-breaks-contour] the arc breaks the contour: corners before and after it
        "#]],
            ),
            ("R10.", expect![[""]]),
        ] {
            let program = format!(
                "G21 G17 G90 G94 G54 S3000 M3\nT1 M6\nG0 X-10. Y-10. Z-2.\nG41 D1 G1 X0. Y0. F300.\nY40.\nG2 X10. Y50. {radius}\nG1 X40.\nG40 X60.\nG0 Z50.\nM30\n"
            );
            check_rule_in(&RULE, "fanuc-mill", &program, &World::of_group("machine"), &expected);
        }
    }

    #[test]
    fn beside_a_cutter_of_unknown_size() {
        let around = |first: &str, second: &str| {
            format!(
                "G21 G17 G90 G94 G54 S3000 M3\nG0 X-10. Y-20. Z-2.\nG41 D12 G1 X0. Y-15. F500.\nY60.\n{first}\nG1 X90.\n{second}\nG1 Y10.\nG2 X90. Y0. R10.\nG1 X10.\nG2 X0. Y10. R10.\nG1 Y15.\nG40 X-10.\nG0 Z50.\nM30\n"
            )
        };
        let by_radius = "G2 X100. Y60. R10.";
        check_rule(
            &RULE,
            "fanuc-mill",
            &around("G3 X10. Y70. I10. J0.", by_radius),
            &expect![[r#"
            5 | G3 X10. Y70. I10. J0.
              | ^^^^^^^^^^^^^^^^^^^^^ warning[arc-breaks-contour] the arc breaks the contour: corners before and after it
        "#]],
        );
        check_rule(
            &RULE,
            "fanuc-mill",
            &around("G2 X10. Y70. R10.", "G3 X100. Y60. R10."),
            &expect![[r#"
            7 | G3 X100. Y60. R10.
              | ^^^^^^^^^^^^^^^^^^ warning[arc-breaks-contour] the arc breaks the contour: corners before and after it
        "#]],
        );
        for first in ["G2 X10. Y70. R10.", "G2 X10. Y70. I10. J0."] {
            check_rule(&RULE, "fanuc-mill", &around(first, by_radius), &expect![""]);
        }
    }

    #[test]
    fn by_its_centre_the_arc_comes_back_on_itself() {
        check_rule(
            &RULE,
            "fanuc-mill",
            &program("G1 X40. F300.\nG2 X50. Y10. I0. J10.\nG1 Y40.\n"),
            &expect![[r#"
                4 | G2 X50. Y10. I0. J10.
                  | ^^^^^^^^^^^^^^^^^^^^^ warning[arc-breaks-contour] the arc breaks the contour: corners before and after it
            "#]],
        );
        check_rule(
            &RULE,
            "fanuc-mill",
            &program("G1 X40. F300.\nG3 X50. Y10. I0. J10.\nG1 Y40.\n"),
            &expect![[""]],
        );
    }

    #[test]
    fn with_the_values_of_its_centre_words_exchanged() {
        let found = findings(
            &only(&RULE),
            "haas-mill",
            &program("G1 X50. F300.\nG3 X60. Y10. I10. J0.\nG1 Y50.\n"),
            &World::default(),
        );
        expect![[r#"
            the arc breaks the contour: corners before and after it
              here: with its centre words exchanged it goes on smoothly from the cut before, and to the one after
              help: check which of the centre words has which value
        "#]]
        .assert_eq(&found.iter().map(words).collect::<String>());
        for arc in ["G3 X60. Y10. I0. J10.", "G3 X60. Y10. J10."] {
            let right = program(&format!("G1 X50. F300.\n{arc}\nG1 Y50.\n"));
            check_rule(&RULE, "haas-mill", &right, &expect![[""]]);
        }
        // Two corners with room for what is to fit into them.
        let room = "G1 X50. F300.\nG3 X60. Y10. I10. J0.\nG1 Y40.\nG3 X50. Y50. I0. J10.\nG1 X10.\n";
        check_rule(&RULE, "haas-mill", &program(room), &expect![[""]]);
        // A half round notch across the way has corners both ways.
        check_rule(
            &RULE,
            "haas-mill",
            &program("G1 X50. F300.\nG3 X70. Y0. I10. J0.\nG1 X90.\n"),
            &expect![[""]],
        );
    }

    #[test]
    fn between_arcs() {
        check_rule(
            &RULE,
            "fanuc-mill",
            &program("G1 X40. F300.\nG3 X50. Y10. R10.\nG3 X60. Y20. R10.\nG1 X90.\n"),
            &expect![[r#"
                5 | G3 X60. Y20. R10.
                  | ^^^^^^^^^^^^^^^^^ warning[arc-breaks-contour] the arc breaks the contour: corners before and after it
            "#]],
        );
    }

    #[test]
    fn the_profile_of_a_lathe() {
        check_rule(
            &RULE,
            "fanuc-lathe",
            "G21 G99 G40\nT0101\nG97 S900 M3\nG0 X20. Z2.\nG1 Z-20. F.2\nG3 X30. Z-25. R5.\nG1 X50.\nG0 X150. Z100.\nM30\n",
            &expect![[r#"
                6 | G3 X30. Z-25. R5.
                  | ^^^^^^^^^^^^^^^^^ warning[arc-breaks-contour] the arc breaks the contour: corners before and after it
            "#]],
        );
    }

    #[test]
    fn whole_circles_and_arcs_without_a_cut_after_them_are_not_judged() {
        check_rule(
            &RULE,
            "fanuc-mill",
            &program("G1 X40. F300.\nG2 I0. J10.\nG1 X80.\nG2 X90. Y10. R10.\n"),
            &expect![[""]],
        );
    }
}
