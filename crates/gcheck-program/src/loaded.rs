//! A file ready to be executed: its chunks, its flow graph, and block tables on demand.
//!
//! Knows: how a text is cut and lowered, which tables are worth keeping. Must not know: what executing means. Memory stays
//! bounded: of a large file only the tables in use are kept, and the others are lowered again when a jump needs them.

use std::borrow::Cow;
use std::cell::{Cell, RefCell};
use std::collections::VecDeque;
use std::ops::Range;
use std::rc::Rc;
use std::sync::Arc;

use gcheck_syntax::cuts;

use crate::block::{Block, BlockFlags, BlockIx, BlockTable, Value};
use crate::control_flow_graph::ControlFlowGraph;
use crate::expression::ExprIx;
use crate::file_index::{FileIndex, code_region, may_be_among_rows};
use crate::lower::{Dialect, lower, skim};

/// Bytes of text whose tables are kept.
const KEPT: usize = 2 << 20;

/// A file of one or more programs, cut, lowered and outlined.
#[derive(Debug)]
pub struct Loaded<'a> {
    text: Text<'a>,
    chunks: Vec<Range<u32>>,
    /// By chunk: what any of its blocks has.
    flags: Vec<BlockFlags>,
    region_end: u32,
    graph: Arc<ControlFlowGraph>,
    tables: RefCell<Tables>,
    /// What was looked at, when somebody asked to be told.
    touched: RefCell<Option<Touched>>,
    /// How many times it began to be noted.
    section: Cell<u32>,
}

#[derive(Debug)]
enum Text<'a> {
    /// One text, cut by ranges.
    Whole(Cow<'a, str>),
    /// Chunks that somebody else has too.
    Shared(Vec<Arc<str>>),
}

/// What was looked at of a file.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Touched {
    /// Chunks of which a block was read, ascending.
    pub chunks: Vec<u32>,
    /// All blocks with any of these flags were asked for.
    pub flags: BlockFlags,
    /// All text in front of some place was looked at.
    pub all: bool,
}

#[derive(Debug)]
struct Tables {
    slots: Vec<Option<Rc<BlockTable>>>,
    /// Chunks whose tables are kept, the oldest first.
    kept: VecDeque<u32>,
    bytes: usize,
}

/// A block with everything needed to read it.
#[derive(Debug, Clone)]
pub struct Place {
    /// The table of its chunk.
    pub table: Rc<BlockTable>,
    /// Where it is in the table.
    pub ix: BlockIx,
    /// The chunk's index.
    pub chunk: u32,
    /// Offset of the chunk in the file.
    pub base: u32,
}

impl Place {
    /// The block.
    pub fn block(&self) -> &Block {
        self.table.block(self.ix)
    }

    /// Bytes of the file.
    pub fn range(&self) -> Range<u32> {
        let block = self.block();
        self.base + block.range.start..self.base + block.range.end
    }

    /// The expressions of the block: of its words, then of its statements.
    pub fn expressions(&self) -> impl Iterator<Item = ExprIx> {
        let of_words = self.table.words(self.block()).iter().filter_map(|word| match word.value {
            Value::Expr(expr) => Some(expr),
            Value::Number(_) | Value::Missing => None,
        });
        of_words.chain(self.table.statements(self.ix).flat_map(|statement| statement.kind.expressions()))
    }
}

impl<'a> Loaded<'a> {
    /// Cuts, lowers and flow graphs a text; `see` looks at each table on the way, with its offset in the file and the chunk's text.
    ///
    /// Of a chunk of a large file whose blocks only say where to (axis words and words of arcs, [without
    /// flags](BlockFlags)) `see` is shown the blocks without their words.
    pub fn new(
        text: impl Into<Cow<'a, str>>,
        dialect: &Dialect<'_>,
        mut see: impl FnMut(u32, &BlockTable, &str),
    ) -> Self {
        let text = text.into();
        let region_end = code_region(&text).end as u32;
        let mut builder = ControlFlowGraph::builder();
        let mut chunks = Vec::new();
        let mut flags = Vec::new();
        let mut tables = Tables { slots: Vec::new(), kept: VecDeque::new(), bytes: 0 };
        for chunk in cuts(&text) {
            if chunk.start as u32 >= region_end && !chunks.is_empty() {
                break;
            }
            let base = chunk.start as u32;
            let part = text.get(chunk.clone()).unwrap_or_default();
            // The first chunks are those that execution begins with.
            let is_kept = tables.bytes + chunk.len() <= KEPT;
            let skimmed = if is_kept { None } else { skim(part, dialect) };
            let table = skimmed.unwrap_or_else(|| lower(part, dialect));
            see(base, &table, part);
            builder.add(&table, base, region_end, part, dialect);
            chunks.push(base..chunk.end as u32);
            flags.push(table.flags());
            tables.slots.push(None);
            if is_kept {
                tables.keep(chunks.len() as u32 - 1, Rc::new(table), chunk.len());
            }
        }
        let graph = Arc::new(builder.finish());
        let (text, tables) = (Text::Whole(text), RefCell::new(tables));
        Self {
            text,
            chunks,
            flags,
            region_end,
            graph,
            tables,
            touched: RefCell::default(),
            section: Cell::default(),
        }
    }

