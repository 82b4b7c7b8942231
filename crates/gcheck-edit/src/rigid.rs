//! Shifts, mirrors and quarter turns of points.
//!
//! Knows: points in millimetres. Must not know: programs, words.

use gcheck_engine::{Axis, Position, Units};
use gcheck_geometry::{Arc, Mm, Plane};

use crate::change::Change;

/// X, Y and Z.
pub(crate) const LINEAR: [Axis; 3] = [Axis::X, Axis::Y, Axis::Z];

/// A motion of space that takes main axes to main axes. Output axis `i` is `sign[i]` times the coordinate of the axis
/// `source[i]`, and `offset[i]` millimetres more.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Rigid {
    source: [usize; 3],
    sign: [f64; 3],
    offset: [f64; 3],
}

/// What becomes of the coordinates of one axis.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Turned {
    /// The axis that they are on then: 0 is X.
    pub(crate) axis: usize,
    pub(crate) sign: f64,
    /// Millimetres.
    pub(crate) offset: f64,
}

impl Rigid {
    /// The motion of a change of a program in these units; `None` for a change that moves nothing.
    pub(crate) fn of(change: &Change, units: Units, diameter: bool) -> Option<Self> {
        let mut rigid = Self { source: [0, 1, 2], sign: [1.0; 3], offset: [0.0; 3] };
        // A number for X counts a diameter where the program's do.
        let halved = |axis: usize, mm: f64| if axis == 0 && diameter { mm / 2.0 } else { mm };
        match change {
            Change::Translate(by) => {
                for (axis, (slot, amount)) in rigid.offset.iter_mut().zip(by).enumerate() {
                    *slot = halved(axis, amount.in_mm(units));
                }
            }
            Change::Mirror(axis, at) => {
                let axis = axis.index();
                *rigid.sign.get_mut(axis)? = -1.0;
                *rigid.offset.get_mut(axis)? = 2.0 * halved(axis, at.in_mm(units));
            }
            Change::Rotate(quarters, about) => {
                let [x, y] = about.map(|amount| amount.in_mm(units));
                match quarters % 4 {
                    1 => {
                        rigid.source = [1, 0, 2];
                        rigid.sign = [-1.0, 1.0, 1.0];
                        rigid.offset = [x + y, y - x, 0.0];
                    }
                    2 => {
                        rigid.sign = [-1.0, -1.0, 1.0];
                        rigid.offset = [2.0 * x, 2.0 * y, 0.0];
                    }
                    3 => {
                        rigid.source = [1, 0, 2];
                        rigid.sign = [1.0, -1.0, 1.0];
                        rigid.offset = [x - y, y + x, 0.0];
                    }
                    _ => {}
                }
            }
            _ => return None,
        }
        Some(rigid)
    }

    /// What becomes of the coordinates of an axis, 0 for X.
    pub(crate) fn turned(&self, axis: usize) -> Option<Turned> {
        let output = self.source.iter().position(|source| *source == axis)?;
        let (sign, offset) = (*self.sign.get(output)?, *self.offset.get(output)?);
        Some(Turned { axis: output, sign, offset })
    }

    /// Do coordinates of an axis stay what they are?
    pub(crate) fn keeps(&self, axis: usize) -> bool {
        self.turned(axis)
            .is_some_and(|turned| turned.axis == axis && turned.sign > 0.0 && turned.offset == 0.0)
    }

    /// Does an axis become another one?
    pub(crate) fn swaps(&self) -> bool {
        self.source != [0, 1, 2]
    }

    /// Is it a shift, which turns no direction?
    pub(crate) fn is_shift(&self) -> bool {
        !self.swaps() && self.sign.iter().all(|sign| *sign > 0.0)
    }

    /// A coordinate of output axis `axis` for a point.
    pub(crate) fn coordinate(&self, point: &Position, axis: usize) -> f64 {
        let of = |axis: usize| LINEAR.get(axis).map_or(f64::NAN, |axis| point.raw(*axis));
        match (self.source.get(axis), self.sign.get(axis), self.offset.get(axis)) {
            (Some(source), Some(sign), Some(offset)) => of(*source) * sign + offset,
            _ => f64::NAN,
        }
    }

