//! Who may look at the world around a program: files, environment, clocks.
//!
//! Knows: the crates that meet the user. All others are functions of their arguments, so that they can be cached, run in
//! an editor or a browser, and give the same answer twice.

use super::problem::Problem;
use super::tokens::{Placed, RustFile, Token, starts_with};

/// Crates under `crates/` that may; the end-to-end tests and build scripts may, too.
const FREE: &[&str] = &["gcheck", "gcheck-server", "gcheck-testkit", "xtask"];

const MODULES: &[&str] = &["env", "fs", "net", "process"];
const CLOCKS: &[&str] = &["Instant", "SystemTime"];

/// Uses of the surroundings in product code that must not know them.
pub(super) fn problems(file: &RustFile<'_>) -> Vec<Problem> {
    if file.source_of().is_none_or(|name| FREE.contains(&name)) {
        return Vec::new();
    }
    let tokens = file.product();
    let mut problems = Vec::new();
    let mut say = |line, what: &str| {
        problems.push(Problem::new(
            file.path,
            line,
            format!("`{what}` may be used in {} only", FREE.join(", ")),
        ));
    };
    for (at, placed) in tokens.iter().enumerate() {
        if let Token::Word(word) = &placed.token
            && CLOCKS.contains(&word.as_str())
        {
            say(placed.line, word);
        }
        let Some(rest) = tokens.get(at..).filter(|rest| starts_with(rest, &["std", ":", ":"])) else {
            continue;
        };
        for (line, module) in modules(rest.get(3..).unwrap_or_default()) {
            if MODULES.contains(&module) {
                say(line, &format!("std::{module}"));
            }
        }
    }
    problems
}

/// The modules that a path names after `std::`: one word, or the first words of the paths between braces.
fn modules<'t>(tokens: &[&'t Placed]) -> Vec<(usize, &'t str)> {
    let mut found = Vec::new();
    let mut depth = 0;
    let mut at_start = true;
    for placed in tokens {
        match &placed.token {
            Token::Mark('{') => {
                depth += 1;
                at_start = depth == 1;
            }
            Token::Mark('}') => depth -= 1,
            Token::Mark(',') => at_start = depth == 1,
            Token::Word(word) if at_start => {
                found.push((placed.line, word.as_str()));
                at_start = false;
            }
            _ => {}
        }
        if depth == 0 {
            break;
        }
    }
    found
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
    fn files_environment_and_clocks_are_found() {
        let text = "use std::{fmt::{self, Debug},\nfs};\nuse std::collections::HashMap;\nfn a() { std::env::var(\"A\"); }\nuse std::time::{Duration,\nInstant};\n";
        assert_eq!(lines("crates/gcheck-rules/src/a.rs", text), [2, 4, 6]);
        assert_eq!(lines("crates/gcheck/src/a.rs", text), [0_usize; 0]);
        assert_eq!(lines("crates/gcheck-rules/build.rs", text), [0_usize; 0]);
    }
}
