//! Words that name a tool or its entries in the tool table: `T3`, `H3`, `D3`.
//!
//! Knows: where a program has such words, what program and configuration tell of a tool. Must not know: states, runs.

use std::ops::Range;

use gcheck_controls::Letter;
use gcheck_db::Snapshot;
use gcheck_engine::{Axis, Model, Units};
use gcheck_program::{ToolNames, Word};

use crate::number_text::{plain, unit};

/// A word that names a tool by its number.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct ToolWord {
    /// `T`, `H` or `D`.
    pub(crate) letter: Letter,
    pub(crate) number: u32,
    /// Bytes of the file.
    pub(crate) range: Range<u32>,
}

/// The addresses that name tools.
const LETTERS: [char; 3] = ['T', 'H', 'D'];

/// The word that names a tool at an offset.
pub(crate) fn tool_word_at(snapshot: &Snapshot, offset: u32) -> Option<ToolWord> {
    let place = snapshot.block_at(offset)?;
    let words = place.table.words(place.block());
    // Where two words meet, either may be meant: the one that names a tool.
    words.iter().find_map(|word| {
        let range = place.in_file(word.range());
        let is_here = range.start <= offset && offset <= range.end;
        let number = is_here.then(|| tool_number(snapshot, words, word)).flatten()?;
        Some(ToolWord { letter: word.letter, number, range })
    })
}

/// All words with an address that name the tool of this number, in text order.
pub(crate) fn tool_words(snapshot: &Snapshot, letter: Letter, number: u32) -> Vec<ToolWord> {
    let mut found = Vec::new();
    for chunk in snapshot.chunks() {
        // Of a large file most chunks name no tool, and need not be read.
        let has_letter =
            snapshot.facts(chunk.index).is_some_and(|facts| facts.file_index().letters.contains(letter));
        let Some(table) = has_letter.then(|| snapshot.table(chunk.index)).flatten() else { continue };
        for (_, block) in table.blocks().filter(|(_, block)| block.letters.contains(letter)) {
            let words = table.words(block);
            let of_tool = words
                .iter()
                .filter(|word| word.letter == letter && tool_number(snapshot, words, word) == Some(number));
            found.extend(of_tool.map(|word| ToolWord {
                letter,
                number,
                range: chunk.base + word.range().start..chunk.base + word.range().end,
            }));
        }
    }
    found
}

/// The number of a word that names a tool: none in a block whose words are arguments of a program that it calls.
fn tool_number(snapshot: &Snapshot, words: &[Word], word: &Word) -> Option<u32> {
    let control = snapshot.control();
    let calls = |other: &Word| control.code_at(other.code).is_some_and(|code| code.entry().any_words);
    let is_address = LETTERS.iter().any(|letter| word.letter == Letter::of(*letter));
    if !is_address || words.iter().any(calls) {
        return None;
    }
    word.integer()
}

/// The tool that a word names: where offsets are a part of `T`, `T0302` names tool 3.
pub(crate) fn tool_of(snapshot: &Snapshot, word: &ToolWord) -> u32 {
    let by_t = snapshot.control().semantics().tools.offset_in_t;
    if by_t && word.letter == Letter::of('T') && word.number > 99 { word.number / 100 } else { word.number }
}

/// What is told of a tool, in a few words: its name in the program, its length and diameter in the configuration. Empty where
/// nothing is. `names` are those that the program gives its tools.
pub(crate) fn told_of_tool(snapshot: &Snapshot, names: &ToolNames<'_>, tool: u32) -> Vec<String> {
    let mut told: Vec<String> = names.get(tool).map(str::to_owned).into_iter().collect();
    let machine = &snapshot.settings().machine.engine;
    let Some(entry) = machine.tools.get(&tool) else { return told };
    let model = Model::new(snapshot.control());
    let units = machine.units.or_else(|| model.units_at_power_on(&machine.settings)).unwrap_or(Units::Mm);
    let length = |what: &str, mm: f64| {
        mm.is_finite().then(|| format!("{what} {} {}", plain(mm / units.in_mm(), 4), unit(units)))
    };
    told.extend(entry.offset.get(Axis::Z).and_then(|mm| length("length", mm)));
    told.extend(length("diameter", entry.diameter.0));
    told.extend(length("corner radius", entry.corner_radius.0));
    let teeth = machine.cutting.get(&tool).and_then(|cutting| cutting.teeth);
    told.extend(teeth.map(|teeth| format!("{teeth} teeth")));
    told
}

#[cfg(test)]
mod tests {
    use gcheck_controls::Letter;

    use super::{tool_of, tool_word_at, tool_words};
    use crate::fixture::Fixture;

    #[test]
    fn words_of_a_tool_are_those_of_its_address_and_number() {
        let text = "O1\nT3 M6\nG43 H3 Z1.\nG65 P9010 T3.\nT4\nT$03 M6\nM30\n";
        let fixture = Fixture::new("haas-mill", text);
        let snapshot = fixture.snapshot();
        let word = tool_word_at(&snapshot, fixture.offset).unwrap();
        assert_eq!((word.letter, word.number), (Letter::of('T'), 3));
        let lines: Vec<u32> = tool_words(&snapshot, word.letter, word.number)
            .iter()
            .map(|word| snapshot.line_at(word.range.start) + 1)
            .collect();
        assert_eq!(lines, [2, 6]);
    }

    #[test]
    fn a_turret_has_the_offset_in_the_word() {
        let fixture = Fixture::new("fanuc-lathe", "O1\nT$00302\nM30\n");
        let snapshot = fixture.snapshot();
        let word = tool_word_at(&snapshot, fixture.offset).unwrap();
        assert_eq!(tool_of(&snapshot, &word), 3);
    }
}
