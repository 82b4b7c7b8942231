//! A variable that gives a bar feed an impossible length.

use gcheck_engine::Event;
use gcheck_geometry::Mm;

use crate::declare::declare_rule;
use crate::facts::bar_feed::{Given, Length, bar_feed_range, bar_feeder, given, lengths};
use crate::{PathCx, PathRule, Report, Run, Watch};

declare_rule! {
    /// A bar feed (`G105`) takes a length from its variable, and the value cannot be a length: a part of zero or less,
    /// a clamping length or a push below zero, a reference position of zero that replaces the push.
    ///
    /// The rules about numbers judge the words of the block itself.
    ///
    /// ## Why it matters
    /// The bar does not move, and the next pass cuts air where the last part was.
    ///
    /// ## Reported
    /// ```nc,reported,haas-lathe
    /// #3100=0 (PART LENGTH)
    /// M5
    /// G105 I2. K1.
    /// M99
    /// ```
    /// ## Not reported
    /// ```nc,quiet,haas-lathe
    /// #3100=1.75
    /// M5
    /// G105 I2. K1.
    /// M99
    /// ```
    rule "bar-length-not-usable" in "bar_feeder" {
        summary: "bar feed by a length of zero or less",
        severity: Warning,
        tier: Path,
        since: "0.1.0",
        run: Run::Path { watch: Watch::CHANGES, make: || Box::new(BarLengthNotUsable) },
    }
}

struct BarLengthNotUsable;

impl PathRule for BarLengthNotUsable {
    fn changed(&mut self, cx: &PathCx<'_>, event: &Event, report: &mut Report<'_>) {
        let Some(rules) = bar_feeder(cx) else { return };
        let Some(told) = lengths(event) else { return };
        for length in Length::ALL {
            let value = length.of(told);
            let is_usable = match length {
                Length::Part => value > Mm::ZERO,
                Length::Initial | Length::Clamping => value >= Mm::ZERO,
            };
            // The reference position takes the place of an initial push of zero.
            let is_zero = cx.known_variable(length.variable(rules)) == Some(0.0);
            let is_reference = length == Length::Initial
                && match given(cx, length, rules) {
                    Given::Variable => is_zero || value == Mm::ZERO,
                    _ => value == Mm::ZERO,
                };
            let by_variable = given(cx, length, rules) == Given::Variable || is_reference;
            if !value.is_known() || is_usable && (!is_reference || value > Mm::ZERO) || !by_variable {
                continue;
            }
            let variable = if is_reference { rules.reference } else { length.variable(rules) };
            let name = if is_reference { "reference position" } else { length.words() };
            let how = if value == Mm::ZERO { "zero" } else { "below zero" };
            let label = match length {
                Length::Part => "the bar is not pushed to the next part",
                Length::Initial => "a new bar is not pushed out of the chuck",
                Length::Clamping => "no length would have to stay in the chuck",
            };
            report.add(
                cx.finding(
                    &META,
                    bar_feed_range(cx),
                    format!("{name} of the bar feed is {how} (`#{variable}`)"),
                )
                .label(label)
                .note(format!("`#{variable}` is {}", cx.shown(value)))
                .help(format!("set `#{variable}`, or give `{}` in the block", length.letter())),
            );
        }
    }
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::{World, check_rule, check_rule_in};

    #[test]
    fn zero_and_less() {
        check_rule(
            &RULE,
            "haas-lathe",
            "#3100=-1.75\n#3101=-2.\n#3102=-1.\nM5\nG105\nM99\n",
            &expect![[r#"
            5 | G105
              | ^^^^ warning[bar-length-not-usable] clamping length of the bar feed is below zero (`#3102`)
            5 | G105
              | ^^^^ warning[bar-length-not-usable] initial push of the bar feed is below zero (`#3101`)
            5 | G105
              | ^^^^ warning[bar-length-not-usable] part length of the bar feed is below zero (`#3100`)
        "#]],
        );
        check_rule(&RULE, "haas-lathe", "#3100=1.75\n#3101=2.\n#3102=0\nM5\nG105\nM99\n", &expect![[""]]);
    }

    #[test]
    fn a_reference_position_of_zero() {
        let mut world = World::default();
        world.machine.engine.variables = [(3101, 0.0), (3112, 0.0)].into();
        check_rule_in(
            &RULE,
            "haas-lathe",
            "M5\nG105 J1. K1.\nM99\n",
            &world,
            &expect![[r#"
            2 | G105 J1. K1.
              | ^^^^ warning[bar-length-not-usable] reference position of the bar feed is zero (`#3112`)
        "#]],
        );
        world.machine.engine.variables = [(3101, 0.0), (3112, -1.0)].into();
        check_rule_in(
            &RULE,
            "haas-lathe",
            "M5\nG105 J1. K1.\nM99\n",
            &world,
            &expect![[r#"
                2 | G105 J1. K1.
                  | ^^^^ warning[bar-length-not-usable] reference position of the bar feed is below zero (`#3112`)
            "#]],
        );
        world.machine.engine.variables = [(3101, 0.0), (3112, 4.0)].into();
        check_rule_in(&RULE, "haas-lathe", "M5\nG105 J1. K1.\nM99\n", &world, &expect![[""]]);
    }

    #[test]
    fn words_are_judged_elsewhere_and_unknown_values_nowhere() {
        check_rule(&RULE, "haas-lathe", "M5\nG105 J0. K-1. I-2.\nM99\n", &expect![[""]]);
        check_rule(&RULE, "haas-lathe", "#3100=#500\nM5\nG105 K1.\nM99\n", &expect![[""]]);
    }
}
