//! A tool or offset that the configured tool table does not have.

use gcheck_engine::{At, Fault};

use crate::declare::declare_rule;
use crate::{PathCx, PathRule, Report, Run, Watch};
use crate::{Remembers, remembers};

declare_rule! {
    /// A block names a tool or offset that the configured tool table does not have.
    ///
    /// The rule needs a whole tool table: without one any tool may exist.
    ///
    /// ## Why it matters
    /// The control stops with an alarm at the tool change, or uses the wrong length.
    ///
    /// ## Reported
    /// With tools 1 to 3 in the table:
    /// ```nc,reported,linuxcnc
    /// G21 T7 M6
    /// G43 H7
    /// M2
    /// ```
    /// ## Not reported
    /// ```nc,quiet,linuxcnc
    /// G21 T2 M6
    /// G43 H2
    /// M2
    /// ```
    /// ## How to fix it
    /// * Correct the number of the tool or of the offset.
    /// * If the machine has the tool, add it to the table that the configuration names, or under `[tools]`.
    rule "tool-not-in-table" in "machine" {
        summary: "tool or offset not in the tool table",
        severity: Error,
        tier: Path,
        since: "0.1.0",
        run: Run::Path { watch: Watch::FAULTS, make: || Box::new(ToolNotInTable { last: None }) },
    }
}

#[derive(Clone, PartialEq)]
struct ToolNotInTable {
    last: Option<(At, u32)>,
}

remembers!(ToolNotInTable: last);

impl PathRule for ToolNotInTable {
    fn memory(&mut self) -> Remembers<'_> {
        Remembers::All(self)
    }

    fn fault(&mut self, cx: &PathCx<'_>, fault: &Fault, report: &mut Report<'_>) {
        let Fault::NoSuchTool(number) = fault else { return };
        if self.last.replace((cx.origin().at, *number)) == Some((cx.origin().at, *number)) {
            return;
        }
        let by_t = cx.model.semantics().tools.offset_in_t;
        let names = |word: &gcheck_program::Word| {
            let letter = matches!(word.letter.ascii(), b'T' | b'H' | b'D' | b'P' | b'Q');
            let value = word.integer();
            letter
                && (value == Some(*number)
                    || by_t && value.is_some_and(|v| v / 100 == *number || v % 100 == *number))
        };
        let mut known: Vec<u32> = cx.environment.machine.engine.tools.keys().copied().collect();
        known.truncate(12);
        let listed = known.iter().map(u32::to_string).collect::<Vec<_>>().join(", ");
        report.add(
            cx.finding(&META, cx.word_range(names), format!("the tool table has no tool {number}"))
                .label("not in the configured table")
                .note(format!(
                    "the table has {}",
                    if listed.is_empty() { "no tools".to_owned() } else { listed }
                ))
                .help("add the tool to the table, or choose another one"),
        );
    }
}

#[cfg(test)]
mod tests {
    use super::{META, RULE};
    use crate::testing::{World, check_rule, check_rule_in};
    use expect_test::expect;

    #[test]
    fn the_word_is_marked() {
        check_rule_in(
            &RULE,
            "linuxcnc",
            "G21 T7 M6\nG43 H2\nG43 H9\nM2\n",
            &World::of_examples(&META),
            &expect![[r#"
                1 | G21 T7 M6
                  |     ^^ error[tool-not-in-table] the tool table has no tool 7
                3 | G43 H9
                  |     ^^ error[tool-not-in-table] the tool table has no tool 9
            "#]],
        );
    }

    #[test]
    fn a_turret_names_tool_and_offset_in_one_word() {
        check_rule_in(
            &RULE,
            "fanuc-lathe",
            "T0707\nM30\n",
            &World::of_examples(&META),
            &expect![[r#"
            1 | T0707
              | ^^^^^ error[tool-not-in-table] the tool table has no tool 7
        "#]],
        );
    }

    #[test]
    fn without_a_table_any_tool_may_exist() {
        check_rule(&RULE, "linuxcnc", "G21 T7 M6\nG43 H9\nM2\n", &expect![[""]]);
    }
}
