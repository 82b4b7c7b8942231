//! Offsets that a control wrote as a program: blocks of `G10`.
//!
//! Knows: that the program is executed under the configuration that is written, and where the state at its end has offsets and
//! tools. Must not know: what the forms of `G10` mean on a control.

use std::collections::BTreeMap;
use std::ops::Range;
use std::path::Path;

use gcheck_controls::Effect;
use gcheck_engine::{
    Axis, Concrete, Ending, Observer, Options, Origin, Position, RunResult, State, Stopped, WorkOffset,
};
use gcheck_report::ControlSource;

use super::request::Request;
use super::sheet::{Lines, Sheet, Tells, Value, rounded};
use super::unread::Reader;
use crate::Problem;
use crate::args::{BlockSkip, Conditions, ExecutionOptions, FUEL, Global, Switch, When};
use crate::config::Units;
use crate::execution::{self, Prepared, Rests, Session};

/// Numbers of work offsets and tools that are looked at: more than any control has.
const WORK_OFFSETS: u16 = 500;
const TOOLS: u32 = 10_000;
/// Blocks that are looked at for the place of what they write.
const MOST_WRITERS: usize = 20_000;

/// Does a text write offsets?
pub(super) fn is_one(text: &str) -> bool {
    let upper = text.to_ascii_uppercase();
    upper.match_indices("G10").any(|(at, word)| {
        let next = upper.get(at + word.len()..).and_then(|rest| rest.chars().next());
        !next.is_some_and(|next| next.is_ascii_digit() || next == '.')
    })
}

/// Sees which block writes which offset last.
struct Writers<'s> {
    text: &'s str,
    /// Work offsets that have a name.
    numbers: Vec<u16>,
    /// As they were before the block.
    offsets: Vec<WorkOffset>,
    /// The tool of the block, and its sizes before.
    tool: Option<(u32, [u64; 3])>,
    /// First byte of the last block that writes a work offset, a size of a tool.
    of_offset: BTreeMap<u16, usize>,
    of_tool: BTreeMap<(u32, usize), usize>,
    looked: usize,
    /// What the blocks say that is not known.
    reader: Reader<'s>,
}

impl<'s> Writers<'s> {
    fn new(text: &'s str, numbers: Vec<u16>, reader: Reader<'s>) -> Self {
        let (of_offset, of_tool) = (BTreeMap::new(), BTreeMap::new());
        Self { text, numbers, offsets: Vec::new(), tool: None, of_offset, of_tool, looked: 0, reader }
    }

    /// The block, if it is one of the file that may write an offset.
    fn block(&mut self, origin: Origin) -> Option<&'s str> {
        let block = self.text.get(origin.start as usize..origin.end as usize)?;
        let is_writer = origin.at.file == 0 && is_one(block) && self.looked < MOST_WRITERS;
        is_writer.then_some(block)
    }
}

impl Observer<Concrete> for Writers<'_> {
    fn before(&mut self, origin: Origin, state: &State<Concrete>) {
        if let Some(block) = self.block(origin) {
            self.tool = tool_of(block).map(|number| (number, sizes(state, number).map(f64::to_bits)));
            self.offsets = self.numbers.iter().map(|number| state.tables().offset(*number)).collect();
            self.reader.look(origin, state);
        }
    }

    fn after(&mut self, origin: Origin, state: &State<Concrete>) {
        if self.block(origin).is_none() {
            return;
        }
        self.looked += 1;
        let start = origin.start as usize;
        for (number, before) in self.numbers.iter().zip(&self.offsets) {
            if !is_same(&state.tables().offset(*number), before) {
                self.of_offset.insert(*number, start);
            }
        }
        if let Some((number, before)) = self.tool {
            let after = sizes(state, number).map(f64::to_bits);
            for (ix, _) in
                before.iter().zip(after).enumerate().filter(|(_, (before, after))| *before != after)
            {
                self.of_tool.insert((number, ix), start);
            }
        }
    }
}

/// The tool that a block names: the number of `P`, or its last digits.
fn tool_of(block: &str) -> Option<u32> {
    let upper = block.to_ascii_uppercase();
    let (_, rest) = upper.split_once('P')?;
    let digits = rest.trim_start().split(|c: char| !c.is_ascii_digit()).next()?;
    digits.parse::<u32>().ok().map(|number| number % TOOLS)
}

/// Sizes of a tool with a key, in millimetres.
const SIZES: [&str; 3] = ["length", "diameter", "corner_radius"];

/// Those sizes; NaN where one is not known.
fn sizes(state: &State<Concrete>, number: u32) -> [f64; 3] {
    let tool = state.tables().tool(number);
    tool.map_or([f64::NAN; 3], |tool| [tool.length().raw(Axis::Z), tool.size().0, tool.corner_radius.0])
}

