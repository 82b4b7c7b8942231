//! Forms that no Rust file of ours has, tests included.
//!
//! Knows: the forms. Must not know: which crate it looks at.

use super::problem::Problem;
use super::tokens::{Placed, RustFile, Token, starts_with};

/// Token sequences, and why they are not wanted.
const FORBIDDEN: &[(&[&str], &str)] = &[
    (&["#", "[", "ignore"], "`#[ignore]`: a test that does not run tells nothing; make it fast or delete it"),
    (&["#", "[", "should_panic"], "`#[should_panic]` passes on any panic; assert on the returned value"),
    (&["todo", "!"], "`todo!`: unfinished work does not go into the tree"),
];

/// Names that say nothing about what is inside.
const NAMELESS: &[&str] = &["common", "helpers", "misc", "util", "utils"];

/// Where `cargo xtask new-rule` leaves places to fill in.
const SCAFFOLDED: &str = "crates/gcheck-rules/src/rules/";

/// What is wrong with the form of a file.
pub(super) fn problems(file: &RustFile<'_>) -> Vec<Problem> {
    let mut problems = Vec::new();
    let mut say = |line, message: String| problems.push(Problem::new(file.path, line, message));
    if !file.text.starts_with("//!") {
        say(1, "must open with `//!`: what the module knows and what it must not know".to_owned());
    }
    let path = file.path.trim_end_matches(".rs");
    if let Some(name) = path.split('/').find(|part| NAMELESS.contains(part)) {
        say(0, format!("a module called `{name}` collects anything; name it for what it does"));
    }
    if file.path.starts_with(SCAFFOLDED) {
        for (ix, _) in file.text.lines().enumerate().filter(|(_, line)| line.contains("TODO")) {
            say(ix + 1, "a place of the template is not filled in".to_owned());
        }
    }
    let tokens: Vec<&Placed> = file.tokens().iter().collect();
    for at in 0..tokens.len() {
        let Some(rest @ [first, ..]) = tokens.get(at..) else { break };
        for (pattern, reason) in FORBIDDEN {
            if starts_with(rest, pattern) {
                say(first.line, (*reason).to_owned());
            }
        }
        if let [_, second, ..] = rest
            && starts_with(rest, &["mod"])
            && let Token::Word(name) = &second.token
            && NAMELESS.contains(&name.as_str())
        {
            say(first.line, format!("a module called `{name}` collects anything; name it for what it does"));
        }
    }
    problems
}

#[cfg(test)]
mod tests {
    use super::problems;
    use crate::tidy::tokens::RustFile;
    use crate::workspace::TextFile;

    fn lines(path: &str, text: &str) -> Vec<usize> {
        let file = TextFile { path: path.to_owned(), text: text.to_owned() };
        problems(&RustFile::new(&file).unwrap()).into_iter().map(|p| p.line).collect()
    }

    #[test]
    fn unwanted_forms_are_found_in_code_only() {
        let text = "//! x\n#[test]\n#[ignore]\nfn a() { todo!() }\n// todo!() #[ignore]\nconst A: &str = \"todo!()\";\n";
        assert_eq!(lines("crates/a/src/lib.rs", text), [3, 4]);
    }

    #[test]
    fn every_module_has_a_header_and_a_name() {
        assert_eq!(lines("crates/a/src/lib.rs", "fn a() {}\nmod utils;\n"), [1, 2]);
        assert_eq!(lines("crates/a/src/common/x.rs", "//! x\n"), [0]);
    }
}
