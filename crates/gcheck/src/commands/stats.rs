//! `gcheck stats`: cycle time, distances, extents, feeds and speeds of a program, by tool and in total; of several programs a
//! row each.
//!
//! Knows: the messages beside the statistics. Must not know: how they are computed or laid out.

mod table;

use std::io;
use std::path::Path;
use std::sync::Arc;

use gcheck_diagnostics::StatedAssumption;
use gcheck_engine::{Assumption, Ending, RunResult, Stopped};
use gcheck_report::{ControlChoice, LineIndex};
use gcheck_toolpath::{Names, Statistics, Step};
use serde::Serialize;
use serde_json::{Value, json};

use super::json as to_text;
use crate::args::{ExecutionOptions, Global, StatsFormat, StatsOptions};
use crate::console::say;
use crate::execution::{self, Rests, Session, Steps};
use crate::programs::ProgramFolders;
use crate::{Problem, discovery, output};

/// Version of the JSON's shape.
const VERSION: u32 = 1;

/// Runs the command; the exit code is its result.
pub(crate) fn run(global: &Global, options: &StatsOptions) -> Result<u8, Problem> {
    let is_one = |file: &Path| !file.is_dir() && (file.exists() || !discovery::is_pattern(file));
    match options.files.as_slice() {
        [file] if is_one(file) && options.output_format != StatsFormat::Csv => one(global, options, file),
        _ => table::run(global, options, |file, folders| {
            figures(global, &options.conditions.of(file), folders)
        }),
    }
}

/// The figures of one program.
fn one(global: &Global, options: &StatsOptions, file: &Path) -> Result<u8, Problem> {
    output::refuse_to_replace(options.output_file.as_deref(), [file])?;
    let prepared = execution::prepare(global, &options.conditions.of(file), execution::Start::Fresh)?;
    prepared.session(|session| {
        if !global.quiet && options.output_format == StatsFormat::Text {
            say(&execution::control_line(session));
        }
        let (ran, statistics) = gather(session)?;
        let text = match options.output_format {
            StatsFormat::Text => text(session, &ran, &statistics),
            StatsFormat::Csv | StatsFormat::Json => to_text(&json(session, &ran, &statistics))?,
        };
        output::to(options.output_file.as_deref(), &text)?;
        execution::end_of_run(session, &ran);
        Ok(execution::exit_code(&ran))
    })
}

/// The figures of one program among others, for other programs.
fn figures(
    global: &Global,
    options: &ExecutionOptions,
    folders: &Arc<ProgramFolders>,
) -> Result<Value, Problem> {
    let prepared = execution::prepare(global, options, execution::Start::Fresh)?.among(Arc::clone(folders));
    prepared.session(|session| {
        let (ran, statistics) = gather(session)?;
        Ok(json(session, &ran, &statistics))
    })
}

fn gather(session: &Session<'_>) -> Result<(RunResult, Statistics), Problem> {
    let timing = session.prepared.equipment.timing;
    let statistics = Statistics::new(session.used_axes(), timing, session.model.work_at_power_on())
        .planned(session.prepared.equipment.plan.as_ref())
        .with_tools(&session.prepared.equipment.machine);
    let (ran, mut statistics) = session
        .run(statistics)
        .map_err(|error| Problem::new(format!("cannot gather the figures: {error}")))?;
    statistics.finish();
    Ok((ran, statistics))
}

fn with_names<R>(session: &Session<'_>, with: impl FnOnce(&Names<'_>) -> R) -> R {
    let tool = |tool| session.tool_name(tool);
    let offset = |number| Some(gcheck_lint::work_offset_name(number, session.model));
    with(&Names { tool: &tool, offset: &offset })
}

fn text(session: &Session<'_>, ran: &RunResult, statistics: &Statistics) -> String {
    let mut text = with_names(session, |names| statistics.to_text(names));
    let rests = Rests::new(session, ran).after(of_helices(session, statistics));
    if statistics.assumed().is_empty() && !rests.described().is_empty() {
        text.push('\n');
        text.push_str(&rests.text());
    } else {
        // The list of what is assumed is the last one of the figures.
        text.push_str(&rests.lines());
    }
    text
}

/// How helices are fed, where a setting that is not configured decides it and there are any.
fn of_helices(session: &Session<'_>, statistics: &Statistics) -> Vec<StatedAssumption> {
    let setting = session.prepared.equipment.helix_setting.as_ref().filter(|_| statistics.has_helices());
    let setting = setting.map(|number| Assumption::Setting(number.as_str().into()));
    setting.map(|setting| gcheck_lint::describe(&setting, session.model)).into_iter().collect()
}

/// What is in the JSON beside the figures.
#[derive(Debug, Serialize)]
struct Head<'s> {
    version: u32,
    file: &'s str,
    control: &'s ControlChoice,
    ended: &'static str,
    blocks: u64,
    fault: Option<Fault>,
}

#[derive(Debug, Serialize)]
struct Fault {
    message: String,
    note: Option<String>,
    help: Option<String>,
    file: String,
    line: u32,
    column: u32,
}

fn json(session: &Session<'_>, ran: &RunResult, statistics: &Statistics) -> Value {
    let fault = execution::fault_of(session, ran).map(|fault| {
        let place = LineIndex::new(&fault.text).position(&fault.text, fault.range.start as u32);
        Fault {
            message: fault.words.message,
            note: fault.words.why,
            help: fault.words.help,
            file: fault.name,
            line: place.line,
            column: place.column,
        }
    });
    let head = Head {
        version: VERSION,
        file: &session.prepared.shown,
        control: &session.prepared.chosen.choice,
        ended: ended(&ran.stopped),
        blocks: ran.blocks,
        fault,
    };
    let timing = statistics.assumptions().into_iter().map(|assumption| {
        let pin = assumption.key.map(|key| format!("[machine] {key} = …"));
        StatedAssumption { text: assumption.text, pin }
    });
    let rests = Rests::new(session, ran).after(of_helices(session, statistics)).after(timing.collect());
    let rests: Vec<Value> = rests
        .described()
        .iter()
        .map(|described| json!({ "text": described.text, "pin": described.pin }))
        .collect();
    // Both are structs, so both are objects.
    let mut whole = serde_json::to_value(head).unwrap_or_default();
    if let (Value::Object(whole), Value::Object(figures)) =
        (&mut whole, with_names(session, |names| statistics.to_json(names)))
    {
        whole.extend(figures);
        whole.insert("assumptions".to_owned(), Value::Array(rests));
    }
    whole
}

/// How a run ended, for other programs.
fn ended(stopped: &Stopped) -> &'static str {
    match stopped {
        Stopped::Ended(Ending::Program) => "program-end",
        Stopped::Ended(Ending::Restart) => "restart",
        Stopped::Ended(Ending::BarsUsed) => "bars-used",
        Stopped::Ended(Ending::Tape) => "tape-end",
        Stopped::Ended(Ending::Text) => "text-end",
        Stopped::Ended(Ending::Alarm(_)) => "alarm",
        Stopped::Faulted(_) => "fault",
        Stopped::OutOfFuel => "out-of-fuel",
    }
}

impl Steps for Statistics {
    fn step(&mut self, step: &Step<'_>) -> io::Result<()> {
        self.add(step);
        Ok(())
    }
}
