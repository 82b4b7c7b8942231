//! The number of a G or M code, as an integer that can be compared and used as an index.

use std::fmt;

/// `G54.1` or `M6`: a letter and a number in tenths.
///
/// Controls write at most one decimal on a code (`G5.1`, `G59.3`, `G92.1`); leading zeros do not matter (`G01` = `G1`).
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct CodeNumber {
    letter: u8,
    tenths: u16,
}

impl CodeNumber {
    /// Highest number that any control uses, in tenths.
    pub const MAX_TENTHS: u16 = 9_999;

    /// A whole G code.
    pub const fn g(number: u16) -> Self {
        Self { letter: b'G', tenths: number * 10 }
    }

    /// A whole M code.
    pub const fn m(number: u16) -> Self {
        Self { letter: b'M', tenths: number * 10 }
    }

    /// The code that `letter` (`G` or `M`, upper case) and a number in tenths name; `None` when out of range.
    pub fn from_tenths(letter: u8, tenths: u32) -> Option<Self> {
        let tenths = u16::try_from(tenths).ok().filter(|t| *t <= Self::MAX_TENTHS)?;
        matches!(letter, b'G' | b'M').then_some(Self { letter, tenths })
    }

    /// The code that a value names, if it is a whole number of tenths within 1e-4 (LinuxCNC's tolerance for codes).
    pub fn from_value(letter: u8, value: f64) -> Option<Self> {
        let tenths = value * 10.0;
        let rounded = tenths.round();
        if !(0.0..=f64::from(Self::MAX_TENTHS)).contains(&rounded) || (tenths - rounded).abs() > 1e-3 {
            return None;
        }
        #[expect(clippy::cast_sign_loss, reason = "range checked above")]
        Self::from_tenths(letter, rounded as u32)
    }

    /// Reads `G43`, `g01`, `M6`, `G54.1`.
    pub fn parse(text: &str) -> Option<Self> {
        let (letter, digits) = text.split_at_checked(1)?;
        let (whole, fraction) = digits.split_once('.').unwrap_or((digits, "0"));
        if whole.is_empty() || whole.len() > 4 || fraction.len() != 1 {
            return None;
        }
        let is_number = |s: &str| s.bytes().all(|b| b.is_ascii_digit());
        if !is_number(whole) || !is_number(fraction) {
            return None;
        }
        let tenths = whole.parse::<u32>().ok()? * 10 + fraction.parse::<u32>().ok()?;
        Self::from_tenths(letter.as_bytes().first()?.to_ascii_uppercase(), tenths)
    }

    /// `b'G'` or `b'M'`.
    pub fn letter(self) -> u8 {
        self.letter
    }

    /// The number in tenths: 541 for `G54.1`.
    pub fn tenths(self) -> u16 {
        self.tenths
    }
}

impl fmt::Display for CodeNumber {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}{}", char::from(self.letter), self.tenths / 10)?;
        match self.tenths % 10 {
            0 => Ok(()),
            tenth => write!(f, ".{tenth}"),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::CodeNumber;

    #[test]
    fn leading_zeros_and_case_do_not_matter() {
        assert_eq!(CodeNumber::parse("g01"), Some(CodeNumber::g(1)));
        assert_eq!(CodeNumber::parse("G54.1").map(|c| c.to_string()).as_deref(), Some("G54.1"));
        assert_eq!(CodeNumber::parse("M06").map(|c| c.to_string()).as_deref(), Some("M6"));
    }

    #[test]
    fn what_is_no_code_is_refused() {
        for text in ["", "G", "X1", "G1.25", "G12345", "G1.x", "Gé"] {
            assert_eq!(CodeNumber::parse(text), None, "{text}");
        }
        assert_eq!(CodeNumber::from_value(b'G', 54.15), None);
        assert_eq!(CodeNumber::from_value(b'G', -1.0), None);
        assert_eq!(CodeNumber::from_value(b'G', f64::NAN), None);
    }
}