/// Where values are in the file.
struct Places {
    of_offset: BTreeMap<u16, Range<usize>>,
    of_tool: BTreeMap<(u32, usize), Range<usize>>,
    /// The first block that writes an offset, for what has no place of its own.
    first: Range<usize>,
}

impl Places {
    /// The program may have other bytes than the sheet, and has the same lines.
    fn new(sheet: &Sheet<'_>, text: &str, writers: &Writers<'_>) -> Self {
        let lines = Lines::new(text);
        let range = |start: usize| sheet.range_of_line(lines.line(start));
        let first =
            writers.of_offset.values().chain(writers.of_tool.values()).min().map_or(0..0, |at| range(*at));
        Self {
            of_offset: writers.of_offset.iter().map(|(number, at)| (*number, range(*at))).collect(),
            of_tool: writers.of_tool.iter().map(|(number, at)| (*number, range(*at))).collect(),
            first,
        }
    }

    fn offset(&self, number: u16) -> &Range<usize> {
        self.of_offset.get(&number).unwrap_or(&self.first)
    }

    fn tool(&self, number: u32, size: usize) -> &Range<usize> {
        self.of_tool.get(&(number, size)).unwrap_or(&self.first)
    }
}

/// Executes the program and takes what it wrote.
pub(super) fn read(sheet: &mut Sheet<'_>, path: &Path, request: Request<'_>) {
    let units = sheet.asked.map(|units| format!("machine.units=\"{}\"", super::sheet::unit_name(units)));
    let global = Global {
        control: request.control.map(str::to_owned),
        config: request.config.iter().cloned().chain(units).collect(),
        isolated: !request.has_file,
        color: When::Never,
        quiet: true,
    };
    let options = ExecutionOptions {
        file: path.to_owned(),
        conditions: Conditions {
            stdin_filename: None,
            set: Vec::new(),
            block_skip: BlockSkip(0),
            optional_stop: Switch::Off,
            fuel: FUEL,
        },
    };
    let mut prepared = match execution::prepare(&global, &options, execution::Start::Any) {
        Ok(prepared) => prepared,
        Err(problem) => return sheet.problems.push(problem),
    };
    if prepared.chosen.choice.source == ControlSource::Default {
        let problem =
            Problem::with_file(path, "does not show for which control it is, and forms of `G10` differ")
                .help("name the control: `--control NAME`; `gcheck controls` lists them");
        return sheet.problems.push(problem);
    }
    // What is configured is not what the file says.
    let machine = &mut prepared.equipment.machine;
    machine.offsets.clear();
    machine.tools.clear();
    machine.posted_lengths.clear();
    machine.tool_table_is_complete = false;
    prepared.session(|session| execute(sheet, &prepared, session));
}

fn execute(sheet: &mut Sheet<'_>, prepared: &Prepared, session: &Session<'_>) {
    let names: BTreeMap<u16, String> =
        (1..=WORK_OFFSETS).filter_map(|number| Some((number, name_of(session, number)?))).collect();
    let text = prepared.source.text();
    let mut writers = Writers::new(text, names.keys().copied().collect(), Reader::new(session));
    let options = Options::NONE;
    let machine = &prepared.equipment.machine;
    let result = gcheck_engine::run(session.program, session.model, machine, options, FUEL, &mut writers);
    let is_end = matches!(result.stopped, Stopped::Ended(ending) if !matches!(ending, Ending::Alarm(_)));
    if let Some(fault) = execution::fault_of(session, &result).filter(|_| !is_end) {
        return sheet.problems.push(execution::problem_of(&fault));
    }
    if matches!(result.stopped, Stopped::Ended(Ending::Text)) && is_cut(sheet.text) {
        let end = sheet.text.trim_end().len();
        return sheet.refuse(&(end..end), "the file begins with `%` and ends without it; is it cut short?");
    }
    let places = Places::new(sheet, text, &writers);
    let lines = Lines::new(text);
    for unread in &writers.reader.found {
        let range = sheet.range_of_line(lines.line(unread.at));
        sheet.leave(&range, unread.what.clone(), unread.why);
    }
    if session.says_units() {
        let units = result.state.units(session.model).map(|units| match units {
            gcheck_engine::Units::Mm => Units::Mm,
            gcheck_engine::Units::Inch => Units::Inch,
        });
        if let Some(units) = units {
            sheet.tells = Tells::Offsets;
            sheet.put_units(units, &places.first);
        }
    } else if !prepared.equipment.units_assumed {
        sheet.units = Some(match prepared.equipment.units {
            gcheck_engine::Units::Mm => Units::Mm,
            gcheck_engine::Units::Inch => Units::Inch,
        });
    }
    if sheet.units.is_some() {
        take(sheet, session, &result, &names, &places);
    } else {
        // Something that counts in units, so that they are asked for.
        sheet.put(&["offsets"], Value::Length(0.0), &places.first, "offsets");
    }
}

