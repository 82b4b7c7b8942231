//! Polar interpolation that is not switched off.

use std::ops::Range;

use gcheck_controls::Effect;
use gcheck_engine::{At, Ending, Fact, Role};

use crate::declare::declare_rule;
use crate::facts::boundary::{Boundary, boundary, boundary_range, ends_at_tape_mark};
use crate::facts::modes::{ActiveMode, forbids, left_on};
use crate::{PathCx, PathRule, Report, Run, Severity, Uses, Watch};
use crate::{Remembers, remembers};

declare_rule! {
    /// X and the rotary axis are still interpolated as the flat coordinates of the face (`G12.1`, `G112`) when the tool is changed,
    /// an axis returns to its reference position, or the program ends.
    ///
    /// ## Why it matters
    /// X is a coordinate of the face, and the control turns the part with each of its moves: the way to the tool change is
    /// none that the program shows, and many controls stop with an alarm. What comes next is cut with it.
    ///
    /// ## Reported
    /// ```nc,reported,fanuc-lathe
    /// G21 G98 T0707
    /// G0 X70. Z5. C0.
    /// Z-8.
    /// G12.1
    /// G1 X30. C0. F200
    /// C15.
    /// X70.
    /// G0 Z50.
    /// T0101
    /// M30
    /// ```
    /// ## Not reported
    /// ```nc,quiet,fanuc-lathe
    /// G21 G98 T0707
    /// G0 X70. Z5. C0.
    /// Z-8.
    /// G12.1
    /// G1 X30. C0. F200
    /// C15.
    /// X70.
    /// G13.1
    /// G0 Z50.
    /// T0101
    /// M30
    /// ```
    rule "polar-interpolation-left-on" in "mapping" {
        summary: "polar interpolation left on",
        severity: Warning,
        tier: Path,
        since: "0.1.0",
        run: Run::Path {
            watch: Watch::BLOCKS.union(Watch::ENDS),
            make: || Box::new(PolarInterpolationLeftOn { told: None }),
        },
    }
}

#[derive(Clone, PartialEq)]
struct PolarInterpolationLeftOn {
    /// The block that began what was reported last.
    told: Option<At>,
}

remembers!(PolarInterpolationLeftOn: told);

impl PathRule for PolarInterpolationLeftOn {
    fn memory(&mut self) -> Remembers<'_> {
        Remembers::All(self)
    }

    fn concerns(&self, program: &Uses<'_>) -> bool {
        program.may(is_on)
    }

    fn block(&mut self, cx: &PathCx<'_>, report: &mut Report<'_>) {
        if let Some(boundary) = boundary(cx) {
            self.judge(cx, boundary.words(), boundary_range(cx, boundary), Some(boundary), report);
        } else if cx.has_effect(returns) && !is_refused(cx) {
            self.judge(cx, "at the return to the reference position", cx.effect_range(returns), None, report);
        }
    }

    fn ended(&mut self, cx: &PathCx<'_>, ending: Ending, report: &mut Report<'_>) {
        if ends_at_tape_mark(cx, ending) {
            let end = Boundary::ProgramEnd;
            self.judge(cx, end.words(), boundary_range(cx, end), Some(end), report);
        }
    }
}

impl PolarInterpolationLeftOn {
    fn judge(
        &mut self,
        cx: &PathCx<'_>,
        place: &str,
        range: Range<u32>,
        boundary: Option<Boundary>,
        report: &mut Report<'_>,
    ) {
        let Some(ActiveMode::Certain(code)) = left_on(cx, Role::PolarInterpolation, is_on) else { return };
        let set_by = cx.definitions().set_by(Fact::Mode(Role::PolarInterpolation));
        if set_by.is_none() || set_by == self.told {
            return;
        }
        self.told = set_by;
        let (name, off) =
            (cx.name_of(code), cx.name_of_effect(Effect::PolarInterpolationOff).unwrap_or_default());
        let finding = cx
            .finding(&META, range, format!("polar interpolation is still on {place} (`{name}`)"))
            .label("X still counts on the face, and turns the part")
            .help(format!("switch it off with `{off}` after the contour, before the retract"));
        // An end that resets it does no harm to what comes next; the retract was made with it.
        let resets = boundary == Some(Boundary::ProgramEnd) && cx.end_resets(Role::PolarInterpolation);
        let finding = if resets {
            finding.note("the end of the program switches it off on this control").at_most(Severity::Info)
        } else {
            finding
        };
        report.add(cx.resting_on(finding, Fact::Mode(Role::PolarInterpolation), &format!("`{name}`")));
    }
}

/// Does the mode refuse the return? `refused-by-mode` says so.
fn is_refused(cx: &PathCx<'_>) -> bool {
    let mode = cx.state().mode(Role::PolarInterpolation).only().and_then(|mode| cx.code_of(mode));
    mode.is_some_and(|mode| cx.has_code(|code| returns(code.effect()) && forbids(mode, code)))
}

fn is_on(effect: Effect) -> bool {
    effect == Effect::PolarInterpolationOn
}

fn returns(effect: Effect) -> bool {
    matches!(effect, Effect::ReturnReference(_))
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::check_rule;

    #[test]
    fn at_the_end_and_at_the_return() {
        let fanuc = |after: &str| {
            format!("G21 G98 T0707\nG0 X70. Z5. C0.\nG12.1\nG1 X30. C0. F200\nX70.\n{after}M30\n")
        };
        check_rule(
            &RULE,
            "fanuc-lathe",
            &fanuc("G0 Z50.\nX150. Z100.\n"),
            &expect![[r#"
            8 | M30
              | ^^^ warning[polar-interpolation-left-on] polar interpolation is still on at the end of the program (`G12.1`)
        "#]],
        );
        check_rule(&RULE, "fanuc-lathe", &fanuc("G28 U0.\nG13.1\n"), &expect![""]);
        check_rule(&RULE, "fanuc-lathe", &fanuc("G13.1\nG28 U0.\n"), &expect![[""]]);
        let haas = |after: &str| {
            format!("G20 G98 T303\nM154\nM133 P1500\nG0 X2. Z.1 C0.\nG17 G112\nG1 X.5 Y.5 F6.\n{after}M30\n")
        };
        check_rule(
            &RULE,
            "haas-lathe",
            &haas("G0 Z1.\n"),
            &expect![[r#"
            8 | M30
              | ^^^ info[polar-interpolation-left-on] polar interpolation is still on at the end of the program (`G112`)
        "#]],
        );
        check_rule(
            &RULE,
            "haas-lathe",
            &haas("G0 Z1.\nT101\n"),
            &expect![[r#"
            8 | T101
              | ^^^^ warning[polar-interpolation-left-on] polar interpolation is still on at the tool change (`G112`)
        "#]],
        );
        check_rule(&RULE, "haas-lathe", &haas("G113\nG0 Z1.\nT101\n"), &expect![[""]]);
    }
}
