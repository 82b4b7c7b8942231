//! A word that only newer versions of the control read.

use gcheck_controls::{Letter, LetterSet};
use gcheck_program::BlockFlags;

use crate::declare::declare_rule;
use crate::{BlockCx, Finding, Report, Run};

declare_rule! {
    /// A code has a word that the manual of the control lists, and that versions before the newest refuse.
    ///
    /// ## Why it matters
    /// On a machine with an older version the control stops with an error at the block. On one with a newer version the
    /// program runs.
    ///
    /// ## Reported
    /// ```nc,reported,linuxcnc
    /// M51 P0 $0
    /// M2
    /// ```
    /// ## Not reported
    /// ```nc,quiet,linuxcnc
    /// M51 P0
    /// M2
    /// ```
    rule "word-of-newer-version" in "words" {
        summary: "word that only newer versions of the control read",
        severity: Info,
        tier: Block,
        since: "0.1.0",
        run: Run::Block { trigger: BlockFlags::CODE, check },
    }
}

fn check(cx: &BlockCx<'_>, report: &mut Report<'_>) {
    let newer = &cx.control().semantics().refusals.newer_words;
    if newer.is_empty() || !cx.words_are_plain() {
        return;
    }
    let letters = |code: &str| newer.get(code).map_or(LetterSet::EMPTY, |text| LetterSet::of_item(text));
    for (_, code) in cx.codes() {
        let own = letters(&code.entry().code);
        // Another code of the block may read the word in every version.
        let is_read = |letter: Letter| {
            cx.codes().any(|(_, other)| {
                other.reads().contains(letter) && !letters(&other.entry().code).contains(letter)
            })
        };
        for word in cx.words().iter().filter(|word| own.contains(word.letter) && !is_read(word.letter)) {
            let (name, entry, letter) = (cx.written(code), code.entry(), word.letter);
            let meaning = entry.words.iter().find(|w| Letter::parse(&w.letter) == Some(letter));
            report.add(
                Finding::new(
                    &META,
                    cx.range(word),
                    format!("only newer versions read `{letter}` with `{name}`"),
                )
                .label(meaning.map_or("", |word| word.is.as_str()))
                .note(format!("older versions of the control refuse the block  [{}]", entry.source))
                .help(format!("remove `{letter}` if the machine has an older version")),
            );
        }
    }
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::{World, check_rule, findings, only, words};

    #[test]
    fn the_word_is_marked() {
        check_rule(
            &RULE,
            "linuxcnc",
            "M51 P0 $0\nG64 P0.1\nG97 S100 $0\nG97 S100\nM2\n",
            &expect![[r#"
                1 | M51 P0 $0
                  |        ^^ info[word-of-newer-version] only newer versions read `$` with `M51`
                3 | G97 S100 $0
                  |          ^^ info[word-of-newer-version] only newer versions read `$` with `G97`
            "#]],
        );
    }

    #[test]
    fn what_is_said() {
        let found = findings(&only(&RULE), "linuxcnc", "M51 P0 $0\nM2\n", &World::default());
        expect![[r#"
            only newer versions read `$` with `M51`
              here: spindle number
              note: older versions of the control refuse the block  [LCNC-M; RS274-2.9]
              help: remove `$` if the machine has an older version
        "#]]
        .assert_eq(&found.iter().map(words).collect::<String>());
    }
}
