//! No file knows the machine it was written on.
//!
//! Knows: beginnings of paths that exist on one machine only.

use super::problem::Problem;
use crate::workspace::TextFile;

const MACHINE: &[&str] = &["/work/", "/root/", "../shared"];

/// Files that state the law.
const EXCEPTIONS: &[&str] = &["crates/xtask/src/tidy/paths.rs"];

/// Paths of one machine in a file of any kind.
pub(super) fn problems(file: &TextFile) -> Vec<Problem> {
    if EXCEPTIONS.contains(&file.path.as_str()) {
        return Vec::new();
    }
    let mut problems = Vec::new();
    for (ix, line) in file.text.lines().enumerate() {
        for path in MACHINE {
            // `a/work/b` is a path from anywhere.
            let is_start = |at: usize| {
                !line.get(..at).is_some_and(|before| {
                    before.ends_with(|c: char| c.is_alphanumeric() || "._-/*".contains(c))
                })
            };
            if line.match_indices(path).any(|(at, _)| path.starts_with('.') || is_start(at)) {
                problems.push(Problem::new(
                    &file.path,
                    ix + 1,
                    format!("`{path}` exists on one machine only"),
                ));
            }
        }
    }
    problems
}

#[cfg(test)]
mod tests {
    use super::problems;
    use crate::workspace::TextFile;

    #[test]
    fn paths_of_a_machine_are_found() {
        let text = "cd /work/main\nsee docs/work/page\n`/root/x`\n../../shared/a\n../shared/a\n".to_owned();
        let found = problems(&TextFile { path: "README.md".to_owned(), text });
        assert_eq!(found.iter().map(|p| p.line).collect::<Vec<_>>(), [1, 3, 4, 5]);
    }
}
