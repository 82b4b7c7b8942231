//! Line ends of two kinds in one file.

use crate::declare::declare_rule;
use crate::facts::notation::{Notation, Question};
use crate::{FileCx, Report, Run};

declare_rule! {
    /// Some lines end with a line feed, others with a carriage return and a line feed. Reported once per file.
    ///
    /// ## Why it matters
    /// The file comes from two sources. Controls that load over a serial line may read a block twice, and tools that
    /// compare files show changes that are not there.
    ///
    /// ## Reported
    /// `␍` stands for a carriage return.
    /// ```nc,reported,haas-mill
    /// G0 X1.␍
    /// G0 X2.␍
    /// M30
    /// ```
    /// ## Not reported
    /// ```nc,quiet,haas-mill
    /// G0 X1.
    /// M30
    /// ```
    rule "line-ends-mixed" in "style" {
        summary: "line ends of two kinds",
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
    let Some(odd) = notation.habit(Question::LineEnd).odd() else { return };
    let Some(first) = odd.places.first() else { return };
    let (found, others) = if odd.is_long {
        ("carriage return and line feed", "line feed")
    } else {
        ("line feed", "carriage return and line feed")
    };
    let message = format!("line ends with {found} among lines with {others}");
    let written = if odd.is_long { "" } else { "\r" };
    report.add(odd.finding(&META, first.clone(), message, |_| written.to_owned()));
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::{check_rule, fixes_of};

    #[test]
    fn the_fix_follows_the_many() {
        check_rule(&RULE, "haas-mill", "G0 X1.\r\nX2.\r\n", &expect![[""]]);
        assert_eq!(fixes_of(&RULE, "haas-mill", "G0 X1.\r\nX2.\nX3.\r\n"), "G0 X1.\r\nX2.\r\nX3.\r\n");
        assert_eq!(fixes_of(&RULE, "haas-mill", "G0 X1.\nX2.\r\nX3.\n"), "G0 X1.\nX2.\nX3.\n");
    }
}
