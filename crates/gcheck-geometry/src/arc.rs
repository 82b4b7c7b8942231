//! Circular, helical and slightly spiral arcs in a main plane.
//!
//! Knows how an arc follows from its ends and a centre or a radius, and what cannot be one.
//! Must not know how a program gives them, nor which tolerance a control applies: [`ArcTolerance`] is data.
//!
//! An unknown number is not a fault: an arc made from one is unknown in what depends on it ([`Arc::is_known`]), and
//! every answer about that is unknown too.

use std::f64::consts::{FRAC_PI_2, PI, SQRT_2, TAU};

use nalgebra::Vector3;

use crate::bounds::Bounds;
use crate::plane::Plane;
use crate::units::Mm;

/// No arc is cut into more chords than this, however small the tolerance: memory stays bounded.
pub const MAX_CHORDS: u32 = 1 << 20;

/// Directions from the centre that differ by less, in radians, are one direction: the arc between them is a whole turn.
const SAME_DIRECTION: f64 = 1e-9;

/// The way around the centre, seen with the plane's normal pointing at the eye.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum ArcDirection {
    /// Clockwise.
    Cw,
    /// Counter-clockwise: from the plane's first axis to its second.
    Ccw,
}

impl ArcDirection {
    /// The other way round.
    #[must_use]
    pub const fn reversed(self) -> Self {
        match self {
            Self::Cw => Self::Ccw,
            Self::Ccw => Self::Cw,
        }
    }

    /// +1 for counter-clockwise, -1 for clockwise.
    pub const fn sign(self) -> f64 {
        match self {
            Self::Cw => -1.0,
            Self::Ccw => 1.0,
        }
    }
}

/// How far the numbers of an arc may disagree before a control refuses it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ArcTolerance {
    /// Centre form: the radii at start and end may always differ by this much.
    pub absolute: Mm,
    /// Centre form: the radii may never differ by more than this.
    pub hard: Mm,
    /// Centre form: between `absolute` and `hard` the radii may differ by this part of the larger one.
    pub relative: f64,
    /// Radius form: half the chord may exceed the radius by this much; the arc is then a half circle on the chord.
    pub radius_slack: Mm,
    /// Centre form: a smaller radius is none.
    pub zero: Mm,
    /// Start and end are one point of the plane when they are not further apart.
    pub coincident: Mm,
}

impl ArcTolerance {
    /// Takes whatever has a direction: for arcs that were checked before or that were computed.
    pub const ANY: Self = Self {
        absolute: Mm(f64::INFINITY),
        hard: Mm(f64::INFINITY),
        relative: f64::INFINITY,
        radius_slack: Mm(f64::INFINITY),
        zero: Mm::ZERO,
        coincident: Mm::ZERO,
    };

    /// The rule of the interpreter that the engine is measured against (LinuxCNC 2.9, bisected by running it) while
    /// the program is in millimetres: radii 0.0283 mm apart pass; above, they may differ by 0.1 %, up to 2.83 mm; a
    /// chord may be 0.00254 mm longer than the diameter; a centre nearer than 0.00127 mm is refused; start and end
    /// are one point when their numbers are equal.
    pub const REFERENCE_METRIC: Self = Self {
        absolute: Mm(0.02 * SQRT_2),
        hard: Mm(2.0 * SQRT_2),
        relative: 0.001,
        radius_slack: Mm(0.001_27),
        zero: Mm(0.001_27),
        coincident: Mm::ZERO,
    };

    /// The same interpreter's rule while the program is in inches. It is not the metric one converted: the ends may be
    /// 0.00283 inch off, or 0.1 % up to 0.283 inch; radius slack and smallest radius are 0.00005 inch.
    pub const REFERENCE_INCH: Self = Self {
        absolute: Mm::from_inch(0.002 * SQRT_2),
        hard: Mm::from_inch(0.2 * SQRT_2),
        relative: 0.001,
        radius_slack: Mm::from_inch(0.000_05),
        zero: Mm::from_inch(0.000_05),
        coincident: Mm::ZERO,
    };
}

/// Why numbers do not make an arc.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum ArcError {
    /// The centre lies on the start or on the end, or the radius that was given is zero.
    ZeroRadius,
    /// No circle of the radius reaches both ends.
    RadiusTooSmall {
        /// Half the distance from start to end in the plane: the smallest radius that reaches.
        half_chord: Mm,
        /// The size of the radius that was given.
        radius: Mm,
    },
    /// The end does not lie on the circle around the centre through the start.
    OffCircle {
        /// Distance from the centre to the start, in the plane.
        start_radius: Mm,
        /// Distance from the centre to the end, in the plane.
        end_radius: Mm,
    },
    /// Start and end are one point of the plane: a radius alone says nothing about where the centre is.
    EndIsStart,
}

impl std::fmt::Display for ArcError {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::ZeroRadius => write!(f, "the arc has no radius"),
            Self::RadiusTooSmall { half_chord, radius } => {
                write!(f, "radius {} mm does not reach the end: at least {} mm", radius.0, half_chord.0)
            }
            Self::OffCircle { start_radius, end_radius } => {
                write!(f, "radius {} mm at the start, {} mm at the end", start_radius.0, end_radius.0)
            }
            Self::EndIsStart => write!(f, "start and end of an arc by radius are one point"),
        }
    }
}

