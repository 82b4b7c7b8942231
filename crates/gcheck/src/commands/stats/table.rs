//! The figures of many programs: a row each.
//!
//! Knows: the columns, the formats. Must not know: how figures come about.

use std::fmt::Write as _;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::thread;

use gcheck_engine::Units;
use gcheck_geometry::Seconds;
use gcheck_toolpath::{clock, counts_in_hours, csv_cell};
use rayon::prelude::*;
use serde_json::{Value, json};

use crate::args::{Global, StatsFormat, StatsOptions};
use crate::commands::columns;
use crate::config::Configs;
use crate::console::finish;
use crate::containment::guarded;
use crate::programs::ProgramFolders;
use crate::progress::Progress;
use crate::{Problem, discovery, output, paths, threads};

/// Version of the JSON's shape.
const VERSION: u32 = 1;
/// How a program ended that could not be run.
const NOT_RUN: &str = "not-run";
/// Axes whose extents have columns.
const AXES: [&str; 3] = ["X", "Y", "Z"];

/// A program and its figures.
struct Row {
    file: String,
    /// The figures as `stats` prints them of one program.
    figures: Result<Value, Problem>,
}

/// Gathers the figures of all programs and prints them.
pub(super) fn run(
    global: &Global,
    options: &StatsOptions,
    figures: impl Fn(&Path, &Arc<ProgramFolders>) -> Result<Value, Problem> + Sync,
) -> Result<u8, Problem> {
    let mut configs = Configs::new(&global.config, global.isolated)?;
    let (standard_input, named): (Vec<PathBuf>, Vec<PathBuf>) =
        options.files.iter().cloned().partition(|file| paths::is_standard_input(file));
    let mut found = discovery::find(&named, &mut configs);
    // It can be read once.
    found.files.extend(standard_input.into_iter().take(1));
    let mut problems = found.problems;
    if found.files.is_empty() && problems.is_empty() {
        let named: Vec<String> = options.files.iter().map(|path| paths::shown(path)).collect();
        return Err(Problem::new(format!("no programs in {}", named.join(", "))));
    }
    output::refuse_to_replace(options.output_file.as_deref(), found.files.iter().map(PathBuf::as_path))?;
    let rows = gather(global, &found.files, figures)?;
    let text = match options.output_format {
        StatsFormat::Text => text(&rows),
        StatsFormat::Csv => csv(&rows),
        StatsFormat::Json => crate::commands::json(&as_json(&rows))?,
    };
    output::to(options.output_file.as_deref(), &text)?;
    problems.extend(rows.iter().filter_map(|row| row.figures.as_ref().err().cloned()));
    problems.extend(rows.iter().filter_map(Row::fault));
    Ok(finish(&problems, 0))
}

fn gather(
    global: &Global,
    files: &[PathBuf],
    figures: impl Fn(&Path, &Arc<ProgramFolders>) -> Result<Value, Problem> + Sync,
) -> Result<Vec<Row>, Problem> {
    let folders = Arc::new(ProgramFolders::default());
    let progress = Progress::new(files.len(), global.quiet);
    let pool = threads::pool(thread::available_parallelism().map_or(1, Into::into))?;
    let rows = pool.install(|| {
        let rows = files.par_iter().map(|file| {
            progress.counting(|| Row {
                file: paths::shown(file),
                figures: guarded(file, || figures(file, &folders)),
            })
        });
        rows.collect()
    });
    progress.end();
    Ok(rows)
}

impl Row {
    /// A number of the figures, by the keys that lead to it.
    fn number(&self, keys: &[&str]) -> Option<f64> {
        let mut value = self.figures.as_ref().ok()?;
        for key in keys {
            value = value.get(key)?;
        }
        value.as_f64()
    }

    fn word(&self, pointer: &str) -> &str {
        let figures = self.figures.as_ref().ok();
        figures.and_then(|figures| figures.pointer(pointer)?.as_str()).unwrap_or_default()
    }

    /// The lowest and the highest coordinate of what is cut, in millimetres.
    fn extent(&self, axis: &str) -> Option<[f64; 2]> {
        let bounds = self.figures.as_ref().ok()?.pointer("/total/extents/cutting")?.get(axis)?;
        Some([bounds.get(0)?.as_f64()? * self.in_mm(), bounds.get(1)?.as_f64()? * self.in_mm()])
    }

    /// The way of moves of a kind, in millimetres.
    fn distance(&self, kind: &str) -> Option<f64> {
        Some(self.number(&["total", "distance", kind])? * self.in_mm())
    }

    /// The unit of the program's figures: one table has programs in inches and in millimetres.
    fn in_mm(&self) -> f64 {
        let units = if self.word("/units") == "inch" { Units::Inch } else { Units::Mm };
        units.in_mm()
    }

    fn seconds(&self) -> Option<f64> {
        self.number(&["total", "seconds", "total"])
    }

    /// The time is less than the real one: the machine's acceleration is not told.
    fn is_lower_bound(&self) -> bool {
        self.word("/times") == "lower-bound"
    }

    /// Tools that work, each once.
    fn tools(&self) -> Option<usize> {
        let tools = self.figures.as_ref().ok()?.get("tools")?.as_array()?;
        let cuts = |tool: &Value| tool.pointer("/distance/cutting").and_then(Value::as_f64) > Some(0.0);
        // Before the first tool change there may be none in the spindle, or one of which nothing is known.
        let works = |tool: &&Value| tool.get("tool").and_then(Value::as_u64) > Some(0) || cuts(tool);
        let mut numbers: Vec<Option<u64>> =
            tools.iter().filter(works).map(|tool| tool.get("tool").and_then(Value::as_u64)).collect();
        numbers.sort_unstable();
        numbers.dedup();
        Some(numbers.len())
    }

