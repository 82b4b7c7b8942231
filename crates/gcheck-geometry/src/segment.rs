//! Lines, circles and outlines in the plane: where they meet, how far they are, what they enclose.
//!
//! Knows points in a plane, in millimetres. Must not know the third coordinate or what the outline is for.
//!
//! Numbers that are not finite meet nothing, lie nowhere, and are at an unknown (NaN) distance.

use std::f64::consts::TAU;

use nalgebra::{Point2, Vector2};

use crate::arc::Arc;
use crate::units::Mm;

/// A point of the plane: first and second coordinate, millimetres.
pub type Point = Point2<f64>;

/// Lengths in millimetres below which two points are one: far below any control's increment, far above rounding.
pub const SAME_POINT: f64 = 1e-9;

/// Where two curves meet.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Meeting {
    /// Nowhere, or everywhere: one curve lies on the other.
    None,
    /// They touch.
    Touch(Point),
    /// They cross twice.
    Two(Point, Point),
}

impl Meeting {
    /// The points, in order.
    pub fn points(self) -> impl Iterator<Item = Point> {
        let (one, other) = match self {
            Self::None => (None, None),
            Self::Touch(point) => (Some(point), None),
            Self::Two(one, other) => (Some(one), Some(other)),
        };
        one.into_iter().chain(other)
    }
}

/// Where two straight lines cross.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Crossing {
    /// The point.
    pub point: Point,
    /// Its place on the first line: 0 at the first point that gave the line, 1 at the second.
    pub on_first: f64,
    /// Its place on the second line, likewise.
    pub on_second: f64,
}

/// The crossing of two lines without ends, each given by two of its points. None for parallel lines.
pub fn line_line(first: (Point, Point), second: (Point, Point)) -> Option<Crossing> {
    let (along_first, along_second) = (first.1 - first.0, second.1 - second.0);
    let cross = along_first.perp(&along_second);
    let between = second.0 - first.0;
    let parallel = cross.abs() <= 1e-12 * along_first.norm() * along_second.norm();
    if parallel || !cross.is_finite() {
        return None;
    }
    let on_first = between.perp(&along_second) / cross;
    let on_second = between.perp(&along_first) / cross;
    let point = first.0 + along_first * on_first;
    let known = on_first.is_finite() && on_second.is_finite() && is_finite(point);
    known.then_some(Crossing { point, on_first, on_second })
}

/// The meeting of a line without ends, given by two of its points, and a circle; ordered along the line.
pub fn line_circle(line: (Point, Point), centre: Point, radius: f64) -> Meeting {
    let Some(direction) =
        (line.1 - line.0).try_normalize(0.0).filter(|d| d.iter().all(|part| part.is_finite()))
    else {
        return Meeting::None;
    };
    let foot = line.0 + direction * (centre - line.0).dot(&direction);
    across(foot, direction, (centre - foot).norm(), radius.abs())
}

/// The meeting of two circles: the first point lies to the left of the way from the first centre to the second.
pub fn circle_circle(first: (Point, f64), second: (Point, f64)) -> Meeting {
    let between = second.0 - first.0;
    let distance = between.norm();
    let (one, other) = (first.1.abs(), second.1.abs());
    if !(distance > SAME_POINT && distance.is_finite() && one.is_finite() && other.is_finite()) {
        return Meeting::None;
    }
    let direction = between / distance;
    // From the first centre to the chord that both circles share.
    let along = distance.midpoint((one - other) * (one + other) / distance);
    let left = Vector2::new(-direction.y, direction.x);
    match across(first.0 + direction * along, left, along.abs(), one) {
        Meeting::Two(right, left) => Meeting::Two(left, right),
        meeting => meeting,
    }
}

/// The points on a circle of `radius` on a line that passes its centre at `distance`, at `foot`.
fn across(foot: Point, direction: Vector2<f64>, distance: f64, radius: f64) -> Meeting {
    let gap = distance - radius;
    // A line that misses the circle by rounding touches it.
    if gap > SAME_POINT || !gap.is_finite() || !is_finite(foot) {
        return Meeting::None;
    }
    let half = ((radius - distance) * (radius + distance)).max(0.0).sqrt();
    if half <= SAME_POINT {
        Meeting::Touch(foot)
    } else {
        Meeting::Two(foot - direction * half, foot + direction * half)
    }
}

