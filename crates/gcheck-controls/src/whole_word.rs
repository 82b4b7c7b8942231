//! Whole words in a text.
//!
//! Knows: where a word begins and ends. Must not know: what a word is a hint of.

use std::borrow::Cow;

/// A text in which many words are looked for, in any case.
#[derive(Debug)]
pub(crate) struct Words {
    /// In lower case.
    text: String,
    /// Where a word may begin, rising.
    starts: Vec<u32>,
    /// By the [drawer](drawer) of the first two letters: the first of `starts`.
    first: Vec<u32>,
    /// For each of `starts`, the next one of its drawer.
    next: Vec<u32>,
}

/// No further place.
const NONE: u32 = u32::MAX;
/// Two letters of 32 each.
const DRAWERS: usize = 32 * 32;

impl Words {
    pub(crate) fn of(text: &str) -> Self {
        let text = text.to_ascii_lowercase();
        let mut starts = Vec::new();
        let mut is_inside = false;
        for (at, letter) in text.char_indices() {
            if !is_inside {
                starts.push(at as u32);
            }
            is_inside = letter.is_alphanumeric();
        }
        let (mut first, mut next) = (vec![NONE; DRAWERS], vec![NONE; starts.len()]);
        // From the end, so that each drawer is rising.
        for ((ix, at), next) in starts.iter().enumerate().zip(&mut next).rev() {
            if let Some(first) =
                first.get_mut(drawer(text.as_bytes().get(*at as usize..).unwrap_or_default()))
            {
                *next = std::mem::replace(first, ix as u32);
            }
        }
        Self { text, starts, first, next }
    }

    /// Is the word in the text as a whole? `VF-2` is in `POSTED FOR VF-2`, not in `VF-22`.
    pub(crate) fn have(&self, word: &str) -> bool {
        self.find(word).is_some()
    }

    /// Where the word is in the text as a whole for the first time, in bytes.
    pub(crate) fn find(&self, word: &str) -> Option<usize> {
        let word = lower(word);
        if word.is_empty() {
            return None;
        }
        let mut ix = self.first.get(drawer(word.as_bytes())).copied()?;
        while let Some(at) = self.starts.get(ix as usize).map(|at| *at as usize) {
            let rest = self.text.get(at..).and_then(|rest| rest.strip_prefix(&*word));
            if rest.is_some_and(|rest| !rest.starts_with(char::is_alphanumeric)) {
                return Some(at);
            }
            ix = self.next.get(ix as usize).copied()?;
        }
        None
    }
}

/// Where words are that begin as this text: by its first letter, and by the second if that is a letter or digit of ASCII.
fn drawer(text: &[u8]) -> usize {
    let part = |byte: Option<&u8>| usize::from(byte.map_or(0, |byte| byte & 31));
    let second = text.get(1).filter(|byte| byte.is_ascii_alphanumeric());
    part(text.first()) * 32 + part(second)
}

/// Most words of the data are in lower case already.
fn lower(word: &str) -> Cow<'_, str> {
    if word.bytes().any(|byte| byte.is_ascii_uppercase()) {
        Cow::Owned(word.to_ascii_lowercase())
    } else {
        Cow::Borrowed(word)
    }
}

#[cfg(test)]
mod tests {
    use super::Words;

    #[test]
    fn hints_match_whole_words_only() {
        assert!(Words::of("posted for VF-2 / inch").have("vf-2"));
        assert!(!Words::of("VF-22").have("VF-2"));
        assert!(Words::of("VF-22, then vf-2").have("VF-2"));
        assert_eq!(Words::of("a vf-2 and a vf-2").find("VF-2"), Some(2));
        assert!(
            Words::of("5\u{b0} a\u{b0}").have("a") && Words::of("x").have("X") && !Words::of("").have("")
        );
    }
}
