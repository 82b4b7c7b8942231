//! The shipped programs as people meet them in an editor: typed character by character, a list that opens meanwhile never
//! changes what was typed, even in an editor that takes its first entry at Enter; hovered at each word, the answer is short.
//!
//! Knows: when editors open and close a list, how they break lines. Must not know: what is on a list or in an answer.

#![expect(clippy::unwrap_used, reason = "a test that meets the unexpected is to fail")]

use std::fs;
use std::path::Path;
use std::sync::Arc;

use gcheck_db::{Database, DocumentId, Settings};
use gcheck_ide::{
    COMPLETION_TRIGGERS, Completion, Workspace, WorkspaceFile, completion, hover, signature_help,
};

/// The shipped programs, by control.
const PROGRAMS: [(&str, &[&str]); 6] = [
    (
        "haas-mill",
        &[
            "clean/haas-mill/blade.nc",
            "clean/haas-mill/bracket.nc",
            "clean/haas-mill/manifold.nc",
            "clean/haas-mill/sleeve.nc",
            "tour/bracket.nc",
            "tour/bore.nc",
            "tour/impeller.nc",
            "tour/sleeve.nc",
        ],
    ),
    (
        "haas-lathe",
        &["clean/haas-lathe/bushing.nc", "clean/haas-lathe/pin.nc", "tour/bushing.nc", "tour/pin.nc"],
    ),
    ("fanuc-mill", &["clean/fanuc-mill/cover.nc", "clean/fanuc-mill/flange.nc", "tour/manifold.nc"]),
    ("fanuc-lathe", &["clean/fanuc-lathe/shaft.nc", "tour/shaft.nc"]),
    (
        "linuxcnc",
        &[
            "clean/linuxcnc/plate.ngc",
            "clean/linuxcnc/probe.ngc",
            "clean/linuxcnc/spool.ngc",
            "tour/probe-grid.ngc",
        ],
    ),
    ("generic-mill", &["clean/generic-mill/guide.nc", "tour/plate.nc"]),
];

/// A program that is being typed at its end.
struct Typed {
    database: Database,
    id: DocumentId,
    text: String,
}

impl Typed {
    fn new(control: &str) -> Self {
        let mut database = Database::new();
        let id =
            database.open("", Settings::new(gcheck_controls::load(control).unwrap(), gcheck_rules::RULES));
        Self { database, id, text: String::new() }
    }

    fn key(&mut self, key: char) {
        let at = self.text.len() as u32;
        self.text.push(key);
        self.database.edit(self.id, at..at, &key.to_string()).unwrap();
    }

    fn workspace(&mut self) -> Workspace {
        let snapshot = self.database.snapshot(self.id).unwrap();
        Workspace { files: vec![WorkspaceFile { id: self.id, name: Arc::from("typed.nc"), snapshot }] }
    }

    fn list(&mut self, trigger: Option<char>) -> Vec<Completion> {
        let workspace = self.workspace();
        let at = self.text.len() as u32;
        completion(&mut self.database, &workspace, self.id, at, trigger, &|| false)
    }

    fn has_signatures(&mut self) -> bool {
        let workspace = self.workspace();
        let at = self.text.len() as u32;
        !signature_help(&mut self.database, &workspace, self.id, at, false, &|| false).is_empty()
    }

    /// Types a program; complains of each Enter at which the first entry would change the text, and of help on an empty line.
    fn check(&mut self, name: &str, program: &str) {
        let mut open: Vec<Completion> = Vec::new();
        for key in program.chars() {
            if key == '\n'
                && let Some(first) = open.first()
            {
                let place = first.edit.range.start as usize..first.edit.range.end as usize;
                let line = self.text.lines().last().unwrap_or_default();
                assert_eq!(first.edit.text, self.text[place], "{name}: Enter after {line} takes {first:?}");
            }
            self.key(key);
            let is_trigger = COMPLETION_TRIGGERS.contains(&key.to_string().as_str());
            open = if is_trigger {
                self.list(Some(key))
            } else if key.is_ascii_alphanumeric() || key == '.' || key == '_' {
                self.list(None)
            } else {
                Vec::new()
            };
            if key == '\n' {
                assert!(!self.has_signatures(), "{name}: help stays after {}", self.text);
            }
        }
    }
}

#[test]
fn enter_changes_nothing_whatever_is_typed() {
    let fixtures = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../fixtures");
    for (control, names) in PROGRAMS {
        for name in names {
            let program = fs::read_to_string(fixtures.join(name)).unwrap();
            Typed::new(control).check(name, &program);
        }
    }
}

/// Lines of a hover that still let people see the program.
const MOST_LINES: usize = 10;

#[test]
fn a_hover_fits_in_ten_lines_and_has_the_state_on_top() {
    let fixtures = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../fixtures");
    for (control, names) in PROGRAMS {
        for name in names {
            let program = fs::read_to_string(fixtures.join(name)).unwrap();
            let mut typed = Typed::new(control);
            typed.database.edit(typed.id, 0..0, &program).unwrap();
            for at in 0..program.len() as u32 {
                let Some(found) = hover(&mut typed.database, typed.id, at, &|| false) else {
                    continue;
                };
                // Rules and the line under a table's head take no line.
                let is_line = |line: &&str| {
                    !line.trim().is_empty() && !line.starts_with("---") && !line.starts_with("|--")
                };
                let lines = found.markdown.lines().filter(is_line).count();
                assert!(lines <= MOST_LINES, "{name}: {lines} lines at {at}\n{}", found.markdown);
            }
        }
    }
}

#[test]
fn a_blank_opens_no_list() {
    assert!(!COMPLETION_TRIGGERS.contains(&" "));
}

#[test]
fn a_number_opens_no_list() {
    for line in ["G00 X1", "G00 X1.5", "G01 F300.", "#100=1", "#100=[2", "S5000", "N10", "M98 P", "Q100"] {
        let mut typed = Typed::new("fanuc-mill");
        for key in line.chars() {
            typed.key(key);
        }
        assert_eq!(typed.list(None), [], "{line}");
    }
}
