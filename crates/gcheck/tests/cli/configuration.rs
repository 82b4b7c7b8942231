//! `gcheck.toml` and the options that take its place: which one counts for which program, and what its keys do.

use expect_test::expect;

use crate::shop::{BAD, GOOD, Shop, WARNED};

/// The control of each file, in order.
fn controls(shop: &Shop, arguments: &str) -> Vec<String> {
    let run = shop.gcheck(&format!("check {arguments} --output-format json"));
    let json = run.json();
    let control = |file: &serde_json::Value| {
        format!("{} {}", file["file"].as_str().unwrap(), file["control"]["name"].as_str().unwrap())
    };
    json["files"].as_array().unwrap().iter().map(control).collect()
}

/// The findings of `part.nc` under a configuration.
fn check_part(program: &str, configuration: &str, rules: &[&str]) {
    let shop = Shop::with(&[("part.nc", program), ("gcheck.toml", configuration)]);
    let run = shop.gcheck("check part.nc --output-format concise --quiet");
    assert_eq!(run.stderr, "", "{configuration}");
    assert_eq!(run.rules(), rules, "{configuration}\n{run}");
}

#[test]
fn the_nearest_ancestor_counts() {
    let shop = Shop::with(&[
        ("gcheck.toml", "control = \"haas-mill\""),
        ("a.nc", GOOD),
        ("deep/er/b.nc", GOOD),
        ("lathe/.gcheck.toml", "control = \"fanuc-lathe\""),
        ("lathe/c.nc", GOOD),
        ("lathe/new/d.nc", GOOD),
    ]);
    assert_eq!(
        controls(&shop, "."),
        ["a.nc haas-mill", "deep/er/b.nc haas-mill", "lathe/c.nc fanuc-lathe", "lathe/new/d.nc fanuc-lathe"]
    );
}

#[test]
fn a_visible_file_wins_over_a_hidden_one() {
    let shop = Shop::with(&[
        ("gcheck.toml", "control = \"haas-mill\""),
        (".gcheck.toml", "control = \"linuxcnc\""),
        ("a.nc", GOOD),
    ]);
    assert_eq!(controls(&shop, "."), ["a.nc haas-mill"]);
}

#[test]
fn a_configuration_extends_another() {
    let shop = Shop::with(&[
        (
            "base/shop.toml",
            "control = \"haas-mill\"\n[rules]\nunknown-code = \"warning\"\nmissing-decimal-point = \"off\"\n",
        ),
        ("jobs/gcheck.toml", "extend = \"../base/shop.toml\"\n[rules]\nunknown-code = \"info\"\n"),
        ("jobs/part.nc", "%\nO0001 G90\nG999\nG0 X1\nM30\n%\n"),
    ]);
    assert_eq!(controls(&shop, "."), ["jobs/part.nc haas-mill"]);
    let run = shop.gcheck("check --output-format concise --quiet");
    assert_eq!(run.findings(), ["jobs/part.nc:3:1: info[unknown-code]"]);
}

#[test]
fn a_named_configuration_counts_for_every_program() {
    let shop = Shop::with(&[
        ("other.toml", "control = \"linuxcnc\""),
        ("mill/gcheck.toml", "control = \"haas-mill\""),
        ("mill/a.nc", GOOD),
        ("b.nc", GOOD),
    ]);
    assert_eq!(controls(&shop, ". --config other.toml"), ["b.nc linuxcnc", "mill/a.nc linuxcnc"]);
}

#[test]
fn keys_of_the_command_line_count_most() {
    let shop = Shop::with(&[
        ("gcheck.toml", "control = \"haas-mill\"\n[rules]\nunknown-code = \"warning\"\n"),
        ("part.nc", BAD),
    ]);
    assert_eq!(controls(&shop, ". --config control=linuxcnc"), ["part.nc linuxcnc"]);
    assert_eq!(
        controls(&shop, ". --config control=\"linuxcnc\" --config machine.axes=[\"X\",\"Y\"]"),
        ["part.nc linuxcnc"]
    );
    let run = shop.gcheck("check --config rules.unknown-code=info --output-format concise --quiet");
    assert_eq!(run.findings(), ["part.nc:3:1: info[unknown-code]"]);
}

