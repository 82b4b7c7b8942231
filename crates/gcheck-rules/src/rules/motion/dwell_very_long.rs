//! A dwell of many minutes.

use gcheck_controls::{DwellWord, Effect, Letter, LetterSet, Motion, Unpointed};
use gcheck_engine::Event;

use crate::declare::declare_rule;
use crate::facts::dwell::{LONG, duration, of_another_control, other_reading};
use crate::{PathCx, PathRule, Report, Run, Severity, Watch};

declare_rule! {
    /// A dwell lasts five minutes or more.
    ///
    /// ## Why it matters
    /// Some controls read a dwell in seconds, others in milliseconds: `G4 P2000` is two seconds on one and more than
    /// half an hour on the other. Meanwhile the tool rubs on the part.
    ///
    /// ## Reported
    /// ```nc,reported,linuxcnc
    /// G1 X1 F100
    /// G4 P2000
    /// M2
    /// ```
    /// In a program that cuts nothing, such as one that warms up the spindle, it is *info*.
    ///
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

struct DwellVeryLong;

impl PathRule for DwellVeryLong {
    fn changed(&mut self, cx: &PathCx<'_>, event: &Event, report: &mut Report<'_>) {
        let Event::Dwell(time) = event else { return };
        let seconds = time.0;
        if seconds < LONG || !seconds.is_finite() {
            return;
        }
        let dwell = &cx.model.semantics().dwell;
        let is_time = |word: &gcheck_program::Word| {
            dwell.keys().any(|letter| gcheck_controls::Letter::parse(letter) == Some(word.letter))
        };
        // A cycle dwells in every hole; its time is judged in the block that gives it.
        if cx.find_word(cx.origin().at, is_time).is_none() {
            return;
        }
        // A number without a point may count least increments there: that is unknown.
        let by_parameter = cx.control().numbers().unpointed == Unpointed::ByParameter;
        let is_unsure = |word: &gcheck_program::Word| {
            let kind = dwell.iter().find(|(letter, _)| Letter::parse(letter) == Some(word.letter));
            let is_seconds = kind.is_some_and(|(_, kind)| *kind == DwellWord::Seconds);
            is_seconds && !word.shape.point && word.number().is_some()
        };
        if by_parameter && cx.find_word(cx.origin().at, is_unsure).is_some() {
            return;
        }
        // Another rule reports a value that the control does not accept.
        if cx.place().is_some_and(|place| is_above_range(cx, &place, is_time)) {
            return;
        }
        let finding = cx
            .finding(&META, cx.word_range(is_time), format!("dwell of {}", duration(seconds)))
            .label(format!("{seconds:.0} seconds on this control"))
            .help("check whether the value was meant in milliseconds");
        let finding = if may_cut(cx) { finding } else { finding.at_most(Severity::Info) };
        report.add(match other_reading(cx, seconds) {
            Some(other) => finding.note(of_another_control(other)),
            None => finding,
        });
    }
}

/// May the program cut? A program that it calls may. A code that cuts needs a target: a line of modes that was copied
/// from another machine may have one, such as `G90` on a lathe, and moves nothing.
fn may_cut(cx: &PathCx<'_>) -> bool {
    let control = cx.control();
    let mut codes = cx.file_index.codes.iter().filter_map(|(number, _)| control.code(*number));
    let cuts = [Motion::Feed, Motion::Arc, Motion::Thread, Motion::Cycle, Motion::Operation, Motion::Curve];
    let goes = cx.file_index.letters.intersects(LetterSet::of("XYZUVWABCIJK"));
    cx.file_index.has_computed_codes
        || !cx.file_index.calls.is_empty()
        || goes && codes.any(|code| cuts.contains(&code.motion()))
}

/// Does the time exceed the range of the code that reads it?
fn is_above_range(
    cx: &PathCx<'_>,
    place: &gcheck_program::Place,
    is_time: impl Fn(&gcheck_program::Word) -> bool,
) -> bool {
    let words = place.table.words(place.block());
    let codes = words.iter().filter_map(|word| cx.control().code_at(word.code));
    let entries: Vec<_> = codes
        .filter(|code| code.effect() == Effect::Dwell)
        .flat_map(|code| &code.entry().words)
        .filter_map(|entry| Some((Letter::parse(&entry.letter)?, entry.max?)))
        .collect();
    words.iter().filter(|word| is_time(word)).any(|word| {
        let value = cx.known_number(word.letter.ascii().into()).unwrap_or(0.0);
        entries.iter().any(|(letter, max)| *letter == word.letter && value > *max)
    })
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::{World, check_rule, findings, only, words};

    #[test]
    fn a_cycle_is_told_once() {
        check_rule(
            &RULE,
            "linuxcnc",
            "G21 G90 G0 X0 Y0 Z9\nG82 X1 Y1 Z-1 R2 P500 F99\nX2\nX3\nM2\n",
            &expect![[r#"
                2 | G82 X1 Y1 Z-1 R2 P500 F99
                  |                  ^^^^ warning[dwell-very-long] dwell of 8.3 minutes
            "#]],
        );
    }

    #[test]
    fn the_time_is_marked() {
        check_rule(
            &RULE,
            "linuxcnc",
            "G1 X1 F9 G4 P2000\nG4 P299\nG4 P#1\n#2=500\nG4 P#2\nM2\n",
            &expect![[r#"
                1 | G1 X1 F9 G4 P2000
                  |             ^^^^^ warning[dwell-very-long] dwell of 33 minutes
                5 | G4 P#2
                  |    ^^^ warning[dwell-very-long] dwell of 8.3 minutes
            "#]],
        );
    }

    #[test]
    fn a_program_that_cuts_nothing_warms_the_spindle_up() {
        check_rule(
            &RULE,
            "fanuc-lathe",
            "O1\nG97 S500 M3\nG4 P1200000\nM5\nM30\n",
            &expect![[r#"
                3 | G4 P1200000
                  |    ^^^^^^^^ info[dwell-very-long] dwell of 20 minutes
            "#]],
        );
    }

    #[test]
    fn a_code_that_could_cut_cuts_nothing_without_an_axis() {
        check_rule(
            &RULE,
            "fanuc-lathe",
            "O1\nG18 G20 G40 G80 G90 G99\nS500 M3\nG4 P1200000\nM5\nM30\n",
            &expect![[r#"
                4 | G4 P1200000
                  |    ^^^^^^^^ info[dwell-very-long] dwell of 20 minutes
            "#]],
        );
    }

    #[test]
    fn a_guessed_control_says_what_the_other_unit_makes() {
        let world = World { control_is_guessed: true, ..World::default() };
        let found = findings(&only(&RULE), "linuxcnc", "G4 P8000\nM2\n", &world);
        expect![[r#"
            dwell of 2.2 hours
              here: 8000 seconds on this control
              note: the control was guessed: one that counts in the other unit waits 8 seconds
              help: check whether the value was meant in milliseconds
        "#]]
        .assert_eq(&found.iter().map(words).collect::<String>());
    }

    #[test]
    fn seconds_that_may_be_least_increments_are_not_judged() {
        check_rule(
            &RULE,
            "generic-mill",
            "G1 X1. F9.\nG4 X10000\nG4 X500.\nM30\n",
            &expect![[r#"
            3 | G4 X500.
              |    ^^^^^ warning[dwell-very-long] dwell of 8.3 minutes
        "#]],
        );
    }

    #[test]
    fn more_than_the_control_takes_is_reported_as_that() {
        check_rule(
            &RULE,
            "generic-mill",
            "G1 X1. F9.\nG4 X99999.\nG4 X100000.\nM30\n",
            &expect![[r#"
            2 | G4 X99999.
              |    ^^^^^^^ warning[dwell-very-long] dwell of 28 hours
        "#]],
        );
    }

    #[test]
    fn a_decimal_point_makes_seconds_where_it_does() {
        check_rule(
            &RULE,
            "haas-mill",
            "G1 X1. F9.\nG4 P1000\nG4 P1000.\nM30\n",
            &expect![[r#"
            3 | G4 P1000.
              |    ^^^^^^ warning[dwell-very-long] dwell of 17 minutes
        "#]],
        );
    }
}
