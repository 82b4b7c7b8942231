//! How fast the tool goes and the spindle turns on the way to a point.
//!
//! Knows: a table of what differs, so that a point carries an index. Must not know: how feeds come about.

use std::collections::HashMap;

use gcheck_engine::FeedMode;

/// Feeds and speeds that are told apart; the first is the unknown one, which further ones count as.
const MOST: usize = 65_536;

/// Feed and speed of a piece of the path.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Drive {
    /// Millimetres a minute, millimetres a turn or moves a minute, as `mode` says; NaN unknown.
    pub(super) feed: f64,
    pub(super) mode: FeedMode,
    /// How fast the tool goes along the path, millimetres a minute; NaN unknown. Four digits.
    pub(super) along: f64,
    /// Turns of the spindle a minute, 0 when it is stopped; NaN unknown. Four digits where it follows from a surface speed.
    pub(super) rpm: f64,
}

impl Drive {
    pub(super) const UNKNOWN: Self =
        Self { feed: f64::NAN, mode: FeedMode::PerMinute, along: f64::NAN, rpm: f64::NAN };
}

/// The drives of a run.
#[derive(Debug, Clone)]
pub(super) struct Drives {
    all: Vec<Drive>,
    /// By the bits of the numbers.
    known: HashMap<([u64; 3], FeedMode), u16>,
    /// The one asked for last.
    last: Drive,
    index: u16,
}

impl Default for Drives {
    fn default() -> Self {
        Self { all: vec![Drive::UNKNOWN], known: HashMap::new(), last: Drive::UNKNOWN, index: 0 }
    }
}

impl Drives {
    /// The drive of the move before: a rapid move changes no feed.
    pub(super) const fn last(&self) -> Drive {
        self.last
    }

    /// The index of a drive.
    pub(super) fn index(&mut self, drive: Drive) -> u16 {
        let bits = |drive: &Drive| ([drive.feed, drive.along, drive.rpm].map(f64::to_bits), drive.mode);
        let key = bits(&drive);
        if key == bits(&self.last) {
            return self.index;
        }
        self.last = drive;
        let is_full = self.all.len() >= MOST;
        self.index = match self.known.get(&key) {
            Some(index) => *index,
            None if is_full => 0,
            None => {
                // Below `MOST`, it fits.
                let index = self.all.len() as u16;
                self.all.push(drive);
                self.known.insert(key, index);
                index
            }
        };
        self.index
    }

    pub(super) fn into_all(self) -> Vec<Drive> {
        self.all
    }
}

/// Four digits: what is computed differs in the last ones from move to move.
pub(super) fn four_digits(value: f64) -> f64 {
    if !value.is_finite() || value == 0.0 {
        return value;
    }
    let digits = 10_f64.powf(3.0 - value.abs().log10().floor());
    (value * digits).round() / digits
}
