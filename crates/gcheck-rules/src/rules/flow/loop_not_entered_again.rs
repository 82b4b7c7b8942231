//! A loop that runs the first time, and is left at once every later time, because its counter is not set back.

use gcheck_engine::At;
use gcheck_program::{BinaryOp, BlockFlags, Op, StatementKind};

use crate::declare::declare_rule;
use crate::facts::loop_conditions::{Asked, loop_at};
use crate::{PathCx, PathRule, Remembers, Report, Run, Uses, Watch, remembers};

declare_rule! {
    /// A loop has run to its end, the program comes to it again, and the variables of its condition still have the values with which it was
    /// left: it is not entered.
    ///
    /// A loop that runs once is a way to write a condition, and is not judged; neither are loops in subprograms, loops that end at one value
    /// (`NE`), and those made of `IF` and `GOTO`.
    ///
    /// ## Why it matters
    /// The second row of a pattern, or the second part, is left out without a word. The counter is set before the outer loop,
    /// where it belongs inside it.
    ///
    /// ## Reported
    /// ```nc,reported,fanuc-mill
    /// #101=0
    /// #102=0
    /// WHILE [#101 LT 2] DO1
    /// WHILE [#102 LT 3] DO2
    /// G0 X[#102*10.] Y[#101*10.]
    /// #102=#102+1
    /// END2
    /// #101=#101+1
    /// END1
    /// M30
    /// ```
    /// ## Not reported
    /// ```nc,quiet,fanuc-mill
    /// #101=0
    /// WHILE [#101 LT 2] DO1
    /// #102=0
    /// WHILE [#102 LT 3] DO2
    /// G0 X[#102*10.] Y[#101*10.]
    /// #102=#102+1
    /// END2
    /// #101=#101+1
    /// END1
    /// M30
    /// ```
    rule "loop-not-entered-again" in "flow" {
        summary: "loop that is skipped the second time",
        severity: Warning,
        tier: Path,
        since: "0.1.0",
        run: Run::Path { watch: Watch::ALL_BLOCKS, make: || Box::new(LoopNotEnteredAgain::default()) },
    }
}

#[derive(Default, Clone, PartialEq)]
struct LoopNotEnteredAgain {
    loops: Vec<Loop>,
    /// The loop whose condition was tested last, if no block has come since.
    tested: Option<At>,
    /// The block before.
    before: Option<At>,
}

remembers!(LoopNotEnteredAgain: loops, tested, before);

/// What is known of a loop.
#[derive(Clone, PartialEq)]
struct Loop {
    /// The blocks that begin and end it.
    head: At,
    end: At,
    /// What its condition asks.
    asked: Asked,
    /// Iterations since the program came to the loop.
    turns: u32,
    /// Its condition has ended it.
    is_left: bool,
    /// A block outside has set what the condition asks, since the loop was left.
    is_set: bool,
    is_told: bool,
}

remembers!(Loop: head, end);

/// A loop that runs fewer times may be a condition.
const FEWEST: u32 = 2;
/// Loops that are looked at.
const MOST: usize = 64;

impl PathRule for LoopNotEnteredAgain {
    fn memory(&mut self) -> Remembers<'_> {
        Remembers::All(self)
    }

    fn concerns(&self, program: &Uses<'_>) -> bool {
        !program.file_index.loops.is_empty() || !program.file_index.o_words.is_empty()
    }

    fn block(&mut self, cx: &PathCx<'_>, report: &mut Report<'_>) {
        let at = cx.origin().at;
        let before = self.before.replace(at);
        // What comes after a test tells how it ended.
        if let Some(head) = self.tested.take()
            && let Some(known) = self.loops.iter_mut().find(|known| known.head == head)
        {
            known.is_left = !known.contains(at);
        }
        if !cx.origin().flags.contains(BlockFlags::STATEMENT) {
            return;
        }
        self.set(cx);
        // In a subprogram each call may have variables of its own.
        if cx.depth() > 1 {
            return;
        }
        if !self.loops.iter().any(|known| known.head == at) {
            let Some(new) = begun(cx).filter(|_| self.loops.len() < MOST) else { return };
            self.loops.push(new);
        }
        let Some(known) = self.loops.iter_mut().find(|known| known.head == at) else { return };
        self.tested = Some(at);
        if before.is_some_and(|before| known.contains(before)) {
            known.turns += 1;
            return;
        }
        if known.is_left && !known.is_set && known.turns >= FEWEST {
            if !known.is_told && cx.is_certain() {
                known.is_told = true;
                report.add(
                    cx.finding(&META, cx.range(), "the loop is not entered the second time")
                        .label("nothing has set the variables of its condition since it ended")
                        .note(format!("the first time it ran {} times", known.turns))
                        .help("set the counter back right before the loop"),
                );
            }
            return;
        }
        (known.turns, known.is_set) = (0, false);
    }
}

