//! A dwell in the block of a move, whose axis word is the time.

use gcheck_controls::{Effect, Letter};
use gcheck_program::BlockFlags;

use crate::declare::declare_rule;
use crate::{BlockCx, Finding, Reads, Report, Run, limit};

declare_rule! {
    /// A dwell is in one block with a motion code, and the word that looks like the end of the move is the time of the dwell.
    ///
    /// ## Why it matters
    /// The axes do not move, and the machine waits as many seconds as the position has millimetres or inches.
    ///
    /// ## Reported
    /// ```nc,reported,fanuc-mill
    /// G1 G4 X10. F100.
    /// ```
    /// ## Not reported
    /// ```nc,quiet,fanuc-mill
    /// G1 X10. F100.
    /// G4 X1.
    /// ```
    rule "dwell-beside-motion" in "motion" {
        summary: "dwell whose time looks like the end of a move",
        severity: Warning,
        tier: Block,
        since: "0.1.0",
        run: Run::BlockAndValues { trigger: BlockFlags::CODE, reads: Reads::Codes, check },
    }
}

fn check(cx: &BlockCx<'_>, report: &mut Report<'_>) {
    let Some((_, dwell)) = cx.codes().find(|(_, code)| code.effect() == Effect::Dwell) else { return };
    let Some((_, motion)) = cx.codes().find(|(_, code)| code.effect().is_plain_move()) else { return };
    if !cx.words_are_plain() {
        return;
    }
    let times = &cx.control().semantics().dwell;
    let is_time = |letter: Letter| times.iter().any(|(time, _)| Letter::parse(time) == Some(letter));
    for word in cx.words() {
        let is_axis = cx.control().letter(word.letter).is_some_and(|entry| entry.axis);
        if !is_axis || !is_time(word.letter) {
            continue;
        }
        let (name, other) = (dwell.number(), motion.number());
        report.add(
            Finding::new(
                &META,
                cx.range(word),
                format!("`{}` is the time of `{name}`, not a position", cx.text(word)),
            )
            .label(format!("`{other}` makes no move here"))
            .note(format!(
                "`{name}` ({}) reads `{}` as a time  [{}]",
                dwell.entry().title,
                word.letter,
                dwell.entry().source
            ))
            .help(format!("write `{name}` in a block of its own"))
            .at_most(limit(dwell.entry().confidence)),
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
            "generic-mill",
            "G01 G04 X10. F100.\nG0 G4 U2.\nG1 G4 P100\nG4 X1.\nG1 X10. F100.\n",
            &expect![[r#"
                1 | G01 G04 X10. F100.
                  |         ^^^^ warning[dwell-beside-motion] `X10.` is the time of `G4`, not a position
                2 | G0 G4 U2.
                  |       ^^^ warning[dwell-beside-motion] `U2.` is the time of `G4`, not a position
            "#]],
        );
    }
}
