//! `--watch`: checking again whenever something changes that a verdict may rest on.
//!
//! Knows: the file system's events, which of them matter, Ctrl-C. Must not know: how a round is done.
//!
//! Folders are watched before a round reads what is in them, so no change falls between the two. Files are watched by their
//! folders, because editors that save by renaming put a new file into the old one's place.

use std::collections::BTreeMap;
use std::io::{self, IsTerminal as _, Write as _};
use std::path::{Path, PathBuf};
use std::process;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{self, Receiver, RecvTimeoutError, Sender};
use std::time::Duration;

use notify::event::{CreateKind, ModifyKind};
use notify::{Event, EventKind, RecommendedWatcher, RecursiveMode, Watcher as _};

use super::round::{Check, Looked};
use crate::config::FILE_NAMES;
use crate::console::{report, say};
use crate::discovery::is_program_name;
use crate::{Problem, paths, writing};

/// Exit code of a program that Ctrl-C ended, as shells know it.
const INTERRUPTED: u8 = 130;
/// Changes come in swarms; a round begins when nothing has changed for so long.
const QUIET: Duration = Duration::from_millis(100);
/// A file that changes without end is looked at all the same.
const PATIENCE: u32 = 20;
/// Files that say which others are programs of the folder.
const IGNORE_FILES: [&str; 3] = [".gitignore", ".ignore", ".gcheckignore"];

/// What a round waits for.
enum Message {
    Changed(notify::Result<Event>),
    Interrupted,
}

/// Runs rounds until Ctrl-C.
pub(super) fn run(command: &Check<'_>) -> Result<u8, Problem> {
    let (sender, messages) = mpsc::channel();
    on_interrupt(sender.clone())?;
    let mut looked = Looked::default();
    loop {
        let mut watch = Watch::new(command, &looked, sender.clone())?;
        if io::stdout().is_terminal() {
            // Clears the screen and what was scrolled out of it; a terminal that is gone ends the round itself.
            let _ = io::stdout().write_all(b"\x1b[2J\x1b[3J\x1b[H");
        }
        if let Err(problem) = command.round(&mut looked) {
            // It may be fixed while we watch.
            report(&problem);
        }
        watch.add(command, &looked);
        if !command.global.quiet {
            let programs = looked.programs.len();
            let what = if programs == 1 { "program" } else { "programs" };
            say(&format!("watching {programs} {what} for changes; Ctrl-C ends"));
        }
        let Some(changed) = next_change(command, &looked, &messages) else { return Ok(INTERRUPTED) };
        if !command.global.quiet {
            say(&format!("{} changed", paths::shown_from_here(&changed)));
        }
    }
}

/// Ctrl-C ends the wait for changes; a second one does not let the round come to its end either.
fn on_interrupt(sender: Sender<Message>) -> Result<(), Problem> {
    let is_second = AtomicBool::new(false);
    ctrlc::set_handler(move || {
        if is_second.swap(true, Ordering::Relaxed) || sender.send(Message::Interrupted).is_err() {
            writing::remove_all();
            process::exit(i32::from(INTERRUPTED));
        }
    })
    .map_err(|error| Problem::new(format!("cannot wait for Ctrl-C: {error}")))
}

/// Waits for a change that matters, and until it is over; nothing when Ctrl-C comes first.
fn next_change(command: &Check<'_>, looked: &Looked, messages: &Receiver<Message>) -> Option<PathBuf> {
    let changed = loop {
        match messages.recv().ok()? {
            Message::Interrupted => return None,
            Message::Changed(event) => {
                if let Some(path) = relevant(command, looked, &event) {
                    break path;
                }
            }
        }
    };
    for _ in 0..PATIENCE {
        match messages.recv_timeout(QUIET) {
            Ok(Message::Interrupted) => return None,
            Ok(Message::Changed(_)) => {}
            Err(RecvTimeoutError::Timeout | RecvTimeoutError::Disconnected) => break,
        }
    }
    Some(changed)
}

/// The path of an event, if it may change what a round finds.
fn relevant(command: &Check<'_>, looked: &Looked, event: &notify::Result<Event>) -> Option<PathBuf> {
    let here = || PathBuf::from(".");
    // Events were lost, or the watch is: a round sees what there is.
    let Ok(event) = event else { return Some(here()) };
    if event.need_rescan() {
        return Some(event.paths.first().cloned().unwrap_or_else(here));
    }
    // Rounds read files themselves.
    if matches!(event.kind, EventKind::Access(_)) {
        return None;
    }
    event.paths.iter().find(|path| matters(command, looked, event.kind, path)).cloned()
}

