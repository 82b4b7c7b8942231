//! What is drawn: points in the order of the run, tools, files, extents.
//!
//! Knows: the form of a recorded path and the notes beside it. Must not know: SVG, pages, how paths come about.

use std::fmt::Write as _;

use gcheck_engine::Units;
use gcheck_geometry::Mm;

use super::drive::Drive;
use super::note::{Assumed, Missing, Note};
use super::palette;
use crate::step::View;

/// How a point is reached.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[repr(u8)]
pub(super) enum Kind {
    /// Not at all: a path begins here.
    Start = 0,
    Rapid = 1,
    Feed = 2,
    Arc = 3,
    Probe = 4,
    /// Tied to the spindle: a thread, a tap.
    Spindle = 5,
}

/// A point of the path; NaN where a coordinate is unknown, until the drawing is finished.
#[derive(Debug, Clone, Copy)]
pub(super) struct Point {
    pub(super) at: [f32; 3],
    /// Since the start of the run.
    pub(super) seconds: f32,
    /// Line of the block that moves to it, from 1.
    pub(super) line: u32,
    pub(super) kind: Kind,
    /// Index of the tool.
    pub(super) tool: u8,
    /// Index of the file.
    pub(super) file: u8,
    /// Index of the feed and the spindle's speed on the way to it.
    pub(super) drive: u16,
    /// Index of the blocks that called its program; 0 for none.
    pub(super) call: u16,
    /// Where the rotary axes A, B, C are, degrees.
    pub(super) rotary: [f32; 3],
}

/// A block at which the control would stop.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Alarm {
    /// Index of the file.
    pub(super) file: u8,
    /// Line of the block, from 1.
    pub(super) line: u32,
    /// Where the tool was; `None` before the first move.
    pub(super) at: Option<[f32; 3]>,
}

/// A tool of the drawing.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Tool {
    /// Its number; `None` unknown.
    pub number: Option<u32>,
    /// Its colour, `#rrggbb`.
    pub color: &'static str,
    /// Its diameter, where that is told.
    pub diameter: Option<Mm>,
}

impl Tool {
    pub(super) fn new(index: usize, number: Option<u32>) -> Self {
        Self { number, color: palette::color(index), diameter: None }
    }

    /// `T3`, with what the tool is called.
    pub(super) fn words(&self, name: Option<&str>) -> String {
        let mut words = match self.number {
            Some(0) => "no tool".to_owned(),
            Some(number) => format!("T{number}"),
            None => "unknown tool".to_owned(),
        };
        if let Some(name) = name {
            // Writing to a string cannot fail.
            let _ = write!(words, " {name}");
        }
        words
    }
}

/// The path has fewer points than the run.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Thinned {
    /// The path that is drawn stays this close to the real one, millimetres; infinite where it may be anywhere.
    pub tolerance: f64,
}

/// The recorded path of a run.
#[derive(Debug, Clone)]
#[expect(clippy::struct_excessive_bools, reason = "each is a separate fact about the path")]
pub struct Drawing {
    pub(super) view: View,
    pub(super) lathe: bool,
    pub(super) units: Units,
    pub(super) points: Vec<Point>,
    pub(super) tools: Vec<Tool>,
    pub(super) files: Vec<String>,
    /// Extents of moves that cut: smallest and largest X, Y, Z, millimetres.
    pub(super) cut: Option<[[f64; 3]; 2]>,
    /// Extents of all moves.
    pub(super) all: Option<[[f64; 3]; 2]>,
    pub(super) moves: u64,
    pub(super) seconds: f64,
    pub(super) untimed: bool,
    pub(super) overlaid: bool,
    pub(super) turned: bool,
    pub(super) pockets: u64,
    pub(super) thinned: Option<Thinned>,
    pub(super) alarms: Vec<Alarm>,
    /// Feeds and speeds, by the index that points have.
    pub(super) drives: Vec<Drive>,
    /// Blocks that call, each list the outermost first, by the index that points have: file and line.
    pub(super) calls: Vec<Vec<(u8, u32)>>,
    /// Rotary axes that turn: A, B, C.
    pub(super) rotary: [bool; 3],
    /// File and line of each block that changes the tool, in the order of the run, each once.
    pub(super) changes: Vec<(u8, u32)>,
    /// Moves drawn where the program was posted, and on the contour that compensation runs beside.
    pub(super) posted: u64,
    pub(super) on_contour: u64,
    /// Moves that are not drawn.
    pub(super) left_out: Missing,
    /// What the run took for granted, and the moves rest on.
    pub(super) assumed: Assumed,
    /// The work coordinate systems in which something moved, with the places of their zeros that are known, millimetres.
    pub(super) zeros: Vec<(u16, [f64; 3])>,
    /// How far the machine goes in X and Y, millimetres, where that is known.
    pub(super) travel: [Option<[f64; 2]>; 2],
}

