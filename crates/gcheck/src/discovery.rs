//! Which files are checked: those named, and the programs in folders.
//!
//! Knows: file names of programs, ignore files, the `[files]` table. Must not know: what is in a file.

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Component, Path, PathBuf};
use std::sync::{Arc, Mutex};

use ignore::WalkBuilder;

use crate::config::{Configs, FILE_NAMES, PathPattern, SCHEMA_FILE};
use crate::{Problem, paths, reading};

/// Extensions of part programs, lower case.
pub(crate) const EXTENSIONS: [&str; 13] =
    ["nc", "ngc", "cnc", "tap", "eia", "ncf", "gcode", "iso", "din", "prg", "mpf", "spf", "min"];

/// Ends of names that some controls give to programs, and everybody to other files.
const UNCERTAIN: [&str; 2] = ["txt", "h"];
/// Of so many of these files the first part is looked at.
const MOST_LOOKED_AT: usize = 200;
/// Bytes of that part.
const HEAD: u64 = 4 << 10;

/// What was found.
#[derive(Debug, Default)]
pub(crate) struct Found {
    /// Programs, in the order of the paths given and sorted within a folder, each once.
    pub(crate) files: Vec<PathBuf>,
    /// What could not be looked at.
    pub(crate) problems: Vec<Problem>,
    /// How many files of folders look like programs and have one of the [`UNCERTAIN`] endings, by ending. They are not read.
    pub(crate) passed_over: BTreeMap<&'static str, usize>,
    /// Files that were looked at for that.
    looked_at: usize,
}

impl Found {
    /// Counts a file that is not read, if it looks like a program.
    fn pass_over(&mut self, path: &Path) {
        let end = path.extension().map(|end| end.to_string_lossy().to_ascii_lowercase());
        let known = UNCERTAIN.into_iter().find(|known| Some(*known) == end.as_deref());
        let Some(end) = known.filter(|_| self.looked_at < MOST_LOOKED_AT) else { return };
        self.looked_at += 1;
        if reading::head(path, HEAD).is_some_and(|head| looks_like_a_program(&head, end)) {
            *self.passed_over.entry(end).or_default() += 1;
        }
    }

    /// What to say of the files that look like programs and are not read; empty where there are none.
    pub(crate) fn remark(&self) -> String {
        let lines = self.passed_over.iter().map(|(end, count)| {
            let (these, them) = match count {
                1 => (format!("1 file ending in .{end} looks like a program and is"), "it"),
                count => (format!("{count} files ending in .{end} look like programs and are"), "them"),
            };
            format!("{these} not checked: name {them}, or set `include` under `[files]` in `gcheck.toml`")
        });
        lines.collect::<Vec<_>>().join("\n")
    }
}

/// Are most lines blocks, or is the text in a dialect that has such names?
fn looks_like_a_program(text: &str, end: &str) -> bool {
    if gcheck_controls::unsupported_dialect(text, Some(end)).is_some() {
        return true;
    }
    let lines = || text.lines().map(str::trim).filter(|line| !line.is_empty());
    // A word, and nothing that no word has: `N10 G0 X1.`, `%`, `O0001`.
    let is_block = |line: &&str| {
        let code = line.split(['(', ';']).next().unwrap_or_default().trim();
        let mut letters = code.trim_start_matches('/').chars();
        let is_word = |letter: Option<char>, next: Option<char>| {
            letter.is_some_and(|c| c.is_ascii_alphabetic())
                && next.is_some_and(|c| c.is_ascii_digit() || matches!(c, '.' | '-' | '+' | '#'))
        };
        *line == "%" || is_word(letters.next(), letters.next())
    };
    let is_comment = |line: &&str| line.starts_with('(') && line.ends_with(')') || line.starts_with(';');
    let (blocks, others) = lines().filter(|line| !is_comment(line)).partition::<Vec<_>, _>(is_block);
    blocks.len() >= ENOUGH_BLOCKS && blocks.len() > others.len() * 4
}

/// Fewer blocks may be anything: a list of parts, a note.
const ENOUGH_BLOCKS: usize = 4;

/// Is this the name of a part program: `part.nc`, `O1234`?
pub(crate) fn is_program_name(path: &Path) -> bool {
    let extension = path.extension().map(|e| e.to_string_lossy().to_ascii_lowercase());
    match extension {
        Some(extension) => EXTENSIONS.contains(&extension.as_str()),
        None => path.file_name().is_some_and(|name| {
            let name = name.to_string_lossy();
            let digits = name.strip_prefix(['O', 'o']).unwrap_or_default();
            !digits.is_empty() && digits.bytes().all(|b| b.is_ascii_digit())
        }),
    }
}

