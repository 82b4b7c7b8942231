//! The acts of a run as they are compared: every move with the setting it is made in, and what happens while the axes do not move.
//!
//! Knows: what of a run makes a difference on the machine. Must not know: how two runs are held against each other.

use std::sync::Arc as Shared;

use gcheck_engine::{Axis, Coolant, Event, FeedMode, PathMode, Position, Spindle, Stop};
use gcheck_geometry::Arc;

use crate::corner_mode::{CornerMode, is_of_cycle};
use crate::motion::{Cover, Motion, Way, cover};
use crate::placing::{Placing, WorkCoordinates};
use crate::step::Step;
use crate::time::{Clock, Timing, metres};

/// Something that the machine does, with its place in the program.
#[derive(Debug, Clone, PartialEq)]
pub struct Act {
    /// The file.
    pub file: Shared<str>,
    /// Line, from 1.
    pub line: u32,
    /// What is in effect.
    pub setting: Setting,
    /// What is done.
    pub doing: Doing,
}

/// What is done.
#[derive(Debug, Clone, PartialEq)]
#[expect(clippy::large_enum_variant, reason = "nearly all acts are moves")]
pub enum Doing {
    /// Axes move.
    Move(Move),
    /// Something happens while they do not move.
    Stand(Stand),
}

/// A movement, in work coordinates without shifts: millimetres and degrees, NaN unknown.
#[derive(Debug, Clone, PartialEq)]
pub struct Move {
    /// How it is driven.
    pub driven: Driven,
    pub(crate) from: Position,
    /// Its end.
    pub to: Position,
    pub(crate) arc: Option<Arc>,
}

impl Move {
    /// A movement; an arc has the ends of its own.
    pub const fn new(driven: Driven, from: Position, to: Position, arc: Option<Arc>) -> Self {
        Self { driven, from, to, arc }
    }

    /// Its start.
    pub const fn from(&self) -> &Position {
        &self.from
    }

    /// The arc that it follows; a straight line without one.
    pub const fn arc(&self) -> Option<&Arc> {
        self.arc.as_ref()
    }
}

/// How a movement is driven.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Driven {
    /// As fast as the axes go.
    Rapid,
    /// At a feed.
    Feed,
    /// Until a signal.
    Probe,
    /// Tied to the spindle: a thread.
    Thread,
    /// Tied to the spindle: a tap.
    Tap,
}

/// What happens while the axes do not move.
#[derive(Debug, Clone, PartialEq)]
pub enum Stand {
    /// Standing still for this many seconds; NaN unknown.
    Dwell(f64),
    /// A tool comes into the spindle.
    ToolChange(Option<u32>),
    /// The program stops until cycle start.
    Stop {
        /// Only when the operator's switch is on.
        optional: bool,
    },
    /// Pallets are exchanged.
    Pallet,
    /// The spindle is turned to an angle, degrees.
    Orient(f64),
    /// The chuck clamps (true) or opens.
    Chuck(bool),
    /// The bar feeder moves the bar: its command, and millimetres where there are some.
    Bar(&'static str, Option<f64>),
    /// The control clears a pocket by a path of its own, of this length.
    Pocket(f64),
    /// An axis is wrapped around a cylinder of this diameter; `None` when that ends.
    Wrap(Option<f64>),
    /// An output is set.
    Output {
        /// Its number.
        index: u32,
        /// Its value.
        value: f64,
    },
    /// An input is waited for.
    WaitInput(u32),
    /// A command of the shop's own: number, `P` and `Q`.
    UserCommand(u16, [f64; 2]),
    /// A row of data: the letters of its words, each with its number (NaN unknown).
    Row(Shared<[(char, f64)]>),
    /// The program ends.
    End,
}

/// What is in effect during an act. What is unknown is NaN or `None`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Setting {
    /// Feed of the move; `None` where none applies.
    pub feed: Option<Feed>,
    /// The spindle.
    pub spindle: Option<Spindle>,
    /// Its speed: turns a minute, or metres a minute under constant surface speed.
    pub speed: f64,
    /// Constant surface speed, with its limit in turns a minute: infinite without one, NaN unknown.
    pub surface: Option<f64>,
    /// The tool in the spindle.
    pub tool: Option<u32>,
    /// Number of the work coordinate system, 1 the first.
    pub work: Option<u16>,
    /// Where the zero of that system lies in X, Y and Z of the machine, millimetres.
    pub zero: [f64; 3],
    /// Number of the tool length offset, 0 none.
    pub length: Option<u32>,
    /// How long it is in Z, millimetres.
    pub length_by: f64,
    /// Number of the cutter offset; `Some(0)` while the path is not shifted by a cutter.
    pub cutter: Option<u32>,
    /// Mist, flood and through the spindle; `None` while the program has not said.
    pub coolant: [Option<bool>; 3],
    /// How corners are taken; `None` in a cycle, which the control moves as it does.
    pub corners: Option<CornerMode>,
}

