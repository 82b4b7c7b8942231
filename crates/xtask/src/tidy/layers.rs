//! The layer law: which crate may use which.
//!
//! Knows: all of it; this is the only place that states it (`deny.toml` repeats the part on foreign crates for tools that
//! read that file, and a check keeps the two equal). Direct dependencies only; what tests use is free.

use std::path::Path;

use cargo_metadata::{DependencyKind, Metadata};

use super::problem::Problem;

/// Foreign crates that shape an architecture, and the crates that may use them.
pub(super) const ONLY: &[(&str, &[&str])] = &[
    ("codespan-reporting", &["gcheck-report"]),
    ("logos", &["gcheck-syntax"]),
    ("nalgebra", &["gcheck-engine", "gcheck-geometry", "gcheck-planner"]),
    ("rowan", &["gcheck-syntax"]),
    ("salsa", &["gcheck-db"]),
    ("tokio", &["gcheck-server"]),
    ("tower-lsp-server", &["gcheck-server"]),
];

/// What a crate of ours may use of ours.
const OWN: &[(&str, &[&str])] = &[
    ("gcheck-syntax", &[]),
    ("gcheck-controls", &[]),
    ("gcheck-geometry", &[]),
    ("gcheck-diagnostics", &[]),
    ("gcheck-program", &["gcheck-syntax", "gcheck-controls"]),
    ("gcheck-engine", &["gcheck-program", "gcheck-controls", "gcheck-geometry"]),
    ("gcheck-format", &["gcheck-syntax", "gcheck-controls", "gcheck-program", "gcheck-diagnostics"]),
    ("gcheck-planner", &["gcheck-geometry"]),
    ("gcheck-toolpath", &["gcheck-geometry", "gcheck-engine", "gcheck-planner"]),
    (
        "gcheck-edit",
        &[
            "gcheck-controls",
            "gcheck-program",
            "gcheck-geometry",
            "gcheck-engine",
            "gcheck-diagnostics",
            "gcheck-toolpath",
        ],
    ),
    ("gcheck-report", &["gcheck-syntax", "gcheck-diagnostics"]),
    (
        "gcheck-lint",
        &[
            "gcheck-syntax",
            "gcheck-controls",
            "gcheck-program",
            "gcheck-geometry",
            "gcheck-engine",
            "gcheck-diagnostics",
        ],
    ),
    (
        "gcheck-rules",
        &[
            "gcheck-syntax",
            "gcheck-controls",
            "gcheck-program",
            "gcheck-geometry",
            "gcheck-engine",
            "gcheck-diagnostics",
            "gcheck-lint",
        ],
    ),
    // Not the rules: they come with the selection that the binary makes.
    (
        "gcheck-db",
        &[
            "gcheck-syntax",
            "gcheck-controls",
            "gcheck-program",
            "gcheck-geometry",
            "gcheck-engine",
            "gcheck-diagnostics",
            "gcheck-lint",
        ],
    ),
    (
        "gcheck-ide",
        &[
            "gcheck-syntax",
            "gcheck-controls",
            "gcheck-program",
            "gcheck-geometry",
            "gcheck-engine",
            "gcheck-diagnostics",
            "gcheck-lint",
            "gcheck-format",
            "gcheck-toolpath",
            "gcheck-edit",
            "gcheck-db",
        ],
    ),
    (
        "gcheck-server",
        &[
            "gcheck-controls",
            "gcheck-program",
            "gcheck-diagnostics",
            "gcheck-lint",
            "gcheck-db",
            "gcheck-ide",
        ],
    ),
    (
        "gcheck-playground",
        &[
            "gcheck-controls",
            "gcheck-program",
            "gcheck-diagnostics",
            "gcheck-lint",
            "gcheck-rules",
            "gcheck-db",
            "gcheck-ide",
        ],
    ),
];

/// Use whatever they need: the binary ties everything together, the others never ship.
const FREE: &[&str] =
    &["gcheck", "gcheck-fuzz", "gcheck-packages", "gcheck-testkit", "gcheck-tests", "xtask"];

/// Packages whose folder has another name: the end-to-end tests are where cargo users look for them.
const OTHER_FOLDER: &[(&str, &str)] = &[("gcheck-tests", "tests")];

