//! What is known of a machine and of the control that drives it.
//!
//! Knows: limits of axes and spindle, how a control takes corners, looks ahead and changes tools. Must not know: any
//! control's name, where the figures come from, moves.

use gcheck_geometry::{Mm, MmPerMin, Rpm, Seconds};

use crate::axes::{AXES, Point};

/// Limits of the axes, by axis: millimetres or degrees.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Limits {
    speed: Point,
    acceleration: Point,
    jerk: Option<Point>,
    feed: f64,
}

/// A limit that no machine has.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BadLimit {
    /// Which figure.
    pub what: &'static str,
    /// Place of the axis in X Y Z A B C U V W.
    pub axis: usize,
    /// Its value.
    pub value: f64,
}

impl std::fmt::Display for BadLimit {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let axis = "XYZABCUVW".chars().nth(self.axis).unwrap_or('?');
        write!(f, "the {} of {axis} is {}: it must be greater than zero", self.what, self.value)
    }
}

impl std::error::Error for BadLimit {}

impl Limits {
    /// Speeds in units a second, accelerations in units a second squared, jerks in units a second cubed.
    ///
    /// # Errors
    ///
    /// The first figure that is zero, negative or not a number. An infinite one is not a limit.
    pub fn new(
        speed: [f64; AXES],
        acceleration: [f64; AXES],
        jerk: Option<[f64; AXES]>,
    ) -> Result<Self, BadLimit> {
        let check = |what: &'static str, values: &[f64; AXES]| {
            let bad = values.iter().position(|value| value.is_nan() || *value <= 0.0);
            bad.map_or(Ok(()), |axis| {
                Err(BadLimit { what, axis, value: values.get(axis).copied().unwrap_or(f64::NAN) })
            })
        };
        check("speed", &speed)?;
        check("acceleration", &acceleration)?;
        if let Some(jerk) = &jerk {
            check("jerk", jerk)?;
        }
        Ok(Self {
            speed: Point::from(speed),
            acceleration: Point::from(acceleration),
            jerk: jerk.map(Point::from),
            feed: f64::INFINITY,
        })
    }

    /// With a highest speed along the path of moves that are not rapid.
    #[must_use]
    pub fn with_feed(mut self, feed: MmPerMin) -> Self {
        if feed.0 > 0.0 {
            self.feed = feed.0 / 60.0;
        }
        self
    }

    /// Highest speed along the path of moves that are not rapid, units a second; infinite without a limit.
    pub const fn feed(&self) -> f64 {
        self.feed
    }

    /// Highest speed by axis, units a second.
    pub const fn speed(&self) -> &Point {
        &self.speed
    }

    /// Highest acceleration by axis, units a second squared.
    pub const fn acceleration(&self) -> &Point {
        &self.acceleration
    }

    /// Highest jerk by axis, units a second cubed, where it is limited.
    pub const fn jerk(&self) -> Option<&Point> {
        self.jerk.as_ref()
    }
}

/// A machine with its control.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Machine {
    /// Its axes.
    pub limits: Limits,
    /// How its control moves them.
    pub control: Control,
    /// Its spindle.
    pub spindle: SpindleLimits,
    /// Its tool changer.
    pub changer: Changer,
    /// Part of the rapid rates that is run: the rapid override.
    pub rapid_part: f64,
}

/// How a control moves axes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Control {
    /// How it takes corners.
    pub corners: Corners,
    /// How it makes rapid moves.
    pub rapids: Rapids,
    /// Stretches of path that it knows ahead of the tool. It can always stop at the end of the last one.
    pub look_ahead: usize,
    /// What preparing one block takes; zero where that is nothing to speak of.
    pub block_time: Seconds,
    /// Stretches that take less are run with one even change of speed; zero for none.
    pub even_below: Seconds,
    /// No stretch is run in less, however fast the axes are; zero for no such limit.
    pub shortest: Seconds,
    /// From the end of a move that the axes stop after to the start of what they stop for.
    pub halt_time: Seconds,
    /// How it taps.
    pub taps: Taps,
    /// When it waits for the spindle.
    pub spindle_wait: SpindleWait,
}

/// How a control makes rapid moves.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Rapids {
    /// On the straight line, joined with their neighbours as moves at feed are.
    Joined,
    /// On the straight line, with a stop at both ends.
    Straight,
    /// Each axis for itself, with a stop at both ends.
    ByAxis,
}

/// How a control takes corners while it does not have to pass or stop at them.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Corners {
    /// On arcs inside a tolerance.
    Rounded(Rounding),
    /// On the corner itself, slow enough for what the axes can take.
    Slowed(Slowing),
    /// The axes run after the interpolated point with accelerations of their own: corners cost no time.
    Filtered,
}

/// How corners are rounded.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Rounding {
    /// The tolerance where the program gives none; `None` for as wide as the moves allow.
    pub default_tolerance: Option<Mm>,
    /// Without a tolerance: the part of a move's length that its corner may be off.
    pub part_of_length: f64,
    /// Arcs are as long as the way of two overlapping moves would be, else no wider than their speed needs.
    pub stretched: bool,
    /// Where a side of a corner curves the way the corner turns, this part of the side's own turn counts with that of the
    /// corner: of the side before it, and of the side after it.
    pub curve_shares: [f64; 2],
    /// A corner of two arcs that counts as a sharper one than this, in radians, is not rounded.
    pub sharpest_between_arcs: f64,
    /// The part of the acceleration that turns the path on arcs.
    pub across: f64,
    /// The part of the acceleration that is left along an arc where `across` is used up.
    pub along: f64,
    /// Once both ends of an arc of the program are known, what they leave of the acceleration is divided again: what its highest
    /// speed needs turns the path, no more than `across` of it, and the rest runs along. A helix counts for that as an arc
    /// of its radius and the square of its whole rise by the radius.
    pub divides: bool,
    /// Corners are passed without rounding at a speed at which the axes' speeds change by no more than this part of what
    /// their acceleration changes in one cycle of the control.
    pub unrounded: f64,
    /// One cycle of the control.
    pub cycle: Seconds,
    /// What is left of a move between two rounded corners belongs to the second one when it is run in fewer cycles.
    pub least_cycles: f64,
    /// Moves that cannot be rounded overlap: the next one begins while the last one comes to rest, each at half the
    /// acceleration. Without this they meet as slowed corners do.
    pub overlaps: bool,
}

/// How corners are slowed down for.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Slowing {
    /// By how much the speed of an axis may change at a corner, by axis: units a second.
    pub change: Point,
}

/// How a control taps.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Taps {
    /// The spindle comes to rest at the bottom.
    RestAtBottom,
    /// The spindle is reversed at the bottom, and the tap runs on until it turns the other way.
    RunOut,
}

/// When a control waits for the spindle to reach its speed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum SpindleWait {
    /// At once.
    AtOnce,
    /// Ahead of the next move at feed.
    AtFeed,
}

/// Limits of the spindle.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct SpindleLimits {
    /// Turns a minute that it gains in a second; `None` where it is not known: then it takes no time.
    pub acceleration: Option<Rpm>,
    /// What turning to an angle takes, from rest.
    pub orientation: Seconds,
}

/// A tool changer.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Changer {
    /// One change, with the tool at hand.
    pub change: Seconds,
    /// What the magazine takes to pass one pocket; zero where that is not known.
    pub pocket: Seconds,
    /// Pockets around the magazine; `None` where it is not known.
    pub pockets: Option<u32>,
    /// The magazine turns while the machine cuts, once the tool is called for.
    pub turns_ahead: bool,
}
