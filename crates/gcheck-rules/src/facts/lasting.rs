//! Words of earlier blocks that a code relies on.
//!
//! Knows: which words last, by the control's data. Must not know: any rule, values.

use std::collections::HashSet;

use gcheck_controls::{Code, Confidence, Control, LastingEnd, LastingFrom, Letter, LetterSet, Need};
use gcheck_program::{CallKind, FileIndex};

/// Words whose absence rules of their own report: feed, speed, tool, size of cutter compensation.
const OF_OTHER_RULES: LetterSet = LetterSet::of("FSTD");

/// The words that the code takes from earlier blocks, whatever their codes, where its own block does not give them.
pub(crate) fn relied_on(control: &Control, code: Code<'_>) -> LetterSet {
    let entry = code.entry();
    let mut letters = LetterSet::EMPTY;
    // Without the word the code may mean the tool in the spindle.
    if control.semantics().tools.length_from_tool {
        return letters;
    }
    let words = entry.words.iter().filter(|word| word.need == Need::Modal && word.default.is_none());
    for word in words.filter(|word| word.instead.is_empty() && word.instead_here.is_empty()) {
        let Some(letter) = Letter::parse(&word.letter).filter(|letter| !OF_OTHER_RULES.contains(*letter))
        else {
            continue;
        };
        let row = control.lasting_in(letter, &entry.group);
        if row.is_some_and(|row| row.from == LastingFrom::AnyBlock) {
            letters.insert(letter);
        }
    }
    letters
}

/// Does only following the program show whether a word is given? Calls or jumps may run a block that the text has after the
/// code, or one of another file.
pub(crate) fn goes_by_way(file_index: &FileIndex, control: &Control, code: Code<'_>, letter: Letter) -> bool {
    let moves_about = file_index.letters.contains(letter) && !file_index.jumps.is_empty();
    (moves_about || !file_index.calls.is_empty()) && relied_on(control, code).contains(letter)
}

/// Where the text first calls a program that is not in the file: from there on that program may have given any word.
pub(crate) fn first_call_elsewhere(file_index: &FileIndex) -> Option<u32> {
    calls_elsewhere(file_index).next()
}

/// Where the text calls programs that are not in the file, in its order.
pub(crate) fn calls_elsewhere(file_index: &FileIndex) -> impl Iterator<Item = u32> {
    let programs = file_index.programs.iter().filter_map(|program| program.number);
    let here: HashSet<u32> = programs.chain(file_index.labels.iter().map(|label| label.number)).collect();
    let o_words: HashSet<_> = file_index.o_words.iter().map(|word| &word.label).collect();
    let is_elsewhere = move |target: &CallKind| match target {
        CallKind::Program(number) => !here.contains(number),
        CallKind::OWord(label) => !o_words.contains(label),
        CallKind::Unknown => true,
    };
    let calls = file_index.calls.iter();
    calls.filter(move |call| is_elsewhere(&call.target)).map(|call| call.range.start)
}

/// Does the control refuse the code where no block gives the word? Where the end of the program does not forget it, the word of
/// the last program counts.
pub(crate) fn is_refused_without(control: &Control, code: Code<'_>, letter: Letter) -> bool {
    let row = control.lasting_in(letter, &code.entry().group);
    row.is_some_and(|row| row.confidence == Confidence::Manual && row.until.contains(&LastingEnd::ProgramEnd))
}
