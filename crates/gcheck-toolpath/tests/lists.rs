//! The move list as JSON lines, CSV and text.

mod step_maker;

use expect_test::expect;
use gcheck_engine::{
    Axis, Coolant, Curve, CurvePiece, Event, FeedMode, Position, Spindle, Stop, Travel, TravelKind, Units,
};
use gcheck_geometry::{Mm, Plane, Seconds};
use gcheck_toolpath::{Beside, Csv, Step, View};
use step_maker::{Run, point, timing, xyz};

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
    expect![[r#"
        {"n":1,"file":"part.nc","line":1,"kind":"tool","units":"mm","action":"change","tool":3,"seconds":4.0}
        {"n":2,"file":"part.nc","line":2,"kind":"spindle","units":"mm","action":"speed","rpm":1000,"seconds":0.0}
        {"n":3,"file":"part.nc","line":2,"kind":"spindle","units":"mm","action":"clockwise","seconds":0.0}
        {"n":4,"file":"part.nc","line":2,"kind":"coolant","units":"mm","action":"flood-on","seconds":0.0}
        {"n":5,"file":"part.nc","line":3,"kind":"rapid","units":"mm","from":{"X":null,"Y":null,"Z":null},"programmed":{"X":10.0,"Y":0.0,"Z":5.0},"to":{"X":10.0,"Y":0.0,"Z":5.0},"machine":{"X":null,"Y":null,"Z":null},"feed":null,"feed_mode":null,"seconds":null}
        {"n":6,"file":"part.nc","line":4,"kind":"feed","units":"mm","from":{"X":10.0,"Y":0.0,"Z":5.0},"programmed":{"X":10.0,"Y":0.0,"Z":-2.0},"to":{"X":10.0,"Y":0.0,"Z":-2.0},"machine":{"X":-390.0,"Y":-200.0,"Z":-52.0},"feed":600.0,"feed_mode":"per-minute","seconds":0.7}
        {"n":7,"file":"part.nc","line":5,"kind":"arc","units":"mm","from":{"X":10.0,"Y":0.0,"Z":-2.0},"programmed":{"X":0.0,"Y":10.0,"Z":-2.0},"to":{"X":0.0,"Y":10.0,"Z":-2.0},"machine":{"X":-400.0,"Y":-190.0,"Z":-52.0},"feed":600.0,"feed_mode":"per-minute","arc":{"centre":{"X":0.0,"Y":0.0,"Z":-2.0},"normal":{"X":0,"Y":0,"Z":1},"sweep_deg":90.0},"seconds":1.570796}
        {"n":8,"file":"part.nc","line":6,"kind":"dwell","units":"mm","seconds":0.5}
        {"n":9,"file":"part.nc","line":7,"kind":"stop","units":"mm","action":"message","text":"say \"when\", please","seconds":0.0}
        {"n":10,"file":"part.nc","line":8,"kind":"end","units":"mm","seconds":0.0}
    "#]].assert_eq(&part().jsonl(xyz()));
}

#[test]
fn csv() {
    expect![[r#"
        n,file,line,kind,units,from_X,from_Y,from_Z,programmed_X,programmed_Y,programmed_Z,to_X,to_Y,to_Z,machine_X,machine_Y,machine_Z,feed,feed_mode,centre_X,centre_Y,centre_Z,normal,sweep_deg,seconds,action,value,text
        1,part.nc,1,tool,mm,,,,,,,,,,,,,,,,,,,,4.0,change,3,
        2,part.nc,2,spindle,mm,,,,,,,,,,,,,,,,,,,,0.0,speed,1000,
        3,part.nc,2,spindle,mm,,,,,,,,,,,,,,,,,,,,0.0,clockwise,,
        4,part.nc,2,coolant,mm,,,,,,,,,,,,,,,,,,,,0.0,flood-on,,
        5,part.nc,3,rapid,mm,,,,10.0,0.0,5.0,10.0,0.0,5.0,,,,,,,,,,,,,,
        6,part.nc,4,feed,mm,10.0,0.0,5.0,10.0,0.0,-2.0,10.0,0.0,-2.0,-390.0,-200.0,-52.0,600.0,per-minute,,,,,,0.7,,,
        7,part.nc,5,arc,mm,10.0,0.0,-2.0,0.0,10.0,-2.0,0.0,10.0,-2.0,-400.0,-190.0,-52.0,600.0,per-minute,0.0,0.0,-2.0,Z,90.0,1.570796,,,
        8,part.nc,6,dwell,mm,,,,,,,,,,,,,,,,,,,,0.5,,,
        9,part.nc,7,stop,mm,,,,,,,,,,,,,,,,,,,,0.0,message,,"say ""when"", please"
        10,part.nc,8,end,mm,,,,,,,,,,,,,,,,,,,,0.0,,,
    "#]].assert_eq(&part().csv(xyz()));
}

#[test]
fn text() {
    let mut run = part();
    run.units = Units::Inch;
    run.feed = 254.0;
    run.block().rapid(0.1 * 25.4, 1.0 / 3.0 * 25.4, 0.0).feed(25.4, -1e-9, 0.0);
    expect![[r#"
        part.nc, mm
           line  move             X          Y          Z       feed   seconds
              1  tool                                                    4.000  T3
              2  spindle                                                        1000 rpm
              2  spindle                                                        clockwise
              2  coolant                                                        flood-on
              3  rapid      10.0000     0.0000     5.0000                    ?
              4  feed       10.0000     0.0000    -2.0000        600     0.700
              5  arc         0.0000    10.0000    -2.0000        600     1.571  ccw 90 deg about X0 Y0
              6  dwell                                                   0.500
              7  stop                                                           say "when", please
              8  end
        part.nc, inch
           line  move             X          Y          Z       feed   seconds
              9  rapid       0.1000     0.3333     0.0000                0.025
              9  feed        1.0000     0.0000     0.0000         10     5.758
    "#]]
    .assert_eq(&run.text(xyz()));
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
    expect![[r#"
        {"n":1,"file":"part.nc","line":0,"kind":"feed","units":"inch","from":{"X":0.0,"B":0.0},"programmed":{"X":0.0,"B":90.0},"to":{"X":0.0,"B":90.0},"machine":{"X":0.0,"B":90.0},"feed":10.0,"feed_mode":"per-minute","seconds":540.0}
        {"n":2,"file":"part.nc","line":0,"kind":"arc","units":"inch","from":{"X":0.0,"B":90.0},"programmed":{"X":1.0,"B":90.0},"to":{"X":1.0,"B":90.0},"machine":{"X":1.0,"B":90.0},"feed":10.0,"feed_mode":"per-minute","arc":{"centre":{"X":0.5,"Y":0.0,"Z":0.0},"normal":{"X":0,"Y":1,"Z":0},"sweep_deg":180.0},"seconds":9.424778}
    "#]].assert_eq(&run.jsonl(view));
}

/// On a lathe that reads diameters, X is shown as one.
#[test]
fn diameters() {
    let mut run = Run::new();
    run.rapid(20.0, 0.0, 2.0);
    expect![[r#"
        part.nc, mm, X is a diameter
           line  move             X          Z       feed   seconds
              0  rapid      40.0000     2.0000                0.200
    "#]]
    .assert_eq(&run.text(View::new(&[Axis::X, Axis::Z]).with_diameters()));
}

/// A lead is a feed a turn; tapping is a way in and a way out.
#[test]
fn threads_and_taps() {
    let mut run = Run::new();
    run.rpm = 600.0;
    run.block().event(Event::SpindleSync { lead: Some(Mm(1.5)), velocity: false });
    run.travel(TravelKind::Thread, point(0.0, 0.0, -15.0));
    let from = run.at;
    run.block().event(Event::RigidTap { from, to: point(0.0, 0.0, -30.0), scale: 2.0 });
    run.block().event(Event::SpindleSync { lead: None, velocity: false });
    expect![[r#"
        part.nc, mm
           line  move             X          Y          Z       feed   seconds
              1  feed        0.0000     0.0000   -15.0000        1.5     1.000  per turn
              2  feed        0.0000     0.0000   -30.0000        1.5     1.000  per turn
              2  feed        0.0000     0.0000   -15.0000        1.5     0.500  per turn
    "#]]
    .assert_eq(&run.text(xyz()));
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
    expect![[r#"
        {"n":1,"file":"part.nc","line":0,"kind":"rapid","units":"mm","from":{"X":0.0,"Y":0.0},"programmed":{"X":0.0,"Y":0.0},"to":{"X":0.0,"Y":0.0},"machine":{"X":100.0,"Y":0.0},"feed":null,"feed_mode":null,"seconds":0.0}
        {"n":2,"file":"part.nc","line":0,"kind":"feed","units":"mm","from":{"X":0.0,"Y":0.0},"programmed":{"X":10.0,"Y":0.0},"to":{"X":10.0,"Y":0.0},"machine":{"X":110.0,"Y":0.0},"feed":6.0,"feed_mode":"inverse-time","seconds":3.889845}
        {"n":3,"file":"part.nc","line":0,"kind":"arc","units":"mm","from":{"X":10.0,"Y":0.0},"programmed":{"X":20.0,"Y":10.0},"to":{"X":20.0,"Y":10.0},"machine":{"X":120.0,"Y":10.0},"feed":6.0,"feed_mode":"inverse-time","arc":{"centre":{"X":10.0,"Y":10.0,"Z":0.0},"normal":{"X":0,"Y":0,"Z":1},"sweep_deg":90.0},"seconds":6.110155}
    "#]].assert_eq(&run.jsonl(View::new(&[Axis::X, Axis::Y])));
}

/// Axes that are beside the point which the program wrote: a reader is told both, and the tip where it is known.
#[test]
fn points_beside_the_programmed_one() {
    let mut run = Run::new();
    let mut moves = |beside, programmed, to| {
        run.beside = beside;
        let from = std::mem::replace(&mut run.at, to);
        run.block().event(Event::Travel(Travel {
            kind: TravelKind::Rapid,
            from,
            programmed,
            to,
            expanded: false,
        }));
    };
    let tip = Some([Mm(1.0), Mm(2.0), Mm(0.5)]);
    moves(Some(Beside::AlongTool { tip: None }), point(1.0, 2.0, 3.0), point(1.0, 5.0, 7.0));
    moves(Some(Beside::AlongTool { tip }), point(1.0, 2.0, 3.0), point(1.0, 2.0, 4.0));
    moves(Some(Beside::AlongVector), point(1.0, 2.0, 3.0), point(1.0, f64::NAN, 3.0));
    moves(None, point(0.0, 0.0, 0.0), point(0.0, 0.0, 0.0));
    expect![[r#"
        part.nc, mm
           line  move             X          Y          Z       feed   seconds
              1  rapid       1.0000     5.0000     7.0000                0.070  posted point X1 Y2 Z3, axes at X1 Y5 Z7
              2  rapid       1.0000     2.0000     4.0000                0.030  posted point X1 Y2 Z3, axes at X1 Y2 Z4, tip at X1 Y2 Z0.5
              3  rapid       1.0000          ?     3.0000                    ?  programmed point X1 Y2 Z3, axes at X1 Y? Z3
              4  rapid       0.0000     0.0000     0.0000                    ?
    "#]].assert_eq(&run.text(xyz()));
    expect![[r#"
        {"n":1,"file":"part.nc","line":1,"kind":"rapid","units":"mm","from":{"X":0.0,"Y":0.0,"Z":0.0},"programmed":{"X":1.0,"Y":2.0,"Z":3.0},"to":{"X":1.0,"Y":5.0,"Z":7.0},"machine":{"X":1.0,"Y":5.0,"Z":7.0},"feed":null,"feed_mode":null,"seconds":0.07}
        {"n":2,"file":"part.nc","line":2,"kind":"rapid","units":"mm","from":{"X":1.0,"Y":5.0,"Z":7.0},"programmed":{"X":1.0,"Y":2.0,"Z":3.0},"to":{"X":1.0,"Y":2.0,"Z":4.0},"machine":{"X":1.0,"Y":2.0,"Z":4.0},"feed":null,"feed_mode":null,"tip":{"X":1.0,"Y":2.0,"Z":0.5},"seconds":0.03}
        {"n":3,"file":"part.nc","line":3,"kind":"rapid","units":"mm","from":{"X":1.0,"Y":2.0,"Z":4.0},"programmed":{"X":1.0,"Y":2.0,"Z":3.0},"to":{"X":1.0,"Y":null,"Z":3.0},"machine":{"X":1.0,"Y":null,"Z":3.0},"feed":null,"feed_mode":null,"seconds":null}
        {"n":4,"file":"part.nc","line":4,"kind":"rapid","units":"mm","from":{"X":1.0,"Y":null,"Z":3.0},"programmed":{"X":0.0,"Y":0.0,"Z":0.0},"to":{"X":0.0,"Y":0.0,"Z":0.0},"machine":{"X":0.0,"Y":0.0,"Z":0.0},"feed":null,"feed_mode":null,"seconds":null}
    "#]].assert_eq(&run.jsonl(View::new(&[Axis::X, Axis::Y, Axis::Z])));
}
