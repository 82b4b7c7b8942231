//! A numbered variable that the control does not have.

use std::ops::Range;

use gcheck_controls::{Confidence, Control, Variable, VariableEntry};
use gcheck_program::{BlockFlags, Function, Op, StatementKind, Target};

use crate::declare::declare_rule;
use crate::{BlockCx, Finding, Report, Run, Severity, limit};

declare_rule! {
    /// A variable is between or above the ranges that the control is known to have.
    ///
    /// ## Why it matters
    /// The control stops with an alarm where the variable is used. Often the number is mistyped.
    ///
    /// ## Reported
    /// ```nc,reported,haas-mill
    /// #50= 1.
    /// ```
    /// ```nc,reported,linuxcnc
    /// #1=#5700
    /// ```
    /// ## Not reported
    /// If the list of a control is uncertain, the rule does not report; the number of a computed variable is not known
    /// either.
    /// ```nc,quiet,haas-mill
    /// #100= #[#1+49]
    /// #9000= 1.
    /// ```
    rule "variable-unlisted" in "macros" {
        summary: "variable that the control does not have",
        severity: Error,
        tier: Block,
        since: "0.1.0",
        run: Run::Block { trigger: BlockFlags::STATEMENT.union(BlockFlags::EXPRESSION), check },
    }
}

fn check(cx: &BlockCx<'_>, report: &mut Report<'_>) {
    // An unknown control may have any variable.
    if cx.environment.control_is_unknown() {
        return;
    }
    for statement in cx.statements() {
        if let StatementKind::Assign { target: Target::Variable(number), .. } = statement.kind
            && let Some(gap) = gap(cx.control(), number)
        {
            report.add(finding(cx, statement.range.clone(), number, gap));
        }
    }
    for expr in cx.expressions() {
        let ops = cx.table().ops(expr);
        // A test whether a variable exists is not a use of it.
        if ops.iter().any(|op| matches!(op, Op::Call(Function::Exists, _))) {
            continue;
        }
        for (ix, op) in ops.iter().enumerate() {
            // `##50` reads the variable too; a number is reported once.
            if let Op::Variable(number) = op
                && !ops.iter().take(ix).any(|o| o == op)
                && let Some(gap) = gap(cx.control(), *number)
            {
                report.add(finding(cx, expr.range.clone(), *number, gap));
            }
        }
    }
}

/// The listed ranges below and above a number outside all ranges, if the gap between them is certain.
fn gap(control: &Control, number: u32) -> Option<(Option<&VariableEntry>, Option<&VariableEntry>)> {
    if matches!(control.variable(number), Variable::Known(_)) {
        return None;
    }
    let ranges = || control.variables().iter().filter_map(|v| Some((v.range?, v)));
    let below =
        ranges().filter(|([_, last], _)| *last < number).max_by_key(|([_, last], _)| *last).map(|(_, v)| v);
    let above = ranges()
        .filter(|([first, _], _)| *first > number)
        .min_by_key(|([first, _], _)| *first)
        .map(|(_, v)| v);
    // Only next to a range of program variables is a gap certain; lists of the control's own state may be incomplete.
    let sure = |v: &VariableEntry| v.confidence == Confidence::Manual;
    let is_program = |v: &VariableEntry| v.kind != gcheck_controls::VariableKind::System;
    match (below, above) {
        (Some(below), Some(above)) => (sure(below) && sure(above) && is_program(below) && is_program(above))
            .then_some((Some(below), Some(above))),
        (below, above) => below.or(above).is_some_and(sure).then_some((below, above)),
    }
}

fn finding(
    cx: &BlockCx<'_>,
    within: Range<u32>,
    number: u32,
    (below, above): (Option<&VariableEntry>, Option<&VariableEntry>),
) -> Finding {
    let name = format!("#{number}");
    let at = cx.slice(within.clone()).find(&name).map(|at| within.start + at as u32);
    let place = at.map_or(within, |at| at..at + name.len() as u32);
    let describe = |v: &VariableEntry| {
        v.range.map(|[first, last]| {
            let numbers =
                if first == last { format!("`#{first}`") } else { format!("`#{first}` to `#{last}`") };
            format!("{numbers}: {}  [{}]", v.title, v.source)
        })
    };
    let mut finding =
        Finding::new(&META, cx.in_file(place), format!("variable `{name}` does not exist on this control"))
            .label("no such variable")
            .help("use a variable of another range");
    // A control with a last number refuses every variable beyond it, and the variable of number zero.
    let semantics = cx.control().semantics();
    let is_beyond = |last: u32| number == 0 || number > last;
    let is_refused = semantics.strict && semantics.refusals.last_variable.is_some_and(is_beyond);
    finding = finding.at_most(if is_refused { limit(semantics.confidence) } else { Severity::Warning });
    for note in below.into_iter().chain(above).filter_map(describe) {
        finding = finding.note(note);
    }
    finding
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::{World, check_rule, findings, only, words};

    #[test]
    fn a_control_that_is_not_known_has_any() {
        let world = World { control_is_guessed: true, ..World::default() };
        assert!(findings(&only(&RULE), "generic-mill", "O1\n#60=1\n", &world).is_empty());
        assert_eq!(findings(&only(&RULE), "haas-mill", "O1\n#60=1\n", &world).len(), 1);
    }

    #[test]
    fn reading_and_writing_are_shown_at_the_variable() {
        check_rule(
            &RULE,
            "fanuc-mill",
            "G1 X[#50*2.]\nIF [#250 EQ 1] GOTO 1\n#99=#100\n",
            &expect![[r#"
                1 | G1 X[#50*2.]
                  |      ^^^ warning[variable-unlisted] variable `#50` does not exist on this control
                3 | #99=#100
                  | ^^^ warning[variable-unlisted] variable `#99` does not exist on this control
            "#]],
        );
    }

    #[test]
    fn behind_the_last_range_only_a_known_size_counts() {
        check_rule(
            &RULE,
            "linuxcnc",
            "#5602=1\n#0=2\n",
            &expect![[r#"
                1 | #5602=1
                  | ^^^^^ error[variable-unlisted] variable `#5602` does not exist on this control
                2 | #0=2
                  | ^^ error[variable-unlisted] variable `#0` does not exist on this control
            "#]],
        );
        check_rule(&RULE, "fanuc-mill", "#98000=1\n", &expect![[""]]);
    }

    #[test]
    fn the_ranges_around_are_named() {
        let found = findings(&only(&RULE), "fanuc-mill", "#40=1\n", &World::default());
        expect![[r#"
            variable `#40` does not exist on this control
              here: no such variable
              note: `#1` to `#33`: local variables of one macro level, filled by the arguments of G65  [MACRO-B]
              note: `#100` to `#149`: common variables, emptied at power-off  [MACRO-B]
              help: use a variable of another range
        "#]].assert_eq(&words(&found[0]));
    }
}
