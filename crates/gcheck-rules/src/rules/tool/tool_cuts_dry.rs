//! A tool that cuts without coolant while others have it.

use gcheck_controls::Effect;
use gcheck_engine::Event;

use crate::declare::declare_rule;
use crate::facts::boundary::with_tool_change;
use crate::facts::coolant::CoolantWatch;
use crate::facts::cutting::is_cut;
use crate::{Finding, FollowedCx, PathCx, PathRule, Report, Run, Uses, Watch};
use crate::{Remembers, remembers};

declare_rule! {
    /// A tool cuts with the coolant off, while most tools of the program have it on.
    ///
    /// ## Why it matters
    /// A forgotten `M8` burns the tool, or leaves chips in the hole. Dry cutting may be deliberate: the rule is for
    /// shops that say so in a comment.
    ///
    /// ## Reported
    /// ```nc,reported,haas-mill
    /// T1 M6
    /// S1000 M3
    /// M8
    /// G1 X1. F10.
    /// M9
    /// T2 M6
    /// S1000 M3
    /// M8
    /// G1 X2. F10.
    /// M9
    /// T3 M6
    /// S1000 M3
    /// G1 X3. F10.
    /// M30
    /// ```
    /// ## Not reported
    /// A program without coolant is dry on purpose.
    /// ```nc,quiet,haas-mill
    /// T1 M6
    /// S1000 M3
    /// G1 X1. F10.
    /// T2 M6
    /// G1 X2. F10.
    /// M30
    /// ```
    rule "tool-cuts-dry" in "tool" {
        summary: "tool cuts without coolant while others have it",
        severity: Info,
        tier: Path,
        recommended: false,
        sets: [Strict],
        since: "0.1.0",
        run: Run::Path {
            watch: Watch::CHANGES.union(Watch::CUTS).union(Watch::FOLLOWED),
            make: || Box::new(ToolCutsDry::default()),
        },
    }
}

#[derive(Clone, Default, PartialEq)]
struct ToolCutsDry {
    coolant: CoolantWatch,
    wet: usize,
    dry: Vec<Finding>,
}

remembers!(ToolCutsDry: dry);

impl PathRule for ToolCutsDry {
    fn memory(&mut self) -> Remembers<'_> {
        Remembers::All(self)
    }

    fn concerns(&self, program: &Uses<'_>) -> bool {
        program.may(Effect::starts_coolant)
    }

    fn changed(&mut self, _: &PathCx<'_>, event: &Event, _: &mut Report<'_>) {
        self.coolant.changed(event);
    }

    fn cut(&mut self, cx: &PathCx<'_>, event: &Event, _: &mut Report<'_>) {
        if !self.coolant.is_first_cut(event, is_cut(cx, event)) {
            return;
        }
        if self.coolant.is_on() {
            self.wet += 1;
            return;
        }
        let on = cx
            .name_of_effect(Effect::FloodOn)
            .or_else(|| cx.name_of_effect(Effect::MistOn))
            .unwrap_or_default();
        let message = format!("the tool cuts with the coolant off (no `{on}`)");
        let finding = cx.finding(&META, cx.range(), message).label("its first cut").help(format!(
            "switch the coolant on with `{on}`, or say in a suppression why the tool cuts dry"
        ));
        self.dry.push(with_tool_change(cx, finding));
    }

    fn followed(&mut self, _: &FollowedCx<'_>, report: &mut Report<'_>) {
        if self.dry.len() >= self.wet {
            return;
        }
        let others = self.wet;
        for finding in self.dry.drain(..) {
            report.add(finding.note(format!("{others} other tools of the program cut with coolant")));
        }
    }
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::check_rule;

    #[test]
    fn coolant_that_stays_on_is_enough() {
        check_rule(
            &RULE,
            "linuxcnc",
            "G21 F100\nT1 M6\nM3 S100 M8\nG1 X1\nT2 M6\nM3\nG1 X2\nT3 M6\nM3\nG1 X3\nM2\n",
            &expect![[""]],
        );
    }

    #[test]
    fn half_and_half_says_nothing() {
        check_rule(
            &RULE,
            "linuxcnc",
            "G21 F100\nT1 M6\nM3 S100 M8\nG1 X1\nM9\nT2 M6\nM3\nG1 X2\nM2\n",
            &expect![[""]],
        );
    }
}
