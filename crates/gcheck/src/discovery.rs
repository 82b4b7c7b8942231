//! Which files are checked: those named, and the programs in folders.
//!
//! Knows: file names of programs, ignore files, the `[files]` table. Must not know: what is in a file.

use std::collections::BTreeSet;
use std::path::{Component, Path, PathBuf};

use ignore::WalkBuilder;

use crate::config::{Configs, PathPattern};
use crate::{Problem, paths, reading};

/// Extensions of part programs, lower case.
pub(crate) const EXTENSIONS: [&str; 13] =
    ["nc", "ngc", "cnc", "tap", "eia", "ncf", "gcode", "iso", "din", "prg", "mpf", "spf", "min"];

/// What was found.
#[derive(Debug, Default)]
pub(crate) struct Found {
    /// Programs, in the order of the paths given and sorted within a folder, each once.
    pub(crate) files: Vec<PathBuf>,
    /// What could not be looked at.
    pub(crate) problems: Vec<Problem>,
}

/// Is this the name of a part program: `part.nc`, `O1234`?
pub(crate) fn is_program_name(path: &Path) -> bool {
    let extension = path.extension().map(|e| e.to_string_lossy().to_ascii_lowercase());
    match extension {
        Some(extension) => EXTENSIONS.contains(&extension.as_str()),
        None => path.file_name().is_some_and(|name| {
            let name = name.to_string_lossy();
            let digits = name.strip_prefix(['O', 'o']).unwrap_or_default();
            !digits.is_empty() && digits.bytes().all(|b| b.is_ascii_digit())
        }),
    }
}

/// Looks at each path: a file is taken whatever its name, a folder is walked.
pub(crate) fn find(given: &[PathBuf], configs: &mut Configs) -> Found {
    let mut found = Found::default();
    let mut seen = BTreeSet::new();
    for path in given {
        if path.is_dir() {
            walk(path, configs, &mut found, &mut seen);
        } else if path.exists() {
            add(path.clone(), &mut found, &mut seen);
        } else if is_pattern(path) {
            fit(path, &mut found, &mut seen);
        } else {
            found.problems.push(Problem::with_file(path, "no such file or folder"));
        }
    }
    found
}

/// The paths that a file lists, a line each, or each up to a NUL where there is one; `-` is standard input.
///
/// # Errors
/// The list cannot be read.
pub(crate) fn listed(list: &Path) -> Result<Vec<PathBuf>, Problem> {
    let source = if paths::is_standard_input(list) {
        reading::standard_input(Path::new("stdin"))?
    } else {
        reading::file(list)?
    };
    let text = source.text();
    let names: Vec<&str> = if text.contains('\0') {
        text.split('\0').collect()
    } else {
        text.split(['\n', '\r']).map(str::trim).collect()
    };
    Ok(names.into_iter().filter(|name| !name.is_empty()).map(PathBuf::from).collect())
}

/// Does the path hold a character of patterns? Shells expand patterns where they fit; some shells, and quotes, leave them.
pub(crate) fn is_pattern(path: &Path) -> bool {
    path.to_string_lossy().contains(['*', '?', '[', '{'])
}

/// What is in a folder and below it, but for what ignore files name.
fn entries(folder: &Path) -> impl Iterator<Item = Result<ignore::DirEntry, Problem>> {
    let mut builder = WalkBuilder::new(folder);
    // Links are not followed, so a loop of them is never entered.
    builder.follow_links(false).require_git(false).add_custom_ignore_filename(".gcheckignore");
    let unwalkable = |error| Problem::new(format!("cannot look into a folder: {error}"));
    builder.build().map(move |entry| entry.map_err(unwalkable))
}

