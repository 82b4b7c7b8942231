//! Where two moves meet.
//!
//! Knows: how fast a corner may be passed, the arc that rounds it, what both take of the moves. Must not know: what is
//! before and after the two, time.

use std::f64::consts::{FRAC_PI_2, PI};

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
    /// How far off the path may be, by what a millimetre of the first is off it; infinite without a tolerance.
    off: f64,
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

    /// As long as the end of the move is not known: a corner there may take half of it.
    fn open<T: Copy>(segment: &Segment<T>) -> Self {
        let (pull, length) = (segment.pull(), segment.length);
        Self { reached: segment.cap.min((pull * length / 2.0).sqrt()), pull, length }
    }
}

impl Overlap {
    /// The same with what is known once both ends of the first are.
    pub(crate) fn after<T: Copy>(self, first: &Segment<T>) -> Self {
        Self { first: Side::of(first), ..self }
    }

    /// For how long, seconds. The second one speeds up as if it began alone. `is_open`: its end is not known.
    pub(crate) fn seconds<T: Copy>(&self, second: &Segment<T>, is_open: bool) -> f64 {
        let second = if is_open { Side::open(second) } else { Side::of(second) };
        let [speed, _] = self.speeds_of(&[self.first, second]);
        speed / self.first.pull
    }

    /// The speeds that the first one has when the second one begins, and the second one when the first one ends.
    fn speeds_of(&self, sides: &[Side; 2]) -> [f64; 2] {
        let speeding = sides.map(|side| side.reached / side.pull);
        let [room, other_room] = sides.map(|side| side.length / side.reached);
        let together = speeding[0].max(speeding[1]).min(room).min(other_room);
        let tolerated = 2.0 * (sides[0].pull * self.off).sqrt();
        sides.map(|side| side.reached.min(together * side.pull).min(tolerated))
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
            let flat = first.is_plain && second.is_plain && first.is_flat_with(second);
            let arc = if flat { round(limits, rounding, tolerated, first, second) } else { None };
            quickest(rounding, limits, (told, slow), arc, first, second)
        }
    }
}

