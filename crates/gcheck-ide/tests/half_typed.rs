//! Cycles as they are typed: after each key of each cycle of each control, an editor still gets its answers.
//!
//! Knows: how a block grows key by key inside a program. Must not know: what any answer says.

#![expect(clippy::unwrap_used, reason = "a test that meets the unexpected is to fail")]

use std::fmt::Write as _;
use std::sync::Arc;

use gcheck_controls::{Code, Control, Effect, Letter};
use gcheck_db::{Database, DocumentId, Settings};
use gcheck_engine::Role;
use gcheck_ide::{MAX_SEGMENTS, Workspace, WorkspaceFile};

/// Blocks that a run may take; a program here has a dozen, and a profile turns a few times.
const FUEL: u64 = 20_000;

/// A program in which a block is typed.
struct World {
    database: Database,
    id: DocumentId,
}

impl World {
    fn new(control: &Arc<Control>, text: &str) -> Self {
        let mut database = Database::new();
        let id = database.open(text, Settings::new(Arc::clone(control), gcheck_rules::RULES));
        Self { database, id }
    }

    /// Moves of the picture; that it comes to the program's end is checked.
    fn moves(&mut self, what: &str) -> u64 {
        let snapshot = self.database.snapshot(self.id).unwrap();
        let path = gcheck_ide::toolpath(&snapshot, None, FUEL, MAX_SEGMENTS, &|| false).unwrap();
        assert_eq!(path.stopped, None, "{what}: the picture ends before the program");
        path.moves
    }

    /// Asks all that an editor asks while the block that starts at `start` is typed up to `cursor`.
    fn ask(&mut self, start: u32, cursor: u32, code: &str, what: &str) {
        let go = || false;
        let snapshot = self.database.snapshot(self.id).unwrap();
        let workspace =
            Workspace { files: vec![WorkspaceFile { id: self.id, name: Arc::from("typed.nc"), snapshot }] };
        let typed = (cursor - start) as usize;
        for at in [start, cursor] {
            let hover = gcheck_ide::hover(&mut self.database, self.id, at, &go);
            assert!(hover.is_some() || typed < code.len() || at > start, "{what}: the block has no hover");
        }
        let list = gcheck_ide::completion(&mut self.database, &workspace, self.id, cursor, None, &go);
        let is_code_begun = typed > 0 && typed < code.len() && code.starts_with(['G', 'M']);
        assert!(!list.is_empty() || !is_code_begun, "{what}: the list is empty");
        for is_asked in [false, true] {
            let help =
                gcheck_ide::signature_help(&mut self.database, &workspace, self.id, cursor, is_asked, &go);
            assert!(help.iter().all(|signature| !signature.label.is_empty()), "{what}: help says nothing");
        }
        let view = gcheck_ide::state_at(&mut self.database, self.id, start, &go).unwrap();
        assert!(view.is_some(), "{what}: the block has no state");
    }
}

fn is_cycle(code: Code<'_>) -> bool {
    let of_drilling = Role::of(code.effect()) == Some(Role::Cycle);
    let title = code.entry().title.to_lowercase();
    code.effect() != Effect::CycleCancel
        && (of_drilling || title.contains("cycle") || title.contains("pocket"))
}

/// Types the block of a code key by key. The rest of the program is always drawn.
fn check(control: &Arc<Control>, code: Code<'_>) {
    let entry = code.entry();
    let mut before = "O1\n".to_owned();
    for line in &entry.setup {
        let _ = writeln!(before, "{line}");
    }
    let cancel = control.codes().find(|code| code.effect() == Effect::CycleCancel);
    let cancel = cancel.map(|code| format!("{}\n", code.entry().code)).unwrap_or_default();
    let middle = if control.axes().contains(Letter::of('Y')) { "Y30. " } else { "" };
    let after = format!("\n{cancel}G0 X40. {middle}Z40.\nM30\n");
    let mut world = World::new(control, &format!("{before}{after}"));
    let rest = world.moves(control.name());
    assert!(rest > 0, "{} {}: the program moves without the cycle", control.name(), entry.code);
    let start = before.len() as u32;
    let mut cursor = start;
    for key in entry.example.chars() {
        let at = cursor;
        cursor += key.len_utf8() as u32;
        world.database.edit(world.id, at..at, &key.to_string()).unwrap();
        let typed: String = entry.example.chars().take((cursor - start) as usize).collect();
        let what = format!("{}: `{typed}`", control.name());
        world.ask(start, cursor, &entry.code, &what);
        let moves = world.moves(&what);
        assert!(moves >= rest, "{what}: {moves} of {rest} moves are left");
    }
}

#[test]
fn each_key_of_each_cycle_leaves_hover_list_help_state_and_picture() {
    let controls: Vec<Arc<Control>> =
        gcheck_controls::names().iter().map(|name| gcheck_controls::load(name).unwrap()).collect();
    let checked: usize = std::thread::scope(|scope| {
        let halves = controls.chunks(controls.len().div_ceil(2));
        let running: Vec<_> =
            halves.map(|controls| scope.spawn(|| controls.iter().map(check_cycles).sum::<usize>())).collect();
        running.into_iter().map(|half| half.join().unwrap()).sum::<usize>()
    });
    assert!(checked > 100, "{checked} cycles");
}

/// Checks the cycles of a control, and counts them.
fn check_cycles(control: &Arc<Control>) -> usize {
    let cycles: Vec<_> = control.codes().filter(|code| is_cycle(*code)).collect();
    for code in &cycles {
        check(control, *code);
    }
    cycles.len()
}
