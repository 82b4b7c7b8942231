//! Quantities with their units: a length is not a feed, and an inch is not a millimetre.
//!
//! Knows the units in which the engine computes and the conversions between them.
//! Must not know how a program writes a number.
//!
//! Every quantity may be *unknown*. Unknown is the float's NaN: arithmetic hands it on, every comparison with it
//! is false, and [`is_known`](Mm::is_known) tells. `-0.0`, infinities and NaN never make anything here panic.

use std::iter::Sum;
use std::ops::{Add, AddAssign, Div, Mul, Neg, Sub, SubAssign};

/// Millimetres in an inch, by definition.
pub const MM_PER_INCH: f64 = 25.4;

macro_rules! quantity {
    ($(#[$meta:meta])* $name:ident) => {
        $(#[$meta])*
        #[repr(transparent)]
        #[derive(Debug, Clone, Copy, PartialEq, PartialOrd, Default)]
        pub struct $name(pub f64);

        impl $name {
            /// Nothing of it.
            pub const ZERO: Self = Self(0.0);
            /// An unknown value; see the module's description.
            pub const UNKNOWN: Self = Self(f64::NAN);

            /// The bare number, in the unit of the type.
            #[inline]
            pub const fn get(self) -> f64 {
                self.0
            }

            /// Whether the value is a number at all; an infinite one is.
            #[inline]
            pub const fn is_known(self) -> bool {
                !self.0.is_nan()
            }

            /// Whether the value is known and finite.
            #[inline]
            pub const fn is_finite(self) -> bool {
                self.0.is_finite()
            }

            /// The size without the sign.
            #[inline]
            #[must_use]
            pub const fn abs(self) -> Self {
                Self(self.0.abs())
            }

            /// The smaller of two; unknown when either is.
            #[inline]
            #[must_use]
            pub const fn min(self, other: Self) -> Self {
                if self.is_known() && other.is_known() { Self(self.0.min(other.0)) } else { Self::UNKNOWN }
            }

            /// The larger of two; unknown when either is.
            #[inline]
            #[must_use]
            pub const fn max(self, other: Self) -> Self {
                if self.is_known() && other.is_known() { Self(self.0.max(other.0)) } else { Self::UNKNOWN }
            }

            /// Whether two values are not further apart than `tolerance`; false when any of them is unknown.
            #[inline]
            pub fn is_near(self, other: Self, tolerance: Self) -> bool {
                // Equal infinities are near although their difference is not a number.
                self == other || (self - other).abs() <= tolerance
            }
        }

        impl Add for $name {
            type Output = Self;
            #[inline]
            fn add(self, other: Self) -> Self {
                Self(self.0 + other.0)
            }
        }

        impl AddAssign for $name {
            #[inline]
            fn add_assign(&mut self, other: Self) {
                self.0 += other.0;
            }
        }

        impl Sub for $name {
            type Output = Self;
            #[inline]
            fn sub(self, other: Self) -> Self {
                Self(self.0 - other.0)
            }
        }

        impl SubAssign for $name {
            #[inline]
            fn sub_assign(&mut self, other: Self) {
                self.0 -= other.0;
            }
        }

        impl Neg for $name {
            type Output = Self;
            #[inline]
            fn neg(self) -> Self {
                Self(-self.0)
            }
        }

        impl Mul<f64> for $name {
            type Output = Self;
            #[inline]
            fn mul(self, factor: f64) -> Self {
                Self(self.0 * factor)
            }
        }

        impl Mul<$name> for f64 {
            type Output = $name;
            #[inline]
            fn mul(self, quantity: $name) -> $name {
                $name(self * quantity.0)
            }
        }

        impl Div<f64> for $name {
            type Output = Self;
            #[inline]
            fn div(self, divisor: f64) -> Self {
                Self(self.0 / divisor)
            }
        }

        /// The ratio, a bare number.
        impl Div for $name {
            type Output = f64;
            #[inline]
            fn div(self, other: Self) -> f64 {
                self.0 / other.0
            }
        }

        impl Sum for $name {
            fn sum<I: Iterator<Item = Self>>(parts: I) -> Self {
                Self(parts.map(|part| part.0).sum())
            }
        }
    };
}

macro_rules! inch_form {
    ($name:ident, $unit:literal) => {
        impl $name {
            #[doc = concat!("From ", $unit, ".")]
            #[inline]
            #[must_use]
            pub const fn from_inch(value: f64) -> Self {
                Self(value * MM_PER_INCH)
            }

            #[doc = concat!("The bare number in ", $unit, ".")]
            #[inline]
            pub const fn inch(self) -> f64 {
                self.0 / MM_PER_INCH
            }
        }
    };
}

quantity! {
    /// A length or a position on a linear axis, in millimetres.
    Mm
}
quantity! {
    /// An angle or a position on a rotary axis, in degrees. Not reduced to one turn.
    Degrees
}
quantity! {
    /// A feed or a speed along a path, in millimetres a minute.
    MmPerMin
}
quantity! {
    /// A spindle speed, in revolutions a minute.
    Rpm
}
quantity! {
    /// A time, in seconds.
    Seconds
}
quantity! {
    /// A feed or a lead, in millimetres a revolution of the spindle.
    MmPerRev
}

inch_form!(Mm, "inches");
inch_form!(MmPerMin, "inches a minute");
inch_form!(MmPerRev, "inches a revolution");

impl Degrees {
    /// One turn.
    pub const TURN: Self = Self(360.0);

    /// From radians.
    #[inline]
    #[must_use]
    pub const fn from_radians(radians: f64) -> Self {
        Self(radians.to_degrees())
    }

    /// The bare number in radians.
    #[inline]
    pub const fn radians(self) -> f64 {
        self.0.to_radians()
    }

    /// Sine and cosine, exact at multiples of 90 degrees, so that a quarter turn moves a point to where a
    /// machinist expects it and not 1e-16 beside it. Both unknown for an angle that is unknown or infinite.
    pub fn sin_cos(self) -> (f64, f64) {
        let angle = self.0 % 360.0;
        let quarter = angle / 90.0;
        if quarter.fract().abs() > 0.0 || !angle.is_finite() {
            return angle.to_radians().sin_cos();
        }
        match (quarter as i32).rem_euclid(4) {
            0 => (0.0, 1.0),
            1 => (1.0, 0.0),
            2 => (0.0, -1.0),
            _ => (-1.0, 0.0),
        }
    }

    /// The same direction within one turn: at least 0, below 360.
    #[must_use]
    pub fn normalised(self) -> Self {
        let angle = self.0.rem_euclid(360.0);
        // A tiny negative angle rounds up to a whole turn.
        Self(if angle >= 360.0 { 0.0 } else { angle })
    }

    /// The same direction, as many whole turns away as it is the shorter way from another angle.
    #[must_use]
    pub fn nearest_to(self, from: Self) -> Self {
        Self(self.0 - 360.0 * ((self.0 - from.0) / 360.0).round())
    }
}

impl Seconds {
    /// From minutes.
    #[inline]
    #[must_use]
    pub const fn from_minutes(minutes: f64) -> Self {
        Self(minutes * 60.0)
    }

    /// The bare number in minutes.
    #[inline]
    pub const fn minutes(self) -> f64 {
        self.0 / 60.0
    }
}

impl Rpm {
    /// The spindle speed that gives the surface speed `surface` at the diameter `diameter`.
    /// Infinite at the centre: whoever drives a spindle clamps it.
    #[must_use]
    pub fn for_surface_speed(surface: MmPerMin, diameter: Mm) -> Self {
        Self(surface.0.abs() / (std::f64::consts::PI * diameter.0.abs()))
    }

    /// The speed at which the surface of the diameter `diameter` passes.
    pub fn surface_speed(self, diameter: Mm) -> MmPerMin {
        MmPerMin(self.0.abs() * std::f64::consts::PI * diameter.0.abs())
    }
}

/// The time that a way takes at a feed: infinite at feed zero, unknown for no way at feed zero.
impl Div<MmPerMin> for Mm {
    type Output = Seconds;
    #[inline]
    fn div(self, feed: MmPerMin) -> Seconds {
        Seconds::from_minutes(self.0 / feed.0)
    }
}

/// The feed that covers a way in a time.
impl Div<Seconds> for Mm {
    type Output = MmPerMin;
    #[inline]
    fn div(self, time: Seconds) -> MmPerMin {
        MmPerMin(self.0 / time.minutes())
    }
}

/// The revolutions that a way takes, a bare number.
impl Div<MmPerRev> for Mm {
    type Output = f64;
    #[inline]
    fn div(self, feed: MmPerRev) -> f64 {
        self.0 / feed.0
    }
}

/// The way covered in a time.
impl Mul<Seconds> for MmPerMin {
    type Output = Mm;
    #[inline]
    fn mul(self, time: Seconds) -> Mm {
        Mm(self.0 * time.minutes())
    }
}

/// The feed a minute of a feed a revolution.
impl Mul<Rpm> for MmPerRev {
    type Output = MmPerMin;
    #[inline]
    fn mul(self, speed: Rpm) -> MmPerMin {
        MmPerMin(self.0 * speed.0)
    }
}

/// The feed a revolution of a feed a minute.
impl Div<Rpm> for MmPerMin {
    type Output = MmPerRev;
    #[inline]
    fn div(self, speed: Rpm) -> MmPerRev {
        MmPerRev(self.0 / speed.0)
    }
}

/// The revolutions made in a time, a bare number.
impl Mul<Seconds> for Rpm {
    type Output = f64;
    #[inline]
    fn mul(self, time: Seconds) -> f64 {
        self.0 * time.minutes()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_inch_is_25_4_millimetres() {
        assert_eq!(Mm::from_inch(1.0), Mm(25.4));
        assert_eq!(Mm::from_inch(-0.25).inch().to_bits(), (-0.25_f64).to_bits());
        assert_eq!(MmPerMin::from_inch(10.0), MmPerMin(254.0));
    }

    #[test]
    fn sixty_millimetres_at_sixty_a_minute_take_a_minute() {
        assert_eq!(Mm(60.0) / MmPerMin(60.0), Seconds(60.0));
        assert_eq!(MmPerMin(60.0) * Seconds(30.0), Mm(30.0));
        assert_eq!(Mm(30.0) / Seconds(30.0), MmPerMin(60.0));
    }

    #[test]
    fn a_lead_and_a_speed_make_a_feed() {
        assert_eq!(MmPerRev(1.5) * Rpm(1000.0), MmPerMin(1500.0));
        assert_eq!(MmPerMin(1500.0) / Rpm(1000.0), MmPerRev(1.5));
    }

    #[test]
    fn surface_speed_falls_with_the_diameter() {
        // 200 m/min on 100 mm: 200000 / (pi * 100) revolutions a minute.
        assert!(Rpm::for_surface_speed(MmPerMin(200_000.0), Mm(100.0)).is_near(Rpm(636.619_77), Rpm(1e-4)));
        assert!(Rpm(636.619_772).surface_speed(Mm(100.0)).is_near(MmPerMin(200_000.0), MmPerMin(1e-3)));
        assert!(!Rpm::for_surface_speed(MmPerMin(200_000.0), Mm(0.0)).is_finite());
    }

    #[test]
    fn unknown_spreads_and_compares_with_nothing() {
        let unknown = Mm::UNKNOWN + Mm(1.0);
        assert!(!unknown.is_known());
        assert_eq!(unknown.partial_cmp(&Mm(0.0)), None);
        assert!(!unknown.min(Mm(1.0)).is_known() && !Mm(1.0).max(unknown).is_known());
        assert!(!unknown.is_near(unknown, Mm(1.0)));
        assert!(!(unknown / MmPerMin(100.0)).is_known());
    }

    #[test]
    fn feed_zero_takes_for_ever() {
        let time = Mm(1.0) / MmPerMin::ZERO;
        assert!(time.is_known() && !time.is_finite());
        assert!(!(Mm::ZERO / MmPerMin::ZERO).is_known());
    }

    #[test]
    fn quarter_turns_are_exact() {
        let exact = |angle: f64| {
            let (sin, cos) = Degrees(angle).sin_cos();
            format!("{sin} {cos}")
        };
        assert_eq!(exact(0.0), "0 1");
        assert_eq!(exact(90.0), "1 0");
        assert_eq!(exact(-90.0), "-1 0");
        assert_eq!(exact(540.0), "0 -1");
        assert_eq!(exact(-3690.0), "-1 0");
        assert!(Degrees(f64::INFINITY).sin_cos().0.is_nan());
        assert!((Degrees(30.0).sin_cos().0 - 0.5).abs() < 1e-15);
    }

    #[test]
    fn angles_are_reduced_to_one_turn_only_on_demand() {
        assert_eq!(Degrees(-90.0).normalised(), Degrees(270.0));
        assert_eq!(Degrees(720.0).normalised(), Degrees(0.0));
        assert_eq!(Degrees(-1e-20).normalised(), Degrees(0.0));
    }
}
