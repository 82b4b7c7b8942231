//! Documents that are open in the editor.
//!
//! Knows: which document is which, what of it is stale. Must not know: how anything about it is worked out.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Arc, PoisonError, RwLock};

use gcheck_db::{DocumentId, Snapshot};
use gcheck_ide::{Caller, RunStatistics};

use crate::proto::Uri;
use crate::{InForce, OpenPrograms};

/// A document that is open in the editor.
#[derive(Debug)]
pub(crate) struct Document {
    pub(crate) uri: Uri,
    pub(crate) id: DocumentId,
    /// Names it as long as it is open.
    pub(crate) number: u64,
    /// Where it is on disk, or would be.
    pub(crate) path: PathBuf,
    /// It is a program, not a configuration that some editors open with us as well.
    pub(crate) is_program: bool,
    pub(crate) version: i32,
    /// What is in force, as the host said last.
    pub(crate) in_force: InForce,
    /// What the host says must be asked again: the head of the text has changed, or something beyond it.
    pub(crate) stale: Stale,
    /// What it may call, since its settings were chosen.
    pub(crate) callees: Callees,
    /// Changes with everything that findings depend on.
    pub(crate) clock: Clock,
    /// The user wants to see findings of the text as it is: it was opened, saved, or is analysed while it is typed.
    pub(crate) wants_findings: bool,
    /// It was changed since it was opened or saved.
    pub(crate) is_edited: bool,
    /// The clock when findings were published last.
    pub(crate) published: Option<u64>,
    /// The clock when findings of its first lines were worked out ahead of the rest.
    pub(crate) looked_ahead: Option<u64>,
    /// How often the analysis was given up for a question since it last came to its end.
    pub(crate) given_up: u32,
    /// The clock when its analysis met a mistake of our own: it is not tried again with the same text.
    pub(crate) failed: Option<u64>,
    /// The clock when its analysis used up its time: it is not tried again with the same text.
    pub(crate) too_long: Option<u64>,
    /// What its run amounted to.
    pub(crate) figures: Option<Figures>,
    /// The run for its figures that is under way.
    pub(crate) run: StatisticsRun,
    /// When it was changed last, compared with others.
    pub(crate) touched: u64,
}

/// What a run of a document amounted to.
#[derive(Debug)]
pub(crate) struct Figures {
    /// The clock of the document then.
    pub(crate) at: u64,
    /// The call whose arguments it had.
    pub(crate) caller: Option<Caller>,
    pub(crate) statistics: Arc<RunStatistics>,
}

/// Is a run for the figures of a document under way?
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum StatisticsRun {
    /// No.
    Idle,
    /// Yes.
    UnderWay,
    /// Yes, of a text that has changed since; figures of the new one were asked for.
    AskedAgain,
}

/// What of a document's settings has to be asked for again.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Stale {
    /// Nothing.
    No,
    /// What it may call has changed; its settings are as they were.
    Callees,
    /// Its head has changed, which may choose another control.
    Head,
    /// Configuration or files have changed.
    Settings,
}

/// The programs that a document may call.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Callees {
    /// As they were.
    Kept,
    /// Other ones, or with other texts.
    Changed,
}

/// A number that changes with a document, and that work elsewhere can look at.
#[derive(Debug, Clone, Default)]
pub(crate) struct Clock(Arc<AtomicU64>);

impl Clock {
    pub(crate) fn now(&self) -> u64 {
        self.0.load(Ordering::Acquire)
    }

    pub(crate) fn tick(&self) {
        self.0.fetch_add(1, Ordering::AcqRel);
    }
}

impl Document {
    /// Its file's name without folders.
    pub(crate) fn name(&self) -> Arc<str> {
        file_name(&self.path)
    }

    /// The folder it is in.
    pub(crate) fn folder(&self) -> &Path {
        self.path.parent().unwrap_or(&self.path)
    }

    /// Was the analysis of the text as it is given up, because it took too long?
    pub(crate) fn took_too_long(&self) -> bool {
        self.too_long == Some(self.clock.now())
    }

    /// Something changed that its findings depend on.
    pub(crate) fn changed(&mut self, stale: Stale) {
        if stale == Stale::Callees {
            self.callees = Callees::Changed;
        }
        self.stale = self.stale.max(stale);
        self.clock.tick();
    }
}

/// Is a document a program? A text in TOML is a configuration: ours, or nothing that concerns us.
pub(crate) fn is_program(language: &str, path: &Path) -> bool {
    let is_toml = path.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("toml"));
    !is_toml && !language.eq_ignore_ascii_case("toml")
}

/// A file's name without folders.
pub(crate) fn file_name(path: &Path) -> Arc<str> {
    path.file_name().map(|name| name.to_string_lossy()).unwrap_or_default().into()
}

/// The texts of open documents, for the host, which asks from other threads too.
#[derive(Debug, Default)]
pub(crate) struct OpenTexts {
    /// Counts texts. A document that is opened again counts on: who keeps what it found in one text must not take it for another's.
    texts: AtomicU64,
    by_path: RwLock<BTreeMap<PathBuf, (u64, Snapshot)>>,
}

impl OpenTexts {
    /// Takes the text of a document.
    pub(crate) fn put(&self, path: &Path, snapshot: Snapshot) {
        let number = self.texts.fetch_add(1, Ordering::AcqRel);
        let mut texts = self.by_path.write().unwrap_or_else(PoisonError::into_inner);
        texts.insert(path.to_owned(), (number, snapshot));
    }

    pub(crate) fn remove(&self, path: &Path) {
        self.by_path.write().unwrap_or_else(PoisonError::into_inner).remove(path);
    }
}

impl OpenPrograms for OpenTexts {
    fn text(&self, path: &Path) -> Option<String> {
        let texts = self.by_path.read().unwrap_or_else(PoisonError::into_inner);
        texts.get(path).map(|(_, snapshot)| snapshot.text())
    }

    fn in_folder(&self, folder: &Path) -> Vec<(PathBuf, u64)> {
        let texts = self.by_path.read().unwrap_or_else(PoisonError::into_inner);
        let there = texts.iter().filter(|(path, _)| path.parent() == Some(folder));
        there.map(|(path, (number, _))| (path.clone(), *number)).collect()
    }
}
