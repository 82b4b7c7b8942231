//! A modal macro call that is not ended.

use gcheck_controls::Effect;
use gcheck_engine::{At, Ending, Fact, Role};

use crate::declare::declare_rule;
use crate::facts::boundary::{Boundary, boundary, boundary_range, ends_at_tape_mark};
use crate::facts::modes::{ActiveMode, left_on};
use crate::{PathCx, PathRule, Report, Run, Uses, Watch};
use crate::{Remembers, remembers};

declare_rule! {
    /// A modal macro call (`G66`) is still on when the tool is changed or the program ends.
    ///
    /// ## Why it matters
    /// The macro runs after every block that moves: at the tool change position, and in the next program.
    ///
    /// ## Reported
    /// ```nc,reported,fanuc-mill
    /// O1
    /// G90 G54
    /// G66 P9010 A1.
    /// X10.
    /// X20.
    /// T2 M6
    /// M30
    /// O9010
    /// G1 Z-#1 F100.
    /// M99
    /// ```
    /// ## Not reported
    /// ```nc,quiet,fanuc-mill
    /// O1
    /// G90 G54
    /// G66 P9010 A1.
    /// X10.
    /// X20.
    /// G67
    /// T2 M6
    /// M30
    /// O9010
    /// G1 Z-#1 F100.
    /// M99
    /// ```
    rule "modal-call-left-on" in "macros" {
        summary: "modal macro call left on",
        severity: Warning,
        tier: Path,
        fixable: OnRequest,
        since: "0.1.0",
        run: Run::Path {
            watch: Watch::BLOCKS.union(Watch::ENDS),
            make: || Box::new(ModalCallLeftOn { told: None }),
        },
    }
}

#[derive(Clone, PartialEq)]
struct ModalCallLeftOn {
    /// The block that began what was reported last.
    told: Option<At>,
}

remembers!(ModalCallLeftOn: told);

impl PathRule for ModalCallLeftOn {
    fn memory(&mut self) -> Remembers<'_> {
        Remembers::All(self)
    }

    fn concerns(&self, program: &Uses<'_>) -> bool {
        program.may(|effect| effect == Effect::MacroModal)
    }

    fn block(&mut self, cx: &PathCx<'_>, report: &mut Report<'_>) {
        if let Some(place) = boundary(cx).filter(|_| cx.depth() == 1) {
            self.judge(cx, place, report);
        }
    }

    fn ended(&mut self, cx: &PathCx<'_>, ending: Ending, report: &mut Report<'_>) {
        if ends_at_tape_mark(cx, ending) {
            self.judge(cx, Boundary::ProgramEnd, report);
        }
    }
}

impl ModalCallLeftOn {
    fn judge(&mut self, cx: &PathCx<'_>, place: Boundary, report: &mut Report<'_>) {
        if place == Boundary::ProgramEnd && cx.end_resets(Role::MacroModal) {
            return;
        }
        let is_on = |effect| effect == Effect::MacroModal;
        let Some(ActiveMode::Certain(code)) = left_on(cx, Role::MacroModal, is_on) else { return };
        let fact = Fact::Mode(Role::MacroModal);
        let set_by = cx.definitions().set_by(fact);
        if set_by.is_none() || set_by == self.told {
            return;
        }
        self.told = set_by;
        let name = cx.name_of(code);
        let off = cx.name_of_effect(Effect::MacroModalOff).unwrap_or_default();
        let finding = cx
            .finding(
                &META,
                boundary_range(cx, place),
                format!("the modal macro call is still on {} (`{name}`)", place.words()),
            )
            .label("the next block that moves calls the macro")
            .help(format!("end it with `{off}` before this"))
            .fix_if(cx.block_before(Some(&off)));
        report.add(cx.resting_on(finding, fact, &format!("`{name}`")));
    }
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::{World, check_rule, findings, fixed, only};

    const MACRO: &str = "O9010\nG1 Z-#1 F100.\nM99\n";

    #[test]
    fn told_at_the_first_place_that_it_hurts() {
        check_rule(
            &RULE,
            "fanuc-mill",
            &format!("O1\nG66 P9010 A1.\nX10.\nT2 M6\nX20.\nT3 M6\nM30\n{MACRO}"),
            &expect![[r#"
                4 | T2 M6
                  |    ^^ warning[modal-call-left-on] the modal macro call is still on at the tool change (`G66`)
            "#]],
        );
    }

    #[test]
    fn the_fix_ends_it_before() {
        let program = format!("O1\nG66 P9010 A1.\nX10.\nT2 M6\nM30\n{MACRO}");
        let found = findings(&only(&RULE), "fanuc-mill", &program, &World::default());
        assert_eq!(fixed(&program, &found[0]), format!("O1\nG66 P9010 A1.\nX10.\nG67\nT2 M6\nM30\n{MACRO}"));
    }
}
