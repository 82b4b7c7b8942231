//! A direction of 3D cutter compensation along an axis that its block does not name.

use gcheck_controls::Letter;
use gcheck_engine::{Axis, Event, Role};

use crate::declare::declare_rule;
use crate::facts::five_axis::is_along_vectors;
use crate::facts::modes::resting_on_mode;
use crate::{PathCx, PathRule, Report, Run, Watch};
use crate::{Remembers, remembers};

declare_rule! {
    /// A block under 3D cutter compensation (`G141`) has a direction along an axis, and no word for that axis: `J`
    /// without `Y`.
    ///
    /// ## Why it matters
    /// The control shifts the axes that the block names and no others; another axis keeps the shift that it has. The
    /// surface is off by the offset of the tool in that axis, although the direction is written.
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
    /// X6. J-1.
    /// G40
    /// M30
    /// ```
    rule "cutter-vector-without-axis" in "five_axis" {
        summary: "direction of 3D compensation along an axis without a word",
        severity: Warning,
        tier: Path,
        since: "0.1.0",
        run: Run::Path { watch: Watch::CHANGES, make: || Box::new(CutterVectorWithoutAxis::default()) },
    }
}

#[derive(Default, Clone, PartialEq)]
struct CutterVectorWithoutAxis {
    /// The part of the direction by which X, Y and Z are shifted now, as far as it is known.
    applied: [Option<f64>; 3],
}

remembers!(CutterVectorWithoutAxis);

/// Each component with its axis.
const COMPONENTS: [(char, Axis); 3] = [('I', Axis::X), ('J', Axis::Y), ('K', Axis::Z)];

/// Parts of a direction that differ by no more are the same.
const SAME: f64 = 1e-3;

impl PathRule for CutterVectorWithoutAxis {
    fn memory(&mut self) -> Remembers<'_> {
        Remembers::All(self)
    }

    fn changed(&mut self, cx: &PathCx<'_>, event: &Event, report: &mut Report<'_>) {
        let Event::CutterVector(parts) = event else { return };
        let mode = cx.state().mode(Role::Compensation).only();
        let Some(code) = mode.filter(|code| is_along_vectors(cx.model.effect(*code))) else { return };
        let begins = cx.has_effect(is_along_vectors);
        if begins {
            self.applied = [Some(0.0); 3];
        }
        // A block without a direction has a finding of its own, unless it begins: then it goes to its point.
        let is_given = begins || parts.iter().any(Option::is_some);
        let letters = cx.origin().letters;
        for ((slot, part), (letter, axis)) in self.applied.iter_mut().zip(parts).zip(COMPONENTS) {
            let part = part.unwrap_or(0.0);
            if letters.contains(axis.letter()) {
                *slot = (is_given && part.is_finite()).then_some(part);
                continue;
            }
            let Some(applied) = *slot else { continue };
            if !is_given || !part.is_finite() || (part - applied).abs() <= SAME {
                continue;
            }
            let (name, axis) = (cx.name_of(code), axis.name());
            let source = cx.control().code_at(code).map_or("", |code| code.entry().source.as_str());
            let message = match (applied == 0.0, letters.contains(Letter::of(letter))) {
                (true, _) => format!("no offset along {axis}: `{letter}` without `{axis}` (`{name}`)"),
                (false, true) => {
                    format!("offset along {axis} stays as it is: `{letter}` without `{axis}` (`{name}`)")
                }
                (false, false) => {
                    format!("offset along {axis} stays as it is: the direction has none now (`{name}`)")
                }
            };
            let finding = cx
                .finding(&META, cx.letter_range(letter), message)
                .label(format!("the block has no `{axis}`"))
                .note(format!("`{name}` shifts the axes that the block names  [{source}]"))
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
            "G90 G0 G141 D1 X0. Y0. Z0.\nG1 X5. I0.6 J0. K0.8 F20.\nY1. I0.8 J0. K0.6\nX2. I#500 J#501 K#502\nG40\nM30\n",
            &expect![[r#"
                2 | G1 X5. I0.6 J0. K0.8 F20.
                  |                 ^^^^ warning[cutter-vector-without-axis] no offset along Z: `K` without `Z` (`G141`)
                3 | Y1. I0.8 J0. K0.6
                  |     ^^^^ warning[cutter-vector-without-axis] offset along X stays as it is: `I` without `X` (`G141`)
                3 | Y1. I0.8 J0. K0.6
                  |              ^^^^ warning[cutter-vector-without-axis] no offset along Z: `K` without `Z` (`G141`)
            "#]],
        );
    }

    #[test]
    fn an_axis_that_keeps_its_shift_needs_no_word() {
        check_rule(
            &RULE,
            "haas-mill",
            "G90 G0 G141 D1 X0. Y0. Z0. K1.\nG1 X5. K1. F20.\nX6. Y1. J1.\nG40\nM30\n",
            &expect![[r#"
                3 | X6. Y1. J1.
                  | ^^^^^^^^^^^ warning[cutter-vector-without-axis] offset along Z stays as it is: the direction has none now (`G141`)
            "#]],
        );
    }
}
