//! A cut that turns two rotary axes while linear ones move, with feed per minute.

use std::collections::BTreeSet;

use gcheck_controls::Effect;
use gcheck_engine::{At, Axis, Event, Fact, FeedMode, Role, Travel, TravelKind};

use crate::declare::declare_rule;
use crate::facts::five_axis::is_along_tool;
use crate::{PathCx, PathRule, Report, Run, Watch};
use crate::{Remembers, remembers};

declare_rule! {
    /// A cut turns two rotary axes while linear axes move, and its feed is per minute (`G94`) or per turn (`G95`), on a control
    /// whose manual asks for inverse time (`G93`) there.
    ///
    /// ## Why it matters
    /// `F` does not say how fast the tool goes through the material when the part turns under it: the control slows
    /// down to a crawl, or cuts far too fast. In inverse time each block says how long it takes. With tool centre point
    /// control (`G234`) the feed per minute is that of the tip.
    ///
    /// ## Reported
    /// ```nc,reported,haas-mill
    /// G20 G90 G94 G0 X0. Y0. Z1. A0. B0.
    /// G1 X1. A10. B10. F20.
    /// M30
    /// ```
    /// ## Not reported
    /// ```nc,quiet,haas-mill
    /// G20 G90 G0 X0. Y0. Z1. A0. B0.
    /// G93 G1 X1. A10. B10. F20.
    /// G94 G1 A20. F200.
    /// M30
    /// ```
    rule "rotary-feed-per-minute" in "five_axis" {
        summary: "cut that turns two rotary axes with feed per minute",
        severity: Warning,
        tier: Path,
        since: "0.1.0",
        run: Run::Path { watch: Watch::CUTS, make: || Box::new(RotaryFeedPerMinute::default()) },
    }
}

#[derive(Default, Clone, PartialEq)]
struct RotaryFeedPerMinute {
    /// Blocks that switched on the feed mode: one finding for each.
    told: BTreeSet<Option<At>>,
}

remembers!(RotaryFeedPerMinute: told);

impl PathRule for RotaryFeedPerMinute {
    fn memory(&mut self) -> Remembers<'_> {
        Remembers::All(self)
    }

    fn cut(&mut self, cx: &PathCx<'_>, event: &Event, report: &mut Report<'_>) {
        let Some(source) = &cx.model.semantics().inverse_time_for_five_axes else { return };
        let state = cx.state();
        let (Event::Travel(travel), Some(mode)) = (event, state.feed_mode(cx.model)) else { return };
        let is_simple = travel.kind == TravelKind::Feed && !travel.expanded;
        if !is_simple || mode == FeedMode::InverseTime || !is_five_axis(travel) {
            return;
        }
        // The feed is that of the tip, or another rule reports it.
        let length = state.effect(Role::Length, cx.model);
        if length.is_none_or(|length| length == Effect::ToolCentrePoint || is_along_tool(length)) {
            return;
        }
        let fact = Fact::Mode(Role::FeedMode);
        let set_by = cx.definitions().set_by(fact);
        let Some(code) = state.mode(Role::FeedMode).only() else { return };
        if !self.told.insert(set_by) {
            return;
        }
        let (name, per) =
            (cx.name_of(code), if mode == FeedMode::PerRevolution { "per turn" } else { "per minute" });
        let finding = cx
            .finding(&META, cx.range(), format!("two rotary axes turn in a cut with feed {per} (`{name}`)"))
            .label("`F` does not say how fast the tool cuts here")
            .note(format!(
                "the manual asks for inverse time (`G93`) where rotary and linear axes move together  [{source}]"
            ))
            .help(
                "post these blocks in inverse time (`G93`), or switch on tool centre point control where the machine has it",
            );
        report.add(match set_by {
            Some(_) => cx.resting_on(finding, fact, &format!("`{name}`")),
            None => finding.assuming(format!("`{name}` is what the control has at the start")),
        });
    }
}

/// Do two rotary axes turn while a linear one moves? False where a place is not known.
fn is_five_axis(travel: &Travel) -> bool {
    let moves = |axis: &Axis| (travel.to.raw(*axis) - travel.from.raw(*axis)).abs() > 1e-6;
    let (rotary, linear): (Vec<Axis>, Vec<Axis>) =
        Axis::ALL.into_iter().filter(moves).partition(|axis| axis.is_rotary());
    rotary.len() >= 2 && !linear.is_empty()
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::check_rule;

    #[test]
    fn once_for_a_stretch_of_cuts() {
        check_rule(
            &RULE,
            "haas-mill",
            "G20 G90 G94 G0 X0. Y0. Z1. A0. B0.\nG1 X1. A10. B10. F20.\nX2. A12. B10.\nX3. A13. B13.\nG93 X4. A20. B20. F9.\nM30\n",
            &expect![[r#"
                2 | G1 X1. A10. B10. F20.
                  | ^^^^^^^^^^^^^^^^^^^^^ warning[rotary-feed-per-minute] two rotary axes turn in a cut with feed per minute (`G94`)
            "#]],
        );
    }

    #[test]
    fn one_axis_and_the_tip_have_their_feed() {
        check_rule(
            &RULE,
            "haas-mill",
            "G20 G90 G94 G0 X0. Y0. Z1. A0. B0.\nG1 X1. A10. F20.\nG234 H1\nG1 X2. A12. B10.\nG49\nM30\n",
            &expect![[""]],
        );
        let program = "G20 G90 G94 G0 X0. Y0. Z1. A0. B0.\nG1 X1. A10. B10. F20.\nM30\n";
        check_rule(&RULE, "fanuc-mill", program, &expect![[""]]);
    }
}
