//! What the execution engine must know of a bar feeder: the variables that its command reads and counts in.
//!
//! Knows: which variable of a control holds what. Must not know: how a bar is fed.

use serde::Deserialize;

use crate::schema::Confidence;

/// Variables of a bar feeder, by number. Lengths in them count in the units of the control's tables.
#[derive(Debug, Clone, PartialEq, Eq, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
pub struct BarFeederRules {
    /// Length of a part with its cutoff: what the bar is pushed by for the next part (`J`).
    pub part: u32,
    /// What a new bar is pushed by (`I`).
    pub initial_push: u32,
    /// What has to stay clamped behind the part (`K`).
    pub clamping: u32,
    /// What a new bar is pushed by when the initial push is zero.
    pub reference: u32,
    /// Parts after which the feeder stops; 0 for no limit.
    pub most_parts: u32,
    /// Bars after which the feeder stops; 0 for no limit.
    pub most_bars: u32,
    /// Length of bar after which the feeder stops; 0 for no limit.
    pub most_length: u32,
    /// Parts so far.
    pub parts: u32,
    /// Bars so far.
    pub bars: u32,
    /// Length of bar so far.
    pub run_length: u32,
    /// Length of the bar in use.
    pub bar_length: u32,
    /// Modes (`Q`) that belong into a program; the others set the feeder up.
    pub program_modes: Vec<u32>,
    /// How sure limits, counters and modes are.
    pub confidence: Confidence,
}

impl BarFeederRules {
    /// Every variable.
    pub fn variables(&self) -> [u32; 11] {
        let Self { part, initial_push, clamping, reference, most_parts, most_bars, .. } = *self;
        let Self { most_length, parts, bars, run_length, bar_length, .. } = *self;
        [
            part,
            initial_push,
            clamping,
            reference,
            most_parts,
            most_bars,
            most_length,
            parts,
            bars,
            run_length,
            bar_length,
        ]
    }
}
