//! How fast the axes of a machine can follow a path.
//!
//! Knows: the rates and accelerations that are configured, lengths of ways as feeds mean them. Must not know: any rule, what a
//! program asks for.

use std::f64::consts::TAU;

use gcheck_controls::{Effect, FeedWithRotary};
use gcheck_engine::{Abstract, ArcMove, Axis, Domain, FeedMode, Machine, Position, Role, Spindle, Units};

use crate::PathCx;

/// A speed along a path that the machine does not exceed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Reach {
    /// Millimetres a minute; degrees where only rotary axes move.
    pub(crate) speed: f64,
    /// What keeps it there.
    pub(crate) holder: Holder,
}

/// What keeps a speed low.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Holder {
    /// The machine's highest feed.
    MaxFeed,
    /// The rapid rate of an axis.
    Axis(Axis),
    /// The acceleration of the axes, on a circle this small.
    Turn,
    /// The acceleration of the axes, on a way this short between two stops.
    Stops,
}

impl Holder {
    /// As messages name it: "the machine feeds", "Z moves".
    pub(crate) fn words(self) -> String {
        match self {
            Self::MaxFeed => "the machine feeds".to_owned(),
            Self::Axis(axis) if axis.is_rotary() => format!("{} turns", axis.name()),
            Self::Axis(axis) => format!("{} moves", axis.name()),
            Self::Turn => "this arc allows".to_owned(),
            Self::Stops => "the axes come to".to_owned(),
        }
    }
}

/// The lower one.
pub(crate) fn lower(one: Option<Reach>, other: Option<Reach>) -> Option<Reach> {
    match (one, other) {
        (Some(a), Some(b)) => Some(if b.speed < a.speed { b } else { a }),
        (one, other) => one.or(other),
    }
}

/// The rapid rate of an axis, as far as it is configured: millimetres or degrees a minute.
pub(crate) fn rate(machine: &Machine, axis: Axis) -> Option<f64> {
    let own = machine.dynamics.rapid.get(&axis).copied();
    let usual =
        if axis.is_rotary() { machine.dynamics.rotary_rapid } else { machine.rapid.map(|rate| rate.0) };
    own.or(usual)
}

/// The way of each axis, in the order of [`Axis::ALL`]; `None` where one is known at one end only.
fn ways(from: &Position, to: &Position) -> Option<[f64; 9]> {
    let mut ways = [0.0; 9];
    for (way, (from, to)) in ways.iter_mut().zip(from.values().iter().zip(to.values())) {
        if from.is_nan() != to.is_nan() {
            return None;
        }
        // An axis of which nothing is known does not move here.
        *way = if from.is_nan() { 0.0 } else { (to - from).abs() };
    }
    Some(ways)
}

/// The length of a straight way as feeds mean it: X, Y and Z; else U, V and W; else A, B and C in degrees.
fn measure(ways: &[f64; 9]) -> Option<f64> {
    let of = |axes: [Axis; 3]| {
        axes.iter().filter_map(|axis| ways.get(axis.index())).fold(0.0_f64, |sum, way| sum.hypot(*way))
    };
    let groups = [[Axis::X, Axis::Y, Axis::Z], [Axis::U, Axis::V, Axis::W], [Axis::A, Axis::B, Axis::C]];
    groups.into_iter().map(of).find(|length| *length > 0.0)
}

/// The same between two points; `None` where nothing moves, or one of them is not known.
pub(crate) fn length(from: &Position, to: &Position) -> Option<f64> {
    measure(&ways(from, to)?)
}

/// Does a straight way turn rotary axes, and nothing else? Its speed is in degrees a minute then.
pub(crate) fn only_turns(from: &Position, to: &Position) -> bool {
    ways(from, to).is_some_and(|ways| {
        let moves = |rotary: bool| {
            Axis::ALL.into_iter().zip(ways).any(|(axis, way)| axis.is_rotary() == rotary && way > 0.0)
        };
        moves(true) && !moves(false)
    })
}

