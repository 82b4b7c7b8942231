//! The steps of offsetting: entry, corners, and what is held back.
//!
//! Knows one segment and the one before it; must not know more of the path.

use super::planar::{Curve, Meeting, Vector, meet, sweep};
use super::{
    CompensationError, CompensationStyle, Compensator, Corner, GougeKind, Last, LineKind, OffsetCourse,
    OffsetEvent, OffsetSegment, PathPoint, Phase, Programmed, Queued, Segment, State, Waiting, is_usable,
};
use std::f64::consts::{PI, TAU};

/// How far (mm) a segment may run backwards in [`CompensationStyle::Intersection`], where rounding has made it so.
const BACKWARDS_SLACK: f64 = 1e-6;

/// A bend (radians) that rounding of coordinates can make of a tangent joint.
const ROUNDING_BEND: f64 = 0.05;

/// How much more than programmed (radians) an arc may sweep; one that has been shortened past its start sweeps nearly a
/// turn more.
const SWEEP_SLACK: f64 = 0.025;

/// An inside arc that is larger or smaller than the tool by less (mm) fits it exactly; its offset is a circle of this radius.
const FITS: f64 = 1e-6;

/// A segment in the plane with its offset.
#[derive(Clone, Copy, Debug)]
struct Offset {
    segment: Segment,
    curve: Curve,
    /// Programmed directions at both ends.
    start_tangent: Vector,
    end_tangent: Vector,
    /// Beside the programmed ends.
    start: Vector,
    end: Vector,
    /// Angle swept as programmed; zero for a line.
    sweep: f64,
    to: PathPoint,
}

impl Offset {
    fn course(&self) -> OffsetCourse {
        match self.segment {
            Segment::Line { kind } => OffsetCourse::Line(kind),
            Segment::Arc { centre, ccw, turns } => {
                OffsetCourse::Arc { centre: [centre.first, centre.second], ccw, turns }
            }
        }
    }

    fn is_arc(&self) -> bool {
        matches!(self.segment, Segment::Arc { .. })
    }
}

impl<M: Clone, E> Compensator<M, E> {
    pub(super) fn add_line(
        &mut self,
        to: PathPoint,
        kind: LineKind,
        payload: M,
        emit: &mut impl FnMut(OffsetEvent<M, E>),
    ) -> Result<(), CompensationError> {
        self.ready(to)?;
        self.state.leaving = false;
        let from = self.state.programmed.planar();
        let moved = to.planar() - from;
        if self.state.radius > 0.0 && moved == Vector::ZERO {
            return self.add_standing(to, kind, payload, emit);
        }
        if self.state.radius > 0.0 && self.state.phase == Phase::Entering {
            self.check_entry(to, false)?;
        }
        let tangent = moved.unit();
        let beside = self.state.beside(tangent);
        let offset = Offset {
            segment: Segment::Line { kind },
            curve: Curve::Line { point: to.planar() + beside, direction: tangent },
            start_tangent: tangent,
            end_tangent: tangent,
            start: from + beside,
            end: to.planar() + beside,
            sweep: 0.0,
            to,
        };
        self.add(offset, payload, emit)
    }

    pub(super) fn add_arc(
        &mut self,
        to: PathPoint,
        [first, second]: [f64; 2],
        ccw: bool,
        turns: u32,
        payload: M,
        emit: &mut impl FnMut(OffsetEvent<M, E>),
    ) -> Result<(), CompensationError> {
        self.ready(to)?;
        let centre = Vector::new(first, second);
        if !(is_usable(first) && is_usable(second)) {
            return Err(CompensationError::NotUsable);
        }
        if self.state.phase == Phase::Entering {
            self.exit_motion(true)?;
        }
        let (from_centre, to_centre) = (self.state.programmed.planar() - centre, to.planar() - centre);
        let radius = to_centre.length();
        if !(from_centre.length() > 0.0 && radius > 0.0) {
            return Err(CompensationError::ZeroLength);
        }
        let tool_radius = self.state.radius;
        let tangent = |spoke: Vector| if ccw { spoke.unit().left() } else { -spoke.unit().left() };
        let (start_tangent, end_tangent) = (tangent(from_centre), tangent(to_centre));
        let inside = ccw == (self.state.side > 0.0);
        if tool_radius > 0.0 {
            if self.state.phase == Phase::Entering {
                self.check_entry(to, true)?;
            }
            let least = if self.config.arc_exceeds_radius { tool_radius } else { tool_radius - FITS };
            if inside && radius <= least {
                return Err(CompensationError::ArcTooSmall { radius, tool_radius });
            }
        }
        let swept = sweep(from_centre, to_centre, ccw);
        let offset = Offset {
            segment: Segment::Arc { centre, ccw, turns: turns.max(1) },
            curve: Curve::Circle {
                centre,
                radius: if inside { (radius - tool_radius).max(FITS) } else { radius + tool_radius },
                ccw,
            },
            start_tangent,
            end_tangent,
            start: self.state.programmed.planar() + self.state.beside(start_tangent),
            end: to.planar() + self.state.beside(end_tangent),
            sweep: if swept > 0.0 { swept } else { TAU },
            to,
        };
        self.add(offset, payload, emit)
    }

