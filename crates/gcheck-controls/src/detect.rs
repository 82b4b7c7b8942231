//! Which control a program is written for, guessed from what it uses.
//!
//! Knows: the hints of each control and how to weigh them. Must not know: how evidence is found in a program; the caller
//! collects [`Evidence`] from comments, codes and forms of syntax.

use crate::loader::all_control_files;

/// What a program shows of itself.
#[derive(Debug, Clone, Default)]
pub struct Evidence {
    /// Texts of the comments of the first lines.
    pub comments: Vec<String>,
    /// Codes the program uses, canonical (`G154`).
    pub codes: Vec<String>,
    /// Forms of syntax the program uses, by the names that [`crate::Hint::form`] lists.
    pub forms: Vec<String>,
}

/// A guess and its reason.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Guess {
    /// The control's name.
    pub control: String,
    /// The piece of the program that counted most, as written: a comment's text, a code or a form.
    pub because: String,
}

/// The control that the evidence speaks for, or `None` when it speaks for none or for two alike.
pub fn guess(evidence: &Evidence) -> Option<Guess> {
    let mut scores: Vec<(i32, Guess)> = Vec::new();
    for control in all_control_files() {
        let mut total = 0;
        let mut best: (i32, Option<String>) = (0, None);
        for hint in &control.detect {
            let found = hint.comment.as_ref().map_or_else(
                || {
                    let (list, wanted) = match (&hint.code, &hint.form) {
                        (Some(code), _) => (&evidence.codes, code),
                        (None, Some(form)) => (&evidence.forms, form),
                        (None, None) => return None,
                    };
                    list.iter().find(|have| *have == wanted).cloned()
                },
                |text| evidence.comments.iter().find(|c| contains_word(c, text)).map(|c| format!("({c})")),
            );
            if let Some(found) = found {
                total += hint.weight;
                if hint.weight > best.0 {
                    best = (hint.weight, Some(found));
                }
            }
        }
        if let (true, Some(because)) = (total > 0, best.1) {
            scores.push((total, Guess { control: control.name, because }));
        }
    }
    scores.sort_by_key(|(total, guess)| (-total, guess.control.clone()));
    match scores.as_slice() {
        [(first, _), (second, _), ..] if first == second => None,
        [(_, guess), ..] => Some(guess.clone()),
        [] => None,
    }
}

/// Whole words, any case: `VF-2` is in `POSTED FOR VF-2`, not in `VF-22`.
fn contains_word(text: &str, word: &str) -> bool {
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
