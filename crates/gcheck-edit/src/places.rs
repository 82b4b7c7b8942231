//! Words of places rewritten for a path that is shifted, mirrored or turned.
//!
//! Knows: which word becomes which. Must not know: where the path goes (see [`crate::course`]).

use gcheck_controls::LetterSet;
use gcheck_engine::Model;
use gcheck_geometry::Plane;
use gcheck_program::{Place, Word};

use crate::course::mirrored;
use crate::meaning::{Class, Meaning, Read};
use crate::refusal::Refusal;
use crate::rigid::{LINEAR, Rigid};
use crate::sheet::Sheet;
use crate::witness::Seen;

/// The letters of the ways to a centre.
const CENTRES: [char; 3] = ['I', 'J', 'K'];

/// Rewrites a block that moves.
pub(crate) fn rewrite(
    sheet: &mut Sheet<'_, '_>,
    place: &Place,
    seen: &Seen,
    read: &Read,
    rigid: &Rigid,
) -> Result<(), Refusal> {
    if !matches!(read.class, Class::Moves | Class::Operation) {
        return Ok(());
    }
    codes(sheet, place, seen, rigid)?;
    let facts = &seen.facts;
    let unit = facts.units.map_or(1.0, gcheck_engine::Units::in_mm);
    let decimals = sheet.decimals(facts.units);
    // A letter that becomes another one changes places with it, so that X stays in front of Y.
    let mut new: Vec<(usize, char, String)> = Vec::new();
    let mut slots: Vec<Word> = Vec::new();
    for (word, meaning) in &read.words {
        let (axis, is_way, is_centre) = match meaning {
            Meaning::Place { axis, incremental } | Meaning::Height { axis, incremental } => {
                (*axis, *incremental, false)
            }
            Meaning::Centre { axis, incremental } => (*axis, *incremental, true),
            Meaning::Vector { axis } => (*axis, true, true),
            _ => continue,
        };
        if rigid.keeps(axis) {
            continue;
        }
        let Some(turned) = rigid.turned(axis) else { continue };
        let is_diameter = turned.axis == 0 && facts.diameter == Some(true) && !is_centre;
        let offset = turned.offset / unit * if is_diameter { 2.0 } else { 1.0 };
        let offset = if is_way { 0.0 } else { offset };
        let text = sheet.rewritten(place, word, facts.units, turned.sign, offset, decimals)?;
        let letter = match meaning {
            Meaning::Place { .. } if turned.axis != axis => {
                LINEAR.get(turned.axis).map_or('X', |axis| axis.name())
            }
            Meaning::Centre { .. } | Meaning::Vector { .. } => {
                CENTRES.get(turned.axis).copied().unwrap_or('I')
            }
            _ => char::from(word.letter.ascii()),
        };
        slots.push(*word);
        new.push((usize::from(is_centre), letter, text));
    }
    new.sort_by(|(a, letter_a, _), (b, letter_b, _)| {
        // Only what changes its letter is put in order; a shift leaves words where they are.
        if rigid.swaps() { (a, letter_a).cmp(&(b, letter_b)) } else { std::cmp::Ordering::Equal }
    });
    if rigid.swaps() {
        slots.sort_by_key(|word| usize::from(LetterSet::of("IJK").contains(word.letter)));
    }
    for (word, (_, letter, text)) in slots.iter().zip(new) {
        put(sheet, place, word, letter, &text);
    }
    Ok(())
}

/// Writes a letter and a value in the place of a word.
fn put(sheet: &mut Sheet<'_, '_>, place: &Place, word: &Word, letter: char, text: &str) {
    let (value, _) = sheet.value(place, word);
    let start = Sheet::range(place, word).start;
    let head = sheet.loaded.slice(start..value.start).to_owned();
    let is_small = head.starts_with(|c: char| c.is_ascii_lowercase());
    let letter = if is_small { letter.to_ascii_lowercase() } else { letter };
    let rest: String = head.chars().skip(1).collect();
    sheet.replace(start..value.end, format!("{letter}{rest}{text}"));
}

/// Has a block a code that a mirror turns the other way round?
pub(crate) fn switches_side(place: &Place, model: &Model<'_>) -> bool {
    let mut words = place.table.words(place.block()).iter();
    words.any(|word| word.code.is_some() && mirrored(model.effect(word.code)).is_some())
}

/// Codes that turn the other way round.
fn codes(sheet: &mut Sheet<'_, '_>, place: &Place, seen: &Seen, rigid: &Rigid) -> Result<(), Refusal> {
    let words: Vec<Word> = place.table.words(place.block()).to_vec();
    for word in words.iter().filter(|word| word.code.is_some()) {
        let effect = sheet.model.effect(word.code);
        let Some(other) = mirrored(effect) else { continue };
        let range = Sheet::range(place, word);
        let Some(flips) = rigid.flips(seen.facts.plane.unwrap_or(Plane::Xy)) else {
            let reason = "the plane of this code would have to become another one";
            return Err(Refusal::at(range, reason).help("rotate by 180°, or select lines in the XY plane"));
        };
        if !flips {
            continue;
        }
        let Some(text) = sheet.code(place, word, other) else {
            return Err(Refusal::at(range, "the control has no code for the other way round"));
        };
        sheet.replace(range, text);
    }
    Ok(())
}
