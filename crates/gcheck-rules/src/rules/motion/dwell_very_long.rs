//! A dwell of many minutes.

use gcheck_engine::Event;

use crate::meta::declare_rule;
use crate::{PathCx, PathRule, Report, Run, Watch};

declare_rule! {
    /// A dwell lasts five minutes or more.
    ///
    /// ## Why it matters
    /// Some controls count a dwell in seconds, others in milliseconds: `G4 P2000` is two seconds on one and more than half
    /// an hour on the other. The tool rubs in the part meanwhile.
    ///
    /// ## Reported
    /// ```nc,reported,linuxcnc
    /// G4 P2000
    /// M2
    /// ```
    /// ## Not reported
    /// ```nc,quiet,linuxcnc
    /// G4 P2
    /// M2
    /// ```
    /// ```nc,quiet,fanuc-mill
    /// G4 P2000
    /// M30
    /// ```
    rule "dwell-very-long" in "motion" {
        summary: "dwell of five minutes or more",
        severity: Warning,
        tier: Path,
        since: "0.1.0",
        run: Run::Path { watch: Watch::CHANGES, make: || Box::new(DwellVeryLong) },
    }
}

/// Seconds: longer than any warm-up of a spindle step, shorter than a second meant as milliseconds.
const LONG: f64 = 300.0;

struct DwellVeryLong;

impl PathRule for DwellVeryLong {
    fn changed(&mut self, cx: &PathCx<'_>, event: &Event, report: &mut Report<'_>) {
        let Event::Dwell(time) = event else { return };
        let seconds = time.0;
        if seconds < LONG || !seconds.is_finite() {
            return;
        }
        let minutes = seconds / 60.0;
        let dwell = &cx.model.semantics().dwell;
        let is_time = |word: &gcheck_program::Word| {
            dwell.keys().any(|letter| gcheck_controls::Letter::parse(letter) == Some(word.letter))
        };
        report.add(
            cx.finding(&META, cx.word_range(is_time), format!("dwell of {minutes:.0} minutes"))
                .label(format!("{seconds:.0} seconds on this control"))
                .help("check whether the value was meant in milliseconds"),
        );
    }
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::check_rule;

    #[test]
    fn the_time_is_marked() {
        check_rule(
            &RULE,
            "linuxcnc",
            "G4 P2000\nG4 P299\nG4 P#1\n#2=500\nG4 P#2\nM2\n",
            &expect![[r#"
                1 | G4 P2000
                  |    ^^^^^ warning[dwell-very-long] dwell of 33 minutes
                5 | G4 P#2
                  |    ^^^ warning[dwell-very-long] dwell of 8 minutes
            "#]],
        );
    }

    #[test]
    fn a_decimal_point_makes_seconds_where_it_does() {
        check_rule(
            &RULE,
            "haas-mill",
            "G4 P1000\nG4 P1000.\nM30\n",
            &expect![[r#"
            2 | G4 P1000.
              |    ^^^^^^ warning[dwell-very-long] dwell of 17 minutes
        "#]],
        );
    }
}
