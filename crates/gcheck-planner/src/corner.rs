//! Where two moves meet.
//!
//! Knows: how fast a corner may be passed, the arc that rounds it, what both take of the moves. Must not know: what is
//! before and after the two, time.

use std::f64::consts::PI;

use nalgebra::{Vector2, Vector3};

use crate::axes::{Point, room};
use crate::item::{Drive, Meeting};
use crate::machine::{Corners, Limits, Machine, Rounding};
use crate::segment::Segment;

/// How two moves meet.
#[derive(Debug, Clone, Copy)]
#[expect(clippy::large_enum_variant, reason = "one corner is kept at a time")]
pub(crate) enum Meet<T> {
    /// The axes come to rest between them.
    Rest,
    /// They are passed at no more than this speed.
    Pass(f64),
    /// An arc lies between them.
    Round(Segment<T>),
    /// The second begins while the first comes to rest.
    Overlap(Overlap),
}

/// How two moves overlap. For how long is known once what comes after the second has taken its part of it.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Overlap {
    first: Side,
    /// Highest speed of the first at which the path is not too far off; infinite without a tolerance.
    tolerated: f64,
}

/// One of two moves that overlap.
#[derive(Debug, Clone, Copy)]
struct Side {
    /// The speed that it reaches, running from rest to rest.
    reached: f64,
    pull: f64,
    length: f64,
}

impl Side {
    fn of<T: Copy>(segment: &Segment<T>) -> Self {
        let (pull, length) = (segment.pull(), segment.length);
        Self { reached: segment.cap.min((pull * length).sqrt()), pull, length }
    }
}

impl Overlap {
    /// For how long, seconds. The second one speeds up as if it began alone.
    pub(crate) fn seconds<T: Copy>(&self, second: &Segment<T>) -> f64 {
        let [speed, _] = self.speeds(second);
        speed / self.first.pull
    }

    /// The mean of the speeds that the first one has when it begins and the second one when it ends.
    fn mean_speed<T: Copy>(&self, second: &Segment<T>) -> f64 {
        let [one, other] = self.speeds(second);
        f64::midpoint(one, other)
    }

    fn speeds<T: Copy>(&self, second: &Segment<T>) -> [f64; 2] {
        let sides = [self.first, Side::of(second)];
        let speeding = sides.map(|side| side.reached / side.pull);
        let [room, other_room] = sides.map(|side| side.length / side.reached);
        let together = speeding[0].max(speeding[1]).min(room).min(other_room);
        sides.map(|side| side.reached.min(together * side.pull).min(self.tolerated))
    }
}

/// The part of the acceleration that each of two overlapping moves has.
pub(crate) const OVERLAPPED: f64 = 0.5;
/// Moves that turn by less, in radians, go straight on.
const STRAIGHT: f64 = 1e-9;
/// Turns of nearly half a circle are not rounded.
const BACK: f64 = PI - 0.01;

/// Finds out how two moves meet, and takes from both what the corner needs.
pub(crate) fn meet<T: Copy>(
    machine: &Machine,
    meeting: (Meeting, Meeting),
    first: &mut Segment<T>,
    second: &mut Segment<T>,
) -> Meet<T> {
    let control = &machine.control;
    let limits = &machine.limits;
    match (meeting.0, &control.corners) {
        (Meeting::Stop, _) => Meet::Rest,
        (_, Corners::Rounded(_)) if (first.drive == Drive::Rapid) != (second.drive == Drive::Rapid) => {
            Meet::Rest
        }
        (_, Corners::Filtered) => Meet::Pass(f64::INFINITY),
        (_, Corners::Slowed(slowing)) => {
            let change = second.begin - first.end;
            Meet::Pass(room(&change, &slowing.change).min(even_turn(limits, &change, first, second)))
        }
        (Meeting::Exact, Corners::Rounded(rounding)) => match unrounded(limits, rounding, first, second) {
            Turn::Smooth(kept) => keep(first, second, kept, f64::INFINITY),
            Turn::Sharp(_) if turn(first, second) > BACK => Meet::Rest,
            Turn::Sharp(_) => {
                keep(first, second, 1.0 - rounding.unrounded, 0.0);
                Meet::Rest
            }
        },
        (Meeting::Rounded { tolerance, .. }, Corners::Rounded(rounding)) => {
            let other = match meeting.1 {
                Meeting::Rounded { tolerance, .. } => tolerance,
                Meeting::Stop | Meeting::Exact => tolerance,
            };
            let given = [tolerance.map(|t| t.0), other.map(|t| t.0)];
            let tolerated = tolerance_of(rounding, given, first, second);
            let told = given[0].or(rounding.default_tolerance.map(|tolerance| tolerance.0));
            let slow = match unrounded(limits, rounding, first, second) {
                Turn::Smooth(kept) => return keep(first, second, kept, f64::INFINITY),
                Turn::Sharp(speed) => speed,
            };
            if turn(first, second) > BACK {
                return Meet::Rest;
            }
            if !first.is_plain || !second.is_plain || !first.is_flat_with(second) {
                return beyond(rounding, limits, (told, slow), first, second);
            }
            match round(limits, rounding, tolerated, first, second) {
                Some(arc) if arc.cap > slow => Meet::Round(arc),
                _ => keep(first, second, 1.0 - rounding.unrounded, slow),
            }
        }
    }
}

