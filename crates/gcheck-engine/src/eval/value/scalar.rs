//! Operators and functions on single values: the one semantics that every domain lifts.
//!
//! Knows: what each operator and function gives on each control, by the control's [`Semantics`]. Must not know: values that
//! are not exactly known.
//!
//! Operands are numbers or nothing (`None`, a vacant variable). Nothing counts as zero everywhere but in `EQ` and `NE`,
//! where controls that know vacancy tell it from zero. Results are finite numbers without a sign on zero.
//!
//! What `LinuxCNC` does was tried out on its interpreter (2.9); two of its habits are left out on purpose: `ROUND` of a
//! number beyond 2³¹ gives −2³¹ there, and zero has a sign there, which `ATAN[-0]/[-1]` shows.

use std::f64::consts::FRAC_1_SQRT_2;

use gcheck_controls::{Fix, Semantics, Unset};
use gcheck_program::{BinaryOp, Function};

use crate::fault::ValueFault;

/// The value of an operator.
///
/// # Errors
/// Division or remainder by zero, a negative base with a broken exponent, a result that is not finite.
#[inline]
pub(crate) fn binary(
    op: BinaryOp,
    left: Option<f64>,
    right: Option<f64>,
    semantics: &Semantics,
) -> Result<f64, ValueFault> {
    let (a, b) = (left.unwrap_or(0.0), right.unwrap_or(0.0));
    match op {
        BinaryOp::Add => finite(a + b),
        BinaryOp::Subtract => finite(a - b),
        BinaryOp::Multiply => finite(a * b),
        BinaryOp::Divide if b == 0.0 => Err(ValueFault::DivisionByZero),
        BinaryOp::Divide => finite(a / b),
        BinaryOp::Modulo => modulo(a, b, semantics),
        BinaryOp::Power => power(a, b),
        BinaryOp::Equal
        | BinaryOp::NotEqual
        | BinaryOp::Greater
        | BinaryOp::GreaterEqual
        | BinaryOp::Less
        | BinaryOp::LessEqual => Ok(number(compare(op, left, right, semantics))),
        BinaryOp::And | BinaryOp::Or | BinaryOp::Xor => Ok(logic(op, a, b, semantics)),
    }
}

/// Does the comparison hold? `false` for an operator that compares nothing.
#[inline]
pub(crate) fn compare(op: BinaryOp, left: Option<f64>, right: Option<f64>, semantics: &Semantics) -> bool {
    let (a, b) = (left.unwrap_or(0.0), right.unwrap_or(0.0));
    match op {
        BinaryOp::Equal => equal(left, right, semantics),
        BinaryOp::NotEqual => !equal(left, right, semantics),
        BinaryOp::Greater => a > b,
        BinaryOp::GreaterEqual => a >= b,
        BinaryOp::Less => a < b,
        BinaryOp::LessEqual => a <= b,
        _ => false,
    }
}

/// The value of a function.
///
/// # Errors
/// A function that does not exist with so many arguments, an argument outside its range, a result that is not finite.
/// `EXISTS` has no value here.
pub(crate) fn call(
    function: Function,
    arguments: &[Option<f64>],
    semantics: &Semantics,
) -> Result<f64, ValueFault> {
    check_arity(function, arguments.len(), semantics)?;
    match *arguments {
        [x] => unary(function, x.unwrap_or(0.0), semantics),
        [x, y] => {
            let (x, y) = (x.unwrap_or(0.0), y.unwrap_or(0.0));
            if function == Function::Pow { power(x, y) } else { finite(arc_tangent_of_two(x, y)) }
        }
        _ => Err(ValueFault::NoSuchFunction),
    }
}

/// Does the function exist with so many arguments, as far as the semantics says? (Which names a control knows at all is in
/// its list of functions.)
///
/// # Errors
/// [`ValueFault::NoSuchFunction`]; [`ValueFault::Malformed`] for `EXISTS`, which has no value here.
pub(crate) fn check_arity(function: Function, count: usize, semantics: &Semantics) -> Result<(), ValueFault> {
    if function == Function::Exists {
        return Err(ValueFault::Malformed);
    }
    if takes_arguments(function, count, semantics) { Ok(()) } else { Err(ValueFault::NoSuchFunction) }
}

/// Does the function exist with so many arguments on a control that has a function of this name?
pub fn takes_arguments(function: Function, count: usize, semantics: &Semantics) -> bool {
    match function {
        Function::Atan => count == 2 || count == 1 && semantics.atan_alone,
        Function::Pow => count == 2,
        _ => count == 1,
    }
}

/// How near two numbers must be to be equal: by their distance.
#[inline]
pub(crate) fn is_equal_distance(distance: f64, semantics: &Semantics) -> bool {
    distance <= 0.0 || distance < semantics.equal_within
}

