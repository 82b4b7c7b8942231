//! The state before the first block.
//!
//! Knows: what is told of the machine, what the control's power-on gives, what stays unknown. Must not know: blocks.

use std::collections::BTreeSet;
use std::rc::Rc;

use gcheck_controls::{CodeIx, Unset};
use gcheck_geometry::Mm;

use crate::assumption::Assumption;
use crate::cylinder::{Diameters, Wrapped};
use crate::event::{Spindle, Units};
use crate::machine::{Machine, Tool, WorkOffset};
use crate::modal::ModeSet;
use crate::model::{Model, Role};
use crate::position::Position;
use crate::state::{At, CycleWords, Frame, FrameKind, State, Tables, Transform};
use crate::step::bar::{Bar, start_bar_counters};
use crate::tool_shift::ToolShift;
use crate::touch::Touch;
use crate::value::{Domain, Truth};
use crate::variables::{Locals, Variables};

/// The state at the start of the main program.
#[expect(clippy::too_many_lines, reason = "one line for each part of the state")]
pub(crate) fn start_state<D: Domain>(
    model: &Model<'_>,
    machine: &Machine,
    assumptions: &mut BTreeSet<Assumption>,
) -> State<D> {
    let mut in_force = [ModeSet::one(CodeIx::NONE); Role::COUNT];
    for role in Role::ALL {
        if let (Some(slot), Some(code)) = (in_force.get_mut(role.index()), model.defaults.get(role.index())) {
            *slot = ModeSet::one(*code);
            if code.is_some() {
                assumptions.insert(Assumption::StartMode(role, *code));
            }
        }
    }
    let unit_code =
        machine.units.or_else(|| model.units_at_power_on(&machine.settings)).map(|units| match units {
            Units::Inch => gcheck_controls::Effect::Inch,
            Units::Mm => gcheck_controls::Effect::Millimetre,
        });
    if let (Some(effect), Some(slot)) = (unit_code, in_force.get_mut(Role::Units.index())) {
        let code = model.code_with(effect);
        *slot = ModeSet::one(code);
        if machine.units.is_none() {
            assumptions.insert(Assumption::StartMode(Role::Units, code));
        }
    }
    let position = machine.start.unwrap_or(Position::UNKNOWN);
    if machine.start.is_none() {
        assumptions.insert(Assumption::StartPosition);
    }
    let vacant = match model.semantics().unset {
        Unset::Vacant => D::vacant(),
        Unset::Zero => D::number(0.0),
    };
    let unwritten = if machine.fresh { vacant.clone() } else { D::unknown() };
    let known = machine.variables.iter().map(|(number, value)| (*number, *value));
    let locals = Locals::new(model.semantics().locals[1], &vacant);
    let mut state = State {
        modes: in_force,
        position,
        actual: position,
        tables: Rc::new(tables(machine)),
        work: model.work_at_power_on(),
        in_effect: WorkOffset::UNKNOWN,
        shift: Position::ZERO,
        shift_on: true,
        local: Position::ZERO,
        length: Position::ZERO,
        tool_shift: ToolShift::NONE,
        h: D::number(0.0),
        d: D::number(0.0),
        feed: D::number(0.0),
        feed_word: D::number(0.0),
        feed_given_under: in_force.get(Role::FeedMode.index()).copied().unwrap_or(ModeSet::ANY),
        speed: D::number(0.0),
        speed_limit: f64::INFINITY,
        spindle: Some(Spindle::Stopped),
        live_tool: Truth::False,
        mist: Truth::False,
        flood: Truth::False,
        feed_override: Truth::True,
        speed_override: Truth::True,
        adaptive: Truth::False,
        feed_hold: Truth::True,
        tool: if machine.fresh { D::number(0.0) } else { D::unknown() },
        selected: if machine.fresh { D::number(0.0) } else { D::unknown() },
        loaded: Tool {
            pocket: 0,
            offset: if machine.fresh { Position::ZERO } else { Position::UNKNOWN },
            diameter: if machine.fresh { Mm(0.0) } else { Mm::UNKNOWN },
            corner_radius: Mm::UNKNOWN,
            angles: [0.0; 2],
            orientation: 0,
        },
        loaded_row: 1,
        cycle: CycleWords::NONE,
        turning: None,
        transform: Transform::NONE,
        wrapped: Wrapped::No,
        diameters: Diameters::default(),
        blending: (0.0, None),
        passed: Position::UNKNOWN,
        probed: if machine.fresh { Position::ZERO } else { Position::UNKNOWN },
        probe_result: if machine.fresh { Truth::False } else { Truth::Unknown },
        touched: Touch::None,
        kept_touch: Touch::None,
        polar: [0.0; 2],
        variables: Variables::new(unwritten, known),
        frames: vec![Frame {
            kind: FrameKind::Main,
            entry: At { file: 0, block: 0 },
            caller: At { file: 0, block: 0 },
            repeats: Some(0),
            locals: Some(locals),
            counters: Vec::new(),
            saved: None,
            restore_on_return: false,
            wanted_branch: None,
            bar_feed: None,
        }],
        macro_modal: None,
        compensation: None,
        left_compensation: None,
        nurbs: None,
        bar: Bar::at_start(machine),
    };
    start_bar_counters(model, machine, &mut state);
    state.in_effect = state.work.map_or(WorkOffset::UNKNOWN, |number| state.tables.offset(number));
    for (number, value) in &machine.variables {
        let [first, last] = model.semantics().locals;
        if (first..=last).contains(number)
            && let Some(locals) = state.frames.iter_mut().find_map(|frame| frame.locals.as_mut())
        {
            locals.set(*number, D::number(*value));
        }
    }
    state
}

