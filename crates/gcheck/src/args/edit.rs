//! The arguments of `gcheck edit`.
//!
//! Knows: names, help texts, forms of values. Must not know: what a change does.

use std::path::PathBuf;

use clap::{ArgGroup, Args, Subcommand, ValueEnum};
use gcheck_edit::Amount;
use gcheck_format::Numbering;

use super::values::{Assignment, BlockSkip, FUEL, Switch, assignment, block_skip, numbering, tolerance};

/// The changes of `gcheck edit`.
#[derive(Debug, Subcommand)]
pub enum EditCommand {
    /// Multiply the feeds of cuts by a factor
    ///
    /// The lead of a thread and the feed of a tap stay. A block of the selection that cuts at a feed from before gets an F
    /// word, and so does the first cut after the selection.
    ScaleFeeds {
        /// The factor: `0.8` or `80%`
        #[arg(value_name = "FACTOR", value_parser = factor)]
        factor: f64,
        /// The program and the part of it that changes.
        #[command(flatten)]
        target: EditTarget,
    },
    /// Multiply the spindle speeds, or surface speeds, by a factor
    ///
    /// The feed of a tap under feed per minute goes with the speed. The limit of the speed (`G50 S`) stays.
    ScaleSpeeds {
        /// The factor: `1.1` or `110%`
        #[arg(value_name = "FACTOR", value_parser = factor)]
        factor: f64,
        /// The program and the part of it that changes.
        #[command(flatten)]
        target: EditTarget,
    },
    /// Shift the path
    ///
    /// Absolute coordinates change, and so do levels of cycles and absolute centres of arcs. Increments stay, and so do
    /// moves to places of the machine (`G53`, `G28`). A computed word gets a sum: `X#1` becomes `X[#1+10.]`.
    Translate {
        /// Along X; on a lathe as the program counts X, so usually a diameter
        #[arg(long, value_name = "LENGTH", value_parser = Amount::parse, allow_hyphen_values = true)]
        x: Option<Amount>,
        /// Along Y
        #[arg(long, value_name = "LENGTH", value_parser = Amount::parse, allow_hyphen_values = true)]
        y: Option<Amount>,
        /// Along Z
        #[arg(long, value_name = "LENGTH", value_parser = Amount::parse, allow_hyphen_values = true)]
        z: Option<Amount>,
        /// The program and the part of it that changes.
        #[command(flatten)]
        target: EditTarget,
    },
    /// Mirror the path
    ///
    /// Arcs and cutter compensation turn the other way round. The spindle does not: climb milling becomes conventional.
    Mirror {
        /// The axis whose coordinates change their sign
        #[arg(value_enum, ignore_case = true, value_name = "X|Y|Z")]
        axis: MirrorAxis,
        /// The coordinate that stays where it is; 0 without it
        #[arg(long, value_name = "LENGTH", value_parser = Amount::parse, allow_hyphen_values = true)]
        at: Option<Amount>,
        /// The program and the part of it that changes.
        #[command(flatten)]
        target: EditTarget,
    },
    /// Rotate the path counter-clockwise about Z
    Rotate {
        /// By how many degrees: 90, 180 or 270
        #[arg(value_enum, value_name = "DEGREES")]
        degrees: QuarterTurns,
        /// The point that stays where it is: `50,20`; the zero of the program without it
        #[arg(long, value_name = "X,Y", value_parser = about, allow_hyphen_values = true)]
        about: Option<About>,
        /// The program and the part of it that changes.
        #[command(flatten)]
        target: EditTarget,
    },
    /// Write canned cycles as the plain moves that they are made of
    ///
    /// Drilling, pecking and boring at feed become `G0`, `G1` and `G4`. Cycles that tap or stop the spindle stay.
    ExpandCycle {
        /// The program and the part of it that changes.
        #[command(flatten)]
        target: EditTarget,
    },
    /// Write holes that plain moves drill as canned cycles
    ///
    /// Rapid moves over a hole, cuts down, pecks, dwells and retracts become blocks of the control's own drilling and boring
    /// cycles. Moves that no cycle of the control makes in the same way stay.
    FoldCycle {
        /// The program and the part of it that changes.
        #[command(flatten)]
        target: EditTarget,
    },
    /// Write loops turn by turn, with values in the place of variables
    ///
    /// `WHILE … END` and the O-word loops of LinuxCNC become plain blocks. Variables that a later block reads, or that
    /// live longer than the program, get their last value.
    UnrollLoop {
        /// The program and the part of it that changes.
        #[command(flatten)]
        target: EditTarget,
    },
    /// Write increments (`G91`) as absolute coordinates (`G90`)
    Absolute {
        /// The program and the part of it that changes.
        #[command(flatten)]
        target: EditTarget,
    },
    /// Write absolute coordinates (`G90`) as increments (`G91`)
    Incremental {
        /// The program and the part of it that changes.
        #[command(flatten)]
        target: EditTarget,
    },
    /// Write a program in inches as one in millimetres
    ///
    /// Lengths, feeds and surface speeds change, with the digits that the control resolves.
    Mm {
        /// The program and the part of it that changes.
        #[command(flatten)]
        target: EditTarget,
    },
    /// Write a program in millimetres as one in inches
    ///
    /// Lengths, feeds and surface speeds change, with the digits that the control resolves. A ten-thousandth of an inch is
    /// more than a thousandth of a millimetre, so moves are compared within 0.002 mm.
    Inch {
        /// The program and the part of it that changes.
        #[command(flatten)]
        target: EditTarget,
    },
    /// Say the modes in a line in front of each tool change, so that an operator can start there
    ///
    /// The line says what is in effect there anyway: units, plane, the feed mode, and that cutter compensation, tool length and
    /// cycles are off if they are; and `G90`, if the program goes on with it. A tool change with such a line gets no other.
    SafeStart {
        /// The program and the part of it that changes.
        #[command(flatten)]
        target: EditTarget,
    },
    /// Move the section of a tool to another place among those of the other tools
    ///
    /// `--tool 3` or a line of the section with `--lines` says which one. It goes with the comments above its tool change.
    /// Where each section calls the tool of the next one early (`T4` while T3 works), these words follow the new order.
    #[command(group = ArgGroup::new("place").required(true))]
    MoveSection {
        /// In front of the first section of this tool
        #[arg(long, value_name = "N", group = "place")]
        before: Option<u32>,
        /// After the last section of this tool
        #[arg(long, value_name = "N", group = "place")]
        after: Option<u32>,
        /// In front of the section above it
        #[arg(long, group = "place")]
        up: bool,
        /// After the section below it
        #[arg(long, group = "place")]
        down: bool,
        /// The program and the section that moves.
        #[command(flatten)]
        target: EditTarget,
    },
    /// Number the blocks again, with every word that names one
    Renumber {
        /// The first number and the step: `10:10`
        #[arg(value_name = "START:STEP", value_parser = numbering)]
        numbering: Numbering,
        /// The program and the part of it that changes.
        #[command(flatten)]
        target: EditTarget,
    },
}

