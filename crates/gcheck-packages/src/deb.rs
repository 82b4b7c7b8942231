//! The Debian package.
//!
//! Knows: the layout of `.deb` files and where Debian puts completions. Must not know: repositories of packages.

use std::fmt::Write as _;

use anyhow::ensure;

use crate::Build;
use crate::container::{Entry, Package, tar_gz, tar_gz_with_folders};

/// Packs the package.
///
/// # Errors
/// When the target is not Linux, or packing fails.
pub fn deb(build: &Build<'_>) -> anyhow::Result<Package> {
    let Build { version, target, papers, effort, .. } = build;
    ensure!(!target.debian.is_empty(), "there is no Debian for `{}`", target.triple);
    let mut files = vec![
        Entry::program("./usr/bin/gcheck", build.binary),
        Entry::text("./usr/share/doc/gcheck/copyright", copyright(build)),
        Entry::text("./usr/share/doc/gcheck/CHANGELOG.md", papers.changelog.as_str()),
    ];
    let places = [
        ("bash", "./usr/share/bash-completion/completions/gcheck"),
        ("fish", "./usr/share/fish/vendor_completions.d/gcheck.fish"),
        ("zsh", "./usr/share/zsh/vendor-completions/_gcheck"),
    ];
    for (shell, place) in places {
        if let Some(script) = papers.completions.get(shell) {
            files.push(Entry::text(place, script.as_str()));
        }
    }
    let size: usize = files.iter().map(|file| file.bytes.len()).sum();
    let control = tar_gz(&[Entry::text("./control", control(build, size.div_ceil(1024)))], *effort)?;
    let data = tar_gz_with_folders(&files, *effort)?;
    let mut deb = ar::Builder::new(Vec::new());
    let members =
        [("debian-binary", b"2.0\n".as_slice()), ("control.tar.gz", &control), ("data.tar.gz", &data)];
    for (name, bytes) in members {
        let mut header = ar::Header::new(name.as_bytes().to_vec(), bytes.len() as u64);
        header.set_mode(0o100_644);
        deb.append(&header, bytes)?;
    }
    Ok(Package { name: format!("gcheck_{version}_{}.deb", target.debian), bytes: deb.into_inner()? })
}

/// `kilobytes` is what the files take on a disk.
fn control(build: &Build<'_>, kilobytes: usize) -> String {
    let Build { names, version, target, .. } = build;
    let mut text = format!(
        "Package: gcheck\n\
         Version: {version}\n\
         Architecture: {}\n\
         Maintainer: {}\n\
         Installed-Size: {kilobytes}\n\
         Section: devel\n\
         Priority: optional\n\
         Homepage: {}\n",
        target.debian,
        names.maintainer,
        names.url()
    );
    if target.needs_libc {
        let version = newest_libc(build.binary).map(|version| format!(" (>= {version})")).unwrap_or_default();
        // Writing into a string does not fail.
        let _ = writeln!(text, "Depends: libc6{version}");
    }
    text.push_str(
        "Description: checks CNC part programs (G-code)\n \
         Checks CNC part programs before they run on the machine:\n \
         a linter for the command line and CI, and a language server for editors.\n",
    );
    text
}

/// The newest version of the C library whose symbols a program needs: the highest name of a version in its table of names.
fn newest_libc(binary: &[u8]) -> Option<String> {
    let names = binary.split(|byte| *byte == 0).filter_map(|name| name.strip_prefix(b"GLIBC_"));
    let version = |name: &[u8]| -> Option<Vec<u32>> {
        std::str::from_utf8(name).ok()?.split('.').map(|part| part.parse().ok()).collect()
    };
    let newest = names.filter_map(version).max()?;
    Some(newest.iter().map(u32::to_string).collect::<Vec<_>>().join("."))
}

fn copyright(build: &Build<'_>) -> String {
    let Build { names, papers, .. } = build;
    format!(
        "Source: {}\nLicence: MIT or Apache-2.0, at your choice.\n\n{}\n\n{}",
        names.url(),
        papers.mit,
        papers.apache
    )
}

#[cfg(test)]
mod tests {
    use super::newest_libc;

    #[test]
    fn the_c_library_is_as_new_as_the_newest_symbol_that_is_needed() {
        let names = b"\x7FELF\0memcpy\0GLIBC_2.4\0GLIBC_2.35\0GLIBC_2.2.5\0GLIBC_PRIVATE\0libc.so.6\0";
        assert_eq!(newest_libc(names).as_deref(), Some("2.35"));
        assert_eq!(newest_libc(b"\x7FELF\0without a C library\0"), None);
    }
}
