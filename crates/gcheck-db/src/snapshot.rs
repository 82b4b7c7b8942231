//! A document as it was at one moment: text by chunks, lines, trees, block tables, index and flow graph.
//!
//! Knows: how a place in the file becomes a place in a chunk. Must not know: states, findings.

use std::borrow::Cow;
use std::ops::Range;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Arc, Mutex, OnceLock, PoisonError};

use gcheck_controls::Control;
use gcheck_lint::{ChunkFacts, FileFacts};
use gcheck_program::{Block, BlockIx, BlockTable, ControlFlowGraph, Dialect, FileIndex, lower, profile};
use gcheck_syntax::{Document, Parse, line_len, parse};

use crate::{ChunkTree, Settings};

/// A document as it was at one moment. Cheap to clone, and free to go to other threads.
#[derive(Debug, Clone)]
pub struct Snapshot(Arc<Inner>);

#[derive(Debug)]
struct Inner {
    document: Document,
    settings: Settings,
    /// Offset of each chunk, and the length of the text.
    starts: Vec<u32>,
    /// Number of the first line of each chunk, and the number of line ends.
    lines: Vec<u32>,
    whole: OnceLock<Arc<FileFacts>>,
    /// The chunk whose blocks were read last: who asks for one block asks for its neighbours next.
    table: Mutex<Option<(usize, Arc<BlockTable>)>>,
    /// The chunk whose tree was read last.
    tree: Mutex<Option<(usize, Arc<Parse>)>>,
    /// How often a chunk was read.
    tables_read: AtomicUsize,
}

/// A chunk of whole lines.
#[derive(Debug, Clone, Copy)]
pub struct ChunkText<'s> {
    /// Its index.
    pub index: usize,
    /// Its offset in the file.
    pub base: u32,
    /// Number of its first line, from 0.
    pub first_line: u32,
    /// Its text.
    pub text: &'s str,
}

/// A block with everything needed to read it.
#[derive(Debug, Clone)]
pub struct BlockPlace {
    /// Number of the block in the file, from 0, as the engine counts.
    pub number: u32,
    /// The table of its chunk.
    pub table: Arc<BlockTable>,
    /// Where it is in the table.
    pub ix: BlockIx,
    /// Index of its chunk.
    pub chunk: usize,
    /// Offset of the chunk in the file.
    pub base: u32,
}

impl BlockPlace {
    /// The block.
    pub fn block(&self) -> &Block {
        self.table.block(self.ix)
    }

    /// Bytes of the file.
    pub fn range(&self) -> Range<u32> {
        self.in_file(self.block().range.clone())
    }

    /// Bytes of the chunk as bytes of the file.
    pub fn in_file(&self, range: Range<u32>) -> Range<u32> {
        self.base + range.start..self.base + range.end
    }
}

/// Line ends of each chunk, counted once while a chunk stays: a large document is not read for each of its edits.
#[derive(Debug, Default)]
pub(crate) struct LineEnds {
    chunks: Vec<Arc<str>>,
    counts: Vec<u32>,
}

impl LineEnds {
    /// Counts those of the chunks that are new, between those at the begin and at the end that are not.
    fn follow(&mut self, chunks: &[Arc<str>]) {
        let is_same = |(old, new): &(&Arc<str>, &Arc<str>)| Arc::ptr_eq(old, new);
        let head = self.chunks.iter().zip(chunks).take_while(is_same).count();
        let most = self.chunks.len().min(chunks.len()) - head;
        let tail = self.chunks.iter().rev().zip(chunks.iter().rev()).take(most).take_while(is_same).count();
        let new = chunks.get(head..chunks.len() - tail).unwrap_or_default();
        let old = head..self.chunks.len() - tail;
        self.counts.splice(old.clone(), new.iter().map(|chunk| line_ends(chunk.as_bytes()) as u32));
        self.chunks.splice(old, new.iter().cloned());
    }
}

impl Snapshot {
    pub(crate) fn new(
        document: Document,
        settings: Settings,
        whole: Option<Arc<FileFacts>>,
        line_ends: &mut LineEnds,
    ) -> Self {
        line_ends.follow(document.chunks());
        let (mut at, mut line) = (0, 0);
        let (mut starts, mut lines) = (vec![0], vec![0]);
        for (chunk, count) in document.chunks().iter().zip(&line_ends.counts) {
            at += chunk.len() as u32;
            line += count;
            starts.push(at);
            lines.push(line);
        }
        let whole = whole.map_or_else(OnceLock::new, OnceLock::from);
        let (table, tree, tables_read) = (Mutex::default(), Mutex::default(), AtomicUsize::new(0));
        Self(Arc::new(Inner { document, settings, starts, lines, whole, table, tree, tables_read }))
    }

