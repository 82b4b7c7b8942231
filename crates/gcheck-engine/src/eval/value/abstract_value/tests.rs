//! What the domain of all paths says, and the law that it covers every run.

use std::sync::{Arc, LazyLock};

use gcheck_controls::{Control, Unset};
use proptest::prelude::*;

use super::super::Concrete;
use super::*;
use AbstractValue::{Number, Unknown, Vacant};

static LINUXCNC: LazyLock<Arc<Control>> = LazyLock::new(|| gcheck_controls::load("linuxcnc").unwrap());
static FANUC: LazyLock<Arc<Control>> = LazyLock::new(|| gcheck_controls::load("fanuc-mill").unwrap());

fn set(numbers: &[f64]) -> AbstractValue {
    AbstractValue::numbers(numbers.iter().copied(), false)
}

fn set_or_nothing(numbers: &[f64]) -> AbstractValue {
    AbstractValue::numbers(numbers.iter().copied(), true)
}

fn from_to(lo: f64, hi: f64) -> AbstractValue {
    AbstractValue::interval(lo, hi, false)
}

const ENDLESS: f64 = f64::INFINITY;

/// On a control that knows vacancy.
fn of(op: BinaryOp, a: &AbstractValue, b: &AbstractValue) -> Result<AbstractValue, ValueFault> {
    Abstract::binary(op, a, b, FANUC.semantics())
}

fn call(function: Function, x: &AbstractValue) -> Result<AbstractValue, ValueFault> {
    Abstract::call(function, std::slice::from_ref(x), FANUC.semantics())
}

#[test]
fn a_value_has_one_form() {
    assert_eq!(set(&[2.0, 1.0, 2.0]), set(&[1.0, 2.0]));
    assert_eq!(set(&[3.0, 3.0]), Number(3.0));
    assert_eq!(set(&[0.0, -0.0]), Number(0.0));
    assert_eq!(set_or_nothing(&[]), Vacant);
    assert_eq!(from_to(3.0, 3.0), Number(3.0));
    assert_eq!(AbstractValue::interval(-ENDLESS, ENDLESS, true), Unknown);
    let nine: Vec<f64> = (1..=9).map(f64::from).collect();
    assert_eq!(set(&nine), from_to(1.0, 9.0));
    assert!(matches!(set(&nine[..8]), AbstractValue::Set(_)));
    assert_eq!(Abstract::number(f64::NAN), Unknown);
}

#[test]
fn a_value_is_small() {
    assert!(size_of::<AbstractValue>() <= 32);
}

#[test]
fn sets_are_computed_number_by_number() {
    let a = set(&[1.0, 2.0]);
    assert_eq!(of(BinaryOp::Add, &a, &Number(10.0)), Ok(set(&[11.0, 12.0])));
    assert_eq!(of(BinaryOp::Multiply, &a, &set(&[-1.0, 1.0])), Ok(set(&[-2.0, -1.0, 1.0, 2.0])));
    assert_eq!(call(Function::Sin, &set(&[0.0, 30.0, 180.0])), Ok(set(&[0.0, 0.5])));
    assert_eq!(of(BinaryOp::Greater, &a, &Number(0.0)), Ok(Number(1.0)));
    assert_eq!(of(BinaryOp::Greater, &a, &Number(1.0)), Ok(set(&[0.0, 1.0])));
}

#[test]
fn nothing_in_a_set_counts_as_the_control_says() {
    let maybe = set_or_nothing(&[5.0]);
    assert_eq!(of(BinaryOp::Add, &maybe, &Number(1.0)), Ok(set(&[1.0, 6.0])));
    assert_eq!(of(BinaryOp::Equal, &maybe, &Number(0.0)), Ok(Number(0.0)));
    assert_eq!(of(BinaryOp::Equal, &maybe, &Vacant), Ok(set(&[0.0, 1.0])));
    let on_linuxcnc = Abstract::binary(BinaryOp::Equal, &maybe, &Number(0.0), LINUXCNC.semantics());
    assert_eq!(on_linuxcnc, Ok(set(&[0.0, 1.0])));
}

