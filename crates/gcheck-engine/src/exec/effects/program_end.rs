//! The end of a program, and modes saved and restored.
//!
//! Knows: what an end resets, what `M70` to `M73` keep. Must not know: calls.

use std::rc::Rc;

use gcheck_controls::{CodeIx, Effect};
use gcheck_geometry::Plane;

use crate::assumption::{Assumption, Unsettled};
use crate::eval::value::{Domain, Truth};
use crate::event::{Coolant, Event, FeedMode, Override, Spindle};
use crate::exec::context::{Ending, Executor, Outcome, Step};
use crate::fault::Fault;
use crate::lattice::{Flat, Perhaps};
use crate::model::Role;
use crate::observer::Observer;
use crate::origin::{At, Origin, origin_of};
use crate::position::Position;
use crate::state::{Blending, Course, ModeSet, SavedModes, State};

#[expect(clippy::unused_self, reason = "the parts of a step read as its methods")]
impl<D: Domain, O: Observer<D>> Executor<'_, '_, D, O> {
    /// `M2`, `M30`: resets what the control resets, then ends.
    pub(in crate::exec) fn end_program(&mut self, pallet: bool, state: &mut State<D>) -> Step {
        self.flush_compensation(state)?;
        self.unwrap_at_end(state);
        let codes: Vec<CodeIx> = self.model.at_end.clone();
        for ix in codes {
            self.reset_to(ix, state);
        }
        if self.model.semantics().end_clears_feed {
            state.feed.rate = D::number(0.0);
        }
        state.blending = state.blending.without_smoothing();
        if pallet {
            self.emit(state, Event::PalletChange);
        }
        self.emit(state, Event::End);
        Ok(())
    }

    /// Brings one code of the control's reset list into effect, and tells what changes.
    fn reset_to(&mut self, ix: CodeIx, state: &mut State<D>) {
        let effect = self.model.effect(ix);
        let role = self.model.role(ix);
        let changes = role.is_none_or(|role| state.mode(role).only() != Some(ix));
        if let Some(role) = role {
            state.set_mode(role, ix);
        }
        match effect {
            Effect::PolarInterpolationOff => self.leave_face(state),
            Effect::WorkOffset(number) => {
                let machine = state.machine(self.model, self.machine);
                state.offsets.work = Flat::Known(number);
                let offset = state.tables().offset(number);
                state.offsets.in_effect = offset;
                state.points.actual = state.from_machine(&machine, self.model, self.machine);
                state.points.position = self.programmed_of(state.actual(), state);
                self.announce_offset(state);
                self.announce_rotation(state);
            }
            Effect::PlaneXy if changes => self.emit(state, Event::Plane(Plane::Xy)),
            Effect::PlaneZx if changes => self.emit(state, Event::Plane(Plane::Zx)),
            Effect::FeedPerMinute => {
                self.emit(state, Event::FeedMode(FeedMode::PerMinute));
                self.emit(state, Event::FeedRate(0.0));
            }
            Effect::OverridesOn => {
                if state.feed.overridable != Truth::True {
                    state.feed.overridable = Truth::True;
                    self.emit(state, Event::Override { kind: Override::Feed, on: true });
                }
                state.spindle.overridable = Truth::True;
            }
            Effect::SpindleStop => {
                state.spindle.way = Flat::Known(Spindle::Stopped);
                self.emit(state, Event::Spindle(Spindle::Stopped));
            }
            Effect::ConstantSpeed => self.emit(state, Event::SpindleMode(None)),
            Effect::ThroughCoolantOff if state.coolant.through != Truth::False => {
                self.coolant(Coolant::Through, false, state);
            }
            Effect::CoolantOff => {
                if state.coolant.mist != Truth::False {
                    self.coolant(Coolant::Mist, false, state);
                }
                if state.coolant.flood != Truth::False {
                    self.coolant(Coolant::Flood, false, state);
                }
            }
            _ => {}
        }
    }

