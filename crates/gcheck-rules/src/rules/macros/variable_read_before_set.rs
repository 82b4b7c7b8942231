//! A local variable that is read before it is set.

use std::collections::HashSet;
use std::ops::RangeInclusive;

use gcheck_engine::Ending;
use gcheck_program::{BlockFlags, OKeyword, OLabel, Op, Place, StatementKind, Target};

use crate::declare::declare_rule;
use crate::facts::empty_variables::{Use, argument_of, is_assigned_before, is_in_macro, usage};
use crate::facts::usage::blocks_with;
use crate::{PathCx, PathRule, Report, Run, Severity, Watch};
use crate::{Remembers, remembers};

declare_rule! {
    /// A local variable is used, and no block on this path has set it: neither the program nor, in a macro, the call.
    ///
    /// ## Why it matters
    /// It is null. In arithmetic null counts as zero, and the control ignores a word with it: `G1 Z#3` does not move Z.
    ///
    /// Where such a variable is zero, one case is an information: a subroutine reads an argument that its call does not give, and does not
    /// set or test it itself.
    ///
    /// ## Reported
    /// ```nc,reported,fanuc-mill
    /// O0001
    /// #1=10.
    /// G0 X#1 Y#2
    /// M30
    /// ```
    /// ```nc,reported,haas-mill
    /// O0001
    /// G65 P9100 X1.
    /// M30
    /// O9100
    /// #30= #24 + #26
    /// G0 Z#30
    /// M99
    /// ```
    /// ```nc,reported,linuxcnc
    /// o100 sub
    /// G0 X[#1] Y[#2]
    /// G1 Z[#3] F100
    /// o100 endsub
    /// o100 call [10] [20]
    /// M2
    /// ```
    /// ## Not reported
    /// A test for null, arguments that are passed on, and a program that is called from elsewhere.
    /// ```nc,quiet,fanuc-mill
    /// O0001
    /// IF [#2 EQ #0] THEN #2=5.
    /// G65 P9100 X#2 Y#3
    /// M30
    /// O9100
    /// G0 X#24 Y#25
    /// M99
    /// ```
    /// ```nc,quiet,fanuc-mill
    /// O9100
    /// G0 X#24 Y#25
    /// M99
    /// ```
    rule "variable-read-before-set" in "macros" {
        summary: "variable read before it is set",
        severity: Warning,
        tier: Path,
        since: "0.1.0",
        run: Run::Path {
            watch: Watch::READS.union(Watch::ENDS),
            make: || Box::new(VariableReadBeforeSet::default()),
        },
    }
}

#[derive(Default, Clone, PartialEq)]
struct VariableReadBeforeSet {
    told: HashSet<u32>,
}

remembers!(VariableReadBeforeSet);

impl PathRule for VariableReadBeforeSet {
    fn memory(&mut self) -> Remembers<'_> {
        Remembers::All(self)
    }

    fn ended(&mut self, cx: &PathCx<'_>, _: Ending, report: &mut Report<'_>) {
        short_calls(cx, report);
    }

    fn vacant_read(&mut self, cx: &PathCx<'_>, variable: u32, report: &mut Report<'_>) {
        if self.told.contains(&variable) {
            return;
        }
        let [first, last] = cx.model.semantics().locals;
        if !(first..=last).contains(&variable) {
            return;
        }
        let in_macro = is_in_macro(cx);
        if !in_macro && cx.file_index.is_called_from_elsewhere() || is_assigned_before(cx, variable) {
            return;
        }
        let Some(place) = cx.place() else { return };
        let Some((usage, range)) = usage(cx, &place, variable) else { return };
        let argument = argument_of(cx, variable).filter(|_| in_macro);
        let severity = match usage {
            Use::Tested | Use::HandedOn => return,
            // A macro that moves the axes of its arguments ignores the others on purpose.
            Use::Word(_) if in_macro => return,
            Use::Counted => Severity::Info,
            Use::Computed | Use::Word(_) => Severity::Warning,
        };
        self.told.insert(variable);
        let message = match argument {
            Some(letter) => {
                format!(
                    "the call does not give `{letter}`, but the macro uses it in arithmetic (`#{variable}`)"
                )
            }
            None => format!("variable `#{variable}` is read before it is set"),
        };
        let label = match usage {
            Use::Word(_) => "holds nothing here: the control ignores the word",
            _ => "holds nothing here, and counts as zero",
        };
        let help = match argument {
            Some(letter) => {
                format!("give `{letter}` in the call, or test `#{variable}` for `#0` before it is used")
            }
            None => format!("set `#{variable}` before this block"),
        };
        report.add(cx.finding(&META, range, message).label(label).help(help).at_most(severity));
    }
}

