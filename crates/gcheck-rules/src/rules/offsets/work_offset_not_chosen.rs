//! A cut in whatever work coordinate system is active.

use gcheck_controls::{Confidence, Effect};
use gcheck_engine::{Abstract, Domain, Event, Fact, Role};

use crate::memory::{Remembers, remembers};
use crate::meta::declare_rule;
use crate::{PathCx, PathRule, Report, Run, Watch};

declare_rule! {
    /// A program cuts without having chosen a work coordinate system (`G54` and its kin).
    ///
    /// A tool with a length offset in a program that never chooses one is left to `work-offset-never-chosen`.
    ///
    /// ## Why it matters
    /// The part lies where the system says that the last program, or the operator, left active. Most controls begin with `G54`,
    /// but only after power-on or a reset.
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
        mends: OnRequest,
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
        let Some(name) = unchosen(cx).filter(|_| !is_set_up(cx)) else { return };
        let last = "the last program or the operator";
        // Some controls take no other offset under cutter compensation.
        let is_compensated = cx.state().effect(Role::Compensation, cx.model) != Some(Effect::CompensationOff);
        let fix = if is_compensated { None } else { cx.block_before(Some(&name)) };
        let later = if cx.file_uses(chooses) { "; the program chooses one only later" } else { "" };
        report.add(
            cx.finding(&META, cx.range(), format!("cut before a work offset is chosen (`{name}`)"))
                .label(format!("the part lies where {last} left it{later}"))
                .help(format!("choose the work offset at the head of the program: `{name}`"))
                .fix_if(fix),
        );
    }
}

/// The first work offset, where this cut is in one that nothing chose.
pub(super) fn unchosen(cx: &PathCx<'_>) -> Option<String> {
    let first = cx.scene.control().codes().find(|code| code.effect() == Effect::WorkOffset(1))?;
    let is_chosen = cx.trace().set_by(Fact::Mode(Role::WorkOffset)).is_some()
        || cx.trace().set_by(Fact::Shift).is_some()
        || cx.is_behind_unknown_program();
    let is_in_machine_coordinates = cx.has_effect(|effect| effect == Effect::MachineCoordinates);
    let is_free = is_chosen || is_in_machine_coordinates || cx.model.semantics().tools.change_by_t;
    (!is_free).then(|| first.number().to_string())
}

/// The tool was changed in and has a length offset: the program is one for tables of offsets, and it chooses no work offset
/// at all. Not so where each end of a program is known to bring the first one back.
pub(super) fn is_set_up(cx: &PathCx<'_>) -> bool {
    let semantics = cx.model.semantics();
    let comes_back = semantics.confidence == Confidence::Manual && cx.end_resets(Role::WorkOffset);
    let has_length = cx.state().effect(Role::Length, cx.model) == Some(Effect::LengthPlus)
        && Abstract::known(cx.state().h()).is_some_and(|offset| offset > 0.0);
    has_length && cx.trace().set_by(Fact::Tool).is_some() && !comes_back && !cx.file_uses(chooses)
}

fn chooses(effect: Effect) -> bool {
    matches!(effect, Effect::WorkOffset(_) | Effect::WorkOffsetByP(_))
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
