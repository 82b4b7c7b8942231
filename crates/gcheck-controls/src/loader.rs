//! From the embedded data files to a [`Control`]: parsing, inheritance, indexes.
//!
//! Knows: the embedded files (JSON, made from the TOML by the build script), bases, `removed`. Must not know: what the facts mean (see [`crate::validate`] for consistency).

use std::collections::{BTreeMap, HashMap};
use std::fmt;
use std::sync::{Arc, LazyLock, Mutex, PoisonError};

use crate::control::{AlarmOfRule, CodeFacts, PreparedSlot};
use crate::execution::{Effect, ExecutionFile, LastingWords, Semantics};
use crate::motion::MotionRules;
use crate::schema::{
    AlarmEntry, AlarmsFile, CodeEntry, CodesFile, ControlFile, FunctionEntry, GroupsFile, LetterEntry,
    LettersFile, Machine, ModalGroup, SettingEntry, SettingsFile, SystemCommands, VariableEntry,
    VariablesFile,
};
use crate::{CodeNumber, Control, Letter, LetterSet};

/// The files of one `data/` folder.
pub(crate) struct Source {
    name: &'static str,
    files: &'static [(&'static str, &'static str)],
}

include!(concat!(env!("OUT_DIR"), "/sources.rs"));

/// Why a control cannot be loaded.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum LoadError {
    /// No control of this name; `names` lists those that can be chosen.
    Unknown {
        /// The name asked for.
        name: String,
    },
    /// A data file is not as the schema wants it. Cannot happen in a released build: a test loads every control.
    Data {
        /// `folder/file.toml`.
        file: String,
        /// What is wrong, with its line.
        message: String,
    },
}

impl fmt::Display for LoadError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Unknown { name } => {
                write!(f, "no control is called `{name}`; choose one of {}", names().join(", "))
            }
            Self::Data { file, message } => write!(f, "knowledge base: {file}: {message}"),
        }
    }
}

impl std::error::Error for LoadError {}

/// What each folder says of itself in `control.toml`, in the order of [`SOURCES`]. Every run asks several times.
static CONTROL_FILES: LazyLock<Vec<Result<ControlFile, LoadError>>> = LazyLock::new(|| {
    let read = |source| {
        parse_file(source, "control.toml").map(|file| {
            file.unwrap_or_else(|| {
                unreachable!("the build script lists only folders that have a control.toml")
            })
        })
    };
    SOURCES.iter().map(read).collect()
});

static NAMES: LazyLock<Vec<&'static str>> = LazyLock::new(|| {
    SOURCES.iter().filter(|s| control_file(s).is_ok_and(|c| !c.is_abstract)).map(|s| s.name).collect()
});

/// Names of the controls that can be chosen, in alphabetical order.
pub fn names() -> &'static [&'static str] {
    &NAMES
}

static FALLBACK: LazyLock<&'static str> = LazyLock::new(|| {
    let is_fallback = |name: &&&'static str| source(name).and_then(control_file).is_ok_and(|c| c.fallback);
    // A test proves that one control says so; without it the first would do.
    names().iter().find(is_fallback).or_else(|| names().first()).copied().unwrap_or_default()
});

/// The control for a program that shows nothing of its own: a common dialect about which little is taken for granted.
pub fn fallback() -> &'static str {
    &FALLBACK
}

/// The control of a name, loaded once per process.
///
/// # Errors
/// [`LoadError::Unknown`] when no control that can be chosen has the name.
pub fn load(name: &str) -> Result<Arc<Control>, LoadError> {
    static LOADED: LazyLock<Mutex<HashMap<&'static str, Arc<Control>>>> = LazyLock::new(Mutex::default);
    let Some(name) = names().iter().find(|n| **n == name) else {
        return Err(LoadError::Unknown { name: name.to_owned() });
    };
    // A panic while the map was locked cannot have left it half-written: entries are inserted whole.
    let mut loaded = LOADED.lock().unwrap_or_else(PoisonError::into_inner);
    if let Some(control) = loaded.get(name) {
        return Ok(Arc::clone(control));
    }
    let control = Arc::new(resolve(name)?);
    loaded.insert(name, Arc::clone(&control));
    Ok(control)
}

/// The names of all sources that data may name, of every folder.
pub(crate) fn all_references() -> impl Iterator<Item = &'static str> {
    let files = CONTROL_FILES.iter().filter_map(|file| file.as_ref().ok());
    files.flat_map(|file| &file.references).map(|reference| reference.id.as_str())
}

/// Detection needs only the hints, which are in `control.toml`: no code table is read for it.
pub(crate) fn all_control_files() -> impl Iterator<Item = &'static ControlFile> {
    CONTROL_FILES.iter().filter_map(|file| file.as_ref().ok()).filter(|file| !file.is_abstract)
}

