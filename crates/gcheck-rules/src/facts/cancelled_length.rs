//! A tool length that is over: by the code that ends it, or by offset number zero where the control takes it so.
//!
//! Knows: which words end a length, what was in effect before. Must not know: any rule, wording.

use gcheck_controls::{Effect, Letter};
use gcheck_engine::{Abstract, At, Domain, Fact, Role};

use crate::PathCx;

/// Was the length cancelled, and is none in effect? The fact says where to look for the block that did it.
pub(crate) fn cancelled(cx: &PathCx<'_>) -> Option<Fact> {
    match cx.state().effect(Role::Length, cx.model)? {
        Effect::LengthOff => Some(Fact::Mode(Role::Length)),
        Effect::LengthPlus | Effect::LengthMinus if is_zero_number_in_effect(cx) => Some(Fact::Length),
        _ => None,
    }
}

/// Does the block end the length that is in effect before it? Where, and what it says for that: `G49`, `H00`.
pub(crate) fn ending(cx: &PathCx<'_>) -> Option<String> {
    let effect = cx.state().effect(Role::Length, cx.model)?;
    if !matches!(effect, Effect::LengthPlus | Effect::LengthMinus | Effect::LengthFiveAxis) {
        return None;
    }
    if let Some(code) = cx.code_of_role(Role::Length) {
        return (cx.model.effect(code) == Effect::LengthOff).then(|| cx.name_of(code));
    }
    let takes_zero = effect == Effect::LengthFiveAxis || cx.model.semantics().zero_length_number_cancels;
    (takes_zero && cx.known_number('H') == Some(0.0)).then(|| number_as_written(cx, cx.origin().at))
}

/// The word of an offset number as its block has it.
pub(crate) fn number_as_written(cx: &PathCx<'_>, at: At) -> String {
    let range = cx.find_word(at, |word| word.letter == Letter::of('H'));
    let file = cx.program.file(at.file);
    let text = range.zip(file.as_ref()).map(|(range, file)| file.loaded.slice(range).to_owned());
    text.unwrap_or_else(|| "H0".to_owned())
}

/// A block without a code for the length gave the number zero, and the control takes that for the end.
fn is_zero_number_in_effect(cx: &PathCx<'_>) -> bool {
    if !cx.model.semantics().zero_length_number_cancels || Abstract::known(cx.state().h()) != Some(0.0) {
        return false;
    }
    let Some(at) = cx.definitions().set_by(Fact::Length) else { return false };
    let is_of_length =
        |word: &gcheck_program::Word| word.code.is_some() && cx.model.role(word.code) == Some(Role::Length);
    cx.find_word(at, is_of_length).is_none()
}
