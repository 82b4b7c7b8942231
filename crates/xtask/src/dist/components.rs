//! The crates that the binary is made of, and those that its build runs.
//!
//! Knows: cargo's tree, metadata and lock file. Must not know: how a bill of materials is written.

use std::collections::{BTreeMap, BTreeSet};
use std::env;
use std::fs;
use std::process::Command;

use anyhow::{Context as _, ensure};
use cargo_metadata::{DependencyKind, Metadata, MetadataCommand, Package, PackageId};
use gcheck_packages::Component;

use crate::workspace;

/// A crate by name and version.
type Crate = (String, String);

/// Finds them for a target, with the features that the binary is built with.
pub(super) fn components(triple: &str) -> anyhow::Result<Vec<Component>> {
    // Metadata has the features of the whole workspace: only the tree knows what this binary takes.
    let linked = tree(triple, "normal,no-proc-macro")?;
    let all = tree(triple, "normal,build")?;
    let checksums = checksums()?;
    let graph = graph(triple)?;
    let by_id: BTreeMap<&PackageId, &Package> =
        graph.packages.iter().map(|package| (&package.id, package)).collect();
    let nodes = &graph.resolve.as_ref().context("cargo metadata has no graph")?.nodes;
    let mut components = Vec::new();
    for node in nodes {
        let package = by_id.get(&node.id).context("a crate of the graph is not described")?;
        let key = key(package);
        if !all.contains(&key) {
            continue;
        }
        let needs = node
            .deps
            .iter()
            .filter(|needed| needed.dep_kinds.iter().any(|kind| kind.kind != DependencyKind::Development))
            .filter_map(|needed| by_id.get(&needed.pkg).map(|package| self::key(package)))
            .filter(|needed| all.contains(needed));
        components.push(Component {
            licence: package.license.clone().unwrap_or_default(),
            checksum: checksums.get(&key).cloned(),
            is_linked: linked.contains(&key),
            needs: needs.collect(),
            name: key.0,
            version: key.1,
        });
    }
    ensure!(components.len() == all.len(), "cargo tree and cargo metadata do not name the same crates");
    Ok(components)
}

fn key(package: &Package) -> Crate {
    (package.name.to_string(), package.version.to_string())
}

/// The crates that gcheck needs by edges of some kinds.
fn tree(triple: &str, edges: &str) -> anyhow::Result<BTreeSet<Crate>> {
    let mut cargo = Command::new(env::var_os("CARGO").unwrap_or_else(|| "cargo".into()));
    cargo.current_dir(workspace::root()).args([
        "tree",
        "--locked",
        "--package",
        "gcheck",
        "--prefix",
        "none",
    ]);
    let output = cargo.args(["--target", triple, "--edges", edges, "--format", "{p}"]).output();
    let output = output.context("cargo does not start")?;
    let words = String::from_utf8_lossy(&output.stderr);
    ensure!(output.status.success(), "cargo tree fails: {words}");
    let lines = String::from_utf8(output.stdout)?;
    // `NAME vVERSION`, and the folder of those of the workspace.
    let name_and_version = |line: &str| {
        let mut words = line.split(' ');
        Some((words.next()?.to_owned(), words.next()?.strip_prefix('v')?.to_owned()))
    };
    let read = |line: &str| name_and_version(line).with_context(|| format!("cargo tree writes `{line}`"));
    lines.lines().filter(|line| !line.is_empty()).map(read).collect()
}

fn graph(triple: &str) -> anyhow::Result<Metadata> {
    let options = ["--locked", "--filter-platform", triple].map(str::to_owned).to_vec();
    let manifest = workspace::root().join("Cargo.toml");
    Ok(MetadataCommand::new().manifest_path(manifest).other_options(options).exec()?)
}

/// The checksums of the lock file.
fn checksums() -> anyhow::Result<BTreeMap<Crate, String>> {
    let path = workspace::root().join("Cargo.lock");
    let text = fs::read_to_string(&path).with_context(|| path.display().to_string())?;
    let lock: toml::Table = text.parse()?;
    let packages = lock.get("package").and_then(toml::Value::as_array).context("Cargo.lock has no crates")?;
    let of = |package: &toml::Value| {
        let text = |key: &str| Some(package.get(key)?.as_str()?.to_owned());
        Some(((text("name")?, text("version")?), text("checksum")?))
    };
    Ok(packages.iter().filter_map(of).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_crate_of_the_binary_has_a_licence_and_comes_from_somewhere() {
        let components = components(&workspace::host().unwrap()).unwrap();
        let find = |name: &str| components.iter().find(|component| component.name == name).unwrap();
        let itself = find("gcheck");
        assert!(itself.is_linked && itself.checksum.is_none());
        assert!(itself.needs.iter().any(|(name, _)| name == "gcheck-engine"));
        assert!(find("rowan").is_linked);
        // A macro runs in the build alone; what only tests use is not there.
        assert!(!find("serde_derive").is_linked);
        assert!(components.iter().all(|component| component.name != "proptest"));
        for component in &components {
            let Component { name, licence, checksum, .. } = component;
            assert!(!licence.is_empty(), "{name}");
            assert_eq!(checksum.is_none(), name.starts_with("gcheck"), "{name}");
        }
    }
}
