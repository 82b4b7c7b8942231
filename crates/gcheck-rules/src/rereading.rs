//! Reading a file once more, for rules that look at more of it than the survey tells.
//!
//! Knows: pieces, lines and blocks of the text. Must not know: any rule, what words mean.

use std::ops::Range;

use gcheck_program::lower;
use gcheck_syntax::line_len;

use crate::{BlockCx, FileCx};

impl<'a> FileCx<'a> {
    /// Reads a block again that the survey remembers by its place, and gives it to `look`.
    pub(crate) fn reread(&self, place: Range<u32>, mut look: impl FnMut(&BlockCx<'_>)) {
        let base = place.start;
        let text = self.slice(place);
        let table = lower(text, self.scene.dialect);
        for (ix, block) in table.blocks() {
            look(&BlockCx { scene: self.scene, table: &table, ix, block, text, base });
        }
    }

    /// Reads the file again, block by block. A rule that is on by default has no business here: it asks the survey.
    pub(crate) fn each_block(&self, mut look: impl FnMut(&BlockCx<'_>)) {
        for (start, piece) in self.pieces() {
            for chunk in gcheck_syntax::cuts(piece) {
                let base = start + chunk.start as u32;
                let text = piece.get(chunk).unwrap_or_default();
                let table = lower(text, self.scene.dialect);
                for (ix, block) in table.blocks() {
                    look(&BlockCx { scene: self.scene, table: &table, ix, block, text, base });
                }
            }
        }
    }

    /// What the control reads, in pieces that end where lines do, each with its offset. Never copied, however long it is.
    pub(crate) fn pieces(&self) -> impl Iterator<Item = (u32, &'a str)> + use<'a> {
        let end = self.region.end;
        let pieces = self.text.from(0).take_while(move |(base, _)| *base < end);
        pieces.map(move |(base, piece)| (base, piece.get(..(end - base) as usize).unwrap_or(piece)))
    }

    /// [`Self::pieces`] line by line, each line with its end.
    pub(crate) fn lines(&self) -> impl Iterator<Item = (u32, &'a str)> + use<'a> {
        self.pieces().flat_map(|(mut at, mut rest)| {
            std::iter::from_fn(move || {
                let (line, behind) = rest.split_at_checked(line_len(rest.as_bytes()))?;
                let start = at;
                (at, rest) = (start + line.len() as u32, behind);
                (!line.is_empty()).then_some((start, line))
            })
        })
    }

    /// The line around a place, at most [`LINE`] bytes of it on either side.
    pub(crate) fn line_around(&self, place: Range<u32>) -> Range<u32> {
        let (base, text) = self.text.around(place.start);
        let is_end = |byte: &&u8| matches!(byte, b'\n' | b'\r');
        let inside = place.start.saturating_sub(base) as usize;
        let (head, tail) = text.as_bytes().split_at_checked(inside).unwrap_or_default();
        let before = head.iter().rev().take(LINE).take_while(|byte| !is_end(byte)).count() as u32;
        let behind = tail.iter().take(LINE).take_while(|byte| !is_end(byte)).count() as u32;
        place.start - before..place.start + behind
    }
}

/// No line of a control is longer; a file of one long line is not read again and again.
const LINE: usize = 1024;
