//! Collecting an flow graph.
//!
//! Knows: block tables in order, and what of a block matters to control flow. Must not know: how pairs are made.

use std::collections::BTreeMap;
use std::ops::Range;

use super::chunk::{ChunkFlow, Item, scan};
use super::link::NONE;
use super::loops::LoopBuilder;
use super::o_words::OWordBuilder;
use super::{Chunk, ControlFlowGraph, Part};
use crate::block::BlockTable;
use crate::lower::Dialect;

/// A call names a program by its number, or by the last digits of a number whose first digits count repeats.
const PROGRAM_DIGITS: u32 = 10_000;

/// An [`ControlFlowGraph`] in the making: chunks are added in text order.
#[derive(Debug, Clone)]
pub struct ControlFlowGraphBuilder {
    graph: ControlFlowGraph,
    loops: LoopBuilder,
    o_words: OWordBuilder,
    /// The program in front of the first program number has an end of its own.
    has_end: bool,
    /// Sequence numbers that are jumped to.
    jumps: Vec<u32>,
    /// Program numbers that are called.
    calls: Vec<u32>,
    has_computed_call: bool,
    /// Programs, by index, with a jump to a computed sequence number.
    computed: Vec<u32>,
    /// A subprogram may return to a computed sequence number of whatever program called it.
    has_computed_return: bool,
    /// By sequence number, or `None` for computed ones: the last block that jumps there.
    sites: BTreeMap<Option<u32>, u32>,
    /// Variables whose assignment is an alarm, known from the first assignment on.
    alarms: Option<Vec<Range<u32>>>,
}

impl Default for ControlFlowGraphBuilder {
    fn default() -> Self {
        let part = Part { start: 0, head: NONE, number: NONE };
        Self {
            graph: ControlFlowGraph { parts: vec![part], ..ControlFlowGraph::default() },
            loops: LoopBuilder::default(),
            o_words: OWordBuilder::default(),
            has_end: false,
            jumps: Vec::new(),
            calls: Vec::new(),
            has_computed_call: false,
            computed: Vec::new(),
            has_computed_return: false,
            sites: BTreeMap::new(),
            alarms: None,
        }
    }
}

impl ControlFlowGraph {
    /// Collects the flow graph of a file chunk by chunk.
    pub fn builder() -> ControlFlowGraphBuilder {
        ControlFlowGraphBuilder::default()
    }
}

impl ControlFlowGraphBuilder {
    /// Adds the next chunk. `text` is the chunk's, `base` its offset in the file, `region_end` the end of the part of the file
    /// that the control reads; blocks that begin after it are left out.
    pub fn add(&mut self, table: &BlockTable, base: u32, region_end: u32, text: &str, dialect: &Dialect<'_>) {
        let inside = table.blocks.partition_point(|b| base.saturating_add(b.range.start) < region_end);
        let first = self.begin_chunk(base, inside as u32);
        let mut alarms = self.alarms.take();
        scan(table, inside, text, dialect, &mut alarms, &mut |block, item| {
            self.take(first.saturating_add(block), item);
        });
        self.alarms = alarms;
    }

    /// Adds the next chunk by what it adds; `base` is its offset in the file.
    pub fn add_part(&mut self, part: &ChunkFlow, base: u32) {
        let first = self.begin_chunk(base, part.blocks);
        let mut labels = part.labels.iter().peekable();
        for (block, item) in &part.items {
            while let Some((labelled, number)) = labels.next_if(|(labelled, _)| labelled <= block) {
                self.take(first.saturating_add(*labelled), Item::Label(*number));
            }
            self.take(first.saturating_add(*block), item.clone());
        }
        for (block, number) in labels {
            self.take(first.saturating_add(*block), Item::Label(*number));
        }
    }

    fn begin_chunk(&mut self, base: u32, blocks: u32) -> u32 {
        let first = self.graph.blocks;
        self.graph.chunks.push(Chunk { first, base });
        self.graph.blocks = first.saturating_add(blocks);
        first
    }

    fn take(&mut self, number: u32, item: Item) {
        match item {
            Item::Label(label) => {
                self.graph.labels.push((label, number));
                self.graph.marks.push(number);
            }
            Item::Program(program) => self.begin_program(number, program),
            Item::Name(name) => {
                self.begin_program(number, NONE);
                let part = self.part();
                self.graph.names.push((name, part));
            }
            Item::Flow => self.graph.flow.push(number),
            // `/M30` and `IF … M30` may be passed by, but they show that the program is meant to end here.
            Item::Ends => self.has_end |= self.graph.parts.len() == 1,
            Item::Jump { target, returns } => self.jump(number, target, returns),
            Item::Call(Some(program)) => push_new(&mut self.calls, program),
            Item::Call(None) => self.has_computed_call = true,
            Item::Loop { begins, number: of } => {
                self.graph.marks.push(number);
                self.loops.add(number, begins, of);
            }
            Item::OWord { keyword, label } => {
                self.graph.marks.push(number);
                self.o_words.add(number, keyword, &label);
            }
        }
    }

