//! Cutter compensation that is not switched off.

use gcheck_controls::{CompensationRefusals, Effect};
use gcheck_engine::{At, Ending, Fact, Role};

use crate::declare::declare_rule;
use crate::facts::boundary::{Boundary, boundary, ends_at_tape_mark};
use crate::facts::compensation::{is_ended_by_number, is_on, left_on_finding};
use crate::facts::modes::{ActiveMode, left_on};
use crate::{PathCx, PathRule, Report, Run, Severity, Watch, limit};
use crate::{Remembers, remembers};

declare_rule! {
    /// Cutter compensation is still on when the tool is changed or the program ends.
    ///
    /// ## Why it matters
    /// The tool moves to the tool change beside the programmed path, and the next tool begins with the offset of the
    /// last one. Some controls stop with an alarm.
    ///
    /// ## Reported
    /// ```nc,reported,haas-mill
    /// G41 D1 G1 X1. F10.
    /// Y2.
    /// G0 Z5.
    /// T2 M6
    /// M30
    /// ```
    /// ```nc,reported,fanuc-mill
    /// G42 D1 G1 X10. F100.
    /// Y20.
    /// G0 Z50.
    /// M30
    /// ```
    /// ## Not reported
    /// ```nc,quiet,haas-mill
    /// G41 D1 G1 X1. F10.
    /// Y2.
    /// G40 X0.
    /// G0 Z5.
    /// T2 M6
    /// M30
    /// ```
    rule "compensation-left-on" in "compensation" {
        summary: "cutter compensation left on",
        severity: Error,
        tier: Path,
        fixable: OnRequest,
        since: "0.1.0",
        run: Run::Path { watch: Watch::BLOCKS.union(Watch::ENDS), make: || Box::new(CompensationLeftOn { told: None }) },
    }
}

#[derive(Clone, PartialEq)]
struct CompensationLeftOn {
    /// The block that switched on what was reported last.
    told: Option<At>,
}

remembers!(CompensationLeftOn: told);

impl PathRule for CompensationLeftOn {
    fn memory(&mut self) -> Remembers<'_> {
        Remembers::All(self)
    }

    fn block(&mut self, cx: &PathCx<'_>, report: &mut Report<'_>) {
        if let Some(place) = boundary(cx) {
            self.judge(cx, place, report);
        } else if cx.has_effect(is_stop) {
            self.judge_stop(cx, report);
        }
    }

    fn ended(&mut self, cx: &PathCx<'_>, ending: Ending, report: &mut Report<'_>) {
        if ends_at_tape_mark(cx, ending) {
            self.judge(cx, Boundary::ProgramEnd, report);
        }
    }
}

impl CompensationLeftOn {
    fn judge(&mut self, cx: &PathCx<'_>, place: Boundary, report: &mut Report<'_>) {
        let Some(ActiveMode::Certain(code)) = left_on(cx, Role::Compensation, is_on) else { return };
        if is_ended_by_number(cx, code) {
            return;
        }
        let set_by = cx.definitions().set_by(Fact::Mode(Role::Compensation));
        if set_by.is_some() && set_by == self.told {
            return;
        }
        self.told = set_by;
        let name = cx.name_of(code);
        let message = format!("cutter compensation is still on {} (`{name}`)", place.words());
        let finding = left_on_finding(cx, &META, place, message);
        let is_refused = place == Boundary::ToolChange && cx.model.semantics().compensation.freezes_modes;
        let finding = if is_refused {
            finding
                .note("this control refuses a tool change under cutter compensation")
                .at_most(limit(cx.model.semantics().confidence))
        } else if place == Boundary::ProgramEnd
            && let Some(refusals) = refused_at_end(cx)
        {
            finding
                .note(format!("this control stops with an alarm  [{}]", refusals.source))
                .at_most(limit(refusals.confidence))
        } else if place == Boundary::ProgramEnd && cx.end_resets(Role::Compensation) {
            finding
                .note("the end of the program switches it off on this control; the retract was made beside the programmed path")
                .at_most(Severity::Info)
        } else {
            finding.at_most(Severity::Warning)
        };
        let finding = finding.fix_if(cx.block_before(cx.name_of_effect(Effect::CompensationOff).as_deref()));
        report.add(cx.resting_on(finding, Fact::Mode(Role::Compensation), &format!("`{name}`")));
    }
}

