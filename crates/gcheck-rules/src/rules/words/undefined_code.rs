//! A code that the control accepts without a meaning that anybody wrote down.

use gcheck_program::BlockFlags;

use crate::declare::declare_rule;
use crate::{BlockCx, Finding, Report, Run, limit};

declare_rule! {
    /// The control accepts the code, and its documentation says that what the code does is not defined.
    ///
    /// ## Why it matters
    /// The machine does something at the block, and it may be something else in the next version of the control.
    ///
    /// ## Reported
    /// ```nc,reported,linuxcnc
    /// G88 X1 Z-5 R1 P1 F100
    /// G80
    /// ```
    /// ## Not reported
    /// ```nc,quiet,linuxcnc
    /// G89 X1 Z-5 R1 P1 F100
    /// G80
    /// ```
    rule "undefined-code" in "words" {
        summary: "code whose effect is not defined",
        severity: Warning,
        tier: Block,
        control_specific: true,
        since: "0.1.0",
        run: Run::Block { trigger: BlockFlags::CODE, check },
    }
}

fn check(cx: &BlockCx<'_>, report: &mut Report<'_>) {
    for (word, code) in cx.codes() {
        let entry = code.entry();
        if !entry.undefined {
            continue;
        }
        let name = code.number();
        report.add(
            Finding::new(&META, cx.range(word), format!("what `{name}` does is not defined"))
                .label(entry.title.as_str())
                .note(format!(
                    "`{name}` ({}) is accepted without a defined motion  [{}]",
                    entry.title, entry.source
                ))
                .help("write the moves out, or use another cycle")
                .at_most(limit(entry.confidence)),
        );
    }
}
