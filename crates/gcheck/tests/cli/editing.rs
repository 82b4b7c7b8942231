//! `gcheck edit`: what each change does to a program, that nothing is written without its proof, and the words of refusals.

use std::fmt::Write as _;
use std::fs;
use std::path::Path;

use expect_test::{Expect, expect};

use crate::shop::{Run, Shop};

/// A part with a contour, two holes and an arc, as CAM writes it for a mill.
const PART: &str = "\
%
O1 (PLATE)
G21 G17 G90 G94 G54 G40 G80
T1 M6
S4000 M3
G0 X-10. Y-10.
G43 H1 Z10.
G1 Z-2. F300.
G41 D1 X0. Y0. F800.
Y40.
G2 X10. Y50. I10. J0.
G1 X60.
Y0.
X0.
G40 X-10. Y-10.
G0 Z10.
G91 G28 Z0.
G90 T2 M6
S2000 M3
G0 X10. Y10.
G43 H2 Z10.
G99 G83 X10. Y10. Z-12. R2. Q4. F120.
X50.
G80
G91 G28 Z0. M5
M30
%
";

fn edit(program: &str, control: &str, arguments: &str) -> (Run, String) {
    let shop = Shop::with(&[("part.nc", program)]);
    let run = shop.gcheck(&format!("edit {arguments} part.nc --control {control}"));
    let text = shop.read("part.nc");
    (run, text)
}

/// The lines that a change of a program writes, and what it says first.
#[track_caller]
fn changes(program: &str, control: &str, arguments: &str, expected: &Expect) {
    let (run, text) = edit(program, control, arguments);
    let before: Vec<&str> = program.lines().collect();
    let mut out = String::new();
    for (index, line) in text.lines().enumerate() {
        if before.get(index) != Some(&line) {
            let _ = writeln!(out, "{:>2} {line}", index + 1);
        }
    }
    let said = run.stderr.lines().take_while(|line| !line.starts_with("assumed"));
    for line in said {
        let _ = writeln!(out, "! {line}");
    }
    let _ = writeln!(out, "exit {}", run.code);
    expected.assert_eq(&out);
}

/// A change that is refused: nothing is written, and the reason is named with its place.
#[track_caller]
fn refuses(program: &str, control: &str, arguments: &str, expected: &Expect) {
    let (run, text) = edit(program, control, arguments);
    assert_eq!(text, program, "nothing is written");
    assert_eq!(run.code, 2, "{}", run.stderr);
    expected.assert_eq(&run.stderr);
}

