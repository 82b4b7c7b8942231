//! Operators and functions on intervals.
//!
//! Knows: bounds of what `scalar` gives for operands within bounds. Must not know: vacancy, sets.
//!
//! Bounds hold for the numbers a run computes, with their rounding. Sums, products, quotients, roots and whole parts are
//! rounded correctly, therefore monotonic, and their bounds are the results at the bounds, exactly: a counter stays whole.
//! Only what the mathematics library approximates is bounded a few last digits further out ([`Range::slack`]).

use gcheck_controls::Semantics;
use gcheck_program::{BinaryOp, Function};

use super::super::{Truth, scalar};
use crate::fault::ValueFault;

/// Numbers from `lo` to `hi`, either of which may be infinite. `lo` ≤ `hi`, and neither is NaN.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Range {
    pub(super) lo: f64,
    pub(super) hi: f64,
}

/// Bounds that a growing interval stops at, before infinity. With the signs and zero a bound moves 17 times at most.
const THRESHOLDS: [f64; 8] = [0.0, 1.0, 10.0, 100.0, 1e3, 1e4, 1e5, 1e6];

impl Range {
    pub(super) const ALL: Self = Self { lo: f64::NEG_INFINITY, hi: f64::INFINITY };
    const NOT_NEGATIVE: Self = Self { lo: 0.0, hi: f64::INFINITY };
    const HALF_TURN: Self = Self { lo: -90.0, hi: 90.0 };

    pub(super) fn point(x: f64) -> Self {
        Self { lo: x, hi: x }
    }

    /// The smallest that holds all of them, NaN left out; none leaves everything possible.
    fn of(numbers: impl IntoIterator<Item = f64>) -> Self {
        let mut out = Self { lo: f64::INFINITY, hi: f64::NEG_INFINITY };
        for x in numbers {
            out = Self { lo: out.lo.min(x), hi: out.hi.max(x) };
        }
        if out.lo <= out.hi { out } else { Self::ALL }
    }

    pub(super) fn hull(self, other: Self) -> Self {
        Self { lo: self.lo.min(other.lo), hi: self.hi.max(other.hi) }
    }

    /// The part within `other`.
    fn clip(self, other: Self) -> Option<Self> {
        let out = Self { lo: self.lo.max(other.lo), hi: self.hi.min(other.hi) };
        (out.lo <= out.hi).then_some(out)
    }

    fn contains(self, x: f64) -> bool {
        self.lo <= x && x <= self.hi
    }

    /// The largest distance from zero.
    fn magnitude(self) -> f64 {
        self.lo.abs().max(self.hi.abs())
    }

    fn map(self, f: impl Fn(f64) -> f64) -> Self {
        Self { lo: f(self.lo), hi: f(self.hi) }
    }

    /// Further out by the error of a library function.
    fn slack(self) -> Self {
        let mut out = self;
        for _ in 0..4 {
            out = Self { lo: out.lo.next_down(), hi: out.hi.next_up() };
        }
        out
    }

    /// `after`, but a bound that lies beyond this range's goes on to the next threshold.
    pub(super) fn widened_to(self, after: Self) -> Self {
        Self {
            lo: if after.lo < self.lo { -threshold_above(-after.lo) } else { after.lo },
            hi: if after.hi > self.hi { threshold_above(after.hi) } else { after.hi },
        }
    }

    /// The numbers of which the comparison with `bound` holds: perhaps a few more, never fewer.
    pub(super) fn assume(self, op: BinaryOp, bound: f64, semantics: &Semantics) -> Option<Self> {
        match op {
            BinaryOp::Greater => self.clip(Self { lo: bound.next_up(), hi: f64::INFINITY }),
            BinaryOp::GreaterEqual => self.clip(Self { lo: bound, hi: f64::INFINITY }),
            BinaryOp::Less => self.clip(Self { lo: f64::NEG_INFINITY, hi: bound.next_down() }),
            BinaryOp::LessEqual => self.clip(Self { lo: f64::NEG_INFINITY, hi: bound }),
            BinaryOp::Equal if semantics.equal_within > 0.0 => {
                // The distance that `EQ` sees is rounded, and so are these bounds: two last digits of each is enough.
                let within = semantics.equal_within.next_up().next_up();
                let (lo, hi) = (bound - within, bound + within);
                self.clip(Self { lo: lo.next_down().next_down(), hi: hi.next_up().next_up() })
            }
            BinaryOp::Equal => self.clip(Self::point(bound)),
            BinaryOp::NotEqual => self.without(bound, semantics),
            _ => Some(self),
        }
    }

    /// Without the numbers equal to `bound`, where they lie at an end.
    fn without(self, bound: f64, semantics: &Semantics) -> Option<Self> {
        let equal = |x: f64| scalar::is_equal_distance((x - bound).abs(), semantics);
        let (near_below, near_above) = if semantics.equal_within > 0.0 {
            let within = semantics.equal_within.next_down().next_down();
            let (lo, hi) = (bound - within, bound + within);
            (lo.next_up().next_up(), hi.next_down().next_down())
        } else {
            (bound.next_down(), bound.next_up())
        };
        let lo = if equal(self.lo) { self.lo.max(near_above) } else { self.lo };
        let hi = if equal(self.hi) { self.hi.min(near_below) } else { self.hi };
        if equal(self.lo) && equal(self.hi) { None } else { self.clip(Self { lo, hi }) }
    }
}

