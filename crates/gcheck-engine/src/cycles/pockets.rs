//! Pockets in one block: circular ones as strokes, those of any outline as an estimate.
//!
//! Knows: their geometry in the plane XY. Must not know: where the outline was programmed, offsets by number.
//!
//! Source: Haas Mill Operator's Manual, G12, G13 and G150. The direction in which the half circle into a circular pocket
//! begins is not stated there; here it is +X.

use gcheck_controls::Letter;
use gcheck_geometry::{Mm, MmPerMin, Seconds};

use super::profile::{Cut, cuts, distance};
use super::{CycleError, ProfileSegment, Sink, Stroke, known};
use crate::fault::CycleFault;

/// A circular pocket, cut from its centre outward.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CircularPocket {
    /// Centre, X and Y.
    pub centre: (Mm, Mm),
    /// `I`: radius of the first circle; of the only one without `K`.
    pub first: Mm,
    /// `K`: radius of the finished pocket.
    pub finished: Option<Mm>,
    /// `Q`: how much each circle is larger than the one before.
    pub step: Option<Mm>,
    /// Depth of the first round, as a level.
    pub depth: Mm,
    /// How much deeper each further round goes (`Z` under `G91`).
    pub deeper: Mm,
    /// `L`: rounds.
    pub rounds: u32,
    /// Radius of the tool; 0 programs its centre.
    pub tool_radius: Mm,
    /// Clockwise, else counter-clockwise.
    pub clockwise: bool,
}

/// The strokes of [`CircularPocket`]. Ends at the centre at full depth.
///
/// # Errors
///
/// The first radius must exceed the tool's, the finished one the first; `K` and `Q` go together; `Q` must be positive.
pub fn circular_pocket(
    from: [Mm; 3],
    words: &CircularPocket,
    out: &mut dyn FnMut(Stroke),
) -> Result<[Mm; 3], CycleError> {
    let CircularPocket { centre: (x, y), first, tool_radius, .. } = *words;
    // `K` and `Q` go together, whatever the tool.
    match (words.finished, words.step) {
        (Some(_), None) => return Err(CycleFault::Missing(Letter::of('Q')).into()),
        (None, Some(_)) => return Err(CycleFault::Missing(Letter::of('K')).into()),
        _ => {}
    }
    known(&[x, y, first, tool_radius, words.depth])?;
    if first <= tool_radius {
        return Err(CycleFault::Geometry.into());
    }
    let (finished, step) = match (words.finished, words.step) {
        (None, _) | (_, None) => (first, Mm::ZERO),
        (Some(finished), Some(step)) => {
            known(&[finished, step])?;
            if step <= Mm::ZERO {
                return Err(CycleFault::NotPositive(Letter::of('Q')).into());
            }
            if finished <= first {
                return Err(CycleFault::Geometry.into());
            }
            (finished, step)
        }
    };
    if words.rounds == 0 {
        return Err(CycleFault::ZeroRepeats.into());
    }
    if words.rounds > 1 {
        known(&[words.deeper])?;
    }
    let turns = if words.clockwise { -1 } else { 1 };
    let mut sink = Sink::new(from, out);
    let [_, _, start] = from;
    sink.rapid_if_elsewhere([x, y, start])?;
    for round in 0..words.rounds {
        let z = words.depth + words.deeper * f64::from(round);
        sink.feed([x, y, z])?;
        // Half circles lead from circle to circle, from one side of the pocket to the other.
        let mut at = Mm::ZERO;
        let mut radius = first - tool_radius;
        let last = finished - tool_radius;
        loop {
            let to = if at > Mm::ZERO { -radius } else { radius };
            sink.put(Stroke::Arc { to: [x + to, y, z], centre: (x + (at + to) / 2.0, y), turns })?;
            sink.put(Stroke::Arc { to: [x + to, y, z], centre: (x, y), turns })?;
            at = to;
            if radius >= last {
                break;
            }
            radius = (radius + step).min(last);
        }
        sink.put(Stroke::Arc { to: [x, y, z], centre: (x + at / 2.0, y), turns })?;
    }
    Ok(sink.at)
}

