//! A tool that cuts after its length was cancelled.

use gcheck_controls::{Effect, Letter};
use gcheck_engine::{At, Axis, Event, Fact, Role, TravelKind};

use crate::declare::declare_rule;
use crate::facts::cancelled_length::{cancelled, number_as_written};
use crate::facts::cutting::is_cut;
use crate::{PathCx, PathRule, Report, Run, Uses, Watch};
use crate::{Remembers, remembers};

declare_rule! {
    /// A tool has moved in Z or worked with its length in effect, the length is cancelled (`G49`, or `H0` where the control takes
    /// it for the same), and then the tool cuts along Z.
    ///
    /// ## Why it matters
    /// From there Z is the position of the spindle nose: the tool goes deeper by its own length.
    ///
    /// ## Reported
    /// ```nc,reported,haas-mill
    /// T1 M6
    /// S1000 M3
    /// G90 G54 G0 X0. Y0.
    /// G43 H1 Z1.
    /// G1 Z-0.1 F10.
    /// G0 Z1.
    /// G49
    /// X2.
    /// G1 Z-0.1
    /// M30
    /// ```
    /// ## Not reported
    /// ```nc,quiet,haas-mill
    /// T1 M6
    /// S1000 M3
    /// G90 G54 G0 X0. Y0.
    /// G43 H1 Z1.
    /// G1 Z-0.1 F10.
    /// G0 Z1.
    /// G49
    /// G53 G0 Z0.
    /// G43 H1 Z1.
    /// G1 Z-0.1
    /// M30
    /// ```
    /// A rapid move to a height of the part takes the spindle nose there as well.
    /// ```nc,reported,linuxcnc
    /// G21 G90 G54
    /// T1 M6
    /// S1000 M3
    /// G0 X0 Y0
    /// G43 H1 Z5
    /// G1 Z-5 F100
    /// G49
    /// G0 Z5
    /// M2
    /// ```
    rule "length-cancelled-before-cut" in "tool" {
        summary: "tool cuts after its length was cancelled",
        severity: Warning,
        tier: Path,
        since: "0.1.0",
        run: Run::Path {
            watch: Watch::CUTS.union(Watch::RAPIDS),
            make: || Box::new(LengthCancelledBeforeCut::default()),
        },
    }
}

#[derive(Default, Clone, PartialEq)]
struct LengthCancelledBeforeCut {
    /// The tool change whose tool has cut with its length in effect.
    worked: Option<At>,
    /// The tool change whose tool has come to a height of the part with its length in effect.
    came: Option<At>,
    /// The cancelling block that was reported.
    told: Option<At>,
    /// The length that was in effect last, in millimetres, where it is known.
    length: Option<f64>,
}

remembers!(LengthCancelledBeforeCut: worked, came, told);

impl PathRule for LengthCancelledBeforeCut {
    fn memory(&mut self) -> Remembers<'_> {
        Remembers::All(self)
    }

    fn concerns(&self, program: &Uses<'_>) -> bool {
        program.may(Effect::is_length_compensation)
    }

    fn rapid(&mut self, cx: &PathCx<'_>, event: &Event, report: &mut Report<'_>) {
        if !cx.origin().letters.contains(Letter::of('Z')) {
            return;
        }
        let changed = cx.definitions().set_by(Fact::Tool);
        let off = cancelled(cx);
        if off.is_none() && has_length(cx) && changed.is_some() {
            self.came = changed;
            self.length = cx.state().length().get(Axis::Z);
        }
        let Some(fact) = off else { return };
        if cx.model.semantics().tools.offset_in_t || changed.is_none() || self.worked != changed {
            return;
        }
        let (Event::Travel(travel), Some(cancelled)) = (event, cx.definitions().set_by(fact)) else { return };
        let goes_elsewhere = cx.has_effect(Effect::moves_by_machine_places);
        let is_absolute = cx.state().is_incremental(cx.model) == Some(false);
        let is_near = travel.to.raw(Axis::Z) < NEAR_THE_PART;
        if goes_elsewhere || !is_absolute || !is_near || self.told == Some(cancelled) || self.was_no_longer()
        {
            return;
        }
        self.told = Some(cancelled);
        let off = written(cx, fact, cancelled);
        let machine = cx.name_of_effect(Effect::MachineCoordinates).unwrap_or_default();
        let finding = cx
            .finding(
                &META,
                cx.letter_range('Z'),
                format!("the tool goes to a height of the part after its length was cancelled (`{off}`)"),
            )
            .label("moves the spindle nose to this Z: the tool is deeper by its length")
            .help(format!("go up before `{off}`, or in machine coordinates (`{machine}`)"));
        report.add(cx.resting_on(finding, fact, &format!("`{off}`")));
    }

    fn cut(&mut self, cx: &PathCx<'_>, event: &Event, report: &mut Report<'_>) {
        let rules = cx.model.semantics().tools;
        if rules.offset_in_t {
            return;
        }
        let Some(changed) = cx.definitions().set_by(Fact::Tool) else { return };
        match cancelled(cx) {
            None if has_length(cx) && is_cut(cx, event) => {
                self.worked = Some(changed);
                self.length = cx.state().length().get(Axis::Z);
            }
            Some(fact)
                if (self.worked == Some(changed) || self.came == Some(changed))
                    && goes_into_the_part(cx, event)
                    && !self.was_no_longer() =>
            {
                let Some(cancelled) = cx.definitions().set_by(fact).filter(|at| self.told != Some(*at))
                else {
                    return;
                };
                if !cx.origin().letters.contains(Letter::of('Z')) {
                    return;
                }
                self.told = Some(cancelled);
                let off = written(cx, fact, cancelled);
                let on = cx.name_of_effect(Effect::LengthPlus).unwrap_or_default();
                let finding = cx
                    .finding(
                        &META,
                        cx.letter_range('Z'),
                        format!("the tool cuts after its length was cancelled (`{off}`)"),
                    )
                    .label("moves the spindle nose to this Z: the tool goes deeper by its length")
                    .help(format!(
                        "give the length again before this (`{on} H…`), or cancel it only when the tool moves away"
                    ));
                report.add(cx.resting_on(finding, fact, &format!("`{off}`")));
            }
            _ => {}
        }
    }
}

