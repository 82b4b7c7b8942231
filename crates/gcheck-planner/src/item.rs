//! What a planner is given: moves, and what happens between them.
//!
//! Knows: the path, the speed that was asked for, what stops it. Must not know: how fast it is run, programs.

use gcheck_geometry::{Arc, Mm, Rpm, Seconds};

use crate::axes::Point;
use crate::machine::Corners;

/// One thing that a machine does, in order. `T` comes back with the time that it takes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Item<T> {
    /// Axes move.
    Move(Move<T>),
    /// How the moves from here on meet.
    Meeting(Meeting),
    /// Something that the axes stop for, of no duration of its own.
    Halt,
    /// The control takes corners in another way from here on.
    Corners(Corners),
    /// The axes do not move for a time.
    Pause {
        /// How long.
        seconds: Seconds,
        /// An auxiliary function makes them, else the program.
        auxiliary: bool,
        /// Whose it is.
        tag: T,
    },
    /// The spindle is told to turn at a speed, counter-clockwise negative, 0 to stop.
    Spindle {
        /// Turns a minute.
        speed: Rpm,
        /// Whose it is.
        tag: T,
    },
    /// The spindle is turned to an angle.
    Orient {
        /// Whose it is.
        tag: T,
    },
    /// A tool is called for: the magazine may turn to its pocket.
    Call {
        /// Its pocket.
        pocket: u32,
    },
    /// A tool is changed.
    Change {
        /// Pocket of the tool that comes; `None` unknown.
        pocket: Option<u32>,
        /// Whose it is.
        tag: T,
    },
}

/// A move: straight, or on an arc of X, Y and Z with the other axes evenly along.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Move<T> {
    /// How it is driven.
    pub drive: Drive,
    /// Where it begins.
    pub from: Point,
    /// Where it ends.
    pub to: Point,
    /// The arc; `None` for a straight move.
    pub arc: Option<Arc>,
    /// What it takes at the speed that was asked for, axes and acceleration left out; zero for rapid moves.
    pub asked: Seconds,
    /// Whose it is.
    pub tag: T,
}

/// How a move is driven.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Drive {
    /// As fast as the axes go.
    Rapid,
    /// At a feed.
    Feed,
    /// At a feed, until a signal.
    Probe,
    /// Tied to the spindle at this speed.
    Thread(Rpm),
    /// One stroke of a tap, in or out, with the spindle at this speed.
    Tap(Rpm),
}

/// How moves meet.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Meeting {
    /// The axes stop after each.
    Stop,
    /// Every point is passed; the axes stop only where they must.
    Exact,
    /// Corners may be off.
    Rounded {
        /// By how much; `None` where the program gives no tolerance.
        tolerance: Option<Mm>,
        /// Straight moves that are this near to one straight line are made one; zero for none.
        merge: Mm,
    },
}
