//! Our own programs: one feature each, and one mistake each.
//!
//! Knows: the folder, what every program must look like. Must not know: how either side executes.

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

use crate::canonical::{End, compare};
use crate::deliberate;
use crate::product;
use crate::reference::{self, Reference};
use crate::report::{Failure, assert_none, on_each, wanted};
use crate::setup::{Setup, fixtures};

/// Areas whose programs need not end: mistakes, and what the generator found.
const REFUSED: &str = "refused";
const FOUND: &str = "found";

/// One program.
#[derive(Debug)]
pub(crate) struct Program {
    /// Its folder.
    pub(crate) area: String,
    /// `area/name`.
    pub(crate) name: String,
    /// Its file.
    pub(crate) path: PathBuf,
}

/// All programs, of every area.
pub(crate) fn programs() -> Vec<Program> {
    let mut programs = Vec::new();
    for area in sorted(&fixtures()).into_iter().filter(|path| path.is_dir()) {
        for path in sorted(&area).into_iter().filter(|path| path.extension().is_some_and(|e| e == "ngc")) {
            let area = file_name(&area);
            let name = format!("{area}/{}", path.file_stem().unwrap().to_string_lossy());
            programs.push(Program { area, name, path });
        }
    }
    programs
}

fn sorted(folder: &Path) -> Vec<PathBuf> {
    let mut paths: Vec<PathBuf> = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()).collect();
    paths.sort();
    paths
}

fn file_name(path: &Path) -> String {
    path.file_name().unwrap().to_string_lossy().into_owned()
}

/// What is wrong with a program, `None` when both sides do the same and what its area says.
fn difference(reference: &Reference, program: &Program) -> Option<Failure> {
    let setup = Setup::own();
    let expected = reference.run(&program.path, &setup);
    let ends_as_its_area_says = match (&expected.end, program.area.as_str()) {
        (End::Ended, area) => area != REFUSED,
        (End::Refused(_), area) => area == REFUSED || area == FOUND,
        _ => false,
    };
    let failure = |title: String, text: String| {
        let source = fs::read_to_string(&program.path).unwrap();
        Failure { name: program.name.clone(), title, text: format!("{text}\n{source}") }
    };
    if !ends_as_its_area_says {
        let title = format!("the reference itself: {:?}", expected.end);
        return Some(failure(title.clone(), title));
    }
    let ours = product::execute(&program.path, &setup);
    compare(&expected, &ours).map(|difference| failure(difference.title, difference.text))
}

fn agree(area: impl Fn(&str) -> bool) {
    let Some(reference) = reference::find() else { return };
    let programs: Vec<Program> =
        programs().into_iter().filter(|p| area(&p.area) && wanted(&p.name)).collect();
    let failures: Vec<Failure> =
        on_each(&programs, |program| difference(&reference, program)).into_iter().flatten().collect();
    assert_none(&failures, programs.len());
}

#[test]
fn own_programs_run_as_the_reference_runs_them() {
    agree(|area| area != REFUSED && area != deliberate::AREA);
}

#[test]
fn programs_with_a_mistake_are_refused_as_the_reference_refuses_them() {
    agree(|area| area == REFUSED);
}

#[test]
fn own_programs_say_what_they_show_and_number_their_blocks() {
    let programs = programs();
    let refused = programs.iter().filter(|p| p.area == REFUSED).count();
    assert!(refused >= 60, "{refused} programs with a mistake");
    assert!(programs.len() - refused >= 150, "{} programs", programs.len());
    let mut titles = BTreeSet::new();
    for Program { name, area, path } in &programs {
        let text = fs::read_to_string(path).unwrap();
        let mut lines = text.lines().filter(|line| *line != "%");
        let title = lines.next().unwrap_or_default();
        assert!(title.starts_with('(') && title.ends_with(')'), "{name} opens with a comment: {title}");
        assert!(
            titles.insert((area.clone(), title.to_owned())),
            "{name}: another program shows the same: {title}"
        );
        // Mistakes in block numbers are mistakes of their own.
        let numbered = |line: &str| line.trim_start_matches('/').starts_with(['N', 'n', 'o', 'O', ';', '(']);
        let bare = lines.find(|line| !line.is_empty() && !numbered(line));
        assert!(bare.is_none() || area == REFUSED, "{name}: a block without number: {bare:?}");
    }
}