#[test]
fn isolated_reads_no_file() {
    let shop = Shop::with(&[("gcheck.toml", "this is = no toml ="), ("part.nc", "G0 X1.\nM30\n")]);
    assert_eq!(shop.gcheck("check").code, 2);
    assert_eq!(controls(&shop, ". --isolated"), ["part.nc generic-mill"]);
    assert_eq!(controls(&shop, ". --isolated --config control=haas-mill"), ["part.nc haas-mill"]);
}

#[test]
fn overrides_count_for_the_files_they_name() {
    let shop = Shop::with(&[
        (
            "gcheck.toml",
            "control = \"haas-mill\"\n[[overrides]]\nfiles = [\"lathe/**\"]\ncontrol = \"haas-lathe\"\n\
             [[overrides]]\nfiles = [\"lathe/special/\", \"*.ngc\"]\ncontrol = \"linuxcnc\"\n",
        ),
        ("a.nc", GOOD),
        ("b.ngc", GOOD),
        ("lathe/c.nc", GOOD),
        ("lathe/special/d.nc", GOOD),
    ]);
    assert_eq!(
        controls(&shop, "."),
        ["a.nc haas-mill", "b.ngc linuxcnc", "lathe/c.nc haas-lathe", "lathe/special/d.nc linuxcnc"]
    );
}

#[test]
fn rules_are_ignored_per_file() {
    let shop = Shop::with(&[
        (
            "gcheck.toml",
            "control = \"haas-mill\"\n[per-file-ignores]\n\"legacy/**\" = [\"words\"]\n\"b.nc\" = [\"unknown-code\"]\n",
        ),
        ("legacy/a.nc", BAD),
        ("b.nc", BAD),
        ("c.nc", BAD),
    ]);
    let run = shop.gcheck("check --output-format concise --quiet");
    assert_eq!(run.findings(), ["c.nc:3:1: error[unknown-code]"]);
}

#[test]
fn rules_are_selected_and_weighed() {
    let both = "%\nO0001 G90\nG999\nG0 X1\nM30\n%\n";
    check_part(both, "control = \"haas-mill\"", &["unknown-code", "missing-decimal-point"]);
    check_part(both, "control = \"haas-mill\"\n[rules]\nselect = [\"unknown-code\"]\n", &["unknown-code"]);
    check_part(
        both,
        "control = \"haas-mill\"\n[rules]\nignore = [\"unknown-code\"]\n",
        &["missing-decimal-point"],
    );
    check_part(
        both,
        "control = \"haas-mill\"\n[rules]\nselect = []\nextend-select = [\"unknown-code\"]\n",
        &["unknown-code"],
    );
    check_part(
        both,
        "control = \"haas-mill\"\n[rules]\nwords = \"off\"\nunknown-code = \"hint\"\n",
        &["unknown-code"],
    );
    check_part(
        both,
        "control = \"haas-mill\"\n[rules]\nunknown-code = \"off\"\n",
        &["missing-decimal-point"],
    );
}

#[test]
fn options_select_over_the_configuration() {
    let shop = Shop::with(&[
        (
            "gcheck.toml",
            "control = \"haas-mill\"\n[rules]\nselect = [\"unknown-code\"]\nunknown-code = \"info\"\n",
        ),
        ("part.nc", "%\nO0001 G90\nG999\nG0 X1\nM30\n%\n"),
    ]);
    let rules = |arguments: &str| {
        shop.gcheck(&format!("check {arguments} --output-format concise --quiet")).findings()
    };
    assert_eq!(rules(""), ["part.nc:3:1: info[unknown-code]"]);
    assert_eq!(rules("--select missing-decimal-point"), ["part.nc:4:4: warning[missing-decimal-point]"]);
    assert_eq!(
        rules("--select words"),
        ["part.nc:3:1: info[unknown-code]", "part.nc:4:4: warning[missing-decimal-point]"]
    );
    assert_eq!(
        rules("--extend-select missing-decimal-point"),
        ["part.nc:3:1: info[unknown-code]", "part.nc:4:4: warning[missing-decimal-point]"]
    );
    assert!(rules("--ignore unknown-code").is_empty());
}

