//! Calls as programs make them: subprograms, macros, modal macros.

mod cycle_harness;

use cycle_harness::{machine, shown_on};
use expect_test::{Expect, expect};

/// Millimetres; the machine is at zero.
fn check(control: &str, text: &str, expected: &Expect) {
    let text = format!("O1\nG21 G90 G54\n{text}\n");
    expected.assert_eq(&shown_on(control, "XYZ", &machine(10.0), &text));
}

#[test]
fn a_modal_macro_runs_behind_every_move_but_its_own() {
    check(
        "fanuc-mill",
        "G0 Z9.\nG66 P2 A1.\nX5.\nX10.\nG67\nX15.\nM30\nO2\nG91 G0 Z-#1\nZ#1\nG90\nM99",
        &expect![[r#"
            rapid x0 y0 z9
            rapid x5 y0 z9
            rapid x5 y0 z8
            rapid x5 y0 z9
            rapid x10 y0 z9
            rapid x10 y0 z8
            rapid x10 y0 z9
            rapid x15 y0 z9
            at x15 y0 z9"#]],
    );
}

#[test]
fn what_a_modal_macro_calls_does_not_call_it_again() {
    check(
        "fanuc-mill",
        "G66 P2\nG0 X5.\nG67\nM30\nO2\nM98 P3\nG65 P4\nM99\nO3\nG0 Z1.\nM99\nO4\nG0 Z2.\nM99",
        &expect![[r#"
            rapid x5 y0 z0
            rapid x5 y0 z1
            rapid x5 y0 z2
            at x5 y0 z2"#]],
    );
}

#[test]
fn a_macro_called_in_the_usual_way_is_followed_by_the_modal_one() {
    check(
        "fanuc-mill",
        "G66 P2\nG65 P3\nG67\nM30\nO2\nG0 Z1.\nM99\nO3\nG0 X4.\nM99",
        &expect![[r#"
        rapid x4 y0 z0
        rapid x4 y0 z1
        at x4 y0 z1"#]],
    );
}
