//! A tool that is called and never changed in.

use std::ops::Range;

use gcheck_controls::Effect;
use gcheck_engine::{Abstract, At, Domain, Ending, Event, Fact};

use crate::declare::declare_rule;
use crate::facts::boundary::{Boundary, boundary, ends_at_tape_mark};
use crate::{Finding, PathCx, PathRule, Report, Run, Severity, Watch};
use crate::{Remembers, remembers};

declare_rule! {
    /// A tool is called (`T`), and then another one is called or the program ends, without a tool change (`M6`) in
    /// between.
    ///
    /// ## Why it matters
    /// The blocks after the `T` cut with the tool that was in the spindle before. The last call of a program may
    /// prepare the first tool of the next part.
    ///
    /// ## Reported
    /// ```nc,reported,haas-mill
    /// T1 M6
    /// G43 H1 Z1.
    /// T2
    /// G43 H2 Z1.
    /// T3 M6
    /// M30
    /// ```
    /// ## Not reported
    /// ```nc,quiet,haas-mill
    /// T1 M6
    /// T2
    /// G1 X1. F10.
    /// M6
    /// T1
    /// G1 X2.
    /// M30
    /// ```
    rule "tool-called-not-changed" in "tool" {
        summary: "tool called and never changed in",
        severity: Warning,
        tier: Path,
        since: "0.1.0",
        run: Run::Path {
            watch: Watch::BLOCKS.union(Watch::CHANGES).union(Watch::ENDS),
            make: || Box::new(ToolCalledNotChanged { called: None, first: None }),
        },
    }
}

/// A call without a tool change so far.
#[derive(Clone, PartialEq)]
struct Call {
    at: At,
    tool: u32,
    range: Range<u32>,
    finding: Finding,
    /// The place where its length came into effect, with another tool in the spindle.
    length: Option<Range<u32>>,
}

remembers!(Call: at, range, finding, length);

impl Call {
    fn judge(self, label: &str) -> Finding {
        let finding = self.finding.label(label);
        match self.length {
            Some(range) => {
                finding.also(range, "its length is used from here, with another tool in the spindle")
            }
            None => finding.at_most(Severity::Info),
        }
    }
}

#[derive(Clone, PartialEq)]
struct ToolCalledNotChanged {
    called: Option<Call>,
    /// The first tool of the program.
    first: Option<u32>,
}

remembers!(ToolCalledNotChanged: called);

impl PathRule for ToolCalledNotChanged {
    fn memory(&mut self) -> Remembers<'_> {
        Remembers::All(self)
    }

    fn block(&mut self, cx: &PathCx<'_>, report: &mut Report<'_>) {
        if cx.has_effect(|effect| effect == Effect::TurnCarousel) {
            // `T` names a place in the changer.
            self.called = None;
        }
        if boundary(cx) == Some(Boundary::ProgramEnd) {
            self.end(cx, report);
        }
    }

    fn changed(&mut self, cx: &PathCx<'_>, event: &Event, report: &mut Report<'_>) {
        match event {
            Event::ToolChange(tool) => {
                self.first = self.first.or(*tool);
                self.called = None;
            }
            Event::SelectTool(Some(tool)) if !cx.model.semantics().tools.change_by_t => {
                if let Some(call) = self.called.take()
                    && call.tool != *tool
                    && call.at != cx.origin().at
                    && !is_in_spindle(cx, call.tool)
                {
                    let finding = call.judge("no tool change before the next tool is called");
                    report.add(finding.also(cx.letter_range('T'), format!("tool {tool} is called here")));
                }
                self.called = None;
                let is_changed_here =
                    cx.has_effect(|effect| matches!(effect, Effect::ToolChange | Effect::TurnCarousel));
                if *tool > 0 && !is_changed_here && cx.is_on_every_path() {
                    let range = cx.letter_range('T');
                    let finding = cx
                        .finding(
                            &META,
                            range.clone(),
                            format!("tool {tool} is called (`T{tool}`) and never put in"),
                        )
                        .help("change the tool with `M6`, or remove the call");
                    self.called =
                        Some(Call { at: cx.origin().at, tool: *tool, range, finding, length: None });
                }
            }
            Event::LengthOffset(_) => {
                let (tool, offset) = (Abstract::known(cx.state().tool()), Abstract::known(cx.state().h()));
                if let Some(call) = &mut self.called
                    && offset == Some(f64::from(call.tool))
                    && tool.is_some_and(|tool| tool.to_bits() != f64::from(call.tool).to_bits())
                    && call.length.is_none()
                {
                    call.length = Some(cx.letter_range('H'));
                }
            }
            Event::SelectTool(_) | Event::SetToolNumber(_) => self.called = None,
            _ => {}
        }
    }

    fn ended(&mut self, cx: &PathCx<'_>, ending: Ending, report: &mut Report<'_>) {
        if ends_at_tape_mark(cx, ending) {
            self.end(cx, report);
        }
    }
}

