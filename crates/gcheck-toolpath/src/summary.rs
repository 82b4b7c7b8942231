//! Statistics as a table for machinists and as JSON.
//!
//! Knows: layout, words, rounding. Must not know: how the figures came about, terminals.

use std::fmt::Write as _;

use gcheck_engine::{Axis, Units};
use gcheck_geometry::{Bounds, Seconds};
use gcheck_planner::Cause;
use serde::Serialize;

use crate::bar::BarFigures;
use crate::corner_mode::CornerMode;
use crate::number::rounded;
use crate::slowest::Place;
use crate::statistics::{Section, Statistics, Unaccounted};
use crate::step::{View, in_units};
use crate::values::Values;

/// Names that only the caller knows.
#[derive(Clone, Copy)]
pub struct Names<'a> {
    /// What a comment of the program calls a tool.
    pub tool: &'a dyn Fn(u32) -> Option<String>,
    /// What the control calls a work coordinate system (`G54`), by its number.
    pub offset: &'a dyn Fn(u16) -> Option<String>,
}

impl std::fmt::Debug for Names<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str("Names")
    }
}

impl Names<'static> {
    /// Nothing has a name.
    pub const NONE: Self = Self { tool: &|_| None, offset: &|_| None };
}

impl Names<'_> {
    pub(crate) fn offset(&self, number: Option<u16>) -> String {
        match number {
            None => "unknown offset".to_owned(),
            Some(number) => (self.offset)(number).unwrap_or_else(|| format!("offset {number}")),
        }
    }
}

/// How long comments of tools may be in the table.
const COMMENT_WIDTH: usize = 28;
/// Places that lose less are not worth a line.
const LEAST_LOSS: Seconds = Seconds(0.05);

impl Statistics {
    /// The figures as text, in the units that most moves were written in.
    pub fn to_text(&self, names: &Names<'_>) -> String {
        let total = self.total();
        let table = Table {
            is_planned: self.is_planned(),
            names,
            view: self.view(),
            units: self.units(),
            total: &total,
        };
        let mut out = String::new();
        table.headline(&mut out);
        if total.moves > 0 || total.tool_changes > 0 {
            let tools: Vec<&Section> = self.tools().collect();
            table.tools(&mut out, &tools);
            table.extents(&mut out, &tools);
        }
        table.slowest(&mut out, self);
        table.bar(&mut out, self.bar());
        table.missing(&mut out);
        list(&mut out, "assumed", &self.assumed());
        out
    }

    /// What the figures rest on, a line each: the last list of the text.
    pub fn assumed(&self) -> Vec<String> {
        let mut lines: Vec<String> = self
            .assumptions()
            .into_iter()
            .map(|assumption| match assumption.key {
                Some(key) => format!("{} (set machine.{key})", assumption.text),
                None => assumption.text,
            })
            .collect();
        let total = self.total();
        if total.estimated > Seconds::ZERO {
            lines.push(format!(
                "{} of cutting are an estimate: pockets that the control clears by a path of its own, by their area",
                clock(total.estimated, false)
            ));
        }
        if total.moves > 0
            && let Some(percent) = self.feed_override()
        {
            lines.push(format!(
                "the feed override is at {percent} %: it does not count for rapid moves, threads and taps"
            ));
        }
        lines
    }

