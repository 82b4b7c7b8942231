//! `gcheck machine import`: what files of a shop become in `gcheck.toml`, and what is told of the rest.

use std::fmt::Write as _;

use expect_test::{Expect, expect};
use gcheck_testkit::skips::skip;

use crate::shop::{GOOD, Shop};

const INI: &str = "[EMC]\nMACHINE = Mill\n[TRAJ]\nCOORDINATES = X Z A\nLINEAR_UNITS = mm\nMAX_LINEAR_VELOCITY = 50\n\
    [KINS]\nKINEMATICS = trivkins\n\
    [AXIS_X]\nMIN_LIMIT = -300\nMAX_LIMIT = 0\nMAX_VELOCITY = 100\nMAX_ACCELERATION = 500\n\
    [JOINT_1]\nMIN_LIMIT = -120\nMAX_LIMIT = 5\nMAX_VELOCITY = 50\nMAX_ACCELERATION = 400\n\
    [AXIS_A]\nMIN_LIMIT = -1e99\nMAX_LIMIT = 1e99\nMAX_VELOCITY = 60\nMAX_ACCELERATION = 900\n\
    [SPINDLE_0]\nMAX_FORWARD_VELOCITY = 12000\n[EMCIO]\nTOOL_TABLE = tool.tbl\n";
const SETTINGS: &str = "$13=1\n$22=1\n$23=1\n$30=10000\n$32=0\n$100=250\n$101=250\n$110=5000\n$111=4000\n\
    $120=200\n$121=150\n$130=400\n$131=300\n[OPT:V,15,128]\nok\n";

/// Imports a file with this content and shows what is told and what `gcheck.toml` then is.
fn check(name: &str, content: &str, arguments: &str, expected: &Expect) {
    let shop = Shop::with(&[(name, content), ("tool.tbl", "T1 P1 Z10 D6\nT2 P2 Z20 D3\n")]);
    let run = shop.gcheck(&format!("machine import {name} {arguments}"));
    let written = if shop.names().contains(&"gcheck.toml".to_owned()) {
        shop.read("gcheck.toml")
    } else {
        String::new()
    };
    expected.assert_eq(&format!("{run}{written}"));
}

/// The same among these files; the arguments name those to import.
fn check_in(files: &[(&str, &str)], arguments: &str, expected: &Expect) {
    let shop = Shop::with(files);
    let run = shop.gcheck(&format!("machine import {arguments}"));
    let written = if shop.names().contains(&"gcheck.toml".to_owned()) {
        shop.read("gcheck.toml")
    } else {
        String::new()
    };
    expected.assert_eq(&format!("{run}{written}"));
}