#[test]
fn only_a_fault_on_every_path_is_a_fault() {
    let some = set(&[0.0, 2.0]);
    assert_eq!(of(BinaryOp::Divide, &Number(4.0), &some), Ok(Number(2.0)));
    assert_eq!(of(BinaryOp::Divide, &Unknown, &set_or_nothing(&[0.0])), Err(ValueFault::DivisionByZero));
    assert_eq!(call(Function::Sqrt, &from_to(-4.0, 9.0)), Ok(from_to(0.0, 3.0)));
    assert_eq!(call(Function::Sqrt, &from_to(-4.0, -1.0)), Err(ValueFault::NegativeRoot));
    assert_eq!(call(Function::Ln, &from_to(-4.0, 0.0)), Err(ValueFault::LogarithmOfNonPositive));
    assert_eq!(call(Function::Asin, &from_to(2.0, 3.0)), Err(ValueFault::ArcFunctionRange));
    let huge = from_to(1e200, 1e201);
    assert_eq!(of(BinaryOp::Multiply, &huge, &huge), Err(ValueFault::NotFinite));
}

#[test]
fn bounds_of_sums_and_whole_parts_are_exact() {
    let a = from_to(1.0, 10.0);
    assert_eq!(of(BinaryOp::Add, &a, &Number(1.0)), Ok(from_to(2.0, 11.0)));
    assert_eq!(of(BinaryOp::Subtract, &Number(0.0), &a), Ok(from_to(-10.0, -1.0)));
    assert_eq!(of(BinaryOp::Multiply, &a, &from_to(-2.0, 3.0)), Ok(from_to(-20.0, 30.0)));
    assert_eq!(of(BinaryOp::Divide, &a, &Number(2.0)), Ok(from_to(0.5, 5.0)));
    assert_eq!(call(Function::Fix, &from_to(-1.5, 2.5)), Ok(from_to(-1.0, 2.0)));
    assert_eq!(call(Function::Abs, &from_to(-3.0, 2.0)), Ok(from_to(0.0, 3.0)));
    assert_eq!(Abstract::negate(&a), from_to(-10.0, -1.0));
}

#[test]
fn what_has_no_bounds_is_still_a_number() {
    assert_eq!(of(BinaryOp::Add, &Unknown, &Number(1.0)), Ok(AbstractValue::any_number()));
    assert_eq!(of(BinaryOp::Divide, &Number(1.0), &from_to(-1.0, 1.0)), Ok(AbstractValue::any_number()));
    assert_eq!(Abstract::is_vacant(&AbstractValue::any_number()), Truth::False);
    assert_eq!(call(Function::Cos, &Unknown), Ok(from_to(-1.0, 1.0)));
    assert_eq!(call(Function::Abs, &Unknown), Ok(from_to(0.0, ENDLESS)));
    assert_eq!(of(BinaryOp::Modulo, &Unknown, &Number(3.0)), Ok(from_to(-3.0, 3.0)));
    let on_linuxcnc = Abstract::binary(BinaryOp::Modulo, &Unknown, &Number(3.0), LINUXCNC.semantics());
    assert_eq!(on_linuxcnc, Ok(from_to(0.0, 3.0)));
    assert_eq!(
        of(BinaryOp::Power, &AbstractValue::any_number(), &Number(0.5)),
        Ok(AbstractValue::any_number())
    );
}

#[test]
fn comparisons_of_intervals_are_decided_where_they_can_be() {
    let a = from_to(1.0, 10.0);
    let either = set(&[0.0, 1.0]);
    assert_eq!(of(BinaryOp::Less, &a, &Number(11.0)), Ok(Number(1.0)));
    assert_eq!(of(BinaryOp::Less, &a, &Number(10.0)), Ok(either.clone()));
    assert_eq!(of(BinaryOp::LessEqual, &a, &Number(10.0)), Ok(Number(1.0)));
    assert_eq!(of(BinaryOp::Greater, &a, &Number(10.0)), Ok(Number(0.0)));
    assert_eq!(of(BinaryOp::Equal, &a, &Number(0.0)), Ok(Number(0.0)));
    assert_eq!(of(BinaryOp::Equal, &a, &Number(5.0)), Ok(either.clone()));
    assert_eq!(of(BinaryOp::Equal, &from_to(1.0, 1.0 + 1e-12), &Number(1.0)), Ok(Number(1.0)));
    assert_eq!(of(BinaryOp::NotEqual, &a, &Vacant), Ok(Number(1.0)));
    assert_eq!(of(BinaryOp::Equal, &Unknown, &Vacant), Ok(either));
    assert_eq!(Abstract::truth(&a), Truth::True);
    assert_eq!(Abstract::truth(&from_to(0.0, 1.0)), Truth::Unknown);
}

