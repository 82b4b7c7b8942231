//! Programs beside the one that is checked: what `M98`, `G65` and O-words may call.
//!
//! Knows: folders, how a file shows the program numbers it holds. Must not know: calls. A folder is looked through when
//! the first call asks, and once; a folder that is too large to be searched counts as having everything, so that
//! nothing false is reported. Programs that are open in an editor replace their files.

use std::collections::HashMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, PoisonError};

use gcheck_engine::{Library, SourceFile, number_of_name};
use gcheck_lint::Programs;
use gcheck_program::code_region;
use gcheck_server::OpenPrograms;

use crate::discovery::is_program_name;
use crate::{paths, reading};

/// Files of one folder that are looked into.
const MAX_FILES: usize = 5_000;
/// Bytes of one folder that are looked through.
const MAX_BYTES: u64 = 64 << 20;

/// What folders hold, by absolute path; shared by all files of a run.
#[derive(Debug, Default)]
pub(crate) struct ProgramFolders {
    known: Mutex<HashMap<PathBuf, Arc<Folder>>>,
}

/// The programs of one folder.
#[derive(Debug, Default)]
struct Folder {
    /// By number: the first file that holds a program of it, or is named by it.
    numbers: HashMap<u32, PathBuf>,
    /// By the stem of the file's name, lower case.
    names: HashMap<String, PathBuf>,
    /// Too large to be looked through.
    is_partial: bool,
}

/// The programs that one file can call.
pub(crate) struct Reachable {
    folders: Arc<ProgramFolders>,
    /// The file's own folder, then those of the search path.
    paths: Vec<PathBuf>,
    /// The file itself: what it lacks is not found by reading it once more.
    main: PathBuf,
    open: Option<Open>,
}

/// The programs that are open in an editor.
struct Open {
    texts: Arc<dyn OpenPrograms>,
    /// The numbers in each, with the state of the text that they were read from.
    numbers: Mutex<HashMap<PathBuf, (u64, Vec<u32>)>>,
}

impl Open {
    /// The open program of a folder that has a number.
    fn by_number(&self, folder: &Path, number: u32) -> Option<PathBuf> {
        let mut known = self.numbers.lock().unwrap_or_else(PoisonError::into_inner);
        let mut has = |path: &PathBuf, state: u64| {
            let is_fresh = known.get(path).is_some_and(|(read, _)| *read == state);
            if !is_fresh {
                let text = self.texts.text(path).unwrap_or_default();
                known.insert(path.clone(), (state, numbers_in(text.as_bytes())));
            }
            is_named(path, number) || known.get(path).is_some_and(|(_, numbers)| numbers.contains(&number))
        };
        let programs = self.texts.in_folder(folder).into_iter();
        programs
            .filter(|(path, _)| is_program_name(path))
            .find(|(path, state)| has(path, *state))
            .map(|(path, _)| path)
    }

    /// The open program of a folder whose file has a name.
    fn by_name(&self, folder: &Path, name: &str) -> Option<PathBuf> {
        let programs = self.texts.in_folder(folder).into_iter().map(|(path, _)| path);
        programs.filter(|path| is_program_name(path)).find(|path| stem(path).as_deref() == Some(name))
    }
}

impl Reachable {
    /// For the program at `path`, with the folders of its search path.
    pub(crate) fn new(folders: Arc<ProgramFolders>, path: &Path, search: &[PathBuf]) -> Self {
        let own = path.parent().map(PathBuf::from).unwrap_or_default();
        let paths = std::iter::once(own).chain(search.iter().cloned()).collect();
        Self { folders, paths, main: paths::absolute(path), open: None }
    }

    /// The same with programs that are open in an editor.
    pub(crate) fn with_open(self, texts: Arc<dyn OpenPrograms>) -> Self {
        Self { open: Some(Open { texts, numbers: Mutex::default() }), ..self }
    }

    /// The folders, the file's own first.
    pub(crate) fn folders(&self) -> &[PathBuf] {
        &self.paths
    }

    /// A file that cannot be read is not there: who asks says which program is missing.
    fn read(&self, path: &Path) -> Option<SourceFile> {
        if path == self.main {
            return None;
        }
        let Some(open) = &self.open else {
            let text = reading::file(path).ok()?.text().to_owned();
            return Some(SourceFile { name: paths::shown_from_here(path).into(), text });
        };
        // An editor needs to find the file, from wherever it was started.
        let name = path.to_string_lossy().into();
        let text = open.texts.text(path).or_else(|| Some(reading::file(path).ok()?.text().to_owned()))?;
        Some(SourceFile { name, text })
    }

    /// The file of the first folder that has the program.
    fn find(
        &self,
        in_open: impl Fn(&Open, &Path) -> Option<PathBuf>,
        on_disk: impl Fn(&Folder) -> Option<&PathBuf>,
        by_name: impl Fn(&Path) -> bool,
    ) -> Option<PathBuf> {
        self.paths.iter().find_map(|folder| {
            let editor = self.open.as_ref();
            if let Some(found) = editor.and_then(|open| in_open(open, folder)) {
                return Some(found);
            }
            let found = on_disk(&self.folders.of(folder)).cloned()?;
            // What the file holds on disk says nothing about what it holds in the editor.
            let is_in_editor = editor
                .is_some_and(|open| open.texts.in_folder(folder).iter().any(|(path, _)| *path == found));
            (!is_in_editor || by_name(&found)).then_some(found)
        })
    }

    fn file_of_number(&self, number: u32) -> Option<PathBuf> {
        self.find(
            |open, folder| open.by_number(folder, number),
            |folder| folder.numbers.get(&number),
            |path| is_named(path, number),
        )
    }

