//! Axis words that are offsets, beside a motion code.

use gcheck_controls::Effect;
use gcheck_engine::Role;
use gcheck_program::BlockFlags;

use crate::declare::declare_rule;
use crate::{BlockCx, Finding, Report, Run, limit};

declare_rule! {
    /// A block with a code whose axis words are tool offsets (`G43.1`) has a motion code too.
    ///
    /// ## Why it matters
    /// The words change the offset of the tool along their axes, and nothing moves there. All later moves are off by them.
    ///
    /// ## Reported
    /// ```nc,reported,linuxcnc
    /// G21 G90
    /// G43.1 Z0.25 G0 X1
    /// M2
    /// ```
    /// ## Not reported
    /// ```nc,quiet,linuxcnc
    /// G21 G90
    /// G43.1 Z0.25
    /// G0 X1
    /// M2
    /// ```
    rule "offset-words-beside-motion" in "tool" {
        summary: "axis words that are offsets beside a motion code",
        severity: Warning,
        tier: Block,
        since: "0.1.0",
        run: Run::Block { trigger: BlockFlags::CODE, check },
    }
}

fn check(cx: &BlockCx<'_>, report: &mut Report<'_>) {
    let Some((word, offset)) = cx.codes().find(|(_, code)| code.effect() == Effect::LengthFromBlock) else {
        return;
    };
    // Where the code takes a number, axis words are those of the move.
    let takes_number = offset.entry().words.iter().any(|word| word.letter == "H");
    let Some((_, motion)) = cx.codes().find(|(_, code)| Role::of(code.effect()) == Some(Role::Motion)) else {
        return;
    };
    if takes_number {
        return;
    }
    let (name, other) = (offset.number(), motion.number());
    report.add(
        Finding::new(
            &META,
            cx.range(word),
            format!("`{other}` beside `{name}`, whose axis words are offsets"),
        )
        .label("takes all axis words of the block")
        .note(format!(
            "`{name}` ({}) and a move do not go into one block  [{}]",
            offset.entry().title,
            offset.entry().source
        ))
        .help(format!("give `{name}` and the move a block each"))
        .at_most(limit(offset.entry().confidence)),
    );
}
