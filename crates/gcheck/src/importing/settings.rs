//! The numbered settings that a hobby control prints for `$$`: `$110=5000.000`.
//!
//! Knows: those settings, as the documentation of Grbl 1.1 and grblHAL has them: rates count in mm a minute, accelerations in
//! mm a second squared and travels in mm whatever is reported (`$13`), from the axis of number 0 on. Must not know: other
//! formats, how TOML is written.
//!
//! Machine coordinates are negative, from the corner that the axes home to, except where homing sets the origin there and an
//! axis homes to its negative end: a flag of `$22` on some builds (8), an option of the build on others, which the answer to
//! `$I` shows (`Z` in `[OPT:…]`). Where neither tells, the travel of such an axis is not written.

use std::collections::BTreeMap;
use std::ops::Range;

use super::sheet::{NO_KEY, Sheet, Tells, Value, is_rotary, lines};
use crate::config::Units;

/// Axes in the order of their settings.
const AXES: [char; 6] = ['X', 'Y', 'Z', 'A', 'B', 'C'];
/// Settings below this are those of every build.
const COMMON_AXES: u32 = 3;
/// Commands whose answer a dump is, as a terminal shows them.
const COMMANDS: [&str; 2] = ["$$", "$I"];
/// The flag of `$22` that sets the origin where the axes home to.
const ORIGIN_AT_HOME: u32 = 8;
/// The letter of a build that always does.
const ORIGIN_AT_HOME_LETTER: char = 'Z';

#[derive(Debug, Clone)]
struct Setting {
    text: String,
    range: Range<usize>,
}

/// Number and value of a line.
fn setting(line: &str) -> Option<(u32, &str)> {
    let (number, value) = line.trim().strip_prefix('$')?.split_once('=')?;
    Some((number.trim().parse().ok()?, value))
}

/// Does a text hold such a line?
pub(super) fn is_one(text: &str) -> bool {
    lines(text).any(|(_, line)| setting(line).is_some())
}

/// Reads the dump.
pub(super) fn read(sheet: &mut Sheet<'_>) {
    let Dump { mut settings, options } = dump(sheet);
    sheet.tells = Tells::Machine;
    let Some(last) = settings.values().map(|setting| setting.range.clone()).max_by_key(|range| range.start)
    else {
        return;
    };
    let axes: Vec<(u32, char)> =
        (0..).zip(AXES).filter(|(ix, _)| settings.contains_key(&(100 + ix))).collect();
    if let (Some((first, _)), Some(setting)) =
        (axes.first(), axes.first().and_then(|(ix, _)| settings.get(&(100 + ix))))
    {
        let names = axes.iter().map(|(_, axis)| axis.to_string()).collect();
        let last = axes.last().map_or(*first, |(ix, _)| *ix);
        let place = format!("${} to ${}", 100 + first, 100 + last);
        sheet.put(&["machine", "axes"], Value::List(names), &setting.range.clone(), &place);
        // Rates, accelerations and travels count in millimetres, whatever is reported.
        sheet.put_units(Units::Mm, &setting.range.clone());
    }
    if !sheet.problems.is_empty() {
        return;
    }
    if axes.is_empty() {
        sheet.refuse(
            &last,
            "the file has no setting of an axis ($100 to $105) up to its end; is it cut short?",
        );
        return;
    }
    // Every build prints all settings of an axis.
    let names = [(110, "rapid"), (120, "acceleration"), (130, "travel")];
    let of_axis =
        names.iter().flat_map(|(base, key)| axes.iter().map(move |(ix, axis)| (base + ix, key, axis)));
    if let Some((number, key, axis)) = of_axis.into_iter().find(|(number, ..)| !settings.contains_key(number))
    {
        let message = format!("the file ends without ${number}, the {key} of {axis}; is it cut short?");
        return sheet.refuse(&last, message);
    }
    let homing = Homing::of(sheet, &settings, options);
    for (ix, axis) in &axes {
        settings.remove(&(100 + ix));
        let name = axis.to_string();
        for (base, key) in [(110, "rapid"), (120, "acceleration")] {
            let number = base + ix;
            let Some(setting) = settings.remove(&number) else { continue };
            if let Some(value) =
                sheet.positive(&setting.text, &setting.range, &format!("${number} ({key} of {axis})"))
            {
                let value = Value::of_axis(*axis, value);
                sheet.put(&["machine", key, &name], value, &setting.range, &format!("${number}"));
            }
        }
        let number = 130 + ix;
        if let Some(setting) = settings.remove(&number) {
            travel(sheet, *axis, *ix, number, &setting, &homing);
        }
    }
    spindle(sheet, &mut settings);
    rest(sheet, settings);
}

struct Dump {
    settings: BTreeMap<u32, Setting>,
    /// Letters of the build, where the answer to `$I` is in the file.
    options: Option<String>,
}

