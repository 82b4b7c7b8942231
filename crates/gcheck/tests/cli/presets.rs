//! Models of machines that a configuration inherits by name.

use expect_test::{Expect, expect};

use crate::shop::{GOOD, Shop};

fn settings(configuration: &str, expected: &Expect) {
    let shop = Shop::with(&[("gcheck.toml", configuration), ("part.nc", GOOD)]);
    let run = shop.gcheck("check --show-settings").to_string();
    let shown = run.lines().filter(|line| !line.trim_start().starts_with("rules"));
    expected.assert_eq(&shown.map(|line| format!("{line}\n")).collect::<String>());
}

#[test]
fn a_preset_counts_below_what_the_file_says() {
    settings(
        "control = \"grbl\"\n[machine]\npreset = \"shapeoko-3\"\nunits = \"mm\"\nmax_rpm = 24000\nacceleration.Z = 200.0\n",
        &expect![[r#"
            part.nc
              control: grbl, by configuration (gcheck.toml)
              configuration: gcheck.toml
              preset: shapeoko-3
              axes: X Y Z
              speed: at most 24000 rpm
              rapid: X 5000 mm/min, Y 5000 mm/min, Z 5000 mm/min
              acceleration: X 400 mm/s², Y 400 mm/s², Z 200 mm/s²

            exit 0
        "#]],
    );
}

#[test]
fn the_unit_of_a_preset_is_that_of_its_own_lengths() {
    settings(
        "control = \"fanuc-mill\"\n[machine]\npreset = \"tormach-1100mx\"\nmax_feed = 5000.0\n",
        &expect![[r#"
            part.nc
              control: fanuc-mill, by configuration (gcheck.toml)
              configuration: gcheck.toml
              preset: tormach-1100mx
              axes: X Y Z
              speed: at most 10000 rpm
              feed: at most 5000 mm/min
              rapid: X 7620 mm/min, Y 7620 mm/min, Z 5842 mm/min

            exit 0
        "#]],
    );
}

#[test]
fn an_override_has_a_preset_of_its_own() {
    settings(
        "control = \"grbl\"\n[machine]\npreset = \"shapeoko-3\"\n[[overrides]]\nfiles = [\"part.nc\"]\nmachine.preset = \"sherline-5400\"\n",
        &expect![[r#"
            part.nc
              control: grbl, by configuration (gcheck.toml)
              configuration: gcheck.toml
              preset: sherline-5400
              axes: X Y Z
              speed: at most 2800 rpm
              rapid: X 635 mm/min, Y 635 mm/min, Z 635 mm/min
              acceleration: X 50 mm/s², Y 50 mm/s², Z 50 mm/s²

            exit 0
        "#]],
    );
}

#[test]
fn an_unknown_name_is_an_error_with_its_place() {
    let shop = Shop::with(&[("gcheck.toml", "[machine]\npreset = \"shapeoko-4\"\n"), ("part.nc", GOOD)]);
    expect![[r#"
        ! error: gcheck.toml:2:10: no preset is called `shapeoko-4`; did you mean `shapeoko-2`?
        !   |
        ! 2 | preset = "shapeoko-4"
        !   |          ^^^^^^^^^^^^
        exit 2
    "#]]
    .assert_eq(&shop.gcheck("check").to_string());
    expect![[r#"
        ! error: no machine is called `nothing-like-it`; `gcheck machine list` shows what there is
        exit 2
    "#]]
    .assert_eq(&shop.gcheck("machine show nothing-like-it").to_string());
}

#[test]
fn a_preset_that_contradicts_the_file_is_an_error() {
    let configuration =
        "control = \"grbl\"\n[machine]\npreset = \"sherline-5400\"\nunits = \"mm\"\nmax_feed = 900.0\n";
    let shop = Shop::with(&[("gcheck.toml", configuration), ("part.nc", GOOD)]);
    expect![[r#"
        ! error: gcheck.toml:5:12: max_feed is 900, and the preset `sherline-5400` has a rapid rate of 635: no axis cuts faster than it moves at rapid
        !   |
        ! 5 | max_feed = 900.0
        !   |            ^^^^^
        !   help: write `rapid` too, or a lower `max_feed`
        exit 2
    "#]]
    .assert_eq(&shop.gcheck("check").to_string());
}

#[test]
fn models_are_listed_and_shown_with_their_sources() {
    let shop = Shop::new();
    let list = shop.gcheck("machine list");
    assert!(list.to_string().contains("tormach-1100mx"), "{list}");
    expect![[r##"
        # Pocket NC V2 (revision P)
        [machine]
        # preset = "pocket-nc-v2" gives the same, below what else is here
        axes = ["X", "Y", "Z", "A", "B"]  # github.com/PocketNC/Settings, versions/v2revP/PocketNC.ini, [TRAJ] COORDINATES
        units = "inch"  # of the lengths below; a preset leaves the unit of the file as it is
        travel.A = [-25.0, 135.0]  # the same file, [AXIS_A]
        rapid = { X = 60.0, Y = 60.0, Z = 60.0, A = 2250.0, B = 2250.0 }  # the same file, [AXIS_*] MAX_VELOCITY * 60
        acceleration = { X = 10.0, Y = 10.0, Z = 10.0, A = 300.0, B = 300.0 }  # the same file, [AXIS_*] MAX_ACCELERATION
        rotary = "table-table"  # the same file, [KINS] KINEMATICS = xyzab-trt-kins: tilting rotary table
        exit 0
    "##]].assert_eq(&shop.gcheck("machine show pocket-nc-v2").to_string());
    expect![[r##"
        # Bob's CNC E3
        [machine]
        # preset = "bobscnc-e3" gives the same, below what else is here
        axes = ["X", "Y", "Z"]  # Grbl 1.1, grbl/defaults.h (github.com/gnea/grbl), DEFAULTS_BOBSCNC_E3
        units = "mm"  # of the lengths below; a preset leaves the unit of the file as it is
        travel.Z = [-85.0, 0.0]  # Grbl 1.1, grbl/defaults.h (github.com/gnea/grbl), DEFAULTS_BOBSCNC_E3, Z_MAX_TRAVEL and HOMING_DIR_MASK: Z homes to its upper end, and machine coordinates are negative
        rapid = { X = 10000.0, Y = 10000.0, Z = 500.0 }  # Grbl 1.1, grbl/defaults.h (github.com/gnea/grbl), DEFAULTS_BOBSCNC_E3, MAX_RATE
        acceleration = { X = 500.0, Y = 500.0, Z = 300.0 }  # Grbl 1.1, grbl/defaults.h (github.com/gnea/grbl), DEFAULTS_BOBSCNC_E3, ACCELERATION
        exit 0
    "##]].assert_eq(&shop.gcheck("machine show bobscnc-e3").to_string());
}

#[test]
fn what_is_shown_is_a_table_that_a_configuration_takes() {
    for name in ["pocket-nc-v2", "tormach-1100mx", "bobscnc-e4", "dah-lih-mcv-510"] {
        let shop = Shop::new();
        let shown = shop.gcheck(&format!("machine show {name}")).stdout;
        let shop = Shop::with(&[("gcheck.toml", shown.as_str()), ("part.nc", GOOD)]);
        let run = shop.gcheck("check --show-settings");
        assert_eq!(run.code, 0, "{name}: {run}");
    }
}
