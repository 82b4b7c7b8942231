//! Transformations between programmed and work coordinates: scaling, rotation, mirrors.
//!
//! Knows: which are on, with what they were given, as one frame. Must not know: codes, words, moves.

use gcheck_geometry::{Degrees, Frame, Mm, Plane};

use crate::lattice::{Joinable, Lattice, Perhaps, lattice, merged};
use crate::position::Axis;

lattice! {
    /// Transformations between programmed and work coordinates, in the order in which they act. Off by default.
    #[derive(Debug, Clone, Copy)]
    pub struct Transform {
        scaling: Perhaps<Scaling>,
        rotation: Perhaps<Rotation>,
        /// By axis X, Y, Z: where its mirror is (NaN unknown).
        mirrors: [Perhaps<f64>; 3],
    }
}

/// A scaling.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Scaling {
    factors: [f64; 3],
    centre: [f64; 3],
}

/// A rotation in a plane.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Rotation {
    /// Degrees.
    angle: f64,
    centre: [f64; 3],
    plane: Plane,
}

/// Another factor makes it another scaling.
impl Joinable for Scaling {
    fn joined(&self, other: &Self, _: bool) -> Option<Self> {
        let Self { factors, centre } = *self;
        let common = || merged!(Scaling.centre, centre, centre.join(&other.centre));
        factors.same(&other.factors).then(|| Self { factors, centre: common() })
    }

    fn stands_for(&self, inner: &Self) -> bool {
        let Self { factors, centre } = *self;
        factors.same(&inner.factors) && centre.covers(&inner.centre)
    }

    fn is_same(&self, other: &Self) -> bool {
        let Self { factors, centre } = *self;
        factors.same(&other.factors) && centre.same(&other.centre)
    }
}

/// Another angle or plane makes it another rotation.
impl Joinable for Rotation {
    fn joined(&self, other: &Self, _: bool) -> Option<Self> {
        let Self { angle, centre, plane } = *self;
        let alike = angle.same(&other.angle) && plane == other.plane;
        let common = || merged!(Rotation.centre, centre, centre.join(&other.centre));
        alike.then(|| Self { angle, centre: common(), plane })
    }

    fn stands_for(&self, inner: &Self) -> bool {
        let Self { angle, centre, plane } = *self;
        angle.same(&inner.angle) && plane == inner.plane && centre.covers(&inner.centre)
    }

    fn is_same(&self, other: &Self) -> bool {
        let Self { angle, centre, plane } = *self;
        angle.same(&other.angle) && plane == other.plane && centre.same(&other.centre)
    }
}

impl Transform {
    /// Nothing.
    pub const NONE: Self = Self { scaling: Perhaps::No, rotation: Perhaps::No, mirrors: [Perhaps::No; 3] };

    /// Any of them may be on.
    pub(crate) const UNKNOWN: Self =
        Self { scaling: Perhaps::Unknown, rotation: Perhaps::Unknown, mirrors: [Perhaps::Unknown; 3] };

    /// Scales by axis X, Y, Z about a centre in work coordinates; factors of 1 switch it off, unknown ones may.
    #[must_use]
    #[expect(clippy::float_cmp, reason = "off is exactly one")]
    pub(crate) fn scaled(self, factors: [f64; 3], centre: [f64; 3]) -> Self {
        let scaling = if factors == [1.0; 3] {
            Perhaps::No
        } else if factors.iter().any(|factor| factor.is_nan()) {
            Perhaps::Unknown
        } else {
            Perhaps::Yes(Scaling { factors, centre })
        };
        Self { scaling, ..self }
    }

    /// Turns in a plane by degrees about a centre; 0 switches it off, an unknown angle may.
    #[must_use]
    pub(crate) fn rotated(self, angle: f64, centre: [f64; 3], plane: Plane) -> Self {
        let rotation = if angle == 0.0 {
            Perhaps::No
        } else if angle.is_nan() {
            Perhaps::Unknown
        } else {
            Perhaps::Yes(Rotation { angle, centre, plane })
        };
        Self { rotation, ..self }
    }

