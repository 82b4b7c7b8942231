//! The INI file of a PC control: `[TRAJ]`, `[KINS]`, and the limits of axes and joints.
//!
//! Knows: sections and keys of that file, as the integrator's manual of LinuxCNC describes them: velocities count in units a
//! second, accelerations in units a second squared, a comment fills a line, and the first of two equal keys counts. Must not
//! know: other formats, how TOML is written.
//!
//! A line `#INCLUDE FILE` stands for the lines of that file, up to 16 levels deep. HAL files of `[HAL]` may set limits at the
//! pins that the control makes of its limits (`ini.x.max_velocity`); what they set counts over what the INI file says.

use std::collections::BTreeMap;
use std::ops::Range;
use std::path::{Path, PathBuf};
use std::rc::Rc;

use super::hal;
use super::sheet::{NO_KEY, Sheet, Tells, Value, is_rotary, lines, rounded, unit_name};
use crate::config::Units;
use crate::{paths, reading};

/// A limit as far away as this is one that the machine does not have.
const NO_LIMIT: f64 = 1e9;
/// Axes that the control has.
const AXES: &str = "XYZABCUVW";
/// The kinematics that have a joint for each axis.
const PLAIN_KINEMATICS: &str = "trivkins";
/// What the section of an axis has.
const LIMITS: [&str; 4] = ["MIN_LIMIT", "MAX_LIMIT", "MAX_VELOCITY", "MAX_ACCELERATION"];
/// Bytes of a longer line are not those of a key.
const LONGEST_LINE: usize = 2000;

/// What the control does by itself and may be told to do by a procedure: integrator's manual, "Remap Extending G-code".
const OWN_CODES: [&str; 8] = ["M0", "M1", "M6", "M60", "M61", "T", "S", "F"];

/// Files that include each other go no deeper.
const DEEPEST: usize = 16;
/// A larger file is not a part of a configuration.
const MOST_BYTES: u64 = 1 << 20;

/// A line with a key.
#[derive(Debug, Clone)]
struct Entry {
    section: Rc<str>,
    key: String,
    value: String,
    /// The line of the INI file; of another file, the line that names it.
    range: Range<usize>,
    /// The other file, and how it says this.
    from: Option<Rc<str>>,
    used: bool,
}

impl Entry {
    fn place(&self) -> String {
        let from = self.from.as_ref().map_or_else(String::new, |from| format!(" {from}"));
        format!("[{}] {}{from}", self.section, self.key)
    }

    /// The value up to a blank: what follows a number is a remark.
    fn first(&self) -> &str {
        self.value.split_whitespace().next().unwrap_or_default()
    }
}

/// Does a text look like such a file: a section, and a key with a value, or another file that it includes?
pub(super) fn is_one(text: &str) -> bool {
    let mut section = false;
    for (_, line) in lines(text) {
        let line = line.trim();
        section |= line.starts_with('[') && line.ends_with(']');
        if line.starts_with("#INCLUDE ") {
            return true;
        }
        if section && line.contains('=') {
            return true;
        }
    }
    false
}

