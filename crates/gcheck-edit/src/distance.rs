//! Absolute coordinates as increments, and increments as absolute coordinates.
//!
//! Knows: from where each word counts. Must not know: how a path is compared.

use std::collections::BTreeMap;

use gcheck_controls::{Effect, Letter};
use gcheck_engine::{Axis, Model, Position, Role, Units};
use gcheck_program::{Place, Word};

use crate::facts::Facts;
use crate::meaning::{Class, Meaning, Read, read, rotary_axis};
use crate::modal::Modal;
use crate::refusal::Refusal;
use crate::rigid::LINEAR;
use crate::run::Executed;
use crate::sheet::Sheet;

/// From where the words of a block count when they are increments, millimetres and degrees.
#[derive(Debug, Clone, Copy)]
struct Bases {
    facts: Facts,
    point: Position,
    /// The level that the depth of a cycle counts from, and the one that its `R` counts from.
    cycle: [f64; 2],
}

/// The ways of a run. Has to see every block.
pub(crate) struct Distance<'c> {
    /// Words become increments.
    to_increments: bool,
    model: &'c Model<'c>,
    modal: Modal<'c>,
    blocks: BTreeMap<u32, Bases>,
}

impl<'c> Distance<'c> {
    pub(crate) fn new(to_increments: bool, model: &'c Model<'c>) -> Self {
        Self { to_increments, model, modal: Modal::new(Role::Distance, model), blocks: BTreeMap::new() }
    }

    pub(crate) fn begin(&mut self) {
        self.modal.begin();
    }

    pub(crate) fn executed(&mut self, block: &Executed<'_>) -> Result<(), Refusal> {
        let read = read(block.place, &block.facts, self.model);
        let refuse = |reason: &str| Err(block.refusal(reason));
        let Some(was) = block.facts.incremental else {
            return refuse("whether words are increments here is not known");
        };
        let counts = !self.to_increments || was || self.is_from_known(block, &read);
        let changes = block.is_selected && counts && matches!(read.class, Class::Moves | Class::Operation);
        if block.is_selected && read.class == Class::Computed {
            return refuse("a code of this block is computed, so what its words mean is not certain");
        }
        let has_ways = read.has_ways(self.model);
        let needs = has_ways.then_some(if changes { self.to_increments } else { was });
        let otherwise = if block.is_selected && counts { self.to_increments } else { was };
        self.modal.executed(block, was, needs, otherwise)?;
        if !changes || was == self.to_increments || !has_ways {
            return Ok(());
        }
        if block.facts.mapped.is_some() {
            return refuse("a mode in effect here puts the axes elsewhere than the words say");
        }
        if read.words.iter().any(|(_, meaning)| *meaning == Meaning::Polar) {
            return refuse("this block gives a distance and an angle as seen from the zero of the program");
        }
        if read.class == Class::Operation {
            return refuse(
                "the code of this block makes moves of its own, and which of its words are places is not certain",
            );
        }
        let rules = &self.model.semantics().cycles;
        if block.facts.cycle.is_some() {
            let repeats = block.place.block().letters.contains(Letter::of(rules.repeat));
            if repeats {
                return refuse(
                    "this block repeats its cycle, which goes on by increments and stays at an absolute place",
                );
            }
            if !rules.incremental_r {
                return refuse("the levels of a cycle do not count as increments on this control");
            }
        }
        let cycle = block.state.cycle();
        let new = Bases { facts: block.facts, point: block.before, cycle: [cycle.r, cycle.initial] };
        if self.blocks.get(&block.at.block).is_some_and(|old| !is_same(old, &new, &read)) {
            return refuse("this block runs more than once, from another point each time");
        }
        self.blocks.insert(block.at.block, new);
        Ok(())
    }

    /// Is every axis of the block somewhere that is known before it? A block that goes on from an unknown place stays absolute: so
    /// the first one of a program, and one that switches the length of a tool.
    fn is_from_known(&self, block: &Executed<'_>, read: &Read) -> bool {
        let place = |(word, meaning): &(Word, Meaning)| match meaning {
            Meaning::Place { axis, incremental: false } => LINEAR.get(*axis).copied(),
            _ => rotary_axis(word, self.model),
        };
        let words = block.place.table.words(block.place.block()).iter();
        let moves_zero = |word: &Word| {
            matches!(self.model.role(word.code), Some(Role::Length | Role::WorkOffset | Role::DynamicOffset))
        };
        let is_known = |axis: Axis| !block.before.raw(axis).is_nan();
        let mut named = read.words.iter().filter_map(place).peekable();
        if named.peek().is_none() {
            return LINEAR.into_iter().any(is_known);
        }
        // A code of the block may put the same point elsewhere before it moves.
        !{ words }.any(moves_zero) && named.all(is_known)
    }

