//! Differences of two programs as text and as JSON.
//!
//! Knows: the words of machinists, both programs' texts. Must not know: how differences are found.

use std::fmt::Write as _;
use std::path::Path;

use gcheck_controls::Control;
use gcheck_engine::{Axis, Model, Position, Spindle, Units};
use gcheck_toolpath::{
    Again, Aspect, By, Change, Corner, Difference, Differences, Driven, Feed, Parting, Place, SectionAt,
    SectionChange, Stand, Title, Value,
};
use serde_json::{Value as Json, json};

use super::left_out::NotCompared;
use crate::Problem;
use crate::execution::Prepared;
use crate::reading;

/// Why a run did not come to its end.
#[derive(Debug, Clone)]
pub(in crate::commands) struct Stopped {
    pub(in crate::commands) message: String,
    pub(in crate::commands) problem: Problem,
}

/// Version of the JSON's shape.
const VERSION: u32 = 1;
/// Longer lines are cut.
const SHOWN: usize = 100;
/// Sections without a partner or at other places that text names; further ones are counted.
const SECTIONS: usize = 20;

/// Both programs.
pub(in crate::commands) struct Sides<'s> {
    pub(in crate::commands) prepared: [&'s Prepared; 2],
    /// In which lengths are shown.
    pub(in crate::commands) units: Units,
    /// Millimetres.
    pub(in crate::commands) tolerance: f64,
    pub(in crate::commands) faults: &'s [Option<Stopped>; 2],
    /// Commands that are not compared and that the programs do not have alike.
    pub(in crate::commands) left_out: &'s [NotCompared],
}

