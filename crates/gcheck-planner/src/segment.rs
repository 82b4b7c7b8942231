//! A move as a stretch of path with its limits.
//!
//! Knows: lengths, directions at both ends, what the axes allow along it. Must not know: its neighbours, time.

use nalgebra::Vector3;

use crate::axes::{Point, beyond_xyz, from_xyz, measure, room, xyz};
use crate::item::{Drive, Move};
use crate::machine::{Corners, Machine};

/// A direction that leaves a plane by less than this, by its length, lies in it.
const FLAT: f64 = 1e-6;

/// Is it a length or a time that something can be done with?
fn is_sound(value: f64) -> bool {
    (1e-12..1e12).contains(&value)
}

/// What holds the speed of a stretch down.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub(crate) enum Cap {
    /// The feed that was asked for, or the rapid rates.
    Asked,
    /// The highest speed of an axis.
    Axis,
    /// The turn of an arc.
    Turn,
    /// The turn of a rounded corner.
    Corner,
}

/// A stretch of path that a move runs.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Segment<T> {
    pub(crate) tag: T,
    pub(crate) drive: Drive,
    /// What is left of it.
    pub(crate) length: f64,
    /// Its length before corners took their part.
    pub(crate) whole: f64,
    /// Change of the axes by length, at its start and at its end.
    pub(crate) begin: Point,
    pub(crate) end: Point,
    /// The speed that was asked for; infinite for rapid moves.
    pub(crate) asked: f64,
    /// Its highest speed, and why.
    pub(crate) cap: f64,
    pub(crate) why: Cap,
    /// Highest speed that the axes allow, the turn of an arc left out.
    pub(crate) axes: f64,
    /// Change of speed along it, a second.
    pub(crate) acceleration: f64,
    /// The same if nothing of it turned the path.
    whole_pull: f64,
    /// Change of acceleration along it, a second; infinite without a limit.
    pub(crate) jerk: f64,
    /// The radius that it turns with; infinite for a straight one.
    pub(crate) radius: f64,
    /// Highest speed that the axes and the turn of an arc allow.
    pub(crate) most: f64,
    /// The axis that an arc turns about, and whether counter-clockwise; `None` for straight moves.
    pub(crate) about: Option<(usize, bool)>,
    /// An arc does not rise.
    is_flat: bool,
    /// Only X, Y and Z move.
    pub(crate) is_plain: bool,
    /// How many moves it is.
    pub(crate) blocks: u32,
    /// An end with which it touches its neighbour took part of the acceleration.
    kept: f64,
    /// The radius that counts once both ends are known; infinite for all but arcs of the program.
    wide: f64,
}

impl<T: Copy> Segment<T> {
    /// The stretch of a move; `None` for a move that goes nowhere, or beyond what numbers can hold.
    pub(crate) fn of(item: &Move<T>, machine: &Machine) -> Option<Self> {
        if item.asked.0 != 0.0 && !is_sound(item.asked.0) {
            return None;
        }
        let way = item.to - item.from;
        let limits = &machine.limits;
        let is_rapid = item.drive == Drive::Rapid;
        let along_path =
            |axes: f64| if is_rapid { axes * machine.rapid_part } else { axes.min(limits.feed()) };
        let mut segment = match &item.arc {
            Some(arc) => {
                let length = arc.length().0;
                if !is_sound(length) {
                    return None;
                }
                let along = way / length;
                let turn = |tangent: Vector3<f64>| {
                    let mut all = along;
                    all.fixed_rows_mut::<3>(0).copy_from(&tangent);
                    all
                };
                let (begin, end) = (turn(arc.start_tangent()), turn(arc.end_tangent()));
                // Every axis of the plane may have to take all of the speed in the plane.
                let flat = arc.plane_length().0 / length;
                let (first, second, normal) = arc.plane().axes();
                let mut worst = way / length;
                for (axis, part) in [(first, flat), (second, flat), (normal, arc.rise().0 / length)] {
                    if let Some(slot) = worst.get_mut(axis) {
                        *slot = part;
                    }
                }
                let radius = arc.radius().0.midpoint(arc.end_radius().0) / (flat * flat);
                let plane = [first, second]
                    .into_iter()
                    .filter_map(|axis| limits.acceleration().get(axis).copied())
                    .fold(f64::INFINITY, f64::min);
                let axes = along_path(room(&worst, limits.speed()));
                let acceleration = room(&worst, limits.acceleration());
                let jerk = limits.jerk().map_or(f64::INFINITY, |jerk| room(&worst, jerk));
                let mut segment =
                    Self::blank(item, length, begin, end, axes, acceleration, jerk, beyond_xyz(&way));
                segment.about = Some((normal, arc.sweep() > 0.0));
                segment.is_flat = arc.rise().0.abs() < FLAT * length;
                segment.turn(radius, plane, &machine.control.corners);
                let plain = arc.radius().0.midpoint(arc.end_radius().0);
                segment.wide = plain + arc.rise().0.powi(2) / plain;
                segment
            }
            None => {
                let length = measure(&way);
                if !is_sound(length) {
                    return None;
                }
                let along = way / length;
                let axes = along_path(room(&along, limits.speed()));
                let acceleration = room(&along, limits.acceleration());
                let jerk = limits.jerk().map_or(f64::INFINITY, |jerk| room(&along, jerk));
                Self::blank(item, length, along, along, axes, acceleration, jerk, beyond_xyz(&way))
            }
        };
        segment.blocks = 1;
        let shortest = machine.control.shortest.0;
        if shortest > 0.0 {
            segment.most = segment.most.min(segment.whole / shortest);
            segment.cap = segment.cap.min(segment.most);
        }
        Some(segment)
    }

