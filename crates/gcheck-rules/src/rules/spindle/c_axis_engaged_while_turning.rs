//! A C axis that is engaged while the spindle turns.

use gcheck_controls::{Code, Effect, Machine};
use gcheck_engine::{Abstract, Domain, Event, Fact, Spindle};

use crate::declare::declare_rule;
use crate::facts::second_spindle::has_second_spindle;
use crate::facts::workholding::{MayRest, Moved, moved};
use crate::{PathCx, PathRule, Remembers, Report, Run, Uses, Watch, remembers};

declare_rule! {
    /// The C axis is engaged (`M154`) while the spindle still turns. Controls whose data name no such code are not judged, nor are
    /// programs for two spindles.
    ///
    /// ## Why it matters
    /// The drive of the spindle changes to an axis that holds an angle. It takes the speed away at once, or the machine stops with an
    /// alarm in the middle of the work.
    ///
    /// ## Reported
    /// ```nc,reported,haas-lathe
    /// G20 G99 T101
    /// G97 S800 M3
    /// G0 X2. Z.1
    /// G1 Z-1. F.01
    /// G0 X3.
    /// M154
    /// M30
    /// ```
    /// ## Not reported
    /// ```nc,quiet,haas-lathe
    /// G20 G99 T101
    /// G97 S800 M3
    /// G0 X2. Z.1
    /// G1 Z-1. F.01
    /// G0 X3.
    /// M5
    /// M154
    /// M30
    /// ```
    rule "c-axis-engaged-while-turning" in "spindle" {
        summary: "C axis engaged while the spindle turns",
        severity: Warning,
        tier: Path,
        since: "0.1.0",
        run: Run::Path {
            watch: Watch::BLOCKS.union(Watch::CHANGES),
            make: || Box::new(CAxisEngagedWhileTurning::default()),
        },
    }
}

#[derive(Default, Clone, PartialEq)]
struct CAxisEngagedWhileTurning {
    may_rest: MayRest,
}

remembers!(CAxisEngagedWhileTurning);

/// The modal group of the codes that engage the axis and release it.
const GROUP: &str = "c-axis";

impl PathRule for CAxisEngagedWhileTurning {
    fn memory(&mut self) -> Remembers<'_> {
        Remembers::All(self)
    }

    fn changed(&mut self, _: &PathCx<'_>, event: &Event, _: &mut Report<'_>) {
        self.may_rest.see(event);
    }

    fn concerns(&self, program: &Uses<'_>) -> bool {
        let control = program.environment.control();
        control.machine() == Machine::Lathe
            && control.codes().any(|code| code.entry().group == GROUP)
            && !has_second_spindle(program)
    }

    fn block(&mut self, cx: &PathCx<'_>, report: &mut Report<'_>) {
        let turns = cx.state().spindle().is_some_and(Spindle::turns)
            && Abstract::known(cx.state().speed()) != Some(0.0)
            && !self.may_rest.is_so();
        // The block may stop the spindle first.
        if moved(cx, GROUP) != Some(Moved::Out)
            || !turns
            || cx.has_effect(Effect::stops_spindle)
            || !cx.is_certain()
        {
            return;
        }
        let engages = |code: Code<'_>| code.entry().group == GROUP && Moved::by(code) == Moved::Out;
        let Some((code, range)) = cx.find_code(cx.origin().at, engages) else { return };
        let stop = cx.name_of_effect(Effect::SpindleStop).unwrap_or_default();
        let finding = cx
            .finding(
                &META,
                range,
                format!("the C axis is engaged while the spindle turns (`{}`)", code.number()),
            )
            .label(format!("no `{stop}` before this"))
            .help(format!("stop the spindle with `{stop}` before this block"))
            .assuming("the code does not stop the spindle by itself");
        report.add(cx.resting_on(finding, Fact::Spindle, "the spindle"));
    }
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::{World, check_rule, findings, only, words};

    fn program(before: &str) -> String {
        format!(
            "G20 G99 T101\nG97 S800 M3\nG0 X2. Z.1\nG1 Z-1. F.01\nG0 X3.\n{before}M154\nG0 C0.\nM155\nM30\n"
        )
    }

    #[test]
    fn the_spindle_has_to_stop() {
        let found = findings(&only(&RULE), "haas-lathe", &program(""), &World::default());
        expect![[r#"
            the C axis is engaged while the spindle turns (`M154`)
              here: no `M5` before this
              there: the spindle set here
              assuming: the code does not stop the spindle by itself
              help: stop the spindle with `M5` before this block
        "#]]
        .assert_eq(&found.iter().map(words).collect::<String>());
        for before in ["M5\n", "M19\n", "M5 ", "G65 P9077\n", "M0\n", "M1\n", "S0\n"] {
            check_rule(&RULE, "haas-lathe", &program(before), &expect![[""]]);
        }
    }

    #[test]
    fn one_way_may_leave_it_turning() {
        check_rule(
            &RULE,
            "haas-lathe",
            &program("IF [#500 EQ 1] GOTO 5\nM5\nN5 "),
            &expect![[r#"
                8 | N5 M154
                  |    ^^^^ info[c-axis-engaged-while-turning] the C axis is engaged while the spindle turns (`M154`), when `#500` is 1
            "#]],
        );
    }
}
