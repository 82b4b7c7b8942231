//! Increments that may be left on.

use std::ops::Range;

use gcheck_controls::{CodeIx, Effect, LetterSet};
use gcheck_engine::{Event, Fact, Role};

use crate::declare::declare_rule;
use crate::facts::boundary::{Boundary, boundary, boundary_range};
use crate::facts::modes::ignores_distance_mode;
use crate::{PathCx, PathRule, Report, Run, Uses, Watch};
use crate::{Remembers, remembers};

declare_rule! {
    /// Paths of the program join, one in increments (`G91`) and one in positions (`G90`), and then a block moves.
    ///
    /// ## Why it matters
    /// The same block moves to a point on one path and by its coordinates on the other. One of the two is wrong.
    ///
    /// ## Reported
    /// ```nc,reported,fanuc-mill
    /// G90 G0 X0. Y0.
    /// IF [#500 EQ 1] GOTO 5
    /// G91 G28 Z0.
    /// N5 G0 X10. Y10.
    /// M30
    /// ```
    /// ## Not reported
    /// ```nc,quiet,fanuc-mill
    /// G90 G0 X0. Y0.
    /// IF [#500 EQ 1] GOTO 5
    /// G91 G28 Z0.
    /// N5 G90 G0 X10. Y10.
    /// M30
    /// ```
    rule "maybe-incremental-left-on" in "modal" {
        summary: "increments may be left on",
        severity: Warning,
        tier: Path,
        since: "0.1.0",
        run: Run::Path {
            watch: Watch::BLOCKS.union(Watch::RAPIDS).union(Watch::CUTS),
            make: || Box::new(MaybeIncrementalLeftOn { change: None, is_told: false }),
        },
    }
}

#[derive(Clone, PartialEq)]
struct MaybeIncrementalLeftOn {
    change: Option<Range<u32>>,
    /// Reported since the mode was last certain.
    is_told: bool,
}

remembers!(MaybeIncrementalLeftOn: change);

impl PathRule for MaybeIncrementalLeftOn {
    fn memory(&mut self) -> Remembers<'_> {
        Remembers::All(self)
    }

    fn concerns(&self, program: &Uses<'_>) -> bool {
        program.may(|effect| effect == Effect::Incremental)
    }

    fn block(&mut self, cx: &PathCx<'_>, _: &mut Report<'_>) {
        if boundary(cx) == Some(Boundary::ToolChange) {
            self.change = Some(boundary_range(cx, Boundary::ToolChange));
        }
    }

    fn rapid(&mut self, cx: &PathCx<'_>, _: &Event, report: &mut Report<'_>) {
        self.moves(cx, report);
    }

    fn cut(&mut self, cx: &PathCx<'_>, _: &Event, report: &mut Report<'_>) {
        self.moves(cx, report);
    }
}

impl MaybeIncrementalLeftOn {
    fn moves(&mut self, cx: &PathCx<'_>, report: &mut Report<'_>) {
        if ignores_distance_mode(cx) || !cx.origin().letters.intersects(LetterSet::of("XYZ")) {
            return;
        }
        let mode = cx.state().mode(Role::Distance);
        if mode.only().is_some() {
            self.is_told = false;
            self.change = None;
            return;
        }
        let has = |wanted: Effect| {
            let is = |code: &CodeIx| code.is_some() && cx.model.effect(*code) == wanted;
            mode.alternatives().iter().any(is)
        };
        let change = self.change.take();
        if !has(Effect::Incremental) || !has(Effect::Absolute) || std::mem::replace(&mut self.is_told, true) {
            return;
        }
        if cx.is_called_only() || cx.definitions().set_by(Fact::Mode(Role::Distance)).is_none() {
            return;
        }
        let incremental = cx.name_of_effect(Effect::Incremental).unwrap_or_default();
        let absolute = cx.name_of_effect(Effect::Absolute).unwrap_or_default();
        let mut finding = cx
            .finding(&META, cx.range(), format!("the move may be in increments (`{incremental}`)"))
            .label("to this point on one path, by this much on another")
            .help(format!("state `{absolute}` after the paths have joined"));
        if let Some(range) = change {
            finding = finding.also(range, "tool changed here");
        }
        report.add(cx.with_path(finding));
    }
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::check_rule;

    #[test]
    fn the_first_move_behind_the_meeting_is_marked() {
        check_rule(
            &RULE,
            "haas-mill",
            "G20 G90 G0 X0.\nIF [#500 EQ 1] GOTO 5\nG91 G1 Z-1. F5.\nN5 G0 X1.\nX2.\nM30\n",
            &expect![[r#"
                4 | N5 G0 X1.
                  | ^^^^^^^^^ warning[maybe-incremental-left-on] the move may be in increments (`G91`)
            "#]],
        );
    }

    #[test]
    fn certain_increments_are_none_of_its_business() {
        check_rule(
            &RULE,
            "haas-mill",
            "G20 G91 G0 X0.\nIF [#500 EQ 1] GOTO 5\nX1.\nN5 X1.\nM30\n",
            &expect![[""]],
        );
    }

    #[test]
    fn a_program_that_is_not_at_hand_says_nothing() {
        check_rule(&RULE, "haas-mill", "G20 G90 G0 X0.\nM98 P9000\nX1.\nM30\n", &expect![[""]]);
    }
}
