//! What each operator and function gives, control by control.
//!
//! The `LinuxCNC` columns are what its interpreter prints for the same expression.

use std::fmt::Write as _;
use std::sync::Arc;

use expect_test::{Expect, expect};
use gcheck_controls::Control;
use gcheck_program::{BinaryOp, Function};

use super::*;

fn control(name: &str) -> Arc<Control> {
    gcheck_controls::load(name).unwrap()
}

fn operand(text: &str) -> Option<f64> {
    if text == "#0" { None } else { Some(text.parse().unwrap()) }
}

fn operator(name: &str) -> BinaryOp {
    match name {
        "+" => BinaryOp::Add,
        "-" => BinaryOp::Subtract,
        "*" => BinaryOp::Multiply,
        "/" => BinaryOp::Divide,
        "MOD" => BinaryOp::Modulo,
        "**" => BinaryOp::Power,
        "EQ" => BinaryOp::Equal,
        "NE" => BinaryOp::NotEqual,
        "GT" => BinaryOp::Greater,
        "GE" => BinaryOp::GreaterEqual,
        "LT" => BinaryOp::Less,
        "LE" => BinaryOp::LessEqual,
        "AND" => BinaryOp::And,
        "OR" => BinaryOp::Or,
        "XOR" => BinaryOp::Xor,
        _ => panic!("no operator {name}"),
    }
}

/// `a OP b`, `F[a]`, `ATAN[a]/[b]`, `POW[a,b]`; `#0` is nothing.
fn value_of(expression: &str, semantics: &Semantics) -> Result<f64, ValueFault> {
    if let Some((name, arguments)) = expression.split_once('[') {
        let arguments: Vec<_> =
            arguments.trim_end_matches(']').replace("]/[", ",").split(',').map(operand).collect();
        return call(Function::parse(name.as_bytes()).unwrap(), &arguments, semantics);
    }
    let mut parts = expression.split(' ');
    let (a, op, b) = (parts.next().unwrap(), parts.next().unwrap(), parts.next().unwrap());
    binary(operator(op), operand(a), operand(b), semantics)
}

/// One line an expression, one column a control.
fn table(controls: &[&str], expressions: &[&str], expected: &Expect) {
    let mut out = String::new();
    for expression in expressions {
        write!(out, "{expression:<24}").unwrap();
        for name in controls {
            let value = match value_of(expression, control(name).semantics()) {
                Ok(x) if x.abs() >= 1e12 || x != 0.0 && x.abs() < 1e-6 => format!("{x:.3e}"),
                Ok(x) => format!("{x}"),
                Err(why) => format!("{why:?}"),
            };
            write!(out, " {value:<22}").unwrap();
        }
        out.truncate(out.trim_end().len());
        out.push('\n');
    }
    expected.assert_eq(&out);
}

