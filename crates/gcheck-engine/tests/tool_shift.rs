//! Lengths along a tilting tool and cutter sizes along vectors: where the axes go for a programmed point.

#![expect(clippy::unwrap_used, reason = "a test that meets the unexpected is to fail")]

use std::fmt::Write;

use expect_test::{Expect, expect};
use gcheck_engine::{
    Assumption, Axis, Concrete, Event, Machine, Model, NoLibrary, Observer, Options, Origin, Position,
    Program, RunResult, State, Tool, Units, WorkOffset, run,
};
use gcheck_geometry::{Arrangement, Kinematics, Mm, RotaryAxis};
use gcheck_program::{Dialect, Loaded};
use proptest::prelude::*;

/// What moves do: programmed point, axes in work coordinates, axes in machine coordinates.
struct Moves<'m> {
    model: &'m Model<'m>,
    machine: &'m Machine,
    made: Vec<[Position; 3]>,
}

impl Observer<Concrete> for Moves<'_> {
    fn event(&mut self, _: Origin, state: &State<Concrete>, event: &Event) {
        if let Event::Travel(travel) = event {
            let machine = state.to_machine(&travel.to, self.model, self.machine);
            self.made.push([travel.programmed, travel.to, machine]);
        }
    }
}

/// Units millimetres, `G54` at the machine's zero, tool 1 with a length and a diameter, all axes at zero.
fn machine(length: f64, diameter: f64) -> Machine {
    let mut offset = Position::ZERO;
    offset.set(Axis::Z, length);
    let tool = Tool {
        pocket: 1,
        offset,
        diameter: Mm(diameter),
        corner_radius: Mm::UNKNOWN,
        angles: [0.0; 2],
        orientation: 0,
    };
    Machine {
        units: Some(Units::Mm),
        tools: [(1, tool), (2, Tool { diameter: Mm(-2.0 * diameter), ..tool })].into(),
        offsets: [(1, WorkOffset::ZERO)].into(),
        start: Some(Position::ZERO),
        ..Machine::default()
    }
}

/// A head that tilts, the first axis carrying the second.
fn head(first: RotaryAxis, second: RotaryAxis) -> Kinematics {
    Kinematics {
        arrangement: Arrangement::HeadHead,
        order: [first, second],
        sign: [1.0; 2],
        inclined: [None; 2],
        pivot_length: None,
        offset: [Mm(0.0); 3],
    }
}

/// The moves, how the run ended, and where the machine is then.
fn run_on(machine: &Machine, text: &str) -> (Vec<[Position; 3]>, RunResult, Position) {
    let control = gcheck_controls::load("haas-mill").unwrap();
    let dialect = Dialect::new(&control);
    let loaded = Loaded::new(text, &dialect, |_, _, _| ());
    let program = Program::new(loaded, &dialect, &NoLibrary);
    let model = Model::new(&control);
    let mut moves = Moves { model: &model, machine, made: Vec::new() };
    let result = run(&program, &model, machine, Options::NONE, 100_000, &mut moves);
    let stands = result.state.machine(&model, machine);
    (moves.made, result, stands)
}

fn number(value: f64) -> String {
    if value.is_nan() {
        return "?".to_owned();
    }
    let text = format!("{value:.4}");
    let text = text.trim_end_matches('0').trim_end_matches('.');
    if text == "-0" { "0".to_owned() } else { text.to_owned() }
}

fn xyz(position: &Position) -> String {
    [Axis::X, Axis::Y, Axis::Z].map(|axis| number(position.raw(axis))).join(" ")
}

/// A line a move: the programmed point and where the axes are, then where the program ends.
fn check(machine: &Machine, text: &str, expected: &Expect) {
    let (moves, result, stands) = run_on(machine, text);
    let mut shown = String::new();
    for [programmed, to, _] in &moves {
        writeln!(shown, "{} -> {}", xyz(programmed), xyz(to)).unwrap();
    }
    writeln!(shown, "reads {}, stands {}", xyz(result.state.position()), xyz(&stands)).unwrap();
    expected.assert_eq(&shown);
}

// ---- length along the tool ----

