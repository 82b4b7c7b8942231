//! Numbers as programs write them.
//!
//! Knows: digits, the point, the sign. Must not know: units or scaling.

/// How a number is written: what its value alone does not tell.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Hash)]
pub struct NumberShape {
    /// Digits in front of the point, leading zeros included.
    pub whole_digits: u8,
    /// Digits after the point.
    pub decimals: u8,
    /// A decimal point is written.
    pub point: bool,
    /// A minus sign is written.
    pub minus: bool,
}

impl NumberShape {
    /// Digits on both sides of the point, leading zeros included.
    pub fn digits(self) -> u32 {
        u32::from(self.whole_digits) + u32::from(self.decimals)
    }
}

/// Reads `12`, `-1.5`, `+.5`, `1.`; blanks inside are skipped. The lexer guarantees the form.
pub(crate) fn parse(text: &[u8]) -> (f64, NumberShape) {
    if text.len() <= 17 {
        return short(text);
    }
    let mut shape = NumberShape::default();
    let mut mantissa: u64 = 0;
    let mut exact = true;
    for byte in text {
        match byte {
            b'0'..=b'9' => {
                let count = if shape.point { &mut shape.decimals } else { &mut shape.whole_digits };
                *count = count.saturating_add(1);
                match mantissa.checked_mul(10).and_then(|m| m.checked_add(u64::from(byte - b'0'))) {
                    Some(next) if next < 1 << 53 => mantissa = next,
                    _ => exact = false,
                }
            }
            b'.' => shape.point = true,
            b'-' => shape.minus = !shape.minus,
            _ => {}
        }
    }
    // Both operands are exact, so the quotient is the correctly rounded value of the decimal.
    let value = match POWERS.get(usize::from(shape.decimals)) {
        #[expect(clippy::cast_precision_loss, reason = "below 2^53")]
        Some(power) if exact => mantissa as f64 / power,
        _ => long(text),
    };
    (if shape.minus { -value } else { value }, shape)
}

/// At most seventeen characters: the digits fit a machine word, so nothing need be checked on the way.
fn short(text: &[u8]) -> (f64, NumberShape) {
    let mut mantissa: u64 = 0;
    let (mut digits, mut before_point, mut point, mut minus) = (0_u8, 0_u8, false, false);
    for byte in text {
        let digit = byte.wrapping_sub(b'0');
        if digit < 10 {
            mantissa = mantissa * 10 + u64::from(digit);
            digits += 1;
        } else if *byte == b'.' {
            point = true;
            before_point = digits;
        } else {
            minus ^= *byte == b'-';
        }
    }
    let whole_digits = if point { before_point } else { digits };
    let shape = NumberShape { whole_digits, decimals: digits - whole_digits, point, minus };
    // Both operands are exact, so the quotient is the correctly rounded value of the decimal.
    let value = match POWERS.get(usize::from(shape.decimals)) {
        #[expect(clippy::cast_precision_loss, reason = "below 2^53")]
        Some(power) if mantissa < 1 << 53 => mantissa as f64 / power,
        _ => long(text),
    };
    (if minus { -value } else { value }, shape)
}

/// The value of at most fifteen digits, `decimals` of them after the point.
#[inline]
pub(crate) fn of_digits(digits: u64, decimals: usize) -> f64 {
    // Both operands are exact, so the quotient is the correctly rounded value of the decimal.
    #[expect(clippy::cast_precision_loss, clippy::cast_possible_wrap, reason = "10^15 is below 2^53")]
    // Signed, because that is one instruction.
    let value = digits as i64 as f64;
    value / POWERS.get(decimals).copied().unwrap_or(1.0)
}

/// More digits than arithmetic on machine words holds: the standard library's exact algorithm.
fn long(text: &[u8]) -> f64 {
    let digits: String =
        text.iter().filter(|b| b.is_ascii_digit() || **b == b'.').map(|b| char::from(*b)).collect();
    digits.parse().unwrap_or(f64::INFINITY)
}

static POWERS: [f64; 16] =
    [1e0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9, 1e10, 1e11, 1e12, 1e13, 1e14, 1e15];

#[cfg(test)]
mod tests {
    use super::parse;

    #[test]
    fn values_are_those_of_the_standard_library() {
        for text in [
            "0",
            "1.",
            ".5",
            "12.0004",
            "123456789.123456",
            "0.1",
            "99999999999999999999.5",
            "1.23456789012345678901",
        ] {
            let (value, _) = parse(text.as_bytes());
            assert_eq!(
                value.to_bits(),
                text.trim_end_matches('.').parse::<f64>().unwrap().to_bits(),
                "{text}"
            );
        }
    }

    #[test]
    fn shape_keeps_what_is_written() {
        let (value, shape) = parse(b"-01.50");
        assert_eq!(value.to_bits(), (-1.5_f64).to_bits());
        assert_eq!((shape.whole_digits, shape.decimals, shape.point, shape.minus), (2, 2, true, true));
        assert_eq!(parse(b"1. 5").0.to_bits(), 1.5_f64.to_bits());
    }
}
