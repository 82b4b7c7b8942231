//! What is known of each chunk, as salsa keeps it.
//!
//! Of a chunk that an edit made the lossless tree is kept, the blocks are made of the tree, and facts and findings of the blocks.
//! Chunks of a text that was just opened go from tokens to blocks: a tree for each of them would cost more than all of their
//! findings. Both ways give the same blocks (law 2).
//!
//! Knows: which facts depend on a chunk alone, and on which settings. Must not know: where in a file a chunk is, what is
//! made of the facts of all chunks.

use std::fmt;
use std::sync::Arc;

use gcheck_lint::{ChunkFacts, ChunkFindings, ChunkSource, Environment, Omitted};
use gcheck_program::{BlockTable, Dialect, lower_tree};
use gcheck_syntax::{Parse, parse};
use rustc_hash::FxHashMap;
use salsa::Setter;

use crate::Settings;

/// Salsa's storage, and the log of what it does.
#[salsa::db]
#[derive(Clone)]
pub(crate) struct Storage {
    storage: salsa::Storage<Self>,
}

#[salsa::db]
impl salsa::Database for Storage {}

impl fmt::Debug for Storage {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Storage").finish_non_exhaustive()
    }
}

/// Is called with the name of each query that is executed.
pub(crate) type Told = Box<dyn Fn(&str) + Send + Sync>;

impl Storage {
    /// `told` is called with the name of each query that is executed.
    pub(crate) fn new(told: Option<Told>) -> Self {
        let told = told.map(|told| -> Box<dyn Fn(salsa::Event) + Send + Sync> {
            Box::new(move |event: salsa::Event| {
                if let salsa::EventKind::WillExecute { database_key } = event.kind {
                    told(&format!("{database_key:?}"));
                }
            })
        });
        Self { storage: salsa::Storage::new(told) }
    }
}

/// What is in force for a document.
#[salsa::input(debug)]
pub(crate) struct InForce {
    #[returns(ref)]
    pub(crate) settings: Settings,
}

/// A chunk of a document.
#[salsa::input(debug)]
pub(crate) struct Chunk {
    #[returns(ref)]
    pub(crate) text: Arc<str>,
    #[returns(copy)]
    pub(crate) origin: Origin,
    #[returns(copy)]
    pub(crate) in_force: InForce,
}

/// Where the text of a chunk comes from.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub(crate) enum Origin {
    /// The text was opened, or an edit made more chunks than somebody types.
    Opened,
    /// Somebody works here: more questions about the chunk will come.
    Edited,
}

/// An edit that makes more chunks than this is as good as another text; a whole text of fewer is read as edited.
const MOST_EDITED: usize = 16;

/// The lossless tree.
#[salsa::tracked(returns(clone), no_eq, lru = 16)]
fn tree(db: &dyn salsa::Database, chunk: Chunk) -> Arc<Parse> {
    let settings = chunk.in_force(db).settings(db);
    Arc::new(parse(chunk.text(db), Dialect::new(&settings.control).profile()))
}

/// The blocks that the tree holds.
#[salsa::tracked(returns(clone), no_eq, lru = 16)]
fn blocks(db: &dyn salsa::Database, chunk: Chunk) -> Arc<BlockTable> {
    let settings = chunk.in_force(db).settings(db);
    Arc::new(lower_tree(&tree(db, chunk), chunk.text(db), &Dialect::new(&settings.control)))
}

/// What the chunk gives to the file as a whole.
#[salsa::tracked(returns(clone), no_eq)]
fn facts(db: &dyn salsa::Database, chunk: Chunk) -> Arc<ChunkFacts> {
    let settings = chunk.in_force(db).settings(db);
    let dialect = Dialect::new(&settings.control);
    let text = chunk.text(db);
    Arc::new(match chunk.origin(db) {
        Origin::Opened => ChunkFacts::new(text, u32::MAX, &dialect),
        Origin::Edited => ChunkFacts::of_blocks(&blocks(db, chunk), text, u32::MAX, &dialect),
    })
}

/// Findings of the token and block tiers. They are kept for so many chunks; those of others are made again when they are
/// asked for.
#[salsa::tracked(returns(clone), no_eq, lru = 4096)]
fn findings(db: &dyn salsa::Database, chunk: Chunk) -> Arc<ChunkFindings> {
    let settings = chunk.in_force(db).settings(db);
    let dialect = Dialect::new(&settings.control);
    let (text, environment) = (chunk.text(db), environment(settings, &dialect));
    Arc::new(match chunk.origin(db) {
        Origin::Opened => ChunkFindings::new(text, u32::MAX, environment, &settings.selection),
        Origin::Edited => {
            ChunkFindings::of_blocks(&blocks(db, chunk), text, u32::MAX, environment, &settings.selection)
        }
    })
}

/// How many findings there are.
#[salsa::tracked(returns(clone), no_eq)]
fn counts(db: &dyn salsa::Database, chunk: Chunk) -> Arc<Omitted> {
    Arc::new(findings(db, chunk).counts())
}

/// The chunks of one document as salsa knows them.
#[derive(Debug)]
pub(crate) struct Chunks {
    in_force: InForce,
    /// In text order, each with the text that it had when it was looked up last.
    known: Vec<(Arc<str>, Chunk)>,
    /// Inputs without use: salsa forgets none, so they are given to new chunks.
    free: Vec<Chunk>,
}

impl Chunks {
    pub(crate) fn new(storage: &Storage, settings: Settings) -> Self {
        Self { in_force: InForce::new(storage, settings), known: Vec::new(), free: Vec::new() }
    }