    #[expect(clippy::too_many_arguments, reason = "the fields of a stretch, once")]
    fn blank(
        item: &Move<T>,
        length: f64,
        begin: Point,
        end: Point,
        axes: f64,
        acceleration: f64,
        jerk: f64,
        beyond: bool,
    ) -> Self {
        let asked = match item.drive {
            Drive::Rapid => f64::INFINITY,
            _ if item.asked.0 > 0.0 => length / item.asked.0,
            _ => f64::INFINITY,
        };
        let (cap, why) = if asked <= axes { (asked, Cap::Asked) } else { (axes, Cap::Axis) };
        let why = if item.drive == Drive::Rapid { Cap::Asked } else { why };
        Self {
            tag: item.tag,
            drive: item.drive,
            length,
            whole: length,
            begin,
            end,
            asked,
            cap,
            why,
            axes,
            acceleration,
            whole_pull: acceleration,
            jerk,
            radius: f64::INFINITY,
            most: axes,
            about: None,
            is_flat: true,
            is_plain: !beyond,
            blocks: 0,
            kept: 1.0,
            wide: f64::INFINITY,
        }
    }

    /// Holds the speed down to what the turn of an arc allows.
    fn turn(&mut self, radius: f64, plane: f64, corners: &Corners) {
        self.radius = radius;
        let (across, along) = match corners {
            Corners::Rounded(rounding) => (rounding.across, rounding.along),
            Corners::Slowed(_) => (1.0, 1.0),
            Corners::Filtered => return,
        };
        let turning = (plane * across * radius).sqrt();
        self.acceleration *= along;
        self.most = self.most.min(turning);
        if turning < self.cap {
            self.cap = turning;
            self.why = Cap::Turn;
        }
    }

    /// An end takes part of the acceleration: no more than this part is left.
    pub(crate) fn keep(&mut self, part: f64) {
        self.kept = self.kept.min(part);
    }

    /// Both its ends are known: what they leave of the acceleration turns an arc, and the rest runs along it.
    pub(crate) fn settle(&mut self, corners: &Corners) {
        let Corners::Rounded(rounding) = corners else { return };
        if self.wide.is_infinite() || !rounding.divides {
            return;
        }
        let left = self.whole_pull * self.kept;
        let needed = self.most * self.most / self.wide;
        if needed > rounding.across * left {
            let turning = (rounding.across * left * self.wide).sqrt();
            self.most = turning;
            if turning < self.cap {
                self.cap = turning;
                self.why = Cap::Turn;
            }
            self.acceleration = self.whole_pull * rounding.along;
        } else {
            self.acceleration = self.whole_pull * (1.0 - (needed / left).powi(2)).max(0.0).sqrt();
        }
    }

