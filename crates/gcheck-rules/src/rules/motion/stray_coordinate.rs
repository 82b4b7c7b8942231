//! A point of a path in three or more axes of which one coordinate is far from those before and after it.

use gcheck_engine::{At, Axis, Event, Position, TravelKind};
use gcheck_geometry::Mm;

use crate::declare::declare_rule;
use crate::{Finding, FollowedCx, PathCx, PathRule, Remembers, Report, Run, Watch, remembers};

declare_rule! {
    /// A path is cut in three or more axes. At one of its points all coordinates lie between those of the points before and after it, but one
    /// lies far outside.
    ///
    /// Paths in two axes are not judged: a tip of a letter looks the same. Neither are paths that go to and fro.
    ///
    /// ## Why it matters
    /// The tool goes across the part and back in the time of a short step. A sign is missing, two digits are exchanged, or the point is in the wrong
    /// place.
    ///
    /// ## Reported
    /// ```nc,reported,haas-mill
    /// G21 G90 G54 G0 X0. Y0. S5000 M3
    /// G43 H1 Z5.
    /// G1 Z-1. F300.
    /// X1. Y0.2 Z-1.1
    /// X2. Y0.4 Z-1.2
    /// X3. Y60. Z-1.3
    /// X4. Y0.8 Z-1.4
    /// X5. Y1. Z-1.5
    /// G0 Z50.
    /// M30
    /// ```
    /// ## Not reported
    /// ```nc,quiet,haas-mill
    /// G21 G90 G54 G0 X0. Y0. S5000 M3
    /// G43 H1 Z5.
    /// G1 Z-1. F300.
    /// X1. Y0.2 Z-1.1
    /// X2. Y0.4 Z-1.2
    /// X3. Y0.6 Z-1.3
    /// X4. Y0.8 Z-1.4
    /// X5. Y1. Z-1.5
    /// G0 Z50.
    /// M30
    /// ```
    rule "stray-coordinate" in "motion" {
        summary: "one coordinate of a point is far from its neighbours",
        severity: Warning,
        tier: Path,
        since: "0.1.0",
        run: Run::Path {
            watch: Watch::MOVES.union(Watch::CHANGES).union(Watch::FOLLOWED),
            make: || Box::new(StrayCoordinate::default()),
        },
    }
}

#[derive(Default, Clone, PartialEq)]
struct StrayCoordinate {
    /// Where the last move ended, as programmed.
    last: Option<Position>,
    /// The last move, if it is a long one: its end may be stray.
    long: Option<Long>,
    /// What the next move decides: a path that goes out there again goes to and fro.
    waiting: Option<Waiting>,
    /// The path goes to and fro, and every move of it is long.
    is_to_and_fro: bool,
}

remembers!(StrayCoordinate: long, waiting);

/// A move at feed that is long in some axis.
#[derive(Clone, PartialEq)]
struct Long {
    from: Position,
    at: At,
}

remembers!(Long: at);

/// A point that is stray unless the path goes out to there again.
#[derive(Clone, PartialEq)]
struct Waiting {
    finding: Finding,
    axis: Axis,
    /// The way to it in that axis.
    out: f64,
}

remembers!(Waiting: finding);

/// So many times as far as its neighbours are apart a coordinate is far off.
const TIMES: f64 = 6.0;
/// Nearer coordinates are not far off: millimetres, degrees.
const NEAR: f64 = 1.0;
/// Coordinates that differ by less are one.
const SAME: f64 = 1e-6;

