//! From a program file to a run of it: what `run`, `stats` and everything else that executes programs share.
//!
//! Knows: how configuration, control, machine and called programs come together. Must not know: what is made of the moves.

mod bridge;
mod closing;
mod equipment;
mod rotary;
mod tool_table;

use std::path::PathBuf;
use std::sync::Arc;

use gcheck_controls::Control;
use gcheck_engine::{Axis, Model, Options, Program, RunResult, Stopped};
use gcheck_program::{Dialect, Loaded, ToolNames};
use gcheck_report::ControlChoice;
use gcheck_syntax::SourceText;
use gcheck_toolpath::View;

pub(crate) use bridge::Steps;
pub(crate) use closing::{Rests, control_line, end_of_run, fault_of, problem_of, say};
pub(crate) use equipment::{Equipment, Start};

use crate::args::{ExecutionOptions, Global, Switch};
use crate::config::{Configs, validate_control};
use crate::control_choice::choose;
use crate::programs::Reachable;
use crate::{Problem, paths, reading};
use bridge::Bridge;
use equipment::{AxesMoved, AxesSeen};

/// Standard input as a file name.
const STANDARD_INPUT: &str = "-";

/// Everything that a run needs, read and checked.
pub(crate) struct Prepared {
    pub(crate) source: SourceText,
    /// As messages call the program.
    pub(crate) shown: String,
    pub(crate) choice: ControlChoice,
    pub(crate) control: Arc<Control>,
    pub(crate) equipment: Equipment,
    options: Options,
    fuel: u64,
    pub(crate) path: PathBuf,
    pub(crate) search: Vec<PathBuf>,
}

/// Reads the program and what is in force for it.
pub(crate) fn prepare(global: &Global, options: &ExecutionOptions) -> Result<Prepared, Problem> {
    if let Some(name) = &global.control {
        validate_control(name).map_err(Problem::new)?;
    }
    let is_standard_input = options.file.as_os_str() == STANDARD_INPUT;
    let path = if is_standard_input {
        options.stdin_filename.clone().unwrap_or_else(|| PathBuf::from("stdin"))
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
    let choice = choose(&path, &source, global.control.as_deref(), from)?;
    let plain = gcheck_controls::load(&choice.name).map_err(|error| Problem::new(error.to_string()))?;
    let control =
        if settings.codes.is_empty() { plain } else { Arc::new(plain.with_user_codes(&settings.codes)) };
    let mut equipment = Equipment::new(&settings, &Model::new(&control), Start::Fresh)?;
    equipment.set(&options.set);
    Ok(Prepared {
        shown: paths::shown(&path),
        source,
        choice,
        control,
        equipment,
        options: Options { skip: options.block_skip.0, optional_stop: options.optional_stop == Switch::On },
        fuel: options.fuel,
        search: settings.search,
        path,
    })
}

/// A program ready to be executed.
pub(crate) struct Session<'s> {
    pub(crate) prepared: &'s Prepared,
    pub(crate) program: &'s Program<'s>,
    pub(crate) model: &'s Model<'s>,
    axes: &'s AxesSeen<'s>,
    tools: &'s ToolNames<'s>,
}

impl Prepared {
    /// Loads the program and hands it on.
    pub(crate) fn session<R>(&self, with: impl FnOnce(&Session<'_>) -> R) -> R {
        let dialect = Dialect::new(&self.control);
        let model = Model::new(&self.control);
        let library = Reachable::new(Arc::default(), &self.path, &self.search);
        let mut axes = AxesSeen::new(&model);
        let mut tools = ToolNames::new(&self.control);
        let loaded = Loaded::new(self.source.text(), &dialect, |_, table, text| {
            axes.look(table);
            tools.look(table, text);
        });
        let program = Program::new(loaded, &dialect, &library);
        with(&Session { prepared: self, program: &program, model: &model, axes: &axes, tools: &tools })
    }
}

impl Session<'_> {
    /// Executes the program; `steps` sees every event. The error is that of the output, which ends the run early.
    pub(crate) fn run<S: Steps>(&self, steps: S) -> std::io::Result<(RunResult, S)> {
        let Prepared { equipment, options, fuel, .. } = self.prepared;
        let mut bridge = Bridge::new(self, steps);
        let ran = bridge::stopping_at_errors(|| {
            gcheck_engine::run(self.program, self.model, &equipment.machine, *options, *fuel, &mut bridge)
        });
        bridge.finish(ran)
    }

    /// The axes that the machine has, as far as known; for output that other programs read.
    pub(crate) fn all_axes(&self) -> View {
        let machine = self.prepared.equipment.machine.axes.clone();
        self.view(&machine.unwrap_or_else(|| equipment::axes_of(self.model)))
    }

    /// The axes that the program moves; for output that people read. What a called program moves shows only when it runs.
    pub(crate) fn used_axes(&self) -> View {
        let named = self.axes.axes(self.prepared.equipment.machine.axes.as_deref());
        if !self.axes.calls {
            return self.view(&named);
        }
        match self.run(AxesMoved::default()) {
            Ok((_, moved)) => self.view(&moved.and(&named)),
            Err(_) => self.all_axes(),
        }
    }

    /// What a tool is called: by the program, else by the tool table.
    pub(crate) fn tool_name(&self, tool: u32) -> Option<String> {
        let remark = || self.prepared.equipment.remarks.get(&tool).map(String::as_str);
        self.tools.get(tool).or_else(remark).map(str::to_owned)
    }

    fn view(&self, axes: &[Axis]) -> View {
        let view = View::new(axes);
        if self.model.semantics().diameter { view.with_diameters() } else { view }
    }
}

/// The exit code of a run: 0 it came to its end, 1 it did not.
pub(crate) fn exit_code(result: &RunResult) -> u8 {
    use gcheck_engine::Ending;
    match result.stopped {
        Stopped::Ended(Ending::Program | Ending::Restart | Ending::Tape | Ending::BarsUsed) => 0,
        Stopped::Ended(Ending::Text | Ending::Alarm(_)) | Stopped::Faulted(_) | Stopped::OutOfFuel => 1,
    }
}
