//! A variable that the manual keeps for the builder of the control.

use std::ops::Range;

use gcheck_controls::{Variable, VariableEntry};
use gcheck_program::{BlockFlags, Function, Op, StatementKind, Target};

use crate::declare::declare_rule;
use crate::{BlockCx, Finding, Report, Run};

declare_rule! {
    /// A program reads or sets a variable that the manual reserves.
    ///
    /// ## Why it matters
    /// What the variable holds is not documented: it differs from machine to machine, and from one version of the control
    /// to the next. A value that a program puts there may change the machine.
    ///
    /// ## Reported
    /// ```nc,reported,haas-mill
    /// #100= #6001
    /// #6999= 1.
    /// ```
    /// ## Not reported
    /// A test whether the variable exists is not a use of it.
    /// ```nc,quiet,haas-mill
    /// #100= #6198
    /// #10100= #5901
    /// ```
    rule "variable-reserved" in "macros" {
        summary: "variable that the manual reserves",
        severity: Warning,
        tier: Block,
        control_specific: true,
        since: "0.1.0",
        run: Run::Block { trigger: BlockFlags::STATEMENT.union(BlockFlags::EXPRESSION), check },
    }
}

fn check(cx: &BlockCx<'_>, report: &mut Report<'_>) {
    for statement in cx.statements() {
        if let StatementKind::Assign { target: Target::Variable(number), .. } = statement.kind
            && let Some(entry) = reserved(cx, number)
        {
            report.add(finding(cx, statement.range.clone(), number, entry, "set here"));
        }
    }
    for expr in cx.expressions() {
        let ops = cx.table().ops(expr);
        if ops.iter().any(|op| matches!(op, Op::Call(Function::Exists, _))) {
            continue;
        }
        for (ix, op) in ops.iter().enumerate() {
            // A number is reported once in an expression.
            if let Op::Variable(number) = op
                && !ops.iter().take(ix).any(|other| other == op)
                && let Some(entry) = reserved(cx, *number)
            {
                report.add(finding(cx, expr.range.clone(), *number, entry, "read here"));
            }
        }
    }
}

fn reserved<'a>(cx: &BlockCx<'a>, number: u32) -> Option<&'a VariableEntry> {
    match cx.control().variable(number) {
        Variable::Known(entry) => Some(entry).filter(|entry| entry.reserved),
        Variable::Unlisted => None,
    }
}

fn finding(
    cx: &BlockCx<'_>,
    within: Range<u32>,
    number: u32,
    entry: &VariableEntry,
    label: &'static str,
) -> Finding {
    let name = format!("#{number}");
    let at = cx.slice(within.clone()).find(&name).map(|at| within.start + at as u32);
    let place = at.map_or(within, |at| at..at + name.len() as u32);
    let mut finding = Finding::new(&META, cx.in_file(place), format!("variable `{name}` is reserved"))
        .label(label)
        .help("use a common or local variable");
    if let Some([first, last]) = entry.range {
        finding = finding.note(format!("`#{first}` to `#{last}`: {}  [{}]", entry.title, entry.source));
    }
    finding
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::{World, check_rule, findings, only, words};

    #[test]
    fn reading_and_setting_are_shown_at_the_variable() {
        check_rule(
            &RULE,
            "haas-mill",
            "G1 X[#6199*2.]\n#6001=#6002\n#6000=1.\n#7001=1.\n",
            &expect![[r#"
                1 | G1 X[#6199*2.]
                  |      ^^^^^ warning[variable-reserved] variable `#6199` is reserved
                2 | #6001=#6002
                  | ^^^^^ warning[variable-reserved] variable `#6001` is reserved
                2 | #6001=#6002
                  |       ^^^^^ warning[variable-reserved] variable `#6002` is reserved
            "#]],
        );
    }

    #[test]
    fn what_it_says() {
        let found = findings(&only(&RULE), "haas-mill", "#6001=1\n", &World::default());
        expect![[r#"
            variable `#6001` is reserved
              here: set here
              note: `#6001` to `#6197`: reserved; settings on the classic control  [HM17 p.203; general knowledge (classic control)]
              help: use a common or local variable
        "#]]
        .assert_eq(&words(&found[0]));
    }
}
