//! A length of a bar feed that only an earlier feed gave.

use gcheck_engine::{At, Event};

use crate::declare::declare_rule;
use crate::facts::bar_feed::{Given, Length, bar_feed_range, bar_feeder, given, lengths};
use crate::{PathCx, PathRule, Report, Run, Watch};
use crate::{Remembers, remembers};

declare_rule! {
    /// A bar feed (`G105`) omits a length that an earlier one gave: such a length counts for its own block only.
    ///
    /// ## Why it matters
    /// `I`, `J` and `K` do not change what the control has stored. The later feed pushes by the stored length, which may be
    /// that of another job.
    ///
    /// ## Reported
    /// ```nc,reported,haas-lathe
    /// M5
    /// G105 J1.75
    /// G97 S800 M3
    /// G1 X0. F0.004
    /// M5
    /// G105
    /// M30
    /// ```
    /// ## Not reported
    /// ```nc,quiet,haas-lathe
    /// #3100=1.75
    /// M5
    /// G105 J1.75
    /// M5
    /// G105
    /// M30
    /// ```
    rule "bar-override-does-not-last" in "bar_feeder" {
        summary: "bar feed that expects an earlier length to last",
        severity: Info,
        tier: Path,
        since: "0.1.0",
        run: Run::Path { watch: Watch::CHANGES, make: || Box::new(BarOverrideDoesNotLast::default()) },
    }
}

#[derive(Default, Clone, PartialEq)]
struct BarOverrideDoesNotLast {
    /// By length: the block that gave it last, and the millimetres.
    given: [Option<(At, f64)>; 3],
}

remembers!(BarOverrideDoesNotLast: given);

impl PathRule for BarOverrideDoesNotLast {
    fn memory(&mut self) -> Remembers<'_> {
        Remembers::All(self)
    }

    fn changed(&mut self, cx: &PathCx<'_>, event: &Event, report: &mut Report<'_>) {
        let Some(rules) = bar_feeder(cx) else { return };
        let Some(told) = lengths(event) else { return };
        for (slot, length) in self.given.iter_mut().zip(Length::ALL) {
            let value = length.of(told).0;
            if given(cx, length, rules) == Given::Word {
                *slot = Some((cx.origin().at, value));
                continue;
            }
            let Some((at, before)) = *slot else { continue };
            // Set by the program or the configuration, and still unknown: it may be the same.
            let is_unknown = value.is_nan() && given(cx, length, rules) == Given::Variable;
            if is_unknown || (value - before).abs() < 1e-6 {
                continue;
            }
            let (letter, variable) = (length.letter(), length.variable(rules));
            let message = format!("`{letter}` of the earlier bar feed does not last");
            let mut finding = cx
                .finding(&META, bar_feed_range(cx), message)
                .label(if value.is_nan() {
                    format!("takes `#{variable}` from the control")
                } else {
                    format!("takes {} from `#{variable}`", cx.shown(length.of(told)))
                })
                .help(format!("write `{letter}` here as well, or set `#{variable}` once"));
            let is_letter = |word: &gcheck_program::Word| {
                word.letter == gcheck_controls::Letter::of(letter) && !word.letter.is_corner()
            };
            if let Some(range) = cx.find_word(at, is_letter) {
                finding = finding.also(range, "counts for this block only");
            }
            report.add(finding);
        }
    }
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::check_rule;

    #[test]
    fn each_length_for_itself() {
        check_rule(
            &RULE,
            "haas-lathe",
            "#3101=3.\nM5\nG105 J1.75 I2. K1.\nM5\nG105 J1.75\nM30\n",
            &expect![[r#"
                5 | G105 J1.75
                  | ^^^^ info[bar-override-does-not-last] `I` of the earlier bar feed does not last
                5 | G105 J1.75
                  | ^^^^ info[bar-override-does-not-last] `K` of the earlier bar feed does not last
            "#]],
        );
    }

    #[test]
    fn a_loop_over_one_feed_is_no_second_feed() {
        check_rule(
            &RULE,
            "haas-lathe",
            "#1=0\nWHILE [#1 LT 3] DO1\nM5\nG105 J1.75\n#1=#1+1\nEND1\nM30\n",
            &expect![[""]],
        );
    }

    #[test]
    fn values_that_are_not_known() {
        check_rule(&RULE, "haas-lathe", "#3100=#500\nM5\nG105 J1.75\nM5\nG105\nM30\n", &expect![[""]]);
        check_rule(
            &RULE,
            "haas-lathe",
            "M5\nG105 J#500\nM5\nG105\nM30\n",
            &expect![[r#"
            4 | G105
              | ^^^^ info[bar-override-does-not-last] `J` of the earlier bar feed does not last
        "#]],
        );
    }
}
