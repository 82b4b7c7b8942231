//! The bill of materials of a binary: which crates of which versions and licences it is made of, in the form
//! of `CycloneDX` 1.6.
//!
//! Knows: that form. Must not know: how the crates are found out.

use serde_json::{Map, Value, json};

use crate::sums::sha256;
use crate::{Build, Package};

/// A crate that a binary is made of, or that its build runs.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
pub struct Component {
    /// Its name.
    pub name: String,
    /// Its version.
    pub version: String,
    /// Its licence as an SPDX expression; empty where its manifest does not name one.
    pub licence: String,
    /// SHA-256 of the crate as the registry has it; `None` for those of this workspace.
    pub checksum: Option<String>,
    /// Its code is in the binary. The others are macros, build scripts and what they need.
    pub is_linked: bool,
    /// Names and versions of the components that it needs.
    pub needs: Vec<(String, String)>,
}

/// Writes the bill of materials of a binary. One of the components is gcheck itself.
///
/// # Errors
/// When a component needs one that is not among them, or gcheck is not.
pub fn sbom(build: &Build<'_>, components: &[Component]) -> anyhow::Result<Package> {
    let mut components: Vec<&Component> = components.iter().collect();
    components.sort();
    let is_there = |name: &str, version: &str| {
        components.iter().any(|component| component.name == name && component.version == version)
    };
    for component in &components {
        for (name, version) in &component.needs {
            anyhow::ensure!(
                is_there(name, version),
                "{} needs {name} {version}, which is not among the components",
                component.name
            );
        }
    }
    let is_itself = |component: &&&Component| component.name == "gcheck";
    let itself = components.iter().find(is_itself);
    let itself = itself.ok_or_else(|| anyhow::anyhow!("gcheck is not among the components"))?;
    let mut application = described(itself);
    application.insert("type".to_owned(), json!("application"));
    application.insert("hashes".to_owned(), hashes(&sha256(build.binary)));
    let target = json!([{ "name": "cargo:target", "value": build.target.triple }]);
    application.insert("properties".to_owned(), target);
    let others = components.iter().filter(|component| !is_itself(component));
    let bill = json!({
        "$schema": "http://cyclonedx.org/schema/bom-1.6.schema.json",
        "bomFormat": "CycloneDX",
        "specVersion": "1.6",
        "version": 1,
        "metadata": { "component": application },
        "components": others.map(|component| described(component)).collect::<Vec<_>>(),
        "dependencies": components.iter().map(|component| needs(component)).collect::<Vec<_>>(),
    });
    let mut text = serde_json::to_string_pretty(&bill)?;
    text.push('\n');
    let name = format!("{}.cdx.json", build.target.stem(build.version));
    Ok(Package { name, bytes: text.into_bytes() })
}

fn described(component: &Component) -> Map<String, Value> {
    let Component { name, version, licence, checksum, is_linked, needs: _ } = component;
    let address = address(name, version);
    let mut members = Map::new();
    let mut add = |name: &str, value: Value| members.insert(name.to_owned(), value);
    add("type", json!("library"));
    add("bom-ref", json!(address));
    add("name", json!(name));
    add("version", json!(version));
    add("purl", json!(address));
    // The form calls so what is not in the product.
    add("scope", json!(if *is_linked { "required" } else { "excluded" }));
    if !licence.is_empty() {
        // Old manifests write a `/` for "or".
        add("licenses", json!([{ "expression": licence.replace('/', " OR ") }]));
    }
    if let Some(checksum) = checksum {
        add("hashes", hashes(checksum));
    }
    members
}

fn hashes(sha256: &str) -> Value {
    json!([{ "alg": "SHA-256", "content": sha256 }])
}

fn needs(component: &Component) -> Value {
    let mut needs: Vec<String> =
        component.needs.iter().map(|(name, version)| address(name, version)).collect();
    needs.sort();
    needs.dedup();
    json!({ "ref": address(&component.name, &component.version), "dependsOn": needs })
}

/// The package URL of a crate.
fn address(name: &str, version: &str) -> String {
    // A `+` is what a URL has for a blank.
    format!("pkg:cargo/{name}@{}", version.replace('+', "%2B"))
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeMap;

    use super::*;
    use crate::{Names, PUBLISHED, Papers};

    fn component(name: &str, licence: &str, is_linked: bool, needs: &[&str]) -> Component {
        Component {
            name: name.to_owned(),
            version: "1.0.0+x".to_owned(),
            licence: licence.to_owned(),
            checksum: (name != "gcheck").then(|| "ab".repeat(32)),
            is_linked,
            needs: needs.iter().map(|name| ((*name).to_owned(), "1.0.0+x".to_owned())).collect(),
        }
    }

    fn bill(components: &[Component]) -> anyhow::Result<Value> {
        let build = Build {
            names: &Names::read().unwrap(),
            version: "1.0.0",
            target: &PUBLISHED[0],
            binary: b"abc",
            papers: &Papers::new(BTreeMap::new()),
            effort: 1,
        };
        let package = sbom(&build, components)?;
        assert_eq!(package.name, "gcheck-v1.0.0-x86_64-unknown-linux-musl.cdx.json");
        Ok(serde_json::from_slice(&package.bytes)?)
    }

    #[test]
    fn the_binary_is_described_and_what_it_is_made_of() {
        let bill = bill(&[
            component("zip", "MIT/Apache-2.0", true, &[]),
            component("gcheck", "MIT OR Apache-2.0", true, &["zip", "derive"]),
            component("derive", "", false, &[]),
        ])
        .unwrap();
        let itself = &bill["metadata"]["component"];
        assert_eq!(itself["type"], "application");
        assert!(itself["hashes"][0]["content"].as_str().unwrap().starts_with("ba7816bf"), "{itself}");
        let shown = |at: usize| {
            let component = &bill["components"][at];
            [&component["purl"], &component["scope"], &component["licenses"][0]["expression"]]
                .map(Value::as_str)
        };
        assert_eq!(shown(0), [Some("pkg:cargo/derive@1.0.0%2Bx"), Some("excluded"), None]);
        assert_eq!(shown(1), [Some("pkg:cargo/zip@1.0.0%2Bx"), Some("required"), Some("MIT OR Apache-2.0")]);
        let needs = &bill["dependencies"][1];
        assert_eq!(needs["ref"], "pkg:cargo/gcheck@1.0.0%2Bx");
        assert_eq!(needs["dependsOn"], json!(["pkg:cargo/derive@1.0.0%2Bx", "pkg:cargo/zip@1.0.0%2Bx"]));
    }

    #[test]
    fn a_bill_with_a_hole_is_refused() {
        let error = bill(&[component("gcheck", "MIT", true, &["zip"])]).unwrap_err().to_string();
        assert_eq!(error, "gcheck needs zip 1.0.0+x, which is not among the components");
        let error = bill(&[component("zip", "MIT", true, &[])]).unwrap_err().to_string();
        assert_eq!(error, "gcheck is not among the components");
    }
}
