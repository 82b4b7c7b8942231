//! An axis word beside a code whose manual does not name it.

use gcheck_controls::{Code, Handling, Letter, Motion};
use gcheck_program::BlockFlags;

use crate::declare::declare_rule;
use crate::{BlockCx, Finding, Reads, Report, Run, Severity};

declare_rule! {
    /// A move or a dwell has an axis word that the manual of its code does not name. The axis moves with the others, moves
    /// after the dwell, or stays where it is.
    ///
    /// ## Why it matters
    /// The axis moves where the programmer thinks of a pause, or a move is lost and the next block starts from another place.
    ///
    /// ## Reported
    /// ```nc,reported,haas-mill
    /// G4 P1. Z5.
    /// ```
    /// ```nc,reported,fanuc-lathe
    /// G32 Z-20. C90. F1.5
    /// ```
    /// ## Not reported
    /// ```nc,quiet,haas-mill
    /// G4 P1.
    /// G0 Z5.
    /// ```
    /// A control that moves the axis in the motion in effect:
    /// ```nc,quiet,linuxcnc
    /// G4 P1. Z5.
    /// ```
    rule "axis-word-unsure" in "words" {
        summary: "axis word that the manual of its code does not name",
        severity: Warning,
        tier: Block,
        since: "0.1.0",
        run: Run::BlockAndValues { trigger: BlockFlags::CODE, reads: Reads::Codes, check },
    }
}

fn check(cx: &BlockCx<'_>, report: &mut Report<'_>) {
    let Some(code) = mover(cx) else { return };
    let is_read = |letter: Letter| cx.codes().any(|(_, code)| code.reads().contains(letter));
    for word in cx.words() {
        if is_axis(cx, word.letter)
            && !is_read(word.letter)
            && !is_forbidden(cx, word.letter)
            && !is_refused_in_cycle(cx, code, word.letter)
            && cx.words_are_plain()
        {
            report.add(finding(cx, code, word));
        }
    }
}

/// The code that moves the axes of the block or makes them wait, where no code takes their words for itself.
fn mover<'a>(cx: &BlockCx<'a>) -> Option<Code<'a>> {
    // Another rule reports words beside codes that take the axes.
    let takes = |code: Code<'_>| code.entry().takes_axes || code.effect().owns_axes();
    if cx.codes().any(|(_, code)| takes(code)) {
        return None;
    }
    let moves =
        cx.codes().map(|(_, code)| code).find(|code| !matches!(code.motion(), Motion::None | Motion::Dwell));
    moves.or_else(|| dwell(cx))
}

/// A dwell with its time. Where unread words are refused, it is known that the axes move in the motion in effect; a time in
/// the word of another control is another rule's.
fn dwell<'a>(cx: &BlockCx<'a>) -> Option<Code<'a>> {
    let is_settled = cx.control().block_rules().unread_word == Handling::Refused;
    let dwell = cx.codes().map(|(_, code)| code).find(|code| code.motion() == Motion::Dwell);
    let has_time = |code: &Code<'_>| code.reads().iter().any(|letter| cx.block().letters.contains(letter));
    dwell.filter(|code| !is_settled && has_time(code))
}

fn is_axis(cx: &BlockCx<'_>, letter: Letter) -> bool {
    cx.control().letter(letter).is_some_and(|entry| entry.axis)
}

/// Does the control refuse rotary axes in a cycle? Another rule reports them.
fn is_refused_in_cycle(cx: &BlockCx<'_>, code: Code<'_>, letter: Letter) -> bool {
    let is_rotary = matches!(letter.ascii(), b'A'..=b'C');
    cx.control().semantics().strict && code.motion() == Motion::Cycle && is_rotary
}

fn is_forbidden(cx: &BlockCx<'_>, letter: Letter) -> bool {
    let mut items = cx.codes().flat_map(|(_, code)| &code.entry().forbidden);
    items.any(|item| Letter::parse(item) == Some(letter))
}

fn finding(cx: &BlockCx<'_>, code: Code<'_>, word: &gcheck_program::Word) -> Finding {
    let (entry, text, name) = (code.entry(), cx.text(word), cx.written(code));
    let is_dwell = code.motion() == Motion::Dwell;
    let (label, severity) = if is_dwell {
        ("moves after the dwell, or does nothing", Severity::Warning)
    } else {
        ("moves with the others, or does nothing", Severity::Info)
    };
    Finding::new(&META, cx.range(word), format!("`{text}` is not among the words of `{name}`"))
        .label(label)
        .note(format!(
            "the manual of `{}` ({}) does not say what becomes of `{}`  [{}]",
            entry.code, entry.title, word.letter, entry.source
        ))
        .help(format!("write the move in a block of its own, or remove `{}`", word.letter))
        .at_most(severity)
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::check_rule;

    #[test]
    fn the_axis_word_is_marked() {
        check_rule(
            &RULE,
            "haas-lathe",
            "G1 X1. F0.01\nG04 P1. X2. W1.\nG04 P1.\nX3.\n",
            &expect![[r#"
                2 | G04 P1. X2. W1.
                  |         ^^^ warning[axis-word-unsure] `X2.` is not among the words of `G04`
                2 | G04 P1. X2. W1.
                  |             ^^^ warning[axis-word-unsure] `W1.` is not among the words of `G04`
            "#]],
        );
        check_rule(
            &RULE,
            "haas-mill",
            "G2 X1. I0.5 U1. F5.\nG1 X1. A5.\n",
            &expect![[r#"
            1 | G2 X1. I0.5 U1. F5.
              |             ^^^ info[axis-word-unsure] `U1.` is not among the words of `G2`
        "#]],
        );
    }

    #[test]
    fn a_time_in_an_axis_word_is_told_elsewhere() {
        check_rule(&RULE, "haas-mill", "G4 X2.\n", &expect![[""]]);
        check_rule(&RULE, "fanuc-mill", "G4 X2.\nG4 P100 Z1.\n", &expect![[""]]);
    }
}
