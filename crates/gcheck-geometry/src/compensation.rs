//! Offsetting of a planar path by the radius of the tool.
//!
//! Knows segments of a path in a plane, a third coordinate carried along, and the tool's radius.
//! Must not know codes, words, modal state or any control.
//!
//! A [`Compensator`] takes the programmed path segment by segment and gives the path of the tool's centre to a callback.
//! It holds back what the next segment may still change: where a segment ends is known only when the segment after the
//! corner is.
//! Everything that must keep its place among the moves goes through [`Compensator::pass`] and waits in the same queue.
//!
//! Lengths are millimetres, angles radians.
//! The plane has a first and a second axis, right-handed: counter-clockwise turns the first axis towards the second.
//!
//! # Words
//!
//! *Bend* is the turn of the path at a corner, in (-pi, pi], positive towards the tool's side.
//! A corner is *inside* when the tool must stop short of it, *outside* when the tool must go round it, *smooth* when
//! there is nothing to do.
//! An arc is *inside* when the tool runs between it and its centre (its offset radius is smaller), *outside* otherwise.
//!
//! | bend | corner |
//! |---|---|
//! | within the tolerance of 0 | smooth |
//! | positive | inside |
//! | negative | outside |
//! | within the tolerance of ±pi | outside between lines; with an arc, what the later arc says: inside if the tool is outside of it |
//!
//! # Style `TangentEntry`
//!
//! Found by running programs through LinuxCNC's standalone interpreter (2.9) and confirmed by comparing thousands of
//! random paths with it: points agree to 1e-4 mm, order, block and refusals are the same.
//!
//! | situation | path of the centre |
//! |---|---|
//! | entry by a line | straight to the point beside the line's end, perpendicular to the entry line itself; the line must be longer than the radius |
//! | entry by an arc | an arc from the start to the point beside the arc's end, with its centre moved along the radius of that end; the chord must be longer than the radius |
//! | entry without motion in the plane | refused as too short |
//! | smooth joint (bend within 0.05 rad) | nothing: the earlier segment ends beside its own end, and the later one starts there, a little off |
//! | outside corner before a feed or an arc | an arc about the corner, with the third coordinate held |
//! | outside corner before a rapid line | a straight rapid line to the same point |
//! | inside corner | the earlier segment ends, and the later one starts, where the offset curves meet; of two meeting points the one where the path turns to the tool's side |
//! | inside corner, no meeting point | gouge |
//! | arc whose ends lie at different distances from its centre | the distance of its end counts; a line before it is taken as meeting it there |
//! | arc on the inside with a radius not greater than the tool's | arc too small |
//! | motion of the third axis alone, or none | a line that stays beside the corner; an inside corner moves its end, too |
//! | program stop | gives out everything; the corner after it can no longer move the end before it |
//! | end of compensation, of the program | the last segment ends beside its own end; the motion after it starts there and must not be an arc |
//! | compensation again before any motion | the entry counts from the programmed position, and must not be an arc |
//! | radius zero | the programmed path, at once |
//! | negative radius | the other side |
//! | nose orientation | every point is shifted by a constant |
//!
//! A segment whose offset runs backwards is a gouge.
//! Whether it does is looked at when its end is fixed: at an inside corner, at an outside corner before a line, at a
//! program stop and at the end.
//! It is not looked at before a smooth joint or an outside corner before an arc, nor for an entry, nor for a segment
//! that starts at an inside corner right after a program stop.
//! A line runs backwards when its offset points against it at all; an arc, when it sweeps over 0.025 rad more than
//! programmed.
//!
//! Corner elements are given out with the block after the corner, segments with the block that fixes their end.
//!
//! One difference is on purpose.
//! An entry by an arc with a nose orientation is preceded by a line to the shifted start.
//! LinuxCNC gives the same when the next joint is smooth; elsewhere it moves that line's end to the arc's end and
//! refuses some of those programs for an internal fault.
//!
//! # Style `Intersection`
//!
//! | situation | path of the centre |
//! |---|---|
//! | entry by a line | straight to the point beside the *start of the next* segment |
//! | entry or exit by an arc | refused |
//! | motion of the third axis before the entry | unchanged |
//! | smooth joint (bend within 0.005 rad) | nothing |
//! | outside corner, turn up to the limit | the offset tangents are extended to their intersection |
//! | outside corner, sharper | both are extended by the radius and joined by a line |
//! | inside corner | where the offset curves meet |
//! | no meeting point, a segment that runs backwards, an arc too small | gouge |
//! | end of compensation | the last segment ends beside its own end |
//!
//! Inserted lines are feeds or rapids as the segment after the corner is.
//! Where a real control limits how many blocks without motion in the plane it reads past, this style has no limit.

