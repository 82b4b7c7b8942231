//! A pocket that is compensated to the outside of its outline.

use gcheck_controls::Effect;
use gcheck_engine::{Abstract, Domain, Event, Role};

use crate::declare::declare_rule;
use crate::facts::cycles::cycle_code;
use crate::facts::offset_schemes::whole;
use crate::{PathCx, PathRule, Report, Run, Watch};

declare_rule! {
    /// Cutter compensation puts the tool on the outside of a pocket's outline.
    ///
    /// ## Why it matters
    /// The tool cuts its whole diameter beyond the wall. An outline that turns counter-clockwise has its inside on the
    /// left (`G41`), a clockwise one on the right (`G42`).
    ///
    /// ## Reported
    /// ```nc,reported,haas-mill
    /// G20 G90 G54 G0 X0. Y0.
    /// G43 H1 Z.1
    /// G150 P100 G41 D1 X0. Y0. Z-.5 Q.25 R.1 I.2 F20.
    /// G40 X0. Y0.
    /// M30
    /// O100
    /// G1 Y1.
    /// X1.
    /// Y-1.
    /// X-1.
    /// Y1.
    /// X0.
    /// M99
    /// ```
    /// ## Not reported
    /// ```nc,quiet,haas-mill
    /// G20 G90 G54 G0 X0. Y0.
    /// G43 H1 Z.1
    /// G150 P100 G42 D1 X0. Y0. Z-.5 Q.25 R.1 I.2 F20.
    /// G40 X0. Y0.
    /// M30
    /// O100
    /// G1 Y1.
    /// X1.
    /// Y-1.
    /// X-1.
    /// Y1.
    /// X0.
    /// M99
    /// ```
    rule "pocket-on-wrong-side" in "cycles" {
        summary: "pocket compensated to the outside of its outline",
        severity: Warning,
        tier: Path,
        since: "0.1.0",
        run: Run::Path { watch: Watch::CHANGES, make: || Box::new(PocketOnWrongSide) },
    }
}

struct PocketOnWrongSide;

impl PathRule for PocketOnWrongSide {
    fn changed(&mut self, cx: &PathCx<'_>, event: &Event, report: &mut Report<'_>) {
        let Event::Cleared(clearing) = event else { return };
        let counter_clockwise = clearing.counter_clockwise;
        let Some(compensation) = cx.control().code_at(clearing.compensation) else { return };
        let (side, inside) = match compensation.effect() {
            Effect::CompensationLeft => ("left", counter_clockwise),
            Effect::CompensationRight => ("right", !counter_clockwise),
            _ => return,
        };
        // A negative size puts the tool on the other side.
        let number = Abstract::known(cx.state().d());
        let tool = number.and_then(whole);
        let is_negative = tool
            .and_then(|number| cx.state().tables().tool(number))
            .is_some_and(|tool| tool.diameter.0 < 0.0);
        if inside != is_negative {
            return;
        }
        let Some(pocket) = cycle_code(cx) else { return };
        let (name, source) = (pocket.number(), pocket.entry().source.as_str());
        let (turns, opposite) = if counter_clockwise {
            ("counter-clockwise", Effect::CompensationLeft)
        } else {
            ("clockwise", Effect::CompensationRight)
        };
        let now = compensation.number();
        let other = cx.name_of_effect(opposite).unwrap_or_default();
        let range = cx.effect_range(|effect| Role::of(effect) == Some(Role::Compensation));
        let finding = cx
            .finding(&META, range, format!("the tool goes outside the pocket (`{now}` with `{name}`)"))
            .label(format!("on the {side} of an outline that turns {turns}"))
            .also(cx.letter_range('P'), "the outline of this pocket")
            .note(format!("the tool of `{name}` keeps to the inside of the outline  [{source}]"));
        let finding = if is_negative {
            finding.help("compare the sign of the tool's diameter with the side")
        } else {
            finding.help(format!("write `{other}`, or turn the outline round"))
        };
        report.add(finding);
    }
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::check_rule;

    const CLOCKWISE: &str = "M30\nO100\nG1 Y1.\nX1.\nY-1.\nX-1.\nY1.\nX0.\nM99\n";
    const COUNTER_CLOCKWISE: &str = "M30\nO100\nG1 Y1.\nX-1.\nY-1.\nX1.\nY1.\nX0.\nM99\n";

    fn pocket(side: &str, outline: &str) -> String {
        format!(
            "G20 G90 G54 G0 X0. Y0.\nZ.1\nG150 P100 {side} D1 X0. Y0. Z-.5 Q.25 R.1 I.2 F20.\nG40 X0.\n{outline}"
        )
    }

    #[test]
    fn the_inside_is_left_of_a_counter_clockwise_outline() {
        check_rule(&RULE, "haas-mill", &pocket("G41", COUNTER_CLOCKWISE), &expect![[""]]);
        check_rule(&RULE, "haas-mill", &pocket("G42", CLOCKWISE), &expect![[""]]);
        check_rule(
            &RULE,
            "haas-mill",
            &pocket("G42", COUNTER_CLOCKWISE),
            &expect![[r#"
                3 | G150 P100 G42 D1 X0. Y0. Z-.5 Q.25 R.1 I.2 F20.
                  |           ^^^ warning[pocket-on-wrong-side] the tool goes outside the pocket (`G42` with `G150`)
            "#]],
        );
        check_rule(
            &RULE,
            "haas-mill",
            &pocket("G41", CLOCKWISE),
            &expect![[r#"
                3 | G150 P100 G41 D1 X0. Y0. Z-.5 Q.25 R.1 I.2 F20.
                  |           ^^^ warning[pocket-on-wrong-side] the tool goes outside the pocket (`G41` with `G150`)
            "#]],
        );
    }

    #[test]
    fn without_a_side_there_is_no_wrong_one() {
        check_rule(&RULE, "haas-mill", &pocket("", CLOCKWISE), &expect![[""]]);
    }
}
