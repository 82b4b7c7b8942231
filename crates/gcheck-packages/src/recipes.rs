//! What is written about a finished release: installers for shells, Homebrew's formula, Scoop's and winget's manifests.
//!
//! Knows: the templates in `packages/`, and their placeholders. Must not know: how archives are made.
//!
//! A template has `@VERSION@`, `@URL@` (the repository), `@REPOSITORY@` (`OWNER/NAME`), `@WINGET@`, and
//! `@SHA256:TRIPLE@` for the checksum of an archive.

use anyhow::{Context as _, bail};

use crate::sums::sha256;
use crate::{Names, PUBLISHED, Package};

const INSTALL_SH: &str = include_str!("../../../packages/install.sh");
const INSTALL_PS1: &str = include_str!("../../../packages/install.ps1");
const FORMULA: &str = include_str!("../../../packages/gcheck.rb");
const SCOOP: &str = include_str!("../../../packages/scoop.json");
const WINGET: &str = include_str!("../../../packages/winget/version.yaml");
const WINGET_INSTALLER: &str = include_str!("../../../packages/winget/installer.yaml");
const WINGET_LOCALE: &str = include_str!("../../../packages/winget/locale.yaml");

/// Writes them for the archives of a release, which must be there for every published target.
///
/// # Errors
/// When an archive is missing, or a template has a placeholder that nothing fills.
pub fn recipes(names: &Names, version: &str, archives: &[Package]) -> anyhow::Result<Vec<Package>> {
    let mut values = vec![
        ("VERSION".to_owned(), version.to_owned()),
        ("URL".to_owned(), names.url()),
        ("REPOSITORY".to_owned(), names.repository.clone()),
        ("WINGET".to_owned(), names.winget.clone()),
        ("WINGET_PUBLISHER".to_owned(), names.winget.split('.').next().unwrap_or_default().to_owned()),
    ];
    for target in PUBLISHED {
        let name = target.archive_name(version);
        let archive = archives.iter().find(|package| package.name == name);
        let archive = archive.with_context(|| format!("the release has no {name}"))?;
        values.push((format!("SHA256:{}", target.triple), sha256(&archive.bytes)));
    }
    let winget = &names.winget;
    let files = [
        ("install.sh".to_owned(), INSTALL_SH),
        ("install.ps1".to_owned(), INSTALL_PS1),
        ("homebrew/gcheck.rb".to_owned(), FORMULA),
        ("scoop/gcheck.json".to_owned(), SCOOP),
        (format!("winget/{winget}.yaml"), WINGET),
        (format!("winget/{winget}.installer.yaml"), WINGET_INSTALLER),
        (format!("winget/{winget}.locale.en-US.yaml"), WINGET_LOCALE),
    ];
    files
        .into_iter()
        .map(|(name, template)| {
            let text = fill(template, &values).with_context(|| name.clone())?;
            Ok(Package { name, bytes: text.into_bytes() })
        })
        .collect()
}

fn fill(template: &str, values: &[(String, String)]) -> anyhow::Result<String> {
    let mut text = template.to_owned();
    for (name, value) in values {
        text = text.replace(&format!("@{name}@"), value);
    }
    for line in text.lines() {
        let placeholder =
            |part: &&str| !part.is_empty() && part.chars().all(|c| c.is_ascii_uppercase() || c == '_');
        if let Some(left) = line.split('@').skip(1).step_by(2).find(placeholder) {
            bail!("nothing fills `@{left}@`");
        }
    }
    Ok(text)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn names() -> Names {
        Names::read().unwrap()
    }

    fn archives() -> Vec<Package> {
        let archive = |target: &crate::Target| Package {
            name: target.archive_name("1.2.3"),
            bytes: target.triple.as_bytes().to_vec(),
        };
        PUBLISHED.iter().map(archive).collect()
    }

    #[test]
    fn every_recipe_has_the_version_and_checksums_of_its_archives() {
        let recipes = recipes(&names(), "1.2.3", &archives()).unwrap();
        for recipe in &recipes {
            let text = String::from_utf8(recipe.bytes.clone()).unwrap();
            assert!(text.contains("1.2.3"), "{}", recipe.name);
            let systems: &[&str] = match recipe.name.rsplit('/').next().unwrap_or_default() {
                "install.sh" | "gcheck.rb" => &["linux-musl", "apple-darwin"],
                "install.ps1" | "gcheck.json" => &["windows"],
                name if name.contains("installer") => &["windows"],
                _ => &[],
            };
            for target in PUBLISHED.iter().filter(|t| systems.iter().any(|system| t.triple.contains(system)))
            {
                let sum = sha256(target.triple.as_bytes());
                assert!(text.contains(&sum), "{}: {}", recipe.name, target.triple);
            }
        }
    }

    #[test]
    fn scoop_reads_its_manifest() {
        let recipes = recipes(&names(), "1.2.3", &archives()).unwrap();
        let scoop = recipes.iter().find(|recipe| recipe.name == "scoop/gcheck.json").unwrap();
        let manifest: serde_json::Value = serde_json::from_slice(&scoop.bytes).unwrap();
        for (processor, triple) in [("64bit", "x86_64-pc-windows-msvc"), ("arm64", "aarch64-pc-windows-msvc")]
        {
            let part = &manifest["architecture"][processor];
            assert!(part["url"].as_str().unwrap().ends_with(&format!("/v1.2.3/gcheck-v1.2.3-{triple}.zip")));
            assert_eq!(part["extract_dir"], format!("gcheck-v1.2.3-{triple}"));
        }
    }

    #[test]
    fn a_release_without_one_of_its_archives_is_refused() {
        let error = recipes(&names(), "1.2.3", &archives()[1..]).unwrap_err().to_string();
        assert_eq!(error, "the release has no gcheck-v1.2.3-x86_64-unknown-linux-musl.tar.gz");
    }

    #[test]
    fn a_placeholder_without_a_value_is_refused() {
        let error = fill("a @NOBODY@ b", &[]).unwrap_err().to_string();
        assert_eq!(error, "nothing fills `@NOBODY@`");
    }
}
