//! Events as single movements of the axes.
//!
//! Knows: which movements an event is, their lengths, where they run in machine coordinates. Must not know: time, format.

use gcheck_engine::{Axis, CurvePiece, Event, Position, TravelKind};
use gcheck_geometry::{Arc, Degrees, Mm, Plane};

use crate::step::Step;

/// How a movement is driven.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Way {
    Rapid,
    Feed,
    Probe,
    /// Tied to the spindle by a lead that the event does not say.
    Thread,
    /// Tapping, at this part of the spindle's speed.
    Tap(f64),
}

/// One movement: straight, or an arc.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Motion {
    pub(crate) way: Way,
    pub(crate) from: Position,
    pub(crate) programmed: Position,
    pub(crate) to: Position,
    /// Machine coordinates at `from` and `to`.
    pub(crate) machine_from: Position,
    pub(crate) machine: Position,
    pub(crate) arc: Option<Arc>,
    /// How far the axes go whose places are not known; NaN for all others.
    pub(crate) way_known: Position,
    pub(crate) expanded: bool,
    /// The part of the block's movement that it is; 1 but for pieces of a curve.
    pub(crate) share: f64,
}

/// What has to be remembered between events to know where movements run in machine coordinates.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Tracker {
    /// Machine coordinates before the event.
    machine: Position,
    /// Rotation of the work coordinates about Z.
    rotation: Degrees,
    /// An axis that is wrapped around a cylinder: it does not move, and a rotary axis turns for it.
    still: Option<Axis>,
    /// How far the axes of the next move go whose places are not known.
    way_known: Position,
}

impl Default for Tracker {
    fn default() -> Self {
        Self { machine: Position::UNKNOWN, rotation: Degrees(0.0), still: None, way_known: Position::UNKNOWN }
    }
}

impl Tracker {
    /// To be called after the event was looked at.
    pub(crate) fn after(&mut self, step: &Step<'_>) {
        self.machine = step.machine;
        match step.event {
            Event::KnownWay(way) => self.way_known = *way,
            Event::Travel(_) => self.way_known = Position::UNKNOWN,
            Event::WorkOffset { rotation, .. } | Event::Rotation(rotation) => {
                self.rotation = Degrees(*rotation);
            }
            Event::Cylinder(cylinder) => self.still = cylinder.map(|cylinder| cylinder.linear),
            _ => {}
        }
    }

    /// The axis whose coordinates are those of an unrolled cylinder: it does not move.
    pub(crate) const fn still(&self) -> Option<Axis> {
        self.still
    }

    /// Do the work coordinates lie as the axes do?
    pub(crate) fn is_upright(&self) -> bool {
        self.rotation.sin_cos().0.abs() <= 0.0 && self.rotation.sin_cos().1 > 0.0
    }

    /// A point of the work coordinates as the axes see it, but for a shift.
    pub(crate) fn turned(&self, point: &Position) -> Position {
        self.moved(&Position::ZERO, &Position::ZERO, point)
    }

    /// Calls `each` for every movement of the event, in order.
    pub(crate) fn motions(&self, step: &Step<'_>, mut each: impl FnMut(&Motion)) {
        match step.event {
            Event::Travel(travel) => each(&Motion {
                way: match travel.kind {
                    TravelKind::Rapid => Way::Rapid,
                    TravelKind::Feed => Way::Feed,
                    TravelKind::Probe { .. } => Way::Probe,
                    TravelKind::Thread => Way::Thread,
                },
                from: travel.from,
                programmed: travel.programmed,
                to: travel.to,
                machine_from: self.machine,
                machine: step.machine,
                arc: None,
                way_known: self.way_known,
                expanded: travel.expanded,
                share: 1.0,
            }),
            Event::Arc(arc) => each(&Motion {
                way: Way::Feed,
                from: arc.from,
                programmed: arc.programmed,
                to: arc.to,
                machine_from: self.machine,
                machine: step.machine,
                arc: Some(Arc::from_parts(arc.plane, arc.from.xyz(), arc.to.xyz(), arc.centre, arc.sweep)),
                way_known: Position::UNKNOWN,
                expanded: arc.expanded,
                share: 1.0,
            }),
            Event::RigidTap { from, to, scale } => {
                let down = Motion {
                    way: Way::Tap(1.0),
                    from: *from,
                    programmed: *to,
                    to: *to,
                    machine_from: step.machine,
                    machine: self.moved(&step.machine, from, to),
                    arc: None,
                    way_known: Position::UNKNOWN,
                    expanded: true,
                    share: 1.0,
                };
                each(&down);
                each(&Motion {
                    way: Way::Tap(*scale),
                    from: *to,
                    programmed: *from,
                    to: *from,
                    machine_from: down.machine,
                    machine: step.machine,
                    ..down
                });
            }
            Event::Curve(curve) => self.curve(step, curve, each),
            _ => {}
        }
    }

