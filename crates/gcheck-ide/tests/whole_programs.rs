//! The shipped programs as people meet them in an editor: typed character by character, a list that opens meanwhile never
//! changes what was typed, even in an editor that takes its first entry at Enter; hovered at each word, the answer is short.
//!
//! Knows: when editors open and close a list, how they break lines. Must not know: what is on a list or in an answer.

#![expect(clippy::unwrap_used, reason = "a test that meets the unexpected is to fail")]

use std::fs;
use std::path::{Path, PathBuf};
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

/// Complains of a hover that people cannot take in at a glance.
fn check_hover(typed: &mut Typed, name: &str, at: u32) -> bool {
    let Some(found) = hover(&mut typed.database, typed.id, at, &|| false) else { return false };
    // Rules and the line under a table's head take no line.
    let is_line =
        |line: &&str| !line.trim().is_empty() && !line.starts_with("---") && !line.starts_with("|--");
    let lines = found.markdown.lines().filter(is_line).count();
    assert!(lines <= MOST_LINES, "{name}: {lines} lines at {at}\n{}", found.markdown);
    true
}

#[test]
fn a_hover_fits_in_ten_lines_and_has_the_state_on_top() {
    let fixtures = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../fixtures");
    for (control, names) in PROGRAMS {
        for name in names {
            let program = fs::read_to_string(fixtures.join(name)).unwrap();
            let mut typed = Typed::new(control);
            typed.database.edit(typed.id, 0..0, &program).unwrap();
            for at in 0..program.len() as u32 {
                check_hover(&mut typed, name, at);
            }
        }
    }
}

/// The programs below a folder.
fn programs_below(folder: &Path, found: &mut Vec<PathBuf>) {
    let mut entries: Vec<PathBuf> =
        fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()).collect();
    entries.sort();
    for path in entries {
        if path.is_dir() {
            programs_below(&path, found);
        } else if path.extension().is_some_and(|extension| extension == "nc" || extension == "ngc") {
            found.push(path);
        }
    }
}

/// The control of a fixture: the configuration beside it names one, or its file does; the oracle reads the others.
fn control_of(program: &Path) -> String {
    let configured = fs::read_to_string(program.with_file_name("gcheck.toml")).unwrap_or_default();
    let named = configured
        .lines()
        .find_map(|line| line.strip_prefix("control = "))
        .map(|name| name.trim_matches('"'));
    let stem = program.file_stem().unwrap().to_str().unwrap();
    let is_control = gcheck_controls::names().contains(&stem);
    named.unwrap_or(if is_control { stem } else { "linuxcnc" }).to_owned()
}

#[test]
fn every_block_of_every_fixture_has_a_hover_of_ten_lines() {
    let fixtures = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../fixtures");
    let mut programs = Vec::new();
    for group in ["clean", "oracle", "timing", "firmware"] {
        programs_below(&fixtures.join(group), &mut programs);
    }
    assert!(programs.len() > 300, "{} programs", programs.len());
    let share = programs.len().div_ceil(2);
    std::thread::scope(|scope| {
        for part in programs.chunks(share) {
            scope.spawn(|| part.iter().for_each(|program| check_blocks(program)));
        }
    });
}

/// Checks the hover of each word of a program.
fn check_blocks(path: &Path) {
    let name = path.display().to_string();
    let program = String::from_utf8_lossy(&fs::read(path).unwrap()).into_owned();
    let mut typed = Typed::new(&control_of(path));
    typed.database.edit(typed.id, 0..0, &program).unwrap();
    let mut start = 0;
    for line in program.split_inclusive('\n') {
        let block = line.trim_end();
        let begins = |(at, c): &(usize, char)| {
            let before = block.get(..*at).and_then(|before| before.chars().next_back());
            *at == 0
                || !c.is_whitespace()
                    && before.is_none_or(|before| before.is_alphanumeric() != c.is_ascii_digit())
        };
        let words: Vec<usize> = block.char_indices().filter(begins).map(|(at, _)| at).collect();
        let shown =
            words.into_iter().filter(|at| check_hover(&mut typed, &name, (start + at) as u32)).count();
        let is_move = block.starts_with(['G', 'X', 'g', 'x']);
        assert!(shown > 0 || !is_move, "{name}: {block} has no hover");
        start += line.len();
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
