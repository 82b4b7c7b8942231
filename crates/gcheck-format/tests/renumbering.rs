//! What renumbering writes again, and what it refuses.

#![expect(clippy::unwrap_used, reason = "a test that meets the unexpected is to fail")]

use expect_test::{Expect, expect};
use gcheck_diagnostics::apply;
use gcheck_format::{Numbering, renumber};
use gcheck_program::Dialect;

fn renumbered(control: &str, text: &str, start: u32, step: u32) -> String {
    let control = gcheck_controls::load(control).unwrap();
    let dialect = Dialect::new(&control);
    match renumber(text, &dialect, &Numbering { start, step }) {
        Ok(edits) => apply(text, &edits),
        Err(refused) => {
            let range = refused.range.start as usize..refused.range.end as usize;
            format!("refused at `{}`: {refused}\n", &text[range])
        }
    }
}

fn check(control: &str, text: &str, expected: &Expect) {
    let once = renumbered(control, text, 10, 10);
    expected.assert_eq(&once);
    if !once.starts_with("refused") {
        assert_eq!(renumbered(control, &once, 10, 10), once, "twice is once");
        assert!(!once.is_empty() || text.is_empty(), "no text is lost");
    }
}

#[test]
fn jumps_follow_their_blocks() {
    check(
        "haas-mill",
        "%\nO1000\nN1 G0 X1. (GOTO 1)\nX2.\nN7 IF [#1 EQ 7] GOTO 99\nGOTO 1\nM97 P0099 L7\nGOTO[7]\nM30\nn99 G1 X7.\nM99\n%\nN7\n",
        &expect![[r#"
            %
            O1000
            N10 G0 X1. (GOTO 1)
            X2.
            N20 IF [#1 EQ 7] GOTO 30
            GOTO 10
            M97 P0030 L7
            GOTO[20]
            M30
            n30 G1 X7.
            M99
            %
            N7
        "#]],
    );
}

#[test]
fn profiles_of_lathe_cycles_follow_their_blocks() {
    check(
        "haas-lathe",
        "O1\nT101\nG71 P1 Q2 D0.1 U0.01 W0.005 F0.01\nN1 G0 X1.\nG1 Z-1.\nN2 X2.\nG70 P1 Q2\nM30\n",
        &expect![[r#"
            O1
            T101
            G71 P10 Q20 D0.1 U0.01 W0.005 F0.01
            N10 G0 X1.
            G1 Z-1.
            N20 X2.
            G70 P10 Q20
            M30
        "#]],
    );
    check(
        "fanuc-lathe",
        "O1\nG71 U2. R1.\nG71 P100 Q200 U.5 W.1 F.2\nN100 G0 X10.\nN200 G1 Z-5.\nG70 P100 Q200\nM30\n",
        &expect![[r#"
            O1
            G71 U2. R1.
            G71 P10 Q20 U.5 W.1 F.2
            N10 G0 X10.
            N20 G1 Z-5.
            G70 P10 Q20
            M30
        "#]],
    );
}

#[test]
fn each_program_is_numbered_by_itself() {
    check(
        "fanuc-mill",
        "O1\nN5 M98 P2\nN7 G0 X1.\nGOTO 5\nM30\nO2\nN5 G1 X1.\nIF [#1 EQ 1] GOTO 5\nM99 P7\n",
        &expect![[r#"
            O1
            N10 M98 P2
            N20 G0 X1.
            GOTO 10
            M30
            O2
            N10 G1 X1.
            IF [#1 EQ 1] GOTO 10
            M99 P20
        "#]],
    );
}

#[test]
fn a_main_program_goes_on_at_a_block_of_its_own() {
    check(
        "haas-lathe",
        "O1\nN3 G0 X1.\n/M99 P3\nM30\n",
        &expect![[r#"
            O1
            N10 G0 X1.
            /M99 P10
            M30
        "#]],
    );
}

#[test]
fn on_a_control_without_jumps_only_the_numbers_change() {
    check(
        "linuxcnc",
        "N1 G0 X1\nn0005 o100 if [1 eq 1]\nN7.5 G1 X7\no100 endif\nM2\n",
        &expect![[r#"
            N10 G0 X1
            n0020 o100 if [1 eq 1]
            N7.5 G1 X7
            o100 endif
            M2
        "#]],
    );
}

#[test]
fn parameter_numbers_stay() {
    check(
        "fanuc-mill",
        "N1 G10 L50\nN3032 R1\nN2 G11\nN3 GOTO 1\n",
        &expect![[r#"
            N10 G10 L50
            N3032 R1
            N20 G11
            N30 GOTO 10
        "#]],
    );
}

#[test]
fn numbers_of_rows_stay_where_a_code_only_may_open_data() {
    for opens in ["#1=50\nG10 L#1", "G10 L#500", "G10 L75 P1"] {
        let rows = "N3032 P1 R1\nN1 T1000 C2";
        assert_eq!(
            renumbered("fanuc-mill", &format!("{opens}\n{rows}\nN2 G11\nN3 G0 X1.\n"), 10, 10),
            format!("{opens}\n{rows}\nN10 G11\nN20 G0 X1.\n")
        );
    }
    // Nothing ends them: these are commands.
    check(
        "fanuc-mill",
        "G10 L75 P1\nN3032 X1.\nN2 G0 X2.\n",
        &expect![[r#"
            G10 L75 P1
            N10 X1.
            N20 G0 X2.
        "#]],
    );
}

#[test]
fn numbers_of_rows_that_nothing_ends_stay() {
    check(
        "fanuc-mill",
        "N1 G10 L50\nN1320 P1 R500000\nP2 N1321 R5\nN2 M98 P10\nN3 G0 X1.\n",
        &expect![[r#"
            N10 G10 L50
            N1320 P1 R500000
            P2 N1321 R5
            N20 M98 P10
            N30 G0 X1.
        "#]],
    );
    check(
        "fanuc-mill",
        "N1 G10 L50\nN1320 P1 R500000\n",
        &expect![[r#"
            N10 G10 L50
            N1320 P1 R500000
        "#]],
    );
}

#[test]
fn an_outline_is_a_block_or_a_program() {
    check(
        "haas-mill",
        "O1\nN1 G150 P5 Z-1. Q1. I1. D1 F100.\nG150 P200 Z-1. Q1. I1. D1 F100.\nM30\nN5 G1 X1.\nM99\n",
        &expect![[r#"
            O1
            N10 G150 P20 Z-1. Q1. I1. D1 F100.
            G150 P200 Z-1. Q1. I1. D1 F100.
            M30
            N20 G1 X1.
            M99
        "#]],
    );
    // The twentieth block would be taken for the flow graph.
    check(
        "haas-mill",
        "O1\nN1 G150 P20 Z-1. Q1. I1. D1 F100.\nN2 M30\n",
        &expect![[r#"
        refused at `P20`: this names program O20, and a block would get that number
    "#]],
    );
}

fn refuses(control: &str, text: &str, place: &str, reason: &str) {
    assert_eq!(renumbered(control, text, 10, 10), format!("refused at `{place}`: {reason}\n"), "{text:?}");
}

#[test]
fn targets_that_are_not_certain_are_refused_at_their_place() {
    let computed = "the block that this names is computed, so its number cannot be followed";
    refuses("haas-mill", "N1 GOTO #1\n", "GOTO #1", computed);
    refuses("haas-mill", "N1 GOTO[#1+1]\n", "GOTO[#1+1]", computed);
    refuses("haas-mill", "N1 M97 P#1\nM30\n", "P#1", computed);
    let missing = "block N5, which this names, does not exist";
    refuses("haas-mill", "N1 GOTO 5\n", "GOTO 5", missing);
    let several = "block N1, which this names, exists more than once in its program";
    refuses("haas-mill", "N1 GOTO 1\nN1 G0\n", "GOTO 1", several);
    let mistake = "this block has a mistake in form, so which block it names is not certain";
    refuses("haas-mill", "N1 GOTO N1\n", "N1 GOTO N1", mistake);
    refuses("haas-mill", "N1 G0 X1.2.3 M97 P1\n", "N1 G0 X1.2.3 M97 P1", mistake);
}

#[test]
fn blocks_of_other_programs_are_refused() {
    let other = "this may name a block of another program, which would not be renumbered with it";
    refuses("haas-mill", "N1 G4 P1 M97\n", "P1", other);
    // Nobody in the file calls it, and nothing says that it is a main program.
    refuses("fanuc-mill", "O9000\nN1 G0\nM99 P1\n", "P1", other);
    // Two programs call it, and their blocks get different numbers.
    let text = "O1\nN1 M98 P2\nM30\nO3\nN4 G0\nN1 M98 P2\nM99\nO2\nM99 P1\n";
    refuses("fanuc-mill", text, "P1", other);
    refuses("fanuc-mill", "O1\nN1 M98 P#1\nM98 P2\nM30\nO2\nM99 P1\n", "P1", other);
    refuses("fanuc-mill", "O1\nN1 M98 P2 H5\nM30\n", "H5", other);
}

#[test]
fn numbers_that_are_read_or_do_not_stand_in_front_are_refused() {
    let read = "this reads the number of a block, which would be another one";
    refuses("fanuc-mill", "N1 #1=[#4114+1]\n", "[#4114+1]", read);
    refuses("haas-mill", "N1 G0 X[#4114]\n", "[#4114]", read);
    let stray = "this number is not in front of its block, so it is not certain that a jump leads to it";
    refuses("haas-mill", "N1 GOTO 1\nN2 N5 G0\n", "N5", stray);
    refuses("haas-mill", "N1 GOTO 1\nG0 N5\n", "N5", stray);
}

#[test]
fn numbers_stay_within_those_of_the_control() {
    let text = "O1\nN1 G0\nN2 G0\nN3 G0\nM30\n";
    for (control, text, start, step, expected) in [
        (
            "haas-mill",
            text,
            99_990,
            5,
            expect![[r#"
            refused at `N3`: this block would be N100000; the control takes numbers up to 99999
        "#]],
        ),
        (
            "tsnc-yh-a1m",
            text,
            9_990,
            5,
            expect![[r#"
            refused at `N3`: this block would be N10000; the control takes numbers up to 9999
        "#]],
        ),
        (
            "fanuc-mill",
            text,
            1,
            u32::MAX,
            expect![[r#"
            refused at `N2`: this block would be N4294967296; the control takes numbers up to 99999
        "#]],
        ),
        // A number that is there the control takes.
        (
            "fanuc-mill",
            "N1 G0\nN400000 G0\n",
            99_999,
            1,
            expect![[r#"
            N99999 G0
            N100000 G0
        "#]],
        ),
        (
            "fanuc-mill",
            "N1 G0\nN4294967295 G0\n",
            1,
            u32::MAX,
            expect![[r#"
            refused at `N4294967295`: this block would be N4294967296; the control takes numbers up to 4294967295
        "#]],
        ),
        (
            "haas-mill",
            text,
            0,
            10,
            expect![[r#"
            refused at ``: block numbers of the control go from 1 to 99999, in steps of 1 or more
        "#]],
        ),
        (
            "haas-mill",
            text,
            10,
            0,
            expect![[r#"
            refused at ``: block numbers of the control go from 1 to 99999, in steps of 1 or more
        "#]],
        ),
        (
            "haas-mill",
            text,
            100_000,
            1,
            expect![[r#"
            refused at ``: block numbers of the control go from 1 to 99999, in steps of 1 or more
        "#]],
        ),
    ] {
        expected.assert_eq(&renumbered(control, text, start, step));
    }
}
