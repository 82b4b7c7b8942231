//! Where the axes are in machine coordinates, and when nobody can say.

#![expect(clippy::unwrap_used, reason = "a test that meets the unexpected is to fail")]

use std::fmt::Write;

use expect_test::{Expect, expect};
use gcheck_engine::{
    Axis, Concrete, Machine, Model, NoLibrary, Observer, Options, Origin, Position, Program, State, Tool,
    WorkOffset, run,
};
use gcheck_geometry::Mm;
use gcheck_program::{Dialect, Loaded};

/// Work and machine coordinates after each block of the text.
struct Recorder<'a> {
    text: &'a str,
    model: &'a Model<'a>,
    axes: &'static str,
    shown: String,
}

fn shown(position: &Position, axes: &str) -> String {
    let axes = Axis::ALL.into_iter().filter(|axis| axes.contains(axis.name()));
    let number = |axis: Axis| position.get(axis).map_or("?".to_owned(), |value| format!("{value}"));
    axes.map(|axis| format!(" {}{}", axis.name(), number(axis))).collect()
}

impl Observer<Concrete> for Recorder<'_> {
    fn after(&mut self, origin: Origin, state: &State<Concrete>) {
        let block = self.text.get(origin.start as usize..origin.end as usize).unwrap().trim_end();
        let (work, machine) = (state.actual(), state.machine(self.model));
        writeln!(self.shown, "{block} |{} |{}", shown(work, self.axes), shown(&machine, self.axes)).unwrap();
    }
}

/// Millimetres. G54 lies at -100, -50, -200; tool 1 is 80 mm long.
fn check(control: &str, axes: &'static str, text: &str, expected: &Expect) {
    let mut origin = Position::ZERO;
    for (axis, value) in [(Axis::X, -100.0), (Axis::Y, -50.0), (Axis::Z, -200.0)] {
        origin.set(axis, value);
    }
    let mut offset = Position::ZERO;
    offset.set(Axis::Z, 80.0);
    let tool = Tool {
        pocket: 1,
        offset,
        diameter: Mm(10.0),
        corner_radius: Mm(0.0),
        angles: [0.0; 2],
        orientation: 0,
    };
    let machine = Machine {
        units: Some(gcheck_engine::Units::Mm),
        offsets: [(1, WorkOffset { origin, rotation: 0.0 })].into(),
        tools: [(1, tool)].into(),
        ..Machine::default()
    };
    let control = gcheck_controls::load(control).unwrap();
    let dialect = Dialect::new(&control);
    let loaded = Loaded::new(text, &dialect, |_, _, _| ());
    let program = Program::new(loaded, &dialect, &NoLibrary);
    let model = Model::new(&control);
    let mut recorder = Recorder { text, model: &model, axes, shown: String::new() };
    run(&program, &model, &machine, Options::NONE, 1_000, &mut recorder);
    expected.assert_eq(recorder.shown.trim_end());
}