#[test]
fn one_side_of_a_condition_may_decide_it() {
    let on_linuxcnc =
        |op, a: &AbstractValue, b: &AbstractValue| Abstract::binary(op, a, b, LINUXCNC.semantics());
    let number = AbstractValue::any_number();
    assert_eq!(on_linuxcnc(BinaryOp::And, &Number(0.0), &number), Ok(Number(0.0)));
    assert_eq!(on_linuxcnc(BinaryOp::Or, &number, &Number(7.0)), Ok(Number(1.0)));
    assert_eq!(on_linuxcnc(BinaryOp::Xor, &number, &Number(7.0)), Ok(set(&[0.0, 1.0])));
    assert_eq!(of(BinaryOp::And, &number, &Number(7.0)), Ok(from_to(0.0, 7.0)));
    assert_eq!(call(Function::Not, &from_to(1.0, 2.0)), Ok(Number(0.0)));
}

#[test]
fn joining_keeps_few_numbers_apart() {
    let join = |a: &AbstractValue, b: &AbstractValue| Lattice::join(a, b);
    assert_eq!(join(&Number(1.0), &Number(2.0)), set(&[1.0, 2.0]));
    assert_eq!(join(&Number(1.0), &Vacant), set_or_nothing(&[1.0]));
    assert_eq!(join(&from_to(1.0, 2.0), &Number(5.0)), from_to(1.0, 5.0));
    assert_eq!(join(&from_to(1.0, 2.0), &Vacant), AbstractValue::interval(1.0, 2.0, true));
    assert_eq!(join(&Unknown, &Number(5.0)), Unknown);
}

#[test]
fn widening_goes_to_the_next_threshold_then_to_infinity() {
    let widen = |a: &AbstractValue, b: &AbstractValue| Lattice::widen(a, b);
    assert_eq!(widen(&from_to(1.0, 2.0), &from_to(1.0, 3.0)), from_to(1.0, 10.0));
    assert_eq!(widen(&from_to(1.0, 10.0), &from_to(2.0, 10.0)), from_to(1.0, 10.0));
    assert_eq!(widen(&from_to(1.0, 10.0), &from_to(0.5, 10.0)), from_to(0.0, 10.0));
    assert_eq!(widen(&from_to(-0.5, 10.0), &from_to(-0.6, 10.0)), from_to(-1.0, 10.0));
    assert_eq!(widen(&from_to(-9.0, -5.0), &from_to(-9.0, -4.0)), from_to(-9.0, -1.0));
    assert_eq!(widen(&from_to(1.0, 10.0), &from_to(1.0, 2e6)), from_to(1.0, ENDLESS));
}

#[test]
fn a_counting_loop_ends_with_its_bounds() {
    // #1 = 0, WHILE [#1 LT 50], #1 = #1 + 1
    let semantics = LINUXCNC.semantics();
    let mut at_head = Number(0.0);
    let mut rounds = 0;
    loop {
        rounds += 1;
        let inside = Abstract::assume(&at_head, BinaryOp::Less, 50.0, semantics).unwrap();
        let after = Abstract::binary(BinaryOp::Add, &inside, &Number(1.0), semantics).unwrap();
        let next = Lattice::widen(&at_head, &after);
        if next == at_head {
            break;
        }
        at_head = next;
    }
    assert!(rounds < 15, "{rounds}");
    let behind = Abstract::assume(&at_head, BinaryOp::GreaterEqual, 50.0, semantics).unwrap();
    assert_eq!(behind, from_to(50.0, 100.0));
}

