//! Straight moves, and which kind of motion a block makes.
//!
//! Knows: targets from words (absolute, incremental, polar, machine coordinates), feed conditions. Must not know: arcs' centres,
//! cycles' strokes, offsets' values.

use std::rc::Rc;

use gcheck_controls::{CodeIx, Effect, Letter, LetterSet};
use gcheck_geometry::{Bezier, CurveArc, Degrees, Mm, Plane};
use nalgebra::Point2;

use super::arc::{axes_of_plane, plane_axes};
use crate::assumption::{Assumption, Unsettled};
use crate::eval::value::Domain;
use crate::event::{Curve, CurvePiece, Event, FeedMode, Spindle, Travel, TravelKind};
use crate::exec::context::{Count, Executor, Step};
use crate::fault::{CompensationFault, Fault};
use crate::lattice::Perhaps;
use crate::model::Role;
use crate::model::contract::POLAR;
use crate::observer::Observer;
use crate::position::{Axis, Position};
use crate::state::{ControlPoints, Course, KeptTurningWords, State, TurningWords};

#[expect(clippy::unnecessary_wraps, reason = "handlers of effects share one signature")]
impl<D: Domain, O: Observer<D>> Executor<'_, '_, D, O> {
    /// Moves as the active mode says.
    pub(super) fn motion(&mut self, state: &mut State<D>) -> Step {
        self.turn_drawing(state);
        let moved = self.repeated_motion(state);
        let moved = self.held(moved)?;
        if !state.calls.modal.is_off() && self.words.present().intersects(self.model.axis_letters) {
            self.modal_call(state);
        }
        moved
    }

    /// The motion of the block, as many times as it asks for.
    fn repeated_motion(&mut self, state: &mut State<D>) -> Step {
        let Some(letter) = self.model.semantics().cut_repeats.map(Letter::of) else {
            return self.active_motion(state);
        };
        if !self.words.has(letter) || !self.repeats_cut(letter, state) {
            return self.active_motion(state);
        }
        let times = match Self::whole(letter, self.words.number(letter).unwrap_or(f64::NAN))? {
            Count::Known(times) => times.clamp(1, crate::cycles::MAX_STROKES),
            Count::Unknown => {
                self.active_motion(state)?;
                self.emit(state, Event::Unfollowed);
                return if state.is_incremental(self.model) == Some(false) {
                    Ok(())
                } else {
                    self.lose_position(state)
                };
            }
        };
        for _ in 0..times {
            self.active_motion(state)?;
        }
        Ok(())
    }

    /// Does the letter belong to the cut that is made, and to no other code of the block?
    fn repeats_cut(&self, letter: Letter, state: &State<D>) -> bool {
        let cuts = state.mode(Role::Motion).only().is_some_and(|mode| {
            matches!(
                self.model.effect(mode),
                Effect::Linear | Effect::ArcClockwise | Effect::ArcCounterClockwise
            )
        });
        let is_others = self.words.codes().iter().any(|ix| {
            self.model.role(*ix) != Some(Role::Motion)
                && self
                    .model
                    .contracts
                    .get(ix.index())
                    .is_some_and(|contract| contract.reads_all || contract.reads.contains(letter))
        });
        cuts && !is_others && state.active_cycle(self.model) == Some(CodeIx::NONE)
    }

    fn active_motion(&mut self, state: &mut State<D>) -> Step {
        let present = self.words.present();
        let has_axes = present.intersects(self.model.axis_letters) || present.intersects(POLAR);
        let Some(cycle) = state.active_cycle(self.model) else { return self.lose_motion(state) };
        if cycle.is_some() {
            return self.cycle(cycle, state);
        }
        let to_machine_point = has_axes && self.machine_coordinates;
        if to_machine_point && self.model.semantics().machine_coordinates_rapid {
            return self.straight(TravelKind::Rapid, state);
        }
        let Some(mode) = state.mode(Role::Motion).only() else { return self.lose_motion(state) };
        let effect = self.model.effect(mode);
        if to_machine_point && !self.moves_to_machine_point(mode) {
            return Err(Fault::NoMotionMode);
        }
        match effect {
            Effect::Rapid if has_axes => self.straight(TravelKind::Rapid, state),
            Effect::Linear if has_axes => self.straight(TravelKind::Feed, state),
            Effect::ArcClockwise | Effect::ArcCounterClockwise => {
                if has_axes || present.intersects(const { LetterSet::of("IJKR") }) {
                    self.arc(effect == Effect::ArcCounterClockwise, state)
                } else if self.words.codes().contains(&mode) {
                    // `G2` alone chooses the mode; some controls refuse it.
                    self.bare_motion_code()
                } else {
                    Ok(())
                }
            }
            Effect::Thread | Effect::RigidTap if has_axes => self.thread_move(effect, state),
            effect if has_axes && effect.is_probing_move() => self.probe_move(effect, state),
            Effect::TurningPass | Effect::ThreadingPass | Effect::FacingPass if has_axes => {
                self.turning_pass(effect, state)
            }
            Effect::SplineCubic | Effect::SplineQuadratic if has_axes => self.spline(effect, state),
            Effect::NurbsOpen => self.nurbs_point(state),
            // Some controls make a move of no length of it, which needs a feed as every other.
            Effect::Rapid | Effect::Linear
                if self.refuses_incomplete() && self.words.codes().contains(&mode) =>
            {
                self.straight(
                    if effect == Effect::Rapid { TravelKind::Rapid } else { TravelKind::Feed },
                    state,
                )
            }
            Effect::Linear if self.has_angle() => {
                // Where a line that only has its angle ends, the next block says: the point in which the two lines meet.
                for axis in axes_of_plane(state.plane(self.model)) {
                    state.points.position.set(axis, f64::NAN);
                    state.points.actual.set(axis, f64::NAN);
                }
                self.emit(state, Event::Unfollowed);
                Ok(())
            }
            Effect::Rapid | Effect::Linear => Ok(()),
            Effect::None if mode == CodeIx::NONE && has_axes => Err(Fault::NoMotionMode),
            Effect::None if has_axes => self.lose_position(state),
            _ => self.bare_motion_code(),
        }
    }

