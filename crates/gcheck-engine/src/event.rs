//! What a block makes the machine do, in order: moves and changes of state.
//!
//! Knows: the events that observers of a run see. Must not know: how they are computed, printed or judged. Lengths are
//! millimetres and angles degrees, whatever units the program uses; coordinates are those of the active work coordinate
//! system unless a field says otherwise.

use std::rc::Rc;

use gcheck_controls::{CodeIx, Effect, Letter};
use gcheck_geometry::{Mm, Plane, Seconds};

use crate::cylinder::Cylinder;
use crate::lattice::Lattice;
use crate::position::Position;

/// One event. Its block, and the state in which it happens, come beside it ([`crate::Observer`]).
#[derive(Debug, Clone, PartialEq)]
pub enum Event {
    /// A straight move.
    Travel(Travel),
    /// How far the axes of the next move go, where that is known and their places are not: millimetres and degrees, NaN for
    /// all other axes.
    KnownWay(Position),
    /// A circular or helical move.
    Arc(ArcMove),
    /// A curve that is neither: its parameters as the program gives them, and its end.
    Curve(Curve),
    /// The block may move the axes, and do what belongs to that, in a way that is not followed: its mode, its words or where it
    /// begins is not known. Moves that are shown beside it are not all that it may make.
    Unfollowed,
    /// Standing still.
    Dwell(Seconds),

    /// The feed in effect: millimetres a turn or a minute, as the mode says (NaN unknown). Under inverse time it is what
    /// the next move's length makes of the word. A number that a program in inches gives rotary axes alone counts as
    /// inches here too.
    FeedRate(f64),
    /// The feed mode.
    FeedMode(FeedMode),
    /// The point that the feed is measured at (always the tool's path in XYZ).
    FeedReference,
    /// The active plane.
    Plane(Plane),
    /// A plane of U, V and W is active.
    SecondaryPlane,
    /// The units of the program.
    Units(Units),
    /// Exact path, exact stop or blending; tolerances in millimetres.
    PathMode(PathMode),
    /// The axes stop at the end of the block's move.
    ExactStop,
    /// How exactly corners are taken, in place of the control's settings.
    Smoothing(Smoothing),
    /// The control looks ahead on command, or ceases to: with the level of precision that the program asks for.
    ContourControl {
        /// On, else off.
        on: bool,
        /// As the program gives it.
        level: Option<u8>,
    },

    /// Work coordinate system number (1 = the first), with its offset and rotation, now in effect.
    WorkOffset {
        /// Number, counted from 1.
        number: u16,
        /// Offset in machine coordinates.
        offset: Position,
        /// Rotation about Z in degrees.
        rotation: f64,
    },
    /// The shift of `G92` and `G52` now in effect.
    Shift(Position),
    /// The tool offsets now in effect.
    LengthOffset(Position),
    /// The vector that the next move is shifted along by the size of the cutter: I, J and K as the block gives them (`None`
    /// left out, NaN unknown).
    CutterVector([Option<f64>; 3]),
    /// The rotation about Z now in effect, degrees.
    Rotation(f64),
    /// A tool's entry in the tool table was written.
    ToolTableEntry(ToolEntry),

    /// A tool was called for (`T`); `None` when its number is unknown.
    SelectTool(Option<u32>),
    /// The tool change begins.
    StartChange,
    /// The tool is in the spindle.
    ToolChange(Option<u32>),
    /// The control was told which tool is in the spindle (`M61`).
    SetToolNumber(Option<u32>),