/// Looks at each path: a file is taken whatever its name, unless it is a configuration; a folder is walked.
pub(crate) fn find(given: &[PathBuf], configs: &mut Configs) -> Found {
    let mut found = Found::default();
    let mut seen = BTreeSet::new();
    for path in given {
        if path.is_dir() {
            walk(path, configs, &mut found, &mut seen);
        } else if path.exists() {
            add_named(path.clone(), configs, &mut found, &mut seen);
        } else if is_pattern(path) {
            fit(path, configs, &mut found, &mut seen);
        } else {
            found.problems.push(Problem::with_file(path, "no such file or folder"));
        }
    }
    found
}

/// The paths that a file lists, a line each, or each up to a NUL where there is one; `-` is standard input.
///
/// # Errors
/// The list cannot be read.
pub(crate) fn listed(list: &Path) -> Result<Vec<PathBuf>, Problem> {
    let source = if paths::is_standard_input(list) {
        reading::standard_input(Path::new("stdin"))?
    } else {
        reading::file(list)?
    };
    let text = source.text();
    let names: Vec<&str> = if text.contains('\0') {
        text.split('\0').collect()
    } else {
        // `#` begins a comment, unless a file has such a name.
        let is_path = |line: &&str| !line.starts_with('#') || Path::new(line).exists();
        text.split(['\n', '\r']).map(str::trim).filter(is_path).collect()
    };
    Ok(names.into_iter().filter(|name| !name.is_empty()).map(PathBuf::from).collect())
}

/// Does the path hold a character of patterns? Shells expand patterns where they fit; some shells, and quotes, leave them.
pub(crate) fn is_pattern(path: &Path) -> bool {
    path.to_string_lossy().contains(['*', '?', '[', '{'])
}

/// Files that the walk of a folder reads by itself.
const IGNORE_FILES: [&str; 4] = [".gitignore", ".ignore", OWN_IGNORE_FILE, ".git/info/exclude"];
const OWN_IGNORE_FILE: &str = ".gcheckignore";
/// Bytes of such a file.
const MOST_IGNORE: u64 = 1 << 20;

/// What is in a folder and below it, but for what ignore files name. A folder whose ignore files cannot be read is left out, and a
/// problem says so.
fn entries(folder: &Path) -> impl Iterator<Item = Result<ignore::DirEntry, Problem>> {
    // The walk reads the ignore files of a folder when it enters it, whatever they are, and those of the folders around the first.
    let first = paths::absolute(folder);
    let refused: Vec<Problem> = first.ancestors().find_map(bad_ignore_file).into_iter().collect();
    let may_walk = refused.is_empty();
    let refused = Arc::new(Mutex::new(refused));
    let inner = Arc::clone(&refused);
    let walk = may_walk.then(|| {
        let mut builder = WalkBuilder::new(folder);
        // Links are not followed, so a loop of them is never entered.
        builder.follow_links(false).require_git(false).add_custom_ignore_filename(OWN_IGNORE_FILE);
        builder.filter_entry(move |entry| {
            let is_folder = entry.file_type().is_some_and(|kind| kind.is_dir());
            let bad = if is_folder { bad_ignore_file(entry.path()) } else { None };
            let is_good = bad.is_none();
            if let Ok(mut inner) = inner.lock() {
                inner.extend(bad);
            }
            is_good
        });
        builder.build()
    });
    let unwalkable = |error| Problem::new(format!("cannot look into a folder: {error}"));
    let found = walk.into_iter().flatten().map(move |entry| entry.map_err(unwalkable));
    found.chain(std::iter::from_fn(move || refused.lock().ok()?.pop().map(Err)))
}

/// What is wrong with an ignore file of a folder: others' folders may have one that never ends.
fn bad_ignore_file(folder: &Path) -> Option<Problem> {
    let refused = |path: PathBuf| {
        // A folder of that name is never read as one.
        if path.is_dir() {
            return None;
        }
        let reason = reading::irregular(&path, MOST_IGNORE)?;
        let message = format!("cannot read this ignore file: {reason}; its folder is not searched");
        Some(Problem::with_file(&path, message).help("remove it, or name the programs themselves"))
    };
    IGNORE_FILES.into_iter().find_map(|name| refused(folder.join(name)))
}

