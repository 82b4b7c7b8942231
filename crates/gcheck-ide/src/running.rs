//! A run of a document, event by event, for what is made of its moves.
//!
//! Knows: which file and line an event belongs to, where the control would stop. Must not know: what is made of the moves.

use std::collections::BTreeSet;

use gcheck_controls::Machine as MachineKind;
use gcheck_db::{Cancelled, Snapshot};
use gcheck_engine::{
    Assumption, Axis, BlockLines, Concrete, Ending, Event, Fault, Machine, Model, Observer, Options, Origin,
    Program, State, Stop, Stopped, Units, run,
};
use gcheck_toolpath::{Beside, Spot, Step, View};

use crate::state_reader::StateReader;

/// What a run shows.
pub(crate) enum Shown<'s> {
    /// Something happened.
    Event(&'s Step<'s>),
    /// A run past alarms comes to a block at which the control would stop, or to a decision that nobody knows.
    Alarm { file: &'s str, line: u32, fault: &'s Fault },
}

/// How a run of a document came to its end.
pub(crate) struct Ran {
    /// Why it did not reach the program's end, in a few words.
    pub(crate) stopped: Option<String>,
    /// It ended as a subprogram does, with nobody to return to.
    pub(crate) is_subprogram: bool,
    /// What the run has no moves of, one sentence each: passes of a cycle, a program that is not there.
    pub(crate) without: Vec<String>,
}

/// Runs a document on a machine, at most so many blocks; `show` is shown every event.
///
/// # Errors
/// [`Cancelled`] when `stop`, which is asked now and then, said yes.
pub(crate) fn run_through(
    snapshot: &Snapshot,
    machine: &Machine,
    options: Options,
    fuel: u64,
    stop: &dyn Fn() -> bool,
    show: &mut dyn FnMut(&Shown<'_>),
) -> Result<Ran, Cancelled> {
    if stop() {
        return Err(Cancelled);
    }
    snapshot.with_program(|program, model| {
        let units = machine.units.or_else(|| model.units_at_power_on(&machine.settings)).unwrap_or(Units::Mm);
        let lines = BlockLines::new("");
        let mut watcher = Watcher { program, model, machine, units, lines, stop, stopped: false, show };
        let result = run(program, model, machine, options, fuel, &mut watcher);
        if watcher.stopped {
            return Err(Cancelled);
        }
        let (_, line) = watcher.lines.of(program, result.origin);
        let stopped = (!result.stopped.is_program_end()).then(|| match &result.stopped {
            Stopped::Ended(Ending::Alarm(number)) => format!("alarm {number} of its own in line {line}"),
            Stopped::Ended(_) => "the text ends without a program end".to_owned(),
            Stopped::Faulted(_) => format!("the control would stop in line {line}"),
            Stopped::OutOfFuel => format!("ended after {} blocks", result.blocks),
        });
        let is_subprogram = matches!(result.stopped, Stopped::Ended(Ending::Restart));
        let lost = result.assumptions.iter().filter(|assumption| assumption.leaves_moves_out());
        let lost: BTreeSet<Assumption> = lost.cloned().collect();
        let without = gcheck_lint::describe_all(&lost, model).into_iter().map(|stated| stated.text).collect();
        Ok(Ran { stopped, is_subprogram, without })
    })
}

/// The axes that figures speak of, and whether X is shown as a diameter.
pub(crate) fn view(snapshot: &Snapshot, model: &Model<'_>) -> View {
    let view = View::new(&StateReader::new(snapshot, model).axes());
    if model.semantics().diameter { view.with_diameters() } else { view }
}

/// Is the document turned?
pub(crate) fn is_turned(snapshot: &Snapshot) -> bool {
    snapshot.control().machine() == MachineKind::Lathe
}

/// Names of the axes X, Y and Z by their index in boxes.
pub(crate) const LINEAR: [Axis; 3] = [Axis::X, Axis::Y, Axis::Z];

struct Watcher<'a> {
    program: &'a Program<'a>,
    model: &'a Model<'a>,
    machine: &'a Machine,
    units: Units,
    lines: BlockLines,
    stop: &'a dyn Fn() -> bool,
    /// It said yes.
    stopped: bool,
    show: &'a mut dyn FnMut(&Shown<'_>),
}

impl Observer<Concrete> for Watcher<'_> {
    fn event(&mut self, origin: Origin, state: &State<Concrete>, event: &Event) {
        // The switch of the optional stop is off.
        if matches!(event, Event::Stop(Stop::Optional)) {
            return;
        }
        let (name, line) = self.lines.of(self.program, origin);
        let spot = Spot { file: &name, line, n: origin.n };
        let seen = Step::seen(event, state, self.model, self.machine, spot, self.units);
        let step = Step { beside: Beside::of(state, self.machine, event), ..seen };
        (self.show)(&Shown::Event(&step));
    }

    fn fault(&mut self, origin: Origin, _: &State<Concrete>, fault: &Fault) {
        let (name, line) = self.lines.of(self.program, origin);
        (self.show)(&Shown::Alarm { file: &name, line, fault });
    }

    fn stops(&mut self) -> bool {
        self.stopped |= (self.stop)();
        self.stopped
    }
}
