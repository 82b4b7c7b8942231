//! `gcheck.toml`: finding it, reading it, and what it says about one program.
//!
//! Knows: which configuration rules over which file, how several are put together. Must not know: how programs are checked.

mod execution_facts;
mod file;
mod format;
mod layer;
mod listed_names;
mod pattern;
mod placed;
mod preset;
mod preset_name;
mod read;
mod settings;
mod text;
mod validate;

use std::collections::HashMap;
use std::path::{Path, PathBuf};
use std::sync::Arc;

pub use execution_facts::ExecutionFacts;
pub use file::{
    ByAxis, CodeTable, ConfigFile, FilesTable, Level, MachineTable, OverrideTable, Rotary, RulesTable,
    Scalar, SearchTable, ToolChanger, ToolTable, ToolsTable, Units,
};
pub use format::FormatTable;
pub use layer::Layer;
pub use pattern::PathPattern;
pub use placed::Placed;
pub use preset::Preset;
pub use preset_name::PresetName;
pub(crate) use read::{check_text, in_words, layer_of_text};
pub use settings::{FileSettings, RuleWishes};
pub(crate) use validate::{
    JERK_ALONE, NO_LINEAR, implausible_acceleration, rotary_axis, unknown_rule, validate_control, work_offset,
};

use crate::{Problem, paths};

/// Names under which a configuration is found, the first one first.
pub const FILE_NAMES: [&str; 2] = ["gcheck.toml", ".gcheck.toml"];
/// The schema beside the configuration: editors read it from there, of the version that wrote it and without a network.
pub const SCHEMA_FILE: &str = "gcheck.schema.json";

/// A configuration with everything it extends; the most basic layer first.
#[derive(Debug, Default)]
pub struct Config {
    layers: Vec<Arc<Layer>>,
}

impl Config {
    /// A configuration of one text.
    pub(crate) fn of_layer(layer: Arc<Layer>) -> Self {
        Self { layers: vec![layer] }
    }

    /// Its layers, the most basic first.
    pub fn layers(&self) -> &[Arc<Layer>] {
        &self.layers
    }

    /// The file that was found or named, without those it extends.
    pub fn path(&self) -> Option<&Path> {
        self.layers.iter().rev().find_map(|layer| layer.path.as_deref())
    }

    /// Files besides programs that a verdict may rest on: the configurations themselves and the tool tables they name.
    pub(crate) fn files(&self) -> impl Iterator<Item = &Path> {
        self.layers.iter().flat_map(|layer| layer.path.as_deref().into_iter().chain(layer.tables()))
    }

    /// Folders besides a program's own in which called programs are looked for.
    pub(crate) fn search(&self) -> impl Iterator<Item = &Path> {
        self.layers.iter().flat_map(|layer| layer.search())
    }

    /// Whether what it says of the program at `path` without naming a control is right on the one that runs it: where no
    /// configuration names the control, that shows only here.
    ///
    /// # Errors
    /// The first value that the control does not have, at its place.
    pub(crate) fn hold_to(
        &self,
        path: &Path,
        control: &Arc<gcheck_controls::Control>,
    ) -> Result<(), Problem> {
        let path = paths::absolute(path);
        self.layers.iter().try_for_each(|layer| layer.hold_to(&path, control))
    }

    /// Whether a walk over a folder reads a file: neither excluded nor, where `include` is given, left out by it.
    pub fn wants(&self, path: &Path, is_program: bool) -> bool {
        let path = paths::absolute(path);
        let include = self.layers.iter().rev().find_map(|layer| layer.include.as_ref());
        let included = include.map_or(is_program, |patterns| patterns.iter().any(|p| p.fits(&path)));
        included && !self.layers.iter().flat_map(|layer| &layer.exclude).any(|p| p.fits_or_holds(&path))
    }
}

/// All configurations of a run, each read once.
#[derive(Debug)]
pub struct Configs {
    /// From `--config KEY=VALUE`, over everything else.
    inline: Vec<Arc<Layer>>,
    source: Source,
    by_folder: HashMap<PathBuf, Result<Arc<Config>, Problem>>,
    /// By the file's own path, so that two folders under one configuration share it.
    by_file: HashMap<PathBuf, Result<Arc<Config>, Problem>>,
}

