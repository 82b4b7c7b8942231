//! A milling cutter that turns counter-clockwise.

use gcheck_engine::Event;

use crate::declare::declare_rule;
use crate::facts::edge;
use crate::facts::tool_comment::ToolComment;
use crate::facts::turned_backwards::{Called, TurnedBackwards, may_turn_backwards};
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
        run: Run::Path { watch: Watch::MOVES, make: || Box::new(MillTurnsBackwards::default()) },
    }
}

#[derive(Default, Clone, PartialEq)]
struct MillTurnsBackwards {
    turned: TurnedBackwards,
}

remembers!(MillTurnsBackwards: turned);

/// How its tool is called.
const CALLED: Called = Called { tool: "milling cutter", in_short: "tool", cuts: "cuts", named: "a mill" };

impl PathRule for MillTurnsBackwards {
    fn memory(&mut self) -> Remembers<'_> {
        Remembers::All(self)
    }

    fn concerns(&self, program: &Uses<'_>) -> bool {
        may_turn_backwards(program)
    }

    fn moved(&mut self, cx: &PathCx<'_>, event: &Event, report: &mut Report<'_>) {
        if edge::cuts_across(event)
            && let Some(finding) = self.turned.judge(cx, &META, &CALLED, is_mill)
        {
            report.add(finding);
        }
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
    fn the_list_of_a_post_names_the_tool() {
        check_rule(
            &RULE,
            "haas-mill",
            "(T2 D=12. CR=0. - ZMIN=-12. - flat end mill)\nG21 G90 G54\n(2D Adaptive1)\nT2 M6\nS900 M4\nG0 X0. Y0.\nG43 H2 Z5.\nG1 Z-1. F90.\nX9.\nG0 Z5.\nM30\n",
            &expect![[r#"
                5 | S900 M4
                  |      ^^ warning[mill-turns-backwards] the milling cutter turns backwards (`M4`)
            "#]],
        );
    }

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
