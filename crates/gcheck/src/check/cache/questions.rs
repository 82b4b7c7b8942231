//! What a check asked about other programs, and what it was told.
//!
//! Knows: the questions of [`Programs`]. Must not know: who asks, or why. A verdict depends on other files through these
//! answers alone: while they stay, it stays.

use std::cell::RefCell;
use std::collections::BTreeMap;

use gcheck_engine::SourceFile;
use gcheck_lint::Programs;
use serde::{Deserialize, Serialize};
use twox_hash::XxHash3_128;

/// A question about the programs that can be called.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
pub(super) enum Question {
    /// Is there a program of this number?
    HasNumber(u32),
    /// Is there a file of this name?
    HasName(String),
    /// What does the program of this number say?
    SourceOfNumber(u32),
    /// What does the file of this name say?
    SourceOfName(String),
}

/// What the answer was.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub(super) enum Answer {
    No,
    Yes,
    /// A file, as findings call it, and the hash of its text.
    File(String, u128),
}

/// Passes questions on, and keeps them with their answers.
pub(in crate::check) struct Questions<'p> {
    programs: &'p dyn Programs,
    asked: RefCell<BTreeMap<Question, Answer>>,
}

impl<'p> Questions<'p> {
    pub(in crate::check) fn new(programs: &'p dyn Programs) -> Self {
        Self { programs, asked: RefCell::default() }
    }

    /// What was asked.
    pub(in crate::check) fn into_asked(self) -> Asked {
        Asked(self.asked.into_inner())
    }

    fn keep(&self, question: Question, answer: impl FnOnce() -> Answer) {
        self.asked.borrow_mut().entry(question).or_insert_with(answer);
    }
}

/// Questions with their answers.
#[derive(Debug, Default, Serialize, Deserialize)]
pub(in crate::check) struct Asked(BTreeMap<Question, Answer>);

/// Would all questions be answered as they were?
pub(in crate::check) fn answers_hold(asked: &Asked, programs: &dyn Programs) -> bool {
    asked.0.iter().all(|(question, answer)| *answer == ask(question, programs))
}

fn ask(question: &Question, programs: &dyn Programs) -> Answer {
    match question {
        Question::HasNumber(number) => yes_or_no(programs.has_number(*number)),
        Question::HasName(name) => yes_or_no(programs.has_name(name)),
        Question::SourceOfNumber(number) => file(programs.source_of_number(*number).as_ref()),
        Question::SourceOfName(name) => file(programs.source_of_name(name).as_ref()),
    }
}

fn yes_or_no(answer: bool) -> Answer {
    if answer { Answer::Yes } else { Answer::No }
}

fn file(found: Option<&SourceFile>) -> Answer {
    found.map_or(Answer::No, |file| {
        Answer::File(file.name.to_string(), XxHash3_128::oneshot(file.text.as_bytes()))
    })
}

impl Programs for Questions<'_> {
    fn has_number(&self, number: u32) -> bool {
        let answer = self.programs.has_number(number);
        self.keep(Question::HasNumber(number), || yes_or_no(answer));
        answer
    }

    fn has_name(&self, name: &str) -> bool {
        let answer = self.programs.has_name(name);
        self.keep(Question::HasName(name.to_owned()), || yes_or_no(answer));
        answer
    }

    fn source_of_number(&self, number: u32) -> Option<SourceFile> {
        let answer = self.programs.source_of_number(number);
        self.keep(Question::SourceOfNumber(number), || file(answer.as_ref()));
        answer
    }

    fn source_of_name(&self, name: &str) -> Option<SourceFile> {
        let answer = self.programs.source_of_name(name);
        self.keep(Question::SourceOfName(name.to_owned()), || file(answer.as_ref()));
        answer
    }
}
