//! The command line of gcheck: arguments, files, configuration, choice of control.
//!
//! Knows: the file system, the environment, the terminal, exit codes. Must not know: how anything is computed or rendered;
//! that is `gcheck-lint`, `gcheck-rules` and `gcheck-report`.
//!
//! Exit codes: 0 nothing at or above `--fail-on`, or the program came to its end; 1 findings, or it did not; 2 the work could
//! not be done (usage, configuration, files).

pub mod args;
mod check;
mod commands;
pub mod config;
mod config_help;
mod console;
mod containment;
mod control_choice;
mod detection;
mod discovery;
mod execution;
mod importing;
mod in_force;
mod lsp;
mod nearest;
mod neighbours;
pub mod of_bytes;
mod output;
mod path_base;
mod paths;
mod problem;
mod programs;
mod progress;
mod quoting;
mod reading;
mod rewriting;
mod threads;
mod writing;

use std::ffi::OsString;
use std::panic::{self, AssertUnwindSafe};
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::{env, thread};

use clap::Parser as _;

pub use problem::Problem;

use args::{Arguments, Command, MachineCommand, SchemaOf};
use containment::guarded;

/// Runs the program with the arguments of the process.
pub fn main() -> ExitCode {
    let work = thread::Builder::new().stack_size(threads::STACK).spawn(|| match started() {
        Ok(code) => code,
        Err(problem) => {
            console::report(&problem);
            console::FAILED
        }
    });
    let ended = work.map_err(|error| Problem::new(format!("cannot start a thread: {error}")));
    match ended.map(thread::JoinHandle::join) {
        Ok(Ok(code)) => ExitCode::from(code),
        // What panics is contained inside; this is for a panic of the containment.
        Ok(Err(_)) => ExitCode::from(console::FAILED),
        Err(problem) => {
            console::report(&problem);
            ExitCode::from(console::FAILED)
        }
    }
}

fn started() -> Result<u8, Problem> {
    let given: Vec<OsString> = env::args_os().collect();
    args::refuse_names_among_options(&given)?;
    // Usage errors end the process here, with exit code 2.
    let arguments = Arguments::parse_from(given);
    panic::catch_unwind(AssertUnwindSafe(|| run(&arguments)))
        .unwrap_or_else(|payload| Err(Problem::own_mistake(payload.as_ref())))
}

fn run(arguments: &Arguments) -> Result<u8, Problem> {
    match &arguments.command {
        Command::Check(options) => check::run(&arguments.global, options),
        Command::Fmt(options) => commands::fmt::run(&arguments.global, options),
        Command::Edit(change) => {
            guarded(&change.target().file, || commands::edit::run(&arguments.global, change))
        }
        Command::Run(options) => {
            guarded(&options.execution.file, || commands::run::run(&arguments.global, options))
        }
        Command::Stats(options) => {
            guarded(first(&options.files), || commands::stats::run(&arguments.global, options))
        }
        Command::Diff(options) => guarded(&options.a, || commands::diff::run(&arguments.global, options)),
        Command::Plot(options) => {
            guarded(&options.execution.file, || commands::plot::run(&arguments.global, options))
        }
        Command::Explain(options) => commands::explain::run(&arguments.global, options),
        Command::Rules(options) => commands::rules::run(options),
        Command::Codes(options) => commands::codes::run(&arguments.global, options),
        Command::Controls(options) => commands::controls::run(options),
        Command::Init { schema } => commands::init::run(&arguments.global, *schema),
        Command::Machine(MachineCommand::Import(options)) => {
            commands::machine::import(&arguments.global, options)
        }
        Command::Machine(MachineCommand::List(options)) => commands::models::list(options),
        Command::Machine(MachineCommand::Show { name }) => commands::models::show(name),
        Command::Schema { of: SchemaOf::Configuration } => output::print(&config::schema()),
        Command::Schema { of: SchemaOf::Findings } => output::print(&gcheck_report::findings_schema()),
        Command::Lsp(_) => lsp::run(&arguments.global),
        Command::Completions { shell } => commands::completions::run(*shell),
    }
}

/// The program that a message about all of them names.
fn first(files: &[PathBuf]) -> &Path {
    files.first().map_or(Path::new("-"), |file| file)
}
