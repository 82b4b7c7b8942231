//! Turning where the part was cut off.

use gcheck_controls::{Effect, LetterSet};
use gcheck_engine::{At, Event, Fact, TravelKind};

use crate::declare::declare_rule;
use crate::facts::lasting::calls_elsewhere;
use crate::facts::live_tool::builders_since;
use crate::facts::parting::{Along, Parting};
use crate::facts::second_spindle::has_second_spindle;
use crate::facts::tool_words::ToolWords;
use crate::facts::turned::{Spot, Turned, end, is_other_part, spot};
use crate::facts::turning::{is_turned, turns_the_part};
use crate::{MakeShared, PathCx, PathRule, Remembers, Report, Run, Uses, Watch, remembers};

declare_rule! {
    /// A tool of a lathe turns a part that the program has turned and then cut off, with nothing between: no bar feed, no stop, no
    /// chuck, no other work offset, no M code of the machine builder, no program of another file. Programs with codes for a
    /// second spindle are not judged: it may have taken the part over.
    ///
    /// ## Why it matters
    /// The part is gone. The tool cuts air, or runs at rapid into the bar if the bar was fed by hand.
    ///
    /// ## Reported
    /// ```nc,reported,fanuc-lathe
    /// G21 G99 T0101
    /// G97 S800 M3
    /// G0 X38. Z2.
    /// G1 Z-35. F.2
    /// G0 X100. Z100.
    /// T1010 (PART OFF)
    /// G0 X42. Z-33.
    /// G1 X-.5 F.08
    /// G0 X100.
    /// Z100.
    /// T0303
    /// G0 X37. Z2.
    /// G1 Z-20. F.1
    /// G0 X100. Z100.
    /// M30
    /// ```
    /// ## Not reported
    /// ```nc,quiet,fanuc-lathe
    /// G21 G99 T0101
    /// G97 S800 M3
    /// G0 X38. Z2.
    /// G1 Z-35. F.2
    /// G0 X100. Z100.
    /// T1010 (PART OFF)
    /// G0 X42. Z-33.
    /// G1 X-.5 F.08
    /// G0 X100.
    /// Z100.
    /// M0 (PULL THE BAR)
    /// T0303
    /// G0 X37. Z2.
    /// G1 Z-20. F.1
    /// G0 X100. Z100.
    /// M30
    /// ```
    rule "turned-after-cut-off" in "motion" {
        summary: "part turned after it was cut off",
        severity: Warning,
        tier: Path,
        since: "0.1.0",
        run: Run::Path {
            watch: Watch::MOVES.union(Watch::CHANGES).union(Watch::BLOCKS),
            make: || Box::new(TurnedAfterCutOff::default()),
        },
    }
}

#[derive(Clone, PartialEq)]
struct TurnedAfterCutOff {
    turned: Along,
    /// The cut that took it off, with the tool that made it.
    off: Option<(Parting, Option<At>)>,
}

remembers!(TurnedAfterCutOff: off);

/// The shortest cut along the part that counts: millimetres.
const SHORT: f64 = 3.0;
/// Levels that differ by less are one: millimetres.
const SLACK: f64 = 0.1;

impl PathRule for TurnedAfterCutOff {
    fn memory(&mut self) -> Remembers<'_> {
        Remembers::All(self)
    }

    fn shares(&self) -> Option<MakeShared> {
        Some(Turned::shared)
    }

    fn concerns(&self, program: &Uses<'_>) -> bool {
        is_turned(program) && !has_second_spindle(program)
    }

    fn block(&mut self, cx: &PathCx<'_>, _: &mut Report<'_>) {
        // What a shift by increments does is not in the positions.
        let shifts = cx.has_effect(|effect| effect == Effect::SpeedLimitOrSetPosition)
            && cx.origin().letters.intersects(LetterSet::of("XZUW"));
        // What a program of another file does is not shown, and it may feed the bar.
        let here = cx.range();
        let leaves_file = || calls_elsewhere(cx.file_index).any(|at| here.contains(&at));
        if shifts || self.off.is_some() && leaves_file() {
            self.forget();
        }
    }

    fn changed(&mut self, cx: &PathCx<'_>, event: &Event, _: &mut Report<'_>) {
        let is_between = matches!(
            event,
            Event::Stop(_)
                | Event::Unfollowed
                | Event::UserCommand { .. }
                | Event::WaitInput { .. }
                | Event::BarLoad
                | Event::PalletChange
                | Event::Shift(_)
        );
        if is_between || is_other_part(cx, event) {
            self.forget();
        }
    }

    fn moved(&mut self, cx: &PathCx<'_>, event: &Event, report: &mut Report<'_>) {
        let is_known = cx.is_certain();
        if !is_known || !turns_the_part(cx) {
            self.forget();
            return;
        }
        // A bar stop or a puller comes for the next part.
        if self.off.is_some() && ToolWords::of(cx).needs_no_spindle() {
            self.forget();
            return;
        }
        let (from, to) = match event {
            Event::Travel(travel) if travel.kind == TravelKind::Feed => (spot(&travel.from), end(cx, travel)),
            Event::Arc(arc) => (spot(&arc.from), spot(&arc.programmed)),
            _ => return,
        };
        if [from, to].iter().flatten().any(|coordinate| coordinate.is_nan()) {
            self.forget();
            return;
        }
        let tool = cx.definitions().set_by(Fact::Tool);
        if let Some((off, by)) = self.off {
            self.judge(cx, off, by.filter(|by| Some(*by) != tool), [from, to], report);
            return;
        }
        if let Some(parting) = Parting::of(cx, event) {
            self.off = Some((parting, tool)).filter(|_| self.turned.is_parted(&parting));
        } else if from[1] - to[1] > SHORT && to[0] > SHORT {
            self.turned.add(from[1], to[1]);
        }
    }
}

