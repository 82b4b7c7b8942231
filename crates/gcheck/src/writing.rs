//! Writing files: each is the old one or the new one, whole, and no other file is left.
//!
//! Knows: the steps of a replacement, what a new file keeps of the old one, what is cleaned up. Must not know: what is
//! written, for whom.
//!
//! Everything that gcheck writes to a file goes through here: text is written to a temporary file in the same folder, which
//! then takes the name. The temporary file has a random name and is opened exclusively, so nobody can have put a link in its
//! place. The steps are those of [`Disk`]; tests let each of them fail in turn.

mod disk;
mod failure;
mod leftovers;
#[cfg(test)]
mod tests;

use std::collections::hash_map::RandomState;
use std::hash::BuildHasher as _;
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};

use disk::{Disk, Old, System};
pub(crate) use failure::Failure;
pub(crate) use leftovers::{is_temporary, remove_all};

/// Names that are tried before we believe that none is free.
const ATTEMPTS: usize = 16;

/// Writes a file, or replaces it with owner and permissions kept. When this returns, it is on the disk.
///
/// # Errors
/// The file is as it was then, and there is no other.
pub(crate) fn file(
    target: &Path,
    content: impl FnOnce(&mut dyn Write) -> io::Result<()>,
) -> Result<(), Failure> {
    put(&System, target, Care::Durable, None, content)
}

/// Replaces a file, if it still holds `before`.
///
/// # Errors
/// The file is as it was then, and there is no other.
pub(crate) fn instead_of(target: &Path, before: &[u8], after: &[u8]) -> Result<(), Failure> {
    put(&System, target, Care::Durable, Some(before), |out| out.write_all(after))
}

/// Writes a file that may be lost with the power, but is never half there.
pub(crate) fn quickly(target: &Path, bytes: &[u8]) -> io::Result<()> {
    put(&System, target, Care::Quick, None, |out| out.write_all(bytes)).map_err(|failure| match failure {
        Failure::System(error) => error,
        Failure::Refused(_) | Failure::Changed => io::Error::other(failure.to_string()),
    })
}

/// What a file is worth.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Care {
    /// It is a person's: it keeps owner and permissions, and is on the disk before its name is.
    Durable,
    /// It is ours, and can be made again.
    Quick,
}

fn put<D: Disk>(
    disk: &D,
    target: &Path,
    care: Care,
    before: Option<&[u8]>,
    content: impl FnOnce(&mut dyn Write) -> io::Result<()>,
) -> Result<(), Failure> {
    let old = if care == Care::Durable { disk.about(target)? } else { None };
    if old.as_ref().is_some_and(Old::has_other_names) {
        return Err(Failure::Refused("it has other names (hard links), which would keep the old text"));
    }
    let (temporary, mut file) = begin(disk, target)?;
    let written = write_and_name(disk, &temporary, &mut file, target, care, old.as_ref(), before, content);
    drop(file);
    if written.is_err() {
        // That the clean-up may fail as well changes nothing; the next run in the folder tries again.
        let _ = disk.remove(&temporary);
    }
    leftovers::done(&temporary);
    written
}

#[expect(clippy::too_many_arguments, reason = "the steps of one replacement, which share everything")]
fn write_and_name<D: Disk>(
    disk: &D,
    temporary: &Path,
    file: &mut D::File,
    target: &Path,
    care: Care,
    old: Option<&Old>,
    before: Option<&[u8]>,
    content: impl FnOnce(&mut dyn Write) -> io::Result<()>,
) -> Result<(), Failure> {
    let mut out = BufWriter::with_capacity(1 << 16, Filling { disk, file: &mut *file });
    content(&mut out)?;
    out.flush()?;
    drop(out);
    if care == Care::Durable {
        if let Some(old) = old {
            disk.keep(file, old)?;
        }
        disk.sync(file)?;
    }
    // As late as can be: between this look and the new name there is room for hardly anybody.
    if let Some(before) = before
        && disk.read(target)? != before
    {
        return Err(Failure::Changed);
    }
    disk.rename(temporary, target)?;
    if care == Care::Durable
        && let Some(folder) = target.parent()
    {
        // The file is the new one; that some systems cannot write down a folder at once changes nothing.
        let _ = disk.sync_folder(folder);
    }
    Ok(())
}

/// Opens a temporary file beside the target, so that the new name stays on one file system.
fn begin<D: Disk>(disk: &D, target: &Path) -> io::Result<(PathBuf, D::File)> {
    leftovers::clean_once(target.parent().unwrap_or(Path::new("")));
    let mut taken = None;
    for attempt in 0..ATTEMPTS {
        let temporary = target.with_file_name(leftovers::name(RandomState::new().hash_one(attempt)));
        leftovers::begun(&temporary);
        match disk.create(&temporary) {
            Ok(file) => return Ok((temporary, file)),
            Err(error) => {
                leftovers::done(&temporary);
                if error.kind() != io::ErrorKind::AlreadyExists {
                    return Err(error);
                }
                taken = Some(error);
            }
        }
    }
    Err(taken.unwrap_or_else(|| io::ErrorKind::AlreadyExists.into()))
}

/// Bytes on their way to a file.
struct Filling<'f, D: Disk> {
    disk: &'f D,
    file: &'f mut D::File,
}

impl<D: Disk> Write for Filling<'_, D> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.disk.write(self.file, bytes)
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}
