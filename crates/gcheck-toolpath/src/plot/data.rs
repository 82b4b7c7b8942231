//! A drawing as the data that the viewer reads; viewer.js says what is in it.
//!
//! Knows: names and encoding of the fields. Must not know: what the viewer makes of them.

use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use gcheck_engine::Units;
use serde::Serialize;
use serde_json::Value;

use super::drawing::{Drawing, Kind, Point};
use crate::summary::Names;

/// Version of the data's form.
const VERSION: u32 = 1;

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
    thinned: bool,
    cut: Option<[[f64; 3]; 2]>,
    all: Option<[[f64; 3]; 2]>,
    alarms: Vec<AlarmData>,
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
}

impl Drawing {
    /// The drawing for the viewer of `plot/viewer.js`, which says at its top what is in it.
    pub fn to_json(&self, names: &Names<'_>) -> Value {
        // Only maps without string keys cannot be values, and there are none.
        serde_json::to_value(self.viewer_data(names)).unwrap_or_default()
    }

    pub(super) fn viewer_data(&self, names: &Names<'_>) -> ViewerData<'_> {
        let bytes =
            |of: &dyn Fn(&Point) -> u8| STANDARD.encode(self.points.iter().map(of).collect::<Vec<u8>>());
        let words = |of: &dyn Fn(&Point) -> [u8; 4]| {
            STANDARD.encode(self.points.iter().flat_map(of).collect::<Vec<u8>>())
        };
        let mut coordinates = Vec::with_capacity(self.points.len() * 12);
        for value in self.points.iter().flat_map(|point| point.at) {
            coordinates.extend_from_slice(&value.to_le_bytes());
        }
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
                })
                .collect(),
            files: &self.files,
            count: self.points.len(),
            points: STANDARD.encode(coordinates),
            seconds: words(&|point| point.seconds.to_le_bytes()),
            lines: words(&|point| point.line.to_le_bytes()),
            kinds: bytes(&|point: &Point| kind_number(point.kind)),
            tool_of: bytes(&|point| point.tool),
            file_of: (self.files.len() > 1).then(|| bytes(&|point| point.file)),
            thinned: self.thinned.is_some(),
            cut: self.cut,
            all: self.all,
            alarms: self
                .alarms
                .iter()
                .map(|alarm| AlarmData { file: alarm.file, line: alarm.line, at: alarm.at })
                .collect(),
        }
    }
}

/// The number of a kind in the data.
const fn kind_number(kind: Kind) -> u8 {
    kind as u8
}
