//! A spindle that is started without a speed.

use gcheck_controls::{CodeIx, Letter};
use gcheck_engine::{Abstract, At, Domain, Event, Fact, Spindle};
use gcheck_program::Place;

use crate::declare::declare_rule;
use crate::facts::cutting::is_cut;
use crate::facts::cycles::cycle_name;
use crate::facts::earlier_rates::last_rate_of_tool;
use crate::{PathCx, PathRule, Report, Run, Severity, Watch};
use crate::{Remembers, remembers};

declare_rule! {
    /// A block cuts with the spindle started (`M3`, `M4`), and no earlier block on this path gives a speed (`S`).
    ///
    /// ## Why it matters
    /// The spindle turns at the speed of the last program, does not turn, or the control stops with an alarm.
    ///
    /// ## Reported
    /// ```nc,reported,haas-mill
    /// G0 X1. M3
    /// G1 X2. F10.
    /// S1000
    /// G1 X3.
    /// M30
    /// ```
    /// ```nc,reported,haas-mill
    /// T1 M6
    /// S1000 M3
    /// G1 X2. F10.
    /// M5 S0
    /// M3
    /// G1 X3.
    /// M30
    /// ```
    /// ## Not reported
    /// ```nc,quiet,haas-mill
    /// M3
    /// G0 X1. S1000
    /// G1 X2. F10.
    /// M30
    /// ```
    /// Where cuts give speeds, they are the power of a laser.
    /// ```nc,quiet,linuxcnc
    /// T1 M6
    /// M4 S0
    /// G1 X10 F1000 S500
    /// G1 X20 S0
    /// M2
    /// ```
    rule "speed-missing" in "spindle" {
        summary: "spindle started without a speed",
        severity: Warning,
        tier: Path,
        fixable: OnRequest,
        since: "0.1.0",
        run: Run::Path { watch: Watch::CUTS, make: || Box::new(SpeedMissing { told: None }) },
    }
}

#[derive(Clone, PartialEq)]
struct SpeedMissing {
    /// The block that started the spindle where it was reported last.
    told: Option<At>,
}

remembers!(SpeedMissing: told);

impl PathRule for SpeedMissing {
    fn memory(&mut self) -> Remembers<'_> {
        Remembers::All(self)
    }

    fn cut(&mut self, cx: &PathCx<'_>, event: &Event, report: &mut Report<'_>) {
        let state = cx.state();
        let turns = state.spindle().is_some_and(Spindle::turns);
        if !turns || Abstract::known(state.speed()) != Some(0.0) || !is_cut(cx, event) || cx.is_called_only()
        {
            return;
        }
        let started_by = cx.definitions().set_by(Fact::Spindle);
        let has_any = cx.file_index.letters.contains(Letter::of('S'));
        if started_by.is_none() || self.told == started_by || !has_any && self.told.is_some() {
            return;
        }
        // The power of a laser, which changes from cut to cut and is zero between them.
        if cx.file_index.has_speed_in_cuts {
            return;
        }
        let set_by = cx.definitions().set_by(Fact::Speed);
        // A laser is off at `S0`, and its blocks that move say so, long after it was started. No program changes one.
        let moves = |place: Place| cx.has_axis_among(place.block().letters);
        let changes_tools = cx.definitions().set_by(Fact::Tool).is_some();
        if !changes_tools && set_by != started_by && set_by.and_then(|at| cx.place_of(at)).is_some_and(moves)
        {
            return;
        }
        self.told = started_by;
        let by_code = started_by.and_then(|at| start_code(cx, at));
        // A cycle that taps may start the spindle itself.
        let by_cycle = by_code.is_none().then(|| cycle_name(cx)).filter(|name| !name.is_empty());
        let code = by_code.or_else(|| by_cycle.clone()).unwrap_or_else(|| "M3".to_owned());
        let is_zero = set_by.is_some();
        let message = if is_zero {
            format!("the spindle turns with speed zero (`S0`, `{code}`)")
        } else if by_cycle.is_some() {
            format!("the cycle starts the spindle without a speed (`{code}`, no `S` before it)")
        } else {
            format!("the spindle was started without a speed (`{code}` without `S`)")
        };
        let finding = cx
            .finding(&META, cx.range(), message)
            .label(if is_zero { "cuts at speed zero" } else { "cuts without a speed of this program" })
            .help(format!("give `S` with `{code}`"))
            .fix_if(started_by.and_then(|at| last_rate_of_tool(cx, Letter::of('S'), at)));
        // A machine whose speed is set by hand.
        let finding = if has_any { finding } else { finding.at_most(Severity::Info) };
        let finding = cx.resting_on(finding, Fact::Spindle, &format!("`{code}`"));
        report.add(if is_zero {
            cx.resting_on(finding, Fact::Speed, "`S0`")
        } else {
            finding.assuming("no earlier program left a speed")
        });
    }
}

