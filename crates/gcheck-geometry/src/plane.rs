//! The three main planes in which arcs are turned and paths are offset.
//!
//! Knows which axes span a plane and which one is perpendicular to it. Must not know which code selects it.

/// A plane spanned by two linear axes.
///
/// First axis, second axis and normal form a right-handed system, so "counter-clockwise" is the turn from the first
/// axis to the second, seen with the normal pointing at the eye.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub enum Plane {
    /// X and Y, seen from +Z.
    #[default]
    Xy,
    /// Z and X, seen from +Y. The first axis is Z.
    Zx,
    /// Y and Z, seen from +X.
    Yz,
}

impl Plane {
    /// All planes.
    pub const ALL: [Self; 3] = [Self::Xy, Self::Zx, Self::Yz];

    /// Indexes of the first axis, the second axis and the normal; 0 is X, 1 is Y, 2 is Z.
    pub const fn axes(self) -> (usize, usize, usize) {
        match self {
            Self::Xy => (0, 1, 2),
            Self::Zx => (2, 0, 1),
            Self::Yz => (1, 2, 0),
        }
    }

    /// `[X, Y, Z]` as `[first, second, normal]`.
    pub const fn to_local<T: Copy>(self, point: [T; 3]) -> [T; 3] {
        let [x, y, z] = point;
        match self {
            Self::Xy => [x, y, z],
            Self::Zx => [z, x, y],
            Self::Yz => [y, z, x],
        }
    }

    /// `[first, second, normal]` as `[X, Y, Z]`; undoes [`to_local`](Self::to_local).
    pub const fn to_xyz<T: Copy>(self, local: [T; 3]) -> [T; 3] {
        let [first, second, normal] = local;
        match self {
            Self::Xy => [first, second, normal],
            Self::Zx => [second, normal, first],
            Self::Yz => [normal, first, second],
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn local_coordinates_are_the_axes_in_order() {
        let point = ['x', 'y', 'z'];
        for plane in Plane::ALL {
            let (first, second, normal) = plane.axes();
            assert_eq!(plane.to_local(point), [point[first], point[second], point[normal]]);
            assert_eq!(plane.to_xyz(plane.to_local(point)), point);
        }
        assert_eq!(Plane::Zx.to_local(point), ['z', 'x', 'y']);
        assert_eq!(Plane::Yz.to_local(point), ['y', 'z', 'x']);
    }

    #[test]
    fn every_plane_is_right_handed() {
        for plane in Plane::ALL {
            let (first, second, normal) = plane.axes();
            assert_eq!((first + 1) % 3, second);
            assert_eq!((second + 1) % 3, normal);
        }
    }
}
