//! Programs on disk beside the open documents, for what looks beyond one file.
//!
//! Knows: which programs can call each other, what of them is loaded. Must not know: what is looked for in them.

use std::collections::BTreeMap;
use std::ops::Range;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::{Duration, Instant};

use gcheck_db::{DocumentId, Settings, Snapshot};
use gcheck_ide::{Place, Workspace, WorkspaceFile};

use super::disk::Loaded;
use super::{Owner, fallback_settings, not_open};
use crate::ProgramFile;
use crate::documents::file_name;
use crate::position::Places;
use crate::proto::{Location, Result, Uri};

/// Programs on disk that are loaded at a time.
const MOST_FILES: usize = 2_000;
/// Bytes of them.
const MOST_BYTES: u64 = 64 << 20;
/// How long a list of files is believed.
const FRESH: Duration = Duration::from_secs(2);

/// What features look at, with the addresses of its files.
#[derive(Debug, Clone)]
pub(crate) struct Addressed {
    pub(crate) workspace: Workspace,
    /// Address of each file, and its version if it is open.
    pub(crate) addresses: BTreeMap<DocumentId, (Uri, Option<i32>)>,
}

impl Addressed {
    /// One open document alone.
    pub(crate) fn of(uri: &Uri, id: DocumentId, version: i32, name: Arc<str>, snapshot: Snapshot) -> Self {
        Self {
            workspace: Workspace::of(WorkspaceFile { id, name, snapshot }),
            addresses: BTreeMap::from([(id, (uri.clone(), Some(version)))]),
        }
    }

    /// The address of a file.
    pub(crate) fn uri(&self, id: DocumentId) -> Option<&Uri> {
        self.addresses.get(&id).map(|(uri, _)| uri)
    }

    /// The file of an address.
    pub(crate) fn id(&self, uri: &Uri) -> Option<DocumentId> {
        self.addresses.iter().find(|(_, (address, _))| address == uri).map(|(id, _)| *id)
    }

    /// The text of a file.
    pub(crate) fn snapshot(&self, id: DocumentId) -> Option<&Snapshot> {
        self.workspace.file(id).map(|file| &file.snapshot)
    }

    /// A place as the client names it.
    pub(crate) fn location(&self, place: &Place, encoding: crate::position::Encoding) -> Option<Location> {
        let mut places = Places::new(self.snapshot(place.file)?, encoding);
        Some(Location::new(self.uri(place.file)?.clone(), places.range(&place.range)))
    }
}

impl Owner {
    /// The programs that a document may call or be called by, itself among them, by path.
    pub(crate) fn workspace_of(&mut self, uri: &Uri) -> Result<Addressed> {
        self.choose_settings(uri);
        let document = self.document(uri)?;
        let own = document.folder().to_owned();
        let mut folders = document.in_force.folders.clone();
        // Who looks for programs in its folder.
        for other in self.documents.values() {
            if other.in_force.folders.contains(&own) {
                folders.push(other.folder().to_owned());
            }
        }
        folders.push(own);
        folders.sort();
        folders.dedup();
        let settings = document.in_force.settings.clone().unwrap_or_else(fallback_settings);
        let mut paths = BTreeMap::new();
        for folder in &folders {
            paths.extend(self.list(folder, false).into_iter().map(|file| (file.path.clone(), file)));
        }
        self.load(paths, &settings, &|path| folders.iter().any(|f| path.parent() == Some(f))).with(self, uri)
    }

    /// All programs of the workspace.
    pub(crate) fn whole_workspace(&mut self) -> Addressed {
        let mut paths = BTreeMap::new();
        for folder in self.folders.clone() {
            paths.extend(self.list(&folder, true).into_iter().map(|file| (file.path.clone(), file)));
        }
        let settings = fallback_settings();
        self.load(paths, &settings, &|_| true)
    }

    /// The programs of a folder on disk, or of it and those below.
    pub(crate) fn list(&mut self, folder: &Path, below: bool) -> Vec<ProgramFile> {
        let key = (folder.to_owned(), below);
        if let Some((at, files)) = self.disk.lists.get(&key)
            && at.elapsed() < FRESH
        {
            return files.clone();
        }
        let host = &self.host.0;
        let files = if below { host.programs_below(folder) } else { host.programs_in(folder) };
        self.disk.lists.insert(key, (Instant::now(), files.clone()));
        files
    }

