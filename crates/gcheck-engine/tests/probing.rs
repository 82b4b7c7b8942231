//! Probing moves and measurements: what is known after a touch that nobody can foretell, and what stays known.

mod cycle_harness;

use cycle_harness::{machine, shown_on};
use expect_test::{Expect, expect};
use gcheck_engine::{Machine, Position, WorkOffset};

/// Millimetres, from X0 Y0 Z5 in a `G54` that lies at X100 in machine coordinates; tool 1 has a length and a size.
fn check(text: &str, expected: &Expect) {
    let mut origin = Position::ZERO;
    origin.set(gcheck_engine::Axis::X, 100.0);
    let offsets = [(1, WorkOffset { origin, rotation: 0.0 })].into();
    let machine = Machine { fresh: false, offsets, ..machine(10.0) };
    let text = format!("O1\nG21 G90 G54 G0 X0. Y0.\nZ5.\nF200.\n{text}\nM30\n");
    expected.assert_eq(&shown_on("haas-mill", "XYZ", &machine, &text));
}

#[test]
fn a_touch_is_somewhere_on_the_way() {
    check(
        "G31 Y-10. F50.\n#100 = #5062\nX#5061\nY#100",
        &expect![[r#"
        rapid x0 y0 z0
        rapid x0 y0 z5
        probe x0 y-10 z5
        rapid x0 y? z5
        rapid x0 y? z5
        at x0 y? z5"#]],
    );
}

#[test]
fn a_move_that_must_not_touch_comes_to_its_end() {
    check(
        "G31 Y-10. F50. M78\nX1.",
        &expect![[r#"
        rapid x0 y0 z0
        rapid x0 y0 z5
        probe x0 y-10 z5
        rapid x1 y-10 z5
        at x1 y-10 z5"#]],
    );
    check(
        "G31 Y-10. F50. M79\nX1.",
        &expect![[r#"
        rapid x0 y0 z0
        rapid x0 y0 z5
        probe x0 y-10 z5
        rapid x1 y? z5
        at x1 y? z5"#]],
    );
}

#[test]
fn increments_behind_a_touch_leave_its_axis_unknown() {
    check(
        "G91 G31 Y-10. F50.\nG0 Y2.\nX2.\nG90 Y0.",
        &expect![[r#"
        rapid x0 y0 z0
        rapid x0 y0 z5
        probe x0 y-10 z5
        rapid x0 y? z5
        rapid x2 y? z5
        rapid x2 y0 z5
        at x2 y0 z5"#]],
    );
}

#[test]
fn a_measured_offset_is_set_but_unknown_on_its_axes() {
    check(
        "G91 G31 X-10. F50. M75\nG136 X5. F50.\nG90 G0 X0.\nG0 X#5221\nY#5222",
        &expect![[r#"
        rapid x0 y0 z0
        rapid x0 y0 z5
        probe x-10 y0 z5
        probe x? y0 z5
        rapid x0 y0 z5
        rapid x? y0 z5
        rapid x? y0 z5
        at x? y0 z5"#]],
    );
    check(
        "G91 G36 Y5. F50.\nG90 G0 X#5221\nY#5222",
        &expect![[r#"
        rapid x0 y0 z0
        rapid x0 y0 z5
        probe x0 y5 z5
        rapid x100 y? z5
        rapid x100 y? z5
        at x100 y? z5"#]],
    );
}

#[test]
fn a_shift_beside_the_measured_axis_may_count() {
    check(
        "G91 G36 Y5. I2. F50.\nG90 G0 X0.\nX#5221",
        &expect![[r#"
        rapid x0 y0 z0
        rapid x0 y0 z5
        probe x0 y5 z5
        rapid x0 y? z5
        rapid x? y? z5
        at x? y? z5"#]],
    );
    check(
        "G91 G36 Y5. I0. F50.\nG90 G0 X#5221",
        &expect![[r#"
        rapid x0 y0 z0
        rapid x0 y0 z5
        probe x0 y5 z5
        rapid x100 y? z5
        at x100 y? z5"#]],
    );
}

#[test]
fn an_offset_that_is_measured_and_not_told_apart_is_any() {
    check(
        "G154 P#100\nG91 G36 Y5. F50.\nG90 G54 G0 X#5221",
        &expect![[r#"
        rapid x0 y0 z0
        rapid x0 y0 z5
        probe x? y? z?
        rapid x? y? z?
        at x? y? z?"#]],
    );
}

#[test]
fn a_measured_length_is_that_of_its_number() {
    check(
        "G43 H1 Z5.\nG37 H1 Z0. F50.\nG0 Z5.\nX#2001",
        &expect![[r#"
        rapid x0 y0 z0
        rapid x0 y0 z5
        rapid x0 y0 z5
        probe x0 y0 z?
        rapid x0 y0 z5
        rapid x? y0 z5
        at x? y0 z?"#]],
    );
    check(
        "G43 H1 Z5.\nG37 H2 Z0. F50.\nG0 Z5.\nX#2001",
        &expect![[r#"
        rapid x0 y0 z0
        rapid x0 y0 z5
        rapid x0 y0 z5
        probe x0 y0 z?
        rapid x0 y0 z5
        rapid x0 y0 z5
        at x0 y0 z5"#]],
    );
    check(
        "G43 H1 Z5.\nG37 H#100 Z0. F50.\nG0 Z5.\nX#2001",
        &expect![[r#"
        rapid x0 y0 z0
        rapid x0 y0 z5
        rapid x0 y0 z5
        probe x0 y0 z?
        rapid x0 y0 z5
        rapid x? y0 z5
        at x? y0 z?"#]],
    );
}

#[test]
fn a_length_is_measured_by_a_move_without_an_end() {
    check(
        "G43 H1 Z0.\nG37 H1 Z0. F50.\nG91 G0 Z5.",
        &expect![[r#"
        rapid x0 y0 z0
        rapid x0 y0 z5
        rapid x0 y0 z0
        probe x0 y0 z?
        rapid x0 y0 z?
        at x0 y0 z?"#]],
    );
}

/// On a control whose codes for macros have millimetres and distances as words, from Z10 mm.
fn check_for_macros(text: &str, expected: &Expect) {
    let machine = Machine { fresh: false, ..machine(10.0) };
    expected.assert_eq(&shown_on(
        "fluidnc",
        "XYZ",
        &machine,
        &format!("G21 G90 G54 G0 X0 Y0\nZ10\n{text}\nM30\n"),
    ));
}

#[test]
fn codes_for_macros_read_millimetres_and_distances_whatever_the_modes() {
    let to_5 = expect![[r#"
        rapid x0 y0 z0
        rapid x0 y0 z10
        probe x0 y0 z5
        at x? y? z?"#]];
    for text in ["G38.6 Z-5 F100", "G20\nG38.6 Z-5 F100", "G91 G38.8 Z-5 F100"] {
        check_for_macros(text, &to_5);
    }
}

#[test]
fn a_later_block_without_the_code_for_macros_reads_its_words_as_usual() {
    check_for_macros(
        "G38.6 Z-5 F100\nZ-2",
        &expect![[r#"
        rapid x0 y0 z0
        rapid x0 y0 z10
        probe x0 y0 z5
        probe x0 y0 z-2
        at x? y? z?"#]],
    );
    check_for_macros(
        "G38.2 Z-5 F100",
        &expect![[r#"
        rapid x0 y0 z0
        rapid x0 y0 z10
        probe x0 y0 z-5
        at x? y? z?"#]],
    );
}