#[test]
fn codes_of_the_shop_are_known() {
    let program = "%\nO0001 G90\nM451\nG245 X1.\nM30\n%\n";
    check_part(program, "control = \"haas-mill\"", &["unknown-code", "unknown-code"]);
    check_part(
        program,
        "control = \"haas-mill\"\n[codes]\nM451 = { title = \"air blast on\", group = \"user\" }\nG245 = { alias = \"O9010\" }\n",
        &[],
    );
}

#[test]
fn settings_of_the_control_change_what_numbers_mean() {
    check_part(WARNED, "control = \"haas-mill\"", &["missing-decimal-point"]);
    check_part(WARNED, "control = \"haas-mill\"\n[settings]\n162 = true\n", &[]);
    check_part(WARNED, "control = \"haas-mill\"\n[settings]\n162 = \"on\"\n", &[]);
    check_part(WARNED, "control = \"haas-mill\"\n[settings]\n162 = false\n", &["missing-decimal-point"]);
}

#[test]
fn called_programs_are_looked_for_on_the_search_path() {
    let program = "%\nO0001\nM98 P3010\nM30\n%\n";
    check_part(program, "control = \"haas-mill\"", &["subprogram-missing"]);
    let shop = Shop::with(&[
        ("jobs/part.nc", program),
        ("macros/whatever.nc", "%\nO3010\nM99\n%\n"),
        ("gcheck.toml", "control = \"haas-mill\"\n[search]\npaths = [\"macros/\"]\n"),
    ]);
    assert_eq!(shop.gcheck("check jobs --output-format concise --quiet").rules(), [""; 0]);
    let beside = Shop::with(&[("part.nc", program), ("O3010", "%\nO3010\nM99\n%\n")]);
    assert_eq!(
        beside.gcheck("check part.nc --control haas-mill --output-format concise --quiet").rules(),
        [""; 0]
    );
    assert_eq!(
        beside
            .gcheck_reading(
                "check - --stdin-filename part.nc --control haas-mill --output-format concise --quiet",
                program.as_bytes()
            )
            .rules(),
        [""; 0]
    );
}

/// What `check` says of a key under `[machine]`.
fn problem(machine: &str) -> String {
    let configuration = format!("control = \"haas-mill\"\n[machine]\nunits = \"mm\"\n{machine}\n");
    let run = Shop::with(&[("part.nc", GOOD), ("gcheck.toml", &configuration)]).gcheck("check part.nc");
    run.stderr.lines().find(|line| line.contains("gcheck.toml:")).unwrap_or_default().to_owned()
}

#[test]
fn a_distance_between_rotary_axes_is_one_of_a_head_or_of_a_table() {
    for rotary in ["head-head", "table-table"] {
        assert_eq!(problem(&format!("rotary = \"{rotary}\"\nrotary_offset = {{ Y = 35.0, Z = -12.0 }}")), "");
    }
    expect!["error: gcheck.toml:5:19: rotary_offset is between two axes of a head or of a table: with `head-table` one axis turns the tool and one the part"].assert_eq(&problem("rotary = \"head-table\"\nrotary_offset = { Y = 35.0 }"));
    expect!["error: gcheck.toml:5:19: rotary_offset is a distance in X, Y and Z"]
        .assert_eq(&problem("rotary = \"table-table\"\nrotary_offset = { A = 35.0 }"));
    expect!["error: gcheck.toml:5:23: a distance is a number"]
        .assert_eq(&problem("rotary = \"table-table\"\nrotary_offset = { Y = inf }"));
    expect!["error: gcheck.toml:5:28: the axis Y is listed twice"]
        .assert_eq(&problem("rotary = \"table-table\"\nrotary_offset = { Y = 1.0, y = 2.0 }"));
}