impl LoopNotEnteredAgain {
    /// Notes what the block sets.
    fn set(&mut self, cx: &PathCx<'_>) {
        let at = cx.origin().at;
        let Some(place) = cx.place() else { return };
        let Some(file) = cx.program.file(at.file) else { return };
        let text = file.loaded.chunk_text(place.chunk);
        for statement in place.table.statements(place.ix) {
            let StatementKind::Assign { target, .. } = &statement.kind else { continue };
            for known in &mut self.loops {
                known.is_set |= !known.contains(at) && known.asked.is_set_by(target, text);
            }
        }
    }
}

impl Loop {
    /// Is the block in it, its end included?
    fn contains(&self, at: At) -> bool {
        at.file == self.head.file && (self.head.block + 1..=self.end.block).contains(&at.block)
    }
}

/// The loop that begins in this block with a comparison.
fn begun(cx: &PathCx<'_>) -> Option<Loop> {
    let at = cx.origin().at;
    let place = cx.place()?;
    let file = cx.program.file(at.file)?;
    let (condition, end) = loop_at(file.loaded.flow_graph(), at, &place)?;
    let is_comparison = |op: &Op| {
        use BinaryOp::{Greater, GreaterEqual, Less, LessEqual};
        matches!(op, Op::Binary(Greater | GreaterEqual | Less | LessEqual))
    };
    let compares = place.table.ops(place.table.expr(condition)).iter().any(is_comparison);
    let asked = Asked::of(cx.control(), cx.model, &place, condition, file.loaded.chunk_text(place.chunk));
    let asked = asked.filter(|_| compares)?;
    Some(Loop {
        head: at,
        end: At { block: end, ..at },
        asked,
        turns: 0,
        is_left: false,
        is_set: false,
        is_told: false,
    })
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::check_rule;

    fn pattern(outside: &str, inside: &str) -> String {
        format!(
            "#<row> = 0\n{outside}o100 while [#<row> LT 2]\n{inside}o110 while [#<column> LT 3]\nG0 X[#<column> * 10] Y[#<row> * 10]\n#<column> = [#<column> + 1]\no110 endwhile\n#<row> = [#<row> + 1]\no100 endwhile\nM2\n"
        )
    }

    #[test]
    fn a_counter_is_set_before_the_outer_loop() {
        check_rule(&RULE, "linuxcnc", &pattern("", "#<column> = 0\n"), &expect![[""]]);
        check_rule(
            &RULE,
            "linuxcnc",
            &pattern("#<column> = 0\n", ""),
            &expect![[r#"
            4 | o110 while [#<column> LT 3]
              | ^^^^^^^^^^^^^^^^^^^^^^^^^^^ warning[loop-not-entered-again] the loop is not entered the second time
        "#]],
        );
    }

    #[test]
    fn a_loop_that_runs_once_is_a_condition() {
        check_rule(
            &RULE,
            "fanuc-mill",
            "#101=0\n#102=0\nWHILE [#101 LT 3] DO1\nWHILE [#102 LT 1] DO2\nG0 Z5.\n#102=1\nEND2\n#101=#101+1\nEND1\nM30\n",
            &expect![[""]],
        );
    }
}