    /// The change of speed a second along the path that its ends leave.
    pub(crate) fn pull(&self) -> f64 {
        self.acceleration * self.kept
    }

    /// Directions at the ends, X, Y and Z alone.
    pub(crate) fn leaves(&self) -> Vector3<f64> {
        xyz(&self.end)
    }

    pub(crate) fn arrives(&self) -> Vector3<f64> {
        xyz(&self.begin)
    }

    /// Do both lie in one plane, as far as arcs are concerned?
    pub(crate) fn is_flat_with(&self, next: &Self) -> bool {
        let lies_in =
            |line: Vector3<f64>, about: usize| line.get(about).is_some_and(|part| part.abs() < FLAT);
        match (self.is_straight(), next.is_straight()) {
            (true, true) => true,
            (true, false) => next.turns_flat().is_some_and(|about| lies_in(self.leaves(), about)),
            (false, true) => self.turns_flat().is_some_and(|about| lies_in(next.arrives(), about)),
            (false, false) => match (self.turns_flat(), next.turns_flat()) {
                (Some(about), Some(other)) => about == other,
                _ => false,
            },
        }
    }

    /// The axis that a flat arc turns about.
    fn turns_flat(&self) -> Option<usize> {
        self.about.filter(|_| self.is_flat).map(|(about, _)| about)
    }

    /// The direction in which it leaves its last point, without the rise of an arc.
    pub(crate) fn leaves_level(&self) -> Vector3<f64> {
        self.level(self.leaves())
    }

    /// Where the axes are pulled at its first point: along the path, and on an arc towards the centre by what half its speed
    /// needs. Of length 1.
    pub(crate) fn pulled(&self) -> Vector3<f64> {
        let tangent = self.arrives();
        let Some((about, counter_clockwise)) = self.about else { return tangent };
        let mut axis = Vector3::zeros();
        if let Some(slot) = axis.get_mut(about) {
            *slot = if counter_clockwise { 1.0 } else { -1.0 };
        }
        let along = self.level(tangent);
        let speed = self.asked.min(self.axes) / 2.0;
        let inward = axis.cross(&along) * (speed * speed / self.radius);
        (along * self.whole_pull + inward).try_normalize(1e-12).unwrap_or(tangent)
    }

    fn level(&self, tangent: Vector3<f64>) -> Vector3<f64> {
        let Some((about, _)) = self.about else { return tangent };
        let mut level = tangent;
        if let Some(slot) = level.get_mut(about) {
            *slot = 0.0;
        }
        level.try_normalize(1e-12).unwrap_or(tangent)
    }

    /// How much it turns to the left about an axis, by length: negative to the right, zero for a straight move.
    pub(crate) fn curvature(&self, axis: &Vector3<f64>) -> f64 {
        let Some((about, counter_clockwise)) = self.about else { return 0.0 };
        let along = axis.get(about).copied().unwrap_or(0.0);
        if (along > 0.0) == counter_clockwise { 1.0 / self.radius } else { -1.0 / self.radius }
    }

    pub(crate) fn is_straight(&self) -> bool {
        self.radius.is_infinite()
    }

    /// An arc between this stretch and the next one.
    pub(crate) fn rounding(
        &self,
        next: &Self,
        (length, radius): (f64, f64),
        (cap, acceleration): (f64, f64),
    ) -> Self {
        let asked = self.asked.max(next.asked);
        let axes = self.axes.min(next.axes);
        let why = if cap < asked.min(axes) {
            Cap::Corner
        } else if asked <= axes {
            Cap::Asked
        } else {
            Cap::Axis
        };
        Self {
            tag: next.tag,
            drive: next.drive,
            length,
            whole: length,
            begin: from_xyz(self.leaves()),
            end: from_xyz(next.arrives()),
            asked,
            cap,
            why,
            axes,
            acceleration,
            whole_pull: acceleration,
            jerk: self.jerk.min(next.jerk),
            radius,
            most: cap,
            about: None,
            is_flat: true,
            is_plain: true,
            blocks: 0,
            kept: 1.0,
            wide: f64::INFINITY,
        }
    }
}