    pub(crate) fn set_settings(&self, storage: &mut Storage, settings: Settings) {
        self.in_force.set_settings(storage).to(settings);
    }

    /// The document is gone.
    pub(crate) fn empty(&mut self, storage: &mut Storage) {
        let nothing: Arc<str> = Arc::from("");
        for chunk in self.known.drain(..).map(|(_, chunk)| chunk).chain(self.free.drain(..)) {
            chunk.set_text(storage).to(Arc::clone(&nothing));
            if chunk.origin(storage) == Origin::Edited {
                tree(storage, chunk);
                blocks(storage, chunk);
            }
            facts(storage, chunk);
            findings(storage, chunk);
        }
    }

    /// Tree and blocks of a chunk that an edit made; `None` for another one, and when the chunks do not follow the text yet.
    pub(crate) fn of_edited(
        &self,
        storage: &Storage,
        index: usize,
        text: &Arc<str>,
    ) -> Option<(Arc<Parse>, Arc<BlockTable>)> {
        let (known, chunk) = self.known.get(index)?;
        let is_edited = Arc::ptr_eq(known, text) && chunk.origin(storage) == Origin::Edited;
        is_edited.then(|| (tree(storage, *chunk), blocks(storage, *chunk)))
    }

    /// Follows the text: chunks that are shared with what was known stay what they are.
    pub(crate) fn follow(&mut self, storage: &mut Storage, texts: &[Arc<str>]) {
        let same = |(known, text): &(&(Arc<str>, Chunk), &Arc<str>)| Arc::ptr_eq(&known.0, text);
        let before = self.known.iter().zip(texts).take_while(same).count();
        let most = self.known.len().min(texts.len()) - before;
        let pairs = self.known.iter().rev().zip(texts.iter().rev()).take(most);
        let behind = pairs.take_while(same).count();
        let (old, new) = (before..self.known.len() - behind, before..texts.len() - behind);
        // An edit here and one there leave most of what is between.
        let mut between: FxHashMap<*const u8, Chunk> = FxHashMap::default();
        for (text, chunk) in self.known.get(old.clone()).unwrap_or_default() {
            if let Some(twice) = between.insert(text.as_ptr(), *chunk) {
                self.free.push(twice);
            }
        }
        let mut missing = Vec::new();
        let mut next = Vec::with_capacity(new.len());
        for text in texts.get(new).unwrap_or_default() {
            let chunk = between.remove(&text.as_ptr());
            if chunk.is_none() {
                missing.push(next.len());
            }
            next.push((Arc::clone(text), chunk));
        }
        self.free.extend(between.into_values());
        let is_edit = !self.known.is_empty() && missing.len() <= MOST_EDITED;
        let origin = if is_edit { Origin::Edited } else { Origin::Opened };
        for index in missing {
            let Some((text, slot)) = next.get_mut(index) else { continue };
            *slot = Some(match self.free.pop() {
                Some(chunk) => {
                    chunk.set_text(storage).to(Arc::clone(text));
                    chunk.set_origin(storage).to(origin);
                    chunk
                }
                None => Chunk::new(storage, Arc::clone(text), origin, self.in_force),
            });
        }
        self.known.splice(old, next.into_iter().filter_map(|(text, chunk)| Some((text, chunk?))));
    }
}

/// Chunks and the storage that knows them, for one check.
pub(crate) struct Asking<'s> {
    pub(crate) storage: &'s Storage,
    pub(crate) chunks: &'s Chunks,
}

impl Asking<'_> {
    fn chunk(&self, chunk: usize, end: u32) -> Option<Chunk> {
        self.chunks.known.get(chunk).map(|(_, chunk)| *chunk).filter(|_| end == u32::MAX)
    }

    /// The one chunk in which the control stops reading is read again each time.
    fn cut<T>(&self, chunk: usize, make: impl FnOnce(&str, Environment<'_>, &Settings) -> T) -> T {
        let settings = self.chunks.in_force.settings(self.storage);
        let dialect = Dialect::new(&settings.control);
        let text = self.chunks.known.get(chunk).map_or("", |(text, _)| text);
        make(text, environment(settings, &dialect), settings)
    }
}

/// What rules may ask under these settings.
pub(crate) fn environment<'s>(settings: &'s Settings, dialect: &'s Dialect<'s>) -> Environment<'s> {
    Environment {
        dialect,
        machine: &settings.machine,
        programs: &*settings.programs,
        control_basis: settings.control_basis,
        unsupported: settings.unsupported,
    }
}

impl ChunkSource for Asking<'_> {
    fn facts(&self, chunk: usize, end: u32) -> Arc<ChunkFacts> {
        match self.chunk(chunk, end) {
            Some(chunk) => facts(self.storage, chunk),
            None => self
                .cut(chunk, |text, environment, _| Arc::new(ChunkFacts::new(text, end, environment.dialect))),
        }
    }

    fn findings(&self, chunk: usize, end: u32) -> Arc<ChunkFindings> {
        match self.chunk(chunk, end) {
            Some(chunk) => findings(self.storage, chunk),
            None => self.cut(chunk, |text, environment, settings| {
                Arc::new(ChunkFindings::new(text, end, environment, &settings.selection))
            }),
        }
    }

    fn counts(&self, chunk: usize, end: u32) -> Arc<Omitted> {
        match self.chunk(chunk, end) {
            Some(chunk) => counts(self.storage, chunk),
            None => Arc::new(self.findings(chunk, end).counts()),
        }
    }
}
