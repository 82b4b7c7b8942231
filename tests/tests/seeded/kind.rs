//! Kinds of mistakes, and the edits that make one.
//!
//! Knows: what a kind says of itself, how an edit is applied. Must not know: any kind, how findings are made.

use std::ops::Range;

use crate::program::{Block, Program, Word};

/// A kind of mistake.
pub(crate) struct Kind {
    /// For tables and cases.
    pub(crate) id: &'static str,
    /// What was done wrong, as a machinist would say it.
    pub(crate) says: &'static str,
    /// What comes of it on the machine.
    pub(crate) fear: Fear,
    /// Where a finding must be to count.
    pub(crate) place: Place,
    /// The rules that say it.
    pub(crate) found_by: &'static [&'static str],
    /// It shows only to those who are told about the machine: limits, offsets, tools.
    pub(crate) needs_machine: bool,
    /// Who tells about the machine has made it none.
    pub(crate) is_settled_by_machine: bool,
    /// Every place of a program where it can be made.
    pub(crate) seeds: fn(&Program) -> Vec<Seed>,
}

impl Kind {
    /// A mistake that shows in the program alone, near the place where it was made.
    pub(crate) const fn new(
        id: &'static str,
        fear: Fear,
        says: &'static str,
        found_by: &'static [&'static str],
        seeds: fn(&Program) -> Vec<Seed>,
    ) -> Self {
        Self {
            id,
            says,
            fear,
            place: Place::Near,
            found_by,
            needs_machine: false,
            is_settled_by_machine: false,
            seeds,
        }
    }

    /// It shows where it strikes, not where it was made.
    pub(crate) const fn anywhere(self) -> Self {
        Self { place: Place::Anywhere, ..self }
    }

    /// It shows only to those who are told about the machine.
    pub(crate) const fn with_machine(self) -> Self {
        Self { needs_machine: true, ..self }
    }

    /// A machine file makes it no mistake.
    pub(crate) const fn without_machine(self) -> Self {
        Self { is_settled_by_machine: true, ..self }
    }
}

/// What comes of a mistake.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(crate) enum Fear {
    /// Tool, spindle or fixture may break.
    Crash,
    /// The part is lost.
    Scrap,
    /// The control stops, and the cycle is lost.
    Alarm,
    /// A trap for the next who restarts or changes the program.
    Trap,
}

impl Fear {
    pub(crate) fn name(self) -> &'static str {
        match self {
            Self::Crash => "crash",
            Self::Scrap => "scrap",
            Self::Alarm => "alarm",
            Self::Trap => "trap",
        }
    }
}

/// Where a finding must be to count.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(crate) enum Place {
    /// Not more than two lines from an edited one.
    Near,
    /// Anywhere in the program: the mistake shows where it strikes, not where it was made.
    Anywhere,
}

/// One mistake at one place.
pub(crate) struct Seed {
    pub(crate) edits: Vec<Edit>,
}

/// A replacement of bytes.
#[derive(Clone)]
pub(crate) struct Edit {
    pub(crate) range: Range<usize>,
    pub(crate) text: String,
}

impl Seed {
    /// The program with the mistake, and the lines (from 1) at which it was edited.
    pub(crate) fn apply(&self, text: &str) -> (String, Vec<usize>) {
        let mut edits = self.edits.clone();
        edits.sort_by_key(|edit| edit.range.start);
        let mut result = String::new();
        let mut lines = Vec::new();
        let mut done = 0;
        for edit in edits {
            // Words side by side share the blank between them.
            let start = edit.range.start.max(done);
            result.push_str(&text[done..start]);
            // A line that is put in begins after the end of the line above.
            let begun = result.clone() + if edit.text.starts_with('\n') { "\n" } else { "" };
            lines.push(begun.matches('\n').count() + 1);
            result.push_str(&edit.text);
            done = edit.range.end.max(start);
        }
        result.push_str(&text[done..]);
        (result, lines)
    }
}

impl From<Edit> for Seed {
    fn from(edit: Edit) -> Self {
        Self { edits: vec![edit] }
    }
}

impl From<Vec<Edit>> for Seed {
    fn from(edits: Vec<Edit>) -> Self {
        Self { edits }
    }
}

/// The ways to edit a program.
impl Program {
    /// A seed for every block that gives one.
    pub(crate) fn each<S: Into<Seed>>(&self, seed: impl Fn(&Block) -> Option<S>) -> Vec<Seed> {
        self.blocks.iter().filter_map(|block| seed(block).map(Into::into)).collect()
    }

    /// The word is left out, with the blank in front of it.
    pub(crate) fn without(&self, word: &Word) -> Edit {
        let before = &self.text[..word.range.start];
        let blanks = before.len() - before.trim_end_matches(' ').len();
        let line_begins =
            before.trim_end_matches(' ').ends_with('\n') || before.trim_end_matches(' ').is_empty();
        let (start, mut end) = (word.range.start - blanks, word.range.end);
        if line_begins {
            let rest = &self.text[end..];
            end += rest.len() - rest.trim_start_matches(' ').len();
        }
        Edit { range: start..end, text: String::new() }
    }

    /// The word is written so.
    #[expect(clippy::unused_self, reason = "kinds ask the program for every edit")]
    pub(crate) fn instead(&self, word: &Word, text: impl Into<String>) -> Edit {
        Edit { range: word.range.clone(), text: text.into() }
    }

    /// The value of the word is written so.
    pub(crate) fn value(&self, word: &Word, text: impl AsRef<str>) -> Edit {
        let letter = char::from(self.text.as_bytes()[word.range.start]);
        self.instead(word, format!("{letter}{}", text.as_ref()))
    }

    /// The line is left out.
    pub(crate) fn without_line(&self, block: &Block) -> Edit {
        let start = self.text[..block.range.start].rfind('\n').map_or(0, |at| at + 1);
        let end =
            self.text[block.range.end..].find('\n').map_or(self.text.len(), |at| block.range.end + at + 1);
        Edit { range: start..end, text: String::new() }
    }

    /// A line is put in above the block.
    pub(crate) fn line_above(&self, block: &Block, line: impl AsRef<str>) -> Edit {
        let start = self.text[..block.range.start].rfind('\n').map_or(0, |at| at + 1);
        Edit { range: start..start, text: format!("{}\n", line.as_ref()) }
    }

    /// Something is written after the last word of the block.
    #[expect(clippy::unused_self, reason = "kinds ask the program for every edit")]
    pub(crate) fn behind_words(&self, block: &Block, text: impl AsRef<str>) -> Edit {
        let end = block.end_of_words();
        Edit { range: end..end, text: format!(" {}", text.as_ref()) }
    }
}