fn control_file(source: &Source) -> Result<&'static ControlFile, LoadError> {
    let file = SOURCES.iter().zip(CONTROL_FILES.iter()).find(|(other, _)| other.name == source.name);
    match file {
        Some((_, file)) => file.as_ref().map_err(Clone::clone),
        None => Err(LoadError::Unknown { name: source.name.to_owned() }),
    }
}

fn parse_file<T: serde::de::DeserializeOwned>(source: &Source, file: &str) -> Result<Option<T>, LoadError> {
    let Some((_, text)) = source.files.iter().find(|(name, _)| *name == file) else { return Ok(None) };
    serde_json::from_str(text)
        .map(Some)
        .map_err(|e| LoadError::Data { file: format!("{}/{file}", source.name), message: e.to_string() })
}

fn source(name: &str) -> Result<&'static Source, LoadError> {
    SOURCES.iter().find(|s| s.name == name).ok_or_else(|| LoadError::Unknown { name: name.to_owned() })
}

/// Everything collected from the most basic control upward.
#[derive(Default)]
struct Layers {
    head: Option<ControlFile>,
    groups: Vec<ModalGroup>,
    codes: Vec<CodeEntry>,
    letters: Vec<LetterEntry>,
    variables: Vec<VariableEntry>,
    functions: Vec<FunctionEntry>,
    settings: Vec<SettingEntry>,
    alarms: Vec<AlarmOfRule>,
    commands: Option<SystemCommands>,
    effects: BTreeMap<String, Effect>,
    semantics: Option<Semantics>,
    motion: Option<MotionRules>,
    lasting: Vec<LastingWords>,
}

fn resolve(name: &str) -> Result<Control, LoadError> {
    let mut chain = vec![source(name)?];
    let mut base = control_file(source(name)?)?.base.as_deref();
    while let Some(name) = base {
        let next = source(name)?;
        if chain.iter().any(|s| s.name == next.name) || chain.len() > 8 {
            return Err(data_error(name, "is its own base"));
        }
        base = control_file(next)?.base.as_deref();
        chain.push(next);
    }
    let mut layers = Layers::default();
    for source in chain.into_iter().rev() {
        add_layer(&mut layers, source)?;
    }
    finish(layers)
}

fn data_error(name: impl Into<String>, message: &str) -> LoadError {
    LoadError::Data { file: format!("{}/control.toml", name.into()), message: message.to_owned() }
}

/// Puts one folder over what its bases gave: an entry with the same key replaces the base's entry whole.
fn add_layer(layers: &mut Layers, source: &Source) -> Result<(), LoadError> {
    let mut head = control_file(source)?.clone();
    if let Some(base) = layers.head.take() {
        head.machine = head.machine.or(base.machine);
        head.syntax = head.syntax.or(base.syntax);
        head.numbers = head.numbers.or(base.numbers);
        head.limits = head.limits.or(base.limits);
        head.code_list = head.code_list.or(base.code_list);
        head.block = head.block.or(base.block);
        head.format = head.format.or(base.format);
        if head.phases.is_empty() {
            head.phases = base.phases;
        }
        if head.axes.is_empty() {
            head.axes = base.axes;
        }
        let own: Vec<_> = head.references.iter().map(|r| r.id.clone()).collect();
        head.references.extend(base.references.into_iter().filter(|r| !own.contains(&r.id)));
    }
    layers.codes.retain(|c| !head.removed.contains(&c.code));
    // Most controls rename nothing.
    let to_rename = if head.renamed.is_empty() { &mut [] } else { layers.codes.as_mut_slice() };
    for entry in to_rename {
        for block in entry.setup.iter_mut().chain([&mut entry.example]) {
            *block = renamed(block, &head.renamed);
        }
    }
    layers.head = Some(head);
    if let Some(file) = parse_file::<GroupsFile>(source, "groups.toml")? {
        put_all(&mut layers.groups, file.groups, |g| g.id.clone());
    }
    for name in ["codes-g.toml", "codes-m.toml"] {
        if let Some(file) = parse_file::<CodesFile>(source, name)? {
            put_all(&mut layers.codes, file.codes, |c| c.code.clone());
        }
    }
    if let Some(file) = parse_file::<LettersFile>(source, "letters.toml")? {
        put_all(&mut layers.letters, file.letters, |l| l.letter.clone());
    }
    if let Some(file) = parse_file::<VariablesFile>(source, "variables.toml")? {
        put_all(&mut layers.variables, file.variables, |v| (v.range, v.name.clone()));
        put_all(&mut layers.functions, file.functions, |f| f.name.clone());
    }
    if let Some(file) = parse_file::<SettingsFile>(source, "settings.toml")? {
        put_all(&mut layers.settings, file.settings, |s| s.number.clone());
    }
    if let Some(file) = parse_file::<AlarmsFile>(source, "alarms.toml")? {
        let alarms = file.alarms.into_iter().map(|a| AlarmOfRule {
            rule: a.rule,
            of: a.of,
            entry: AlarmEntry { number: a.number, text: a.text, confidence: a.confidence },
        });
        // The first row that names a code is taken: a control's own rows come before those of its base.
        let mut own: Vec<AlarmOfRule> = alarms.collect();
        layers.alarms.retain(|base| !own.iter().any(|row| row.rule == base.rule && row.of == base.of));
        own.append(&mut layers.alarms);
        layers.alarms = own;
    }
    // A control lists its own: its descendants read more than their base.
    layers.commands = parse_file::<SystemCommands>(source, "commands.toml")?;
    if let Some(file) = parse_file::<ExecutionFile>(source, "execution.toml")? {
        layers.effects.extend(file.effects);
        layers.semantics = file.semantics.or(layers.semantics.take());
        layers.motion = file.motion.or(layers.motion.take());
        // A later row speaks for its letters and groups.
        layers.lasting.extend(file.lasting);
    }
    Ok(())
}

