//! Sequence numbers in even steps, and with them every word that names one.
//!
//! Knows: where numbers are and what names them (see [`crate::labels`]), which numbers a control takes. Must not know: who
//! asked. It is done as a whole or refused: a jump to the wrong block is worse than a crooked number.

use std::collections::{HashMap, HashSet};
use std::fmt;
use std::ops::Range;

use gcheck_controls::{Control, Letter};
use gcheck_diagnostics::Edit;
use gcheck_program::Dialect;

use crate::labels::{Labels, Number, Reference, Target};

/// The largest number where nobody says which a control takes: five digits are customary.
const CUSTOMARY_MOST: u32 = 99_999;

/// Which numbers are written.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Numbering {
    /// The first number of each program.
    pub start: u32,
    /// From one number to the next.
    pub step: u32,
}

/// Why a program is not renumbered; [`fmt::Display`] says it in words.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct RenumberRefused {
    /// Bytes of the text: what is in the way.
    pub range: Range<u32>,
    /// What it is.
    pub reason: Refusal,
}

/// What is in the way of renumbering.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Refusal {
    /// The step is zero, or the start is not a number that the control takes.
    NoNumbering {
        /// The least number that the control takes.
        least: u32,
        /// The largest.
        most: u32,
    },
    /// A target is computed: `GOTO #1`.
    Computed,
    /// A target of this number does not exist in its program.
    NoSuchBlock(u32),
    /// A target of this number exists more than once in its program.
    SeveralBlocks(u32),
    /// The target may be in another program, of this file or another one.
    OtherProgram,
    /// This number names a program, and a block of its own program would get it.
    TakenByProgram(u32),
    /// A variable is read that holds the number of a block.
    ReadsNumber,
    /// A number is not in front of its block, or is its second one.
    StrayNumber,
    /// A block with a mistake in form has a jump.
    Unclear,
    /// The number would be this, and the control takes no more than that.
    TooLarge {
        /// The first number that is too large.
        number: u64,
        /// The largest number of the control.
        most: u32,
    },
}

impl fmt::Display for RenumberRefused {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Display::fmt(&self.reason, f)
    }
}

impl std::error::Error for RenumberRefused {}

impl fmt::Display for Refusal {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NoNumbering { least, most } => {
                write!(f, "block numbers of the control go from {least} to {most}, in steps of 1 or more")
            }
            Self::Computed => {
                f.write_str("the block that this names is computed, so its number cannot be followed")
            }
            Self::NoSuchBlock(number) => write!(f, "block N{number}, which this names, does not exist"),
            Self::SeveralBlocks(number) => {
                write!(f, "block N{number}, which this names, exists more than once in its program")
            }
            Self::OtherProgram => {
                f.write_str("this may name a block of another program, which would not be renumbered with it")
            }
            Self::TakenByProgram(number) => {
                write!(f, "this names program O{number}, and a block would get that number")
            }
            Self::ReadsNumber => f.write_str("this reads the number of a block, which would be another one"),
            Self::StrayNumber => f.write_str(
                "this number is not in front of its block, so it is not certain that a jump leads to it",
            ),
            Self::Unclear => {
                f.write_str("this block has a mistake in form, so which block it names is not certain")
            }
            Self::TooLarge { number, most } => {
                write!(f, "this block would be N{number}; the control takes numbers up to {most}")
            }
        }
    }
}

/// The edits that renumber the blocks that have an `N` number, in text order, and all words that name them. Each
/// program of the file begins at the start again.
///
/// # Errors
/// [`RenumberRefused`], and nothing is to be changed, when a word's block is not certain or a number would be too large.
pub fn renumber(
    text: &str,
    dialect: &Dialect<'_>,
    numbering: &Numbering,
) -> Result<Vec<Edit>, RenumberRefused> {
    let Numbering { start, step } = *numbering;
    let limits = limits(dialect.control());
    if step == 0 || !limits.contains(&start) {
        let reason = Refusal::NoNumbering { least: *limits.start(), most: *limits.end() };
        return Err(RenumberRefused { range: 0..0, reason });
    }
    let labels = Labels::of(text, dialect);
    // A number that the program has, the control evidently takes.
    let largest = labels.list.iter().filter_map(|label| label.number).max().unwrap_or(0);
    let most = largest.max(*limits.end());

    let mut edits = Vec::new();
    // By program and old number.
    let mut numbers = Numbers::default();
    let (mut program, mut next) = (None, u64::from(start));
    for label in &labels.list {
        if program != Some(label.program) {
            (program, next) = (Some(label.program), u64::from(start));
        }
        let Some(old) = label.number else { continue };
        let Ok(new) = u32::try_from(next) else { return Err(too_large(&label.range, next, most)) };
        if new > most {
            return Err(too_large(&label.range, next, most));
        }
        next += u64::from(step);
        numbers.put(label.program, old, new);
        write(text, &label.digits, new, &mut edits);
    }
    for reference in &labels.references {
        let (number, new) = follow(reference, &labels, &numbers)
            .map_err(|reason| RenumberRefused { range: reference.range.clone(), reason })?;
        write(text, &number.digits, new, &mut edits);
    }
    // `G71 P10 Q20 G70 P10`: a word belongs to one reference only, but codes may come in any order.
    edits.sort_by_key(|edit| edit.range.start);
    edits.dedup();
    Ok(edits)
}

