//! Canned cycles written out as the plain moves that they are made of.
//!
//! Knows: which moves each block of a cycle made in a run. Must not know: how cycles move (the engine does).

use std::collections::{BTreeMap, BTreeSet};

use gcheck_controls::{CodeIx, DwellWord, Effect, LetterSet};
use gcheck_engine::{Axis, Event, Model, PathMode, Position, Role, TravelKind, Units};
use gcheck_program::{BlockFlags, Place};

use crate::facts::Facts;
use crate::meaning::{Class, Meaning, read};
use crate::refusal::Refusal;
use crate::run::Executed;
use crate::sheet::Sheet;

/// Moves that one block may become.
const MOST_STROKES: usize = 2_000;
/// Words that belong to a cycle.
const OWN: LetterSet = LetterSet::of("XYZRQPFLKIJ");

/// Is a cycle made of moves and dwells alone, so that it can be written as such?
pub fn is_moves_and_dwells(cycle: Effect) -> bool {
    matches!(
        cycle,
        Effect::CycleDrill
            | Effect::CycleDrillDwell
            | Effect::CyclePeck
            | Effect::CycleChipBreak
            | Effect::CycleBoreFeedOut
            | Effect::CycleBoreDwell
    )
}

/// A move of a cycle.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Stroke {
    Rapid(Position, Position),
    Feed(Position, Position),
    Dwell(f64),
    /// The cycle takes corners otherwise than the program says, or does so no more.
    Corners(PathMode),
}

/// What a block of a cycle did.
#[derive(Debug, Clone)]
struct Expansion {
    facts: Facts,
    strokes: Vec<Stroke>,
}

impl Expansion {
    /// Without what a cycle says of corners at its end and the next one takes back at its begin.
    fn joined(&self, before: Option<&Self>, after: Option<&Self>) -> Self {
        let ends = |expansion: &Self| matches!(expansion.strokes.last(), Some(Stroke::Corners(_)));
        let begins = |expansion: &Self| matches!(expansion.strokes.first(), Some(Stroke::Corners(_)));
        let mut strokes = self.strokes.clone();
        if ends(self) && after.is_some_and(begins) {
            strokes.pop();
        }
        if begins(self) && before.is_some_and(ends) {
            strokes.remove(0);
        }
        Self { facts: self.facts, strokes }
    }
}

/// The cycles of a run. Has to see every block and event.
pub(crate) struct Cycles<'c> {
    model: &'c Model<'c>,
    events: Vec<Event>,
    found: BTreeMap<u32, Expansion>,
    /// The first block of a cycle that stays, as it is more than moves and dwells.
    stays: Option<Refusal>,
    /// Codes of cycles that stay, and their blocks by number.
    staying: BTreeSet<String>,
    staying_blocks: BTreeSet<u32>,
}

impl<'c> Cycles<'c> {
    pub(crate) fn new(model: &'c Model<'c>) -> Self {
        Self {
            model,
            events: Vec::new(),
            found: BTreeMap::new(),
            stays: None,
            staying: BTreeSet::new(),
            staying_blocks: BTreeSet::new(),
        }
    }

    pub(crate) fn before(&mut self) {
        self.events.clear();
    }

    pub(crate) fn event(&mut self, event: &Event) {
        if self.events.len() <= MOST_STROKES {
            self.events.push(event.clone());
        }
    }

    pub(crate) fn executed(&mut self, block: &Executed<'_>) -> Result<(), Refusal> {
        let expands = |event: &Event| match event {
            Event::Travel(travel) => travel.expanded,
            Event::RigidTap { .. } => true,
            _ => false,
        };
        if !block.is_selected || !block.facts.cycle.is_some() || !self.events.iter().any(expands) {
            return Ok(());
        }
        if !is_moves_and_dwells(self.model.effect(block.facts.cycle)) {
            let reason = "this cycle is more than moves and dwells: it taps, or stops and turns the spindle";
            self.stays.get_or_insert_with(|| block.refusal(reason));
            let code = self.model.control().code_at(block.facts.cycle);
            self.staying.extend(code.map(|code| code.number().to_string()));
            self.staying_blocks.insert(block.at.block);
        }
        if self.staying_blocks.contains(&block.at.block) {
            let also_drills = self.found.contains_key(&block.at.block)
                || is_moves_and_dwells(self.model.effect(block.facts.cycle));
            return match &self.stays {
                Some(stays) if also_drills => Err(stays.clone()),
                _ => Ok(()),
            };
        }
        if self.events.len() > MOST_STROKES {
            return Err(block.refusal(format!("this block would become more than {MOST_STROKES} moves")));
        }
        let strokes = self.strokes(block).map_err(|reason| block.refusal(reason))?;
        let new = Expansion { facts: block.facts, strokes };
        if self.found.get(&block.at.block).is_some_and(|old| !is_same(old, &new)) {
            return Err(block.refusal("this block runs more than once and makes other moves each time"));
        }
        self.found.insert(block.at.block, new);
        Ok(())
    }