    /// Does a circle in a plane turn the other way round after it? `None` when the plane becomes another one.
    pub(crate) fn flips(&self, plane: Plane) -> Option<bool> {
        let (first, second, _) = plane.axes();
        let (one, other) = (self.turned(first)?, self.turned(second)?);
        let is_same_plane = [one.axis, other.axis].iter().all(|axis| [first, second].contains(axis));
        let swapped = one.axis != first;
        is_same_plane.then_some((one.sign * other.sign < 0.0) != swapped)
    }

    /// An arc after it, between two points that are there already; `None` when its plane becomes another one.
    pub(crate) fn arc(&self, arc: &Arc, from: &Position, to: &Position) -> Option<Arc> {
        let flips = self.flips(arc.plane())?;
        let centre = Position::ZERO.with_xyz(arc.centre_xyz());
        let centre = [0, 1, 2].map(|axis| Mm(self.coordinate(&centre, axis)));
        let [first, second, _] = arc.plane().to_local(centre);
        let sweep = if flips { -arc.sweep() } else { arc.sweep() };
        Some(Arc::from_parts(arc.plane(), from.xyz(), to.xyz(), (first, second), sweep))
    }
}

#[cfg(test)]
mod tests {
    use gcheck_engine::{Axis, Position, Units};
    use gcheck_geometry::Plane;

    use super::Rigid;
    use crate::change::{Amount, Change};

    /// A point in thousandths.
    fn moved(change: &Change, point: [i32; 3]) -> [i32; 3] {
        let rigid = Rigid::of(change, Units::Mm, false).unwrap();
        let [x, y, z] = point.map(f64::from);
        let point = Position::new([x, y, z, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0]);
        whole([0, 1, 2].map(|axis| rigid.coordinate(&point, axis)))
    }

    fn whole(point: [f64; 3]) -> [i32; 3] {
        point.map(|value| (value * 1_000.0).round() as i32)
    }

    #[test]
    fn quarter_turns_are_counter_clockwise() {
        let about = [Amount::in_program(1.0), Amount::in_program(0.0)];
        assert_eq!(moved(&Change::Rotate(1, about), [2, 0, 5]), [1_000, 1_000, 5_000]);
        assert_eq!(moved(&Change::Rotate(2, about), [2, 0, 5]), [0, 0, 5_000]);
        assert_eq!(moved(&Change::Rotate(3, about), [2, 0, 5]), [1_000, -1_000, 5_000]);
    }

    #[test]
    fn a_mirror_turns_circles_round_where_it_is_seen() {
        let rigid = Rigid::of(&Change::Mirror(Axis::X, Amount::ZERO), Units::Mm, false).unwrap();
        assert_eq!(rigid.flips(Plane::Xy), Some(true));
        assert_eq!(rigid.flips(Plane::Zx), Some(true));
        assert_eq!(rigid.flips(Plane::Yz), Some(false));
        let rigid = Rigid::of(&Change::Rotate(1, [Amount::ZERO; 2]), Units::Mm, false).unwrap();
        assert_eq!(rigid.flips(Plane::Xy), Some(false));
        assert_eq!(rigid.flips(Plane::Zx), None);
        let rigid = Rigid::of(&Change::Rotate(2, [Amount::ZERO; 2]), Units::Mm, false).unwrap();
        assert_eq!((rigid.flips(Plane::Xy), rigid.flips(Plane::Zx)), (Some(false), Some(true)));
    }

    #[test]
    fn a_shift_along_x_of_a_lathe_is_a_diameter() {
        let by = [Amount::in_program(1.0), Amount::ZERO, Amount { number: 1.0, units: Some(Units::Mm) }];
        let rigid = Rigid::of(&Change::Translate(by), Units::Inch, true).unwrap();
        assert_eq!(whole([0, 1, 2].map(|axis| rigid.coordinate(&Position::ZERO, axis))), [12_700, 0, 1_000]);
    }
}
