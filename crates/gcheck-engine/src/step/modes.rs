//! Codes: what each effect changes.
//!
//! Knows: modes and which handler an effect has. Must not know: motion.

use gcheck_controls::{CodeIx, Effect, Letter, LocalShift};
use gcheck_geometry::{Arrangement, Degrees, Mm, Plane};
use gcheck_program::{Place, Word};

use super::{Count, Ending, Executor, Flow, Step};
use crate::assumption::Assumption;
use crate::event::{
    Coolant, Event, FeedMode, Override, PathMode, Smoothing, Spindle, Stop, Travel, TravelKind, Units,
};
use crate::fault::{CompensationFault, Fault};
use crate::lattice::{Flat, Lattice, Perhaps};
use crate::model::Role;
use crate::observer::Observer;
use crate::polar_plane::PolarPlane;
use crate::position::{Axis, Position};
use crate::state::{Blending, CoolantState, ModalCalls, State, TiltedPlane};
use crate::value::{Domain, Truth};

impl<D: Domain, O: Observer<D>> Executor<'_, '_, D, O> {
    /// Carries out one code of the block.
    pub(super) fn code(&mut self, ix: CodeIx, place: &Place, words: &[Word], state: &mut State<D>) -> Step {
        let Some(code) = self.model.code(ix).copied() else { return Ok(()) };
        let is_motion = matches!(code.role, Some(Role::Motion | Role::Cycle));
        let contract = self.model.contracts.get(ix.index());
        if contract.is_some_and(|contract| contract.of_spindle) {
            self.check_spindle()?;
        }
        let needs_none = contract.is_some_and(|contract| contract.uncompensated);
        if needs_none && !is_motion && code.effect != Effect::ThreadCycle && self.compensates(state) {
            return Err(Fault::Compensation(CompensationFault::NotWhileOn));
        }
        if code.role == Some(Role::Motion) && !code.modal {
            return self.motion_of_block(code.effect, state);
        }
        let turns_frame = matches!(code.role, Some(Role::Length | Role::DynamicOffset | Role::TiltedPlane));
        let before = turns_frame.then(|| {
            let machine = state.machine(self.model, self.machine);
            (machine, state.follows_rotary(&machine, self.model, self.machine))
        });
        if let Some(role) = code.role {
            self.guard_frozen(role, ix, state)?;
            // Whether a cylinder's code switches anything depends on its words.
            if role != Role::Cylinder {
                self.switch(role, ix, code.modal || role == Role::Mirror, state);
            }
        }
        self.effect(code.effect, ix, place, words, state)?;
        if let Some((machine, followed)) = before
            && (followed || state.follows_rotary(&machine, self.model, self.machine))
        {
            self.reread(&machine, state);
        }
        Ok(())
    }

    /// The axes stand where they did, and the program's X, Y and Z for that are other ones.
    pub(super) fn reread(&self, machine: &Position, state: &mut State<D>) {
        let read = state.from_machine(machine, self.model, self.machine);
        state.points.actual = state.actual().with_xyz(read.xyz());
        state.points.position = self.programmed_of(state.actual(), state);
    }

    /// Planes, units, offsets and tools must not change under cutter compensation on some controls.
    fn guard_frozen(&self, role: Role, ix: CodeIx, state: &State<D>) -> Step {
        let rules = &self.model.semantics().compensation;
        let freezes = rules.freezes_modes || rules.freezes_plane && role == Role::Plane;
        if !freezes || !self.compensates(state) {
            return Ok(());
        }
        match role {
            Role::Plane | Role::Length | Role::WorkOffset
                if state.mode(role).only() != Some(ix) || role != Role::Plane =>
            {
                Err(Fault::Compensation(CompensationFault::NotWhileOn))
            }
            Role::Compensation if !matches!(self.model.effect(ix), Effect::CompensationOff) => {
                Err(Fault::Compensation(CompensationFault::AlreadyOn))
            }
            _ => Ok(()),
        }
    }