impl ToolCalledNotChanged {
    fn end(&mut self, cx: &PathCx<'_>, report: &mut Report<'_>) {
        let Some(call) = self.called.take() else { return };
        // Machines without a changer: one tool, named for the operator.
        let is_staged = self.first.is_none() || self.first == Some(call.tool);
        let is_here = cx.range().start <= call.range.start && call.range.end <= cx.range().end;
        if !is_staged && !is_here && !is_in_spindle(cx, call.tool) {
            report.add(call.judge("no tool change before the program ends"));
        }
    }
}

/// A tool change in a program that is not shown here changes the tool too.
fn is_in_spindle(cx: &PathCx<'_>, tool: u32) -> bool {
    let in_spindle = Abstract::known(cx.state().tool());
    in_spindle == Some(f64::from(tool))
        || in_spindle.is_none()
            && (cx.definitions().set_by(Fact::Tool).is_some() || cx.is_after_unknown_program())
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::check_rule;

    #[test]
    fn the_call_is_marked() {
        check_rule(
            &RULE,
            "fanuc-mill",
            "T1 M6\nT5\nG1 X1. F10.\nT7\nM6\nT4\nG1 X2.\nM30\n",
            &expect![[r#"
                2 | T5
                  | ^^ info[tool-called-not-changed] tool 5 is called (`T5`) and never put in
                6 | T4
                  | ^^ info[tool-called-not-changed] tool 4 is called (`T4`) and never put in
            "#]],
        );
    }

    #[test]
    fn the_length_of_a_tool_that_is_not_in_the_spindle() {
        check_rule(
            &RULE,
            "haas-mill",
            "T2 M6\nT3\nG43 H3 Z1.\nG1 X1. F10.\nM30\n",
            &expect![[r#"
                2 | T3
                  | ^^ warning[tool-called-not-changed] tool 3 is called (`T3`) and never put in
            "#]],
        );
    }

    #[test]
    fn the_first_tool_may_be_staged_at_the_end() {
        check_rule(&RULE, "fanuc-mill", "T3 M6\nG1 X1. F10.\nT8 M6\nT3\nG1 X2.\nM30\n", &expect![[""]]);
    }

    #[test]
    fn a_program_of_one_tool_names_it_for_the_operator() {
        check_rule(&RULE, "linuxcnc", "G21 T1\nG0 X1\nM2\n", &expect![[""]]);
    }

    #[test]
    fn a_program_that_is_not_at_hand_may_change_it() {
        check_rule(&RULE, "fanuc-mill", "T1 M6\nT5\nM98 P9000\nG1 X1. F10.\nT7\nM6\nM30\n", &expect![[""]]);
    }

    #[test]
    fn a_turret_needs_no_change() {
        check_rule(&RULE, "fanuc-lathe", "T0101\nG1 X1. F.1\nT0202\nG1 X2.\nM30\n", &expect![[""]]);
    }
}
