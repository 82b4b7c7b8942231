//! The correct program of a code: what comes before, its block, the words of the block.
//!
//! Knows: the example of the knowledge base, what any program needs. Must not know: variations.

use std::ops::Range;

use gcheck_controls::{Code, CodeNumber, Control, Letter, LetterSet, Machine};
use gcheck_program::{Dialect, Loaded};

/// A word of the block with a number.
#[derive(Clone)]
pub(crate) struct Word {
    pub(crate) letter: Letter,
    pub(crate) number: f64,
    /// The number as the block writes it.
    pub(crate) digits: String,
    /// Bytes of the block.
    pub(crate) range: Range<usize>,
}

/// A code in its correct program.
pub(crate) struct Subject<'c> {
    /// Blocks before the code's own.
    pub(crate) before: Vec<String>,
    pub(crate) block: String,
    /// The words of the block, `G`, `M`, `N` and `O` left out.
    pub(crate) words: Vec<Word>,
    /// Addresses of the block.
    pub(crate) letters: LetterSet,
    /// The codes of the block.
    pub(crate) codes: Vec<Code<'c>>,
    /// The codes of the blocks before it.
    pub(crate) earlier: Vec<Code<'c>>,
}

impl<'c> Subject<'c> {
    pub(crate) fn of(control: &'c Control, code: Code<'c>) -> Self {
        let entry = code.entry();
        let mut before = frame(control, &entry.setup);
        before.extend(entry.setup.iter().cloned());
        let earlier = codes_of(control, &before.join("\n"));
        let block = entry.example.clone();
        let (words, letters) = words_of(control, &block);
        Self { before, codes: codes_of(control, &block), words, letters, earlier, block }
    }

    /// The program with the code's own block.
    pub(crate) fn program(&self) -> String {
        self.with(&[], &self.block)
    }

    /// The program with other blocks before the last, and another last block.
    pub(crate) fn with(&self, more: &[String], block: &str) -> String {
        let lines = self.before.iter().chain(more).map(String::as_str).chain([block, "M30"]);
        let mut text = String::from("%\n");
        for line in lines {
            text.push_str(line);
            text.push('\n');
        }
        text.push_str("%\n");
        text
    }

    /// Where the block has a code, and its number as the block writes it.
    pub(crate) fn code_word(&self, code: CodeNumber) -> Option<(Range<usize>, String)> {
        let end = self.block.find(['(', ';']).unwrap_or(self.block.len());
        let mut words = self.block[..end].split_whitespace();
        let text = words.find(|word| CodeNumber::parse(word) == Some(code))?;
        let start = text.as_ptr() as usize - self.block.as_ptr() as usize;
        Some((start..start + text.len(), text[1..].to_owned()))
    }

    /// The first line of what a case changes, from 0.
    pub(crate) fn first_line(&self) -> usize {
        self.before.len() + 1
    }

    /// The block with the bytes of a word replaced.
    pub(crate) fn replaced(&self, word: &Word, by: &str) -> String {
        let mut block = self.block.clone();
        block.replace_range(word.range.clone(), by);
        block.split_whitespace().collect::<Vec<_>>().join(" ")
    }

    /// The block with one word more, before a comment.
    pub(crate) fn with_word(&self, word: &str) -> String {
        let end = self.block.find(['(', ';']).unwrap_or(self.block.len());
        let (words, comment) = self.block.split_at(end);
        format!("{} {word} {comment}", words.trim_end()).trim_end().to_owned()
    }
}

/// Units, feed, tool and spindle, as far as the code's own setup does not give them.
fn frame(control: &Control, setup: &[String]) -> Vec<String> {
    let has =
        |what: &str| setup.iter().any(|block| block.split_whitespace().any(|word| word.starts_with(what)));
    let mut frame = Vec::new();
    if !has("G20") && !has("G21") {
        frame.push("G21".to_owned());
    }
    let is_lathe = control.machine() == Machine::Lathe;
    if !has("T") {
        // Not every control changes tools.
        let changes = CodeNumber::parse("M6").is_some_and(|number| control.code(number).is_some());
        let tool = match (is_lathe, changes) {
            (true, _) => "T0101",
            (false, true) => "T1 M6",
            (false, false) => "T1",
        };
        frame.push(tool.to_owned());
    }
    if !has("S") {
        frame.push("S1000 M3".to_owned());
    }
    frame.push("G54".to_owned());
    frame.push(if is_lathe { "G0 X50. Z5." } else { "G0 X0. Y0. Z5." }.to_owned());
    frame.push(if is_lathe { "G1 X50. F0.1" } else { "G1 X0. F100." }.to_owned());
    frame
}

fn codes_of<'c>(control: &'c Control, text: &str) -> Vec<Code<'c>> {
    let mut codes = Vec::new();
    each_block(control, text, |place| {
        let words = place.table.words(place.block()).iter();
        codes.extend(words.filter_map(|word| control.code_at(word.code)));
    });
    codes
}

fn words_of(control: &Control, block: &str) -> (Vec<Word>, LetterSet) {
    let (mut words, mut letters) = (Vec::new(), LetterSet::EMPTY);
    each_block(control, block, |place| {
        for word in place.table.words(place.block()) {
            letters.insert(word.letter);
            let is_value =
                word.letter.is_corner() || !matches!(word.letter.ascii(), b'G' | b'M' | b'N' | b'O');
            let range = (place.base + word.range().start) as usize..(place.base + word.range().end) as usize;
            if let Some(number) = word.number().filter(|_| is_value) {
                let digits = block[range.clone()].trim_start_matches(|c: char| {
                    c == ',' || c.is_alphabetic() || c == '@' || c == '^' || c == '$'
                });
                words.push(Word { letter: word.letter, number, digits: digits.trim().to_owned(), range });
            }
        }
    });
    (words, letters)
}

fn each_block(control: &Control, text: &str, mut see: impl FnMut(&gcheck_program::Place)) {
    let dialect = Dialect::new(control);
    let loaded = Loaded::new(text, &dialect, |_, _, _| {});
    for number in 0..loaded.flow_graph().blocks() {
        if let Some(place) = loaded.place(number, &dialect) {
            see(&place);
        }
    }
}
