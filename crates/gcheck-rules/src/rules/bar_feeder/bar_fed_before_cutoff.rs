//! A bar feed while the part that was turned is still on the bar.

use std::ops::Range;

use gcheck_controls::Effect;
use gcheck_engine::{Axis, Event, Travel, TravelKind};
use gcheck_geometry::Mm;

use crate::declare::declare_rule;
use crate::facts::bar_feed::bar_feeder;
use crate::{PathCx, PathRule, Report, Run, Uses, Watch};
use crate::{Remembers, remembers};

declare_rule! {
    /// The program turns a part and feeds the bar, and has not cut the part off: nothing was cut across the bar on its side of
    /// the chuck.
    ///
    /// ## Why it matters
    /// The part is pushed out with the bar. What comes after it cuts in wrong places, and the piece that is cut off in the end
    /// is too long.
    ///
    /// ## Reported
    /// ```nc,reported,haas-lathe
    /// O1
    /// G20 G99
    /// T101
    /// G97 S800 M3
    /// G0 X0.85 Z0.1
    /// G1 X0.5 F0.006
    /// Z-1.25
    /// G0 X4. Z4.
    /// M5
    /// G105 I2. J1.375 K0.5
    /// M99
    /// ```
    /// ## Not reported
    /// ```nc,quiet,haas-lathe
    /// O1
    /// G20 G99
    /// T101
    /// G97 S800 M3
    /// G0 X0.85 Z0.1
    /// G1 X0.5 F0.006
    /// Z-1.25
    /// G0 X4. Z4.
    /// T404
    /// G0 X0.85 Z-1.375
    /// G1 X-0.03 F0.002
    /// G0 X4.
    /// Z4.
    /// M5
    /// G105 I2. J1.375 K0.5
    /// M99
    /// ```
    /// A bushing is off where the blade comes into its hole.
    /// ```nc,quiet,haas-lathe
    /// O1
    /// G20 G99
    /// T101
    /// G97 S800 M3
    /// G0 X0.94 Z0.1
    /// G1 Z-0.95 F0.01
    /// X1.02
    /// G0 X4. Z4.
    /// T404
    /// G0 X0. Z0.2
    /// G1 Z-1. F0.006
    /// G0 Z4.
    /// T808
    /// G0 X1.1 Z-0.875
    /// G1 X0.45 F0.004
    /// G0 X4.
    /// Z4.
    /// M5
    /// G105 I2. J1. K0.5
    /// M99
    /// ```
    rule "bar-fed-before-cutoff" in "bar_feeder" {
        summary: "bar fed while the turned part is still on it",
        severity: Warning,
        tier: Path,
        since: "0.1.0",
        run: Run::Path {
            watch: Watch::CHANGES.union(Watch::MOVES),
            make: || Box::new(BarFedBeforeCutoff::default()),
        },
    }
}

#[derive(Default, Clone, PartialEq)]
struct BarFedBeforeCutoff {
    /// The deepest cut along the part since it was cut off.
    cut: Option<DeepestCut>,
    /// How deep the hole along the centre is: work coordinate, millimetres.
    hole: f64,
    /// Where the last cut toward the centre began outside all that was turned: work coordinate, millimetres.
    groove: Option<f64>,
}

remembers!(BarFedBeforeCutoff: cut);

#[derive(Clone, PartialEq)]
struct DeepestCut {
    /// Work coordinate, millimetres; below zero.
    z: f64,
    /// Its radius, millimetres.
    x: f64,
    bytes: Range<u32>,
}

remembers!(DeepestCut: bytes);

/// Levels and radii that differ by less are one: millimetres.
const SLACK: f64 = 0.05;
/// No blade that parts off is wider: millimetres.
const BLADE: f64 = 6.0;
/// Nearer to the face of the part, a cut is of the face: millimetres.
const FACE: f64 = 1.0;

impl PathRule for BarFedBeforeCutoff {
    fn memory(&mut self) -> Remembers<'_> {
        Remembers::All(self)
    }

    fn concerns(&self, program: &Uses<'_>) -> bool {
        program.may(|effect| effect == Effect::BarFeed)
    }

    fn moved(&mut self, cx: &PathCx<'_>, event: &Event, _: &mut Report<'_>) {
        let Event::Travel(travel) = event else { return };
        let z = travel.to.raw(Axis::Z);
        if travel.kind != TravelKind::Feed || z > -FACE || z.is_nan() {
            return;
        }
        let (deepest, outside) = self.cut.as_ref().map_or((0.0, 0.0), |cut| (cut.z, cut.x));
        // A tool in a bore begins inside of what was turned; without a hole there is none.
        if goes_in(travel) && (travel.from.raw(Axis::X) >= outside - SLACK || self.hole >= 0.0) {
            self.groove = Some(z);
        }
        let is_in_groove = self.groove.is_some_and(|groove| (groove - z).abs() < SLACK);
        if is_at_centre(travel) {
            self.hole = self.hole.min(z);
        } else if goes_in(travel)
            && (z <= deepest + SLACK
                || z <= deepest + BLADE
                    && (z > self.hole && goes_deep(travel) || is_in_groove && goes_to_centre(travel)))
        {
            // Nearer to the chuck than all that was turned, or at most a blade's width before its end: there to the centre and not
            // from inside a bore, or deep into a part with a hole.
            self.cut = None;
        } else if z < deepest && goes_along(travel) {
            // On its way out of the part a tool goes on into the air.
            let x = travel.from.raw(Axis::X).min(travel.to.raw(Axis::X));
            self.cut = Some(DeepestCut { z, x, bytes: cx.range() });
        }
    }

    fn changed(&mut self, cx: &PathCx<'_>, event: &Event, report: &mut Report<'_>) {
        match event {
            // The part may be taken away, or held elsewhere.
            Event::Chuck(_) | Event::BarLoad | Event::BarUnload(_) => *self = Self::default(),
            Event::BarFeed(_) => {
                self.hole = 0.0;
                let Some(cut) = self.cut.take() else { return };
                if bar_feeder(cx).is_none() || !cx.is_on_every_path() || cx.is_after_unknown_program() {
                    return;
                }
                report.add(
                    cx.finding(&META, cx.range(), "the bar is fed with the turned part still on it")
                        .label("nothing has cut the part off")
                        .also(cut.bytes, format!("turned to Z {} here", cx.shown(Mm(cut.z))))
                        .help("part off before the feed, or name the program that parts off with `P`"),
                );
            }
            _ => {}
        }
    }
}

