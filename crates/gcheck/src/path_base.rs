//! The roots from which the formats of servers name files: what an option says, what a CI server says, the repositories.
//!
//! Knows: environment variables of CI servers, where a repository begins. Must not know: formats.

use std::collections::BTreeSet;
use std::env;
use std::path::{Path, PathBuf};

use gcheck_report::PathBase;

use crate::{Problem, paths};

/// Variables of CI servers that hold the folder of the repository.
const VARIABLES: [&str; 2] = ["CI_PROJECT_DIR", "GITHUB_WORKSPACE"];

/// The folder that an option names.
///
/// # Errors
/// When it is not a folder.
pub(crate) fn of_option(folder: &Path) -> Result<PathBase, Problem> {
    if !folder.is_dir() {
        let what = if folder.exists() { "is not a folder" } else { "does not exist" };
        return Err(
            Problem::with_file(folder, what).help("`--path-base` names the folder that paths begin at")
        );
    }
    Ok(from_here(&[paths::absolute(folder)]))
}

/// For each of these files the folder that the CI server names, if it holds the file; else the repository that holds it. A
/// folder that a server names and that does not hold a file is that of another job.
pub(crate) fn of_files<'f>(files: impl IntoIterator<Item = &'f Path>) -> PathBase {
    let named = VARIABLES.into_iter().filter_map(env::var_os).filter(|folder| !folder.is_empty());
    let mut roots: Vec<PathBuf> = Vec::new();
    for folder in named.map(|folder| paths::absolute(Path::new(&folder))) {
        // The folder that gcheck runs in is known by its real path.
        let real = folder.canonicalize().ok().filter(|real| *real != folder);
        roots.extend([Some(folder), real].into_iter().flatten());
    }
    let is_named = |folder: &Path| roots.iter().any(|root| folder.starts_with(root));
    let folders: BTreeSet<PathBuf> = { files.into_iter() }
        .filter_map(|file| paths::absolute(file).parent().map(Path::to_owned))
        .filter(|folder| !is_named(folder))
        .collect();
    let mut repositories: Vec<PathBuf> = folders.iter().filter_map(|folder| repository(folder)).collect();
    // The inner one of two counts.
    repositories.sort_by_key(|folder| std::cmp::Reverse(folder.components().count()));
    repositories.dedup();
    roots.extend(repositories);
    from_here(&roots)
}

fn from_here(roots: &[PathBuf]) -> PathBase {
    let here = paths::absolute(Path::new("."));
    PathBase { roots: roots.iter().map(|root| paths::shown(root)).collect(), here: paths::shown(&here) }
}

fn repository(folder: &Path) -> Option<PathBuf> {
    folder.ancestors().find(|folder| folder.join(".git").exists()).map(Path::to_owned)
}
