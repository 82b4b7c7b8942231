//! A dwell whose time depends on which control was meant.

use gcheck_controls::{DwellWord, Letter};
use gcheck_engine::Event;

use super::dwell_very_long::{LONG, duration};
use super::dwell_very_short::SHORT;
use crate::memory::{Remembers, remembers};
use crate::meta::declare_rule;
use crate::{PathCx, PathRule, Report, Run, Watch};

declare_rule! {
    /// A dwell is written as a number that some controls count in seconds and others in milliseconds, and nobody said which
    /// control the program is for: it was guessed.
    ///
    /// ## Why it matters
    /// `G4 P500` is half a second on one control and more than eight minutes on another. Everything that is said about times
    /// rests on the guess. One finding speaks for the program.
    ///
    /// ## Reported
    /// ```nc,reported,haas-mill,guessed
    /// G4 P500
    /// M30
    /// ```
    /// ## Not reported
    /// Somebody chose the control.
    /// ```nc,quiet,haas-mill
    /// G4 P500
    /// M30
    /// ```
    /// Half a second wherever a dwell may have a decimal point.
    /// ```nc,quiet,haas-mill,guessed
    /// G4 P0.5
    /// M30
    /// ```
    rule "dwell-unit-unsure" in "motion" {
        summary: "dwell that another control would count in another unit",
        severity: Info,
        tier: Path,
        since: "0.1.0",
        run: Run::Path { watch: Watch::CHANGES, make: || Box::new(DwellUnitUnsure { is_told: false }) },
    }
}

#[derive(Clone, PartialEq)]
struct DwellUnitUnsure {
    is_told: bool,
}

remembers!(DwellUnitUnsure);

impl PathRule for DwellUnitUnsure {
    fn memory(&mut self) -> Remembers<'_> {
        Remembers::All(self)
    }

    fn changed(&mut self, cx: &PathCx<'_>, event: &Event, report: &mut Report<'_>) {
        let Event::Dwell(time) = event else { return };
        // The rules of dwells that are long or short beyond reason say it themselves; the shortest one only keeps the control
        // from reading ahead.
        if self.is_told || time.0 >= LONG || time.0 < SHORT {
            return;
        }
        let Some(other) = other_reading(cx, time.0) else { return };
        self.is_told = true;
        let p = Letter::of('P');
        let (here, there) = (duration(time.0), duration(other));
        let title = cx.scene.control().title();
        report.add(
            cx.finding(
                &META,
                cx.word_range(|word| word.letter == p),
                format!("dwell of {here}, on other controls of {there}"),
            )
            .label(format!("{here} as {title} reads it"))
            .note(
                "the control was guessed from the program: some count `P` in milliseconds, others in seconds",
            )
            .help(
                "name the control: `--control`, `control` in gcheck.toml, or a comment `(gcheck: control=…)`",
            ),
        );
    }
}

/// Seconds that a dwell by `P` lasts on controls that count it in the other unit; `None` where every control that takes the
/// word reads the same time, or the control was chosen.
pub(super) fn other_reading(cx: &PathCx<'_>, seconds: f64) -> Option<f64> {
    let p = Letter::of('P');
    let kind = cx.model.semantics().dwell.iter().find(|(letter, _)| Letter::parse(letter) == Some(p));
    let (_, kind) = kind.filter(|_| cx.scene.control_is_guessed && seconds > 0.0)?;
    let place = cx.place()?;
    let word = place.table.words(place.block()).iter().find(|word| word.letter == p)?;
    // A time with a decimal point is in seconds wherever it is accepted; what is computed is unit and number in one.
    if word.shape.point || word.number().is_none() {
        return None;
    }
    Some(match kind {
        DwellWord::Seconds => seconds / 1000.0,
        DwellWord::Milliseconds | DwellWord::SecondsOrMilliseconds => seconds * 1000.0,
    })
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::Selection;
    use crate::testing::{World, check_rule_in, findings, words};

    fn guessed() -> World<'static> {
        World { control_is_guessed: true, ..World::default() }
    }

    #[test]
    fn the_first_dwell_speaks_for_all() {
        check_rule_in(
            &RULE,
            "generic-mill",
            "G4 X1.5\nG4 P800\nG4 P900\nM30\n",
            &guessed(),
            &expect![[r#"
                2 | G4 P800
                  |    ^^^^ info[dwell-unit-unsure] dwell of 0.8 seconds, on other controls of 13 minutes
            "#]],
        );
        check_rule_in(
            &RULE,
            "linuxcnc",
            "G4 P5\nM2\n",
            &guessed(),
            &expect![[r#"
            1 | G4 P5
              |    ^^ info[dwell-unit-unsure] dwell of 5 seconds, on other controls of 5 milliseconds
        "#]],
        );
    }

    #[test]
    fn what_is_long_or_short_beyond_reason_is_said_elsewhere() {
        check_rule_in(&RULE, "linuxcnc", "G4 P500\nM2\n", &guessed(), &expect![[""]]);
        check_rule_in(&RULE, "haas-mill", "G4 P2\nM30\n", &guessed(), &expect![[""]]);
    }

    #[test]
    fn a_computed_time_is_not_judged() {
        check_rule_in(&RULE, "haas-mill", "#1=500\nG4 P#1\nM30\n", &guessed(), &expect![[""]]);
    }

    #[test]
    fn words_name_both_times() {
        let found = findings(&Selection::only(&RULE), "haas-mill", "G4 P500\nM30\n", &guessed());
        expect![[r#"
            dwell of 0.5 seconds, on other controls of 8.3 minutes
              here: 0.5 seconds as Haas mill (classic control and NGC) reads it
              note: the control was guessed from the program: some count `P` in milliseconds, others in seconds
              help: name the control: `--control`, `control` in gcheck.toml, or a comment `(gcheck: control=…)`
        "#]].assert_eq(&found.iter().map(words).collect::<String>());
    }
}
