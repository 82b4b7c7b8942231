//! Throughput of the front end and the formatter, and the analysis of all paths, called directly: tokens, blocks, trees, formatted text, flow.
//!
//! Knows: which functions the path of the data runs through. Must not know: the command line.

use std::hint::black_box;
use std::time::Instant;

use gcheck_engine::{FlowObserver, Machine, Model, NoLibrary, Program, Task, flow};
use gcheck_format::{Style, formatted};
use gcheck_program::{Dialect, Loaded, lower};
use gcheck_syntax::{SourceText, count_tokens, cut, parse};
use gcheck_testkit::inputs;

use super::row::{Limit, Row};

/// Fewer lines than the command-line rows use: throughput does not depend on length.
const LINES: usize = 200_000;
const RUNS: usize = 7;
/// Blocks that the analysis of all paths may execute, as `check` has it.
const FUEL: u64 = 50_000_000;

/// The control on whose behalf text is read.
pub(super) const CONTROL: &str = "generic-mill";

/// Measures.
pub(super) fn rows() -> anyhow::Result<Vec<Row>> {
    let control = gcheck_controls::load(CONTROL)?;
    let dialect = Dialect::new(&control);
    let surfacing = inputs::surfacing(LINES);
    let macros = inputs::macros(LINES);
    let throughput = |name: &str, text: &str, limit, work: &dyn Fn(&str)| {
        let seconds = best(|| work(text));
        #[expect(clippy::cast_precision_loss, reason = "a few million bytes")]
        let megabytes = text.len() as f64 / 1e6;
        Row {
            name: name.to_owned(),
            measured: Some(megabytes / seconds),
            limit: Limit::AtLeast(limit),
            unit: "MB/s",
        }
    };
    let tokens = |text: &str| {
        black_box(count_tokens(text, false));
    };
    let blocks = |text: &str| {
        for chunk in cut(text) {
            black_box(lower(text.get(chunk).unwrap_or_default(), &dialect));
        }
    };
    let mut rows = vec![
        throughput("tokens, surfacing", &surfacing, 240.0, &tokens),
        throughput("tokens and blocks, surfacing", &surfacing, 120.0, &blocks),
        throughput("tokens and blocks, macros", &macros, 30.0, &blocks),
    ];
    let style = Style::of(&control);
    let format = |source: &SourceText| black_box(formatted(source, &dialect, &style));
    // Nothing to do, an edit for each word, and what takes longest to read.
    let packed = SourceText::from(surfacing.replace(' ', "").as_str());
    let (formatted_already, dense) =
        (SourceText::from(surfacing.as_str()), SourceText::from(macros.as_str()));
    for (name, source) in [
        ("fmt, surfacing that is formatted already", &formatted_already),
        ("fmt, surfacing without blanks", &packed),
        ("fmt, macros", &dense),
    ] {
        rows.push(throughput(name, source.text(), 60.0, &|_| {
            format(source);
        }));
    }
    // A dense chunk of macros may take what leaves one millisecond of the five that a keystroke may take in a large file.
    let trees =
        [("tree of one chunk, surfacing", &surfacing, 0.6), ("tree of one chunk, macros", &macros, 4.0)];
    for (name, text, limit) in trees {
        // The slowest of the first chunks, because a user waits for whichever is being edited.
        let slowest = cut(text)
            .into_iter()
            .take(40)
            .map(|chunk| {
                let chunk = text.get(chunk).unwrap_or_default();
                best(|| {
                    black_box(parse(chunk, dialect.profile()));
                })
            })
            .fold(0.0, f64::max);
        let measured = Some(slowest * 1e3);
        rows.push(Row { name: name.to_owned(), measured, limit: Limit::AtMost(limit), unit: "ms" });
    }
    let program = inputs::macros(2_000);
    let model = Model::new(&control);
    let seconds = best(|| {
        let loaded = Loaded::new(program.as_str(), &dialect, |_, _, _| ());
        let program = Program::new(loaded, &dialect, &NoLibrary);
        black_box(flow(&program, &model, &Machine::default(), Task::all_paths(FUEL), &mut Nobody));
    });
    rows.push(Row {
        name: "flow, 2,000 lines of macros".to_owned(),
        measured: Some(seconds * 1e3),
        limit: Limit::AtMost(20.0),
        unit: "ms",
    });
    Ok(rows)
}

/// Watches nothing.
struct Nobody;

impl FlowObserver for Nobody {}

/// Seconds of the fastest of several runs: the one that was disturbed least.
fn best(mut work: impl FnMut()) -> f64 {
    (0..RUNS)
        .map(|_| {
            let start = Instant::now();
            work();
            start.elapsed().as_secs_f64()
        })
        .fold(f64::INFINITY, f64::min)
}
