//! No module of a crate uses itself through others.
//!
//! Knows: which crates still have such circles, and why. Must not know: how modules are found ([`modules`](super::modules)
//! does, and says what counts as a use).

use super::modules::{self, ModuleGraph};
use super::problem::Problem;
use super::tokens::RustFile;

/// Crates that may still have circles, and why. A crate without circles must not be in the list.
const EXEMPT: &[(&str, &str)] =
    &[("gcheck-lint", "what a rule may ask and the memories that rules share name each other")];

/// Circles in every crate, and exemptions that are no longer needed.
pub(super) fn problems(files: &[RustFile<'_>]) -> Vec<Problem> {
    judged(files, EXEMPT)
}

fn judged(files: &[RustFile<'_>], exempt: &[(&str, &str)]) -> Vec<Problem> {
    let mut problems = Vec::new();
    let mut with_circles = Vec::new();
    for root in modules::roots(files) {
        let Some(name) = root.source_of() else { continue };
        let graph = ModuleGraph::new(root, files);
        let circles = graph.circles();
        if !circles.is_empty() {
            with_circles.push(name);
        }
        if exempt.iter().any(|(exempt, _)| *exempt == name) {
            continue;
        }
        problems.extend(circles.iter().map(|circle| problem(&graph, circle)));
    }
    for (name, _) in exempt.iter().filter(|(name, _)| !with_circles.contains(name)) {
        let message = format!("`{name}` has no circle any more; take it off the list of exemptions");
        problems.push(Problem::new("crates/xtask/src/tidy/circles.rs", 0, message));
    }
    problems
}

/// One circle, with what ties it.
fn problem(graph: &ModuleGraph<'_>, circle: &[usize]) -> Problem {
    let short = |file: usize| graph.path(file).rsplit_once("src/").map_or("", |(_, name)| name);
    let mut ties = Vec::new();
    for file in circle {
        for (used, names) in graph.used_by(*file).filter(|(used, _)| circle.contains(used)) {
            let names: Vec<&str> = names.iter().map(String::as_str).collect();
            ties.push(format!("{} uses {} ({})", short(*file), short(used), names.join(", ")));
        }
    }
    let first = circle.first().map_or("", |file| graph.path(*file));
    Problem::new(
        first,
        0,
        format!("{} modules use each other in a circle: {}", circle.len(), ties.join("; ")),
    )
}

#[cfg(test)]
mod tests {
    use super::judged;
    use crate::tidy::tokens::RustFile;
    use crate::workspace::TextFile;

    /// Problems of a crate with these files; the list of exemptions names crates.
    fn found(sources: &[(&str, &str)], exempt: &[&str]) -> Vec<String> {
        let files: Vec<TextFile> = sources
            .iter()
            .map(|(path, text)| TextFile { path: format!("crates/a/src/{path}"), text: (*text).to_owned() })
            .collect();
        let files: Vec<RustFile<'_>> = files.iter().map(|file| RustFile::new(file).unwrap()).collect();
        let exempt: Vec<(&str, &str)> = exempt.iter().map(|name| (*name, "a reason")).collect();
        judged(&files, &exempt).iter().map(ToString::to_string).collect()
    }

    const ROOT: (&str, &str) = ("lib.rs", "mod b;\nmod c;\npub use b::B;\npub use c::C;\n");

    #[test]
    fn two_modules_that_use_each_other_are_a_circle_with_its_ties() {
        let b = ("b.rs", "use crate::c::C;\npub struct B(C);\n");
        let c = ("c.rs", "pub struct C;\nimpl C { fn b(&self, b: super::b::B) {} }\n");
        assert_eq!(
            found(&[ROOT, b, c], &[]),
            [
                "crates/a/src/b.rs: 2 modules use each other in a circle: b.rs uses c.rs (C); c.rs uses b.rs (B)"
            ]
        );
    }

    #[test]
    fn a_re_export_hides_no_circle_and_makes_none() {
        let b = ("b.rs", "use crate::C;\npub struct B(C);\n");
        assert_eq!(found(&[ROOT, b, ("c.rs", "pub struct C(crate::B);\n")], &[]).len(), 1);
        // The root only hands names on.
        assert_eq!(found(&[ROOT, b, ("c.rs", "pub struct C;\n")], &[]), [""; 0]);
    }

    #[test]
    fn a_parent_and_its_child_may_be_a_circle_too() {
        let root = ("lib.rs", "mod b;\n");
        let child = ("b/c.rs", "use super::B;\npub struct C(B);\n");
        assert_eq!(found(&[root, ("b.rs", "mod c;\npub struct B;\npub use c::C;\n"), child], &[]), [""; 0]);
        let needs = ("b.rs", "mod c;\npub struct B;\npub use c::C;\npub fn c() -> C { C(B) }\n");
        assert_eq!(found(&[root, needs, child], &[]).len(), 1);
    }

    #[test]
    fn tests_tie_nothing() {
        let c = ("c.rs", "pub struct C;\n#[cfg(test)]\nmod tests { use crate::b::B; }\n");
        assert_eq!(found(&[ROOT, ("b.rs", "use crate::C;\npub struct B(C);\n"), c], &[]), [""; 0]);
    }

    #[test]
    fn an_exemption_that_is_not_needed_is_a_problem() {
        let b = ("b.rs", "use crate::C;\npub struct B(C);\n");
        assert_eq!(found(&[ROOT, b, ("c.rs", "pub struct C(crate::B);\n")], &["a"]), [""; 0]);
        let found = found(&[ROOT, b, ("c.rs", "pub struct C;\n")], &["a"]);
        assert!(found.len() == 1 && found[0].contains("take it off the list"), "{found:?}");
    }
}
