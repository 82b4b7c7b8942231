//! A spindle that starts with the chuck open.

use gcheck_controls::{Code, Effect};
use gcheck_engine::{Event, Fact, Spindle, Truth};

use crate::declare::declare_rule;
use crate::facts::second_spindle::has_second_spindle;
use crate::facts::workholding::{is_builders, names_something_else, opens};
use crate::{PathCx, PathRule, Remembers, Report, Run, Severity, Uses, Watch, remembers};

declare_rule! {
    /// The program opens the chuck (`M11`) and starts the spindle before it closes the chuck again. A stop of the program between shows
    /// that the operator may do it, and programs for two spindles are not judged. Where the machine builder decides what the code does,
    /// the finding is an information, unless a comment beside the code names something else.
    ///
    /// ## Why it matters
    /// Nothing holds the part: it flies out when the spindle turns, or when the first cut begins.
    ///
    /// ## Reported
    /// ```nc,reported,haas-lathe
    /// G20 T909
    /// M5
    /// M11
    /// G4 P1.
    /// G97 S1200 M3
    /// G0 X2. Z0.5
    /// M30
    /// ```
    /// ## Not reported
    /// ```nc,quiet,haas-lathe
    /// G20 T909
    /// M5
    /// M11
    /// G4 P1.
    /// M10
    /// G4 P1.
    /// G97 S1200 M3
    /// G0 X2. Z0.5
    /// M30
    /// ```
    rule "chuck-left-open" in "spindle" {
        summary: "spindle starts with the chuck open",
        severity: Warning,
        tier: Path,
        since: "0.1.0",
        run: Run::Path {
            watch: Watch::BLOCKS.union(Watch::CHANGES),
            make: || Box::new(ChuckLeftOpen::default()),
        },
    }
}

#[derive(Default, Clone, PartialEq)]
struct ChuckLeftOpen {
    /// The operator or a code of the machine builder may have closed the chuck since the program opened it, or what is wrong with
    /// the open chuck is told.
    is_settled: bool,
}

remembers!(ChuckLeftOpen);

impl PathRule for ChuckLeftOpen {
    fn memory(&mut self) -> Remembers<'_> {
        Remembers::All(self)
    }

    fn concerns(&self, program: &Uses<'_>) -> bool {
        program.may(opens) && !has_second_spindle(program)
    }

    fn changed(&mut self, cx: &PathCx<'_>, event: &Event, _: &mut Report<'_>) {
        match event {
            // Another rule reports a chuck that opens while the spindle turns, and that finding is the worse one.
            Event::Chuck(_) => self.is_settled = cx.state().spindle() != Some(Spindle::Stopped),
            Event::Stop(_) => self.is_settled = true,
            _ => {}
        }
    }

    fn block(&mut self, cx: &PathCx<'_>, report: &mut Report<'_>) {
        self.is_settled |= cx.has_code(Code::is_user);
        let is_open = cx.state().bar().clamped() == Truth::False && !self.is_settled;
        // The block may close it first.
        let closes = cx.has_effect(|effect| matches!(effect, Effect::ChuckClamp | Effect::BarFeed));
        if !is_open || closes || !cx.has_effect(Effect::starts_spindle) || !cx.is_certain() {
            return;
        }
        let Some(at) = cx.definitions().set_by(Fact::Chuck) else { return };
        let Some((code, opener)) = cx.find_code(at, |code| opens(code.effect())) else { return };
        let is_sure = !is_builders(code);
        if !is_sure && names_something_else(cx, at) {
            return;
        }
        // Told once.
        self.is_settled = true;
        let close = cx.name_of_effect(Effect::ChuckClamp).unwrap_or_default();
        let finding = cx
            .finding(&META, cx.effect_range(Effect::starts_spindle), "the spindle starts with the chuck open")
            .label("nothing holds the part")
            .also(opener, "opened here")
            .help(format!("close the chuck with `{close}` before this block, and give it time"));
        report.add(if is_sure {
            finding
        } else {
            let name = code.number();
            finding.at_most(Severity::Info).assuming(format!("`{name}` opens the chuck on this machine"))
        });
    }
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::{World, check_rule, findings, only, words};

    fn program(between: &str) -> String {
        format!("G20 T909\nM5\nM11\n{between}G97 S1200 M3\nG0 X2. Z0.5\nM30\n")
    }

    #[test]
    fn the_chuck_has_to_close_first() {
        let found = findings(&only(&RULE), "haas-lathe", &program("G4 P1.\n"), &World::default());
        expect![[r#"
            the spindle starts with the chuck open
              here: nothing holds the part
              there: opened here
              help: close the chuck with `M10` before this block, and give it time
        "#]]
        .assert_eq(&found.iter().map(words).collect::<String>());
        // Opened while the spindle turns: another rule tells it.
        let turning = "G20 T909\nG97 S1200 M3\nM11\nG97 S900 M3\nM30\n";
        check_rule(&RULE, "haas-lathe", turning, &expect![[""]]);
        for between in ["M10\n", "M0\n", "G105 J1.\n", "G65 P9077\n", "M110\n"] {
            check_rule(&RULE, "haas-lathe", &program(between), &expect![[""]]);
        }
    }

    #[test]
    fn one_way_may_leave_it_open() {
        check_rule(
            &RULE,
            "haas-lathe",
            &program("IF [#500 EQ 1] GOTO 5\nM10\nN5 "),
            &expect![[r#"
                6 | N5 G97 S1200 M3
                  |              ^^ info[chuck-left-open] the spindle starts with the chuck open, when `#500` is 1
            "#]],
        );
    }

    #[test]
    fn a_code_that_the_machine_builder_gave_its_meaning() {
        let program = |code: &str| format!("G21 G99 T0101\nM5\n{code}\nG97 S800 M3\nG0 X42. Z2.\nM30\n");
        check_rule(
            &RULE,
            "fanuc-lathe",
            &program("M69"),
            &expect![[r#"
                4 | G97 S800 M3
                  |          ^^ info[chuck-left-open] the spindle starts with the chuck open
            "#]],
        );
        check_rule(&RULE, "fanuc-lathe", &program("M11 (PARTS CATCHER IN)"), &expect![[""]]);
    }
}
