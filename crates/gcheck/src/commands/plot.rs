//! `gcheck plot`: the toolpath of a program as a picture or as a page.
//!
//! Knows: which file gets what, the messages beside the picture. Must not know: how anything is drawn.

mod findings;

use std::io::{self, Write};
use std::path::Path;

use gcheck_engine::{Fault, RunResult};
use gcheck_report::LineIndex;
use gcheck_syntax::SourceText;
use gcheck_toolpath::plot::{Drawing, Heading, MAX_POINTS, Note, Page, Plot, Source};
use gcheck_toolpath::{Names, Step, WorkCoordinates};

use crate::args::{Global, PlotOptions};
use crate::console::say;
use crate::execution::{self, Prepared, Session, Steps};
use crate::{Problem, output, paths};
use findings::Found;

/// What is written, as the output's name says.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Form {
    Svg,
    Html,
}

impl Form {
    fn of(path: &Path) -> Result<Self, Problem> {
        if paths::is_standard_input(path) {
            return Ok(Self::Svg);
        }
        let extension = path.extension().map(|extension| extension.to_string_lossy().to_lowercase());
        match extension.as_deref() {
            Some("svg") => Ok(Self::Svg),
            Some("html" | "htm") => Ok(Self::Html),
            _ => Err(Problem::with_file(path, "the name does not say what to draw")
                .help("name a picture `.svg` or a page `.html`: `gcheck plot part.nc -o part.html`")),
        }
    }
}

/// Runs the command; the exit code is its result.
pub(crate) fn run(global: &Global, options: &PlotOptions) -> Result<u8, Problem> {
    let form = Form::of(&options.output_file)?;
    output::refuse_to_replace(Some(&options.output_file), [&*options.execution.file])?;
    let prepared = execution::prepare(global, &options.execution, execution::Start::Fresh)?;
    let found = match form {
        Form::Html => findings::of(global, options, &prepared)?,
        Form::Svg => Found::default(),
    };
    prepared.session(|session| {
        if !global.quiet {
            say(&execution::control_line(session));
        }
        let (ran, drawing) = draw(session, MAX_POINTS)?;
        let mut notes: Vec<Note> = stopped(session, &ran).into_iter().collect();
        notes.extend(found.note().map(Note::from));
        let write = |out: &mut dyn Write| match form {
            Form::Svg => svg(session, &drawing, &notes, out),
            Form::Html => page(session, &drawing, &found, &notes, out),
        };
        if paths::is_standard_input(&options.output_file) {
            output::to_stdout(write)?;
        } else {
            output::to_file(&options.output_file, write)?;
        }
        if !global.quiet {
            let words: Vec<String> = drawing.notes().into_iter().map(|note| note.words).collect();
            say(&words.join("\n"));
        }
        execution::end_of_run(session, &ran);
        Ok(execution::exit_code(&ran))
    })
}

/// The paths of two programs over each other, as an SVG element.
///
/// # Errors
/// A path cannot be recorded.
pub(super) fn overlaid(a: &Prepared, b: &Prepared, points: usize) -> Result<String, Problem> {
    let drawing = |prepared: &Prepared| prepared.session(|session| draw(session, points));
    let ((_, a), (_, b)) = (drawing(a)?, drawing(b)?);
    Ok(a.overlaid(&b))
}

fn draw(session: &Session<'_>, points: usize) -> Result<(RunResult, Drawing), Problem> {
    let equipment = &session.prepared.equipment;
    let work = WorkCoordinates::at_power_on(session.model, &equipment.machine);
    let mut plot =
        Plot::new(session.all_axes(), equipment.timing, work, points).on_machine(&equipment.machine);
    if session.model.control().machine() == gcheck_controls::Machine::Lathe {
        plot = plot.for_lathe();
    }
    let (ran, plot) = session
        .run_for_picture(plot)
        .map_err(|error| Problem::new(format!("cannot record the path: {error}")))?;
    Ok((ran, plot.finish()))
}

/// That the control would stop, or that the picture is a part of the program's path, and why.
fn stopped(session: &Session<'_>, ran: &RunResult) -> Option<Note> {
    let fault = execution::fault_of(session, ran)?;
    let place = LineIndex::new(&fault.text).position(&fault.text, fault.range.start as u32);
    let what = if ran.alarms.is_empty() { "the run ended" } else { "the control would stop" };
    Some(Note {
        words: format!("{what} in {}, line {}: {}", fault.name, place.line, fault.words.message),
        file: Some(fault.name),
        line: Some(place.line),
    })
}

fn with_names<R>(session: &Session<'_>, with: impl FnOnce(&Names<'_>) -> R) -> R {
    let tool = |tool| session.tool_name(tool);
    let offset = |number| Some(gcheck_lint::work_offset_name(number, session.model));
    with(&Names { tool: &tool, offset: &offset })
}

fn svg(session: &Session<'_>, drawing: &Drawing, notes: &[Note], out: &mut dyn Write) -> io::Result<()> {
    let svg = with_names(session, |names| drawing.to_svg(&session.prepared.shown, notes, names));
    out.write_all(svg.as_bytes())
}

fn page(
    session: &Session<'_>,
    drawing: &Drawing,
    found: &Found,
    notes: &[Note],
    out: &mut dyn Write,
) -> io::Result<()> {
    let shown = &session.prepared.shown;
    let mut texts = vec![(shown.clone(), readable(session.prepared.source.text()))];
    // The main file is 0, and the others follow without a gap.
    let others: Vec<_> = (1..).map_while(|index| session.program.file(index)).collect();
    let others: Vec<_> = others.iter().map(|file| (file.name.to_string(), file.loaded.text())).collect();
    for (name, text) in &others {
        texts.push((name.clone(), readable(text)));
    }
    let sources: Vec<Source<'_>> = texts.iter().map(|(name, text)| Source { name, text }).collect();
    let findings: Vec<_> = found.findings(shown).collect();
    let text = session.prepared.source.text();
    let index = LineIndex::new(text);
    let headings: Vec<Heading<'_>> = session
        .headings
        .iter()
        .map(|heading| Heading { file: shown, line: index.line(heading.from), name: &heading.name })
        .collect();
    let page = Page {
        title: shown,
        control: &session.prepared.chosen.choice.name,
        sources: &sources,
        findings: &findings,
        headings: &headings,
        notes,
    };
    // The page is written in small pieces.
    let mut out = io::BufWriter::with_capacity(1 << 18, out);
    with_names(session, |names| drawing.write_page(&page, names, &mut out))?;
    out.flush()
}

/// Text with the sign for what cannot be read in place of the stand-ins for bytes.
fn readable(text: &str) -> std::borrow::Cow<'_, str> {
    if text.contains(SourceText::STAND_IN) {
        text.replace(SourceText::STAND_IN, "\u{fffd}").into()
    } else {
        text.into()
    }
}

impl Steps for Plot {
    fn step(&mut self, step: &Step<'_>) -> io::Result<()> {
        self.add(step);
        Ok(())
    }

    fn alarm(&mut self, file: &str, line: u32, fault: &Fault) -> io::Result<()> {
        if *fault != Fault::Undecidable {
            self.alarm(file, line);
        }
        Ok(())
    }

    fn assumed(&mut self, file: &str, line: u32, words: &str) {
        self.assumed(file, line, words);
    }
}
