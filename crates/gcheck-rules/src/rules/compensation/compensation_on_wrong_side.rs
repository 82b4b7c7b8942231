//! A cutter that is compensated to the other side of a closed contour than the one from which it comes.

use gcheck_controls::{Effect, Machine};
use gcheck_engine::{ArcMove, At, Axis, Event, Fact, Position, Role, Spindle, TravelKind};
use gcheck_geometry::{Arc, ArcDirection, ArcTolerance, Mm, Plane};

use crate::declare::declare_rule;
use crate::facts::arcs::by_its_words;
use crate::facts::compensation::{is_left, is_on};
use crate::facts::cuts::distance;
use crate::{PathCx, PathRule, Report, Run, Uses, Watch};
use crate::{Remembers, remembers};

declare_rule! {
    /// The tool comes to a closed contour from its outside and is compensated to its inside (`G41`, `G42`), or the other way. Or it comes
    /// from the right side, and the move that switches compensation off leads over the finished contour, at the depth of it.
    ///
    /// ## Why it matters
    /// The tool crosses the contour on its way in, and cuts the part too small, or the pocket too large, by its own diameter.
    /// Mostly `G41` and `G42` are mixed up, or the contour was turned round.
    ///
    /// ## Reported
    /// ```nc,reported,fanuc-mill
    /// G21 G17 G90 G94 G54 S3000 M3
    /// G0 X-20. Y-20. Z-2.
    /// G42 D1 G1 X0. Y-10. F300.
    /// Y40.
    /// X80.
    /// Y0.
    /// X-10.
    /// G40 X-20. Y-20.
    /// G0 Z50.
    /// M30
    /// ```
    /// ## Not reported
    /// ```nc,quiet,fanuc-mill
    /// G21 G17 G90 G94 G54 S3000 M3
    /// G0 X-20. Y-20. Z-2.
    /// G41 D1 G1 X0. Y-10. F300.
    /// Y40.
    /// X80.
    /// Y0.
    /// X-10.
    /// G40 X-20. Y-20.
    /// G0 Z50.
    /// M30
    /// ```
    rule "compensation-on-wrong-side" in "compensation" {
        summary: "compensation to the wrong side of a closed contour",
        severity: Warning,
        tier: Path,
        since: "0.1.0",
        run: Run::Path { watch: Watch::MOVES, make: || Box::new(CompensationOnWrongSide::default()) },
    }
}

#[derive(Default, Clone, PartialEq)]
struct CompensationOnWrongSide {
    /// Where the last move ends as it is programmed, if that is known.
    at: Option<Vector>,
    contour: Option<Contour>,
    /// A contour that is done, whose way out comes next.
    done: Option<Contour>,
    told: Option<At>,
}

remembers!(CompensationOnWrongSide: contour, done, told);

/// A point in the XY plane: millimetres.
type Vector = [f64; 2];

/// What is cut between the block that switches compensation on and the one that switches it off.
#[derive(Debug, Clone, PartialEq)]
struct Contour {
    on: At,
    is_left: bool,
    /// Where the tool was before; `None` for a contour that is not judged.
    from: Option<Vector>,
    /// The height at which it is cut: millimetres.
    height: f64,
    points: Vec<Vector>,
    /// Where it began: millimetres.
    top: f64,
    /// It goes down in turns: the tool comes above what it cuts, and leaves at the depth of it.
    winds_down: bool,
    /// The tool has left it at rapid, or upward.
    is_over: bool,
}

remembers!(Contour: on);

/// Longer contours come from a system.
const MOST: usize = 400;
/// Parts of a path that are nearer than this meet: millimetres.
const MEET: f64 = 0.2;
/// A tool nearer to the contour than this is on neither side, and a height that differs by more is another one: millimetres.
const NEAR: f64 = 0.5;
/// A smaller contour has no inside that a tool comes from: square millimetres.
const SMALL: f64 = 25.0;
/// An arc is looked at in so many pieces.
const PIECES: u32 = 12;

