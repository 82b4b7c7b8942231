//! A touch that is kept and never used.

use gcheck_controls::Effect;
use gcheck_engine::{At, Ending, Touch};

use crate::declare::declare_rule;
use crate::facts::probing::is_second_touch;
use crate::{PathCx, PathRule, Report, Run, Watch};
use crate::{Remembers, remembers};

declare_rule! {
    /// A touch is kept (`M75`), and the program ends without a second touch that measures from it (`G136`, `G35`).
    ///
    /// ## Why it matters
    /// The half of the measurement that writes the offset is missing: perhaps `G31` or `G1` was written instead of
    /// `G136`. The work offset or the tool's size does not change.
    ///
    /// ## Reported
    /// ```nc,reported,haas-mill
    /// G90 G54 G0 X0. Y5.
    /// G91 G31 Y-1. F10. M75
    /// G0 Y-8.
    /// G31 Y1. F10.
    /// G90
    /// M30
    /// ```
    /// ## Not reported
    /// ```nc,quiet,haas-mill
    /// G90 G54 G0 X0. Y5.
    /// G91 G31 Y-1. F10. M75
    /// G0 Y-8.
    /// G136 Y1. F10.
    /// G90
    /// M30
    /// ```
    rule "kept-touch-never-used" in "probing" {
        summary: "touch kept for a measurement that never comes",
        severity: Warning,
        tier: Path,
        since: "0.1.0",
        run: Run::Path {
            watch: Watch::BLOCKS.union(Watch::ENDS),
            make: || Box::new(KeptTouchNeverUsed { kept: None }),
        },
    }
}

#[derive(Clone, PartialEq)]
struct KeptTouchNeverUsed {
    /// The last touch that was kept and not used yet.
    kept: Option<At>,
}

remembers!(KeptTouchNeverUsed: kept);

impl PathRule for KeptTouchNeverUsed {
    /// Another way may measure from it.
    fn counts_on_some_path(&self) -> bool {
        false
    }

    fn memory(&mut self) -> Remembers<'_> {
        Remembers::All(self)
    }

    fn block(&mut self, cx: &PathCx<'_>, _: &mut Report<'_>) {
        if cx.has_effect(is_second_touch) {
            self.kept = None;
        }
        if cx.has_effect(|effect| effect == Effect::KeepTouch) {
            self.kept = Some(cx.origin().at);
        }
    }

    fn ended(&mut self, cx: &PathCx<'_>, _: Ending, report: &mut Report<'_>) {
        // A program that gcheck does not have may measure; so may another path.
        let is_certain = matches!(cx.state().kept_touch(), Touch::Made(_)) && cx.is_on_every_path();
        let Some(at) = self.kept.filter(|_| is_certain && !cx.is_called_only()) else { return };
        let keeps = |word: &gcheck_program::Word| cx.model.effect(word.code) == Effect::KeepTouch;
        let Some(range) = cx.find_word(at, keeps) else { return };
        let measures = cx.name_of_effect(Effect::ProbeCentre).unwrap_or_default();
        report.add(
            cx.finding(&META, range, "touch kept, but nothing measures from it")
                .label("the first touch of two; the second never comes")
                .help(format!("touch the other side with `{measures}`, or remove this code")),
        );
    }
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::check_rule;

    #[test]
    fn the_code_that_keeps_is_marked() {
        check_rule(
            &RULE,
            "haas-mill",
            "G91 G31 X1. F10. M75\nG90\nM30\n",
            &expect![[r#"
            1 | G91 G31 X1. F10. M75
              |                  ^^^ warning[kept-touch-never-used] touch kept, but nothing measures from it
        "#]],
        );
    }

    #[test]
    fn a_second_touch_in_a_subprogram_counts() {
        check_rule(
            &RULE,
            "haas-mill",
            "G91 G31 X1. F10. M75\nM97 P10\nG90\nM30\nN10 G136 X-1. F10.\nM99\n",
            &expect![[""]],
        );
    }

    #[test]
    fn others_may_use_it() {
        check_rule(&RULE, "haas-mill", "G91 G31 X1. F10. M75\nG65 P9100\nG90\nM30\n", &expect![[""]]);
        check_rule(&RULE, "haas-mill", "O9100\nG91 G31 X1. F10. M75\nM99\n", &expect![[""]]);
        check_rule(
            &RULE,
            "haas-mill",
            "G91 G31 X1. F10. M75\nIF [#100 EQ 1] GOTO10\nG136 X-1. F10.\nN10 G90\nM30\n",
            &expect![[""]],
        );
    }
}
