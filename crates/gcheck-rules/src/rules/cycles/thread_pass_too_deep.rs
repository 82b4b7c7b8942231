//! A pass of a thread that goes deeper than the thread is high.

use gcheck_engine::{Event, TravelKind};
use gcheck_geometry::Mm;

use crate::declare::declare_rule;
use crate::facts::thread_passes::{Pass, ThreadPasses, cuts_pass};
use crate::{Finding, PathCx, PathRule, Remembers, Report, Run, Uses, Watch, remembers};

declare_rule! {
    /// A pass of a thread (`G92`, `G32`, `G33`) is deeper than the one before it by more than the lead of the thread.
    ///
    /// ## Why it matters
    /// A thread is about 0.6 times as high as its lead is long. A pass that takes more in one step rams the insert into the part;
    /// mostly a digit or a decimal point of `X` is wrong.
    ///
    /// ## Reported
    /// ```nc,reported,haas-lathe
    /// G20 G99 T101
    /// G97 S500 M3
    /// G0 X1. Z.2
    /// G92 X.9 Z-.75 F.0625
    /// X.885
    /// X.088
    /// G0 X2.
    /// M30
    /// ```
    /// ## Not reported
    /// ```nc,quiet,haas-lathe
    /// G20 G99 T101
    /// G97 S500 M3
    /// G0 X1. Z.2
    /// G92 X.9 Z-.75 F.0625
    /// X.885
    /// X.88
    /// G0 X2.
    /// M30
    /// ```
    rule "thread-pass-too-deep" in "cycles" {
        summary: "pass of a thread goes deeper than the thread is high",
        severity: Warning,
        tier: Path,
        since: "0.1.0",
        run: Run::Path {
            watch: Watch::MOVES.union(Watch::CHANGES),
            make: || Box::new(ThreadPassTooDeep::default()),
        },
    }
}

#[derive(Default, Clone, PartialEq)]
struct ThreadPassTooDeep {
    passes: ThreadPasses,
    /// The last two passes differ by less than the lead: they cut one thread. A first pass may run dry.
    cuts: bool,
    /// A cycle cuts the passes.
    by_cycle: bool,
    /// The second pass of a thread is much deeper than the first one, which may have run dry: the next one shows which of them is odd.
    pending: Option<(Pass, Finding)>,
}

remembers!(ThreadPassTooDeep: passes, pending);

impl PathRule for ThreadPassTooDeep {
    fn memory(&mut self) -> Remembers<'_> {
        Remembers::All(self)
    }

    fn concerns(&self, program: &Uses<'_>) -> bool {
        program.may(cuts_pass)
    }

    fn changed(&mut self, _: &PathCx<'_>, event: &Event, _: &mut Report<'_>) {
        self.passes.see(event);
    }

    fn moved(&mut self, cx: &PathCx<'_>, event: &Event, report: &mut Report<'_>) {
        if let Event::Travel(travel) = event {
            // Between the passes of a cycle the tool is not moved: now another thread may come.
            self.cuts &= !self.by_cycle || travel.expanded;
            self.by_cycle = travel.expanded;
        }
        let Some((before, pass)) = self.passes.pass(cx, event) else {
            if matches!(event, Event::Travel(travel) if travel.kind == TravelKind::Thread) {
                // Another thread begins.
                (self.cuts, self.pending) = (false, None);
            }
            return;
        };
        // An inside thread gets deeper outward, and a larger thread over the same length is cut by the same way out: only
        // inward nothing else can be meant.
        let step = before.x[1] - pass.x[1];
        let starts = before.x[0] - pass.x[0];
        let had_cut = std::mem::replace(&mut self.cuts, step.abs() <= pass.lead);
        if let Some((_, finding)) = self.pending.take_if(|(deep, _)| pass.x[1] - deep.x[1] > pass.lead) {
            report.add(finding);
        }
        self.pending = None;
        if !(step > pass.lead && starts > pass.lead) {
            return;
        }
        let mut finding = cx
            .finding(&META, cx.letter_range('X'), "the pass is deeper than its thread is high")
            .label(format!(
                "{} deeper than the pass before, and the lead is {}",
                cx.shown(Mm(step)),
                cx.shown(Mm(pass.lead))
            ))
            .note("a thread of 60 degrees is about 0.6 times as high as its lead is long");
        if let Some(range) = cx.range_of(before.at) {
            finding = finding.also(range, "the pass before it");
        }
        let finding = finding.help("check the digits and the decimal point of `X`");
        if had_cut {
            report.add(finding);
        } else {
            self.pending = Some((pass, finding));
        }
    }
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::check_rule;

    #[test]
    fn a_digit_too_many() {
        let program = |x: &str| {
            format!(
                "G21 G99 T0101\nG97 S500 M3\nG0 X24. Z5.\nG92 X19.6 Z-20. F1.5\nX19.4\n{x}\nG0 X60.\nM30\n"
            )
        };
        check_rule(
            &RULE,
            "fanuc-lathe",
            &program("X1.92"),
            &expect![[r#"
                6 | X1.92
                  | ^^^^^ warning[thread-pass-too-deep] the pass is deeper than its thread is high
            "#]],
        );
        for x in ["X19.2", "X18.2", "X21.4", "X24.", "G0 X30. Z5.\nG92 X9.4 Z-20. F1.5"] {
            check_rule(&RULE, "fanuc-lathe", &program(x), &expect![[""]]);
        }
        // The second pass: only the third one shows that the first did not run dry.
        let second = program("X19.2").replace("X19.4", "X1.94");
        check_rule(
            &RULE,
            "fanuc-lathe",
            &second,
            &expect![[r#"
            5 | X1.94
              | ^^^^^ warning[thread-pass-too-deep] the pass is deeper than its thread is high
        "#]],
        );
        // A first pass may run dry, of a second thread as well.
        let two = "G21 G99 T0101\nG97 S500 M3\nG0 X20. Z5.\nG32 Z-20. F1.5\nG0 X30.\nZ5.\nX19.6\nG32 Z-20.\nG0 X60.\nZ-30.\nX43.\nG32 Z-50. F1.5\nG0 X60.\nZ-30.\nX39.6\nG32 Z-50.\nG0 X60.\nM30\n";
        check_rule(&RULE, "fanuc-lathe", two, &expect![[""]]);
        let dry = program("G0 X60.").replace("X19.6", "X40.");
        check_rule(&RULE, "fanuc-lathe", &dry, &expect![[""]]);
    }
}
