//! Files in one file: tar with gzip, and zip.
//!
//! Knows: these two forms, without times and owners, so that the same files give the same bytes. Must not know: what is
//! in the files.

use std::collections::BTreeSet;
use std::io::{Cursor, Write};

use flate2::Compression;
use flate2::write::GzEncoder;
use zip::write::SimpleFileOptions;
use zip::{CompressionMethod, DateTime, ZipWriter};

/// A package: a file of a release.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Package {
    /// Its file name.
    pub name: String,
    /// What is in it.
    pub bytes: Vec<u8>,
}

/// A file in a package.
#[derive(Debug, Clone)]
pub(crate) struct Entry {
    /// From the root of the package, with `/`.
    pub(crate) path: String,
    pub(crate) bytes: Vec<u8>,
    pub(crate) is_program: bool,
}

impl Entry {
    pub(crate) fn text(path: impl Into<String>, text: impl Into<Vec<u8>>) -> Self {
        Self { path: path.into(), bytes: text.into(), is_program: false }
    }

    pub(crate) fn program(path: impl Into<String>, bytes: impl Into<Vec<u8>>) -> Self {
        Self { path: path.into(), bytes: bytes.into(), is_program: true }
    }

    fn mode(&self) -> u32 {
        if self.is_program { 0o755 } else { 0o644 }
    }
}

/// Packs files as `.tar.gz`, in this order.
pub(crate) fn tar_gz(entries: &[Entry], effort: u32) -> anyhow::Result<Vec<u8>> {
    let mut tar = tar::Builder::new(GzEncoder::new(Vec::new(), Compression::new(effort)));
    entries.iter().try_for_each(|entry| append(&mut tar, entry))?;
    Ok(tar.into_inner()?.finish()?)
}

/// Packs files as `.tar.gz`, each folder before what is in it: dpkg makes no folder that the package does not list.
pub(crate) fn tar_gz_with_folders(entries: &[Entry], effort: u32) -> anyhow::Result<Vec<u8>> {
    let mut tar = tar::Builder::new(GzEncoder::new(Vec::new(), Compression::new(effort)));
    let mut known = BTreeSet::new();
    for entry in entries {
        for (at, _) in entry.path.match_indices('/') {
            let folder = entry.path.get(..=at).unwrap_or_default();
            if known.insert(folder) {
                let mut header = tar::Header::new_gnu();
                header.set_size(0);
                header.set_mode(0o755);
                header.set_entry_type(tar::EntryType::Directory);
                tar.append_data(&mut header, folder, [].as_slice())?;
            }
        }
        append(&mut tar, entry)?;
    }
    Ok(tar.into_inner()?.finish()?)
}

fn append(tar: &mut tar::Builder<impl Write>, entry: &Entry) -> anyhow::Result<()> {
    let mut header = tar::Header::new_gnu();
    header.set_size(entry.bytes.len() as u64);
    header.set_mode(entry.mode());
    header.set_entry_type(tar::EntryType::Regular);
    Ok(tar.append_data(&mut header, &entry.path, entry.bytes.as_slice())?)
}

/// Packs files as `.zip`, in this order.
pub(crate) fn zip(entries: &[Entry], effort: u32) -> anyhow::Result<Vec<u8>> {
    let mut zip = ZipWriter::new(Cursor::new(Vec::new()));
    for entry in entries {
        let options = SimpleFileOptions::default()
            .compression_method(CompressionMethod::Deflated)
            .compression_level(Some(i64::from(effort)))
            // The first day that a zip can say.
            .last_modified_time(DateTime::default())
            .unix_permissions(entry.mode());
        zip.start_file(entry.path.as_str(), options)?;
        zip.write_all(&entry.bytes)?;
    }
    Ok(zip.finish()?.into_inner())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_same_files_give_the_same_bytes() {
        let entries = [Entry::text("a/readme", "text"), Entry::program("a/run", [7; 100])];
        assert_eq!(tar_gz(&entries, 6).unwrap(), tar_gz(&entries, 6).unwrap());
        assert_eq!(zip(&entries, 6).unwrap(), zip(&entries, 6).unwrap());
    }

    #[test]
    fn programs_can_run_and_texts_cannot() {
        let entries = [Entry::text("readme", "text"), Entry::program("run", "x")];
        let bytes = tar_gz(&entries, 1).unwrap();
        let mut tar = tar::Archive::new(flate2::read::GzDecoder::new(bytes.as_slice()));
        let modes: Vec<u32> = tar.entries().unwrap().map(|e| e.unwrap().header().mode().unwrap()).collect();
        assert_eq!(modes, [0o644, 0o755]);
        let mut zip = zip::ZipArchive::new(Cursor::new(zip(&entries, 1).unwrap())).unwrap();
        let modes: Vec<u32> = (0..2).map(|i| zip.by_index(i).unwrap().unix_mode().unwrap() & 0o777).collect();
        assert_eq!(modes, [0o644, 0o755]);
    }
}
