//! A tool that comes down because its length was cancelled.

use gcheck_controls::{Effect, Letter};
use gcheck_engine::{At, Axis, Event, Role, TravelKind};
use gcheck_geometry::Mm;

use crate::declare::declare_rule;
use crate::facts::cancelled_length::{cancelled, ending};
use crate::{Certainty, PathCx, PathRule, Report, Run, Severity, Uses, Watch};
use crate::{Remembers, remembers};

declare_rule! {
    /// The length of a tool is cancelled (`G49`, or `H0` where the control takes it for the same), and the move in Z of this
    /// block, or the next rapid move in Z, does not rise by the length of the tool.
    ///
    /// A length that is known decides: no finding if it is zero or below zero, and none if the move rises by more. A length
    /// along a tilting tool (`G143`) is the difference to the tool that the program was made for, which may be shorter: if it is
    /// not known, the finding is a *maybe*.
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
    /// ```nc,reported,fanuc-mill
    /// G21 G90 G54 G0 X0. Y0.
    /// G43 H1 Z5.
    /// G0 H0 Z20.
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
            watch: Watch::BLOCKS.union(Watch::FEED_MOVES).union(Watch::RAPID_MOVES),
            make: || Box::new(LengthCancelledBeforeMove { cancelled: None }),
        },
    }
}

/// Millimetres: no tool in its holder is shorter.
const SHORTEST_TOOL: f64 = 50.0;

#[derive(Clone, PartialEq)]
struct LengthCancelledBeforeMove {
    cancelled: Option<Cancelled>,
}

#[derive(Clone, PartialEq)]
struct Cancelled {
    /// The block that cancelled the length.
    at: At,
    /// What it says for that.
    by: String,
    /// The height of the tip there, in millimetres.
    height: f64,
    /// By how much the spindle nose is above that for the length, in millimetres, where it is known.
    length: Option<f64>,
    /// The length is along a tool that tilts: a difference to another tool.
    is_difference: bool,
}

remembers!(Cancelled: at);
remembers!(LengthCancelledBeforeMove: cancelled);

impl PathRule for LengthCancelledBeforeMove {
    fn memory(&mut self) -> Remembers<'_> {
        Remembers::All(self)
    }

    fn concerns(&self, program: &Uses<'_>) -> bool {
        program.may(gives_length)
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
        let effect = cx.state().effect(Role::Length, cx.model).filter(|effect| gives_length(*effect));
        if cx.has_effect(elsewhere) {
            self.cancelled = None;
        } else if let (Some(effect), Some(by)) = (effect, ending(cx)) {
            let state = cx.state();
            let is_difference = effect == Effect::LengthFiveAxis;
            self.cancelled = state.position().get(Axis::Z).map(|height| Cancelled {
                at: cx.origin().at,
                by,
                height,
                length: if is_difference {
                    state.actual().get(Axis::Z).map(|nose| nose - height)
                } else {
                    state.length().get(Axis::Z)
                },
                is_difference,
            });
        }
    }

    fn moved(&mut self, cx: &PathCx<'_>, event: &Event, report: &mut Report<'_>) {
        let Event::Travel(travel) = event else { return };
        if self.cancelled.is_none() {
            cx.rest();
            return;
        }
        if travel.expanded || !cx.origin().letters.contains(Letter::of('Z')) {
            return;
        }
        let Some(before) = self.cancelled.take() else { return };
        // Another code gives a length again (`G234`, `G143`).
        if cancelled(cx).is_none() {
            return;
        }
        // A later cut is another rule's; in the block that cancels the length a feed goes the same way.
        if travel.kind != TravelKind::Rapid && before.at != cx.origin().at
            || cx.state().is_incremental(cx.model) != Some(false)
        {
            return;
        }
        let Some(to) = travel.programmed.get(Axis::Z) else { return };
        let rises_by = to - before.height;
        let goes_deeper = match before.length {
            Some(length) => length > 0.0 && rises_by < length,
            // Where lengths are measured from the machine's zero, `Z0.` without one is the way home.
            None => rises_by < SHORTEST_TOOL && to != 0.0,
        };
        if goes_deeper {
            report.add(finding(cx, &before, rises_by));
        }
    }
}

fn finding(cx: &PathCx<'_>, before: &Cancelled, rises_by: f64) -> crate::Finding {
    let by = &before.by;
    let is_open = before.is_difference && before.length.is_none();
    let comes = if is_open { "may come" } else { "comes" };
    let mut finding = cx.finding(
        &META,
        cx.letter_range('Z'),
        format!("the tool {comes} down: its length was cancelled before this move (`{by}`)"),
    );
    finding = match before.length {
        Some(length) => finding.label(format!(
            "moves the spindle nose to this Z: the tool goes {} deeper",
            cx.shown(Mm(length - rises_by))
        )),
        None if !is_open => finding
            .label("moves the spindle nose to this Z: the tool goes deeper by its length")
            .assuming("length offsets are the lengths of tools, not distances from the machine's zero"),
        None => finding
            .label("moves to this Z without the length: a longer tool goes deeper by the difference")
            .note("the length is the difference between this tool and the one that the program was made for, and may be below zero")
            .at_most(Severity::Info),
    };
    if is_open {
        finding.certainty = Certainty::Maybe;
    }
    let off = cx.name_of_effect(Effect::LengthOff).unwrap_or_default();
    let up = match cx.name_of_effect(Effect::MachineCoordinates) {
        Some(machine) => format!("go up in machine coordinates (`{machine} {off} Z0.`)"),
        None => "go up first".to_owned(),
    };
    finding = finding.help(format!("{up}, or keep the length for this move"));
    match cx.range_of(before.at).filter(|_| before.at != cx.origin().at) {
        Some(range) => finding.also(range, "cancelled here"),
        None => finding,
    }
}

