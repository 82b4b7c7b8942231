//! A cut without a chosen work offset.

use gcheck_controls::Effect;
use gcheck_engine::{Event, Role};

use crate::declare::declare_rule;
use crate::facts::work_offset::{chooses_work_offset, never_chooses_work_offset, unchosen_work_offset};
use crate::{PathCx, PathRule, Report, Run, Watch};
use crate::{Remembers, remembers};

declare_rule! {
    /// A program cuts before it chooses a work coordinate system (`G54` and the like).
    ///
    /// For a tool with a length offset in a program that never chooses one, see `work-offset-never-chosen`.
    ///
    /// ## Why it matters
    /// The system that the last program, or the operator, left active decides where the part is. Most controls begin
    /// with `G54`, but only after power-on or a reset.
    ///
    /// ## Reported
    /// ```nc,reported,fanuc-mill
    /// G21 G90 G0 X0. Y0.
    /// G1 X10. F100.
    /// M30
    /// ```
    /// ## Not reported
    /// ```nc,quiet,fanuc-mill
    /// G21 G90 G54 G0 X0. Y0.
    /// G1 X10. F100.
    /// M30
    /// ```
    /// Turrets find the part by the tool's own offset.
    /// ```nc,quiet,fanuc-lathe
    /// T0101
    /// G1 X10. F.2
    /// M30
    /// ```
    rule "work-offset-not-chosen" in "offsets" {
        summary: "cut without a chosen work offset",
        severity: Info,
        tier: Path,
        recommended: false,
        sets: [Strict],
        fixable: OnRequest,
        since: "0.1.0",
        run: Run::Path { watch: Watch::CUTS, make: || Box::new(WorkOffsetNotChosen { is_done: false }) },
    }
}

#[derive(Clone, PartialEq)]
struct WorkOffsetNotChosen {
    is_done: bool,
}

remembers!(WorkOffsetNotChosen);

impl PathRule for WorkOffsetNotChosen {
    fn memory(&mut self) -> Remembers<'_> {
        Remembers::All(self)
    }

    fn cut(&mut self, cx: &PathCx<'_>, _: &Event, report: &mut Report<'_>) {
        if std::mem::replace(&mut self.is_done, true) || cx.is_called_only() {
            return;
        }
        let Some(name) = unchosen_work_offset(cx).filter(|_| !never_chooses_work_offset(cx)) else { return };
        let last = "the last program or the operator";
        // Some controls do not accept another offset under cutter compensation.
        let is_compensated = cx.state().effect(Role::Compensation, cx.model) != Some(Effect::CompensationOff);
        let fix = if is_compensated { None } else { cx.block_before(Some(&name)) };
        let later =
            if cx.file_uses(chooses_work_offset) { "; the program chooses one only later" } else { "" };
        report.add(
            cx.finding(&META, cx.range(), format!("cut before a work offset is chosen (`{name}`)"))
                .label(format!("{last} decides where the part is{later}"))
                .help(format!("choose the work offset at the head of the program: `{name}`"))
                .fix_if(fix),
        );
    }
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::check_rule;

    #[test]
    fn only_the_first_cut_is_marked() {
        check_rule(
            &RULE,
            "haas-mill",
            "G0 X1.\nM3 S100\nG1 X2. F5.\nM8\nX3.\nM30\n",
            &expect![[r#"
            3 | G1 X2. F5.
              | ^^^^^^^^^^ info[work-offset-not-chosen] cut before a work offset is chosen (`G54`)
        "#]],
        );
    }

    #[test]
    fn any_system_and_any_shift_will_do() {
        check_rule(&RULE, "haas-mill", "G154 P3 G0 X1.\nG1 X2. F5.\nM30\n", &expect![[""]]);
        check_rule(&RULE, "linuxcnc", "G21 G92 X0\nG1 X2 F50\nM2\n", &expect![[""]]);
    }

    #[test]
    fn a_subprogram_works_in_the_system_of_its_caller() {
        check_rule(&RULE, "fanuc-mill", "O100\nG1 X2. F50.\nM99\n", &expect![[""]]);
    }
}
