//! Values that occurred in a run: feeds, speeds, lengths.
//!
//! Knows: how to keep them in bounded memory. Must not know: what they measure.

/// More different values of a feed or a speed are not kept one by one.
pub const MAX_DISTINCT: usize = 32;

/// Values that occurred: the smallest, the largest, and each while they are few.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Values {
    /// Ascending, at most [`MAX_DISTINCT`].
    distinct: Vec<f64>,
    last: Option<f64>,
    range: Option<(f64, f64)>,
    more: bool,
}

impl Values {
    pub(crate) fn add(&mut self, value: f64) {
        // The same value comes again and again.
        if !value.is_finite() || self.last.is_some_and(|last| last.to_bits() == value.to_bits()) {
            return;
        }
        self.last = Some(value);
        self.range = Some(self.range.map_or((value, value), |(low, high)| (low.min(value), high.max(value))));
        let at = self.distinct.partition_point(|known| *known < value);
        let near = |index: usize| {
            self.distinct.get(index).is_some_and(|known| (known - value).abs() <= 1e-9 * value.abs())
        };
        // Values that differ by the noise of a conversion are one.
        if near(at) || at.checked_sub(1).is_some_and(near) {
            return;
        }
        if self.distinct.len() < MAX_DISTINCT {
            self.distinct.insert(at, value);
        } else {
            self.more = true;
        }
    }

    pub(crate) fn merge(&mut self, other: &Self) {
        for value in &other.distinct {
            self.add(*value);
        }
        if let Some((low, high)) = other.range {
            self.add(low);
            self.add(high);
        }
        self.more |= other.more;
    }

    /// The values in ascending order; not all of them when [`Self::has_more`].
    pub fn distinct(&self) -> &[f64] {
        &self.distinct
    }

    /// Were there more than are kept?
    pub const fn has_more(&self) -> bool {
        self.more
    }

    /// The smallest and the largest.
    pub const fn range(&self) -> Option<(f64, f64)> {
        self.range
    }
}
