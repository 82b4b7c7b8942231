//! A full circle whose centre words have the wrong signs: the tool came from where its centre would be with the others.

use std::ops::Range;

use gcheck_controls::Effect;
use gcheck_engine::{ArcMove, Axis, Event, Position, TravelKind};

use crate::declare::declare_rule;
use crate::facts::compensation::is_left;
use crate::facts::cuts::distance;
use crate::{PathCx, PathRule, Report, Run, Uses, Watch};
use crate::{Remembers, remembers};

declare_rule! {
    /// The tool goes from a point straight to the start of a full circle, and back to the point after it, and the point is not
    /// the circle's centre, but the one that it has with the other signs of its centre words.
    ///
    /// ## Why it matters
    /// A bore is milled from its middle, out and back. With a wrong sign of `I` or `J` the circle is as large, and lies on the
    /// other side of the wall: the cutter goes out of the bore through the part.
    ///
    /// ## Reported
    /// ```nc,reported,fanuc-mill
    /// G21 G17 G90 G54 S3000 M3
    /// G0 X0. Y0. Z-2.
    /// G1 X30. F300.
    /// G3 X30. Y0. I30. J0.
    /// G1 X0.
    /// G0 Z50.
    /// M30
    /// ```
    /// ## Not reported
    /// ```nc,quiet,fanuc-mill
    /// G21 G17 G90 G54 S3000 M3
    /// G0 X0. Y0. Z-2.
    /// G1 X30. F300.
    /// G3 X30. Y0. I-30. J0.
    /// G1 X0.
    /// G0 Z50.
    /// M30
    /// ```
    rule "circle-on-far-side" in "arcs" {
        summary: "full circle on the far side of the wall",
        severity: Warning,
        tier: Path,
        since: "0.1.0",
        run: Run::Path { watch: Watch::MOVES, make: || Box::new(CircleOnFarSide::default()) },
    }
}

#[derive(Default, Clone, PartialEq)]
struct CircleOnFarSide {
    /// Where the last straight feed move begins and ends, as it is programmed.
    last: Option<[Position; 2]>,
    at: Option<Position>,
    pending: Option<Pending>,
}

remembers!(CircleOnFarSide: pending);

/// A circle that lies on the far side if the tool goes back.
#[derive(Clone, PartialEq)]
struct Pending {
    bytes: Range<u32>,
    /// Where the tool came from.
    back: Position,
}

remembers!(Pending: bytes);

/// Points that are nearer than this are one: millimetres.
const NEAR: f64 = 0.05;

impl PathRule for CircleOnFarSide {
    fn memory(&mut self) -> Remembers<'_> {
        Remembers::All(self)
    }

    fn concerns(&self, program: &Uses<'_>) -> bool {
        program.may(Effect::is_arc)
    }

    fn moved(&mut self, cx: &PathCx<'_>, event: &Event, report: &mut Report<'_>) {
        let (last, pending, at) = (self.last.take(), self.pending.take(), self.at.take());
        // Of several paths, this move may follow another one.
        if !cx.is_on_every_path() || cx.is_called_only() {
            return;
        }
        match event {
            Event::Travel(travel) if !travel.expanded => {
                self.at = Some(travel.programmed);
                let is_feed = travel.kind == TravelKind::Feed;
                self.last = at.filter(|_| is_feed).map(|from| [from, travel.programmed]);
                if let Some(pending) = pending.filter(|_| is_feed)
                    && is_one(&pending.back, &travel.programmed)
                {
                    report.add(
                        cx.finding(&META, pending.bytes, "the circle lies on the far side of where the tool came from")
                            .label("with the other signs of its centre words, the centre is where the tool came from")
                            .help("check the signs of the centre words (`I`, `J`, `K`)"),
                    );
                }
            }
            Event::Arc(arc) if !arc.expanded => {
                self.at = Some(arc.programmed);
                let from = last.and_then(|last| comes_from_the_mirrored_centre(cx, arc, last));
                self.pending = from.map(|back| Pending { bytes: cx.range(), back });
            }
            _ => {}
        }
    }
}

/// Where the tool came from, if that is the centre of the full circle with the other signs.
fn comes_from_the_mirrored_centre(
    cx: &PathCx<'_>,
    arc: &ArcMove,
    [from, start]: [Position; 2],
) -> Option<Position> {
    let (first, second, _) = arc.plane.axes();
    let [first, second] = [first, second].map(|index| Axis::ALL.get(index).copied());
    let (first, second) = (first?, second?);
    let flat = |position: &Position| [position.raw(first), position.raw(second)];
    let ([from_x, from_y], [x, y], centre) = (flat(&from), flat(&start), [arc.centre.0.0, arc.centre.1.0]);
    let radius = distance([x, y], centre);
    let mirrored = [2.0 * x - centre[0], 2.0 * y - centre[1]];
    // False where a coordinate is not known.
    let is_full =
        arc.turns.abs() == 1 && distance([x, y], flat(&arc.programmed)) < NEAR && radius > NEAR * 10.0;
    // A boss around the zero of the part, or one that compensation goes around on its outside, may have such a way in.
    let is_boss =
        distance(centre, [0.0; 2]) < NEAR || is_left(cx).is_some_and(|left| left != (arc.turns > 0));
    (is_full && !is_boss && distance([from_x, from_y], mirrored) < NEAR).then_some(from)
}

/// Is it the same place across?
fn is_one(a: &Position, b: &Position) -> bool {
    [Axis::X, Axis::Y, Axis::Z].iter().all(|axis| (a.raw(*axis) - b.raw(*axis)).abs() < NEAR)
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::{World, check_rule, check_rule_in};

    fn program(circle: &str, back: &str) -> String {
        format!(
            "G21 G17 G90 G94 G54 S3000 M3\nT1 M6\nG0 X0. Y0. Z-2.\nG41 D1 G1 X30. F300.\n{circle}\nG40 G1 {back}\nG0 Z50.\nM30\n"
        )
    }

    #[test]
    fn a_boss_may_have_a_way_in_as_long_as_its_radius() {
        let boss = "G21 G17 G90 G94 G54 S3000 M3\nG0 X-20. Y0. Z5.\nG1 Z-2. F300.\nX-10.\nG2 X-10. Y0. I10. J0.\nG1 X-20.\nG0 Z50.\nM30\n";
        check_rule(&RULE, "fanuc-mill", boss, &expect![[""]]);
    }

    #[test]
    fn beside_a_cutter_the_programmed_points_count() {
        check_rule_in(
            &RULE,
            "fanuc-mill",
            &program("G3 X30. Y0. I30. J0.", "X0. Y0."),
            &World::of_group("machine"),
            &expect![[r#"
                5 | G3 X30. Y0. I30. J0.
                  | ^^^^^^^^^^^^^^^^^^^^ warning[circle-on-far-side] the circle lies on the far side of where the tool came from
            "#]],
        );
        check_rule(&RULE, "fanuc-mill", &program("G3 X30. Y0. I-30. J0.", "X0. Y0."), &expect![[""]]);
        check_rule(&RULE, "fanuc-mill", &program("G3 X30. Y0. I30. J0.", "X60. Y0."), &expect![[""]]);
    }
}