    /// Programmed speed, the number as it stands (NaN unknown): turns a minute; under constant surface speed metres a
    /// minute, or feet a minute in an inch program.
    SpindleSpeed(f64),
    /// The spindle turns or stops.
    Spindle(Spindle),
    /// Orientation to an angle in degrees.
    OrientSpindle {
        /// Degrees.
        angle: f64,
        /// The way: 0 shortest, 1 clockwise, 2 counter-clockwise.
        way: u8,
    },
    /// Waiting until the spindle stands at its angle, or the orientation has failed after this many seconds.
    WaitOrient(Seconds),
    /// Constant surface speed with its limit in turns a minute, or `None` for constant speed.
    SpindleMode(Option<f64>),
    /// Feed tied to the spindle's angle: millimetres a turn, or `None` when it ends.
    SpindleSync {
        /// Millimetres a turn; `None` ends it.
        lead: Option<Mm>,
        /// The spindle's speed does not matter, only its angle.
        velocity: bool,
    },
    /// Tapping in and out at a lead, to this depth and back.
    RigidTap {
        /// Where the axes stand before, and after.
        from: Position,
        /// The bottom.
        to: Position,
        /// Speed ratio of the way out.
        scale: f64,
    },
    /// Coolant.
    Coolant {
        /// Which.
        kind: Coolant,
        /// On, else off.
        on: bool,
    },
    /// Overrides of feed or speed allowed or not.
    Override {
        /// Which.
        kind: Override,
        /// Allowed or switched on.
        on: bool,
    },
    /// An output is set.
    Output {
        /// Its number.
        index: u32,
        /// Its value: 0 and 1 for digital outputs.
        value: f64,
        /// Analog, else digital.
        analog: bool,
        /// With the next move, else at once.
        with_move: bool,
    },
    /// Waits for an input.
    WaitInput {
        /// Its number.
        index: u32,
        /// Analog, else digital.
        analog: bool,
        /// What is waited for: 0 immediate, 1 rise, 2 fall, 3 high, 4 low.
        what: u8,
        /// Longest wait.
        timeout: Seconds,
    },
    /// A linear axis is wrapped around a cylinder: its coordinates are those of the unrolled surface, and a rotary axis turns
    /// in its place. `None` when that ends.
    Cylinder(Option<Cylinder>),
    /// The control cleared a pocket by a path of its own, between the moves that are certain.
    Cleared(Clearing),
    /// The probe input begins or ceases to matter.
    Probe(bool),
    /// Chuck clamped or unclamped.
    Chuck(bool),
    /// The bar feeder is told to bring bar for the next part: the part before it is cut off.
    BarFeed(BarLengths),
    /// The bar feeder is set up, in this mode (`None` unknown).
    BarSetup(Option<u32>),
    /// What is left of the bar is taken out: this much behind the face of the chuck (NaN unknown).
    BarUnload(Mm),
    /// A new bar is brought to the chuck.
    BarLoad,
    /// The bar is pushed by this much.
    BarPush(Mm),
    /// A user's own command with its words P and Q.
    UserCommand {
        /// The code's number, 100 to 199.
        number: u16,
        /// `P`.
        p: f64,
        /// `Q`.
        q: f64,
    },
    /// A modal code came into effect.
    Modal(CodeIx),
    /// Text for the operator or a log.
    Message(Rc<str>),
    /// A row of a table that the control takes as data: its words, each with its number (NaN unknown).
    DataRow(Rc<[(Letter, f64)]>),

    /// The program stops until cycle start.
    Stop(Stop),
    /// Pallets are exchanged.
    PalletChange,
    /// The program ends.
    End,
}

