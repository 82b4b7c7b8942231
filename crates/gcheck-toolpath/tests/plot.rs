//! What is recorded for a picture: which moves are drawn, where, with what beside them.

mod step_maker;

use gcheck_engine::{Axis, Event, FeedMode, Machine, Position, Tool, TravelKind};
use gcheck_geometry::{Mm, Plane};
use gcheck_toolpath::plot::{Drawing, Heading, Plot};
use gcheck_toolpath::{Names, WorkCoordinates};
use serde_json::json;
use step_maker::{Run, point, timing, xyz};

fn draw(run: &Run, limit: usize) -> Drawing {
    let mut plot = Plot::new(xyz(), timing(), WorkCoordinates::UNKNOWN, limit);
    run.each(|step| plot.add(step));
    plot.finish()
}

/// The numbers of an array of the data: groups of seven bits in base64.
fn numbers(text: &str) -> Vec<u64> {
    // Six bits a letter.
    let six = |letter: u8| match letter {
        b'A'..=b'Z' => letter - b'A',
        b'a'..=b'z' => letter - b'a' + 26,
        b'0'..=b'9' => letter - b'0' + 52,
        b'+' => 62,
        _ => 63,
    };
    let letters: Vec<u8> = text.bytes().filter(|letter| *letter != b'=').collect();
    let mut bytes = Vec::new();
    for group in letters.chunks(4) {
        let bits = group.iter().fold(0_u32, |bits, letter| bits << 6 | u32::from(six(*letter)));
        let bits = bits << (6 * (4 - group.len()));
        bytes.extend(bits.to_be_bytes().into_iter().skip(1).take(group.len() - 1));
    }
    let groups = bytes.split_inclusive(|byte| byte & 0x80 == 0);
    groups.map(|group| group.iter().rev().fold(0, |sum, byte| sum << 7 | u64::from(byte & 0x7F))).collect()
}

fn words(drawing: &Drawing) -> String {
    drawing.notes().into_iter().map(|note| note.words).collect::<Vec<_>>().join("\n")
}

fn text(drawing: &Drawing, field: &str) -> String {
    let data = drawing.to_json(&Names::NONE, &[]);
    data.get(field).and_then(|value| value.as_str()).unwrap_or_default().to_owned()
}

/// Numbers that are told by their differences, `width` of them a point.
fn differences(packed: &str, width: usize) -> Vec<i64> {
    let mut last = vec![0_i64; width];
    let mut all = Vec::new();
    for row in numbers(packed).chunks(width) {
        for (number, value) in row.iter().zip(&mut last) {
            let half = (number / 2).cast_signed();
            *value += if number % 2 == 1 { -half - 1 } else { half };
            all.push(*value);
        }
    }
    all
}

/// Numbers that are told by how often they come.
fn runs(drawing: &Drawing, field: &str) -> Vec<u64> {
    let pairs = numbers(&text(drawing, field));
    let pairs = pairs.chunks(2).filter_map(|pair| <[u64; 2]>::try_from(pair).ok());
    pairs.flat_map(|[length, value]| vec![value; length as usize]).collect()
}

fn points(drawing: &Drawing) -> Vec<[f64; 3]> {
    let steps = differences(&text(drawing, "points"), 3);
    let steps = steps.into_iter().filter_map(|steps| i32::try_from(steps).ok());
    let all: Vec<f64> = steps.map(|steps| f64::from(steps) / 1e4).collect();
    all.chunks(3).filter_map(|three| three.try_into().ok()).collect()
}

