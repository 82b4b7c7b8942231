//! Capitals and small letters in one file.

use crate::declare::declare_rule;
use crate::facts::notation::{Notation, Question, word_around};
use crate::{FileCx, Report, Run};

declare_rule! {
    /// Addresses are written in capitals in some places and in small letters in others, on a control that reads both.
    /// Reported once per file.
    ///
    /// ## Why it matters
    /// Not every control reads small letters. If a file has one case, its first line shows whether another control can
    /// read it.
    ///
    /// ## Reported
    /// ```nc,reported,linuxcnc
    /// G0 X1 Y1
    /// g1 Z-1 F100
    /// M2
    /// ```
    /// ## Not reported
    /// ```nc,quiet,linuxcnc
    /// g0 x1 y1
    /// g1 z-1 f100
    /// m2
    /// ```
    rule "letter-case-mixed" in "style" {
        summary: "capitals and small letters mixed",
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
    let Some(odd) = notation.habit(Question::Capital).odd() else { return };
    let Some(first) = odd.places.first() else { return };
    let (place, word) = word_around(cx.text, &(first.end..first.end));
    let (found, others) =
        if odd.is_long { ("a capital", "small letters") } else { ("a small letter", "capitals") };
    let message = format!("`{word}` with {found} among {others}");
    report.add(odd.finding(&META, place, message, |letter| {
        let letter = cx.slice(letter.clone());
        if odd.is_long { letter.to_ascii_lowercase() } else { letter.to_ascii_uppercase() }
    }));
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::{check_rule, fixes_of};

    #[test]
    fn the_fix_follows_the_many() {
        assert_eq!(fixes_of(&RULE, "linuxcnc", "G0 X1 Y1\ng1 X2 f100\n"), "G0 X1 Y1\nG1 X2 F100\n");
        assert_eq!(fixes_of(&RULE, "linuxcnc", "g0 x1 y1\nG1 x2 f100\n"), "g0 x1 y1\ng1 x2 f100\n");
    }

    #[test]
    fn a_colon_is_no_letter() {
        check_rule(&RULE, "linuxcnc", "G0 X1 Y2\n:1234 G1 X2 F100\n", &expect![[""]]);
    }

    #[test]
    fn names_and_keywords_are_no_addresses() {
        check_rule(&RULE, "linuxcnc", "o<Cut> sub\nG0 X#<wide>\no<Cut> endsub\n", &expect![[""]]);
    }
}
