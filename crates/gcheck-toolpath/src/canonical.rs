//! The canonical functions of the NIST RS274/NGC interface, printed as the reference interpreter prints them.
//!
//! Knows: names, arguments and columns of that form, and which functions an event is. Must not know: how events come
//! about. An event for which the interface has no function is a `COMMENT`; comparisons leave those out.
//!
//! Observed of the interpreter (2.9): lengths are in the units of the program but for entries of the tool table, which
//! are in inches always; numbers are those of `%.4f`, in some places of `%f`; a tool change names the tool's place
//! in the tool table, not its number.

use std::io::{self, Write};

use gcheck_engine::{
    Axis, Coolant, Event, FeedMode, Override, PathMode, Position, Spindle, Stop, ToolEntry, TravelKind, Units,
};
use gcheck_geometry::{Mm, Plane};

use crate::number::{fixed, whole};
use crate::sink::Sink;
use crate::step::{Step, in_units};

/// What is in effect before the first block. Millimetres and degrees.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Start {
    /// Number of the work coordinate system, 1 the first.
    pub work: u16,
    /// Its offset.
    pub offset: Position,
    /// Shift of `G92`.
    pub shift: Position,
    /// Rotation about Z in degrees.
    pub rotation: f64,
}

impl Default for Start {
    /// The first coordinate system at the machine's zero.
    fn default() -> Self {
        Self { work: 1, offset: Position::ZERO, shift: Position::ZERO, rotation: 0.0 }
    }
}

/// How a run ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Ending {
    /// By a block that ends the program.
    Program,
    /// By the percent sign after the program.
    Percent,
    /// By a fault.
    Fault,
}

/// Prints canonical functions.
#[derive(Debug)]
#[must_use = "lines are written when `epilogue` is called"]
pub struct Canonical<W> {
    sink: Sink<W>,
    count: u64,
    tools: Vec<u32>,
}

impl<W: Write> Canonical<W> {
    /// Prints to `writer`.
    pub fn new(writer: W) -> Self {
        Self { sink: Sink::new(writer), count: 0, tools: Vec::new() }
    }

    /// With the tool numbers of the tool table in its order: a change to a tool prints its place, counted from 1. A tool
    /// that is not there prints its number.
    pub fn with_tool_table(mut self, tools: Vec<u32>) -> Self {
        self.tools = tools;
        self
    }

    /// What is printed before the first block; the program starts in millimetres.
    pub fn prologue(&mut self, start: &Start) -> io::Result<()> {
        let units = Units::Mm;
        let none = None;
        self.line(none, |out| out.extend_from_slice(b"USE_LENGTH_UNITS(CANON_UNITS_MM)"))?;
        self.line(none, |out| work_offset(out, start.work, &start.offset, units))?;
        self.line(none, |out| call(out, "SET_G92_OFFSET", |out| six(out, &start.shift, units)))?;
        self.line(none, |out| call(out, "SET_XY_ROTATION", |out| fixed(out, start.rotation, 4)))?;
        self.line(none, |out| out.extend_from_slice(b"SET_FEED_REFERENCE(CANON_XYZ)"))?;
        self.line(none, |out| out.extend_from_slice(b"ON_RESET()"))
    }

    /// What is printed after the last block. Hands the writer back.
    ///
    /// # Errors
    ///
    /// Those of the writer, also of earlier lines.
    pub fn epilogue(mut self, ending: Ending) -> io::Result<W> {
        if ending == Ending::Percent {
            self.word(None, "FINISH()")?;
        }
        self.word(None, "ON_RESET()")?;
        self.word(None, "ON_RESET()")?;
        self.sink.finish()
    }