    /// A code that moves in its own block, whatever mode stays in effect.
    pub(super) fn motion_of_block(&mut self, effect: Effect, state: &mut State<D>) -> Step {
        if !self.words.present().intersects(self.model.axis_letters) {
            return Ok(());
        }
        match effect {
            Effect::Rapid => self.straight(TravelKind::Rapid, state)?,
            Effect::Linear => self.straight(TravelKind::Feed, state)?,
            _ => self.lose_position(state)?,
        }
        self.modal_call(state);
        Ok(())
    }

    /// `G174`, `G184` of mills: a tap in any direction, from where the tool stands. The control starts, reverses and stops the
    /// spindle.
    pub(super) fn tap_here(&mut self, clockwise: bool, state: &mut State<D>) -> Step {
        let bottom = self.target(state)?;
        let start = *state.position();
        let checked = self.held(self.check_feed(state))?;
        let (inward, outward) = if clockwise {
            (Spindle::Clockwise, Spindle::CounterClockwise)
        } else {
            (Spindle::CounterClockwise, Spindle::Clockwise)
        };
        self.spindle(inward, state)?;
        self.travel(TravelKind::Feed, bottom, true, state)?;
        self.spindle(outward, state)?;
        self.travel(TravelKind::Feed, start, true, state)?;
        self.spindle(Spindle::Stopped, state)?;
        self.modal_call(state);
        checked
    }

    fn bare_motion_code(&self) -> Step {
        if self.refuses_incomplete() { Err(Fault::NoAxisWords) } else { Ok(()) }
    }

    /// Controls that refuse words and codes that do not fit together.
    pub(crate) fn refuses_incomplete(&self) -> bool {
        self.model.semantics().strict
    }

    /// May the motion go to a point in machine coordinates (`G53`)? A probing code may where the control reads the limit of its
    /// move so, in its own block.
    pub(super) fn moves_to_machine_point(&self, motion: CodeIx) -> bool {
        let effect = self.model.effect(motion);
        let probes = self.model.semantics().machine_coordinates_in_probing
            && effect.is_probing_move()
            && self.words.codes().contains(&motion);
        probes || effect.is_straight_move()
    }

    /// What a block without a known mode of motion does: it may be a move of any kind that the modes allow, or a cycle, with
    /// the words that each keeps.
    fn lose_motion(&mut self, state: &mut State<D>) -> Step {
        let may_be = |role: Role, is: &dyn Fn(Effect) -> bool| {
            let modes = state.mode(role);
            modes.alternatives().is_empty() || modes.may(|code| is(self.model.effect(code)))
        };
        let probes = may_be(Role::Motion, &Effect::is_probing_move);
        let turns = may_be(Role::Motion, &|effect| {
            matches!(effect, Effect::TurningPass | Effect::ThreadingPass | Effect::FacingPass)
        });
        let curves = may_be(Role::Motion, &|effect| {
            matches!(effect, Effect::SplineCubic | Effect::SplineQuadratic | Effect::NurbsOpen)
        });
        let cycles = may_be(Role::Cycle, &|effect| effect != Effect::CycleCancel && effect != Effect::None);
        if probes {
            state.probe.forget();
        }
        if turns {
            let TurningWords { start, corner, taper, lead, .. } = TurningWords::UNKNOWN;
            let words = TurningWords { start, corner, taper, lead, ..state.turning() };
            state.turning = KeptTurningWords::of(&words);
        }
        if curves {
            state.curve = Perhaps::Unknown;
        }
        if cycles {
            state.cycle = state.cycle.forgotten();
            // The level of a hole is not named by its block.
            state.points.lose();
        }
        self.lose_position(state)
    }

