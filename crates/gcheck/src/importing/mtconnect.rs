//! MTConnect probe documents: what a machine says of its axes and paths.
//!
//! Knows: the devices part of that standard: components (`Linear`, `Rotary`, `Path`), data items with `Constraints`,
//! `Specification`s with their limits, and units. Must not know: other formats, how TOML is written.

use std::collections::BTreeMap;
use std::ops::Range;

use quick_xml::Reader;
use quick_xml::events::{BytesStart, Event};

use super::sheet::{NO_KEY, Sheet, Value, is_rotary, rounded};
use crate::config::Units;

/// Deeper documents are not of this standard.
const DEEPEST: usize = 100;
/// Characters of a text of the document that messages show.
const LONGEST_SHOWN: usize = 40;
/// Components that describe something that has a key.
const COMPONENTS: [&str; 4] = ["Device", "Linear", "Rotary", "Path"];

/// An element that is open.
#[derive(Debug, Clone, Default)]
struct Element {
    name: String,
    attributes: BTreeMap<String, String>,
    range: Range<usize>,
}

/// Limits that the document gives: a data item with constraints, or a specification.
#[derive(Debug, Clone, Default)]
struct Limits {
    component: Element,
    element: Element,
    least: Option<f64>,
    most: Option<f64>,
    values: Vec<String>,
    /// Limits that are not numbers, with their names.
    odd: Vec<(String, String)>,
}

impl Limits {
    fn of(&self, key: &str) -> &str {
        self.element.attributes.get(key).map_or("", String::as_str)
    }

    fn says_something(&self) -> bool {
        let is_empty = self.values.is_empty() && self.odd.is_empty();
        self.least.is_some() || self.most.is_some() || !is_empty
    }

    /// In words: `X AXIS_FEEDRATE Maximum`.
    fn place(&self, limit: &str) -> String {
        let name = self.component.attributes.get("name").map_or("", String::as_str);
        let words = [name, self.of("type"), self.of("subType"), limit];
        let words: Vec<&str> = words.into_iter().filter(|word| !word.is_empty()).collect();
        words.join(" ")
    }
}

/// Reads a document.
pub(super) fn read(sheet: &mut Sheet<'_>) {
    let Some(document) = document(sheet) else { return };
    if let [_, second, ..] = document.devices.as_slice() {
        let message =
            "the document describes more than one machine; ask the agent for one, by the name of its device";
        return sheet.refuse(&second.range, message);
    }
    if let Some(device) = document.devices.first() {
        if let Some(name) = device.attributes.get("name").filter(|name| !name.is_empty()) {
            sheet.put(
                &["machine", "name"],
                Value::Text(name.clone()),
                &device.range,
                "the name of the device",
            );
        }
    } else {
        return sheet.refuse(&(0..1), "the document describes no machine; ask the agent for `/probe`");
    }
    let modes = document.modes();
    axes(sheet, &document, &modes);
    let spindle_at = document.spindle(&modes);
    let mut choice = Choice::default();
    for limits in &document.limits {
        for (name, text) in &limits.odd {
            let text: String = text.chars().take(LONGEST_SHOWN).collect();
            sheet.leave(&limits.element.range, limits.place(name), format!("`{text}` is not a number"));
        }
        take(sheet, limits, spindle_at, &modes, &mut choice);
    }
    choice.put(sheet);
}

/// What limits of the document become values of the same key.
#[derive(Debug, Default)]
struct Choice<'d> {
    order: Vec<Vec<String>>,
    by_key: BTreeMap<Vec<String>, Vec<Candidate<'d>>>,
}

#[derive(Debug)]
struct Candidate<'d> {
    /// The lowest is the clearest.
    rank: usize,
    value: Value,
    /// The unit of its lengths.
    units: Option<Units>,
    limits: &'d Limits,
    place: String,
}

impl<'d> Choice<'d> {
    fn add(&mut self, key: &[&str], candidate: Candidate<'d>) {
        let key: Vec<String> = key.iter().map(ToString::to_string).collect();
        if !self.by_key.contains_key(&key) {
            self.order.push(key.clone());
        }
        self.by_key.entry(key).or_default().push(candidate);
    }

