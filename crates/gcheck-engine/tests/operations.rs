//! Operations of mills: round pockets, pockets of any outline, hole patterns.

mod cycle_harness;

use cycle_harness::{machine, shown_on};
use expect_test::{Expect, expect};

/// Millimetres; tool 1 has a diameter of 10 mm.
fn check(text: &str, expected: &Expect) {
    let text = format!("O1\nG21 G90 G54 G0 X0. Y0.\nS3000 M3\nZ5.\nF200.\n{text}\nM30\n");
    expected.assert_eq(&shown_on("haas-mill", "XYZ", &machine(10.0), &text));
}

#[test]
fn a_round_pocket_begins_and_ends_in_its_centre() {
    check(
        "G13 I8. Z-3. D1 F100.\nG0 Z5.",
        &expect![[r#"
        rapid x0 y0 z0
        rapid x0 y0 z5
        feed x0 y0 z-3
        ccw x3 y0 z-3 about 1.5 0
        ccw x3 y0 z-3 about 0 0
        ccw x0 y0 z-3 about 1.5 0
        rapid x0 y0 z5
        at x0 y0 z5"#]],
    );
}

#[test]
fn circles_grow_from_i_to_k() {
    check(
        "G12 X20. I8. K13. Q4. Z-3. D0",
        &expect![[r#"
        rapid x0 y0 z0
        rapid x0 y0 z5
        rapid x20 y0 z5
        feed x20 y0 z-3
        cw x28 y0 z-3 about 24 0
        cw x28 y0 z-3 about 20 0
        cw x8 y0 z-3 about 18 0
        cw x8 y0 z-3 about 20 0
        cw x33 y0 z-3 about 20.5 0
        cw x33 y0 z-3 about 20 0
        cw x20 y0 z-3 about 26.5 0
        at x20 y0 z-3"#]],
    );
}

#[test]
fn rounds_go_deeper_in_increments() {
    check(
        "G0 Z0.\nG91 G13 I8. Z-1. L2 D1",
        &expect![[r#"
        rapid x0 y0 z0
        rapid x0 y0 z5
        rapid x0 y0 z0
        feed x0 y0 z-1
        ccw x3 y0 z-1 about 1.5 0
        ccw x3 y0 z-1 about 0 0
        ccw x0 y0 z-1 about 1.5 0
        feed x0 y0 z-2
        ccw x3 y0 z-2 about 1.5 0
        ccw x3 y0 z-2 about 0 0
        ccw x0 y0 z-2 about 1.5 0
        at x0 y0 z-2"#]],
    );
}

#[test]
fn a_tool_too_large_for_its_pocket_is_refused() {
    check(
        "N5 G13 I5. Z-3. D1",
        &expect![[r#"
        rapid x0 y0 z0
        rapid x0 y0 z5
        Cycle(Geometry) in N5
        at x0 y0 z5"#]],
    );
    check(
        "N5 G13 Z-3. D1",
        &expect![[r#"
        rapid x0 y0 z0
        rapid x0 y0 z5
        Cycle(Missing(I)) in N5
        at x0 y0 z5"#]],
    );
}

#[test]
fn a_tool_of_unknown_size_still_ends_on_the_floor() {
    check(
        "G13 X4. I8. Z-3. D9",
        &expect![[r#"
        rapid x0 y0 z0
        rapid x0 y0 z5
        at x4 y0 z-3"#]],
    );
}

const OUTLINE: &str = "\nO1001\nG1 X20.\nY10.\nX-20.\nY-10.\nX20.\nY0.\nM99";

#[test]
fn a_pocket_goes_down_its_levels_and_back() {
    check(
        &format!("G150 G41 D1 P1001 X0. Y0. Z-4. Q2. R1. J4. K0.2 F100.\nG40 X1.\nM30{OUTLINE}"),
        &expect![[r#"
        rapid x0 y0 z0
        rapid x0 y0 z5
        rapid x0 y0 z5
        rapid x0 y0 z1
        feed x0 y0 z-1
        feed x0 y0 z-3
        feed x0 y0 z-4
        rapid x0 y0 z1
        rapid x1 y0 z1
        at x1 y0 z1"#]],
    );
}

#[test]
fn an_open_outline_is_refused() {
    let open = OUTLINE.replace("\nY0.", "");
    check(
        &format!("N5 G150 P1001 X0. Y0. Z-4. Q2. R1. J4.\nM30{open}"),
        &expect![[r#"
            rapid x0 y0 z0
            rapid x0 y0 z5
            Cycle(OutlineOpen(10.0)) in N5
            at x0 y0 z5"#]],
    );
    check(
        &format!("N5 G150 P1001 X50. Y0. Z-4. Q2. R1. J4.\nM30{OUTLINE}"),
        &expect![[r#"
            rapid x0 y0 z0
            rapid x0 y0 z5
            Cycle(StartOutside) in N5
            at x0 y0 z5"#]],
    );
    check(
        &format!("N5 G150 P1001 Z-4. Q2. R1. J4. I2.\nM30{OUTLINE}"),
        &expect![[r#"
        rapid x0 y0 z0
        rapid x0 y0 z5
        Conflict in N5
        at x0 y0 z5"#]],
    );
}

#[test]
fn an_outline_elsewhere_leaves_the_tool_over_its_start() {
    check(
        "G150 P1001 X7. Y0. Z-4. Q2. R1. J4.\nG0 X8.",
        &expect![[r#"
        rapid x0 y0 z0
        rapid x0 y0 z5
        rapid x8 y0 z1
        at x8 y0 z1"#]],
    );
}

#[test]
fn holes_on_a_circle_run_the_cycle_that_was_kept() {
    check(
        "G99 G81 Z-3. R1. F100. L0\nG70 I10. J90. L4\nG80",
        &expect![[r#"
        rapid x0 y0 z0
        rapid x0 y0 z5
        rapid x0 y10 z5
        rapid x0 y10 z1
        feed x0 y10 z-3
        rapid x0 y10 z1
        rapid x-10 y0 z1
        feed x-10 y0 z-3
        rapid x-10 y0 z1
        rapid x0 y-10 z1
        feed x0 y-10 z-3
        rapid x0 y-10 z1
        rapid x10 y0 z1
        feed x10 y0 z-3
        rapid x10 y0 z1
        at x10 y0 z1"#]],
    );
}

#[test]
fn holes_on_an_arc_and_a_line() {
    check(
        "G98 G81 Z-3. R1. F100. L0\nG71 X10. Y10. I10. J0. K90. L2\nG72 X0. Y0. I5. J0. L2\nG80",
        &expect![[r#"
        rapid x0 y0 z0
        rapid x0 y0 z5
        rapid x20 y10 z5
        rapid x20 y10 z1
        feed x20 y10 z-3
        rapid x20 y10 z5
        rapid x10 y20 z5
        rapid x10 y20 z1
        feed x10 y20 z-3
        rapid x10 y20 z5
        rapid x0 y0 z5
        rapid x0 y0 z1
        feed x0 y0 z-3
        rapid x0 y0 z5
        rapid x5 y0 z5
        rapid x5 y0 z1
        feed x5 y0 z-3
        rapid x5 y0 z5
        at x5 y0 z5"#]],
    );
}

#[test]
fn a_pattern_may_name_its_cycle() {
    check(
        "G99 G82 Z-3. R1. P0.5 F100. G72 I5. J0. L2\nG80",
        &expect![[r#"
        rapid x0 y0 z0
        rapid x0 y0 z5
        rapid x0 y0 z1
        feed x0 y0 z-3
        dwell 0.5
        rapid x0 y0 z1
        rapid x5 y0 z1
        feed x5 y0 z-3
        dwell 0.5
        rapid x5 y0 z1
        at x5 y0 z1"#]],
    );
}

#[test]
fn patterns_lack_words() {
    check(
        "G81 Z-3. R1. L0\nN5 G70 I10.",
        &expect![[r#"
        rapid x0 y0 z0
        rapid x0 y0 z5
        Cycle(Missing(L)) in N5
        at x0 y0 z5"#]],
    );
    check(
        "G81 Z-3. R1. L0\nN5 G71 I10. L3",
        &expect![[r#"
        rapid x0 y0 z0
        rapid x0 y0 z5
        Cycle(Missing(K)) in N5
        at x0 y0 z5"#]],
    );
    check(
        "G81 Z-3. R1. L0\nN5 G70 I10. L0",
        &expect![[r#"
        rapid x0 y0 z0
        rapid x0 y0 z5
        Cycle(ZeroRepeats) in N5
        at x0 y0 z5"#]],
    );
}
