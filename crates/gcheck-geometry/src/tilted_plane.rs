//! A flat plane that lies tilted in the part, and the angles at which a tool is square to it.
//!
//! Knows: origin and directions of the plane, machines with two rotary axes. Must not know: how a program gives a plane, which
//! code swings the tool.

use std::f64::consts::{PI, TAU};

use nalgebra::Vector3;

use crate::frame::Frame;
use crate::kinematics::{Arrangement, Kinematics, RotaryAxis};
use crate::plane::Plane;
use crate::units::{Degrees, Mm};

/// A direction this near to an axis, by its length, lies along it.
const ALONG: f64 = 1e-9;

/// The plane that three turns make: about Z, about the new X, about the new Z.
pub fn by_euler_angles(origin: [Mm; 3], [first, second, third]: [Degrees; 3]) -> Frame {
    let about = |plane: Plane, angle: Degrees| *Frame::rotation(plane, (Mm::ZERO, Mm::ZERO), angle).linear();
    let turned = about(Plane::Xy, first) * about(Plane::Yz, second) * about(Plane::Xy, third);
    Frame::from_parts(turned, origin)
}

impl Kinematics {
    /// The angles of A, B and C at which the tool lies along a direction of the part, of length 1: two ways in general, each as
    /// near to `from` as whole turns allow. An axis that the machine does not have keeps its angle, and so does one about which
    /// the tool lies. Empty where no angles do it.
    pub fn square_to(&self, direction: Vector3<f64>, from: [Degrees; 3]) -> Vec<[Degrees; 3]> {
        let ([first, second], [first_sign, second_sign]) = (self.order, self.sign);
        let lines = [(first, self.inclined[0]), (second, self.inclined[1])]
            .map(|(axis, line)| line.unwrap_or_else(|| axis.into()).vector());
        // The direction is that of Z, turned about `inner` and then about `outer`; turning the part is turning the tool back.
        let (head_first, head_second) = ((first, first_sign, lines[0]), (second, second_sign, lines[1]));
        let (table_first, table_second) = ((first, -first_sign, lines[0]), (second, -second_sign, lines[1]));
        let ((outer, outer_sign, about_outer), (inner, inner_sign, about_inner)) = match self.arrangement {
            Arrangement::HeadHead => (head_first, head_second),
            Arrangement::TableTable => (table_second, table_first),
            Arrangement::HeadTable => (table_second, head_first),
        };
        let tilts = tilts(&about_inner, &about_outer, direction.dot(&about_outer));
        let mut all = Vec::new();
        for tilt in tilts {
            let tilted = turned(&about_inner, tilt);
            let flat = |vector: Vector3<f64>| vector - about_outer * vector.dot(&about_outer);
            let (start, end) = (flat(tilted), flat(direction));
            let mut angles = from;
            put(&mut angles, inner, tilt.to_degrees() * inner_sign);
            if start.norm() > ALONG && end.norm() > ALONG {
                let swing = about_outer.dot(&start.cross(&end)).atan2(start.dot(&end));
                put(&mut angles, outer, swing.to_degrees() * outer_sign);
            }
            if (self.tool_axis_in_part(angles) - direction).norm() < 1e-6 {
                all.push(angles);
            }
        }
        all
    }
}

/// The angles, in radians, by which Z is turned about `inner` so that its part along `outer` is `along`: of two the smaller
/// first. One where the turn changes nothing of it.
fn tilts(inner: &Vector3<f64>, outer: &Vector3<f64>, along: f64) -> Vec<f64> {
    let z = Vector3::z();
    // What a turn leaves of Z along `outer`, what of it goes with the cosine of the angle, and what with the sine.
    let still = z.dot(inner) * inner.dot(outer);
    let (with_cos, with_sin) = (z.dot(outer) - still, inner.cross(&z).dot(outer));
    let most = with_cos.hypot(with_sin);
    if most < ALONG {
        return vec![0.0];
    }
    let (middle, away) = (with_sin.atan2(with_cos), ((along - still) / most).clamp(-1.0, 1.0).acos());
    let within = |angle: f64| {
        if angle > PI {
            angle - TAU
        } else if angle <= -PI {
            angle + TAU
        } else {
            angle
        }
    };
    let (one, other) = (within(middle + away), within(middle - away));
    if (one - other).abs() < 1e-12 {
        vec![one]
    } else if other.abs() < one.abs() - 1e-12 {
        vec![other, one]
    } else {
        vec![one, other]
    }
}

