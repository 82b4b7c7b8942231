//! An expression that has no value.

use std::ops::Range;

use gcheck_engine::{Fault, FrameKind, ValueFault};
use gcheck_program::{BinaryOp, Function, Op};

use crate::declare::declare_rule;
use crate::{PathCx, PathRule, Report, Run, Watch};

declare_rule! {
    /// An expression cannot be computed with the values that the program gives it: a division by zero, the root of a
    /// negative number, an arc function of more than one.
    ///
    /// ## Why it matters
    /// The control stops with an alarm in the middle of the program.
    ///
    /// ## Reported
    /// ```nc,reported,fanuc-mill
    /// #1=0
    /// #2=10/#1
    /// M30
    /// ```
    /// ```nc,reported,linuxcnc
    /// #1=-4
    /// G0 X[SQRT[#1]]
    /// M2
    /// ```
    /// ## Not reported
    /// ```nc,quiet,fanuc-mill
    /// #1=4
    /// #2=10/#1
    /// #3=SQRT[#500]
    /// #4=10/#500
    /// M30
    /// ```
    rule "expression-without-value" in "macros" {
        summary: "expression that cannot be computed",
        severity: Error,
        tier: Path,
        since: "0.1.0",
        run: Run::Path { watch: Watch::FAULTS, make: || Box::new(ExpressionWithoutValue) },
    }
}

struct ExpressionWithoutValue;

impl PathRule for ExpressionWithoutValue {
    fn fault(&mut self, cx: &PathCx<'_>, fault: &Fault, report: &mut Report<'_>) {
        let Fault::Value(fault) = fault else { return };
        let (message, label, help) = match fault {
            ValueFault::DivisionByZero => (
                "division by zero",
                "the divisor is zero here",
                "make sure that the divisor is set, and not zero, before this block",
            ),
            ValueFault::NegativeRoot => (
                "root of a negative number (`SQRT`)",
                "the number is below zero here",
                "check the values in the root",
            ),
            ValueFault::LogarithmOfNonPositive => (
                "logarithm of a number that is not above zero (`LN`)",
                "the number is zero or below here",
                "check the values in the logarithm",
            ),
            ValueFault::ArcFunctionRange => (
                "arc function of a number outside -1 to 1 (`ASIN`, `ACOS`)",
                "the number is not between -1 and 1 here",
                "check the values in the function",
            ),
            ValueFault::NegativePower => (
                "negative number to a power that is not whole",
                "the base is below zero here",
                "check the values in the power",
            ),
            ValueFault::NotFinite if converts(cx) => (
                "number that has no decimal digits to convert (`BIN`, `BCD`)",
                "the number is below zero, too large, or not in BCD here",
                "check the values in the function: `BIN` takes a BCD number, each four bits of which are a digit from 0 to 9",
            ),
            ValueFault::NotFinite => (
                "number too large to compute with",
                "the result is infinite",
                "check the values in the expression",
            ),
            // Rules of the token and block tier report these.
            ValueFault::Malformed | ValueFault::NoSuchFunction => return,
        };
        let in_macro = cx.state().frames().iter().any(|frame| frame.kind != FrameKind::Main);
        if cx.file_index.is_called_from_elsewhere() && !in_macro {
            return;
        }
        let mut finding = cx.finding(&META, place(cx, *fault), message).label(label).help(help);
        if *fault == ValueFault::DivisionByZero
            && cx.model.semantics().unset == gcheck_controls::Unset::Vacant
        {
            finding = finding.note("a variable that was never set counts as zero in arithmetic");
        }
        report.add(finding);
    }
}

/// Does the block convert from or to decimal digits in four bits each?
fn converts(cx: &PathCx<'_>) -> bool {
    cx.place().is_some_and(|place| {
        place.expressions().any(|ix| {
            let ops = place.table.ops(place.table.expr(ix));
            ops.iter().any(|op| matches!(op, Op::Call(Function::Bin | Function::Bcd, _)))
        })
    })
}

/// The expression, if the block has only one candidate.
fn place(cx: &PathCx<'_>, fault: ValueFault) -> Range<u32> {
    let Some(place) = cx.place() else { return cx.range() };
    let may_be_it = |op: &Op| match fault {
        ValueFault::DivisionByZero => matches!(op, Op::Binary(BinaryOp::Divide | BinaryOp::Modulo)),
        ValueFault::NegativeRoot => matches!(op, Op::Call(Function::Sqrt, _)),
        ValueFault::LogarithmOfNonPositive => matches!(op, Op::Call(Function::Ln, _)),
        ValueFault::ArcFunctionRange => matches!(op, Op::Call(Function::Asin | Function::Acos, _)),
        ValueFault::NegativePower => matches!(op, Op::Binary(BinaryOp::Power) | Op::Call(Function::Pow, _)),
        _ => true,
    };
    let mut found = place
        .expressions()
        .map(|ix| place.table.expr(ix))
        .filter(|expr| place.table.ops(expr).iter().any(may_be_it));
    match (found.next(), found.next()) {
        (Some(expr), None) => place.base + expr.range.start..place.base + expr.range.end,
        _ => cx.range(),
    }
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::check_rule;

    #[test]
    fn every_kind_is_named() {
        check_rule(
            &RULE,
            "linuxcnc",
            "#1=0\n#2=[1/#1]\n#3=LN[#1]\nG0 X[ACOS[2]] Y[1+1]\n#4=[[0-8]**.5]\nG0 Z[SQRT[0-1]]\nM2\n",
            &expect![[r#"
                2 | #2=[1/#1]
                  |    ^^^^^^ error[expression-without-value] division by zero
                3 | #3=LN[#1]
                  |    ^^^^^^ error[expression-without-value] logarithm of a number that is not above zero (`LN`)
                4 | G0 X[ACOS[2]] Y[1+1]
                  |     ^^^^^^^^^ error[expression-without-value] arc function of a number outside -1 to 1 (`ASIN`, `ACOS`)
                5 | #4=[[0-8]**.5]
                  |    ^^^^^^^^^^^ error[expression-without-value] negative number to a power that is not whole
                6 | G0 Z[SQRT[0-1]]
                  |     ^^^^^^^^^^^ error[expression-without-value] root of a negative number (`SQRT`)
            "#]],
        );
    }

    #[test]
    fn a_number_that_is_not_in_bcd() {
        check_rule(
            &RULE,
            "fanuc-mill",
            "#1=BIN[10]\n#2=BIN[16]\nM30\n",
            &expect![[r#"
            1 | #1=BIN[10]
              |    ^^^^^^^ error[expression-without-value] number that has no decimal digits to convert (`BIN`, `BCD`)
        "#]],
        );
    }

    #[test]
    fn a_variable_never_set_is_zero() {
        check_rule(
            &RULE,
            "haas-mill",
            "#2= 10 / #1\nM30\n",
            &expect![[r#"
            1 | #2= 10 / #1
              |    ^^^^^^^^ error[expression-without-value] division by zero
        "#]],
        );
    }

    #[test]
    fn on_some_way_it_holds_for_all_that_come_there() {
        check_rule(&RULE, "fanuc-mill", "IF [#500 NE 0] GOTO 10\n#2=1/#500\nN10 M30\n", &expect![[""]]);
    }

    #[test]
    fn the_caller_of_a_subprogram_gives_its_numbers() {
        check_rule(&RULE, "fanuc-mill", "O9000\n#2=10/#1\nM99\n", &expect![[""]]);
    }
}