    /// Why the run ended before the program.
    fn fault(&self) -> Option<Problem> {
        let fault = self.figures.as_ref().ok()?.get("fault").filter(|fault| !fault.is_null())?;
        let word = |key: &str| fault.get(key).and_then(Value::as_str).unwrap_or_default();
        let line = fault.get("line").and_then(Value::as_u64).unwrap_or_default();
        let message = format!("line {line}: {}; the figures end there", word("message"));
        Some(Problem::with_file(Path::new(word("file")), message))
    }
}

fn text(rows: &[Row]) -> String {
    let hours = rows.iter().filter_map(Row::seconds).any(|seconds| counts_in_hours(Seconds(seconds)));
    let [time_head, cutting_head] = if hours { ["time h", "cutting h"] } else { ["time min", "cutting min"] };
    let heads = ["program", "control", time_head, cutting_head, "tools", "changes", "cut mm", "X", "Y", "Z"];
    let mut table = vec![heads.map(str::to_owned).to_vec()];
    let whole = |number: Option<f64>| number.map_or_else(|| "?".to_owned(), |number| format!("{number:.0}"));
    let time =
        |number: Option<f64>| number.map_or_else(|| "?".to_owned(), |number| clock(Seconds(number), hours));
    for row in rows {
        let name = gcheck_report::one_line(&row.file).into_owned();
        if row.figures.is_err() {
            table.push(vec![name, "no figures".to_owned()]);
            continue;
        }
        let mut cells = vec![name, row.word("/control/name").to_owned(), time(row.seconds())];
        cells.push(time(row.number(&["total", "seconds", "cutting"])));
        cells.push(row.tools().map_or_else(|| "?".to_owned(), |count| count.to_string()));
        cells.push(whole(row.number(&["total", "tool_changes"])));
        cells.push(whole(row.distance("cutting")));
        cells.extend(AXES.map(|axis| {
            row.extent(axis).map_or_else(|| "-".to_owned(), |[low, high]| format!("{low:.3} to {high:.3}"))
        }));
        table.push(cells);
    }
    let mut out = columns(&table);
    let total = Seconds(rows.iter().filter_map(Row::seconds).sum());
    let hours = counts_in_hours(total);
    let unit = if hours { "h" } else { "min" };
    let programs = if rows.len() == 1 { "1 program".to_owned() } else { format!("{} programs", rows.len()) };
    let bound = if rows.iter().any(Row::is_lower_bound) { " (lower bound)" } else { "" };
    // Writing to a string cannot fail.
    let _ = writeln!(
        out,
        "{programs}, {} {unit} in all{bound}; extents are of what is cut, in mm",
        clock(total, hours)
    );
    out
}

fn csv(rows: &[Row]) -> String {
    let mut out = String::from(
        "file,control,ended,seconds,times,cutting_seconds,tools,tool_changes,cutting_mm,rapid_mm",
    );
    for axis in AXES.map(str::to_lowercase) {
        // Writing to a string cannot fail.
        let _ = write!(out, ",{axis}_from_mm,{axis}_to_mm");
    }
    out.push_str(",problem\r\n");
    let number = |number: Option<f64>| number.map_or_else(String::new, |number| format!("{number:.3}"));
    for row in rows {
        let ends = AXES.into_iter().flat_map(|axis| {
            let extent = row.extent(axis);
            [extent.map(|[low, _]| low), extent.map(|[_, high]| high)]
        });
        let problem = row.figures.as_ref().err().map(Problem::message).unwrap_or_default();
        let fault = row.word("/fault/message");
        let mut cells = vec![
            row.file.clone(),
            row.word("/control/name").to_owned(),
            if row.figures.is_err() { NOT_RUN } else { row.word("/ended") }.to_owned(),
            number(row.seconds()),
            row.word("/times").to_owned(),
            number(row.number(&["total", "seconds", "cutting"])),
            row.tools().map_or_else(String::new, |count| count.to_string()),
            row.number(&["total", "tool_changes"]).map_or_else(String::new, |count| format!("{count:.0}")),
            number(row.distance("cutting")),
            number(row.distance("rapid")),
        ];
        cells.extend(ends.map(number));
        cells.push(if problem.is_empty() { fault } else { problem }.to_owned());
        let cells: Vec<String> = cells.iter().map(|cell| quoted(cell)).collect();
        out.push_str(&cells.join(","));
        out.push_str("\r\n");
    }
    out
}

/// A cell of text in a table of comma-separated values.
fn quoted(cell: &str) -> String {
    let mut out = Vec::new();
    csv_cell(&mut out, cell);
    String::from_utf8_lossy(&out).into_owned()
}

fn as_json(rows: &[Row]) -> Value {
    let programs: Vec<Value> = rows
        .iter()
        .map(|row| match &row.figures {
            Ok(figures) => figures.clone(),
            Err(problem) => json!({ "file": row.file, "ended": NOT_RUN, "problem": problem.message() }),
        })
        .collect();
    let total: f64 = rows.iter().filter_map(Row::seconds).sum();
    json!({ "version": VERSION, "programs": programs, "seconds": total })
}

#[cfg(test)]
mod tests {
    use super::quoted;

    #[test]
    fn cells_with_commas_are_quoted() {
        assert_eq!(quoted("a.nc"), "a.nc");
        assert_eq!(quoted("a, \"b\".nc"), "\"a, \"\"b\"\".nc\"");
    }
}