/// Passing a corner without rounding takes part of the acceleration of both moves.
fn keep<T: Copy>(first: &mut Segment<T>, second: &mut Segment<T>, kept: f64, speed: f64) -> Meet<T> {
    first.keep(kept);
    second.keep(kept);
    Meet::Pass(speed)
}

/// How a corner is passed on the path itself.
enum Turn {
    /// Hardly a turn: at any speed, with this part of the acceleration left.
    Smooth(f64),
    /// At this speed.
    Sharp(f64),
}

/// A corner changes the speeds of the axes within one cycle of the control.
fn unrounded<T: Copy>(limits: &Limits, rounding: &Rounding, first: &Segment<T>, second: &Segment<T>) -> Turn {
    let change = second.begin - first.end;
    let speed = first.cap.min(second.cap);
    // At worst the control brakes to nothing and speeds up from nothing in the same cycle.
    let at_once = speed / rounding.cycle.0 + first.acceleration.max(second.acceleration);
    let mut part = at_once / room(&change, limits.acceleration());
    if !(first.is_straight() && second.is_straight()) {
        part /= rounding.along;
    }
    if part <= rounding.unrounded {
        Turn::Smooth(1.0 - part)
    } else {
        Turn::Sharp(speed * rounding.unrounded / part)
    }
}

/// How far a corner may be off.
fn tolerance_of<T: Copy>(
    rounding: &Rounding,
    given: [Option<f64>; 2],
    first: &Segment<T>,
    second: &Segment<T>,
) -> f64 {
    let default = rounding.default_tolerance.map(|tolerance| tolerance.0);
    let of = |given: Option<f64>, whole: f64| {
        given.filter(|t| *t > 0.0).or(default).unwrap_or(whole * rounding.part_of_length)
    };
    let [one, other] = given;
    of(one, first.whole).min(of(other, second.whole))
}

/// The arc inside a corner.
fn round<T: Copy>(
    limits: &Limits,
    rounding: &Rounding,
    tolerance: f64,
    first: &mut Segment<T>,
    second: &mut Segment<T>,
) -> Option<Segment<T>> {
    let (leaves, arrives) = (first.leaves(), second.arrives());
    let turn = turn(first, second);
    if turn < STRAIGHT {
        return None;
    }
    let normal = leaves.cross(&arrives).normalize();
    let curves = [first.curvature(&normal), second.curvature(&normal)];
    // Where a side curves the way the corner turns, the corner counts as a sharper one.
    let sharper = [&*first, &*second].into_iter().zip(curves).zip(rounding.curve_shares);
    let sharper =
        sharper.filter(|((_, curve), _)| *curve > 0.0).fold(0.0, |most: f64, ((side, curve), share)| {
            most.max((side.whole * curve * share).min((PI - turn) / 4.0))
        });
    let (sin, cos) = f64::midpoint(turn, sharper).sin_cos();
    let tan = sin / cos;
    let plane = in_plane(limits.acceleration(), &leaves, &arrives);
    let across = plane * rounding.across;
    let fastest = in_plane(limits.speed(), &leaves, &arrives);
    let asked = first.asked.max(second.asked).min(first.most).min(second.most).min(fastest);
    // No more of a move than half, so that its other end has as much.
    let reach = first.length.min(first.whole / 2.0).min(second.whole / 2.0).min(second.length);
    let widest = (tolerance * cos / (1.0 - cos)).min(reach / tan);
    let needed = asked.min((across * widest).sqrt());
    let mut radius = needed * needed / across;
    if rounding.stretched {
        // The arc is as long as the way of an overlap of both moves would be.
        let slowing = plane * OVERLAPPED;
        let overlap = needed.min((2.0 * slowing * widest * tan).sqrt()) / slowing;
        radius = radius.max((overlap * needed / turn).min(widest));
    }
    let inner = if first.is_straight() && second.is_straight() {
        Inner { radius, taken: [radius * tan; 2], turn }
    } else {
        let half = |segment: &Segment<T>| segment.length.min(segment.whole / 2.0);
        Inner::widest(turn, curves, radius, tolerance, [half(first), half(second)])?
    };
    let Inner { radius, taken, turn } = inner;
    let cap = (across * radius).sqrt().min(asked);
    first.length = (first.length - taken[0]).max(0.0);
    second.length = (second.length - taken[1]).max(0.0);
    Some(first.rounding(second, (radius * turn, radius), (cap, plane * rounding.along)))
}