impl LengthCancelledBeforeCut {
    /// Is the length that was cancelled known, and zero or below? Without it the tool goes no deeper.
    fn was_no_longer(&self) -> bool {
        self.length.is_some_and(|length| length <= 0.0)
    }
}

/// Is a length along Z in effect?
fn has_length(cx: &PathCx<'_>) -> bool {
    let effect = cx.state().effect(Role::Length, cx.model);
    matches!(effect, Some(Effect::LengthPlus | Effect::LengthMinus))
}

/// What the block at `at` says to end the length: the code, or the offset number zero.
fn written(cx: &PathCx<'_>, fact: Fact, at: At) -> String {
    match fact {
        Fact::Length => number_as_written(cx, at),
        _ => cx.code_name(Role::Length).unwrap_or_default(),
    }
}

/// Above the zero of the part, in millimetres: less than a tool is long with its holder.
const NEAR_THE_PART: f64 = 50.0;

/// A feed move to below the zero of the part: after a cancelled length the tool's start is unknown.
fn goes_into_the_part(cx: &PathCx<'_>, event: &Event) -> bool {
    match event {
        // The first peck of a cycle may end above the part.
        Event::Travel(travel) if travel.expanded => cx.state().cycle().z < 0.0,
        Event::Travel(travel) => travel.kind == TravelKind::Feed && travel.to.raw(Axis::Z) < 0.0,
        _ => false,
    }
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::check_rule;

    #[test]
    fn another_tool_is_another_matter() {
        check_rule(
            &RULE,
            "haas-mill",
            "T1 M6\nS1000 M3\nG90 G54 G43 H1 Z1.\nG1 Z-0.1 F10.\nG49\nT2 M6\nM3\nG1 Z-0.1\nM30\n",
            &expect![[""]],
        );
    }

    #[test]
    fn the_first_cut_of_the_tool_counts_too() {
        let program = |cut: &str| {
            format!(
                "G21 G17 G90\nT1 M6\nG54 G0 X0. Y0. S2500 M3\nG43 H1 Z50.\nG49\n{cut}\nG80 G91 G28 Z0.\nM30\n"
            )
        };
        check_rule(
            &RULE,
            "fanuc-mill",
            &program("G83 G98 X20. Y20. Z-18. R3. Q4. F180."),
            &expect![[r#"
            6 | G83 G98 X20. Y20. Z-18. R3. Q4. F180.
              |                   ^^^^^ warning[length-cancelled-before-cut] the tool cuts after its length was cancelled (`G49`)
        "#]],
        );
        check_rule(
            &RULE,
            "fanuc-mill",
            &program("G1 Z-5. F100.\nX50."),
            &expect![[r#"
            6 | G1 Z-5. F100.
              |    ^^^^ warning[length-cancelled-before-cut] the tool cuts after its length was cancelled (`G49`)
        "#]],
        );
        check_rule(&RULE, "fanuc-mill", &program("G43 H1 Z5.\nG1 Z-5. F100.\nX50."), &expect![[""]]);
        check_rule(&RULE, "fanuc-mill", &program("G1 X50. F100."), &expect![[""]]);
        check_rule(
            &RULE,
            "fanuc-mill",
            &program("G83 G98 X20. Y20. Z-18. R4. Q4. F180."),
            &expect![[r#"
            6 | G83 G98 X20. Y20. Z-18. R4. Q4. F180.
              |                   ^^^^^ warning[length-cancelled-before-cut] the tool cuts after its length was cancelled (`G49`)
        "#]],
        );
    }

    #[test]
    fn offset_number_zero_cancels_too() {
        let program = |block: &str| {
            format!(
                "T1 M6\nG21 S1000 M3\nG90 G54 G0 X0. Y0.\nG43 H1 Z10.\nG1 Z-1. F100.\n{block}\nG1 Z-2.\nM30\n"
            )
        };
        for control in ["haas-mill", "fanuc-mill", "generic-mill", "tsnc-yh-a1m"] {
            check_rule(
                &RULE,
                control,
                &program("G0 H00 Z60."),
                &expect![[r#"
                7 | G1 Z-2.
                  |    ^^^^ warning[length-cancelled-before-cut] the tool cuts after its length was cancelled (`H00`)
            "#]],
            );
            check_rule(&RULE, control, &program("G0 Z60."), &expect![[""]]);
        }
    }

    #[test]
    fn the_cut_is_marked_once() {
        check_rule(
            &RULE,
            "fanuc-mill",
            "T1 M6\nG21 S1000 M3\nG90 G54 G43 H1 Z10.\nG1 Z-1. F100.\nG0 G49 Z50.\nG1 Z-2.\nM8\nG1 Z-3.\nM30\n",
            &expect![[r#"
                6 | G1 Z-2.
                  |    ^^^^ warning[length-cancelled-before-cut] the tool cuts after its length was cancelled (`G49`)
            "#]],
        );
    }
}
