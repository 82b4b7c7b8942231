//! An arc whose radius does not reach its end.

use gcheck_engine::{ArcFault, Fault};
use gcheck_geometry::Mm;

use crate::declare::declare_rule;
use crate::facts::arcs::{counts_least_increments, limited_by_arc_facts};
use crate::{PathCx, PathRule, Report, Run, Watch};

declare_rule! {
    /// The end of an arc is further from its start than twice the radius, so no circle of that radius passes through
    /// both.
    ///
    /// ## Why it matters
    /// The control stops with an alarm in the middle of the cut.
    ///
    /// ## Reported
    /// ```nc,reported,linuxcnc
    /// G17 G21 G90 G0 X0 Y0
    /// G2 X10 Y0 R4 F100
    /// M2
    /// ```
    /// ## Not reported
    /// Half a circle, with the last digit rounded.
    /// ```nc,quiet,linuxcnc
    /// G17 G21 G90 G0 X0 Y0
    /// G2 X10.001 Y0 R5 F100
    /// M2
    /// ```
    rule "arc-radius-too-small" in "arcs" {
        summary: "arc whose radius does not reach its end",
        severity: Error,
        tier: Path,
        since: "0.1.0",
        run: Run::Path { watch: Watch::FAULTS, make: || Box::new(ArcRadiusTooSmall) },
    }
}

struct ArcRadiusTooSmall;

impl PathRule for ArcRadiusTooSmall {
    fn fault(&mut self, cx: &PathCx<'_>, fault: &Fault, report: &mut Report<'_>) {
        let Fault::Arc(ArcFault::RadiusTooSmall { half_chord, radius }) = *fault else { return };
        if counts_least_increments(cx) {
            return;
        }
        let finding = cx
            .finding(&META, cx.letter_range('R'), "arc radius (`R`) does not reach the end point")
            .label(format!(
                "{}, and the end is {} away",
                cx.shown(Mm(radius)),
                cx.shown(Mm(2.0 * half_chord))
            ))
            .note(format!("an arc to this end needs a radius of {} or more", cx.shown(Mm(half_chord))))
            .help("check the radius, the end point, and where the block before ends");
        report.add(limited_by_arc_facts(cx, finding));
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
            "G17 G21 G90 G0 X0 Y0\nG2 X10 Y0 R4 F100\nX20 R-5\nX30 R-1\nM2\n",
            &expect![[r#"
                2 | G2 X10 Y0 R4 F100
                  |           ^^ error[arc-radius-too-small] arc radius (`R`) does not reach the end point
                4 | X30 R-1
                  |     ^^^ error[arc-radius-too-small] arc radius (`R`) does not reach the end point
            "#]],
        );
    }

    #[test]
    fn a_tolerance_that_is_only_assumed_gives_a_warning() {
        check_rule(
            &RULE,
            "haas-mill",
            "G17 G21 G90 G0 X0 Y0\nG2 X10. Y0 R4. F100.\nM30\n",
            &expect![[r#"
            2 | G2 X10. Y0 R4. F100.
              |            ^^^ warning[arc-radius-too-small] arc radius (`R`) does not reach the end point
        "#]],
        );
    }

    #[test]
    fn a_radius_of_unknown_size_is_not_judged() {
        check_rule(&RULE, "haas-mill", "G17 G90 G0 X0 Y0\nG2 X10. Y0 R#100 F100.\nM30\n", &expect![[""]]);
    }
}
