//! Where output goes: standard output, a file that is replaced whole, colours or none.
//!
//! Knows: terminals, environment variables about colour, temporary files. Must not know: what is written.

use std::fs::{self, File};
use std::io::{self, IsTerminal as _, Write};
use std::path::{Path, PathBuf};
use std::{env, process};

use gcheck_report::Colour;

use crate::Problem;
use crate::args::When;
use crate::problem::io_reason;

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

/// Writes a file whole or not at all: to a temporary file beside it, which then takes its name.
///
/// A link stays, and what it leads to is replaced. What is not a file (a pipe, `/dev/null`) is written to as it is.
pub(crate) fn to_file(
    path: &Path,
    write: impl FnOnce(&mut dyn Write) -> io::Result<()>,
) -> Result<(), Problem> {
    let problem = |error: &io::Error| Problem::with_file(path, format!("cannot write: {}", io_reason(error)));
    if path.is_dir() {
        return Err(Problem::with_file(path, "cannot write: is a folder"));
    }
    let target = fs::canonicalize(path).unwrap_or_else(|_| path.to_owned());
    if target.exists() && !target.is_file() {
        return File::options()
            .write(true)
            .open(&target)
            .and_then(|mut out| write(&mut out))
            .map_err(|e| problem(&e));
    }
    rename_over(&target, |file| {
        write(file)?;
        file.sync_all()?;
        Ok(true)
    })
    .map(|_| ())
    .map_err(|error| problem(&error))
}

/// Replaces a file whole or not at all, with the permissions that it had, and only if it still holds what `is_same` wants.
///
/// A link stays, and what it leads to is replaced.
pub(crate) fn replace(
    path: &Path,
    permissions: &fs::Permissions,
    bytes: &[u8],
    is_same: impl FnOnce(&[u8]) -> bool,
) -> Result<(), Problem> {
    let problem = |error: &io::Error| Problem::with_file(path, format!("cannot write: {}", io_reason(error)));
    let target = fs::canonicalize(path).map_err(|error| problem(&error))?;
    let is_replaced = rename_over(&target, |file| {
        file.write_all(bytes)?;
        file.set_permissions(permissions.clone())?;
        file.sync_all()?;
        // As late as can be: between this look and the new name there is room for hardly anybody.
        Ok(is_same(&fs::read(&target)?))
    })
    .map_err(|error| problem(&error))?;
    if is_replaced {
        return Ok(());
    }
    Err(Problem::with_file(path, "was changed by another program in the meantime, and is not written")
        .help("run gcheck again"))
}

/// Fills a temporary file, which then takes the target's name if `fill` says so; tells whether it did.
fn rename_over(target: &Path, fill: impl FnOnce(&mut File) -> io::Result<bool>) -> io::Result<bool> {
    let temporary = beside(target);
    let done = File::create(&temporary).and_then(|mut file| fill(&mut file)).and_then(|wanted| {
        if wanted {
            fs::rename(&temporary, target)?;
        }
        Ok(wanted)
    });
    if !matches!(done, Ok(true)) {
        // Nothing of ours remains; that the clean-up may fail as well changes nothing.
        let _ = fs::remove_file(&temporary);
    }
    done
}

/// A name in the same folder, so that the rename stays on one file system.
fn beside(path: &Path) -> PathBuf {
    let name = path.file_name().map(|n| n.to_string_lossy().into_owned()).unwrap_or_default();
    path.with_file_name(format!(".{name}.{}.tmp", process::id()))
}
