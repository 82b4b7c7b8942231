//! Results of earlier runs: what was found in a program is read instead of found again.
//!
//! Knows: a folder of entries, when one may be trusted, how the folder stays bounded. Must not know: rules, formats, how a
//! file is checked.
//!
//! An entry is found by its [`Key`]: the program's bytes, everything that is in force for it, the build of gcheck. What
//! cannot be known beforehand, namely which other programs the check looked for and what it found, is in the entry as
//! [questions with their answers](questions) and is asked again before the entry is used. So a verdict out of the cache is
//! the verdict that a check would give.
//!
//! Nothing about the cache is an error of a run: an entry that is damaged, torn or not ours is as good as none, and is
//! written again. Entries are written to a temporary file that then takes its name, so processes that share a folder never
//! read half an entry.

mod entry;
mod key;
mod questions;

use std::env;
use std::fs;
use std::io;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicU64, Ordering};
use std::time::{Duration, SystemTime};

use twox_hash::XxHash3_128;

pub(super) use entry::{Entry, Verdict};
pub(super) use key::{Key, Run};
pub(super) use questions::{Questions, answers_hold};

use crate::problem::io_reason;
use crate::{Problem, reading, writing};

/// What the folder may hold, in bytes; beyond it, entries used longest ago go first.
const MAX_BYTES: u64 = 256 << 20;
/// What is left after a clean-up, so that not every run cleans up.
const KEPT_BYTES: u64 = MAX_BYTES / 4 * 3;
/// A larger result is not stored: reading it would cost what the check does.
const MAX_ENTRY: usize = 8 << 20;
/// A run that stored more than this cleans up in any case.
const MUCH: u64 = MAX_BYTES / 16;
/// Other runs clean up when nobody has for so long.
const CLEAN_UP_AFTER: Duration = Duration::from_hours(1);
/// An entry's time of use is written down again when it is older than this.
const USE_COUNTS_FOR: Duration = Duration::from_hours(24);

/// Begins every entry.
const MAGIC: &[u8; 16] = b"gcheck result 1\n";
/// Length of the check sum that follows.
const SUM: usize = 16;

/// Marks a folder as a cache, for backup programs and for us: <https://bford.info/cachedir/>.
const TAG: &str = "CACHEDIR.TAG";
const TAG_TEXT: &str = "Signature: 8a477f597d28d172789f06886806bc55\n\
    # This folder holds results of gcheck (https://github.com/gcheck/gcheck). It may be deleted at any time.\n";
/// No tag is longer.
const MAX_TAG: u64 = 64 << 10;
/// Keeps the folder out of version control wherever it lies.
const IGNORE: &str = ".gitignore";
/// Its time is that of the last clean-up.
const CLEANED: &str = "cleaned-up";

/// A folder of results.
#[derive(Debug)]
pub(super) struct Cache {
    folder: PathBuf,
    /// Bytes that this run stored.
    stored: AtomicU64,
}

impl Cache {
    /// The cache of a run: in the folder that was named, or in the user's own.
    ///
    /// # Errors
    /// When the named folder holds other files, or cannot be made. Without a name there is just no cache then.
    pub(super) fn open(named: Option<&Path>) -> Result<Option<Self>, Problem> {
        let Some(folder) = named.map(Path::to_owned).or_else(usual_folder) else { return Ok(None) };
        match prepare(&folder) {
            Ok(true) => Ok(Some(Self { folder, stored: AtomicU64::new(0) })),
            Ok(false) | Err(_) if named.is_none() => Ok(None),
            Ok(false) => Err(Problem::with_file(&folder, "holds other files, so it cannot be the cache")
                .help("name a folder of its own: one that is empty or does not exist yet")),
            Err(error) => {
                Err(Problem::with_file(&folder, format!("cannot be the cache: {}", io_reason(&error))))
            }
        }
    }

    /// The result stored under a key, unless there is none that can be trusted.
    pub(super) fn load(&self, key: Key) -> Option<Entry> {
        let path = self.place(key);
        let bytes = reading::regular(&path, 2 * MAX_ENTRY as u64).ok()?;
        let (sum, payload) = bytes.strip_prefix(MAGIC)?.split_at_checked(SUM)?;
        if sum != check_sum(key, payload) {
            return None;
        }
        let entry = Entry::decode(payload)?;
        note_use(&path);
        Some(entry)
    }

    /// Stores a result. That it cannot be stored is nobody's business: the next run finds it again.
    pub(super) fn store(&self, key: Key, entry: &Entry) {
        let Some(payload) = entry.encode().filter(|payload| payload.len() <= MAX_ENTRY) else { return };
        let bytes = [MAGIC, check_sum(key, &payload).as_slice(), &payload].concat();
        if self.write(&self.place(key), &bytes).is_ok() {
            self.stored.fetch_add(bytes.len() as u64, Ordering::Relaxed);
        }
    }

    fn write(&self, path: &Path, bytes: &[u8]) -> io::Result<()> {
        writing::quickly(path, bytes).or_else(|_| {
            fs::create_dir_all(path.parent().unwrap_or(&self.folder))?;
            writing::quickly(path, bytes)
        })
    }

    /// Keeps the folder bounded. To be called when a run has stored what it has.
    pub(super) fn tidy(&self) {
        let stored = self.stored.swap(0, Ordering::Relaxed);
        let mark = self.folder.join(CLEANED);
        if stored == 0 || (stored < MUCH && age(&mark).is_some_and(|age| age < CLEAN_UP_AFTER)) {
            return;
        }
        // Another process may be cleaning up as well: what is gone already needs no deleting.
        let _ = writing::quickly(&mark, b"");
        clean_up(&self.folder, MAX_BYTES, KEPT_BYTES);
    }

