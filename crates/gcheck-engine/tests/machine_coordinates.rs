//! Where the axes are in machine coordinates, and when nobody can say.

#![expect(clippy::unwrap_used, reason = "a test that meets the unexpected is to fail")]

use std::fmt::Write;

use expect_test::{Expect, expect};
use gcheck_engine::{
    Axis, Concrete, Machine, Model, NoLibrary, Observer, Options, Origin, Position, Program, State, Tool,
    WorkOffset, run,
};
use gcheck_geometry::{Arrangement, Direction, Kinematics, Mm, RotaryAxis};
use gcheck_program::{Dialect, Loaded};

/// Work and machine coordinates after each block of the text.
struct Recorder<'a> {
    text: &'a str,
    model: &'a Model<'a>,
    machine: &'a Machine,
    axes: &'static str,
    shown: String,
}

fn shown(position: &Position, axes: &str) -> String {
    let axes = Axis::ALL.into_iter().filter(|axis| axes.contains(axis.name()));
    let number = |axis: Axis| {
        position.get(axis).map_or("?".to_owned(), |value| format!("{}", (value * 1e4).round() / 1e4 + 0.0))
    };
    axes.map(|axis| format!(" {}{}", axis.name(), number(axis))).collect()
}

impl Observer<Concrete> for Recorder<'_> {
    fn after(&mut self, origin: Origin, state: &State<Concrete>) {
        let block = self.text.get(origin.start as usize..origin.end as usize).unwrap().trim_end();
        let (work, machine) = (state.actual(), state.machine(self.model, self.machine));
        writeln!(self.shown, "{block} |{} |{}", shown(work, self.axes), shown(&machine, self.axes)).unwrap();
    }
}

/// Millimetres. G54 lies at -100, -50, -200; tool 1 is 80 mm long.
fn check(control: &str, axes: &'static str, text: &str, expected: &Expect) {
    check_on(Machine::default(), control, axes, text, expected);
}

/// Where the axes of the table meet: 50 mm below the origin of G54.
const CENTRE: [Mm; 3] = [Mm(-100.0), Mm(-50.0), Mm(-250.0)];

/// A machine with two rotary axes, the first carrying the second.
fn rotary(arrangement: Arrangement, order: [RotaryAxis; 2]) -> Machine {
    let kinematics = Kinematics {
        arrangement,
        order,
        sign: [1.0; 2],
        inclined: [None; 2],
        pivot_length: Some(Mm(200.0)),
        offset: [Mm(0.0); 3],
    };
    Machine { kinematics: Some(kinematics), rotary_centre: Some(CENTRE), ..Machine::default() }
}

fn check_on(described: Machine, control: &str, axes: &'static str, text: &str, expected: &Expect) {
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
        ..described
    };
    let control = gcheck_controls::load(control).unwrap();
    let dialect = Dialect::new(&control);
    let loaded = Loaded::new(text, &dialect, |_, _, _| ());
    let program = Program::new(loaded, &dialect, &NoLibrary);
    let model = Model::new(&control);
    let mut recorder = Recorder { text, model: &model, machine: &machine, axes, shown: String::new() };
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
            G112 | X8.6603 Y5 Z1 C30 | X-90 Y? Z-199 C30
            G1 X5. Y5. Z-1. F100. | X5 Y5 Z-1 C45 | X-92.9289 Y? Z-201 C45
            G113 | X7.0711 Y? Z-1 C45 | X-92.9289 Y? Z-201 C45
            G0 X20. C0 | X10 Y? Z-1 C0 | X-90 Y? Z-201 C0
            M30 | X10 Y? Z-1 C0 | X-90 Y? Z-201 C0"#]],
    );
}

// ---- machines whose rotary axes are described ----

