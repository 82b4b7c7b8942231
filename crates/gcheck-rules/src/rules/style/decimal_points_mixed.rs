//! Whole positions with and without a decimal point.

use crate::declare::declare_rule;
use crate::facts::notation::{Notation, Question, word_around};
use crate::{FileCx, Report, Run};

declare_rule! {
    /// Whole positions are written in two ways in one file: `X1` and `X1.`, on a control that reads both as one.
    /// Reported once per file.
    ///
    /// ## Why it matters
    /// On another control the number without a point is a thousandth of that. A file with points throughout can be
    /// moved to any machine, and one without points is easy to recognise; a mixture has neither advantage.
    ///
    /// ## Reported
    /// ```nc,reported,linuxcnc
    /// G1 X1. Y2. F100
    /// X3
    /// M2
    /// ```
    /// ## Not reported
    /// If the point changes the value, its absence is not a matter of style: see `missing-decimal-point`.
    /// ```nc,quiet,linuxcnc
    /// G1 X1. Y2. F100
    /// X3.5
    /// M2
    /// ```
    /// ```nc,quiet,fanuc-mill
    /// G1 X1. Y2. F100.
    /// X3
    /// M30
    /// ```
    rule "decimal-points-mixed" in "style" {
        summary: "whole positions with and without a decimal point",
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
    let Some(odd) = notation.habit(Question::Point).odd() else { return };
    let Some(first) = odd.places.first() else { return };
    let (place, word) = word_around(cx.text, first);
    let others = if odd.is_long { "without" } else { "with" };
    let message = format!("`{word}` among positions {others} a decimal point");
    let point = if odd.is_long { "" } else { "." };
    report.add(odd.finding(&META, place, message, |_| point.to_owned()));
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::{check_rule, fixes_of};

    #[test]
    fn the_fix_follows_the_many() {
        assert_eq!(fixes_of(&RULE, "linuxcnc", "G0 X1. Y2.\nX-3\n"), "G0 X1. Y2.\nX-3.\n");
        assert_eq!(fixes_of(&RULE, "linuxcnc", "G0 X1 Y2\nX-3.\n"), "G0 X1 Y2\nX-3\n");
    }

    #[test]
    fn counts_are_no_positions() {
        check_rule(&RULE, "linuxcnc", "G0 X1. Y2.\nG4 P2\nM3 S1000\n", &expect![[""]]);
    }
}
