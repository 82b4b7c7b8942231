//! Where output goes: standard output, a file that is replaced whole, colours or none.
//!
//! Knows: terminals, environment variables about colour, links. Must not know: what is written, how a file is replaced.

use std::fs::{self, File};
use std::io::{self, IsTerminal as _, Write};
use std::path::{Path, PathBuf};
use std::{env, fmt};

use gcheck_report::Colour;

use crate::args::When;
use crate::config::FILE_NAMES;
use crate::problem::io_reason;
use crate::writing::{self, Failure};
use crate::{Problem, paths};

/// Whether standard output gets colours.
pub(crate) fn colour(when: When) -> Colour {
    let is_set = |name: &str| env::var_os(name).is_some_and(|value| !value.is_empty() && value != "0");
    let colours = match when {
        When::Always => true,
        When::Never => false,
        When::Auto if is_set("CLICOLOR_FORCE") => true,
        When::Auto => {
            let refused = env::var_os("NO_COLOR").is_some_and(|value| !value.is_empty());
            !refused && env::var_os("TERM").is_none_or(|term| term != "dumb") && io::stdout().is_terminal()
        }
    };
    if colours { Colour::Ansi } else { Colour::Plain }
}

/// Prints a text and ends well.
pub(crate) fn print(text: &str) -> Result<u8, Problem> {
    to_stdout(|out| out.write_all(text.as_bytes()))?;
    Ok(0)
}

/// Writes to standard output. A reader that went away (`| head`) is not an error.
pub(crate) fn to_stdout(write: impl FnOnce(&mut dyn Write) -> io::Result<()>) -> Result<(), Problem> {
    let mut out = io::stdout().lock();
    match write(&mut out).and_then(|()| out.flush()) {
        Err(error) if error.kind() != io::ErrorKind::BrokenPipe => {
            Err(Problem::new(format!("cannot write to standard output: {}", io_reason(&error))))
        }
        _ => Ok(()),
    }
}

/// Writes a text to the file, or to standard output without one.
pub(crate) fn to(file: Option<&Path>, text: &str) -> Result<(), Problem> {
    match file {
        Some(file) => to_file(file, |out| out.write_all(text.as_bytes())),
        None => to_stdout(|out: &mut dyn Write| out.write_all(text.as_bytes())),
    }
}

/// Refuses an output that would replace what the run reads.
///
/// # Errors
/// The problem that says so.
pub(crate) fn refuse_to_replace<'p>(
    file: Option<&Path>,
    read: impl IntoIterator<Item = &'p Path>,
) -> Result<(), Problem> {
    let Some(file) = file else { return Ok(()) };
    let place = |path: &Path| fs::canonicalize(path).unwrap_or_else(|_| paths::absolute(path));
    let target = place(file);
    let is_configuration = FILE_NAMES.iter().any(|name| file.file_name() == Some(name.as_ref()));
    if is_configuration && file.exists() {
        let message = "is a configuration, and the output would replace it";
        return Err(Problem::with_file(file, message).help("name another file after `-o`"));
    }
    if read.into_iter().any(|path| path.is_file() && place(path) == target) {
        let message = "is read in this run, and the output would replace it";
        return Err(Problem::with_file(file, message).help("name another file after `-o`"));
    }
    Ok(())
}

/// Writes a file whole or not at all.
///
/// A link stays, and what it leads to is replaced, unless it leads out of the current folder: others' files hold such links.
/// What is not a file (a pipe, `/dev/null`) is written to as it is.
pub(crate) fn to_file(
    path: &Path,
    write: impl FnOnce(&mut dyn Write) -> io::Result<()>,
) -> Result<(), Problem> {
    let problem = |reason: &dyn fmt::Display| Problem::with_file(path, format!("cannot write: {reason}"));
    if path.is_dir() {
        return Err(problem(&"is a folder"));
    }
    let target = fs::canonicalize(path).unwrap_or_else(|_| path.to_owned());
    if target.exists() && !target.is_file() {
        return File::options()
            .write(true)
            .open(&target)
            .and_then(|mut out| write(&mut out))
            .map_err(|e| problem(&io_reason(&e)));
    }
    if paths::is_below(path, Path::new("."))
        && let Some(target) = paths::leads_out(path, &[PathBuf::from(".")])
    {
        let reason = format!("is a link that leads out of this folder, to {}", paths::shown(&target));
        return Err(problem(&reason).help("name that file itself"));
    }
    writing::file(&target, write).map_err(|failure| problem(&failure))
}

/// Replaces a file whole or not at all, and only if it still holds `before`.
///
/// A link stays, and what it leads to is replaced.
pub(crate) fn replace(path: &Path, before: &[u8], after: &[u8]) -> Result<(), Problem> {
    let problem = |reason: &dyn fmt::Display| Problem::with_file(path, format!("cannot write: {reason}"));
    let target = fs::canonicalize(path).map_err(|error| problem(&io_reason(&error)))?;
    writing::instead_of(&target, before, after).map_err(|failure| match failure {
        Failure::Changed => {
            Problem::with_file(path, "was changed by another program in the meantime, and is not written")
                .help("run gcheck again")
        }
        failure => problem(&failure),
    })
}
