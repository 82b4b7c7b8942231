//! Specifications of compensation, by example.
//!
//! The expectations of [`CompensationStyle::TangentEntry`] are what LinuxCNC's standalone interpreter gives for the
//! same path.

use super::{
    CompensationConfig, CompensationError, CompensationStyle, Compensator, Cutter, CutterSide, GougeKind,
    LineKind, OffsetCourse, OffsetEvent, OffsetSegment, PathPoint,
};
use expect_test::{Expect, expect};
use proptest::prelude::*;
use std::fmt::Write as _;

/// What a test does with a compensator.
#[derive(Clone, Copy, Debug)]
enum Step {
    Feed(f64, f64),
    FeedTo(f64, f64, f64),
    Rapid(f64, f64),
    RapidTo(f64, f64, f64),
    /// End, centre.
    Clockwise([f64; 2], [f64; 2]),
    Ccw([f64; 2], [f64; 2]),
    /// End with normal coordinate, centre, turns.
    HelixCcw([f64; 3], [f64; 2], u32),
    Pass(&'static str),
    Flush,
    Stop,
}
use Step::{Ccw, Clockwise, Feed, FeedTo, Flush, HelixCcw, Pass, Rapid, RapidTo, Stop};

type Event = OffsetEvent<usize, &'static str>;

fn apply(
    compensator: &mut Compensator<usize, &'static str>,
    index: usize,
    step: Step,
    emit: impl FnMut(Event),
) -> Result<(), CompensationError> {
    let normal = compensator.programmed().normal;
    let at = |[first, second]: [f64; 2]| PathPoint::new(first, second, normal);
    match step {
        Feed(x, y) => compensator.line(at([x, y]), LineKind::Feed, index, emit),
        FeedTo(x, y, z) => compensator.line(PathPoint::new(x, y, z), LineKind::Feed, index, emit),
        Rapid(x, y) => compensator.line(at([x, y]), LineKind::Rapid, index, emit),
        RapidTo(x, y, z) => compensator.line(PathPoint::new(x, y, z), LineKind::Rapid, index, emit),
        Clockwise(end, centre) => compensator.arc(at(end), centre, false, 1, index, emit),
        Ccw(end, centre) => compensator.arc(at(end), centre, true, 1, index, emit),
        HelixCcw([x, y, z], centre, turns) => {
            compensator.arc(PathPoint::new(x, y, z), centre, true, turns, index, emit)
        }
        Pass(text) => {
            compensator.pass(text, emit);
            Ok(())
        }
        Flush => compensator.flush(emit),
        Stop => compensator.stop(emit).map(drop),
    }
}

/// One line for each event: the step that gave it out, the step it belongs to, the path.
fn run(config: CompensationConfig, cutter: Cutter, steps: &[Step]) -> String {
    let mut compensator = Compensator::new(config);
    let mut out = String::new();
    compensator.start(cutter, PathPoint::new(0.0, 0.0, 0.0)).unwrap();
    for (index, step) in steps.iter().enumerate() {
        let result = apply(&mut compensator, index, *step, |event| show(&mut out, index, &event));
        if let Err(error) = result {
            writeln!(out, "{index} {error:?}").unwrap();
            break;
        }
    }
    out
}

fn show(out: &mut String, now: usize, event: &Event) {
    let (segment, of) = match event {
        OffsetEvent::Passed(text) => {
            writeln!(out, "{now} {text}").unwrap();
            return;
        }
        OffsetEvent::Programmed { segment, payload } => (segment, format!("of {payload}")),
        OffsetEvent::Inserted { segment, after, .. } => (segment, format!("corner before {after}")),
    };
    let number = |value: f64| format!("{:.4}", if value.abs() < 5e-5 { 0.0 } else { value });
    let PathPoint { first, second, normal } = segment.end;
    let end = format!("{} {} {}", number(first), number(second), number(normal));
    match segment.course {
        OffsetCourse::Line(kind) => writeln!(out, "{now} {kind:?} {end} ({of})").unwrap(),
        OffsetCourse::Arc { centre: [x, y], ccw, turns } => {
            let turn = if ccw { "ccw" } else { "cw" };
            let turns = if turns > 1 { format!(" x{turns}") } else { String::new() };
            writeln!(out, "{now} {turn}{turns} {end} about {} {} ({of})", number(x), number(y)).unwrap();
        }
    }
}

fn left(radius: f64) -> Cutter {
    Cutter::new(CutterSide::Left, radius)
}

fn right(radius: f64) -> Cutter {
    Cutter::new(CutterSide::Right, radius)
}

#[expect(clippy::needless_pass_by_value, reason = "expect! is written in place")]
fn tangent(cutter: Cutter, steps: &[Step], expected: Expect) {
    expected.assert_eq(&run(CompensationConfig::tangent_entry(), cutter, steps));
}

#[expect(clippy::needless_pass_by_value, reason = "expect! is written in place")]
fn sharp(cutter: Cutter, steps: &[Step], expected: Expect) {
    expected.assert_eq(&run(CompensationConfig::intersection(), cutter, steps));
}

mod tangent_entry {
    use super::*;

