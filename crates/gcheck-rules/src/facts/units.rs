//! What a length means in a program that does not state its units.
//!
//! Knows: whether the program or the user states them. Must not know: any rule.

use gcheck_engine::{Fact, Role, Units};

use crate::PathCx;

/// Did the program state its units before this block, or the user for the machine? Otherwise they are what the control starts
/// with, and that is a setting.
pub(crate) fn are_stated(cx: &PathCx<'_>) -> bool {
    cx.definitions().set_by(Fact::Mode(Role::Units)).is_some() || cx.environment.machine.units_are_told
}

/// The least and the most that a number of the program may mean which the control reads as this length: millimetres.
pub(crate) fn range(cx: &PathCx<'_>, length: f64) -> [f64; 2] {
    let inch = Units::Inch.in_mm();
    match cx.state().units(cx.model) {
        _ if are_stated(cx) => [length, length],
        Some(Units::Inch) => [length / inch, length],
        Some(Units::Mm) => [length, length * inch],
        None => [f64::NAN; 2],
    }
}
