//! A local variable that may be read before it is set.

use std::collections::HashSet;

use gcheck_controls::Unset;
use gcheck_engine::{Abstract, AbstractValue, Domain, FrameKind, Truth};
use gcheck_program::{BlockFlags, Op};

use crate::declare::declare_rule;
use crate::facts::usage::blocks_with;
use crate::{PathCx, PathRule, Report, Run, Uses, Watch};
use crate::{Remembers, remembers};

declare_rule! {
    /// A local variable is read, and only some paths to this block set it.
    ///
    /// ## Why it matters
    /// On the other paths it is null: it counts as zero in arithmetic, and the control ignores a word with it.
    ///
    /// ## Reported
    /// ```nc,reported,fanuc-mill
    /// O0001
    /// IF [#500 EQ 1] GOTO 10
    /// #1=5.
    /// N10 G0 X#1
    /// M30
    /// ```
    /// ## Not reported
    /// ```nc,quiet,fanuc-mill
    /// O0001
    /// #1=0
    /// IF [#500 EQ 1] GOTO 10
    /// #1=5.
    /// N10 G0 X#1
    /// M30
    /// ```
    rule "maybe-variable-unset" in "macros" {
        summary: "variable that some paths do not set",
        severity: Info,
        tier: Path,
        since: "0.1.0",
        run: Run::Path { watch: Watch::ALL_BLOCKS, make: || Box::new(MaybeVariableUnset::default()) },
    }
}

#[derive(Default, Clone, PartialEq)]
struct MaybeVariableUnset {
    told: HashSet<u32>,
    /// Variables that the program tests for null; filled when first needed.
    tested: Option<HashSet<u32>>,
}

remembers!(MaybeVariableUnset);

impl PathRule for MaybeVariableUnset {
    fn memory(&mut self) -> Remembers<'_> {
        Remembers::All(self)
    }

    fn concerns(&self, program: &Uses<'_>) -> bool {
        program.environment.control().semantics().unset == Unset::Vacant
    }

    fn block(&mut self, cx: &PathCx<'_>, report: &mut Report<'_>) {
        if !cx.origin().flags.intersects(BlockFlags::EXPRESSION | BlockFlags::STATEMENT) {
            return;
        }
        // Arguments of a macro may be missing on purpose.
        if cx
            .state()
            .frames()
            .iter()
            .any(|frame| frame.kind != FrameKind::Main && frame.kind != FrameKind::Local)
            || cx.file_index.is_called_from_elsewhere()
        {
            return;
        }
        let Some((table, expressions)) = cx.expressions() else { return };
        for expr in expressions.iter() {
            let expr = table.expr(*expr);
            let ops = table.ops(expr);
            // Compared with null.
            if ops.contains(&Op::Variable(0)) {
                continue;
            }
            for op in ops {
                let Op::Variable(variable) = op else { continue };
                let Some(value) = cx.state().local(*variable) else { continue };
                let may_be_unset =
                    Abstract::is_vacant(value) == Truth::Unknown && *value != AbstractValue::Unknown;
                if !may_be_unset || !self.told.insert(*variable) {
                    continue;
                }
                if self.tested.get_or_insert_with(|| tested(cx)).contains(variable) {
                    continue;
                }
                let Some(base) = cx.place().map(|place| place.base) else { continue };
                let range = base + expr.range.start..base + expr.range.end;
                let finding = cx
                    .finding(&META, range, format!("variable `#{variable}` may be read before it is set"))
                    .label("holds nothing on some paths to this block")
                    .help(format!("set `#{variable}` before the paths separate"));
                report.add(cx.with_path(finding));
            }
        }
    }
}

/// Variables that an expression compares with `#0`.
fn tested(cx: &PathCx<'_>) -> HashSet<u32> {
    let flags = BlockFlags::EXPRESSION | BlockFlags::STATEMENT;
    let mut tested = HashSet::new();
    for (_, place) in blocks_with(cx.program, cx.environment, flags) {
        for expr in place.expressions() {
            let ops = place.table.ops(place.table.expr(expr));
            if ops.contains(&Op::Variable(0)) {
                tested.extend(ops.iter().filter_map(|op| match op {
                    Op::Variable(number) => Some(*number),
                    _ => None,
                }));
            }
        }
    }
    tested
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::check_rule;

    #[test]
    fn the_expression_is_marked() {
        check_rule(
            &RULE,
            "haas-mill",
            "O1\nIF [#500 EQ 1] THEN #1= 5.\nG0 X#1\nY#1\nM30\n",
            &expect![[r#"
                3 | G0 X#1
                  |     ^^ info[maybe-variable-unset] variable `#1` may be read before it is set
            "#]],
        );
    }

    #[test]
    fn a_test_for_nothing_is_what_the_variable_is_for() {
        check_rule(
            &RULE,
            "haas-mill",
            "O1\nIF [#500 EQ 1] THEN #1= 5.\nIF [#1 EQ #0] THEN #1= 0\nG0 X#1\nM30\n",
            &expect![""],
        );
    }

    #[test]
    fn common_variables_are_not_judged() {
        check_rule(&RULE, "haas-mill", "O1\nIF [#500 EQ 1] THEN #100= 5.\nG0 X#100\nM30\n", &expect![[""]]);
    }
}
