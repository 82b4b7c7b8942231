//! Addresses and sets of addresses.

use std::fmt;

/// An address: a letter `A` to `Z`, a corner word `,R` `,C` `,A`, or one of the signs `@` `^` `$` that LinuxCNC adds.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Letter(u8);

impl Letter {
    /// Corner radius, `,R`.
    pub const CORNER_R: Self = Self(26);
    /// Chamfer, `,C`.
    pub const CORNER_C: Self = Self(27);
    /// Angle of a drawing dimension, `,A`.
    pub const CORNER_A: Self = Self(28);

    /// Polar distance, `@`.
    pub const AT: Self = Self(29);
    /// Polar angle, `^`.
    pub const CARET: Self = Self(30);
    /// Spindle selection, `$`.
    pub const DOLLAR: Self = Self(31);

    /// The address of an ASCII letter, either case.
    pub const fn new(letter: u8) -> Option<Self> {
        let upper = letter.to_ascii_uppercase();
        if upper.is_ascii_uppercase() { Some(Self(upper - b'A')) } else { None }
    }

    /// The address of a letter known at compile time; anything but a letter gives `A`.
    pub const fn of(letter: char) -> Self {
        match Self::new(letter as u8) {
            Some(letter) => letter,
            None => Self(0),
        }
    }

    /// The address of a corner word's letter.
    pub const fn corner(letter: u8) -> Option<Self> {
        match letter.to_ascii_uppercase() {
            b'R' => Some(Self::CORNER_R),
            b'C' => Some(Self::CORNER_C),
            b'A' => Some(Self::CORNER_A),
            _ => None,
        }
    }

    /// The address of `@`, `^` or `$`.
    pub const fn sign(sign: u8) -> Option<Self> {
        match sign {
            b'@' => Some(Self::AT),
            b'^' => Some(Self::CARET),
            b'$' => Some(Self::DOLLAR),
            _ => None,
        }
    }

    /// Reads `X`, `,R` or `@`.
    pub fn parse(text: &str) -> Option<Self> {
        match text.as_bytes() {
            [letter] => Self::new(*letter).or_else(|| Self::sign(*letter)),
            [b',', letter] => Self::corner(*letter),
            _ => None,
        }
    }

    /// A small number usable as an index, below [`Letter::COUNT`].
    pub const fn index(self) -> usize {
        self.0 as usize
    }

    /// How many addresses there are.
    pub const COUNT: usize = 32;

    /// The ASCII letter or sign, without the comma of a corner word.
    pub const fn ascii(self) -> u8 {
        match self.0 {
            26 => b'R',
            27 => b'C',
            28 => b'A',
            29 => b'@',
            30 => b'^',
            31 => b'$',
            n => b'A' + n,
        }
    }

    /// `,R`, `,C` or `,A`.
    pub const fn is_corner(self) -> bool {
        matches!(self.0, 26..=28)
    }
}

impl fmt::Display for Letter {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.is_corner() {
            f.write_str(",")?;
        }
        write!(f, "{}", char::from(self.ascii()))
    }
}

impl fmt::Debug for Letter {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Display::fmt(self, f)
    }
}

/// A set of addresses in one machine word.
#[derive(Clone, Copy, PartialEq, Eq, Default, Hash)]
pub struct LetterSet(u32);

impl LetterSet {
    /// No address.
    pub const EMPTY: Self = Self(0);

    /// The set of the given ASCII letters; other characters are left out.
    pub const fn of(letters: &str) -> Self {
        let bytes = letters.as_bytes();
        let mut set = 0;
        let mut ix = 0;
        while ix < bytes.len() {
            #[expect(clippy::indexing_slicing, reason = "`ix` is below the length")]
            if let Some(letter) = Letter::new(bytes[ix]) {
                set |= 1 << letter.0;
            }
            ix += 1;
        }
        Self(set)
    }

    /// The addresses of an item of `one-of` or `not-together`: `R`, `,C`, `@` or several letters as `IJK`.
    pub fn of_item(item: &str) -> Self {
        Letter::parse(item).map_or_else(|| Self::of(item), |letter| Self::from_iter([letter]))
    }

    /// Adds an address; false if it was there already.
    pub const fn insert(&mut self, letter: Letter) -> bool {
        let bit = 1 << letter.0;
        let new = self.0 & bit == 0;
        self.0 |= bit;
        new
    }

    /// Is the address in the set?
    pub const fn contains(self, letter: Letter) -> bool {
        self.0 & (1 << letter.0) != 0
    }

    /// Addresses in both.
    #[must_use]
    pub const fn and(self, other: Self) -> Self {
        Self(self.0 & other.0)
    }

    /// Addresses in either.
    #[must_use]
    pub const fn or(self, other: Self) -> Self {
        Self(self.0 | other.0)
    }

    /// Addresses here but not there.
    #[must_use]
    pub const fn without(self, other: Self) -> Self {
        Self(self.0 & !other.0)
    }

    /// True when no address is in the set.
    pub const fn is_empty(self) -> bool {
        self.0 == 0
    }

    /// True when the sets share an address.
    pub const fn intersects(self, other: Self) -> bool {
        self.0 & other.0 != 0
    }

    /// The addresses, `A` first.
    pub fn iter(self) -> impl Iterator<Item = Letter> {
        let mut left = self.0;
        std::iter::from_fn(move || {
            let lowest = left.trailing_zeros();
            // Takes the lowest bit away.
            left &= left.checked_sub(1)?;
            Some(Letter(lowest as u8))
        })
    }
}

impl FromIterator<Letter> for LetterSet {
    fn from_iter<I: IntoIterator<Item = Letter>>(letters: I) -> Self {
        let mut set = Self::EMPTY;
        for letter in letters {
            set.insert(letter);
        }
        set
    }
}

impl fmt::Debug for LetterSet {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_set().entries(self.iter()).finish()
    }
}

#[cfg(test)]
mod tests {
    use super::{Letter, LetterSet};

    #[test]
    fn corner_words_are_addresses_of_their_own() {
        let mut set = LetterSet::of("XR");
        assert!(set.insert(Letter::CORNER_R));
        assert!(!set.insert(Letter::of('r')));
        assert_eq!(format!("{set:?}"), "{R, X, ,R}");
        assert_eq!(Letter::parse(",c"), Some(Letter::CORNER_C));
        assert_eq!(Letter::parse("1"), None);
    }
}
