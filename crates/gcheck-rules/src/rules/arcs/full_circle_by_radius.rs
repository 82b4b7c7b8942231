//! A full circle given by its radius.

use gcheck_engine::{ArcFault, Fault};

use crate::declare::declare_rule;
use crate::facts::arcs::{counts_least_increments, limited_by_modes};
use crate::{PathCx, PathRule, Report, Run, Watch, limit};

declare_rule! {
    /// An arc given by its radius ends where it starts.
    ///
    /// ## Why it matters
    /// Many circles of that radius pass through the point, so the control stops with an alarm or makes no move at all,
    /// and the circle is missing from the part.
    ///
    /// ## Reported
    /// ```nc,reported,linuxcnc
    /// G17 G21 G90 G0 X10 Y0
    /// G2 X10 Y0 R10 F100
    /// M2
    /// ```
    /// ## Not reported
    /// ```nc,quiet,linuxcnc
    /// G17 G21 G90 G0 X10 Y0
    /// G2 X10 Y0 I-10 F100
    /// M2
    /// ```
    rule "full-circle-by-radius" in "arcs" {
        summary: "full circle given by its radius",
        severity: Error,
        tier: Path,
        since: "0.1.0",
        run: Run::Path { watch: Watch::FAULTS, make: || Box::new(FullCircleByRadius) },
    }
}

struct FullCircleByRadius;

impl PathRule for FullCircleByRadius {
    fn fault(&mut self, cx: &PathCx<'_>, fault: &Fault, report: &mut Report<'_>) {
        if *fault != Fault::Arc(ArcFault::FullCircleByRadius) {
            return;
        }
        if counts_least_increments(cx) {
            return;
        }
        let finding = cx
            .finding(&META, cx.letter_range('R'), "arc by radius (`R`) ends where it starts")
            .label("the radius does not say where the centre is")
            .help("give the centre of a full circle (`I`, `J`, `K`), or cut it as two half circles")
            .at_most(limit(cx.model.semantics().arcs.full_circle_confidence()));
        report.add(limited_by_modes(cx, finding));
    }
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::check_rule;

    #[test]
    fn the_radius_is_marked() {
        check_rule(
            &RULE,
            "linuxcnc",
            "G17 G21 G90 G0 X10 Y0\nG2 X10 Y0 R10 F100\nG91 G3 X0 Y0 Z-1 R5\nM2\n",
            &expect![[r#"
                2 | G2 X10 Y0 R10 F100
                  |           ^^^ error[full-circle-by-radius] arc by radius (`R`) ends where it starts
                3 | G91 G3 X0 Y0 Z-1 R5
                  |                  ^^ error[full-circle-by-radius] arc by radius (`R`) ends where it starts
            "#]],
        );
    }

    #[test]
    fn a_manual_that_asks_for_a_centre_makes_it_an_error() {
        let program = "G17 G21 G90 G0 X10. Y0.\nG2 X10. Y0. R10. F100.\nM30\n";
        check_rule(
            &RULE,
            "haas-mill",
            program,
            &expect![[r#"
            2 | G2 X10. Y0. R10. F100.
              |             ^^^^ error[full-circle-by-radius] arc by radius (`R`) ends where it starts
        "#]],
        );
        check_rule(
            &RULE,
            "fanuc-mill",
            program,
            &expect![[r#"
            2 | G2 X10. Y0. R10. F100.
              |             ^^^^ warning[full-circle-by-radius] arc by radius (`R`) ends where it starts
        "#]],
        );
    }

    #[test]
    fn an_end_that_is_not_known_is_not_judged() {
        check_rule(&RULE, "haas-mill", "G17 G90 G0 X1. Y0\nG2 X#100 Y0 R1. F10.\nM30\n", &expect![[""]]);
    }
}