/// A feed. Moves by inverse time count with the rate that their length makes of it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Feed {
    /// Millimetres, or degrees, a minute.
    PerMinute(f64),
    /// Millimetres a turn.
    PerTurn(f64),
}

/// Makes acts of the steps of a run. Has to see every step, in order.
#[derive(Debug)]
pub struct Trail {
    clock: Clock,
    placing: Placing,
    setting: Setting,
    corners: CornerMode,
    /// The axes stop at the end of the block that comes.
    stops_once: bool,
    file: Shared<str>,
}

impl Trail {
    /// At the start of a run, with the work coordinate system in effect there.
    pub fn new(work: WorkCoordinates) -> Self {
        Self {
            clock: Clock::new(Timing::new(None, None)),
            placing: Placing::new(WorkCoordinates { number: work.number, ..WorkCoordinates::UNKNOWN }),
            setting: Setting {
                feed: None,
                spindle: None,
                speed: f64::NAN,
                surface: None,
                tool: None,
                work: work.number,
                zero: zero(&work.origin),
                length: None,
                length_by: f64::NAN,
                cutter: Some(0),
                coolant: [None; 3],
                corners: None,
            },
            corners: CornerMode::START,
            stops_once: false,
            file: Shared::from(""),
        }
    }

    /// Calls `each` for the acts of an event.
    pub fn add(&mut self, step: &Step<'_>, mut each: impl FnMut(Act)) {
        if *self.file != *step.file {
            self.file = Shared::from(step.file);
        }
        match step.event {
            Event::Travel(_) | Event::Arc(_) | Event::Curve(_) | Event::RigidTap { .. } => {
                let tracker = self.clock.tracker;
                tracker.motions(step, |motion| each(self.motion(step, motion)));
                self.stops_once = false;
            }
            event => {
                self.set(step, event);
                self.stops_once |= *event == Event::ExactStop;
                if let Some(stand) = stand(event) {
                    let setting = Setting { feed: None, ..self.setting };
                    let file = Shared::clone(&self.file);
                    each(Act { file, line: step.line, setting, doing: Doing::Stand(stand) });
                }
            }
        }
        self.placing.after(step.event);
        self.clock.after(step);
    }

    fn set(&mut self, step: &Step<'_>, event: &Event) {
        self.corners.set(event);
        let setting = &mut self.setting;
        match event {
            Event::Spindle(spindle) => setting.spindle = Some(*spindle),
            Event::SpindleSpeed(speed) => {
                setting.speed = if setting.surface.is_some() { metres(*speed, step.units) } else { *speed };
            }
            Event::SpindleMode(limit) => setting.surface = *limit,
            Event::ToolChange(tool) | Event::SetToolNumber(tool) => setting.tool = *tool,
            Event::WorkOffset { number, offset, .. } => {
                setting.work = Some(*number);
                setting.zero = zero(offset);
            }
            Event::LengthOffset(by) => {
                setting.length = step.h;
                setting.length_by = by.raw(Axis::Z);
            }
            Event::Coolant { kind, on } => {
                let [mist, flood, through] = &mut setting.coolant;
                let slot = match kind {
                    Coolant::Mist => mist,
                    Coolant::Flood => flood,
                    Coolant::Through => through,
                };
                *slot = Some(*on);
            }
            _ => {}
        }
    }

