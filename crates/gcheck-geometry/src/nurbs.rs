//! Splines in the plane: Bézier curves of second and third degree, and NURBS.
//!
//! Knows how control points and weights make a curve. Must not know how a program gives them.

use nalgebra::Vector2;

use crate::segment::{Edge, Point};
use crate::units::Mm;

/// The highest order (degree plus one) of a NURBS.
pub const MAX_ORDER: usize = 32;

/// A curve is cut into no more pieces of two arcs than this, or a few more.
const MOST_PIECES: usize = 512;

/// An arc of a larger radius, in millimetres, is a line.
const STRAIGHT: f64 = 1e6;

/// No piece of a curve is halved more often than this when it is cut into chords.
const MAX_HALVINGS: u32 = 14;

/// A Bézier curve. The parameter runs from 0 to 1.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Bezier {
    /// Second degree: start, control point, end.
    Quadratic([Point; 3]),
    /// Third degree: start, two control points, end.
    Cubic([Point; 4]),
}

impl Bezier {
    /// Where the curve starts.
    pub fn start(&self) -> Point {
        let (Self::Quadratic([start, ..]) | Self::Cubic([start, ..])) = self;
        *start
    }

    /// Where the curve ends.
    pub fn end(&self) -> Point {
        let (Self::Quadratic([.., end]) | Self::Cubic([.., end])) = self;
        *end
    }

    /// The point at the parameter `t`.
    pub fn point_at(&self, t: f64) -> Point {
        match *self {
            Self::Quadratic([start, control, end]) => {
                between(between(start, control, t), between(control, end, t), t)
            }
            Self::Cubic([start, first, second, end]) => {
                let middle = between(first, second, t);
                between(
                    between(between(start, first, t), middle, t),
                    between(middle, between(second, end, t), t),
                    t,
                )
            }
        }
    }

    /// The ends of chords within `tolerance` of the curve, the start left out; the last one is the end exactly.
    pub fn linearised(&self, tolerance: Mm) -> Vec<Point> {
        let even = |points: &[Point]| points.iter().map(|point| weighted(*point, 1.0)).collect();
        let mut ends = match self {
            Self::Quadratic(points) => flatten(even(points), tolerance),
            Self::Cubic(points) => flatten(even(points), tolerance),
        };
        if let Some(last) = ends.last_mut() {
            *last = self.end();
        }
        ends
    }

    /// The curve as arcs and lines that touch each other and stay within about `tolerance` of it: two arcs for each of equal
    /// pieces, of which there are four for each control point or more.
    pub fn arcs(&self, tolerance: Mm) -> Vec<CurveArc> {
        let mut count = match self {
            Self::Quadratic(points) => 4 * points.len(),
            Self::Cubic(points) => 4 * points.len(),
        };
        loop {
            let (arcs, off) = self.in_arcs(count);
            if off <= tolerance.0 || count >= MOST_PIECES {
                return arcs;
            }
            count *= 2;
        }
    }

    /// Two arcs for each of so many pieces, and how far the joints within the pieces are from the curve.
    #[expect(clippy::cast_precision_loss, reason = "the count is small")]
    fn in_arcs(&self, count: usize) -> (Vec<CurveArc>, f64) {
        let at = |index: usize| index as f64 / count as f64;
        let mut arcs = Vec::with_capacity(2 * count);
        let mut off: f64 = 0.0;
        for index in 0..count {
            let (begin, end) = (at(index), at(index + 1));
            let last = index + 1 == count;
            let [from, to] = [self.point_at(begin), if last { self.end() } else { self.point_at(end) }];
            let [leaves, arrives] = [begin, end].map(|t| self.direction_at(t, to - from));
            let joint = joint(from, leaves, to, arrives);
            let middle = self.point_at(f64::midpoint(begin, end));
            // The joint lies beside the curve where its neighbour does: by what it is off across the chord. Along the chord nothing is measured,
            // so a curve that turns back may be cut short at its turn.
            let across = Vector2::new(-(to - from).y, (to - from).x).try_normalize(0.0);
            off = off.max(across.map_or(0.0, |across| (joint - middle).dot(&across).abs()));
            arcs.push(touching(from, leaves, joint));
            arcs.push(CurveArc { end: to, ..touching(to, arrives, joint) });
        }
        (arcs, off)
    }

