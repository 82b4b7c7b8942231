//! Numbers as text, fast.
//!
//! Knows: the decimals of a number as C's `printf` prints them, and a short form without noise. Must not know: units.

use std::io::Write as _;

/// Above this many units of the last place the fast way may be wrong in it.
const FAST_LIMIT: f64 = 1e11;

/// Prints as `%.{decimals}f` does: the exact value rounded, half to even, the sign of a negative zero kept.
/// At most 9 decimals.
pub(crate) fn fixed(out: &mut Vec<u8>, value: f64, decimals: u8) {
    if !value.is_finite() {
        let text: &[u8] = match (value.is_nan(), value > 0.0) {
            (true, _) => b"nan",
            (_, true) => b"inf",
            (_, false) => b"-inf",
        };
        out.extend_from_slice(text);
        return;
    }
    let Some(rounded) = scaled(value, decimals) else {
        // Writing to a vector cannot fail.
        let _ = write!(out, "{value:.0$}", usize::from(decimals));
        return;
    };
    if value.is_sign_negative() {
        out.push(b'-');
    }
    digits(out, rounded, decimals, false);
}

/// Prints the value rounded to `decimals`, without zeros at the end but with one decimal at least, without a negative
/// zero; `otherwise` for what is not a finite number. At most 9 decimals.
pub(crate) fn short(out: &mut Vec<u8>, value: f64, decimals: u8, otherwise: &str) {
    if !value.is_finite() {
        out.extend_from_slice(otherwise.as_bytes());
        return;
    }
    let Some(rounded) = scaled(value, decimals) else {
        let before = out.len();
        let _ = write!(out, "{value:.0$}", usize::from(decimals));
        while out.ends_with(b"0") && !out.ends_with(b".0") {
            out.pop();
        }
        if out.get(before..) == Some(b"-0.0") {
            out.remove(before);
        }
        return;
    };
    if value.is_sign_negative() && rounded != 0 {
        out.push(b'-');
    }
    digits(out, rounded, decimals, true);
}

/// The size of the value in units of its last decimal, where it can be told without exact arithmetic.
fn scaled(value: f64, decimals: u8) -> Option<u64> {
    let scaled = value.abs() * 10f64.powi(i32::from(decimals));
    let whole = scaled.floor();
    // The product is off by less than 1e-5 below the limit: far enough from a tie it rounds as the exact value does.
    if scaled >= FAST_LIMIT || (scaled - whole - 0.5).abs() < 1e-4 {
        return None;
    }
    #[expect(clippy::cast_sign_loss, reason = "an absolute value below the limit")]
    let whole = whole as u64 + u64::from(scaled - whole > 0.5);
    Some(whole)
}

fn digits(out: &mut Vec<u8>, number: u64, decimals: u8, trim: bool) {
    let mut text = [b'0'; 24];
    let mut rest = number;
    let mut used = 0;
    let mut trim = trim;
    let mut skipped = 0;
    for (place, slot) in text.iter_mut().rev().enumerate() {
        if place == usize::from(decimals) && decimals > 0 {
            *slot = b'.';
            used += 1;
            continue;
        }
        // One digit is before the point.
        if rest == 0 && place > usize::from(decimals) + usize::from(decimals > 0) {
            break;
        }
        *slot = b'0' + (rest % 10) as u8;
        rest /= 10;
        used += 1;
        trim &= *slot == b'0' && place + 1 < usize::from(decimals);
        skipped += usize::from(trim);
    }
    out.extend_from_slice(text.get(24 - used..24 - skipped).unwrap_or_default());
}

/// Like [`short`], but without `.0`.
pub(crate) fn brief(out: &mut Vec<u8>, value: f64, decimals: u8, otherwise: &str) {
    short(out, value, decimals, otherwise);
    if out.ends_with(b".0") {
        out.truncate(out.len() - 2);
    }
}

/// Prints a whole number.
pub(crate) fn whole(out: &mut Vec<u8>, number: u64) {
    digits(out, number, 0, false);
}

/// A number rounded to six decimals, for formats that print the shortest form of a number themselves.
pub(crate) fn rounded(value: f64) -> Option<f64> {
    let rounded = (value * 1e6).round() / 1e6;
    // Adding zero takes the sign off a negative zero.
    if rounded.is_finite() { Some(rounded + 0.0) } else { Some(value).filter(|value| value.is_finite()) }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    fn as_fixed(value: f64) -> String {
        let mut out = Vec::new();
        fixed(&mut out, value, 4);
        String::from_utf8(out).unwrap()
    }

    fn as_short(value: f64) -> String {
        let mut out = Vec::new();
        short(&mut out, value, 6, "null");
        String::from_utf8(out).unwrap()
    }

    #[test]
    fn four_decimals_like_printf() {
        assert_eq!(as_fixed(0.0), "0.0000");
        assert_eq!(as_fixed(-0.0), "-0.0000");
        assert_eq!(as_fixed(-0.000_01), "-0.0000");
        assert_eq!(as_fixed(1.0), "1.0000");
        assert_eq!(as_fixed(-762.000_049), "-762.0000");
        assert_eq!(as_fixed(9.999_99), "10.0000");
        assert_eq!(as_fixed(f64::NAN), "nan");
        assert_eq!(as_fixed(1e30), "1000000000000000019884624838656.0000");
    }

    /// What the reference interpreter prints for 1/32, 3/32 and 5/32.
    #[test]
    fn ties_go_to_the_even_digit() {
        assert_eq!(as_fixed(0.03125), "0.0312");
        assert_eq!(as_fixed(0.09375), "0.0938");
        assert_eq!(as_fixed(0.15625), "0.1562");
        assert_eq!(as_fixed(1.000_05), "1.0001");
        assert_eq!(as_fixed(100_000.123_45), "100000.1234");
    }

    #[test]
    fn short_numbers_have_no_noise() {
        assert_eq!(as_short(0.1 + 0.2), "0.3");
        assert_eq!(as_short(-0.0), "0.0");
        assert_eq!(as_short(-0.000_000_01), "0.0");
        assert_eq!(as_short(5.0), "5.0");
        assert_eq!(as_short(1200.0), "1200.0");
        assert_eq!(as_short(-25.4), "-25.4");
        assert_eq!(as_short(1.0 / 3.0), "0.333333");
        assert_eq!(as_short(1e20), "100000000000000000000.0");
        assert_eq!(as_short(f64::NAN), "null");
        assert_eq!(as_short(f64::INFINITY), "null");
    }

    proptest! {
        #[test]
        fn the_fast_way_prints_what_the_exact_one_prints(value in prop_oneof![
            any::<f64>(),
            -1e5f64..1e5,
            (-1_000_000i32..1_000_000).prop_map(|n| f64::from(n) / 32.0),
            (-100_000_000i32..100_000_000).prop_map(|n| f64::from(n) / 1e5),
        ]) {
            prop_assume!(value.is_finite());
            prop_assert_eq!(as_fixed(value), format!("{value:.4}"));
            let short = as_short(value);
            let exact: f64 = format!("{value:.6}").parse().unwrap();
            let read: f64 = short.parse().unwrap();
            prop_assert_eq!((read + 0.0).to_bits(), (exact + 0.0).to_bits());
            prop_assert!(short.contains('.') && (short.ends_with(".0") || !short.ends_with('0')));
        }
    }
}
