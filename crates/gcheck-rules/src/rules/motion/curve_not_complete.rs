//! A curve by control points that does not begin, or has too few points.

use gcheck_controls::Effect;
use gcheck_engine::Fault;

use crate::declare::declare_rule;
use crate::facts::usage::may_be_called;
use crate::{PathCx, PathRule, Report, Run, Severity, Uses, Watch, limit};
use crate::{Remembers, remembers};

declare_rule! {
    /// The code that cuts a curve through the control points before it (`G5.3`) finds no curve that began (`G5.2`), or fewer
    /// points than the order of the curve needs.
    ///
    /// ## Why it matters
    /// The control stops with an error, and nothing is cut.
    ///
    /// ## Reported
    /// ```nc,reported,linuxcnc
    /// G21 G90 F100
    /// G0 X0 Y0
    /// G5.3
    /// M2
    /// ```
    /// ```nc,reported,linuxcnc
    /// G21 G90 F100
    /// G0 X0 Y0
    /// G5.2 P1 X1 Y1
    /// G5.3
    /// M2
    /// ```
    /// ## Not reported
    /// ```nc,quiet,linuxcnc
    /// G21 G90 F100
    /// G0 X0 Y0
    /// G5.2 P1 L3
    /// X0 Y1 P1
    /// X2 Y2 P1
    /// G5.3
    /// M2
    /// ```
    rule "curve-not-complete" in "motion" {
        summary: "curve that does not begin, or has too few points",
        severity: Error,
        tier: Path,
        since: "0.1.0",
        run: Run::Path { watch: Watch::BLOCKS.union(Watch::FAULTS), make: || Box::new(CurveNotComplete::default()) },
    }
}

#[derive(Default, Clone, PartialEq)]
struct CurveNotComplete {
    /// A curve was begun, whether or not the control took its points.
    is_begun: bool,
    /// As it was before the block under way.
    was_begun: bool,
}

remembers!(CurveNotComplete);

impl PathRule for CurveNotComplete {
    fn concerns(&self, program: &Uses<'_>) -> bool {
        program.may(|effect| effect == Effect::NurbsClose)
    }

    fn memory(&mut self) -> Remembers<'_> {
        Remembers::All(self)
    }

    fn block(&mut self, cx: &PathCx<'_>, _: &mut Report<'_>) {
        self.was_begun = self.is_begun;
        if cx.has_effect(|effect| matches!(effect, Effect::NurbsOpen | Effect::NurbsClose)) {
            self.is_begun = cx.has_effect(|effect| effect == Effect::NurbsOpen);
        }
    }

    fn fault(&mut self, cx: &PathCx<'_>, fault: &Fault, report: &mut Report<'_>) {
        let closes = |effect: Effect| effect == Effect::NurbsClose;
        if !cx.has_effect(closes) {
            return;
        }
        let begin = cx.name_of_effect(Effect::NurbsOpen).unwrap_or_default();
        let end = cx.name_of_effect(Effect::NurbsClose).unwrap_or_default();
        let (message, label, help) = match fault {
            // Points that the control refuses are reported in their blocks.
            Fault::NoMotionMode if !self.was_begun => (
                format!("end of a curve that did not begin (`{end}`)"),
                format!("`{begin}` does not come before it"),
                format!("begin the curve with `{begin}`, then give its control points"),
            ),
            Fault::TooFewPoints => (
                format!("curve with too few control points (`{end}`)"),
                "fewer points than the order of the curve, its start included".to_owned(),
                format!("give more control points, or a lower order (`L`) in the block of `{begin}`"),
            ),
            _ => return,
        };
        let Some(code) = cx.control().codes().find(|code| closes(code.effect())) else { return };
        let entry = code.entry();
        let finding = cx
            .finding(&META, cx.effect_range(closes), message)
            .label(label)
            .note(format!(
                "`{end}` ({}) cuts the curve of the points since `{begin}`  [{}]",
                entry.title, entry.source
            ))
            .help(help)
            .at_most(limit(entry.confidence));
        // A caller may have begun the curve.
        let is_own = *fault == Fault::TooFewPoints || !may_be_called(cx.file_index);
        report.add(if is_own { finding } else { finding.at_most(Severity::Warning) });
    }
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::check_rule;

    #[test]
    fn a_curve_whose_points_are_refused_did_begin() {
        check_rule(
            &RULE,
            "linuxcnc",
            "G21 G90 G18 F100\nG0 X0 Z0\nG5.2 P1 L3\nX0 Z1 P1\nX2 Z2 P1\nG5.3\nM2\n",
            &expect![[""]],
        );
    }

    #[test]
    fn points_are_counted_with_the_start() {
        check_rule(
            &RULE,
            "linuxcnc",
            "G21 G90 F100\nG0 X0 Y0\nG5.2 P1 L4\nX0 Y1 P1\nX2 Y2 P1\nG5.3\nG5.2 P1\nX0 Y1 P1\nX2 Y2 P1\nG5.3\nG5.3\nM2\n",
            &expect![[r#"
                6 | G5.3
                  | ^^^^ error[curve-not-complete] curve with too few control points (`G5.3`)
                11 | G5.3
                   | ^^^^ error[curve-not-complete] end of a curve that did not begin (`G5.3`)
            "#]],
        );
    }
}