/// Reads the file; the path of its tool table, if it names one, with the place of the name.
pub(super) fn read(sheet: &mut Sheet<'_>, folder: &Path) -> Option<(PathBuf, Range<usize>)> {
    sheet.tells = Tells::Machine;
    let mut file = entries(sheet, folder);
    file.hal_files(sheet, folder);
    file.units(sheet);
    if let Some(name) = file.take("EMC", "MACHINE").filter(|entry| !entry.value.is_empty()) {
        sheet.put(&["machine", "name"], Value::Text(name.value.clone()), &name.range, &name.place());
    }
    let axes = file.axes(sheet);
    let names: Vec<String> = axes.letters.iter().map(char::to_string).collect();
    if let (Some(range), false) = (&axes.range, names.is_empty()) {
        sheet.put(&["machine", "axes"], Value::List(names), range, "[TRAJ] COORDINATES");
    }
    let vector = file.take_positive(sheet, "TRAJ", &["MAX_LINEAR_VELOCITY", "MAX_VELOCITY"]);
    let mut slowest = f64::INFINITY;
    for axis in &axes.letters {
        let rapid = file.axis(sheet, *axis, &axes, vector.as_ref().map(|(velocity, _)| *velocity));
        if !is_rotary(*axis) {
            slowest = rapid.unwrap_or(f64::INFINITY).min(slowest);
        }
    }
    if let Some((velocity, entry)) = vector {
        max_feed(sheet, velocity, &entry, slowest);
    }
    for key in ["MAX_FORWARD_VELOCITY", "MAX_VELOCITY"] {
        if let Some((rpm, entry)) = file.take_positive(sheet, "SPINDLE_0", &[key]) {
            sheet.put(&["machine", "max_rpm"], Value::Number(rpm), &entry.range, &entry.place());
            break;
        }
    }
    file.remapped_codes(sheet);
    let table = file.take("EMCIO", "TOOL_TABLE").filter(|entry| !entry.value.is_empty());
    file.rest(sheet, &axes);
    table.map(|entry| (folder.join(&entry.value), entry.range))
}

/// The lines of the file that say something, with those of the files that it includes.
fn entries(sheet: &mut Sheet<'_>, folder: &Path) -> IniFile {
    let mut section: Rc<str> = Rc::from("");
    let mut file = IniFile { entries: Vec::new(), last: None, includes: false };
    let is_ended = sheet.text.ends_with('\n');
    for (start, line) in lines(sheet.text) {
        let told = line.trim();
        let first = start + (line.len() - line.trim_start().len());
        let range = first..first + told.len();
        let parsed = parse(told);
        if told.len() > LONGEST_LINE {
            sheet.refuse(&(first..first + 1), format!("the line is longer than {LONGEST_LINE} bytes"));
            continue;
        }
        match parsed {
            Line::Nothing => {}
            Line::Include(name) => {
                let mut within = Within { folder, range: &range, section: &mut section, open: Vec::new() };
                within.include(sheet, &mut file, name);
            }
            Line::Section(name) => {
                section = Rc::from(name);
                file.last = Some((Rc::clone(&section), range));
            }
            Line::OpenSection => sheet.refuse(&range, "a section begins here, and its `]` is missing"),
            Line::Key(key, value) => {
                let (section, key, value) = (Rc::clone(&section), key.to_owned(), value.to_owned());
                file.entries.push(Entry { section, key, value, range, from: None, used: false });
            }
            Line::Other if !is_ended && start + line.len() == sheet.text.len() => {
                sheet.refuse(&range, "the file ends in the middle of a key; is it cut short?");
            }
            Line::Other => sheet.leave(&range, format!("`{told}`"), "a key without `=`"),
        }
    }
    file
}

/// A line of an INI file.
enum Line<'l> {
    Nothing,
    Include(&'l str),
    Section(&'l str),
    /// A section without its end.
    OpenSection,
    Key(&'l str, &'l str),
    Other,
}

fn parse(told: &str) -> Line<'_> {
    if let Some(name) = told.strip_prefix("#INCLUDE") {
        return Line::Include(name.trim());
    }
    if told.is_empty() || told.starts_with(['#', ';']) {
        return Line::Nothing;
    }
    if let Some(name) = told.strip_prefix('[') {
        return name.split_once(']').map_or(Line::OpenSection, |(name, _)| Line::Section(name.trim()));
    }
    told.split_once('=').map_or(Line::Other, |(key, value)| Line::Key(key.trim(), value.trim()))
}

/// Where included files are read.
struct Within<'w> {
    /// Paths count from here.
    folder: &'w Path,
    /// The line of the INI file that leads to them.
    range: &'w Range<usize>,
    section: &'w mut Rc<str>,
    /// The files that are being read, the outermost first.
    open: Vec<PathBuf>,
}