    /// Writes the clearest of each key. Two that are as clear and differ are both left out.
    fn put(self, sheet: &mut Sheet<'_>) {
        let Self { order, mut by_key } = self;
        for key in order {
            let mut candidates = by_key.remove(&key).unwrap_or_default();
            candidates.sort_by_key(|candidate| candidate.rank);
            let Some((best, others)) = candidates.split_first() else { continue };
            let line = sheet.line(best.limits.element.range.start);
            let differs = |other: &&Candidate<'_>| other.value != best.value || other.units != best.units;
            let is_rival = |other: &&Candidate<'_>| other.rank == best.rank && differs(other);
            if let Some(rival) = others.iter().find(is_rival) {
                let why = format!("line {line} gives another limit of the same kind, so neither is written");
                sheet.leave(&rival.limits.element.range, rival.place.clone(), why);
                continue;
            }
            for other in others.iter().filter(differs) {
                let why = format!("the limit in line {line} is the clearer one");
                sheet.leave(&other.limits.element.range, other.place.clone(), why);
            }
            let range = best.limits.element.range.clone();
            if let Some(units) = best.units {
                sheet.put_units(units, &range);
            }
            let key: Vec<&str> = key.iter().map(String::as_str).collect();
            sheet.put(&key, best.value.clone(), &range, &best.place);
        }
    }
}

/// Values of `subType` by type, the one that tells most of the machine first; an empty one is that of items without it. Others
/// have no key: a programmed feed limits no rapid, and a rapid no feed.
fn sub_types(kind: &str) -> &'static [&'static str] {
    match kind {
        "POSITION" | "ANGLE" => &["", "ACTUAL", "COMMANDED", "PROGRAMMED"],
        "AXIS_FEEDRATE" | "ANGULAR_VELOCITY" => &["RAPID", "", "ACTUAL", "COMMANDED"],
        "PATH_FEEDRATE" => &["PROGRAMMED", "COMMANDED", "", "ACTUAL"],
        _ => &["", "PROGRAMMED", "COMMANDED", "ACTUAL"],
    }
}

struct Document {
    devices: Vec<Element>,
    /// Linear and rotary axes.
    axes: Vec<Element>,
    limits: Vec<Limits>,
}

impl Document {
    /// The spindle that counts: the first whose speed has a limit.
    fn spindle(&self, modes: &Modes<'_>) -> Option<usize> {
        let is_speed = |limits: &&Limits| matches!(limits.of("type"), "ROTARY_VELOCITY" | "SPINDLE_SPEED");
        let mut speeds = self.limits.iter().filter(is_speed).filter(|limits| limits.most.is_some());
        let first =
            speeds.find(|limits| limits.component.name == "Rotary" && is_spindle(&limits.component, modes));
        first.map(|limits| limits.component.range.start)
    }

    /// Modes of rotary components, by where they begin.
    fn modes(&self) -> Modes<'_> {
        let modes = self.limits.iter().filter(|limits| limits.of("type") == "ROTARY_MODE");
        modes.map(|limits| (limits.component.range.start, limits.values.as_slice())).collect()
    }
}

/// Values of `ROTARY_MODE`, by the first byte of the component.
type Modes<'d> = BTreeMap<usize, &'d [String]>;

/// Is a rotary component a spindle and nothing else?
fn is_spindle(axis: &Element, modes: &Modes<'_>) -> bool {
    match modes.get(&axis.range.start) {
        Some(mode) if !mode.is_empty() => mode.iter().all(|value| value == "SPINDLE"),
        _ => letter(axis).is_none_or(|letter| !is_rotary(letter)),
    }
}

/// The axis that a component is, by the letter of its name.
fn letter(axis: &Element) -> Option<char> {
    ["name", "nativeName"].into_iter().find_map(|key| {
        let mut letters = axis.attributes.get(key)?.chars();
        let letter = letters.next()?.to_ascii_uppercase();
        (letters.next().is_none() && "XYZABCUVW".contains(letter)).then_some(letter)
    })
}

