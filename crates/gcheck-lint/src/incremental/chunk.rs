//! What one chunk gives by itself, whatever is around it.
//!
//! Knows: the tiers that see a block or less, what index and flow graph collect. Must not know: where in the file the chunk is,
//! other chunks.

use std::ops::Range;

use gcheck_diagnostics::Finding;
use gcheck_program::{BlockFlags, BlockTable, ChunkFlow, Dialect, FileIndex, TapeMarks, lower};

use super::anchored::moved_on;
use crate::check::{Plan, check_blocks, count_lines};
use crate::collector::{Collector, Omitted};
use crate::containment::without_rules_that_panic;
use crate::{Environment, Selection};

/// The facts of a chunk that the file as a whole is asked about. Every offset counts from the chunk's start.
#[derive(Debug)]
pub struct ChunkFacts {
    pub(crate) file_index: FileIndex,
    pub(crate) graph: ChunkFlow,
    pub(crate) tape: TapeMarks,
    pub(crate) flags: BlockFlags,
    pub(crate) directives: Vec<Range<u32>>,
    pub(crate) lines: usize,
}

impl ChunkFacts {
    /// Of a chunk's text; blocks that begin at `end` or after it are not read by the control.
    pub fn new(text: &str, end: u32, dialect: &Dialect<'_>) -> Self {
        Self::of_blocks(&lower(text, dialect), text, end, dialect)
    }

    /// Of the blocks that were made of a chunk's text.
    pub fn of_blocks(table: &BlockTable, text: &str, end: u32, dialect: &Dialect<'_>) -> Self {
        Self {
            file_index: FileIndex::of_chunk(table, end, dialect),
            graph: ChunkFlow::new(table, end, text, dialect),
            tape: TapeMarks::new(text),
            flags: table.flags(),
            directives: table.directives().to_vec(),
            lines: count_lines(text.as_bytes()),
        }
    }

    /// Labels, codes and the like.
    pub fn file_index(&self) -> &FileIndex {
        &self.file_index
    }

    /// Facts for the flow graph.
    pub fn flow(&self) -> &ChunkFlow {
        &self.graph
    }

    /// What its blocks have, all together.
    pub fn flags(&self) -> BlockFlags {
        self.flags
    }

    /// Where the tape marks are.
    pub fn tape(&self) -> &TapeMarks {
        &self.tape
    }
}

/// Findings of the token and block tiers in a chunk. Every offset counts from the chunk's start.
#[derive(Debug)]
pub struct ChunkFindings {
    findings: Vec<Finding>,
    omitted: Omitted,
}

impl ChunkFindings {
    /// Of a chunk's text; blocks that begin at `end` or after it are not read by the control.
    pub fn new(text: &str, end: u32, environment: Environment<'_>, selection: &Selection) -> Self {
        Self::of_blocks(&lower(text, environment.dialect), text, end, environment, selection)
    }

    /// Of the blocks that were made of a chunk's text.
    pub fn of_blocks(
        table: &BlockTable,
        text: &str,
        end: u32,
        environment: Environment<'_>,
        selection: &Selection,
    ) -> Self {
        let ((findings, mut omitted), failed) = without_rules_that_panic(selection, |rules| {
            let mut collector = Collector::new(environment);
            check_blocks(environment, &Plan::new(rules), end, 0, table, text, &mut collector);
            collector.into_parts()
        });
        omitted.fail(&failed);
        Self { findings, omitted }
    }

    /// How many there are, by rule and severity, in the order in which each comes up first.
    pub fn counts(&self) -> Omitted {
        let mut counts = Omitted::default();
        for finding in &self.findings {
            counts.add(finding.rule, finding.severity, 1);
        }
        for (rule, severity, count) in self.omitted.iter() {
            counts.add(rule, severity, count);
        }
        counts.fail(self.omitted.failed());
        counts
    }

    pub(crate) fn add_to(&self, collector: &mut Collector<'_>, base: u32) {
        for finding in &self.findings {
            if collector.is_full() {
                collector.omit(finding.rule, finding.severity, 1);
            } else {
                collector.keep(moved_on(finding, base));
            }
        }
        for (rule, severity, count) in self.omitted.iter() {
            collector.omit(rule, severity, count);
        }
        collector.fail(self.omitted.failed());
    }
}
