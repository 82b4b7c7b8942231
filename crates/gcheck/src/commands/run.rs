//! `gcheck run`: the moves of a program.
//!
//! Knows: which format takes which sink. Must not know: how moves come about.

use std::io::{self, Write};

use gcheck_engine::{Ending, RunResult, Stopped};
use gcheck_toolpath::{Canonical, Csv, JsonLines, Start, Step, Text};

use crate::args::{Global, RunFormat, RunOptions};
use crate::console::say;
use crate::execution::{self, Rests, Session, Steps};
use crate::{Problem, output};

/// Runs the command; the exit code is its result.
pub(crate) fn run(global: &Global, options: &RunOptions) -> Result<u8, Problem> {
    output::refuse_to_replace(options.output_file.as_deref(), [&*options.execution.file])?;
    let prepared = execution::prepare(global, &options.execution, execution::Start::Fresh)?;
    prepared.session(|session| {
        if !global.quiet {
            say(&execution::control_line(session));
        }
        let mut ran = None;
        let write = |out: &mut dyn Write| -> io::Result<()> {
            ran = Some(print(session, options, out)?);
            Ok(())
        };
        match &options.output_file {
            Some(file) => output::to_file(file, write)?,
            None => output::to_stdout(write)?,
        }
        // Nobody reads on: there is no result to speak of.
        let Some(ran) = ran else { return Ok(0) };
        execution::end_of_run(session, &ran);
        if options.output_format == RunFormat::Text && !global.quiet {
            say(&Rests::new(session, &ran).text());
        }
        Ok(execution::exit_code(&ran))
    })
}

fn print(session: &Session<'_>, options: &RunOptions, out: &mut dyn Write) -> io::Result<RunResult> {
    let timing = session.prepared.equipment.timing;
    match options.output_format {
        RunFormat::Canonical => {
            let equipment = &session.prepared.equipment;
            let mut canonical = Canonical::new(out).with_tool_table(equipment.table.clone());
            canonical.prologue(&start(session))?;
            let (result, canonical) = execute(session, options, canonical)?;
            canonical.epilogue(match result.stopped {
                Stopped::Ended(Ending::Tape) => gcheck_toolpath::Ending::Percent,
                Stopped::Ended(_) => gcheck_toolpath::Ending::Program,
                Stopped::Faulted(_) | Stopped::OutOfFuel => gcheck_toolpath::Ending::Fault,
            })?;
            Ok(result)
        }
        RunFormat::Jsonl => {
            let (result, lines) = execute(session, options, JsonLines::new(out, session.all_axes(), timing))?;
            lines.finish()?;
            Ok(result)
        }
        RunFormat::Csv => {
            let (result, table) = execute(session, options, Csv::new(out, session.all_axes(), timing)?)?;
            table.finish()?;
            Ok(result)
        }
        RunFormat::Text => {
            let (result, table) = execute(session, options, Text::new(out, session.used_axes(), timing))?;
            table.finish()?;
            Ok(result)
        }
    }
}

fn execute<S: Steps>(session: &Session<'_>, options: &RunOptions, steps: S) -> io::Result<(RunResult, S)> {
    if options.past_alarms { session.run_past_alarms(steps) } else { session.run(steps) }
}

/// What is in effect before the first block.
fn start(session: &Session<'_>) -> Start {
    let work = session.model.work_at_power_on().unwrap_or(1);
    let offset = session.prepared.equipment.machine.offsets.get(&work);
    let known = Start { work, ..Start::default() };
    offset.map_or(known, |offset| Start { offset: offset.origin, rotation: offset.rotation, ..known })
}

impl<W: Write> Steps for Canonical<W> {
    const AS_INTERPRETED: bool = true;

    fn step(&mut self, step: &Step<'_>) -> io::Result<()> {
        self.step(step)
    }
}

impl<W: Write> Steps for JsonLines<W> {
    fn step(&mut self, step: &Step<'_>) -> io::Result<()> {
        self.step(step)
    }
}

impl<W: Write> Steps for Csv<W> {
    fn step(&mut self, step: &Step<'_>) -> io::Result<()> {
        self.step(step)
    }
}

impl<W: Write> Steps for Text<W> {
    fn step(&mut self, step: &Step<'_>) -> io::Result<()> {
        self.step(step)
    }
}
