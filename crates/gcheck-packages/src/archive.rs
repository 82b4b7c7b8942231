//! The archive of a release: the binary, its texts and completions, in one folder.
//!
//! Knows: what is in it, and that `cargo binstall`, the installers, Homebrew, Scoop and winget read it. Must not know:
//! these.

use crate::Build;
use crate::container::{Entry, Package, tar_gz, zip};

/// Packs the archive.
///
/// # Errors
/// When packing fails.
pub fn archive(build: &Build<'_>) -> anyhow::Result<Package> {
    let Build { target, papers, .. } = build;
    let folder = target.stem(build.version);
    let mut entries = vec![
        Entry::text(format!("{folder}/CHANGELOG.md"), papers.changelog.as_str()),
        Entry::text(format!("{folder}/README.md"), papers.readme.as_str()),
    ];
    entries.extend(papers.licences(&folder));
    for (shell, script) in &papers.completions {
        entries.push(Entry::text(format!("{folder}/completions/gcheck.{shell}"), script.as_str()));
    }
    entries.push(Entry::program(format!("{folder}/{}", target.binary_name()), build.binary));
    let bytes =
        if target.is_windows() { zip(&entries, build.effort)? } else { tar_gz(&entries, build.effort)? };
    Ok(Package { name: target.archive_name(build.version), bytes })
}
