//! A part that does not fit on a bar.

use gcheck_engine::Event;
use gcheck_geometry::Mm;

use crate::declare::declare_rule;
use crate::facts::bar_feed::{Length, length_range, lengths, resting_on_units};
use crate::{PathCx, PathRule, Report, Run, Severity, Watch};

declare_rule! {
    /// A part and its clamping are longer than a new bar (`J` and `K` of `G105` against `bar_length` of the machine file), or
    /// a new bar is pushed so far out that less than the clamping length stays in the chuck.
    ///
    /// ## Why it matters
    /// No bar is long enough: each feed takes the next bar, until the magazine is empty. A bar that is clamped too
    /// short flies out.
    ///
    /// ## Reported
    /// With bars of 1000 mm:
    /// ```nc,reported,haas-lathe
    /// G21
    /// M5
    /// G105 J980. K60. I50.
    /// M99
    /// ```
    /// ## Not reported
    /// ```nc,quiet,haas-lathe
    /// G21
    /// M5
    /// G105 J98. K60. I100.
    /// M99
    /// ```
    /// ## How to fix it
    /// * Look for a decimal point or a digit in the part length (`J`), the clamping length (`K`) and the initial push
    ///   (`I`).
    /// * If the bars are longer, correct `bar_length` in the machine file.
    rule "bar-too-short-for-part" in "bar_feeder" {
        summary: "part and clamping longer than a new bar",
        severity: Error,
        tier: Path,
        since: "0.1.0",
        run: Run::Path { watch: Watch::CHANGES, make: || Box::new(BarTooShortForPart) },
    }
}

/// Lengths that differ by less are taken for equal: inches seldom add up exactly.
const EQUAL_WITHIN: Mm = Mm(1e-6);

struct BarTooShortForPart;

impl PathRule for BarTooShortForPart {
    fn changed(&mut self, cx: &PathCx<'_>, event: &Event, report: &mut Report<'_>) {
        let Some(bar) = cx.environment.machine.engine.bar.new_bar else {
            cx.enough();
            return;
        };
        let Some(told) = lengths(event) else { return };
        let (part, clamping, initial) = (told.part, told.clamping, told.initial);
        // Another rule reports numbers below zero.
        if part > Mm::ZERO && clamping >= Mm::ZERO && part + clamping > bar + EQUAL_WITHIN {
            let finding =
                cx.finding(&META, length_range(cx, Length::Part), "part and its clamping are longer than a new bar")
                    .label(format!(
                        "{} and {} to clamp; a bar has {}",
                        cx.shown(part),
                        cx.shown(clamping),
                        cx.shown(bar)
                    ))
                    .note("the feeder replaces a bar that is too short: every feed would take a new bar")
                    .help("correct the part length (`J`), the clamping length (`K`) or `bar_length` of the machine file");
            report.add(resting_on_units(cx, finding));
        } else if clamping >= Mm::ZERO && initial > Mm::ZERO && bar - initial < clamping - EQUAL_WITHIN {
            report.add(
                cx.finding(
                    &META,
                    length_range(cx, Length::Initial),
                    "new bar is pushed too far out to be clamped",
                )
                .label(format!(
                    "{} stay in the chuck, and {} must",
                    cx.shown(bar - initial),
                    cx.shown(clamping)
                ))
                .help("correct the initial push (`I`), the clamping length (`K`) or `bar_length` of the machine file")
                .at_most(Severity::Warning),
            );
        }
    }
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::{META, RULE};
    use crate::testing::{World, check_rule, check_rule_in};

    fn check(program: &str, expected: &expect_test::Expect) {
        check_rule_in(&RULE, "haas-lathe", program, &World::of_examples(&META), expected);
    }

    #[test]
    fn lengths_of_the_block_and_of_variables() {
        check(
            "G21\nM5\nG105 J980. K60. I50.\nM99\n",
            &expect![[r#"
            3 | G105 J980. K60. I50.
              |      ^^^^^ error[bar-too-short-for-part] part and its clamping are longer than a new bar
        "#]],
        );
        check(
            "G21\n#3100=980.\n#3102=60.\nM5\nG105 I50.\nM99\n",
            &expect![[r#"
            5 | G105 I50.
              | ^^^^ error[bar-too-short-for-part] part and its clamping are longer than a new bar
        "#]],
        );
        check(
            "G21\nM5\nG105 J98. K60. I970.\nM99\n",
            &expect![[r#"
            3 | G105 J98. K60. I970.
              |                ^^^^^ warning[bar-too-short-for-part] new bar is pushed too far out to be clamped
        "#]],
        );
        check(
            "M5\nG105 J98. K2. I39.\nM99\n",
            &expect![[r#"
            2 | G105 J98. K2. I39.
              |      ^^^^ warning[bar-too-short-for-part] part and its clamping are longer than a new bar
        "#]],
        );
        check(
            "G20\nM5\nG105 J38. K2. I39.\nM99\n",
            &expect![[r#"
            3 | G105 J38. K2. I39.
              |      ^^^^ error[bar-too-short-for-part] part and its clamping are longer than a new bar
        "#]],
        );
    }

    #[test]
    fn what_fits_and_what_is_not_known() {
        check("G21\nM5\nG105 J940. K60. I50.\nM99\n", &expect![[""]]);
        check("G21\nM5\nG105 J#500 K60. I50.\nM99\n", &expect![[""]]);
        check("G21\nM5\nG105 J980. I50.\nM99\n", &expect![[""]]);
        check_rule(&RULE, "haas-lathe", "G21\nM5\nG105 J9800. K60. I50.\nM99\n", &expect![[""]]);
    }
}
