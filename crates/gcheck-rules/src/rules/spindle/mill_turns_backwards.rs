//! A milling cutter that turns counter-clockwise.

use gcheck_controls::Effect;
use gcheck_engine::{At, Event, Fact, Spindle, TravelKind};

use crate::declare::declare_rule;
use crate::facts::cutting::turns_backwards;
use crate::facts::edge;
use crate::facts::tool_comment::{ToolComment, comment_of_tool};
use crate::{PathCx, PathRule, Report, Run, Uses, Watch};
use crate::{Remembers, remembers};

declare_rule! {
    /// A cut sideways while the spindle turns counter-clockwise (`M4`), with a tool that its comment calls a mill. A comment that
    /// names a left-hand tool is accepted (`LH`, `LEFT`).
    ///
    /// ## Why it matters
    /// The edges of a mill point one way. Turning backwards, it is pushed into the metal with their backs and breaks.
    ///
    /// ## Reported
    /// ```nc,reported,haas-mill
    /// T4 M6 (12 MM END MILL)
    /// G21 G90 G54 G0 X0. Y0.
    /// S2000 M4
    /// G43 H4 Z10.
    /// G1 Z-1. F150.
    /// X50.
    /// M30
    /// ```
    /// ## Not reported
    /// ```nc,quiet,haas-mill
    /// T4 M6 (12 MM END MILL LH)
    /// G21 G90 G54 G0 X0. Y0.
    /// S2000 M4
    /// G43 H4 Z10.
    /// G1 Z-1. F150.
    /// X50.
    /// M30
    /// ```
    rule "mill-turns-backwards" in "spindle" {
        summary: "milling cutter that turns counter-clockwise",
        severity: Warning,
        tier: Path,
        since: "0.1.0",
        run: Run::Path { watch: Watch::MOVES, make: || Box::new(MillTurnsBackwards { told: None }) },
    }
}

#[derive(Clone, PartialEq)]
struct MillTurnsBackwards {
    /// The tool change whose tool was reported.
    told: Option<At>,
}

remembers!(MillTurnsBackwards: told);

impl PathRule for MillTurnsBackwards {
    fn memory(&mut self) -> Remembers<'_> {
        Remembers::All(self)
    }

    fn concerns(&self, program: &Uses<'_>) -> bool {
        program.may(turns_backwards)
            && program.environment.control().machine() == gcheck_controls::Machine::Mill
    }

    fn moved(&mut self, cx: &PathCx<'_>, event: &Event, report: &mut Report<'_>) {
        if cx.state().spindle() != Some(Spindle::CounterClockwise) || !mills(event) {
            return;
        }
        let Some(changed) = cx.definitions().set_by(Fact::Tool).filter(|at| self.told != Some(*at)) else {
            return;
        };
        let Some(comment) = comment_of_tool(cx, changed).filter(is_mill) else { return };
        self.told = Some(changed);
        let started = cx.definitions().set_by(Fact::Spindle);
        let start =
            started.and_then(|at| cx.find_word(at, |word| turns_backwards(cx.model.effect(word.code))));
        let name = cx.name_of_effect(Effect::SpindleCounterClockwise).unwrap_or_default();
        let right = cx.name_of_effect(Effect::SpindleClockwise).unwrap_or_default();
        let message = format!("the milling cutter turns backwards (`{name}`)");
        let mut finding = match start {
            Some(range) => {
                cx.finding(&META, range, message).label("counter-clockwise").also(cx.range(), "cuts here")
            }
            None => cx.finding(&META, cx.range(), message).label("cuts here"),
        };
        if let Some(range) = cx.range_of(comment.at) {
            finding = finding.also(range, "names a mill");
        }
        report.add(
            finding.help(format!("start the spindle with `{right}`, or name the tool left-hand (`LH`)")),
        );
    }
}

/// Does the tool cut sideways?
fn mills(event: &Event) -> bool {
    match event {
        Event::Travel(travel) => {
            travel.kind == TravelKind::Feed && !travel.expanded && edge::goes_across(&travel.from, &travel.to)
        }
        Event::Arc(arc) => !arc.expanded,
        _ => false,
    }
}

fn is_mill(comment: &ToolComment) -> bool {
    comment.has(&["MILL", "ENDMILL", "FACEMILL", "CHAMFER", "BALLNOSE", "BULLNOSE"])
        && !comment.has(&["THREAD", "THREADMILL", "DRAG"])
        && !comment.is_left_hand()
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::check_rule;

    #[test]
    fn each_tool_is_told_once() {
        let program = |comment: &str| {
            format!(
                "T4 M6 ({comment})\nG21 G90 G54 G0 X0. Y0.\nS900 M4\nG43 H4 Z5.\nG1 Z-1. F90.\nX9.\nY9.\nG0 Z5.\nM30\n"
            )
        };
        check_rule(
            &RULE,
            "fanuc-mill",
            &program("10 END MILL"),
            &expect![[r#"
            3 | S900 M4
              |      ^^ warning[mill-turns-backwards] the milling cutter turns backwards (`M4`)
        "#]],
        );
        for comment in ["THREAD MILL", "END MILL LEFT HAND", "TAP", ""] {
            check_rule(&RULE, "fanuc-mill", &program(comment), &expect![[""]]);
        }
    }
}
