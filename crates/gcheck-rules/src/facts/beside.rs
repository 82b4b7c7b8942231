//! What one word of a block decides about another: `P` of `G10` beside `L2`.
//!
//! Knows: the values of the words of a block, written and computed, and what the control's data say of them. Must not know: any
//! rule.

use gcheck_controls::{Beside, Letter, WordEntry};

use crate::PathCx;

/// A word that does not go with another one.
pub(crate) struct Unfit<'a> {
    /// What is refused.
    pub(crate) beside: &'a Beside,
    /// The other word with its value, as the data have it: `L2`.
    pub(crate) item: &'a str,
    /// The address of the other word.
    pub(crate) other: Letter,
    /// The value, and "small" or "large"; `None` if the word itself is refused.
    pub(crate) outside: Option<(f64, &'static str)>,
}

/// Does the word of an entry not go with another word of the block?
pub(crate) fn unfit<'a>(cx: &PathCx<'_>, entry: &'a WordEntry, letter: Letter) -> Option<Unfit<'a>> {
    if !cx.origin().letters.contains(letter) {
        return None;
    }
    entry.beside.iter().find_map(|beside| {
        let (item, other) = beside.with.iter().find_map(|item| Some((item.as_str(), given(cx, item)?)))?;
        if beside.refused {
            return Some(Unfit { beside, item, other, outside: None });
        }
        let value = number(cx, letter)?;
        let side = outside(value, beside)?;
        Some(Unfit { beside, item, other, outside: Some((value, side)) })
    })
}

/// The address of a word like `L2`, where the block has it with that value; of a letter alone, where the block gives it.
pub(crate) fn given(cx: &PathCx<'_>, item: &str) -> Option<Letter> {
    if let Some(letter) = Letter::parse(item) {
        return cx.word(char::from(letter.ascii())).map(|_| letter);
    }
    let (letter, value) = item.split_at_checked(1)?;
    let (letter, value) = (Letter::parse(letter)?, value.parse::<f64>().ok()?);
    number(cx, letter).is_some_and(|number| (number - value).abs() < 1e-4).then_some(letter)
}

/// The value of a word, written or computed.
pub(crate) fn number(cx: &PathCx<'_>, letter: Letter) -> Option<f64> {
    cx.known_number(char::from(letter.ascii()))
}

fn outside(value: f64, beside: &Beside) -> Option<&'static str> {
    let is_small =
        beside.min.is_some_and(|min| value < min) || beside.above.is_some_and(|above| value <= above);
    if is_small {
        return Some("small");
    }
    beside.max.is_some_and(|max| value > max).then_some("large")
}
