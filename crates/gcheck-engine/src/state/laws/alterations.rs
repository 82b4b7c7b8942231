//! One change for every field of the state.
//!
//! Knows: for each field a value that it has not before a program. Must not know: the laws.

use std::rc::Rc;

use gcheck_controls::{CodeIx, Letter};
use gcheck_geometry::{Mm, Plane};

use super::choices::{Choices, Made};
use super::*;
use crate::origin::At;

type Alter = fn(&mut State<Abstract>);

/// A known number where none is.
const FIVE: AbstractValue = AbstractValue::Number(5.0);

fn point() -> Position {
    Position::new([7.0; 9])
}

fn block() -> At {
    At { file: 0, block: 9 }
}

fn kept(state: &mut State<Abstract>) -> &mut Kept {
    state.calls.kept_mut().unwrap()
}

fn made<T: Made>() -> T {
    T::made(&mut Choices::of(&[1; 300]))
}

fn turning(change: impl FnOnce(&mut TurningWords)) -> KeptTurningWords {
    let mut words = TurningWords::default();
    change(&mut words);
    KeptTurningWords::of(&words)
}

fn modal_call(argument: f64) -> ModalCalls<Abstract> {
    let arguments = vec![(1, AbstractValue::Number(argument))];
    ModalCalls::on(ModalCall { target: block(), arguments, repeats: Flat::Known(1) })
}

/// Each field with a change of it alone.
pub(super) fn alterations() -> Vec<(&'static str, Alter)> {
    // A field that is not named here has no alteration yet.
    let State {
        points: _,
        variables: _,
        calls: _,
        modes: _,
        offsets: _,
        tool: _,
        feed: _,
        spindle: _,
        coolant: _,
        cycle: _,
        turning: _,
        transform: _,
        mapping: _,
        compensation: _,
        blending: _,
        curve: _,
        probe: _,
        tool_shift: _,
        bar: _,
        data_entry: _,
    } = known_state();
    let mut all = positions_and_offsets();
    all.extend(tool_feed_and_spindle());
    all.extend(words());
    all.extend(paths());
    all.extend(programs());
    all
}

fn positions_and_offsets() -> Vec<(&'static str, Alter)> {
    vec![
        ("position", |s| s.points.position = point()),
        ("actual", |s| s.points.actual = point()),
        ("passed point", |s| s.points.passed = point()),
        ("work offset in the table", |s| {
            s.offsets.tables_mut().set_offset(2, WorkOffset { origin: point(), rotation: 0.0 });
        }),
        ("rotation in the table", |s| {
            s.offsets.tables_mut().set_offset(2, WorkOffset { origin: Position::ZERO, rotation: 30.0 });
        }),
        ("reference position", |s| s.offsets.tables_mut().references[1] = point()),
        ("tool in the table", |s| s.offsets.tables_mut().tool_mut(3).diameter = Mm(8.0)),
        ("work", |s| s.offsets.work = Flat::Known(4)),
        ("offset in effect", |s| s.offsets.in_effect.origin = point()),
        ("rotation in effect", |s| s.offsets.in_effect.rotation = 30.0),
        ("shift", |s| s.offsets.shift = point()),
        ("shift on", |s| s.offsets.shift_on = Truth::False),
        ("local", |s| s.offsets.local = point()),
    ]
}

fn tool_feed_and_spindle() -> Vec<(&'static str, Alter)> {
    vec![
        ("tool", |s| s.tool.number = FIVE),
        ("selected", |s| s.tool.selected = FIVE),
        ("length of the loaded tool", |s| s.tool.loaded.data.offset = point()),
        ("diameter of the loaded tool", |s| s.tool.loaded.data.diameter = Mm(8.0)),
        ("angles of the loaded tool", |s| s.tool.loaded.data.angles = [3.0; 2]),
        ("orientation of the loaded tool", |s| s.tool.loaded.data.orientation = Flat::Known(3)),
        ("entry of the loaded tool", |s| s.tool.loaded.entry = Perhaps::Yes(3)),
        ("length", |s| s.tool.length = point()),
        ("H", |s| s.tool.h = FIVE),
        ("D", |s| s.tool.d = FIVE),
        ("feed", |s| s.feed.rate = FIVE),
        ("F as it was written", |s| s.feed.word = FIVE),
        ("feed given under", |s| s.feed.given_under = ModeSet::one(CodeIx::NONE)),
        ("feed override", |s| s.feed.overridable = Truth::False),
        ("adaptive feed", |s| s.feed.adaptive = Truth::True),
        ("feed hold", |s| s.feed.hold = Truth::False),
        ("speed", |s| s.spindle.speed = FIVE),
        ("limit of the speed", |s| s.spindle.limit = 3_000.0),
        ("spindle", |s| s.spindle.way = Flat::Known(Spindle::Clockwise)),
        ("live tool", |s| s.spindle.live_tool = Truth::True),
        ("speed override", |s| s.spindle.overridable = Truth::False),
        ("mist", |s| s.coolant.mist = Truth::True),
        ("flood", |s| s.coolant.flood = Truth::True),
        ("through", |s| s.coolant.through = Truth::True),
    ]
}