    /// A move whose mode is not known: the named axes end nobody knows where.
    pub(super) fn lose_position(&mut self, state: &mut State<D>) -> Step {
        for letter in self.words.present().iter() {
            if let Some((axis, _)) = self.model.axis_of(letter) {
                state.points.position.set(axis, f64::NAN);
                state.points.actual.set(axis, f64::NAN);
            }
        }
        self.emit(state, Event::Unfollowed);
        Ok(())
    }

    /// The programmed point of the block: axes that it does not name stay.
    pub(super) fn target(&mut self, state: &State<D>) -> Step<Position> {
        let mut target = *state.position();
        if let Some(cylinder) = state.cylinder() {
            // It turns though no word of the program names it.
            target.set(cylinder.rotary, state.actual().raw(cylinder.rotary));
        }
        let incremental = self.is_incremental(state);
        let unit = self.unit(state);
        let named = self.words.present().and(self.model.axis_letters);
        for letter in named.iter() {
            let Some((own, is_increment)) = self.model.axis_of(letter) else { continue };
            let Some(mut value) = self.words.number(letter) else { continue };
            let axis = self.axis_on_face(own, state);
            let is_drawn = self.is_second_on_face(own) && !state.face().is_no();
            if let Some(machine) = &self.machine.axes
                && !machine.contains(&own)
                && !is_drawn
            {
                return Err(Fault::NoSuchAxis(letter));
            }
            if !axis.is_rotary() && value != 0.0 {
                value *= unit;
            }
            let diameters = state.words_are_diameters(self.model);
            if axis == Axis::X && diameters != Some(false) {
                value = if diameters.is_some() { value / 2.0 } else { f64::NAN };
            }
            let value = match (is_increment, incremental) {
                (true, _) | (false, Some(true)) => target.raw(axis) + value,
                (false, Some(false)) if axis.is_rotary() && self.machine.shorter_way.contains(&axis) => {
                    shorter_way(target.raw(axis), value)
                }
                (false, Some(false)) => value,
                (false, None) => f64::NAN,
            };
            let is_unsure = state.face().is_unknown() && self.is_second_on_face(own);
            target.set(axis, if is_unsure { f64::NAN } else { value });
            if is_unsure {
                // It may be a coordinate of the face.
                target.set(Axis::Y, f64::NAN);
            }
        }
        if self.words.present().intersects(POLAR) {
            self.polar_target(&mut target, state)?;
        } else if state.effect(Role::Polar, self.model) == Some(Effect::PolarOn) {
            self.polar_words(&mut target, state);
        } else if state.may_be(Role::Polar, Effect::PolarOn, self.model) {
            let mut named = [Axis::X, Axis::Y, Axis::Z].into_iter();
            if named.any(|axis| self.words.has(axis.letter())) {
                // A coordinate, or a radius or an angle.
                for axis in axes_of_plane(state.plane(self.model)) {
                    target.set(axis, f64::NAN);
                }
            }
        }
        Ok(target)
    }

    /// The axis that a word for this one moves: on the face of a part some controls write the second coordinate with the
    /// address of the rotary axis.
    fn axis_on_face(&self, own: Axis, state: &State<D>) -> Axis {
        if self.is_second_on_face(own) && state.face().yes().is_some() { Axis::Y } else { own }
    }

    /// Is the second coordinate on the face of a part written with the address of this axis?
    fn is_second_on_face(&self, own: Axis) -> bool {
        let rules = self.model.semantics().polar_interpolation;
        rules.is_some_and(|rules| Letter::of(rules.second) == own.letter())
    }

    /// `@` and `^`: distance and angle from the XY origin.
    fn polar_target(&mut self, target: &mut Position, state: &State<D>) -> Step {
        let (x, y) = (state.position().raw(Axis::X), state.position().raw(Axis::Y));
        if self.words.has(Letter::of('X')) || self.words.has(Letter::of('Y')) || self.machine_coordinates {
            return Err(Fault::Conflict);
        }
        let incremental = state.is_incremental(self.model) == Some(true);
        let (old_radius, old_angle) = (x.hypot(y), y.atan2(x).to_degrees());
        let unit = self.unit(state);
        if self.refuses_incomplete() && old_radius == 0.0 && !self.words.has(Letter::CARET) {
            return Err(Fault::MissingWord(Letter::CARET));
        }
        let radius = self.words.number(Letter::AT).map(|r| r * unit);
        let angle = self.words.number(Letter::CARET);
        if incremental && old_radius == 0.0 && angle.is_some() && !self.words.has(Letter::AT) {
            return Ok(());
        }
        let radius = match (radius, incremental) {
            (Some(r), true) => old_radius + r,
            (Some(r), false) => r,
            (None, _) => old_radius,
        };
        let angle = match (angle, incremental) {
            (Some(a), true) => old_angle + a,
            (Some(a), false) => a,
            (None, _) => old_angle,
        };
        let (sin, cos) = angle.to_radians().sin_cos();
        target.set(Axis::X, radius * cos);
        target.set(Axis::Y, radius * sin);
        Ok(())
    }

