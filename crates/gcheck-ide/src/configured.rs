//! Words whose meaning a configuration may give: tools, work offsets, codes.
//!
//! Knows: which word names what. Must not know: configurations, where they are.

use std::ops::Range;

use gcheck_controls::{Code, CodeIx, CodeNumber, Effect, Letter};
use gcheck_db::Snapshot;

use crate::tool_words::{tool_of, tool_word_at};

/// What a word names.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Configured {
    /// A tool by its number, or its entry in the tool table.
    Tool(u32),
    /// A work offset, counted from 1: `G54` is the first.
    Offset(u16),
    /// A code.
    Code(CodeNumber),
}

/// What the word at `offset` names that a configuration may have an entry for, and its bytes.
pub fn configured_at(snapshot: &Snapshot, offset: u32) -> Option<(Configured, Range<u32>)> {
    if let Some(word) = tool_word_at(snapshot, offset) {
        return Some((Configured::Tool(tool_of(snapshot, &word)), word.range));
    }
    let (ix, range) = code_word_at(snapshot, offset)?;
    let code = snapshot.control().code_at(ix)?;
    Some(match code.effect() {
        Effect::WorkOffset(number) => (Configured::Offset(number), range),
        Effect::WorkOffsetByP(first) => {
            let place = snapshot.block_at(offset)?;
            let mut words = place.table.words(place.block()).iter();
            let p =
                words.find(|word| word.letter == Letter::of('P')).and_then(gcheck_program::Word::integer)?;
            let number = first.checked_add(u16::try_from(p.checked_sub(1)?).ok()?)?;
            (Configured::Offset(number), range)
        }
        _ => (Configured::Code(code.number()), range),
    })
}

/// All words of a file that name the same work offset or code of the shop as the one at `offset`, in text order. Other codes are
/// in nearly every block, and have none.
pub(crate) fn configured_words(snapshot: &Snapshot, offset: u32) -> Vec<Range<u32>> {
    let Some((code, _)) = code_word_at(snapshot, offset) else { return Vec::new() };
    let Some((named, _)) = configured_at(snapshot, offset) else { return Vec::new() };
    if matches!(named, Configured::Code(number) if !is_of_shop(snapshot, number)) {
        return Vec::new();
    }
    let mut found = Vec::new();
    for chunk in snapshot.chunks() {
        let Some(table) = snapshot.table(chunk.index) else { continue };
        for (_, block) in table.blocks() {
            let words = table.words(block).iter().filter(|word| word.code == code);
            found.extend(words.map(|word| chunk.base + word.range().start..chunk.base + word.range().end));
        }
    }
    found.retain(|range| configured_at(snapshot, range.start + 1).is_some_and(|(other, _)| other == named));
    found
}

/// Does the configuration say what the code does?
fn is_of_shop(snapshot: &Snapshot, number: CodeNumber) -> bool {
    let control = snapshot.control();
    let plain = gcheck_controls::load(control.name());
    let plain = plain.as_ref().ok().and_then(|plain| plain.code(number));
    control.code(number).map(Code::entry) != plain.map(Code::entry)
}

/// The G or M word at an offset, by its code.
fn code_word_at(snapshot: &Snapshot, offset: u32) -> Option<(CodeIx, Range<u32>)> {
    let place = snapshot.block_at(offset)?;
    let words = place.table.words(place.block());
    words.iter().find_map(|word| {
        let range = place.in_file(word.range());
        let is_here = range.start <= offset && offset <= range.end;
        (is_here && snapshot.control().code_at(word.code).is_some()).then_some((word.code, range))
    })
}

#[cfg(test)]
mod tests {
    use gcheck_controls::CodeNumber;

    use super::{Configured, configured_at};
    use crate::fixture::Fixture;

    fn at(control: &str, text: &str) -> Option<Configured> {
        let fixture = Fixture::new(control, text);
        configured_at(&fixture.snapshot(), fixture.offset).map(|(configured, _)| configured)
    }

    #[test]
    fn tools_offsets_and_codes() {
        for (control, text, expected) in [
            ("haas-mill", "O1\nT$03 M6\nM30\n", Configured::Tool(3)),
            ("haas-mill", "O1\nG43 H$012 Z1.\nM30\n", Configured::Tool(12)),
            ("fanuc-lathe", "O1\nT03$002\nM30\n", Configured::Tool(3)),
            ("haas-mill", "O1\nG90 G5$05\nM30\n", Configured::Offset(2)),
            ("haas-mill", "O1\nM5$01\nM30\n", Configured::Code(CodeNumber::m(51))),
        ] {
            assert_eq!(at(control, text), Some(expected), "{text}");
        }
        let number = |text| match at("haas-mill", text) {
            Some(Configured::Offset(number)) => number,
            other => panic!("{other:?}"),
        };
        assert_eq!(number("O1\nG1$054 P2\nM30\n"), number("O1\nG1$054 P1\nM30\n") + 1);
        assert_eq!(at("haas-mill", "O1\nG154$0\nM30\n"), None, "without `P` it names none");
        assert_eq!(at("haas-mill", "O1\nX$01. (T3)\nM30\n"), None);
    }
}