/// Where configurations come from.
#[derive(Debug)]
enum Source {
    /// The nearest ancestor of each program.
    Discovered,
    /// The same for every program: `--config FILE`, or nothing with `--isolated`.
    Fixed(Arc<Config>),
}

impl Configs {
    /// From the options of the command line: each of `arguments` is a file or `KEY=VALUE`.
    pub fn new(arguments: &[String], isolated: bool) -> Result<Self, Problem> {
        let mut inline = Vec::new();
        let mut file: Option<&str> = None;
        for argument in arguments {
            if argument.contains('=') && !Path::new(argument).exists() {
                inline.push(Arc::new(read::inline(argument)?));
            } else if file.replace(argument).is_some() {
                return Err(Problem::new("`--config` names two files; let one of them `extend` the other"));
            }
        }
        let source = match file {
            Some(_) if isolated => {
                return Err(Problem::new(
                    "`--isolated` means no configuration file, and `--config` names one",
                ));
            }
            Some(file) => {
                let mut layers = read::file_with_bases(Path::new(file))?;
                layers.extend(inline.iter().cloned());
                Source::Fixed(Arc::new(Config { layers }))
            }
            None if isolated => Source::Fixed(Arc::new(Config { layers: inline.clone() })),
            None => Source::Discovered,
        };
        Ok(Self { inline, source, by_folder: HashMap::new(), by_file: HashMap::new() })
    }

    /// The configurations read so far.
    pub(crate) fn read(&self) -> Vec<Arc<Config>> {
        match &self.source {
            Source::Fixed(config) => vec![Arc::clone(config)],
            Source::Discovered => {
                let mut read: Vec<(&PathBuf, &Arc<Config>)> = self
                    .by_file
                    .iter()
                    .filter_map(|(path, config)| Some((path, config.as_ref().ok()?)))
                    .collect();
                read.sort_by_key(|(path, _)| *path);
                read.into_iter().map(|(_, config)| Arc::clone(config)).collect()
            }
        }
    }

    /// The configuration of a program, or why it cannot be read.
    pub fn of_file(&mut self, path: &Path) -> Result<Arc<Config>, Problem> {
        let path = paths::absolute(path);
        self.of_folder(path.parent().unwrap_or(&path))
    }

    /// The configuration of what is in a folder.
    pub fn of_folder(&mut self, folder: &Path) -> Result<Arc<Config>, Problem> {
        if let Source::Fixed(config) = &self.source {
            return Ok(Arc::clone(config));
        }
        let folder = paths::absolute(folder);
        if let Some(known) = self.by_folder.get(&folder) {
            return known.clone();
        }
        let found = folder.ancestors().find_map(|ancestor| {
            FILE_NAMES
                .iter()
                .map(|name| ancestor.join(name))
                .find(|candidate| candidate.symlink_metadata().is_ok())
        });
        let config = match found {
            Some(file) => match self.by_file.get(&file) {
                Some(known) => known.clone(),
                None => {
                    let config = read::file_with_bases(&file).map(|mut layers| {
                        layers.extend(self.inline.iter().cloned());
                        Arc::new(Config { layers })
                    });
                    self.by_file.insert(file, config.clone());
                    config
                }
            },
            None => Ok(Arc::new(Config { layers: self.inline.clone() })),
        };
        self.by_folder.insert(folder, config.clone());
        config
    }
}

/// The JSON schema of `gcheck.toml`.
pub(crate) fn json_schema() -> schemars::Schema {
    let mut schema = schemars::schema_for!(ConfigFile);
    file::describe_overrides(&mut schema);
    schema
}

/// The JSON schema of `gcheck.toml`, as `gcheck schema` prints it.
pub fn schema() -> String {
    let mut text = serde_json::to_string_pretty(&json_schema()).unwrap_or_default();
    text.push('\n');
    text
}