/// A subroutine of the file, and its local variables, one bit each.
struct Subroutine {
    label: OLabel,
    /// What it sets by itself.
    sets: u64,
    /// What it reads and has not set in a block before.
    reads: u64,
    tests: u64,
}

/// Calls that give less than their subroutine reads. What is not given is zero, whatever the caller has in that variable.
fn short_calls(cx: &PathCx<'_>, report: &mut Report<'_>) {
    let is_called = cx.file_index.is_called_from_elsewhere();
    if cx.file_index.o_words.is_empty() || is_called || cx.is_called_only() {
        return;
    }
    let [first, last] = cx.model.semantics().locals;
    let mut subs: Vec<Subroutine> = Vec::new();
    let mut calls = Vec::new();
    let mut open: Option<Subroutine> = None;
    let flags = BlockFlags::STATEMENT | BlockFlags::EXPRESSION;
    for (_, place) in blocks_with(cx.program, cx.environment, flags) {
        let mut is_test = false;
        for statement in place.table.statements(place.ix) {
            is_test |= tests(&statement.kind);
            let StatementKind::OWord { label, keyword, arguments } = &statement.kind else { continue };
            match keyword {
                OKeyword::Sub => {
                    open = Some(Subroutine { label: label.clone(), sets: 0, reads: 0, tests: 0 });
                }
                OKeyword::EndSub => subs.extend(open.take()),
                OKeyword::Call if open.is_none() && label.expressions() == 0 => {
                    calls.push((label.clone(), arguments.len(), place.range()));
                }
                _ => {}
            }
        }
        if let Some(sub) = &mut open {
            let read = read_in(&place, first..=last);
            sub.reads |= read & !sub.sets;
            sub.tests |= if is_test { read } else { 0 };
            sub.sets |= set_in(&place, first..=last);
        }
    }
    for (label, count, range) in calls {
        let mut same = subs.iter().filter(|sub| sub.label == label);
        let (Some(sub), None) = (same.next(), same.next()) else { continue };
        let count = u32::try_from(count).unwrap_or(u32::MAX);
        let is_missing = |number: &u32| {
            let bit = 1 << (number - first);
            sub.reads & bit != 0 && sub.tests & bit == 0
        };
        let from = first.saturating_add(count);
        let Some(missing) = (from..=last.min(first + 62)).find(is_missing) else { continue };
        let arguments = if count == 1 { "1 argument".to_owned() } else { format!("{count} arguments") };
        report.add(
            cx.finding(
                &META,
                range,
                format!("the call gives {arguments}, and the subroutine reads `#{missing}`"),
            )
            .label(format!("`#{missing}` is zero in the subroutine"))
            .note("an argument that the call does not give is zero, and the subroutine does not set it before it reads it")
            .help(format!("give the value for `#{missing}` in the call"))
            .at_most(Severity::Info),
        );
    }
}

/// The variables of this range that a block reads, one bit each.
fn read_in(place: &Place, range: RangeInclusive<u32>) -> u64 {
    let mut read = 0;
    for op in place.expressions().flat_map(|expr| place.table.ops(place.table.expr(expr)).to_vec()) {
        if let Op::Variable(number) = op {
            read |= bit_of(number, &range);
        }
    }
    read
}

/// The variables of this range that a block assigns to, one bit each.
fn set_in(place: &Place, range: RangeInclusive<u32>) -> u64 {
    place.table.statements(place.ix).fold(0, |set, statement| match statement.kind {
        StatementKind::Assign { target: Target::Variable(number), .. } => set | bit_of(number, &range),
        // It may be any of them.
        StatementKind::Assign { target: Target::Computed(_), .. } => u64::MAX,
        _ => set,
    })
}

/// The bit of a variable of the range; none of the last ones of a very long range.
fn bit_of(number: u32, range: &RangeInclusive<u32>) -> u64 {
    if range.contains(&number) { 1_u64.checked_shl(number - range.start()).unwrap_or(0) } else { 0 }
}

