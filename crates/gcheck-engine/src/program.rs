//! The programs of an execution: the main file, and what its calls bring in.
//!
//! Knows: files by index, where a program or subroutine begins, names of parameters as small numbers. Must not know: how files
//! are found (a [`Library`] does), values.

use std::borrow::Cow;
use std::cell::RefCell;
use std::ffi::OsStr;
use std::path::Path;
use std::rc::Rc;

use gcheck_program::{Dialect, Loaded, OLabel};
use rustc_hash::FxHashMap;

use crate::origin::At;
use crate::state::NameId;

/// Programs that stand in other files.
pub trait Library {
    /// The file with the program of a number.
    fn by_number(&self, number: u32) -> Option<SourceFile>;
    /// The file with the subroutine of a name, lower case.
    fn by_name(&self, name: &str) -> Option<SourceFile>;
}

/// A file that a library found.
#[derive(Debug, Clone)]
pub struct SourceFile {
    /// Its name, as findings show it.
    pub name: Rc<str>,
    /// Its text.
    pub text: String,
}

/// The number that a file is named by, from its name without the extension: `O1234`, `1234`.
pub fn number_of_name(stem: &str) -> Option<u32> {
    stem.strip_prefix(['O', 'o']).unwrap_or(stem).parse().ok()
}

/// No other files.
#[derive(Debug, Clone, Copy, Default)]
pub struct NoLibrary;

impl Library for NoLibrary {
    fn by_number(&self, _: u32) -> Option<SourceFile> {
        None
    }

    fn by_name(&self, _: &str) -> Option<SourceFile> {
        None
    }
}

/// A file of an execution.
#[derive(Debug)]
pub struct ProgramFile<'a> {
    /// Its name; empty for the main file.
    pub name: Rc<str>,
    /// Its blocks.
    pub loaded: Loaded<'a>,
}

/// The files of an execution.
pub struct Program<'a> {
    dialect: &'a Dialect<'a>,
    library: &'a dyn Library,
    main: Rc<ProgramFile<'a>>,
    /// Files that calls brought in; they own their text.
    others: RefCell<Vec<Rc<ProgramFile<'static>>>>,
    names: RefCell<Names>,
    numbers: RefCell<FxHashMap<u32, Option<At>>>,
    subroutines: RefCell<FxHashMap<OLabel, Option<At>>>,
}

/// What a program has looked up beside its main file, for another execution after an edit of that: so that files and names
/// keep their numbers.
#[derive(Debug, Default)]
pub struct LookedUp {
    others: Vec<Rc<ProgramFile<'static>>>,
    names: Names,
    numbers: FxHashMap<u32, Option<At>>,
    subroutines: FxHashMap<OLabel, Option<At>>,
}

impl LookedUp {
    /// How many files calls have brought in.
    pub fn files(&self) -> usize {
        self.others.len()
    }
}

#[derive(Debug, Default)]
struct Names {
    ids: FxHashMap<Rc<str>, u32>,
    texts: Vec<Rc<str>>,
    /// By file, chunk and first byte: names already read.
    places: FxHashMap<(u32, u32, u32), NameId>,
}

impl std::fmt::Debug for Program<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Program").field("others", &self.others.borrow().len()).finish_non_exhaustive()
    }
}

impl<'a> Program<'a> {
    /// A main file, and where others are found.
    pub fn new(main: Loaded<'a>, dialect: &'a Dialect<'a>, library: &'a dyn Library) -> Self {
        Self::with(main, dialect, library, LookedUp::default())
    }

    /// As [`Program::new`], with what was looked up before.
    pub fn with(
        main: Loaded<'a>,
        dialect: &'a Dialect<'a>,
        library: &'a dyn Library,
        known: LookedUp,
    ) -> Self {
        let main = Rc::new(ProgramFile { name: Rc::from(""), loaded: main });
        let LookedUp { others, mut names, numbers, subroutines } = known;
        // Where names stand in the main file is not known any more.
        names.places.clear();
        Self {
            dialect,
            library,
            main,
            others: RefCell::new(others),
            names: RefCell::new(names),
            numbers: RefCell::new(numbers),
            subroutines: RefCell::new(subroutines),
        }
    }

    /// What was looked up beside the main file.
    pub fn into_looked_up(self) -> LookedUp {
        LookedUp {
            others: self.others.into_inner(),
            names: self.names.into_inner(),
            numbers: self.numbers.into_inner(),
            subroutines: self.subroutines.into_inner(),
        }
    }

