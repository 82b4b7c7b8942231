//! Checking a file again and again while it is edited, at the cost of what the edits change.
//!
//! Knows: what of a check depends on one chunk, what on the file's skeleton, what on the paths. Must not know: where the facts of
//! chunks are kept (a [`ChunkSource`] does), any rule. What comes out is what [`crate::check`] gives for the same text.

mod anchored;
mod chunk;
mod layout;
mod paths;
mod rule_state;

use std::collections::BTreeSet;
use std::ops::Range;
use std::rc::Rc;
use std::sync::Arc;

use gcheck_controls::{CodeIx, CodeNumber, Evidence, Letter, LetterSet};
use gcheck_engine::{FlowObserver, Look, LookedUp, Model, Options, Program};
use gcheck_program::{
    BlockFlags, ControlFlowGraph, Dialect, EVIDENCE_BYTES, FileIndex, Loaded, Skeleton, TapeMarks, lower,
};

pub use chunk::{ChunkFacts, ChunkFindings};
use layout::{ChunkShape, Layout, Unchanged};
pub use paths::Work;
use paths::{Broken, Inputs, Paths};

use crate::check::{Assumptions, FileNotes, Plan, check_file, conclude, switch_positions};
use crate::collector::{Collector, Omitted};
use crate::containment::without_rules_that_panic;
use crate::environment::ProgramLibrary;
use crate::partitions::Rules;
use crate::{Environment, Execution, Outcome, ProgramText, RuleTable, Selection};

/// Gives the facts of chunks, which it keeps as long as it likes.
pub trait ChunkSource {
    /// Facts of a chunk, by its index; blocks that begin at `end` in its text or behind it are not read.
    fn facts(&self, chunk: usize, end: u32) -> Arc<ChunkFacts>;
    /// Findings of the token and block tiers, likewise.
    fn findings(&self, chunk: usize, end: u32) -> Arc<ChunkFindings>;
    /// How many findings there are, likewise.
    fn counts(&self, chunk: usize, end: u32) -> Arc<Omitted>;
}

/// A file as it is edited, and how it is to be checked.
pub struct EditedFile<'a> {
    /// The chunks of its text, whole lines each.
    pub chunks: &'a [Arc<str>],
    /// Their facts.
    pub source: &'a dyn ChunkSource,
    /// Control, machine, other programs.
    pub environment: Environment<'a>,
    /// The rules that run.
    pub selection: &'a Selection,
    /// Whether comments may silence rules.
    pub suppressions: bool,
    /// How paths are analysed.
    pub execution: Execution,
    /// Asked now and then; yes gives the work up.
    pub stop: &'a dyn Fn() -> bool,
}

/// The work was given up.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Stopped;

/// What is kept between two checks of a file that is edited. Of use only while scene, selection and the rest stay the same.
#[derive(Debug, Default)]
pub struct Incremental {
    layout: Layout,
    paths: Paths,
    looked_up: LookedUp,
    basis: Option<(Basis, Skeleton)>,
    whole: Option<Arc<FileFacts>>,
    /// What the head of the file shows of its control, with the chunks that it was read from.
    evidence: Option<(Vec<Arc<str>>, Rc<Evidence>)>,
    work: Work,
    /// Paths are analysed for people who look at a state: what nobody can know is taken as it most likely is.
    assumes: bool,
}

/// What must be the same, for anything of the analysis of paths to be kept.
#[derive(Debug, PartialEq)]
struct Basis {
    codes: Vec<CodeNumber>,
    letters: LetterSet,
    has_computed_codes: bool,
    has_speed_in_cuts: bool,
    block_deletes: u16,
    has_first_block: bool,
    /// Codes that rely on words which no block before them gives, wherever they stand.
    never_given: BTreeSet<(CodeIx, Letter)>,
    /// Local variables in the order of their first assignments: rules ask which are assigned above a block, on its path or not.
    assigned_locals: Vec<u32>,
}

impl Basis {
    fn of(file_index: &FileIndex, [first_local, last_local]: [u32; 2]) -> Self {
        let mut codes: Vec<CodeNumber> = file_index.codes.iter().map(|(code, _)| *code).collect();
        codes.sort_unstable();
        Self {
            codes,
            letters: file_index.letters,
            has_computed_codes: file_index.has_computed_codes,
            has_speed_in_cuts: file_index.has_speed_in_cuts,
            block_deletes: file_index.block_deletes,
            has_first_block: file_index.first_block.is_some(),
            never_given: file_index
                .never_given
                .iter()
                .map(|missing| (missing.code, missing.letter))
                .collect(),
            assigned_locals: file_index
                .assigned
                .iter()
                .map(|(number, _)| *number)
                .filter(|number| (first_local..=last_local).contains(number))
                .collect(),
        }
    }
}

