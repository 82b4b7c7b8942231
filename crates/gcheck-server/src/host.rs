//! Where settings and files come from: a trait that the program with the server in it fills.
//!
//! Knows: what the server needs to be told. Must not know: files, folders, forms of configuration.

use std::ops::Range;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use gcheck_controls::Control;
use gcheck_db::Settings;
use gcheck_ide::Configured;
use gcheck_lint::RuleTable;

use crate::ProgramText;

/// The surroundings of the server.
pub trait Host: Send + Sync + 'static {
    /// What is in force for a program.
    fn in_force(&self, program: &ProgramQuery<'_>) -> InForce;

    /// What is wrong with a configuration that is open in the editor, by its text there; `None` when the host does not look into
    /// files of this name.
    fn configuration_problems(&self, path: &Path, text: &str) -> Option<Vec<ConfigurationProblem>> {
        let _ = (path, text);
        None
    }

    /// What is told of a place in a configuration, by its text in the editor; `offset` is a byte of it.
    fn configuration_hover(&self, path: &Path, text: &str, offset: usize) -> Option<ConfigurationHover> {
        let _ = (path, text, offset);
        None
    }

    /// What may be written at a place of a configuration, what fits best first.
    fn configuration_completion(&self, path: &Path, text: &str, offset: usize) -> Vec<ConfigurationOffer> {
        let _ = (path, text, offset);
        Vec::new()
    }

    /// Where the configuration of a program has entries for what the program names, those that win first. `open` has the text of
    /// a configuration that is open in the editor.
    fn configured(
        &self,
        program: &ProgramQuery<'_>,
        control: &Control,
        named: Configured,
        open: &dyn Fn(&Path) -> Option<String>,
    ) -> Vec<ConfiguredPlace> {
        let _ = (program, control, named, open);
        Vec::new()
    }

    /// The programs that are in a folder itself, by path. A folder that cannot be read has none.
    fn programs_in(&self, folder: &Path) -> Vec<ProgramFile>;

    /// The programs of a folder and of those below it that a check of the folder would read, by path.
    fn programs_below(&self, folder: &Path) -> Vec<ProgramFile>;

    /// The text of a program on disk; `None` when it cannot be read, is not a text, or is gone.
    fn read(&self, path: &Path) -> Option<ProgramText>;

    /// Every rule that there is, for the pages about rules.
    fn rules(&self) -> RuleTable;

    /// Forgets what is known of files: some have changed.
    fn forget(&self);

    /// Patterns of the files whose changes the server wants to hear of: `**/name`.
    fn watched(&self) -> Vec<String>;
}

/// What is told of a place in a configuration.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ConfigurationHover {
    /// In Markdown.
    pub markdown: String,
    /// Bytes of the text that it is about.
    pub range: Range<usize>,
}

/// Something that may be written into a configuration.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ConfigurationOffer {
    /// Shown in the list.
    pub label: String,
    /// What it is.
    pub description: String,
    /// It is a key, and else a value.
    pub is_key: bool,
    /// Bytes of the text in whose place it is written.
    pub range: Range<usize>,
    /// What editors compare with what is typed.
    pub filter: String,
    /// What is written.
    pub text: String,
    /// The same with places for the cursor, for editors that know snippets.
    pub snippet: Option<String>,
}

/// An entry of a configuration.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ConfiguredPlace {
    /// The file.
    pub path: PathBuf,
    /// Its text.
    pub text: Arc<str>,
    /// Bytes of the key.
    pub key: Range<usize>,
}

/// A program file on disk.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ProgramFile {
    /// Where it is.
    pub path: PathBuf,
    /// Its size in bytes.
    pub size: u64,
    /// Changes when the file does.
    pub stamp: u64,
}

/// A program whose settings are asked for.
#[derive(Clone)]
pub struct ProgramQuery<'q> {
    /// Where it is, or would be.
    pub path: &'q Path,
    /// Its first [`gcheck_program::EVIDENCE_BYTES`] bytes and the rest of their last line.
    pub head: &'q str,
    /// The control that the user chose for all programs, in the editor.
    pub control: Option<&'q str>,
    /// The configuration that the user chose for all programs, in the editor.
    pub configuration: Option<&'q Path>,
    /// Texts that replace files.
    pub open: &'q Arc<dyn OpenPrograms>,
}

/// Programs that are open in the editor: their text is what counts, whatever is on disk.
pub trait OpenPrograms: Send + Sync {
    /// The text of an open program.
    fn text(&self, path: &Path) -> Option<String>;
    /// The open programs of a folder, by path; the number changes with the text.
    fn in_folder(&self, folder: &Path) -> Vec<(PathBuf, u64)>;
}

/// What is in force for a program.
#[derive(Debug, Clone)]
pub struct InForce {
    /// For the analysis. `None` when the configuration cannot be read: there are no findings for a program whose
    /// control and machine nobody knows.
    pub settings: Option<Settings>,
    /// How the control came about.
    pub choice: Choice,
    /// How the program is to be written; `None` as the control does it.
    pub style: Option<gcheck_ide::Style>,
    /// The folders whose programs it may call, its own first.
    pub folders: Vec<PathBuf>,
    /// The configuration, if there is one.
    pub configuration: Option<PathBuf>,
    /// What is wrong with the configuration, or with what the program says of its control.
    pub problems: Vec<ConfigurationProblem>,
}

/// The control of a program and how it was chosen.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Choice {
    /// Its name.
    pub control: String,
    /// `option`, `comment`, `configuration`, `detected`, `guessed`, `neighbours` or `default`.
    pub source: String,
    /// What made it so: a comment, a file.
    pub because: Option<String>,
}

/// Something that is wrong with a configuration.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
pub struct ConfigurationProblem {
    /// The file; `None` for what is not a file's fault.
    pub path: Option<PathBuf>,
    /// Line, from 0.
    pub line: u32,
    /// Characters before it in its line.
    pub column: u32,
    /// Its characters.
    pub length: u32,
    /// In words.
    pub message: String,
}
