//! What a program is run with besides its own text.
//!
//! Knows: folders, tool tables, search paths. Must not know: who runs the program.

use std::fs;
use std::path::{Path, PathBuf};

/// What both sides are given.
#[derive(Debug, Clone)]
pub struct Setup {
    /// The tool table; lengths in inches, as `rs274` reads them.
    pub table: PathBuf,
    /// A machine file in the reference's form.
    pub ini: Option<PathBuf>,
    /// Folders with subroutines, as the machine file names them.
    pub search: Vec<PathBuf>,
    /// Further keys of our configuration.
    pub config: Vec<String>,
}

impl Setup {
    /// A tool table and nothing else.
    pub fn with_table(table: impl Into<PathBuf>) -> Self {
        Self { table: table.into(), ini: None, search: Vec::new(), config: Vec::new() }
    }

    /// The tool table of the project's own programs.
    pub fn own() -> Self {
        Self::with_table(fixtures().join("tool.tbl"))
    }
}

/// The folder of the project's own programs.
pub fn fixtures() -> PathBuf {
    checkout().join("fixtures").join("oracle")
}

/// The root of the checkout.
pub fn checkout() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).parent().unwrap().to_owned()
}

/// Copies the files of a folder and of the folders in it.
pub fn copy_folder(from: &Path, to: &Path) {
    fs::create_dir_all(to).unwrap();
    for entry in fs::read_dir(from).unwrap() {
        let entry = entry.unwrap();
        let target = to.join(entry.file_name());
        if entry.file_type().unwrap().is_dir() {
            copy_folder(&entry.path(), &target);
        } else {
            fs::copy(entry.path(), target).unwrap();
        }
    }
}
