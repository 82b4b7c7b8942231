//! A run of a program, block by block and act by act.
//!
//! Knows: which acts belong to which block, which line a block is in, which blocks are selected. Must not know: what is made
//! of them.
//!
//! Under cutter compensation a move shows only when the next one is known, so that acts come with the block that they are of.

use gcheck_engine::{
    At, Axis, BlockLines, Concrete, Event, Machine, Model, Observer, Options, Origin, Position, Program,
    RunResult, State, Stop, Units,
};
use gcheck_program::Place;
use gcheck_toolpath::{Act, Beside, Doing, Driven, Spot, Step, Trail, WorkCoordinates};

use crate::facts::Facts;
use crate::refusal::Refusal;
use crate::scope::Scope;

/// A block that was executed.
pub(crate) struct Executed<'a> {
    pub(crate) at: At,
    /// Bytes of its file.
    pub(crate) start: u32,
    pub(crate) end: u32,
    /// The block with its words.
    pub(crate) place: &'a Place,
    /// The other file that it is in; `None` for the program itself.
    pub(crate) file: Option<&'a str>,
    /// It is one of those that are changed.
    pub(crate) is_selected: bool,
    /// The modes that its words were read in.
    pub(crate) facts: Facts,
    /// It made a move that is not at rapid, as far as its moves have shown.
    pub(crate) has_cut: bool,
    /// The programmed point before it.
    pub(crate) before: Position,
    /// The state after it.
    pub(crate) state: &'a State<Concrete>,
}

impl Executed<'_> {
    /// Why a change is not made, with the block as its place.
    pub(crate) fn refusal(&self, reason: impl Into<String>) -> Refusal {
        Refusal::at(self.start..self.end, reason).in_file(self.file)
    }
}

/// Takes what happens in a run.
pub(crate) trait Visitor {
    /// It wants to see blocks before they are executed.
    const LOOKS_BEFORE: bool = false;

    /// A block is about to be executed in a state.
    fn before(&mut self, at: At, place: &Place, state: &State<Concrete>) {
        let _ = (at, place, state);
    }

    /// Something happened, before its block is over.
    fn event(&mut self, event: &Event) {
        let _ = event;
    }

    /// A block was executed; its acts come after this.
    fn executed(&mut self, block: &Executed<'_>);

    /// Something happened. `is_expanded`: a cycle made the move, and the block's words do not.
    fn act(&mut self, at: At, is_expanded: bool, act: Act);

    /// A block moved the axes in a way that is not followed.
    fn unfollowed(&mut self, start: u32, end: u32, file: Option<&str>);

    /// Has it seen enough?
    fn stops(&self) -> bool {
        false
    }
}

/// Executes a program for a visitor.
pub(crate) fn run<V: Visitor>(
    program: &Program<'_>,
    model: &Model<'_>,
    machine: &Machine,
    options: Options,
    fuel: u64,
    scope: &Scope,
    visitor: &mut V,
) -> RunResult {
    let units = machine.units.or_else(|| model.units_at_power_on(&machine.settings)).unwrap_or(Units::Mm);
    let mut watcher = Watcher {
        program,
        model,
        machine,
        units,
        optional_stop: options.optional_stop,
        scope,
        lines: BlockLines::new(""),
        trail: Trail::new(WorkCoordinates::at_power_on(model, machine)),
        before: Position::UNKNOWN,
        waiting: Vec::new(),
        visitor,
    };
    let result = gcheck_engine::run(program, model, machine, options, fuel, &mut watcher);
    watcher.hand_on();
    result
}

struct Watcher<'a, 'p, V> {
    program: &'a Program<'p>,
    model: &'a Model<'a>,
    machine: &'a Machine,
    units: Units,
    optional_stop: bool,
    scope: &'a Scope,
    lines: BlockLines,
    trail: Trail,
    before: Position,
    /// Acts whose block is not over.
    waiting: Vec<(At, bool, Act)>,
    visitor: &'a mut V,
}

impl<V: Visitor> Watcher<'_, '_, V> {
    fn hand_on(&mut self) {
        for (at, is_expanded, act) in self.waiting.drain(..) {
            self.visitor.act(at, is_expanded, act);
        }
    }
}

/// Is it a move that is not at rapid?
fn is_cut(act: &Act) -> bool {
    matches!(&act.doing, Doing::Move(made) if made.driven != Driven::Rapid)
}

/// Is a move made by a cycle, or by another operation of several moves?
fn is_expanded(event: &Event) -> bool {
    match event {
        Event::Travel(travel) => travel.expanded,
        Event::Arc(arc) => arc.expanded,
        Event::RigidTap { .. } => true,
        _ => false,
    }
}

impl<V: Visitor> Observer<Concrete> for Watcher<'_, '_, V> {
    fn before(&mut self, origin: Origin, state: &State<Concrete>) {
        self.before = *state.position();
        if V::LOOKS_BEFORE
            && let Some(file) = self.program.file(origin.at.file)
            && let Some(place) = file.loaded.place(origin.at.block, self.program.dialect())
        {
            self.visitor.before(origin.at, &place, state);
        }
    }

    fn event(&mut self, origin: Origin, state: &State<Concrete>, event: &Event) {
        if matches!(event, Event::Stop(Stop::Optional)) && !self.optional_stop {
            return;
        }
        self.visitor.event(event);
        let (file, line) = self.lines.of(self.program, origin);
        // A lathe may be anywhere in Y when it drills: no move depends on it.
        let is_lathe = self.model.control().machine() == gcheck_controls::Machine::Lathe;
        let stands = [Axis::X, Axis::Z].into_iter().all(|axis| !self.before.raw(axis).is_nan());
        let drills = state.active_cycle(self.model).is_some_and(gcheck_controls::CodeIx::is_some);
        if *event == Event::Unfollowed && !(is_lathe && stands && drills) {
            self.visitor.unfollowed(origin.start, origin.end, Some(&*file).filter(|name| !name.is_empty()));
        }
        let spot = Spot { file: &file, line, n: origin.n };
        let seen = Step::seen(event, state, self.model, self.machine, spot, self.units);
        let step = Step { beside: Beside::of(state, self.machine, event), ..seen };
        let waiting = &mut self.waiting;
        self.trail.add(&step, |act| waiting.push((origin.at, is_expanded(event), act)));
    }

    fn after(&mut self, origin: Origin, state: &State<Concrete>) {
        if let Some(file) = self.program.file(origin.at.file)
            && let Some(place) = file.loaded.place(origin.at.block, self.program.dialect())
        {
            let facts = Facts::of(place.block(), state, self.model);
            let is_main = origin.at.file == 0;
            self.visitor.executed(&Executed {
                at: origin.at,
                start: origin.start,
                end: origin.end,
                place: &place,
                file: (!is_main).then_some(&*file.name),
                is_selected: is_main && self.scope.selects(origin.start, facts.tool),
                facts,
                has_cut: self.waiting.iter().any(|(at, _, act)| *at == origin.at && is_cut(act)),
                before: self.before,
                state,
            });
        }
        self.hand_on();
    }

    fn stops(&mut self) -> bool {
        self.visitor.stops()
    }
}