/// What the file as a whole holds, joined from its chunks.
#[derive(Debug)]
pub struct FileFacts {
    /// Labels, jumps, calls, loops, ends.
    pub file_index: FileIndex,
    /// The control flow as far as the text decides it.
    pub graph: Arc<ControlFlowGraph>,
    /// Where the part ends that the control reads.
    pub region_end: u32,
    /// How many chunks hold some of it.
    pub chunks: usize,
    /// What each of these holds by itself.
    facts: Vec<Arc<ChunkFacts>>,
    flags: Vec<BlockFlags>,
    skeleton: Skeleton,
    /// Offset of each chunk, and the length of the text.
    starts: Vec<u32>,
}

impl FileFacts {
    /// Of the chunks of a text.
    pub fn of_text(chunks: &[Arc<str>], dialect: &Dialect<'_>) -> Self {
        let facts = |chunk: usize, end: u32| {
            Arc::new(ChunkFacts::new(chunks.get(chunk).map_or("", |text| text), end, dialect))
        };
        Self::of_facts(chunks, facts, dialect)
    }

    /// Of the chunks of a text whose facts somebody keeps.
    pub fn of_source(chunks: &[Arc<str>], source: &dyn ChunkSource, dialect: &Dialect<'_>) -> Self {
        Self::of_facts(chunks, |chunk, end| source.facts(chunk, end), dialect)
    }

    fn of_facts(
        chunks: &[Arc<str>],
        facts: impl Fn(usize, u32) -> Arc<ChunkFacts>,
        dialect: &Dialect<'_>,
    ) -> Self {
        let all: Vec<Arc<ChunkFacts>> = (0..chunks.len()).map(|chunk| facts(chunk, u32::MAX)).collect();
        Self::join(chunks, all, facts, dialect, |_, _, _| ())
    }

    /// What a chunk holds by itself; `None` for one that the control does not read.
    pub fn facts(&self, chunk: usize) -> Option<&ChunkFacts> {
        self.facts.get(chunk).map(AsRef::as_ref)
    }

    fn new(edited: &EditedFile<'_>, look: impl FnMut(usize, u32, &ChunkFacts)) -> Result<Self, Stopped> {
        let mut all = Vec::with_capacity(edited.chunks.len());
        for index in 0..edited.chunks.len() {
            if index % 64 == 0 && (edited.stop)() {
                return Err(Stopped);
            }
            all.push(edited.source.facts(index, u32::MAX));
        }
        let facts = |chunk: usize, end: u32| edited.source.facts(chunk, end);
        Ok(Self::join(edited.chunks, all, facts, edited.environment.dialect, look))
    }

    fn join(
        chunks: &[Arc<str>],
        facts: Vec<Arc<ChunkFacts>>,
        of_cut: impl Fn(usize, u32) -> Arc<ChunkFacts>,
        dialect: &Dialect<'_>,
        mut look: impl FnMut(usize, u32, &ChunkFacts),
    ) -> Self {
        let mut at = 0;
        let ends = chunks.iter().map(|chunk| {
            at += chunk.len() as u32;
            at
        });
        let starts: Vec<u32> = std::iter::once(0).chain(ends).collect();
        let tapes = starts.iter().copied().zip(&facts).map(|(base, facts)| (base, facts.tape()));
        let region_end = TapeMarks::region_end(tapes, at);
        let mut file_index = FileIndex::default();
        let mut graph = ControlFlowGraph::builder();
        let mut skeleton = Skeleton::default();
        let mut flags = Vec::with_capacity(facts.len());
        let mut read = Vec::with_capacity(facts.len());
        for (index, ((base, end), mut facts)) in
            starts.iter().copied().zip(starts.iter().skip(1).copied()).zip(facts).enumerate()
        {
            if base < region_end || index == 0 {
                if end > region_end {
                    facts = of_cut(index, region_end - base);
                }
                file_index.join(&facts.file_index, base, dialect);
                graph.add_part(&facts.graph, base);
                skeleton.join(facts.graph.skeleton());
                flags.push(facts.flags);
            }
            look(index, base, &facts);
            if read.len() < flags.len() {
                read.push(facts);
            }
        }
        let chunks = flags.len();
        let graph = Arc::new(graph.finish());
        Self { file_index, graph, region_end, chunks, facts: read, flags, skeleton, starts }
    }