    /// All chunks are added.
    pub fn finish(mut self) -> ControlFlowGraph {
        self.end_program();
        self.note_entries();
        let mut graph = self.graph;
        graph.loops = self.loops.finish();
        graph.o_words = self.o_words.finish();
        graph.labels.sort_unstable();
        graph.labels.shrink_to_fit();
        graph.turns = turns(&graph, &self.sites);
        let parts = graph.parts.iter().zip(0u32..);
        graph.numbers = parts.filter(|(p, _)| p.number != NONE).map(|(p, ix)| (p.number, ix)).collect();
        graph.numbers.sort_unstable();
        graph.numbers.shrink_to_fit();
        graph.names.sort_unstable();
        graph.chunks.shrink_to_fit();
        graph.parts.shrink_to_fit();
        graph.flow.shrink();
        graph.marks.shrink();
        graph
    }

    /// Finds the labels that a jump may name and the heads that a call may name. Labels are in text order still.
    fn note_entries(&mut self) {
        for list in [&mut self.jumps, &mut self.calls, &mut self.computed] {
            list.sort_unstable();
            list.dedup();
        }
        let parts = &self.graph.parts;
        let is_called = |part: &Part| {
            let (number, packed) = (part.number, part.number % PROGRAM_DIGITS);
            self.has_computed_call
                || self.calls.iter().any(|call| *call == number || call % PROGRAM_DIGITS == packed)
        };
        // The first program begins where the file does, so its head is passed like any block, unless something calls it.
        // The others are only called or fallen into.
        let heads = parts.iter().enumerate().filter(|(ix, p)| *ix > 0 || is_called(p));
        let mut entries: Vec<u32> =
            heads.flat_map(|(_, p)| [p.start, p.head]).filter(|block| *block != NONE).collect();
        if self.has_computed_return || !self.jumps.is_empty() || !self.computed.is_empty() {
            let mut part = 0;
            for (number, block) in &self.graph.labels {
                while parts.get(part + 1).is_some_and(|next| next.start <= *block) {
                    part += 1;
                }
                if self.has_computed_return
                    || self.jumps.binary_search(number).is_ok()
                    || self.computed.binary_search(&(part as u32)).is_ok()
                {
                    entries.push(*block);
                }
            }
        }
        self.graph.entries.merge(entries);
    }

    fn end_program(&mut self) {
        self.loops.end_program();
        self.o_words.end_program();
    }

    fn part(&self) -> u32 {
        self.graph.parts.len().saturating_sub(1) as u32
    }

    fn begin_program(&mut self, head: u32, number: u32) {
        self.graph.marks.push(head);
        let is_second_head = self.graph.parts.last().is_some_and(|p| p.head == head);
        if is_second_head {
            return;
        }
        match self.graph.parts.as_mut_slice() {
            [first] if first.head == NONE && !self.has_end => {
                first.head = head;
                first.number = number;
            }
            _ => {
                self.end_program();
                self.graph.parts.push(Part { start: head, head, number });
            }
        }
    }

    /// A jump to a sequence number, which is `None` when computed; `returns` when it may leave its program.
    fn jump(&mut self, block: u32, target: Option<u32>, returns: bool) {
        self.sites.insert(target, block);
        match target {
            Some(number) => push_new(&mut self.jumps, number),
            None if returns => self.has_computed_return = true,
            None => {
                let part = self.part();
                push_new(&mut self.computed, part);
            }
        }
    }
}

/// Runs of blocks that the text may lead through more than once: from the first block that a jump back may lead to, to the
/// last that may jump there.
fn turns(graph: &ControlFlowGraph, sites: &BTreeMap<Option<u32>, u32>) -> Vec<(u32, u32)> {
    let mut turns: Vec<(u32, u32)> = Vec::new();
    for (target, site) in sites {
        let first = match target {
            Some(number) => graph.labels(*number).next(),
            None => graph.labels.iter().map(|(_, block)| *block).min(),
        };
        turns.extend(first.filter(|first| first <= site).map(|first| (first, *site)));
    }
    turns.extend(graph.loops.turns());
    turns.extend(graph.o_words.turns());
    turns.sort_unstable();
    // Those that overlap are one.
    turns.dedup_by(|later, earlier| {
        let overlap = later.0 <= earlier.1;
        if overlap {
            earlier.1 = earlier.1.max(later.1);
        }
        overlap
    });
    turns.shrink_to_fit();
    turns
}

/// A list without the same entry twice in a row, for loops of text that repeat one jump.
fn push_new(list: &mut Vec<u32>, entry: u32) {
    if list.last() != Some(&entry) {
        list.push(entry);
    }
}