    fn ready(&self, to: PathPoint) -> Result<(), CompensationError> {
        if self.state.phase == Phase::Off {
            return Err(CompensationError::NotOn);
        }
        if to.is_usable() { Ok(()) } else { Err(CompensationError::NotUsable) }
    }

    fn add(
        &mut self,
        offset: Offset,
        payload: M,
        emit: &mut impl FnMut(OffsetEvent<M, E>),
    ) -> Result<(), CompensationError> {
        if self.state.radius <= 0.0 {
            let waiting = Waiting {
                end: offset.to,
                course: offset.course(),
                programmed: Programmed::Free,
                payload: payload.clone(),
            };
            self.state.emit(waiting, emit);
            self.state.planned = offset.to;
        } else {
            match (self.state.phase, self.state.last, self.config.style) {
                (Phase::On, Some(last), _) => self.corner(last, offset, &payload, emit)?,
                (_, _, CompensationStyle::TangentEntry) => self.tangent_entry(offset, &payload, emit)?,
                (_, _, CompensationStyle::Intersection) => self.open_entry(offset, &payload),
            }
        }
        self.state.phase = Phase::On;
        self.state.programmed = offset.to;
        self.last_payload = Some(payload);
        Ok(())
    }

    /// A line without motion in the plane.
    fn add_standing(
        &mut self,
        to: PathPoint,
        kind: LineKind,
        payload: M,
        emit: &mut impl FnMut(OffsetEvent<M, E>),
    ) -> Result<(), CompensationError> {
        let course = OffsetCourse::Line(kind);
        if self.state.phase == Phase::Entering {
            if self.config.style == CompensationStyle::TangentEntry {
                return Err(CompensationError::EntryTooShort {
                    needed: self.state.radius,
                    got: 0.0,
                    arc: false,
                });
            }
            let end = PathPoint::above(self.state.centre.planar(), to.normal);
            self.state.centre = end;
            let start = self.state.controlled;
            self.state.controlled.normal = to.normal;
            let segment = OffsetSegment { start, end: self.state.controlled, course };
            emit(OffsetEvent::Programmed { segment, payload: payload.clone() });
            self.state.planned = end;
        } else {
            let end = PathPoint::above(self.state.planned.planar(), to.normal);
            if let Some(last) = self.state.last.as_mut().filter(|last| last.stopped) {
                // After a program stop this line stands for the segment before the corner.
                last.curve = Curve::Line { point: end.planar(), direction: last.tangent };
            }
            self.queue.push_back(Queued::Move(Waiting {
                end,
                course,
                programmed: Programmed::Free,
                payload: payload.clone(),
            }));
            self.state.planned = end;
        }
        self.state.programmed = to;
        self.last_payload = Some(payload);
        Ok(())
    }