    /// Where the part of a chunk ends that the control reads, in bytes of the chunk; the greatest number for all of it.
    fn end_in(&self, chunk: usize) -> u32 {
        let base = self.starts.get(chunk).copied().unwrap_or(0);
        let end = self.starts.get(chunk + 1).copied().unwrap_or(0);
        if end > self.region_end { self.region_end - base } else { u32::MAX }
    }

    /// Adds what is found in some chunks, each by itself.
    fn check_chunks(&self, edited: &EditedFile<'_>, chunks: Range<usize>, collector: &mut Collector<'_>) {
        for chunk in chunks {
            let end = self.end_in(chunk);
            if collector.is_full() {
                let counts = edited.source.counts(chunk, end);
                for (rule, severity, count) in counts.iter() {
                    collector.omit(rule, severity, count);
                }
                collector.fail(counts.failed());
            } else {
                let base = self.starts.get(chunk).copied().unwrap_or(0);
                edited.source.findings(chunk, end).add_to(collector, base);
            }
        }
    }

    /// How many blocks of a chunk the control reads.
    fn blocks_in(&self, chunk: usize) -> u32 {
        let blocks = self.graph.blocks_of(chunk);
        blocks.end - blocks.start
    }
}

/// A file joined from its chunks, with what beside it is asked once.
struct JoinedFile {
    whole: Arc<FileFacts>,
    /// Comments with directives in what the control reads.
    directives: Vec<Range<u32>>,
    lines: usize,
}

impl JoinedFile {
    /// `known` is the file as it is, if somebody has joined it before.
    fn new(edited: &EditedFile<'_>, known: Option<&Arc<FileFacts>>) -> Result<Self, Stopped> {
        let mut directives = Vec::new();
        let mut lines = 0;
        let mut look = |_: usize, base: u32, facts: &ChunkFacts| {
            lines += facts.lines;
            directives.extend(facts.directives.iter().map(|range| range.start + base..range.end + base));
        };
        let whole = match known {
            Some(known) => {
                for (index, (facts, base)) in known.facts.iter().zip(&known.starts).enumerate() {
                    look(index, *base, facts);
                }
                Arc::clone(known)
            }
            None => Arc::new(FileFacts::new(edited, look)?),
        };
        directives.retain(|range: &Range<u32>| range.start < whole.region_end);
        Ok(Self { whole, directives, lines })
    }
}

impl Incremental {
    /// Nothing is known yet.
    pub fn new() -> Self {
        Self::default()
    }

    /// Nothing is known yet, and the states of paths are for people to look at: a program that is not here changes nothing, and a
    /// probe touches at its target. What is found then is of no use.
    pub fn assuming() -> Self {
        Self { assumes: true, ..Self::default() }
    }

    fn options(&self) -> Options {
        Options { assumes: self.assumes, ..Options::NONE }
    }

    /// How much the last check did.
    pub fn work(&self) -> Work {
        self.work
    }

    /// What the file as a whole holds, as of the last check.
    pub fn whole(&self) -> Option<&Arc<FileFacts>> {
        self.whole.as_ref()
    }

    /// What the file as a whole holds, if these are its chunks as of the last time when paths were analysed or begun to be.
    pub fn whole_of(&self, chunks: &[Arc<str>]) -> Option<&Arc<FileFacts>> {
        // Of chunks that the control does not read nothing is kept.
        let whole = self.whole.as_ref().filter(|whole| whole.chunks == chunks.len())?;
        let (old, new) = self.layout.changed(chunks);
        (old.is_empty() && new.is_empty()).then_some(whole)
    }

    /// Checks the file as it is now. A rule that panics takes only its own findings with it.
    ///
    /// # Errors
    /// [`Stopped`] when `stop` said yes; what was done is kept.
    pub fn check(&mut self, edited: &EditedFile<'_>) -> Result<Outcome, Stopped> {
        self.contained(edited.selection, |known, rules| known.check_with(edited, rules))
    }

