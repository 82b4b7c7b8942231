//! A tool that comes down because its length was cancelled.

use gcheck_controls::{Effect, Letter};
use gcheck_engine::{At, Axis, Event, Fact, Role, TravelKind};

use crate::declare::declare_rule;
use crate::{PathCx, PathRule, Report, Run, Uses, Watch};
use crate::{Remembers, remembers};

declare_rule! {
    /// The length of a tool is cancelled (`G49`), and the move in Z of this block, or the next rapid move in Z, does not rise by
    /// the length of a tool.
    ///
    /// ## Why it matters
    /// From there Z is the position of the spindle nose: the tool comes down by its own length, at rapid.
    ///
    /// ## Reported
    /// ```nc,reported,haas-mill
    /// G20 G90 G54 G0 X0. Y0.
    /// G43 H1 Z.1
    /// G0 G49 Z1.
    /// M30
    /// ```
    /// ## Not reported
    /// ```nc,quiet,haas-mill
    /// G20 G90 G54 G0 X0. Y0.
    /// G43 H1 Z.1
    /// G0 Z1.
    /// G53 G49 Z0.
    /// M30
    /// ```
    rule "length-cancelled-before-move" in "tool" {
        summary: "tool comes down because its length was cancelled",
        severity: Warning,
        tier: Path,
        since: "0.1.0",
        run: Run::Path {
            watch: Watch::BLOCKS.union(Watch::MOVES),
            make: || Box::new(LengthCancelledBeforeMove { cancelled: None }),
        },
    }
}

/// Millimetres: no tool in its holder is shorter.
const SHORTEST_TOOL: f64 = 50.0;

#[derive(Clone, PartialEq)]
struct LengthCancelledBeforeMove {
    /// The block that cancelled the length, and the height of the tip there in millimetres.
    cancelled: Option<(At, f64)>,
}

remembers!(LengthCancelledBeforeMove: cancelled);

impl PathRule for LengthCancelledBeforeMove {
    fn memory(&mut self) -> Remembers<'_> {
        Remembers::All(self)
    }

    fn concerns(&self, program: &Uses<'_>) -> bool {
        program.may(gives_length) && program.may(|effect| effect == Effect::LengthOff)
    }

    fn block(&mut self, cx: &PathCx<'_>, _: &mut Report<'_>) {
        let elsewhere = |effect| {
            matches!(
                effect,
                Effect::ToolChange
                    | Effect::LengthPlus
                    | Effect::LengthFiveAxis
                    | Effect::MachineCoordinates
                    | Effect::ReturnReference(_)
                    | Effect::WorkOffset(_)
                    | Effect::WorkOffsetByP(_)
            )
        };
        let is_on = cx.state().effect(Role::Length, cx.model).is_some_and(gives_length);
        if cx.has_effect(elsewhere) {
            self.cancelled = None;
        } else if is_on && cx.has_effect(|effect| effect == Effect::LengthOff) {
            self.cancelled = cx.state().position().get(Axis::Z).map(|height| (cx.origin().at, height));
        }
    }

    fn moved(&mut self, cx: &PathCx<'_>, event: &Event, report: &mut Report<'_>) {
        let Event::Travel(travel) = event else { return };
        if travel.expanded || !cx.origin().letters.contains(Letter::of('Z')) {
            return;
        }
        let Some((at, before)) = self.cancelled.take() else { return };
        // Another code gives a length again (`G234`, `G143`).
        if cx.state().effect(Role::Length, cx.model) != Some(Effect::LengthOff) {
            return;
        }
        // A later cut is another rule's; in the block that cancels the length a feed goes the same way.
        if travel.kind != TravelKind::Rapid && at != cx.origin().at
            || cx.state().is_incremental(cx.model) != Some(false)
        {
            return;
        }
        let Some(to) = travel.programmed.get(Axis::Z) else { return };
        let rises_by = to - before;
        // Where lengths are measured from the machine's zero, `Z0.` without one is the way home.
        if rises_by >= SHORTEST_TOOL || to == 0.0 {
            return;
        }
        let off = cx.name_of_effect(Effect::LengthOff).unwrap_or_default();
        let machine = cx.name_of_effect(Effect::MachineCoordinates).unwrap_or_default();
        let finding = cx
            .finding(
                &META,
                cx.letter_range('Z'),
                format!("the tool comes down: its length was cancelled before this move (`{off}`)"),
            )
            .label("moves the spindle nose to this Z: the tool goes deeper by its length")
            .assuming("length offsets are the lengths of tools, not distances from the machine's zero")
            .help(format!(
                "go up in machine coordinates (`{machine} {off} Z0.`), or keep the length for this move"
            ));
        let finding = match cx.range_of(at).filter(|_| at != cx.origin().at) {
            Some(range) => finding.also(range, "cancelled here"),
            None => finding,
        };
        report.add(cx.resting_on(finding, Fact::Mode(Role::Length), &format!("`{off}`")));
    }
}

/// Does the code add the length of the tool to Z?
fn gives_length(effect: Effect) -> bool {
    matches!(effect, Effect::LengthPlus | Effect::LengthFiveAxis)
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::check_rule;

    #[test]
    fn the_length_of_a_tilting_tool() {
        check_rule(
            &RULE,
            "haas-mill",
            "G20 G90 G94 G54 G0 X1.25 Y-.4\nG143 H1 X1.25 Y-.4 Z3. A0. B0.\nG0 X1.15 Y-.31 Z3. A-12.7 B9.7\nG49 M9\nG0 X1.15 Y-.31 Z3. A0. B0.\nG53 Z0.\nM30\n",
            &expect![[r#"
                5 | G0 X1.15 Y-.31 Z3. A0. B0.
                  |                ^^^ warning[length-cancelled-before-move] the tool comes down: its length was cancelled before this move (`G49`)
            "#]],
        );
    }

    #[test]
    fn a_feed_in_the_block_that_cancels_goes_down_too() {
        check_rule(
            &RULE,
            "haas-mill",
            "G20 G90 G54 G0 X0. Y0.\nG43 H1 Z.1\nG1 Z-.5 F10.\nX2.\nG49 Z1.\nG80 G0 Z1.\nM30\n",
            &expect![[r#"
                5 | G49 Z1.
                  |     ^^^ warning[length-cancelled-before-move] the tool comes down: its length was cancelled before this move (`G49`)
            "#]],
        );
    }

    #[test]
    fn another_length_may_follow() {
        for code in ["G43 H2", "G143 H1", "G234 H1"] {
            let program = format!("G20 G90 G54 G0 X0. Y0.\nG43 H1 Z1.\nG49\n{code} Z.1\nM30\n");
            check_rule(&RULE, "haas-mill", &program, &expect![[""]]);
        }
    }

    #[test]
    fn the_next_move_in_z_decides() {
        check_rule(
            &RULE,
            "haas-mill",
            "G20 G90 G54 G0 X0. Y0.\nG43 H1 Z.1\nG49\nX2.\nZ2.\nZ3.\nG43 H1 Z.1\nG49 Z10.\nG43 H1 Z.1\nG49\nG28 G91 Z0.\nG90\nM30\n",
            &expect![[r#"
                5 | Z2.
                  | ^^^ warning[length-cancelled-before-move] the tool comes down: its length was cancelled before this move (`G49`)
            "#]],
        );
    }
}