    /// Prints the functions of one event.
    pub fn step(&mut self, step: &Step<'_>) -> io::Result<()> {
        let n = step.n;
        match step.event {
            Event::Travel(_) | Event::Arc(_) | Event::Curve(_) | Event::RigidTap { .. } => self.motion(step),
            Event::Dwell(seconds) => self.number(n, "DWELL", seconds.0),
            Event::ToolTableEntry(entry) => self.line(n, |out| tool_entry(out, entry)),
            Event::Stop(kind) => self.stop(n, kind),
            Event::PalletChange => self.word(n, "PALLET_SHUTTLE()"),
            Event::End => self.word(n, "PROGRAM_END()"),
            Event::Message(text) => self.quoted(n, "MESSAGE", text),
            Event::Output { index, value, analog, with_move } => {
                self.output(n, *index, *value, *analog, *with_move)
            }
            Event::Chuck(_)
            | Event::BarSetup(_)
            | Event::BarUnload(_)
            | Event::BarLoad
            | Event::BarPush(_)
            | Event::UserCommand { .. } => self.comment(step),
            // The interface has nothing for them and the interpreter says nothing.
            Event::Modal(_)
            | Event::DataRow(_)
            | Event::ExactStop
            | Event::Smoothing(_)
            | Event::ContourControl { .. }
            | Event::WaitInput { .. }
            | Event::CutterVector(_)
            | Event::Cylinder(_)
            | Event::Cleared(_)
            | Event::Unfollowed
            | Event::KnownWay(_)
            | Event::BarFeed(_) => Ok(()),
            Event::Probe(on) => self.word(n, if *on { "TURN_PROBE_ON()" } else { "TURN_PROBE_OFF()" }),
            Event::FeedRate(_)
            | Event::FeedMode(_)
            | Event::FeedReference
            | Event::Plane(_)
            | Event::SecondaryPlane
            | Event::Units(_)
            | Event::PathMode(_)
            | Event::Override { .. } => self.mode(step),
            Event::WorkOffset { .. } | Event::Shift(_) | Event::LengthOffset(_) | Event::Rotation(_) => {
                self.frame(step)
            }
            Event::SelectTool(_) | Event::StartChange | Event::ToolChange(_) | Event::SetToolNumber(_) => {
                self.tool(step)
            }
            Event::SpindleSpeed(_)
            | Event::Spindle(_)
            | Event::OrientSpindle { .. }
            | Event::WaitOrient(_)
            | Event::SpindleMode(_)
            | Event::SpindleSync { .. }
            | Event::Coolant { .. } => self.spindle(step),
        }
    }

    fn motion(&mut self, step: &Step<'_>) -> io::Result<()> {
        let (n, units) = (step.n, step.units);
        match step.event {
            Event::Travel(travel) => {
                let name = match travel.kind {
                    TravelKind::Rapid => "STRAIGHT_TRAVERSE",
                    TravelKind::Feed | TravelKind::Thread => "STRAIGHT_FEED",
                    TravelKind::Probe { .. } => "STRAIGHT_PROBE",
                };
                self.line(n, |out| call(out, name, |out| six(out, &travel.to, units)))
            }
            Event::Arc(arc) => {
                let [first, second, normal] = arc.plane.to_local(arc.to.xyz());
                self.line(n, |out| {
                    call(out, "ARC_FEED", |out| {
                        list(out, [first, second, arc.centre.0, arc.centre.1].map(|mm| length(mm, units)));
                        comma(out);
                        integer(out, arc.turns);
                        comma(out);
                        fixed(out, length(normal, units), 4);
                        comma(out);
                        list(out, arc.to.abc().map(|degrees| degrees.0));
                    });
                })
            }
            Event::Curve(curve) => self.line(n, |out| {
                call(out, "NURBS_FEED", |out| {
                    whole(out, u64::from(curve.points));
                    out.extend_from_slice(b", ...");
                });
            }),
            Event::RigidTap { to, .. } => self
                .line(n, |out| call(out, "RIGID_TAP", |out| list(out, to.xyz().map(|mm| length(mm, units))))),
            _ => Ok(()),
        }
    }

    /// What the interface has no function for, and a reader wants to know.
    fn comment(&mut self, step: &Step<'_>) -> io::Result<()> {
        let (n, units) = (step.n, step.units);
        match step.event {
            Event::Chuck(clamped) => {
                self.quoted(n, "COMMENT", if *clamped { "chuck clamped" } else { "chuck unclamped" })
            }
            Event::BarSetup(_) => self.quoted(n, "COMMENT", "bar feeder set up"),
            Event::BarUnload(_) => self.quoted(n, "COMMENT", "bar unloaded"),
            Event::BarLoad => self.quoted(n, "COMMENT", "new bar loaded"),
            Event::BarPush(by) => self.line(n, |out| {
                out.extend_from_slice(b"COMMENT(\"bar pushed by ");
                fixed(out, length(*by, units), 4);
                out.extend_from_slice(b"\")");
            }),
            Event::UserCommand { number, p, q } => self.line(n, |out| {
                out.extend_from_slice(b"COMMENT(\"user command ");
                whole(out, u64::from(*number));
                out.push(b' ');
                fixed(out, *p, 4);
                out.push(b' ');
                fixed(out, *q, 4);
                out.extend_from_slice(b"\")");
            }),
            _ => Ok(()),
        }
    }