impl CompensationLeftOn {
    /// A stop under compensation, where the control refuses it.
    fn judge_stop(&mut self, cx: &PathCx<'_>, report: &mut Report<'_>) {
        let Some(refusals) = refused_at_end(cx) else { return };
        let Some(ActiveMode::Certain(code)) = left_on(cx, Role::Compensation, is_on) else { return };
        if is_ended_by_number(cx, code) {
            return;
        }
        let set_by = cx.definitions().set_by(Fact::Mode(Role::Compensation));
        if set_by.is_some() && set_by == self.told {
            return;
        }
        self.told = set_by;
        let name = cx.name_of(code);
        let off = cx.name_of_effect(Effect::CompensationOff).unwrap_or_default();
        let finding = cx
            .finding(
                &META,
                cx.effect_range(is_stop),
                format!("cutter compensation is still on at a stop of the program (`{name}`)"),
            )
            .label("the program stops with it")
            .note(format!("this control stops with an alarm  [{}]", refusals.source))
            .help(format!("leave the contour on a straight move with `{off}` before the stop"))
            .at_most(limit(refusals.confidence));
        // Only a switch of the panel makes it a stop.
        let finding = if cx.has_effect(|effect| effect == Effect::OptionalStop) {
            finding.at_most(Severity::Warning)
        } else {
            finding
        };
        report.add(cx.resting_on(finding, Fact::Mode(Role::Compensation), &format!("`{name}`")));
    }
}

fn is_stop(effect: Effect) -> bool {
    matches!(effect, Effect::Stop | Effect::OptionalStop)
}

/// What the manual says, where the control refuses an end of the program under compensation.
fn refused_at_end<'a>(cx: &PathCx<'a>) -> Option<&'a CompensationRefusals> {
    cx.model.semantics().compensation.refuses.as_ref().filter(|refusals| refusals.ends)
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::{World, check_rule, findings, only, words};

    #[test]
    fn the_number_of_no_offset_ends_it() {
        check_rule(
            &RULE,
            "haas-mill",
            "G20 G90 G54 G0 X0. Y0. S900 M3\nG43 H1 Z0.1\nG41 D1 G1 X0.5 F20.\nX1.\nG1 D0 X2.\nG0 Z1.\nM30\n",
            &expect![[""]],
        );
    }

    #[test]
    fn a_control_that_refuses_it_makes_it_an_error() {
        check_rule(
            &RULE,
            "linuxcnc",
            "G21 G41 D1 G1 X10 F100\nY20\nT2 M6\nM2\n",
            &expect![[r#"
            3 | T2 M6
              |    ^^ error[compensation-left-on] cutter compensation is still on at the tool change (`G41`)
        "#]],
        );
    }

    #[test]
    fn an_end_that_resets_it_is_worth_knowing() {
        check_rule(
            &RULE,
            "haas-lathe",
            "G41 G1 X1. F.01\nZ-2.\nM30\n",
            &expect![[r#"
            3 | M30
              | ^^^ info[compensation-left-on] cutter compensation is still on at the end of the program (`G41`)
        "#]],
        );
    }

    #[test]
    fn a_control_that_refuses_the_end_makes_it_an_error() {
        check_rule(
            &RULE,
            "haas-mill",
            "G41 D1 G1 X1. F10.\nY2.\nM30\n",
            &expect![[r#"
            3 | M30
              | ^^^ error[compensation-left-on] cutter compensation is still on at the end of the program (`G41`)
        "#]],
        );
        check_rule(
            &RULE,
            "haas-mill",
            "G41 D1 G1 X1. F10.\nY2.\nM1\nG40 X0.\nM30\n",
            &expect![[r#"
            3 | M1
              | ^^ warning[compensation-left-on] cutter compensation is still on at a stop of the program (`G41`)
        "#]],
        );
    }

    #[test]
    fn switched_off_in_the_same_block_is_off() {
        check_rule(&RULE, "fanuc-mill", "G41 D1 G1 X10. F100.\nY20.\nG40 M30\n", &expect![[""]]);
    }

    #[test]
    fn a_turret_is_indexed_by_t() {
        check_rule(
            &RULE,
            "fanuc-lathe",
            "T0101\nG42 G1 X10. F.2\nZ-20.\nT0111\nG0 X50.\nT0202\nG40 G0 X60.\nM30\n",
            &expect![[r#"
                6 | T0202
                  | ^^^^^ warning[compensation-left-on] cutter compensation is still on at the tool change (`G42`)
            "#]],
        );
    }

    #[test]
    fn on_some_path_only_is_left_to_the_sibling() {
        check_rule(
            &RULE,
            "fanuc-mill",
            "G41 D1 G1 X10. F100.\nIF [#500 EQ 1] GOTO 5\nG40 X0.\nN5 G0 Z50.\nM30\n",
            &expect![[""]],
        );
    }

    #[test]
    fn what_it_says() {
        let found = findings(
            &only(&RULE),
            "fanuc-mill",
            "G41 D1 G1 X10. F100.\nG0 Z50.\nT2 M6\nM30\n",
            &World::default(),
        );
        expect![[r#"
            cutter compensation is still on at the tool change (`G41`)
              here: the next tool begins with it
              there: `G41` set here
              help: leave the contour on a straight move with `G40` before the tool goes away
              fix (unsafe): put `G40` in a block before this one
        "#]]
        .assert_eq(&found.iter().map(words).collect::<String>());
    }
}