impl Within<'_> {
    /// Takes over the lines of a file; what keeps it from being read is listed.
    fn include(&mut self, sheet: &mut Sheet<'_>, file: &mut IniFile, name: &str) {
        let what = format!("`{}`", format!("#INCLUDE {name}").trim_end());
        let text = match self.text(name) {
            Ok(text) => text,
            Err(why) => {
                file.includes = true;
                return sheet.leave(self.range, what, why);
            }
        };
        let from: Rc<str> = Rc::from(format!("of {}", shown(name)));
        for (_, line) in lines(&text) {
            match parse(line.trim()) {
                Line::Section(name) => *self.section = Rc::from(name),
                Line::Include(name) => self.include(sheet, file, name),
                Line::Key(key, value) if line.len() <= LONGEST_LINE => file.entries.push(Entry {
                    section: Rc::clone(self.section),
                    key: key.to_owned(),
                    value: value.to_owned(),
                    range: self.range.clone(),
                    from: Some(Rc::clone(&from)),
                    used: false,
                }),
                Line::OpenSection => {
                    sheet.refuse(self.range, format!("a section of {} begins without its `]`", shown(name)));
                }
                Line::Nothing | Line::Key(..) | Line::Other => {}
            }
        }
        self.open.pop();
    }

    /// The text of a file, which then counts as open.
    fn text(&mut self, name: &str) -> Result<String, String> {
        if name.is_empty() {
            return Err("it names no file".to_owned());
        }
        if name.starts_with('~') {
            return Err("files of a home folder are not read; name it by its path".to_owned());
        }
        let path = paths::absolute(&self.folder.join(name));
        if self.open.contains(&path) {
            return Err("the file includes itself".to_owned());
        }
        if self.open.len() >= DEEPEST {
            return Err(format!("files include each other more than {DEEPEST} levels deep"));
        }
        let text = text_of(&path)?;
        self.open.push(path);
        Ok(text)
    }
}

/// The text of a file that another one names.
fn text_of(path: &Path) -> Result<String, String> {
    if !path.exists() {
        return Err(format!("the file {} does not exist", paths::shown_from_here(path)));
    }
    let bytes = reading::regular(path, MOST_BYTES)
        .map_err(|reason| format!("cannot read {}: {reason}", paths::shown_from_here(path)))?;
    Ok(String::from_utf8_lossy(&bytes).into_owned())
}

/// The name of a file without its folder.
fn shown(name: &str) -> &str {
    name.rsplit(['/', '\\']).next().unwrap_or(name)
}

/// The axes of the machine.
struct Axes {
    /// Each once, in the order of the file.
    letters: Vec<char>,
    /// By joint; a machine with two motors on an axis has a letter twice.
    by_joint: Vec<char>,
    /// Each axis has a joint of its own.
    plain: bool,
    /// What the kinematics are called.
    kinematics: String,
    range: Option<Range<usize>>,
}

struct IniFile {
    entries: Vec<Entry>,
    /// The section at the end, and where it begins.
    last: Option<(Rc<str>, Range<usize>)>,
    /// There is more in files that could not be read.
    includes: bool,
}

impl IniFile {
    /// The first entry of a key, which then counts as used.
    fn take(&mut self, section: &str, key: &str) -> Option<Entry> {
        let entry = self.entries.iter_mut().find(|entry| *entry.section == *section && entry.key == key)?;
        entry.used = true;
        Some(entry.clone())
    }

    fn take_positive(&mut self, sheet: &mut Sheet<'_>, section: &str, keys: &[&str]) -> Option<(f64, Entry)> {
        let entry = keys.iter().find_map(|key| self.take(section, key))?;
        let number = sheet.positive(entry.first(), &entry.range, &entry.place())?;
        Some((number, entry))
    }