/// With A carrying B the tool leans by sin b, -sin a cos b, cos a cos b; with B carrying A by sin b cos a, -sin a, cos b cos a.
#[test]
fn a_length_of_100_along_a_tool_that_leans_20_degrees_twice() {
    let program = "G21 G90 G54 G0 X0. Y0. Z0. A0. B0.\nG143 H1 X10. Y20. Z30. A-20. B-20.\n";
    let mut machine = machine(100.0, 10.0);
    check(
        &machine,
        program,
        &expect![[r#"
        0 0 0 -> 0 0 0
        10 20 30 -> -24.202 52.1394 118.3022
        reads 10 20 30, stands -24.202 52.1394 118.3022
    "#]],
    );
    machine.kinematics = Some(head(RotaryAxis::B, RotaryAxis::A));
    check(
        &machine,
        program,
        &expect![[r#"
        0 0 0 -> 0 0 0
        10 20 30 -> -22.1394 54.202 118.3022
        reads 10 20 30, stands -22.1394 54.202 118.3022
    "#]],
    );
}

#[test]
fn an_axis_that_turns_the_other_way() {
    let mut machine = machine(100.0, 10.0);
    machine.kinematics = Some(Kinematics { sign: [-1.0, 1.0], ..head(RotaryAxis::A, RotaryAxis::B) });
    check(
        &machine,
        "G21 G90 G54\nG143 H1 X0. Y0. Z0. A90. B0.\nX0. Y0. Z0. A0. B90.\n",
        &expect![[r#"
        0 0 0 -> 0 100 0
        0 0 0 -> 100 0 0
        reads 0 0 0, stands 100 0 0
    "#]],
    );
}

#[test]
fn a_positive_length_moves_z_up_and_a_negative_one_down() {
    check(
        &machine(4.0, 1.0),
        "G21 G90 G54\nG143 H1 X0. Y0. Z1. A0. B0.\n",
        &expect![[r#"
        0 0 1 -> 0 0 5
        reads 0 0 1, stands 0 0 5
    "#]],
    );
    check(
        &machine(-4.0, 1.0),
        "G21 G90 G54\nG143 H1 X0. Y0. Z1. A0. B0.\n",
        &expect![[r#"
        0 0 1 -> 0 0 -3
        reads 0 0 1, stands 0 0 -3
    "#]],
    );
}

#[test]
fn axes_that_a_block_does_not_name_stand_still() {
    let program = "G21 G90 G54\nG143 H1 X0. Y0. Z0. A0. B0.\nA90.\nZ0.\nX5.\nY0.\n";
    check(
        &machine(10.0, 1.0),
        program,
        &expect![[r#"
        0 0 0 -> 0 0 10
        0 0 0 -> 0 0 10
        0 0 0 -> 0 0 0
        5 0 0 -> 5 0 0
        5 0 0 -> 5 -10 0
        reads 5 0 0, stands 5 -10 0
    "#]],
    );
}

#[test]
fn switched_on_and_off_the_axes_stand_still() {
    let program = "G21 G90 G54\nG0 X0. Y0. Z50. A0. B90.\nG143 H1\nG49\nG143 H1 X1. Y1. Z1. A0. B90.\nG49\nG0 Z0.\nX0. Y0.\n";
    check(
        &machine(10.0, 1.0),
        program,
        &expect![[r#"
        0 0 50 -> 0 0 50
        1 1 1 -> 11 1 1
        11 1 0 -> 11 1 0
        0 0 0 -> 0 0 0
        reads 0 0 0, stands 0 0 0
    "#]],
    );
}

#[test]
fn no_length_cancels_by_a_word_alone_too() {
    let program = "G21 G90 G54\nG143 H1 X0. Y0. Z0. A0. B90.\nH0 X0. Y0. Z0.\nX1.\n";
    check(
        &machine(10.0, 1.0),
        program,
        &expect![[r#"
        0 0 0 -> 10 0 0
        0 0 0 -> 0 0 0
        1 0 0 -> 1 0 0
        reads 1 0 0, stands 1 0 0
    "#]],
    );
    let (_, result, _) = run_on(&machine(10.0, 1.0), program);
    assert_eq!(result.state.tool_shift().along_tool(), None);
}

#[test]
fn in_place_of_a_length_along_z() {
    let program = "G21 G90 G54\nG0 X0. Y0. A0. B0.\nG43 H1 Z5.\nG143\nX0. Y0. Z5. A90. B0.\nG43 H1 Z5.\n";
    check(
        &machine(10.0, 1.0),
        program,
        &expect![[r#"
        0 0 0 -> 0 0 0
        0 0 5 -> 0 0 5
        0 0 5 -> 0 -10 5
        0 -10 5 -> 0 -10 5
        reads 0 -10 5, stands 0 -10 15
    "#]],
    );
}

#[test]
fn an_unknown_length_of_an_upright_tool_leaves_x_and_y_known() {
    let mut machine = machine(10.0, 1.0);
    machine.tools.clear();
    let program =
        "G21 G90 G54\nG143 H1 X0. Y0. Z0. A0. B0.\nX1. Y1. Z1. A0. B5.\nG49\nG0 X2. Y2. Z2. A0. B0.\n";
    check(
        &machine,
        program,
        &expect![[r#"
        0 0 0 -> 0 0 ?
        1 1 1 -> ? 1 ?
        2 2 2 -> 2 2 2
        reads 2 2 2, stands 2 2 2
    "#]],
    );
    let (_, result, _) = run_on(&machine, program);
    assert!(result.assumptions.contains(&Assumption::ToolLength(1)));
    assert!(result.assumptions.contains(&Assumption::HeadKinematics));
    assert!(result.assumptions.contains(&Assumption::UprightTool));
}

#[test]
fn unknown_angles_make_the_axes_unknown() {
    let mut machine = machine(10.0, 1.0);
    machine.start = None;
    check(
        &machine,
        "G21 G90 G54\nG143 H1 X0. Y0. Z0.\nX0. Y0. Z0. A0. B0.\n",
        &expect![[r#"
        0 0 0 -> ? ? ?
        0 0 0 -> 0 0 10
        reads 0 0 0, stands 0 0 10
    "#]],
    );
}

#[test]
fn a_table_that_turns_the_part_is_not_guessed_at() {
    let mut machine = machine(10.0, 1.0);
    machine.kinematics =
        Some(Kinematics { arrangement: Arrangement::TableTable, ..head(RotaryAxis::A, RotaryAxis::B) });
    check(
        &machine,
        "G21 G90 G54\nG143 H1 X0. Y0. Z0. A0. B0.\nG49\nG0 X0. Y0. Z0.\n",
        &expect![[r#"
        0 0 0 -> ? ? ?
        0 0 0 -> 0 0 0
        reads 0 0 0, stands 0 0 0
    "#]],
    );
}

#[test]
fn another_work_offset_under_the_length() {
    let mut machine = machine(10.0, 1.0);
    let mut second = WorkOffset::ZERO;
    second.origin.set(Axis::X, 100.0);
    machine.offsets.insert(2, second);
    check(
        &machine,
        "G21 G90 G54\nG143 H1 X0. Y0. Z0. A0. B90.\nG55\nX0. Y0. Z0. A0. B90.\nG54\n",
        &expect![[r#"
        0 0 0 -> 10 0 0
        0 0 0 -> 10 0 0
        reads 100 0 0, stands 110 0 0
    "#]],
    );
}

#[test]
fn what_is_refused_beside_it_is_not_computed() {
    let arc = "G21 G90 G54 F100.\nG143 H1 X0. Y0. Z0. A0. B90.\nG2 X10. Y0. R5.\nG49 G0 X0. Y0. Z0.\n";
    check(
        &machine(10.0, 1.0),
        arc,
        &expect![[r#"
        0 0 0 -> 10 0 0
        0 0 0 -> 0 0 0
        reads 0 0 0, stands 0 0 0
    "#]],
    );
    let planar =
        "G21 G90 G54 F100.\nG143 H1 X0. Y0. Z0. A0. B90.\nG1 G41 D1 X10. Y0. Z0.\nX20. Y0. Z0.\nG40\nG49\n";
    check(
        &machine(10.0, 1.0),
        planar,
        &expect![[r#"
        0 0 0 -> 10 0 0
        10 0 0 -> ? ? ?
        20 0 0 -> ? ? ?
        reads ? ? ?, stands ? ? ?
    "#]],
    );
}

// ---- size along vectors ----

#[test]
fn a_point_is_shifted_by_the_radius_along_its_vector() {
    let program = "G21 G90 G54 F100.\nG1 G141 D1 X1. Y2. Z3. I0. J0.6 K0.8\nX2. I1. J0. K0.\nG0 Z10. I0. J0. K-1.\nG40\nZ20.\n";
    check(
        &machine(0.0, 10.0),
        program,
        &expect![[r#"
        1 2 3 -> 1 5 7
        2 2 3 -> 7 5 7
        2 2 10 -> 7 5 5
        7 5 20 -> 7 5 20
        reads 7 5 20, stands 7 5 20
    "#]],
    );
}

#[test]
fn a_negative_size_reverses_the_shift() {
    check(
        &machine(0.0, 10.0),
        "G21 G90 G54 F100.\nG1 G141 D2 X0. Y0. Z0. I0. J0.6 K0.8\n",
        &expect![[r#"
        0 0 0 -> 0 -6 -8
        reads 0 0 0, stands 0 -6 -8
    "#]],
    );
}

#[test]
fn the_offset_may_change_on_the_way() {
    let program =
        "G21 G90 G54 F100.\nG1 G141 D1 X0. Y0. Z0. I1. J0. K0.\nD2 X1. I1. J0. K0.\nD0 X2. I1. J0. K0.\n";
    check(
        &machine(0.0, 10.0),
        program,
        &expect![[r#"
        0 0 0 -> 5 0 0
        1 0 0 -> -9 0 0
        2 0 0 -> 2 0 0
        reads 2 0 0, stands 2 0 0
    "#]],
    );
}

#[test]
fn a_direction_is_the_same_in_inches() {
    check(
        &machine(0.0, 25.4),
        "G20 G90 G54 F10.\nG1 G141 D1 X1. Y0. Z0. I0. J0.6 K0.8\n",
        &expect![[r#"
        25.4 0 0 -> 25.4 7.62 10.16
        reads 25.4 0 0, stands 25.4 7.62 10.16
    "#]],
    );
}

#[test]
fn without_a_direction_the_axes_of_the_block_are_unknown_and_the_others_stay() {
    let program = "G21 G90 G54 F100.\nG1 G141 D1 X0. Y0. Z0. I0.6 J0.8\nX1. I0.6\nX2.\nX3. I#500 J0. K0.\nG40\nG0 X0. Y0. Z0.\n";
    check(
        &machine(0.0, 10.0),
        program,
        &expect![[r#"
        0 0 0 -> 3 4 0
        1 0 0 -> 4 4 0
        2 0 0 -> ? 4 0
        3 0 0 -> ? 4 0
        0 0 0 -> 0 0 0
        reads 0 0 0, stands 0 0 0
    "#]],
    );
}

#[test]
fn increments_count_from_the_programmed_point() {
    let program =
        "G21 G90 G54 F100.\nG1 G141 D1 X0. Y0. Z0. I1. J0. K0.\nG91 X1. I1. J0. K0.\nX1. I0. J0. K1.\n";
    check(
        &machine(0.0, 10.0),
        program,
        &expect![[r#"
        0 0 0 -> 5 0 0
        1 0 0 -> 6 0 0
        2 0 0 -> 2 0 0
        reads 2 0 0, stands 2 0 0
    "#]],
    );
}

proptest! {
    /// An upright tool is compensated as along Z, whatever the length.
    #[test]
    fn zero_angles_are_as_a_length_along_z(point in prop::array::uniform3(-500_i32..500), length in -300_i32..300) {
        let [x, y, z] = point;
        let machine = machine(f64::from(length), 1.0);
        let along = |code: &str| {
            let text = format!("G21 G90 G54 G0 A0. B0.\n{code} H1 X{x}. Y{y}. Z{z}.\nM0\n");
            run_on(&machine, &text).2
        };
        prop_assert_eq!(along("G143"), along("G43"));
    }

    /// The axes are beside the posted point by the length, however the head turns; with no length they are at it.
    #[test]
    fn tilting_keeps_the_length(
        angles in prop::array::uniform2(-3600_i32..3600), length in 0_i32..300, order in any::<bool>(),
    ) {
        let [a, b] = angles.map(|tenths| f64::from(tenths) / 10.0);
        let mut machine = machine(f64::from(length), 1.0);
        let (first, second) = if order { (RotaryAxis::A, RotaryAxis::B) } else { (RotaryAxis::B, RotaryAxis::A) };
        machine.kinematics = Some(head(first, second));
        let (moves, ..) = run_on(&machine, &format!("G21 G90 G54\nG143 H1 X10. Y20. Z30. A{a:.1} B{b:.1}\n"));
        let [programmed, to, _] = moves.last().unwrap();
        let away = [Axis::X, Axis::Y, Axis::Z].map(|axis| (to.raw(axis) - programmed.raw(axis)).powi(2));
        let away = away.iter().sum::<f64>().sqrt();
        prop_assert!((away - f64::from(length)).abs() < 1e-9, "{} instead of {}", away, length);
    }

    /// The shift is as long as the radius, along the vector.
    #[test]
    fn the_shift_is_the_radius_along_the_vector(parts in prop::array::uniform3(-100_i32..100), diameter in -100_i32..100) {
        let parts = parts.map(f64::from);
        let length = parts.iter().map(|part| part * part).sum::<f64>().sqrt();
        prop_assume!(length > 1.0);
        let [i, j, k] = parts.map(|part| part / length);
        let machine = machine(0.0, f64::from(diameter));
        let (moves, ..) =
            run_on(&machine, &format!("G21 G90 G54 F9.\nG1 G141 D1 X1. Y2. Z3. I{i:.9} J{j:.9} K{k:.9}\n"));
        let [programmed, to, _] = moves.last().unwrap();
        for (axis, part) in [Axis::X, Axis::Y, Axis::Z].into_iter().zip([i, j, k]) {
            let by = to.raw(axis) - programmed.raw(axis);
            prop_assert!((by - part * f64::from(diameter) / 2.0).abs() < 1e-6);
        }
    }
}