    /// Execution ran past the last block of a text.
    pub(in crate::exec) fn end_of_text(&mut self, at: At, state: &mut State<D>) -> Outcome<D> {
        // Where that is, is the end of the last block, whichever was executed before.
        let last = at.block.checked_sub(1).map(|block| At { block, ..at });
        let last = last.and_then(|last| Some(origin_of(last, &self.place(last)?)));
        self.origin = Origin { at, ..last.unwrap_or(Origin::NONE) };
        if !state.calls.is_main() {
            return Outcome::Fault(Fault::NoProgramEnd);
        }
        if let Err(fault) = self.flush_compensation(state) {
            return Outcome::Fault(fault);
        }
        Outcome::End(Ending::Text)
    }

    pub(in crate::exec) fn saved_modes(&self, state: &State<D>) -> SavedModes {
        SavedModes {
            modes: state.modes.all(),
            feed: D::known(state.feed()).unwrap_or(f64::NAN),
            speed: D::known(state.speed()).unwrap_or(f64::NAN),
            spindle: state.spindle.way,
            mist: state.coolant.mist,
            flood: state.coolant.flood,
            length: *state.length(),
            feed_override: state.feed.overridable,
            speed_override: state.spindle.overridable,
            blending: state.blending,
            speed_limit: state.speed_limit(),
            adaptive: state.feed.adaptive,
            feed_hold: state.feed.hold,
        }
    }

    /// `M70`, `M73`.
    pub(in crate::exec) fn save_modes(&mut self, until_return: bool, state: &mut State<D>) {
        let saved = Rc::new(self.saved_modes(state));
        if let Some(kept) = state.calls.kept_mut() {
            kept.saved = Perhaps::Yes(saved);
            kept.restore_on_return = until_return.into();
        }
    }

    /// `M72`.
    pub(in crate::exec) fn restore_modes(&mut self, state: &mut State<D>) -> Step {
        let saved = match state.calls.kept().map(|kept| kept.saved.clone()) {
            None | Some(Perhaps::No) => return Err(Fault::NoSavedModes),
            Some(Perhaps::Yes(saved)) => saved,
            Some(Perhaps::Unknown) => {
                self.forget_modes(None, state);
                self.lose_position(state)?;
                self.rest_is_lost = true;
                return Ok(());
            }
        };
        let before = self.saved_modes(state);
        self.restore(&saved, state);
        // The interpreter restores by blocks of its own, which take the place of the one under way.
        let after = self.saved_modes(state);
        let numbers = |modes: &SavedModes| [modes.feed, modes.speed, modes.speed_limit];
        if numbers(&before).into_iter().chain(numbers(&after)).any(f64::is_nan) {
            // Whether it restored anything nobody knows, nor whether the block's move was made.
            self.lose_position(state)?;
            self.rest_is_lost = true;
        } else {
            self.rest_is_lost = after != before;
        }
        Ok(())
    }

    /// Brings saved modes back into effect, telling each that changes, in the interpreter's order.
    pub(in crate::exec) fn restore(&mut self, saved: &SavedModes, state: &mut State<D>) {
        let was = self.saved_modes(state);
        if !is_settled(&was) || !is_settled(saved) {
            self.forget_modes(Some(saved), state);
            return;
        }
        // The control writes itself a block, which has no number of its own.
        let number = self.origin.n.take();
        self.restore_modal_codes(&was, saved, state);
        // The first M code stands in one block with the G codes and acts before them; the others follow in blocks of their
        // own.
        let differs = |role: Role| was.modes.get(role.index()) != saved.modes.get(role.index());
        let restores_path = differs(Role::PathControl) || !was.blending.has_numbers_of(&saved.blending);
        let mut switches = changed_switches(&was, saved).into_iter();
        if was.spindle == saved.spindle
            && let Some(first) = switches.next()
        {
            let blends = state.effect(Role::PathControl, self.model) == Some(Effect::PathBlending);
            let p = (restores_path && blends).then_some(saved.blending.tolerance);
            self.restore_switch(first, p, state);
        }
        if differs(Role::Plane)
            && let Some(plane) = state.plane(self.model)
        {
            self.emit(state, Event::Plane(plane));
        }
        self.restore_offsets(&was, saved, state);
        if restores_path {
            state.blending = saved.blending;
            self.announce_path_mode(state);
        }
        for switch in switches {
            self.restore_switch(switch, None, state);
        }
        self.origin.n = number;
    }

