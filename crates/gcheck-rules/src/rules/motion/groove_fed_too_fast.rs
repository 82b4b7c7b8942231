//! A groove that is cut faster than any grooving insert takes.

use gcheck_controls::{Effect, Letter};
use gcheck_engine::{Abstract, At, Domain, Event, Fact, FeedMode, TravelKind};
use gcheck_geometry::Mm;

use crate::declare::declare_rule;
use crate::facts::parting::Parting;
use crate::facts::tool_words::ToolWords;
use crate::facts::turned::{Turned, end};
use crate::facts::turning::is_turned;
use crate::facts::units;
use crate::{MakeShared, PathCx, PathRule, Remembers, Report, Run, Uses, Watch, remembers};

declare_rule! {
    /// A tool of a lathe plunges straight across into a diameter that the program turned, by itself or in a cycle (`G75`), or parts
    /// off what was turned, at more than 0.5 mm (0.02 inch) per turn. Back to the bottom of a groove that is cut already, any feed
    /// is right.
    ///
    /// ## Why it matters
    /// Grooving and parting inserts take a fifth of that; the insert breaks, and often its holder. Mostly a zero is missing
    /// (`F0.8` for `F0.08`), or the feed of the tool before still holds.
    ///
    /// ## Reported
    /// ```nc,reported,fanuc-lathe
    /// G21 G18 G99 T0101
    /// G97 S800 M3
    /// G0 X44. Z2.
    /// X38.
    /// G1 Z-60. F.2
    /// G0 X44.
    /// Z50.
    /// T0303
    /// G0 X42. Z-30.
    /// G1 X26. F.8
    /// G0 X42.
    /// X100. Z50.
    /// M30
    /// ```
    /// ## Not reported
    /// ```nc,quiet,fanuc-lathe
    /// G21 G18 G99 T0101
    /// G97 S800 M3
    /// G0 X44. Z2.
    /// X38.
    /// G1 Z-60. F.2
    /// G0 X44.
    /// Z50.
    /// T0303
    /// G0 X42. Z-30.
    /// G1 X26. F.08
    /// G0 X42.
    /// X100. Z50.
    /// M30
    /// ```
    rule "groove-fed-too-fast" in "motion" {
        summary: "groove or cut-off at more feed than its insert takes",
        severity: Warning,
        tier: Path,
        since: "0.1.0",
        run: Run::Path { watch: Watch::MOVES, make: || Box::new(GrooveFedTooFast::default()) },
    }
}

/// Millimetres per turn. Wide inserts take 0.3.
const MOST: f64 = 0.5;
/// Above this another rule reports the feed of any tool: millimetres per turn.
const OF_NO_TOOL: f64 = 1.4;

#[derive(Default, Clone, PartialEq)]
struct GrooveFedTooFast {
    /// The block whose feed was reported.
    told: Option<At>,
}

remembers!(GrooveFedTooFast: told);