/// How far an axis goes along a straight way, where that is known.
pub(crate) fn way(from: &Position, to: &Position, axis: Axis) -> Option<f64> {
    ways(from, to)?.get(axis.index()).copied()
}

/// How long a feed makes a straight way take, minutes; `None` where the control's books do not say how it counts.
pub(crate) fn minutes(cx: &PathCx<'_>, from: &Position, to: &Position) -> Option<f64> {
    let (number, mode) = feed(cx)?;
    let ways = ways(from, to)?;
    let length = measure(&ways)?;
    match mode {
        FeedMode::InverseTime => return Some(1.0 / number),
        FeedMode::PerRevolution => return None,
        FeedMode::PerMinute => {}
    }
    let turned = Axis::ALL.into_iter().zip(ways).filter(|(axis, _)| axis.is_rotary());
    let turned = turned.fold(0.0_f64, |sum, (_, way)| sum.hypot(way));
    let is_pure = only_turns(from, to);
    if turned == 0.0 || !is_pure && feeds_the_tip(cx) {
        return Some(length / number);
    }
    // The feed in effect is in millimetres; a degree counts as much as the unit of the program.
    let turned = turned * cx.state().units(cx.model)?.in_mm();
    match cx.model.semantics().feed_with_rotary? {
        _ if is_pure => Some(turned / number),
        FeedWithRotary::LinearAxes => Some(length / number),
        FeedWithRotary::AllAxes => Some(length.hypot(turned) / number),
    }
}

/// Is the feed that of the tool along the part, however the axes move for it?
fn feeds_the_tip(cx: &PathCx<'_>) -> bool {
    let state = cx.state();
    state.effect(Role::Length, cx.model) == Some(Effect::ToolCentrePoint)
        || state.effect(Role::Cylinder, cx.model) == Some(Effect::CylinderMapping)
}

/// Do the linear axes go where the words say? Modes that tilt the plane or follow the tip of the tool move them elsewhere.
pub(crate) fn moves_as_written(cx: &PathCx<'_>) -> bool {
    let state = cx.state();
    let is = |role, on: &[Effect]| state.effect(role, cx.model).is_none_or(|effect| on.contains(&effect));
    !is(Role::Length, &[Effect::ToolCentrePoint, Effect::LengthFiveAxis])
        && !is(Role::TiltedPlane, &[Effect::TiltedPlaneOn])
        && !is(Role::DynamicOffset, &[Effect::DynamicOffsetOn])
        && !is(Role::Cylinder, &[Effect::CylinderMapping])
}

/// May the words of the rotary axis be lengths, or those of a linear axis be turns?
pub(crate) fn is_on_the_face(cx: &PathCx<'_>) -> bool {
    let effect = cx.state().effect(Role::PolarInterpolation, cx.model);
    effect.is_none_or(|effect| effect == Effect::PolarInterpolationOn)
}

/// The highest speed along a straight way, by the rates of its axes.
pub(crate) fn along(machine: &Machine, from: &Position, to: &Position) -> Option<Reach> {
    along_axes(machine, from, to, |_| true)
}

/// The same by the rates of some axes alone.
pub(crate) fn along_axes(
    machine: &Machine,
    from: &Position,
    to: &Position,
    counts: impl Fn(Axis) -> bool,
) -> Option<Reach> {
    let ways = ways(from, to)?;
    let length = measure(&ways)?;
    let moving = Axis::ALL.into_iter().zip(ways).filter(|(axis, way)| *way > 0.0 && counts(*axis));
    let by_axis = moving.filter_map(|(axis, way)| {
        rate(machine, axis).map(|rate| Reach { speed: rate * length / way, holder: Holder::Axis(axis) })
    });
    by_axis.fold(None, |lowest, reach| lower(lowest, Some(reach)))
}

/// The highest feed of the machine.
pub(crate) fn by_feed(machine: &Machine) -> Option<Reach> {
    machine.max_feed.map(|feed| Reach { speed: feed.0, holder: Holder::MaxFeed })
}