    /// Does some work. When a rule panics in it, the work is done again without that rule, and nothing is kept for the next time.
    fn contained(
        &mut self,
        selection: &Selection,
        mut work: impl FnMut(&mut Self, &Selection) -> Result<Outcome, Stopped>,
    ) -> Result<Outcome, Stopped> {
        let mut times = 0;
        let (outcome, failed) = without_rules_that_panic(selection, |rules| {
            if times > 0 {
                *self = Self { assumes: self.assumes, ..Self::default() };
            }
            times += 1;
            work(self, rules)
        });
        if !failed.is_empty() {
            *self = Self { assumes: self.assumes, ..Self::default() };
        }
        let mut outcome = outcome?;
        outcome.note_failed(failed);
        Ok(outcome)
    }

    fn check_with(&mut self, edited: &EditedFile<'_>, rules: &Selection) -> Result<Outcome, Stopped> {
        let plan = Plan::new(rules);
        let JoinedFile { whole, directives, lines } = JoinedFile::new(edited, self.whole_of(edited.chunks))?;
        let mut collector = Collector::new(edited.environment);
        whole.check_chunks(edited, 0..whole.chunks, &mut collector);
        // The head of a large file is as it was most of the time.
        let is_head = |(base, _): &(&u32, &Arc<str>)| **base <= EVIDENCE_BYTES as u32;
        let head: Vec<Arc<str>> =
            whole.starts.iter().zip(edited.chunks).take_while(is_head).map(|(_, c)| Arc::clone(c)).collect();
        let mut text = ProgramText::chunks(edited.chunks);
        if let Some((known, evidence)) = self.evidence.take()
            && known.len() == head.len()
            && known.iter().zip(&head).all(|(own, other)| Arc::ptr_eq(own, other))
        {
            text = text.with_evidence(evidence);
        }
        check_file(edited.environment, &plan, &text, 0..whole.region_end, &whole.file_index, &mut collector);
        self.whole = Some(Arc::clone(&whole));
        let (assumptions, out_of_fuel) = self.check_paths(edited, &plan, &whole, u32::MAX, &mut collector)?;
        let notes = FileNotes { suppressions: edited.suppressions, directives: &directives, lines };
        let mut outcome = conclude(&plan, &text, &whole.file_index, collector, &notes);
        self.evidence = text.into_evidence().map(|evidence| (head, evidence));
        outcome.assumptions = assumptions;
        outcome.out_of_fuel = out_of_fuel;
        Ok(outcome)
    }

    /// Checks the first chunks of the file, ahead of the rest: what is found there by rules that see a chunk, or a path as far as
    /// to a block that nothing leads back over. Later text cannot take it back; what [`Incremental::check`] gives holds all of it,
    /// unless there are too many findings to keep.
    ///
    /// # Errors
    /// [`Stopped`] when `stop` said yes; what was done is kept.
    pub fn check_first(&mut self, edited: &EditedFile<'_>, chunks: usize) -> Result<Outcome, Stopped> {
        self.contained(edited.selection, |known, rules| known.check_first_with(edited, rules, chunks))
    }

    fn check_first_with(
        &mut self,
        edited: &EditedFile<'_>,
        rules: &Selection,
        chunks: usize,
    ) -> Result<Outcome, Stopped> {
        let JoinedFile { whole, directives, lines } = JoinedFile::new(edited, self.whole_of(edited.chunks))?;
        // Which suppressions are of no use is known at the end.
        let plan = Plan::new(rules).without_suppressions();
        let mut collector = Collector::new(edited.environment);
        let chunks = chunks.min(whole.chunks);
        whole.check_chunks(edited, 0..chunks, &mut collector);
        let text = ProgramText::chunks(edited.chunks);
        self.whole = Some(Arc::clone(&whole));
        let end = whole.graph.blocks_of(chunks).start;
        let (assumptions, _) = self.check_paths(edited, &plan, &whole, end, &mut collector)?;
        let notes = FileNotes { suppressions: edited.suppressions, directives: &directives, lines };
        Ok(Outcome { assumptions, ..conclude(&plan, &text, &whole.file_index, collector, &notes) })
    }

