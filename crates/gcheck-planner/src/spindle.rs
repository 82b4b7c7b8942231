//! What the spindle makes the axes wait for.
//!
//! Knows: its speed, and how long changes of it take. Must not know: programs, paths.

use gcheck_geometry::{Rpm, Seconds};

use crate::machine::{SpindleLimits, SpindleWait, Taps};
use crate::profile::Profile;

/// Follows the spindle.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Spindle {
    limits: SpindleLimits,
    wait: SpindleWait,
    /// Turns a minute that it was told, counter-clockwise negative.
    speed: f64,
    /// When it has reached them.
    reached: f64,
    awaited: bool,
}

impl Spindle {
    pub(crate) const fn new(limits: SpindleLimits, wait: SpindleWait) -> Self {
        Self { limits, wait, speed: 0.0, reached: 0.0, awaited: false }
    }

    /// The spindle is told a speed.
    pub(crate) fn command(&mut self, speed: Rpm, now: f64) {
        let speed = if speed.is_finite() { speed.0 } else { return };
        let change = (speed - self.speed).abs();
        // A command in the middle of a change: the spindle is somewhere between.
        self.reached = self.reached.max(now) + self.change(change);
        self.speed = speed;
        self.awaited = change > 0.0 && (speed.abs() > 0.0 || self.wait == SpindleWait::AtOnce);
    }

    /// Has a change to be waited for?
    pub(crate) const fn is_awaited(&self) -> bool {
        self.awaited
    }

    /// Waits until it has its speed.
    pub(crate) fn wait(&mut self, now: f64) -> Seconds {
        self.awaited = false;
        Seconds((self.reached - now).max(0.0))
    }

    /// Stops it.
    pub(crate) fn stop(&mut self, now: f64) -> Seconds {
        self.command(Rpm::ZERO, now);
        self.wait(now)
    }

    /// Turns it to an angle.
    pub(crate) fn orient(&mut self, now: f64) -> Seconds {
        self.stop(now) + self.limits.orientation
    }

    /// One stroke of a tap at this speed of the spindle: way, speed and acceleration of the axis.
    pub(crate) fn stroke(
        &self,
        taps: Taps,
        speed: Rpm,
        (length, pace, acceleration): (f64, f64, f64),
    ) -> f64 {
        let change = self.change(speed.0.abs());
        match taps {
            Taps::RestAtBottom => {
                let with_spindle = if change > 0.0 { pace / change } else { f64::INFINITY };
                Profile::quickest(length, 0.0, 0.0, pace, acceleration.min(with_spindle)).seconds
            }
            // It turns on below the bottom while it is reversed, and comes back with the same time; at the top the axis comes
            // to rest beyond it.
            Taps::RunOut => length / pace + 2.0 * change + pace / acceleration / 2.0,
        }
    }

    fn change(&self, speed: f64) -> f64 {
        match self.limits.acceleration {
            Some(acceleration) if acceleration.0 > 0.0 => speed / acceleration.0,
            _ => 0.0,
        }
    }
}