/// The numbers of a file, old and new.
#[derive(Default)]
struct Numbers {
    /// By program and old number.
    new: HashMap<(u32, u32), New>,
    /// Programs with the new numbers of their blocks.
    taken: HashSet<(u32, u32)>,
}

impl Numbers {
    fn put(&mut self, program: u32, old: u32, new: u32) {
        let several = |new: &mut New| *new = New::Several;
        self.new.entry((program, old)).and_modify(several).or_insert(New::One(new));
        self.taken.insert((program, new));
    }
}

/// What an old number becomes.
#[derive(Debug, Clone, Copy)]
enum New {
    One(u32),
    /// Several blocks have it.
    Several,
}

/// The new number of what a word names.
fn follow<'l>(
    reference: &'l Reference,
    labels: &Labels,
    numbers: &Numbers,
) -> Result<(&'l Number, u32), Refusal> {
    let number = match &reference.target {
        Target::Own(number) | Target::Caller(number) | Target::OwnOrProgram(number) => number,
        Target::Other => return Err(Refusal::OtherProgram),
        Target::Computed => return Err(Refusal::Computed),
        Target::Reads => return Err(Refusal::ReadsNumber),
        Target::Stray => return Err(Refusal::StrayNumber),
        Target::Unclear => return Err(Refusal::Unclear),
    };
    let mut new = None;
    for program in labels.programs_named_by(reference) {
        match numbers.new.get(&(program, number.value)) {
            // It stays the number of a program as long as no block gets that number.
            None if matches!(reference.target, Target::OwnOrProgram(_)) => {
                let is_taken = numbers.taken.contains(&(program, number.value));
                return if is_taken {
                    Err(Refusal::TakenByProgram(number.value))
                } else {
                    Ok((number, number.value))
                };
            }
            None => return Err(Refusal::NoSuchBlock(number.value)),
            Some(New::Several) => return Err(Refusal::SeveralBlocks(number.value)),
            Some(New::One(one)) if new.is_none_or(|new| new == *one) => new = Some(*one),
            Some(New::One(_)) => return Err(Refusal::OtherProgram),
        }
    }
    new.map(|new| (number, new)).ok_or(Refusal::OtherProgram)
}

fn too_large(range: &Range<u32>, number: u64, most: u32) -> RenumberRefused {
    RenumberRefused { range: range.clone(), reason: Refusal::TooLarge { number, most } }
}

/// The numbers that a control takes. Zero is none: some controls refuse it.
fn limits(control: &Control) -> std::ops::RangeInclusive<u32> {
    let entry = control.letter(Letter::of('N'));
    #[expect(clippy::cast_sign_loss, reason = "a float is cut to the range of the integer")]
    let whole = |bound: f64| bound.max(0.0) as u32;
    let least = entry.and_then(|entry| entry.min).map_or(1, whole).max(1);
    let most = entry.and_then(|entry| entry.max).map(whole);
    let most = most.into_iter().chain(control.limits().max_sequence_number).min();
    least..=most.unwrap_or(CUSTOMARY_MOST)
}

/// A number in the place of another, with as many digits where that began with zeros.
fn write(text: &str, digits: &Range<u32>, number: u32, edits: &mut Vec<Edit>) {
    let old = text.get(digits.start as usize..digits.end as usize).unwrap_or_default();
    let width = if old.len() > 1 && old.starts_with('0') { old.len() } else { 1 };
    let new = format!("{number:0width$}");
    if old != new {
        edits.push(Edit { range: digits.clone(), text: new });
    }
}
