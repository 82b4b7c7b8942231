//! Numbers and values as people read them.
//!
//! Knows: units, decimals, ranges of values. Must not know: where a value comes from.

use gcheck_engine::{AbstractValue, Axis, Units};

/// A number with at most so many decimals, without zeros at its end.
pub(crate) fn plain(value: f64, decimals: usize) -> String {
    let text = format!("{value:.decimals$}");
    let text = if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.') } else { &text };
    // A negative zero is a zero to a reader.
    if text == "-0" { "0".to_owned() } else { text.to_owned() }
}

/// Decimals of a length that mean something.
pub(crate) const fn decimals(units: Units) -> usize {
    match units {
        Units::Inch => 4,
        Units::Mm => 3,
    }
}

/// Name of the unit after a length.
pub(crate) const fn unit(units: Units) -> &'static str {
    match units {
        Units::Inch => "inch",
        Units::Mm => "mm",
    }
}

/// A coordinate in the units of the program: degrees on rotary axes, a diameter where X counts so.
pub(crate) fn in_units(axis: Axis, value: f64, units: Units, diameter: bool) -> f64 {
    if axis.is_rotary() {
        return value;
    }
    let value = value / units.in_mm();
    if diameter && axis == Axis::X { 2.0 * value } else { value }
}

/// As [`in_units`], as text.
pub(crate) fn coordinate(axis: Axis, value: f64, units: Units, diameter: bool) -> String {
    plain(in_units(axis, value, units, diameter), if axis.is_rotary() { 3 } else { decimals(units) })
}

/// What a variable may hold.
pub(crate) fn value(value: &AbstractValue) -> String {
    let number = |x: f64| plain(x, 6);
    let or_nothing = |text: String, vacant: bool| if vacant { format!("{text}, or nothing") } else { text };
    match value {
        AbstractValue::Vacant => "nothing (never set)".to_owned(),
        AbstractValue::Number(x) => number(*x),
        AbstractValue::Set(set) => {
            let texts: Vec<String> = set.numbers().iter().map(|x| number(*x)).collect();
            let text = match texts.as_slice() {
                [first @ .., last] if !first.is_empty() => format!("{} or {last}", first.join(", ")),
                _ => texts.concat(),
            };
            or_nothing(text, set.vacant())
        }
        AbstractValue::Interval { lo, hi, vacant } => {
            let text = match (lo.is_finite(), hi.is_finite()) {
                (true, true) => format!("{} to {}", number(*lo), number(*hi)),
                (true, false) => format!("{} or more", number(*lo)),
                (false, true) => format!("{} or less", number(*hi)),
                (false, false) => "some number".to_owned(),
            };
            or_nothing(text, *vacant)
        }
        AbstractValue::Unknown => "not known".to_owned(),
    }
}

/// `1:23` or `1:02:03`.
pub(crate) fn clock(seconds: f64) -> String {
    #[expect(clippy::cast_sign_loss, reason = "not negative")]
    let whole = seconds.max(0.0).round() as u64;
    let (hours, minutes, seconds) = (whole / 3600, whole / 60 % 60, whole % 60);
    if hours > 0 { format!("{hours}:{minutes:02}:{seconds:02}") } else { format!("{minutes}:{seconds:02}") }
}
