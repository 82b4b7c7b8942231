//! Paths from the root of a repository, for servers that know files by them.
//!
//! Knows: paths as text. Must not know: the disk, the environment, where a repository begins.

use std::borrow::Cow;

/// The folder that a server calls the root, and the one that paths of a report are relative to; both absolute, with slashes.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct PathBase {
    /// The root.
    pub base: String,
    /// Where gcheck runs.
    pub here: String,
}

impl PathBase {
    /// The path from the root; as it is, where it leads out of it.
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
        let base: Vec<&str> = self.base.split('/').filter(|part| !part.is_empty()).collect();
        match parts.strip_prefix(base.as_slice()) {
            Some(rest) if !rest.is_empty() => Cow::Owned(rest.join("/")),
            _ => Cow::Borrowed(path),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::PathBase;

    #[test]
    fn a_path_is_from_the_root_wherever_gcheck_runs() {
        let base = PathBase { base: "/srv/repo".to_owned(), here: "/srv/repo/sub".to_owned() };
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
        let windows = PathBase { base: "C:/repo".to_owned(), here: "C:/repo/sub".to_owned() };
        assert_eq!(windows.rooted("C:/repo/a.nc"), "a.nc");
        assert_eq!(windows.rooted("a.nc"), "sub/a.nc");
    }
}