    fn place(&self, key: Key) -> PathBuf {
        let name = key.to_string();
        let (start, rest) = name.split_at(2);
        self.folder.join(start).join(rest)
    }
}

/// Where caches of this user's programs lie.
fn usual_folder() -> Option<PathBuf> {
    let folder = |name: &str| env::var_os(name).map(PathBuf::from).filter(|path| path.is_absolute());
    let caches = if cfg!(windows) {
        folder("LOCALAPPDATA")?
    } else if let Some(caches) = folder("XDG_CACHE_HOME") {
        caches
    } else if cfg!(target_vendor = "apple") {
        folder("HOME")?.join("Library/Caches")
    } else {
        folder("HOME")?.join(".cache")
    };
    Some(caches.join("gcheck"))
}

/// Makes the folder, and marks it as what it is; false if it holds other files.
fn prepare(folder: &Path) -> io::Result<bool> {
    let tag = folder.join(TAG);
    // A tag of another program's cache is not enough.
    let is_ours = || {
        reading::regular(&tag, MAX_TAG).is_ok_and(|text| String::from_utf8_lossy(&text).contains("gcheck"))
    };
    if is_ours() {
        return Ok(true);
    }
    fs::create_dir_all(folder)?;
    let is_other = |name: &str| name != IGNORE && !name.starts_with(TAG) && !writing::is_temporary(name);
    if fs::read_dir(folder)?.flatten().any(|entry| is_other(&entry.file_name().to_string_lossy())) {
        // Another process may have begun at the same time; it writes the tag first.
        return Ok(is_ours());
    }
    writing::quickly(&tag, TAG_TEXT.as_bytes())?;
    writing::quickly(&folder.join(IGNORE), b"# Written by gcheck.\n*\n")?;
    Ok(true)
}

fn check_sum(key: Key, payload: &[u8]) -> [u8; SUM] {
    let mut hasher = XxHash3_128::new();
    hasher.write(&key.bytes());
    hasher.write(payload);
    hasher.finish_128().to_le_bytes()
}

/// Since when a file is as it is.
fn age(path: &Path) -> Option<Duration> {
    SystemTime::now().duration_since(path.metadata().ok()?.modified().ok()?).ok()
}

/// Writes down that an entry was used; the time of its last change serves for that.
fn note_use(path: &Path) {
    if age(path).is_some_and(|age| age > USE_COUNTS_FOR)
        && let Ok(file) = fs::File::options().append(true).open(path)
    {
        // Without it the entry goes earlier than it need.
        let _ = file.set_modified(SystemTime::now());
    }
}

/// Deletes entries, those used longest ago first, until the folder holds no more than `kept` bytes, if it holds more than
/// `most`.
fn clean_up(folder: &Path, most: u64, kept: u64) {
    let is_shelf = |name: &str| name.len() == 2 && name.bytes().all(|b| b.is_ascii_hexdigit());
    let mut entries = Vec::new();
    for shelf in fs::read_dir(folder).into_iter().flatten().flatten() {
        if !is_shelf(&shelf.file_name().to_string_lossy()) {
            continue;
        }
        for entry in fs::read_dir(shelf.path()).into_iter().flatten().flatten() {
            if let Ok(data) = entry.metadata()
                && data.is_file()
            {
                let used = data.modified().unwrap_or(SystemTime::UNIX_EPOCH);
                entries.push((used, entry.path(), data.len()));
            }
        }
    }
    let mut total: u64 = entries.iter().map(|(.., length)| length).sum();
    if total <= most {
        return;
    }
    entries.sort();
    for (_, path, length) in entries {
        if total <= kept {
            break;
        }
        if fs::remove_file(path).is_ok() {
            total -= length;
        }
    }
}

#[cfg(test)]
mod tests {
    use std::fs::{self, File};
    use std::time::{Duration, SystemTime};

    use super::{Cache, clean_up};

    #[test]
    fn what_was_used_longest_ago_goes_first_and_foreign_files_stay() {
        let folder = tempfile::tempdir().unwrap();
        let shelf = folder.path().join("ab");
        fs::create_dir(&shelf).unwrap();
        for n in 0..10_u64 {
            let path = shelf.join(n.to_string());
            fs::write(&path, [0; 100]).unwrap();
            let used = SystemTime::now() - Duration::from_secs(1_000 * (10 - n));
            File::options().append(true).open(&path).unwrap().set_modified(used).unwrap();
        }
        fs::write(folder.path().join("notes"), [0; 1_000]).unwrap();
        clean_up(folder.path(), 1_000, 300);
        assert_eq!(fs::read_dir(&shelf).unwrap().count(), 10, "the limit is not reached");
        clean_up(folder.path(), 900, 300);
        let mut left: Vec<_> =
            fs::read_dir(&shelf).unwrap().map(|e| e.unwrap().file_name().into_string().unwrap()).collect();
        left.sort();
        assert_eq!(left, ["7", "8", "9"]);
        assert!(folder.path().join("notes").exists());
    }

    #[test]
    fn a_folder_with_other_things_is_refused() {
        let folder = tempfile::tempdir().unwrap();
        fs::write(folder.path().join("part.nc"), "G0").unwrap();
        let problem = Cache::open(Some(folder.path())).unwrap_err().to_string();
        assert!(problem.contains("holds other files"), "{problem}");
        assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 1);
    }
}