    fn strokes(&self, block: &Executed<'_>) -> Result<Vec<Stroke>, String> {
        let facts = &block.facts;
        if facts.mapped.is_some() || facts.incremental.is_none() {
            return Err(
                "the modes in effect here put the moves elsewhere than their coordinates say".to_owned()
            );
        }
        let flags = block.place.block().flags;
        if flags.intersects(BlockFlags::STATEMENT | BlockFlags::BLOCK_DELETE | BlockFlags::ERROR) {
            return Err(
                "this block has a condition or a `/`, which its moves would need one by one".to_owned()
            );
        }
        let mut strokes = Vec::new();
        // What the block itself says of corners stays where it is.
        let words = block.place.table.words(block.place.block()).iter();
        let mut own = words.filter(|word| self.model.role(word.code) == Some(Role::PathControl)).count();
        for event in &self.events {
            match event {
                Event::PathMode(_) if own > 0 => own -= 1,
                Event::PathMode(mode) => strokes.push(Stroke::Corners(*mode)),
                Event::Travel(travel) => match travel.kind {
                    TravelKind::Rapid => strokes.push(Stroke::Rapid(travel.from, travel.to)),
                    TravelKind::Feed => strokes.push(Stroke::Feed(travel.from, travel.to)),
                    TravelKind::Probe { .. } | TravelKind::Thread => {
                        return Err("this cycle is more than moves and dwells".to_owned());
                    }
                },
                Event::Dwell(seconds) if seconds.0.is_finite() => strokes.push(Stroke::Dwell(seconds.0)),
                Event::Dwell(_) | Event::RigidTap { .. } | Event::Arc(_) | Event::Curve(_) => {
                    return Err("this cycle is more than moves and dwells".to_owned());
                }
                _ => {}
            }
        }
        Ok(strokes)
    }

    /// What a person has to know of cycles that stay.
    ///
    /// # Errors
    /// Every cycle would stay.
    pub(crate) fn note(&self) -> Result<Option<String>, Refusal> {
        let Some(stays) = &self.stays else { return Ok(None) };
        if self.found.is_empty() {
            return Err(stays.clone());
        }
        let codes: Vec<&str> = self.staying.iter().map(String::as_str).collect();
        Ok(Some(format!("cycles that tap, or stop and turn the spindle, stay: {}", codes.join(", "))))
    }

    /// Writes the moves in the place of the cycles.
    pub(crate) fn write(&self, sheet: &mut Sheet<'_, '_>, number: u32, place: &Place) -> Result<(), Refusal> {
        let Some(expansion) = self.found.get(&number) else { return Ok(()) };
        let before = number.checked_sub(1).and_then(|number| self.found.get(&number));
        let expansion = expansion.joined(before, self.found.get(&(number + 1)));
        let refusal = |reason: &str| Refusal::at(place.range(), reason);
        let lines = lines(sheet, place, &expansion).ok_or_else(|| {
            refusal("a coordinate of this cycle's moves is not known, or the control has no code for a move of it")
        })?;
        let text = lines.join(sheet.line_end());
        sheet.replace(place.range(), text);
        Ok(())
    }
}

/// Do both turns of a block make the same moves?
fn is_same(a: &Expansion, b: &Expansion) -> bool {
    let near = |a: f64, b: f64| a.is_nan() && b.is_nan() || (a - b).abs() < 1e-9;
    let is_way = a.facts.incremental == Some(true);
    let alike = |[from, to]: [&Position; 2], [other_from, other_to]: [&Position; 2]| {
        Axis::ALL.into_iter().all(|axis| {
            let (way, other) = (to.raw(axis) - from.raw(axis), other_to.raw(axis) - other_from.raw(axis));
            if is_way { near(way, other) } else { near(to.raw(axis), other_to.raw(axis)) }
        })
    };
    a.facts == b.facts
        && a.strokes.len() == b.strokes.len()
        && a.strokes.iter().zip(&b.strokes).all(|pair| match pair {
            (Stroke::Rapid(from, to), Stroke::Rapid(other, end))
            | (Stroke::Feed(from, to), Stroke::Feed(other, end)) => alike([from, to], [other, end]),
            (Stroke::Dwell(a), Stroke::Dwell(b)) => near(*a, *b),
            (Stroke::Corners(a), Stroke::Corners(b)) => a == b,
            _ => false,
        })
}

