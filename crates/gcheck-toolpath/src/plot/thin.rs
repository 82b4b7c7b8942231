//! Fewer points for the same path.
//!
//! Knows: which points can go without the path moving far. Must not know: what is drawn with them.

use super::drawing::{Kind, Point};

/// A chord is held against this many points at most.
const WINDOW: usize = 48;
/// The first tolerance, millimetres: points on a straight line.
const FIRST: f64 = 0.000_5;

/// Leaves at most `limit` points; tells how far the path may have moved, millimetres. It moves no further than a two-hundredth
/// of its size, unless that is not enough: then points are left out one by one, and the distance is infinite.
pub(super) fn to(points: &mut Vec<Point>, limit: usize) -> f64 {
    let coarsest = size(points) / 200.0;
    let mut tolerance = FIRST;
    let mut moved = 0.0;
    // What costs nothing first: points on a straight line at one feed. After that a piece has the feed of its end.
    if points.len() > limit {
        pass(points, tolerance, true);
        moved += tolerance;
    }
    while points.len() > limit && tolerance <= coarsest.max(FIRST) {
        pass(points, tolerance, false);
        moved += tolerance;
        tolerance *= 3.0;
    }
    while points.len() > limit {
        leave_out(points);
        moved = f64::INFINITY;
    }
    moved
}

/// The longest side of the box around the points.
fn size(points: &[Point]) -> f64 {
    let mut longest = 0.0_f64;
    for axis in 0..3 {
        let values = points.iter().filter_map(|point| point.at.get(axis)).filter(|value| value.is_finite());
        let (low, high) = values.fold((f32::INFINITY, f32::NEG_INFINITY), |(low, high), value| {
            (low.min(*value), high.max(*value))
        });
        if high > low {
            longest = longest.max(f64::from(high - low));
        }
    }
    longest
}

/// Drops points that lie within the tolerance of the chord from a kept point to a later one; `by_drive` only those with the
/// same feed and speed.
fn pass(points: &mut Vec<Point>, tolerance: f64, by_drive: bool) {
    let mut kept: Vec<Point> = Vec::with_capacity(points.len() / 2);
    let mut anchor = 0;
    let mut at = 0;
    while let Some(point) = points.get(at) {
        if kept.is_empty() || point.kind == Kind::Start {
            kept.push(*point);
            anchor = at;
            at += 1;
            continue;
        }
        // The furthest end of a chord from the anchor that all points between are near to.
        let mut end = at;
        while let Some(next) = points.get(end + 1) {
            let between = points.get(anchor + 1..=end).unwrap_or_default();
            let goes_on =
                end - anchor < WINDOW && is_alike(point, next) && (!by_drive || point.drive == next.drive);
            let Some(from) = points.get(anchor).filter(|_| goes_on) else { break };
            if !between.iter().all(|point| is_near(from, next, point, tolerance)) {
                break;
            }
            end += 1;
        }
        if let Some(point) = points.get(end) {
            kept.push(*point);
        }
        anchor = end;
        at = end + 1;
    }
    *points = kept;
}

/// May one piece stand for both?
fn is_alike(a: &Point, b: &Point) -> bool {
    a.kind == b.kind
        && a.tool == b.tool
        && a.file == b.file
        && a.call == b.call
        && a.at.iter().zip(b.at).all(|(a, b)| a.is_nan() == b.is_nan())
}

fn is_near(from: &Point, to: &Point, point: &Point, tolerance: f64) -> bool {
    let part = |axis: usize, of: &Point| f64::from(of.at.get(axis).copied().unwrap_or(0.0));
    let (mut along, mut square, mut away) = (0.0, 0.0, 0.0);
    for axis in 0..3 {
        let (chord, offset) = (part(axis, to) - part(axis, from), part(axis, point) - part(axis, from));
        // Unknown is unknown on all three.
        if chord.is_finite() && offset.is_finite() {
            along += chord * offset;
            square += chord * chord;
            away += offset * offset;
        }
    }
    let share = if square > 0.0 { (along / square).clamp(0.0, 1.0) } else { 0.0 };
    away - 2.0 * share * along + share * share * square <= tolerance * tolerance
}

/// Leaves out every second point that is not a start of a path; where there are none, every second path.
fn leave_out(points: &mut Vec<Point>) {
    let before = points.len();
    let mut odd = false;
    points.retain(|point| {
        odd = !odd && point.kind != Kind::Start;
        !odd
    });
    if points.len() == before {
        points.truncate(before / 2);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn line(points: impl IntoIterator<Item = [f32; 3]>) -> Vec<Point> {
        let points = (0_u16..).zip(points);
        points
            .map(|(ix, at)| Point {
                at,
                seconds: f32::from(ix),
                line: ix.into(),
                kind: if ix == 0 { Kind::Start } else { Kind::Feed },
                tool: 0,
                file: 0,
                drive: 0,
                call: 0,
                rotary: [0.0; 3],
            })
            .collect()
    }

    #[test]
    fn points_on_a_straight_line_go_first_and_cost_nothing() {
        let mut points = line((0..100_u8).map(|x| [f32::from(x), 0.0, 0.0]));
        let moved = to(&mut points, 10);
        assert!(moved <= 2.0 * FIRST && points.len() <= 10, "{moved} {}", points.len());
        assert_eq!(points.last().map(|point| point.at), Some([99.0, 0.0, 0.0]));
    }

    #[test]
    fn a_circle_stays_one_within_the_distance_that_is_told() {
        let angle = |ix: u16| f32::from(ix) * 0.001;
        let mut points = line((0..6_283).map(|ix| [100.0 * angle(ix).cos(), 100.0 * angle(ix).sin(), 0.0]));
        let moved = to(&mut points, 300);
        assert!(points.len() <= 300 && moved < 1.0, "{} {moved}", points.len());
        for pair in points.windows(2) {
            let middle = [0, 1].map(|axis| f32::midpoint(pair[0].at[axis], pair[1].at[axis]));
            assert!((f64::from(middle[0].hypot(middle[1])) - 100.0).abs() <= moved);
        }
    }

    #[test]
    fn noise_is_left_out_until_it_is_few() {
        let mut points =
            line((0..5_000_u16).map(|ix| [f32::from(ix % 91 * 71 % 97), f32::from(ix % 83 * 31 % 83), 0.0]));
        assert!(to(&mut points, 100).is_infinite() && points.len() <= 100);
    }
}
