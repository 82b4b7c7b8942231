//! A program ready to be executed, with what is in force for it.
//!
//! Knows: how configuration, control, machine and called programs come together. Must not know: how it is executed.

use std::path::PathBuf;
use std::sync::Arc;

use gcheck_controls::Control;
use gcheck_engine::{Model, Options, Program};
use gcheck_program::{Dialect, Heading, Headings, Loaded, ToolNames};
use gcheck_syntax::SourceText;

use super::equipment::{AxesSeen, Equipment, Start};
use crate::args::{ExecutionOptions, Global, Switch};
use crate::config::{Configs, validate_control};
use crate::control_choice::{Chosen, choose};
use crate::neighbours::Neighbours;
use crate::programs::{ProgramFolders, Reachable};
use crate::{Problem, paths, reading};

/// Everything that a run needs, read and checked.
pub(crate) struct Prepared {
    pub(crate) source: SourceText,
    /// As messages call the program.
    pub(crate) shown: String,
    pub(crate) chosen: Chosen,
    pub(crate) control: Arc<Control>,
    pub(crate) equipment: Equipment,
    pub(super) options: Options,
    pub(super) fuel: u64,
    pub(crate) path: PathBuf,
    pub(crate) search: Vec<PathBuf>,
    /// What the folders hold that calls are looked for in.
    folders: Arc<ProgramFolders>,
}

/// Reads the program and what is in force for it.
pub(crate) fn prepare(
    global: &Global,
    options: &ExecutionOptions,
    start: Start,
) -> Result<Prepared, Problem> {
    if let Some(name) = &global.control {
        validate_control(name).map_err(Problem::new)?;
    }
    let conditions = &options.conditions;
    let is_standard_input = paths::is_standard_input(&options.file);
    let path = if is_standard_input {
        conditions.stdin_filename.clone().unwrap_or_else(|| PathBuf::from("stdin"))
    } else {
        options.file.clone()
    };
    if !is_standard_input && path.is_dir() {
        return Err(Problem::with_file(&path, "is a folder; name one program"));
    }
    let config = Configs::new(&global.config, global.isolated)?.of_file(&path)?;
    let source = if is_standard_input { reading::standard_input(&path) } else { reading::file(&path) }?;
    let settings = config.settings(&path);
    let from = settings.control.as_deref().map(|name| (name, settings.control_from.as_deref()));
    let chosen = choose(&path, &source, global.control.as_deref(), from, &Neighbours::default())?;
    chosen.refuse_unsupported(&path)?;
    let plain = gcheck_controls::load(&chosen.choice.name);
    let plain = plain.map_err(|error| Problem::new(error.to_string()))?;
    let control =
        if settings.codes.is_empty() { plain } else { Arc::new(plain.with_user_codes(&settings.codes)) };
    config.hold_to(&path, &control)?;
    let mut equipment = Equipment::new(&settings, &Model::new(&control), start)?;
    equipment.set(&conditions.set);
    Ok(Prepared {
        shown: paths::shown(&path),
        source,
        chosen,
        control,
        equipment,
        options: Options {
            skip: conditions.block_skip.0,
            optional_stop: conditions.optional_stop == Switch::On,
            ..Options::NONE
        },
        fuel: conditions.fuel,
        search: settings.search,
        path,
        folders: Arc::default(),
    })
}

impl Prepared {
    /// The switches that it runs under.
    pub(crate) const fn options(&self) -> Options {
        self.options
    }

    /// Blocks that may be executed.
    pub(crate) const fn fuel(&self) -> u64 {
        self.fuel
    }

    /// Another text of the same program, with everything else as it is; `shown` is what messages call it.
    pub(crate) fn with_text(&self, source: SourceText, shown: String) -> Self {
        Self {
            source,
            shown,
            chosen: self.chosen.clone(),
            control: Arc::clone(&self.control),
            equipment: self.equipment.clone(),
            options: self.options,
            fuel: self.fuel,
            path: self.path.clone(),
            search: self.search.clone(),
            folders: Arc::clone(&self.folders),
        }
    }

    /// The same program among others of a run, which look through each folder once.
    pub(crate) fn among(self, folders: Arc<ProgramFolders>) -> Self {
        Self { folders, ..self }
    }
}

/// A program ready to be executed.
pub(crate) struct Session<'s> {
    pub(crate) prepared: &'s Prepared,
    pub(crate) program: &'s Program<'s>,
    pub(crate) model: &'s Model<'s>,
    pub(super) axes: &'s AxesSeen<'s>,
    pub(super) tools: &'s ToolNames<'s>,
    /// What comments of the file call the blocks after them.
    pub(crate) headings: &'s [Heading],
}

impl Session<'_> {
    /// The axes of the machine as configured; without that, those that the program names and those that every machine has.
    pub(crate) fn axes_of_machine(&self) -> Vec<gcheck_engine::Axis> {
        let configured = self.prepared.equipment.machine.axes.clone();
        configured.unwrap_or_else(|| self.axes.axes(None))
    }
}

impl Prepared {
    /// Loads the program and hands it on.
    pub(crate) fn session<R>(&self, with: impl FnOnce(&Session<'_>) -> R) -> R {
        let dialect = Dialect::new(&self.control);
        let model = Model::new(&self.control);
        let library = Reachable::new(Arc::clone(&self.folders), &self.path, &self.search);
        let mut axes = AxesSeen::new(&model);
        let mut tools = ToolNames::new(&self.control);
        let mut headings = Headings::default();
        let loaded = Loaded::new(self.source.text(), &dialect, |base, table, text| {
            axes.look(table);
            tools.look(table, text);
            headings.look(base, table, text);
        });
        let headings = headings.into_found();
        let program = Program::new(loaded, &dialect, &library);
        with(&Session {
            prepared: self,
            program: &program,
            model: &model,
            axes: &axes,
            tools: &tools,
            headings: &headings,
        })
    }
}
