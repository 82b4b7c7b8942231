//! A job with tools and lengths, and without a work offset.

use gcheck_controls::Effect;
use gcheck_engine::Event;

use crate::declare::declare_rule;
use crate::facts::work_offset::{chooses_work_offset, never_chooses_work_offset, unchosen_work_offset};
use crate::{PathCx, PathRule, Report, Run, Severity, Watch};
use crate::{Remembers, remembers};

declare_rule! {
    /// After a tool change a tool cuts with its length offset, and the program never chooses a work offset (`G54` and
    /// the like). Before tool centre point control (`G234`) or a dynamic work offset (`G254`) that is a warning: they need one.
    ///
    /// `work-offset-not-chosen` covers programs without tables of offsets, such as those of one tool that is zeroed by
    /// hand, and controls on which each end of program is known to restore the first work offset.
    ///
    /// ## Why it matters
    /// The work offset that the last program, or the operator, left active decides where the part is. If the part is
    /// set up in another one, the tool cuts beside the part, or into the fixture.
    ///
    /// ## Reported
    /// ```nc,reported,fanuc-mill
    /// G21 G90 G17
    /// T1 M6
    /// G0 X0. Y0. S1000 M3
    /// G43 H1 Z50.
    /// G1 Z-5. F100.
    /// M30
    /// ```
    /// ## Not reported
    /// ```nc,quiet,fanuc-mill
    /// G21 G90 G17
    /// T1 M6
    /// G0 G54 X0. Y0. S1000 M3
    /// G43 H1 Z50.
    /// G1 Z-5. F100.
    /// M30
    /// ```
    rule "work-offset-never-chosen" in "offsets" {
        summary: "no work offset in a job with tools and lengths",
        severity: Warning,
        tier: Path,
        since: "0.1.0",
        run: Run::Path { watch: Watch::CUTS.union(Watch::BLOCKS), make: || Box::new(WorkOffsetNeverChosen { is_done: false }) },
    }
}

#[derive(Clone, PartialEq)]
struct WorkOffsetNeverChosen {
    /// Only the first cut is reported.
    is_done: bool,
}

remembers!(WorkOffsetNeverChosen);

impl PathRule for WorkOffsetNeverChosen {
    fn memory(&mut self) -> Remembers<'_> {
        Remembers::All(self)
    }

    fn block(&mut self, cx: &PathCx<'_>, report: &mut Report<'_>) {
        let needs_offset =
            |effect: Effect| matches!(effect, Effect::ToolCentrePoint | Effect::DynamicOffsetOn);
        if self.is_done || !cx.has_effect(needs_offset) || cx.is_called_only() {
            return;
        }
        let Some(name) = unchosen_work_offset(cx).filter(|_| !cx.file_uses(chooses_work_offset)) else {
            return;
        };
        self.is_done = true;
        report.add(
            cx.finding(
                &META,
                cx.effect_range(needs_offset),
                format!("the program does not choose a work offset (`{name}`)"),
            )
            .label("needs a work offset in effect")
            .help(format!("choose the work offset at the head of the program: `{name}`")),
        );
    }

    fn cut(&mut self, cx: &PathCx<'_>, _: &Event, report: &mut Report<'_>) {
        if std::mem::replace(&mut self.is_done, true) || cx.is_called_only() {
            return;
        }
        let Some(name) = unchosen_work_offset(cx).filter(|_| never_chooses_work_offset(cx)) else { return };
        report.add(
            cx.finding(&META, cx.range(), format!("the program does not choose a work offset (`{name}`)"))
                .label("the first cut: the last program or the operator decides where the part is")
                .help(format!("choose the work offset at the head of the program: `{name}`"))
                .at_most(Severity::Info),
        );
    }
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::check_rule;

    #[test]
    fn a_job_without_lengths_may_be_zeroed_by_hand() {
        check_rule(&RULE, "haas-mill", "G0 X0. Y0.\nG1 X1. F5.\nM30\n", &expect![[""]]);
        check_rule(
            &RULE,
            "haas-mill",
            "T1 M6\nG43 H1 Z1.\nG1 X1. F5.\nM30\n",
            &expect![[r#"
                3 | G1 X1. F5.
                  | ^^^^^^^^^^ info[work-offset-never-chosen] the program does not choose a work offset (`G54`)
            "#]],
        );
    }

    #[test]
    fn an_end_that_is_known_to_bring_it_back_is_quiet() {
        check_rule(&RULE, "linuxcnc", "G21 T1 M6\nG43 H1 Z1\nG1 X1 F5\nM2\n", &expect![[""]]);
    }

    #[test]
    fn one_that_comes_later_is_another_matter() {
        check_rule(&RULE, "haas-mill", "T1 M6\nG43 H1 Z1.\nG1 X1. F5.\nG54\nM30\n", &expect![[""]]);
    }
}