/// A pocket of any outline.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct GeneralPocket {
    /// The start hole, X and Y.
    pub start: (Mm, Mm),
    /// `R`: the rapid level.
    pub r: Mm,
    /// `Z`: the floor.
    pub bottom: Mm,
    /// `Q`: depth of a layer.
    pub layer: Mm,
    /// `I`: step in X between strokes along Y.
    pub step_x: Option<Mm>,
    /// `J`: step in Y between strokes along X.
    pub step_y: Option<Mm>,
    /// `K`: left on the walls for a finishing pass; 0 for none.
    pub finish: Mm,
    /// Radius of the tool, when the outline is compensated; else 0.
    pub tool_radius: Mm,
    /// Feed.
    pub feed: MmPerMin,
}

/// What a pocket of any outline comes to: an estimate, without the path that clears it.
#[derive(Debug, Clone, PartialEq)]
pub struct PocketPlan {
    /// Levels that are cleared, from the top.
    pub levels: Vec<Mm>,
    /// Smallest X, Y and Z that the tool's centre reaches.
    pub low: [Mm; 3],
    /// Largest X, Y and Z that the tool's centre reaches; Z is the rapid level.
    pub high: [Mm; 3],
    /// Area inside the outline, square millimetres.
    pub area: f64,
    /// The outline turns counter-clockwise, so that its inside is on its left.
    pub counter_clockwise: bool,
    /// Way cut at feed.
    pub cut_length: Mm,
    /// Time at feed; unknown without a feed.
    pub estimated: Seconds,
    /// Where the tool is left.
    pub end: [Mm; 3],
}

/// Ends of the outline may miss each other by this much, millimetres.
const GAP: f64 = 0.01;

/// A tool may be larger than an inside arc by this much, millimetres: rounded end points and centres.
const ARC_SLACK: f64 = 0.005;

/// Refuses a tool that is larger than an arc which the inside of the outline curves around: its centre cannot follow the wall.
///
/// An arc curves around the inside where it turns as the outline does.
fn check_arcs(wall: &[Cut], counter_clockwise: bool, tool_radius: f64) -> Result<(), CycleError> {
    let tightest = wall
        .iter()
        .filter_map(|cut| match *cut {
            Cut::Arc { from, centre, ccw, .. } if ccw == counter_clockwise => Some(distance(from, centre)),
            _ => None,
        })
        .fold(f64::INFINITY, f64::min);
    if tightest + ARC_SLACK < tool_radius {
        return Err(CycleFault::ArcBelowTool { arc: tightest, tool: tool_radius }.into());
    }
    Ok(())
}

/// The wall of a pocket: its pieces, and the corners of the polygon that they make.
struct Wall {
    cuts: Vec<Cut>,
    corners: Vec<(f64, f64)>,
}

/// The wall of an outline that is closed around its start hole. The first piece that is given leads from the hole to the
/// outline and is left out.
fn closed(start: (Mm, Mm), outline: &[ProfileSegment]) -> Result<Wall, CycleError> {
    let cuts = cuts(start, outline)?;
    let wall = cuts.get(1..).unwrap_or_default();
    let (Some(first), Some(last)) = (wall.first(), wall.last()) else {
        return Err(CycleFault::OutlineEmpty.into());
    };
    let gap = distance(first.from(), last.to());
    if gap > GAP {
        return Err(CycleFault::OutlineOpen(gap).into());
    }
    let corners = flattened(wall);
    if contains(&corners, (start.0.0, start.1.0)) {
        Ok(Wall { cuts: wall.to_vec(), corners })
    } else {
        Err(CycleFault::StartOutside.into())
    }
}