impl PathRule for StrayCoordinate {
    fn memory(&mut self) -> Remembers<'_> {
        Remembers::All(self)
    }

    fn changed(&mut self, _: &PathCx<'_>, event: &Event, report: &mut Report<'_>) {
        // The next point counts from elsewhere.
        if matches!(event, Event::WorkOffset { .. } | Event::Shift(_) | Event::Rotation(_)) {
            self.tell(report);
            (self.last, self.long) = (None, None);
        }
    }

    fn moved(&mut self, cx: &PathCx<'_>, event: &Event, report: &mut Report<'_>) {
        let to = match event {
            Event::Travel(travel) if !travel.expanded => match travel.kind {
                TravelKind::Feed => &travel.programmed,
                // A path may begin where the tool came to at rapid.
                TravelKind::Rapid => {
                    self.tell(report);
                    (self.last, self.long, self.is_to_and_fro) = (Some(travel.programmed), None, false);
                    return;
                }
                _ => &Position::UNKNOWN,
            },
            _ => &Position::UNKNOWN,
        };
        let from = self.last.get_or_insert(Position::UNKNOWN);
        // Hardly any move of a long path is long itself.
        if self.long.is_some() || to.is_apart(from, NEAR) {
            let from = *from;
            self.judge(cx, &from, to, report);
        } else {
            self.tell(report);
            self.is_to_and_fro = false;
        }
        self.last = Some(*to);
        // One stroke of a cycle is as good as many.
        if self.waiting.is_none() && matches!(event, Event::Travel(travel) if travel.expanded) {
            cx.rest();
        }
    }

    fn followed(&mut self, _: &FollowedCx<'_>, report: &mut Report<'_>) {
        self.tell(report);
    }
}

impl StrayCoordinate {
    /// A move at feed that is long, or comes after a long one.
    fn judge(&mut self, cx: &PathCx<'_>, from: &Position, to: &Position, report: &mut Report<'_>) {
        let goes_out_again = |waiting: &mut Waiting| {
            way(waiting.axis, from, to) * waiting.out.signum() > waiting.out.abs() / 2.0
        };
        self.is_to_and_fro |= self.waiting.take_if(goes_out_again).is_some();
        self.tell(report);
        let long = self.long.take();
        let stray =
            long.filter(|_| !self.is_to_and_fro).and_then(|long| Some((stray(&long.from, from, to)?, long)));
        if let Some((axis, long)) = stray {
            let finding = finding(cx, axis, long.at, [&long.from, from, to]);
            self.waiting = Some(Waiting { finding, axis, out: way(axis, &long.from, from) });
        }
        // The next point would look stray beside a stray one; the next move shows whether this one is.
        if to.is_apart(from, NEAR) {
            self.long = Some(Long { from: *from, at: cx.origin().at });
        }
    }

    /// The path has not gone out there again.
    fn tell(&mut self, report: &mut Report<'_>) {
        if let Some(waiting) = self.waiting.take_if(|_| true) {
            report.add(waiting.finding);
        }
    }
}

/// How far an axis goes; one that turns, on the shorter way.
fn way(axis: Axis, from: &Position, to: &Position) -> f64 {
    let way = to.raw(axis) - from.raw(axis);
    if axis.is_rotary() { way - (way / 360.0).round() * 360.0 } else { way }
}

/// The axis in which the middle point alone is far from the other two, which two or more other axes pass on their way.
fn stray(first: &Position, middle: &Position, last: &Position) -> Option<Axis> {
    let mut passed = 0;
    let mut found = None;
    let mut longest: f64 = 0.0;
    for axis in Axis::ALL {
        let [into, out, past] =
            [(first, middle), (middle, last), (first, last)].map(|(a, b)| way(axis, a, b));
        // An axis that the program has not moved yet is nowhere.
        let is_still = into.abs() < SAME && out.abs() < SAME;
        let is_nowhere = [first, middle, last].into_iter().all(|point| point.raw(axis).is_nan());
        if is_still || is_nowhere {
            continue;
        }
        if into.is_nan() || out.is_nan() {
            return None;
        }
        if into * out > 0.0 {
            passed += 1;
            longest = longest.max(past.abs());
        } else if found.is_none() {
            found = Some((axis, into.abs().min(out.abs()), past.abs()));
        } else {
            return None;
        }
    }
    let (axis, off, apart) = found?;
    let is_rotary = axis.is_rotary();
    // Millimetres and degrees are not compared.
    let step = if is_rotary { apart } else { apart.max(longest) };
    (passed >= 2 && off > NEAR && off > step * TIMES).then_some(axis)
}

