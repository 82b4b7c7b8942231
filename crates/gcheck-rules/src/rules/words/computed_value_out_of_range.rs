//! A computed value that its code cannot use.

use gcheck_controls::{Code, Letter};
use gcheck_engine::Fault;
use gcheck_program::Value;

use crate::declare::declare_rule;
use crate::facts::beside::unfit;
use crate::facts::callers::CallerValues;
use crate::facts::computed_words::{self, refused};
use crate::{PathCx, PathRule, Report, Run, Watch, limit};
use crate::{Remembers, remembers};

declare_rule! {
    /// A word's value is computed, and the code cannot use it: a fraction or a negative number for a count, a feed or
    /// speed below zero, a value outside the range of the word. It is judged by the facts that `number-out-of-range`
    /// judges a written number by.
    ///
    /// ## Why it matters
    /// The control stops with an alarm at the block, or uses a wrong value.
    ///
    /// ## Reported
    /// ```nc,reported,fanuc-mill
    /// O0001
    /// #1=5
    /// M98 P[#1/2]
    /// M30
    /// ```
    /// ```nc,reported,linuxcnc
    /// #1=-100
    /// G1 X1 F#1
    /// M2
    /// ```
    /// ## Not reported
    /// ```nc,quiet,fanuc-mill
    /// O0001
    /// #1=4
    /// M98 P[#1/2]
    /// G1 X1. F#500
    /// M30
    /// O0002
    /// M99
    /// ```
    rule "computed-value-out-of-range" in "words" {
        summary: "computed value that its code cannot use",
        severity: Error,
        tier: Path,
        control_specific: true,
        since: "0.1.0",
        run: Run::Path {
            watch: Watch::FAULTS.union(Watch::ALL_BLOCKS),
            make: || Box::new(ComputedValueOutOfRange::default()),
        },
    }
}

#[derive(Default, Clone, PartialEq)]
struct ComputedValueOutOfRange {
    callers: CallerValues,
}

remembers!(ComputedValueOutOfRange);

impl PathRule for ComputedValueOutOfRange {
    fn memory(&mut self) -> Remembers<'_> {
        Remembers::All(self)
    }

    fn block(&mut self, cx: &PathCx<'_>, report: &mut Report<'_>) {
        self.callers.see(cx);
        for one in refused(cx, &self.callers).iter().filter(|one| one.is_certain) {
            report.add(computed_words::finding(cx, &META, one));
        }
    }

    fn fault(&mut self, cx: &PathCx<'_>, fault: &Fault, report: &mut Report<'_>) {
        let Fault::WordRange(letter) = fault else { return };
        // What the data refuse was reported before the block was executed.
        if refused(cx, &self.callers).iter().any(|one| one.is_certain && one.word.letter == *letter) {
            return;
        }
        if self.callers.may_decide(cx) || is_unfit_for_another(cx, *letter) {
            return;
        }
        // Other rules judge a written number without executing the block.
        let range = cx
            .find_word(cx.origin().at, |word| word.letter == *letter && matches!(word.value, Value::Expr(_)));
        let Some(range) = range else { return };
        let name = char::from(letter.ascii());
        let mut finding = cx
            .finding(&META, range, format!("computed value of `{name}` cannot be used here"))
            .label("is a fraction, or outside the range of its code")
            .help("check the expression of the value");
        // A value outside a range is as certain as the source of the range.
        let codes = cx.codes();
        let entries = codes.iter().filter_map(|code| cx.control().code_at(*code)).map(Code::entry);
        let confidence = entries
            .flat_map(|entry| entry.words.iter().map(move |word| (entry, word)))
            .filter(|(_, word)| Letter::parse(&word.letter) == Some(*letter))
            .map(|(entry, word)| word.range_confidence.or(word.confidence).unwrap_or(entry.confidence))
            .min();
        if let Some(confidence) = confidence {
            finding = finding.at_most(limit(confidence));
        }
        report.add(finding.at_most(cx.environment.most_for_this_control()));
    }
}

/// Does another word of the block decide that the value is wrong? Another rule reports it with that word.
fn is_unfit_for_another(cx: &PathCx<'_>, letter: Letter) -> bool {
    cx.codes().iter().filter_map(|code| cx.control().code_at(*code)).any(|code| {
        let mut words = code.entry().words.iter();
        words.any(|word| Letter::parse(&word.letter) == Some(letter) && unfit(cx, word, letter).is_some())
    })
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::check_rule;

    #[test]
    fn the_word_is_marked() {
        check_rule(
            &RULE,
            "haas-mill",
            "O1\n#1= 2.5\nM98 P#1\nM30\n",
            &expect![[r#"
            3 | M98 P#1
              |     ^^^ error[computed-value-out-of-range] computed value is not a whole number for `M98`: `P2.5`
        "#]],
        );
        check_rule(
            &RULE,
            "linuxcnc",
            "#1=-5\nM3 S#1\nM2\n",
            &expect![[r#"
                2 | M3 S#1
                  |    ^^^ error[computed-value-out-of-range] computed value is too small for `M3`: `S-5`
            "#]],
        );
    }

    #[test]
    fn a_range_that_is_only_assumed_makes_a_warning() {
        check_rule(
            &RULE,
            "fanuc-mill",
            "#1=-1\nG4 X[#1]\nM30\n",
            &expect![[r#"
                2 | G4 X[#1]
                  |    ^^^^^ warning[computed-value-out-of-range] computed value is too small for `G4`: `X-1`
            "#]],
        );
        check_rule(
            &RULE,
            "generic-mill",
            "#1=-1\nG4 P[#1]\nG4 U[#1]\nM30\n",
            &expect![[r#"
                2 | G4 P[#1]
                  |    ^^^^^ warning[computed-value-out-of-range] computed value is too small for `G4`: `P-1`
                3 | G4 U[#1]
                  |    ^^^^^ error[computed-value-out-of-range] computed value is too small for `G4`: `U-1`
            "#]],
        );
    }

    #[test]
    fn a_number_as_it_stands_is_told_elsewhere() {
        check_rule(&RULE, "linuxcnc", "M3 S-5\nM2\n", &expect![[""]]);
    }
}
