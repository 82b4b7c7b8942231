//! `gcheck fmt`: programs in the style of their control or their shop.
//!
//! Knows: which files, what becomes of their new text. Must not know: how a program is formatted or renumbered.

use std::collections::BTreeSet;
use std::fs;
use std::panic::{self, AssertUnwindSafe};
use std::path::PathBuf;
use std::sync::Arc;

use gcheck_diagnostics::apply_to_bytes;
use gcheck_format::{Numbering, RenumberRefused, SequenceNumbers, Style, formatted, renumber};
use gcheck_program::Dialect;
use gcheck_syntax::SourceText;
use rayon::prelude::*;

use crate::args::{FmtOptions, Global};
use crate::config::{Config, Configs, validate_control};
use crate::console::{finish, say};
use crate::control_choice::choose;
use crate::discovery::{self, Found};
use crate::neighbours::Neighbours;
use crate::{Problem, output, paths, reading, rewriting, threads};

/// Runs the command; the exit code is its result.
pub(crate) fn run(global: &Global, options: &FmtOptions) -> Result<u8, Problem> {
    if let Some(name) = &global.control {
        validate_control(name).map_err(Problem::new)?;
    }
    let mut configs = Configs::new(&global.config, global.isolated)?;
    if options.paths.iter().any(|path| paths::is_standard_input(path)) {
        if options.paths.len() > 1 {
            return Err(Problem::new("standard input is formatted alone, without other files"));
        }
        return standard_input(global, options, &mut configs);
    }
    let Found { files, mut problems, .. } = discovery::find(&options.paths, &mut configs);
    let mut targets = Vec::with_capacity(files.len());
    let mut seen = BTreeSet::new();
    let real = |path: &PathBuf| fs::canonicalize(path).unwrap_or_else(|_| path.clone());
    let is_link = |path: &PathBuf| path.symlink_metadata().is_ok_and(|data| data.is_symlink());
    let themselves: BTreeSet<PathBuf> = files.iter().filter(|path| !is_link(path)).map(real).collect();
    for path in files {
        // A file and a link to it are one file to write, and its own name is the one that people know.
        if is_link(&path) && themselves.contains(&real(&path)) || !seen.insert(real(&path)) {
            continue;
        }
        if let Err(problem) = discovery::refuse_to_leave(&path, &options.paths) {
            problems.push(problem);
            continue;
        }
        match configs.of_file(&path) {
            Ok(config) => targets.push(Target { shown: paths::shown(&path), path, config }),
            Err(problem) => problems.push(problem),
        }
    }
    let mut changed = Vec::new();
    let mut unchanged = 0;
    for (target, result) in targets.iter().zip(format_all(&targets, global, options)?) {
        match result {
            Ok(Some(change)) => changed.push((target, change)),
            Ok(None) => unchanged += 1,
            Err(problem) => problems.push(problem),
        }
    }
    let text: String = if options.diff {
        changed.iter().map(|(_, change)| change.difference.as_str()).collect()
    } else if options.check {
        changed.iter().map(|(target, _)| format!("{}\n", target.shown)).collect()
    } else {
        String::new()
    };
    output::print(&text)?;
    let is_dry = options.check || options.diff;
    if !global.quiet {
        if !is_dry {
            for (target, change) in &changed {
                let done = if options.renumber.is_some() { "renumbered and formatted" } else { "formatted" };
                say(&format!("{}: {done} for {}", target.shown, change.control));
            }
        }
        // Where no program could be formatted, it is the problems that say why.
        if changed.len() + unchanged > 0 || problems.is_empty() {
            say(&closing_line(changed.len(), unchanged, is_dry));
        }
    }
    Ok(finish(&problems, u8::from(is_dry && !changed.is_empty())))
}

fn closing_line(changed: usize, unchanged: usize, is_dry: bool) -> String {
    let files = |count: usize| format!("{count} {}", if count == 1 { "file" } else { "files" });
    match (changed, unchanged) {
        (0, 0) => "no programs found".to_owned(),
        (0, _) => format!("{} already formatted", files(unchanged)),
        (_, 0) if is_dry => format!("{} would change", files(changed)),
        (_, 0) => format!("{} formatted", files(changed)),
        _ if is_dry => format!("{} would change, {unchanged} already formatted", files(changed)),
        _ => format!("{} formatted, {unchanged} left unchanged", files(changed)),
    }
}

/// A file that is to be formatted.
struct Target {
    path: PathBuf,
    /// As messages call it.
    shown: String,
    config: Arc<Config>,
}

/// A program before and after.
struct Formatted {
    control: String,
    before: Vec<u8>,
    /// `None` where nothing changes.
    after: Option<Vec<u8>>,
}

/// What became of a file that changes.
struct Change {
    control: String,
    /// Empty where nobody asked for it.
    difference: String,
}

