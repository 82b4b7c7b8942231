//! Dwells: which word holds the time, in which unit, and which times are likely.
//!
//! Knows: how controls read a dwell's time. Must not know: any rule.

use gcheck_controls::{Code, DwellWord, Effect, Letter, LetterSet};
use gcheck_program::Word;

use crate::{BlockCx, PathCx};

/// Seconds: longer than any warm-up of a spindle step, shorter than a second meant as milliseconds.
pub(crate) const LONG: f64 = 300.0;
/// Seconds: less than a spindle needs for a turn.
pub(crate) const SHORT: f64 = 0.02;

/// A time for people: `0.5 seconds`, `8 minutes`, `28 hours`.
pub(crate) fn duration(seconds: f64) -> String {
    const MINUTE: f64 = 60.0;
    const HOUR: f64 = 60.0 * MINUTE;
    let (value, unit) = if seconds < 0.1 {
        (seconds * 1000.0, "milliseconds")
    } else if seconds < 2.0 * MINUTE {
        (seconds, "seconds")
    } else if seconds < 2.0 * HOUR {
        (seconds / MINUTE, "minutes")
    } else {
        (seconds / HOUR, "hours")
    };
    let text = match (value < 10.0, seconds < 2.0 * MINUTE) {
        (true, true) => format!("{value:.2}"),
        (true, false) => format!("{value:.1}"),
        (false, _) => format!("{value:.0}"),
    };
    let text = if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.') } else { &text };
    if text == "1" { format!("1 {}", unit.trim_end_matches('s')) } else { format!("{text} {unit}") }
}

/// The time on a control that counts in the other unit, where the control was only guessed.
pub(crate) fn of_another_control(seconds: f64) -> String {
    format!("the control was guessed: one that counts in the other unit waits {}", duration(seconds))
}

/// Seconds that a dwell by `P` lasts on controls that count it in the other unit; `None` where every control that takes the
/// word reads the same time, or the control was chosen.
pub(crate) fn other_reading(cx: &PathCx<'_>, seconds: f64) -> Option<f64> {
    let p = Letter::of('P');
    let kind = cx.model.semantics().dwell.iter().find(|(letter, _)| Letter::parse(letter) == Some(p));
    let (_, kind) = kind.filter(|_| !cx.environment.control_is_chosen() && seconds > 0.0)?;
    let place = cx.place()?;
    let word = place.table.words(place.block()).iter().find(|word| word.letter == p)?;
    // A time with a decimal point is in seconds wherever it is accepted; what is computed is unit and number in one.
    if word.shape.point || word.number().is_none() {
        return None;
    }
    Some(match kind {
        DwellWord::Seconds => seconds / 1000.0,
        DwellWord::Milliseconds | DwellWord::SecondsOrMilliseconds => seconds * 1000.0,
    })
}

/// Words that hold the time of a dwell on one control or another.
const TIME_WORDS_ANYWHERE: LetterSet = LetterSet::of("PXU");

/// The word that is meant as the time of a dwell, where the control reads none of the block's words as that.
pub(crate) fn time_in_other_word<'a>(cx: &BlockCx<'a>, code: Code<'_>) -> Option<&'a Word> {
    if code.effect() != Effect::Dwell || !cx.words_are_plain() {
        return None;
    }
    // Another code of the block may read the word: a move, a work offset.
    let is_alone = cx.codes().all(|(_, other)| other.number() == code.number());
    let times = time_words(cx);
    if !is_alone || times.is_empty() || cx.block().letters.intersects(times) {
        return None;
    }
    // `G4 X2. Y3.` is more likely a move that lost its code.
    let mut axes = cx.words().iter().filter(|word| cx.control().axes().contains(word.letter));
    axes.next();
    if axes.next().is_some() {
        return None;
    }
    cx.first_of(TIME_WORDS_ANYWHERE.without(times))
}

/// Words that hold the time of a dwell on this control.
pub(crate) fn time_words(cx: &BlockCx<'_>) -> LetterSet {
    let letters = cx.control().semantics().dwell.keys().filter_map(|letter| Letter::parse(letter));
    letters.fold(LetterSet::EMPTY, |mut set, letter| {
        set.insert(letter);
        set
    })
}