/// The nearest threshold that is not below `x`.
fn threshold_above(x: f64) -> f64 {
    let (negative, positive) = (THRESHOLDS.into_iter().rev().map(|t| -t), THRESHOLDS.into_iter());
    negative.chain(positive).find(|t| *t >= x).unwrap_or(f64::INFINITY)
}

/// An operator that gives a number.
pub(super) fn binary(op: BinaryOp, a: Range, b: Range, semantics: &Semantics) -> Result<Range, ValueFault> {
    let corners =
        |f: fn(f64, f64) -> f64| Range::of([f(a.lo, b.lo), f(a.lo, b.hi), f(a.hi, b.lo), f(a.hi, b.hi)]);
    finite(match op {
        BinaryOp::Add => Range { lo: a.lo + b.lo, hi: a.hi + b.hi },
        BinaryOp::Subtract => Range { lo: a.lo - b.hi, hi: a.hi - b.lo },
        // Zero times infinity: the infinity stands for finite numbers.
        BinaryOp::Multiply => corners(|x, y| if x == 0.0 || y == 0.0 { 0.0 } else { x * y }),
        BinaryOp::Divide | BinaryOp::Modulo if b == Range::point(0.0) => {
            return Err(ValueFault::DivisionByZero);
        }
        BinaryOp::Divide if b.contains(0.0) => Range::ALL,
        BinaryOp::Divide => corners(|x, y| x / y),
        BinaryOp::Modulo => modulo(a, b, semantics),
        BinaryOp::Power => return power(a, b),
        BinaryOp::And | BinaryOp::Or | BinaryOp::Xor => logic_on_bits(op, a, b),
        _ => Range { lo: 0.0, hi: 1.0 },
    })
}

/// A function of one argument.
pub(super) fn unary(function: Function, x: Range, semantics: &Semantics) -> Result<Range, ValueFault> {
    let unit = Range { lo: -1.0, hi: 1.0 };
    finite(match function {
        Function::Abs => {
            let nearest = if x.contains(0.0) { 0.0 } else { x.lo.abs().min(x.hi.abs()) };
            Range { lo: nearest, hi: x.magnitude() }
        }
        Function::Fix => x.map(|x| scalar::round_down(x, semantics)),
        Function::Fup => x.map(|x| scalar::round_up(x, semantics)),
        Function::Round => x.map(f64::round),
        Function::Sqrt => x.clip(Range::NOT_NEGATIVE).ok_or(ValueFault::NegativeRoot)?.map(f64::sqrt),
        Function::Exp => within(x.map(f64::exp).slack(), Range::NOT_NEGATIVE),
        Function::Ln if x.hi <= 0.0 => return Err(ValueFault::LogarithmOfNonPositive),
        Function::Ln => {
            // The smallest number above zero has a logarithm too.
            let smallest = f64::from_bits(1);
            Range { lo: x.lo.max(smallest), hi: x.hi }.map(f64::ln).slack()
        }
        Function::Asin => {
            let x = x.clip(unit).ok_or(ValueFault::ArcFunctionRange)?;
            within(x.map(|x| x.asin().to_degrees()).slack(), Range::HALF_TURN)
        }
        Function::Acos => {
            let x = x.clip(unit).ok_or(ValueFault::ArcFunctionRange)?;
            let turned = Range { lo: x.hi, hi: x.lo }.map(|x| x.acos().to_degrees());
            within(turned.slack(), Range { lo: 0.0, hi: 180.0 })
        }
        Function::Atan => within(x.map(|x| x.atan().to_degrees()).slack(), Range::HALF_TURN),
        Function::Sin | Function::Cos => unit,
        Function::Bin | Function::Bcd if x.hi <= -1.0 => return Err(ValueFault::NotFinite),
        Function::Bin | Function::Bcd => Range::NOT_NEGATIVE,
        Function::Not => Range { lo: 0.0, hi: 1.0 },
        Function::Tan => Range::ALL,
        Function::Pow => return Err(ValueFault::NoSuchFunction),
        Function::Exists => return Err(ValueFault::Malformed),
    })
}

/// `ATAN[y]/[x]`: the half or quarter plane.
pub(super) fn arc_tangent_of_two(y: Range, x: Range) -> Range {
    let lo = if y.lo >= 0.0 {
        0.0
    } else if x.lo >= 0.0 {
        -90.0
    } else {
        -180.0
    };
    let hi = match (y.hi < 0.0, x.lo >= 0.0) {
        (true, _) => 0.0,
        (false, true) => 90.0,
        (false, false) => 180.0,
    };
    Range { lo, hi }
}

