//! What a program and the name of its file show of its control.
//!
//! Knows: the end of a name. Must not know: any control, what is beside the program.

use std::path::Path;

use gcheck_controls::{Evidence, Guess};

/// The control that a program and the end of its name speak for.
pub(crate) fn detected(path: &Path, text: &str) -> Option<Guess> {
    gcheck_controls::guess(&evidence(path, text))
}

/// What a program and the end of its name show, whatever it speaks for.
pub(crate) fn evidence(path: &Path, text: &str) -> Evidence {
    let extension = path.extension().map(|extension| extension.to_string_lossy());
    gcheck_program::evidence_of_file(text, extension.as_deref())
}
