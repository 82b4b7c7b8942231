//! The edge of the tool in the spindle: what is configured of it, and how it runs.
//!
//! Knows: which tool cuts, its teeth and ranges, the speed of the spindle. Must not know: any rule, which figures are sensible.

use gcheck_controls::Effect;
use gcheck_engine::{
    Abstract, At, Axis, Cutting, Domain, Event, Fact, FeedMode, Position, Role, Spindle, TravelKind, Truth,
    Units,
};
use gcheck_geometry::Mm;

use crate::PathCx;
use crate::facts::offset_schemes::whole;
use crate::facts::reach::feed;
use crate::facts::tool_comment::comment_at_work;

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

/// The feed for each turn of the spindle, millimetres, and its speed, 1/min: where both are one number.
pub(crate) fn feed_per_turn(cx: &PathCx<'_>) -> Option<(f64, f64)> {
    Abstract::known(cx.state().feed())?;
    let (turns, (feed, mode)) = (turns(cx)?, feed(cx)?);
    match mode {
        FeedMode::PerMinute => Some((feed / turns, turns)),
        FeedMode::PerRevolution => Some((feed, turns)),
        FeedMode::InverseTime => None,
    }
}

/// The block that gave feed or speed, whichever is later.
pub(crate) fn feed_or_speed_set_by(cx: &PathCx<'_>) -> Option<At> {
    [Fact::Feed, Fact::Speed].into_iter().filter_map(|fact| cx.definitions().set_by(fact)).max()
}

/// Does a move go at least as far across the tool as along it?
pub(crate) fn goes_across(from: &Position, to: &Position) -> bool {
    let way = |axis| match (from.get(axis), to.get(axis)) {
        (Some(from), Some(to)) => (to - from).abs(),
        _ => 0.0,
    };
    let across = way(Axis::X).hypot(way(Axis::Y));
    across > 0.0 && across >= way(Axis::Z)
}

/// The tool in the spindle with its diameter, where both are known.
pub(crate) fn diameter(cx: &PathCx<'_>) -> Option<(u32, Mm)> {
    let tool = Abstract::known(cx.state().tool()).and_then(whole)?;
    let diameter = cx.state().tables().tool(tool)?.size();
    (diameter.0 > 0.0).then_some((tool, diameter))
}

/// The tool in the spindle with its diameter, as the tables say or else its comment, and what then is taken for granted.
pub(crate) fn diameter_or_size(cx: &PathCx<'_>) -> Option<(u32, Mm, Option<String>)> {
    if let Some((tool, diameter)) = diameter(cx) {
        return Some((tool, diameter, None));
    }
    let tool = Abstract::known(cx.state().tool()).and_then(whole)?;
    let size = comment_at_work(cx)?.size(cx.state().units(cx.model))?;
    Some((tool, size, Some(format!("T{tool} is as wide as its comment says"))))
}

/// Is it a cut that a block makes by itself, at least as far across the tool as along it?
pub(crate) fn cuts_across(event: &Event) -> bool {
    match event {
        Event::Travel(travel) => {
            travel.kind == TravelKind::Feed && !travel.expanded && goes_across(&travel.from, &travel.to)
        }
        Event::Arc(arc) => !arc.expanded,
        _ => false,
    }
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
