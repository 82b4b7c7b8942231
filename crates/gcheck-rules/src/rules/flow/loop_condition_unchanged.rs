//! A loop whose condition nothing inside it changes.

use std::collections::HashSet;
use std::ops::Range;

use gcheck_controls::Effect;
use gcheck_engine::At;
use gcheck_program::{BlockFlags, ExprIx, OKeyword, Place, StatementKind, Target};

use crate::declare::declare_rule;
use crate::facts::loop_conditions::{Asked, is_the_machines, loop_at};
use crate::facts::usage::blocks_with;
use crate::{Finding, FinishCx, PathCx, PathRule, Report, Run, Watch};
use crate::{Remembers, remembers};

declare_rule! {
    /// The condition of a loop tests variables that the loop does not set, and nothing else leads out of the loop.
    ///
    /// ## Why it matters
    /// Once entered, the loop never ends: the counter is not incremented, or another variable is incremented in its
    /// place.
    ///
    /// ## Reported
    /// ```nc,reported,fanuc-mill
    /// O0001
    /// WHILE [#500 LT 5] DO1
    /// G0 X#501
    /// #501=#501+1
    /// END1
    /// M30
    /// ```
    /// ```nc,reported,linuxcnc
    /// #<depth> = #100
    /// o1 while [#<depth> GT #101]
    /// G1 Z#<depth> F100
    /// o1 endwhile
    /// M2
    /// ```
    /// ## Not reported
    /// ```nc,quiet,fanuc-mill
    /// O0001
    /// WHILE [#500 LT 5] DO1
    /// #500=#500+1
    /// END1
    /// WHILE [#502 LT 5] DO1
    /// IF [#501 GT 9] GOTO 10
    /// #501=#501+1
    /// END1
    /// N10 M30
    /// ```
    rule "loop-condition-unchanged" in "flow" {
        summary: "loop that does not change its condition",
        severity: Warning,
        tier: Path,
        since: "0.1.0",
        run: Run::Path {
            watch: Watch::ENDLESS.union(Watch::FINISH),
            make: || Box::new(LoopConditionUnchanged::default()),
        },
    }
}

#[derive(Default, Clone, PartialEq)]
struct LoopConditionUnchanged {
    /// Loops that repeat their state: `endless-loop` reports them.
    endless: HashSet<At>,
}

remembers!(LoopConditionUnchanged: endless);

impl PathRule for LoopConditionUnchanged {
    fn memory(&mut self) -> Remembers<'_> {
        Remembers::All(self)
    }

    fn endless(&mut self, _: &PathCx<'_>, head: At, _: &mut Report<'_>) {
        self.endless.insert(head);
    }

    fn finish(&mut self, cx: &FinishCx<'_>, report: &mut Report<'_>) {
        // An answer of the operator may come while the loop waits for it.
        let asks = |place: &Place| {
            let control = cx.environment.control();
            let codes = place.table.words(place.block()).iter().filter_map(|word| control.code_at(word.code));
            codes.into_iter().any(|code| code.effect() == Effect::AskOperator)
        };
        let control = cx.environment.control();
        if control.codes().any(|code| code.effect() == Effect::AskOperator)
            && blocks_with(cx.program, cx.environment, BlockFlags::CODE).any(|(_, place)| asks(&place))
        {
            return;
        }
        for (at, place) in blocks_with(cx.program, cx.environment, BlockFlags::STATEMENT) {
            // Other rules judge a loop that is left before its first iteration, and one that repeats its state.
            if self.endless.contains(&at) || cx.is_never_reached(at.next()) {
                continue;
            }
            let Some(file) = cx.program.file(0) else { return };
            if let Some((condition, end)) = loop_at(file.loaded.flow_graph(), at, &place)
                && is_unchanged(cx, &place, condition, at.block + 1..end)
            {
                report.add(finding(place.range()));
            }
        }
    }
}

/// Do the blocks neither set a variable of the condition nor call, jump or end?
fn is_unchanged(cx: &FinishCx<'_>, place: &Place, condition: ExprIx, body: Range<u32>) -> bool {
    let Some(file) = cx.program.file(0) else { return false };
    let text = file.loaded.chunk_text(place.chunk);
    let Some(asked) = Asked::of(cx.control(), cx.model, place, condition, text) else { return false };
    // A loop of this length is not written by hand.
    if body.len() > 5_000 {
        return false;
    }
    body.into_iter().all(|block| {
        file.loaded
            .place(block, cx.environment.dialect)
            .is_some_and(|place| !may_change(cx, &place, &asked, file.loaded.chunk_text(place.chunk)))
    })
}

