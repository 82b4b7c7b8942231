//! `cargo xtask bench`: speed and memory against the budgets, in one table.
//!
//! Knows: the budgets and what each is measured with. Must not know: how the product works. It is not a test: a busy machine
//! would fail it.

mod command_line;
mod in_process;
mod keystrokes;
mod language_server;
mod many_files;
mod motion_planner;
mod peer;
mod row;

use std::process::ExitCode;

use anyhow::bail;

use crate::product;

/// Measures everything in the profile `dist`.
pub(crate) fn run(arguments: &[String]) -> anyhow::Result<ExitCode> {
    let only_server = match arguments {
        [] => false,
        [part] if part == "lsp" => true,
        _ => bail!("bench takes no arguments, or `lsp` for the language server alone"),
    };
    // Functions that are called in process must be as optimised as the product.
    if cfg!(debug_assertions) {
        return product::rerun("bench", arguments, true);
    }
    let mut rows = Vec::new();
    if !only_server {
        rows.extend(in_process::rows()?);
        rows.extend(motion_planner::rows()?);
        rows.extend(keystrokes::rows()?);
    }
    match command_line::build() {
        Ok((gcheck, inputs)) => {
            if !only_server {
                match command_line::rows(&gcheck, &inputs) {
                    Ok(more) => rows.extend(more),
                    Err(error) => eprintln!("{error:#}"),
                }
            }
            rows.extend(language_server::rows(&gcheck));
        }
        Err(error) => eprintln!("{error:#}"),
    }
    print!("{}", row::table(&rows));
    let missed = rows.iter().filter(|row| row.verdict() == Some(false)).count();
    println!("\n{missed} of {} budgets missed; CPU seconds are those of all processors together", rows.len());
    Ok(if missed == 0 { ExitCode::SUCCESS } else { ExitCode::FAILURE })
}
