//! Temporary files: their names, and that none stays, whatever ends the process.
//!
//! Knows: which temporary files this process has begun, and how those of processes that were killed are known. Must not
//! know: what is in them.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, Once, PoisonError};
use std::time::{Duration, SystemTime};
use std::{fs, process};

/// Begins the name of a temporary file.
const HEAD: &str = ".gcheck-";
/// Ends it.
const TAIL: &str = ".tmp";
/// Digits between them.
const DIGITS: usize = 16;
/// A temporary file that nobody has written to for so long belongs to a process that was killed.
pub(super) const FORGOTTEN_AFTER: Duration = Duration::from_mins(10);
/// Exit code of a process that a signal ends.
const INTERRUPTED: i32 = 130;

/// Temporary files that this process has begun.
static BEGUN: Mutex<BTreeSet<PathBuf>> = Mutex::new(BTreeSet::new());
/// Folders in which this process has looked for those of others.
static CLEANED: Mutex<BTreeSet<PathBuf>> = Mutex::new(BTreeSet::new());

/// The name of a temporary file: short, whatever the name of the file that it becomes.
pub(super) fn name(number: u64) -> String {
    format!("{HEAD}{number:0DIGITS$x}{TAIL}")
}

/// To be called before a temporary file is made.
pub(super) fn begun(path: &Path) {
    static WATCH: Once = Once::new();
    WATCH.call_once(|| {
        // Who has a handler of its own, such as `--watch`, keeps it.
        let _ = ctrlc::try_set_handler(|| {
            remove_all();
            process::exit(INTERRUPTED);
        });
    });
    BEGUN.lock().unwrap_or_else(PoisonError::into_inner).insert(path.to_owned());
}

/// To be called when a temporary file has its name, or is removed.
pub(super) fn done(path: &Path) {
    BEGUN.lock().unwrap_or_else(PoisonError::into_inner).remove(path);
}

/// Removes what this process has begun and not finished; to be called when it ends in the middle of its work.
pub(crate) fn remove_all() {
    for path in BEGUN.lock().unwrap_or_else(PoisonError::into_inner).iter() {
        // The process ends; there is nobody left to tell.
        let _ = fs::remove_file(path);
    }
}

/// Removes temporary files of processes that were killed, when a folder is first written to.
pub(super) fn clean_once(folder: &Path) {
    if CLEANED.lock().unwrap_or_else(PoisonError::into_inner).insert(folder.to_owned()) {
        clean(folder, SystemTime::now());
    }
}

/// Removes temporary files that nobody has written to for [`FORGOTTEN_AFTER`] before `now`.
pub(super) fn clean(folder: &Path, now: SystemTime) {
    let folder = if folder.as_os_str().is_empty() { Path::new(".") } else { folder };
    for entry in fs::read_dir(folder).into_iter().flatten().flatten() {
        if is_temporary(&entry.file_name().to_string_lossy())
            && let Ok(data) = entry.metadata()
            && data.is_file()
            && data.modified().is_ok_and(|at| now.duration_since(at).is_ok_and(|age| age > FORGOTTEN_AFTER))
        {
            // What cannot be removed stays: it is in nobody's way.
            let _ = fs::remove_file(entry.path());
        }
    }
}

/// Is this the name of a temporary file?
pub(crate) fn is_temporary(name: &str) -> bool {
    let digits = name.strip_prefix(HEAD).and_then(|rest| rest.strip_suffix(TAIL));
    digits.is_some_and(|digits| digits.len() == DIGITS && digits.bytes().all(|b| b.is_ascii_hexdigit()))
}