    /// `G16`: the plane's first word is a radius, the second an angle in degrees.
    fn polar_words(&mut self, target: &mut Position, state: &State<D>) {
        let Some(plane) = state.plane(self.model) else { return };
        let (first, second, _) = plane.axes();
        let (Some(first), Some(second)) = (Axis::ALL.get(first), Axis::ALL.get(second)) else { return };
        if !self.words.has(first.letter()) && !self.words.has(second.letter()) {
            return;
        }
        let (x, y) = (state.position().raw(*first), state.position().raw(*second));
        let stands_at = y.atan2(x).to_degrees();
        let radius = self.words.number(first.letter()).map(|radius| radius * self.unit(state));
        let angle = self.words.number(second.letter());
        let (radius, angle) = match state.is_incremental(self.model) {
            Some(false) => (radius.unwrap_or_else(|| x.hypot(y)), angle.unwrap_or(stands_at)),
            // An increment of the angle turns on about the origin. What a radius then counts from is in no page.
            Some(true) if radius.is_none() => (x.hypot(y), angle.map_or(stands_at, |by| stands_at + by)),
            _ => (f64::NAN, f64::NAN),
        };
        let (sin, cos) = angle.to_radians().sin_cos();
        target.set(*first, radius * cos);
        target.set(*second, radius * sin);
    }

    /// `G0`, `G1`.
    fn straight(&mut self, kind: TravelKind, state: &mut State<D>) -> Step {
        if self.machine_coordinates {
            return self.machine_move(kind, state);
        }
        let mut target = self.target(state)?;
        self.announce_vector(state);
        let checked = self.held(if kind == TravelKind::Feed { self.check_feed(state) } else { Ok(()) })?;
        if kind == TravelKind::Feed {
            if self.has_angle() {
                self.aim(&mut target, state);
            }
            if let Some(corner) = self.corner_of_block(state) {
                self.cut_to_corner(target, corner, state)?;
                return checked;
            }
        }
        self.announce_known_way(state);
        self.travel(kind, target, false, state)?;
        checked
    }

    /// An increment of an axis whose place is not known: its way is known, and with it the time.
    fn announce_known_way(&mut self, state: &mut State<D>) {
        let is_polar = self.words.present().intersects(POLAR)
            || state.effect(Role::Polar, self.model) == Some(Effect::PolarOn)
            || state.may_be(Role::Polar, Effect::PolarOn, self.model);
        // A radius and an angle are not ways of axes.
        if is_polar || !Self::goes_direct(state) {
            return;
        }
        let unit = self.unit(state);
        let mut way = Position::UNKNOWN;
        for letter in self.words.present().and(self.model.axis_letters).iter() {
            let Some((axis, is_increment)) = self.model.axis_of(letter) else { continue };
            let is_relative = is_increment || self.is_incremental(state) == Some(true);
            if !is_relative || !state.actual().raw(axis).is_nan() || self.is_second_on_face(axis) {
                continue;
            }
            let value = self.words.number(letter).unwrap_or(f64::NAN);
            let value = if axis.is_rotary() { value } else { value * unit };
            let is_diameter = axis == Axis::X && state.words_are_diameters(self.model) != Some(false);
            way.set(axis, if is_diameter { value / 2.0 } else { value });
        }
        if way.values().iter().any(|part| !part.is_nan()) {
            self.emit(state, Event::KnownWay(way));
        }
    }

    /// A fault that an analysis of all paths holds back until the move is made, so that it goes on where the program means to be.
    pub(super) fn held(&self, checked: Step) -> Step<Step> {
        if self.lenient { Ok(checked) } else { checked.map(Ok) }
    }

    /// Is the feed good for a cut in this block?
    pub(super) fn check_feed(&self, state: &State<D>) -> Step {
        match state.feed_mode(self.model) {
            Some(FeedMode::InverseTime) => {
                if !self.words.has(Letter::of('F')) {
                    return Err(Fault::NoInverseTimeFeed);
                }
                // A control with a slowest move makes that of a feed of zero.
                let takes_zero = self.model.semantics().least_inverse_feed > 0.0;
                let is_none = |f: f64| f < 0.0 || f == 0.0 && !takes_zero;
                if self.words.number(Letter::of('F')).is_some_and(is_none) {
                    return Err(Fault::NoFeed);
                }
            }
            Some(FeedMode::PerRevolution) => {
                if D::known(state.feed()) == Some(0.0) {
                    return Err(Fault::NoFeed);
                }
                if self.refuses_incomplete() && D::known(state.speed()) == Some(0.0) {
                    return Err(Fault::SpindleStopped);
                }
            }
            _ => {
                if D::known(state.feed()) == Some(0.0) {
                    return Err(Fault::NoFeed);
                }
            }
        }
        Ok(())
    }

