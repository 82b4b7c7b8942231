//! A line of a move list, before it is text.
//!
//! Knows: which events are lines and what is in them. Must not know: how a line is written.

use gcheck_engine::{Axis, Coolant, Cylinder, Event, FeedMode, Position, Spindle, Stop, Units};
use gcheck_geometry::{Arc, Plane};

use crate::motion::{Motion, Way};
use crate::step::Step;
use crate::time::{Clock, Timing, metres};

/// What a line of a move list tells of.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Kind {
    /// A rapid move.
    Rapid,
    /// A straight move at feed, or tied to the spindle.
    Feed,
    /// A circular or helical move.
    Arc,
    /// Standing still.
    Dwell,
    /// A move that ends at a signal.
    Probe,
    /// A tool in the spindle.
    Tool,
    /// The spindle.
    Spindle,
    /// Coolant.
    Coolant,
    /// An axis wrapped around a cylinder, or no longer.
    Wrap,
    /// A pocket that the control clears by a path of its own.
    Pocket,
    /// Chuck and bar feeder.
    Bar,
    /// Text for the operator or a printer.
    Message,
    /// The program stops.
    Stop,
    /// The program ends.
    End,
}

impl Kind {
    /// Its name in every format.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Rapid => "rapid",
            Self::Feed => "feed",
            Self::Arc => "arc",
            Self::Dwell => "dwell",
            Self::Probe => "probe",
            Self::Tool => "tool",
            Self::Spindle => "spindle",
            Self::Coolant => "coolant",
            Self::Wrap => "wrap",
            Self::Pocket => "pocket",
            Self::Bar => "bar",
            Self::Message => "message",
            Self::Stop => "stop",
            Self::End => "end",
        }
    }
}

/// A line.
#[derive(Debug, Clone)]
pub(crate) struct Record<'a> {
    pub(crate) kind: Kind,
    pub(crate) path: Option<Path>,
    /// Seconds; NaN unknown.
    pub(crate) seconds: f64,
    /// What happens, where the kind leaves it open.
    pub(crate) action: Option<&'static str>,
    /// A number that belongs to the action, with its name; NaN unknown.
    pub(crate) value: Option<(&'static str, f64)>,
    pub(crate) text: Option<&'a str>,
}

/// The movement of a line.
#[derive(Debug, Clone)]
pub(crate) struct Path {
    pub(crate) from: Position,
    pub(crate) programmed: Position,
    pub(crate) to: Position,
    pub(crate) machine: Position,
    /// In program units, with its mode; `None` where no feed applies.
    pub(crate) feed: Option<(f64, FeedMode)>,
    pub(crate) arc: Option<Arc>,
}

impl Path {
    /// Centre of the arc: X, Y, Z in millimetres, on the level of its start.
    pub(crate) fn centre(arc: &Arc) -> [f64; 3] {
        arc.centre_xyz().map(|mm| mm.0)
    }

    /// The axis the arc turns about; counter-clockwise is positive about it.
    pub(crate) const fn normal(arc_plane: Plane) -> [u8; 3] {
        match arc_plane {
            Plane::Xy => [0, 0, 1],
            Plane::Zx => [0, 1, 0],
            Plane::Yz => [1, 0, 0],
        }
    }
}

/// Turns events into lines.
#[derive(Debug)]
pub(crate) struct Recorder {
    clock: Clock,
    /// Lines so far.
    pub(crate) count: u64,
}

impl Recorder {
    pub(crate) fn new(timing: Timing) -> Self {
        Self { clock: Clock::new(timing), count: 0 }
    }

