//! A drawing as the data that the viewer reads; viewer.js says what is in it.
//!
//! Knows: names and encoding of the fields. Must not know: what the viewer makes of them.

use gcheck_engine::{FeedMode, Units};
use serde::Serialize;
use serde_json::Value;

use super::drawing::{Drawing, Kind};
use super::drive::Drive;
use super::packed::{differences, runs};
use crate::summary::Names;

/// Version of the data's form.
const VERSION: u32 = 2;
/// Steps of lengths, millimetres: as fine as single precision at a metre.
const LENGTH_STEP: f64 = 1e-4;
/// Steps of angles, degrees.
const ANGLE_STEP: f64 = 1e-4;
/// Steps of times, seconds.
const TIME_STEP: f64 = 1e-3;
/// An angle that is not known, degrees: further than any axis turns.
const UNKNOWN_ANGLE: f64 = 1e9;

/// What a comment on a line of its own calls the moves after it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Heading<'a> {
    /// Name of the file, as steps of the run have it.
    pub file: &'a str,
    /// Line of the first block after the comment, from 1.
    pub line: u32,
    /// What the comment says.
    pub name: &'a str,
}

#[derive(Debug, Serialize)]
#[serde(rename_all = "camelCase")]
pub(super) struct ViewerData<'d> {
    version: u32,
    units: &'static str,
    lathe: bool,
    diameter: bool,
    tools: Vec<ToolData>,
    files: &'d [String],
    count: usize,
    points: String,
    seconds: String,
    lines: String,
    kinds: String,
    tool_of: String,
    file_of: Option<String>,
    drive_of: String,
    drives: Vec<DriveData>,
    call_of: Option<String>,
    calls: &'d [Vec<(u8, u32)>],
    rotary: Option<RotaryData>,
    headings: Vec<HeadingData<'d>>,
    changes: &'d [(u8, u32)],
    thinned: bool,
    cut: Option<[[f64; 3]; 2]>,
    all: Option<[[f64; 3]; 2]>,
    alarms: Vec<AlarmData>,
    zeros: Vec<ZeroData>,
    travel: [Option<[f64; 2]>; 2],
}

#[derive(Debug, Serialize)]
struct ZeroData {
    name: String,
    at: [f64; 3],
}

#[derive(Debug, Serialize)]
struct DriveData {
    feed: Option<f64>,
    mode: &'static str,
    along: Option<f64>,
    rpm: Option<f64>,
}

#[derive(Debug, Serialize)]
struct RotaryData {
    axes: String,
    values: String,
}

#[derive(Debug, Serialize)]
struct HeadingData<'d> {
    file: usize,
    line: u32,
    name: &'d str,
}

#[derive(Debug, Serialize)]
struct AlarmData {
    file: u8,
    line: u32,
    at: Option<[f32; 3]>,
}

#[derive(Debug, Serialize)]
struct ToolData {
    number: Option<u32>,
    name: Option<String>,
    color: &'static str,
    diameter: Option<f64>,
}

impl Drawing {
    /// The drawing for the viewer of `plot/viewer.js`, which says at its top what is in it; `headings` in the order of their
    /// files.
    pub fn to_json(&self, names: &Names<'_>, headings: &[Heading<'_>]) -> Value {
        // Only maps without string keys cannot be values, and there are none.
        serde_json::to_value(self.viewer_data(names, headings)).unwrap_or_default()
    }

    pub(super) fn viewer_data<'d>(&'d self, names: &Names<'_>, headings: &[Heading<'d>]) -> ViewerData<'d> {
        let points = || self.points.iter();
        ViewerData {
            version: VERSION,
            units: match self.units {
                Units::Inch => "inch",
                Units::Mm => "mm",
            },
            lathe: self.is_lathe(),
            diameter: self.view.has_diameters(),
            tools: self
                .tools
                .iter()
                .map(|tool| ToolData {
                    number: tool.number,
                    name: tool.number.and_then(names.tool),
                    color: tool.color,
                    diameter: tool.diameter.map(|diameter| diameter.0),
                })
                .collect(),
            files: &self.files,
            count: self.points.len(),
            points: differences(points().map(|point| point.at.map(f64::from)), LENGTH_STEP),
            seconds: differences(points().map(|point| [f64::from(point.seconds)]), TIME_STEP),
            lines: differences(points().map(|point| [f64::from(point.line)]), 1.0),
            kinds: runs(points().map(|point| kind_number(point.kind))),
            tool_of: runs(points().map(|point| point.tool.into())),
            file_of: (self.files.len() > 1).then(|| runs(points().map(|point| point.file.into()))),
            drive_of: runs(points().map(|point| point.drive)),
            drives: self.drives.iter().map(drive_data).collect(),
            call_of: (self.calls.len() > 1).then(|| runs(points().map(|point| point.call))),
            calls: &self.calls,
            rotary: self.rotary_data(),
            headings: self.heading_data(headings),
            changes: &self.changes,
            thinned: self.thinned.is_some(),
            cut: self.cut,
            all: self.all,
            alarms: self
                .alarms
                .iter()
                .map(|alarm| AlarmData { file: alarm.file, line: alarm.line, at: alarm.at })
                .collect(),
            zeros: self
                .zeros
                .iter()
                .map(|(number, at)| ZeroData { name: names.offset(Some(*number)), at: *at })
                .collect(),
            travel: self.travel,
        }
    }
}

impl Drawing {
    /// The axes that turn, with their angles.
    fn rotary_data(&self) -> Option<RotaryData> {
        let turning = || "ABC".chars().zip(self.rotary).enumerate().filter(|(_, (_, turns))| *turns);
        let axes: String = turning().map(|(_, (name, _))| name).collect();
        // One axis after the other: angles change little from point to point.
        let values = turning().flat_map(|(ix, _)| {
            self.points.iter().map(move |point| point.rotary.get(ix).copied().map_or(f64::NAN, f64::from))
        });
        let values = values.map(|angle| [if angle.is_finite() { angle } else { UNKNOWN_ANGLE }]);
        (!axes.is_empty()).then(|| RotaryData { axes, values: differences(values, ANGLE_STEP) })
    }

    fn heading_data<'d>(&self, headings: &[Heading<'d>]) -> Vec<HeadingData<'d>> {
        let known = headings.iter().filter_map(|heading| {
            let file = self.files.iter().position(|file| file == heading.file)?;
            Some(HeadingData { file, line: heading.line, name: heading.name })
        });
        known.collect()
    }
}

fn drive_data(drive: &Drive) -> DriveData {
    let known = |value: f64| value.is_finite().then_some(value);
    DriveData {
        feed: known(drive.feed),
        mode: match drive.mode {
            FeedMode::PerMinute => "minute",
            FeedMode::PerRevolution => "turn",
            FeedMode::InverseTime => "inverse",
        },
        along: known(drive.along),
        rpm: known(drive.rpm),
    }
}

/// The number of a kind in the data.
const fn kind_number(kind: Kind) -> u16 {
    kind as u16
}
