//! A tool change without a stop before it.

use gcheck_controls::Effect;
use gcheck_engine::Event;

use crate::declare::declare_rule;
use crate::facts::boundary::{Boundary, boundary, boundary_range};
use crate::{PathCx, PathRule, Report, Run, Watch};
use crate::{Remembers, remembers};

declare_rule! {
    /// A tool has cut, and the next one comes without an optional stop (`M1`) or a stop (`M0`) between them.
    ///
    /// ## Why it matters
    /// Between two tools the operator looks at the part, clears chips, and restarts after a broken tool. The optional
    /// stop makes that possible, and block search leads there.
    ///
    /// ## Reported
    /// ```nc,reported,haas-mill
    /// T1 M6
    /// S1000 M3
    /// G1 X1. F10.
    /// T2 M6
    /// S1000 M3
    /// G1 X2. F10.
    /// M30
    /// ```
    /// ## Not reported
    /// ```nc,quiet,haas-mill
    /// T1 M6
    /// S1000 M3
    /// G1 X1. F10.
    /// M1
    /// T2 M6
    /// S1000 M3
    /// G1 X2. F10.
    /// M30
    /// ```
    rule "tool-change-without-stop" in "tool" {
        summary: "tool change without an optional stop before it",
        severity: Hint,
        tier: Path,
        recommended: false,
        sets: [RestartSafe],
        fixable: OnRequest,
        since: "0.1.0",
        run: Run::Path {
            watch: Watch::BLOCKS.union(Watch::CUTS),
            make: || Box::new(ToolChangeWithoutStop { has_cut: false }),
        },
    }
}

#[derive(Clone, PartialEq)]
struct ToolChangeWithoutStop {
    /// The tool has cut since the last stop.
    has_cut: bool,
}

remembers!(ToolChangeWithoutStop);

impl PathRule for ToolChangeWithoutStop {
    fn memory(&mut self) -> Remembers<'_> {
        Remembers::All(self)
    }

    fn block(&mut self, cx: &PathCx<'_>, report: &mut Report<'_>) {
        let stops = Effect::stops_program;
        if cx.has_effect(stops) {
            self.has_cut = false;
        }
        if boundary(cx) != Some(Boundary::ToolChange) || !std::mem::replace(&mut self.has_cut, false) {
            return;
        }
        let Some(stop) = cx.name_of_effect(Effect::OptionalStop) else { return };
        report.add(
            cx.finding(
                &META,
                boundary_range(cx, Boundary::ToolChange),
                format!("tool change without an optional stop before it (`{stop}`)"),
            )
            .label("the tool before has cut, and the machine does not stop")
            .help(format!("put `{stop}` in a block before the tool change"))
            .fix_if(cx.block_before(Some(&stop))),
        );
    }

    fn cut(&mut self, _: &PathCx<'_>, _: &Event, _: &mut Report<'_>) {
        self.has_cut = true;
    }
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::check_rule;

    #[test]
    fn a_turret_stops_too() {
        check_rule(
            &RULE,
            "fanuc-lathe",
            "T0101\nG97 S500 M3\nG1 X1. F.1\nG0 X50. Z50.\nT0202\nG1 X2.\nM01\nT0303\nM30\n",
            &expect![[r#"
                5 | T0202
                  | ^^^^^ hint[tool-change-without-stop] tool change without an optional stop before it (`M1`)
            "#]],
        );
    }

    #[test]
    fn a_tool_that_has_not_cut_needs_none() {
        check_rule(&RULE, "haas-mill", "T1 M6\nG0 X1.\nT2 M6\nM30\n", &expect![[""]]);
    }
}