    /// Modes, feed, speed and spindle of a saved state.
    fn restore_modal_codes(&mut self, was: &SavedModes, saved: &SavedModes, state: &mut State<D>) {
        let differs = |role: Role| was.modes.get(role.index()) != saved.modes.get(role.index());
        let (units, feed_mode) = (differs(Role::Units), differs(Role::FeedMode));
        for (role, mode) in Role::ALL.into_iter().zip(saved.modes) {
            if !matches!(role, Role::WorkOffset | Role::Motion | Role::Cycle | Role::Length) {
                state.modes.put(role, mode);
            }
        }
        if state.compensation.on.is_no() && self.compensates(state) {
            // The mode is back, the path beside the programmed one is not.
            state.compensation.on = Perhaps::Yes(Course::Unknown);
        }
        if units && let Some(units) = state.units(self.model) {
            self.emit(state, Event::Units(units));
        }
        if feed_mode && let Some(mode) = state.feed_mode(self.model) {
            self.emit(state, Event::FeedMode(mode));
        }
        // A change of the feed mode leaves no feed; else the saved one is in effect again.
        let feed = if feed_mode { 0.0 } else { saved.feed };
        state.feed.rate = known::<D>(feed);
        let mode = *state.mode(Role::FeedMode);
        state.feed.given_under = mode;
        state.spindle.speed = known::<D>(saved.speed);
        if (feed_mode || was.feed.to_bits() != saved.feed.to_bits())
            && state.feed_mode(self.model) != Some(FeedMode::InverseTime)
        {
            self.emit(state, Event::FeedRate(feed));
        }
        if differs(Role::SpindleMode) {
            let surface = state.effect(Role::SpindleMode, self.model) == Some(Effect::SurfaceSpeed);
            self.emit(state, Event::SpindleMode(surface.then_some(saved.speed_limit)));
        }
        if was.speed.to_bits() != saved.speed.to_bits() {
            self.emit(state, Event::SpindleSpeed(saved.speed));
        }
        if was.spindle != saved.spindle {
            state.spindle.way = saved.spindle;
            if let Flat::Known(spindle) = saved.spindle {
                self.emit(state, Event::Spindle(spindle));
            }
        }
    }

    /// Tool length and work offset of a saved state.
    fn restore_offsets(&mut self, was: &SavedModes, saved: &SavedModes, state: &mut State<D>) {
        let mode = |role: Role| saved.modes.get(role.index()).copied().unwrap_or(ModeSet::ANY);
        if !was.length.is_known() || !saved.length.is_known() {
            // Whether they differ is not known.
            state.modes.add(Role::Length, &mode(Role::Length));
            self.lose_length(state);
        } else if was.length != saved.length {
            state.modes.put(Role::Length, mode(Role::Length));
            // What it saves is whether there is a length, not which: `G43` brings that of the tool in the spindle.
            if saved.length == Position::ZERO {
                self.cancel_length(state);
            } else {
                self.loaded_length(1.0, state);
            }
        }
        if was.modes.get(Role::WorkOffset.index()) != saved.modes.get(Role::WorkOffset.index()) {
            state.modes.put(Role::WorkOffset, mode(Role::WorkOffset));
            if let Some(Effect::WorkOffset(n)) = state.effect(Role::WorkOffset, self.model) {
                self.select_work_offset(Some(n), state);
            }
        }
    }

    /// Which modes come back nobody knows: everything that they may change is unknown, or one of what it is and what was saved.
    pub(in crate::exec) fn forget_modes(&mut self, saved: Option<&SavedModes>, state: &mut State<D>) {
        self.assumptions.insert(Assumption::Unsettled(Unsettled::SavedModes));
        for role in Role::ALL {
            match saved.and_then(|saved| saved.modes.get(role.index())) {
                _ if matches!(role, Role::Motion | Role::Cycle) => {}
                Some(mode) => state.modes.add(role, mode),
                None => state.modes.put(role, ModeSet::UNKNOWN),
            }
        }
        if state.mode(Role::Compensation).only().is_none() {
            state.compensation.on = Perhaps::Unknown;
        }
        state.feed.forget();
        let mode = *state.mode(Role::FeedMode);
        state.feed.given_under = mode;
        let limit = state.speed_limit();
        let live_tool = state.live_tool();
        state.spindle.forget();
        state.spindle.limit = limit;
        state.spindle.live_tool = live_tool;
        state.coolant.forget();
        state.blending = Blending::UNKNOWN;
        self.lose_length(state);
        if state.mode(Role::WorkOffset).only().is_none() {
            self.select_work_offset(None, state);
        }
    }

