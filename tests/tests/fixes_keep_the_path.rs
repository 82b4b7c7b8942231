//! Law 6: a safe fix leaves the moves of a program as they are. All fixes, safe or not, come to an end.
//!
//! On our own programs, and on the real-program corpus (`GCHECK_CORPUS`) where there is one.

#![expect(clippy::unwrap_used, reason = "a test that meets the unexpected is to fail")]

mod moves;

use std::fs;
use std::path::Path;

use gcheck_diagnostics::{Finding, FixKinds};
use gcheck_lint::{
    ControlBasis, Environment, Execution, Job, MachineFacts, NoPrograms, Selection, check, fix_all,
};
use gcheck_program::Dialect;
use gcheck_rules::RULES;
use gcheck_syntax::SourceText;
use gcheck_testkit::corpus;
use moves::{moves, own_programs};
use rayon::prelude::*;

/// A program with its fixes of these kinds; `None` when it has none.
fn mended(program: &[u8], control: &str, kinds: FixKinds) -> Option<Vec<u8>> {
    let control = gcheck_controls::load(control).unwrap();
    let dialect = Dialect::new(&control);
    let machine = MachineFacts::default();
    let mut selection = Selection::recommended(RULES);
    selection.enable("all").unwrap();
    let source = SourceText::from_bytes(program.to_vec()).unwrap();
    let mended = fix_all(source, kinds, |source| {
        let environment = Environment {
            dialect: &dialect,
            machine: &machine,
            programs: &NoPrograms,
            control_basis: ControlBasis::Chosen,
            unsupported: None,
        };
        check(&Job {
            source,
            environment,
            selection: &selection,
            suppressions: true,
            execution: Execution { fuel: 100_000, block_skip: None },
        })
    });
    let is_mendable = |finding: &&Finding| finding.fixes.iter().any(|fix| fix.safe || kinds == FixKinds::All);
    let left = mended.outcome.findings.iter().find(is_mendable).map(|finding| finding.rule.id);
    assert_eq!(left, None, "fixes of a program never end");
    (mended.count > 0).then(|| mended.source.to_bytes())
}

/// The law for one program; says whether it had anything to fix.
fn holds(name: &str, program: &[u8], control: &str, folder: &Path) -> bool {
    let Some(after) = mended(program, control, FixKinds::Safe) else { return false };
    let (before, ended) = moves(program, control, folder);
    let (now, _) = moves(&after, control, folder);
    if ended {
        assert_eq!(before, now, "{name} ({control})");
    } else {
        // Fixed, the program may go on where it stopped before.
        let kept = before.iter().zip(&now).take_while(|(a, b)| a == b).count();
        let ending = before.len().saturating_sub(kept);
        assert!(ending <= 2, "{name} ({control}): {:?}, then {:?}", before.get(kept), now.get(kept));
    }
    true
}

#[test]
fn on_our_own_programs() {
    let files = own_programs();
    let count = files.len();
    let with_fixes = files
        .par_iter()
        .filter(|path| {
            let control = if path.extension().is_some_and(|e| e == "nc") { "haas-mill" } else { "linuxcnc" };
            holds(&path.display().to_string(), &fs::read(path).unwrap(), control, path.parent().unwrap())
        })
        .count();
    assert!(count > 300 && with_fixes > 0, "{with_fixes} of {count} programs had a fix");
}

#[test]
fn on_the_corpus() {
    let Some(programs) = corpus::programs() else { return };
    let with_fixes = programs
        .par_iter()
        .filter(|program| {
            let folder = program.path.parent().unwrap();
            let known = gcheck_controls::names().contains(&program.control.as_str());
            known && holds(&program.name, &fs::read(&program.path).unwrap(), &program.control, folder)
        })
        .count();
    assert!(with_fixes > 5, "{with_fixes} of {} programs had a fix", programs.len());
}

#[test]
fn all_fixes_of_real_programs_come_to_an_end() {
    let Some(programs) = corpus::programs() else { return };
    let with_fixes = programs
        .par_iter()
        .filter(|program| {
            let known = gcheck_controls::names().contains(&program.control.as_str());
            known && mended(&fs::read(&program.path).unwrap(), &program.control, FixKinds::All).is_some()
        })
        .count();
    assert!(with_fixes > 5, "{with_fixes} of {} programs had a fix", programs.len());
}
