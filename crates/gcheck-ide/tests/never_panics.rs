//! Every feature at every place of broken programs: no panic, no place outside of the file.
//!
//! Knows: the features by name. Must not know: what they answer.

#![expect(
    clippy::unwrap_used,
    clippy::indexing_slicing,
    reason = "a test that meets the unexpected is to fail"
)]

use std::ops::Range;
use std::sync::Arc;

use gcheck_db::{Database, DocumentId, Settings, Snapshot};
use gcheck_ide::{Edit, InlayOptions, Workspace, WorkspaceFile};
use gcheck_testkit::pieces::PROGRAM_PIECES;
use proptest::prelude::*;

const CONTROLS: [&str; 6] =
    ["haas-mill", "haas-lathe", "fanuc-mill", "fanuc-lathe", "linuxcnc", "generic-mill"];

fn program() -> impl Strategy<Value = String> {
    let piece = prop_oneof![
        8 => proptest::sample::select(PROGRAM_PIECES).prop_map(str::to_owned),
        1 => any::<char>().prop_map(String::from),
    ];
    let end = prop_oneof![3 => Just(""), 2 => Just("\n"), 1 => Just("\r\n"), 1 => Just(" ")];
    proptest::collection::vec((piece, end), 0..60)
        .prop_map(|pieces| pieces.into_iter().map(|(piece, end)| piece + end).collect())
}

struct World {
    database: Database,
    workspace: Workspace,
    main: DocumentId,
}

impl World {
    fn new(control: &str, texts: &[String]) -> Self {
        let settings = Settings::new(gcheck_controls::load(control).unwrap(), gcheck_rules::RULES);
        let mut database = Database::new();
        let mut workspace = Workspace::default();
        for (index, text) in texts.iter().enumerate() {
            let id = database.open(text, settings.clone());
            let name = Arc::from(["main.nc", "probe.ngc", "O9010.nc"][index]);
            workspace.files.push(WorkspaceFile { id, name, snapshot: database.snapshot(id).unwrap() });
        }
        let main = workspace.files[0].id;
        Self { database, workspace, main }
    }

    fn snapshot(&self, id: DocumentId) -> &Snapshot {
        &self.workspace.file(id).unwrap().snapshot
    }

    fn inside(&self, id: DocumentId, range: &Range<u32>) {
        let snapshot = self.snapshot(id);
        let text = snapshot.text();
        assert!(range.start <= range.end, "{range:?}");
        assert!(text.get(range.start as usize..range.end as usize).is_some(), "{range:?} of {text:?}");
    }

    /// Edits lie in the file, on characters, in order and apart.
    fn fit(&self, id: DocumentId, edits: &[Edit]) {
        let mut sorted: Vec<&Edit> = edits.iter().collect();
        sorted.sort_by_key(|edit| (edit.range.start, edit.range.end));
        for edit in &sorted {
            self.inside(id, &edit.range);
        }
        for pair in sorted.windows(2) {
            assert!(pair[0].range.end <= pair[1].range.start, "{pair:?} of {:?}", self.snapshot(id).text());
        }
    }
}

fn nest(world: &World, symbols: &[gcheck_ide::Symbol], around: &Range<u32>) {
    for symbol in symbols {
        world.inside(world.main, &symbol.range);
        assert!(
            around.start <= symbol.range.start && symbol.range.end <= around.end,
            "{symbol:?} in {around:?}"
        );
        assert!(
            symbol.range.start <= symbol.selection.start && symbol.selection.end <= symbol.range.end,
            "{symbol:?}"
        );
        nest(world, &symbol.children, &symbol.range);
    }
}

