//! An angle that is computed in radians, for a function that counts degrees.

use gcheck_program::{BinaryOp, BlockFlags, Function, Op};

use crate::declare::declare_rule;
use crate::{BlockCx, Finding, Report, Run};

declare_rule! {
    /// The argument of `SIN`, `COS` or `TAN` is converted to radians: multiplied by pi, by pi and divided by 180, or by 0.01745.
    ///
    /// ## Why it matters
    /// The functions of controls take degrees. An angle in radians counts as a very small angle, and the tool goes to the wrong
    /// place without an alarm.
    ///
    /// ## Reported
    /// ```nc,reported,fanuc-mill
    /// #2=50.*SIN[#1*3.14159/180.]
    /// M30
    /// ```
    /// ## Not reported
    /// The arc that belongs to an angle is a length, and an angle that an arc gives is divided by pi.
    /// ```nc,quiet,fanuc-mill
    /// #2=50.*SIN[#1]
    /// #3=#1*3.14159/180.*50.
    /// #4=COS[#3*180./3.14159/50.]
    /// M30
    /// ```
    rule "angle-in-radians" in "macros" {
        summary: "angle in radians for a function that takes degrees",
        severity: Warning,
        tier: Block,
        since: "0.1.0",
        run: Run::Block { trigger: BlockFlags::EXPRESSION.union(BlockFlags::STATEMENT), check },
    }
}

/// What a value of an expression is, as far as its numbers tell.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Kind {
    Other,
    /// The number itself.
    Number(f64),
    /// Something times pi.
    Radians,
}

fn check(cx: &BlockCx<'_>, report: &mut Report<'_>) {
    for expr in cx.expressions().filter(|expr| expr.well_formed) {
        let Some(function) = of_radians(cx.table().ops(expr)) else { continue };
        let name = function.name();
        report.add(
            Finding::new(
                &META,
                cx.in_file(expr.range.clone()),
                format!("the angle is converted to radians, and `{name}` takes degrees"),
            )
            .label("counts as a much smaller angle")
            .help(format!("give `{name}` the angle in degrees, without the factor")),
        );
    }
}

/// The function whose argument is in radians.
fn of_radians(ops: &[Op]) -> Option<Function> {
    let mut stack: Vec<Kind> = Vec::new();
    for op in ops {
        match op {
            Op::Number(number) => stack.push(Kind::Number(*number)),
            Op::Variable(_) | Op::Named { .. } => stack.push(Kind::Other),
            Op::Indirect => {
                stack.pop()?;
                stack.push(Kind::Other);
            }
            Op::Negate => {}
            Op::Binary(operator) => {
                let (right, left) = (stack.pop()?, stack.pop()?);
                stack.push(combined(*operator, left, right));
            }
            Op::Call(function, arguments) => {
                let mut argument = Kind::Other;
                for _ in 0..*arguments {
                    argument = stack.pop()?;
                }
                if matches!(function, Function::Sin | Function::Cos | Function::Tan)
                    && argument == Kind::Radians
                {
                    return Some(*function);
                }
                stack.push(Kind::Other);
            }
        }
    }
    None
}

fn combined(operator: BinaryOp, left: Kind, right: Kind) -> Kind {
    use std::f64::consts::PI;
    let is = |kind: Kind, value: f64| matches!(kind, Kind::Number(number) if ((number - value) / value).abs() < 6e-4);
    // `57.3` is the number of degrees in a radian.
    let (to_radians, degrees) = (PI / 180.0, 180.0 / PI);
    let is_factor = |kind: Kind| is(kind, PI) || is(kind, to_radians) || kind == Kind::Radians;
    // Times one of these, before or after pi divides, it is degrees again.
    let to_degrees = [180.0, 360.0, degrees, degrees / PI];
    let gives_degrees = |kind: Kind| to_degrees.into_iter().any(|factor| is(kind, factor));
    match operator {
        BinaryOp::Multiply if is_factor(left) != is_factor(right) => {
            if gives_degrees(left) || gives_degrees(right) { Kind::Other } else { Kind::Radians }
        }
        BinaryOp::Divide if left == Kind::Radians && !is_factor(right) => Kind::Radians,
        BinaryOp::Divide if is(left, PI) && is(right, 180.0) => Kind::Number(to_radians),
        BinaryOp::Divide if is(left, PI) && !is_factor(right) => Kind::Radians,
        BinaryOp::Divide if is(right, degrees) => Kind::Radians,
        BinaryOp::Divide => match (left, right) {
            // `[180./3.14159]` is the number of degrees in a radian.
            (Kind::Number(left), Kind::Number(right)) => Kind::Number(left / right),
            _ => Kind::Other,
        },
        BinaryOp::Add | BinaryOp::Subtract if left == Kind::Radians || right == Kind::Radians => {
            Kind::Radians
        }
        _ => Kind::Other,
    }
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::check_rule;

    #[test]
    fn however_it_is_converted() {
        check_rule(
            &RULE,
            "haas-mill",
            "G0 X[10.*COS[#1*3.1416/180.]]\n#2=SIN[3.14159/180*#1]\n#3=TAN[#1*0.0174533]\n#4=SIN[#1/57.2958]\n#5=COS[2*3.14159*#6/#7]\n#8=SIN[#1/[180./3.14159]]\nM30\n",
            &expect![[r#"
                1 | G0 X[10.*COS[#1*3.1416/180.]]
                  |     ^^^^^^^^^^^^^^^^^^^^^^^^^ warning[angle-in-radians] the angle is converted to radians, and `COS` takes degrees
                2 | #2=SIN[3.14159/180*#1]
                  |    ^^^^^^^^^^^^^^^^^^^ warning[angle-in-radians] the angle is converted to radians, and `SIN` takes degrees
                3 | #3=TAN[#1*0.0174533]
                  |    ^^^^^^^^^^^^^^^^^ warning[angle-in-radians] the angle is converted to radians, and `TAN` takes degrees
                4 | #4=SIN[#1/57.2958]
                  |    ^^^^^^^^^^^^^^^ warning[angle-in-radians] the angle is converted to radians, and `SIN` takes degrees
                5 | #5=COS[2*3.14159*#6/#7]
                  |    ^^^^^^^^^^^^^^^^^^^^ warning[angle-in-radians] the angle is converted to radians, and `COS` takes degrees
                6 | #8=SIN[#1/[180./3.14159]]
                  |    ^^^^^^^^^^^^^^^^^^^^^^ warning[angle-in-radians] the angle is converted to radians, and `SIN` takes degrees
            "#]],
        );
        check_rule(
            &RULE,
            "linuxcnc",
            "#2=[SIN[#1] * 3.14159 / 180]\n#3=[COS[#1*180/3.14159]]\n#4=[SIN[#1/[3.14159*50]*360]]\n#5=[SIN[#1/2]]\n#6=[SIN[3.15*#1]]\n#7=[10*SIN[#1*2*3.14159/#4*57.2958]]\n#8=[SIN[#3*3.14159/#4*57.29578/3.14159]]\n#9=[SIN[#1*3.14159*[180/9.8696]]]\nM2\n",
            &expect![[""]],
        );
    }
}