fn document(sheet: &mut Sheet<'_>) -> Option<Document> {
    let text = sheet.text;
    let mut reader = Reader::from_str(text);
    let mut found = Document { devices: Vec::new(), axes: Vec::new(), limits: Vec::new() };
    let mut open: Vec<Element> = Vec::new();
    let mut limits: Option<Limits> = None;
    let mut words = String::new();
    loop {
        let begin = position(&reader, text);
        let event = reader.read_event();
        let range = begin..position(&reader, text).max(begin);
        let (start, is_empty) = match event {
            Ok(Event::Start(start)) => (start, false),
            Ok(Event::Empty(start)) => (start, true),
            Ok(Event::Text(part)) => {
                words.push_str(&part);
                continue;
            }
            Ok(Event::End(_)) => {
                let closed = open.pop()?;
                close(&closed, words.trim(), &mut limits, &mut found);
                words.clear();
                continue;
            }
            Ok(Event::Eof) if open.is_empty() => return Some(found),
            Ok(Event::Eof) => {
                sheet.refuse(
                    &(text.len()..text.len()),
                    "the file ends in the middle of its XML; is it cut short?",
                );
                return None;
            }
            Ok(_) => continue,
            Err(error) => {
                sheet.refuse(&range, format!("the XML cannot be read: {error}"));
                return None;
            }
        };
        words.clear();
        let element = match element(&start, range.clone()) {
            Ok(element) => element,
            Err(reason) => {
                sheet.refuse(&range, format!("the attributes of an element cannot be read: {reason}"));
                return None;
            }
        };
        if open.is_empty() && element.name != "MTConnectDevices" {
            let message = format!(
                "the document is `{}`, and a probe is `MTConnectDevices`: ask the agent for `/probe`",
                element.name
            );
            sheet.refuse(&element.range, message);
            return None;
        }
        if open.len() >= DEEPEST {
            sheet.refuse(&element.range, format!("more than {DEEPEST} elements inside each other"));
            return None;
        }
        begin_element(&element, &open, &mut limits, &mut found);
        if is_empty {
            close(&element, "", &mut limits, &mut found);
        } else {
            open.push(element);
        }
    }
}

fn position(reader: &Reader<&[u8]>, text: &str) -> usize {
    usize::try_from(reader.buffer_position()).unwrap_or(usize::MAX).min(text.len())
}

fn element(start: &BytesStart<'_>, range: Range<usize>) -> Result<Element, String> {
    let mut attributes = BTreeMap::new();
    for attribute in start.attributes() {
        let attribute = attribute.map_err(|error| error.to_string())?;
        let value = quick_xml::escape::unescape(&attribute.value).map_err(|error| error.to_string())?;
        attributes.insert(attribute.key.as_ref().to_owned(), value.into_owned());
    }
    Ok(Element { name: start.local_name().as_ref().to_owned(), attributes, range })
}

fn begin_element(element: &Element, open: &[Element], limits: &mut Option<Limits>, found: &mut Document) {
    match element.name.as_str() {
        "Device" => found.devices.push(element.clone()),
        "Linear" | "Rotary" => found.axes.push(element.clone()),
        "DataItem" | "Specification" | "ProcessSpecification" => {
            let component = open.iter().rev().find(|element| COMPONENTS.contains(&element.name.as_str()));
            let component = component.cloned().unwrap_or_default();
            *limits = Some(Limits { component, element: element.clone(), ..Limits::default() });
        }
        _ => {}
    }
}

