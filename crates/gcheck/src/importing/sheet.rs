//! What one file says of a machine, in the keys of `gcheck.toml`: values with their place, and what was not used.
//!
//! Knows: keys, kinds of values, places in a file. Must not know: any format, how TOML is written.

use std::ops::Range;

use crate::Problem;
use crate::config::Units;

/// The mark of the byte order in UTF-8.
pub(super) const MARK: &[u8] = b"\xEF\xBB\xBF";

/// What a value counts in.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Value {
    /// Counts in the unit of lengths: positions, lengths a minute, a second squared, a second cubed.
    Length(f64),
    /// The two ends of a travel, in the unit of lengths.
    Ends([f64; 2]),
    /// Counts in something else: degrees, revolutions, seconds.
    Number(f64),
    /// A whole number of things.
    Count(u32),
    /// Two ends that count in something else.
    Plain([f64; 2]),
    /// A name.
    Text(String),
    /// Names.
    List(Vec<String>),
    /// A tool table, by its absolute path.
    Table(std::path::PathBuf),
}

impl Value {
    /// A figure of an axis: a length, or degrees on a rotary axis.
    pub(super) fn of_axis(axis: char, figure: f64) -> Self {
        if is_rotary(axis) { Self::Number(figure) } else { Self::Length(figure) }
    }

    /// Does it mean nothing without a unit?
    pub(super) fn counts_in_units(&self) -> bool {
        self.is_length() || matches!(self, Self::Table(_))
    }

    /// Is it written in the unit of the configuration? A table on disk has a unit of its own.
    pub(super) fn is_length(&self) -> bool {
        matches!(self, Self::Length(_) | Self::Ends(_))
    }
}

/// The axes that turn.
pub(super) fn is_rotary(axis: char) -> bool {
    matches!(axis, 'A' | 'B' | 'C')
}

/// A value for a key.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Fact {
    /// The way to the key: `["machine", "travel", "X"]`.
    pub(super) key: Vec<String>,
    pub(super) value: Value,
    /// Where it is from, in words that follow "from".
    pub(super) from: String,
    /// Where it is in the file.
    pub(super) line: usize,
}

/// Something of a file that has no place in `gcheck.toml`.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Unused {
    pub(super) line: usize,
    pub(super) what: String,
    pub(super) why: String,
}

/// What the unit of a file means for the machine, the least first.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Tells {
    /// Nothing: libraries and tables come from elsewhere.
    Nothing,
    /// The unit in which its control wrote its offsets.
    Offsets,
    /// The unit that the machine has when it is switched on.
    Machine,
}

/// Where the lines of a text are.
#[derive(Debug)]
pub(super) struct Lines {
    /// Bytes of the line feeds.
    ends: Vec<usize>,
}

impl Lines {
    pub(super) fn new(text: &str) -> Self {
        Self { ends: text.bytes().enumerate().filter(|(_, byte)| *byte == b'\n').map(|(at, _)| at).collect() }
    }

    /// Line of a byte, from 1.
    pub(super) fn line(&self, at: usize) -> usize {
        self.ends.partition_point(|end| *end < at) + 1
    }

    /// First byte of a line.
    pub(super) fn start(&self, line: usize) -> usize {
        line.checked_sub(2).and_then(|before| self.ends.get(before)).map_or(0, |end| end + 1)
    }
}

/// What is gathered of one file.
#[derive(Debug)]
pub(super) struct Sheet<'t> {
    /// As messages call the file.
    pub(super) shown: String,
    /// As comments call it: the name alone.
    pub(super) name: String,
    pub(super) text: &'t str,
    lines: Lines,
    /// A mark of the byte order was before the text.
    pub(super) has_mark: bool,
    /// The unit that the command line names, for lengths without one.
    pub(super) asked: Option<Units>,
    /// What its lengths count in, as the file says or else the command line.
    pub(super) units: Option<Units>,
    /// Where the file says its unit.
    pub(super) units_at: Option<Range<usize>>,
    /// Each length has come from its own unit to that of the file, so that `--units` contradicts none.
    pub(super) converted: bool,
    pub(super) tells: Tells,
    pub(super) facts: Vec<Fact>,
    pub(super) unused: Vec<Unused>,
    /// How much more is not used than is listed.
    pub(super) more_unused: usize,
    /// What the user should know of the values.
    pub(super) remarks: Vec<String>,
    /// What keeps the file from being taken at all.
    pub(super) problems: Vec<Problem>,
}