    fn curve(&self, step: &Step<'_>, curve: &gcheck_engine::Curve, mut each: impl FnMut(&Motion)) {
        let piece_of = |from: Position, piece: &CurvePiece, last: bool| {
            let ([x, y], turn) = match piece {
                CurvePiece::Line(to) => (*to, None),
                CurvePiece::Arc { to, centre, turn } => (*to, Some((*centre, *turn))),
            };
            let mut to = if last { curve.to } else { from };
            to.set(Axis::X, x.0);
            to.set(Axis::Y, y.0);
            let arc = turn.map(|([i, j], turn)| {
                let sweep = sweep(from.xyz(), to.xyz(), (i, j), turn);
                Arc::from_parts(Plane::Xy, from.xyz(), to.xyz(), (i, j), sweep)
            });
            (to, arc)
        };
        // A curve of no pieces is still a way to its end.
        let whole = [CurvePiece::Line({
            let [x, y, _] = curve.to.xyz();
            [x, y]
        })];
        let pieces = if curve.pieces.is_empty() { whole.as_slice() } else { &curve.pieces };
        let count = pieces.len();
        let lengths = |from: Position, to: Position, arc: Option<Arc>| {
            arc.map_or_else(|| distance(&from, &to, [Axis::X, Axis::Y, Axis::Z]), |arc| arc.length().0)
        };
        let mut total = 0.0;
        let mut from = curve.from;
        for (index, piece) in pieces.iter().enumerate() {
            let (to, arc) = piece_of(from, piece, index + 1 == count);
            total += lengths(from, to, arc);
            from = to;
        }
        let mut from = curve.from;
        let mut machine_from = self.machine;
        for (index, piece) in pieces.iter().enumerate() {
            let last = index + 1 == count;
            let (to, arc) = piece_of(from, piece, last);
            let machine = if last { step.machine } else { self.moved(&step.machine, &curve.to, &to) };
            let share = if total > 0.0 { lengths(from, to, arc) / total } else { 1.0 };
            each(&Motion {
                way: Way::Feed,
                from,
                programmed: to,
                to,
                machine_from,
                machine,
                arc,
                way_known: Position::UNKNOWN,
                expanded: false,
                share,
            });
            (from, machine_from) = (to, machine);
        }
    }

    /// Machine coordinates of the point `to`, from those of the point `from`.
    fn moved(&self, machine: &Position, from: &Position, to: &Position) -> Position {
        let mut result = *machine + (*to - *from);
        let [dx, dy] = [Axis::X, Axis::Y].map(|axis| to.raw(axis) - from.raw(axis));
        let (sin, cos) = self.rotation.sin_cos();
        if sin.abs() > 0.0 || cos < 1.0 {
            result.set(Axis::X, machine.raw(Axis::X) + dx * cos - dy * sin);
            result.set(Axis::Y, machine.raw(Axis::Y) + dx * sin + dy * cos);
        }
        result
    }

    /// The arc of a movement in machine coordinates; `None` when its ends do not lie where they would have to, which is so
    /// when the work coordinates are more than shifted and turned about Z, as on a cylinder.
    pub(crate) fn machine_arc(&self, motion: &Motion, arc: &Arc) -> Option<MachineArc> {
        if self.still.is_some() {
            return None;
        }
        let start = self.moved(&motion.machine, &motion.to, &motion.from);
        let off = |axis: Axis| (start.raw(axis) - motion.machine_from.raw(axis)).abs() > 1e-3;
        if [Axis::X, Axis::Y, Axis::Z].into_iter().any(off) {
            return None;
        }
        let upright = arc.plane() == Plane::Xy || self.rotation.sin_cos().0.abs() <= 0.0;
        if !upright {
            return Some(MachineArc::Chords(*self));
        }
        let centre = motion.to.with_xyz(arc.plane().to_xyz([arc.centre().0, arc.centre().1, Mm(0.0)]));
        let centre = self.moved(&motion.machine, &motion.to, &centre);
        let [first, second, _] = arc.plane().to_local(centre.xyz());
        let turned =
            Arc::from_parts(arc.plane(), start.xyz(), motion.machine.xyz(), (first, second), arc.sweep());
        Some(MachineArc::Arc(turned))
    }
}