    /// The figures as JSON, in the units that most moves were written in.
    ///
    /// ```text
    /// {"units":"mm","total":{…},"tools":[{"tool":1,"name":…,"line":5,…}],"assumptions":[…]}
    /// ```
    pub fn to_json(&self, names: &Names<'_>) -> serde_json::Value {
        let total = self.total();
        let (view, units) = (self.view(), self.units());
        let figures = |section: &Section| json::Figures::of(section, view, units, names);
        let whole = json::Whole {
            units: match units {
                Units::Inch => "inch",
                Units::Mm => "mm",
            },
            x_is_diameter: view.has_diameters(),
            times: if self.is_planned() { "estimate" } else { "lower-bound" },
            total: figures(&total),
            slowest: self
                .slowest()
                .iter()
                .map(|place| json::Slow {
                    file: self.file(place.file).to_owned(),
                    line: place.lines.0,
                    last_line: place.lines.1,
                    cause: cause(place.cause),
                    lost_seconds: rounded(place.lost.0),
                    seconds: rounded(place.taken.0),
                    moves: place.moves,
                    length: rounded(in_units(Axis::X, place.way, units)),
                })
                .collect(),
            bar: self.bar().is_used().then(|| json::BarJob::of(self.bar(), total.times.total(), units)),
            tools: self
                .tools()
                .map(|section| json::Tool {
                    number: section.tool,
                    name: section.tool.and_then(names.tool),
                    file: &section.file,
                    line: section.line,
                    figures: figures(section),
                })
                .collect(),
            assumptions: self
                .assumptions()
                .into_iter()
                .map(|assumption| json::Assumed { text: assumption.text, key: assumption.key })
                .collect(),
        };
        serde_json::to_value(whole).unwrap_or_default()
    }
}

struct Table<'a> {
    is_planned: bool,
    names: &'a Names<'a>,
    view: View,
    units: Units,
    total: &'a Section,
}

