//! Value domains: what a variable, an expression and a word may hold.
//!
//! Knows: that there is one semantics of operators (`scalar`), which every domain lifts. Must not know: blocks, variables'
//! meaning, motion.
//!
//! In both domains a number is finite and zero has no sign: `-0` would compare equal to `0` and yet turn
//! `ATAN[-0]/[-1]` around, so that equal states could go on differently.

mod abstract_value;
mod concrete;
mod scalar;

use std::fmt::Debug;

use gcheck_controls::Semantics;
use gcheck_program::{BinaryOp, Function};

use crate::fault::ValueFault;
use crate::lattice::{Lattice, flat_lattice};

pub use abstract_value::{Abstract, AbstractValue, NumberSet};
pub use concrete::{Concrete, ConcreteValue};
pub use scalar::takes_arguments;

/// An answer that may be out of reach.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Truth {
    /// Certainly.
    True,
    /// Certainly not.
    False,
    /// Either.
    Unknown,
}

impl From<bool> for Truth {
    fn from(answer: bool) -> Self {
        if answer { Self::True } else { Self::False }
    }
}

flat_lattice!(Truth);

impl std::ops::Not for Truth {
    type Output = Self;

    fn not(self) -> Self {
        match self {
            Self::True => Self::False,
            Self::False => Self::True,
            Self::Unknown => Self::Unknown,
        }
    }
}

/// A domain of values.
///
/// `Concrete` is for a run: a number, nothing (vacant), or a value that nobody knows. `Abstract` is for all paths: it adds
/// intervals and small sets.
pub trait Domain: Clone + Copy + Debug + Default + PartialEq + 'static {
    /// A value.
    type Value: Clone + Debug + PartialEq + Lattice;

    /// A number. One that is not finite has no place in a domain and is unknown.
    fn number(value: f64) -> Self::Value;
    /// Nothing: the value of a variable never set, on controls where that is not zero.
    fn vacant() -> Self::Value;
    /// Any number, or nothing.
    fn unknown() -> Self::Value;

    /// A value that rests on something nobody told: a run goes on with it, all paths allow any other.
    fn assumed(value: Self::Value) -> Self::Value {
        value
    }

    /// The number, if it is exactly known.
    fn known(value: &Self::Value) -> Option<f64>;
    /// Is it nothing?
    fn is_vacant(value: &Self::Value) -> Truth;
    /// Smallest and largest number it may be (one of them may be infinite); `None` if it may be any number, or nothing.
    fn bounds(value: &Self::Value) -> Option<(f64, f64)>;

    /// The value of an operator.
    ///
    /// # Errors
    /// A fault that happens for every number the operands may be.
    fn binary(
        op: BinaryOp,
        left: &Self::Value,
        right: &Self::Value,
        semantics: &Semantics,
    ) -> Result<Self::Value, ValueFault>;
    /// The value of a function. `ATAN` takes one or two arguments, the others one (`POW` two). `EXISTS` asks about a name
    /// and not about a value: the caller answers it.
    ///
    /// # Errors
    /// A fault that happens for every number the arguments may be.
    fn call(
        function: Function,
        arguments: &[Self::Value],
        semantics: &Semantics,
    ) -> Result<Self::Value, ValueFault>;
    /// The value with its sign changed; nothing stays nothing.
    fn negate(value: &Self::Value) -> Self::Value;
    /// Is the value a condition that holds?
    fn truth(value: &Self::Value) -> Truth;

    /// What is left of `value` when comparing it so with a known number held. `None` if nothing is left. An operator that
    /// compares nothing leaves the value as it is.
    fn assume(value: &Self::Value, op: BinaryOp, bound: f64, semantics: &Semantics) -> Option<Self::Value>;
    /// What is left of `value` when it turned out to be nothing, or not to be: `#1 EQ #0`, `#1 NE #0`. `None` if nothing
    /// is left.
    fn assume_vacant(value: &Self::Value, vacant: bool) -> Option<Self::Value>;
}

/// Does the operator compare?
fn is_comparison(op: BinaryOp) -> bool {
    matches!(
        op,
        BinaryOp::Equal
            | BinaryOp::NotEqual
            | BinaryOp::Greater
            | BinaryOp::GreaterEqual
            | BinaryOp::Less
            | BinaryOp::LessEqual
    )
}
