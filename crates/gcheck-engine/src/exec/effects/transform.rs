//! Scaling, rotation and mirroring between programmed and work coordinates.
//!
//! Knows: what their codes and words switch, points on both sides. Must not know: moves, in which order they act.

use gcheck_controls::{Effect, Letter};
use gcheck_geometry::{Mm, Plane};

use super::tool_shift::shifted;
use crate::eval::value::Domain;
use crate::exec::arc::plane_axes;
use crate::exec::context::{Executor, Step};
use crate::lattice::{Lattice, Perhaps};
use crate::observer::Observer;
use crate::position::{Axis, Position};
use crate::state::State;

/// X, Y and Z, in the order of the arrays of [`Transform`].
const XYZ: [Axis; 3] = [Axis::X, Axis::Y, Axis::Z];

#[expect(clippy::unused_self, reason = "the parts of a step read as its methods")]
impl<D: Domain, O: Observer<D>> Executor<'_, '_, D, O> {
    /// `G50`, `G51`, `G68`, `G69`, mirrors.
    pub(in crate::exec) fn transform_code(&mut self, effect: Effect, state: &mut State<D>) -> Step {
        let unit = self.unit(state);
        let mut transform = state.transform;
        let words = self.words.clone();
        let word = |letter: char| words.number(Letter::of(letter));
        let position = *state.position();
        let centre = XYZ.map(|axis| word(axis.name()).map_or(position.raw(axis), |value| value * unit));
        match effect {
            Effect::ScalingOff => transform = transform.unscaled(),
            Effect::ScalingOn => {
                let factors = match word('P') {
                    Some(p) => [self.factor('P', p); 3],
                    None if "IJK".chars().any(|l| word(l).is_some()) => {
                        ['I', 'J', 'K'].map(|l| word(l).map_or(1.0, |value| self.factor(l, value)))
                    }
                    None => self.factors_of_settings(),
                };
                transform = transform.scaled(factors, centre);
            }
            Effect::RotationOff => transform = transform.unrotated(),
            Effect::RotationOn => {
                let plane = state.plane(self.model);
                // Double turrets mirror with the same code on lathes.
                let turns = plane.is_some() && state.is_diameter(self.model) != Some(true);
                let angle =
                    word('R').or_else(|| self.angle_of_setting()).filter(|_| turns).unwrap_or(f64::NAN);
                transform = transform.rotated(angle, centre, plane.unwrap_or(Plane::Xy));
            }
            Effect::MirrorOff => {
                let all = !self.names_axes("XYZ");
                for (mirror, axis) in transform.mirrors_mut().iter_mut().zip(XYZ) {
                    if all || self.words.has(axis.letter()) {
                        *mirror = Perhaps::No;
                    }
                }
            }
            Effect::MirrorOn => {
                for (mirror, axis) in transform.mirrors_mut().iter_mut().zip(XYZ) {
                    if let Some(value) = word(axis.name()) {
                        *mirror = Perhaps::Yes(value * unit);
                    }
                }
            }
            _ => {}
        }
        if state.compensation.is_followed() && !transform.same(&state.transform) {
            // How the path beside the programmed one goes over to the turned or scaled one is in no page.
            self.flush_compensation(state)?;
            state.compensation.lose_path();
        }
        state.transform = transform;
        let programmed = self.programmed_of(state.actual(), state);
        state.points.position = programmed;
        Ok(())
    }

    /// The factors of scaling without one in its block: a setting decides.
    fn factors_of_settings(&mut self) -> [f64; 3] {
        let settings = &self.model.semantics().transform_settings;
        let Some(number) = &settings.factor else { return [f64::NAN; 3] };
        let factor = self.number_of_setting(number);
        if factor != 0.0 {
            return [factor; 3];
        }
        let mut factors = [f64::NAN; 3];
        for (factor, number) in factors.iter_mut().zip(&settings.by_axis) {
            *factor = self.number_of_setting(number);
        }
        factors
    }

    /// The angle of rotation without one in its block.
    fn angle_of_setting(&mut self) -> Option<f64> {
        let number = self.model.semantics().transform_settings.angle.as_ref()?;
        Some(self.number_of_setting(number))
    }

    /// The number that a setting holds, NaN where it is not known.
    fn number_of_setting(&mut self, number: &str) -> f64 {
        self.setting(number).and_then(|value| value.parse().ok()).unwrap_or(f64::NAN)
    }

    /// A scaling factor: without a point it counts thousandths on controls that scale such numbers.
    fn factor(&self, letter: char, value: f64) -> f64 {
        if self.words.is_pointed(Letter::of(letter)) || self.refuses_incomplete() {
            value
        } else {
            value / 1000.0
        }
    }

    /// Where the axes go for a programmed point.
    pub(in crate::exec) fn axes_of(&self, programmed: &Position, state: &State<D>) -> Position {
        let to = state.mapping.turned(self.transformed(programmed, state), state.actual());
        if state.tool_shift.is_on() { shifted(to, self.tool_shift(programmed, state)) } else { to }
    }

    /// The programmed point scaled, turned and mirrored, as a tool without length and size goes to it.
    pub(in crate::exec) fn transformed(&self, programmed: &Position, state: &State<D>) -> Position {
        match state.transform.frame() {
            Perhaps::No => *programmed,
            Perhaps::Yes(frame) => programmed.with_xyz(frame.apply(programmed.xyz())),
            Perhaps::Unknown => programmed.with_xyz([Mm::UNKNOWN; 3]),
        }
    }

    /// The programmed point for where the axes stand.
    pub(in crate::exec) fn programmed_of(&self, actual: &Position, state: &State<D>) -> Position {
        let back = state.tool_shift.beside.map(|by| -by);
        let actual = &if state.tool_shift.is_on() { shifted(*actual, back) } else { *actual };
        match state.transform.frame() {
            Perhaps::No => *actual,
            Perhaps::Yes(frame) => match frame.inverse() {
                Some(inverse) => actual.with_xyz(inverse.apply(actual.xyz())),
                None => actual.with_xyz([Mm::UNKNOWN; 3]),
            },
            Perhaps::Unknown => actual.with_xyz([Mm::UNKNOWN; 3]),
        }
    }

    /// The centre and turns of an arc as the axes make it.
    pub(in crate::exec) fn arc_of_axes(
        &self,
        plane: Plane,
        centre: (Mm, Mm),
        turns: i32,
        state: &State<D>,
    ) -> ((Mm, Mm), i32) {
        let frame = match state.transform.frame() {
            Perhaps::No => return (centre, turns),
            Perhaps::Yes(frame) => frame,
            Perhaps::Unknown => return ((Mm::UNKNOWN, Mm::UNKNOWN), turns),
        };
        let ([first, second, _], _) = plane_axes(plane);
        let mut point = *state.position();
        point.set(first, centre.0.0);
        point.set(second, centre.1.0);
        let moved = point.with_xyz(frame.apply(point.xyz()));
        let turns = if frame.reverses_plane(plane) { -turns } else { turns };
        ((Mm(moved.raw(first)), Mm(moved.raw(second))), turns)
    }
}
