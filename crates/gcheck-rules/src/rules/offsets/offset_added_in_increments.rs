//! An offset that is added to, because increments are still on.

use gcheck_controls::{Effect, Letter, LetterSet};
use gcheck_engine::{At, Fact, Role};

use crate::declare::declare_rule;
use crate::{PathCx, PathRule, Report, Run, Uses, Watch, limit};
use crate::{Remembers, remembers};

declare_rule! {
    /// `G10` writes an offset while increments (`G91`) are on, and the block that switched them on was a move, such as
    /// `G91 G28 Z0`: nobody meant them for the offset.
    ///
    /// `G91` in the block of `G10`, or in a block of its own, is taken as meant.
    ///
    /// ## Why it matters
    /// Under `G91` the control adds the numbers to the offset that is there. Each run of the program shifts the zero of the
    /// part, or the length of the tool, by the same amount again.
    ///
    /// ## Reported
    /// ```nc,reported,haas-mill
    /// G20 G90
    /// G91 G28 Z0.
    /// G10 L2 P1 X-10. Y-5. Z-12.
    /// G90
    /// M30
    /// ```
    /// ## Not reported
    /// ```nc,quiet,haas-mill
    /// G20 G90
    /// G91 G28 Z0.
    /// G90 G10 L2 P1 X-10. Y-5. Z-12.
    /// M30
    /// ```
    /// ```nc,quiet,haas-mill
    /// G20 G90
    /// G91 G10 L2 P1 Z-.002
    /// G90
    /// M30
    /// ```
    rule "offset-added-in-increments" in "offsets" {
        summary: "offset added to because `G91` is still on",
        severity: Warning,
        tier: Path,
        since: "0.1.0",
        run: Run::Path { watch: Watch::BLOCKS, make: || Box::new(OffsetAddedInIncrements { told: None }) },
    }
}

#[derive(Clone, PartialEq)]
struct OffsetAddedInIncrements {
    /// The block that switched increments on, once it is reported.
    told: Option<At>,
}

remembers!(OffsetAddedInIncrements: told);

impl PathRule for OffsetAddedInIncrements {
    fn memory(&mut self) -> Remembers<'_> {
        Remembers::All(self)
    }

    fn concerns(&self, program: &Uses<'_>) -> bool {
        // A strict control sets offsets in either mode.
        let adds = !program.environment.control().semantics().strict;
        adds && program.may(writes) && program.may(|effect| effect == Effect::Incremental)
    }

    fn block(&mut self, cx: &PathCx<'_>, report: &mut Report<'_>) {
        if !cx.has_effect(writes) || cx.is_malformed() || cx.code_of_role(Role::Distance).is_some() {
            return;
        }
        let mode = Fact::Mode(Role::Distance);
        if cx.state().effect(Role::Distance, cx.model) != Some(Effect::Incremental) {
            return;
        }
        let Some(switched) = cx.definitions().set_by(mode).filter(|at| self.told != Some(*at)) else {
            return;
        };
        let moves = |at: At| cx.place_of(at).is_some_and(|place| cx.has_axis_among(place.block().letters));
        let gives = cx.origin().letters.contains(Letter::of('R')) || cx.names_axes();
        let is_zero = |letter: char| cx.known_number(letter) == Some(0.0);
        let letters = cx.origin().letters.and(LetterSet::of("XYZABCUVWR"));
        let adds_nothing = letters.iter().all(|letter| is_zero(letter.ascii().into()));
        if switched.file != 0 || !moves(switched) || !gives || adds_nothing {
            return;
        }
        self.told = Some(switched);
        let finding = cx
            .finding(
                &META,
                cx.effect_range(writes),
                "the numbers are added to the offset, and do not set it (`G91`)",
            )
            .label("each run of the program changes the offset again")
            .help(
                "write `G90` before this block, or `G91` into it if the offset is to change by these numbers",
            )
            .at_most(limit(cx.model.semantics().confidence));
        report.add(cx.resting_on(finding, mode, "`G91`"));
    }
}

fn writes(effect: Effect) -> bool {
    effect == Effect::WriteOffsets
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::check_rule;

    #[test]
    fn lengths_of_tools_too() {
        let program = |mode: &str| format!("G21 G90\nG91 G28 Z0\n{mode}G10 L10 P1 R120.\nG90\nM30\n");
        check_rule(
            &RULE,
            "fanuc-mill",
            &program(""),
            &expect![[r#"
            3 | G10 L10 P1 R120.
              | ^^^ warning[offset-added-in-increments] the numbers are added to the offset, and do not set it (`G91`)
        "#]],
        );
        check_rule(&RULE, "fanuc-mill", &program("G90\n"), &expect![[""]]);
        check_rule(&RULE, "fanuc-mill", &program("G90\nG91\n"), &expect![[""]]);
    }

    #[test]
    fn nothing_is_added_by_zero() {
        check_rule(&RULE, "fanuc-mill", "G90\nG91 G28 Z0\nG10 L2 P1 X0 Y0\nG90\nM30\n", &expect![[""]]);
    }

    #[test]
    fn a_control_that_sets_in_either_mode() {
        check_rule(&RULE, "linuxcnc", "G90\nG91 G28 Z0\nG10 L2 P1 X10\nG90\nM2\n", &expect![[""]]);
    }

    #[test]
    fn each_cause_is_told_once() {
        let program = "G21 G90\nG91 G28 Z0\nG10 L2 P1 X-10.\nG10 L2 P2 X-20.\nG90\nM30\n";
        check_rule(
            &RULE,
            "haas-mill",
            program,
            &expect![[r#"
            3 | G10 L2 P1 X-10.
              | ^^^ warning[offset-added-in-increments] the numbers are added to the offset, and do not set it (`G91`)
        "#]],
        );
    }
}