/// A move as this rule sees it.
struct Way {
    points: Vec<Vector>,
    height: f64,
    is_rapid: bool,
    is_arc: bool,
}

impl PathRule for CompensationOnWrongSide {
    fn memory(&mut self) -> Remembers<'_> {
        Remembers::All(self)
    }

    fn concerns(&self, program: &Uses<'_>) -> bool {
        program.may(is_on) && program.environment.control().machine() == Machine::Mill
    }

    fn moved(&mut self, cx: &PathCx<'_>, event: &Event, report: &mut Report<'_>) {
        if !cx.is_mill() {
            cx.enough();
            return;
        }
        let is_known = cx.is_certain();
        if !is_known || cx.state().plane(cx.model) != Some(Plane::Xy) {
            *self = Self { told: self.told, ..Self::default() };
            return;
        }
        let from = self.at.take();
        let way = way(cx, event, from);
        self.at = end(event);
        let side = is_left(cx);
        let on = cx.definitions().set_by(Fact::Mode(Role::Compensation));
        let is_way_out = cx.has_effect(|effect| effect == Effect::CompensationOff);
        if let Some(contour) = self.done.take().filter(|_| is_way_out && side.is_none()) {
            self.judge(cx, &contour, way.as_ref().filter(|way| !way.is_arc), report);
        }
        let is_same = |contour: &Contour| Some(contour.on) == on && side == Some(contour.is_left);
        if !self.contour.as_ref().is_some_and(is_same)
            && let Some(mut contour) = self.contour.take()
        {
            // Beside a cutter of a known size a move is made when the next block is read: the last one comes after
            // compensation is off.
            if !is_way_out && contour.loop_of().is_none() {
                contour.goes(way.as_ref());
            }
            let way_out = way.as_ref().filter(|_| is_way_out).filter(|way| !way.is_arc);
            self.judge(cx, &contour, way_out, report);
            self.done = Some(contour).filter(|_| !is_way_out);
        }
        let (Some(is_left), Some(on)) = (side, on) else { return };
        let contour = self.contour.get_or_insert_with(|| Contour {
            on,
            is_left,
            // At rapid the tool comes in the air.
            from: from.filter(|_| way.as_ref().is_some_and(|way| !way.is_rapid)),
            height: way.as_ref().map_or(f64::INFINITY, |way| way.height),
            top: way.as_ref().map_or(f64::INFINITY, |way| way.height),
            points: Vec::new(),
            winds_down: false,
            is_over: false,
        });
        contour.goes(way.as_ref());
    }
}

impl CompensationOnWrongSide {
    fn judge(&mut self, cx: &PathCx<'_>, contour: &Contour, way_out: Option<&Way>, report: &mut Report<'_>) {
        if self.told == Some(contour.on) {
            return;
        }
        let outside = if contour.winds_down { contour.points.last().copied() } else { contour.from };
        let (Some(beside), Some(around)) = (outside.filter(|_| contour.from.is_some()), contour.loop_of())
        else {
            return;
        };
        let away = edges(&around).map(|edge| from_edge(beside, edge)).fold(f64::INFINITY, f64::min);
        if away <= NEAR {
            return;
        }
        // Counter-clockwise, the inside is on the left.
        let to_inside = contour.is_left == (area(&around) > 0.0);
        let is_inside = goes_around(&around, beside);
        if to_inside == is_inside {
            // A beam is off on its way out; what cuts turns, and is below the zero of the part.
            let cuts = contour.height < -NEAR && cx.state().spindle().is_some_and(Spindle::turns);
            let over = way_out.filter(|way| cuts && crosses(contour, &around, to_inside, way));
            if let Some(way) = over {
                self.told = Some(contour.on);
                over_contour(cx, contour, to_inside, way, report);
            }
            return;
        }
        self.told = Some(contour.on);
        let range = cx.find_word(contour.on, |word| is_on(cx.model.effect(word.code)));
        let Some(range) = range.or_else(|| cx.range_of(contour.on)) else { return };
        let name = cx.place_of(contour.on).and_then(|place| {
            let words = place.table.words(place.block()).iter();
            words.map(|word| word.code).find(|code| is_on(cx.model.effect(*code)))
        });
        let name = name.map(|code| format!(" (`{}`)", cx.name_of(code))).unwrap_or_default();
        let (there, goes) = if is_inside { ("inside", "outside") } else { ("outside", "inside") };
        let (way, moves) = if contour.winds_down { ("out", "leaves to the") } else { ("in", "comes from") };
        report.add(
            cx.finding(
                &META,
                range,
                format!("compensation to the {goes}, but the tool {moves} {there}{name}"),
            )
            .label(format!("on its way {way} the tool crosses the closed contour"))
            .help(
                "check `G41` and `G42`, the direction of the contour, and the signs of the centres of its arcs (`I`, `J`)",
            ),
        );
    }
}

