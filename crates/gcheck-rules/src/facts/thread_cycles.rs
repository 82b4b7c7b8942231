//! The words of a threading cycle of several passes: which word is the height, the first cut, the lead, and their lengths.
//!
//! Knows: the forms of one block and of two, where the tool is when the cycle starts. Must not know: any rule, what was turned.

use gcheck_controls::{Effect, LetterSet};
use gcheck_engine::{Axis, Event, Travel, TravelKind};
use gcheck_program::Word;

use crate::PathCx;
use crate::facts::threads::trimmed;

/// Does the code cut a thread in several passes?
pub(crate) fn is_cycle(effect: Effect) -> bool {
    effect == Effect::ThreadCycle
}

/// Words of a cycle of several passes.
pub(crate) struct Words {
    /// From crest to root, in X as a radius.
    pub(crate) height: Word,
    /// Depth of the first pass.
    pub(crate) first: Option<Word>,
    /// Length a turn.
    pub(crate) lead: Option<Word>,
}

/// In the form that the block uses; `None` for a first block of two, which only prepares.
pub(crate) fn words(cx: &PathCx<'_>) -> Option<Words> {
    let letters = cx.origin().letters;
    let has = |of: &'static str| letters.intersects(LetterSet::of(of));
    if !has("XZUW") {
        return None;
    }
    let code = cx.codes().iter().copied().find(|code| is_cycle(cx.model.effect(*code)))?;
    let names_peak = cx.code_of(code)?.entry().words.iter().any(|word| word.letter == "J");
    let [height, first, lead] = match (names_peak, has("KD")) {
        (true, _) => ['K', 'J', 'P'],
        (false, true) => ['K', 'D', 'F'],
        (false, false) => ['P', 'Q', 'F'],
    };
    Some(Words { height: cx.word(height)?, first: cx.word(first), lead: cx.word(lead) })
}

/// The number of a word of the block; `None` for a computed one that is not known.
pub(crate) fn number(cx: &PathCx<'_>, word: &Word) -> Option<f64> {
    cx.known_number(word.letter.ascii().into())
}

/// Does the number count as one with a decimal point?
pub(crate) fn is_pointed(cx: &PathCx<'_>, word: &Word) -> bool {
    word.shape.point || word.is_computed() && cx.model.semantics().computed_words_are_pointed
}

/// Millimetres; `None` for a computed word that is not known. Without a point, lengths of a cycle count least increments on the controls that
/// write leads with a point.
pub(crate) fn length(cx: &PathCx<'_>, word: &Word) -> Option<f64> {
    Some(number(cx, word)? * step(cx, word)?)
}

/// The number that the word needs for a length in millimetres, with as many digits as it may have.
pub(crate) fn written(cx: &PathCx<'_>, word: &Word, length: f64) -> Option<String> {
    let step = step(cx, word)?;
    let number = length / step;
    Some(trimmed(if step < COUNTED { number.round() } else { number }))
}

/// A word whose one is shorter counts least increments: millimetres.
const COUNTED: f64 = 0.01;

/// What one stands for in the word: millimetres.
fn step(cx: &PathCx<'_>, word: &Word) -> Option<f64> {
    let units = cx.state().units(cx.model)?;
    let as_written = cx.control().numbers().unpointed == gcheck_controls::Unpointed::AsWritten;
    let least = match units {
        gcheck_engine::Units::Inch => 0.0001,
        gcheck_engine::Units::Mm => 0.001,
    };
    let is_feed = word.letter == gcheck_controls::Letter::of('F');
    let step = if is_pointed(cx, word) || as_written || is_feed { 1.0 } else { least };
    // The form that names the peak counts its depths like X.
    let counts_twice = word.letter == gcheck_controls::Letter::of('K')
        && cx.word('J').is_some()
        && cx.state().is_diameter(cx.model)?;
    Some(step * units.in_mm() / if counts_twice { 2.0 } else { 1.0 })
}

/// Radii of the start and of the root, and the height: millimetres. The tool still is where the cycle of the block starts.
pub(crate) fn radii(cx: &PathCx<'_>, height: &Word) -> Option<[f64; 3]> {
    let start = cx.state().position().get(Axis::X)?;
    let half = if cx.state().is_diameter(cx.model)? { 2.0 } else { 1.0 };
    let unit = cx.state().units(cx.model)?.in_mm() / half;
    let root = match cx.known_number('X') {
        Some(x) => x * unit,
        None => start + cx.known_number('U')? * unit,
    };
    let is_plain = start > 0.0 && root > 0.0;
    length(cx, height).filter(|_| is_plain).map(|height| [start, root, height])
}

/// The words of a cycle whose crest and root are known diameters: it runs on every path, is not a taper, has its height as a written number, and
/// counts from its root. The form that names the peak begins at its drive line.
pub(crate) fn straight_words(cx: &PathCx<'_>) -> Option<Words> {
    let is_judged = cx.has_effect(is_cycle) && !cx.is_malformed() && cx.is_on_every_path() && !is_tapered(cx);
    // Whether a computed height counts least increments differs from control to control.
    words(cx).filter(|words| is_judged && cx.word('J').is_none() && !words.height.is_computed())
}

/// A straight cycle from its block to its first pass.
#[derive(Debug, Clone, Default, PartialEq)]
pub(crate) struct FirstPass {
    /// As [`radii`] has them, before the first pass.
    radii: Option<[f64; 3]>,
}

impl FirstPass {
    /// Takes note of the block.
    pub(crate) fn block(&mut self, cx: &PathCx<'_>) {
        self.radii = straight_words(cx).and_then(|words| radii(cx, &words.height));
    }

    /// Radii of the start and of the root, the height, and the move, if it is the first pass of the cycle.
    pub(crate) fn moved<'e>(&mut self, event: &'e Event) -> Option<([f64; 3], &'e Travel)> {
        let Event::Travel(travel) = event else { return None };
        let is_pass = travel.kind == TravelKind::Thread;
        Some((self.radii.take_if(|_| is_pass)?, travel))
    }
}

/// Does a word of the block make the thread a taper, as far as is known?
fn is_tapered(cx: &PathCx<'_>) -> bool {
    let taper = ['R', 'I'].into_iter().find(|letter| cx.word(*letter).is_some());
    taper.is_some_and(|letter| cx.known_number(letter) != Some(0.0))
}
