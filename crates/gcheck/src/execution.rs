//! From a program file to a run of it: what `run`, `stats` and everything else that executes programs share.
//!
//! Knows: that a session is executed and its events become steps. Must not know: what is made of the moves.

mod bridge;
mod closing;
mod equipment;
mod rotary;
mod session;
mod steps;
mod tool_table;

use std::ops::Range;
use std::path::Path;

use gcheck_engine::{Axis, Options, RunResult};
use gcheck_toolpath::View;

pub(crate) use closing::{Rests, control_line, end_of_run, fault_of, problem_of};
pub(crate) use equipment::{Equipment, Start};
pub(crate) use session::{Prepared, Session, prepare};
pub(crate) use steps::Steps;

use crate::{Problem, config};

use bridge::Bridge;
use equipment::AxesMoved;

impl Session<'_> {
    /// Executes the program; `steps` sees every event. The error is that of the output, which ends the run early.
    pub(crate) fn run<S: Steps>(&self, steps: S) -> std::io::Result<(RunResult, S)> {
        self.run_with(self.prepared.options, steps)
    }

    /// Does a block say in which units it is written?
    pub(crate) fn says_units(&self) -> bool {
        self.axes.says_units
    }

    /// As [`Self::run`]; a fault does not end it.
    pub(crate) fn run_past_alarms<S: Steps>(&self, steps: S) -> std::io::Result<(RunResult, S)> {
        self.run_with(Options { past_alarms: true, ..self.prepared.options }, steps)
    }

    /// As [`Self::run_past_alarms`], for a picture: what nobody can know is taken as it most likely is.
    pub(crate) fn run_for_picture<S: Steps>(&self, steps: S) -> std::io::Result<(RunResult, S)> {
        self.run_with(Options { past_alarms: true, assumes: true, ..self.prepared.options }, steps)
    }

    fn run_with<S: Steps>(&self, options: Options, steps: S) -> std::io::Result<(RunResult, S)> {
        let Prepared { equipment, fuel, .. } = self.prepared;
        let mut bridge = Bridge::new(self, steps);
        let ran = bridge::stopping_at_errors(|| {
            gcheck_engine::run(self.program, self.model, &equipment.machine, options, *fuel, &mut bridge)
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

/// The numbers of the tools in the text of a tool table, in its order; the error points at what is wrong.
pub(crate) fn tool_table_of(
    name: &str,
    text: &str,
    is_csv: bool,
    units: config::Units,
) -> Result<Vec<u32>, Problem> {
    let read = tool_table::parsed(name, text, is_csv, equipment::units(units))?;
    Ok(read.tools.iter().map(|(number, _)| *number).collect())
}

/// Bytes of the line that a tool has in the text of a tool table.
pub(crate) fn line_of_tool(path: &Path, text: &str, tool: u32) -> Option<Range<usize>> {
    tool_table::line_of(text, tool_table::is_csv(path), tool)
}

/// The text of a tool table on disk.
pub(crate) fn text_of_tool_table(path: &Path) -> Option<String> {
    tool_table::source(path).ok().map(|source| source.text().to_owned())
}

/// The exit code of a run: 0 it came to its end, 1 it did not, or the control would have stopped on the way.
pub(crate) fn exit_code(result: &RunResult) -> u8 {
    u8::from(!(result.alarms.is_empty() && result.stopped.is_program_end()))
}