    /// Adds what the analysis of paths finds; from the first checkpoint at block `enough` or behind it on it may be left for the
    /// next time.
    fn check_paths(
        &mut self,
        edited: &EditedFile<'_>,
        plan: &Plan,
        whole: &FileFacts,
        enough: u32,
        collector: &mut Collector<'_>,
    ) -> Result<(Assumptions, bool), Stopped> {
        self.work = Work::default();
        if plan.path.is_empty() {
            return Ok((Assumptions::new(), false));
        }
        let locals = edited.environment.control().semantics().locals;
        let same = (Basis::of(&whole.file_index, locals), whole.skeleton);
        let is_same =
            self.basis.as_ref().is_some_and(|(known, skeleton)| *known == same.0 && skeleton.is_as(&same.1));
        let texts = edited.chunks.get(..whole.chunks).unwrap_or_default();
        if !is_same || self.paths.is_unsure() || !self.lay_out(texts, whole, edited.environment.dialect) {
            self.begin_anew(texts, whole);
        }
        self.basis = Some(same);
        let library = ProgramLibrary(edited.environment.programs);
        let model = Model::new(edited.environment.control());
        let switches = switch_positions(edited.execution.block_skip, whole.file_index.block_deletes);
        let mark = collector.mark();
        loop {
            let files = self.looked_up.files();
            let known = std::mem::take(&mut self.looked_up);
            let loaded = Loaded::of_chunks(
                texts.to_vec(),
                whole.flags.clone(),
                whole.region_end,
                Arc::clone(&whole.graph),
            );
            let program = Program::with(loaded, edited.environment.dialect, &library, known);
            let inputs = Inputs {
                environment: edited.environment,
                program: &program,
                model: &model,
                file_index: &whole.file_index,
                rules: Rules { table: plan.table, active: &plan.path },
                fuel: edited.execution.work(&program),
                layout: &self.layout,
                options: self.options(),
                stop: edited.stop,
                enough,
            };
            let mut work = Work::default();
            collector.rewind(&mark);
            let done = self.paths.update(&inputs, &switches, collector, &mut work);
            self.looked_up = program.into_looked_up();
            self.work.executed += work.executed;
            self.work.kept = work.kept;
            self.work.from_the_start += work.from_the_start;
            // Files get their numbers in the order in which calls bring them in.
            let new_files = self.looked_up.files() > files && work.kept > 0;
            match done {
                Err(Broken::Stopped) => return Err(Stopped),
                Err(Broken::Enough) => return Ok((Assumptions::new(), false)),
                Ok(result) if !new_files => return Ok(result),
                // What was kept is used up by this, so that it happens once.
                Ok(_) | Err(Broken::Useless) => self.begin_anew(texts, whole),
            }
        }
    }

    /// Forgets what was analysed.
    fn begin_anew(&mut self, texts: &[Arc<str>], whole: &FileFacts) {
        self.paths = Paths::default();
        self.looked_up = LookedUp::default();
        self.layout = Layout::default();
        self.layout.replace(0..0, shapes(texts, whole, 0..texts.len()), Unchanged::default());
    }

    /// Follows the text to where it is now. `false` when that leads nowhere.
    fn lay_out(&mut self, texts: &[Arc<str>], whole: &FileFacts, dialect: &Dialect<'_>) -> bool {
        let (old, new) = self.layout.changed(texts);
        let is_as_before = |chunk: usize, of: usize| self.layout.has_blocks(of, whole.blocks_in(chunk));
        let behind = texts.len() - new.end;
        let all_as_before = (0..new.start).all(|chunk| is_as_before(chunk, chunk))
            && (0..behind).all(|back| is_as_before(new.end + back, old.end + back));
        // Slots are never used again; now and then it starts from the beginning.
        if !all_as_before || self.layout.slots() > 64 * (self.layout.len() + 4096) {
            return false;
        }
        if old.is_empty() && new.is_empty() {
            return true;
        }
        let (old, new) = self.widened(old, new);
        let before = self.layout.text_of(old.clone());
        let now: String = texts.get(new.clone()).unwrap_or_default().iter().map(AsRef::as_ref).collect();
        let is_cut = new.clone().any(|chunk| whole.end_in(chunk) != u32::MAX);
        let same = unchanged(&before, &now, is_cut, dialect);
        let flags = whole.flags.get(new.clone()).unwrap_or_default();
        self.paths.note_flags(flags.iter().fold(BlockFlags::empty(), |all, flags| all | *flags));
        self.layout.replace(old, shapes(texts, whole, new), same);
        true
    }