impl Sides<'_> {
    pub(in crate::commands) fn text(&self, differences: &Differences) -> String {
        let mut out = String::new();
        for change in differences.sections().iter().take(SECTIONS) {
            // Writing to a string cannot fail.
            let _ = writeln!(out, "{}", self.section(change));
        }
        let more = differences.sections().len().saturating_sub(SECTIONS);
        if more > 0 {
            let _ = writeln!(out, "… and {more} more sections that are added, removed or moved");
        }
        let told = differences.partings().map(|parting| self.parting(&mut out, parting)).count() as u64;
        let more = differences.partings_count().saturating_sub(told);
        if more > 0 {
            let _ = writeln!(out, "… and part {more} more times");
        }
        for aspect in Aspect::ALL {
            let count = differences.count(aspect);
            if count == 0 {
                continue;
            }
            // Writing to a string cannot fail.
            let _ = writeln!(
                out,
                "{}, {}",
                title(aspect),
                if count == 1 { "once".to_owned() } else { format!("{count} times") }
            );
            let kept: Vec<&Difference> =
                differences.kept().iter().filter(|difference| difference.aspect == aspect).collect();
            let more = count - kept.len() as u64;
            for difference in kept {
                self.difference(&mut out, difference);
            }
            if more > 0 {
                let _ = writeln!(out, "  … and {more} more");
            }
            if let Some(corner) = differences.corner.as_ref().filter(|_| aspect == Aspect::Corners) {
                self.corner(&mut out, corner);
            }
        }
        out.push_str(&self.verdict(differences));
        out
    }

    fn verdict(&self, differences: &Differences) -> String {
        let [a, b] = self.prepared.map(|prepared| prepared.shown.as_str());
        let within = format!("within {} mm", self.tolerance);
        let mut out = match (self.faults.iter().any(Option::is_some), &differences.parting) {
            (true, _) => format!("{a} and {b} are compared up to where a run ends before its program\n"),
            (false, Some(_)) => format!("{a} and {b} move differently; {}\n", rest(differences)),
            (false, None) if differences.is_same() => {
                let is_known = !differences.unknown && self.left_out.is_empty();
                let known = if is_known { "" } else { " as far as known" };
                format!("{a} and {b} make the machine do the same{known}, {within}\n")
            }
            (false, None) if differences.sections().is_empty() => {
                format!("{a} and {b} move along the same path, {within}, with differences\n")
            }
            (false, None) => {
                let differs = Aspect::ALL.into_iter().any(|aspect| differences.count(aspect) > 0);
                let same = if differs {
                    format!("move along the same path, {within}, with differences")
                } else {
                    format!("make the machine do the same, {within}")
                };
                format!(
                    "{a} and {b} do not have the same sections in the same order; those that both have {same}\n"
                )
            }
        };
        for line in self.limits(differences) {
            // Writing to a string cannot fail.
            let _ = writeln!(out, "{line}");
        }
        out
    }

    /// What was not compared although it may differ, a line each.
    pub(in crate::commands) fn limits(&self, differences: &Differences) -> Vec<String> {
        let unknown = differences.unknown.then(|| {
            "some cutting moves start or end at unknown coordinates, which were not compared".to_owned()
        });
        let names = || {
            let each = self.left_out.iter().map(|of| {
                let sides = of.sides.iter().zip(&self.prepared).filter_map(|(side, prepared)| {
                    let (count, place) = side.as_ref()?;
                    let at = format!("{}:{}", place.file, place.line);
                    // The file of the place says which program it is, unless it is one that both call.
                    let of = if *place.file == *prepared.shown {
                        String::new()
                    } else {
                        format!(" of {}", prepared.shown)
                    };
                    Some(if *count == 1 {
                        format!("{at}{of}")
                    } else {
                        format!("{count} times from {at}{of} on")
                    })
                });
                format!("{} ({})", of.name, sides.collect::<Vec<_>>().join(", "))
            });
            format!("not compared: {}", each.collect::<Vec<_>>().join(", "))
        };
        let unpaired =
            differences.sections().iter().filter(|of| of.change == Change::Moved { is_compared: false });
        let moved = match unpaired.count() {
            0 => None,
            1 => Some("1 section that moved was not compared".to_owned()),
            count => Some(format!("{count} sections that moved were not compared")),
        };
        unknown.into_iter().chain(moved).chain((!self.left_out.is_empty()).then(names)).collect()
    }

    fn parting(&self, out: &mut String, parting: &Parting) {
        let at = self.point(&parting.at);
        // Writing to a string cannot fail.
        let _ = match parting.within.as_deref() {
            Some([a, b]) => writeln!(out, "{} changed: the paths part at {at}", changed(a, b)),
            None => writeln!(out, "the paths part at {at}"),
        };
        for (side, (place, to)) in [&parting.a, &parting.b].into_iter().zip(&parting.to).enumerate() {
            let words = match (to, self.faults.get(side)) {
                (Some(to), _) => format!("to {}", self.point(to)),
                (None, Some(Some(fault))) => {
                    // The block that the control refuses, and not the last one that moved.
                    let place = fault.problem.place().map(|(file, line, ..)| Place {
                        file: file.into(),
                        line: u32::try_from(line).unwrap_or(u32::MAX),
                    });
                    self.one(out, side, place.as_ref(), &format!("stops: {}", fault.message));
                    continue;
                }
                (None, _) => "has no moves left".to_owned(),
            };
            self.one(out, side, place.as_ref(), &words);
        }
        if let Some(Again { title, a, b }) = &parting.again {
            let from = match title {
                Title::Start => "the first block".to_owned(),
                Title::Tool(Some(tool)) => format!("tool {tool}"),
                Title::Tool(None) => "the next tool change".to_owned(),
                Title::Operation(name) => format!("({name})"),
            };
            // Writing to a string cannot fail.
            let _ = writeln!(
                out,
                "  compared again from {from} on ({}:{}, {}:{})",
                a.file, a.line, b.file, b.line
            );
        }
    }

    /// A section that one of the programs has alone, or at another place.
    fn section(&self, change: &SectionChange) -> String {
        let [a, b] = self.prepared.map(|prepared| prepared.shown.as_str());
        let moved = |of_a: &SectionAt, of_b: &SectionAt| {
            format!(
                "{} moved from place {} ({a}, {}) to place {} ({b}, {})",
                changed(of_a, of_b),
                of_a.place,
                span(of_a),
                of_b.place,
                span(of_b)
            )
        };
        match (&change.a, &change.b) {
            (Some(of_a), Some(of_b)) => moved(of_a, of_b),
            (Some(only), None) => format!("{} is only in {a}, {}", section_name(only), span(only)),
            (None, Some(only)) => format!("{} is only in {b}, {}", section_name(only), span(only)),
            (None, None) => String::new(),
        }
    }

    fn corner(&self, out: &mut String, corner: &Corner) {
        let corners =
            if corner.count == 1 { "1 corner".to_owned() } else { format!("{} corners", corner.count) };
        let at = format!("{} ({}:{})", self.point(&corner.at), corner.a.file, corner.a.line);
        // Writing to a string cannot fail.
        let _ = match corner.off {
            Some(off) => writeln!(
                out,
                "  the paths may differ at {corners}: by up to {} at {at}",
                self.length(off, true)
            ),
            None => writeln!(
                out,
                "  the paths may differ at {corners}, the first at {at}: a program gives no tolerance, so the control decides by how much"
            ),
        };
    }

    fn difference(&self, out: &mut String, difference: &Difference) {
        for (side, (place, value)) in
            [&difference.a, &difference.b].into_iter().zip(&difference.values).enumerate()
        {
            let words = value.as_ref().map_or_else(|| "nothing".to_owned(), |value| self.value(value, side));
            self.one(out, side, place.as_ref(), &words);
        }
    }

    /// One line: place, what happens there, the block.
    fn one(&self, out: &mut String, side: usize, place: Option<&Place>, words: &str) {
        let mark = if side == 0 { '-' } else { '+' };
        // Writing to a string cannot fail.
        let _ = match place {
            Some(place) => {
                let block = self.block(side, place).map_or_else(String::new, |block| format!("   | {block}"));
                writeln!(out, "  {mark} {}:{}  {words}{block}", place.file, place.line)
            }
            None => {
                let shown = self.prepared.get(side).map_or("", |prepared| prepared.shown.as_str());
                writeln!(out, "  {mark} {shown}  {words}")
            }
        };
    }

    /// The text of a line.
    fn block(&self, side: usize, place: &Place) -> Option<String> {
        let prepared = self.prepared.get(side)?;
        let called;
        let text = if *place.file == *prepared.shown {
            prepared.source.text()
        } else {
            called = reading::file(Path::new(&*place.file)).ok()?;
            called.text()
        };
        let line = text.lines().nth(place.line.checked_sub(1)? as usize)?.trim();
        let shown: String = line.chars().take(SHOWN).map(|c| if c.is_control() { ' ' } else { c }).collect();
        Some(shown)
    }

    fn point(&self, point: &Position) -> String {
        let mut words: Vec<String> = Vec::new();
        for axis in Axis::ALL {
            if let Some(value) = point.get(axis) {
                // Axes that the machine may not have are at zero.
                if value.abs() > 0.0 || matches!(axis, Axis::X | Axis::Y | Axis::Z) {
                    words.push(format!(
                        "{}{}",
                        axis.name(),
                        self.length(value, !axis.is_rotary())
                            .trim_end_matches(" mm")
                            .trim_end_matches(" inch")
                    ));
                }
            }
        }
        if words.is_empty() { "an unknown place".to_owned() } else { words.join(" ") }
    }

    fn length(&self, mm: f64, is_length: bool) -> String {
        match self.units {
            Units::Inch if is_length => format!("{} inch", rounded(mm / 25.4, 5)),
            Units::Mm if is_length => format!("{} mm", rounded(mm, 4)),
            _ => rounded(mm, 4),
        }
    }

    fn value(&self, value: &Value, side: usize) -> String {
        let number = |number: Option<u32>, letter: char| match number {
            Some(number) => format!("{letter}{number}"),
            None => format!("{letter} unknown"),
        };
        match value {
            Value::Driven(driven) => match driven {
                Driven::Rapid => "rapid",
                Driven::Feed => "at feed",
                Driven::Probe => "probing",
                Driven::Thread => "threading",
                Driven::Tap => "tapping",
            }
            .to_owned(),
            Value::Feed(None) => "no feed".to_owned(),
            Value::Feed(Some(Feed::PerMinute(feed))) => format!("{}/min", self.length(*feed, true)),
            Value::Feed(Some(Feed::PerTurn(feed))) => format!("{} a turn", self.length(*feed, true)),
            Value::Spindle(direction, speed, surface) => {
                let direction = match direction {
                    Some(Spindle::Clockwise) => "clockwise",
                    Some(Spindle::CounterClockwise) => "counter-clockwise",
                    Some(Spindle::Stopped) => return "spindle stopped".to_owned(),
                    None => "spindle unknown",
                };
                let unit = if surface.is_some() { "m/min" } else { "rpm" };
                let speed = speed.map_or_else(
                    || "unknown speed".to_owned(),
                    |speed| format!("{} {unit}", rounded(speed, 2)),
                );
                let limit = match surface {
                    Some(limit) if limit.is_infinite() => " without a limit".to_owned(),
                    Some(limit) if limit.is_finite() => format!(", at most {} rpm", rounded(*limit, 2)),
                    _ => String::new(),
                };
                format!("{direction}, {speed}{limit}")
            }
            Value::Tool(tool) => number(*tool, 'T'),
            Value::WorkOffset(None) => "work offset unknown".to_owned(),
            Value::WorkOffset(Some(work)) => self.control(side).map_or_else(
                || work.to_string(),
                |control| gcheck_lint::work_offset_name(*work, &Model::new(control)),
            ),
            Value::Zero(work, zero) => {
                let known: Vec<String> = ['X', 'Y', 'Z']
                    .into_iter()
                    .zip(zero)
                    .filter_map(|(axis, at)| Some(format!("{axis}{}", self.length((*at)?, true))))
                    .collect();
                let name = self.value(&Value::WorkOffset(Some(*work)), side);
                if known.is_empty() {
                    format!("{name} as the control has it")
                } else {
                    format!("{name} at {} of the machine", known.join(" "))
                }
            }
            Value::LengthBy(length, None) => format!("H{length} as the control has it"),
            Value::LengthBy(length, Some(by)) => format!("H{length} of {}", self.length(*by, true)),
            Value::Length(Some(0)) => "no tool length".to_owned(),
            Value::Length(length) => number(*length, 'H'),
            Value::Cutter(Some(0)) => "no cutter compensation".to_owned(),
            Value::Cutter(cutter) => number(*cutter, 'D'),
            Value::Coolant(coolant) => {
                let on: Vec<&str> = ["mist", "flood", "through the spindle"]
                    .into_iter()
                    .zip(coolant)
                    .filter(|(_, on)| **on == Some(true))
                    .map(|(name, _)| name)
                    .collect();
                if on.is_empty() { "no coolant".to_owned() } else { on.join(" and ") }
            }
            Value::Corners(corners) => corners.words(self.units),
            Value::Stand(stand) => self.stand(stand),
        }
    }

    fn stand(&self, stand: &Stand) -> String {
        let seconds = |value: f64| if value.is_nan() { "?".to_owned() } else { rounded(value, 3) };
        match stand {
            Stand::Dwell(time) => format!("dwell {} s", seconds(*time)),
            Stand::ToolChange(Some(tool)) => format!("change to T{tool}"),
            Stand::ToolChange(None) => "change to an unknown tool".to_owned(),
            Stand::Stop { optional: true } => "optional stop".to_owned(),
            Stand::Stop { optional: false } => "stop".to_owned(),
            Stand::Pallet => "pallet change".to_owned(),
            Stand::Orient(angle) => format!("spindle turned to {} deg", seconds(*angle)),
            Stand::Chuck(true) => "chuck clamps".to_owned(),
            Stand::Chuck(false) => "chuck opens".to_owned(),
            Stand::Bar(what, Some(by)) => format!("bar {what} {}", self.length(*by, true)),
            Stand::Bar(what, None) => format!("bar {what}"),
            Stand::Pocket(length) => format!("pocket cleared on {}", self.length(*length, true)),
            Stand::Wrap(Some(diameter)) => format!("wrapped around {}", self.length(*diameter, true)),
            Stand::Wrap(None) => "wrapped no longer".to_owned(),
            Stand::Output { index, value } => format!("output {index} set to {value}"),
            Stand::WaitInput(index) => format!("waits for input {index}"),
            Stand::UserCommand(number, [p, q]) => format!("M{number} P{} Q{}", seconds(*p), seconds(*q)),
            Stand::Row(words) => {
                let word = |(letter, number): &(char, f64)| {
                    if number.is_nan() { format!("{letter}?") } else { format!("{letter}{number}") }
                };
                format!("row of data {}", words.iter().map(word).collect::<Vec<_>>().join(" "))
            }
            Stand::End => "program end".to_owned(),
        }
    }

    fn control(&self, side: usize) -> Option<&Control> {
        self.prepared.get(side).map(|prepared| &*prepared.control)
    }

    pub(in crate::commands) fn json(&self, differences: &Differences) -> Json {
        let partings: Vec<Json> = differences.partings().map(|parting| self.parting_json(parting)).collect();
        let corner = differences.corner.as_ref().map(|corner| {
            json!({
                "a": self.place_json(0, Some(&corner.a)), "at": coordinates(&corner.at),
                "off": corner.off, "count": corner.count,
            })
        });
        let side = |side: usize| {
            self.prepared.get(side).map(|prepared| {
                let fault = self.faults.get(side).and_then(Option::as_ref).map(|fault| &fault.message);
                json!({ "file": prepared.shown, "control": prepared.chosen.choice, "fault": fault })
            })
        };
        json!({
            "version": VERSION,
            "same": differences.is_same() && self.faults.iter().all(Option::is_none),
            "tolerance": self.tolerance,
            "unit": "mm",
            "a": side(0), "b": side(1),
            "moves": differences.moves,
            "unknown": differences.unknown,
            "not_compared": self.not_compared_json(),
            "sections_by": differences.by().map(|by| match by {
                By::Tools => "tools",
                By::Operations => "operations",
            }),
            "sections": self.sections_json(differences),
            "parting": partings.first(),
            "partings": partings,
            "partings_count": differences.partings_count(),
            "corner": corner,
            "differences": self.by_aspect_json(differences),
        })
    }

    fn place_json(&self, side: usize, place: Option<&Place>) -> Option<Json> {
        place
            .map(|place| json!({ "file": &*place.file, "line": place.line, "text": self.block(side, place) }))
    }

    /// What differs, by what it is about, with the first places of each.
    fn by_aspect_json(&self, differences: &Differences) -> Vec<Json> {
        let of_aspect = |aspect: Aspect| {
            let kept = differences.kept().iter().filter(|difference| difference.aspect == aspect);
            let first: Vec<Json> = kept
                .map(|difference| {
                    let [of_a, of_b] = &difference.values;
                    let value =
                        |side, value: &Option<Value>| value.as_ref().map(|value| self.value(value, side));
                    json!({
                        "a": self.place_json(0, difference.a.as_ref()),
                        "b": self.place_json(1, difference.b.as_ref()),
                        "value_a": value(0, of_a), "value_b": value(1, of_b),
                    })
                })
                .collect();
            json!({ "aspect": aspect.name(), "count": differences.count(aspect), "first": first })
        };
        Aspect::ALL.into_iter().filter(|aspect| differences.count(*aspect) > 0).map(of_aspect).collect()
    }

    fn section_json(&self, side: usize, at: &SectionAt) -> Json {
        json!({
            "tool": tool_of(&at.title), "name": called(at), "place": at.place,
            "first": self.place_json(side, Some(&at.first)), "last": at.last,
        })
    }

    fn sections_json(&self, differences: &Differences) -> Vec<Json> {
        let side = |index, at: &Option<SectionAt>| at.as_ref().map(|at| self.section_json(index, at));
        differences
            .sections()
            .iter()
            .map(|of| {
                json!({
                    "change": of.change.name(), "a": side(0, &of.a), "b": side(1, &of.b),
                    "compared": of.change == Change::Moved { is_compared: true },
                })
            })
            .collect()
    }

    fn parting_json(&self, parting: &Parting) -> Json {
        let [to_a, to_b] = parting.to.map(|to| to.map(|to| coordinates(&to)));
        json!({
            "a": self.place_json(0, parting.a.as_ref()), "b": self.place_json(1, parting.b.as_ref()),
            "at": coordinates(&parting.at), "to_a": to_a, "to_b": to_b,
            "apart": Some(parting.apart).filter(|apart| apart.is_finite()),
            "section": parting.within.as_deref().map(|[a, b]| {
                json!({ "a": self.section_json(0, a), "b": self.section_json(1, b) })
            }),
            "again": parting.again.as_ref().map(|again| {
                json!({
                    "tool": tool_of(&again.title),
                    "a": self.place_json(0, Some(&again.a)), "b": self.place_json(1, Some(&again.b)),
                })
            }),
        })
    }

    fn not_compared_json(&self) -> Vec<Json> {
        let side = |index: usize, side: &Option<(u64, Place)>| {
            side.as_ref()
                .map(|(count, first)| json!({ "count": count, "first": self.place_json(index, Some(first)) }))
        };
        self.left_out
            .iter()
            .map(|of| {
                let [of_a, of_b] = &of.sides;
                json!({ "code": of.name, "a": side(0, of_a), "b": side(1, of_b) })
            })
            .collect()
    }
}

