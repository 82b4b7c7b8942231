//! Times and figures of whole runs.

mod step_maker;

use std::f64::consts::PI;

use expect_test::expect;
use gcheck_controls::CodeIx;
use gcheck_engine::{
    Axis, BarLengths, Clearing, Cylinder, Event, FeedMode, Position, Travel, TravelKind, Units,
};
use gcheck_geometry::{Mm, MmPerMin, Plane, Seconds};
use gcheck_toolpath::{Clock, Names, Statistics, Timing, Untimed, View};
use step_maker::{Run, point, timing, xyz};

/// Seconds of all events together.
fn seconds(run: &Run) -> Result<f64, Untimed> {
    let mut clock = Clock::new(timing());
    let mut total = Ok(0.0);
    run.each(|step| total = total.and_then(|sum| clock.step(step).map(|seconds| sum + seconds.0)));
    total.map(|seconds: f64| (seconds * 1e6).round() / 1e6)
}

#[test]
fn a_rapid_move_ends_with_its_slowest_axis() {
    let mut run = Run::new();
    run.rapid(100.0, 50.0, 0.0);
    assert_eq!(seconds(&run), Ok(1.0));
    // 3600 degrees a minute.
    run.turn(TravelKind::Rapid, Axis::C, 180.0);
    assert_eq!(seconds(&run), Ok(4.0));
}

#[test]
fn feeds_in_their_modes() {
    let mut run = Run::new();
    run.feed = 600.0;
    run.feed(30.0, 40.0, 0.0);
    assert_eq!(seconds(&run), Ok(5.0));

    let mut run = Run::new();
    (run.feed_mode, run.feed) = (FeedMode::InverseTime, 6.0);
    run.feed(1000.0, 0.0, 0.0);
    assert_eq!(seconds(&run), Ok(10.0));

    let mut run = Run::new();
    (run.feed_mode, run.feed, run.rpm) = (FeedMode::PerRevolution, 0.2, 1200.0);
    run.feed(8.0, 0.0, 0.0);
    assert_eq!(seconds(&run), Ok(2.0));
    run.rpm = 0.0;
    run.feed(0.0, 0.0, 0.0);
    assert_eq!(seconds(&run), Err(Untimed::Speed));
}

#[test]
fn arcs_by_their_length() {
    let mut run = Run::new();
    run.feed = 60.0;
    run.arc(Plane::Xy, [0.0, 0.0, 0.0], (10.0, 0.0), -360.0);
    assert_eq!(seconds(&run), Ok((20.0 * PI * 1e6).round() / 1e6));
}

/// The number of the feed counts degrees, in millimetres and in inches.
#[test]
fn rotary_axes_alone() {
    let mut run = Run::new();
    run.feed = 360.0;
    run.turn(TravelKind::Feed, Axis::A, 90.0);
    assert_eq!(seconds(&run), Ok(15.0));
    run.units = Units::Inch;
    run.feed = 360.0 * 25.4;
    run.turn(TravelKind::Feed, Axis::A, 0.0);
    assert_eq!(seconds(&run), Ok(30.0));
}

#[test]
fn threads_and_taps_by_lead_and_speed() {
    let mut run = Run::new();
    run.rpm = 600.0;
    run.event(Event::SpindleSync { lead: Some(Mm(1.5)), velocity: false });
    run.travel(TravelKind::Thread, point(0.0, 0.0, -15.0));
    assert_eq!(seconds(&run), Ok(1.0));
    // In at 600, out at 1200.
    run.event(Event::RigidTap { from: run.at, to: point(0.0, 0.0, -30.0), scale: 2.0 });
    assert_eq!(seconds(&run), Ok(2.5));
}

/// Facing from 50 mm radius to the centre at 157.08 m/min: 500 rpm outside, 3000 rpm at most. A turn takes the longer the
/// larger the radius, so the mean of the turns counts, not the mean of the speeds.
#[test]
fn constant_surface_speed() {
    let mut run = Run::new();
    run.event(Event::SpindleMode(Some(3000.0))).event(Event::SpindleSpeed(50.0 * PI));
    run.rpm = f64::NAN;
    (run.feed_mode, run.feed) = (FeedMode::PerRevolution, 0.1);
    run.at = point(50.0, 0.0, 0.0);
    run.feed(0.0, 0.0, 0.0);
    let turns: f64 = 500.0;
    let parts: f64 = (0..50_000)
        .map(|part| (f64::from(part) + 0.5) / 1000.0)
        .map(|x| f64::max(x / 50.0 / 500.0, 1.0 / 3000.0))
        .sum();
    let expected = turns * (parts / 50_000.0) * 60.0;
    assert!((seconds(&run).unwrap() - expected).abs() < 1e-3, "{expected}");

    // The same speed in feet, as an inch program says it.
    for step in &mut run.steps {
        step.units = Units::Inch;
        if let Event::SpindleSpeed(speed) = &mut step.event {
            *speed /= 0.3048;
        }
    }
    assert!((seconds(&run).unwrap() - expected).abs() < 1e-3, "{expected}");
}