mod path;
mod planar;
#[cfg(test)]
mod tests;

use planar::{Curve, Vector};
use std::collections::VecDeque;
use std::f64::consts::FRAC_PI_2;
use std::fmt;

/// A point of the path: two coordinates in the plane and the one along its normal, in mm.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PathPoint {
    /// Coordinate along the first axis of the plane.
    pub first: f64,
    /// Coordinate along the second axis of the plane.
    pub second: f64,
    /// Coordinate along the axis normal to the plane.
    pub normal: f64,
}

impl PathPoint {
    /// A point from its coordinates in mm.
    pub const fn new(first: f64, second: f64, normal: f64) -> Self {
        Self { first, second, normal }
    }

    const fn planar(self) -> Vector {
        Vector::new(self.first, self.second)
    }

    const fn above(point: Vector, normal: f64) -> Self {
        Self::new(point.first, point.second, normal)
    }

    fn is_usable(self) -> bool {
        is_usable(self.first) && is_usable(self.second) && is_usable(self.normal)
    }
}

/// Lengths beyond this (mm) are nobody's path, and their squares would lose the path's own figures.
const GREATEST_LENGTH: f64 = 1e12;

/// Known, finite and of a size that can be computed with.
fn is_usable(length: f64) -> bool {
    length.abs() <= GREATEST_LENGTH
}

/// The side of the programmed path on which the tool runs, seen along the path with the plane's normal upward.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum CutterSide {
    /// Left of the path.
    Left,
    /// Right of the path.
    Right,
}

/// How a line is travelled.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum LineKind {
    /// At rapid rate.
    Rapid,
    /// At feed rate.
    Feed,
}

/// Which rules are followed at entry, corners and exit.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum CompensationStyle {
    /// Perpendicular to the entry move; arcs round outside corners.
    TangentEntry,
    /// Perpendicular to the first compensated segment; sharp outside corners.
    Intersection,
}

/// The rules of a [`Compensator`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CompensationConfig {
    /// Which rules are followed.
    pub style: CompensationStyle,
    /// Bends smaller than this (radians) make no corner.
    pub bend_tolerance: f64,
    /// The greatest turn (radians) at an outside corner whose offset lines are extended to their intersection.
    /// Only for [`CompensationStyle::Intersection`].
    pub sharp_limit: f64,
    /// Whether an entry not longer than the radius is an error.
    pub entry_exceeds_radius: bool,
    /// Whether an inside arc of exactly the tool's radius is an error. Else the tool's centre stays where the arc has its
    /// own (an example of the Haas mill manual of 2017, p. 255, leads in so).
    pub arc_exceeds_radius: bool,
}

impl CompensationConfig {
    /// The rules of [`CompensationStyle::TangentEntry`] as observed.
    pub const fn tangent_entry() -> Self {
        Self {
            style: CompensationStyle::TangentEntry,
            bend_tolerance: 0.05,
            sharp_limit: FRAC_PI_2,
            entry_exceeds_radius: true,
            arc_exceeds_radius: true,
        }
    }

    /// The usual rules of [`CompensationStyle::Intersection`]: corners of up to 90 degrees of turn stay sharp.
    pub const fn intersection() -> Self {
        Self {
            style: CompensationStyle::Intersection,
            bend_tolerance: 0.005,
            sharp_limit: FRAC_PI_2,
            entry_exceeds_radius: false,
            arc_exceeds_radius: false,
        }
    }
}

/// The tool as compensation sees it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cutter {
    /// The side of the path.
    pub side: CutterSide,
    /// Radius of the tool or of its nose in mm; negative puts the tool on the other side, zero switches offsetting off.
    pub radius: f64,
    /// From the centre of the nose to the controlled point, (first, second) in mm; zero for a mill.
    pub shift: [f64; 2],
}

