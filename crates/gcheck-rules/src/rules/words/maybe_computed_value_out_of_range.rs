//! A computed value that its code cannot use on some path.

use crate::declare::declare_rule;
use crate::facts::callers::CallerValues;
use crate::facts::computed_words::{self, refused};
use crate::{PathCx, PathRule, Report, Run, Severity, Watch};
use crate::{Remembers, remembers};

declare_rule! {
    /// A word's value is computed, and on some paths that come here the code cannot use it.
    ///
    /// ## Why it matters
    /// The program runs well until the other path is taken; then the control stops with an alarm at the block, or uses a
    /// wrong value.
    ///
    /// ## Reported
    /// ```nc,reported,haas-mill
    /// #1=5
    /// IF [#500 EQ 1] GOTO10
    /// #1=120
    /// N10 G154 P#1
    /// M30
    /// ```
    /// ## Not reported
    /// ```nc,quiet,haas-mill
    /// #1=5
    /// IF [#500 EQ 1] GOTO10
    /// #1=20
    /// N10 G154 P#1
    /// M30
    /// ```
    rule "maybe-computed-value-out-of-range" in "words" {
        summary: "computed value that its code cannot use on some path",
        severity: Warning,
        tier: Path,
        since: "0.1.0",
        run: Run::Path { watch: Watch::ALL_BLOCKS, make: || Box::new(MaybeComputedValueOutOfRange::default()) },
    }
}

#[derive(Default, Clone, PartialEq)]
struct MaybeComputedValueOutOfRange {
    callers: CallerValues,
}

remembers!(MaybeComputedValueOutOfRange);

impl PathRule for MaybeComputedValueOutOfRange {
    fn memory(&mut self) -> Remembers<'_> {
        Remembers::All(self)
    }

    fn block(&mut self, cx: &PathCx<'_>, report: &mut Report<'_>) {
        self.callers.see(cx);
        for one in refused(cx, &self.callers).iter().filter(|one| !one.is_certain) {
            report.add(cx.with_path(computed_words::finding(cx, &META, one)).at_most(Severity::Warning));
        }
    }
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::check_rule;

    #[test]
    fn a_value_of_one_path_is_enough() {
        check_rule(
            &RULE,
            "haas-mill",
            "#1=5\nIF [#500 EQ 1] GOTO10\n#1=120\nN10 G154 P#1\nM30\n",
            &expect![[r#"
                4 | N10 G154 P#1
                  |          ^^^ warning[maybe-computed-value-out-of-range] computed value may be too large for `G154`: `P120`
            "#]],
        );
    }

    #[test]
    fn a_condition_of_the_program_takes_the_value_away() {
        check_rule(
            &RULE,
            "haas-mill",
            "#1=5\nIF [#500 EQ 1] GOTO10\n#1=120\nN10 IF [#1 GT 99] GOTO20\nG154 P#1\nN20 M30\n",
            &expect![[""]],
        );
    }
}
