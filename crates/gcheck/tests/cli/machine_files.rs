//! `gcheck machine import` of machines that are in several files, or come from programs that plan and send motion.

use expect_test::{Expect, expect};

use crate::shop::Shop;

/// Imports files of a folder and shows what is told and what `gcheck.toml` then is.
fn check(files: &[(&str, &str)], arguments: &str, expected: &Expect) {
    let shop = Shop::with(files);
    let run = shop.gcheck(&format!("machine import {arguments}"));
    let is_written = shop.names().contains(&"gcheck.toml".to_owned());
    let written = if is_written { shop.read("gcheck.toml") } else { String::new() };
    expected.assert_eq(&format!("{run}{written}"));
}

const TRAJ: &str =
    "[TRAJ]\nCOORDINATES = X Z\nLINEAR_UNITS = mm\nMAX_LINEAR_VELOCITY = 50\n[KINS]\nKINEMATICS = trivkins\n";
const X: &str = "[AXIS_X]\nMIN_LIMIT = -300\nMAX_LIMIT = 0\nMAX_VELOCITY = 100\nMAX_ACCELERATION = 500\n";
const Z: &str = "[AXIS_Z]\nMIN_LIMIT = -120\nMAX_LIMIT = 5\nMAX_VELOCITY = 40\nMAX_ACCELERATION = 400\n";