impl Contour {
    /// The next move; `None` for one that is not known.
    fn goes(&mut self, way: Option<&Way>) {
        let Some(way) = way.filter(|_| self.points.len() <= MOST) else {
            self.from = None;
            return;
        };
        // A thread or a bore is milled in turns that rise or go down.
        if way.is_arc && way.height.is_finite() && !self.is_over && (way.height - self.height).abs() > 0.0 {
            self.winds_down |= way.height < self.top - NEAR;
            self.height = way.height;
        }
        // False for a height that is not known.
        self.is_over |= !self.points.is_empty() && (way.is_rapid || way.height > self.height + NEAR);
        if self.is_over {
            return;
        }
        if way.height < self.height - NEAR {
            // The tool came above what it cuts.
            self.from = None;
        }
        self.points.extend(&way.points);
    }

    /// The part of the path that goes around something, from where it first comes back to itself: without the ways in and out.
    fn loop_of(&self) -> Option<Vec<Vector>> {
        let points = &self.points;
        let edge = |index: usize| Some([*points.get(index)?, *points.get(index + 1)?]);
        let count = points.len().saturating_sub(1);
        (0..count).find_map(|first| {
            let others = (first + 2..count).rev();
            others.into_iter().find_map(|last| {
                if !meet(edge(first)?, edge(last)?) {
                    return None;
                }
                let mut around = points.get(first + 1..=last)?.to_vec();
                around.push(meeting(edge(first)?, edge(last)?));
                (area(&around).abs() > SMALL).then_some(around)
            })
        })
    }
}

/// Does the way out end on the other side of the contour than the one on which the cutter goes around it, at the depth of it?
fn crosses(contour: &Contour, around: &[Vector], is_inside: bool, way: &Way) -> bool {
    let Some(end) = way.points.last().copied() else { return false };
    let away = edges(around).map(|edge| from_edge(end, edge)).fold(f64::INFINITY, f64::min);
    let is_level = (way.height - contour.height).abs() <= NEAR;
    is_level
        && !contour.is_over
        && !contour.winds_down
        && away > NEAR
        && goes_around(around, end) != is_inside
}

/// The way out leads over the finished contour.
fn over_contour(cx: &PathCx<'_>, contour: &Contour, is_inside: bool, way: &Way, report: &mut Report<'_>) {
    let side = if is_inside { "outside" } else { "inside" };
    let moves = if way.is_rapid { "at rapid" } else { "at feed" };
    let mut finding = cx
        .finding(&META, cx.range(), format!("the way out leads over the finished contour, to its {side}"))
        .label(format!("crosses the contour {moves}, at the depth of it"));
    if let Some(range) = cx.range_of(contour.on) {
        finding = finding.also(range, "the contour begins here");
    }
    report.add(finding.help("lead out to the side from which the tool came, or lift the tool first"));
}

