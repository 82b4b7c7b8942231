//! Machines with two rotary axes: where the tool points, and where the part turns.
//!
//! Knows three arrangements of two rotary axes, along linear axes or inclined. Must not know which code compensates for a
//! tilted tool.
//!
//! All directions are in the machine's linear axes. At zero angles the tool points along +Z, from its tip to the
//! spindle, and the part lies as it was clamped.

use nalgebra::{Matrix3, UnitVector3, Vector3};

use crate::frame::Frame;
use crate::plane::Plane;
use crate::units::{Degrees, Mm};

/// A rotary axis by the linear axis it turns about.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum RotaryAxis {
    /// Turns about X, from Y towards Z.
    A,
    /// Turns about Y, from Z towards X.
    B,
    /// Turns about Z, from X towards Y.
    C,
}

impl RotaryAxis {
    /// The index of the axis among A, B, C.
    pub const fn index(self) -> usize {
        match self {
            Self::A => 0,
            Self::B => 1,
            Self::C => 2,
        }
    }

    /// The plane in which it turns; its linear axis is the normal.
    pub const fn plane(self) -> Plane {
        match self {
            Self::A => Plane::Yz,
            Self::B => Plane::Zx,
            Self::C => Plane::Xy,
        }
    }
}

/// The direction of a line, of length 1.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Direction(UnitVector3<f64>);

impl Direction {
    /// Shorter vectors have no direction to speak of.
    const SHORTEST: f64 = 1e-6;

    /// The direction of a vector of any length, by its parts along X, Y and Z; none of a vector of no length, or of one that
    /// is not finite.
    pub fn of(parts: [f64; 3]) -> Option<Self> {
        let vector = Vector3::from(parts);
        vector.iter().all(|part| part.is_finite()).then_some(())?;
        // Divided by its largest part first, so that the squares of very long ones are finite.
        let largest = vector.amax();
        (largest >= Self::SHORTEST).then(|| Self(UnitVector3::new_normalize(vector / largest)))
    }

    /// Do both lie along one line, either way?
    pub fn is_parallel_to(self, other: Self) -> bool {
        self.0.cross(&other.0).norm() < 1e-6
    }

    pub(crate) fn vector(self) -> Vector3<f64> {
        self.0.into_inner()
    }
}

impl From<RotaryAxis> for Direction {
    fn from(axis: RotaryAxis) -> Self {
        Self(match axis {
            RotaryAxis::A => Vector3::x_axis(),
            RotaryAxis::B => Vector3::y_axis(),
            RotaryAxis::C => Vector3::z_axis(),
        })
    }
}

/// Who carries the two rotary axes.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Arrangement {
    /// Both turn the tool.
    HeadHead,
    /// Both turn the part.
    TableTable,
    /// The first turns the tool, the second turns the part.
    HeadTable,
}

/// The rotary axes of a machine.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Kinematics {
    /// Who carries the axes.
    pub arrangement: Arrangement,
    /// The axes. Where both turn the same side, the first is fixed to the machine and carries the second;
    /// for [`Arrangement::HeadTable`] the first is the head's and the second the table's.
    pub order: [RotaryAxis; 2],
    /// +1 where a positive angle turns as [`RotaryAxis`] says, -1 where it turns the other way, in the order of `order`.
    /// A table that follows the convention "axes move as if the tool moved" has -1.
    pub sign: [f64; 2],
    /// The line that each axis turns about, in the order of `order` and at zero angles, counter-clockwise seen against its
    /// direction; none for the linear axis of its name.
    pub inclined: [Option<Direction>; 2],
    /// From the point about which the head tilts to the gauge line of the spindle; none where it is not known.
    pub pivot_length: Option<Mm>,
    /// Where both turn the same side: from a point on the first axis to a point on the second, at zero angles. Zero where
    /// the axes meet. A tilting head is measured from the second axis, a table turns about a point of the first.
    pub offset: [Mm; 3],
}

impl Kinematics {
    /// The direction, of length 1, from the tip of the tool to the spindle, in the axes of the machine.
    /// `angles` are the positions of A, B and C; those the machine does not have are not looked at.
    pub fn tool_axis(&self, angles: [Degrees; 3]) -> Vector3<f64> {
        self.head_rotation(angles).column(2).into_owned()
    }

    /// The same direction seen from the part, which may be turned itself.
    pub fn tool_axis_in_part(&self, angles: [Degrees; 3]) -> Vector3<f64> {
        self.part_rotation(angles).transpose() * self.tool_axis(angles)
    }