impl Table<'_> {
    fn headline(&self, out: &mut String) {
        let times = &self.total.times;
        let all = times.total();
        let unit = if self.has_hours() { "h" } else { "min" };
        let kind = if self.is_planned { "estimate" } else { "lower bound" };
        let _ = write!(out, "cycle time {} {unit} ({kind})", self.time(all));
        let parts = [
            ("cutting", times.cutting),
            ("rapid", times.rapid),
            ("acceleration", times.acceleration),
            ("data starved", times.starved),
            ("spindle", times.spindle),
            ("auxiliary functions", times.auxiliary),
            ("dwell", times.dwell),
        ];
        for (index, (name, time)) in parts.into_iter().filter(|(_, time)| *time > Seconds::ZERO).enumerate() {
            let _ = write!(out, "{} {name} {}", if index == 0 { ":" } else { "," }, self.time(time));
            if all > Seconds::ZERO && all.is_finite() {
                let _ = write!(out, " ({:.0} %)", time / all * 100.0);
            }
        }
        if self.total.tool_changes > 0 {
            let plural = if self.total.tool_changes == 1 { "" } else { "s" };
            let _ = write!(
                out,
                "; {} tool change{plural} {}",
                self.total.tool_changes,
                self.time(times.tool_change)
            );
        }
        out.push('\n');
    }

    /// Minutes with tenths of a second for short runs, else hours.
    fn time(&self, time: Seconds) -> String {
        clock(time, self.has_hours())
    }

    fn has_hours(&self) -> bool {
        counts_in_hours(self.total.times.total())
    }

    fn tools(&self, out: &mut String, sections: &[&Section]) {
        let unit = match self.units {
            Units::Inch => "inch",
            Units::Mm => "mm",
        };
        let mut rows = Vec::with_capacity(sections.len() + 2);
        rows.push(
            [
                "tool",
                "",
                "time",
                "cutting",
                "rapid",
                "accel",
                "starved",
                "spindle",
                "aux",
                "dwell",
                "change",
                &format!("cut {unit}"),
                &format!("rapid {unit}"),
                "feed",
                "speed",
                "holes",
                "arcs",
            ]
            .map(str::to_owned),
        );
        for section in sections {
            rows.push(self.row(label(section), section.tool.and_then(self.names.tool), section));
        }
        if sections.len() > 1 {
            rows.push(self.row("total".to_owned(), None, self.total));
        }
        out.push('\n');
        // Tool, comment, feed and speed are words; the rest are numbers.
        let mut right = [true; 17];
        for column in [0, 1, 13, 14] {
            if let Some(right) = right.get_mut(column) {
                *right = false;
            }
        }
        columns(out, &rows, &right);
        let lines: Vec<String> = sections.iter().filter_map(|section| self.edge(section)).collect();
        list(out, "chip load and surface speed", &lines);
        let is_told = |section: &&Section| section.corners.iter().any(|mode| *mode != CornerMode::START);
        if sections.iter().any(is_told) {
            let words = |section: &&Section| {
                let modes: Vec<String> = section.corners.iter().map(|mode| mode.words(self.units)).collect();
                (!modes.is_empty()).then(|| format!("{}: {}", label(section), modes.join("; ")))
            };
            let lines: Vec<String> = sections.iter().filter_map(words).collect();
            list(out, "corners", &lines);
        }
    }

    /// What the teeth of a tool cut, and how fast; `None` where nothing of it is known.
    fn edge(&self, section: &Section) -> Option<String> {
        let load = match self.units {
            Units::Inch => range(&section.chip_loads, 1.0 / 25.4, " inch a tooth"),
            Units::Mm => range(&section.chip_loads, 1.0, " mm a tooth"),
        };
        let speed = match self.units {
            Units::Inch => range(&section.edge_speeds, 1.0 / 0.3048, " ft/min"),
            Units::Mm => range(&section.edge_speeds, 1.0, " m/min"),
        };
        let figures: Vec<String> = [load, speed].into_iter().flatten().collect();
        (!figures.is_empty()).then(|| format!("{}: {}", label(section), figures.join(", ")))
    }

    fn row(&self, tool: String, comment: Option<String>, section: &Section) -> [String; 17] {
        let way = |mm: f64| {
            let way = mm / self.units.in_mm();
            if self.units == Units::Inch { format!("{way:.1}") } else { format!("{way:.0}") }
        };
        let count = |number: u64| if number == 0 { String::new() } else { number.to_string() };
        let some = |time: Seconds| if time > Seconds::ZERO { self.time(time) } else { String::new() };
        let comment: String = comment
            .unwrap_or_default()
            .chars()
            .map(|c| if c.is_control() { ' ' } else { c })
            .take(COMMENT_WIDTH)
            .collect();
        [
            tool,
            comment,
            self.time(section.times.total()),
            self.time(section.times.cutting),
            self.time(section.times.rapid),
            some(section.times.acceleration),
            some(section.times.starved),
            some(section.times.spindle),
            some(section.times.auxiliary),
            some(section.times.dwell),
            some(section.times.tool_change),
            way(section.cutting.0),
            way(section.rapid.0),
            self.feeds(section),
            self.speeds(section),
            count(section.holes),
            count(section.arcs),
        ]
    }

    fn feeds(&self, section: &Section) -> String {
        let scale = 1.0 / self.units.in_mm();
        let parts = [
            range(&section.feeds.per_minute, scale, "/min"),
            range(&section.feeds.per_revolution, scale, "/rev"),
            range(&section.feeds.inverse_time, 1.0, " inverse"),
        ];
        parts.into_iter().flatten().collect::<Vec<_>>().join(", ")
    }

    fn speeds(&self, section: &Section) -> String {
        let surface = match self.units {
            Units::Inch => range(&section.surface_speeds, 1.0 / 0.3048, " ft/min"),
            Units::Mm => range(&section.surface_speeds, 1.0, " m/min"),
        };
        [range(&section.speeds, 1.0, " rpm"), surface].into_iter().flatten().collect::<Vec<_>>().join(", ")
    }

    fn extents(&self, out: &mut String, sections: &[&Section]) {
        // Axes that never moved away from one place say nothing, but X, Y and Z are missed when they are not there.
        let shown: Vec<Axis> = self
            .view
            .axes()
            .filter(|axis| {
                let moved = |bounds: &Bounds| bounds.extent(axis.index()).is_some_and(|extent| extent > 0.0);
                !axis.is_rotary() || moved(&self.total.work()) || moved(&self.total.machine)
            })
            .collect();
        let mut rows: Vec<Vec<String>> = Vec::new();
        let mut heading = vec![match (self.units, self.view.has_diameters()) {
            (Units::Inch, false) => "extents, inch".to_owned(),
            (Units::Inch, true) => "extents, inch, X as diameter".to_owned(),
            (Units::Mm, false) => "extents, mm".to_owned(),
            (Units::Mm, true) => "extents, mm, X as diameter".to_owned(),
        }];
        heading.extend(shown.iter().flat_map(|axis| [format!("{} from", axis.name()), "to".to_owned()]));
        rows.push(heading);
        let mut row = |name: String, bounds: &Bounds| {
            if shown.iter().all(|axis| bounds.range(axis.index()).is_none()) {
                return;
            }
            let mut cells = vec![name];
            cells.extend(shown.iter().flat_map(|axis| self.range(*axis, bounds)));
            rows.push(cells);
        };
        for section in sections {
            row(format!("{} cutting", label(section)), &section.cut);
        }
        for used in &self.total.offsets {
            row(format!("{} all moves", self.names.offset(used.number)), &used.extents);
        }
        row("machine, all moves".to_owned(), &self.total.machine);
        if rows.len() > 1 {
            out.push('\n');
            let mut right = vec![true; 1 + 2 * shown.len()];
            if let Some(first) = right.first_mut() {
                *first = false;
            }
            columns(out, &rows, &right);
        }
    }

    fn range(&self, axis: Axis, bounds: &Bounds) -> [String; 2] {
        let Some((low, high)) = bounds.range(axis.index()) else { return ["?".to_owned(), "?".to_owned()] };
        let decimals = if self.units == Units::Inch && !axis.is_rotary() { 4 } else { 3 };
        [low, high].map(|value| {
            let text = format!("{:.decimals$}", self.view.coordinate(axis, value, self.units));
            // A negative zero is a zero to a reader.
            match text.strip_prefix('-') {
                Some(digits) if digits.bytes().all(|byte| matches!(byte, b'0' | b'.')) => digits.to_owned(),
                _ => text,
            }
        })
    }

    /// Where most time is lost.
    fn slowest(&self, out: &mut String, statistics: &Statistics) {
        let several = statistics.slowest().iter().any(|place| place.file > 0);
        let lines: Vec<String> = statistics
            .slowest()
            .iter()
            .filter(|place| place.lost >= LEAST_LOSS)
            .map(|place| {
                let (first, last) = place.lines;
                let mut text =
                    if first == last { format!("line {first}") } else { format!("lines {first} to {last}") };
                if several {
                    let _ = write!(text, " of {}", statistics.file(place.file));
                }
                let _ = write!(
                    text,
                    ": {} of {} lost, {}",
                    clock(place.lost, false),
                    clock(place.taken, false),
                    because(place, statistics.block_time())
                );
                #[expect(clippy::cast_precision_loss, reason = "far fewer moves than 2^53")]
                if place.moves > 1 {
                    let way = place.way / place.moves as f64;
                    let unit = if self.units == Units::Inch { "inch" } else { "mm" };
                    let way = plain(in_units(Axis::X, way, self.units));
                    let _ = write!(text, "; {} moves of {way} {unit} on the average", place.moves);
                }
                text
            })
            .collect();
        list(out, "slowest places", &lines);
    }

    /// Parts, bars and what is left of them.
    fn bar(&self, out: &mut String, bar: &BarFigures) {
        if !bar.is_used() {
            return;
        }
        let count =
            |number: u64, what: &str| format!("{number} {what}{}", if number == 1 { "" } else { "s" });
        let unit = match self.units {
            Units::Inch => "inch",
            Units::Mm => "mm",
        };
        let length = |mm: f64| plain(mm / self.units.in_mm());
        let mut lines = Vec::new();
        let mut made = count(bar.parts(), "part");
        if bar.used_up() > 0 {
            let _ = write!(made, " from {}", count(bar.used_up(), "bar"));
            let (fewest, most) = (bar.by_bar().iter().min(), bar.by_bar().iter().max());
            if let (Some(fewest), Some(most)) = (fewest, most) {
                let _ = if fewest == most {
                    write!(made, ", {most} a bar")
                } else {
                    write!(made, ", {fewest} to {most} a bar")
                };
            }
        }
        lines.push(made);
        lines.push(if bar.pushed().is_known() {
            format!("bar pushed {} {unit}", length(bar.pushed().0))
        } else {
            "bar pushed by lengths that are not known".to_owned()
        });
        if let Some((low, high)) = bar.remnants().range() {
            let [low, high] = [low, high].map(length);
            let left = if low == high { low } else { format!("{low} to {high}") };
            lines.push(format!("{left} {unit} left of a bar, behind the face of the chuck"));
        }
        if let Some(time) = per_part(bar, self.total.times.total()) {
            let unit = if self.has_hours() { "h" } else { "min" };
            lines.push(format!("{} {unit} a part, without what the feeder takes", self.time(time)));
        }
        list(out, "bar feeder", &lines);
    }

    fn missing(&self, out: &mut String) {
        let Unaccounted { points, feeds, speeds, partly, dwells, arcs_by_ends, machine, pockets } =
            self.total.unaccounted;
        let moves = |count: u64| if count == 1 { "1 move".to_owned() } else { format!("{count} moves") };
        let mut lines = Vec::new();
        if points > 0 {
            lines.push(format!("{} from or to an unknown point: not in distance or time", moves(points)));
        }
        if feeds > 0 {
            lines.push(format!("{} without a feed: not in time", moves(feeds)));
        }
        if speeds > 0 {
            lines.push(format!("{} at an unknown spindle speed or at none: not in time", moves(speeds)));
        }
        if dwells > 0 {
            let plural = if dwells == 1 { "" } else { "s" };
            lines.push(format!("{dwells} dwell{plural} of unknown length: not in time"));
        }
        if pockets > 0 {
            let plural = if pockets == 1 { "" } else { "s" };
            lines.push(format!(
                "{pockets} pocket{plural} cleared with an unknown tool or feed: not in distance, time or extents"
            ));
        }
        if partly > 0 {
            lines.push(format!("{} while an axis is at an unknown place: counted without it", moves(partly)));
        }
        if machine > 0 && machine == self.total.moves {
            lines.push(
                "machine coordinates: the start, work offsets or tool lengths are not known".to_owned(),
            );
        } else if machine > 0 {
            lines.push(format!("machine coordinates of {}", moves(machine)));
        }
        if arcs_by_ends > 0 {
            let arcs = if arcs_by_ends == 1 { "1 arc".to_owned() } else { format!("{arcs_by_ends} arcs") };
            lines.push(format!("machine coordinates of {arcs} between the ends"));
        }
        list(out, "missing in these figures", &lines);
    }
}

