//! The LinuxCNC regression cases of the real-program corpus.
//!
//! Knows: how those cases are laid out and run (`test.sh`, machine files, tool tables), and the committed list of what
//! agrees. Must not know: how either side executes. Nothing of the corpus is copied into the project: the list holds names.

use std::collections::{BTreeMap, BTreeSet};
use std::env;
use std::fmt::Write as _;
use std::fs;
use std::path::{Path, PathBuf};

use gcheck_testkit::corpus;
use tempfile::TempDir;

use crate::canonical::{End, compare};
use crate::product;
use crate::reference::{self, Reference};
use crate::report::{Failure, assert_none, on_each, wanted};
use crate::setup::{Setup, checkout, copy_folder};

/// Where the cases are, inside the corpus.
const CASES: &str = "LinuxCNC__linuxcnc/tests";

/// The tools that the reference has when it is given no table (observed).
const BUILT_IN_TABLE: &str = "T1 P1 Z0.511 D0.125\nT2 P2 Z0.1 D0.0625\nT3 P3 Z1.273 D0.201\n";

const HEAD: &str = "\
# The regression cases of the reference's own project, by path inside the corpus, and whether our run agrees with the
# installed reference: agrees, differs, out-of-scope. Checked and, with UPDATE_EXPECT=1, rewritten by `cargo test -p
# gcheck-tests --test oracle corpus`; what is out of scope, and why, is written by hand.
";

/// What the list says about a case.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Status {
    Agrees,
    Differs,
    OutOfScope,
}

impl Status {
    const ALL: [Self; 3] = [Self::Agrees, Self::Differs, Self::OutOfScope];

    const fn name(self) -> &'static str {
        match self {
            Self::Agrees => "agrees",
            Self::Differs => "differs",
            Self::OutOfScope => "out-of-scope",
        }
    }

    fn of_name(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|status| status.name() == name)
    }
}

type List = BTreeMap<String, (Status, String)>;

fn list_path() -> PathBuf {
    checkout().join("tests").join("oracle-corpus.tsv")
}

fn read_list() -> List {
    let text = fs::read_to_string(list_path()).unwrap_or_default();
    let entry = |line: &str| {
        let mut fields = line.split('\t').map(str::to_owned);
        let name = fields.next().unwrap();
        let status = fields.next().and_then(|name| Status::of_name(&name));
        let status = status.unwrap_or_else(|| panic!("a status is wrong: {line}"));
        (name, (status, fields.next().unwrap_or_default()))
    };
    text.lines().filter(|line| !line.starts_with('#') && !line.is_empty()).map(entry).collect()
}

fn write_list(list: &List) {
    let mut text = HEAD.to_owned();
    for (name, (status, reason)) in list {
        // Writing to a string cannot fail.
        let _ = writeln!(text, "{}", format!("{name}\t{}\t{reason}", status.name()).trim_end());
    }
    fs::write(list_path(), text).unwrap();
}

/// The folder of the cases; `None`, said on standard error, where there is none and nothing demands it.
fn folder() -> Option<PathBuf> {
    // `programs` says that the corpus is not there.
    let found =
        corpus::programs().and_then(|_| corpus::folder()).map(|f| f.join(CASES)).filter(|f| f.is_dir());
    assert!(
        found.is_some() || env::var_os("GCHECK_REQUIRE_TOOLS").is_none(),
        "the real-program corpus with {CASES} is not here (GCHECK_CORPUS)"
    );
    found
}

/// All programs in a folder and the folders in it, by their path from `root`.
fn programs(root: &Path, folder: &Path, into: &mut BTreeSet<String>) {
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            programs(root, &path, into);
        } else if path.extension().is_some_and(|e| e == "ngc") {
            into.insert(path.strip_prefix(root).unwrap().to_string_lossy().replace('\\', "/"));
        }
    }
}

/// How `test.sh` runs a program: the files after `-t` and `-i`.
#[derive(Debug, Default, PartialEq, Eq)]
struct HowRun {
    table: Option<String>,
    ini: Option<String>,
}

/// Finds the first line of a script that runs the reference on `program`.
fn how_run(script: &str, program: &str) -> HowRun {
    let ini_variable =
        script.lines().find_map(|line| line.trim().strip_prefix("export INI_FILE_NAME=")).unwrap_or_default();
    // A line may be continued on the next.
    for line in script.replace("\\\n", " ").lines() {
        let words: Vec<&str> =
            line.split_whitespace().take_while(|word| !word.starts_with(['|', '>'])).collect();
        if !words.contains(&"rs274") || !words.contains(&program) || line.trim_start().starts_with('#') {
            continue;
        }
        let behind = |option: &str| {
            let at = words.iter().position(|word| *word == option)?;
            let file = words.get(at + 1)?.trim_matches('"');
            Some(if file == "$INI_FILE_NAME" { ini_variable } else { file }.to_owned())
        };
        return HowRun { table: behind("-t"), ini: behind("-i") };
    }
    HowRun::default()
}

