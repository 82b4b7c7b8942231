//! `gcheck diff`: do two programs, or the programs of two folders, make the machine do the same?
//!
//! Knows: what is compared with what, exit codes. Must not know: how programs run, when paths are the same, how differences are
//! worded.

mod accepted;
mod findings;
mod folders;
pub(super) mod left_out;
mod outcome;
mod page;
mod pairs;
mod runs;
pub(super) mod words;

use std::path::PathBuf;
use std::sync::Arc;

use gcheck_toolpath::Rest;

use super::json as to_text;
use crate::args::{DiffFormat, DiffOptions, Global};
use crate::console::{FAILED, report, say};
use crate::{Problem, output, paths};
use outcome::DIFFERENT;

/// Runs the command; the exit code is its result.
pub(crate) fn run(global: &Global, options: &DiffOptions) -> Result<u8, Problem> {
    if paths::is_standard_input(&options.a) && paths::is_standard_input(&options.b) {
        return Err(Problem::new("both programs cannot come from standard input"));
    }
    let is_gone = |path: &&&PathBuf| !paths::is_standard_input(path) && !path.exists();
    if let Some(path) = [&options.a, &options.b].iter().find(is_gone) {
        return Err(Problem::with_file(path, "no such file or folder"));
    }
    match [options.a.is_dir(), options.b.is_dir()] {
        [true, true] => folders::run(global, options),
        [false, false] => {
            let is_plain = matches!(options.output_format, DiffFormat::Text | DiffFormat::Json);
            if is_plain && options.accepted.is_none() {
                one(global, options)
            } else {
                folders::run(global, options)
            }
        }
        [is_folder, _] => {
            let (folder, program) =
                if is_folder { (&options.a, &options.b) } else { (&options.b, &options.a) };
            let message = format!("is a folder, and {} is not", crate::paths::shown(program));
            Err(Problem::with_file(folder, message)
                .help("compare a program with a program, or a folder with a folder"))
        }
    }
}

/// Compares two programs.
fn one(global: &Global, options: &DiffOptions) -> Result<u8, Problem> {
    output::refuse_to_replace(options.output_file.as_deref(), [options.a.as_path(), options.b.as_path()])?;
    let compared = runs::both(global, options, [&options.a, &options.b], &Arc::default(), Rest::Leave)?;
    let text = if options.output_format == DiffFormat::Json {
        let mut whole = compared.sides().json(&compared.differences);
        if let Some(whole) = whole.as_object_mut() {
            whole.insert("assumptions".to_owned(), compared.assumed.clone().into());
        }
        to_text(&whole)?
    } else {
        if !global.quiet {
            for control in &compared.controls {
                say(control);
            }
        }
        let mut text = compared.sides().text(&compared.differences);
        for assumed in &compared.assumed {
            text.push_str("assumed: ");
            text.push_str(assumed);
            text.push('\n');
        }
        text
    };
    output::to(options.output_file.as_deref(), &text)?;
    for fault in compared.faults.iter().flatten() {
        report(&fault.problem);
    }
    let is_enough = compared.is_same() && (!options.strict || compared.is_all_known());
    Ok(match (compared.has_fault(), is_enough) {
        (true, _) => FAILED,
        (false, true) => 0,
        (false, false) => DIFFERENT,
    })
}
