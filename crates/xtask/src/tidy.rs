//! `cargo xtask tidy`: the laws of the repository that no compiler checks.
//!
//! Knows: the list of checks. Must not know: any law; each check is a module that states its law as data.

mod circles;
mod deny;
mod forms;
mod layers;
mod lengths;
mod links;
mod modules;
mod names;
mod paths;
mod problem;
mod prose;
mod rules_apart;
mod surroundings;
mod tokens;

use std::path::Path;
use std::process::ExitCode;

use problem::Problem;

use crate::blind;
use crate::workspace::{self, TextFile};

/// Runs every check over the repository and prints what is wrong.
pub(crate) fn run(arguments: &[String]) -> anyhow::Result<ExitCode> {
    if let Some(argument) = arguments.first() {
        anyhow::bail!("`{argument}` is not an argument of tidy");
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
    problems.extend(check_files(&files)?);
    problems.extend(links::problems(&files, |path| workspace::root().join(path).exists()));
    let seals = blind::seals().to_string_lossy();
    problems.extend(
        blind::broken_seals(&files).into_iter().map(|(line, words)| Problem::new(&*seals, line, words)),
    );
    problems.sort_by(|a, b| (&a.path, a.line).cmp(&(&b.path, b.line)));
    Ok(problems)
}

fn check_files(files: &[TextFile]) -> anyhow::Result<Vec<Problem>> {
    let banned = names::banned(files);
    let mut problems: Vec<Problem> = files.iter().flat_map(paths::problems).collect();
    let mut rust = Vec::new();
    for file in files.iter().filter(|file| is_rust(file)) {
        match tokens::RustFile::new(file) {
            Ok(read) => rust.push(read),
            Err(problem) => problems.push(problem),
        }
    }
    modules::mark_test_files(&mut rust);
    for file in &rust {
        problems.extend(forms::problems(file));
        problems.extend(lengths::problems(file));
        problems.extend(names::problems(file, &banned));
        problems.extend(surroundings::problems(file));
    }
    problems.extend(rules_apart::problems(&rust));
    problems.extend(circles::problems(&rust));
    problems.extend(prose::problems(files, &rust)?);
    Ok(problems)
}

fn is_rust(file: &TextFile) -> bool {
    Path::new(&file.path).extension().is_some_and(|extension| extension == "rs")
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
