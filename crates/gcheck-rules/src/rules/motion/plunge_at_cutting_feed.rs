//! A plunge at the feed of the cut before it.

use gcheck_controls::Letter;
use gcheck_engine::{
    Abstract, ArcMove, At, Axis, Domain, Event, Fact, FeedMode, Position, Travel, TravelKind,
};
use gcheck_geometry::Mm;

use crate::declare::declare_rule;
use crate::facts::cuts::{Clear, Cuts, SURFACE, point};
use crate::{MakeShared, PathCx, PathRule, Report, Run, Severity, Watch};
use crate::{Remembers, remembers};

declare_rule! {
    /// A feed move straight down into the part has no `F` of its own, and runs at the feed of the cut before it, although the
    /// program gave the same tool a slower feed for an earlier plunge.
    ///
    /// It is *info*, and a warning if the feed is more than three times that of the earlier plunge. It is reported once for
    /// each feed that a cut gave. A plunge into what was cut before is not reported.
    ///
    /// ## Why it matters
    /// Most cutters cut worse with their face than with their side. At the feed of a cut sideways, the tool may break as it
    /// goes down.
    ///
    /// ## Reported
    /// ```nc,reported,haas-mill
    /// G21 G90 G54 G0 X0. Y0.
    /// G43 H1 Z5.
    /// G1 Z-3. F200.
    /// X60. F2500.
    /// G0 Z5.
    /// Y40.
    /// G1 Z-3.
    /// X0.
    /// G0 Z5.
    /// M30
    /// ```
    /// ## Not reported
    /// ```nc,quiet,haas-mill
    /// G21 G90 G54 G0 X0. Y0.
    /// G43 H1 Z5.
    /// G1 Z-3. F200.
    /// X60. F2500.
    /// G0 Z5.
    /// Y40.
    /// G1 Z-3. F200.
    /// X0. F2500.
    /// G0 Z5.
    /// M30
    /// ```
    rule "plunge-at-cutting-feed" in "motion" {
        summary: "plunge at the feed of the cut before it",
        severity: Warning,
        tier: Path,
        since: "0.1.0",
        run: Run::Path { watch: Watch::FEED_MOVES.union(Watch::ARCS), make: || Box::new(PlungeAtCuttingFeed::default()) },
    }
}

#[derive(Default, Clone, PartialEq)]
struct PlungeAtCuttingFeed {
    /// The block that put the tool in.
    tool: Option<At>,
    /// The slowest feed that the tool was fed straight down with.
    slow: Option<Fed>,
    /// The block that gave the faster feed that the tool cut sideways with last.
    fast: Option<At>,
    /// The block of that kind that was reported.
    told: Option<At>,
}

remembers!(PlungeAtCuttingFeed: tool, slow, fast, told);

/// A feed.
#[derive(Clone, Copy, PartialEq)]
struct Fed {
    /// The block that gave it.
    given: At,
    /// Millimetres per minute or per turn.
    rate: f64,
    mode: FeedMode,
}

remembers!(Fed: given);

/// Millimetres: less is not a move.
const WAY: f64 = 0.01;
/// A feed that is faster by less is the same one.
const FASTER: f64 = 1.2;
/// A feed that is faster by more breaks tools.
const MUCH_FASTER: f64 = 3.0;

impl PathRule for PlungeAtCuttingFeed {
    fn memory(&mut self) -> Remembers<'_> {
        Remembers::All(self)
    }

    fn shares(&self) -> Option<MakeShared> {
        Some(Cuts::shared)
    }

    fn moved(&mut self, cx: &PathCx<'_>, event: &Event, report: &mut Report<'_>) {
        if !cx.is_mill() || cx.shared::<Cuts>().is_none_or(Cuts::is_blind) {
            cx.enough();
            return;
        }
        match event {
            Event::Travel(Travel { kind: TravelKind::Feed, expanded: false, from, to, .. }) => {
                if let Some(at) = straight_down(from, to) {
                    self.plunge(cx, event, at, report);
                } else {
                    self.sideways(cx, to);
                }
            }
            Event::Arc(ArcMove { expanded: false, to, .. }) => self.sideways(cx, to),
            _ => {}
        }
    }
}

impl PlungeAtCuttingFeed {
    /// A cut, or a way up.
    fn sideways(&mut self, cx: &PathCx<'_>, to: &Position) {
        let Some(slow) = self.slow.filter(|_| to.raw(Axis::Z) < SURFACE) else { return };
        let Some(fed) = fed(cx).filter(|fed| fed.given != slow.given && fed.mode == slow.mode) else {
            return;
        };
        if fed.rate > slow.rate * FASTER && cx.definitions().set_by(Fact::Tool) == self.tool {
            self.fast = Some(fed.given);
        }
    }

    fn plunge(&mut self, cx: &PathCx<'_>, event: &Event, [x, y, z]: [f64; 3], report: &mut Report<'_>) {
        let tool = cx.definitions().set_by(Fact::Tool);
        if self.tool != tool {
            *self = Self { tool, ..Self::default() };
        }
        let Some(fed) = fed(cx).filter(|_| z < SURFACE) else { return };
        let Some(cuts) = cx.shared::<Cuts>().filter(|cuts| cuts.knows(cx, event)) else { return };
        if cuts.reach(cuts.len(), [x, y], z, Clear::among(cx, cuts).radius) {
            return;
        }
        match self.slow.filter(|slow| slow.mode == fed.mode) {
            Some(slow) if self.fast == Some(fed.given) && fed.rate > slow.rate * FASTER => {
                if self.told != self.fast && fed.given != cx.origin().at {
                    self.told = self.fast;
                    report.add(finding(cx, slow, fed));
                }
            }
            Some(slow) if slow.rate <= fed.rate => {}
            _ => self.slow = Some(fed),
        }
    }
}

