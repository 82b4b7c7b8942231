//! What is said beside the moves, on standard error: which control was used, why a run did not come to its end, and what it
//! rests on.
//!
//! Knows: where things are said. Must not know: their wording (see `fault_words` and `gcheck_rules::assumptions`).

use std::io::Write as _;
use std::ops::Range;
use std::sync::Arc;

use gcheck_controls::Letter;
use gcheck_engine::{Ending, Origin, RunResult, Stopped};
use gcheck_program::Word;
use gcheck_report::{FileReport, Report};
use gcheck_syntax::SourceText;

use super::Session;
use crate::Problem;
use crate::fault_words::{self, Culprit, Words};

/// Says something on standard error; nothing where there is nothing to say.
pub(crate) fn say(text: &str) {
    let text = text.trim_end();
    if !text.is_empty() {
        // With standard error gone there is nobody left to tell.
        let _ = writeln!(std::io::stderr(), "{text}");
    }
}

/// Which control reads the program, and why that one.
pub(crate) fn control_line(session: &Session<'_>) -> String {
    let prepared = session.prepared;
    let report = Report::new(vec![FileReport {
        path: prepared.shown.clone(),
        text: Arc::new(SourceText::from("")),
        control: prepared.choice.clone(),
        findings: Vec::new(),
        omitted: Vec::new(),
        lines: 0,
        suppressed: 0,
        baseline: 0,
        out_of_fuel: false,
    }]);
    gcheck_report::control_lines(&report).join("\n")
}

/// Says why a run did not come to the end of the program.
pub(crate) fn end_of_run(session: &Session<'_>, result: &RunResult) {
    let units = result.state.units(session.model).unwrap_or(session.prepared.equipment.units);
    let (words, culprit) = match &result.stopped {
        Stopped::Ended(Ending::Alarm(number)) => {
            let comment = comment_of(session, result.origin);
            (fault_words::alarm(*number, comment.as_deref()), None)
        }
        Stopped::Ended(_) => return,
        Stopped::Faulted(fault) => {
            (fault_words::words(fault, session.model, units), fault_words::culprit(fault))
        }
        Stopped::OutOfFuel => (fault_words::out_of_fuel(result.blocks), None),
    };
    crate::report(&problem(session, result.origin, culprit, words));
}

fn problem(session: &Session<'_>, origin: Origin, culprit: Option<Culprit>, words: Words) -> Problem {
    let Words { message, why, help } = words;
    let file = session.program.file(origin.at.file);
    let (name, text) = match &file {
        Some(file) if !file.name.is_empty() => (&*file.name, file.loaded.text()),
        _ => (session.prepared.shown.as_str(), session.prepared.source.text()),
    };
    let mut problem = Problem::at(name, text, &range(session, origin, culprit), message);
    if let Some(why) = why {
        problem = problem.note(why);
    }
    if let Some(help) = help {
        problem = problem.help(help);
    }
    problem
}

/// The word that a fault is about, else the block.
fn range(session: &Session<'_>, origin: Origin, culprit: Option<Culprit>) -> Range<usize> {
    let start = origin.start as usize;
    let Some(file) = session.program.file(origin.at.file) else { return start..start };
    let Some(place) = file.loaded.place(origin.at.block, session.program.dialect()) else {
        // Behind the last block: the end of the text.
        let end = file.loaded.text().trim_end().len();
        return end..end;
    };
    let is_it = |word: &&Word| match culprit {
        Some(Culprit::Letter(letter)) => word.letter == letter,
        Some(Culprit::Code(code)) => word.code == code,
        Some(Culprit::UnknownCode) => {
            let is_code = word.letter == Letter::of('G') || word.letter == Letter::of('M');
            is_code && !word.code.is_some()
        }
        None => false,
    };
    let block = place.range();
    match place.table.words(place.block()).iter().rfind(is_it) {
        Some(word) => (place.base + word.range().start) as usize..(place.base + word.range().end) as usize,
        None => block.start as usize..block.end as usize,
    }
}

/// The first comment of a block.
fn comment_of(session: &Session<'_>, origin: Origin) -> Option<String> {
    let file = session.program.file(origin.at.file)?;
    let place = file.loaded.place(origin.at.block, session.program.dialect())?;
    let block = place.range();
    let text = file.loaded.text().get(block.start as usize..block.end as usize)?;
    let (_, rest) = text.split_once('(')?;
    let comment = rest.split(')').next()?.trim();
    (!comment.is_empty()).then(|| comment.to_owned())
}

/// What the run rests on that nobody told gcheck, with the lines of gcheck.toml that would.
pub(crate) fn assumptions(_session: &Session<'_>, _result: &RunResult) -> String {
    String::new()
}