    /// The limits that HAL files set, over those of the INI file.
    fn hal_files(&mut self, sheet: &mut Sheet<'_>, folder: &Path) {
        let mut set: Vec<Entry> = Vec::new();
        for ix in 0..self.entries.len() {
            let Some(entry) = self.entries.get_mut(ix) else { break };
            let is_hal = *entry.section == *"HAL"
                && matches!(entry.key.as_str(), "HALFILE" | "POSTGUI_HALFILE" | "HALCMD" | "POSTGUI_HALCMD");
            if !is_hal {
                continue;
            }
            entry.used = true;
            let (range, name, is_file) =
                (entry.range.clone(), entry.value.clone(), entry.key.ends_with("FILE"));
            let file_name = entry.first().to_owned();
            let told = if is_file { shown(&file_name).to_owned() } else { entry.key.clone() };
            let text = if !is_file {
                Ok(name)
            } else if file_name.starts_with("LIB:") || file_name.starts_with('~') {
                Err("files of the control's library and of home folders are not read".to_owned())
            } else if !file_name.to_ascii_lowercase().ends_with(".hal") {
                Err("only files of HAL commands are read (`.hal`)".to_owned())
            } else {
                text_of(&folder.join(&file_name))
            };
            match text {
                Ok(text) => self.limits_of(sheet, &text, &told, &range, &mut set),
                Err(why) => sheet.leave(&range, format!("[HAL] {file_name}"), why),
            }
        }
        // The last value that is set is the one that stays; it counts before all of the INI file.
        set.reverse();
        self.entries.splice(0..0, set);
    }

    /// The limits that commands of a HAL file set.
    fn limits_of(
        &self,
        sheet: &mut Sheet<'_>,
        text: &str,
        name: &str,
        range: &Range<usize>,
        set: &mut Vec<Entry>,
    ) {
        let value_of = |section: &str, key: &str| {
            let is_it = |entry: &&Entry| *entry.section == *section && entry.key == key;
            self.entries.iter().find(is_it).map(|entry| entry.first().to_owned())
        };
        for limit in hal::limits(text) {
            match limit.value(value_of) {
                Ok(value) => set.push(Entry {
                    section: Rc::from(limit.section),
                    key: limit.key.to_owned(),
                    value,
                    range: range.clone(),
                    from: Some(Rc::from(format!("as {name} sets it ({})", limit.pin))),
                    used: false,
                }),
                Err(why) => sheet.leave(range, format!("{} of {name}", limit.pin), why),
            }
        }
    }

    fn units(&mut self, sheet: &mut Sheet<'_>) {
        if let Some(entry) = self.take("TRAJ", "LINEAR_UNITS").or_else(|| self.take("TRAJ", "UNITS")) {
            match entry.first().to_ascii_lowercase().as_str() {
                "mm" | "metric" => sheet.put_units(Units::Mm, &entry.range),
                "in" | "inch" | "imperial" => sheet.put_units(Units::Inch, &entry.range),
                "" => {}
                // Files of old versions have a factor: units a millimetre.
                factor if is_factor(factor, 1.0) => sheet.put_units(Units::Mm, &entry.range),
                factor if is_factor(factor, 1.0 / 25.4) => sheet.put_units(Units::Inch, &entry.range),
                other => {
                    let message = format!(
                        "{} is `{other}`; known are mm, metric, in, inch and imperial",
                        entry.place()
                    );
                    sheet.refuse(&entry.range, message);
                }
            }
        }
        if let Some(entry) = self.take("TRAJ", "ANGULAR_UNITS")
            && !matches!(entry.first().to_ascii_lowercase().as_str(), "deg" | "degree" | "degrees" | "")
            && !is_factor(entry.first(), 1.0)
        {
            let message =
                format!("{} is `{}`; angles are read in degrees only", entry.place(), entry.first());
            sheet.refuse(&entry.range, message);
        }
    }

