//! Which files a message may quote.
//!
//! Knows: workspaces, links, names of files that hold secrets. Must not know: what is in a file.
//!
//! A configuration of somebody else may be a link to any file, or name one. What is wrong with that file is said with its
//! line, and the line goes to logs that everybody reads; so a file outside of the workspace is not quoted, and neither is a
//! hidden one inside, such as what version control keeps in `.git`.

use std::path::{Component, Path, PathBuf};

use crate::paths;

/// Marks the top folder of a workspace.
const TOP: &str = ".git";
/// The one hidden file that holds no secret: a configuration.
const OURS: &str = ".gcheck.toml";

/// The folders whose files a message may quote.
#[derive(Debug)]
pub(crate) struct Workspace {
    /// Without links.
    tops: Vec<PathBuf>,
}

impl Workspace {
    /// The workspaces of the current folder and of the folder that a file is in. A link counts as where it is, not as what it
    /// leads to.
    pub(crate) fn around(file: &Path) -> Self {
        let file = paths::absolute(file);
        let folders = [Some(paths::absolute(Path::new("."))), file.parent().map(Path::to_owned)];
        Self { tops: folders.into_iter().flatten().filter_map(|folder| top(&folder)).collect() }
    }

    /// The workspace of the current folder alone.
    pub(crate) fn here() -> Self {
        Self { tops: top(&paths::absolute(Path::new("."))).into_iter().collect() }
    }

    /// May a message show a line of this file?
    pub(crate) fn may_quote(&self, file: &Path) -> bool {
        let Ok(file) = file.canonicalize() else { return false };
        self.tops.iter().any(|top| file.strip_prefix(top).is_ok_and(|inside| !is_hidden(inside)))
    }
}

/// The folder at the top of the workspace that a folder is in, or the folder itself.
fn top(folder: &Path) -> Option<PathBuf> {
    let folder = folder.canonicalize().ok()?;
    let top = folder.ancestors().find(|ancestor| ancestor.join(TOP).exists());
    Some(top.unwrap_or(&folder).to_owned())
}

fn is_hidden(path: &Path) -> bool {
    let is_ours = path.file_name().is_some_and(|name| name == OURS);
    let folders = if is_ours { path.parent().unwrap_or(path) } else { path };
    folders.components().any(|part| match part {
        Component::Normal(name) => name.to_string_lossy().starts_with('.'),
        _ => true,
    })
}

#[cfg(test)]
mod tests {
    use std::fs;

    use super::Workspace;

    #[test]
    fn files_of_the_workspace_are_quoted_and_no_others() {
        let folder = tempfile::tempdir().unwrap();
        let path = |name: &str| folder.path().join(name);
        for name in ["shop/.git", "shop/lathe", "other"] {
            fs::create_dir_all(path(name)).unwrap();
        }
        for name in
            ["shop/lathe/gcheck.toml", "shop/.gcheck.toml", "shop/.git/config", "shop/.env", "other/secret"]
        {
            fs::write(path(name), "x").unwrap();
        }
        let workspace = Workspace::around(&path("shop/lathe/gcheck.toml"));
        let may = |name: &str| workspace.may_quote(&path(name));
        assert!(
            may("shop/lathe/gcheck.toml") && may("shop/.gcheck.toml") && may("shop/lathe/../.gcheck.toml")
        );
        assert!(
            !may("other/secret") && !may("shop/.git/config") && !may("shop/.env") && !may("shop/missing")
        );
    }

    #[cfg(unix)]
    #[test]
    fn a_link_is_where_it_leads() {
        let folder = tempfile::tempdir().unwrap();
        let path = |name: &str| folder.path().join(name);
        fs::create_dir(path("shop")).unwrap();
        fs::write(path("secret"), "x").unwrap();
        std::os::unix::fs::symlink(path("secret"), path("shop/gcheck.toml")).unwrap();
        assert!(!Workspace::around(&path("shop/gcheck.toml")).may_quote(&path("shop/gcheck.toml")));
    }
}
