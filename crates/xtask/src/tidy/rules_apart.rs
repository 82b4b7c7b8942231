//! A rule is one file and names no other rule; what rules share is in `facts/`, and facts name no rule.
//!
//! Knows: where rules and facts are. Must not know: any rule. Tests count: a rule's test that needs another rule tests both.

use super::modules::ModuleGraph;
use super::problem::Problem;
use super::tokens::RustFile;

const ROOT: &str = "crates/gcheck-rules/src/lib.rs";
const RULES: &str = "crates/gcheck-rules/src/rules/";
const FACTS: &str = "crates/gcheck-rules/src/facts/";

/// Rules and facts that name a rule.
pub(super) fn problems(files: &[RustFile<'_>]) -> Vec<Problem> {
    let Some(root) = files.iter().find(|file| file.path == ROOT) else { return Vec::new() };
    let graph = ModuleGraph::with_tests(root, files);
    let mut problems = Vec::new();
    for file in 0..graph.len() {
        let path = graph.path(file);
        if !is_rule(path) && !path.starts_with(FACTS) {
            continue;
        }
        for (used, names) in graph.used_by(file).filter(|(used, _)| is_rule(graph.path(*used))) {
            let names: Vec<&str> = names.iter().map(String::as_str).collect();
            let rule = graph.path(used).trim_start_matches(RULES).trim_end_matches(".rs");
            let message = format!(
                "takes `{}` from the rule `{rule}`; what rules share belongs into `facts/`",
                names.join("`, `")
            );
            problems.push(Problem::new(path, 0, message));
        }
    }
    problems
}

/// `rules/<group>/<rule>.rs`.
fn is_rule(path: &str) -> bool {
    path.strip_prefix(RULES).is_some_and(|rest| rest.contains('/'))
}

#[cfg(test)]
mod tests {
    use super::problems;
    use crate::tidy::tokens::RustFile;
    use crate::workspace::TextFile;

    fn found(files: &[(&str, &str)]) -> Vec<String> {
        let files: Vec<TextFile> = files
            .iter()
            .map(|(path, text)| TextFile {
                path: format!("crates/gcheck-rules/src/{path}"),
                text: (*text).to_owned(),
            })
            .collect();
        let files: Vec<RustFile<'_>> = files.iter().map(|file| RustFile::new(file).unwrap()).collect();
        problems(&files).iter().map(ToString::to_string).collect()
    }

    const ROOT: (&str, &str) = ("lib.rs", "mod facts;\nmod rules;\n");
    const REGISTRY: (&str, &str) = (
        "rules/generated.rs",
        "pub(crate) mod arcs { pub(crate) mod a; pub(crate) mod b; }\nstatic ALL: &[&str] = &[&arcs::a::RULE];\n",
    );
    const LIST: (&str, &str) = ("rules.rs", "#[path = \"rules/generated.rs\"]\nmod generated;\n");

    #[test]
    fn rules_that_share_facts_are_apart() {
        let a = ("rules/arcs/a.rs", "use crate::facts::arcs::fits;\nfn check() { fits() }\n");
        let b = (
            "rules/arcs/b.rs",
            "use crate::facts::arcs::fits;\n#[cfg(test)] mod tests { use super::RULE; }\n",
        );
        let facts = [("facts.rs", "pub(crate) mod arcs;\n"), ("facts/arcs.rs", "pub(crate) fn fits() {}\n")];
        assert_eq!(found(&[ROOT, LIST, REGISTRY, a, b, facts[0], facts[1]]), [""; 0]);
    }

    #[test]
    fn a_rule_that_names_another_is_found_wherever_it_does() {
        let b = ("rules/arcs/b.rs", "pub(crate) fn fits() {}\n");
        let facts = ("facts.rs", "");
        for a in [
            "use super::b::fits;\nfn check() { fits() }\n",
            "fn check() { super::b::fits() }\n",
            "use crate::rules::generated::arcs::b;\nfn check() { b::fits() }\n",
            "#[cfg(test)] mod tests { use super::super::b; fn it() { b::fits() } }\n",
        ] {
            let found = found(&[ROOT, LIST, REGISTRY, ("rules/arcs/a.rs", a), b, facts]);
            assert_eq!(found.len(), 1, "{a}: {found:?}");
            assert!(
                found[0].contains("rules/arcs/a.rs: takes `") && found[0].contains("rule `arcs/b`"),
                "{found:?}"
            );
        }
    }

    #[test]
    fn facts_name_no_rule() {
        let a = ("rules/arcs/a.rs", "pub(crate) const SIZE: u8 = 1;\n");
        let b = ("rules/arcs/b.rs", "");
        let facts = ("facts.rs", "mod arcs;\n");
        let arcs = ("facts/arcs.rs", "fn size() -> u8 { crate::rules::generated::arcs::a::SIZE }\n");
        let found = found(&[ROOT, LIST, REGISTRY, a, b, facts, arcs]);
        assert!(found.len() == 1 && found[0].contains("facts/arcs.rs: takes `SIZE`"), "{found:?}");
    }
}