    fn mode(&mut self, step: &Step<'_>) -> io::Result<()> {
        let (n, units) = (step.n, step.units);
        match step.event {
            Event::FeedRate(feed) => self.number(n, "SET_FEED_RATE", *feed / units.in_mm()),
            Event::FeedMode(mode) => self.word(
                n,
                match mode {
                    FeedMode::PerRevolution => "SET_FEED_MODE(0, 1)",
                    FeedMode::InverseTime | FeedMode::PerMinute => "SET_FEED_MODE(0, 0)",
                },
            ),
            Event::FeedReference => self.word(n, "SET_FEED_REFERENCE(CANON_XYZ)"),
            Event::SecondaryPlane => self.word(n, "SELECT_PLANE(CANON_PLANE_UNKNOWN)"),
            Event::Plane(plane) => self.word(
                n,
                match plane {
                    Plane::Xy => "SELECT_PLANE(CANON_PLANE_XY)",
                    Plane::Zx => "SELECT_PLANE(CANON_PLANE_XZ)",
                    Plane::Yz => "SELECT_PLANE(CANON_PLANE_YZ)",
                },
            ),
            Event::Units(units) => self.word(
                n,
                match units {
                    Units::Inch => "USE_LENGTH_UNITS(CANON_UNITS_INCHES)",
                    Units::Mm => "USE_LENGTH_UNITS(CANON_UNITS_MM)",
                },
            ),
            Event::PathMode(PathMode::ExactPath) => self.word(n, "SET_MOTION_CONTROL_MODE(CANON_EXACT_PATH)"),
            Event::PathMode(PathMode::ExactStop) => self.word(n, "SET_MOTION_CONTROL_MODE(CANON_EXACT_STOP)"),
            Event::PathMode(PathMode::Blending { tolerance, naive }) => {
                self.line(n, |out| {
                    call(out, "SET_MOTION_CONTROL_MODE", |out| {
                        out.extend_from_slice(b"CANON_CONTINUOUS, ");
                        fixed(out, length(*tolerance, units), 6);
                    });
                })?;
                // The second tolerance follows the first one when it is not given.
                self.number(n, "SET_NAIVECAM_TOLERANCE", length(naive.unwrap_or(*tolerance), units))
            }
            Event::Override { kind, on } => self.word(
                n,
                match (kind, on) {
                    (Override::Feed, true) => "ENABLE_FEED_OVERRIDE()",
                    (Override::Feed, false) => "DISABLE_FEED_OVERRIDE()",
                    (Override::Speed, true) => "ENABLE_SPEED_OVERRIDE(0)",
                    (Override::Speed, false) => "DISABLE_SPEED_OVERRIDE(0)",
                    (Override::Adaptive, true) => "ENABLE_ADAPTIVE_FEED()",
                    (Override::Adaptive, false) => "DISABLE_ADAPTIVE_FEED()",
                    (Override::FeedStop, true) => "ENABLE_FEED_HOLD()",
                    (Override::FeedStop, false) => "DISABLE_FEED_HOLD()",
                },
            ),
            _ => Ok(()),
        }
    }

    fn frame(&mut self, step: &Step<'_>) -> io::Result<()> {
        let (n, units) = (step.n, step.units);
        match step.event {
            // The rotation is an event of its own.
            Event::WorkOffset { number, offset, .. } => {
                self.line(n, |out| work_offset(out, *number, offset, units))
            }
            Event::Shift(shift) => {
                self.line(n, |out| call(out, "SET_G92_OFFSET", |out| six(out, shift, units)))
            }
            Event::LengthOffset(offset) => self.line(n, |out| {
                call(out, "USE_TOOL_LENGTH_OFFSET", |out| {
                    for (index, values) in nine(offset, units).chunks(3).enumerate() {
                        if index > 0 {
                            comma(out);
                        }
                        spaced(out, values);
                    }
                });
            }),
            Event::Rotation(degrees) => self.number(n, "SET_XY_ROTATION", *degrees),
            _ => Ok(()),
        }
    }