    /// Puts a file together from chunks whose flow graph is known; `flags` says for each of them what any of its blocks
    /// has. Chunks after the part that the control reads may be left out.
    pub fn of_chunks(
        texts: Vec<Arc<str>>,
        flags: Vec<BlockFlags>,
        region_end: u32,
        graph: Arc<ControlFlowGraph>,
    ) -> Self {
        let mut end = 0;
        let ends = texts.iter().map(|text| {
            end += text.len() as u32;
            end
        });
        let chunks: Vec<Range<u32>> =
            ends.zip(&texts).map(|(end, text)| end - text.len() as u32..end).collect();
        let tables = Tables { slots: vec![None; texts.len()], kept: VecDeque::new(), bytes: 0 };
        Self {
            text: Text::Shared(texts),
            chunks,
            flags,
            region_end,
            graph,
            tables: RefCell::new(tables),
            touched: RefCell::default(),
            section: Cell::default(),
        }
    }

    /// From now on it is noted which blocks are looked at; gives what was noted so far.
    pub fn note_touched(&self) -> Touched {
        self.section.set(self.section.get().wrapping_add(1));
        let mut touched = self.touched.replace(Some(Touched::default())).unwrap_or_default();
        touched.chunks.sort_unstable();
        touched.chunks.dedup();
        touched
    }

    /// Changes when another section begins to be noted: what was read in the one before counts as not yet read.
    pub fn section(&self) -> u32 {
        self.section.get()
    }

    /// Notes a block as looked at, without reading it.
    pub fn note(&self, block: u32) {
        if let Some(touched) = &mut *self.touched.borrow_mut()
            && let Some((chunk, _)) = self.graph.chunk_of(block)
            && touched.chunks.last() != Some(&(chunk as u32))
        {
            touched.chunks.push(chunk as u32);
        }
    }

