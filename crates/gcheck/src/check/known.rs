//! The baseline of a run: reading it, taking what it knows out of the reports, writing it.
//!
//! Knows: where a baseline lies and what files are called in it. Must not know: its form, rules, formats.

use std::collections::BTreeSet;
use std::fs;
use std::io::ErrorKind;
use std::path::{Path, PathBuf};

use gcheck_report::{Baseline, FileReport, StaleEntry};

use crate::problem::io_reason;
use crate::{Problem, output, paths};

/// Files named in a message.
const NAMED: usize = 3;

/// A baseline and its place.
#[derive(Debug)]
pub(super) struct KnownFindings {
    path: PathBuf,
    /// Files are called by their paths from here, so that it does not matter where gcheck is started.
    folder: PathBuf,
    baseline: Baseline,
}

impl KnownFindings {
    /// Reads a baseline. One that is about to be written need not be there yet.
    pub(super) fn read(path: &Path, is_written: bool) -> Result<Self, Problem> {
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
        Ok(Self { path: path.to_owned(), folder, baseline })
    }

    /// Takes known findings out of the reports, and gives what to say about entries that nothing answers to: the file was
    /// checked, or is gone.
    pub(super) fn apply(&self, reports: &mut [FileReport]) -> Option<String> {
        let mut checked = BTreeSet::new();
        let mut stale = Vec::new();
        for report in reports {
            let name = self.name_of(&report.path);
            stale.extend(self.baseline.apply(&name, report));
            checked.insert(name);
        }
        for file in
            self.baseline.files().filter(|file| !checked.contains(*file) && is_gone(&self.folder, file))
        {
            stale.extend(self.baseline.entries_of(file));
        }
        (!stale.is_empty()).then(|| self.words(&stale))
    }

    /// Makes everything in the reports known and writes the baseline; gives what to say.
    pub(super) fn update(&mut self, reports: &mut [FileReport]) -> Result<String, Problem> {
        for report in reports.iter_mut() {
            let name = self.name_of(&report.path);
            self.baseline.record(&name, report);
        }
        let folder = &self.folder;
        self.baseline.forget(|file| is_gone(folder, file));
        let text = self.baseline.to_text();
        output::to_file(&self.path, |out| out.write_all(text.as_bytes()))?;
        let known = self.baseline.len();
        let findings = if known == 1 { "finding is" } else { "findings are" };
        Ok(format!("{}: {known} {findings} known from now on", paths::shown(&self.path)))
    }

    /// What the baseline calls a file.
    fn name_of(&self, shown: &str) -> String {
        let path = paths::absolute(Path::new(shown));
        paths::shown(path.strip_prefix(&self.folder).unwrap_or(&path))
    }

    fn words(&self, stale: &[StaleEntry]) -> String {
        let named: Vec<String> =
            stale.iter().take(NAMED).map(|entry| format!("{} of {}", entry.rule, entry.file)).collect();
        let more = match stale.len().saturating_sub(NAMED) {
            0 => String::new(),
            more => format!(" and {more} more"),
        };
        let entries = if stale.len() == 1 { "entry is" } else { "entries are" };
        format!(
            "{}: {} {entries} stale, nothing is found there any more: {}{more}; `--update-baseline` drops them",
            paths::shown(&self.path),
            stale.len(),
            named.join(", ")
        )
    }
}

fn is_gone(folder: &Path, file: &str) -> bool {
    !folder.join(file).exists()
}

fn parse(path: &Path, text: &str) -> Result<Baseline, Problem> {
    Baseline::parse(text).map_err(|malformed| {
        let start = text.split_inclusive('\n').take(malformed.line - 1).map(str::len).sum::<usize>();
        let line = text.get(start..).unwrap_or_default().lines().next().unwrap_or_default();
        Problem::at(&paths::shown(path), text, &(start..start + line.len()), malformed.reason)
            .help(malformed.help)
    })
}