#[test]
fn machine_coordinates_under_tool_centre_point_control_know_axes_that_do_not_meet() {
    let program = "G21 G90 G94\nG54 G0 X0. Y0. Z0. A0. C0.\nG234 H1\nG1 X10. Y0. Z0. A90. C90. F1000.\nM30\n";
    let at = |offset: &str| {
        let configuration = format!(
            "control = \"haas-mill\"\n[machine]\nunits = \"mm\"\naxes = [\"X\", \"Y\", \"Z\", \"A\", \"C\"]\nrotary = \"table-table\"\nrotary_centre = {{ X = 0.0, Y = 0.0, Z = -50.0 }}\n{offset}\n[offsets]\nG54 = {{ X = 0.0, Y = 0.0, Z = 0.0 }}\n[tools]\n1 = {{ length = 100.0 }}\n"
        );
        let shop = Shop::with(&[("part.nc", program), ("gcheck.toml", &configuration)]);
        let run = shop.gcheck("run part.nc --output-format jsonl");
        run.stdout.lines().rfind(|line| line.contains("machine")).unwrap_or_default().to_owned()
    };
    expect![[r#"{"n":2,"file":"part.nc","line":4,"kind":"feed","units":"mm","from":{"X":0.0,"Y":0.0,"Z":-100.0,"A":0.0,"C":0.0},"programmed":{"X":10.0,"Y":0.0,"Z":0.0,"A":90.0,"C":90.0},"to":{"X":10.0,"Y":0.0,"Z":0.0,"A":90.0,"C":90.0},"machine":{"X":0.0,"Y":-50.0,"Z":60.0,"A":90.0,"C":90.0},"feed":1000.0,"feed_mode":"per-minute","seconds":6.029925}"#]].assert_eq(&at(""));
    expect![[r#"{"n":2,"file":"part.nc","line":4,"kind":"feed","units":"mm","from":{"X":0.0,"Y":0.0,"Z":-100.0,"A":0.0,"C":0.0},"programmed":{"X":10.0,"Y":0.0,"Z":0.0,"A":90.0,"C":90.0},"to":{"X":10.0,"Y":0.0,"Z":0.0,"A":90.0,"C":90.0},"machine":{"X":5.0,"Y":-50.0,"Z":65.0,"A":90.0,"C":90.0},"feed":1000.0,"feed_mode":"per-minute","seconds":6.029925}"#]].assert_eq(&at("rotary_offset = { Y = 5.0 }"));
}

#[test]
fn every_key_of_the_contract_is_taken() {
    let configuration = r##"
control = "haas-mill"
[machine]
name = "VF-2"
axes = ["X", "Y", "Z", "A", "B"]
units = "mm"
travel.X = [-762.0, 0.0]
max_rpm = 8100
max_feed = 12700.0
rapid = 25400.0
tool_change_seconds = 4.0
rotary = "head-head"
rotary_order = ["A", "B"]
rotary_sign = { A = 1, B = 1 }
rotary_direction = { B = [0.0, 1.0, 1.0] }
pivot_length = 150.0
rotary_offset = { Z = 20.0 }
bar_length = 1200.0
bars = 4
[settings]
162 = false
34 = 6.0
40 = "diameter"
[variables]
"#3100" = 2.5
[offsets]
G54 = { X = -400.0, Y = -200.0, Z = 0.0 }
[tools]
1 = { length = 120.0, diameter = 12.0, corner_radius = 0.0 }
[codes]
M51 = { title = "air blast on", group = "user" }
G150 = { alias = "O9010" }
[search]
paths = ["macros/"]
[rules]
select = ["recommended"]
missing-decimal-point = "info"
[per-file-ignores]
"legacy/**" = ["words"]
[[overrides]]
files = ["lathe/**"]
control = "haas-lathe"
"##;
    let macros = ("macros/O9010.nc", "%\nO9010\nM99\n%\n");
    let shop = Shop::with(&[("part.nc", WARNED), ("gcheck.toml", configuration), macros]);
    let run = shop.gcheck("check part.nc --output-format concise --quiet");
    assert_eq!((run.stderr.as_str(), run.rules()), ("", vec!["missing-decimal-point".to_owned()]));
}

#[test]
fn a_setting_of_another_control_of_the_folder_is_taken() {
    let lathe = "control = \"haas-mill\"\n[settings]\n99 = 0.01\n[[overrides]]\nfiles = [\"lathe/**\"]\ncontrol = \"haas-lathe\"\n";
    check_part(WARNED, lathe, &["missing-decimal-point"]);
}

#[test]
fn what_is_in_force_is_shown() {
    let shop = Shop::with(&[
        (
            "gcheck.toml",
            "control = \"haas-mill\"\n[machine]\naxes = [\"X\", \"Y\", \"Z\"]\n[settings]\n162 = true\n[codes]\nM451 = { title = \"air\" }\n\
             [search]\npaths = [\"macros\"]\n[rules]\nselect = [\"unknown-code\", \"unknown-address\"]\nunknown-code = \"warning\"\n",
        ),
        ("part.nc", GOOD),
        ("macros/readme.txt", ""),
    ]);
    expect![[r#"
        part.nc
          control: haas-mill, by configuration (gcheck.toml)
          configuration: gcheck.toml
          axes: X Y Z
          setting 162: on
          code M451: air
          search: macros
          rules (2): unknown-address, unknown-code=warning

        exit 0
    "#]]
    .assert_eq(&shop.gcheck("check --show-settings").to_string());
    expect![[r#"
        part.nc
          control: linuxcnc, by option
          configuration: none
          rules (2): codes-conflict, too-many-m-codes

        exit 0
    "#]].assert_eq(&shop.gcheck("check --show-settings --isolated --select too-many-m-codes,codes-conflict --control linuxcnc").to_string());
}

#[test]
fn of_many_rules_what_differs_from_the_recommended_ones_is_shown() {
    let shop = Shop::with(&[
        (
            "gcheck.toml",
            "[rules]\nextend-select = [\"minus-zero\"]\nunknown-code = \"info\"\nfeed-zero = \"off\"\n",
        ),
        ("part.nc", GOOD),
    ]);
    let run = shop.gcheck("check --show-settings").to_string();
    let line = run.lines().find(|line| line.contains("rules (")).unwrap_or_default();
    let (_, differs) = line.split_once(": ").unwrap_or_default();
    expect![
        "the recommended ones; and minus-zero; with another severity unknown-code=info; without feed-zero"
    ]
    .assert_eq(differs);
}

#[test]
fn the_machine_in_force_can_be_looked_at() {
    let shop = Shop::with(&[
        (
            "gcheck.toml",
            "control = \"haas-mill\"\n[machine]\nunits = \"inch\"\ntravel.X = [-30.0, 0.0]\ntravel.B = [-32.0, 32.0]\n\
             max_rpm = 8100\nmax_feed = 500.0\n[offsets]\nG54 = { X = -10.0 }\n[tools]\n1 = { length = 4.0 }\n2 = { length = 5.0 }\n",
        ),
        ("part.nc", GOOD),
        ("macros/readme.txt", ""),
    ]);
    expect![[r#"
        part.nc
          control: haas-mill, by configuration (gcheck.toml)
          configuration: gcheck.toml
          travel X: -762 to 0 mm
          travel B: -32 to 32 degrees
          speed: at most 8100 rpm
          feed: at most 12700 mm/min
          work offsets known: 1
          tools known: 2
          rules (10): arc-breaks-contour, arc-centre-and-radius, arc-end-off-circle, arc-mode-left-on, arc-radius-too-small, arc-turns-not-whole, arc-wrong-plane-word, circle-on-far-side, full-circle-by-radius, zero-radius-arc

        exit 0
    "#]].assert_eq(&shop.gcheck("check --show-settings --select arcs").to_string());
}

#[test]
fn a_mistake_is_said_where_there_are_no_programs_yet() {
    let shop = Shop::with(&[("gcheck.toml", "[machine]\naxis = [\"X\"]\n")]);
    let run = shop.gcheck("check");
    assert_eq!(run.code, 2, "{run}");
    assert!(run.stderr.contains("gcheck.toml:2:1: ") && run.stderr.contains("`axes`"), "{run}");
}
