//! Sentences beside a picture, each with the block that it speaks of.
//!
//! Knows: which moves a picture leaves out, and which words tell it. Must not know: why a coordinate is not known.

use std::fmt::Write as _;

use gcheck_engine::Position;

/// What a reader of a picture has to know.
#[derive(Debug, Clone, PartialEq, Eq, serde::Serialize)]
pub struct Note {
    /// A sentence without its full stop.
    pub words: String,
    /// The file of the block that it speaks of, as steps of the run have it; `None` where it speaks of no block.
    pub file: Option<String>,
    /// The block's line, from 1.
    pub line: Option<u32>,
}

impl Note {
    /// Of a block, which the sentence begins with.
    pub fn of_block(file: &str, line: u32, words: &str) -> Self {
        let place = place_words(file, line);
        Self { words: format!("{place}: {words}"), file: Some(file.to_owned()), line: Some(line) }
    }
}

impl<S: Into<String>> From<S> for Note {
    fn from(words: S) -> Self {
        Self { words: words.into(), file: None, line: None }
    }
}

/// `part.nc, line 12`; `line 12` in the file without a name.
pub(super) fn place_words(file: &str, line: u32) -> String {
    if file.is_empty() { format!("line {line}") } else { format!("{file}, line {line}") }
}

/// Notes of what a run assumes, as many as people read.
#[derive(Debug, Clone, Default)]
pub(super) struct Assumed {
    first: Vec<Note>,
    /// Those beyond the first.
    further: u64,
}

/// Notes of what a run assumes that are shown; the others are counted.
const MOST_ASSUMED: usize = 20;

impl Assumed {
    /// From a block on the path rests on something that nobody knows.
    pub(super) fn add(&mut self, file: &str, line: u32, words: &str) {
        if self.first.len() < MOST_ASSUMED {
            self.first.push(Note::of_block(file, line, words));
        } else {
            self.further += 1;
        }
    }

    pub(super) fn notes(&self) -> Vec<Note> {
        let mut notes = self.first.clone();
        match self.further {
            0 => {}
            1 => notes.push("and 1 more note of this kind".into()),
            further => notes.push(format!("and {further} more notes of this kind").into()),
        }
        notes
    }
}

/// Sets of the axes X, Y and Z, as bits.
const SETS: usize = 8;
/// Places of moves that are named.
const MOST_PLACES: usize = 4;

/// Moves that are not drawn, since a coordinate of them is not known. Which axes count is only known when the run is over: one
/// that nobody ever knew, as Y on most lathes, does not.
#[derive(Debug, Default)]
pub(super) struct LeftOut {
    /// By the axes that are drawn.
    by_drawn: [Missing; SETS],
}

/// Of one set of axes that are drawn.
#[derive(Debug, Default, Clone)]
pub(super) struct Missing {
    /// A place was known of which the drawing begins: rapid moves that lead to it are not missed.
    has_begun: bool,
    pub(super) moves: u64,
    /// Index of the file, line, unknown axes.
    places: Vec<(usize, u32, usize)>,
}

impl LeftOut {
    /// A move with its ends as they would be drawn.
    pub(super) fn look(&mut self, ends: [&Position; 2], is_rapid: bool, place: (usize, u32)) {
        let [from, to] = ends.map(unknown);
        for (drawn, missing) in self.by_drawn.iter_mut().enumerate() {
            let lacks = (from | to) & drawn;
            if lacks != 0 && (missing.has_begun || !is_rapid) {
                missing.moves += 1;
                let is_named = missing.places.iter().any(|(file, line, _)| (*file, *line) == place);
                if !is_named && missing.places.len() <= MOST_PLACES {
                    missing.places.push((place.0, place.1, lacks));
                }
            }
            missing.has_begun |= to & drawn == 0;
        }
    }

    /// Those of a picture with these axes.
    pub(super) fn into_missing(self, drawn: &[usize]) -> Missing {
        let drawn = drawn.iter().fold(0, |set, axis| set | 1 << axis);
        self.by_drawn.into_iter().nth(drawn).unwrap_or_default()
    }
}

impl Missing {
    /// How many, and where the first of them are.
    pub(super) fn note(&self, files: &[String]) -> Option<Note> {
        let (file, line, _) = *self.places.first()?;
        let name = |file: usize| files.get(file).map_or("", String::as_str);
        let mut words = match self.moves {
            1 => "1 move is not drawn, since a coordinate of its start or end is not known: ".to_owned(),
            count => {
                format!(
                    "{count} moves are not drawn, since a coordinate of their start or end is not known: "
                )
            }
        };
        for (ix, (file, line, lacks)) in self.places.iter().take(MOST_PLACES).enumerate() {
            let axes: Vec<&str> = ["X", "Y", "Z"]
                .into_iter()
                .enumerate()
                .filter(|(axis, _)| lacks >> axis & 1 == 1)
                .map(|(_, name)| name)
                .collect();
            let comma = if ix > 0 { ", " } else { "" };
            // Writing to a string cannot fail.
            let _ = write!(words, "{comma}{} in {}", axes.join(" and "), place_words(name(*file), *line));
        }
        if self.places.len() > MOST_PLACES {
            words.push_str(", and more");
        }
        Some(Note { words, file: Some(name(file).to_owned()), line: Some(line) })
    }
}

/// The axes of which a place does not tell the coordinate.
fn unknown(at: &Position) -> usize {
    at.xyz()
        .iter()
        .enumerate()
        .filter(|(_, value)| !value.0.is_finite())
        .fold(0, |set, (axis, _)| set | 1 << axis)
}
