//! Where time goes.
//!
//! Knows: the causes and their sums. Must not know: how they are found.

use std::ops::{Add, AddAssign};

use gcheck_geometry::Seconds;

/// What the time of an item is spent on; all of them together are the time.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Shares {
    /// Moving at the speed that was asked for, or as fast as the axes and the turns of arcs allow.
    pub run: Seconds,
    /// Changing speed, and passing corners slowly.
    pub acceleration: Seconds,
    /// Waiting for blocks that the control has not prepared yet.
    pub starved: Seconds,
    /// Waiting for the spindle.
    pub spindle: Seconds,
    /// Changing tools.
    pub tool_change: Seconds,
    /// Auxiliary functions: coolant, chuck, the shop's own codes.
    pub auxiliary: Seconds,
    /// Dwells, and other times that the program gives.
    pub dwell: Seconds,
}

impl Shares {
    /// All of it.
    pub fn total(&self) -> Seconds {
        self.run
            + self.acceleration
            + self.starved
            + self.spindle
            + self.tool_change
            + self.auxiliary
            + self.dwell
    }
}

impl Add for Shares {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        Self {
            run: self.run + other.run,
            acceleration: self.acceleration + other.acceleration,
            starved: self.starved + other.starved,
            spindle: self.spindle + other.spindle,
            tool_change: self.tool_change + other.tool_change,
            auxiliary: self.auxiliary + other.auxiliary,
            dwell: self.dwell + other.dwell,
        }
    }
}

impl AddAssign for Shares {
    fn add_assign(&mut self, other: Self) {
        *self = *self + other;
    }
}
