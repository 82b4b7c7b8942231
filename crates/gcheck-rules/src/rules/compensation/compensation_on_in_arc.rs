//! Cutter compensation that begins on an arc.

use gcheck_controls::{CompensationStyle, Effect};
use gcheck_engine::{At, CompensationFault, Event, Fault, Role};

use crate::declare::declare_rule;
use crate::facts::compensation::{begins, is_on, stays_in_plane};
use crate::{PathCx, PathRule, Report, Run, Severity, Uses, Watch};
use crate::{Remembers, remembers};

declare_rule! {
    /// The first move under cutter compensation (`G41`, `G42`) is an arc, on a control that begins it on a straight move only.
    ///
    /// ## Why it matters
    /// The control stops with an alarm, or moves to an unintended place beside the arc.
    ///
    /// ## Reported
    /// ```nc,reported,fanuc-mill
    /// G0 X0. Y0.
    /// G41 D1 G2 X10. Y0. I5. F100.
    /// M30
    /// ```
    /// ## Not reported
    /// ```nc,quiet,fanuc-mill
    /// G0 X0. Y0.
    /// G41 D1 G1 X-5. F100.
    /// G2 X10. Y0. I5.
    /// M30
    /// ```
    rule "compensation-on-in-arc" in "compensation" {
        summary: "cutter compensation begins on an arc",
        severity: Error,
        tier: Path,
        since: "0.1.0",
        run: Run::Path {
            watch: Watch::BLOCKS.union(Watch::CUTS).union(Watch::RAPIDS).union(Watch::FAULTS),
            make: || Box::new(CompensationOnInArc { begun: None }),
        },
    }
}

#[derive(Clone, PartialEq)]
struct CompensationOnInArc {
    /// Compensation is on and nothing has moved since.
    begun: Option<At>,
}

remembers!(CompensationOnInArc: begun);

impl PathRule for CompensationOnInArc {
    fn memory(&mut self) -> Remembers<'_> {
        Remembers::All(self)
    }

    fn concerns(&self, program: &Uses<'_>) -> bool {
        program.may(is_on)
    }

    fn block(&mut self, cx: &PathCx<'_>, _: &mut Report<'_>) {
        if begins(cx) {
            self.begun = Some(cx.origin().at);
        } else if cx.has_effect(|effect| effect == Effect::CompensationOff) {
            self.begun = None;
        }
    }

    fn rapid(&mut self, cx: &PathCx<'_>, event: &Event, report: &mut Report<'_>) {
        self.moves(cx, event, report);
    }

    fn cut(&mut self, cx: &PathCx<'_>, event: &Event, report: &mut Report<'_>) {
        self.moves(cx, event, report);
    }

    fn fault(&mut self, cx: &PathCx<'_>, fault: &Fault, report: &mut Report<'_>) {
        if *fault == Fault::Compensation(CompensationFault::EntryIsArc) {
            let begun = self.begun.take().unwrap_or_else(|| cx.origin().at);
            tell(cx, begun, report);
        }
    }
}

impl CompensationOnInArc {
    fn moves(&mut self, cx: &PathCx<'_>, event: &Event, report: &mut Report<'_>) {
        if self.begun.is_none() || stays_in_plane(cx, event) {
            return;
        }
        let Some(begun) = self.begun.take() else { return };
        // Where it is on some paths only, each of them is looked at by itself.
        if !cx.state().effect(Role::Compensation, cx.model).is_some_and(is_on) {
            return;
        }
        let is_straight_only = cx.model.semantics().compensation.style == CompensationStyle::Intersection;
        if is_straight_only && matches!(event, Event::Arc(arc) if !arc.expanded) {
            tell(cx, begun, report);
        }
    }
}

fn tell(cx: &PathCx<'_>, begun: At, report: &mut Report<'_>) {
    let code = cx.find_word(begun, |word| is_on(cx.model.effect(word.code)));
    let name = cx.code_name(Role::Compensation).unwrap_or_default();
    let mut finding = cx
        .finding(
            &META,
            cx.effect_range(Effect::is_arc),
            format!("cutter compensation begins on an arc (`{name}`)"),
        )
        .label("the first move under compensation")
        .help(format!("put a straight move, longer than the tool's radius, between `{name}` and the arc"));
    if let Some(range) = code {
        finding = finding.also(range, "compensation is switched on here");
    }
    // Certain if the control's own list of alarms has it.
    let is_listed = cx.control().alarm(META.id).is_some();
    report.add(if is_listed { finding } else { finding.at_most(Severity::Warning) });
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::check_rule;

    #[test]
    fn an_arc_in_a_later_block_is_the_first_move_all_the_same() {
        check_rule(
            &RULE,
            "haas-mill",
            "G20 G0 X0. Y0.\nG41 D1\nG1 Z-.1 F5.\nG3 X1. Y0. I.5\nM30\n",
            &expect![[r#"
            4 | G3 X1. Y0. I.5
              | ^^ warning[compensation-on-in-arc] cutter compensation begins on an arc (`G41`)
        "#]],
        );
    }

    #[test]
    fn switched_off_again_it_never_began() {
        check_rule(
            &RULE,
            "haas-mill",
            "G20 G0 X0. Y0.\nG41 D1\nG40\nG3 X1. Y0. I.5 F5.\nM30\n",
            &expect![[""]],
        );
    }

    #[test]
    fn a_control_that_enters_on_arcs_may() {
        check_rule(&RULE, "linuxcnc", "G21 G0 X0 Y0\nG41 D1 G3 X10 Y0 I5 F100\nM2\n", &expect![[""]]);
    }
}
