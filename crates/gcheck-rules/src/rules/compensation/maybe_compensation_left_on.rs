//! Cutter compensation that may be left on.

use gcheck_engine::{Ending, Role};

use crate::declare::declare_rule;
use crate::facts::boundary::{Boundary, boundary, ends_at_tape_mark};
use crate::facts::compensation::{is_on, left_on_finding};
use crate::facts::modes::{ActiveMode, left_on};
use crate::{PathCx, PathRule, Report, Run, Severity, Watch};

declare_rule! {
    /// On some paths of the program cutter compensation is still on when the tool is changed or the program ends; on
    /// others it is off.
    ///
    /// ## Why it matters
    /// The program runs well until the other path is taken. Then the next tool begins with the offset of the last one.
    ///
    /// ## Reported
    /// ```nc,reported,fanuc-mill
    /// G41 D1 G1 X10. F100.
    /// Y20.
    /// IF [#500 EQ 1] GOTO 5
    /// G40 X0.
    /// N5 G0 Z50.
    /// T2 M6
    /// M30
    /// ```
    /// ## Not reported
    /// ```nc,quiet,fanuc-mill
    /// G41 D1 G1 X10. F100.
    /// IF [#500 EQ 1] GOTO 5
    /// Y20.
    /// N5 G40 X0.
    /// T2 M6
    /// M30
    /// ```
    rule "maybe-compensation-left-on" in "compensation" {
        summary: "cutter compensation may be left on",
        severity: Warning,
        tier: Path,
        since: "0.1.0",
        run: Run::Path { watch: Watch::BLOCKS.union(Watch::ENDS), make: || Box::new(MaybeCompensationLeftOn) },
    }
}

struct MaybeCompensationLeftOn;

impl PathRule for MaybeCompensationLeftOn {
    fn block(&mut self, cx: &PathCx<'_>, report: &mut Report<'_>) {
        if let Some(place) = boundary(cx) {
            judge(cx, place, report);
        }
    }

    fn ended(&mut self, cx: &PathCx<'_>, ending: Ending, report: &mut Report<'_>) {
        if ends_at_tape_mark(cx, ending) {
            judge(cx, Boundary::ProgramEnd, report);
        }
    }
}

fn judge(cx: &PathCx<'_>, place: Boundary, report: &mut Report<'_>) {
    let Some(ActiveMode::Possible(code)) = left_on(cx, Role::Compensation, is_on) else { return };
    if place == Boundary::ProgramEnd && cx.end_resets(Role::Compensation) {
        return;
    }
    let message = format!("cutter compensation may still be on {} (`{}`)", place.words(), cx.name_of(code));
    let finding = cx.with_path(left_on_finding(cx, &META, place, message));
    report.add(if cx.model.semantics().compensation.freezes_modes {
        finding
    } else {
        finding.at_most(Severity::Info)
    });
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::{World, check_rule, findings, only, words};

    #[test]
    fn a_program_that_is_not_at_hand_says_nothing() {
        check_rule(&RULE, "fanuc-mill", "G41 D1 G1 X10. F100.\nM98 P9000\nT2 M6\nM30\n", &expect![[""]]);
    }

    #[test]
    fn both_paths_are_weighed_at_the_end() {
        check_rule(
            &RULE,
            "fanuc-mill",
            "IF [#500 EQ 1] GOTO 5\nG41 D1 G1 X10. F100.\nN5 G0 Z50.\nM30\n",
            &expect![[r#"
                4 | M30
                  | ^^^ info[maybe-compensation-left-on] cutter compensation may still be on at the end of the program (`G41`)
            "#]],
        );
    }

    #[test]
    fn what_it_says() {
        let found = findings(
            &only(&RULE),
            "fanuc-mill",
            "G41 D1 G1 X10. F100.\nIF [#500 EQ 1] GOTO 5\nG40 X0.\nN5 G0 Z50.\nM30\n",
            &World::default(),
        );
        expect![[r#"
            cutter compensation may still be on at the end of the program (`G41`)
              here: the program ends with it
              there: when this is taken
              help: leave the contour on a straight move with `G40` before the tool goes away
        "#]]
        .assert_eq(&found.iter().map(words).collect::<String>());
    }
}
