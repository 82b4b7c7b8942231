//! Circular and helical moves.
//!
//! Knows: centres and radii from words, which words belong to which plane, the control's tolerance. Must not know: how an arc
//! is measured (`gcheck-geometry`).

use gcheck_controls::{Effect, Letter};
use gcheck_geometry::{Arc, ArcDirection, ArcError, ArcTolerance, Mm, Plane};

use crate::eval::value::Domain;
use crate::event::{ArcMove, Event, TravelKind, Units};
use crate::exec::context::{Count, Executor, Step};
use crate::fault::{ArcFault, Fault};
use crate::model::Role;
use crate::observer::Observer;
use crate::position::{Axis, Position};
use crate::state::State;

/// Axes of a plane: first, second, normal, and the centre words of the three.
pub(super) fn plane_axes(plane: Plane) -> ([Axis; 3], [Letter; 3]) {
    let of = |index: usize| match index {
        0 => (Axis::X, Letter::of('I')),
        1 => (Axis::Y, Letter::of('J')),
        _ => (Axis::Z, Letter::of('K')),
    };
    let (first, second, normal) = plane.axes();
    let all = [of(first), of(second), of(normal)];
    (all.map(|(axis, _)| axis), all.map(|(_, centre)| centre))
}

/// The axes that lie in a plane; of a plane that is not known any of the three may.
pub(super) fn axes_of_plane(plane: Option<Plane>) -> impl Iterator<Item = Axis> {
    let normal = plane.map(|plane| {
        let ([_, _, normal], _) = plane_axes(plane);
        normal
    });
    [Axis::X, Axis::Y, Axis::Z].into_iter().filter(move |axis| normal != Some(*axis))
}

#[expect(clippy::unnecessary_wraps, reason = "handlers of effects share one signature")]
impl<D: Domain, O: Observer<D>> Executor<'_, '_, D, O> {
    /// `G2`, `G3`.
    pub(super) fn arc(&mut self, counter_clockwise: bool, state: &mut State<D>) -> Step {
        let target = self.target(state)?;
        let result = self.arc_to(counter_clockwise, &target, state);
        if result.is_err() && !state.compensation.is_followed() {
            // The program means this point, whatever is wrong with the way there.
            state.points.position = target;
            state.points.actual = self.axes_of(&target, state);
        }
        result
    }

    fn arc_to(&mut self, counter_clockwise: bool, target: &Position, state: &mut State<D>) -> Step {
        self.check_feed(state)?;
        if let Some(motion) = state.mode(Role::Motion).only() {
            self.check_primary_plane(motion, state)?;
        }
        let Some(plane) = state.plane(self.model) else {
            return self.unknown_arc(counter_clockwise, target, state);
        };
        let ([first, second, _], [i, j, k]) = plane_axes(plane);
        let rules = &self.model.semantics().arcs;
        if self.words.has(k) && self.refuses_incomplete() && !rules.passes_over_across {
            return Err(Fault::Arc(ArcFault::WrongPlane(k)));
        }
        let turns = if rules.turns { self.count_turns()? } else { 1 };
        let direction = if counter_clockwise { ArcDirection::Ccw } else { ArcDirection::Cw };
        let start = state.position().xyz();
        let end = target.xyz();
        let has_centre = self.words.has(i) || self.words.has(j);
        let radius = self.length(Letter::of('R'), state);
        let tolerance = self.arc_tolerance(state);
        let arc = match (has_centre, radius) {
            (true, Some(_)) if !rules.radius_wins => return Err(Fault::Arc(ArcFault::CentreAndRadius)),
            (_, Some(radius)) => {
                if self.refuses_incomplete()
                    && !self.words.has(first.letter())
                    && !self.words.has(second.letter())
                    && !self.words.has(Letter::AT)
                    && !self.words.has(Letter::CARET)
                {
                    return Err(Fault::NoAxisWords);
                }
                Arc::by_radius(plane, start, end, Mm(radius), direction, turns, &tolerance)
            }
            (true, None) => {
                let centre = self.centre(state, [first, second], [i, j])?;
                Arc::by_centre(plane, start, end, centre, direction, turns, &tolerance)
            }
            (false, None) => return self.arc_without_centre(target, state),
        };
        let arc = arc.map_err(|error| Fault::Arc(arc_fault(&error)))?;
        if !arc.is_known() {
            return self.unknown_arc(counter_clockwise, target, state);
        }
        self.along_arc(&arc, turns, target, false, state)
    }

    /// A move along an arc that is known, from the programmed point.
    pub(super) fn along_arc(
        &mut self,
        arc: &Arc,
        turns: u32,
        target: &Position,
        expanded: bool,
        state: &mut State<D>,
    ) -> Step {
        let (plane, counter_clockwise) = (arc.plane(), arc.direction() == ArcDirection::Ccw);
        self.announce_inverse_time(|_| arc.length().0, state);
        let sign = if counter_clockwise { 1 } else { -1 };
        let turns = sign * i32::try_from(turns).unwrap_or(i32::MAX);
        if state.compensation.is_followed() {
            return self.compensated_arc(arc, *target, turns, state);
        }
        if !state.compensation.left.is_no() {
            self.leave_compensation(true, state)?;
        }
        if !state.compensation.on.is_no() || state.tool_shift.is_on() {
            return self.unknown_arc(counter_clockwise, target, state);
        }
        let mut to = self.axes_of(target, state);
        let (centre, turns) = self.arc_of_axes(plane, arc.centre(), turns, state);
        let sweep = if (turns > 0) == counter_clockwise { arc.sweep() } else { -arc.sweep() };
        if plane == Plane::Xy {
            to = state.mapping.turned_along(to, state.actual(), centre, sweep);
        }
        let event =
            ArcMove { plane, from: *state.actual(), programmed: *target, to, centre, turns, sweep, expanded };
        state.points.actual = to;
        state.points.position = *target;
        self.emit(state, Event::Arc(event));
        Ok(())
    }

