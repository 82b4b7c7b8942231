//! Whole numbers with and without a zero after the point.

use crate::declare::declare_rule;
use crate::facts::notation::{Notation, Question, word_around};
use crate::{FileCx, Report, Run};

declare_rule! {
    /// Whole numbers are written in two ways in one file: `X1.` and `X1.0`. Reported once per file.
    ///
    /// ## Why it matters
    /// The control reads both. A search for one form misses the other.
    ///
    /// ## Reported
    /// ```nc,reported,haas-mill
    /// G1 X1.0 Y2.0 F10.0
    /// X3.
    /// M30
    /// ```
    /// ## Not reported
    /// ```nc,quiet,haas-mill
    /// G1 X1. Y2.25 F10.
    /// X3.
    /// M30
    /// ```
    rule "zero-behind-point-mixed" in "style" {
        summary: "whole numbers with and without a zero after the point",
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
    let Some(odd) = notation.habit(Question::ZeroAfterPoint).odd() else { return };
    let Some(first) = odd.places.first() else { return };
    let (place, word) = word_around(cx.text, first);
    let others = if odd.is_long { "without" } else { "with" };
    let message = format!("`{word}` among whole numbers {others} a zero after the point");
    let zero = if odd.is_long { "" } else { "0" };
    report.add(odd.finding(&META, place, message, |_| zero.to_owned()));
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::{check_rule, fixes_of};

    #[test]
    fn the_point_stays() {
        assert_eq!(fixes_of(&RULE, "fanuc-mill", "G1 X1. Y2.\nX3.000\n"), "G1 X1. Y2.\nX3.\n");
        assert_eq!(fixes_of(&RULE, "fanuc-mill", "G1 X1.0 Y2.0\nX3.\n"), "G1 X1.0 Y2.0\nX3.0\n");
    }

    #[test]
    fn no_digit_is_added_to_a_full_number() {
        check_rule(&RULE, "fanuc-mill", "G1 X1.0 Y2.0\nX12345678.\n", &expect![[""]]);
    }
}
