//! Which programs of two folders belong together.
//!
//! Knows: paths, contents, program numbers. Must not know: how programs are compared.

use std::collections::HashMap;
use std::hash::Hash;
use std::path::{Path, PathBuf};

use crate::config::Configs;
use crate::{Problem, discovery, paths, programs, reading};

/// Two programs that belong together.
#[derive(Debug)]
pub(super) struct Pair {
    /// The path of the first from its folder, as messages call the pair.
    pub(super) name: String,
    pub(super) files: [PathBuf; 2],
    pub(super) by: By,
}

/// By what two programs were found to belong together.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum By {
    /// They were named on the command line.
    Command,
    /// The same path from each folder.
    Path,
    /// The same bytes.
    Content,
    /// The same program number, which no other program of either folder has.
    Number,
    /// The same name, in other folders.
    Name,
}

impl By {
    /// Its name for other programs.
    pub(super) const fn name(self) -> &'static str {
        match self {
            Self::Command => "command",
            Self::Path => "path",
            Self::Content => "content",
            Self::Number => "program-number",
            Self::Name => "name",
        }
    }
}

/// The programs of two folders.
#[derive(Debug, Default)]
pub(super) struct Pairs {
    pub(super) found: Vec<Pair>,
    /// Programs of one folder alone, by their paths from it.
    pub(super) alone: [Vec<(String, PathBuf)>; 2],
    /// What could not be looked at.
    pub(super) problems: Vec<Problem>,
}

/// A larger file is paired by its path or name only.
const MAX_BYTES: u64 = 64 << 20;

/// Pairs the programs of two folders: by path, and what is left by content, program number and name.
pub(super) fn of_folders(folders: [&Path; 2], configs: &mut Configs) -> Pairs {
    let mut pairs = Pairs::default();
    let mut left = folders.map(|folder| {
        let found = discovery::find(&[folder.to_owned()], configs);
        pairs.problems.extend(found.problems);
        let named = found.files.into_iter().map(|file| {
            let name = paths::shown(file.strip_prefix(folder).unwrap_or(&file));
            (name, file)
        });
        named.collect::<Vec<_>>()
    });
    pairs.match_by(By::Path, &mut left, |name, _| Some(name.to_owned()));
    pairs.match_by(By::Content, &mut left, |_, file| reading::regular(file, MAX_BYTES).ok());
    pairs.match_by(By::Number, &mut left, |_, file| {
        programs::first_number(&reading::regular(file, MAX_BYTES).ok()?)
    });
    pairs.match_by(By::Name, &mut left, |_, file| Some(file.file_name()?.to_owned()));
    pairs.found.sort_by(|a, b| a.name.cmp(&b.name));
    pairs.alone = left;
    pairs
}

impl Pairs {
    /// Takes those out of what is left whose keys are equal, and each the only one of its folder with it.
    fn match_by<K: Eq + Hash>(
        &mut self,
        by: By,
        left: &mut [Vec<(String, PathBuf)>; 2],
        key: impl Fn(&str, &Path) -> Option<K>,
    ) {
        let [a, b] = left;
        if a.is_empty() || b.is_empty() {
            return;
        }
        let by_key = |files: &[(String, PathBuf)]| {
            let mut known: HashMap<K, Option<usize>> = HashMap::new();
            for (index, (name, file)) in files.iter().enumerate() {
                if let Some(key) = key(name, file) {
                    known.entry(key).and_modify(|only| *only = None).or_insert(Some(index));
                }
            }
            known
        };
        let others = by_key(b);
        let matched: Vec<(usize, usize)> =
            by_key(a).into_iter().filter_map(|(key, index)| Some((index?, (*others.get(&key)?)?))).collect();
        let [mut taken_a, mut taken_b] = [vec![false; a.len()], vec![false; b.len()]];
        for (first, second) in matched {
            let (Some((name, file)), Some((_, other))) = (a.get(first), b.get(second)) else { continue };
            self.found.push(Pair { name: name.clone(), files: [file.clone(), other.clone()], by });
            for (taken, index) in [(&mut taken_a, first), (&mut taken_b, second)] {
                if let Some(is_taken) = taken.get_mut(index) {
                    *is_taken = true;
                }
            }
        }
        for (files, taken) in [(a, taken_a), (b, taken_b)] {
            let mut taken = taken.into_iter();
            files.retain(|_| !taken.next().unwrap_or(false));
        }
    }
}
