//! A chuck that opens while the spindle turns.

use gcheck_controls::{Code, Effect};
use gcheck_engine::{Event, Fact, Spindle};

use crate::declare::declare_rule;
use crate::facts::second_spindle::has_second_spindle;
use crate::facts::workholding::{MayRest, is_builders, names_something_else, opens};
use crate::{PathCx, PathRule, Remembers, Report, Run, Severity, Uses, Watch, remembers};

declare_rule! {
    /// The chuck opens (`M11`) while the spindle turns. Programs for two spindles are not judged: there the other chuck holds the
    /// part, and both turn together. Where the machine builder decides what the code does, the finding is an information, unless a
    /// comment beside the code names something else: a parts catcher, a tailstock, a brake.
    ///
    /// ## Why it matters
    /// The part is thrown out of the jaws, or the machine stops with an alarm.
    ///
    /// ## Reported
    /// ```nc,reported,haas-lathe
    /// G20 T909
    /// G97 S1200 M3
    /// G0 X0. Z0.5
    /// M11
    /// M30
    /// ```
    /// ## Not reported
    /// ```nc,quiet,haas-lathe
    /// G20 T909
    /// G97 S1200 M3
    /// G0 X0. Z0.5
    /// M5
    /// M11
    /// M30
    /// ```
    rule "chuck-opened-while-turning" in "spindle" {
        summary: "chuck opened while the spindle turns",
        severity: Warning,
        tier: Path,
        since: "0.1.0",
        run: Run::Path {
            watch: Watch::BLOCKS.union(Watch::CHANGES),
            make: || Box::new(ChuckOpenedWhileTurning::default()),
        },
    }
}

#[derive(Default, Clone, PartialEq)]
struct ChuckOpenedWhileTurning {
    spindle: MayRest,
}

remembers!(ChuckOpenedWhileTurning);

impl PathRule for ChuckOpenedWhileTurning {
    fn memory(&mut self) -> Remembers<'_> {
        Remembers::All(self)
    }

    fn concerns(&self, program: &Uses<'_>) -> bool {
        program.may(opens) && !has_second_spindle(program)
    }

    fn changed(&mut self, _: &PathCx<'_>, event: &Event, _: &mut Report<'_>) {
        self.spindle.see(event);
    }

    fn block(&mut self, cx: &PathCx<'_>, report: &mut Report<'_>) {
        let turns = cx.state().spindle().is_some_and(Spindle::turns);
        let is_known = cx.is_certain();
        if !cx.has_effect(opens) || !turns || self.spindle.is_so() || !is_known || stops_in_block(cx) {
            return;
        }
        let codes = cx.codes();
        let code = codes.iter().copied().find(|ix| opens(cx.model.effect(*ix)));
        let Some(code) = code.and_then(|ix| cx.code_of(ix)) else { return };
        let is_sure = !is_builders(code);
        if !is_sure && names_something_else(cx, cx.origin().at) {
            return;
        }
        let name = code.number().to_string();
        let stop = cx.name_of_effect(Effect::SpindleStop).unwrap_or_default();
        let finding = cx
            .finding(
                &META,
                cx.effect_range(opens),
                format!("the chuck opens while the spindle turns (`{name}`)"),
            )
            .label("lets the part go")
            .help(format!("stop the spindle with `{stop}` before this block"));
        let finding = cx.resting_on(finding, Fact::Spindle, "the spindle");
        report.add(if is_sure {
            finding
        } else {
            finding.at_most(Severity::Info).assuming(format!("`{name}` opens the chuck on this machine"))
        });
    }
}

/// The block may stop the spindle first, or its effect is unknown.
fn stops_in_block(cx: &PathCx<'_>) -> bool {
    cx.has_effect(|effect| matches!(effect, Effect::SpindleStop | Effect::BarFeed))
        || cx.has_code(Code::is_user)
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::{World, check_rule, findings, only, words};

    fn program(before: &str) -> String {
        format!("G20 T909\nG97 S1200 M3\nG0 X0. Z0.5\n{before}M11\nG4 P1.\nM10\nM30\n")
    }

    #[test]
    fn the_spindle_has_to_stand() {
        let found = findings(&only(&RULE), "haas-lathe", &program(""), &World::default());
        expect![[r#"
            the chuck opens while the spindle turns (`M11`)
              here: lets the part go
              there: the spindle set here
              help: stop the spindle with `M5` before this block
        "#]]
        .assert_eq(&found.iter().map(words).collect::<String>());
        for before in ["M5\n", "M0\n", "M19\n", "M143 P1200\nG199\nM110\n", "G65 P9077\n"] {
            check_rule(&RULE, "haas-lathe", &program(before), &expect![[""]]);
        }
    }

    #[test]
    fn a_code_that_the_machine_builder_gave_its_meaning() {
        let program =
            |code: &str| format!("G21 G99 T0101\nG97 S800 M3\nG0 X42. Z2.\n{code}\nG0 X100. Z100.\nM30\n");
        let found = findings(&only(&RULE), "fanuc-lathe", &program("M69"), &World::default());
        expect![[r#"
            the chuck opens while the spindle turns (`M69`)
              here: lets the part go
              there: the spindle set here
              assuming: `M69` opens the chuck on this machine
              help: stop the spindle with `M5` before this block
        "#]]
        .assert_eq(&found.iter().map(words).collect::<String>());
        check_rule(
            &RULE,
            "fanuc-lathe",
            &program("M11"),
            &expect![[r#"
            4 | M11
              | ^^^ info[chuck-opened-while-turning] the chuck opens while the spindle turns (`M11`)
        "#]],
        );
        for code in ["M11 (PARTS CATCHER IN)", "M69 (TAILSTOCK BACK)"] {
            check_rule(&RULE, "fanuc-lathe", &program(code), &expect![[""]]);
        }
    }
}
