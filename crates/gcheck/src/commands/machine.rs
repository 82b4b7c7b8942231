//! `gcheck machine import`: a machine from what the shop has, written into `gcheck.toml`.
//!
//! Knows: which file is written, and what is told. Must not know: any format.

use std::path::{Path, PathBuf};

use crate::args::{Global, ImportOptions};
use crate::config::{Configs, FILE_NAMES, validate_control};
use crate::console::{finish, say};
use crate::importing::{self, FileFacts, Merged, Request, Surroundings, Target};
use crate::{Problem, output, paths, reading, rewriting};

/// A larger file is not a configuration.
const MOST_BYTES: u64 = 1 << 20;

/// Runs the command.
pub(crate) fn import(global: &Global, options: &ImportOptions) -> Result<u8, Problem> {
    if let Some(name) = &global.control {
        validate_control(name).map_err(Problem::new)?;
    }
    let path = target(options);
    let before = existing(&path)?;
    let text = before.as_deref().unwrap_or_default();
    let control = global.control.as_deref();
    let surroundings = surroundings(global, &path, before.is_some())?;
    let (config, has_file) = executed_with(global, &path, before.is_some())?;
    let request = Request {
        format: options.format,
        units: options.units.map(Into::into),
        control,
        config: &config,
        has_file,
    };
    let (mut files, mut problems): (Vec<FileFacts>, Vec<Problem>) = (Vec::new(), Vec::new());
    for file in &options.files {
        match importing::read(file, request) {
            Ok(facts) => files.push(facts),
            Err(more) => problems.extend(more),
        }
    }
    if !problems.is_empty() {
        // All or nothing: half of a machine is another machine.
        return Ok(finish(&problems, 0));
    }
    let remark = |text: &str| {
        if !global.quiet {
            say(text);
        }
    };
    for line in files.iter().flat_map(|file| &file.unused) {
        remark(line);
    }
    if files.iter().all(FileFacts::is_empty) {
        let message = "nothing of what is in the files has a key in `gcheck.toml`; nothing was written";
        return Err(Problem::new(message));
    }
    let wanted =
        Target { path: &path, before: text, overwrite: options.overwrite, surroundings: &surroundings };
    let merged = importing::merge(&wanted, &files, control)?;
    for kept in &merged.kept {
        remark(&format!("kept: {kept} (`--overwrite` takes the imported one)"));
    }
    for opened in &merged.opened {
        remark(opened);
    }
    write(global, options, &path, before.as_deref(), &merged, surroundings.has_control)
}

fn write(
    global: &Global,
    options: &ImportOptions,
    path: &Path,
    before: Option<&str>,
    merged: &Merged,
    has_control: bool,
) -> Result<u8, Problem> {
    let shown = paths::shown(path);
    if options.dry_run {
        return output::print(&merged.text);
    }
    if merged.written == 0 {
        return output::print(&told(
            global,
            &format!("{shown} is as it was: {} the same\n", values(merged.same)),
        ));
    }
    match before {
        Some(before) => rewriting::write(path, "write", before.as_bytes(), merged.text.as_bytes())?,
        None => output::to_file(path, |out| out.write_all(merged.text.as_bytes()))?,
    }
    let same = if merged.same > 0 { format!(", {} the same", merged.same) } else { String::new() };
    let kept = if merged.kept.is_empty() { String::new() } else { format!(", {} kept", merged.kept.len()) };
    let next = if has_control {
        "next: `gcheck check --show-settings`"
    } else {
        "next: name the control in it, `control = \"NAME\"` (`gcheck controls` lists them), then `gcheck check --show-settings`"
    };
    output::print(&told(global, &format!("wrote {shown}: {}{same}{kept}\n{next}\n", values(merged.written))))
}

fn values(count: usize) -> String {
    if count == 1 { "1 value".to_owned() } else { format!("{count} values") }
}

fn told(global: &Global, text: &str) -> String {
    if global.quiet { String::new() } else { text.to_owned() }
}

/// The file that is written: the one that is named, the one that is here, or a new one.
fn target(options: &ImportOptions) -> PathBuf {
    let here = || FILE_NAMES.iter().map(PathBuf::from).find(|path| path.symlink_metadata().is_ok());
    let new = || PathBuf::from(FILE_NAMES.first().copied().unwrap_or_default());
    options.output_file.clone().or_else(here).unwrap_or_else(new)
}

/// The text of the file, if it is there.
fn existing(path: &Path) -> Result<Option<String>, Problem> {
    if path.symlink_metadata().is_err() {
        return Ok(None);
    }
    let bytes = reading::regular(path, MOST_BYTES)
        .map_err(|reason| Problem::with_file(path, format!("cannot read the configuration: {reason}")))?;
    let text = String::from_utf8(bytes);
    let no_text = |_| Problem::with_file(path, "is not a configuration: it holds bytes that are not UTF-8");
    text.map(Some).map_err(no_text)
}

/// What counts where the values are put: the file that is written, with what it extends, and keys of the command line.
fn surroundings(global: &Global, path: &Path, exists: bool) -> Result<Surroundings, Problem> {
    let mut arguments: Vec<String> =
        global.config.iter().filter(|argument| is_key(argument)).cloned().collect();
    if exists {
        arguments.push(as_argument(path)?);
    }
    let config = Configs::new(&arguments, !exists)?.of_file(path)?;
    Ok(Surroundings::new(path, &config, global.control.as_deref()))
}

/// What counts when a program is executed, as `--config` takes it, and whether a file is in it: the one of the command line,
/// else the one that is written.
fn executed_with(global: &Global, path: &Path, exists: bool) -> Result<(Vec<String>, bool), Problem> {
    let mut arguments = global.config.clone();
    let is_named = arguments.iter().any(|argument| !is_key(argument));
    if exists && !is_named && !global.isolated {
        arguments.push(as_argument(path)?);
    }
    Ok((arguments, is_named || (exists && !global.isolated)))
}

/// Is an argument of `--config` a key with a value, not a file?
fn is_key(argument: &str) -> bool {
    argument.contains('=') && !Path::new(argument).exists()
}

fn as_argument(path: &Path) -> Result<String, Problem> {
    let name = path.to_str().ok_or_else(|| Problem::with_file(path, "its name is not text"))?;
    Ok(name.to_owned())
}
