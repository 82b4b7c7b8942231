//! Scaling, rotation and mirroring between programmed and work coordinates.
//!
//! Knows: the order of the transformations and their inverse. Must not know: moves.

use gcheck_controls::{Effect, Letter};
use gcheck_geometry::{Degrees, Frame, Mm, Plane};

use super::arc::plane_axes;
use super::tool_shift::shifted;
use super::{Executor, Step};
use crate::observer::Observer;
use crate::position::{Axis, Position};
use crate::state::{State, Transform};
use crate::value::Domain;

/// X, Y and Z, in the order of the arrays of [`Transform`].
const XYZ: [Axis; 3] = [Axis::X, Axis::Y, Axis::Z];

#[expect(clippy::unnecessary_wraps, reason = "handlers of effects share one signature")]
#[expect(clippy::unused_self, reason = "the parts of a step read as its methods")]
impl<D: Domain, O: Observer<D>> Executor<'_, '_, D, O> {
    /// `G50`, `G51`, `G68`, `G69`, mirrors.
    pub(super) fn transform_code(&mut self, effect: Effect, state: &mut State<D>) -> Step {
        let unit = self.unit(state);
        let mut transform = state.transform;
        let word = |letter: char| self.words.number(Letter::of(letter));
        let position = state.position;
        let centre = XYZ.map(|axis| word(axis.name()).map_or(position.raw(axis), |value| value * unit));
        match effect {
            Effect::ScalingOff => transform.scale = [1.0; 3],
            Effect::ScalingOn => {
                transform.scale_centre = centre;
                transform.scale = match word('P') {
                    Some(p) => [self.factor('P', p); 3],
                    None if "IJK".chars().any(|l| word(l).is_some()) => {
                        ['I', 'J', 'K'].map(|l| word(l).map_or(1.0, |value| self.factor(l, value)))
                    }
                    // A setting decides.
                    None => [f64::NAN; 3],
                };
            }
            Effect::RotationOff => transform.angle = 0.0,
            Effect::RotationOn => {
                let plane = state.plane(self.model);
                transform.plane = plane.unwrap_or(Plane::Xy);
                transform.centre = centre;
                transform.angle = word('R').filter(|_| plane.is_some()).unwrap_or(f64::NAN);
                if state.is_diameter(self.model) == Some(true) {
                    // Double turrets mirror with the same code on lathes.
                    transform.angle = f64::NAN;
                }
            }
            Effect::MirrorOff => {
                let all = !self.names_axes("XYZ");
                for (slot, axis) in transform.mirror.iter_mut().zip(XYZ) {
                    *slot &= !all && !self.words.has(axis.letter());
                }
            }
            Effect::MirrorOn => {
                for ((slot, at), axis) in transform.mirror.iter_mut().zip(&mut transform.mirror_at).zip(XYZ) {
                    if let Some(value) = word(axis.name()) {
                        *slot = true;
                        *at = value * unit;
                    }
                }
            }
            _ => {}
        }
        state.transform = transform;
        state.position = self.programmed_of(&state.actual, state);
        Ok(())
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
    pub(super) fn axes_of(&self, programmed: &Position, state: &State<D>) -> Position {
        let to = state.wrapped.turned(self.transformed(programmed, state));
        if state.tool_shift.is_on() { shifted(to, self.tool_shift(programmed, state)) } else { to }
    }

    /// The programmed point scaled, turned and mirrored, as a tool without length and size goes to it.
    pub(super) fn transformed(&self, programmed: &Position, state: &State<D>) -> Position {
        match frame(&state.transform) {
            None => *programmed,
            Some(Some(frame)) => programmed.with_xyz(frame.apply(programmed.xyz())),
            Some(None) => programmed.with_xyz([Mm::UNKNOWN; 3]),
        }
    }

    /// The programmed point for where the axes stand.
    pub(super) fn programmed_of(&self, actual: &Position, state: &State<D>) -> Position {
        let back = state.tool_shift.beside.map(|by| -by);
        let actual = &if state.tool_shift.is_on() { shifted(*actual, back) } else { *actual };
        match frame(&state.transform) {
            None => *actual,
            Some(frame) => match frame.and_then(|f| f.inverse()) {
                Some(inverse) => actual.with_xyz(inverse.apply(actual.xyz())),
                None => actual.with_xyz([Mm::UNKNOWN; 3]),
            },
        }
    }

    /// The centre and turns of an arc as the axes make it.
    pub(super) fn arc_of_axes(
        &self,
        plane: Plane,
        centre: (Mm, Mm),
        turns: i32,
        state: &State<D>,
    ) -> ((Mm, Mm), i32) {
        let Some(frame) = frame(&state.transform) else { return (centre, turns) };
        let Some(frame) = frame else { return ((Mm::UNKNOWN, Mm::UNKNOWN), turns) };
        let ([first, second, _], _) = plane_axes(plane);
        let mut point = state.position;
        point.set(first, centre.0.0);
        point.set(second, centre.1.0);
        let moved = point.with_xyz(frame.apply(point.xyz()));
        let turns = if frame.reverses_plane(plane) { -turns } else { turns };
        ((Mm(moved.raw(first)), Mm(moved.raw(second))), turns)
    }
}

/// The transformation; `None` when there is none, `Some(None)` when it is not known.
#[expect(
    clippy::option_option,
    reason = "no transformation, an unknown one and a known one are three things"
)]
#[expect(clippy::float_cmp, reason = "off is exactly zero and exactly one")]
fn frame(transform: &Transform) -> Option<Option<Frame>> {
    if transform.is_off() {
        return None;
    }
    let numbers = transform.scale.iter().chain([&transform.angle]);
    if numbers.into_iter().any(|n| n.is_nan()) {
        return Some(None);
    }
    let mut frame = Frame::identity();
    if transform.scale != [1.0; 3] {
        frame = frame.then(&Frame::scaling(transform.scale_centre.map(Mm), transform.scale));
    }
    if transform.angle != 0.0 {
        let (first, second, _) = transform.plane.axes();
        let at = |index: usize| Mm(transform.centre.get(index).copied().unwrap_or(f64::NAN));
        frame =
            frame.then(&Frame::rotation(transform.plane, (at(first), at(second)), Degrees(transform.angle)));
    }
    if transform.mirror != [false; 3] {
        frame = frame.then(&Frame::mirror(transform.mirror_at.map(Mm), transform.mirror));
    }
    Some(Some(frame))
}
