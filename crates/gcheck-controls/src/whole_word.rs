//! Whole words in a text.
//!
//! Knows: where a word begins and ends. Must not know: what a word is a hint of.

use std::borrow::Cow;

/// A text in which many words are looked for, in any case.
#[derive(Debug)]
pub(crate) struct Words {
    /// In lower case.
    text: String,
    /// By its first byte: where a word may begin.
    starts: Vec<Vec<u32>>,
}

impl Words {
    pub(crate) fn of(text: &str) -> Self {
        let text = text.to_ascii_lowercase();
        let mut starts = vec![Vec::new(); 256];
        let mut is_inside = false;
        for (at, letter) in text.char_indices() {
            if !is_inside
                && let Some(first) = text.as_bytes().get(at)
                && let Some(starts) = starts.get_mut(usize::from(*first))
            {
                starts.push(at as u32);
            }
            is_inside = letter.is_alphanumeric();
        }
        Self { text, starts }
    }

    /// Is the word in the text as a whole? `VF-2` is in `POSTED FOR VF-2`, not in `VF-22`.
    pub(crate) fn have(&self, word: &str) -> bool {
        let word = lower(word);
        let Some(first) = word.bytes().next() else { return false };
        self.starts.get(usize::from(first)).into_iter().flatten().any(|at| {
            let rest = self.text.get(*at as usize..).and_then(|rest| rest.strip_prefix(&*word));
            rest.is_some_and(|rest| !rest.starts_with(char::is_alphanumeric))
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
