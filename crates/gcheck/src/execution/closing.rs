//! The messages beside the moves, on standard error: which control was used, why a run did not come to its end, and
//! what it rests on.
//!
//! Knows: where messages go. Must not know: their wording (see `fault_words` and `gcheck_lint`).

use std::fmt::Write as _;
use std::ops::Range;

use gcheck_diagnostics::StatedAssumption;
use gcheck_engine::{Ending, Origin, RunResult, Stopped, Units};
use gcheck_lint::fault_words::{self, Culprit, Words};
use gcheck_program::Word;
use gcheck_report::{FileReport, Report};
use gcheck_syntax::SourceText;

use super::session::Session;
use crate::Problem;
use crate::console::{report, say};

/// Alarms that a run past alarms reports one by one.
const MOST_REPORTED: usize = 20;

/// Which control reads the program, and why that one.
pub(crate) fn control_line(session: &Session<'_>) -> String {
    let prepared = session.prepared;
    let control = prepared.chosen.choice.clone();
    let report =
        Report::new(vec![FileReport::new(prepared.shown.clone(), SourceText::from(""), control, Vec::new())]);
    gcheck_report::control_lines(&report).join("\n")
}

/// Says where the control would have stopped, and why a run did not come to the end of the program.
pub(crate) fn end_of_run(session: &Session<'_>, result: &RunResult) {
    for alarm in result.alarms.iter().take(MOST_REPORTED) {
        report(&problem_of(&fault_at(session, result, &Stopped::Faulted(alarm.fault.clone()), alarm.origin)));
    }
    let more = result.alarms.len().saturating_sub(MOST_REPORTED);
    if more > 0 {
        say(&format!("{more} more blocks at which the control would stop"));
    }
    // The fault that ends a run past alarms is one of them.
    let is_told = !result.alarms.is_empty() && matches!(result.stopped, Stopped::Faulted(_));
    if let Some(fault) = early_end(session, result).filter(|_| !is_told) {
        report(&problem_of(&fault));
    }
}

/// The message about a run that did not come to the end of the program.
pub(crate) fn problem_of(fault: &Fault) -> Problem {
    let Fault { words, range, name, text } = fault;
    let mut problem = Problem::at(name, text, range, words.message.clone());
    if let Some(why) = &words.why {
        problem = problem.note(why.clone());
    }
    if let Some(help) = &words.help {
        problem = problem.help(help.clone());
    }
    problem
}

/// Why a run ended before the program did, and where.
pub(crate) struct Fault {
    pub(crate) words: Words,
    /// Bytes of `text`.
    pub(crate) range: Range<usize>,
    /// The file.
    pub(crate) name: String,
    pub(crate) text: String,
}

/// Why a run did not come to the end of the program, or where the control would have stopped first; `None` if neither.
pub(crate) fn fault_of(session: &Session<'_>, result: &RunResult) -> Option<Fault> {
    if let Some(alarm) = result.alarms.first() {
        return Some(fault_at(session, result, &Stopped::Faulted(alarm.fault.clone()), alarm.origin));
    }
    early_end(session, result)
}

/// Why a run did not come to the end of the program; `None` if it did.
fn early_end(session: &Session<'_>, result: &RunResult) -> Option<Fault> {
    (!result.stopped.is_program_end()).then(|| fault_at(session, result, &result.stopped, result.origin))
}

fn fault_at(session: &Session<'_>, result: &RunResult, stopped: &Stopped, origin: Origin) -> Fault {
    let units = result.state.units(session.model).unwrap_or(session.prepared.equipment.units);
    let at_block = |fault: &gcheck_engine::Fault| {
        fault_words::at_block(fault, session.program, session.model, origin, &result.state, units)
    };
    let (words, culprit) = match stopped {
        Stopped::Ended(Ending::Alarm(number)) => (at_block(&gcheck_engine::Fault::Alarm(*number)), None),
        Stopped::Ended(_) => (at_block(&gcheck_engine::Fault::NoProgramEnd), None),
        Stopped::Faulted(fault) => (at_block(fault), fault_words::culprit(fault)),
        Stopped::OutOfFuel => (fault_words::out_of_fuel(result.blocks), None),
    };
    let file = session.program.file(origin.at.file);
    let (name, text) = match &file {
        Some(file) if !file.name.is_empty() => (&*file.name, file.loaded.text().into_owned()),
        _ => (session.prepared.shown.as_str(), session.prepared.source.text().to_owned()),
    };
    let range = range(session, origin, culprit);
    Fault { words, range, name: name.to_owned(), text }
}

/// The word that a fault is about, else the block.
fn range(session: &Session<'_>, origin: Origin, culprit: Option<Culprit>) -> Range<usize> {
    let start = origin.start as usize;
    let Some(file) = session.program.file(origin.at.file) else { return start..start };
    let Some(place) = file.loaded.place(origin.at.block, session.program.dialect()) else {
        // After the last block: the end of the text.
        let end = file.loaded.text().trim_end().len();
        return end..end;
    };
    let is_it = |word: &&Word| match culprit {
        Some(Culprit::Letter(letter)) => word.letter == letter,
        Some(Culprit::Code(code)) => word.code == code,
        Some(Culprit::UnknownCode) => fault_words::is_unknown_code(word),
        None => false,
    };
    let block = place.range();
    match place.table.words(place.block()).iter().rfind(is_it) {
        Some(word) => (place.base + word.range().start) as usize..(place.base + word.range().end) as usize,
        None => block.start as usize..block.end as usize,
    }
}

/// What a run rests on that is not configured.
pub(crate) struct Rests(Vec<StatedAssumption>);

impl Rests {
    pub(crate) fn new(session: &Session<'_>, result: &RunResult) -> Self {
        let mut all = gcheck_lint::describe_all(&result.assumptions, session.model);
        let equipment = &session.prepared.equipment;
        if equipment.units_assumed && !session.axes.says_units {
            let (units, key) = match equipment.units {
                Units::Inch => ("inches", "inch"),
                Units::Mm => ("millimetres", "mm"),
            };
            let text = format!("lengths are {units}: the program does not say");
            all.insert(0, StatedAssumption { text, pin: Some(format!("[machine] units = \"{key}\"")) });
        }
        Self(all)
    }

    /// Further ones, in front of these.
    pub(crate) fn after(mut self, mut first: Vec<StatedAssumption>) -> Self {
        first.append(&mut self.0);
        Self(first)
    }

    pub(crate) fn described(&self) -> &[StatedAssumption] {
        &self.0
    }

    /// As text for people: what, and the lines of gcheck.toml that would settle it. Empty where nothing is assumed.
    pub(crate) fn text(&self) -> String {
        if self.0.is_empty() { String::new() } else { format!("assumed\n{}", self.lines()) }
    }

    /// The same without its heading, to be added to a list of what is assumed.
    pub(crate) fn lines(&self) -> String {
        let mut out = String::new();
        for StatedAssumption { text, .. } in &self.0 {
            // Writing to a string cannot fail.
            let _ = writeln!(out, "  {text}");
        }
        let pins = gcheck_diagnostics::pins(&self.0);
        if !pins.is_empty() {
            out.push_str("gcheck.toml can say\n");
            for line in pins {
                let _ = writeln!(out, "  {line}");
            }
        }
        out
    }
}
