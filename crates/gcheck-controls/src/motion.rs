//! How a control moves axes: corners, rapid moves, look-ahead, what makes it stop.
//!
//! Knows: the choices of `[motion]` in `execution.toml`, and how sure they are. Must not know: how motion is planned
//! (`gcheck-planner`), or which control makes which choice (data).

use serde::Deserialize;

use crate::schema::Confidence;

/// `[motion]`: taken over from the base, or replaced as a whole.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
pub struct MotionRules {
    /// How corners are taken while the program does not say that they are exact.
    pub corners: CornerRules,
    /// The same while the control looks ahead on command (`G05.1 Q1`, `G08 P1`).
    #[serde(default)]
    pub contour: Option<CornerRules>,
    /// How rapid moves are made.
    pub rapids: RapidRules,
    /// How many stretches of path are known ahead of the tool.
    pub look_ahead: u32,
    /// Seconds: stretches that take less are run with one even change of speed. 0 for none.
    #[serde(default)]
    pub even_below: f64,
    /// Seconds: no stretch is run in less. 0 for no such limit.
    #[serde(default)]
    pub shortest: f64,
    /// How it taps.
    pub taps: TapRules,
    /// When it waits for the spindle.
    pub spindle_wait: SpindleWaitRules,
    /// Seconds from the end of a move that the axes stop after to the start of what they stop for. 0 for none.
    #[serde(default)]
    pub halt_time: f64,
    /// What the axes stop for, besides dwells, stops and tool changes.
    pub halts: Vec<Halt>,
    /// Where this comes from.
    pub source: String,
    /// How sure it is.
    pub confidence: Confidence,
}

impl MotionRules {
    /// Does any of it rest on nothing that was read or seen?
    pub fn is_assumed(&self) -> bool {
        self.confidence == Confidence::Assumed
    }
}

/// How corners are taken.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(tag = "kind", deny_unknown_fields, rename_all = "kebab-case", rename_all_fields = "kebab-case")]
pub enum CornerRules {
    /// On arcs inside a tolerance.
    Rounded {
        /// The numbered setting that holds the tolerance while the program gives none.
        #[serde(default)]
        tolerance_setting: Option<String>,
        /// The tolerance, millimetres, where neither program nor setting give one; without it, see the next field.
        #[serde(default)]
        tolerance: Option<f64>,
        /// Without any tolerance: the part of a move's length that its corner may be off.
        part_of_length: f64,
        /// Arcs are as long as the way of two overlapping moves would be, else no wider than their speed needs.
        #[serde(default)]
        stretched: bool,
        /// Where a side of a corner curves the way the corner turns, this part of the side's own turn counts with that of
        /// the corner: of the side before it, and of the side after it.
        #[serde(default)]
        curve_shares: [f64; 2],
        /// Degrees: a corner of two arcs that counts as a sharper one is not rounded. Without it every corner is.
        #[serde(default)]
        sharpest_between_arcs: Option<f64>,
        /// The part of the acceleration that turns the path on arcs.
        across: f64,
        /// The part that is left along an arc where `across` is used up.
        along: f64,
        /// Once both ends of an arc are known, what they leave of the acceleration is divided again between turning and
        /// running along, and a helix counts as the wider the more it rises.
        #[serde(default)]
        divides: bool,
        /// Corners are passed without rounding where the axes' speeds change by no more than this part of what their
        /// acceleration changes in a cycle.
        unrounded: f64,
        /// Seconds of a cycle.
        cycle: f64,
        /// What is left of a move between two rounded corners belongs to the second one when it takes fewer cycles.
        #[serde(default)]
        least_cycles: f64,
        /// Moves that cannot be rounded overlap.
        #[serde(default)]
        overlaps: bool,
    },
    /// On the corner itself, at a speed at which no axis changes its own by more than this, millimetres (or degrees) a
    /// minute.
    Slowed {
        /// The change.
        change: f64,
    },
    /// Not at all: the axes follow the interpolated point with accelerations of their own.
    Filtered {},
}

/// How rapid moves are made.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum RapidRules {
    /// Straight, and joined with their neighbours as moves at feed are.
    Joined,
    /// Straight, with a stop at both ends.
    Straight,
    /// Each axis for itself, with a stop at both ends.
    ByAxis,
}

/// How a control taps.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum TapRules {
    /// The spindle comes to rest at the bottom.
    RestAtBottom,
    /// It is reversed at the bottom, and the tap runs on until it turns the other way.
    RunOut,
}

/// When a control waits for the spindle to reach its speed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum SpindleWaitRules {
    /// At once.
    AtOnce,
    /// Ahead of the next move at feed.
    AtFeed,
}

/// Something between moves that the axes stop for.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Halt {
    /// The spindle starts, stops or turns round.
    Spindle,
    /// Its speed changes.
    SpindleSpeed,
    /// Coolant, chuck and the shop's own commands.
    Auxiliary,
    /// Another work coordinate system.
    WorkOffset,
    /// A shift of the work coordinates (`G92`, `G52`).
    Shift,
    /// Another tool offset.
    ToolOffset,
    /// An output that is set at once.
    Output,
    /// A message for the operator.
    Message,
    /// A tool is called for.
    ToolCall,
}