/// The folders that a machine file names for subroutines.
fn search(ini: &str) -> Vec<String> {
    let value = ini.lines().find_map(|line| line.trim().strip_prefix("SUBROUTINE_PATH"));
    let value = value.and_then(|rest| rest.trim_start().strip_prefix('=')).unwrap_or_default();
    value.split(':').map(|folder| folder.trim().to_owned()).filter(|folder| !folder.is_empty()).collect()
}

/// Runs a case in a copy of its folder, as its script would.
fn run(reference: &Reference, folder: &Path, name: &str) -> Option<Failure> {
    let case = folder.join(name);
    let program = case.file_name().unwrap().to_string_lossy().into_owned();
    let copy: TempDir = tempfile::tempdir().unwrap();
    let place = copy.path().join("case");
    copy_folder(case.parent().unwrap(), &place);
    let script = fs::read_to_string(place.join("test.sh")).unwrap_or_default();
    let how = how_run(&script, &program);
    let table = if let Some(table) = how.table {
        place.join(table)
    } else {
        let table = copy.path().join("built-in.tbl");
        fs::write(&table, BUILT_IN_TABLE).unwrap();
        table
    };
    let mut setup = Setup::with_table(table);
    if let Some(ini) = how.ini {
        let ini = place.join(ini);
        let text = fs::read_to_string(&ini).unwrap();
        setup.search = search(&text).iter().map(|folder| place.join(folder)).collect();
        setup.ini = Some(ini);
    }
    let program = place.join(program);
    let expected = reference.run(&program, &setup);
    if expected.end == End::Endless {
        let title = "the reference does not end".to_owned();
        return Some(Failure { name: name.to_owned(), title: title.clone(), text: title });
    }
    let ours = product::execute(&program, &setup);
    let difference = compare(&expected, &ours)?;
    Some(Failure { name: name.to_owned(), title: difference.title, text: difference.text })
}

#[test]
fn the_list_of_corpus_cases_is_true() {
    let (Some(reference), Some(folder)) = (reference::find(), folder()) else { return };
    let listed = read_list();
    let mut names = BTreeSet::new();
    programs(&folder, &folder, &mut names);
    assert!(names.len() > 200, "{} cases", names.len());
    let out_of_scope =
        |name: &String| listed.get(name).is_some_and(|(status, _)| *status == Status::OutOfScope);
    let in_scope: Vec<String> = names.iter().filter(|n| !out_of_scope(n) && wanted(n)).cloned().collect();
    let differences = on_each(&in_scope, |name| run(&reference, &folder, name));
    if env::var_os("UPDATE_EXPECT").is_some() {
        let mut list: List = listed.into_iter().filter(|(name, _)| names.contains(name)).collect();
        for (name, difference) in in_scope.into_iter().zip(differences) {
            let status = if difference.is_some() { Status::Differs } else { Status::Agrees };
            list.insert(name, (status, difference.map(|d| one_line(&d.title)).unwrap_or_default()));
        }
        return write_list(&list);
    }
    let mut failures = Vec::new();
    for (name, difference) in in_scope.iter().zip(differences) {
        let failure =
            |title: &str| Failure { name: name.clone(), title: title.to_owned(), text: title.to_owned() };
        match (listed.get(name).map(|(status, _)| *status), difference) {
            (Some(Status::Agrees | Status::OutOfScope), None) | (Some(Status::Differs), Some(_)) => {}
            (Some(Status::Differs), None) => {
                failures.push(failure("agrees, and the list says that it differs"));
            }
            (None, None) => failures.push(failure("agrees, and is not in the list")),
            (_, Some(difference)) => failures.push(difference),
        }
    }
    for name in listed.keys().filter(|name| !names.contains(*name)) {
        let title = "in the list, and not in the corpus".to_owned();
        failures.push(Failure { name: name.clone(), title: title.clone(), text: title });
    }
    assert_none(&failures, in_scope.len());
}

/// A reason for the list: without tabs, line ends and the places of this machine, and not endless.
fn one_line(title: &str) -> String {
    let words: Vec<&str> = title.split_whitespace().filter(|word| !word.contains("/tmp")).collect();
    words.join(" ").chars().take(160).collect()
}

#[test]
fn nearly_all_cases_in_scope_agree() {
    let list = read_list();
    let count = |wanted: Status| list.values().filter(|(status, _)| *status == wanted).count();
    let (agree, differ, out) = (count(Status::Agrees), count(Status::Differs), count(Status::OutOfScope));
    assert!(agree * 100 >= (agree + differ) * 95, "{agree} agree, {differ} differ, {out} are out of scope");
    for (name, (status, reason)) in &list {
        assert!(*status == Status::Agrees || !reason.is_empty(), "{name} is without reason");
    }
}

#[test]
fn scripts_and_machine_files_are_understood() {
    let script = "#!/bin/bash\nexport INI_FILE_NAME=a.ini\nrs274 -n 0 -t b.tbl \\\n  -i \"$INI_FILE_NAME\" -g c.ngc | awk x\n";
    let how = HowRun { table: Some("b.tbl".to_owned()), ini: Some("a.ini".to_owned()) };
    assert_eq!(how_run(script, "c.ngc"), how);
    assert_eq!(how_run(script, "d.ngc"), HowRun::default());
    assert_eq!(search("[RS274NGC]\nSUBROUTINE_PATH = a:./b \n"), ["a", "./b"]);
}