#[test]
fn moves_from_unknown_places_are_not_drawn() {
    let mut run = Run::new();
    run.at = Position::UNKNOWN;
    run.block().travel(TravelKind::Rapid, {
        let mut at = Position::UNKNOWN;
        at.set(Axis::X, 10.0);
        at.set(gcheck_engine::Axis::Y, 5.0);
        at
    });
    run.block().rapid(10.0, 5.0, 2.0);
    run.feed = 600.0;
    run.block().feed(10.0, 5.0, -1.0);
    let drawing = draw(&run, 1_000);
    assert_eq!(points(&drawing), [[10.0, 5.0, 2.0], [10.0, 5.0, -1.0]]);
    assert_eq!(runs(&drawing, "kinds"), [0, 2]);
    assert_eq!(differences(&text(&drawing, "lines"), 1), [2, 3]);
    assert_eq!(drawing.notes(), []);
}

#[test]
fn moves_that_lead_nobody_knows_where_are_counted_and_named() {
    let mut run = Run::new();
    run.block().rapid(10.0, 5.0, 2.0);
    run.block().feed(10.0, f64::NAN, 2.0);
    run.block().feed(20.0, 5.0, 2.0);
    run.block().feed(30.0, 5.0, 2.0);
    let notes = draw(&run, 1_000).notes();
    let note = notes.iter().find(|note| note.line.is_some()).unwrap();
    assert!(
        note.words.starts_with(
            "2 moves are not drawn, since a coordinate of their start or end is not known: Y in "
        ),
        "{note:?}"
    );
    assert_eq!(note.line, Some(2));
}

#[test]
fn no_more_is_said_of_what_a_run_takes_for_granted_than_people_read() {
    let words = |count: u32| {
        let mut plot = Plot::new(xyz(), timing(), WorkCoordinates::UNKNOWN, 1_000);
        for line in 1..=count {
            plot.assumed("", line, "program 9000 was not found");
        }
        words(&plot.finish()).lines().map(str::to_owned).collect::<Vec<_>>()
    };
    let few = words(20);
    assert!(few.iter().any(|line| line == "line 20: program 9000 was not found"), "{few:?}");
    assert!(!few.iter().any(|line| line.contains("more note")), "{few:?}");
    let many = words(4_000);
    assert_eq!(many.len(), few.len() + 1, "{many:?}");
    assert!(many.iter().any(|line| line == "and 3980 more notes of this kind"), "{many:?}");
}

#[test]
fn an_axis_that_nobody_knows_is_drawn_at_zero() {
    let mut run = Run::new();
    run.at = point(0.0, f64::NAN, 0.0);
    run.block().feed(10.0, f64::NAN, -5.0);
    assert_eq!(points(&draw(&run, 1_000)), [[0.0, 0.0, 0.0], [10.0, 0.0, -5.0]]);
}

#[test]
fn work_offsets_are_drawn_at_their_distance_where_it_is_known() {
    let mut run = Run::new();
    let offset = |number, x| Event::WorkOffset { number, offset: point(x, 0.0, 0.0), rotation: 0.0 };
    run.block().event(offset(1, -400.0)).rapid(0.0, 0.0, 0.0).feed(1.0, 0.0, 0.0);
    run.block().event(offset(2, -300.0)).feed(2.0, 0.0, 0.0);
    let drawing = draw(&run, 1_000);
    assert_eq!(points(&drawing).last(), Some(&[102.0, 0.0, 0.0]));
    assert_eq!(drawing.notes().len(), 1, "moves without a feed: {:?}", drawing.notes());

    let mut run = Run::new();
    let offset = |number| Event::WorkOffset { number, offset: Position::UNKNOWN, rotation: 0.0 };
    run.block().event(offset(1)).rapid(1.0, 0.0, 0.0);
    run.block().event(offset(2)).rapid(2.0, 0.0, 0.0);
    let notes = words(&draw(&run, 1_000));
    assert!(notes.contains("work offsets whose values nobody told are drawn as if they were one"), "{notes}");
}

/// A tool of which nothing is told.
const TOOL: Tool = Tool {
    pocket: 0,
    offset: Position::UNKNOWN,
    diameter: Mm(f64::NAN),
    corner_radius: Mm(f64::NAN),
    angles: [f64::NAN; 2],
    orientation: 0,
};