/// Takes the files that fit a pattern, whatever their names, as a shell would.
fn fit(pattern: &Path, found: &mut Found, seen: &mut BTreeSet<PathBuf>) {
    let is_plain = |part: &Component<'_>| !is_pattern(Path::new(part));
    let base: PathBuf = pattern.components().take_while(is_plain).collect();
    let rest: PathBuf = pattern.components().skip_while(is_plain).collect();
    let folder = if base.as_os_str().is_empty() { Path::new(".") } else { &base };
    // From the root of the pattern, so that `*.nc` does not fit in every folder.
    let glob = format!("/{}", paths::shown(&rest));
    let matcher = match PathPattern::new(&paths::absolute(folder), &glob) {
        Ok(matcher) => matcher,
        Err(reason) => {
            let message = format!("no such file, and as a pattern it cannot be read: {reason}");
            found.problems.push(Problem::with_file(pattern, message));
            return;
        }
    };
    let mut fitting = Vec::new();
    for entry in entries(folder) {
        match entry.map(ignore::DirEntry::into_path) {
            Ok(path) if path.is_file() && matcher.fits(&paths::absolute(&path)) => fitting.push(path),
            Ok(_) => {}
            Err(problem) => found.problems.push(problem),
        }
    }
    if fitting.is_empty() {
        found.problems.push(Problem::with_file(pattern, "no file fits this pattern"));
    }
    fitting.sort();
    for path in fitting {
        let path = path.strip_prefix(".").map_or_else(|_| path.clone(), Path::to_owned);
        add(path, found, seen);
    }
}

/// Refuses to write to a link that leads out of what was given: the folders, and those in which the files are.
///
/// Others' folders may hold such links, and what they lead to is not theirs to change.
///
/// # Errors
/// The problem that says where the link leads.
pub(crate) fn refuse_to_leave(path: &Path, given: &[PathBuf]) -> Result<(), Problem> {
    let folder = |path: &PathBuf| {
        let parent = || path.parent().filter(|parent| !parent.as_os_str().is_empty());
        if path.is_dir() { path.clone() } else { parent().unwrap_or(Path::new(".")).to_owned() }
    };
    let folders: Vec<PathBuf> = given.iter().map(folder).collect();
    let Some(target) = paths::leads_out(path, &folders) else { return Ok(()) };
    let message =
        format!("is a link that leads out of the folder, to {}; it is not changed", paths::shown(&target));
    Err(Problem::with_file(path, message).help("name that file itself, or exclude the link"))
}

fn add(path: PathBuf, found: &mut Found, seen: &mut BTreeSet<PathBuf>) {
    if seen.insert(paths::absolute(&path)) {
        found.files.push(path);
    }
}

fn walk(folder: &Path, configs: &mut Configs, found: &mut Found, seen: &mut BTreeSet<PathBuf>) {
    let mut programs = Vec::new();
    for entry in entries(folder) {
        match entry {
            Ok(entry)
                if entry
                    .file_type()
                    .is_some_and(|t| t.is_file() || (t.is_symlink() && entry.path().is_file())) =>
            {
                let path = entry.into_path();
                match configs.of_file(&path) {
                    Ok(config) if config.wants(&path, is_program_name(&path)) => programs.push(path),
                    // A broken configuration is reported once, by the file that needs it.
                    Err(problem) if is_program_name(&path) => found.problems.push(problem),
                    Ok(_) | Err(_) => {}
                }
            }
            Ok(_) => {}
            Err(problem) => found.problems.push(problem),
        }
    }
    // Without programs nobody else would read it, and its author would think it right.
    if programs.is_empty()
        && let Err(problem) = configs.of_folder(folder)
    {
        found.problems.push(problem);
    }
    programs.sort();
    for path in programs {
        add(path, found, seen);
    }
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use super::is_program_name;

    #[test]
    fn programs_are_known_by_extension_or_number() {
        for name in ["a.nc", "A.NC", "b.Gcode", "O1234", "o7", "x/O0001"] {
            assert!(is_program_name(Path::new(name)), "{name}");
        }
        for name in ["a.txt", "O", "OK", "O12a", "nc", ".nc", "1234"] {
            assert!(!is_program_name(Path::new(name)), "{name}");
        }
    }
}