impl std::error::Error for ArcError {}

/// An arc in a plane; a helix where the ends differ along the normal, a spiral where their radii differ.
///
/// Radius and the coordinate along the normal change evenly with the angle from start to end.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Arc {
    plane: Plane,
    start: [Mm; 3],
    end: [Mm; 3],
    centre: (Mm, Mm),
    sweep: f64,
    /// Direction of the start from the centre, radians.
    start_angle: f64,
    start_radius: Mm,
    end_radius: Mm,
}

impl Arc {
    /// The arc around `centre` (first and second coordinate of the plane) from `start` to `end` (X, Y, Z).
    ///
    /// `turns` counts how often the end's direction is reached: 1 for an ordinary arc, and n adds n - 1 whole turns;
    /// 0 is read as 1. An end in the direction of the start is reached after a whole turn.
    ///
    /// # Errors
    /// [`ArcError::ZeroRadius`], [`ArcError::OffCircle`].
    pub fn by_centre(
        plane: Plane,
        start: [Mm; 3],
        end: [Mm; 3],
        centre: (Mm, Mm),
        direction: ArcDirection,
        turns: u32,
        tolerance: &ArcTolerance,
    ) -> Result<Self, ArcError> {
        let (from, _) = from_centre(plane, start, centre);
        let (to, _) = from_centre(plane, end, centre);
        let (start_radius, end_radius) = (length(from), length(to));
        if start_radius < tolerance.zero
            || end_radius < tolerance.zero
            || is_zero(start_radius)
            || is_zero(end_radius)
        {
            return Err(ArcError::ZeroRadius);
        }
        let difference = (start_radius - end_radius).abs();
        let relative = difference / start_radius.max(end_radius);
        if difference > tolerance.hard || (difference > tolerance.absolute && relative > tolerance.relative) {
            return Err(ArcError::OffCircle { start_radius, end_radius });
        }
        let same = SAME_DIRECTION.max(tolerance.coincident / start_radius.max(end_radius));
        let sweep = sweep_between(from, to, direction, turns, same);
        Ok(Self::from_parts(plane, start, end, centre, sweep))
    }

    /// The arc of a radius from `start` to `end` (X, Y, Z): at most half a turn for a positive `radius`, at least
    /// half a turn for a negative one. `turns` as in [`by_centre`](Self::by_centre).
    ///
    /// # Errors
    /// [`ArcError::ZeroRadius`], [`ArcError::RadiusTooSmall`], [`ArcError::EndIsStart`].
    pub fn by_radius(
        plane: Plane,
        start: [Mm; 3],
        end: [Mm; 3],
        radius: Mm,
        direction: ArcDirection,
        turns: u32,
        tolerance: &ArcTolerance,
    ) -> Result<Self, ArcError> {
        let [start_first, start_second, _] = plane.to_local(start);
        let [end_first, end_second, _] = plane.to_local(end);
        let chord = (end_first - start_first, end_second - start_second);
        let half_chord = length(chord) * 0.5;
        let size = radius.abs();
        if half_chord * 2.0 <= tolerance.coincident {
            return Err(ArcError::EndIsStart);
        }
        if is_zero(size) {
            return Err(ArcError::ZeroRadius);
        }
        if half_chord > size + tolerance.radius_slack {
            return Err(ArcError::RadiusTooSmall { half_chord, radius: size });
        }
        // How far the centre is from the chord; to the left of the chord for a short counter-clockwise arc. An unknown
        // radius must stay unknown, so no `f64::max`.
        let square = (size.0 - half_chord.0) * (size.0 + half_chord.0);
        let stand_off = if square < 0.0 { 0.0 } else { square.sqrt() };
        let left = if radius.0 < 0.0 { -direction.sign() } else { direction.sign() } * stand_off
            / (2.0 * half_chord.0);
        let centre =
            (start_first + chord.0 * 0.5 - chord.1 * left, start_second + chord.1 * 0.5 + chord.0 * left);
        let (from, _) = from_centre(plane, start, centre);
        let (to, _) = from_centre(plane, end, centre);
        let mut sweep = sweep_between(from, to, direction, turns, 0.0);
        // The centre of a half circle is the middle of the chord; its last bit must not turn 180 degrees into
        // less for a long arc, or more for a short one.
        let one_pass = sweep % TAU;
        if stand_off <= 0.0 {
            sweep += direction.sign() * PI - one_pass;
        }
        Ok(Self::from_parts(plane, start, end, centre, sweep))
    }

    /// The arc with everything given; `sweep` in radians, counter-clockwise positive. Nothing is checked: the
    /// direction of the end is taken from the sweep, its radius from the end.
    pub fn from_parts(plane: Plane, start: [Mm; 3], end: [Mm; 3], centre: (Mm, Mm), sweep: f64) -> Self {
        let (from, _) = from_centre(plane, start, centre);
        let (to, _) = from_centre(plane, end, centre);
        Self {
            plane,
            start,
            end,
            centre,
            sweep,
            start_angle: from.1.0.atan2(from.0.0),
            start_radius: length(from),
            end_radius: length(to),
        }
    }