    /// The text, put together where it is kept in chunks.
    pub fn text(&self) -> Cow<'_, str> {
        match &self.text {
            Text::Whole(text) => Cow::Borrowed(text),
            Text::Shared(texts) => Cow::Owned(texts.iter().map(AsRef::as_ref).collect()),
        }
    }

    /// Number of the line that holds a byte, counted from 1 by line feeds.
    pub fn line_number(&self, at: u32) -> u32 {
        if let Some(touched) = &mut *self.touched.borrow_mut() {
            touched.all = true;
        }
        let mut line = 1;
        for (chunk, range) in (0..).zip(&self.chunks) {
            let inside = (at.saturating_sub(range.start) as usize).min(range.len());
            let before = self.chunk_text(chunk).as_bytes().get(..inside).unwrap_or_default();
            line += memchr::memchr_iter(b'\n', before).count() as u32;
        }
        line
    }

    /// Text of bytes of the file that are in one chunk, as those of a block do; empty for others.
    pub fn slice(&self, range: Range<u32>) -> &str {
        let chunk = self.chunks.partition_point(|chunk| chunk.end <= range.start);
        let base = self.chunks.get(chunk).map_or(0, |chunk| chunk.start);
        let inside = range.start.saturating_sub(base) as usize..range.end.saturating_sub(base) as usize;
        self.chunk_text(chunk as u32).get(inside).unwrap_or_default()
    }

    /// The line of the file from a byte on, without its end.
    pub fn line_from(&self, start: u32) -> &str {
        let chunk = self.chunks.partition_point(|chunk| chunk.end <= start);
        let base = self.chunks.get(chunk).map_or(0, |chunk| chunk.start);
        let rest =
            self.chunk_text(chunk as u32).get(start.saturating_sub(base) as usize..).unwrap_or_default();
        rest.split(['\n', '\r']).next().unwrap_or_default()
    }

    /// Where the part ends that the control reads.
    pub fn region_end(&self) -> u32 {
        self.region_end
    }

    /// Labels, loops, programs, O-words by block number.
    pub fn flow_graph(&self) -> &ControlFlowGraph {
        &self.graph
    }

    /// The text of a chunk.
    pub fn chunk_text(&self, chunk: u32) -> &str {
        match &self.text {
            Text::Whole(text) => {
                let range = self.chunks.get(chunk as usize).cloned().unwrap_or_default();
                text.get(range.start as usize..range.end as usize).unwrap_or_default()
            }
            Text::Shared(texts) => texts.get(chunk as usize).map_or("", |text| text),
        }
    }

    /// Collects the facts of the whole file.
    pub fn file_index(&self, dialect: &Dialect<'_>) -> FileIndex {
        let mut file_index = FileIndex::default();
        for (chunk, range) in (0..).zip(&self.chunks) {
            file_index.add(&self.table(chunk, dialect), range.start, self.region_end, dialect);
        }
        file_index
    }

    /// Numbers of the blocks that have any of these flags, in text order. Chunks without such a block are passed over.
    pub fn blocks_with(
        &self,
        flags: BlockFlags,
        dialect: &Dialect<'_>,
    ) -> impl Iterator<Item = (u32, Place)> {
        if let Some(touched) = &mut *self.touched.borrow_mut() {
            touched.flags |= flags;
        }
        let chunks = (0..self.chunks.len())
            .filter(move |chunk| self.flags.get(*chunk).is_some_and(|f| f.intersects(flags)));
        let blocks = chunks.flat_map(|chunk| self.graph.blocks_of(chunk));
        blocks.filter_map(move |block| {
            let place = self.place(block, dialect)?;
            place.block().flags.intersects(flags).then_some((block, place))
        })
    }

    /// Does a code end lines of data below a block, before any block that is a command?
    pub fn ends_data_below(&self, block: u32, dialect: &Dialect<'_>) -> bool {
        let below = (block + 1..self.graph.blocks()).map_while(|block| self.place(block, dialect));
        let mut commands = below.filter(|place| !may_be_among_rows(place.block()));
        commands.next().is_some_and(|place| {
            place.table.words(place.block()).iter().any(|word| dialect.ends_data(word.code))
        })
    }

    /// A block by its number in the file.
    pub fn place(&self, block: u32, dialect: &Dialect<'_>) -> Option<Place> {
        if block >= self.graph.blocks() {
            return None;
        }
        let (chunk, index) = self.graph.chunk_of(block)?;
        let base = self.chunks.get(chunk)?.start;
        let chunk = chunk as u32;
        let table = self.table(chunk, dialect);
        let ix = table.ix(index)?;
        Some(Place { table, ix, chunk, base })
    }

    fn table(&self, chunk: u32, dialect: &Dialect<'_>) -> Rc<BlockTable> {
        if let Some(touched) = &mut *self.touched.borrow_mut()
            && touched.chunks.last() != Some(&chunk)
        {
            touched.chunks.push(chunk);
        }
        let mut tables = self.tables.borrow_mut();
        if let Some(Some(table)) = tables.slots.get(chunk as usize) {
            return Rc::clone(table);
        }
        let text = self.chunk_text(chunk);
        let table = Rc::new(lower(text, dialect));
        tables.keep(chunk, Rc::clone(&table), text.len());
        while tables.bytes > KEPT && tables.kept.len() > 1 {
            let Some(oldest) = tables.kept.pop_front() else { break };
            let len = self.chunks.get(oldest as usize).map_or(0, |r| (r.end - r.start) as usize);
            tables.bytes = tables.bytes.saturating_sub(len);
            if let Some(slot) = tables.slots.get_mut(oldest as usize) {
                *slot = None;
            }
        }
        table
    }
}

impl Tables {
    fn keep(&mut self, chunk: u32, table: Rc<BlockTable>, bytes: usize) {
        if let Some(slot) = self.slots.get_mut(chunk as usize) {
            *slot = Some(table);
            self.kept.push_back(chunk);
            self.bytes += bytes;
        }
    }
}