impl Default for TurnedAfterCutOff {
    fn default() -> Self {
        Self { turned: Along::NOTHING, off: None }
    }
}

impl TurnedAfterCutOff {
    fn forget(&mut self) {
        *self = Self::default();
    }

    /// A cut after the part was cut off, by another tool.
    fn judge(
        &mut self,
        cx: &PathCx<'_>,
        off: Parting,
        by: Option<At>,
        [from, to]: [Spot; 2],
        report: &mut Report<'_>,
    ) {
        let deepest = off.z.0 - SLACK;
        if from[1] < deepest || to[1] < deepest {
            // The next part, further along the bar.
            self.forget();
            return;
        }
        let is_cut = from[1] - to[1] > SHORT && to[1] < -SHORT;
        if is_cut && builders_since(cx, off.at.block) {
            self.forget();
            return;
        }
        if by.is_none() || !is_cut {
            return;
        }
        let mut finding = cx
            .finding(&META, cx.range(), "the part is turned after it was cut off")
            .label("no bar feed and no stop since");
        if let Some(range) = cx.range_of(off.at) {
            finding = finding.also(range, format!("cut off here, at Z {}", cx.shown(off.z)));
        }
        report.add(
            finding.help("move this before the cut-off, or write the bar feed or a stop (`M0`) between them"),
        );
        self.forget();
    }
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::{Called, World, check_rule, check_rule_in, findings, only, words};

    fn program(between: &str, after: &str) -> String {
        format!(
            "G21 G99 T0101\nG97 S800 M3\nG0 X38. Z2.\nG1 Z-35. F.2\nG0 X100. Z100.\nT1010\nG0 X42. Z-33.\nG1 X-.5 F.08\nG0 X100.\nZ100.\n{between}T0303\nG0 X37. Z2.\n{after}\nG0 X100. Z100.\nM30\n"
        )
    }

    #[test]
    fn nothing_between() {
        let found =
            findings(&only(&RULE), "fanuc-lathe", &program("", "G1 Z-20. F.1\nX40."), &World::default());
        expect![[r#"
            the part is turned after it was cut off
              here: no bar feed and no stop since
              there: cut off here, at Z -33 mm
              help: move this before the cut-off, or write the bar feed or a stop (`M0`) between them
        "#]]
        .assert_eq(&found.iter().map(words).collect::<String>());
    }

    #[test]
    fn another_part() {
        let cut = "G1 Z-20. F.1\nX40.";
        for between in ["M0\n", "M1\n", "M20\n", "M77\n", "G55\n", "G50 W-35.\n", "G65 P9077\n"] {
            check_rule(&RULE, "fanuc-lathe", &program(between, cut), &expect![[""]]);
        }
        check_rule(&RULE, "fanuc-lathe", &program("T0909 (BAR STOP)\nG0 X0. Z1.\n", cut), &expect![[""]]);
        // Further along the bar; a face.
        for cut in ["Z-34.\nG1 Z-60. F.1\nX40.", "G1 Z0. F.1\nX-1."] {
            check_rule(&RULE, "fanuc-lathe", &program("", cut), &expect![[""]]);
        }
        for between in ["M11\nM10\n", "G105 J1.75\n"] {
            check_rule(&RULE, "haas-lathe", &program(between, cut), &expect![[""]]);
        }
    }

    #[test]
    fn a_second_spindle_took_it_over() {
        let program = |head: &str, between: &str| {
            program(between, "G1 Z-20. F.1\nX40.")
                .replace("G97 S800 M3\nG0 X38. Z2.", &format!("G97 S800 M3\n{head}G0 X38. Z2."))
        };
        for between in ["G14\n", "G199\n", "M110\n"] {
            check_rule(&RULE, "haas-lathe", &program("", between), &expect![[""]]);
            check_rule(&RULE, "haas-lathe", &program(between, ""), &expect![[""]]);
        }
        // In the safe line of a program for one spindle.
        check_rule(
            &RULE,
            "haas-lathe",
            &program("G15\n", ""),
            &expect![[r#"
            14 | G1 Z-20. F.1
               | ^^^^^^^^^^^^ warning[turned-after-cut-off] the part is turned after it was cut off
        "#]],
        );
    }

    #[test]
    fn another_file_may_feed_the_bar() {
        let feed = Called(9000, "O9000\nM11\nG4 P1.\nM10\nM99\n");
        let world = World { programs: &feed, ..World::default() };
        let program = program("M98 P9000\n", "G1 Z-20. F.1\nX40.");
        check_rule_in(&RULE, "fanuc-lathe", &program, &world, &expect![[""]]);
    }

    #[test]
    fn a_face_below_zero_is_not_a_cut_off() {
        check_rule(
            &RULE,
            "fanuc-lathe",
            "G21 G99 T0101\nG97 S800 M3\nG0 X60. Z-5.\nG1 X-1.6 F.2\nG0 X100. Z100.\nT0303\nG0 X50. Z2.\nG1 Z-4.5 F.2\nZ-40.\nG0 X100. Z100.\nM30\n",
            &expect![[""]],
        );
    }
}
