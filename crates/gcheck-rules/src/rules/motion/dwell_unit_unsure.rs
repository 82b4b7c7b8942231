//! A dwell whose time depends on the control.

use gcheck_controls::Letter;
use gcheck_engine::Event;

use crate::declare::declare_rule;
use crate::facts::dwell::{LONG, SHORT, duration, other_reading};
use crate::{PathCx, PathRule, Report, Run, Watch};
use crate::{Remembers, remembers};

declare_rule! {
    /// Some controls read the time of this dwell in seconds and others in milliseconds, both times are usual ones, and the
    /// control was guessed, not configured.
    ///
    /// ## Why it matters
    /// `G4 P100` is a tenth of a second on one control and more than a minute and a half on another. All reported times
    /// depend on the guess. The rule reports once per program.
    ///
    /// ## Reported
    /// ```nc,reported,haas-mill,guessed
    /// G4 P100
    /// M30
    /// ```
    /// ## Not reported
    /// The control is configured.
    /// ```nc,quiet,haas-mill
    /// G4 P100
    /// M30
    /// ```
    /// Half a second: nobody waits the eight minutes of the other reading.
    /// ```nc,quiet,haas-mill,guessed
    /// G4 P500
    /// M30
    /// ```
    /// Half a second on every control that accepts a decimal point in a dwell.
    /// ```nc,quiet,haas-mill,guessed
    /// G4 P0.5
    /// M30
    /// ```
    rule "dwell-unit-unsure" in "motion" {
        summary: "dwell that another control would read in another unit",
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
        // Other rules report very long and very short dwells; the shortest one only keeps the control from reading
        // ahead.
        let is_usual = |seconds: &f64| (SHORT..LONG).contains(seconds);
        if self.is_told || !is_usual(&time.0) {
            return;
        }
        let Some(other) = other_reading(cx, time.0).filter(is_usual) else { return };
        self.is_told = true;
        let p = Letter::of('P');
        let (here, there) = (duration(time.0), duration(other));
        let title = cx.control().title();
        report.add(
            cx.finding(
                &META,
                cx.word_range(|word| word.letter == p),
                format!("dwell of {here}, on other controls of {there}"),
            )
            .label(format!("{here} on {title}"))
            .note(
                "the control was guessed from the program: some controls read `P` in milliseconds, others in seconds",
            )
            .help(
                "name the control: `--control`, `control` in gcheck.toml, or a comment `(gcheck: control=…)`",
            ),
        );
    }
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::{World, check_rule_in, findings, only, words};

    fn guessed() -> World<'static> {
        World { control_is_guessed: true, ..World::default() }
    }

    #[test]
    fn the_first_dwell_speaks_for_all() {
        check_rule_in(
            &RULE,
            "generic-mill",
            "G4 X1.5\nG4 P800\nG4 P200\nG4 P100\nM30\n",
            &guessed(),
            &expect![[r#"
                3 | G4 P200
                  |    ^^^^ info[dwell-unit-unsure] dwell of 0.2 seconds, on other controls of 3.3 minutes
            "#]],
        );
        check_rule_in(
            &RULE,
            "linuxcnc",
            "G4 P50\nM2\n",
            &guessed(),
            &expect![[r#"
            1 | G4 P50
              |    ^^^ info[dwell-unit-unsure] dwell of 50 seconds, on other controls of 50 milliseconds
        "#]],
        );
    }

    #[test]
    fn what_is_long_or_short_beyond_reason_is_said_elsewhere() {
        check_rule_in(&RULE, "linuxcnc", "G4 P500\nM2\n", &guessed(), &expect![[""]]);
        check_rule_in(&RULE, "haas-mill", "G4 P2\nM30\n", &guessed(), &expect![[""]]);
    }

    #[test]
    fn a_time_that_is_usual_in_one_unit_only_is_not_unsure() {
        for (control, program) in
            [("linuxcnc", "G4 P5\nM2\n"), ("haas-mill", "G4 P500\nM30\n"), ("grbl", "G4 P2\nM30\n")]
        {
            check_rule_in(&RULE, control, program, &guessed(), &expect![[""]]);
        }
    }

    #[test]
    fn a_computed_time_is_not_judged() {
        check_rule_in(&RULE, "haas-mill", "#1=100\nG4 P#1\nM30\n", &guessed(), &expect![[""]]);
    }

    #[test]
    fn words_name_both_times() {
        let found = findings(&only(&RULE), "haas-mill", "G4 P100\nM30\n", &guessed());
        expect![[r#"
            dwell of 0.1 seconds, on other controls of 100 seconds
              here: 0.1 seconds on Haas mill (classic control and NGC)
              note: the control was guessed from the program: some controls read `P` in milliseconds, others in seconds
              help: name the control: `--control`, `control` in gcheck.toml, or a comment `(gcheck: control=…)`
        "#]].assert_eq(&found.iter().map(words).collect::<String>());
    }
}
