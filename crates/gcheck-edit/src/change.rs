//! The changes that there are, with what they need to know.
//!
//! Knows: their names and parameters. Must not know: how they are made or proved.

use gcheck_engine::{Axis, Units};

/// A change of a program.
#[derive(Debug, Clone, PartialEq)]
pub enum Change {
    /// Feeds of cuts times a factor.
    ScaleFeeds(f64),
    /// Spindle speeds times a factor.
    ScaleSpeeds(f64),
    /// Every point moved by so much along X, Y and Z.
    Translate([Amount; 3]),
    /// Every point mirrored at a plane across an axis, which is at this coordinate.
    Mirror(Axis, Amount),
    /// Every point turned counter-clockwise by quarters of a turn about a point of X and Y.
    Rotate(u8, [Amount; 2]),
    /// Blocks get other numbers, and what names them with them; the edits come from elsewhere.
    Renumber,
    /// Canned cycles as plain moves.
    ExpandCycle,
    /// Plain moves that drill holes as canned cycles.
    FoldCycle,
    /// Loops turn by turn.
    UnrollLoop,
    /// Increments as absolute coordinates.
    Absolute,
    /// Absolute coordinates as increments.
    Incremental,
    /// Lines that say the modes in front of tool changes.
    SafeStart,
    /// The program in these units.
    Convert(Units),
    /// The section of a tool at another place among those of the others.
    MoveSection(Destination),
}

/// Where the section of a tool goes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Destination {
    /// In front of the section above it.
    Up,
    /// After the section below it.
    Down,
    /// In front of the first section of this tool.
    Before(u32),
    /// After the last section of this tool.
    After(u32),
}

/// A length as somebody gives it for a program.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Amount {
    /// The number. Along X of a lathe it counts a diameter where the program does.
    pub number: f64,
    /// Its unit; that of the program without one.
    pub units: Option<Units>,
}

impl Amount {
    /// Nothing, in any unit.
    pub const ZERO: Self = Self { number: 0.0, units: None };

    /// A length as people write it: `10`, `-2.5mm`, `0.5in`.
    ///
    /// # Errors
    /// How a length is to be written.
    pub fn parse(text: &str) -> Result<Self, String> {
        let text = text.trim();
        let units = [("mm", Units::Mm), ("inch", Units::Inch), ("in", Units::Inch)];
        let with_unit = units.into_iter().find_map(|(name, unit)| Some((text.strip_suffix(name)?, unit)));
        let (number, units) = with_unit.map_or((text, None), |(number, unit)| (number, Some(unit)));
        match number.trim().parse::<f64>() {
            Ok(number) if number.is_finite() => Ok(Self { number, units }),
            _ => Err("write a length such as 10, -2.5, 10mm or 0.5in".to_owned()),
        }
    }

    /// A number in the unit of the program.
    pub const fn in_program(number: f64) -> Self {
        Self { number, units: None }
    }

    /// Millimetres, where the program's own unit is `program`.
    pub(crate) fn in_mm(self, program: Units) -> f64 {
        self.number * self.units.unwrap_or(program).in_mm()
    }
}

impl Change {
    /// Its name on the command line.
    pub const fn name(&self) -> &'static str {
        match self {
            Self::ScaleFeeds(_) => "scale-feeds",
            Self::ScaleSpeeds(_) => "scale-speeds",
            Self::Translate(_) => "translate",
            Self::Mirror(..) => "mirror",
            Self::Rotate(..) => "rotate",
            Self::Renumber => "renumber",
            Self::ExpandCycle => "expand-cycle",
            Self::FoldCycle => "fold-cycle",
            Self::UnrollLoop => "unroll-loop",
            Self::Absolute => "absolute",
            Self::Incremental => "incremental",
            Self::SafeStart => "safe-start",
            Self::Convert(Units::Inch) => "inch",
            Self::Convert(Units::Mm) => "mm",
            Self::MoveSection(_) => "move-section",
        }
    }

    /// Are the moves after it those of before?
    pub const fn keeps_moves(&self) -> bool {
        !matches!(
            self,
            Self::ScaleFeeds(_)
                | Self::ScaleSpeeds(_)
                | Self::Translate(_)
                | Self::Mirror(..)
                | Self::Rotate(..)
        )
    }

    /// Do the sections of tools come in another order after it?
    pub const fn moves_sections(&self) -> bool {
        matches!(self, Self::MoveSection(_))
    }

    /// How close moves stay to what it claims unless somebody asks for something else: millimetres. Words in inches are rounded
    /// to 0.0001 inch on most controls.
    pub const fn tolerance(&self) -> f64 {
        if matches!(self, Self::Convert(Units::Inch)) { 0.002 } else { 0.001 }
    }

    /// What it does, in words that follow "cannot".
    pub const fn verb(&self) -> &'static str {
        match self {
            Self::ScaleFeeds(_) => "scale the feeds",
            Self::ScaleSpeeds(_) => "scale the spindle speeds",
            Self::Translate(_) => "shift the path",
            Self::Mirror(..) => "mirror the path",
            Self::Rotate(..) => "rotate the path",
            Self::Renumber => "renumber",
            Self::ExpandCycle => "write the cycle as moves",
            Self::FoldCycle => "write the moves as a cycle",
            Self::UnrollLoop => "unroll the loop",
            Self::Absolute => "write absolute coordinates",
            Self::Incremental => "write increments",
            Self::SafeStart => "insert safe start lines",
            Self::Convert(Units::Inch) => "write the program in inches",
            Self::Convert(Units::Mm) => "write the program in millimetres",
            Self::MoveSection(_) => "move the section of a tool",
        }
    }

    /// What is true of the selected moves after it: "every move is shifted by X10".
    pub fn claim(&self) -> String {
        let of = |amount: &Amount| {
            let unit = match amount.units {
                Some(Units::Mm) => " mm",
                Some(Units::Inch) => " inch",
                None => "",
            };
            format!("{}{unit}", plain(amount.number))
        };
        match self {
            Self::Renumber
            | Self::ExpandCycle
            | Self::FoldCycle
            | Self::UnrollLoop
            | Self::Absolute
            | Self::Incremental
            | Self::SafeStart
            | Self::Convert(_) => "every move is as before".to_owned(),
            Self::MoveSection(_) => {
                "the tools come in another order, and every move of each section is as before".to_owned()
            }
            Self::ScaleFeeds(factor) => format!("every feed is {} times what it was", plain(*factor)),
            Self::ScaleSpeeds(factor) => {
                format!("every spindle speed is {} times what it was", plain(*factor))
            }
            Self::Translate(by) => {
                let axes = ['X', 'Y', 'Z'].iter().zip(by).filter(|(_, amount)| amount.number != 0.0);
                let words: Vec<String> = axes.map(|(axis, amount)| format!("{axis}{}", of(amount))).collect();
                format!("every move is shifted by {}", words.join(" "))
            }
            Self::Mirror(axis, at) => format!("every move is mirrored at {}{}", axis.name(), of(at)),
            Self::Rotate(quarters, [x, y]) => {
                let degrees = u32::from(*quarters) * 90;
                format!("every move is rotated by {degrees}° about X{} Y{}", of(x), of(y))
            }
        }
    }
}

/// A number as people write it.
fn plain(number: f64) -> String {
    let text = format!("{number:.6}");
    text.trim_end_matches('0').trim_end_matches('.').to_owned()
}