/// A straight or circular piece of a path in the plane.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Edge {
    /// A straight piece.
    Line {
        /// Where it starts.
        start: Point,
        /// Where it ends.
        end: Point,
    },
    /// A piece of a circle.
    Arc {
        /// Where it starts; its distance from the centre is the radius.
        start: Point,
        /// Where it ends: where the sweep leads, but for the tolerance of the path it was taken from.
        end: Point,
        /// The centre.
        centre: Point,
        /// The angle passed, in radians, counter-clockwise positive, whole turns included.
        sweep: f64,
    },
}

/// The arc in its plane, first and second coordinate; what a helix does along the normal is lost.
impl From<&Arc> for Edge {
    fn from(arc: &Arc) -> Self {
        let flat = |point: [Mm; 3]| {
            let [first, second, _] = arc.plane().to_local(point);
            Point::new(first.0, second.0)
        };
        let (first, second) = arc.centre();
        Self::Arc {
            start: flat(arc.start()),
            end: flat(arc.end()),
            centre: Point::new(first.0, second.0),
            sweep: arc.sweep(),
        }
    }
}

impl Edge {
    /// A straight piece.
    pub fn line(start: Point, end: Point) -> Self {
        Self::Line { start, end }
    }

    /// A piece of a circle that starts at `start` and passes `sweep` radians about `centre`.
    pub fn arc(start: Point, centre: Point, sweep: f64) -> Self {
        Self::Arc { start, end: turned(start, centre, sweep), centre, sweep }
    }

    /// Where it starts.
    pub fn start(&self) -> Point {
        match *self {
            Self::Line { start, .. } | Self::Arc { start, .. } => start,
        }
    }

    /// Where it ends.
    pub fn end(&self) -> Point {
        match *self {
            Self::Line { end, .. } | Self::Arc { end, .. } => end,
        }
    }

    /// Its length, millimetres.
    pub fn length(&self) -> f64 {
        match *self {
            Self::Line { start, end } => (end - start).norm(),
            Self::Arc { start, centre, sweep, .. } => (start - centre).norm() * sweep.abs(),
        }
    }

    /// The point at the part `t` of its length, 0 to 1.
    pub fn point_at(&self, t: f64) -> Point {
        match *self {
            Self::Line { start, end } => start + (end - start) * t,
            Self::Arc { start, centre, sweep, .. } => turned(start, centre, sweep * t),
        }
    }

    /// Its direction at the part `t` of its length, of length 1; not a number where there is none.
    pub fn tangent_at(&self, t: f64) -> Vector2<f64> {
        match *self {
            Self::Line { start, end } => (end - start).normalize(),
            Self::Arc { start, centre, sweep, .. } => {
                let outward = (turned(start, centre, sweep * t) - centre).normalize();
                Vector2::new(-outward.y, outward.x) * sweep.signum()
            }
        }
    }

    /// The same piece from end to start.
    #[must_use]
    pub fn reversed(&self) -> Self {
        match *self {
            Self::Line { start, end } => Self::Line { start: end, end: start },
            Self::Arc { start, end, centre, sweep } => {
                Self::Arc { start: end, end: start, centre, sweep: -sweep }
            }
        }
    }

    /// Its point nearest to `point`; any of them where several are, and not a number for unknown numbers.
    pub fn closest_point(&self, point: Point) -> Point {
        match *self {
            Self::Line { start, end } => {
                let along = end - start;
                let square = along.norm_squared();
                if square <= 0.0 {
                    return start;
                }
                start + along * ((point - start).dot(&along) / square).clamp(0.0, 1.0)
            }
            Self::Arc { start, end, centre, sweep } => {
                if !(is_finite(start)
                    && is_finite(end)
                    && is_finite(centre)
                    && is_finite(point)
                    && sweep.is_finite())
                {
                    return Point::new(f64::NAN, f64::NAN);
                }
                match (point - centre).try_normalize(0.0) {
                    Some(outward) if self.passes(centre + outward, 0.0) => {
                        centre + outward * (start - centre).norm()
                    }
                    // All points of the arc are equally far from its centre.
                    None => start,
                    Some(_) if (point - start).norm() <= (point - end).norm() => start,
                    Some(_) => end,
                }
            }
        }
    }

