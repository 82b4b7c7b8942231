//! The operations of a file system that a replacement is made of.
//!
//! Knows: system calls. Must not know: their order, what is done when one fails.

use std::ffi::OsString;
use std::fs::{self, File, Metadata, Permissions};
use std::io::{self, Write as _};
use std::path::Path;

use super::failure::Failure;

/// A file system, real or failing.
pub(super) trait Disk {
    /// A file that is being written.
    type File;

    /// What must be kept of a file; `None` when there is none.
    fn about(&self, path: &Path) -> io::Result<Option<Old>>;
    /// All of a file.
    fn read(&self, path: &Path) -> io::Result<Vec<u8>>;
    /// A new file, which must not be there yet.
    fn create(&self, path: &Path) -> io::Result<Self::File>;
    /// Some bytes, as [`io::Write::write`].
    fn write(&self, file: &mut Self::File, bytes: &[u8]) -> io::Result<usize>;
    /// Gives a file what the old one has.
    fn keep(&self, file: &Self::File, old: &Old) -> Result<(), Failure>;
    /// The file's bytes onto the disk.
    fn sync(&self, file: &Self::File) -> io::Result<()>;
    /// A new name, in the place of another file.
    fn rename(&self, from: &Path, to: &Path) -> io::Result<()>;
    /// The folder's names onto the disk.
    fn sync_folder(&self, folder: &Path) -> io::Result<()>;
    /// Takes a file away.
    fn remove(&self, path: &Path) -> io::Result<()>;
}

/// What must be kept of a file.
#[derive(Debug, Clone)]
pub(super) struct Old {
    permissions: Permissions,
    #[cfg(unix)]
    owner: (u32, u32),
    #[cfg(unix)]
    names: u64,
    /// Extended attributes by name; access control lists are among them.
    attributes: Vec<(OsString, Vec<u8>)>,
}

impl Old {
    fn of(data: &Metadata) -> Self {
        #[cfg(unix)]
        use std::os::unix::fs::MetadataExt as _;
        Self {
            permissions: data.permissions(),
            #[cfg(unix)]
            owner: (data.uid(), data.gid()),
            #[cfg(unix)]
            names: data.nlink(),
            attributes: Vec::new(),
        }
    }

    /// Would other names of the file keep the old text?
    pub(super) fn has_other_names(&self) -> bool {
        #[cfg(unix)]
        {
            self.names > 1
        }
        #[cfg(not(unix))]
        {
            false
        }
    }
}

#[cfg(any(target_os = "linux", target_vendor = "apple"))]
mod attributes;

/// Systems whose files have no such attributes, or where nobody uses them.
#[cfg(not(any(target_os = "linux", target_vendor = "apple")))]
mod attributes {
    use super::{File, OsString, Path, io};

    pub(super) fn of(_: &Path) -> io::Result<Vec<(OsString, Vec<u8>)>> {
        Ok(Vec::new())
    }

    pub(super) fn give(_: &File, _: &[(OsString, Vec<u8>)]) -> io::Result<()> {
        Ok(())
    }
}

/// The system's own.
#[derive(Debug)]
pub(super) struct System;

impl Disk for System {
    type File = File;

    fn about(&self, path: &Path) -> io::Result<Option<Old>> {
        match fs::metadata(path) {
            Ok(data) => Ok(Some(Old { attributes: attributes::of(path)?, ..Old::of(&data) })),
            Err(error) if error.kind() == io::ErrorKind::NotFound => Ok(None),
            Err(error) => Err(error),
        }
    }

    fn read(&self, path: &Path) -> io::Result<Vec<u8>> {
        fs::read(path)
    }

    fn create(&self, path: &Path) -> io::Result<File> {
        File::options().write(true).create_new(true).open(path)
    }

    fn write(&self, file: &mut File, bytes: &[u8]) -> io::Result<usize> {
        file.write(bytes)
    }

    fn keep(&self, file: &File, old: &Old) -> Result<(), Failure> {
        #[cfg(unix)]
        {
            // Before the permissions: a new owner takes the set-user-id bit away.
            if Old::of(&file.metadata()?).owner != old.owner
                && std::os::unix::fs::fchown(file, Some(old.owner.0), Some(old.owner.1)).is_err()
            {
                return Err(Failure::Refused("it belongs to another user or group, which a new file cannot"));
            }
        }
        file.set_permissions(old.permissions.clone())?;
        // After the permissions: an access control list has its own idea of them.
        attributes::give(file, &old.attributes).map_err(|_| {
            Failure::Refused(
                "it has extended attributes or an access control list, which a new file cannot have",
            )
        })
    }

    fn sync(&self, file: &File) -> io::Result<()> {
        file.sync_all()
    }

    fn rename(&self, from: &Path, to: &Path) -> io::Result<()> {
        fs::rename(from, to)
    }

    fn sync_folder(&self, folder: &Path) -> io::Result<()> {
        let folder = if folder.as_os_str().is_empty() { Path::new(".") } else { folder };
        File::open(folder)?.sync_all()
    }

    fn remove(&self, path: &Path) -> io::Result<()> {
        fs::remove_file(path)
    }
}
