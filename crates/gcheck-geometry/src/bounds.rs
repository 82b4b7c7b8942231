//! Axis-aligned boxes.
//!
//! Knows the smallest and the largest value seen on each axis. Must not know what the axes are called or which of
//! them turn: values are in millimetres on a linear axis and in degrees on a rotary one.

/// The number of axes that a box can have.
pub const MAX_AXES: usize = 9;

/// The range of every axis of the points that were put in, and on which axes an unknown value was among them.
///
/// An axis nobody put a value on has no range. Axis indexes of [`MAX_AXES`] and above are not kept.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Bounds {
    low: [f64; MAX_AXES],
    high: [f64; MAX_AXES],
    /// A bit per axis.
    unknown: u16,
}

impl Default for Bounds {
    fn default() -> Self {
        Self::EMPTY
    }
}

impl Bounds {
    /// A box without any point.
    pub const EMPTY: Self =
        Self { low: [f64::INFINITY; MAX_AXES], high: [f64::NEG_INFINITY; MAX_AXES], unknown: 0 };

    /// The smallest box around some points; axis n of a point is its element n.
    pub fn of<const N: usize>(points: impl IntoIterator<Item = [f64; N]>) -> Self {
        let mut bounds = Self::EMPTY;
        for point in points {
            bounds.include(&point);
        }
        bounds
    }

    /// Whether no axis has a known value; an axis may still have been given an unknown one.
    pub fn is_empty(&self) -> bool {
        (0..MAX_AXES).all(|axis| self.range(axis).is_none())
    }

    /// Widens the box to hold a point; axis n of the point is its element n, and a value that is not a number marks
    /// its axis as unknown.
    #[inline]
    pub fn include(&mut self, point: &[f64]) {
        for (axis, value) in point.iter().enumerate() {
            self.include_on(axis, *value);
        }
    }

    /// Widens one axis to hold a value; one that is not a number marks the axis as unknown.
    #[inline]
    pub fn include_on(&mut self, axis: usize, value: f64) {
        let (Some(low), Some(high)) = (self.low.get_mut(axis), self.high.get_mut(axis)) else { return };
        if value.is_nan() {
            self.unknown |= 1 << axis;
        } else {
            *low = low.min(value);
            *high = high.max(value);
        }
    }

    /// Says that an axis was somewhere nobody knows.
    pub fn include_unknown_on(&mut self, axis: usize) {
        self.include_on(axis, f64::NAN);
    }

    /// Widens the box to hold another one.
    pub fn include_bounds(&mut self, other: &Self) {
        *self = self.union(other);
    }

    /// The smallest box that holds both; unknown where either is.
    #[must_use]
    pub fn union(&self, other: &Self) -> Self {
        Self {
            low: std::array::from_fn(|axis| lesser(&self.low, &other.low, axis)),
            high: std::array::from_fn(|axis| greater(&self.high, &other.high, axis)),
            unknown: self.unknown | other.unknown,
        }
    }

    /// The smallest and the largest known value of an axis; nothing where there is none.
    pub fn range(&self, axis: usize) -> Option<(f64, f64)> {
        match (self.low.get(axis), self.high.get(axis)) {
            (Some(&low), Some(&high)) if low <= high => Some((low, high)),
            _ => None,
        }
    }

    /// The size of an axis' range; nothing where there is none.
    pub fn extent(&self, axis: usize) -> Option<f64> {
        self.range(axis).map(|(low, high)| high - low)
    }

    /// Whether an unknown value was put on the axis: the range is then a part of the truth.
    pub fn is_unknown(&self, axis: usize) -> bool {
        axis < MAX_AXES && self.unknown & (1 << axis) != 0
    }

    /// Whether an unknown value was put on any axis.
    pub fn has_unknown(&self) -> bool {
        self.unknown != 0
    }

    /// Whether a point lies in the box or on its edge; axes that the point does not have are not looked at.
    /// False for an unknown value.
    pub fn contains(&self, point: &[f64]) -> bool {
        point
            .iter()
            .enumerate()
            .all(|(axis, value)| self.range(axis).is_some_and(|(low, high)| low <= *value && *value <= high))
    }