#[test]
fn assuming_narrows() {
    let of = |value: &AbstractValue, op, bound| Abstract::assume(value, op, bound, FANUC.semantics());
    assert_eq!(of(&from_to(0.0, 20.0), BinaryOp::LessEqual, 10.0), Some(from_to(0.0, 10.0)));
    assert_eq!(of(&from_to(0.0, 20.0), BinaryOp::Less, 10.0), Some(from_to(0.0, 10.0_f64.next_down())));
    assert_eq!(of(&from_to(0.0, 20.0), BinaryOp::Greater, 20.0), None);
    assert_eq!(of(&set(&[1.0, 2.0, 3.0]), BinaryOp::NotEqual, 2.0), Some(set(&[1.0, 3.0])));
    assert_eq!(of(&set(&[1.0, 2.0, 3.0]), BinaryOp::Equal, 2.0), Some(Number(2.0)));
    assert_eq!(of(&Unknown, BinaryOp::GreaterEqual, 0.0), Some(AbstractValue::interval(0.0, ENDLESS, true)));
    assert_eq!(of(&Unknown, BinaryOp::Greater, 0.0), Some(from_to(0.0_f64.next_up(), ENDLESS)));
    assert_eq!(of(&Vacant, BinaryOp::Equal, 0.0), None);
    assert_eq!(of(&set_or_nothing(&[0.0]), BinaryOp::NotEqual, 0.0), Some(Vacant));
    let near_five = of(&Unknown, BinaryOp::Equal, 5.0).unwrap();
    let (lo, hi) = Abstract::bounds(&near_five).unwrap();
    assert!(4.9999 < lo && lo < 5.0 && 5.0 < hi && hi < 5.0001);
    let (_, hi) = Abstract::bounds(&of(&from_to(0.0, 5.0), BinaryOp::NotEqual, 5.0).unwrap()).unwrap();
    assert!(hi < 5.0);
}

#[test]
fn assuming_vacancy_narrows_too() {
    assert_eq!(Abstract::assume_vacant(&Unknown, false), Some(AbstractValue::any_number()));
    assert_eq!(Abstract::assume_vacant(&Unknown, true), Some(Vacant));
    assert_eq!(Abstract::assume_vacant(&set_or_nothing(&[1.0]), false), Some(Number(1.0)));
    assert_eq!(Abstract::assume_vacant(&Number(1.0), true), None);
    assert_eq!(Abstract::assume_vacant(&Vacant, false), None);
}

#[test]
fn bounds_are_known_of_what_is_certainly_a_number() {
    assert_eq!(Abstract::bounds(&set(&[3.0, 1.0])), Some((1.0, 3.0)));
    assert_eq!(Abstract::bounds(&from_to(1.0, ENDLESS)), Some((1.0, ENDLESS)));
    assert_eq!(Abstract::bounds(&set_or_nothing(&[1.0])), None);
    assert_eq!(Abstract::bounds(&AbstractValue::any_number()), None);
    assert_eq!(Abstract::bounds(&Vacant), None);
}

// The laws.

/// Numbers as programs have them, and as nobody has them.
fn number() -> impl Strategy<Value = f64> {
    prop_oneof![
        6 => (-12_i32..12).prop_map(f64::from),
        3 => (-80_i32..80).prop_map(|x| f64::from(x) / 8.0),
        2 => (-3_i32..3, -8_i32..8).prop_map(|(x, e)| f64::from(x) * 10_f64.powi(e)),
        1 => prop::sample::select(vec![30.0, 45.0, 60.0, 90.0, -90.0, 180.0, 270.0, 360.0, 5e-324, 1e300, -1e308, 1e16]),
        1 => proptest::num::f64::NORMAL,
    ]
    .prop_map(|x| x + 0.0)
}

fn concrete() -> impl Strategy<Value = ConcreteValue> {
    prop_oneof![8 => number().prop_map(ConcreteValue::Number), 1 => Just(ConcreteValue::Vacant)]
}

fn exactly(value: ConcreteValue) -> AbstractValue {
    match value {
        ConcreteValue::Vacant => Vacant,
        ConcreteValue::Number(x) => Number(x),
        ConcreteValue::Unknown => Unknown,
    }
}

/// Any abstract value.
fn abstraction() -> impl Strategy<Value = AbstractValue> {
    prop_oneof![
        (prop::collection::vec(number(), 1..6), any::<bool>())
            .prop_map(|(xs, v)| AbstractValue::numbers(xs, v)),
        (number(), number(), any::<bool>()).prop_map(|(a, b, v)| AbstractValue::interval(
            a.min(b),
            a.max(b),
            v
        )),
        (number(), any::<bool>()).prop_map(|(a, v)| AbstractValue::interval(a, ENDLESS, v)),
        (number(), any::<bool>()).prop_map(|(a, v)| AbstractValue::interval(-ENDLESS, a, v)),
        Just(AbstractValue::any_number()),
        Just(Unknown),
        Just(Vacant),
    ]
}

