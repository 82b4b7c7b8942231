//! A canned cycle that may still be active at a tool change or a reference return.

use std::collections::BTreeSet;

use gcheck_engine::{At, Fact, Role};

use crate::declare::declare_rule;
use crate::facts::cycles::{CycleBoundary, cycle_boundary, is_cycle};
use crate::facts::modes::{ActiveMode, left_on};
use crate::{PathCx, PathRule, Report, Run, Watch};
use crate::{Remembers, remembers};

declare_rule! {
    /// On some paths a canned cycle is still active at a tool change or at a return to the reference position.
    ///
    /// ## Why it matters
    /// Until `G80`, every block with a position drills a hole there; the path that skips the `G80` is usually the one
    /// that was never tried.
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
        summary: "canned cycle that some paths leave on",
        severity: Info,
        tier: Path,
        since: "0.1.0",
        run: Run::Path { watch: Watch::BLOCKS, make: || Box::new(MaybeCycleLeftOn::default()) },
    }
}

#[derive(Default, Clone, PartialEq)]
struct MaybeCycleLeftOn {
    /// Reported: one finding for each cycle.
    told: BTreeSet<Option<At>>,
}

remembers!(MaybeCycleLeftOn: told);

impl PathRule for MaybeCycleLeftOn {
    fn memory(&mut self) -> Remembers<'_> {
        Remembers::All(self)
    }

    fn block(&mut self, cx: &PathCx<'_>, report: &mut Report<'_>) {
        let Some(harm) = cycle_boundary(cx).filter(|harm| *harm != CycleBoundary::ProgramEnd) else { return };
        let Some(ActiveMode::Possible(code)) = left_on(cx, Role::Cycle, is_cycle) else { return };
        let fact = Fact::Mode(Role::Cycle);
        if !self.told.insert(cx.definitions().set_by(fact)) {
            return;
        }
        let name = cx.name_of(code);
        let finding = cx
            .finding(
                &META,
                harm.range(cx),
                format!("canned cycle may still be on {} (`{name}`)", harm.words()),
            )
            .label("on some paths the next block with a position drills a hole")
            .help("end the cycle with `G80` after the paths have joined");
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
