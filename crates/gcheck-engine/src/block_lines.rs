//! The file and the line of a block, for what is made of a run while it runs.
//!
//! Knows: files of an execution, where their lines begin. Must not know: columns, what a line is asked for.

use std::rc::Rc;

use gcheck_controls::{Effect, Letter};
use gcheck_program::{Word, line_starts};

use crate::eval::value::Domain;
use crate::model::Model;
use crate::origin::{At, Origin};
use crate::program::Program;
use crate::state::State;

/// Finds names of files and lines of blocks; a file is read for lines when the first of its blocks is asked for.
#[derive(Debug)]
pub struct BlockLines {
    /// What the main file is called.
    main: Rc<str>,
    files: Vec<Option<FileLines>>,
}

/// A file with its lines.
#[derive(Debug)]
struct FileLines {
    name: Rc<str>,
    /// Where each line begins, in bytes.
    starts: Vec<u32>,
    /// The byte that was asked for last, and its line: many events come from one block.
    last: (u32, u32),
}

impl BlockLines {
    /// Nothing was asked for yet; `main` is what the main file is called.
    pub fn new(main: &str) -> Self {
        Self { main: Rc::from(main), files: Vec::new() }
    }

    /// The name of the file that a block is in, and its line from 1; an empty name and line 0 where the file does not exist.
    pub fn of(&mut self, program: &Program<'_>, origin: Origin) -> (Rc<str>, u32) {
        let index = origin.at.file as usize;
        if self.files.len() <= index {
            self.files.resize_with(index + 1, || None);
        }
        let Some(slot) = self.files.get_mut(index) else { return (Rc::from(""), 0) };
        if slot.is_none()
            && let Some(file) = program.file(origin.at.file)
        {
            let name = if file.name.is_empty() { &self.main } else { &file.name };
            let starts = line_starts(&file.loaded.text());
            *slot = Some(FileLines { name: Rc::clone(name), starts, last: (0, 1) });
        }
        slot.as_mut()
            .map_or_else(|| (Rc::from(""), 0), |file| (Rc::clone(&file.name), file.line(origin.start)))
    }

    /// The same of a block by its number; line 0 for a block that does not exist.
    fn of_block(&mut self, program: &Program<'_>, at: At) -> CallLine {
        let file = program.file(at.file);
        let place = file.and_then(|file| file.loaded.place(at.block, program.dialect()));
        match place {
            Some(place) => self.of(program, Origin { at, start: place.range().start, ..Origin::NONE }),
            None => (Rc::from(""), 0),
        }
    }
}

/// A block that calls: the name of its file, and its line from 1.
pub type CallLine = (Rc<str>, u32);

/// The blocks that called the program under way, for what is made of each of its events.
#[derive(Debug, Default)]
pub struct CallLines {
    at: Vec<At>,
    lines: Vec<CallLine>,
}

impl CallLines {
    /// The blocks that lead to an event: those that called, the outermost first, and the cycle whose outline its own block is of.
    pub fn of<D: Domain>(
        &mut self,
        program: &Program<'_>,
        lines: &mut BlockLines,
        state: &State<D>,
        cycle: Option<At>,
    ) -> &[CallLine] {
        let callers = || state.frames().iter().skip(1).map(|frame| frame.caller).chain(cycle);
        if !callers().eq(self.at.iter().copied()) {
            self.at = callers().collect();
            self.lines = self.at.iter().map(|at| lines.of_block(program, *at)).collect();
        }
        &self.lines
    }
}

/// The block, where it is a cycle that moves along the outline that other blocks of the program give.
pub fn outline_cycle(program: &Program<'_>, model: &Model<'_>, origin: Origin) -> Option<At> {
    // Such a block names the first and the last block of the outline.
    let names = |letter| origin.letters.contains(Letter::of(letter));
    if !(names('G') && names('P') && names('Q')) {
        return None;
    }
    let file = program.file(origin.at.file)?;
    let place = file.loaded.place(origin.at.block, program.dialect())?;
    let is_cycle = |word: &Word| {
        matches!(
            model.effect(word.code),
            Effect::FinishProfile | Effect::RoughAlongZ | Effect::RoughAlongX | Effect::RepeatPattern
        )
    };
    place.table.words(place.block()).iter().any(is_cycle).then_some(origin.at)
}

impl FileLines {
    fn line(&mut self, byte: u32) -> u32 {
        if self.last.0 != byte {
            self.last = (byte, self.starts.partition_point(|start| *start <= byte) as u32);
        }
        self.last.1
    }
}
