//! A cut at a speed that was given while `S` meant something else.

use gcheck_controls::{CodeIx, Effect, Letter};
use gcheck_engine::{At, Event, Fact, Role, Spindle, Units};

use crate::declare::declare_rule;
use crate::facts::boundary::is_before;
use crate::facts::cutting::is_cut;
use crate::{PathCx, PathRule, Report, Run, Severity, Uses, Watch};
use crate::{Remembers, remembers};

declare_rule! {
    /// The program changes between surface speed and turns per minute (`G96`, `G97`), cuts, and gives no `S` in between. Or a
    /// tool gives its speed without `G96` or `G97`, the surface speed of the tool before is still on, and the number is twice as
    /// large as the one before, and more than a surface speed is.
    ///
    /// ## Why it matters
    /// The number gets another meaning: 1000 turns per minute become 1000 metres or feet per minute, and near the centre the
    /// spindle runs to its limit. The other way, 200 metres per minute become 200 turns per minute. Controls differ: some keep
    /// the number, some take the turns of the moment or the last number of this mode.
    ///
    /// ## Reported
    /// ```nc,reported,fanuc-lathe
    /// G21 G99 T0101
    /// G50 S2500
    /// G97 S1000 M3
    /// G0 X50. Z2.
    /// G96
    /// G1 Z-10. F.2
    /// M30
    /// ```
    /// ```nc,reported,fanuc-lathe
    /// G21 G99 T0101
    /// G50 S2500
    /// G96 S180 M3
    /// G0 X50. Z2.
    /// G1 Z-10. F.2
    /// T0303
    /// S800 M3
    /// G0 X50. Z2.
    /// G1 Z-5. F.1
    /// M30
    /// ```
    /// ## Not reported
    /// ```nc,quiet,fanuc-lathe
    /// G21 G99 T0101
    /// G50 S2500
    /// G97 S1000 M3
    /// G0 X50. Z2.
    /// G96 S200
    /// G1 Z-10. F.2
    /// G97 S800
    /// G1 Z-20.
    /// M30
    /// ```
    rule "speed-of-another-mode" in "spindle" {
        summary: "cut at a speed that was given under another speed mode",
        severity: Warning,
        tier: Path,
        since: "0.1.0",
        run: Run::Path {
            watch: Watch::ALL_BLOCKS.union(Watch::CUTS),
            make: || Box::new(SpeedOfAnotherMode::default()),
        },
    }
}

#[derive(Default, Clone, PartialEq)]
struct SpeedOfAnotherMode {
    /// The block that gave the speed in effect.
    at: Option<At>,
    /// The mode under which it gave it.
    given: Option<CodeIx>,
    /// The modes under which the program gave a speed on the way here.
    known: Vec<CodeIx>,
    /// The last speed, as it was written; `None` after a computed one.
    last: Option<f64>,
    /// The change of mode that was reported last.
    told: Option<At>,
}

remembers!(SpeedOfAnotherMode: at, told);

impl PathRule for SpeedOfAnotherMode {
    fn memory(&mut self) -> Remembers<'_> {
        Remembers::All(self)
    }

    fn concerns(&self, program: &Uses<'_>) -> bool {
        program.may(|effect| effect == Effect::SurfaceSpeed)
    }

    fn block(&mut self, cx: &PathCx<'_>, report: &mut Report<'_>) {
        let is_limit = cx.has_effect(|effect| effect == Effect::SpeedLimitOrSetPosition);
        if is_limit || !cx.has_word(|word| word.letter == Letter::of('S')) {
            return;
        }
        let speed = cx.known_number('S');
        let last = std::mem::replace(&mut self.last, speed);
        let most = match cx.state().units(cx.model) {
            Some(Units::Inch) => MOST_FEET,
            _ => MOST_METRES,
        };
        if let (Some(speed), Some(last)) = (speed, last)
            && speed >= last * MUCH
            && speed > most
        {
            inherited(cx, report);
        }
        self.at = Some(cx.origin().at);
        self.given = cx.code_of_role(Role::SpindleMode).or_else(|| cx.state().mode(Role::SpindleMode).only());
        if let Some(mode) = self.given.filter(|mode| !self.known.contains(mode)) {
            self.known.push(mode);
        }
    }

    fn cut(&mut self, cx: &PathCx<'_>, event: &Event, report: &mut Report<'_>) {
        let state = cx.state();
        let (Some(now), Some(given)) = (state.mode(Role::SpindleMode).only(), self.given) else { return };
        let (Some(means), Some(before)) = (meaning(cx.model.effect(now)), meaning(cx.model.effect(given)))
        else {
            return;
        };
        let definitions = cx.definitions();
        let (changed, speed) =
            (definitions.set_by(Fact::Mode(Role::SpindleMode)), definitions.set_by(Fact::Speed));
        if means == before || changed.is_none() || changed == self.told || speed != self.at {
            return;
        }
        if state.spindle() == Some(Spindle::Stopped) || !is_cut(cx, event) || cx.is_called_only() {
            return;
        }
        self.told = changed;
        let was_given = self.known.contains(&now);
        let (now, given) = (cx.name_of(now), cx.name_of(given));
        let message = format!("the spindle speed was given under another mode (`{given}`)");
        let mut finding = cx
            .finding(&META, cx.range(), message)
            .label(format!("with `{now}` the number means {means}"))
            .note("some controls keep the number, others take the last one of this mode or the turns of the moment")
            .help(format!("give `S` with `{now}`"))
            // The last number of this mode may be the one that is meant.
            .at_most(if was_given { Severity::Info } else { Severity::Warning });
        if let Some(range) = speed.and_then(|at| cx.find_word(at, |word| word.letter == Letter::of('S'))) {
            finding = finding.also(range, format!("given as {before} (`{given}`)"));
        }
        report.add(cx.resting_on(finding, Fact::Mode(Role::SpindleMode), &format!("`{now}`")));
    }
}