#[test]
fn what_is_around_the_path_is_told_in_its_coordinates() {
    let mut run = Run::new();
    let offset = |number, x, y| Event::WorkOffset { number, offset: point(x, y, 0.0), rotation: 0.0 };
    run.block().event(Event::ToolChange(Some(3))).event(offset(1, -400.0, f64::NAN)).rapid(0.0, 0.0, 0.0);
    run.block().event(offset(2, -300.0, f64::NAN)).rapid(1.0, 0.0, 0.0);
    run.block().event(offset(1, -400.0, f64::NAN)).rapid(2.0, 0.0, 0.0);
    let mut machine = Machine::default();
    machine.travel.extend([(Axis::X, (-700.0, 10.0)), (Axis::Y, (-500.0, 0.0)), (Axis::Z, (-400.0, 0.0))]);
    let tool = |diameter| Tool { diameter: Mm(diameter), ..TOOL };
    machine.tools.extend([(3, tool(12.0)), (4, tool(f64::NAN))]);
    let data = |plot: Plot| {
        let mut plot = plot.on_machine(&machine);
        run.each(|step| plot.add(step));
        plot.finish()
            .to_json(&Names { offset: &|number| Some(format!("G{}", 53 + number)), ..Names::NONE }, &[])
    };
    let mill = data(Plot::new(xyz(), timing(), WorkCoordinates::UNKNOWN, 1_000));
    // Where G55 is in Y nobody knows, and so nobody knows it.
    assert_eq!(mill["zeros"], json!([{ "name": "G54", "at": [0.0, 0.0, 0.0] }]));
    assert_eq!(mill["travel"], json!([[-300.0, 410.0], null]));
    assert_eq!(mill["tools"][0]["diameter"], json!(12.0));
    // On a lathe the offsets of tools count as well.
    let lathe = data(Plot::new(xyz(), timing(), WorkCoordinates::UNKNOWN, 1_000).for_lathe());
    assert_eq!((&lathe["travel"], &lathe["tools"][0]["diameter"]), (&json!([null, null]), &json!(null)));
}

#[test]
fn arcs_are_round_and_their_extents_exact() {
    let mut run = Run::new();
    run.feed = 600.0;
    run.at = point(10.0, 0.0, 0.0);
    run.block().arc(Plane::Xy, [10.0, 0.0, -3.0], (0.0, 0.0), 360.0);
    let drawing = draw(&run, 1_000);
    let points = points(&drawing);
    assert!(points.len() > 60 && points.len() < 400, "{}", points.len());
    assert!(points.iter().all(|[x, y, _]| (x.hypot(*y) - 10.0).abs() < 2e-4));
    let data = drawing.to_json(&Names::NONE, &[]);
    assert_eq!(data["cut"], json!([[-10.0, -10.0, -3.0], [10.0, 10.0, 0.0]]));
}

#[test]
fn memory_is_bounded_and_the_note_says_how_close_the_path_stays() {
    let mut run = Run::new();
    run.feed = 600.0;
    for at in 0..20_000_u32 {
        let angle = f64::from(at) * 0.01;
        run.block().feed(50.0 * angle.cos(), 50.0 * angle.sin(), -f64::from(at) * 0.001);
    }
    let drawing = draw(&run, 2_000);
    assert!(drawing.points() <= 2_000, "{}", drawing.points());
    assert!(drawing.thinned().is_some_and(|thinned| thinned.tolerance < 1.0), "{:?}", drawing.thinned());
    let notes = words(&drawing);
    assert!(notes.starts_with("the 20000 moves are drawn with"), "{notes}");
}