#[test]
fn the_work_offset_and_the_length_lie_between() {
    check(
        "haas-mill",
        "XYZ",
        "G0 G90 G54 X1. Y1. Z1.\nG43 H1 Z1.\nG53 Z0\nM30",
        &expect![[r#"
        G0 G90 G54 X1. Y1. Z1. | X1 Y1 Z1 | X-99 Y-49 Z-199
        G43 H1 Z1. | X1 Y1 Z1 | X-99 Y-49 Z-119
        G53 Z0 | X1 Y1 Z120 | X-99 Y-49 Z0
        M30 | X1 Y1 Z120 | X-99 Y-49 Z0"#]],
    );
}

#[test]
fn a_tilted_plane_turns_the_axes_away_from_the_coordinates() {
    check(
        "haas-mill",
        "XYZ",
        "G0 G90 G54 X1. Y1. Z1.\nG268 X0 Y0 Z0 I30.\nX2. Y2. Z2.\nG269\nX1. Y1. Z1.\nM30",
        &expect![[r#"
            G0 G90 G54 X1. Y1. Z1. | X1 Y1 Z1 | X-99 Y-49 Z-199
            G268 X0 Y0 Z0 I30. | X? Y? Z? | X? Y? Z?
            X2. Y2. Z2. | X2 Y2 Z2 | X? Y? Z?
            G269 | X? Y? Z? | X? Y? Z?
            X1. Y1. Z1. | X1 Y1 Z1 | X-99 Y-49 Z-199
            M30 | X1 Y1 Z1 | X-99 Y-49 Z-199"#]],
    );
    check(
        "fanuc-mill",
        "XYZ",
        "G0 G90 G54 X1. Y1. Z1.\nG68.2 X0 Y0 Z0 I30. J0 K0\nX2. Y2. Z2.\nG69\nX1. Y1. Z1.\nM30",
        &expect![[r#"
            G0 G90 G54 X1. Y1. Z1. | X1 Y1 Z1 | X-99 Y-49 Z-199
            G68.2 X0 Y0 Z0 I30. J0 K0 | X? Y? Z? | X? Y? Z?
            X2. Y2. Z2. | X2 Y2 Z2 | X? Y? Z?
            G69 | X? Y? Z? | X? Y? Z?
            X1. Y1. Z1. | X1 Y1 Z1 | X-99 Y-49 Z-199
            M30 | X1 Y1 Z1 | X-99 Y-49 Z-199"#]],
    );
}

#[test]
fn a_dynamic_offset_moves_with_the_table() {
    check(
        "haas-mill",
        "XYZ",
        "G0 G90 G54 X1. Y1. Z1.\nG254\nX1. Y1. Z1.\nG255\nX1. Y1. Z1.\nM30",
        &expect![[r#"
        G0 G90 G54 X1. Y1. Z1. | X1 Y1 Z1 | X-99 Y-49 Z-199
        G254 | X? Y? Z? | X? Y? Z?
        X1. Y1. Z1. | X1 Y1 Z1 | X? Y? Z?
        G255 | X? Y? Z? | X? Y? Z?
        X1. Y1. Z1. | X1 Y1 Z1 | X-99 Y-49 Z-199
        M30 | X1 Y1 Z1 | X-99 Y-49 Z-199"#]],
    );
}

#[test]
fn the_length_of_a_turned_tool_lies_along_it() {
    check(
        "haas-mill",
        "XYZA",
        "G0 G90 G54 X1. Y1. Z1. A0 B0 C0\nG234 H1 X1. Y1. Z1.\nA90.\nA0.\nA90.\nG49\nX1. Y1. Z1.\nM30",
        &expect![[r#"
            G0 G90 G54 X1. Y1. Z1. A0 B0 C0 | X1 Y1 Z1 A0 | X-99 Y-49 Z-199 A0
            G234 H1 X1. Y1. Z1. | X1 Y1 Z1 A0 | X-99 Y-49 Z-119 A0
            A90. | X1 Y1 Z1 A90 | X? Y? Z? A90
            A0. | X1 Y1 Z1 A0 | X-99 Y-49 Z-119 A0
            A90. | X1 Y1 Z1 A90 | X? Y? Z? A90
            G49 | X? Y? Z? A90 | X? Y? Z? A90
            X1. Y1. Z1. | X1 Y1 Z1 A90 | X-99 Y-49 Z-199 A90
            M30 | X1 Y1 Z1 A90 | X-99 Y-49 Z-199 A90"#]],
    );
}

#[test]
fn x_and_a_rotary_axis_share_the_moves_of_polar_interpolation() {
    check(
        "haas-lathe",
        "XYZC",
        "G0 G54 X20. Z1. C30.\nG112\nG1 X5. Y5. Z-1. F100.\nG113\nG0 X20. C0\nM30",
        &expect![[r#"
            G0 G54 X20. Z1. C30. | X10 Y? Z1 C30 | X-90 Y? Z-199 C30
            G112 | X? Y? Z1 C? | X? Y? Z-199 C?
            G1 X5. Y5. Z-1. F100. | X5 Y5 Z-1 C? | X? Y? Z-201 C?
            G113 | X? Y? Z-1 C? | X? Y? Z-201 C?
            G0 X20. C0 | X10 Y? Z-1 C0 | X-90 Y? Z-201 C0
            M30 | X10 Y? Z-1 C0 | X-90 Y? Z-201 C0"#]],
    );
}
