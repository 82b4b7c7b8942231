//! The repository as a place: its root, its files, its packages.
//!
//! Knows: paths, `.gitignore`, `cargo metadata`. Must not know: which law is checked with them.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, ExitCode, ExitStatus};

use anyhow::{Context as _, bail};
use cargo_metadata::{CargoOpt, Metadata, MetadataCommand};
use ignore::WalkBuilder;

/// The root of the workspace.
pub(crate) fn root() -> &'static Path {
    let here = Path::new(env!("CARGO_MANIFEST_DIR"));
    here.ancestors().nth(2).unwrap_or(here)
}

/// A file of the repository that is text.
#[derive(Debug, Clone)]
pub(crate) struct TextFile {
    /// From the root, with `/`.
    pub(crate) path: String,
    /// The whole of it.
    pub(crate) text: String,
}

/// Every file that is or could be tracked, sorted by path; files that are not UTF-8 are left out.
pub(crate) fn text_files(root: &Path) -> anyhow::Result<Vec<TextFile>> {
    let mut files = Vec::new();
    // Not `git ls-files`: the laws hold in an exported source tree, too.
    let walk = WalkBuilder::new(root)
        .hidden(false)
        .require_git(false)
        .parents(false)
        .git_global(false)
        .filter_entry(|entry| entry.file_name() != ".git" && entry.file_name() != "node_modules")
        .build();
    for entry in walk {
        let entry = entry?;
        if !entry.file_type().is_some_and(|kind| kind.is_file()) {
            continue;
        }
        // Another process may delete what the walk has just listed.
        let Ok(bytes) = fs::read(entry.path()) else { continue };
        let Ok(text) = String::from_utf8(bytes) else { continue };
        files.push(TextFile { path: relative(root, entry.path()), text });
    }
    files.sort_by(|a, b| a.path.cmp(&b.path));
    Ok(files)
}

/// A path from the root, with `/` on every system.
pub(crate) fn relative(root: &Path, path: &Path) -> String {
    let path = path.strip_prefix(root).unwrap_or(path);
    path.iter().map(|part| part.to_string_lossy()).collect::<Vec<_>>().join("/")
}

/// The workspace's packages with their declared dependencies; reads manifests only.
pub(crate) fn members() -> anyhow::Result<Metadata> {
    metadata(MetadataCommand::new().no_deps())
}

/// The platform of this machine, as the compiler calls it.
pub(crate) fn host() -> anyhow::Result<String> {
    let version = Command::new("rustc").arg("-vV").output().context("rustc does not start")?;
    let version = String::from_utf8_lossy(&version.stdout).into_owned();
    let Some(host) = version.lines().find_map(|line| line.strip_prefix("host: ")) else {
        bail!("`rustc -vV` does not name the host");
    };
    Ok(host.to_owned())
}

/// The whole dependency graph of this machine's platform.
pub(crate) fn graph() -> anyhow::Result<Metadata> {
    let host = host()?;
    let graph = |options: &[&str]| {
        let options =
            ["--filter-platform", &host].into_iter().chain(options.iter().copied()).map(str::to_owned);
        metadata(
            MetadataCommand::new().features(CargoOpt::AllFeatures).other_options(options.collect::<Vec<_>>()),
        )
    };
    // Manifests for other platforms need not have been downloaded. Those of a feature that was never built may be missing.
    graph(&["--offline"]).or_else(|_| graph(&["--locked"]))
}

fn metadata(command: &mut MetadataCommand) -> anyhow::Result<Metadata> {
    Ok(command.manifest_path(root().join("Cargo.toml")).exec()?)
}

/// Every path from the root of a folder's files with an extension, sorted; empty if there is no such folder.
pub(crate) fn files_with_extension(folder: &Path, extension: &str) -> anyhow::Result<Vec<PathBuf>> {
    if !folder.is_dir() {
        return Ok(Vec::new());
    }
    let mut files = Vec::new();
    for entry in fs::read_dir(folder).with_context(|| folder.display().to_string())? {
        let path = entry?.path();
        if path.is_file() && path.extension().is_some_and(|e| e == extension) {
            files.push(path);
        }
    }
    files.sort();
    Ok(files)
}

/// The exit code of a child as our own.
pub(crate) fn exit_code(status: ExitStatus) -> ExitCode {
    let code = status.code().and_then(|code| u8::try_from(code).ok());
    code.map_or(ExitCode::FAILURE, ExitCode::from)
}