    fn motion(&self, step: &Step<'_>, motion: &Motion) -> Act {
        let (mut from, mut to) = (motion.from, motion.to);
        // A cutter of unknown size leaves the programmed points to compare.
        let mut is_shifted = false;
        for axis in Axis::ALL {
            let (reached, programmed) = (motion.to.raw(axis), motion.programmed.raw(axis));
            is_shifted |= (reached - programmed).abs() > 1e-9;
            if reached.is_nan() && !programmed.is_nan() {
                is_shifted = true;
                to.set(axis, programmed);
                from.set(axis, f64::NAN);
            }
        }
        let turned = !self.placing.is_upright();
        let place = |point: &Position| self.placing.in_work(point);
        let arc = motion.arc.filter(|arc| arc.is_known() && !is_unknown(&from)).and_then(|arc| {
            let [start, end] = [arc.start(), arc.end()].map(|point| place(&to.with_xyz(point)).xyz());
            // A turned arc outside the XY plane lies in no main plane: its ends stand for it.
            if turned && arc.plane() != gcheck_geometry::Plane::Xy {
                return None;
            }
            let centre = place(&to.with_xyz(arc.centre_xyz())).xyz();
            let [first, second, _] = arc.plane().to_local(centre);
            Some(Arc::from_parts(arc.plane(), start, end, (first, second), arc.sweep()))
        });
        Act {
            file: Shared::clone(&self.file),
            line: step.line,
            setting: Setting {
                feed: self.feed(step, motion),
                tool: self.setting.tool.or(step.tool),
                length: self.setting.length.or(step.h),
                cutter: if is_shifted { step.d } else { Some(0) },
                corners: (!is_of_cycle(step.event)).then_some(CornerMode {
                    path: if self.stops_once { PathMode::ExactStop } else { self.corners.path },
                    ..self.corners
                }),
                ..self.setting
            },
            doing: Doing::Move(Move {
                driven: match motion.way {
                    Way::Rapid => Driven::Rapid,
                    Way::Feed => Driven::Feed,
                    Way::Probe => Driven::Probe,
                    Way::Thread => Driven::Thread,
                    Way::Tap(_) => Driven::Tap,
                },
                from: place(&from),
                to: place(&to),
                arc,
            }),
        }
    }

    fn feed(&self, step: &Step<'_>, motion: &Motion) -> Option<Feed> {
        let (feed, mode) = self.clock.feed_of(step, motion)?;
        let (cover, _) = cover(motion);
        Some(match (mode, cover) {
            (FeedMode::PerRevolution, _) => Feed::PerTurn(feed),
            // Without linear axes the number of the feed counts degrees.
            (FeedMode::PerMinute, Cover::Turn(_)) => Feed::PerMinute(feed / step.units.in_mm()),
            (FeedMode::PerMinute, _) => Feed::PerMinute(feed),
            (FeedMode::InverseTime, Cover::Length(way) | Cover::Turn(way)) => {
                Feed::PerMinute(way / motion.share * feed)
            }
            (FeedMode::InverseTime, _) => Feed::PerMinute(f64::NAN),
        })
    }
}

fn zero(origin: &Position) -> [f64; 3] {
    [Axis::X, Axis::Y, Axis::Z].map(|axis| origin.raw(axis))
}

fn is_unknown(point: &Position) -> bool {
    point.xyz().iter().any(|value| !value.is_known())
}

fn stand(event: &Event) -> Option<Stand> {
    Some(match event {
        Event::Dwell(seconds) => Stand::Dwell(seconds.0),
        Event::ToolChange(tool) => Stand::ToolChange(*tool),
        Event::Stop(Stop::Pallet) | Event::PalletChange => Stand::Pallet,
        Event::Stop(stop) => Stand::Stop { optional: *stop == Stop::Optional },
        Event::OrientSpindle { angle, .. } => Stand::Orient(*angle),
        Event::Chuck(clamped) => Stand::Chuck(*clamped),
        Event::BarFeed(lengths) => Stand::Bar("feed", Some(lengths.part.0)),
        Event::BarPush(by) => Stand::Bar("push", Some(by.0)),
        Event::BarUnload(_) => Stand::Bar("unload", None),
        Event::BarLoad => Stand::Bar("load", None),
        Event::Cleared(clearing) => Stand::Pocket(clearing.length.0),
        Event::Cylinder(cylinder) => Stand::Wrap(cylinder.map(|cylinder| cylinder.diameter)),
        Event::Output { index, value, .. } => Stand::Output { index: *index, value: *value },
        Event::WaitInput { index, .. } => Stand::WaitInput(*index),
        Event::UserCommand { number, p, q } => Stand::UserCommand(*number, [*p, *q]),
        Event::DataRow(words) => {
            Stand::Row(words.iter().map(|(letter, number)| (char::from(letter.ascii()), *number)).collect())
        }
        Event::End => Stand::End,
        _ => return None,
    })
}