fn dump(sheet: &mut Sheet<'_>) -> Dump {
    let mut dump = Dump { settings: BTreeMap::new(), options: None };
    for (start, line) in lines(sheet.text) {
        let told = line.trim();
        let first = start + (line.len() - line.trim_start().len());
        let range = first..first + told.len();
        if let Some(options) = told.strip_prefix("[OPT:") {
            dump.options = Some(options.split([',', ']']).next().unwrap_or_default().to_owned());
            continue;
        }
        let Some((number, value)) = setting(told) else {
            if let Some(rest) = told.strip_prefix('$') {
                if !rest.is_empty() && rest.bytes().all(|byte| byte.is_ascii_digit()) {
                    sheet.refuse(
                        &range,
                        format!("`{told}` is not a setting with a value; is the file cut short?"),
                    );
                } else if !COMMANDS.contains(&told) {
                    sheet.leave(&range, format!("`{told}`"), "it is not a numbered setting");
                }
            }
            continue;
        };
        // Some versions add what a setting means in brackets.
        let text = value.split('(').next().unwrap_or_default().trim().to_owned();
        if text.is_empty() && value.trim().is_empty() && (100..140).contains(&number) {
            sheet.refuse(&range, format!("${number} has no value; is the file cut short?"));
            continue;
        }
        match dump.settings.get(&number) {
            Some(before) if before.text != text => {
                let line = sheet.line(before.range.start);
                sheet.refuse(&range, format!("${number} is {text} here and {} in line {line}", before.text));
            }
            _ => {
                dump.settings.insert(number, Setting { text, range });
            }
        }
    }
    dump
}

/// What decides where machine coordinates begin; `None` where the file does not tell.
struct Homing {
    is_on: Option<bool>,
    /// By bit of the axis: it homes to its negative end.
    negative: Option<u32>,
    /// The origin is where the axes home to.
    origin_at_home: Option<bool>,
}

impl Homing {
    fn of(sheet: &mut Sheet<'_>, settings: &BTreeMap<u32, Setting>, options: Option<String>) -> Self {
        let mut whole = |number: u32| {
            let setting = settings.get(&number)?;
            let value = setting.text.parse::<u32>().ok();
            if value.is_none() {
                let why = format!("it is `{}`, which is not a whole number", setting.text);
                sheet.leave(&setting.range, format!("${number}"), why);
            }
            value
        };
        let (mode, negative) = (whole(22), whole(23));
        let flags = mode.unwrap_or_default();
        // A build whose `$22` has flags has settings that others lack.
        let has_flags =
            flags > 1 || settings.keys().any(|number| (33..100).contains(number) || *number > 199);
        let origin_at_home = if has_flags {
            mode.map(|mode| mode & ORIGIN_AT_HOME != 0)
        } else {
            options.map(|options| options.contains(ORIGIN_AT_HOME_LETTER))
        };
        Self { is_on: mode.map(|mode| mode & 1 != 0), negative, origin_at_home }
    }
}

fn travel(sheet: &mut Sheet<'_>, axis: char, ix: u32, number: u32, setting: &Setting, homing: &Homing) {
    let what = format!("${number} (travel of {axis})");
    let Some(length) = sheet.number(&setting.text, &setting.range, &what) else { return };
    if length == 0.0 && ix >= COMMON_AXES {
        return sheet.leave(&setting.range, what, "the axis has no end of travel");
    }
    if length <= 0.0 {
        return sheet.refuse(&setting.range, format!("{what} is {length}: it must be greater than zero"));
    }
    match homing.is_on {
        Some(true) => {}
        Some(false) => {
            let why =
                "the machine does not home ($22=0), so its coordinates begin wherever it is switched on";
            return sheet.leave(&setting.range, what, why);
        }
        None => {
            return sheet.leave(
                &setting.range,
                what,
                "the file does not tell whether the machine homes ($22)",
            );
        }
    }
    let negative = homing.negative.map(|negative| negative & (1 << ix) != 0);
    let (ends, place) = match (negative, homing.origin_at_home) {
        (Some(true), Some(true)) => {
            ([0.0, length], format!("${number}; $23 homes {axis} to its negative end, and that is zero"))
        }
        (Some(true), None) => {
            let why = format!(
                "$23 homes {axis} to its negative end, and whether that is zero depends on the build: add the answer to `$I` to the file"
            );
            return sheet.leave(&setting.range, what, why);
        }
        (None, None | Some(true)) => {
            return sheet.leave(
                &setting.range,
                what,
                "the file does not tell to which end the axes home ($23)",
            );
        }
        (_, Some(false)) | (Some(false), _) => {
            ([-length, 0.0], format!("${number}; machine coordinates are negative"))
        }
    };
    let value = if is_rotary(axis) { Value::Plain(ends) } else { Value::Ends(ends) };
    sheet.put(&["machine", "travel", &axis.to_string()], value, &setting.range, &place);
}

fn spindle(sheet: &mut Sheet<'_>, settings: &mut BTreeMap<u32, Setting>) {
    let is_laser = settings.get(&32).is_some_and(|setting| setting.text.parse() == Ok(1.0));
    let Some(setting) = settings.remove(&30) else { return };
    if is_laser {
        let why = "it is the full power of a laser ($32=1), not a spindle speed";
        sheet.leave(&setting.range, "$30", why);
    } else if let Some(rpm) = sheet.positive(&setting.text, &setting.range, "$30 (highest spindle speed)") {
        sheet.put(&["machine", "max_rpm"], Value::Number(rpm), &setting.range, "$30");
    }
}

fn rest(sheet: &mut Sheet<'_>, settings: BTreeMap<u32, Setting>) {
    for (number, setting) in settings {
        let why = match number {
            13 => "it is about reports only; settings count in millimetres",
            22 | 23 => continue,
            _ => NO_KEY,
        };
        sheet.leave(&setting.range, format!("${number}"), why);
    }
}
