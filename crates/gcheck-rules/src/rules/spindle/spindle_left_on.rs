//! A spindle that turns on after the program.

use gcheck_engine::{Ending, Fact, Spindle};

use crate::declare::declare_rule;
use crate::facts::boundary::ends_at_tape_mark;
use crate::{PathCx, PathRule, Report, Run, Watch};

declare_rule! {
    /// The program ends by a tape mark (`%`), which stops nothing, and the spindle still turns.
    ///
    /// ## Why it matters
    /// The operator opens the machine to a turning tool. `M2` and `M30` stop the spindle, a tape mark leaves everything
    /// as it is.
    ///
    /// ## Reported
    /// ```nc,reported,linuxcnc
    /// %
    /// G21 G90 S1000 M3
    /// G1 X10 F100
    /// %
    /// ```
    /// ## Not reported
    /// ```nc,quiet,linuxcnc
    /// %
    /// G21 G90 S1000 M3
    /// G1 X10 F100
    /// M5
    /// %
    /// ```
    /// ```nc,quiet,linuxcnc
    /// %
    /// G21 G90 S1000 M3
    /// G1 X10 F100
    /// M2
    /// %
    /// ```
    rule "spindle-left-on" in "spindle" {
        summary: "spindle still turns at the end",
        severity: Warning,
        tier: Path,
        since: "0.1.0",
        run: Run::Path { watch: Watch::ENDS, make: || Box::new(SpindleLeftOn) },
    }
}

struct SpindleLeftOn;

impl PathRule for SpindleLeftOn {
    fn ended(&mut self, cx: &PathCx<'_>, ending: Ending, report: &mut Report<'_>) {
        let turns = cx.state().spindle().is_some_and(|way| way != Spindle::Stopped);
        let by_mark = matches!(ending, Ending::Tape) && ends_at_tape_mark(cx, ending);
        let Some(started) = cx.definitions().set_by(Fact::Spindle).filter(|_| turns && by_mark) else {
            return;
        };
        if cx.is_called_only() {
            return;
        }
        let finding = cx
            .finding(&META, cx.range(), "the spindle still turns when the program ends (`%`)")
            .label("a tape mark stops nothing")
            .help("stop the spindle with `M5`, or end the program with `M2` or `M30`");
        report.add(match cx.range_of(started) {
            Some(range) => finding.also(range, "started here"),
            None => finding,
        });
    }
}