    /// The plane in which the arc turns.
    pub fn plane(&self) -> Plane {
        self.plane
    }

    /// Where it starts: X, Y, Z.
    pub fn start(&self) -> [Mm; 3] {
        self.start
    }

    /// Where it ends: X, Y, Z.
    pub fn end(&self) -> [Mm; 3] {
        self.end
    }

    /// The centre: first and second coordinate of the plane.
    pub fn centre(&self) -> (Mm, Mm) {
        self.centre
    }

    /// The centre on the level of the start: X, Y, Z.
    pub fn centre_xyz(&self) -> [Mm; 3] {
        let [_, _, normal] = self.plane.to_local(self.start);
        self.plane.to_xyz([self.centre.0, self.centre.1, normal])
    }

    /// The angle passed, in radians; counter-clockwise positive, whole turns included.
    pub fn sweep(&self) -> f64 {
        self.sweep
    }

    /// The way around the centre.
    pub fn direction(&self) -> ArcDirection {
        if self.sweep < 0.0 { ArcDirection::Cw } else { ArcDirection::Ccw }
    }

    /// Distance from the centre to the start, in the plane.
    pub fn radius(&self) -> Mm {
        self.start_radius
    }

    /// Distance from the centre to the end, in the plane.
    pub fn end_radius(&self) -> Mm {
        self.end_radius
    }

    /// The way along the plane's normal from start to end.
    pub fn rise(&self) -> Mm {
        let [_, _, low] = self.plane.to_local(self.start);
        let [_, _, high] = self.plane.to_local(self.end);
        high - low
    }

    /// Whether the path in the plane is known; the third coordinate may still be unknown.
    pub fn is_known(&self) -> bool {
        self.sweep.is_finite()
            && self.start_angle.is_finite()
            && self.start_radius.is_finite()
            && self.end_radius.is_finite()
    }

    /// Length in the plane. Exact for a circle; with unequal radii, of a circle of the mean radius with the
    /// difference as rise, which is closer than the tolerances of controls by orders of magnitude.
    pub fn plane_length(&self) -> Mm {
        let mean = self.start_radius.0.midpoint(self.end_radius.0);
        Mm((mean * self.sweep).hypot(self.end_radius.0 - self.start_radius.0))
    }

    /// Length of the path, the way along the normal included. Exact for circle and helix; see
    /// [`plane_length`](Self::plane_length).
    pub fn length(&self) -> Mm {
        Mm(self.plane_length().0.hypot(self.rise().0))
    }

    /// The point (X, Y, Z) at the part `t` of the angle: 0 is the start, 1 the end, others are moved to these.
    pub fn point_at(&self, t: f64) -> [Mm; 3] {
        if t <= 0.0 {
            return self.start;
        }
        if t >= 1.0 {
            return self.end;
        }
        let radius = self.start_radius.0 + (self.end_radius.0 - self.start_radius.0) * t;
        let (sin, cos) = (self.start_angle + self.sweep * t).sin_cos();
        let [_, _, normal] = self.plane.to_local(self.start);
        self.plane.to_xyz([
            self.centre.0 + Mm(radius * cos),
            self.centre.1 + Mm(radius * sin),
            normal + self.rise() * t,
        ])
    }

    /// The direction of the path, of length 1, at the part `t` of the angle (moved into 0 to 1), rise included;
    /// not a number where it is unknown.
    pub fn tangent_at(&self, t: f64) -> Vector3<f64> {
        let t = t.clamp(0.0, 1.0);
        let widening = self.end_radius.0 - self.start_radius.0;
        let radius = self.start_radius.0 + widening * t;
        let (sin, cos) = (self.start_angle + self.sweep * t).sin_cos();
        let local = [
            widening * cos - radius * self.sweep * sin,
            widening * sin + radius * self.sweep * cos,
            self.rise().0,
        ];
        let [x, y, z] = self.plane.to_xyz(local);
        Vector3::new(x, y, z).normalize()
    }

    /// The direction in which the arc leaves its start; see [`tangent_at`](Self::tangent_at).
    pub fn start_tangent(&self) -> Vector3<f64> {
        self.tangent_at(0.0)
    }

    /// The direction in which the arc reaches its end; see [`tangent_at`](Self::tangent_at).
    pub fn end_tangent(&self) -> Vector3<f64> {
        self.tangent_at(1.0)
    }

    /// The same path from end to start.
    #[must_use]
    pub fn reversed(&self) -> Self {
        Self::from_parts(self.plane, self.end, self.start, self.centre, -self.sweep)
    }

    /// The smallest box (X, Y, Z) around the path. Axes of the plane are marked unknown when the arc is.
    pub fn bounds(&self) -> Bounds {
        let numbers = |point: [Mm; 3]| point.map(Mm::get);
        let mut bounds = Bounds::of([numbers(self.start), numbers(self.end)]);
        if !self.is_known() {
            let (first, second, _) = self.plane.axes();
            bounds.include_unknown_on(first);
            bounds.include_unknown_on(second);
            return bounds;
        }
        for t in self.extremes() {
            bounds.include(&numbers(self.point_at(t)));
        }
        bounds
    }

