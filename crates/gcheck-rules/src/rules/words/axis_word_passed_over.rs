//! An axis word that its block takes away from the motion, and does not read.

use gcheck_controls::LetterSet;
use gcheck_program::BlockFlags;

use crate::declare::declare_rule;
use crate::{BlockCx, Finding, Reads, Report, Run, Severity, limit};

declare_rule! {
    /// A code of the block uses axis words for itself, so that no axis moves, and it has no use for this one.
    ///
    /// ## Why it matters
    /// The block looks like a move and is not one. The next block starts from another place than its author believes.
    ///
    /// ## Reported
    /// ```nc,reported,fanuc-mill
    /// G4 P100 Z5.
    /// ```
    /// ```nc,reported,haas-lathe
    /// G105 J25. X60.
    /// ```
    /// ## Not reported
    /// ```nc,quiet,fanuc-mill
    /// G4 P100
    /// G0 Z5.
    /// ```
    /// ```nc,quiet,haas-mill
    /// G28 Z0
    /// ```
    rule "axis-word-passed-over" in "words" {
        summary: "axis word that moves nothing in its block",
        severity: Warning,
        tier: Block,
        fixable: OnRequest,
        since: "0.1.0",
        run: Run::BlockAndValues { trigger: BlockFlags::CODE, reads: Reads::Codes, check },
    }
}

fn check(cx: &BlockCx<'_>, report: &mut Report<'_>) {
    let moves_axes = |code: &gcheck_controls::Code<'_>| code.entry().takes_axes || code.effect().owns_axes();
    let Some((_, taker)) = cx.codes().find(|(_, code)| moves_axes(code)) else { return };
    let any = cx.codes().any(|(_, code)| code.entry().any_words || code.is_user());
    if any || !cx.words_are_plain() || cx.block().flags.contains(BlockFlags::UNKNOWN_CODE) {
        return;
    }
    let readers = cx.codes().filter(|(_, code)| moves_axes(code));
    let read = readers.fold(LetterSet::EMPTY, |set, (_, code)| set.or(code.reads()));
    let forbidden = |letter: gcheck_controls::Letter| {
        let mut codes = cx.codes();
        codes.any(|(_, code)| code.entry().forbidden.iter().any(|item| *item == letter.to_string()))
    };
    for word in cx.words() {
        let is_axis = cx.control().letter(word.letter).is_some_and(|entry| entry.axis);
        let is_disputed = taker.entry().disputed.iter().any(|row| row.letter == word.letter.to_string());
        if !is_axis || read.contains(word.letter) || forbidden(word.letter) || is_disputed {
            continue;
        }
        let (name, entry) = (taker.number(), taker.entry());
        report.add(
            Finding::new(&META, cx.range(word), format!("`{}` moves nothing beside `{name}`", cx.text(word)))
                .label(format!("`{name}` does not read `{}`", word.letter))
                .note(format!("`{name}` ({}) has no word `{}`  [{}]", entry.title, word.letter, entry.source))
                .help(format!("write the move in a block of its own, or remove `{}`", word.letter))
                .fix(cx.removal_of(word))
                .at_most(Severity::Warning)
                .at_most(limit(entry.confidence)),
        );
    }
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
            "haas-lathe",
            "G105 J25. X60. Z1.\nG105 J25.\nG4 P1. Z5.\nG4 P1.\n",
            &expect![[r#"
                1 | G105 J25. X60. Z1.
                  |           ^^^^ warning[axis-word-passed-over] `X60.` moves nothing beside `G105`
                1 | G105 J25. X60. Z1.
                  |                ^^^ warning[axis-word-passed-over] `Z1.` moves nothing beside `G105`
            "#]],
        );
    }

    #[test]
    fn words_of_the_code_are_its_own() {
        check_rule(
            &RULE,
            "haas-mill",
            "G28 X0. Z0.\nG92 X1. Y2.\nG52 Z1.\nG51 X0. Y0. P2.\nG65 P9000 X1. Z2.\nG10 L2 P1 X1. Z1.\nG53 G0 Z0.\n",
            &expect![[""]],
        );
        check_rule(&RULE, "fanuc-mill", "G4 X1.\nG4 U1.\nG92 X0. Z1.\nG30 P2 Z0.\n", &expect![[""]]);
    }
}