impl Event {
    /// Does this stand for another event? A number that nobody knows stands for every number.
    pub fn covers(&self, inner: &Self) -> bool {
        match (self, inner) {
            (Self::Travel(a), Self::Travel(b)) => {
                a.kind == b.kind
                    && a.from.covers(&b.from)
                    && a.programmed.covers(&b.programmed)
                    && a.to.covers(&b.to)
            }
            (Self::Arc(a), Self::Arc(b)) => {
                (a.plane, a.turns) == (b.plane, b.turns)
                    && a.from.covers(&b.from)
                    && a.programmed.covers(&b.programmed)
                    && a.to.covers(&b.to)
                    && a.centre.0.covers(&b.centre.0)
                    && a.centre.1.covers(&b.centre.1)
                    && a.sweep.covers(&b.sweep)
            }
            (Self::Curve(a), Self::Curve(b)) => {
                (a.points == b.points || a.points == 0) && a.from.covers(&b.from) && a.to.covers(&b.to)
            }
            (
                Self::RigidTap { from, to, scale },
                Self::RigidTap { from: inner_from, to: inner_to, scale: inner_scale },
            ) => from.covers(inner_from) && to.covers(inner_to) && scale.covers(inner_scale),
            (Self::Dwell(a), Self::Dwell(b)) => a.0.covers(&b.0),
            (Self::FeedRate(a), Self::FeedRate(b))
            | (Self::SpindleSpeed(a), Self::SpindleSpeed(b))
            | (Self::Rotation(a), Self::Rotation(b)) => a.covers(b),
            (Self::SpindleMode(a), Self::SpindleMode(b)) => a.covers(b),
            (Self::Shift(a), Self::Shift(b))
            | (Self::LengthOffset(a), Self::LengthOffset(b))
            | (Self::KnownWay(a), Self::KnownWay(b)) => a.covers(b),
            (
                Self::WorkOffset { number, offset, rotation },
                Self::WorkOffset { number: inner_number, offset: inner_offset, rotation: inner_rotation },
            ) => number == inner_number && offset.covers(inner_offset) && rotation.covers(inner_rotation),
            (Self::SelectTool(a), Self::SelectTool(b))
            | (Self::ToolChange(a), Self::ToolChange(b))
            | (Self::SetToolNumber(a), Self::SetToolNumber(b)) => a.is_none() || a == b,
            (Self::DataRow(a), Self::DataRow(b)) => {
                let covers = |((letter, a), (other, b)): (&(Letter, f64), &(Letter, f64))| {
                    letter == other && a.covers(b)
                };
                a.len() == b.len() && a.iter().zip(b.iter()).all(covers)
            }
            _ => self == inner,
        }
    }
}

/// The lengths that a bar is fed by; NaN unknown.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BarLengths {
    /// A part with its cutoff.
    pub part: Mm,
    /// The push of a new bar.
    pub initial: Mm,
    /// What must stay clamped behind a part.
    pub clamping: Mm,
}

/// A straight move.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Travel {
    /// Rapid, feed, …
    pub kind: TravelKind,
    /// Where the axes stand before.
    pub from: Position,
    /// The block's point, before compensation and mapping.
    pub programmed: Position,
    /// Where the axes stand after.
    pub to: Position,
    /// Made by a canned cycle or another operation that expands to several moves.
    pub expanded: bool,
}

/// What clearing a pocket comes to: an estimate from its area. What rests on an unknown tool or feed is NaN.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Clearing {
    /// Smallest X, Y and Z of the tool's centre.
    pub from: [Mm; 3],
    /// Largest X, Y and Z of the tool's centre.
    pub to: [Mm; 3],
    /// Levels that are cleared.
    pub levels: u32,
    /// Way at feed, without the way down.
    pub length: Mm,
    /// Time of that way.
    pub seconds: Seconds,
    /// The outline turns counter-clockwise, so that its inside is on its left.
    pub counter_clockwise: bool,
    /// The code of cutter compensation in effect; [`CodeIx::NONE`] where several may be.
    pub compensation: CodeIx,
    /// Where the tool stands, work coordinates.
    pub at: Position,
}

/// How a straight move is driven.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum TravelKind {
    /// As fast as the axes go.
    Rapid,
    /// At the feed in effect.
    Feed,
    /// At the feed in effect, until the probe or skip signal.
    Probe {
        /// Toward the work (the signal comes), else away (it goes).
        toward: bool,
        /// No signal is a fault.
        required: bool,
        /// Neither: goes on after the signal (`G31`).
        skip: bool,
    },
    /// Tied to the spindle.
    Thread,
}

/// A circular or helical move.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ArcMove {
    /// The plane of the circle.
    pub plane: Plane,
    /// Where the axes stand before.
    pub from: Position,
    /// The block's point, before compensation.
    pub programmed: Position,
    /// Where the axes stand after.
    pub to: Position,
    /// Centre in the plane's first and second axis.
    pub centre: (Mm, Mm),
    /// Turns: 1 for up to one turn counter-clockwise, −1 clockwise, ±n for n − 1 full turns more.
    pub turns: i32,
    /// Angle in radians, counter-clockwise positive, seen against the plane's normal.
    pub sweep: f64,
    /// Made by a canned cycle or another operation that expands to several moves.
    pub expanded: bool,
}

