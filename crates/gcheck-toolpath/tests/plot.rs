//! What is recorded for a picture: which moves are drawn, where, with what beside them.

mod step_maker;

use gcheck_engine::{Event, Position, TravelKind};
use gcheck_geometry::Plane;
use gcheck_toolpath::plot::{Drawing, Plot};
use gcheck_toolpath::{Names, WorkCoordinates};
use step_maker::{Run, point, timing, xyz};

fn draw(run: &Run, limit: usize) -> Drawing {
    let mut plot = Plot::new(xyz(), timing(), WorkCoordinates::UNKNOWN, limit);
    run.each(|step| plot.add(step));
    plot.finish()
}

/// An array of the data, as its bytes.
fn bytes(drawing: &Drawing, field: &str) -> Vec<u8> {
    let data = drawing.to_json(&Names::NONE);
    let text = data.get(field).and_then(|value| value.as_str()).unwrap_or_default();
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
    bytes
}

fn points(drawing: &Drawing) -> Vec<[f32; 3]> {
    let numbers = |bytes: &[u8]| -> Vec<f32> {
        bytes.chunks(4).filter_map(|four| Some(f32::from_le_bytes(four.try_into().ok()?))).collect()
    };
    bytes(drawing, "points").chunks(12).filter_map(|three| numbers(three).try_into().ok()).collect()
}

#[test]
fn moves_from_unknown_places_are_not_drawn() {
    let mut run = Run::new();
    run.at = Position::UNKNOWN;
    run.block().travel(TravelKind::Rapid, {
        let mut at = Position::UNKNOWN;
        at.set(gcheck_engine::Axis::X, 10.0);
        at.set(gcheck_engine::Axis::Y, 5.0);
        at
    });
    run.block().rapid(10.0, 5.0, 2.0);
    run.feed = 600.0;
    run.block().feed(10.0, 5.0, -1.0);
    let drawing = draw(&run, 1_000);
    assert_eq!(points(&drawing), [[10.0, 5.0, 2.0], [10.0, 5.0, -1.0]]);
    assert_eq!(bytes(&drawing, "kinds"), [0, 2]);
    assert_eq!(bytes(&drawing, "lines"), [2, 0, 0, 0, 3, 0, 0, 0]);
    assert_eq!(drawing.notes(), Vec::<String>::new());
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
    let notes = draw(&run, 1_000).notes().join("\n");
    assert!(notes.contains("work offsets whose values nobody told are drawn as if they were one"), "{notes}");
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
    assert!(points.iter().all(|[x, y, _]| (x.hypot(*y) - 10.0).abs() < 1e-4));
    let data = drawing.to_json(&Names::NONE);
    assert_eq!(data["cut"], serde_json::json!([[-10.0, -10.0, -3.0], [10.0, 10.0, 0.0]]));
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
    let notes = drawing.notes().join("\n");
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
    let data = drawing.to_json(&Names::NONE);
    assert_eq!(data["tools"][0]["number"], 1);
    assert_eq!(bytes(&drawing, "toolOf").last(), Some(&254));
}
