//! Blocks whose words and codes do not fit together: refused where the control refuses them, with nothing of the block done that
//! the control would not have done.

mod cycle_harness;

use cycle_harness::{machine, shown_on};
use gcheck_engine::Machine;

/// What a program does on the strict control before it is refused, and why.
fn refused(text: &str) -> String {
    let text = shown_on("linuxcnc", "XYZ", &machine(2.0), &format!("{text}\nM2\n"));
    let (what, _) = text.rsplit_once("at").unwrap_or_default();
    what.trim_end().replace('\n', " | ")
}

fn accepted(control: &str, text: &str) -> bool {
    let shown = shown_on(control, "XYZ", &machine(2.0), &format!("{text}\nM30\n"));
    // A fault is a line that opens with its name.
    !shown.lines().any(|line| line.starts_with(|c: char| c.is_ascii_uppercase()))
}

#[test]
fn words_that_nobody_reads_are_refused() {
    assert_eq!(refused("G0 X1 P5"), "UnreadWord(P)");
    assert_eq!(refused("P5"), "UnreadWord(P)");
    assert_eq!(refused("G4 P1 Q1"), "UnreadWord(Q)");
    assert_eq!(refused("G0 X1 $0"), "UnreadWord($)");
    assert!(accepted("linuxcnc", "S100 $0"));
}

#[test]
fn the_motion_in_effect_reads_words_only_when_it_moves() {
    assert!(accepted("linuxcnc", "G2 X1 I.5 F100\nX2 I.5"));
    assert_eq!(refused("G1 X1 F100\nX2 I.5"), "feed x1 y0 z0 | UnreadWord(I)");
    assert_eq!(refused("F100 G2 X2 I1\nR1"), "cw x2 y0 z0 about 1 0 | UnreadWord(R)");
    assert_eq!(
        refused("F100 G81 X1 Z-1 R0\nR2")
            .rsplit_once(" | ")
            .map(|(_, fault)| fault.to_owned())
            .unwrap_or_default(),
        "UnreadWord(R)"
    );
}

#[test]
fn a_centre_alone_is_a_full_circle() {
    assert_eq!(refused("F100 G2 X2 I1\nI1\nX"), "cw x2 y0 z0 about 1 0 | cw x2 y0 z0 about 3 0 | Malformed");
}

#[test]
fn an_address_stands_once() {
    assert_eq!(refused("G0 X1 X2"), "WordTwice(X)");
    assert_eq!(refused("F1 F1"), "WordTwice(F)");
    assert!(accepted("fanuc-mill", "G0 X1. X2."));
}

#[test]
fn a_modal_group_has_one_code_in_a_block() {
    for block in ["G0 G1 X1", "G17 G18", "G4 P1 G10 L2", "M3 M5", "M7 M8", "M3 M70", "G0 G0", "M2 M99"] {
        assert_eq!(refused(block), "Conflict", "{block}");
    }
    assert!(accepted("linuxcnc", "G90 G90.1 G20 G17 M3 S1 M8"));
    assert!(accepted("linuxcnc", "G0 G80 X1"), "the end of cycles goes before the motion");
    assert!(accepted("haas-mill", "G17 G18"), "what is only assumed refuses nothing");
}

#[test]
fn only_one_code_uses_the_axis_words() {
    assert_eq!(refused("G10 L2 P1 G0 X1"), "Conflict");
    assert_eq!(refused("G28 G1 X1"), "Conflict");
    assert!(accepted("linuxcnc", "G43.1 Z1 G0"), "a length from the block shares them");
}

#[test]
fn a_block_has_so_many_m_codes() {
    assert!(accepted("linuxcnc", "M3 S1 M8 M48 M0"));
    assert_eq!(refused("M3 S1 M8 M48 M0 M62 P1"), "TooManyCodes");
}

#[test]
fn a_number_stands_at_the_head_of_its_block() {
    assert_eq!(refused("G0 N10 X1"), "Misplaced(N) in N10");
    assert_eq!(refused("(first) N10 G0 X1"), "Misplaced(N) in N10");
    assert_eq!(refused("N#1 G0 X1"), "WordRange(N)");
    assert_eq!(refused("G0 / X1"), "Malformed");
    assert!(accepted("linuxcnc", "N10 (then) G0 X1\n/ N20 G0 X2"));
}