impl Cutter {
    /// A round tool whose controlled point is its centre.
    pub const fn new(side: CutterSide, radius: f64) -> Self {
        Self { side, radius, shift: [0.0, 0.0] }
    }

    /// A nose whose controlled point is the imaginary tip that lies `towards` units of the radius along each axis from
    /// the centre; each unit is -1, 0 or 1.
    #[must_use]
    pub fn with_tip(self, towards: [i8; 2]) -> Self {
        let radius = self.radius.abs();
        Self { shift: towards.map(|unit| f64::from(unit) * radius), ..self }
    }
}

/// The course of a segment given out.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum OffsetCourse {
    /// A straight line.
    Line(LineKind),
    /// An arc at feed rate; a helix when the normal coordinate changes.
    Arc {
        /// Centre in the plane: (first, second) in mm.
        centre: [f64; 2],
        /// Counter-clockwise in the plane.
        ccw: bool,
        /// Turns begun, at least 1, as programmed.
        turns: u32,
    },
}

/// A segment of the controlled point's path.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OffsetSegment {
    /// Where the segment starts: the end of the one before it.
    pub start: PathPoint,
    /// Where it ends.
    pub end: PathPoint,
    /// Line or arc.
    pub course: OffsetCourse,
}

/// What a [`Compensator`] gives out, in order of execution.
#[derive(Clone, Debug, PartialEq)]
pub enum OffsetEvent<M, E> {
    /// A programmed segment on its offset path.
    Programmed {
        /// The path.
        segment: OffsetSegment,
        /// What came with the programmed segment.
        payload: M,
    },
    /// A segment put in by compensation, at a corner or before the entry.
    Inserted {
        /// The path.
        segment: OffsetSegment,
        /// What came with the segment before it: its end values of other axes still hold. Absent before the entry.
        before: Option<M>,
        /// What came with the segment after it, which caused it; feed is that segment's.
        after: M,
    },
    /// What [`Compensator::pass`] was given.
    Passed(E),
}

/// Why the tool cannot follow the programmed path without cutting into it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum GougeKind {
    /// A line so short that the tool would run it backwards.
    LineReversed(LineKind),
    /// An arc so short that the tool would run it backwards.
    ArcReversed,
    /// An inside corner from a line into an arc that the tool does not fit in.
    LineIntoArc,
    /// An inside corner from an arc into a line that the tool does not fit in.
    ArcIntoLine,
    /// An inside corner between two arcs that the tool does not fit in.
    ArcIntoArc,
    /// An inside corner between two arcs about the same centre.
    SameCentre,
    /// An inside corner between two lines that lie on each other.
    LineIntoLine,
}

/// Why the path cannot be compensated.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum CompensationError {
    /// Compensation is started while it is on.
    AlreadyOn,
    /// A segment is given while compensation is off.
    NotOn,
    /// A coordinate or the radius is not known (not a number) or beyond 1e12 mm.
    NotUsable,
    /// The entry line, or the chord of the entry arc, is not longer than the tool's radius.
    EntryTooShort {
        /// The tool's radius in mm, which the length must exceed.
        needed: f64,
        /// The length in the plane in mm.
        got: f64,
        /// Whether the entry is an arc.
        arc: bool,
    },
    /// The entry is an arc, and the style does not allow it.
    EntryIsArc,
    /// The motion after the end of compensation is an arc.
    ExitIsArc,
    /// An arc with no radius, or an entry arc without an offset arc to the same end.
    ZeroLength,
    /// The tool runs on the inside of an arc whose radius is not greater than the tool's.
    ArcTooSmall {
        /// Radius of the arc in mm.
        radius: f64,
        /// Radius of the tool in mm.
        tool_radius: f64,
    },
    /// The tool cannot follow without cutting into the path.
    Gouge {
        /// What does not fit.
        kind: GougeKind,
        /// The programmed end of the segment that does not fit: (first, second) in mm.
        corner: [f64; 2],
    },
}

