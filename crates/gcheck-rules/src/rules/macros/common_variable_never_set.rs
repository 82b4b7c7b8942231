//! A common variable that the program uses and does not set.

use std::collections::HashSet;
use std::ops::Range;

use gcheck_controls::{Unset, Variable, VariableEntry, VariableKind};
use gcheck_program::{BinaryOp, Op, Place, StatementKind, Target, Value};

use super::maybe_variable_unset::tested;
use crate::memory::{Remembers, remembers};
use crate::meta::declare_rule;
use crate::usage::is_called_from_elsewhere;
use crate::{PathCx, PathRule, Report, Run, Uses, Watch};

declare_rule! {
    /// A common variable is computed with, or moves an axis, and no block on the way here sets it.
    ///
    /// ## Why it matters
    /// It holds what the last program left there, or nothing. If the line that set it is lost, the program goes where another
    /// job sent it. A value that somebody enters by hand before the start is worth a remark in the program.
    ///
    /// ## Reported
    /// ```nc,reported,fanuc-mill
    /// O0001
    /// #101=50.
    /// G0 X#101 Y#102
    /// M30
    /// ```
    /// ## Not reported
    /// A switch that the operator sets, a counter that goes on from job to job, and a test for nothing:
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
    told: HashSet<u32>,
    /// Variables that the program asks whether they hold nothing; made when first asked for.
    tested: Option<HashSet<u32>>,
}

remembers!(CommonVariableNeverSet);

impl PathRule for CommonVariableNeverSet {
    fn memory(&mut self) -> Remembers<'_> {
        Remembers::All(self)
    }

    fn concerns(&self, program: &Uses<'_>) -> bool {
        program.scene.control().semantics().unset == Unset::Vacant
            && !is_called_from_elsewhere(program.survey)
            && !program.survey.has_mistakes
    }

    fn block(&mut self, cx: &PathCx<'_>, report: &mut Report<'_>) {
        let Some((table, expressions)) = cx.expressions().filter(|(_, found)| !found.is_empty()) else {
            return;
        };
        for expr in expressions.iter() {
            for op in table.ops(table.expr(*expr)) {
                let Op::Variable(variable) = *op else { continue };
                let Variable::Known(entry) = cx.scene.control().variable(variable) else { continue };
                if cx.state().variables().is_written(variable)
                    || self.told.contains(&variable)
                    || !SCRATCH.contains(&variable)
                    || !belongs_to_the_program(cx, entry)
                {
                    continue;
                }
                let Some(range) = cx.place().and_then(|place| use_of(&place, variable)) else { continue };
                self.told.insert(variable);
                if self.tested.get_or_insert_with(|| tested(cx)).contains(&variable) {
                    continue;
                }
                let keeps = match entry.kind {
                    VariableKind::Common => "it holds nothing after power-on, else what the last program left",
                    _ => "it holds what was left there, also over power off",
                };
                report.add(
                    cx.finding(&META, range, format!("`#{variable}` is used here and nothing before sets it"))
                        .label("holds what was left there, or nothing")
                        .note(format!("{}: {keeps}  [{}]", entry.title, entry.source))
                        .help(format!("set `#{variable}` at the head of the program, or say in a remark who does")),
                );
            }
        }
    }
}

/// What programs compute with, by the custom of all macro controls; variables behind are set up once.
const SCRATCH: std::ops::RangeInclusive<u32> = 100..=199;

/// Is the variable for the program to set? One that survives power off may be set up once; but not where the program
/// sets its neighbours itself.
fn belongs_to_the_program(cx: &PathCx<'_>, entry: &VariableEntry) -> bool {
    let Some([first, last]) = entry.range else { return false };
    match entry.kind {
        VariableKind::Common => true,
        VariableKind::Retained => {
            cx.survey.assigned.iter().any(|(number, _)| (first..=last).contains(number))
        }
        VariableKind::Local | VariableKind::System => false,
    }
}

/// Bytes of the word or statement that uses the value of a variable. A condition that jumps, and a count that goes on from
/// what was there, use it on purpose.
fn use_of(place: &Place, variable: u32) -> Option<Range<u32>> {
    let in_file = |range: Range<u32>| place.base + range.start..place.base + range.end;
    let ops = |expr| place.table.ops(place.table.expr(expr));
    for word in place.table.words(place.block()) {
        if let Value::Expr(expr) = word.value
            && ops(expr).contains(&Op::Variable(variable))
        {
            return Some(in_file(word.range()));
        }
    }
    for statement in place.table.statements(place.ix) {
        let is_switch = matches!(statement.kind, StatementKind::If { .. } | StatementKind::Guard { .. });
        let reads = |expr| ops(expr).contains(&Op::Variable(variable));
        let counts = matches!(&statement.kind, StatementKind::Assign { target: Target::Variable(to), .. } if *to == variable)
            && statement.kind.expressions().any(|expr| {
                ops(expr).iter().any(|op| matches!(op, Op::Binary(BinaryOp::Add | BinaryOp::Subtract)))
            });
        if !is_switch && !counts && statement.kind.expressions().any(reads) {
            return Some(in_file(statement.range.clone()));
        }
    }
    None
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::Selection;
    use crate::testing::{World, check_rule, findings, words};

    #[test]
    fn the_first_use_of_each_variable_is_marked() {
        check_rule(
            &RULE,
            "fanuc-mill",
            "O1\n#100=1\nG0 X#101\nY[#101+#102]\nWHILE [#103 LT 5] DO1\n#103=#103+1\nEND1\nM30\n",
            &expect![[r#"
                3 | G0 X#101
                  |    ^^^^^ info[common-variable-never-set] `#101` is used here and nothing before sets it
                4 | Y[#101+#102]
                  | ^^^^^^^^^^^^ info[common-variable-never-set] `#102` is used here and nothing before sets it
                5 | WHILE [#103 LT 5] DO1
                  | ^^^^^^^^^^^^^^^^^^^^^ info[common-variable-never-set] `#103` is used here and nothing before sets it
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
        check_rule(&RULE, "haas-mill", "O1\n#102= 3.\nG0 X#101 Y#102\nM30\n", &expect![[r#"
            3 | G0 X#101 Y#102
              |    ^^^^^ info[common-variable-never-set] `#101` is used here and nothing before sets it
        "#]]);
    }

    #[test]
    fn words_say_how_long_the_variable_lives() {
        let found =
            findings(&Selection::only(&RULE), "fanuc-mill", "O1\nG0 X#101\nM30\n", &World::default());
        expect![[r#"
            `#101` is used here and nothing before sets it
              here: holds what was left there, or nothing
              note: common variables, emptied at power-off: it holds nothing after power-on, else what the last program left  [MACRO-B]
              help: set `#101` at the head of the program, or say in a remark who does
        "#]].assert_eq(&words(&found[0]));
    }
}
