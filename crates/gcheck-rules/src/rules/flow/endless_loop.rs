//! A loop that never ends.

use gcheck_controls::Effect;
use gcheck_engine::At;

use crate::declare::declare_rule;
use crate::facts::probing::probes;
use crate::{PathCx, PathRule, Report, Run, Watch};

declare_rule! {
    /// Execution returns to a block with everything as it was before: positions, modes, variables. It repeats the same
    /// forever.
    ///
    /// ## Why it matters
    /// The machine cuts the same pass until the operator presses reset. Often the counter of the loop is never
    /// incremented.
    ///
    /// ## Reported
    /// ```nc,reported,fanuc-mill
    /// O0001
    /// #1=0
    /// WHILE [#1 LT 5] DO1
    /// G0 X10.
    /// G0 X0.
    /// END1
    /// M30
    /// ```
    /// ```nc,reported,haas-mill
    /// N10 G0 X1.
    /// G0 X0.
    /// GOTO 10
    /// M30
    /// ```
    /// ## Not reported
    /// `M99` that starts the program again, a loop in which the program stops for the operator, and a loop whose
    /// iterations differ.
    /// ```nc,quiet,haas-mill
    /// N10 G0 X1.
    /// M0
    /// GOTO 10
    /// ```
    /// ```nc,quiet,fanuc-mill
    /// #1=0
    /// WHILE [#1 LT 5] DO1
    /// #1=#1+1
    /// END1
    /// M30
    /// ```
    rule "endless-loop" in "flow" {
        summary: "loop that never ends",
        severity: Warning,
        tier: Path,
        since: "0.1.0",
        run: Run::Path { watch: Watch::ENDLESS, make: || Box::new(EndlessLoop) },
    }
}

struct EndlessLoop;

impl PathRule for EndlessLoop {
    /// A condition that leads out of the loop is the way to end it.
    fn counts_on_some_path(&self) -> bool {
        false
    }

    fn endless(&mut self, cx: &PathCx<'_>, head: At, report: &mut Report<'_>) {
        let turn = cx.origin().at;
        if waits_for_somebody(cx, head, turn) {
            return;
        }
        let Some(range) = cx.range_of(head) else { return };
        let mut finding = cx
            .finding(&META, range, "loop never ends")
            .label("every iteration begins in the same state")
            .help("change a variable of the loop's condition inside the loop, for good, or give the loop an exit");
        if turn != head
            && let Some(range) = cx.range_of(turn)
        {
            finding = finding.also(range, "jumps back to here");
        }
        report.add(finding);
    }
}

/// A stop for the operator or an input inside the loop, or a return that starts the program again.
fn waits_for_somebody(cx: &PathCx<'_>, head: At, turn: At) -> bool {
    let has = |block: u32, is: &dyn Fn(Effect) -> bool| {
        let Some(place) = cx.place_of(At { file: head.file, block }) else { return false };
        place.table.words(place.block()).iter().any(|word| is(cx.model.effect(word.code)))
    };
    let waits = |effect: Effect| {
        probes(effect)
            || effect.stops_program()
            || matches!(effect, Effect::BarFeed | Effect::WaitForInput | Effect::AskOperator)
    };
    let calls = |effect: Effect| effect.calls() || effect == Effect::MacroModal;
    let mut blocks = head.block..turn.block.saturating_add(1);
    if has(turn.block, &|effect| effect == Effect::Return) {
        // `M99 P10` in the main program; a return to the block after a call belongs to some larger loop.
        if !has(head.block.saturating_sub(1), &calls) {
            return true;
        }
        if let Some(file) = cx.program.file(head.file) {
            blocks = file.loaded.flow_graph().part_of(head.block);
        }
    }
    blocks.take(20_000).any(|block| has(block, &waits))
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::check_rule;

    #[test]
    fn the_head_is_marked() {
        check_rule(
            &RULE,
            "fanuc-mill",
            "O1\n#1=0\nWHILE [#1 LT 5] DO1\nG0 X1.\nEND1\nM30\n",
            &expect![[r#"
            3 | WHILE [#1 LT 5] DO1
              | ^^^^^^^^^^^^^^^^^^^ warning[endless-loop] loop never ends
        "#]],
        );
        check_rule(
            &RULE,
            "linuxcnc",
            "#1=0\no1 while [#1 LT 5]\nG0 X1\no1 endwhile\nM2\n",
            &expect![[r#"
            2 | o1 while [#1 LT 5]
              | ^^^^^^^^^^^^^^^^^^ warning[endless-loop] loop never ends
        "#]],
        );
        check_rule(
            &RULE,
            "linuxcnc",
            "o1 do\nG0 X1\no1 while [1]\nM2\n",
            &expect![[r#"
            2 | G0 X1
              | ^^^^^ warning[endless-loop] loop never ends
        "#]],
        );
    }

    #[test]
    fn a_return_that_starts_the_program_again_is_no_loop() {
        check_rule(&RULE, "haas-mill", "N10 G0 X1.\nM99\n", &expect![[""]]);
        check_rule(&RULE, "haas-mill", "N10 G0 X1.\nM99 P10\n", &expect![[""]]);
    }

    #[test]
    fn a_loop_around_a_call_is_told_where_the_call_comes_back() {
        check_rule(
            &RULE,
            "haas-mill",
            "N10 G0 X1.\nM97 P100\nG0 X2.\nGOTO 10\nM30\nN100 G0 X0.\nM99\n",
            &expect![[r#"
            3 | G0 X2.
              | ^^^^^^ warning[endless-loop] loop never ends
        "#]],
        );
    }

    #[test]
    fn two_states_that_take_turns_are_found() {
        check_rule(
            &RULE,
            "fanuc-mill",
            "O1\n#1=1\nN10 #1=0-#1\nG0 X#1\nGOTO 10\nM30\n",
            &expect![[r#"
            3 | N10 #1=0-#1
              | ^^^^^^^^^^^ warning[endless-loop] loop never ends
        "#]],
        );
    }

    #[test]
    fn what_the_program_does_not_set_may_end_the_loop() {
        check_rule(&RULE, "fanuc-mill", "O1\nWHILE [#500 LT 5] DO1\nG0 X1.\nEND1\nM30\n", &expect![[""]]);
    }
}