    /// Rewrites a block.
    pub(crate) fn write(&self, sheet: &mut Sheet<'_, '_>, number: u32, place: &Place) -> Result<(), Refusal> {
        let effect = |incremental: bool| if incremental { Effect::Incremental } else { Effect::Absolute };
        codes(sheet, &self.modal, number, place, effect)?;
        let Some(bases) = self.blocks.get(&number) else { return Ok(()) };
        let facts = &bases.facts;
        let read = read(place, facts, self.model);
        let unit = facts.units.map_or(1.0, Units::in_mm);
        for (word, meaning) in &read.words {
            let is_depth = |axis: usize| facts.cycle.is_some() && axis == read.depth;
            let (axis, base) = match meaning {
                Meaning::Place { axis, incremental } if *incremental != self.to_increments => {
                    let [r, _] = bases.cycle;
                    let point = LINEAR.get(*axis).map_or(f64::NAN, |axis| bases.point.raw(*axis));
                    (*axis, if is_depth(*axis) { r } else { point })
                }
                Meaning::Height { axis, incremental } if *incremental != self.to_increments => {
                    let [_, initial] = bases.cycle;
                    (*axis, initial)
                }
                _ => continue,
            };
            if base.is_nan() {
                let name = LINEAR.get(axis).map_or('X', |axis| axis.name());
                let reason = format!("where {name} is before this block is not known");
                return Err(Refusal::at(Sheet::range(place, word), reason)
                    .help("begin the selection at a later block"));
            }
            let is_diameter = axis == 0 && facts.diameter == Some(true);
            let base = base / unit * if is_diameter { 2.0 } else { 1.0 };
            let offset = if self.to_increments { -base } else { base };
            let decimals = sheet.decimals(facts.units);
            let text = sheet.rewritten(place, word, facts.units, 1.0, offset, decimals)?;
            let (range, _) = sheet.value(place, word);
            sheet.replace(range, text);
        }
        self.rotary(sheet, place, bases)
    }

    /// Words of rotary axes, which count degrees.
    fn rotary(&self, sheet: &mut Sheet<'_, '_>, place: &Place, bases: &Bases) -> Result<(), Refusal> {
        let words: Vec<_> = place.table.words(place.block()).to_vec();
        for word in &words {
            let Some(axis) = rotary_axis(word, self.model) else { continue };
            let base = bases.point.raw(axis);
            if base.is_nan() {
                let reason = format!("where {} is before this block is not known", axis.name());
                return Err(Refusal::at(Sheet::range(place, word), reason));
            }
            let offset = if self.to_increments { -base } else { base };
            let text = sheet.rewritten(place, word, bases.facts.units, 1.0, offset, 3)?;
            let (range, _) = sheet.value(place, word);
            sheet.replace(range, text);
        }
        Ok(())
    }
}

/// Do the words of a block count from the same places in both turns?
fn is_same(old: &Bases, new: &Bases, read: &Read) -> bool {
    let near = |a: f64, b: f64| a.is_nan() && b.is_nan() || (a - b).abs() < 1e-9;
    let names = |axis: usize| {
        read.words
            .iter()
            .any(|(_, meaning)| matches!(meaning, Meaning::Place { axis: named, .. } if *named == axis))
    };
    let linear = LINEAR.iter().enumerate();
    old.facts == new.facts
        && { linear }.all(|(index, axis)| !names(index) || near(old.point.raw(*axis), new.point.raw(*axis)))
        && old.cycle.iter().zip(new.cycle).all(|(old, new)| near(*old, new))
}

/// Rewrites the code of a mode in a block, or gives the block one.
pub(crate) fn codes(
    sheet: &mut Sheet<'_, '_>,
    modal: &Modal<'_>,
    number: u32,
    place: &Place,
    effect: impl Fn(bool) -> Effect,
) -> Result<(), Refusal> {
    let missing = || Refusal::at(place.range(), "the control has no code for the other mode");
    if let (Some(word), Some(new)) = (modal.code(place), modal.own.get(&number)) {
        let new = effect(*new);
        if sheet.model.effect(word.code) != new {
            let text = sheet.code(place, &word, new).ok_or_else(missing)?;
            sheet.replace(Sheet::range(place, &word), text);
        }
    }
    if let Some(new) = modal.inserted.get(&number) {
        let effect = effect(*new);
        let name = sheet.name_of(effect).ok_or_else(missing)?;
        // A control may read the feed of a block before its units.
        let comes_late = matches!(effect, Effect::Inch | Effect::Millimetre)
            && place.block().letters.contains(Letter::of('F'));
        if comes_late {
            sheet.insert(place.range().start, format!("{name}{}", sheet.line_end()));
        } else {
            sheet.prepend(place, &name);
        }
    }
    Ok(())
}