    /// Is cutter compensation on, as far as is known?
    pub(super) fn compensates(&self, state: &State<D>) -> bool {
        matches!(
            state.effect(Role::Compensation, self.model),
            Some(
                Effect::CompensationLeft
                    | Effect::CompensationRight
                    | Effect::CompensationLeftByDiameter
                    | Effect::CompensationRightByDiameter
            )
        )
    }

    /// Makes a code the one in effect of its role.
    fn switch(&mut self, role: Role, ix: CodeIx, lasts: bool, state: &mut State<D>) {
        match role {
            Role::Motion => {
                if !matches!(self.model.effect(ix), Effect::NurbsOpen | Effect::SplineCubic) {
                    state.curve = Perhaps::No;
                }
                state.set_mode(Role::Motion, ix);
                if self.model.semantics().cycles.motion_ends_cycle {
                    self.end_cycle(state);
                }
            }
            Role::Cycle if self.model.effect(ix) == Effect::CycleCancel => {
                self.end_cycle(state);
                if self.model.cycles_are_motion {
                    state.set_mode(Role::Motion, CodeIx::NONE);
                }
            }
            Role::Cycle => {
                match state.active_cycle(self.model) {
                    None => state.cycle = state.cycle.unknown(),
                    Some(CodeIx::NONE) => state.cycle = state.cycle.series(false),
                    // Levels of one axis mean nothing along another.
                    Some(cycle) if self.model.drills_across(cycle) != self.model.drills_across(ix) => {
                        state.cycle = state.cycle.series(false);
                    }
                    // Where cycles are motion modes, another one takes no words over, only the level that the series began at.
                    Some(cycle) if cycle != ix && self.model.cycles_are_motion => {
                        state.cycle = state.cycle.series(true);
                    }
                    Some(_) => {}
                }
                state.set_mode(Role::Cycle, ix);
                if self.model.cycles_are_motion {
                    state.set_mode(Role::Motion, CodeIx::NONE);
                }
            }
            Role::Plane if lasts => {
                if state.mode(role).only() != Some(ix) && self.model.semantics().cycles.rise_to_r {
                    // The level that a series began at was one of the other axis.
                    state.cycle.end();
                }
                state.set_mode(role, ix);
            }
            // Switched off for one axis, it stays on for the others.
            Role::Mirror if self.leaves_a_mirror(ix, state) => return,
            _ if lasts => state.set_mode(role, ix),
            _ => {}
        }
        self.emit(state, Event::Modal(ix));
    }

    /// Does the code switch the mirror off for axes that the block names, while another one is mirrored for certain?
    fn leaves_a_mirror(&self, ix: CodeIx, state: &State<D>) -> bool {
        self.model.effect(ix) == Effect::MirrorOff
            && self.names_axes("XYZ")
            && state.transform.is_mirrored_without(|axis| self.words.has(axis.letter()))
    }

    fn end_cycle(&mut self, state: &mut State<D>) {
        let cancel = self.model.cycle_cancel;
        if state.mode(Role::Cycle).only() != Some(cancel) {
            state.set_mode(Role::Cycle, cancel);
            state.cycle.end();
        }
    }

