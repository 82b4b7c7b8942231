//! The baseline of a run: reading it, taking what it knows out of the reports, writing it.
//!
//! Knows: where a baseline lies and what files are called in it. Must not know: its form, rules, formats.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::io::ErrorKind;
use std::path::{Path, PathBuf};
use std::sync::{PoisonError, RwLock};

use gcheck_report::{Baseline, FileReport, StaleEntry};

use crate::problem::io_reason;
use crate::{Problem, output, paths, reading};

/// Files named in a message.
const NAMED: usize = 3;
/// Bytes of a baseline.
const MOST_BASELINE: u64 = 256 << 20;

/// A baseline and its place.
#[derive(Debug)]
pub(super) struct KnownFindings {
    path: PathBuf,
    /// Files are called by their paths from here, so that it does not matter where gcheck is started.
    folder: PathBuf,
    /// It is being written, not only read.
    is_written: bool,
    /// Files are checked several at a time.
    baseline: RwLock<Baseline>,
}

impl KnownFindings {
    /// Reads a baseline. One that is about to be written need not be there yet.
    pub(super) fn read(path: &Path, is_written: bool) -> Result<Self, Problem> {
        if let Some(reason) = reading::irregular(path, MOST_BASELINE) {
            return Err(Problem::with_file(path, format!("cannot read: {reason}")));
        }
        let baseline = match fs::read_to_string(path) {
            Ok(text) => parse(path, &text)?,
            Err(error) if error.kind() == ErrorKind::NotFound && is_written => Baseline::default(),
            Err(error) if error.kind() == ErrorKind::NotFound => {
                return Err(Problem::with_file(path, "there is no such baseline")
                    .help("write it with `--update-baseline`"));
            }
            Err(error) => {
                return Err(Problem::with_file(path, format!("cannot read: {}", io_reason(&error))));
            }
        };
        let folder = paths::absolute(path).parent().map(Path::to_owned).unwrap_or_default();
        Ok(Self { path: path.to_owned(), folder, is_written, baseline: RwLock::new(baseline) })
    }

    /// Takes known findings out of a report; gives the entries that found nothing.
    ///
    /// When the baseline is being written, everything in the report becomes known first.
    pub(super) fn apply(&self, report: &mut FileReport) -> Vec<StaleEntry> {
        let name = self.name_of(&report.path);
        // A panic while it was locked cannot have left it half-written: files are put in whole.
        if self.is_written {
            self.baseline.write().unwrap_or_else(PoisonError::into_inner).record(&name, report);
        }
        self.baseline.read().unwrap_or_else(PoisonError::into_inner).apply(&name, report)
    }

    /// Writes the baseline, if it is to be written, and gives what to say: how much is known, or which entries nothing answers
    /// to. `stale` are those of the files that were checked; those of files that are gone are added.
    pub(super) fn finish(
        self,
        reports: &[FileReport],
        mut stale: Vec<StaleEntry>,
    ) -> Result<Option<String>, Problem> {
        let Self { path, folder, is_written, baseline } = self;
        let mut baseline = baseline.into_inner().unwrap_or_else(PoisonError::into_inner);
        if is_written {
            let checked: BTreeSet<String> =
                reports.iter().map(|report| name_in(&folder, &report.path)).collect();
            baseline.forget(|file| !checked.contains(file) && is_gone(&folder, file));
            let text = baseline.to_text();
            output::to_file(&path, |out| out.write_all(text.as_bytes()))?;
            let known = baseline.len();
            let findings = if known == 1 { "finding is" } else { "findings are" };
            return Ok(Some(format!("{}: {known} {findings} known from now on", paths::shown(&path))));
        }
        let checked: BTreeSet<String> = reports.iter().map(|report| name_in(&folder, &report.path)).collect();
        for file in baseline.files().filter(|file| !checked.contains(*file) && is_gone(&folder, file)) {
            stale.extend(baseline.entries_of(file));
        }
        Ok((!stale.is_empty()).then(|| words(&path, &stale)))
    }

    /// What the baseline calls a file.
    fn name_of(&self, shown: &str) -> String {
        name_in(&self.folder, shown)
    }
}

fn name_in(folder: &Path, shown: &str) -> String {
    let path = paths::absolute(Path::new(shown));
    paths::shown(path.strip_prefix(folder).unwrap_or(&path))
}

fn words(path: &Path, stale: &[StaleEntry]) -> String {
    // What was found many times in a file is named once.
    let mut counts: BTreeMap<(&str, &str), usize> = BTreeMap::new();
    for entry in stale {
        *counts.entry((&entry.file, &entry.rule)).or_default() += 1;
    }
    let named: Vec<String> =
        counts.keys().take(NAMED).map(|(file, rule)| format!("{rule} of {file}")).collect();
    let more = match counts.values().skip(NAMED).sum::<usize>() {
        0 => String::new(),
        more => format!(" and {more} more"),
    };
    let entries = if stale.len() == 1 { "entry is" } else { "entries are" };
    format!(
        "{}: {} {entries} stale, nothing is found there any more: {}{more}; `--update-baseline` drops them",
        paths::shown(path),
        stale.len(),
        named.join(", ")
    )
}

/// Is a file not there any more? Of one whose name is not text, nobody can tell by what the baseline calls it.
fn is_gone(folder: &Path, file: &str) -> bool {
    !file.contains(char::REPLACEMENT_CHARACTER) && !folder.join(file).exists()
}

fn parse(path: &Path, text: &str) -> Result<Baseline, Problem> {
    Baseline::parse(text).map_err(|malformed| {
        let start = text.split_inclusive('\n').take(malformed.line - 1).map(str::len).sum::<usize>();
        let line = text.get(start..).unwrap_or_default().lines().next().unwrap_or_default();
        Problem::at(&paths::shown(path), text, &(start..start + line.len()), malformed.reason)
            .help(malformed.help)
    })
}
