//! Lines on their way to a writer.
//!
//! Knows: when to hand them on. Must not know: what is in them.

use std::io::{self, Write};

/// Handed on when there is this much: large enough that the writer's own cost does not matter.
const ENOUGH: usize = 1 << 16;

/// Collects lines and hands them to a writer in large pieces.
#[derive(Debug)]
pub(crate) struct Sink<W> {
    writer: W,
    pub(crate) buffer: Vec<u8>,
}

impl<W: Write> Sink<W> {
    pub(crate) fn new(writer: W) -> Self {
        Self { writer, buffer: Vec::with_capacity(ENOUGH + 4096) }
    }

    pub(crate) fn text(&mut self, text: &str) {
        self.buffer.extend_from_slice(text.as_bytes());
    }

    pub(crate) fn end_line(&mut self) -> io::Result<()> {
        self.buffer.push(b'\n');
        if self.buffer.len() >= ENOUGH { self.hand_on() } else { Ok(()) }
    }

    fn hand_on(&mut self) -> io::Result<()> {
        let written = self.writer.write_all(&self.buffer);
        self.buffer.clear();
        written
    }

    pub(crate) fn finish(mut self) -> io::Result<W> {
        self.hand_on()?;
        self.writer.flush()?;
        Ok(self.writer)
    }
}
