//! Words with and without a blank between them.

use crate::declare::declare_rule;
use crate::facts::notation::{Notation, Question, word_around};
use crate::{FileCx, Report, Run};

declare_rule! {
    /// Some blocks have blanks between words and others do not: `G1 X1. Y1.` and `G1X1.Y1.`. Reported once per file.
    ///
    /// ## Why it matters
    /// The control reads both. Without blanks, a block is hard to read at the machine, where people search for mistakes
    /// in a hurry.
    ///
    /// ## Reported
    /// ```nc,reported,haas-mill
    /// G1 X1. Y1. F10.
    /// X2. Y2.
    /// X3.Y3.
    /// M30
    /// ```
    /// ## Not reported
    /// ```nc,quiet,haas-mill
    /// N10G1X1.Y1.F10.
    /// N20X2.Y2.
    /// M30
    /// ```
    rule "blanks-between-words-mixed" in "style" {
        summary: "words with and without a blank between them",
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
    let Some(odd) = notation.habit(Question::Blank).odd() else { return };
    let Some(first) = odd.places.first() else { return };
    let (_, before) = word_around(cx.text, &(first.start.saturating_sub(1)..first.start));
    let (behind, word) = word_around(cx.text, &(first.end..first.end + 1));
    let place = first.start - before.len() as u32..behind.end;
    let (found, others, blank) =
        if odd.is_long { ("apart", "run together", "") } else { ("run together", "set apart", " ") };
    let message = format!("`{before}` and `{word}` {found}, where other words are {others}");
    report.add(odd.finding(&META, place, message, |_| blank.to_owned()));
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::{check_rule, fixes_of};

    #[test]
    fn the_fix_follows_the_many() {
        assert_eq!(
            fixes_of(&RULE, "haas-mill", "G1 X1. Y1. F1.\nX2.Y2.(A)\n"),
            "G1 X1. Y1. F1.\nX2. Y2.(A)\n"
        );
        assert_eq!(fixes_of(&RULE, "haas-mill", "G1X1.Y1.F1.\nX2.  Y2.\n"), "G1X1.Y1.F1.\nX2.Y2.\n");
    }

    #[test]
    fn formulas_and_comments_are_left_alone() {
        check_rule(
            &RULE,
            "haas-mill",
            "G1 X1. Y1. F1.\nX#1Y[#2]\nX1.(A)Y2.\nIF[#1EQ1]GOTO10\n",
            &expect![[""]],
        );
    }
}