    /// The entry of [`CompensationStyle::TangentEntry`].
    fn tangent_entry(
        &mut self,
        offset: Offset,
        payload: &M,
        emit: &mut impl FnMut(OffsetEvent<M, E>),
    ) -> Result<(), CompensationError> {
        let from = self.state.centre.planar();
        let (mut course, mut curve) = (offset.course(), offset.curve);
        if let Segment::Arc { centre, ccw, turns } = offset.segment {
            // The arc through the start that reaches the offset end in the direction of the programmed arc.
            let spoke = (offset.to.planar() - centre).unit();
            let chord = offset.end - from;
            let reach = chord.dot(chord) / (2.0 * spoke.dot(chord));
            let moved = offset.end - spoke * reach;
            if !(reach.is_finite() && moved.first.is_finite() && moved.second.is_finite()) {
                return Err(CompensationError::ZeroLength);
            }
            course = OffsetCourse::Arc { centre: [moved.first, moved.second], ccw, turns };
            curve = Curve::Circle { centre: moved, radius: reach.abs(), ccw };
            if self.state.shift != Vector::ZERO {
                let start = self.state.controlled;
                self.state.controlled = self.state.shifted(self.state.centre);
                let segment = OffsetSegment {
                    start,
                    end: self.state.controlled,
                    course: OffsetCourse::Line(LineKind::Feed),
                };
                emit(OffsetEvent::Inserted { segment, before: None, after: payload.clone() });
            }
        }
        self.hold(&offset, course, Programmed::Free, payload);
        self.state.last = Some(Last {
            curve,
            tangent: offset.end_tangent,
            corner: offset.to.planar(),
            open_entry: false,
            stopped: false,
        });
        Ok(())
    }

    /// The entry of [`CompensationStyle::Intersection`], whose end the next segment decides.
    fn open_entry(&mut self, offset: Offset, payload: &M) {
        self.hold(&offset, offset.course(), Programmed::Free, payload);
        self.state.last = Some(Last {
            curve: offset.curve,
            tangent: offset.end_tangent,
            corner: offset.to.planar(),
            open_entry: true,
            stopped: false,
        });
    }

    fn check_entry(&self, to: PathPoint, arc: bool) -> Result<(), CompensationError> {
        if arc && self.config.style == CompensationStyle::Intersection {
            return Err(CompensationError::EntryIsArc);
        }
        let (needed, got) = (self.state.radius, (to.planar() - self.state.centre.planar()).length());
        if self.config.entry_exceeds_radius && got <= needed {
            return Err(CompensationError::EntryTooShort { needed, got, arc });
        }
        Ok(())
    }

    /// Holds a segment back that ends beside its programmed end until the next one says otherwise.
    fn hold(&mut self, offset: &Offset, course: OffsetCourse, programmed: Programmed, payload: &M) {
        let end = PathPoint::above(offset.end, offset.to.normal);
        self.queue.push_back(Queued::Move(Waiting { end, course, programmed, payload: payload.clone() }));
        self.state.planned = end;
    }

    /// A segment after another: settles the end of the one before and holds the new one back.
    fn corner(
        &mut self,
        last: Last,
        offset: Offset,
        payload: &M,
        emit: &mut impl FnMut(OffsetEvent<M, E>),
    ) -> Result<(), CompensationError> {
        // After a program stop nothing is left to move: an inside corner starts like an entry.
        let mut like_entry = false;
        if last.open_entry {
            self.move_end(offset.start);
            self.give_out(emit)?;
        } else {
            let corner = self.classify(&last, &offset);
            like_entry = corner == Corner::Inside
                && self.config.style == CompensationStyle::TangentEntry
                && self.queue.is_empty();
            match corner {
                Corner::Smooth => self.give_out_unseen(emit)?,
                Corner::Inside => self.inside(&last, &offset, emit)?,
                Corner::Outside => self.outside(&last, &offset, payload, emit)?,
            }
        }
        let corner = offset.to.planar();
        let programmed = match offset.segment {
            _ if like_entry => Programmed::Free,
            Segment::Line { .. } => Programmed::Line { direction: offset.start_tangent, corner },
            Segment::Arc { .. } => Programmed::Arc { sweep: offset.sweep, corner },
        };
        self.hold(&offset, offset.course(), programmed, payload);
        self.state.last = Some(Last {
            curve: offset.curve,
            tangent: offset.end_tangent,
            corner,
            open_entry: false,
            stopped: false,
        });
        Ok(())
    }

    fn classify(&self, last: &Last, offset: &Offset) -> Corner {
        let bend = last.tangent.turn_to(offset.start_tangent) * self.state.side;
        let tolerance = self.config.bend_tolerance;
        if bend.abs() <= tolerance {
            return Corner::Smooth;
        }
        if bend.abs() < PI - tolerance {
            return if bend > 0.0 { Corner::Inside } else { Corner::Outside };
        }
        // The path turns back on itself: on which side its two legs part, curvature decides.
        let tool_is_left = self.state.side > 0.0;
        match (last.curve, offset.curve) {
            (Curve::Circle { .. }, Curve::Line { .. }) if last.stopped => Corner::Outside,
            (_, Curve::Circle { ccw, .. }) | (Curve::Circle { ccw, .. }, Curve::Line { .. }) => {
                if ccw == tool_is_left { Corner::Outside } else { Corner::Inside }
            }
            (Curve::Line { .. }, Curve::Line { .. }) => Corner::Outside,
        }
    }