    /// The direction of the curve at the parameter `t`; that of `chord` where it has none.
    fn direction_at(&self, t: f64, chord: Vector2<f64>) -> Vector2<f64> {
        let rate = match *self {
            Self::Quadratic([start, control, end]) => (control - start) * (1.0 - t) + (end - control) * t,
            Self::Cubic([start, first, second, end]) => {
                let rest = 1.0 - t;
                (first - start) * (rest * rest)
                    + (second - first) * (2.0 * rest * t)
                    + (end - second) * (t * t)
            }
        };
        rate.try_normalize(1e-9).or_else(|| chord.try_normalize(0.0)).unwrap_or_else(Vector2::x)
    }

    /// The length along the curve, to about `tolerance`.
    pub fn length(&self, tolerance: Mm) -> Mm {
        chords_length(self.start(), &self.linearised(tolerance))
    }
}

/// A part of a curve: an arc, or a line.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CurveArc {
    /// Where it ends.
    pub end: Point,
    /// The centre of an arc, and whether it turns counter-clockwise.
    pub centre: Option<(Point, bool)>,
}

/// Where two arcs meet that leave one point and arrive at another, each going equally far along its direction.
fn joint(from: Point, leaves: Vector2<f64>, to: Point, arrives: Vector2<f64>) -> Point {
    let way = to - from;
    let along = way.dot(&(leaves + arrives));
    let apart = 2.0 * (1.0 - leaves.dot(&arrives));
    let far = if apart > 1e-12 {
        ((along * along + apart * way.norm_squared()).sqrt() - along) / apart
    } else if along.abs() > 0.0 {
        way.norm_squared() / (2.0 * along)
    } else {
        0.0
    };
    Point::from((from.coords + to.coords + (leaves - arrives) * far) / 2.0)
}

/// The arc that runs in a direction at one point, and has its other end at another point, which becomes its end here.
fn touching(from: Point, direction: Vector2<f64>, end: Point) -> CurveArc {
    let left = Vector2::new(-direction.y, direction.x);
    let way = end - from;
    let beside = way.dot(&left);
    let radius = way.norm_squared() / (2.0 * beside);
    // What hardly bends is a line.
    let centre = (radius.abs() < STRAIGHT).then(|| (from + left * radius, beside > 0.0));
    CurveArc { end, centre }
}

/// Why numbers do not make a NURBS.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum NurbsError {
    /// The order is below 2 or above [`MAX_ORDER`].
    Order(usize),
    /// A curve needs at least as many control points as its order.
    TooFewPoints {
        /// The order.
        needed: usize,
        /// How many there are.
        got: usize,
    },
    /// The weight of this control point (counted from 0) is zero, negative, infinite or unknown.
    Weight(usize),
    /// The number of knots must be the number of control points plus the order.
    KnotCount {
        /// How many there must be.
        needed: usize,
        /// How many there are.
        got: usize,
    },
    /// Knots must be finite and must not fall, and between the ends they must rise.
    Knots,
}

impl std::fmt::Display for NurbsError {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Order(order) => write!(f, "order {order} is not between 2 and {MAX_ORDER}"),
            Self::TooFewPoints { needed, got } => {
                write!(f, "{got} control points, at least {needed} are needed")
            }
            Self::Weight(index) => write!(f, "the weight of control point {index} is not positive"),
            Self::KnotCount { needed, got } => write!(f, "{got} knots, {needed} are needed"),
            Self::Knots => write!(f, "the knots do not rise"),
        }
    }
}

impl std::error::Error for NurbsError {}

/// A control point of a NURBS.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ControlPoint {
    /// Where it is.
    pub point: Point,
    /// How strongly it pulls: greater than 0, 1 for all alike.
    pub weight: f64,
}

/// A non-uniform rational B-spline.
#[derive(Debug, Clone, PartialEq)]
pub struct Nurbs {
    order: usize,
    points: Vec<ControlPoint>,
    knots: Vec<f64>,
}

impl Nurbs {
    /// The curve that starts at the first control point and ends at the last, with knots one apart between.
    ///
    /// # Errors
    /// [`NurbsError::Order`], [`NurbsError::TooFewPoints`], [`NurbsError::Weight`].
    pub fn clamped(order: usize, points: Vec<ControlPoint>) -> Result<Self, NurbsError> {
        let spans = (points.len() + 1).saturating_sub(order);
        let mut knots = Vec::new();
        if (2..=MAX_ORDER).contains(&order) {
            knots.resize(order, 0.0);
            let mut knot = 0.0;
            for _ in 1..spans {
                knot += 1.0;
                knots.push(knot);
            }
            knots.resize(points.len() + order, knot + 1.0);
        }
        Self::with_knots(order, points, knots)
    }

