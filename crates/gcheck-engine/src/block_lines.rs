//! The file and the line of a block, for what is made of a run while it runs.
//!
//! Knows: files of an execution, where their lines begin. Must not know: columns, what a line is asked for.

use std::rc::Rc;

use gcheck_program::line_starts;

use crate::origin::Origin;
use crate::program::Program;

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
}

impl FileLines {
    fn line(&mut self, byte: u32) -> u32 {
        if self.last.0 != byte {
            self.last = (byte, self.starts.partition_point(|start| *start <= byte) as u32);
        }
        self.last.1
    }
}