    fn file_of_name(&self, name: &str) -> Option<PathBuf> {
        self.find(|open, folder| open.by_name(folder, name), |folder| folder.names.get(name), |_| true)
    }

    /// A folder too large to be looked through may hold anything.
    fn is_partial(&self) -> bool {
        self.paths.iter().any(|path| self.folders.of(path).is_partial)
    }
}

impl Programs for Reachable {
    fn has_number(&self, number: u32) -> bool {
        self.file_of_number(number).is_some() || self.is_partial()
    }

    fn has_name(&self, name: &str) -> bool {
        self.file_of_name(name).is_some() || self.is_partial()
    }

    fn source_of_number(&self, number: u32) -> Option<SourceFile> {
        self.by_number(number)
    }

    fn source_of_name(&self, name: &str) -> Option<SourceFile> {
        self.by_name(name)
    }
}

impl Library for Reachable {
    fn by_number(&self, number: u32) -> Option<SourceFile> {
        self.read(&self.file_of_number(number)?)
    }

    fn by_name(&self, name: &str) -> Option<SourceFile> {
        self.read(&self.file_of_name(name)?)
    }
}

impl ProgramFolders {
    fn of(&self, path: &Path) -> Arc<Folder> {
        let path = paths::absolute(path);
        // A panic while the map was locked cannot have left it half-written: entries are inserted whole.
        let mut known = self.known.lock().unwrap_or_else(PoisonError::into_inner);
        Arc::clone(known.entry(path).or_insert_with_key(|path| Arc::new(Folder::read(path))))
    }
}

impl Folder {
    /// What cannot be read is not there: the check of the file itself says what is wrong with it.
    fn read(path: &Path) -> Self {
        let mut folder = Self::default();
        let Ok(entries) = fs::read_dir(path) else { return folder };
        let mut programs: Vec<PathBuf> = entries
            .flatten()
            .map(|entry| entry.path())
            .filter(|path| is_program_name(path) && path.is_file())
            .collect();
        // Folders are listed in any order; which of two programs of one number is called must not depend on it.
        programs.sort();
        for path in &programs {
            let Some(stem) = stem(path) else { continue };
            if let Some(number) = number_of_name(&stem) {
                folder.numbers.entry(number).or_insert_with(|| path.clone());
            }
            // Subroutines called by name are in files of one extension.
            let is_usual = path.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("ngc"));
            if is_usual || !folder.names.contains_key(&stem) {
                folder.names.insert(stem, path.clone());
            }
        }
        let mut bytes = 0;
        for (count, path) in programs.iter().enumerate() {
            bytes += path.metadata().map_or(0, |data| data.len());
            if count >= MAX_FILES || bytes > MAX_BYTES {
                folder.is_partial = true;
                return folder;
            }
            if let Ok(content) = reading::regular(path, MAX_BYTES) {
                for number in numbers_in(&content) {
                    folder.numbers.entry(number).or_insert_with(|| path.clone());
                }
            }
        }
        folder
    }
}

/// The name of a file without its extension, lower case.
fn stem(path: &Path) -> Option<String> {
    path.file_stem().map(|stem| stem.to_string_lossy().to_lowercase())
}

fn is_named(path: &Path, number: u32) -> bool {
    stem(path).is_some_and(|stem| number_of_name(&stem) == Some(number))
}

/// Words after a number that call or steer: `O100 call` and `O101 while` begin no program.
const NOT_A_BEGINNING: [&str; 14] = [
    "call",
    "endsub",
    "return",
    "if",
    "elseif",
    "else",
    "endif",
    "while",
    "endwhile",
    "do",
    "repeat",
    "endrepeat",
    "break",
    "continue",
];

/// Numbers of `O1234` and `:1234` at the heads of lines, in the part of the file that a control reads.
fn numbers_in(content: &[u8]) -> Vec<u32> {
    let text = String::from_utf8_lossy(content);
    let read = text.get(code_region(&text)).unwrap_or_default();
    read.split(['\n', '\r']).filter_map(number_at_head).collect()
}

/// The first program number in the part of the file that a control reads.
pub(crate) fn first_number(content: &[u8]) -> Option<u32> {
    numbers_in(content).first().copied()
}

fn number_at_head(line: &str) -> Option<u32> {
    let digits = line.trim_ascii_start().strip_prefix(['O', 'o', ':'])?;
    let end = digits.find(|c: char| !c.is_ascii_digit()).unwrap_or(digits.len());
    let (number, rest) = digits.split_at_checked(end)?;
    let word = rest.trim_ascii_start().split(|c: char| !c.is_ascii_alphabetic()).next().unwrap_or_default();
    if NOT_A_BEGINNING.iter().any(|not| word.eq_ignore_ascii_case(not)) {
        return None;
    }
    number.parse().ok()
}

#[cfg(test)]
mod tests {
    use super::numbers_in;

    #[test]
    fn what_is_after_the_tape_is_not_there() {
        assert_eq!(numbers_in(b"%\nO1\nM30\n%\n%\nO2\nM30\n%\n"), [1]);
        assert_eq!(numbers_in(b"O1\nM30\n%\nO2\n"), [1]);
    }

    #[test]
    fn numbers_stand_at_the_heads_of_lines() {
        let numbers =
            numbers_in(b"%\r\nO0100 (A)\nG0 O5\n :200\no300 sub\nO<name> call\nO400 call\no401 While [1]\n");
        assert_eq!(numbers, [100, 200, 300]);
    }
}
