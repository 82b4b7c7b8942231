//! The tool table read again with a tool in the spindle.

use gcheck_controls::Effect;
use gcheck_engine::{Abstract, Domain, Fault};

use crate::declare::declare_rule;
use crate::{PathCx, PathRule, Report, Run, Watch, limit};

declare_rule! {
    /// The tool table is read again (`G10 L0`) while a tool is in the spindle.
    ///
    /// ## Why it matters
    /// The control refuses it: the table would change the length of the tool that is in use. The program stops here.
    ///
    /// ## Reported
    /// ```nc,reported,linuxcnc
    /// G21 G90
    /// T1 M6
    /// G10 L0
    /// M2
    /// ```
    /// ## Not reported
    /// ```nc,quiet,linuxcnc
    /// G21 G90
    /// T0 M6
    /// G10 L0
    /// T1 M6
    /// M2
    /// ```
    rule "tool-table-read-with-tool" in "offsets" {
        summary: "tool table read again with a tool in the spindle",
        severity: Error,
        tier: Path,
        since: "0.1.0",
        run: Run::Path { watch: Watch::FAULTS, make: || Box::new(ToolTableReadWithTool) },
    }
}

struct ToolTableReadWithTool;

impl PathRule for ToolTableReadWithTool {
    fn fault(&mut self, cx: &PathCx<'_>, fault: &Fault, report: &mut Report<'_>) {
        let Fault::NotNow(code, None) = *fault else { return };
        if cx.model.effect(code) != Effect::WriteOffsets {
            return;
        }
        let Some(code) = cx.code_of(code) else { return };
        let tool = Abstract::known(cx.state().tool()).map_or_else(
            || "a tool is in the spindle".to_owned(),
            |tool| format!("tool {tool} is in the spindle"),
        );
        let (name, entry) = (code.number(), code.entry());
        report.add(
            cx.finding(
                &META,
                cx.range(),
                format!("tool table read again with a tool in the spindle (`{name} L0`)"),
            )
            .label(tool)
            .note(format!("`{name} L0` reads the table only with an empty spindle  [{}]", entry.source))
            .help(format!("unload the tool (`T0 M6`) before `{name} L0`"))
            .at_most(limit(entry.confidence)),
        );
    }
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::check_rule;

    #[test]
    fn nobody_knows_what_the_program_before_left_in_the_spindle() {
        check_rule(&RULE, "linuxcnc", "G21 G90\nG10 L0\nM2\n", &expect![[""]]);
        check_rule(&RULE, "linuxcnc", "G21 G90\nT#1 M6\nG10 L0\nM2\n", &expect![[""]]);
    }

    #[test]
    fn the_code_may_be_computed() {
        check_rule(
            &RULE,
            "linuxcnc",
            "T1 M6\n#1=0\nG10 L#1\nM2\n",
            &expect![[r#"
            3 | G10 L#1
              | ^^^^^^^ error[tool-table-read-with-tool] tool table read again with a tool in the spindle (`G10 L0`)
        "#]],
        );
    }
}
