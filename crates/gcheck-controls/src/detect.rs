//! Which control a program is written for, guessed from what it uses.
//!
//! Knows: the hints of each control and how to weigh them. Must not know: how evidence is found in a program; the caller
//! collects [`Evidence`] from comments, codes and forms of syntax.

use crate::Hint;
use crate::UnsupportedDialect;
use crate::loader::all_control_files;
use crate::whole_word::contains_word;

/// What a program shows of itself.
#[derive(Debug, Clone, Default)]
pub struct Evidence {
    /// Texts of the comments of the first lines.
    pub comments: Vec<String>,
    /// Codes the program uses, canonical (`G154`).
    pub codes: Vec<String>,
    /// Forms of syntax the program uses, by the names that [`crate::Hint::form`] lists.
    pub forms: Vec<String>,
    /// How the name of its file ends, without the dot, in lower case; `None` where it has no name.
    pub extension: Option<String>,
    /// It is of a dialect that no control here reads.
    pub unsupported: Option<&'static UnsupportedDialect>,
}

/// A guess and its reason.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Guess {
    /// The control's name.
    pub control: String,
    /// The piece of the program that counted most, as written: a comment's text, a code, a form, or the end of its name.
    pub because: String,
}

/// What the evidence is worth for one control.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Score {
    /// The control and the piece of the program that counted most for it.
    pub guess: Guess,
    /// Sum of the weights of the hints found.
    pub points: i32,
    /// Hints found that speak against the control.
    pub against: usize,
}

/// What the evidence is worth for each control, the best first. Controls without any hint found are left out.
pub fn scores(evidence: &Evidence) -> Vec<Score> {
    let mut scores: Vec<Score> =
        all_control_files().filter_map(|file| score(&file.name, &file.detect, evidence)).collect();
    scores.sort_by(|a, b| b.points.cmp(&a.points).then_with(|| a.guess.control.cmp(&b.guess.control)));
    scores
}

fn score(control: &str, hints: &[Hint], evidence: &Evidence) -> Option<Score> {
    let mut points = 0;
    let mut against = 0;
    let mut best: (i32, Option<String>) = (i32::MIN, None);
    for hint in hints {
        let found = match (&hint.comment, &hint.code, &hint.form) {
            (Some(text), _, _) => {
                evidence.comments.iter().find(|c| contains_word(c, text)).map(|c| format!("({c})"))
            }
            (None, Some(code), _) => evidence.codes.iter().find(|c| *c == code).cloned(),
            (None, None, Some(form)) => evidence.forms.iter().find(|f| *f == form).cloned(),
            (None, None, None) => {
                let same = hint.extension.is_some() && hint.extension == evidence.extension;
                hint.extension.as_ref().filter(|_| same).map(|extension| format!(".{extension}"))
            }
        };
        if let Some(found) = found {
            points += hint.weight;
            against += usize::from(hint.weight < 0);
            if hint.weight > best.0 {
                best = (hint.weight, Some(found));
            }
        }
    }
    Some(Score { guess: Guess { control: control.to_owned(), because: best.1? }, points, against })
}

/// Fewer points than these are too little to name a control: comments after `;` or words in lower case alone.
const ENOUGH_POINTS: i32 = 3;

/// The control that the evidence speaks for, or `None` when it says too little, or the same of two.
pub fn guess(evidence: &Evidence) -> Option<Guess> {
    let scores = scores(evidence);
    match scores.as_slice() {
        [first, second, ..] if first.points == second.points => None,
        [first, ..] if first.points >= ENOUGH_POINTS => Some(first.guess.clone()),
        _ => None,
    }
}