    /// The parts of the angle at which a coordinate of the plane turns back.
    fn extremes(&self) -> impl Iterator<Item = f64> + use<> {
        let arc = *self;
        let per_radian = (arc.end_radius.0 - arc.start_radius.0) / arc.sweep;
        // The widest turn of a spiral is its first or its last one: five quadrants from either end are enough.
        let from_start = (arc.start_angle / FRAC_PI_2).floor();
        let from_end = ((arc.start_angle + arc.sweep) / FRAC_PI_2).floor();
        (-5..=5).flat_map(move |step| [from_start + f64::from(step), from_end + f64::from(step)]).filter_map(
            move |quadrant| {
                let axis_angle = quadrant * FRAC_PI_2;
                let mut t = (axis_angle - arc.start_angle) / arc.sweep;
                // Where the radius grows, a coordinate turns back behind the axis: tan(angle) = growth / radius.
                // Newton's steps on a function whose slope lies between 1 and 2 close in from anywhere.
                if per_radian.abs() > 0.0 {
                    for _ in 0..12 {
                        let radius =
                            arc.start_radius.0 + (arc.end_radius.0 - arc.start_radius.0) * t.clamp(0.0, 1.0);
                        let miss = arc.start_angle + arc.sweep * t - axis_angle - per_radian.atan2(radius);
                        let slope =
                            1.0 + per_radian * per_radian / (radius * radius + per_radian * per_radian);
                        t -= miss / slope / arc.sweep;
                    }
                }
                (0.0..=1.0).contains(&t).then_some(t)
            },
        )
    }

    /// How many equal chords keep within `tolerance` of the arc: at least 1, at most [`MAX_CHORDS`].
    /// A tolerance of zero, an unknown one and an unknown arc give 1.
    pub fn chord_count(&self, tolerance: Mm) -> u32 {
        let radius = self.start_radius.max(self.end_radius).0;
        let tolerated = tolerance.is_known() && tolerance > Mm::ZERO;
        if !self.is_known() || radius <= 0.0 || !tolerated {
            return 1;
        }
        // The height of a chord's segment is radius * (1 - cos(angle / 2)). Whatever the tolerance says, no chord
        // spans more than a quarter turn, or a circle would lose its shape.
        let angle = (2.0 * (1.0 - tolerance.0 / radius).clamp(-1.0, 1.0).acos()).min(FRAC_PI_2);
        let count = (self.sweep.abs() / angle).ceil();
        #[expect(clippy::cast_sign_loss, reason = "the count is at least 1 and at most MAX_CHORDS")]
        let count = count.clamp(1.0, f64::from(MAX_CHORDS)) as u32;
        count
    }

    /// The ends of `count` equal chords in order, the start left out; the last one is the end of the arc exactly.
    /// No more than [`MAX_CHORDS`].
    pub fn chords(&self, count: u32) -> impl ExactSizeIterator<Item = [Mm; 3]> + use<> {
        let arc = *self;
        let count = count.clamp(1, MAX_CHORDS);
        (0..count).map(move |done| arc.point_at((f64::from(done) + 1.0) / f64::from(count)))
    }

    /// The ends of chords that keep within `tolerance` of the arc; see [`chord_count`](Self::chord_count).
    pub fn linearised(&self, tolerance: Mm) -> impl ExactSizeIterator<Item = [Mm; 3]> + use<> {
        self.chords(self.chord_count(tolerance))
    }
}

/// A point seen from the centre in the plane, and its coordinate along the normal.
fn from_centre(plane: Plane, point: [Mm; 3], centre: (Mm, Mm)) -> ((Mm, Mm), Mm) {
    let [first, second, normal] = plane.to_local(point);
    ((first - centre.0, second - centre.1), normal)
}

fn length(vector: (Mm, Mm)) -> Mm {
    Mm(vector.0.0.hypot(vector.1.0))
}

fn is_zero(length: Mm) -> bool {
    length.abs() <= Mm::ZERO
}

/// The angle in radians of an arc of so many turns about a centre, counter-clockwise positive as `turns` is: one turn is a whole
/// one at most, and points in one direction are a whole turn apart.
pub fn sweep_about(centre: (Mm, Mm), from: (Mm, Mm), to: (Mm, Mm), turns: i32) -> f64 {
    let about = |point: (Mm, Mm)| (point.0 - centre.0, point.1 - centre.1);
    let direction = if turns < 0 { ArcDirection::Cw } else { ArcDirection::Ccw };
    sweep_between(about(from), about(to), direction, turns.unsigned_abs(), ONE_DIRECTION)
}

/// Directions that differ by less are one: radians. Computed ends of a circle differ by more than one rounding.
const ONE_DIRECTION: f64 = 1e-9;