#[test]
fn a_call_opens_its_block_and_nothing_else_acts() {
    assert_eq!(refused("G0 X1 M98 P100"), "UnknownCode");
    assert_eq!(refused("M98 P100 G0 X1\nX7 P1\nM2\nO100\nG0 X5\nM99"), "rapid x5 y0 z0 | UnreadWord(P)");
}

#[test]
fn words_that_a_code_needs_are_asked_for_before_the_block_acts() {
    assert_eq!(refused("M3 S100 F100 G4"), "NoDwellTime");
    assert_eq!(refused("G96 D100"), "MissingWord(S)");
    assert_eq!(refused("G10 P1"), "MissingWord(L)");
    assert_eq!(refused("G10 L2 P10"), "WordRange(P)");
    assert_eq!(refused("G92"), "NoAxisWords");
    assert_eq!(refused("F100 G38.2"), "NoAxisWords");
    assert_eq!(refused("G5 P1"), "NoAxisWords");
}

#[test]
fn values_are_judged_as_written_or_as_computed() {
    assert_eq!(refused("#1=-1\nG4 P#1"), "WordRange(P)");
    assert_eq!(refused("T[1.5]"), "WordRange(T)");
    assert_eq!(refused("G2 X1 I.5 P1.5 F100"), "WordRange(P)");
    assert_eq!(refused("G81 X1 Z-1 R1 L1.5 F100"), "WordRange(L)");
}

#[test]
fn a_move_in_machine_coordinates_is_straight_and_absolute() {
    assert_eq!(refused("G53 G2 X1 I.5 F100"), "Conflict");
    assert_eq!(refused("G0 X1\nG53"), "rapid x1 y0 z0 | NoMotionMode");
    assert_eq!(refused("G53 G0 G91 X1"), "Conflict");
    assert!(accepted("linuxcnc", "G91\nG53 G0 G90 X1"));
}

#[test]
fn what_compensation_forbids_is_refused_with_the_move_it_holds_back() {
    let on = "T1 M6 F100 G0 X-10 Y-10\nG41 G1 X0 Y0\n";
    for block in
        ["G61", "G98", "G92 X1", "G52 X1", "G10 L2 P1 X1", "M48", "M62 P1", "M66 P1", "G28.1", "#1=#5421"]
    {
        let shown = refused(&format!("{on}{block}\nY10"));
        assert_eq!(shown, "rapid x-10 y-10 z0 | Compensation(NotWhileOn)", "{block}");
    }
}

#[test]
fn a_cut_without_feed_does_not_move() {
    assert_eq!(refused("G1 X1"), "NoFeed");
    assert_eq!(refused("G93 G1 X1"), "NoInverseTimeFeed");
    assert_eq!(refused("G95 F1 G1 X1"), "SpindleStopped");
}

#[test]
fn cycles_are_refused_where_the_control_looks() {
    // The words over the start, the spindle over the hole.
    assert_eq!(refused("F100 G82 X1 Z-1 R1"), "rapid x0 y0 z1 | Cycle(Missing(P))");
    assert_eq!(refused("F100 G84 X1 Z-1 R1"), "rapid x0 y0 z1 | rapid x1 y0 z1 | SpindleStopped");
    assert_eq!(refused("F100 S1 M4 G84 X1 Z-1 R1"), "rapid x0 y0 z1 | rapid x1 y0 z1 | SpindleDirection");
    assert_eq!(refused("F100 G81 A5 Z-1 R1"), "Cycle(Rotary)");
}

#[test]
fn another_cycle_takes_no_words_over() {
    let first = "F100 G81 X1 Z-1 R0";
    let moves = "rapid x1 y0 z0 | feed x1 y0 z-1 | rapid x1 y0 z0";
    assert_eq!(refused(&format!("{first}\nG82 X2 P1")), format!("{moves} | Cycle(Missing(R))"));
    assert_eq!(refused(&format!("{first}\nG80\nG81 X2 R1")), format!("{moves} | Cycle(Missing(Z))"));
    assert!(accepted("linuxcnc", &format!("{first}\nG81 X2")));
}

