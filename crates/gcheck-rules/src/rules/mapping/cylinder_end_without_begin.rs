//! The end of a cylindrical mapping that never began.

use gcheck_controls::{Effect, LetterSet};
use gcheck_engine::At;
use gcheck_program::BlockFlags;

use crate::declare::declare_rule;
use crate::{PathCx, PathRule, Report, Run, Watch};
use crate::{Remembers, remembers};

declare_rule! {
    /// `G107` alone ends cylindrical mapping, and no mapping is on: the `G107` before it named no linear axis, so it
    /// set the diameter of the cylinder and nothing more.
    ///
    /// ## Why it matters
    /// The moves between the two were meant to turn the part. The linear axis made them straight instead, off the
    /// cylinder.
    ///
    /// ## Reported
    /// ```nc,reported,haas-mill
    /// G21 G90 G54 G0 X0. Y0. A0.
    /// G107 A0. Q50.
    /// G1 Y150. F100.
    /// G107
    /// M30
    /// ```
    /// ## Not reported
    /// A default diameter is set, and mapping uses it later.
    /// ```nc,quiet,haas-mill
    /// G21 G90 G54 G0 X0. Y0. A0.
    /// G107 A0. Q50.
    /// G107 Y0. A0.
    /// G1 Y150. F100.
    /// G107
    /// M30
    /// ```
    rule "cylinder-end-without-begin" in "mapping" {
        summary: "end of a cylindrical mapping that never began",
        severity: Warning,
        tier: Path,
        since: "0.1.0",
        run: Run::Path { watch: Watch::BLOCKS, make: || Box::new(CylinderEndWithoutBegin { sized: None }) },
    }
}

#[derive(Clone, PartialEq)]
struct CylinderEndWithoutBegin {
    /// The last block that set a diameter without beginning a mapping, if no mapping began since.
    sized: Option<(At, std::ops::Range<u32>)>,
}

remembers!(CylinderEndWithoutBegin: sized);

/// A word of these begins mapping.
const LINEAR: LetterSet = LetterSet::of("XYZ");
/// Words of a cylinder.
const OF_CYLINDER: LetterSet = LetterSet::of("XYZABCQR");

impl PathRule for CylinderEndWithoutBegin {
    fn memory(&mut self) -> Remembers<'_> {
        Remembers::All(self)
    }

    fn block(&mut self, cx: &PathCx<'_>, report: &mut Report<'_>) {
        let is_mapping = |effect| effect == Effect::CylinderMapping;
        if !cx.has_effect(is_mapping) {
            return;
        }
        let letters = cx.origin().letters;
        // What cannot be read may have named the axis.
        if letters.intersects(LINEAR) || cx.origin().flags.contains(BlockFlags::ERROR) {
            self.sized = None;
        } else if letters.intersects(OF_CYLINDER) {
            self.sized = Some((cx.origin().at, cx.range()));
        } else if let Some((_, sized)) = self.sized.take()
            && !cx.state().may_be_wrapped()
        {
            let name = cx.name_of_effect(Effect::CylinderMapping).unwrap_or_default();
            let range = cx.effect_range(is_mapping);
            report.add(
                cx.finding(
                    &META,
                    range,
                    format!("no cylindrical mapping is on that this could end (`{name}`)"),
                )
                .label("the moves before it were straight")
                .also(sized, "sets the diameter alone: no `X`, `Y` or `Z`")
                .help(format!("name the axis to wrap where mapping is to begin: `{name} Y0. A0.`")),
            );
        }
    }
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::check_rule;

    #[test]
    fn the_end_is_marked() {
        check_rule(
            &RULE,
            "haas-mill",
            "G20 G90 G54 G0 X0. Y0. A0.\nG107 A0 Q2.5\nG1 Y7.854 F15.\nG107\nM30\n",
            &expect![[r#"
                4 | G107
                  | ^^^^ warning[cylinder-end-without-begin] no cylindrical mapping is on that this could end (`G107`)
            "#]],
        );
    }

    #[test]
    fn an_end_for_safety_is_fine() {
        check_rule(&RULE, "haas-mill", "G107\nG90 G54 G0 X0. Y0. A0.\nM30\n", &expect![[""]]);
        check_rule(
            &RULE,
            "haas-mill",
            "G90 G54 G0 X0. Y0. A0.\nG107 Y0. A0. Q2.5\nG1 Y1. F10.\nG107 A0. Q3.\nG107\nM30\n",
            &expect![[""]],
        );
    }
}
