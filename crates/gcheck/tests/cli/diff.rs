//! `gcheck diff`: which programs make the machine do the same, and the messages of those that do not.

use expect_test::expect;
use serde_json::Value;

use crate::shop::{Run, Shop};

fn diff(a: &str, b: &str, arguments: &str) -> Run {
    let shop = Shop::with(&[("a.nc", a), ("b.nc", b)]);
    shop.gcheck(&format!("diff a.nc b.nc --control fanuc-mill -q {arguments}"))
}

/// A program around some blocks, from a known place.
fn program(blocks: &str) -> String {
    format!(
        "%\nO1\nG21 G17 G90 G94 G54\nT1 M6\nG0 X0. Y0. S1000 M3\nG43 H1 Z5.\nG1 Z-1. F200.\n{blocks}\nM30\n%\n"
    )
}

#[track_caller]
fn same(a: &str, b: &str) {
    let run = diff(&program(a), &program(b), "");
    assert_eq!(
        (run.code, run.stdout.as_str()),
        (0, "a.nc and b.nc make the machine do the same, within 0.001 mm\n")
    );
}

#[track_caller]
fn different(a: &str, b: &str) -> String {
    let run = diff(&program(a), &program(b), "");
    assert_eq!(run.code, 1, "{}", run.stdout);
    run.stdout
}

#[test]
fn numbers_blanks_comments_and_leading_zeros_make_no_difference() {
    same("N10 G01 X10. F100. (SIDE)\nN20 Y5.0", "G1X10.F100\n\n/ \nX10.000Y+5.");
}

