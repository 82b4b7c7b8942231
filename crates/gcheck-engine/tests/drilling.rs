//! Canned cycles of mills as programs give them: which words count, and how.

mod cycle_harness;

use cycle_harness::{machine, shown_on};
use expect_test::{Expect, expect};
use gcheck_engine::Machine;

/// Millimetres; the machine is at zero.
fn check(control: &str, text: &str, expected: &Expect) {
    let text = format!("O1\nG21 G90 G54 G0 X0. Y0. Z5.\nS3000 M3\nF200.\n{text}\nM30\n");
    expected.assert_eq(&shown_on(control, "XYZ", &machine(10.0), &text));
}

#[test]
fn the_word_that_repeats_a_cycle_is_a_count_and_no_length() {
    check(
        "fanuc-mill",
        "G91 G99 G81 X5. Z-6. R-4. K2",
        &expect![[r#"
        rapid x0 y0 z5
        rapid x5 y0 z5
        rapid x5 y0 z1
        feed x5 y0 z-5
        rapid x5 y0 z1
        rapid x10 y0 z1
        feed x10 y0 z-5
        rapid x10 y0 z1
        at x10 y0 z1"#]],
    );
    check(
        "fanuc-mill",
        "G91 G99 G81 X5. Z-6. R-4. K2.",
        &expect![[r#"
        rapid x0 y0 z5
        rapid x5 y0 z5
        rapid x5 y0 z1
        feed x5 y0 z-5
        rapid x5 y0 z1
        rapid x10 y0 z1
        feed x10 y0 z-5
        rapid x10 y0 z1
        at x10 y0 z1"#]],
    );
}

#[test]
fn a_word_whose_value_is_not_known_was_given_all_the_same() {
    // Nobody told what #500 holds.
    let machine = Machine { fresh: false, ..machine(10.0) };
    let text = "O1\nG21 G90 G54 G0 X0. Y0. Z5.\nG99 G81 X5. Z-6. R#500 F200.\nX6.\nG80 X7.\nM30\n";
    expect![[r#"
        rapid x0 y0 z5
        rapid x7 y0 z?
        at x7 y0 z?"#]]
    .assert_eq(&shown_on("fanuc-mill", "XYZ", &machine, text));
}

#[test]
fn numbers_without_a_point_count_in_the_units_of_their_own_block() {
    check(
        "haas-mill",
        "G20\nG21 G0 X1500",
        &expect![[r#"
        rapid x0 y0 z5
        rapid x1.5 y0 z5
        at x1.5 y0 z5"#]],
    );
    check(
        "fanuc-mill",
        "G20 X15000",
        &expect![[r#"
        rapid x0 y0 z5
        rapid x38.1 y0 z5
        at x38.1 y0 z5"#]],
    );
}

#[test]
fn a_hole_is_gone_to_on_the_level_of_the_tool_when_that_is_above_r() {
    check(
        "linuxcnc",
        "G99 G81 X7 Z-4 R0\nG98 X8 R-1\nG99 X9\nG98 X10",
        &expect![[r#"
        rapid x0 y0 z5
        rapid x7 y0 z5
        rapid x7 y0 z0
        feed x7 y0 z-4
        rapid x7 y0 z0
        rapid x8 y0 z0
        rapid x8 y0 z-1
        feed x8 y0 z-4
        rapid x8 y0 z5
        rapid x9 y0 z5
        rapid x9 y0 z-1
        feed x9 y0 z-4
        rapid x9 y0 z-1
        rapid x10 y0 z5
        rapid x10 y0 z-1
        feed x10 y0 z-4
        rapid x10 y0 z5
        at x10 y0 z5"#]],
    );
    check(
        "linuxcnc",
        "G91 G99 G83 X7 Z-4 R-3 Q5\nG98 X8 R-4",
        &expect![[r#"
        rapid x0 y0 z5
        rapid x7 y0 z5
        rapid x7 y0 z2
        feed x7 y0 z-2
        rapid x7 y0 z2
        rapid x15 y0 z2
        rapid x15 y0 z1
        feed x15 y0 z-3
        rapid x15 y0 z5
        at x15 y0 z5"#]],
    );
    check(
        "linuxcnc",
        "G99 G89 X7 Z-4 R0 P1\nG98 X8 R-1",
        &expect![[r#"
        rapid x0 y0 z5
        rapid x7 y0 z5
        rapid x7 y0 z0
        feed x7 y0 z-4
        dwell 1
        feed x7 y0 z0
        rapid x8 y0 z0
        rapid x8 y0 z-1
        feed x8 y0 z-4
        dwell 1
        feed x8 y0 z5
        at x8 y0 z5"#]],
    );
}