    /// The changed chunks with as many beside them as it takes to begin with one whose blocks were read: who came through the
    /// place where something was put in read that.
    fn widened(&self, mut old: Range<usize>, mut new: Range<usize>) -> (Range<usize>, Range<usize>) {
        let is_read = |chunk: usize| !self.layout.has_blocks(chunk, 0);
        while old.start > 0 && (old.is_empty() || !is_read(old.start)) {
            old.start -= 1;
            new.start -= 1;
        }
        while old.end < self.layout.len() && !old.clone().any(is_read) {
            old.end += 1;
            new.end += 1;
        }
        (old, new)
    }

    /// Executes again what came by any of some blocks of the main file, with every switch of block delete off, and shows it to
    /// an observer, then hands the observer on with what can look into the states that it was shown. `false` when not enough is
    /// known of the paths of the text as it is.
    pub fn show_again<O: FlowObserver>(
        &mut self,
        edited: &EditedFile<'_>,
        blocks: &Range<u32>,
        observer: &mut O,
        then: impl FnOnce(&mut O, &mut Look<'_, '_>),
    ) -> bool {
        let Some(whole) = self.whole.clone() else { return false };
        let texts = edited.chunks.get(..whole.chunks).unwrap_or_default();
        let (old, new) = self.layout.changed(texts);
        if !old.is_empty() || !new.is_empty() {
            return false;
        }
        let library = ProgramLibrary(edited.environment.programs);
        let model = Model::new(edited.environment.control());
        let known = std::mem::take(&mut self.looked_up);
        let loaded = Loaded::of_chunks(
            texts.to_vec(),
            whole.flags.clone(),
            whole.region_end,
            Arc::clone(&whole.graph),
        );
        let program = Program::with(loaded, edited.environment.dialect, &library, known);
        let inputs = Inputs {
            environment: edited.environment,
            program: &program,
            model: &model,
            file_index: &whole.file_index,
            rules: Rules { table: RuleTable::EMPTY, active: &[] },
            fuel: edited.execution.work(&program),
            layout: &self.layout,
            options: self.options(),
            stop: edited.stop,
            enough: u32::MAX,
        };
        let machine = &edited.environment.machine.engine;
        let shown = self.paths.show_again(&inputs, machine, blocks, observer);
        if shown {
            then(observer, &mut Look::with(&program, &model, machine, self.options()));
        }
        self.looked_up = program.into_looked_up();
        shown
    }
}

fn shapes(texts: &[Arc<str>], whole: &FileFacts, chunks: Range<usize>) -> Vec<ChunkShape> {
    let shape = |chunk: usize| {
        Some(ChunkShape { text: Arc::clone(texts.get(chunk)?), blocks: whole.blocks_in(chunk) })
    };
    chunks.filter_map(shape).collect()
}

/// What two texts have in common at their ends. When the second `is_cut` its last blocks are not all read.
fn unchanged(before: &str, now: &str, is_cut: bool, dialect: &Dialect<'_>) -> Unchanged {
    let same = |pair: &(u8, u8)| pair.0 == pair.1;
    let start = before.bytes().zip(now.bytes()).take_while(same).count();
    let most = before.len().min(now.len()) - start;
    let end = before.bytes().rev().zip(now.bytes().rev()).take(most).take_while(same).count();
    // FileFacts lines of both. A `\r` at the very end may have a `\n` behind it in one of them.
    let is_end = |byte: &u8| matches!(byte, b'\n' | b'\r');
    let bytes = now.as_bytes();
    let mut lines = bytes.get(..start).unwrap_or_default();
    if let [rest @ .., b'\r'] = lines {
        lines = rest;
    }
    let lines = lines.iter().rposition(is_end).map_or(0, |at| at + 1);
    let starts_line = |text: &[u8], at: usize| match at.checked_sub(1).and_then(|before| text.get(before)) {
        None | Some(b'\n') => true,
        Some(b'\r') => text.get(at) != Some(&b'\n'),
        Some(_) => false,
    };
    let tail = now.len() - end;
    let behind = if starts_line(bytes, tail) && starts_line(before.as_bytes(), before.len() - end) {
        tail
    } else {
        tail + gcheck_syntax::line_len(bytes.get(tail..).unwrap_or_default())
    };
    let blocks = |text: Option<&str>| text.map_or(0, |text| lower(text, dialect).len() as u32);
    Unchanged {
        bytes_before: start as u32,
        bytes_behind: end as u32,
        blocks_before: blocks(now.get(..lines)),
        blocks_behind: if is_cut { 0 } else { blocks(now.get(behind..)) },
    }
}