    /// The point `length` behind `point` along the tool: from the tip to the gauge line for the tool's length.
    #[must_use]
    pub fn offset_along_tool(&self, point: [Mm; 3], length: Mm, angles: [Degrees; 3]) -> [Mm; 3] {
        let axis: [f64; 3] = self.tool_axis(angles).into();
        let [x, y, z] = point;
        let [along_x, along_y, along_z] = axis.map(|part| component(part, length));
        [x + along_x, y + along_y, z + along_z]
    }

    /// Where the linear axes must be so that the tip of a tool of `length` is at `tip`.
    ///
    /// Machine positions are counted for the gauge line at zero angles, and tilting turns it about the pivot.
    /// None where the head tilts and the pivot length is not known.
    #[must_use]
    pub fn axes_for_tip(&self, tip: [Mm; 3], length: Mm, angles: [Degrees; 3]) -> Option<[Mm; 3]> {
        let pivot = match (self.pivot_length, self.arrangement) {
            (Some(pivot), _) => pivot,
            (None, Arrangement::TableTable) => Mm::ZERO,
            (None, _) => return None,
        };
        let [x, y, z] = self.offset_along_tool(tip, length + pivot, angles);
        let [dx, dy, dz] = self.head_shift(angles);
        Some([x + dx, y + dy, z + dz - pivot])
    }

    /// Where the tip of a tool of `length` is while the linear axes are at `axes`;
    /// undoes [`axes_for_tip`](Self::axes_for_tip), and is none where that is.
    #[must_use]
    pub fn tip_for_axes(&self, axes: [Mm; 3], length: Mm, angles: [Degrees; 3]) -> Option<[Mm; 3]> {
        let origin = self.axes_for_tip([Mm::ZERO; 3], length, angles)?;
        let ([x, y, z], [from_x, from_y, from_z]) = (axes, origin);
        Some([x - from_x, y - from_y, z - from_z])
    }

    /// How the head has turned the tool: column 2 is the tool's axis.
    pub fn head_rotation(&self, angles: [Degrees; 3]) -> Matrix3<f64> {
        match self.arrangement {
            Arrangement::HeadHead => self.both(angles),
            Arrangement::TableTable => Matrix3::identity(),
            Arrangement::HeadTable => self.first(angles),
        }
    }

    /// How the table has turned the part.
    pub fn part_rotation(&self, angles: [Degrees; 3]) -> Matrix3<f64> {
        match self.arrangement {
            Arrangement::HeadHead => Matrix3::identity(),
            Arrangement::TableTable => self.both(angles),
            Arrangement::HeadTable => self.second(angles),
        }
    }

    /// Where the points of the part are once the table has turned about `centre` (X, Y, Z of a point that the table's axis
    /// passes through; of two axes, the first).
    #[must_use]
    pub fn part_frame(&self, centre: [Mm; 3], angles: [Degrees; 3]) -> Frame {
        if self.arrangement != Arrangement::TableTable || self.axes_meet() {
            return Frame::about(self.part_rotation(angles), centre);
        }
        let ([x, y, z], [dx, dy, dz]) = (centre, self.offset);
        Frame::about(self.second(angles), [x + dx, y + dy, z + dz])
            .then(&Frame::about(self.first(angles), centre))
    }

    /// What the second axis of a head moves by when the first one carries it round, with the sign of the linear axes that
    /// make up for it.
    fn head_shift(&self, angles: [Degrees; 3]) -> [Mm; 3] {
        if self.arrangement != Arrangement::HeadHead || self.axes_meet() {
            return [Mm::ZERO; 3];
        }
        let offset = Vector3::from(self.offset.map(|part| part.0));
        let shift: [f64; 3] = (offset - self.first(angles) * offset).into();
        shift.map(Mm)
    }

    fn axes_meet(&self) -> bool {
        self.offset.iter().all(|part| part.0.abs() <= 0.0)
    }

    fn both(&self, angles: [Degrees; 3]) -> Matrix3<f64> {
        self.first(angles) * self.second(angles)
    }

    fn first(&self, angles: [Degrees; 3]) -> Matrix3<f64> {
        let ([axis, _], [sign, _], [line, _]) = (self.order, self.sign, self.inclined);
        rotation(axis, line, sign, angles)
    }

    fn second(&self, angles: [Degrees; 3]) -> Matrix3<f64> {
        let ([_, axis], [_, sign], [_, line]) = (self.order, self.sign, self.inclined);
        rotation(axis, line, sign, angles)
    }
}