#[test]
fn dwells_and_tool_changes() {
    let mut run = Run::new();
    run.event(Event::Dwell(Seconds(0.5))).change(1);
    // The tool is there already.
    run.change(1).change(2);
    assert_eq!(seconds(&run), Ok(8.5));
}

/// The axis that is wrapped stands still: a rapid move takes what the rotary axis needs, a cut what its way on the surface is.
#[test]
fn around_a_cylinder() {
    let wrapped = Cylinder { linear: Axis::Y, rotary: Axis::A, diameter: 100.0, stands: 0.0, zero: 0.0 };
    let mut run = Run::new();
    run.feed = 600.0;
    run.event(Event::Cylinder(Some(wrapped)));
    let mut to = point(0.0, 100.0, 0.0);
    to.set(Axis::A, 60.0);
    run.travel(TravelKind::Rapid, to);
    assert_eq!(seconds(&run), Ok(1.0));
    run.feed(0.0, 0.0, 0.0);
    assert_eq!(seconds(&run), Ok(11.0));
}

/// What the control clears by itself is counted, apart, and its way down is not a hole.
#[test]
fn pockets_are_estimates() {
    let mut run = Run::new();
    run.feed = 600.0;
    run.feed(0.0, 0.0, -5.0);
    let clearing = Clearing {
        from: [Mm(-20.0), Mm(-10.0), Mm(-5.0)],
        to: [Mm(20.0), Mm(10.0), Mm(0.0)],
        levels: 1,
        length: Mm(300.0),
        seconds: Seconds(30.0),
        counter_clockwise: true,
        compensation: CodeIx::NONE,
        at: run.at,
    };
    run.event(Event::Cleared(clearing)).rapid(0.0, 0.0, 0.0);
    let total = run.statistics(xyz(), timing()).total();
    assert_eq!((total.times.cutting, total.estimated, total.holes), (Seconds(30.5), Seconds(30.0), 0));
    assert_eq!(total.cut.range(0), Some((-20.0, 20.0)));
    assert_eq!(total.machine.range(1), Some((-10.0, 10.0)));

    let mut unknown = Run::new();
    unknown.event(Event::Cleared(Clearing { seconds: Seconds(f64::NAN), ..clearing }));
    let total = unknown.statistics(xyz(), timing()).total();
    assert_eq!((total.estimated, total.unaccounted.pockets), (Seconds(0.0), 1));
}

#[test]
fn what_cannot_be_timed() {
    let mut run = Run::new();
    run.feed(1.0, 0.0, 0.0);
    assert_eq!(seconds(&run), Err(Untimed::Feed));
    let mut run = Run::new();
    run.at = Position::UNKNOWN;
    run.rapid(1.0, 0.0, 0.0);
    assert_eq!(seconds(&run), Err(Untimed::Point));
}

const NAMES: Names<'static> = Names {
    tool: &|tool| match tool {
        1 => Some("FACE MILL 50".to_owned()),
        2 => Some("DRILL 8.5".to_owned()),
        _ => None,
    },
    offset: &|number| Some(format!("G{}", 53 + number)),
};

