//! Moves on their way to the observer: straight through, or by the cutter compensation.
//!
//! Knows: which events wait for the next move. Must not know: how the offset path is computed (`gcheck-geometry`).

use std::rc::Rc;

use gcheck_controls::{CompensationStyle, Effect, Letter, Semantics};
use gcheck_geometry::{
    Arc, CompensationConfig, CompensationError, Compensator, Cutter, CutterSide, LineKind, Mm, OffsetCourse,
    OffsetEvent, OffsetSegment, PathPoint, Plane, sweep_about,
};

use crate::assumption::{Assumption, Unsettled};
use crate::eval::value::Domain;
use crate::event::{ArcMove, Event, Travel, TravelKind};
use crate::exec::arc::axes_of_plane;
use crate::exec::context::{Count, Executor, Step};
use crate::fault::{CompensationFault, Fault};
use crate::lattice::{Flat, Lattice, Perhaps};
use crate::model::Role;
use crate::observer::Observer;
use crate::origin::Origin;
use crate::position::Position;
use crate::state::{Compensation, Course, ModeSet, Programmed, State, ToolData};

type Offset = OffsetEvent<Programmed, (Origin, Event)>;

fn config(semantics: &Semantics) -> CompensationConfig {
    match semantics.compensation.style {
        CompensationStyle::TangentEntry => CompensationConfig::tangent_entry(),
        CompensationStyle::Intersection => CompensationConfig::intersection(),
    }
}

impl<D: Domain, O: Observer<D>> Executor<'_, '_, D, O> {
    /// An event while compensation is on: it keeps its place between the moves.
    pub(crate) fn emit_compensated(&mut self, state: &mut State<D>, event: Event) {
        let Some(mut compensation) = state.compensation.take_followed() else { return };
        let followed = Rc::make_mut(&mut compensation);
        let mut out = Vec::new();
        followed.compensator.pass((self.origin(), event), |offset| out.push(offset));
        self.give_out(followed, out, state);
        state.compensation.follow_path(compensation);
    }

    /// `G41`, `G42` and their kin.
    pub(crate) fn compensation_on(&mut self, effect: Effect, state: &mut State<D>) -> Step {
        let left = matches!(effect, Effect::CompensationLeft | Effect::CompensationLeftByDiameter);
        if effect == Effect::CompensationVector {
            self.remember_offset_number(state)?;
            return self.cutter_along_vectors(state);
        }
        self.end_cutter_along_vectors(state);
        // What the path before holds back comes first.
        self.flush_compensation(state)?;
        // On from here, and unless everything about it is known, along a path that is not.
        state.compensation.on = Perhaps::Yes(Course::Unknown);
        let by_number = effect.offsets_path_by_number();
        if state.tool_shift.is_on() {
            // Refused along a tilting tool: the path beside the programmed one is not known.
            return self.remember_offset_number(state);
        }
        let secondary = state.effect(Role::Plane, self.model) == Some(Effect::PlaneSecondary);
        if secondary && self.refuses_incomplete() {
            return Err(Fault::Compensation(CompensationFault::Plane));
        }
        let Some(plane) = state.plane(self.model) else {
            // The path is not known; the number of the offset is.
            return if by_number { self.remember_offset_number(state) } else { Ok(()) };
        };
        if plane == Plane::Yz && self.refuses_incomplete() {
            return Err(Fault::Compensation(CompensationFault::Plane));
        }
        let (radius, orientation) = if by_number {
            self.remember_offset_number(state)?;
            self.cutter_radius(state)?
        } else {
            self.cutter_of_block(plane, state)?
        };
        // A mirror puts the tool on the other side of the path that it makes.
        let mirrored = match state.transform.frame() {
            Perhaps::Yes(frame) => frame.reverses_plane(plane),
            Perhaps::No | Perhaps::Unknown => false,
        };
        let side = if left == mirrored { CutterSide::Right } else { CutterSide::Left };
        let cutter = Cutter::new(side, radius).with_tip(tip(orientation));
        // Switched off and on again without a move between, it goes on from where the tool stands.
        let mut compensation = match std::mem::take(&mut state.compensation.left) {
            Perhaps::Yes(Course::Followed(left)) if left.plane == plane => left,
            Perhaps::Yes(Course::Followed(_)) | Perhaps::No => Rc::new(Compensation {
                compensator: Compensator::new(config(self.model.semantics())),
                plane,
                at: *state.actual(),
            }),
            Perhaps::Yes(Course::Unknown) | Perhaps::Unknown => return Ok(()),
        };
        // An unknown start or size is no mistake of the program: it is carried as an unknown path.
        let start = planar(&self.transformed(state.position(), state), plane);
        if Rc::make_mut(&mut compensation).compensator.start(cutter, start).is_ok() {
            state.compensation.follow_path(compensation);
        }
        Ok(())
    }

