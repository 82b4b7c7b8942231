//! A run of a document, event by event, for what is made of its moves.
//!
//! Knows: which file and line an event belongs to, where the control would stop. Must not know: what is made of the moves.

use gcheck_controls::Machine as MachineKind;
use gcheck_db::{Cancelled, Snapshot};
use gcheck_engine::{
    Assumption, At, Axis, BlockLines, CallLines, Concrete, Ending, Event, Fault, Machine, Model, Observer,
    Options, Origin, Position, Program, State, Stop, Stopped, Units, outline_cycle, run,
};
use gcheck_lint::fault_words;
use gcheck_toolpath::{Beside, Spot, Step, View};

use crate::caller::Caller;
use crate::state_reader::StateReader;

/// What a run shows.
pub(crate) enum Shown<'s> {
    /// Something happened.
    Event(&'s Step<'s>),
    /// A run past alarms comes to a block at which the control would stop, or to a decision that nobody knows.
    Alarm { file: &'s str, line: u32, fault: &'s Fault, words: &'s str },
    /// A block is the first whose moves rest on something that nobody knows.
    Assumed { file: &'s str, line: u32, words: &'s str, assumption: &'s Assumption },
}

/// How a run of a document came to its end.
pub(crate) struct Ran {
    /// Why it did not reach the program's end, in a few words.
    pub(crate) stopped: Option<String>,
    /// It ended as a subprogram does, with nobody to return to.
    pub(crate) is_subprogram: bool,
}

/// Most blocks of a run that somebody waits for: half a second to three of them. A loop that is half typed has no end, and a
/// picture shows no more of a longer one.
const MOST_BLOCKS: u64 = 3_000_000;

/// Runs a document for a picture of its path: past alarms, from a control that was just switched on.
///
/// A subprogram by itself is run as if it were called at zero of all axes, since its increments lead nowhere without a start;
/// a macro with the arguments of a caller. `begin` is told of the machine before each run, and makes what is shown of it.
///
/// # Errors
/// [`Cancelled`] when `stop` said yes.
pub(crate) fn picture<T>(
    snapshot: &Snapshot,
    caller: Option<&Caller>,
    fuel: u64,
    stop: &dyn Fn() -> bool,
    mut begin: impl FnMut(&Machine) -> T,
    show: impl Fn(&mut T, &Shown<'_>),
) -> Result<Pictured<T>, Cancelled> {
    let told = &snapshot.settings().machine.engine;
    let mut machine = told.just_switched_on(snapshot.control());
    for (variable, value) in caller.into_iter().flat_map(|caller| &caller.variables) {
        machine.variables.entry(*variable).or_insert(*value);
    }
    let blocks = u64::from(snapshot.flow_graph().blocks());
    let fuel = fuel.min(MOST_BLOCKS.max(blocks.saturating_mul(4)));
    let mut go = |machine: Machine| {
        let mut shown = begin(&machine);
        let ran = run_through(snapshot, &machine, Options::PICTURE, fuel, stop, &mut |what| {
            show(&mut shown, what);
        })?;
        Ok((shown, ran, machine))
    };
    // What is called by others has no feed, speed or tool of its own.
    let (shown, ran, machine) = go(machine)?;
    if !ran.is_subprogram || told.start.is_some() {
        return Ok(Pictured { shown, ran, machine, is_at_zero: false });
    }
    let (shown, ran, machine) = go(Machine { start: Some(Position::ZERO), is_called: true, ..machine })?;
    Ok(Pictured { shown, ran, machine, is_at_zero: true })
}

/// A run for a picture.
pub(crate) struct Pictured<T> {
    /// What was made of what it showed.
    pub(crate) shown: T,
    pub(crate) ran: Ran,
    /// On which it ran.
    pub(crate) machine: Machine,
    /// It is a subprogram by itself, as if it were called at zero of all axes.
    pub(crate) is_at_zero: bool,
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
        let mut watcher = Watcher {
            program,
            model,
            machine,
            units,
            lines,
            calls: CallLines::default(),
            cycle: None,
            stop,
            stopped: false,
            show,
        };
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
        Ok(Ran { stopped, is_subprogram })
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
    calls: CallLines,
    /// The block under way, where it is a cycle that moves along the outline in other blocks.
    cycle: Option<At>,
    stop: &'a dyn Fn() -> bool,
    /// It said yes.
    stopped: bool,
    show: &'a mut dyn FnMut(&Shown<'_>),
}

impl Observer<Concrete> for Watcher<'_> {
    fn before(&mut self, origin: Origin, _: &State<Concrete>) {
        self.cycle = outline_cycle(self.program, self.model, origin);
    }

    fn event(&mut self, origin: Origin, state: &State<Concrete>, event: &Event) {
        // The switch of the optional stop is off.
        if matches!(event, Event::Stop(Stop::Optional)) {
            return;
        }
        let (name, line) = self.lines.of(self.program, origin);
        let spot = Spot { file: &name, line, n: origin.n };
        let seen = Step::seen(event, state, self.model, self.machine, spot, self.units);
        let cycle = self.cycle.filter(|cycle| *cycle != origin.at);
        let calls = self.calls.of(self.program, &mut self.lines, state, cycle);
        let step = Step { beside: Beside::of(state, self.machine, event), calls, ..seen };
        (self.show)(&Shown::Event(&step));
    }

    fn fault(&mut self, origin: Origin, state: &State<Concrete>, fault: &Fault) {
        let (name, line) = self.lines.of(self.program, origin);
        let words = fault_words::at_block(fault, self.program, self.model, origin, state, self.units).message;
        (self.show)(&Shown::Alarm { file: &name, line, fault, words: &words });
    }

    fn assumed(&mut self, origin: Origin, assumption: &Assumption) {
        if let Some(words) = gcheck_lint::in_picture(assumption, self.model) {
            let (name, line) = self.lines.of(self.program, origin);
            (self.show)(&Shown::Assumed { file: &name, line, words: &words, assumption });
        }
    }

    fn stops(&mut self) -> bool {
        self.stopped |= (self.stop)();
        self.stopped
    }
}
