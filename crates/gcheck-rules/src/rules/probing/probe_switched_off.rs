//! A probing move after the program switched the probe off.

use gcheck_controls::{Effect, Letter};
use gcheck_engine::Event;

use crate::declare::declare_rule;
use crate::facts::probing::{is_probing_move, is_touch};
use crate::{PathCx, PathRule, Report, Run, Uses, Watch, limit};

declare_rule! {
    /// The program switches the probe off, and probes later.
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
        run: Run::Path { watch: Watch::CUTS, make: || Box::new(ProbeSwitchedOff) },
    }
}

struct ProbeSwitchedOff;

impl PathRule for ProbeSwitchedOff {
    fn concerns(&self, program: &Uses<'_>) -> bool {
        program.may(|effect| effect == Effect::OutputOff)
    }

    fn cut(&mut self, cx: &PathCx<'_>, event: &Event, report: &mut Report<'_>) {
        let semantics = cx.model.semantics();
        let (Some(first), Some(outputs)) = (semantics.output_variables, semantics.probe_outputs) else {
            return;
        };
        if !is_probing_move(event) {
            return;
        }
        let output = outputs.on;
        if cx.known_variable(first.saturating_add(output)) != Some(0.0) {
            return;
        }
        let by = |effect: Effect| cx.control().codes().find(|code| code.effect() == effect);
        let (Some(off), Some(on)) = (by(Effect::OutputOff), by(Effect::OutputOn)) else { return };
        let (entry, letter) = (off.entry(), Letter::of('P'));
        report.add(
            cx.finding(&META, cx.effect_range(is_touch), "probing with the probe switched off")
                .label("the probe does not answer: the move goes on to its end point")
                .note(format!(
                    "`{} {letter}{output}` ({}) switched it off  [{}]",
                    entry.code, entry.title, entry.source
                ))
                .help(format!("switch it on before this move: `{} {letter}{output}`", on.entry().code))
                .at_most(limit(entry.confidence)),
        );
    }
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::check_rule;

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
