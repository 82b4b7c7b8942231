//! How long movements take.
//!
//! Knows: feeds in their modes and their override, rapid rates, leads, surface speed, dwells, tool changes. Must not know:
//! acceleration, which no program tells: real times are longer.

use std::f64::consts::PI;

use gcheck_engine::{Axis, Event, FeedMode, Machine, Model, Override, Units};
use gcheck_geometry::{Mm, MmPerMin, Seconds};

use crate::motion::{Cover, Motion, Tracker, Way, cover};
use crate::step::Step;

/// Rapid rate of a linear axis that nobody configured: 1000 inches a minute, usual for machining centres.
pub const DEFAULT_RAPID: MmPerMin = MmPerMin(25_400.0);
/// Rapid rate of a rotary axis that nobody configured, degrees a minute: 10 turns.
pub const DEFAULT_ROTARY_RAPID: f64 = 3_600.0;
/// Time of a tool change that nobody configured.
pub const DEFAULT_TOOL_CHANGE: Seconds = Seconds(5.0);

/// What the machine takes for what a program does not time.
#[derive(Debug, Clone, Copy, PartialEq)]
#[expect(
    clippy::struct_excessive_bools,
    reason = "three figures that may be assumed, each by itself, and a choice of the control"
)]
pub struct Timing {
    /// By axis: millimetres or degrees a minute.
    rapid: [f64; 9],
    tool_change: Seconds,
    pub(crate) rapid_assumed: bool,
    pub(crate) rotary_assumed: bool,
    pub(crate) tool_change_assumed: bool,
    /// The feed of a helix is measured along its circle, not along its path.
    helix_by_circle: bool,
    /// Part of the programmed feed that is run.
    feed_override: f64,
}

impl Timing {
    /// With the rapid rate of every linear axis and the time of a tool change; what is not given, or makes no sense, is
    /// assumed and said to be.
    pub fn new(rapid: Option<MmPerMin>, tool_change: Option<Seconds>) -> Self {
        let rapid = rapid.filter(|rate| rate.is_finite() && rate.0 > 0.0);
        let tool_change = tool_change.filter(|time| time.is_finite() && time.0 >= 0.0);
        let linear = rapid.unwrap_or(DEFAULT_RAPID).0;
        Self {
            rapid: Axis::ALL.map(|axis| if axis.is_rotary() { DEFAULT_ROTARY_RAPID } else { linear }),
            tool_change: tool_change.unwrap_or(DEFAULT_TOOL_CHANGE),
            rapid_assumed: rapid.is_none(),
            rotary_assumed: true,
            tool_change_assumed: tool_change.is_none(),
            helix_by_circle: false,
            feed_override: 1.0,
        }
    }

    /// Of a control with a machine: its rates, and how it measures the feed of helices.
    pub fn of_machine(model: &Model<'_>, machine: &Machine) -> Self {
        let dynamics = &machine.dynamics;
        let mut timing = Self::new(machine.rapid, machine.tool_change);
        if let Some(rate) = dynamics.rotary_rapid {
            timing = timing.with_rotary_rapid(rate);
        }
        for (axis, rate) in &dynamics.rapid {
            timing = timing.with_axis_rapid(*axis, *rate);
        }
        if let Some(percent) = dynamics.feed_override {
            timing = timing.with_feed_override(percent);
        }
        if model.feeds_helix_by_circle(&machine.settings) { timing.with_helix_by_circle() } else { timing }
    }

    /// With the feed of a helix measured along its circle in the plane, so that the tool itself is faster; along the path of
    /// the tool without this.
    #[must_use]
    pub const fn with_helix_by_circle(mut self) -> Self {
        self.helix_by_circle = true;
        self
    }

    /// With the position of the feed override switch, in percent, 100 without this. It does not count where the program
    /// switches it off, nor for rapid moves, threads and taps.
    #[must_use]
    pub fn with_feed_override(mut self, percent: f64) -> Self {
        if percent.is_finite() && percent >= 0.0 {
            self.feed_override = percent / 100.0;
        }
        self
    }

    /// With the rapid rate of the rotary axes, degrees a minute.
    #[must_use]
    pub fn with_rotary_rapid(mut self, degrees_per_minute: f64) -> Self {
        if degrees_per_minute.is_finite() && degrees_per_minute > 0.0 {
            for (axis, rate) in Axis::ALL.into_iter().zip(&mut self.rapid) {
                if axis.is_rotary() {
                    *rate = degrees_per_minute;
                }
            }
            self.rotary_assumed = false;
        }
        self
    }

    /// With the rapid rate of one axis, millimetres or degrees a minute.
    #[must_use]
    pub fn with_axis_rapid(mut self, axis: Axis, rate: f64) -> Self {
        if let Some(slot) = self.rapid.get_mut(axis.index()).filter(|_| rate.is_finite() && rate > 0.0) {
            *slot = rate;
        }
        self
    }

    /// Part of the programmed feed that is run.
    pub(crate) const fn feed_override(&self) -> f64 {
        self.feed_override
    }

    /// Time of a tool change.
    pub const fn tool_change(&self) -> Seconds {
        self.tool_change
    }