/// Checks and estimates a pocket whose outline is given as pieces in (X, Y). The first piece leads from the start hole to
/// the outline and is no part of it. With a tool of unknown size its levels are known, its extents and its time are not.
///
/// # Errors
///
/// Exactly one of `I` and `J`; `I`, `J`, `Q` positive; a closed outline with the start hole inside, whose inside arcs are not
/// smaller than the tool; a floor below `R`.
pub fn general_pocket(outline: &[ProfileSegment], words: &GeneralPocket) -> Result<PocketPlan, CycleError> {
    known(&[words.start.0, words.start.1])?;
    let Wall { cuts: wall, corners } = closed(words.start, outline)?;
    let counter_clockwise = area(&corners) > 0.0;
    check_arcs(&wall, counter_clockwise, words.tool_radius.0)?;
    known(&[words.r, words.bottom, words.layer, words.finish])?;
    let (step, letter) = match (words.step_x, words.step_y) {
        (Some(_), Some(_)) => return Err(CycleFault::Geometry.into()),
        (Some(step), None) => (step, 'I'),
        (None, Some(step)) => (step, 'J'),
        (None, None) => return Err(CycleFault::Missing(Letter::of('J')).into()),
    };
    known(&[step])?;
    for (word, letter) in [(step, letter), (words.layer, 'Q')] {
        if word <= Mm::ZERO {
            return Err(CycleFault::NotPositive(Letter::of(letter)).into());
        }
    }
    if words.finish < Mm::ZERO {
        return Err(CycleFault::NotPositive(Letter::of('K')).into());
    }
    if words.bottom > words.r {
        return Err(CycleFault::RBelowBottom.into());
    }

    let count = ((words.r - words.bottom) / words.layer).ceil().max(1.0);
    if count > f64::from(super::MAX_STROKES) {
        return Err(CycleError::TooManyStrokes);
    }
    let levels = (1..=super::MAX_STROKES)
        .map(f64::from)
        .take_while(|layer| *layer <= count)
        .map(|layer| (words.r - words.layer * layer).max(words.bottom))
        .collect();

    let area = area(&corners).abs();
    let perimeter: f64 = edges(&corners).map(|(a, b)| distance(a, b)).sum();
    // The tool's centre keeps its radius from the wall: what is left of the area to clear, and of the wall to follow.
    let radius = words.tool_radius.0;
    // `max` would make a number of what is not known.
    let at_least_zero = |number: f64| if number < 0.0 { 0.0 } else { number };
    let inner = at_least_zero(area - perimeter * radius + std::f64::consts::PI * radius * radius);
    let wall_way = at_least_zero(perimeter - std::f64::consts::TAU * radius);
    let rounds = if words.finish > Mm::ZERO { 2.0 } else { 1.0 };
    let depth = (words.r - words.bottom).0;
    let cut_length = Mm(count * (inner / step.0 + wall_way * rounds) + depth);

    let bound = |axis: fn(&(f64, f64)) -> f64, low: bool| {
        corners.iter().map(axis).fold(if low { f64::INFINITY } else { f64::NEG_INFINITY }, |best, value| {
            if low { best.min(value) } else { best.max(value) }
        })
    };
    let start = [words.start.0, words.start.1];
    let inside = |axis: fn(&(f64, f64)) -> f64, start: Mm| {
        // Where the tool does not fit, it stays in its start hole.
        let (low, high) = (bound(axis, true) + radius, bound(axis, false) - radius);
        if radius.is_nan() {
            return (Mm::UNKNOWN, Mm::UNKNOWN);
        }
        (start.min(Mm(low.min(high))), start.max(Mm(high.max(low))))
    };
    let (low_x, high_x) = inside(|corner| corner.0, start[0]);
    let (low_y, high_y) = inside(|corner| corner.1, start[1]);
    Ok(PocketPlan {
        levels,
        low: [low_x, low_y, words.bottom],
        high: [high_x, high_y, words.r],
        area,
        counter_clockwise,
        cut_length,
        estimated: cut_length / words.feed,
        end: [start[0], start[1], words.r],
    })
}

/// The corners of a closed chain, arcs as chords of at most two degrees.
fn flattened(cuts: &[Cut]) -> Vec<(f64, f64)> {
    let mut corners = Vec::new();
    for cut in cuts {
        corners.push(cut.from());
        let Cut::Arc { from, centre, .. } = *cut else { continue };
        let (start, sweep) = cut.angles();
        let radius = distance(from, centre);
        let count = (sweep.abs().to_degrees() / 2.0).ceil().clamp(1.0, 180.0);
        for chord in (1..180_u32).map(f64::from).take_while(|chord| *chord < count) {
            let angle = start + sweep * chord / count;
            corners.push((centre.0 + radius * angle.cos(), centre.1 + radius * angle.sin()));
        }
    }
    corners
}

fn edges(corners: &[(f64, f64)]) -> impl Iterator<Item = ((f64, f64), (f64, f64))> {
    corners.iter().copied().zip(corners.iter().copied().cycle().skip(1))
}