    fn tool(&mut self, step: &Step<'_>) -> io::Result<()> {
        let n = step.n;
        match step.event {
            Event::SelectTool(tool) => self.line(n, |out| call(out, "SELECT_TOOL", |out| maybe(out, *tool))),
            Event::StartChange => self.word(n, "START_CHANGE()"),
            Event::ToolChange(tool) => {
                let place = self.place(*tool);
                self.line(n, |out| call(out, "CHANGE_TOOL", |out| maybe(out, place)))
            }
            Event::SetToolNumber(tool) => {
                let place = self.place(*tool);
                self.line(n, |out| call(out, "CHANGE_TOOL_NUMBER", |out| maybe(out, place)))
            }
            _ => Ok(()),
        }
    }

    /// Place of a tool in the table.
    fn place(&self, tool: Option<u32>) -> Option<u32> {
        let tool = tool?;
        let place = self.tools.iter().position(|entry| *entry == tool);
        Some(place.and_then(|place| u32::try_from(place + 1).ok()).unwrap_or(tool))
    }

    fn spindle(&mut self, step: &Step<'_>) -> io::Result<()> {
        let n = step.n;
        match step.event {
            Event::SpindleSpeed(speed) => self.line(n, |out| {
                call(out, "SET_SPINDLE_SPEED", |out| {
                    out.extend_from_slice(b"0, ");
                    fixed(out, *speed, 4);
                });
            }),
            Event::Spindle(spindle) => self.word(
                n,
                match spindle {
                    Spindle::Clockwise => "START_SPINDLE_CLOCKWISE(0)",
                    Spindle::CounterClockwise => "START_SPINDLE_COUNTERCLOCKWISE(0)",
                    Spindle::Stopped => "STOP_SPINDLE_TURNING(0)",
                },
            ),
            Event::OrientSpindle { angle, way } => self.line(n, |out| {
                call(out, "ORIENT_SPINDLE", |out| {
                    out.extend_from_slice(b"0, ");
                    fixed(out, *angle, 4);
                    comma(out);
                    whole(out, u64::from(*way));
                });
            }),
            Event::WaitOrient(seconds) => self.number(n, "SPINDLE.0.WAIT_ORIENT_COMPLETE", seconds.0),
            Event::SpindleMode(limit) => {
                // No limit is the number that the interpreter takes for one.
                let limit = limit.map_or(0.0, |limit| if limit.is_infinite() { 1e30 } else { limit });
                self.line(n, |out| {
                    call(out, "SET_SPINDLE_MODE", |out| {
                        out.extend_from_slice(b"0 ");
                        fixed(out, limit, 4);
                    });
                })
            }
            Event::SpindleSync { lead: Some(lead), velocity } => self.line(n, |out| {
                call(out, "START_SPEED_FEED_SYNC", |out| {
                    fixed(out, length(*lead, step.units), 6);
                    out.extend_from_slice(if *velocity { b",1" } else { b",0" });
                });
            }),
            Event::SpindleSync { lead: None, .. } => self.word(n, "STOP_SPEED_FEED_SYNCH()"),
            Event::Coolant { kind, on } => self.word(
                n,
                match (kind, on) {
                    (Coolant::Mist, true) => "MIST_ON()",
                    (Coolant::Mist, false) => "MIST_OFF()",
                    (Coolant::Flood, true) => "FLOOD_ON()",
                    (Coolant::Flood, false) => "FLOOD_OFF()",
                    (Coolant::Through, true) => "COMMENT(\"coolant through the spindle on\")",
                    (Coolant::Through, false) => "COMMENT(\"coolant through the spindle off\")",
                },
            ),
            _ => Ok(()),
        }
    }

    fn stop(&mut self, n: Option<u32>, kind: &Stop) -> io::Result<()> {
        match kind {
            Stop::Program | Stop::Pallet => self.word(n, "PROGRAM_STOP()"),
            Stop::Optional => self.word(n, "OPTIONAL_PROGRAM_STOP()"),
            Stop::Message(text) => {
                self.quoted(n, "MESSAGE", text)?;
                self.word(n, "PROGRAM_STOP()")
            }
        }
    }

    fn output(
        &mut self,
        n: Option<u32>,
        index: u32,
        value: f64,
        analog: bool,
        with_move: bool,
    ) -> io::Result<()> {
        let on = value.abs() > 0.0;
        let name = match (analog, with_move, on) {
            (true, true, _) => "SET_MOTION_OUTPUT_VALUE",
            (true, false, _) => "SET_AUX_OUTPUT_VALUE",
            (false, true, true) => "SET_MOTION_OUTPUT_BIT",
            (false, true, false) => "CLEAR_MOTION_OUTPUT_BIT",
            (false, false, true) => "SET_AUX_OUTPUT_BIT",
            (false, false, false) => "CLEAR_AUX_OUTPUT_BIT",
        };
        self.line(n, |out| {
            call(out, name, |out| {
                whole(out, u64::from(index));
                if analog {
                    out.push(b',');
                    fixed(out, value, 6);
                }
            });
        })
    }

