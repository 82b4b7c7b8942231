//! A cut that some paths reach with the spindle stopped.

use gcheck_controls::Effect;
use gcheck_engine::{Abstract, At, Domain, Event, Fact, Stop, Truth};

use crate::declare::declare_rule;
use crate::facts::cutting::{is_cut, starts_spindle};
use crate::{PathCx, PathRule, Report, Run, Severity, Watch};
use crate::{Remembers, remembers};

declare_rule! {
    /// On some paths of the program the spindle is stopped when a block cuts; on others it turns. An optional stop is such a
    /// path where the stop switches the spindle off (warning).
    ///
    /// ## Why it matters
    /// The program runs well until the other path is taken, or the operator turns the optional stop on. Then the tool is
    /// pushed through the material.
    ///
    /// ## Reported
    /// ```nc,reported,fanuc-mill
    /// G0 X0. Y0.
    /// IF [#500 EQ 1] GOTO 5
    /// S1000 M3
    /// N5 G1 X10. F100.
    /// M30
    /// ```
    /// ```nc,reported,haas-mill
    /// G0 X0. Y0. S1000 M3
    /// M1
    /// G1 X10. F100.
    /// M30
    /// ```
    /// ## Not reported
    /// ```nc,quiet,fanuc-mill
    /// IF [#500 EQ 1] GOTO 5
    /// G0 X0. Y0.
    /// N5 S1000 M3
    /// G1 X10. F100.
    /// M30
    /// ```
    rule "maybe-spindle-stopped-while-cutting" in "spindle" {
        summary: "cut where the spindle may be stopped",
        severity: Warning,
        tier: Path,
        since: "0.1.0",
        run: Run::Path { watch: Watch::CUTS.union(Watch::CHANGES), make: || Box::new(MaybeSpindleStopped::default()) },
    }
}

#[derive(Default, Clone, PartialEq)]
struct MaybeSpindleStopped {
    /// The optional stop since which the spindle may be off.
    stopped_by: Option<At>,
    /// What switched the spindle last in each case that was reported.
    told: Vec<Option<At>>,
}

remembers!(MaybeSpindleStopped: stopped_by, told);

impl PathRule for MaybeSpindleStopped {
    fn memory(&mut self) -> Remembers<'_> {
        Remembers::All(self)
    }

    fn changed(&mut self, cx: &PathCx<'_>, event: &Event, _: &mut Report<'_>) {
        match event {
            Event::Stop(Stop::Optional) if cx.state().spindle().is_none() => {
                self.stopped_by = Some(cx.origin().at);
            }
            Event::Spindle(_) | Event::ToolChange(_) => self.stopped_by = None,
            _ => {}
        }
    }

    fn cut(&mut self, cx: &PathCx<'_>, event: &Event, report: &mut Report<'_>) {
        let state = cx.state();
        let may_stand = state.spindle().is_none() && state.live_tool() == Truth::False;
        // The state after a program that gcheck does not have is unknown, and is not a path of this one.
        let is_told_of = !cx.is_after_unknown_program()
            && (self.stopped_by.is_some() || !cx.definitions().decisions().is_empty())
            && Abstract::bounds(state.speed()).is_some()
            && cx.file_uses(starts_spindle);
        if !may_stand || !is_told_of || !is_cut(cx, event) || cx.is_called_only() {
            return;
        }
        let switched_by = self.stopped_by.or_else(|| cx.definitions().set_by(Fact::Spindle));
        if self.told.contains(&switched_by) {
            return;
        }
        self.told.push(switched_by);
        if let Some(stop) = self.stopped_by {
            let name = cx.name_of_effect(Effect::OptionalStop).unwrap_or_default();
            let finding = cx
                .finding(
                    &META,
                    cx.range(),
                    format!("cut after an optional stop, which stops the spindle (`{name}`)"),
                )
                .label("the spindle does not turn here if the operator has optional stop on")
                .help("start the spindle again with `S` and `M3` or `M4` after the stop");
            let finding = match cx.range_of(stop) {
                Some(range) => finding.also(range, "may stop here"),
                None => finding,
            };
            report.add(cx.with_path(finding));
            return;
        }
        let finding = cx
            .finding(&META, cx.range(), "cut where the spindle may be stopped (`M5`)")
            .label("on some paths the spindle does not turn here")
            .help("start the spindle after the paths have joined")
            .at_most(Severity::Info);
        report.add(cx.with_path(finding));
    }
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::check_rule;

    #[test]
    fn stopped_on_one_of_the_ways() {
        check_rule(
            &RULE,
            "haas-mill",
            "S1000 M3\nG1 X1. F5.\nIF [#500 EQ 1] GOTO 5\nM5\nN5 G1 X2.\nX3.\nM30\n",
            &expect![[r#"
                5 | N5 G1 X2.
                  | ^^^^^^^^^ info[maybe-spindle-stopped-while-cutting] cut where the spindle may be stopped (`M5`)
            "#]],
        );
    }

    #[test]
    fn a_program_that_is_not_at_hand_says_nothing() {
        check_rule(&RULE, "haas-mill", "S1000 M3\nM98 P9000\nG1 X2. F5.\nM30\n", &expect![[""]]);
    }
}
