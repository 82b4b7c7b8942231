//! The documents that are open, and what is known of them.
//!
//! Knows: which document is which, when an analysis is stale. Must not know: how rules and engine work.

use std::ops::Range;
use std::sync::Arc;

use gcheck_diagnostics::{Finding, RuleMeta, Severity};
use gcheck_engine::{Assumption, Look, Options, Task, flow};
use gcheck_lint::{Assumptions, EditedFile, FileFacts, Incremental, Outcome, Work};
use gcheck_program::Dialect;
use gcheck_syntax::{Document, OutOfRange};
use rustc_hash::FxHashMap;

use crate::chunks::{Asking, Chunks, Storage, environment};
use crate::snapshot::LineEnds;
use crate::states::Keeper;
use crate::{Settings, Snapshot, StateAt};

/// A document of the database.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct DocumentId(u32);

/// The work was given up because somebody asked for it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Cancelled;

/// What is known of a document.
#[derive(Debug, Default)]
pub struct Analysis {
    /// Findings in text order, as [`gcheck_lint::check`] gives them.
    pub findings: Vec<Finding>,
    /// Findings beyond the limit, by rule and severity.
    pub omitted: Vec<(&'static RuleMeta, Severity, usize)>,
    /// Findings silenced by comments.
    pub suppressed: usize,
    /// What the analysis of paths took for granted.
    pub assumptions: Assumptions,
    /// The analysis of paths ended before it had seen all.
    pub out_of_fuel: bool,
    /// Rules that panicked, by id: whatever they found is left out.
    pub failed: Vec<&'static RuleMeta>,
}

impl Analysis {
    fn of(outcome: Outcome) -> Self {
        let Outcome { findings, omitted, suppressed, assumptions, out_of_fuel, failed, lines: _ } = outcome;
        Self { findings, omitted, suppressed, assumptions, out_of_fuel, failed }
    }
}

/// The documents that are open, and what is known of them. One thread owns it.
#[derive(Debug)]
pub struct Database {
    next: u32,
    documents: FxHashMap<DocumentId, Open>,
    storage: Storage,
}

#[derive(Debug)]
struct Open {
    document: Document,
    settings: Settings,
    /// Where the last edit begins.
    edited: Option<u32>,
    snapshot: Option<Snapshot>,
    line_ends: LineEnds,
    analysis: Option<Arc<Analysis>>,
    chunks: Chunks,
    incremental: Incremental,
    /// The same paths for people who look at a state, where the program calls others that are not here, or probes.
    looked_at: Incremental,
    /// The last analysis, of the whole or of its first part, came by such a call or a probe.
    has_unknowns: bool,
}

impl Open {
    fn changed(&mut self) {
        self.snapshot = None;
        self.analysis = None;
    }

    /// What is in force has changed: nothing holds but the chunks.
    fn forget(&mut self) {
        self.changed();
        self.incremental = Incremental::new();
        self.looked_at = Incremental::assuming();
        self.has_unknowns = false;
    }

    fn snapshot(&mut self) -> Snapshot {
        let whole = self.analysis.as_ref().and_then(|_| self.incremental.whole().cloned());
        let new = || Snapshot::new(self.document.clone(), self.settings.clone(), whole, &mut self.line_ends);
        self.snapshot.get_or_insert_with(new).clone()
    }

    fn indexed(&mut self, storage: &mut Storage) -> Snapshot {
        let is_new = self.snapshot.is_none();
        let snapshot = self.snapshot();
        let is_new = is_new || !snapshot.is_outlined();
        if !snapshot.is_outlined() {
            let known = self.incremental.whole_of(self.document.chunks()).cloned();
            snapshot.outline_by(known.unwrap_or_else(|| {
                self.chunks.follow(storage, self.document.chunks());
                let source = Asking { storage, chunks: &self.chunks };
                let dialect = Dialect::new(&self.settings.control);
                Arc::new(FileFacts::of_source(self.document.chunks(), &source, &dialect))
            }));
        }
        if is_new {
            self.hand_on_edited(storage, &snapshot);
        }
        snapshot
    }

    /// People look where they edit, and the queries about that chunk have its tree and blocks.
    fn hand_on_edited(&self, storage: &Storage, snapshot: &Snapshot) {
        let Some(index) = self.edited.and_then(|at| snapshot.chunk_at(at)).map(|chunk| chunk.index) else {
            return;
        };
        let Some(text) = self.document.chunks().get(index) else { return };
        if let Some((tree, table)) = self.chunks.of_edited(storage, index, text) {
            snapshot.has_read(index, tree, table);
        }
    }