    /// Radius and orientation of the cutter whose diameter the block gives.
    fn cutter_of_block(&mut self, plane: Plane, state: &State<D>) -> Step<(f64, u8)> {
        let Some(diameter) = self.length(Letter::of('D'), state) else {
            return Err(Fault::MissingWord(Letter::of('D')));
        };
        let orientation = match self.count(Letter::of('L'))? {
            Some(Count::Known(l @ 0..=9)) => l as u8,
            None => 0,
            _ => return Err(Fault::WordRange(Letter::of('L'))),
        };
        if orientation != 0 && plane == Plane::Xy && self.refuses_incomplete() {
            return Err(Fault::Compensation(CompensationFault::Plane));
        }
        Ok((diameter / 2.0, orientation))
    }

    pub(crate) fn remember_offset_number(&mut self, state: &mut State<D>) -> Step {
        if let Some(value) = self.words.get(Letter::of('D')) {
            self.count(Letter::of('D'))?;
            state.tool.d = value;
        } else if self.model.semantics().tools.radius_from_tool {
            let tool = state.tool().clone();
            state.tool.d = tool;
        }
        Ok(())
    }

    /// A number of an offset that no code of its block reads stays for the code that uses it: `D01`, then `G41`.
    pub(in crate::exec) fn remember_lasting_words(&mut self, state: &mut State<D>) -> Step {
        if !state.calls.modal.is_off() {
            return Ok(());
        }
        for letter in self.words.present().and(self.model.lasting).iter() {
            if self.is_read(letter) {
                continue;
            }
            if letter == Letter::of('D') {
                self.remember_cutter(state)?;
            } else {
                self.remember_length(letter, state)?;
            }
        }
        Ok(())
    }

    /// Does a code of the block read the address?
    fn is_read(&self, letter: Letter) -> bool {
        self.words.codes().iter().any(|ix| {
            let contract = self.model.contracts.get(ix.index());
            contract.is_some_and(|contract| contract.reads_all || contract.reads.contains(letter))
        })
    }

    /// `H01`, then `G43`. What the word does under length compensation is not known.
    fn remember_length(&mut self, letter: Letter, state: &mut State<D>) -> Step {
        let Some(value) = self.words.get(letter) else { return Ok(()) };
        self.count(letter)?;
        let mode = state.mode(Role::Length).only();
        let cancels = self.model.semantics().zero_length_number_cancels;
        if mode.is_some_and(|ix| self.model.effect(ix) == Effect::LengthOff) {
            state.tool.h = value;
        } else if state.tool_shift.is_on() {
            // The words of such a mode are its own.
        } else if mode.is_none() || cancels && value.covers(&D::number(0.0)) && D::known(&value).is_none() {
            // Whether it ends the compensation, is kept for another, or does nothing.
            let either = state.tool.h.join(&value);
            state.tool.h = either;
            if cancels && value.covers(&D::number(0.0)) {
                let off = self.model.code_with(Effect::LengthOff);
                state.modes.add(Role::Length, &ModeSet::one(off));
                self.lose_length(state);
            }
        } else if cancels && D::known(&value) == Some(0.0) {
            self.cancel_length(state);
        }
        Ok(())
    }

    /// Under compensation the path goes on beside another size; how the control comes over to it is not known.
    fn remember_cutter(&mut self, state: &mut State<D>) -> Step {
        let letter = Letter::of('D');
        let Some(value) = self.words.get(letter) else { return Ok(()) };
        self.count(letter)?;
        if *state.d() == value {
            return Ok(());
        }
        if state.compensation.is_followed() {
            self.flush_compensation(state)?;
            state.compensation.on = Perhaps::Yes(Course::Unknown);
        }
        state.tool.d = value;
        Ok(())
    }