#[test]
fn feeds_of_the_whole_program() {
    changes(
        PART,
        "haas-mill",
        "scale-feeds 0.8",
        &expect![[r#"
             8 G1 Z-2. F240.
             9 G41 D1 X0. Y0. F640.
            22 G99 G83 X10. Y10. Z-12. R2. Q4. F96.
            ! part.nc: changed for haas-mill: every feed is 0.8 times what it was, within 0.001 mm (39 moves compared)
            ! note: the size of cutter 1 is not known; the proof takes a radius of 0.01 mm
            exit 0
        "#]],
    );
}

#[test]
fn feeds_of_some_lines_get_words_where_the_selection_begins_and_ends() {
    changes(
        PART,
        "haas-mill",
        "scale-feeds 50% --lines 11-12",
        &expect![[r#"
            11 G2 X10. Y50. I10. J0. F400.
            13 Y0. F800.
            ! part.nc: changed for haas-mill: in lines 11 to 12 every feed is 0.5 times what it was, and every other move is as before, within 0.001 mm (39 moves compared)
            ! note: the size of cutter 1 is not known; the proof takes a radius of 0.01 mm
            exit 0
        "#]],
    );
}

#[test]
fn feeds_of_a_tool() {
    changes(
        PART,
        "haas-mill",
        "scale-feeds 1.25 --tool 2",
        &expect![[r#"
            22 G99 G83 X10. Y10. Z-12. R2. Q4. F150.
            ! part.nc: changed for haas-mill: with T2 every feed is 1.25 times what it was, and every other move is as before, within 0.001 mm (39 moves compared)
            ! note: the size of cutter 1 is not known; the proof takes a radius of 0.01 mm
            exit 0
        "#]],
    );
}

#[test]
fn speeds_of_a_tool() {
    changes(
        PART,
        "haas-mill",
        "scale-speeds 1.1 --tool 1",
        &expect![[r#"
             5 S4400 M3
            ! part.nc: changed for haas-mill: with T1 every spindle speed is 1.1 times what it was, and every other move is as before, within 0.001 mm (39 moves compared)
            ! note: the size of cutter 1 is not known; the proof takes a radius of 0.01 mm
            exit 0
        "#]],
    );
}

#[test]
fn a_path_is_shifted() {
    changes(
        PART,
        "haas-mill",
        "translate --x 100 --y -2.5 --z 1",
        &expect![[r#"
             6 G0 X90. Y-12.5
             7 G43 H1 Z11.
             8 G1 Z-1. F300.
             9 G41 D1 X100. Y-2.5 F800.
            10 Y37.5
            11 G2 X110. Y47.5 I10. J0.
            12 G1 X160.
            13 Y-2.5
            14 X100.
            15 G40 X90. Y-12.5
            16 G0 Z11.
            20 G0 X110. Y7.5
            21 G43 H2 Z11.
            22 G99 G83 X110. Y7.5 Z-11. R3. Q4. F120.
            23 X150.
            ! part.nc: changed for haas-mill: every move is shifted by X100 Y-2.5 Z1, within 0.001 mm (39 moves compared)
            ! note: the size of cutter 1 is not known; the proof takes a radius of 0.01 mm
            exit 0
        "#]],
    );
}

#[test]
fn the_path_of_a_tool_is_shifted_and_the_other_stays() {
    changes(
        PART,
        "haas-mill",
        "translate --x 5 --tool 2",
        &expect![[r#"
            20 G0 X15. Y10.
            22 G99 G83 X15. Y10. Z-12. R2. Q4. F120.
            23 X55.
            ! part.nc: changed for haas-mill: with T2 every move is shifted by X5, and every other move is as before, within 0.001 mm (39 moves compared)
            ! note: the size of cutter 1 is not known; the proof takes a radius of 0.01 mm
            exit 0
        "#]],
    );
}

#[test]
fn a_path_is_mirrored_with_its_arcs_and_compensation() {
    changes(
        PART,
        "haas-mill",
        "mirror X --at 25",
        &expect![[r#"
             6 G0 X60. Y-10.
             9 G42 D1 X50. Y0. F800.
            11 G3 X40. Y50. I-10. J0.
            12 G1 X-10.
            14 X50.
            15 G40 X60. Y-10.
            20 G0 X40. Y10.
            22 G99 G83 X40. Y10. Z-12. R2. Q4. F120.
            23 X0.
            ! part.nc: changed for haas-mill: every move is mirrored at X25, within 0.001 mm (39 moves compared)
            ! note: climb milling becomes conventional milling, and the other way round: the spindle still turns as before
            ! note: the size of cutter 1 is not known; the proof takes a radius of 0.01 mm
            exit 0
        "#]],
    );
}

#[test]
fn a_path_is_rotated() {
    changes(
        PART,
        "haas-mill",
        "rotate 90 --about 10,10",
        &expect![[r#"
             6 G0 X30. Y-10.
             9 G41 D1 X20. Y0. F800.
            10 X-20.
            11 G2 X-30. Y10. I0. J10.
            12 G1 Y60.
            13 X20.
            14 Y0.
            15 G40 X30. Y-10.
            23 Y50.
            ! part.nc: changed for haas-mill: every move is rotated by 90° about X10 Y10, within 0.001 mm (39 moves compared)
            ! note: the size of cutter 1 is not known; the proof takes a radius of 0.01 mm
            exit 0
        "#]],
    );
}

#[test]
fn increments_and_places_of_the_machine_stay() {
    let program = "%\nO1\nG21 G17 G90 G54 G40 G80\nT1 M6\nG0 X0. Y0. S900 M3\nG43 H1 Z5.\nG1 Z-1. F100.\nG91 X10.\nG2 X10. Y10. I10.\nG90 G3 X30. Y0. R10.\nG0 Z5.\nG53 Z0.\nG91 G28 Y0.\nM30\n%\n";
    changes(
        program,
        "fanuc-mill",
        "translate --x 1 --y 2",
        &expect![[r#"
             5 G0 X1. Y2. S900 M3
            10 G90 G3 X31. Y2. R10.
            ! part.nc: changed for fanuc-mill: every move is shifted by X1 Y2, within 0.001 mm (8 moves compared)
            exit 0
        "#]],
    );
    changes(
        program,
        "fanuc-mill",
        "mirror y",
        &expect![[r#"
             9 G3 X10. Y-10. I10.
            10 G90 G2 X30. Y0. R10.
            ! part.nc: changed for fanuc-mill: every move is mirrored at Y0, within 0.001 mm (8 moves compared)
            ! note: climb milling becomes conventional milling, and the other way round: the spindle still turns as before
            exit 0
        "#]],
    );
    changes(
        program,
        "fanuc-mill",
        "rotate 180",
        &expect![[r#"
             8 G91 X-10.
             9 G2 X-10. Y-10. I-10.
            10 G90 G3 X-30. Y0. R10.
            ! part.nc: changed for fanuc-mill: every move is rotated by 180° about X0 Y0, within 0.001 mm (8 moves compared)
            exit 0
        "#]],
    );
}

#[test]
fn absolute_centres_move_with_their_arcs() {
    let program = "G21 G17 G90 G90.1 G54 G40\nG0 X0 Y0 Z5\nG1 Z-1 F100\nG2 X10 Y10 I10 J0\nG91.1\nG2 X20 Y0 I0 J-10\nG0 Z5\nM2\n";
    changes(
        program,
        "linuxcnc",
        "translate --x 100 --y 0.25",
        &expect![[r#"
         2 G0 X100 Y0.25 Z5
         4 G2 X110 Y10.25 I110 J0.25
         6 G2 X120 Y0.25 I0 J-10
        ! part.nc: changed for linuxcnc: every move is shifted by X100 Y0.25, within 0.001 mm (5 moves compared)
        exit 0
    "#]],
    );
    changes(
        program,
        "linuxcnc",
        "rotate 270 --about 5,5",
        &expect![[r#"
         2 G0 X0 Y10 Z5
         4 G2 X10 Y0 I0 J0
         6 G2 X0 Y-10 I-10 J0
        ! part.nc: changed for linuxcnc: every move is rotated by 270° about X5 Y5, within 0.001 mm (5 moves compared)
        exit 0
    "#]],
    );
}

#[test]
fn computed_words_get_a_sum() {
    let program = "%\nO1\nG21 G17 G90 G54 G40 G80\n#1=0\nG0 X0. Y0. Z5.\nWHILE [#1 LT 3] DO1\nG0 X[#1*10.] Y#1\nG1 Z-[1.+#1] F[100.+#1]\nG0 Z5.\n#1=#1+1\nEND1\nM30\n%\n";
    changes(
        program,
        "fanuc-mill",
        "translate --x 5 --y -2.5 --z 1",
        &expect![[r#"
         5 G0 X5. Y-2.5 Z6.
         7 G0 X[[#1*10.]+5.] Y[#1-2.5]
         8 G1 Z[[-[1.+#1]]+1.] F[100.+#1]
         9 G0 Z6.
        ! part.nc: changed for fanuc-mill: every move is shifted by X5 Y-2.5 Z1, within 0.001 mm (9 moves compared)
        exit 0
    "#]],
    );
    changes(
        program,
        "fanuc-mill",
        "mirror x --at 20",
        &expect![[r#"
         5 G0 X40. Y0. Z5.
         7 G0 X[40.-[#1*10.]] Y#1
        ! part.nc: changed for fanuc-mill: every move is mirrored at X20, within 0.001 mm (9 moves compared)
        ! note: climb milling becomes conventional milling, and the other way round: the spindle still turns as before
        exit 0
    "#]],
    );
    changes(
        program,
        "fanuc-mill",
        "scale-feeds 0.5",
        &expect![[r#"
         8 G1 Z-[1.+#1] F[[100.+#1]*0.5]
        ! part.nc: changed for fanuc-mill: every feed is 0.5 times what it was, within 0.001 mm (9 moves compared)
        exit 0
    "#]],
    );
}

#[test]
fn numbers_keep_the_hand_of_their_writer() {
    let program =
        "%\nO1\nG20G17G90G54G40G80\nG0X.5000Y+1.0000Z.1000\nG1Z-.0500F12.00\nX1.2500\nG0Z.1000\nM30\n%\n";
    changes(
        program,
        "haas-mill",
        "translate --x -.75 --y 1mm",
        &expect![[r#"
         4 G0X-.2500Y+1.0394Z.1000
         6 X.5000
        ! part.nc: changed for haas-mill: every move is shifted by X-0.75 Y1 mm, within 0.001 mm (4 moves compared)
        exit 0
    "#]],
    );
    let counts =
        "%\nO1\nG21 G17 G90 G54 G40 G80\nG0 X1000 Y2000 Z5000\nG1 Z-1000 F100\nX2000\nG0 Z5000\nM30\n%\n";
    changes(
        counts,
        "fanuc-mill",
        "translate --x 2.5",
        &expect![[r#"
         4 G0 X3500 Y2000 Z5000
         6 X4500
        ! part.nc: changed for fanuc-mill: every move is shifted by X2.5, within 0.001 mm (4 moves compared)
        exit 0
    "#]],
    );
}

#[test]
fn a_lathe_counts_x_in_diameters() {
    let program = "%\nO1\nG21 G18 G40 G99 G54\nT0101\nG97 S800 M3\nG0 X50. Z2.\nG1 X40. F0.2\nZ-20.\nU10. W-2.\nG2 X60. Z-27. R5.\nG0 X80.\nZ2.\nG28 U0. W0.\nM30\n%\n";
    changes(
        program,
        "fanuc-lathe",
        "translate --x 1 --z -0.5",
        &expect![[r#"
         6 G0 X51. Z1.5
         7 G1 X41. F0.2
         8 Z-20.5
        10 G2 X61. Z-27.5 R5.
        11 G0 X81.
        12 Z1.5
        ! part.nc: changed for fanuc-lathe: every move is shifted by X1 Z-0.5, within 0.001 mm (7 moves compared)
        exit 0
    "#]],
    );
    changes(
        program,
        "fanuc-lathe",
        "scale-feeds 0.9",
        &expect![[r#"
         7 G1 X40. F0.18
        ! part.nc: changed for fanuc-lathe: every feed is 0.9 times what it was, within 0.001 mm (7 moves compared)
        exit 0
    "#]],
    );
}

#[test]
fn taps_keep_their_lead_and_threads_too() {
    let program = "%\nO1\nG21 G17 G90 G94 G54 G40 G80\nT3 M6\nS500 M3\nG0 X0. Y0.\nG43 H3 Z5.\nG84 Z-10. R2. F500.\nX20.\nG80\nG1 X30. F200.\nG0 Z50.\nM30\n%\n";
    changes(
        program,
        "haas-mill",
        "scale-feeds 0.5",
        &expect![[r#"
            11 G1 X30. F100.
            ! part.nc: changed for haas-mill: every feed is 0.5 times what it was, within 0.001 mm (13 moves compared)
            ! note: the feed of a tap and the lead of a thread stay as they are
            exit 0
        "#]],
    );
    changes(
        program,
        "haas-mill",
        "scale-speeds 2",
        &expect![[r#"
         5 S1000 M3
         8 G84 Z-10. R2. F1000.
        ! part.nc: changed for haas-mill: every spindle speed is 2 times what it was, within 0.001 mm (13 moves compared)
        exit 0
    "#]],
    );
}

#[test]
fn a_block_that_may_be_skipped_is_proved_both_ways() {
    let program =
        "%\nO1\nG21 G17 G90 G54 G40 G80\nG0 X0. Y0. Z5.\n/G0 X10.\nG1 Z-1. F100.\nX20.\nG0 Z5.\nM30\n%\n";
    changes(
        program,
        "haas-mill",
        "translate --x 1",
        &expect![[r#"
         4 G0 X1. Y0. Z5.
         5 /G0 X11.
         7 X21.
        ! part.nc: changed for haas-mill: every move is shifted by X1, within 0.001 mm (5 moves compared, with block delete off and on)
        exit 0
    "#]],
    );
}

#[test]
fn renumbering_is_proved_too() {
    let program = "%\nO1\nG21 G17 G90 G54 G40 G80\nN1 G0 X0. Y0. Z5.\nGOTO 7\nN7 G1 Z-1. F100.\nM30\n%\n";
    changes(
        program,
        "haas-mill",
        "renumber 100:10",
        &expect![[r#"
         4 N100 G0 X0. Y0. Z5.
         5 GOTO 110
         6 N110 G1 Z-1. F100.
        ! part.nc: changed for haas-mill: every move is as before, within 0.001 mm (2 moves compared)
        exit 0
    "#]],
    );
    refuses(
        program,
        "haas-mill",
        "renumber 100:10 --lines 3-4",
        &expect![[r#"
        error: blocks are renumbered in the whole file, as jumps lead everywhere
          help: leave out --lines and --tool
        part.nc: nothing is changed
    "#]],
    );
}

/// A program that writes parameters and tool lives before it cuts.
const DATA: &str = "\
%
O1
G21 G17 G90 G94 G54 G40 G80
G10 L3
P1 L20
T5 H5 D5
G11
T1 M6
S4000 M3
G0 X0. Y0.
G43 H1 Z50.
G10 L52
N1320 P1 R500000
N1321 X5 Y6 Z7 F3 S4
G11
G1 Z-5. F100.
X10.
G0 Z50.
M30
%
";

#[test]
fn rows_of_data_stay() {
    let changes = [
        "inch",
        "mm",
        "absolute",
        "incremental",
        "translate --x 10",
        "translate --z 1",
        "mirror X",
        "rotate 90",
        "scale-feeds 80%",
        "scale-speeds 80%",
        "safe-start",
        "renumber 10:10",
        "expand-cycle",
        "fold-cycle",
    ];
    let in_inches = DATA.replace("G21", "G20").replace("F100.", "F10.");
    for program in [DATA, &in_inches] {
        let rows: Vec<&str> =
            program.lines().filter(|line| line.starts_with("N13") || line.contains("H5")).collect();
        for change in changes {
            let (run, text) = edit(program, "fanuc-mill", change);
            assert_eq!(run.code, 0, "{change}: {}", run.stderr);
            let after: Vec<&str> = text.lines().filter(|line| rows.contains(line)).collect();
            assert_eq!(after, rows, "{change}: {text}");
        }
    }
    // Nothing ends them, or no run comes to them.
    let open = DATA.replacen("G11\nG1 Z-5.", "G1 Z-5.", 1);
    let unreached = DATA.replacen("M30\n", "M30\nO2\nG10 L52\nN1320 P1 R7\nN1321 X5\nG11\nM99\n", 1);
    let rows =
        |text: &str| text.lines().filter(|line| line.starts_with("N13")).collect::<Vec<_>>().join("\n");
    for (program, change) in [(&open, "inch"), (&open, "translate --x 10"), (&unreached, "translate --x 10")]
    {
        let (run, text) = edit(program, "fanuc-mill", change);
        assert_eq!(run.code, 0, "{change}: {}", run.stderr);
        assert_ne!(text, *program, "{change}");
        assert_eq!(rows(&text), rows(program), "{change}");
    }
}

#[test]
fn rows_of_a_number_that_is_not_listed_stay_as_they_are() {
    let program = DATA.replace("L52\nN1320 P1 R500000\n", "L75\nN1 T1 R5.\n");
    let (run, text) = edit(&program, "fanuc-mill", "inch");
    assert_eq!(run.code, 0, "{run}");
    assert!(text.contains("G20") && text.contains("G10 L75\nN1 T1 R5.\n"), "{text}");
}

#[test]
fn rows_of_a_loop_keep_their_numbers() {
    changes(
        "O1\nG21 G17 G90 G94 G54\n#1=1320\nWHILE [#1 LT 1323] DO1\nN5 G10 L50\nN#1 P1 R[#1*2]\nN7 G11\n#1=#1+1\nEND1\nG0 X1.\nM30\n",
        "fanuc-mill",
        "unroll-loop",
        &expect![[r#"
             4 G10 L50
             5 N1320 P1 R2640
             6 G11
             7 G10 L50
             8 N1321 P1 R2642
             9 G11
            10 G10 L50
            11 N1322 P1 R2644
            12 G11
            13 G0 X1.
            14 M30
            ! part.nc: changed for fanuc-mill: every move is as before, within 0.001 mm (1 move compared)
            exit 0
        "#]],
    );
}

#[test]
fn dry_runs_write_nothing() {
    let shop = Shop::with(&[("part.nc", PART)]);
    let command = "edit scale-feeds 0.8 part.nc --control haas-mill -q";
    expect![[r#"
        --- a/part.nc
        +++ b/part.nc
        @@ -5,8 +5,8 @@
         S4000 M3
         G0 X-10. Y-10.
         G43 H1 Z10.
        -G1 Z-2. F300.
        -G41 D1 X0. Y0. F800.
        +G1 Z-2. F240.
        +G41 D1 X0. Y0. F640.
         Y40.
         G2 X10. Y50. I10. J0.
         G1 X60.
        @@ -19,7 +19,7 @@
         S2000 M3
         G0 X10. Y10.
         G43 H2 Z10.
        -G99 G83 X10. Y10. Z-12. R2. Q4. F120.
        +G99 G83 X10. Y10. Z-12. R2. Q4. F96.
         X50.
         G80
         G91 G28 Z0. M5
        exit 1
    "#]]
    .assert_eq(&shop.gcheck(&format!("{command} --diff")).to_string());
    expect![[r#"
        part.nc
        exit 1
    "#]]
    .assert_eq(&shop.gcheck(&format!("{command} --check")).to_string());
    assert_eq!(shop.read("part.nc"), PART);
    assert_eq!(shop.gcheck("edit scale-feeds 1 part.nc --control haas-mill --check").code, 0);
}

#[test]
fn standard_input_becomes_standard_output() {
    let shop = Shop::new();
    let program = "%\nO1\nG21 G17 G90 G54 G40 G80\nG0 X0. Y0. Z5.\nG1 Z-1. F100.\nM30\n%\n";
    let run = shop.gcheck_reading("edit translate --z 1 - --control haas-mill -q", program.as_bytes());
    expect![[r#"
        %
        O1
        G21 G17 G90 G54 G40 G80
        G0 X0. Y0. Z6.
        G1 Z0. F100.
        M30
        %
        exit 0
    "#]]
    .assert_eq(&run.to_string());
}

#[test]
fn line_ends_and_strange_bytes_stay() {
    let program = b"%\r\nO1 (Fr\xE4sen)\r\nG21 G17 G90 G54 G40 G80\r\nG0 X0. Y0. Z5. (\xE4)\r\nG1 Z-1. F100.\r\nM30\r\n%\r\n";
    let shop = Shop::new();
    shop.file("part.nc", program);
    assert_eq!(shop.gcheck("edit translate --x 1 part.nc --control haas-mill").code, 0);
    let after: Vec<u8> = std::fs::read(shop.path("part.nc")).unwrap();
    let expected: Vec<u8> =
        b"%\r\nO1 (Fr\xE4sen)\r\nG21 G17 G90 G54 G40 G80\r\nG0 X1. Y0. Z5. (\xE4)\r\nG1 Z-1. F100.\r\nM30\r\n%\r\n".to_vec();
    assert_eq!(after, expected);
}

// What is refused.

#[test]
fn a_program_that_does_not_run_to_its_end_is_not_changed() {
    let head = "%\nO1\nG21 G17 G90 G54 G40 G80\nG0 X0. Y0. Z5.\n";
    refuses(
        &format!("{head}IF [#500 EQ 1] GOTO 9\nG1 Z-1. F100.\nN9 M30\n%\n"),
        "haas-mill",
        "translate --x 1",
        &expect![[r#"
        error: part.nc:5:1: what happens next depends on `#500`, and its value is not known
          |
        5 | IF [#500 EQ 1] GOTO 9
          | ^^^^^^^^^^^^^^^^^^^^^
          note: nothing is proved of a run that ends early, so gcheck cannot shift the path
          help: give the value: `--set '#500=1'`, or `[variables]`, `[offsets]`, `[tools]` in gcheck.toml
        part.nc: nothing is changed
    "#]],
    );
    refuses(
        &format!("{head}G1 Z-1.\nM30\n%\n"),
        "haas-mill",
        "translate --x 1",
        &expect![[r#"
        error: part.nc:5:1: a cut without a feed rate
          |
        5 | G1 Z-1.
          | ^^^^^^^
          note: nothing is proved of a run that ends early, so gcheck cannot shift the path
          help: give `F` on this block or before it
        part.nc: nothing is changed
    "#]],
    );
    refuses(
        &format!("{head}G1 Z-1. F100.\n"),
        "haas-mill",
        "translate --x 1",
        &expect![[r#"
        error: part.nc:5:14: the program ends without an end of program
          |
        5 | G1 Z-1. F100.
          |              ^
          note: nothing is proved of a run that ends early, so gcheck cannot shift the path
          help: write `M2` or `M30` at its end, or `%` around it
        part.nc: nothing is changed
    "#]],
    );
    refuses(
        &format!("{head}N1 G1 Z-1. F100.\nGOTO 1\nM30\n%\n"),
        "haas-mill",
        "translate --x 1 --fuel 1000",
        &expect![[r#"
        error: part.nc:6:1: the program had not ended after 1000 blocks; here gcheck stopped executing it
          |
        6 | GOTO 1
          | ^^^^^^
          note: nothing is proved of a run that ends early, so gcheck cannot shift the path
          help: `--fuel BLOCKS` allows more
        part.nc: nothing is changed
    "#]],
    );
    refuses(
        &format!("{head}M98 P9123\nM30\n%\n"),
        "haas-mill",
        "translate --x 1",
        &expect![[r#"
        error: part.nc: cannot shift the path: the proof would have a gap, as what program 9123 does is not known: it was not found
        part.nc: nothing is changed
    "#]],
    );
}

#[test]
fn a_block_that_does_not_run_is_not_changed() {
    let program =
        "%\nO1\nG21 G17 G90 G54 G40 G80\n#1=1\nIF [#1 EQ 1] GOTO 9\nG0 X5. Z5.\nN9 G0 X0. Y0. Z5.\nM30\n%\n";
    refuses(
        program,
        "haas-mill",
        "translate --x 1",
        &expect![[r#"
        error: part.nc:6:1: cannot shift the path: the run does not come to this block, so what its words do is not proved
          |
        6 | G0 X5. Z5.
          | ^^^^^^^^^^
          help: select lines that run, or set the variables that lead here with --set
        part.nc: nothing is changed
    "#]],
    );
}

#[test]
fn modes_that_put_words_elsewhere() {
    let head = "%\nO1\nG21 G17 G90 G54 G40 G80\nG0 X0. Y0. Z5.\n";
    refuses(
        &format!("{head}G68 X0. Y0. R30.\nG0 X10. Y0.\nG69\nM30\n%\n"),
        "fanuc-mill",
        "translate --x 1",
        &expect![[r#"
        error: part.nc:5:1: cannot shift the path: a rotation or mirror of the coordinates begins here, and words do not say places under it
          |
        5 | G68 X0. Y0. R30.
          | ^^^^^^^^^^^^^^^^
        part.nc: nothing is changed
    "#]],
    );
    refuses(
        &format!("{head}G51 X0. Y0. Z0. P2.\nG0 X10. Y0.\nG50\nM30\n%\n"),
        "haas-mill",
        "translate --x 1",
        &expect![[r#"
        error: part.nc:5:1: cannot shift the path: a scaling begins here, and words do not say places under it
          |
        5 | G51 X0. Y0. Z0. P2.
          | ^^^^^^^^^^^^^^^^^^^
        part.nc: nothing is changed
    "#]],
    );
    refuses(
        &format!("{head}G92 X5. Y0.\nG0 X10. Y0.\nM30\n%\n"),
        "haas-mill",
        "translate --x 1",
        &expect![[r#"
        error: part.nc:5:1: cannot shift the path: this block moves the zero of the program to or from where the tool is, and the tool is somewhere else then
          |
        5 | G92 X5. Y0.
          | ^^^^^^^^^^^
        part.nc: nothing is changed
    "#]],
    );
    refuses(
        &format!("{head}G52 X5. Y0.\nG0 X10. Y0.\nG52 X0. Y0.\nM30\n%\n"),
        "haas-mill",
        "mirror X",
        &expect![[r#"
        error: part.nc:5:1: cannot mirror the path: this block shifts the zero of the program, and the shift is not turned with it
          |
        5 | G52 X5. Y0.
          | ^^^^^^^^^^^
        part.nc: nothing is changed
    "#]],
    );
    changes(
        &format!("{head}G52 X5. Y0.\nG0 X10. Y0.\nG52 X0. Y0.\nM30\n%\n"),
        "haas-mill",
        "translate --x 1",
        &expect![[r#"
         4 G0 X1. Y0. Z5.
         6 G0 X11. Y0.
        ! part.nc: changed for haas-mill: every move is shifted by X1, within 0.001 mm (2 moves compared)
        exit 0
    "#]],
    );
}

#[test]
fn a_selection_that_begins_or_ends_in_the_middle_of_a_contour() {
    refuses(
        PART,
        "haas-mill",
        "translate --x 5 --lines 10-12",
        &expect![[r#"
        error: part.nc:10:1: cannot shift the path: this block cuts, and no block of the selection has given X
           |
        10 | Y40.
           | ^^^^
          help: begin the selection at the block that gives it, or before
        part.nc: nothing is changed
    "#]],
    );
    refuses(
        PART,
        "haas-mill",
        "translate --x 5 --y 5 --lines 6-12",
        &expect![[r#"
        error: part.nc:13:1: cannot shift the path: this block is not in the selection and goes on from a moved point: it does not give X as a coordinate
           |
        13 | Y0.
           | ^^^
          help: end the selection where the next block gives all moved axes, or extend it
        part.nc: nothing is changed
    "#]],
    );
    refuses(
        PART,
        "haas-mill",
        "rotate 90 --lines 12-15",
        &expect![[r#"
        error: part.nc:12:1: cannot rotate the path: this block needs X and Y to be rotated, and no block of the selection has given Y
           |
        12 | G1 X60.
           | ^^^^^^^
          help: begin the selection at the block that gives it, or before
        part.nc: nothing is changed
    "#]],
    );
    let program = "%\nO1\nG21 G17 G90 G54 G40 G80\nG0 X0. Y0. Z5.\nG1 X10. F100.\nG2 X20. Y10. I10.\nG1 X0. Y0.\nM30\n%\n";
    refuses(
        program,
        "haas-mill",
        "translate --x 5 --lines 6",
        &expect![[r#"
        error: part.nc:6:1: cannot shift the path: the arc of this block does not move as a whole: its start and its end are not both in the selection, or its plane becomes another one
          |
        6 | G2 X20. Y10. I10.
          | ^^^^^^^^^^^^^^^^^
        part.nc: nothing is changed
    "#]],
    );
}

#[test]
fn a_block_with_two_meanings() {
    let program = "%\nO1\nG21 G17 G90 G54 G40 G80\nG0 X0. Y0. Z5.\nM97 P50\nG91\nM97 P50\nG90\nM30\nN50 G0 X5. Y5.\nM99\n%\n";
    refuses(
        program,
        "haas-mill",
        "translate --x 1",
        &expect![[r#"
        error: part.nc:10:1: cannot shift the path: this block runs more than once, under different modes, so its words mean different places
           |
        10 | N50 G0 X5. Y5.
           | ^^^^^^^^^^^^^^
        part.nc: nothing is changed
    "#]],
    );
}

#[test]
fn a_program_in_another_file_that_goes_to_places() {
    let shop = Shop::with(&[
        ("part.nc", "%\nO1\nG21 G17 G90 G54 G40 G80\nG0 X0. Y0. Z5.\nM98 P2000\nM30\n%\n"),
        ("O2000.nc", "%\nO2000\nG1 X10. F100.\nM99\n%\n"),
    ]);
    let run = shop.gcheck("edit translate --x 1 --y 1 part.nc --control haas-mill");
    assert_eq!(run.code, 2);
    expect![[r#"
        error: O2000.nc:3:1: cannot shift the path: this block gives places, and it is in another file, which stays as it is
          |
        3 | G1 X10. F100.
          | ^^^^^^^^^^^^^
          help: change that file as well, or select the lines of this one that go with the change
        part.nc: nothing is changed
    "#]].assert_eq(&run.stderr);
    shop.file("O2000.nc", "%\nO2000\nG91 G1 X10. F100.\nG90\nM99\n%\n");
    assert_eq!(shop.gcheck("edit translate --x 1 --y 1 part.nc --control haas-mill").code, 0);
}

#[test]
fn a_rotation_of_arcs_in_other_planes() {
    let program = "%\nO1\nG21 G18 G90 G54 G40 G80\nG0 X0. Y0. Z5.\nG2 X10. Z-5. K-10. F100.\nM30\n%\n";
    refuses(
        program,
        "haas-mill",
        "rotate 90",
        &expect![[r#"
        error: part.nc:5:1: cannot rotate the path: the arc of this block does not move as a whole: its start and its end are not both in the selection, or its plane becomes another one
          |
        5 | G2 X10. Z-5. K-10. F100.
          | ^^^^^^^^^^^^^^^^^^^^^^^^
        part.nc: nothing is changed
    "#]],
    );
}

#[test]
fn factors_that_cannot_be_written() {
    let program = "%\nO1\nG21 G17 G90 G54 G40 G80\nG0 X0. Y0. Z5. S7 M3\nG1 Z-1. F100.\nM30\n%\n";
    refuses(
        program,
        "haas-mill",
        "scale-speeds 1.1",
        &expect![[r#"
        error: part.nc:4:17: cannot scale the spindle speeds: the new value is 7.7000, and rounded to the digits that can be written it is 8
          |
        4 | G0 X0. Y0. Z5. S7 M3
          |                 ^
          help: choose another factor
        part.nc: nothing is changed
    "#]],
    );
}

#[test]
fn a_proof_that_fails_shows_where() {
    // The program looks where the tool is, so that another place makes it do something else.
    let program = "%\nO1\nG21 G17 G90 G54 G40 G80\nG0 X0. Y0. Z5.\nG0 X10.\nIF [#5041 GT 10.5] GOTO 8\nG1 Y5. F100.\nN8 G0 Z9.\nM30\n%\n";
    refuses(
        program,
        "haas-mill",
        "translate --x 1",
        &expect![[r#"
        error: part.nc: cannot shift the path: the proof failed
        the paths part at X11 Y0 Z5
          - part.nc:7  to X11 Y5 Z5   | G1 Y5. F100.
          + part.nc (changed):8  to X11 Y0 Z9   | N8 G0 Z9.
          note: `-` is what the change promises, `+` is what the changed program does
        part.nc: nothing is changed
    "#]],
    );
}

#[test]
fn usage() {
    let shop = Shop::with(&[("part.nc", PART)]);
    for (arguments, expected) in [
        (
            "edit translate part.nc",
            expect![[r#"
            error: a shift needs a length that is not zero
              help: write, for example, `gcheck edit translate --x 10 part.nc`
        "#]],
        ),
        (
            "edit scale-feeds 0 part.nc",
            expect![[r#"
            error: invalid value '0' for '<FACTOR>': write a factor above zero, such as 0.8 or 80%

            For more information, try '--help'.
        "#]],
        ),
        (
            "edit scale-feeds 80 part.nc",
            expect![[r#"
                error: invalid value '80' for '<FACTOR>': that is 80 times as fast; write 80% if you mean percent

                For more information, try '--help'.
            "#]],
        ),
        (
            "edit scale-speeds 5000% part.nc",
            expect![[r#"
                error: invalid value '5000%' for '<FACTOR>': a factor is 10 or less, which is 1000%

                For more information, try '--help'.
            "#]],
        ),
        (
            "edit mirror x part.nc --tool 99",
            expect![[r#"
                error: part.nc: cannot mirror the path: no block is known to run with T99
                part.nc: nothing is changed
            "#]],
        ),
        (
            "edit rotate 45 part.nc",
            expect![[r#"
            error: invalid value '45' for '<DEGREES>'
              [possible values: 90, 180, 270]

            For more information, try '--help'.
        "#]],
        ),
        (
            "edit translate --x ten part.nc",
            expect![[r#"
            error: invalid value 'ten' for '--x <LENGTH>': write a length such as 10, -2.5, 10mm or 0.5in

            For more information, try '--help'.
        "#]],
        ),
        (
            "edit mirror x part.nc --lines 9-3",
            expect![[r#"
            error: invalid value '9-3' for '--lines <A-B>': write the first and the last line, counted from 1, such as 12-40

            For more information, try '--help'.
        "#]],
        ),
        (
            "edit mirror x part.nc --lines 90",
            expect![[r#"
            error: part.nc: has 27 lines; line 90 does not exist
        "#]],
        ),
        (
            "edit mirror x none.nc",
            expect![[r#"
            error: none.nc: cannot read: no such file or directory
        "#]],
        ),
    ] {
        let run = shop.gcheck(&format!("{arguments} --control haas-mill"));
        assert_eq!(run.code, 2);
        expected.assert_eq(&run.stderr);
    }
    assert_eq!(shop.read("part.nc"), PART);
}

// The same moves, written otherwise.

#[test]
fn cycles_become_plain_moves() {
    changes(
        PART,
        "haas-mill",
        "expand-cycle",
        &expect![[r#"
            22 G99
            23 G0 Z2.
            24 G1 Z-2. F120.
            25 G0 Z2.
            26 G0 Z0.54
            27 G1 Z-6.
            28 G0 Z2.
            29 G0 Z-3.46
            30 G1 Z-10.
            31 G0 Z2.
            32 G0 Z-7.46
            33 G1 Z-12.
            34 G0 Z2.
            35 G0 X50.
            36 G1 Z-2.
            37 G0 Z2.
            38 G0 Z0.54
            39 G1 Z-6.
            40 G0 Z2.
            41 G0 Z-3.46
            42 G1 Z-10.
            43 G0 Z2.
            44 G0 Z-7.46
            45 G1 Z-12.
            46 G0 Z2.
            47 G80
            48 G91 G28 Z0. M5
            49 M30
            50 %
            ! part.nc: changed for haas-mill: every move is as before, within 0.001 mm (39 moves compared)
            ! note: the size of cutter 1 is not known; the proof takes a radius of 0.01 mm
            exit 0
        "#]],
    );
}

#[test]
fn cycles_become_plain_moves_in_the_hand_of_the_writer() {
    let program = "%\r\nO1\r\nG21G17G90G54G40G80\r\nG00X0.Y0.Z10.\r\nN5G98G82X1.Y2.Z-6.R2.P500F100.(SPOT)\r\nN6X5.\r\nG91X3.L2\r\nG90G80\r\nG00Z50.\r\nM30\r\n%\r\n";
    changes(
        program,
        "haas-mill",
        "expand-cycle",
        &expect![[r#"
         5 N5G98 (SPOT)
         6 G00X1.Y2.
         7 G00Z2.
         8 G01Z-6.F100.
         9 G04P0.5
        10 G00Z10.
        11 N6G00X5.
        12 G00Z2.
        13 G01Z-6.
        14 G04P0.5
        15 G00Z10.
        16 G91
        17 G00X3.
        18 G00Z-8.
        19 G01Z-8.
        20 G04P0.5
        21 G00Z16.
        22 G00X3.
        23 G00Z-8.
        24 G01Z-8.
        25 G04P0.5
        26 G00Z16.
        27 G90G80
        28 G00Z50.
        29 M30
        30 %
        ! part.nc: changed for haas-mill: every move is as before, within 0.001 mm (18 moves compared)
        exit 0
    "#]],
    );
    let program = "G20 G90 G17 G40 G80\nG0 X0 Y0 Z1\nG98 G82 X1 Y2 Z-.6 R.2 P0.5 F10\nX3\nG80\nG0 Z5\nM2\n";
    changes(
        program,
        "linuxcnc",
        "expand-cycle",
        &expect![[r#"
             3 G98
             4 G61
             5 G0 X1. Y2.
             6 G0 Z.2
             7 G1 Z-.6 F10
             8 G4 P.5
             9 G0 Z1.
            10 G0 X3.
            11 G0 Z.2
            12 G1 Z-.6
            13 G4 P.5
            14 G0 Z1.
            15 G64
            16 G80
            17 G0 Z5
            18 M2
            ! part.nc: changed for linuxcnc: every move is as before, within 0.001 mm (10 moves compared)
            exit 0
        "#]],
    );
}

#[test]
fn cycles_that_are_more_than_moves_stay() {
    let head = "%\nO1\nG21 G17 G90 G94 G54 G40 G80\nT3 M6\nS500 M3\nG0 X0. Y0.\nG43 H3 Z5.\n";
    refuses(
        &format!("{head}G84 Z-10. R2. F500.\nG80\nG0 Z50.\nM30\n%\n"),
        "haas-mill",
        "expand-cycle",
        &expect![[r#"
        error: part.nc:8:1: cannot write the cycle as moves: this cycle is more than moves and dwells: it taps, or stops and turns the spindle
          |
        8 | G84 Z-10. R2. F500.
          | ^^^^^^^^^^^^^^^^^^^
        part.nc: nothing is changed
    "#]],
    );
    refuses(
        &format!("{head}/G81 Z-10. R2. F500.\nG80\nG0 Z50.\nM30\n%\n"),
        "haas-mill",
        "expand-cycle",
        &expect![[r#"
        error: part.nc:8:1: cannot write the cycle as moves: this block has a condition or a `/`, which its moves would need one by one
          |
        8 | /G81 Z-10. R2. F500.
          | ^^^^^^^^^^^^^^^^^^^^
        part.nc: nothing is changed
    "#]],
    );
    refuses(
        &format!("{head}G81 Z-10. R2. F500.\nX5.\nX10.\nG80\nG0 Z50.\nM30\n%\n"),
        "haas-mill",
        "expand-cycle --lines 8",
        &expect![[r#"
        error: part.nc: cannot write the cycle as moves: the proof failed
        the paths part at X5 Y0 Z5
          - part.nc:9  to X5 Y0 Z2   | X5.
          + part.nc (changed):12  to X10 Y0 Z5   | X10.
          note: `-` is what the change promises, `+` is what the changed program does
        part.nc: nothing is changed
    "#]],
    );
}

#[test]
fn drilled_holes_become_a_cycle() {
    changes(
        "%\nO1\nG21 G17 G90 G94 G54 G40 G80\nT1 M6\nS2000 M3\nG0 X10. Y10. M8\nG43 H1 Z25.\n(FIRST ROW)\nG0 Z2.\nG1 Z-12. F120. (DEEP)\nG0 Z2.\nG0 X50.\nG1 Z-12.\nG0 Z2.\n(SECOND ROW)\nG0 X50. Y30.\nG1 Z-8. F90.\nG0 Z25.\nX0. Y0.\nM30\n%\n",
        "haas-mill",
        "fold-cycle",
        &expect![[r#"
             9 G99 G81 X10. Y10. Z-12. R2. F120. (DEEP)
            10 X50.
            11 (SECOND ROW)
            12 G98 Y30. Z-8. R2. F90.
            13 G80
            14 G0 X0. Y0.
            15 M30
            16 %
            ! part.nc: changed for haas-mill: every move is as before, within 0.001 mm (12 moves compared)
            exit 0
        "#]],
    );
}

#[test]
fn pecks_and_dwells_become_words_of_a_cycle() {
    let head = "%\nO1\nG21 G17 G90 G94 G54 G40 G80\nT1 M6\nS2000 M3\nG43 H1 Z25.\n";
    let pecks = "G0 X10. Y10.\nG0 Z2.\nG1 Z-3. F120.\nG0 Z2.\nG0 Z-2.\nG1 Z-8.\nG0 Z2.\nG0 Z-7.\nG1 Z-11.\nG4 P500\nG0 Z25.\nM30\n%\n";
    changes(
        &format!("{head}{pecks}"),
        "fanuc-mill",
        "fold-cycle",
        &expect![[r#"
             7 G98 G83 X10. Y10. Z-11. R2. Q5. P500 F120.
             8 G80
             9 M30
            10 %
            ! part.nc: changed for fanuc-mill: every move is as before, within 0.001 mm (11 moves compared)
            ! note: a parameter of the control decides how far G83 backs off between pecks; the proof takes 1 mm
            exit 0
        "#]],
    );
    let chips = "G0 X10. Y10.\nZ2.\nG1 Z-3. F120.\nG0 Z-2.\nG1 Z-8.\nG0 Z-7.\nG1 Z-11.\nG0 Z2.\nG1 Z-3.\nG0 X20.\nM30\n%\n";
    changes(
        &format!("{head}{chips}"),
        "fanuc-mill",
        "fold-cycle",
        &expect![[r#"
             7 G99 G73 X10. Y10. Z-11. R2. Q5. F120.
             8 G80
             9 G1 Z-3.
            10 G0 X20.
            11 M30
            12 %
            ! part.nc: changed for fanuc-mill: every move is as before, within 0.001 mm (11 moves compared)
            ! note: a parameter of the control decides how far G73 backs off between pecks; the proof takes 1 mm
            exit 0
        "#]],
    );
    let bores = "G0 X10. Y10.\nZ2.\nG1 Z-3. F120.\nG1 Z2.\nG0 X20.\nG1 Z-3.\nZ2.\nM30\n%\n";
    changes(
        &format!("{head}{bores}"),
        "fanuc-mill",
        "fold-cycle",
        &expect![[r#"
         7 G99 G85 X10. Y10. Z-3. R2. F120.
         8 X20.
         9 G80
        10 M30
        11 %
        ! part.nc: changed for fanuc-mill: every move is as before, within 0.001 mm (8 moves compared)
        exit 0
    "#]],
    );
    let dwells = "G0 X10. Y10.\nZ2.\nG1 Z-3. F120.\nG4 P250\nG0 Z25.\nG0 X20.\nZ2.\nG1 Z-3.\nG4 P250\nG0 Z25.\nM30\n%\n";
    changes(
        &format!("{head}{dwells}"),
        "fanuc-mill",
        "fold-cycle",
        &expect![[r#"
         7 G98 G82 X10. Y10. Z-3. R2. P250 F120.
         8 X20.
         9 G80
        10 M30
        11 %
        ! part.nc: changed for fanuc-mill: every move is as before, within 0.001 mm (9 moves compared)
        exit 0
    "#]],
    );
}

#[test]
fn increments_numbers_and_the_return_level_of_other_cycles_stay() {
    changes(
        "O1\nN10G21G17G90G94G54G40G80\nN12G00X0.Y0.Z10.\nN15G99G81X1.Y1.Z-1.R1.F50.\nN20G80\nN25G00X0.Y0.Z10.\nN30G91\nN35G00X5.\nN40Z-8.\nN45G01Z-6.F80.\nN50G00Z14.\nN55X5.\nN60Z-8.\nN65G01Z-6.\nN70G00Z14.\nN75X3.\nN80G90G81X40.Y0.Z-1.R1.\nN85G80\nN90M30\n",
        "haas-mill",
        "fold-cycle",
        &expect![[r#"
             8 N35G98G81X5.Z-6.R-8.F80.
             9 N55X5.
            10 N70G80G99
            11 N75G00X3.
            12 N80G90G81X40.Y0.Z-1.R1.
            13 N85G80
            14 N90M30
            ! part.nc: changed for haas-mill: every move is as before, within 0.001 mm (19 moves compared)
            exit 0
        "#]],
    );
    changes(
        "G20 G90 G17 G40 G80 G61\nG0 X0 Y0 Z1\nX1\nZ.1\nG91 G1 Z-.6 F10\nG90 G0 Z1\nX2\nZ.1\nG91 G1 Z-.6\nG90 G0 Z1\nX3\nM2\n",
        "linuxcnc",
        "fold-cycle",
        &expect![[r#"
             3 G98 G81 X1. Y0. Z-.5 R.1 F10
             4 X2.
             5 G80
             6 G0 X3
             7 M2
            ! part.nc: changed for linuxcnc: every move is as before, within 0.001 mm (10 moves compared)
            exit 0
        "#]],
    );
}

#[test]
fn a_lathe_drills_on_its_axis() {
    changes(
        "O1\nG21 G97 G99 G18\nT0101\nS800 M3\nG0 X0. Z5.\nZ2.\nG1 Z-5. F0.1\nG0 Z2.\nG0 Z-2.46\nG1 Z-12.\nG0 Z2.\nG0 Z-9.46\nG1 Z-15.\nG0 Z5.\nG0 X50. Z50.\nM30\n",
        "haas-lathe",
        "fold-cycle",
        &expect![[r#"
             6 G83 X0. Z-15. R2. Q7. F0.1
             7 G80
             8 G0 X50. Z50.
             9 M30
            ! part.nc: changed for haas-lathe: every move is as before, within 0.001 mm (11 moves compared)
            ! note: a parameter of the control decides how far G83 backs off between pecks; the proof takes 2.54 mm
            exit 0
        "#]],
    );
}

#[test]
fn holes_that_no_cycle_makes_in_this_way_stay() {
    let head = "%\nO1\nG21 G17 G90 G94 G54 G40 G80\nT1 M6\nS2000 M3\nG0 X10. Y10.\nG43 H1 Z25.\n";
    let pecks = "Z2.\nG1 Z-3. F120.\nG0 Z2.\nG0 Z-2.\nG1 Z-8.\nG0 Z25.\nM30\n%\n";
    refuses(
        &format!("{head}{pecks}"),
        "haas-mill",
        "fold-cycle",
        &expect![[r#"
        error: part.nc:9:1: cannot write the moves as a cycle: after a peck the tool goes in at rapid to 1 mm above the last depth here, and to 2.54 mm in G83 of this control, as long as setting 22 is not given
          |
        9 | G1 Z-3. F120.
          | ^^^^^^^^^^^^^
          help: give setting 22 of the machine in `[settings]` of `gcheck.toml`, if it is 1 mm
        part.nc: nothing is changed
    "#]],
    );
    let fed = "Z2.\nG1 Z-3. F120.\nG0 Z2.\nG1 Z-8.\nG0 Z25.\nM30\n%\n";
    refuses(
        &format!("{head}{fed}"),
        "fanuc-mill",
        "fold-cycle",
        &expect![[r#"
        error: part.nc:9:1: cannot write the moves as a cycle: each peck is fed from R on here, and G83 of this control goes in at rapid to 1 mm above the last depth
          |
        9 | G1 Z-3. F120.
          | ^^^^^^^^^^^^^
        part.nc: nothing is changed
    "#]],
    );
    let chips = "Z2.\nG1 Z-3. F120.\nG0 Z-2.5\nG1 Z-8.\nG0 Z25.\nM30\n%\n";
    refuses(
        &format!("{head}{chips}"),
        "fanuc-mill",
        "fold-cycle",
        &expect![[r#"
        error: part.nc:9:1: cannot write the moves as a cycle: after a peck the tool backs off by 0.5 mm here, and by 1 mm in G73 of this control
          |
        9 | G1 Z-3. F120.
          | ^^^^^^^^^^^^^
        part.nc: nothing is changed
    "#]],
    );
    let feeds = "Z2.\nG1 Z-3. F120.\nG1 Z2. F500.\nG0 X30.\nG1 Z-3. F120.\nG1 Z2. F500.\nG0 Z25.\nM30\n%\n";
    refuses(
        &format!("{head}{feeds}"),
        "fanuc-mill",
        "fold-cycle",
        &expect![[r#"
        error: part.nc:9:1: cannot write the moves as a cycle: the feed changes within this hole, and a cycle has one
          |
        9 | G1 Z-3. F120.
          | ^^^^^^^^^^^^^
        part.nc: nothing is changed
    "#]],
    );
    let taps = "Z2.\nG1 Z-3. F500.\nM4\nG1 Z2.\nM3\nG0 X30.\nG1 Z-3.\nM4\nG1 Z2.\nM3\nG0 Z25.\nM30\n%\n";
    refuses(
        &format!("{head}{taps}"),
        "fanuc-mill",
        "fold-cycle",
        &expect![[r#"
        error: part.nc:10:1: cannot write the moves as a cycle: these moves tap at the feed of the program, and G84 of this control ties the feed to the spindle and ignores the overrides
           |
        10 | M4
           | ^^
          help: write the tap by hand, and compare with `gcheck diff`
        part.nc: nothing is changed
    "#]],
    );
    let blended = "G21 G90 G17 G64\nG0 X0 Y0 Z10\nZ2\nG1 Z-3 F100\nG0 Z2\nX10\nG1 Z-3\nG0 Z2\nZ10\nM2\n";
    refuses(
        blended,
        "linuxcnc",
        "fold-cycle",
        &expect![[r#"
        error: part.nc:3:1: cannot write the moves as a cycle: G81 of this control passes its points exactly (G61), and these moves may round their corners
          |
        3 | Z2
          | ^^
          help: switch exact path (G61) on before these moves
        part.nc: nothing is changed
    "#]],
    );
}

#[test]
fn a_hole_with_too_many_pecks_stays_whole() {
    let program = |pecks: usize| {
        let mut text = "O1\nG21 G17 G90 G94 G54\nG0 X0. Y0. Z25.\nZ2.\nG1 Z-1. F100.\n".to_owned();
        for peck in 1..pecks {
            let depth = 1 + 3 * peck;
            let _ = writeln!(text, "G0 Z-{}.\nG1 Z-{depth}.", depth - 4);
        }
        text + "G0 Z2.\nG0 X10.\nM30\n"
    };
    let (run, text) = edit(&program(500), "fanuc-mill", "fold-cycle");
    assert!(text.contains("G73 X0. Y0. Z-1498. R2. Q3."), "{text} {}", run.stderr);
    for pecks in [512, 513, 514, 700, 1030] {
        let (run, text) = edit(&program(pecks), "fanuc-mill", "fold-cycle");
        assert_eq!(text, program(pecks), "{}", run.stderr);
    }
}

#[test]
fn what_is_not_drilled_again_and_again_stays() {
    let program = |moves: &str| format!("O1\nG21 G17 G90 G94 G54\nG0 X0. Y0. Z25.\n{moves}G0 Z25.\nM30\n");
    let same = |moves: &str, arguments: &str| {
        let (run, text) = edit(&program(moves), "fanuc-mill", arguments);
        assert_eq!(text, program(moves), "{}", run.stderr);
        assert!(run.stderr.contains("there is nothing to change"), "{}", run.stderr);
    };
    let twice = "G0 Z2.\nG1 Z-3. F100.\nG0 Z2.\nG0 X10.\nG1 Z-3.\nG0 Z2.\n";
    let (_, text) = edit(&program(twice), "fanuc-mill", "fold-cycle");
    assert!(text.contains("G99 G81 X0. Y0. Z-3. R2. F100.\nG98 X10.\nG80\n"), "{text}");
    same("G0 Z2.\nG1 Z-3. F100.\nG0 Z2.\n", "fold-cycle");
    same("G0 Z2.\nG1 Z-3. F100.\nG1 X10.\nG0 Z2.\nX20.\nG1 Z-3.\nX30.\nG0 Z2.\n", "fold-cycle");
    same(&twice.replace("G0 X10.", "G0 X10. M8"), "fold-cycle");
    same(&twice.replace("G0 X10.", "/G0 X10."), "fold-cycle");
    same(&twice.replace("G0 X10.", "#1=10.\nG0 X#1"), "fold-cycle");
    same(twice, "fold-cycle --lines 4-6");
    same(&format!("#1=1\n{}IF [#1 GT 5] GOTO 7\n", twice.replace("G0 X10.", "N7 G0 X10.")), "fold-cycle");
}

#[test]
fn loops_become_their_turns() {
    let program = "%\nO1\nG21 G17 G90 G54 G40 G80\n#1=0\nG0 X0. Y0. Z5.\nWHILE [#1 LT 3] DO1\nN20 G0 X[#1*10.] Y#1 (ROW)\nG1 Z-[1.+#1/3] F[100.+#1]\nG0 Z5.\n#1=#1+1\nEND1\nG0 X[#1*20.]\nM30\n%\n";
    changes(
        program,
        "fanuc-mill",
        "unroll-loop",
        &expect![[r#"
         6 G0 X0. Y0. (ROW)
         7 G1 Z-1. F100.
         8 G0 Z5.
         9 G0 X10. Y1. (ROW)
        10 G1 Z-1.333 F101.
        11 G0 Z5.
        12 G0 X20. Y2. (ROW)
        13 G1 Z-1.667 F102.
        14 G0 Z5.
        15 #1=3.
        16 G0 X[#1*20.]
        17 M30
        18 %
        ! part.nc: changed for fanuc-mill: every move is as before, within 0.001 mm (10 moves compared)
        exit 0
    "#]],
    );
    let program = "G21 G17 G90 G54 G40\nG0 X0 Y0 Z5\n#<n>=0\no1 while [#<n> lt 2]\n  #2=0\n  o2 repeat [2]\n    G0 X[#<n>*10] Y[#2*5]\n    #2=[#2+1]\n  o2 endrepeat\n  #<n>=[#<n>+1]\no1 endwhile\nG0 Z9\nM2\n";
    changes(
        program,
        "linuxcnc",
        "unroll-loop",
        &expect![[r#"
         4 G0 X0 Y0
         5 G0 X0 Y5
         6 G0 X10 Y0
         7 G0 X10 Y5
         8 G0 Z9
         9 M2
        ! part.nc: changed for linuxcnc: every move is as before, within 0.001 mm (5 moves compared)
        exit 0
    "#]],
    );
}

#[test]
fn loops_whose_turns_are_not_certain_stay() {
    let head = "%\nO1\nG21 G17 G90 G54 G40 G80\n#1=0\nG0 X0. Y0. Z5.\nWHILE [#1 LT 3] DO1\n";
    let tail = "#1=#1+1\nEND1\nM30\n%\n";
    refuses(
        &format!("{head}/G0 X#1\n{tail}"),
        "fanuc-mill",
        "unroll-loop",
        &expect![[r#"
        error: part.nc:7:1: cannot unroll the loop: whether this block acts is decided in each turn by a condition or by block delete
          |
        7 | /G0 X#1
          | ^^^^^^^
          help: write the condition as a jump over the block
        part.nc: nothing is changed
    "#]],
    );
    refuses(
        &format!("{head}G0 X#500\n{tail}"),
        "fanuc-mill",
        "unroll-loop",
        &expect![[r#"
        error: part.nc:7:1: cannot unroll the loop: a word of this block has no value that is known
          |
        7 | G0 X#500
          | ^^^^^^^^
          help: give values with --set
        part.nc: nothing is changed
    "#]],
    );
    refuses(
        &format!("{head}DPRNT[A#1[30]]\n{tail}"),
        "fanuc-mill",
        "unroll-loop",
        &expect![[r#"
        error: part.nc:7:1: cannot unroll the loop: this block prints or commands something in each turn
          |
        7 | DPRNT[A#1[30]]
          | ^^^^^^^^^^^^^^
          help: select lines without it
        part.nc: nothing is changed
    "#]],
    );
    // A program that the loop calls reads what the loop counts.
    let program = format!("{head}M98 P50\n{tail}").replace("M30\n", "M30\nO50\nG0 X[#1*5.]\nM99\n");
    changes(
        &program,
        "fanuc-mill",
        "unroll-loop",
        &expect![[r#"
         6 M98 P50
         7 #1=#1+1
         8 M98 P50
         9 #1=#1+1
        10 M98 P50
        11 #1=#1+1
        12 M30
        13 O50
        14 G0 X[#1*5.]
        15 M99
        16 %
        ! part.nc: changed for fanuc-mill: every move is as before, within 0.001 mm (3 moves compared)
        exit 0
    "#]],
    );
}

const WAYS: &str = "%\nO1\nG21 G17 G90 G94 G54 G40 G80\nG0 X0. Y0. Z5.\nG1 Z-1. F100.\nX10. Y5.\nG2 X20. Y15. I10. (ARC)\nG0 Z5.\nG99 G81 X5. Y5. Z-6. R2. F80.\nX8.\nG80\nG53 Z0.\nG0 X1. Y1.\nM30\n%\n";

#[test]
fn absolute_coordinates_become_increments_and_come_back() {
    changes(
        WAYS,
        "fanuc-mill",
        "incremental --lines 6-10",
        &expect![[r#"
             6 G91 X10. Y5.
             7 G2 X10. Y10. I10. (ARC)
             8 G0 Z6.
             9 G99 G81 X-15. Y-10. Z-8. R-3. F80.
            10 X3.
            12 G90 G53 Z0.
            ! part.nc: changed for fanuc-mill: every move is as before, within 0.001 mm (14 moves compared)
            exit 0
        "#]],
    );
    let (_, text) = edit(WAYS, "fanuc-mill", "incremental --lines 6-10");
    changes(
        &text,
        "fanuc-mill",
        "absolute",
        &expect![[r#"
             6 G90 X10. Y5.
             7 G2 X20. Y15. I10. (ARC)
             8 G0 Z5.
             9 G99 G81 X5. Y5. Z-6. R2. F80.
            10 X8.
            ! part.nc: changed for fanuc-mill: every move is as before, within 0.001 mm (14 moves compared)
            exit 0
        "#]],
    );
    let (_, back) = edit(&text, "fanuc-mill", "absolute");
    let (run, _) = edit(&back, "fanuc-mill", "absolute");
    assert_eq!(run.stderr, "part.nc: there is nothing to change\n");
}

#[test]
fn increments_whose_begin_is_not_known_stay() {
    changes(
        "%\nO1\nG21 G17 G90 G54 G40 G80\nG0 X0. Z5.\nY5.\nX1. Y6.\nG43 H1 Z3.\nZ2.\nM30\n%\n",
        "fanuc-mill",
        "incremental",
        &expect![[r#"
             6 G91 X1. Y1.
             7 G90 G43 H1 Z3.
             8 G91 Z-1.
            ! part.nc: changed for fanuc-mill: every move is as before, within 0.001 mm (5 moves compared)
            exit 0
        "#]],
    );
    let program = "%\nO1\nG21 G17 G90 G54 G40 G80\nG0 X0. Y0. Z5.\nG91\nG99 G81 X5. Z-6. R-3. K3 F80.\nG80\nG90\nM30\n%\n";
    refuses(
        program,
        "fanuc-mill",
        "absolute",
        &expect![[r#"
        error: part.nc:6:1: cannot write absolute coordinates: this block repeats its cycle, which goes on by increments and stays at an absolute place
          |
        6 | G99 G81 X5. Z-6. R-3. K3 F80.
          | ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^
        part.nc: nothing is changed
    "#]],
    );
    let program =
        "%\nO1\nG21 G17 G90 G54 G40 G80\nG0 X0. Y0. Z5.\nM97 P50 L2\nM30\nN50 G91 X5.\nG90\nM99\n%\n";
    refuses(
        program,
        "haas-mill",
        "absolute",
        &expect![[r#"
        error: part.nc:7:1: cannot write absolute coordinates: this block runs more than once, from another point each time
          |
        7 | N50 G91 X5.
          | ^^^^^^^^^^^
        part.nc: nothing is changed
    "#]],
    );
}

#[test]
fn inches_become_millimetres() {
    let program = "%\nO1\nG20 G17 G90 G94 G54 G40 G80\nT1 M6\nS2500 M3\nG0 X1. Y-.5\nG43 H1 Z.1\nG1 Z-.05 F12.\nG2 X2. Y.5 I.0 J1.\nX2.5 Y1. R.5\nG0 Z.1\nG99 G83 X1. Y1. Z-.6 R.1 Q.125 F8.5\nG80\nG91 G28 Z0.\nM30\n%\n";
    changes(
        program,
        "haas-mill",
        "mm",
        &expect![[r#"
             3 G21 G17 G90 G94 G54 G40 G80
             6 G0 X25.4 Y-12.7
             7 G43 H1 Z2.54
             8 G1 Z-1.27 F304.8
             9 G2 X50.8 Y12.7 I0. J25.4
            10 X63.5 Y25.4 R12.7
            11 G0 Z2.54
            12 G99 G83 X25.4 Y25.4 Z-15.24 R2.54 Q3.175 F215.9
            ! part.nc: changed for haas-mill: every move is as before, within 0.001 mm (25 moves compared)
            exit 0
        "#]],
    );
    let program = "%\nO1\nG20 G18 G40 G99 G54\nT0101\nG96 S600 M3\nG0 X2. Z.1\nG1 X1.5 F.008\nZ-1.\nU.25 W-.1\nG0 X3.\nG28 U0. W0.\nM30\n%\n";
    changes(
        program,
        "fanuc-lathe",
        "mm",
        &expect![[r#"
         3 G21 G18 G40 G99 G54
         5 G96 S183 M3
         6 G0 X50.8 Z2.54
         7 G1 X38.1 F.2032
         8 Z-25.4
         9 U6.35 W-2.54
        10 G0 X76.2
        ! part.nc: changed for fanuc-lathe: every move is as before, within 0.001 mm (5 moves compared)
        exit 0
    "#]],
    );
}

#[test]
fn millimetres_become_inches_within_what_an_inch_resolves() {
    changes(
        WAYS,
        "haas-mill",
        "inch",
        &expect![[r#"
             3 G20 G17 G90 G94 G54 G40 G80
             4 G0 X0. Y0. Z0.1969
             5 G1 Z-0.0394 F3.937
             6 X0.3937 Y0.1969
             7 G2 X0.7874 Y0.5906 I0.3937 (ARC)
             8 G0 Z0.1969
             9 G99 G81 X0.1969 Y0.1969 Z-0.2362 R0.0787 F3.1496
            10 X0.315
            13 G0 X0.0394 Y0.0394
            ! part.nc: changed for haas-mill: every move is as before, within 0.002 mm (14 moves compared)
            exit 0
        "#]],
    );
    refuses(
        WAYS,
        "haas-mill",
        "inch --tolerance 0.0005",
        &expect![[r#"
            error: part.nc: cannot write the program in inches: the proof failed
            the paths part at X1.7341 Y2.3534 Z2.9727
              - part.nc:4  to X0 Y0 Z5   | G0 X0. Y0. Z5.
              + part.nc (changed):4  to X0 Y0 Z5.0013   | G0 X0. Y0. Z0.1969
              note: `-` is what the change promises, `+` is what the changed program does
              help: the last digit of an inch is 0.00254 mm, and roundings of increments and arcs add up: `--tolerance` allows more
            part.nc: nothing is changed
        "#]],
    );
    refuses(
        WAYS,
        "haas-mill",
        "inch --lines 6-7",
        &expect![[r#"
        error: a program is converted as a whole, as the feed and other words stay in effect from block to block
          help: leave out --lines and --tool
    "#]],
    );
    let program =
        "%\nO1\nG21 G17 G90 G54 G40 G80\nG0 X0. Y0. Z5.\nG65 P9100 A5.\nM30\nO9100\nG0 X#1\nM99\n%\n";
    refuses(
        program,
        "haas-mill",
        "inch",
        &expect![[r#"
        error: part.nc:5:1: cannot write the program in inches: the arguments of a macro may be lengths or not, so they are not converted
          |
        5 | G65 P9100 A5.
          | ^^^^^^^^^^^^^
        part.nc: nothing is changed
    "#]],
    );
}

#[test]
fn a_thread_that_has_its_lead_in_a_word_of_its_own() {
    let program = "G21 G18 G40 G49 G54 G80 G90 G95 G7\nT1 M6 G43\nG97 S600 M3\nG0 X32 Z2\nG1 X30 F0.2\nG0 X28 Z4\nG76 P1.5 Z-16 I-2 J0.3 R1.5 K1.84 Q29.5 H2\nG0 X60 Z50\nM2\n";
    changes(
        program,
        "linuxcnc",
        "scale-feeds 0.8",
        &expect![[r#"
             5 G1 X30 F0.16
            ! part.nc: changed for linuxcnc: every feed is 0.8 times what it was, within 0.001 mm (76 moves compared)
            ! note: the feed of a tap and the lead of a thread stay as they are
            exit 0
        "#]],
    );
}

#[test]
fn a_block_that_only_tells_how_a_cycle_cuts_gets_no_feed() {
    let program = "%\nO1\nG21 G18 G40 G80 G99 G54\nT0101\nG97 S800 M3\nG0 X52. Z2.\nG71 U2. R1.\nG71 P80 Q90 U0.5 W0.1 F0.25\nN80 G0 X20.\nG1 Z-15. F0.15\nN90 X52.\nG70 P80 Q90\nG0 X100. Z100.\nM30\n%\n";
    changes(
        program,
        "fanuc-lathe",
        "scale-feeds 0.8",
        &expect![[r#"
         8 G71 P80 Q90 U0.5 W0.1 F0.2
        10 G1 Z-15. F0.12
        ! part.nc: changed for fanuc-lathe: every feed is 0.8 times what it was, within 0.001 mm (40 moves compared)
        exit 0
    "#]],
    );
}

#[test]
fn a_pattern_that_several_cycles_use_is_one_pattern() {
    let program = "%\nO1\nG21 G17 G90 G94 G54 G40 G80\nG0 X0. Y0. Z5.\nG99 G81 X1. Y1. Z-2. R2. F80. L0\nM97 P50\nG80\nG99 G83 X1. Y1. Z-9. R2. Q3. F90. L0\nM97 P50\nG80\nM30\nN50 X5. Y5.\nX10.\nM99\n%\n";
    changes(
        program,
        "haas-mill",
        "translate --x 1",
        &expect![[r#"
         4 G0 X1. Y0. Z5.
         5 G99 G81 X2. Y1. Z-2. R2. F80. L0
         8 G99 G83 X2. Y1. Z-9. R2. Q3. F90. L0
        12 N50 X6. Y5.
        13 X11.
        ! part.nc: changed for haas-mill: every move is shifted by X1, within 0.001 mm (34 moves compared)
        exit 0
    "#]],
    );
}

#[test]
fn a_spindle_that_stands_needs_no_speed() {
    let program = "%\nO1\nG21 G17 G90 G54 G40 G80\nG0 X0. Y0. Z5.\nG1 Z1. F100.\nS500 M3\nG1 Z-1.\nM30\n%\n";
    changes(
        program,
        "haas-mill",
        "scale-speeds 2",
        &expect![[r#"
         6 S1000 M3
        ! part.nc: changed for haas-mill: every spindle speed is 2 times what it was, within 0.001 mm (3 moves compared)
        exit 0
    "#]],
    );
}

#[test]
fn safe_start_lines_say_what_is_in_effect() {
    changes(
        PART,
        "haas-mill",
        "safe-start",
        &expect![[r#"
            18 G21 G17 G90 G94 G40 G80
            19 G90 T2 M6
            20 S2000 M3
            21 G0 X10. Y10.
            22 G43 H2 Z10.
            23 G99 G83 X10. Y10. Z-12. R2. Q4. F120.
            24 X50.
            25 G80
            26 G91 G28 Z0. M5
            27 M30
            28 %
            ! part.nc: changed for haas-mill: every move is as before, within 0.001 mm (39 moves compared)
            ! note: the size of cutter 1 is not known; the proof takes a radius of 0.01 mm
            exit 0
        "#]],
    );
    changes(
        PART,
        "haas-mill",
        "safe-start --tool 1",
        &expect![[r#"
        ! part.nc: there is nothing to change
        exit 0
    "#]],
    );
    let program = "%\nO1\nG21 G17 G90 G54 G40 G80\nM97 P50\nG18\nM97 P50\nM30\nN50 T1 M6\nM99\n%\n";
    refuses(
        program,
        "haas-mill",
        "safe-start",
        &expect![[r#"
            error: part.nc:8:1: cannot insert safe start lines: this tool change runs more than once, under different modes
              |
            8 | N50 T1 M6
              | ^^^^^^^^^
            part.nc: nothing is changed
        "#]],
    );
    // A program that goes on with increments.
    let program = "%\nO1\nG21 G17 G90 G54 G40 G80\nG0 X1. Y0. Z5.\nG91\nT1 M6\nX5.\nM30\n%\n";
    refuses(
        program,
        "haas-mill",
        "safe-start",
        &expect![[r#"
            error: part.nc: cannot insert safe start lines: the proof failed
            the paths part at X5 Y0 Z-3.0564
              - part.nc:7  to X6 Y0 Z-3.0564   | X5.
              + part.nc (changed):8  has no moves left   | X5.
              note: `-` is what the change promises, `+` is what the changed program does
            part.nc: nothing is changed
        "#]],
    );
}

/// Three tools, each of which calls the next one early.
const THREE_TOOLS: &str = "%\nO1 (PART)\n(T1 END MILL)\n(T2 DRILL)\nG21 G17 G90 G54 G40 G80\n\n(FACE)\nN1 T1 M6\nT02\nS1000 M3\nG90 G0 X0. Y0.\nG43 H1 Z10.\nG1 Z-1. F100.\nX50.\nG0 Z10.\nG91 G28 Z0. M5\nM01\n(DRILL)\nN2 T2 M6\nT03\nS2000 M3\nG90 G0 X10. Y10.\nG43 H2 Z10.\nG99 G81 Z-12. R2. F120.\nG80\nG91 G28 Z0. M5\nM01\n(CHAMFER)\nN3\nT3\nM6\nT01\nS900 M3\nG90 G0 X10. Y10.\nG43 H3 Z10.\nG1 Z-1.\nX20.\nG0 Z10.\nG91 G28 Z0. M5\n(END)\nM30\n%\n";

#[test]
fn the_section_of_a_tool_goes_to_another_place() {
    let with_feed = THREE_TOOLS.replace("G1 Z-1.\nX20.", "G1 Z-1. F80.\nX20.");
    changes(
        &with_feed,
        "haas-mill",
        "move-section --tool 3 --before 2",
        &expect![[r#"
             9 T03
            18 (CHAMFER)
            19 N3
            20 T3
            21 M6
            22 T02
            23 S900 M3
            24 G90 G0 X10. Y10.
            25 G43 H3 Z10.
            26 G1 Z-1. F80.
            27 X20.
            28 G0 Z10.
            29 G91 G28 Z0. M5
            30 (DRILL)
            31 N2 T2 M6
            33 S2000 M3
            35 G43 H2 Z10.
            36 G99 G81 Z-12. R2. F120.
            37 G80
            38 G91 G28 Z0. M5
            39 M01
            ! part.nc: changed for haas-mill: the tools come in another order, and every move of each section is as before, within 0.001 mm (18 moves compared)
            ! note: the way to the first point of a section begins where the section above it ends: check that the tool clears the part there
            exit 0
        "#]],
    );
    changes(
        &with_feed,
        "haas-mill",
        "move-section --lines 20 --up",
        &expect![[r#"
             7 (DRILL)
             8 N2 T2 M6
             9 T01
            10 S2000 M3
            11 G90 G0 X10. Y10.
            12 G43 H2 Z10.
            13 G99 G81 Z-12. R2. F120.
            14 G80
            15 G91 G28 Z0. M5
            16 M01
            17 (FACE)
            18 N1 T1 M6
            19 T03
            20 S1000 M3
            21 G90 G0 X0. Y0.
            22 G43 H1 Z10.
            23 G1 Z-1. F100.
            24 X50.
            25 G0 Z10.
            32 T02
            ! part.nc: changed for haas-mill: the tools come in another order, and every move of each section is as before, within 0.001 mm (18 moves compared)
            ! note: the way to the first point of a section begins where the section above it ends: check that the tool clears the part there
            exit 0
        "#]],
    );
}

#[test]
fn a_section_that_cannot_move_says_why() {
    let with_feed = THREE_TOOLS.replace("G1 Z-1.\nX20.", "G1 Z-1. F80.\nX20.");
    // T3 cuts at the feed of T2.
    refuses(
        THREE_TOOLS,
        "haas-mill",
        "move-section --tool 3 --before 2",
        &expect![[r#"
            error: part.nc: cannot move the section of a tool: the proof failed
            tool section T3 moved from place 3 (part.nc, lines 31 to 39) to place 2 (part.nc (changed), lines 21 to 29)
            the feed differs, once
              - part.nc:36  120 mm/min   | G1 Z-1.
              + part.nc (changed):26  100 mm/min   | G1 Z-1.
              note: `-` is what the change promises, `+` is what the changed program does
              help: let the section give all that it needs after its tool change: work offset, length, modes, feed, speed and a first point
            part.nc: nothing is changed
        "#]],
    );
    refuses(
        &with_feed,
        "haas-mill",
        "move-section --tool 3 --down",
        &expect![[r#"
        error: part.nc: cannot move the section of a tool: it is the last section already
        part.nc: nothing is changed
    "#]],
    );
    refuses(
        &with_feed,
        "haas-mill",
        "move-section --lines 10-20 --up",
        &expect![[r#"
        error: part.nc: cannot move the section of a tool: more than one section is chosen
          help: choose a line of one of them with --lines
        part.nc: nothing is changed
    "#]],
    );
    refuses(
        &with_feed,
        "haas-mill",
        "move-section --up",
        &expect![[r#"
        error: part.nc: cannot move the section of a tool: one section moves at a time
          help: name a tool with --tool, or a line of its section with --lines
        part.nc: nothing is changed
    "#]],
    );
    refuses(
        &with_feed,
        "haas-mill",
        "move-section --tool 3 --after 3",
        &expect![[r#"
            error: part.nc: cannot move the section of a tool: T3 is the tool of the section that moves, and no other section uses it
            part.nc: nothing is changed
        "#]],
    );
    let looped = "%\nO1\n#1=0\nWHILE [#1 LT 2] DO1\nT1 M6\nT2 M6\n#1=#1+1\nEND1\nM30\n%\n";
    refuses(
        looped,
        "haas-mill",
        "move-section --tool 2 --up",
        &expect![[r#"
        error: part.nc:5:1: cannot move the section of a tool: the tool changes do not run in the order of the text, each of them once
          |
        5 | T1 M6
          | ^^^^^
        part.nc: nothing is changed
    "#]],
    );
}

/// What must not come in another order, and what no section says of itself.
#[test]
fn sections_that_depend_on_their_order_stay() {
    let refused = |replaced: &str, by: &str, arguments: &str, expected: &Expect| {
        let program = THREE_TOOLS.replace("G1 Z-1.\nX20.", "G1 Z-1. F80.\nX20.").replace(replaced, by);
        refuses(&program, "haas-mill", arguments, expected);
    };
    let up = "move-section --tool 2 --up";
    refused(
        "M01\n(DRILL)",
        "M0 (TURN THE PART OVER)\n(DRILL)",
        up,
        &expect![[r#"
        error: part.nc:17:1: cannot move the section of a tool: the operator does something here, which would come before or after other work
           |
        17 | M0 (TURN THE PART OVER)
           | ^^^^^^^^^^^^^^^^^^^^^^^
          help: move the section by hand, if this may come at another time
        part.nc: nothing is changed
    "#]],
    );
    refused(
        "X50.\n",
        "X50.\nM83\n",
        up,
        &expect![[r#"
        error: part.nc:15:1: cannot move the section of a tool: what this command does is not followed, and it would come before or after other work
           |
        15 | M83
           | ^^^
          help: move the section by hand, if this may come at another time
        part.nc: nothing is changed
    "#]],
    );
    refused(
        "X50.\n",
        "X50.\nG31 Z-2. F50.\n",
        up,
        &expect![[r#"
        error: part.nc:15:1: cannot move the section of a tool: what is measured here would be measured before or after other work
           |
        15 | G31 Z-2. F50.
           | ^^^^^^^^^^^^^
          help: move the section by hand, if this may come at another time
        part.nc: nothing is changed
    "#]],
    );
    refused(
        "M01\n(DRILL)",
        "IF [#500 EQ 1] GOTO 3\n(DRILL)",
        "move-section --tool 2 --up --set #500=0",
        &expect![[r#"
            error: part.nc:17:16: cannot move the section of a tool: this jump leads from one section to another, or out of all
               |
            17 | IF [#500 EQ 1] GOTO 3
               |                ^^^^^^
              help: sections move only where the program runs them one after the other, each by itself
            part.nc: nothing is changed
        "#]],
    );
    refused(
        "N2 T2 M6",
        "N2 M6",
        up,
        &expect![[r#"
        error: part.nc:19:1: cannot move the section of a tool: the section does not name its tool: T2 is called in the section above it
           |
        19 | N2 M6
           | ^^^^^
          help: write `T2` in this block
        part.nc: nothing is changed
    "#]],
    );
    let looped = "%\nO1\nG21 G90 G54\n#1=0\nWHILE [#1 LT 1] DO1\nT1 M6\nG0 X0. Y0.\nT2 M6\nG0 X1. Y0.\n#1=#1+1\nEND1\nT3 M6\nG0 X2. Y0.\nM30\n%\n";
    refuses(
        looped,
        "haas-mill",
        "move-section --tool 3 --up",
        &expect![[r#"
            error: part.nc:11:1: cannot move the section of a tool: this loop begins in another section than it ends
               |
            11 | END1
               | ^^^^
              help: sections move only where the program runs them one after the other, each by itself
            part.nc: nothing is changed
        "#]],
    );
    let limited = "%\nO1\nG21 G18 G40 G99\nG28 U0. W0.\nT0101\nG50 S2500\nG96 S200 M3\nG0 X50. Z2.\nG1 Z-20. F0.2\nG28 U0. W0.\nT0303\nG50 S1200\nG96 S150 M3\nG0 X52. Z-10.\nG1 X40. F0.1\nG28 U0. W0.\nT0505\nG96 S100 M3\nG0 X52. Z-15.\nG1 X48. F0.1\nG28 U0. W0.\nM30\n%\n";
    refuses(
        limited,
        "haas-lathe",
        "move-section --tool 3 --up",
        &expect![[r#"
            error: part.nc: cannot move the section of a tool: the proof failed
            tool section T3 moved from place 2 (part.nc, lines 11 to 16) to place 1 (part.nc (changed), lines 5 to 10)
            the spindle differs, once
              - part.nc:20  clockwise, 100 m/min, at most 1200 rpm   | G1 X48. F0.1
              + part.nc (changed):20  clockwise, 100 m/min, at most 2500 rpm   | G1 X48. F0.1
              note: `-` is what the change promises, `+` is what the changed program does
              help: let the section give all that it needs after its tool change: work offset, length, modes, feed, speed and a first point
            part.nc: nothing is changed
        "#]],
    );
}

/// The modes at the beginning of a section go with its comment and number, and the end of the program stays.
#[test]
fn a_section_goes_with_what_stands_between_its_heading_and_its_tool() {
    let section = |tool: u32, cut: &str| {
        format!(
            "(TOOL {tool})\nN{tool}\nG0 G17 G40 G49 G80 G90\nT{tool} M6\nS1000 M3\nG54 G0 X{tool}. Y0.\nG43 H{tool} Z5.\n{cut}\nG0 Z5.\nG91 G28 Z0. M5\n"
        )
    };
    let text = format!(
        "%\nO1\n(PART)\n(ZERO TOP CENTRE)\nG21\n{}{}G28 Y0.\nM30\n%\n",
        section(1, "G1 Z-1. F100."),
        section(2, "G1 Z-2. F80.")
    );
    changes(
        &text,
        "haas-mill",
        "move-section --tool 2 --up",
        &expect![[r#"
         6 (TOOL 2)
         7 N2
         9 T2 M6
        11 G54 G0 X2. Y0.
        12 G43 H2 Z5.
        13 G1 Z-2. F80.
        16 G28 Y0.
        17 (TOOL 1)
        18 N1
        19 G0 G17 G40 G49 G80 G90
        20 T1 M6
        21 S1000 M3
        22 G54 G0 X1. Y0.
        23 G43 H1 Z5.
        24 G1 Z-1. F100.
        25 G0 Z5.
        26 G91 G28 Z0. M5
        ! part.nc: changed for haas-mill: the tools come in another order, and every move of each section is as before, within 0.001 mm (11 moves compared)
        ! note: line 26 of the program before the change goes with T2: move it by hand if it closes the program
        ! note: the way to the first point of a section begins where the section above it ends: check that the tool clears the part there
        exit 0
    "#]],
    );
    // Without a program end.
    let text = format!("%\nG21\n{}{}%\n", section(1, "G1 Z-1. F100."), section(2, "G1 Z-2. F80."));
    changes(
        &text,
        "linuxcnc",
        "move-section --tool 2 --up",
        &expect![[r#"
         3 (TOOL 2)
         4 N2
         6 T2 M6
         8 G54 G0 X2. Y0.
         9 G43 H2 Z5.
        10 G1 Z-2. F80.
        13 (TOOL 1)
        14 N1
        16 T1 M6
        18 G54 G0 X1. Y0.
        19 G43 H1 Z5.
        20 G1 Z-1. F100.
        ! part.nc: changed for linuxcnc: the tools come in another order, and every move of each section is as before, within 0.001 mm (8 moves compared)
        ! note: the way to the first point of a section begins where the section above it ends: check that the tool clears the part there
        exit 0
    "#]],
    );
}

/// A turret calls its tool by one word, and takes its offset back by another.
#[test]
fn the_section_of_a_lathe_tool_goes_to_another_place() {
    let program = "%\nO1\nG21 G18 G40 G99\nG28 U0. W0.\nT0101 (ROUGH)\nG97 S800 M3\nG0 X50. Z2.\nG1 Z-20. F0.2\nX60.\nG28 U0. W0.\nT0100\nM01\nT0202 (GROOVE)\nG97 S600 M3\nG0 X52. Z-10.\nG1 X40. F0.1\nX52.\nG28 U0. W0.\nT0200\nM30\n%\n";
    changes(
        program,
        "haas-lathe",
        "move-section --tool 2 --before 1",
        &expect![[r#"
             5 T0202 (GROOVE)
             6 G97 S600 M3
             7 G0 X52. Z-10.
             8 G1 X40. F0.1
             9 X52.
            11 T0200
            12 T0101 (ROUGH)
            13 G97 S800 M3
            14 G0 X50. Z2.
            15 G1 Z-20. F0.2
            16 X60.
            17 G28 U0. W0.
            18 T0100
            19 M01
            ! part.nc: changed for haas-lathe: the tools come in another order, and every move of each section is as before, within 0.001 mm (6 moves compared)
            ! note: the way to the first point of a section begins where the section above it ends: check that the tool clears the part there
            exit 0
        "#]],
    );
}

/// A program that changes without a change of its moves does the same for `gcheck diff`, which knows nothing of the change.
#[test]
fn programs_that_are_written_otherwise_are_the_same_for_diff() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../fixtures/clean");
    let mut changed = 0;
    for control in
        fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()).filter(|path| path.is_dir())
    {
        let name = control.file_name().unwrap().to_str().unwrap().to_owned();
        for file in fs::read_dir(&control).unwrap().map(|entry| entry.unwrap().path()) {
            let Ok(text) = fs::read_to_string(&file) else { continue };
            for change in
                ["expand-cycle", "fold-cycle", "unroll-loop", "absolute", "incremental", "mm", "safe-start"]
            {
                let shop = Shop::with(&[("before.nc", &text), ("after.nc", &text)]);
                let run = shop.gcheck(&format!("edit {change} after.nc --control {name} -q"));
                assert!(run.code == 0 || shop.read("after.nc") == text, "{}: {change}", file.display());
                if shop.read("after.nc") == text {
                    continue;
                }
                changed += 1;
                let diff = shop.gcheck(&format!("diff before.nc after.nc --control {name} -q"));
                assert_eq!(diff.code, 0, "{}: {change}\n{diff}", file.display());
            }
        }
    }
    assert!(changed > 10, "{changed} programs changed");
}

/// LinuxCNC passes all points of a canned cycle exactly, whatever `G64` says of the moves around it.
#[test]
fn moves_of_a_cycle_take_corners_as_the_cycle_did() {
    changes(
        "G21 G90 G64 P0.05 Q0.02\nG0 X0 Y0 Z10\nG98 G81 X10 Y0 Z-5 R2 F100\nX20\nG80\nG1 X30\nM2\n",
        "linuxcnc",
        "expand-cycle",
        &expect![[r#"
             3 G98
             4 G61
             5 G0 X10
             6 G0 Z2
             7 G1 Z-5 F100
             8 G0 Z10
             9 G0 X20
            10 G0 Z2
            11 G1 Z-5
            12 G0 Z10
            13 G64 P0.05 Q0.02
            14 G80
            15 G1 X30
            16 M2
            ! part.nc: changed for linuxcnc: every move is as before, within 0.001 mm (10 moves compared)
            exit 0
        "#]],
    );
    changes(
        "G21 G90 G0 X0 Y0 Z10\nG61 G98 G81 X10 Y0 Z-5 R2 F100\nG80\nM2\n",
        "linuxcnc",
        "expand-cycle",
        &expect![[r#"
             2 G61 G98
             3 G0 X10
             4 G0 Z2
             5 G1 Z-5 F100
             6 G0 Z10
             7 G80
             8 M2
            ! part.nc: changed for linuxcnc: every move is as before, within 0.001 mm (5 moves compared)
            exit 0
        "#]],
    );
}

#[test]
fn words_beside_a_dwell_move_where_the_dwell_does_not_take_them() {
    changes(
        "G21 G90 G0 X1 Y2 Z5\nG4 P0.5 G0 X10 Y20\nM2\n",
        "linuxcnc",
        "mirror x",
        &expect![[r#"
             1 G21 G90 G0 X-1 Y2 Z5
             2 G4 P0.5 G0 X-10 Y20
            ! part.nc: changed for linuxcnc: every move is mirrored at X0, within 0.001 mm (2 moves compared)
            exit 0
        "#]],
    );
}

#[test]
fn offsets_written_by_the_present_point_stay() {
    for form in ["L10 P1", "L20 P1"] {
        let program = format!("G21 G90 G54 S900 M3\nG0 X10 Y0 Z5\nG10 {form} X0\nG43 H1 G1 X5 F100\nM2\n");
        for change in ["translate --x 10", "mirror x"] {
            let (run, text) = edit(&program, "linuxcnc", change);
            assert_eq!((run.code, text), (2, program.clone()));
            let why = "moves the zero of the program to or from where the tool is";
            assert!(run.stderr.contains(why), "{}", run.stderr);
        }
    }
    // The number of the form means extra work offsets here.
    changes(
        "%\nO1\nG21 G90 G54 S900 M3\nG0 X10. Y0 Z5.\nG10 L20 P1 X0\nG1 X5. F100.\nM30\n%\n",
        "haas-mill",
        "translate --x 10",
        &expect![[r#"
             4 G0 X20. Y0 Z5.
             6 G1 X15. F100.
            ! part.nc: changed for haas-mill: every move is shifted by X10, within 0.001 mm (2 moves compared)
            exit 0
        "#]],
    );
}

#[test]
fn places_seen_from_the_zero_of_the_program_or_in_a_turned_system_stay() {
    refuses(
        "G21 G90 G0 X0 Y0 Z5\nG0 @10 ^30\nM2\n",
        "linuxcnc",
        "translate --x 10",
        &expect![[r#"
        error: part.nc:2:1: cannot shift the path: this block gives a distance and an angle as seen from the zero of the program, which stays where it is
          |
        2 | G0 @10 ^30
          | ^^^^^^^^^^
        part.nc: nothing is changed
    "#]],
    );
    refuses(
        "G21 G90 G0 X0 Y0 Z5\nG0 @10 ^30\nM2\n",
        "linuxcnc",
        "incremental",
        &expect![[r#"
        error: part.nc:2:1: cannot write increments: this block gives a distance and an angle as seen from the zero of the program
          |
        2 | G0 @10 ^30
          | ^^^^^^^^^^
        part.nc: nothing is changed
    "#]],
    );
    refuses(
        "G21 G90 G54\nG10 L2 P1 R30\nG0 X1 Y2 Z5\nM2\n",
        "linuxcnc",
        "translate --x 10",
        &expect![[r#"
        error: part.nc:3:1: cannot shift the path: the work coordinate system is turned about Z here, so X and Y are not those of the machine
          |
        3 | G0 X1 Y2 Z5
          | ^^^^^^^^^^^
          help: select lines in a system that is not turned
        part.nc: nothing is changed
    "#]],
    );
}

#[test]
fn functions_are_values_as_a_whole() {
    changes(
        "G21 G90 G0 X0 Y0 Z5\nG1 X SIN[30] Y[1+1] F100\nM2\n",
        "linuxcnc",
        "translate --x 10 --y 1",
        &expect![[r#"
             1 G21 G90 G0 X10 Y1 Z5
             2 G1 X [[SIN[30]]+10.] Y[[1+1]+1.] F100
            ! part.nc: changed for linuxcnc: every move is shifted by X10 Y1, within 0.001 mm (2 moves compared)
            exit 0
        "#]],
    );
}

#[test]
fn turns_become_increments_too() {
    changes(
        "G21 G90 G0 X0 Y0 Z5 A0\nG1 X5 F100\nA-30\nX7 A10\nM2\n",
        "linuxcnc",
        "incremental",
        &expect![[r#"
             2 G91 G1 X5 F100
             4 X2 A40
            ! part.nc: changed for linuxcnc: every move is as before, within 0.001 mm (4 moves compared)
            exit 0
        "#]],
    );
}

/// LinuxCNC reads a feed before the units of its block.
#[test]
fn units_come_before_the_first_feed() {
    changes(
        "F100\nG90 G0 X5 Y5 Z5\nG1 X10\nM2\n",
        "linuxcnc",
        "inch",
        &expect![[r#"
             1 G20
             2 F3.93701
             3 G90 G0 X0.19685 Y0.19685 Z0.19685
             4 G1 X0.3937
             5 M2
            ! part.nc: changed for linuxcnc: every move is as before, within 0.002 mm (2 moves compared)
            exit 0
        "#]],
    );
}

/// A tool of which only the size is configured has an unknown length, and not none.
#[test]
fn a_length_that_is_not_configured_is_unknown() {
    let program = "G21 G90 G54\nT1 M6\nG0 X0 Y0 Z50\nG43 H1\nG0 Z5\nZ3\nM2\n";
    let shop = Shop::with(&[("part.nc", program), ("gcheck.toml", "[tools]\n1.diameter = 6\n")]);
    let run = shop.gcheck("edit incremental part.nc --control linuxcnc");
    assert_eq!(run.code, 0, "{}", run.stderr);
    assert_eq!(shop.read("part.nc"), "G21 G90 G54\nT1 M6\nG0 X0 Y0 Z50\nG43 H1\nG0 Z5\nG91 Z-2\nM2\n");
}

#[test]
fn zero_without_a_point_becomes_a_number_that_says_what_it_counts() {
    let program = "%\nO1\nG21 G17 G90 G94 G54 G40 G80\nT1 M6\nG0 X0 Y0\nG43 H1 Z10.\nG1 Z0 F300.\nX50. Y0\nG0 Z10.\nM30\n%\n";
    changes(
        program,
        "haas-mill",
        "translate --x 15 --z 1.5",
        &expect![[r#"
         5 G0 X15. Y0
         6 G43 H1 Z11.5
         7 G1 Z1.5 F300.
         8 X65. Y0
         9 G0 Z11.5
        ! part.nc: changed for haas-mill: every move is shifted by X15 Z1.5, within 0.001 mm (5 moves compared)
        exit 0
    "#]],
    );
    changes(
        program,
        "haas-mill",
        "incremental",
        &expect![[r#"
         7 G91 G1 Z-10. F300.
        ! part.nc: changed for haas-mill: every move is as before, within 0.001 mm (5 moves compared)
        exit 0
    "#]],
    );
}

#[test]
fn places_of_the_machine_stay_whatever_code_goes_there() {
    // A tool change takes Z to the machine's zero; a return without words is one of all axes.
    let program = "%\nO1\nG21 G17 G90 G94 G54 G40 G80\nT1 M6\nG0 X5. Y20.\nG43 H1 Z10.\nG1 Z-2. F300.\nG0 Z10.\nT2 M6\nG0 X6. Y21.\nG43 H2 Z10.\nG1 Z-3. F300.\nG0 Z10.\nG53 Y0.\nG28\nM30\n%\n";
    changes(
        program,
        "haas-mill",
        "translate --z 1.5",
        &expect![[r#"
         6 G43 H1 Z11.5
         7 G1 Z-0.5 F300.
         8 G0 Z11.5
        11 G43 H2 Z11.5
        12 G1 Z-1.5 F300.
        13 G0 Z11.5
        ! part.nc: changed for haas-mill: every move is shifted by Z1.5, within 0.001 mm (10 moves compared)
        exit 0
    "#]],
    );
    changes(
        program,
        "haas-mill",
        "mirror X",
        &expect![[r#"
         5 G0 X-5. Y20.
        10 G0 X-6. Y21.
        ! part.nc: changed for haas-mill: every move is mirrored at X0, within 0.001 mm (10 moves compared)
        ! note: climb milling becomes conventional milling, and the other way round: the spindle still turns as before
        exit 0
    "#]],
    );
    changes(
        program,
        "haas-mill",
        "rotate 90",
        &expect![[r#"
         5 G0 X-20. Y5.
        10 G0 X-21. Y6.
        ! part.nc: changed for haas-mill: every move is rotated by 90° about X0 Y0, within 0.001 mm (10 moves compared)
        exit 0
    "#]],
    );
}

#[test]
fn a_return_of_a_rotary_axis_and_a_change_that_does_not_happen_move_nothing_else() {
    let program =
        "O1\nG21 G18 G40 G98\nT0101\nG97 S500 M3\nG0 X60. Z5.\nG28 H0\nG0 C90.\nG1 Z-5. F100.\nX50.\nM30\n";
    changes(
        program,
        "fanuc-lathe",
        "translate --z 1",
        &expect![[r#"
         5 G0 X60. Z6.
         8 G1 Z-4. F100.
        ! part.nc: changed for fanuc-lathe: every move is shifted by Z1, within 0.001 mm (4 moves compared)
        exit 0
    "#]],
    );
    let program = "O1\nG21 G17 G90 G94 G54 G40 G80\nT1 M6\nG0 X5. Y6.\nG43 H1 Z5.\n#1=0\nIF [#1 EQ 1] G28\nG1 X8. F100.\nG0 Z20. M6 T2\nG0 X1. Y2.\nG43 H2 Z5.\nM30\n";
    changes(
        program,
        "haas-mill",
        "translate --z 1",
        &expect![[r#"
         5 G43 H1 Z6.
         9 G0 Z21. M6 T2
        11 G43 H2 Z6.
        ! part.nc: changed for haas-mill: every move is shifted by Z1, within 0.001 mm (6 moves compared)
        exit 0
    "#]],
    );
}

#[test]
fn a_side_that_is_switched_in_a_block_of_its_own_is_mirrored() {
    let program = "%\nO1\nG21 G17 G90 G94 G54 G40 G80\nT1 M6\nG0 X-10. Y-10.\nG43 H1 Z10.\nG1 Z-2. F300.\nG41 D1\nX0. Y0.\nY40.\nX50.\nG40\nX60. Y50.\nG0 Z10.\nM30\n%\n";
    changes(
        program,
        "haas-mill",
        "mirror X",
        &expect![[r#"
         5 G0 X10. Y-10.
         8 G42 D1
        11 X-50.
        13 X-60. Y50.
        ! part.nc: changed for haas-mill: every move is mirrored at X0, within 0.001 mm (8 moves compared)
        ! note: climb milling becomes conventional milling, and the other way round: the spindle still turns as before
        ! note: the size of cutter 1 is not known; the proof takes a radius of 0.01 mm
        exit 0
    "#]],
    );
}

#[test]
fn a_lathe_drills_along_z_whatever_the_plane() {
    let program = "%\nO1\nG21 G18 G40 G99 G54\nT0101\nG97 S800 M3\nG0 X0. Z10.\nG81 Z-12. R2. F0.1\nG80\nG0 Z50.\nM30\n%\n";
    changes(
        program,
        "haas-lathe",
        "translate --z 1.5",
        &expect![[r#"
         6 G0 X0. Z11.5
         7 G81 Z-10.5 R3.5 F0.1
         9 G0 Z51.5
        ! part.nc: changed for haas-lathe: every move is shifted by Z1.5, within 0.001 mm (5 moves compared)
        exit 0
    "#]],
    );
}

#[test]
fn a_cycle_that_taps_stays_beside_others() {
    let program = "%\nO1\nG21 G17 G90 G94 G54 G40 G80\nT3 M6\nS500 M3\nG0 X0. Y0.\nG43 H3 Z5.\nG81 Z-10. R2. F100.\nG80\nG84 Z-10. R2. F500.\nG80\nM30\n%\n";
    changes(
        program,
        "haas-mill",
        "expand-cycle",
        &expect![[r#"
             8 G0 Z2.
             9 G1 Z-10. F100.
            10 G0 Z5.
            12 G84 Z-10. R2. F500.
            13 G80
            14 M30
            15 %
            ! part.nc: changed for haas-mill: every move is as before, within 0.001 mm (9 moves compared)
            ! note: cycles that tap, or stop and turn the spindle, stay: G84
            exit 0
        "#]],
    );
}

/// A loop of two turns, but for what else it sets or calls.
const LOOP: [&str; 2] = [
    "%\nO1\nG21 G17 G90 G54 G40 G80\n#1=0\n#501=0\nG0 X0. Y0. Z5.\nWHILE [#1 LT 2] DO1\nG0 X[#1*10.]\n",
    "#1=#1+1\nEND1\nM30\n%\n",
];

#[test]
fn values_that_a_loop_leaves_to_later_programs_stay() {
    let [head, tail] = LOOP;
    changes(
        &format!("{head}#501=#501+1\n{tail}"),
        "fanuc-mill",
        "unroll-loop",
        &expect![[r#"
         7 G0 X0.
         8 G0 X10.
         9 #501=2.
        10 M30
        11 %
        ! part.nc: changed for fanuc-mill: every move is as before, within 0.001 mm (2 moves compared)
        exit 0
    "#]],
    );
    // What no turn sets is not written.
    let never = format!("{head}IF [#1 EQ 7] THEN #502=1\n{tail}");
    changes(
        &never,
        "fanuc-mill",
        "unroll-loop",
        &expect![[r#"
         7 G0 X0.
         8 G0 X10.
         9 M30
        10 %
        ! part.nc: changed for fanuc-mill: every move is as before, within 0.001 mm (2 moves compared)
        exit 0
    "#]],
    );
}

// Assignments act by themselves, or a called program may read them.
#[test]
fn assignments_of_a_loop_that_do_more_than_count_stay_in_each_turn() {
    let [head, tail] = LOOP;
    changes(
        &format!("{head}#5221=#1\n{tail}"),
        "fanuc-mill",
        "unroll-loop",
        &expect![[r#"
         7 G0 X0.
         8 #5221=#1
         9 #1=#1+1
        10 G0 X10.
        11 #5221=#1
        12 #1=#1+1
        13 M30
        14 %
        ! part.nc: changed for fanuc-mill: every move is as before, within 0.001 mm (2 moves compared)
        exit 0
    "#]],
    );
    changes(
        &format!("{head}#[500+#1]=5.\n{tail}"),
        "fanuc-mill",
        "unroll-loop",
        &expect![[r#"
         7 G0 X0.
         8 #[500+#1]=5.
         9 #1=#1+1
        10 G0 X10.
        11 #[500+#1]=5.
        12 #1=#1+1
        13 M30
        14 %
        ! part.nc: changed for fanuc-mill: every move is as before, within 0.001 mm (2 moves compared)
        exit 0
    "#]],
    );
    let calls = format!("{head}M98 P50\n{tail}").replace("M30\n", "M30\nO50\n#502=#1\nM99\n");
    changes(
        &calls,
        "fanuc-mill",
        "unroll-loop",
        &expect![[r#"
         7 G0 X0.
         8 M98 P50
         9 #1=#1+1
        10 G0 X10.
        11 M98 P50
        12 #1=#1+1
        13 M30
        14 O50
        15 #502=#1
        16 M99
        17 %
        ! part.nc: changed for fanuc-mill: every move is as before, within 0.001 mm (2 moves compared)
        exit 0
    "#]],
    );
    changes(
        "G21 G90\n#<n>=0\no1 while [#<n> lt 2]\n  G0 X[#<n>*10]\n  #<_parts>=[#<n>+1]\n  #<n>=[#<n>+1]\no1 endwhile\nM2\n",
        "linuxcnc",
        "unroll-loop",
        &expect![[r#"
             3 G0 X0
             4 #<_parts>=[#<n>+1]
             5 #<n>=[#<n>+1]
             6 G0 X10
             7 #<_parts>=[#<n>+1]
             8 #<n>=[#<n>+1]
             9 M2
            ! part.nc: changed for linuxcnc: every move is as before, within 0.001 mm (2 moves compared)
            exit 0
        "#]],
    );
    refuses(
        &format!("{head}IF [#1 EQ 1] THEN #502=1\nM98 P50\n{tail}").replace("M30\n", "M30\nO50\nM99\n"),
        "fanuc-mill",
        "unroll-loop",
        &expect![[r#"
            error: part.nc:9:1: cannot unroll the loop: a condition decides in each turn whether this block sets its variable
              |
            9 | IF [#1 EQ 1] THEN #502=1
              | ^^^^^^^^^^^^^^^^^^^^^^^^
              help: write the condition as a jump over the block
            part.nc: nothing is changed
        "#]],
    );
}

#[test]
fn lengths_in_least_increments_are_converted_to_whole_numbers() {
    let program = "%\nO1\nG21 G18 G40 G99 G54\nT0101\nG97 S500 M3\nG0 X0. Z2.54\nG74 R0.508\nG74 Z-20.32 Q5080 F0.1\nG0 X50.8 Z50.8\nT0202\nG0 X22.86 Z5.08\nG76 P010060 Q51 R0.0254\nG76 X18.288 Z-20.32 P914 Q305 F1.5\nG0 X50.8 Z50.8\nM30\n%\n";
    refuses(
        &program.replace("Q5080", "Q1"),
        "fanuc-lathe",
        "inch",
        &expect![[r#"
        error: part.nc:8:14: cannot write the program in inches: this length would be less than one least increment
          |
        8 | G74 Z-20.32 Q1 F0.1
          |              ^
        part.nc: nothing is changed
    "#]],
    );
    refuses(
        &program.replace("Q305", "Q[305]"),
        "fanuc-lathe",
        "inch",
        &expect![[r#"
        error: part.nc:13:27: cannot write the program in inches: this word counts least increments, and what a computed one counts is not certain
           |
        13 | G76 X18.288 Z-20.32 P914 Q[305] F1.5
           |                           ^^^^^
        part.nc: nothing is changed
    "#]],
    );
    changes(
        program,
        "fanuc-lathe",
        "inch",
        &expect![[r#"
         3 G20 G18 G40 G99 G54
         6 G0 X0. Z0.1
         7 G74 R0.02
         8 G74 Z-0.8 Q2000 F0.003937
         9 G0 X2. Z2.
        11 G0 X0.9 Z0.2
        12 G76 P010060 Q20 R0.001
        13 G76 X0.72 Z-0.8 P360 Q120 F0.059055
        14 G0 X2. Z2.
        ! part.nc: changed for fanuc-lathe: every move is as before, within 0.002 mm (65 moves compared)
        exit 0
    "#]],
    );
}

#[cfg(unix)]
#[test]
fn a_link_that_leads_out_of_its_folder_is_not_written_through() {
    let shop = Shop::with(&[("out/part.nc", PART), ("in/other.nc", PART)]);
    std::os::unix::fs::symlink(shop.path("out/part.nc"), shop.path("in/link.nc")).unwrap();
    let run = shop.gcheck("edit translate --x 10 in/link.nc --control haas-mill");
    assert_eq!(shop.read("out/part.nc"), PART, "nothing is written");
    assert_eq!(run.code, 2);
    assert!(run.stderr.contains("is a link that leads out of the folder"), "{}", run.stderr);
}