/// Does it take the part off, whatever its bore is?
fn goes_to_centre(travel: &Travel) -> bool {
    travel.to.raw(Axis::X) < SLACK
}

/// Is it a cut along the part, or one that goes inward, and not the blade on its way out?
fn goes_along(travel: &Travel) -> bool {
    let (from, to) = (&travel.from, &travel.to);
    (from.raw(Axis::Z) - to.raw(Axis::Z)).abs() >= SLACK || to.raw(Axis::X) < from.raw(Axis::X)
}

/// Does it come nearer to the centre than any groove?
fn goes_deep(travel: &Travel) -> bool {
    travel.to.raw(Axis::X) < travel.from.raw(Axis::X) / 2.0
}

/// Does a drill cut, along the centre?
fn is_at_centre(travel: &Travel) -> bool {
    [&travel.from, &travel.to].into_iter().all(|position| position.raw(Axis::X).abs() < SLACK)
}

/// A straight cut in X alone, toward the centre.
fn goes_in(travel: &Travel) -> bool {
    let (from, to) = (&travel.from, &travel.to);
    let is_square = (from.raw(Axis::Z) - to.raw(Axis::Z)).abs() < SLACK;
    is_square && to.raw(Axis::X) < from.raw(Axis::X) - SLACK
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::check_rule;

    /// A part of 0.9 in, drilled as deep or not, with what the blade does at its end.
    fn program(drill: &str, blade: &str) -> String {
        format!(
            "G20 G18 G40 G80 G97 G99\nT101\nG97 S800 M3\nG0 X0.65 Z0.1\nG1 Z-0.9 F0.008\nX0.8\nG0 X4. Z4.\n{drill}T808\nG0 X0.85 Z-0.868\n{blade}G0 X4.\nZ4.\nM5\nG105 J0.9\nM99\n"
        )
    }

    #[test]
    fn the_blade_that_goes_out_at_feed_turns_nothing() {
        let drill = "T404\nG0 X0. Z0.2\nG1 Z-0.95 F0.006\nG0 Z4.\n";
        check_rule(&RULE, "haas-lathe", &program(drill, "G1 X0.3 F0.0025\nX0.9 F0.05\n"), &expect![[""]]);
    }

    #[test]
    fn the_bottom_of_a_bore_is_not_a_cutoff() {
        let drill = "T404\nG0 X0. Z0.2\nG1 Z-0.85 F0.006\nG0 Z4.\n";
        let boring = "G0 X0.4\nG1 X-0.01 F0.003\n";
        check_rule(
            &RULE,
            "haas-lathe",
            &program(drill, boring),
            &expect![[r#"
            19 | G105 J0.9
               | ^^^^^^^^^ warning[bar-fed-before-cutoff] the bar is fed with the turned part still on it
        "#]],
        );
        // A blade begins nearer to the centre than the turning tool ended, in the air beside the part.
        let out = "T101\nG0 X0.65 Z0.1\nG1 Z-0.9 F0.008\nX1.2 Z-0.92\nG0 X4.\nT808\nG0 X1.05 Z-0.868\nG1 X-0.02 F0.0025\n";
        check_rule(&RULE, "haas-lathe", &program("", out), &expect![[""]]);
        // In several strokes from outside it is one.
        let pecks = "G1 X0.4 F0.0025\nG0 X0.5\nG1 X-0.02 F0.0025\n";
        check_rule(&RULE, "haas-lathe", &program("", pecks), &expect![[""]]);
    }

    #[test]
    fn to_the_centre_it_is_off_before_the_end_of_what_was_turned() {
        check_rule(&RULE, "haas-lathe", &program("", "G1 X-0.02 F0.0025\n"), &expect![[""]]);
        check_rule(
            &RULE,
            "haas-lathe",
            &program("", "G1 X0.5 F0.0025\n"),
            &expect![[r#"
            14 | G105 J0.9
               | ^^^^^^^^^ warning[bar-fed-before-cutoff] the bar is fed with the turned part still on it
        "#]],
        );
    }
}
