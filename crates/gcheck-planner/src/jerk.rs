//! What limited jerk adds to times that were planned without it.
//!
//! Knows: changes of speed, and how much longer they take when acceleration cannot jump. Must not know: paths, axes.
//!
//! A change of speed by `d` at the acceleration `a` takes `d / a`; with the jerk `j` it takes `a / j` more, or
//! `2 * sqrt(d / j)` in all where `d < a * a / j`. Stretches that follow each other with rising (or falling) speed are
//! one change. Of what a change takes longer, the way covered meanwhile is saved at the higher speed.

use crate::profile::Profile;

/// Follows the changes of speed from one stretch to the next.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Easing {
    /// The speed at which the change that goes on began, and whether it rises.
    change: Option<(f64, bool)>,
    speed: f64,
}

impl Easing {
    /// What the changes of speed that end in this stretch take longer.
    pub(crate) fn after(&mut self, profile: &Profile, jerk: f64) -> f64 {
        if jerk.is_infinite() || profile.acceleration.is_infinite() {
            return 0.0;
        }
        let cruises = is_cruising(profile);
        let mut more = 0.0;
        for (speed, at_peak) in [(profile.peak, true), (profile.exit, false)] {
            let rises = speed > self.speed;
            let stays = (speed - self.speed).abs() <= 1e-9 * speed;
            if let Some((from, rose)) = self.change
                && (stays || rises != rose)
            {
                more += longer(from, self.speed, profile.acceleration, jerk, stays || cruises);
                self.change = None;
            }
            if !stays && self.change.is_none() {
                self.change = Some((self.speed, rises));
            }
            self.speed = speed;
            if at_peak
                && cruises
                && let Some((from, _)) = self.change.take()
            {
                more += longer(from, speed, profile.acceleration, jerk, true);
            }
        }
        if profile.exit <= 0.0
            && let Some((from, _)) = self.change.take()
        {
            more += longer(from, 0.0, profile.acceleration, jerk, cruises);
        }
        more
    }

    /// The same for a stretch from rest to rest.
    pub(crate) fn alone(profile: &Profile, jerk: f64) -> f64 {
        Self::default().after(profile, jerk)
    }
}

fn is_cruising(profile: &Profile) -> bool {
    let [entry, peak, exit] = [profile.entry, profile.peak, profile.exit].map(|speed| speed * speed);
    let way = (2.0 * peak - entry - exit) / (2.0 * profile.acceleration);
    profile.length - way > 1e-9 * profile.length
}

/// What one change of speed takes longer; `cruises`: the higher speed is held for a while.
fn longer(from: f64, to: f64, acceleration: f64, jerk: f64, cruises: bool) -> f64 {
    let (low, high) = if from < to { (from, to) } else { (to, from) };
    if high <= 0.0 {
        return 0.0;
    }
    let full = acceleration / jerk;
    let time = (high - low) / acceleration;
    let more = if cruises {
        if time >= full { full / 2.0 } else { (full * time).sqrt() - time / 2.0 }
    } else {
        // The speed is not reached any more: the same way at a lower peak.
        let at_full = full.midpoint(full.hypot(2.0 * time)) - time;
        let in_part = 2.0 * (full * time * time / 2.0).cbrt() - time;
        if time * time < 2.0 * full * full { in_part } else { at_full }
    };
    more.max(0.0) * (1.0 - low / high)
}
