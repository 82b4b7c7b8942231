//! How long a machine really takes for a path: acceleration, corners, look-ahead, spindle, tool changes.
//!
//! Knows: moves and what happens between them, and a machine with its control. Must not know: programs, codes, names of
//! controls, where its figures come from, how times are shown.
//!
//! A [`Planner`] takes [`Item`]s in order and hands out a [`Span`] for each stretch of time, later ones only once enough is
//! known of what follows. `docs/time.md` describes the model and says where it holds.

mod axes;
mod changer;
mod corner;
mod feeding;
mod item;
mod jerk;
mod machine;
mod merge;
mod planner;
mod profile;
mod segment;
mod share;
mod spindle;
mod window;

pub use axes::{AXES, Point};
pub use item::{Drive, Item, Meeting, Move};
pub use machine::{
    BadLimit, Changer, Control, Corners, Limits, Machine, Rapids, Rounding, Slowing, SpindleLimits,
    SpindleWait, Taps,
};
pub use planner::{Cause, Planner, Span};
pub use profile::Profile;
pub use share::Shares;