/// What of two programs is not compared that move differently.
pub(super) const fn rest(differences: &Differences) -> &'static str {
    match differences.by() {
        None => "what follows is not compared",
        Some(By::Tools) => "from there to the next tool change they are not compared",
        Some(By::Operations) => "from there to the next operation they are not compared",
    }
}

/// A section as text calls it at the begin of a line.
fn section_name(at: &SectionAt) -> String {
    match &at.title {
        Title::Start => "what is before the first section".to_owned(),
        Title::Tool(Some(tool)) if at.name.is_empty() => format!("tool section T{tool}"),
        Title::Tool(Some(tool)) => format!("tool section T{tool} ({})", at.name),
        Title::Tool(None) if at.name.is_empty() => "the section of an unknown tool".to_owned(),
        Title::Tool(None) => format!("the section of an unknown tool ({})", at.name),
        Title::Operation(name) => format!("operation ({name})"),
    }
}

/// A section of both programs, by the name of the second where that is another tool.
fn changed(a: &SectionAt, b: &SectionAt) -> String {
    match (&a.title, &b.title) {
        (Title::Tool(was), Title::Tool(Some(is))) if *was != Some(*is) => {
            format!("{}, which is T{is},", section_name(a))
        }
        _ => section_name(a),
    }
}

/// The lines of a section.
fn span(at: &SectionAt) -> String {
    if at.first.line == at.last {
        format!("line {}", at.last)
    } else {
        format!("lines {} to {}", at.first.line, at.last)
    }
}

