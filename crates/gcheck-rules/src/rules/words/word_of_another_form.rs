//! A word that its code reads in another form of the block.

use gcheck_controls::{Code, Letter, WordEntry};
use gcheck_program::{BlockFlags, Word};

use crate::declare::declare_rule;
use crate::facts::word_sets::choice;
use crate::{BlockCx, Finding, Report, Run, Severity, limit};

declare_rule! {
    /// A code has a form of one block and a form of two, and the block mixes words of both.
    ///
    /// ## Why it matters
    /// `D` of the one-block form is the depth of cut, `U` of the two-block form is. A control that takes one form ignores
    /// the words of the other, or stops with an alarm: the depth that the programmer wrote is not the one that is cut.
    ///
    /// ## Reported
    /// ```nc,reported,fanuc-lathe
    /// G71 U2. R1. D3.
    /// ```
    /// ## Not reported
    /// ```nc,quiet,fanuc-lathe
    /// G71 U2. R1.
    /// G71 P10 Q20 U0.5 W0.1 F0.25
    /// ```
    rule "word-of-another-form" in "words" {
        summary: "word of the other form of a cycle",
        severity: Info,
        tier: Block,
        control_specific: true,
        since: "0.1.0",
        run: Run::Block { trigger: BlockFlags::CODE, check },
    }
}

fn check(cx: &BlockCx<'_>, report: &mut Report<'_>) {
    for (_, code) in cx.codes() {
        for entry in code.entry().words.iter().filter(|entry| !entry.only_with.is_empty()) {
            let with = entry.only_with.iter().filter_map(|letter| Letter::parse(letter)).collect();
            let is_it = |word: &&Word| Letter::parse(&entry.letter) == Some(word.letter);
            if let Some(word) = cx.words().iter().find(is_it)
                && !cx.block().letters.intersects(with)
                && cx.words_are_plain()
            {
                report.add(finding(cx, code, entry, word, &choice(with)));
            }
        }
    }
}

fn finding(cx: &BlockCx<'_>, code: Code<'_>, entry: &WordEntry, word: &Word, with: &str) -> Finding {
    let (letter, name) = (word.letter, cx.written(code));
    Finding::new(&META, cx.range(word), format!("`{letter}` belongs to another form of `{name}`"))
        .label(entry.is.as_str())
        .note(format!("`{name}` reads `{letter}` in a block with {with} alone  [{}]", code.entry().source))
        .help(format!("remove `{letter}`, or write the cycle in the other form throughout"))
        .at_most(limit(entry.confidence.unwrap_or(code.entry().confidence)))
        .at_most(Severity::Info)
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::check_rule;

    #[test]
    fn the_word_is_marked() {
        check_rule(
            &RULE,
            "fanuc-lathe",
            "G71 U2. R1. D3.\nG71 P10 Q20 U0.5 W0.1 D2. F0.25\n",
            &expect![[r#"
                1 | G71 U2. R1. D3.
                  |             ^^^ info[word-of-another-form] `D` belongs to another form of `G71`
            "#]],
        );
    }
}