    fn inside(
        &mut self,
        last: &Last,
        offset: &Offset,
        emit: &mut impl FnMut(OffsetEvent<M, E>),
    ) -> Result<(), CompensationError> {
        let corner = [last.corner.first, last.corner.second];
        let (before, after) = match (last.curve, offset.curve) {
            (Curve::Line { .. }, Curve::Circle { .. }) => {
                (last.curve.moved(self.state.off_circle(offset.curve, last.corner)), offset.curve)
            }
            (Curve::Circle { .. }, Curve::Line { .. }) => {
                (last.curve, offset.curve.moved(self.state.off_circle(last.curve, last.corner)))
            }
            both => both,
        };
        let meeting = match meet(before, after, self.state.side > 0.0) {
            Meeting::At(meeting) => meeting,
            Meeting::Concentric => {
                return Err(CompensationError::Gouge { kind: GougeKind::SameCentre, corner });
            }
            // Rounded coordinates can part the offsets of arcs that are all but tangent.
            Meeting::Apart
                if self.config.style == CompensationStyle::Intersection
                    && last.bend_to(offset) < ROUNDING_BEND =>
            {
                return self.give_out(emit);
            }
            Meeting::Apart => {
                let kind = match (last.curve, offset.curve) {
                    (Curve::Line { .. }, Curve::Line { .. }) => GougeKind::LineIntoLine,
                    (Curve::Line { .. }, Curve::Circle { .. }) => GougeKind::LineIntoArc,
                    (Curve::Circle { .. }, Curve::Line { .. }) => GougeKind::ArcIntoLine,
                    (Curve::Circle { .. }, Curve::Circle { .. }) => GougeKind::ArcIntoArc,
                };
                return Err(CompensationError::Gouge { kind, corner });
            }
        };
        self.move_end(meeting);
        self.give_out(emit)
    }

    fn outside(
        &mut self,
        last: &Last,
        offset: &Offset,
        payload: &M,
        emit: &mut impl FnMut(OffsetEvent<M, E>),
    ) -> Result<(), CompensationError> {
        let line = match offset.segment {
            Segment::Line { kind } => kind,
            Segment::Arc { .. } => LineKind::Feed,
        };
        if self.config.style == CompensationStyle::TangentEntry {
            if offset.is_arc() {
                self.give_out_unseen(emit)?;
            } else {
                self.give_out(emit)?;
            }
            let course = match line {
                LineKind::Rapid => OffsetCourse::Line(line),
                LineKind::Feed => {
                    let centre = [last.corner.first, last.corner.second];
                    OffsetCourse::Arc { centre, ccw: self.state.side < 0.0, turns: 1 }
                }
            };
            self.insert(offset.start, course, payload, emit);
            return Ok(());
        }
        let (from, to) = (last.corner + self.state.beside(last.tangent), offset.start);
        let (out, back) = (last.tangent, offset.start_tangent);
        let (near, far) = if out.turn_to(back).abs() <= self.config.sharp_limit {
            // Both offset tangents reach their intersection after r * tan(turn / 2).
            let tip = from + out * (self.state.radius * (out.turn_to(back).abs() / 2.0).tan());
            (tip, None)
        } else {
            (from + out * self.state.radius, Some(to - back * self.state.radius))
        };
        let course = OffsetCourse::Line(line);
        if matches!(last.curve, Curve::Line { .. }) {
            self.move_end(near);
            self.give_out(emit)?;
        } else {
            self.give_out(emit)?;
            self.insert(near, course, payload, emit);
        }
        if let Some(far) = far {
            self.insert(far, course, payload, emit);
        }
        if offset.is_arc() {
            self.insert(to, course, payload, emit);
        }
        Ok(())
    }

    /// Moves the end of everything held back that is at the last corner.
    fn move_end(&mut self, to: Vector) {
        let mut moved = false;
        for queued in &mut self.queue {
            if let Queued::Move(waiting) = queued {
                waiting.end = PathPoint::above(to, waiting.end.normal);
                moved = true;
            }
        }
        if moved {
            self.state.planned = PathPoint::above(to, self.state.planned.normal);
        }
    }