    /// Under inverse time every cut has a feed of its own, from its length in millimetres.
    pub(super) fn announce_inverse_time(
        &mut self,
        length: impl FnOnce(&State<D>) -> f64,
        state: &mut State<D>,
    ) {
        if state.feed_mode(self.model) == Some(FeedMode::InverseTime) {
            let rate = D::known(state.feed()).unwrap_or(f64::NAN) * length(state);
            let least = self.model.semantics().least_inverse_feed * self.unit(state);
            self.emit(state, Event::FeedRate(if rate < least { least } else { rate }));
        }
    }

    /// `G53`: the words are machine coordinates.
    fn machine_move(&mut self, kind: TravelKind, state: &mut State<D>) -> Step {
        self.check_named_axes()?;
        let polar = self.words.present().intersects(POLAR);
        if (polar || state.is_incremental(self.model) == Some(true)) && self.refuses_incomplete() {
            return Err(Fault::Conflict);
        }
        if self.compensates(state) && self.refuses_incomplete() {
            return Err(Fault::Compensation(CompensationFault::NotWhileOn));
        }
        let unit = self.unit(state);
        let mut machine = state.machine(self.model, self.machine);
        let named = self.words.present().and(self.model.axis_letters);
        let diameter = state.is_diameter(self.model) == Some(true);
        for letter in named.iter() {
            let Some((axis, _)) = self.model.axis_of(letter) else { continue };
            let Some(value) = self.words.number(letter) else { continue };
            let value = if axis.is_rotary() { value } else { value * unit };
            machine.set(axis, if axis == Axis::X && diameter { value / 2.0 } else { value });
        }
        let checked = self.held(if kind == TravelKind::Feed { self.check_feed(state) } else { Ok(()) })?;
        let mut from = *state.actual();
        // Axes that the block does not name go to their place after compensation.
        if !state.compensation.left.is_no() && self.refuses_incomplete() {
            self.leave_compensation(false, state)?;
            from = self.axes_of(state.position(), state);
        }
        let is_rotated = state.work_offset().rotation != 0.0;
        let moves =
            |axis: Axis| named.contains(axis.letter()) || is_rotated && matches!(axis, Axis::X | Axis::Y);
        let mut to = state.at_machine(&machine, &from, moves, self.model, self.machine);
        self.moved_off_drawing(named, &mut to, state);
        self.travel_to(kind, &to, &to, false, state);
        state.points.position = self.programmed_of(&to, state);
        checked
    }

    /// A straight move to a programmed point.
    pub(super) fn travel(
        &mut self,
        kind: TravelKind,
        target: Position,
        expanded: bool,
        state: &mut State<D>,
    ) -> Step {
        if state.compensation.is_followed() {
            if kind == TravelKind::Feed {
                let unit = self.unit(state);
                self.announce_inverse_time(|state| straight_length(state.position(), &target, unit), state);
            }
            return self.compensated_line(kind, target, state);
        }
        if self.stays_beside(&target, state) {
            self.beside_left_path(kind, target, expanded, state);
            return Ok(());
        }
        let may_stay = self.may_stay_beside(&target, state);
        if !may_stay && !state.compensation.left.is_no() {
            self.leave_compensation(false, state)?;
        }
        let mut to = self.axes_of(&target, state);
        if may_stay {
            for axis in [Axis::X, Axis::Y, Axis::Z].into_iter().filter(|axis| !self.names_axis(*axis)) {
                to.set(axis, f64::NAN);
            }
        }
        if !expanded {
            self.keep_unnamed(&mut to, state);
        }
        if self.may_run_beside(state) {
            // Compensation by a tool of unknown size: the path beside the programmed one is not known.
            to = self.beside(to, state);
            self.emit(state, Event::Unfollowed);
        }
        self.travel_to(kind, &target, &to, expanded, state);
        state.points.position = target;
        Ok(())
    }

    /// Is the path of a compensation that was switched off still to be left: by a move in its plane?
    fn stays_beside(&self, target: &Position, state: &State<D>) -> bool {
        let Perhaps::Yes(Course::Followed(left)) = &state.compensation.left else { return false };
        self.stays_in(left.plane, target, state)
    }

    /// May the path that was left be one that nobody knows, and this be a move beside it?
    fn may_stay_beside(&self, target: &Position, state: &State<D>) -> bool {
        let is_unknown = match &state.compensation.left {
            Perhaps::No => false,
            Perhaps::Yes(course) => matches!(course, Course::Unknown),
            Perhaps::Unknown => true,
        };
        is_unknown && state.plane(self.model).is_none_or(|plane| self.stays_in(plane, target, state))
    }

