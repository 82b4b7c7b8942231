//! Each step of a replacement fails in turn, in each way that disks fail.

use std::cell::Cell;
use std::fs::{self, File};
use std::io::{self, Write as _};
use std::path::Path;
use std::time::{Duration, SystemTime};

use super::disk::{Disk, Old, System};
use super::{Care, Failure, leftovers, put};

/// How a step fails.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Fault {
    /// It does nothing and says so.
    Error,
    /// The disk is full: half of the bytes are written, then none.
    Full,
    /// It is interrupted by a signal and must be tried again.
    Interrupted,
    /// Fewer bytes are written than were given.
    Short,
    /// The process dies before the step.
    CrashBefore,
    /// The process dies after the step.
    CrashAfter,
}

/// A disk whose step of one number fails.
struct Failing {
    fault: Fault,
    at: usize,
    step: Cell<usize>,
    is_dead: Cell<bool>,
}

impl Failing {
    fn step<T, E: From<io::Error>>(&self, work: impl FnOnce() -> Result<T, E>) -> Result<T, E> {
        let step = self.step.get();
        self.step.set(step + 1);
        if self.is_dead.get() {
            return Err(io::Error::other("dead").into());
        }
        if step != self.at {
            return work();
        }
        match self.fault {
            Fault::Error | Fault::Full => Err(io::Error::from(io::ErrorKind::StorageFull).into()),
            // Only writes are tried again or go on; the other steps have no such way to fail.
            Fault::Interrupted | Fault::Short => work(),
            Fault::CrashBefore => {
                self.is_dead.set(true);
                Err(io::Error::other("dead").into())
            }
            Fault::CrashAfter => {
                let done = work();
                self.is_dead.set(true);
                done.and(Err(io::Error::other("dead").into()))
            }
        }
    }
}

impl Disk for Failing {
    type File = File;

    fn about(&self, path: &Path) -> io::Result<Option<Old>> {
        self.step(|| System.about(path))
    }

    fn read(&self, path: &Path) -> io::Result<Vec<u8>> {
        self.step(|| System.read(path))
    }

    fn create(&self, path: &Path) -> io::Result<File> {
        self.step(|| System.create(path))
    }

    fn write(&self, file: &mut File, bytes: &[u8]) -> io::Result<usize> {
        let is_now = self.step.get() == self.at && !self.is_dead.get();
        let half = &bytes[..bytes.len() / 2];
        match self.fault {
            Fault::Interrupted if is_now => {
                self.step.set(self.step.get() + 1);
                Err(io::ErrorKind::Interrupted.into())
            }
            Fault::Short if is_now => self.step(|| System.write(file, half)),
            Fault::Full if is_now => {
                // The half that has room stays in the file.
                file.write_all(half)?;
                self.step(|| System.write(file, bytes))
            }
            _ => self.step(|| System.write(file, bytes)),
        }
    }

    fn keep(&self, file: &File, old: &Old) -> Result<(), Failure> {
        self.step(|| System.keep(file, old))
    }

    fn sync(&self, file: &File) -> io::Result<()> {
        self.step(|| System.sync(file))
    }

    fn rename(&self, from: &Path, to: &Path) -> io::Result<()> {
        self.step(|| System.rename(from, to))
    }

    fn sync_folder(&self, folder: &Path) -> io::Result<()> {
        self.step(|| System.sync_folder(folder))
    }

    fn remove(&self, path: &Path) -> io::Result<()> {
        self.step(|| System.remove(path))
    }
}

/// Steps of the longest replacement: about, create, two writes, keep, sync, read, rename, sync of the folder; and some more.
const STEPS: usize = 14;

fn names(folder: &Path) -> Vec<String> {
    fs::read_dir(folder).unwrap().map(|e| e.unwrap().file_name().into_string().unwrap()).collect()
}

/// Replaces a file with a fault at every step, and checks that it is the old one or the new one and the only one.
fn check_replacement(fault: Fault, care: Care, must_be_whole: bool) {
    let (old, new) = (vec![b'o'; 150_000], vec![b'n'; 100_000]);
    for at in 0..STEPS {
        let folder = tempfile::tempdir().unwrap();
        let target = folder.path().join("part.nc");
        fs::write(&target, &old).unwrap();
        let disk = Failing { fault, at, step: Cell::new(0), is_dead: Cell::new(false) };
        let before = (care == Care::Durable).then_some(old.as_slice());
        let done = put(&disk, &target, care, before, |out| out.write_all(&new));
        let context = format!("{fault:?} at step {at}: {done:?}");
        let now = fs::read(&target).unwrap();
        assert!(now == old || now == new, "{context}");
        if done.is_ok() {
            assert!(now == new, "{context}");
        }
        if must_be_whole {
            assert!(done.is_ok(), "{context}");
        }
        // A process that died leaves its file; the next one that writes to the folder takes it away.
        let is_dead = matches!(fault, Fault::CrashBefore | Fault::CrashAfter);
        if is_dead {
            leftovers::clean(folder.path(), SystemTime::now());
            assert!(names(folder.path()).len() <= 2, "{context}");
            let later = SystemTime::now() + leftovers::FORGOTTEN_AFTER + Duration::from_secs(1);
            leftovers::clean(folder.path(), later);
        }
        assert_eq!(names(folder.path()), ["part.nc"], "{context}");
    }
}