fn close(closed: &Element, words: &str, limits: &mut Option<Limits>, found: &mut Document) {
    let number = || words.parse::<f64>().ok().filter(|number| number.is_finite());
    if let Some(limits) = limits {
        match closed.name.as_str() {
            "Minimum" => limits.least = number().or(limits.least),
            "Maximum" => limits.most = number().or(limits.most),
            "LowerLimit" => limits.least = limits.least.or(number()),
            "UpperLimit" => limits.most = limits.most.or(number()),
            "Value" => limits.values.push(words.to_owned()),
            _ => {}
        }
        let is_limit = matches!(closed.name.as_str(), "Minimum" | "Maximum" | "LowerLimit" | "UpperLimit");
        if is_limit && number().is_none() {
            limits.odd.push((closed.name.clone(), words.to_owned()));
        }
    }
    if matches!(closed.name.as_str(), "DataItem" | "Specification" | "ProcessSpecification")
        && let Some(limits) = limits.take()
        && limits.says_something()
    {
        found.limits.push(limits);
    }
}

/// The axes of the machine, spindles left out.
fn axes(sheet: &mut Sheet<'_>, document: &Document, modes: &Modes<'_>) {
    let mut names: Vec<String> = Vec::new();
    for axis in &document.axes {
        let is_spindle = axis.name == "Rotary" && is_spindle(axis, modes);
        match letter(axis).filter(|_| !is_spindle).map(String::from) {
            Some(letter) if names.contains(&letter) => {
                sheet.leave(
                    &axis.range,
                    format!("axis {letter}"),
                    "the document has the axis already, and limits are written where both agree",
                );
            }
            Some(letter) => names.push(letter),
            None if is_spindle => {}
            None => {
                let name = axis.attributes.get("name").map_or("", String::as_str);
                let why = "its name is not the letter of an axis";
                sheet.leave(&axis.range, format!("{} `{name}`", axis.name), why);
            }
        }
    }
    if let (Some(first), false) = (document.axes.first(), names.is_empty()) {
        sheet.put(&["machine", "axes"], Value::List(names), &first.range, "its axes");
    }
}

/// Takes what limits say, where there is a key for it.
fn take<'d>(
    sheet: &mut Sheet<'_>,
    limits: &'d Limits,
    spindle_at: Option<usize>,
    modes: &Modes<'_>,
    choice: &mut Choice<'d>,
) {
    let range = &limits.element.range;
    let kind = limits.of("type");
    let axis = letter(&limits.component);
    let name = axis.map(String::from).unwrap_or_default();
    if limits.least.is_none() && limits.most.is_none() {
        if limits.odd.is_empty() {
            sheet.leave(range, limits.place(""), NO_KEY);
        }
        return;
    }
    let Some(rank) = sub_types(kind).iter().position(|sub_type| *sub_type == limits.of("subType")) else {
        return sheet.leave(range, limits.place(""), NO_KEY);
    };
    let (key, found): (&[&str], _) = match (limits.component.name.as_str(), kind, axis) {
        ("Linear", "POSITION", Some(_)) | ("Rotary", "ANGLE", Some(_))
            if limits.of("coordinateSystem") == "WORK" =>
        {
            let why = "travel counts in machine coordinates, and this in those of the work";
            return sheet.leave(range, limits.place(""), why);
        }
        ("Linear", "POSITION", Some(axis)) | ("Rotary", "ANGLE", Some(axis)) => {
            (&["machine", "travel", &name], travel(sheet, limits, axis))
        }
        ("Linear", "AXIS_FEEDRATE", Some(axis)) | ("Rotary", "ANGULAR_VELOCITY", Some(axis)) => {
            (&["machine", "rapid", &name], figure(sheet, limits, axis, &RATES))
        }
        ("Linear", "ACCELERATION", Some(axis)) | ("Rotary", "ANGULAR_ACCELERATION", Some(axis)) => {
            (&["machine", "acceleration", &name], figure(sheet, limits, axis, &ACCELERATIONS))
        }
        ("Path", "PATH_FEEDRATE", _) => (&["machine", "max_feed"], figure(sheet, limits, 'X', &RATES)),
        ("Rotary", "ROTARY_VELOCITY" | "SPINDLE_SPEED", _) if is_spindle(&limits.component, modes) => {
            if spindle_at.is_some_and(|first| first != limits.component.range.start) {
                let why = "the document has a spindle before this one, and that one counts";
                return sheet.leave(range, limits.place("Maximum"), why);
            }
            (&["machine", "max_rpm"], spindle(sheet, limits))
        }
        _ => return sheet.leave(range, limits.place(""), NO_KEY),
    };
    if let Some((value, units, place)) = found {
        choice.add(key, Candidate { rank, value, units, limits, place });
    }
}

