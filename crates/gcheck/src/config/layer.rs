//! One configuration text, read and checked: patterns compiled, codes parsed, paths resolved.
//!
//! Knows: what a text says by itself. Must not know: which programs it rules over, or other layers.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use gcheck_controls::{Control, UserCode};

use super::execution_facts::ExecutionFacts;
use super::file::{FilesTable, OverrideTable, RulesTable};
use super::text::Text;
use super::{ConfigFile, FormatTable, MachineTable, PathPattern, Preset, validate};
use crate::Problem;

/// A configuration text that has been checked.
#[derive(Debug)]
pub struct Layer {
    /// The file; none for `--config KEY=VALUE`.
    pub path: Option<PathBuf>,
    /// As written.
    pub file: ConfigFile,
    /// What the machine's preset says, below everything else of this text.
    pub(super) preset: Option<Facts>,
    /// What holds for every program.
    pub(super) base: Facts,
    /// What holds for some.
    pub(super) overrides: Vec<(Vec<PathPattern>, Facts)>,
    pub(super) per_file_ignores: Vec<(PathPattern, Vec<String>)>,
    pub(super) include: Option<Vec<PathPattern>>,
    pub(super) exclude: Vec<PathPattern>,
    origin: Origin,
}

/// The text that a layer was read from, for messages of what shows up later.
#[derive(Debug)]
struct Origin {
    name: String,
    text: String,
    folder: PathBuf,
    /// Messages may show lines of it.
    may_be_quoted: bool,
}

/// What a layer, or an override in it, says about programs.
#[derive(Debug, Clone, Default)]
pub(super) struct Facts {
    pub(super) control: Option<String>,
    pub(super) machine: MachineTable,
    pub(super) settings: Vec<(String, String)>,
    pub(super) codes: Vec<UserCode>,
    pub(super) execution: ExecutionFacts,
    pub(super) search: Vec<PathBuf>,
    pub(super) rules: RulesTable,
    pub(super) format: FormatTable,
}

impl Layer {
    pub(super) fn new(path: Option<PathBuf>, file: ConfigFile, text: Text<'_>) -> Result<Self, Problem> {
        let facts = validate::Checked::new(text, file.control.as_ref())?;
        let others = file.overrides.iter().filter_map(|table| Some(table.control.as_ref()?.value.as_str()));
        let others: Vec<&str> = others.collect();
        // Nothing else speaks of these machines.
        let is_whole = path.is_some()
            && file.extend.is_none()
            && file.overrides.is_empty()
            && file.machine.preset.is_none();
        let base = Facts {
            control: file.control.as_ref().map(|c| c.value.clone()),
            machine: facts.machine(&file.machine, is_whole)?,
            settings: facts.settings(&file.settings, &others)?,
            codes: facts.codes(&file.codes)?,
            execution: facts.execution(
                &file.machine,
                &file.variables,
                &file.offsets,
                &file.tools,
                is_whole,
            )?,
            search: text.search(&file.search)?,
            rules: facts.rules(&file.rules)?,
            format: file.format.clone(),
        };
        let preset = Preset::inherited(&file.machine, text)?;
        if let Some(preset) = &preset {
            facts.against_preset(&file.machine, &preset.machine)?;
        }
        let preset = preset.map(inheriting);
        let mut overrides = Vec::new();
        for table in &file.overrides {
            if table.files.is_empty() {
                let message = "`[[overrides]]` without `files` applies to no program";
                return Err(match &table.control {
                    Some(control) => text.problem(control, message),
                    None => Problem::with_file(Path::new(text.name), message),
                }
                .help("say to which: `files = [\"lathe/**\"]`"));
            }
            let (patterns, own) = overriding(text, &file, table)?;
            if let Some(preset) = Preset::inherited(&table.machine, text)? {
                overrides.push((patterns.clone(), inheriting(preset)));
            }
            overrides.push((patterns, own));
        }
        let mut per_file_ignores = Vec::new();
        for (pattern, selectors) in &file.per_file_ignores {
            facts.selectors(selectors)?;
            per_file_ignores
                .push((text.pattern(pattern)?, selectors.iter().map(|s| s.value.clone()).collect()));
        }
        let FilesTable { include, exclude } = &file.files;
        let include = include.as_ref().map(|patterns| text.patterns(patterns)).transpose()?;
        let exclude = text.patterns(exclude)?;
        let origin = Origin {
            name: text.name.to_owned(),
            text: text.text.to_owned(),
            folder: text.folder.to_owned(),
            may_be_quoted: true,
        };
        Ok(Self { path, file, preset, base, overrides, per_file_ignores, include, exclude, origin })
    }

