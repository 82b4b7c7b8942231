//! `cargo xtask tidy`: the laws of the repository that no compiler checks.
//!
//! Knows: the list of checks. Must not know: any law; each check is a module that states its law as data.

mod deny;
mod forms;
mod layers;
mod links;
mod names;
mod paths;
mod surroundings;
mod tokens;

use std::fmt;
use std::path::Path;
use std::process::ExitCode;

use crate::workspace::{self, TextFile};

/// A place where a law is broken.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Problem {
    path: String,
    /// From 1; 0 when the whole file is meant.
    line: usize,
    message: String,
}

impl Problem {
    fn new(path: impl Into<String>, line: usize, message: impl Into<String>) -> Self {
        Self { path: path.into(), line, message: message.into() }
    }
}

impl fmt::Display for Problem {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.line {
            0 => write!(f, "{}: {}", self.path, self.message),
            line => write!(f, "{}:{line}: {}", self.path, self.message),
        }
    }
}

/// Runs every check over the repository and prints what is wrong.
pub(crate) fn run(arguments: &[String]) -> anyhow::Result<ExitCode> {
    if let Some(argument) = arguments.first() {
        anyhow::bail!("`{argument}` is no argument of tidy");
    }
    let problems = check()?;
    for problem in &problems {
        println!("{problem}");
    }
    println!(
        "tidy: {}",
        if problems.is_empty() { "clean".to_owned() } else { format!("{} problems", problems.len()) }
    );
    Ok(if problems.is_empty() { ExitCode::SUCCESS } else { ExitCode::FAILURE })
}

/// What is wrong in the repository, in order of files.
pub(crate) fn check() -> anyhow::Result<Vec<Problem>> {
    let files = workspace::text_files(workspace::root())?;
    let members = workspace::members()?;
    let deny = deny::Deny::read(workspace::root())?;

    let mut problems = layers::problems(&layers::packages(&members));
    problems.extend(deny::bans(&deny));
    problems.extend(deny::licences(&deny, &deny::licences_in_use(&workspace::graph()?)));
    problems.extend(check_files(&files));
    problems.extend(links::problems(&files, |path| workspace::root().join(path).exists()));
    problems.sort_by(|a, b| (&a.path, a.line).cmp(&(&b.path, b.line)));
    Ok(problems)
}

fn check_files(files: &[TextFile]) -> Vec<Problem> {
    let banned = names::banned(files);
    let mut problems = Vec::new();
    for file in files {
        problems.extend(paths::problems(file));
        if Path::new(&file.path).extension().is_none_or(|extension| extension != "rs") {
            continue;
        }
        match tokens::RustFile::new(file) {
            Ok(rust) => {
                problems.extend(forms::problems(&rust));
                problems.extend(names::problems(&rust, &banned));
                problems.extend(surroundings::problems(&rust));
            }
            Err(problem) => problems.push(problem),
        }
    }
    problems
}

#[cfg(test)]
mod tests {
    #[test]
    fn the_repository_is_tidy() {
        let problems = super::check().unwrap();
        let list: Vec<_> = problems.iter().map(ToString::to_string).collect();
        assert!(list.is_empty(), "{} problems; see `cargo xtask tidy`:\n{}", list.len(), list.join("\n"));
    }
}
