//! A probing move after the program switched the probe off.

use gcheck_controls::{Code, Effect};
use gcheck_engine::{At, Event};
use gcheck_program::Word;

use crate::declare::declare_rule;
use crate::facts::probing::{is_probing_move, is_touch};
use crate::{PathCx, PathRule, Remembers, Report, Run, Uses, Watch, limit, remembers};

declare_rule! {
    /// The program switches the probe off, and probes later; or it probes and switches the probe off, and has never switched it on.
    ///
    /// ## Why it matters
    /// One output switches the probe in the spindle and the one on the table. A probe that is off does not answer. The move goes on to its end point, and drives the stylus into the part.
    ///
    /// ## Reported
    /// ```nc,reported,haas-mill
    /// G90 G54 G0 X0. Y0.
    /// M59 P1134
    /// G31 Z-0.2 F10.
    /// M69 P1134
    /// G31 Z-0.3 F10.
    /// M30
    /// ```
    /// ## Not reported
    /// ```nc,quiet,haas-mill
    /// G90 G54 G0 X0. Y0.
    /// M59 P1134
    /// G31 Z-0.2 F10.
    /// M69 P1134
    /// M30
    /// ```
    rule "probe-switched-off" in "probing" {
        summary: "probing move after the probe was switched off",
        severity: Warning,
        tier: Path,
        since: "0.1.0",
        run: Run::Path {
            watch: Watch::CUTS.union(Watch::BLOCKS).union(Watch::CHANGES),
            make: || Box::new(ProbeSwitchedOff::default()),
        },
    }
}

#[derive(Default, Clone, PartialEq)]
struct ProbeSwitchedOff {
    /// The first probing move, if nothing has switched the probe before it.
    probed: Option<At>,
    /// The program, or a code that may do anything, has switched the probe.
    is_switched: bool,
}

remembers!(ProbeSwitchedOff: probed);

impl PathRule for ProbeSwitchedOff {
    fn memory(&mut self) -> Remembers<'_> {
        Remembers::All(self)
    }

    fn concerns(&self, program: &Uses<'_>) -> bool {
        program.may(|effect| effect == Effect::OutputOff)
    }

    fn block(&mut self, cx: &PathCx<'_>, _: &mut Report<'_>) {
        self.is_switched |= cx.has_effect(Effect::switches_output_on) && cx.known_number('P').is_none()
            || cx.has_code(Code::is_user)
            || !cx.is_certain();
    }

    fn changed(&mut self, cx: &PathCx<'_>, event: &Event, report: &mut Report<'_>) {
        let Event::Output { index, value, .. } = event else { return };
        let Some(switch) = Switch::of(cx).filter(|switch| switch.output == *index) else { return };
        let probed = self.probed.take().filter(|_| *value == 0.0 && !self.is_switched && cx.is_certain());
        self.is_switched = true;
        let Some(at) = probed else { return };
        let by = |word: &Word| word.code.is_some() && is_touch(cx.model.effect(word.code));
        let Some(range) = cx.find_word(at, by).or_else(|| cx.range_of(at)) else { return };
        report.add(
            cx.finding(&META, range, "probing before the probe is switched on")
                .label("the probe does not answer: the move goes on to its end point")
                .also(cx.range(), "the program only switches it off, here")
                .assuming("the probe is off when the program begins")
                .help(switch.help()),
        );
    }

    fn cut(&mut self, cx: &PathCx<'_>, event: &Event, report: &mut Report<'_>) {
        let Some(switch) = Switch::of(cx).filter(|_| is_probing_move(event)) else { return };
        if cx.known_variable(switch.variable) != Some(0.0) {
            if !self.is_switched && self.probed.is_none() {
                self.probed = Some(cx.origin().at);
            }
            return;
        }
        let Some(off) = cx.control().codes().find(|code| code.effect() == Effect::OutputOff) else { return };
        let entry = off.entry();
        report.add(
            cx.finding(&META, cx.effect_range(is_touch), "probing with the probe switched off")
                .label("the probe does not answer: the move goes on to its end point")
                .note(format!(
                    "`{} P{}` ({}) switched it off  [{}]",
                    entry.code, switch.output, entry.title, entry.source
                ))
                .help(switch.help())
                .at_most(limit(entry.confidence)),
        );
    }
}