    #[expect(
        clippy::too_many_lines,
        reason = "one arm for each effect: the table that ties codes to handlers"
    )]
    fn effect(
        &mut self,
        effect: Effect,
        ix: CodeIx,
        place: &Place,
        words: &[Word],
        state: &mut State<D>,
    ) -> Step {
        use Effect as E;
        match effect {
            E::PlaneXy => self.emit(state, Event::Plane(Plane::Xy)),
            E::PlaneZx => self.emit(state, Event::Plane(Plane::Zx)),
            E::PlaneYz => self.emit(state, Event::Plane(Plane::Yz)),
            E::PlaneSecondary => self.emit(state, Event::SecondaryPlane),
            E::Inch => self.emit(state, Event::Units(Units::Inch)),
            E::Millimetre => self.emit(state, Event::Units(Units::Mm)),
            E::FeedInverseTime => self.feed_mode(FeedMode::InverseTime, state),
            E::FeedPerMinute => self.feed_mode(FeedMode::PerMinute, state),
            E::FeedPerRevolution => self.feed_mode(FeedMode::PerRevolution, state),
            E::ExactPath => self.path_mode(PathMode::ExactPath, state),
            E::ExactStop => self.path_mode(PathMode::ExactStop, state),
            E::PathBlending => self.blending(state),
            E::ExactStopOnce => self.emit(state, Event::ExactStop),
            E::Smoothing => self.smoothing(state),
            E::ContourControl => self.contour_control(Letter::of('Q'), Some(Letter::of('R')), state),
            E::LookAheadControl => self.contour_control(Letter::of('P'), None, state),
            E::SurfaceSpeed | E::ConstantSpeed => self.spindle_mode(effect, state)?,
            E::CompensationOff => self.compensation_off(state)?,
            E::CompensationLeft
            | E::CompensationRight
            | E::CompensationLeftByDiameter
            | E::CompensationRightByDiameter
            | E::CompensationVector => self.compensation_on(effect, state)?,
            E::LengthOff
            | E::LengthPlus
            | E::LengthMinus
            | E::LengthFromBlock
            | E::LengthAdd
            | E::LengthFiveAxis
            | E::ToolCentrePoint => self.length_code(effect, state)?,
            E::WorkOffset(number) => self.select_work_offset(Some(number), state),
            E::WorkOffsetByP(first) => {
                let number = match self.count(Letter::of('P'))? {
                    Some(Count::Known(p)) if p > 0 => {
                        u16::try_from(p).ok().and_then(|p| first.checked_add(p - 1))
                    }
                    Some(Count::Known(_)) => return Err(Fault::WordRange(Letter::of('P'))),
                    Some(Count::Unknown) => None,
                    None => return Err(Fault::MissingWord(Letter::of('P'))),
                };
                self.select_work_offset(number, state);
            }
            E::ScalingOn | E::ScalingOff | E::RotationOn | E::RotationOff | E::MirrorOn | E::MirrorOff => {
                self.transform_code(effect, state)?;
                if effect == E::RotationOff {
                    self.end_tilted_plane(ix, state);
                }
            }
            E::CylinderMapping => self.cylinder(ix, state)?,
            E::PolarInterpolationOn | E::PolarInterpolationOff => {
                self.polar_interpolation(ix, effect == E::PolarInterpolationOn, state)?;
            }
            E::DynamicOffsetOn => self.assume_code_unless_described(ix),
            E::TiltedPlaneOn | E::TiltedPlaneOff => {
                self.tilted_plane(ix, effect == E::TiltedPlaneOn, state);
            }
            E::SquareToPlane => self.turn_square(ix, state),

            E::Dwell => self.dwell(state)?,
            E::WriteOffsets => self.write_offsets(ix, state)?,
            E::LocalShift => self.local_shift(state)?,
            E::SetPosition => self.set_position(state)?,
            E::SpeedLimitOrSetPosition => {
                if self.words.has(Letter::of('S')) {
                    self.limit_speed(state);
                } else {
                    self.set_position(state)?;
                }
            }
            E::ClearShift => self.clear_shift(state, false),
            E::SuspendShift => self.clear_shift(state, true),
            E::RestoreShift => self.restore_shift(state),
            E::TapHere | E::LeftTapHere => self.tap_here(effect == E::TapHere, state)?,
            E::ReturnReference(number) => self.return_reference(number, state)?,
            E::ReturnFromReference => self.return_from_reference(state)?,
            E::StoreReference(number) => self.store_reference(number, state),

            E::Skip => self.skip_move(state)?,
            E::ProbeDiameter | E::ProbeLength | E::ProbeOffset | E::ProbeCentre => {
                self.measure(effect, state)?;
            }

            E::KeepTouch => state.probe.kept = state.touched(),

            E::FinishProfile | E::RoughAlongZ | E::RoughAlongX | E::RepeatPattern => {
                self.profile_cycle(effect, ix, state)?;
            }
            E::GrooveFace | E::GrooveDiameter => self.groove_cycle(effect, state)?,
            E::ThreadCycle => self.thread_cycle(state)?,
            E::CircularPocketClockwise | E::CircularPocketCounterClockwise => {
                self.circular_pocket(effect, state)?;
            }
            E::GeneralPocket => self.general_pocket(state)?,
            E::BoltCircle | E::BoltArc | E::BoltLine => self.bolt_pattern(effect, state)?,
            E::Engrave => self.engrave(ix, state)?,
            E::BarFeed => self.bar_feed(ix, words, state)?,
            E::NurbsClose => self.nurbs_close(state)?,

            E::MacroCall | E::MacroModal => self.macro_call(effect, ix, place, words, state)?,
            E::MacroModalOff => state.calls.modal = ModalCalls::off(),
            E::CallProgram | E::CallLocal => self.call_code(effect, state)?,
            E::Return => {
                let label = self.words.get(Letter::of('P'));
                self.flow = Some(Flow::Return { label });
            }
            E::JumpUnlessInput => self.jump_unless_input(state)?,

            E::Stop => {
                self.flush_compensation(state)?;
                self.switch_off_at_stop(false, state)?;
                self.emit(state, Event::Stop(Stop::Program));
            }
            E::OptionalStop => {
                if !self.options.optional_stop {
                    self.assumptions.insert(Assumption::OptionalStop);
                }
                self.flush_compensation(state)?;
                self.switch_off_at_stop(true, state)?;
                self.emit(state, Event::Stop(Stop::Optional));
            }
            E::PalletStop => {
                self.flush_compensation(state)?;
                self.emit(state, Event::PalletChange);
                self.emit(state, Event::Stop(Stop::Pallet));
            }
            E::ProgramEnd | E::ProgramEndWithPallet => {
                self.end_program(effect == E::ProgramEndWithPallet, state)?;
                self.flow = Some(Flow::End(Ending::Program));
            }
            E::SaveModes | E::SaveModesUntilReturn => {
                self.save_modes(effect == E::SaveModesUntilReturn, state);
            }
            E::ForgetModes => {
                if let Some(kept) = state.calls.kept_mut() {
                    kept.saved = Perhaps::No;
                }
            }
            E::RestoreModes => self.restore_modes(state)?,
            E::UserCommand => self.user_command(ix, state),
            E::AskOperator => self.ask_operator(state)?,

            E::SpindleClockwise => self.spindle(Spindle::Clockwise, state)?,
            E::SpindleCounterClockwise => self.spindle(Spindle::CounterClockwise, state)?,
            E::SpindleClockwiseWithCoolant => {
                self.spindle(Spindle::Clockwise, state)?;
                self.coolant(Coolant::Flood, true, state);
            }
            E::SpindleCounterClockwiseWithCoolant => {
                self.spindle(Spindle::CounterClockwise, state)?;
                self.coolant(Coolant::Flood, true, state);
            }
            E::SpindleStop => self.spindle(Spindle::Stopped, state)?,
            E::SpindleOrient => self.orient(state)?,
            E::LiveToolOn => state.spindle.live_tool = Truth::True,
            E::LiveToolOff => state.spindle.live_tool = Truth::False,
            E::ToolChange => self.tool_change(state)?,
            E::SetToolNumber => self.set_tool_number(state)?,
            E::MistOn => self.coolant(Coolant::Mist, true, state),
            E::FloodOn => self.coolant(Coolant::Flood, true, state),
            E::ThroughCoolantOn => self.coolant(Coolant::Through, true, state),
            E::ThroughCoolantOff => {
                if self.model.semantics().through_off_stops_spindle
                    && state.spindle() != Some(Spindle::Stopped)
                {
                    self.spindle(Spindle::Stopped, state)?;
                }
                self.coolant(Coolant::Through, false, state);
            }
            E::CoolantOff => {
                self.coolant(Coolant::Mist, false, state);
                self.coolant(Coolant::Flood, false, state);
            }
            E::OverridesOn | E::OverridesOff => {
                let on = effect == E::OverridesOn;
                state.feed.overridable = on.into();
                state.spindle.overridable = on.into();
                state.cycle.feed_override_on = Truth::False;
                self.emit(state, Event::Override { kind: Override::Feed, on });
                self.emit(state, Event::Override { kind: Override::Speed, on });
            }
            E::FeedOverride | E::SpeedOverride | E::AdaptiveFeed | E::FeedStopInput => {
                self.switch_override(effect, state);
            }
            E::OutputOnWithMove | E::OutputOffWithMove | E::OutputOn | E::OutputOff => {
                self.digital_output(effect, state)?;
            }
            E::AnalogOutput | E::AnalogOutputWithMove => self.analog_output(effect, state)?,
            E::WaitForInput => self.wait_for_input(state)?,
            E::ChuckClamp => self.chuck(true, state),
            E::ChuckUnclamp => self.chuck(false, state),
            // Modes that only later blocks read, and interpolation, which happens with the block's axis words.
            _ => {}
        }
        Ok(())
    }

    fn feed_mode(&mut self, mode: FeedMode, state: &mut State<D>) {
        self.emit(state, Event::FeedMode(mode));
        if self.model.semantics().feed_mode_clears_feed {
            state.feed.clear();
            if mode != FeedMode::InverseTime {
                self.emit(state, Event::FeedRate(0.0));
            }
        }
    }

    pub(super) fn path_mode(&mut self, mode: PathMode, state: &mut State<D>) {
        self.emit(state, Event::PathMode(mode));
    }

    fn blending(&mut self, state: &mut State<D>) {
        let not_below_zero = |number: f64| if number < 0.0 { 0.0 } else { number };
        let tolerance = self.words.number(Letter::of('P')).map_or(0.0, not_below_zero);
        let naive = self.words.number(Letter::of('Q')).filter(|q| *q >= 0.0 || q.is_nan());
        state.blending = Blending { tolerance, naive, unit: self.unit(state), ..state.blending };
        let mode = state.blending_mode();
        self.path_mode(mode, state);
    }

    fn smoothing(&mut self, state: &mut State<D>) {
        let unit = self.unit(state);
        let given = self.words.number(Letter::of('E'));
        let tolerance = given.filter(|e| *e > 0.0).map(|e| Mm(e * unit));
        let written = self.raw(Letter::of('P'), state);
        let smoothing = Smoothing { level: written.and_then(level), tolerance };
        let kept = &mut state.blending;
        if [given, written].into_iter().flatten().any(f64::is_nan) {
            // The word may be of any value, or nothing; then the other one may be given up.
            (kept.smoothing_level, kept.smoothing_tolerance) = (Some(f64::NAN), Some(f64::NAN));
        } else if smoothing == Smoothing::default() {
            (kept.smoothing_level, kept.smoothing_tolerance) = (None, None);
        } else {
            kept.smoothing_level = smoothing.level.map(f64::from).or(kept.smoothing_level);
            kept.smoothing_tolerance = tolerance.map(|tolerance| tolerance.0).or(kept.smoothing_tolerance);
        }
        self.emit(state, Event::Smoothing(smoothing));
    }

    fn contour_control(&mut self, switch: Letter, letter: Option<Letter>, state: &mut State<D>) {
        let Some(switched) = self.words.number(switch) else { return };
        let written = letter.and_then(|letter| self.raw(letter, state));
        let on = switched > 0.0;
        let level = written.and_then(level).filter(|_| on);
        state.blending.contour = if switched.is_nan() || on && written.is_some_and(f64::is_nan) {
            Some(f64::NAN)
        } else {
            on.then(|| level.map_or(0.0, f64::from))
        };
        // What is unknown, or has other meanings on other series, switches nothing on.
        self.emit(state, Event::ContourControl { on, level });
    }

    /// The path mode is announced again, where it is known: its numbers count in the program's present units from then on.
    pub(super) fn announce_path_mode(&mut self, state: &mut State<D>) {
        state.blending.unit = self.unit(state);
        if let Some(mode) = state.path_mode(self.model) {
            self.path_mode(mode, state);
        }
    }

    fn switch_override(&mut self, effect: Effect, state: &mut State<D>) {
        let on = self.words.number(Letter::of('P')).is_none_or(|p| p != 0.0);
        let truth = if on { Truth::True } else { Truth::False };
        let kind = match effect {
            Effect::FeedOverride => {
                state.feed.overridable = truth;
                state.cycle.feed_override_on = Truth::False;
                Override::Feed
            }
            Effect::SpeedOverride => {
                state.spindle.overridable = truth;
                Override::Speed
            }
            Effect::AdaptiveFeed => {
                state.feed.adaptive = truth;
                Override::Adaptive
            }
            _ => {
                state.feed.hold = truth;
                Override::FeedStop
            }
        };
        self.emit(state, Event::Override { kind, on });
    }

    pub(super) fn coolant(&mut self, kind: Coolant, on: bool, state: &mut State<D>) {
        let setting = self.model.semantics().coolant_setting.as_deref();
        if setting.and_then(|number| self.machine.settings.get(number)).is_some_and(|value| value == "ignore")
        {
            return;
        }
        let truth = if on { Truth::True } else { Truth::False };
        match kind {
            Coolant::Mist => state.coolant.mist = truth,
            Coolant::Flood => state.coolant.flood = truth,
            Coolant::Through => state.coolant.through = truth,
        }
        self.emit(state, Event::Coolant { kind, on });
    }

    /// Every coolant that may be on goes off.
    pub(super) fn all_coolant_off(&mut self, state: &mut State<D>) {
        let may_be_on = [
            (Coolant::Mist, state.coolant.mist),
            (Coolant::Flood, state.coolant.flood),
            (Coolant::Through, state.coolant.through),
        ];
        for (kind, _) in may_be_on.into_iter().filter(|(_, on)| *on != Truth::False) {
            self.coolant(kind, false, state);
        }
    }

    /// What a stop of the program switches off. An optional one does so only if the operator's switch is on, which an analysis
    /// of all paths leaves open.
    fn switch_off_at_stop(&mut self, optional: bool, state: &mut State<D>) -> Step {
        let semantics = self.model.semantics();
        if !semantics.stop_switches_off {
            return Ok(());
        }
        if optional && !self.options.optional_stop {
            let lock = semantics.optional_stop_lock.as_deref();
            let is_locked = lock
                .and_then(|number| self.setting(number))
                .is_some_and(|value| matches!(value, "on" | "true"));
            if self.lenient && !is_locked {
                if state.spindle() != Some(Spindle::Stopped) {
                    state.spindle.way = Flat::Unknown;
                }
                let CoolantState { mist, flood, through } = state.coolant;
                let [mist, flood, through] = [mist, flood, through].map(|on| on.join(&Truth::False));
                state.coolant = CoolantState { mist, flood, through };
            }
            return Ok(());
        }
        if state.spindle() != Some(Spindle::Stopped) {
            self.spindle(Spindle::Stopped, state)?;
        }
        self.all_coolant_off(state);
        Ok(())
    }

    /// A frame whose geometry depends on the machine: positions are not known until they are given in it.
    pub(super) fn unknown_frame(&mut self, ix: CodeIx, on: bool, state: &mut State<D>) {
        let effect = self.model.effect(ix);
        if on {
            self.assumptions.insert(Assumption::Code(ix));
        }
        let mut unknown = state.actual().with_xyz([Mm::UNKNOWN; 3]);
        if matches!(effect, Effect::PolarInterpolationOn | Effect::PolarInterpolationOff) {
            // X and a rotary axis make the moves of the plane; Z stays its own.
            unknown.set(Axis::Z, state.actual().raw(Axis::Z));
            for axis in self.model.axes.iter().filter(|axis| axis.is_rotary()) {
                unknown.set(*axis, f64::NAN);
            }
        }
        state.points.actual = unknown;
        state.points.position = unknown;
    }

    /// What a code does with the rotary axes is an assumption on a machine whose rotary axes nobody described.
    fn assume_code_unless_described(&mut self, ix: CodeIx) {
        let table = matches!(
            self.machine.kinematics.map(|kinematics| kinematics.arrangement),
            Some(Arrangement::TableTable)
        );
        if !table || self.machine.rotary_centre(self.model).is_none() {
            self.assumptions.insert(Assumption::Code(ix));
        }
    }

    /// X and a rotary axis make the moves of a flat plane, or no longer do.
    fn polar_interpolation(&mut self, ix: CodeIx, on: bool, state: &mut State<D>) -> Step {
        let rules = self.model.semantics().polar_interpolation;
        let Some((rules, rotary)) =
            rules.and_then(|rules| Some((rules, Axis::of(Letter::of(rules.rotary))?)))
        else {
            self.unknown_frame(ix, on, state);
            return Ok(());
        };
        self.flush_compensation(state)?;
        if !on {
            self.leave_face(state);
        } else if state.actual().raw(Axis::X).is_nan() {
            // On which side of the centre the tool is, nobody knows.
            state.mapping.face = Perhaps::Unknown;
            self.unknown_frame(ix, true, state);
        } else if state.face().is_no() {
            let (plane, begun) = PolarPlane::begin(rotary, state.actual(), rules.starts_at_zero);
            state.mapping.face = Perhaps::Yes(plane);
            state.points.actual = begun;
            state.points.position = self.programmed_of(state.actual(), state);
        }
        Ok(())
    }

    /// The axes are where polar interpolation left them.
    pub(super) fn leave_face(&mut self, state: &mut State<D>) {
        if !state.face().is_no() {
            state.points.actual = state.mapping.off_face(*state.actual());
            state.mapping.face = Perhaps::No;
            state.points.position = self.programmed_of(state.actual(), state);
        }
    }

    /// Some controls end a tilted plane and a rotation with one code.
    fn end_tilted_plane(&mut self, ix: CodeIx, state: &mut State<D>) {
        let group = |ix: CodeIx| self.model.code(ix).map(|code| code.group);
        let tilts =
            |code: CodeIx| self.model.effect(code) == Effect::TiltedPlaneOn && group(code) == group(ix);
        if state.mode(Role::TiltedPlane).may(tilts) {
            let machine = state.machine(self.model, self.machine);
            state.set_mode(Role::TiltedPlane, CodeIx::NONE);
            self.tilted_plane(ix, false, state);
            self.reread(&machine, state);
        }
    }

    /// A tilted plane by origin and Euler angles, or none; other ways to give one are not followed.
    fn tilted_plane(&mut self, ix: CodeIx, on: bool, state: &mut State<D>) {
        if !on {
            state.mapping.tilted = Perhaps::No;
            return;
        }
        let is_other = ['P', 'Q', 'R', 'D'].into_iter().any(|letter| self.words.has(Letter::of(letter)));
        if is_other
            || !self.model.semantics().tilted_plane_by_euler_angles
            || state.mapping.tilted.is_unknown()
        {
            self.assumptions.insert(Assumption::Code(ix));
            state.mapping.tilted = Perhaps::Unknown;
            return;
        }
        let origin = ['X', 'Y', 'Z'].map(|letter| self.length(Letter::of(letter), state).unwrap_or(0.0));
        let turns = ['I', 'J', 'K'].map(|letter| self.words.number(Letter::of(letter)).unwrap_or(0.0));
        state.mapping.tilted = Perhaps::Yes(TiltedPlane { origin, turns });
    }

    /// The rotary axes turn to where the tool is square to the plane in effect; the linear axes stand still.
    fn turn_square(&mut self, ix: CodeIx, state: &mut State<D>) {
        let mut machine = state.machine(self.model, self.machine);
        let from = machine.abc();
        let ways = self.machine.kinematics.zip(state.upward());
        // `P` chooses between two ways by rules that no page at hand gives.
        let ways = ways.filter(|_| !self.words.has(Letter::of('P')));
        let ways = ways.map_or_else(Vec::new, |(kinematics, upward)| kinematics.square_to(upward, from));
        let ways = ways.into_iter().flat_map(|way| self.within_travel(way, from));
        let far = |way: &[Degrees; 3]| {
            let turns = way.iter().zip(from).map(|(to, from)| (to.0 - from.0).abs());
            turns.fold(0.0, |far, turn| if turn.is_nan() { far } else { turn.max(far) })
        };
        let mut ways: Vec<(f64, [Degrees; 3])> = ways.map(|way| (far(&way), way)).collect();
        ways.sort_by(|(one, _), (other, _)| one.total_cmp(other));
        let nearest = ways.first().map(|(_, way)| *way);
        // Which of two ways that are as far the control takes is not known, nor which is nearer from an unknown angle.
        let starts_known = self.machine.kinematics.is_some_and(|kinematics| {
            kinematics.order.iter().all(|axis| from.get(axis.index()).is_some_and(|from| !from.0.is_nan()))
        });
        let is_certain = match ways.as_slice() {
            [] => false,
            [_] => true,
            [(near, _), (next, _), ..] => starts_known && *next > near + 1e-6,
        };
        if !is_certain {
            self.assumptions.insert(Assumption::Code(ix));
        }
        for (index, axis) in Axis::ABC.into_iter().enumerate() {
            if self.model.axes.contains(&axis) {
                let angle = nearest.and_then(|way| way.get(index).copied()).map(|angle| D::number(angle.0));
                let angle = angle.map(|angle| if is_certain { angle } else { D::assumed(angle) });
                machine.set(axis, angle.and_then(|angle| D::known(&angle)).unwrap_or(f64::NAN));
            }
        }
        let to = state.from_machine(&machine, self.model, self.machine);
        let from = *state.actual();
        let event =
            Event::Travel(Travel { kind: TravelKind::Rapid, from, programmed: to, to, expanded: true });
        state.points.actual = to;
        state.points.position = self.programmed_of(&to, state);
        self.emit(state, event);
    }

    /// The ways to the same angles by whole turns that lie within the travel of the axes. An axis without travel goes the shorter
    /// way, and may go the other way where it is not known from where it turns.
    fn within_travel(&self, way: [Degrees; 3], from: [Degrees; 3]) -> Vec<[Degrees; 3]> {
        let own = self.machine.kinematics.map_or(Vec::new(), |kinematics| kinematics.order.to_vec());
        let mut ways = vec![way];
        for axis in own {
            let index = axis.index();
            let travel = Axis::ABC.get(index).and_then(|axis| self.machine.travel.get(axis));
            let is_unknown = |angles: [Degrees; 3]| angles.get(index).is_none_or(|angle| angle.0.is_nan());
            let turns: &[f64] = match travel {
                // The tool lies along the axis: it stays where it is.
                _ if is_unknown(way) => continue,
                Some(_) => &[0.0, -360.0, 360.0],
                None if is_unknown(from) => &[0.0, 360.0],
                None => &[0.0],
            };
            let turned = |way: [Degrees; 3], turn: f64| {
                let mut turned = way;
                let angle = turned.get_mut(index)?;
                angle.0 += turn;
                travel.is_none_or(|(low, high)| (*low..=*high).contains(&angle.0)).then_some(turned)
            };
            ways = ways
                .into_iter()
                .flat_map(|way| turns.iter().filter_map(move |turn| turned(way, *turn)))
                .collect();
        }
        ways
    }

    /// Work done by the machine that gcheck does not follow: the axes end nobody knows where.
    pub(super) fn opaque_operation(&mut self, ix: CodeIx, state: &mut State<D>) {
        self.assumptions.insert(Assumption::Code(ix));
        state.points.lose();
    }

    fn user_command(&mut self, ix: CodeIx, state: &mut State<D>) {
        let number = self.model.control().code_at(ix).map_or(0, |code| code.number().tenths() / 10);
        let p = self.words.number(Letter::of('P')).unwrap_or(0.0);
        let q = self.words.number(Letter::of('Q')).unwrap_or(0.0);
        self.emit(state, Event::UserCommand { number, p, q });
    }

    /// What the operator answers is not known.
    fn ask_operator(&mut self, state: &mut State<D>) -> Step {
        match self.count(Letter::of('P'))? {
            Some(Count::Known(number)) => self.write_plain(number, D::unknown(), state),
            Some(Count::Unknown) => state.variables.forget(),
            None => {}
        }
        Ok(())
    }

    /// Both shifts together, as one on controls where they are one.
    pub(super) fn shifts_are_one(&self) -> bool {
        self.model.semantics().local_shift == LocalShift::Shared
    }
}

/// A small whole number.
fn level(number: f64) -> Option<u8> {
    #[expect(clippy::cast_sign_loss, reason = "in range")]
    (0.0..=99.0).contains(&number).then_some(number as u8)
}
