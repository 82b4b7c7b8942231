//! A jump into a loop.

use std::ops::Range;

use gcheck_engine::At;
use gcheck_program::{BlockFlags, StatementKind};

use crate::declare::declare_rule;
use crate::facts::usage::blocks_with;
use crate::{Finding, FinishCx, PathRule, Report, Run, Watch};

declare_rule! {
    /// A `GOTO` outside a loop leads to a block between its `DO` and its `END`.
    ///
    /// ## Why it matters
    /// The loop was never begun: the control stops with an alarm at its `END`, or continues an earlier loop.
    ///
    /// ## Reported
    /// ```nc,reported,fanuc-mill
    /// O0001
    /// GOTO 20
    /// #1=0
    /// WHILE [#1 LT 5] DO1
    /// N20 #1=#1+1
    /// END1
    /// M30
    /// ```
    /// ## Not reported
    /// Out of a loop, or inside it.
    /// ```nc,quiet,fanuc-mill
    /// O0001
    /// #1=0
    /// WHILE [#1 LT 5] DO1
    /// IF [#500 EQ 1] GOTO 20
    /// IF [#500 EQ 2] GOTO 30
    /// G0 X#1
    /// N20 #1=#1+1
    /// END1
    /// N30 M30
    /// ```
    rule "jump-into-loop" in "flow" {
        summary: "jump into a loop",
        severity: Warning,
        tier: Path,
        since: "0.1.0",
        run: Run::Path { watch: Watch::FINISH, make: || Box::new(JumpIntoLoop) },
    }
}

struct JumpIntoLoop;

impl PathRule for JumpIntoLoop {
    fn finish(&mut self, cx: &FinishCx<'_>, report: &mut Report<'_>) {
        if cx.file_index.loops.is_empty() || cx.file_index.jumps.is_empty() {
            return;
        }
        let Some(file) = cx.program.file(0) else { return };
        let graph = file.loaded.flow_graph();
        let mut loops: Vec<Range<u32>> = Vec::new();
        let mut jumps: Vec<(u32, u32, Range<u32>)> = Vec::new();
        let forward = cx.model.semantics().goto_forward_first;
        for (at, place) in blocks_with(cx.program, cx.environment, BlockFlags::STATEMENT) {
            for statement in place.table.statements(place.ix) {
                match &statement.kind {
                    StatementKind::Do { .. } => {
                        loops.extend(graph.end_of(at.block).map(|end| at.block..end + 1));
                    }
                    StatementKind::Goto { target: Some(target) } => {
                        let number = place.table.constant(*target).filter(|n| (0.0..1e9).contains(n));
                        #[expect(clippy::cast_sign_loss, reason = "range checked above")]
                        let to = number.and_then(|n| graph.label(n as u32, at.block, forward));
                        let bytes = place.base + statement.range.start..place.base + statement.range.end;
                        jumps.extend(to.map(|to| (at.block, to, bytes)));
                    }
                    _ => {}
                }
            }
        }
        let outermost = outermost(&loops);
        for (from, to, bytes) in jumps {
            // The outermost loop that the jump enters. Its `DO` itself is a good target.
            let entered = around(&loops, &outermost, to)
                .iter()
                .find(|l| l.contains(&to) && to != l.start && !l.contains(&from));
            if let Some(entered) = entered {
                report.add(finding(cx, bytes, entered.start, to));
            }
        }
    }
}

/// Which of the loops, in the order of the text, are inside no other.
fn outermost(loops: &[Range<u32>]) -> Vec<usize> {
    let mut end = 0;
    let mut found = Vec::new();
    for (index, own) in loops.iter().enumerate().filter(|(_, own)| !own.is_empty()) {
        if own.start >= end {
            found.push(index);
        }
        end = end.max(own.end);
    }
    found
}

/// The loops of the outermost one that may hold a block.
fn around<'l>(loops: &'l [Range<u32>], outermost: &[usize], block: u32) -> &'l [Range<u32>] {
    let begins_after = |index: &usize| loops.get(*index).is_none_or(|own| own.start > block);
    let next = outermost.partition_point(|index| !begins_after(index));
    let first = next.checked_sub(1).and_then(|at| outermost.get(at)).copied();
    let end = outermost.get(next).copied().unwrap_or(loops.len());
    first.and_then(|first| loops.get(first..end)).unwrap_or_default()
}

fn finding(cx: &FinishCx<'_>, range: Range<u32>, head: u32, to: u32) -> Finding {
    let mut finding = Finding::new(&META, range, "jump into a loop")
        .label("leads between `DO` and `END`")
        .note("a branch may lead out of a loop, never into one  [general knowledge]")
        .help("jump to the `DO` of the loop, or to a block outside it");
    for (block, message) in [(head, "the loop begins here"), (to, "the jump leads here")] {
        if let Some(range) = cx.range_of(At { file: 0, block }) {
            finding = finding.also(range, message);
        }
    }
    finding
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::check_rule;

    #[test]
    fn the_jump_is_marked() {
        check_rule(
            &RULE,
            "haas-mill",
            "O1\nIF [#500 EQ 1] GOTO 20\nWHILE [#501 LT 5] DO1\nN20 #501= #501 + 1\nEND1\nM30\n",
            &expect![[r#"
                2 | IF [#500 EQ 1] GOTO 20
                  |                ^^^^^^^ warning[jump-into-loop] jump into a loop
            "#]],
        );
    }

    #[test]
    fn from_one_loop_into_another() {
        check_rule(
            &RULE,
            "fanuc-mill",
            "O1\nWHILE [#501 LT 5] DO1\nGOTO 20\nEND1\nWHILE [#502 LT 5] DO1\nN20 #502=#502+1\nEND1\nM30\n",
            &expect![[r#"
                3 | GOTO 20
                  | ^^^^^^^ warning[jump-into-loop] jump into a loop
            "#]],
        );
    }

    #[test]
    fn loops_inside_others_and_beside_them() {
        check_rule(
            &RULE,
            "fanuc-mill",
            "O1\nGOTO 30\nWHILE [#501 LT 5] DO1\nN10 WHILE [#502 LT 5] DO2\nN20 #502=#502+1\nEND2\nN30 GOTO 20\nEND1\nWHILE [#503 LT 5] DO1\nGOTO 20\nN40 #503=#503+1\nEND1\nGOTO 50\nN50 GOTO 40\nM30\n",
            &expect![[r#"
                2 | GOTO 30
                  | ^^^^^^^ warning[jump-into-loop] jump into a loop
                7 | N30 GOTO 20
                  |     ^^^^^^^ warning[jump-into-loop] jump into a loop
                10 | GOTO 20
                   | ^^^^^^^ warning[jump-into-loop] jump into a loop
                14 | N50 GOTO 40
                   |     ^^^^^^^ warning[jump-into-loop] jump into a loop
            "#]],
        );
    }

    #[test]
    fn the_head_of_a_loop_may_be_jumped_to() {
        check_rule(
            &RULE,
            "fanuc-mill",
            "O1\nN10 WHILE [#501 LT 5] DO1\n#501=#501+1\nEND1\nIF [#502 EQ 1] GOTO 10\nM30\n",
            &expect![[""]],
        );
    }
}
