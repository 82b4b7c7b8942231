//! A function that the control does not have, or not with so many arguments.

use std::ops::Range;

use gcheck_engine::takes_arguments;
use gcheck_program::{BlockFlags, Function, Op};

use crate::declare::declare_rule;
use crate::{BlockCx, Finding, Report, Run, Severity, limit};

declare_rule! {
    /// An expression calls a function that is not among those of the control, or gives it another number of arguments.
    ///
    /// ## Why it matters
    /// The control stops with an alarm at the block. Functions differ: only some controls have `POW` and `BIN`, only
    /// others have `EXISTS`.
    ///
    /// ## Reported
    /// ```nc,reported,linuxcnc
    /// #1=POW[2, 3]
    /// ```
    /// Here an arc tangent needs both sides of the angle.
    /// ```nc,reported,linuxcnc
    /// #1=ATAN[1]
    /// ```
    /// ## Not reported
    /// ```nc,quiet,linuxcnc
    /// #1=ATAN[1]/[2]
    /// ```
    /// ```nc,quiet,linuxcnc
    /// #1=SQRT[2**3]
    /// ```
    /// ```nc,quiet,fanuc-mill
    /// #1=BIN[#2]
    /// ```
    rule "function-unknown" in "macros" {
        summary: "function that the control does not have in this form",
        severity: Error,
        tier: Block,
        control_specific: true,
        since: "0.1.0",
        run: Run::Block { trigger: BlockFlags::STATEMENT.union(BlockFlags::EXPRESSION), check },
    }
}

fn check(cx: &BlockCx<'_>, report: &mut Report<'_>) {
    // A control without a list of functions is not judged.
    if cx.control().functions().is_empty() {
        return;
    }
    for expr in cx.expressions() {
        let ops = cx.table().ops(expr);
        for (ix, op) in ops.iter().enumerate() {
            if let Op::Call(function, _) = op
                && !cx.control().functions().iter().any(|f| f.name == function.name())
                && !ops.iter().take(ix).any(|o| matches!(o, Op::Call(f, _) if f == function))
            {
                report.add(finding(cx, expr.range.clone(), *function));
            } else if let Op::Call(function, count) = op
                && cx.control().functions().iter().any(|f| f.name == function.name())
                && *function != Function::Exists
                && !cx.block().flags.contains(BlockFlags::ERROR)
                && !takes_arguments(*function, usize::from(*count), cx.control().semantics())
            {
                report.add(other_count(cx, expr.range.clone(), *function, *count));
            }
        }
    }
}

/// The function's name in an expression, in bytes of the chunk.
fn name_within(cx: &BlockCx<'_>, within: Range<u32>, name: &str) -> Range<u32> {
    let at = cx.slice(within.clone()).to_ascii_uppercase().find(name).map(|at| within.start + at as u32);
    at.map_or(within, |at| at..at + name.len() as u32)
}

fn other_count(cx: &BlockCx<'_>, within: Range<u32>, function: Function, count: u8) -> Finding {
    let name = function.name();
    let place = name_within(cx, within, name);
    let arguments = if count == 1 { "argument" } else { "arguments" };
    let help = if function == Function::Atan {
        "divide the opposite side by the adjacent one: `ATAN[#1]/[#2]`, with `[1]` for the second where there is a quotient"
    } else {
        "give the function the arguments that it takes"
    };
    let semantics = cx.control().semantics();
    let sure = if semantics.strict { limit(semantics.confidence) } else { Severity::Warning };
    Finding::new(&META, cx.in_file(place), format!("function `{name}` with {count} {arguments}"))
        .label("the control refuses this number of arguments")
        .note("the number of arguments of a function differs from control to control")
        .help(help)
        .at_most(sure)
}

fn finding(cx: &BlockCx<'_>, within: Range<u32>, function: Function) -> Finding {
    let name = function.name();
    let place = name_within(cx, within, name);
    let known: Vec<&str> = cx.control().functions().iter().map(|f| f.name.as_str()).collect();
    Finding::new(&META, cx.in_file(place), format!("function `{name}` is not known on this control"))
        .label("no such function")
        .note(format!("known functions: {}", known.join(", ")))
        .help("compute the value with the functions that this control has")
        .at_most(Severity::Warning)
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::{World, check_rule, findings, only, words};

    #[test]
    fn functions_are_found_in_words_conditions_and_assignments() {
        check_rule(
            &RULE,
            "linuxcnc",
            "G0 X[bin[5] + 1] Y[SIN[30]]\no1 if [BCD[#1] GT 0]\no1 endif\n",
            &expect![[r#"
                1 | G0 X[bin[5] + 1] Y[SIN[30]]
                  |      ^^^ warning[function-unknown] function `BIN` is not known on this control
                2 | o1 if [BCD[#1] GT 0]
                  |        ^^^ warning[function-unknown] function `BCD` is not known on this control
            "#]],
        );
    }

    #[test]
    fn the_functions_of_the_control_are_listed() {
        let found = findings(&only(&RULE), "haas-mill", "#1= EXISTS[#2]\n", &World::default());
        expect![[r#"
            function `EXISTS` is not known on this control
              here: no such function
              note: known functions: SIN, COS, TAN, ASIN, ACOS, ATAN, SQRT, ABS, ROUND, FIX, FUP, LN, EXP, POW, BIN, BCD
              help: compute the value with the functions that this control has
        "#]].assert_eq(&found.first().map(words).unwrap_or_default());
    }
}