    /// A straight move where a setting lets it be one; an analysis of all paths is told of it unless the setting was told.
    fn arc_without_centre(&mut self, target: &Position, state: &mut State<D>) -> Step {
        let fault = Err(Fault::Arc(ArcFault::NoCentre));
        if !self.is_straight_without_centre() {
            return fault;
        }
        self.travel(TravelKind::Feed, *target, false, state)?;
        let setting = self.model.semantics().arcs.straight_setting.as_deref();
        let is_told = setting.is_some_and(|number| self.machine.settings.contains_key(number));
        // A centre word of another plane is a mistake, whatever the setting makes of it.
        let has_other = ['I', 'J', 'K'].into_iter().any(|letter| self.words.has(Letter::of(letter)));
        if self.leaves_to_rules() && (!is_told || has_other) { fault } else { Ok(()) }
    }

    /// What the control makes of an arc without centre and radius.
    pub(super) fn is_straight_without_centre(&mut self) -> bool {
        let setting = self.model.semantics().arcs.straight_setting.as_deref();
        setting.is_some_and(|number| self.setting(number) != Some("alarm"))
    }

    /// The end of an arc whose shape is not known.
    fn unknown_arc(&mut self, counter_clockwise: bool, target: &Position, state: &mut State<D>) -> Step {
        if state.plane(self.model).is_none() {
            self.emit(state, Event::Unfollowed);
        }
        let plane = state.plane(self.model).unwrap_or(Plane::Xy);
        let mut to = self.axes_of(target, state);
        if self.may_run_beside(state) {
            to = self.beside(to, state);
            self.emit(state, Event::Unfollowed);
        }
        let turns = if counter_clockwise { 1 } else { -1 };
        let (_, turns) = self.arc_of_axes(plane, (Mm::UNKNOWN, Mm::UNKNOWN), turns, state);
        if state.transform.frame().is_unknown() {
            // A mirror turns it round.
            self.emit(state, Event::Unfollowed);
        }
        let event = ArcMove {
            plane,
            from: *state.actual(),
            programmed: *target,
            to,
            centre: (Mm::UNKNOWN, Mm::UNKNOWN),
            turns,
            sweep: f64::NAN,
            expanded: false,
        };
        state.points.actual = to;
        state.points.position = *target;
        self.emit(state, Event::Arc(event));
        Ok(())
    }

    /// The centre in the plane's axes, programmed coordinates.
    fn centre(&self, state: &State<D>, axes: [Axis; 2], letters: [Letter; 2]) -> Step<(Mm, Mm)> {
        let absolute = state.effect(Role::ArcCentre, self.model) == Some(Effect::ArcCentreAbsolute);
        let mut centre = [Mm(0.0); 2];
        for ((slot, axis), letter) in centre.iter_mut().zip(axes).zip(letters) {
            let from = state.position().raw(axis);
            *slot = Mm(match (self.length(letter, state), absolute) {
                // A radius where words of X are diameters, too (observed).
                (Some(value), true) => value,
                (Some(value), false) => from + value,
                (None, true) => return Err(Fault::MissingWord(letter)),
                (None, false) => from,
            });
        }
        let [first, second] = centre;
        Ok((first, second))
    }

    fn count_turns(&mut self) -> Step<u32> {
        match self.count(Letter::of('P')) {
            Ok(None) => Ok(1),
            Ok(Some(Count::Known(turns))) if turns >= 1 => Ok(turns),
            Ok(Some(Count::Known(0))) if self.model.semantics().arcs.zero_turns => Ok(1),
            // Whatever their number, they end where one ends.
            Ok(Some(Count::Unknown)) => self.refuse(Fault::Undecidable).map(|()| 1),
            _ => Err(Fault::Arc(ArcFault::Turns)),
        }
    }

    /// The control's tolerance. Its figures are whole numbers of the program's units, so inches have their own.
    pub(super) fn arc_tolerance(&self, state: &State<D>) -> ArcTolerance {
        let rules = &self.model.semantics().arcs;
        let scale = if state.units(self.model) == Some(Units::Inch) { rules.inch_factor } else { 1.0 };
        ArcTolerance {
            absolute: Mm(rules.radius_difference * scale),
            hard: Mm(rules.radius_difference * rules.hard_factor * scale),
            relative: rules.relative,
            radius_slack: Mm(rules.radius_slack),
            zero: Mm(rules.zero_radius),
            coincident: Mm(0.0),
        }
    }
}

pub(super) fn arc_fault(error: &ArcError) -> ArcFault {
    match error {
        ArcError::ZeroRadius => ArcFault::ZeroRadius,
        ArcError::RadiusTooSmall { half_chord, radius } => {
            ArcFault::RadiusTooSmall { half_chord: half_chord.0, radius: radius.0 }
        }
        ArcError::OffCircle { start_radius, end_radius } => {
            ArcFault::OffCircle { start: start_radius.0, end: end_radius.0 }
        }
        ArcError::EndIsStart => ArcFault::FullCircleByRadius,
    }
}
