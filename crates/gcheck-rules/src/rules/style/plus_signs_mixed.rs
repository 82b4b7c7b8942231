//! Positive numbers with and without a plus sign.

use crate::declare::declare_rule;
use crate::facts::notation::{Notation, Question, word_around};
use crate::{FileCx, Report, Run};

declare_rule! {
    /// Positive numbers are written in two ways in one file: `X1.` and `X+1.`. Reported once per file.
    ///
    /// ## Why it matters
    /// The control reads both. A sign at only some numbers seems to mean something, and does not.
    ///
    /// ## Reported
    /// ```nc,reported,haas-mill
    /// G1 X1. Y2. F10.
    /// X+3.
    /// M30
    /// ```
    /// ## Not reported
    /// ```nc,quiet,haas-mill
    /// G1 X1. Y-2. F10.
    /// M30
    /// ```
    rule "plus-signs-mixed" in "style" {
        summary: "positive numbers with and without a plus sign",
        severity: Hint,
        tier: Program,
        recommended: false,
        sets: [HouseStyle],
        fixable: Safely,
        since: "0.1.0",
        run: Run::Program { check },
    }
}

fn check(cx: &FileCx<'_>, report: &mut Report<'_>) {
    let notation = cx.fact::<Notation>();
    let Some(odd) = notation.habit(Question::PlusSign).odd() else { return };
    // A sign at every number would include `F`, `S` and `T`, which not every control accepts.
    if !odd.is_long {
        return;
    }
    let Some(first) = odd.places.first() else { return };
    let (place, word) = word_around(cx.text, first);
    let message = format!("`{word}` among numbers without a plus sign");
    report.add(odd.finding(&META, place, message, |_| String::new()));
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::{check_rule, fixes_of};

    #[test]
    fn the_sign_is_dropped() {
        assert_eq!(fixes_of(&RULE, "haas-mill", "G1 X1. Y2.\nX+3.\n"), "G1 X1. Y2.\nX3.\n");
        check_rule(&RULE, "haas-mill", "G1 X+1. Y+2. F1.\nX+3.\n", &expect![[""]]);
    }
}
