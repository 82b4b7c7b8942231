//! Turning cycles: which words they take on each control's form, and where the tool goes.

mod cycle_harness;

use cycle_harness::{machine, shown_on};
use expect_test::{Expect, expect};

/// A two-block control with least increments, metric.
fn two_blocks(text: &str, expected: &Expect) {
    let text = format!("O1\nG21 G97 S800 M3\nT0101\nG0 X60. Z5.\nF0.2\n{text}\nM30\n");
    expected.assert_eq(&shown_on("fanuc-lathe", "XZ", &machine(0.0), &text));
}

/// A one-block control, inches.
fn one_block(text: &str, expected: &Expect) {
    let text = format!("O1\nG20 G18 G97 S800 M3\nT101\nG0 X2.2 Z0.1\nF0.01\n{text}\nM30\n");
    expected.assert_eq(&shown_on("haas-lathe", "XZ", &machine(0.0), &text));
}

/// The control with an interpreter to compare with; expectations are its output.
fn oracle(text: &str, expected: &Expect) {
    let text = format!("n10 g21 g18\nn20 f200 s500 m3\nn30 g0 x20 z2\n{text}\nn99 m2\n");
    expected.assert_eq(&shown_on("linuxcnc", "XZ", &machine(0.0), &text));
}

#[test]
fn x_counts_radii_while_moves_of_x_and_y_turn_the_part() {
    // Half a circle of radius 1 inch: its centre is the axis of the spindle.
    one_block(
        "G98 G0 X4. Z.1\nG17\nG112\nG1 X1. Y0 F10.\nG2 X-1. Y0 I-1. J0\nG113\nG0 X4.",
        &expect![[r#"
            rapid x27.94 z2.54
            rapid x50.8 z2.54
            feed x25.4 z2.54
            cw x-25.4 z2.54 about 0 0
            rapid x50.8 z2.54
            at x50.8 z2.54"#]],
    );
}

// ---- one pass ----

#[test]
fn words_of_a_turning_pass_stay_until_the_tool_starts_elsewhere() {
    two_blocks(
        "G90 X50. Z-30. F0.3\nX46.\nU-20. R-2.\nG0 X62. Z5.\nG90 X40.",
        &expect![[r#"
            rapid x30 z5
            rapid x25 z5
            feed x25 z-30
            feed x30 z-30
            rapid x30 z5
            rapid x23 z5
            feed x23 z-30
            feed x30 z-30
            rapid x30 z5
            rapid x18 z5
            feed x20 z-30
            feed x30 z-30
            rapid x30 z5
            rapid x31 z5
            rapid x20 z5
            feed x20 z5
            feed x31 z5
            rapid x31 z5
            at x31 z5"#]],
    );
}

#[test]
fn facing_passes_go_along_x() {
    two_blocks(
        "G94 X20. Z2. F0.2\nZ0.\nW-7. K-1.",
        &expect![[r#"
        rapid x30 z5
        rapid x30 z2
        feed x10 z2
        feed x10 z5
        rapid x30 z5
        rapid x30 z0
        feed x10 z0
        feed x10 z5
        rapid x30 z5
        rapid x30 z-3
        feed x10 z-2
        feed x10 z5
        rapid x30 z5
        at x30 z5"#]],
    );
    one_block(
        "G94 X-0.03 Z0. F0.008",
        &expect![[r#"
        rapid x27.94 z2.54
        rapid x27.94 z0
        feed x-0.381 z0
        feed x-0.381 z2.54
        rapid x27.94 z2.54
        at x27.94 z2.54"#]],
    );
}

#[test]
fn a_threading_pass_takes_its_lead_from_the_block_or_the_one_before() {
    two_blocks(
        "G92 X38. Z-30. F1.5\nX37.5",
        &expect![[r#"
        rapid x30 z5
        rapid x19 z5
        sync 1.500000
        thread x19 z-30
        sync off
        rapid x30 z-30
        rapid x30 z5
        rapid x18.75 z5
        sync 1.500000
        thread x18.75 z-30
        sync off
        rapid x30 z-30
        rapid x30 z5
        at x30 z5"#]],
    );
    one_block(
        "G92 X0.95 Z-0.9 F0.0625",
        &expect![[r#"
        rapid x27.94 z2.54
        rapid x12.065 z2.54
        sync 1.587500
        thread x12.065 z-22.86
        sync off
        rapid x27.94 z-22.86
        rapid x27.94 z2.54
        at x27.94 z2.54"#]],
    );
}

#[test]
fn a_pass_without_feed_is_refused_after_the_move() {
    let text = "O1\nG21 G97 S800 M3\nG0 X60. Z5.\nN7 G90 X50. Z-30.\nM30\n";
    let shown = shown_on("fanuc-lathe", "XZ", &machine(0.0), text);
    expect![[r#"
        rapid x30 z5
        rapid x25 z5
        feed x25 z-30
        feed x30 z-30
        rapid x30 z5
        NoFeed in N7
        at x30 z5"#]]
    .assert_eq(&shown);
}

#[test]
fn a_pass_from_nowhere_ends_nowhere() {
    let text = "O1\nG21 G97 S800 M3\nG0 X#100 Z5.\nG90 X50. Z-30. F0.3\nM30\n";
    let mut unknown = machine(0.0);
    unknown.fresh = false;
    expect![[r#"
        rapid x? z5
        at x? z5"#]]
    .assert_eq(&shown_on("fanuc-lathe", "XZ", &unknown, text));
}

// ---- grooving ----

#[test]
fn pecks_and_steps_count_least_increments_in_two_blocks() {
    two_blocks(
        "G75 R0.5\nG75 X52. Z1. P3000 Q2500 F0.08",
        &expect![[r#"
        rapid x30 z5
        feed x27 z5
        rapid x27.5 z5
        feed x26 z5
        rapid x30 z5
        rapid x30 z2.5
        feed x27 z2.5
        rapid x27.5 z2.5
        feed x26 z2.5
        rapid x30 z2.5
        rapid x30 z1
        feed x27 z1
        rapid x27.5 z1
        feed x26 z1
        rapid x30 z1
        rapid x30 z5
        at x30 z5"#]],
    );
    two_blocks(
        "G0 X0.\nG74 R1.\nG74 Z-15. Q8000 F0.1",
        &expect![[r#"
        rapid x30 z5
        rapid x0 z5
        feed x0 z-3
        rapid x0 z-2
        feed x0 z-11
        rapid x0 z-10
        feed x0 z-15
        rapid x0 z5
        at x0 z5"#]],
    );
}

#[test]
fn pecks_and_steps_are_lengths_in_one_block() {
    one_block(
        "G0 X0.\nG74 Z-0.3 K0.15 F0.006",
        &expect![[r#"
        rapid x27.94 z2.54
        rapid x0 z2.54
        feed x0 z-1.27
        rapid x0 z1.27
        feed x0 z-5.08
        rapid x0 z-2.54
        feed x0 z-7.62
        rapid x0 z2.54
        at x0 z2.54"#]],
    );
    one_block(
        "G75 X2. Z0. I0.06 K0.08 F0.004",
        &expect![[r#"
        rapid x27.94 z2.54
        feed x26.416 z2.54
        rapid x27.94 z2.54
        feed x25.4 z2.54
        rapid x27.94 z2.54
        rapid x27.94 z0.508
        feed x26.416 z0.508
        rapid x27.94 z0.508
        feed x25.4 z0.508
        rapid x27.94 z0.508
        rapid x27.94 z0
        feed x26.416 z0
        rapid x27.94 z0
        feed x25.4 z0
        rapid x27.94 z0
        rapid x27.94 z2.54
        at x27.94 z2.54"#]],
    );
}

// ---- threading ----

#[test]
fn a_thread_in_two_blocks() {
    two_blocks(
        "G0 X34. Z5.\nG76 P020060 Q100 R0.05\nG76 X30. Z-30. P1000 Q600 F2.",
        &expect![[r#"
            rapid x30 z5
            rapid x17 z5
            rapid x17 z4.6536
            rapid x15.4 z4.6536
            sync 2.000000
            thread x15.4 z-30
            sync off
            rapid x17 z-30
            rapid x17 z4.6536
            rapid x17 z4.5101
            rapid x15.1515 z4.5101
            sync 2.000000
            thread x15.1515 z-30
            sync off
            rapid x17 z-30
            rapid x17 z4.5101
            rapid x17 z4.4515
            rapid x15.05 z4.4515
            sync 2.000000
            thread x15.05 z-30
            sync off
            rapid x17 z-30
            rapid x17 z4.4515
            rapid x17 z4.4226
            rapid x15 z4.4226
            sync 2.000000
            thread x15 z-30
            sync off
            rapid x17 z-30
            rapid x17 z4.4226
            rapid x15 z4.4226
            sync 2.000000
            thread x15 z-30
            sync off
            rapid x17 z-30
            rapid x17 z4.4226
            rapid x17 z5
            at x17 z5"#]],
    );
}

#[test]
fn a_thread_in_one_block() {
    one_block(
        "G0 X1.2 Z0.3\nG76 X0.88 Z-1.1 K0.06 D0.04 F0.1 A60.",
        &expect![[r#"
        rapid x27.94 z2.54
        rapid x15.24 z7.62
        rapid x15.24 z7.0334
        rapid x11.684 z7.0334
        sync 2.540000
        thread x11.684 z-27.94
        sync off
        rapid x15.24 z-27.94
        rapid x15.24 z7.0334
        rapid x15.24 z6.7904
        rapid x11.2632 z6.7904
        sync 2.540000
        thread x11.2632 z-27.94
        sync off
        rapid x15.24 z-27.94
        rapid x15.24 z6.7904
        rapid x15.24 z6.7401
        rapid x11.176 z6.7401
        sync 2.540000
        thread x11.176 z-27.94
        sync off
        rapid x15.24 z-27.94
        rapid x15.24 z6.7401
        rapid x15.24 z7.62
        at x15.24 z7.62"#]],
    );
}

#[test]
fn a_thread_needs_its_height() {
    one_block(
        "N5 G76 X0.88 Z-1.1 D0.012 F0.1",
        &expect![[r#"
        rapid x27.94 z2.54
        Cycle(Missing(K)) in N5
        at x27.94 z2.54"#]],
    );
    two_blocks(
        "N5 G76 X30. Z-30. Q600 F2.",
        &expect![[r#"
        rapid x30 z5
        Cycle(Missing(P)) in N5
        at x30 z5"#]],
    );
}

#[test]
fn a_thread_by_the_drive_line() {
    oracle(
        "n40 g76 p1.5 z-20 i-2 j0.3 k0.5",
        &expect![[r#"
            rapid x20 z2
            rapid x20.2 z2
            rapid x17.7 z2
            override off
            sync 1.500000
            feed x17.7 z-20
            sync off
            rapid x20.2 z-20
            override on
            rapid x20 z2
            rapid x17.5 z2
            override off
            sync 1.500000
            feed x17.5 z-20
            sync off
            rapid x20 z-20
            override on
            rapid x20 z-20
            at x20 z-20"#]],
    );
    oracle(
        "n40 g76 p1.5 z-20 x22 i-2 j0.3 k0.5 q30 e1 l3 h-1",
        &expect![[r#"
            rapid x20 z2
            rapid x20.2 z1.8268
            override off
            sync 1.677051
            feed x18.2 z1.8268
            feed x17.7 z0.8268
            sync 1.500000
            feed x17.7 z-18.8845
            sync 1.677051
            feed x18.2 z-19.8845
            sync off
            rapid x20.2 z-19.8845
            override on
            rapid x22 z-20
            at x22 z-20"#]],
    );
}

#[test]
fn in_diameter_mode_thread_depths_are_diameters() {
    oracle(
        "n40 g7\nn41 g0 x40\nn42 g76 p1.5 z-20 i-2 j0.3 k0.5",
        &expect![[r#"
        rapid x20 z2
        rapid x20 z2
        rapid x20.1 z2
        rapid x18.85 z2
        override off
        sync 1.500000
        feed x18.85 z-20
        sync off
        rapid x20.1 z-20
        override on
        rapid x20 z2
        rapid x18.75 z2
        override off
        sync 1.500000
        feed x18.75 z-20
        sync off
        rapid x20 z-20
        override on
        rapid x20 z-20
        at x20 z-20"#]],
    );
}

#[test]
fn threads_that_the_interpreter_refuses() {
    for block in [
        "z-20 i-2 j0.3 k0.5",
        "p1.5 i-2 j0.3 k0.5",
        "p1.5 z-20 j0.3 k0.5",
        "p1.5 z-20 i0 j0.3 k0.5",
        "p1.5 z-20 i-2 j0.3 k0.3",
        "p1.5 z-20 i-2 j0.3 k0.5 h1.5",
        "p1.5 z-20 i-2 j0.3 k0.5 a2",
        "p-1 z-20 i-2 j0.3 k0.5",
        "p1.5 z-20 i-2 j0.3 k0.5 l-1",
        "p1.5 z-20 i-2 j0.3 k0.5 m5",
    ] {
        let text = format!("n10 g21 g18\nn20 f200 s500 m3\nn30 g0 x20 z2\nn40 g76 {block}\nn50 m2\n");
        let shown = shown_on("linuxcnc", "XZ", &machine(0.0), &text);
        assert!(shown.contains(" in N40\n"), "{block}: {shown}");
    }
}

#[test]
fn a_thread_of_changing_lead_counts_by_the_mean_of_its_leads() {
    // 20 mm from 1.5 mm a turn, 0.05 mm more each turn: about 11 turns, the last of 2.06 mm.
    two_blocks(
        "G34 Z-15. F1.5 K0.05\nG34 Z-25. F1.5",
        &expect![[r#"
        rapid x30 z5
        sync 1.780776
        thread x30 z-15
        sync off
        sync 1.500000
        thread x30 z-25
        sync off
        at x30 z-25"#]],
    );
}

#[test]
fn an_end_point_alone_behind_an_arc_is_a_straight_line_where_a_setting_lets_it() {
    let text = "O1\nG21 G97 S800 M3\nT0101\nG0 X60. Z5.\nG1 X40. F.2\nG2 X50. Z0. R5.\nN5 X60.\nM30\n";
    expect![[r#"
        rapid x30 z5
        feed x20 z5
        cw x25 z0 about 5 25
        feed x30 z0
        at x30 z0"#]]
    .assert_eq(&shown_on("fanuc-lathe", "XZ", &machine(0.0), text));
    let mut alarms = machine(0.0);
    alarms.settings.insert("3403#5".to_owned(), "alarm".to_owned());
    expect![[r#"
        rapid x30 z5
        feed x20 z5
        cw x25 z0 about 5 25
        Arc(NoCentre) in N5
        at x30 z0"#]]
    .assert_eq(&shown_on("fanuc-lathe", "XZ", &alarms, text));
    two_blocks(
        "G71 U20. R1.\nG71 P100 Q130 F0.25\nN100 G0 X40.\nN110 G1 Z-10.\nN120 G2 X50. Z-15. R5.\nN130 X60.",
        &expect![[r#"
            rapid x30 z5
            rapid x20 z5
            feed x20 z-10
            cw x25 z-15 about -10 25
            feed x30 z-15
            rapid x30 z5
            at x30 z5"#]],
    );
}

// ---- profiles between sequence numbers ----

#[test]
fn roughing_in_two_blocks_goes_on_behind_the_profile() {
    two_blocks(
        "G71 U5. R1.\nG71 P100 Q130 U0.4 W0.1 F0.25\nN100 G0 X40.\nN110 G1 Z-10. F0.1\nN120 X50. Z-15.\nN130 X60.\nG0 X100.",
        &expect![[r#"
            rapid x30 z5
            rapid x25 z5
            feed x25 z-14.7
            rapid x26 z-13.7
            rapid x26 z5
            rapid x30 z5.1
            rapid x20.2 z5.1
            feed x20.2 z-9.9
            feed x25.2 z-14.9
            feed x30.2 z-14.9
            rapid x30 z-14.9
            rapid x30 z5
            rapid x50 z5
            at x50 z5"#]],
    );
}

#[test]
fn roughing_in_one_block_takes_the_depth_from_it() {
    one_block(
        "G71 P100 Q130 D0.2 U0.02 W0.005 F0.012\nN100 G0 X1.6\nN110 G1 Z-0.5 F0.005\nN130 X2.2",
        &expect![[r#"
            rapid x27.94 z2.54
            rapid x22.86 z2.54
            feed x22.86 z-12.573
            rapid x22.86 z2.54
            rapid x27.94 z2.667
            rapid x20.574 z2.667
            feed x20.574 z-12.573
            feed x28.194 z-12.573
            rapid x27.94 z-12.573
            rapid x27.94 z2.54
            at x27.94 z2.54"#]],
    );
}

#[test]
fn finishing_executes_the_profile_with_its_own_feeds_and_returns() {
    two_blocks(
        "GOTO 200\nN100 G0 X40.\nN110 G1 Z-10. F0.1\nN120 G2 X50. Z-15. R5.\nN130 G1 X60.\nN200 G70 P100 Q130\nG0 X100.",
        &expect![[r#"
            rapid x30 z5
            rapid x20 z5
            feed x20 z-10
            cw x25 z-15 about -10 25
            feed x30 z-15
            rapid x30 z5
            rapid x50 z5
            at x50 z5"#]],
    );
}

#[test]
fn faces_are_roughed_along_x() {
    two_blocks(
        "G72 W2. R0.5\nG72 P100 Q120 U0. W0. F0.25\nN100 G0 Z-1.\nN110 G1 X40.\nN120 Z5.",
        &expect![[r#"
            rapid x30 z5
            rapid x30 z3
            feed x20 z3
            rapid x20.5 z3.5
            rapid x30 z3.5
            rapid x30 z1
            feed x20 z1
            rapid x20.5 z1.5
            rapid x30 z1.5
            rapid x30 z5
            rapid x30 z-1
            feed x20 z-1
            feed x20 z5
            rapid x30 z5
            at x30 z5"#]],
    );
}

#[test]
fn a_pattern_comes_nearer_pass_by_pass() {
    two_blocks(
        "G73 U3. W2. R3\nG73 P100 Q120 U1. W0. F0.25\nN100 G0 X40. Z3.\nN110 G1 Z-10.\nN120 X60.",
        &expect![[r#"
            rapid x30 z5
            rapid x33.5 z7
            rapid x23.5 z5
            feed x23.5 z-8
            feed x33.5 z-8
            rapid x32 z6
            rapid x22 z4
            feed x22 z-9
            feed x32 z-9
            rapid x30.5 z5
            rapid x20.5 z3
            feed x20.5 z-10
            feed x30.5 z-10
            rapid x30 z5
            at x30 z5"#]],
    );
    one_block(
        "G73 P100 Q120 D2 I0.1 K0.05 F0.01\nN100 G0 X1.6 Z0.05\nN110 G1 Z-0.5\nN120 X2.2",
        &expect![[r#"
            rapid x27.94 z2.54
            rapid x30.48 z3.81
            rapid x22.86 z2.54
            feed x22.86 z-11.43
            feed x30.48 z-11.43
            rapid x27.94 z2.54
            rapid x20.32 z1.27
            feed x20.32 z-12.7
            feed x27.94 z-12.7
            rapid x27.94 z2.54
            at x27.94 z2.54"#]],
    );
}

#[test]
fn corners_of_a_profile_are_cut() {
    two_blocks(
        "G71 U20. R1.\nG71 P100 Q130 F0.25\nN100 G0 X40.\nN110 G1 Z-10.,R2.\nN120 X50.,C1.\nN130 Z-20.\nN140 X60.",
        &expect![[r#"
            rapid x30 z5
            rapid x20 z5
            feed x20 z-8
            cw x22 z-10 about -8 22
            feed x24 z-10
            feed x25 z-11
            feed x25 z-20
            rapid x30 z-20
            rapid x30 z5
            rapid x30 z5
            at x30 z5"#]],
    );
}

#[test]
fn a_profile_may_be_computed() {
    two_blocks(
        "#101=40.\nG71 U20. R1.\nG71 P100 Q130 F0.25\nN100 G0 X#101\n#102=-10.\nN110 G1 Z#102\nIF [#102 LT 0] GOTO 130\nN120 X50. Z-30.\nN130 X60.",
        &expect![[r#"
            rapid x30 z5
            rapid x20 z5
            feed x20 z-10
            feed x30 z-10
            rapid x30 z5
            at x30 z5"#]],
    );
}

#[test]
fn an_unknown_profile_leaves_the_tool_where_it_was() {
    let text = "O1\nG21 G97 S800 M3\nG0 X60. Z5.\nG71 U5. R1.\nG71 P1 Q2 F0.25\nN1 G0 X#500\nN2 G1 Z-10.\nG0 U2.\nM30\n";
    let mut unknown = machine(0.0);
    unknown.fresh = false;
    expect![[r#"
        rapid x30 z5
        rapid x31 z5
        at x31 z5"#]]
    .assert_eq(&shown_on("fanuc-lathe", "XZ", &unknown, text));
}

#[test]
fn profiles_that_are_not_there_are_refused() {
    two_blocks(
        "N5 G71 P100 Q130 F0.25\nN100 G0 X40.",
        &expect![[r#"
        rapid x30 z5
        NoSuchLabel(130) in N5
        at x30 z5"#]],
    );
    two_blocks(
        "N5 G71 P100 F0.25\nN100 G0 X40.",
        &expect![[r#"
        rapid x30 z5
        MissingWord(Q) in N5
        at x30 z5"#]],
    );
    two_blocks(
        "N130 G0 X40.\nN5 G71 P5 Q6\nN6 X3.",
        &expect![[r#"
        rapid x30 z5
        rapid x20 z5
        Profile in N5
        at x20 z5"#]],
    );
    two_blocks(
        "N1 G70 P10 Q20\nN10 G0 X40.\nN11 G70 P30 Q40\nN20 X50.\nN30 X2.\nN40 X3.",
        &expect![[r#"
        rapid x30 z5
        Profile in N1
        at x30 z5"#]],
    );
}

#[test]
fn a_rapid_away_behind_the_shape_is_not_cut() {
    two_blocks(
        "G71 U20. R1.\nG71 P100 Q130 F0.25\nN100 G0 X40.\nN110 G1 Z-10. F0.1\nN120 X60.\nN130 G0 Z1.\nG0 X100.",
        &expect![[r#"
            rapid x30 z5
            rapid x20 z5
            feed x20 z-10
            feed x30 z-10
            rapid x30 z5
            rapid x50 z5
            at x50 z5"#]],
    );
}

#[test]
fn a_profile_of_another_shape_leaves_the_tool_where_it_was() {
    // Back in Z in the middle; and a first block that begins beyond the cut.
    two_blocks(
        "G71 U5. R1.\nG71 P100 Q140 F0.25\nN100 G0 X40.\nN110 G1 Z-10. F0.1\nN120 X50. Z-5.\nN140 X60. Z-15.\nG0 X100.",
        &expect![[r#"
            rapid x30 z5
            rapid x50 z5
            at x50 z5"#]],
    );
    two_blocks(
        "G72 W2. R0.5\nG72 P100 Q120 F0.25\nN100 G0 X40.\nN110 G1 Z-10.\nN120 X60.\nG0 X100.",
        &expect![[r#"
            rapid x30 z5
            rapid x50 z5
            at x50 z5"#]],
    );
}

#[test]
fn an_arc_that_does_not_fit_is_a_fault_of_its_block() {
    two_blocks(
        "G71 U5. R1.\nG71 P100 Q140 F0.25\nN100 G0 X40.\nN110 G1 Z-10. F0.1\nN120 G2 X50. Z-15. R1.\nN140 G1 X60.",
        &expect![[r#"
            rapid x30 z5
            Arc(RadiusTooSmall { half_chord: 3.5355339059327378, radius: 1.0 }) in N120
            at x30 z5"#]],
    );
}

#[test]
fn words_without_a_point_count_least_increments_in_every_turning_cycle() {
    let profile = "\nN100 G0 X40.\nN110 G1 Z-10.\nN120 X60.";
    let of_two_blocks = [
        ("G71 U5. R1.\nG71 P100 Q120 U.4 W.1", "G71 U5000 R1000\nG71 P100 Q120 U400 W100"),
        ("G73 U3. W2. R3\nG73 P100 Q120 U1.", "G73 U3000 W2000 R3\nG73 P100 Q120 U1000"),
        ("G74 R1.\nG74 Z-15. Q8. F0.1", "G74 R1000\nG74 Z-15000 Q8000 F0.1"),
        ("G75 R.5\nG75 X52. Z1. P3. Q2.5 F0.1", "G75 R500\nG75 X52000 Z1000 P3000 Q2500 F0.1"),
        (
            "G76 P011060 Q.1 R.05\nG76 X50. Z-9. P1. Q.6 F2.",
            "G76 P011060 Q100 R50\nG76 X50000 Z-9000 P1000 Q600 F2.",
        ),
        ("G76 X50. Z-9. K1. D.4 A60. F2.", "G76 X50000 Z-9000 K1000 D400 A60 F2."),
    ];
    for (pointed, plain) in of_two_blocks {
        let shown = |cycle: &str| {
            let text = format!("O1\nG21 G97 S800 M3\nT0101\nG0 X60. Z5.\nF0.2\n{cycle}{profile}\nM30\n");
            shown_on("fanuc-lathe", "XZ", &machine(0.0), &text)
        };
        assert_eq!(shown(pointed), shown(plain), "{plain}");
    }
    let profile = "\nN100 G0 X1.6\nN110 G1 Z-.5\nN120 X2.2";
    let of_one_block = [
        ("G71 P100 Q120 D.2 U.02 W.005", "G71 P100 Q120 D2000 U200 W50"),
        ("G73 P100 Q120 D2 I.1 K.05", "G73 P100 Q120 D2 I1000 K500"),
        ("G74 Z-.3 K.15", "G74 Z-3000 K1500"),
        ("G75 X2. Z0. I.06 K.08", "G75 X20000 Z0 I600 K800"),
        ("G76 X.88 Z-1.1 K.06 D.04 F.1", "G76 X8800 Z-11000 K600 D400 F.1"),
    ];
    for (pointed, plain) in of_one_block {
        let shown = |cycle: &str| {
            let text = format!("O1\nG20 G18 G97 S800 M3\nT101\nG0 X2.2 Z.1\nF.01\n{cycle}{profile}\nM30\n");
            shown_on("haas-lathe", "XZ", &machine(0.0), &text)
        };
        assert_eq!(shown(pointed), shown(plain), "{plain}");
    }
}

#[test]
fn a_control_that_threads_in_two_blocks_takes_the_older_block_too() {
    two_blocks(
        "G0 X34. Z5.\nG76 X30. Z-30. K1. D.6 F2. A60.",
        &expect![[r#"
        rapid x30 z5
        rapid x17 z5
        rapid x17 z4.6536
        rapid x15.4 z4.6536
        sync 2.000000
        thread x15.4 z-30
        sync off
        rapid x17 z-30
        rapid x17 z4.6536
        rapid x17 z4.5101
        rapid x15.1515 z4.5101
        sync 2.000000
        thread x15.1515 z-30
        sync off
        rapid x17 z-30
        rapid x17 z4.5101
        rapid x17 z4.4226
        rapid x15 z4.4226
        sync 2.000000
        thread x15 z-30
        sync off
        rapid x17 z-30
        rapid x17 z4.4226
        rapid x17 z5
        at x17 z5"#]],
    );
}

// ---- profiles in subprograms ----

const SUB: &str = "o100 sub\nn901 g0 x10 z1\nn902 g1 z-10\nn903 x15 z-15\nn904 x18\no100 endsub\n";

#[test]
fn a_profile_in_a_subprogram_is_roughed_layer_by_layer() {
    oracle(
        &format!("{SUB}n40 g71 q100 i6 d0.5 r1\nn50 x30"),
        &expect![[r#"
        rapid x20 z2
        rapid x20 z2
        rapid x20 z2
        rapid x20 z2
        feed x20 z-14.5
        rapid x21 z-13.5
        rapid x21 z1
        rapid x20 z2
        rapid x14 z1.3684
        feed x14 z-13.2929
        rapid x15 z-12.2929
        rapid x15 z0.3684
        rapid x14 z1.3684
        rapid x10.5 z1
        feed x10.5 z-9.7929
        feed x15.2071 z-14.5
        feed x18 z-14.5
        feed x20 z-14.5
        feed x30 z-14.5
        at x30 z-14.5"#]],
    );
}

#[test]
fn a_profile_in_a_subprogram_is_finished_in_passes() {
    oracle(
        &format!("{SUB}n40 g70 q100 d1 e0.5 p2\nn50 z-30"),
        &expect![[r#"
        rapid x20 z2
        rapid x20 z2
        rapid x20 z2
        rapid x10.75 z1
        feed x10.75 z-9.6893
        feed x15.3107 z-14.25
        feed x18 z-14.25
        rapid x20 z2
        rapid x10.5 z1
        feed x10.5 z-9.7929
        feed x15.2071 z-14.5
        feed x18 z-14.5
        feed x18 z-30
        at x18 z-30"#]],
    );
    oracle(
        &format!("{SUB}n40 g70 q100 p0\nn50 z-30"),
        &expect![[r#"
        rapid x20 z2
        rapid x20 z2
        feed x18 z-30
        at x18 z-30"#]],
    );
}

#[test]
fn a_subprogram_may_decide_its_profile() {
    oracle(
        "o100 sub\n#1=0\ng0 x10 z1\no1 while [#1 lt 2]\ng1 z[-10-#1*4] x[10+#1]\n#1=[#1+1]\no1 endwhile\ng1 x18\no100 endsub\nn40 g71 q100 i20\nn50 x30",
        &expect![[r#"
            rapid x20 z2
            rapid x20 z2
            rapid x20 z2
            rapid x20 z2
            feed x20 z-14
            rapid x20.5 z-13.5
            rapid x20.5 z1.5
            rapid x20 z2
            rapid x10 z1
            feed x10 z-10
            feed x11 z-14
            feed x18 z-14
            feed x20 z-14
            feed x30 z-14
            at x30 z-14"#]],
    );
}

#[test]
fn subprogram_profiles_that_the_interpreter_refuses() {
    for block in ["g71 i3", "g71 q101", "g71 q100 i0", "g17 g71 q100"] {
        let text = format!("{SUB}n10 g21 g18\nn20 f200 s500 m3\nn30 g0 x20 z2\nn40 {block}\nn50 m2\n");
        let shown = shown_on("linuxcnc", "XZ", &machine(0.0), &text);
        assert!(shown.contains(" in N40\n"), "{block}: {shown}");
    }
}

// ---- holes of live tools ----

/// Metric, the tool at X60 Z5 with the work at C0.
fn live(control: &str, text: &str, expected: &Expect) {
    let modes = if control == "haas-lathe" { "G21 G98" } else { "G21 G98 G97" };
    let text = format!("O1\n{modes} S800\nT0101\nG0 X60. Z5. C0.\nF100.\n{text}\nM30\n");
    expected.assert_eq(&shown_on(control, "XZC", &machine(0.0), &text));
}

#[test]
fn a_hole_across_the_axis_ends_at_the_level_it_began_at_over_its_z() {
    live(
        "haas-lathe",
        "G0 Z-10.\nG241 X40. R55. F100.\nZ-20.\nC90.\nG80\nG0 Z5.",
        &expect![[r#"
            rapid x30 z5 c0
            rapid x30 z-10 c0
            rapid x27.5 z-10 c0
            feed x20 z-10 c0
            rapid x30 z-10 c0
            rapid x30 z-20 c0
            rapid x27.5 z-20 c0
            feed x20 z-20 c0
            rapid x30 z-20 c0
            rapid x30 z-20 c90
            rapid x27.5 z-20 c90
            feed x20 z-20 c90
            rapid x30 z-20 c90
            rapid x30 z5 c90
            at x30 z5 c90"#]],
    );
}

#[test]
fn cycles_across_the_axis_peck_tap_and_bore() {
    live(
        "haas-lathe",
        "G0 Z-10.\nG243 X40. R56. Q5. F100.\nG80\nG242 X50. Z-20. P500\nG80\nG195 U-20.\nG249 X48. R58.",
        &expect![[r#"
            rapid x30 z5 c0
            rapid x30 z-10 c0
            rapid x28 z-10 c0
            feed x23 z-10 c0
            rapid x28 z-10 c0
            rapid x25.54 z-10 c0
            feed x20 z-10 c0
            rapid x30 z-10 c0
            rapid x30 z-20 c0
            feed x25 z-20 c0
            dwell 0.5
            rapid x30 z-20 c0
            override off
            feed x20 z-20 c0
            feed x30 z-20 c0
            override on
            rapid x29 z-20 c0
            feed x24 z-20 c0
            feed x29 z-20 c0
            rapid x30 z-20 c0
            at x30 z-20 c0"#]],
    );
}

#[test]
fn cycles_of_the_side_count_r_from_the_start() {
    live(
        "fanuc-lathe",
        "G0 Z-10.\nG87 X40. R-3. Q5000\nZ-20.\nG88 X40. R0\nG89 Z-5. P200\nG83 X20. Z-15. R-2.\nG80",
        &expect![[r#"
            rapid x30 z5 c0
            rapid x30 z-10 c0
            rapid x27 z-10 c0
            feed x22 z-10 c0
            rapid x27 z-10 c0
            rapid x23 z-10 c0
            feed x20 z-10 c0
            rapid x30 z-10 c0
            rapid x30 z-20 c0
            rapid x27 z-20 c0
            feed x22 z-20 c0
            rapid x27 z-20 c0
            rapid x23 z-20 c0
            feed x20 z-20 c0
            rapid x30 z-20 c0
            override off
            feed x20 z-20 c0
            feed x30 z-20 c0
            override on
            rapid x30 z-5 c0
            feed x20 z-5 c0
            dwell 0.2
            feed x30 z-5 c0
            rapid x10 z-5 c0
            rapid x10 z-7 c0
            feed x10 z-15 c0
            rapid x10 z-5 c0
            at x10 z-5 c0"#]],
    );
}

#[test]
fn in_diameter_mode_the_depth_along_x_is_a_diameter_and_r_a_radius() {
    oracle(
        "n40 g7 g19 x40\nn50 g81 x10 r30 y1 z1\nn60 g80",
        &expect![[r#"
        rapid x20 z2
        rapid x20 z2
        rapid x30 z2
        rapid x30 z1
        feed x5 z1
        rapid x30 z1
        at x30 z1"#]],
    );
}

#[test]
fn holes_in_the_face_may_leave_r_out() {
    live(
        "fanuc-lathe",
        "G83 X0.0 Z-1.23 Q2000 F.006\nG80",
        &expect![[r#"
        rapid x30 z5 c0
        rapid x0 z5 c0
        feed x0 z3 c0
        rapid x0 z5 c0
        rapid x0 z4 c0
        feed x0 z1 c0
        rapid x0 z5 c0
        rapid x0 z2 c0
        feed x0 z-1 c0
        rapid x0 z5 c0
        rapid x0 z0 c0
        feed x0 z-1.23 c0
        rapid x0 z5 c0
        at x0 z5 c0"#]],
    );
    live(
        "haas-lathe",
        "G81 X0. Z-5. F100.\nG80",
        &expect![[r#"
        rapid x30 z5 c0
        rapid x0 z5 c0
        feed x0 z-5 c0
        rapid x0 z5 c0
        at x0 z5 c0"#]],
    );
}

#[test]
fn repeats_turn_the_work_on() {
    live(
        "fanuc-lathe",
        "G83 X40. Z-5. R-3. H90. K3.\nW-12.\nG80",
        &expect![[r#"
            rapid x30 z5 c0
            rapid x20 z5 c90
            rapid x20 z2 c90
            feed x20 z-5 c90
            rapid x20 z5 c90
            rapid x20 z5 c180
            rapid x20 z2 c180
            feed x20 z-5 c180
            rapid x20 z5 c180
            rapid x20 z5 c270
            rapid x20 z2 c270
            feed x20 z-5 c270
            rapid x20 z5 c270
            rapid x20 z2 c270
            feed x20 z-10 c270
            rapid x20 z5 c270
            at x20 z5 c270"#]],
    );
}

#[test]
fn increments_change_the_coordinates_of_the_present_position() {
    two_blocks(
        "G50 U-10. W-5.\nG0 U2. W1.",
        &expect![[r#"
            rapid x30 z5
            rapid x26 z1
            at x26 z1"#]],
    );
    one_block(
        "G50 W-.2\nG0 X2. Z.1",
        &expect![[r#"
        rapid x27.94 z2.54
        rapid x25.4 z2.54
        at x25.4 z?"#]],
    );
}
