//! A common variable that the program uses and does not set.

use std::collections::HashSet;
use std::ops::Range;

use gcheck_controls::{Unset, Variable, VariableEntry, VariableKind};
use gcheck_program::{BinaryOp, BlockFlags, Op, Place, StatementKind, Target, Value};

use crate::declare::declare_rule;
use crate::{PathCx, PathRule, Report, Run, Uses, Watch};
use crate::{Remembers, remembers};

declare_rule! {
    /// A common variable is used in a calculation or moves an axis, and no earlier block on this path sets it.
    ///
    /// ## Why it matters
    /// It holds what the last program left there, or nothing. If the line that set it is lost, the program uses the
    /// value of another job. If the operator enters the value before the start, say so in a comment in the program.
    ///
    /// ## Reported
    /// ```nc,reported,fanuc-mill
    /// O0001
    /// #101=50.
    /// G0 X#101 Y#102
    /// M30
    /// ```
    /// ## Not reported
    /// A switch that the operator sets, a counter that continues from job to job, and a test for null:
    /// ```nc,quiet,fanuc-mill
    /// O0001
    /// IF [#101 EQ 1] GOTO 10
    /// N10 #102=#102+1
    /// IF [#103 EQ #0] THEN #103=5.
    /// G0 X#103
    /// M30
    /// ```
    rule "common-variable-never-set" in "macros" {
        summary: "common variable that is used and never set",
        severity: Info,
        tier: Path,
        since: "0.1.0",
        run: Run::Path { watch: Watch::ALL_BLOCKS, make: || Box::new(CommonVariableNeverSet::default()) },
    }
}

#[derive(Default, Clone, PartialEq)]
struct CommonVariableNeverSet {
    /// Configured, or tested by a condition before use: a variable that the program tests is set elsewhere.
    known: HashSet<u32>,
}

remembers!(CommonVariableNeverSet);

impl PathRule for CommonVariableNeverSet {
    fn memory(&mut self) -> Remembers<'_> {
        Remembers::All(self)
    }

    fn concerns(&self, program: &Uses<'_>) -> bool {
        program.environment.control().semantics().unset == Unset::Vacant
            && !program.file_index.is_called_from_elsewhere()
    }

    fn block(&mut self, cx: &PathCx<'_>, report: &mut Report<'_>) {
        if !cx.origin().flags.intersects(BlockFlags::EXPRESSION | BlockFlags::STATEMENT) {
            return;
        }
        // Most blocks of a loop read counters of their own.
        let Some((table, expressions)) = cx.expressions() else { return };
        let is_scratch = |op: &Op| matches!(op, Op::Variable(number) if SCRATCH.contains(number));
        if !expressions.iter().any(|expr| table.ops(table.expr(*expr)).iter().any(is_scratch)) {
            return;
        }
        let Some(place) = cx.place() else { return };
        for (variable, how) in uses(&place) {
            let is_known = self.known.contains(&variable) || cx.state().variables().is_written(variable);
            if is_known || !SCRATCH.contains(&variable) {
                continue;
            }
            let Variable::Known(entry) = cx.control().variable(variable) else { continue };
            if !belongs_to_the_program(cx, entry) {
                continue;
            }
            self.known.insert(variable);
            if let Use::Value(range) = how {
                let keeps = match entry.kind {
                    VariableKind::Common => {
                        "it is null after power-on, else it holds what the last program left"
                    }
                    _ => "it keeps its value, also when the power is off",
                };
                report.add(
                    cx.finding(
                        &META,
                        range,
                        format!("`#{variable}` is used here, and no earlier block sets it"),
                    )
                    .label("holds what an earlier program left there, or nothing")
                    .note(format!("{}: {keeps}  [{}]", entry.title, entry.source))
                    .help(format!(
                        "set `#{variable}` at the head of the program, or say in a comment what sets it"
                    )),
                );
            }
        }
    }
}

/// Programs compute with these, by the custom of all macro controls; the variables after them are set up once.
const SCRATCH: std::ops::RangeInclusive<u32> = 100..=199;

/// Should the program set the variable? One that survives power off may be set up once, unless the program sets its
/// neighbours itself.
fn belongs_to_the_program(cx: &PathCx<'_>, entry: &VariableEntry) -> bool {
    let Some([first, last]) = entry.range else { return false };
    match entry.kind {
        VariableKind::Common => true,
        VariableKind::Retained => (first..=last).any(|number| cx.state().variables().is_written(number)),
        VariableKind::Local | VariableKind::System => false,
    }
}

