//! Going on after an alarm: the block has the effect that it has once the programmer has corrected it.
//!
//! Knows: where a refused block leads, what it leaves unknown, and which way a run takes that nobody can decide. Must not know:
//! how often an execution goes on, what is reported of it.
//!
//! A refused part of a block does not take the other parts with it. What the part means to change is then unknown, so that
//! nothing that is found later follows from the alarm: a length after a refused `G43 H`, a variable after `#1=[1/0]`. A move
//! goes to the end that the program gives it.

use std::collections::BTreeSet;

use gcheck_controls::{CodeIx, Effect, Letter};
use gcheck_geometry::Mm;

use super::arc::plane_axes;
use super::order::Action;
use crate::eval::value::{Domain, Truth};
use crate::event::{Event, Travel, TravelKind};
use crate::exec::context::{Before, Ending, Executor, Flow, Outcome, Step};
use crate::fault::Fault;
use crate::lattice::{Flat, Perhaps};
use crate::model::Role;
use crate::observer::Observer;
use crate::origin::At;
use crate::position::{Axis, Position};
use crate::state::{
    Bar, Blending, Course, KeptTurningWords, ModalCalls, ModeSet, State, ToolData, Transform, TurningWords,
};

impl<D: Domain, O: Observer<D>> Executor<'_, '_, D, O> {
    /// What going on has to know of the state before the block.
    pub(super) fn before_block(&self, state: &State<D>) -> Before {
        Before { actual: *state.actual(), moves: self.moves }
    }

    /// After a block that was refused: the next block, or `None` where the program cannot go on. A bad jump falls through, and
    /// so does a loop without its other end; a recursion without end is passed over as a whole.
    pub(crate) fn go_on(&mut self, at: At, fault: &Fault, state: &mut State<D>) -> Option<At> {
        if matches!(fault, Fault::NoProgramEnd) || self.place(at).is_none() {
            return self.return_from_unfinished(state);
        }
        self.give_out_bridge(state);
        if *fault == Fault::TooDeep {
            return Some(Self::pass_over_recursion(at, state));
        }
        Some(at.next())
    }

    /// When the observer has been told of an alarm: the line to where the refused move leads.
    pub(crate) fn give_out_bridge(&mut self, state: &mut State<D>) {
        if let Some(event) = self.bridge.take() {
            self.emit(state, event);
        }
    }

    /// The state in which the block was refused: that before its refused part became unknown.
    pub(crate) fn take_state_at_fault(&mut self) -> Option<Box<State<D>>> {
        self.at_fault.take()
    }

    /// A subprogram whose text ends without a return goes back to its caller; a main program is over.
    fn return_from_unfinished(&mut self, state: &mut State<D>) -> Option<At> {
        if state.calls.is_main() {
            return None;
        }
        match self.leave(None, None, state) {
            Ok(Outcome::Jump(to)) => Some(to),
            _ => None,
        }
    }

    /// The outermost call of a program that calls itself is over, and what it leaves is not known.
    fn pass_over_recursion(at: At, state: &mut State<D>) -> At {
        let frames = state.calls.frames();
        let repeated = |entry: At| frames.iter().skip(1).filter(|frame| frame.entry == entry).count() > 1;
        let outermost = frames.iter().skip(1).position(|frame| repeated(frame.entry));
        let mut next = at.next();
        if let Some(depth) = outermost {
            while state.calls.depth() > depth + 1
                && let Some(frame) = state.calls.pop()
            {
                next = frame.caller.next();
            }
        }
        state.forget();
        next
    }

    // ---- parts of a block ----

    /// A part of a block was refused: an execution that goes on makes unknown what the part was to change, and does the rest of
    /// the block.
    pub(super) fn past(&mut self, done: Step, action: Action, state: &mut State<D>) -> Step {
        let Err(fault) = done else { return Ok(()) };
        self.refuse_in(fault.clone(), state)?;
        match action {
            Action::Code(ix) => self.lose_code(ix, &fault, state),
            Action::Feed => {
                state.feed.rate = D::unknown();
                state.feed.word = D::unknown();
            }
            Action::Speed => state.spindle.speed = D::unknown(),
            Action::Tool => self.lose_tool_word(state),
            Action::Motion => self.end_refused_move(&fault, state),
        }
        Ok(())
    }