#[test]
fn arithmetic() {
    table(
        &["linuxcnc"],
        &[
            "2 + 3",
            "2 - 3",
            "2 * -3",
            "7 / 2",
            "1 / 0",
            "0 / 0",
            "2 ** 3",
            "2 ** -1",
            "-2 ** 2",
            "-2 ** 3",
            "-2 ** 0.5",
            "-2 ** 3.000000000000001",
            "0 ** 0",
            "0 ** -1",
            "10 ** 400",
            "-2 ** 1025",
            "1e300 * 1e300",
            "0 * -5",
        ],
        &expect![[r#"
            2 + 3                    5
            2 - 3                    -1
            2 * -3                   -6
            7 / 2                    3.5
            1 / 0                    DivisionByZero
            0 / 0                    DivisionByZero
            2 ** 3                   8
            2 ** -1                  0.5
            -2 ** 2                  4
            -2 ** 3                  -8
            -2 ** 0.5                NegativePower
            -2 ** 3.000000000000001  NegativePower
            0 ** 0                   1
            0 ** -1                  NotFinite
            10 ** 400                NotFinite
            -2 ** 1025               NotFinite
            1e300 * 1e300            NotFinite
            0 * -5                   0
        "#]],
    );
}

#[test]
fn the_remainder_is_never_negative_or_has_the_sign_of_the_dividend() {
    table(
        &["linuxcnc", "fanuc-mill"],
        &[
            "5 MOD 3",
            "-5 MOD 3",
            "5 MOD -3",
            "-5 MOD -3",
            "-5.5 MOD 2",
            "7 MOD 2.5",
            "-6 MOD 3",
            "-0.5 MOD 1",
            "100000000000000000000 MOD 3",
            "-0.00000000000000000001 MOD 1",
            "5 MOD 0",
        ],
        &expect![[r#"
            5 MOD 3                  2                      2
            -5 MOD 3                 1                      -2
            5 MOD -3                 2                      2
            -5 MOD -3                1                      -2
            -5.5 MOD 2               0.5                    -1.5
            7 MOD 2.5                2                      2
            -6 MOD 3                 0                      0
            -0.5 MOD 1               0.5                    -0.5
            100000000000000000000 MOD 3 1                      1
            -0.00000000000000000001 MOD 1 1                      -1.000e-20
            5 MOD 0                  DivisionByZero         DivisionByZero
        "#]],
    );
}

#[test]
fn whole_parts_go_down_the_number_line_or_toward_zero() {
    table(
        &["linuxcnc", "fanuc-mill", "haas-mill"],
        &[
            "FIX[2.8]",
            "FIX[-2.8]",
            "FUP[2.2]",
            "FUP[-2.8]",
            "FIX[-0.5]",
            "FUP[-0.5]",
            "FIX[5]",
            "FUP[5]",
            "FIX[2.9999999999]",
            "ROUND[2.5]",
            "ROUND[-2.5]",
            "ROUND[-0.5]",
            "ROUND[-0.4]",
            "ROUND[1.4999]",
        ],
        &expect![[r#"
            FIX[2.8]                 2                      2                      2
            FIX[-2.8]                -3                     -2                     -2
            FUP[2.2]                 3                      3                      3
            FUP[-2.8]                -2                     -3                     -3
            FIX[-0.5]                -1                     0                      0
            FUP[-0.5]                0                      -1                     -1
            FIX[5]                   5                      5                      5
            FUP[5]                   5                      5                      5
            FIX[2.9999999999]        2                      2                      2
            ROUND[2.5]               3                      3                      3
            ROUND[-2.5]              -3                     -3                     -3
            ROUND[-0.5]              -1                     -1                     -1
            ROUND[-0.4]              0                      0                      0
            ROUND[1.4999]            1                      1                      1
        "#]],
    );
}

#[test]
fn nothing_is_zero_in_arithmetic_and_order_but_not_equal_to_it() {
    table(
        &["linuxcnc", "fanuc-mill", "haas-mill"],
        &[
            "#0 + 1", "#0 * 5", "1 / #0", "SQRT[#0]", "#0 EQ #0", "#0 EQ 0", "0 EQ #0", "#0 NE #0",
            "#0 NE 0", "#0 GE 0", "#0 GT 0", "#0 LT 1", "#0 LE #0",
        ],
        &expect![[r#"
            #0 + 1                   1                      1                      1
            #0 * 5                   0                      0                      0
            1 / #0                   DivisionByZero         DivisionByZero         DivisionByZero
            SQRT[#0]                 0                      0                      0
            #0 EQ #0                 1                      1                      1
            #0 EQ 0                  1                      0                      0
            0 EQ #0                  1                      0                      0
            #0 NE #0                 0                      0                      0
            #0 NE 0                  0                      1                      1
            #0 GE 0                  1                      1                      1
            #0 GT 0                  0                      0                      0
            #0 LT 1                  1                      1                      1
            #0 LE #0                 1                      1                      1
        "#]],
    );
}

#[test]
fn equality_forgives_a_little_and_order_nothing() {
    let linuxcnc = control("linuxcnc");
    let semantics = linuxcnc.semantics();
    let within = semantics.equal_within;
    let is_zero = |x| compare(BinaryOp::Equal, Some(0.0), Some(x), semantics);
    assert!(is_zero(within * 0.99) && is_zero(-within * 0.99));
    assert!(!is_zero(within), "the limit itself is outside");
    assert!(!compare(BinaryOp::NotEqual, Some(0.0), Some(within * 0.99), semantics));
    table(
        &["linuxcnc", "fanuc-mill"],
        &[
            "1 EQ 1.000000001",
            "1 GT 0.999999999",
            "1 GE 1.000000001",
            "1 LT 1.000000001",
            "1 LE 0.999999999",
            "1 GE 1",
            "2 NE 3",
        ],
        &expect![[r#"
            1 EQ 1.000000001         1                      1
            1 GT 0.999999999         1                      1
            1 GE 1.000000001         0                      0
            1 LT 1.000000001         1                      1
            1 LE 0.999999999         0                      0
            1 GE 1                   1                      1
            2 NE 3                   1                      1
        "#]],
    );
}

#[test]
fn logic_asks_for_zero_or_works_on_bits() {
    table(
        &["linuxcnc", "fanuc-mill"],
        &[
            "3 AND 4",
            "5 AND 6.9",
            "0.5 AND 0.5",
            "1 AND 0",
            "0.0000001 AND 1",
            "-1 AND -1",
            "1 OR 6",
            "0 OR 0",
            "1 XOR 3",
            "5 XOR 0",
            "1 XOR 1",
            "-1 AND 255",
            "1e300 AND 1",
            "NOT[0]",
            "NOT[5]",
        ],
        &expect![[r#"
            3 AND 4                  1                      0
            5 AND 6.9                1                      4
            0.5 AND 0.5              1                      0
            1 AND 0                  0                      0
            0.0000001 AND 1          1                      0
            -1 AND -1                1                      -1
            1 OR 6                   1                      7
            0 OR 0                   0                      0
            1 XOR 3                  0                      2
            5 XOR 0                  1                      5
            1 XOR 1                  0                      0
            -1 AND 255               1                      255
            1e300 AND 1              1                      1
            NOT[0]                   1                      1
            NOT[5]                   0                      0
        "#]],
    );
}

#[test]
fn angles_are_degrees_and_exact_where_people_expect_it() {
    table(
        &["linuxcnc", "fanuc-mill"],
        &[
            "SIN[30]",
            "SIN[150]",
            "SIN[-30]",
            "SIN[750]",
            "COS[60]",
            "COS[120]",
            "COS[300]",
            "SIN[90]",
            "SIN[270]",
            "COS[180]",
            "TAN[45]",
            "TAN[135]",
            "SIN[45]",
            "COS[45]",
            "SIN[180]",
            "COS[90]",
            "COS[270]",
            "TAN[180]",
            "TAN[90]",
            "TAN[-90]",
            "SIN[1000000000000]",
            "SIN[36000000000000]",
            "ASIN[0.5]",
            "ASIN[-0.5]",
            "ASIN[1]",
            "ACOS[0.5]",
            "ACOS[-0.5]",
            "ACOS[0]",
            "ACOS[1]",
            "ACOS[-1]",
            "ASIN[1.00000000000001]",
            "ACOS[-2]",
        ],
        &expect![[r#"
            SIN[30]                  0.5                    0.5
            SIN[150]                 0.5                    0.5
            SIN[-30]                 -0.5                   -0.5
            SIN[750]                 0.5                    0.5
            COS[60]                  0.5                    0.5
            COS[120]                 -0.5                   -0.5
            COS[300]                 0.5                    0.5
            SIN[90]                  1                      1
            SIN[270]                 -1                     -1
            COS[180]                 -1                     -1
            TAN[45]                  1                      1
            TAN[135]                 -1                     -1
            SIN[45]                  0.7071067811865476     0.7071067811865476
            COS[45]                  0.7071067811865476     0.7071067811865476
            SIN[180]                 -5.017e-20             0
            COS[90]                  -2.508e-20             0
            COS[270]                 7.525e-20              0
            TAN[180]                 5.017e-20              0
            TAN[90]                  -3.987e19              DivisionByZero
            TAN[-90]                 3.987e19               DivisionByZero
            SIN[1000000000000]       -0.984807753012208     -0.984807753012208
            SIN[36000000000000]      0                      0
            ASIN[0.5]                30                     30
            ASIN[-0.5]               -30                    -30
            ASIN[1]                  90                     90
            ACOS[0.5]                60                     60
            ACOS[-0.5]               120                    120
            ACOS[0]                  90                     90
            ACOS[1]                  0                      0
            ACOS[-1]                 180                    180
            ASIN[1.00000000000001]   ArcFunctionRange       ArcFunctionRange
            ACOS[-2]                 ArcFunctionRange       ArcFunctionRange
        "#]],
    );
}

#[test]
fn arc_tangent_of_two_gives_the_direction() {
    table(
        &["linuxcnc", "fanuc-mill", "haas-mill"],
        &[
            "ATAN[1]/[1]",
            "ATAN[-1]/[-1]",
            "ATAN[1]/[-1]",
            "ATAN[-1]/[1]",
            "ATAN[0]/[-1]",
            "ATAN[-0]/[-1]",
            "ATAN[0]/[0]",
            "ATAN[1]/[0]",
            "ATAN[-1]/[0]",
            "ATAN[1]",
            "ATAN[-1]",
            "ATAN[0]",
        ],
        &expect![[r#"
            ATAN[1]/[1]              45                     45                     45
            ATAN[-1]/[-1]            -135                   -135                   -135
            ATAN[1]/[-1]             135                    135                    135
            ATAN[-1]/[1]             -45                    -45                    -45
            ATAN[0]/[-1]             180                    180                    180
            ATAN[-0]/[-1]            180                    180                    180
            ATAN[0]/[0]              0                      0                      0
            ATAN[1]/[0]              90                     90                     90
            ATAN[-1]/[0]             -90                    -90                    -90
            ATAN[1]                  NoSuchFunction         45                     45
            ATAN[-1]                 NoSuchFunction         -45                    -45
            ATAN[0]                  NoSuchFunction         0                      0
        "#]],
    );
}

#[test]
fn roots_logarithms_and_powers() {
    table(
        &["linuxcnc"],
        &[
            "SQRT[4]",
            "SQRT[-0.000000000000001]",
            "SQRT[-0]",
            "LN[1]",
            "LN[0]",
            "LN[-1]",
            "EXP[0]",
            "EXP[800]",
            "EXP[-10000]",
            "ABS[-3]",
            "ABS[-0]",
            "POW[2,3]",
            "POW[2]",
            "SQRT[1,2]",
            "EXISTS[1]",
        ],
        &expect![[r#"
            SQRT[4]                  2
            SQRT[-0.000000000000001] NegativeRoot
            SQRT[-0]                 0
            LN[1]                    0
            LN[0]                    LogarithmOfNonPositive
            LN[-1]                   LogarithmOfNonPositive
            EXP[0]                   1
            EXP[800]                 NotFinite
            EXP[-10000]              0
            ABS[-3]                  3
            ABS[-0]                  0
            POW[2,3]                 8
            POW[2]                   NoSuchFunction
            SQRT[1,2]                NoSuchFunction
            EXISTS[1]                Malformed
        "#]],
    );
}

#[test]
fn binary_coded_decimals() {
    table(
        &["fanuc-mill"],
        &[
            "BCD[10]",
            "BCD[255]",
            "BIN[16]",
            "BIN[597]",
            "BIN[10]",
            "BCD[-1]",
            "BCD[0]",
            "BCD[9999999999999]",
            "BCD[10000000000000]",
            "BIN[1e300]",
            "BIN[-1]",
        ],
        &expect![[r#"
            BCD[10]                  16
            BCD[255]                 597
            BIN[16]                  10
            BIN[597]                 255
            BIN[10]                  NotFinite
            BCD[-1]                  NotFinite
            BCD[0]                   0
            BCD[9999999999999]       2.702e15
            BCD[10000000000000]      NotFinite
            BIN[1e300]               NotFinite
            BIN[-1]                  NotFinite
        "#]],
    );
}
