//! A return level of drilling cycles that seems to be meant for the feed mode of a lathe.

use gcheck_controls::{Effect, Machine};
use gcheck_engine::{Event, Fact, Role};

use crate::declare::declare_rule;
use crate::facts::cutting::is_cut;
use crate::facts::cycles::is_cycle;
use crate::{PathCx, PathRule, Report, Run, Uses, Watch};

declare_rule! {
    /// A lathe program sets the return level of drilling cycles (`G98`, `G99`), has no such cycle, and cuts without having set
    /// its feed mode.
    ///
    /// ## Why it matters
    /// In G-code system A the same codes are feed per minute and feed per turn. On this control the feed mode is whatever the
    /// last program has left: after feed per minute `F0.2` creeps, after feed per turn `F200` breaks the tool.
    ///
    /// ## Reported
    /// ```nc,reported,fanuc-lathe-b
    /// G21 G18 G40 G90 G99
    /// T0101
    /// G97 S900 M3
    /// G0 X60. Z2.
    /// G1 Z-20. F0.2
    /// M30
    /// ```
    /// ## Not reported
    /// ```nc,quiet,fanuc-lathe-b
    /// G21 G18 G40 G90 G95
    /// T0101
    /// G97 S900 M3
    /// G0 X60. Z2.
    /// G1 Z-20. F0.2
    /// M30
    /// ```
    rule "return-level-for-feed-mode" in "motion" {
        summary: "return level of cycles for the feed mode of a lathe",
        severity: Warning,
        tier: Path,
        since: "0.1.0",
        run: Run::Path { watch: Watch::CUTS, make: || Box::new(ReturnLevelForFeedMode) },
    }
}

struct ReturnLevelForFeedMode;

impl PathRule for ReturnLevelForFeedMode {
    fn concerns(&self, program: &Uses<'_>) -> bool {
        program.environment.control().machine() == Machine::Lathe
            && program.may(is_return_level)
            && !program.may(is_cycle)
    }

    fn cut(&mut self, cx: &PathCx<'_>, event: &Event, report: &mut Report<'_>) {
        if !is_cut(cx, event) || cx.is_called_only() {
            return;
        }
        // The first cut decides.
        cx.enough();
        let set_by = |role| cx.definitions().set_by(Fact::Mode(role));
        let Some(given) = set_by(Role::ReturnLevel).filter(|_| set_by(Role::FeedMode).is_none()) else {
            return;
        };
        let word = cx.find_word(given, |word| is_return_level(cx.model.effect(word.code)));
        let Some(range) = word.or_else(|| cx.range_of(given)) else { return };
        let modes =
            [(Effect::FeedPerMinute, "feed per minute"), (Effect::FeedPerRevolution, "feed per turn")];
        let names = modes
            .into_iter()
            .filter_map(|(effect, what)| Some(format!("`{}` is {what}", cx.name_of_effect(effect)?)));
        let names: Vec<String> = names.collect();
        report.add(
            cx.finding(&META, range, "the return level of drilling cycles is set, and there are none")
                .label("nothing sets the feed mode of the cuts")
                .also(cx.range(), "this cut relies on the feed mode that the last program left")
                .help(format!("state the feed mode: {}", names.join(", "))),
        );
    }
}

fn is_return_level(effect: Effect) -> bool {
    matches!(effect, Effect::ReturnToInitial | Effect::ReturnToR)
}