/// Does a tape begin and not end?
fn is_cut(text: &str) -> bool {
    let mut lines = text.lines().map(str::trim).filter(|line| !line.is_empty());
    lines.next().is_some_and(|line| line.starts_with('%')) && !lines.any(|line| line.starts_with('%'))
}

fn take(
    sheet: &mut Sheet<'_>,
    session: &Session<'_>,
    result: &RunResult,
    names: &BTreeMap<u16, String>,
    places: &Places,
) {
    let place = format!("run as a program of {}", session.prepared.chosen.choice.name);
    let inch = sheet.units == Some(Units::Inch);
    let shown = |axis: Axis, value: f64| {
        let value = if inch && !axis.is_rotary() { value / 25.4 } else { value };
        Value::of_axis(axis.name(), rounded(value) + 0.0)
    };
    let tables = result.state.tables();
    let before = tables.offset(u16::MAX);
    let axes = session.axes_of_machine();
    for (number, name) in names {
        let range = places.offset(*number);
        let offset = tables.offset(*number);
        if is_same(&offset, &before) && !places.of_offset.contains_key(number) {
            continue;
        }
        // A key that is missing says zero, so an offset is taken whole or not at all.
        let unknown = axes.iter().filter(|axis| offset.origin.get(**axis).is_none());
        let unknown: Vec<String> = unknown.map(|axis| axis.name().to_string()).collect();
        if !unknown.is_empty() {
            let why = format!(
                "the file does not say {}, and in `gcheck.toml` an axis that is left out is zero",
                listed(&unknown)
            );
            sheet.leave(range, name.clone(), why);
            continue;
        }
        for axis in Axis::ALL {
            if let Some(value) = offset.origin.get(axis) {
                let key = ["offsets", name, &axis.name().to_string()];
                sheet.put(&key, shown(axis, value), range, &place);
            }
        }
        if offset.rotation != 0.0 && !offset.rotation.is_nan() {
            sheet.leave(range, format!("the rotation of {name}"), super::sheet::NO_KEY);
        }
    }
    for ((number, size), range) in &places.of_tool {
        if let Some(key) = SIZES.get(*size)
            && !sizes(&result.state, *number).get(*size).is_some_and(|mm| mm.is_finite())
        {
            let what = format!("the {} of tool {number}", key.replace('_', " "));
            sheet.leave(range, what, "it is not known at the end of the program");
        }
    }
    for number in 0..TOOLS {
        let name = number.to_string();
        for (ix, (key, mm)) in SIZES.into_iter().zip(sizes(&result.state, number)).enumerate() {
            if mm.is_finite() && (mm != 0.0 || key == "length") {
                sheet.put(&["tools", &name, key], shown(Axis::Z, mm), places.tool(number, ix), &place);
            }
        }
    }
    shift(sheet, &result.state.shift(), &places.first);
    for assumed in Rests::new(session, result).described() {
        // What no key can say matters to moves, and there are none.
        if let Some(pin) = &assumed.pin {
            sheet.remarks.push(format!("assumed: {}; `{pin}` can say otherwise", assumed.text));
        }
    }
    if sheet.facts.is_empty() {
        let message = "the program writes no offset that is known at its end";
        let problem = Problem::at(&sheet.shown, sheet.text, &places.first, message);
        let reasons = super::unused::unused(sheet);
        sheet.problems.push(if reasons.is_empty() {
            problem
        } else {
            problem.note(reasons.join("\n        "))
        });
    }
}

/// Names as a list in words.
fn listed(names: &[String]) -> String {
    match names.split_last() {
        Some((last, [])) => last.clone(),
        Some((last, others)) => format!("{} and {last}", others.join(", ")),
        None => String::new(),
    }
}

/// A shift of all work offsets, which is in none of them.
fn shift(sheet: &mut Sheet<'_>, shift: &Position, range: &Range<usize>) {
    if Axis::ALL.iter().any(|axis| shift.get(*axis).is_some_and(|value| value != 0.0)) {
        sheet.leave(range, "the shift of all work offsets", super::sheet::NO_KEY);
    }
}

fn is_same(one: &WorkOffset, other: &WorkOffset) -> bool {
    let bits = |offset: &WorkOffset| offset.origin.values().map(f64::to_bits);
    bits(one) == bits(other) && one.rotation.to_bits() == other.rotation.to_bits()
}

/// A work offset as configurations name it.
fn name_of(session: &Session<'_>, number: u16) -> Option<String> {
    let control = session.model.control();
    let own = control.codes().find(|code| code.effect() == Effect::WorkOffset(number));
    own.map(|code| code.number().to_string()).or_else(|| {
        control.codes().find_map(|code| {
            let Effect::WorkOffsetByP(first) = code.effect() else { return None };
            let name = format!("{} P{}", code.number(), number.checked_sub(first)? + 1);
            (crate::config::work_offset(&name, control) == Some(number)).then_some(name)
        })
    })
}
