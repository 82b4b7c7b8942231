//! Values of all paths: what a variable may hold, as a few numbers or an interval.
//!
//! Knows: how sets of values are represented, joined, widened and refined. Must not know: what an operator gives on single
//! values (`scalar`); how it acts on intervals is in `interval`.
//!
//! A value has one form only: equal sets of values compare equal and hash alike.

mod interval;
#[cfg(test)]
mod tests;

use std::hash::{Hash, Hasher};
use std::sync::{Arc, LazyLock};

use gcheck_controls::Semantics;
use gcheck_program::{BinaryOp, Function};

use self::interval::Range;
use super::{ConcreteValue, Domain, Truth, is_comparison, scalar};
use crate::fault::ValueFault;
use crate::lattice::Lattice;

/// The domain of all paths.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Abstract;

/// What a value may be on some path.
///
/// Build it with [`Domain`]'s functions, [`AbstractValue::numbers`] and [`AbstractValue::interval`]: they keep the one form.
#[derive(Debug, Clone, PartialEq, Default)]
pub enum AbstractValue {
    /// Nothing.
    Vacant,
    /// This number.
    Number(f64),
    /// One of a few numbers, perhaps nothing.
    Set(NumberSet),
    /// Any number of an interval, perhaps nothing.
    Interval {
        /// Smallest number, or −∞.
        lo: f64,
        /// Largest number, or ∞; above `lo`.
        hi: f64,
        /// It may be nothing too.
        vacant: bool,
    },
    /// Any number, or nothing.
    #[default]
    Unknown,
}

/// Up to [`NumberSet::MOST`] numbers, and perhaps nothing.
#[derive(Debug, Clone, PartialEq)]
pub struct NumberSet {
    /// Ascending, without repetition, at least one; at least two when `vacant` is not set.
    numbers: Arc<[f64]>,
    vacant: bool,
}

impl NumberSet {
    /// So many numbers a set holds; more become an interval.
    pub const MOST: usize = 8;

    /// The numbers, ascending.
    pub fn numbers(&self) -> &[f64] {
        &self.numbers
    }

    /// May it be nothing too?
    pub fn vacant(&self) -> bool {
        self.vacant
    }
}

// Numbers are finite and zero has no sign, so equality is reflexive and goes with the bits.
impl Eq for AbstractValue {}

impl Hash for AbstractValue {
    fn hash<H: Hasher>(&self, state: &mut H) {
        std::mem::discriminant(self).hash(state);
        match self {
            Self::Vacant | Self::Unknown => {}
            Self::Number(x) => x.to_bits().hash(state),
            Self::Set(set) => {
                set.vacant.hash(state);
                for x in set.numbers.iter() {
                    x.to_bits().hash(state);
                }
            }
            Self::Interval { lo, hi, vacant } => (lo.to_bits(), hi.to_bits(), vacant).hash(state),
        }
    }
}

impl AbstractValue {
    /// One of these numbers; with `vacant`, perhaps nothing. More than [`NumberSet::MOST`] become the interval that holds
    /// them, a number that is not finite makes it unknown, and so does having neither a number nor vacancy.
    pub fn numbers(numbers: impl IntoIterator<Item = f64>, vacant: bool) -> Self {
        // Adding zero takes the sign from −0.
        let mut numbers: Vec<f64> = numbers.into_iter().map(|x| x + 0.0).collect();
        if !numbers.iter().all(|x| x.is_finite()) {
            return Self::Unknown;
        }
        numbers.sort_unstable_by(f64::total_cmp);
        numbers.dedup_by(|a, b| a.to_bits() == b.to_bits());
        match (numbers.as_slice(), vacant) {
            ([], true) => Self::Vacant,
            ([], false) => Self::Unknown,
            ([x], false) => Self::Number(*x),
            ([lo, .., hi], _) if numbers.len() > NumberSet::MOST => {
                Self::Interval { lo: *lo, hi: *hi, vacant }
            }
            _ => Self::Set(NumberSet { numbers: numbers.into(), vacant }),
        }
    }

    /// Any number from `lo` to `hi`, which may be infinite; with `vacant`, perhaps nothing. Bounds that leave no number make
    /// it unknown.
    pub fn interval(lo: f64, hi: f64, vacant: bool) -> Self {
        let (lo, hi) = (lo + 0.0, hi + 0.0);
        if lo < hi {
            let endless = lo == f64::NEG_INFINITY && hi == f64::INFINITY;
            if endless && vacant { Self::Unknown } else { Self::Interval { lo, hi, vacant } }
        } else if lo <= hi {
            Self::numbers([lo], vacant)
        } else {
            Self::Unknown
        }
    }