/// Signed: positive counter-clockwise.
fn area(corners: &[(f64, f64)]) -> f64 {
    edges(corners).map(|(a, b)| a.0 * b.1 - b.0 * a.1).sum::<f64>() / 2.0
}

fn contains(corners: &[(f64, f64)], point: (f64, f64)) -> bool {
    edges(corners)
        .filter(|(a, b)| (a.1 > point.1) != (b.1 > point.1))
        .filter(|(a, b)| point.0 < a.0 + (point.1 - a.1) / (b.1 - a.1) * (b.0 - a.0))
        .count()
        % 2
        == 1
}

#[cfg(test)]
mod tests {
    use expect_test::{Expect, expect};

    use super::*;
    use crate::cycles::test_support::shown;

    fn circular() -> CircularPocket {
        CircularPocket {
            centre: (Mm(10.0), Mm(20.0)),
            first: Mm(8.0),
            finished: None,
            step: None,
            depth: Mm(-3.0),
            deeper: Mm(0.0),
            rounds: 1,
            tool_radius: Mm(5.0),
            clockwise: false,
        }
    }

    fn check(words: &CircularPocket, expected: &Expect) {
        let from = [Mm(10.0), Mm(20.0), Mm(2.0)];
        expected.assert_eq(&shown(|out| circular_pocket(from, words, out).map(drop)));
    }