/// What a run holds, and what all paths may hold.
fn pair() -> impl Strategy<Value = (ConcreteValue, AbstractValue)> {
    let exact = concrete().prop_map(|value| (value, exactly(value)));
    let more = (concrete(), abstraction())
        .prop_map(|(value, other)| (value, Lattice::join(&exactly(value), &other)));
    let near = (concrete(), number(), number()).prop_map(|(value, below, above)| {
        let of = |x: f64| AbstractValue::interval(x - below.abs(), x + above.abs(), false);
        (value, if let ConcreteValue::Number(x) = value { of(x) } else { Unknown })
    });
    prop_oneof![1 => exact, 3 => more, 2 => near]
}

const OPERATORS: [BinaryOp; 15] = [
    BinaryOp::Add,
    BinaryOp::Subtract,
    BinaryOp::Multiply,
    BinaryOp::Divide,
    BinaryOp::Modulo,
    BinaryOp::Power,
    BinaryOp::Equal,
    BinaryOp::NotEqual,
    BinaryOp::Greater,
    BinaryOp::GreaterEqual,
    BinaryOp::Less,
    BinaryOp::LessEqual,
    BinaryOp::And,
    BinaryOp::Or,
    BinaryOp::Xor,
];

const FUNCTIONS: [Function; 17] = [
    Function::Abs,
    Function::Acos,
    Function::Asin,
    Function::Atan,
    Function::Bcd,
    Function::Bin,
    Function::Cos,
    Function::Exp,
    Function::Fix,
    Function::Fup,
    Function::Ln,
    Function::Not,
    Function::Pow,
    Function::Round,
    Function::Sin,
    Function::Sqrt,
    Function::Tan,
];

#[derive(Debug, Clone)]
enum Expression {
    Value(ConcreteValue, AbstractValue),
    Negate(Box<Expression>),
    Binary(BinaryOp, Box<Expression>, Box<Expression>),
    Call(Function, Vec<Expression>),
}

fn expression() -> impl Strategy<Value = Expression> {
    pair().prop_map(|(run, paths)| Expression::Value(run, paths)).prop_recursive(3, 8, 2, |inner| {
        let boxed = inner.clone().prop_map(Box::new).boxed();
        prop_oneof![
            boxed.clone().prop_map(Expression::Negate),
            (prop::sample::select(OPERATORS.to_vec()), boxed.clone(), boxed)
                .prop_map(|(op, a, b)| Expression::Binary(op, a, b)),
            (prop::sample::select(FUNCTIONS.to_vec()), prop::collection::vec(inner, 1..3))
                .prop_map(|(function, arguments)| Expression::Call(function, arguments)),
        ]
    })
}

/// The value on one run and on all paths. `None` where the run stopped at a fault.
fn evaluate(
    expression: &Expression,
    semantics: &Semantics,
) -> Option<(ConcreteValue, Result<AbstractValue, ValueFault>)> {
    let together = |parts: &[Expression]| -> Option<(Vec<ConcreteValue>, Vec<AbstractValue>)> {
        let mut out = (Vec::new(), Vec::new());
        for part in parts {
            let (run, paths) = evaluate(part, semantics)?;
            out.0.push(run);
            out.1.push(paths.expect("the run went on, so no fault is certain"));
        }
        Some(out)
    };
    Some(match expression {
        Expression::Value(run, paths) => (*run, Ok(paths.clone())),
        Expression::Negate(inner) => {
            let (run, paths) = together(std::slice::from_ref(inner))?;
            (Concrete::negate(&run[0]), Ok(Abstract::negate(&paths[0])))
        }
        Expression::Binary(op, a, b) => {
            let (run, paths) = together(&[(**a).clone(), (**b).clone()])?;
            let of_paths = Abstract::binary(*op, &paths[0], &paths[1], semantics);
            (Concrete::binary(*op, &run[0], &run[1], semantics).ok()?, of_paths)
        }
        Expression::Call(function, arguments) => {
            let (run, paths) = together(arguments)?;
            let of_paths = Abstract::call(*function, &paths, semantics);
            (Concrete::call(*function, &run, semantics).ok()?, of_paths)
        }
    })
}