    /// Does a move leave the axes of a plane where they are, on a control that then goes on beside a path that was left?
    fn stays_in(&self, plane: Plane, target: &Position, state: &State<D>) -> bool {
        let ([first, second, _], _) = plane_axes(plane);
        let stays = |axis: Axis| {
            let named = self.model.letters_of(axis).any(|letter| self.words.has(letter));
            !named && target.raw(axis).to_bits() == state.position().raw(axis).to_bits()
        };
        !self.refuses_incomplete() && stays(first) && stays(second)
    }

    /// A move beside a path that was compensated: the axes of its plane stand still.
    fn beside_left_path(&mut self, kind: TravelKind, target: Position, expanded: bool, state: &mut State<D>) {
        let mut to = self.axes_of(&target, state);
        if let Perhaps::Yes(Course::Followed(left)) = &state.compensation.left {
            let ([first, second, _], _) = plane_axes(left.plane);
            for axis in [first, second] {
                to.set(axis, state.actual().raw(axis));
            }
        }
        self.travel_to(kind, &target, &to, expanded, state);
        state.points.position = target;
    }

    /// Do the axes go where the program says, without compensation or mapping in between?
    pub(super) fn goes_direct(state: &State<D>) -> bool {
        state.compensation.is_off() && state.transform.is_off() && !state.tool_shift.is_on()
    }

    /// [`Self::travel`] where [`Self::goes_direct`] holds.
    pub(super) fn travel_direct(
        &mut self,
        kind: TravelKind,
        target: &Position,
        expanded: bool,
        state: &mut State<D>,
    ) {
        self.travel_to(kind, target, target, expanded, state);
        state.points.position = *target;
    }

    fn travel_to(
        &mut self,
        kind: TravelKind,
        programmed: &Position,
        to: &Position,
        expanded: bool,
        state: &mut State<D>,
    ) {
        if kind == TravelKind::Feed {
            let unit = self.unit(state);
            self.announce_inverse_time(|state| straight_length(state.actual(), to, unit), state);
        }
        let from = *state.actual();
        let event = Event::Travel(Travel { kind, from, programmed: *programmed, to: *to, expanded });
        state.points.actual = *to;
        self.emit(state, event);
    }

    /// `G33`, `G33.1`, lathe `G32`.
    fn thread_move(&mut self, effect: Effect, state: &mut State<D>) -> Step {
        let target = self.target(state)?;
        let k = self.length(Letter::of('K'), state);
        let by_feed = self.motion_reads(Letter::of('F'), state);
        let lead = k
            .filter(|_| !by_feed)
            .or_else(|| self.lead(state).or_else(|| D::known(state.feed()).filter(|f| *f > 0.0)));
        let Some(lead) = lead else {
            let missing = if self.refuses_incomplete() { 'K' } else { 'F' };
            let missing = self.held(Err(Fault::MissingWord(Letter::of(missing))))?;
            self.travel(TravelKind::Thread, target, false, state)?;
            return missing;
        };
        if by_feed && lead == 0.0 {
            let missing = self.held(Err(Fault::NoFeed))?;
            self.travel(TravelKind::Thread, target, false, state)?;
            return missing;
        }
        if self.refuses_incomplete() && Self::spindle_turns(state) == Some(false) {
            return Err(Fault::SpindleStopped);
        }
        if effect == Effect::RigidTap {
            let scale = self.words.number(Letter::of('I')).unwrap_or(1.0);
            self.emit(state, Event::SpindleSync { lead: Some(Mm(lead)), velocity: false });
            self.emit(state, Event::RigidTap { from: *state.actual(), to: target, scale });
            self.emit(state, Event::SpindleSync { lead: None, velocity: false });
            return Ok(());
        }
        let change = k.filter(|_| by_feed).unwrap_or(0.0);
        let lead = mean_lead(lead, change, state.position(), &target);
        self.emit(state, Event::SpindleSync { lead: Some(Mm(lead)), velocity: false });
        self.travel(TravelKind::Thread, target, false, state)?;
        self.emit(state, Event::SpindleSync { lead: None, velocity: false });
        Ok(())
    }

    /// Is a word one of the motion code's own?
    fn motion_reads(&self, letter: Letter, state: &State<D>) -> bool {
        let code = state.mode(Role::Motion).only().and_then(|ix| self.model.control().code_at(ix));
        code.is_some_and(|code| {
            code.entry().words.iter().any(|word| Letter::parse(&word.letter) == Some(letter))
        })
    }