impl fmt::Display for CompensationError {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::AlreadyOn => out.write_str("compensation is already on"),
            Self::NotOn => out.write_str("compensation is off"),
            Self::NotUsable => out.write_str("a coordinate is not known"),
            Self::EntryTooShort { needed, got, arc } => {
                let part = if *arc { "chord of the entry arc" } else { "entry move" };
                write!(
                    out,
                    "the {part} is {got:.4} mm; it must be longer than the tool's radius of {needed:.4} mm"
                )
            }
            Self::EntryIsArc => out.write_str("compensation starts on an arc"),
            Self::ExitIsArc => out.write_str("compensation ends on an arc"),
            Self::ZeroLength => out.write_str("the arc has no radius"),
            Self::ArcTooSmall { radius, tool_radius } => {
                write!(
                    out,
                    "the arc's radius of {radius:.4} mm is too small for the tool's {tool_radius:.4} mm"
                )
            }
            Self::Gouge { kind, corner: [first, second] } => {
                let what = match kind {
                    GougeKind::LineReversed(_) => "the line is too short for the tool",
                    GougeKind::ArcReversed => "the arc is too short for the tool",
                    GougeKind::SameCentre => "the path turns back along the same arc",
                    GougeKind::LineIntoArc
                    | GougeKind::ArcIntoLine
                    | GougeKind::ArcIntoArc
                    | GougeKind::LineIntoLine => "the tool does not fit into the corner",
                };
                write!(out, "{what} at ({first:.4}, {second:.4})")
            }
        }
    }
}

impl std::error::Error for CompensationError {}

/// What [`Compensator::stop`] leaves.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CompensationExit {
    /// Where the controlled point is; the next motion starts here.
    pub position: PathPoint,
    /// The last programmed point; coordinates that the next motion leaves out are these.
    pub programmed: PathPoint,
}

/// Offsets a path, segment by segment.
///
/// `M` is what comes with a segment (source block, other axes, feed); `E` is what comes between segments.
///
/// After an error, compensation is off, what was held back is gone, and [`Compensator::position`] is where the path
/// ended.
#[derive(Clone, Debug, PartialEq)]
pub struct Compensator<M, E = M> {
    config: CompensationConfig,
    state: State,
    /// What is held back until the next segment in the plane is known.
    queue: VecDeque<Queued<M, E>>,
    /// What came with the segment given last.
    last_payload: Option<M>,
}

#[derive(Clone, Debug, PartialEq)]
struct State {
    phase: Phase,
    /// On the left: 1, on the right: -1.
    side: f64,
    /// Not negative.
    radius: f64,
    shift: Vector,
    /// End of the last programmed segment.
    programmed: PathPoint,
    /// Where the tool's centre will be when everything queued is given out.
    planned: PathPoint,
    /// Where the tool's centre is after what has been given out.
    centre: PathPoint,
    /// Where the controlled point is: the centre, shifted unless the entry is still to come.
    controlled: PathPoint,
    last: Option<Last>,
    /// The motion that comes next leaves the offset path.
    leaving: bool,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Phase {
    Off,
    Entering,
    On,
}

/// The segment in the plane given last.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Last {
    /// What its offset lies on.
    curve: Curve,
    /// Its direction at its programmed end.
    tangent: Vector,
    /// Its programmed end.
    corner: Vector,
    /// It is the entry, whose end the next segment's start decides.
    open_entry: bool,
    /// A program stop came after it.
    stopped: bool,
}

#[derive(Clone, Debug, PartialEq)]
enum Queued<M, E> {
    Move(Waiting<M>),
    Event(E),
}

#[derive(Clone, Debug, PartialEq)]
struct Waiting<M> {
    /// End of the tool's centre.
    end: PathPoint,
    course: OffsetCourse,
    programmed: Programmed,
    payload: M,
}

/// What a waiting segment was before offsetting, as far as running backwards is concerned.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Programmed {
    /// May run anywhere: the entry, or no motion in the plane.
    Free,
    Line {
        direction: Vector,
        corner: Vector,
    },
    Arc {
        sweep: f64,
        corner: Vector,
    },
}

/// A programmed segment in the plane.
#[derive(Clone, Copy, Debug)]
enum Segment {
    Line { kind: LineKind },
    Arc { centre: Vector, ccw: bool, turns: u32 },
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Corner {
    Smooth,
    Inside,
    Outside,
}

impl<M: Clone, E> Compensator<M, E> {
    /// A compensator that is off.
    pub fn new(config: CompensationConfig) -> Self {
        Self {
            config,
            state: State::at(PathPoint::new(0.0, 0.0, 0.0)),
            queue: VecDeque::new(),
            last_payload: None,
        }
    }

