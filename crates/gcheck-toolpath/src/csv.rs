//! The move list as comma-separated values.
//!
//! Knows: the columns. Must not know: how values come about. An empty cell is a value that is unknown or does not
//! apply; text is quoted as RFC 4180 says; numbers are rounded to six decimals.

use std::io::{self, Write};

use gcheck_engine::{Axis, FeedMode, Units};

use crate::number::{brief, short, whole};
use crate::record::{Path, Record, Recorder};
use crate::sink::Sink;
use crate::step::{Step, View};
use crate::time::Timing;

const PLACES: [&str; 4] = ["from", "programmed", "to", "machine"];

/// Prints moves as comma-separated values with a header.
#[derive(Debug)]
#[must_use = "lines are written when `finish` is called"]
pub struct Csv<W> {
    sink: Sink<W>,
    recorder: Recorder,
    view: View,
}

impl<W: Write> Csv<W> {
    /// Prints to `writer` the axes of `view`, the header first.
    ///
    /// # Errors
    ///
    /// Those of the writer.
    pub fn new(writer: W, view: View, timing: Timing) -> io::Result<Self> {
        let mut sink = Sink::new(writer);
        sink.text("n,file,line,kind,units");
        for place in PLACES {
            for axis in view.axes() {
                sink.text(",");
                sink.text(place);
                sink.text("_");
                sink.buffer.push(axis.name() as u8);
            }
        }
        sink.text(",feed,feed_mode,centre_X,centre_Y,centre_Z,normal,sweep_deg,seconds,action,value,text");
        sink.end_line()?;
        Ok(Self { sink, recorder: Recorder::new(timing), view })
    }

    /// Prints the lines of one event, if it has any.
    pub fn step(&mut self, step: &Step<'_>) -> io::Result<()> {
        let Self { sink, recorder, view } = self;
        recorder.records(step, |n, record| {
            line(&mut sink.buffer, *view, n, step, record);
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

fn line(out: &mut Vec<u8>, view: View, n: u64, step: &Step<'_>, record: &Record<'_>) {
    whole(out, n);
    out.push(b',');
    csv_cell(out, step.file);
    out.push(b',');
    whole(out, u64::from(step.line));
    out.push(b',');
    out.extend_from_slice(record.kind.name().as_bytes());
    out.extend_from_slice(match step.units {
        Units::Inch => b",inch".as_slice(),
        Units::Mm => b",mm",
    });
    match &record.path {
        Some(path) => self::path(out, view, path, step.units),
        None => {
            let cells = view.axes().count() * PLACES.len() + 7;
            out.extend(std::iter::repeat_n(b',', cells));
        }
    }
    out.push(b',');
    short(out, record.seconds, 6, "");
    out.push(b',');
    out.extend_from_slice(record.action.unwrap_or_default().as_bytes());
    out.push(b',');
    brief(out, record.value.map_or(f64::NAN, |(_, value)| value), 6, "");
    out.push(b',');
    csv_cell(out, record.text.unwrap_or_default());
}

fn path(out: &mut Vec<u8>, view: View, path: &Path, units: Units) {
    for position in [&path.from, &path.programmed, &path.to, &path.machine] {
        for axis in view.axes() {
            out.push(b',');
            short(out, view.coordinate(axis, position.raw(axis), units), 6, "");
        }
    }
    out.push(b',');
    short(out, path.feed.map_or(f64::NAN, |(feed, _)| feed), 6, "");
    out.extend_from_slice(match path.feed {
        None => b",".as_slice(),
        Some((_, FeedMode::PerMinute)) => b",per-minute",
        Some((_, FeedMode::InverseTime)) => b",inverse-time",
        Some((_, FeedMode::PerRevolution)) => b",per-rev",
    });
    let Some(arc) = &path.arc else {
        out.extend_from_slice(b",,,,,");
        return;
    };
    for (axis, value) in [Axis::X, Axis::Y, Axis::Z].into_iter().zip(Path::centre(arc)) {
        out.push(b',');
        short(out, view.coordinate(axis, value, units), 6, "");
    }
    out.extend_from_slice(match Path::normal(arc.plane()) {
        [1, _, _] => b",X,".as_slice(),
        [_, 1, _] => b",Y,",
        _ => b",Z,",
    });
    short(out, arc.sweep().to_degrees(), 6, "");
}

/// Writes a cell of text as RFC 4180 wants it: quoted where it holds a comma, a quote or a line end.
pub fn csv_cell(out: &mut Vec<u8>, text: &str) {
    if !text.contains(['"', ',', '\n', '\r']) {
        out.extend_from_slice(text.as_bytes());
        return;
    }
    out.push(b'"');
    out.extend_from_slice(text.replace('"', "\"\"").as_bytes());
    out.push(b'"');
}
