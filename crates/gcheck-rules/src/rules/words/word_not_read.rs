//! A word that no code reads.

use gcheck_controls::{Handling, LetterSet};
use gcheck_program::{BlockFlags, Word};

use crate::declare::declare_rule;
use crate::facts::word_sets::read_by_modes;
use crate::{BlockCx, Finding, Reads, Report, Run, Severity, limit};

declare_rule! {
    /// No code of the block reads this word, and no mode that may be in effect reads it either.
    ///
    /// ## Why it matters
    /// Some controls refuse such a block. Others ignore the word: a dwell does not dwell, an offset has no effect. If
    /// the modes decide whether the word is read, see `word-passed-over`.
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
        fixable: OnRequest,
        since: "0.1.0",
        run: Run::BlockAndValues { trigger: BlockFlags::UNREAD_WORD, reads: Reads::Codes, check },
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

fn finding(cx: &BlockCx<'_>, word: &Word) -> Finding {
    let rules = cx.control().block_rules();
    let letter = word.letter;
    let (does, severity) = match rules.unread_word {
        Handling::Refused => ("refuses a block with such a word", Severity::Error),
        Handling::Ignored | Handling::LastWins | Handling::Accepted => {
            ("ignores such a word", Severity::Info)
        }
    };
    let general = cx.control().letter(letter).map_or("", |entry| entry.is.as_str());
    Finding::new(&META, cx.range(word), format!("no code of the block reads `{}`", cx.text(word)))
        .label(general)
        .note(format!("this control {does}  [{}]", rules.source))
        .help(format!("remove `{letter}`, or add the code that it belongs to"))
        .fix(cx.removal_of(word))
        .at_most(severity)
        .at_most(limit(rules.confidence))
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::{World, check_rule, findings, only, words};

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
        let found = findings(&only(&RULE), "linuxcnc", "G0 X1. H2\n", &World::default());
        let text = words(&found[0]);
        assert!(text.contains("note: this control refuses a block with such a word"), "{text}");
    }
}
