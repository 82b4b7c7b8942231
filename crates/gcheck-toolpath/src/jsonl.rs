//! The move list as JSON lines: one object a move.
//!
//! Knows: names and order of the fields. Must not know: how values come about. Numbers are rounded to six decimals;
//! `null` is a value that is unknown or does not apply.

use std::io::{self, Write};

use gcheck_engine::{Axis, FeedMode, Position, Units};

use crate::number::{brief, short, whole};
use crate::record::{Path, Record, Recorder};
use crate::sink::Sink;
use crate::step::{Beside, Step, View};
use crate::time::Timing;

/// Prints moves as JSON lines.
///
/// ```text
/// {"n":1,"file":"part.nc","line":12,"kind":"feed","units":"mm","from":{"X":0.0},"programmed":{"X":1.0},"to":{"X":1.0},
///  "machine":{"X":null},"feed":200.0,"feed_mode":"per-minute","seconds":0.3}
/// ```
///
/// Under a length along a tilting tool, where pivot and posted length are told, `tip` holds X, Y and Z of the tip.
/// Arcs have `"arc":{"centre":{…},"normal":{…},"sweep_deg":…}`. Lines that are not moves have `action`, a number named
/// after what it is (`tool`, `rpm`, …) and `text`, as far as they apply.
#[derive(Debug)]
#[must_use = "lines are written when `finish` is called"]
pub struct JsonLines<W> {
    sink: Sink<W>,
    recorder: Recorder,
    view: View,
    file: Quoted,
}

impl<W: Write> JsonLines<W> {
    /// Prints to `writer` the axes of `view`.
    pub fn new(writer: W, view: View, timing: Timing) -> Self {
        Self { sink: Sink::new(writer), recorder: Recorder::new(timing), view, file: Quoted::default() }
    }

    /// Prints the lines of one event, if it has any.
    pub fn step(&mut self, step: &Step<'_>) -> io::Result<()> {
        let Self { sink, recorder, view, file } = self;
        recorder.records(step, |n, record| {
            line(&mut sink.buffer, *view, file, n, step, record);
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

/// The last file's name as JSON: it hardly ever changes.
#[derive(Debug, Default)]
struct Quoted {
    plain: String,
    quoted: String,
}

impl Quoted {
    fn of(&mut self, text: &str) -> &str {
        if self.quoted.is_empty() || self.plain != text {
            text.clone_into(&mut self.plain);
            self.quoted = quoted(text);
        }
        &self.quoted
    }
}

fn quoted(text: &str) -> String {
    // A string is always JSON.
    serde_json::to_string(text).unwrap_or_default()
}

fn line(out: &mut Vec<u8>, view: View, file: &mut Quoted, n: u64, step: &Step<'_>, record: &Record<'_>) {
    out.extend_from_slice(b"{\"n\":");
    whole(out, n);
    out.extend_from_slice(b",\"file\":");
    out.extend_from_slice(file.of(step.file).as_bytes());
    out.extend_from_slice(b",\"line\":");
    whole(out, u64::from(step.line));
    out.extend_from_slice(b",\"kind\":\"");
    out.extend_from_slice(record.kind.name().as_bytes());
    out.extend_from_slice(match step.units {
        Units::Inch => b"\",\"units\":\"inch\"".as_slice(),
        Units::Mm => b"\",\"units\":\"mm\"",
    });
    if let Some(path) = &record.path {
        self::path(out, view, path, step.units);
        if let Some(Beside::AlongTool { tip: Some(tip) }) = step.beside {
            out.extend_from_slice(b",\"tip\":{");
            xyz(out, view, &path.to.with_xyz(tip), step.units);
            out.push(b'}');
        }
    }
    if let Some(action) = record.action {
        out.extend_from_slice(b",\"action\":\"");
        out.extend_from_slice(action.as_bytes());
        out.push(b'"');
    }
    if let Some((name, value)) = record.value {
        out.extend_from_slice(b",\"");
        out.extend_from_slice(name.as_bytes());
        out.extend_from_slice(b"\":");
        brief(out, value, 6, "null");
    }
    if let Some(text) = record.text {
        out.extend_from_slice(b",\"text\":");
        out.extend_from_slice(quoted(text).as_bytes());
    }
    out.extend_from_slice(b",\"seconds\":");
    short(out, record.seconds, 6, "null");
    out.push(b'}');
}

fn path(out: &mut Vec<u8>, view: View, path: &Path, units: Units) {
    let places = [
        (",\"from\":{", &path.from),
        (",\"programmed\":{", &path.programmed),
        (",\"to\":{", &path.to),
        (",\"machine\":{", &path.machine),
    ];
    for (name, position) in places {
        out.extend_from_slice(name.as_bytes());
        coordinates(out, view, position, units);
        out.push(b'}');
    }
    out.extend_from_slice(b",\"feed\":");
    short(out, path.feed.map_or(f64::NAN, |(feed, _)| feed), 6, "null");
    out.extend_from_slice(b",\"feed_mode\":");
    out.extend_from_slice(match path.feed {
        None => b"null".as_slice(),
        Some((_, FeedMode::PerMinute)) => b"\"per-minute\"",
        Some((_, FeedMode::InverseTime)) => b"\"inverse-time\"",
        Some((_, FeedMode::PerRevolution)) => b"\"per-rev\"",
    });
    if let Some(arc) = &path.arc {
        out.extend_from_slice(b",\"arc\":{\"centre\":{");
        for (axis, value) in [Axis::X, Axis::Y, Axis::Z].into_iter().zip(Path::centre(arc)) {
            if axis != Axis::X {
                out.push(b',');
            }
            key(out, axis);
            short(out, view.coordinate(axis, value, units), 6, "null");
        }
        let [x, y, z] = Path::normal(arc.plane()).map(|part| b'0' + part);
        out.extend_from_slice(b"},\"normal\":{\"X\":");
        out.push(x);
        out.extend_from_slice(b",\"Y\":");
        out.push(y);
        out.extend_from_slice(b",\"Z\":");
        out.push(z);
        out.extend_from_slice(b"},\"sweep_deg\":");
        short(out, arc.sweep().to_degrees(), 6, "null");
        out.push(b'}');
    }
}

fn coordinates(out: &mut Vec<u8>, view: View, position: &Position, units: Units) {
    let mut first = true;
    for axis in view.axes() {
        if !first {
            out.push(b',');
        }
        first = false;
        key(out, axis);
        short(out, view.coordinate(axis, position.raw(axis), units), 6, "null");
    }
}

fn xyz(out: &mut Vec<u8>, view: View, position: &Position, units: Units) {
    for axis in [Axis::X, Axis::Y, Axis::Z] {
        if axis != Axis::X {
            out.push(b',');
        }
        key(out, axis);
        short(out, view.coordinate(axis, position.raw(axis), units), 6, "null");
    }
}

fn key(out: &mut Vec<u8>, axis: Axis) {
    out.extend_from_slice(&[b'"', axis.name() as u8, b'"', b':']);
}