    /// Hands on the states before and after some blocks from what is kept of the paths. `false` when too little is.
    fn show(
        &mut self,
        storage: &Storage,
        blocks: &Range<u32>,
        stop: &dyn Fn() -> bool,
        with: &mut dyn FnMut(&StateAt, &mut Look<'_, '_>),
    ) -> bool {
        let dialect = Dialect::new(&self.settings.control);
        let source = Asking { storage, chunks: &self.chunks };
        let edited = edited(&self.document, &self.settings, &dialect, &source, stop);
        let mut keeper = Keeper::new(blocks.clone(), self.has_unknowns);
        let known = if self.has_unknowns {
            // What is kept of an earlier text is taken up, as in any check.
            if self.looked_at.check(&edited).is_err() {
                return true;
            }
            &mut self.looked_at
        } else {
            &mut self.incremental
        };
        known.show_again(&edited, &keeper.executed(), &mut keeper, |keeper, look| {
            keeper.hand_on(look, stop, with);
        })
    }

    /// The same by an analysis of its own: the one that is kept had no path rules, or the switches of block delete are on for
    /// good.
    fn show_anew(
        &mut self,
        blocks: Range<u32>,
        stop: &dyn Fn() -> bool,
        with: &mut dyn FnMut(&StateAt, &mut Look<'_, '_>),
    ) {
        let snapshot = self.snapshot();
        let (machine, fuel) = (&self.settings.machine.engine, self.settings.execution.fuel);
        let options = Options { assumes: true, ..Options::NONE };
        snapshot.with_program(|program, model| {
            let mut keeper = Keeper::new(blocks, false);
            let task = Task { options, ..Task::all_paths(fuel) };
            let result = flow(program, model, machine, task, &mut keeper);
            let is_assumed = result.assumptions.iter().any(is_unknown);
            keeper.seen.values_mut().for_each(|state| state.is_assumed = is_assumed);
            keeper.hand_on(&mut Look::with(program, model, machine, options), stop, with);
        });
    }

    fn analyse(
        &mut self,
        storage: &mut Storage,
        stop: &dyn Fn() -> bool,
    ) -> Result<Arc<Analysis>, Cancelled> {
        if let Some(known) = &self.analysis {
            return Ok(Arc::clone(known));
        }
        if stop() {
            return Err(Cancelled);
        }
        self.chunks.follow(storage, self.document.chunks());
        let dialect = Dialect::new(&self.settings.control);
        let source = Asking { storage, chunks: &self.chunks };
        let edited = edited(&self.document, &self.settings, &dialect, &source, stop);
        let outcome = self.incremental.check(&edited).map_err(|_| Cancelled)?;
        self.has_unknowns = outcome.assumptions.iter().any(is_unknown);
        let analysis = Arc::new(Analysis::of(outcome));
        self.analysis = Some(Arc::clone(&analysis));
        // One that was taken before would have to find out for itself what is known now.
        self.snapshot = None;
        Ok(analysis)
    }
}

/// Does a state stay known after this only where it is assumed to?
fn is_unknown(assumption: &Assumption) -> bool {
    matches!(
        assumption,
        Assumption::MissingProgram(_) | Assumption::MissingSubroutine(_) | Assumption::ProbeTouch
    )
}

fn edited<'a>(
    document: &'a Document,
    settings: &'a Settings,
    dialect: &'a Dialect<'a>,
    source: &'a Asking<'a>,
    stop: &'a dyn Fn() -> bool,
) -> EditedFile<'a> {
    EditedFile {
        chunks: document.chunks(),
        source,
        environment: environment(settings, dialect),
        selection: &settings.selection,
        suppressions: settings.suppressions,
        execution: settings.execution,
        stop,
    }
}

impl Default for Database {
    fn default() -> Self {
        Self::new()
    }
}

impl Database {
    /// Without documents.
    pub fn new() -> Self {
        Self { next: 0, documents: FxHashMap::default(), storage: Storage::new(None) }
    }

    /// As [`Database::new`]; `told` is called with the name of each query about a chunk that is executed.
    pub fn telling(told: impl Fn(&str) + Send + Sync + 'static) -> Self {
        Self { storage: Storage::new(Some(Box::new(told))), ..Self::new() }
    }

    /// Takes a document in.
    pub fn open(&mut self, text: &str, settings: Settings) -> DocumentId {
        let id = DocumentId(self.next);
        self.next += 1;
        let chunks = Chunks::new(&self.storage, settings.clone());
        let document = Document::new(text);
        let incremental = Incremental::new();
        let open = Open {
            document,
            settings,
            edited: None,
            snapshot: None,
            line_ends: LineEnds::default(),
            analysis: None,
            chunks,
            incremental,
            looked_at: Incremental::assuming(),
            has_unknowns: false,
        };
        self.documents.insert(id, open);
        id
    }

    /// Forgets a document.
    pub fn close(&mut self, id: DocumentId) {
        if let Some(mut open) = self.documents.remove(&id) {
            // Salsa keeps its inputs; without text they hold next to nothing.
            open.chunks.empty(&mut self.storage);
        }
    }

    /// Replaces the whole text.
    pub fn set_text(&mut self, id: DocumentId, text: &str) {
        if let Some(open) = self.documents.get_mut(&id) {
            open.document = Document::new(text);
            open.edited = None;
            open.changed();
        }
    }

