//! The end of a program, and modes saved and restored.
//!
//! Knows: what an end resets, what `M70` to `M73` keep. Must not know: calls.

use std::rc::Rc;

use gcheck_controls::{CodeIx, Effect};
use gcheck_geometry::Plane;

use super::{Executor, Outcome, Step};
use crate::event::{Coolant, Event, FeedMode, Override, Spindle, Units};
use crate::fault::Fault;
use crate::model::Role;
use crate::observer::Observer;
use crate::position::Position;
use crate::state::{At, SavedModes, State};
use crate::step::Ending;
use crate::value::{Domain, Truth};

#[expect(clippy::unused_self, reason = "the parts of a step read as its methods")]
impl<D: Domain, O: Observer<D>> Executor<'_, '_, D, O> {
    /// `M2`, `M30`: resets what the control resets, then ends.
    pub(super) fn end_program(&mut self, pallet: bool, state: &mut State<D>) -> Step {
        self.flush_compensation(state)?;
        self.unwrap_at_end(state);
        let codes: Vec<CodeIx> = self.model.at_end.clone();
        for ix in codes {
            self.reset_to(ix, state);
        }
        if self.model.semantics().end_clears_feed {
            state.feed = D::number(0.0);
        }
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
            Effect::WorkOffset(number) => {
                let machine = state.machine(self.model);
                state.work = Some(number);
                state.in_effect = state.tables.offset(number);
                state.actual = state.from_machine(&machine, self.model);
                state.position = self.programmed_of(&state.actual, state);
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
                if state.feed_override != Truth::True {
                    state.feed_override = Truth::True;
                    self.emit(state, Event::Override { kind: Override::Feed, on: true });
                }
                state.speed_override = Truth::True;
            }
            Effect::SpindleStop => {
                state.spindle = Some(Spindle::Stopped);
                self.emit(state, Event::Spindle(Spindle::Stopped));
            }
            Effect::ConstantSpeed => self.emit(state, Event::SpindleMode(None)),
            Effect::CoolantOff => {
                if state.mist != Truth::False {
                    self.coolant(Coolant::Mist, false, state);
                }
                if state.flood != Truth::False {
                    self.coolant(Coolant::Flood, false, state);
                }
            }
            _ => {}
        }
    }

    /// Execution ran past the last block of a text.
    pub(super) fn end_of_text(&mut self, at: At, state: &mut State<D>) -> Outcome<D> {
        let depth = state.frames.len();
        self.origin = super::Origin { at, ..self.origin };
        if depth > 1 {
            return Outcome::Fault(Fault::NoProgramEnd);
        }
        if let Err(fault) = self.flush_compensation(state) {
            return Outcome::Fault(fault);
        }
        Outcome::End(Ending::Text)
    }

    pub(super) fn saved_modes(&self, state: &State<D>) -> SavedModes {
        SavedModes {
            modes: state.modes,
            feed: D::known(&state.feed).unwrap_or(f64::NAN),
            speed: D::known(&state.speed).unwrap_or(f64::NAN),
            spindle: state.spindle,
            mist: state.mist,
            flood: state.flood,
            length: state.length,
            feed_override: state.feed_override,
            speed_override: state.speed_override,
            blending: state.blending,
            speed_limit: state.speed_limit,
            adaptive: state.adaptive,
            feed_hold: state.feed_hold,
        }
    }

    /// `M70`, `M73`.
    pub(super) fn save_modes(&mut self, until_return: bool, state: &mut State<D>) {
        let saved = Rc::new(self.saved_modes(state));
        if let Some(frame) = state.frames.last_mut() {
            frame.saved = Some(saved);
            frame.restore_on_return = until_return;
        }
    }

    /// `M72`.
    pub(super) fn restore_modes(&mut self, state: &mut State<D>) -> Step {
        let saved = state.frames.last().and_then(|frame| frame.saved.clone());
        let Some(saved) = saved else { return Err(Fault::NoSavedModes) };
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
    pub(super) fn restore(&mut self, saved: &SavedModes, state: &mut State<D>) {
        // The control writes itself a block, which has no number of its own.
        let number = self.origin.n.take();
        let was = self.saved_modes(state);
        let differs = |role: Role| was.modes.get(role.index()) != saved.modes.get(role.index());
        let set = |state: &mut State<D>, role: Role| {
            if let (Some(slot), Some(mode)) =
                (state.modes.get_mut(role.index()), saved.modes.get(role.index()))
            {
                *slot = *mode;
            }
        };
        let (units, feed_mode, spindle_mode) =
            (differs(Role::Units), differs(Role::FeedMode), differs(Role::SpindleMode));
        for role in Role::ALL {
            if !matches!(role, Role::WorkOffset | Role::Motion | Role::Cycle | Role::Length) {
                set(state, role);
            }
        }
        if units && let Some(units) = state.units(self.model) {
            self.emit(
                state,
                Event::Units(match units {
                    Units::Inch => Units::Inch,
                    Units::Mm => Units::Mm,
                }),
            );
        }
        if feed_mode && let Some(mode) = state.feed_mode(self.model) {
            self.emit(state, Event::FeedMode(mode));
        }
        // A change of the feed mode leaves no feed; else the saved one is in effect again.
        let feed = if feed_mode { 0.0 } else { saved.feed };
        state.feed = known::<D>(feed);
        state.feed_given_under = *state.mode(Role::FeedMode);
        state.speed = known::<D>(saved.speed);
        if (feed_mode || was.feed.to_bits() != saved.feed.to_bits())
            && state.feed_mode(self.model) != Some(FeedMode::InverseTime)
        {
            self.emit(state, Event::FeedRate(feed));
        }
        if spindle_mode {
            let surface = state.effect(Role::SpindleMode, self.model) == Some(Effect::SurfaceSpeed);
            self.emit(state, Event::SpindleMode(surface.then_some(saved.speed_limit)));
        }
        if was.speed.to_bits() != saved.speed.to_bits() {
            self.emit(state, Event::SpindleSpeed(saved.speed));
        }
        if was.spindle != saved.spindle {
            state.spindle = saved.spindle;
            if let Some(spindle) = saved.spindle {
                self.emit(state, Event::Spindle(spindle));
            }
        }
        // The first M code stands in one block with the G codes and acts before them; the others follow in blocks of their
        // own.
        let restores_path = differs(Role::PathControl) || was.blending != saved.blending;
        let mut switches = changed_switches(&was, saved).into_iter();
        if was.spindle == saved.spindle
            && let Some(first) = switches.next()
        {
            let blends = state.effect(Role::PathControl, self.model) == Some(Effect::PathBlending);
            let p = (restores_path && blends).then_some(saved.blending.0);
            self.restore_switch(first, p, state);
        }
        if differs(Role::Plane)
            && let Some(plane) = state.plane(self.model)
        {
            self.emit(state, Event::Plane(plane));
        }
        if was.length != saved.length {
            set(state, Role::Length);
            // What it saves is whether there is a length, not which: `G43` brings that of the tool in the spindle.
            if saved.length == Position::ZERO {
                self.cancel_length(state);
            } else {
                // It cannot fail: nothing is looked up.
                let _ = self.loaded_length(1.0, state);
            }
        }
        if differs(Role::WorkOffset) {
            set(state, Role::WorkOffset);
            if let Some(Effect::WorkOffset(n)) = state.effect(Role::WorkOffset, self.model) {
                self.select_work_offset(Some(n), state);
            }
        }
        if restores_path {
            state.blending = saved.blending;
            let mode = self.current_path_mode(state);
            self.path_mode(mode, state);
        }
        for switch in switches {
            self.restore_switch(switch, None, state);
        }
        self.origin.n = number;
    }

    /// One M code of a restored state. `p` is what a `G64` of its block gives it by accident.
    fn restore_switch(&mut self, switch: Switch, p: Option<f64>, state: &mut State<D>) {
        let on = p.is_none_or(|p| p != 0.0);
        let truth = if on { Truth::True } else { Truth::False };
        let kind = match switch {
            Switch::CoolantOff => {
                self.coolant(Coolant::Mist, false, state);
                self.coolant(Coolant::Flood, false, state);
                return;
            }
            Switch::Coolant(kind) => {
                self.coolant(kind, true, state);
                return;
            }
            Switch::Overrides => {
                state.feed_override = Truth::True;
                state.speed_override = Truth::True;
                self.emit(state, Event::Override { kind: Override::Feed, on: true });
                self.emit(state, Event::Override { kind: Override::Speed, on: true });
                return;
            }
            Switch::Speed => {
                state.speed_override = truth;
                Override::Speed
            }
            Switch::Adaptive => {
                state.adaptive = truth;
                Override::Adaptive
            }
            Switch::FeedStop => {
                state.feed_hold = truth;
                Override::FeedStop
            }
        };
        self.emit(state, Event::Override { kind, on });
    }
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