fn words() -> Vec<(&'static str, Alter)> {
    vec![
        ("a word of a cycle", |s| {
            s.cycle.give(Letter::of('R'));
            s.cycle.r = 2.0;
        }),
        ("begin of a series", |s| s.cycle.begin(10.0)),
        ("last dwell", |s| s.cycle.last_dwell = Some(1.0)),
        ("plane of the last pocket", |s| s.cycle.pocket_r = Some(1.0)),
        ("feed override of a cycle", |s| s.cycle.feed_override_on = Truth::True),
        ("start of a pass", |s| s.turning = turning(|words| words.start[0] = Some(1.0))),
        ("corner of a pass", |s| s.turning = turning(|words| words.corner[1] = Some(1.0))),
        ("taper", |s| s.turning = turning(|words| words.taper = Some(1.0))),
        ("lead", |s| s.turning = turning(|words| words.lead = Some(1.0))),
        ("depth of roughing", |s| s.turning = turning(|words| words.roughing[0] = Some(1.0))),
        ("passes of a pattern", |s| s.turning = turning(|words| words.pattern[2] = Some(1.0))),
        ("retract of pecks", |s| s.turning = turning(|words| words.peck_retract = Some(1.0))),
        ("passes of a thread", |s| s.turning = turning(|words| words.thread[0] = Some(1.0))),
    ]
}

fn paths() -> Vec<(&'static str, Alter)> {
    vec![
        ("scaling", |s| s.transform = Transform::NONE.scaled([2.0; 3], [0.0; 3])),
        ("rotation", |s| s.transform = Transform::NONE.rotated(30.0, [0.0; 3], Plane::Xy)),
        ("mirror", |s| s.transform.mirrors_mut()[0] = Perhaps::Yes(0.0)),
        ("cylinder", |s| s.mapping.wrapped = Perhaps::Yes(made())),
        ("diameter of cylinders", |s| s.mapping.diameters.set(Axis::A, 50.0)),
        ("compensation", |s| s.compensation.on = Perhaps::Yes(made())),
        ("compensation on an unknown path", |s| {
            s.compensation.on = Perhaps::Yes(Course::Unknown);
        }),
        ("compensation left", |s| s.compensation.left = Perhaps::Yes(made())),
        ("tolerance of blending", |s| s.blending.tolerance = 0.1),
        ("second tolerance of blending", |s| s.blending.naive = Some(0.1)),
        ("unit of the tolerances of blending", |s| s.blending.unit = 25.4),
        ("level of smoothing", |s| s.blending.smoothing_level = Some(1.0)),
        ("tolerance of smoothing", |s| s.blending.smoothing_tolerance = Some(0.1)),
        ("contour control", |s| s.blending.contour = Some(1.0)),
        ("tilted plane", |s| s.mapping.tilted = Perhaps::Yes(made())),
        ("face of the part", |s| s.mapping.face = Perhaps::Yes(made())),
        ("data entry", |s| s.data_entry = Truth::True),
        ("control points", |s| s.curve = Perhaps::Yes(ControlPoints(Rc::new(vec![[1.0; 3]])))),
        ("touched point", |s| s.probe.point = point()),
        ("result of the probe", |s| s.probe.result = Truth::True),
        ("last touch", |s| s.probe.touched = made()),
        ("touch that was kept", |s| s.probe.kept = made()),
        ("length along the tool", |s| s.tool_shift.along = Some(10.0)),
        ("size along vectors", |s| s.tool_shift.cutter = Some(10.0)),
        ("rest of the bar", |s| s.bar.set_length(100.0)),
        ("bars that wait", |s| s.bar.waiting = 1.0),
        ("chuck", |s| s.bar.clamped = Truth::False),
        ("distance beside the point", |s| s.tool_shift.beside[2] = 10.0),
    ]
}

fn programs() -> Vec<(&'static str, Alter)> {
    vec![
        ("common variable", |s| s.variables.set(100, FIVE)),
        ("global parameter", |s| s.variables.set_named(NameId(1), FIVE)),
        ("local variable", |s| s.calls.locals_mut().unwrap().set(1, FIVE)),
        ("local parameter", |s| s.calls.locals_mut().unwrap().set_named(NameId(2), FIVE)),
        ("mode", |s| s.set_mode(Role::Distance, CodeIx::NONE)),
        ("repeats", |s| kept(s).repeats = Flat::Known(3)),
        ("counter of a loop", |s| kept(s).counters.set(block(), Flat::Known(3))),
        ("saved modes", |s| kept(s).saved = Perhaps::Yes(made())),
        ("restoring on return", |s| kept(s).restore_on_return = Truth::True),
        ("wanted branch", |s| kept(s).wanted_branch = Perhaps::Yes(block())),
        ("bar feed", |s| kept(s).bar_feed = Perhaps::Yes(made())),
        ("call", |s| s.calls.push(Frame::new(FrameKind::Subprogram, block(), block(), Some(0)))),
        ("modal call", |s| s.calls.modal = modal_call(1.0)),
    ]
}
