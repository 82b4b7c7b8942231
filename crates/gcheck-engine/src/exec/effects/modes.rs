//! Codes: what a code does to the modes, and what the modes' own effects change.
//!
//! Knows: modes and the order around an effect. Must not know: motion, which handler an effect has (`effects.rs`).

use gcheck_controls::{CodeIx, Effect, Letter, LocalShift};
use gcheck_geometry::{Arrangement, Degrees, Mm};
use gcheck_program::{Place, Word};

use super::CodeInBlock;
use crate::assumption::Assumption;
use crate::eval::value::{Domain, Truth};
use crate::event::{Coolant, Event, FeedMode, Override, PathMode, Smoothing, Spindle, Travel, TravelKind};
use crate::exec::context::{Count, Executor, Step};
use crate::fault::{CompensationFault, Fault};
use crate::lattice::{Flat, Lattice, Perhaps};
use crate::model::Role;
use crate::observer::Observer;
use crate::polar_plane::PolarPlane;
use crate::position::{Axis, Position};
use crate::state::{Blending, CoolantState, State, TiltedPlane};

impl<D: Domain, O: Observer<D>> Executor<'_, '_, D, O> {
    /// Carries out one code of the block.
    pub(in crate::exec) fn code(
        &mut self,
        ix: CodeIx,
        place: &Place,
        words: &[Word],
        state: &mut State<D>,
    ) -> Step {
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
        self.effect(CodeInBlock { effect: code.effect, ix, place, words }, state)?;
        if let Some((machine, followed)) = before
            && (followed || state.follows_rotary(&machine, self.model, self.machine))
        {
            self.reread(&machine, state);
        }
        Ok(())
    }