#[test]
fn tools_beyond_all_counting_share_the_last_colour() {
    let mut run = Run::new();
    run.feed = 600.0;
    for tool in 1..=400_u32 {
        run.block().change(tool).feed(f64::from(tool), 0.0, 0.0);
    }
    let drawing = draw(&run, 10_000);
    assert_eq!(drawing.tools().len(), 255);
    let data = drawing.to_json(&Names::NONE, &[]);
    assert_eq!(data["tools"][0]["number"], 1);
    assert_eq!(runs(&drawing, "toolOf").last(), Some(&254));
}

#[test]
fn a_feed_is_told_once_and_rapid_moves_keep_it() {
    let mut run = Run::new();
    run.feed = 600.0;
    run.rpm = 1_000.0;
    run.block().rapid(0.0, 0.0, 5.0).feed(10.0, 0.0, 5.0).feed(20.0, 0.0, 5.0).rapid(0.0, 0.0, 5.0);
    run.block().feed(10.0, 0.0, 5.0);
    run.feed_mode = FeedMode::PerRevolution;
    run.feed = 0.2;
    run.block().feed(20.0, 0.0, 5.0);
    let drawing = draw(&run, 1_000);
    let data = drawing.to_json(&Names::NONE, &[]);
    let driven: Vec<_> =
        runs(&drawing, "driveOf").into_iter().map(|ix| data["drives"][ix as usize].clone()).collect();
    let per_minute = json!({ "feed": 600.0, "mode": "minute", "along": 600.0, "rpm": 1000.0 });
    assert_eq!(
        driven[2..6],
        [per_minute.clone(), per_minute.clone(), per_minute.clone(), per_minute],
        "{data}"
    );
    assert_eq!(driven[6], json!({ "feed": 0.2, "mode": "turn", "along": 200.0, "rpm": 1000.0 }));
}

#[test]
fn only_axes_that_turn_have_angles() {
    let mut run = Run::new();
    run.feed = 600.0;
    for axis in [Axis::A, Axis::C] {
        run.at.set(axis, 0.0);
    }
    run.block().turn(TravelKind::Feed, Axis::C, 90.0).turn(TravelKind::Feed, Axis::A, -0.5);
    let data = draw(&run, 1_000).to_json(&Names::NONE, &[]);
    assert_eq!(data["rotary"]["axes"], "AC");
    // One axis after the other.
    let angles = differences(data["rotary"]["values"].as_str().unwrap(), 1);
    assert_eq!(angles, [0, 0, -5_000, 0, 900_000, 900_000]);

    let mut still = Run::new();
    still.block().feed(10.0, 0.0, 0.0);
    assert_eq!(draw(&still, 1_000).to_json(&Names::NONE, &[])["rotary"], json!(null));
}

#[test]
fn a_surface_takes_less_than_twelve_bytes_a_point_on_the_wire() {
    let mut run = Run::new();
    run.feed = 2_000.0;
    for at in 0..4_000_u32 {
        let along = f64::from(at % 100) * 0.45;
        run.block().feed(along, f64::from(at / 100) * 0.3, -3.0 + (along * 0.2).sin());
    }
    let drawing = draw(&run, 10_000);
    let arrays =
        ["points", "seconds", "lines", "kinds", "toolOf", "driveOf"].map(|field| text(&drawing, field).len());
    assert!(
        arrays.iter().sum::<usize>() < 12 * drawing.points(),
        "{arrays:?} for {} points",
        drawing.points()
    );
}

#[test]
fn headings_go_with_the_files_that_are_drawn() {
    let mut run = Run::new();
    run.feed = 600.0;
    run.block().change(1).feed(1.0, 0.0, 0.0);
    let drawing = draw(&run, 1_000);
    let file = drawing.files()[0].clone();
    let heading = |file| Heading { file, line: 7, name: "FINISH" };
    let data = drawing.to_json(&Names::NONE, &[heading(&file), heading("another.nc")]);
    assert_eq!(data["headings"], json!([{ "file": 0, "line": 7, "name": "FINISH" }]));
    assert_eq!(data["changes"].as_array().map(Vec::len), Some(1), "{data}");
}
