//! Law 3 through the database: after any edits a document has the findings of a fresh check, and what was told ahead of them is
//! among them.

#![expect(clippy::unwrap_used, reason = "tests")]

use std::fmt::Write as _;
use std::fs;

use gcheck_db::{Database, Settings};
use gcheck_lint::{Environment, Job, NoPrograms, check};
use gcheck_program::Dialect;
use gcheck_syntax::SourceText;
use gcheck_testkit::{corpus, inputs};

/// Numbers that look random and are the same every time.
struct Dice(u64);

impl Dice {
    fn roll(&mut self, below: usize) -> usize {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 % below.max(1) as u64) as usize
    }
}

fn assert_fresh(
    database: &mut Database,
    id: gcheck_db::DocumentId,
    settings: &Settings,
    text: &str,
    told: &str,
) {
    let known = database.analysis(id, &|| false).unwrap();
    let source = SourceText::from(text);
    let dialect = Dialect::new(&settings.control);
    let fresh = check(&Job {
        source: &source,
        environment: Environment {
            dialect: &dialect,
            machine: &settings.machine,
            programs: &NoPrograms,
            control_basis: settings.control_basis,
            unsupported: settings.unsupported,
        },
        selection: &settings.selection,
        suppressions: settings.suppressions,
        execution: settings.execution,
    });
    assert_eq!(known.findings.len(), fresh.findings.len(), "{told}");
    for (own, other) in known.findings.iter().zip(&fresh.findings) {
        assert!(own == other, "{told}\n{own:#?}\n{other:#?}");
    }
    assert_eq!(
        (known.suppressed, &known.assumptions, known.out_of_fuel),
        (fresh.suppressed, &fresh.assumptions, fresh.out_of_fuel),
        "{told}"
    );
}

/// Edits a program somewhere, several times.
fn soak(name: &str, control: &str, text: &str, edits: usize) {
    let mut settings = Settings::new(gcheck_controls::load(control).unwrap(), gcheck_rules::RULES);
    settings.execution.fuel = 200_000;
    let mut database = Database::new();
    let mut text = text.to_owned();
    let id = database.open(&text, settings.clone());
    let mut dice = Dice(text.len() as u64 | 1);
    let mut told = name.to_owned();
    for round in 0..=edits {
        let ahead = text.len() / (2 + round % 4);
        let first = database.first_findings(id, ahead, &|| false).unwrap();
        assert_fresh(&mut database, id, &settings, &text, &told);
        let known = database.analysis(id, &|| false).unwrap();
        for finding in first.iter().flat_map(|first| &first.findings) {
            assert!(known.findings.contains(finding), "taken back in {told}\n{finding:#?}");
        }
        let mut at = dice.roll(text.len() + 1);
        while !text.is_char_boundary(at) {
            at -= 1;
        }
        let line = text.get(..at).and_then(|before| before.rfind('\n')).map_or(0, |end| end + 1);
        let end = text.get(line..).and_then(|rest| rest.find('\n')).map_or(text.len(), |end| line + end + 1);
        let (range, insert) = match dice.roll(7) {
            0 => (line..line, "G01 "),
            1 => (line..line, "X1.5 Y2.5\n"),
            2 => (line..end, ""),
            3 => (at..at, "7"),
            4 => (line..line, "(NOTE)\n"),
            5 => (line..line, "M5\nT2 M6\nG0 Z100.\n"),
            _ => (line..line, "IF [#500 EQ 1.] GOTO 77\nN77 "),
        };
        let _ = write!(told, "\n{range:?} {insert:?}");
        database.edit(id, range.start as u32..range.end as u32, insert).unwrap();
        text.replace_range(range, insert);
    }
}

#[test]
fn edited_programs_of_all_kinds_are_checked_as_fresh_ones() {
    soak("surfacing", "haas-mill", &inputs::surfacing(4_000), 25);
    soak("drilling", "fanuc-mill", &inputs::drilling(3_000), 25);
    soak("macros", "haas-mill", &inputs::macros(600), 15);
}

#[test]
fn edited_programs_of_the_corpus_are_checked_as_fresh_ones() {
    let Some(programs) = corpus::programs() else { return };
    for program in programs.iter().step_by(23) {
        let Ok(bytes) = fs::read(&program.path) else { continue };
        let known = gcheck_controls::load(&program.control).is_ok();
        let control = if known { program.control.as_str() } else { "haas-mill" };
        // What takes long to check takes long to check often.
        if bytes.len() <= 100_000 {
            soak(&program.name, control, SourceText::from_bytes(bytes).unwrap().text(), 5);
        }
    }
}