    /// Without scaling.
    #[must_use]
    pub(crate) fn unscaled(self) -> Self {
        Self { scaling: Perhaps::No, ..self }
    }

    /// Without rotation.
    #[must_use]
    pub(crate) fn unrotated(self) -> Self {
        Self { rotation: Perhaps::No, ..self }
    }

    /// Is an axis mirrored for certain, these left out?
    pub(crate) fn is_mirrored_without(&self, is_out: impl Fn(Axis) -> bool) -> bool {
        let mut axes = [Axis::X, Axis::Y, Axis::Z].into_iter().zip(&self.mirrors);
        axes.any(|(axis, mirror)| !is_out(axis) && matches!(mirror, Perhaps::Yes(_)))
    }

    /// The mirrors, by axis X, Y, Z.
    pub(crate) fn mirrors_mut(&mut self) -> &mut [Perhaps<f64>; 3] {
        &mut self.mirrors
    }

    /// As it may be after something that nobody knows: a rotation may be on, what else is off stays so.
    pub(crate) fn or_other(&self) -> Self {
        Self {
            scaling: self.scaling.or_other(),
            rotation: Perhaps::Unknown,
            mirrors: self.mirrors.map(|mirror| mirror.or_other()),
        }
    }

    /// Does nothing, so that programmed and work coordinates are one?
    #[inline]
    pub(crate) fn is_off(&self) -> bool {
        self.rotation.is_no() && self.scaling.is_no() && self.mirrors.iter().all(Perhaps::is_no)
    }

    /// The factor of scaling on all axes: 1 without, NaN where it is unknown or differs.
    pub(crate) fn common_factor(&self) -> f64 {
        match self.scaling {
            Perhaps::No => 1.0,
            Perhaps::Yes(Scaling { factors: [x, y, z], .. })
                if x.to_bits() == y.to_bits() && y.to_bits() == z.to_bits() =>
            {
                x
            }
            Perhaps::Yes(_) | Perhaps::Unknown => f64::NAN,
        }
    }

    /// Does a circle in the plane stay one?
    pub(crate) fn keeps_circles(&self, plane: Plane) -> bool {
        match self.scaling {
            Perhaps::No => true,
            Perhaps::Yes(Scaling { factors, .. }) => {
                let [first, second, _] = plane.to_local(factors.map(Mm));
                first.0.abs().to_bits() == second.0.abs().to_bits()
            }
            Perhaps::Unknown => false,
        }
    }

    /// What it does to points.
    pub(crate) fn frame(&self) -> Perhaps<Frame> {
        if self.is_off() {
            return Perhaps::No;
        }
        let mut frame = Frame::identity();
        match self.scaling {
            Perhaps::No => {}
            Perhaps::Yes(Scaling { factors, centre }) => {
                frame = frame.then(&Frame::scaling(centre.map(Mm), factors));
            }
            Perhaps::Unknown => return Perhaps::Unknown,
        }
        match self.rotation {
            Perhaps::No => {}
            Perhaps::Yes(Rotation { angle, centre, plane }) => {
                let [first, second, _] = plane.to_local(centre.map(Mm));
                frame = frame.then(&Frame::rotation(plane, (first, second), Degrees(angle)));
            }
            Perhaps::Unknown => return Perhaps::Unknown,
        }
        if !self.mirrors.iter().all(Perhaps::is_no) {
            let place = |mirror: &Perhaps<f64>| match mirror {
                Perhaps::No => 0.0,
                Perhaps::Yes(at) => *at,
                Perhaps::Unknown => f64::NAN,
            };
            let places = self.mirrors.each_ref().map(place);
            let on = self.mirrors.each_ref().map(|mirror| !mirror.is_no());
            frame = frame.then(&Frame::mirror(places.map(Mm), on));
        }
        Perhaps::Yes(frame)
    }
}
