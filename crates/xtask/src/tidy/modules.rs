//! The modules of a crate, and which of them uses which.
//!
//! Knows: how `mod` and `use` declarations make a tree of files, and how a path leads through it. Must not know: any law.
//!
//! A module is a file; inline modules belong to theirs, tests are left out. *A uses B* when code of A names an item that B
//! defines, whichever way the path takes: through re-exports it leads to the file of the definition, so that nobody uses a
//! module because it hands a name on. A `use` with a visibility of its own is a re-export, and counts only if the file that
//! holds it needs the name itself. Calls of methods are not seen; their types are.

use std::collections::{BTreeMap, BTreeSet, HashMap, HashSet};

use super::tokens::{Placed, RustFile, Token, starts_with};

/// Roots of crates: each is a graph of its own.
const ROOTS: [&str; 2] = ["src/lib.rs", "src/main.rs"];

/// The root files of all crates.
pub(super) fn roots<'f>(files: &'f [RustFile<'f>]) -> impl Iterator<Item = &'f RustFile<'f>> {
    files.iter().filter(|file| {
        let place = file.path.strip_prefix("crates/").and_then(|path| path.split_once('/'));
        place.is_some_and(|(_, rest)| ROOTS.contains(&rest))
    })
}

/// Marks the files that a crate takes in for tests only: `#[cfg(test)] mod laws;`, and the modules below such a one.
pub(super) fn mark_test_files(files: &mut [RustFile<'_>]) {
    let mut product = HashSet::new();
    let mut with_tests = HashSet::new();
    for root in roots(files) {
        product.extend(ModuleGraph::new(root, files).files.iter().map(|file| file.path.to_owned()));
        with_tests.extend(ModuleGraph::with_tests(root, files).files.iter().map(|file| file.path.to_owned()));
    }
    for file in files.iter_mut().filter(|file| with_tests.contains(file.path) && !product.contains(file.path))
    {
        file.mark_as_test();
    }
}

/// The modules of one crate: files, and names through which each uses others.
pub(super) struct ModuleGraph<'f> {
    files: Vec<&'f RustFile<'f>>,
    /// By file: the files that it uses, with the names that it takes from them.
    uses: Vec<BTreeMap<usize, BTreeSet<String>>>,
}

/// A module while the tree is built; several inline modules may belong to one file.
#[derive(Debug, Default)]
struct Module {
    file: usize,
    parent: Option<usize>,
    children: HashMap<String, usize>,
    imports: Vec<Import>,
    items: HashSet<String>,
    /// Paths in code, by segments, and single names.
    paths: Vec<Vec<String>>,
    words: HashSet<String>,
}

/// One name that a `use` declaration brings in.
#[derive(Debug, Clone)]
struct Import {
    path: Vec<String>,
    /// The name in this module; `*` for all of another module's.
    name: String,
    is_reexport: bool,
}

/// Where a path leads.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Target {
    /// To a module.
    Module(usize),
    /// To an item that a module defines.
    ItemOf(usize),
}