    /// Replaces a range of bytes.
    ///
    /// # Errors
    /// [`OutOfRange`], and nothing is changed, when the range does not lie in the text on character boundaries, or there is
    /// no such document.
    pub fn edit(&mut self, id: DocumentId, range: Range<u32>, insert: &str) -> Result<(), OutOfRange> {
        let open = self.documents.get_mut(&id).ok_or(OutOfRange)?;
        open.document.edit(range.start as usize..range.end as usize, insert)?;
        open.edited = Some(range.start);
        open.changed();
        Ok(())
    }

    /// Changes what is in force for a document, or what other programs hold that it may call.
    pub fn set_settings(&mut self, id: DocumentId, settings: Settings) {
        if let Some(open) = self.documents.get_mut(&id) {
            open.chunks.set_settings(&mut self.storage, settings.clone());
            open.settings = settings;
            open.forget();
        }
    }

    /// The document as it is now.
    pub fn snapshot(&mut self, id: DocumentId) -> Option<Snapshot> {
        self.documents.get_mut(&id).map(Open::snapshot)
    }

    /// The document as it is now, with index and flow graph joined from what is kept of its chunks: after an edit they cost the
    /// chunks that it changed, where a [`Database::snapshot`] reads the whole text when it is asked for them.
    pub fn indexed(&mut self, id: DocumentId) -> Option<Snapshot> {
        let open = self.documents.get_mut(&id)?;
        Some(open.indexed(&mut self.storage))
    }

    /// Findings and the like, up to date. `stop` is asked now and then; when it says yes the work is given up, and what was
    /// done of it is kept where it can be.
    ///
    /// # Errors
    /// [`Cancelled`] when `stop` said yes, or there is no such document.
    pub fn analysis(&mut self, id: DocumentId, stop: &dyn Fn() -> bool) -> Result<Arc<Analysis>, Cancelled> {
        let open = self.documents.get_mut(&id).ok_or(Cancelled)?;
        open.analyse(&mut self.storage, stop)
    }

    /// Some findings of the first lines of a document, as many chunks as it takes to have so many bytes, before the rest is looked
    /// at by more than it takes: those that the rest cannot take back. `None` when the document is no longer, or all is known.
    ///
    /// # Errors
    /// As [`Database::analysis`].
    pub fn first_findings(
        &mut self,
        id: DocumentId,
        bytes: usize,
        stop: &dyn Fn() -> bool,
    ) -> Result<Option<Analysis>, Cancelled> {
        let open = self.documents.get_mut(&id).ok_or(Cancelled)?;
        let mut seen = 0;
        let is_missing = |chunk: &&Arc<str>| {
            let is_missing = seen < bytes;
            seen += chunk.len();
            is_missing
        };
        let chunks = open.document.chunks().iter().take_while(is_missing).count();
        if open.analysis.is_some() || chunks == open.document.chunks().len() {
            return Ok(None);
        }
        if stop() {
            return Err(Cancelled);
        }
        open.chunks.follow(&mut self.storage, open.document.chunks());
        let dialect = Dialect::new(&open.settings.control);
        let source = Asking { storage: &self.storage, chunks: &open.chunks };
        let edited = edited(&open.document, &open.settings, &dialect, &source, stop);
        let outcome = open.incremental.check_first(&edited, chunks).map_err(|_| Cancelled)?;
        open.has_unknowns |= outcome.assumptions.iter().any(is_unknown);
        Ok(Some(Analysis::of(outcome)))
    }

    /// How much of the paths the last analysis executed, and how much it did not.
    pub fn work(&self, id: DocumentId) -> Option<Work> {
        self.documents.get(&id).map(|open| open.incremental.work())
    }

    /// What may be the state before and after each of some blocks, in their order, with the block delete switches off;
    /// blocks that no path comes to are left out.
    ///
    /// # Errors
    /// As [`Database::analysis`].
    pub fn states(
        &mut self,
        id: DocumentId,
        blocks: Range<u32>,
        stop: &dyn Fn() -> bool,
    ) -> Result<Vec<StateAt>, Cancelled> {
        let mut states = Vec::new();
        self.look(id, blocks, stop, &mut |state, _| states.push(state.clone()))?;
        Ok(states)
    }

    /// Hands each of [`Database::states`] on with what can look into it: values of expressions and variables, what a block
    /// would do.
    ///
    /// # Errors
    /// As [`Database::analysis`].
    pub fn look(
        &mut self,
        id: DocumentId,
        blocks: Range<u32>,
        stop: &dyn Fn() -> bool,
        with: &mut dyn FnMut(&StateAt, &mut Look<'_, '_>),
    ) -> Result<(), Cancelled> {
        let open = self.documents.get_mut(&id).ok_or(Cancelled)?;
        // Of a document that was just opened the first part may be known, and be all that is asked for.
        let is_shown = open.analysis.is_none() && open.show(&self.storage, &blocks, stop, with);
        if !is_shown {
            open.analyse(&mut self.storage, stop)?;
            if !open.show(&self.storage, &blocks, stop, with) {
                open.show_anew(blocks, stop, with);
            }
        }
        if stop() { Err(Cancelled) } else { Ok(()) }
    }
}