/// Does the code add the length of the tool to Z?
fn gives_length(effect: Effect) -> bool {
    matches!(effect, Effect::LengthPlus | Effect::LengthFiveAxis)
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use gcheck_engine::Tool;
    use gcheck_geometry::Mm;

    use super::RULE;
    use crate::testing::{World, check_rule, check_rule_in, findings, only, words};

    /// A machine whose tool 1 has a length.
    fn with_length(inch: f64) -> World<'static> {
        let mut world = World::default();
        let mut tool = Tool {
            pocket: 1,
            offset: gcheck_engine::Position::ZERO,
            diameter: Mm(10.0),
            corner_radius: Mm(0.0),
            angles: [0.0; 2],
            orientation: 0,
        };
        tool.offset.set(gcheck_engine::Axis::Z, inch * 25.4);
        world.machine.engine.tools.insert(1, tool);
        world
    }

    #[test]
    fn a_length_that_is_known_decides() {
        let program = |on: &str, off: &str| {
            format!("G20 G90 G94 G54 G0 X0. Y0. A0. B0.\n{on}\nG1 Z.5 F10.\n{off}\nM30\n")
        };
        let on = ["G43 H1 Z1.", "G143 H1 X0. Y0. Z1. A0. B0."];
        for on in on {
            for (off, length) in [
                ("G0 G49 Z1.", 0.0),
                ("G0 G49 Z1.", -0.1),
                ("G0 G49 Z6.", 4.0),
                ("G0 H0 Z1.", 0.0),
                ("G0 H00 Z6.", 4.0),
            ] {
                check_rule_in(&RULE, "haas-mill", &program(on, off), &with_length(length), &expect![[""]]);
            }
            for off in ["G0 G49 Z1.", "G0 H00 Z1."] {
                let found = findings(&only(&RULE), "haas-mill", &program(on, off), &with_length(4.0));
                let text = found.iter().map(words).collect::<String>();
                assert!(text.contains("the tool goes 3.5 in deeper"), "{on} {off}: {text}");
                assert!(found.iter().all(|one| one.certainty == crate::Certainty::Always), "{text}");
            }
        }
    }

    #[test]
    fn an_unknown_length_along_a_tilting_tool_may_be_below_zero() {
        for off in ["G0 G49 Z1.", "G49\nG0 Z1.", "G0 H00 Z1."] {
            let program = format!(
                "G20 G90 G94 G54 G0 X0. Y0. Z1. A0. B0.\nG143 H01 X0. Y0. Z1. A-20. B-20.\nG1 G93 X.01 Y.01 Z.9 A-19.9 B-19.9 F300.\nG94 F20.\n{off}\nM30\n"
            );
            let found = findings(&only(&RULE), "haas-mill", &program, &World::default());
            assert_eq!(found.len(), 1, "{off}");
            assert!(found.iter().all(|one| one.certainty == crate::Certainty::Maybe), "{off}");
        }
    }

    #[test]
    fn offset_number_zero_is_the_same_danger() {
        let program =
            |block: &str| format!("G21 G90 G54 G0 X0. Y0.\nG43 H1 Z5.\nG1 X10. F100.\n{block}\nM30\n");
        for control in ["haas-mill", "fanuc-mill", "generic-mill", "tsnc-yh-a1m"] {
            check_rule(
                &RULE,
                control,
                &program("G0 H00 Z20."),
                &expect![[r#"
                4 | G0 H00 Z20.
                  |        ^^^^ warning[length-cancelled-before-move] the tool comes down: its length was cancelled before this move (`H00`)
            "#]],
            );
            check_rule(
                &RULE,
                control,
                &program("G0 H[1-1] Z20."),
                &expect![[r#"
                4 | G0 H[1-1] Z20.
                  |           ^^^^ warning[length-cancelled-before-move] the tool comes down: its length was cancelled before this move (`H[1-1]`)
            "#]],
            );
            for quiet in ["G0 Z20.", "H00\nG43 H1 Z20.", "H00\nG28 G91 Z0.", "G0 H02 Z20.", "G0 H00 Z100."] {
                check_rule(&RULE, control, &program(quiet), &expect![[""]]);
            }
        }
        // There zero means the tool in the spindle.
        check_rule(&RULE, "linuxcnc", "G21 G90 G54 G0 X0 Y0\nG43 H1 Z5\nG43 H0 Z20\nM2\n", &expect![[""]]);
    }

    #[test]
    fn the_length_of_a_tilting_tool() {
        check_rule(
            &RULE,
            "haas-mill",
            "G20 G90 G94 G54 G0 X1.25 Y-.4\nG143 H1 X1.25 Y-.4 Z3. A0. B0.\nG0 X1.15 Y-.31 Z3. A-12.7 B9.7\nG49 M9\nG0 X1.15 Y-.31 Z3. A0. B0.\nG53 Z0.\nM30\n",
            &expect![[r#"
                5 | G0 X1.15 Y-.31 Z3. A0. B0.
                  |                ^^^ info[length-cancelled-before-move] the tool may come down: its length was cancelled before this move (`G49`)
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
