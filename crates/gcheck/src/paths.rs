//! Paths as text: absolute, without `.` and `..`, and as people want to see them.
//!
//! Knows: components of paths, the current folder. Must not know: what is at a path.

use std::path::{Component, Path, PathBuf};

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