/// Formats the files, several at a time; the order of the results is that of the files.
fn format_all(
    targets: &[Target],
    global: &Global,
    options: &FmtOptions,
) -> Result<Vec<Result<Option<Change>, Problem>>, Problem> {
    let work = || targets.par_iter().map(|target| guarded(target, global, options)).collect();
    match (options.jobs, targets.len()) {
        // Threads cost more than one file takes.
        (_, 0 | 1) => Ok(targets.iter().map(|target| guarded(target, global, options)).collect()),
        (None, _) => {
            threads::prepare();
            Ok(work())
        }
        (Some(jobs), _) => Ok(threads::pool(jobs)?.install(work)),
    }
}

/// Formats a file; a panic is contained, so that the other files are still formatted, and nothing is written then.
fn guarded(target: &Target, global: &Global, options: &FmtOptions) -> Result<Option<Change>, Problem> {
    panic::catch_unwind(AssertUnwindSafe(|| format_file(target, global, options)))
        .unwrap_or_else(|payload| Err(Problem::own_mistake(payload.as_ref()).in_file(&target.path)))
}

fn format_file(target: &Target, global: &Global, options: &FmtOptions) -> Result<Option<Change>, Problem> {
    let Formatted { control, before, after } = reform(target, reading::file(&target.path)?, global, options)?;
    let Some(after) = after else { return Ok(None) };
    let mut difference = String::new();
    if options.diff {
        difference = rewriting::difference(&target.shown, &before, &after);
    } else if !options.check {
        rewriting::write(&target.path, "format", &before, &after)?;
    }
    Ok(Some(Change { control, difference }))
}

/// Formats standard input to standard output.
fn standard_input(global: &Global, options: &FmtOptions, configs: &mut Configs) -> Result<u8, Problem> {
    let path = options.stdin_filename.clone().unwrap_or_else(|| PathBuf::from("stdin"));
    let config = configs.of_file(&path)?;
    let target = Target { shown: paths::shown(&path), path, config };
    let source = reading::standard_input(&target.path)?;
    let Formatted { before, after, .. } =
        panic::catch_unwind(AssertUnwindSafe(|| reform(&target, source, global, options)))
            .unwrap_or_else(|payload| Err(Problem::own_mistake(payload.as_ref()).in_file(&target.path)))?;
    let is_dry = options.check || options.diff;
    let text = match &after {
        Some(after) if options.diff => rewriting::difference(&target.shown, &before, after).into_bytes(),
        Some(_) if options.check => format!("{}\n", target.shown).into_bytes(),
        None if is_dry => Vec::new(),
        _ => after.clone().unwrap_or(before),
    };
    output::to_stdout(|out| out.write_all(&text))?;
    Ok(u8::from(is_dry && after.is_some()))
}

/// The new text of a program.
fn reform(
    target: &Target,
    source: SourceText,
    global: &Global,
    options: &FmtOptions,
) -> Result<Formatted, Problem> {
    let settings = target.config.settings(&target.path);
    let from = settings.control.as_deref().map(|name| (name, settings.control_from.as_deref()));
    let chosen = choose(&target.path, &source, global.control.as_deref(), from, &Neighbours::default())?;
    chosen.refuse_unsupported(&target.path)?;
    let choice = chosen.choice;
    let plain = gcheck_controls::load(&choice.name).map_err(|error| Problem::new(error.to_string()))?;
    let control =
        if settings.codes.is_empty() { plain } else { Arc::new(plain.with_user_codes(&settings.codes)) };
    let dialect = Dialect::new(&control);
    let style = settings.format.style(&control);
    let before = source.to_bytes();
    let after = match options.renumber {
        None => formatted(&source, &dialect, &style),
        Some(numbering) => Some(renumbered(target, source, &dialect, &style, numbering)?),
    };
    Ok(Formatted { control: choice.name, after: after.filter(|after| *after != before), before })
}

/// The program renumbered and formatted.
fn renumbered(
    target: &Target,
    source: SourceText,
    dialect: &Dialect<'_>,
    style: &Style,
    numbering: Numbering,
) -> Result<Vec<u8>, Problem> {
    // Numbers that go leave gaps in the numbering, which closes them then.
    let rounds = if style.sequence_numbers == SequenceNumbers::Drop { 2 } else { 1 };
    let mut source = source;
    for _ in 0..rounds {
        let edits = renumber(source.text(), dialect, &numbering)
            .map_err(|refused| refusal(target, &source, &refused))?;
        source = text(target, apply_to_bytes(&source.to_bytes(), &edits))?;
        if let Some(bytes) = formatted(&source, dialect, style) {
            source = text(target, bytes)?;
        }
    }
    Ok(source.to_bytes())
}

fn text(target: &Target, bytes: Vec<u8>) -> Result<SourceText, Problem> {
    SourceText::from_bytes(bytes)
        .map_err(|_| Problem::with_file(&target.path, "would become larger than 4 GiB"))
}

/// Why a program is not renumbered, at its place.
fn refusal(target: &Target, source: &SourceText, refused: &RenumberRefused) -> Problem {
    let range = refused.range.start as usize..refused.range.end as usize;
    let problem = if range.is_empty() {
        Problem::with_file(&target.path, format!("cannot renumber: {refused}"))
    } else {
        Problem::at(&target.shown, source.text(), &range, format!("cannot renumber: {refused}"))
    };
    problem.note("the file was left as it is")
}
