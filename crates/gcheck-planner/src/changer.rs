//! What a tool change takes.
//!
//! Knows: pockets around a magazine, and whether it turns while the machine cuts. Must not know: programs, tools.

use gcheck_geometry::Seconds;

use crate::machine::Changer;

/// Follows the magazine.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Magazine {
    changer: Changer,
    /// The pocket at the change position; that of the tool in the spindle where the magazine has to take it back.
    pocket: Option<u32>,
    /// When the magazine has come to rest.
    still: f64,
}

impl Magazine {
    pub(crate) const fn new(changer: Changer) -> Self {
        Self { changer, pocket: None, still: 0.0 }
    }

    /// A tool is called for.
    pub(crate) fn call(&mut self, pocket: u32, now: f64) {
        if self.changer.turns_ahead {
            self.turn(Some(pocket), now);
        }
    }

    /// A tool is changed.
    pub(crate) fn change(&mut self, pocket: Option<u32>, now: f64) -> Seconds {
        self.turn(pocket, now);
        let wait = (self.still - now).max(0.0);
        self.still = now + wait + self.changer.change.0;
        Seconds(wait) + self.changer.change
    }

    fn turn(&mut self, pocket: Option<u32>, now: f64) {
        if let (Some(from), Some(to)) = (self.pocket, pocket) {
            let way = from.abs_diff(to);
            let way = match self.changer.pockets {
                Some(all) if all > 0 => (way % all).min(all - way % all),
                _ => way,
            };
            self.still = self.still.max(now) + f64::from(way) * self.changer.pocket.0;
        }
        self.pocket = pocket;
    }
}
