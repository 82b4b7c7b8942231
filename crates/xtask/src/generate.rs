//! `cargo xtask gen`: files that are made from code and data, committed, and compared with their sources by a test.
//!
//! Knows: the list of generators, writing, comparing, pages whose source is gone. Must not know: what is in the files.

#[cfg(feature = "product")]
mod control_pages;
#[cfg(feature = "product")]
mod editor_tests;
mod generated;
#[cfg(feature = "product")]
mod keys;
#[cfg(feature = "product")]
mod markdown;
#[cfg(feature = "product")]
mod options;
pub(crate) mod registry;
#[cfg(feature = "product")]
mod rendered;
#[cfg(feature = "product")]
mod rule_pages;
#[cfg(feature = "product")]
mod schema;
#[cfg(feature = "product")]
mod summary;

use std::collections::BTreeSet;
use std::fs;
use std::path::Path;
use std::process::ExitCode;

use anyhow::{Context as _, bail};

use generated::Generated;

use crate::{product, workspace};

/// Folders in which every Markdown file is generated.
const WHOLE_FOLDERS: &[&str] = &["docs/rules", "docs/controls", "docs/reference"];

/// Writes what is stale, or with `--check` only says so.
pub(crate) fn run(arguments: &[String]) -> anyhow::Result<ExitCode> {
    let check = match arguments {
        [] => false,
        [flag] if flag == "--check" => true,
        _ => bail!("usage: cargo xtask gen [--check]"),
    };
    if !product::BUILT_IN {
        // The registry first: while it is stale, the crate that the pages are made from may not compile.
        if check {
            let stale = stale(workspace::root(), &registry::generate()?)?;
            if !stale.is_empty() {
                return Ok(tell(&stale));
            }
        } else {
            write(workspace::root(), &registry::generate()?)?;
        }
        return product::rerun("gen", arguments, false);
    }
    let files = all()?;
    if check {
        let mut stale = stale(workspace::root(), &files)?;
        stale.extend(
            orphans(workspace::root(), &files)?
                .iter()
                .map(|path| format!("{path} has no source any more; run `cargo xtask gen`")),
        );
        return Ok(tell(&stale));
    }
    write(workspace::root(), &files)?;
    for path in orphans(workspace::root(), &files)? {
        fs::remove_file(workspace::root().join(&path))?;
        println!("removed  {path}");
    }
    Ok(ExitCode::SUCCESS)
}

fn tell(stale: &[String]) -> ExitCode {
    for line in stale {
        println!("{line}");
    }
    if stale.is_empty() {
        println!("gen: everything is fresh");
        ExitCode::SUCCESS
    } else {
        ExitCode::FAILURE
    }
}

/// Every generated file.
fn all() -> anyhow::Result<Generated> {
    let mut files = registry::generate()?;
    files.extend(from_product()?);
    Ok(files)
}

#[cfg(feature = "product")]
fn from_product() -> anyhow::Result<Generated> {
    let mut files = rule_pages::generate();
    files.extend(control_pages::generate()?);
    files.extend(schema::generate());
    files.extend(options::generate());
    files.extend(keys::generate()?);
    files.extend(editor_tests::generate(workspace::root())?);
    files.extend(summary::generate(workspace::root(), &files)?);
    Ok(files)
}

#[cfg(not(feature = "product"))]
#[expect(clippy::unnecessary_wraps, reason = "the signature of the build that has the product")]
fn from_product() -> anyhow::Result<Generated> {
    Ok(Generated::new())
}

/// Writes the files whose content differs.
pub(crate) fn write(root: &Path, files: &Generated) -> anyhow::Result<()> {
    for (path, content) in files {
        let target = root.join(path);
        if fs::read_to_string(&target).is_ok_and(|old| old == *content) {
            continue;
        }
        if let Some(folder) = target.parent() {
            fs::create_dir_all(folder)?;
        }
        fs::write(&target, content).with_context(|| target.display().to_string())?;
        println!("wrote  {}", path.display());
    }
    Ok(())
}

/// A line for each file that is missing or differs from what its sources say.
fn stale(root: &Path, files: &Generated) -> anyhow::Result<Vec<String>> {
    let mut stale = Vec::new();
    for (path, content) in files {
        let target = root.join(path);
        let old = if target.exists() { Some(fs::read_to_string(&target)?) } else { None };
        if old.as_ref() != Some(content) {
            stale.push(format!("{} is stale; run `cargo xtask gen`", path.display()));
        }
    }
    Ok(stale)
}

/// Pages in wholly generated folders that no generator makes.
fn orphans(root: &Path, files: &Generated) -> anyhow::Result<Vec<String>> {
    let expected: BTreeSet<&Path> = files.iter().map(|(path, _)| path.as_path()).collect();
    let mut orphans = Vec::new();
    for folder in WHOLE_FOLDERS {
        for page in workspace::files_with_extension(&root.join(folder), "md")? {
            let path = workspace::relative(root, &page);
            if !expected.contains(Path::new(&path)) {
                orphans.push(path);
            }
        }
    }
    Ok(orphans)
}

#[cfg(test)]
mod tests {
    use std::path::PathBuf;

    use super::{all, orphans, stale, write};
    use crate::workspace;

    #[test]
    fn generated_files_are_fresh() {
        let files = all().unwrap();
        let mut wrong = stale(workspace::root(), &files).unwrap();
        let orphans = orphans(workspace::root(), &files).unwrap();
        wrong.extend(
            orphans.iter().map(|path| format!("{path} has no source any more; run `cargo xtask gen`")),
        );
        assert!(wrong.is_empty(), "{}", wrong.join("\n"));
    }

    #[test]
    fn stale_files_and_orphans_are_found() {
        let root = tempfile::tempdir().unwrap();
        let page = |name: &str, text: &str| (PathBuf::from("docs/rules").join(name), text.to_owned());
        write(root.path(), &vec![page("kept.md", "old"), page("gone.md", "old")]).unwrap();
        let files = vec![page("kept.md", "new"), page("fresh.md", "new")];
        assert_eq!(
            stale(root.path(), &files).unwrap(),
            [
                "docs/rules/kept.md is stale; run `cargo xtask gen`",
                "docs/rules/fresh.md is stale; run `cargo xtask gen`"
            ]
        );
        assert_eq!(orphans(root.path(), &files).unwrap(), ["docs/rules/gone.md"]);
        write(root.path(), &files).unwrap();
        assert!(stale(root.path(), &files).unwrap().is_empty());
    }
}