/// A comparison of numbers.
pub(super) fn compare(op: BinaryOp, a: Range, b: Range, semantics: &Semantics) -> Truth {
    let decide = |always: bool, never: bool| match (always, never) {
        (true, _) => Truth::True,
        (false, true) => Truth::False,
        (false, false) => Truth::Unknown,
    };
    let equal = || {
        let nearest = (a.lo - b.hi).max(b.lo - a.hi).max(0.0);
        let farthest = (a.hi - b.lo).max(b.hi - a.lo);
        decide(scalar::is_equal_distance(farthest, semantics), !scalar::is_equal_distance(nearest, semantics))
    };
    match op {
        BinaryOp::Equal => equal(),
        BinaryOp::NotEqual => !equal(),
        BinaryOp::Greater => decide(a.lo > b.hi, a.hi <= b.lo),
        BinaryOp::GreaterEqual => decide(a.lo >= b.hi, a.hi < b.lo),
        BinaryOp::Less => decide(a.hi < b.lo, a.lo >= b.hi),
        BinaryOp::LessEqual => decide(a.hi <= b.lo, a.lo > b.hi),
        _ => Truth::Unknown,
    }
}

/// A result that no finite number can be is a fault; one infinite bound only says that we do not know the end.
fn finite(range: Range) -> Result<Range, ValueFault> {
    if range.lo == f64::INFINITY || range.hi == f64::NEG_INFINITY {
        Err(ValueFault::NotFinite)
    } else {
        Ok(range)
    }
}

/// Cut to what the function can give at all.
fn within(range: Range, limits: Range) -> Range {
    range.clip(limits).unwrap_or(limits)
}

fn modulo(a: Range, b: Range, semantics: &Semantics) -> Range {
    let most = b.magnitude();
    let least = if b.contains(0.0) { 0.0 } else { b.lo.abs().min(b.hi.abs()) };
    if a.magnitude() < least && (a.lo >= 0.0 || !scalar::modulo_is_never_negative(semantics)) {
        return a;
    }
    if scalar::modulo_is_never_negative(semantics) {
        // A dividend a little below zero can round up to the divisor itself.
        return Range { lo: 0.0, hi: if a.lo >= 0.0 { most.min(a.hi) } else { most } };
    }
    Range { lo: a.lo.clamp(-most, 0.0), hi: a.hi.clamp(0.0, most) }
}

fn power(base: Range, exponent: Range) -> Result<Range, ValueFault> {
    let whole = exponent.lo.fract() == 0.0 && exponent.lo - exponent.hi == 0.0;
    if base.hi < 0.0 && !whole && exponent.lo - exponent.hi == 0.0 {
        return Err(ValueFault::NegativePower);
    }
    let corners = |base: Range| {
        let bounds =
            [(base.lo, exponent.lo), (base.lo, exponent.hi), (base.hi, exponent.lo), (base.hi, exponent.hi)];
        Range::of(bounds.into_iter().map(|(x, y)| x.powf(y))).slack()
    };
    // Where no base is negative the power is monotonic in both operands, one after the other; at 0 it needs an exponent
    // that is not negative.
    if base.lo > 0.0 || base.lo >= 0.0 && exponent.lo >= 0.0 {
        return finite(within(corners(base), Range::NOT_NEGATIVE));
    }
    if !whole || exponent.lo < 0.0 && base.contains(0.0) {
        return Ok(Range::ALL);
    }
    let odd = (exponent.lo % 2.0) != 0.0;
    let extremes = corners(base);
    // An even power has its smallest value at 0.
    finite(if !odd && base.contains(0.0) {
        extremes.hull(Range::point(if exponent.lo == 0.0 { 1.0 } else { 0.0 }))
    } else {
        extremes
    })
}

/// Up to here an f64 holds every whole number (2⁵³).
const EXACT: f64 = 9_007_199_254_740_992.0;

/// `AND`, `OR`, `XOR` of whole parts.
fn logic_on_bits(op: BinaryOp, a: Range, b: Range) -> Range {
    let whole = |x: Range| Range { lo: x.lo.trunc(), hi: x.hi.trunc() };
    let (a, b) = (whole(a), whole(b));
    match op {
        // One operand without a sign takes it from the other.
        BinaryOp::And if a.lo >= 0.0 && b.lo >= 0.0 => Range { lo: 0.0, hi: a.hi.min(b.hi) },
        BinaryOp::And if a.lo >= 0.0 => Range { lo: 0.0, hi: a.hi },
        BinaryOp::And if b.lo >= 0.0 => Range { lo: 0.0, hi: b.hi },
        BinaryOp::Or | BinaryOp::Xor if a.lo >= 0.0 && b.lo >= 0.0 => {
            if a.hi.max(b.hi) > EXACT {
                return Range::NOT_NEGATIVE;
            }
            // No bit above the highest of either; the sum has them all.
            let lo = if op == BinaryOp::Or { a.lo.max(b.lo) } else { 0.0 };
            Range { lo, hi: a.hi + b.hi }
        }
        _ => Range::ALL,
    }
}