/// The angle in radians from one direction to another; directions at most `same` apart are a whole turn apart.
fn sweep_between(from: (Mm, Mm), to: (Mm, Mm), direction: ArcDirection, turns: u32, same: f64) -> f64 {
    let (from, to) = ((from.0.0, from.1.0), (to.0.0, to.1.0));
    let angle = direction.sign() * (from.0 * to.1 - from.1 * to.0).atan2(from.0 * to.0 + from.1 * to.1);
    let one_pass = if angle.abs() <= same {
        TAU
    } else if angle < 0.0 {
        angle + TAU
    } else {
        angle
    };
    direction.sign() * (one_pass + f64::from(turns.saturating_sub(1)) * TAU)
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::ArcDirection::{Ccw, Cw};
    use super::*;

    const RULE: &ArcTolerance = &ArcTolerance::REFERENCE_METRIC;

    fn at(x: f64, y: f64, z: f64) -> [Mm; 3] {
        [Mm(x), Mm(y), Mm(z)]
    }

    fn centred(
        start: [Mm; 3],
        end: [Mm; 3],
        centre: (f64, f64),
        direction: ArcDirection,
        turns: u32,
    ) -> Result<Arc, ArcError> {
        Arc::by_centre(Plane::Xy, start, end, (Mm(centre.0), Mm(centre.1)), direction, turns, RULE)
    }

    fn of_radius(
        start: [Mm; 3],
        end: [Mm; 3],
        radius: f64,
        direction: ArcDirection,
    ) -> Result<Arc, ArcError> {
        Arc::by_radius(Plane::Xy, start, end, Mm(radius), direction, 1, RULE)
    }

    fn degrees(arc: &Arc) -> f64 {
        (arc.sweep().to_degrees() * 1e6).round() / 1e6
    }

    fn near(one: [Mm; 3], other: [Mm; 3]) -> bool {
        one.iter().zip(other).all(|(one, other)| one.is_near(other, Mm(1e-6)))
    }

    #[test]
    fn ends_on_either_side_of_the_jump_of_the_angle() {
        let centre = (Mm(20.0), Mm(0.0));
        for off in [-1e-13, 0.0, 1e-13] {
            for (turns, angle) in [(-1, -TAU), (1, TAU), (-3, -3.0 * TAU)] {
                let found = sweep_about(centre, (Mm(-4.0), Mm(off)), (Mm(-4.0), Mm(-off)), turns);
                assert!((found - angle).abs() < 1e-9, "{off} {turns}: {found}");
            }
        }
        let quarter = sweep_about(centre, (Mm(30.0), Mm(0.0)), (Mm(20.0), Mm(-10.0)), -2);
        assert!((quarter + 1.25 * TAU).abs() < 1e-12, "{quarter}");
    }

    #[test]
    fn a_quarter_circle_either_way() {
        let quarter = centred(at(10.0, 0.0, 0.0), at(0.0, 10.0, 0.0), (0.0, 0.0), Ccw, 1).unwrap();
        assert!((degrees(&quarter) - 90.0).abs() < 1e-9);
        assert!(quarter.length().is_near(Mm(5.0 * PI), Mm(1e-12)));
        let rest = centred(at(10.0, 0.0, 0.0), at(0.0, 10.0, 0.0), (0.0, 0.0), Cw, 1).unwrap();
        assert!((degrees(&rest) + 270.0).abs() < 1e-9);
        assert_eq!(rest.direction(), Cw);
    }

    #[test]
    fn an_end_at_the_start_is_a_whole_turn() {
        let circle = centred(at(10.0, 0.0, 0.0), at(10.0, 0.0, 0.0), (0.0, 0.0), Cw, 1).unwrap();
        assert!((degrees(&circle) + 360.0).abs() < 1e-9);
        let beside = centred(at(10.0, 0.0, 0.0), at(10.0, 1e-14, 0.0), (0.0, 0.0), Ccw, 1).unwrap();
        assert!((degrees(&beside) - 360.0).abs() < 1e-9);
    }

    #[test]
    fn turns_are_counted_by_passes_of_the_end() {
        let helix = centred(at(10.0, 0.0, 0.0), at(-10.0, 0.0, -6.0), (0.0, 0.0), Ccw, 3).unwrap();
        assert!((degrees(&helix) - 900.0).abs() < 1e-9);
        assert!(helix.length().is_near(Mm((50.0 * PI).hypot(6.0)), Mm(1e-9)));
        assert!(near(helix.point_at(0.5), at(0.0, 10.0, -3.0)));
        let circles = centred(at(10.0, 0.0, 0.0), at(10.0, 0.0, -6.0), (0.0, 0.0), Cw, 2).unwrap();
        assert!((degrees(&circles) + 720.0).abs() < 1e-9);
        let zero = centred(at(10.0, 0.0, 0.0), at(-10.0, 0.0, -6.0), (0.0, 0.0), Ccw, 0).unwrap();
        assert!((degrees(&zero) - 180.0).abs() < 1e-9);
    }

    #[test]
    fn the_other_planes_turn_about_their_normal() {
        // From +Z to +X is counter-clockwise seen from +Y.
        let arc =
            Arc::by_centre(Plane::Zx, at(0.0, 3.0, 5.0), at(5.0, 3.0, 0.0), (Mm(0.0), Mm(0.0)), Ccw, 1, RULE)
                .unwrap();
        assert!((degrees(&arc) - 90.0).abs() < 1e-9);
        assert!(near(arc.point_at(0.5), at(5.0 / 2.0_f64.sqrt(), 3.0, 5.0 / 2.0_f64.sqrt())));
        assert_eq!(arc.centre_xyz(), at(0.0, 3.0, 0.0));
        // From +Y to +Z is counter-clockwise seen from +X.
        let arc =
            Arc::by_centre(Plane::Yz, at(3.0, 5.0, 0.0), at(3.0, 0.0, 5.0), (Mm(0.0), Mm(0.0)), Ccw, 1, RULE)
                .unwrap();
        assert!((degrees(&arc) - 90.0).abs() < 1e-9);
    }

    #[test]
    fn a_positive_radius_takes_the_short_way_and_a_negative_one_the_long_way() {
        let (start, end) = (at(0.0, 0.0, 0.0), at(5.0, -5.0, 0.0));
        let short = of_radius(start, end, 5.0, Cw).unwrap();
        assert!((degrees(&short) + 90.0).abs() < 1e-6 && near(short.centre_xyz(), at(0.0, -5.0, 0.0)));
        let long = of_radius(start, end, -5.0, Cw).unwrap();
        assert!((degrees(&long) + 270.0).abs() < 1e-6 && near(long.centre_xyz(), at(5.0, 0.0, 0.0)));
        let other = of_radius(start, end, 5.0, Ccw).unwrap();
        assert!((degrees(&other) - 90.0).abs() < 1e-6 && near(other.centre_xyz(), at(5.0, 0.0, 0.0)));
    }

    /// Centres that `rs274` prints for the same arcs.
    #[test]
    fn centres_by_radius_are_those_of_the_interpreter() {
        let centre = |plane, start: [f64; 3], end: [f64; 3], radius, direction, turns| {
            let arc = Arc::by_radius(plane, start.map(Mm), end.map(Mm), Mm(radius), direction, turns, RULE)
                .unwrap();
            format!("{:.4} {:.4}", arc.centre().0.0, arc.centre().1.0)
        };
        let points = [
            [1.0, 2.0, 3.0],
            [4.0, 7.0, 5.0],
            [1.0, 2.0, 5.0],
            [-3.0, 9.0, 5.0],
            [1.0, 9.0, -4.0],
            [5.0, 3.0, 1.0],
            [5.0, -2.0, 9.0],
            [5.0, 3.0, 2.0],
        ];
        assert_eq!(centre(Plane::Xy, points[0], points[1], 4.0, Cw, 1), "4.8483 3.0910");
        assert_eq!(centre(Plane::Xy, points[1], points[2], -4.0, Ccw, 1), "0.1517 5.9090");
        assert_eq!(centre(Plane::Xy, points[2], points[3], 6.0, Cw, 2), "2.8586 7.7049");
        assert_eq!(centre(Plane::Zx, points[3], points[4], 8.0, Cw, 1), "3.0606 4.7614");
        assert_eq!(centre(Plane::Zx, points[4], points[5], -7.0, Ccw, 1), "2.3887 -1.8609");
        assert_eq!(centre(Plane::Yz, points[5], points[6], 9.0, Cw, 1), "6.9998 9.0624");
        assert_eq!(centre(Plane::Yz, points[6], points[7], -6.0, Ccw, 1), "-2.9041 3.0685");
    }

    #[test]
    fn a_half_circle_by_radius_is_180_degrees_whatever_the_last_bit() {
        for direction in [Cw, Ccw] {
            for radius in [5.0, -5.0, 4.999, -4.999] {
                for (x, y) in [(10.0, 0.0), (6.0, 8.0), (-6.000_000_000_000_001, 8.0), (0.0, -10.0)] {
                    let arc = of_radius(at(0.0, 0.0, 0.0), at(x, y, 0.0), radius, direction).unwrap();
                    let off = arc.sweep() - direction.sign() * PI;
                    assert!(off.abs() < 1e-6, "{radius} {x} {y} {direction:?}: {}", arc.sweep());
                }
            }
        }
    }

    #[test]
    fn a_radius_may_miss_the_end_by_the_slack_only() {
        let (start, end) = (at(0.0, 0.0, 0.0), at(10.0, 0.0, 0.0));
        assert!(near(of_radius(start, end, 4.998_8, Cw).unwrap().centre_xyz(), at(5.0, 0.0, 0.0)));
        assert_eq!(
            of_radius(start, end, -4.998_7, Cw),
            Err(ArcError::RadiusTooSmall { half_chord: Mm(5.0), radius: Mm(4.998_7) })
        );
        assert_eq!(of_radius(start, end, 0.0, Cw), Err(ArcError::ZeroRadius));
        assert_eq!(of_radius(start, at(0.0, 0.0, 9.0), 5.0, Cw), Err(ArcError::EndIsStart));
    }

    #[test]
    fn an_end_off_the_circle_is_measured_three_ways() {
        let to =
            |x: f64, radius: f64| centred(at(0.0, 0.0, 0.0), at(x, 0.0, 0.0), (radius, 0.0), Cw, 1).is_ok();
        // Within the absolute tolerance; above it and above the relative one.
        assert!(to(10.02, 5.0) && !to(10.03, 5.0));
        // Above the absolute tolerance, the relative one decides.
        assert!(to(200.03, 100.0) && !to(200.11, 100.0));
        // The hard limit holds however large the circle is.
        assert!(to(20_002.7, 10_000.0) && !to(20_002.9, 10_000.0));
        assert_eq!(
            centred(at(0.0, 0.0, 0.0), at(12.0, 0.0, 0.0), (5.0, 0.0), Cw, 1),
            Err(ArcError::OffCircle { start_radius: Mm(5.0), end_radius: Mm(7.0) })
        );
    }

    #[test]
    fn in_inches_ends_may_be_farther_off_the_circle() {
        let inch = |x: f64, radius: f64| {
            let [start, end] = [0.0, x].map(|x| [Mm::from_inch(x), Mm(0.0), Mm(0.0)]);
            let centre = (Mm::from_inch(radius), Mm(0.0));
            Arc::by_centre(Plane::Xy, start, end, centre, Cw, 1, &ArcTolerance::REFERENCE_INCH).is_ok()
        };
        assert!(inch(1.002_828, 0.5) && !inch(1.002_829, 0.5));
        assert!(inch(20_000.282_8, 10_000.0) && !inch(20_000.282_9, 10_000.0));
    }

    #[test]
    fn a_centre_on_an_end_is_no_centre() {
        let start = at(0.0, 0.0, 0.0);
        assert_eq!(centred(start, start, (0.001_26, 0.0), Cw, 1), Err(ArcError::ZeroRadius));
        assert!(centred(start, start, (0.001_28, 0.0), Cw, 1).is_ok());
        let any = &ArcTolerance::ANY;
        assert_eq!(
            Arc::by_centre(Plane::Xy, start, start, (Mm(0.0), Mm(0.0)), Cw, 1, any),
            Err(ArcError::ZeroRadius)
        );
    }

    #[test]
    fn bounds_reach_the_quadrant_points_that_are_passed() {
        let arc = centred(at(10.0, 0.0, 1.0), at(0.0, -10.0, 2.0), (0.0, 0.0), Ccw, 1).unwrap();
        let bounds = arc.bounds();
        let range = |axis| {
            bounds.range(axis).map(|(low, high)| ((low * 1e9).round() / 1e9, (high * 1e9).round() / 1e9))
        };
        assert_eq!(range(0), Some((-10.0, 10.0)));
        assert_eq!(range(1), Some((-10.0, 10.0)));
        assert_eq!(range(2), Some((1.0, 2.0)));
        let short = centred(at(10.0, 0.0, 0.0), at(0.0, 10.0, 0.0), (0.0, 0.0), Ccw, 1).unwrap();
        assert_eq!(short.bounds().range(0), Some((0.0, 10.0)));
    }

    #[test]
    fn tangents_point_along_the_path() {
        let arc = centred(at(10.0, 0.0, 0.0), at(0.0, 10.0, 0.0), (0.0, 0.0), Ccw, 1).unwrap();
        assert!((arc.start_tangent() - Vector3::new(0.0, 1.0, 0.0)).norm() < 1e-12);
        assert!((arc.end_tangent() - Vector3::new(-1.0, 0.0, 0.0)).norm() < 1e-12);
        let reversed = arc.reversed();
        assert!((reversed.start_tangent() - Vector3::new(1.0, 0.0, 0.0)).norm() < 1e-12);
    }

    #[test]
    fn unknown_coordinates_are_no_fault_and_spread_only_where_they_must() {
        let nan = f64::NAN;
        let arc = centred(at(10.0, 0.0, nan), at(0.0, 10.0, 3.0), (0.0, 0.0), Ccw, 1).unwrap();
        assert!(arc.is_known() && !arc.length().is_known() && arc.plane_length().is_known());
        assert!(arc.bounds().is_unknown(2) && !arc.bounds().is_unknown(0));
        let arc = centred(at(nan, 0.0, 1.0), at(0.0, 10.0, 3.0), (0.0, 0.0), Ccw, 1).unwrap();
        assert!(!arc.is_known() && arc.rise().is_known());
        assert!(arc.bounds().is_unknown(0) && arc.bounds().is_unknown(1) && !arc.bounds().is_unknown(2));
        assert_eq!(arc.chord_count(Mm(0.01)), 1);
        let arc = of_radius(at(0.0, 0.0, 0.0), at(1.0, 0.0, 0.0), nan, Cw).unwrap();
        assert!(!arc.is_known());
    }

    #[test]
    fn memory_for_chords_is_bounded() {
        let arc = centred(at(1e6, 0.0, 0.0), at(1e6, 0.0, 0.0), (0.0, 0.0), Ccw, u32::MAX).unwrap();
        assert_eq!(arc.chord_count(Mm(1e-9)), MAX_CHORDS);
        assert_eq!(arc.chord_count(Mm(0.0)), 1);
        assert_eq!(arc.chords(0).len(), 1);
    }

    /// A centre, a start on a circle around it, a sweep, a rise and a difference of radii.
    fn some_arc() -> impl Strategy<Value = Arc> {
        (
            (-500.0..500.0_f64, -500.0..500.0_f64, -50.0..50.0_f64, -50.0..50.0_f64),
            (0.1..300.0_f64, -0.5..0.5_f64, 0.0..TAU, -20.0..20.0_f64),
            prop::sample::select(Plane::ALL.to_vec()),
        )
            .prop_map(|((first, second, low, high), (radius, widening, angle, sweep), plane)| {
                let end_radius = radius * (1.0 + widening);
                let (sin, cos) = angle.sin_cos();
                let (end_sin, end_cos) = (angle + sweep).sin_cos();
                let start = plane.to_xyz([Mm(first + radius * cos), Mm(second + radius * sin), Mm(low)]);
                let end = plane.to_xyz([
                    Mm(first + end_radius * end_cos),
                    Mm(second + end_radius * end_sin),
                    Mm(high),
                ]);
                Arc::from_parts(plane, start, end, (Mm(first), Mm(second)), sweep)
            })
    }

    proptest! {
        #[test]
        fn every_point_lies_in_the_bounds_and_the_bounds_are_reached(arc in some_arc()) {
            let bounds = arc.bounds();
            let sampled = Bounds::of((0..=2000).map(|i| arc.point_at(f64::from(i) / 2000.0).map(Mm::get)));
            prop_assert!(sampled.is_within(&bounds.grown(1e-9)), "{sampled:?} {bounds:?}");
            // Samples are at most 0.01 rad apart.
            prop_assert!(bounds.is_within(&sampled.grown(arc.radius().max(arc.end_radius()).0 * 1e-4)));
        }

        #[test]
        fn the_end_is_where_the_sweep_leads(arc in some_arc()) {
            let before = arc.point_at(1.0 - 1e-12);
            prop_assert!(near(before, arc.end()), "{before:?} {:?}", arc.end());
        }

        #[test]
        fn the_length_is_that_of_many_chords(arc in some_arc()) {
            let mut sum = 0.0;
            let mut from = arc.start();
            for to in arc.chords(4000) {
                sum += from.iter().zip(to).map(|(a, b)| (a.0 - b.0).powi(2)).sum::<f64>().sqrt();
                from = to;
            }
            let length = arc.length().0;
            // The mean radius is fair for radii that differ by a per mille and near for those that differ by half.
            let spiral = (arc.radius() - arc.end_radius()).abs() / arc.radius();
            prop_assert!((sum - length).abs() <= length * (1e-5 + spiral * 0.1), "{sum} {length}");
        }

        #[test]
        fn chords_keep_the_tolerance(arc in some_arc(), tolerance in 0.001..1.0_f64) {
            let count = arc.chord_count(Mm(tolerance));
            let half_step = 0.5 / f64::from(count);
            let radius = arc.radius().max(arc.end_radius()).0;
            let sagitta = radius * (1.0 - (arc.sweep() * half_step).cos());
            prop_assert!(sagitta <= tolerance * (1.0 + 1e-6) + 1e-9);
        }

        #[test]
        fn an_arc_by_its_own_centre_is_the_arc_by_its_radius(
            start in (-100.0..100.0_f64, -100.0..100.0_f64), end in (-100.0..100.0_f64, -100.0..100.0_f64),
            more in 1.001..4.0_f64, long: bool, clockwise: bool, turns in 1..4_u32,
        ) {
            let chord = (end.0 - start.0).hypot(end.1 - start.1);
            prop_assume!(chord > 1e-3);
            let radius = chord / 2.0 * more * if long { -1.0 } else { 1.0 };
            let direction = if clockwise { Cw } else { Ccw };
            let (start, end) = (at(start.0, start.1, 0.0), at(end.0, end.1, 5.0));
            let by_radius = Arc::by_radius(Plane::Xy, start, end, Mm(radius), direction, turns, RULE).unwrap();
            let by_centre = Arc::by_centre(Plane::Xy, start, end, by_radius.centre(), direction, turns, RULE).unwrap();
            prop_assert!((by_radius.sweep() - by_centre.sweep()).abs() < 1e-9);
            prop_assert!(by_radius.radius().is_near(Mm(radius.abs()), Mm(1e-6)));
            let one_pass = by_radius.sweep().abs() - f64::from(turns - 1) * TAU;
            prop_assert_eq!(one_pass > PI, long);
        }

        #[test]
        fn nothing_panics(
            numbers in prop::array::uniform8(prop::num::f64::ANY), radius in prop::num::f64::ANY,
            turns: u32, clockwise: bool, t in prop::num::f64::ANY,
        ) {
            let [x0, y0, z0, x1, y1, z1, i, j] = numbers;
            let direction = if clockwise { Cw } else { Ccw };
            let (start, end) = (at(x0, y0, z0), at(x1, y1, z1));
            let arcs = [
                Arc::by_centre(Plane::Zx, start, end, (Mm(i), Mm(j)), direction, turns, RULE),
                Arc::by_centre(Plane::Xy, start, end, (Mm(i), Mm(j)), direction, turns, &ArcTolerance::ANY),
                Arc::by_radius(Plane::Yz, start, end, Mm(radius), direction, turns, &ArcTolerance::ANY),
            ];
            for arc in arcs.into_iter().flatten() {
                let _ = (arc.bounds(), arc.length(), arc.point_at(t), arc.tangent_at(t), arc.reversed());
                prop_assert!(arc.chord_count(Mm(radius)) >= 1);
                prop_assert_eq!(arc.chords(3).count(), 3);
            }
        }
    }
}