/// A value with the unit of its lengths and its place.
type Found = (Value, Option<Units>, String);

fn travel(sheet: &mut Sheet<'_>, limits: &Limits, axis: char) -> Option<Found> {
    let range = &limits.element.range;
    let (Some(least), Some(most)) = (limits.least, limits.most) else {
        sheet.leave(range, limits.place(""), "the other end of travel is missing");
        return None;
    };
    if least >= most {
        let message = format!("{} is {most}, which is not above Minimum ({least})", limits.place("Maximum"));
        sheet.refuse(range, message);
        return None;
    }
    let place = limits.place("Minimum and Maximum");
    let units = match (is_rotary(axis), limits.of("units")) {
        (true, "DEGREE") => return Some((Value::Plain([least, most]), None, place)),
        (false, "MILLIMETER") => Units::Mm,
        (false, "INCH") => Units::Inch,
        (_, other) => {
            sheet.leave(range, place, unit_problem(other));
            return None;
        }
    };
    Some((Value::Ends([least, most]), Some(units), place))
}

fn unit_problem(unit: &str) -> String {
    if unit.is_empty() {
        "it has no `units`".to_owned()
    } else {
        let unit: String = unit.chars().take(LONGEST_SHOWN).collect();
        format!("`{unit}` is not a unit that this limit is read in")
    }
}

/// Units of rates, without the length, and what makes each one a minute.
const RATES: [(&str, f64); 2] = [("/SECOND", 60.0), ("/MINUTE", 1.0)];
/// Units of accelerations, without the length.
const ACCELERATIONS: [(&str, f64); 1] = [("/SECOND^2", 1.0)];

/// The upper limit of a speed or an acceleration, by axis.
fn figure(sheet: &mut Sheet<'_>, limits: &Limits, axis: char, times: &[(&str, f64)]) -> Option<Found> {
    let range = limits.element.range.clone();
    let place = limits.place("Maximum");
    let Some(most) = limits.most else {
        sheet.leave(&range, limits.place(""), "it has no upper limit");
        return None;
    };
    let unit = limits.of("units");
    let lengths: &[(&str, Option<Units>)] = if is_rotary(axis) {
        &[("DEGREE", None)]
    } else {
        &[("MILLIMETER", Some(Units::Mm)), ("INCH", Some(Units::Inch))]
    };
    let known = lengths.iter().find_map(|(length, units)| {
        let rest = unit.strip_prefix(length)?;
        let (_, factor) = times.iter().find(|(time, _)| *time == rest)?;
        Some((*units, *factor))
    });
    let Some((units, factor)) = known else {
        sheet.leave(&range, place, unit_problem(unit));
        return None;
    };
    if most <= 0.0 {
        sheet.refuse(&range, format!("{place} is {most}: it must be greater than zero"));
        return None;
    }
    let place = if factor > 1.0 { format!("{place} * {factor}") } else { place };
    Some((Value::of_axis(axis, rounded(most * factor)), units, place))
}

fn spindle(sheet: &mut Sheet<'_>, limits: &Limits) -> Option<Found> {
    let range = &limits.element.range;
    let place = limits.place("Maximum");
    let Some(most) = limits.most else {
        sheet.leave(range, limits.place(""), "it has no upper limit");
        return None;
    };
    if limits.of("units") != "REVOLUTION/MINUTE" {
        sheet.leave(range, place, unit_problem(limits.of("units")));
        return None;
    }
    if most <= 0.0 {
        sheet.refuse(range, format!("{place} is {most}: it must be greater than zero"));
        return None;
    }
    Some((Value::Number(most), None, place))
}
