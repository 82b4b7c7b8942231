//! A dwell of a few milliseconds.

use gcheck_engine::Event;

use crate::meta::declare_rule;
use crate::{PathCx, PathRule, Report, Run, Watch};

declare_rule! {
    /// A dwell lasts less than twenty milliseconds, but more than one: `G4 P1` is written to keep the control from reading ahead.
    ///
    /// ## Why it matters
    /// Some controls count a dwell in milliseconds, others in seconds: `G4 P2` is two seconds on one and no noticeable time
    /// on the other. The spindle does not come up to speed, the bottom of the hole is not cleaned.
    ///
    /// ## Reported
    /// ```nc,reported,haas-mill
    /// G4 P2
    /// M30
    /// ```
    /// ## Not reported
    /// ```nc,quiet,haas-mill
    /// G4 P2.
    /// G4 P500
    /// M30
    /// ```
    rule "dwell-very-short" in "motion" {
        summary: "dwell of a few milliseconds",
        severity: Info,
        tier: Path,
        since: "0.1.0",
        run: Run::Path { watch: Watch::CHANGES, make: || Box::new(DwellVeryShort) },
    }
}

/// Seconds: less than a spindle needs for a turn.
const SHORT: f64 = 0.02;
/// Milliseconds: the shortest dwell there is only keeps the control from reading ahead.
const SHORTEST: f64 = 1.0001;

struct DwellVeryShort;

impl PathRule for DwellVeryShort {
    fn changed(&mut self, cx: &PathCx<'_>, event: &Event, report: &mut Report<'_>) {
        let Event::Dwell(time) = event else { return };
        let milliseconds = time.0 * 1000.0;
        if !(milliseconds > SHORTEST && time.0 < SHORT) {
            return;
        }
        let dwell = &cx.model.semantics().dwell;
        let is_time = |word: &gcheck_program::Word| {
            dwell.keys().any(|letter| gcheck_controls::Letter::parse(letter) == Some(word.letter))
        };
        let text = format!("{milliseconds:.1}");
        let text = text.trim_end_matches('0').trim_end_matches('.');
        report.add(
            cx.finding(&META, cx.word_range(is_time), format!("dwell of {text} milliseconds"))
                .label("no noticeable time on this control")
                .help("check whether the value was meant in seconds"),
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
            "fanuc-mill",
            "G4 P1\nG4 P3\nG4 P1000\nG4 X2.\nG4 P0\nG4 P#100\nM30\n",
            &expect![[r#"
                2 | G4 P3
                  |    ^^ info[dwell-very-short] dwell of 3 milliseconds
            "#]],
        );
    }
}