/// The axis of a mirror.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum MirrorAxis {
    /// X
    X,
    /// Y
    Y,
    /// Z
    Z,
}

/// Turns by quarters.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum QuarterTurns {
    /// A quarter
    #[value(name = "90")]
    One,
    /// Half a turn
    #[value(name = "180")]
    Two,
    /// Three quarters
    #[value(name = "270")]
    Three,
}

/// A point of X and Y.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct About(pub [Amount; 2]);

/// What every change takes.
#[derive(Debug, Args)]
pub struct EditTarget {
    /// The program; `-` reads standard input and writes standard output
    #[arg(value_name = "FILE")]
    pub file: PathBuf,
    /// The name of the program on standard input, for messages and for its settings
    #[arg(long, value_name = "PATH")]
    pub stdin_filename: Option<PathBuf>,
    /// Change the blocks of these lines only: `12-40` or `12`
    #[arg(long, value_name = "A-B", value_parser = lines, conflicts_with = "tool")]
    pub lines: Option<Lines>,
    /// Change the blocks that run with this tool in the spindle only: `3`
    #[arg(long, value_name = "N")]
    pub tool: Option<u32>,
    /// Change nothing; print the file's name and exit with 1 if it would change
    #[arg(long, conflicts_with = "diff")]
    pub check: bool,
    /// Change nothing; print what would change and exit with 1 if anything would
    #[arg(long)]
    pub diff: bool,
    /// The moves are as the change says while they stay this close on every axis: millimetres, or degrees on rotary axes;
    /// 0.001 without it, and 0.002 for `inch`
    #[arg(long, value_name = "MM", value_parser = tolerance)]
    pub tolerance: Option<f64>,
    /// A variable's value before the program starts: `--set '#100=2.5'`, `--set '#<name>=1'` (may be repeated)
    #[arg(long, value_name = "VARIABLE=VALUE", value_parser = assignment)]
    pub set: Vec<Assignment>,
    /// The block delete switch; without it a program with `/` is proved with the switch off and with it on
    #[arg(long, value_name = "on|off|LEVELS", value_parser = block_skip)]
    pub block_skip: Option<BlockSkip>,
    /// The optional stop switch: whether `M1` stops
    #[arg(long, value_enum, value_name = "on|off", default_value_t)]
    pub optional_stop: Switch,
    /// Blocks that each run may execute
    #[arg(long, value_name = "BLOCKS", default_value_t = FUEL)]
    pub fuel: u64,
}