    /// `G5`, `G5.1`: Bézier curves in XY.
    fn spline(&mut self, effect: Effect, state: &mut State<D>) -> Step {
        if self.compensates(state) {
            return Err(Fault::Compensation(CompensationFault::NotWhileOn));
        }
        let others = self.words.present().intersects(LetterSet::of("ZABCUVW"));
        if self.refuses_incomplete() && others {
            return Err(Fault::Conflict);
        }
        self.check_xy_plane(state)?;
        let target = self.target(state)?;
        self.check_feed(state)?;
        let offset = |letter: char| self.length(Letter::of(letter), state);
        let (i, j) = (offset('I'), offset('J'));
        let (p, q) = (offset('P'), offset('Q'));
        let start = [state.position().raw(Axis::X), state.position().raw(Axis::Y)];
        let end = [target.raw(Axis::X), target.raw(Axis::Y)];
        let points = if effect == Effect::SplineQuadratic {
            let (Some(i), Some(j)) = (i, j) else { return Err(Fault::MissingWord(Letter::of('I'))) };
            vec![start, [start[0] + i, start[1] + j], end]
        } else {
            let (Some(p), Some(q)) = (p, q) else { return Err(Fault::MissingWord(Letter::of('P'))) };
            let first = match (i, j, &state.curve) {
                (Some(i), Some(j), _) => [i, j],
                (None, None, Perhaps::Yes(last)) => last.0.first().map_or([0.0; 2], |l| [-l[0], -l[1]]),
                (None, None, Perhaps::No) => [0.0; 2],
                (None, None, Perhaps::Unknown) => {
                    self.assumptions.insert(Assumption::Unsettled(Unsettled::Curve));
                    [f64::NAN; 2]
                }
                (None, Some(_), _) => return Err(Fault::MissingWord(Letter::of('I'))),
                (Some(_), None, _) => return Err(Fault::MissingWord(Letter::of('J'))),
            };
            state.curve = Perhaps::Yes(ControlPoints(Rc::new(vec![[p, q, 0.0]])));
            vec![start, [start[0] + first[0], start[1] + first[1]], [end[0] + p, end[1] + q], end]
        };
        let count = points.len() as u32;
        let pieces = arcs(&points);
        let curve = Curve { from: *state.actual(), to: target, points: count, pieces };
        state.points.actual = target;
        state.points.position = target;
        self.emit(state, Event::Curve(curve));
        if self.refuses_incomplete() {
            // A curve is no mode that lasts.
            state.set_mode(Role::Motion, CodeIx::NONE);
        }
        Ok(())
    }

    /// Strict controls cut arcs and cycles in no plane of secondary axes.
    pub(super) fn check_primary_plane(&self, motion: CodeIx, state: &State<D>) -> Step {
        match state.mode(Role::Plane).only() {
            Some(plane)
                if self.refuses_incomplete() && self.model.effect(plane) == Effect::PlaneSecondary =>
            {
                Err(Fault::NotNow(motion, Some(plane)))
            }
            _ => Ok(()),
        }
    }

    /// Curves are drawn in XY only.
    fn check_xy_plane(&self, state: &State<D>) -> Step {
        let plane = state.mode(Role::Plane).only();
        let other = plane.filter(|ix| !matches!(self.model.effect(*ix), Effect::PlaneXy | Effect::None));
        match (other, state.mode(Role::Motion).only()) {
            (Some(other), Some(motion)) if self.refuses_incomplete() => {
                Err(Fault::NotNow(motion, Some(other)))
            }
            _ => Ok(()),
        }
    }

    /// A control point of a NURBS block.
    fn nurbs_point(&mut self, state: &mut State<D>) -> Step {
        let target = self.target(state)?;
        let weight = self.words.number(Letter::of('P'));
        let open = match std::mem::take(&mut state.curve) {
            Perhaps::No => None,
            Perhaps::Yes(ControlPoints(points)) => Some(points),
            Perhaps::Unknown => {
                // Whether this is its first point or another one, the curve is not known.
                self.assumptions.insert(Assumption::Unsettled(Unsettled::Curve));
                state.curve = Perhaps::Unknown;
                return Ok(());
            }
        };
        let opens = open.is_none();
        // The first entry is the start, with the curve's order instead of a weight.
        let mut points = match open {
            Some(points) => (*points).clone(),
            None => {
                self.check_feed(state)?;
                vec![[state.position().raw(Axis::X), state.position().raw(Axis::Y), LEAST_ORDER]]
            }
        };
        if let (Some(order), Some([_, _, slot])) = (self.words.number(Letter::of('L')), points.first_mut()) {
            *slot = order.max(LEAST_ORDER);
        }
        let (x, y) = (self.words.has(Letter::of('X')), self.words.has(Letter::of('Y')));
        let polar = self.words.present().intersects(POLAR);
        if x || y || polar || !opens {
            if (!x || !y) && !polar {
                return Err(Fault::MissingWord(Letter::of(if x { 'Y' } else { 'X' })));
            }
            let weight = weight.filter(|_| !opens);
            if !opens && weight.is_none_or(|weight| weight <= 0.0) {
                return Err(if weight.is_none() {
                    Fault::MissingWord(Letter::of('P'))
                } else {
                    Fault::WordRange(Letter::of('P'))
                });
            }
            points.push([target.raw(Axis::X), target.raw(Axis::Y), weight.unwrap_or(1.0)]);
        }
        state.curve = Perhaps::Yes(ControlPoints(Rc::new(points)));
        Ok(())
    }