/// A face, a circle and two holes.
fn part() -> Run {
    let mut run = Run::new();
    run.at = Position::UNKNOWN;
    run.zero = point(-400.0, -200.0, -350.0);
    run.block().change(1);
    run.rpm = 3000.0;
    run.feed = 1200.0;
    run.block().rapid(-30.0, 0.0, 50.0);
    run.block().rapid(-30.0, 0.0, 2.0).feed(-30.0, 0.0, -1.0).feed(130.0, 0.0, -1.0);
    run.feed = 600.0;
    run.block().feed(130.0, 50.0, -1.0).arc(Plane::Xy, [130.0, 50.0, -1.0], (100.0, 50.0), 360.0);
    run.block().rapid(130.0, 50.0, 50.0);
    run.block().change(2);
    run.rpm = 2200.0;
    run.feed = 220.0;
    run.expanded = true;
    for x in [20.0, 80.0] {
        run.block().rapid(x, 25.0, 50.0).rapid(x, 25.0, 2.0);
        for depth in [-10.0, -20.0] {
            run.feed(x, 25.0, depth).rapid(x, 25.0, 2.0);
        }
        run.event(Event::Dwell(Seconds(0.2)));
    }
    run.expanded = false;
    run.block().rapid(80.0, 25.0, 50.0).event(Event::End);
    run
}