impl<'f> ModuleGraph<'f> {
    /// Of a crate's root file (`src/lib.rs`); `files` are all that may belong to it.
    pub(super) fn new(root: &'f RustFile<'f>, files: &'f [RustFile<'f>]) -> Self {
        Self::of(root, files, RustFile::product)
    }

    /// The same with the crate's tests.
    pub(super) fn with_tests(root: &'f RustFile<'f>, files: &'f [RustFile<'f>]) -> Self {
        Self::of(root, files, |file| file.tokens().iter().collect())
    }

    fn of(root: &'f RustFile<'f>, files: &'f [RustFile<'f>], tokens: Read<'f>) -> Self {
        let mut tree =
            Tree { files: vec![root], all: files, tokens, modules: Vec::new(), macros: HashMap::new() };
        tree.modules.push(Module::default());
        tree.read(0, &tokens(root), &Folders::of(root.path, false));
        let uses = tree.uses();
        Self { files: tree.files, uses }
    }

    /// Groups of files that use each other in a circle, each sorted by path.
    pub(super) fn circles(&self) -> Vec<Vec<usize>> {
        let reach: Vec<HashSet<usize>> = (0..self.files.len()).map(|file| self.reachable(file)).collect();
        let mut done = HashSet::new();
        let mut circles = Vec::new();
        for file in 0..self.files.len() {
            let back = |other: &usize| reach.get(*other).is_some_and(|reach| reach.contains(&file));
            let own =
                reach.get(file).map(|reach| reach.iter().copied().filter(back).collect::<BTreeSet<_>>());
            let circle: Vec<usize> = own.unwrap_or_default().into_iter().collect();
            if circle.len() > 1 && done.insert(circle.clone()) {
                circles.push(circle);
            }
        }
        circles
    }

    /// The path of a file.
    pub(super) fn path(&self, file: usize) -> &'f str {
        self.files.get(file).map_or("", |file| file.path)
    }

    /// What a file uses: other files, with the names that it takes from each.
    pub(super) fn used_by(&self, file: usize) -> impl Iterator<Item = (usize, &BTreeSet<String>)> {
        self.uses.get(file).into_iter().flatten().map(|(used, names)| (*used, names))
    }

    /// How many files there are.
    pub(super) fn len(&self) -> usize {
        self.files.len()
    }

    /// All files that a file uses, and what those use; itself only if something leads back.
    fn reachable(&self, file: usize) -> HashSet<usize> {
        let mut seen = HashSet::new();
        let mut open = vec![file];
        while let Some(next) = open.pop() {
            for (used, _) in self.used_by(next) {
                if seen.insert(used) {
                    open.push(used);
                }
            }
        }
        seen
    }
}

/// Gives the tokens of a file that count.
type Read<'f> = fn(&'f RustFile<'f>) -> Vec<&'f Placed>;

struct Tree<'f> {
    files: Vec<&'f RustFile<'f>>,
    all: &'f [RustFile<'f>],
    tokens: Read<'f>,
    modules: Vec<Module>,
    /// Macros that the whole crate can name at its root: the file of each.
    macros: HashMap<String, usize>,
}

