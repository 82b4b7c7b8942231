//! Speed along one stretch of path.
//!
//! Knows: how a stretch is run from one speed to another under a limit of speed and one of acceleration. Must not know:
//! axes, corners, what comes before and after.

/// How a stretch is run: to the peak, at the peak, to the exit. Lengths, speeds a second and seconds.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Profile {
    /// Way.
    pub length: f64,
    /// Speed at its start.
    pub entry: f64,
    /// Highest speed.
    pub peak: f64,
    /// Speed at its end.
    pub exit: f64,
    /// Change of speed a second.
    pub acceleration: f64,
    /// How long it takes.
    pub seconds: f64,
}

impl Profile {
    /// The quickest run: up, on, down. The exit must be reachable from the entry, and the entry from the exit.
    pub(crate) fn quickest(length: f64, entry: f64, exit: f64, cap: f64, acceleration: f64) -> Self {
        if length <= 0.0 {
            return Self { length: 0.0, entry, peak: entry.max(exit), exit, acceleration, seconds: 0.0 };
        }
        // Without a limit of acceleration the cap is the speed.
        if !acceleration.is_finite() {
            return Self { length, entry, peak: cap, exit, acceleration, seconds: length / cap };
        }
        let meeting = ((entry * entry + exit * exit) * 0.5 + acceleration * length).max(0.0).sqrt();
        let peak = meeting.min(cap).max(entry).max(exit);
        let changes = ((peak - entry) + (peak - exit)) / acceleration;
        let way = (peak * peak - entry * entry + peak * peak - exit * exit) / (2.0 * acceleration);
        let on = (length - way).max(0.0);
        let seconds = if peak > 0.0 { changes + on / peak } else { 0.0 };
        Self { length, entry, peak, exit, acceleration, seconds }
    }

    /// One even change from the entry to the exit.
    pub(crate) fn ramp(length: f64, entry: f64, exit: f64) -> Self {
        let seconds = 2.0 * length / (entry + exit);
        let acceleration = (exit - entry).abs() / seconds;
        Self { length, entry, peak: entry.max(exit), exit, acceleration, seconds }
    }

    /// The speed after this many seconds.
    pub fn speed_at(&self, seconds: f64) -> f64 {
        if seconds <= 0.0 || self.acceleration.is_infinite() {
            return self.entry;
        }
        if seconds >= self.seconds {
            return self.exit;
        }
        let rising = self.entry + self.acceleration * seconds;
        let falling = self.exit + self.acceleration * (self.seconds - seconds);
        rising.min(falling).min(self.peak)
    }
}

/// The speed from which `exit` can be reached within `length`.
pub(crate) fn highest_entry(exit: f64, acceleration: f64, length: f64) -> f64 {
    (exit * exit + 2.0 * acceleration * length).sqrt()
}