    /// `G5.3`: the curve is cut.
    pub(super) fn nurbs_close(&mut self, state: &mut State<D>) -> Step {
        let (to, polygon) = match std::mem::take(&mut state.curve) {
            Perhaps::No => return Err(Fault::NoMotionMode),
            Perhaps::Yes(ControlPoints(points)) => {
                let count = f64::from(u32::try_from(points.len()).unwrap_or(u32::MAX));
                if points.first().is_some_and(|[_, _, order]| count < *order) {
                    return Err(Fault::TooFewPoints);
                }
                let end = points.last().map(|[x, y, _]| [*x, *y]);
                (end, points.iter().map(|[x, y, _]| [*x, *y]).collect())
            }
            Perhaps::Unknown => {
                self.assumptions.insert(Assumption::Unsettled(Unsettled::Curve));
                (Some([f64::NAN; 2]), Vec::new())
            }
        };
        let mut end = *state.position();
        if let Some([x, y]) = to {
            end.set(Axis::X, x);
            end.set(Axis::Y, y);
        }
        let line = |[x, y]: &[f64; 2]| CurvePiece::Line([Mm(*x), Mm(*y)]);
        let pieces: Rc<[CurvePiece]> = polygon.iter().skip(1).map(line).collect();
        let curve = Curve { from: *state.actual(), to: end, points: polygon.len() as u32, pieces };
        state.points.actual = end;
        state.points.position = end;
        self.emit(state, Event::Curve(curve));
        state.set_mode(Role::Motion, CodeIx::NONE);
        Ok(())
    }
}

/// The angle `to` as it is the shorter way from `from`; where that is not known, itself.
fn shorter_way(from: f64, to: f64) -> f64 {
    if from.is_nan() { to } else { Degrees(to).nearest_to(Degrees(from)).0 }
}

/// A curve by control points is of this order at least.
const LEAST_ORDER: f64 = 3.0;

/// Length of a straight move in millimetres; of a move of rotary axes alone, degrees that count as the program's unit of
/// length does.
fn straight_length(from: &Position, to: &Position, unit: f64) -> f64 {
    let norm = |axes: [Axis; 3]| {
        axes.map(|axis| to.raw(axis) - from.raw(axis)).iter().map(|d| d * d).sum::<f64>().sqrt()
    };
    let linear = norm([Axis::X, Axis::Y, Axis::Z]);
    if linear != 0.0 {
        return linear;
    }
    let secondary = norm([Axis::U, Axis::V, Axis::W]);
    if secondary == 0.0 { norm([Axis::A, Axis::B, Axis::C]) * unit } else { secondary }
}

/// A thread whose lead grows by `change` each turn takes as many turns as one of this lead. Leads count along the axis that
/// goes farther; a thread whose lead would come to nothing keeps the one that it begins with.
fn mean_lead(lead: f64, change: f64, from: &Position, to: &Position) -> f64 {
    if change == 0.0 {
        return lead;
    }
    let way = [Axis::X, Axis::Z].map(|axis| (to.raw(axis) - from.raw(axis)).abs());
    let last = (lead * lead + 2.0 * change * way[0].max(way[1])).sqrt();
    if last.is_finite() { f64::midpoint(lead, last) } else { lead }
}

/// A Bézier curve as arcs within a hundredth of a millimetre, which touch each other as the curve does.
fn arcs(points: &[[f64; 2]]) -> Rc<[CurvePiece]> {
    let control: Vec<Point2<f64>> = points.iter().map(|[x, y]| Point2::new(*x, *y)).collect();
    let curve = match control.as_slice() {
        [a, b, c] => Bezier::Quadratic([*a, *b, *c]),
        [a, b, c, d] => Bezier::Cubic([*a, *b, *c, *d]),
        _ => return Rc::from([]),
    };
    let piece = |arc: CurveArc| {
        let to = [Mm(arc.end.x), Mm(arc.end.y)];
        arc.centre.map_or(CurvePiece::Line(to), |(centre, counter_clockwise)| CurvePiece::Arc {
            to,
            centre: [Mm(centre.x), Mm(centre.y)],
            turn: if counter_clockwise { 1 } else { -1 },
        })
    };
    curve.arcs(Mm(0.01)).into_iter().map(piece).collect()
}
