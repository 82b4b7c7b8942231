//! Codes written with and without leading zeros in one file.

use crate::declare::declare_rule;
use crate::facts::notation::{Notation, Question, word_around};
use crate::{FileCx, Report, Run};

declare_rule! {
    /// Codes are written in two ways in one file: `G1` and `G01`, `M3` and `M03`. Reported once for `G` and once for
    /// `M`.
    ///
    /// ## Why it matters
    /// The control reads both. A search for `G01` does not find `G1`, and two forms suggest that the file was changed
    /// at the machine.
    ///
    /// ## Reported
    /// ```nc,reported,haas-mill
    /// G00 X1. Y1.
    /// G01 Z-0.5 F10.
    /// G1 X2.
    /// M30
    /// ```
    /// ## Not reported
    /// One form throughout.
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
        fixable: Safely,
        since: "0.1.0",
        run: Run::Program { check },
    }
}

fn check(cx: &FileCx<'_>, report: &mut Report<'_>) {
    for question in [Question::ZeroInG, Question::ZeroInM] {
        let notation = cx.fact::<Notation>();
        let Some(odd) = notation.habit(question).odd() else { continue };
        let Some(first) = odd.places.first() else { continue };
        let (place, word) = word_around(cx.text, first);
        let others = if odd.is_long { "without" } else { "with" };
        let message = format!("`{word}` among codes {others} a leading zero");
        report.add(odd.finding(&META, place, message, |_| zero(odd.is_long)));
    }
}

/// The code in the form of the other codes.
fn zero(is_odd: bool) -> String {
    if is_odd { "" } else { "0" }.to_owned()
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::{check_rule, fixes_of};

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
            fixes_of(&RULE, "haas-mill", "G00 X1.\nG01 X2. F1.\nG1 X0.\n"),
            "G00 X1.\nG01 X2. F1.\nG01 X0.\n"
        );
        assert_eq!(
            fixes_of(&RULE, "haas-mill", "G0 X1.\nG1 X2. F1.\nG01 X0.\n"),
            "G0 X1.\nG1 X2. F1.\nG1 X0.\n"
        );
    }
}
