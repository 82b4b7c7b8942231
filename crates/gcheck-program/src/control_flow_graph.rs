//! The control flow of one file as far as its text alone decides it: programs, labels, loops, O-words, straight runs.
//!
//! Knows: blocks by their number in the file, and which block belongs to which. Must not know: values, conditions, which
//! pairings are mistakes, other files.
//!
//! Blocks are numbered from 0 in text order, those outside the part that the control reads ([`crate::code_region`]) left
//! out. A file may hold several programs (`O1 … M30`, `O2 … M99`), each a range of blocks.

mod block_set;
mod builder;
mod chunk;
mod link;
mod loops;
mod o_words;
#[cfg(test)]
mod tests;

use std::ops::Range;

use crate::block::BlockTable;
use crate::statement::{OKeyword, OLabel};
use block_set::BlockSet;
pub use builder::ControlFlowGraphBuilder;
pub use chunk::{ChunkFlow, Skeleton};
use link::known;
use loops::Loops;
pub use o_words::OWordLinks;
use o_words::OWords;

/// The control flow of one file.
///
/// ```
/// use gcheck_program::{ControlFlowGraph, Dialect, lower};
///
/// let control = gcheck_controls::load("fanuc-mill").unwrap();
/// let dialect = Dialect::new(&control);
/// let text = "O1\nN10 G0 X0\nGOTO 10\nM30\nO2\nN10 M99\n";
/// let mut builder = ControlFlowGraph::builder();
/// builder.add(&lower(text, &dialect), 0, text.len() as u32, text, &dialect);
/// let graph = builder.finish();
/// assert_eq!(graph.blocks(), 6);
/// assert_eq!(graph.label(10, 2, true), Some(1));
/// assert_eq!(graph.program(2).unwrap().blocks, 4..6);
/// ```
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct ControlFlowGraph {
    blocks: u32,
    chunks: Vec<Chunk>,
    /// Number and block, sorted.
    labels: Vec<(u32, u32)>,
    /// In text order; never empty once built.
    parts: Vec<Part>,
    /// Number and index of the part, sorted.
    numbers: Vec<(u32, u32)>,
    /// Name and index of the part, sorted.
    names: Vec<(String, u32)>,
    loops: Loops,
    o_words: OWords,
    /// Blocks that may decide which block is next.
    flow: BlockSet,
    /// Blocks that are reached from elsewhere than the block before.
    entries: BlockSet,
    /// Labels, heads of programs, loop statements, O-words.
    marks: BlockSet,
    /// Runs of blocks, first and last, that the text may lead through more than once in one call; sorted, apart.
    turns: Vec<(u32, u32)>,
}

/// Where a chunk begins.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
struct Chunk {
    /// The number of its first block, or of the block that would follow.
    first: u32,
    /// Offset in the file.
    base: u32,
}

/// The blocks from one program number to the next.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
struct Part {
    start: u32,
    /// The block of the program number.
    head: u32,
    number: u32,
}

/// A program of the file.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Program {
    /// Its number; `None` when it has none, or none that is whole.
    pub number: Option<u32>,
    /// The block of its number or name; `None` in a file that begins without.
    pub head: Option<u32>,
    /// Its blocks.
    pub blocks: Range<u32>,
}

impl ControlFlowGraph {
    /// How many blocks there are.
    pub fn blocks(&self) -> u32 {
        self.blocks
    }

    /// How many chunks were added.
    pub fn chunks(&self) -> usize {
        self.chunks.len()
    }

    /// Index of the chunk that holds a block, and the block's index in it.
    pub fn chunk_of(&self, block: u32) -> Option<(usize, u32)> {
        if block >= self.blocks {
            return None;
        }
        // Of chunks with the same first block all but the last are empty.
        let ix = self.chunks.partition_point(|c| c.first <= block).checked_sub(1)?;
        Some((ix, block - self.chunks.get(ix)?.first))
    }

    /// The blocks of a chunk; an empty range for a chunk that has none and for one that is not there.
    pub fn blocks_of(&self, chunk: usize) -> Range<u32> {
        let first = |chunk: usize| self.chunks.get(chunk).map_or(self.blocks, |c| c.first);
        first(chunk)..first(chunk.saturating_add(1))
    }

    /// Offset of a chunk in the file.
    pub fn base_of(&self, chunk: usize) -> Option<u32> {
        self.chunks.get(chunk).map(|c| c.base)
    }

    /// Index of the chunk that holds a byte of the file.
    pub fn chunk_at(&self, byte: u32) -> Option<usize> {
        self.chunks.partition_point(|c| c.base <= byte).checked_sub(1)
    }

