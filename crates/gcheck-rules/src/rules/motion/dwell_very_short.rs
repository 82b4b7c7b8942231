//! A dwell of a few milliseconds.

use gcheck_controls::DwellWord;
use gcheck_engine::Event;

use crate::declare::declare_rule;
use crate::facts::dwell::{SHORT, duration, of_another_control, other_reading};
use crate::{PathCx, PathRule, Report, Run, Watch};

declare_rule! {
    /// A dwell lasts less than twenty milliseconds, but more than one: `G4 P1` is written to keep the control from reading ahead.
    ///
    /// ## Why it matters
    /// Some controls read a dwell in milliseconds, others in seconds: `G4 P2` is two seconds on one and no noticeable
    /// time on the other. The spindle does not reach its speed, or the bottom of the hole is not cleaned.
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

/// Milliseconds: the shortest possible dwell only keeps the control from reading ahead.
const SHORTEST: f64 = 1.0001;

struct DwellVeryShort;

impl PathRule for DwellVeryShort {
    fn changed(&mut self, cx: &PathCx<'_>, event: &Event, report: &mut Report<'_>) {
        let Event::Dwell(time) = event else { return };
        if !is_too_short(time.0) {
            return;
        }
        let dwell = &cx.model.semantics().dwell;
        let is_time = |word: &gcheck_program::Word| {
            dwell.keys().any(|letter| gcheck_controls::Letter::parse(letter) == Some(word.letter))
        };
        // Milliseconds with a decimal point are reported for the point.
        let words = cx.place().map(|place| place.table.words(place.block()).to_vec()).unwrap_or_default();
        let is_pointed = |word: &gcheck_program::Word| {
            let kinds = dwell.iter().filter(|(_, kind)| **kind == DwellWord::Milliseconds);
            let mut letters = kinds.filter_map(|(letter, _)| gcheck_controls::Letter::parse(letter));
            word.shape.point && letters.any(|letter| letter == word.letter)
        };
        // A cycle dwells in every hole; its time is judged in the block that gives it.
        if words.iter().any(is_pointed) || !words.iter().any(is_time) {
            return;
        }
        let finding = cx
            .finding(&META, cx.word_range(is_time), format!("dwell of {}", duration(time.0)))
            .label("no noticeable time on this control")
            .help("check whether the value was meant in seconds");
        report.add(match other_reading(cx, time.0) {
            Some(other) => finding.note(of_another_control(other)),
            None => finding,
        });
    }
}

/// Less than any useful dwell, but more than one that only keeps the control from reading ahead.
fn is_too_short(seconds: f64) -> bool {
    seconds * 1000.0 > SHORTEST && seconds < SHORT
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
