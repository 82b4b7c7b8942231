//! Paths as text: absolute, without `.` and `..`, and as people want to see them; and where links lead.
//!
//! Knows: components of paths, the current folder, links. Must not know: what is in a file.

use std::path::{Component, Path, PathBuf};

/// Does the path of a command line mean standard input, or standard output where it is written to?
pub(crate) fn is_standard_input(path: &Path) -> bool {
    path.as_os_str() == "-"
}

/// The path from the root, without `.` and `..`; links are not followed.
pub(crate) fn absolute(path: &Path) -> PathBuf {
    // The parent of `part.nc` is the empty path, which stands for the current folder.
    let path = if path.as_os_str().is_empty() { Path::new(".") } else { path };
    let path = std::path::absolute(path).unwrap_or_else(|_| path.to_owned());
    let mut clean = PathBuf::new();
    for component in path.components() {
        match component {
            Component::CurDir => {}
            Component::ParentDir => {
                clean.pop();
            }
            other => clean.push(other),
        }
    }
    clean
}

/// Is the path, as it is written, in a folder or below it?
pub(crate) fn is_below(path: &Path, folder: &Path) -> bool {
    absolute(path).starts_with(absolute(folder))
}

/// Where a link leads that leads out of all of these folders; `None` for what is not a link, or stays inside.
pub(crate) fn leads_out(path: &Path, folders: &[PathBuf]) -> Option<PathBuf> {
    if !path.symlink_metadata().is_ok_and(|data| data.is_symlink()) {
        return None;
    }
    let target = path.canonicalize().ok()?;
    let holds = |folder: &PathBuf| folder.canonicalize().is_ok_and(|folder| target.starts_with(folder));
    (!folders.iter().any(holds)).then_some(target)
}

/// The path as shown: without a leading `./`, with slashes on every system.
pub(crate) fn shown(path: &Path) -> String {
    let path = path.strip_prefix(".").ok().filter(|rest| !rest.as_os_str().is_empty()).unwrap_or(path);
    let text = path.to_string_lossy();
    if std::path::MAIN_SEPARATOR == '/' {
        text.into_owned()
    } else {
        text.replace(std::path::MAIN_SEPARATOR, "/")
    }
}

/// The path from the current folder where it lies in it, else as it is.
pub(crate) fn shown_from_here(path: &Path) -> String {
    let here = absolute(Path::new("."));
    let absolute = absolute(path);
    absolute.strip_prefix(&here).map_or_else(|_| shown(path), shown)
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use super::{absolute, shown};

    #[test]
    fn dots_are_resolved_without_looking_at_the_disk() {
        let here = absolute(Path::new("."));
        assert_eq!(absolute(Path::new("a/./b/../c")), here.join("a").join("c"));
        assert_eq!(absolute(Path::new("")), here);
    }

    #[test]
    fn the_current_folder_is_not_shown() {
        assert_eq!(shown(Path::new("./a/b.nc")), "a/b.nc");
        assert_eq!(shown(Path::new("../b.nc")), "../b.nc");
        assert_eq!(shown(Path::new(".")), ".");
    }
}
