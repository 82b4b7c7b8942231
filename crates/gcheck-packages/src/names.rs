//! The names under which gcheck is published.
//!
//! Knows: `packages/names.toml`. Must not know: the accounts that own them.

use anyhow::Context as _;
use serde::Deserialize;

/// What `packages/names.toml` says; each key is explained there.
#[derive(Debug, Clone, PartialEq, Eq, Deserialize)]
#[serde(deny_unknown_fields)]
#[expect(missing_docs, reason = "each is a key of packages/names.toml, which explains it")]
pub struct Names {
    pub repository: String,
    pub pypi: String,
    pub npm: String,
    pub npm_scope: String,
    pub homebrew_tap: String,
    pub winget: String,
    pub scoop_bucket: String,
    pub image: String,
    pub vscode_publisher: String,
    pub maintainer: String,
}

impl Names {
    /// Those of this repository.
    ///
    /// # Errors
    /// When a key is missing, or one is not known.
    pub fn read() -> anyhow::Result<Self> {
        toml::from_str(include_str!("../../../packages/names.toml")).context("packages/names.toml")
    }

    /// The address of the repository.
    pub fn url(&self) -> String {
        format!("https://github.com/{}", self.repository)
    }
}

#[cfg(test)]
mod tests {
    use std::fs;
    use std::path::Path;

    use ignore::WalkBuilder;

    use super::*;

    fn root() -> &'static Path {
        Path::new(env!("CARGO_MANIFEST_DIR")).ancestors().nth(2).unwrap()
    }

    fn text(path: &str) -> String {
        fs::read_to_string(root().join(path)).unwrap()
    }

    #[test]
    fn manifests_have_the_names_of_the_one_place() {
        let names = Names::read().unwrap();
        let cargo: toml::Table = toml::from_str(&text("Cargo.toml")).unwrap();
        assert_eq!(cargo["workspace"]["package"]["repository"].as_str(), Some(names.url().as_str()));
        let extension: serde_json::Value =
            serde_json::from_str(&text("editors/vscode/package.json")).unwrap();
        assert_eq!(extension["publisher"], names.vscode_publisher.as_str());
        assert_eq!(extension["repository"]["url"], format!("{}.git", names.url()));
        let hook: toml::Table = toml::from_str(&text("pyproject.toml")).unwrap();
        let version = cargo["workspace"]["package"]["version"].as_str().unwrap();
        let wheel = format!("{}=={version}", names.pypi);
        assert_eq!(hook["project"]["dependencies"][0].as_str(), Some(wheel.as_str()));
        assert_eq!(hook["project"]["version"].as_str(), Some(version));
    }

    /// Addresses of a repository called gcheck are those of the one place, wherever they are written.
    #[test]
    fn no_file_names_another_repository() {
        let names = Names::read().unwrap();
        let walk = WalkBuilder::new(root()).hidden(false).require_git(false).build();
        let mut wrong = Vec::new();
        for entry in walk.filter_map(Result::ok).filter(|entry| entry.path().is_file()) {
            if entry.path().components().any(|part| part.as_os_str() == ".git") {
                continue;
            }
            let Ok(text) = fs::read_to_string(entry.path()) else { continue };
            for address in text.split("github.com/").skip(1) {
                let path: Vec<&str> =
                    address.split(['/', '"', ' ', ')', '`', '\n', '<', '\'']).take(2).collect();
                let [_, name] = path[..] else { continue };
                let is_ours = name.trim_end_matches(".git") == "gcheck";
                if is_ours && path.join("/").trim_end_matches(".git") != names.repository {
                    wrong.push((entry.path().display().to_string(), path.join("/")));
                }
            }
        }
        assert!(wrong.is_empty(), "{wrong:?}");
    }
}
