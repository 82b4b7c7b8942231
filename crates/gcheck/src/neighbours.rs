//! What the programs beside one show of their control: a program that shows little is for the control of the others.
//!
//! Knows: folders, how many must agree. Must not know: any control, what a program is asked for. A folder is read when the
//! first unclear program of it is met, and once.

use std::collections::HashMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, PoisonError};

use gcheck_controls::{Evidence, Weighed};
use twox_hash::XxHash3_64;

use crate::detection::evidence;
use crate::discovery::is_program_name;
use crate::{paths, reading};

/// Programs of one folder that are looked at: the first by name.
const MAX_FILES: usize = 200;
/// A larger file is not looked at: what it holds is not worth its reading.
const MAX_FILE: u64 = 4 << 20;
/// So many programs must show the control.
const ENOUGH: usize = 3;

/// What the programs of folders show, by absolute path; shared by all files of a run.
#[derive(Debug, Default)]
pub(crate) struct Neighbours {
    known: Mutex<HashMap<PathBuf, Arc<Vec<Neighbour>>>>,
    /// What was seen of programs as neighbours of others: each is taken out when its own turn comes, as it was then.
    ahead: Mutex<HashMap<PathBuf, (u64, Evidence)>>,
}

/// A program.
#[derive(Debug)]
struct Neighbour {
    path: PathBuf,
    /// The control that it shows, and the one that fits nearly as well; empty where it shows none.
    shows: Vec<String>,
    /// It is for a control or in a dialect that gcheck does not have.
    is_foreign: bool,
}

/// The control of most programs beside one.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Majority {
    pub(crate) control: String,
    /// Programs that clearly show it.
    count: usize,
    /// Programs beside the one.
    of: usize,
}

impl Majority {
    /// The reason, as a line about the control puts it.
    pub(crate) fn words(&self) -> String {
        format!("{} of {} show it", self.count, self.of)
    }
}

impl Neighbours {
    /// What a program and the end of its name show.
    pub(crate) fn evidence(&self, path: &Path, text: &str) -> Evidence {
        let ahead = || self.ahead.lock().unwrap_or_else(PoisonError::into_inner);
        let seen = if ahead().is_empty() { None } else { ahead().remove(&paths::absolute(path)) };
        match seen.filter(|(hash, _)| *hash == hash_of(text)) {
            Some((_, evidence)) => evidence,
            None => evidence(path, text),
        }
    }

    /// The control that most programs in the folder of `path` show, and none of them another.
    pub(crate) fn majority(&self, path: &Path) -> Option<Majority> {
        // What comes in by a pipe under a name of its own has no neighbours.
        let path = path.is_file().then(|| paths::absolute(path))?;
        let programs = self.programs(path.parent()?);
        let others = || programs.iter().filter(|program| program.path != path);
        if others().any(|program| program.is_foreign) {
            return None;
        }
        agreed(others().map(|program| program.shows.as_slice()))
    }

    fn programs(&self, folder: &Path) -> Arc<Vec<Neighbour>> {
        let known = || self.known.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(programs) = known().get(folder) {
            return Arc::clone(programs);
        }
        // Read without the lock: two threads that read one folder at the same time read the same.
        let programs = Arc::new(self.read(folder));
        Arc::clone(known().entry(folder.to_owned()).or_insert(programs))
    }

    fn read(&self, folder: &Path) -> Vec<Neighbour> {
        let Ok(entries) = fs::read_dir(folder) else { return Vec::new() };
        let is_small =
            |path: &PathBuf| fs::metadata(path).is_ok_and(|data| data.is_file() && data.len() <= MAX_FILE);
        let mut paths: Vec<PathBuf> =
            entries.flatten().map(|entry| entry.path()).filter(|path| is_program_name(path)).collect();
        paths.sort();
        let programs = paths.into_iter().filter(is_small).take(MAX_FILES).filter_map(|path| {
            let source = reading::file(&path).ok()?;
            let evidence = evidence(&path, source.text());
            let weighed = Weighed::new(&evidence);
            let guess = weighed.guess();
            let is_foreign =
                guess.is_none() && (evidence.unsupported.is_some() || weighed.foreign().is_some());
            let shows = guess.map(|guess| [Some(guess.control), guess.rival]).into_iter().flatten().flatten();
            let shows = shows.collect();
            let seen = (hash_of(source.text()), evidence);
            self.ahead.lock().unwrap_or_else(PoisonError::into_inner).insert(path.clone(), seen);
            Some(Neighbour { path, shows, is_foreign })
        });
        programs.collect()
    }
}

/// The control that more than half of the programs show, and none of them another: programs of several controls in one folder
/// say nothing of each other.
fn agreed<'s>(shown: impl Iterator<Item = &'s [String]>) -> Option<Majority> {
    let shown: Vec<&[String]> = shown.collect();
    let mut alone = shown.iter().filter(|shows| shows.len() == 1);
    let control = alone.next()?.first()?;
    let is_one = shown.iter().all(|shows| shows.is_empty() || shows.contains(control));
    let (count, of) = (1 + alone.count(), shown.len());
    let is_agreed = is_one && count >= ENOUGH && count * 2 > of;
    is_agreed.then(|| Majority { control: control.clone(), count, of })
}

fn hash_of(text: &str) -> u64 {
    XxHash3_64::oneshot(text.as_bytes())
}

#[cfg(test)]
mod tests {
    use super::{Majority, agreed};

    /// Programs by what they show: `a-mill`, or `a-mill b-mill` where the second fits nearly as well.
    fn check(shown: &[&str], expected: Option<(&str, usize, usize)>) {
        let shown: Vec<Vec<String>> =
            shown.iter().map(|shows| shows.split_whitespace().map(str::to_owned).collect()).collect();
        let expected =
            expected.map(|(control, count, of)| Majority { control: control.to_owned(), count, of });
        assert_eq!(agreed(shown.iter().map(Vec::as_slice)), expected);
    }

    #[test]
    fn most_programs_must_clearly_agree() {
        check(&["a-mill", "a-mill", "a-mill", ""], Some(("a-mill", 3, 4)));
        check(&[&["a-mill"; 19][..], &["a-lathe"]].concat(), None);
        check(&["a-mill", "a-mill", "a-mill", "b-mill a-mill"], Some(("a-mill", 3, 4)));
        check(&["a-mill", "a-mill", "a-mill", "b-mill b-lathe"], None);
        check(&["a-mill", "a-mill"], None);
        check(&["a-mill", "a-mill", "a-mill", "a-lathe"], None);
        check(&["a-mill", "a-mill", "a-mill", "", "", ""], None);
        check(&[], None);
    }
}