    /// Whether all known values lie in `outer`, on every axis on which `outer` has a range.
    pub fn is_within(&self, outer: &Self) -> bool {
        (0..MAX_AXES).all(|axis| match (self.range(axis), outer.range(axis)) {
            (Some((low, high)), Some((from, to))) => from <= low && high <= to,
            _ => true,
        })
    }

    /// The box grown by `margin` on both sides of every axis that has a range. A negative margin may leave none.
    #[must_use]
    pub fn grown(&self, margin: f64) -> Self {
        Self {
            low: self.low.map(|low| low - margin),
            high: self.high.map(|high| high + margin),
            unknown: self.unknown,
        }
    }
}

fn lesser(one: &[f64; MAX_AXES], other: &[f64; MAX_AXES], axis: usize) -> f64 {
    one.get(axis).copied().unwrap_or(f64::INFINITY).min(other.get(axis).copied().unwrap_or(f64::INFINITY))
}

fn greater(one: &[f64; MAX_AXES], other: &[f64; MAX_AXES], axis: usize) -> f64 {
    let none = f64::NEG_INFINITY;
    one.get(axis).copied().unwrap_or(none).max(other.get(axis).copied().unwrap_or(none))
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    #[test]
    fn an_empty_box_has_no_range_and_holds_nothing() {
        assert!(Bounds::EMPTY.is_empty());
        assert_eq!(Bounds::EMPTY.range(0), None);
        assert_eq!(Bounds::EMPTY.extent(99), None);
        assert!(!Bounds::EMPTY.contains(&[0.0]));
    }

    #[test]
    fn a_box_around_two_points() {
        let bounds = Bounds::of([[1.0, -2.0, 0.0], [-1.0, 5.0, 0.0]]);
        assert_eq!(bounds.range(0), Some((-1.0, 1.0)));
        assert_eq!(bounds.range(1), Some((-2.0, 5.0)));
        assert_eq!(bounds.extent(1), Some(7.0));
        assert_eq!(bounds.extent(2), Some(0.0));
        assert_eq!(bounds.range(3), None);
        assert!(bounds.contains(&[0.0, 0.0]) && !bounds.contains(&[0.0, 6.0]));
    }

    #[test]
    fn an_unknown_value_marks_its_axis_and_keeps_the_range() {
        let mut bounds = Bounds::of([[1.0, 2.0]]);
        bounds.include(&[f64::NAN, 3.0]);
        bounds.include_unknown_on(5);
        assert_eq!(bounds.range(0), Some((1.0, 1.0)));
        assert!(
            bounds.is_unknown(0) && !bounds.is_unknown(1) && bounds.is_unknown(5) && bounds.has_unknown()
        );
        assert!(!bounds.is_unknown(40));
    }

    #[test]
    fn travel_is_compared_on_the_axes_it_names() {
        let travel = Bounds::of([[0.0, 0.0], [500.0, 400.0]]);
        assert!(Bounds::of([[10.0, 10.0, -900.0]]).is_within(&travel));
        assert!(!Bounds::of([[10.0, 400.5]]).is_within(&travel));
        assert!(Bounds::of([[10.0, 400.5]]).is_within(&travel.grown(1.0)));
        assert!(travel.grown(-300.0).range(1).is_none());
    }

    proptest! {
        #[test]
        fn a_union_holds_both_and_nothing_less(
            one in prop::collection::vec(prop::array::uniform3(-1e3..1e3_f64), 0..5),
            other in prop::collection::vec(prop::array::uniform3(-1e3..1e3_f64), 0..5),
        ) {
            let union = Bounds::of(one.clone()).union(&Bounds::of(other.clone()));
            prop_assert_eq!(union, Bounds::of(one.iter().chain(&other).copied()));
            for point in one.iter().chain(&other) {
                prop_assert!(union.contains(point));
            }
        }
    }
}
