//! Cutter compensation that ends on an arc.

use gcheck_controls::Effect;
use gcheck_engine::{At, CompensationFault, Event, Fault, Role};

use crate::declare::declare_rule;
use crate::facts::compensation::{is_on, stays_in_plane};
use crate::{PathCx, PathRule, Report, Run, Severity, Uses, Watch};
use crate::{Remembers, remembers};

declare_rule! {
    /// The first move after cutter compensation is switched off (`G40`) is an arc.
    ///
    /// ## Why it matters
    /// The move from the offset path back to the programmed one must be straight. The control stops with an alarm, with
    /// the tool still at the contour.
    ///
    /// ## Reported
    /// ```nc,reported,fanuc-mill
    /// G41 D1 G1 X10. Y0. F100.
    /// Y20.
    /// G40 G2 X20. Y20. I5.
    /// M30
    /// ```
    /// ## Not reported
    /// ```nc,quiet,fanuc-mill
    /// G41 D1 G1 X10. Y0. F100.
    /// Y20.
    /// G40 G1 X0.
    /// G2 X20. Y20. I10.
    /// M30
    /// ```
    rule "compensation-off-in-arc" in "compensation" {
        summary: "cutter compensation ends on an arc",
        severity: Error,
        tier: Path,
        since: "0.1.0",
        run: Run::Path {
            watch: Watch::BLOCKS.union(Watch::CUTS).union(Watch::RAPIDS).union(Watch::FAULTS),
            make: || Box::new(CompensationOffInArc { ended: None }),
        },
    }
}

#[derive(Clone, PartialEq)]
struct CompensationOffInArc {
    /// Compensation was switched off and nothing has moved since.
    ended: Option<At>,
}

remembers!(CompensationOffInArc: ended);

impl PathRule for CompensationOffInArc {
    fn memory(&mut self) -> Remembers<'_> {
        Remembers::All(self)
    }

    fn concerns(&self, program: &Uses<'_>) -> bool {
        program.may(is_on)
    }

    fn block(&mut self, cx: &PathCx<'_>, _: &mut Report<'_>) {
        let was_on = cx.state().effect(Role::Compensation, cx.model).is_some_and(is_on);
        if was_on && cx.has_effect(|effect| effect == Effect::CompensationOff) {
            self.ended = Some(cx.origin().at);
        } else if cx.has_effect(is_on) {
            self.ended = None;
        }
    }

    fn rapid(&mut self, cx: &PathCx<'_>, event: &Event, report: &mut Report<'_>) {
        self.moves(cx, event, report);
    }

    fn cut(&mut self, cx: &PathCx<'_>, event: &Event, report: &mut Report<'_>) {
        self.moves(cx, event, report);
    }

    fn fault(&mut self, cx: &PathCx<'_>, fault: &Fault, report: &mut Report<'_>) {
        if *fault == Fault::Compensation(CompensationFault::ExitIsArc) {
            let ended = self.ended.take().unwrap_or_else(|| cx.origin().at);
            tell(cx, ended, report);
        }
    }
}

impl CompensationOffInArc {
    fn moves(&mut self, cx: &PathCx<'_>, event: &Event, report: &mut Report<'_>) {
        let Some(ended) = self.ended else { return };
        // Moves that compensation held back come out with the block that switches it off.
        let is_older = cx.origin().at.file == ended.file && cx.origin().at.block < ended.block;
        if is_older || stays_in_plane(cx, event) {
            return;
        }
        self.ended = None;
        if matches!(event, Event::Arc(arc) if !arc.expanded) {
            tell(cx, ended, report);
        }
    }
}

fn tell(cx: &PathCx<'_>, ended: At, report: &mut Report<'_>) {
    let code = cx.find_word(ended, |word| cx.model.effect(word.code) == Effect::CompensationOff);
    let name = cx.name_of_effect(Effect::CompensationOff).unwrap_or_default();
    let mut finding = cx
        .finding(
            &META,
            cx.effect_range(Effect::is_arc),
            format!("cutter compensation ends on an arc (`{name}`)"),
        )
        .label("the first move after compensation")
        .help(format!("leave the contour on a straight move, longer than the tool's radius, with `{name}`"));
    if let Some(range) = code {
        finding = finding.also(range, "compensation is switched off here");
    }
    // Certain if the control's own list of alarms has it, or if its interpreter was seen to refuse it.
    let semantics = cx.model.semantics();
    let is_sure = cx.control().alarm(META.id).is_some() || semantics.compensation.freezes_modes;
    report.add(if is_sure { finding } else { finding.at_most(Severity::Warning) });
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::check_rule;

    #[test]
    fn the_arc_may_stand_in_a_later_block() {
        check_rule(
            &RULE,
            "haas-mill",
            "G20 G41 D1 G1 X1. Y0. F5.\nY2.\nG40\nG1 Z1.\nG2 X2. I.5\nM30\n",
            &expect![[r#"
                5 | G2 X2. I.5
                  | ^^ warning[compensation-off-in-arc] cutter compensation ends on an arc (`G40`)
            "#]],
        );
    }

    #[test]
    fn at_the_head_of_the_program_nothing_ends() {
        check_rule(&RULE, "haas-mill", "G20 G40\nG2 X2. I.5 F5.\nM30\n", &expect![[""]]);
    }

    #[test]
    fn a_control_that_refuses_it() {
        check_rule(
            &RULE,
            "linuxcnc",
            "G21 G0 X0 Y0\nG41 D1 G1 X10 F100\nY20\nG40\nG2 X20 Y20 I5\nM2\n",
            &expect![[r#"
                5 | G2 X20 Y20 I5
                  | ^^ error[compensation-off-in-arc] cutter compensation ends on an arc (`G40`)
            "#]],
        );
    }
}
