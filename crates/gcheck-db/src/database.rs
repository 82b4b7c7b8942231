//! The documents that are open, and what is known of them.
//!
//! Knows: which document is which, when an analysis is stale. Must not know: how rules and engine work.

use std::ops::Range;
use std::sync::Arc;

use gcheck_engine::{Model, Options, Program, flow};
use gcheck_program::{Dialect, Loaded};
use gcheck_rules::{Finding, Job, Ledger, RuleMeta, Scene, Severity, check};
use gcheck_syntax::{Document, OutOfRange};
use rustc_hash::FxHashMap;

use crate::snapshot::Others;
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
    /// Findings in text order, as [`gcheck_rules::check`] gives them.
    pub findings: Vec<Finding>,
    /// Findings beyond the limit, by rule and severity.
    pub omitted: Vec<(&'static RuleMeta, Severity, usize)>,
    /// Findings silenced by comments.
    pub suppressed: usize,
    /// What the analysis of paths took for granted.
    pub ledger: Ledger,
    /// The analysis of paths ended before it had seen all.
    pub out_of_fuel: bool,
}

/// The documents that are open, and what is known of them. One thread owns it.
#[derive(Debug, Default)]
pub struct Database {
    next: u32,
    documents: FxHashMap<DocumentId, Open>,
}

#[derive(Debug)]
struct Open {
    document: Document,
    settings: Settings,
    snapshot: Option<Snapshot>,
    analysis: Option<Arc<Analysis>>,
}

impl Open {
    fn changed(&mut self) {
        self.snapshot = None;
        self.analysis = None;
    }

    fn snapshot(&mut self) -> Snapshot {
        let new = || Snapshot::new(self.document.clone(), self.settings.clone());
        self.snapshot.get_or_insert_with(new).clone()
    }
}

impl Database {
    /// Without documents.
    pub fn new() -> Self {
        Self::default()
    }

    /// Takes a document in.
    pub fn open(&mut self, text: &str, settings: Settings) -> DocumentId {
        let id = DocumentId(self.next);
        self.next += 1;
        let open = Open { document: Document::new(text), settings, snapshot: None, analysis: None };
        self.documents.insert(id, open);
        id
    }

    /// Forgets a document.
    pub fn close(&mut self, id: DocumentId) {
        self.documents.remove(&id);
    }

    /// Replaces the whole text.
    pub fn set_text(&mut self, id: DocumentId, text: &str) {
        if let Some(open) = self.documents.get_mut(&id) {
            open.document = Document::new(text);
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
        open.changed();
        Ok(())
    }

    /// Changes what is in force for a document, or what other programs hold that it may call.
    pub fn set_settings(&mut self, id: DocumentId, settings: Settings) {
        if let Some(open) = self.documents.get_mut(&id) {
            open.settings = settings;
            open.changed();
        }
    }

    /// The document as it is now.
    pub fn snapshot(&mut self, id: DocumentId) -> Option<Snapshot> {
        self.documents.get_mut(&id).map(Open::snapshot)
    }

    /// Findings and the like, up to date. `stop` is asked now and then; when it says yes the work is given up, and what was
    /// done of it is kept where it can be.
    ///
    /// # Errors
    /// [`Cancelled`] when `stop` said yes, or there is no such document.
    pub fn analysis(&mut self, id: DocumentId, stop: &dyn Fn() -> bool) -> Result<Arc<Analysis>, Cancelled> {
        let open = self.documents.get_mut(&id).ok_or(Cancelled)?;
        if let Some(known) = &open.analysis {
            return Ok(Arc::clone(known));
        }
        if stop() {
            return Err(Cancelled);
        }
        let settings = &open.settings;
        let source = gcheck_syntax::SourceText::from(&*open.document.text());
        let dialect = Dialect::new(&settings.control);
        let outcome = check(&Job {
            source: &source,
            scene: Scene {
                dialect: &dialect,
                machine: &settings.machine,
                programs: &*settings.programs,
                control_is_guessed: settings.control_is_guessed,
            },
            selection: &settings.selection,
            suppressions: settings.suppressions,
            execution: settings.execution,
        });
        let analysis = Arc::new(Analysis {
            findings: outcome.findings,
            omitted: outcome.omitted,
            suppressed: outcome.suppressed,
            ledger: outcome.ledger,
            out_of_fuel: outcome.out_of_fuel,
        });
        open.analysis = Some(Arc::clone(&analysis));
        Ok(analysis)
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
        let open = self.documents.get_mut(&id).ok_or(Cancelled)?;
        if stop() {
            return Err(Cancelled);
        }
        let settings = &open.settings;
        let dialect = Dialect::new(&settings.control);
        let model = Model::new(&settings.control);
        let library = Others(settings);
        let loaded = Loaded::new(open.document.text(), &dialect, |_, _, _| ());
        let program = Program::new(loaded, &dialect, &library);
        let mut keeper = Keeper::new(blocks);
        let (machine, fuel) = (&settings.machine.engine, settings.execution.fuel);
        flow(&program, &model, machine, Options::NONE, fuel, &mut keeper);
        Ok(keeper.seen.into_values().collect())
    }
}
