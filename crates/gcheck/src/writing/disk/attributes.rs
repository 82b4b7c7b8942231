//! Extended attributes of a file.
//!
//! Knows: system calls. Must not know: what any attribute says.

use std::ffi::{OsStr, OsString};
use std::fs::File;
use std::io;
use std::os::unix::ffi::{OsStrExt as _, OsStringExt as _};
use std::path::Path;

use rustix::fs::{XattrFlags, fsetxattr, getxattr, listxattr};
use rustix::io::Errno;

/// Attributes that the system gives every file by itself, or that only the superuser may set.
const OF_THE_SYSTEM: [&str; 3] = ["security.", "trusted.", "com.apple.provenance"];

/// A longer answer is refused: a file with it is not replaced.
const MOST_BYTES: usize = 16 << 20;

/// The attributes of a file, as far as they are its own. A file system without any has none.
///
/// # Errors
/// When they cannot be read.
pub(super) fn of(path: &Path) -> io::Result<Vec<(OsString, Vec<u8>)>> {
    let names = match sized(|buffer| listxattr(path, buffer)) {
        Ok(names) => names,
        Err(Errno::NOTSUP | Errno::NOSYS | Errno::ACCESS | Errno::PERM) => return Ok(Vec::new()),
        Err(error) => return Err(error.into()),
    };
    let is_own =
        |name: &&[u8]| !name.is_empty() && !OF_THE_SYSTEM.iter().any(|own| name.starts_with(own.as_bytes()));
    let mut attributes = Vec::new();
    for name in names.split(|byte| *byte == 0).filter(is_own) {
        match sized(|buffer| getxattr(path, OsStr::from_bytes(name), buffer)) {
            Ok(value) => attributes.push((OsString::from_vec(name.to_vec()), value)),
            // Gone between the two calls: the file has none of that name.
            #[cfg(target_os = "linux")]
            Err(Errno::NODATA) => {}
            Err(error) => return Err(error.into()),
        }
    }
    Ok(attributes)
}

/// Gives a file these attributes.
///
/// # Errors
/// When it cannot have one of them.
pub(super) fn give(file: &File, attributes: &[(OsString, Vec<u8>)]) -> io::Result<()> {
    for (name, value) in attributes {
        fsetxattr(file, name.as_os_str(), value, XattrFlags::empty())?;
    }
    Ok(())
}

/// All bytes of an answer of unknown length.
fn sized(ask: impl Fn(&mut [u8]) -> Result<usize, Errno>) -> Result<Vec<u8>, Errno> {
    // Linux gives no more than this; other systems may.
    let mut bytes = vec![0; 64 << 10];
    loop {
        match ask(&mut bytes) {
            Ok(length) => {
                bytes.truncate(length);
                return Ok(bytes);
            }
            Err(Errno::RANGE) if bytes.len() < MOST_BYTES => bytes.resize(bytes.len() * 2, 0),
            Err(error) => return Err(error),
        }
    }
}

#[cfg(test)]
mod tests {
    use std::ffi::OsString;
    use std::fs::{self, File};

    use super::{give, of};

    #[test]
    fn a_replaced_file_keeps_its_attributes() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.nc");
        fs::write(&path, "G0\n").unwrap();
        let attribute = (OsString::from("user.origin"), b"the shop".to_vec());
        if give(&File::open(&path).unwrap(), std::slice::from_ref(&attribute)).is_err() {
            let remedy = "set TMPDIR to a folder on another file system";
            gcheck_testkit::skips::skip(
                "a_replaced_file_keeps_its_attributes",
                "extended attributes",
                remedy,
            );
            return;
        }
        crate::writing::instead_of(&path, b"G0\n", b"G00\n").unwrap();
        assert_eq!(fs::read_to_string(&path).unwrap(), "G00\n");
        assert_eq!(of(&path).unwrap(), [attribute]);
    }
}