    /// Radius of the cutter that `D` names, NaN unknown, with the orientation of a lathe tool.
    pub(crate) fn cutter_radius(&mut self, state: &State<D>) -> Step<(f64, u8)> {
        let Some(number) = D::known(state.d()) else { return Ok((f64::NAN, 0)) };
        let tables = state.tables();
        let is_loaded = D::known(state.tool()) == Some(number) && !self.words.has(Letter::of('D'));
        let zero_is_loaded = self.model.semantics().tools.zero_is_loaded;
        if is_loaded && if number == 0.0 { zero_is_loaded } else { tables.is_complete() } {
            let tool = state.tool.loaded.data;
            return Ok(self.oriented(tool.size().0 / 2.0, &tool, state));
        }
        if number == 0.0 {
            // Where left out means the tool in the spindle, so does zero.
            let tool = D::known(state.tool());
            if zero_is_loaded && tool.is_none() {
                return Ok((f64::NAN, 0));
            }
            let tool = tool.filter(|tool| zero_is_loaded && *tool > 0.0);
            let Some(tool) = tool else { return Ok((0.0, 0)) };
            if tables.is_complete() {
                let tool = state.tool.loaded.data;
                return Ok(self.oriented(tool.diameter.0 / 2.0, &tool, state));
            }
            return self.radius_of_offset(tool, state);
        }
        self.radius_of_offset(number, state)
    }

    /// The radius that an offset's number stands for.
    fn radius_of_offset(&mut self, number: f64, state: &State<D>) -> Step<(f64, u8)> {
        let tables = state.tables();
        #[expect(clippy::cast_sign_loss, reason = "an offset number is a count")]
        let number = number as u32;
        match tables.tool(number) {
            Some(tool) => {
                if tool.size().0.is_nan() {
                    self.assumptions.insert(Assumption::ToolRadius(number));
                }
                let radius = if state.is_diameter(self.model) == Some(true) && tool.corner_radius.is_known() {
                    tool.corner_radius.0
                } else {
                    tool.size().0 / 2.0
                };
                Ok(self.oriented(radius, tool, state))
            }
            None if tables.is_complete() => Err(Fault::NoSuchTool(number)),
            None => {
                self.assumptions.insert(Assumption::ToolRadius(number));
                Ok((f64::NAN, 0))
            }
        }
    }

    /// A radius with the tool's orientation. On a lathe the path of a tool of unknown orientation is as unknown as that of one
    /// of unknown size; mills have none.
    fn oriented(&self, radius: f64, tool: &ToolData, state: &State<D>) -> (f64, u8) {
        match tool.orientation {
            Flat::Known(orientation) => (radius, orientation),
            Flat::Unknown if state.is_diameter(self.model) == Some(false) => (radius, 0),
            Flat::Unknown => (f64::NAN, 0),
        }
    }

    /// `G40`.
    pub(crate) fn compensation_off(&mut self, state: &mut State<D>) -> Step {
        self.end_cutter_along_vectors(state);
        let Some(mut compensation) = state.compensation.take_followed() else {
            if !state.compensation.on.is_no() && self.refuses_incomplete() {
                // The programmed point becomes that of the path beside it, which is not followed.
                let plane = state.plane(self.model);
                for axis in axes_of_plane(plane) {
                    state.points.position.set(axis, f64::NAN);
                }
            }
            state.compensation.leave_unknown();
            return Ok(());
        };
        let followed = Rc::make_mut(&mut compensation);
        let mut out = Vec::new();
        let result = followed.compensator.stop(|offset| out.push(offset));
        self.give_out(followed, out, state);
        match result {
            Ok(exit) => {
                let actual = above(state.actual(), exit.position, followed.plane);
                // What turns or scales the path stays between the two.
                let programmed = if state.transform.is_off() {
                    above(state.position(), exit.programmed, followed.plane)
                } else {
                    *state.position()
                };
                let actual = state.mapping.turned(actual, state.actual());
                state.points.actual = actual;
                state.points.position = programmed;
                state.compensation.left = Perhaps::Yes(Course::Followed(compensation));
                Ok(())
            }
            Err(error) => Err(fault(&error)),
        }
    }

    /// The first move after `G40`: whether it may be what it is.
    pub(crate) fn leave_compensation(&mut self, is_arc: bool, state: &mut State<D>) -> Step {
        match std::mem::take(&mut state.compensation.left) {
            Perhaps::Yes(Course::Followed(mut left)) => {
                Rc::make_mut(&mut left).compensator.exit_motion(is_arc).map_err(|error| fault(&error))
            }
            Perhaps::Unknown => {
                self.assumptions.insert(Assumption::Unsettled(Unsettled::Compensation));
                Ok(())
            }
            Perhaps::Yes(Course::Unknown) | Perhaps::No => Ok(()),
        }
    }

    /// Paths meet: what one of them holds back is given out no more, and is told to be moves that are not followed.
    pub(crate) fn tell_held_back(&mut self, state: &State<D>) {
        if let Perhaps::Yes(Course::Followed(compensation)) = &state.compensation.on {
            for held in compensation.compensator.held_back() {
                self.observer.event(held.origin, state, &Event::Unfollowed);
            }
        }
    }