/// Does nothing but the one form occur?
fn is_canonical(value: &AbstractValue) -> bool {
    match value {
        Number(x) => x.is_finite() && x.to_bits() != (-0.0_f64).to_bits(),
        AbstractValue::Set(set) => {
            let numbers = set.numbers();
            numbers.len() + usize::from(set.vacant()) > 1
                && !numbers.is_empty()
                && numbers.len() <= NumberSet::MOST
                && numbers.is_sorted_by(|a, b| a < b)
        }
        AbstractValue::Interval { lo, hi, vacant } => {
            lo < hi && !(*vacant && *lo == -ENDLESS && *hi == ENDLESS)
        }
        Vacant | Unknown => true,
    }
}

#[derive(Debug, Clone, Copy)]
enum On {
    LinuxCnc,
    Fanuc,
}

impl On {
    fn semantics(self) -> &'static Semantics {
        match self {
            Self::LinuxCnc => LINUXCNC.semantics(),
            Self::Fanuc => FANUC.semantics(),
        }
    }
}

fn control() -> impl Strategy<Value = On> {
    prop_oneof![Just(On::LinuxCnc), Just(On::Fanuc)]
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 4000, ..ProptestConfig::default() })]

    #[test]
    fn all_paths_cover_the_run(expression in expression(), on in control()) {
        if let Some((run, paths)) = evaluate(&expression, on.semantics()) {
            prop_assert!(paths.is_ok(), "{run:?} but {paths:?}");
            let paths = paths.unwrap();
            prop_assert!(paths.allows(run), "{run:?} not in {paths:?}");
            prop_assert!(is_canonical(&paths), "{paths:?}");
        }
    }

    #[test]
    fn one_operator_covers_the_run(
        op in prop::sample::select(OPERATORS.to_vec()), a in pair(), b in pair(), on in control(),
    ) {
        let run = Concrete::binary(op, &a.0, &b.0, on.semantics());
        let paths = Abstract::binary(op, &a.1, &b.1, on.semantics());
        match (run, paths) {
            (Ok(run), Ok(paths)) => prop_assert!(paths.allows(run), "{run:?} not in {paths:?}"),
            (Ok(run), Err(fault)) => prop_assert!(false, "{run:?} but {fault:?}"),
            (Err(_), _) => {}
        }
    }

    #[test]
    fn one_function_covers_the_run(
        function in prop::sample::select(FUNCTIONS.to_vec()), a in pair(), b in pair(), two in any::<bool>(),
        on in control(),
    ) {
        let (run, paths) = if two {
            (Concrete::call(function, &[a.0, b.0], on.semantics()), Abstract::call(function, &[a.1, b.1], on.semantics()))
        } else {
            (Concrete::call(function, &[a.0], on.semantics()), Abstract::call(function, &[a.1], on.semantics()))
        };
        match (run, paths) {
            (Ok(run), Ok(paths)) => prop_assert!(paths.allows(run), "{run:?} not in {paths:?}"),
            (Ok(run), Err(fault)) => prop_assert!(false, "{run:?} but {fault:?}"),
            (Err(_), _) => {}
        }
    }

    #[test]
    fn answers_agree_with_the_run(value in pair()) {
        let agrees = |run: Truth, paths: Truth| paths == Truth::Unknown || run == paths;
        prop_assert!(agrees(Concrete::truth(&value.0), Abstract::truth(&value.1)));
        prop_assert!(agrees(Concrete::is_vacant(&value.0), Abstract::is_vacant(&value.1)));
        if let (Some((lo, hi)), ConcreteValue::Number(x)) = (Abstract::bounds(&value.1), value.0) {
            prop_assert!(lo <= x && x <= hi);
        }
    }

    #[test]
    fn assuming_keeps_what_satisfies(
        value in pair(),
        op in prop::sample::select(OPERATORS[6..12].to_vec()),
        bound in number(),
        nudge in -40_i32..40,
        on in control(),
    ) {
        // Half of the cases sit where the comparison turns.
        let run = match value.0 {
            ConcreteValue::Number(_) if nudge < 0 => {
                let edge = bound + on.semantics().equal_within * f64::from(nudge % 3);
                ConcreteValue::Number(f64::from_bits(edge.to_bits().wrapping_add(u64::from(nudge.unsigned_abs() % 7)).wrapping_sub(3)))
            }
            other => other,
        };
        let run = if let ConcreteValue::Number(x) = run { Concrete::number(x) } else { run };
        let paths = Lattice::join(&value.1, &exactly(run));
        let left = Abstract::assume(&paths, op, bound, on.semantics());
        if Concrete::assume(&run, op, bound, on.semantics()).is_some() {
            prop_assert!(left.as_ref().is_some_and(|left| left.allows(run)), "{run:?} not in {left:?}");
        }
        if let Some(left) = left {
            prop_assert!(Lattice::covers(&paths, &left), "{left:?} came out of {paths:?}");
            prop_assert!(is_canonical(&left));
        }
    }

    #[test]
    fn assuming_vacancy_keeps_what_satisfies(value in pair(), vacant in any::<bool>()) {
        let left = Abstract::assume_vacant(&value.1, vacant);
        if Concrete::assume_vacant(&value.0, vacant).is_some() {
            prop_assert!(left.is_some_and(|left| left.allows(value.0)));
        }
    }

    #[test]
    fn joining_and_widening_hold_both(a in abstraction(), b in abstraction()) {
        for both in [Lattice::join(&a, &b), Lattice::widen(&a, &b)] {
            prop_assert!(Lattice::covers(&both, &a), "{both:?}");
            prop_assert!(Lattice::covers(&both, &b), "{both:?}");
            prop_assert!(is_canonical(&both), "{both:?}");
        }
        prop_assert_eq!(Lattice::join(&a, &b), Lattice::join(&b, &a));
        prop_assert_eq!(Lattice::join(&a, &a), a);
    }

    #[test]
    fn containing_is_what_every_member_says(outer in abstraction(), inner in pair()) {
        if Lattice::covers(&outer, &inner.1) {
            prop_assert!(outer.allows(inner.0));
        }
    }

    #[test]
    fn widening_comes_to_an_end(first in abstraction(), rest in prop::collection::vec(abstraction(), 0..200)) {
        let mut value = first;
        let mut steps = 0;
        for next in rest {
            let wider = Lattice::widen(&value, &next);
            steps += usize::from(wider != value);
            value = wider;
        }
        prop_assert!(steps <= 64, "{steps}");
    }

    #[test]
    fn equal_values_hash_alike(a in abstraction(), b in abstraction()) {
        use std::hash::BuildHasher;
        let hasher = rustc_hash::FxBuildHasher;
        if a == b {
            prop_assert_eq!(hasher.hash_one(&a), hasher.hash_one(&b));
        }
        prop_assert_eq!(hasher.hash_one(&a), hasher.hash_one(a.clone()));
    }
}

