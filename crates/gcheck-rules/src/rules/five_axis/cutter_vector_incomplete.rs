//! A move under 3D cutter compensation without its direction.

use gcheck_engine::{Event, Role};

use crate::declare::declare_rule;
use crate::facts::five_axis::is_along_vectors;
use crate::facts::modes::resting_on_mode;
use crate::{PathCx, PathRule, Report, Run, Watch};

declare_rule! {
    /// A move under 3D cutter compensation (`G141`) has no direction: none of `I`, `J` and `K`.
    ///
    /// ## Why it matters
    /// Each point needs a direction: without it the control does not know which way to shift the path there. No page
    /// says that the direction of an earlier block stays in effect.
    ///
    /// The block that switches compensation on may go to its point without a direction. Of the three components, those
    /// that are zero may be omitted.
    ///
    /// ## Reported
    /// ```nc,reported,haas-mill
    /// G90 G1 G141 D1 X1. Y0. Z0. I0. J0. K1. F20.
    /// X2.
    /// G40
    /// M30
    /// ```
    /// ## Not reported
    /// ```nc,quiet,haas-mill
    /// G90 G0 G141 D1 X1. Y0. Z0.
    /// G1 X2. Y0. Z0. I0. J0. K1. F20.
    /// X3. Z0. K1.
    /// G40
    /// G0 Z2.
    /// M30
    /// ```
    rule "cutter-vector-incomplete" in "five_axis" {
        summary: "move under 3D cutter compensation without its direction",
        severity: Warning,
        tier: Path,
        since: "0.1.0",
        run: Run::Path { watch: Watch::CHANGES, make: || Box::new(CutterVectorIncomplete) },
    }
}

struct CutterVectorIncomplete;

impl PathRule for CutterVectorIncomplete {
    fn changed(&mut self, cx: &PathCx<'_>, event: &Event, report: &mut Report<'_>) {
        let Event::CutterVector(parts) = event else { return };
        if cx.is_malformed() {
            return;
        }
        let mode = cx.state().mode(Role::Compensation).only();
        let Some(code) = mode.filter(|code| is_along_vectors(cx.model.effect(*code))) else { return };
        // The block that switches it on goes to its point.
        if parts.iter().any(Option::is_some) || cx.has_effect(is_along_vectors) {
            return;
        }
        let name = cx.name_of(code);
        let source = cx.control().code_at(code).map_or("", |code| code.entry().source.as_str());
        let finding = cx
            .finding(
                &META,
                cx.range(),
                format!("move without a direction under 3D cutter compensation (`{name}`)"),
            )
            .label("`I J K` are missing")
            .note(format!(
                "the control needs `I`, `J` and `K` to shift the path in the right direction  [{source}]"
            ))
            .help(format!("write the direction in every block that moves, or end `{name}` with `G40` first"));
        report.add(resting_on_mode(cx, finding, Role::Compensation));
    }
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::check_rule;

    #[test]
    fn a_later_block_without_any_component_is_marked() {
        check_rule(
            &RULE,
            "haas-mill",
            "G90 G1 G141 D1 X1. Y0. Z0. F20.\nX2. Z0. K1.\nX3.\nX4. I#500 J#501 K#502\nF30.\nG40\nG0 X1.\nM30\n",
            &expect![[r#"
                3 | X3.
                  | ^^^ warning[cutter-vector-incomplete] move without a direction under 3D cutter compensation (`G141`)
            "#]],
        );
    }
}
