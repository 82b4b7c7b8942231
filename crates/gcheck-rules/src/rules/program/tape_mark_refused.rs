//! A tape mark on a control that refuses it.

use std::ops::Range;

use gcheck_diagnostics::alarm_name;

use crate::declare::declare_rule;
use crate::{FileCx, Finding, Report, Run};

declare_rule! {
    /// The file has a `%`, and the control reads no tape marks.
    ///
    /// ## Why it matters
    /// The control answers the line with an error. A sender that stops at errors ends the job there; many senders take the
    /// mark out by themselves, and then nothing happens.
    ///
    /// ## Reported
    /// ```nc,reported,grbl
    /// %
    /// G21 G90
    /// M30
    /// ```
    /// ## Not reported
    /// ```nc,quiet,linuxcnc
    /// %
    /// G21 G90
    /// %
    /// ```
    rule "tape-mark-refused" in "program" {
        summary: "tape mark on a control that refuses it",
        severity: Warning,
        tier: Program,
        since: "0.1.0",
        run: Run::Program { check },
    }
}

fn check(cx: &FileCx<'_>, report: &mut Report<'_>) {
    if !cx.control().syntax().tape_marks_refused {
        return;
    }
    for mark in &cx.file_index.tape_marks {
        let at = cx.slice(mark.clone()).find('%').map_or(mark.start, |at| mark.start + at as u32);
        report.add(finding(cx, at..at + 1));
    }
}

fn finding(cx: &FileCx<'_>, at: Range<u32>) -> Finding {
    let alarm = cx.control().alarm(META.id).and_then(|alarm| alarm.number.clone());
    let answer = alarm.map_or_else(String::new, |number| format!(" with {}", alarm_name(&number)));
    Finding::new(&META, at, "tape mark `%` is not read by this control")
        .label("the control answers this line with an error")
        .note(format!("{} refuses `%`{answer}, unless the sender takes it out", cx.control().title()))
        .help("remove the line")
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::check_rule;

    #[test]
    fn each_mark_is_reported() {
        check_rule(
            &RULE,
            "grbl",
            "%\nG0 X1\n%\n",
            &expect![[r#"
                1 | %
                  | ^ warning[tape-mark-refused] tape mark `%` is not read by this control
                3 | %
                  | ^ warning[tape-mark-refused] tape mark `%` is not read by this control
            "#]],
        );
    }
}