/// A state of which nothing is known but the calls that led to it: what a program leaves that we do not have.
pub(crate) fn unknown_state<D: Domain>(model: &Model<'_>, machine: &Machine) -> State<D> {
    let mut state = start_state::<D>(model, machine, &mut BTreeSet::new());
    for (role, mode) in Role::ALL.into_iter().zip(&mut state.modes) {
        // A subprogram that changes units or the control's own modes of work is rare enough to be its own mistake.
        if !matches!(
            role,
            Role::Units | Role::Diameter | Role::TiltedPlane | Role::PolarInterpolation | Role::DynamicOffset
        ) {
            *mode = ModeSet::ANY;
        }
    }
    state.position = Position::UNKNOWN;
    state.actual = Position::UNKNOWN;
    let mut tables = (*state.tables).clone();
    tables.unsure = true;
    state.tables = Rc::new(tables);
    state.work = None;
    state.in_effect = WorkOffset::UNKNOWN;
    state.shift = Position::UNKNOWN;
    state.local = Position::UNKNOWN;
    state.length = Position::UNKNOWN;
    state.h = D::unknown();
    state.d = D::unknown();
    state.feed = D::unknown();
    state.feed_word = D::unknown();
    state.feed_given_under = ModeSet::ANY;
    state.speed = D::unknown();
    state.speed_limit = f64::NAN;
    state.spindle = None;
    state.live_tool = Truth::Unknown;
    state.mist = Truth::Unknown;
    state.flood = Truth::Unknown;
    state.tool = D::unknown();
    state.selected = D::unknown();
    state.loaded.offset = Position::UNKNOWN;
    state.loaded.diameter = Mm::UNKNOWN;
    state.cycle = state.cycle.unknown();
    state.transform.angle = f64::NAN;
    state.passed = Position::UNKNOWN;
    state.diameters.forget();
    state.probed = Position::UNKNOWN;
    state.probe_result = Truth::Unknown;
    state.touched = Touch::Unknown;
    state.kept_touch = Touch::Unknown;
    state.variables.forget();
    state.bar = Bar::UNKNOWN;
    state
}

fn tables(machine: &Machine) -> Tables {
    let known = |offset: WorkOffset| offset;
    Tables {
        offsets: machine.offsets.iter().map(|(number, offset)| (*number, known(*offset))).collect(),
        other_offset: if machine.fresh { WorkOffset::ZERO } else { WorkOffset::UNKNOWN },
        references: [if machine.fresh { Position::ZERO } else { Position::UNKNOWN }; 4],
        tools: machine
            .tools
            .iter()
            .map(|(number, tool)| {
                let mut tool = *tool;
                if !tool.corner_radius.is_known() {
                    tool.corner_radius = Mm::UNKNOWN;
                }
                (*number, tool)
            })
            .collect(),
        complete: machine.tool_table_is_complete,
        unsure: false,
    }
}
