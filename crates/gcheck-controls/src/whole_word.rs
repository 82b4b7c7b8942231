//! Whole words in a text.
//!
//! Knows: where a word begins and ends. Must not know: what a word is a hint of.

use std::borrow::Cow;

use memchr::memchr_iter;

/// A text in which many words are looked for, in any case.
#[derive(Debug)]
pub(crate) struct Words(String);

impl Words {
    pub(crate) fn of(text: &str) -> Self {
        Self(text.to_ascii_lowercase())
    }

    /// Is the word in the text as a whole? `VF-2` is in `POSTED FOR VF-2`, not in `VF-22`.
    pub(crate) fn have(&self, word: &str) -> bool {
        let text = &self.0;
        let word = lower(word);
        let Some(first) = word.bytes().next() else { return false };
        // Words are many and texts are short: a search that is made ready for each word costs more than it saves.
        memchr_iter(first, text.as_bytes()).any(|at| {
            if !text.as_bytes().get(at..).is_some_and(|rest| rest.starts_with(word.as_bytes())) {
                return false;
            }
            let before = text.get(..at).and_then(|text| text.chars().next_back());
            let after = text.get(at + word.len()..).and_then(|text| text.chars().next());
            !before.is_some_and(char::is_alphanumeric) && !after.is_some_and(char::is_alphanumeric)
        })
    }
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
    }
}