    /// The curve over knots that are given; it is defined from knot number `order - 1` to knot number
    /// `points.len()`, counted from 0.
    ///
    /// # Errors
    /// See [`NurbsError`].
    pub fn with_knots(order: usize, points: Vec<ControlPoint>, knots: Vec<f64>) -> Result<Self, NurbsError> {
        if !(2..=MAX_ORDER).contains(&order) {
            return Err(NurbsError::Order(order));
        }
        if points.len() < order {
            return Err(NurbsError::TooFewPoints { needed: order, got: points.len() });
        }
        if let Some(index) = points.iter().position(|point| !(point.weight > 0.0 && point.weight.is_finite()))
        {
            return Err(NurbsError::Weight(index));
        }
        if knots.len() != points.len() + order {
            return Err(NurbsError::KnotCount { needed: points.len() + order, got: knots.len() });
        }
        let curve = Self { order, points, knots };
        let (from, to) = curve.range();
        if !curve.knots.is_sorted() || !curve.knots.iter().all(|knot| knot.is_finite()) || from >= to {
            return Err(NurbsError::Knots);
        }
        Ok(curve)
    }

    /// The first and the last parameter.
    pub fn range(&self) -> (f64, f64) {
        (self.knot(self.order - 1), self.knot(self.points.len()))
    }

    /// The point at a parameter, which is moved into the [`range`](Self::range); by de Boor's algorithm.
    pub fn point_at(&self, parameter: f64) -> Point {
        let (from, to) = self.range();
        let parameter = parameter.clamp(from, to);
        // The last knot span that is not empty and starts at or before the parameter.
        let end = self.knots.partition_point(|knot| *knot <= parameter).min(self.points.len());
        let last_start = self.knots.partition_point(|knot| *knot < to);
        let span = end.min(last_start).saturating_sub(1).max(self.order - 1);
        unweighted(self.blossom(span, |_| parameter))
    }

    /// The ends of chords within `tolerance` of the curve, the start left out.
    pub fn linearised(&self, tolerance: Mm) -> Vec<Point> {
        let degree = self.order - 1;
        let mut ends = Vec::new();
        for span in degree..self.points.len() {
            let (from, to) = (self.knot(span), self.knot(span + 1));
            if from < to {
                // The span as a Bézier curve: the blossom at more and more of the span's end.
                let points = (0..=degree)
                    .map(|ends| self.blossom(span, |level| if level <= ends { to } else { from }));
                ends.extend(flatten(points.collect(), tolerance));
            }
        }
        ends
    }

    /// De Boor's scheme over a knot span with a parameter of its own for each level (1 to the degree): weighted
    /// coordinates and the weight. The same parameter throughout gives the point of the curve.
    fn blossom(&self, span: usize, parameter: impl Fn(usize) -> f64) -> [f64; 3] {
        let degree = self.order - 1;
        let mut row = [[0.0_f64; 3]; MAX_ORDER];
        for (entry, control) in row.iter_mut().zip(self.points.iter().skip(span - degree).take(self.order)) {
            *entry = weighted(control.point, control.weight);
        }
        for level in 1..=degree {
            for index in (level..=degree).rev() {
                let low = self.knot(span - degree + index);
                let high = self.knot(span + 1 + index - level);
                let part = if high > low { (parameter(level) - low) / (high - low) } else { 0.0 };
                let before = row.get(index - 1).copied().unwrap_or_default();
                if let Some(entry) = row.get_mut(index) {
                    *entry = mixed(before, *entry, part);
                }
            }
        }
        row.get(degree).copied().unwrap_or_default()
    }

    /// The length along the curve, to about `tolerance`.
    pub fn length(&self, tolerance: Mm) -> Mm {
        chords_length(self.point_at(self.range().0), &self.linearised(tolerance))
    }

    fn knot(&self, index: usize) -> f64 {
        self.knots.get(index).copied().unwrap_or(f64::NAN)
    }
}

/// The point at the part `t` of the way.
fn between(from: Point, to: Point, t: f64) -> Point {
    from + (to - from) * t
}