    /// Nothing that a run could find: every value covers it.
    pub(crate) fn none() -> Self {
        Self::Set(NumberSet { numbers: Arc::from([]), vacant: false })
    }

    /// Any number, but not nothing: what arithmetic gives on what is not known.
    pub fn any_number() -> Self {
        Self::Interval { lo: f64::NEG_INFINITY, hi: f64::INFINITY, vacant: false }
    }

    /// Does the value of a run agree with it? A value that the run does not know contradicts nothing.
    pub fn allows(&self, value: ConcreteValue) -> bool {
        match value {
            ConcreteValue::Vacant => self.may_be_vacant(),
            ConcreteValue::Number(x) => self.may_be_number(x),
            ConcreteValue::Unknown => true,
        }
    }

    /// 0, 1, or either.
    fn from_truth(truth: Truth) -> Self {
        static EITHER: LazyLock<AbstractValue> = LazyLock::new(|| AbstractValue::numbers([0.0, 1.0], false));
        match truth {
            Truth::True => Self::Number(1.0),
            Truth::False => Self::Number(0.0),
            Truth::Unknown => EITHER.clone(),
        }
    }

    /// May it be nothing, as an unset variable is on some controls?
    pub fn may_be_vacant(&self) -> bool {
        match self {
            Self::Vacant | Self::Unknown => true,
            Self::Number(_) => false,
            Self::Set(set) => set.vacant,
            Self::Interval { vacant, .. } => *vacant,
        }
    }

    fn may_be_number(&self, x: f64) -> bool {
        match self {
            Self::Vacant => false,
            Self::Unknown => true,
            _ => match self.few() {
                Some(numbers) => numbers.iter().any(|y| (y - x) == 0.0),
                None => self.range().is_some_and(|range| range.lo <= x && x <= range.hi),
            },
        }
    }

    /// The numbers, where they are few.
    fn few(&self) -> Option<&[f64]> {
        match self {
            Self::Vacant => Some(&[]),
            Self::Number(x) => Some(std::slice::from_ref(x)),
            Self::Set(set) => Some(&set.numbers),
            Self::Interval { .. } | Self::Unknown => None,
        }
    }

    /// All that it may be, where that is not many.
    fn points(&self) -> Option<Points<'_>> {
        Some(Points { numbers: self.few()?, vacant: self.may_be_vacant() })
    }

    /// Smallest and largest number that it may be; `None` for nothing.
    fn range(&self) -> Option<Range> {
        match self {
            Self::Unknown => Some(Range::ALL),
            Self::Interval { lo, hi, .. } => Some(Range { lo: *lo, hi: *hi }),
            _ => match self.few()? {
                [] => None,
                [x] => Some(Range::point(*x)),
                [lo, .., hi] => Some(Range { lo: *lo, hi: *hi }),
            },
        }
    }

    /// As [`AbstractValue::range`], with nothing counted as zero, as operators do.
    fn range_in_arithmetic(&self) -> Range {
        let zero = Range::point(0.0);
        match self.range() {
            None => zero,
            Some(range) if self.may_be_vacant() => range.hull(zero),
            Some(range) => range,
        }
    }
}

/// A few numbers and perhaps nothing, as `scalar` takes them.
#[derive(Clone, Copy)]
struct Points<'a> {
    numbers: &'a [f64],
    vacant: bool,
}

impl Points<'_> {
    fn iter(&self) -> impl Iterator<Item = Option<f64>> {
        self.vacant.then_some(None).into_iter().chain(self.numbers.iter().copied().map(Some))
    }
}

/// What single values give, taken together: those that fault drop out, unless all do.
fn gather(results: impl Iterator<Item = Result<f64, ValueFault>>) -> Result<AbstractValue, ValueFault> {
    let mut fault = None;
    let mut numbers = Vec::new();
    for result in results {
        match result {
            Ok(x) => numbers.push(x),
            Err(why) => fault = fault.or(Some(why)),
        }
    }
    match fault {
        Some(why) if numbers.is_empty() => Err(why),
        _ => Ok(AbstractValue::numbers(numbers, false)),
    }
}

impl Range {
    fn into_value(self) -> AbstractValue {
        AbstractValue::interval(self.lo, self.hi, false)
    }

    fn with_vacancy(self, vacant: bool) -> AbstractValue {
        AbstractValue::interval(self.lo, self.hi, vacant)
    }
}

impl Domain for Abstract {
    type Value = AbstractValue;

    fn number(value: f64) -> AbstractValue {
        // Adding zero takes the sign from −0.
        if value.is_finite() { AbstractValue::Number(value + 0.0) } else { AbstractValue::Unknown }
    }

    fn vacant() -> AbstractValue {
        AbstractValue::Vacant
    }