#[test]
fn widening_one_step_at_a_time_comes_to_an_end() {
    // The slowest way up: each time just beyond what is held, below and above in turns.
    let mut value = Number(0.0);
    let mut steps = 0;
    loop {
        let (lo, hi) = Abstract::bounds(&value).unwrap_or((-ENDLESS, ENDLESS));
        let beyond = if steps % 2 == 0 && hi < ENDLESS || lo == -ENDLESS { hi + 1e-9 } else { lo - 1e-9 };
        if !beyond.is_finite() {
            break;
        }
        let next = Lattice::widen(&value, &Number(beyond.max(hi.next_up().min(f64::MAX))));
        let next = Lattice::widen(&next, &Number(lo.next_down().max(f64::MIN)));
        if next == value {
            break;
        }
        value = next;
        steps += 1;
        assert!(steps <= 64, "{value:?}");
    }
    assert_eq!(Lattice::widen(&value, &Vacant), Unknown);
}

#[test]
fn the_two_controls_of_these_tests_differ_in_what_matters_here() {
    assert_eq!(LINUXCNC.semantics().unset, Unset::Zero);
    assert_eq!(FANUC.semantics().unset, Unset::Vacant);
    assert!(FANUC.semantics().logic_on_bits && !LINUXCNC.semantics().logic_on_bits);
}
