//! A rotary axis that turns far in one block while the tip of the tool is to follow the path.

use std::collections::BTreeSet;

use gcheck_controls::Effect;
use gcheck_engine::{At, Axis, Event, Fact, Role, TravelKind};

use crate::declare::declare_rule;
use crate::{PathCx, PathRule, Report, Run, Uses, Watch};
use crate::{Remembers, remembers};

declare_rule! {
    /// While the tip of the tool follows the path (`G43.4`, `G234`), one block at feed turns a rotary axis by 120 degrees or
    /// more.
    ///
    /// A change of that size is a solution with other angles for nearly the same direction of the tool: near the point where
    /// the tool is parallel to a rotary axis, a small change of direction turns that axis far. Each start of the mode is
    /// reported once.
    ///
    /// ## Why it matters
    /// The tip stays on the path, so that the linear axes swing around the part at full speed, and the cut dwells in one
    /// place. Head, holder or table may hit the part or a fixture.
    ///
    /// ## Reported
    /// ```nc,reported,fanuc-mill
    /// G21 G90 G94
    /// G43.4 H1
    /// G0 X0. Y0. Z10. B10. C5.
    /// G1 X1. B1. C5. F500.
    /// G1 X2. B-.5 C-175.
    /// M30
    /// ```
    /// ## Not reported
    /// ```nc,quiet,fanuc-mill
    /// G21 G90 G94
    /// G43.4 H1
    /// G0 X0. Y0. Z10. B10. C5.
    /// G1 X1. B1. C5. F500.
    /// G1 X2. B2. C15.
    /// M30
    /// ```
    rule "rotary-axis-jumps" in "five_axis" {
        summary: "a rotary axis turns far in one block at feed",
        severity: Warning,
        tier: Path,
        since: "0.1.0",
        run: Run::Path { watch: Watch::MOVES, make: || Box::new(RotaryAxisJumps::default()) },
    }
}

/// Degrees in one block.
const FAR: f64 = 120.0;

#[derive(Default, Clone, PartialEq)]
struct RotaryAxisJumps {
    /// The blocks that switched on the mode in which it was reported.
    told: BTreeSet<Option<At>>,
}

remembers!(RotaryAxisJumps: told);

impl PathRule for RotaryAxisJumps {
    fn memory(&mut self) -> Remembers<'_> {
        Remembers::All(self)
    }

    fn concerns(&self, program: &Uses<'_>) -> bool {
        program.may(|effect| effect == Effect::ToolCentrePoint)
    }

    fn moved(&mut self, cx: &PathCx<'_>, event: &Event, report: &mut Report<'_>) {
        let Event::Travel(travel) = event else { return };
        let follows = cx.state().effect(Role::Length, cx.model) == Some(Effect::ToolCentrePoint);
        if travel.kind != TravelKind::Feed || !follows {
            return;
        }
        let turn = |axis: Axis| Some((axis, (travel.to.get(axis)? - travel.from.get(axis)?).abs()));
        let turns = Axis::ALL.into_iter().filter(|axis| axis.is_rotary()).filter_map(turn);
        let Some((axis, degrees)) = turns.max_by(|a, b| a.1.total_cmp(&b.1)).filter(|(_, by)| *by >= FAR)
        else {
            return;
        };
        let fact = Fact::Mode(Role::Length);
        if !self.told.insert(cx.definitions().set_by(fact)) {
            return;
        }
        let name = cx.code_name(Role::Length).unwrap_or_default();
        let finding = cx
            .finding(
                &META,
                cx.range(),
                format!("{} turns {degrees:.0} degrees in one block at feed", axis.name()),
            )
            .label(format!("the tip stays on the path while {} turns", axis.name()))
            .help("retract before the axis turns, or have the CAM system avoid the change of solution");
        report.add(cx.resting_on(finding, fact, &format!("`{name}`")));
    }
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::check_rule;

    #[test]
    fn turning_at_rapid_or_without_the_mode_is_meant() {
        check_rule(
            &RULE,
            "fanuc-mill",
            "G21 G90 G94\nG1 X0. C0. F100.\nC170.\nG43.4 H1\nG0 X0. Y0. Z10. B0. C0.\nC180.\nM30\n",
            &expect![""],
        );
    }

    #[test]
    fn each_start_of_the_mode_is_told_once() {
        check_rule(
            &RULE,
            "haas-mill",
            "G20 G90 G94\nG234 H1 X0. Y0. Z1. B0. C0.\nG1 X1. B5. C10. F50.\nX2. C200.\nX3. C10.\nM30\n",
            &expect![[r#"
                4 | X2. C200.
                  | ^^^^^^^^^ warning[rotary-axis-jumps] C turns 190 degrees in one block at feed
            "#]],
        );
    }
}