    fn word(&mut self, n: Option<u32>, text: &str) -> io::Result<()> {
        self.line(n, |out| out.extend_from_slice(text.as_bytes()))
    }

    fn number(&mut self, n: Option<u32>, name: &str, value: f64) -> io::Result<()> {
        self.line(n, |out| call(out, name, |out| fixed(out, value, 4)))
    }

    fn quoted(&mut self, n: Option<u32>, name: &str, text: &str) -> io::Result<()> {
        self.line(n, |out| {
            out.extend_from_slice(name.as_bytes());
            out.extend_from_slice(b"(\"");
            // One function, one line, whatever the text.
            out.extend(text.bytes().map(|byte| if byte < b' ' { b' ' } else { byte }));
            out.extend_from_slice(b"\")");
        })
    }

    /// The columns: a running number, the block's N word, the function.
    fn line(&mut self, n: Option<u32>, function: impl FnOnce(&mut Vec<u8>)) -> io::Result<()> {
        self.count += 1;
        let out = &mut self.sink.buffer;
        for limit in [10_000, 1_000, 100, 10] {
            if self.count < limit {
                out.push(b' ');
            }
        }
        whole(out, self.count);
        match n {
            None => out.extend_from_slice(b" N..... "),
            Some(n) => {
                out.extend_from_slice(b" N");
                whole(out, u64::from(n));
                for limit in [10, 100, 1_000, 10_000, 100_000] {
                    if n < limit {
                        out.push(b' ');
                    }
                }
            }
        }
        function(out);
        self.sink.end_line()
    }
}

fn length(mm: Mm, units: Units) -> f64 {
    mm.0 / units.in_mm()
}

fn nine(position: &Position, units: Units) -> [f64; 9] {
    Axis::ALL.map(|axis| in_units(axis, position.raw(axis), units))
}

fn call(out: &mut Vec<u8>, name: &str, arguments: impl FnOnce(&mut Vec<u8>)) {
    out.extend_from_slice(name.as_bytes());
    out.push(b'(');
    arguments(out);
    out.push(b')');
}

fn comma(out: &mut Vec<u8>) {
    out.extend_from_slice(b", ");
}

fn list<const N: usize>(out: &mut Vec<u8>, values: [f64; N]) {
    for (index, value) in values.into_iter().enumerate() {
        if index > 0 {
            comma(out);
        }
        fixed(out, value, 4);
    }
}

fn spaced(out: &mut Vec<u8>, values: &[f64]) {
    for (index, value) in values.iter().enumerate() {
        if index > 0 {
            out.push(b' ');
        }
        fixed(out, *value, 4);
    }
}

/// X Y Z A B C: moves and offsets print no more axes.
fn six(out: &mut Vec<u8>, position: &Position, units: Units) {
    let six: [Axis; 6] = [Axis::X, Axis::Y, Axis::Z, Axis::A, Axis::B, Axis::C];
    list(out, six.map(|axis| in_units(axis, position.raw(axis), units)));
}

fn work_offset(out: &mut Vec<u8>, number: u16, offset: &Position, units: Units) {
    call(out, "SET_G5X_OFFSET", |out| {
        whole(out, u64::from(number));
        comma(out);
        six(out, offset, units);
    });
}

fn tool_entry(out: &mut Vec<u8>, entry: &ToolEntry) {
    call(out, "SET_TOOL_TABLE_ENTRY", |out| {
        whole(out, u64::from(entry.pocket));
        comma(out);
        whole(out, u64::from(entry.tool));
        comma(out);
        // The table is kept in inches.
        spaced(out, &nine(&entry.offset, Units::Inch));
        comma(out);
        list(out, entry.angles);
        comma(out);
        whole(out, u64::from(entry.orientation));
    });
}

fn integer(out: &mut Vec<u8>, value: i32) {
    if value < 0 {
        out.push(b'-');
    }
    whole(out, u64::from(value.unsigned_abs()));
}

/// A tool number, or what stands for one that is unknown.
fn maybe(out: &mut Vec<u8>, number: Option<u32>) {
    match number {
        Some(number) => whole(out, u64::from(number)),
        None => out.extend_from_slice(b"nan"),
    }
}