    /// Loads programs, the open ones as they are in the editor.
    fn load(
        &mut self,
        files: BTreeMap<PathBuf, ProgramFile>,
        settings: &Settings,
        wanted: &dyn Fn(&Path) -> bool,
    ) -> Addressed {
        let mut loaded: BTreeMap<PathBuf, (DocumentId, Uri, Option<i32>)> = BTreeMap::new();
        let open = self.documents.values().filter(|document| document.is_program && wanted(&document.path));
        let open: Vec<Uri> = open.map(|document| document.uri.clone()).collect();
        for uri in open {
            // Nobody may have asked about it since its configuration changed.
            self.choose_settings(&uri);
            let Some(document) = self.documents.get(&uri) else { continue };
            loaded.insert(document.path.clone(), (document.id, uri, Some(document.version)));
        }
        let missing = files.values().filter(|file| !self.disk.files.contains_key(&file.path));
        let (count, bytes) = missing.fold((0, 0), |(count, bytes), file| (count + 1, bytes + file.size));
        // What was loaded for another question takes no room from this one.
        if self.disk.files.len() + count > MOST_FILES || self.disk.bytes() + bytes > MOST_BYTES {
            self.disk.keep(|path| files.contains_key(path), &mut self.database);
        }
        for (path, file) in files {
            if !loaded.contains_key(&path)
                && let Some(id) = self.load_file(&file, settings)
                && let Some(uri) = Uri::from_file_path(&path)
            {
                loaded.insert(path, (id, uri, None));
            }
        }
        let mut workspace = Workspace::default();
        let mut addresses = BTreeMap::new();
        for (path, (id, uri, version)) in loaded {
            // Of an open document all is kept that index and flow graph are made of; a file on disk may never be asked for them.
            let snapshot =
                if version.is_some() { self.database.indexed(id) } else { self.database.snapshot(id) };
            let Some(snapshot) = snapshot else { continue };
            workspace.files.push(WorkspaceFile { id, name: file_name(&path), snapshot });
            addresses.insert(id, (uri, version));
        }
        Addressed { workspace, addresses }
    }

    /// A program on disk as a document; `None` when it cannot be read, or too much is loaded.
    fn load_file(&mut self, file: &ProgramFile, settings: &Settings) -> Option<DocumentId> {
        if let Some(known) = self.disk.files.get_mut(&file.path) {
            if known.stamp == file.stamp {
                // It was loaded for a program that may be for another control.
                if !Arc::ptr_eq(&known.control, &settings.control) {
                    known.control = Arc::clone(&settings.control);
                    self.database.set_settings(known.id, settings.clone());
                }
                return Some(known.id);
            }
            self.disk.forget_file(&file.path, &mut self.database);
        }
        if self.disk.files.len() >= MOST_FILES || self.disk.bytes() + file.size > MOST_BYTES {
            return None;
        }
        let text = self.host.0.read(&file.path)?;
        // Names and comments are shown to people.
        let id = self.database.open(&text.readable(), settings.clone());
        let loaded = Loaded {
            id,
            size: file.size,
            stamp: file.stamp,
            control: Arc::clone(&settings.control),
            widened: text.widened(),
        };
        self.disk.files.insert(file.path.clone(), loaded);
        Some(id)
    }

    /// A place in a file that a finding names by its path.
    pub(crate) fn location_in(&mut self, path: &Path, bytes: &Range<u32>) -> Option<Location> {
        let open = self.documents.values().find(|document| document.path == path);
        let mut bytes = bytes.clone();
        let (id, uri) = match open {
            Some(document) => (document.id, document.uri.clone()),
            None => {
                let uri = Uri::from_file_path(path)?;
                let folder = path.parent()?.to_owned();
                let file = self.list(&folder, false).into_iter().find(|file| file.path == path)?;
                let id = self.load_file(&file, &fallback_settings())?;
                bytes =
                    self.disk.files.get(path).map_or(bytes.clone(), |loaded| loaded.widened.range(&bytes));
                (id, uri)
            }
        };
        let snapshot = self.database.snapshot(id)?;
        let range = self.places(&snapshot).range(&bytes);
        Some(Location::new(uri, range))
    }
}

impl Addressed {
    /// Makes sure that a document is among the files.
    fn with(self, owner: &Owner, uri: &Uri) -> Result<Self> {
        let id = owner.document(uri)?.id;
        if self.workspace.file(id).is_some() { Ok(self) } else { Err(not_open(uri)) }
    }
}
