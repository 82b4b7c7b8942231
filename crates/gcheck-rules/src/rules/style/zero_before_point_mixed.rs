//! Numbers below one with and without a zero before the point.

use crate::declare::declare_rule;
use crate::facts::notation::{Notation, Question, word_around};
use crate::{FileCx, Report, Run};

declare_rule! {
    /// Numbers below one are written in two ways in one file: `X.5` and `X0.5`. Reported once per file.
    ///
    /// ## Why it matters
    /// The control reads both. A point at the beginning of a number is easy to overlook, so most shops write the zero;
    /// one form throughout is easier to read.
    ///
    /// ## Reported
    /// ```nc,reported,haas-mill
    /// G1 X0.5 Y0.25 F10.
    /// X.75
    /// M30
    /// ```
    /// ## Not reported
    /// ```nc,quiet,haas-mill
    /// G1 X.5 Y-.25 F10.
    /// X0.
    /// M30
    /// ```
    rule "zero-before-point-mixed" in "style" {
        summary: "numbers with and without a zero before the point",
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
    let Some(odd) = notation.habit(Question::ZeroBeforePoint).odd() else { return };
    let Some(first) = odd.places.first() else { return };
    let (place, word) = word_around(cx.text, first);
    let others = if odd.is_long { "without" } else { "with" };
    let message = format!("`{word}` among numbers {others} a zero before the point");
    let zero = if odd.is_long { "" } else { "0" };
    report.add(odd.finding(&META, place, message, |_| zero.to_owned()));
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::{check_rule, fixes_of};

    #[test]
    fn nought_itself_is_neither_way() {
        check_rule(&RULE, "haas-mill", "G1 X.5 Y0. Z.0 F10.\n", &expect![[""]]);
    }

    #[test]
    fn the_fix_writes_or_drops_the_zero() {
        assert_eq!(fixes_of(&RULE, "haas-mill", "G1 X0.5 Y-0.5\nX-.25\n"), "G1 X0.5 Y-0.5\nX-0.25\n");
        assert_eq!(fixes_of(&RULE, "haas-mill", "G1 X.5 Y-.5\nX-0.25\n"), "G1 X.5 Y-.5\nX-.25\n");
    }
}