/// Takes the files that fit a pattern, whatever their names, as a shell would.
fn fit(pattern: &Path, configs: &mut Configs, found: &mut Found, seen: &mut BTreeSet<PathBuf>) {
    let is_plain = |part: &Component<'_>| !is_pattern(Path::new(part));
    let base: PathBuf = pattern.components().take_while(is_plain).collect();
    let rest: PathBuf = pattern.components().skip_while(is_plain).collect();
    let folder = if base.as_os_str().is_empty() { Path::new(".") } else { &base };
    if !folder.is_dir() {
        let message = format!("no file fits this pattern: there is no folder {}", paths::shown(folder));
        found.problems.push(Problem::with_file(pattern, message));
        return;
    }
    // From the root of the pattern, so that `*.nc` does not fit in every folder.
    let glob = format!("/{}", paths::shown(&rest));
    let matcher = match PathPattern::new(&paths::absolute(folder), &glob) {
        Ok(matcher) => matcher,
        Err(reason) => {
            let message = format!("no such file, and as a pattern it cannot be read: {reason}");
            found.problems.push(Problem::with_file(pattern, message));
            return;
        }
    };
    let mut fitting = Vec::new();
    for entry in entries(folder) {
        match entry.map(ignore::DirEntry::into_path) {
            Ok(path) if path.is_file() && matcher.fits(&paths::absolute(&path)) => fitting.push(path),
            Ok(_) => {}
            Err(problem) => found.problems.push(problem),
        }
    }
    if fitting.is_empty() {
        found.problems.push(Problem::with_file(pattern, "no file fits this pattern"));
    }
    fitting.sort();
    for path in fitting {
        let path = path.strip_prefix(".").map_or_else(|_| path.clone(), Path::to_owned);
        add_named(path, configs, found, seen);
    }
}

/// Takes a file that the user names. `*` of a shell and lists of changed files also name the configuration, which is read as what
/// it is, so that a mistake in it is a problem, and the schema beside it, which is passed over.
fn add_named(path: PathBuf, configs: &mut Configs, found: &mut Found, seen: &mut BTreeSet<PathBuf>) {
    let is_one_of =
        |names: &[&str]| path.file_name().is_some_and(|name| names.iter().any(|known| name == *known));
    if is_one_of(&FILE_NAMES) {
        if let Err(problem) = configs.of_file(&path) {
            found.problems.push(problem);
        }
    } else if !is_one_of(&[SCHEMA_FILE]) {
        add(path, found, seen);
    }
}

/// Refuses to write to a link that leads out of what was given: the folders, and those in which the files are.
///
/// Others' folders may hold such links, and what they lead to is not theirs to change.
///
/// # Errors
/// The problem that says where the link leads.
pub(crate) fn refuse_to_leave(path: &Path, given: &[PathBuf]) -> Result<(), Problem> {
    let folder = |path: &PathBuf| {
        let parent = || path.parent().filter(|parent| !parent.as_os_str().is_empty());
        if path.is_dir() { path.clone() } else { parent().unwrap_or(Path::new(".")).to_owned() }
    };
    let folders: Vec<PathBuf> = given.iter().map(folder).collect();
    let Some(target) = paths::leads_out(path, &folders) else { return Ok(()) };
    let message =
        format!("is a link that leads out of the folder, to {}; it is not changed", paths::shown(&target));
    Err(Problem::with_file(path, message).help("name that file itself, or exclude the link"))
}

fn add(path: PathBuf, found: &mut Found, seen: &mut BTreeSet<PathBuf>) {
    if seen.insert(paths::absolute(&path)) {
        found.files.push(path);
    }
}