    /// The distance of a point from it, millimetres.
    pub fn distance_to(&self, point: Point) -> f64 {
        (self.closest_point(point) - point).norm()
    }

    /// Where it meets another piece, ends included: at most two points. Pieces that lie on each other (parts of one
    /// line or of one circle) meet nowhere.
    pub fn intersections(&self, other: &Self) -> Vec<Point> {
        let both = |point: &Point| self.holds(*point) && other.holds(*point);
        match (*self, *other) {
            (Self::Line { start, end }, Self::Line { start: from, end: to }) => {
                line_line((start, end), (from, to))
                    .map(|crossing| crossing.point)
                    .into_iter()
                    .filter(both)
                    .collect()
            }
            (Self::Line { start, end }, Self::Arc { start: from, centre, .. })
            | (Self::Arc { start: from, centre, .. }, Self::Line { start, end }) => {
                line_circle((start, end), centre, (from - centre).norm()).points().filter(both).collect()
            }
            (Self::Arc { start, centre, .. }, Self::Arc { start: from, centre: about, .. }) => {
                let circles = ((centre, (start - centre).norm()), (about, (from - about).norm()));
                circle_circle(circles.0, circles.1).points().filter(both).collect()
            }
        }
    }

    /// Whether a point of the line or circle lies between the ends or on one of them.
    fn holds(&self, point: Point) -> bool {
        if (point - self.start()).norm() <= SAME_POINT || (point - self.end()).norm() <= SAME_POINT {
            return true;
        }
        match *self {
            Self::Line { start, end } => {
                let along = end - start;
                let place = (point - start).dot(&along);
                (0.0..=along.norm_squared()).contains(&place)
            }
            Self::Arc { .. } => self.passes(point, 0.0),
        }
    }

    /// Whether an arc passes the direction in which a point lies from its centre; `slack` in radians.
    fn passes(&self, point: Point, slack: f64) -> bool {
        let Self::Arc { start, centre, sweep, .. } = *self else { return false };
        let (from, to) = (start - centre, point - centre);
        let angle = from.perp(&to).atan2(from.dot(&to)) * sweep.signum();
        let ahead = if angle < -slack { angle + TAU } else { angle };
        ahead <= sweep.abs() + slack
    }
}

/// A point turned about a centre, counter-clockwise.
fn turned(point: Point, centre: Point, radians: f64) -> Point {
    let (sin, cos) = radians.sin_cos();
    let from = point - centre;
    centre + Vector2::new(from.x * cos - from.y * sin, from.x * sin + from.y * cos)
}

fn is_finite(point: Point) -> bool {
    point.x.is_finite() && point.y.is_finite()
}

/// Where a point lies with respect to an outline.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Location {
    /// The outline goes round it.
    Inside,
    /// On the outline, within the tolerance.
    OnEdge,
    /// The outline does not go round it.
    Outside,
}

/// Where a point lies. Each edge must start where the one before ends; a last straight one is added where the
/// outline is open. None where a number is unknown or infinite.
///
/// A point counts as inside when the outline goes round it in sum ([`winding`] is not 0), so both directions of an
/// outline enclose the same.
pub fn locate(outline: &[Edge], point: Point, tolerance: Mm) -> Option<Location> {
    let closing = closing(outline);
    let mut on_edge = false;
    for edge in outline.iter().chain(&closing) {
        let distance = edge.distance_to(point);
        if !distance.is_finite() {
            return None;
        }
        on_edge |= distance <= tolerance.0;
    }
    if on_edge {
        return Some(Location::OnEdge);
    }
    if !is_finite(point) {
        return None;
    }
    Some(if winding(outline, point) == 0 { Location::Outside } else { Location::Inside })
}