    fn axes(&mut self, sheet: &mut Sheet<'_>) -> Axes {
        let kinematics = self.take("KINS", "KINEMATICS");
        let text = kinematics.as_ref().map_or("", |entry| entry.value.as_str());
        let name = text.split_whitespace().next().unwrap_or(PLAIN_KINEMATICS).to_owned();
        let of_joints = text.split_whitespace().find_map(|word| word.strip_prefix("coordinates="));
        let mut axes = Axes {
            letters: Vec::new(),
            by_joint: Vec::new(),
            plain: name == PLAIN_KINEMATICS,
            kinematics: name,
            range: None,
        };
        let coordinates = self.take("TRAJ", "COORDINATES");
        let told = coordinates.as_ref().map_or("", |entry| entry.value.as_str());
        let told = told.split(['#', ';']).next().unwrap_or_default();
        for letter in told.chars().filter(|c| !c.is_whitespace() && *c != ',') {
            let name = letter.to_ascii_uppercase();
            if !AXES.contains(name) {
                if let Some(entry) = &coordinates {
                    sheet.refuse(
                        &entry.range,
                        format!("`{letter}` is not an axis; the axes are X, Y, Z, A, B, C, U, V and W"),
                    );
                }
                break;
            }
            axes.by_joint.push(name);
            if !axes.letters.contains(&name) {
                axes.letters.push(name);
            }
        }
        if let Some(joints) = of_joints {
            axes.by_joint =
                joints.chars().map(|c| c.to_ascii_uppercase()).filter(|c| AXES.contains(*c)).collect();
        }
        axes.range = coordinates.map(|entry| entry.range);
        axes
    }

    /// The sections that describe an axis, the one that counts first.
    fn sections(axis: char, all: &Axes) -> Vec<String> {
        let mut sections = vec![format!("AXIS_{axis}")];
        // Files of old versions number the axes, and those of plain machines may leave everything to the joints.
        let order = "XYZABCUVW".find(axis).unwrap_or_default();
        sections.push(format!("AXIS_{order}"));
        if all.plain {
            let joint = all.by_joint.iter().position(|letter| *letter == axis);
            sections.extend(joint.map(|joint| format!("JOINT_{joint}")));
        }
        sections
    }

    /// What the file says of an axis; its rapid rate, in units a minute. `vector` is the fastest move, in units a second.
    fn axis(&mut self, sheet: &mut Sheet<'_>, axis: char, all: &Axes, vector: Option<f64>) -> Option<f64> {
        let sections = Self::sections(axis, all);
        let find = |file: &mut Self, key: &str| sections.iter().find_map(|section| file.take(section, key));
        let name = axis.to_string();
        if !sections.iter().any(|name| self.has(name)) {
            let range = all.range.clone().unwrap_or(0..0);
            // An axis before others that have sections was left out on purpose.
            let later = all.letters.iter().skip_while(|letter| **letter != axis).skip(1);
            let is_last = !later.flat_map(|letter| Self::sections(*letter, all)).any(|name| self.has(&name));
            if all.plain && !self.includes && is_last {
                let message = format!("the file ends without limits of axis {axis}; is it cut short?");
                sheet.refuse(&range, message);
                return None;
            }
            let why = if all.plain {
                "the axis has no section with limits".to_owned()
            } else {
                format!(
                    "the axis has no section, and the limits of joints are not its own under `{}`",
                    all.kinematics
                )
            };
            sheet.leave(&range, format!("axis {axis}"), why);
            return None;
        }
        self.is_cut(sheet, axis, &sections);
        let ends = [find(self, "MIN_LIMIT"), find(self, "MAX_LIMIT")];
        if let [Some(low), Some(high)] = &ends {
            travel(sheet, axis, low, high);
        } else if let Some(one) = ends.iter().flatten().next() {
            sheet.leave(&one.range, one.place(), "the other end of travel is missing");
        }
        let mut rapid = None;
        if let Some(entry) = find(self, "MAX_VELOCITY")
            && let Some(velocity) = sheet.positive(entry.first(), &entry.range, &entry.place())
        {
            let held = vector.filter(|vector| !is_rotary(axis) && *vector < velocity);
            let rate = per_minute(held.unwrap_or(velocity));
            let place = match held {
                Some(_) => format!("{} * 60, held by [TRAJ] MAX_LINEAR_VELOCITY", entry.place()),
                None => format!("{} * 60", entry.place()),
            };
            sheet.put(&["machine", "rapid", &name], Value::of_axis(axis, rate), &entry.range, &place);
            rapid = Some(rate);
        }
        if let Some(entry) = find(self, "MAX_ACCELERATION")
            && let Some(gain) = sheet.positive(entry.first(), &entry.range, &entry.place())
        {
            let value = Value::of_axis(axis, gain);
            sheet.put(&["machine", "acceleration", &name], value, &entry.range, &entry.place());
        }
        self.jerk(sheet, axis, &sections);
        rapid
    }

