//! A loose tolerance of one tool's work that the next tool cuts with.

use gcheck_controls::Effect;
use gcheck_engine::{At, Event, Fact, PathMode, Role};
use gcheck_geometry::Mm;

use crate::declare::declare_rule;
use crate::facts::boundary::{Boundary, boundary, is_before, with_tool_change};
use crate::facts::cutting::is_cut;
use crate::facts::edge::cuts_across;
use crate::facts::smoothing::SmoothingTolerance;
use crate::{PathCx, PathRule, Report, Run, Uses, Watch};
use crate::{Remembers, remembers};

declare_rule! {
    /// A tool mills with a loose tolerance (more than 0.1 mm, 0.004 inch) that the work of the tool before gave: `G64 P`,
    /// `G187 E`.
    ///
    /// A tolerance from before the first tool is meant for all of them.
    ///
    /// ## Why it matters
    /// The control may leave the path by the tolerance at each corner. What is right for roughing takes the edges and small
    /// radii off where the next tool finishes.
    ///
    /// ## Reported
    /// ```nc,reported,linuxcnc
    /// G21 G90 G94 G17 G64 P0.01
    /// T1 M6
    /// G64 P0.5
    /// G0 X0 Y0
    /// G1 X10 F500
    /// T2 M6
    /// G0 X0 Y0
    /// G1 X10 F200
    /// M2
    /// ```
    /// ```nc,reported,haas-mill
    /// T1 M6
    /// G21 G90 G0 X0. Y0.
    /// G187 P1 E0.5
    /// G1 X10. F500.
    /// T2 M6
    /// G0 X0. Y0.
    /// G1 X10. F200.
    /// M30
    /// ```
    /// ## Not reported
    /// ```nc,quiet,linuxcnc
    /// G21 G90 G94 G17 G64 P0.5
    /// T1 M6
    /// G0 X0 Y0
    /// G1 X10 F500
    /// T2 M6
    /// G0 X0 Y0
    /// G1 X10 F200
    /// M2
    /// ```
    /// ```nc,quiet,haas-mill
    /// T1 M6
    /// G21 G90 G0 X0. Y0.
    /// G187 P1 E0.5
    /// G1 X10. F500.
    /// G187
    /// T2 M6
    /// G0 X0. Y0.
    /// G1 X10. F200.
    /// M30
    /// ```
    rule "tolerance-of-tool-before" in "motion" {
        summary: "loose tolerance of the tool before",
        severity: Info,
        tier: Path,
        since: "0.1.0",
        run: Run::Path {
            watch: Watch::BLOCKS.union(Watch::CHANGES).union(Watch::CUTS),
            make: || Box::new(ToleranceOfToolBefore::default()),
        },
    }
}

/// Millimetres: more than a finishing pass takes.
const LOOSE: f64 = 0.1;

#[derive(Default, Clone, PartialEq)]
struct ToleranceOfToolBefore {
    /// Where the first tool comes.
    first_tool: Option<At>,
    smoothing: SmoothingTolerance,
    /// The block whose tolerance was told.
    told: Option<At>,
}

remembers!(ToleranceOfToolBefore: first_tool, smoothing, told);

impl ToleranceOfToolBefore {
    /// The loose tolerance in effect: the block that gave it, its millimetres, its code and word.
    fn loose(&self, cx: &PathCx<'_>) -> Option<(At, f64, Effect, char)> {
        if let Some((set, tolerance)) = self.smoothing.in_effect(cx).filter(|(_, mm)| *mm > LOOSE) {
            return Some((set, tolerance, Effect::Smoothing, 'E'));
        }
        let Some(PathMode::Blending { tolerance, .. }) = cx.state().path_mode(cx.model) else { return None };
        let set = cx.definitions().set_by(Fact::Mode(Role::PathControl))?;
        (tolerance.0 > LOOSE).then_some((set, tolerance.0, Effect::PathBlending, 'P'))
    }
}

impl PathRule for ToleranceOfToolBefore {
    fn memory(&mut self) -> Remembers<'_> {
        Remembers::All(self)
    }

    fn concerns(&self, program: &Uses<'_>) -> bool {
        program.may(Effect::sets_path_tolerance)
    }

    fn block(&mut self, cx: &PathCx<'_>, _: &mut Report<'_>) {
        if boundary(cx) == Some(Boundary::ToolChange) {
            self.first_tool.get_or_insert(cx.origin().at);
        }
    }

    fn changed(&mut self, cx: &PathCx<'_>, event: &Event, _: &mut Report<'_>) {
        self.smoothing.changed(cx, event);
    }

    fn cut(&mut self, cx: &PathCx<'_>, event: &Event, report: &mut Report<'_>) {
        let Some((set, tolerance, effect, letter)) = self.loose(cx) else { return };
        let Some(first) = self.first_tool.filter(|_| self.told != Some(set)) else { return };
        let Some(changed) = cx.definitions().set_by(Fact::Tool) else { return };
        if !is_before(first, set) || !is_before(set, changed) || !is_cut(cx, event) || !cuts_across(event) {
            return;
        }
        self.told = Some(set);
        let name = cx.name_of_effect(effect).unwrap_or_default();
        let finding = cx
            .finding(
                &META,
                cx.range(),
                format!("the tool cuts with the tolerance of the tool before (`{name} {letter}`)"),
            )
            .label(format!("the path may be {} off at corners", cx.shown(Mm(tolerance))))
            .help(format!("give the tolerance of this tool before it cuts: `{name} {letter}`"));
        let finding = with_tool_change(cx, finding);
        report.add(match cx.range_of(set) {
            Some(range) => finding.also(range, "the tolerance is given here"),
            None => finding,
        });
    }
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::check_rule;

    #[test]
    fn each_tolerance_is_told_once() {
        check_rule(
            &RULE,
            "haas-mill",
            "T1 M6\nG20 G90 G0 X0. Y0.\nG187 P1 E0.02\nG1 X1. F50.\nT2 M6\nG1 X2. F20.\nX3.\nT3 M6\nX4.\nM30\n",
            &expect![[r#"
                6 | G1 X2. F20.
                  | ^^^^^^^^^^^ info[tolerance-of-tool-before] the tool cuts with the tolerance of the tool before (`G187 E`)
            "#]],
        );
    }

    #[test]
    fn a_drill_leaves_no_corners() {
        check_rule(
            &RULE,
            "linuxcnc",
            "G21 G90 G17\nT1 M6\nG64 P0.5\nG1 X10 F500\nT2 M6\nG81 X1 Y1 Z-5 R1 F100\nG80\nM2\n",
            &expect![[""]],
        );
    }
}