/// Why time is lost at a place.
fn because(place: &Place, block_time: Seconds) -> String {
    match place.cause {
        Cause::Starved => {
            #[expect(clippy::cast_precision_loss, reason = "far fewer moves than 2^53")]
            let asked = place.moves as f64 / (place.taken - place.lost).0;
            format!("data starved: {asked:.0} blocks/s, and the control prepares {:.0}", 1.0 / block_time.0)
        }
        Cause::Axis => "an axis is slower than the feed".to_owned(),
        Cause::Turn => "arcs too tight for the feed".to_owned(),
        Cause::Stop => "the axes stop after each move".to_owned(),
        Cause::Corner => "corners, and moves too short for the feed".to_owned(),
        Cause::Spindle => "the spindle is waited for".to_owned(),
        Cause::None => String::new(),
    }
}

/// The cause, for other programs.
const fn cause(cause: Cause) -> &'static str {
    match cause {
        Cause::None => "none",
        Cause::Starved => "data-starved",
        Cause::Axis => "axis-speed",
        Cause::Turn => "tight-arc",
        Cause::Stop => "stop",
        Cause::Corner => "corner",
        Cause::Spindle => "spindle",
    }
}

fn per_part(bar: &BarFigures, time: Seconds) -> Option<Seconds> {
    #[expect(clippy::cast_precision_loss, reason = "far fewer parts than 2^53")]
    let parts = bar.parts() as f64;
    (parts > 0.0).then(|| Seconds(time.0 / parts))
}

