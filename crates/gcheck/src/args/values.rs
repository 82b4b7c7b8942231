//! Values of options that several commands take, and how they are read.
//!
//! Knows: forms of values. Must not know: commands.

use clap::ValueEnum;
use gcheck_format::Numbering;

/// Blocks that may be executed when nobody says otherwise.
pub(crate) const FUEL: u64 = gcheck_lint::Execution::FUEL;

/// A switch of the operator's panel.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, ValueEnum)]
pub enum Switch {
    /// It acts.
    On,
    /// It does not.
    #[default]
    Off,
}

/// A variable and its value: `#100=2.5`.
#[derive(Debug, Clone, PartialEq)]
pub struct Assignment {
    /// What is set.
    pub variable: VariableName,
    /// To what.
    pub value: f64,
}

/// A variable as a command line names it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum VariableName {
    /// `#100`
    Number(u32),
    /// `#<name>`, lower case without blanks.
    Name(String),
}

/// Levels of block delete that are switched on: bit 0 is a plain `/` and level 1.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct BlockSkip(pub u16);

/// The name of a control, whatever its case; a name that no control has is refused where it is used.
#[expect(clippy::unnecessary_wraps, reason = "the form of a parser")]
pub(super) fn control_name(text: &str) -> Result<String, String> {
    let known = gcheck_controls::names().iter().find(|name| name.eq_ignore_ascii_case(text));
    Ok(known.map_or_else(|| text.to_owned(), |name| (*name).to_owned()))
}

/// A whole number from 0.
pub(super) fn count(text: &str) -> Result<usize, String> {
    text.parse().map_err(|_| "write a whole number from 0".to_owned())
}

/// How many files at a time: a whole number from 1.
pub(super) fn jobs(text: &str) -> Result<usize, String> {
    { text.parse().ok() }.filter(|jobs| *jobs > 0).ok_or_else(|| "write a whole number from 1".to_owned())
}

/// A number of blocks from 1; `1e6` and `1_000_000` are one as well.
pub(super) fn fuel(text: &str) -> Result<u64, String> {
    let digits: String = text.chars().filter(|c| !matches!(c, '_' | ',')).collect();
    let blocks = digits.parse().ok().or_else(|| {
        let blocks = digits.parse::<f64>().ok()?;
        let is_whole = blocks.fract() == 0.0 && (0.0..=MOST_FUEL).contains(&blocks);
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "the range is checked")]
        is_whole.then_some(blocks as u64)
    });
    match blocks {
        Some(0) => Err("nothing is executed with 0 blocks; write a whole number from 1".to_owned()),
        Some(blocks) => Ok(blocks),
        None => Err("write a whole number of blocks, such as `1000000` or `1e6`".to_owned()),
    }
}

/// Beyond this not every whole number is one of these.
const MOST_FUEL: f64 = 9e15;

pub(super) fn tolerance(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(value) if value > MOST_TOLERANCE => {
            Err(format!("within {MOST_TOLERANCE} mm any two paths may be the same; write a smaller length"))
        }
        Ok(value) if value.is_finite() && value >= 0.0 => Ok(value),
        _ => Err("write a length in millimetres, such as 0.001".to_owned()),
    }
}

/// Tools are as large as this, and more is a slip of the pen.
const MOST_TOLERANCE: f64 = 100.0;

pub(super) fn assignment(text: &str) -> Result<Assignment, String> {
    let (name, value) = text.split_once('=').ok_or("write `#100=2.5` or `#<name>=1`")?;
    let value: f64 = value.trim().parse().map_err(|_| format!("`{}` is not a number", value.trim()))?;
    if !value.is_finite() {
        return Err(format!("`{value}` is not a number that a control can hold"));
    }
    let variable = VariableName::parse(name)
        .ok_or_else(|| format!("`{}` is not a variable; write `#100` or `#<name>`", name.trim()))?;
    Ok(Assignment { variable, value })
}

impl VariableName {
    /// Reads `#100` or `#<name>`; the sign may be left out, as shells take it for a comment.
    pub fn parse(text: &str) -> Option<Self> {
        let text = text.trim();
        let inner = text.strip_prefix('#').unwrap_or(text);
        if let Some(name) = inner.strip_prefix('<').and_then(|rest| rest.strip_suffix('>')) {
            let name: String =
                name.chars().filter(|c| !c.is_whitespace()).flat_map(char::to_lowercase).collect();
            return (!name.is_empty()).then_some(Self::Name(name));
        }
        inner.parse().ok().map(Self::Number)
    }
}

pub(super) fn numbering(text: &str) -> Result<Numbering, String> {
    let numbers = text.split_once(':').and_then(|(start, step)| {
        Some(Numbering { start: start.trim().parse().ok()?, step: step.trim().parse().ok()? })
    });
    numbers
        .filter(|n| n.start > 0 && n.step > 0)
        .ok_or_else(|| "write the first number and the step, both whole and from 1, as in `10:10`".to_owned())
}

pub(super) fn block_skip(text: &str) -> Result<BlockSkip, String> {
    match text {
        "on" => return Ok(BlockSkip(u16::MAX)),
        "off" => return Ok(BlockSkip(0)),
        _ => {}
    }
    let mut bits = 0;
    for level in text.split(',') {
        match level.trim().parse::<u16>() {
            Ok(level @ 1..=9) => bits |= 1 << (level - 1),
            _ => return Err("write `on`, `off`, or levels from 1 to 9 such as `1,3`".to_owned()),
        }
    }
    Ok(BlockSkip(bits))
}
