//! The state before the first block.
//!
//! Knows: what is told of the machine, what the control's power-on gives, what stays unknown. Must not know: blocks.

use gcheck_controls::{CodeIx, Unset};

use crate::assumption::{Assumption, Assumptions};
use crate::eval::value::{Domain, Truth};
use crate::event::Units;
use crate::lattice::Perhaps;
use crate::machine::Machine;
use crate::model::{Model, Role};
use crate::position::Position;
use crate::state::{
    Bar, Blending, Calls, CompensationState, CoolantState, CycleWords, Feed, KeptTurningWords, Locals,
    Mapping, ModeSet, Modes, Offsets, Points, Probe, SpindleState, State, Tables, ToolShift, ToolState,
    Transform, Variables,
};

/// The state at the start of the main program.
pub(crate) fn start_state<D: Domain>(
    model: &Model<'_>,
    machine: &Machine,
    assumptions: &mut Assumptions,
) -> State<D> {
    let in_force = power_on_modes(model, machine, assumptions);
    if machine.start.is_none() {
        assumptions.insert(Assumption::StartPosition);
    }
    let tables = Tables::of(machine, model.semantics().reference_at_zero);
    let mut state = State {
        points: Points::at(machine.start.unwrap_or(Position::UNKNOWN)),
        variables: variables(model, machine),
        calls: Calls::main(locals(model, machine)),
        feed: Feed::none(*in_force.of(Role::FeedMode)),
        modes: in_force,
        tool: ToolState::at_start(machine.fresh, &tables),
        offsets: Offsets::unshifted(tables, model.work_at_power_on()),
        spindle: SpindleState::stopped(),
        coolant: CoolantState::all(Truth::False),
        cycle: CycleWords::NONE,
        turning: KeptTurningWords::default(),
        transform: mirrored_by_settings(model, machine),
        mapping: Mapping::default(),
        compensation: CompensationState::default(),
        blending: Blending::NONE,
        curve: Perhaps::No,
        probe: Probe::at_start(machine.fresh),
        tool_shift: ToolShift::NONE,
        bar: Bar::at_start(machine),
        data_entry: Truth::False,
    };
    start_bar_counters(model, machine, &mut state);
    if machine.is_called {
        state.feed.forget();
        state.spindle.forget();
        state.tool.number = D::unknown();
    }
    state
}

fn power_on_modes(model: &Model<'_>, machine: &Machine, assumptions: &mut Assumptions) -> Modes {
    let mut in_force = Modes::new(&[ModeSet::one(CodeIx::NONE); Role::COUNT]);
    for role in Role::ALL {
        if let Some(code) = model.defaults.get(role.index()) {
            in_force.set(role, *code);
            if code.is_some() {
                assumptions.insert(Assumption::StartMode(role, *code));
            }
        }
    }
    let units = machine.units.or_else(|| model.units_at_power_on(&machine.settings));
    if let Some(units) = units {
        let code = model.code_with(match units {
            Units::Inch => gcheck_controls::Effect::Inch,
            Units::Mm => gcheck_controls::Effect::Millimetre,
        });
        in_force.set(Role::Units, code);
        if machine.units.is_none() {
            assumptions.insert(Assumption::StartMode(Role::Units, code));
        }
    }
    in_force
}

/// What a variable holds that was never set.
fn unset<D: Domain>(model: &Model<'_>) -> D::Value {
    match model.semantics().unset {
        Unset::Vacant => D::vacant(),
        Unset::Zero => D::number(0.0),
    }
}

fn variables<D: Domain>(model: &Model<'_>, machine: &Machine) -> Variables<D> {
    let unwritten = if machine.fresh { unset::<D>(model) } else { D::unknown() };
    let kept = |(number, value): (&u32, &f64)| (model.semantics().kept_as(*number), *value);
    let mut variables = Variables::new(unwritten, machine.variables.iter().map(kept));
    for (number, value) in machine.guesses.variables.iter().map(kept) {
        // The control's own are guessed where they are read.
        if !variables.is_written(number) && model.system_variable(number).is_none() {
            variables.narrow(number, D::assumed(D::number(value)));
        }
    }
    variables
}

fn locals<D: Domain>(model: &Model<'_>, machine: &Machine) -> Locals<D> {
    let [first, last] = model.semantics().locals;
    let mut locals = Locals::new(last, &unset::<D>(model));
    for (number, value) in machine.variables.iter().filter(|(number, _)| (first..=last).contains(number)) {
        locals.set(*number, D::number(*value));
    }
    locals
}

/// The mirrors that settings switch on, at the zero of the work.
fn mirrored_by_settings(model: &Model<'_>, machine: &Machine) -> Transform {
    let mut transform = Transform::NONE;
    let settings = &model.semantics().transform_settings.mirrors;
    for (mirror, number) in transform.mirrors_mut().iter_mut().zip(settings) {
        let is_on = machine.settings.get(number).is_some_and(|value| value == "on" || value == "true");
        if is_on {
            *mirror = Perhaps::Yes(0.0);
        }
    }
    transform
}

/// A run begins with its first bar: the counters of the feeder start with it, unless they were told.
fn start_bar_counters<D: Domain>(model: &Model<'_>, machine: &Machine, state: &mut State<D>) {
    let Some(rules) = model.semantics().bar_feeder.as_ref().filter(|_| machine.bar.starts_new) else {
        return;
    };
    for (number, value) in [(rules.parts, 0.0), (rules.bars, 1.0), (rules.run_length, 0.0)] {
        if !state.variables.is_written(number) {
            state.variables.set(number, D::assumed(D::number(value)));
        }
    }
}
