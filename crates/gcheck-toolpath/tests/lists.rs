//! The move list as JSON lines, CSV and text.

mod common;

use common::{Run, point, timing, xyz};
use expect_test::expect;
use gcheck_engine::{
    Axis, Coolant, Curve, CurvePiece, Event, FeedMode, Position, Spindle, Stop, TravelKind, Units,
};
use gcheck_geometry::{Mm, Plane, Seconds};
use gcheck_toolpath::{Csv, Step, View};

/// A drilled hole, an arc, and what stands between them.
fn part() -> Run {
    let mut run = Run::new();
    run.at = Position::UNKNOWN;
    run.zero = Position::UNKNOWN;
    run.block().change(3);
    run.rpm = 1000.0;
    run.block().event(Event::SpindleSpeed(1000.0)).event(Event::Spindle(Spindle::Clockwise));
    run.event(Event::Coolant { kind: Coolant::Flood, on: true });
    run.block().rapid(10.0, 0.0, 5.0);
    run.zero = point(-400.0, -200.0, -50.0);
    run.feed = 600.0;
    run.block().feed(10.0, 0.0, -2.0);
    run.block().arc(Plane::Xy, [0.0, 10.0, -2.0], (0.0, 0.0), 90.0);
    run.block().event(Event::Dwell(Seconds(0.5)));
    run.block().event(Event::Stop(Stop::Message("say \"when\", please".into())));
    run.block().event(Event::End);
    run
}

#[test]
fn json_lines() {
    expect![[r#""#]].assert_eq(&part().jsonl(xyz()));
}

#[test]
fn csv() {
    expect![[r#""#]].assert_eq(&part().csv(xyz()));
}

#[test]
fn text() {
    let mut run = part();
    run.units = Units::Inch;
    run.feed = 254.0;
    run.block().rapid(0.1 * 25.4, 1.0 / 3.0 * 25.4, 0.0).feed(25.4, -1e-9, 0.0);
    expect![[r#""#]].assert_eq(&run.text(xyz()));
}

/// Every line is JSON, with the fields that other programs rely on.
#[test]
fn json_lines_are_json() {
    for line in part().jsonl(View::new(&Axis::ALL)).lines() {
        let value: serde_json::Value = serde_json::from_str(line).unwrap();
        assert!(value["n"].is_u64() && value["line"].is_u64() && value["kind"].is_string(), "{line}");
        if ["rapid", "feed", "arc", "probe"].contains(&value["kind"].as_str().unwrap()) {
            for place in ["from", "programmed", "to", "machine"] {
                assert_eq!(value[place].as_object().unwrap().len(), 9, "{line}");
            }
        }
    }
}

/// A row has as many cells as the header, whatever it tells of and whatever the names.
#[test]
fn csv_rows_are_as_long_as_the_header() {
    let mut out = Csv::new(Vec::new(), xyz(), timing()).unwrap();
    part().each(|step| out.step(&Step { file: "part, \"new\".nc", ..*step }).unwrap());
    let text = String::from_utf8(out.finish().unwrap()).unwrap();
    let cells = |line: &str| {
        // Commas between quotes belong to a cell.
        line.split('"').step_by(2).map(|outside| outside.matches(',').count()).sum::<usize>()
    };
    let counts: Vec<usize> = text.lines().map(cells).collect();
    assert!(counts.len() > 8 && counts.iter().all(|count| *count == counts[0]), "{counts:?}\n{text}");
}

/// Coordinates, feed and centre are in the units of the program; angles are degrees.
#[test]
fn units_of_the_program() {
    let mut run = Run::new();
    run.units = Units::Inch;
    run.feed = 254.0;
    run.turn(TravelKind::Feed, Axis::B, 90.0).arc(Plane::Zx, [25.4, 0.0, 0.0], (0.0, 12.7), 180.0);
    let view = View::new(&[Axis::X, Axis::B]);
    expect![[r#""#]].assert_eq(&run.jsonl(view));
}

/// On a lathe that reads diameters, X is shown as one.
#[test]
fn diameters() {
    let mut run = Run::new();
    run.rapid(20.0, 0.0, 2.0);
    expect![[r#""#]].assert_eq(&run.text(View::new(&[Axis::X, Axis::Z]).with_diameters()));
}

/// A lead is a feed a turn; tapping is a way in and a way out.
#[test]
fn threads_and_taps() {
    let mut run = Run::new();
    run.rpm = 600.0;
    run.block().event(Event::SpindleSync { lead: Some(Mm(1.5)), velocity: false });
    run.travel(TravelKind::Thread, point(0.0, 0.0, -15.0));
    run.block().event(Event::RigidTap { from: run.at, to: point(0.0, 0.0, -30.0), scale: 2.0 });
    run.block().event(Event::SpindleSync { lead: None, velocity: false });
    expect![[r#""#]].assert_eq(&run.text(xyz()));
}

/// A curve is the lines and arcs that it is made of; machine coordinates follow its end.
#[test]
fn curves_are_their_pieces() {
    let mut run = Run::new();
    run.zero = point(100.0, 0.0, 0.0);
    run.feed_mode = FeedMode::InverseTime;
    run.feed = 6.0;
    run.rapid(0.0, 0.0, 0.0);
    let from = run.at;
    run.at = point(20.0, 10.0, 0.0);
    run.event(Event::Curve(Curve {
        from,
        to: run.at,
        points: 4,
        pieces: [
            CurvePiece::Line([Mm(10.0), Mm(0.0)]),
            CurvePiece::Arc { to: [Mm(20.0), Mm(10.0)], centre: [Mm(10.0), Mm(10.0)], turn: 1 },
        ]
        .into(),
    }));
    expect![[r#""#]].assert_eq(&run.jsonl(View::new(&[Axis::X, Axis::Y])));
}
