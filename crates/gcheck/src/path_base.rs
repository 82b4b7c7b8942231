//! The root from which the formats of servers name files: what an option says, what a CI server says, the repository.
//!
//! Knows: environment variables of CI servers, where a repository begins. Must not know: formats.

use std::env;
use std::path::{Path, PathBuf};

use gcheck_report::PathBase;

use crate::paths;

/// Variables of CI servers that hold the folder of the repository.
const VARIABLES: [&str; 2] = ["CI_PROJECT_DIR", "GITHUB_WORKSPACE"];

/// The root that an option names; else that of the CI server, or of the repository, which gcheck runs in. `None` outside of
/// all of these.
pub(crate) fn of(option: Option<&Path>) -> Option<PathBase> {
    let here = paths::absolute(Path::new("."));
    let base = match option {
        Some(base) => paths::absolute(base),
        None => of_server(&here).or_else(|| of_repository(&here))?,
    };
    Some(PathBase { base: paths::shown(&base), here: paths::shown(&here) })
}

/// A folder that a server names and that does not hold the current one is that of another job.
fn of_server(here: &Path) -> Option<PathBuf> {
    let named = VARIABLES.into_iter().filter_map(env::var_os).filter(|folder| !folder.is_empty());
    named.map(|folder| paths::absolute(Path::new(&folder))).find(|folder| here.starts_with(folder))
}

fn of_repository(here: &Path) -> Option<PathBuf> {
    here.ancestors().find(|folder| folder.join(".git").exists()).map(Path::to_owned)
}
