//! Whether the control prepares blocks as fast as the machine runs them.
//!
//! Knows: what preparing a block takes, how many may be prepared ahead. Must not know: moves.

use std::collections::VecDeque;

/// Follows the blocks that are prepared while others are run.
#[derive(Debug, Clone)]
pub(crate) struct Feeding {
    block_time: f64,
    ahead: usize,
    /// When the next block is prepared.
    ready: f64,
    /// When blocks were begun, the last ones: one more may be prepared with each.
    begun: VecDeque<f64>,
}

impl Feeding {
    pub(crate) fn new(block_time: f64, ahead: usize) -> Self {
        Self { block_time: block_time.max(0.0), ahead: ahead.max(1), ready: 0.0, begun: VecDeque::new() }
    }

    /// The axes are until then, and the control has prepared blocks meanwhile.
    pub(crate) fn stop(&mut self, now: f64) {
        if self.block_time > 0.0 {
            #[expect(clippy::cast_precision_loss, reason = "a window is small")]
            let full = self.ahead as f64 * self.block_time;
            self.ready = self.ready.max(now - full);
        }
    }

    /// How long a stretch of this many blocks has to be drawn out so that the next block is prepared when it ends.
    pub(crate) fn after(&mut self, blocks: u32, begin: f64, end: f64) -> f64 {
        if self.block_time <= 0.0 || blocks == 0 {
            return 0.0;
        }
        for _ in 0..blocks.min(1_000) {
            self.begun.push_back(begin);
        }
        let mut free = 0.0;
        while self.begun.len() > self.ahead {
            free = self.begun.pop_front().unwrap_or(0.0);
        }
        self.ready = self.ready.max(free) + self.block_time * f64::from(blocks);
        (self.ready - end).max(0.0)
    }
}
