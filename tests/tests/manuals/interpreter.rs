//! The installed LinuxCNC interpreter (`rs274`) as the judge of what the product prints.
//!
//! Knows: how a program and the files beside it come into a folder, where the interpreter is. Must not know: what is proved,
//! how either side executes.

use std::fs;
use std::sync::OnceLock;

use gcheck_tests::canonical::Outcome;
use gcheck_tests::product;
use gcheck_tests::reference::{self, Reference};
use gcheck_tests::setup::Setup;

use crate::proof::Program;

/// The name of the file beside a program that is the interpreter's machine file.
const MACHINE_FILE: &str = "machine.ini";

/// The name of the file beside a program that is the tool table of both sides.
const TOOL_TABLE: &str = "tool.tbl";

/// The interpreter; `None`, said once, where it is not installed.
pub(crate) fn find() -> Option<&'static Reference> {
    static FOUND: OnceLock<Option<Reference>> = OnceLock::new();
    FOUND.get_or_init(reference::find).as_ref()
}

/// What `gcheck run` prints for a program, and what the interpreter prints, if there is one.
///
/// Both have the tool table `tool.tbl` beside the program, or that of the oracle's own programs. A file `machine.ini` beside the program is the interpreter's machine
/// file; what it says must be in the configuration of the program as well, as far as the product knows it.
pub(crate) fn both(program: &Program) -> (Outcome, Option<Outcome>) {
    let folder = tempfile::tempdir().unwrap();
    for (name, text) in program.files.iter().chain([&("main.ngc", program.text)]) {
        let path = folder.path().join(name);
        fs::create_dir_all(path.parent().unwrap()).unwrap();
        fs::write(path, text).unwrap();
    }
    let main = folder.path().join("main.ngc");
    let table = folder.path().join(TOOL_TABLE);
    let mut setup = if table.is_file() { Setup::with_table(table) } else { Setup::own() };
    setup.config = program.config.iter().map(|&key| key.to_owned()).collect();
    let machine = folder.path().join(MACHINE_FILE);
    setup.ini = machine.is_file().then_some(machine);
    let ours = product::execute(env!("CARGO_BIN_EXE_gcheck-under-test"), &main, &setup);
    (ours, find().map(|interpreter| interpreter.run(&main, &setup)))
}