/// No figure of a machine is larger, whatever it counts in.
const MOST_FIGURE: f64 = 1e12;
/// Problems that are kept of one file: more say nothing new.
const MOST_PROBLEMS: usize = 20;
/// What is kept of what is not used.
const MOST_UNUSED: usize = 1000;

impl<'t> Sheet<'t> {
    pub(super) fn new(shown: String, name: String, text: &'t str, asked: Option<Units>) -> Self {
        Self {
            shown,
            name,
            text,
            lines: Lines::new(text),
            has_mark: false,
            asked,
            units: asked,
            units_at: None,
            converted: false,
            tells: Tells::Nothing,
            facts: Vec::new(),
            unused: Vec::new(),
            more_unused: 0,
            remarks: Vec::new(),
            problems: Vec::new(),
        }
    }

    /// Line of a byte, from 1.
    pub(super) fn line(&self, at: usize) -> usize {
        self.lines.line(at)
    }

    /// What is on a line, without its end.
    pub(super) fn range_of_line(&self, line: usize) -> Range<usize> {
        let start = self.lines.start(line);
        let told = self.text.get(start..).and_then(|rest| rest.lines().next()).unwrap_or_default();
        start..start + told.trim_end().len()
    }

    /// A value for a key; `place` says in words where it is, as in `[TRAJ] LINEAR_UNITS`.
    pub(super) fn put(&mut self, key: &[&str], value: Value, range: &Range<usize>, place: &str) {
        let from = format!("{}, {place}", self.name);
        let line = self.line(range.start);
        self.facts.push(Fact { key: key.iter().map(ToString::to_string).collect(), value, from, line });
    }

    /// What the file's lengths count in; twice with another unit is a contradiction.
    pub(super) fn put_units(&mut self, units: Units, range: &Range<usize>) {
        match (self.units, &self.units_at) {
            (Some(other), Some(first)) if other != units => {
                let message = format!(
                    "the lengths count in {} here, and in {} in line {}",
                    unit_name(units),
                    unit_name(other),
                    self.line(first.start)
                );
                self.refuse(range, message);
            }
            (_, Some(_)) => {}
            _ => {
                self.units = Some(units);
                self.units_at = Some(range.clone());
            }
        }
    }

    /// Lists something as not used.
    pub(super) fn leave(&mut self, range: &Range<usize>, what: impl Into<String>, why: impl Into<String>) {
        if self.unused.len() >= MOST_UNUSED {
            self.more_unused += 1;
            return;
        }
        let line = self.line(range.start);
        self.unused.push(Unused { line, what: what.into(), why: why.into() });
    }

    /// Refuses the file.
    pub(super) fn refuse(&mut self, range: &Range<usize>, message: impl Into<String>) {
        if self.problems.len() < MOST_PROBLEMS {
            self.problems.push(Problem::at(&self.shown, self.text, range, message));
        }
    }

    /// A number as a file has it; finite. The error is told.
    pub(super) fn number(&mut self, text: &str, range: &Range<usize>, what: &str) -> Option<f64> {
        let number = text.trim().parse::<f64>().ok().filter(|number| number.is_finite());
        if number.is_none() {
            self.refuse(range, format!("{what} is `{}`, which is not a number", text.trim()));
        }
        number
    }

    /// The same, and greater than zero.
    pub(super) fn positive(&mut self, text: &str, range: &Range<usize>, what: &str) -> Option<f64> {
        let number = self.number(text, range, what)?;
        if number > MOST_FIGURE {
            self.refuse(range, format!("{what} is {}, which no machine has", text.trim()));
            return None;
        }
        if number > 0.0 {
            return Some(number);
        }
        self.refuse(range, format!("{what} is {number}: it must be greater than zero"));
        None
    }
}

/// As messages and configurations write a unit.
pub(super) fn unit_name(units: Units) -> &'static str {
    match units {
        Units::Mm => "mm",
        Units::Inch => "inch",
    }
}

/// Why most of what is not used is not used.
pub(super) const NO_KEY: &str = "`gcheck.toml` has no key for it";

/// Lines of a text with the bytes they begin at.
pub(super) fn lines(text: &str) -> impl Iterator<Item = (usize, &str)> {
    let mut start = 0;
    text.split_inclusive('\n').map(move |line| {
        let at = start;
        start += line.len();
        (at, line.trim_end_matches(['\n', '\r']))
    })
}

/// A computed figure without the dust of the computation.
pub(super) fn rounded(figure: f64) -> f64 {
    (figure * 1e6).round() / 1e6
}
