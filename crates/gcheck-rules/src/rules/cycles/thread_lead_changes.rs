//! A thread whose lead changes from one pass to the next.

use gcheck_engine::{Event, Fact};
use gcheck_geometry::Mm;

use crate::declare::declare_rule;
use crate::facts::thread_passes::{ThreadPasses, cuts_pass};
use crate::{PathCx, PathRule, Remembers, Report, Run, Uses, Watch, remembers};

declare_rule! {
    /// Two passes of one thread have different leads: both begin at the same Z and end at the same Z, with one tool.
    ///
    /// ## Why it matters
    /// A pass with another lead runs across the turns that the passes before it have cut. The thread is lost, and the insert may break.
    ///
    /// ## Reported
    /// ```nc,reported,haas-lathe
    /// G21 G99 T101
    /// G97 S500 M3
    /// G0 X32. Z5.
    /// G92 X29.5 Z-20. F1.5
    /// X29.2 F1.75
    /// G0 X60.
    /// M30
    /// ```
    /// ## Not reported
    /// ```nc,quiet,haas-lathe
    /// G21 G99 T101
    /// G97 S500 M3
    /// G0 X32. Z5.
    /// G92 X29.5 Z-20. F1.5
    /// X29.2
    /// G0 X42. Z-30.
    /// G92 X39.5 Z-50. F2.
    /// X39.2
    /// G0 X60.
    /// M30
    /// ```
    rule "thread-lead-changes" in "cycles" {
        summary: "lead changes between two passes of one thread",
        severity: Warning,
        tier: Path,
        since: "0.1.0",
        run: Run::Path {
            watch: Watch::MOVES.union(Watch::CHANGES),
            make: || Box::new(ThreadLeadChanges::default()),
        },
    }
}

#[derive(Default, Clone, PartialEq)]
struct ThreadLeadChanges {
    passes: ThreadPasses,
}

remembers!(ThreadLeadChanges: passes);

/// Leads that differ by a smaller part are one lead, rounded.
const SLACK: f64 = 0.002;

impl PathRule for ThreadLeadChanges {
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
        let Some((before, pass)) = self.passes.pass(cx, event) else { return };
        let lead = pass.lead;
        // Two threads over one length differ by more than a thread is deep.
        let most = before.lead.max(lead);
        if before.x.into_iter().zip(pass.x).any(|(one, other)| (one - other).abs() > most) {
            return;
        }
        if (before.lead / lead - 1.0).abs() < SLACK {
            return;
        }
        let bytes = cx.word_range(|word| matches!(word.letter.ascii(), b'F' | b'E' | b'K'));
        let finding = cx
            .finding(
                &META,
                bytes,
                format!(
                    "the lead changes from {} to {} between two passes of one thread",
                    cx.shown(Mm(before.lead)),
                    cx.shown(Mm(lead))
                ),
            )
            .label("crosses the turns that are cut")
            .help("cut all passes of a thread with one lead");
        let finding = match cx.range_of(before.at) {
            Some(range) => finding.also(range, "the pass before it"),
            None => finding,
        };
        report.add(cx.resting_on(finding, Fact::Feed, "the feed"));
    }
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::{World, check_rule, findings, only, words};

    #[test]
    fn a_way_in_short_steps_is_no_pass() {
        let steps = "G21 G18 G99 T101\nG97 S40 M3\nG0 X28.284 Z0.\nG32 X28.283 F86.58\nG32 X28.28 F82.21\nG32 X28.281 F78.1\nG0 X60.\nM30\n";
        check_rule(&RULE, "haas-lathe", steps, &expect![[""]]);
    }

    #[test]
    fn all_passes_have_one_lead() {
        let program = |second: &str| {
            format!("G21 G99 T101\nG97 S500 M3\nG0 X32. Z5.\nG92 X29.5 Z-20. F1.5\n{second}\nG0 X60.\nM30\n")
        };
        let found = findings(&only(&RULE), "haas-lathe", &program("X29.2 F1.75"), &World::default());
        expect![[r#"
            the lead changes from 1.5 mm to 1.75 mm between two passes of one thread
              here: crosses the turns that are cut
              there: the pass before it
              help: cut all passes of a thread with one lead
        "#]]
        .assert_eq(&found.iter().map(words).collect::<String>());
        for second in [
            "X29.2",
            "X29.2 F1.5",
            "X29.2 Z-40. F2.",
            "G0 Z10.\nG92 X29.2 Z-20. F2.",
            "T202\nG92 X29.2 Z-20. F2.",
            "G0 X100.\nX22. Z5.\nG92 X19.5 Z-20. F2.",
        ] {
            check_rule(&RULE, "haas-lathe", &program(second), &expect![[""]]);
        }
    }

    #[test]
    fn passes_that_are_written_out() {
        check_rule(
            &RULE,
            "fanuc-lathe",
            "G21 G99 T0101\nG97 S500 M3\nG0 X29. Z5.\nG32 Z-20. F1.5\nG0 X40.\nZ5.\nX28.5\nG32 Z-20. F1.25\nG0 X40.\nM30\n",
            &expect![[r#"
                8 | G32 Z-20. F1.25
                  |           ^^^^^ warning[thread-lead-changes] the lead changes from 1.5 mm to 1.25 mm between two passes of one thread
            "#]],
        );
    }
}