/// A move of the contour; `None` for one that is not known.
fn way(cx: &PathCx<'_>, event: &Event, from: Option<Vector>) -> Option<Way> {
    match event {
        Event::Travel(travel) if !travel.expanded => Some(Way {
            points: vec![end(event)?],
            height: travel.programmed.raw(Axis::Z),
            is_rapid: travel.kind == TravelKind::Rapid,
            is_arc: false,
        }),
        Event::Arc(arc) if !arc.expanded => {
            let (points, height) = (pieces(cx, arc, from)?, arc.programmed.raw(Axis::Z));
            Some(Way { points, height, is_rapid: false, is_arc: true })
        }
        // Around a corner the tool stays at it.
        Event::Travel(_) | Event::Arc(_) => {
            Some(Way { points: vec![from?], height: f64::NAN, is_rapid: false, is_arc: false })
        }
        _ => None,
    }
}

/// Where a move ends as it is programmed, if that is known.
fn end(event: &Event) -> Option<Vector> {
    let end = match event {
        Event::Travel(travel) => flat(&travel.programmed),
        Event::Arc(arc) => flat(&arc.programmed),
        _ => return None,
    };
    end.iter().all(|number| number.is_finite()).then_some(end)
}

fn flat(position: &Position) -> Vector {
    [position.raw(Axis::X), position.raw(Axis::Y)]
}

/// Points along an arc as it is programmed, its end the last; `None` where they are not known.
fn pieces(cx: &PathCx<'_>, arc: &ArcMove, from: Option<Vector>) -> Option<Vec<Vector>> {
    let ends = [from?, flat(&arc.programmed)];
    let direction = if arc.turns < 0 { ArcDirection::Cw } else { ArcDirection::Ccw };
    let in_space = |[x, y]: Vector| [Mm(x), Mm(y), Mm::ZERO];
    let is_known = arc.sweep.is_finite() && arc.centre.0.0.is_finite() && arc.centre.1.0.is_finite();
    let whole = if is_known {
        let [start, end] = ends.map(in_space);
        Arc::by_centre(Plane::Xy, start, end, arc.centre, direction, 1, &ArcTolerance::ANY).ok()
    } else {
        by_its_words(cx, ends, direction)
    };
    let whole = whole.filter(|_| arc.plane == Plane::Xy && arc.turns.abs() == 1)?;
    let at = |piece: u32| {
        let [x, y, _] = whole.point_at(f64::from(piece) / f64::from(PIECES));
        [x.0, y.0]
    };
    Some((1..=PIECES).map(at).collect())
}

/// The edges of a polygon, closed.
fn edges(points: &[Vector]) -> impl Iterator<Item = [Vector; 2]> {
    let next = points.iter().skip(1).chain(points.first());
    points.iter().zip(next).map(|(a, b)| [*a, *b])
}

/// Above zero counter-clockwise.
fn area(points: &[Vector]) -> f64 {
    edges(points).map(|[a, b]| (a[0] * b[1] - b[0] * a[1]) / 2.0).sum()
}

/// How far a point is from an edge.
fn from_edge(point: Vector, [a, b]: [Vector; 2]) -> f64 {
    let along = [b[0] - a[0], b[1] - a[1]];
    let square = along[0] * along[0] + along[1] * along[1];
    let share = if square > 0.0 {
        (((point[0] - a[0]) * along[0] + (point[1] - a[1]) * along[1]) / square).clamp(0.0, 1.0)
    } else {
        0.0
    };
    distance(point, [a[0] + share * along[0], a[1] + share * along[1]])
}

/// Do two edges cross, or come as near as parts that meet?
fn meet(one: [Vector; 2], other: [Vector; 2]) -> bool {
    let side = |[a, b]: [Vector; 2], point: Vector| {
        (b[0] - a[0]) * (point[1] - a[1]) - (b[1] - a[1]) * (point[0] - a[0])
    };
    let parts = |edge: [Vector; 2], [a, b]: [Vector; 2]| side(edge, a) * side(edge, b) < 0.0;
    let is_near =
        |edge: [Vector; 2], ends: [Vector; 2]| ends.into_iter().any(|end| from_edge(end, edge) < MEET);
    parts(one, other) && parts(other, one) || is_near(one, other) || is_near(other, one)
}