fn finding(cx: &PathCx<'_>, axis: Axis, at: At, [first, middle, last]: [&Position; 3]) -> Finding {
    let shown = |point: &Position| {
        let value = point.raw(axis);
        if axis.is_rotary() { format!("{value}°") } else { cx.shown(Mm(value)) }
    };
    let name = axis.name();
    let range = cx.range_of(at).unwrap_or_else(|| cx.range());
    cx.finding(&META, range, format!("`{name}` of this point is far from its neighbours"))
        .label(format!(
            "{name} {}, between {name} {} and {name} {}",
            shown(middle),
            shown(first),
            shown(last)
        ))
        .note("all other axes pass from one neighbour to the other")
        .help(format!("check sign, digits and point of `{name}`"))
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::check_rule;

    fn blade(third: &str) -> String {
        format!(
            "G20 G17 G40 G49 G80 G90 G94\nT1 M6\nG0 G90 G54 X1.25 Y-0.4 S8000 M3\nG143 H1 X1.25 Y-0.4 Z3. A0. B0.\nG0 X1.25 Y-0.4 Z2.2 A-14.8 B8.15\nG1 G93 X1.2412 Y-0.3871 Z2.1034 A-14.8 B8.15 F42.\nX1.2178 Y-0.3624 Z2.0812 A-14.2 B8.6 F38.\n{third} F38.\nX1.1544 Y-0.3102 Z2.0377 A-12.7 B9.7 F36.\nG94\nG0 X1.1544 Y-0.3102 Z3. A-12.7 B9.7\nM30\n"
        )
    }

    #[test]
    fn five_axes() {
        check_rule(&RULE, "haas-mill", &blade("X1.1903 Y-0.3415 Z2.0621 A-13.5 B9.1"), &expect![[""]]);
        check_rule(
            &RULE,
            "haas-mill",
            &blade("X1.9103 Y-0.3415 Z2.0621 A-13.5 B9.1"),
            &expect![[r#"
            8 | X1.9103 Y-0.3415 Z2.0621 A-13.5 B9.1 F38.
              | ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^ warning[stray-coordinate] `X` of this point is far from its neighbours
        "#]],
        );
        check_rule(
            &RULE,
            "haas-mill",
            &blade("X1.1903 Y-0.3415 Z2.0621 A13.5 B9.1"),
            &expect![[r#"
            8 | X1.1903 Y-0.3415 Z2.0621 A13.5 B9.1 F38.
              | ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^ warning[stray-coordinate] `A` of this point is far from its neighbours
        "#]],
        );
    }

    fn path(points: &str) -> String {
        format!("G21 G90 G54 G0 X0. Y0. A0. S5000 M3\nG43 H1 Z25.\nG1 Z0. F300.\n{points}G0 Z50.\nM30\n")
    }

    #[test]
    fn paths_go_to_and_fro() {
        for points in [
            "X1. Y30. Z-0.2\nX2. Y0. Z-0.4\nX3. Y30. Z-0.6\nX4. Y0. Z-0.8\n",
            "X0.5 Z20.1 A180.\nX1. Z20.2 A0.\nX1.5 Z20.3 A180.\nX2. Z20.4 A0.\n",
            "X1. Z-0.1 A359.\nX2. Z-0.2 A0.5\nX3. Z-0.3 A359.8\nX4. Z-0.4 A1.\n",
            "X1. Y1. Z-0.1\nX2. Y2. Z-0.2\nG52 Y-50.\nX3. Y53. Z-0.3\nG52 Y0.\nX4. Y4. Z-0.4\n",
        ] {
            check_rule(&RULE, "haas-mill", &path(points), &expect![[""]]);
        }
    }

    #[test]
    fn letters_have_tips() {
        check_rule(
            &RULE,
            "haas-mill",
            "G21 G90 G54 G0 X0. Y0. S5000 M3\nG43 H1 Z5.\nG1 Z-1. F300.\nX1. Y0.2\nX2. Y60.\nX3. Y0.3\nX4. Y0.4\nG0 Z50.\nM30\n",
            &expect![[""]],
        );
    }
}