impl Drawing {
    /// Files of which moves are drawn, as the steps of the run named them.
    pub fn files(&self) -> &[String] {
        &self.files
    }

    /// The tools that moved, in the order in which they came.
    pub fn tools(&self) -> &[Tool] {
        &self.tools
    }

    /// Moves of the run, drawn or not.
    pub const fn moves(&self) -> u64 {
        self.moves
    }

    /// Points that are drawn.
    pub fn points(&self) -> usize {
        self.points.len()
    }

    /// Time of the run, as far as it is known.
    pub const fn seconds(&self) -> gcheck_geometry::Seconds {
        gcheck_geometry::Seconds(self.seconds)
    }

    /// Units in which most moves were written.
    pub const fn units(&self) -> Units {
        self.units
    }

    /// Whether the path has fewer points than the run.
    pub const fn thinned(&self) -> Option<Thinned> {
        self.thinned
    }

    /// What a reader of the picture has to know.
    pub fn notes(&self) -> Vec<Note> {
        let mut notes = self.assumed.notes();
        if self.points.is_empty() {
            notes.push(if self.moves == 0 {
                "the program moves nothing".into()
            } else {
                "nothing can be drawn: no move starts and ends at places that are known".into()
            });
        }
        notes.extend(self.left_out.note(&self.files));
        if let Some(Thinned { tolerance }) = self.thinned {
            let close = if tolerance.is_finite() {
                format!("within {} of the path", self.rounded_up(tolerance))
            } else {
                "many moves are left out".to_owned()
            };
            let points = self.points.len();
            notes.push(format!("the {} moves are drawn with {points} points: {close}", self.moves).into());
        }
        if self.overlaid {
            notes.push(
                "work offsets whose values nobody told are drawn as if they were one; `[offsets]` in gcheck.toml parts them"
                    .into(),
            );
        }
        if self.turned {
            notes.push(
                "the picture shows the work without its rotary turns; an `.html` page can turn it with one axis (Rotary axis, under Options)"
                    .into(),
            );
        }
        if self.posted > 0 {
            notes.push(
                "moves of a tilting tool are drawn at the posted points: the place of the tip is not known; `posted_length` of the tool and `pivot_length` in gcheck.toml tell it"
                    .into(),
            );
        }
        if self.on_contour > 0 {
            notes.push(
                "moves under compensation for a tool of unknown size are drawn on the programmed contour, arcs as straight lines; `[tools]` in gcheck.toml can tell its size"
                    .into(),
            );
        }
        if self.pockets > 0 {
            notes.push("pockets that the control clears by a path of its own are drawn as rectangles".into());
        }
        if self.untimed {
            notes.push("moves without a known feed are played at 1000 mm/min".into());
        }
        notes
    }

    /// A length with its unit, rounded up to two digits.
    fn rounded_up(&self, mm: f64) -> String {
        let (value, unit) = match self.units {
            Units::Inch => (mm / 25.4, "inch"),
            Units::Mm => (mm, "mm"),
        };
        let digits = 10f64.powf(value.max(1e-6).log10().floor() - 1.0);
        let rounded = (value / digits).ceil() * digits;
        let mut out = Vec::new();
        crate::number::brief(&mut out, rounded, 6, "?");
        format!("{} {unit}", String::from_utf8_lossy(&out))
    }
}
