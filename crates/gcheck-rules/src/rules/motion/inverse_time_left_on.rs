//! Inverse-time feed of one tool's rotary work that the next tool cuts with.

use gcheck_controls::{Effect, LetterSet};
use gcheck_engine::{At, Event, Fact, FeedMode, Role};

use crate::declare::declare_rule;
use crate::facts::boundary::{Boundary, boundary, is_before, with_tool_change};
use crate::facts::feed::goes_by_feed;
use crate::{PathCx, PathRule, Report, Run, Uses, Watch};
use crate::{Remembers, remembers};

declare_rule! {
    /// A tool cuts without a rotary axis under inverse-time feed (`G93`), which the tool before it switched on in the middle of its
    /// work.
    ///
    /// ## Why it matters
    /// `F` is the number of moves a minute there: `F500` makes each move in an eighth of a second, however long it is.
    ///
    /// ## Reported
    /// ```nc,reported,haas-mill
    /// G21 G90 G94 G54 T1 M6
    /// G0 X0. Y0. A0. S5000 M3
    /// G43 H1 Z5.
    /// G93 G1 X10. A90. F20.
    /// X20. A180. F20.
    /// G0 Z50.
    /// T2 M6
    /// G0 X0. Y0. S3000 M3
    /// G43 H2 Z5.
    /// G1 Z-2. F150.
    /// X40. F500.
    /// M30
    /// ```
    /// ## Not reported
    /// ```nc,quiet,haas-mill
    /// G21 G90 G94 G54 T1 M6
    /// G0 X0. Y0. A0. S5000 M3
    /// G43 H1 Z5.
    /// G93 G1 X10. A90. F20.
    /// X20. A180. F20.
    /// G94
    /// G0 Z50.
    /// T2 M6
    /// G0 X0. Y0. S3000 M3
    /// G43 H2 Z5.
    /// G1 Z-2. F150.
    /// X40. F500.
    /// M30
    /// ```
    rule "inverse-time-left-on" in "motion" {
        summary: "cut under the inverse-time feed of the tool before",
        severity: Warning,
        tier: Path,
        since: "0.1.0",
        run: Run::Path {
            watch: Watch::BLOCKS.union(Watch::CUTS),
            make: || Box::new(InverseTimeLeftOn::default()),
        },
    }
}

#[derive(Default, Clone, PartialEq)]
struct InverseTimeLeftOn {
    /// Where the first tool comes.
    first_tool: Option<At>,
    /// The block that switched on what was reported.
    told: Option<At>,
}

remembers!(InverseTimeLeftOn: first_tool, told);

impl PathRule for InverseTimeLeftOn {
    fn memory(&mut self) -> Remembers<'_> {
        Remembers::All(self)
    }

    fn concerns(&self, program: &Uses<'_>) -> bool {
        program.may(|effect| effect == Effect::FeedInverseTime)
    }

    fn block(&mut self, cx: &PathCx<'_>, _: &mut Report<'_>) {
        if self.first_tool.is_none() && boundary(cx) == Some(Boundary::ToolChange) {
            self.first_tool = Some(cx.origin().at);
        }
    }

    fn cut(&mut self, cx: &PathCx<'_>, event: &Event, report: &mut Report<'_>) {
        let fact = Fact::Mode(Role::FeedMode);
        let (Some(first), Some(set), Some(changed)) =
            (self.first_tool, cx.definitions().set_by(fact), cx.definitions().set_by(Fact::Tool))
        else {
            return;
        };
        let is_inverse = cx.state().feed_mode(cx.model) == Some(FeedMode::InverseTime);
        let turns = cx.origin().letters.intersects(LetterSet::of("ABC"));
        if !is_inverse || turns || !goes_by_feed(event) || self.told == Some(set) {
            return;
        }
        // From the head of the program it is meant for all tools.
        if !is_before(first, set) || !is_before(set, changed) || cx.is_called_only() {
            return;
        }
        self.told = Some(set);
        let name = cx.code_name(Role::FeedMode).unwrap_or_default();
        let minute = cx.name_of_effect(Effect::FeedPerMinute).unwrap_or_default();
        let finding = cx
            .finding(
                &META,
                cx.range(),
                format!("cut under the inverse-time feed of the tool before (`{name}`)"),
            )
            .label("moves no rotary axis; `F` counts moves a minute")
            .help(format!("switch back with `{minute}` where the work of the tool before ends"));
        report.add(with_tool_change(cx, cx.resting_on(finding, fact, &format!("`{name}`"))));
    }
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::check_rule;

    fn program(head: &str, cut: &str) -> String {
        format!(
            "G21 G90 {head} G54 T1 M6\nG0 X0. Y0. A0. S5000 M3\nG43 H1 Z5.\nG93 G1 X10. A90. F20.\nG0 Z50.\nT2 M6\nG0 X0. Y0. S3000 M3\nG43 H2 Z5.\n{cut}\nM30\n"
        )
    }

    #[test]
    fn from_tool_to_tool() {
        check_rule(
            &RULE,
            "fanuc-mill",
            &program("G94", "G1 Z-2. F150.\nX40."),
            &expect![[r#"
            9 | G1 Z-2. F150.
              | ^^^^^^^^^^^^^ warning[inverse-time-left-on] cut under the inverse-time feed of the tool before (`G93`)
        "#]],
        );
        for (head, cut) in
            [("G94", "G94 G1 Z-2. F150."), ("G94", "G93 G1 Z-2. F10."), ("G94", "G1 Z-2. A10. F10.")]
        {
            check_rule(&RULE, "fanuc-mill", &program(head, cut), &expect![[""]]);
        }
        let throughout = program("G93", "G1 Z-2. F150.").replace("G93 G1 X10.", "G1 X10.");
        check_rule(&RULE, "fanuc-mill", &throughout, &expect![[""]]);
    }
}
