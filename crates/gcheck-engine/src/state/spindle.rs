//! The spindle, and the coolant that flows with it.
//!
//! Knows: speed and its limit, which way it turns, what else is on. Must not know: what speed a cut has.

use crate::eval::value::{Domain, Truth};
use crate::event::Spindle;
use crate::lattice::{Flat, lattice};

lattice! {
    /// The spindle.
    #[derive(Debug, Clone)]
    pub(crate) struct SpindleState<D: Domain> {
        /// Turns a minute or metres a minute; 0 none given.
        pub(crate) speed: D::Value,
        /// Limit of constant surface speed, turns a minute; NaN unknown, infinite none.
        pub(crate) limit: f64,
        /// Which way it turns.
        pub(crate) way: Flat<Spindle>,
        /// A live tool turns.
        pub(crate) live_tool: Truth,
        /// The operator may override the speed.
        pub(crate) overridable: Truth,
    }
}

impl<D: Domain> SpindleState<D> {
    /// It stands, without a speed.
    pub(crate) fn stopped() -> Self {
        Self {
            speed: D::number(0.0),
            limit: f64::INFINITY,
            way: Flat::Known(Spindle::Stopped),
            live_tool: Truth::False,
            overridable: Truth::True,
        }
    }

    /// It may do anything.
    pub(crate) fn forget(&mut self) {
        let Self { speed, limit, way, live_tool, overridable } = self;
        *speed = D::unknown();
        *limit = f64::NAN;
        *way = Flat::Unknown;
        *live_tool = Truth::Unknown;
        *overridable = Truth::Unknown;
    }

    /// The same in another domain.
    pub(crate) fn map<E: Domain>(&self, change: &impl Fn(&D::Value) -> E::Value) -> SpindleState<E> {
        let Self { speed, limit, way, live_tool, overridable } = self;
        SpindleState {
            speed: change(speed),
            limit: *limit,
            way: *way,
            live_tool: *live_tool,
            overridable: *overridable,
        }
    }
}

lattice! {
    /// Coolant.
    #[derive(Debug, Clone)]
    pub(crate) struct CoolantState {
        pub(crate) mist: Truth,
        pub(crate) flood: Truth,
        /// Through the spindle.
        pub(crate) through: Truth,
    }
}

impl CoolantState {
    /// Whether it flows.
    pub(crate) fn all(on: Truth) -> Self {
        Self { mist: on, flood: on, through: on }
    }

    /// It may flow or not.
    pub(crate) fn forget(&mut self) {
        let Self { mist, flood, through } = self;
        *mist = Truth::Unknown;
        *flood = Truth::Unknown;
        *through = Truth::Unknown;
    }
}
