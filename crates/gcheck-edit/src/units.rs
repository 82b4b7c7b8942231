//! A program in inches as one in millimetres, and the other way round.
//!
//! Knows: which words are lengths, feeds and surface speeds. Must not know: how a path is compared.

use std::collections::BTreeMap;

use gcheck_controls::{Effect, Letter, WordKind};
use gcheck_engine::{FeedMode, Model, Role, Units};
use gcheck_program::{Place, Value, Word};

use crate::distance::codes;
use crate::facts::Facts;
use crate::meaning::{Class, Meaning, read};
use crate::modal::Modal;
use crate::refusal::Refusal;
use crate::run::Executed;
use crate::sheet::Sheet;

/// Metres in a foot: surface speeds count feet in an inch program.
const FOOT: f64 = 0.3048;

/// The units of a run. Has to see every block.
pub(crate) struct Conversion<'c> {
    to: Units,
    model: &'c Model<'c>,
    modal: Modal<'c>,
    blocks: BTreeMap<u32, Facts>,
}

impl<'c> Conversion<'c> {
    pub(crate) fn new(to: Units, model: &'c Model<'c>) -> Self {
        Self { to, model, modal: Modal::new(Role::Units, model), blocks: BTreeMap::new() }
    }

    pub(crate) fn begin(&mut self) {
        self.modal.begin();
    }

    pub(crate) fn executed(&mut self, block: &Executed<'_>) -> Result<(), Refusal> {
        let refuse = |reason: &str| Err(block.refusal(reason));
        let Some(was) = block.facts.units else { return refuse("the unit of this block is not known") };
        let read = read(block.place, &block.facts, self.model);
        let words = block.place.table.words(block.place.block());
        if read.class == Class::Call && words.iter().any(is_argument) {
            return refuse("the arguments of a macro may be lengths or not, so they are not converted");
        }
        if read.class == Class::Computed {
            return refuse("a code of this block is computed, so what its words mean is not certain");
        }
        let measures = words.iter().any(|word| {
            let factor = factor(block.place, word, &block.facts, self.model, self.to);
            factor.is_some_and(|factor| (factor - 1.0).abs() > 1e-12)
        });
        let needs = measures.then_some(if block.file.is_some() { was } else { self.to });
        self.modal.executed(
            block,
            was == Units::Inch,
            needs.map(|units| units == Units::Inch),
            self.to == Units::Inch,
        )?;
        if block.file.is_some() || was == self.to {
            return Ok(());
        }
        let old = self.blocks.insert(block.at.block, block.facts);
        let is_same = |old: Facts| {
            let new = &block.facts;
            old.places_alike(new) && (old.feed_mode, old.surface) == (new.feed_mode, new.surface)
        };
        if measures && old.is_some_and(|old| !is_same(old)) {
            return refuse("this block runs more than once, under different modes");
        }
        Ok(())
    }

    /// Rewrites a block.
    pub(crate) fn write(&self, sheet: &mut Sheet<'_, '_>, number: u32, place: &Place) -> Result<(), Refusal> {
        let effect = |is_inch: bool| if is_inch { Effect::Inch } else { Effect::Millimetre };
        codes(sheet, &self.modal, number, place, effect)?;
        let Some(facts) = self.blocks.get(&number) else { return Ok(()) };
        let words: Vec<Word> = place.table.words(place.block()).to_vec();
        for word in &words {
            let Some(factor) = factor(place, word, facts, self.model, self.to) else { continue };
            if (factor - 1.0).abs() < 1e-12 || word.value == Value::Number(0.0) && !word.shape.point {
                continue;
            }
            let (range, _) = sheet.value(place, word);
            let counts = kind(place, word, facts, self.model) == Some(WordKind::LeastIncrements);
            let text = match word.value {
                Value::Number(number) if counts && !word.shape.point => {
                    sheet.increments(number, facts.units, self.to, factor).ok_or_else(|| {
                        Refusal::at(range.clone(), "this length would be less than one least increment")
                    })?
                }
                Value::Expr(_) if counts => {
                    let reason =
                        "this word counts least increments, and what a computed one counts is not certain";
                    return Err(Refusal::at(range, reason));
                }
                _ => sheet.converted(place, word, facts.units, self.to, factor)?,
            };
            sheet.replace(range, text);
        }
        Ok(())
    }
}

/// Is a word an argument of a macro, and neither its number nor how often it is called?
fn is_argument(word: &Word) -> bool {
    !matches!(word.letter.ascii(), b'G' | b'M' | b'N' | b'O' | b'P' | b'L')
}

/// By what a word is multiplied; `None` for a word that measures nothing.
fn factor(place: &Place, word: &Word, facts: &Facts, model: &Model<'_>, to: Units) -> Option<f64> {
    let from = facts.units.filter(|_| !facts.is_row)?;
    let length = from.in_mm() / to.in_mm();
    let read = read(place, facts, model);
    let (_, meaning) = read.words.iter().find(|(other, _)| other == word)?;
    match meaning {
        Meaning::Feed if facts.feed_mode == Some(FeedMode::InverseTime) => return None,
        Meaning::Feed => return Some(length),
        Meaning::Speed if facts.surface => {
            let feet = |units: Units| if units == Units::Inch { FOOT } else { 1.0 };
            return Some(feet(from) / feet(to));
        }
        Meaning::Speed => return None,
        Meaning::Place { .. } | Meaning::Height { .. } | Meaning::Centre { .. } | Meaning::Vector { .. } => {
            return Some(length);
        }
        Meaning::Direction | Meaning::Polar | Meaning::Other => {}
    }
    let is_length =
        matches!(kind(place, word, facts, model), Some(WordKind::Length | WordKind::LeastIncrements));
    is_length.then_some(length)
}

/// What the value of a word is: as its code says, or the cycle that it stays from, or else its address. `None` also for digits
/// that are packed into a number.
fn kind(place: &Place, word: &Word, facts: &Facts, model: &Model<'_>) -> Option<WordKind> {
    let control = model.control();
    let words = place.table.words(place.block());
    let codes = words.iter().map(|word| word.code).chain([facts.cycle]);
    let mut entries = codes.filter_map(|code| control.code_at(code)).flat_map(|code| &code.entry().words);
    let Some(entry) = entries.find(|entry| Letter::parse(&entry.letter) == Some(word.letter)) else {
        return Some(control.letter(word.letter)?.kind);
    };
    (!entry.is_packed_beside(place.block().letters)).then_some(entry.kind)
}