fn ask_everything(world: &mut World, offset: u32, other: u32, new_name: &str) {
    let go = || false;
    let id = world.main;
    let snapshot = world.snapshot(id).clone();
    let end = snapshot.len();
    let analysis = world.database.analysis(id, &go).unwrap();
    let range = offset.min(other)..offset.max(other);

    for found in gcheck_ide::diagnostics(&analysis, gcheck_ide::ShownRepeats::Folded).list {
        world.inside(id, &found.range);
    }
    let unreachable = gcheck_ide::unreachable_ranges(&analysis);
    if let Some(hover) = gcheck_ide::hover(&mut world.database, id, offset, &go) {
        world.inside(id, &hover.range);
    }
    let trigger = [None, Some('='), Some('G')][offset as usize % 3];
    let items = gcheck_ide::completion(&mut world.database, &world.workspace, id, offset, trigger, &go);
    for item in items {
        world.inside(id, &item.edit.range);
        // An entry takes the place of the word that the cursor is in, which may go on after it.
        let line = snapshot.line_range(snapshot.line_at(offset.min(end)));
        let is_around =
            item.edit.range.start <= end.min(offset) && item.edit.range.end <= line.end.max(offset);
        assert!(is_around, "{item:?} at {offset} of {:?}", snapshot.text());
    }
    let is_asked = offset.is_multiple_of(2);
    let help = gcheck_ide::signature_help(&mut world.database, &world.workspace, id, offset, is_asked, &go);
    for signature in help {
        for word in &signature.parameters {
            assert!(signature.label.get(word.label.start as usize..word.label.end as usize).is_some());
        }
    }
    for target in gcheck_ide::definition(&world.workspace, id, offset) {
        world.inside(target.name.file, &target.name.range);
        world.inside(target.name.file, &target.full);
        world.inside(id, &target.from);
    }
    for reference in gcheck_ide::references(&world.workspace, id, offset, true) {
        world.inside(reference.place.file, &reference.place.range);
    }
    for place in gcheck_ide::highlights(&snapshot, offset) {
        world.inside(id, &place.range);
    }
    if let Ok(target) = gcheck_ide::prepare_rename(&world.workspace, id, offset) {
        world.inside(id, &target.range);
    }
    for edits in gcheck_ide::rename(&world.workspace, id, offset, new_name).unwrap_or_default() {
        world.fit(edits.file, &edits.edits);
    }
    nest(world, &gcheck_ide::document_symbols(&snapshot), &(0..end));
    for symbol in gcheck_ide::workspace_symbols(&world.workspace, new_name) {
        world.inside(symbol.place.file, &symbol.place.range);
    }
    for item in gcheck_ide::call_items(&world.workspace, id, offset) {
        world.inside(item.place.file, &item.range);
        for call in gcheck_ide::incoming_calls(&world.workspace, &item) {
            call.calls.iter().for_each(|range| world.inside(call.from.place.file, range));
        }
        for call in gcheck_ide::outgoing_calls(&world.workspace, &item) {
            call.calls.iter().for_each(|range| world.inside(item.place.file, range));
        }
    }
    for fold in gcheck_ide::folding_ranges(&snapshot) {
        world.inside(id, &fold.range);
    }
    let ranges = gcheck_ide::selection_ranges(&snapshot, offset);
    assert!(ranges.windows(2).all(|pair| pair[1].start <= pair[0].start && pair[0].end <= pair[1].end));
    for of in [None, Some(range.clone())] {
        let tokens = gcheck_ide::semantic_tokens(&snapshot, of, &unreachable);
        for token in &tokens {
            world.inside(id, &token.range);
        }
        assert!(tokens.windows(2).all(|pair| pair[0].range.end <= pair[1].range.start), "{tokens:?}");
    }
    let options = InlayOptions::default();
    for hint in gcheck_ide::inlay_hints(&mut world.database, id, range.clone(), options, &go).unwrap() {
        assert!(hint.offset <= end);
    }
    let statistics = gcheck_ide::run_statistics(&snapshot, None, 500, &|| false).unwrap();
    for lens in gcheck_ide::code_lenses(&snapshot, &statistics) {
        world.inside(id, &lens.range);
    }
    let actions =
        gcheck_ide::code_actions(&mut world.database, id, range.clone(), Some(&analysis), &go).unwrap();
    for action in actions {
        world.fit(id, &action.edits);
    }
    world.fit(id, &gcheck_ide::format(&snapshot, None));
    world.fit(id, &gcheck_ide::format(&snapshot, Some(range)));
    world.fit(id, &gcheck_ide::format_on_type(&snapshot, offset));
    for link in gcheck_ide::document_links(&world.workspace, id) {
        world.inside(id, &link.range);
        world.inside(link.target.file, &link.target.range);
    }
    let _ = gcheck_ide::toolpath(&snapshot, None, 500, 100, &|| false);
    let _ = gcheck_ide::state_at(&mut world.database, id, offset, &go).unwrap();
    let _ = gcheck_ide::syntax_tree(&snapshot, Some(offset));
    let _ = gcheck_ide::syntax_tree(&snapshot, None);
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 40, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn any_feature_at_any_place(
        control in proptest::sample::select(&CONTROLS[..]),
        texts in proptest::collection::vec(program(), 1..=3),
        places in proptest::collection::vec((0..=110_u32, 0..=110_u32), 1..4),
        new_name in proptest::sample::select(&["20", "N30", "#101", "deep", "", "O7", "é", "4294967296"][..]),
    ) {
        let mut world = World::new(control, &texts);
        let len = world.snapshot(world.main).len();
        for (one, other) in places {
            ask_everything(&mut world, len * one / 100, len * other / 100, new_name);
        }
    }
}

#[test]
fn every_place_of_a_program_of_everything() {
    let text = PROGRAM_PIECES.join("\n");
    for control in CONTROLS {
        let mut world = World::new(control, &[text.clone(), PROGRAM_PIECES.join(" "), String::new()]);
        for offset in (0..=text.len() as u32).step_by(101) {
            ask_everything(&mut world, offset, offset + 40, "20");
        }
    }
}
