//! A job with tools and lengths that never says where its part lies.

use gcheck_engine::Event;

use super::work_offset_not_chosen::{is_set_up, unchosen};
use crate::memory::{Remembers, remembers};
use crate::meta::declare_rule;
use crate::{PathCx, PathRule, Report, Run, Watch};

declare_rule! {
    /// A tool that was changed in cuts with its length offset, and the program chooses no work offset (`G54` and its kin), here
    /// or later.
    ///
    /// Programs that need no tables of offsets, such as those of one tool that is zeroed by hand, are left to
    /// `work-offset-not-chosen`, and so are controls on which each end of a program is known to bring the first work offset back.
    ///
    /// ## Why it matters
    /// The part lies where the work offset says that the last program, or the operator, left active. A tool that is set up in
    /// another one cuts beside the part, or into the fixture.
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
        severity: Info,
        tier: Path,
        since: "0.1.0",
        run: Run::Path { watch: Watch::CUTS, make: || Box::new(WorkOffsetNeverChosen { is_done: false }) },
    }
}

#[derive(Clone, PartialEq)]
struct WorkOffsetNeverChosen {
    /// The first cut says it, or nothing does.
    is_done: bool,
}

remembers!(WorkOffsetNeverChosen);

impl PathRule for WorkOffsetNeverChosen {
    fn memory(&mut self) -> Remembers<'_> {
        Remembers::All(self)
    }

    fn cut(&mut self, cx: &PathCx<'_>, _: &Event, report: &mut Report<'_>) {
        if std::mem::replace(&mut self.is_done, true) || cx.is_called_only() {
            return;
        }
        let Some(name) = unchosen(cx).filter(|_| is_set_up(cx)) else { return };
        report.add(
            cx.finding(&META, cx.range(), format!("the program chooses no work offset (`{name}`)"))
                .label("the first cut: the part lies where the last program or the operator left it")
                .help(format!("choose the work offset at the head of the program: `{name}`")),
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
              | ^^^^^^^^^^ info[work-offset-never-chosen] the program chooses no work offset (`G54`)
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