#[test]
fn a_step_that_fails_leaves_the_old_file_or_the_new_one() {
    for care in [Care::Durable, Care::Quick] {
        check_replacement(Fault::Error, care, false);
        check_replacement(Fault::Full, care, false);
    }
}

#[test]
fn writes_that_are_interrupted_or_short_go_on() {
    for care in [Care::Durable, Care::Quick] {
        check_replacement(Fault::Interrupted, care, true);
        check_replacement(Fault::Short, care, true);
    }
}

#[test]
fn a_process_that_dies_leaves_the_old_file_or_the_new_one() {
    for care in [Care::Durable, Care::Quick] {
        check_replacement(Fault::CrashBefore, care, false);
        check_replacement(Fault::CrashAfter, care, false);
    }
}

#[test]
fn a_new_file_that_cannot_be_written_is_not_there() {
    for at in 0..STEPS {
        let folder = tempfile::tempdir().unwrap();
        let disk = Failing { fault: Fault::Error, at, step: Cell::new(0), is_dead: Cell::new(false) };
        let target = folder.path().join("out.json");
        let done = put(&disk, &target, Care::Durable, None, |out| out.write_all(b"text"));
        let expected: &[&str] = if done.is_ok() { &["out.json"] } else { &[] };
        assert_eq!(names(folder.path()), expected, "step {at}");
    }
}

#[test]
fn a_file_that_was_changed_in_the_meantime_is_left() {
    let folder = tempfile::tempdir().unwrap();
    let target = folder.path().join("part.nc");
    fs::write(&target, "theirs").unwrap();
    let done = super::instead_of(&target, b"ours", b"new");
    assert!(matches!(done, Err(Failure::Changed)), "{done:?}");
    assert_eq!(fs::read_to_string(&target).unwrap(), "theirs");
    assert_eq!(names(folder.path()), ["part.nc"]);
}

#[cfg(unix)]
#[test]
fn a_file_with_other_names_is_not_replaced() {
    let folder = tempfile::tempdir().unwrap();
    let target = folder.path().join("part.nc");
    fs::write(&target, "old").unwrap();
    fs::hard_link(&target, folder.path().join("other.nc")).unwrap();
    let done = super::instead_of(&target, b"old", b"new");
    assert!(matches!(done, Err(Failure::Refused(_))), "{done:?}");
    assert_eq!(fs::read_to_string(&target).unwrap(), "old");
}

#[cfg(unix)]
#[test]
fn permissions_are_kept_and_names_may_be_long() {
    use std::os::unix::fs::PermissionsExt as _;
    let folder = tempfile::tempdir().unwrap();
    let target = folder.path().join("n".repeat(255));
    fs::write(&target, "old").unwrap();
    fs::set_permissions(&target, fs::Permissions::from_mode(0o640)).unwrap();
    super::instead_of(&target, b"old", b"new").unwrap();
    assert_eq!(fs::metadata(&target).unwrap().permissions().mode() & 0o777, 0o640);
    assert_eq!(fs::read_to_string(&target).unwrap(), "new");
}

#[test]
fn other_files_with_such_names_are_not_removed() {
    let folder = tempfile::tempdir().unwrap();
    let later = SystemTime::now() + Duration::from_hours(48);
    for name in [".gcheck-1.tmp", ".gcheck-00000000000000zz.tmp", "gcheck-0000000000000000.tmp"] {
        fs::write(folder.path().join(name), "x").unwrap();
    }
    fs::write(folder.path().join(leftovers::name(7)), "x").unwrap();
    leftovers::clean(folder.path(), later);
    assert_eq!(names(folder.path()).len(), 3);
}

/// What changes files, and where it is called besides the layer: on folders, and on times of use.
#[test]
fn nothing_else_writes_files() {
    let source = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    let mut folders = vec![source.clone()];
    let mut writers = Vec::new();
    while let Some(folder) = folders.pop() {
        for entry in fs::read_dir(folder).unwrap() {
            let path = entry.unwrap().path();
            if path.is_dir() {
                folders.push(path);
                continue;
            }
            let text = fs::read_to_string(&path).unwrap();
            let code = text.split("#[cfg(test)]\nmod tests {").next().unwrap_or_default();
            let calls =
                ["fs::write(", "fs::rename(", "File::create", "create_new(", ".set_len(", "fs::copy("];
            if calls.iter().any(|call| code.contains(call)) {
                writers.push(path.strip_prefix(&source).unwrap().to_string_lossy().into_owned());
            }
        }
    }
    writers.sort();
    assert_eq!(writers, ["writing/disk.rs", "writing/tests.rs"]);
}