/// How often an outline goes round a point, counter-clockwise positive; closed as in [`locate`]. A point on the
/// outline counts to one of the sides.
pub fn winding(outline: &[Edge], point: Point) -> i64 {
    let closing = closing(outline);
    outline.iter().chain(&closing).fold(0_i64, |sum, edge| {
        // An arc goes round a point as its chord does, and once more in what lies between chord and arc.
        sum.saturating_add(chord_crossing(edge.start(), edge.end(), point))
            .saturating_add(segment_winding(edge, point))
    })
}

/// The area enclosed, square millimetres; positive when the outline runs counter-clockwise. Closed as in [`locate`].
pub fn signed_area(outline: &[Edge]) -> f64 {
    let closing = closing(outline);
    outline
        .iter()
        .chain(&closing)
        .map(|edge| {
            let chord = edge.start().coords.perp(&edge.end().coords) / 2.0;
            match *edge {
                Edge::Line { .. } => chord,
                Edge::Arc { start, centre, sweep, .. } => {
                    chord + (start - centre).norm_squared() * (sweep - sweep.sin()) / 2.0
                }
            }
        })
        .sum()
}

/// The straight edge from the end of an outline to its start, where they are apart.
fn closing(outline: &[Edge]) -> Option<Edge> {
    let (first, last) = (outline.first()?, outline.last()?);
    let (start, end) = (first.start(), last.end());
    ((start - end).norm() > 0.0).then_some(Edge::Line { start: end, end: start })
}

/// Which side of a chord a point lies on: positive left. A point on the chord is taken to lie a little to the right in
/// the first coordinate and, next to nothing, up in the second, as the half-open comparison in `chord_crossing` does.
fn side(start: Point, end: Point, point: Point) -> f64 {
    let along = end - start;
    let cross = along.perp(&(point - start));
    if cross.abs() > 0.0 {
        cross
    } else if along.y.abs() > 0.0 {
        -along.y
    } else {
        along.x
    }
}

/// +1 for a chord that crosses the ray from the point along the first axis upwards, -1 downwards, else 0.
fn chord_crossing(start: Point, end: Point, point: Point) -> i64 {
    let (starts_below, ends_below) = (start.y <= point.y, end.y <= point.y);
    match (starts_below, ends_below) {
        (true, false) if side(start, end, point) > 0.0 => 1,
        (false, true) if side(start, end, point) < 0.0 => -1,
        _ => 0,
    }
}

