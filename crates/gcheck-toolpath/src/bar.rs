//! What a bar feeder did in a run: parts, bars, what is left of them.
//!
//! Knows: which events count. Must not know: when a bar is too short, how the figures are shown.

use gcheck_engine::Event;
use gcheck_geometry::Mm;

use crate::values::Values;

/// Bars beyond these are counted in the sums alone.
const MOST_BARS: usize = 1_000;

/// Figures of a bar feeder. Has to see every event of the run, in order.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct BarFigures {
    feeds: u64,
    parts: u64,
    used_up: u64,
    /// Parts of each bar that was used up, in order.
    by_bar: Vec<u64>,
    /// Parts of the bar in the chuck.
    of_this_bar: u64,
    pushed: Mm,
    remnants: Values,
    /// Something was cut since the bar was fed last.
    has_cut: bool,
    /// The last push was too short for a part.
    is_short: bool,
    /// Length of a part with its cutoff, of the feed under way; NaN unknown.
    part: Mm,
    /// The push under way is that of a new bar.
    is_new: bool,
}

/// Lengths that differ by less are taken for equal, millimetres.
const EQUAL_WITHIN: f64 = 1e-6;

impl BarFigures {
    /// Something is cut.
    pub(crate) fn cut(&mut self) {
        self.has_cut = true;
    }

    /// Counts an event.
    pub(crate) fn add(&mut self, event: &Event) {
        match event {
            Event::BarFeed(lengths) => {
                self.feeds += 1;
                self.part = lengths.part;
                // A feed in front of the first part comes after none.
                if std::mem::take(&mut self.has_cut) && !self.is_short {
                    self.parts += 1;
                    self.of_this_bar += 1;
                }
            }
            Event::BarLoad => self.is_new = true,
            Event::BarPush(by) => {
                self.pushed += *by;
                // Less bar than a part gives scrap.
                self.is_short = std::mem::take(&mut self.is_new) && by.0 < self.part.0 - EQUAL_WITHIN;
            }
            Event::BarUnload(rest) => {
                self.used_up += 1;
                let parts = std::mem::take(&mut self.of_this_bar);
                if self.by_bar.len() < MOST_BARS {
                    self.by_bar.push(parts);
                }
                self.remnants.add(rest.0);
            }
            _ => {}
        }
    }

    /// Was there a bar feed at all?
    pub const fn is_used(&self) -> bool {
        self.feeds > 0
    }

    /// Parts that were finished: the push before them was long enough, and bar was fed after them.
    pub const fn parts(&self) -> u64 {
        self.parts
    }

    /// Bars that were used up.
    pub const fn used_up(&self) -> u64 {
        self.used_up
    }

    /// Parts of each bar that was used up, in order; of the first thousand.
    pub fn by_bar(&self) -> &[u64] {
        &self.by_bar
    }

    /// Length of bar pushed; NaN unknown.
    pub const fn pushed(&self) -> Mm {
        self.pushed
    }

    /// What was left of bars behind the face of the chuck, millimetres.
    pub const fn remnants(&self) -> &Values {
        &self.remnants
    }
}
