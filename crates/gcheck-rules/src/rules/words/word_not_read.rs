//! A word that nothing reads.

use gcheck_controls::{Code, Control, GroupIx, Handling, LetterSet, Motion};
use gcheck_program::{BlockFlags, Word};

use crate::meta::declare_rule;
use crate::{BlockCx, Finding, Report, Run, Severity, limit};

declare_rule! {
    /// A word stands in a block whose codes do not read it, and nothing that may be in effect reads it either.
    ///
    /// ## Why it matters
    /// Some controls refuse such a block. Others pass over the word: a dwell that does not dwell, an offset that is not taken.
    /// Where it depends on the modes whether the word is read, `word-passed-over` knows more.
    ///
    /// ## Reported
    /// ```nc,reported,linuxcnc
    /// G0 X1. H3
    /// ```
    /// ## Not reported
    /// A word that an earlier code may read:
    /// ```nc,quiet,linuxcnc
    /// M8 R5.
    /// ```
    /// ```nc,quiet,linuxcnc
    /// G43 H3
    /// ```
    rule "word-not-read" in "words" {
        summary: "word that no code reads",
        severity: Error,
        tier: Block,
        mends: OnRequest,
        since: "0.1.0",
        run: Run::Block { trigger: BlockFlags::UNREAD_WORD, check },
    }
}

fn check(cx: &BlockCx<'_>, report: &mut Report<'_>) {
    if !cx.words_are_plain() || cx.block().flags.contains(BlockFlags::STATEMENT) {
        return;
    }
    let mut read = cx.codes().fold(LetterSet::EMPTY, |set, (_, code)| set.or(code.reads()));
    let unread = |word: &&Word, read: LetterSet| {
        let entry = cx.control().letter(word.letter);
        !read.contains(word.letter)
            && entry.is_some_and(|e| !e.free && !e.axis)
            && !matches!(word.letter.ascii(), b'N' | b'O')
    };
    if !cx.words().iter().any(|word| unread(&word, read)) {
        return;
    }
    read = read.or(in_effect(cx));
    for word in cx.words().iter().filter(|word| unread(word, read)) {
        report.add(finding(cx, word));
    }
}

/// Addresses that codes of earlier blocks may read in this one.
fn in_effect(cx: &BlockCx<'_>) -> LetterSet {
    read_by_modes(cx.control(), || cx.codes().map(|(_, code)| code))
}

/// Addresses that some mode reads which may be on beside the codes of a block.
pub(super) fn read_by_modes<'c, I: Iterator<Item = Code<'c>>>(
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

fn finding(cx: &BlockCx<'_>, word: &Word) -> Finding {
    let rules = cx.control().block_rules();
    let letter = word.letter;
    let (does, severity) = match rules.unread_word {
        Handling::Refused => ("refuses a block with such a word", Severity::Error),
        Handling::Ignored | Handling::LastWins | Handling::Accepted => {
            ("passes over such a word", Severity::Info)
        }
    };
    let general = cx.control().letter(letter).map_or("", |entry| entry.is.as_str());
    Finding::new(&META, cx.range(word), format!("no code of the block reads `{}`", cx.text(word)))
        .label(general)
        .note(format!("this control {does}  [{}]", rules.source))
        .help(format!("take `{letter}` away, or add the code that it belongs to"))
        .fix(cx.taking_away(word))
        .at_most(severity)
        .at_most(limit(rules.confidence))
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::Selection;
    use crate::testing::{World, check_rule, findings, words};

    #[test]
    fn a_motion_of_the_block_settles_what_is_read() {
        check_rule(
            &RULE,
            "linuxcnc",
            "G0 X1. P1 H2\nG28 Z0 R3\nM8 R5.\nX1. R5.\nG1 X#1 F100.\n",
            &expect![[r#"
                1 | G0 X1. P1 H2
                  |        ^^ error[word-not-read] no code of the block reads `P1`
                1 | G0 X1. P1 H2
                  |           ^^ error[word-not-read] no code of the block reads `H2`
                2 | G28 Z0 R3
                  |        ^^ error[word-not-read] no code of the block reads `R3`
            "#]],
        );
    }

    #[test]
    fn what_a_lasting_mode_may_read_is_left_alone() {
        check_rule(&RULE, "haas-mill", "G1 X1. I0.5 J0.5 K0.7 F10.\n", &expect![[""]]);
        check_rule(&RULE, "fanuc-mill", "G65 P9010 K1.\nM244 K1\n", &expect![[""]]);
    }

    #[test]
    fn words_say_what_the_control_does() {
        let found = findings(&Selection::only(&RULE), "linuxcnc", "G0 X1. H2\n", &World::default());
        let text = words(&found[0]);
        assert!(text.contains("note: this control refuses a block with such a word"), "{text}");
    }
}
