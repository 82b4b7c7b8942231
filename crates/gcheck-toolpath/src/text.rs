//! The move list for reading: a line a move, in columns.
//!
//! Knows: widths and words. Must not know: how values come about, terminals.

use std::io::{self, Write};

use gcheck_engine::{Axis, FeedMode, Position, Units};

use crate::number::{brief, fixed, whole};
use crate::record::{Kind, Path, Record, Recorder};
use crate::sink::Sink;
use crate::step::{Beside, Step, View};
use crate::time::Timing;

/// Width of a coordinate.
const WIDTH: usize = 11;

/// Prints moves as a table: line, kind, the point reached, feed, seconds, and what else there is to say.
#[derive(Debug)]
#[must_use = "lines are written when `finish` is called"]
pub struct Text<W> {
    sink: Sink<W>,
    recorder: Recorder,
    view: View,
    file: String,
    units: Option<Units>,
    /// The cell being written.
    cell: Vec<u8>,
}

impl<W: Write> Text<W> {
    /// Prints to `writer` the axes of `view`.
    pub fn new(writer: W, view: View, timing: Timing) -> Self {
        Self {
            sink: Sink::new(writer),
            recorder: Recorder::new(timing),
            view,
            file: String::new(),
            units: None,
            cell: Vec::new(),
        }
    }

    /// Prints the lines of one event, if it has any. A heading is before the first line and wherever file or units
    /// change.
    pub fn step(&mut self, step: &Step<'_>) -> io::Result<()> {
        let Self { sink, recorder, view, file, units, cell } = self;
        recorder.records(step, |_, record| {
            if *units != Some(step.units) || file != step.file {
                *units = Some(step.units);
                step.file.clone_into(file);
                heading(sink, *view, step)?;
            }
            line(&mut sink.buffer, cell, *view, step, record);
            while sink.buffer.ends_with(b" ") {
                sink.buffer.pop();
            }
            sink.end_line()
        })
    }

    /// Hands the writer back.
    ///
    /// # Errors
    ///
    /// Those of the writer.
    pub fn finish(self) -> io::Result<W> {
        self.sink.finish()
    }
}

fn heading<W: Write>(sink: &mut Sink<W>, view: View, step: &Step<'_>) -> io::Result<()> {
    sink.text(step.file);
    sink.text(match step.units {
        Units::Inch => ", inch",
        Units::Mm => ", mm",
    });
    if view.has_diameters() {
        sink.text(", X is a diameter");
    }
    sink.end_line()?;
    sink.text("   line  move   ");
    for axis in view.axes() {
        sink.buffer.extend(std::iter::repeat_n(b' ', WIDTH - 1));
        sink.buffer.push(axis.name() as u8);
    }
    sink.text("       feed   seconds");
    sink.end_line()
}

/// A number with more characters is shown by its power of ten: nobody reads its digits, and the last ones are none.
const LONGEST: usize = 22;

/// Writes a cell to the right of its column.
fn right(out: &mut Vec<u8>, cell: &mut Vec<u8>, width: usize, write: impl FnOnce(&mut Vec<u8>)) {
    cell.clear();
    write(cell);
    if cell.len() > LONGEST
        && let Some(number) = std::str::from_utf8(cell).ok().and_then(|text| text.parse::<f64>().ok())
    {
        cell.clear();
        // Writing to a vector cannot fail.
        let _ = write!(cell, "{number:.4e}");
    }
    // Two cells never touch, however long they are.
    out.extend(std::iter::repeat_n(
        b' ',
        width.saturating_sub(cell.len()).max(usize::from(!cell.is_empty())),
    ));
    out.extend_from_slice(cell);
}

fn line(out: &mut Vec<u8>, cell: &mut Vec<u8>, view: View, step: &Step<'_>, record: &Record<'_>) {
    right(out, cell, 7, |out| whole(out, u64::from(step.line)));
    out.extend_from_slice(b"  ");
    let name = record.kind.name().as_bytes();
    out.extend_from_slice(name);
    out.extend(std::iter::repeat_n(b' ', 7_usize.saturating_sub(name.len())));
    if let Some(path) = &record.path {
        move_cells(out, cell, view, step, path, record.seconds);
        return;
    }
    let empty = view.axes().count() * WIDTH + 11;
    out.extend(std::iter::repeat_n(b' ', empty));
    right(out, cell, 10, |out| {
        if record.seconds.is_nan() || record.seconds > 0.0 || record.kind == Kind::Dwell {
            seconds(out, record.seconds);
        }
    });
    out.extend_from_slice(b"  ");
    if record.action.is_some() && record.value.is_none() && record.text.is_none() {
        out.extend_from_slice(record.action.unwrap_or_default().as_bytes());
    }
    if let Some(value) = record.value {
        value_of_action(out, record.action, value, step.units);
    }
    if let Some(text) = record.text {
        if record.value.is_some() {
            out.extend_from_slice(b", ");
        }
        out.extend(text.bytes().map(|byte| if byte < b' ' { b' ' } else { byte }));
    }
}