/// A turns (x, y, z) about the centre to (x, -z, y): a point 50 above the centre comes to lie beside it.
#[test]
fn the_tip_stays_on_the_part_that_its_table_turns() {
    check_on(
        rotary(Arrangement::TableTable, [RotaryAxis::A, RotaryAxis::C]),
        "haas-mill",
        "XYZAC",
        "G0 G90 G54 X0. Y0. Z0. A0 B0 C0\nG234 H1 X10. Y0. Z0.\nA90.\nX0. Z10.\nC90.\nG49\nA0. C0.",
        &expect![[r#"
            G0 G90 G54 X0. Y0. Z0. A0 B0 C0 | X0 Y0 Z0 A0 C0 | X-100 Y-50 Z-200 A0 C0
            G234 H1 X10. Y0. Z0. | X10 Y0 Z0 A0 C0 | X-90 Y-50 Z-120 A0 C0
            A90. | X10 Y0 Z0 A90 C0 | X-90 Y-100 Z-170 A90 C0
            X0. Z10. | X0 Y0 Z10 A90 C0 | X-100 Y-110 Z-170 A90 C0
            C90. | X0 Y0 Z10 A90 C90 | X-100 Y-110 Z-170 A90 C90
            G49 | X0 Y-60 Z30 A90 C90 | X-100 Y-110 Z-170 A90 C90
            A0. C0. | X0 Y-60 Z30 A0 C0 | X-100 Y-110 Z-170 A0 C0"#]],
    );
}

/// The part's origin comes to lie beside the centre, and the program's axes stay those of the machine.
#[test]
fn the_origin_goes_with_the_table() {
    check_on(
        rotary(Arrangement::TableTable, [RotaryAxis::A, RotaryAxis::C]),
        "haas-mill",
        "XYZAC",
        "G0 G90 G54 X0. Y0. A0 B0 C0\nG43 H1 Z100.\nA90.\nG254\nX10. Y0.\nZ10.\nG255\nG53 Z0.\nA0.",
        &expect![[r#"
            G0 G90 G54 X0. Y0. A0 B0 C0 | X0 Y0 Z? A0 C0 | X-100 Y-50 Z? A0 C0
            G43 H1 Z100. | X0 Y0 Z100 A0 C0 | X-100 Y-50 Z-20 A0 C0
            A90. | X0 Y0 Z100 A90 C0 | X-100 Y-50 Z-20 A90 C0
            G254 | X0 Y50 Z150 A90 C0 | X-100 Y-50 Z-20 A90 C0
            X10. Y0. | X10 Y0 Z150 A90 C0 | X-90 Y-100 Z-20 A90 C0
            Z10. | X10 Y0 Z10 A90 C0 | X-90 Y-100 Z-160 A90 C0
            G255 | X10 Y-50 Z-40 A90 C0 | X-90 Y-100 Z-160 A90 C0
            G53 Z0. | X10 Y-50 Z120 A90 C0 | X-90 Y-100 Z0 A90 C0
            A0. | X10 Y-50 Z120 A0 C0 | X-90 Y-100 Z0 A0 C0"#]],
    );
}

/// At B90 the tool lies along X: 80 mm of tool and 200 mm of head beside the tip, and the pivot as high as the tip.
#[test]
fn a_head_leans_back_from_the_tip() {
    check_on(
        rotary(Arrangement::HeadHead, [RotaryAxis::C, RotaryAxis::B]),
        "fanuc-mill",
        "XYZBC",
        "G0 G90 G54 X0. Y0. Z0. A0 B0. C0.\nG43.4 H1 Z0.\nB90.\nC90.\nG49",
        &expect![[r#"
            G0 G90 G54 X0. Y0. Z0. A0 B0. C0. | X0 Y0 Z0 B0 C0 | X-100 Y-50 Z-200 B0 C0
            G43.4 H1 Z0. | X0 Y0 Z0 B0 C0 | X-100 Y-50 Z-120 B0 C0
            B90. | X0 Y0 Z0 B90 C0 | X180 Y-50 Z-400 B90 C0
            C90. | X0 Y0 Z0 B90 C90 | X-100 Y230 Z-400 B90 C90
            G49 | X0 Y280 Z-200 B90 C90 | X-100 Y230 Z-400 B90 C90"#]],
    );
}

/// A nutating head: B turns about the line between Y and Z, so that half a turn lays the tool along Y.
#[test]
fn a_nutating_head_lays_the_tool_along_y() {
    let mut machine = rotary(Arrangement::HeadHead, [RotaryAxis::C, RotaryAxis::B]);
    if let Some(kinematics) = &mut machine.kinematics {
        kinematics.inclined = [None, Direction::of([0.0, 1.0, 1.0])];
    }
    check_on(
        machine,
        "fanuc-mill",
        "XYZBC",
        "G0 G90 G54 X0. Y0. Z0. A0 B0. C0.\nG43.4 H1 Z0.\nB180.\nC90.",
        &expect![[r#"
            G0 G90 G54 X0. Y0. Z0. A0 B0. C0. | X0 Y0 Z0 B0 C0 | X-100 Y-50 Z-200 B0 C0
            G43.4 H1 Z0. | X0 Y0 Z0 B0 C0 | X-100 Y-50 Z-120 B0 C0
            B180. | X0 Y0 Z0 B180 C0 | X-100 Y230 Z-400 B180 C0
            C90. | X0 Y0 Z0 B180 C90 | X-380 Y-50 Z-400 B180 C90"#]],
    );
}

/// The tool leans over a part that turns under it.
#[test]
fn a_head_and_a_table_share_the_turns() {
    check_on(
        rotary(Arrangement::HeadTable, [RotaryAxis::B, RotaryAxis::C]),
        "fanuc-mill",
        "XYZBC",
        "G0 G90 G54 X10. Y0. Z0. A0 B0. C0.\nG43.4 H1 Z0.\nC90.\nB90.\nG49",
        &expect![[r#"
            G0 G90 G54 X10. Y0. Z0. A0 B0. C0. | X10 Y0 Z0 B0 C0 | X-90 Y-50 Z-200 B0 C0
            G43.4 H1 Z0. | X10 Y0 Z0 B0 C0 | X-90 Y-50 Z-120 B0 C0
            C90. | X10 Y0 Z0 B0 C90 | X-100 Y-40 Z-120 B0 C90
            B90. | X10 Y0 Z0 B90 C90 | X180 Y-40 Z-400 B90 C90
            G49 | X280 Y10 Z-200 B90 C90 | X180 Y-40 Z-400 B90 C90"#]],
    );
}

#[test]
fn without_the_centre_of_the_table_nobody_can_say() {
    let described = rotary(Arrangement::TableTable, [RotaryAxis::A, RotaryAxis::C]);
    check_on(
        Machine { rotary_centre: None, ..described },
        "haas-mill",
        "XYZ",
        "G0 G90 G54 X0. Y0. Z0. A0 B0 C0\nG234 H1 X10. Y0. Z0.\nA90.",
        &expect![[r#"
            G0 G90 G54 X0. Y0. Z0. A0 B0 C0 | X0 Y0 Z0 | X-100 Y-50 Z-200
            G234 H1 X10. Y0. Z0. | X10 Y0 Z0 | X-90 Y-50 Z-120
            A90. | X10 Y0 Z0 | X? Y? Z?"#]],
    );
}

#[test]
fn settings_of_the_control_hold_the_centre() {
    let described = rotary(Arrangement::TableTable, [RotaryAxis::A, RotaryAxis::C]);
    let settings = [("255", "-100"), ("256", "-50"), ("257", "-250")];
    let settings = settings.map(|(number, value)| (number.to_owned(), value.to_owned())).into();
    check_on(
        Machine { rotary_centre: None, settings, ..described },
        "haas-mill",
        "XYZ",
        "G0 G90 G54 X0. Y0. Z0. A0 B0 C0\nG234 H1 X10. Y0. Z0.\nA90.",
        &expect![[r#"
            G0 G90 G54 X0. Y0. Z0. A0 B0 C0 | X0 Y0 Z0 | X-100 Y-50 Z-200
            G234 H1 X10. Y0. Z0. | X10 Y0 Z0 | X-90 Y-50 Z-120
            A90. | X10 Y0 Z0 | X-90 Y-100 Z-170"#]],
    );
}

#[test]
fn an_axis_that_turns_the_shorter_way() {
    let machine = Machine { shorter_way: vec![Axis::C], ..Machine::default() };
    check_on(
        machine,
        "haas-mill",
        "BC",
        "G0 G90 G54 B0. C10.\nB350. C350.\nB0. C180.\nG91 C350.",
        &expect![[r#"
            G0 G90 G54 B0. C10. | B0 C10 | B0 C10
            B350. C350. | B350 C-10 | B350 C-10
            B0. C180. | B0 C-180 | B0 C-180
            G91 C350. | B0 C170 | B0 C170"#]],
    );
}

/// Whether a block has a code does not change the way.
#[test]
fn the_shorter_way_without_a_code() {
    check_on(
        Machine { shorter_way: vec![Axis::C], ..Machine::default() },
        "haas-mill",
        "BC",
        "G0 G90 G54 B0. C350.\nC10.\nB350.\nG0 C350.",
        &expect![[r#"
            G0 G90 G54 B0. C350. | B0 C350 | B0 C350
            C10. | B0 C370 | B0 C370
            B350. | B350 C370 | B350 C370
            G0 C350. | B350 C350 | B350 C350"#]],
    );
}

/// Of the machine only Z moves; on the part that is turned under the tool the tip moves in Y and Z.
#[test]
fn a_return_while_the_tip_stays_on_a_turned_part() {
    let machine = || rotary(Arrangement::TableTable, [RotaryAxis::A, RotaryAxis::C]);
    check_on(
        machine(),
        "fanuc-mill",
        "XYZAC",
        "G0 G90 G54 X0. Y0. A0. C0.\nG43.4 H1 Z50.\nX10. Y5. Z20. A30. C0.\nG53 Z0.\nX10. Y5. Z20.\nG91 G28 Z0.",
        &expect![[r#"
            G0 G90 G54 X0. Y0. A0. C0. | X0 Y0 Z? A0 C0 | X-100 Y-50 Z? A0 C0
            G43.4 H1 Z50. | X0 Y0 Z50 A0 C0 | X-100 Y-50 Z-70 A0 C0
            X10. Y5. Z20. A30. C0. | X10 Y5 Z20 A30 C0 | X-90 Y-80.6699 Z-106.8782 A30 C0
            G53 Z0. | X10 Y58.4391 Z112.5593 A30 C0 | X-90 Y-80.6699 Z0 A30 C0
            X10. Y5. Z20. | X10 Y5 Z20 A30 C0 | X-90 Y-80.6699 Z-106.8782 A30 C0
            G91 G28 Z0. | X10 Y? Z? A30 C0 | X-90 Y? Z? A30 C0"#]],
    );
    check_on(
        machine(),
        "haas-mill",
        "XYZAC",
        "G0 G90 G54 X0. Y0. A0. C0.\nG43 H1 Z50.\nG254\nX10. Y5. Z20. A30. C0.\nG91 G28 Z0.\nG90 X10. Y5.\nT1 M6",
        &expect![[r#"
            G0 G90 G54 X0. Y0. A0. C0. | X0 Y0 Z? A0 C0 | X-100 Y-50 Z? A0 C0
            G43 H1 Z50. | X0 Y0 Z50 A0 C0 | X-100 Y-50 Z-70 A0 C0
            G254 | X0 Y0 Z50 A0 C0 | X-100 Y-50 Z-70 A0 C0
            X10. Y5. Z20. A30. C0. | X10 Y5 Z20 A30 C0 | X-90 Y-70 Z-106.6987 A30 C0
            G91 G28 Z0. | X10 Y5 Z126.6987 A30 C0 | X-90 Y-70 Z0 A30 C0
            G90 X10. Y5. | X10 Y5 Z126.6987 A30 C0 | X-90 Y-70 Z0 A30 C0
            T1 M6 | X10 Y5 Z126.6987 A30 C0 | X-90 Y-70 Z0 A30 C0"#]],
    );
}

/// A machine without B: what the control could have more does not turn anything.
#[test]
fn axes_that_the_machine_does_not_have_are_not_turned() {
    let expected = expect![[r#"
        G0 G90 G54 X0. Y0. Z0. A0. C0. | X0 Y0 Z0 | X-100 Y-50 Z-200
        G43.4 H1 Z50. | X0 Y0 Z50 | X-100 Y-50 Z-70"#]];
    let axes = Some(vec![Axis::X, Axis::Y, Axis::Z, Axis::A, Axis::C]);
    for described in [
        Machine { axes, ..Machine::default() },
        rotary(Arrangement::TableTable, [RotaryAxis::A, RotaryAxis::C]),
    ] {
        check_on(described, "fanuc-mill", "XYZ", "G0 G90 G54 X0. Y0. Z0. A0. C0.\nG43.4 H1 Z50.", &expected);
    }
}

// ---- polar interpolation ----

/// A square of 20 mm on the face: X stands at the radius of each corner, and C turns by a right angle from corner to corner.
#[test]
fn a_square_on_the_face_turns_the_part_once() {
    check(
        "fanuc-lathe",
        "XYZC",
        "G0 X40. Z1. C0.\nG12.1\nG1 X20. C10. F100.\nX-20.\nC-10.\nX20.\nC10.\nG13.1\nG0 X60.",
        &expect![[r#"
            G0 X40. Z1. C0. | X20 Y? Z1 C0 | X-80 Y? Z-199 C0
            G12.1 | X20 Y0 Z1 C0 | X-80 Y? Z-199 C0
            G1 X20. C10. F100. | X10 Y10 Z1 C45 | X-85.8579 Y? Z-199 C45
            X-20. | X-10 Y10 Z1 C135 | X-85.8579 Y? Z-199 C135
            C-10. | X-10 Y-10 Z1 C225 | X-85.8579 Y? Z-199 C225
            X20. | X10 Y-10 Z1 C315 | X-85.8579 Y? Z-199 C315
            C10. | X10 Y10 Z1 C405 | X-85.8579 Y? Z-199 C405
            G13.1 | X14.1421 Y? Z1 C405 | X-85.8579 Y? Z-199 C405
            G0 X60. | X30 Y? Z1 C405 | X-70 Y? Z-199 C405"#]],
    );
}

/// On this control the second coordinate is written with Y, and X counts radii.
#[test]
fn y_is_drawn_on_a_lathe_without_the_axis() {
    let axes = Some(vec![Axis::X, Axis::Z, Axis::C]);
    check_on(
        Machine { axes, ..Machine::default() },
        "haas-lathe",
        "XYZC",
        "G21 G0 G54 X40. Z1. C0.\nG17 G112\nG1 X20. Y0. F100.\nG3 X-20. Y0. R20.\nX20. R20.\nG113\nG0 X60.",
        &expect![[r#"
            G21 G0 G54 X40. Z1. C0. | X20 Y? Z1 C0 | X-80 Y? Z-199 C0
            G17 G112 | X20 Y0 Z1 C0 | X-80 Y? Z-199 C0
            G1 X20. Y0. F100. | X20 Y0 Z1 C0 | X-80 Y? Z-199 C0
            G3 X-20. Y0. R20. | X-20 Y0 Z1 C180 | X-80 Y? Z-199 C180
            X20. R20. | X20 Y0 Z1 C360 | X-80 Y? Z-199 C360
            G113 | X20 Y? Z1 C360 | X-80 Y? Z-199 C360
            G0 X60. | X30 Y? Z1 C360 | X-70 Y? Z-199 C360"#]],
    );
}

// ---- tilted planes ----

/// A face that looks along -Y: A turns it up, and what lies 10 mm off it is 10 mm higher.
#[test]
fn a_trunnion_turns_a_tilted_plane_up() {
    check_on(
        rotary(Arrangement::TableTable, [RotaryAxis::A, RotaryAxis::C]),
        "fanuc-mill",
        "XYZAC",
        "G0 G90 G54 X0. Y0. Z0. A0 B0 C0\nG43 H1 Z100.\nG68.2 X0 Y0 Z0 I0. J90. K0.\nG53.1\nX5. Y0. Z10.\nG69\nG53 Z0.",
        &expect![[r#"
            G0 G90 G54 X0. Y0. Z0. A0 B0 C0 | X0 Y0 Z0 A0 C0 | X-100 Y-50 Z-200 A0 C0
            G43 H1 Z100. | X0 Y0 Z100 A0 C0 | X-100 Y-50 Z-20 A0 C0
            G68.2 X0 Y0 Z0 I0. J90. K0. | X0 Y100 Z0 A0 C0 | X-100 Y-50 Z-20 A0 C0
            G53.1 | X0 Y-50 Z150 A-90 C0 | X-100 Y-50 Z-20 A-90 C0
            X5. Y0. Z10. | X5 Y0 Z10 A-90 C0 | X-95 Y0 Z-160 A-90 C0
            G69 | X5 Y50 Z-40 A-90 C0 | X-95 Y0 Z-160 A-90 C0
            G53 Z0. | X5 Y50 Z120 A-90 C0 | X-95 Y0 Z0 A-90 C0"#]],
    );
}

/// The axes stand still while another work offset, or a shift, is put under the plane.
#[test]
fn offsets_that_change_under_a_tilted_plane() {
    check_on(
        rotary(Arrangement::TableTable, [RotaryAxis::A, RotaryAxis::C]),
        "fanuc-mill",
        "XYZAC",
        "G0 G90 G54 X0. Y0. Z0. A0 C0\nG68.2 X0 Y0 Z0 I0. J30. K0.\nG53.1\nX10. Y5. Z20.\nG52 X0. Y0. Z10.\nX10.",
        &expect![[r#"
            G0 G90 G54 X0. Y0. Z0. A0 C0 | X0 Y0 Z0 A0 C0 | X-100 Y-50 Z-200 A0 C0
            G68.2 X0 Y0 Z0 I0. J30. K0. | X0 Y0 Z0 A0 C0 | X-100 Y-50 Z-200 A0 C0
            G53.1 | X0 Y-25 Z6.6987 A-30 C0 | X-100 Y-50 Z-200 A-30 C0
            X10. Y5. Z20. | X10 Y5 Z20 A-30 C0 | X-90 Y-20 Z-186.6987 A-30 C0
            G52 X0. Y0. Z10. | X10 Y0 Z11.3397 A-30 C0 | X-90 Y-20 Z-186.6987 A-30 C0
            X10. | X10 Y0 Z11.3397 A-30 C0 | X-90 Y-20 Z-186.6987 A-30 C0"#]],
    );
}

/// Of the ways the machine can take those within the travels of its axes, whole turns counted; here that is one or none.
#[test]
fn ways_to_a_tilted_plane() {
    let machine = |a: (f64, f64), c: (f64, f64)| Machine {
        travel: [(Axis::A, a), (Axis::C, c)].into(),
        ..rotary(Arrangement::TableTable, [RotaryAxis::A, RotaryAxis::C])
    };
    let to_x = "G68.2 X0 Y0 Z0 I90. J90. K0.\nG53.1";
    // The travel of C begins at 0, so that it goes to 270 and not to -90.
    check_on(
        machine((-120.0, 30.0), (0.0, 360.0)),
        "fanuc-mill",
        "AC",
        &format!("G0 G90 G54 X0. Y0. Z0. A0. C0.\n{to_x}"),
        &expect![[r#"
            G0 G90 G54 X0. Y0. Z0. A0. C0. | A0 C0 | A0 C0
            G68.2 X0 Y0 Z0 I90. J90. K0. | A0 C0 | A0 C0
            G53.1 | A-90 C270 | A-90 C270"#]],
    );
    check_on(
        machine((-120.0, 30.0), (0.0, 350.0)),
        "fanuc-mill",
        "AC",
        &format!("G0 G90 G54 X0. Y0. Z0.\n{to_x}"),
        &expect![[r#"
            G0 G90 G54 X0. Y0. Z0. | A? C? | A? C?
            G68.2 X0 Y0 Z0 I90. J90. K0. | A? C? | A? C?
            G53.1 | A-90 C270 | A-90 C270"#]],
    );
    check_on(
        machine((0.0, 30.0), (0.0, 360.0)),
        "fanuc-mill",
        "AC",
        &format!("G0 G90 G54 X0. Y0. Z0. A0. C0.\n{to_x}"),
        &expect![[r#"
            G0 G90 G54 X0. Y0. Z0. A0. C0. | A0 C0 | A0 C0
            G68.2 X0 Y0 Z0 I90. J90. K0. | A0 C0 | A0 C0
            G53.1 | A? C? | A? C?"#]],
    );
}

/// Without a word about the rotary axes nobody knows where they turn to.
#[test]
fn tilted_planes_of_a_machine_that_nobody_described() {
    check(
        "fanuc-mill",
        "XYZAC",
        "G0 G90 G54 X0. Y0. Z0. A0 B0 C0\nG68.2 X10. Y0 Z0 I0. J90. K0.\nX5. Y0. Z10.\nG53.1\nX5. Y0. Z10.\nG69",
        &expect![[r#"
            G0 G90 G54 X0. Y0. Z0. A0 B0 C0 | X0 Y0 Z0 A0 C0 | X-100 Y-50 Z-200 A0 C0
            G68.2 X10. Y0 Z0 I0. J90. K0. | X-10 Y0 Z0 A0 C0 | X-100 Y-50 Z-200 A0 C0
            X5. Y0. Z10. | X5 Y0 Z10 A0 C0 | X-85 Y-60 Z-200 A0 C0
            G53.1 | X? Y? Z? A? C? | X? Y? Z? A? C?
            X5. Y0. Z10. | X5 Y0 Z10 A? C? | X? Y? Z? A? C?
            G69 | X? Y? Z? A? C? | X? Y? Z? A? C?"#]],
    );
}