/// A part that is turned to its centre spins up to the limit: another one may throw it out of the chuck.
#[test]
fn another_limit_of_the_surface_speed_is_a_difference() {
    let program = |limit: &str| {
        format!("%\nO1\nG21 G18 G99\nT0101\n{limit}G96 S200 M3\nG0 X50. Z0.\nG1 X0. F0.2\nG97 S500\nM30\n%\n")
    };
    let run = |a: &str, b: &str| {
        let shop = Shop::with(&[("a.nc", &program(a)), ("b.nc", &program(b))]);
        shop.gcheck("diff a.nc b.nc --control haas-lathe -q")
    };
    assert_eq!(run("G50 S1200\n", "G50 S1200\n").code, 0);
    expect![[r#"
        the spindle differs, once
          - a.nc:8  clockwise, 200 m/min, at most 1200 rpm   | G1 X0. F0.2
          + b.nc:8  clockwise, 200 m/min, at most 9000 rpm   | G1 X0. F0.2
        a.nc and b.nc move along the same path, within 0.001 mm, with differences
    "#]]
    .assert_eq(&run("G50 S1200\n", "G50 S9000\n").stdout);
    expect![[r#"
        the spindle differs, once
          - a.nc:8  clockwise, 200 m/min, at most 1200 rpm   | G1 X0. F0.2
          + b.nc:7  clockwise, 200 m/min without a limit   | G1 X0. F0.2
        a.nc and b.nc move along the same path, within 0.001 mm, with differences
    "#]]
    .assert_eq(&run("G50 S1200\n", "").stdout);
}

#[test]
fn a_line_in_pieces_is_the_line() {
    same("G1 X10. Y10. Z-3.\nX0.", "G1 X5. Y5. Z-2.\nX7.5 Y7.5 Z-2.5\nX10. Y10. Z-3.\nX6.\nX3.\nX0.");
    same("G0 Z10.", "G0 Z5.\nG0 Z10.");
}

#[test]
fn an_arc_is_the_same_by_radius_and_by_centre() {
    same("G2 X10. Y10. I10.", "G2 X10. Y10. R10.");
    same("G3 X10. Y-10. R-10.", "G3 X10. Y-10. J-10.");
}

#[test]
fn an_arc_in_pieces_is_the_arc() {
    same("G2 I10.", "G2 X20. I10.\nX0. I-10.");
    same("G3 X10. Y-10. I10.", "G3 X2.928932 Y-7.071068 I10.\nX10. Y-10. R10.");
    same("G2 I10. Z-5.", "G2 X20. I10. Z-3.\nX0. I-10. Z-5.");
}

#[test]
fn chords_that_stay_close_are_the_arc() {
    // A hundredth of a degree on a radius of 10 m leaves the chord within a ten-thousandth.
    same("G2 X1.745329 Y0. R10000.", "G1 X1.745329 Y0.");
    assert!(different("G2 X10. Y10. I10.", "G1 X10. Y10.").contains("the paths part at X0 Y0 Z-1"));
}

#[test]
fn a_cycle_is_its_moves() {
    same(
        "G0 Z5.\nG99 G82 X10. Y0. Z-6. R2. P500 F80.\nX20.\nG80",
        "G0 Z5.\nX10.\nZ2.\nG1 Z-6. F80.\nG4 P500\nG0 Z2.\nX20.\nG1 Z-6.\nG4 P500\nG0 Z2.",
    );
}

#[test]
fn a_table_that_one_program_writes_is_a_difference() {
    let cut = "G1 X10. F100.\nY5.";
    for write in ["G10 L2 P1 X5. Y0. Z0.\n", "#5221=5.\n", "G10 L10 P1 R120.\nG43 H1 Z-1.\n"] {
        let program = program(&format!("{write}{cut}"));
        assert_eq!(diff(&program, &program, "").code, 0, "{write}");
    }
    expect![[r#"
        the work offset differs, once
          - a.nc:8  G54 as the control has it   | G1 X10. F100.
          + b.nc:9  G54 at X5 mm Y0 mm Z0 mm of the machine   | G1 X10. F100.
        a.nc and b.nc move along the same path, within 0.001 mm, with differences
        some cutting moves start or end at unknown coordinates, which were not compared
    "#]]
    .assert_eq(&different(cut, &format!("G10 L2 P1 X5. Y0. Z0.\n{cut}")));
    expect![[r#"
        the work offset differs, once
          - a.nc:8  G54 as the control has it   | G1 X10. F100.
          + b.nc:9  G54 at X5 mm of the machine   | G1 X10. F100.
        a.nc and b.nc move along the same path, within 0.001 mm, with differences
        some cutting moves start or end at unknown coordinates, which were not compared
    "#]]
    .assert_eq(&different(cut, &format!("#5221=5.\n{cut}")));
    expect![[r#"
        the paths part at X0 Y0 Z-1
          - a.nc:8  to X10 Y0 Z-1   | G1 X10. F100.
          + b.nc:9  to X0 Y0 Z-1   | G43 H1 Z-1.
        a.nc and b.nc move differently; what follows is not compared
        some cutting moves start or end at unknown coordinates, which were not compared
    "#]]
    .assert_eq(&different(cut, &format!("G10 L10 P1 R120.\nG43 H1 Z-1.\n{cut}")));
    same(cut, &format!("G54\n{cut}"));
}

#[test]
fn units_and_increments_make_no_difference() {
    same("G1 X25.4 F254.\nY-50.8", "G20 G1 X1. F10.\nG91 Y-2.\nG90 G21");
}

#[test]
fn a_local_shift_is_the_place_it_leads_to() {
    same("G1 X15. Y5.", "G52 X10.\nG1 X5. Y5.\nG52 X0.");
}

#[test]
fn paths_that_part_end_the_comparison() {
    expect![[r"
        the paths part at X10 Y0 Z-1
          - a.nc:9  to X10 Y5 Z-1   | Y5.
          + b.nc:9  to X10 Y6 Z-2   | Y6. Z-2.
        a.nc and b.nc move differently; what follows is not compared
    "]]
    .assert_eq(&different("G1 X10.\nY5.\nX3.", "G1 X10.\nY6. Z-2.\nX4."));
}

#[test]
fn a_circle_the_other_way_round_is_another_path() {
    let text = different("G2 I10.", "G3 I10.");
    assert!(text.contains("the paths part at X0 Y0 Z-1"), "{text}");
}

#[test]
fn one_that_goes_on_is_another_path() {
    expect![[r#"
        the paths part at X10 Y0 Z-1
          - a.nc:8  has no moves left   | G1 X10.
          + b.nc:9  to X20 Y0 Z-1   | X20.
        a.nc and b.nc move differently; what follows is not compared
    "#]]
    .assert_eq(&different("G1 X10.", "G1 X10.\nX20."));
}

#[test]
fn down_before_across_is_another_way_than_across_before_down() {
    let a = "%\nO1\nG21 G90 G54\nT1 M6\nG0 X0. Y0.\nG43 H1 Z5.\nM30\n%\n";
    let b = "%\nO1\nG21 G90 G54\nT1 M6\nG43 H1 Z5.\nG0 X0. Y0.\nM30\n%\n";
    assert_eq!(diff(a, b, "").code, 1);
}

#[test]
fn settings_that_differ_are_told_once_each_time_they_begin() {
    expect![[r#"
        the feed differs, 2 times
          - a.nc:8  100 mm/min   | G1 X10. F100.
          + b.nc:8  120 mm/min   | M8 G1 X10. F120.
          - a.nc:11  100 mm/min   | X30.
          + b.nc:11  90 mm/min   | X30. F90.
        the spindle differs, once
          - a.nc:10  clockwise, 1000 rpm   | X20.
          + b.nc:10  clockwise, 900 rpm   | X20. F100. S900
        coolant differs, once
          - a.nc:8  no coolant   | G1 X10. F100.
          + b.nc:8  flood   | M8 G1 X10. F120.
        a.nc and b.nc move along the same path, within 0.001 mm, with differences
    "#]]
    .assert_eq(&different(
        "G1 X10. F100.\nX15.\nX20.\nX30.",
        "M8 G1 X10. F120.\nX15.\nX20. F100. S900\nX30. F90.",
    ));
}

#[test]
fn offsets_and_tools_that_differ_are_told() {
    expect![[r"
        the tool differs, 2 times
          - a.nc:8  change to T2   | T2 M6
          + b.nc:8  change to T3   | T3 M6
          - a.nc:9  T2   | G0 X10. Y0.
          + b.nc:9  T3   | G55 G0 X10. Y0.
        the work offset differs, once
          - a.nc:9  G54   | G0 X10. Y0.
          + b.nc:9  G55   | G55 G0 X10. Y0.
        the tool length offset differs, once
          - a.nc:10  H2   | G43 H2 Z5.
          + b.nc:10  H3   | G43 H3 Z5.
        a.nc and b.nc move along the same path, within 0.001 mm, with differences
    "]]
    .assert_eq(&different(
        "T2 M6\nG0 X10. Y0.\nG43 H2 Z5.\nG1 Z-1. F100.",
        "T3 M6\nG55 G0 X10. Y0.\nG43 H3 Z5.\nG1 Z-1. F100.",
    ));
}

#[test]
fn dwells_and_stops_are_matched_with_each_other() {
    expect![[r"
        dwells differ, once
          - a.nc:9  dwell 0.5 s   | G4 P500
          + b.nc:9  dwell 1 s   | G4 P1000
        stops differ, once
          - a.nc  nothing
          + b.nc:10  stop   | M0
        a.nc and b.nc move along the same path, within 0.001 mm, with differences
    "]]
    .assert_eq(&different("G1 X10.\nG4 P500\nX20.", "G1 X10.\nG4 P1000\nM0\nX20."));
}

#[test]
fn rows_of_data_are_matched_with_each_other() {
    let table = |rows: &str| format!("G10 L50\n{rows}\nG11\nG1 X10.");
    expect![[r#"
        other commands differ, 3 times
          - a.nc:9  row of data N1320 P1 R500000   | N1320 P1 R500000
          + b.nc:9  row of data N1320 P1 R600000   | N1320 P1 R600000
          - a.nc:10  row of data N1321 P1 R7   | N1321 P1 R7
          + b.nc  nothing
          - a.nc  nothing
          + b.nc:11  row of data N1323 P1 R2   | N1323 P1 R2
        a.nc and b.nc move along the same path, within 0.001 mm, with differences
    "#]]
    .assert_eq(&different(
        &table("N1320 P1 R500000\nN1321 P1 R7\nN1322 P1 R1"),
        &table("N1320 P1 R600000\nN1322 P1 R1.0\nN1323 P1 R2"),
    ));
    // The hand of the writer, the order of words, the numbers of commands, and the unit around them do not matter.
    same(
        "N5 G10 L50\nN1320 P1 R500000\nN6 G11\nG1 X10.",
        "G10 L50 (LIMITS)\nN1320 R500000. P1\nG11\nG1 X10.",
    );
    same(&table("N1320 P1 R5"), &table("R5 P1 N1320"));
    // Rows of a number that is not listed are rows too, where a code ends them.
    expect![[r#"
        other commands differ, once
          - a.nc:9  row of data N1320 P1 R5   | N1320 P1 R5
          + b.nc:9  row of data N1320 P1 R50   | N1320 P1 R50
        a.nc and b.nc move along the same path, within 0.001 mm, with differences
    "#]]
    .assert_eq(&different("G10 L75\nN1320 P1 R5\nG11\nG1 X10.", "G10 L75\nN1320 P1 R50\nG11\nG1 X10."));
    same(
        "#1=1320\nWHILE [#1 LT 1322] DO1\nG10 L50\nN#1 P1 R[#1*2]\nG11\n#1=#1+1\nEND1\nG1 X10.",
        &table("N1320 P1 R2640\nG11\nG10 L50\nN1321 P1 R2642"),
    );
    // What is not known is not compared, and the verdict names it.
    let run = diff(&program(&table("N1320 P1 R#500")), &program(&table("N1320 P1 R5")), "");
    expect![[r#"
        a.nc and b.nc make the machine do the same as far as known, within 0.001 mm
        not compared: R#500 (a.nc:9)
    "#]]
    .assert_eq(&run.stdout);
}

#[test]
fn a_row_more_at_the_head_of_a_long_table_is_one_difference() {
    let rows = |from: usize| (from..3000).map(|n| format!("N{n} R1")).collect::<Vec<_>>().join("\n");
    let table = |rows: &str| format!("G10 L50\n{rows}\nG11\nG1 X10.");
    expect![[r#"
        other commands differ, once
          - a.nc:9  row of data N1 R1   | N1 R1
          + b.nc  nothing
        a.nc and b.nc move along the same path, within 0.001 mm, with differences
    "#]]
    .assert_eq(&different(&table(&rows(1)), &table(&rows(2))));
}

#[test]
fn rapid_in_place_of_feed_is_no_small_thing() {
    let text = different("G1 X10.", "G0 X10.");
    assert!(text.contains("the path is the same but driven differently, once"), "{text}");
}

#[test]
fn the_tolerance_is_a_choice() {
    let (a, b) = (program("G1 X10. Y10."), program("G1 X10. Y10.005"));
    assert_eq!(diff(&a, &b, "").code, 1);
    assert_eq!(diff(&a, &b, "--tolerance 0.01").code, 0);
    assert_eq!(diff(&a, &b, "--tolerance -1").code, 2);
}

#[test]
fn the_programs_may_be_of_two_controls() {
    let a = "%\nO1\nG21 G90 G17 G94\nT1 M6\nG54 G0 X0. Y0. S1000 M3\nG43 H1 Z5.\nG81 G99 X10. Z-5. R2. F100.\nX20.\nG80\nM30\n%\n";
    let b =
        "G21 G90 G17 G94\nT1 M6\nG54 G0 X0 Y0 S1000 M3\nG43 H1 Z5\nG81 G99 X10 Z-5 R2 F100\nX20\nG80\nM30\n";
    let shop = Shop::with(&[("a.nc", a), ("b.ngc", b), ("gcheck.toml", "[tools]\n1 = { length = 0.0 }\n")]);
    let run =
        shop.gcheck("diff a.nc b.ngc -q --control haas-mill --control-b linuxcnc --config machine.units=mm");
    assert_eq!((run.code, run.stderr.as_str()), (0, ""), "{}", run.stdout);
}

#[test]
fn a_run_that_does_not_come_to_its_end_is_no_verdict() {
    let (good, bad) = (program("G1 X10.\nX20."), program("G1 X10.\nG2 X20. I1.\nX30."));
    let run = diff(&good, &bad, "");
    assert_eq!(run.code, 2);
    assert!(run.stderr.contains("error: b.nc:9:1: "), "{}", run.stderr);
    assert!(run.stdout.contains("are compared up to where a run ends before its program"), "{}", run.stdout);
    let endless = program("N1 G1 X10.\nX0.\nGOTO 1");
    let run = diff(&endless, &endless, "--fuel 1000");
    assert_eq!(run.code, 2, "{}", run.stdout);
    assert_eq!(diff("", "", "").code, 2);
}

#[test]
fn commands_that_are_not_compared_are_named_where_the_programs_differ_in_them() {
    let cut = "G1 X10. F100.\nY5.\nX0.";
    let (a, b) = (program(cut), program(&format!("M51\nM131\nM10\nG10 L12 P1 R4.\n{cut}\n/M51\nM51")));
    let run = diff(&a, &b, "");
    expect![[r#"
        a.nc and b.nc make the machine do the same as far as known, within 0.001 mm
        not compared: G10 L12 (b.nc:11), M10 (b.nc:10), M51 (3 times from b.nc:8 on), M131 (b.nc:9)
    "#]]
    .assert_eq(&run.stdout);
    assert_eq!(run.code, 0);
    let json: Value = serde_json::from_str(&diff(&a, &b, "--output-format json").stdout).unwrap();
    assert_eq!(json["not_compared"].as_array().unwrap().len(), 4, "{json:#}");
    assert_eq!(
        json["not_compared"][2],
        serde_json::json!({
            "code": "M51", "a": null,
            "b": { "count": 3, "first": { "file": "b.nc", "line": 8, "text": "M51" } },
        }),
        "{json:#}"
    );
    // Both have them: then there is nothing to say.
    same(&format!("M51\n{cut}\nG10 L12 P1 R4."), &format!("G10 L12 P1 R4.0\nM51\n{cut}"));
    let run =
        diff(&program(&format!("G10 L12 P1 R4.\n{cut}")), &program(&format!("G10 L12 P1 R5.\n{cut}")), "");
    assert!(run.stdout.ends_with("not compared: G10 L12 (a.nc:8, b.nc:8)\n"), "{}", run.stdout);
}

#[test]
fn what_a_loop_or_a_subprogram_executes_counts_as_often_as_it_does() {
    let looped = "#1=0\nWHILE [#1 LT 2] DO1\nM51\nG1 X[10.+#1] F100.\n#1=#1+1\nEND1";
    same(looped, "M51\nG1 X10. F100.\nM51\nX11.");
    let run = diff(&program(looped), &program("M51\nG1 X10. F100.\nX11."), "");
    assert!(run.stdout.ends_with("not compared: M51 (a.nc:10)\n"), "{}", run.stdout);
}

#[test]
fn computed_words_of_commands_count_with_the_values_of_the_run() {
    let cut = "G1 X10. F100.";
    same(&format!("#100=1.\nM170 P#100\n{cut}"), &format!("{cut}\n#100=3.\n#100=#100-2.\nM170 P#100"));
    same(&format!("#100=1.\nM170 P#100\n{cut}"), &format!("M170 P1\n{cut}"));
    same(&format!("#100=51\nM#100\n{cut}"), &format!("M51\n{cut}"));
    let verdict = |a: &str, b: &str| {
        let run = diff(&program(&format!("{a}\n{cut}")), &program(&format!("{b}\n{cut}")), "--strict");
        format!("{} {}", run.code, run.stdout.lines().last().unwrap_or_default())
    };
    assert_eq!(
        verdict("#100=1.\nM170 P#100", "#100=2.\nM170 P#100"),
        "1 not compared: M170 (a.nc:9, b.nc:9)"
    );
    assert_eq!(verdict("#100=51\nM#100", "#100=10\nM#100"), "1 not compared: M10 (b.nc:9), M51 (a.nc:9)");
    // What an earlier program left in a variable is not known.
    assert_eq!(verdict("M170 P#500", "M170 P#500"), "1 not compared: M170 (a.nc:8, b.nc:8)");
}

#[test]
fn values_that_nobody_knows_are_not_called_equal() {
    let verdict = |a: &str, b: &str, arguments: &str| {
        let run = diff(&program(a), &program(b), &format!("--strict {arguments}"));
        format!("{} {}", run.code, run.stdout.lines().last().unwrap_or_default())
    };
    let [a, b] = ["1.", "2."].map(|by| format!("G1 X10. F[#500+{by}]\nY5."));
    assert_eq!(verdict(&a, &b, ""), "1 not compared: F[#500+1.] (a.nc:8), F[#500+2.] (b.nc:8)");
    // The variable may be another one when the other program runs.
    assert_eq!(verdict(&a, &a, ""), "1 not compared: F[#500+1.] (a.nc:8, b.nc:8)");
    let [a, b] = ["1.", "2."].map(|by| format!("G0 Z5.\nG0 Y[#500+{by}]\nG4 P#501\nG0 X0. Y0."));
    let told = "1 not compared: P#501 (a.nc:10, b.nc:10), Y[#500+1.] (a.nc:9), Y[#500+2.] (b.nc:9)";
    assert_eq!(verdict(&a, &b, ""), told);
    let same = "0 a.nc and b.nc make the machine do the same, within 0.001 mm";
    assert_eq!(verdict("#500=1.\nG1 X10. F[#500+99.]", "G1 X10. F100.", ""), same);
    assert_eq!(verdict("G1 X10. F[#500+99.]", "G1 X10. F100.", "--set 500=1"), same);
}

#[test]
fn a_section_that_is_added_or_moved_is_one_difference() {
    let tool = |number: u32, name: &str, x: u32| {
        format!(
            "({name})\nT{number} M6\nG54 G0 X{x}. Y0. S1000 M3\nG43 H{number} Z5.\nG1 Z-1. F100.\nY20.\nG0 Z50.\n"
        )
    };
    let whole = |tools: &[(u32, &str, u32)]| {
        let tools: String = tools.iter().map(|(number, name, x)| tool(*number, name, *x)).collect();
        format!("%\nO1\nG21 G17 G90 G94\n{tools}G91 G28 Z0.\nG28 X0. Y0.\nM30\n%\n")
    };
    let (side, drill, tap, burr) = ((1, "SIDE", 10), (2, "DRILL", 20), (3, "TAP", 30), (5, "DEBURR", 40));
    let old = whole(&[side, drill, tap]);
    let run = diff(&old, &whole(&[side, burr, drill, tap]), "");
    expect![[r#"
        tool section T5 (DEBURR) is only in b.nc, lines 12 to 17
        a.nc and b.nc do not have the same sections in the same order; those that both have make the machine do the same, within 0.001 mm
    "#]].assert_eq(&run.stdout);
    assert_eq!(run.code, 1);
    let moved = whole(&[tap, side, (2, "DRILL", 21)])
        .replace("F100.\nY20.\nG0 Z50.\n(SIDE)", "F90.\nY20.\nG0 Z50.\n(SIDE)");
    let run = diff(&old, &moved, "");
    expect![[r#"
        tool section T3 (TAP) moved from place 3 (a.nc, lines 19 to 26) to place 1 (b.nc, lines 5 to 10)
        tool section T2 (DRILL) changed: the paths part at X10 Y20 Z50
          - a.nc:13  to X20 Y0 Z50   | G54 G0 X20. Y0. S1000 M3
          + b.nc:20  to X21 Y0 Z50   | G54 G0 X21. Y0. S1000 M3
        the feed differs, once
          - a.nc:22  100 mm/min   | G1 Z-1. F100.
          + b.nc:8  90 mm/min   | G1 Z-1. F90.
        a.nc and b.nc move differently; from there to the next tool change they are not compared
    "#]]
    .assert_eq(&run.stdout);
    let json: Value = serde_json::from_str(&diff(&old, &moved, "--output-format json").stdout).unwrap();
    expect![[r#"
        "tools"
        {"a":{"first":{"file":"a.nc","line":19,"text":"T3 M6"},"last":26,"name":"TAP","place":3,"tool":3},"b":{"first":{"file":"b.nc","line":5,"text":"T3 M6"},"last":10,"name":"TAP","place":1,"tool":3},"change":"section-moved","compared":true}
        {"first":{"file":"a.nc","line":12,"text":"T2 M6"},"last":17,"name":"DRILL","place":2,"tool":2}
    "#]].assert_eq(&format!(
        "{}\n{}\n{}\n",
        json["sections_by"], json["sections"][0], json["parting"]["section"]["a"]
    ));
}

#[test]
fn operations_are_the_sections_of_a_program_with_one_tool() {
    let operation = |name: &str, x: u32| format!("({name})\nG0 X{x}. Y0.\nG1 Z-1. F100.\nY20.\nG0 Z5.");
    let [rough, finish, engrave] =
        [("ROUGH", 10), ("FINISH", 20), ("ENGRAVE", 30)].map(|(name, x)| operation(name, x));
    let run = diff(
        &program(&format!("G0 Z5.\n{rough}\n{finish}")),
        &program(&format!("G0 Z5.\n{rough}\n{engrave}\n{finish}")),
        "",
    );
    expect![[r#"
        operation (ENGRAVE) is only in b.nc, lines 15 to 18
        a.nc and b.nc do not have the same sections in the same order; those that both have make the machine do the same, within 0.001 mm
    "#]].assert_eq(&run.stdout);
}

#[test]
fn the_help_of_diff_says_what_the_verdict_is_about() {
    let run = Shop::new().gcheck("diff --help");
    assert!(
        run.stdout.contains("the same as far as known") && run.stdout.contains("G10 L12"),
        "{}",
        run.stdout
    );
}

#[test]
fn json_holds_places_lines_and_values() {
    let (a, b) = (program("G1 X10. F100.\nX20."), program("G1 X10. F120.\nX21."));
    let run = diff(&a, &b, "--output-format json");
    let all: Value = serde_json::from_str(&run.stdout).unwrap();
    assert_eq!((run.code, &all["same"], &all["version"]), (1, &Value::Bool(false), &1.into()));
    assert_eq!(all["differences"][0]["aspect"], "feed");
    assert_eq!(all["differences"][0]["first"][0]["value_b"], "120 mm/min");
    assert_eq!(
        all["parting"]["b"],
        serde_json::json!({ "file": "b.nc", "line": 9, "text": "X21." }),
        "{all:#}"
    );
}

#[test]
fn missing_files_and_two_standard_inputs_are_errors() {
    let shop = Shop::with(&[("a.nc", "M30\n")]);
    assert_eq!(shop.gcheck("diff a.nc b.nc").code, 2);
    assert_eq!(shop.gcheck("diff - -").code, 2);
}

/// Moves to where the axes are already, before the first that is known: a program is always the same as itself.
#[test]
fn a_program_is_the_same_as_itself() {
    for program in [
        "G20 G90\nG0 X0 Y0\nT1 M6\nG0 G54 X1. Y0.\nG43 H1 Z1.\nG1 Z-1. F10.\nX2.\nG53 G0 Z0.\nG4 P2\nM30\n",
        "G91 G28 Z0\nT1 M6\nG91 G28 X0 Y0\nG90 G0 X1. Y1.\nM30\n",
    ] {
        for control in ["haas-mill", "linuxcnc", "fanuc-mill"] {
            let shop = Shop::with(&[("a.nc", program)]);
            let run = shop.gcheck(&format!("diff a.nc a.nc -q --control {control}"));
            assert_eq!(run.code, 0, "{control}: {}{}", run.stdout, run.stderr);
        }
    }
}

/// Two programs that differ in the line that decides how corners are taken.
fn corners(control: &str, program: &str, [a, b]: [&str; 2]) -> String {
    let shop = Shop::with(&[("a.nc", &program.replace('#', a)), ("b.nc", &program.replace('#', b))]);
    let run = shop.gcheck(&format!("diff a.nc b.nc -q --control {control}"));
    format!("{}{}exit {}\n", run.stdout, run.stderr, run.code)
}

const SQUARE: &str = "G21 G90 G17 G94 G54\n#\nG0 X0 Y0 Z5\nG1 Z-1 F100\nX10 F500\nY10\nX9.9\nY0\nG0 Z5\nM2\n";

#[test]
fn tolerances_of_blending_say_by_how_much_a_corner_may_differ() {
    expect![[r#"
        how corners are taken differs, once
          - a.nc:4  corners blended within 0.5 mm   | G1 Z-1 F100
          + b.nc:4  corners blended within 0.01 mm   | G1 Z-1 F100
          the paths may differ at 4 corners: by up to 0.5 mm at X0 Y0 Z-1 (a.nc:5)
        a.nc and b.nc move along the same path, within 0.001 mm, with differences
        exit 1
    "#]]
    .assert_eq(&corners("linuxcnc", SQUARE, ["G64 P0.5", "G64 P0.01"]));
    expect![[r#"
        how corners are taken differs, once
          - a.nc:4  exact stop   | G1 Z-1 F100
          + b.nc:4  corners blended within 0.2 mm, segments joined within 0.05 mm   | G1 Z-1 F100
          the paths may differ at 4 corners: by up to 0.2 mm at X0 Y0 Z-1 (a.nc:5)
        a.nc and b.nc move along the same path, within 0.001 mm, with differences
        exit 1
    "#]]
    .assert_eq(&corners("linuxcnc", SQUARE, ["G61.1", "G64 P0.2 Q0.05"]));
    // Both stop, or pass, every point of the path.
    expect![[r#"
        how corners are taken differs, once
          - a.nc:4  exact path   | G1 Z-1 F100
          + b.nc:4  exact stop   | G1 Z-1 F100
        a.nc and b.nc move along the same path, within 0.001 mm, with differences
        exit 1
    "#]]
    .assert_eq(&corners("linuxcnc", SQUARE, ["G61", "G61.1"]));
    // Both programs blend until one of them says otherwise.
    expect![[r#"
        a.nc and b.nc make the machine do the same, within 0.001 mm
        exit 0
    "#]]
    .assert_eq(&corners("linuxcnc", SQUARE, ["G64", ""]));
}

#[test]
fn smoothing_contour_control_and_exact_stop_of_one_block_are_compared() {
    let inches = SQUARE.replace("G21", "G20").replace("X0 Y0 Z5", "X0. Y0. Z5.");
    expect![[r#"
        how corners are taken differs, once
          - a.nc:4  corners blended without a tolerance, smoothing level 1   | G1 Z-1 F100
          + b.nc:4  corners blended without a tolerance, smoothing level 3, smoothing within 0.002 inch   | G1 Z-1 F100
          the paths may differ at 4 corners, the first at X0 Y0 Z-0.0001 (a.nc:5): a program gives no tolerance, so the control decides by how much
        a.nc and b.nc move along the same path, within 0.001 mm, with differences
        assumed: numbers without a decimal point count as the control usually reads them (Setting 162)
        exit 1
    "#]].assert_eq(&corners("haas-mill", &inches, ["G187 P1", "G187 P3 E0.002"]));
    expect![[r#"
        how corners are taken differs, once
          - a.nc:4  corners blended without a tolerance, smoothing within 0.01 inch   | G1 Z-1 F100
          + b.nc:4  corners blended without a tolerance, smoothing within 0.002 inch   | G1 Z-1 F100
          the paths may differ at 4 corners: by up to 0.00021 inch at X0 Y0 Z-0.0001 (a.nc:5)
        a.nc and b.nc move along the same path, within 0.001 mm, with differences
        assumed: numbers without a decimal point count as the control usually reads them (Setting 162)
        exit 1
    "#]]
    .assert_eq(&corners("haas-mill", &inches, ["G187 E0.01", "G187 E0.002"]));
    let contour = SQUARE.replace("Z5", "Z5.");
    expect![[r#"
        how corners are taken differs, once
          - a.nc:4  corners blended without a tolerance, contour control, level 1   | G1 Z-1 F100
          + b.nc:4  corners blended without a tolerance, contour control, level 10   | G1 Z-1 F100
          the paths may differ at 4 corners, the first at X0 Y0 Z-0.001 (a.nc:5): a program gives no tolerance, so the control decides by how much
        a.nc and b.nc move along the same path, within 0.001 mm, with differences
        assumed: numbers without a decimal point count as the control usually reads them (parameter 3401#0)
        exit 1
    "#]].assert_eq(&corners("fanuc-mill", &contour, ["G5.1 Q1 R1.", "G5.1 Q1 R10."]));
    let once = "G21 G90 G17 G94 G54\nG0 X0. Y0. Z5.\nG1 Z-1. F100.\n# X10. F500.\nY10.\nG0 Z5.\nM30\n";
    expect![[r#"
        how corners are taken differs, once
          - a.nc:4  exact stop   | G9 X10. F500.
          + b.nc:4  corners blended without a tolerance   | X10. F500.
          the paths may differ at 1 corner, the first at X0 Y0 Z-1 (a.nc:4): a program gives no tolerance, so the control decides by how much
        a.nc and b.nc move along the same path, within 0.001 mm, with differences
        exit 1
    "#]].assert_eq(&corners("fanuc-mill", once, ["G9", ""]));
}

/// What is unknown of a coordinate is not compared, where it leads as far as the moves that it is a part of.
#[test]
fn a_coordinate_that_nobody_knows_does_not_part_the_paths() {
    for (a, b) in [
        ("G1 X#500\nG91 X10.\nG90", "G1 X5.\nG91 X10.\nG90"),
        ("G1 X#500\nG91 X10.\nG90 Y5.", "G1 X#500\nG91 X10.\nG90 Y5."),
        ("G1 X#500\nG91 X10.\nG90 X20.\nY5.", "G1 X15.\nG91 X10.\nG90 X20.\nY5."),
        ("G1 X#500\nX7.\nY3.", "G1 X4.\nX7.\nY3."),
    ] {
        for (a, b) in [(a, b), (b, a)] {
            let run = diff(&program(a), &program(b), "");
            assert!(run.code == 0 && run.stdout.contains("as far as known"), "{a} / {b}: {run}");
            assert!(run.stdout.contains("not compared: X#500"), "{run}");
            assert_eq!(diff(&program(a), &program(b), "--strict").code, 1);
        }
    }
    // What is known on both sides still is.
    for (a, b) in [
        ("G1 X#500\nY3.", "G1 X4.\nY4."),
        ("G1 X#500\nX7.", "G1 X4.\nX8."),
        ("G1 X#500\nG91 X10.\nG90 Y3.", "G0 X4.\nG91 X10.\nG90 Y3."),
        ("G1 X#500 F100.\nG91 X10.", "G1 X5. F150.\nG91 X10."),
    ] {
        let run = diff(&program(a), &program(b), "");
        assert_eq!(run.code, 1, "{a} / {b}: {run}");
    }
}

#[test]
fn a_setting_that_decides_how_numbers_count_is_named() {
    let (point, none) = (program("G1 X15."), program("G1 X15000"));
    let run = diff(&point, &none, "");
    assert_eq!(
        (run.code, run.stdout.as_str()),
        (
            0,
            "a.nc and b.nc make the machine do the same, within 0.001 mm\n\
             assumed: numbers without a decimal point count as the control usually reads them (parameter 3401#0)\n"
        )
    );
    let json = diff(&point, &none, "--output-format json").json();
    assert_eq!(json["assumptions"].as_array().unwrap().len(), 1);
    assert!(!diff(&point, &point, "").stdout.contains("assumed"));
}