    /// The control that reads it.
    pub fn dialect(&self) -> &'a Dialect<'a> {
        self.dialect
    }

    /// A file by its index; the main file is 0.
    pub fn file(&self, index: u32) -> Option<Rc<ProgramFile<'a>>> {
        match index.checked_sub(1) {
            None => Some(Rc::clone(&self.main)),
            Some(other) => {
                let file: Rc<ProgramFile<'a>> = self.others.borrow().get(other as usize).cloned()?;
                Some(file)
            }
        }
    }

    /// Where the program of a number begins, as seen from a file.
    pub fn find_number(&self, number: u32, from: u32) -> Option<At> {
        let in_file = |file: u32| {
            let block = self.file(file)?.loaded.flow_graph().program(number)?.blocks.start;
            Some(At { file, block })
        };
        if let Some(found) = in_file(from).or_else(|| in_file(0)) {
            return Some(found);
        }
        if let Some(known) = self.numbers.borrow().get(&number) {
            return *known;
        }
        // Where O-words are labels, a file is found by its name, whatever labels stand in it.
        let by_name = self.dialect.control().syntax().o_words;
        let source =
            if by_name { self.library.by_name(&number.to_string()) } else { self.library.by_number(number) };
        let found = source.and_then(|source| {
            let file = self.load(source);
            in_file(file).or_else(|| {
                // A file may be named by the number without a number in it; one of another number is another program.
                let is_another = |file: Rc<ProgramFile<'_>>| {
                    let stem = Path::new(&*file.name).file_stem().and_then(OsStr::to_str);
                    stem.and_then(number_of_name) != Some(number)
                        && file.loaded.flow_graph().programs().any(|program| program.number.is_some())
                };
                (!self.file(file).is_some_and(is_another)).then_some(At { file, block: 0 })
            })
        });
        self.numbers.borrow_mut().insert(number, found);
        found
    }

    /// The `SUB` block of a subroutine, as seen from a file.
    pub(crate) fn find_subroutine(&self, label: &OLabel, from: u32) -> Option<At> {
        let in_file = |file: u32| {
            let block = self.file(file)?.loaded.flow_graph().sub(label)?;
            Some(At { file, block })
        };
        if let Some(found) = in_file(from).or_else(|| in_file(0)) {
            return Some(found);
        }
        if let Some(known) = self.subroutines.borrow().get(label) {
            return *known;
        }
        let source = match label {
            OLabel::Name(name) => self.library.by_name(name),
            OLabel::Number(number) => self.library.by_name(&number.to_string()),
            OLabel::Computed => None,
        };
        let found = source.and_then(|source| in_file(self.load(source)));
        self.subroutines.borrow_mut().insert(label.clone(), found);
        found
    }

    /// Adds a file, unless one of its name is there.
    fn load(&self, source: SourceFile) -> u32 {
        let known = self.others.borrow().iter().position(|file| file.name == source.name);
        if let Some(index) = known {
            return index as u32 + 1;
        }
        let loaded = Loaded::new(Cow::Owned(source.text), self.dialect, |_, _, _| ());
        let mut others = self.others.borrow_mut();
        others.push(Rc::new(ProgramFile { name: source.name, loaded }));
        others.len() as u32
    }

    /// The small number of a parameter's name that stands at a place.
    pub(crate) fn name_at(&self, file: u32, chunk: u32, range: (u32, u32), text: &str) -> NameId {
        if let Some(id) = self.names.borrow().places.get(&(file, chunk, range.0)) {
            return *id;
        }
        let name = text.get(range.0 as usize..range.1 as usize).unwrap_or_default();
        let name: String = name.chars().filter(|c| !c.is_whitespace()).flat_map(char::to_lowercase).collect();
        let id = self.name(&name);
        self.names.borrow_mut().places.insert((file, chunk, range.0), id);
        id
    }

    /// The small number of a parameter's name, lower case without blanks.
    pub(crate) fn name(&self, name: &str) -> NameId {
        let mut names = self.names.borrow_mut();
        if let Some(id) = names.ids.get(name) {
            return NameId(*id);
        }
        let text: Rc<str> = Rc::from(name);
        let id = names.texts.len() as u32;
        names.texts.push(Rc::clone(&text));
        names.ids.insert(text, id);
        NameId(id)
    }

    /// The name behind a small number.
    pub fn name_text(&self, id: NameId) -> Rc<str> {
        self.names.borrow().texts.get(id.0 as usize).cloned().unwrap_or_else(|| Rc::from(""))
    }
}
