//! A canned cycle that may still be on where it does harm.

use std::collections::BTreeSet;

use gcheck_engine::{At, Fact, Role};

use super::cycle_left_on::{Harm, place};
use super::cycle_words_lost::is_cycle;
use crate::boundary::LeftOn;
use crate::memory::{Remembers, remembers};
use crate::meta::declare_rule;
use crate::{PathCx, PathRule, Report, Run, Watch};

declare_rule! {
    /// On some path a canned cycle is still active at a tool change or at a return to the reference position.
    ///
    /// ## Why it matters
    /// Every block with a position drills a hole there until `G80`; the path that skips the `G80` is the one that nobody
    /// tried.
    ///
    /// ## Reported
    /// ```nc,reported,haas-mill
    /// G90 G54 G0 X0 Y0
    /// G81 Z-1. R.1 F10.
    /// IF [#100 EQ 1] GOTO10
    /// G80
    /// N10 T2 M6
    /// G0 X0
    /// M30
    /// ```
    /// ## Not reported
    /// ```nc,quiet,haas-mill
    /// G90 G54 G0 X0 Y0
    /// G81 Z-1. R.1 F10.
    /// IF [#100 EQ 1] GOTO10
    /// X1.
    /// N10 G80
    /// T2 M6
    /// G0 X0
    /// M30
    /// ```
    rule "maybe-cycle-left-on" in "cycles" {
        summary: "canned cycle that some path leaves on",
        severity: Info,
        tier: Path,
        since: "0.1.0",
        run: Run::Path { watch: Watch::BLOCKS, make: || Box::new(MaybeCycleLeftOn::default()) },
    }
}

#[derive(Default, Clone, PartialEq)]
struct MaybeCycleLeftOn {
    /// What was told of: one finding for each cycle.
    told: BTreeSet<Option<At>>,
}

remembers!(MaybeCycleLeftOn: told);

impl PathRule for MaybeCycleLeftOn {
    fn memory(&mut self) -> Remembers<'_> {
        Remembers::All(self)
    }

    fn block(&mut self, cx: &PathCx<'_>, report: &mut Report<'_>) {
        let Some(harm) = place(cx).filter(|harm| *harm != Harm::End) else { return };
        let Some(LeftOn::Maybe(code)) = cx.left_on(Role::Cycle, is_cycle) else { return };
        let fact = Fact::Mode(Role::Cycle);
        if !self.told.insert(cx.trace().set_by(fact)) {
            return;
        }
        let name = cx.name_of(code);
        let finding = cx
            .finding(
                &META,
                harm.range(cx),
                format!("canned cycle may still be on {} (`{name}`)", harm.words()),
            )
            .label("on some path the next block with a position drills a hole")
            .help("end the cycle with `G80` where the paths have met again");
        report.add(cx.with_path(finding));
    }
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::check_rule;

    #[test]
    fn the_word_that_does_harm_is_marked() {
        check_rule(
            &RULE,
            "fanuc-mill",
            "G90 G54 G0 X0 Y0\nIF [#500 EQ 1] GOTO 10\nG81 Z-10. R2. F100.\nN10 G91 G28 Z0\nG80\nM30\n",
            &expect![[r#"
                4 | N10 G91 G28 Z0
                  |         ^^^ info[maybe-cycle-left-on] canned cycle may still be on at the reference return (`G81`)
            "#]],
        );
    }

    #[test]
    fn behind_a_program_that_is_not_at_hand_nothing_is_known() {
        check_rule(&RULE, "fanuc-mill", "G90 G54 G0 X0 Y0\nM98 P1234\nG91 G28 Z0\nM30\n", &expect![[""]]);
    }
}