/// The output that switches the probe.
struct Switch<'c> {
    output: u32,
    /// The variable that has its state.
    variable: u32,
    on: Code<'c>,
}

impl<'c> Switch<'c> {
    fn of(cx: &'c PathCx<'_>) -> Option<Self> {
        let semantics = cx.model.semantics();
        let output = semantics.probe_outputs.as_ref()?.on;
        let variable = semantics.output_variables?.saturating_add(output);
        // Another code of this effect sends a pulse alone, and nothing ends it.
        let stays = |code: &Code<'_>| !code.entry().cancelled_by.is_empty();
        let on = cx.control().codes().find(|code| code.effect() == Effect::OutputOn && stays(code))?;
        Some(Self { output, variable, on })
    }

    fn help(&self) -> String {
        format!("switch it on before this move: `{} P{}`", self.on.entry().code, self.output)
    }
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::{World, check_rule, findings, only, words};

    #[test]
    fn the_probe_may_be_on_by_other_means() {
        for before in [
            "",
            "M59 P1134\n",
            "M69 P1134\nM59 P1134\n",
            "M69 P#100\n",
            "M69 P1100\n",
            "M69 P1133\n",
            "M59 P1133\nM59 P1134\nM69 P1133\n",
        ] {
            let program = format!("G90 G54 G0 X0. Y0.\n{before}G31 Z-0.2 F10.\nM30\n");
            check_rule(&RULE, "haas-mill", &program, &expect![[""]]);
        }
    }

    #[test]
    fn it_has_to_be_switched_on_first() {
        let program = |before: &str| {
            format!("G90 G54 G0 X0. Y0.\n{before}G31 Z-0.2 F10.\nG31 Z-0.3 F5.\nM69 P1134\nM30\n")
        };
        let found = findings(&only(&RULE), "haas-mill", &program(""), &World::default());
        expect![[r#"
            probing before the probe is switched on
              here: the probe does not answer: the move goes on to its end point
              there: the program only switches it off, here
              assuming: the probe is off when the program begins
              help: switch it on before this move: `M59 P1134`
        "#]]
        .assert_eq(&found.iter().map(words).collect::<String>());
        for before in ["M59 P1134\n", "M59 P#100\n", "G65 P9832\n", "M69 P1134\nM59 P1134\n"] {
            check_rule(&RULE, "haas-mill", &program(before), &expect![[""]]);
        }
    }

    #[test]
    fn the_probe_on_the_table_has_the_same_switch() {
        check_rule(
            &RULE,
            "haas-mill",
            "G90 G54 G0 X0. Y0.\nM59 P1133\nM59 P1134\nG91 G35 Y-1. D1 F10.\nM69 P1134\nG35 Y-1. D1 F10.\nG90\nM30\n",
            &expect![[r#"
                6 | G35 Y-1. D1 F10.
                  | ^^^ warning[probe-switched-off] probing with the probe switched off
            "#]],
        );
    }

    #[test]
    fn one_way_may_switch_it_off() {
        check_rule(
            &RULE,
            "haas-mill",
            "G90 G54 G0 X0. Y0.\nIF [#500 EQ 1] GOTO 10\nM69 P1134\nN10 G91 G31 Z-0.2 F10. M75\nG36 X1. F5.\nG90\nM30\n",
            &expect![[r#"
                4 | N10 G91 G31 Z-0.2 F10. M75
                  |         ^^^ info[probe-switched-off] probing with the probe switched off, when `#500` is not 1
                5 | G36 X1. F5.
                  | ^^^ info[probe-switched-off] probing with the probe switched off, when `#500` is not 1
            "#]],
        );
    }
}