    /// The same, of a file of which messages show nothing.
    pub(super) fn unquoted(mut self) -> Self {
        self.origin.may_be_quoted = false;
        self
    }

    /// Whether what it says of a program, for no control that it names itself, is right on the control that runs the program.
    pub(super) fn hold_to(&self, path: &Path, control: &Arc<Control>) -> Result<(), Problem> {
        if self.file.control.is_some() {
            return Ok(());
        }
        let Origin { name, text, folder, may_be_quoted } = &self.origin;
        let checked = validate::Checked::of(Text { name, text, folder }, Arc::clone(control));
        let of_file = || {
            let ConfigFile { machine, settings, codes, offsets, .. } = &self.file;
            checked.on_control(machine, settings, codes, offsets)?;
            // Both are in the order of the file.
            for (table, (patterns, _)) in self.file.overrides.iter().zip(self.own_overrides()) {
                if table.control.is_none() && patterns.iter().any(|pattern| pattern.fits_or_holds(path)) {
                    checked.on_control(&table.machine, &table.settings, &table.codes, &table.offsets)?;
                }
            }
            Ok(())
        };
        of_file().map_err(|problem: Problem| if *may_be_quoted { problem } else { problem.without_text() })
    }

    /// The overrides as they are written, without what their presets say.
    fn own_overrides(&self) -> impl Iterator<Item = &(Vec<PathPattern>, Facts)> {
        self.overrides.iter().filter(|(_, facts)| !facts.execution.is_preset)
    }

    /// What it says about some programs or all.
    fn facts(&self) -> impl Iterator<Item = &Facts> {
        self.preset.iter().chain([&self.base]).chain(self.overrides.iter().map(|(_, facts)| facts))
    }

    /// Tool tables on disk.
    pub(super) fn tables(&self) -> impl Iterator<Item = &Path> {
        self.facts().filter_map(|facts| facts.execution.table.as_deref())
    }

    /// Folders in which called programs are looked for.
    pub(super) fn search(&self) -> impl Iterator<Item = &Path> {
        self.facts().flat_map(|facts| facts.search.iter().map(PathBuf::as_path))
    }
}

/// What a preset says about programs.
fn inheriting(execution: ExecutionFacts) -> Facts {
    Facts { machine: execution.machine.clone(), execution, ..Facts::default() }
}

fn overriding(
    text: Text<'_>,
    file: &ConfigFile,
    table: &OverrideTable,
) -> Result<(Vec<PathPattern>, Facts), Problem> {
    let facts = validate::Checked::new(text, table.control.as_ref().or(file.control.as_ref()))?;
    let mut execution =
        facts.execution(&table.machine, &table.variables, &table.offsets, &table.tools, false)?;
    execution.units = execution.units.or(file.machine.units);
    let own = Facts {
        control: table.control.as_ref().map(|c| c.value.clone()),
        machine: facts.machine(&table.machine, false)?,
        settings: facts.settings(&table.settings, &[])?,
        codes: facts.codes(&table.codes)?,
        execution,
        search: text.search(&table.search)?,
        rules: facts.rules(&table.rules)?,
        format: table.format.clone(),
    };
    Ok((text.patterns(&table.files)?, own))
}
