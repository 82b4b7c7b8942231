//! Paths from the root of a repository, for servers that know files by them.
//!
//! Knows: paths as text. Must not know: the disk, the environment, where a repository begins.

use std::borrow::Cow;

/// The folders that a server may call the root, and the one that paths of a report are relative to; all absolute, with
/// slashes.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct PathBase {
    /// The roots: a file is named from the first one that holds it.
    pub roots: Vec<String>,
    /// Where gcheck runs.
    pub here: String,
}

impl PathBase {
    /// The path from its root; as it is, where it is in none of them.
    pub(crate) fn rooted<'p>(&self, path: &'p str) -> Cow<'p, str> {
        let is_absolute = path.starts_with('/') || matches!(path.as_bytes(), [_, b':', b'/', ..]);
        let whole = if is_absolute { path.to_owned() } else { format!("{}/{path}", self.here) };
        let mut parts: Vec<&str> = Vec::new();
        for part in whole.split('/') {
            match part {
                "" | "." => {}
                ".." => {
                    parts.pop();
                }
                part => parts.push(part),
            }
        }
        let below = |root: &String| {
            let root: Vec<&str> = root.split('/').filter(|part| !part.is_empty()).collect();
            parts.strip_prefix(root.as_slice()).filter(|rest| !rest.is_empty()).map(|rest| rest.join("/"))
        };
        self.roots.iter().find_map(below).map_or(Cow::Borrowed(path), Cow::Owned)
    }
}

#[cfg(test)]
mod tests {
    use super::PathBase;

    #[test]
    fn a_path_is_from_the_root_wherever_gcheck_runs() {
        let base = PathBase { roots: vec!["/srv/repo".to_owned()], here: "/srv/repo/sub".to_owned() };
        for (path, expected) in [
            ("w.nc", "sub/w.nc"),
            ("./w.nc", "sub/w.nc"),
            ("../w.nc", "w.nc"),
            ("/srv/repo/other/w.nc", "other/w.nc"),
            ("../../elsewhere/w.nc", "../../elsewhere/w.nc"),
            ("/srv/repository/w.nc", "/srv/repository/w.nc"),
        ] {
            assert_eq!(base.rooted(path), expected, "{path}");
        }
        let windows = PathBase { roots: vec!["C:/repo".to_owned()], here: "C:/repo/sub".to_owned() };
        assert_eq!(windows.rooted("C:/repo/a.nc"), "a.nc");
        assert_eq!(windows.rooted("a.nc"), "sub/a.nc");
    }

    #[test]
    fn a_file_is_named_from_the_first_root_that_holds_it() {
        let roots = ["/srv/repo/vendored", "/srv/repo", "/srv/other"].map(str::to_owned).to_vec();
        let base = PathBase { roots, here: "/srv".to_owned() };
        for (path, expected) in [
            ("repo/a.nc", "a.nc"),
            ("repo/vendored/a.nc", "a.nc"),
            ("other/sub/a.nc", "sub/a.nc"),
            ("loose/a.nc", "loose/a.nc"),
        ] {
            assert_eq!(base.rooted(path), expected, "{path}");
        }
    }
}