    /// As [`Executor::refuse`], before what the refused part was to change becomes unknown.
    pub(super) fn refuse_in(&mut self, fault: Fault, state: &State<D>) -> Step {
        self.refuse(fault)?;
        self.at_fault.get_or_insert_with(|| Box::new(state.clone()));
        Ok(())
    }

    /// A move was refused: the axes go where the block means them to go.
    fn end_refused_move(&mut self, fault: &Fault, state: &mut State<D>) {
        self.draw_bridge(fault, state);
        if !self.leaves_to_rules() {
            return;
        }
        match fault {
            // The programmer gives the feed, or the word; the blocks after this one have it too.
            Fault::NoFeed => {
                state.feed.rate = D::unknown();
                state.feed.word = D::unknown();
            }
            Fault::Cycle(_) | Fault::WordRange(_) | Fault::MissingWord(_) => {
                state.cycle = state.cycle.unknown();
            }
            _ => {}
        }
        let is_cubic = |ix: CodeIx| {
            matches!(self.model.effect(ix), Effect::SplineCubic | Effect::SplineQuadratic | Effect::NurbsOpen)
        };
        if state.mode(Role::Motion).only().is_some_and(is_cubic) {
            state.curve = Perhaps::Unknown;
        }
    }

    /// A straight line to where the refused block leads, unless it moved.
    fn draw_bridge(&mut self, fault: &Fault, state: &mut State<D>) {
        let Some(before) = self.before else { return };
        if state.compensation.is_followed() {
            return self.bridge_beside(state);
        }
        if self.moves != before.moves {
            return;
        }
        let in_cycle = state.active_cycle(self.model).is_some_and(CodeIx::is_some);
        if same_place(state.actual(), &before.actual) {
            if !self.words.present().intersects(self.model.axis_letters) {
                return;
            }
            let Ok(mut target) = self.target(state) else {
                let _ = self.lose_position(state);
                return;
            };
            if in_cycle {
                let Some(plane) = state.plane(self.model) else { return };
                let ([_, _, depth], _) = plane_axes(plane);
                target.set(depth, state.position().raw(depth));
            }
            state.points.position = target;
            let mut to = self.axes_of(&target, state);
            if self.machine_coordinates || self.may_run_beside(state) {
                to = to.with_xyz([Mm::UNKNOWN; 3]);
            }
            if self.machine_coordinates {
                state.points.position = state.position().with_xyz([Mm::UNKNOWN; 3]);
            }
            state.points.actual = to;
            if same_place(&to, &before.actual) {
                return;
            }
        }
        // Of a block that names no way of moving nobody knows whether it cuts.
        if self.leaves_to_rules() && *fault == Fault::NoMotionMode {
            return;
        }
        let kind = if in_cycle { TravelKind::Rapid } else { TravelKind::Feed };
        let (from, programmed, to) = (before.actual, *state.position(), *state.actual());
        self.bridge = Some(Event::Travel(Travel { kind, from, programmed, to, expanded: true }));
    }

    /// A refused move under cutter compensation ends at its point; how the path beside it goes on is not known.
    fn bridge_beside(&mut self, state: &mut State<D>) {
        let _ = self.flush_compensation(state);
        state.compensation.lose_path();
        match self.target(state) {
            Ok(target) => state.points.position = target,
            Err(_) => {
                let _ = self.lose_position(state);
            }
        }
        state.points.actual = state.position().with_xyz([Mm::UNKNOWN; 3]);
    }

    fn lose_tool_word(&mut self, state: &mut State<D>) {
        let rules = self.model.semantics().tools;
        state.tool.selected = D::unknown();
        if rules.change_by_t {
            self.lose_tool(state);
        }
        if rules.offset_in_t {
            state.tool.d = D::unknown();
            self.lose_length(state);
        }
    }

    /// Any tool may be in the spindle.
    fn lose_tool(&mut self, state: &mut State<D>) {
        state.tool.number = D::unknown();
        state.tool.loaded.data = ToolData { offset: self.unknown_length(state), ..ToolData::UNKNOWN };
        state.tool.loaded.entry = Perhaps::Unknown;
        self.emit(state, Event::ToolChange(None));
    }

