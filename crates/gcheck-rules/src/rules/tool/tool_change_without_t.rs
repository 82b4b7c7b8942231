//! A tool change when no tool was called.

use gcheck_controls::{Effect, Letter};
use gcheck_engine::{At, Fact};

use crate::declare::declare_rule;
use crate::facts::boundary::is_before;
use crate::{PathCx, PathRule, Report, Run, Watch};
use crate::{Remembers, remembers};

declare_rule! {
    /// A tool change (`M6`) without a tool call (`T`) in its block, before it, or since the last change.
    ///
    /// ## Why it matters
    /// The control takes the tool that the last program, or the operator, called, or stops with an alarm; after another
    /// change the tool in the spindle remains, and works with the speeds and length of the next one.
    ///
    /// ## Reported
    /// ```nc,reported,haas-mill
    /// M6
    /// G43 H1 Z1.
    /// M30
    /// ```
    /// ```nc,reported,haas-mill
    /// T1 M6
    /// G43 H1 Z1.
    /// M6
    /// G43 H2 Z1.
    /// M30
    /// ```
    /// ## Not reported
    /// ```nc,quiet,haas-mill
    /// T1
    /// M6
    /// G43 H1 Z1.
    /// M30
    /// ```
    /// The next tool is called while this one works.
    /// ```nc,quiet,haas-mill
    /// T1 M6
    /// T2
    /// G43 H1 Z1.
    /// M6
    /// G43 H2 Z1.
    /// M30
    /// ```
    rule "tool-change-without-t" in "tool" {
        summary: "tool change without a called tool",
        severity: Warning,
        tier: Path,
        since: "0.1.0",
        run: Run::Path { watch: Watch::BLOCKS, make: || Box::new(ToolChangeWithoutT { last: None }) },
    }
}

#[derive(Clone, PartialEq)]
struct ToolChangeWithoutT {
    /// The last tool change.
    last: Option<At>,
}

remembers!(ToolChangeWithoutT: last);

impl PathRule for ToolChangeWithoutT {
    fn memory(&mut self) -> Remembers<'_> {
        Remembers::All(self)
    }

    fn block(&mut self, cx: &PathCx<'_>, report: &mut Report<'_>) {
        let is_change = cx.has_effect(|effect| effect == Effect::ToolChange);
        if !is_change || !cx.model.semantics().tools.change_needs_t {
            return;
        }
        let last = self.last.replace(cx.origin().at);
        let called = cx.definitions().set_by(Fact::Selected);
        if cx.origin().letters.contains(Letter::of('T'))
            || cx.is_called_only()
            || cx.is_after_unknown_program()
        {
            return;
        }
        let range = cx.effect_range(|effect| effect == Effect::ToolChange);
        if let (Some(called), Some(last)) = (called, last) {
            // In a loop, the change of the last iteration counts.
            if is_before(last, cx.origin().at) && (called == last || is_before(called, last)) {
                report.add(
                    cx.finding(
                        &META,
                        range,
                        "tool change, and no tool was called since the last one (`M6` without `T`)",
                    )
                    .label("the tool in the spindle stays there")
                    .help("give the tool number: `T2 M6`"),
                );
            }
            return;
        }
        if called.is_some() || last.is_some() {
            return;
        }
        report.add(
            cx.finding(&META, range, "tool change, and no tool was called (`M6` without `T`)")
                .label("takes the tool that was called before the program, if any")
                .assuming("no tool is called when the program starts")
                .help("give the tool number: `T1 M6`"),
        );
    }
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::check_rule;

    #[test]
    fn the_change_is_marked() {
        check_rule(
            &RULE,
            "linuxcnc",
            "G21 G0 X1\nM6\nG0 X2\nM6\nM2\n",
            &expect![[r#"
            2 | M6
              | ^^ warning[tool-change-without-t] tool change, and no tool was called (`M6` without `T`)
        "#]],
        );
    }

    #[test]
    fn every_change_needs_a_call_of_its_own() {
        check_rule(
            &RULE,
            "fanuc-mill",
            "O1\nT1 M6\nG43 H1 Z1.\nM6\nG43 H2 Z1.\nT3\nM6\nM30\n",
            &expect![[r#"
                4 | M6
                  | ^^ warning[tool-change-without-t] tool change, and no tool was called since the last one (`M6` without `T`)
            "#]],
        );
    }

    #[test]
    fn a_tool_called_in_a_subprogram_counts() {
        check_rule(&RULE, "haas-mill", "M97 P10\nM6\nM30\nN10 T5\nM99\n", &expect![[""]]);
        check_rule(&RULE, "haas-mill", "M98 P9000\nM6\nM30\n", &expect![[""]]);
    }

    #[test]
    fn a_tool_change_program_is_called_with_its_tool() {
        check_rule(&RULE, "fanuc-mill", "O9001\nG91 G28 Z0.\nM6\nM99\n", &expect![[""]]);
    }
}
