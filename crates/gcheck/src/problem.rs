//! What went wrong that is not a finding: a message, its place, the line that holds it.
//!
//! Knows: how such a message is laid out. Must not know: where it is printed, or what becomes of the run.

use std::any::Any;
use std::fmt;
use std::ops::Range;
use std::path::Path;

use gcheck_report::Skipped;

use crate::paths;

/// Something that keeps a file, a configuration or the whole run from being done. One of these is one message.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
pub struct Problem {
    place: Option<Box<Place>>,
    message: String,
    excerpt: Option<Box<Excerpt>>,
    note: Option<String>,
    help: Option<String>,
}

/// Where something went wrong.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
struct Place {
    /// As messages call the file.
    name: String,
    /// Line and column from 1, in characters; none for the file as a whole.
    at: Option<(usize, usize)>,
}

/// A line of a file with a part of it marked.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
struct Excerpt {
    line: usize,
    text: String,
    /// Characters before the mark, and in it.
    before: usize,
    marked: usize,
}

/// Longer lines are cut: what is wrong with them rarely needs more.
const SHOWN: usize = 160;

impl Problem {
    /// A problem of the run as a whole.
    pub fn new(message: impl Into<String>) -> Self {
        Self { place: None, message: message.into(), excerpt: None, note: None, help: None }
    }

    /// A problem with a file.
    pub fn with_file(path: &Path, message: impl Into<String>) -> Self {
        Self { place: Some(Box::new(Place { name: paths::shown(path), at: None })), ..Self::new(message) }
    }

    /// What a panic of our own code left.
    pub(crate) fn own_mistake(payload: &(dyn Any + Send)) -> Self {
        let text = payload.downcast_ref::<String>().map(String::as_str);
        let what =
            text.or_else(|| payload.downcast_ref::<&str>().copied()).unwrap_or("it stopped without a word");
        Self::new(format!("a mistake of gcheck itself: {what}"))
            .help("please report it with the program, or as much of it as you can show")
    }

    /// The same, with a file.
    #[must_use]
    pub(crate) fn in_file(self, path: &Path) -> Self {
        Self { place: Some(Box::new(Place { name: paths::shown(path), at: None })), ..self }
    }

    /// A problem at some bytes of a text; `name` is what the text is called.
    pub fn at(name: &str, text: &str, range: &Range<usize>, message: impl Into<String>) -> Self {
        let start = range.start.min(text.len());
        let head = text.get(..start).unwrap_or_default();
        let line_start = head.rfind('\n').map_or(0, |at| at + 1);
        let rest = text.get(line_start..).unwrap_or_default();
        let line = rest.split(['\n', '\r']).next().unwrap_or_default();
        let number = head.bytes().filter(|b| *b == b'\n').count() + 1;
        let before = text.get(line_start..start).unwrap_or_default().chars().count();
        let end = range.end.clamp(start, (line_start + line.len()).max(start));
        let marked = text.get(start..end).unwrap_or_default().chars().count().max(1);
        // A tab would push the mark away from what it marks.
        let shown: String = line.chars().take(SHOWN).map(|c| if c.is_control() { ' ' } else { c }).collect();
        let excerpt = Excerpt { line: number, text: shown, before, marked };
        Self {
            place: Some(Box::new(Place { name: name.to_owned(), at: Some((number, before + 1)) })),
            excerpt: (before < SHOWN).then_some(Box::new(excerpt)),
            ..Self::new(message)
        }
    }

    /// The same without anything of the file's text, for a file that is not to be quoted.
    #[must_use]
    pub(crate) fn without_text(self) -> Self {
        if self.place.as_ref().is_none_or(|place| place.at.is_none()) {
            return self;
        }
        Self { message: "cannot be read here".to_owned(), excerpt: None, note: None, help: None, ..self }
            .note("the file is outside of the workspace, or hidden, so nothing of it is shown")
    }

    /// Why it is so.
    #[must_use]
    pub fn note(mut self, text: impl Into<String>) -> Self {
        self.note = Some(text.into());
        self
    }

    /// What to do about it.
    #[must_use]
    pub fn help(mut self, text: impl Into<String>) -> Self {
        self.help = Some(text.into());
        self
    }

    /// The message without its place.
    pub fn message(&self) -> &str {
        &self.message
    }

    /// What messages call the file, with line and column from 1 and the number of characters that are meant.
    pub(crate) fn place(&self) -> Option<(&str, usize, usize, usize)> {
        let Place { name, at } = self.place.as_deref()?;
        let (line, column) = at.unwrap_or((1, 1));
        Some((name, line, column, self.excerpt.as_ref().map_or(0, |excerpt| excerpt.marked)))
    }

    /// The file, as far as it is about one, and what is wrong.
    pub(crate) fn as_skipped(&self) -> Skipped {
        let file = self.place.as_ref().map(|place| place.name.clone()).unwrap_or_default();
        Skipped { file, reason: self.message.clone() }
    }

    /// The message with what is to be done, in one line.
    pub(crate) fn advice(&self) -> String {
        self.help.as_ref().map_or_else(|| self.message.clone(), |help| format!("{}; {help}", self.message))
    }
}

impl fmt::Display for Problem {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.place.as_deref() {
            Some(Place { name, at: Some((line, column)) }) => write!(f, "{name}:{line}:{column}: ")?,
            Some(Place { name, at: None }) => write!(f, "{name}: ")?,
            None => {}
        }
        f.write_str(&self.message)?;
        if let Some(Excerpt { line, text, before, marked }) = self.excerpt.as_deref() {
            let margin = " ".repeat(line.to_string().len());
            let marked = (*marked).min(SHOWN - before);
            write!(
                f,
                "\n{margin} |\n{line} | {text}\n{margin} | {}{}",
                " ".repeat(*before),
                "^".repeat(marked)
            )?;
        }
        if let Some(note) = &self.note {
            write!(f, "\n  note: {note}")?;
        }
        if let Some(help) = &self.help {
            write!(f, "\n  help: {help}")?;
        }
        Ok(())
    }
}

/// The reason of an input or output error without Rust's "(os error 2)".
pub(crate) fn io_reason(error: &std::io::Error) -> String {
    let text = error.to_string();
    let text = text.split(" (os error").next().unwrap_or(&text);
    let mut letters = text.chars();
    letters.next().map_or_else(String::new, |first| first.to_lowercase().chain(letters).collect())
}

#[cfg(test)]
mod tests {
    use super::Problem;

    #[test]
    fn the_place_is_counted_from_one_in_characters() {
        let text = "a = 1\nµb = 2\r\n";
        let problem = Problem::at("x.toml", text, &(8..9), "strange").help("do");
        assert_eq!(problem.to_string(), "x.toml:2:2: strange\n  |\n2 | µb = 2\n  |  ^\n  help: do");
    }

    #[test]
    fn a_place_outside_the_text_is_its_end() {
        assert_eq!(
            Problem::at("x", "ab", &(9..12), "cut off").to_string(),
            "x:1:3: cut off\n  |\n1 | ab\n  |   ^"
        );
    }
}