    /// The program ends, or something needs every move given out.
    pub(crate) fn flush_compensation(&mut self, state: &mut State<D>) -> Step {
        let Some(mut compensation) = state.compensation.take_followed() else { return Ok(()) };
        let followed = Rc::make_mut(&mut compensation);
        let mut out = Vec::new();
        let result = followed.compensator.flush(|offset| out.push(offset));
        self.give_out(followed, out, state);
        state.points.actual = followed.at;
        if result.is_ok() && followed.compensator.is_on() {
            state.compensation.follow_path(compensation);
        } else {
            state.compensation.on = Perhaps::Yes(Course::Unknown);
        }
        result.map_err(|error| fault(&error))
    }

    /// May the axes run beside the programmed path, nobody knows where?
    pub(crate) fn may_run_beside(&mut self, state: &State<D>) -> bool {
        if state.compensation.on.is_unknown() {
            self.assumptions.insert(Assumption::Unsettled(Unsettled::Compensation));
        }
        !state.compensation.on.is_no()
    }

    /// Where the axes are beside a point, by a distance that is not known: anywhere in the plane of the compensation, and at the
    /// point's level above it.
    pub(crate) fn beside(&self, point: Position, state: &State<D>) -> Position {
        let mapping = &state.mapping;
        let is_upright = mapping.tilted.is_no()
            && mapping.wrapped.is_no()
            && mapping.face.is_no()
            && !state.tool_shift.is_on();
        let plane = state.plane(self.model).filter(|_| is_upright);
        axes_of_plane(plane).fold(point, |mut point, axis| {
            point.set(axis, f64::NAN);
            point
        })
    }

    /// A straight move under compensation.
    pub(crate) fn compensated_line(
        &mut self,
        kind: TravelKind,
        target: Position,
        state: &mut State<D>,
    ) -> Step {
        let Some(mut compensation) = state.compensation.take_followed() else { return Ok(()) };
        let followed = Rc::make_mut(&mut compensation);
        let end = self.transformed(&target, state);
        let to = planar(&end, followed.plane);
        let line = if kind == TravelKind::Rapid { LineKind::Rapid } else { LineKind::Feed };
        let payload = Programmed { origin: self.origin(), target, end };
        let mut out = Vec::new();
        let result = followed.compensator.line(to, line, payload, |offset| out.push(offset));
        self.finish_compensated(compensation, out, result, payload, state)
    }

    /// An arc under compensation.
    pub(crate) fn compensated_arc(
        &mut self,
        arc: &Arc,
        target: Position,
        turns: i32,
        state: &mut State<D>,
    ) -> Step {
        let Some(mut compensation) = state.compensation.take_followed() else { return Ok(()) };
        let followed = Rc::make_mut(&mut compensation);
        if !state.transform.keeps_circles(followed.plane) {
            // Of an ellipse the path beside it is not known.
            state.points.position = target;
            state.points.actual = Position::UNKNOWN;
            state.compensation.on = Perhaps::Yes(Course::Unknown);
            self.emit(state, Event::Unfollowed);
            return Ok(());
        }
        let end = self.transformed(&target, state);
        let to = planar(&end, followed.plane);
        let ((first, second), turns) = self.arc_of_axes(followed.plane, arc.centre(), turns, state);
        let payload = Programmed { origin: self.origin(), target, end };
        let mut out = Vec::new();
        let result = followed.compensator.arc(
            to,
            [first.0, second.0],
            turns > 0,
            turns.unsigned_abs(),
            payload,
            |offset| out.push(offset),
        );
        self.finish_compensated(compensation, out, result, payload, state)
    }

    fn finish_compensated(
        &mut self,
        mut compensation: Rc<Compensation>,
        out: Vec<Offset>,
        result: Result<(), CompensationError>,
        Programmed { target, end, .. }: Programmed,
        state: &mut State<D>,
    ) -> Step {
        let followed = Rc::make_mut(&mut compensation);
        self.give_out(followed, out, state);
        state.points.position = target;
        if let Err(error) = result {
            state.points.actual = Position::UNKNOWN;
            state.compensation.on = Perhaps::Yes(Course::Unknown);
            self.emit(state, Event::Unfollowed);
            return if error == CompensationError::NotUsable { Ok(()) } else { Err(fault(&error)) };
        }
        let actual = above(&end, followed.compensator.position(), followed.plane);
        let actual = state.mapping.turned(actual, &followed.at);
        state.points.actual = actual;
        state.compensation.follow_path(compensation);
        Ok(())
    }

