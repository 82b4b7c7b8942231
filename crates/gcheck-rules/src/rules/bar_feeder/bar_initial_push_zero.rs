//! A new bar that is pushed by the reference position.

use gcheck_engine::Event;

use crate::declare::declare_rule;
use crate::facts::bar_feed::{Given, Length, bar_feeder, given, length_range, lengths};
use crate::{PathCx, PathRule, Report, Run, Severity, Watch};

declare_rule! {
    /// The initial push of a bar feed (`G105`) is zero, so the control uses the reference position (`#3112`) instead.
    ///
    /// It does so if `I` and `#3101` are zero. The manual does not say what `I0` means while `#3101` is not zero.
    ///
    /// ## Why it matters
    /// The reference position is set when the feeder is set up. It is usually not the length that this part needs.
    ///
    /// ## Reported
    /// ```nc,reported,haas-lathe
    /// #3101=0
    /// M5
    /// G105 J1.75 K0.5
    /// M99
    /// ```
    /// ## Not reported
    /// ```nc,quiet,haas-lathe
    /// #3101=0
    /// M5
    /// G105 J1.75 K0.5 I2.
    /// M99
    /// ```
    rule "bar-initial-push-zero" in "bar_feeder" {
        summary: "new bar pushed by the reference position",
        severity: Info,
        tier: Path,
        since: "0.1.0",
        run: Run::Path { watch: Watch::CHANGES, make: || Box::new(BarInitialPushZero) },
    }
}

struct BarInitialPushZero;

impl PathRule for BarInitialPushZero {
    fn changed(&mut self, cx: &PathCx<'_>, event: &Event, report: &mut Report<'_>) {
        let Some(rules) = bar_feeder(cx) else { return };
        if lengths(event).is_none() {
            return;
        }
        let stored = cx.known_variable(rules.initial_push);
        let (variable, reference) = (rules.initial_push, rules.reference);
        let by_word = given(cx, Length::Initial, rules) == Given::Word;
        if by_word && !writes_zero(cx) || !by_word && stored != Some(0.0) {
            return;
        }
        // If the reference position is configured, its use is deliberate.
        if stored == Some(0.0) && cx.state().variables().is_written(reference) {
            return;
        }
        let range = length_range(cx, Length::Initial);
        let finding = match stored {
            Some(stored) if stored != 0.0 => cx
                .finding(&META, range, format!("initial push is zero, and `#{variable}` is not"))
                .label("it is not certain how far a new bar is pushed")
                .note(format!(
                    "the reference position `#{reference}` is used when both are zero  [{}]",
                    source(cx)
                ))
                .help("remove `I` to push by the variable, or give the length"),
            _ => cx
                .finding(
                    &META,
                    range,
                    format!("new bar is pushed by the reference position (`#{reference}`)"),
                )
                .label("the initial push is zero")
                .note(format!(
                    "`#{reference}` replaces `I` and `#{variable}` when both are zero  [{}]",
                    source(cx)
                ))
                .assuming(format!("`#{reference}` was set when the feeder was set up"))
                .help("give the push of a new bar: the part, the cutoff and the facing allowance"),
        };
        // The block alone gives a zero: the variable's value is unknown.
        report.add(if by_word && stored.is_none() {
            finding.assuming(format!("`#{variable}` is zero as well")).at_most(Severity::Info)
        } else {
            finding
        });
    }
}

/// The block gives `I0`.
fn writes_zero(cx: &PathCx<'_>) -> bool {
    cx.known_number('I') == Some(0.0)
}

fn source(cx: &PathCx<'_>) -> String {
    let codes = cx.codes();
    let mut codes = codes.iter().filter_map(|ix| cx.control().code_at(*ix));
    let feed = codes.find(|code| code.effect() == gcheck_controls::Effect::BarFeed);
    feed.map_or_else(String::new, |code| code.entry().source.clone())
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::{World, check_rule, check_rule_in};

    #[test]
    fn a_zero_of_the_block() {
        check_rule(
            &RULE,
            "haas-lathe",
            "M5\nG105 J1. K1. I0\nM99\n",
            &expect![[r#"
            2 | G105 J1. K1. I0
              |              ^^ info[bar-initial-push-zero] new bar is pushed by the reference position (`#3112`)
        "#]],
        );
        check_rule(
            &RULE,
            "haas-lathe",
            "#3101=2.\nM5\nG105 J1. K1. I0\nM99\n",
            &expect![[r#"
            3 | G105 J1. K1. I0
              |              ^^ info[bar-initial-push-zero] initial push is zero, and `#3101` is not
        "#]],
        );
        check_rule(&RULE, "haas-lathe", "M5\nG105 J1. K1. I#500\nM99\n", &expect![[""]]);
    }

    #[test]
    fn a_reference_position_that_was_told_is_meant() {
        let mut world = World::default();
        world.machine.engine.variables = [(3101, 0.0), (3112, 4.0)].into();
        check_rule_in(&RULE, "haas-lathe", "M5\nG105 J1. K1.\nM99\n", &world, &expect![[""]]);
    }
}
