//! A rotation that the program leaves on.

use gcheck_controls::Effect;
use gcheck_engine::{Ending, Role};

use crate::boundary::Boundary;
use crate::meta::declare_rule;
use crate::{PathCx, PathRule, Report, Run, Watch};

declare_rule! {
    /// The rotation of coordinates is still on where the program ends.
    ///
    /// ## Why it matters
    /// The next program, or the next part, is cut turned.
    ///
    /// ## Reported
    /// ```nc,reported,fanuc-mill
    /// G68 X0. Y0. R30.
    /// G1 X10. F100.
    /// M30
    /// ```
    /// ## Not reported
    /// ```nc,quiet,fanuc-mill
    /// G68 X0. Y0. R30.
    /// G1 X10. F100.
    /// G69
    /// M30
    /// ```
    /// Some controls switch it off themselves at the end of the program.
    /// ```nc,quiet,haas-mill
    /// G68 X0. Y0. R30.
    /// G1 X1. F10.
    /// M30
    /// ```
    rule "rotation-left-on" in "offsets" {
        summary: "rotation left on",
        severity: Warning,
        tier: Path,
        mends: OnRequest,
        since: "0.1.0",
        run: Run::Path { watch: Watch::BLOCKS.union(Watch::ENDS), make: || Box::new(RotationLeftOn) },
    }
}

struct RotationLeftOn;

impl PathRule for RotationLeftOn {
    fn block(&mut self, cx: &PathCx<'_>, report: &mut Report<'_>) {
        if cx.boundary() == Some(Boundary::ProgramEnd) {
            judge(cx, report);
        }
    }

    fn ended(&mut self, cx: &PathCx<'_>, ending: Ending, report: &mut Report<'_>) {
        if cx.ends_at_tape_mark(ending) {
            judge(cx, report);
        }
    }
}

fn judge(cx: &PathCx<'_>, report: &mut Report<'_>) {
    let is_on = |effect| effect == Effect::RotationOn;
    let Some(finding) = cx.left_at_end(&META, Role::Rotation, is_on, "the rotation") else { return };
    let cancel = cx.cancel_of(Effect::RotationOff).unwrap_or_default();
    report.add(
        finding
            .assuming("the end of the program keeps it, as the control's book leaves to a parameter")
            .help(format!("switch the rotation off with `{cancel}` before the program ends"))
            .fix_if(cx.block_before(Some(&cancel))),
    );
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::Selection;
    use crate::testing::{World, check_rule, findings, words};

    #[test]
    fn the_end_is_marked_and_the_code_named() {
        check_rule(
            &RULE,
            "fanuc-mill",
            "G68 X0. Y0. R30.\nG1 X10. F100.\nG0 Z50. M30\n",
            &expect![[r#"
            3 | G0 Z50. M30
              |         ^^^ warning[rotation-left-on] the rotation is still on at the end of the program (`G68`)
        "#]],
        );
    }

    #[test]
    fn off_on_some_path_is_not_on() {
        check_rule(
            &RULE,
            "fanuc-mill",
            "G68 X0. Y0. R30.\nIF [#1 EQ 1] GOTO 5\nG69\nN5 M30\n",
            &expect![[""]],
        );
    }

    #[test]
    fn what_it_says() {
        let found = findings(
            &Selection::only(&RULE),
            "fanuc-mill",
            "G68 X0. Y0. R30.\nG1 X10. F100.\nM30\n",
            &World::default(),
        );
        expect![[r#"
            the rotation is still on at the end of the program (`G68`)
              here: what runs next begins with it
              there: `G68` set here
              assuming: the end of the program keeps it, as the control's book leaves to a parameter
              help: switch the rotation off with `G69` before the program ends
              fix (unsafe): put `G69` in a block before this one
        "#]]
        .assert_eq(&found.iter().map(words).collect::<String>());
    }
}