    /// The axes stand where they did, and the program's X, Y and Z for that are other ones.
    pub(in crate::exec) fn reread(&self, machine: &Position, state: &mut State<D>) {
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
    pub(crate) fn compensates(&self, state: &State<D>) -> bool {
        state.effect(Role::Compensation, self.model).is_some_and(Effect::offsets_path)
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

    pub(in crate::exec) fn feed_mode(&mut self, mode: FeedMode, state: &mut State<D>) {
        self.emit(state, Event::FeedMode(mode));
        if self.model.semantics().feed_mode_clears_feed {
            state.feed.clear();
            if mode != FeedMode::InverseTime {
                self.emit(state, Event::FeedRate(0.0));
            }
        }
    }

    pub(in crate::exec) fn path_mode(&mut self, mode: PathMode, state: &mut State<D>) {
        self.emit(state, Event::PathMode(mode));
    }

    pub(in crate::exec) fn blending(&mut self, state: &mut State<D>) {
        let not_below_zero = |number: f64| if number < 0.0 { 0.0 } else { number };
        let tolerance = self.words.number(Letter::of('P')).map_or(0.0, not_below_zero);
        let naive = self.words.number(Letter::of('Q')).filter(|q| *q >= 0.0 || q.is_nan());
        state.blending = Blending { tolerance, naive, unit: self.unit(state), ..state.blending };
        let mode = state.blending_mode();
        self.path_mode(mode, state);
    }

    pub(in crate::exec) fn smoothing(&mut self, state: &mut State<D>) {
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

    pub(in crate::exec) fn contour_control(
        &mut self,
        switch: Letter,
        letter: Option<Letter>,
        state: &mut State<D>,
    ) {
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
    pub(in crate::exec) fn announce_path_mode(&mut self, state: &mut State<D>) {
        state.blending.unit = self.unit(state);
        if let Some(mode) = state.path_mode(self.model) {
            self.path_mode(mode, state);
        }
    }

    pub(in crate::exec) fn switch_override(&mut self, effect: Effect, state: &mut State<D>) {
        let on = self.words.number(Letter::of('P')).is_none_or(|p| p != 0.0);
        let kind = match effect {
            Effect::FeedOverride => {
                state.cycle.feed_override_on = Truth::False;
                Override::Feed
            }
            Effect::SpeedOverride => Override::Speed,
            Effect::AdaptiveFeed => Override::Adaptive,
            _ => Override::FeedStop,
        };
        self.set_override(kind, on, state);
    }

    /// One override or one way to hold the feed is switched on or off.
    pub(in crate::exec) fn set_override(&mut self, kind: Override, on: bool, state: &mut State<D>) {
        let switch = match kind {
            Override::Feed => &mut state.feed.overridable,
            Override::Speed => &mut state.spindle.overridable,
            Override::Adaptive => &mut state.feed.adaptive,
            Override::FeedStop => &mut state.feed.hold,
        };
        *switch = Truth::from(on);
        self.emit(state, Event::Override { kind, on });
    }

    pub(in crate::exec) fn coolant(&mut self, kind: Coolant, on: bool, state: &mut State<D>) {
        let setting = self.model.semantics().coolant_setting.as_deref();
        if setting.and_then(|number| self.machine.settings.get(number)).is_some_and(|value| value == "ignore")
        {
            return;
        }
        let truth = Truth::from(on);
        match kind {
            Coolant::Mist => state.coolant.mist = truth,
            Coolant::Flood => state.coolant.flood = truth,
            Coolant::Through => state.coolant.through = truth,
        }
        self.emit(state, Event::Coolant { kind, on });
    }

    /// Every coolant that may be on goes off.
    pub(in crate::exec) fn all_coolant_off(&mut self, state: &mut State<D>) {
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
    pub(in crate::exec) fn switch_off_at_stop(&mut self, optional: bool, state: &mut State<D>) -> Step {
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
    pub(in crate::exec) fn unknown_frame(&mut self, ix: CodeIx, on: bool, state: &mut State<D>) {
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
    pub(in crate::exec) fn assume_code_unless_described(&mut self, ix: CodeIx) {
        let table = matches!(
            self.machine.kinematics.map(|kinematics| kinematics.arrangement),
            Some(Arrangement::TableTable)
        );
        if !table || self.machine.rotary_centre(self.model).is_none() {
            self.assumptions.insert(Assumption::Code(ix));
        }
    }

    /// X and a rotary axis make the moves of a flat plane, or no longer do.
    pub(in crate::exec) fn polar_interpolation(
        &mut self,
        ix: CodeIx,
        on: bool,
        state: &mut State<D>,
    ) -> Step {
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
    pub(in crate::exec) fn leave_face(&mut self, state: &mut State<D>) {
        if !state.face().is_no() {
            state.points.actual = state.mapping.off_face(*state.actual());
            state.mapping.face = Perhaps::No;
            state.points.position = self.programmed_of(state.actual(), state);
        }
    }

    /// Some controls end a tilted plane and a rotation with one code.
    pub(in crate::exec) fn end_tilted_plane(&mut self, ix: CodeIx, state: &mut State<D>) {
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
    pub(in crate::exec) fn tilted_plane(&mut self, ix: CodeIx, on: bool, state: &mut State<D>) {
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
    pub(in crate::exec) fn turn_square(&mut self, ix: CodeIx, state: &mut State<D>) {
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
    pub(in crate::exec) fn opaque_operation(&mut self, ix: CodeIx, state: &mut State<D>) {
        self.assumptions.insert(Assumption::Code(ix));
        state.points.lose();
    }

    pub(in crate::exec) fn user_command(&mut self, ix: CodeIx, state: &mut State<D>) {
        let number = self.model.control().code_at(ix).map_or(0, |code| code.number().tenths() / 10);
        let p = self.words.number(Letter::of('P')).unwrap_or(0.0);
        let q = self.words.number(Letter::of('Q')).unwrap_or(0.0);
        self.emit(state, Event::UserCommand { number, p, q });
    }

    /// What the operator answers is not known.
    pub(in crate::exec) fn ask_operator(&mut self, state: &mut State<D>) -> Step {
        match self.count(Letter::of('P'))? {
            Some(Count::Known(number)) => self.write_plain(number, D::unknown(), state),
            Some(Count::Unknown) => state.variables.forget(),
            None => {}
        }
        Ok(())
    }

    /// Both shifts together, as one on controls where they are one.
    pub(in crate::exec) fn shifts_are_one(&self) -> bool {
        self.model.semantics().local_shift == LocalShift::Shared
    }
}

/// A small whole number.
fn level(number: f64) -> Option<u8> {
    #[expect(clippy::cast_sign_loss, reason = "in range")]
    (0.0..=99.0).contains(&number).then_some(number as u8)
}