/// A circle inside a corner that touches both its sides.
#[derive(Debug, Clone, Copy)]
struct Inner {
    radius: f64,
    /// Way from the corner to where it touches, along each side.
    taken: [f64; 2],
    /// The angle on it between the two points, radians.
    turn: f64,
}

impl Inner {
    /// The widest circle in a corner that turns left by `turn`, between sides of these curvatures (positive to the left),
    /// no wider than `needed`, no further from the corner than `tolerance`, and within `most` of each side.
    fn widest(turn: f64, curves: [f64; 2], needed: f64, tolerance: f64, most: [f64; 2]) -> Option<Self> {
        let fits = |radius: f64| {
            let (inner, off) = Self::of_radius(turn, curves, radius)?;
            let within = inner.taken.iter().zip(most).all(|(taken, most)| *taken <= most);
            (off <= tolerance && within).then_some(inner)
        };
        if let Some(inner) = fits(needed) {
            return Some(inner);
        }
        let (mut low, mut high) = (0.0, needed);
        let mut best = None;
        for _ in 0..30 {
            let middle = f64::midpoint(low, high);
            match fits(middle) {
                Some(inner) => (best, low) = (Some(inner), middle),
                None => high = middle,
            }
        }
        best
    }

    /// The circle of a radius, and how far it stays from the corner. The corner is the origin, reached along the first
    /// axis; the circle's centre is a radius to the left of both sides.
    fn of_radius(turn: f64, curves: [f64; 2], radius: f64) -> Option<(Self, f64)> {
        let (sin, cos) = turn.sin_cos();
        let sides = [(Vector2::new(1.0, 0.0), curves[0]), (Vector2::new(cos, sin), curves[1])];
        let left = |way: Vector2<f64>| Vector2::new(-way.y, way.x);
        // All points that lie a radius to the left of a side: a line, or a circle about the side's centre.
        let beside = sides.map(|(way, curve)| {
            if curve.abs() > 0.0 {
                Beside::Circle(left(way) / curve, (1.0 / curve - radius).abs())
            } else {
                Beside::Line(left(way) * radius, way)
            }
        });
        let centres = match beside {
            [Beside::Line(point, way), Beside::Line(other, to)] => {
                let part = (other - point).perp(&to) / way.perp(&to);
                [Some(point + way * part), None]
            }
            [Beside::Line(point, way), Beside::Circle(about, size)]
            | [Beside::Circle(about, size), Beside::Line(point, way)] => {
                let foot = point + way * (about - point).dot(&way);
                let half = (size * size - (about - foot).norm_squared()).sqrt();
                [Some(foot - way * half), Some(foot + way * half)]
            }
            [Beside::Circle(one, size), Beside::Circle(other, other_size)] => {
                let between = other - one;
                let distance = between.norm();
                let along = (distance * distance + size * size - other_size * other_size) / (2.0 * distance);
                let half = (size * size - along * along).sqrt();
                let foot = one + between / distance * along;
                let up = left(between / distance) * half;
                [Some(foot - up), Some(foot + up)]
            }
        };
        // Of two circles the one at this corner: its points lie next to it.
        let at = |centre: Vector2<f64>| {
            let [before, after] = sides.map(|(way, curve)| way_to(centre, radius, way, curve));
            let taken = [-before, after];
            let turned = turn - before * curves[0] + after * curves[1];
            let off = centre.norm() - radius;
            let sound =
                taken.iter().all(|way| *way >= 0.0 && way.is_finite()) && turned > 0.0 && off.is_finite();
            sound.then_some((Self { radius, taken, turn: turned }, off.max(0.0)))
        };
        let total = |found: &(Self, f64)| found.0.taken[0] + found.0.taken[1];
        centres.into_iter().flatten().filter_map(at).min_by(|one, other| total(one).total_cmp(&total(other)))
    }
}