/// How often an arc followed by its chord backwards goes round a point.
fn segment_winding(edge: &Edge, point: Point) -> i64 {
    let Edge::Arc { start, end, centre, sweep } = *edge else { return 0 };
    if (point - centre).norm_squared() >= (start - centre).norm_squared() {
        return 0;
    }
    let turns = (sweep.abs() / TAU).round();
    let whole = (sweep.abs() - turns * TAU).abs() <= 1e-9 && turns > 0.0;
    let rounds = if whole {
        turns as i64
    } else {
        // Between the ends the arc lies on the right of its chord when it turns left.
        let beyond = side(start, end, point) * sweep < 0.0;
        ((sweep.abs() / TAU).floor() as i64).saturating_add(i64::from(beyond))
    };
    if sweep < 0.0 { rounds.saturating_neg() } else { rounds }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::{FRAC_PI_2, PI};

    use proptest::prelude::*;

    use super::*;

    fn p(x: f64, y: f64) -> Point {
        Point::new(x, y)
    }

    fn near(one: Point, other: Point) -> bool {
        (one - other).norm() < 1e-6
    }

    fn shown(points: impl IntoIterator<Item = Point>) -> String {
        let points: Vec<String> =
            points.into_iter().map(|p| format!("({:.3} {:.3})", p.x + 0.0, p.y + 0.0)).collect();
        points.join(" ")
    }

    #[test]
    fn lines_cross_once_or_are_parallel() {
        let crossing = line_line((p(0.0, 0.0), p(4.0, 0.0)), (p(1.0, -1.0), p(1.0, 1.0))).unwrap();
        assert_eq!(crossing, Crossing { point: p(1.0, 0.0), on_first: 0.25, on_second: 0.5 });
        assert_eq!(line_line((p(0.0, 0.0), p(4.0, 0.0)), (p(0.0, 1.0), p(4.0, 1.0))), None);
        assert_eq!(line_line((p(0.0, 0.0), p(0.0, 0.0)), (p(0.0, 1.0), p(4.0, 1.0))), None);
        assert_eq!(line_line((p(0.0, f64::NAN), p(4.0, 0.0)), (p(1.0, -1.0), p(1.0, 1.0))), None);
    }

    #[test]
    fn a_line_misses_touches_or_crosses_a_circle() {
        let meet = |y: f64| shown(line_circle((p(-9.0, y), p(9.0, y)), p(0.0, 0.0), 5.0).points());
        assert_eq!(meet(6.0), "");
        assert_eq!(meet(5.0), "(0.000 5.000)");
        assert_eq!(meet(3.0), "(-4.000 3.000) (4.000 3.000)");
        assert_eq!(line_circle((p(1.0, 1.0), p(1.0, 1.0)), p(0.0, 0.0), 5.0), Meeting::None);
    }

    #[test]
    fn circles_miss_touch_or_cross() {
        let meet =
            |x: f64, radius: f64| shown(circle_circle((p(0.0, 0.0), 5.0), (p(x, 0.0), radius)).points());
        assert_eq!(meet(6.0, 5.0), "(3.000 4.000) (3.000 -4.000)");
        assert_eq!(meet(10.0, 5.0), "(5.000 0.000)");
        assert_eq!(meet(2.0, 3.0), "(5.000 0.000)");
        assert_eq!(meet(11.0, 5.0), "");
        assert_eq!(meet(1.0, 2.0), "");
        assert_eq!(meet(0.0, 5.0), "");
    }

    #[test]
    fn pieces_meet_between_their_ends_only() {
        let line = Edge::line(p(-9.0, 3.0), p(9.0, 3.0));
        let right_half = Edge::arc(p(0.0, -5.0), p(0.0, 0.0), PI);
        assert_eq!(shown(line.intersections(&right_half)), "(4.000 3.000)");
        assert_eq!(shown(right_half.intersections(&line.reversed())), "(4.000 3.000)");
        assert_eq!(shown(line.intersections(&right_half.reversed())), "(4.000 3.000)");
        assert_eq!(shown(line.intersections(&Edge::line(p(0.0, 0.0), p(0.0, 2.9)))), "");
        assert_eq!(shown(line.intersections(&Edge::line(p(0.0, 0.0), p(0.0, 3.0)))), "(0.000 3.000)");
        let other = Edge::arc(p(6.0, 5.0), p(6.0, 0.0), PI);
        assert_eq!(shown(right_half.intersections(&other)), "(3.000 4.000) (3.000 -4.000)");
    }

    #[test]
    fn distances_are_to_the_nearest_point_between_the_ends() {
        let line = Edge::line(p(0.0, 0.0), p(10.0, 0.0));
        assert!((line.distance_to(p(5.0, 3.0)) - 3.0).abs() < 1e-12);
        assert!((line.distance_to(p(13.0, 4.0)) - 5.0).abs() < 1e-12);
        let quarter = Edge::arc(p(5.0, 0.0), p(0.0, 0.0), FRAC_PI_2);
        assert!((quarter.distance_to(p(6.0, 8.0)) - 5.0).abs() < 1e-12);
        assert!((quarter.distance_to(p(0.0, 0.0)) - 5.0).abs() < 1e-12);
        assert!((quarter.distance_to(p(5.0, -2.0)) - 2.0).abs() < 1e-12);
        assert!(
            quarter.distance_to(p(f64::NAN, 0.0)).is_nan() && line.distance_to(p(f64::NAN, 0.0)).is_nan()
        );
        assert!((Edge::line(p(1.0, 1.0), p(1.0, 1.0)).distance_to(p(1.0, 3.0)) - 2.0).abs() < 1e-12);
    }

    #[test]
    fn a_slot_with_round_ends_holds_what_its_ends_bulge_over() {
        // From (0,0) to (10,0), the half circle about (10,2), back to (0,4), the half circle about (0,2).
        let slot = [
            Edge::line(p(0.0, 0.0), p(10.0, 0.0)),
            Edge::arc(p(10.0, 0.0), p(10.0, 2.0), PI),
            Edge::line(p(10.0, 4.0), p(0.0, 4.0)),
            Edge::arc(p(0.0, 4.0), p(0.0, 2.0), PI),
        ];
        let at = |x, y| locate(&slot, p(x, y), Mm(1e-6)).unwrap();
        assert_eq!(at(5.0, 2.0), Location::Inside);
        assert_eq!(at(11.5, 2.0), Location::Inside);
        assert_eq!(at(-1.5, 2.0), Location::Inside);
        assert_eq!(at(-1.5, 3.9), Location::Outside);
        assert_eq!(at(12.0, 2.0), Location::OnEdge);
        assert_eq!(at(5.0, 4.0), Location::OnEdge);
        // On the chord of an end, which is not an edge.
        assert_eq!(at(10.0, 1.0), Location::Inside);
        assert_eq!(at(0.0, 1.0), Location::Inside);
        assert!((signed_area(&slot) - (40.0 + 4.0 * PI)).abs() < 1e-9);
        let back: Vec<Edge> = slot.iter().rev().map(Edge::reversed).collect();
        assert!((signed_area(&back) + (40.0 + 4.0 * PI)).abs() < 1e-9);
        assert_eq!(winding(&back, p(11.5, 2.0)), -1);
        assert_eq!(locate(&slot, p(f64::NAN, 0.0), Mm(1e-6)), None);
    }

    #[test]
    fn arcs_that_bite_into_the_outline_take_away() {
        let bitten = [
            Edge::line(p(0.0, 0.0), p(10.0, 0.0)),
            Edge::line(p(10.0, 0.0), p(10.0, 10.0)),
            Edge::line(p(10.0, 10.0), p(8.0, 10.0)),
            // Clockwise about (5,10), below the top edge.
            Edge::arc(p(8.0, 10.0), p(5.0, 10.0), -PI),
            Edge::line(p(2.0, 10.0), p(0.0, 10.0)),
        ];
        let at = |x, y| locate(&bitten, p(x, y), Mm(1e-6)).unwrap();
        assert_eq!(at(5.0, 8.0), Location::Outside);
        assert_eq!(at(5.0, 6.0), Location::Inside);
        // The last edge is missing: the outline is closed with it.
        assert_eq!(at(0.0, 5.0), Location::OnEdge);
        assert!((signed_area(&bitten) - (100.0 - 4.5 * PI)).abs() < 1e-9);
    }

    #[test]
    fn a_circle_alone_is_an_outline() {
        let circle = [Edge::arc(p(5.0, 0.0), p(0.0, 0.0), -TAU)];
        assert_eq!(locate(&circle, p(-4.9, 0.0), Mm(1e-6)), Some(Location::Inside));
        assert_eq!(locate(&circle, p(-5.1, 0.0), Mm(1e-6)), Some(Location::Outside));
        assert_eq!(winding(&[Edge::arc(p(5.0, 0.0), p(0.0, 0.0), 3.0 * TAU)], p(1.0, 1.0)), 3);
        assert_eq!(locate(&[], p(0.0, 0.0), Mm(1e-6)), Some(Location::Outside));
    }

    #[test]
    fn an_arc_in_space_is_an_edge_in_its_plane() {
        let start = [Mm(0.0), Mm(7.0), Mm(5.0)];
        let end = [Mm(5.0), Mm(8.0), Mm(0.0)];
        let arc = Arc::from_parts(crate::Plane::Zx, start, end, (Mm(0.0), Mm(0.0)), FRAC_PI_2);
        let edge = Edge::from(&arc);
        assert_eq!((edge.start(), edge.end()), (p(5.0, 0.0), p(0.0, 5.0)));
        assert!((edge.length() - 2.5 * PI).abs() < 1e-12);
        assert!((edge.tangent_at(0.0) - Vector2::new(0.0, 1.0)).norm() < 1e-12);
    }

    fn some_point() -> impl Strategy<Value = Point> {
        // Whole numbers make points on edges, chords and corners frequent.
        let number = prop_oneof![-20.0..20.0_f64, (-8..8_i32).prop_map(f64::from)];
        (number.clone(), number).prop_map(|(x, y)| p(x, y))
    }

    fn some_edge() -> impl Strategy<Value = Edge> {
        prop_oneof![
            (some_point(), some_point()).prop_map(|(start, end)| Edge::line(start, end)),
            (some_point(), some_point(), prop_oneof![-12.0..12.0_f64, Just(PI), Just(-PI), Just(TAU)])
                .prop_map(|(start, centre, sweep)| Edge::arc(start, centre, sweep)),
        ]
    }

    /// Corners in any order, joined by lines and by arcs of any bulge, so that outlines cross themselves.
    fn some_outline() -> impl Strategy<Value = Vec<Edge>> {
        prop::collection::vec((some_point(), prop_oneof![Just(0.0), -3.0..3.0_f64]), 1..7).prop_map(
            |corners| {
                let next = corners.iter().cycle().skip(1);
                corners
                    .iter()
                    .zip(next)
                    .map(|((start, bulge), (end, _))| {
                        let chord = end - start;
                        if bulge.abs() < 0.05 || chord.norm() < 1e-6 {
                            return Edge::line(*start, *end);
                        }
                        // The tangent of a quarter of the sweep.
                        let sweep = 4.0 * bulge.atan();
                        let off = chord.norm() / 2.0 / (sweep / 2.0).tan();
                        let left = Vector2::new(-chord.y, chord.x).normalize();
                        let centre = start + chord / 2.0 + left * off;
                        Edge::Arc { start: *start, end: *end, centre, sweep }
                    })
                    .collect()
            },
        )
    }

    proptest! {
        #[test]
        fn the_nearest_point_is_on_the_piece_and_no_sample_is_nearer(edge in some_edge(), point in some_point()) {
            let distance = edge.distance_to(point);
            let sampled = (0..=500).map(|i| (edge.point_at(f64::from(i) / 500.0) - point).norm()).fold(f64::MAX, f64::min);
            prop_assert!(distance <= sampled + 1e-9);
            prop_assert!(sampled <= distance + edge.length() / 500.0);
        }

        #[test]
        fn meeting_points_lie_on_both_pieces(one in some_edge(), other in some_edge()) {
            for point in one.intersections(&other) {
                prop_assert!(one.distance_to(point) < 1e-3 && other.distance_to(point) < 1e-3);
            }
            let (there, back) = (one.intersections(&other), other.intersections(&one));
            prop_assert_eq!(there.len(), back.len());
            for point in &there {
                prop_assert!(back.iter().any(|other| near(*point, *other)));
            }
        }

        #[test]
        fn winding_is_the_sum_of_the_angles_seen_from_the_point(outline in some_outline(), point in some_point()) {
            prop_assume!(outline.iter().all(|edge| edge.distance_to(point) > 1e-3));
            let mut angle = 0.0;
            for edge in &outline {
                let mut from = edge.start() - point;
                for i in 1..=4000 {
                    let to = edge.point_at(f64::from(i) / 4000.0) - point;
                    angle += from.perp(&to).atan2(from.dot(&to));
                    from = to;
                }
            }
            prop_assert_eq!(winding(&outline, point), (angle / TAU).round() as i64);
        }

        #[test]
        fn nothing_panics(numbers in prop::collection::vec(prop::num::f64::ANY, 14)) {
            let at = |i: usize| p(numbers[i], numbers[i + 1]);
            let edges = [
                Edge::line(at(0), at(2)),
                Edge::Arc { start: at(4), end: at(6), centre: at(8), sweep: numbers[12] },
            ];
            for edge in &edges {
                let _ = (edge.distance_to(at(10)), edge.length(), edge.tangent_at(numbers[13]));
                for other in &edges {
                    let _ = edge.intersections(other);
                }
            }
            let _ = (winding(&edges, at(10)), locate(&edges, at(10), Mm(0.1)), signed_area(&edges));
        }
    }
}