fn weighted(point: Point, weight: f64) -> [f64; 3] {
    [point.x * weight, point.y * weight, weight]
}

fn unweighted([x, y, weight]: [f64; 3]) -> Point {
    Point::new(x / weight, y / weight)
}

fn mixed(from: [f64; 3], to: [f64; 3], part: f64) -> [f64; 3] {
    let ([x, y, weight], [to_x, to_y, to_weight]) = (from, to);
    let mix = |from: f64, to: f64| from * (1.0 - part) + to * part;
    [mix(x, to_x), mix(y, to_y), mix(weight, to_weight)]
}

/// The ends of chords within `tolerance` of the Bézier curve with these weighted control points.
///
/// A Bézier curve with positive weights never leaves the hull of its control points, so a chord is near enough when they
/// all are; no bend can hide between samples.
fn flatten(points: Vec<[f64; 3]>, tolerance: Mm) -> Vec<Point> {
    let mut ends = Vec::new();
    // What is still to do, the nearest piece last; a stack of its own keeps the depth off the call stack.
    let mut pieces = vec![(points, 0)];
    while let Some((points, halvings)) = pieces.pop() {
        let (Some(start), Some(end)) = (points.first(), points.last()) else { continue };
        let (start, end) = (unweighted(*start), unweighted(*end));
        let chord = Edge::line(start, end);
        let off = points.iter().map(|point| chord.distance_to(unweighted(*point)));
        // A distance that is not a finite number cannot be fixed by halving: such a curve is one chord.
        let bulges = tolerance > Mm::ZERO
            && off.clone().all(f64::is_finite)
            && off.clone().any(|off| Mm(off) > tolerance);
        if bulges && halvings < MAX_HALVINGS {
            let (first, second) = halved(points);
            pieces.push((second, halvings + 1));
            pieces.push((first, halvings + 1));
        } else {
            ends.push(end);
        }
    }
    ends
}

/// The control points of the two halves of a Bézier curve, by de Casteljau's algorithm.
fn halved(mut points: Vec<[f64; 3]>) -> (Vec<[f64; 3]>, Vec<[f64; 3]>) {
    let mut first = Vec::with_capacity(points.len());
    let mut second = Vec::with_capacity(points.len());
    while let (Some(start), Some(end)) = (points.first().copied(), points.last().copied()) {
        first.push(start);
        second.push(end);
        points = points.iter().zip(points.iter().skip(1)).map(|(from, to)| mixed(*from, *to, 0.5)).collect();
    }
    second.reverse();
    (first, second)
}