fn rotation(axis: RotaryAxis, line: Option<Direction>, sign: f64, angles: [Degrees; 3]) -> Matrix3<f64> {
    let angle = angles.get(axis.index()).copied().unwrap_or(Degrees::UNKNOWN) * sign;
    match line {
        None => *Frame::rotation(axis.plane(), (Mm::ZERO, Mm::ZERO), angle).linear(),
        Some(line) => turned_about(line, angle),
    }
}

/// A turn about a line: what lies along it stays, what is square to it turns.
pub(crate) fn turned_about(line: Direction, angle: Degrees) -> Matrix3<f64> {
    let (sin, cos) = angle.sin_cos();
    let line = line.vector();
    Matrix3::identity() * cos + line.cross_matrix() * sin + line * line.transpose() * (1.0 - cos)
}

/// A part of a length; of an unknown length along an axis the tool does not lean to it is nothing.
fn component(part: f64, length: Mm) -> Mm {
    if part.abs() <= 0.0 { Mm::ZERO } else { length * part }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    const ORIGIN: [Mm; 3] = [Mm(0.0); 3];

    fn machine(arrangement: Arrangement, order: [RotaryAxis; 2]) -> Kinematics {
        Kinematics {
            arrangement,
            order,
            sign: [1.0, 1.0],
            inclined: [None; 2],
            pivot_length: None,
            offset: ORIGIN,
        }
    }

    fn angles(a: f64, b: f64, c: f64) -> [Degrees; 3] {
        [Degrees(a), Degrees(b), Degrees(c)]
    }

    fn inches(point: [Mm; 3]) -> String {
        let [x, y, z] = point.map(Mm::inch);
        format!("{x:.4} {y:.4} {z:.4}")
    }

    #[test]
    fn an_upright_tool_is_offset_in_z_only() {
        for arrangement in [Arrangement::HeadHead, Arrangement::TableTable, Arrangement::HeadTable] {
            let machine = machine(arrangement, [RotaryAxis::B, RotaryAxis::A]);
            assert_eq!(
                machine.offset_along_tool(ORIGIN, Mm(100.0), angles(0.0, 0.0, 0.0)),
                [Mm(0.0), Mm(0.0), Mm(100.0)]
            );
        }
    }

    /// A leans the tool by (0, -sin, cos) * length, B carries it over: x = sin b cos a, y = -sin a, z = cos b cos a.
    #[test]
    fn a_tool_of_4_inches_leaning_20_degrees_twice_with_b_carrying_a() {
        let machine = machine(Arrangement::HeadHead, [RotaryAxis::B, RotaryAxis::A]);
        let gauge = machine.offset_along_tool(ORIGIN, Mm::from_inch(4.0), angles(-20.0, -20.0, 0.0));
        assert_eq!(inches(gauge), "-1.2856 1.3681 3.5321");
    }

    /// The other way round: x = sin b, y = -sin a cos b, z = cos a cos b.
    #[test]
    fn a_tool_of_4_inches_leaning_20_degrees_twice_with_a_carrying_b() {
        let machine = machine(Arrangement::HeadHead, [RotaryAxis::A, RotaryAxis::B]);
        let gauge = machine.offset_along_tool(ORIGIN, Mm::from_inch(4.0), angles(-20.0, -20.0, 0.0));
        assert_eq!(inches(gauge), "-1.3681 1.2856 3.5321");
    }

    #[test]
    fn each_axis_turns_about_its_linear_axis() {
        let ninety = |first, second, at| machine(Arrangement::HeadHead, [first, second]).tool_axis(at);
        let (a, b, c) = (RotaryAxis::A, RotaryAxis::B, RotaryAxis::C);
        assert_eq!(ninety(a, b, angles(90.0, 0.0, 0.0)), Vector3::new(0.0, -1.0, 0.0));
        assert_eq!(ninety(a, b, angles(0.0, 90.0, 0.0)), Vector3::new(1.0, 0.0, 0.0));
        assert_eq!(ninety(c, b, angles(0.0, 90.0, 90.0)), Vector3::new(0.0, 1.0, 0.0));
        // An axis the machine does not have is not looked at.
        assert_eq!(ninety(a, b, angles(0.0, 0.0, f64::NAN)), Vector3::new(0.0, 0.0, 1.0));
    }

    #[test]
    fn a_turned_sign_turns_the_other_way() {
        let mut machine = machine(Arrangement::HeadHead, [RotaryAxis::B, RotaryAxis::A]);
        machine.sign = [-1.0, 1.0];
        assert_eq!(machine.tool_axis(angles(0.0, 90.0, 0.0)), Vector3::new(-1.0, 0.0, 0.0));
    }

    #[test]
    fn a_table_turns_the_part_and_leaves_the_tool() {
        let machine = machine(Arrangement::TableTable, [RotaryAxis::A, RotaryAxis::C]);
        let at = angles(90.0, 0.0, 90.0);
        assert_eq!(machine.tool_axis(at), Vector3::new(0.0, 0.0, 1.0));
        // C takes the part's X to Y, and A takes that on to Z.
        let frame = machine.part_frame([Mm(0.0), Mm(0.0), Mm(-50.0)], at);
        assert_eq!(frame.apply([Mm(10.0), Mm(0.0), Mm(-50.0)]), [Mm(0.0), Mm(0.0), Mm(-40.0)]);
        // So the tool, along the machine's Z, lies along the part's X.
        assert_eq!(machine.tool_axis_in_part(at), Vector3::new(1.0, 0.0, 0.0));
    }

    #[test]
    fn a_head_leans_over_a_part_that_its_table_turns() {
        let machine = machine(Arrangement::HeadTable, [RotaryAxis::B, RotaryAxis::C]);
        let at = angles(0.0, 90.0, 90.0);
        assert_eq!(machine.tool_axis(at), Vector3::new(1.0, 0.0, 0.0));
        assert_eq!(machine.tool_axis_in_part(at), Vector3::new(0.0, -1.0, 0.0));
    }

    #[test]
    fn a_tilting_head_needs_its_pivot_to_place_the_axes() {
        let mut machine = machine(Arrangement::HeadHead, [RotaryAxis::C, RotaryAxis::B]);
        let lying = angles(0.0, 90.0, 0.0);
        assert_eq!(machine.axes_for_tip(ORIGIN, Mm(100.0), lying), None);
        machine.pivot_length = Some(Mm(200.0));
        // The gauge line lies 100 beside the tip, the pivot 300 beside it and, as the axes count, 200 higher.
        assert_eq!(machine.axes_for_tip(ORIGIN, Mm(100.0), lying), Some([Mm(300.0), Mm(0.0), Mm(-200.0)]));
        assert_eq!(
            machine.axes_for_tip(ORIGIN, Mm(100.0), angles(0.0, 0.0, 0.0)),
            Some([Mm(0.0), Mm(0.0), Mm(100.0)])
        );
    }

    #[test]
    fn an_unknown_length_of_an_upright_tool_spoils_z_only() {
        let machine = machine(Arrangement::HeadHead, [RotaryAxis::B, RotaryAxis::A]);
        let point = machine.offset_along_tool(ORIGIN, Mm::UNKNOWN, angles(0.0, 0.0, 0.0));
        assert_eq!(point.map(Mm::is_known), [true, true, false]);
        let leaning = machine.offset_along_tool(ORIGIN, Mm(1.0), angles(f64::NAN, 0.0, 0.0));
        assert!(!leaning[2].is_known());
    }

    proptest! {
        #[test]
        fn the_tool_keeps_its_length_and_the_way_back_leads_back(
            at in prop::array::uniform3(-720.0..720.0_f64), tip in prop::array::uniform3(-500.0..500.0_f64),
            length in 1.0..300.0_f64, pivot in 0.0..500.0_f64,
            first in 0..3_usize, step in 1..3_usize,
            arrangement in prop::sample::select(vec![Arrangement::HeadHead, Arrangement::TableTable, Arrangement::HeadTable]),
        ) {
            let axes = [RotaryAxis::A, RotaryAxis::B, RotaryAxis::C];
            let mut machine = machine(arrangement, [axes[first], axes[(first + step) % 3]]);
            machine.pivot_length = Some(Mm(pivot));
            let (at, tip) = (at.map(Degrees), tip.map(Mm));
            prop_assert!((machine.tool_axis(at).norm() - 1.0).abs() < 1e-12);
            prop_assert!((machine.tool_axis_in_part(at).norm() - 1.0).abs() < 1e-12);
            let gauge = machine.offset_along_tool(tip, Mm(length), at);
            let distance = gauge.iter().zip(tip).map(|(a, b)| (a.0 - b.0).powi(2)).sum::<f64>().sqrt();
            prop_assert!((distance - length).abs() < 1e-9);
            let there = machine.axes_for_tip(tip, Mm(length), at).unwrap();
            let back = machine.tip_for_axes(there, Mm(length), at).unwrap();
            prop_assert!(back.iter().zip(tip).all(|(a, b)| a.is_near(b, Mm(1e-9))));
        }
    }
}