    #[test]
    fn inside_corners_are_intersections_and_ends_are_known_one_segment_later() {
        tangent(
            left(5.0),
            &[Feed(20.0, 0.0), Feed(20.0, 30.0), Feed(0.0, 30.0), Stop],
            expect![[r#"
                1 Feed 15.0000 5.0000 0.0000 (of 0)
                2 Feed 15.0000 25.0000 0.0000 (of 1)
                3 Feed 0.0000 25.0000 0.0000 (of 2)
            "#]],
        );
    }

    #[test]
    fn outside_corners_are_arcs_for_feeds() {
        tangent(
            right(5.0),
            &[Feed(20.0, 0.0), Feed(20.0, 30.0), Feed(0.0, 30.0), Stop],
            expect![[r#"
                1 Feed 20.0000 -5.0000 0.0000 (of 0)
                1 ccw 25.0000 0.0000 0.0000 about 20.0000 0.0000 (corner before 1)
                2 Feed 25.0000 30.0000 0.0000 (of 1)
                2 ccw 20.0000 35.0000 0.0000 about 20.0000 30.0000 (corner before 2)
                3 Feed 0.0000 35.0000 0.0000 (of 2)
            "#]],
        );
    }

    #[test]
    fn outside_corners_are_lines_before_rapids() {
        tangent(
            right(5.0),
            &[Feed(20.0, 0.0), Rapid(20.0, 30.0), Feed(0.0, 30.0), Rapid(0.0, 60.0), Stop],
            expect![[r#"
                1 Feed 20.0000 -5.0000 0.0000 (of 0)
                1 Rapid 25.0000 0.0000 0.0000 (corner before 1)
                2 Rapid 25.0000 30.0000 0.0000 (of 1)
                2 ccw 20.0000 35.0000 0.0000 about 20.0000 30.0000 (corner before 2)
                3 Feed 5.0000 35.0000 0.0000 (of 2)
                4 Rapid 5.0000 60.0000 0.0000 (of 3)
            "#]],
        );
    }

    #[test]
    fn a_negative_radius_is_the_other_side() {
        let steps = [Feed(20.0, 0.0), Feed(20.0, 30.0), Stop];
        let config = CompensationConfig::tangent_entry();
        assert_eq!(run(config, left(-5.0), &steps), run(config, right(5.0), &steps));
        assert_eq!(run(config, right(-5.0), &steps), run(config, left(5.0), &steps));
    }

    #[test]
    fn radius_zero_gives_the_programmed_path_at_once() {
        tangent(
            left(0.0),
            &[
                Feed(20.0, 0.0),
                Pass("coolant"),
                FeedTo(20.0, 0.0, 3.0),
                Clockwise([40.0, 20.0], [40.0, 0.0]),
                Stop,
            ],
            expect![[r#"
                0 Feed 20.0000 0.0000 0.0000 (of 0)
                1 coolant
                2 Feed 20.0000 0.0000 3.0000 (of 2)
                3 cw 40.0000 20.0000 3.0000 about 40.0000 0.0000 (of 3)
            "#]],
        );
    }

    #[test]
    fn the_path_may_turn_back_round_its_end() {
        tangent(
            left(5.0),
            &[Feed(20.0, 0.0), Feed(0.0, 0.0), Feed(0.0, 20.0), Stop],
            expect![[r#"
                1 Feed 20.0000 5.0000 0.0000 (of 0)
                1 cw 20.0000 -5.0000 0.0000 about 20.0000 0.0000 (corner before 1)
                2 Feed 0.0000 -5.0000 0.0000 (of 1)
                2 cw -5.0000 0.0000 0.0000 about 0.0000 0.0000 (corner before 2)
                3 Feed -5.0000 20.0000 0.0000 (of 2)
            "#]],
        );
    }

    #[test]
    fn bends_within_the_tolerance_are_no_corners() {
        tangent(
            right(5.0),
            &[Feed(20.0, 0.0), Feed(40.0, 0.001), Feed(60.0, 10.0), Stop],
            expect![[r#"
                1 Feed 20.0000 -5.0000 0.0000 (of 0)
                2 Feed 40.0002 -4.9990 0.0000 (of 1)
                2 ccw 42.2359 -4.4712 0.0000 about 40.0000 0.0010 (corner before 2)
                3 Feed 62.2359 5.5278 0.0000 (of 2)
            "#]],
        );
    }

    #[test]
    fn tangent_arcs_shrink_inside_and_grow_outside() {
        let steps = [Feed(20.0, 0.0), Ccw([40.0, 20.0], [20.0, 20.0]), Feed(40.0, 40.0), Stop];
        tangent(
            left(5.0),
            &steps,
            expect![[r#"
                1 Feed 20.0000 5.0000 0.0000 (of 0)
                2 ccw 35.0000 20.0000 0.0000 about 20.0000 20.0000 (of 1)
                3 Feed 35.0000 40.0000 0.0000 (of 2)
            "#]],
        );
        tangent(
            right(5.0),
            &steps,
            expect![[r#"
                1 Feed 20.0000 -5.0000 0.0000 (of 0)
                2 ccw 45.0000 20.0000 0.0000 about 20.0000 20.0000 (of 1)
                3 Feed 45.0000 40.0000 0.0000 (of 2)
            "#]],
        );
    }

    #[test]
    fn corners_between_lines_and_arcs() {
        let steps = [Feed(20.0, 0.0), Ccw([0.0, 20.0], [0.0, 0.0]), Feed(-20.0, 20.0), Stop];
        tangent(
            left(5.0),
            &steps,
            expect![[r#"
                1 Feed 14.1421 5.0000 0.0000 (of 0)
                2 ccw 0.0000 15.0000 0.0000 about 0.0000 0.0000 (of 1)
                3 Feed -20.0000 15.0000 0.0000 (of 2)
            "#]],
        );
        tangent(
            right(5.0),
            &steps,
            expect![[r#"
                1 Feed 20.0000 -5.0000 0.0000 (of 0)
                1 ccw 25.0000 0.0000 0.0000 about 20.0000 0.0000 (corner before 1)
                2 ccw 0.0000 25.0000 0.0000 about 0.0000 0.0000 (of 1)
                3 Feed -20.0000 25.0000 0.0000 (of 2)
            "#]],
        );
    }

    #[test]
    fn corners_between_arcs() {
        let steps = [
            Feed(20.0, 0.0),
            Clockwise([50.0, 0.0], [35.0, 0.0]),
            Clockwise([80.0, 0.0], [65.0, 0.0]),
            Feed(100.0, 0.0),
            Stop,
        ];
        tangent(
            left(5.0),
            &steps,
            expect![[r#"
                1 Feed 15.6351 5.0000 0.0000 (of 0)
                2 cw 50.0000 13.2288 0.0000 about 35.0000 0.0000 (of 1)
                3 cw 84.3649 5.0000 0.0000 about 65.0000 0.0000 (of 2)
                4 Feed 100.0000 5.0000 0.0000 (of 3)
            "#]],
        );
        tangent(
            right(5.0),
            &steps,
            expect![[r#"
                1 Feed 20.0000 -5.0000 0.0000 (of 0)
                1 ccw 25.0000 0.0000 0.0000 about 20.0000 0.0000 (corner before 1)
                2 cw 45.0000 0.0000 0.0000 about 35.0000 0.0000 (of 1)
                2 ccw 55.0000 0.0000 0.0000 about 50.0000 0.0000 (corner before 2)
                3 cw 75.0000 0.0000 0.0000 about 65.0000 0.0000 (of 2)
                3 ccw 80.0000 -5.0000 0.0000 about 80.0000 0.0000 (corner before 3)
                4 Feed 100.0000 -5.0000 0.0000 (of 3)
            "#]],
        );
    }

    #[test]
    fn full_circles_and_helices() {
        tangent(
            right(5.0),
            &[Feed(20.0, 0.0), HelixCcw([20.0, 0.0, -5.0], [20.0, 20.0], 3), Feed(50.0, 0.0), Stop],
            expect![[r#"
                1 Feed 20.0000 -5.0000 0.0000 (of 0)
                2 ccw x3 20.0000 -5.0000 -5.0000 about 20.0000 20.0000 (of 1)
                3 Feed 50.0000 -5.0000 -5.0000 (of 2)
            "#]],
        );
    }

    #[test]
    fn entry_by_an_arc_moves_its_centre() {
        tangent(
            left(5.0),
            &[Ccw([20.0, 20.0], [0.0, 20.0]), Feed(0.0, 20.0), Stop],
            expect![[r#"
                1 ccw 14.3911 15.0000 0.0000 about -5.8333 20.0000 (of 0)
                2 Feed 0.0000 15.0000 0.0000 (of 1)
            "#]],
        );
        tangent(
            left(5.0),
            &[Clockwise([20.0, -20.0], [0.0, -20.0]), Feed(0.0, -40.0), Stop],
            expect![[r#"
                1 cw 25.0000 -20.0000 0.0000 about 4.5000 -20.0000 (of 0)
                1 cw 23.5355 -23.5355 0.0000 about 20.0000 -20.0000 (corner before 1)
                2 Feed 3.5355 -43.5355 0.0000 (of 1)
            "#]],
        );
    }

    #[test]
    fn motion_along_the_normal_waits_beside_the_corner() {
        tangent(
            left(5.0),
            &[
                Feed(20.0, 0.0),
                FeedTo(20.0, 0.0, -5.0),
                Feed(20.0, 30.0),
                RapidTo(20.0, 30.0, 3.0),
                Feed(0.0, 30.0),
                Stop,
            ],
            expect![[r#"
                2 Feed 15.0000 5.0000 0.0000 (of 0)
                2 Feed 15.0000 5.0000 -5.0000 (of 1)
                4 Feed 15.0000 25.0000 -5.0000 (of 2)
                4 Rapid 15.0000 25.0000 3.0000 (of 3)
                5 Feed 0.0000 25.0000 3.0000 (of 4)
            "#]],
        );
        tangent(
            right(5.0),
            &[Feed(20.0, 0.0), FeedTo(20.0, 0.0, -5.0), FeedTo(20.0, 30.0, -7.0), Feed(20.0, 30.0), Stop],
            expect![[r#"
                2 Feed 20.0000 -5.0000 0.0000 (of 0)
                2 Feed 20.0000 -5.0000 -5.0000 (of 1)
                2 ccw 25.0000 0.0000 -5.0000 about 20.0000 0.0000 (corner before 2)
                4 Feed 25.0000 30.0000 -7.0000 (of 2)
                4 Feed 25.0000 30.0000 -7.0000 (of 3)
            "#]],
        );
    }

    #[test]
    fn what_passes_keeps_its_place() {
        tangent(
            left(5.0),
            &[
                Pass("feed 100"),
                Feed(20.0, 0.0),
                Pass("coolant"),
                Pass("dwell"),
                Feed(20.0, 20.0),
                Pass("feed 30"),
                Feed(-10.0, 20.0),
                Feed(-10.0, 50.0),
                Stop,
                Pass("end"),
            ],
            expect![[r#"
                0 feed 100
                4 Feed 15.0000 5.0000 0.0000 (of 1)
                4 coolant
                4 dwell
                6 Feed 15.0000 15.0000 0.0000 (of 4)
                6 feed 30
                7 Feed -10.0000 15.0000 0.0000 (of 6)
                7 cw -15.0000 20.0000 0.0000 about -10.0000 20.0000 (corner before 7)
                8 Feed -15.0000 50.0000 0.0000 (of 7)
                9 end
            "#]],
        );
    }

    #[test]
    fn a_program_stop_fixes_the_end_before_it() {
        tangent(
            left(5.0),
            &[Feed(30.0, 0.0), Flush, Pass("stop"), Feed(30.0, 20.0), Feed(0.0, 20.0), Stop],
            expect![[r#"
                1 Feed 30.0000 5.0000 0.0000 (of 0)
                2 stop
                4 Feed 25.0000 15.0000 0.0000 (of 3)
                5 Feed 0.0000 15.0000 0.0000 (of 4)
            "#]],
        );
        tangent(
            right(5.0),
            &[Feed(30.0, 0.0), Flush, Pass("stop"), Feed(30.0, 20.0), Stop],
            expect![[r#"
                1 Feed 30.0000 -5.0000 0.0000 (of 0)
                2 stop
                3 ccw 35.0000 0.0000 0.0000 about 30.0000 0.0000 (corner before 3)
                4 Feed 35.0000 20.0000 0.0000 (of 3)
            "#]],
        );
        tangent(
            left(5.0),
            &[Feed(30.0, 0.0), Flush, FeedTo(30.0, 0.0, 3.0), Feed(30.0, 20.0), Feed(0.0, 20.0), Stop],
            expect![[r#"
                1 Feed 30.0000 5.0000 0.0000 (of 0)
                3 Feed 25.0000 5.0000 3.0000 (of 2)
                4 Feed 25.0000 15.0000 3.0000 (of 3)
                5 Feed 0.0000 15.0000 3.0000 (of 4)
            "#]],
        );
    }

    #[test]
    fn the_entry_must_be_longer_than_the_radius() {
        tangent(
            left(5.0),
            &[Feed(5.0, 0.0)],
            expect![[r#"
                0 EntryTooShort { needed: 5.0, got: 5.0, arc: false }
            "#]],
        );
        tangent(
            left(5.0),
            &[Feed(5.001, 0.0), Stop],
            expect![[r#"
                1 Feed 5.0010 5.0000 0.0000 (of 0)
            "#]],
        );
        tangent(
            left(5.0),
            &[FeedTo(0.0, 0.0, -5.0)],
            expect![[r#"
                0 EntryTooShort { needed: 5.0, got: 0.0, arc: false }
            "#]],
        );
        tangent(
            left(5.0),
            &[Ccw([1.0, 0.025_015_6], [0.0, 20.0])],
            expect![[r#"
                0 EntryTooShort { needed: 5.0, got: 1.0003128411868758, arc: true }
            "#]],
        );
    }

    #[test]
    fn an_arc_smaller_than_the_tool_is_refused_on_its_inside_only() {
        let steps = [Feed(20.0, 0.0), Ccw([25.0, 5.0], [20.0, 5.0]), Stop];
        tangent(
            left(5.0),
            &steps,
            expect![[r#"
                1 ArcTooSmall { radius: 5.0, tool_radius: 5.0 }
            "#]],
        );
        tangent(
            right(5.0),
            &steps,
            expect![[r#"
                1 Feed 20.0000 -5.0000 0.0000 (of 0)
                2 ccw 30.0000 5.0000 0.0000 about 20.0000 5.0000 (of 1)
            "#]],
        );
    }

    #[test]
    fn a_line_too_short_for_the_tool_is_a_gouge() {
        tangent(
            left(5.0),
            &[Feed(20.0, 0.0), Feed(20.0, 8.0), Feed(0.0, 8.0)],
            expect![[r#"
                1 Feed 15.0000 5.0000 0.0000 (of 0)
                2 Gouge { kind: LineReversed(Feed), corner: [20.0, 8.0] }
            "#]],
        );
        tangent(
            left(5.0),
            &[Rapid(20.0, 0.0), Rapid(20.0, 3.0), Rapid(0.0, 3.0)],
            expect![[r#"
                1 Rapid 15.0000 5.0000 0.0000 (of 0)
                2 Gouge { kind: LineReversed(Rapid), corner: [20.0, 3.0] }
            "#]],
        );
        tangent(
            left(5.0),
            &[Feed(20.0, 0.0), Feed(20.0, 3.0), Stop],
            expect![[r#"
                1 Feed 15.0000 5.0000 0.0000 (of 0)
                2 Gouge { kind: LineReversed(Feed), corner: [20.0, 3.0] }
            "#]],
        );
    }

    #[test]
    fn a_line_just_long_enough_is_none() {
        tangent(
            left(5.0),
            &[Feed(20.0, 0.0), Feed(20.0, 10.0), Feed(0.0, 10.0), Stop],
            expect![[r#"
                1 Feed 15.0000 5.0000 0.0000 (of 0)
                2 Feed 15.0000 5.0000 0.0000 (of 1)
                3 Feed 0.0000 5.0000 0.0000 (of 2)
            "#]],
        );
    }

    #[test]
    fn a_line_run_backwards_is_not_noticed_before_a_smooth_joint() {
        tangent(
            left(5.0),
            &[Feed(40.0, 0.0), Feed(40.0, 3.0), Feed(40.0, 63.0), Stop],
            expect![[r#"
                1 Feed 35.0000 5.0000 0.0000 (of 0)
                2 Feed 35.0000 3.0000 0.0000 (of 1)
                3 Feed 35.0000 63.0000 0.0000 (of 2)
            "#]],
        );
    }

    #[test]
    fn an_arc_too_short_for_the_tool_is_a_gouge() {
        // A tenth of a radian of an arc of radius 20 whose start the inside corner takes away.
        tangent(
            left(5.0),
            &[Feed(20.0, 0.0), Clockwise([20.0999, 1.9967], [40.0, 0.0]), Feed(0.0, 10.0)],
            expect![[r#"
                1 Feed 15.5051 5.0000 0.0000 (of 0)
                2 Gouge { kind: ArcReversed, corner: [20.0999, 1.9967] }
            "#]],
        );
    }

    #[test]
    fn corners_where_the_offsets_do_not_meet_are_gouges() {
        // Into an arc of radius 6, turned left by 60 degrees.
        let into_arc = [Feed(20.0, 0.0), Ccw([17.0, 9.0], [14.803_85, 3.0])];
        tangent(
            left(5.0),
            &into_arc,
            expect![[r#"
                1 Gouge { kind: LineIntoArc, corner: [20.0, 0.0] }
            "#]],
        );
        // Out of an arc of radius 6 that ends upward, turned left by 60 degrees.
        let out_of_arc = [Feed(20.0, 0.0), Ccw([26.0, 6.0], [20.0, 6.0]), Feed(0.0, 21.0)];
        tangent(
            left(5.0),
            &out_of_arc,
            expect![[r#"
                1 Feed 20.0000 5.0000 0.0000 (of 0)
                2 Gouge { kind: ArcIntoLine, corner: [26.0, 6.0] }
            "#]],
        );
        let between =
            [Feed(20.0, 0.0), Ccw([26.0, 6.0], [20.0, 6.0]), Ccw([17.803_85, 3.803_85], [23.0, 0.803_85])];
        tangent(
            left(5.0),
            &between,
            expect![[r#"
                1 Feed 20.0000 5.0000 0.0000 (of 0)
                2 Gouge { kind: ArcIntoArc, corner: [26.0, 6.0] }
            "#]],
        );
        let back = [Feed(20.0, 0.0), Ccw([40.0, 20.0], [20.0, 20.0]), Clockwise([20.0, 0.0], [20.0, 20.0])];
        tangent(
            left(5.0),
            &back,
            expect![[r#"
                1 Feed 20.0000 5.0000 0.0000 (of 0)
                2 Gouge { kind: SameCentre, corner: [40.0, 20.0] }
            "#]],
        );
    }

    #[test]
    fn turning_back_onto_an_arc_is_an_outside_corner_when_the_tool_is_inside_the_arc() {
        let steps = [Feed(120.0, 0.0), Ccw([100.0, -20.0], [120.0, -20.0]), Stop];
        tangent(
            left(5.0),
            &steps,
            expect![[r#"
                1 Feed 120.0000 5.0000 0.0000 (of 0)
                1 cw 120.0000 -5.0000 0.0000 about 120.0000 0.0000 (corner before 1)
                2 ccw 105.0000 -20.0000 0.0000 about 120.0000 -20.0000 (of 1)
            "#]],
        );
        tangent(
            right(5.0),
            &steps,
            expect![[r#"
                1 Feed 100.0000 -5.0000 0.0000 (of 0)
                2 ccw 95.0000 -20.0000 0.0000 about 120.0000 -20.0000 (of 1)
            "#]],
        );
    }

    #[test]
    fn an_arc_whose_ends_lie_at_different_distances_counts_from_its_end() {
        tangent(
            right(5.0),
            &[
                Feed(11.663, 0.0),
                Ccw([25.16, 2.068], [14.496, 26.594]),
                Ccw([4.451, 15.115], [31.116, 34.481]),
                Stop,
            ],
            expect![[r#"
                1 Feed 11.4089 -4.9996 0.0000 (of 0)
                2 ccw 25.7403 -3.0919 0.0000 about 14.4960 26.5940 (of 1)
                3 ccw 0.4054 12.1768 0.0000 about 31.1160 34.4810 (of 2)
            "#]],
        );
    }

    #[test]
    fn a_nose_orientation_shifts_every_point() {
        // The plane of a lathe: first axis Z, second axis X.
        let nose = left(5.0).with_tip([1, -1]);
        tangent(
            nose,
            &[Feed(20.0, 0.0), Feed(20.0, 20.0), Clockwise([40.0, 40.0], [40.0, 20.0]), Stop],
            expect![[r#"
                1 Feed 20.0000 0.0000 0.0000 (of 0)
                2 Feed 20.0000 15.0000 0.0000 (of 1)
                3 cw 45.0000 40.0000 0.0000 about 45.0000 15.0000 (of 2)
            "#]],
        );
    }

    #[test]
    fn the_tool_leaves_from_beside_the_last_point() {
        let mut compensator: Compensator<()> = Compensator::new(CompensationConfig::tangent_entry());
        compensator.start(right(5.0), PathPoint::new(0.0, 0.0, 0.0)).unwrap();
        compensator.line(PathPoint::new(30.0, 0.0, 2.0), LineKind::Feed, (), |_| ()).unwrap();
        assert_eq!(compensator.position(), PathPoint::new(30.0, -5.0, 2.0));
        let exit = compensator.stop(|_| ()).unwrap();
        assert_eq!(exit.position, PathPoint::new(30.0, -5.0, 2.0));
        assert_eq!(exit.programmed, PathPoint::new(30.0, 0.0, 2.0));
        assert_eq!(compensator.exit_motion(true), Err(CompensationError::ExitIsArc));
        assert_eq!(compensator.exit_motion(true), Ok(()));
    }

    #[test]
    fn compensation_may_come_again_before_any_motion() {
        let mut compensator: Compensator<usize> = Compensator::new(CompensationConfig::tangent_entry());
        let mut segments = Vec::new();
        let mut note = |event| {
            if let OffsetEvent::Programmed { segment, .. } = event {
                segments.push(segment);
            }
        };
        compensator.start(right(5.0), PathPoint::new(0.0, 0.0, 0.0)).unwrap();
        compensator.line(PathPoint::new(20.0, 0.0, 0.0), LineKind::Feed, 0, &mut note).unwrap();
        let exit = compensator.stop(&mut note).unwrap();
        compensator.start(left(5.0), exit.programmed).unwrap();
        compensator.line(PathPoint::new(40.0, 0.0, 0.0), LineKind::Feed, 1, &mut note).unwrap();
        compensator.line(PathPoint::new(40.0, 20.0, 0.0), LineKind::Feed, 2, &mut note).unwrap();
        assert_eq!(segments[1].start, PathPoint::new(20.0, -5.0, 0.0));
        assert_eq!(segments[1].end, PathPoint::new(35.0, 5.0, 0.0));

        compensator.stop(|_| ()).unwrap();
        compensator.start(left(5.0), PathPoint::new(40.0, 20.0, 0.0)).unwrap();
        let arc = compensator.arc(PathPoint::new(60.0, 40.0, 0.0), [40.0, 40.0], true, 1, 3, |_| ());
        assert_eq!(arc, Err(CompensationError::ExitIsArc));
    }

    #[test]
    fn without_an_offset_motion_any_exit_is_good() {
        for (cutter, moves) in [(left(5.0), false), (left(0.0), true)] {
            let mut compensator: Compensator<()> = Compensator::new(CompensationConfig::tangent_entry());
            compensator.start(cutter, PathPoint::new(0.0, 0.0, 0.0)).unwrap();
            if moves {
                compensator.line(PathPoint::new(30.0, 0.0, 2.0), LineKind::Feed, (), |_| ()).unwrap();
            }
            compensator.stop(|_| ()).unwrap();
            assert_eq!(compensator.exit_motion(true), Ok(()));
        }
    }
}

mod intersection {
    use super::*;

    #[test]
    fn the_entry_ends_beside_the_start_of_the_next_segment() {
        sharp(
            left(5.0),
            &[Feed(20.0, 0.0), Feed(20.0, 30.0), Feed(50.0, 30.0), Stop],
            expect![[r#"
                1 Feed 15.0000 0.0000 0.0000 (of 0)
                2 Feed 15.0000 35.0000 0.0000 (of 1)
                3 Feed 50.0000 35.0000 0.0000 (of 2)
            "#]],
        );
    }

    #[test]
    fn the_entry_may_be_shorter_than_the_radius() {
        sharp(
            left(5.0),
            &[Feed(3.0, 0.0), Feed(3.0, 30.0), Stop],
            expect![[r#"
                1 Feed -2.0000 0.0000 0.0000 (of 0)
                2 Feed -2.0000 30.0000 0.0000 (of 1)
            "#]],
        );
    }

    #[test]
    fn outside_corners_up_to_the_limit_are_intersections() {
        let steps = [Feed(10.0, 0.0), Feed(30.0, 0.0), Feed(50.0, 20.0), Feed(30.0, 40.0), Stop];
        sharp(
            right(5.0),
            &steps,
            expect![[r#"
                1 Feed 10.0000 -5.0000 0.0000 (of 0)
                2 Feed 32.0711 -5.0000 0.0000 (of 1)
                3 Feed 57.0711 20.0000 0.0000 (of 2)
                4 Feed 33.5355 43.5355 0.0000 (of 3)
            "#]],
        );
    }

    #[test]
    fn sharper_outside_corners_have_a_line_across() {
        let steps = [Feed(10.0, 0.0), Feed(30.0, 0.0), Feed(10.0, 20.0), Stop];
        sharp(
            right(5.0),
            &steps,
            expect![[r#"
                1 Feed 10.0000 -5.0000 0.0000 (of 0)
                2 Feed 35.0000 -5.0000 0.0000 (of 1)
                2 Feed 37.0711 0.0000 0.0000 (corner before 2)
                3 Feed 13.5355 23.5355 0.0000 (of 2)
            "#]],
        );
        let back = [Feed(10.0, 0.0), Feed(30.0, 0.0), Feed(10.0, 0.0), Stop];
        sharp(
            right(5.0),
            &back,
            expect![[r#"
                1 Feed 10.0000 -5.0000 0.0000 (of 0)
                2 Feed 35.0000 -5.0000 0.0000 (of 1)
                2 Feed 35.0000 5.0000 0.0000 (corner before 2)
                3 Feed 10.0000 5.0000 0.0000 (of 2)
            "#]],
        );
    }

    #[test]
    fn outside_corners_of_arcs_are_bridged_by_lines() {
        let steps = [Feed(10.0, 0.0), Feed(20.0, 0.0), Ccw([0.0, 20.0], [0.0, 0.0]), Feed(0.0, 50.0), Stop];
        sharp(
            right(5.0),
            &steps,
            expect![[r#"
                1 Feed 10.0000 -5.0000 0.0000 (of 0)
                2 Feed 25.0000 -5.0000 0.0000 (of 1)
                2 Feed 25.0000 0.0000 0.0000 (corner before 2)
                3 ccw 5.0000 24.4949 0.0000 about 0.0000 0.0000 (of 2)
                4 Feed 5.0000 50.0000 0.0000 (of 3)
            "#]],
        );
        // The arc sets out backwards, at 135 degrees to the line.
        let acute = [
            Feed(10.0, 0.0),
            Feed(20.0, 0.0),
            Ccw([-8.284_27, 0.0], [5.857_86, -14.142_14]),
            Feed(-28.284_27, -20.0),
            Stop,
        ];
        sharp(
            right(5.0),
            &acute,
            expect![[r#"
                1 Feed 10.0000 -5.0000 0.0000 (of 0)
                2 Feed 25.0000 -5.0000 0.0000 (of 1)
                2 Feed 27.0711 0.0000 0.0000 (corner before 2)
                2 Feed 23.5355 3.5355 0.0000 (corner before 2)
                3 ccw -11.8198 3.5355 0.0000 about 5.8579 -14.1421 (of 2)
                4 Feed -31.8198 -16.4645 0.0000 (of 3)
            "#]],
        );
    }

    #[test]
    fn joints_that_rounding_has_bent_are_smooth() {
        let steps = [
            Feed(10.0, 0.0),
            Feed(20.0, 0.0),
            Ccw([30.0, 10.001], [20.001, 10.0]),
            Ccw([10.0, 30.0], [10.0, 10.001]),
            Stop,
        ];
        sharp(
            left(5.0),
            &steps,
            expect![[r#"
                1 Feed 10.0000 5.0000 0.0000 (of 0)
                2 Feed 20.0000 5.0000 0.0000 (of 1)
                3 ccw 25.0000 10.0005 0.0000 about 20.0010 10.0000 (of 2)
                4 ccw 10.0000 25.0000 0.0000 about 10.0000 10.0010 (of 3)
            "#]],
        );
    }

    #[test]
    fn inside_corners_are_intersections() {
        let steps =
            [Feed(10.0, 0.0), Feed(30.0, 0.0), Feed(30.0, 20.0), Ccw([10.0, 40.0], [10.0, 20.0]), Stop];
        sharp(
            left(5.0),
            &steps,
            expect![[r#"
                1 Feed 10.0000 5.0000 0.0000 (of 0)
                2 Feed 25.0000 5.0000 0.0000 (of 1)
                3 Feed 25.0000 20.0000 0.0000 (of 2)
                4 ccw 10.0000 35.0000 0.0000 about 10.0000 20.0000 (of 3)
            "#]],
        );
        let arc = [Feed(10.0, 0.0), Feed(30.0, 0.0), Ccw([10.0, 20.0], [10.0, 0.0]), Feed(-10.0, 20.0), Stop];
        sharp(
            left(5.0),
            &arc,
            expect![[r#"
                1 Feed 10.0000 5.0000 0.0000 (of 0)
                2 Feed 24.1421 5.0000 0.0000 (of 1)
                3 ccw 10.0000 15.0000 0.0000 about 10.0000 0.0000 (of 2)
                4 Feed -10.0000 15.0000 0.0000 (of 3)
            "#]],
        );
    }

    #[test]
    fn inside_an_arc_of_its_own_radius_the_tool_stays() {
        let into_the_bore = [
            Feed(5.0, -5.0),
            Ccw([10.0, 0.0], [5.0, 0.0]),
            Ccw([10.0, 0.0], [0.0, 0.0]),
            Ccw([5.0, 5.0], [5.0, 0.0]),
            Stop,
        ];
        sharp(
            left(5.0),
            &into_the_bore,
            expect![[r#"
                1 Feed 5.0000 0.0000 0.0000 (of 0)
                2 ccw 5.0000 0.0000 0.0000 about 5.0000 0.0000 (of 1)
                3 ccw 5.0000 0.0000 0.0000 about 0.0000 0.0000 (of 2)
                4 ccw 5.0000 0.0000 0.0000 about 5.0000 0.0000 (of 3)
            "#]],
        );
    }

    #[test]
    fn gouges_are_found() {
        let channel = [Feed(10.0, 0.0), Feed(30.0, 0.0), Feed(30.0, 8.0), Feed(10.0, 8.0)];
        sharp(
            left(5.0),
            &channel,
            expect![[r#"
                1 Feed 10.0000 5.0000 0.0000 (of 0)
                2 Feed 25.0000 5.0000 0.0000 (of 1)
                3 Gouge { kind: LineReversed(Feed), corner: [30.0, 8.0] }
            "#]],
        );
        let last = [Feed(10.0, 0.0), Feed(30.0, 0.0), Feed(30.0, 3.0), Stop];
        sharp(
            left(5.0),
            &last,
            expect![[r#"
                1 Feed 10.0000 5.0000 0.0000 (of 0)
                2 Feed 25.0000 5.0000 0.0000 (of 1)
                3 Gouge { kind: LineReversed(Feed), corner: [30.0, 3.0] }
            "#]],
        );
        let arc = [Feed(10.0, 0.0), Feed(20.0, 0.0), Clockwise([20.0999, 1.9967], [40.0, 0.0]), Stop];
        sharp(
            left(5.0),
            &arc,
            expect![[r#"
                1 Feed 10.0000 5.0000 0.0000 (of 0)
                2 Feed 15.5051 5.0000 0.0000 (of 1)
                3 Gouge { kind: ArcReversed, corner: [20.0999, 1.9967] }
            "#]],
        );
        let small = [Feed(10.0, 0.0), Feed(30.0, 0.0), Ccw([34.0, 4.0], [30.0, 4.0])];
        sharp(
            left(5.0),
            &small,
            expect![[r#"
                1 Feed 10.0000 5.0000 0.0000 (of 0)
                2 ArcTooSmall { radius: 4.0, tool_radius: 5.0 }
            "#]],
        );
    }

    #[test]
    fn entry_by_an_arc_is_refused() {
        sharp(
            left(5.0),
            &[Ccw([20.0, 20.0], [0.0, 20.0])],
            expect![[r#"
                0 EntryIsArc
            "#]],
        );
    }

    #[test]
    fn motion_along_the_normal_may_come_before_the_entry() {
        sharp(
            left(5.0),
            &[FeedTo(0.0, 0.0, -5.0), Feed(20.0, 0.0), FeedTo(20.0, 0.0, -8.0), Feed(20.0, 30.0), Stop],
            expect![[r#"
                0 Feed 0.0000 0.0000 -5.0000 (of 0)
                3 Feed 15.0000 0.0000 -5.0000 (of 1)
                3 Feed 15.0000 0.0000 -8.0000 (of 2)
                4 Feed 15.0000 30.0000 -8.0000 (of 3)
            "#]],
        );
    }

    #[test]
    fn the_exit_starts_beside_the_last_end() {
        let mut compensator: Compensator<()> = Compensator::new(CompensationConfig::intersection());
        compensator.start(right(5.0), PathPoint::new(0.0, 0.0, 0.0)).unwrap();
        compensator.line(PathPoint::new(30.0, 0.0, 0.0), LineKind::Feed, (), |_| ()).unwrap();
        compensator.line(PathPoint::new(30.0, 20.0, 0.0), LineKind::Feed, (), |_| ()).unwrap();
        let exit = compensator.stop(|_| ()).unwrap();
        assert_eq!(exit.position, PathPoint::new(35.0, 20.0, 0.0));
        assert_eq!(compensator.exit_motion(true), Err(CompensationError::ExitIsArc));
    }
}

mod both_styles {
    use super::*;

    #[test]
    fn compensation_is_switched_on_once() {
        let mut compensator: Compensator<()> = Compensator::new(CompensationConfig::intersection());
        let start = PathPoint::new(0.0, 0.0, 0.0);
        assert_eq!(compensator.line(start, LineKind::Feed, (), |_| ()), Err(CompensationError::NotOn));
        compensator.start(left(1.0), start).unwrap();
        assert_eq!(compensator.start(left(1.0), start), Err(CompensationError::AlreadyOn));
        assert!(compensator.is_on());
    }

    #[test]
    fn unknown_numbers_are_errors_not_paths() {
        let start = PathPoint::new(0.0, 0.0, 0.0);
        for config in [CompensationConfig::tangent_entry(), CompensationConfig::intersection()] {
            let mut compensator: Compensator<()> = Compensator::new(config);
            assert_eq!(compensator.start(left(f64::NAN), start), Err(CompensationError::NotUsable));
            compensator.start(left(1.0), start).unwrap();
            let unknown = PathPoint::new(f64::NAN, 0.0, 0.0);
            assert_eq!(
                compensator.line(unknown, LineKind::Feed, (), |_| ()),
                Err(CompensationError::NotUsable)
            );
            assert!(!compensator.is_on());
        }
    }

    #[test]
    fn an_error_drops_what_was_held_back() {
        let mut compensator: Compensator<()> = Compensator::new(CompensationConfig::tangent_entry());
        compensator.start(left(5.0), PathPoint::new(0.0, 0.0, 0.0)).unwrap();
        compensator.line(PathPoint::new(20.0, 0.0, 0.0), LineKind::Feed, (), |_| ()).unwrap();
        let end = PathPoint::new(24.0, 4.0, 0.0);
        let error = compensator.arc(end, [20.0, 4.0], true, 1, (), |_| ()).unwrap_err();
        assert_eq!(error, CompensationError::ArcTooSmall { radius: 4.0, tool_radius: 5.0 });
        assert!(!compensator.is_waiting());
        assert_eq!(compensator.position(), PathPoint::new(0.0, 0.0, 0.0));
    }

    fn coordinate() -> impl Strategy<Value = f64> {
        prop_oneof![
            6 => -50.0..50.0f64,
            2 => (-5..5i32).prop_map(|number| f64::from(number) * 10.0),
            1 => prop_oneof![Just(0.0), Just(1e-9), Just(1e300), Just(-1e300), Just(f64::NAN), Just(f64::INFINITY)],
        ]
    }

    fn step() -> impl Strategy<Value = Step> {
        let point = || (coordinate(), coordinate());
        prop_oneof![
            point().prop_map(|(x, y)| Feed(x, y)),
            point().prop_map(|(x, y)| Rapid(x, y)),
            (point(), coordinate()).prop_map(|((x, y), z)| FeedTo(x, y, z)),
            (point(), point()).prop_map(|((x, y), (i, j))| Clockwise([x, y], [i, j])),
            (point(), point()).prop_map(|((x, y), (i, j))| Ccw([x, y], [i, j])),
            Just(Pass("event")),
            Just(Flush),
            Just(Stop),
        ]
    }

    proptest! {
        #[test]
        fn nothing_panics_and_segments_join(
            steps in prop::collection::vec(step(), 0..12),
            radius in coordinate(),
            tangent in any::<bool>(),
        ) {
            let config = if tangent {
                CompensationConfig::tangent_entry()
            } else {
                CompensationConfig::intersection()
            };
            let mut compensator = Compensator::new(config);
            let mut at = PathPoint::new(0.0, 0.0, 0.0);
            let mut joined = true;
            for (index, step) in steps.into_iter().enumerate() {
                if !compensator.is_on() {
                    let _ = compensator.start(left(radius), PathPoint::new(1.0, 2.0, 3.0));
                    at = compensator.position();
                }
                let _ = apply(&mut compensator, index, step, |event| {
                    if let OffsetEvent::Programmed { segment, .. } | OffsetEvent::Inserted { segment, .. } = event {
                        joined &= segment.start == at;
                        at = segment.end;
                    }
                });
            }
            prop_assert!(joined);
        }

        /// Round a convex polygon on its outside, the tool never comes nearer than its radius.
        #[test]
        fn the_tool_keeps_its_distance_from_a_convex_polygon(
            corners in 3..9u32,
            size in 5.0..100.0f64,
            radius in 0.1..30.0f64,
            stretch in 0.3..1.0f64,
            tangent in any::<bool>(),
        ) {
            let config = if tangent {
                CompensationConfig::tangent_entry()
            } else {
                CompensationConfig::intersection()
            };
            let corner = |index: u32| {
                let angle = std::f64::consts::TAU * f64::from(index) / f64::from(corners);
                (size * angle.cos() + 200.0, size * stretch * angle.sin() + 200.0)
            };
            let polygon: Vec<(f64, f64)> = (0..=corners).map(corner).collect();
            let mut compensator: Compensator<usize> = Compensator::new(config);
            // Counter-clockwise with the tool on the right; the entry goes on into the polygon's own direction.
            let (x, y) = corner(0);
            let (from_x, from_y) = corner(corners - 1);
            let back = 2.0 * radius / (x - from_x).hypot(y - from_y);
            let start = PathPoint::new(x + (from_x - x) * back, y + (from_y - y) * back, 0.0);
            compensator.start(right(radius), start).unwrap();
            let mut segments: Vec<OffsetSegment> = Vec::new();
            for (index, (x, y)) in polygon.iter().enumerate() {
                compensator
                    .line(PathPoint::new(*x, *y, 0.0), LineKind::Feed, index, |event| {
                        if let OffsetEvent::Programmed { segment, .. } | OffsetEvent::Inserted { segment, .. } = event {
                            segments.push(segment);
                        }
                    })
                    .unwrap();
            }
            compensator
                .stop(|event| {
                    if let OffsetEvent::Programmed { segment, .. } | OffsetEvent::Inserted { segment, .. } = event {
                        segments.push(segment);
                    }
                })
                .unwrap();
            for segment in segments.iter().skip(1) {
                for point in samples(segment) {
                    let distance = polygon
                        .windows(2)
                        .map(|edge| distance_to_edge(point, edge[0], edge[1]))
                        .fold(f64::INFINITY, f64::min);
                    prop_assert!(distance >= radius - 1e-6, "{distance} < {radius} at {point:?}");
                }
            }
        }
    }

    fn samples(segment: &OffsetSegment) -> Vec<(f64, f64)> {
        let (start, end) = (segment.start, segment.end);
        (0..=20)
            .map(|step| {
                let part = f64::from(step) / 20.0;
                match segment.course {
                    OffsetCourse::Line(_) => (
                        start.first + (end.first - start.first) * part,
                        start.second + (end.second - start.second) * part,
                    ),
                    OffsetCourse::Arc { centre: [x, y], ccw, .. } => {
                        let from = (start.second - y).atan2(start.first - x);
                        let to = (end.second - y).atan2(end.first - x);
                        let turn = std::f64::consts::TAU;
                        let swept =
                            if ccw { (to - from).rem_euclid(turn) } else { -(from - to).rem_euclid(turn) };
                        let radius = (start.first - x).hypot(start.second - y);
                        let angle = from + swept * part;
                        (x + radius * angle.cos(), y + radius * angle.sin())
                    }
                }
            })
            .collect()
    }

    fn distance_to_edge((x, y): (f64, f64), (ax, ay): (f64, f64), (bx, by): (f64, f64)) -> f64 {
        let (dx, dy) = (bx - ax, by - ay);
        let part = (((x - ax) * dx + (y - ay) * dy) / (dx * dx + dy * dy)).clamp(0.0, 1.0);
        (x - ax - dx * part).hypot(y - ay - dy * part)
    }
}

#[test]
fn errors_say_what_is_wrong() {
    let corner = [20.0, 3.0];
    let gouge = CompensationError::Gouge { kind: GougeKind::LineReversed(LineKind::Feed), corner };
    assert_eq!(gouge.to_string(), "the line is too short for the tool at (20.0000, 3.0000)");
    let entry = CompensationError::EntryTooShort { needed: 5.0, got: 4.0, arc: false };
    assert_eq!(
        entry.to_string(),
        "the entry move is 4.0000 mm; it must be longer than the tool's radius of 5.0000 mm"
    );
    assert_eq!(CompensationConfig::intersection().style, CompensationStyle::Intersection);
}
