//! The text of a program file, whatever bytes it holds.
//!
//! Knows: bytes and UTF-8. Must not know: lines or tokens.

/// A program as text in which every offset is an offset into the file's bytes.
///
/// Part programs come from serial lines and old editors: some hold Latin-1 or code page bytes in comments. A byte that is
/// not UTF-8 is in [`text`](Self::text) as one [`STAND_IN`](Self::STAND_IN), so that nothing moves; the byte itself is
/// kept aside.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct SourceText {
    text: String,
    /// Offsets of the stand-ins and the bytes they stand for, ascending.
    replaced: Vec<(u32, u8)>,
}

/// A file is longer than offsets can count.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct TooLarge;

impl SourceText {
    /// Stands for a byte that is not UTF-8: the control character SUB, which no program uses.
    pub const STAND_IN: char = '\x1A';

    /// Longest file in bytes; offsets are `u32`.
    pub const MAX_LEN: usize = u32::MAX as usize - 1;

    /// Takes the bytes of a file.
    ///
    /// # Errors
    /// [`TooLarge`] for four gigabytes and more.
    pub fn from_bytes(bytes: Vec<u8>) -> Result<Self, TooLarge> {
        if bytes.len() > Self::MAX_LEN {
            return Err(TooLarge);
        }
        match String::from_utf8(bytes) {
            Ok(text) => Ok(Self { text, replaced: Vec::new() }),
            Err(error) => Ok(Self::replace(error.as_bytes())),
        }
    }

    fn replace(bytes: &[u8]) -> Self {
        let mut text = String::with_capacity(bytes.len());
        let mut replaced = Vec::new();
        for chunk in bytes.utf8_chunks() {
            text.push_str(chunk.valid());
            for byte in chunk.invalid() {
                replaced.push((text.len() as u32, *byte));
                text.push(Self::STAND_IN);
            }
        }
        Self { text, replaced }
    }

    /// The text, with stand-ins.
    pub fn text(&self) -> &str {
        &self.text
    }

    /// Offsets and values of the bytes that are not UTF-8.
    pub fn replaced(&self) -> &[(u32, u8)] {
        &self.replaced
    }

    /// The file's bytes.
    pub fn to_bytes(&self) -> Vec<u8> {
        let mut bytes = self.text.clone().into_bytes();
        for (offset, byte) in &self.replaced {
            if let Some(place) = bytes.get_mut(*offset as usize) {
                *place = *byte;
            }
        }
        bytes
    }
}

impl From<&str> for SourceText {
    fn from(text: &str) -> Self {
        Self { text: text.to_owned(), replaced: Vec::new() }
    }
}