/// The feed of the move, if the program gave it to this tool.
fn fed(cx: &PathCx<'_>) -> Option<Fed> {
    let rate = Abstract::known(cx.state().feed()).filter(|rate| *rate > 0.0)?;
    let mode = cx.state().feed_mode(cx.model).filter(|mode| *mode != FeedMode::InverseTime)?;
    Some(Fed { given: cx.definitions().set_by(Fact::Feed)?, rate, mode })
}

/// Where a move straight down ends; `None` for another one.
fn straight_down(from: &Position, to: &Position) -> Option<[f64; 3]> {
    let [x, y, z] = point(to)?;
    let way = || (x - from.raw(Axis::X)).hypot(y - from.raw(Axis::Y));
    (z < from.raw(Axis::Z) - WAY && way() < WAY).then_some([x, y, z])
}

fn finding(cx: &PathCx<'_>, slow: Fed, fed: Fed) -> crate::Finding {
    let is_feed = |word: &gcheck_program::Word| word.letter == Letter::of('F');
    let per = if fed.mode == FeedMode::PerMinute { "per minute" } else { "per turn" };
    let in_words = |fed: Fed| format!("{} {per}", cx.shown(Mm(fed.rate)));
    let mut finding = cx
        .finding(&META, cx.range(), "plunge at the feed of the cut before it")
        .label(format!("straight down at {}, and an earlier plunge had {}", in_words(fed), in_words(slow)))
        .help(
            "give the plunge its own feed (`F`), or leave the Z word out if the tool is to stay at its depth",
        )
        .at_most(if fed.rate > slow.rate * MUCH_FASTER { Severity::Warning } else { Severity::Info });
    for (given, what) in [(fed.given, "the feed of the cut"), (slow.given, "the feed of the earlier plunge")]
    {
        if let Some(range) = cx.find_word(given, is_feed) {
            finding = finding.also(range, what);
        }
    }
    finding
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::{World, check_rule, findings, only, words};

    /// Slots, each with its plunge.
    fn slots(plunges: &[&str], cut: &str) -> String {
        let slot =
            |(row, plunge): (usize, &&str)| format!("G0 X0. Y{row}0.\nG1 {plunge}\nX60.{cut}\nG0 Z5.\n");
        let slots: String = plunges.iter().enumerate().map(slot).collect();
        format!("G21 G90 G54 G0 X0. Y0. Z5.\n{slots}M30\n").replace("0.\nG1 Z", "5.\nG1 Z")
    }

    #[test]
    fn told_once_for_each_feed() {
        let program = "G21 G90 G54 G0 X0. Y0. Z5.\nG1 Z-3. F200.\nX60. F2500.\nG0 Z5.\nY40.\nG1 Z-3.\nX0.\nG0 Z5.\nY80.\nG1 Z-3.\nX60.\nF500.\nX80.\nG0 Z5.\nY120.\nG1 Z-3.\nG0 Z5.\nM30\n";
        check_rule(
            &RULE,
            "fanuc-mill",
            program,
            &expect![[r#"
            6 | G1 Z-3.
              | ^^^^^^^ warning[plunge-at-cutting-feed] plunge at the feed of the cut before it
            16 | G1 Z-3.
               | ^^^^^^^ info[plunge-at-cutting-feed] plunge at the feed of the cut before it
        "#]],
        );
    }

    #[test]
    fn a_program_that_plunges_at_its_one_feed() {
        check_rule(&RULE, "fanuc-mill", &slots(&["Z-3. F200.", "Z-3.", "Z-3."], ""), &expect![[""]]);
        // Written at the plunge, it is meant.
        check_rule(&RULE, "fanuc-mill", &slots(&["Z-3. F200.", "Z-3. F900."], " F900."), &expect![[""]]);
    }

    #[test]
    fn into_what_was_cut_before() {
        let program = "G21 G90 G54 G0 X0. Y0. Z5.\nG1 Z-3. F200.\nX60. F2500.\nG0 Z5.\nX0.\nG1 Z-3.\nX60.\nG0 Z5.\nM30\n";
        check_rule(&RULE, "fanuc-mill", program, &expect![[""]]);
        check_rule(
            &RULE,
            "fanuc-mill",
            &program.replace("X0.\nG1 Z-3.\n", "X0.\nG1 Z-6.\n"),
            &expect![[r#"
            6 | G1 Z-6.
              | ^^^^^^^ warning[plunge-at-cutting-feed] plunge at the feed of the cut before it
        "#]],
        );
    }

    #[test]
    fn the_feed_of_another_tool() {
        let program = "G21 G90 G54 G0 X0. Y0. Z5.\nG1 Z-3. F200.\nX60. F2500.\nG0 Z5.\nT2 M6\nG0 X0. Y40. Z5.\nG1 Z-3.\nX0.\nG0 Z5.\nM30\n";
        check_rule(&RULE, "fanuc-mill", program, &expect![[""]]);
    }

    #[test]
    fn what_it_says() {
        let program =
            "G20 G90 G54 G0 X0. Y0. Z1.\nG1 Z-.1 F10.\nX3. F25.\nG0 Z1.\nY4.\nG1 Z-.1\nX0.\nG0 Z1.\nM30\n";
        let found = findings(&only(&RULE), "haas-mill", program, &World::default());
        expect![[r#"
            plunge at the feed of the cut before it
              here: straight down at 25 in per minute, and an earlier plunge had 10 in per minute
              there: the feed of the cut
              there: the feed of the earlier plunge
              help: give the plunge its own feed (`F`), or leave the Z word out if the tool is to stay at its depth
        "#]]
        .assert_eq(&found.iter().map(words).collect::<String>());
    }
}
