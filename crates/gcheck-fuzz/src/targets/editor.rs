//! Every editor feature at some place of a program: no place outside of the file, edits that fit.
//!
//! Knows: the features by name. Must not know: what they answer.

use std::ops::Range;
use std::sync::Arc;

use gcheck_db::{Database, DocumentId, Settings};
use gcheck_ide::{Edit, InlayOptions, Workspace, WorkspaceFile};

use crate::choices::Choices;
use crate::programs;

pub(crate) fn run(bytes: &[u8]) {
    let mut choices = Choices::new(bytes);
    let places = [choices.byte(), choices.byte()];
    let new_name = choices.text(&["20", "N30", "#101", "deep", "", "O7", "é", "4294967296"]);
    let neighbour = choices.take(64);
    let case = programs::case(choices.rest());
    let mut settings = Settings::new(Arc::new(case.control.clone()), gcheck_rules::RULES);
    settings.execution.fuel = super::WORK;
    let mut database = Database::new();
    let mut workspace = Workspace::default();
    let other = programs::text(case.control, &mut Choices::new(neighbour));
    for (name, text) in [("main.nc", &case.text), ("O9010.nc", &other)] {
        let id = database.open(text, settings.clone());
        let Some(snapshot) = database.snapshot(id) else { panic!("an open document has a snapshot") };
        workspace.files.push(WorkspaceFile { id, name: Arc::from(name), snapshot });
    }
    let Some(main) = workspace.files.first().map(|file| file.id) else { return };
    let [one, two] = places.map(|place| (case.text.len() * usize::from(place) / 255) as u32);
    World { database, workspace, main }.ask(one.min(two), one.max(two), new_name);
}

struct World {
    database: Database,
    workspace: Workspace,
    main: DocumentId,
}

impl World {
    fn inside(&self, id: DocumentId, range: &Range<u32>) {
        let Some(file) = self.workspace.file(id) else { panic!("an answer names a file that is not there") };
        let text = file.snapshot.text();
        assert!(text.get(range.start as usize..range.end as usize).is_some(), "{range:?} is not in the file");
    }

    fn fit(&self, id: DocumentId, edits: &[Edit]) {
        let mut ranges: Vec<&Range<u32>> = edits.iter().map(|edit| &edit.range).collect();
        ranges.sort_by_key(|range| (range.start, range.end));
        for range in &ranges {
            self.inside(id, range);
        }
        for (one, next) in ranges.iter().zip(ranges.iter().skip(1)) {
            assert!(one.end <= next.start, "{one:?} and {next:?} overlap");
        }
    }

    fn ask(&mut self, offset: u32, other: u32, new_name: &str) {
        let go = || false;
        let id = self.main;
        let Some(snapshot) = self.workspace.file(id).map(|file| file.snapshot.clone()) else { return };
        let Ok(analysis) = self.database.analysis(id, &go) else { panic!("nobody cancelled the analysis") };
        for found in gcheck_ide::diagnostics(&analysis, gcheck_ide::ShownRepeats::Folded).list {
            self.inside(id, &found.range);
        }
        if let Some(hover) = gcheck_ide::hover(&mut self.database, id, offset, &go) {
            self.inside(id, &hover.range);
        }
        for item in gcheck_ide::completion(&mut self.database, &self.workspace, id, offset, None, &go) {
            self.inside(id, &item.edit.range);
        }
        let _ = gcheck_ide::signature_help(&mut self.database, &self.workspace, id, offset, true, &go);
        for target in gcheck_ide::definition(&self.workspace, id, offset) {
            self.inside(target.name.file, &target.name.range);
        }
        for reference in gcheck_ide::references(&self.workspace, id, offset, true) {
            self.inside(reference.place.file, &reference.place.range);
        }
        for edits in gcheck_ide::rename(&self.workspace, id, offset, new_name).unwrap_or_default() {
            self.fit(edits.file, &edits.edits);
        }
        for item in gcheck_ide::call_items(&self.workspace, id, offset) {
            let _ = gcheck_ide::incoming_calls(&self.workspace, &item);
            let _ = gcheck_ide::outgoing_calls(&self.workspace, &item);
        }
        for fold in gcheck_ide::folding_ranges(&snapshot) {
            self.inside(id, &fold.range);
        }
        let _ = gcheck_ide::document_symbols(&snapshot);
        let _ = gcheck_ide::selection_ranges(&snapshot, offset);
        let tokens = gcheck_ide::semantic_tokens(&snapshot, None, &gcheck_ide::unreachable_ranges(&analysis));
        for (one, next) in tokens.iter().zip(tokens.iter().skip(1)) {
            assert!(one.range.end <= next.range.start, "tokens follow each other");
        }
        let range = offset..other;
        let _ = gcheck_ide::inlay_hints(&mut self.database, id, range.clone(), InlayOptions::default(), &go);
        if let Ok(figures) = gcheck_ide::run_statistics(&snapshot, None, 500, &go) {
            for lens in gcheck_ide::code_lenses(&snapshot, &figures) {
                self.inside(id, &lens.range);
            }
        }
        for action in gcheck_ide::code_actions(&mut self.database, id, range.clone(), Some(&analysis), &go)
            .unwrap_or_default()
        {
            self.fit(id, &action.edits);
        }
        self.fit(id, &gcheck_ide::format(&snapshot, Some(range)));
        self.fit(id, &gcheck_ide::format_on_type(&snapshot, offset));
        let _ = gcheck_ide::toolpath(&snapshot, None, 500, 100, &go);
        let _ = gcheck_ide::state_at(&mut self.database, id, offset, &go);
    }
}