    fn assumed(_: AbstractValue) -> AbstractValue {
        Self::unknown()
    }

    fn unknown() -> AbstractValue {
        AbstractValue::Unknown
    }

    fn known(value: &AbstractValue) -> Option<f64> {
        match value {
            AbstractValue::Number(x) => Some(*x),
            _ => None,
        }
    }

    fn is_vacant(value: &AbstractValue) -> Truth {
        match value {
            AbstractValue::Vacant => Truth::True,
            _ if value.may_be_vacant() => Truth::Unknown,
            _ => Truth::False,
        }
    }

    fn bounds(value: &AbstractValue) -> Option<(f64, f64)> {
        if value.may_be_vacant() {
            return None;
        }
        value.range().filter(|range| *range != Range::ALL).map(|range| (range.lo, range.hi))
    }

    fn binary(
        op: BinaryOp,
        left: &AbstractValue,
        right: &AbstractValue,
        semantics: &Semantics,
    ) -> Result<AbstractValue, ValueFault> {
        if let (AbstractValue::Number(a), AbstractValue::Number(b)) = (left, right) {
            return scalar::binary(op, Some(*a), Some(*b), semantics).map(AbstractValue::Number);
        }
        if let (Some(left), Some(right)) = (left.points(), right.points()) {
            return gather(
                left.iter()
                    .flat_map(|a| right.iter().map(move |b| (a, b)))
                    .map(|(a, b)| scalar::binary(op, a, b, semantics)),
            );
        }
        if is_comparison(op) {
            return Ok(AbstractValue::from_truth(compare(op, left, right, semantics)));
        }
        if matches!(op, BinaryOp::And | BinaryOp::Or | BinaryOp::Xor) && !semantics.logic_on_bits {
            return Ok(AbstractValue::from_truth(logic(op, Self::truth(left), Self::truth(right))));
        }
        interval::binary(op, left.range_in_arithmetic(), right.range_in_arithmetic(), semantics)
            .map(Range::into_value)
    }

    fn call(
        function: Function,
        arguments: &[AbstractValue],
        semantics: &Semantics,
    ) -> Result<AbstractValue, ValueFault> {
        if let [AbstractValue::Number(x)] = arguments {
            return scalar::call(function, &[Some(*x)], semantics).map(AbstractValue::Number);
        }
        scalar::check_arity(function, arguments.len(), semantics)?;
        match arguments {
            [x] => match x.points() {
                Some(points) => gather(points.iter().map(|x| scalar::call(function, &[x], semantics))),
                None if function == Function::Not => Ok(AbstractValue::from_truth(!Self::truth(x))),
                None => interval::unary(function, x.range_in_arithmetic(), semantics).map(Range::into_value),
            },
            [x, y] => match (x.points(), y.points()) {
                (Some(xs), Some(ys)) => gather(
                    xs.iter()
                        .flat_map(|x| ys.iter().map(move |y| [x, y]))
                        .map(|both| scalar::call(function, &both, semantics)),
                ),
                _ => {
                    let (x, y) = (x.range_in_arithmetic(), y.range_in_arithmetic());
                    let result = match function {
                        Function::Pow => interval::binary(BinaryOp::Power, x, y, semantics),
                        _ => Ok(interval::arc_tangent_of_two(x, y)),
                    };
                    result.map(Range::into_value)
                }
            },
            _ => Err(ValueFault::NoSuchFunction),
        }
    }

    fn negate(value: &AbstractValue) -> AbstractValue {
        match value {
            AbstractValue::Vacant | AbstractValue::Unknown => value.clone(),
            AbstractValue::Number(x) => AbstractValue::Number(0.0 - x),
            AbstractValue::Set(set) => {
                AbstractValue::numbers(set.numbers.iter().map(|x| 0.0 - x), set.vacant)
            }
            AbstractValue::Interval { lo, hi, vacant } => AbstractValue::interval(-hi, -lo, *vacant),
        }
    }

    fn truth(value: &AbstractValue) -> Truth {
        let may_be_false = value.may_be_vacant() || value.may_be_number(0.0);
        let may_be_true = match value.few() {
            Some(numbers) => numbers.iter().any(|x| *x != 0.0),
            None => true,
        };
        match (may_be_true, may_be_false) {
            (true, false) => Truth::True,
            (false, _) => Truth::False,
            (true, true) => Truth::Unknown,
        }
    }

