//! Codes written with and without leading zeros in one file.

use crate::meta::declare_rule;
use crate::writing::{Question, word_around};
use crate::{FileCx, Report, Run};

declare_rule! {
    /// Codes are written in two ways in one file: `G1` and `G01`, `M3` and `M03`. Told once for `G` and once for `M`.
    ///
    /// ## Why it matters
    /// The control reads both. People who search for `G01` do not find `G1`, and a file of two hands is a file that somebody
    /// changed at the machine.
    ///
    /// ## Reported
    /// ```nc,reported,haas-mill
    /// G00 X1. Y1.
    /// G01 Z-0.5 F10.
    /// G1 X2.
    /// M30
    /// ```
    /// ## Not reported
    /// One way throughout.
    /// ```nc,quiet,haas-mill
    /// G0 X1. Y1.
    /// G1 Z-0.5 F10.
    /// M30
    /// ```
    rule "leading-zeros-mixed" in "style" {
        summary: "codes written with and without leading zeros",
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
    for question in [Question::ZeroInG, Question::ZeroInM] {
        let Some(odd) = cx.writing().habit(question).odd() else { continue };
        let Some(first) = odd.places.first() else { continue };
        let (place, word) = word_around(cx.text, first);
        let others = if odd.is_long { "without" } else { "with" };
        let message = format!("`{word}` among codes {others} a leading zero");
        report.add(odd.finding(&META, place, message, |_| zero(odd.is_long)));
    }
}

/// What stands in the place of the zero, written as the other codes are.
fn zero(is_odd: bool) -> String {
    if is_odd { "" } else { "0" }.to_owned()
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::{check_rule, mended};

    #[test]
    fn letters_are_counted_apart() {
        check_rule(
            &RULE,
            "fanuc-mill",
            "G0 X1.\nM03 S100\nG1 Y1. F100.\nM05\nG01 X2. M8\nG54.1 P1\n",
            &expect![[r#"
                5 | G01 X2. M8
                  | ^^^ hint[leading-zeros-mixed] `G01` among codes without a leading zero
                5 | G01 X2. M8
                  |         ^^ hint[leading-zeros-mixed] `M8` among codes with a leading zero
            "#]],
        );
    }

    #[test]
    fn the_fix_makes_one_hand_of_it() {
        assert_eq!(
            mended(&RULE, "haas-mill", "G00 X1.\nG01 X2. F1.\nG1 X0.\n"),
            "G00 X1.\nG01 X2. F1.\nG01 X0.\n"
        );
        assert_eq!(
            mended(&RULE, "haas-mill", "G0 X1.\nG1 X2. F1.\nG01 X0.\n"),
            "G0 X1.\nG1 X2. F1.\nG1 X0.\n"
        );
    }
}