fn chords_length(start: Point, ends: &[Point]) -> Mm {
    let starts = std::iter::once(&start).chain(ends);
    Mm(starts.zip(ends).map(|(from, to)| (to - from).norm()).sum())
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    fn p(x: f64, y: f64) -> Point {
        Point::new(x, y)
    }

    fn even(points: &[(f64, f64)]) -> Vec<ControlPoint> {
        points.iter().map(|(x, y)| ControlPoint { point: p(*x, *y), weight: 1.0 }).collect()
    }

    /// The arcs follow each other without a corner, along the curve and from its start to its end.
    #[test]
    fn arcs_of_a_curve_touch_each_other_and_the_curve() {
        let at = |x: f64, y: f64| Point::new(x, y);
        let curves = [
            Bezier::Quadratic([at(0.0, 0.0), at(8.0, 8.0), at(16.0, 0.0)]),
            Bezier::Cubic([at(0.0, 0.0), at(5.0, 10.0), at(20.0, 10.0), at(25.0, 0.0)]),
            // It bends to the left and then to the right.
            Bezier::Cubic([at(0.0, 0.0), at(10.0, 0.0), at(0.0, 20.0), at(10.0, 20.0)]),
            // The start is a control point of its own.
            Bezier::Cubic([at(0.0, 0.0), at(0.0, 0.0), at(50.0, 90.0), at(200.0, 0.0)]),
        ];
        for curve in curves {
            let arcs = curve.arcs(Mm(0.01));
            let mut from = curve.start();
            let mut before: Option<Vector2<f64>> = None;
            for arc in &arcs {
                let direction = |point: Point| match arc.centre {
                    Some((centre, counter_clockwise)) => {
                        let out = (point - centre).normalize();
                        Vector2::new(-out.y, out.x) * if counter_clockwise { 1.0 } else { -1.0 }
                    }
                    None => (arc.end - from).normalize(),
                };
                if let Some((centre, _)) = arc.centre {
                    assert!(((from - centre).norm() - (arc.end - centre).norm()).abs() < 1e-6, "{arc:?}");
                }
                if let Some(before) = before {
                    assert!((direction(from) - before).norm() < 1e-4, "{curve:?}: {arc:?}");
                }
                before = Some(direction(arc.end));
                from = arc.end;
            }
            assert_eq!(from, curve.end());
            let nearest = |point: Point| {
                let points = (0..=4_000).map(|part| curve.point_at(f64::from(part) / 4_000.0));
                points.map(|on| (on - point).norm()).fold(f64::INFINITY, f64::min)
            };
            assert!(arcs.iter().all(|arc| nearest(arc.end) < 0.05), "{curve:?}");
        }
    }

    #[test]
    fn arcs_of_a_curve_that_is_not_known_end() {
        let unknown = Point::new(f64::NAN, 0.0);
        let curve = Bezier::Quadratic([Point::origin(), unknown, Point::new(1.0, 0.0)]);
        assert_eq!(curve.arcs(Mm(0.01)).last().unwrap().end, Point::new(1.0, 0.0));
        let nowhere = Bezier::Quadratic([Point::origin(); 3]);
        assert!(nowhere.arcs(Mm(0.01)).iter().all(|arc| arc.centre.is_none() && arc.end == Point::origin()));
    }

    #[test]
    fn a_bezier_starts_and_ends_at_its_ends() {
        let curve = Bezier::Cubic([p(0.0, 0.0), p(0.0, 3.0), p(1.0, -2.0), p(1.0, 1.0)]);
        assert_eq!((curve.point_at(0.0), curve.point_at(1.0)), (p(0.0, 0.0), p(1.0, 1.0)));
        assert_eq!(curve.point_at(0.5), p(0.5, 0.5));
        let parabola = Bezier::Quadratic([p(-2.0, 4.0), p(0.0, -4.0), p(2.0, 4.0)]);
        assert_eq!(parabola.point_at(0.75), p(1.0, 1.0));
        // y = x^2 from -2 to 2: sqrt(17) * 2 + asinh(4) / 2.
        let exact = 2.0 * 17.0_f64.sqrt() + 4.0_f64.asinh() / 2.0;
        assert!(parabola.length(Mm(1e-6)).is_near(Mm(exact), Mm(1e-4)));
    }

    #[test]
    fn an_s_that_passes_the_middle_of_its_chord_is_no_line() {
        let curve = Bezier::Cubic([p(0.0, 0.0), p(0.0, 10.0), p(10.0, -10.0), p(10.0, 0.0)]);
        assert!(curve.linearised(Mm(0.01)).len() > 8);
        assert_eq!(curve.linearised(Mm(0.01)).last(), Some(&p(10.0, 0.0)));
    }

    #[test]
    fn a_weighted_corner_is_a_quarter_circle() {
        let weight = std::f64::consts::FRAC_1_SQRT_2;
        let mut points = even(&[(1.0, 0.0), (1.0, 1.0), (0.0, 1.0)]);
        points[1].weight = weight;
        let quarter = Nurbs::clamped(3, points).unwrap();
        assert_eq!(quarter.range(), (0.0, 1.0));
        for i in 0..=20 {
            assert!((quarter.point_at(f64::from(i) / 20.0).coords.norm() - 1.0).abs() < 1e-12);
        }
        assert!(quarter.length(Mm(1e-7)).is_near(Mm(std::f64::consts::FRAC_PI_2), Mm(1e-5)));
    }

    #[test]
    fn a_nurbs_of_order_two_is_its_polygon() {
        let polygon = Nurbs::clamped(2, even(&[(0.0, 0.0), (4.0, 0.0), (4.0, 2.0)])).unwrap();
        assert_eq!(polygon.point_at(0.5), p(2.0, 0.0));
        assert_eq!(polygon.point_at(1.0), p(4.0, 0.0));
        assert_eq!(polygon.point_at(1.5), p(4.0, 1.0));
        assert_eq!(polygon.point_at(99.0), p(4.0, 2.0));
        assert!(polygon.length(Mm(0.001)).is_near(Mm(6.0), Mm(1e-12)));
    }

    #[test]
    fn what_makes_no_curve_is_refused() {
        let three = || even(&[(0.0, 0.0), (1.0, 1.0), (2.0, 0.0)]);
        assert_eq!(Nurbs::clamped(1, three()), Err(NurbsError::Order(1)));
        assert_eq!(Nurbs::clamped(4, three()), Err(NurbsError::TooFewPoints { needed: 4, got: 3 }));
        assert_eq!(Nurbs::clamped(usize::MAX, three()), Err(NurbsError::Order(usize::MAX)));
        let mut weightless = three();
        weightless[1].weight = 0.0;
        assert_eq!(Nurbs::clamped(3, weightless), Err(NurbsError::Weight(1)));
        assert_eq!(
            Nurbs::with_knots(3, three(), vec![0.0; 5]),
            Err(NurbsError::KnotCount { needed: 6, got: 5 })
        );
        assert_eq!(Nurbs::with_knots(3, three(), vec![0.0; 6]), Err(NurbsError::Knots));
        assert_eq!(Nurbs::with_knots(3, three(), vec![0.0, 0.0, 1.0, 0.5, 2.0, 2.0]), Err(NurbsError::Knots));
    }

    fn some_controls() -> impl Strategy<Value = Vec<ControlPoint>> {
        let control = (-100.0..100.0_f64, -100.0..100.0_f64, 0.1..10.0_f64)
            .prop_map(|(x, y, weight)| ControlPoint { point: p(x, y), weight });
        prop::collection::vec(control, 4..12)
    }

    proptest! {
        #[test]
        fn four_even_points_of_order_four_are_a_bezier(
            numbers in prop::array::uniform8(-100.0..100.0_f64), t in 0.0..=1.0_f64,
        ) {
            let [a, b, c, d, e, f, g, h] = numbers;
            let bezier = Bezier::Cubic([p(a, b), p(c, d), p(e, f), p(g, h)]);
            let nurbs = Nurbs::clamped(4, even(&[(a, b), (c, d), (e, f), (g, h)])).unwrap();
            prop_assert!((bezier.point_at(t) - nurbs.point_at(t)).norm() < 1e-9);
        }

        #[test]
        fn a_clamped_curve_runs_from_first_to_last_within_the_box_of_its_points(
            points in some_controls(), order in 2..5_usize, t in 0.0..=1.0_f64,
        ) {
            let curve = Nurbs::clamped(order, points.clone()).unwrap();
            let (from, to) = curve.range();
            prop_assert!((curve.point_at(from) - points[0].point).norm() < 1e-9);
            prop_assert!((curve.point_at(to) - points[points.len() - 1].point).norm() < 1e-9);
            let bounds = crate::Bounds::of(points.iter().map(|control| [control.point.x, control.point.y]));
            let point = curve.point_at(from + (to - from) * t);
            prop_assert!(bounds.grown(1e-9).contains(&[point.x, point.y]));
        }

        #[test]
        fn chords_keep_the_tolerance(points in some_controls(), order in 3..5_usize) {
            let curve = Nurbs::clamped(order, points).unwrap();
            let (from, to) = curve.range();
            let mut edges = Vec::new();
            let mut last = curve.point_at(from);
            for point in curve.linearised(Mm(0.05)) {
                edges.push(Edge::line(last, point));
                last = point;
            }
            for i in 0..=200 {
                let point = curve.point_at(from + (to - from) * f64::from(i) / 200.0);
                let distance = edges.iter().map(|edge| edge.distance_to(point)).fold(f64::MAX, f64::min);
                prop_assert!(distance <= 0.05 + 1e-9, "{distance}");
            }
        }

        #[test]
        fn nothing_panics(
            numbers in prop::collection::vec((prop::num::f64::ANY, prop::num::f64::ANY, prop::num::f64::ANY), 0..6),
            knots in prop::collection::vec(prop::num::f64::ANY, 0..9), order in 0..8_usize, t in prop::num::f64::ANY,
        ) {
            let points: Vec<_> = numbers.iter().map(|(x, y, weight)| ControlPoint { point: p(*x, *y), weight: *weight }).collect();
            let mut sorted = knots;
            sorted.sort_by(f64::total_cmp);
            let curves = [Nurbs::clamped(order, points.clone()), Nurbs::with_knots(order, points, sorted)];
            for curve in curves.into_iter().flatten() {
                let _ = (curve.point_at(t), curve.linearised(Mm(1.0)));
            }
        }
    }
}
