//! A tool of a lathe that cuts under offset 00.

use gcheck_controls::{Effect, Letter};
use gcheck_engine::{Abstract, At, Axis, Domain, Event, Fact, Spindle, Truth};

use crate::declare::declare_rule;
use crate::facts::offset_schemes::whole;
use crate::facts::tool_words::ToolWords;
use crate::{PathCx, PathRule, Remembers, Report, Run, Uses, Watch, remembers};

declare_rule! {
    /// A lathe takes the last two digits of `T` as the offset: `T0100` puts tool 1 in place and cancels its offset. The tool cuts
    /// before another `T` gives it one.
    ///
    /// Pullers, stops and other tools that are fed while nothing turns are not reported, nor programs that give the place of each tool
    /// by a work offset of its own or by a preset.
    ///
    /// ## Why it matters
    /// Without an offset the control does not know where the tip is: all diameters and lengths are off by the whole offset of the
    /// tool, so that it cuts into the part or beside it.
    ///
    /// ## Reported
    /// ```nc,reported,fanuc-lathe
    /// G21 G99
    /// T0100
    /// G97 S900 M3
    /// G0 X48. Z2.
    /// G1 Z-30. F0.2
    /// M30
    /// ```
    /// ```nc,reported,haas-lathe
    /// G21 G99
    /// T303
    /// G97 S900 M3
    /// G0 X48. Z2.
    /// G1 Z-30. F0.2
    /// T300
    /// G1 X52.
    /// M30
    /// ```
    /// ## Not reported
    /// The offset is cancelled when the tool has left the part.
    /// ```nc,quiet,fanuc-lathe
    /// G21 G99
    /// T0100
    /// G97 S900 M3
    /// G0 X48. Z2. T0101
    /// G1 Z-30. F0.2
    /// G0 X100. Z100. T0100
    /// M30
    /// ```
    rule "lathe-tool-without-offset" in "tool" {
        summary: "tool of a lathe that cuts under offset 00",
        severity: Warning,
        tier: Path,
        since: "0.1.0",
        run: Run::Path {
            watch: Watch::CUTS,
            make: || Box::new(LatheToolWithoutOffset::default()),
        },
    }
}

#[derive(Default, Clone, PartialEq)]
struct LatheToolWithoutOffset {
    /// The call of the tool that was reported.
    told: Option<At>,
    /// Another tool has cut with an offset. A program without any is reported once.
    uses_offsets: bool,
}

remembers!(LatheToolWithoutOffset: told);

impl PathRule for LatheToolWithoutOffset {
    fn memory(&mut self) -> Remembers<'_> {
        Remembers::All(self)
    }

    fn concerns(&self, program: &Uses<'_>) -> bool {
        let tools = &program.environment.control().semantics().tools;
        tools.change_by_t && tools.offset_in_t
    }

    fn cut(&mut self, cx: &PathCx<'_>, _: &Event, report: &mut Report<'_>) {
        let Some(tool) = Abstract::known(cx.state().tool()).and_then(whole).filter(|tool| *tool > 0) else {
            return;
        };
        let Some(offset) = Abstract::known(cx.state().h()) else { return };
        if offset > 0.0 {
            self.uses_offsets = true;
            return;
        }
        let is_new = |at: &At| at.file == 0 && self.told != Some(*at);
        let called = cx.definitions().set_by(Fact::Tool).filter(is_new);
        let Some(called) = called.filter(|_| self.told.is_none() || self.uses_offsets) else { return };
        let Some(call) = cx.find_word(called, |word| word.letter == Letter::of('T')) else { return };
        let stands = cx.state().spindle() == Some(Spindle::Stopped) && cx.state().live_tool() == Truth::False;
        // A preset says where the tool is.
        let shift = cx.state().shift();
        let is_preset = [Axis::X, Axis::Z].into_iter().any(|axis| shift.raw(axis) != 0.0);
        let has_own_offsets = !self.uses_offsets && cx.file_uses(is_further_work_offset);
        if stands || is_preset || has_own_offsets || ToolWords::of(cx).needs_no_spindle() {
            return;
        }
        self.told = Some(called);
        let finding = cx
            .finding(&META, cx.range(), format!("tool {tool} cuts without its offset"))
            .label("cuts under offset 00")
            .also(call, "the last two digits cancel the offset");
        report.add(finding.help(format!("call the tool with its offset: `T{tool:02}{tool:02}`")));
    }
}

/// A work offset beside the first one, which may be that of a tool.
fn is_further_work_offset(effect: Effect) -> bool {
    matches!(effect, Effect::WorkOffset(number) if number > 1)
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::check_rule;

    #[test]
    fn each_call_is_told_once_where_others_have_offsets() {
        let cut = "G97 S900 M3\nG0 X48. Z2.\nG1 Z-30. F.2\nG1 X50.\nM8\nG1 Z-32.\nG0 X99. Z9.\n";
        check_rule(
            &RULE,
            "fanuc-lathe",
            &format!("G21 G99\nT0100\n{cut}T0300\n{cut}T0404\n{cut}T0500\n{cut}M30\n"),
            &expect![[r#"
                5 | G1 Z-30. F.2
                  | ^^^^^^^^^^^^ warning[lathe-tool-without-offset] tool 1 cuts without its offset
                29 | G1 Z-30. F.2
                   | ^^^^^^^^^^^^ warning[lathe-tool-without-offset] tool 5 cuts without its offset
            "#]],
        );
    }

    #[test]
    fn what_is_called_may_have_an_offset() {
        for program in [
            "G21 G99\nG97 S900 M3\nG0 X48. Z2.\nG1 Z-30. F.2\nM30\n",
            "G21 G99\nT#1\nG97 S900 M3\nG0 X48. Z2.\nG1 Z-30. F.2\nM30\n",
            "G21 G99\nT0900 (BAR PULLER)\nG0 X0. Z2.\nG98 G1 Z-30. F200.\nM30\n",
            "G21 G99\nT0700\nG98 G0 X0. Z20.\nG1 Z1. F500.\nM30\n",
            "G21 G99\nT0100\nG50 X200. Z150.\nG97 S900 M3\nG0 X48. Z2.\nG1 Z-30. F.2\nM30\n",
            "G21 G99\nT0100\nG54 G97 S900 M3\nG0 X48. Z2.\nG1 Z-30. F.2\nT0200\nG55 G0 X20.\nG1 Z-3.\nM30\n",
            "G21 G99\nT0100\nG65 P9001\nT0101\nG97 S900 M3\nG0 X48. Z2.\nG1 Z-30. F.2\nM30\n",
        ] {
            check_rule(&RULE, "fanuc-lathe", program, &expect![[""]]);
        }
    }
}