/// The lines that stand for a block; `None` when something of them cannot be written.
fn lines(sheet: &mut Sheet<'_, '_>, place: &Place, expansion: &Expansion) -> Option<Vec<String>> {
    let facts = &expansion.facts;
    let (rest, feed) = rest(sheet, place, facts);
    let is_number_alone = rest.starts_with(['N', 'n'])
        && rest
            .get(1..)
            .is_some_and(|digits| !digits.is_empty() && digits.bytes().all(|byte| byte.is_ascii_digit()));
    let mut lines = Vec::new();
    let mut head = String::new();
    match rest.is_empty() {
        true => {}
        false if is_number_alone => head = format!("{rest}{}", sheet.hand.gap()),
        false => lines.push(rest),
    }
    let (rapid, cut) = (sheet.spelled(Effect::Rapid)?, sheet.spelled(Effect::Linear)?);
    let mut feed = feed;
    for stroke in &expansion.strokes {
        let gap = sheet.hand.gap();
        let text = match stroke {
            Stroke::Rapid(from, to) => {
                let words = words(sheet, from, to, facts)?;
                (!words.is_empty()).then(|| format!("{rapid}{gap}{words}"))
            }
            Stroke::Feed(from, to) => {
                let words = words(sheet, from, to, facts)?;
                let feed = feed.take_if(|_| !words.is_empty());
                let feed = feed.map_or_else(String::new, |feed| format!("{gap}{feed}"));
                (!words.is_empty()).then(|| format!("{cut}{gap}{words}{feed}"))
            }
            Stroke::Dwell(seconds) => Some(dwell(sheet, *seconds)?),
            Stroke::Corners(mode) => Some(corners(sheet, *mode, facts)?),
        };
        if let Some(text) = text {
            lines.push(format!("{}{text}", std::mem::take(&mut head)));
        }
    }
    Some(lines)
}

/// What a block says beside its cycle, and its feed word.
fn rest(sheet: &Sheet<'_, '_>, place: &Place, facts: &Facts) -> (String, Option<String>) {
    let block = place.range();
    let words = place.table.words(place.block());
    let read = read(place, facts, sheet.model);
    let is_cycle = |code: CodeIx| {
        sheet.model.role(code) == Some(Role::Cycle) && sheet.model.effect(code) != Effect::CycleCancel
    };
    let mut out = String::new();
    let mut at = block.start;
    let mut feed = None;
    for word in words {
        let range = Sheet::range(place, word);
        let is_own = is_cycle(word.code)
            || read.class == Class::Moves && OWN.contains(word.letter) && !word.letter.is_corner();
        if !is_own {
            continue;
        }
        let is_feed = read.words.iter().any(|(other, meaning)| other == word && *meaning == Meaning::Feed);
        if is_feed {
            feed = Some(sheet.loaded.slice(range.clone()).to_owned());
        }
        out.push_str(sheet.loaded.slice(at..range.start).trim_end());
        if !out.is_empty() && !out.ends_with(' ') {
            out.push(' ');
        }
        at = range.end;
    }
    out.push_str(sheet.loaded.slice(at..block.end).trim_start());
    (out.trim().to_owned(), feed)
}

/// The coordinates that a move changes, as words; `None` when one is not known.
fn words(sheet: &Sheet<'_, '_>, from: &Position, to: &Position, facts: &Facts) -> Option<String> {
    let mut words = Vec::new();
    let unit = facts.units.map(Units::in_mm)?;
    let decimals = sheet.decimals(facts.units);
    for axis in Axis::ALL {
        let (old, new) = (from.raw(axis), to.raw(axis));
        if old.to_bits() == new.to_bits() {
            continue;
        }
        let value = if facts.incremental == Some(true) { new - old } else { new };
        let value = Some(value).filter(|value| !value.is_nan())?;
        let value = if axis.is_rotary() { value } else { value / unit };
        let value = if axis == Axis::X && facts.diameter == Some(true) { value * 2.0 } else { value };
        words.push(format!(
            "{}{}",
            axis.name(),
            sheet.hand.write(sheet.hand.form(sheet.model.control()), value, decimals)
        ));
    }
    Some(words.join(sheet.hand.gap()))
}

/// A dwell as the control reads it.
fn dwell(sheet: &Sheet<'_, '_>, seconds: f64) -> Option<String> {
    let code = sheet.spelled(Effect::Dwell)?;
    let rules = &sheet.model.semantics().dwell;
    let (letter, kind) = rules.get_key_value("P").or_else(|| rules.iter().next())?;
    let gap = sheet.hand.gap();
    Some(match kind {
        DwellWord::Seconds | DwellWord::SecondsOrMilliseconds => {
            format!("{code}{gap}{letter}{}", sheet.hand.write("1.", seconds, 3))
        }
        DwellWord::Milliseconds => format!("{code}{gap}{letter}{}", (seconds * 1000.0).round()),
    })
}

/// The code for a way to take corners.
fn corners(sheet: &Sheet<'_, '_>, mode: PathMode, facts: &Facts) -> Option<String> {
    let (effect, lengths) = mode.written();
    let unit = facts.units.map(Units::in_mm)?;
    let (form, decimals) = (sheet.hand.form(sheet.model.control()), sheet.decimals(facts.units));
    let mut words = vec![sheet.spelled(effect)?];
    for (letter, length) in lengths {
        words.push(format!("{letter}{}", sheet.hand.write(form, length.0 / unit, decimals)));
    }
    Some(words.join(sheet.hand.gap()))
}
