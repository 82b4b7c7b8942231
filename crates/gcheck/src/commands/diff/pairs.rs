//! Which programs of two folders belong together.
//!
//! Knows: paths, contents, program numbers. Must not know: how programs are compared.

use std::collections::HashMap;
use std::hash::Hash;
use std::path::{Path, PathBuf};

use twox_hash::XxHash3_128;

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

    /// Its name for people.
    pub(super) const fn words(self) -> &'static str {
        match self {
            Self::Number => "program number",
            _ => self.name(),
        }
    }
}

impl Pair {
    /// The second program and why it belongs to the first, for people; `None` where that is what they expect.
    pub(super) fn partner(&self) -> Option<String> {
        let [_, partner] = &self.files;
        let is_expected = matches!(self.by, By::Command | By::Path);
        (!is_expected).then(|| format!("{}, by {}", paths::shown(partner), self.by.words()))
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

/// A program that has no partner yet.
struct Single {
    /// Its path from the folder.
    name: String,
    file: PathBuf,
    /// A digest of its content, and its program number; `None` while nobody has looked, and for what cannot be read.
    content: Option<(u128, Option<u32>)>,
}

impl Single {
    fn look(&mut self) {
        let bytes = reading::regular(&self.file, MAX_BYTES).ok();
        self.content = bytes.map(|bytes| (XxHash3_128::oneshot(&bytes), programs::first_number(&bytes)));
    }
}

/// Pairs the programs of two folders: by path, and what is left by content, program number and name.
pub(super) fn of_folders(folders: [&Path; 2], configs: &mut Configs) -> Pairs {
    let mut pairs = Pairs::default();
    let mut left = folders.map(|folder| {
        let found = discovery::find(&[folder.to_owned()], configs);
        pairs.problems.extend(found.problems);
        let single = |file: PathBuf| {
            let name = paths::shown(file.strip_prefix(folder).unwrap_or(&file));
            Single { name, file, content: None }
        };
        found.files.into_iter().map(single).collect::<Vec<_>>()
    });
    pairs.match_by(By::Path, &mut left, |single| Some(single.name.clone()));
    if left.iter().all(|side| !side.is_empty()) {
        left.iter_mut().flatten().for_each(Single::look);
    }
    pairs.match_by(By::Content, &mut left, |single| Some(single.content?.0));
    pairs.match_by(By::Number, &mut left, |single| single.content?.1);
    pairs.match_by(By::Name, &mut left, |single| Some(single.file.file_name()?.to_owned()));
    pairs.found.sort_by(|a, b| a.name.cmp(&b.name));
    pairs.alone = left.map(|side| side.into_iter().map(|single| (single.name, single.file)).collect());
    pairs
}

impl Pairs {
    /// Takes those out of what is left whose keys are equal, and each the only one of its folder with it.
    fn match_by<K: Eq + Hash>(
        &mut self,
        by: By,
        left: &mut [Vec<Single>; 2],
        key: impl Fn(&Single) -> Option<K>,
    ) {
        let by_key = |side: &[Single]| {
            let mut known: HashMap<K, Option<usize>> = HashMap::new();
            for (index, single) in side.iter().enumerate() {
                if let Some(key) = key(single) {
                    known.entry(key).and_modify(|only| *only = None).or_insert(Some(index));
                }
            }
            known
        };
        let [a, b] = left;
        let others = by_key(b);
        let partner = |(key, index): (K, Option<usize>)| Some((index?, (*others.get(&key)?)?));
        let mut partners: HashMap<usize, usize> = by_key(a).into_iter().filter_map(partner).collect();
        let mut rest: Vec<Option<Single>> = std::mem::take(b).into_iter().map(Some).collect();
        for (index, single) in std::mem::take(a).into_iter().enumerate() {
            let partner = partners.remove(&index).and_then(|partner| rest.get_mut(partner)?.take());
            match partner {
                Some(partner) => {
                    self.found.push(Pair { name: single.name, files: [single.file, partner.file], by });
                }
                None => a.push(single),
            }
        }
        b.extend(rest.into_iter().flatten());
    }
}
