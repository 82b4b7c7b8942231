//! Moves of mills as programs give them: which code moves, how, and to where.

mod cycle_harness;

use cycle_harness::{machine, shown_on};
use expect_test::{Expect, expect};

/// Millimetres; the machine is at zero.
fn check(control: &str, text: &str, expected: &Expect) {
    let text = format!("O1\nG21 G90 G54\n{text}\nM30\n");
    expected.assert_eq(&shown_on(control, "XYZ", &machine(10.0), &text));
}

#[test]
fn a_tap_of_one_block_goes_in_and_out() {
    check(
        "haas-mill",
        "G0 X1. Y2. Z3.\nG184 X-5. F100. S200\nX4.",
        &expect![[r#"
        rapid x1 y2 z3
        feed x-5 y2 z3
        feed x1 y2 z3
        rapid x4 y2 z3
        at x4 y2 z3"#]],
    );
    check(
        "haas-mill",
        "G0 X1. Y2. Z3.\nG174 Z-5. F100. S200\nN7 G184 Z-6. F0",
        &expect![[r#"
        rapid x1 y2 z3
        feed x1 y2 z-5
        feed x1 y2 z3
        NoFeed in N7
        at x1 y2 z3"#]],
    );
}

#[test]
fn a_code_that_moves_in_its_own_block_leaves_the_mode() {
    check(
        "fanuc-mill",
        "G1 X1. F100.\nG60 X2.\nX3.",
        &expect![[r#"
        feed x1 y0 z0
        rapid x2 y0 z0
        feed x3 y0 z0
        at x3 y0 z0"#]],
    );
    check(
        "fanuc-mill",
        "G1 X1. F100.\nG27 X0. Y0.\nX3.",
        &expect![[r#"
        feed x1 y0 z0
        rapid x0 y0 z0
        feed x3 y0 z0
        at x3 y0 z0"#]],
    );
}

#[test]
fn a_centre_alone_turns_a_full_circle_while_arcs_are_the_mode() {
    check(
        "haas-mill",
        "G0 X2. Y0. Z0.\nG3 I-2. F100.\nI-2. J0\nG1 X0.\nI-2.",
        &expect![[r#"
        rapid x2 y0 z0
        ccw x2 y0 z0 about 0 0
        ccw x2 y0 z0 about 0 0
        feed x0 y0 z0
        at x0 y0 z0"#]],
    );
}

#[test]
fn a_cut_is_repeated_and_goes_on_in_increments() {
    check(
        "haas-mill",
        "G0 X2. Y0. Z0.\nG91 G3 I-2. Z1. L3 F100.\nG1 X5. L2\nG90",
        &expect![[r#"
            rapid x2 y0 z0
            ccw x2 y0 z1 about 0 0
            ccw x2 y0 z2 about 0 0
            ccw x2 y0 z3 about 0 0
            feed x7 y0 z3
            feed x12 y0 z3
            at x12 y0 z3"#]],
    );
    check(
        "haas-mill",
        "G0 X2. Y0. Z0.\nG3 I-2. L2 F100.\nG0 X3.",
        &expect![[r#"
            rapid x2 y0 z0
            ccw x2 y0 z0 about 0 0
            ccw x2 y0 z0 about 0 0
            rapid x3 y0 z0
            at x3 y0 z0"#]],
    );
}

#[test]
fn machine_coordinates_are_reached_in_rapid_or_as_the_mode_says() {
    check(
        "fanuc-mill",
        "G1 X1. F100.\nG53 Z9.\nX2.",
        &expect![[r#"
        feed x1 y0 z0
        rapid x1 y0 z9
        feed x2 y0 z9
        at x2 y0 z9"#]],
    );
    check(
        "fanuc-mill",
        "G2 X2. I1. F100.\nG53 Z9.",
        &expect![[r#"
        cw x2 y0 z0 about 1 0
        rapid x2 y0 z9
        at x2 y0 z9"#]],
    );
    check(
        "haas-mill",
        "G1 X1. F100.\nG53 Z9.\nX2.",
        &expect![[r#"
        feed x1 y0 z0
        feed x1 y0 z9
        feed x2 y0 z9
        at x2 y0 z9"#]],
    );
}

#[test]
fn the_way_back_from_a_reference_position_passes_the_point_of_the_way_there() {
    check(
        "fanuc-mill",
        "G0 X5. Y6. Z7.\nG28 X8. Z9.\nG29 X1. Z2.",
        &expect![[r#"
        rapid x5 y6 z7
        rapid x8 y6 z9
        rapid x0 y6 z0
        rapid x8 y6 z9
        rapid x1 y6 z2
        at x1 y6 z2"#]],
    );
    check(
        "fanuc-mill",
        "G0 X5. Y6. Z7.\nG28 X8. Z9.\nG91 G29 X1. Z2.",
        &expect![[r#"
        rapid x5 y6 z7
        rapid x8 y6 z9
        rapid x0 y6 z0
        rapid x8 y6 z9
        rapid x9 y6 z11
        at x9 y6 z11"#]],
    );
    check(
        "fanuc-mill",
        "G0 X5. Y6. Z7.\nG91 G28 Z3.\nG90 G29 X1. Z2.",
        &expect![[r#"
        rapid x5 y6 z7
        rapid x5 y6 z10
        rapid x5 y6 z0
        rapid x? y6 z10
        rapid x1 y6 z2
        at x1 y6 z2"#]],
    );
}

#[test]
fn the_third_reference_position_is_not_the_second() {
    check(
        "fanuc-mill",
        "G0 X5. Y6. Z7.\nG30 P3 Z9.\nG30 P2 X5.\nN8 G30 P5 Z9.",
        &expect![[r#"
        rapid x5 y6 z7
        rapid x5 y6 z9
        rapid x5 y6 z0
        rapid x5 y6 z0
        rapid x0 y6 z0
        WordRange(P) in N8
        at x0 y6 z0"#]],
    );
}

#[test]
fn an_increment_of_a_polar_angle_turns_on() {
    check(
        "fanuc-mill",
        "G16 G0 X10. Y30.\nG91 Y60.\nY90.\nG90 X5. Y0",
        &expect![[r#"
        rapid x8.6603 y5 z0
        rapid x0 y10 z0
        rapid x-10 y0 z0
        rapid x5 y0 z0
        at x5 y0 z0"#]],
    );
    check(
        "fanuc-mill",
        "G16 G0 X10. Y30.\nG91 X10. Y30.\nG90 X5. Y0",
        &expect![[r#"
        rapid x8.6603 y5 z0
        rapid x? y? z0
        rapid x5 y0 z0
        at x5 y0 z0"#]],
    );
}

#[test]
fn repeats_of_a_cycle_go_round_by_a_polar_angle() {
    check(
        "fanuc-mill",
        "G0 Z9.\nG16 G99 G81 X10. Y0. Z-1. R2. F100.\nG91 Y90. K3\nG80\nG15",
        &expect![[r#"
            rapid x0 y0 z9
            rapid x10 y0 z9
            rapid x10 y0 z2
            feed x10 y0 z-1
            rapid x10 y0 z2
            rapid x0 y10 z2
            feed x0 y10 z-1
            rapid x0 y10 z2
            rapid x-10 y0 z2
            feed x-10 y0 z-1
            rapid x-10 y0 z2
            rapid x0 y-10 z2
            feed x0 y-10 z-1
            rapid x0 y-10 z2
            at x0 y-10 z2"#]],
    );
}

#[test]
fn a_note_in_front_of_the_tape_is_no_program() {
    let text = |head: &str| format!("{head}%\nO1\nG21 G90 G54\nG0 X1.\n%\nG0 X2.\nM30\n");
    for head in ["", "\n", "(PART 12)\n", "(PART 12)\n(REV B)\n"] {
        let shown = shown_on("haas-mill", "XYZ", &machine(10.0), &text(head));
        expect![[r#"
            rapid x1 y0 z0
            at x1 y0 z0"#]]
        .assert_eq(&shown);
    }
}

#[test]
fn rows_of_data_are_not_executed() {
    check(
        "fanuc-mill",
        "G0 X1. Y2. Z3.\nG10 L3\nP1 L20\nT5 H5 X50.\nG11\nX4.",
        &expect![[r#"
        rapid x1 y2 z3
        rapid x4 y2 z3
        at x4 y2 z3"#]],
    );
    // A command ends the rows, whatever ends them by right.
    check(
        "fanuc-mill",
        "G0 X1. Y2. Z3.\nG10 L50\nN1320 P1 R5 X50.\nG1 X4. F100.\nX5.",
        &expect![[r#"
        rapid x1 y2 z3
        feed x4 y2 z3
        feed x5 y2 z3
        at x5 y2 z3"#]],
    );
    // A number that is not listed opens rows where a later block ends them, and is a command where none does.
    let unlisted = |opener: &str, end: &str| format!("G0 X1. Y2. Z3.\n#1=75\n{opener}\nP1 X5.\n{end}\nX4.");
    let passed = expect![[r#"
        rapid x1 y2 z3
        rapid x4 y2 z3
        at x4 y2 z3"#]];
    for opener in ["G10 L75", "G10 L#1"] {
        check("fanuc-mill", &unlisted(opener, "G11"), &passed);
    }
    check(
        "fanuc-mill",
        &unlisted("G10 L75", "G90"),
        &expect![[r#"
        rapid x1 y2 z3
        rapid x5 y2 z3
        rapid x4 y2 z3
        at x4 y2 z3"#]],
    );
}