/// Z, turned about a line by an angle in radians.
fn turned(about: &Vector3<f64>, angle: f64) -> Vector3<f64> {
    let ((sin, cos), z) = (angle.sin_cos(), Vector3::z());
    z * cos + about.cross(&z) * sin + about * (about.dot(&z) * (1.0 - cos))
}

/// Puts the angle of an axis as near to the one before as whole turns allow.
fn put(angles: &mut [Degrees; 3], axis: RotaryAxis, angle: f64) {
    if let Some(slot) = angles.get_mut(axis.index()) {
        let before = if slot.0.is_nan() { Degrees(0.0) } else { *slot };
        *slot = Degrees(angle).nearest_to(before);
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::kinematics::Direction;

    #[test]
    fn three_turns_lay_the_plane() {
        let frame =
            by_euler_angles([Mm(10.0), Mm(0.0), Mm(0.0)], [Degrees(90.0), Degrees(90.0), Degrees(0.0)]);
        let near = |point: [Mm; 3], other: [f64; 3]| {
            point.iter().zip(other).all(|(a, b)| a.is_near(Mm(b), Mm(1e-9)))
        };
        // Z of the plane: Z turned about X by a right angle points to -Y, and about Z on to X.
        assert!(near(frame.apply([Mm(0.0), Mm(0.0), Mm(5.0)]), [15.0, 0.0, 0.0]));
        assert!(near(frame.apply([Mm(5.0), Mm(0.0), Mm(0.0)]), [10.0, 5.0, 0.0]));
    }

    #[test]
    fn a_trunnion_turns_the_face_up() {
        let machine = Kinematics {
            arrangement: Arrangement::TableTable,
            order: [RotaryAxis::A, RotaryAxis::C],
            sign: [1.0; 2],
            inclined: [None; 2],
            pivot_length: None,
            offset: [Mm::ZERO; 3],
        };
        // A face that looks along X is turned by C to look along Y, and by A up; or the other way round.
        let ways = machine.square_to(Vector3::x(), [Degrees(0.0); 3]);
        let shown: Vec<[f64; 3]> = ways.iter().map(|angles| angles.map(|angle| angle.0.round())).collect();
        assert_eq!(shown, [[-90.0, 0.0, -90.0], [90.0, 0.0, 90.0]]);
    }

    proptest! {
        #[test]
        fn a_tool_is_square_at_the_angles_found(
            at in prop::array::uniform3(-170.0..170.0_f64), first in 0..3_usize, step in 1..3_usize,
            arrangement in prop::sample::select(vec![Arrangement::HeadHead, Arrangement::TableTable, Arrangement::HeadTable]),
            signs in prop::array::uniform2(prop::sample::select(vec![1.0, -1.0])),
            lines in prop::array::uniform2(prop::option::of(prop::array::uniform3(-1.0..1.0_f64))),
        ) {
            let axes = [RotaryAxis::A, RotaryAxis::B, RotaryAxis::C];
            let order = [axes[first], axes[(first + step) % 3]];
            let machine = Kinematics {
                arrangement,
                order,
                sign: signs,
                inclined: lines.map(|line| line.and_then(Direction::of)),
                pivot_length: None,
                offset: [Mm::ZERO; 3],
            };
            let direction = machine.tool_axis_in_part(at.map(Degrees));
            let ways = machine.square_to(direction, [Degrees(0.0); 3]);
            prop_assert!(!ways.is_empty(), "{machine:?} {at:?}");
            for way in ways {
                prop_assert!((machine.tool_axis_in_part(way) - direction).norm() < 1e-6);
            }
        }
    }
}