    /// Switches compensation on; `position` is the programmed position.
    ///
    /// The controlled point is there, too, unless compensation has just been stopped and nothing has moved since
    /// ([`Compensator::exit_motion`] has not been called): then it is where it was left.
    ///
    /// # Errors
    ///
    /// [`CompensationError::AlreadyOn`] and [`CompensationError::NotUsable`]; compensation stays as it was.
    pub fn start(&mut self, cutter: Cutter, position: PathPoint) -> Result<(), CompensationError> {
        if self.is_on() {
            return Err(CompensationError::AlreadyOn);
        }
        let [first, second] = cutter.shift;
        if !(position.is_usable() && is_usable(cutter.radius) && is_usable(first) && is_usable(second)) {
            return Err(CompensationError::NotUsable);
        }
        let left = (cutter.side == CutterSide::Left) == (cutter.radius >= 0.0);
        let (leaving, controlled) = (self.state.leaving, self.state.controlled);
        self.state = State::at(position);
        if leaving {
            self.state.leaving = true;
            self.state.controlled = controlled;
        }
        self.state.phase = Phase::Entering;
        self.state.side = if left { 1.0 } else { -1.0 };
        self.state.radius = cutter.radius.abs();
        self.state.shift = Vector::new(first, second);
        self.last_payload = None;
        Ok(())
    }

    /// Whether compensation is on.
    pub fn is_on(&self) -> bool {
        self.state.phase != Phase::Off
    }

    /// The end of the last programmed segment: where the next one starts.
    pub fn programmed(&self) -> PathPoint {
        self.state.programmed
    }

    /// Where the controlled point will be when everything held back is given out, as far as known:
    /// the next segment may still move it.
    pub fn position(&self) -> PathPoint {
        if self.queue.is_empty() { self.state.controlled } else { self.state.shifted(self.state.planned) }
    }

    /// Whether this path goes on as another does, where `moves` and `events` tell which of what is held back are alike. Levels
    /// along the normal are those of the moves.
    pub fn goes_on_as(
        &self,
        other: &Self,
        moves: impl Fn(&M, &M) -> bool,
        events: impl Fn(&E, &E) -> bool,
    ) -> bool {
        let alike = |a: &Queued<M, E>, b: &Queued<M, E>| match (a, b) {
            (Queued::Move(a), Queued::Move(b)) => {
                a.end.planar() == b.end.planar()
                    && (&a.course, &a.programmed) == (&b.course, &b.programmed)
                    && moves(&a.payload, &b.payload)
            }
            (Queued::Event(a), Queued::Event(b)) => events(a, b),
            (Queued::Move(_), Queued::Event(_)) | (Queued::Event(_), Queued::Move(_)) => false,
        };
        self.config == other.config
            && self.state.without_levels() == other.state.without_levels()
            && self.queue.len() == other.queue.len()
            && self.queue.iter().zip(&other.queue).all(|(a, b)| alike(a, b))
            && match (&self.last_payload, &other.last_payload) {
                (None, None) => true,
                (Some(a), Some(b)) => moves(a, b),
                _ => false,
            }
    }

    /// What comes with the moves that are held back.
    pub fn held_back(&self) -> impl Iterator<Item = &M> {
        self.queue.iter().filter_map(|queued| match queued {
            Queued::Move(waiting) => Some(&waiting.payload),
            Queued::Event(_) => None,
        })
    }

    /// Whether something is held back.
    pub fn is_waiting(&self) -> bool {
        !self.queue.is_empty()
    }

    /// A line to `to`; a line without motion in the plane keeps its place beside the corner.
    ///
    /// # Errors
    ///
    /// Any; compensation is then off.
    pub fn line(
        &mut self,
        to: PathPoint,
        kind: LineKind,
        payload: M,
        mut emit: impl FnMut(OffsetEvent<M, E>),
    ) -> Result<(), CompensationError> {
        let result = self.add_line(to, kind, payload, &mut emit);
        self.or_off(result)
    }