#[test]
fn an_ini_file_gives_axes_limits_and_its_tool_table() {
    check(
        "mill.ini",
        INI,
        "",
        &expect![[r#"
            wrote gcheck.toml: 14 values
            next: name the control in it, `control = "NAME"` (`gcheck controls` lists them), then `gcheck check --show-settings`
            ! mill.ini:20: not used: [AXIS_A] MIN_LIMIT and MAX_LIMIT: the axis has no end of travel
            exit 0
            # Configuration of gcheck for the programs in this folder and below.

            [machine]
            units = "mm"  # from mill.ini
            name = "Mill"  # from mill.ini, [EMC] MACHINE
            axes = ["X", "Z", "A"]  # from mill.ini, [TRAJ] COORDINATES
            travel.X = [-300.0, 0.0]  # from mill.ini, [AXIS_X] MIN_LIMIT and MAX_LIMIT
            travel.Z = [-120.0, 5.0]  # from mill.ini, [JOINT_1] MIN_LIMIT and MAX_LIMIT
            rapid.X = 3000.0  # from mill.ini, [AXIS_X] MAX_VELOCITY * 60, held by [TRAJ] MAX_LINEAR_VELOCITY
            rapid.Z = 3000.0  # from mill.ini, [JOINT_1] MAX_VELOCITY * 60
            rapid.A = 3600.0  # from mill.ini, [AXIS_A] MAX_VELOCITY * 60
            acceleration.X = 500.0  # from mill.ini, [AXIS_X] MAX_ACCELERATION
            acceleration.Z = 400.0  # from mill.ini, [JOINT_1] MAX_ACCELERATION
            acceleration.A = 900.0  # from mill.ini, [AXIS_A] MAX_ACCELERATION
            max_feed = 3000.0  # from mill.ini, [TRAJ] MAX_LINEAR_VELOCITY * 60
            max_rpm = 12000.0  # from mill.ini, [SPINDLE_0] MAX_FORWARD_VELOCITY

            [tools]
            table = "tool.tbl"  # from mill.ini, [EMCIO] TOOL_TABLE: 2 tools
        "#]],
    );
}

#[test]
fn remapped_codes_are_codes_of_the_shop() {
    check(
        "mill.ini",
        "[TRAJ]\nLINEAR_UNITS = mm\n[RS274NGC]\n\
            REMAP = M400 modalgroup=10 argspec=Pq ngc=clamp\n\
            REMAP=g88.6 modalgroup=1 argspec=XYZ python=g886\n\
            REMAP=M6 modalgroup=6 ngc=change\n\
            REMAP=M401 modalgroup=10\n\
            REMAP=X1 ngc=none\n",
        "",
        &expect![[r#"
            wrote gcheck.toml: 2 values
            next: name the control in it, `control = "NAME"` (`gcheck controls` lists them), then `gcheck check --show-settings`
            ! mill.ini:6: not used: [RS274NGC] REMAP = M6: the procedure may do more or less than the code, and gcheck follows the code alone
            ! mill.ini:7: not used: [RS274NGC] REMAP = M401: it names no procedure (`ngc=` or `python=`)
            ! mill.ini:8: not used: [RS274NGC] REMAP = X1: it is neither a G nor an M code
            exit 0
            # Configuration of gcheck for the programs in this folder and below.

            [codes]
            M400 = { title = "remapped to clamp" }  # from mill.ini, [RS274NGC] REMAP
            "G88.6" = { title = "remapped to g886" }  # from mill.ini, [RS274NGC] REMAP
        "#]],
    );
    let shop = Shop::with(&[
        ("mill.ini", "[RS274NGC]\nREMAP=M21 ngc=clamp\n"),
        ("part.ngc", "G21 G90\nM21\nM22\nM2\n"),
    ]);
    shop.gcheck("machine import mill.ini --control linuxcnc");
    let found = shop.gcheck("check --output-format concise part.ngc");
    expect![[r#"
        part.ngc:3:1: warning[unknown-code] unknown code `M22`
        ! part.ngc: control linuxcnc, set in gcheck.toml
        ! 1 warning in 1 file (4 lines)
        exit 0
    "#]]
    .assert_eq(&format!("{found}"));
}

#[test]
fn settings_count_in_millimetres_and_homing_decides_where_travel_is() {
    check(
        "dump.txt",
        SETTINGS,
        "",
        &expect![[r#"
            wrote gcheck.toml: 9 values
            next: name the control in it, `control = "NAME"` (`gcheck controls` lists them), then `gcheck check --show-settings`
            ! dump.txt:1: not used: $13: it is about reports only; settings count in millimetres
            ! dump.txt:5: not used: $32: `gcheck.toml` has no key for it
            exit 0
            # Configuration of gcheck for the programs in this folder and below.

            [machine]
            units = "mm"  # from dump.txt
            axes = ["X", "Y"]  # from dump.txt, $100 to $101
            rapid.X = 5000.0  # from dump.txt, $110
            rapid.Y = 4000.0  # from dump.txt, $111
            acceleration.X = 200.0  # from dump.txt, $120
            acceleration.Y = 150.0  # from dump.txt, $121
            travel.X = [-400.0, 0.0]  # from dump.txt, $130, machine coordinates are negative
            travel.Y = [-300.0, 0.0]  # from dump.txt, $131, machine coordinates are negative
            max_rpm = 10000.0  # from dump.txt, $30
        "#]],
    );
    check(
        "dump.txt",
        &SETTINGS.replace("[OPT:V", "[OPT:VZ"),
        "--dry-run",
        &expect![[r##"
            # Configuration of gcheck for the programs in this folder and below.

            [machine]
            units = "mm"  # from dump.txt
            axes = ["X", "Y"]  # from dump.txt, $100 to $101
            rapid.X = 5000.0  # from dump.txt, $110
            rapid.Y = 4000.0  # from dump.txt, $111
            acceleration.X = 200.0  # from dump.txt, $120
            acceleration.Y = 150.0  # from dump.txt, $121
            travel.X = [0.0, 400.0]  # from dump.txt, $130, $23 homes X to its negative end, and that is zero
            travel.Y = [-300.0, 0.0]  # from dump.txt, $131, machine coordinates are negative
            max_rpm = 10000.0  # from dump.txt, $30
            ! dump.txt:1: not used: $13: it is about reports only; settings count in millimetres
            ! dump.txt:5: not used: $32: `gcheck.toml` has no key for it
            exit 0
        "##]],
    );
    check(
        "dump.txt",
        &SETTINGS.replace("$22=1", "$22=0").replace("$32=0", "$32=1"),
        "--dry-run",
        &expect![[r##"
            # Configuration of gcheck for the programs in this folder and below.

            [machine]
            units = "mm"  # from dump.txt
            axes = ["X", "Y"]  # from dump.txt, $100 to $101
            rapid.X = 5000.0  # from dump.txt, $110
            rapid.Y = 4000.0  # from dump.txt, $111
            acceleration.X = 200.0  # from dump.txt, $120
            acceleration.Y = 150.0  # from dump.txt, $121
            ! dump.txt:1: not used: $13: it is about reports only; settings count in millimetres
            ! dump.txt:4: not used: $30: it is the full power of a laser ($32=1), not a spindle speed
            ! dump.txt:5: not used: $32: `gcheck.toml` has no key for it
            ! dump.txt:12: not used: $130 (travel of X), $131 (travel of Y) (line 13): the machine does not home ($22=0), so its coordinates begin wherever it is switched on
            exit 0
        "##]],
    );
}

#[test]
fn a_tool_library_gives_what_is_clear() {
    let library = r#"{"data": [
{"type": "flat end mill", "unit": "millimeters", "description": "6 flat", "geometry": {"DC": 6, "LB": 25, "NOF": 3}, "post-process": {"number": 1}},
{"type": "ball end mill", "unit": "inches", "geometry": {"DC": 0.25, "assemblyGaugeLength": 2.5}, "post-process": {"number": 2}},
{"type": "drill", "unit": "millimeters", "geometry": {"DC": 5}, "post-process": {"number": 3}},
{"type": "drill", "unit": "millimeters", "geometry": {"DC": 5.5}, "post-process": {"number": 3}}
]}"#;
    check(
        "tools.json",
        library,
        "--config machine.units=mm",
        &expect![[r#"
            wrote gcheck.toml: 6 values
            next: name the control in it, `control = "NAME"` (`gcheck controls` lists them), then `gcheck check --show-settings`
            ! tools.json:2: not used: `LB` of 1 tool: it is the length below the holder, not the length offset
            ! tools.json:5: not used: tool 3: lines 4 and 5 have it with other sizes, so neither is written
            exit 0
            # Configuration of gcheck for the programs in this folder and below.

            [machine]
            units = "mm"  # from --config

            [tools]
            1 = { diameter = 6.0, teeth = 3 }  # from tools.json, 6 flat
            2 = { length = 63.5, diameter = 6.35, corner_radius = 3.175 }  # from tools.json, ball end mill
        "#]],
    );
}

#[test]
fn a_library_of_bits_names_them() {
    let shop = Shop::with(&[
        (
            "Library/Mill.fctl",
            r#"{"version": 1, "tools": [{"nr": 4, "path": "ball.fctb"}, {"nr": 5, "path": "none.fctb"}, {"nr": 6, "path": "../../key"}]}"#,
        ),
        (
            "Bit/ball.fctb",
            r#"{"version": 2, "name": "Ball", "shape": "ballend.fcstd", "parameter": {"Diameter": "0.25 in", "Length": "50 mm"}}"#,
        ),
    ]);
    expect![[r##"
        # Configuration of gcheck for the programs in this folder and below.

        [machine]
        units = "mm"  # from --config

        [tools]
        4 = { diameter = 6.35, corner_radius = 3.175 }  # from Mill.fctl, Ball
        ! Library/Mill.fctl:1: not used: `none.fctb`: there is no such bit beside the library or in `../Bit`
        ! Library/Mill.fctl:1: not used: `../../key`: the path of the bit leads out of the folder of bits
        ! Library/Mill.fctl:1: not used: `Length` of 1 tool: it is the length of the whole tool, not the length offset
        exit 0
    "##]].assert_eq(&shop.gcheck("machine import Library/Mill.fctl --dry-run --config machine.units=mm").to_string());
}

#[test]
fn a_probe_document_gives_limits_in_their_units() {
    let probe = "<MTConnectDevices><Devices><Device name=\"VMC\"><Components><Axes><Components>\n\
        <Linear name=\"X\"><DataItems><DataItem type=\"POSITION\" units=\"MILLIMETER\"><Constraints><Minimum>-500</Minimum><Maximum>0</Maximum></Constraints></DataItem>\n\
        <DataItem type=\"AXIS_FEEDRATE\" units=\"MILLIMETER/SECOND\"><Constraints><Maximum>400</Maximum></Constraints></DataItem></DataItems></Linear>\n\
        <Rotary name=\"S\"><DataItems><DataItem type=\"ROTARY_VELOCITY\" units=\"REVOLUTION/MINUTE\"><Constraints><Maximum>8000</Maximum></Constraints></DataItem></DataItems></Rotary>\n\
        </Components></Axes></Components></Device></Devices></MTConnectDevices>";
    check(
        "probe.xml",
        probe,
        "--config machine.units=mm",
        &expect![[r#"
            wrote gcheck.toml: 6 values
            next: name the control in it, `control = "NAME"` (`gcheck controls` lists them), then `gcheck check --show-settings`
            exit 0
            # Configuration of gcheck for the programs in this folder and below.

            [machine]
            units = "mm"  # from --config
            name = "VMC"  # from probe.xml, the name of the device
            axes = ["X"]  # from probe.xml, its axes
            travel.X = [-500.0, 0.0]  # from probe.xml, X POSITION Minimum and Maximum
            rapid.X = 24000.0  # from probe.xml, X AXIS_FEEDRATE Maximum * 60
            max_rpm = 8000.0  # from probe.xml, S ROTARY_VELOCITY Maximum
        "#]],
    );
    check(
        "probe.xml",
        probe.split_at(300).0,
        "",
        &expect![[r#"
        ! error: probe.xml:3:58: the XML cannot be read: syntax error: tag not closed: `>` not found before end of input
        !   |
        ! 3 | <DataItem type="AXIS_FEEDRATE" units="MILLIMETER/SECOND"><Constraint
        !   |                                                          ^^^^^^^^^^^
        exit 2
    "#]],
    );
}

#[test]
fn offsets_are_those_at_the_end_of_the_program() {
    let dump = "%\nO9999 (OFFSETS)\nG90 G21\nG10 L2 P1 X-400. Y-200. Z0.\nG10 L10 P1 R120.5\nG10 L11 P1 R-0.1\nM30\n%\n";
    check(
        "offsets.nc",
        dump,
        "--control fanuc-mill",
        &expect![[r#"
            wrote gcheck.toml: 6 values
            next: `gcheck check --show-settings`
            exit 0
            # Configuration of gcheck for the programs in this folder and below.
            control = "fanuc-mill"  # from --control

            [machine]
            units = "mm"  # from fanuc-mill, its unit at power-on

            [offsets]
            G54 = { X = -400.0, Y = -200.0, Z = 0.0 }  # from offsets.nc, run as a program of fanuc-mill

            [tools]
            1 = { length = 120.4 }  # from offsets.nc, run as a program of fanuc-mill
        "#]],
    );
    check(
        "offsets.nc",
        dump,
        "",
        &expect![[r#"
        ! error: offsets.nc: does not show for which control it is, and forms of `G10` differ
        !   help: name the control: `--control NAME`; `gcheck controls` lists them
        exit 2
    "#]],
    );
}

#[test]
fn what_is_in_the_file_stays_and_its_unit_counts() {
    let shop = Shop::with(&[
        ("mill.ini", INI),
        (
            "gcheck.toml",
            "# Ours.\n[machine] # the old one\nunits = \"inch\"\nmax_rpm = 9000 # measured\n\n[rules]\n# none\n",
        ),
    ]);
    expect![[r#"
        wrote gcheck.toml: 11 values, 1 kept
        next: name the control in it, `control = "NAME"` (`gcheck controls` lists them), then `gcheck check --show-settings`
        ! mill.ini:20: not used: [AXIS_A] MIN_LIMIT and MAX_LIMIT: the axis has no end of travel
        ! mill.ini:27: not used: [EMCIO] TOOL_TABLE: the file tool.tbl does not exist
        ! kept: machine.max_rpm is 9000 in gcheck.toml, and mill.ini:25 says 12000.0 (`--overwrite` takes the imported one)
        exit 0
        # Ours.
        [machine] # the old one
        units = "inch"
        max_rpm = 9000 # measured
        name = "Mill"  # from mill.ini, [EMC] MACHINE
        axes = ["X", "Z", "A"]  # from mill.ini, [TRAJ] COORDINATES
        travel.X = [-11.811024, 0.0]  # from mill.ini, [AXIS_X] MIN_LIMIT and MAX_LIMIT
        travel.Z = [-4.724409, 0.19685]  # from mill.ini, [JOINT_1] MIN_LIMIT and MAX_LIMIT
        rapid.X = 118.110236  # from mill.ini, [AXIS_X] MAX_VELOCITY * 60, held by [TRAJ] MAX_LINEAR_VELOCITY
        rapid.Z = 118.110236  # from mill.ini, [JOINT_1] MAX_VELOCITY * 60
        rapid.A = 3600.0  # from mill.ini, [AXIS_A] MAX_VELOCITY * 60
        acceleration.X = 19.685039  # from mill.ini, [AXIS_X] MAX_ACCELERATION
        acceleration.Z = 15.748031  # from mill.ini, [JOINT_1] MAX_ACCELERATION
        acceleration.A = 900.0  # from mill.ini, [AXIS_A] MAX_ACCELERATION
        max_feed = 118.110236  # from mill.ini, [TRAJ] MAX_LINEAR_VELOCITY * 60

        [rules]
        # none
    "#]].assert_eq(&format!(
        "{}{}",
        shop.gcheck("machine import mill.ini"),
        shop.read("gcheck.toml")
    ));
    let run = shop.gcheck("machine import mill.ini --overwrite --quiet");
    assert_eq!(run.code, 0, "{run}");
    assert!(
        shop.read("gcheck.toml").contains("max_rpm = 12000.0 # measured; from mill.ini, [SPINDLE_0]"),
        "{}",
        shop.read("gcheck.toml")
    );
    shop.file("part.nc", GOOD);
    assert_eq!(shop.gcheck("check part.nc --show-settings --control linuxcnc").code, 0);
}

#[test]
fn units_are_asked_for() {
    check(
        "mill.ini",
        &INI.replace("LINEAR_UNITS = mm\n", ""),
        "",
        &expect![[r#"
        ! error: mill.ini: does not say in which unit its lengths are
        !   help: name the unit: `--units mm` or `--units inch`
        exit 2
    "#]],
    );
    check(
        "mill.ini",
        INI,
        "--units inch",
        &expect![[r#"
        ! error: mill.ini:5:1: the lengths of the file count in mm, and `--units` says inch
        !   |
        ! 5 | LINEAR_UNITS = mm
        !   | ^^^^^^^^^^^^^^^^^
        exit 2
    "#]],
    );
    let shop = Shop::with(&[("mill.ini", INI), ("gcheck.toml", "[machine]\nmax_feed = 5000\n")]);
    expect![[r#"
        ! error: gcheck.toml: `machine.max_feed` is a length, and `[machine] units` is missing: imported lengths cannot be put beside it
        !   help: write `units = "mm"` or `units = "inch"` into its [machine]
        exit 2
    "#]].assert_eq(&shop.gcheck("machine import mill.ini --quiet").to_string());
}

#[test]
fn what_no_machine_has_writes_nothing() {
    check(
        "mill.ini",
        &INI.replace("MAX_VELOCITY = 100", "MAX_VELOCITY = 0").replace("MAX_LIMIT = 5", "MAX_LIMIT = -200"),
        "",
        &expect![[r#"
            ! error: mill.ini:12:1: [AXIS_X] MAX_VELOCITY is 0: it must be greater than zero
            !    |
            ! 12 | MAX_VELOCITY = 0
            !    | ^^^^^^^^^^^^^^^^
            ! error: mill.ini:16:1: [JOINT_1] MAX_LIMIT is -200, which is not above MIN_LIMIT (-120)
            !    |
            ! 16 | MAX_LIMIT = -200
            !    | ^^^^^^^^^^^^^^^^
            exit 2
        "#]],
    );
    check(
        "dump.txt",
        "$100=250\n$110=",
        "",
        &expect![[r#"
            ! error: dump.txt:2:1: $110 has no value; is the file cut short?
            !   |
            ! 2 | $110=
            !   | ^^^^^
            exit 2
        "#]],
    );
    check(
        "tools.json",
        "{\"data\": [{\"type\": \"drill\", ",
        "",
        &expect![[r#"
        ! error: tools.json:1:28: the file ends in the middle of its JSON; is it cut short?
        !   |
        ! 1 | {"data": [{"type": "drill", 
        !   |                            ^
        exit 2
    "#]],
    );
    check(
        "notes.txt",
        "nothing here\n",
        "",
        &expect![[r#"
            ! error: notes.txt: does not show in which format it describes a machine
            !   help: name it: `--format ini`, `tool-table`, `settings`, `yaml`, `fusion`, `freecad`, `freecad-machine`, `mtconnect` or `offsets`
            exit 2
        "#]],
    );
    check(
        "deep.json",
        &"[".repeat(100_000),
        "--format fusion",
        &expect![[r#"
        ! error: deep.json:1:128: the JSON cannot be read: recursion limit exceeded
        !   |
        ! 1 | [[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[
        !   |                                                                                                                                ^
        exit 2
    "#]],
    );
}

const OFFSETS: &str =
    "%\nO9999 (OFFSETS)\nG90 G21\nG10 L2 P1 X-400. Y-200. Z0.\nG10 L10 P1 R120.5\nG10 L12 P1 R12.\nM30\n%\n";

#[test]
fn offsets_are_read_as_the_configuration_says() {
    check_in(
        &[
            ("offsets.nc", OFFSETS),
            (
                "gcheck.toml",
                "control = \"haas-mill\"\n[machine]\nunits = \"mm\"\n[settings]\n40 = \"radius\"\n[tools]\n9 = { length = 5.0 }\n",
            ),
        ],
        "offsets.nc",
        &expect![[r#"
            wrote gcheck.toml: 5 values
            next: `gcheck check --show-settings`
            exit 0
            control = "haas-mill"
            [machine]
            units = "mm"
            [settings]
            40 = "radius"
            [tools]
            9 = { length = 5.0 }
            1 = { length = 120.5, diameter = 24.0 }  # from offsets.nc, run as a program of haas-mill

            [offsets]
            G54 = { X = -400.0, Y = -200.0, Z = 0.0 }  # from offsets.nc, run as a program of haas-mill
        "#]],
    );
    check_in(
        &[("offsets.nc", OFFSETS)],
        "offsets.nc --control haas-mill --config settings.40=radius",
        &expect![[r#"
        wrote gcheck.toml: 7 values
        next: `gcheck check --show-settings`
        exit 0
        # Configuration of gcheck for the programs in this folder and below.
        control = "haas-mill"  # from --control

        [machine]
        units = "mm"  # from offsets.nc

        [offsets]
        G54 = { X = -400.0, Y = -200.0, Z = 0.0 }  # from offsets.nc, run as a program of haas-mill

        [tools]
        1 = { length = 120.5, diameter = 24.0 }  # from offsets.nc, run as a program of haas-mill
    "#]],
    );
    check_in(
        &[
            ("offsets.nc", OFFSETS),
            ("base.toml", "control = \"haas-mill\"\n[settings]\n40 = \"radius\"\n"),
            ("gcheck.toml", "extend = \"base.toml\"\n"),
        ],
        "offsets.nc",
        &expect![[r#"
            wrote gcheck.toml: 6 values
            next: `gcheck check --show-settings`
            exit 0
            extend = "base.toml"

            [machine]
            units = "mm"  # from offsets.nc

            [offsets]
            G54 = { X = -400.0, Y = -200.0, Z = 0.0 }  # from offsets.nc, run as a program of haas-mill

            [tools]
            1 = { length = 120.5, diameter = 24.0 }  # from offsets.nc, run as a program of haas-mill
        "#]],
    );
}

#[test]
fn values_of_offsets_are_at_their_blocks() {
    check_in(
        &[
            ("offsets.nc", OFFSETS),
            (
                "gcheck.toml",
                "control = \"haas-mill\"\n[machine]\nunits = \"mm\"\n[offsets]\nG54 = { X = -1.0 }\n[tools]\n1 = { length = 5.0 }\n",
            ),
        ],
        "offsets.nc --dry-run",
        &expect![[r#"
            control = "haas-mill"
            [machine]
            units = "mm"
            [offsets]
            G54 = { X = -1.0, Y = -200.0, Z = 0.0 }  # from offsets.nc, run as a program of haas-mill
            [tools]
            1 = { length = 5.0, diameter = 12.0 }  # from offsets.nc, run as a program of haas-mill
            ! offsets.nc: assumed: setting 40 (tool offset measure) is `diameter`, as usual; `[settings] 40 = "diameter"` can say otherwise
            ! kept: offsets.G54.X is -1.0 in gcheck.toml, and offsets.nc:4 says -400.0 (`--overwrite` takes the imported one)
            ! kept: tools.1.length is 5.0 in gcheck.toml, and offsets.nc:5 says 120.5 (`--overwrite` takes the imported one)
            exit 0
            control = "haas-mill"
            [machine]
            units = "mm"
            [offsets]
            G54 = { X = -1.0 }
            [tools]
            1 = { length = 5.0 }
        "#]],
    );
    check_in(
        &[("offsets.nc", OFFSETS)],
        "offsets.nc --control haas-mill --units inch",
        &expect![[r#"
        ! error: offsets.nc:4:1: the lengths of the file count in mm, and `--units` says inch
        !   |
        ! 4 | G10 L2 P1 X-400. Y-200. Z0.
        !   | ^^^^^^^^^^^^^^^^^^^^^^^^^^^
        exit 2
    "#]],
    );
}

#[test]
fn offsets_without_a_unit_count_in_the_configured_one() {
    check_in(
        &[
            ("offsets.nc", &OFFSETS.replace("G90 G21", "G90")),
            (
                "gcheck.toml",
                "control = \"haas-mill\"\n[machine]\nunits = \"inch\"\n[settings]\n40 = \"diameter\"\n",
            ),
        ],
        "offsets.nc --quiet",
        &expect![[r#"
            exit 0
            control = "haas-mill"
            [machine]
            units = "inch"
            [settings]
            40 = "diameter"

            [offsets]
            G54 = { X = -400.0, Y = -200.0, Z = 0.0 }  # from offsets.nc, run as a program of haas-mill

            [tools]
            1 = { length = 120.5, diameter = 12.0 }  # from offsets.nc, run as a program of haas-mill
        "#]],
    );
}

const LIBRARY: &str = r#"{"data": [{"type": "drill", "unit": "millimeters", "geometry": {"DC": 25.4}, "post-process": {"number": 1}}]}"#;

#[test]
fn the_unit_of_a_library_is_not_that_of_the_machine() {
    check_in(
        &[("tools.json", LIBRARY)],
        "tools.json",
        &expect![[r#"
        ! error: tools.json: its lengths count in mm, which does not tell the unit of the machine, and gcheck.toml does not say it
        !   help: name the unit of the machine, which is also that of programs without a code for it: `--config machine.units=mm` or `--config machine.units=inch`
        exit 2
    "#]],
    );
    check_in(
        &[("tools.json", LIBRARY)],
        "tools.json --config machine.units=inch",
        &expect![[r#"
            wrote gcheck.toml: 2 values
            next: name the control in it, `control = "NAME"` (`gcheck controls` lists them), then `gcheck check --show-settings`
            exit 0
            # Configuration of gcheck for the programs in this folder and below.

            [machine]
            units = "inch"  # from --config

            [tools]
            1 = { diameter = 1.0 }  # from tools.json, drill
        "#]],
    );
    check_in(
        &[("tools.json", LIBRARY)],
        "tools.json --control grbl",
        &expect![[r#"
        wrote gcheck.toml: 3 values
        next: `gcheck check --show-settings`
        exit 0
        # Configuration of gcheck for the programs in this folder and below.
        control = "grbl"  # from --control

        [machine]
        units = "mm"  # from grbl, its unit at power-on

        [tools]
        1 = { diameter = 25.4 }  # from tools.json, drill
    "#]],
    );
    check_in(
        &[("tools.json", LIBRARY), ("mill.ini", INI)],
        "tools.json mill.ini --quiet",
        &expect![[r#"
        exit 0
        # Configuration of gcheck for the programs in this folder and below.

        [machine]
        units = "mm"  # from mill.ini
        name = "Mill"  # from mill.ini, [EMC] MACHINE
        axes = ["X", "Z", "A"]  # from mill.ini, [TRAJ] COORDINATES
        travel.X = [-300.0, 0.0]  # from mill.ini, [AXIS_X] MIN_LIMIT and MAX_LIMIT
        travel.Z = [-120.0, 5.0]  # from mill.ini, [JOINT_1] MIN_LIMIT and MAX_LIMIT
        rapid.X = 3000.0  # from mill.ini, [AXIS_X] MAX_VELOCITY * 60, held by [TRAJ] MAX_LINEAR_VELOCITY
        rapid.Z = 3000.0  # from mill.ini, [JOINT_1] MAX_VELOCITY * 60
        rapid.A = 3600.0  # from mill.ini, [AXIS_A] MAX_VELOCITY * 60
        acceleration.X = 500.0  # from mill.ini, [AXIS_X] MAX_ACCELERATION
        acceleration.Z = 400.0  # from mill.ini, [JOINT_1] MAX_ACCELERATION
        acceleration.A = 900.0  # from mill.ini, [AXIS_A] MAX_ACCELERATION
        max_feed = 3000.0  # from mill.ini, [TRAJ] MAX_LINEAR_VELOCITY * 60
        max_rpm = 12000.0  # from mill.ini, [SPINDLE_0] MAX_FORWARD_VELOCITY

        [tools]
        1 = { diameter = 25.4 }  # from tools.json, drill
    "#]],
    );
    check_in(
        &[
            ("tools.json", LIBRARY),
            ("base.toml", "[machine]\nunits = \"inch\"\n"),
            ("gcheck.toml", "extend = \"base.toml\"\n"),
        ],
        "tools.json",
        &expect![[r#"
            wrote gcheck.toml: 1 value
            next: name the control in it, `control = "NAME"` (`gcheck controls` lists them), then `gcheck check --show-settings`
            exit 0
            extend = "base.toml"

            [tools]
            1 = { diameter = 1.0 }  # from tools.json, drill
        "#]],
    );
}

#[test]
fn a_tool_table_that_is_configured_stays_in_its_unit() {
    let table = ("tool.tbl", "T1 P1 Z10 D6\n");
    check_in(
        &[table, ("mill.ini", INI), ("gcheck.toml", "[tools]\ntable = \"tool.tbl\"\n")],
        "mill.ini --quiet",
        &expect![[r#"
            ! error: gcheck.toml: `tools.table` is a length, and `[machine] units` is missing: imported lengths cannot be put beside it
            !   help: write `units = "mm"` or `units = "inch"` into its [machine]
            exit 2
            [tools]
            table = "tool.tbl"
        "#]],
    );
    check_in(
        &[
            table,
            ("tools.json", LIBRARY),
            ("gcheck.toml", "[machine]\ntable_units = \"inch\"\n[tools]\ntable = \"tool.tbl\"\n"),
        ],
        "tools.json --config machine.units=mm",
        &expect![[r#"
            wrote gcheck.toml: 2 values
            next: name the control in it, `control = "NAME"` (`gcheck controls` lists them), then `gcheck check --show-settings`
            exit 0
            [machine]
            table_units = "inch"
            units = "mm"  # from --config
            [tools]
            table = "tool.tbl"
            1 = { diameter = 25.4 }  # from tools.json, drill
        "#]],
    );
}

#[test]
fn a_tool_table_is_named_and_its_duplicates_are_listed() {
    let table = "T1 P1 Z10 D6\nT2 P2 Z20 D3\nT1 P1 Z11 D6\n";
    check_in(
        &[("tool.tbl", table)],
        "tool.tbl",
        &expect![[r#"
        ! error: tool.tbl: does not say in which unit its lengths are
        !   help: name the unit: `--units mm` or `--units inch`
        exit 2
    "#]],
    );
    check_in(
        &[("tool.tbl", table)],
        "tool.tbl --units inch",
        &expect![[r#"
            wrote gcheck.toml: 2 values
            next: name the control in it, `control = "NAME"` (`gcheck controls` lists them), then `gcheck check --show-settings`
            ! tool.tbl:1: not used: tool 1: line 3 has the tool again, and the later line counts
            exit 0
            # Configuration of gcheck for the programs in this folder and below.

            [machine]
            table_units = "inch"  # from --units

            [tools]
            table = "tool.tbl"  # from tool.tbl, 3 tools
        "#]],
    );
    check_in(
        &[("tool.tbl", table), ("gcheck.toml", "[machine]\nunits = \"mm\"\n")],
        "tool.tbl --units mm",
        &expect![[r#"
            wrote gcheck.toml: 1 value
            next: name the control in it, `control = "NAME"` (`gcheck controls` lists them), then `gcheck check --show-settings`
            ! tool.tbl:1: not used: tool 1: line 3 has the tool again, and the later line counts
            exit 0
            [machine]
            units = "mm"

            [tools]
            table = "tool.tbl"  # from tool.tbl, 3 tools
        "#]],
    );
    check_in(
        &[("tool.tbl", table), ("gcheck.toml", "[machine]\ntable_units = \"mm\"\n")],
        "tool.tbl --units inch --quiet",
        &expect![[r#"
            ! error: tool.tbl: the tool table counts in inch, and `machine.table_units` of gcheck.toml is mm
            !   help: `--overwrite` takes the unit of the imported table
            exit 2
            [machine]
            table_units = "mm"
        "#]],
    );
    check_in(
        &[("tools.csv", "\u{FEFF}tool;length;diameter\n3;1,5;0,25\n3;1,6;0,25\n")],
        "tools.csv --units inch",
        &expect![[r#"
            wrote gcheck.toml: 2 values
            next: name the control in it, `control = "NAME"` (`gcheck controls` lists them), then `gcheck check --show-settings`
            ! tools.csv:2: not used: tool 3: line 3 has the tool again, and the later line counts
            exit 0
            # Configuration of gcheck for the programs in this folder and below.

            [machine]
            table_units = "inch"  # from --units

            [tools]
            table = "tools.csv"  # from tools.csv, 2 tools
        "#]],
    );
    check_in(
        &[("tool.tbl", "\u{FEFF}T1 P1 Z10\n")],
        "tool.tbl --units mm",
        &expect![[r#"
        ! error: tool.tbl:1:1: a mark of the byte order is before the first tool; save the table without it (as UTF-8, not UTF-8 with BOM)
        !   |
        ! 1 | T1 P1 Z10
        !   | ^
        exit 2
    "#]],
    );
    check_in(
        &[("tool.tbl", "T1 P1 Z10\nT2 Zx\n")],
        "tool.tbl --units mm",
        &expect![[r#"
        ! error: tool.tbl:2:4: `Zx` is not a letter with a number
        !   |
        ! 2 | T2 Zx
        !   |    ^^
        exit 2
    "#]],
    );
}

const PROBE_OF_X: &str = "<MTConnectDevices><Devices><Device name=\"VMC\"><Components><Axes><Components>\n\
    <Linear name=\"X\"><DataItems>\n\
    <DataItem type=\"AXIS_FEEDRATE\" units=\"MILLIMETER/SECOND\"><Constraints><Maximum>400</Maximum></Constraints></DataItem>\n\
    </DataItems></Linear>\n\
    </Components></Axes></Components></Device></Devices></MTConnectDevices>";

#[test]
fn overwriting_keeps_comments_order_and_the_axes_that_are_not_imported() {
    let before = "[machine]\nunits = \"mm\"\naxes = [\n  \"X\", # the long one\n  \"Y\",\n  \"Z\", # down\n]\n# From the door.\nrapid = 5000 # measured\nmax_rpm   =   9000 # plate\n";
    check_in(
        &[("probe.xml", PROBE_OF_X), ("gcheck.toml", before)],
        "probe.xml",
        &expect![[r#"
            wrote gcheck.toml: 1 value, 2 kept
            next: name the control in it, `control = "NAME"` (`gcheck controls` lists them), then `gcheck check --show-settings`
            ! kept: machine.axes is ["X", "Y", "Z"] in gcheck.toml, and probe.xml:2 says ["X"] (`--overwrite` takes the imported one)
            ! kept: machine.rapid is 5000 in gcheck.toml, and probe.xml:3 gives it by axis (`--overwrite` takes the imported one)
            exit 0
            [machine]
            units = "mm"
            axes = [
              "X", # the long one
              "Y",
              "Z", # down
            ]
            # From the door.
            rapid = 5000 # measured
            max_rpm   =   9000 # plate
            name = "VMC"  # from probe.xml, the name of the device
        "#]],
    );
    check_in(
        &[("probe.xml", PROBE_OF_X), ("gcheck.toml", before)],
        "probe.xml --overwrite",
        &expect![[r#"
            wrote gcheck.toml: 3 values
            next: name the control in it, `control = "NAME"` (`gcheck controls` lists them), then `gcheck check --show-settings`
            ! machine.rapid was 5000 for every linear axis and is by axis; Y, Z keep it
            exit 0
            [machine]
            units = "mm"
            axes = [
              "X", # the long one
               # down
            ]  # from probe.xml, its axes
            # From the door.
            rapid.Y = 5000 # measured
            rapid.Z = 5000 # measured
            rapid.X = 24000.0  # from probe.xml, X AXIS_FEEDRATE Maximum * 60
            max_rpm   =   9000 # plate
            name = "VMC"  # from probe.xml, the name of the device
        "#]],
    );
    check_in(
        &[("mill.ini", INI), ("gcheck.toml", before)],
        "mill.ini --overwrite --quiet",
        &expect![[r#"
        exit 0
        [machine]
        units = "mm"
        axes = [
          "X", # the long one
          "Z",
          "A", # down
        ]  # from mill.ini, [TRAJ] COORDINATES
        # From the door.
        rapid.Y = 5000 # measured
        rapid.X = 3000.0  # from mill.ini, [AXIS_X] MAX_VELOCITY * 60, held by [TRAJ] MAX_LINEAR_VELOCITY
        rapid.Z = 3000.0  # from mill.ini, [JOINT_1] MAX_VELOCITY * 60
        rapid.A = 3600.0  # from mill.ini, [AXIS_A] MAX_VELOCITY * 60
        max_rpm   =   12000.0 # plate; from mill.ini, [SPINDLE_0] MAX_FORWARD_VELOCITY
        name = "Mill"  # from mill.ini, [EMC] MACHINE
        travel.X = [-300.0, 0.0]  # from mill.ini, [AXIS_X] MIN_LIMIT and MAX_LIMIT
        travel.Z = [-120.0, 5.0]  # from mill.ini, [JOINT_1] MIN_LIMIT and MAX_LIMIT
        acceleration.X = 500.0  # from mill.ini, [AXIS_X] MAX_ACCELERATION
        acceleration.Z = 400.0  # from mill.ini, [JOINT_1] MAX_ACCELERATION
        acceleration.A = 900.0  # from mill.ini, [AXIS_A] MAX_ACCELERATION
        max_feed = 3000.0  # from mill.ini, [TRAJ] MAX_LINEAR_VELOCITY * 60
    "#]],
    );
}

#[test]
fn a_value_for_all_axes_gives_way_in_its_place() {
    check_in(
        &[
            ("dump.txt", SETTINGS),
            (
                "gcheck.toml",
                "# All.\nmachine = { units = \"mm\", rapid = 100, max_rpm = 9000 } # in one line\n",
            ),
        ],
        "dump.txt --overwrite --quiet",
        &expect![[r#"
            exit 0
            # All.
            machine = { units = "mm", rapid = { X = 5000.0, Y = 4000.0 }, max_rpm = 10000.0, axes = ["X", "Y"], acceleration = { X = 200.0, Y = 150.0 }, travel = { X = [-400.0, 0.0], Y = [-300.0, 0.0] } } # in one line
        "#]],
    );
    check_in(
        &[
            ("dump.txt", SETTINGS),
            (
                "gcheck.toml",
                "[machine]\nunits = \"mm\"\n# Ours.\nrapid = { x = 100, Y = 4000 } # by axis\nmax_rpm = 1 # last\n",
            ),
        ],
        "dump.txt --overwrite --quiet",
        &expect![[r#"
            exit 0
            [machine]
            units = "mm"
            # Ours.
            rapid = { x = 5000.0, Y = 4000 } # by axis
            max_rpm = 10000.0 # last; from dump.txt, $30
            axes = ["X", "Y"]  # from dump.txt, $100 to $101
            acceleration.X = 200.0  # from dump.txt, $120
            acceleration.Y = 150.0  # from dump.txt, $121
            travel.X = [-400.0, 0.0]  # from dump.txt, $130, machine coordinates are negative
            travel.Y = [-300.0, 0.0]  # from dump.txt, $131, machine coordinates are negative
        "#]],
    );
    let all = "[machine]\nunits = \"mm\"\naxes = [\"X\", \"Y\"]\n# Door.\nrapid = 5000 # measured\n# Next.\nmax_rpm = 1\n";
    check_in(
        &[("dump.txt", SETTINGS), ("gcheck.toml", all)],
        "dump.txt --overwrite",
        &expect![[r#"
            wrote gcheck.toml: 7 values, 1 the same
            next: name the control in it, `control = "NAME"` (`gcheck controls` lists them), then `gcheck check --show-settings`
            ! dump.txt:1: not used: $13: it is about reports only; settings count in millimetres
            ! dump.txt:5: not used: $32: `gcheck.toml` has no key for it
            ! machine.rapid was 5000 for every linear axis and is by axis
            exit 0
            [machine]
            units = "mm"
            axes = ["X", "Y"]
            # Door.
            rapid.X = 5000.0 # measured; from dump.txt, $110
            rapid.Y = 4000.0  # from dump.txt, $111
            # Next.
            max_rpm = 10000.0  # from dump.txt, $30
            acceleration.X = 200.0  # from dump.txt, $120
            acceleration.Y = 150.0  # from dump.txt, $121
            travel.X = [-400.0, 0.0]  # from dump.txt, $130, machine coordinates are negative
            travel.Y = [-300.0, 0.0]  # from dump.txt, $131, machine coordinates are negative
        "#]],
    );
}

#[test]
fn a_rapid_rate_that_is_inherited_for_all_axes_is_listed() {
    check_in(
        &[
            ("probe.xml", PROBE_OF_X),
            ("base.toml", "[machine]\nunits = \"mm\"\nrapid = 5000\n"),
            ("gcheck.toml", "extend = \"base.toml\"\n"),
        ],
        "probe.xml",
        &expect![[r#"
            wrote gcheck.toml: 3 values
            next: name the control in it, `control = "NAME"` (`gcheck controls` lists them), then `gcheck check --show-settings`
            ! machine.rapid is 5000 in base.toml for every linear axis, and by axis in gcheck.toml: axes without one are as fast as the fastest
            exit 0
            extend = "base.toml"

            [machine]
            name = "VMC"  # from probe.xml, the name of the device
            axes = ["X"]  # from probe.xml, its axes
            rapid.X = 24000.0  # from probe.xml, X AXIS_FEEDRATE Maximum * 60
        "#]],
    );
}

#[test]
fn line_ends_and_the_mark_of_the_byte_order_stay() {
    let shop = Shop::with(&[
        ("dump.txt", &format!("\u{FEFF}{}", SETTINGS.replace('\n', "\r\n"))),
        ("gcheck.toml", "\u{FEFF}# Ours.\r\n[machine]\r\nunits = \"mm\"\r\n"),
    ]);
    let run = shop.gcheck("machine import dump.txt --quiet");
    assert_eq!(run.code, 0, "{run}");
    let written = shop.read("gcheck.toml");
    assert!(written.starts_with("\u{FEFF}# Ours.\r\n[machine]\r\nunits = \"mm\"\r\naxes = "), "{written:?}");
    assert_eq!(written.matches('\n').count(), written.matches("\r\n").count(), "{written:?}");
    assert_eq!(written.matches('\u{FEFF}').count(), 1, "{written:?}");
    let shop = Shop::with(&[("mill.ini", &format!("\u{FEFF}{INI}"))]);
    let run = shop.gcheck("machine import mill.ini --quiet");
    assert_eq!(run.code, 0, "{run}");
    assert!(shop.read("gcheck.toml").contains("name = \"Mill\""));
}

#[test]
fn units_of_bits_without_one_are_asked_for() {
    let files = [
        (
            "Mill.fctl",
            r#"{"tools": [{"nr": 1, "path": "a.fctb"}, {"nr": 2, "path": "b.fctb"}, {"nr": 3, "path": "c.fctb"}, {"nr": 4, "path": "d.fctb"}]}"#,
        ),
        ("a.fctb", r#"{"name": "A", "parameter": {"Diameter": "5 mm"}}"#),
        ("b.fctb", "\u{FEFF}{\"name\": \"B\", \"parameter\": {\"Diameter\": 0.5, \"Length\": \"50 mm\"}}"),
        ("c.fctb", r#"{"name": "C", "parameter": {"Diameter": "1,250 mm", "Length": "50 mm"}}"#),
        ("d.fctb", r#"{"name": "D", "parameter": {"Diameter": "6,35 mm"}}"#),
        ("gcheck.toml", "[machine]\nunits = \"mm\"\n"),
    ];
    check_in(
        &files,
        "Mill.fctl",
        &expect![[r#"
            wrote gcheck.toml: 2 values
            next: name the control in it, `control = "NAME"` (`gcheck controls` lists them), then `gcheck check --show-settings`
            ! Mill.fctl:1: not used: `Diameter` of `b.fctb`: it has no unit: name it with `--units mm` or `--units inch`
            ! Mill.fctl:1: not used: `Diameter` of `c.fctb`: `1,250 mm` may be 1.250 or 1250: write it without the comma
            ! Mill.fctl:1: not used: `Length` of 2 tools: it is the length of the whole tool, not the length offset
            exit 0
            [machine]
            units = "mm"

            [tools]
            1 = { diameter = 5.0 }  # from Mill.fctl, A
            4 = { diameter = 6.35 }  # from Mill.fctl, D
        "#]],
    );
    check_in(
        &files,
        "Mill.fctl --units inch",
        &expect![[r#"
            wrote gcheck.toml: 3 values
            next: name the control in it, `control = "NAME"` (`gcheck controls` lists them), then `gcheck check --show-settings`
            ! Mill.fctl:1: not used: `Diameter` of `c.fctb`: `1,250 mm` may be 1.250 or 1250: write it without the comma
            ! Mill.fctl:1: not used: `Length` of 2 tools: it is the length of the whole tool, not the length offset
            exit 0
            [machine]
            units = "mm"

            [tools]
            1 = { diameter = 5.0 }  # from Mill.fctl, A
            2 = { diameter = 12.7 }  # from Mill.fctl, B
            4 = { diameter = 6.35 }  # from Mill.fctl, D
        "#]],
    );
    check_in(
        &files,
        "Mill.fctl --units mm --quiet",
        &expect![[r#"
        exit 0
        [machine]
        units = "mm"

        [tools]
        1 = { diameter = 5.0 }  # from Mill.fctl, A
        2 = { diameter = 0.5 }  # from Mill.fctl, B
        4 = { diameter = 6.35 }  # from Mill.fctl, D
    "#]],
    );
}

#[test]
fn the_unit_of_a_library_is_that_of_its_first_tool_that_has_one() {
    let library = r#"{"data": [
{"type": "drill", "geometry": {"DC": 5}, "post-process": {"number": 1}},
{"type": "drill", "unit": "inches", "geometry": {"DC": 0.5}, "post-process": {"number": 2}},
{"type": "drill", "unit": "millimeters", "geometry": {"DC": 25.4}, "post-process": {"number": 3}}
]}"#;
    let here = ("gcheck.toml", "[machine]\nunits = \"inch\"\n");
    check_in(
        &[("tools.json", library), here],
        "tools.json",
        &expect![[r#"
            wrote gcheck.toml: 2 values
            next: name the control in it, `control = "NAME"` (`gcheck controls` lists them), then `gcheck check --show-settings`
            ! tools.json:2: not used: `drill`: the tool has no `unit`, and others of the library do: name it with `--units`
            exit 0
            [machine]
            units = "inch"

            [tools]
            2 = { diameter = 0.5 }  # from tools.json, drill
            3 = { diameter = 1.0 }  # from tools.json, drill
        "#]],
    );
    check_in(
        &[("tools.json", library), here],
        "tools.json --units mm",
        &expect![[r#"
            wrote gcheck.toml: 3 values
            next: name the control in it, `control = "NAME"` (`gcheck controls` lists them), then `gcheck check --show-settings`
            exit 0
            [machine]
            units = "inch"

            [tools]
            1 = { diameter = 0.19685 }  # from tools.json, drill
            2 = { diameter = 0.5 }  # from tools.json, drill
            3 = { diameter = 1.0 }  # from tools.json, drill
        "#]],
    );
    let none = library.replace("\"unit\": \"inches\", ", "").replace("\"unit\": \"millimeters\", ", "");
    check_in(
        &[("tools.json", &none), here],
        "tools.json",
        &expect![[r#"
        ! error: tools.json: does not say in which unit its lengths are
        !   help: name the unit: `--units mm` or `--units inch`
        exit 2
        [machine]
        units = "inch"
    "#]],
    );
    check_in(
        &[("tools.json", &none), here],
        "tools.json --units inch --quiet",
        &expect![[r#"
        exit 0
        [machine]
        units = "inch"

        [tools]
        1 = { diameter = 5.0 }  # from tools.json, drill
        2 = { diameter = 0.5 }  # from tools.json, drill
        3 = { diameter = 25.4 }  # from tools.json, drill
    "#]],
    );
    let negative = LIBRARY.replace("\"DC\": 25.4", "\"RE\": -1");
    check_in(
        &[("tools.json", &negative), here],
        "tools.json",
        &expect![[r#"
        ! error: tools.json:1:11: the corner radius of tool 1 is -1: it must not be negative
        !   |
        ! 1 | {"data": [{"type": "drill", "unit": "millimeters", "geometry": {"RE": -1}, "post-process": {"number": 1}}]}
        !   |           ^
        exit 2
        [machine]
        units = "inch"
    "#]],
    );
}

/// A text up to the end of some words.
fn until(text: &str, end: &str) -> String {
    text.split_at(text.find(end).unwrap() + end.len()).0.to_owned()
}

#[test]
fn settings_that_are_cut_short_write_nothing() {
    check(
        "dump.txt",
        &until(SETTINGS, "$111=4000\n"),
        "",
        &expect![[r#"
            ! error: dump.txt:9:1: the file ends without $120, the acceleration of X; is it cut short?
            !   |
            ! 9 | $111=4000
            !   | ^^^^^^^^^
            exit 2
        "#]],
    );
    check(
        "dump.txt",
        &until(SETTINGS, "$32=0\n"),
        "",
        &expect![[r#"
        ! error: dump.txt:5:1: the file has no setting of an axis ($100 to $105) up to its end; is it cut short?
        !   |
        ! 5 | $32=0
        !   | ^^^^^
        exit 2
    "#]],
    );
    check(
        "dump.txt",
        &until(SETTINGS, "$111"),
        "",
        &expect![[r#"
            ! error: dump.txt:9:1: `$111` is not a setting with a value; is the file cut short?
            !   |
            ! 9 | $111
            !   | ^^^^
            exit 2
        "#]],
    );
}

#[test]
fn an_ini_file_without_limits_is_not_cut_short() {
    // All is left to the control.
    let bare = "[TRAJ]\nCOORDINATES = X Z\nLINEAR_UNITS = mm\n[KINS]\nKINEMATICS = trivkins coordinates=XZ\n[JOINT_0]\nTYPE = LINEAR\n[JOINT_1]\nTYPE = LINEAR\n";
    check(
        "mill.ini",
        bare,
        "",
        &expect![[r#"
            wrote gcheck.toml: 1 value
            next: name the control in it, `control = "NAME"` (`gcheck controls` lists them), then `gcheck check --show-settings`
            ! mill.ini:7: not used: [JOINT_0] TYPE, [JOINT_1] TYPE (line 9): `gcheck.toml` has no key for it
            exit 0
            # Configuration of gcheck for the programs in this folder and below.

            [machine]
            axes = ["X", "Z"]  # from mill.ini, [TRAJ] COORDINATES
        "#]],
    );
    // An axis in the middle is left out on purpose.
    let limits = "MIN_LIMIT = 0\nMAX_LIMIT = 100\nMAX_VELOCITY = 50\nMAX_ACCELERATION = 400\n";
    let without = format!(
        "[TRAJ]\nCOORDINATES = X Y Z\nLINEAR_UNITS = mm\n[KINS]\nKINEMATICS = trivkins\n[AXIS_X]\n{limits}[AXIS_Z]\n{limits}"
    );
    check(
        "lathe.ini",
        &without,
        "",
        &expect![[r#"
            wrote gcheck.toml: 8 values
            next: name the control in it, `control = "NAME"` (`gcheck controls` lists them), then `gcheck check --show-settings`
            ! lathe.ini:2: not used: axis Y: the axis has no section with limits
            exit 0
            # Configuration of gcheck for the programs in this folder and below.

            [machine]
            units = "mm"  # from lathe.ini
            axes = ["X", "Y", "Z"]  # from lathe.ini, [TRAJ] COORDINATES
            travel.X = [0.0, 100.0]  # from lathe.ini, [AXIS_X] MIN_LIMIT and MAX_LIMIT
            travel.Z = [0.0, 100.0]  # from lathe.ini, [AXIS_Z] MIN_LIMIT and MAX_LIMIT
            rapid.X = 3000.0  # from lathe.ini, [AXIS_X] MAX_VELOCITY * 60
            rapid.Z = 3000.0  # from lathe.ini, [AXIS_Z] MAX_VELOCITY * 60
            acceleration.X = 400.0  # from lathe.ini, [AXIS_X] MAX_ACCELERATION
            acceleration.Z = 400.0  # from lathe.ini, [AXIS_Z] MAX_ACCELERATION
        "#]],
    );
}

#[test]
fn an_ini_file_or_a_tape_that_is_cut_short_writes_nothing() {
    check(
        "mill.ini",
        &until(INI, "MIN_LIMIT = -300\n"),
        "",
        &expect![[r#"
        ! error: mill.ini:4:1: the file ends without limits of axis A; is it cut short?
        !   |
        ! 4 | COORDINATES = X Z A
        !   | ^^^^^^^^^^^^^^^^^^^
        ! error: mill.ini:4:1: the file ends without limits of axis Z; is it cut short?
        !   |
        ! 4 | COORDINATES = X Z A
        !   | ^^^^^^^^^^^^^^^^^^^
        ! error: mill.ini:9:1: the file ends here, without MAX_LIMIT of axis X; is it cut short?
        !   |
        ! 9 | [AXIS_X]
        !   | ^^^^^^^^
        exit 2
    "#]],
    );
    check(
        "mill.ini",
        &until(INI, "MAX_ACCELERATION = 400\n"),
        "",
        &expect![[r#"
        ! error: mill.ini:4:1: the file ends without limits of axis A; is it cut short?
        !   |
        ! 4 | COORDINATES = X Z A
        !   | ^^^^^^^^^^^^^^^^^^^
        exit 2
    "#]],
    );
    check(
        "mill.ini",
        &until(INI, "MAX_ACC"),
        "",
        &expect![[r#"
        ! error: mill.ini:4:1: the file ends without limits of axis A; is it cut short?
        !   |
        ! 4 | COORDINATES = X Z A
        !   | ^^^^^^^^^^^^^^^^^^^
        ! error: mill.ini:4:1: the file ends without limits of axis Z; is it cut short?
        !   |
        ! 4 | COORDINATES = X Z A
        !   | ^^^^^^^^^^^^^^^^^^^
        ! error: mill.ini:9:1: the file ends here, without MAX_ACCELERATION of axis X; is it cut short?
        !   |
        ! 9 | [AXIS_X]
        !   | ^^^^^^^^
        ! error: mill.ini:13:1: the file ends in the middle of a key; is it cut short?
        !    |
        ! 13 | MAX_ACC
        !    | ^^^^^^^
        exit 2
    "#]],
    );
    check(
        "offsets.nc",
        &until(OFFSETS, "R120.5\n"),
        "--control fanuc-mill",
        &expect![[r#"
        ! error: offsets.nc:5:18: the file begins with `%` and ends without it; is it cut short?
        !   |
        ! 5 | G10 L10 P1 R120.5
        !   |                  ^
        exit 2
    "#]],
    );
}

#[test]
fn a_section_may_be_in_another_file() {
    let ini = INI.split_at(INI.find("[AXIS_A]").unwrap()).0;
    check(
        "mill.ini",
        &format!("{ini}#INCLUDE a.inc\n"),
        "--dry-run",
        &expect![[r##"
            # Configuration of gcheck for the programs in this folder and below.

            [machine]
            units = "mm"  # from mill.ini
            name = "Mill"  # from mill.ini, [EMC] MACHINE
            axes = ["X", "Z", "A"]  # from mill.ini, [TRAJ] COORDINATES
            travel.X = [-300.0, 0.0]  # from mill.ini, [AXIS_X] MIN_LIMIT and MAX_LIMIT
            travel.Z = [-120.0, 5.0]  # from mill.ini, [JOINT_1] MIN_LIMIT and MAX_LIMIT
            rapid.X = 3000.0  # from mill.ini, [AXIS_X] MAX_VELOCITY * 60, held by [TRAJ] MAX_LINEAR_VELOCITY
            rapid.Z = 3000.0  # from mill.ini, [JOINT_1] MAX_VELOCITY * 60
            acceleration.X = 500.0  # from mill.ini, [AXIS_X] MAX_ACCELERATION
            acceleration.Z = 400.0  # from mill.ini, [JOINT_1] MAX_ACCELERATION
            max_feed = 3000.0  # from mill.ini, [TRAJ] MAX_LINEAR_VELOCITY * 60
            ! mill.ini:4: not used: axis A: the axis has no section with limits
            ! mill.ini:19: not used: `#INCLUDE a.inc`: the file a.inc does not exist
            exit 0
        "##]],
    );
}

#[test]
fn what_a_terminal_echoes_is_listed() {
    check(
        "dump.txt",
        &format!("$$\n$N0=G21\n$I+\n{SETTINGS}"),
        "--dry-run",
        &expect![[r##"
            # Configuration of gcheck for the programs in this folder and below.

            [machine]
            units = "mm"  # from dump.txt
            axes = ["X", "Y"]  # from dump.txt, $100 to $101
            rapid.X = 5000.0  # from dump.txt, $110
            rapid.Y = 4000.0  # from dump.txt, $111
            acceleration.X = 200.0  # from dump.txt, $120
            acceleration.Y = 150.0  # from dump.txt, $121
            travel.X = [-400.0, 0.0]  # from dump.txt, $130, machine coordinates are negative
            travel.Y = [-300.0, 0.0]  # from dump.txt, $131, machine coordinates are negative
            max_rpm = 10000.0  # from dump.txt, $30
            ! dump.txt:2: not used: `$N0=G21`, `$I+` (line 3): it is not a numbered setting
            ! dump.txt:4: not used: $13: it is about reports only; settings count in millimetres
            ! dump.txt:8: not used: $32: `gcheck.toml` has no key for it
            exit 0
        "##]],
    );
}

#[test]
fn homing_that_is_not_told_is_not_guessed() {
    check(
        "dump.txt",
        &SETTINGS.replace("$22=1\n", ""),
        "--dry-run",
        &expect![[r##"
        # Configuration of gcheck for the programs in this folder and below.

        [machine]
        units = "mm"  # from dump.txt
        axes = ["X", "Y"]  # from dump.txt, $100 to $101
        rapid.X = 5000.0  # from dump.txt, $110
        rapid.Y = 4000.0  # from dump.txt, $111
        acceleration.X = 200.0  # from dump.txt, $120
        acceleration.Y = 150.0  # from dump.txt, $121
        max_rpm = 10000.0  # from dump.txt, $30
        ! dump.txt:1: not used: $13: it is about reports only; settings count in millimetres
        ! dump.txt:4: not used: $32: `gcheck.toml` has no key for it
        ! dump.txt:11: not used: $130 (travel of X), $131 (travel of Y) (line 12): the file does not tell whether the machine homes ($22)
        exit 0
    "##]],
    );
    check(
        "dump.txt",
        &SETTINGS.replace("$22=1", "$22=yes").replace("$23=1", "$23="),
        "--dry-run",
        &expect![[r##"
        # Configuration of gcheck for the programs in this folder and below.

        [machine]
        units = "mm"  # from dump.txt
        axes = ["X", "Y"]  # from dump.txt, $100 to $101
        rapid.X = 5000.0  # from dump.txt, $110
        rapid.Y = 4000.0  # from dump.txt, $111
        acceleration.X = 200.0  # from dump.txt, $120
        acceleration.Y = 150.0  # from dump.txt, $121
        max_rpm = 10000.0  # from dump.txt, $30
        ! dump.txt:1: not used: $13: it is about reports only; settings count in millimetres
        ! dump.txt:2: not used: $22: it is `yes`, which is not a whole number
        ! dump.txt:3: not used: $23: it is ``, which is not a whole number
        ! dump.txt:5: not used: $32: `gcheck.toml` has no key for it
        ! dump.txt:12: not used: $130 (travel of X), $131 (travel of Y) (line 13): the file does not tell whether the machine homes ($22)
        exit 0
    "##]],
    );
    check(
        "dump.txt",
        &SETTINGS.replace("$23=1", "$23=x"),
        "--dry-run",
        &expect![[r##"
            # Configuration of gcheck for the programs in this folder and below.

            [machine]
            units = "mm"  # from dump.txt
            axes = ["X", "Y"]  # from dump.txt, $100 to $101
            rapid.X = 5000.0  # from dump.txt, $110
            rapid.Y = 4000.0  # from dump.txt, $111
            acceleration.X = 200.0  # from dump.txt, $120
            acceleration.Y = 150.0  # from dump.txt, $121
            travel.X = [-400.0, 0.0]  # from dump.txt, $130, machine coordinates are negative
            travel.Y = [-300.0, 0.0]  # from dump.txt, $131, machine coordinates are negative
            max_rpm = 10000.0  # from dump.txt, $30
            ! dump.txt:1: not used: $13: it is about reports only; settings count in millimetres
            ! dump.txt:3: not used: $23: it is `x`, which is not a whole number
            ! dump.txt:5: not used: $32: `gcheck.toml` has no key for it
            exit 0
        "##]],
    );
}

#[test]
fn jerk_counts_where_the_planner_has_it() {
    let ini = INI.replace("MAX_ACCELERATION = 500\n", "MAX_ACCELERATION = 500\nMAX_JERK = 9000\n");
    check(
        "mill.ini",
        &ini,
        "--dry-run",
        &expect![[r##"
        # Configuration of gcheck for the programs in this folder and below.

        [machine]
        units = "mm"  # from mill.ini
        name = "Mill"  # from mill.ini, [EMC] MACHINE
        axes = ["X", "Z", "A"]  # from mill.ini, [TRAJ] COORDINATES
        travel.X = [-300.0, 0.0]  # from mill.ini, [AXIS_X] MIN_LIMIT and MAX_LIMIT
        travel.Z = [-120.0, 5.0]  # from mill.ini, [JOINT_1] MIN_LIMIT and MAX_LIMIT
        rapid.X = 3000.0  # from mill.ini, [AXIS_X] MAX_VELOCITY * 60, held by [TRAJ] MAX_LINEAR_VELOCITY
        rapid.Z = 3000.0  # from mill.ini, [JOINT_1] MAX_VELOCITY * 60
        rapid.A = 3600.0  # from mill.ini, [AXIS_A] MAX_VELOCITY * 60
        acceleration.X = 500.0  # from mill.ini, [AXIS_X] MAX_ACCELERATION
        acceleration.Z = 400.0  # from mill.ini, [JOINT_1] MAX_ACCELERATION
        acceleration.A = 900.0  # from mill.ini, [AXIS_A] MAX_ACCELERATION
        max_feed = 3000.0  # from mill.ini, [TRAJ] MAX_LINEAR_VELOCITY * 60
        max_rpm = 12000.0  # from mill.ini, [SPINDLE_0] MAX_FORWARD_VELOCITY

        [tools]
        table = "tool.tbl"  # from mill.ini, [EMCIO] TOOL_TABLE: 2 tools
        ! mill.ini:14: not used: [AXIS_X] MAX_JERK: it counts under `[TRAJ] PLANNER_TYPE = 1` only
        ! mill.ini:21: not used: [AXIS_A] MIN_LIMIT and MAX_LIMIT: the axis has no end of travel
        exit 0
    "##]],
    );
    check(
        "mill.ini",
        &ini.replace("[TRAJ]\n", "[TRAJ]\nPLANNER_TYPE = 1\n"),
        "--dry-run --quiet",
        &expect![[r##"
        # Configuration of gcheck for the programs in this folder and below.

        [machine]
        units = "mm"  # from mill.ini
        name = "Mill"  # from mill.ini, [EMC] MACHINE
        axes = ["X", "Z", "A"]  # from mill.ini, [TRAJ] COORDINATES
        travel.X = [-300.0, 0.0]  # from mill.ini, [AXIS_X] MIN_LIMIT and MAX_LIMIT
        travel.Z = [-120.0, 5.0]  # from mill.ini, [JOINT_1] MIN_LIMIT and MAX_LIMIT
        rapid.X = 3000.0  # from mill.ini, [AXIS_X] MAX_VELOCITY * 60, held by [TRAJ] MAX_LINEAR_VELOCITY
        rapid.Z = 3000.0  # from mill.ini, [JOINT_1] MAX_VELOCITY * 60
        rapid.A = 3600.0  # from mill.ini, [AXIS_A] MAX_VELOCITY * 60
        acceleration.X = 500.0  # from mill.ini, [AXIS_X] MAX_ACCELERATION
        acceleration.Z = 400.0  # from mill.ini, [JOINT_1] MAX_ACCELERATION
        acceleration.A = 900.0  # from mill.ini, [AXIS_A] MAX_ACCELERATION
        jerk.X = 9000.0  # from mill.ini, [AXIS_X] MAX_JERK
        max_feed = 3000.0  # from mill.ini, [TRAJ] MAX_LINEAR_VELOCITY * 60
        max_rpm = 12000.0  # from mill.ini, [SPINDLE_0] MAX_FORWARD_VELOCITY

        [tools]
        table = "tool.tbl"  # from mill.ini, [EMCIO] TOOL_TABLE: 2 tools
        exit 0
    "##]],
    );
}

#[test]
fn joints_are_not_axes_under_other_kinematics() {
    check(
        "mill.ini",
        &INI.replace("trivkins", "maxkins"),
        "--dry-run",
        &expect![[r##"
        # Configuration of gcheck for the programs in this folder and below.

        [machine]
        units = "mm"  # from mill.ini
        name = "Mill"  # from mill.ini, [EMC] MACHINE
        axes = ["X", "Z", "A"]  # from mill.ini, [TRAJ] COORDINATES
        travel.X = [-300.0, 0.0]  # from mill.ini, [AXIS_X] MIN_LIMIT and MAX_LIMIT
        rapid.X = 3000.0  # from mill.ini, [AXIS_X] MAX_VELOCITY * 60, held by [TRAJ] MAX_LINEAR_VELOCITY
        rapid.A = 3600.0  # from mill.ini, [AXIS_A] MAX_VELOCITY * 60
        acceleration.X = 500.0  # from mill.ini, [AXIS_X] MAX_ACCELERATION
        acceleration.A = 900.0  # from mill.ini, [AXIS_A] MAX_ACCELERATION
        max_feed = 3000.0  # from mill.ini, [TRAJ] MAX_LINEAR_VELOCITY * 60
        max_rpm = 12000.0  # from mill.ini, [SPINDLE_0] MAX_FORWARD_VELOCITY

        [tools]
        table = "tool.tbl"  # from mill.ini, [EMCIO] TOOL_TABLE: 2 tools
        ! mill.ini:4: not used: axis Z: the axis has no section, and the limits of joints are not its own under `maxkins`
        ! mill.ini:15: not used: [JOINT_1] MIN_LIMIT, [JOINT_1] MAX_LIMIT (line 16), [JOINT_1] MAX_VELOCITY (line 17), [JOINT_1] MAX_ACCELERATION (line 18): under the kinematics `maxkins` a joint is not an axis
        ! mill.ini:20: not used: [AXIS_A] MIN_LIMIT and MAX_LIMIT: the axis has no end of travel
        exit 0
    "##]],
    );
}

/// A probe with these items of X and of a path.
fn probe(of_x: &[&str], of_path: &[&str]) -> String {
    let item = |told: &&str| {
        let (attributes, limits) = told.split_once('|').unwrap();
        let limits: String = match limits.split_once("..") {
            Some((least, most)) => format!("<Minimum>{least}</Minimum><Maximum>{most}</Maximum>"),
            None => format!("<Maximum>{limits}</Maximum>"),
        };
        format!("<DataItem {attributes}><Constraints>{limits}</Constraints></DataItem>\n")
    };
    let items = |told: &[&str]| told.iter().map(item).collect::<String>();
    format!(
        "<MTConnectDevices><Devices><Device name=\"VMC\"><Components><Axes><Components>\n<Linear name=\"X\"><DataItems>\n{}</DataItems></Linear>\n\
        <Rotary name=\"C\"><DataItems>\n<DataItem type=\"ANGLE\" units=\"DEGREE\"><Constraints><Minimum>-180</Minimum><Maximum>180</Maximum></Constraints></DataItem>\n\
        <DataItem type=\"ANGULAR_VELOCITY\" units=\"DEGREE/SECOND\"><Constraints><Maximum>90</Maximum></Constraints></DataItem></DataItems></Rotary>\n\
        </Components></Axes><Controller><Components><Path name=\"P\"><DataItems>\n{}</DataItems></Path></Components></Controller></Components></Device></Devices></MTConnectDevices>",
        items(of_x),
        items(of_path)
    )
}

#[test]
fn the_sub_type_of_a_limit_decides_what_it_limits() {
    let text = probe(
        &[
            "type=\"AXIS_FEEDRATE\" subType=\"PROGRAMMED\" units=\"MILLIMETER/SECOND\"|100",
            "type=\"AXIS_FEEDRATE\" subType=\"ACTUAL\" units=\"MILLIMETER/SECOND\"|390",
            "type=\"AXIS_FEEDRATE\" subType=\"RAPID\" units=\"MILLIMETER/SECOND\"|400",
            "type=\"POSITION\" subType=\"ACTUAL\" units=\"MILLIMETER\"|-500..0",
            "type=\"POSITION\" subType=\"COMMANDED\" units=\"MILLIMETER\"|-500..0",
        ],
        &[
            "type=\"PATH_FEEDRATE\" subType=\"RAPID\" units=\"MILLIMETER/SECOND\"|400",
            "type=\"PATH_FEEDRATE\" subType=\"PROGRAMMED\" units=\"MILLIMETER/SECOND\"|200",
        ],
    );
    check(
        "probe.xml",
        &text,
        "--dry-run --config machine.units=mm",
        &expect![[r##"
            # Configuration of gcheck for the programs in this folder and below.

            [machine]
            units = "mm"  # from --config
            name = "VMC"  # from probe.xml, the name of the device
            axes = ["X", "C"]  # from probe.xml, its axes
            rapid.X = 24000.0  # from probe.xml, X AXIS_FEEDRATE RAPID Maximum * 60
            rapid.C = 5400.0  # from probe.xml, C ANGULAR_VELOCITY Maximum * 60
            travel.X = [-500.0, 0.0]  # from probe.xml, X POSITION ACTUAL Minimum and Maximum
            travel.C = [-180.0, 180.0]  # from probe.xml, C ANGLE Minimum and Maximum
            max_feed = 12000.0  # from probe.xml, P PATH_FEEDRATE PROGRAMMED Maximum * 60
            ! probe.xml:3: not used: X AXIS_FEEDRATE PROGRAMMED, P PATH_FEEDRATE RAPID (line 13): `gcheck.toml` has no key for it
            ! probe.xml:4: not used: X AXIS_FEEDRATE ACTUAL Maximum * 60: the limit in line 5 is the clearer one
            exit 0
        "##]],
    );
}

#[test]
fn limits_of_a_probe_that_are_not_clear_are_listed() {
    let text = probe(
        &[
            "type=\"AXIS_FEEDRATE\" units=\"MILLIMETER/SECOND^2\"|100",
            "type=\"ACCELERATION\" units=\"MILLIMETER/SECOND\"|100",
            "type=\"POSITION\" units=\"INCH\"|-20..about 0",
        ],
        &[
            "type=\"PATH_FEEDRATE\" units=\"MILLIMETER/SECOND\"|400",
            "type=\"PATH_FEEDRATE\" units=\"MILLIMETER/SECOND\"|200",
        ],
    );
    check(
        "probe.xml",
        &text,
        "--dry-run --config machine.units=mm",
        &expect![[r##"
            # Configuration of gcheck for the programs in this folder and below.

            [machine]
            name = "VMC"  # from probe.xml, the name of the device
            axes = ["X", "C"]  # from probe.xml, its axes
            travel.C = [-180.0, 180.0]  # from probe.xml, C ANGLE Minimum and Maximum
            rapid.C = 5400.0  # from probe.xml, C ANGULAR_VELOCITY Maximum * 60
            ! probe.xml:3: not used: X AXIS_FEEDRATE Maximum: `MILLIMETER/SECOND^2` is not a unit that this limit is read in
            ! probe.xml:4: not used: X ACCELERATION Maximum: `MILLIMETER/SECOND` is not a unit that this limit is read in
            ! probe.xml:5: not used: X POSITION Maximum: `about 0` is not a number
            ! probe.xml:5: not used: X POSITION: the other end of travel is missing
            ! probe.xml:12: not used: P PATH_FEEDRATE Maximum * 60: line 11 gives another limit of the same kind, so neither is written
            exit 0
        "##]],
    );
    check(
        "probe.xml",
        &text.replace("units=\"INCH\"", "units=INCH"),
        "",
        &expect![[r#"
        ! error: probe.xml:5:1: the attributes of an element cannot be read: position 31: attribute value must be enclosed in `"` or `'`
        !   |
        ! 5 | <DataItem type="POSITION" units=INCH><Constraints><Minimum>-20</Minimum><Maximum>about 0</Maximum></Constraints></DataItem>
        !   | ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^
        exit 2
    "#]],
    );
}

#[test]
fn a_probe_in_inches_is_converted() {
    let text = probe(
        &["type=\"POSITION\" units=\"INCH\"|-20..0", "type=\"AXIS_FEEDRATE\" units=\"INCH/MINUTE\"|600"],
        &[],
    );
    check(
        "probe.xml",
        &text,
        "--dry-run --config machine.units=mm",
        &expect![[r##"
        # Configuration of gcheck for the programs in this folder and below.

        [machine]
        units = "mm"  # from --config
        name = "VMC"  # from probe.xml, the name of the device
        axes = ["X", "C"]  # from probe.xml, its axes
        travel.X = [-508.0, 0.0]  # from probe.xml, X POSITION Minimum and Maximum
        travel.C = [-180.0, 180.0]  # from probe.xml, C ANGLE Minimum and Maximum
        rapid.X = 15240.0  # from probe.xml, X AXIS_FEEDRATE Maximum
        rapid.C = 5400.0  # from probe.xml, C ANGULAR_VELOCITY Maximum * 60
        exit 0
    "##]],
    );
}

#[test]
fn an_axis_that_a_probe_has_twice_is_written_where_both_agree() {
    let text = probe(
        &[
            "type=\"POSITION\" units=\"MILLIMETER\"|-500..0",
            "type=\"AXIS_FEEDRATE\" units=\"MILLIMETER/SECOND\"|400",
        ],
        &[],
    );
    let (head, rest) = text.split_once("<Linear").unwrap();
    let (linear, tail) = rest.split_once("</Linear>").unwrap();
    let other = linear.replace(">400<", ">300<");
    let twice = format!("{head}<Linear{linear}</Linear>\n<Linear{other}</Linear>{tail}");
    check(
        "probe.xml",
        &twice,
        "--dry-run --config machine.units=mm",
        &expect![[r##"
        # Configuration of gcheck for the programs in this folder and below.

        [machine]
        units = "mm"  # from --config
        name = "VMC"  # from probe.xml, the name of the device
        axes = ["X", "C"]  # from probe.xml, its axes
        travel.X = [-500.0, 0.0]  # from probe.xml, X POSITION Minimum and Maximum
        travel.C = [-180.0, 180.0]  # from probe.xml, C ANGLE Minimum and Maximum
        rapid.C = 5400.0  # from probe.xml, C ANGULAR_VELOCITY Maximum * 60
        ! probe.xml:6: not used: axis X: the document has the axis already, and limits are written where both agree
        ! probe.xml:8: not used: X AXIS_FEEDRATE Maximum * 60: line 4 gives another limit of the same kind, so neither is written
        exit 0
    "##]],
    );
}

#[test]
fn a_probe_of_two_machines_is_refused() {
    let device = "<Device name=\"A\"></Device>";
    let text = format!("<MTConnectDevices><Devices>\n{device}\n{device}\n</Devices></MTConnectDevices>");
    check(
        "probe.xml",
        &text,
        "",
        &expect![[r#"
        ! error: probe.xml:3:1: the document describes more than one machine; ask the agent for one, by the name of its device
        !   |
        ! 3 | <Device name="A"></Device>
        !   | ^^^^^^^^^^^^^^^^^
        exit 2
    "#]],
    );
}

#[test]
fn files_that_contradict_each_other_write_nothing() {
    check_in(
        &[("dump.txt", SETTINGS), ("tools.json", LIBRARY)],
        "dump.txt tools.json --quiet",
        &expect![[r#"
            exit 0
            # Configuration of gcheck for the programs in this folder and below.

            [machine]
            units = "mm"  # from dump.txt
            axes = ["X", "Y"]  # from dump.txt, $100 to $101
            rapid.X = 5000.0  # from dump.txt, $110
            rapid.Y = 4000.0  # from dump.txt, $111
            acceleration.X = 200.0  # from dump.txt, $120
            acceleration.Y = 150.0  # from dump.txt, $121
            travel.X = [-400.0, 0.0]  # from dump.txt, $130, machine coordinates are negative
            travel.Y = [-300.0, 0.0]  # from dump.txt, $131, machine coordinates are negative
            max_rpm = 10000.0  # from dump.txt, $30

            [tools]
            1 = { diameter = 25.4 }  # from tools.json, drill
        "#]],
    );
    check_in(
        &[("dump.txt", SETTINGS), ("other.txt", &SETTINGS.replace("$110=5000", "$110=6000"))],
        "dump.txt other.txt --quiet",
        &expect![[r#"
            ! error: `machine.rapid.X` is 5000.0 in dump.txt:8 and 6000.0 in other.txt:8
            !   help: import the files one after the other, with `--overwrite` for the one that counts
            exit 2
        "#]],
    );
    check_in(
        &[("mill.ini", INI), ("other.ini", &INI.replace("LINEAR_UNITS = mm", "LINEAR_UNITS = inch"))],
        "mill.ini other.ini --quiet",
        &expect![[r#"
            ! error: `machine.units` is "mm" in mill.ini and "inch" in other.ini
            !   help: import the files one after the other, with `--overwrite` for the one that counts
            exit 2
        "#]],
    );
}

#[test]
fn a_hundred_unknown_keys_are_one_line_and_a_thousand_reasons_are_cut() {
    let mut ini = INI.replace("TOOL_TABLE = tool.tbl\n", "");
    for ix in 0..100 {
        writeln!(ini, "KEY_{ix} = 1").unwrap();
    }
    let shop = Shop::with(&[("mill.ini", &ini)]);
    let run = shop.gcheck("machine import mill.ini --dry-run");
    assert!(run.stderr.contains("KEY_3 (line 30) and 96 more"), "{run}");
    let mut twice = ini.clone();
    for _ in 0..2000 {
        twice.push_str("[EMCIO]\nTWICE = 1\n[TRAJ]\nLINEAR_UNITS = mm\n");
        writeln!(twice, "`{}", twice.len()).unwrap();
    }
    let shop = Shop::with(&[("mill.ini", &twice)]);
    let run = shop.gcheck("machine import mill.ini --dry-run");
    assert!(run.stderr.lines().count() < 60, "{run}");
    assert!(run.stderr.contains("not used: … and "), "{run}");
}

#[test]
fn large_files_are_read_in_time_that_grows_with_them() {
    let mut ini = INI.to_owned();
    for ix in 0..200_000 {
        writeln!(ini, "KEY_{ix} = 1").unwrap();
    }
    let began = std::time::Instant::now();
    let shop = Shop::with(&[("mill.ini", &ini), ("tool.tbl", "T1 Z1\n")]);
    assert_eq!(shop.gcheck("machine import mill.ini --dry-run --quiet").code, 0);
    let tools: Vec<String> = (1..=9_000)
        .map(|number| format!("{{\"type\": \"drill\", \"unit\": \"millimeters\", \"geometry\": {{\"DC\": 5}}, \"post-process\": {{\"number\": {number}}}}}"))
        .collect();
    shop.file("tools.json", format!("{{\"data\": [{}]}}", tools.join(",\n")));
    assert_eq!(shop.gcheck("machine import tools.json --dry-run --quiet --config machine.units=mm").code, 0);
    assert!(began.elapsed().as_secs() < 60, "{:?}", began.elapsed());
    shop.file("huge.ini", vec![b'#'; (8 << 20) + 1]);
    expect![[r#"
        ! error: huge.ini: cannot read: it is larger than 8 MB
        exit 2
    "#]]
    .assert_eq(&shop.gcheck("machine import huge.ini").to_string());
}

#[test]
fn a_pipe_is_refused_before_it_is_opened() {
    let shop = Shop::with(&[("dump.txt", SETTINGS)]);
    let made = std::process::Command::new("mkfifo").arg(shop.path("pipe.ini")).status();
    if !made.is_ok_and(|status| status.success()) {
        return skip("a_pipe_is_refused_before_it_is_opened", "mkfifo", "it is one of the coreutils");
    }
    expect![[r#"
        ! error: pipe.ini: cannot read: it is a pipe, a device or a folder, not a file
        exit 2
    "#]]
    .assert_eq(&shop.gcheck("machine import pipe.ini").to_string());
    expect![[r#"
        ! error: pipe.ini: cannot read the configuration: it is a pipe, a device or a folder, not a file
        exit 2
    "#]]
    .assert_eq(&shop.gcheck("machine import dump.txt -o pipe.ini").to_string());
}

#[test]
fn an_offset_that_is_not_known_as_a_whole_is_listed_and_not_written() {
    let dump = "%\nO9999\nG90 G21\nG10 L2 P1 X#501 Y-200. Z0.\nG10 L2 P2 Y-1. Z-2.\nG10 L2 P3 X1. Y2. Z3.\n\
        G10 L10 P1 R120.5\nG10 L10 P2 R#500\nG10 L14 P3 R1.\nG10 L10 P4\nM30\n%\n";
    check(
        "offsets.nc",
        dump,
        "--control haas-mill",
        &expect![[r#"
        wrote gcheck.toml: 6 values
        next: `gcheck check --show-settings`
        ! offsets.nc:4: not used: X#501, R#500 (line 8): its value is not known when the program starts
        ! offsets.nc:4: not used: G54, G55 (line 5): the file does not say X, and in `gcheck.toml` an axis that is left out is zero
        ! offsets.nc:9: not used: G10 L14: gcheck does not read this kind of `G10`
        ! offsets.nc:10: not used: G10 L10: the block names no value that gcheck reads (`R`)
        ! offsets.nc: assumed: setting 40 (tool offset measure) is `diameter`, as usual; `[settings] 40 = "diameter"` can say otherwise
        exit 0
        # Configuration of gcheck for the programs in this folder and below.
        control = "haas-mill"  # from --control

        [machine]
        units = "mm"  # from offsets.nc

        [offsets]
        G56 = { X = 1.0, Y = 2.0, Z = 3.0 }  # from offsets.nc, run as a program of haas-mill

        [tools]
        1 = { length = 120.5 }  # from offsets.nc, run as a program of haas-mill
    "#]],
    );
}

#[test]
fn what_an_unknown_number_of_an_offset_overwrites_is_listed() {
    let dump = "%\nO9999\nG90 G21\nG10 L2 P1 X1. Y2. Z3.\nG10 L10 P1 R1.\nG10 L2 P#500 X1. Y1. Z1.\n\
        G10 L10 P#501 R1.\nG10 L2 P2 X1. Y2. Z3.\nM30\n%\n";
    check(
        "offsets.nc",
        dump,
        "--control haas-mill",
        &expect![[r#"
        wrote gcheck.toml: 5 values
        next: `gcheck check --show-settings`
        ! offsets.nc:5: not used: the length of tool 1: it is not known at the end of the program
        ! offsets.nc:6: not used: P#500, P#501 (line 7): its value is not known when the program starts
        ! offsets.nc:6: not used: G54: the file does not say X, Y and Z, and in `gcheck.toml` an axis that is left out is zero
        ! offsets.nc: assumed: setting 40 (tool offset measure) is `diameter`, as usual; `[settings] 40 = "diameter"` can say otherwise
        exit 0
        # Configuration of gcheck for the programs in this folder and below.
        control = "haas-mill"  # from --control

        [machine]
        units = "mm"  # from offsets.nc

        [offsets]
        G55 = { X = 1.0, Y = 2.0, Z = 3.0 }  # from offsets.nc, run as a program of haas-mill
    "#]],
    );
}

#[test]
fn offsets_that_are_added_to_what_the_control_has_are_not_known() {
    let dump = "%\nO9999\nG91 G21\nG10 L2 P1 X1. Y2. Z3.\nM30\n%\n";
    check(
        "offsets.nc",
        dump,
        "--control haas-mill",
        &expect![[r#"
        ! error: offsets.nc:1:1: the program writes no offset that is known at its end
        !   |
        ! 1 | %
        !   | ^
        !   note: offsets.nc:4: not used: X1., Y2., Z3.: `G91` adds it to what the control has, which the file does not say
        exit 2
    "#]],
    );
}

#[test]
fn a_variable_that_nobody_set_is_no_zero_in_an_offset() {
    let dump = "G90 G21\nG10 L2 P1 X-400. Y-1. Z#501\nG10 L1 P1 Z#500\nG10 L2 P2 X0. Y-1. Z-2.\nM2\n";
    check(
        "offsets.ngc",
        dump,
        "--control linuxcnc",
        &expect![[r#"
        wrote gcheck.toml: 5 values
        next: `gcheck check --show-settings`
        ! offsets.ngc:2: not used: Z#501, Z#500 (line 3): its value is not known when the program starts
        ! offsets.ngc:2: not used: G54: the file does not say Z, and in `gcheck.toml` an axis that is left out is zero
        exit 0
        # Configuration of gcheck for the programs in this folder and below.
        control = "linuxcnc"  # from --control

        [machine]
        units = "mm"  # from linuxcnc, its unit at power-on

        [offsets]
        G55 = { X = 0.0, Y = -1.0, Z = -2.0 }  # from offsets.ngc, run as a program of linuxcnc
    "#]],
    );
}

#[test]
fn the_axes_of_the_machine_decide_what_a_whole_offset_is() {
    let dump = "%\nO9999\nG90 G21\nG10 L2 P1 X1. Y2. Z3.\nM30\n%\n";
    let configured = |axes: &str| {
        let shop = Shop::with(&[
            ("offsets.nc", dump),
            ("gcheck.toml", &format!("control = \"haas-mill\"\n[machine]\nunits = \"mm\"\naxes = {axes}\n")),
        ]);
        shop.gcheck("machine import offsets.nc").code
    };
    assert_eq!(configured("[\"X\", \"Y\", \"Z\"]"), 0);
    assert_eq!(configured("[\"X\", \"Y\", \"Z\", \"A\"]"), 2);
}

#[test]
fn a_comment_says_once_where_an_imported_value_is_from() {
    let shop = Shop::with(&[("gcheck.toml", "[machine]\nunits = \"mm\"\nmax_rpm = 9000.0  # measured\n")]);
    for (round, speed) in [12_000, 13_000, 14_000].into_iter().enumerate() {
        shop.file(
            "mill.ini",
            INI.replace("MAX_FORWARD_VELOCITY = 12000", &format!("MAX_FORWARD_VELOCITY = {speed}")),
        );
        shop.file("tool.tbl", "T1 P1 Z10 D6\n");
        let run = shop.gcheck("machine import mill.ini --overwrite");
        assert_eq!(run.code, 0, "{round}: {run}");
        let text = shop.read("gcheck.toml");
        let line = text.lines().find(|line| line.starts_with("max_rpm")).unwrap();
        assert_eq!(
            line,
            format!("max_rpm = {speed}.0  # measured; from mill.ini, [SPINDLE_0] MAX_FORWARD_VELOCITY")
        );
    }
}

#[test]
fn figures_that_no_machine_has_are_refused_at_their_place() {
    check(
        "settings.txt",
        &SETTINGS.replace("$110=5000", "$110=1e99"),
        "--units mm",
        &expect![[r#"
        ! error: settings.txt:8:1: $110 (rapid of X) is 1e99, which no machine has
        !   |
        ! 8 | $110=1e99
        !   | ^^^^^^^^^
        exit 2
    "#]],
    );
}