fn walk(folder: &Path, configs: &mut Configs, found: &mut Found, seen: &mut BTreeSet<PathBuf>) {
    let mut programs = Vec::new();
    for entry in entries(folder) {
        match entry {
            Ok(entry)
                if entry
                    .file_type()
                    .is_some_and(|t| t.is_file() || (t.is_symlink() && entry.path().is_file())) =>
            {
                let path = entry.into_path();
                match configs.of_file(&path) {
                    Ok(config) if config.wants(&path, is_program_name(&path)) => programs.push(path),
                    // Not one that the configuration leaves out.
                    Ok(config) if config.wants(&path, true) => found.pass_over(&path),
                    // A broken configuration is reported once, by the file that needs it.
                    Err(problem) if is_program_name(&path) => found.problems.push(problem),
                    Ok(_) | Err(_) => {}
                }
            }
            Ok(_) => {}
            Err(problem) => found.problems.push(problem),
        }
    }
    // Without programs nobody else would read it, and its author would think it right.
    if programs.is_empty()
        && let Err(problem) = configs.of_folder(folder)
    {
        found.problems.push(problem);
    }
    programs.sort();
    for path in programs {
        add(path, found, seen);
    }
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use std::collections::BTreeSet;
    use std::fs;

    use super::{EXTENSIONS, is_program_name, looks_like_a_program};

    /// Endings in a text that stand between `before` and `after`.
    fn endings(text: &str, before: &str, after: &str) -> BTreeSet<String> {
        let found = text.split(before).skip(1).filter_map(|rest| rest.split(after).next());
        found.map(str::to_ascii_lowercase).collect()
    }

    #[test]
    fn editors_and_hooks_know_the_programs_that_folders_are_searched_for() {
        let read = |file: &str| {
            let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..").join(file);
            fs::read_to_string(path).unwrap()
        };
        let line_with = |file: &str, word: &str| {
            let text = read(file);
            let lines: Vec<&str> = text.lines().filter(|line| line.contains(word)).collect();
            assert!(!lines.is_empty(), "{file}");
            lines.join("\n")
        };
        let expected: BTreeSet<String> = EXTENSIONS.map(str::to_owned).into_iter().collect();
        let vim = read("editors/neovim/ftdetect/gcode.vim").replace(' ', ",");
        let vscode: serde_json::Value = serde_json::from_str(&read("editors/vscode/package.json")).unwrap();
        let vscode = vscode["contributes"]["languages"][0]["extensions"].as_array().unwrap().clone();
        let hook = line_with(".pre-commit-hooks.yaml", "ngc");
        let hook = hook.split("\\.(").nth(1).and_then(|rest| rest.split(')').next()).unwrap().to_owned();
        let emacs = line_with("editors/emacs/gcheck.el", "ngc");
        let emacs =
            emacs.split("\\\\(").nth(1).and_then(|rest| rest.split("\\\\)").next()).unwrap().to_owned();
        let guide = line_with("docs/guide.md", "Programs are files that end in");
        let guide = guide.split('`').nth(1).unwrap().to_owned();
        let helix = line_with("docs/editors.md", "file-types");
        let of_list = |text: &str, separator: &str| -> BTreeSet<String> {
            text.split(separator).map(|end| end.trim_matches(['.', ' ']).to_owned()).collect()
        };
        for (place, found) in [
            ("Neovim", endings(&vim, "*.", ",")),
            ("VS Code", vscode.iter().map(|end| end.as_str().unwrap()[1..].to_owned()).collect()),
            ("Emacs", of_list(&emacs, "\\\\|")),
            ("pre-commit", of_list(&hook, "|")),
            ("the guide", of_list(&guide, " ")),
            (
                "Helix",
                endings(&helix.replace(' ', ""), "\"", "\"")
                    .into_iter()
                    .filter(|end| end.starts_with(char::is_alphabetic))
                    .collect(),
            ),
        ] {
            assert_eq!(found, expected, "{place}");
        }
    }

    #[test]
    fn a_text_is_a_program_where_most_of_its_lines_are_blocks() {
        assert!(looks_like_a_program("%\nO1 (A)\nG0 X1.\nG1 Y2. F100\nM30\n%\n", "txt"));
        assert!(looks_like_a_program("0 BEGIN PGM PLATE MM\n1 BLK FORM 0.1 Z X+0 Y+0 Z-20\n", "h"));
        assert!(!looks_like_a_program("int main(void);\n#define X1 5\n#include <a.h>\n", "h"));
        assert!(!looks_like_a_program(
            "T1 drill 8\nT2 mill 12\nSet up the part.\nM6 screws, four of them.\n",
            "txt"
        ));
        assert!(!looks_like_a_program("", "txt"));
    }

    #[test]
    fn programs_are_known_by_extension_or_number() {
        for name in ["a.nc", "A.NC", "b.Gcode", "O1234", "o7", "x/O0001"] {
            assert!(is_program_name(Path::new(name)), "{name}");
        }
        for name in ["a.txt", "O", "OK", "O12a", "nc", ".nc", "1234"] {
            assert!(!is_program_name(Path::new(name)), "{name}");
        }
    }
}