    /// Does the file have a section of this name with an entry?
    fn has(&self, section: &str) -> bool {
        self.entries.iter().any(|entry| *entry.section == *section)
    }

    /// Refuses a file that ends in a section of the axis before it has all limits.
    fn is_cut(&self, sheet: &mut Sheet<'_>, axis: char, sections: &[String]) {
        let Some((last, range)) = self.last.as_ref().filter(|_| !self.includes) else { return };
        if !sections.iter().any(|name| **name == **last) {
            return;
        }
        let has = |key: &str| {
            self.entries
                .iter()
                .any(|entry| entry.key == key && sections.iter().any(|name| **name == *entry.section))
        };
        // A file may leave all limits to the control.
        if !self.entries.iter().any(|entry| LIMITS.contains(&entry.key.as_str())) {
            return;
        }
        // An axis that turns may have no ends.
        let expected = LIMITS.into_iter().filter(|key| !is_rotary(axis) || !key.ends_with("_LIMIT"));
        if let Some(key) = expected.into_iter().find(|key| !has(key)) {
            let message = format!("the file ends here, without {key} of axis {axis}; is it cut short?");
            sheet.refuse(range, message);
        }
    }

    /// The jerk of an axis, which counts only where the planner is the one with S-curves.
    fn jerk(&mut self, sheet: &mut Sheet<'_>, axis: char, sections: &[String]) {
        let Some(entry) = sections.iter().find_map(|section| self.take(section, "MAX_JERK")) else { return };
        if self.take("TRAJ", "PLANNER_TYPE").is_none_or(|planner| planner.first() != "1") {
            sheet.leave(&entry.range, entry.place(), "it counts under `[TRAJ] PLANNER_TYPE = 1` only");
        } else if let Some(jerk) = sheet.positive(entry.first(), &entry.range, &entry.place()) {
            let key = ["machine", "jerk", &axis.to_string()];
            sheet.put(&key, Value::of_axis(axis, jerk), &entry.range, &entry.place());
        }
    }

    /// The codes that procedures of the machine carry out: `REMAP=M400 modalgroup=10 argspec=Pq ngc=myprocedure`.
    fn remapped_codes(&mut self, sheet: &mut Sheet<'_>) {
        for entry in &mut self.entries {
            if *entry.section != *"RS274NGC" || entry.key != "REMAP" {
                continue;
            }
            entry.used = true;
            let code = entry.first().to_ascii_uppercase();
            let what = format!("{} = {code}", entry.place());
            let number = code.strip_prefix(['G', 'M']).and_then(|number| number.parse::<f64>().ok());
            if OWN_CODES.contains(&code.as_str()) {
                let why =
                    "the procedure may do more or less than the code, and gcheck follows the code alone";
                sheet.leave(&entry.range, what, why);
                continue;
            }
            if number.is_none() {
                sheet.leave(&entry.range, what, "it is neither a G nor an M code");
                continue;
            }
            let words = entry.value.split_whitespace();
            let procedure = words
                .filter_map(|word| word.split_once('='))
                .find(|(key, _)| matches!(*key, "ngc" | "python"));
            let Some((_, procedure)) = procedure else {
                sheet.leave(&entry.range, what, "it names no procedure (`ngc=` or `python=`)");
                continue;
            };
            let title = Value::Text(format!("remapped to {procedure}"));
            sheet.put(&["codes", &code, "title"], title, &entry.range, &entry.place());
        }
    }