/// Lines of a file, counted from 1, both included.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Lines {
    /// The first.
    pub first: u32,
    /// The last.
    pub last: u32,
}

impl EditCommand {
    /// The program and the part of it that changes.
    pub const fn target(&self) -> &EditTarget {
        match self {
            Self::ScaleFeeds { target, .. }
            | Self::ScaleSpeeds { target, .. }
            | Self::Translate { target, .. }
            | Self::Mirror { target, .. }
            | Self::Rotate { target, .. }
            | Self::ExpandCycle { target }
            | Self::FoldCycle { target }
            | Self::UnrollLoop { target }
            | Self::Absolute { target }
            | Self::Incremental { target }
            | Self::SafeStart { target }
            | Self::MoveSection { target, .. }
            | Self::Mm { target }
            | Self::Inch { target }
            | Self::Renumber { target, .. } => target,
        }
    }
}

/// Nobody means a larger factor: `80` is 80 percent.
const MOST: f64 = 10.0;

fn factor(text: &str) -> Result<f64, String> {
    let percent = text.strip_suffix('%');
    let factor = |number: f64| if percent.is_some() { number / 100.0 } else { number };
    match percent.unwrap_or(text).trim().parse::<f64>() {
        Ok(number) if number > 0.0 && factor(number) <= MOST => Ok(factor(number)),
        Ok(number) if number > MOST && percent.is_none() && number.is_finite() => {
            Err(format!("that is {number} times as fast; write {number}% if you mean percent"))
        }
        Ok(number) if number > MOST => Err(format!("a factor is {MOST} or less, which is {}%", MOST * 100.0)),
        _ => Err("write a factor above zero, such as 0.8 or 80%".to_owned()),
    }
}

fn about(text: &str) -> Result<About, String> {
    let (x, y) = text.split_once(',').ok_or("write X and Y with a comma between them, such as 50,20")?;
    Ok(About([Amount::parse(x)?, Amount::parse(y)?]))
}

fn lines(text: &str) -> Result<Lines, String> {
    let (first, last) = text.split_once('-').unwrap_or((text, text));
    match (first.trim().parse(), last.trim().parse()) {
        (Ok(first), Ok(last)) if first >= 1 && first <= last => Ok(Lines { first, last }),
        _ => Err("write the first and the last line, counted from 1, such as 12-40".to_owned()),
    }
}
