//! From what a run has shown to the edits of a change.
//!
//! Knows: which blocks are rewritten, and when that is not certain. Must not know: whether the proof holds.

use std::collections::BTreeSet;
use std::ops::Range;

use gcheck_diagnostics::Edit;
use gcheck_engine::{Assumption, FeedMode, Machine, Model, Program, Units};
use gcheck_program::{Block, BlockFlags, Loaded, Place, Word};

use crate::change::Change;
use crate::meaning::{Meaning, read};
use crate::places;
use crate::rates::{Pair, Rates};
use crate::refusal::Refusal;
use crate::scope::Scope;
use crate::sheet::Sheet;
use crate::witness::{Seen, Tracker, Witness};

/// A change of a program that is to be proved.
#[derive(Debug, Clone, PartialEq)]
pub struct Plan {
    /// Edits of the program in the order of the text, which do not overlap; empty where nothing changes.
    pub edits: Vec<Edit>,
    /// What the person has to know, a sentence each.
    pub notes: Vec<String>,
}

/// Makes the edits of a change of a program that a witness has seen run to its end.
///
/// # Errors
/// [`Refusal`], and nothing is to be changed, when the change is not certain.
pub fn plan(
    change: &Change,
    scope: &Scope,
    witness: &Witness<'_>,
    program: &Program<'_>,
    model: &Model<'_>,
    machine: &Machine,
) -> Result<Plan, Refusal> {
    if let Some(refusal) = witness.refusal() {
        return Err(refusal);
    }
    if let Scope::Tool(tool) = scope
        && !witness.selects_any()
    {
        return Err(Refusal::whole(format!("no block is known to run with T{tool}")));
    }
    let Some(file) = program.file(0) else { return Err(Refusal::whole("the text has no program")) };
    let mut sheet = Sheet::new(program, &file.loaded, model, machine);
    let rows = Rows::of(witness, &file.loaded, program, model);
    if let Tracker::Folds(folds) = &witness.following.tracker {
        let notes = folds.write(&mut sheet, program, machine)?;
        let edits = sheet.into_edits();
        rows.check(&edits)?;
        return Ok(Plan { edits, notes });
    }
    if let Tracker::Sections(sections) = &witness.following.tracker {
        let notes = sections.write(&mut sheet, program, &file.loaded)?;
        let edits = sheet.into_edits();
        rows.check(&edits)?;
        return Ok(Plan { edits, notes });
    }
    let mut planner = Planner { change, scope, witness, model, cuts: false };
    for number in 0..file.loaded.flow_graph().blocks() {
        let Some(place) = file.loaded.place(number, program.dialect()) else { continue };
        if rows.unreached.binary_search(&number).is_ok() {
            continue;
        }
        match &witness.following.tracker {
            Tracker::Cycles(cycles) => cycles.write(&mut sheet, number, &place)?,
            Tracker::Loops(loops) => loops.write(&mut sheet, number, &place, program),
            Tracker::Starts(starts) => {
                let before =
                    number.checked_sub(1).and_then(|number| file.loaded.place(number, program.dialect()));
                starts.write(&mut sheet, number, &place, before.as_ref());
            }
            Tracker::Distance(distance) if planner.is_reached(number, &place)? => {
                distance.write(&mut sheet, number, &place)?;
            }
            Tracker::Units(units) if planner.is_reached(number, &place)? => {
                units.write(&mut sheet, number, &place)?;
            }
            _ => planner.block(&mut sheet, number, &place)?,
        }
    }
    if let Tracker::Rates(rates) = &witness.following.tracker {
        inserted(&mut sheet, rates, program, &file.loaded)?;
    }
    let edits = sheet.into_edits();
    rows.check(&edits)?;
    let mut notes = Vec::new();
    if let Tracker::Cycles(cycles) = &witness.following.tracker {
        notes.extend(cycles.note()?);
    }
    if matches!(change, Change::Mirror(..)) && planner.cuts && !edits.is_empty() {
        notes.push(
            "climb milling becomes conventional milling, and the other way round: the spindle still turns as before"
                .to_owned(),
        );
    }
    if let Tracker::Rates(rates) = &witness.following.tracker {
        if rates.keeps_threads {
            notes.push("the feed of a tap and the lead of a thread stay as they are".to_owned());
        }
        if let Some(name) = &rates.leaves {
            notes.push(format!("feeds and speeds that {name} gives stay as they are"));
        }
    }
    Ok(Plan { edits, notes })
}