/// Where two edges that meet do so.
fn meeting([a, b]: [Vector; 2], [c, d]: [Vector; 2]) -> Vector {
    let (along, across) = ([b[0] - a[0], b[1] - a[1]], [d[0] - c[0], d[1] - c[1]]);
    let cross = along[0] * across[1] - along[1] * across[0];
    // Edges in one direction meet end to end.
    if cross.abs() < 1e-9 {
        return b;
    }
    let share = (((c[0] - a[0]) * across[1] - (c[1] - a[1]) * across[0]) / cross).clamp(0.0, 1.0);
    [a[0] + share * along[0], a[1] + share * along[1]]
}

/// Does the polygon go around the point, once or more often?
fn goes_around(points: &[Vector], point: Vector) -> bool {
    let turns = edges(points).map(|[a, b]| {
        let is_right = point[0] < a[0] + (point[1] - a[1]) / (b[1] - a[1]) * (b[0] - a[0]);
        match (a[1] > point[1], b[1] > point[1]) {
            (false, true) if is_right => 1,
            (true, false) if is_right => -1,
            _ => 0,
        }
    });
    turns.sum::<i32>() != 0
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::{World, check_rule, check_rule_in};

    fn program(from: &str, side: &str, contour: &str) -> String {
        format!(
            "G21 G17 G90 G94 G54 S3000 M3\nG0 {from} Z-2.\n{side} D1 G1 {contour}G40 {from}\nG0 Z50.\nM30\n"
        )
    }

    /// A pocket with round corners, counter-clockwise from the middle of its lower wall.
    const POCKET: &str = "X40. Y0. F300.\nX70.\nG3 X80. Y10. R10.\nG1 Y40.\nG3 X70. Y50. R10.\nG1 X10.\nG3 X0. Y40. R10.\nG1 Y10.\nG3 X10. Y0. R10.\nG1 X40.\nG1 ";

    #[test]
    fn a_pocket_is_milled_from_its_inside() {
        check_rule(&RULE, "fanuc-mill", &program("X40. Y25.", "G41", POCKET), &expect![[""]]);
        check_rule(
            &RULE,
            "fanuc-mill",
            &program("X40. Y25.", "G42", POCKET),
            &expect![[r#"
                3 | G42 D1 G1 X40. Y0. F300.
                  | ^^^ warning[compensation-on-wrong-side] compensation to the outside, but the tool comes from inside (`G42`)
            "#]],
        );
        check_rule(
            &RULE,
            "fanuc-mill",
            &program("X40. Y-25.", "G41", POCKET),
            &expect![[r#"
                3 | G41 D1 G1 X40. Y0. F300.
                  | ^^^ warning[compensation-on-wrong-side] compensation to the inside, but the tool comes from outside (`G41`)
            "#]],
        );
        check_rule(&RULE, "fanuc-mill", &program("X40. Y-25.", "G42", POCKET), &expect![[""]]);
    }

    #[test]
    fn the_way_out_over_the_contour() {
        let outline = |out: &str| {
            format!(
                "G21 G17 G90 G94 G54 S3000 M3\nG0 X-20. Y-20. Z-5.\nG41 D1 G1 X0. F300.\nY60.\nX80.\nY0.\nX-20.\n{out}\nG0 Z50.\nM30\n"
            )
        };
        check_rule(
            &RULE,
            "fanuc-mill",
            &outline("G40 X20. Y20."),
            &expect![[r#"
                8 | G40 X20. Y20.
                  | ^^^^^^^^^^^^^ warning[compensation-on-wrong-side] the way out leads over the finished contour, to its inside
            "#]],
        );
        let sized = |out: &str| outline(out).replacen("G21", "T1 M6\nG21", 1);
        let world = World::of_group("machine");
        check_rule_in(
            &RULE,
            "fanuc-mill",
            &sized("G40 X20. Y20."),
            &world,
            &expect![[r#"
                9 | G40 X20. Y20.
                  | ^^^^^^^^^^^^^ warning[compensation-on-wrong-side] the way out leads over the finished contour, to its inside
            "#]],
        );
        check_rule_in(&RULE, "fanuc-mill", &sized("G40 X-40. Y20."), &world, &expect![[""]]);
        // A beam that is off, and one that works at the zero of the sheet.
        for beam in [outline("M5\nG40 X20. Y20."), outline("G40 X20. Y20.").replace("Z-5.", "Z0.")] {
            check_rule(&RULE, "fanuc-mill", &beam, &expect![[""]]);
        }
        for out in ["G40 Y-20.", "G40 X-40. Y20.", "G0 Z5.\nG40 X20. Y20.", "G40 G0 X20. Y20. Z5."] {
            check_rule(&RULE, "fanuc-mill", &outline(out), &expect![[""]]);
        }
        let pocket = program("X40. Y25.", "G41", POCKET);
        let out = |place: &str| pocket.replace("G40 X40. Y25.", &format!("G40 {place}"));
        check_rule(&RULE, "fanuc-mill", &out("X45. Y20."), &expect![[""]]);
        check_rule(
            &RULE,
            "fanuc-mill",
            &out("X40. Y-25."),
            &expect![[r#"
                13 | G1 G40 X40. Y-25.
                   | ^^^^^^^^^^^^^^^^^ warning[compensation-on-wrong-side] the way out leads over the finished contour, to its outside
            "#]],
        );
    }

    #[test]
    fn beside_a_cutter_of_a_known_size() {
        let outline = "X0. Y-10. F300.\nY40.\nX80.\nY0.\nX-10.\n";
        check_rule_in(
            &RULE,
            "fanuc-mill",
            &program("X-20. Y-20.", "T1 M6\nG41", outline),
            &World::of_group("machine"),
            &expect![[""]],
        );
        check_rule_in(
            &RULE,
            "fanuc-mill",
            &program("X-20. Y-20.", "T1 M6\nG42", outline),
            &World::of_group("machine"),
            &expect![[r#"
                4 | G42 D1 G1 X0. Y-10. F300.
                  | ^^^ warning[compensation-on-wrong-side] compensation to the inside, but the tool comes from outside (`G42`)
            "#]],
        );
    }

    #[test]
    fn going_round_twice_and_over_the_start_is_going_round() {
        let world = World::of_group("machine");
        let quiet = |from: &str, contour: &str| {
            let text = program(from, "T1 M6\nG41", contour);
            check_rule_in(&RULE, "fanuc-mill", &text, &world, &expect![[""]]);
        };
        quiet("X0. Y0.", "X30. Y0. F300.\nG3 I-30.\nG3 I-30.\nG1 ");
        let overlap = "X10. Y-10. F300.\nG3 X20. Y0. R10.\nG3 X20. Y0. I-20. J0.\nG3 X19.696 Y3.473 I-20. J0.\nG3 X8.112 Y11.585 R10.\nG1 ";
        quiet("X10. Y0.", overlap);
        check_rule(
            &RULE,
            "fanuc-mill",
            &program("X40. Y25.", "G41", &format!("{POCKET}X70.\n{}", &POCKET[20..])),
            &expect![[""]],
        );
    }

    #[test]
    fn a_slot_that_is_open_at_the_edge_is_no_closed_contour() {
        for (from, contour) in [
            ("X10. Y-20.", "X20. Y-10. F300.\nY100.\nX0.\nY-10.\n"),
            ("X-10. Y0.", "X-5. Y-5. F300.\nX40.\nG3 X40. Y5. R5.\nG1 X-5.\n"),
            ("X20. Y-30.", "X0. Y-10. F300.\nY60.\nX100.\nG0 Z50.\n"),
        ] {
            for side in ["G41", "G42"] {
                check_rule(&RULE, "fanuc-mill", &program(from, side, contour), &expect![[""]]);
            }
        }
    }

    #[test]
    fn turns_of_a_thread_rise() {
        let thread = |side: &str, way: &str| {
            program(
                "X0. Y0.",
                side,
                &format!(
                    "X7.5 Y-7.5 F600.\n{way} X15. Y0. Z-1.625 R7.5\n{way} I-15. Z-.5\n{way} X7.5 Y7.5 Z-.1 R7.5\nG1 "
                ),
            )
        };
        check_rule(&RULE, "fanuc-mill", &thread("G41", "G3"), &expect![[""]]);
        check_rule(
            &RULE,
            "fanuc-mill",
            &thread("G42", "G3"),
            &expect![[r#"
            3 | G42 D1 G1 X7.5 Y-7.5 F600.
              | ^^^ warning[compensation-on-wrong-side] compensation to the outside, but the tool comes from inside (`G42`)
        "#]],
        );
        let outside = "X-15. Y-30. F600.\nG2 X-30. Y0. Z-1.6 R30.\nG2 X-30. Y0. I30. J0. Z-.5\nG2 X-15. Y30. Z-.1 R30.\nG1 ";
        check_rule(&RULE, "fanuc-mill", &program("X-50. Y0.", "G41", outside), &expect![[""]]);
    }

    #[test]
    fn turns_of_a_bore_go_down() {
        let bore = |side: &str| {
            program(
                "X0. Y0.",
                side,
                "X15. Y-15. F600.\nG3 X30. Y0. R15. F300.\nG3 I-30. Z-5.\nG3 I-30. Z-8.\nG3 I-30.\nG3 X15. Y15. R15.\nG1 ",
            )
        };
        check_rule(&RULE, "fanuc-mill", &bore("G41"), &expect![[""]]);
        check_rule(
            &RULE,
            "fanuc-mill",
            &bore("G42"),
            &expect![[r#"
            3 | G42 D1 G1 X15. Y-15. F600.
              | ^^^ warning[compensation-on-wrong-side] compensation to the outside, but the tool leaves to the inside (`G42`)
        "#]],
        );
        // Above a stud the tool may cross it, and leaves beside it.
        let stud = "X-30. Y0. F600.\nG2 X-30. Y0. I30. J0. Z-5.\nG2 X-30. Y0. I30. J0.\nG1 X-30. Y40.\n";
        check_rule(&RULE, "fanuc-mill", &program("X-10. Y0.", "G41", stud), &expect![[""]]);
    }

    #[test]
    fn in_the_air_a_contour_may_be_crossed() {
        let comes_above = "X40. Y0. F300.\nZ-5.\nX70.\nY50.\nX0.\nY0.\nX40.\nG1 ";
        check_rule(&RULE, "fanuc-mill", &program("X40. Y-25.", "G41", comes_above), &expect![[""]]);
        let below = comes_above.replace("Z-5.\n", "");
        check_rule(
            &RULE,
            "fanuc-mill",
            &program("X40. Y-25.", "G41", &below),
            &expect![[r#"
                3 | G41 D1 G1 X40. Y0. F300.
                  | ^^^ warning[compensation-on-wrong-side] compensation to the inside, but the tool comes from outside (`G41`)
            "#]],
        );
    }

    #[test]
    fn an_open_contour_has_no_inside() {
        let open = "X0. Y0. F300.\nX50.\nY50.\nX100.\n";
        for side in ["G41", "G42"] {
            check_rule(&RULE, "fanuc-mill", &program("X-20. Y-20.", side, open), &expect![[""]]);
        }
    }

    #[test]
    fn a_full_circle_counts_by_its_way_round() {
        let world = World::of_group("machine");
        let circle = |way: &str| format!("X30. Y0. F300.\n{way} X30. Y0. I-30. J0.\nG1 ");
        check_rule_in(
            &RULE,
            "fanuc-mill",
            &program("X0. Y0.", "T1 M6\nG41", &circle("G3")),
            &world,
            &expect![[""]],
        );
        check_rule_in(
            &RULE,
            "fanuc-mill",
            &program("X0. Y0.", "T1 M6\nG41", &circle("G2")),
            &world,
            &expect![[r#"
                4 | G41 D1 G1 X30. Y0. F300.
                  | ^^^ warning[compensation-on-wrong-side] compensation to the outside, but the tool comes from inside (`G41`)
            "#]],
        );
    }
}