fn list(out: &mut String, title: &str, lines: &[String]) {
    if lines.is_empty() {
        return;
    }
    let _ = write!(out, "\n{title}\n");
    for line in lines {
        let _ = writeln!(out, "  {line}");
    }
}

fn label(section: &Section) -> String {
    match section.tool {
        Some(0) => "no tool".to_owned(),
        Some(tool) => format!("T{tool}"),
        None => "T?".to_owned(),
    }
}

/// `800/min`, `120-800/min`.
fn range(values: &Values, scale: f64, unit: &str) -> Option<String> {
    let (low, high) = values.range()?;
    let [low, high] = [low, high].map(|value| plain(value * scale));
    Some(if low == high { format!("{low}{unit}") } else { format!("{low}-{high}{unit}") })
}

/// Without digits that nobody programmed.
fn plain(value: f64) -> String {
    let text = format!("{value:.4}");
    text.trim_end_matches('0').trim_end_matches('.').to_owned()
}

/// Is a time of the length that is told in hours?
pub fn counts_in_hours(time: Seconds) -> bool {
    time >= Seconds(600.0)
}

/// `1:23.4`, or `0:01:23` in hours.
pub fn clock(time: Seconds, hours: bool) -> String {
    let seconds = time.0.max(0.0);
    #[expect(clippy::cast_sign_loss, reason = "not negative")]
    if hours {
        let whole = seconds.round() as u64;
        format!("{}:{:02}:{:02}", whole / 3600, whole / 60 % 60, whole % 60)
    } else {
        let tenths = (seconds * 10.0).round() as u64;
        format!("{}:{:02}.{}", tenths / 600, tenths / 10 % 60, tenths % 10)
    }
}