/// An arc in machine coordinates.
#[derive(Debug, Clone, Copy)]
pub(crate) enum MachineArc {
    /// An arc in the same plane.
    Arc(Arc),
    /// An arc in a plane that is none of the main ones.
    Chords(Tracker),
}

impl MachineArc {
    /// Points that span the box of the arc, as closely as one wants to know.
    pub(crate) fn bounds(&self, motion: &Motion, arc: &Arc) -> gcheck_geometry::Bounds {
        match self {
            Self::Arc(arc) => arc.bounds(),
            Self::Chords(tracker) => {
                let mut bounds = gcheck_geometry::Bounds::EMPTY;
                for point in arc.chords(720) {
                    let point = motion.to.with_xyz(point);
                    let [x, y, z] = tracker.moved(&motion.machine, &motion.to, &point).xyz();
                    bounds.include(&[x.0, y.0, z.0]);
                }
                bounds
            }
        }
    }
}

/// The angle from one point to another around a centre; a whole turn when they are one.
fn sweep([x, y, _]: [Mm; 3], [to_x, to_y, _]: [Mm; 3], (i, j): (Mm, Mm), turn: i32) -> f64 {
    let angle = (to_y - j).0.atan2((to_x - i).0) - (y - j).0.atan2((x - i).0);
    let angle = angle.rem_euclid(std::f64::consts::TAU);
    if turn < 0 { angle - std::f64::consts::TAU } else { angle }
}

impl Motion {
    /// How far an axis goes, either way; NaN unknown.
    pub(crate) fn way_of(&self, axis: Axis) -> f64 {
        let between = (self.to.raw(axis) - self.from.raw(axis)).abs();
        if between.is_nan() { self.way_known.raw(axis).abs() } else { between }
    }
}

/// What a movement covers.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Cover {
    /// Millimetres along the path.
    Length(f64),
    /// Degrees: only rotary axes move.
    Turn(f64),
    /// Nothing moves.
    Nothing,
    /// Start or end is unknown.
    Unknown,
}

/// What a movement covers, and whether an axis of which nobody knows anything may have moved beside it.
///
/// The length is that of X, Y and Z; of U, V and W when those are; of the rotary axes when all linear axes are: this
/// is also how feeds are meant.
pub(crate) fn cover(motion: &Motion) -> (Cover, bool) {
    let mut partial = false;
    let mut open = false;
    let mut known = false;
    let mut group = |axes: [Axis; 3]| {
        let mut sum = 0.0;
        for axis in axes {
            let (from, to) = (motion.from.raw(axis), motion.to.raw(axis));
            let way = motion.way_known.raw(axis);
            match (from.is_nan(), to.is_nan()) {
                (true, true) if !way.is_nan() => {
                    known = true;
                    sum += way * way;
                }
                // Nobody ever said where the axis is: most likely it is not used. Where the program says so, the axis is beside it by
                // as much as nobody knows.
                (true, true) if motion.programmed.raw(axis).is_nan() => partial = true,
                (false, false) => {
                    known = true;
                    sum += (to - from) * (to - from);
                }
                _ => open = true,
            }
        }
        sum.sqrt()
    };
    let xyz = group([Axis::X, Axis::Y, Axis::Z]);
    let uvw = group([Axis::U, Axis::V, Axis::W]);
    let abc = group([Axis::A, Axis::B, Axis::C]);
    let xyz = match &motion.arc {
        None => xyz,
        Some(arc) if arc.rise().is_known() => arc.length().0,
        Some(arc) => arc.plane_length().0,
    };
    // Ways beyond any number are as good as unknown.
    let cover = if open || ![xyz, uvw, abc].into_iter().all(f64::is_finite) {
        Cover::Unknown
    } else if xyz > 0.0 {
        Cover::Length(xyz)
    } else if uvw > 0.0 {
        Cover::Length(uvw)
    } else if abc > 0.0 {
        Cover::Turn(abc)
    } else if partial && !known {
        Cover::Unknown
    } else {
        Cover::Nothing
    };
    (cover, partial)
}

fn distance(from: &Position, to: &Position, axes: [Axis; 3]) -> f64 {
    axes.into_iter()
        .map(|axis| to.raw(axis) - from.raw(axis))
        .filter(|way| !way.is_nan())
        .fold(0.0, |sum: f64, way| sum.hypot(way))
}