    /// An arc or helix at feed rate to `to` about `centre` (first, second), with the turns it begins (at least 1).
    /// An arc that ends where it starts is a full circle.
    ///
    /// # Errors
    ///
    /// Any; compensation is then off.
    pub fn arc(
        &mut self,
        to: PathPoint,
        centre: [f64; 2],
        ccw: bool,
        turns: u32,
        payload: M,
        mut emit: impl FnMut(OffsetEvent<M, E>),
    ) -> Result<(), CompensationError> {
        let result = self.add_arc(to, centre, ccw, turns, payload, &mut emit);
        self.or_off(result)
    }

    /// Something that must keep its place between the moves: given out at once when nothing is held back.
    pub fn pass(&mut self, event: E, mut emit: impl FnMut(OffsetEvent<M, E>)) {
        if self.queue.is_empty() {
            emit(OffsetEvent::Passed(event));
        } else {
            self.queue.push_back(Queued::Event(event));
        }
    }

    /// Gives out what is held back, as a program stop does; the corner after it can no longer move the end before it.
    ///
    /// # Errors
    ///
    /// [`CompensationError::Gouge`]; compensation is then off.
    pub fn flush(&mut self, mut emit: impl FnMut(OffsetEvent<M, E>)) -> Result<(), CompensationError> {
        let result = self.give_out(&mut emit);
        if let Some(last) = self.state.last.as_mut() {
            last.stopped = self.config.style == CompensationStyle::TangentEntry;
        }
        self.or_off(result)
    }

    /// Gives out what is held back and switches compensation off.
    ///
    /// The motion that comes next belongs to the caller: it starts at [`CompensationExit::position`].
    /// [`Compensator::exit_motion`] must be told of it.
    ///
    /// # Errors
    ///
    /// [`CompensationError::NotOn`], and [`CompensationError::Gouge`] for the last segment.
    pub fn stop(
        &mut self,
        mut emit: impl FnMut(OffsetEvent<M, E>),
    ) -> Result<CompensationExit, CompensationError> {
        if !self.is_on() {
            return Err(CompensationError::NotOn);
        }
        let result = self.give_out(&mut emit);
        self.or_off(result)?;
        self.state.leaving |= self.state.phase == Phase::On && self.state.radius > 0.0;
        self.state.phase = Phase::Off;
        self.last_payload = None;
        Ok(CompensationExit { position: self.state.controlled, programmed: self.state.programmed })
    }

    /// Tells of the first motion after [`Compensator::stop`]; later calls do nothing.
    ///
    /// # Errors
    ///
    /// [`CompensationError::ExitIsArc`] when the offset path is left by an arc.
    pub fn exit_motion(&mut self, is_arc: bool) -> Result<(), CompensationError> {
        let leaving = std::mem::take(&mut self.state.leaving);
        if leaving && is_arc { Err(CompensationError::ExitIsArc) } else { Ok(()) }
    }

    fn or_off<T>(&mut self, result: Result<T, CompensationError>) -> Result<T, CompensationError> {
        if result.is_err() {
            self.state.phase = Phase::Off;
            self.state.leaving = false;
            self.queue.clear();
            self.last_payload = None;
        }
        result
    }
}

impl State {
    /// The same with every point at level 0.
    fn without_levels(&self) -> Self {
        let flat = |point: PathPoint| PathPoint { normal: 0.0, ..point };
        Self {
            programmed: flat(self.programmed),
            planned: flat(self.planned),
            centre: flat(self.centre),
            controlled: flat(self.controlled),
            ..self.clone()
        }
    }

    fn at(position: PathPoint) -> Self {
        Self {
            phase: Phase::Off,
            side: 1.0,
            radius: 0.0,
            shift: Vector::ZERO,
            programmed: position,
            planned: position,
            centre: position,
            controlled: position,
            last: None,
            leaving: false,
        }
    }

    fn shifted(&self, centre: PathPoint) -> PathPoint {
        PathPoint::above(centre.planar() + self.shift, centre.normal)
    }

    /// The offset from a point of the path with this direction of travel to the tool's centre.
    fn beside(&self, tangent: Vector) -> Vector {
        tangent.left() * (self.side * self.radius)
    }
}
