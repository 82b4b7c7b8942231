//! `gcheck run`: formats, what is given on the command line and in `gcheck.toml`, how it ends.

use expect_test::{Expect, expect};

use crate::shop::{Run, Shop};

/// A square corner and an arc, for a control that starts at zero.
const PART: &str = "\
(PART)
N10 G21 G90 F200
N20 G0 X10 Y5
N30 G1 Z-1.5
N40 G3 X20 Y15 J10
N50 M30
";

fn run(program: &str, arguments: &str) -> Run {
    let shop = Shop::with(&[("part.ngc", program)]);
    shop.gcheck(&format!("run part.ngc --isolated --control linuxcnc --quiet {arguments}"))
}

fn check(program: &str, arguments: &str, expected: &Expect) {
    expected.assert_eq(&run(program, arguments).to_string());
}

#[test]
fn text_is_for_people() {
    check(
        PART,
        "",
        &expect![[r#"
            part.ngc, mm
               line  move             X          Y          Z       feed   seconds
                  3  rapid      10.0000     5.0000     0.0000                0.024
                  4  feed       10.0000     5.0000    -1.5000        200     0.450
                  5  arc        20.0000    15.0000    -1.5000        200     4.712  ccw 90 deg about X10 Y15
                  6  spindle                                                        stop
                  6  end
            exit 0
        "#]],
    );
}

#[test]
fn canonical_functions_are_numbered_by_their_blocks() {
    check(
        PART,
        "--output-format canonical",
        &expect![[r#"
                1 N..... USE_LENGTH_UNITS(CANON_UNITS_MM)
                2 N..... SET_G5X_OFFSET(1, 0.0000, 0.0000, 0.0000, 0.0000, 0.0000, 0.0000)
                3 N..... SET_G92_OFFSET(0.0000, 0.0000, 0.0000, 0.0000, 0.0000, 0.0000)
                4 N..... SET_XY_ROTATION(0.0000)
                5 N..... SET_FEED_REFERENCE(CANON_XYZ)
                6 N..... ON_RESET()
                7 N10    SET_FEED_RATE(200.0000)
                8 N10    USE_LENGTH_UNITS(CANON_UNITS_MM)
                9 N20    STRAIGHT_TRAVERSE(10.0000, 5.0000, 0.0000, 0.0000, 0.0000, 0.0000)
               10 N30    STRAIGHT_FEED(10.0000, 5.0000, -1.5000, 0.0000, 0.0000, 0.0000)
               11 N40    ARC_FEED(20.0000, 15.0000, 10.0000, 15.0000, 1, -1.5000, 0.0000, 0.0000, 0.0000)
               12 N50    SET_G5X_OFFSET(1, 0.0000, 0.0000, 0.0000, 0.0000, 0.0000, 0.0000)
               13 N50    SET_XY_ROTATION(0.0000)
               14 N50    SET_FEED_MODE(0, 0)
               15 N50    SET_FEED_RATE(0.0000)
               16 N50    STOP_SPINDLE_TURNING(0)
               17 N50    SET_SPINDLE_MODE(0 0.0000)
               18 N50    PALLET_SHUTTLE()
               19 N50    PROGRAM_END()
               20 N..... ON_RESET()
               21 N..... ON_RESET()
            exit 0
        "#]],
    );
}

#[test]
fn json_lines_have_every_axis() {
    check(
        PART,
        r#"--output-format jsonl --config machine.axes=["X","Y","Z"]"#,
        &expect![[r#"
            {"n":1,"file":"part.ngc","line":3,"kind":"rapid","units":"mm","from":{"X":0.0,"Y":0.0,"Z":0.0},"programmed":{"X":10.0,"Y":5.0,"Z":0.0},"to":{"X":10.0,"Y":5.0,"Z":0.0},"machine":{"X":10.0,"Y":5.0,"Z":0.0},"feed":null,"feed_mode":null,"seconds":0.023622}
            {"n":2,"file":"part.ngc","line":4,"kind":"feed","units":"mm","from":{"X":10.0,"Y":5.0,"Z":0.0},"programmed":{"X":10.0,"Y":5.0,"Z":-1.5},"to":{"X":10.0,"Y":5.0,"Z":-1.5},"machine":{"X":10.0,"Y":5.0,"Z":-1.5},"feed":200.0,"feed_mode":"per-minute","seconds":0.45}
            {"n":3,"file":"part.ngc","line":5,"kind":"arc","units":"mm","from":{"X":10.0,"Y":5.0,"Z":-1.5},"programmed":{"X":20.0,"Y":15.0,"Z":-1.5},"to":{"X":20.0,"Y":15.0,"Z":-1.5},"machine":{"X":20.0,"Y":15.0,"Z":-1.5},"feed":200.0,"feed_mode":"per-minute","arc":{"centre":{"X":10.0,"Y":15.0,"Z":-1.5},"normal":{"X":0,"Y":0,"Z":1},"sweep_deg":90.0},"seconds":4.712389}
            {"n":4,"file":"part.ngc","line":6,"kind":"spindle","units":"mm","action":"stop","seconds":0.0}
            {"n":5,"file":"part.ngc","line":6,"kind":"end","units":"mm","seconds":0.0}
            exit 0
        "#]],
    );
}

#[test]
fn csv_has_a_heading() {
    check(
        PART,
        r#"--output-format csv --config machine.axes=["X","Y","Z"]"#,
        &expect![[r#"
            n,file,line,kind,units,from_X,from_Y,from_Z,programmed_X,programmed_Y,programmed_Z,to_X,to_Y,to_Z,machine_X,machine_Y,machine_Z,feed,feed_mode,centre_X,centre_Y,centre_Z,normal,sweep_deg,seconds,action,value,text
            1,part.ngc,3,rapid,mm,0.0,0.0,0.0,10.0,5.0,0.0,10.0,5.0,0.0,10.0,5.0,0.0,,,,,,,,0.023622,,,
            2,part.ngc,4,feed,mm,10.0,5.0,0.0,10.0,5.0,-1.5,10.0,5.0,-1.5,10.0,5.0,-1.5,200.0,per-minute,,,,,,0.45,,,
            3,part.ngc,5,arc,mm,10.0,5.0,-1.5,20.0,15.0,-1.5,20.0,15.0,-1.5,20.0,15.0,-1.5,200.0,per-minute,10.0,15.0,-1.5,Z,90.0,4.712389,,,
            4,part.ngc,6,spindle,mm,,,,,,,,,,,,,,,,,,,,0.0,stop,,
            5,part.ngc,6,end,mm,,,,,,,,,,,,,,,,,,,,0.0,,,
            exit 0
        "#]],
    );
}

#[test]
fn the_control_and_what_is_assumed_are_said_beside_the_moves() {
    let shop = Shop::with(&[("part.nc", "%\nO1\nG21\nT1 M6\nG0 G54 X1.\nM1\n/X2.\nM30\n%\n")]);
    let run = shop.gcheck("run part.nc --control haas-mill");
    expect![[r#"
        part.nc, mm
           line  move             X          Y          Z       feed   seconds
              4  spindle                                                        stop
              4  tool                                                    5.000  T1
              5  rapid       1.0000          ?          ?                    ?
              7  rapid       2.0000          ?          ?                0.002
              8  spindle                                                        stop
              8  end
        ! part.nc: control haas-mill, set by `--control`
        ! assumed
        !   setting 17 (optional stop lockout) is `off`, as usual
        !   the positions of the axes at the start are not known
        !   the work offset G54 is not known
        !   block delete is off: blocks with `/` were executed
        !   the optional stop is off: `M1` was passed over
        !   in effect at the start, as at power-on: G0 G80 G17 G90 G94 G40 G49 G98 G54 G64 G50 G69 G100 G255
        ! gcheck.toml can say
        !   [settings]
        !   17 = false
        !   [offsets]
        !   G54 = { X = …, Y = …, Z = … }
        exit 0
    "#]]
    .assert_eq(&run.to_string());
    let run = shop.gcheck("run part.nc --control haas-mill --output-format jsonl");
    assert_eq!(run.stderr, "part.nc: control haas-mill, set by `--control`\n");
    let run = shop.gcheck("run part.nc --control haas-mill --quiet");
    assert_eq!(run.stderr, "");
}

#[test]
fn variables_are_set_before_the_program_starts() {
    let program = "G0 X#100 Y#<_edge>\nM2\n";
    let to = |arguments: &str| {
        let run = run(program, &format!("--output-format jsonl {arguments}"));
        let line: serde_json::Value = serde_json::from_str(run.stdout.lines().next().unwrap()).unwrap();
        (line["to"]["X"].as_f64().unwrap(), line["to"]["Y"].as_f64().unwrap())
    };
    assert_eq!(to("--set #100=2.5 --set #<_edge>=-1"), (2.5, -1.0));
    assert_eq!(to("--set 100=2.5 --set #<_Edge>=0"), (2.5, 0.0));
    assert_eq!(to("--set #<_edge>=1"), (0.0, 1.0));
    assert_eq!(to("--config variables.\"#100\"=7 --config variables.\"#<_edge>\"=8"), (7.0, 8.0));
    // What the command line says of this run wins over the configuration.
    assert_eq!(to("--set #100=1 --config variables.\"#100\"=7 --set #<_edge>=0"), (1.0, 0.0));
}

#[test]
fn a_setting_that_is_none_is_refused() {
    for (set, message) in [
        ("#100", "write `#100=2.5` or `#<name>=1`"),
        ("#x=1", "`#x` is not a variable; write `#100` or `#<name>`"),
        ("#100=much", "`much` is not a number"),
        ("#100=inf", "`inf` is not a number that a control can hold"),
    ] {
        let run = run(PART, &format!("--set {set}"));
        assert_eq!(run.code, 2, "{run}");
        assert!(run.stderr.contains(message), "{run}");
    }
}

#[test]
fn blocks_are_skipped_by_level() {
    let program = "G0 X1\n/X2\n/3 X3\nM2\n";
    let reached = |arguments: &str| {
        let shop = Shop::with(&[("part.nc", program)]);
        let run = shop.gcheck(&format!("run part.nc --control haas-mill --output-format csv {arguments}"));
        run.stdout.lines().filter(|line| line.contains(",rapid,")).count()
    };
    assert_eq!(reached(""), 3);
    assert_eq!(reached("--block-skip off"), 3);
    assert_eq!(reached("--block-skip on"), 1);
    assert_eq!(reached("--block-skip 1"), 2);
    assert_eq!(reached("--block-skip 1,3"), 1);
    assert_eq!(reached("--block-skip 2"), 3);
    let refused = run(program, "--block-skip 10");
    assert_eq!(refused.code, 2, "{refused}");
    assert!(refused.stderr.contains("write `on`, `off`, or levels from 1 to 9 such as `1,3`"), "{refused}");
}

#[test]
fn the_optional_stop_is_a_switch() {
    let stops = |arguments: &str| run("M1\nM2\n", arguments).stdout.matches("optional").count();
    assert_eq!(stops("--optional-stop on"), 1);
    assert_eq!(stops("--optional-stop off"), 0);
    assert_eq!(stops(""), 0);
    // The interpreter's form has it in any case: the switch is not the interpreter's.
    assert!(run("M1\nM2\n", "--output-format canonical").stdout.contains(" OPTIONAL_PROGRAM_STOP()"));
}

#[test]
fn an_endless_loop_runs_out_of_fuel() {
    check(
        "o1 while [1]\n  G4 P0\no1 endwhile\nM2\n",
        "--fuel 1000 --output-format csv -o moves.csv",
        &expect![[r#"
            ! error: part.ngc:1:1: the program had not ended after 1000 blocks; here gcheck stopped executing it
            !   |
            ! 1 | o1 while [1]
            !   | ^^^^^^^^^^^^
            !   note: a loop may never end, or repeats give very many moves, which count as blocks too
            !   help: `--fuel BLOCKS` allows more
            exit 1
        "#]],
    );
}

#[test]
fn a_fault_is_said_with_its_place_and_reason_behind_the_moves_before_it() {
    check(
        "G0 X1\nG1 X2\nM2\n",
        "--output-format csv -o moves.csv",
        &expect![[r#"
            ! error: part.ngc:2:1: a cut without a feed rate
            !   |
            ! 2 | G1 X2
            !   | ^^^^^
            !   note: no `F` was given since the program began, or the last change of the feed mode cleared it
            !   help: give `F` on this block or before it
            exit 1
        "#]],
    );
    check(
        "F100\nG2 X10 I1\nM2\n",
        "--output-format csv -o moves.csv",
        &expect![[r#"
            ! error: part.ngc:2:1: the end point is not on the circle of the start point
            !   |
            ! 2 | G2 X10 I1
            !   | ^^^^^^^^^
            !   note: it lies 9 mm from the centre, and the start 1 mm
            exit 1
        "#]],
    );
    check(
        "G20 F4\nG2 X10 I1\nM2\n",
        "--output-format csv -o moves.csv",
        &expect![[r#"
            ! error: part.ngc:2:1: the end point is not on the circle of the start point
            !   |
            ! 2 | G2 X10 I1
            !   | ^^^^^^^^^
            !   note: it lies 9 inch from the centre, and the start 1 inch
            exit 1
        "#]],
    );
    check(
        "#1=[1/0]\nM2\n",
        "--output-format csv -o moves.csv",
        &expect![[r#"
            ! error: part.ngc:1:1: division by zero
            !   |
            ! 1 | #1=[1/0]
            !   | ^^^^^^^^
            !   help: make sure that the divisor is not zero before this block
            exit 1
        "#]],
    );
    check(
        "G0 X1\n",
        "--output-format csv -o moves.csv",
        &expect![[r#"
            ! error: part.ngc:1:6: the program ends without an end of program
            !   |
            ! 1 | G0 X1
            !   |      ^
            !   help: write `M2` or `M30` at its end, or `%` around it
            exit 1
        "#]],
    );
}

#[test]
fn moves_before_a_fault_are_printed() {
    let shop = Shop::with(&[("part.ngc", "G0 X1\nG0 X2\nG1 Y1 R\nM2\n")]);
    let run = shop.gcheck("run part.ngc --control linuxcnc --output-format jsonl -o moves.jsonl");
    assert_eq!((run.code, run.stdout.as_str()), (1, ""), "{run}");
    assert_eq!(shop.read("moves.jsonl").lines().count(), 2);
    assert_eq!(shop.names(), ["moves.jsonl", "part.ngc"]);
}

#[test]
fn a_condition_on_something_unknown_names_it() {
    let shop = Shop::with(&[("part.nc", "%\nO1\nIF[#500GT#1]GOTO9\nN9M30\n%\n")]);
    let run = shop.gcheck("run part.nc --control haas-mill --quiet --output-format jsonl");
    expect![[r#"
        ! error: part.nc:3:1: what happens next depends on `#500`, and its value is not known
        !   |
        ! 3 | IF[#500GT#1]GOTO9
        !   | ^^^^^^^^^^^^^^^^^
        !   note: a condition, a repeat count, a target or a code is computed from it
        !   help: give the value: `--set '#500=1'`, or `[variables]`, `[offsets]`, `[tools]` in gcheck.toml
        exit 1
    "#]]
    .assert_eq(&run.to_string());
    let run =
        shop.gcheck("run part.nc --control haas-mill --quiet --set #500=1 --output-format jsonl -o moves");
    assert_eq!(run.code, 0, "{run}");
}

#[test]
fn an_alarm_of_the_program_itself_is_no_end() {
    let shop = Shop::with(&[("part.nc", "%\nO1\n#3000=12(NO PROBE)\nM30\n%\n")]);
    let run = shop.gcheck("run part.nc --control haas-mill --quiet");
    expect![[r#"
        ! error: part.nc:3:1: the program raises alarm 12 itself: NO PROBE
        !   |
        ! 3 | #3000=12(NO PROBE)
        !   | ^^^^^^^^^^^^^^^^^^
        !   note: it assigns to `#3000`, which stops the machine
        exit 1
    "#]]
    .assert_eq(&run.to_string());
}

#[test]
fn a_main_program_that_starts_over_is_run_once() {
    let shop = Shop::with(&[("part.nc", "%\nO1\nG0 X1.\nM99\n%\n")]);
    let run = shop.gcheck("run part.nc --control haas-mill --quiet --output-format csv -o moves");
    assert_eq!(run.to_string(), "exit 0\n");
}

#[test]
fn standard_input_has_the_name_that_it_is_given() {
    let shop = Shop::new();
    let program = b"G0 X1\nG1 X2\nM2\n";
    let run = shop.gcheck_reading("run - --control linuxcnc --quiet --output-format jsonl -o moves", program);
    assert!(run.stderr.starts_with("error: stdin:2:1: "), "{run}");
    let run = shop.gcheck_reading(
        "run - --stdin-filename a/part.ngc --control linuxcnc --quiet --output-format jsonl",
        program,
    );
    assert!(run.stderr.starts_with("error: a/part.ngc:2:1: "), "{run}");
    assert!(run.stdout.starts_with(r#"{"n":1,"file":"a/part.ngc","line":1,"#), "{run}");
}

#[test]
fn what_cannot_be_read_is_a_problem_of_its_own() {
    let shop = Shop::with(&[("programs/part.nc", PART)]);
    for (arguments, message) in [
        ("run missing.nc", "error: missing.nc: cannot read: no such file or directory\n"),
        ("run programs", "error: programs: is a folder; name one program\n"),
        (
            "run programs/part.nc --control hass-mill",
            "error: no control is called `hass-mill`; did you mean `haas-mill`?\n",
        ),
        ("stats missing.nc", "error: missing.nc: cannot read: no such file or directory\n"),
    ] {
        let run = shop.gcheck(arguments);
        assert_eq!((run.code, run.stderr.as_str()), (2, message), "{arguments}");
    }
    assert_eq!(shop.gcheck("run").code, 2);
    assert_eq!(shop.gcheck("run programs/part.nc programs/part.nc").code, 2);
    assert_eq!(shop.gcheck("run programs/part.nc --output-format xml").code, 2);
}

#[test]
fn the_machine_file_gives_offsets_tools_and_units() {
    let shop = Shop::with(&[
        (
            "gcheck.toml",
            "control = \"haas-mill\"\n\
             [machine]\nunits = \"mm\"\naxes = [\"X\", \"Y\", \"Z\"]\n\
             [offsets]\nG54 = { X = -400.0, Y = -200.0, Z = 0.0 }\n\"G154 P2\" = { X = -1.0, Y = -2.0, Z = -3.0 }\n\
             [tools]\n1 = { length = 120.0, diameter = 12.0 }\n",
        ),
        ("part.nc", "%\nO1\nT1 M6\nG54 G0 X10. Y20.\nG43 H1 Z5.\nG154 P2 X0. Y0.\nZ0.\nM30\n%\n"),
    ]);
    let run = shop.gcheck("run part.nc --output-format jsonl --quiet");
    assert_eq!(run.code, 0, "{run}");
    let machine: Vec<String> = run
        .stdout
        .lines()
        .map(|line| serde_json::from_str::<serde_json::Value>(line).unwrap())
        .filter(|line| line["kind"] == "rapid")
        .map(|line| line["machine"].to_string())
        .collect();
    expect![[r#"
        {"X":-390.0,"Y":-180.0,"Z":0.0}
        {"X":-390.0,"Y":-180.0,"Z":125.0}
        {"X":-1.0,"Y":-2.0,"Z":125.0}
        {"X":-1.0,"Y":-2.0,"Z":117.0}"#]]
    .assert_eq(&machine.join("\n"));
}

#[test]
fn a_tool_table_is_read_in_its_own_units() {
    let program = "T2 M6\nG43\nG0 Z0\nM2\n";
    let shop = Shop::with(&[
        ("part.ngc", program),
        ("tool.tbl", "; tools of the machine\nT1 P3 Z1 D0.5 ;mill\nt2 p7 z2.5 d+.25 I10 J20 Q3 ; drill\n"),
        ("tools.csv", "Tool;Pocket;Length;Diameter;Comment\n1;3;1;0,5;mill\nT2;7;2,5;0,25;\"a; drill\"\n"),
    ]);
    let z = |arguments: &str| {
        let run = shop
            .gcheck(&format!("run part.ngc --control linuxcnc --quiet --output-format jsonl {arguments}"));
        let line = run
            .stdout
            .lines()
            .find(|line| line.contains("rapid"))
            .unwrap_or_else(|| panic!("{run}"))
            .to_owned();
        serde_json::from_str::<serde_json::Value>(&line).unwrap()["machine"]["Z"].to_string()
    };
    assert_eq!(z("--config tools.table=tool.tbl"), "2.5");
    assert_eq!(z("--config tools.table=tool.tbl --config machine.table_units=inch"), "63.5");
    assert_eq!(z("--config tools.table=tools.csv --config machine.units=inch"), "2.5");
    assert_eq!(z("--config tools.table=tool.tbl --config tools.2.length=4"), "4.0");
    assert_eq!(z("--config tools.2.length=4 --config tools.2.offset={Z=8}"), "8.0");
}

#[test]
fn a_tool_table_with_a_mistake_is_refused_at_its_place() {
    let check = |name: &str, table: &str, expected: &str| {
        let shop = Shop::with(&[("part.ngc", PART), (name, table)]);
        let run = shop.gcheck(&format!("run part.ngc --control linuxcnc --config tools.table={name}"));
        assert_eq!(run.code, 2, "{run}");
        assert_eq!(
            run.stderr.lines().next().unwrap_or_default(),
            format!("error: {name}:{expected}"),
            "{run}"
        );
    };
    check("t.tbl", "T1 Z1\nP2 Z2\n", "2:1: a tool's line has its number: `T1`");
    check("t.tbl", "T1 Zx\n", "1:4: `Zx` is not a letter with a number");
    check("t.tbl", "T1 Z\n", "1:4: `Z` is not a letter with a number");
    check(
        "t.tbl",
        "T1 K2\n",
        "1:4: `K` says nothing of a tool; known are T, P, X, Y, Z, A, B, C, U, V, W, D, I, J and Q",
    );
    check("t.tbl", "T1.5\n", "1:1: `T1.5` must be a whole number");
    check("t.tbl", "T1 Zinf\n", "1:4: `Zinf` is not a letter with a number");
    check("t.csv", "length\n1\n", "1:1: the first line has no column called `tool`, `number` or `T`");
    check("t.csv", "tool,length\n1,long\n", "2:3: `long` is not a number");
    check("t.csv", "tool,length\n,5\n", "2:1: this line has no tool number");
    let run = Shop::with(&[("part.ngc", PART)]).gcheck("run part.ngc --config tools.table=t.tbl");
    expect![[r#"
        ! error: t.tbl: cannot read: no such file or directory
        !   help: `tools.table` names this file
        exit 2
    "#]]
    .assert_eq(&run.to_string());
}

#[test]
fn called_programs_are_found_beside_the_program_and_on_the_search_path() {
    let shop = Shop::with(&[
        ("part.nc", "%\nO1\nG0 X0. Y0. Z0.\nM98 P200\nM98 P300\nG65 P9010 X5.\nM30\n%\n"),
        ("sub.nc", "%\nO200\nG0 X2.\nM99\n%\n"),
        ("O0300", "G0 X3.\nM99\n"),
        ("macros/any.nc", "%\nO9009\nM99\nO9010\nG0 X#24\nM99\n%\n"),
    ]);
    let run = shop.gcheck("run part.nc --control haas-mill --quiet --config search.paths=[\"macros\"]");
    expect![[r#"
        part.nc, inch
           line  move             X          Y          Z       feed   seconds
              3  rapid       0.0000     0.0000     0.0000                    ?
        sub.nc, inch
           line  move             X          Y          Z       feed   seconds
              3  rapid       2.0000     0.0000     0.0000                0.120
        O0300, inch
           line  move             X          Y          Z       feed   seconds
              1  rapid       3.0000     0.0000     0.0000                0.060
        macros/any.nc, inch
           line  move             X          Y          Z       feed   seconds
              5  rapid       5.0000     0.0000     0.0000                0.120
        part.nc, inch
           line  move             X          Y          Z       feed   seconds
              7  spindle                                                        stop
              7  end
        exit 0
    "#]]
    .assert_eq(&run.to_string());
    let run = shop.gcheck("run part.nc --control haas-mill --quiet");
    assert_eq!(run.stdout.matches("any.nc").count(), 0, "{run}");
}

#[test]
fn subroutines_are_found_by_the_name_of_their_file() {
    let shop = Shop::with(&[
        ("part.ngc", "o<edge> call [4]\nM2\n"),
        ("subs/edge.ngc", "o<edge> sub\nG0 X#1\no<edge> endsub\nM2\n"),
    ]);
    let run = shop.gcheck("run part.ngc --control linuxcnc --quiet --config search.paths=[\"subs\"]");
    expect![[r#"
        subs/edge.ngc, mm
           line  move             X          Y          Z       feed   seconds
              2  rapid       4.0000     0.0000     0.0000                0.009
        part.ngc, mm
           line  move             X          Y          Z       feed   seconds
              2  spindle                                                        stop
              2  end
        exit 0
    "#]]
    .assert_eq(&run.to_string());
}

#[test]
fn a_fault_in_a_called_program_is_said_at_its_place_there() {
    let shop = Shop::with(&[
        ("part.ngc", "o<edge> call\nM2\n"),
        ("edge.ngc", "o<edge> sub\nG1 X1\no<edge> endsub\nM2\n"),
    ]);
    let run = shop.gcheck("run part.ngc --control linuxcnc --quiet --output-format csv -o moves");
    expect![[r#"
        ! error: edge.ngc:2:1: a cut without a feed rate
        !   |
        ! 2 | G1 X1
        !   | ^^^^^
        !   note: no `F` was given since the program began, or the last change of the feed mode cleared it
        !   help: give `F` on this block or before it
        exit 1
    "#]]
    .assert_eq(&run.to_string());
}

#[test]
fn only_axes_that_move_are_shown_to_people() {
    let heading = |program: &str| {
        let run = run(program, "");
        run.stdout.lines().nth(1).unwrap_or_default().to_owned()
    };
    assert!(!heading("G0 X1\nM2\n").contains('A'));
    assert!(heading("G0 A1\nM2\n").contains('A'));
    // Arguments of a call are not axes, and what a called program moves counts.
    assert!(heading("o1 sub\nG0 B#1\no1 endsub\no1 call [2]\nM2\n").contains('B'));
}

#[test]
fn a_speed_under_constant_surface_speed_is_one_and_its_limit_holds_at_once() {
    let program = "O1\nT101\nG20 G18 G99\nG96 S200 M3\nG50 S500\nG0 X.5 Z.1\nG1 Z-.9 F.01\nG97 S300\nM99\n";
    let shop = Shop::with(&[("part.nc", program)]);
    let run = shop.gcheck("run part.nc --isolated --control haas-lathe --quiet");
    expect![[r#"
        part.nc, inch, X is a diameter
           line  move             X          Z       feed   seconds
              2  tool                                         5.000  T1
              4  spindle                                             200 ft/min
              4  spindle                                             clockwise
              6  rapid       0.5000     0.1000                    ?
              7  feed        0.5000    -0.9000       0.01    12.000  per turn
              8  spindle                                             300 rpm
        exit 0
    "#]]
    .assert_eq(&run.to_string());
}

#[test]
fn past_alarms_every_block_is_reported_and_the_rest_is_run() {
    let program = "G21 G90 F200\nG0 X10 Y5\nG2 X20 Y5 I3\nG1 X30 Q7\nM30\n";
    check(
        program,
        "--past-alarms",
        &expect![[r#"
        part.ngc, mm
           line  move             X          Y          Z       feed   seconds
              2  rapid      10.0000     5.0000     0.0000                0.024
              3  feed       20.0000     5.0000     0.0000        200     3.000
              4  feed       30.0000     5.0000     0.0000        200     3.000
              5  spindle                                                        stop
              5  end
        ! error: part.ngc:3:1: the end point is not on the circle of the start point
        !   |
        ! 3 | G2 X20 Y5 I3
        !   | ^^^^^^^^^^^^
        !   note: it lies 7 mm from the centre, and the start 3 mm
        ! error: part.ngc:4:1: no code of this block reads `Q`
        !   |
        ! 4 | G1 X30 Q7
        !   | ^^^^^^^^^
        !   note: neither the codes of the block nor the motion in effect take this word
        !   help: take `Q` away, or write the code that it belongs to
        exit 1
    "#]],
    );
}

/// A fault speaks of the words that the programmer can change.
#[test]
fn faults_name_words_that_exclude_or_replace_each_other() {
    let stops = |block: &str| {
        let text = format!("O1\nG20 G90 G54\n{block}\nM30\n");
        let shop = Shop::with(&[("part.nc", &text), ("gcheck.toml", "control = \"haas-mill\"\n")]);
        shop.gcheck("run part.nc").stderr
    };
    for (block, says) in [
        ("G107 Y0. Q2.", "`A` or `B` is missing in this block"),
        ("G107 X0. Y0. A0.", "`X` and `Y` cannot be together in a block of `G107`"),
        ("G107 Y0. A0. Q2. R1.", "`Q` and `R` cannot be together in a block of `G107`"),
    ] {
        let stderr = stops(block);
        assert!(stderr.contains(says), "{block}: {stderr}");
    }
}

#[test]
fn an_absolute_centre_is_a_radius_among_diameters() {
    let program = "G7 G18 G90.1 F10\nG0 X20 Z0\nG2 X20 Z-10 I20 K-5\nM2\n";
    let shown = run(program, "--output-format canonical").to_string();
    assert!(shown.contains("ARC_FEED(-10.0000, 10.0000, -5.0000, 20.0000, -1, "), "{shown}");
}

#[test]
fn what_a_run_cannot_read_a_check_reports() {
    for block in [
        "S100 :3",
        "G1 F10 X5[2]",
        "G0 X1 Y2,Z3",
        "G0 X1 %",
        "[1] G0 X1",
        "#1=EXISTS[2]",
        "o1.5 if [1]\no1.5 endif",
        "G10 L1 P1",
        "#<_value>=1",
        "o1 repeat [2]\no1 break\no1 endrepeat",
        "o1 repeat [2]\no1 endrepeat\no1 if [1]\no1 endif",
    ] {
        let shop = Shop::with(&[("part.ngc", &format!("{block}\nM2\n"))]);
        let run = shop.gcheck("run part.ngc --isolated --control linuxcnc --quiet").to_string();
        assert!(!run.ends_with("exit 0\n"), "{block}: {run}");
        let check =
            shop.gcheck("check part.ngc --isolated --no-cache --control linuxcnc --quiet").to_string();
        assert!(check.contains("part.ngc:"), "{block}: {check}");
    }
}

/// A setting that decides what a program means is listed where the program needs it and its value is not given.
#[test]
fn a_setting_that_counts_is_assumed_where_it_is_used() {
    let told = |blocks: &str, arguments: &str| {
        let program =
            format!("%\nO1\nG21 G90 G54\nT1 M6\nS1000 M3\nG0 X0 Y0\nG43 H1 Z5.\n{blocks}\nM30\n%\n");
        let shop = Shop::with(&[("part.nc", &program)]);
        let run = shop.gcheck(&format!("run part.nc --control haas-mill {arguments}"));
        assert_eq!(run.code, 0, "{run}");
        let line = |part: &str| run.stderr.lines().find(|line| line.contains(part)).map(str::to_owned);
        (line("without a decimal point"), line("setting 22"))
    };
    let point =
        "  numbers without a decimal point count as the control usually reads them (Setting 162)".to_owned();
    let delta = "  setting 22 (canned cycle delta Z) is 0.1 inch, as usual".to_owned();
    assert_eq!(told("G0 X15000", ""), (Some(point.clone()), None));
    assert_eq!(told("G0 X15.", ""), (None, None));
    assert_eq!(told("G0 X15000", "--config settings.162=false"), (None, None));
    assert_eq!(told("G98 G83 Z-9. R2. Q3. F100.\nG80", ""), (None, Some(delta.clone())));
    assert_eq!(told("G98 G73 Z-9. R2. Q3. F100.\nG80", "").1, Some(delta));
    assert_eq!(told("G98 G83 Z-9. R2. Q3. F100.\nG80", "--config settings.22=2.0"), (None, None));
    assert_eq!(told("G98 G81 Z-9. R2. F100.\nG80", ""), (None, None));
}

#[test]
fn a_number_of_hundreds_of_digits_is_shown_by_its_power_of_ten() {
    let shop = Shop::with(&[("part.ngc", "G21 G90\nG0 X#100\nM2\n")]);
    let run = shop.gcheck("run part.ngc --control linuxcnc --set 100=1e300");
    assert!(run.stdout.contains(" 1.0000e300 "), "{run}");
}