    /// One M code of a restored state. `p` is what a `G64` of its block gives it by accident.
    fn restore_switch(&mut self, switch: Switch, p: Option<f64>, state: &mut State<D>) {
        let on = p.is_none_or(|p| p != 0.0);
        match switch {
            Switch::CoolantOff => {
                self.coolant(Coolant::Mist, false, state);
                self.coolant(Coolant::Flood, false, state);
            }
            Switch::Coolant(kind) => self.coolant(kind, true, state),
            Switch::Overrides => {
                state.feed.overridable = Truth::True;
                state.spindle.overridable = Truth::True;
                self.emit(state, Event::Override { kind: Override::Feed, on: true });
                self.emit(state, Event::Override { kind: Override::Speed, on: true });
            }
            Switch::Speed => self.set_override(Override::Speed, on, state),
            Switch::Adaptive => self.set_override(Override::Adaptive, on, state),
            Switch::FeedStop => self.set_override(Override::FeedStop, on, state),
        }
    }
}

/// Is everything known that decides what is brought back, and in which order? Speed and feed may be unknown numbers.
fn is_settled(modes: &SavedModes) -> bool {
    let SavedModes {
        modes,
        feed: _,
        speed: _,
        spindle,
        mist,
        flood,
        length: _,
        feed_override,
        speed_override: _,
        blending,
        speed_limit: _,
        adaptive,
        feed_hold,
    } = modes;
    let restored = Role::ALL
        .into_iter()
        .zip(modes)
        .filter(|(role, _)| !matches!(role, Role::Motion | Role::Cycle | Role::Length));
    restored.into_iter().all(|(_, mode)| mode.only().is_some())
        && *spindle != Flat::Unknown
        && [mist, flood, feed_override, adaptive, feed_hold]
            .into_iter()
            .all(|switch| *switch != Truth::Unknown)
        && !blending.tolerance.is_nan()
}

/// An M code by which the interpreter restores a switch.
#[derive(Debug, Clone, Copy)]
enum Switch {
    CoolantOff,
    Coolant(Coolant),
    Overrides,
    Speed,
    Adaptive,
    FeedStop,
}

/// What the interpreter makes of saved switches, in its order (observed). Coolant that was on is turned on, and none is turned
/// off unless all was off. A feed override that was on comes back for both; one that was off brings the speed's. The speed
/// override itself is not looked at, and adaptive feed and feed stop that were off stay as they are.
fn changed_switches(was: &SavedModes, saved: &SavedModes) -> Vec<Switch> {
    let comes_on = |old: Truth, new: Truth| old != new && new == Truth::True;
    let mut switches = Vec::new();
    if (was.mist, was.flood) != (saved.mist, saved.flood) {
        if saved.mist == Truth::False && saved.flood == Truth::False {
            switches.push(Switch::CoolantOff);
        }
        if comes_on(was.mist, saved.mist) {
            switches.push(Switch::Coolant(Coolant::Mist));
        }
        if comes_on(was.flood, saved.flood) {
            switches.push(Switch::Coolant(Coolant::Flood));
        }
    }
    if was.feed_override != saved.feed_override {
        switches.push(if saved.feed_override == Truth::True { Switch::Overrides } else { Switch::Speed });
    }
    if comes_on(was.adaptive, saved.adaptive) {
        switches.push(Switch::Adaptive);
    }
    if comes_on(was.feed_hold, saved.feed_hold) {
        switches.push(Switch::FeedStop);
    }
    switches
}

fn known<D: Domain>(value: f64) -> D::Value {
    if value.is_nan() { D::unknown() } else { D::number(value) }
}