    /// Gives out one segment that compensation puts in.
    fn insert(
        &mut self,
        to: Vector,
        course: OffsetCourse,
        payload: &M,
        emit: &mut impl FnMut(OffsetEvent<M, E>),
    ) {
        let end = PathPoint::above(to, self.state.centre.normal);
        let segment = self.state.travel(end, course);
        self.state.planned = end;
        emit(OffsetEvent::Inserted { segment, before: self.last_payload.clone(), after: payload.clone() });
    }

    /// Gives out everything held back.
    pub(super) fn give_out(
        &mut self,
        emit: &mut impl FnMut(OffsetEvent<M, E>),
    ) -> Result<(), CompensationError> {
        while let Some(queued) = self.queue.pop_front() {
            match queued {
                Queued::Event(event) => emit(OffsetEvent::Passed(event)),
                Queued::Move(waiting) => {
                    self.state.check(&waiting, self.config.style)?;
                    self.state.emit(waiting, emit);
                }
            }
        }
        Ok(())
    }

    /// Gives out everything held back, at a corner where [`CompensationStyle::TangentEntry`] does not look whether a
    /// segment runs backwards.
    fn give_out_unseen(&mut self, emit: &mut impl FnMut(OffsetEvent<M, E>)) -> Result<(), CompensationError> {
        if self.config.style == CompensationStyle::TangentEntry {
            for queued in &mut self.queue {
                if let Queued::Move(waiting) = queued {
                    waiting.programmed = Programmed::Free;
                }
            }
        }
        self.give_out(emit)
    }
}

impl Last {
    /// The unsigned turn at the corner before `offset`.
    fn bend_to(&self, offset: &Offset) -> f64 {
        self.tangent.turn_to(offset.start_tangent).abs()
    }
}

impl State {
    /// Moves the centre along a segment; the controlled point follows.
    fn travel(&mut self, end: PathPoint, course: OffsetCourse) -> OffsetSegment {
        let start = self.controlled;
        self.centre = end;
        self.controlled = self.shifted(end);
        let course = match course {
            OffsetCourse::Line(_) => course,
            OffsetCourse::Arc { centre: [first, second], ccw, turns } => {
                let centre = [first + self.shift.first, second + self.shift.second];
                OffsetCourse::Arc { centre, ccw, turns }
            }
        };
        OffsetSegment { start, end: self.controlled, course }
    }

    fn emit<M, E>(&mut self, waiting: Waiting<M>, emit: &mut impl FnMut(OffsetEvent<M, E>)) {
        let segment = self.travel(waiting.end, waiting.course);
        emit(OffsetEvent::Programmed { segment, payload: waiting.payload });
    }

    /// From a corner to the point of the programmed circle in the same direction from its centre.
    ///
    /// An arc's ends may lie at slightly different distances from its centre, and the distance of its end counts.
    fn off_circle(&self, offset: Curve, corner: Vector) -> Vector {
        match offset {
            Curve::Line { .. } => Vector::ZERO,
            Curve::Circle { centre, radius, ccw } => {
                let inside = ccw == (self.side > 0.0);
                let programmed = if inside { radius + self.radius } else { radius - self.radius };
                centre + (corner - centre).unit() * programmed - corner
            }
        }
    }

    /// A segment must not run backwards.
    fn check<M>(&self, waiting: &Waiting<M>, style: CompensationStyle) -> Result<(), CompensationError> {
        let slack = match style {
            CompensationStyle::TangentEntry => 0.0,
            CompensationStyle::Intersection => BACKWARDS_SLACK,
        };
        let (from, to) = (self.centre.planar(), waiting.end.planar());
        let (kind, corner) = match (waiting.programmed, waiting.course) {
            (Programmed::Line { direction, corner }, OffsetCourse::Line(kind))
                if (to - from).dot(direction) < -slack =>
            {
                (GougeKind::LineReversed(kind), corner)
            }
            (Programmed::Arc { sweep: programmed, corner }, OffsetCourse::Arc { centre, ccw, .. })
                if {
                    let centre = Vector::new(centre[0], centre[1]);
                    sweep(from - centre, to - centre, ccw) > programmed + SWEEP_SLACK
                } =>
            {
                (GougeKind::ArcReversed, corner)
            }
            _ => return Ok(()),
        };
        Err(CompensationError::Gouge { kind, corner: [corner.first, corner.second] })
    }
}