/// The points beside a side of a corner.
enum Beside {
    /// A point and a direction.
    Line(Vector2<f64>, Vector2<f64>),
    /// A centre and a radius.
    Circle(Vector2<f64>, f64),
}

/// The way along a side, from the corner on, to the point where a circle touches it.
fn way_to(centre: Vector2<f64>, radius: f64, way: Vector2<f64>, curve: f64) -> f64 {
    let left = Vector2::new(-way.y, way.x);
    if curve.abs() > 0.0 {
        // Seen from the side's centre the corner lies to its right, or to its left where it turns right.
        // A circle that is wider than the side's own touches it beyond the side's centre.
        let beyond = ((1.0 / curve - radius) * curve).signum();
        let from = (centre - left / curve) * beyond;
        let outward = if 1.0 / curve > 0.0 { -left } else { left };
        from.dot(&way).atan2(from.dot(&outward)) / curve.abs()
    } else {
        centre.dot(&way)
    }
}

/// The angle by which the path turns in X, Y and Z, radians.
fn turn<T: Copy>(first: &Segment<T>, second: &Segment<T>) -> f64 {
    let (leaves, arrives) = (first.leaves(), second.arrives());
    leaves.cross(&arrives).norm().atan2(leaves.dot(&arrives))
}

/// Of bounds of the axes, what holds in every direction of the plane of two directions.
fn in_plane(bounds: &Point, one: &Vector3<f64>, other: &Vector3<f64>) -> f64 {
    let first = *one;
    let second = (other - first * first.dot(other)).try_normalize(1e-12).unwrap_or_else(Vector3::zeros);
    (0..3).fold(f64::INFINITY, |least, axis| {
        let reach = first.get(axis).zip(second.get(axis)).map_or(0.0, |(a, b)| a.hypot(*b));
        let bound = bounds.get(axis).copied().unwrap_or(f64::INFINITY);
        if reach > 1e-9 { least.min(bound / reach) } else { least }
    })
}

/// Moves that no flat arc joins: of more axes than X, Y and Z, and arcs that leave the plane of the corner.
fn beyond<T: Copy>(
    rounding: &Rounding,
    limits: &Limits,
    (tolerance, slow): (Option<f64>, f64),
    first: &mut Segment<T>,
    second: &mut Segment<T>,
) -> Meet<T> {
    if !rounding.overlaps {
        return Meet::Pass(even_turn(limits, &(second.begin - first.end), first, second));
    }
    // Both at half the acceleration: while they overlap, the sum does not exceed the whole.
    let [mut one, mut other] = [*first, *second];
    one.share(OVERLAPPED);
    other.share(OVERLAPPED);
    // The path is off by what the first still has to go when the second begins.
    let (leaves, arrives) = (one.leaves_level(), other.pulled());
    let (sin, cos) = (leaves.cross(&arrives).norm().atan2(leaves.dot(&arrives)) / 2.0).sin_cos();
    let tolerated = tolerance.map_or(f64::INFINITY, |off| 2.0 * (one.pull() * off / sin.max(1e-3)).sqrt());
    let overlap = Overlap { first: Side::of(&one), tolerated };
    // A corner that hardly turns may be faster on the path itself.
    if slow > cos * overlap.mean_speed(&other) {
        return keep(first, second, 1.0 - rounding.unrounded, slow);
    }
    [*first, *second] = [one, other];
    Meet::Overlap(overlap)
}

/// The speed at which half of each move is enough to bring the axes from one direction to the other.
fn even_turn<T>(limits: &Limits, change: &Point, first: &Segment<T>, second: &Segment<T>) -> f64 {
    (room(change, limits.acceleration()) * first.whole.midpoint(second.whole)).sqrt()
}

/// Do the axes come to rest at the ends of the move whatever the mode?
pub(crate) fn is_alone(drive: Drive, machine: &Machine) -> bool {
    match drive {
        Drive::Rapid => machine.control.rapids != crate::machine::Rapids::Joined,
        Drive::Probe | Drive::Tap(_) => true,
        Drive::Feed | Drive::Thread(_) => false,
    }
}