const fn tool_of(title: &Title) -> Option<u32> {
    match title {
        Title::Tool(tool) => *tool,
        Title::Start | Title::Operation(_) => None,
    }
}

/// What the program calls a section; `None` where it does not.
fn called(at: &SectionAt) -> Option<&str> {
    let name = match &at.title {
        Title::Operation(name) => name,
        Title::Start | Title::Tool(_) => &at.name,
    };
    (!name.is_empty()).then_some(name)
}

fn title(aspect: Aspect) -> &'static str {
    match aspect {
        Aspect::Drive => "the path is the same but driven differently",
        Aspect::Feed => "the feed differs",
        Aspect::Spindle => "the spindle differs",
        Aspect::Tool => "the tool differs",
        Aspect::WorkOffset => "the work offset differs",
        Aspect::Length => "the tool length offset differs",
        Aspect::Cutter => "the cutter offset differs",
        Aspect::Coolant => "coolant differs",
        Aspect::Corners => "how corners are taken differs",
        Aspect::Dwell => "dwells differ",
        Aspect::Stop => "stops differ",
        Aspect::Other => "other commands differ",
    }
}

/// Known coordinates by axis, millimetres and degrees.
fn coordinates(point: &Position) -> Json {
    let known = Axis::ALL.into_iter().filter_map(|axis| {
        let value = point.get(axis)?;
        Some((axis.name().to_string(), json!((value * 1e6).round() / 1e6)))
    });
    Json::Object(known.collect())
}

/// A number without zeros at its end.
fn rounded(value: f64, decimals: usize) -> String {
    let text = format!("{value:.decimals$}");
    let text = if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.') } else { &text };
    if text == "-0" { "0".to_owned() } else { text.to_owned() }
}