    /// Lists what nobody took.
    fn rest(&self, sheet: &mut Sheet<'_>, all: &Axes) {
        let mut used: BTreeMap<(&str, &str), &Entry> = BTreeMap::new();
        for entry in &self.entries {
            let key = (&*entry.section, entry.key.as_str());
            if entry.used {
                used.insert(key, entry);
                continue;
            }
            let is_limit = LIMITS.contains(&entry.key.as_str());
            let first = used.get(&key);
            let why = if let Some(from) = first.and_then(|first| first.from.as_ref()) {
                format!("the value {from} counts")
            } else if let Some(first) = first {
                format!(
                    "line {} has the key already, and the first one counts",
                    sheet.line(first.range.start)
                )
            } else if is_limit && entry.section.starts_with("JOINT_") && !all.plain {
                format!("under the kinematics `{}` a joint is not an axis", all.kinematics)
            } else if is_limit && entry.section.starts_with("JOINT_") {
                "the section of its axis counts".to_owned()
            } else if is_limit && entry.section.starts_with("AXIS_") {
                "the axis is not in [TRAJ] COORDINATES".to_owned()
            } else {
                NO_KEY.to_owned()
            };
            sheet.leave(&entry.range, entry.place(), why);
        }
    }
}

fn travel(sheet: &mut Sheet<'_>, axis: char, low: &Entry, high: &Entry) {
    let ends = [low, high].map(|entry| sheet.number(entry.first(), &entry.range, &entry.place()));
    let [Some(from), Some(to)] = ends else { return };
    let place = format!("{} and {}", low.place(), high.key);
    if from <= -NO_LIMIT || to >= NO_LIMIT {
        sheet.leave(&low.range, place, "the axis has no end of travel");
    } else if from.to_bits() == to.to_bits() {
        sheet.leave(&low.range, place, format!("both ends are {from}, which leaves no way to travel"));
    } else if from >= to {
        let message = format!("{} is {to}, which is not above {} ({from})", high.place(), low.key);
        sheet.refuse(&high.range, message);
    } else {
        let value = if is_rotary(axis) { Value::Plain([from, to]) } else { Value::Ends([from, to]) };
        sheet.put(&["machine", "travel", &axis.to_string()], value, &low.range, &place);
    }
}

/// The fastest move together, which may be beyond what an axis reaches by itself.
fn max_feed(sheet: &mut Sheet<'_>, velocity: f64, entry: &Entry, slowest: f64) {
    let feed = per_minute(velocity);
    if feed > slowest {
        let unit = sheet.units.map_or("units", unit_name);
        let why = format!(
            "it allows {feed} {unit}/min, more than the slowest axis reaches ({slowest} {unit}/min), so `max_feed` is not written"
        );
        sheet.leave(&entry.range, entry.place(), why);
    } else {
        let place = format!("{} * 60", entry.place());
        sheet.put(&["machine", "max_feed"], Value::Length(feed), &entry.range, &place);
    }
}

fn is_factor(text: &str, factor: f64) -> bool {
    text.parse::<f64>().is_ok_and(|number| (number - factor).abs() < 1e-4)
}

/// A velocity a second as a rate a minute.
fn per_minute(velocity: f64) -> f64 {
    rounded(velocity * 60.0)
}
