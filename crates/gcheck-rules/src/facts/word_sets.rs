//! Sets of addresses: as contracts state them, as findings name them, as modes read them.
//!
//! Knows: how they are written, what lasting codes read. Must not know: any rule.

use gcheck_controls::{Code, Control, GroupIx, Handling, LetterSet, Motion};

/// Words of cylindrical mapping that need a rotary axis beside them.
pub(crate) const NEED_A_ROTARY_AXIS: LetterSet = LetterSet::of("XYZQR");

/// Addresses for people: "`I`, `J` or `R`".
pub(crate) fn choice(letters: LetterSet) -> String {
    let names: Vec<String> = letters.iter().map(|letter| format!("`{letter}`")).collect();
    match names.split_last() {
        Some((last, [])) => last.clone(),
        Some((last, others)) => format!("{} or {last}", others.join(", ")),
        None => String::new(),
    }
}

/// Addresses that some mode reads which may be on beside the codes of a block.
pub(crate) fn read_by_modes<'c, I: Iterator<Item = Code<'c>>>(
    control: &Control,
    codes: impl Fn() -> I,
) -> LetterSet {
    let moves = |code: Code<'_>| code.motion() != Motion::None;
    let here = |group: GroupIx| codes().any(|code| code.group_ix() == group);
    // A motion or a cycle of this block takes the place of the one in effect, and so does a code that takes the axes.
    let replaced = codes().any(|code| code.entry().takes_axes || code.group().modal && moves(code));
    let refuses = control.block_rules().unread_word == Handling::Refused;
    let lasting = control.codes().filter(|code| code.group().modal && !here(code.group_ix()));
    // Where unread words are refused, a word is for a code of its own block or for the motion in effect.
    let readers = lasting.filter(|code| if moves(*code) { !replaced } else { !refuses });
    readers.fold(LetterSet::EMPTY, |set, code| set.or(code.reads()))
}