fn matters(command: &Check<'_>, looked: &Looked, kind: EventKind, path: &Path) -> bool {
    let is_own = command.options.output_file.iter().any(|output| paths::absolute(&output.path) == path);
    if is_own {
        return false;
    }
    let name = path.file_name().unwrap_or_default();
    if FILE_NAMES.iter().chain(&IGNORE_FILES).any(|known| name == *known)
        || looked.configs.iter().flat_map(|config| config.files()).any(|file| file == path)
        || command.options.baseline.as_ref().is_some_and(|baseline| paths::absolute(baseline) == path)
    {
        return true;
    }
    // A program, one of a folder that came or went, or a folder with programs.
    let mut given = command.options.paths.iter().map(|given| paths::absolute(given));
    if looked.programs.iter().any(|program| program.starts_with(path))
        || given.clone().any(|given| given == path)
    {
        return true;
    }
    let folder = path.parent().unwrap_or(path);
    let is_below = given.any(|given| path.starts_with(given));
    let is_callable = looked.programs.iter().any(|program| program.parent() == Some(folder))
        || looked.configs.iter().flat_map(|config| config.search()).any(|search| search == folder);
    let may_be_folder = matches!(
        kind,
        EventKind::Create(CreateKind::Folder | CreateKind::Any) | EventKind::Modify(ModifyKind::Name(_))
    );
    let is_program = is_program_name(path);
    let is_wanted = || looked.configs.iter().any(|config| config.wants(path, is_program));
    (is_program && (is_below || is_callable))
        || (is_below && (is_wanted() || (may_be_folder && path.is_dir())))
}

/// Folders under watch.
struct Watch {
    watcher: RecommendedWatcher,
    folders: BTreeMap<PathBuf, RecursiveMode>,
}

impl Watch {
    /// Watches what the command line names, and what the last round looked at.
    fn new(command: &Check<'_>, looked: &Looked, sender: Sender<Message>) -> Result<Self, Problem> {
        let watcher = notify::recommended_watcher(move |event| {
            // Without a receiver the program is ending.
            let _ = sender.send(Message::Changed(event));
        })
        .map_err(|error| refused(&error))?;
        let mut all = Self { watcher, folders: BTreeMap::new() };
        for path in &command.options.paths {
            let path = paths::absolute(path);
            if path.is_dir() {
                all.watcher
                    .watch(&path, RecursiveMode::Recursive)
                    .map_err(|error| refused(&error).in_file(&path))?;
                all.folders.insert(path, RecursiveMode::Recursive);
            }
        }
        all.add(command, looked);
        Ok(all)
    }

    /// Watches what a round looked at besides.
    fn add(&mut self, command: &Check<'_>, looked: &Looked) {
        let given = command.options.paths.iter().map(|path| paths::absolute(path));
        // A configuration may come to be in any folder above; what is named may come back in the one above.
        let above = given.flat_map(|path| path.ancestors().skip(1).map(Path::to_owned).collect::<Vec<_>>());
        let configs = looked.configs.iter();
        let files = configs.clone().flat_map(|config| config.files()).filter_map(Path::parent);
        let search = configs.flat_map(|config| config.search());
        let baseline = command.options.baseline.iter().map(|baseline| paths::absolute(baseline));
        let beside_baseline = baseline.filter_map(|baseline| baseline.parent().map(Path::to_owned));
        let others = files.chain(search).map(Path::to_owned);
        for folder in above.chain(others).chain(beside_baseline).collect::<Vec<_>>() {
            let is_watched = self.folders.contains_key(&folder)
                || self
                    .folders
                    .iter()
                    .any(|(root, mode)| *mode == RecursiveMode::Recursive && folder.starts_with(root));
            // What is not there, or not for us, is noticed when something else changes.
            if !is_watched && self.watcher.watch(&folder, RecursiveMode::NonRecursive).is_ok() {
                self.folders.insert(folder, RecursiveMode::NonRecursive);
            }
        }
    }
}

fn refused(error: &notify::Error) -> Problem {
    Problem::new(format!("cannot watch for changes: {error}"))
        .help("the system may allow fewer watches than there are folders; name fewer of them")
}
