//! The VS Code extension with its server inside, for one system.
//!
//! Knows: how a VSIX names its system, and where the extension looks for its server. Must not know: how the extension is
//! built.

use std::io::{Cursor, Read as _};

use anyhow::{Context as _, ensure};
use zip::ZipArchive;

use crate::Build;
use crate::container::{Entry, Package, zip};

const MANIFEST: &str = "extension.vsixmanifest";
const TYPES: &str = "[Content_Types].xml";

/// Puts the binary into an extension that was packed without one (`vsce package --no-dependencies`).
///
/// # Errors
/// When `universal` is not such an extension, or has a server already.
pub fn vsix(build: &Build<'_>, universal: &[u8]) -> anyhow::Result<Package> {
    let Build { target, version, .. } = build;
    let mut archive = ZipArchive::new(Cursor::new(universal)).context("the extension is not a VSIX")?;
    let mut entries = Vec::new();
    for at in 0..archive.len() {
        let mut file = archive.by_index(at)?;
        let path = file.name()?.into_owned();
        ensure!(!path.starts_with("extension/server/"), "the extension has a server already: {path}");
        let mut bytes = Vec::new();
        file.read_to_end(&mut bytes)?;
        let bytes = match path.as_str() {
            MANIFEST => named(&bytes, target.vscode)?.into_bytes(),
            TYPES if target.is_windows() => with_programs(&bytes)?.into_bytes(),
            _ => bytes,
        };
        entries.push(Entry { path, bytes, is_program: false });
    }
    ensure!(entries.iter().any(|entry| entry.path == MANIFEST), "the extension has no {MANIFEST}");
    entries.push(Entry::program(format!("extension/server/{}", target.binary_name()), build.binary));
    let name = format!("gcheck-vscode-v{version}-{}.vsix", target.vscode);
    Ok(Package { name, bytes: zip(&entries, build.effort)? })
}

/// The manifest with the name of the system, by which VS Code and its registries choose.
fn named(manifest: &[u8], system: &str) -> anyhow::Result<String> {
    let text = String::from_utf8(manifest.to_vec())?;
    let (before, after) = text.split_once("<Identity ").context("the manifest has no identity")?;
    ensure!(!after.contains("TargetPlatform="), "the extension is for one system already");
    Ok(format!("{before}<Identity TargetPlatform=\"{system}\" {after}"))
}

/// The list of types with that of Windows programs.
fn with_programs(types: &[u8]) -> anyhow::Result<String> {
    let text = String::from_utf8(types.to_vec())?;
    let line = "<Default Extension=\".exe\" ContentType=\"application/octet-stream\"/></Types>";
    Ok(text.replace("</Types>", line))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Names, Papers, Target};

    fn universal(files: &[(&str, &str)]) -> Vec<u8> {
        let entries: Vec<Entry> = files.iter().map(|(path, text)| Entry::text(*path, *text)).collect();
        zip(&entries, 1).unwrap()
    }

    fn with_server(triple: &str, universal: &[u8]) -> anyhow::Result<Package> {
        let (names, papers) = (Names::read().unwrap(), Papers::default());
        let target = Target::named(triple).unwrap();
        vsix(
            &Build { names: &names, version: "1.2.3", target, binary: b"binary", papers: &papers, effort: 1 },
            universal,
        )
    }

    fn read(package: &Package, path: &str) -> String {
        let mut archive = ZipArchive::new(Cursor::new(package.bytes.as_slice())).unwrap();
        let mut text = String::new();
        archive.by_name(path).unwrap().read_to_string(&mut text).unwrap();
        text
    }

    const EXTENSION: [(&str, &str); 3] = [
        (MANIFEST, "<PackageManifest><Metadata><Identity Id=\"gcheck\" /></Metadata></PackageManifest>"),
        (TYPES, "<Types></Types>"),
        ("extension/package.json", "{}"),
    ];

    #[test]
    fn the_server_is_where_the_extension_looks_for_it() {
        let package = with_server("x86_64-unknown-linux-musl", &universal(&EXTENSION)).unwrap();
        assert_eq!(package.name, "gcheck-vscode-v1.2.3-linux-x64.vsix");
        assert_eq!(read(&package, "extension/server/gcheck"), "binary");
        assert_eq!(read(&package, "extension/package.json"), "{}");
        assert!(read(&package, MANIFEST).contains("<Identity TargetPlatform=\"linux-x64\" Id=\"gcheck\" />"));
        let windows = with_server("x86_64-pc-windows-msvc", &universal(&EXTENSION)).unwrap();
        assert_eq!(read(&windows, "extension/server/gcheck.exe"), "binary");
        assert!(read(&windows, TYPES).contains(".exe"));
    }

    #[test]
    fn what_is_not_an_extension_without_a_server_is_refused() {
        let error = |files: &[(&str, &str)]| {
            with_server("x86_64-unknown-linux-musl", &universal(files)).unwrap_err().to_string()
        };
        assert_eq!(error(&EXTENSION[1..]), "the extension has no extension.vsixmanifest");
        assert_eq!(error(&[(MANIFEST, "<x/>")]), "the manifest has no identity");
        assert_eq!(
            error(&[EXTENSION[0], ("extension/server/gcheck", "old")]),
            "the extension has a server already: extension/server/gcheck"
        );
        assert!(with_server("x86_64-unknown-linux-musl", b"no zip").is_err());
    }
}
