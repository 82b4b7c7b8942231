//! The sections of a run: what they are, where they begin and end, a print of what they cut.
//!
//! Knows: tool changes, lines at which operations begin. Must not know: which sections of two runs belong together.

use std::collections::VecDeque;
use std::sync::Arc as Shared;

use gcheck_engine::Position;

use super::curve::Curve;
use super::difference::{By, Place, SectionAt, Title};
use super::print::Print;
use crate::trail::{Act, Doing, Driven, Stand};

/// More sections than these are not paired.
const MOST: usize = 4_096;
/// Moves after the last cut that are kept.
pub(super) const MOST_CLOSING: usize = 64;

/// Where a program says that an operation begins.
#[derive(Debug, Clone)]
pub struct Marks {
    file: Shared<str>,
    /// The first line of each, from 1, in order, and what the program calls it.
    lines: Vec<(u32, Shared<str>)>,
}

impl Marks {
    /// `lines` are in order: the first line of each operation of a file, and what the program calls it.
    pub fn new(file: &str, lines: impl IntoIterator<Item = (u32, String)>) -> Self {
        let lines = lines.into_iter().map(|(line, name)| (line, Shared::from(name)));
        Self { file: Shared::from(file), lines: lines.collect() }
    }

    /// How many operations there are.
    pub const fn len(&self) -> usize {
        self.lines.len()
    }

    /// Is there none?
    pub const fn is_empty(&self) -> bool {
        self.lines.is_empty()
    }
}

/// Finds where sections begin. Has to see every act of a run, in order.
#[derive(Debug, Clone)]
pub(super) struct Splitter {
    marks: Option<Shared<Marks>>,
    /// How many marks are above the line that is executed.
    passed: usize,
}

impl Splitter {
    /// What begins with this act, if something does.
    pub(super) fn begins(&mut self, act: &Act) -> Option<Title> {
        let Some(marks) = &self.marks else {
            return match &act.doing {
                Doing::Stand(Stand::ToolChange(tool)) => Some(Title::Tool(*tool)),
                _ => None,
            };
        };
        if marks.file != act.file {
            return None;
        }
        let passed = marks.lines.partition_point(|(line, _)| *line <= act.line);
        if std::mem::replace(&mut self.passed, passed) == passed {
            return None;
        }
        let operation = passed.checked_sub(1).and_then(|last| marks.lines.get(last));
        Some(operation.map_or(Title::Start, |(_, name)| Title::Operation(Shared::clone(name))))
    }
}

/// One section.
#[derive(Debug, Clone)]
pub(super) struct Section {
    pub(super) title: Title,
    pub(super) name: Shared<str>,
    /// Its first act; `None` where it has none.
    first: Option<Place>,
    last: u32,
    pub(super) print: Print,
}

impl Section {
    fn new(title: Title) -> Self {
        Self { title, name: Shared::from(""), first: None, last: 0, print: Print::default() }
    }

    fn add(&mut self, act: &Act) {
        match &self.first {
            Some(first) if first.file == act.file => self.last = self.last.max(act.line),
            Some(_) => {}
            None => {
                self.first = Some(act.place());
                self.last = act.line;
            }
        }
        if let Doing::Move(made) = &act.doing
            && made.driven != Driven::Rapid
        {
            self.print.add(made);
        }
    }

    /// The section, `place` the place among those of its run.
    pub(super) fn at(&self, place: usize) -> SectionAt {
        SectionAt {
            title: self.title.clone(),
            name: Shared::clone(&self.name),
            place: u32::try_from(place).unwrap_or(u32::MAX),
            first: self.first.clone().unwrap_or_else(|| Place { file: Shared::from(""), line: 0 }),
            last: self.last,
        }
    }

    /// Does nothing happen in it?
    pub(super) const fn is_void(&self) -> bool {
        self.first.is_none()
    }
}

/// The sections of a run. The first is what comes before the first tool change or operation; nothing may be in it.
#[derive(Debug, Clone)]
pub struct Outline {
    splitter: Splitter,
    pub(super) sections: Vec<Section>,
    is_too_long: bool,
    /// Where the moves after the last cut lead to; empty where there are too many.
    pub(super) closing: VecDeque<Position>,
    has_too_many_closing: bool,
    /// Where the program ends.
    pub(super) end: Option<Place>,
}

impl Outline {
    /// Of a run that is cut at tool changes.
    pub fn of_tools() -> Self {
        Self::new(None)
    }

    /// Of a run that is cut at operations.
    pub fn of_operations(marks: Marks) -> Self {
        Self::new(Some(Shared::new(marks)))
    }

    fn new(marks: Option<Shared<Marks>>) -> Self {
        Self {
            splitter: Splitter { marks, passed: 0 },
            sections: vec![Section::new(Title::Start)],
            is_too_long: false,
            closing: VecDeque::new(),
            has_too_many_closing: false,
            end: None,
        }
    }

    /// The next act of the run.
    pub fn add(&mut self, act: &Act) {
        if let Some(title) = self.splitter.begins(act) {
            self.is_too_long |= self.sections.len() > MOST;
            if !self.is_too_long {
                self.sections.push(Section::new(title));
            }
        }
        match &act.doing {
            Doing::Stand(Stand::End) => {
                self.end = Some(act.place());
                return;
            }
            Doing::Stand(_) => {}
            Doing::Move(made) if made.driven == Driven::Rapid => {
                if !Curve::new(made).is_nothing() {
                    self.closing.push_back(made.to);
                    self.has_too_many_closing |= self.closing.len() > MOST_CLOSING;
                    self.closing.truncate(MOST_CLOSING);
                }
            }
            Doing::Move(_) => {
                self.closing.clear();
                self.has_too_many_closing = false;
            }
        }
        if let Some(section) = self.sections.last_mut() {
            section.add(act);
        }
    }

    /// Sections without the first one.
    pub fn len(&self) -> usize {
        self.sections.len().saturating_sub(1)
    }

    /// Does no tool change or operation cut the run?
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Were there more sections than are kept?
    pub(super) const fn is_too_long(&self) -> bool {
        self.is_too_long
    }

    /// Where the moves after the last cut lead to, as far as there are few.
    pub(super) fn closing(&self) -> impl ExactSizeIterator<Item = &Position> + DoubleEndedIterator {
        let count = if self.has_too_many_closing { 0 } else { self.closing.len() };
        self.closing.iter().take(count)
    }

    pub(super) const fn by(&self) -> By {
        if self.splitter.marks.is_some() { By::Operations } else { By::Tools }
    }

    /// One that finds the same sections in another run of the program.
    pub(super) fn splitter(&self) -> Splitter {
        Splitter { marks: self.splitter.marks.clone(), passed: 0 }
    }

    /// Gives names to the sections. `name` gets what a section is, the line after which the program may name it, and its first
    /// block.
    pub fn name(&mut self, mut name: impl FnMut(&Title, u32, &Place) -> Option<String>) {
        let mut after = 0;
        for section in &mut self.sections {
            let Some(first) = &section.first else { continue };
            if let Some(name) = name(&section.title, after, first) {
                section.name = Shared::from(name);
            }
            after = section.last;
        }
    }
}