/// Whether `MOD` gives a result that is never negative; else it has the sign of the dividend.
///
/// No entry of `execution.toml` says so by itself: it goes with the number line, which both follow from `FIX` as a floor.
pub(crate) fn modulo_is_never_negative(semantics: &Semantics) -> bool {
    semantics.fix == Fix::NumberLine
}

/// `FIX`.
pub(crate) fn round_down(x: f64, semantics: &Semantics) -> f64 {
    match semantics.fix {
        Fix::Magnitude => x.trunc(),
        Fix::NumberLine => x.floor(),
    }
}

/// `FUP`.
pub(crate) fn round_up(x: f64, semantics: &Semantics) -> f64 {
    match semantics.fix {
        Fix::Magnitude if x < 0.0 => x.floor(),
        Fix::Magnitude | Fix::NumberLine => x.ceil(),
    }
}

/// A truth as a number.
#[inline]
pub(crate) fn number(truth: bool) -> f64 {
    f64::from(u8::from(truth))
}

#[inline]
fn finite(x: f64) -> Result<f64, ValueFault> {
    // Adding zero takes the sign from −0.
    if x.is_finite() { Ok(x + 0.0) } else { Err(ValueFault::NotFinite) }
}

#[inline]
fn equal(left: Option<f64>, right: Option<f64>, semantics: &Semantics) -> bool {
    if semantics.unset == Unset::Vacant && left.is_none() != right.is_none() {
        return false;
    }
    is_equal_distance((left.unwrap_or(0.0) - right.unwrap_or(0.0)).abs(), semantics)
}

fn modulo(a: f64, b: f64, semantics: &Semantics) -> Result<f64, ValueFault> {
    if b == 0.0 {
        return Err(ValueFault::DivisionByZero);
    }
    let remainder = a % b;
    let negative = remainder < 0.0 && modulo_is_never_negative(semantics);
    finite(if negative { remainder + b.abs() } else { remainder })
}

fn power(base: f64, exponent: f64) -> Result<f64, ValueFault> {
    if base < 0.0 && exponent.fract() != 0.0 {
        return Err(ValueFault::NegativePower);
    }
    finite(base.powf(exponent))
}

fn logic(op: BinaryOp, a: f64, b: f64, semantics: &Semantics) -> f64 {
    if !semantics.logic_on_bits {
        let (a, b) = (a != 0.0, b != 0.0);
        return number(match op {
            BinaryOp::And => a && b,
            BinaryOp::Or => a || b,
            _ => a != b,
        });
    }
    let (a, b) = (bits(a), bits(b));
    from_bits(match op {
        BinaryOp::And => a & b,
        BinaryOp::Or => a | b,
        _ => a ^ b,
    })
}

/// The whole part in two's complement; numbers beyond 64 bits stop at the end.
#[inline]
pub(crate) fn bits(x: f64) -> i64 {
    x as i64
}

#[expect(
    clippy::cast_precision_loss,
    reason = "a number that came from an f64 beyond 2^53 was as coarse before"
)]
#[inline]
pub(crate) fn from_bits(x: i64) -> f64 {
    x as f64
}

fn unary(function: Function, x: f64, semantics: &Semantics) -> Result<f64, ValueFault> {
    finite(match function {
        Function::Abs => x.abs(),
        Function::Acos | Function::Asin if x.abs() > 1.0 => return Err(ValueFault::ArcFunctionRange),
        Function::Acos => arc_cosine(x),
        Function::Asin => arc_sine(x),
        Function::Atan => arc_tangent_of_two(x, 1.0),
        Function::Bcd => to_bcd(x)?,
        Function::Bin => from_bcd(x)?,
        Function::Cos => sine_and_cosine(x, semantics).1,
        Function::Exp => x.exp(),
        Function::Fix => round_down(x, semantics),
        Function::Fup => round_up(x, semantics),
        Function::Ln if x <= 0.0 => return Err(ValueFault::LogarithmOfNonPositive),
        Function::Ln => x.ln(),
        Function::Not => number(x == 0.0),
        Function::Round => x.round(),
        Function::Sin => sine_and_cosine(x, semantics).0,
        Function::Sqrt if x < 0.0 => return Err(ValueFault::NegativeRoot),
        Function::Sqrt => x.sqrt(),
        Function::Tan => return tangent(x, semantics),
        Function::Exists => return Err(ValueFault::Malformed),
        Function::Pow => return Err(ValueFault::NoSuchFunction),
    })
}