    fn assume(
        value: &AbstractValue,
        op: BinaryOp,
        bound: f64,
        semantics: &Semantics,
    ) -> Option<AbstractValue> {
        if !is_comparison(op) || !bound.is_finite() {
            return Some(value.clone());
        }
        let holds = |x| scalar::compare(op, x, Some(bound), semantics);
        let vacant = value.may_be_vacant() && holds(None);
        if let Some(numbers) = value.few() {
            return some_of(numbers.iter().copied().filter(|x| holds(Some(*x))), vacant);
        }
        match value.range().and_then(|range| range.assume(op, bound, semantics)) {
            Some(range) => Some(range.with_vacancy(vacant)),
            None => vacant.then_some(AbstractValue::Vacant),
        }
    }

    fn assume_vacant(value: &AbstractValue, vacant: bool) -> Option<AbstractValue> {
        if vacant {
            return value.may_be_vacant().then_some(AbstractValue::Vacant);
        }
        match value.few() {
            Some(numbers) => some_of(numbers.iter().copied(), false),
            None => value.range().map(|range| range.with_vacancy(false)),
        }
    }
}

impl Lattice for AbstractValue {
    fn join(&self, other: &Self) -> Self {
        if self == other {
            return self.clone();
        }
        let vacant = self.may_be_vacant() || other.may_be_vacant();
        if let (Some(a), Some(b)) = (self.few(), other.few()) {
            return Self::numbers(a.iter().chain(b).copied(), vacant);
        }
        match (self.range(), other.range()) {
            (Some(a), Some(b)) => a.hull(b).with_vacancy(vacant),
            (Some(range), None) | (None, Some(range)) => range.with_vacancy(vacant),
            (None, None) => Self::Vacant,
        }
    }

    /// A bound that moved goes to the next threshold, then to infinity.
    fn widen(&self, newer: &Self) -> Self {
        if self.covers(newer) {
            return self.clone();
        }
        let joined = self.join(newer);
        // Sets grow to `NumberSet::MOST` at most, so they need no help to come to an end.
        if joined.few().is_some() {
            return joined;
        }
        match (self.range(), joined.range()) {
            (Some(before), Some(after)) => before.widened_to(after).with_vacancy(joined.may_be_vacant()),
            _ => joined,
        }
    }

    fn covers(&self, inner: &Self) -> bool {
        if inner.may_be_vacant() && !self.may_be_vacant() {
            return false;
        }
        match inner.few() {
            Some(numbers) => numbers.iter().all(|x| self.may_be_number(*x)),
            // An interval has more numbers than a set.
            None if self.few().is_some() => false,
            None => match (self.range(), inner.range()) {
                (Some(outer), Some(inner)) => outer.lo <= inner.lo && inner.hi <= outer.hi,
                _ => false,
            },
        }
    }

    fn same(&self, other: &Self) -> bool {
        self == other
    }
}

/// The value of what is left, if something is.
fn some_of(numbers: impl Iterator<Item = f64>, vacant: bool) -> Option<AbstractValue> {
    let numbers: Vec<f64> = numbers.collect();
    (vacant || !numbers.is_empty()).then(|| AbstractValue::numbers(numbers, vacant))
}

/// A comparison in which at least one side is not a few values.
fn compare(op: BinaryOp, left: &AbstractValue, right: &AbstractValue, semantics: &Semantics) -> Truth {
    let as_numbers =
        || interval::compare(op, left.range_in_arithmetic(), right.range_in_arithmetic(), semantics);
    let vacancy_counts = matches!(op, BinaryOp::Equal | BinaryOp::NotEqual)
        && semantics.unset == gcheck_controls::Unset::Vacant
        && (left.may_be_vacant() || right.may_be_vacant());
    if !vacancy_counts {
        return as_numbers();
    }
    let mut answer = None;
    let mut also = |truth: Truth| {
        answer = Some(match answer {
            None => truth,
            Some(other) if other == truth => truth,
            Some(_) => Truth::Unknown,
        });
    };
    let same = Truth::from(op == BinaryOp::Equal);
    if left.may_be_vacant() && right.may_be_vacant() {
        also(same);
    }
    if left.may_be_vacant() && right.range().is_some() || right.may_be_vacant() && left.range().is_some() {
        also(!same);
    }
    if let (Some(a), Some(b)) = (left.range(), right.range()) {
        also(interval::compare(op, a, b, semantics));
    }
    answer.unwrap_or(Truth::Unknown)
}

/// `AND`, `OR`, `XOR` of conditions.
fn logic(op: BinaryOp, left: Truth, right: Truth) -> Truth {
    match op {
        BinaryOp::And if left == Truth::False || right == Truth::False => Truth::False,
        BinaryOp::Or if left == Truth::True || right == Truth::True => Truth::True,
        _ if left == Truth::Unknown || right == Truth::Unknown => Truth::Unknown,
        // Both known, and for AND both true, for OR both false.
        BinaryOp::And => Truth::True,
        BinaryOp::Or => Truth::False,
        _ => Truth::from(left != right),
    }
}
