//! A common variable that the program uses and does not set.

use std::collections::HashSet;
use std::ops::Range;

use gcheck_controls::{Unset, Variable, VariableEntry, VariableKind};
use gcheck_program::{BinaryOp, BlockFlags, Op, Place, StatementKind, Target, Value};

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
    /// Told, or asked for by a condition before they are used: what the program looks at, somebody else sets.
    known: HashSet<u32>,
}

remembers!(CommonVariableNeverSet);

impl PathRule for CommonVariableNeverSet {
    fn memory(&mut self) -> Remembers<'_> {
        Remembers::All(self)
    }

    fn concerns(&self, program: &Uses<'_>) -> bool {
        program.scene.control().semantics().unset == Unset::Vacant
            && !is_called_from_elsewhere(program.survey)
    }

    fn block(&mut self, cx: &PathCx<'_>, report: &mut Report<'_>) {
        if !cx.origin().flags.intersects(BlockFlags::EXPRESSION | BlockFlags::STATEMENT) {
            return;
        }
        let Some(place) = cx.place() else { return };
        for (variable, how) in uses(&place) {
            let is_known = self.known.contains(&variable) || cx.state().variables().is_written(variable);
            if is_known || !SCRATCH.contains(&variable) {
                continue;
            }
            let Variable::Known(entry) = cx.scene.control().variable(variable) else { continue };
            if !belongs_to_the_program(cx, entry) {
                continue;
            }
            self.known.insert(variable);
            if let Use::Value(range) = how {
                let keeps = match entry.kind {
                    VariableKind::Common => {
                        "it holds nothing after power-on, else what the last program left"
                    }
                    _ => "it holds what was left there, also over power off",
                };
                report.add(
                    cx.finding(
                        &META,
                        range,
                        format!("`#{variable}` is used here and nothing before sets it"),
                    )
                    .label("holds what was left there, or nothing")
                    .note(format!("{}: {keeps}  [{}]", entry.title, entry.source))
                    .help(format!(
                        "set `#{variable}` at the head of the program, or say in a remark who does"
                    )),
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
        VariableKind::Retained => (first..=last).any(|number| cx.state().variables().is_written(number)),
        VariableKind::Local | VariableKind::System => false,
    }
}

/// How a block uses a variable.
enum Use {
    /// For its value: bytes of the word or statement.
    Value(Range<u32>),
    /// In a condition, or to count on from what was there: on purpose.
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
        check_rule(
            &RULE,
            "haas-mill",
            "O1\n#102= 3.\nG0 X#101 Y#102\nM30\n",
            &expect![[r#"
            3 | G0 X#101 Y#102
              |    ^^^^^ info[common-variable-never-set] `#101` is used here and nothing before sets it
        "#]],
        );
    }

    #[test]
    fn words_say_how_long_the_variable_lives() {
        let found = findings(&Selection::only(&RULE), "fanuc-mill", "O1\nG0 X#101\nM30\n", &World::default());
        expect![[r#"
            `#101` is used here and nothing before sets it
              here: holds what was left there, or nothing
              note: common variables, emptied at power-off: it holds nothing after power-on, else what the last program left  [MACRO-B]
              help: set `#101` at the head of the program, or say in a remark who does
        "#]].assert_eq(&words(&found[0]));
    }
}
