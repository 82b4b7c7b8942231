//! Positive numbers with and without a plus sign.

use crate::meta::declare_rule;
use crate::writing::{Question, word_around};
use crate::{FileCx, Report, Run};

declare_rule! {
    /// Positive numbers are written in two ways in one file: `X1.` and `X+1.`. Told once for the file.
    ///
    /// ## Why it matters
    /// The control reads both. A sign that stands at some numbers only seems to say something, and says nothing.
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
        mends: Safely,
        since: "0.1.0",
        run: Run::Program { check },
    }
}

fn check(cx: &FileCx<'_>, report: &mut Report<'_>) {
    let Some(odd) = cx.writing().habit(Question::PlusSign).odd() else { return };
    // A sign at every number would be written before `F`, `S` and `T` too, which not every control takes.
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
    use crate::testing::{check_rule, mended};

    #[test]
    fn the_sign_is_dropped() {
        assert_eq!(mended(&RULE, "haas-mill", "G1 X1. Y2.\nX+3.\n"), "G1 X1. Y2.\nX3.\n");
        check_rule(&RULE, "haas-mill", "G1 X+1. Y+2. F1.\nX+3.\n", &expect![[""]]);
    }
}