    /// What is in force.
    pub fn settings(&self) -> &Settings {
        &self.0.settings
    }

    /// The control.
    pub fn control(&self) -> &Control {
        &self.0.settings.control
    }

    /// The control, prepared for reading blocks.
    pub fn dialect(&self) -> Dialect<'_> {
        Dialect::new(self.control())
    }

    /// Length in bytes.
    pub fn len(&self) -> u32 {
        self.0.starts.last().copied().unwrap_or(0)
    }

    /// True for an empty document.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// The chunks in order.
    pub fn chunks(&self) -> impl ExactSizeIterator<Item = ChunkText<'_>> {
        self.0.document.chunks().iter().enumerate().map(|(index, text)| self.placed(index, text))
    }

    /// A chunk by its index.
    pub fn chunk(&self, index: usize) -> Option<ChunkText<'_>> {
        self.0.document.chunks().get(index).map(|text| self.placed(index, text))
    }

    fn placed<'s>(&self, index: usize, text: &'s str) -> ChunkText<'s> {
        let at = |places: &[u32]| places.get(index).copied().unwrap_or(0);
        ChunkText { index, base: at(&self.0.starts), first_line: at(&self.0.lines), text }
    }

    /// The chunk that holds a byte; the last one for the end of the text. `None` in an empty document.
    pub fn chunk_at(&self, offset: u32) -> Option<ChunkText<'_>> {
        let last = self.0.document.chunks().len().checked_sub(1)?;
        let index = self.0.starts.partition_point(|start| *start <= offset).checked_sub(1)?;
        self.chunk(index.min(last))
    }

    /// The text of a range; what lies outside of the document is left out.
    pub fn slice(&self, range: Range<u32>) -> Cow<'_, str> {
        let part = |chunk: ChunkText<'_>| {
            let start = range.start.saturating_sub(chunk.base) as usize;
            let end = (range.end.saturating_sub(chunk.base) as usize).min(chunk.text.len());
            start..end
        };
        let Some(first) = self.chunk_at(range.start) else { return Cow::Borrowed("") };
        let in_first = part(first);
        if range.end as usize <= first.base as usize + first.text.len() {
            return Cow::Borrowed(first.text.get(in_first).unwrap_or_default());
        }
        let rest = self.chunks().skip(first.index).take_while(|chunk| chunk.base < range.end);
        Cow::Owned(rest.map(|chunk| chunk.text.get(part(chunk)).unwrap_or_default()).collect())
    }

    /// The whole text.
    pub fn text(&self) -> String {
        self.0.document.text()
    }

    /// Number of lines; the one after the last line end counts, though it may be empty.
    pub fn line_count(&self) -> u32 {
        self.0.lines.last().copied().unwrap_or(0) + 1
    }

    /// Line of a byte, from 0.
    pub fn line_at(&self, offset: u32) -> u32 {
        let Some(chunk) = self.chunk_at(offset) else { return 0 };
        let inside = (offset - chunk.base).min(chunk.text.len() as u32) as usize;
        let mut bytes = chunk.text.as_bytes().get(..inside).unwrap_or_default();
        // Between `\r` and `\n` is still the line that they end.
        if bytes.last() == Some(&b'\r') && chunk.text.as_bytes().get(inside) == Some(&b'\n') {
            bytes = bytes.get(..inside - 1).unwrap_or_default();
        }
        chunk.first_line + line_ends(bytes) as u32
    }

    /// Bytes of a line (from 0) without its end; empty, at the end of the text, for a line that is not there.
    pub fn line_range(&self, line: u32) -> Range<u32> {
        let end = self.len();
        // A last line without a line end is of the last chunk, though as many lines end before it as in the text.
        let last = self.0.document.chunks().len().saturating_sub(1);
        let index = self.0.lines.partition_point(|first| *first <= line).saturating_sub(1).min(last);
        let Some(chunk) = self.chunk(index) else { return end..end };
        let mut bytes = chunk.text.as_bytes();
        let mut start = chunk.base;
        for _ in chunk.first_line..line {
            let len = line_len(bytes);
            start += len as u32;
            bytes = bytes.get(len..).unwrap_or_default();
        }
        let text = bytes.get(..line_len(bytes)).unwrap_or_default();
        let ending = match text {
            [.., b'\r', b'\n'] => 2,
            [.., b'\r' | b'\n'] => 1,
            _ => 0,
        };
        start..start + text.len() as u32 - ending
    }

    /// Text of a line (from 0) without its end.
    pub fn line_text(&self, line: u32) -> Cow<'_, str> {
        self.slice(self.line_range(line))
    }

    /// The blocks of a chunk.
    pub fn table(&self, chunk: usize) -> Option<Arc<BlockTable>> {
        last_read(&self.0.table, chunk, || {
            let table = lower(self.chunk(chunk)?.text, &self.dialect());
            self.0.tables_read.fetch_add(1, Ordering::Relaxed);
            Some(table)
        })
    }

    /// The tree of a chunk.
    pub fn tree(&self, chunk: usize) -> Option<Arc<Parse>> {
        last_read(&self.0.tree, chunk, || Some(parse(self.chunk(chunk)?.text, profile(self.control()))))
    }

    /// The tree of the chunk that holds a byte, at its place in the file. `None` in an empty document.
    pub fn tree_at(&self, offset: u32) -> Option<ChunkTree> {
        let chunk = self.chunk_at(offset)?;
        Some(ChunkTree::new(&*self.tree(chunk.index)?, chunk.base))
    }

    /// Takes tree and blocks of a chunk from where they are known.
    pub(crate) fn has_read(&self, chunk: usize, tree: Arc<Parse>, table: Arc<BlockTable>) {
        *self.0.tree.lock().unwrap_or_else(PoisonError::into_inner) = Some((chunk, tree));
        *self.0.table.lock().unwrap_or_else(PoisonError::into_inner) = Some((chunk, table));
    }

    /// Labels, jumps, calls, loops, ends of the file.
    pub fn file_index(&self) -> &FileIndex {
        &self.whole().file_index
    }

    /// The control flow of the file as far as the text decides it.
    pub fn flow_graph(&self) -> &ControlFlowGraph {
        &self.whole().graph
    }

    /// Are index and flow graph known?
    pub(crate) fn is_outlined(&self) -> bool {
        self.0.whole.get().is_some()
    }

    /// Takes index and flow graph from somewhere else than the text, unless they are known.
    pub(crate) fn outline_by(&self, whole: Arc<FileFacts>) {
        self.0.whole.get_or_init(|| whole);
    }

    /// What a chunk holds by itself, so that one without what is looked for need not be read; `None` for one that the control
    /// does not read.
    pub fn facts(&self, chunk: usize) -> Option<&ChunkFacts> {
        self.whole().facts(chunk)
    }

    /// How many block tables were made for readers of this snapshot: what a feature costs, for tests.
    pub fn tables_read(&self) -> usize {
        self.0.tables_read.load(Ordering::Relaxed)
    }

    fn whole(&self) -> &FileFacts {
        self.0.whole.get_or_init(|| Arc::new(FileFacts::of_text(self.0.document.chunks(), &self.dialect())))
    }

    /// The last block that begins at a byte or before it, on the byte's line or an earlier one.
    pub fn block_at(&self, offset: u32) -> Option<BlockPlace> {
        let graph = self.flow_graph();
        let table = self.table(graph.chunk_at(offset)?)?;
        self.place(graph.block_at_offset(offset, |_| Some(&*table))?)
    }

    /// A block by its number.
    pub fn place(&self, number: u32) -> Option<BlockPlace> {
        let (chunk, index) = self.flow_graph().chunk_of(number)?;
        let base = self.flow_graph().base_of(chunk)?;
        let table = self.table(chunk)?;
        let ix = table.ix(index)?;
        Some(BlockPlace { number, table, ix, chunk, base })
    }
}

/// What was read last, if it is of the chunk; else it is made and kept.
fn last_read<T>(
    kept: &Mutex<Option<(usize, Arc<T>)>>,
    chunk: usize,
    make: impl FnOnce() -> Option<T>,
) -> Option<Arc<T>> {
    let mut kept = kept.lock().unwrap_or_else(PoisonError::into_inner);
    if let Some((_, known)) = kept.as_ref().filter(|(index, _)| *index == chunk) {
        return Some(Arc::clone(known));
    }
    let new = Arc::new(make()?);
    *kept = Some((chunk, Arc::clone(&new)));
    Some(new)
}

/// Line ends in whole lines or a part of them: `\n`, `\r\n` or `\r`.
fn line_ends(mut bytes: &[u8]) -> usize {
    let mut count = 0;
    while !bytes.is_empty() {
        let len = line_len(bytes);
        if matches!(bytes.get(len - 1), Some(b'\n' | b'\r')) {
            count += 1;
        }
        bytes = bytes.get(len..).unwrap_or_default();
    }
    count
}
