//! A word that its code accepts and should not have.

use gcheck_controls::Letter;
use gcheck_program::BlockFlags;

use crate::declare::declare_rule;
use crate::{BlockCx, Finding, Report, Run, Severity};

declare_rule! {
    /// A code has a word that the control accepts, and that the manual says does not belong to it.
    ///
    /// ## Why it matters
    /// The control makes something of the word that nobody means: an `X` beside the threading cycle `G76` of LinuxCNC is
    /// a rapid move from the end of the thread, through the work.
    ///
    /// ## Reported
    /// ```nc,reported,linuxcnc
    /// G18 G21 S100 M3
    /// G0 X20 Z1
    /// G76 P1.5 X5 Z-10 I-2 J0.3 K0.6
    /// M2
    /// ```
    /// ## Not reported
    /// ```nc,quiet,linuxcnc
    /// G18 G21 S100 M3
    /// G0 X20 Z1
    /// G76 P1.5 Z-10 I-2 J0.3 K0.6
    /// M2
    /// ```
    rule "unwanted-word" in "words" {
        summary: "word that does not belong to its code",
        severity: Warning,
        tier: Block,
        control_specific: true,
        since: "0.1.0",
        run: Run::Block { trigger: BlockFlags::CODE, check },
    }
}

fn check(cx: &BlockCx<'_>, report: &mut Report<'_>) {
    for (_, code) in cx.codes() {
        let entry = code.entry();
        for unwanted in entry.words.iter().filter(|word| word.unwanted) {
            let letter = Letter::parse(&unwanted.letter);
            let Some(word) = cx.words().iter().find(|word| Some(word.letter) == letter) else { continue };
            let name = code.number();
            report.add(
                Finding::new(
                    &META,
                    cx.range(word),
                    format!("`{}` does not belong to `{name}`", unwanted.letter),
                )
                .label(unwanted.is.as_str())
                .note(format!(
                    "`{name}` ({}) accepts the word, and should not have it  [{}]",
                    entry.title, entry.source
                ))
                .help("remove the word, or move there in a block of its own")
                .at_most(Severity::Warning),
            );
        }
    }
}
