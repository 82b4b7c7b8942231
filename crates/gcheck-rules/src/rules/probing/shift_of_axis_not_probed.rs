//! A measured offset that is shifted along another axis.

use gcheck_controls::{Effect, Letter};
use gcheck_program::BlockFlags;

use crate::declare::declare_rule;
use crate::{PathCx, PathRule, Report, Run, Watch};

declare_rule! {
    /// `I`, `J` or `K` of a measured work offset (`G36`, `G136`) shifts an axis that the block does not probe.
    ///
    /// ## Why it matters
    /// `I` belongs to X, `J` to Y and `K` to Z. A shift of another axis either does nothing, or moves an offset that
    /// was not measured, further with every run.
    ///
    /// ## Reported
    /// ```nc,reported,haas-mill
    /// G90 G54 G0 X0. Y5.
    /// G91 G36 Y-1. I0.5 F10.
    /// G90
    /// M30
    /// ```
    /// ## Not reported
    /// ```nc,quiet,haas-mill
    /// G90 G54 G0 X0. Y5.
    /// G91 G36 Y-1. J0.5 F10.
    /// G90
    /// M30
    /// ```
    rule "shift-of-axis-not-probed" in "probing" {
        summary: "measured offset shifted along another axis",
        severity: Warning,
        tier: Path,
        since: "0.1.0",
        run: Run::Path { watch: Watch::BLOCKS, make: || Box::new(ShiftOfAxisNotProbed) },
    }
}

struct ShiftOfAxisNotProbed;

impl PathRule for ShiftOfAxisNotProbed {
    fn block(&mut self, cx: &PathCx<'_>, report: &mut Report<'_>) {
        if !cx.has_effect(|effect| matches!(effect, Effect::ProbeOffset | Effect::ProbeCentre)) {
            return;
        }
        let letters = cx.origin().letters;
        // Another rule reports a block that probes nothing.
        let is_malformed = cx.origin().flags.contains(BlockFlags::ERROR);
        if is_malformed || !cx.names_axes() {
            return;
        }
        for (shift, axis) in [('I', 'X'), ('J', 'Y'), ('K', 'Z')] {
            let is_zero = cx.known_number(shift).is_some_and(|by| by.abs() <= 0.0);
            if !letters.contains(Letter::of(shift)) || is_zero || letters.contains(Letter::of(axis)) {
                continue;
            }
            report.add(
                cx.finding(
                    &META,
                    cx.letter_range(shift),
                    format!("`{shift}` shifts {axis}, which the block does not probe"),
                )
                .label(format!("belongs to {axis}"))
                .help(format!("probe along {axis}, or give the shift to the axis that is probed")),
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
    fn each_shift_has_its_axis() {
        check_rule(
            &RULE,
            "haas-mill",
            "G91 G36 X1. Y1. I.1 J#100 K.1 F5.\nG36 Z-1. I0. J#100 F5.\nG90\nM30\n",
            &expect![[r#"
                1 | G91 G36 X1. Y1. I.1 J#100 K.1 F5.
                  |                           ^^^ warning[shift-of-axis-not-probed] `K` shifts Z, which the block does not probe
                2 | G36 Z-1. I0. J#100 F5.
                  |              ^^^^^ warning[shift-of-axis-not-probed] `J` shifts Y, which the block does not probe
            "#]],
        );
    }
}