/// The highest speed on an arc of half a turn or less: the acceleration of both axes turns the direction.
pub(crate) fn around(machine: &Machine, arc: &ArcMove) -> Option<Reach> {
    let (first, second, _) = arc.plane.axes();
    let from = arc.from.values();
    let axes = [Axis::X, Axis::Y, Axis::Z];
    let gains = [first, second].map(|ix| {
        axes.into_iter().nth(ix).and_then(|axis| machine.dynamics.acceleration.get(&axis).copied())
    });
    let [Some(one), Some(other)] = gains else { return None };
    let (dx, dy) = (from.get(first)? - arc.centre.0.0, from.get(second)? - arc.centre.1.0);
    let speed = (one.min(other) * dx.hypot(dy)).sqrt() * 60.0;
    speed.is_finite().then_some(Reach { speed, holder: Holder::Turn })
}

/// The highest speed on a straight way between two stops.
pub(crate) fn between_stops(machine: &Machine, from: &Position, to: &Position) -> Option<Reach> {
    let ways = ways(from, to)?;
    let length = measure(&ways)?;
    let mut gain = f64::INFINITY;
    for (axis, way) in Axis::ALL.into_iter().zip(ways).filter(|(_, way)| *way > 0.0) {
        gain = gain.min(machine.dynamics.acceleration.get(&axis)? * length / way);
    }
    Some(Reach { speed: (gain * length).sqrt() * 60.0, holder: Holder::Stops })
}

/// The lowest speed of the spindle that a move may have, 1/min, as far as it is certain: under constant surface speed where
/// the tool is nearest to the centre. `None` where it may be stopped.
pub(crate) fn turns(cx: &PathCx<'_>, from: &Position, to: &Position) -> Option<f64> {
    let state = cx.state();
    let machine = &cx.environment.machine.engine;
    if state.spindle().is_none_or(|spindle| spindle == Spindle::Stopped) {
        return None;
    }
    let (lowest, _) = Abstract::bounds(state.speed())?;
    let most = machine.max_rpm.map_or(f64::INFINITY, |most| most.0);
    let code = state.mode(Role::SpindleMode).only()?;
    let turns = if cx.model.effect(code) == Effect::SurfaceSpeed {
        let metres = if state.units(cx.model)? == Units::Inch { lowest * 0.3048 } else { lowest };
        let radius = from.get(Axis::X)?.abs().min(to.get(Axis::X)?.abs());
        (metres * 1000.0 / (TAU * radius)).min(state.speed_limit())
    } else {
        lowest
    };
    Some(turns.min(most)).filter(|turns| turns.is_finite() && *turns > 0.0)
}

/// The lowest feed that a move may have, with its mode.
pub(crate) fn feed(cx: &PathCx<'_>) -> Option<(f64, FeedMode)> {
    let (lowest, _) = Abstract::bounds(cx.state().feed())?;
    Some((lowest, cx.state().feed_mode(cx.model)?)).filter(|(lowest, _)| *lowest > 0.0)
}

#[cfg(test)]
mod tests {
    use gcheck_engine::{Axis, Machine, Position};
    use gcheck_geometry::MmPerMin;

    use super::{Holder, along};

    fn machine() -> Machine {
        let mut machine = Machine { rapid: Some(MmPerMin(1000.0)), ..Machine::default() };
        machine.dynamics.rapid.insert(Axis::Z, 500.0);
        machine
    }

    fn speed(x: f64, z: f64) -> (f64, Holder) {
        let mut to = Position::ZERO;
        to.set(Axis::X, x);
        to.set(Axis::Z, z);
        let reach = along(&machine(), &Position::ZERO, &to).unwrap();
        (reach.speed, reach.holder)
    }

    #[test]
    fn the_slower_axis_decides_and_a_diagonal_is_faster_than_an_axis() {
        assert_eq!(speed(10.0, 0.0), (1000.0, Holder::Axis(Axis::X)));
        assert_eq!(speed(0.0, 10.0), (500.0, Holder::Axis(Axis::Z)));
        let (both, holder) = speed(3.0, 4.0);
        assert!((both - 625.0).abs() < 1e-9);
        assert_eq!(holder, Holder::Axis(Axis::Z));
    }
}