impl<'f> Tree<'f> {
    /// Reads the tokens of a module.
    fn read(&mut self, module: usize, tokens: &[&'f Placed], folders: &Folders) {
        let mut at = 0;
        let mut depth = 0_usize;
        // The path of a module's file, when an attribute gives it.
        let mut file_path: Option<String> = None;
        let mut is_exported_macro = false;
        while let Some(rest) = tokens.get(at..).filter(|rest| !rest.is_empty()) {
            let next = match word(rest, 0) {
                // `pub(in crate::a)` names no item.
                Some("pub") if is_mark(rest, 1, '(') => {
                    rest.iter().position(|placed| placed.token == Token::Mark(')')).map_or(1, |end| end + 1)
                }
                Some("use") if !is_mark(rest, 1, '<') => self.read_use(module, tokens, at),
                Some("mod") if depth == 0 && word(rest, 1).is_some() => {
                    let name = word(rest, 1).unwrap_or_default().to_owned();
                    let taken = file_path.take();
                    self.read_mod(module, &name, rest, taken.as_deref(), folders)
                }
                Some("macro_rules") if is_mark(rest, 1, '!') => {
                    let name = word(rest, 2).unwrap_or_default().to_owned();
                    if std::mem::take(&mut is_exported_macro) {
                        self.macros.insert(name.clone(), self.file_of(module));
                    }
                    self.item(module, name);
                    3
                }
                Some("fn" | "struct" | "enum" | "trait" | "type" | "union" | "const" | "static") => {
                    if let Some(name) = word(rest, 1).filter(|name| !matches!(*name, "fn" | "mut")) {
                        self.item(module, name.to_owned());
                        2
                    } else {
                        1
                    }
                }
                Some(_) => self.read_path(module, rest),
                None => {
                    if starts_with(rest, &["#", "[", "path", "="]) {
                        file_path = rest.get(4).and_then(|placed| text(placed));
                    }
                    is_exported_macro |= starts_with(rest, &["#", "[", "macro_export"]);
                    match mark(rest, 0) {
                        Some('{') => depth += 1,
                        Some('}') => depth = depth.saturating_sub(1),
                        _ => {}
                    }
                    1
                }
            };
            at += next;
        }
    }

    fn item(&mut self, module: usize, name: String) {
        if let Some(module) = self.modules.get_mut(module) {
            module.items.insert(name);
        }
    }

    fn file_of(&self, module: usize) -> usize {
        self.modules.get(module).map_or(0, |module| module.file)
    }

    /// `mod name;` or `mod name { … }`; gives how many tokens that is.
    fn read_mod(
        &mut self,
        parent: usize,
        name: &str,
        rest: &[&'f Placed],
        attribute: Option<&str>,
        folders: &Folders,
    ) -> usize {
        let child = self.modules.len();
        if is_mark(rest, 2, '{') {
            let end = matching(rest, 2);
            let file = self.file_of(parent);
            self.add_child(parent, name, Module { file, parent: Some(parent), ..Module::default() });
            // Files of modules in an inline module are in a folder of its name.
            let inner = format!("{}/{name}", folders.of_children);
            let inner = Folders { of_file: inner.clone(), of_children: inner };
            self.read(child, rest.get(3..end).unwrap_or_default(), &inner);
            return end + 1;
        }
        let folder = &folders.of_children;
        let candidates = match attribute {
            Some(given) => vec![format!("{}/{given}", folders.of_file)],
            None => vec![format!("{folder}/{name}.rs"), format!("{folder}/{name}/mod.rs")],
        };
        let all = self.all;
        if let Some(found) = all.iter().find(|file| candidates.iter().any(|path| path == file.path)) {
            let file = self.files.len();
            self.files.push(found);
            self.add_child(parent, name, Module { file, parent: Some(parent), ..Module::default() });
            let tokens = (self.tokens)(found);
            self.read(child, &tokens, &Folders::of(found.path, attribute.is_some()));
        }
        3
    }

    fn add_child(&mut self, parent: usize, name: &str, child: Module) {
        let index = self.modules.len();
        self.modules.push(child);
        if let Some(parent) = self.modules.get_mut(parent) {
            parent.children.insert(name.to_owned(), index);
        }
    }

    /// A `use` declaration; gives how many tokens it is.
    fn read_use(&mut self, module: usize, tokens: &[&'f Placed], at: usize) -> usize {
        let rest = tokens.get(at..).unwrap_or_default();
        let len = rest.iter().position(|placed| placed.token == Token::Mark(';')).unwrap_or(rest.len());
        // `pub use`, `pub(crate) use`.
        let before = at.checked_sub(1).and_then(|last| tokens.get(last));
        let is_reexport = before.is_some_and(|placed| match &placed.token {
            Token::Word(word) => word == "pub",
            Token::Mark(mark) => *mark == ')',
            Token::Text(_) => false,
        });
        let mut found = Vec::new();
        read_tree(rest.get(1..len).unwrap_or_default(), &mut Vec::new(), &mut found);
        if let Some(module) = self.modules.get_mut(module) {
            let import = |(path, name)| Import { path, name, is_reexport };
            module.imports.extend(found.into_iter().map(import));
        }
        len + 1
    }

    /// A name, or a path of names; gives how many tokens it is.
    fn read_path(&mut self, module: usize, rest: &[&'f Placed]) -> usize {
        let mut path = Vec::new();
        let mut at = 0;
        while let Some(name) = word(rest, at) {
            path.push(name.to_owned());
            let goes_on =
                is_mark(rest, at + 1, ':') && is_mark(rest, at + 2, ':') && word(rest, at + 3).is_some();
            at += 1;
            if !goes_on {
                break;
            }
            at += 2;
        }
        if let Some(module) = self.modules.get_mut(module) {
            module.words.extend(path.first().cloned());
            if path.len() > 1 {
                module.paths.push(path);
            }
        }
        at.max(1)
    }

    fn uses(&self) -> Vec<BTreeMap<usize, BTreeSet<String>>> {
        let mut uses = vec![BTreeMap::<usize, BTreeSet<String>>::new(); self.files.len()];
        for (index, module) in self.modules.iter().enumerate() {
            let mut note = |path: &[String], name: Option<&String>| {
                let Some(Target::Module(target) | Target::ItemOf(target)) = self.resolve(index, path, 0)
                else {
                    return;
                };
                let file = self.file_of(target);
                if file != module.file
                    && let Some(of_file) = uses.get_mut(module.file)
                {
                    of_file.entry(file).or_default().extend(name.cloned());
                }
            };
            for import in &module.imports {
                if !import.is_reexport || module.words.contains(&import.name) {
                    note(&import.path, import.path.last());
                }
            }
            for path in &module.paths {
                // `a::b::C` names C, and `Effect::Rapid` Effect.
                let is_type = |name: &&String| name.starts_with(char::is_uppercase);
                note(path, path.iter().find(is_type).or(path.last()));
            }
        }
        uses
    }

    /// Where a path leads that is in a module; `None` out of the crate.
    fn resolve(&self, from: usize, path: &[String], depth: usize) -> Option<Target> {
        // Re-exports of re-exports end; a circle of globs does not.
        if depth > 16 {
            return None;
        }
        let mut at = from;
        let mut rest = path;
        let mut is_anchored = false;
        while let [first, more @ ..] = rest {
            match first.as_str() {
                "crate" => at = 0,
                "self" => {}
                "super" => at = self.modules.get(at)?.parent?,
                _ => break,
            }
            is_anchored = true;
            rest = more;
        }
        while let [first, more @ ..] = rest {
            let module = self.modules.get(at)?;
            if let Some(child) = module.children.get(first) {
                at = *child;
            } else if let Some(import) = module.imports.iter().find(|import| import.name == *first) {
                // `use Effect as E;` in the module that has `E` only so.
                if import.path.first() == Some(first) && import.path.len() == 1 {
                    return None;
                }
                match self.resolve(at, &import.path, depth + 1)? {
                    Target::Module(found) => at = found,
                    item @ Target::ItemOf(_) => return Some(item),
                }
            } else if module.items.contains(first) {
                return Some(Target::ItemOf(at));
            } else if let Some(found) = self.through_globs(at, first, depth) {
                match found {
                    Target::Module(found) => at = found,
                    item @ Target::ItemOf(_) => return Some(item),
                }
            } else if at == 0 {
                let file = self.macros.get(first)?;
                return self.modules.iter().position(|module| module.file == *file).map(Target::ItemOf);
            } else if is_anchored || at != from {
                // Made by a macro.
                return Some(Target::ItemOf(at));
            } else {
                return None;
            }
            is_anchored = true;
            rest = more;
        }
        Some(Target::Module(at))
    }

    fn through_globs(&self, module: usize, name: &str, depth: usize) -> Option<Target> {
        let globs = self.modules.get(module)?.imports.iter().filter(|import| import.name == "*");
        globs.into_iter().find_map(|glob| {
            let Target::Module(of) = self.resolve(module, &glob.path, depth + 1)? else { return None };
            let has = self.modules.get(of).is_some_and(|of| {
                of.items.contains(name)
                    || of.children.contains_key(name)
                    || of.imports.iter().any(|import| import.name == name)
            });
            has.then(|| self.resolve(of, &[name.to_owned()], depth + 1)).flatten()
        })
    }
}

/// The names that a `use` tree brings in, each with its whole path.
fn read_tree(tokens: &[&Placed], prefix: &mut Vec<String>, found: &mut Vec<(Vec<String>, String)>) {
    let mut at = 0;
    while at < tokens.len() {
        let before = prefix.len();
        // One branch: names and `::`, to a `,` or the end.
        loop {
            if let Some(name) = word(tokens, at) {
                if name == "as" {
                    let alias = word(tokens, at + 1).unwrap_or_default().to_owned();
                    found.push((prefix.clone(), alias));
                    at += 2;
                    break;
                }
                if name == "self" && !prefix.is_empty() {
                    // `a::{self, B}` names `a`.
                    if word(tokens, at + 1) != Some("as") {
                        found.push((prefix.clone(), prefix.last().cloned().unwrap_or_default()));
                    }
                } else {
                    prefix.push(name.to_owned());
                    let ends = !is_mark(tokens, at + 1, ':') && word(tokens, at + 1) != Some("as");
                    if ends {
                        found.push((prefix.clone(), name.to_owned()));
                    }
                }
                at += 1;
            } else if is_mark(tokens, at, ':') {
                at += 1;
            } else if is_mark(tokens, at, '*') {
                found.push((prefix.clone(), "*".to_owned()));
                at += 1;
            } else if is_mark(tokens, at, '{') {
                let end = matching(tokens, at);
                read_tree(tokens.get(at + 1..end).unwrap_or_default(), prefix, found);
                at = end + 1;
            } else {
                break;
            }
        }
        prefix.truncate(before);
        at += 1;
    }
}

/// Where a module and its children are.
struct Folders {
    of_file: String,
    of_children: String,
}

impl Folders {
    /// The children of `a.rs` are in `a`, those of `lib.rs`, `main.rs` and `mod.rs` beside it, and so are those of a file that
    /// an attribute names.
    fn of(path: &str, by_attribute: bool) -> Self {
        let (folder, name) = path.rsplit_once('/').unwrap_or(("", path));
        let is_head = by_attribute || matches!(name, "lib.rs" | "main.rs" | "mod.rs");
        let stem = name.trim_end_matches(".rs");
        let of_children = if is_head { folder.to_owned() } else { format!("{folder}/{stem}") };
        Self { of_file: folder.to_owned(), of_children }
    }
}

/// The index of the bracket that closes the one at `open`.
fn matching(tokens: &[&Placed], open: usize) -> usize {
    let mut depth = 0_usize;
    for (at, placed) in tokens.iter().enumerate().skip(open) {
        match placed.token {
            Token::Mark('{') => depth += 1,
            Token::Mark('}') => {
                depth -= 1;
                if depth == 0 {
                    return at;
                }
            }
            _ => {}
        }
    }
    tokens.len()
}

fn word<'t>(tokens: &[&'t Placed], at: usize) -> Option<&'t str> {
    match &tokens.get(at)?.token {
        Token::Word(word) => Some(word),
        _ => None,
    }
}

fn mark(tokens: &[&Placed], at: usize) -> Option<char> {
    match tokens.get(at)?.token {
        Token::Mark(mark) => Some(mark),
        _ => None,
    }
}

fn is_mark(tokens: &[&Placed], at: usize, wanted: char) -> bool {
    mark(tokens, at) == Some(wanted)
}

fn text(placed: &Placed) -> Option<String> {
    match &placed.token {
        Token::Text(text) => Some(text.trim_matches('"').to_owned()),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::mark_test_files;
    use crate::tidy::tokens::RustFile;
    use crate::workspace::TextFile;

    #[test]
    fn files_that_only_tests_take_in_are_test_files() {
        let files = [
            (
                "lib.rs",
                "mod a;\n#[cfg(test)]\nmod laws;\n#[cfg(test)]\nmod twice;\n#[path = \"twice.rs\"]\nmod again;\n",
            ),
            ("a.rs", "fn a() {}\n"),
            ("laws.rs", "mod choices;\n"),
            ("laws/choices.rs", "fn b() {}\n"),
            ("twice.rs", "fn c() {}\n"),
            ("orphan.rs", "fn d() {}\n"),
        ];
        let files: Vec<TextFile> = files
            .iter()
            .map(|(path, text)| TextFile { path: format!("crates/a/src/{path}"), text: (*text).to_owned() })
            .collect();
        let mut files: Vec<RustFile<'_>> = files.iter().map(|file| RustFile::new(file).unwrap()).collect();
        mark_test_files(&mut files);
        let product: Vec<&str> =
            files.iter().filter(|file| !file.product().is_empty()).map(|file| file.path).collect();
        // A file that nobody takes in is judged as product.
        assert_eq!(
            product,
            ["crates/a/src/lib.rs", "crates/a/src/a.rs", "crates/a/src/twice.rs", "crates/a/src/orphan.rs"]
        );
    }
}
