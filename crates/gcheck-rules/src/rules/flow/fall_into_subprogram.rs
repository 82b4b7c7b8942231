//! A program that runs into a subprogram.

use std::collections::BTreeSet;

use gcheck_controls::{Effect, Ends};
use gcheck_engine::{At, FrameKind};

use crate::declare::declare_rule;
use crate::{PathCx, PathRule, Report, Run, Watch};
use crate::{Remembers, remembers};

declare_rule! {
    /// Execution enters a subprogram from the block above it, without a call: on this path the program above has no
    /// end.
    ///
    /// ## Why it matters
    /// The subprogram runs once too often. Its `M99` then starts the whole program again.
    ///
    /// ## Reported
    /// ```nc,reported,haas-mill
    /// G0 X0.
    /// M97 P100 L3
    /// G0 Z1.
    /// N100 G91 G1 X.1 F10.
    /// M99
    /// ```
    /// ```nc,reported,fanuc-mill
    /// O0001
    /// IF [#500 EQ 1] GOTO 10
    /// M30
    /// N10 G0 Z100.
    /// O0002
    /// G0 X10.
    /// M99
    /// ```
    /// ## Not reported
    /// ```nc,quiet,haas-mill
    /// G0 X0.
    /// M97 P100 L3
    /// M30
    /// N100 G91 G1 X.1 F10.
    /// M99
    /// ```
    /// Two entries of one subprogram.
    /// ```nc,quiet,haas-mill
    /// M97 P100
    /// M97 P200
    /// M30
    /// N100 G0 X1.
    /// N200 G0 Y1.
    /// M99
    /// ```
    rule "fall-into-subprogram" in "flow" {
        summary: "program runs into a subprogram",
        severity: Warning,
        tier: Path,
        since: "0.1.0",
        run: Run::Path { watch: Watch::ALL_BLOCKS, make: || Box::new(FallIntoSubprogram::default()) },
    }
}

#[derive(Default, Clone, PartialEq)]
struct FallIntoSubprogram {
    /// Blocks with a sequence number that local calls name and no jump does; made when first asked for.
    entries: Option<BTreeSet<At>>,
    told: BTreeSet<At>,
}

remembers!(FallIntoSubprogram: entries, told);

impl PathRule for FallIntoSubprogram {
    fn memory(&mut self) -> Remembers<'_> {
        Remembers::All(self)
    }

    fn block(&mut self, cx: &PathCx<'_>, report: &mut Report<'_>) {
        // If `O` does not number programs, a program has no head.
        if cx.file_index.programs.len() < 2 && cx.file_index.jumps.is_empty() {
            cx.enough();
            return;
        }
        let Some(frame) = cx.state().frames().last() else { return };
        if frame.entry.file != 0 || frame.kind == FrameKind::OWord {
            return;
        }
        let entry = match self.entry_above(cx) {
            Some(entry) if !(entry..=cx.origin().at.block).contains(&frame.entry.block) => entry,
            _ => return,
        };
        let is_program =
            cx.program.file(0).is_some_and(|file| file.loaded.flow_graph().part_of(entry).start == entry);
        let came_from_above = match frame.kind {
            FrameKind::Main | FrameKind::Subprogram | FrameKind::Macro => {
                !is_program || frame.entry.block < entry
            }
            FrameKind::Local => is_program && frame.entry.block < entry,
            FrameKind::OWord => false,
        };
        if !came_from_above || !self.told.insert(At { file: 0, block: entry }) {
            return;
        }
        let Some(range) = cx.range_of(At { file: 0, block: entry }) else { return };
        let message = if is_program {
            "program runs into the next program of the file"
        } else {
            "program runs into a subprogram without a call"
        };
        let finding = cx
            .finding(&META, range, message)
            .label("reached from the block above")
            .help("end the program above with `M30` (with `M99` if it is a subprogram), or jump over the subprogram");
        report.add(finding);
    }
}

