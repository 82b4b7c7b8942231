//! A tool length that is measured with one tool and written to another tool's offset.

use gcheck_controls::{Effect, Letter};
use gcheck_engine::{Abstract, Domain, Fact, Role};

use crate::declare::declare_rule;
use crate::facts::offset_schemes::whole;
use crate::{PathCx, PathRule, Report, Run, Watch};

declare_rule! {
    /// A tool length is measured (`G37`) while the tool in the spindle has its own length offset on, and the result is
    /// written to another offset.
    ///
    /// ## Why it matters
    /// The offset of the tool in the spindle does not change, and another tool gets its length: that tool cuts too deep
    /// or cuts air by the difference.
    ///
    /// ## Reported
    /// ```nc,reported,haas-mill
    /// T1 M6
    /// G90 G54 G0 X0. Y0.
    /// G43 H1 Z2.
    /// G37 H2 Z0. F10.
    /// M30
    /// ```
    /// ## Not reported
    /// ```nc,quiet,haas-mill
    /// T1 M6
    /// G90 G54 G0 X0. Y0.
    /// G43 H1 Z2.
    /// G37 H1 Z0. F10.
    /// M30
    /// ```
    rule "length-written-for-another-tool" in "probing" {
        summary: "measured length goes to another tool's offset",
        severity: Warning,
        tier: Path,
        since: "0.1.0",
        run: Run::Path { watch: Watch::BLOCKS, make: || Box::new(LengthWrittenForAnotherTool) },
    }
}

struct LengthWrittenForAnotherTool;

impl PathRule for LengthWrittenForAnotherTool {
    fn block(&mut self, cx: &PathCx<'_>, report: &mut Report<'_>) {
        if !cx.has_effect(|effect| effect == Effect::ProbeLength)
            || cx.origin().letters.contains(Letter::of('T'))
        {
            return;
        }
        let written = cx.known_number('H').and_then(whole);
        let state = cx.state();
        let known = |value| Abstract::known(value).and_then(whole);
        let (Some(tool), Some(offset), Some(written)) = (known(state.tool()), known(state.h()), written)
        else {
            return;
        };
        let is_on = state.effect(Role::Length, cx.model).is_some_and(|effect| effect != Effect::LengthOff);
        // A different scheme, H = T + 20 and the like, is not judged.
        if !is_on || offset != tool || written == tool || written == 0 {
            return;
        }
        let message = format!("length of tool {tool} is written to offset {written} (`H{written}`)");
        let finding = cx
            .finding(&META, cx.letter_range('H'), message)
            .label(format!("tool {tool} is in the spindle, with offset {offset} on"))
            .help(format!("write `H{tool}`, or change to the tool that offset {written} belongs to"));
        report.add(cx.resting_on(finding, Fact::Length, &format!("`H{offset}`")));
    }
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::check_rule;

    #[test]
    fn an_offset_of_the_next_tool() {
        check_rule(
            &RULE,
            "haas-mill",
            "T1 M6\nG43 H1 Z2.\nG37 H1 Z0. F10.\nT2 M6\nG43 H2 Z2.\nG37 H3 Z0. F10.\nM30\n",
            &expect![[r#"
                6 | G37 H3 Z0. F10.
                  |     ^^ warning[length-written-for-another-tool] length of tool 2 is written to offset 3 (`H3`)
            "#]],
        );
    }

    #[test]
    fn offsets_numbered_otherwise_or_unknown_are_left_alone() {
        check_rule(
            &RULE,
            "haas-mill",
            "T1 M6\nG43 H21 Z2.\nG37 H22 Z0. F10.\nG43 H1\nG37 H#100 Z0. F10.\nG37 Z0. F10.\nT2 M6\nG37 H2 Z0. F10.\nM30\n",
            &expect![[""]],
        );
    }
}