/// What the law looks at in a package.
#[derive(Debug)]
pub(super) struct Package {
    name: String,
    folder: String,
    uses: Vec<String>,
}

/// The workspace's packages, with what they use beyond tests.
pub(super) fn packages(members: &Metadata) -> Vec<Package> {
    members
        .packages
        .iter()
        .map(|package| Package {
            name: package.name.to_string(),
            folder: Path::new(&package.manifest_path)
                .parent()
                .and_then(Path::file_name)
                .map(|name| name.to_string_lossy().into_owned())
                .unwrap_or_default(),
            uses: package
                .dependencies
                .iter()
                .filter(|dependency| dependency.kind != DependencyKind::Development)
                .map(|dependency| dependency.name.clone())
                .collect(),
        })
        .collect()
}

/// Dependencies that the law does not allow, and packages that it does not place.
pub(super) fn problems(packages: &[Package]) -> Vec<Problem> {
    let mut problems = Vec::new();
    for package in packages {
        let mut say = |message: String| problems.push(Problem::new(manifest(package), 0, message));
        let folder =
            OTHER_FOLDER.iter().find(|(name, _)| *name == package.name).map_or(&*package.name, |(_, f)| f);
        if package.folder != folder {
            say(format!("`{}` must be in a folder called `{folder}`", package.name));
        }
        let own = OWN.iter().find(|(name, _)| *name == package.name).map(|(_, allowed)| *allowed);
        let free = FREE.contains(&package.name.as_str());
        if own.is_none() && !free {
            say(format!(
                "`{}` has no place in the layer law; give it one in crates/xtask/src/tidy/layers.rs",
                package.name
            ));
        }
        for used in &package.uses {
            if let Some((_, users)) = ONLY.iter().find(|(name, _)| name == used)
                && !users.contains(&package.name.as_str())
            {
                say(format!("`{}` may not use `{used}`; only {} may", package.name, users.join(", ")));
            }
            let ours = packages.iter().any(|p| p.name == *used);
            if ours && own.is_some_and(|allowed| !allowed.contains(&used.as_str())) {
                say(format!(
                    "`{}` may not use `{used}`: the layer law allows {own:?}",
                    package.name,
                    own = own.unwrap_or_default()
                ));
            }
        }
    }
    problems
}

fn manifest(package: &Package) -> String {
    match OTHER_FOLDER.iter().find(|(name, _)| *name == package.name) {
        Some((_, folder)) => format!("{folder}/Cargo.toml"),
        None => format!("crates/{}/Cargo.toml", package.folder),
    }
}

#[cfg(test)]
mod tests {
    use super::{OWN, Package, problems};

    fn package(name: &str, uses: &[&str]) -> Package {
        Package {
            name: name.to_owned(),
            folder: name.to_owned(),
            uses: uses.iter().map(ToString::to_string).collect(),
        }
    }

    fn messages(packages: &[Package]) -> Vec<String> {
        problems(packages).into_iter().map(|p| p.message).collect()
    }

    #[test]
    fn nobody_reaches_across_layers() {
        let found = messages(&[
            package("gcheck-syntax", &["rowan", "gcheck-controls"]),
            package("gcheck-controls", &[]),
            package("gcheck-rules", &["gcheck-syntax", "logos"]),
            package("gcheck", &["gcheck-rules", "gcheck-controls"]),
        ]);
        assert_eq!(found.len(), 2, "{found:?}");
        assert!(found[0].contains("`gcheck-syntax` may not use `gcheck-controls`"), "{found:?}");
        assert!(found[1].contains("`gcheck-rules` may not use `logos`"), "{found:?}");
    }

    #[test]
    fn a_new_crate_needs_a_place_and_its_own_folder() {
        let mut stray = package("gcheck-extra", &[]);
        stray.folder = "extra".to_owned();
        let found = messages(&[stray]);
        assert!(
            found[0].contains("folder called `gcheck-extra`") && found[1].contains("no place"),
            "{found:?}"
        );
    }

    #[test]
    fn the_law_has_no_cycle() {
        // Each crate may use only crates before it.
        for (at, (name, allowed)) in OWN.iter().enumerate() {
            for used in *allowed {
                let place = OWN.iter().position(|(n, _)| n == used);
                assert!(place.is_some_and(|p| p < at), "{name} uses {used}");
            }
        }
    }
}
