//! Runs a program of a control on a machine and gathers its figures.

#![expect(clippy::unwrap_used, reason = "a test that meets the unexpected is to fail")]

use gcheck_engine::{
    Axis, Concrete, Event, Fault, Machine, Model, NoLibrary, Observer, Options, Origin, Program, State,
    Units, run,
};
use gcheck_program::{Dialect, Loaded};
use gcheck_toolpath::{Plan, Spot, Statistics, Step, Timing, View};

struct Recorder<'a> {
    model: &'a Model<'a>,
    machine: &'a Machine,
    starts: &'a [usize],
    statistics: Statistics,
    fault: Option<String>,
}

impl Observer<Concrete> for Recorder<'_> {
    fn event(&mut self, origin: Origin, state: &State<Concrete>, event: &Event) {
        let line = self.starts.partition_point(|start| *start <= origin.start as usize);
        let spot = Spot { file: "program", line: u32::try_from(line).unwrap(), n: origin.n };
        let step = Step::seen(event, state, self.model, self.machine, spot, Units::Mm);
        self.statistics.add(&step);
    }

    fn fault(&mut self, _: Origin, _: &State<Concrete>, fault: &Fault) {
        self.fault = Some(format!("{fault:?}"));
    }
}

/// The figures of a program; fails where the control would stop.
pub(crate) fn figures(control: &str, machine: &Machine, text: &str) -> Statistics {
    let control = gcheck_controls::load(control).unwrap();
    let model = Model::new(&control);
    let dialect = Dialect::new(&control);
    let loaded = Loaded::new(text, &dialect, |_, _, _| ());
    let program = Program::new(loaded, &dialect, &NoLibrary);
    let timing = Timing::of_machine(&model, machine);
    let plan = Plan::of_machine(&model, machine, &timing);
    let starts: Vec<usize> =
        std::iter::once(0).chain(text.match_indices('\n').map(|(at, _)| at + 1)).collect();
    let view = View::new(&[Axis::X, Axis::Y, Axis::Z]);
    let statistics =
        Statistics::new(view, timing, model.work_at_power_on()).planned(plan.as_ref()).with_stretches();
    let mut recorder = Recorder { model: &model, machine, starts: &starts, statistics, fault: None };
    // The real planner starts with its switch for blocks with `/` on.
    run(&program, &model, machine, Options::SKIP_ALL, 10_000_000, &mut recorder);
    assert_eq!(recorder.fault, None, "{text}");
    recorder.statistics.finish();
    recorder.statistics
}
