//! Whole words in a text.
//!
//! Knows: where a word begins and ends. Must not know: what a word is a hint of.

/// Whole words, any case: `VF-2` is in `POSTED FOR VF-2`, not in `VF-22`.
pub(crate) fn contains_word(text: &str, word: &str) -> bool {
    let text = text.to_ascii_lowercase();
    let word = word.to_ascii_lowercase();
    text.match_indices(&word).any(|(at, _)| {
        let before = text.get(..at).and_then(|t| t.chars().next_back());
        let after = text.get(at + word.len()..).and_then(|t| t.chars().next());
        !before.is_some_and(char::is_alphanumeric) && !after.is_some_and(char::is_alphanumeric)
    })
}

#[cfg(test)]
mod tests {
    use super::contains_word;

    #[test]
    fn hints_match_whole_words_only() {
        assert!(contains_word("posted for VF-2 / inch", "vf-2"));
        assert!(!contains_word("VF-22", "VF-2"));
    }
}
