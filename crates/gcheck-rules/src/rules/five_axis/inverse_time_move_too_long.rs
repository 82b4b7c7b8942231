//! A cut under inverse time that is far longer than the one before it, in the same time.

use gcheck_engine::{Abstract, At, Axis, Domain, Event, FeedMode, Position, TravelKind};
use gcheck_geometry::Mm;

use crate::declare::declare_rule;
use crate::{PathCx, PathRule, Report, Run, Uses, Watch};
use crate::{Remembers, remembers};

declare_rule! {
    /// Under inverse time a cut is at least eight times as long as the one before it, or turns as much farther, and has about the
    /// same `F`: so it is to be done in about the same time.
    ///
    /// ## Why it matters
    /// `F` says how long the block takes. A post-processor gives a longer block a smaller `F`, so the tool keeps its speed. A
    /// point or a digit that is wrong in one coordinate sweeps the head through the part at many times the speed of the cut.
    ///
    /// ## Reported
    /// ```nc,reported,haas-mill
    /// G20 G90 G0 X1.25 Y0. Z2.2 A-14.8 B8.
    /// G93 G1 X1.2412 Z2.1034 A-14.8 B8.1 F42.
    /// X1.2178 Z2.0812 A-14.2 B8.6 F38.
    /// X12.193 Z2.0621 A-13.5 B9.1 F38.
    /// G94
    /// M30
    /// ```
    /// ## Not reported
    /// ```nc,quiet,haas-mill
    /// G20 G90 G0 X1.25 Y0. Z2.2 A-14.8 B8.
    /// G93 G1 X1.2412 Z2.1034 A-14.8 B8.1 F42.
    /// X1.2178 Z2.0812 A-14.2 B8.6 F38.
    /// X4.193 Z2.0621 A-13.5 B9.1 F2.
    /// G94
    /// M30
    /// ```
    rule "inverse-time-move-too-long" in "five_axis" {
        summary: "cut under inverse time far longer than the one before it",
        severity: Warning,
        tier: Path,
        since: "0.1.0",
        run: Run::Path { watch: Watch::MOVES, make: || Box::new(InverseTimeMoveTooLong::default()) },
    }
}

/// So many times as long, at least.
const TIMES: f64 = 8.0;
/// Times of one and the other that differ by no more than this factor are about the same.
const ALIKE: f64 = 2.0;
/// A shorter move harms nothing: millimetres, degrees.
const LEAST: f64 = 5.0;
/// A cut before is taken for no shorter than this, so that a short one makes none suspicious: millimetres, degrees.
const FLOOR: f64 = 0.2;

#[derive(Default, Clone, PartialEq)]
struct InverseTimeMoveTooLong {
    /// The cut before, if nothing else was since: its ways and its `F`.
    before: Option<(Ways, f64)>,
    told: Option<At>,
}

remembers!(InverseTimeMoveTooLong: told);

impl PathRule for InverseTimeMoveTooLong {
    fn memory(&mut self) -> Remembers<'_> {
        Remembers::All(self)
    }

    fn concerns(&self, program: &Uses<'_>) -> bool {
        program.may(|effect| effect == gcheck_controls::Effect::FeedInverseTime)
    }

    fn moved(&mut self, cx: &PathCx<'_>, event: &Event, report: &mut Report<'_>) {
        let before = self.before.take();
        let Event::Travel(travel) = event else { return };
        let is_cut = travel.kind == TravelKind::Feed && !travel.expanded;
        if !is_cut || cx.state().feed_mode(cx.model) != Some(FeedMode::InverseTime) {
            return;
        }
        let Some(feed) = Abstract::known(cx.state().feed()).filter(|feed| *feed > 0.0) else { return };
        let now = Ways::of(&travel.from, &travel.to);
        if now.linear.is_nan() {
            return;
        }
        self.before = Some((now, feed));
        let Some((last, last_feed)) = before else { return };
        let is_in_same_time = feed / last_feed < ALIKE && last_feed / feed < ALIKE;
        let is_long = |now: f64, last: f64| now > LEAST && now > TIMES * last.max(FLOOR);
        let (is_far, is_wide) = (is_long(now.linear, last.linear), is_long(now.turned, last.turned));
        if !is_in_same_time || !(is_far || is_wide) || self.told == Some(cx.origin().at) {
            return;
        }
        self.told = Some(cx.origin().at);
        let (what, was) = if is_far {
            (cx.shown(Mm(now.linear)), cx.shown(Mm(last.linear)))
        } else {
            (format!("{:.1}°", now.turned), format!("{:.1}°", last.turned))
        };
        report.add(
            cx.finding(&META, cx.range(), format!("cut of {what} in the time of one of {was} (`F`)"))
                .label(format!("takes {:.1} s, as `F` says", 60.0 / feed))
                .help("check the coordinates for a digit or a point in the wrong place, or make `F` smaller"),
        );
    }
}

/// How far a move goes.
#[derive(Clone, Copy, PartialEq)]
struct Ways {
    /// Of the linear axes together, millimetres; NaN where a place is not known.
    linear: f64,
    /// Of the rotary axis that turns most, degrees.
    turned: f64,
}

impl Ways {
    fn of(from: &Position, to: &Position) -> Self {
        let way = |axis: Axis| to.raw(axis) - from.raw(axis);
        let turned = Axis::ALL.into_iter().filter(|axis| axis.is_rotary()).map(|axis| way(axis).abs());
        Self {
            linear: way(Axis::X).hypot(way(Axis::Y)).hypot(way(Axis::Z)),
            turned: turned.filter(|way| !way.is_nan()).fold(0.0, f64::max),
        }
    }
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::check_rule;

    #[test]
    fn a_head_that_swings() {
        let program = |b: &str| {
            format!("G21 G90 G0 X0. Y0. Z9. A0. B8.\nG93 G1 X1. B8.5 F40.\nX2. B{b} F38.\nX3. B9.5 F38.\nG94\nM30\n")
        };
        check_rule(&RULE, "haas-mill", &program("9."), &expect![[""]]);
        check_rule(&RULE, "haas-mill", &program("90."), &expect![[""]]);
    }
}
