//! An axis with its position and its increment in one block.

use gcheck_controls::{Letter, Motion};
use gcheck_program::{BlockFlags, Word};

use crate::declare::declare_rule;
use crate::{BlockCx, Finding, Reads, Report, Run, limit};

declare_rule! {
    /// One axis is in a block with two addresses: its position (`X`) and its increment (`U`).
    ///
    /// ## Why it matters
    /// Only one of them can count. Most controls silently use the last one, so the other is lost; often a word is left
    /// from another block, or an end of line is missing.
    ///
    /// ## Reported
    /// ```nc,reported,fanuc-lathe
    /// G1 X20. Z-5. U0.5 F0.2
    /// ```
    /// ## Not reported
    /// Two axes, one with each address:
    /// ```nc,quiet,fanuc-lathe
    /// G1 X20. W-5. F0.2
    /// ```
    /// Allowances of a cycle:
    /// ```nc,quiet,haas-lathe
    /// G71 P10 Q20 U0.01 W0.005 D0.1 F0.01
    /// ```
    rule "axis-given-twice" in "words" {
        summary: "axis with its position and its increment in a block",
        severity: Warning,
        tier: Block,
        since: "0.1.0",
        run: Run::BlockAndValues { trigger: BlockFlags::AXIS_TWICE, reads: Reads::Codes, check },
    }
}

fn check(cx: &BlockCx<'_>, report: &mut Report<'_>) {
    // Codes that do not move to a point have other uses for both words.
    let moves = |motion: Motion| {
        matches!(motion, Motion::Rapid | Motion::Feed | Motion::Arc | Motion::Thread | Motion::Cycle)
    };
    let is_move = cx.codes().all(|(_, code)| {
        let axes = [Letter::of('X'), Letter::of('U'), Letter::of('H')];
        moves(code.motion()) && code.group().modal
            || !code.entry().takes_axes && !axes.iter().any(|axis| code.reads().contains(*axis))
    });
    if !cx.words_are_plain() || !is_move {
        return;
    }
    for (increment, axis) in &cx.control().semantics().increments {
        let first = |letter: &str| {
            let letter = Letter::parse(letter)?;
            cx.words().iter().find(|word| word.letter == letter)
        };
        if let (Some(increment), Some(axis)) = (first(increment), first(axis)) {
            report.add(finding(cx, axis, increment));
        }
    }
}

fn finding(cx: &BlockCx<'_>, axis: &Word, increment: &Word) -> Finding {
    let semantics = cx.control().semantics();
    let (first, last) =
        if axis.range().start < increment.range().start { (axis, increment) } else { (increment, axis) };
    let is = |word: &Word| {
        let says = if word.letter == axis.letter { "where" } else { "how far" };
        format!("`{}` says {says} {} goes", cx.text(word), axis.letter)
    };
    Finding::new(
        &META,
        cx.range(last),
        format!("`{}` and `{}` move one axis in one block", axis.letter, increment.letter),
    )
    .label(is(last))
    .also(cx.range(first), is(first))
    .note("only one of the two counts, on most controls the last one one")
    .help(format!("keep the right one: `{}` or `{}`", cx.text(first), cx.text(last)))
    .at_most(limit(semantics.confidence))
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::{World, check_rule, findings, only, words};

    #[test]
    fn every_axis_and_every_kind_of_motion() {
        check_rule(
            &RULE,
            "haas-lathe",
            "G1 X2. U.5 F.01\nW-1. Z-2.\nG0 X#101 U#102\nN5 G3 X2. Z-1. R1. W.1\n",
            &expect![[r#"
                1 | G1 X2. U.5 F.01
                  |        ^^^ warning[axis-given-twice] `X` and `U` move one axis in one block
                2 | W-1. Z-2.
                  |      ^^^^ warning[axis-given-twice] `Z` and `W` move one axis in one block
                3 | G0 X#101 U#102
                  |          ^^^^^ warning[axis-given-twice] `X` and `U` move one axis in one block
                4 | N5 G3 X2. Z-1. R1. W.1
                  |                    ^^^ warning[axis-given-twice] `Z` and `W` move one axis in one block
            "#]],
        );
    }

    #[test]
    fn other_codes_use_the_words_in_their_own_ways() {
        check_rule(
            &RULE,
            "fanuc-lathe",
            "G4 X1. U1.\nG10 P1 X0.1 U0.1\nG73 U5. W5. R3\nG65 P9010 X1. U2.\nG28 U0. W0.\nG0 X20. W5.\n",
            &expect![[""]],
        );
        // Axes of their own.
        check_rule(&RULE, "haas-mill", "G1 X1. U1. F10.\n", &expect![[""]]);
        check_rule(&RULE, "linuxcnc", "G1 X1. U1. F10.\n", &expect![[""]]);
    }

    #[test]
    fn words_say_which_is_which() {
        let found = findings(&only(&RULE), "fanuc-lathe", "G1 X20. U0.5 F0.2\n", &World::default());
        expect![[r#"
            `X` and `U` move one axis in one block
              here: `U0.5` says how far X goes
              there: `X20.` says where X goes
              note: only one of the two counts, on most controls the last one one
              help: keep the right one: `X20.` or `U0.5`
        "#]]
        .assert_eq(&words(&found[0]));
    }
}