/// So many times as large a number is not one for another tool of the same mode, where no tool cuts so fast.
const MUCH: f64 = 2.0;
/// Surface speeds above which numbers are mostly turns: metres, and feet, a minute.
const MOST_METRES: f64 = 500.0;
const MOST_FEET: f64 = 1_600.0;

/// A tool gives a much larger speed than the one before, without a mode, and surface speed is still on.
fn inherited(cx: &PathCx<'_>, report: &mut Report<'_>) {
    let Some(mode) = cx.state().mode(Role::SpindleMode).only() else { return };
    let definitions = cx.definitions();
    let (set, tool) = (definitions.set_by(Fact::Mode(Role::SpindleMode)), definitions.set_by(Fact::Tool));
    let is_of_the_tool_before = set.zip(tool).is_some_and(|(set, tool)| is_before(set, tool));
    let is_stated = cx.code_of_role(Role::SpindleMode).is_some();
    if cx.model.effect(mode) != Effect::SurfaceSpeed
        || is_stated
        || !is_of_the_tool_before
        || cx.is_called_only()
    {
        return;
    }
    let name = cx.name_of(mode);
    let mut finding = cx
        .finding(
            &META,
            cx.letter_range('S'),
            format!("the speed is given under the mode of the tool before (`{name}`)"),
        )
        .label(format!(
            "with `{name}` the number means {}",
            meaning(Effect::SurfaceSpeed).unwrap_or_default()
        ))
        .help("state `G97` or `G96` with the speed");
    if let Some(range) = set.and_then(|at| cx.find_word(at, |word| word.code == mode)) {
        finding = finding.also(range, "the mode is from here");
    }
    report.add(finding);
}

fn meaning(mode: Effect) -> Option<&'static str> {
    match mode {
        Effect::SurfaceSpeed => Some("surface speed"),
        Effect::ConstantSpeed => Some("turns per minute"),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::check_rule;

    fn program(between: &str) -> String {
        format!("G20 G99 T101\nG50 S2000\nG97 S1000 M3\nG0 X2. Z.1\n{between}G1 Z-1. F.01\nM30\n")
    }

    #[test]
    fn each_change_is_told_once_at_its_first_cut() {
        check_rule(
            &RULE,
            "haas-lathe",
            &program("G96\nG0 X1.8\n"),
            &expect![[r#"
            7 | G1 Z-1. F.01
              | ^^^^^^^^^^^^ warning[speed-of-another-mode] the spindle speed was given under another mode (`G97`)
        "#]],
        );
        check_rule(&RULE, "haas-lathe", &program("G96\nG0 X1.8\nS300\n"), &expect![[""]]);
        check_rule(&RULE, "haas-lathe", &program("G96\nM5\n"), &expect![[""]]);
        check_rule(&RULE, "haas-lathe", &program("G96\nG97\n"), &expect![[""]]);
    }

    #[test]
    fn a_tool_without_a_mode_takes_that_of_the_tool_before() {
        let program = |second: &str| {
            format!("G21 G99 T0101\nG50 S2500\nG96 S180 M3\nG1 X20. F.2\n{second}\nG1 Z-5.\nM30\n")
        };
        check_rule(
            &RULE,
            "fanuc-lathe",
            &program("T0303\nS800 M3"),
            &expect![[r#"
                6 | S800 M3
                  | ^^^^ warning[speed-of-another-mode] the speed is given under the mode of the tool before (`G96`)
            "#]],
        );
        for second in ["T0303\nS220 M3", "T0303\nS400 M3", "T0303\nG97 S800 M3", "T0303\nG96 S400", "S400"] {
            check_rule(&RULE, "fanuc-lathe", &program(second), &expect![[""]]);
        }
    }

    #[test]
    fn back_in_a_mode_whose_speed_was_given() {
        check_rule(
            &RULE,
            "fanuc-lathe",
            "G21 G99 T0101\nG50 S2000\nG96 S200 M3\nG1 X20. F.2\nG97\nG1 Z-5.\nG96 S180\nG1 X0.\nG97 S900\nG96\nG1 X5.\nM30\n",
            &expect![[r#"
                11 | G1 X5.
                   | ^^^^^^ info[speed-of-another-mode] the spindle speed was given under another mode (`G97`)
            "#]],
        );
    }

    #[test]
    fn one_way_may_change_the_mode() {
        check_rule(
            &RULE,
            "fanuc-lathe",
            &program("IF [#500 EQ 1] GOTO 10\nG96\nN10 "),
            &expect![[r#"
                7 | N10 G1 Z-1. F.01
                  | ^^^^^^^^^^^^^^^^ info[speed-of-another-mode] the spindle speed was given under another mode (`G97`), when `#500` is not 1
            "#]],
        );
    }
}
