//! Programs with a cursor, for tests.
//!
//! Knows: how a test writes files and a cursor. Must not know: any feature.

use std::fmt::Write as _;
use std::ops::Range;
use std::sync::Arc;

use gcheck_db::{Analysis, Database, DocumentId, Settings, Snapshot};

use crate::{Edit, FileEdits, Workspace, WorkspaceFile};

/// Files in a database, with a cursor in one of them.
pub(crate) struct Fixture {
    pub(crate) database: Database,
    pub(crate) workspace: Workspace,
    /// The file with the cursor; the first without one.
    pub(crate) document: DocumentId,
    /// The cursor `$0`; 0 without one.
    pub(crate) offset: u32,
}

impl Fixture {
    /// One file, or several of which each begins with a line `//- NAME`.
    pub(crate) fn new(control: &str, text: &str) -> Self {
        Self::with(text, &Settings::new(gcheck_controls::load(control).unwrap(), gcheck_rules::RULES))
    }

    pub(crate) fn with(text: &str, settings: &Settings) -> Self {
        let mut files: Vec<(String, String)> = Vec::new();
        for line in text.split_inclusive('\n') {
            match line.strip_prefix("//- ") {
                Some(name) => files.push((name.trim().to_owned(), String::new())),
                None if files.is_empty() => files.push(("main.nc".to_owned(), line.to_owned())),
                None => files.last_mut().unwrap().1.push_str(line),
            }
        }
        if files.is_empty() {
            files.push(("main.nc".to_owned(), String::new()));
        }
        let mut database = Database::new();
        let mut workspace = Workspace::default();
        let mut cursor = None;
        for (name, text) in files {
            let at = text.find("$0");
            let text = text.replacen("$0", "", 1);
            let id = database.open(&text, settings.clone());
            if let Some(at) = at {
                cursor = Some((id, at as u32));
            }
            let snapshot = database.snapshot(id).unwrap();
            workspace.files.push(WorkspaceFile { id, name: Arc::from(name), snapshot });
        }
        let (document, offset) = cursor.unwrap_or_else(|| (workspace.files.first().unwrap().id, 0));
        Self { database, workspace, document, offset }
    }

    pub(crate) fn snapshot(&self) -> Snapshot {
        self.workspace.file(self.document).unwrap().snapshot.clone()
    }

    pub(crate) fn analysis(&mut self) -> Arc<Analysis> {
        self.database.analysis(self.document, &|| false).unwrap()
    }

    /// `name:line: text`, with the name only where there are several files.
    pub(crate) fn shown(&self, file: DocumentId, range: &Range<u32>) -> String {
        let file = self.workspace.file(file).unwrap();
        let place = shown(&file.snapshot, range);
        if self.workspace.files.len() > 1 { format!("{}:{place}", file.name) } else { place }
    }

    /// The files after edits, without those that stay as they are.
    pub(crate) fn edited(&self, edits: &[FileEdits]) -> String {
        let mut text = String::new();
        for edits in edits {
            let file = self.workspace.file(edits.file).unwrap();
            if self.workspace.files.len() > 1 {
                let _ = writeln!(text, "//- {}", file.name);
            }
            text.push_str(&applied(&file.snapshot.text(), &edits.edits));
        }
        text
    }
}

/// `line: text` with lines from 1.
pub(crate) fn shown(snapshot: &Snapshot, range: &Range<u32>) -> String {
    format!("{}: {}", snapshot.line_at(range.start) + 1, snapshot.slice(range.clone()).replace('\n', "⏎"))
}

/// A text after edits that must not overlap.
pub(crate) fn applied(text: &str, edits: &[Edit]) -> String {
    let mut edits: Vec<&Edit> = edits.iter().collect();
    edits.sort_by_key(|edit| edit.range.start);
    let mut new = String::new();
    let mut at = 0;
    for edit in edits {
        assert!(edit.range.start as usize >= at, "edits overlap: {edit:?}");
        new.push_str(&text[at..edit.range.start as usize]);
        new.push_str(&edit.text);
        at = edit.range.end as usize;
    }
    new + &text[at..]
}
