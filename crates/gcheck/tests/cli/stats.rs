//! `gcheck stats`: the figures of a program for people and for other programs.

use expect_test::expect;

use crate::shop::Shop;

const PART: &str = "\
%
O0100 (PLATE)
(T1 D=10. FLAT END MILL)
G21 G90 G17 G40 G80
(FACE)
T1 M6
G54 G0 X0. Y0. S3000 M3
G43 H1 Z25.
G1 Z-1. F200.
X50.
G0 Z25.
T2 M6 (DRILL 5MM)
G55 G0 X10. Y10. S1000 M3
G43 H2 Z25.
G81 G98 Z-10. R2. F100.
X20.
G80
M30
%
";

const MACHINE: &str = "\
control = \"haas-mill\"
[machine]
units = \"mm\"
axes = [\"X\", \"Y\", \"Z\"]
rapid = 30000.0
tool_change_seconds = 4.0
[offsets]
G54 = { X = -400.0, Y = -200.0, Z = 0.0 }
G55 = { X = -100.0, Y = -200.0, Z = 0.0 }
[tools]
1 = { length = 120.0, diameter = 10.0 }
2 = { length = 80.0 }
";

#[test]
fn figures_close_with_what_they_rest_on() {
    let run = Shop::with(&[("part.nc", PART)]).gcheck("stats part.nc --control haas-mill");
    expect![[r#"
        cycle time 0:47.6 min (lower bound): cutting 0:37.2 (78 %), rapid 0:00.4 (1 %); 2 tool changes 0:10.0

        tool                          time  cutting   rapid  change  cut mm  rapid mm  feed         speed          holes
        T1     D=10. FLAT END MILL  0:27.9   0:22.8  0:00.1  0:05.0      76        26  200/min      3000 rpm
        T2     DRILL 5MM            0:19.7   0:14.4  0:00.3  0:05.0      24       126  100/min      1000 rpm           2
        total                       0:47.6   0:37.2  0:00.4  0:10.0     100       152  100-200/min  1000-3000 rpm      2

        extents, mm    X from      to  Y from      to   Z from      to
        T1 cutting      0.000  50.000   0.000   0.000   -1.000  25.000
        T2 cutting     10.000  20.000  10.000  10.000  -10.000   2.000
        G54 all moves   0.000  50.000   0.000   0.000   -1.000  25.000
        G55 all moves  10.000  20.000  10.000  10.000  -10.000  25.000

        missing in these figures
          4 moves from or to an unknown point: not in distance or time
          machine coordinates: the start, work offsets or tool lengths are not known

        assumed
          rapid moves at 25400 mm/min on every axis (set machine.rapid)
          5 s for a tool change (set machine.tool_change_seconds)
          axes and spindle reach their speed at once: real times are longer (set machine.acceleration)
          setting 28 (canned cycle act without X/Y) is `on`, as usual
          the positions of the axes at the start are not known
          the work offset G54 is not known
          the work offset G55 is not known
          the length of tool 1 is not known
          the length of tool 2 is not known
          in effect at the start, as at power-on: G0 G80 G17 G90 G94 G40 G49 G98 G54 G64 G50 G69 G100 G255
        gcheck.toml can say
          [settings]
          28 = true
          [offsets]
          G54 = { X = …, Y = …, Z = … }
          G55 = { X = …, Y = …, Z = … }
          [tools]
          1.length = …
          2.length = …
        ! part.nc: control haas-mill, set by `--control`
        exit 0
    "#]]
    .assert_eq(&run.to_string());
}

#[test]
fn a_machine_file_leaves_little_to_assume() {
    let run = Shop::with(&[("part.nc", PART), ("gcheck.toml", MACHINE)]).gcheck("stats part.nc");
    expect![[r#"
        cycle time 0:46.5 min (lower bound): cutting 0:37.2 (80 %), rapid 0:01.3 (3 %); 2 tool changes 0:08.0

        tool                          time  cutting   rapid  change  cut mm  rapid mm  feed         speed          holes
        T1     D=10. FLAT END MILL  0:27.1   0:22.8  0:00.3  0:04.0      76       171  200/min      3000 rpm
        T2     DRILL 5MM            0:19.4   0:14.4  0:01.0  0:04.0      24       491  100/min      1000 rpm           2
        total                       0:46.5   0:37.2  0:01.3  0:08.0     100       662  100-200/min  1000-3000 rpm      2

        extents, mm           X from       to    Y from        to    Z from       to
        T1 cutting             0.000   50.000     0.000     0.000    -1.000   25.000
        T2 cutting            10.000   20.000    10.000    10.000   -10.000    2.000
        G54 all moves          0.000   50.000     0.000     0.000  -120.000   25.000
        G55 all moves       -250.000   20.000     0.000    10.000  -120.000   25.000
        machine, all moves  -400.000  -80.000  -200.000  -190.000     0.000  145.000

        missing in these figures
          1 move from or to an unknown point: not in distance or time

        assumed
          axes and spindle reach their speed at once: real times are longer (set machine.acceleration)
          setting 28 (canned cycle act without X/Y) is `on`, as usual
          the positions of the axes at the start are not known
          in effect at the start, as at power-on: G0 G80 G17 G90 G94 G40 G49 G98 G54 G64 G50 G69 G100 G255
        gcheck.toml can say
          [settings]
          28 = true
        ! part.nc: control haas-mill, set in gcheck.toml
        exit 0
    "#]]
    .assert_eq(&run.to_string());
}

#[test]
fn json_is_for_other_programs() {
    let shop = Shop::with(&[("part.nc", PART), ("gcheck.toml", MACHINE)]);
    let run = shop.gcheck("stats part.nc --output-format json");
    assert_eq!((run.code, run.stderr.as_str()), (0, ""), "{run}");
    let json = run.json();
    assert_eq!(json["version"], 1);
    assert_eq!(json["file"], "part.nc");
    assert_eq!(json["control"]["name"], "haas-mill");
    assert_eq!(json["control"]["source"], "configuration");
    assert_eq!(json["ended"], "program-end");
    assert_eq!(json["fault"], serde_json::Value::Null);
    assert_eq!(json["units"], "mm");
    assert_eq!(json["total"]["tool_changes"], 2);
    assert_eq!(json["tools"][0]["tool"], 1);
    assert_eq!(json["tools"][0]["name"], "D=10. FLAT END MILL");
    assert_eq!(json["tools"][1]["name"], "DRILL 5MM");
    assert_eq!(json["tools"][1]["holes"], 2);
    let assumptions = json["assumptions"].as_array().unwrap();
    assert!(assumptions.iter().all(|one| one["text"].is_string()), "{assumptions:?}");
    let without = Shop::with(&[("part.nc", PART)])
        .gcheck("stats part.nc --control haas-mill --output-format json")
        .json();
    let pins: Vec<String> = without["assumptions"]
        .as_array()
        .unwrap()
        .iter()
        .filter_map(|one| one["pin"].as_str().map(str::to_owned))
        .collect();
    expect![[r#"
        [machine] rapid = …
        [machine] tool_change_seconds = …
        [machine] acceleration = …
        [settings] 28 = true
        [offsets] G54 = { X = …, Y = …, Z = … }
        [offsets] G55 = { X = …, Y = …, Z = … }
        [tools] 1.length = …
        [tools] 2.length = …"#]]
    .assert_eq(&pins.join("\n"));
}

/// The machine file with more lines in `[machine]`.
fn machine_with(lines: &str) -> String {
    MACHINE.replacen("[offsets]", &format!("{lines}\n[offsets]"), 1)
}

#[test]
fn with_the_machines_acceleration_times_are_an_estimate() {
    let machine = machine_with("acceleration = { X = 1000.0, Z = 500.0 }\nspindle_acceleration = 1500.0");
    let shop = Shop::with(&[("part.nc", PART), ("gcheck.toml", &machine)]);
    let text = shop.gcheck("stats part.nc").stdout;
    expect!["cycle time 0:53.7 min (estimate): cutting 0:37.2 (69 %), rapid 0:01.3 (2 %), acceleration 0:04.3 (8 %), spindle 0:02.9 (5 %); 2 tool changes 0:08.0"].assert_eq(text.split("\n\n").next().unwrap());
    let json = shop.gcheck("stats part.nc --output-format json").json();
    assert_eq!(json["times"], "estimate");
    let of = |seconds: &serde_json::Value, part: &str| seconds[part].as_f64().unwrap();
    let causes =
        ["cutting", "rapid", "acceleration", "starved", "spindle", "auxiliary", "dwell", "tool_change"];
    let used = json["tools"].as_array().unwrap().iter().filter(|tool| of(&tool["seconds"], "total") > 0.0);
    for seconds in used.chain([&json["total"]]).map(|row| &row["seconds"]) {
        let sum: f64 = causes.iter().map(|cause| of(seconds, cause)).sum();
        assert!((sum - of(seconds, "total")).abs() < 1e-5, "{seconds}");
        assert!(of(seconds, "acceleration") > 0.0 && of(seconds, "spindle") > 0.0, "{seconds}");
    }
    let bound = Shop::with(&[("part.nc", PART), ("gcheck.toml", MACHINE)])
        .gcheck("stats part.nc --output-format json")
        .json();
    assert_eq!(bound["times"], "lower-bound");
    assert!(of(&bound["total"]["seconds"], "total") < of(&json["total"]["seconds"], "total"));
}

#[test]
fn segments_that_come_too_fast_are_the_slowest_place() {
    let segments: String = (1..=400).map(|ix| format!("X{:.3}\n", f64::from(ix) * 0.05)).collect();
    let part = format!("%\nO1\nG21 G90 G94 G54 G17\nG0 X0. Y0.\nG1 F6000.\n{segments}M30\n%\n");
    let machine = machine_with("acceleration = 3000.0\nblock_time = 0.002\nlook_ahead = 40");
    let shop = Shop::with(&[("part.nc", &part), ("gcheck.toml", &machine)]);
    let json = shop.gcheck("stats part.nc --output-format json").json();
    // The last blocks come slowly enough, because the axes brake.
    let place = &json["slowest"][0];
    assert_eq!(
        (place["cause"].as_str(), place["last_line"].as_u64()),
        (Some("data-starved"), Some(400)),
        "{json:#}"
    );
    let text = shop.gcheck("stats part.nc").stdout;
    let line = text.lines().find(|line| line.contains("data starved:")).unwrap_or(&text);
    expect!["  lines 14 to 400: 0:00.6 of 0:00.8 lost, data starved: 2000 blocks/s, and the control prepares 500; 387 moves of 0.05 mm on the average"].assert_eq(line);
    expect![[r#"
        part.nc:59:1: info[data-starved] data starved: 2000 blocks/s, and the control prepares 500
    "#]]
    .assert_eq(&shop.gcheck("check part.nc --output-format concise --select data-starved").stdout);
}

#[test]
#[expect(
    clippy::too_many_lines,
    clippy::format_push_string,
    reason = "one table of values and their messages"
)]
fn figures_that_no_machine_has_are_refused_with_their_line() {
    let mut messages = String::new();
    for line in [
        "acceleration = 0.0",
        "acceleration = -500.0",
        "acceleration = { X = 1000.0, Z = nan }",
        "acceleration = { Q = 1000.0 }",
        "acceleration = {}",
        "acceleration = \"fast\"",
        "acceleration = 5.0",
        "acceleration = 9999999.0",
        "jerk = inf",
        "block_time = 2.0",
        "block_time = 0.0",
        "look_ahead = 0",
        "pockets = 0",
        "rapid_override = 150.0",
        "max_feed = 40000.0",
        "pocket_seconds = -1.0",
        "tool_changer = \"robot\"",
        "max_rpm = 8000\nspindle_acceleration = 1.0",
    ] {
        let shop = Shop::with(&[("part.nc", PART), ("gcheck.toml", &machine_with(line))]);
        let run = shop.gcheck("stats part.nc");
        assert_eq!((run.code, run.stdout.as_str()), (2, ""), "{line}: {run}");
        messages += &format!("{line}\n  {}\n", run.stderr.trim_end().replace('\n', "\n  "));
    }
    expect![[r#"
        acceleration = 0.0
          error: gcheck.toml:7:16: must be greater than zero, and finite
            |
          7 | acceleration = 0.0
            |                ^^^
        acceleration = -500.0
          error: gcheck.toml:7:16: must be greater than zero, and finite
            |
          7 | acceleration = -500.0
            |                ^^^^^^
        acceleration = { X = 1000.0, Z = nan }
          error: gcheck.toml:7:34: must be greater than zero, and finite
            |
          7 | acceleration = { X = 1000.0, Z = nan }
            |                                  ^^^
        acceleration = { Q = 1000.0 }
          error: gcheck.toml:7:18: `Q` is not an axis of haas-mill; the axes are A, B, C, U, V, W, X, Y, Z
            |
          7 | acceleration = { Q = 1000.0 }
            |                  ^
        acceleration = {}
          error: gcheck.toml:7:16: names no axis
            |
          7 | acceleration = {}
            |                ^^
        acceleration = "fast"
          error: gcheck.toml:7:16: wrong type: text "fast", expected a number, or a table of numbers by axis
            |
          7 | acceleration = "fast"
            |                ^^^^^^
        acceleration = 5.0
          error: gcheck.toml:7:16: the rapid rate 30000 is reached only after 100 s: acceleration counts in mm a second squared, not in g or m/s²
            |
          7 | acceleration = 5.0
            |                ^^^
        acceleration = 9999999.0
          error: gcheck.toml:7:16: the rapid rate 30000 is reached already after 0.0500 ms: acceleration counts in mm a second squared, not in g or m/s²
            |
          7 | acceleration = 9999999.0
            |                ^^^^^^^^^
        jerk = inf
          error: gcheck.toml:7:8: must be greater than zero, and finite
            |
          7 | jerk = inf
            |        ^^^
        block_time = 2.0
          error: gcheck.toml:7:14: 2 s for a block: block_time counts in seconds, 0.0005 for 2,000 blocks a second
            |
          7 | block_time = 2.0
            |              ^^^
        block_time = 0.0
          error: gcheck.toml:7:14: must be greater than zero
            |
          7 | block_time = 0.0
            |              ^^^
        look_ahead = 0
          error: gcheck.toml:7:14: a control looks 1 to 100000 blocks ahead
            |
          7 | look_ahead = 0
            |              ^
        pockets = 0
          error: gcheck.toml:7:11: a magazine has at least one pocket
            |
          7 | pockets = 0
            |           ^
        rapid_override = 150.0
          error: gcheck.toml:7:18: a rapid override is at most 100 percent
            |
          7 | rapid_override = 150.0
            |                  ^^^^^
        max_feed = 40000.0
          error: gcheck.toml:5:9: the rapid rate 30000 is lower than max_feed (40000): no axis cuts faster than it moves at rapid
            |
          5 | rapid = 30000.0
            |         ^^^^^^^
        pocket_seconds = -1.0
          error: gcheck.toml:7:18: must not be negative
            |
          7 | pocket_seconds = -1.0
            |                  ^^^^
        tool_changer = "robot"
          error: gcheck.toml:7:16: unknown value `robot`; known are carousel, arm
            |
          7 | tool_changer = "robot"
            |                ^^^^^^^
        max_rpm = 8000
        spindle_acceleration = 1.0
          error: gcheck.toml:8:24: the spindle takes 8000 s to its highest speed: spindle_acceleration counts in 1/min a second
            |
          8 | spindle_acceleration = 1.0
            |                        ^^^
    "#]].assert_eq(&messages);
}

#[test]
fn a_program_that_faults_has_figures_up_to_there() {
    let shop = Shop::with(&[("part.ngc", "F100\nG1 X10\nG1 X20 R\nM2\n")]);
    let run = shop.gcheck("stats part.ngc --control linuxcnc --output-format json");
    assert_eq!(run.code, 1, "{run}");
    let json = run.json();
    assert_eq!(json["ended"], "fault");
    assert_eq!(json["fault"]["line"], 3);
    assert_eq!(json["total"]["distance"]["cutting"], 10.0);
    let run = shop.gcheck("stats part.ngc --control linuxcnc -o figures.txt");
    assert_eq!((run.code, run.stdout.as_str()), (1, ""), "{run}");
    assert!(shop.read("figures.txt").starts_with("cycle time "), "{}", shop.read("figures.txt"));
}

#[test]
fn a_program_that_does_not_say_its_units_has_them_assumed() {
    let shop = Shop::with(&[("part.nc", "%\nO1\nG0 X1.\nM30\n%\n")]);
    let assumed = |arguments: &str| {
        shop.gcheck(&format!("stats part.nc {arguments}")).stdout.contains("the program does not say")
    };
    assert!(assumed("--control haas-mill"));
    assert!(!assumed("--control haas-mill --config machine.units=inch"));
}

#[test]
fn names_of_tools_come_from_the_program_or_the_table() {
    let shop = Shop::with(&[
        ("part.ngc", "T1 M6\nG0 X1\nT2 M6 (mine)\nG0 X2\nM2\n"),
        ("tool.tbl", "T1 P1 Z1 ;from the table\nT2 P2 Z1 ;from the table\n"),
    ]);
    let json = shop
        .gcheck("stats part.ngc --control linuxcnc --output-format json --config tools.table=tool.tbl")
        .json();
    let names: Vec<&str> =
        json["tools"].as_array().unwrap().iter().filter_map(|tool| tool["name"].as_str()).collect();
    assert_eq!(names, ["from the table", "mine"]);
}

/// The pages of the control give the positions of its switch; 0 stands for axes that wait.
#[test]
fn a_feed_override_that_the_switch_does_not_have_is_refused() {
    let program = "G21 G90 G94\nG0 X0. Y0. Z0.\nG1 X10. F100.\nM30\n";
    for (percent, is_refused) in
        [("160.0", true), ("85.0", true), ("0.0", false), ("90.0", false), ("150.0", false)]
    {
        let config = format!("control = \"generic-mill\"\n[machine]\nfeed_override = {percent}\n");
        let shop = Shop::with(&[("part.nc", program), ("gcheck.toml", &config)]);
        for command in ["check part.nc", "stats part.nc"] {
            let run = shop.gcheck(command);
            assert_eq!(run.code == 2, is_refused, "{percent} {command}: {run}");
            assert_eq!(
                run.stderr.contains("0 to 150 percent in steps of 10"),
                is_refused,
                "{percent}: {run}"
            );
        }
    }
    let config = "control = \"generic-mill\"\n[machine]\nfeed_override = 0.0\n";
    let shop = Shop::with(&[("part.nc", program), ("gcheck.toml", config)]);
    let run = shop.gcheck("stats part.nc");
    assert!(run.stdout.contains("1 move without a feed: not in time"), "{run}");
    assert!(run.stdout.contains("the feed override is at 0 %"), "{run}");
}

/// A push that is shorter than a part makes none, however many bars are loaded.
#[test]
fn bars_that_give_no_part_are_counted_as_such() {
    let program = "O1\nG21 G18 G99 G54\nT101\nM5\nG105 I20. J100. K190.\nG97 S500 M3\nG0 X10. Z2.\nG1 Z-15. F0.1\nG0 X50. Z50.\nM5\nM99\n";
    let stats = |push: &str| {
        let text = program.replace("I20.", push);
        let config = "control = \"haas-lathe\"\n[machine]\nunits = \"mm\"\nbar_length = 300.0\nbars = 3\n";
        let shop = Shop::with(&[("part.nc", &text), ("gcheck.toml", config)]);
        shop.gcheck("stats part.nc").stdout
    };
    assert!(stats("I20.").contains("0 parts from"), "{}", stats("I20."));
    assert!(stats("I105.").contains("1 a bar"), "{}", stats("I105."));
}

#[test]
fn chip_loads_surface_speeds_and_how_corners_are_taken_are_shown_by_tool() {
    let configuration = "control = \"linuxcnc\"\n[machine]\nunits = \"mm\"\naxes = [\"X\", \"Y\", \"Z\"]\n[tools]\n\
        1 = { length = 100.0, diameter = 10.0, teeth = 4, chip_load = [0.02, 0.06], surface_speed = [60.0, 160.0] }\n\
        2 = { length = 80.0, diameter = 6.0 }\n";
    let program = "G21 G90 G94 G54\nT1 M6\nG43 H1\nS3000 M3\nG64 P0.02\nG0 X0 Y0 Z5\nG1 Z0 F200\nX50 F600\nG61\nY50\n\
        T2 M6\nG43 H2\nS5000 M3\nG64\nG1 X0 F500\nM2\n";
    let shop = Shop::with(&[("gcheck.toml", configuration), ("part.ngc", program)]);
    let run = shop.gcheck("stats part.ngc -q");
    let from = run.stdout.find("chip load").expect("chip loads are shown");
    let to = run.stdout.find("extents").expect("extents follow");
    expect![[r#"
        chip load and surface speed
          T1: 0.0167-0.05 mm a tooth, 94.2478 m/min

        corners
          T1: corners blended within 0.02 mm; exact path
          T2: corners blended without a tolerance

    "#]]
    .assert_eq(&run.stdout[from..to]);
    let json = shop.gcheck("stats part.ngc -q --output-format json").json();
    assert_eq!(json["tools"][0]["edge"]["chip_load"]["max"], 0.05, "{:#}", json["tools"][0]);
    assert_eq!(json["tools"][0]["corners"][0], "corners blended within 0.02 mm");
}

#[test]
fn several_programs_are_a_table() {
    let shop = Shop::with(&[
        ("a/part.nc", PART),
        ("b.nc", "%\nO2\nG21 G90\nG0 X0. Y0.\nG2 X1. Y1. I9. F100.\nM30\n%\n"),
        ("gcheck.toml", MACHINE),
    ]);
    let run = shop.gcheck("stats -q .");
    expect![[r#"
        program    control    time min  cutting min  tools  changes  cut mm  X                Y                Z
        a/part.nc  haas-mill  0:46.5    0:37.2       2      2        100     0.000 to 50.000  0.000 to 10.000  -10.000 to 25.000
        b.nc       haas-mill  0:00.0    0:00.0       0      0        0       -                -                -
        2 programs, 0:46.5 min in all (lower bound); extents are of what is cut, in mm
    "#]].assert_eq(&run.stdout);
    assert_eq!(run.code, 2, "{}", run.stderr);
    let run = shop.gcheck("stats -q a/part.nc b.nc --output-format csv");
    expect![[r#"
        file,control,ended,seconds,times,cutting_seconds,tools,tool_changes,cutting_mm,rapid_mm,x_from_mm,x_to_mm,y_from_mm,y_to_mm,z_from_mm,z_to_mm,problem
        a/part.nc,haas-mill,program-end,46.524,lower-bound,37.200,2,2,100.000,662.192,0.000,50.000,0.000,10.000,-10.000,25.000,
        b.nc,haas-mill,fault,0.000,lower-bound,0.000,0,0,0.000,0.000,,,,,,,the end point is not on the circle of the start point
    "#]].assert_eq(&run.stdout.replace("\r\n", "\n"));
    let run = shop.gcheck("stats -q a --output-format json");
    let json: serde_json::Value = serde_json::from_str(&run.stdout).unwrap();
    assert_eq!((run.code, &json["programs"][0]["file"]), (0, &"a/part.nc".into()), "{json}");
    assert!(json["seconds"].as_f64().is_some_and(|seconds| seconds > 1.0));
}

#[test]
fn what_is_done_before_the_first_tool_is_not_a_tool() {
    let program = "%\nO1\nG28 U0 W0\nG50 S2500\nT0101\nG96 S200 M3\nG0 X50. Z2.\nG1 Z-20. F0.12\nM30\n%\n";
    let shop = Shop::with(&[("a/part.nc", program)]);
    let stats = |arguments: &str| shop.gcheck(&format!("stats -q --control fanuc-lathe {arguments}"));
    let text = stats("a/part.nc").stdout;
    assert!(text.contains("\nT1 ") && !text.contains("T?") && !text.contains("total"), "{text}");
    // Its moves are missing in the figures all the same.
    assert!(text.contains("3 moves from or to an unknown point"), "{text}");
    let json = stats("a/part.nc --output-format json").json();
    assert_eq!(
        (json["tools"].as_array().unwrap().len(), &json["tools"][0]["tool"]),
        (1, &1.into()),
        "{json:#}"
    );
    let table = stats("a").stdout;
    assert!(table.contains("  1      1        22  "), "{table}");
    let csv = stats("a --output-format csv").stdout;
    assert!(csv.contains(",1,1,22.000,"), "{csv}");
    // A program that calls no tool has one that is not known.
    let shop = Shop::with(&[("part.nc", "G21 G90 G0 X0 Y0\nG1 X10 F100\nM30\n")]);
    let csv = shop.gcheck("stats -q --control linuxcnc --output-format csv part.nc").stdout;
    assert!(csv.contains(",1,0,10.000,"), "{csv}");
}

#[test]
fn a_table_is_in_millimetres_whatever_its_programs_are_in() {
    let program = |units| format!("%\nO1\n{units} G90 G54\nT1 M6\nG0 X0. Y0.\nG1 X10. F10.\nM30\n%\n");
    let shop = Shop::with(&[("inch.nc", &program("G20")), ("mm.nc", &program("G21"))]);
    let run = shop.gcheck("stats -q --control haas-mill inch.nc mm.nc");
    let of = |name: &str| run.stdout.lines().find(|line| line.starts_with(name)).unwrap().to_owned();
    assert!(of("inch.nc").contains(" 254     0.000 to 254.000 "), "{run}");
    assert!(of("mm.nc").contains(" 10      0.000 to 10.000 "), "{run}");
    let csv = shop.gcheck("stats -q --control haas-mill --output-format csv inch.nc").stdout;
    assert!(csv.contains(",254.000,0.000,0.000,254.000,"), "{csv}");
}

#[test]
fn a_folder_without_programs_has_no_figures() {
    let run = Shop::with(&[("a/note.txt", "x")]).gcheck("stats a");
    assert!(run.code == 2 && run.stderr.contains("no programs in a"), "{}", run.stderr);
}

#[test]
fn a_program_without_figures_ends_in_a_word_too() {
    let shop = Shop::with(&[("part.nc", PART), ("broken.nc", "G28 U1 L2\n(gcheck: control=nonsense)\n")]);
    let run = shop.gcheck("stats part.nc broken.nc --output-format json --control haas-mill");
    let whole = run.json();
    let ended: Vec<&str> =
        whole["programs"].as_array().unwrap().iter().map(|one| one["ended"].as_str().unwrap()).collect();
    assert_eq!(ended[0], "program-end");
    let run = shop.gcheck("stats part.nc missing.nc --output-format csv --control haas-mill -q");
    assert_eq!(run.code, 2, "{run}");
    let run = shop.gcheck("stats part.nc broken.nc --output-format json");
    let whole = run.json();
    let broken = whole["programs"].as_array().unwrap().iter().find(|one| one["file"] == "broken.nc").unwrap();
    assert_eq!(broken["ended"], "not-run", "{run}");
}
