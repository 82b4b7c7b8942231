//! Cases: one mistake in one program.
//!
//! Knows: where the programs come from and which of their places is taken. Must not know: what is found.

use std::fmt::Write as _;
use std::fs;
use std::path::Path;

use gcheck_testkit::corpus;

use crate::kind::{Kind, Seed};
use crate::kinds;
use crate::program::Program;

/// One mistake in one program.
pub(crate) struct Case {
    pub(crate) kind: &'static Kind,
    /// The program's name.
    pub(crate) program: String,
    pub(crate) control: String,
    /// The configuration beside the program.
    pub(crate) config: String,
    /// The program with the mistake.
    pub(crate) text: String,
    /// The lines at which it was edited.
    pub(crate) lines: Vec<usize>,
}

/// A program and the configuration beside it.
pub(crate) struct Subject {
    pub(crate) program: Program,
    pub(crate) config: String,
}

/// Programs of the corpus in which a kind is tried.
const PROGRAMS_A_KIND: usize = 4;

/// Longer programs are left out: the cases are many.
const LONGEST: usize = 100_000;

/// Our own programs.
pub(crate) fn ours() -> Vec<Subject> {
    let folder = crate::root().join("fixtures/clean");
    let mut subjects = Vec::new();
    for control in gcheck_controls::names() {
        let Ok(entries) = fs::read_dir(folder.join(control)) else { continue };
        let config = fs::read_to_string(folder.join(control).join("gcheck.toml")).unwrap();
        for path in entries.map(|entry| entry.unwrap().path()) {
            if path.extension().is_some_and(|extension| extension == "toml") {
                continue;
            }
            let name = path.file_name().unwrap().to_string_lossy();
            let program = Program::read(&name, control, fs::read_to_string(&path).unwrap());
            subjects.push(Subject { program, config: config.clone() });
        }
    }
    subjects
        .sort_by(|a, b| (&a.program.control, &a.program.name).cmp(&(&b.program.control, &b.program.name)));
    subjects
}

/// The programs of the corpus that are whole: what is called by others, or a fragment, has its modes from elsewhere.
pub(crate) fn of_the_corpus() -> Option<Vec<Subject>> {
    let mut programs = corpus::programs()?;
    programs.sort_by(|a, b| a.name.cmp(&b.name));
    let known = gcheck_controls::names();
    programs.retain(|program| known.contains(&program.control.as_str()));
    let read = |program: &corpus::CorpusProgram| {
        let text = fs::read_to_string(&program.path).ok().filter(|text| text.len() < LONGEST)?;
        let config = format!("control = \"{}\"\n", program.control);
        Some(Subject { program: Program::read(&program.name, &program.control, text), config })
    };
    Some(programs.iter().filter_map(read).filter(|subject| subject.program.is_whole()).collect())
}

/// Every kind in each of our programs that has a place for it.
pub(crate) fn of_ours(subjects: &[Subject]) -> Vec<Case> {
    let mut cases = Vec::new();
    for kind in kinds::all() {
        let fits = |subject: &&Subject| {
            let is_told = subject.config.contains("travel");
            if is_told { !kind.is_settled_by_machine } else { !kind.needs_machine }
        };
        cases.extend(subjects.iter().filter(fits).filter_map(|subject| case(kind, subject)));
    }
    cases
}

/// Every kind in a few programs of the corpus that have a place for it.
pub(crate) fn in_the_corpus(subjects: &[Subject]) -> Vec<Case> {
    let mut cases = Vec::new();
    for kind in kinds::all().filter(|kind| !kind.needs_machine) {
        let mut order: Vec<&Subject> = subjects.iter().collect();
        order.sort_by_key(|subject| drawn(kind.id, &subject.program.name));
        cases.extend(order.into_iter().filter_map(|subject| case(kind, subject)).take(PROGRAMS_A_KIND));
    }
    cases
}

fn case(kind: &'static Kind, subject: &Subject) -> Option<Case> {
    let Subject { program, config } = subject;
    let seeds = (kind.seeds)(program);
    let count = u64::try_from(seeds.len()).unwrap();
    let taken = drawn(kind.id, &program.name).checked_rem(count)?;
    let seed: &Seed = seeds.get(usize::try_from(taken).unwrap())?;
    let (text, lines) = seed.apply(&program.text);
    Some(Case {
        kind,
        program: program.name.clone(),
        control: program.control.clone(),
        config: config.clone(),
        text,
        lines,
    })
}

/// A number that depends on both names alone (FNV-1a).
fn drawn(kind: &str, program: &str) -> u64 {
    let bytes = kind.bytes().chain([b'/']).chain(program.bytes());
    bytes.fold(0xcbf2_9ce4_8422_2325, |hash, byte| (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3))
        >> 7
}

impl Case {
    /// Path of the case below a folder of cases: each in a folder of its own, so that no case is another's subprogram.
    pub(crate) fn path(&self, number: usize) -> String {
        let name = self.program.rsplit('/').next().unwrap_or_default();
        format!("{number:04}/{name}")
    }

    /// Writes the cases, the programs without mistakes (`clean/…`) and a list of both.
    pub(crate) fn write_all(cases: &[Self], subjects: &[Subject], folder: &Path) {
        let mut list = String::from("case\tclean\tkind\tcontrol\n");
        for Subject { program, .. } in subjects {
            let path = folder.join("clean").join(&program.control).join(&program.name);
            fs::create_dir_all(path.parent().unwrap()).unwrap();
            fs::write(path, &program.text).unwrap();
        }
        for (number, case) in cases.iter().enumerate() {
            let path = folder.join(case.path(number));
            fs::create_dir_all(path.parent().unwrap()).unwrap();
            fs::write(path, &case.text).unwrap();
            let (path, kind) = (case.path(number), case.kind.id);
            writeln!(list, "{path}\tclean/{}/{}\t{kind}\t{}", case.control, case.program, case.control)
                .unwrap();
        }
        fs::write(folder.join("cases.tsv"), list).unwrap();
    }
}