/// A curve given by control points.
#[derive(Debug, Clone, PartialEq)]
pub struct Curve {
    /// Where the axes stand before.
    pub from: Position,
    /// Where they stand after.
    pub to: Position,
    /// How many control points describe it.
    pub points: u32,
    /// The curve as pieces of circles: centre, turns and end in the XY plane.
    pub pieces: Rc<[CurvePiece]>,
}

/// A piece of a curve.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum CurvePiece {
    /// Straight to a point.
    Line([Mm; 2]),
    /// On a circle to a point.
    Arc {
        /// End.
        to: [Mm; 2],
        /// Centre.
        centre: [Mm; 2],
        /// 1 counter-clockwise, −1 clockwise.
        turn: i32,
    },
}

/// What `F` means.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum FeedMode {
    /// Moves a minute.
    InverseTime,
    /// Length a minute.
    PerMinute,
    /// Length per turn of the spindle.
    PerRevolution,
}

/// Units of the program.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Units {
    /// Inches.
    Inch,
    /// Millimetres.
    Mm,
}

impl Units {
    /// Millimetres in one unit.
    pub const fn in_mm(self) -> f64 {
        match self {
            Self::Inch => 25.4,
            Self::Mm => 1.0,
        }
    }
}

/// How corners between moves are taken.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum PathMode {
    /// Every point is passed.
    ExactPath,
    /// The axes stop at every point.
    ExactStop,
    /// Corners are blended.
    Blending {
        /// Largest distance from the path; 0 when not given.
        tolerance: Mm,
        /// Tolerance of joining nearly straight moves; `None` when not given.
        naive: Option<Mm>,
    },
}

impl PathMode {
    /// The effect of the code that switches it on, and the lengths that the code takes, by their addresses.
    pub fn written(self) -> (Effect, impl Iterator<Item = (char, Mm)>) {
        let (effect, tolerance, naive) = match self {
            Self::ExactPath => (Effect::ExactPath, None, None),
            Self::ExactStop => (Effect::ExactStop, None, None),
            Self::Blending { tolerance, naive } => {
                (Effect::PathBlending, Some(tolerance).filter(|tolerance| tolerance.0 > 0.0), naive)
            }
        };
        let words = [('P', tolerance), ('Q', naive)].into_iter();
        (effect, words.filter_map(|(letter, length)| Some((letter, length?))))
    }
}

/// How exactly corners are taken. Without level and tolerance the control's settings count again; with one of them the
/// other one stays.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Smoothing {
    /// 1 rough, 2 medium, 3 finish.
    pub level: Option<u8>,
    /// Largest distance from the path.
    pub tolerance: Option<Mm>,
}

/// The spindle.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Spindle {
    /// Turns clockwise (`M3`).
    Clockwise,
    /// Turns counter-clockwise (`M4`).
    CounterClockwise,
    /// Stands.
    Stopped,
}

impl Spindle {
    /// Turns, either way round.
    pub const fn turns(self) -> bool {
        matches!(self, Self::Clockwise | Self::CounterClockwise)
    }
}

/// Kinds of coolant.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Coolant {
    /// Mist.
    Mist,
    /// Flood.
    Flood,
    /// Through the spindle.
    Through,
}

/// What an operator may override.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Override {
    /// The feed.
    Feed,
    /// The spindle speed.
    Speed,
    /// Feed that follows an input.
    Adaptive,
    /// An input that stops the feed.
    FeedStop,
}

/// Kinds of stop.
#[derive(Debug, Clone, PartialEq)]
pub enum Stop {
    /// Always.
    Program,
    /// When the operator's switch is on.
    Optional,
    /// After a change of pallets.
    Pallet,
    /// With a message.
    Message(Rc<str>),
}

/// A line of the tool table, millimetres.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ToolEntry {
    /// Pocket or number in the table.
    pub pocket: u32,
    /// Tool number.
    pub tool: u32,
    /// Offsets by axis.
    pub offset: Position,
    /// Diameter.
    pub diameter: Mm,
    /// Lathe tool angles, degrees, and orientation.
    pub angles: [f64; 2],
    /// Lathe orientation, 0 to 9.
    pub orientation: u8,
}
