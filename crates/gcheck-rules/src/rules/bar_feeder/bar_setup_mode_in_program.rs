//! A setup mode of the bar feeder in a program.

use gcheck_engine::Event;

use crate::declare::declare_rule;
use crate::facts::bar_feed::bar_feeder;
use crate::{PathCx, PathRule, Report, Run, Watch};

declare_rule! {
    /// A program uses a mode of `G105 Q…` that sets the bar feeder up: that is work by hand, not part of a running job.
    ///
    /// Loading and unloading a bar are modes that programs use.
    ///
    /// ## Why it matters
    /// Setup modes measure and move the bar and the pushrod. In a running job they forget where the bar is.
    ///
    /// ## Reported
    /// ```nc,reported,haas-lathe
    /// M5
    /// G105 Q4 R90.
    /// M30
    /// ```
    /// ## Not reported
    /// ```nc,quiet,haas-lathe
    /// M5
    /// G105 Q0 J1.75
    /// M30
    /// ```
    rule "bar-setup-mode-in-program" in "bar_feeder" {
        summary: "setup mode of the bar feeder in a program",
        severity: Warning,
        tier: Path,
        since: "0.1.0",
        run: Run::Path { watch: Watch::CHANGES, make: || Box::new(BarSetupModeInProgram) },
    }
}

struct BarSetupModeInProgram;

impl PathRule for BarSetupModeInProgram {
    fn changed(&mut self, cx: &PathCx<'_>, event: &Event, report: &mut Report<'_>) {
        let Some(rules) = bar_feeder(cx) else { return };
        let Event::BarSetup(Some(mode)) = event else { return };
        if rules.program_modes.contains(mode) {
            return;
        }
        report.add(
            cx.finding(&META, cx.letter_range('Q'), format!("program sets the bar feeder up (`Q{mode}`)"))
                .label("a mode for setting up by hand")
                .assuming(format!("mode {mode} is a setup mode on this feeder"))
                .help("remove `Q` to feed the bar; set the feeder up from MDI"),
        );
    }
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::check_rule;

    #[test]
    fn computed_modes_too() {
        check_rule(
            &RULE,
            "haas-lathe",
            "#1=2\nM5\nG105 Q#1\nM30\n",
            &expect![[r#"
            3 | G105 Q#1
              |      ^^^ warning[bar-setup-mode-in-program] program sets the bar feeder up (`Q2`)
        "#]],
        );
        check_rule(&RULE, "haas-lathe", "M5\nG105 Q#500\nM30\n", &expect![[""]]);
    }

    #[test]
    fn loading_and_unloading_are_for_programs() {
        check_rule(&RULE, "haas-lathe", "M5\nG105 Q8\nG105 Q7\nG105 Q10\nM30\n", &expect![[""]]);
    }
}
