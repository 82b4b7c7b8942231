//! The spindle, and the coolant that flows with it.
//!
//! Knows: speed and its limit, which way it turns, what else is on. Must not know: what speed a cut has.

use crate::event::Spindle;
use crate::lattice::Flat;
use crate::tracked::{Tracked, part};
use crate::value::{Domain, Truth};

part! {
    /// The spindle.
    #[derive(Debug, Clone)]
    pub(crate) struct SpindleState<D: Domain> {
        /// Turns a minute or metres a minute; 0 none given.
        pub(crate) speed: Tracked<D::Value>,
        /// Limit of constant surface speed, turns a minute; NaN unknown, infinite none.
        pub(crate) limit: Tracked<f64>,
        /// Which way it turns.
        pub(crate) way: Tracked<Flat<Spindle>>,
        /// A live tool turns.
        pub(crate) live_tool: Tracked<Truth>,
        /// The operator may override the speed.
        pub(crate) overridable: Tracked<Truth>,
    }
}

impl<D: Domain> SpindleState<D> {
    /// It stands, without a speed.
    pub(crate) fn stopped() -> Self {
        Self {
            speed: Tracked::new(D::number(0.0)),
            limit: Tracked::new(f64::INFINITY),
            way: Tracked::new(Flat::Known(Spindle::Stopped)),
            live_tool: Tracked::new(Truth::False),
            overridable: Tracked::new(Truth::True),
        }
    }

    /// It may do anything.
    pub(crate) fn forget(&mut self) {
        let Self { speed, limit, way, live_tool, overridable } = self;
        speed.put(D::unknown());
        limit.put(f64::NAN);
        way.put(Flat::Unknown);
        live_tool.put(Truth::Unknown);
        overridable.put(Truth::Unknown);
    }

    /// The same in another domain.
    pub(crate) fn map<E: Domain>(&self, change: &impl Fn(&D::Value) -> E::Value) -> SpindleState<E> {
        let Self { speed, limit, way, live_tool, overridable } = self;
        SpindleState {
            speed: speed.map(change),
            limit: limit.clone(),
            way: way.clone(),
            live_tool: live_tool.clone(),
            overridable: overridable.clone(),
        }
    }
}

part! {
    /// Coolant.
    #[derive(Debug, Clone)]
    pub(crate) struct CoolantState {
        pub(crate) mist: Tracked<Truth>,
        pub(crate) flood: Tracked<Truth>,
    }
}

impl CoolantState {
    /// Whether it flows.
    pub(crate) fn all(on: Truth) -> Self {
        Self { mist: Tracked::new(on), flood: Tracked::new(on) }
    }

    /// It may flow or not.
    pub(crate) fn forget(&mut self) {
        let Self { mist, flood } = self;
        mist.put(Truth::Unknown);
        flood.put(Truth::Unknown);
    }
}