    /// A code was refused: it may be in effect, as it is once it is corrected, and what it was to change is not known.
    fn lose_code(&mut self, ix: CodeIx, fault: &Fault, state: &mut State<D>) {
        use Effect as E;
        let Some(code) = self.model.code(ix).copied() else { return };
        if let Some(role) = code
            .role
            .filter(|role| code.modal && !matches!(role, Role::Motion | Role::Cycle | Role::Cylinder))
        {
            state.modes.add(role, &ModeSet::one(ix));
        }
        if code.role == Some(Role::Motion) && !code.modal {
            return self.end_refused_move(fault, state);
        }
        let _is_of_a_group = self.lose_tool_code(code.effect, state)
            || self.lose_offset_code(code.effect, state)
            || self.lose_transformation_code(ix, code.effect, state)
            || self.lose_machining_code(code.effect, state)
            || self.lose_call_code(code.effect, state);
        match code.effect {
            E::PathBlending | E::Smoothing | E::ContourControl | E::LookAheadControl => {
                state.blending = Blending::UNKNOWN;
            }
            E::ProgramEnd | E::ProgramEndWithPallet => self.flow = Some(Flow::End(Ending::Program)),
            _ => {}
        }
    }

    /// A code for tool, length, cutter compensation or spindle was refused. True when it is one of these.
    fn lose_tool_code(&mut self, effect: Effect, state: &mut State<D>) -> bool {
        use Effect as E;
        match effect {
            E::LengthOff
            | E::LengthPlus
            | E::LengthMinus
            | E::LengthFromBlock
            | E::LengthAdd
            | E::LengthFiveAxis
            | E::ToolCentrePoint => self.lose_length(state),
            E::CompensationOff
            | E::CompensationLeft
            | E::CompensationRight
            | E::CompensationLeftByDiameter
            | E::CompensationRightByDiameter
            | E::CompensationVector => self.lose_compensation(effect, state),
            E::SurfaceSpeed | E::ConstantSpeed => state.spindle.limit = f64::NAN,
            E::SpindleClockwise
            | E::SpindleCounterClockwise
            | E::SpindleClockwiseWithCoolant
            | E::SpindleCounterClockwiseWithCoolant
            | E::SpindleStop
            | E::SpindleOrient
            | E::TapHere
            | E::LeftTapHere => state.spindle.way = Flat::Unknown,
            E::ToolChange => {
                self.lose_tool(state);
                if self.model.semantics().tools.change_cancels_length {
                    self.lose_length(state);
                }
            }
            E::SetToolNumber => {
                state.tool.number = D::unknown();
                state.tool.loaded.entry = Perhaps::Unknown;
            }
            _ => return false,
        }
        true
    }

    /// A code for offsets, shifts or reference points was refused. True when it is one of these.
    fn lose_offset_code(&mut self, effect: Effect, state: &mut State<D>) -> bool {
        use Effect as E;
        match effect {
            E::WorkOffset(_) | E::WorkOffsetByP(_) => self.select_work_offset(None, state),
            E::WriteOffsets => self.lose_tables(state),
            E::LocalShift
            | E::SetPosition
            | E::SpeedLimitOrSetPosition
            | E::ClearShift
            | E::SuspendShift
            | E::RestoreShift => {
                state.offsets.shift = Position::UNKNOWN;
                state.offsets.shift_on = Truth::True;
                state.offsets.local = Position::UNKNOWN;
                state.spindle.limit = f64::NAN;
                state.points.lose();
            }
            E::ReturnReference(_) | E::ReturnFromReference => state.points.lose(),
            _ => return false,
        }
        true
    }

    /// A code that transforms coordinates was refused. True when it is one of these.
    fn lose_transformation_code(&mut self, ix: CodeIx, effect: Effect, state: &mut State<D>) -> bool {
        use Effect as E;
        match effect {
            E::ScalingOn | E::ScalingOff | E::RotationOn | E::RotationOff | E::MirrorOn | E::MirrorOff => {
                state.transform = Transform::UNKNOWN;
                state.points.lose();
            }
            E::CylinderMapping => {
                state.mapping.wrapped = Perhaps::Unknown;
                state.points.lose();
            }
            E::PolarInterpolationOn | E::PolarInterpolationOff => {
                state.mapping.face = Perhaps::Unknown;
                self.unknown_frame(ix, true, state);
            }
            E::TiltedPlaneOn | E::TiltedPlaneOff => {
                state.mapping.tilted = Perhaps::Unknown;
                self.unknown_frame(ix, true, state);
            }
            E::DynamicOffsetOn | E::DynamicOffsetOff | E::SquareToPlane => {
                self.unknown_frame(ix, true, state);
            }
            _ => return false,
        }
        true
    }

