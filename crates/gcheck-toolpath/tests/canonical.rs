//! Every event as canonical functions. The expectations are what the reference interpreter (2.9) printed for the program
//! that is above each, without its comments.

mod step_maker;

use expect_test::{Expect, expect};
use gcheck_engine::{
    Axis, Coolant, Curve, Event, FeedMode, Override, PathMode, Position, Spindle, Stop, ToolEntry,
    TravelKind, Units,
};
use gcheck_geometry::{Mm, Plane, Seconds};
use gcheck_toolpath::{Canonical, Ending, Start};
use step_maker::{Run, barred, point};

#[expect(clippy::needless_pass_by_value, reason = "reads like the other expectations")]
fn check(run: &Run, expected: Expect) {
    expected.assert_eq(&run.canonical(&[7, 2, 99]));
}

fn nine(values: [f64; 9]) -> Position {
    Position::new(values)
}

/// The parameter file gives G55 an offset of 2, 3, 4 inches and A5, a rotation of 30, and a shift of half an inch.
#[test]
fn frame_of_a_run() {
    let mut out = Canonical::new(Vec::new());
    out.prologue(&Start {
        work: 2,
        offset: nine([50.8, 76.2, 101.6, 5.0, 0.0, 0.0, 0.0, 0.0, 0.0]),
        shift: point(12.7, 0.0, 0.0),
        rotation: 30.0,
    })
    .unwrap();
    let text = String::from_utf8(out.epilogue(Ending::Percent).unwrap()).unwrap();
    expect![[r#"
        |    1 N..... USE_LENGTH_UNITS(CANON_UNITS_MM)
        |    2 N..... SET_G5X_OFFSET(2, 50.8000, 76.2000, 101.6000, 5.0000, 0.0000, 0.0000)
        |    3 N..... SET_G92_OFFSET(12.7000, 0.0000, 0.0000, 0.0000, 0.0000, 0.0000)
        |    4 N..... SET_XY_ROTATION(30.0000)
        |    5 N..... SET_FEED_REFERENCE(CANON_XYZ)
        |    6 N..... ON_RESET()
        |    7 N..... FINISH()
        |    8 N..... ON_RESET()
        |    9 N..... ON_RESET()
    "#]]
    .assert_eq(&barred(&text.lines().collect::<Vec<_>>()));
}

/// ```text
/// N1 G0 X-0.00001 Y-0.00005 A-0.000001 B1 C2
/// N99999 G0 X0.03125 Y-0 Z0.00005
/// N100000 G0 X100000.12345
/// N1000000 G1 F100 X1
/// N5 G38.2 Z-3
/// ```
#[test]
fn straight_moves() {
    let mut run = Run::new();
    run.n(1)
        .travel(TravelKind::Rapid, nine([-0.000_01, -0.000_05, 0.0, -0.000_001, 1.0, 2.0, 0.0, 0.0, 0.0]));
    run.n(99_999).rapid(0.03125, -0.0, 0.000_05);
    run.n(100_000).rapid(100_000.123_45, -0.0, 0.000_05);
    run.n(1_000_000).event(Event::FeedRate(100.0)).feed(1.0, -0.0, 0.000_05);
    run.n(5).event(Event::Probe(true));
    let bottom = run.at.with_xyz([1.0, -0.0, -3.0].map(Mm));
    run.travel(TravelKind::Probe { toward: true, required: true, skip: false }, bottom);
    run.event(Event::Probe(false));
    check(
        &run,
        expect![[r#"
            |    7 N1     STRAIGHT_TRAVERSE(-0.0000, -0.0001, 0.0000, -0.0000, 1.0000, 2.0000)
            |    8 N99999 STRAIGHT_TRAVERSE(0.0312, -0.0000, 0.0001, -0.0000, 1.0000, 2.0000)
            |    9 N100000STRAIGHT_TRAVERSE(100000.1234, -0.0000, 0.0001, -0.0000, 1.0000, 2.0000)
            |   10 N1000000SET_FEED_RATE(100.0000)
            |   11 N1000000STRAIGHT_FEED(1.0000, -0.0000, 0.0001, -0.0000, 1.0000, 2.0000)
            |   12 N5     TURN_PROBE_ON()
            |   13 N5     STRAIGHT_PROBE(1.0000, -0.0000, -3.0000, -0.0000, 1.0000, 2.0000)
            |   14 N5     TURN_PROBE_OFF()
        "#]],
    );
}

/// ```text
/// N1 G0 X2 A3 B1 C2 F100
/// N3 G2 X3 Y0 I0.5
/// N4 G3 X2 Y0 I-0.5 P3
/// N5 G2 X2 I1 P2 Z-1
/// N6 G18 G2 X3 Z-1 I0.5
/// N8 G19 G2 Y1 Z-1 J0.5
/// N9 G20
/// N95 G0 X-0.5 Y0
/// N10 G17 G3 X[1/2] Y0 I0.5
/// ```
#[test]
fn arcs() {
    let mut run = Run::new();
    run.n(1).event(Event::FeedRate(100.0));
    run.travel(TravelKind::Rapid, nine([2.0, 0.0, 0.0, 3.0, 1.0, 2.0, 0.0, 0.0, 0.0]));
    run.n(3).arc(Plane::Xy, [3.0, 0.0, 0.0], (2.5, 0.0), -180.0);
    run.n(4).arc(Plane::Xy, [2.0, 0.0, 0.0], (2.5, 0.0), 180.0 + 720.0);
    run.n(5).arc(Plane::Xy, [2.0, 0.0, -1.0], (3.0, 0.0), -720.0);
    run.n(6).event(Event::Plane(Plane::Zx)).arc(Plane::Zx, [3.0, 0.0, -1.0], (-1.0, 2.5), -180.0);
    run.n(8).event(Event::Plane(Plane::Yz)).arc(Plane::Yz, [3.0, 1.0, -1.0], (0.5, -1.0), -180.0);
    run.units = Units::Inch;
    run.n(9).event(Event::Units(Units::Inch));
    run.n(95).rapid(-12.7, 0.0, -1.0);
    run.n(10).event(Event::Plane(Plane::Xy)).arc(Plane::Xy, [12.7, 0.0, -1.0], (0.0, 0.0), 180.0);
    check(
        &run,
        expect![[r#"
            |    7 N1     SET_FEED_RATE(100.0000)
            |    8 N1     STRAIGHT_TRAVERSE(2.0000, 0.0000, 0.0000, 3.0000, 1.0000, 2.0000)
            |    9 N3     ARC_FEED(3.0000, 0.0000, 2.5000, 0.0000, -1, 0.0000, 3.0000, 1.0000, 2.0000)
            |   10 N4     ARC_FEED(2.0000, 0.0000, 2.5000, 0.0000, 3, 0.0000, 3.0000, 1.0000, 2.0000)
            |   11 N5     ARC_FEED(2.0000, 0.0000, 3.0000, 0.0000, -2, -1.0000, 3.0000, 1.0000, 2.0000)
            |   12 N6     SELECT_PLANE(CANON_PLANE_XZ)
            |   13 N6     ARC_FEED(-1.0000, 3.0000, -1.0000, 2.5000, -1, 0.0000, 3.0000, 1.0000, 2.0000)
            |   14 N8     SELECT_PLANE(CANON_PLANE_YZ)
            |   15 N8     ARC_FEED(1.0000, -1.0000, 0.5000, -1.0000, -1, 3.0000, 3.0000, 1.0000, 2.0000)
            |   16 N9     USE_LENGTH_UNITS(CANON_UNITS_INCHES)
            |   17 N95    STRAIGHT_TRAVERSE(-0.5000, 0.0000, -0.0394, 3.0000, 1.0000, 2.0000)
            |   18 N10    SELECT_PLANE(CANON_PLANE_XY)
            |   19 N10    ARC_FEED(0.5000, 0.0000, 0.0000, 0.0000, 1, -0.0394, 3.0000, 1.0000, 2.0000)
        "#]],
    );
}

/// ```text
/// N1 S100 M3 F100
/// N3 G5 X5 Y5 I1 J1 P-1 Q-1
/// N10 G4 P1.5
/// N11 G33 Z-5 K1
/// N115 G20
/// N12 G33.1 Z-1 K-0.5
/// ```
#[test]
fn curves_dwells_and_threads() {
    let mut run = Run::new();
    run.n(1).event(Event::FeedRate(100.0)).event(Event::SpindleSpeed(100.0));
    run.event(Event::Spindle(Spindle::Clockwise));
    let curve = Curve { from: run.at, to: point(5.0, 5.0, 0.0), points: 4, pieces: [].into() };
    run.n(3).event(Event::Curve(curve));
    run.n(10).event(Event::Dwell(Seconds(1.5)));
    run.n(11).event(Event::SpindleSync { lead: Some(Mm(1.0)), velocity: false });
    run.travel(TravelKind::Thread, point(5.0, 5.0, -5.0));
    run.event(Event::SpindleSync { lead: None, velocity: false });
    run.units = Units::Inch;
    run.n(115).event(Event::Units(Units::Inch));
    run.n(12).event(Event::SpindleSync { lead: Some(Mm(-12.7)), velocity: false });
    run.event(Event::RigidTap { from: run.at, to: point(5.0, 5.0, -25.4), scale: 1.0 });
    run.event(Event::SpindleSync { lead: None, velocity: false });
    check(
        &run,
        expect![[r#"
            |    7 N1     SET_FEED_RATE(100.0000)
            |    8 N1     SET_SPINDLE_SPEED(0, 100.0000)
            |    9 N1     START_SPINDLE_CLOCKWISE(0)
            |   10 N3     NURBS_FEED(4, ...)
            |   11 N10    DWELL(1.5000)
            |   12 N11    START_SPEED_FEED_SYNC(1.000000,0)
            |   13 N11    STRAIGHT_FEED(5.0000, 5.0000, -5.0000, 0.0000, 0.0000, 0.0000)
            |   14 N11    STOP_SPEED_FEED_SYNCH()
            |   15 N115   USE_LENGTH_UNITS(CANON_UNITS_INCHES)
            |   16 N12    START_SPEED_FEED_SYNC(-0.500000,0)
            |   17 N12    RIGID_TAP(0.1969, 0.1969, -1.0000)
            |   18 N12    STOP_SPEED_FEED_SYNCH()
        "#]],
    );
}

/// ```text
/// N1 G93 G1 X1 F2
/// N2 G95 F[1/3]
/// N3 G94 F254
/// N4 G20 F10
/// N5 G61
/// N6 G61.1
/// N7 G64
/// N8 G64 P0.1
/// N9 G64 P0.1 Q0.05
/// N10 M48
/// N11 M49
/// N12 M52 P0
/// N13 M53 P1
/// ```
#[test]
fn feeds_and_path_modes() {
    let mut run = Run::new();
    run.feed_mode = FeedMode::InverseTime;
    run.n(1).event(Event::FeedMode(FeedMode::InverseTime)).event(Event::FeedRate(2.0)).feed(1.0, 0.0, 0.0);
    run.feed_mode = FeedMode::PerRevolution;
    run.n(2).event(Event::FeedMode(FeedMode::PerRevolution)).event(Event::FeedRate(0.0));
    run.event(Event::FeedRate(1.0 / 3.0));
    run.feed_mode = FeedMode::PerMinute;
    run.n(3)
        .event(Event::FeedMode(FeedMode::PerMinute))
        .event(Event::FeedRate(0.0))
        .event(Event::FeedRate(254.0));
    run.units = Units::Inch;
    run.n(4).event(Event::FeedRate(254.0)).event(Event::Units(Units::Inch));
    run.n(5).event(Event::PathMode(PathMode::ExactPath));
    run.n(6).event(Event::PathMode(PathMode::ExactStop));
    run.n(7).event(Event::PathMode(PathMode::Blending { tolerance: Mm(0.0), naive: None }));
    run.n(8).event(Event::PathMode(PathMode::Blending { tolerance: Mm(2.54), naive: None }));
    run.n(9).event(Event::PathMode(PathMode::Blending { tolerance: Mm(2.54), naive: Some(Mm(1.27)) }));
    for (n, on) in [(10, true), (11, false)] {
        run.n(n).event(Event::Override { kind: Override::Feed, on });
        run.event(Event::Override { kind: Override::Speed, on });
    }
    run.n(12).event(Event::Override { kind: Override::Adaptive, on: false });
    run.n(13).event(Event::Override { kind: Override::FeedStop, on: true });
    check(
        &run,
        expect![[r#"
            |    7 N1     SET_FEED_MODE(0, 0)
            |    8 N1     SET_FEED_RATE(2.0000)
            |    9 N1     STRAIGHT_FEED(1.0000, 0.0000, 0.0000, 0.0000, 0.0000, 0.0000)
            |   10 N2     SET_FEED_MODE(0, 1)
            |   11 N2     SET_FEED_RATE(0.0000)
            |   12 N2     SET_FEED_RATE(0.3333)
            |   13 N3     SET_FEED_MODE(0, 0)
            |   14 N3     SET_FEED_RATE(0.0000)
            |   15 N3     SET_FEED_RATE(254.0000)
            |   16 N4     SET_FEED_RATE(10.0000)
            |   17 N4     USE_LENGTH_UNITS(CANON_UNITS_INCHES)
            |   18 N5     SET_MOTION_CONTROL_MODE(CANON_EXACT_PATH)
            |   19 N6     SET_MOTION_CONTROL_MODE(CANON_EXACT_STOP)
            |   20 N7     SET_MOTION_CONTROL_MODE(CANON_CONTINUOUS, 0.000000)
            |   21 N7     SET_NAIVECAM_TOLERANCE(0.0000)
            |   22 N8     SET_MOTION_CONTROL_MODE(CANON_CONTINUOUS, 0.100000)
            |   23 N8     SET_NAIVECAM_TOLERANCE(0.1000)
            |   24 N9     SET_MOTION_CONTROL_MODE(CANON_CONTINUOUS, 0.100000)
            |   25 N9     SET_NAIVECAM_TOLERANCE(0.0500)
            |   26 N10    ENABLE_FEED_OVERRIDE()
            |   27 N10    ENABLE_SPEED_OVERRIDE(0)
            |   28 N11    DISABLE_FEED_OVERRIDE()
            |   29 N11    DISABLE_SPEED_OVERRIDE(0)
            |   30 N12    DISABLE_ADAPTIVE_FEED()
            |   31 N13    ENABLE_FEED_HOLD()
        "#]],
    );
}

/// ```text
/// N1 G10 L2 P1 X1 Y2 Z3 R30
/// N2 G92 X9
/// N3 G43.1 X1 Y2 Z3 A4 B5 C6
/// N4 G10 L1 P99 X1 Y2 Z3 A4 B5 C6 I11 J12 Q3
/// N5 G20
/// N6 G10 L1 P99 X[1/25.4]
/// N7 G92.1
/// N8 G10 L2 P2 X1
/// N9 G55
/// ```
#[test]
fn offsets() {
    let mut run = Run::new();
    let offset = point(1.0, 2.0, 3.0);
    run.n(1).event(Event::WorkOffset { number: 1, offset, rotation: 30.0 }).event(Event::Rotation(30.0));
    run.n(2).event(Event::Shift(point(-10.866_025_4, 0.0, 0.0)));
    let tool = nine([1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 0.0, 0.0, 0.0]);
    run.n(3).event(Event::LengthOffset(tool));
    let entry = ToolEntry {
        pocket: 3,
        tool: 99,
        offset: tool,
        diameter: Mm(4.0),
        angles: [11.0, 12.0],
        orientation: 3,
    };
    run.n(4).event(Event::ToolTableEntry(entry));
    run.units = Units::Inch;
    run.n(5).event(Event::Units(Units::Inch));
    run.n(6).event(Event::ToolTableEntry(entry));
    run.n(7).event(Event::Shift(Position::ZERO));
    run.n(9).event(Event::WorkOffset { number: 2, offset: point(25.4, 0.0, 0.0), rotation: 0.0 });
    run.event(Event::Shift(Position::ZERO)).event(Event::Rotation(0.0));
    check(
        &run,
        expect![[r#"
            |    7 N1     SET_G5X_OFFSET(1, 1.0000, 2.0000, 3.0000, 0.0000, 0.0000, 0.0000)
            |    8 N1     SET_XY_ROTATION(30.0000)
            |    9 N2     SET_G92_OFFSET(-10.8660, 0.0000, 0.0000, 0.0000, 0.0000, 0.0000)
            |   10 N3     USE_TOOL_LENGTH_OFFSET(1.0000 2.0000 3.0000, 4.0000 5.0000 6.0000, 0.0000 0.0000 0.0000)
            |   11 N4     SET_TOOL_TABLE_ENTRY(3, 99, 0.0394 0.0787 0.1181 4.0000 5.0000 6.0000 0.0000 0.0000 0.0000, 11.0000, 12.0000, 3)
            |   12 N5     USE_LENGTH_UNITS(CANON_UNITS_INCHES)
            |   13 N6     SET_TOOL_TABLE_ENTRY(3, 99, 0.0394 0.0787 0.1181 4.0000 5.0000 6.0000 0.0000 0.0000 0.0000, 11.0000, 12.0000, 3)
            |   14 N7     SET_G92_OFFSET(0.0000, 0.0000, 0.0000, 0.0000, 0.0000, 0.0000)
            |   15 N9     SET_G5X_OFFSET(2, 1.0000, 0.0000, 0.0000, 0.0000, 0.0000, 0.0000)
            |   16 N9     SET_G92_OFFSET(0.0000, 0.0000, 0.0000, 0.0000, 0.0000, 0.0000)
            |   17 N9     SET_XY_ROTATION(0.0000)
        "#]],
    );
}

/// The tool table lists T7, T2 and T99.
///
/// ```text
/// N3 T99 M6
/// N4 M61 Q7
/// N5 T0 M6
/// ```
#[test]
fn a_change_names_the_place_in_the_tool_table() {
    let mut run = Run::new();
    for (n, tool) in [(3, 99), (5, 0)] {
        run.n(n).event(Event::SelectTool(Some(tool))).event(Event::StartChange);
        run.event(Event::Spindle(Spindle::Stopped)).event(Event::ToolChange(Some(tool)));
        if n == 3 {
            run.n(4).event(Event::SetToolNumber(Some(7)));
        }
    }
    check(
        &run,
        expect![[r#"
            |    7 N3     SELECT_TOOL(99)
            |    8 N3     START_CHANGE()
            |    9 N3     STOP_SPINDLE_TURNING(0)
            |   10 N3     CHANGE_TOOL(3)
            |   11 N4     CHANGE_TOOL_NUMBER(1)
            |   12 N5     SELECT_TOOL(0)
            |   13 N5     START_CHANGE()
            |   14 N5     STOP_SPINDLE_TURNING(0)
            |   15 N5     CHANGE_TOOL(0)
        "#]],
    );
}

/// ```text
/// N1 S12.34567 M3
/// N2 M4
/// N3 M5
/// N4 G96 D1000 S200
/// N5 G20 G96 S100
/// N6 G97
/// N7 M19 R90 Q2
/// N8 M7
/// N81 M8
/// N9 M9
/// ```
#[test]
fn spindle_and_coolant() {
    let mut run = Run::new();
    run.n(1).event(Event::SpindleSpeed(12.345_67)).event(Event::Spindle(Spindle::Clockwise));
    run.n(2).event(Event::Spindle(Spindle::CounterClockwise));
    run.n(3).event(Event::Spindle(Spindle::Stopped));
    run.n(4).event(Event::SpindleMode(Some(1000.0))).event(Event::SpindleSpeed(200.0));
    run.units = Units::Inch;
    run.n(5).event(Event::SpindleMode(Some(f64::INFINITY))).event(Event::SpindleSpeed(100.0));
    run.event(Event::Units(Units::Inch));
    run.n(6).event(Event::SpindleMode(None));
    run.n(7).event(Event::OrientSpindle { angle: 90.0, way: 0 }).event(Event::WaitOrient(Seconds(2.0)));
    run.n(8).event(Event::Coolant { kind: Coolant::Mist, on: true });
    run.n(81).event(Event::Coolant { kind: Coolant::Flood, on: true });
    run.n(9).event(Event::Coolant { kind: Coolant::Mist, on: false });
    run.event(Event::Coolant { kind: Coolant::Flood, on: false });
    check(
        &run,
        expect![[r#"
            |    7 N1     SET_SPINDLE_SPEED(0, 12.3457)
            |    8 N1     START_SPINDLE_CLOCKWISE(0)
            |    9 N2     START_SPINDLE_COUNTERCLOCKWISE(0)
            |   10 N3     STOP_SPINDLE_TURNING(0)
            |   11 N4     SET_SPINDLE_MODE(0 1000.0000)
            |   12 N4     SET_SPINDLE_SPEED(0, 200.0000)
            |   13 N5     SET_SPINDLE_MODE(0 1000000000000000019884624838656.0000)
            |   14 N5     SET_SPINDLE_SPEED(0, 100.0000)
            |   15 N5     USE_LENGTH_UNITS(CANON_UNITS_INCHES)
            |   16 N6     SET_SPINDLE_MODE(0 0.0000)
            |   17 N7     ORIENT_SPINDLE(0, 90.0000, 0)
            |   18 N7     SPINDLE.0.WAIT_ORIENT_COMPLETE(2.0000)
            |   19 N8     MIST_ON()
            |   20 N81    FLOOD_ON()
            |   21 N9     MIST_OFF()
            |   22 N9     FLOOD_OFF()
        "#]],
    );
}

/// ```text
/// N20 M0
/// N21 M1
/// N22 M60
/// N27 M62 P1
/// N28 M63 P1
/// N29 M64 P2
/// N30 M65 P3
/// N31 M66 P1 L0
/// N33 M67 E1 Q3
/// N34 M68 E1 Q3.5
/// N161 (MSG,hi there)
/// N40 M30
/// ```
#[test]
fn stops_outputs_and_messages() {
    let mut run = Run::new();
    run.n(20).event(Event::Stop(Stop::Program));
    run.n(21).event(Event::Stop(Stop::Optional));
    run.n(22).event(Event::PalletChange).event(Event::Stop(Stop::Pallet));
    let outputs = [
        (27, 1, 1.0, false, true),
        (28, 1, 0.0, false, true),
        (29, 2, 1.0, false, false),
        (30, 3, 0.0, false, false),
    ];
    for (n, index, value, analog, with_move) in outputs {
        run.n(n).event(Event::Output { index, value, analog, with_move });
    }
    run.n(31).event(Event::WaitInput { index: 1, analog: false, what: 0, timeout: Seconds(0.0) });
    run.n(33).event(Event::Output { index: 1, value: 3.0, analog: true, with_move: true });
    run.n(34).event(Event::Output { index: 1, value: 3.5, analog: true, with_move: false });
    run.n(161).event(Event::Message("hi there".into()));
    run.n(40).event(Event::WorkOffset { number: 1, offset: Position::ZERO, rotation: 0.0 });
    run.event(Event::Rotation(0.0)).event(Event::FeedMode(FeedMode::PerMinute)).event(Event::FeedRate(0.0));
    run.event(Event::Spindle(Spindle::Stopped)).event(Event::SpindleMode(None));
    run.event(Event::PalletChange).event(Event::End);
    check(
        &run,
        expect![[r#"
            |    7 N20    PROGRAM_STOP()
            |    8 N21    OPTIONAL_PROGRAM_STOP()
            |    9 N22    PALLET_SHUTTLE()
            |   10 N22    PROGRAM_STOP()
            |   11 N27    SET_MOTION_OUTPUT_BIT(1)
            |   12 N28    CLEAR_MOTION_OUTPUT_BIT(1)
            |   13 N29    SET_AUX_OUTPUT_BIT(2)
            |   14 N30    CLEAR_AUX_OUTPUT_BIT(3)
            |   15 N33    SET_MOTION_OUTPUT_VALUE(1,3.000000)
            |   16 N34    SET_AUX_OUTPUT_VALUE(1,3.500000)
            |   17 N161   MESSAGE("hi there")
            |   18 N40    SET_G5X_OFFSET(1, 0.0000, 0.0000, 0.0000, 0.0000, 0.0000, 0.0000)
            |   19 N40    SET_XY_ROTATION(0.0000)
            |   20 N40    SET_FEED_MODE(0, 0)
            |   21 N40    SET_FEED_RATE(0.0000)
            |   22 N40    STOP_SPINDLE_TURNING(0)
            |   23 N40    SET_SPINDLE_MODE(0 0.0000)
            |   24 N40    PALLET_SHUTTLE()
            |   25 N40    PROGRAM_END()
        "#]],
    );
}

/// What the interpreter does not have: comments, which comparisons leave out, and numbers that are unknown.
#[test]
fn beyond_the_interface() {
    let mut run = Run::new();
    run.event(Event::Coolant { kind: Coolant::Through, on: true });
    run.event(Event::BarUnload(Mm(48.5))).event(Event::BarLoad);
    run.event(Event::Chuck(true)).event(Event::BarPush(Mm(30.0)));
    run.event(Event::UserCommand { number: 101, p: 1.0, q: f64::NAN });
    run.event(Event::Stop(Stop::Message("check\nthe part".into())));
    run.event(Event::SelectTool(None));
    let mut to = Position::ZERO;
    to.set(Axis::Y, f64::NAN);
    run.travel(TravelKind::Rapid, to);
    check(
        &run,
        expect![[r#"
            |    7 N..... COMMENT("coolant through the spindle on")
            |    8 N..... COMMENT("bar unloaded")
            |    9 N..... COMMENT("new bar loaded")
            |   10 N..... COMMENT("chuck clamped")
            |   11 N..... COMMENT("bar pushed by 30.0000")
            |   12 N..... COMMENT("user command 101 1.0000 nan")
            |   13 N..... MESSAGE("check the part")
            |   14 N..... PROGRAM_STOP()
            |   15 N..... SELECT_TOOL(nan)
            |   16 N..... STRAIGHT_TRAVERSE(0.0000, nan, 0.0000, 0.0000, 0.0000, 0.0000)
        "#]],
    );
}