/// A block of an example with the codes as a control calls them.
fn renamed(block: &str, names: &BTreeMap<String, String>) -> String {
    let words = block.split(' ').map(|word| names.get(word).map_or(word, String::as_str));
    words.collect::<Vec<_>>().join(" ")
}

fn put_all<T, K: Eq + std::hash::Hash>(into: &mut Vec<T>, from: Vec<T>, key: impl Fn(&T) -> K) {
    let mut places: HashMap<K, usize> = into.iter().enumerate().map(|(ix, item)| (key(item), ix)).collect();
    for item in from {
        match places.get(&key(&item)).and_then(|ix| into.get_mut(*ix)) {
            Some(old) => *old = item,
            None => {
                places.insert(key(&item), into.len());
                into.push(item);
            }
        }
    }
}

fn finish(layers: Layers) -> Result<Control, LoadError> {
    let Some(head) = layers.head else { return Err(data_error("?", "has no layers")) };
    let name = head.name.clone();
    let missing = |what: &str| data_error(&name, &format!("neither the control nor a base gives `{what}`"));
    let mut control = Control {
        machine: head.machine.unwrap_or(Machine::Mill),
        syntax: head.syntax.ok_or_else(|| missing("syntax"))?,
        numbers: head.numbers.ok_or_else(|| missing("numbers"))?,
        limits: head.limits.unwrap_or_default(),
        code_list: head.code_list.unwrap_or_default(),
        block: head.block.unwrap_or_default(),
        format: head.format.unwrap_or_default(),
        phases: head.phases,
        axes: head.axes.iter().filter_map(|a| Letter::parse(a)).collect(),
        hints: head.detect,
        references: head.references,
        name: head.name,
        title: head.title,
        groups: layers.groups,
        codes: Vec::with_capacity(layers.codes.len()),
        by_number: [Vec::new(), Vec::new()],
        letters: vec![None; Letter::COUNT],
        numbered: numbered(&layers.variables),
        variables: layers.variables,
        functions: layers.functions,
        settings: layers.settings,
        alarms: layers.alarms,
        commands: layers.commands,
        semantics: layers.semantics.ok_or_else(|| missing("semantics"))?,
        motion: layers.motion.ok_or_else(|| missing("motion"))?,
        lasting: layers.lasting,
        prepared: PreparedSlot::default(),
    };
    let mut codes = layers.codes;
    codes.sort_by_cached_key(|c| CodeNumber::parse(&c.code));
    let after: Vec<(String, Vec<String>)> = codes
        .iter()
        .filter(|entry| !entry.refused_after.is_empty())
        .map(|entry| (entry.code.clone(), entry.refused_after.clone()))
        .collect();
    for (first, refused) in after {
        for code in refused {
            let entry = codes.iter_mut().find(|entry| entry.code == code);
            let entry = entry.filter(|entry| entry.conflicts.is_empty() || entry.conflicts_when_later);
            let Some(entry) = entry else {
                let message = format!(
                    "{first} cannot have `{code}` in `refused-after`: no code, or one that conflicts in any order"
                );
                return Err(data_error(&control.name, &message));
            };
            entry.conflicts.push(first.clone());
            entry.conflicts_when_later = true;
        }
    }
    for entry in codes {
        let number = CodeNumber::parse(&entry.code)
            .ok_or_else(|| data_error(&control.name, &format!("`{}` is not a code", entry.code)))?;
        let group = control.group_by_id(&entry.group).ok_or_else(|| {
            data_error(
                &control.name,
                &format!("{} names the group `{}`, which does not exist", entry.code, entry.group),
            )
        })?;
        let reads: LetterSet = entry.words.iter().filter_map(|w| Letter::parse(&w.letter)).collect();
        let effect = layers.effects.get(&entry.code).copied().unwrap_or(Effect::None);
        control.put_code(CodeFacts { entry, number, group, reads, effect, alias: None, user: false });
    }
    for entry in layers.letters {
        let letter = Letter::parse(&entry.letter)
            .ok_or_else(|| data_error(&control.name, &format!("`{}` is not an address", entry.letter)))?;
        if let Some(slot) = control.letters.get_mut(letter.index()) {
            *slot = Some(entry);
        }
    }
    Ok(control)
}