fn may_change(cx: &FinishCx<'_>, place: &Place, asked: &Asked, text: &str) -> bool {
    if place.block().flags.intersects(BlockFlags::ERROR | BlockFlags::UNKNOWN_CODE) {
        return true;
    }
    let statement_may = place.table.statements(place.ix).any(|statement| match &statement.kind {
        // An alarm or a stop is an exit; so is what the control does with its own variables.
        StatementKind::Assign { target, .. } => {
            let is_own = matches!(target, Target::Variable(number) if is_the_machines(cx.model, *number));
            is_own || asked.is_set_by(target, text)
        }
        StatementKind::Goto { .. } => true,
        StatementKind::OWord { keyword, .. } => {
            matches!(keyword, OKeyword::Call | OKeyword::Break | OKeyword::Return | OKeyword::EndSub)
        }
        _ => false,
    });
    let word_may = |word: &gcheck_program::Word| {
        let code = cx.control().code_at(word.code);
        let is_user = code.is_some_and(gcheck_controls::Code::is_user);
        let is_computed = !word.code.is_some() && matches!(word.letter.ascii(), b'G' | b'M');
        is_user
            || is_computed
            || matches!(
                cx.model.effect(word.code),
                Effect::CallLocal
                    | Effect::CallProgram
                    | Effect::MacroCall
                    | Effect::MacroModal
                    | Effect::Return
                    | Effect::ProgramEnd
                    | Effect::ProgramEndWithPallet
                    | Effect::JumpUnlessInput
                    | Effect::Stop
                    | Effect::OptionalStop
                    | Effect::UserCommand
            )
    };
    statement_may || place.table.words(place.block()).iter().any(word_may)
}

fn finding(range: Range<u32>) -> Finding {
    Finding::new(&META, range, "loop does not change the variables of its condition")
        .label("nothing inside the loop sets these variables")
        .help("increment the counter inside the loop, or test the variable that the loop sets")
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::check_rule;

    #[test]
    fn the_condition_is_marked() {
        check_rule(
            &RULE,
            "haas-mill",
            "O1\nWHILE [#100 LT 5] DO1\nG0 X1.\nEND1\nM30\n",
            &expect![[r#"
                2 | WHILE [#100 LT 5] DO1
                  | ^^^^^^^^^^^^^^^^^^^^^ warning[loop-condition-unchanged] loop does not change the variables of its condition
            "#]],
        );
    }

    #[test]
    fn ways_out_and_writes_of_any_kind_count() {
        for body in
            ["#100=#100+1", "IF [#1 EQ 2] GOTO 5", "M98 P10", "G65 P10", "#[#2]=1", "M30", "M0", "#3000=1"]
        {
            let program = format!("O1\nWHILE [#100 LT 5] DO1\n{body}\nEND1\nN5 M30\nO10\nM99\n");
            check_rule(&RULE, "fanuc-mill", &program, &expect![[""]]);
        }
    }

    #[test]
    fn what_the_machine_changes_may_end_a_loop() {
        check_rule(&RULE, "fanuc-mill", "WHILE [#3002 LT 5] DO1\nG4 X1.\nEND1\nM30\n", &expect![[""]]);
        check_rule(&RULE, "linuxcnc", "o1 while [#5399 EQ 0]\nG4 P1\no1 endwhile\nM2\n", &expect![[""]]);
    }

    #[test]
    fn a_loop_that_repeats_itself_is_told_elsewhere() {
        check_rule(&RULE, "fanuc-mill", "#1=0\nWHILE [#1 LT 5] DO1\nG0 X1.\nEND1\nM30\n", &expect![""]);
    }

    #[test]
    fn breaks_and_do_loops_are_not_judged() {
        check_rule(
            &RULE,
            "linuxcnc",
            "#<n>=#100\no1 while [#<n> LT 5]\no2 if [#5061 GT 2]\no1 break\no2 endif\no1 endwhile\nM2\n",
            &expect![[""]],
        );
        check_rule(&RULE, "linuxcnc", "o1 do\n#1=[#1+1]\no1 while [#1 LT 5]\nM2\n", &expect![[""]]);
    }
}