    /// Calls `each` for every line of the event, with its number counted from 1.
    pub(crate) fn records<E>(
        &mut self,
        step: &Step<'_>,
        mut each: impl FnMut(u64, &Record<'_>) -> Result<(), E>,
    ) -> Result<(), E> {
        let mut outcome = Ok(());
        let mut count = self.count;
        let tracker = self.clock.tracker;
        let clock = &self.clock;
        tracker.motions(step, |motion| {
            if outcome.is_ok() {
                count += 1;
                outcome = each(count, &of_motion(clock, step, motion));
            }
        });
        if outcome.is_ok()
            && let Some(record) = of_event(clock, step)
        {
            count += 1;
            outcome = each(count, &record);
        }
        self.count = count;
        self.clock.after(step);
        outcome
    }
}

fn of_motion(clock: &Clock, step: &Step<'_>, motion: &Motion) -> Record<'static> {
    let kind = match motion.way {
        Way::Rapid => Kind::Rapid,
        Way::Probe => Kind::Probe,
        _ if motion.arc.is_some() => Kind::Arc,
        Way::Feed | Way::Thread | Way::Tap(_) => Kind::Feed,
    };
    Record {
        kind,
        path: Some(Path {
            from: motion.from,
            programmed: motion.programmed,
            to: motion.to,
            machine: motion.machine,
            feed: clock.feed_of(step, motion).map(|(feed, mode)| (in_program(feed, mode, step.units), mode)),
            arc: motion.arc,
        }),
        seconds: clock.motion(step, motion).map_or(f64::NAN, |seconds| seconds.0),
        action: None,
        value: None,
        text: None,
    }
}

/// A feed in the units of the program.
fn in_program(feed: f64, mode: FeedMode, units: Units) -> f64 {
    if mode == FeedMode::InverseTime { feed } else { feed / units.in_mm() }
}

fn of_event<'a>(clock: &Clock, step: &Step<'a>) -> Option<Record<'a>> {
    let number = |tool: Option<u32>| tool.map_or(f64::NAN, f64::from);
    let mut text = None;
    let (kind, action, value) = match step.event {
        Event::Dwell(_) => (Kind::Dwell, None, None),
        Event::ToolChange(tool) => (Kind::Tool, Some("change"), Some(("tool", number(*tool)))),
        Event::SetToolNumber(tool) => (Kind::Tool, Some("set"), Some(("tool", number(*tool)))),
        Event::Spindle(spindle) => {
            let action = match spindle {
                Spindle::Clockwise => "clockwise",
                Spindle::CounterClockwise => "counter-clockwise",
                Spindle::Stopped => "stop",
            };
            (Kind::Spindle, Some(action), None)
        }
        Event::SpindleSpeed(speed) => match clock.surface_speed() {
            None => (Kind::Spindle, Some("speed"), Some(("rpm", *speed))),
            Some(_) => {
                (Kind::Spindle, Some("speed"), Some(("metres_per_minute", metres(*speed, step.units))))
            }
        },
        Event::OrientSpindle { angle, .. } => (Kind::Spindle, Some("orient"), Some(("degrees", *angle))),
        Event::Coolant { kind, on } => {
            let action = match (kind, on) {
                (Coolant::Mist, true) => "mist-on",
                (Coolant::Mist, false) => "mist-off",
                (Coolant::Flood, true) => "flood-on",
                (Coolant::Flood, false) => "flood-off",
                (Coolant::Through, true) => "through-on",
                (Coolant::Through, false) => "through-off",
            };
            (Kind::Coolant, Some(action), None)
        }
        Event::Cleared(clearing) => {
            text = Some("an estimate: the path is the control's own");
            (Kind::Pocket, Some("cut"), Some(("length", clearing.length.0 / step.units.in_mm())))
        }
        Event::Cylinder(None) => (Kind::Wrap, Some("off"), None),
        Event::Cylinder(Some(cylinder)) => {
            text = Some(axes_of(cylinder));
            let diameter = cylinder.diameter / step.units.in_mm();
            (Kind::Wrap, Some("on"), Some(("diameter", diameter)))
        }
        Event::Chuck(clamped) => (Kind::Bar, Some(if *clamped { "clamp" } else { "unclamp" }), None),
        Event::BarSetup(mode) => (Kind::Bar, Some("setup"), Some(("mode", number(*mode)))),
        Event::BarUnload(rest) => (Kind::Bar, Some("unload"), Some(("remnant", rest.0 / step.units.in_mm()))),
        Event::BarLoad => (Kind::Bar, Some("load"), None),
        Event::BarPush(by) => (Kind::Bar, Some("push"), Some(("length", by.0 / step.units.in_mm()))),
        Event::Stop(kind) => {
            let action = match kind {
                Stop::Program => "program",
                Stop::Optional => "optional",
                Stop::Pallet => "pallet",
                Stop::Message(message) => {
                    text = Some(&**message);
                    "message"
                }
            };
            (Kind::Stop, Some(action), None)
        }
        Event::Message(message) => {
            text = Some(&**message);
            (Kind::Message, None, None)
        }
        Event::End => (Kind::End, None, None),
        _ => return None,
    };
    let seconds = match step.event {
        Event::Dwell(seconds) if !seconds.is_finite() => f64::NAN,
        Event::Cleared(clearing) if !clearing.seconds.is_finite() => f64::NAN,
        _ => clock.still(step).0,
    };
    Some(Record { kind, path: None, seconds, action, value, text })
}

/// Which axis is wrapped, and which turns.
fn axes_of(cylinder: &Cylinder) -> &'static str {
    match (cylinder.linear, cylinder.rotary) {
        (Axis::X, Axis::A) => "X on A",
        (Axis::X, Axis::B) => "X on B",
        (Axis::X, _) => "X on C",
        (Axis::Y, Axis::A) => "Y on A",
        (Axis::Y, Axis::B) => "Y on B",
        (Axis::Y, _) => "Y on C",
        (_, Axis::A) => "Z on A",
        (_, Axis::B) => "Z on B",
        _ => "Z on C",
    }
}