/// What a run rests on that leaves moves out: passes of a cycle, programs that are not there. A proof would have a gap.
pub fn gaps(assumptions: &BTreeSet<Assumption>) -> BTreeSet<Assumption> {
    assumptions.iter().filter(|assumption| assumption.leaves_moves_out()).cloned().collect()
}

/// Blocks that are rows of data as the text has them, and that no run has read as such.
#[derive(Default)]
struct Rows {
    /// Numbers of those that no run came to, ascending.
    unreached: Vec<u32>,
    /// Bytes of those that a run has executed as commands, as where a jump leads into a table.
    doubtful: Vec<Range<u32>>,
}

impl Rows {
    fn of(witness: &Witness<'_>, loaded: &Loaded<'_>, program: &Program<'_>, model: &Model<'_>) -> Self {
        let mut rows = Self::default();
        if !model.control().codes().any(|code| code.entry().opens_data.is_some()) {
            return rows;
        }
        let file_index = loaded.file_index(program.dialect());
        if !file_index.has_data() {
            return rows;
        }
        for number in 0..loaded.flow_graph().blocks() {
            let Some(place) = loaded.place(number, program.dialect()) else { continue };
            if !file_index.is_data(place.range().start) {
                continue;
            }
            match witness.blocks.get(number as usize).copied().flatten() {
                None => rows.unreached.push(number),
                Some(seen) if !seen.facts.is_row => rows.doubtful.push(place.range()),
                Some(_) => {}
            }
        }
        rows
    }

    /// Does no edit touch a block that may be a row of data?
    fn check(&self, edits: &[Edit]) -> Result<(), Refusal> {
        for edit in edits {
            let next = self.doubtful.partition_point(|row| row.end < edit.range.start);
            if let Some(row) = self.doubtful.get(next).filter(|row| row.start <= edit.range.end) {
                let reason = "this block may be a row of data, which has to stay as it is";
                return Err(Refusal::at(row.clone(), reason).help("select lines without it"));
            }
        }
        Ok(())
    }
}

struct Planner<'p> {
    change: &'p Change,
    scope: &'p Scope,
    witness: &'p Witness<'p>,
    model: &'p Model<'p>,
    /// Something is cut in the blocks that change.
    cuts: bool,
}

