//! A program that moves before `G90` or `G91` is stated.

use gcheck_controls::{Effect, LetterSet};
use gcheck_engine::{Event, Fact, Role};

use crate::declare::declare_rule;
use crate::facts::modes::ignores_distance_mode;
use crate::{PathCx, PathRule, Report, Run, Severity, Watch};
use crate::{Remembers, remembers};

declare_rule! {
    /// A program moves before it states whether its words are positions (`G90`) or increments (`G91`).
    ///
    /// ## Why it matters
    /// A program that ended, or was stopped, in increments leaves them on. The next one then takes its positions as
    /// increments.
    ///
    /// ## Reported
    /// ```nc,reported,fanuc-mill
    /// G21 G54 G0 X100. Y50.
    /// M30
    /// ```
    /// ## Not reported
    /// ```nc,quiet,fanuc-mill
    /// G21 G90 G54 G0 X100. Y50.
    /// M30
    /// ```
    /// Moves to a reference point or in machine coordinates do not depend on the mode, if they go home.
    /// ```nc,quiet,fanuc-mill
    /// G91 G28 Z0.
    /// G90 G54 G0 X100. Y50.
    /// M30
    /// ```
    rule "distance-mode-not-stated" in "modal" {
        summary: "moves before `G90` or `G91` is stated",
        severity: Info,
        tier: Path,
        recommended: false,
        sets: [Strict, RestartSafe],
        fixable: OnRequest,
        since: "0.1.0",
        run: Run::Path {
            watch: Watch::RAPIDS.union(Watch::CUTS),
            make: || Box::new(DistanceModeNotStated { is_done: false }),
        },
    }
}

#[derive(Clone, PartialEq)]
struct DistanceModeNotStated {
    is_done: bool,
}

remembers!(DistanceModeNotStated);

impl PathRule for DistanceModeNotStated {
    fn memory(&mut self) -> Remembers<'_> {
        Remembers::All(self)
    }

    fn rapid(&mut self, cx: &PathCx<'_>, _: &Event, report: &mut Report<'_>) {
        self.first_move(cx, report);
    }

    fn cut(&mut self, cx: &PathCx<'_>, _: &Event, report: &mut Report<'_>) {
        self.first_move(cx, report);
    }
}

impl DistanceModeNotStated {
    fn first_move(&mut self, cx: &PathCx<'_>, report: &mut Report<'_>) {
        if self.is_done {
            cx.enough();
            return;
        }
        if ignores_distance_mode(cx) || !cx.origin().letters.intersects(LetterSet::of("XYZABC")) {
            return;
        }
        self.is_done = true;
        let is_stated =
            cx.definitions().set_by(Fact::Mode(Role::Distance)).is_some() || cx.is_after_unknown_program();
        let is_default = |effect| effect == Effect::Absolute;
        if is_stated
            || cx.is_called_only()
            || !cx.control_has(|effect| effect == Effect::Incremental)
            || has_own_letters(cx)
        {
            return;
        }
        let (Some(absolute), Some(incremental)) =
            (cx.name_of_effect(Effect::Absolute), cx.name_of_effect(Effect::Incremental))
        else {
            return;
        };
        let finding = cx
            .finding(
                &META,
                cx.range(),
                format!("moves before positions or increments are stated (`{absolute}`, `{incremental}`)"),
            )
            .label("depends on the mode that the last program left")
            .help(format!("state `{absolute}` at the head of the program"))
            .fix_if(cx.block_before(Some(&absolute)));
        // Every end of program restores positions: only a program that was stopped leaves increments.
        let is_safe = cx.at_end().any(|code| is_default(code.effect()));
        report.add(if is_safe { finding.at_most(Severity::Hint) } else { finding });
    }
}

/// Increments have their own letters (`U`, `W`): the mode is not needed.
fn has_own_letters(cx: &PathCx<'_>) -> bool {
    !cx.model.semantics().increments.is_empty()
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::check_rule;

    #[test]
    fn the_first_move_is_marked() {
        check_rule(
            &RULE,
            "fanuc-mill",
            "G21 G54\nG0 X1.\nX2.\nM30\n",
            &expect![[r#"
            2 | G0 X1.
              | ^^^^^^ info[distance-mode-not-stated] moves before positions or increments are stated (`G90`, `G91`)
        "#]],
        );
    }

    #[test]
    fn a_control_whose_programs_end_in_positions_is_safer() {
        check_rule(
            &RULE,
            "haas-mill",
            "G20 G54\nG0 X1.\nM30\n",
            &expect![[r#"
            2 | G0 X1.
              | ^^^^^^ hint[distance-mode-not-stated] moves before positions or increments are stated (`G90`, `G91`)
        "#]],
        );
    }

    #[test]
    fn a_lathe_without_the_codes_has_nothing_to_state() {
        check_rule(&RULE, "fanuc-lathe", "T0101\nG0 X1. W2.\nM30\n", &expect![[""]]);
        check_rule(&RULE, "haas-lathe", "T101\nG0 X1. W2.\nM30\n", &expect![[""]]);
    }

    #[test]
    fn a_subprogram_moves_as_its_caller_does() {
        check_rule(&RULE, "fanuc-mill", "O10\nG0 X1.\nM99\n", &expect![[""]]);
    }
}
