//! A tool change that the block delete switch leaves out, and the length of its tool that stays.

use std::ops::Range;

use gcheck_controls::{Effect, Letter};
use gcheck_engine::{Abstract, Domain};

use crate::declare::declare_rule;
use crate::facts::block_delete::is_optional;
use crate::facts::offset_schemes::whole;
use crate::{PathCx, PathRule, Report, Run, Uses, Watch};
use crate::{Remembers, remembers};

declare_rule! {
    /// A tool change is in a block with a block delete (`/`), and a later block without one takes the length offset of
    /// the new tool.
    ///
    /// ## Why it matters
    /// With the switch on, the tool before stays in the spindle and works with the length of the other one: it goes too
    /// deep by the difference, at rapid, or cuts air.
    ///
    /// ## Reported
    /// ```nc,reported,haas-mill
    /// T2 M6
    /// G90 G54 G0 X0. Y0.
    /// G43 H2 Z1.
    /// /T3 M6
    /// G43 H3 Z1.
    /// M30
    /// ```
    /// ## Not reported
    /// All blocks of the tool are left out together.
    /// ```nc,quiet,haas-mill
    /// T2 M6
    /// G90 G54 G0 X0. Y0.
    /// G43 H2 Z1.
    /// /T3 M6
    /// /G43 H3 Z1.
    /// M30
    /// ```
    rule "tool-change-in-skipped-block" in "tool" {
        summary: "tool change that block delete leaves out without its length",
        severity: Warning,
        tier: Path,
        since: "0.1.0",
        run: Run::Path { watch: Watch::BLOCKS, make: || Box::new(ToolChangeInSkippedBlock { change: None }) },
    }
}

#[derive(Clone, PartialEq)]
struct ToolChangeInSkippedBlock {
    /// The last tool change, if it is in a block to be skipped.
    change: Option<Change>,
}

remembers!(ToolChangeInSkippedBlock: change);

/// A tool change in a block to be skipped.
#[derive(Clone, PartialEq)]
struct Change {
    /// The tool that stays with the switch on.
    before: u32,
    /// The tool that comes with the switch off.
    after: u32,
    range: Range<u32>,
}

remembers!(Change: range);

impl PathRule for ToolChangeInSkippedBlock {
    fn memory(&mut self) -> Remembers<'_> {
        Remembers::All(self)
    }

    fn concerns(&self, program: &Uses<'_>) -> bool {
        program.file_index.block_deletes != 0 && program.may(changes_tool)
    }

    fn block(&mut self, cx: &PathCx<'_>, report: &mut Report<'_>) {
        if cx.has_effect(changes_tool) {
            self.change = is_optional(cx).then(|| change(cx)).flatten();
        }
        if is_optional(cx) || !cx.has_effect(|effect| effect == Effect::LengthPlus) {
            return;
        }
        let has_offset = cx.origin().letters.contains(Letter::of('H'));
        let offset = cx.known_number('H').filter(|_| has_offset).and_then(whole);
        let Some(change) = self.change.take_if(|change| Some(change.after) == offset) else { return };
        let Change { before, after, range } = change;
        report.add(
            cx.finding(
                &META,
                cx.letter_range('H'),
                format!(
                    "with block delete on, tool {before} works with the length of tool {after} (`H{after}`)"
                ),
            )
            .label("is not skipped")
            .also(range, format!("tool {after} comes only with the switch off"))
            .help("mark the tool change and all blocks that belong to it with `/`, or none of them"),
        );
    }
}

fn changes_tool(effect: Effect) -> bool {
    effect == Effect::ToolChange
}

fn change(cx: &PathCx<'_>) -> Option<Change> {
    let before = Abstract::known(cx.state().tool()).and_then(whole)?;
    let after = cx.known_number('T').and_then(whole)?;
    (before > 0 && before != after).then(|| Change { before, after, range: cx.effect_range(changes_tool) })
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::check_rule;

    #[test]
    fn the_length_of_the_tool_that_does_not_come() {
        check_rule(
            &RULE,
            "fanuc-mill",
            "T2 M6\nG43 H2 Z1.\n/T3 M6\nG0 X1.\nG43 H3 Z1.\nT4 M6\n/G43 H4 Z1.\n/T5 M6\nG43 H9 Z1.\nM30\n",
            &expect![[r#"
                5 | G43 H3 Z1.
                  |     ^^ warning[tool-change-in-skipped-block] with block delete on, tool 2 works with the length of tool 3 (`H3`)
            "#]],
        );
    }

    #[test]
    fn the_first_tool_may_be_in_the_spindle() {
        check_rule(&RULE, "haas-mill", "/T3 M6\nG43 H3 Z1.\nM30\n", &expect![[""]]);
    }

    #[test]
    fn a_change_without_the_switch_comes_between() {
        check_rule(&RULE, "haas-mill", "T2 M6\n/T3 M6\nT3 M6\nG43 H3 Z1.\nM30\n", &expect![[""]]);
    }
}