impl PathRule for GrooveFedTooFast {
    fn memory(&mut self) -> Remembers<'_> {
        Remembers::All(self)
    }

    fn shares(&self) -> Option<MakeShared> {
        Some(Turned::shared)
    }

    fn concerns(&self, program: &Uses<'_>) -> bool {
        is_turned(program)
    }

    fn moved(&mut self, cx: &PathCx<'_>, event: &Event, report: &mut Report<'_>) {
        let Some(turned) = Turned::of(cx) else { return };
        let Event::Travel(travel) = event else { return };
        let is_cycle = cx.has_effect(|effect| effect == Effect::GrooveDiameter);
        if travel.kind != TravelKind::Feed || travel.expanded && !is_cycle || !turned.knows(cx) {
            return;
        }
        let state = cx.state();
        let is_fast = |feed: &f64| {
            let [least, _] = units::range(cx, *feed);
            least > MOST && least <= OF_NO_TOOL
        };
        let Some(feed) = Abstract::known(state.feed()).filter(is_fast) else { return };
        if state.feed_mode(cx.model) != Some(FeedMode::PerRevolution) {
            return;
        }
        let to = end(cx, travel);
        // The strokes of a cycle begin inside the wall, all but the first.
        let begins = turned.block_begins(cx).filter(|_| travel.expanded);
        let from = turned.here().map(|[radius, z]| [begins.unwrap_or(radius), z]);
        let is_groove = from.is_some_and(|from| turned.plunges(from, to)) && !turned.is_cut_at(to);
        let is_parting = Parting::of(cx, event).is_some_and(|parting| turned.is_parted(&parting));
        let words = ToolWords::of(cx);
        if !is_groove && !is_parting || words.bores() || words.rolls() || words.needs_no_spindle() {
            return;
        }
        let Some(given) = cx.definitions().set_by(Fact::Feed) else { return };
        if self.told.replace(given) == Some(given) {
            return;
        }
        let what = if is_parting { "the part is cut off" } else { "a groove is cut" };
        let word = cx.find_word(given, |word| word.letter == Letter::of('F'));
        let mut finding = cx
            .finding(
                &META,
                word.clone().unwrap_or_else(|| cx.range()),
                format!("{what} at a feed of {} per turn (`F`)", cx.shown(Mm(feed))),
            )
            .label("more than such an insert takes");
        if word.is_some() && given != cx.origin().at {
            finding = finding.also(cx.range(), "the tool plunges here");
        }
        report.add(finding.help("check the decimal point and the zeros of the number"));
    }
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::check_rule;

    fn program(feed: &str) -> String {
        format!(
            "G21 G18 G99 T0101\nG97 S800 M3\nG0 X44. Z2.\nX38.\nG1 Z-60. F.2\nG0 X44.\nZ50.\nT0303\n{feed}\nG0 X100. Z50.\nM30\n"
        )
    }

    #[test]
    fn a_zero_is_missing_or_the_feed_of_the_tool_before_holds() {
        check_rule(
            &RULE,
            "fanuc-lathe",
            &program("G0 X42. Z-30.\nG1 X26. F.8\nG0 X42."),
            &expect![[r#"
                10 | G1 X26. F.8
                   |         ^^^ warning[groove-fed-too-fast] a groove is cut at a feed of 0.8 mm per turn (`F`)
            "#]],
        );
        check_rule(
            &RULE,
            "fanuc-lathe",
            &program("G0 X42. Z-50.\nG1 X38.5 F.6\nX-.5\nG0 X42."),
            &expect![[r#"
                10 | G1 X38.5 F.6
                   |          ^^^ warning[groove-fed-too-fast] the part is cut off at a feed of 0.6 mm per turn (`F`)
            "#]],
        );
    }

    #[test]
    fn in_pecks() {
        check_rule(
            &RULE,
            "fanuc-lathe",
            &program("G0 X42. Z-30.\nG75 R.5\nG75 X26. P1000 F.8\nG0 X42."),
            &expect![[r#"
                11 | G75 X26. P1000 F.8
                   |                ^^^ warning[groove-fed-too-fast] a groove is cut at a feed of 0.8 mm per turn (`F`)
            "#]],
        );
    }

    #[test]
    fn a_rough_face_below_zero() {
        check_rule(
            &RULE,
            "fanuc-lathe",
            "G21 G18 G99 T0101\nG50 S3000\nG96 S250 M3\nG0 X84. Z-4.\nG1 X-1.6 F.55\nG0 Z1.\nX78.\nG1 Z-60. F.4\nG0 X84.\nX150. Z50.\nM30\n",
            &expect![[""]],
        );
    }

    #[test]
    fn units_that_the_program_does_not_state() {
        check_rule(
            &RULE,
            "haas-lathe",
            "G99 T101\nG97 S800 M3\nG0 X44. Z2.\nX38.\nG1 Z-60. F.15\nG0 X44.\nZ50.\nT303\nG0 X42. Z-30.\nG1 X26. F.05\nG0 X42.\nX150. Z50.\nM30\n",
            &expect![[""]],
        );
    }

    #[test]
    fn as_inserts_take_it() {
        for feed in [
            "G0 X42. Z-30.\nG1 X26. F.1\nG0 X42.",
            // Out of the groove.
            "G0 X42. Z-30.\nG1 X26. F.1\nX42. F1.\nG0 Z50.",
            // Per minute.
            "G98\nG0 X42. Z-30.\nG1 X26. F1.2\nG0 X42.\nG99",
            // A finishing pass along the part.
            "G0 X36. Z2.\nG1 Z-40. F.6\nG0 X44.",
            // Back to the bottom of the groove.
            "G0 X42. Z-30.\nG1 X34. F.1\nG0 X42.\nG1 X34.2 F1.\nX26. F.1\nX42. F1.",
            "G0 X42. Z-30.\nG75 R.5\nG75 X26. P2000 F.08\nG0 X42.",
            // A face at the end of the part.
            "G0 X42. Z-1.\nG1 X-1.6 F.6\nG0 Z2.",
        ] {
            check_rule(&RULE, "fanuc-lathe", &program(feed), &expect![[""]]);
        }
    }
}