#[test]
fn a_table_for_machinists() {
    let statistics = part().statistics(xyz(), timing());
    expect![[r#"
        cycle time 1:03.8 min (lower bound): cutting 0:50.5 (79 %), rapid 0:04.8 (8 %), dwell 0:00.4 (1 %); 2 tool changes 0:08.0

        tool                   time  cutting   rapid   dwell  change  cut mm  rapid mm  feed          speed          holes  arcs
        T1     FACE MILL 50  0:37.0   0:32.0  0:01.0          0:04.0     401        99  600-1200/min  3000 rpm                 1
        T2     DRILL 8.5     0:26.8   0:18.5  0:03.8  0:00.4  0:04.0      68       402  220/min       2200 rpm           2
        total                1:03.8   0:50.5  0:04.8  0:00.4  0:08.0     469       501  220-1200/min  2200-3000 rpm      2     1

        extents, mm           X from        to    Y from        to    Z from        to
        T1 cutting           -30.000   130.000     0.000    80.000    -1.000     2.000
        T2 cutting            20.000    80.000    25.000    25.000   -20.000     2.000
        G54 all moves        -30.000   130.000     0.000    80.000   -20.000    50.000
        machine, all moves  -430.000  -270.000  -200.000  -120.000  -370.000  -300.000

        missing in these figures
          1 move from or to an unknown point: not in distance or time

        assumed
          axes and spindle reach their speed at once: real times are longer (set machine.acceleration)
    "#]].assert_eq(&statistics.to_text(&NAMES));
}

#[test]
#[expect(clippy::too_many_lines, reason = "the expectation is long")]
fn figures_as_json() {
    let statistics = part().statistics(View::new(&[Axis::X, Axis::Z]), timing());
    let mut json = statistics.to_json(&NAMES);
    json["total"] = "…".into();
    json["tools"][0] = "…".into();
    expect![[r#"
        {
          "assumptions": [
            {
              "key": "acceleration",
              "text": "axes and spindle reach their speed at once: real times are longer"
            }
          ],
          "slowest": [],
          "times": "lower-bound",
          "tools": [
            "…",
            {
              "arcs": 0,
              "corners": [],
              "distance": {
                "cutting": 68.0,
                "rapid": 401.642633,
                "rotary_deg": 0.0
              },
              "edge": {
                "chip_load": null,
                "metres_per_minute": null
              },
              "extents": {
                "cutting": {
                  "X": [
                    20.0,
                    80.0
                  ],
                  "Z": [
                    -20.0,
                    2.0
                  ]
                },
                "machine": {
                  "X": [
                    -380.0,
                    -270.0
                  ],
                  "Z": [
                    -370.0,
                    -300.0
                  ]
                }
              },
              "feeds": {
                "inverse_time": null,
                "per_minute": {
                  "max": 220.0,
                  "min": 220.0,
                  "more": false,
                  "values": [
                    220.0
                  ]
                },
                "per_rev": null
              },
              "file": "part.nc",
              "holes": 2,
              "line": 6,
              "moves": 13,
              "name": "DRILL 8.5",
              "offsets": [
                {
                  "extents": {
                    "X": [
                      20.0,
                      130.0
                    ],
                    "Z": [
                      -20.0,
                      50.0
                    ]
                  },
                  "name": "G54",
                  "number": 1
                }
              ],
              "probes": 0,
              "seconds": {
                "acceleration": 0.0,
                "auxiliary": 0.0,
                "cutting": 18.545455,
                "dwell": 0.4,
                "estimated": 0.0,
                "rapid": 3.82,
                "spindle": 0.0,
                "starved": 0.0,
                "tool_change": 4.0,
                "total": 26.765455
              },
              "speeds": {
                "metres_per_minute": null,
                "rpm": {
                  "max": 2200.0,
                  "min": 2200.0,
                  "more": false,
                  "values": [
                    2200.0
                  ]
                }
              },
              "tool": 2,
              "tool_changes": 1,
              "unaccounted": {
                "machine": 0,
                "machine_arcs": 0,
                "no_feed": 0,
                "no_speed": 0,
                "partly": 0,
                "pockets": 0,
                "unknown_dwell": 0,
                "unknown_point": 0
              }
            }
          ],
          "total": "…",
          "units": "mm",
          "x_is_diameter": false
        }"#]]
    .assert_eq(&serde_json::to_string_pretty(&json).unwrap());
}

/// In inches, with everything that can be missing or assumed.
#[test]
fn what_is_missing_and_what_is_assumed() {
    let mut run = Run::new();
    run.units = Units::Inch;
    run.at = Position::UNKNOWN;
    run.zero = Position::UNKNOWN;
    run.tool = None;
    run.rapid(25.4, 25.4, 25.4);
    run.rapid(50.8, 25.4, 25.4).feed(0.0, 0.0, 0.0).event(Event::ToolChange(None));
    run.feed_mode = FeedMode::PerRevolution;
    run.feed = 0.254;
    run.feed(25.4, 0.0, 0.0).event(Event::Dwell(Seconds(f64::NAN)));
    run.turn(TravelKind::Rapid, Axis::A, f64::NAN).turn(TravelKind::Rapid, Axis::A, 90.0);
    run.turn(TravelKind::Rapid, Axis::A, 0.0).rapid(0.0, 0.0, 0.0);
    let statistics =
        run.statistics(View::new(&[Axis::X, Axis::Y, Axis::Z, Axis::A]), Timing::new(None, None));
    expect![[r#"
        cycle time 0:06.6 min (lower bound): rapid 0:01.6 (24 %); 1 tool change 0:05.0

        tool     time  cutting   rapid  change  cut inch  rapid inch  feed      speed
        T?     0:00.1   0:00.0  0:00.1               2.4         1.0            0 rpm
        T?     0:06.6   0:00.0  0:01.6  0:05.0       1.0         1.0  0.01/rev  0 rpm
        total  0:06.6   0:00.0  0:01.6  0:05.0       3.4         2.0  0.01/rev  0 rpm

        extents, inch       X from      to  Y from      to  Z from      to  A from      to
        T? cutting          0.0000  2.0000  0.0000  1.0000  0.0000  1.0000       ?       ?
        T? cutting          0.0000  1.0000  0.0000  0.0000  0.0000  0.0000       ?       ?
        offset 1 all moves  0.0000  2.0000  0.0000  1.0000  0.0000  1.0000   0.000  90.000

        missing in these figures
          2 moves from or to an unknown point: not in distance or time
          1 move without a feed: not in time
          1 move at an unknown spindle speed or at none: not in time
          1 dwell of unknown length: not in time
          4 moves while an axis is at an unknown place: counted without it
          machine coordinates: the start, work offsets or tool lengths are not known

        assumed
          rapid moves at 1000 inch/min on every axis (set machine.rapid)
          rapid moves of rotary axes at 3600 deg/min (set machine.rotary_rapid)
          5 s for a tool change (set machine.tool_change_seconds)
          axes and spindle reach their speed at once: real times are longer (set machine.acceleration)
    "#]]
    .assert_eq(&statistics.to_text(&Names::NONE));
}

#[test]
fn a_program_without_moves() {
    let mut run = Run::new();
    run.event(Event::End);
    expect![[r#"
        cycle time 0:00.0 min (lower bound)
    "#]]
    .assert_eq(&run.statistics(xyz(), timing()).to_text(&Names::NONE));
}

/// An arc bulges beyond its ends, in work coordinates and in machine coordinates that are turned against them.
#[test]
fn extents_of_arcs() {
    let half_circle = |rotation: f64| {
        let mut run = Run::new();
        run.feed = 100.0;
        run.event(Event::WorkOffset { number: 1, offset: Position::ZERO, rotation });
        run.event(Event::Rotation(rotation));
        run.arc(Plane::Xy, [-10.0, 0.0, 0.0], (-5.0, 0.0), 180.0);
        // A quarter turn puts (x, y) at (-y, x).
        if rotation > 0.0
            && let Some(last) = run.steps.last_mut()
        {
            last.machine = point(0.0, -10.0, 0.0);
        }
        let statistics = run.statistics(xyz(), timing());
        let total = statistics.total();
        let ranges = |bounds: &gcheck_geometry::Bounds| {
            [0, 1].map(|axis| bounds.range(axis).map(|(low, high)| (low.round(), high.round())))
        };
        (ranges(&total.cut), ranges(&total.machine), total.unaccounted.arcs_by_ends)
    };
    let work = [Some((-10.0, 0.0)), Some((0.0, 5.0))];
    assert_eq!(half_circle(0.0), (work, work, 0));
    assert_eq!(half_circle(90.0), (work, [Some((-5.0, 0.0)), Some((-10.0, 0.0))], 0));
}

/// A bored hole with a shift at its bottom is one; so are pecks at one place. A pass of a turning cycle is none.
#[test]
fn holes() {
    use TravelKind::{Feed, Rapid};

    let holes = |moves: &[(TravelKind, [f64; 3])]| {
        let mut run = Run::new();
        run.feed = 100.0;
        run.expanded = true;
        for (kind, [x, y, z]) in moves {
            run.travel(*kind, point(*x, *y, *z));
        }
        run.statistics(xyz(), timing()).total().holes
    };
    let drill = |x: f64| [(Rapid, [x, 0.0, 0.0]), (Feed, [x, 0.0, -5.0]), (Rapid, [x, 0.0, 0.0])];
    assert_eq!(holes(&drill(1.0)), 1);
    assert_eq!(holes(&[drill(1.0), drill(1.0), drill(2.0)].concat()), 2);
    let bore = [(Feed, [0.0, 0.0, -5.0]), (Rapid, [0.1, 0.0, -5.0]), (Rapid, [0.1, 0.0, 0.0])];
    assert_eq!(holes(&bore), 1);
    let turn = [(Feed, [0.0, 0.0, -50.0]), (Feed, [1.0, 0.0, -49.0]), (Rapid, [1.0, 0.0, 0.0])];
    assert_eq!(holes(&turn), 0);
    let turn = [(Feed, [0.0, 0.0, -50.0]), (Feed, [1.0, 0.0, -50.0]), (Rapid, [1.0, 0.0, 0.0])];
    assert_eq!(holes(&turn), 0);
}

/// No run makes the figures grow without bound, and nothing is lost.
#[test]
fn many_tools_and_many_feeds() {
    let mut run = Run::new();
    for n in 0..5_000_u32 {
        run.change(n % 1_500);
        run.feed = f64::from(n) + 1.0;
        run.feed(f64::from(n), 0.0, 0.0);
    }
    let statistics = run.statistics(xyz(), timing());
    let total = statistics.total();
    assert_eq!(statistics.sections().len(), gcheck_toolpath::MAX_SECTIONS);
    assert_eq!((total.moves, total.tool_changes), (5_000, 5_000));
    let feeds = &total.feeds.per_minute;
    assert_eq!((feeds.distinct().len(), feeds.has_more()), (gcheck_toolpath::MAX_DISTINCT, true));
    assert_eq!(feeds.range(), Some((2.0, 5_000.0)));
}

/// Work offsets are told apart, and a run is counted in the units that most of it is written in.
#[test]
fn work_offsets_used() {
    let mut run = Run::new();
    run.feed = 100.0;
    run.event(Event::WorkOffset { number: 2, offset: Position::ZERO, rotation: 0.0 }).feed(5.0, 0.0, 0.0);
    run.event(Event::WorkOffset { number: 4, offset: Position::ZERO, rotation: 0.0 });
    run.event(Event::WorkOffset { number: 6, offset: Position::ZERO, rotation: 0.0 }).feed(-5.0, 0.0, 0.0);
    let total = run.statistics(xyz(), timing()).total();
    let used: Vec<_> = total.offsets.iter().map(|used| (used.number, used.extents.range(0))).collect();
    assert_eq!(used, [(Some(2), Some((0.0, 5.0))), (Some(6), Some((-5.0, 5.0)))]);
}

/// Numbers that make no sense give figures that are finite, and nothing panics.
#[test]
fn any_numbers() {
    let strange = [f64::NAN, f64::INFINITY, f64::NEG_INFINITY, -0.0, 1e300, -1e300, 5e-324];
    let mut run = Run::new();
    for a in strange {
        for b in strange {
            (run.feed, run.rpm) = (a, b);
            run.event(Event::SpindleMode(Some(a))).event(Event::SpindleSpeed(b));
            run.event(Event::SpindleSync { lead: Some(Mm(a)), velocity: true });
            run.event(Event::Dwell(Seconds(a))).event(Event::BarPush(Mm(b)));
            run.feed(a, b, a).arc(Plane::Yz, [b, a, b], (a, b), a);
            run.event(Event::RigidTap { from: run.at, to: point(a, b, b), scale: b });
            run.event(Event::SpindleSync { lead: None, velocity: true }).event(Event::SpindleMode(None));
            let travel = Travel {
                kind: TravelKind::Rapid,
                from: run.at,
                programmed: run.at,
                to: point(b, a, 0.0),
                expanded: true,
            };
            run.event(Event::Travel(travel)).turn(TravelKind::Feed, Axis::B, a);
            run.event(Event::WorkOffset { number: 0, offset: run.at, rotation: b }).event(Event::Rotation(a));
        }
    }
    let statistics: Statistics =
        run.statistics(View::new(&Axis::ALL), Timing::new(Some(MmPerMin(f64::NAN)), Some(Seconds(-1.0))));
    let (text, json) = (statistics.to_text(&Names::NONE), statistics.to_json(&Names::NONE).to_string());
    assert!(!text.contains("NaN") && !json.is_empty());
    for line in run.jsonl(xyz()).lines() {
        serde_json::from_str::<serde_json::Value>(line).unwrap();
    }
    assert!(!run.csv(xyz()).is_empty() && !run.text(xyz()).is_empty() && !run.canonical(&[]).is_empty());
}

/// A bar job: two bars, of which the second is used up; the tools of all parts are one row each.
#[test]
fn parts_and_bars_of_a_bar_job() {
    let lengths = BarLengths { part: Mm(25.0), initial: Mm(30.0), clamping: Mm(40.0) };
    let mut run = Run::new();
    run.rpm = 1000.0;
    run.feed = 600.0;
    let part = |run: &mut Run, end: &[Event]| {
        run.event(Event::ToolChange(Some(1)));
        run.feed(0.0, 0.0, -20.0).feed(0.0, 0.0, 0.0);
        run.event(Event::BarFeed(lengths));
        for event in end {
            run.event(event.clone());
        }
    };
    let push = [Event::BarPush(Mm(25.0))];
    let load = [Event::BarUnload(Mm(48.5)), Event::BarLoad, Event::BarPush(Mm(30.0))];
    part(&mut run, &push);
    part(&mut run, &load);
    part(&mut run, &push);
    part(&mut run, &push);
    part(&mut run, &[Event::BarUnload(Mm(48.5))]);
    let mut statistics = Statistics::new(View::new(&[Axis::X, Axis::Y, Axis::Z]), timing(), Some(1));
    run.each(|step| statistics.add(step));
    assert_eq!(statistics.sections().len(), 1);
    assert_eq!(statistics.bar().by_bar(), [2, 3]);
    let text = statistics.to_text(&Names::NONE);
    let section = text.split("\n\n").find(|part| part.starts_with("bar feeder")).unwrap();
    expect![[r#"
        bar feeder
          5 parts from 2 bars, 2 to 3 a bar
          bar pushed 105 mm
          48.5 mm left of a bar, behind the face of the chuck
          0:04.8 min a part, without what the feeder takes"#]]
    .assert_eq(section);
}

/// A feed in front of the first part makes none, and a push of unknown length is said to be one.
#[test]
fn a_bar_feed_before_anything_was_cut() {
    let unknown = BarLengths { part: Mm::UNKNOWN, initial: Mm::UNKNOWN, clamping: Mm::UNKNOWN };
    let mut run = Run::new();
    run.event(Event::BarFeed(unknown)).event(Event::BarPush(Mm::UNKNOWN));
    let mut statistics = Statistics::new(View::new(&[Axis::X, Axis::Z]), timing(), Some(1));
    run.each(|step| statistics.add(step));
    let text = statistics.to_text(&Names::NONE);
    expect![[r#"
        cycle time 0:00.0 min (lower bound)

        bar feeder
          0 parts
          bar pushed by lengths that are not known
    "#]]
    .assert_eq(&text);
}
