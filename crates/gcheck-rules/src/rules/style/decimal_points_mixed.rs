//! Whole positions with and without a decimal point, where both mean one.

use crate::meta::declare_rule;
use crate::writing::{Question, word_around};
use crate::{FileCx, Report, Run};

declare_rule! {
    /// Whole positions are written in two ways in one file: `X1` and `X1.`, on a control that reads both as one. Told once for
    /// the file.
    ///
    /// ## Why it matters
    /// On another control the same number without a point is a thousandth of it. A file with points throughout can be moved to
    /// any machine, one without can be recognised at a glance; a mixture is neither.
    ///
    /// ## Reported
    /// ```nc,reported,linuxcnc
    /// G1 X1. Y2. F100
    /// X3
    /// M2
    /// ```
    /// ## Not reported
    /// Where the point changes the value, its absence is no matter of style: see `missing-decimal-point`.
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
        mends: Safely,
        since: "0.1.0",
        run: Run::Program { check },
    }
}

fn check(cx: &FileCx<'_>, report: &mut Report<'_>) {
    let Some(odd) = cx.writing().habit(Question::Point).odd() else { return };
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
    use crate::testing::{check_rule, mended};

    #[test]
    fn the_fix_follows_the_many() {
        assert_eq!(mended(&RULE, "linuxcnc", "G0 X1. Y2.\nX-3\n"), "G0 X1. Y2.\nX-3.\n");
        assert_eq!(mended(&RULE, "linuxcnc", "G0 X1 Y2\nX-3.\n"), "G0 X1 Y2\nX-3\n");
    }

    #[test]
    fn counts_are_no_positions() {
        check_rule(&RULE, "linuxcnc", "G0 X1. Y2.\nG4 P2\nM3 S1000\n", &expect![[""]]);
    }
}