#[test]
fn variables_end_where_the_control_says() {
    assert_eq!(refused("#5602=1"), "VariableNumber");
    assert_eq!(refused("#1=#0"), "VariableNumber");
    assert_eq!(refused("G0 X1 #5420=1"), "ReadOnlyVariable(5420)");
    assert!(accepted("linuxcnc", "#5601=1"));
}

#[test]
fn axes_spindles_and_commands_that_nobody_described_are_not_there() {
    assert_eq!(refused("G0 U1"), "NoSuchAxis(U)");
    assert_eq!(refused("S100 $1"), "WordRange($)");
    assert_eq!(refused("M100 P1"), "UnknownCode");
    let with_u = Machine { axes: Some(gcheck_engine::Axis::ALL.to_vec()), ..machine(2.0) };
    let shown = shown_on("linuxcnc", "XU", &with_u, "G0 U1\nM2\n");
    assert!(shown.starts_with("rapid x0 u1\n"), "{shown}");
}

#[test]
fn curves_are_drawn_in_one_plane_from_enough_points() {
    assert_eq!(refused("F100 G5.2 X1 Y1 P1\nG5.3"), "TooFewPoints");
    assert_eq!(refused("F100 G5.2 X1 Y1 P1 L4\nX1 Y2 P1\nG5.3"), "TooFewPoints");
    assert_eq!(refused("F100 G5.2 X1 P1"), "MissingWord(Y)");
    assert!(refused("F100 G18 G5 X1 Y1 I1 J1 P1 Q1").starts_with("NotNow("));
    assert_eq!(refused("F100 G5 X1 Y1 I1 J1 P1 Q1\nX2 P1 Q1"), "NoMotionMode");
}

#[test]
fn text_after_a_complete_word_is_refused() {
    for block in [
        "G1 F10 X5[2]",
        "X[1][2]",
        "G0 X-SIN[30][2]",
        "G0[2-1]",
        "#1=3[2]",
        "T1[2] M6",
        "G0 X1 [2]",
        "G0 X1 Y2,Z3",
        "G53,G0 X1",
        "#1=3,G0 X1",
        "G0 X1 %",
        "(a) %",
        "S100 :3",
        "#1=EXISTS[2]",
        "#1=EXISTS[#<a>+1]",
        "#1=EXISTS[[#<a>]]",
        "o1.5 if [1]\no1.5 endif",
        "o[1.5] if [1]\no[1.5] endif",
        "[1] G0 X1",
    ] {
        assert_eq!(refused(block), "Malformed", "{block}");
    }
    for control in ["fanuc-mill", "haas-mill"] {
        for block in ["G0 X5.[2]", "X[1][2]", "G0 X1. Y2.,Z3.", "#1=3[2]"] {
            assert!(!accepted(control, block), "{control}: {block}");
        }
    }
    assert!(accepted("linuxcnc", "#<a>=1\n#1=EXISTS[#<a>]\n#2=EXISTS[ #5220 ]"));
    assert!(accepted("fanuc-mill", "G1 F100. X10.,R2.\nY10."));
}

#[test]
fn codes_may_have_zeros_at_their_end() {
    assert!(accepted("linuxcnc", "G01.00 F10.0 X1\nG41.10 D0.1 X2\nG40.0\nG59.10\nM05.00"));
    assert_eq!(refused("G59.11"), "UnknownCode");
    assert_eq!(refused("G1.01 X1"), "UnknownCode");
}

#[test]
fn computed_codes_are_as_near_as_the_control_asks() {
    assert!(accepted("linuxcnc", "G[0.0001] X1\nM[5.00009]"));
    for block in ["M[5.0001]", "M[1.9999]", "G[1.0002] F10 X1", "G[59.11]"] {
        assert_eq!(refused(block), "UnknownCode", "{block}");
    }
}

#[test]
fn an_assignment_brings_its_name_into_being() {
    assert!(accepted("linuxcnc", "#<a>=#<a>"));
    assert_eq!(refused("#<a>=1 G0 X#<a>\nG0 X#<a>\nP5"), "rapid x0 y0 z0 | rapid x1 y0 z0 | UnreadWord(P)");
    assert_eq!(refused("G0 X#<a> #<a>=1"), "UnsetParameter");
}