/// The cells of a move: where it goes, its feed and time, its arc, and why the tool is beside the programmed point.
fn move_cells(out: &mut Vec<u8>, cell: &mut Vec<u8>, view: View, step: &Step<'_>, path: &Path, took: f64) {
    let units = step.units;
    for axis in view.axes() {
        let value = view.coordinate(axis, path.to.raw(axis), units);
        right(out, cell, WIDTH, |out| {
            if value.is_finite() {
                // A negative zero is a zero to a reader.
                let value = if value.abs() < 0.000_05 { 0.0 } else { value };
                fixed(out, value, 4);
            } else {
                out.push(b'?');
            }
        });
    }
    right(out, cell, 11, |out| {
        if let Some((feed, _)) = path.feed {
            brief(out, feed, 4, "?");
        }
    });
    right(out, cell, 10, |out| seconds(out, took));
    match path.feed {
        Some((_, FeedMode::PerRevolution)) => out.extend_from_slice(b"  per turn"),
        Some((_, FeedMode::InverseTime)) => out.extend_from_slice(b"  inverse time"),
        _ => {}
    }
    if path.arc.is_some() {
        out.extend_from_slice(b"  ");
        arc(out, view, path, units);
    }
    if let Some(why) = step.beside {
        beside(out, view, path, why, units);
    }
}

/// The number that belongs to an action, with its unit.
fn value_of_action(out: &mut Vec<u8>, action: Option<&str>, (name, value): (&str, f64), units: Units) {
    let before = match action {
        Some("push") => "push ",
        Some("on") => "diameter ",
        Some("cut") => "cut ",
        Some("setup") => "setup, mode ",
        Some("unload") => "unload, left ",
        Some("orient") => "to ",
        Some("change") => "T",
        Some("set") => "now T",
        _ => "",
    };
    out.extend_from_slice(before.as_bytes());
    // Programs in inches give surface speeds in feet.
    let is_feet = name == "metres_per_minute" && units == Units::Inch;
    brief(out, if is_feet { value * 1000.0 / 25.4 / 12.0 } else { value }, 4, "?");
    out.extend_from_slice(match name {
        "rpm" => b" rpm".as_slice(),
        "metres_per_minute" if is_feet => b" ft/min",
        "metres_per_minute" => b" m/min",
        "degrees" => b" deg",
        _ => b"",
    });
}

fn seconds(out: &mut Vec<u8>, value: f64) {
    if value.is_finite() {
        fixed(out, value, 3);
    } else {
        out.push(b'?');
    }
}

fn arc(out: &mut Vec<u8>, view: View, path: &Path, units: Units) {
    let Some(arc) = &path.arc else { return };
    out.extend_from_slice(match arc.sweep() {
        // Of an arc that is not known, the way around is not shown.
        sweep if sweep.is_nan() => b"arc ".as_slice(),
        sweep if sweep < 0.0 => b"cw ",
        _ => b"ccw ",
    });
    brief(out, arc.sweep().to_degrees().abs(), 2, "?");
    out.extend_from_slice(b" deg about");
    let (first, second, _) = arc.plane().axes();
    for (index, (axis, value)) in [Axis::X, Axis::Y, Axis::Z].into_iter().zip(Path::centre(arc)).enumerate() {
        if index == first || index == second {
            out.extend_from_slice(&[b' ', axis.name() as u8]);
            brief(out, view.coordinate(axis, value, units), 4, "?");
        }
    }
}

/// The point that the program wrote, and where the axes stand for it.
fn beside(out: &mut Vec<u8>, view: View, path: &Path, why: Beside, units: Units) {
    out.extend_from_slice(match why {
        Beside::AlongTool { .. } => b"  posted point".as_slice(),
        Beside::AlongVector => b"  programmed point",
        Beside::UnknownCutter => b"  programmed",
    });
    point(out, view, &path.programmed, units);
    if why == Beside::UnknownCutter {
        out.extend_from_slice(b": the cutter's size or the start is not known");
        return;
    }
    out.extend_from_slice(b", axes at");
    point(out, view, &path.to, units);
    if let Beside::AlongTool { tip: Some(tip) } = why {
        out.extend_from_slice(b", tip at");
        point(out, view, &path.to.with_xyz(tip), units);
    }
}

fn point(out: &mut Vec<u8>, view: View, position: &Position, units: Units) {
    for axis in [Axis::X, Axis::Y, Axis::Z] {
        out.extend_from_slice(&[b' ', axis.name() as u8]);
        brief(out, view.coordinate(axis, position.raw(axis), units), 4, "?");
    }
}