impl FallIntoSubprogram {
    /// The entry of a subprogram from which execution came straight to this block.
    fn entry_above(&mut self, cx: &PathCx<'_>) -> Option<u32> {
        let block = cx.origin().at.block;
        let entries = self.entries.get_or_insert_with(|| entries(cx));
        let entry = entries.range(..=At { file: 0, block }).next_back()?.block;
        let file = cx.program.file(0)?;
        // Execution may have left the straight run, so later blocks do not show how the subprogram was entered.
        (block <= file.loaded.flow_graph().straight_from(entry).end.max(entry)).then_some(entry)
    }
}

fn entries(cx: &PathCx<'_>) -> BTreeSet<At> {
    let Some(file) = cx.program.file(0) else { return BTreeSet::new() };
    let graph = file.loaded.flow_graph();
    let is_call = |code| cx.model.effect(code) == Effect::CallLocal;
    let mut entries = BTreeSet::new();
    for jump in &cx.file_index.jumps {
        let Some(number) = jump.target.filter(|_| is_call(jump.code)) else { continue };
        let is_also_jumped_to = cx
            .file_index
            .jumps
            .iter()
            .any(|other| other.target.is_none_or(|n| n == number) && !is_call(other.code));
        let mut blocks = graph.labels(number);
        if let (Some(block), None, false) = (blocks.next(), blocks.next(), is_also_jumped_to) {
            entries.insert(At { file: 0, block });
        }
    }
    if cx.control().syntax().program_number && !cx.control().syntax().o_words {
        for part in graph.programs().skip(1) {
            let above = part.blocks.start.checked_sub(1).map_or(0..0, |block| graph.part_of(block));
            // Another rule reports a program without any end.
            let bytes = |block: u32| cx.range_of(At { file: 0, block }).map_or(u32::MAX, |range| range.start);
            let (from, to) = (bytes(above.start), bytes(part.blocks.start));
            let has_end = cx.file_index.ends.iter().any(|end| {
                matches!(end.ends, Ends::Program | Ends::Subprogram) && (from..to).contains(&end.range.start)
            });
            if has_end && part.number.is_some() {
                entries.insert(At { file: 0, block: part.blocks.start });
            }
        }
    }
    entries
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::check_rule;

    #[test]
    fn the_entry_is_marked() {
        check_rule(
            &RULE,
            "haas-mill",
            "M97 P100\nG0 Z1.\nN100 (SLOT)\nG91 G1 X.1 F10.\nM99\n",
            &expect![[r#"
                3 | N100 (SLOT)
                  | ^^^^^^^^^^^ warning[fall-into-subprogram] program runs into a subprogram without a call
            "#]],
        );
        check_rule(
            &RULE,
            "fanuc-mill",
            "O1\nM98 P2\nGOTO 5\nM30\nN5 G0 X1.\nO2\nG0 X2.\nM99\n",
            &expect![[r#"
                6 | O2
                  | ^^ warning[fall-into-subprogram] program runs into the next program of the file
            "#]],
        );
    }

    #[test]
    fn a_number_that_a_jump_names_too_is_no_entry() {
        check_rule(
            &RULE,
            "haas-mill",
            "M97 P100\nIF [#500 EQ 1] GOTO 100\nM30\nN100 G0 X1.\nM99\n",
            &expect![[""]],
        );
    }

    #[test]
    fn a_program_without_any_end_is_told_elsewhere() {
        check_rule(&RULE, "fanuc-mill", "O1\nG0 X1.\nO2\nG0 X2.\nM30\n", &expect![[""]]);
    }

    #[test]
    fn a_called_subprogram_may_call_on() {
        check_rule(
            &RULE,
            "haas-mill",
            "O1\nM98 P2\nM30\nO2\nM97 P10\nG0 X1.\nM99\nN10 G0 Y1.\nM99\n",
            &expect![[""]],
        );
    }
}