    /// Rapid rate of X.
    pub fn rapid(&self) -> MmPerMin {
        MmPerMin(self.rapid.first().copied().unwrap_or(DEFAULT_RAPID.0))
    }

    /// Rapid rate of an axis, millimetres or degrees a minute.
    pub(crate) fn axis_rapid(&self, axis: Axis) -> f64 {
        self.rapid.get(axis.index()).copied().unwrap_or(DEFAULT_RAPID.0)
    }

    /// Every axis runs at its own rate; the movement is over when the last one has arrived.
    fn rapid_seconds(&self, motion: &Motion, still: Option<Axis>) -> f64 {
        let times = Axis::ALL.into_iter().zip(self.rapid).filter(|(axis, _)| Some(*axis) != still);
        let times = times.map(|(axis, rate)| {
            let way = motion.way_of(axis);
            // An axis that is unknown at both ends does not count; at one end, the movement is not timed at all.
            if way.is_nan() { 0.0 } else { way / rate * 60.0 }
        });
        times.fold(0.0, f64::max)
    }
}

/// Why a movement has no time.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Untimed {
    /// It starts or ends at an unknown point.
    Point,
    /// No feed, an unknown one, or zero.
    Feed,
    /// It depends on the spindle's speed, which is unknown or zero.
    Speed,
}

/// Times events. Has to see every event of the run, in order.
#[derive(Debug, Clone)]
pub struct Clock {
    pub(crate) timing: Timing,
    pub(crate) tracker: Tracker,
    /// Lead in effect, millimetres a turn.
    lead: Option<f64>,
    /// Limit of constant surface speed when that is on.
    surface: Option<f64>,
    /// `S` read as a surface speed: metres a minute.
    speed: f64,
    tool: Option<u32>,
    /// The program, or a cycle, has the feed override switched off.
    override_off: bool,
}

impl Clock {
    /// Starts at the start of a run.
    pub fn new(timing: Timing) -> Self {
        Self {
            timing,
            tracker: Tracker::default(),
            lead: None,
            surface: None,
            speed: f64::NAN,
            tool: None,
            override_off: false,
        }
    }

    /// The time that an event takes.
    ///
    /// # Errors
    ///
    /// Why one of its movements cannot be timed.
    pub fn step(&mut self, step: &Step<'_>) -> Result<Seconds, Untimed> {
        let mut total = Ok(self.still(step));
        let (clock, tracker) = (&*self, self.tracker);
        tracker.motions(step, |motion| {
            total = match (total, clock.motion(step, motion)) {
                (Ok(sum), Ok(seconds)) => Ok(sum + seconds),
                (Err(why), _) | (_, Err(why)) => Err(why),
            };
        });
        self.after(step);
        total
    }

    /// To be called after an event was looked at.
    pub(crate) fn after(&mut self, step: &Step<'_>) {
        self.tracker.after(step);
        match step.event {
            Event::SpindleSync { lead, .. } => self.lead = lead.map(|lead| lead.0),
            Event::SpindleMode(limit) => self.surface = *limit,
            Event::SpindleSpeed(speed) => self.speed = metres(*speed, step.units),
            Event::ToolChange(tool) | Event::SetToolNumber(tool) => self.tool = *tool,
            Event::Override { kind: Override::Feed, on } => self.override_off = !on,
            _ => {}
        }
    }

    /// The time of an event in which no axis moves. A change to the tool that was changed to before takes none.
    pub(crate) fn still(&self, step: &Step<'_>) -> Seconds {
        match step.event {
            Event::Dwell(seconds) if seconds.is_finite() => Seconds(seconds.0.max(0.0)),
            Event::Cleared(clearing) if clearing.seconds.is_finite() => Seconds(clearing.seconds.0.max(0.0)),
            Event::ToolChange(tool) if self.changes(*tool) => self.timing.tool_change,
            _ => Seconds::ZERO,
        }
    }

    /// Is this another tool than the one in the spindle?
    pub(crate) fn changes(&self, tool: Option<u32>) -> bool {
        tool.is_none() || tool != self.tool
    }

    /// Surface speed in metres a minute, when that is what `S` means.
    pub(crate) fn surface_speed(&self) -> Option<f64> {
        self.surface.map(|_| self.speed)
    }