/// Of the ways to take a corner, the quickest one: on an arc, on the path at a speed, or both moves at once.
fn quickest<T: Copy>(
    rounding: &Rounding,
    limits: &Limits,
    (tolerance, slow): (Option<f64>, f64),
    arc: Option<Rounded<T>>,
    first: &mut Segment<T>,
    second: &mut Segment<T>,
) -> Meet<T> {
    let at_once = overlapped(rounding, tolerance, first, second);
    let rounded = arc.as_ref().map_or(0.0, |arc| arc.segment.cap);
    // Both moves give half of their acceleration for it, which costs as much again.
    let overlapping = at_once.as_ref().map_or(0.0, |at_once| at_once.speed / 2.0);
    match (arc, at_once) {
        (Some(arc), _) if rounded > slow && rounded > overlapping => {
            first.length = (first.length - arc.taken[0]).max(0.0);
            second.length = (second.length - arc.taken[1]).max(0.0);
            Meet::Round(arc.segment)
        }
        (_, Some(at_once)) if overlapping >= slow => {
            [*first, *second] = at_once.sides;
            Meet::Overlap(at_once.overlap)
        }
        (None, None) if !(first.is_plain && second.is_plain && first.is_flat_with(second)) => {
            Meet::Pass(even_turn(limits, &(second.begin - first.end), first, second))
        }
        _ => keep(first, second, 1.0 - rounding.unrounded, slow),
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

/// An arc inside a corner.
struct Rounded<T> {
    segment: Segment<T>,
    /// What it takes of the moves before and after it.
    taken: [f64; 2],
}

/// The arc inside a corner; `None` where there is none inside the tolerance.
fn round<T: Copy>(
    limits: &Limits,
    rounding: &Rounding,
    tolerance: f64,
    first: &Segment<T>,
    second: &Segment<T>,
) -> Option<Rounded<T>> {
    let (leaves, arrives) = (first.leaves(), second.arrives());
    let turn = turn(first, second);
    if turn < STRAIGHT {
        return None;
    }
    let normal = leaves.cross(&arrives).normalize();
    let curves = [first.curvature(&normal), second.curvature(&normal)];
    let straight = first.is_straight() && second.is_straight();
    let rooms = [
        Room::of(first.length, curves[0], rounding.curve_shares[0], turn),
        Room::of(second.length, curves[1], rounding.curve_shares[1], turn),
    ];
    // Where a side curves the way the corner turns, the corner counts as a sharper one.
    let sharper = rooms[0].sharper.max(rooms[1].sharper);
    let (both, full) = (!first.is_straight() && !second.is_straight(), turn + sharper);
    if both && full > rounding.sharpest_between_arcs {
        return None;
    }
    let (sin, cos) = (full / 2.0).sin_cos();
    let tan = sin / cos;
    let plane = in_plane(limits.acceleration(), &leaves, &arrives);
    let across = plane * rounding.across;
    let fastest = in_plane(limits.speed(), &leaves, &arrives);
    let asked = first.asked.min(first.most).max(second.asked.min(second.most)).min(fastest);
    // No more of a straight move than half, so that its other end has as much.
    let reach_of = |side: &Segment<T>, room: &Room| room.reach.unwrap_or(side.length.min(side.whole / 2.0));
    let reach = reach_of(first, &rooms[0]).min(reach_of(second, &rooms[1]));
    let widest = (tolerance * cos / (1.0 - cos)).min(reach / tan);
    let needed = asked.min((across * widest).sqrt());
    let mut radius = needed * needed / across;
    if rounding.stretched {
        // The arc is as long as the way of an overlap of both moves would be.
        let slowing = plane * OVERLAPPED;
        let overlap = needed.min((2.0 * slowing * widest * tan).sqrt()) / slowing;
        radius = radius.max((overlap * needed / full).min(widest));
    }
    let inner = if straight {
        Inner { radius, taken: [radius * tan; 2], turn }
    } else {
        let planned = rounding.curve_shares.iter().any(|share| *share != 0.0);
        let most = [(first, &rooms[0]), (second, &rooms[1])].map(|(side, room)| {
            let half = if planned { side.length } else { side.length.min(side.whole / 2.0) };
            room.most.unwrap_or(half)
        });
        if planned {
            Inner::fitting(turn, curves, radius, tolerance, most)?
        } else {
            Inner::widest(turn, curves, radius, tolerance, most)?
        }
    };
    let cap = (across * radius).sqrt().min(asked);
    let Inner { radius, taken, turn } = inner;
    let segment = first.rounding(second, (radius * turn, radius), (cap, plane * rounding.along));
    Some(Rounded { segment, taken })
}

/// What a side of a corner leaves to an arc inside it.
struct Room {
    /// By how much the corner counts as a sharper one, radians.
    sharper: f64,
    /// How far from the corner the arc is planned to touch the side, where the side is curved.
    reach: Option<f64>,
    /// How far it may touch it once it is fitted, where the side is curved.
    most: Option<f64>,
}

impl Room {
    /// Of a side of this length and curvature (positive the way the corner turns) at a corner.
    fn of(length: f64, curve: f64, share: f64, turn: f64) -> Self {
        if curve.abs() <= 0.0 || share <= 0.0 {
            return Self { sharper: 0.0, reach: None, most: None };
        }
        let inward = curve > 0.0;
        let all = length * curve.abs();
        // The share is that of the chord, which turns half as much.
        let angle = (2.0 * share * all).min(if inward { (PI - turn) / 2.0 } else { FRAC_PI_2 });
        let reach = if inward { (angle / 4.0).sin() } else { angle } / curve.abs();
        let sharper = if inward { angle / 2.0 } else { 0.0 };
        Self { sharper, reach: Some(reach), most: Some(angle / curve.abs()) }
    }
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
    /// The circle of a radius in a corner that turns left by `turn`, between sides of these curvatures (positive to the left);
    /// `None` where it is further from the corner than `tolerance`, or takes more of a side than `most`.
    fn fitting(turn: f64, curves: [f64; 2], radius: f64, tolerance: f64, most: [f64; 2]) -> Option<Self> {
        let (inner, off) = Self::of_radius(turn, curves, radius)?;
        let within = inner.taken.iter().zip(most).all(|(taken, most)| *taken <= most);
        (off <= tolerance && within).then_some(inner)
    }

    /// The widest circle in such a corner, no wider than `needed`.
    fn widest(turn: f64, curves: [f64; 2], needed: f64, tolerance: f64, most: [f64; 2]) -> Option<Self> {
        let fits = |radius: f64| Self::fitting(turn, curves, radius, tolerance, most);
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

/// Two moves that overlap.
struct AtOnce<T> {
    /// Both, at their part of the acceleration.
    sides: [Segment<T>; 2],
    overlap: Overlap,
    /// Along the corner, as far as is known before the second is joined to what follows it.
    speed: f64,
}

/// Two moves as they would overlap; `None` where the control does not let them.
fn overlapped<T: Copy>(
    rounding: &Rounding,
    tolerance: Option<f64>,
    first: &Segment<T>,
    second: &Segment<T>,
) -> Option<AtOnce<T>> {
    if !rounding.overlaps {
        return None;
    }
    // Both at half the acceleration: while they overlap, the sum does not exceed the whole.
    let mut sides = [*first, *second];
    for side in &mut sides {
        side.keep(OVERLAPPED);
    }
    let [one, other] = &sides;
    // The path is off by what the first still has to go when the second begins.
    let (leaves, arrives) = (one.leaves_level(), other.pulled());
    let (sin, cos) = (leaves.cross(&arrives).norm().atan2(leaves.dot(&arrives)) / 2.0).sin_cos();
    let off = tolerance.map_or(f64::INFINITY, |off| off / sin.max(1e-3));
    let overlap = Overlap { first: Side::of(one), off };
    let [before, after] = overlap.speeds_of(&[Side::open(one), Side::open(other)]);
    let speed = cos * f64::midpoint(before, after);
    Some(AtOnce { sides, overlap, speed })
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
