//! What a run does with values that nobody knows.

use std::sync::Arc;

use gcheck_controls::Control;

use super::*;
use ConcreteValue::{Number, Unknown, Vacant};

fn linuxcnc() -> Arc<Control> {
    gcheck_controls::load("linuxcnc").unwrap()
}

fn fanuc() -> Arc<Control> {
    gcheck_controls::load("fanuc-mill").unwrap()
}

#[test]
fn a_value_takes_two_words() {
    assert_eq!(size_of::<ConcreteValue>(), 16);
}

#[test]
fn what_depends_on_the_unknown_is_unknown() {
    let lc = linuxcnc();
    let of = |op, a: ConcreteValue, b: ConcreteValue| Concrete::binary(op, &a, &b, lc.semantics());
    assert_eq!(of(BinaryOp::Add, Unknown, Number(1.0)), Ok(Unknown));
    assert_eq!(of(BinaryOp::Equal, Unknown, Unknown), Ok(Unknown));
    assert_eq!(Concrete::call(Function::Sin, &[Unknown], lc.semantics()), Ok(Unknown));
    assert_eq!(Concrete::truth(&Unknown), Truth::Unknown);
    assert_eq!(Concrete::negate(&Unknown), Unknown);
}

#[test]
fn what_is_certain_all_the_same_is_known() {
    let (lc, fanuc) = (linuxcnc(), fanuc());
    let of = |op, a: ConcreteValue, b: ConcreteValue| Concrete::binary(op, &a, &b, lc.semantics());
    assert_eq!(of(BinaryOp::Multiply, Unknown, Number(0.0)), Ok(Number(0.0)));
    assert_eq!(of(BinaryOp::And, Number(0.0), Unknown), Ok(Number(0.0)));
    assert_eq!(of(BinaryOp::Or, Number(2.0), Unknown), Ok(Number(1.0)));
    assert_eq!(of(BinaryOp::Divide, Unknown, Number(0.0)), Err(ValueFault::DivisionByZero));
    assert_eq!(of(BinaryOp::Modulo, Unknown, Vacant), Err(ValueFault::DivisionByZero));
    let or_of_bits = Concrete::binary(BinaryOp::Or, &Number(2.0), &Unknown, fanuc.semantics());
    assert_eq!(or_of_bits, Ok(Unknown));
}

#[test]
fn a_function_that_does_not_exist_faults_whatever_it_is_asked() {
    let lc = linuxcnc();
    let of = |function, arguments: &[ConcreteValue]| Concrete::call(function, arguments, lc.semantics());
    assert_eq!(of(Function::Atan, &[Unknown]), Err(ValueFault::NoSuchFunction));
    assert_eq!(of(Function::Sin, &[]), Err(ValueFault::NoSuchFunction));
    assert_eq!(of(Function::Pow, &[Unknown; 3]), Err(ValueFault::NoSuchFunction));
    assert_eq!(of(Function::Exists, &[Number(1.0)]), Err(ValueFault::Malformed));
}

#[test]
fn nothing_stays_nothing_under_a_sign_and_is_no_condition_that_holds() {
    assert_eq!(Concrete::negate(&Vacant), Vacant);
    assert_eq!(Concrete::truth(&Vacant), Truth::False);
    assert_eq!(Concrete::is_vacant(&Vacant), Truth::True);
    assert_eq!(Concrete::is_vacant(&Unknown), Truth::Unknown);
}

#[test]
fn zero_has_no_sign_and_numbers_are_finite() {
    let bits = |value| Concrete::known(&value).map(f64::to_bits);
    assert_eq!(bits(Concrete::number(-0.0)), Some(0));
    assert_eq!(bits(Concrete::negate(&Number(0.0))), Some(0));
    assert_eq!(Concrete::number(f64::NAN), Unknown);
    assert_eq!(Concrete::number(f64::INFINITY), Unknown);
}

#[test]
fn assuming_sorts_out_what_is_known() {
    let fanuc = fanuc();
    let of = |value: ConcreteValue, op, bound| Concrete::assume(&value, op, bound, fanuc.semantics());
    assert_eq!(of(Number(5.0), BinaryOp::Less, 10.0), Some(Number(5.0)));
    assert_eq!(of(Number(5.0), BinaryOp::Less, 5.0), None);
    assert_eq!(of(Vacant, BinaryOp::Less, 10.0), Some(Vacant));
    assert_eq!(of(Vacant, BinaryOp::Equal, 0.0), None);
    assert_eq!(of(Unknown, BinaryOp::Equal, 0.0), Some(Unknown));
    assert_eq!(of(Number(5.0), BinaryOp::Add, 10.0), Some(Number(5.0)));
    assert_eq!(Concrete::assume_vacant(&Number(0.0), true), None);
    assert_eq!(Concrete::assume_vacant(&Vacant, false), None);
    assert_eq!(Concrete::assume_vacant(&Unknown, true), Some(Vacant));
}