    pub(crate) fn motion(&self, step: &Step<'_>, motion: &Motion) -> Result<Seconds, Untimed> {
        let (cover, _) = cover(motion);
        let covered = match cover {
            Cover::Unknown => return Err(Untimed::Point),
            Cover::Nothing => return Ok(Seconds::ZERO),
            Cover::Length(length) | Cover::Turn(length) => length,
        };
        if motion.way == Way::Rapid {
            return Ok(Seconds(self.timing.rapid_seconds(motion, self.tracker.still())));
        }
        let by_turn = |lead: f64, scale: f64| {
            let lead = positive(lead.abs(), Untimed::Feed)?;
            let minutes = self.minutes_a_turn(step, motion)? / positive(scale, Untimed::Speed)?;
            Ok(covered / lead * minutes)
        };
        let minutes = match (motion.way, self.lead) {
            (Way::Tap(scale), Some(lead)) => by_turn(lead, scale)?,
            (Way::Feed | Way::Thread, Some(lead)) => by_turn(lead, 1.0)?,
            // Without a lead of its own a thread is cut at the feed, which is then a lead.
            (Way::Thread, None) => by_turn(step.feed, 1.0)?,
            (Way::Tap(scale), None) => by_turn(step.feed, scale)?,
            _ => {
                let minutes = match step.feed_mode {
                    FeedMode::InverseTime => motion.share / positive(step.feed, Untimed::Feed)?,
                    FeedMode::PerRevolution => by_turn(step.feed, 1.0)? * self.part_of_path(motion),
                    FeedMode::PerMinute => {
                        let feed = positive(step.feed, Untimed::Feed)?;
                        // Without linear axes the number of the feed counts degrees.
                        let feed =
                            if matches!(cover, Cover::Turn(_)) { feed / step.units.in_mm() } else { feed };
                        covered / feed * self.part_of_path(motion)
                    }
                };
                if self.override_off {
                    minutes
                } else {
                    // At 0 % the axes wait for the operator.
                    minutes / positive(self.timing.feed_override, Untimed::Feed)?
                }
            }
        };
        Ok(Seconds::from_minutes(minutes))
    }

    /// The part of a movement's path that its feed is measured along: less than 1 for a helix fed along its circle.
    fn part_of_path(&self, motion: &Motion) -> f64 {
        let Some(arc) = motion.arc.filter(|_| self.timing.helix_by_circle) else { return 1.0 };
        let (circle, path) = (arc.plane_length().0, arc.length().0);
        if circle > 0.0 && path > circle { circle / path } else { 1.0 }
    }

    /// The feed that drives a movement, with its mode: a lead is a feed a turn. `None` for rapid moves.
    pub(crate) fn feed_of(&self, step: &Step<'_>, motion: &Motion) -> Option<(f64, FeedMode)> {
        match (motion.way, self.lead) {
            (Way::Rapid, _) => None,
            (Way::Feed | Way::Thread | Way::Tap(_), Some(lead)) => {
                Some((lead.abs(), FeedMode::PerRevolution))
            }
            (Way::Thread | Way::Tap(_), None) => Some((step.feed, FeedMode::PerRevolution)),
            (Way::Feed | Way::Probe, _) => Some((step.feed, step.feed_mode)),
        }
    }

    /// Turns of the spindle a minute, on the average of a movement: 0 when it is stopped, NaN when the speed is unknown.
    pub(crate) fn rpm(&self, step: &Step<'_>, motion: &Motion) -> f64 {
        if step.rpm == 0.0 {
            return 0.0;
        }
        self.minutes_a_turn(step, motion).map_or(f64::NAN, |minutes| 1.0 / minutes)
    }

    /// Minutes of one turn of the spindle, on the average of the movement.
    fn minutes_a_turn(&self, step: &Step<'_>, motion: &Motion) -> Result<f64, Untimed> {
        let Some(limit) = self.surface else { return Ok(1.0 / positive(step.rpm, Untimed::Speed)?) };
        let speed = positive(self.speed, Untimed::Speed)? * 1000.0;
        // A turn takes pi * diameter / speed, but not less than the limit allows.
        let by_radius = 2.0 * PI / speed;
        let least = if limit > 0.0 { 1.0 / limit } else { 0.0 };
        let turn = |x: f64| (by_radius * x.abs()).max(least);
        let minutes = match motion.arc {
            Some(arc) => {
                const PARTS: u32 = 16;
                let middle = |part: u32| (f64::from(part) + 0.5) / f64::from(PARTS);
                let sum: f64 = (0..PARTS).map(|part| turn(arc.point_at(middle(part))[0].0)).sum();
                sum / f64::from(PARTS)
            }
            None => mean(by_radius, least, motion.from.raw(Axis::X), motion.to.raw(Axis::X)),
        };
        positive(minutes, Untimed::Speed)
    }
}

/// A surface speed in metres a minute: an inch program says feet.
pub(crate) fn metres(speed: f64, units: Units) -> f64 {
    match units {
        Units::Inch => speed * 0.3048,
        Units::Mm => speed,
    }
}

/// The mean of max(slope * |x|, least) between two values of x.
fn mean(slope: f64, least: f64, from: f64, to: f64) -> f64 {
    if (to - from).abs() < 1e-9 {
        return (slope * to.abs()).max(least);
    }
    let bend = least / slope;
    let integral = |x: f64| {
        if x.abs() <= bend {
            least * x
        } else {
            x.signum() * (least * bend + slope * (x * x - bend * bend) / 2.0)
        }
    };
    (integral(to) - integral(from)) / (to - from)
}

fn positive(value: f64, why: Untimed) -> Result<f64, Untimed> {
    if value > 0.0 && value.is_finite() { Ok(value) } else { Err(why) }
}

/// The length that a movement covers, if it is one.
pub(crate) fn length(cover: Cover) -> Mm {
    match cover {
        Cover::Length(length) => Mm(length),
        _ => Mm::ZERO,
    }
}