#[test]
fn what_the_control_keeps_is_not_assigned_to() {
    for name in ["_value", "_value_returned", "_x", "_vmajor"] {
        assert_eq!(refused(&format!("#<{name}>=1")), "ReadOnlyVariable(0)", "{name}");
    }
}

#[test]
fn a_repeat_is_neither_left_nor_cut_short() {
    assert_eq!(refused("o1 repeat [2]\no1 break\no1 endrepeat"), "LoopMismatch");
    assert_eq!(refused("o1 repeat [2]\no1 continue\no1 endrepeat"), "LoopMismatch");
}

#[test]
fn a_label_opens_one_structure_that_is_executed() {
    for second in ["repeat [0]\no1 endrepeat", "while [0]\no1 endwhile", "if [0]\no1 endif"] {
        assert_eq!(refused(&format!("o1 repeat [1]\no1 endrepeat\no1 {second}")), "LoopMismatch", "{second}");
    }
    assert_eq!(refused("o1 sub\no1 endsub\no1 sub\no1 endsub"), "LoopMismatch");
    assert!(accepted("linuxcnc", "o2 if [0]\no1 if [1]\no1 endif\no2 endif\no1 if [1]\no1 endif"));
    assert!(accepted("linuxcnc", "o1 do\no1 while [0]\no1 do\no1 while [0]"));
    assert!(accepted(
        "linuxcnc",
        "o9 sub\no1 if [1]\no1 endif\no9 endsub\no9 call\no1 if [1]\no1 endif\no9 call"
    ));
}

#[test]
fn tool_data_is_written_with_a_value() {
    assert_eq!(refused("G10 L1 P1"), "MissingWord(R)");
    assert_eq!(refused("G10 L11 P1"), "MissingWord(R)");
    assert!(accepted("linuxcnc", "G10 L1 P1 R1\nG10 L1 P1 Z2\nG10 L2 P1"));
}

#[test]
fn labels_are_numbers_however_they_are_written() {
    let moves = |program: &str| refused(&format!("{program}\nP5"));
    for (label, again, caller) in [
        ("100", "100", "<100>"),
        ("<100>", "<100>", "100"),
        ("[200]", "[200]", "[100*2]"),
        ("[200]", "200", "200"),
    ] {
        let program = format!("o{label} sub\nG0 X1\no{again} endsub\no{caller} call");
        assert_eq!(moves(&program), "rapid x1 y0 z0 | UnreadWord(P)", "{program}");
    }
    assert_eq!(moves("o<0100> call\no100 sub\no100 endsub"), "NoSuchProgram");
}

#[test]
fn computed_labels_are_matched_by_their_values() {
    let moves = |program: &str| refused(&format!("#1=1\n{program}\nP5"));
    assert_eq!(moves("o[#1] if [0]\nG0 X1\no[#1] endif"), "UnreadWord(P)");
    assert_eq!(moves("o[#1] if [0]\nG0 X1\no1 endif"), "UnreadWord(P)");
    assert_eq!(moves("o#1 if [1]\nG0 X1\no[#1] else\nG0 X2\no1 endif"), "rapid x1 y0 z0 | UnreadWord(P)");
    assert_eq!(
        moves("o[#1] repeat [2]\nG0 X1\no[#1] endrepeat"),
        "rapid x1 y0 z0 | rapid x1 y0 z0 | UnreadWord(P)"
    );
    assert_eq!(moves("o[#1] while [#1 lt 1]\nG0 X1\no[#1] endwhile"), "UnreadWord(P)");
    assert_eq!(
        moves("o[#1] do\n#2=[#2+1]\nG0 X#2\no[#1] while [#2 lt 2]"),
        "rapid x1 y0 z0 | rapid x2 y0 z0 | UnreadWord(P)"
    );
    assert_eq!(
        moves("o[#1] while [1]\nG0 X1\no[#1] break\no[#1] endwhile"),
        "rapid x1 y0 z0 | UnreadWord(P)"
    );
    assert_eq!(moves("o[#1+199] sub\nG0 X1\no[#1+199] endsub\no200 call"), "rapid x1 y0 z0 | UnreadWord(P)");
    assert_eq!(moves("o[#1/2] if [1]\no[#1/2] endif"), "WordRange(O)");
}
