//! Chamfers and roundings between straight cuts: where the pieces begin and end, from where the next block counts, and what does
//! not fit. Figures are computed by hand: a rounding of radius r takes r·tan(α/2) of each cut, α the turn of the path.

mod cycle_harness;

use cycle_harness::{machine, shown_on};
use expect_test::{Expect, expect};

/// Millimetres; the machine is at zero.
fn check(control: &str, text: &str, expected: &Expect) {
    let text = format!("O1\nG21 G90 G54 F100.\n{text}\nM30\n");
    expected.assert_eq(&shown_on(control, "XYZ", &machine(10.0), &text));
}

/// On a lathe, X as a radius.
fn check_lathe(control: &str, text: &str, expected: &Expect) {
    let text = format!("O1\nG21 G99 F.2\nG0 X0. Z0.\n{text}\nM30\n");
    expected.assert_eq(&shown_on(control, "XZ", &machine(10.0), &text));
}

#[test]
fn a_chamfer_begins_and_ends_its_size_from_the_corner() {
    for control in ["haas-mill", "fanuc-mill"] {
        check(
            control,
            "G1 X10. ,C2.\nY10.",
            &expect![[r#"
                feed x8 y0 z0
                feed x10 y2 z0
                feed x10 y10 z0
                at x10 y10 z0"#]],
        );
    }
}

#[test]
fn a_rounding_is_tangent_to_both_cuts() {
    check(
        "haas-mill",
        "G1 X10. ,R2.\nY10. ,R3.\nX0.",
        &expect![[r#"
            feed x8 y0 z0
            ccw x10 y2 z0 about 8 2
            feed x10 y7 z0
            ccw x7 y10 z0 about 7 7
            feed x0 y10 z0
            at x0 y10 z0"#]],
    );
}

#[test]
fn increments_count_from_the_corner_itself() {
    check(
        "haas-mill",
        "G91 G1 X10. ,R2.\nY10. ,C1.\nX-10.",
        &expect![[r#"
            feed x8 y0 z0
            ccw x10 y2 z0 about 8 2
            feed x10 y9 z0
            feed x9 y10 z0
            feed x0 y10 z0
            at x0 y10 z0"#]],
    );
}

#[test]
fn pauses_switches_and_modes_may_be_between_the_cuts() {
    check(
        "haas-mill",
        "G1 X10. ,C2.\nG4 P1.\nM8\nG91 Y10.",
        &expect![[r#"
            feed x8 y0 z0
            feed x10 y2 z0
            dwell 1
            feed x10 y10 z0
            at x10 y10 z0"#]],
    );
}

#[test]
fn a_corner_may_take_all_of_a_cut() {
    check(
        "haas-mill",
        "G1 X2. ,R2.\nY4. ,R2.\nX-5.",
        &expect![[r#"
            ccw x2 y2 z0 about 0 2
            ccw x0 y4 z0 about 0 2
            feed x-5 y4 z0
            at x-5 y4 z0"#]],
    );
}

#[test]
fn what_does_not_fit_is_refused_and_the_corner_stays_sharp() {
    check(
        "haas-mill",
        "N5 G1 X1. ,R3.\nY1.",
        &expect![[r#"
        Corner(TooLong { needed: 2.9999999999999996, available: 1.0 }) in N5
        at x0 y0 z0"#]],
    );
    check(
        "haas-mill",
        "N5 G1 X10. ,C1.\nX3.",
        &expect![[r#"
        Corner(TooLong { needed: inf, available: 7.0 }) in N5
        at x0 y0 z0"#]],
    );
    check(
        "haas-mill",
        "N5 G1 X10. ,C1.\nG0 Y3.",
        &expect![[r#"
        Corner(RapidAfter) in N5
        at x0 y0 z0"#]],
    );
    for home in ["G91 G28 Z0", "G53 G0 Z0.", "G0 G53 Z0.", "G0 G43 H1 Z5."] {
        check(
            "haas-mill",
            &format!("N5 G1 X10. ,C1.\n{home}"),
            &expect![[r#"
            Corner(RapidAfter) in N5
            at x0 y0 z0"#]],
        );
    }
    check(
        "haas-mill",
        "N5 G1 X10. ,C1.\nZ3.\nY3.",
        &expect![[r#"
        Corner(NoCutAfter) in N5
        at x0 y0 z0"#]],
    );
    check(
        "haas-mill",
        "G1 X3.\nN5 X10. ,R1.",
        &expect![[r#"
        feed x3 y0 z0
        Corner(NoCutAfter) in N5
        at x3 y0 z0"#]],
    );
}

#[test]
fn cuts_in_one_direction_have_no_corner() {
    check(
        "fanuc-mill",
        "G1 X5. ,R1.\nX10.",
        &expect![[r#"
            feed x5 y0 z0
            feed x10 y0 z0
            at x10 y0 z0"#]],
    );
    check(
        "haas-mill",
        "N5 G1 X5. ,R1.\nX10.",
        &expect![[r#"
            Corner(NoTurn) in N5
            at x0 y0 z0"#]],
    );
}

#[test]
fn the_corner_lies_in_the_plane_in_effect() {
    check(
        "haas-mill",
        "G18 G1 X10. ,R2.\nZ-10.",
        &expect![[r#"
        feed x8 y0 z0
        ccw x10 y0 z-2 about -2 8
        feed x10 y0 z-10
        at x10 y0 z-10"#]],
    );
}

#[test]
fn compensation_runs_beside_the_pieces() {
    check(
        "haas-mill",
        "G41 D1 G1 X0. Y10.\nY30. ,R10.\nX30.\nG40 X40.",
        &expect![[r#"
        feed x-5 y10 z0
        feed x-5 y20 z0
        cw x10 y35 z0 about 10 20
        feed x30 y35 z0
        feed x40 y30 z0
        at x40 y30 z0"#]],
    );
}

#[test]
fn two_corners_share_the_cut_between_them_beside_a_cutter_too() {
    // Of 10 mm the first corner takes 6, and the second wants 6 more.
    let overlapping = "G1 X0. Y10.\nY30. ,R6.\nN5 X10. ,R6.\nY50.";
    check(
        "haas-mill",
        overlapping,
        &expect![[r#"
        feed x0 y10 z0
        feed x0 y24 z0
        cw x6 y30 z0 about 6 24
        Corner(TooLong { needed: 5.999999999999999, available: 4.000000000000001 }) in N5
        at x0 y30 z0"#]],
    );
    check(
        "haas-mill",
        &format!("G41 D1 {overlapping}"),
        &expect![[r#"
        feed x-5 y10 z0
        feed x-5 y24 z0
        Corner(TooLong { needed: 5.999999999999999, available: 4.000000000000001 }) in N5
        at x0 y30 z0"#]],
    );
}

#[test]
fn what_the_next_cut_does_wrong_is_its_own_mistake() {
    check(
        "haas-mill",
        "G1 X10. ,R2.\nN6 Y[10./0].",
        &expect![[r#"
        feed x10 y0 z0
        Malformed in N6
        at x10 y0 z0"#]],
    );
    check(
        "haas-mill",
        "G1 X10. ,R2.\n#700= 1000.\nN6 G#700 Y10.",
        &expect![[r#"
        feed x10 y0 z0
        ReadOnlyVariable(700)
        at x10 y0 z0"#]],
    );
}

#[test]
fn lathes_give_corners_and_angles_in_older_words_too() {
    check_lathe(
        "haas-lathe",
        "G1 X20. R2.\nZ-20. K1.\nX40.",
        &expect![[r#"
        rapid x0 z0
        feed x8 z0
        ccw x10 z-2 about -2 8
        feed x10 z-19
        feed x11 z-20
        feed x20 z-20
        at x20 z-20"#]],
    );
    check_lathe(
        "fanuc-lathe",
        "G1 X20. ,C2.\nZ-20. ,R1.\nX40.",
        &expect![[r#"
        rapid x0 z0
        feed x8 z0
        feed x10 z-2
        feed x10 z-19
        cw x11 z-20 about -19 11
        feed x20 z-20
        at x20 z-20"#]],
    );
    check_lathe(
        "fanuc-lathe",
        "G1 X20.\nX40. ,A135.\nZ-30.",
        &expect![[r#"
        rapid x0 z0
        feed x10 z0
        feed x20 z-10
        feed x20 z-30
        at x20 z-30"#]],
    );
}

#[test]
fn an_arc_after_the_corner_is_not_followed() {
    check(
        "fanuc-mill",
        "G1 X10. ,R2.\nG2 X20. Y10. R10.",
        &expect![[r#"
        feed x10 y0 z0
        cw x20 y10 z0 about 20 0
        at x20 y10 z0"#]],
    );
}