    #[test]
    fn one_circle_is_entered_and_left_by_half_circles() {
        check(
            &circular(),
            &expect![[r#"
            feed 10 20 -3
            arc 13 20 -3 about 11.5 20 turns 1
            arc 13 20 -3 about 10 20 turns 1
            arc 10 20 -3 about 11.5 20 turns 1
        "#]],
        );
    }

    #[test]
    fn circles_grow_to_the_finished_radius() {
        let words =
            CircularPocket { finished: Some(Mm(13.0)), step: Some(Mm(4.0)), clockwise: true, ..circular() };
        check(
            &words,
            &expect![[r#"
            feed 10 20 -3
            arc 13 20 -3 about 11.5 20 turns -1
            arc 13 20 -3 about 10 20 turns -1
            arc 3 20 -3 about 8 20 turns -1
            arc 3 20 -3 about 10 20 turns -1
            arc 18 20 -3 about 10.5 20 turns -1
            arc 18 20 -3 about 10 20 turns -1
            arc 10 20 -3 about 14 20 turns -1
        "#]],
        );
    }

    #[test]
    fn rounds_go_deeper() {
        check(
            &CircularPocket { rounds: 2, deeper: Mm(-1.5), ..circular() },
            &expect![[r#"
            feed 10 20 -3
            arc 13 20 -3 about 11.5 20 turns 1
            arc 13 20 -3 about 10 20 turns 1
            arc 10 20 -3 about 11.5 20 turns 1
            feed 10 20 -4.5
            arc 13 20 -4.5 about 11.5 20 turns 1
            arc 13 20 -4.5 about 10 20 turns 1
            arc 10 20 -4.5 about 11.5 20 turns 1
        "#]],
        );
    }

    #[test]
    fn circles_that_cannot_be_cut_are_refused() {
        check(
            &CircularPocket { tool_radius: Mm(8.0), ..circular() },
            &expect![[r#"
            Fault(Geometry)
        "#]],
        );
        check(
            &CircularPocket { finished: Some(Mm(20.0)), ..circular() },
            &expect![[r#"
            Fault(Missing(Q))
        "#]],
        );
        check(
            &CircularPocket { step: Some(Mm(2.0)), ..circular() },
            &expect![[r#"
            Fault(Missing(K))
        "#]],
        );
        check(
            &CircularPocket { finished: Some(Mm(8.0)), step: Some(Mm(2.0)), ..circular() },
            &expect![[r#"
            Fault(Geometry)
        "#]],
        );
        check(
            &CircularPocket { finished: Some(Mm(9.0)), step: Some(Mm(0.0)), ..circular() },
            &expect![[r#"
            Fault(NotPositive(Q))
        "#]],
        );
        check(
            &CircularPocket { rounds: 0, ..circular() },
            &expect![[r#"
            Fault(ZeroRepeats)
        "#]],
        );
        let tiny = CircularPocket { finished: Some(Mm(9.0)), step: Some(Mm(1e-9)), ..circular() };
        let outcome = circular_pocket([Mm(0.0); 3], &tiny, &mut |_| {});
        assert_eq!(outcome, Err(CycleError::TooManyStrokes));
    }

    fn line(x: f64, y: f64) -> ProfileSegment {
        ProfileSegment::Line { to: (Mm(x), Mm(y)), rapid: false }
    }

    /// A rectangle of 40 by 20, entered from a start hole in its middle.
    fn rectangle() -> Vec<ProfileSegment> {
        vec![
            line(20.0, 0.0),
            line(20.0, 10.0),
            line(-20.0, 10.0),
            line(-20.0, -10.0),
            line(20.0, -10.0),
            line(20.0, 0.0),
        ]
    }

    fn general() -> GeneralPocket {
        GeneralPocket {
            start: (Mm(0.0), Mm(0.0)),
            r: Mm(1.0),
            bottom: Mm(-4.0),
            layer: Mm(2.0),
            step_x: None,
            step_y: Some(Mm(4.0)),
            finish: Mm(0.0),
            tool_radius: Mm(5.0),
            feed: MmPerMin(600.0),
        }
    }

    #[test]
    fn a_pocket_is_estimated_from_its_area() {
        let plan = general_pocket(&rectangle(), &general()).unwrap();
        assert_eq!(plan.levels, [Mm(-1.0), Mm(-3.0), Mm(-4.0)]);
        assert_eq!(plan.low, [Mm(-15.0), Mm(-5.0), Mm(-4.0)]);
        assert_eq!(plan.high, [Mm(15.0), Mm(5.0), Mm(1.0)]);
        assert!((plan.area - 800.0).abs() < 1e-9);
        assert!(plan.estimated.0 > 30.0 && plan.estimated.0 < 120.0, "{plan:?}");
        assert_eq!(plan.end, [Mm(0.0), Mm(0.0), Mm(1.0)]);
    }

    #[test]
    fn a_round_outline_counts_as_round() {
        let outline = [
            line(10.0, 0.0),
            ProfileSegment::Arc { to: (Mm(10.0), Mm(0.0)), centre: (Mm(0.0), Mm(0.0)), ccw: true },
        ];
        let plan = general_pocket(&outline, &general()).unwrap();
        assert!((plan.area - 314.16).abs() < 0.5, "{plan:?}");
    }

    #[test]
    fn a_tool_of_unknown_size_leaves_extents_and_time_unknown() {
        let unknown = GeneralPocket { tool_radius: Mm::UNKNOWN, ..general() };
        let plan = general_pocket(&rectangle(), &unknown).unwrap();
        assert_eq!(plan.levels, [Mm(-1.0), Mm(-3.0), Mm(-4.0)]);
        assert!(!plan.low[0].is_known() && !plan.estimated.is_finite(), "{plan:?}");
    }

    #[test]
    fn outlines_that_cannot_be_cleared_are_refused() {
        let refused =
            |outline: &[ProfileSegment], words: GeneralPocket| general_pocket(outline, &words).unwrap_err();
        let geometry = CycleError::Fault(CycleFault::Geometry);
        assert_eq!(
            refused(&rectangle()[..4], general()),
            CycleFault::OutlineOpen(40.0_f64.hypot(10.0)).into()
        );
        assert_eq!(refused(&rectangle()[..1], general()), CycleFault::OutlineEmpty.into());
        assert_eq!(refused(&[], general()), CycleError::Profile(super::super::ProfileFault::Empty));
        assert_eq!(
            refused(&rectangle(), GeneralPocket { start: (Mm(50.0), Mm(0.0)), ..general() }),
            CycleFault::StartOutside.into()
        );
        assert_eq!(refused(&rectangle(), GeneralPocket { step_x: Some(Mm(1.0)), ..general() }), geometry);
        assert_eq!(
            refused(&rectangle(), GeneralPocket { layer: Mm(0.0), ..general() }),
            CycleFault::NotPositive(Letter::of('Q')).into()
        );
        assert_eq!(
            refused(&rectangle(), GeneralPocket { bottom: Mm(2.0), ..general() }),
            CycleFault::RBelowBottom.into()
        );
        assert_eq!(
            refused(&rectangle(), GeneralPocket { layer: Mm(1e-9), ..general() }),
            CycleError::TooManyStrokes
        );
    }
}
