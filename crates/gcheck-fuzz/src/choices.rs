//! Bytes as choices.
//!
//! Knows: how a byte becomes a number below another. Must not know: what is chosen.
//!
//! When the bytes run out each choice is 0, which is always the plainest: an input that is cut short still means something.

/// Bytes that are taken one by one.
#[derive(Debug, Clone)]
pub(crate) struct Choices<'b> {
    bytes: &'b [u8],
}

impl<'b> Choices<'b> {
    pub(crate) fn new(bytes: &'b [u8]) -> Self {
        Self { bytes }
    }

    /// Are there no more?
    pub(crate) fn is_empty(&self) -> bool {
        self.bytes.is_empty()
    }

    /// The next byte.
    pub(crate) fn byte(&mut self) -> u8 {
        let Some((first, rest)) = self.bytes.split_first() else { return 0 };
        self.bytes = rest;
        *first
    }

    /// A number below `of`; 0 if `of` is 0.
    pub(crate) fn below(&mut self, of: usize) -> usize {
        let wide = of > 256;
        let number = usize::from(self.byte()) + if wide { usize::from(self.byte()) << 8 } else { 0 };
        number.checked_rem(of).unwrap_or(0)
    }

    /// One of several; `None` if there is none.
    pub(crate) fn one<'o, T>(&mut self, of: &'o [T]) -> Option<&'o T> {
        of.get(self.below(of.len()))
    }

    /// One of several texts.
    pub(crate) fn text<'o>(&mut self, of: &[&'o str]) -> &'o str {
        self.one(of).copied().unwrap_or_default()
    }

    /// The next few bytes.
    pub(crate) fn take(&mut self, count: usize) -> &'b [u8] {
        let (taken, rest) = self.bytes.split_at(count.min(self.bytes.len()));
        self.bytes = rest;
        taken
    }

    /// All that are left.
    pub(crate) fn rest(&mut self) -> &'b [u8] {
        self.take(self.bytes.len())
    }
}