/// In degrees; exact for a half, the one value that radians would miss by a last digit: programs round such results.
fn arc_sine(x: f64) -> f64 {
    if x.abs() - 0.5 == 0.0 { 30.0_f64.copysign(x) } else { x.asin().to_degrees() }
}

/// As [`arc_sine`].
fn arc_cosine(x: f64) -> f64 {
    if x.abs() - 0.5 == 0.0 { 90.0 - 30.0_f64.copysign(x) } else { x.acos().to_degrees() }
}

/// The direction of `(x, y)` in degrees, −180 to 180, 0 for the origin; exact on the axes and diagonals.
///
/// The books of controls with `ATAN[y]/[x]` on a parameter give 0 to 360 as the other choice; the data has no entry for it.
fn arc_tangent_of_two(y: f64, x: f64) -> f64 {
    if y == 0.0 {
        return if x < 0.0 { 180.0 } else { 0.0 };
    }
    if x == 0.0 {
        return 90.0_f64.copysign(y);
    }
    if (y.abs() - x.abs()) == 0.0 {
        return if x < 0.0 { 135.0 } else { 45.0_f64 }.copysign(y);
    }
    y.atan2(x).to_degrees()
}

/// Sine and cosine of an angle in degrees.
///
/// The angle is reduced in degrees, where that is exact, so that `SIN[30]` is a half and `FIX[SIN[30]*2]` is 1. At
/// multiples of 90 what should be zero is zero, but for controls that compute with binary numbers: see [`RESIDUE`].
fn sine_and_cosine(degrees: f64, semantics: &Semantics) -> (f64, f64) {
    let turn = degrees % 360.0;
    let quarter = (turn / 90.0).round();
    let rest = turn - quarter * 90.0;
    let (mut sine, cosine) = small_sine_and_cosine(rest);
    if rest == 0.0 && semantics.fix == Fix::NumberLine && degrees.abs() < RESIDUE_COUNTS {
        sine = degrees.to_radians() * RESIDUE;
    }
    match bits(quarter).rem_euclid(4) {
        0 => (sine, cosine),
        1 => (cosine, -sine),
        2 => (-sine, -cosine),
        _ => (-cosine, sine),
    }
}

/// By what part the reference interpreter's π (64 bits of mantissa) is too large. It is why `SIN[180]` is a little below zero
/// there, `TAN[90]` a large negative number and no fault.
const RESIDUE: f64 = 1.596_82e-20;
/// Degrees from which on rounding, which we do not follow there, outweighs it.
const RESIDUE_COUNTS: f64 = 3600.0;

/// For −45 to 45 degrees.
fn small_sine_and_cosine(degrees: f64) -> (f64, f64) {
    let (sine, cosine) = degrees.to_radians().sin_cos();
    if degrees.abs() - 30.0 == 0.0 {
        (0.5_f64.copysign(degrees), cosine)
    } else if degrees.abs() - 45.0 == 0.0 {
        // So that `TAN[45]` is 1.
        (FRAC_1_SQRT_2.copysign(degrees), FRAC_1_SQRT_2)
    } else {
        (sine, cosine)
    }
}

fn tangent(degrees: f64, semantics: &Semantics) -> Result<f64, ValueFault> {
    let (sine, cosine) = sine_and_cosine(degrees, semantics);
    // The books define TAN as SIN by COS.
    if cosine == 0.0 { Err(ValueFault::DivisionByZero) } else { finite(sine / cosine) }
}

/// The largest number of digits whose BCD form an f64 holds exactly.
const BCD_DIGITS: u32 = 13;

/// The whole number whose hexadecimal digits are the decimal digits of `x`.
fn to_bcd(x: f64) -> Result<f64, ValueFault> {
    let mut rest = whole(x, 10_i64.pow(BCD_DIGITS))?;
    let mut out = 0;
    for place in 0..BCD_DIGITS {
        out |= (rest % 10) << (4 * place);
        rest /= 10;
    }
    Ok(from_bits(out))
}

/// The whole number whose decimal digits are the hexadecimal digits of `x`.
fn from_bcd(x: f64) -> Result<f64, ValueFault> {
    let rest = whole(x, 1 << (4 * BCD_DIGITS))?;
    let mut out = 0;
    for place in (0..BCD_DIGITS).rev() {
        let digit = (rest >> (4 * place)) & 0xF;
        if digit > 9 {
            return Err(ValueFault::NotFinite);
        }
        out = out * 10 + digit;
    }
    Ok(from_bits(out))
}

/// The whole part of a number that is not negative and below `limit`.
fn whole(x: f64, limit: i64) -> Result<i64, ValueFault> {
    let whole = bits(x);
    if (0..limit).contains(&whole) { Ok(whole) } else { Err(ValueFault::NotFinite) }
}

#[cfg(test)]
mod tests;
