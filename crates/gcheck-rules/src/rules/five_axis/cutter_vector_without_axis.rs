//! A direction of 3D cutter compensation along an axis that its block does not name.

use gcheck_engine::{Axis, Event, Role};

use crate::declare::declare_rule;
use crate::facts::five_axis::is_along_vectors;
use crate::facts::modes::resting_on_mode;
use crate::{PathCx, PathRule, Report, Run, Watch};

declare_rule! {
    /// A block under 3D cutter compensation (`G141`) has a direction along an axis, and no word for that axis: `J`
    /// without `Y`.
    ///
    /// ## Why it matters
    /// The control shifts the axes that the block names and no others. The surface is off by the offset of the tool in
    /// that axis, although the direction is written.
    ///
    /// ## Reported
    /// ```nc,reported,haas-mill
    /// G90 G0 G141 D1 X0. Y0. Z0.
    /// G1 X5. I0. J-1. K0. F20.
    /// G40
    /// M30
    /// ```
    /// ## Not reported
    /// ```nc,quiet,haas-mill
    /// G90 G0 G141 D1 X0. Y0. Z0.
    /// G1 X5. Y0. J-1. F20.
    /// G40
    /// M30
    /// ```
    rule "cutter-vector-without-axis" in "five_axis" {
        summary: "direction of 3D cutter compensation along an axis that its block does not name",
        severity: Warning,
        tier: Path,
        since: "0.1.0",
        run: Run::Path { watch: Watch::CHANGES, make: || Box::new(CutterVectorWithoutAxis) },
    }
}

struct CutterVectorWithoutAxis;

/// Each component with its axis.
const COMPONENTS: [(char, Axis); 3] = [('I', Axis::X), ('J', Axis::Y), ('K', Axis::Z)];

impl PathRule for CutterVectorWithoutAxis {
    fn changed(&mut self, cx: &PathCx<'_>, event: &Event, report: &mut Report<'_>) {
        let Event::CutterVector(parts) = event else { return };
        let mode = cx.state().mode(Role::Compensation).only();
        let Some(code) = mode.filter(|code| is_along_vectors(cx.model.effect(*code))) else { return };
        let letters = cx.origin().letters;
        for ((letter, axis), part) in COMPONENTS.into_iter().zip(parts) {
            let is_shifted = part.is_some_and(|part| part.is_finite() && part != 0.0);
            if !is_shifted || letters.contains(axis.letter()) {
                continue;
            }
            let (name, axis) = (cx.name_of(code), axis.name());
            let source = cx.control().code_at(code).map_or("", |code| code.entry().source.as_str());
            let finding = cx
                .finding(
                    &META,
                    cx.letter_range(letter),
                    format!("no offset along {axis}: `{letter}` without `{axis}` (`{name}`)"),
                )
                .label(format!("the block has no `{axis}`"))
                .note(format!("`{name}` shifts the axes that the block names  [HM17 p.313; {source}]"))
                .help(format!("write `{axis}` in the block, with its last value if it does not move"));
            report.add(resting_on_mode(cx, finding, Role::Compensation));
        }
    }
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::check_rule;

    #[test]
    fn each_axis_is_named() {
        check_rule(
            &RULE,
            "haas-mill",
            "G90 G0 G141 D1 X0. Y0. Z0.\nG1 X5. I0.6 J0. K0.8 F20.\nY1. I0.6 J0. K0.8\nX2. I#500 J#501 K#502\nG40\nM30\n",
            &expect![[r#"
                2 | G1 X5. I0.6 J0. K0.8 F20.
                  |                 ^^^^ warning[cutter-vector-without-axis] no offset along Z: `K` without `Z` (`G141`)
                3 | Y1. I0.6 J0. K0.8
                  |     ^^^^ warning[cutter-vector-without-axis] no offset along X: `I` without `X` (`G141`)
                3 | Y1. I0.6 J0. K0.8
                  |              ^^^^ warning[cutter-vector-without-axis] no offset along Z: `K` without `Z` (`G141`)
            "#]],
        );
    }
}