/// Which entry holds for each variable: the one with the narrowest range, of several the first.
fn numbered(variables: &[VariableEntry]) -> Vec<(u32, Option<usize>)> {
    let ranges = || variables.iter().enumerate().filter_map(|(ix, entry)| Some((ix, entry.range?)));
    let mut starts: Vec<u32> =
        ranges().flat_map(|(_, [first, last])| [first, last.saturating_add(1)]).collect();
    starts.sort_unstable();
    starts.dedup();
    let entry_of = |number: u32| {
        let holds = ranges().filter(|(_, [first, last])| (first..=last).contains(&&number));
        holds.min_by_key(|(_, [first, last])| last - first).map(|(ix, _)| ix)
    };
    starts.into_iter().map(|start| (start, entry_of(start))).collect()
}

#[cfg(test)]
mod tests {
    use std::fs;
    use std::path::Path;

    use super::{
        AlarmsFile, CodesFile, ControlFile, ExecutionFile, GroupsFile, LettersFile, SettingsFile,
        SystemCommands, VariablesFile,
    };

    #[test]
    fn inherited_examples_name_codes_as_the_control_does() {
        let setup = |control, code| {
            let control = crate::load(control).unwrap();
            control.code(crate::CodeNumber::parse(code).unwrap()).unwrap().entry().setup.join(" | ")
        };
        assert_eq!(setup("fanuc-lathe-b", "G0"), "G21 | G54 | T0101 | G97 S800 M3");
        assert_eq!(setup("fanuc-lathe-c", "G0"), "G71 | G54 | T0101 | G97 S800 M3");
    }

    #[test]
    fn a_variable_is_that_of_the_narrowest_range() {
        for name in crate::names() {
            let control = crate::load(name).unwrap();
            let ranges = || control.variables().iter().filter_map(|entry| Some((entry, entry.range?)));
            for number in
                ranges().flat_map(|(_, [first, last])| [first.saturating_sub(1), first, last, last + 1])
            {
                let holds = ranges().filter(|(_, [first, last])| (first..=last).contains(&&number));
                let narrowest = holds.min_by_key(|(_, [first, last])| last - first).map(|(entry, _)| entry);
                let found = match control.variable(number) {
                    crate::Variable::Known(entry) => Some(entry),
                    crate::Variable::Unlisted => None,
                };
                assert_eq!(found, narrowest, "#{number} of {name}");
            }
        }
    }

    /// The embedded form has lost its line numbers; this is where an author of data learns the line.
    #[test]
    fn every_data_file_is_as_the_schema_wants_it() {
        let data = Path::new(env!("CARGO_MANIFEST_DIR")).join("data");
        // Models of machines are read as configurations are.
        let folders = fs::read_dir(data)
            .unwrap()
            .map(|folder| folder.unwrap().path())
            .filter(|path| path.is_dir() && path.file_name().is_some_and(|name| name != "machines"));
        for file in folders.flat_map(|folder| fs::read_dir(folder).unwrap().map(|file| file.unwrap().path()))
        {
            let text = fs::read_to_string(&file).unwrap();
            let name = file.file_name().unwrap().to_str().unwrap();
            let read = match name {
                "control.toml" => toml::from_str::<ControlFile>(&text).map(|_| ()),
                "groups.toml" => toml::from_str::<GroupsFile>(&text).map(|_| ()),
                "codes-g.toml" | "codes-m.toml" => toml::from_str::<CodesFile>(&text).map(|_| ()),
                "letters.toml" => toml::from_str::<LettersFile>(&text).map(|_| ()),
                "variables.toml" => toml::from_str::<VariablesFile>(&text).map(|_| ()),
                "settings.toml" => toml::from_str::<SettingsFile>(&text).map(|_| ()),
                "alarms.toml" => toml::from_str::<AlarmsFile>(&text).map(|_| ()),
                "commands.toml" => toml::from_str::<SystemCommands>(&text).map(|_| ()),
                "execution.toml" => toml::from_str::<ExecutionFile>(&text).map(|_| ()),
                _ => panic!("{}: a file that is not read", file.display()),
            };
            read.unwrap_or_else(|error| panic!("{}: {error}", file.display()));
        }
    }
}