/// How a block uses a variable.
enum Use {
    /// For its value: bytes of the word or statement.
    Value(Range<u32>),
    /// In a condition, or to count on from its old value: deliberate.
    Looked,
}

/// The variables that a block reads, words first.
fn uses(place: &Place) -> Vec<(u32, Use)> {
    let in_file = |range: Range<u32>| place.base + range.start..place.base + range.end;
    let ops = |expr| place.table.ops(place.table.expr(expr));
    let variables = |expr| {
        ops(expr).iter().filter_map(|op| match op {
            Op::Variable(number) => Some(*number),
            _ => None,
        })
    };
    let mut found = Vec::new();
    for word in place.table.words(place.block()) {
        if let Value::Expr(expr) = word.value {
            found.extend(variables(expr).map(|variable| (variable, Use::Value(in_file(word.range())))));
        }
    }
    for statement in place.table.statements(place.ix) {
        let is_switch = matches!(statement.kind, StatementKind::If { .. } | StatementKind::Guard { .. });
        let target = match statement.kind {
            StatementKind::Assign { target: Target::Variable(to), .. } => Some(to),
            _ => None,
        };
        for expr in statement.kind.expressions() {
            let is_tested = is_switch || ops(expr).contains(&Op::Variable(0));
            let is_sum =
                ops(expr).iter().any(|op| matches!(op, Op::Binary(BinaryOp::Add | BinaryOp::Subtract)));
            for variable in variables(expr) {
                let counts = is_sum && target == Some(variable);
                let how = if is_tested || counts {
                    Use::Looked
                } else {
                    Use::Value(in_file(statement.range.clone()))
                };
                found.push((variable, how));
            }
        }
    }
    found
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::{World, check_rule, findings, only, words};

    #[test]
    fn the_first_use_of_each_variable_is_marked() {
        check_rule(
            &RULE,
            "fanuc-mill",
            "O1\n#100=1\nG0 X#101\nY[#101+#102]\nWHILE [#103 LT 5] DO1\n#103=#103+1\nEND1\nM30\n",
            &expect![[r#"
                3 | G0 X#101
                  |    ^^^^^ info[common-variable-never-set] `#101` is used here, and no earlier block sets it
                4 | Y[#101+#102]
                  | ^^^^^^^^^^^^ info[common-variable-never-set] `#102` is used here, and no earlier block sets it
                5 | WHILE [#103 LT 5] DO1
                  | ^^^^^^^^^^^^^^^^^^^^^ info[common-variable-never-set] `#103` is used here, and no earlier block sets it
            "#]],
        );
    }

    #[test]
    fn what_is_set_on_some_way_or_by_a_program_that_is_not_here() {
        check_rule(
            &RULE,
            "fanuc-mill",
            "O1\nIF [#500 EQ 1] GOTO 10\n#101=5.\nN10 G0 X#101\nM98 P9000\nX#102\nM30\n",
            &expect![[""]],
        );
        check_rule(&RULE, "fanuc-mill", "O9000\nG0 X#101\nM99\n", &expect![[""]]);
        check_rule(&RULE, "fanuc-mill", "O1\n#[#500]=5.\nG0 X#101\nM30\n", &expect![[""]]);
    }

    #[test]
    fn what_survives_power_off_may_be_set_up_once() {
        check_rule(&RULE, "haas-mill", "O1\nG0 X#101\nM30\n", &expect![[""]]);
        check_rule(&RULE, "fanuc-mill", "O1\n#502=3.\nG0 X#501 Y#502\nM30\n", &expect![[""]]);
        check_rule(
            &RULE,
            "haas-mill",
            "O1\n#102= 3.\nG0 X#101 Y#102\nM30\n",
            &expect![[r#"
                3 | G0 X#101 Y#102
                  |    ^^^^^ info[common-variable-never-set] `#101` is used here, and no earlier block sets it
            "#]],
        );
    }

    #[test]
    fn words_say_how_long_the_variable_lives() {
        let found = findings(&only(&RULE), "fanuc-mill", "O1\nG0 X#101\nM30\n", &World::default());
        expect![[r#"
            `#101` is used here, and no earlier block sets it
              here: holds what an earlier program left there, or nothing
              note: common variables, emptied at power-off: it is null after power-on, else it holds what the last program left  [MACRO-B]
              help: set `#101` at the head of the program, or say in a comment what sets it
        "#]].assert_eq(&words(&found[0]));
    }
}