    /// A code that moves tool, probe or bar by itself was refused. True when it is one of these.
    fn lose_machining_code(&mut self, effect: Effect, state: &mut State<D>) -> bool {
        use Effect as E;
        match effect {
            E::Engrave => state.points.lose(),
            E::Skip | E::ProbeDiameter | E::ProbeLength | E::ProbeOffset | E::ProbeCentre => {
                let _ = self.lose_position(state);
                state.probe.forget();
                if effect != E::Skip {
                    self.lose_tables(state);
                }
            }
            E::FinishProfile
            | E::RoughAlongZ
            | E::RoughAlongX
            | E::RepeatPattern
            | E::GrooveFace
            | E::GrooveDiameter
            | E::ThreadCycle => {
                // These come back to where they began.
                if self.before.is_some_and(|before| !same_place(state.actual(), &before.actual)) {
                    state.points.lose();
                }
                state.turning = KeptTurningWords::of(&TurningWords::UNKNOWN);
            }
            E::CircularPocketClockwise
            | E::CircularPocketCounterClockwise
            | E::GeneralPocket
            | E::BoltCircle
            | E::BoltArc
            | E::BoltLine => state.points.position = self.lost_operation(state),
            E::BarFeed => {
                state.bar = Bar::UNKNOWN;
                state.points.lose();
            }
            E::NurbsClose => {
                state.curve = Perhaps::No;
                state.points.lose();
            }
            _ => return false,
        }
        true
    }

    /// A call, or a code about what calls keep, was refused. True when it is one of these.
    fn lose_call_code(&mut self, effect: Effect, state: &mut State<D>) -> bool {
        use Effect as E;
        match effect {
            E::MacroModal => state.calls.modal = ModalCalls::unknown(),
            E::MacroCall | E::CallProgram | E::CallLocal => {
                let _ = self.lose_everything(state);
            }
            E::RestoreModes => self.forget_modes(None, state),
            _ => return false,
        }
        true
    }

    /// Where a refused operation of one block leaves the tool: over its point, nobody knows how high.
    fn lost_operation(&mut self, state: &mut State<D>) -> Position {
        let mut end = self.target(state).unwrap_or(Position::UNKNOWN);
        end.set(Axis::Z, f64::NAN);
        state.points.actual = self.axes_of(&end, state);
        end
    }

    fn lose_compensation(&mut self, effect: Effect, state: &mut State<D>) {
        let _ = self.flush_compensation(state);
        let is_off = effect == Effect::CompensationOff;
        state.compensation.on = if is_off { Perhaps::No } else { Perhaps::Yes(Course::Unknown) };
        state.compensation.left = Perhaps::Unknown;
        state.tool.d = D::unknown();
        state.points.actual = state.actual().with_xyz([Mm::UNKNOWN; 3]);
    }

    /// Offsets or tools were to be written.
    fn lose_tables(&mut self, state: &mut State<D>) {
        let tables = state.offsets.tables_mut();
        tables.forget_tools();
        state.tool.loaded.data = ToolData::UNKNOWN;
        let is_of_tools = self
            .words
            .number(Letter::of('L'))
            .is_some_and(|l| [0.0, 1.0, 10.0, 11.0, 12.0, 13.0].iter().any(|kind| (l - kind).abs() < 0.5));
        if !is_of_tools {
            self.forget_offsets(state);
        }
    }
}

/// The way of a run where a condition or a target is not known: the next block, the first time; a block that is met again is
/// left by another way, so that a loop of unknown length runs once.
pub(crate) fn choose_way<D: Domain>(
    at: At,
    ways: Vec<(At, State<D>)>,
    met: &mut BTreeSet<At>,
) -> Option<(At, State<D>)> {
    let is_first = met.insert(at);
    let next = at.next();
    let mut ways = ways.into_iter();
    let first = ways.next()?;
    if (first.0 == next) == is_first {
        return Some(first);
    }
    Some(ways.find(|(to, _)| (*to == next) == is_first).unwrap_or(first))
}

/// Are the axes where they were? Unknown is where it was, too.
fn same_place(a: &Position, b: &Position) -> bool {
    Axis::ALL.into_iter().all(|axis| a.raw(axis).to_bits() == b.raw(axis).to_bits())
}
