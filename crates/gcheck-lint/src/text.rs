//! The text of a file, in one piece or in chunks of whole lines.
//!
//! Knows: which chunk holds a place. Must not know: what the text means.

use std::borrow::Cow;
use std::cell::OnceCell;
use std::ops::Range;
use std::rc::Rc;
use std::sync::Arc;

use gcheck_controls::Evidence;
use gcheck_program::{EVIDENCE_BYTES, collect_evidence};

/// The text of a file, as rules ask for parts of it.
#[derive(Debug)]
pub struct ProgramText<'a> {
    kind: Kind<'a>,
    /// What the text shows of its control, once a rule has asked.
    evidence: OnceCell<Rc<Evidence>>,
}

#[derive(Debug)]
enum Kind<'a> {
    Whole(&'a str),
    Chunks {
        chunks: &'a [Arc<str>],
        /// Offset of each chunk, and the length of the text.
        starts: Vec<u32>,
        /// All of it, once a rule wanted more than a chunk.
        whole: OnceCell<String>,
    },
}

impl<'a> ProgramText<'a> {
    /// In one piece.
    pub fn whole(text: &'a str) -> Self {
        Self { kind: Kind::Whole(text), evidence: OnceCell::new() }
    }

    /// In chunks of whole lines.
    pub fn chunks(chunks: &'a [Arc<str>]) -> Self {
        let mut at = 0;
        let ends = chunks.iter().map(|chunk| {
            at += chunk.len() as u32;
            at
        });
        let starts = std::iter::once(0).chain(ends).collect();
        Self { kind: Kind::Chunks { chunks, starts, whole: OnceCell::new() }, evidence: OnceCell::new() }
    }

    /// Takes over the evidence of the same [head](Self::head) from before.
    pub(crate) fn with_evidence(self, known: Rc<Evidence>) -> Self {
        Self { evidence: OnceCell::from(known), ..self }
    }

    /// What the text shows of its control, collected when a rule first asks.
    pub fn evidence(&self) -> &Evidence {
        self.evidence.get_or_init(|| Rc::new(collect_evidence(&self.head(EVIDENCE_BYTES as u32))))
    }

    /// The evidence, if a rule has asked for it.
    pub(crate) fn into_evidence(self) -> Option<Rc<Evidence>> {
        self.evidence.into_inner()
    }

    /// Length in bytes.
    pub fn len(&self) -> u32 {
        match &self.kind {
            Kind::Whole(text) => text.len() as u32,
            Kind::Chunks { starts, .. } => starts.last().copied().unwrap_or(0),
        }
    }

    /// True for an empty file.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// The text of a range; empty if the range is not in the file.
    pub fn slice(&self, range: Range<u32>) -> &str {
        let (base, chunk) = self.around(range.start);
        let in_chunk = |base: u32, text: &'a str| {
            text.get(range.start.checked_sub(base)? as usize..range.end.checked_sub(base)? as usize)
        };
        match &self.kind {
            Kind::Chunks { chunks, whole, .. } if in_chunk(base, chunk).is_none() => {
                let all = whole.get_or_init(|| chunks.iter().map(AsRef::as_ref).collect());
                all.get(range.start as usize..range.end as usize).unwrap_or_default()
            }
            _ => in_chunk(base, chunk).unwrap_or_default(),
        }
    }

    /// A part of the text that holds the whole line of a byte, and its offset.
    pub fn around(&self, at: u32) -> (u32, &'a str) {
        match &self.kind {
            Kind::Whole(text) => (0, text),
            Kind::Chunks { chunks, starts, .. } => {
                let after = starts.partition_point(|start| *start <= at);
                let index = after.saturating_sub(1).min(chunks.len().saturating_sub(1));
                (starts.get(index).copied().unwrap_or(0), chunks.get(index).map_or("", |chunk| chunk))
            }
        }
    }

    /// The text from a byte on in pieces that end where lines do, each with its offset.
    pub fn from(&self, start: u32) -> impl Iterator<Item = (u32, &'a str)> {
        let mut at = start;
        let len = self.len();
        std::iter::from_fn(move || {
            let (base, text) = (at < len).then(|| self.around(at))?;
            let piece = text.get((at - base) as usize..)?;
            let from = std::mem::replace(&mut at, base + text.len() as u32);
            Some((from, piece))
        })
    }

    /// Whole lines from the beginning: more than `len` bytes, unless the file is shorter.
    pub fn head(&self, len: u32) -> Cow<'a, str> {
        match &self.kind {
            Kind::Whole(text) => Cow::Borrowed(text),
            Kind::Chunks { .. } => Cow::Owned(
                self.from(0).take_while(|(from, _)| *from <= len).map(|(_, piece)| piece).collect(),
            ),
        }
    }
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use super::ProgramText;

    #[test]
    fn a_text_in_chunks_reads_like_one_in_one_piece() {
        let text = "G0 X1.\nG1 X2.\n\nM30\n";
        let chunks: Vec<Arc<str>> = text.split_inclusive('\n').map(Arc::from).collect();
        let (whole, cut) = (ProgramText::whole(text), ProgramText::chunks(&chunks));
        assert_eq!(whole.len(), cut.len());
        for start in 0..=text.len() as u32 {
            for end in start..=text.len() as u32 {
                assert_eq!(whole.slice(start..end), cut.slice(start..end), "{start}..{end}");
            }
            let join = |text: &ProgramText<'_>| text.from(start).map(|(_, piece)| piece).collect::<String>();
            assert_eq!(join(&whole), join(&cut), "from {start}");
        }
        assert_eq!(cut.slice(3..99), "");
        assert_eq!(cut.head(7), "G0 X1.\nG1 X2.\n");
        assert_eq!(cut.around(8), (7, "G1 X2.\n"));
    }
}
