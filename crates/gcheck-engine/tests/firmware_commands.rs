//! Lines that are commands to the firmware: what they do to the axes, and what is refused as words of the control.

mod cycle_harness;

use cycle_harness::{machine, shown_on};

fn shown(text: &str) -> String {
    shown_on("grbl", "XYZ", &machine(0.0), &format!("{text}\nM30\n")).replace('\n', " | ")
}

#[test]
fn after_homing_and_jogging_nobody_knows_where_the_axes_are() {
    assert_eq!(shown("G0 X1 Y2\n$H\nG0 X5"), "rapid x1 y2 z0 | rapid x5 y? z? | at x5 y? z?");
    assert_eq!(shown("G0 X1 Y2\n$J=G91 X1 F100\nG0 X5"), "rapid x1 y2 z0 | rapid x5 y? z? | at x5 y? z?");
}

#[test]
fn settings_and_questions_move_nothing() {
    for line in ["$$", "$G", "$X", "$110=500", "$N0=G21 G90", "$SLP"] {
        assert_eq!(
            shown(&format!("G0 X1 Y2\n{line}\nG0 X5")),
            "rapid x1 y2 z0 | rapid x5 y2 z0 | at x5 y2 z0"
        );
    }
}

#[test]
fn the_block_delete_sign_is_passed_over() {
    assert_eq!(shown("/G0 X1\nG0 Y1"), "rapid x1 y0 z0 | rapid x1 y1 z0 | at x1 y1 z0");
}

#[test]
fn a_full_circle_needs_its_end_point() {
    assert_eq!(shown("G2 X0 Y0 I1 F100"), "cw x0 y0 z0 about 1 0 | at x0 y0 z0");
    assert!(shown("G2 I1 F100").starts_with(|c: char| c.is_ascii_uppercase()), "{}", shown("G2 I1 F100"));
}

#[test]
fn an_arc_may_end_off_its_circle_by_five_thousandths_or_a_thousandth_of_its_radius() {
    let end = |off: &str, radius: u32| shown(&format!("G2 X{off} Y0 I{radius} F1000"));
    let refused = |text: &str| text.contains("Radi") || text.starts_with(|c: char| c.is_ascii_uppercase());
    assert!(!refused(&end("20.004", 10)), "{}", end("20.004", 10));
    assert!(refused(&end("20.02", 10)), "{}", end("20.02", 10));
    assert!(!refused(&end("400.15", 200)), "{}", end("400.15", 200));
    assert!(refused(&end("400.25", 200)), "{}", end("400.25", 200));
}