    fn give_out(&mut self, compensation: &mut Compensation, out: Vec<Offset>, state: &State<D>) {
        for offset in out {
            match offset {
                OffsetEvent::Passed((origin, event)) => self.observer.event(origin, state, &event),
                OffsetEvent::Programmed { segment, payload } => {
                    self.segment(compensation, &segment, &payload, payload.end, false, state);
                }
                // Around the corner to which the block before leads.
                OffsetEvent::Inserted { segment, before, after } => {
                    let others = after.end;
                    let target = before.map_or(after.target, |before| before.target);
                    let around = Programmed { target, ..after };
                    self.segment(compensation, &segment, &around, others, true, state);
                }
            }
        }
    }

    /// One segment of the offset path; `others` gives the axes outside the compensation.
    fn segment(
        &mut self,
        compensation: &mut Compensation,
        segment: &OffsetSegment,
        payload: &Programmed,
        others: Position,
        inserted: bool,
        state: &State<D>,
    ) {
        let from = compensation.at;
        let to = above(&others, segment.end, compensation.plane);
        let to = match segment.course {
            OffsetCourse::Arc { centre: [first, second], ccw, turns } if compensation.plane == Plane::Xy => {
                let turns = i32::try_from(turns).unwrap_or(i32::MAX) * if ccw { 1 } else { -1 };
                let sweep = sweep([first, second], segment, turns);
                state.mapping.turned_along(to, &from, (Mm(first), Mm(second)), sweep)
            }
            _ => state.mapping.turned(to, &from),
        };
        compensation.at = to;
        let event = match segment.course {
            OffsetCourse::Line(kind) => {
                let kind = if kind == LineKind::Rapid { TravelKind::Rapid } else { TravelKind::Feed };
                Event::Travel(Travel { kind, from, programmed: payload.target, to, expanded: inserted })
            }
            OffsetCourse::Arc { centre: [first, second], ccw, turns } => {
                let turns = i32::try_from(turns).unwrap_or(i32::MAX) * if ccw { 1 } else { -1 };
                Event::Arc(ArcMove {
                    plane: compensation.plane,
                    from,
                    programmed: payload.target,
                    to,
                    centre: (Mm(first), Mm(second)),
                    turns,
                    sweep: sweep([first, second], segment, turns),
                    expanded: inserted,
                })
            }
        };
        self.observer.event(payload.origin, state, &event);
    }
}

/// Angle of an offset arc in radians, counter-clockwise positive.
fn sweep([first, second]: [f64; 2], segment: &OffsetSegment, turns: i32) -> f64 {
    let point = |point: PathPoint| (Mm(point.first), Mm(point.second));
    sweep_about((Mm(first), Mm(second)), point(segment.start), point(segment.end), turns)
}

/// The point in the compensation's own coordinates.
fn planar(position: &Position, plane: Plane) -> PathPoint {
    let [first, second, normal] = plane.to_local(position.xyz());
    // The height does not matter to the path in the plane; where it is not known it stays so on the way out.
    PathPoint::new(first.0, second.0, if normal.is_known() { normal.0 } else { 0.0 })
}

/// The point with its coordinates in the plane replaced.
pub(in crate::exec) fn above(position: &Position, point: PathPoint, plane: Plane) -> Position {
    let [_, _, height] = plane.to_local(position.xyz());
    let normal = if height.is_known() { Mm(point.normal) } else { height };
    position.with_xyz(plane.to_xyz([Mm(point.first), Mm(point.second), normal]))
}

/// Where the imaginary tip of a lathe tool lies from the centre of its nose, by orientation: units of the radius along Z
/// and X.
fn tip(orientation: u8) -> [i8; 2] {
    match orientation {
        1 => [1, -1],
        2 => [-1, -1],
        3 => [-1, 1],
        4 => [1, 1],
        5 => [1, 0],
        6 => [0, -1],
        7 => [-1, 0],
        8 => [0, 1],
        _ => [0, 0],
    }
}

fn fault(error: &CompensationError) -> Fault {
    Fault::Compensation(match error {
        CompensationError::AlreadyOn => CompensationFault::AlreadyOn,
        CompensationError::EntryTooShort { needed, got, .. } => {
            CompensationFault::EntryTooShort { needed: *needed, got: *got }
        }
        CompensationError::EntryIsArc => CompensationFault::EntryIsArc,
        CompensationError::ExitIsArc => CompensationFault::ExitIsArc,
        CompensationError::NotOn
        | CompensationError::NotUsable
        | CompensationError::ZeroLength
        | CompensationError::ArcTooSmall { .. }
        | CompensationError::Gouge { .. } => CompensationFault::Gouge,
    })
}
