//! Values of a run.
//!
//! Knows: numbers, nothing, and values that are not known. Must not know: what an operator gives on numbers (`scalar`).

use std::hash::{Hash, Hasher};

use gcheck_controls::Semantics;
use gcheck_program::{BinaryOp, Function};

use super::{Domain, Truth, scalar};
use crate::fault::ValueFault;
use crate::lattice::flat_lattice;

/// The domain of a run.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Concrete;

/// A value of a run.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub enum ConcreteValue {
    /// Nothing: a variable never set, where that is not zero.
    Vacant,
    /// A finite number; zero has no sign.
    Number(f64),
    /// One number or nothing, but nobody knows which: a probed position, a timer.
    #[default]
    Unknown,
}

// Numbers are finite, so equality is reflexive.
impl Eq for ConcreteValue {}

impl Hash for ConcreteValue {
    fn hash<H: Hasher>(&self, state: &mut H) {
        match self {
            Self::Vacant => state.write_u64(VACANT_BITS),
            Self::Number(x) => state.write_u64(x.to_bits()),
            Self::Unknown => state.write_u64(UNKNOWN_BITS),
        }
    }
}

// Two patterns of bits that are no finite number.
const VACANT_BITS: u64 = u64::MAX;
const UNKNOWN_BITS: u64 = u64::MAX - 1;

impl ConcreteValue {
    /// The number or nothing that `scalar` computes with; the outer `None` if nobody knows it.
    #[expect(clippy::option_option, reason = "outside: does anybody know it; inside: number or nothing")]
    #[inline]
    fn scalar(self) -> Option<Option<f64>> {
        match self {
            Self::Number(x) => Some(Some(x)),
            Self::Vacant => Some(None),
            Self::Unknown => None,
        }
    }

    /// Is it a number that counts as zero?
    fn is_zero(self) -> bool {
        match self {
            Self::Number(x) => x == 0.0,
            Self::Vacant => true,
            Self::Unknown => false,
        }
    }
}

impl Domain for Concrete {
    type Value = ConcreteValue;

    #[inline]
    fn number(value: f64) -> ConcreteValue {
        if value.is_finite() { ConcreteValue::Number(value + 0.0) } else { ConcreteValue::Unknown }
    }

    #[inline]
    fn vacant() -> ConcreteValue {
        ConcreteValue::Vacant
    }

    #[inline]
    fn unknown() -> ConcreteValue {
        ConcreteValue::Unknown
    }

    #[inline]
    fn known(value: &ConcreteValue) -> Option<f64> {
        match *value {
            ConcreteValue::Number(x) => Some(x),
            ConcreteValue::Vacant | ConcreteValue::Unknown => None,
        }
    }

    #[inline]
    fn is_vacant(value: &ConcreteValue) -> Truth {
        match value {
            ConcreteValue::Vacant => Truth::True,
            ConcreteValue::Number(_) => Truth::False,
            ConcreteValue::Unknown => Truth::Unknown,
        }
    }

    #[inline]
    fn bounds(value: &ConcreteValue) -> Option<(f64, f64)> {
        Self::known(value).map(|x| (x, x))
    }

    #[inline]
    fn binary(
        op: BinaryOp,
        left: &ConcreteValue,
        right: &ConcreteValue,
        semantics: &Semantics,
    ) -> Result<ConcreteValue, ValueFault> {
        match (left.scalar(), right.scalar()) {
            (Some(a), Some(b)) => scalar::binary(op, a, b, semantics).map(ConcreteValue::Number),
            _ => binary_of_unknown(op, *left, *right, semantics),
        }
    }

    fn call(
        function: Function,
        arguments: &[ConcreteValue],
        semantics: &Semantics,
    ) -> Result<ConcreteValue, ValueFault> {
        scalar::check_arity(function, arguments.len(), semantics)?;
        let result = match *arguments {
            [x] => x.scalar().map(|x| scalar::call(function, &[x], semantics)),
            [x, y] => match (x.scalar(), y.scalar()) {
                (Some(x), Some(y)) => Some(scalar::call(function, &[x, y], semantics)),
                _ => None,
            },
            _ => None,
        };
        match result {
            Some(result) => result.map(ConcreteValue::Number),
            None => Ok(ConcreteValue::Unknown),
        }
    }

    #[inline]
    fn negate(value: &ConcreteValue) -> ConcreteValue {
        match *value {
            // Not `-x`: zero has no sign.
            ConcreteValue::Number(x) => ConcreteValue::Number(0.0 - x),
            other => other,
        }
    }

    #[inline]
    fn truth(value: &ConcreteValue) -> Truth {
        match *value {
            ConcreteValue::Number(x) => Truth::from(x != 0.0),
            ConcreteValue::Vacant => Truth::False,
            ConcreteValue::Unknown => Truth::Unknown,
        }
    }

    fn assume(
        value: &ConcreteValue,
        op: BinaryOp,
        bound: f64,
        semantics: &Semantics,
    ) -> Option<ConcreteValue> {
        match value.scalar() {
            Some(x) if super::is_comparison(op) => {
                scalar::compare(op, x, Some(bound), semantics).then_some(*value)
            }
            _ => Some(*value),
        }
    }

    fn assume_vacant(value: &ConcreteValue, vacant: bool) -> Option<ConcreteValue> {
        match (value, vacant) {
            (ConcreteValue::Vacant, false) | (ConcreteValue::Number(_), true) => None,
            (ConcreteValue::Unknown, true) => Some(ConcreteValue::Vacant),
            _ => Some(*value),
        }
    }
}

flat_lattice!(ConcreteValue);

/// An operator whose result may be certain though an operand is not known.
#[cold]
fn binary_of_unknown(
    op: BinaryOp,
    left: ConcreteValue,
    right: ConcreteValue,
    semantics: &Semantics,
) -> Result<ConcreteValue, ValueFault> {
    let one_is_zero = left.is_zero() || right.is_zero();
    let one_is_true = Concrete::truth(&left) == Truth::True || Concrete::truth(&right) == Truth::True;
    match op {
        BinaryOp::Divide | BinaryOp::Modulo if right.is_zero() => Err(ValueFault::DivisionByZero),
        BinaryOp::Multiply | BinaryOp::And if one_is_zero => Ok(ConcreteValue::Number(0.0)),
        BinaryOp::Or if one_is_true && !semantics.logic_on_bits => Ok(ConcreteValue::Number(1.0)),
        _ => Ok(ConcreteValue::Unknown),
    }
}

#[cfg(test)]
mod tests;