impl Planner<'_> {
    fn block(&mut self, sheet: &mut Sheet<'_, '_>, number: u32, place: &Place) -> Result<(), Refusal> {
        let Some(seen) = self.witness.blocks.get(number as usize).copied().flatten() else {
            return self.unreached(place);
        };
        if !seen.is_selected {
            return Ok(());
        }
        let read = read(place, &seen.facts, self.model);
        match &self.witness.following.tracker {
            Tracker::Course(course) => {
                let certain = if read.has_places() {
                    seen.is_certain
                } else if course.rigid().is_some_and(|rigid| !rigid.is_shift())
                    && places::switches_side(place, self.model)
                {
                    // A side or a way round that is switched in a block of its own.
                    seen.keeps_plane
                } else {
                    return Ok(());
                };
                if !certain {
                    let reason = "this block runs more than once, under different modes, so its words mean different places";
                    return Err(Refusal::at(place.range(), reason));
                }
                self.cuts |= read.cuts;
                let Some(rigid) = course.rigid() else { return Ok(()) };
                places::rewrite(sheet, place, &seen, &read, rigid)
            }
            Tracker::Rates(rates) => {
                let factors = rates.own(number);
                let words: Vec<(Word, Meaning)> = read.words.clone();
                for (word, meaning) in words {
                    let factor = match meaning {
                        Meaning::Feed => factors.feed,
                        Meaning::Speed => factors.speed,
                        _ => continue,
                    };
                    if (factor - 1.0).abs() > 1e-12 {
                        scaled(sheet, place, &word, &seen, factor)?;
                    }
                }
                Ok(())
            }
            _ => Ok(()),
        }
    }

    /// Did a run come to a block? The error is that it did not, and has words that the change is about.
    fn is_reached(&self, number: u32, place: &Place) -> Result<bool, Refusal> {
        if self.witness.blocks.get(number as usize).copied().flatten().is_some() {
            return Ok(true);
        }
        self.unreached(place).map(|()| false)
    }

    /// A block that no run came to.
    fn unreached(&self, place: &Place) -> Result<(), Refusal> {
        let is_selected = match self.scope {
            Scope::Tool(_) => false,
            scope => scope.selects(place.range().start, None),
        };
        if !is_selected || !self.concerns(place.block(), place) {
            return Ok(());
        }
        let reason = "the run does not come to this block, so what its words do is not proved";
        let help = if place.block().flags.contains(BlockFlags::BLOCK_DELETE) {
            "set block delete with --block-skip, or select other lines"
        } else {
            "select lines that run, or set the variables that lead here with --set"
        };
        Err(Refusal::at(place.range(), reason).help(help))
    }

    /// Has a block words that the change is about, whatever they mean?
    fn concerns(&self, block: &Block, place: &Place) -> bool {
        let words = place.table.words(place.block());
        let is_about = |word: &Word| match self.change {
            Change::Renumber
            | Change::ExpandCycle
            | Change::FoldCycle
            | Change::UnrollLoop
            | Change::SafeStart
            | Change::MoveSection(_) => false,
            Change::Convert(_) => !matches!(word.letter.ascii(), b'G' | b'M' | b'N' | b'O' | b'T'),
            Change::ScaleFeeds(_) => word.letter.ascii() == b'F',
            Change::ScaleSpeeds(_) => word.letter.ascii() == b'S',
            Change::Translate(_)
            | Change::Mirror(..)
            | Change::Rotate(..)
            | Change::Absolute
            | Change::Incremental => {
                matches!(word.letter.ascii(), b'X' | b'Y' | b'Z' | b'I' | b'J' | b'K')
            }
        };
        !block.letters.is_empty() && words.iter().any(is_about)
    }
}

/// Writes a rate scaled.
fn scaled(
    sheet: &mut Sheet<'_, '_>,
    place: &Place,
    word: &Word,
    seen: &Seen,
    factor: f64,
) -> Result<(), Refusal> {
    let decimals = rate_decimals(sheet, word.letter.ascii() == b'S', seen);
    let text = sheet.rate(place, word, seen.facts.units, factor, decimals)?;
    let (range, _) = sheet.value(place, word);
    sheet.replace(range, text);
    Ok(())
}

/// Decimals of a rate.
fn rate_decimals(sheet: &Sheet<'_, '_>, is_speed: bool, seen: &Seen) -> usize {
    if is_speed {
        return 0;
    }
    let per_turn = seen.facts.feed_mode == Some(FeedMode::PerRevolution);
    sheet.decimals(seen.facts.units.or(Some(Units::Mm))) + usize::from(per_turn)
}

/// Writes the rates that blocks need of their own.
fn inserted(
    sheet: &mut Sheet<'_, '_>,
    rates: &Rates<'_>,
    program: &Program<'_>,
    loaded: &Loaded<'_>,
) -> Result<(), Refusal> {
    for (number, given, factors) in rates.inserted() {
        let Some(place) = loaded.place(number, program.dialect()) else { continue };
        let Pair { feed, speed } = given;
        let mut words = Vec::new();
        for (letter, number, factor) in [('F', feed, factors.feed), ('S', speed, factors.speed)] {
            let Some(number) = number else { continue };
            let value = number * factor;
            let text = sheet.hand.rate(letter, value, if letter == 'S' { 0 } else { 4 });
            let written: f64 = text.get(1..).and_then(|digits| digits.parse().ok()).unwrap_or(f64::NAN);
            if ((written - value) / value).abs() > 5e-4 {
                let reason =
                    format!("this block needs {letter}{value:.4}, which cannot be written as exactly");
                return Err(Refusal::at(place.range(), reason).help("choose another factor"));
            }
            words.push(text);
        }
        sheet.append(&place, &words.join(sheet.hand.gap()));
    }
    Ok(())
}
