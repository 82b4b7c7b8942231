//! Numbers of many points in few bytes.
//!
//! Knows: differences and runs as bytes of seven bits, base64. Must not know: what the numbers mean.
//!
//! A whole number is written in groups of seven bits, the lowest first; every byte but the last has its highest bit set. A
//! number that may be negative is doubled first, and a negative one becomes odd: 0, -1, 1, -2 are 0, 1, 2, 3.

use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;

/// The largest that is written, so that a reader in double precision stays exact after it was doubled.
const MOST: f64 = 4e15;

/// The difference of each row of numbers to the row before, the first to zero; in steps of `step`.
pub(super) fn differences<const N: usize>(rows: impl Iterator<Item = [f64; N]>, step: f64) -> String {
    let mut bytes = Vec::new();
    let mut before = [0_i64; N];
    for row in rows {
        for (value, last) in row.into_iter().zip(&mut before) {
            // A value beyond all machines is cut, and NaN becomes 0.
            let next = (value / step).round().clamp(-MOST, MOST) as i64;
            let difference = next - *last;
            #[expect(clippy::cast_sign_loss, reason = "the sign is the lowest bit")]
            number(&mut bytes, ((difference << 1) ^ (difference >> 63)) as u64);
            *last = next;
        }
    }
    STANDARD.encode(bytes)
}

/// How often each number comes one after the other, and the number.
pub(super) fn runs(values: impl Iterator<Item = u16>) -> String {
    let mut bytes = Vec::new();
    let mut run: Option<(u64, u16)> = None;
    let mut close = |run: Option<(u64, u16)>| {
        if let Some((length, value)) = run {
            number(&mut bytes, length);
            number(&mut bytes, value.into());
        }
    };
    for value in values {
        run = match run {
            Some((length, last)) if last == value => Some((length + 1, last)),
            other => {
                close(other);
                Some((1, value))
            }
        };
    }
    close(run);
    STANDARD.encode(bytes)
}

fn number(bytes: &mut Vec<u8>, mut value: u64) {
    while value > 0x7F {
        bytes.push((value & 0x7F) as u8 | 0x80);
        value >>= 7;
    }
    bytes.push(value as u8);
}

#[cfg(test)]
mod tests {
    use base64::Engine as _;
    use base64::engine::general_purpose::STANDARD;

    use super::{differences, runs};

    fn bytes(text: &str) -> Vec<u8> {
        STANDARD.decode(text).unwrap()
    }

    #[test]
    fn a_small_step_is_a_byte_whatever_its_sign() {
        let rows = [[0.1, 0.0], [0.1, -0.1], [0.3, -0.1]];
        assert_eq!(bytes(&differences(rows.into_iter(), 0.1)), [2, 0, 0, 1, 4, 0]);
    }

    #[test]
    fn a_large_step_is_as_many_groups_of_seven_bits_as_it_needs() {
        // 2 * 1,000,000 = 0b1111010_0001001_0000000.
        assert_eq!(bytes(&differences([[100.0]].into_iter(), 1e-4)), [0x80, 0x89, 0x7A]);
    }

    #[test]
    fn what_stays_is_told_once() {
        assert_eq!(bytes(&runs([3, 3, 3, 0, 300].into_iter())), [3, 3, 1, 0, 1, 0xAC, 0x02]);
        assert_eq!(runs(std::iter::empty()), "");
    }
}
