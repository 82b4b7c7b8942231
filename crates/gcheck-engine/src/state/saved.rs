//! Modes that a program saved, to bring them back later.
//!
//! Knows: what is kept. Must not know: the order in which it comes back.

use super::mode_set::ModeSet;
use super::path_mode::Blending;
use crate::eval::value::Truth;
use crate::event::Spindle;
use crate::lattice::{Flat, lattice};
use crate::model::Role;
use crate::position::Position;

lattice! {
    /// Modes saved by `M70` or `M73`.
    #[derive(Debug, Clone)]
    pub(crate) struct SavedModes {
        pub(crate) modes: [ModeSet; Role::COUNT],
        pub(crate) feed: f64,
        pub(crate) speed: f64,
        pub(crate) spindle: Flat<Spindle>,
        pub(crate) mist: Truth,
        pub(crate) flood: Truth,
        pub(crate) length: Position,
        pub(crate) feed_override: Truth,
        pub(crate) speed_override: Truth,
        pub(crate) blending: Blending,
        pub(crate) speed_limit: f64,
        pub(crate) adaptive: Truth,
        pub(crate) feed_hold: Truth,
    }
}
