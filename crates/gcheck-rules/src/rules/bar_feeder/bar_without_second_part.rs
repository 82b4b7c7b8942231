//! A new bar that is too short for another part after its first push.

use gcheck_engine::{BarLengths, Event};
use gcheck_geometry::Mm;

use crate::declare::declare_rule;
use crate::facts::bar_feed::{Length, bar_feed_name, length_range, lengths, resting_on_units};
use crate::{PathCx, PathRule, Report, Run, Severity, Watch};

declare_rule! {
    /// After the first push of a new bar (`I` of `G105`) the rest of it is shorter than the clamping length (`K`) and
    /// the part (`J`) together, against `bar_length` of the machine file. Each bar then gives one part, or none where the
    /// first push is shorter than a part.
    ///
    /// ## Why it matters
    /// The feeder measures the rest and takes a new bar at each feed: nearly all of the material is thrown away, and the
    /// magazine is empty after a few parts.
    ///
    /// ## Reported
    /// With bars of 1000 mm, of which 340 mm are left after the first push:
    /// ```nc,reported,haas-lathe
    /// G21
    /// M5
    /// G105 J300. K60. I660.
    /// M99
    /// ```
    /// ## Not reported
    /// ```nc,quiet,haas-lathe
    /// G21
    /// M5
    /// G105 J300. K60. I310.
    /// M99
    /// ```
    /// ## How to fix it
    /// * Push a new bar by less (`I`): as far as the face of the first part needs.
    /// * Or correct the part length (`J`), the clamping length (`K`), or `bar_length` of the machine file.
    rule "bar-without-second-part" in "bar_feeder" {
        summary: "rest of a new bar too short for another part",
        severity: Warning,
        tier: Path,
        since: "0.1.0",
        run: Run::Path { watch: Watch::CHANGES, make: || Box::new(BarWithoutSecondPart) },
    }
}

/// Lengths that differ by less are taken for equal.
const EQUAL_WITHIN: Mm = Mm(1e-6);

struct BarWithoutSecondPart;

impl PathRule for BarWithoutSecondPart {
    fn changed(&mut self, cx: &PathCx<'_>, event: &Event, report: &mut Report<'_>) {
        let Some(bar) = cx.environment.machine.engine.bar.new_bar else {
            cx.enough();
            return;
        };
        let Some(told) = lengths(event) else { return };
        let BarLengths { part, initial, clamping } = *told;
        let rest = bar - initial;
        // Other rules report lengths that are not usable, parts that fit on no bar, and bars that cannot be clamped.
        let is_usable = part > Mm::ZERO && initial > Mm::ZERO && clamping >= Mm::ZERO;
        let is_clamped =
            is_usable && part + clamping <= bar + EQUAL_WITHIN && rest >= clamping - EQUAL_WITHIN;
        // What a control does with exactly the length no page says: another rule names that.
        if !is_clamped || rest > part + clamping - EQUAL_WITHIN {
            return;
        }
        let gives = if initial + EQUAL_WITHIN < part { "no part" } else { "one part only" };
        let finding = cx
            .finding(
                &META,
                length_range(cx, Length::Initial),
                format!("a new bar gives {gives} (`{}`)", bar_feed_name(cx)),
            )
            .label(format!(
                "{} are left of {}, and the next part needs {}",
                cx.shown(rest),
                cx.shown(bar),
                cx.shown(part + clamping)
            ))
            .note("the feeder replaces a bar that is too short: every feed takes a new bar")
            .help("correct the initial push (`I`), the part length (`J`), the clamping length (`K`) or `bar_length` of the machine file")
            .at_most(Severity::Warning);
        report.add(resting_on_units(cx, finding));
    }
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::{META, RULE};
    use crate::testing::{World, check_rule, check_rule_in, findings, only, words};

    fn check(program: &str, expected: &expect_test::Expect) {
        check_rule_in(&RULE, "haas-lathe", program, &World::of_examples(&META), expected);
    }

    #[test]
    fn one_part_or_none() {
        check(
            "G21\nM5\nG105 J300. K60. I641.\nM99\n",
            &expect![[r#"
                3 | G105 J300. K60. I641.
                  |                 ^^^^^ warning[bar-without-second-part] a new bar gives one part only (`G105`)
            "#]],
        );
        check(
            "G21\n#3100=500.\n#3101=5.\n#3102=497.\nM5\nG105\nM99\n",
            &expect![[r#"
                6 | G105
                  | ^^^^ warning[bar-without-second-part] a new bar gives no part (`G105`)
            "#]],
        );
    }

    #[test]
    fn a_rest_for_another_part_and_lengths_of_other_rules() {
        check("G21\nM5\nG105 J300. K60. I639.9\nM99\n", &expect![[""]]);
        check("G21\nM5\nG105 J300. K60. I640.\nM99\n", &expect![[""]]);
        check("G21\nM5\nG105 J980. K60. I50.\nM99\n", &expect![[""]]);
        check("G21\nM5\nG105 J98. K60. I970.\nM99\n", &expect![[""]]);
        check("G21\nM5\nG105 J#500 K60. I970.\nM99\n", &expect![[""]]);
        check_rule(&RULE, "haas-lathe", "G21\nM5\nG105 J300. K60. I640.\nM99\n", &expect![[""]]);
    }

    #[test]
    fn lengths_are_those_of_the_program() {
        let mut world = World::of_examples(&META);
        world.machine.engine.bar.new_bar = Some(gcheck_geometry::Mm(304.8));
        let found = findings(&only(&RULE), "haas-lathe", "G20\nM5\nG105 J2. K3. I8.\nM99\n", &world);
        let said: String = found.iter().map(words).collect();
        let just = "G20\nM5\nG105 J1. K3. I9.\nM99\n";
        assert_eq!(findings(&only(&RULE), "haas-lathe", just, &world).len(), 1, "just long enough to clamp");
        assert!(said.contains("4 in are left of 12 in, and the next part needs 5 in"), "{said}");
    }
}
