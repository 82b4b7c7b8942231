//! The npm packages: one with the binary for each system, and one that finds the right one of them.
//!
//! Knows: the layout of npm's tarballs. Must not know: any other package.

use serde_json::{Map, Value, json};

use crate::container::{Entry, Package, tar_gz};
use crate::{Build, Names, PUBLISHED, Papers};

/// The script that starts the binary of the right package.
const LAUNCHER: &str = include_str!("../../../packages/npm/gcheck.js");

/// What all packages say of themselves.
fn manifest(names: &Names, name: &str, version: &str, description: &str) -> Map<String, Value> {
    let manifest = json!({
        "name": name,
        "version": version,
        "description": description,
        "keywords": ["cnc", "g-code", "gcode", "linter", "language-server"],
        "license": "MIT OR Apache-2.0",
        "repository": { "type": "git", "url": format!("git+{}.git", names.url()) },
    });
    match manifest {
        Value::Object(fields) => fields,
        _ => Map::new(),
    }
}

/// The package with the binary of one system; npm installs only that of the system it runs on.
///
/// # Errors
/// When packing fails.
pub fn npm_platform(build: &Build<'_>) -> anyhow::Result<Package> {
    let Build { names, version, target, papers, .. } = build;
    let (os, cpu) = target.npm;
    let name = format!("{}/{}", names.npm_scope, target.npm_name());
    let mut manifest = manifest(names, &name, version, &format!("The binary of gcheck for {os} on {cpu}"));
    manifest.insert("os".to_owned(), json!([os]));
    manifest.insert("cpu".to_owned(), json!([cpu]));
    let mut entries = vec![Entry::text("package/package.json", serde_json::to_string_pretty(&manifest)?)];
    entries.extend(papers.licences("package"));
    entries.push(Entry::program(format!("package/bin/{}", target.binary_name()), build.binary));
    Ok(Package { name: tarball(&name, version), bytes: tar_gz(&entries, build.effort)? })
}

/// The package that people install; it is the same for all systems.
///
/// # Errors
/// When packing fails.
pub fn npm_launcher(names: &Names, version: &str, papers: &Papers) -> anyhow::Result<Package> {
    let about = "Checks CNC part programs (G-code) before they run on the machine";
    let mut manifest = manifest(names, &names.npm, version, about);
    let platforms: Map<String, Value> = PUBLISHED
        .iter()
        .map(|target| (format!("{}/{}", names.npm_scope, target.npm_name()), json!(version)))
        .collect();
    manifest.insert("bin".to_owned(), json!({ "gcheck": "bin/gcheck.js" }));
    manifest.insert("engines".to_owned(), json!({ "node": ">=14.18" }));
    manifest.insert("optionalDependencies".to_owned(), Value::Object(platforms));
    let launcher = LAUNCHER.replace("@SCOPE@", &names.npm_scope).replace("@NAME@", &names.npm);
    let mut entries = vec![
        Entry::text("package/package.json", serde_json::to_string_pretty(&manifest)?),
        Entry::text("package/README.md", papers.readme.as_str()),
    ];
    entries.extend(papers.licences("package"));
    entries.push(Entry::program("package/bin/gcheck.js", launcher));
    Ok(Package { name: tarball(&names.npm, version), bytes: tar_gz(&entries, 9)? })
}

/// The file name that `npm pack` gives.
fn tarball(name: &str, version: &str) -> String {
    format!("{}-{version}.tgz", name.trim_start_matches('@').replace('/', "-"))
}