/// Rows in columns as wide as they have to be; empty columns are left out.
fn columns<R: AsRef<[String]>>(out: &mut String, rows: &[R], right: &[bool]) {
    let widths: Vec<usize> = (0..right.len())
        .map(|column| {
            let cells = || rows.iter().filter_map(|row| row.as_ref().get(column));
            // A column with nothing below its heading says nothing.
            if cells().skip(1).all(String::is_empty) {
                return 0;
            }
            cells().map(|cell| cell.chars().count()).max().unwrap_or(0)
        })
        .collect();
    for row in rows {
        let mut line = String::new();
        for ((cell, width), right) in row.as_ref().iter().zip(&widths).zip(right) {
            if *width == 0 {
                continue;
            }
            if !line.is_empty() {
                line.push_str("  ");
            }
            let _ = if *right { write!(line, "{cell:>width$}") } else { write!(line, "{cell:<width$}") };
        }
        out.push_str(line.trim_end());
        out.push('\n');
    }
}

/// The shape of the JSON.
mod json {
    use std::collections::BTreeMap;

    use super::{
        Axis, BarFigures, Bounds, Names, Seconds, Section, Serialize, Units, Values, View, in_units, rounded,
    };

    #[derive(Serialize)]
    pub(super) struct Whole<'a> {
        pub(super) units: &'static str,
        pub(super) x_is_diameter: bool,
        /// `estimate`, or `lower-bound` where the acceleration of the machine is not known.
        pub(super) times: &'static str,
        pub(super) total: Figures,
        /// Where most time is lost, the worst first; empty for a lower bound.
        pub(super) slowest: Vec<Slow>,
        /// Only with a bar feeder.
        #[serde(skip_serializing_if = "Option::is_none")]
        pub(super) bar: Option<BarJob>,
        pub(super) tools: Vec<Tool<'a>>,
        pub(super) assumptions: Vec<Assumed>,
    }

    #[derive(Serialize)]
    pub(super) struct Slow {
        pub(super) file: String,
        pub(super) line: u32,
        pub(super) last_line: u32,
        pub(super) cause: &'static str,
        /// Beyond what the same moves take at the speed that was asked for.
        pub(super) lost_seconds: Option<f64>,
        pub(super) seconds: Option<f64>,
        pub(super) moves: u64,
        /// Way of these moves.
        pub(super) length: Option<f64>,
    }

    #[derive(Serialize)]
    pub(super) struct BarJob {
        parts: u64,
        bars_used_up: u64,
        parts_by_bar: Vec<u64>,
        pushed: Option<f64>,
        /// What was left of bars behind the face of the chuck.
        remnant: Option<Range>,
        seconds_per_part: Option<f64>,
    }

    impl BarJob {
        pub(super) fn of(bar: &BarFigures, time: Seconds, units: Units) -> Self {
            Self {
                parts: bar.parts(),
                bars_used_up: bar.used_up(),
                parts_by_bar: bar.by_bar().to_vec(),
                pushed: rounded(in_units(Axis::X, bar.pushed().0, units)),
                remnant: range(bar.remnants(), 1.0 / units.in_mm()),
                seconds_per_part: super::per_part(bar, time).and_then(|time| rounded(time.0)),
            }
        }
    }

    #[derive(Serialize)]
    pub(super) struct Assumed {
        pub(super) text: String,
        pub(super) key: Option<&'static str>,
    }

    #[derive(Serialize)]
    pub(super) struct Tool<'a> {
        #[serde(rename = "tool")]
        pub(super) number: Option<u32>,
        pub(super) name: Option<String>,
        pub(super) file: &'a str,
        pub(super) line: u32,
        #[serde(flatten)]
        pub(super) figures: Figures,
    }

    #[derive(Serialize)]
    pub(super) struct Figures {
        seconds: Times,
        distance: Ways,
        moves: u64,
        arcs: u64,
        holes: u64,
        probes: u64,
        tool_changes: u64,
        feeds: Feeds,
        speeds: Speeds,
        edge: Edge,
        /// How corners were taken while cutting, in words.
        corners: Vec<String>,
        offsets: Vec<Offset>,
        extents: Extents,
        unaccounted: Unaccounted,
    }

    #[derive(Serialize)]
    struct Times {
        total: Option<f64>,
        cutting: Option<f64>,
        rapid: Option<f64>,
        /// Speeding up, slowing down, corners.
        acceleration: Option<f64>,
        /// Waiting for blocks that the control has not prepared yet.
        starved: Option<f64>,
        /// Waiting for the spindle.
        spindle: Option<f64>,
        auxiliary: Option<f64>,
        dwell: Option<f64>,
        tool_change: Option<f64>,
        /// The part of `cutting` that is an estimate: pockets that the control clears by a path of its own.
        estimated: Option<f64>,
    }

    #[derive(Serialize)]
    struct Ways {
        cutting: Option<f64>,
        rapid: Option<f64>,
        /// Degrees where only rotary axes moved.
        rotary_deg: Option<f64>,
    }

    #[derive(Serialize)]
    struct Range {
        min: Option<f64>,
        max: Option<f64>,
        values: Vec<Option<f64>>,
        /// There were more values than are listed.
        more: bool,
    }

    #[derive(Serialize)]
    struct Feeds {
        per_minute: Option<Range>,
        per_rev: Option<Range>,
        inverse_time: Option<Range>,
    }

    #[derive(Serialize)]
    struct Speeds {
        rpm: Option<Range>,
        metres_per_minute: Option<Range>,
    }

    /// What the teeth of the tool do, where the configuration tells how it cuts.
    #[derive(Serialize)]
    struct Edge {
        /// A tooth, in the unit of the output.
        chip_load: Option<Range>,
        metres_per_minute: Option<Range>,
    }

    type Box = BTreeMap<char, [Option<f64>; 2]>;

    #[derive(Serialize)]
    struct Offset {
        number: Option<u16>,
        name: String,
        extents: Box,
    }

    #[derive(Serialize)]
    struct Extents {
        cutting: Box,
        machine: Box,
    }

    #[derive(Serialize)]
    struct Unaccounted {
        unknown_point: u64,
        no_feed: u64,
        no_speed: u64,
        unknown_dwell: u64,
        partly: u64,
        machine: u64,
        machine_arcs: u64,
        pockets: u64,
    }

    impl Figures {
        pub(super) fn of(section: &Section, view: View, units: Units, names: &Names<'_>) -> Self {
            let length = |mm: f64| rounded(in_units(Axis::X, mm, units));
            let scale = 1.0 / units.in_mm();
            let extents = |bounds: &Bounds| {
                view.axes()
                    .filter_map(|axis| {
                        let (low, high) = bounds.range(axis.index())?;
                        Some((
                            axis.name(),
                            [low, high].map(|value| rounded(view.coordinate(axis, value, units))),
                        ))
                    })
                    .collect()
            };
            let missing = section.unaccounted;
            Self {
                seconds: Times {
                    total: rounded(section.times.total().0),
                    cutting: rounded(section.times.cutting.0),
                    rapid: rounded(section.times.rapid.0),
                    acceleration: rounded(section.times.acceleration.0),
                    starved: rounded(section.times.starved.0),
                    spindle: rounded(section.times.spindle.0),
                    auxiliary: rounded(section.times.auxiliary.0),
                    dwell: rounded(section.times.dwell.0),
                    tool_change: rounded(section.times.tool_change.0),
                    estimated: rounded(section.estimated.0),
                },
                distance: Ways {
                    cutting: length(section.cutting.0),
                    rapid: length(section.rapid.0),
                    rotary_deg: rounded(section.turned.0),
                },
                moves: section.moves,
                arcs: section.arcs,
                holes: section.holes,
                probes: section.probes,
                tool_changes: section.tool_changes,
                feeds: Feeds {
                    per_minute: range(&section.feeds.per_minute, scale),
                    per_rev: range(&section.feeds.per_revolution, scale),
                    inverse_time: range(&section.feeds.inverse_time, 1.0),
                },
                speeds: Speeds {
                    rpm: range(&section.speeds, 1.0),
                    metres_per_minute: range(&section.surface_speeds, 1.0),
                },
                edge: Edge {
                    chip_load: range(&section.chip_loads, scale),
                    metres_per_minute: range(&section.edge_speeds, 1.0),
                },
                corners: section.corners.iter().map(|mode| mode.words(units)).collect(),
                offsets: section
                    .offsets
                    .iter()
                    .map(|used| Offset {
                        number: used.number,
                        name: names.offset(used.number),
                        extents: extents(&used.extents),
                    })
                    .collect(),
                extents: Extents { cutting: extents(&section.cut), machine: extents(&section.machine) },
                unaccounted: Unaccounted {
                    unknown_point: missing.points,
                    no_feed: missing.feeds,
                    no_speed: missing.speeds,
                    unknown_dwell: missing.dwells,
                    partly: missing.partly,
                    machine: missing.machine,
                    machine_arcs: missing.arcs_by_ends,
                    pockets: missing.pockets,
                },
            }
        }
    }

    fn range(values: &Values, scale: f64) -> Option<Range> {
        let (low, high) = values.range()?;
        Some(Range {
            min: rounded(low * scale),
            max: rounded(high * scale),
            values: values.distinct().iter().map(|value| rounded(value * scale)).collect(),
            more: values.has_more(),
        })
    }
}

#[cfg(test)]
mod tests {
    use gcheck_geometry::Seconds;

    use super::{clock, counts_in_hours};

    #[test]
    fn times_read_as_on_a_clock() {
        for (seconds, expected) in
            [(0.0, "0:00.0"), (31.26, "0:31.3"), (59.96, "1:00.0"), (125.0, "2:05.0"), (8_399.0, "2:19:59")]
        {
            let time = Seconds(seconds);
            assert_eq!(clock(time, counts_in_hours(time)), expected);
        }
    }
}