    /// The last block that begins at a byte of the file or before it.
    ///
    /// Where blocks begin inside a chunk only its table knows; `table` is asked for the one chunk that holds the byte.
    /// `None` before the first block, and when the table is not to be had.
    pub fn block_at_offset<'t>(
        &self,
        byte: u32,
        table: impl FnOnce(usize) -> Option<&'t BlockTable>,
    ) -> Option<u32> {
        let chunk = self.chunk_at(byte)?;
        let inside = byte - self.base_of(chunk)?;
        let blocks = self.blocks_of(chunk);
        let before = table(chunk)?.blocks.partition_point(|b| b.range.start <= inside) as u32;
        (blocks.start + before.min(blocks.end - blocks.start)).checked_sub(1)
    }

    /// The programs in text order; always one, even in an empty file.
    pub fn programs(&self) -> impl ExactSizeIterator<Item = Program> {
        (0..self.parts.len()).map(|ix| self.describe(ix))
    }

    /// The program of a number; the first, if several have it.
    pub fn program(&self, number: u32) -> Option<Program> {
        let at = self.numbers.partition_point(|(n, _)| *n < number);
        let (_, part) = self.numbers.get(at).filter(|(n, _)| *n == number)?;
        Some(self.describe(*part as usize))
    }

    /// The program of a name (`O<NAME>`, on controls where that is a program's head); without regard to case and blanks.
    pub fn program_named(&self, name: &str) -> Option<Program> {
        let name = crate::lower::name_key(name.as_bytes());
        let at = self.names.partition_point(|(n, _)| *n < name);
        let (_, part) = self.names.get(at).filter(|(n, _)| *n == name)?;
        Some(self.describe(*part as usize))
    }

    /// The blocks of the program that a block is in; an empty range for a block that is not there.
    pub fn part_of(&self, block: u32) -> Range<u32> {
        if block >= self.blocks {
            return self.blocks..self.blocks;
        }
        let next = self.parts.partition_point(|p| p.start <= block);
        self.part(next.saturating_sub(1))
    }

    /// The blocks of the first program: what runs when the file is started.
    ///
    /// What is in front of the first program number belongs to that program, unless it has an end (`M30`) of its own.
    pub fn main(&self) -> Range<u32> {
        self.part(0)
    }

    fn part(&self, ix: usize) -> Range<u32> {
        let start = |ix: usize| self.parts.get(ix).map_or(self.blocks, |p| p.start);
        start(ix)..start(ix.saturating_add(1))
    }

    fn describe(&self, ix: usize) -> Program {
        let part = self.parts.get(ix);
        Program {
            number: part.and_then(|p| known(p.number)),
            head: part.and_then(|p| known(p.head)),
            blocks: self.part(ix),
        }
    }

    /// The block of sequence number `number` as a jump in block `from` finds it, in its own program only.
    ///
    /// With `forward_first` the first one at `from` or after it, then the first of the program; without, the first of the
    /// program.
    pub fn label(&self, number: u32, from: u32, forward_first: bool) -> Option<u32> {
        let part = self.part_of(from);
        let first_from = |block: u32| {
            let at = self.labels.partition_point(|label| *label < (number, block));
            let (found, block) = self.labels.get(at)?;
            (*found == number && *block < part.end).then_some(*block)
        };
        let ahead = if forward_first { first_from(from) } else { None };
        ahead.or_else(|| first_from(part.start))
    }

    /// All blocks of sequence number `number`, in text order, whatever their program.
    pub fn labels(&self, number: u32) -> impl Iterator<Item = u32> {
        let at = self.labels.partition_point(|(n, _)| *n < number);
        let rest = self.labels.get(at..).unwrap_or_default();
        rest.iter().take_while(move |(n, _)| *n == number).map(|(_, block)| *block)
    }

    /// All sequence numbers of a range of blocks, with their blocks, by number.
    pub fn labels_in(&self, blocks: Range<u32>) -> impl Iterator<Item = (u32, u32)> {
        self.labels.iter().copied().filter(move |(_, block)| blocks.contains(block))
    }

    /// The `END` of the loop that `DO` in this block begins.
    pub fn end_of(&self, do_block: u32) -> Option<u32> {
        self.loops.end_of(do_block)
    }

    /// The `DO` of the loop that `END` in this block closes.
    pub fn do_of(&self, end_block: u32) -> Option<u32> {
        self.loops.do_of(end_block)
    }

    /// Blocks with a `DO` or `END` that has no partner in its program, or that is the second in its block.
    pub fn unmatched_loops(&self) -> &[u32] {
        self.loops.unmatched()
    }

    /// Blocks with an `END` that closes a loop while a loop inside it is open and closed later.
    pub fn crossed_loops(&self) -> &[u32] {
        self.loops.crossed()
    }

    /// What the O-word of a block is joined to; `None` when the block has none.
    pub fn o_word(&self, block: u32) -> Option<OWordLinks> {
        self.o_words.links(block)
    }

    /// The branches after an `if`, `elseif` or `else`, in text order: every `elseif`, the `else`, the `endif`.
    pub fn branches(&self, block: u32) -> impl Iterator<Item = u32> {
        let next = |block: u32| self.o_words.links(block)?.next;
        std::iter::successors(next(block), move |block| next(*block))
    }

    /// The block of the `sub` with a label; the first, if several have it. `None` also for a computed label.
    pub fn sub(&self, label: &OLabel) -> Option<u32> {
        self.o_words.sub(label)
    }

    /// The block of the `sub` whose text holds a block, `sub` and `endsub` included.
    pub fn sub_around(&self, block: u32) -> Option<u32> {
        self.o_words.sub_around(block, self.part_of(block).start)
    }

    /// Blocks with an O-word that lacks its partner: an opener without end, an end or branch without opener, `break` and
    /// `continue` outside their loop, `return` outside subroutines, a computed label, a second O-word in its block.
    pub fn unmatched_o_words(&self) -> &[u32] {
        self.o_words.unmatched()
    }

    /// Does a computed label (`O[#1]`) open, go on with or close a structure? Which O-words belong together only a run knows
    /// then.
    pub fn has_computed_o_labels(&self) -> bool {
        self.o_words.has_computed()
    }

    /// Blocks of a range with an O-word, in text order.
    pub fn o_words_in(&self, blocks: Range<u32>) -> impl DoubleEndedIterator<Item = (u32, OKeyword)> {
        self.o_words.within(blocks)
    }

    /// Blocks that open a structure whose label has opened another before, in the same subroutine or main part; and
    /// subroutines whose label an earlier one of the file has.
    pub fn reused_o_labels(&self) -> &[u32] {
        self.o_words.reused()
    }

    /// May control come to the block from elsewhere than the block before? True for labels, whether used or not, heads of
    /// programs, loop statements and O-words.
    ///
    /// Besides these, only the block after one that [is flow](Self::is_flow) is ever gone to, and the first of the file.
    pub fn may_be_target(&self, block: u32) -> bool {
        self.marks.contains(block)
    }

    /// Has the block a statement or code that may decide which block is next: a condition, jump, loop or O-word, a call, an
    /// end, a `G` or `M` word whose number is computed, an assignment that raises an alarm?
    ///
    /// What depends on the state is not seen: a modal macro call (`G66`) makes calls of blocks that are plain here.
    pub fn is_flow(&self, block: u32) -> bool {
        self.flow.contains(block)
    }

    /// Once a program has come to the block, does nothing in the text lead it back to it or in front of it, calls left aside?
    pub fn is_passed_for_good(&self, block: u32) -> bool {
        let at = self.turns.partition_point(|(_, last)| *last < block);
        self.turns.get(at).is_none_or(|(first, _)| block < *first)
    }

    /// Is every block of the chunk gone through from the first to the last, and the chunk entered at its first only?
    ///
    /// Labels that no jump of this file names do not count; for jumps of other files (`M99 P` of a called program) see
    /// [`Self::enter_at_label`]. False for a chunk that is not there.
    pub fn is_straight(&self, chunk: usize) -> bool {
        let blocks = self.blocks_of(chunk);
        chunk < self.chunks.len()
            && [&self.flow, &self.entries]
                .iter()
                .all(|set| set.next_from(blocks.start).is_none_or(|block| block >= blocks.end))
    }

    /// The blocks from `block` on that are gone through one after the other, entered at `block` only. Ends before the first
    /// block that is flow (so it is empty when `block` is), before one that a jump leads to, and with the program.
    pub fn straight_from(&self, block: u32) -> Range<u32> {
        let end = self.part_of(block).end;
        let flow = self.flow.next_from(block).unwrap_or(end);
        let entry = self.entries.next_from(block.saturating_add(1)).unwrap_or(end);
        block..end.min(flow).min(entry).max(block)
    }

    /// Bytes on the heap, names left out.
    #[cfg(test)]
    fn heap_bytes(&self) -> usize {
        self.chunks.capacity() * size_of::<Chunk>()
            + (self.labels.capacity() + self.numbers.capacity()) * size_of::<(u32, u32)>()
            + self.parts.capacity() * size_of::<Part>()
            + self.names.capacity() * size_of::<(String, u32)>()
            + self.loops.heap_bytes()
            + self.o_words.heap_bytes()
            + self.flow.heap_bytes()
            + self.entries.heap_bytes()
            + self.marks.heap_bytes()
            + self.turns.capacity() * size_of::<(u32, u32)>()
    }

    /// Takes note that a jump which is in another file leads to this sequence number here.
    pub fn enter_at_label(&mut self, number: u32) {
        let blocks: Vec<u32> = self.labels(number).collect();
        self.entries.merge(blocks);
    }
}
