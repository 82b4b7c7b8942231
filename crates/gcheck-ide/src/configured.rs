//! Words whose meaning a configuration may give: tools, work offsets, codes.
//!
//! Knows: which word names what. Must not know: configurations, where they are.

use std::ops::Range;

use gcheck_controls::{Code, CodeNumber, Effect, Letter};
use gcheck_db::Snapshot;
use gcheck_program::Word;

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
    let place = snapshot.block_at(offset)?;
    let is_here = |word: &&Word| {
        let range = place.in_file(word.range());
        range.start <= offset && offset <= range.end
    };
    let words = place.table.words(place.block());
    // A place between two words belongs to both; the first that names something is meant.
    words.iter().filter(is_here).find_map(|word| {
        let named = named_by(snapshot, words, word).or_else(|| {
            // The `P` of `G154 P2` names the offset with its code.
            let is_p = word.letter == Letter::of('P');
            is_p.then(|| words.iter().find_map(|code| offset_by_p(snapshot, words, code))).flatten()
        })?;
        Some((named, place.in_file(word.range())))
    })
}

/// What a G or M word names, in a block of these words.
fn named_by(snapshot: &Snapshot, words: &[Word], word: &Word) -> Option<Configured> {
    let code = snapshot.control().code_at(word.code)?;
    match code.effect() {
        Effect::WorkOffset(number) => Some(Configured::Offset(number)),
        Effect::WorkOffsetByP(_) => offset_by_p(snapshot, words, word),
        _ => Some(Configured::Code(code.number())),
    }
}

/// The work offset of a code that takes its number from `P`.
fn offset_by_p(snapshot: &Snapshot, words: &[Word], code: &Word) -> Option<Configured> {
    let Effect::WorkOffsetByP(first) = snapshot.control().code_at(code.code)?.effect() else { return None };
    let p = words.iter().find(|word| word.letter == Letter::of('P')).and_then(Word::integer)?;
    Some(Configured::Offset(first.checked_add(u16::try_from(p.checked_sub(1)?).ok()?)?))
}

/// All words of a file that name the same work offset or code of the shop as the one at `offset`, in text order. Other codes are
/// in nearly every block, and have none.
pub(crate) fn configured_words(snapshot: &Snapshot, offset: u32) -> Vec<Range<u32>> {
    let Some((named, _)) = configured_at(snapshot, offset) else { return Vec::new() };
    match named {
        Configured::Tool(_) => return Vec::new(),
        Configured::Code(number) if !is_of_shop(snapshot, number) => return Vec::new(),
        Configured::Code(_) | Configured::Offset(_) => {}
    }
    let mut found = Vec::new();
    for chunk in snapshot.chunks() {
        let Some(table) = snapshot.table(chunk.index) else { continue };
        for (_, block) in table.blocks() {
            let words = table.words(block);
            let same = words.iter().filter(|word| named_by(snapshot, words, word) == Some(named));
            found.extend(same.map(|word| chunk.base + word.range().start..chunk.base + word.range().end));
        }
    }
    found
}

/// Does the configuration say what the code does?
fn is_of_shop(snapshot: &Snapshot, number: CodeNumber) -> bool {
    let control = snapshot.control();
    let plain = gcheck_controls::load(control.name());
    let plain = plain.as_ref().ok().and_then(|plain| plain.code(number));
    control.code(number).map(Code::entry) != plain.map(Code::entry)
}

#[cfg(test)]
mod tests {
    use gcheck_controls::CodeNumber;

    use super::{Configured, configured_at, configured_words};
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

    #[test]
    fn a_work_offset_is_one_by_whichever_name() {
        let text = "O1\nG110 X0.\nG154 P1 X0.\nG154 P2 X0.\nG54 X0.\nM30\n";
        let named = |at: &str| {
            let fixture =
                Fixture::new("haas-mill", &text.replacen(at, &format!("{}$0{}", &at[..1], &at[1..]), 1));
            let words = configured_words(&fixture.snapshot(), fixture.offset);
            words
                .iter()
                .map(|range| text[range.start as usize..range.end as usize].to_owned())
                .collect::<Vec<_>>()
        };
        for at in ["G110", "G154 P1", "P1 X0"] {
            assert_eq!(named(at), ["G110", "G154"], "{at}");
        }
        assert_eq!(named("P2 X0"), ["G154"]);
        assert_eq!(named("G54"), ["G54"]);
        assert_eq!(named("X0"), [] as [&str; 0]);
        assert_eq!(at("haas-mill", "O1\nG154 P$01\nM30\n"), at("haas-mill", "O1\nG1$010\nM30\n"));
        assert_eq!(at("haas-mill", "O1\nG4 P$01\nM30\n"), None);
    }
}
