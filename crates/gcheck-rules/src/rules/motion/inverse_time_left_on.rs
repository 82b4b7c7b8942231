//! Inverse-time feed of one tool's rotary work that the next tool cuts with.

use gcheck_controls::{Effect, LetterSet};
use gcheck_engine::{At, Event, Fact, FeedMode, Role};

use crate::declare::declare_rule;
use crate::facts::boundary::{Boundary, boundary, is_before, with_tool_change};
use crate::facts::feed::goes_by_feed;
use crate::{Finding, FollowedCx, PathCx, PathRule, Report, Run, Uses, Watch};
use crate::{Remembers, remembers};

declare_rule! {
    /// A tool cuts without a rotary axis under inverse-time feed (`G93`), which the tool before it switched on in the middle of its
    /// work. Where the tool feeds a rotary axis too before the mode changes, the mode is meant for it as well.
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
            watch: Watch::BLOCKS.union(Watch::MOVES).union(Watch::FOLLOWED),
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
    /// The block that switched on what is meant for a tool too, and where that tool came.
    meant: Option<(At, At)>,
    waiting: Option<Waiting>,
}

remembers!(InverseTimeLeftOn: first_tool, told, meant, waiting);

/// A cut under the mode of the tool before: this one may feed a rotary axis yet.
#[derive(Clone, PartialEq)]
struct Waiting {
    /// Where the mode was switched on, and where the tool came.
    by: (At, At),
    finding: Finding,
}

remembers!(Waiting: by, finding);

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

    fn moved(&mut self, cx: &PathCx<'_>, event: &Event, report: &mut Report<'_>) {
        let fact = Fact::Mode(Role::FeedMode);
        let (Some(first), Some(set), Some(changed)) =
            (self.first_tool, cx.definitions().set_by(fact), cx.definitions().set_by(Fact::Tool))
        else {
            return;
        };
        let by = (set, changed);
        if self.waiting.as_ref().is_some_and(|waiting| waiting.by != by) {
            self.tell(report);
        }
        let is_inverse = cx.state().feed_mode(cx.model) == Some(FeedMode::InverseTime);
        if !is_inverse || !goes_by_feed(event) || self.told == Some(set) || self.meant == Some(by) {
            return;
        }
        // From the head of the program it is meant for all tools.
        if !is_before(first, set) || !is_before(set, changed) || cx.is_called_only() {
            return;
        }
        if cx.origin().letters.intersects(LetterSet::of("ABC")) {
            (self.meant, self.waiting) = (Some(by), None);
            return;
        }
        if self.waiting.is_some() {
            return;
        }
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
        let finding = with_tool_change(cx, cx.resting_on(finding, fact, &format!("`{name}`")));
        self.waiting = Some(Waiting { by, finding });
    }

    fn followed(&mut self, _: &FollowedCx<'_>, report: &mut Report<'_>) {
        self.tell(report);
    }
}

impl InverseTimeLeftOn {
    fn tell(&mut self, report: &mut Report<'_>) {
        if let Some(waiting) = self.waiting.take() {
            self.told = Some(waiting.by.0);
            report.add(waiting.finding);
        }
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
        for (head, cut) in [
            ("G94", "G94 G1 Z-2. F150."),
            ("G94", "G93 G1 Z-2. F10."),
            ("G94", "G1 Z-2. A10. F10."),
            ("G94", "G1 Z-2. F30.\nX4. A10. F20.\nX9. Y.1 F55."),
        ] {
            check_rule(&RULE, "fanuc-mill", &program(head, cut), &expect![[""]]);
        }
        let throughout = program("G93", "G1 Z-2. F150.").replace("G93 G1 X10.", "G1 X10.");
        check_rule(&RULE, "fanuc-mill", &throughout, &expect![[""]]);
    }
}
