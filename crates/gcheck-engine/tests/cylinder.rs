//! Cylindrical mapping: which diameter counts, where a wrapped drawing turns the part, what ends it.

mod cycle_harness;

use cycle_harness::{machine, shown_on};
use expect_test::{Expect, expect};
use gcheck_engine::{Axis, Machine, WorkOffset};

/// Millimetres; the part is at `X0 Y10 A0`, so that the work coordinates tell the drawing from the axis.
fn check_on(machine: &Machine, text: &str, expected: &Expect) {
    let text = format!("O1\nG21 G90 G54 G0 X0. Y10. A0.\nZ5.\nF200.\n{text}\nM30\n");
    expected.assert_eq(&shown_on("haas-mill", "XYZA", machine, &text));
}

fn check(text: &str, expected: &Expect) {
    check_on(&machine(10.0), text, expected);
}

fn told(settings: &[(&str, &str)]) -> Machine {
    let settings = settings.iter().map(|(number, value)| ((*number).to_owned(), (*value).to_owned()));
    Machine { settings: settings.collect(), ..machine(10.0) }
}

#[test]
fn a_length_on_the_surface_turns_the_part_both_ways() {
    // A diameter of 100 has a circumference of 314.159.
    check(
        "G107 Y0. A0. Q100.\nG1 Y41.4159\nY-68.5398\nG107",
        &expect![[r#"
            rapid x0 y10 z0 a0
            rapid x0 y10 z5 a0
            feed x0 y41.4159 z5 a36
            feed x0 y-68.5398 z5 a-90
            at x0 y10 z5 a-90"#]],
    );
}

#[test]
fn increments_wrap_as_they_come() {
    check(
        "G107 Y0. A0. R50.\nG91 G1 X1. Y31.4159\nY-31.4159\nG90 G107\nG0 Y12.",
        &expect![[r#"
        rapid x0 y10 z0 a0
        rapid x0 y10 z5 a0
        feed x1 y41.4159 z5 a36
        feed x1 y10 z5 a0
        rapid x1 y12 z5 a0
        at x1 y12 z5 a0"#]],
    );
}

#[test]
fn arcs_are_drawn_on_the_unrolled_surface() {
    check(
        "G107 Y0. A0. Q100.\nG2 X20. Y10. I10. J0.\nG3 X20. Y50. J20.\nG107",
        &expect![[r#"
        rapid x0 y10 z0 a0
        rapid x0 y10 z5 a0
        cw x20 y10 z5 a0 about 10 10
        ccw x20 y50 z5 a45.8366 about 20 30
        at x20 y10 z5 a45.8366"#]],
    );
}

#[test]
fn any_linear_axis_goes_on_any_rotary_axis() {
    check(
        "G0 B0.\nG107 X0. B0. Q100.\nG1 X31.4159\nG107\nG0 X1.",
        &expect![[r#"
        rapid x0 y10 z0 a0
        rapid x0 y10 z5 a0
        rapid x0 y10 z5 a0
        feed x31.4159 y10 z5 a0
        rapid x1 y10 z5 a0
        at x1 y10 z5 a0"#]],
    );
    check(
        "G107 Z0. A0. Q100.\nG1 Z36.4159\nG107",
        &expect![[r#"
        rapid x0 y10 z0 a0
        rapid x0 y10 z5 a0
        feed x0 y10 z36.4159 a36
        at x0 y10 z5 a36"#]],
    );
}

#[test]
fn the_diameter_stays_the_default_of_its_axis() {
    check(
        "G107 A0. Q100.\nG0 Y10.\nG107 Y0. A0.\nG1 Y41.4159\nG107\nG0 Y10. A0.\nG107 Y0. A0.\nG1 Y41.4159",
        &expect![[r#"
        rapid x0 y10 z0 a0
        rapid x0 y10 z5 a0
        rapid x0 y10 z5 a0
        feed x0 y41.4159 z5 a36
        rapid x0 y10 z5 a0
        feed x0 y41.4159 z5 a36
        at x0 y10 z5 a36"#]],
    );
}

#[test]
fn a_default_for_one_axis_says_nothing_of_another() {
    check(
        "G0 B0.\nG107 A0. Q100.\nG107 Y0. B0.\nG1 Y41.4159",
        &expect![[r#"
        rapid x0 y10 z0 a0
        rapid x0 y10 z5 a0
        rapid x0 y10 z5 a0
        feed x0 y41.4159 z5 a0
        at x0 y10 z5 a0"#]],
    );
}

#[test]
fn setting_a_default_leaves_mapping_as_it_is() {
    check(
        "G107 Y0. A0. Q100.\nG107 A0. Q50.\nG1 Y41.4159\nG107 Y0. A0.\nG1 Y72.8318",
        &expect![[r#"
        rapid x0 y10 z0 a0
        rapid x0 y10 z5 a0
        feed x0 y41.4159 z5 a36
        feed x0 y72.8318 z5 a107.9999
        at x0 y10 z5 a107.9999"#]],
    );
}

#[test]
fn a_drawing_goes_on_with_another_diameter() {
    check(
        "G107 Y0. A0. Q100.\nG1 Y41.4159\nG107 Y0. A0. Q50.\nY10.\nG107",
        &expect![[r#"
        rapid x0 y10 z0 a0
        rapid x0 y10 z5 a0
        feed x0 y41.4159 z5 a36
        feed x0 y10 z5 a-36
        at x0 y10 z5 a-36"#]],
    );
}

#[test]
fn without_a_size_the_setting_counts() {
    check_on(
        &told(&[("34", "100")]),
        "G107 Y0. A0.\nG1 Y41.4159",
        &expect![[r#"
        rapid x0 y10 z0 a0
        rapid x0 y10 z5 a0
        feed x0 y41.4159 z5 a36
        at x0 y10 z5 a36"#]],
    );
    check_on(
        &told(&[("34", "50"), ("79", "100")]),
        "G0 B0.\nG107 Y0. B0.\nG1 Y41.4159",
        &expect![[r#"
        rapid x0 y10 z0 a0
        rapid x0 y10 z5 a0
        rapid x0 y10 z5 a0
        feed x0 y41.4159 z5 a0
        at x0 y10 z5 a0"#]],
    );
    // On a machine whose only rotary axis is B, that is the fourth axis.
    let axes = Some(vec![Axis::X, Axis::Y, Axis::Z, Axis::B]);
    let machine = Machine { axes, ..told(&[("34", "100")]) };
    let text = "O1\nG21 G90 G54 G0 X0. Y10. B0.\nF200.\nG107 Y0. B0.\nG1 Y41.4159\nM30\n";
    expect![[r#"
        rapid x0 y10 z0 b0
        feed x0 y41.4159 z0 b36
        at x0 y10 z0 b36"#]]
    .assert_eq(&shown_on("haas-mill", "XYZB", &machine, text));
}

#[test]
fn a_size_of_zero_goes_back_to_the_setting() {
    check_on(
        &told(&[("34", "100")]),
        "G107 A0. Q40.\nG107 Y0. A0. Q0.\nG1 Y41.4159",
        &expect![[r#"
        rapid x0 y10 z0 a0
        rapid x0 y10 z5 a0
        feed x0 y41.4159 z5 a36
        at x0 y10 z5 a36"#]],
    );
    check_on(
        &told(&[("34", "100")]),
        "G107 A0. Q40.\nG107 A0. R0.\nG107 Y0. A0.\nG1 Y41.4159",
        &expect![[r#"
        rapid x0 y10 z0 a0
        rapid x0 y10 z5 a0
        feed x0 y41.4159 z5 a36
        at x0 y10 z5 a36"#]],
    );
}

#[test]
fn a_cylinder_of_unknown_size_turns_nobody_knows_how_far() {
    check(
        "G107 Y0. A0.\nG1 X5. Y41.4159\nG107\nG0 Y12.",
        &expect![[r#"
        rapid x0 y10 z0 a0
        rapid x0 y10 z5 a0
        feed x5 y41.4159 z5 a?
        rapid x5 y12 z5 a?
        at x5 y12 z5 a?"#]],
    );
}

#[test]
fn a_drawing_begins_at_the_angle_where_the_axis_stands() {
    check(
        "G0 A90.\nG107 Y0. A0. Q100.\nG1 Y41.4159",
        &expect![[r#"
        rapid x0 y10 z0 a0
        rapid x0 y10 z5 a0
        rapid x0 y10 z5 a90
        feed x0 y41.4159 z5 a126
        at x0 y10 z5 a126"#]],
    );
    check(
        "G107 Y0. A0. Q100.\nG1 Y41.4159\nG0 A180.\nG1 Y72.8318",
        &expect![[r#"
        rapid x0 y10 z0 a0
        rapid x0 y10 z5 a0
        feed x0 y41.4159 z5 a36
        rapid x0 y41.4159 z5 a180
        feed x0 y72.8318 z5 a216
        at x0 y10 z5 a216"#]],
    );
}

#[test]
fn the_machine_axis_stands_still() {
    // #5022 and #5024 are the machine coordinates of Y and A.
    let mut machine = machine(10.0);
    machine.offsets = [(1, WorkOffset::ZERO)].into();
    check_on(
        &machine,
        "G107 Y0. A0. Q100.\nG1 Y41.4159\nX#5022\nX#5024",
        &expect![[r#"
        rapid x0 y10 z0 a0
        rapid x0 y10 z5 a0
        feed x0 y41.4159 z5 a36
        feed x10 y41.4159 z5 a36
        feed x36 y41.4159 z5 a36
        at x36 y10 z5 a36"#]],
    );
}

#[test]
fn compensation_is_that_of_the_drawing() {
    check(
        "G107 Y0. A0. Q100.\nG41 D1 G1 X10. Y20.\nX30.\nY41.4159\nG40 X50.\nG107",
        &expect![[r#"
        rapid x0 y10 z0 a0
        rapid x0 y10 z5 a0
        feed x10 y25 z5 a17.1887
        feed x25 y25 z5 a17.1887
        feed x25 y41.4159 z5 a36
        feed x50 y41.4159 z5 a36
        at x50 y10 z5 a36"#]],
    );
}

#[test]
fn a_word_that_may_be_nothing_may_begin_nothing() {
    check(
        "G107 Y#100 A0. Q100.\nG1 Y41.4159\nG107\nG0 Y12.",
        &expect![[r#"
        rapid x0 y10 z0 a0
        rapid x0 y10 z5 a0
        feed x0 y41.4159 z5 a0
        rapid x0 y12 z5 a0
        at x0 y12 z5 a0"#]],
    );
    let machine = Machine { fresh: false, ..machine(10.0) };
    check_on(
        &machine,
        "G107 Y#100 A0. Q100.\nG1 Y41.4159\nG107\nG0 Y12.",
        &expect![[r#"
        rapid x0 y10 z0 a0
        rapid x0 y10 z5 a0
        feed x0 y41.4159 z5 a?
        rapid x? y12 z? a?
        at x? y? z? a?"#]],
    );
}

#[test]
fn moves_that_compensation_holds_back_are_of_the_drawing_before() {
    check(
        "G107 Y0. A0. Q100.\nG41 D1 G1 X10. Y20.\nX30.\nY41.4159\nG107\nG40 X50.",
        &expect![[r#"
        rapid x0 y10 z0 a0
        rapid x0 y10 z5 a0
        feed x10 y25 z5 a17.1887
        feed x25 y25 z5 a17.1887
        feed x25 y41.4159 z5 a36
        feed x50 y41.4159 z5 a36
        at x50 y41.4159 z5 a36"#]],
    );
}

#[test]
fn words_that_do_not_fit_are_refused() {
    check(
        "N5 G107 Y0. Q100.",
        &expect![[r#"
        rapid x0 y10 z0 a0
        rapid x0 y10 z5 a0
        MissingWord(A) in N5
        at x0 y10 z5 a0"#]],
    );
    check(
        "N5 G107 R50.",
        &expect![[r#"
        rapid x0 y10 z0 a0
        rapid x0 y10 z5 a0
        MissingWord(A) in N5
        at x0 y10 z5 a0"#]],
    );
    check(
        "N5 G107 X0. Y0. A0. Q100.",
        &expect![[r#"
        rapid x0 y10 z0 a0
        rapid x0 y10 z5 a0
        Conflict in N5
        at x0 y10 z5 a0"#]],
    );
    check(
        "N5 G107 Y0. A0. B0. Q100.",
        &expect![[r#"
        rapid x0 y10 z0 a0
        rapid x0 y10 z5 a0
        Conflict in N5
        at x0 y10 z5 a0"#]],
    );
    check(
        "N5 G107 Y0. A0. Q100. R50.",
        &expect![[r#"
        rapid x0 y10 z0 a0
        rapid x0 y10 z5 a0
        Conflict in N5
        at x0 y10 z5 a0"#]],
    );
    let axes = Some(vec![Axis::X, Axis::Y, Axis::Z, Axis::A]);
    check_on(
        &Machine { axes, ..machine(10.0) },
        "N5 G107 Y0. B0. Q100.",
        &expect![[r#"
        rapid x0 y10 z0 a0
        rapid x0 y10 z5 a0
        NoSuchAxis(B) in N5
        at x0 y10 z5 a0"#]],
    );
}

#[test]
fn a_new_work_offset_moves_the_drawing_with_it() {
    let mut machine = machine(10.0);
    let mut second = WorkOffset::ZERO;
    second.origin.set(Axis::Y, 100.0);
    machine.offsets = [(1, WorkOffset::ZERO), (2, second)].into();
    check_on(
        &machine,
        "G107 Y0. A0. Q100.\nG55\nG1 Y-58.5841\nG107\nX#5022",
        &expect![[r#"
        rapid x0 y10 z0 a0
        rapid x0 y10 z5 a0
        feed x0 y-58.5841 z5 a36
        feed x10 y-90 z5 a36
        at x10 y10 z5 a36"#]],
    );
}

#[test]
fn what_returns_to_its_reference_leaves_the_drawing() {
    check(
        "G107 Y0. A0. Q100.\nG91 G28 Y0.\nG90 G107",
        &expect![[r#"
        rapid x0 y10 z0 a0
        rapid x0 y10 z5 a0
        rapid x0 y10 z5 a0
        rapid x0 y? z5 a?
        at x0 y0 z5 a0"#]],
    );
    check(
        "G107 Y0. A0. Q100.\nG91 G28 Z0.\nG90 G1 Y41.4159",
        &expect![[r#"
        rapid x0 y10 z0 a0
        rapid x0 y10 z5 a0
        rapid x0 y10 z5 a0
        rapid x0 y10 z0 a0
        feed x0 y41.4159 z0 a36
        at x0 y10 z0 a36"#]],
    );
}
