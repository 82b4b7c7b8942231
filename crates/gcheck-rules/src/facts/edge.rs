//! The edge of the tool in the spindle: what is configured of it, and how it runs.
//!
//! Knows: which tool cuts, its teeth and ranges, the speed of the spindle. Must not know: any rule, which figures are sensible.

use gcheck_controls::Effect;
use gcheck_engine::{Abstract, Cutting, Domain, Role, Spindle, Truth, Units};

use crate::PathCx;
use crate::facts::offset_schemes::whole;

/// The tool in the spindle, with how it cuts; `None` where it is not known, or nothing is configured of it.
pub(crate) fn cutting<'c>(cx: &PathCx<'c>) -> Option<(u32, &'c Cutting)> {
    let tool = Abstract::known(cx.state().tool()).and_then(whole)?;
    Some((tool, cx.environment.machine.engine.cutting.get(&tool)?))
}

/// The speed of the spindle that turns the tool, 1/min, where it is one number.
pub(crate) fn turns(cx: &PathCx<'_>) -> Option<f64> {
    let state = cx.state();
    let is_turning = state.spindle().is_some_and(|spindle| spindle != Spindle::Stopped);
    let is_surface = state.effect(Role::SpindleMode, cx.model) == Some(Effect::SurfaceSpeed);
    let is_live = state.live_tool() != Truth::False;
    Abstract::known(state.speed()).filter(|turns| *turns > 0.0 && is_turning && !is_surface && !is_live)
}

/// Is the feed one number on every path?
pub(crate) fn is_one_feed(cx: &PathCx<'_>) -> bool {
    Abstract::known(cx.state().feed()).is_some()
}

/// A small length in the units of the program.
pub(crate) fn fine(cx: &PathCx<'_>, mm: f64) -> String {
    let (value, unit, decimals) = match cx.state().units(cx.model) {
        Some(Units::Inch) => (mm / 25.4, "in", 5),
        _ => (mm, "mm", 4),
    };
    let text = format!("{value:.decimals$}");
    format!("{} {unit}", text.trim_end_matches('0').trim_end_matches('.'))
}