/// Does the statement test a value?
fn tests(kind: &StatementKind) -> bool {
    match kind {
        StatementKind::If { .. } | StatementKind::Guard { .. } => true,
        StatementKind::OWord { keyword, .. } => {
            matches!(keyword, OKeyword::If | OKeyword::ElseIf | OKeyword::While | OKeyword::Repeat)
        }
        _ => false,
    }
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::check_rule;

    #[test]
    fn each_variable_is_told_once_where_it_is_read_first() {
        check_rule(
            &RULE,
            "fanuc-mill",
            "O1\nG0 X#1\nY[#2*2.]\nIF [#3 GT 5.] GOTO 10\nX#1\nN10 M30\n",
            &expect![[r#"
                2 | G0 X#1
                  |    ^^^ warning[variable-read-before-set] variable `#1` is read before it is set
                3 | Y[#2*2.]
                  | ^^^^^^^^ warning[variable-read-before-set] variable `#2` is read before it is set
                4 | IF [#3 GT 5.] GOTO 10
                  | ^^^^^^^^^^^^^ warning[variable-read-before-set] variable `#3` is read before it is set
            "#]],
        );
    }

    #[test]
    fn counting_from_nothing_is_worth_knowing() {
        check_rule(
            &RULE,
            "haas-mill",
            "O1\n#1= #1 + 1\nG0 X#1\nM30\n",
            &expect![[r#"
            2 | #1= #1 + 1
              | ^^^^^^^^^^ info[variable-read-before-set] variable `#1` is read before it is set
        "#]],
        );
    }

    #[test]
    fn an_argument_that_the_call_does_not_give() {
        check_rule(
            &RULE,
            "fanuc-mill",
            "O1\nG65 P2 A1.\nM30\nO2\nIF [#3 EQ #0] THEN #3=1.\n#30=#1/2+#2\nG0 X#30 Y#25\nM99\n",
            &expect![[r#"
                6 | #30=#1/2+#2
                  | ^^^^^^^^^^^ warning[variable-read-before-set] the call does not give `B`, but the macro uses it in arithmetic (`#2`)
            "#]],
        );
    }

    #[test]
    fn common_variables_hold_what_the_last_program_left() {
        check_rule(&RULE, "fanuc-mill", "O1\nG0 X#100\nM30\n", &expect![[""]]);
    }

    #[test]
    fn a_control_where_unset_variables_are_zero() {
        check_rule(&RULE, "linuxcnc", "G0 X#1\nM2\n", &expect![[""]]);
    }

    #[test]
    fn a_call_that_gives_less_than_its_subroutine_reads() {
        let program = |body: &str, call: &str| {
            format!("o100 sub\nG0 X[#1] Y[#2]\n{body}\no100 endsub\nG21 G90\n{call}\nM2\n")
        };
        check_rule(
            &RULE,
            "linuxcnc",
            &program("G1 Z[#3] F100", "o100 call [10] [20]"),
            &expect![[r#"
                6 | o100 call [10] [20]
                  | ^^^^^^^^^^^^^^^^^^^ info[variable-read-before-set] the call gives 2 arguments, and the subroutine reads `#3`
            "#]],
        );
        for (body, call) in [
            ("G1 Z[#3] F100", "o100 call [10] [20] [-3]"),
            ("G1 Z-3 F100", "o100 call [10] [20]"),
            ("#3=[#1+1]\nG1 Z[#3] F100", "o100 call [10] [20]"),
            ("o101 if [#3 NE 0]\nG1 Z[#3] F100\no101 endif", "o100 call [10] [20]"),
            ("G1 Z[#31] F100", "o100 call [10] [20]"),
            ("G1 Z[#<depth>] F100", "#<depth>=-3\no100 call [10] [20]"),
            ("G1 Z[#3] F100", "o[#4] call [10] [20]"),
        ] {
            check_rule(&RULE, "linuxcnc", &program(body, call), &expect![[""]]);
        }
        // What the caller has in its own `#3` does not reach the subroutine.
        check_rule(
            &RULE,
            "linuxcnc",
            &program("G1 Z[#3] F100", "#3=-4\no100 call [10] [20]"),
            &expect![[r#"
                7 | o100 call [10] [20]
                  | ^^^^^^^^^^^^^^^^^^^ info[variable-read-before-set] the call gives 2 arguments, and the subroutine reads `#3`
            "#]],
        );
        // What one subroutine gives another may come from its own caller.
        let nested =
            "o1 sub\nG0 X[#1] Y[#2]\no1 endsub\no2 sub\no1 call [#1]\no2 endsub\no2 call [1] [2]\nM2\n";
        check_rule(&RULE, "linuxcnc", nested, &expect![[""]]);
    }

    #[test]
    fn a_variable_that_another_way_may_have_set() {
        check_rule(&RULE, "fanuc-mill", "O1\nIF [#500 EQ 1] GOTO 10\n#1=5.\nN10 G0 X#1\nM30\n", &expect![""]);
    }
}