fn start_code(cx: &PathCx<'_>, at: At) -> Option<String> {
    let place = cx.place_of(at)?;
    let words = place.table.words(place.block()).iter();
    let is_start = |code: &CodeIx| code.is_some() && cx.model.effect(*code).starts_spindle();
    let code = words.map(|word| word.code).find(is_start)?;
    Some(cx.name_of(code))
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::{World, check_rule, findings, fixes_of, only};

    #[test]
    fn the_first_cut_is_marked() {
        check_rule(
            &RULE,
            "fanuc-mill",
            "G0 X1. M4\nG1 X2. F50.\nM8\nX3.\nS500\nM30\n",
            &expect![[r#"
            2 | G1 X2. F50.
              | ^^^^^^^^^^^ warning[speed-missing] the spindle was started without a speed (`M4` without `S`)
        "#]],
        );
    }

    #[test]
    fn a_speed_set_by_hand_is_told_once() {
        check_rule(
            &RULE,
            "fanuc-mill",
            "M3\nG1 X2. F50.\nM5\nM3\nG1 X3.\nM30\n",
            &expect![[r#"
            2 | G1 X2. F50.
              | ^^^^^^^^^^^ info[speed-missing] the spindle was started without a speed (`M3` without `S`)
        "#]],
        );
    }

    #[test]
    fn a_cycle_that_starts_the_spindle() {
        check_rule(
            &RULE,
            "haas-mill",
            "G21 G90 G54 G0 X0. Y0. Z20.\nG84 X0. Y0. Z-10. R5. F1.\nG80\nS500 M3\nG1 X2. F50.\nM30\n",
            &expect![[r#"
                2 | G84 X0. Y0. Z-10. R5. F1.
                  | ^^^^^^^^^^^^^^^^^^^^^^^^^ warning[speed-missing] the cycle starts the spindle without a speed (`G84`, no `S` before it)
            "#]],
        );
    }

    #[test]
    fn the_last_speed_of_the_tool_is_offered() {
        let fixed = |program: &str| fixes_of(&RULE, "fanuc-mill", program);
        let program = "T1 M6\nS2000 M3\nG1 X1. F50.\nT2 M6\nS900 M3\nG1 X2.\nT1 M6\nM3 S0\nG1 X3.\nM30\n";
        assert_eq!(fixed(program), program.replace("S0", "S2000"));
        // None is known of this tool; a limit is not a speed.
        for program in [
            "T1 M6\nS2000 M3\nG1 X1. F50.\nT2 M6\nS0 M3\nG1 X2.\nM30\n",
            "T1 M6\nS0 M3\nG1 X2. F50.\nS500\nM30\n",
        ] {
            assert_eq!(fixed(program), program);
        }
    }

    #[test]
    fn speed_zero_is_none() {
        check_rule(
            &RULE,
            "fanuc-mill",
            "S0 M3\nG1 X2. F50.\nM30\n",
            &expect![[r#"
            2 | G1 X2. F50.
              | ^^^^^^^^^^^ warning[speed-missing] the spindle turns with speed zero (`S0`, `M3`)
        "#]],
        );
    }

    #[test]
    fn a_laser_is_off_at_speed_zero() {
        check_rule(&RULE, "grbl", "M4\nG1 X-2 F6000 S0\nG1 X-10 S300\nG1 X-2 S0\nM5\nM2\n", &expect![[""]]);
    }

    #[test]
    fn a_speed_that_cuts_change_is_the_power_of_a_laser() {
        let cuts = "G0 X0 Y0\nG1 X10 F1000 S500\nG1 X20 S0\nG1 X30 S500\nS0\nM5\nM2\n";
        for start in ["T1 M6\nM4 S0", "M4 S0\nG1 X-1 F1000", "T1 M6\nM3", "M3\nG1 X-1 F1000"] {
            check_rule(&RULE, "linuxcnc", &format!("G21 G90\n{start}\n{cuts}"), &expect![[""]]);
        }
        // The speed of a mill may be in the block that brings the tool.
        let mill = "G21 G90\nT1 M6\nG0 X0 Y0 S500 M3\nG1 X10 F1000\nT2 M6\nG0 X0 S0 M3\nG1 X20\nM2\n";
        check_rule(
            &RULE,
            "linuxcnc",
            mill,
            &expect![[r#"
                7 | G1 X20
                  | ^^^^^^ warning[speed-missing] the spindle turns with speed zero (`S0`, `M3`)
            "#]],
        );
    }

    #[test]
    fn speed_zero_may_be_in_the_block_that_cuts() {
        let program = |block: &str| {
            format!(
                "G20 G17 G90 G94\nT1 M06\nG00 G54 X0. Y0.\nS3000 M03\nG43 H01 Z1.\n{block}\nM30\nO2000\nG01 Y1.\nX-1.\nY-1.\nX1.\nY1.\nX0.\nM99\n"
            )
        };
        let g150 = "G150 G41 D01 P2000 X0. Y0. Z-0.5 Q0.25 R0.1 J0.3 K0.01 F15.";
        for block in
            ["G01 Z-0.1 F10. S0", "S0\nG01 Z-0.1 F10.", &format!("{g150} S0"), &format!("{g150} S[1-1]")]
        {
            let found = findings(&only(&RULE), "haas-mill", &program(block), &World::default());
            assert_eq!(found.len(), 1, "{block}");
        }
        for block in ["G01 Z-0.1 F10. S2000", &format!("{g150} S2000"), "G01 Z-0.1 F10."] {
            check_rule(&RULE, "haas-mill", &program(block), &expect![[""]]);
        }
    }

    #[test]
    fn a_speed_of_unknown_value_is_a_speed() {
        check_rule(&RULE, "fanuc-mill", "S#500 M3\nG1 X2. F50.\nM30\n", &expect![[""]]);
    }

    #[test]
    fn the_caller_of_a_subprogram_gives_the_speed() {
        check_rule(&RULE, "fanuc-mill", "O10\nM3\nG1 X2. F50.\nM99\n", &expect![[""]]);
    }
}
