//! A move that the control does not make in the selected plane.

use gcheck_engine::{Fact, Fault, Role};

use crate::declare::declare_rule;
use crate::{PathCx, PathRule, Report, Run, Watch, limit};

declare_rule! {
    /// A curve, an arc or a cycle is in a plane in which the control does not make it.
    ///
    /// ## Why it matters
    /// The control stops with an alarm at the block.
    ///
    /// ## Reported
    /// ```nc,reported,linuxcnc
    /// G21 G90 G18 F100
    /// G0 X0 Y0
    /// G5 X1 Y1 I0 J1 P1 Q1
    /// M2
    /// ```
    /// ## Not reported
    /// ```nc,quiet,linuxcnc
    /// G21 G90 G17 F100
    /// G0 X0 Y0
    /// G5 X1 Y1 I0 J1 P1 Q1
    /// M2
    /// ```
    rule "refused-in-plane" in "modal" {
        summary: "move that the control does not make in this plane",
        severity: Error,
        tier: Path,
        since: "0.1.0",
        run: Run::Path { watch: Watch::FAULTS, make: || Box::new(RefusedInPlane) },
    }
}

struct RefusedInPlane;

impl PathRule for RefusedInPlane {
    fn fault(&mut self, cx: &PathCx<'_>, fault: &Fault, report: &mut Report<'_>) {
        let Fault::NotNow(motion, Some(plane)) = *fault else { return };
        let (Some(motion), Some(plane)) =
            (cx.code_of(motion), Some(plane).filter(|ix| cx.model.role(*ix) == Some(Role::Plane)))
        else {
            return;
        };
        let (name, plane, entry) = (motion.number(), cx.name_of(plane), motion.entry());
        let range = cx.word_range(|word| {
            cx.control().code_at(word.code).is_some_and(|code| code.number() == motion.number())
        });
        let finding = cx
            .finding(&META, range, format!("`{name}` does not work in this plane (`{plane}`)"))
            .label(entry.title.as_str())
            .note(format!(
                "`{name}` ({}) is refused in the plane of `{plane}`  [{}]",
                entry.title, entry.source
            ))
            .help("select the plane of the move before it, on a mill `G17`")
            .at_most(limit(entry.confidence));
        report.add(cx.resting_on(finding, Fact::Mode(Role::Plane), &format!("`{plane}`")));
    }
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::{World, check_rule, findings, only, words};

    #[test]
    fn the_code_is_marked() {
        check_rule(
            &RULE,
            "linuxcnc",
            "G21 G90 G19 F100\nG0 X0 Y0\nG5.1 X4 I2 J-6\nG17\nG5.1 X4 I2 J-6\nM2\n",
            &expect![[r#"
                3 | G5.1 X4 I2 J-6
                  | ^^^^ error[refused-in-plane] `G5.1` does not work in this plane (`G19`)
            "#]],
        );
    }

    #[test]
    fn planes_of_secondary_axes() {
        check_rule(
            &RULE,
            "linuxcnc",
            "G21 G90 G17.1 F100\nG0 X0 Y0\nG2 X10 Y0 I5\nM2\n",
            &expect![[r#"
                3 | G2 X10 Y0 I5
                  | ^^ error[refused-in-plane] `G2` does not work in this plane (`G17.1`)
            "#]],
        );
    }

    #[test]
    fn what_is_said() {
        let program = "G21 G90 G18 F100\nG0 X0 Y0\nG5 X1 Y1 I0 J1 P1 Q1\nM2\n";
        let found = findings(&only(&RULE), "linuxcnc", program, &World::default());
        expect![[r#"
            `G5` does not work in this plane (`G18`)
              here: cubic spline
              there: `G18` set here
              note: `G5` (cubic spline) is refused in the plane of `G18`  [LCNC-G; RS274-2.9]
              help: select the plane of the move before it, on a mill `G17`
        "#]]
        .assert_eq(&found.iter().map(words).collect::<String>());
    }
}