#[test]
fn an_ini_file_is_read_with_the_files_that_it_includes() {
    check(
        &[
            (
                "mill.ini",
                "# all of it is elsewhere\n#INCLUDE traj.inc\n#INCLUDE axes/x.inc\n#INCLUDE axes/z.inc\n",
            ),
            ("traj.inc", TRAJ),
            ("axes/x.inc", X),
            ("axes/z.inc", Z),
        ],
        "mill.ini",
        &expect![[r#"
            wrote gcheck.toml: 8 values
            next: name the control in it, `control = "NAME"` (`gcheck controls` lists them), then `gcheck check --show-settings`
            ! mill.ini:2: not used: [TRAJ] MAX_LINEAR_VELOCITY of traj.inc: it allows 3000 mm/min, more than the slowest axis reaches (2400 mm/min), so `max_feed` is not written
            exit 0
            # Configuration of gcheck for the programs in this folder and below.

            [machine]
            units = "mm"  # from mill.ini
            axes = ["X", "Z"]  # from mill.ini, [TRAJ] COORDINATES
            travel.X = [-300.0, 0.0]  # from mill.ini, [AXIS_X] MIN_LIMIT of x.inc and MAX_LIMIT
            travel.Z = [-120.0, 5.0]  # from mill.ini, [AXIS_Z] MIN_LIMIT of z.inc and MAX_LIMIT
            rapid.X = 3000.0  # from mill.ini, [AXIS_X] MAX_VELOCITY of x.inc * 60, held by [TRAJ] MAX_LINEAR_VELOCITY
            rapid.Z = 2400.0  # from mill.ini, [AXIS_Z] MAX_VELOCITY of z.inc * 60
            acceleration.X = 500.0  # from mill.ini, [AXIS_X] MAX_ACCELERATION of x.inc
            acceleration.Z = 400.0  # from mill.ini, [AXIS_Z] MAX_ACCELERATION of z.inc
        "#]],
    );
}

#[test]
fn files_that_cannot_be_included_are_listed() {
    let ini = format!("#INCLUDE\n#INCLUDE nosuchfile\n#INCLUDE ~/mine.inc\n#INCLUDE round.inc\n{TRAJ}{X}{Z}");
    check(
        &[("mill.ini", &ini), ("round.inc", "[EMC]\nMACHINE = Round\n#INCLUDE round.inc\n")],
        "mill.ini",
        &expect![[r#"
            wrote gcheck.toml: 9 values
            next: name the control in it, `control = "NAME"` (`gcheck controls` lists them), then `gcheck check --show-settings`
            ! mill.ini:1: not used: `#INCLUDE`: it names no file
            ! mill.ini:2: not used: `#INCLUDE nosuchfile`: the file nosuchfile does not exist
            ! mill.ini:3: not used: `#INCLUDE ~/mine.inc`: files of a home folder are not read; name it by its path
            ! mill.ini:4: not used: `#INCLUDE round.inc`: the file includes itself
            ! mill.ini:8: not used: [TRAJ] MAX_LINEAR_VELOCITY: it allows 3000 mm/min, more than the slowest axis reaches (2400 mm/min), so `max_feed` is not written
            exit 0
            # Configuration of gcheck for the programs in this folder and below.

            [machine]
            units = "mm"  # from mill.ini
            name = "Round"  # from mill.ini, [EMC] MACHINE of round.inc
            axes = ["X", "Z"]  # from mill.ini, [TRAJ] COORDINATES
            travel.X = [-300.0, 0.0]  # from mill.ini, [AXIS_X] MIN_LIMIT and MAX_LIMIT
            travel.Z = [-120.0, 5.0]  # from mill.ini, [AXIS_Z] MIN_LIMIT and MAX_LIMIT
            rapid.X = 3000.0  # from mill.ini, [AXIS_X] MAX_VELOCITY * 60, held by [TRAJ] MAX_LINEAR_VELOCITY
            rapid.Z = 2400.0  # from mill.ini, [AXIS_Z] MAX_VELOCITY * 60
            acceleration.X = 500.0  # from mill.ini, [AXIS_X] MAX_ACCELERATION
            acceleration.Z = 400.0  # from mill.ini, [AXIS_Z] MAX_ACCELERATION
        "#]],
    );
}

#[test]
fn an_axis_in_a_file_that_is_missing_is_listed_and_not_called_cut_short() {
    check(
        &[("mill.ini", &format!("{TRAJ}{X}#INCLUDE z.inc\n"))],
        "mill.ini --dry-run",
        &expect![[r##"
        # Configuration of gcheck for the programs in this folder and below.

        [machine]
        units = "mm"  # from mill.ini
        axes = ["X", "Z"]  # from mill.ini, [TRAJ] COORDINATES
        travel.X = [-300.0, 0.0]  # from mill.ini, [AXIS_X] MIN_LIMIT and MAX_LIMIT
        rapid.X = 3000.0  # from mill.ini, [AXIS_X] MAX_VELOCITY * 60, held by [TRAJ] MAX_LINEAR_VELOCITY
        acceleration.X = 500.0  # from mill.ini, [AXIS_X] MAX_ACCELERATION
        max_feed = 3000.0  # from mill.ini, [TRAJ] MAX_LINEAR_VELOCITY * 60
        ! mill.ini:2: not used: axis Z: the axis has no section with limits
        ! mill.ini:12: not used: `#INCLUDE z.inc`: the file z.inc does not exist
        exit 0
    "##]],
    );
}

#[test]
fn limits_that_a_hal_file_sets_count_over_those_of_the_ini_file() {
    let hal = "# after the screen is up\nsetp ini.x.max_velocity 25\nsetp ini.z.max_acceleration [AXIS_X]MAX_ACCELERATION\n\
        setp ini.x.min_limit -250.5\nnet pot => ini.z.max_velocity\nsetp ini.0.ferror 1\n";
    let ini = format!(
        "{TRAJ}{X}{Z}[HAL]\nHALFILE = core.hal\nHALFILE = LIB:basic_sim.tcl\nPOSTGUI_HALFILE = post.hal\n\
         POSTGUI_HALCMD = setp ini.traj_max_velocity 20\n"
    );
    check(
        &[("mill.ini", &ini), ("post.hal", hal), ("core.hal", "loadrt trivkins\n")],
        "mill.ini",
        &expect![[r#"
            wrote gcheck.toml: 9 values
            next: name the control in it, `control = "NAME"` (`gcheck controls` lists them), then `gcheck check --show-settings`
            ! mill.ini:4: not used: [TRAJ] MAX_LINEAR_VELOCITY: the value as POSTGUI_HALCMD sets it (ini.traj_max_velocity) counts
            ! mill.ini:8: not used: [AXIS_X] MIN_LIMIT: the value as post.hal sets it (ini.x.min_limit) counts
            ! mill.ini:10: not used: [AXIS_X] MAX_VELOCITY: the value as post.hal sets it (ini.x.max_velocity) counts
            ! mill.ini:16: not used: [AXIS_Z] MAX_ACCELERATION: the value as post.hal sets it (ini.z.max_acceleration) counts
            ! mill.ini:19: not used: [HAL] LIB:basic_sim.tcl: files of the control's library and of home folders are not read
            ! mill.ini:20: not used: ini.z.max_velocity of post.hal: a signal sets it while the machine runs
            exit 0
            # Configuration of gcheck for the programs in this folder and below.

            [machine]
            units = "mm"  # from mill.ini
            axes = ["X", "Z"]  # from mill.ini, [TRAJ] COORDINATES
            travel.X = [-250.5, 0.0]  # from mill.ini, [AXIS_X] MIN_LIMIT as post.hal sets it (ini.x.min_limit) and MAX_LIMIT
            travel.Z = [-120.0, 5.0]  # from mill.ini, [AXIS_Z] MIN_LIMIT and MAX_LIMIT
            rapid.X = 1200.0  # from mill.ini, [AXIS_X] MAX_VELOCITY as post.hal sets it (ini.x.max_velocity) * 60, held by [TRAJ] MAX_LI
            rapid.Z = 1200.0  # from mill.ini, [AXIS_Z] MAX_VELOCITY * 60, held by [TRAJ] MAX_LINEAR_VELOCITY
            acceleration.X = 500.0  # from mill.ini, [AXIS_X] MAX_ACCELERATION
            acceleration.Z = 500.0  # from mill.ini, [AXIS_Z] MAX_ACCELERATION as post.hal sets it (ini.z.max_acceleration)
            max_feed = 1200.0  # from mill.ini, [TRAJ] MAX_LINEAR_VELOCITY as POSTGUI_HALCMD sets it (ini.traj_max_velocity) * 60
        "#]],
    );
}

#[test]
fn a_limit_of_a_hal_file_is_judged_as_one_of_the_ini_file() {
    let ini = format!("{TRAJ}{X}{Z}[HAL]\nPOSTGUI_HALFILE = post.hal\n");
    check(
        &[("mill.ini", &ini), ("post.hal", "setp ini.x.max_velocity 0\n")],
        "mill.ini",
        &expect![[r#"
        ! error: mill.ini:18:1: [AXIS_X] MAX_VELOCITY as post.hal sets it (ini.x.max_velocity) is 0: it must be greater than zero
        !    |
        ! 18 | POSTGUI_HALFILE = post.hal
        !    | ^^^^^^^^^^^^^^^^^^^^^^^^^^
        exit 2
    "#]],
    );
}

const CAM_MACHINE: &str = r#"{
    "freecad_version": "1.2.0",
    "machine": {
        "axes": {
            "Z": { "type": "linear", "limits": { "min": -420, "max": 0 }, "max_velocity": 15000 },
            "X": { "type": "linear", "limits": { "min": 0, "max": 1000 }, "max_velocity": 10000 },
            "A": { "type": "rotary", "role": "table_rotary", "limits": { "min": -120, "max": 30 }, "max_velocity": 9000 }
        },
        "name": "Shop mill",
        "toolheads": [{ "toolhead_type": "rotary", "min_rpm": 50, "max_rpm": 12000 }],
        "units": "metric"
    },
    "output": { "units": "metric" },
    "version": 1
}
"#;

#[test]
fn a_machine_of_a_cam_program_gives_what_is_not_its_default() {
    check(
        &[("mill.fcm", CAM_MACHINE)],
        "mill.fcm",
        &expect![[r#"
            wrote gcheck.toml: 8 values
            next: name the control in it, `control = "NAME"` (`gcheck controls` lists them), then `gcheck check --show-settings`
            ! mill.fcm:6: not used: limits of X, max_velocity of X: it is what FreeCAD gives a new machine, and says nothing of this one
            ! mill.fcm:7: not used: role of A: which rotary axis carries which is not read: write `rotary` and `rotary_order`
            ! mill.fcm:13: not used: `output`: `gcheck.toml` has no key for it
            exit 0
            # Configuration of gcheck for the programs in this folder and below.

            [machine]
            units = "mm"  # from mill.fcm
            name = "Shop mill"  # from mill.fcm, name
            axes = ["X", "Z", "A"]  # from mill.fcm, axes
            travel.Z = [-420.0, 0.0]  # from mill.fcm, limits of Z
            travel.A = [-120.0, 30.0]  # from mill.fcm, limits of A
            rapid.Z = 15000.0  # from mill.fcm, max_velocity of Z
            rapid.A = 9000.0  # from mill.fcm, max_velocity of A
            max_rpm = 12000.0  # from mill.fcm, max_rpm
        "#]],
    );
}

#[test]
fn a_machine_file_that_is_cut_short_or_impossible_writes_nothing() {
    let half = CAM_MACHINE.get(..300).unwrap();
    check(
        &[("mill.fcm", half)],
        "mill.fcm",
        &expect![[r#"
        ! error: mill.fcm:7:33: the file ends in the middle of its JSON; is it cut short?
        !   |
        ! 7 |             "A": { "type": "rotar
        !   |                                 ^
        exit 2
    "#]],
    );
    let impossible = CAM_MACHINE
        .replace("15000", "-1")
        .replace("\"max\": 30", "\"max\": -300")
        .replace("metric", "metres");
    check(
        &[("mill.fcm", &impossible)],
        "mill.fcm",
        &expect![[r#"
        ! error: mill.fcm:5:13: max_velocity of Z is -1: it must be greater than zero
        !   |
        ! 5 |             "Z": { "type": "linear", "limits": { "min": -420, "max": 0 }, "max_velocity": -1 },
        !   |             ^
        ! error: mill.fcm:7:13: limits of A: max is -300, which is not above min (-120)
        !   |
        ! 7 |             "A": { "type": "rotary", "role": "table_rotary", "limits": { "min": -120, "max": -300 }, "max_velocity": 9000 }
        !   |             ^
        ! error: mill.fcm:11:9: `units` is `metres`; known are metric and imperial
        !    |
        ! 11 |         "units": "metres"
        !    |         ^
        exit 2
    "#]],
    );
    check(
        &[("mill.fcm", "{ \"machine\": {} }")],
        "mill.fcm",
        &expect![[r#"
        ! error: mill.fcm:1:1: the file has no `machine` with `axes`, so it is not a machine
        !   |
        ! 1 | { "machine": {} }
        !   | ^
        exit 2
    "#]],
    );
}

#[test]
fn a_yaml_configuration_gives_rates_and_travels_from_where_axes_home() {
    let yaml = "name: \"Desk router\"\nboard: 6 Pack\nkinematics:\n  Cartesian:\naxes:\n  shared_stepper_disable_pin: NO_PIN\n  x:\n    \
        steps_per_mm: 80\n    max_rate_mm_per_min: 5000.000\n    acceleration_mm_per_sec2: 250.000\n    max_travel_mm: 400.000\n    \
        soft_limits: true\n    homing:\n      cycle: 2\n      positive_direction: false\n      mpos_mm: 0.000\n    motor0:\n      \
        hard_limits: false\n  z:\n    max_rate_mm_per_min: 900\n    acceleration_mm_per_sec2: 80 # gentle\n    max_travel_mm: 90\n    \
        homing:\n      cycle: 1\n      positive_direction: true\n      mpos_mm: 5\n  a:\n    max_rate_mm_per_min: 3600\n    \
        acceleration_mm_per_sec2: 500\n    max_travel_mm: 360\n";
    check(
        &[("config.yaml", yaml)],
        "config.yaml",
        &expect![[r#"
            wrote gcheck.toml: 11 values
            next: name the control in it, `control = "NAME"` (`gcheck controls` lists them), then `gcheck check --show-settings`
            ! config.yaml:30: not used: max_travel_mm of A: the axis does not home, so that nothing tells where its travel ends
            exit 0
            # Configuration of gcheck for the programs in this folder and below.

            [machine]
            units = "mm"  # from config.yaml
            name = "Desk router"  # from config.yaml, name
            axes = ["X", "Z", "A"]  # from config.yaml, axes
            rapid.X = 5000.0  # from config.yaml, axes.x.max_rate_mm_per_min
            rapid.Z = 900.0  # from config.yaml, axes.z.max_rate_mm_per_min
            rapid.A = 3600.0  # from config.yaml, axes.a.max_rate_mm_per_min
            acceleration.X = 250.0  # from config.yaml, axes.x.acceleration_mm_per_sec2
            acceleration.Z = 80.0  # from config.yaml, axes.z.acceleration_mm_per_sec2
            acceleration.A = 500.0  # from config.yaml, axes.a.acceleration_mm_per_sec2
            travel.X = [0.0, 400.0]  # from config.yaml, axes.x.max_travel_mm from where it homes
            travel.Z = [-85.0, 5.0]  # from config.yaml, axes.z.max_travel_mm from where it homes
        "#]],
    );
    check(
        &[("config.yaml", &yaml.replace("5000.000", "0"))],
        "config.yaml",
        &expect![[r#"
        ! error: config.yaml:9:5: max_rate_mm_per_min of X is 0: it must be greater than zero
        !   |
        ! 9 |     max_rate_mm_per_min: 0
        !   |     ^^^^^^^^^^^^^^^^^^^^^^
        exit 2
    "#]],
    );
}
