//! 5-axis tool length compensation without a length offset.

use gcheck_controls::Letter;
use gcheck_engine::{Abstract, Domain};

use crate::declare::declare_rule;
use crate::facts::five_axis::is_along_tool;
use crate::{PathCx, PathRule, Report, Run, Severity, Watch, limit};
use crate::{Remembers, remembers};

declare_rule! {
    /// 5-axis length compensation (`G143`) is switched on without a length offset: there is no `H` in its block and no
    /// earlier `H` is in effect, or it is `H0`.
    ///
    /// ## Why it matters
    /// Without a number the control does not know by how much the tool differs from the one that the program was posted
    /// for. `H0` ends the compensation: the tool moves as if it had the posted length.
    ///
    /// ## Reported
    /// ```nc,reported,haas-mill
    /// G90 G54 G0 X0. Y0. Z1. A0. B0.
    /// G143 X1. Y1. Z1. A5. B5.
    /// M30
    /// ```
    /// ```nc,reported,haas-mill
    /// G90 G54 G0 X0. Y0. Z1. A0. B0.
    /// G143 H0 X1. Y1. Z1. A5. B5.
    /// M30
    /// ```
    /// ## Not reported
    /// ```nc,quiet,haas-mill
    /// G90 G54 G0 X0. Y0. Z1. A0. B0.
    /// G143 H1 X1. Y1. Z1. A5. B5.
    /// M30
    /// ```
    /// A length that is already in effect:
    /// ```nc,quiet,haas-mill
    /// G90 G54 G0 X0. Y0. A0. B0.
    /// G43 H1 Z1.
    /// G143 X1. Y1. Z1. A5. B5.
    /// M30
    /// ```
    rule "five-axis-length-without-offset" in "five_axis" {
        summary: "5-axis length compensation without a length offset",
        severity: Error,
        tier: Path,
        since: "0.1.0",
        run: Run::Path { watch: Watch::BLOCKS, make: || Box::new(FiveAxisLengthWithoutOffset { is_given: false }) },
    }
}

#[derive(Clone, PartialEq)]
struct FiveAxisLengthWithoutOffset {
    /// An earlier block has an `H`.
    is_given: bool,
}

remembers!(FiveAxisLengthWithoutOffset);

impl PathRule for FiveAxisLengthWithoutOffset {
    fn memory(&mut self) -> Remembers<'_> {
        Remembers::All(self)
    }

    fn block(&mut self, cx: &PathCx<'_>, report: &mut Report<'_>) {
        self.judge(cx, report);
        self.is_given |= cx.origin().letters.contains(Letter::of('H'));
    }
}

impl FiveAxisLengthWithoutOffset {
    fn judge(&self, cx: &PathCx<'_>, report: &mut Report<'_>) {
        let codes = cx.codes();
        let Some(code) = codes.iter().copied().find(|code| is_along_tool(cx.model.effect(*code))) else {
            return;
        };
        let Some(entry) = cx.control().code_at(code) else { return };
        let (name, entry) = (entry.number(), entry.entry());
        let what = "5-axis length compensation";
        let finding = match cx.word('H') {
            Some(word) if word.number() == Some(0.0) => cx
                .finding(&META, cx.letter_range('H'), format!("{what} with no length (`{name} H0`)"))
                .label("`H0` ends the compensation that the block begins"),
            Some(_) if cx.known_number('H') == Some(0.0) => cx
                .finding(
                    &META,
                    cx.letter_range('H'),
                    format!("{what} with no length (`{name}` with `H` of 0)"),
                )
                .label("its value is 0, which ends the compensation that the block begins"),
            Some(_) => return,
            None if cx.is_malformed() => return,
            None if cx.is_called_only() || Abstract::known(cx.state().h()) != Some(0.0) => return,
            None => {
                let finding = cx.finding(
                    &META,
                    cx.effect_range(is_along_tool),
                    format!("{what} without a length offset (`{name}` without `H`)"),
                );
                if self.is_given {
                    // The control may still remember it.
                    finding.label("no `H` here, and the one before was cancelled").at_most(Severity::Warning)
                } else {
                    finding.label("no `H` here, and no earlier one in effect")
                }
            }
        };
        let finding = finding
            .note(format!("`{name}` takes the length from the offset that `H` names  [{}]", entry.source))
            .help(format!(
                "give the number of the offset with the difference between this tool and the posted one: `{name} H1`"
            ))
            .at_most(limit(entry.confidence));
        report.add(finding.at_most(cx.environment.most_for_this_control()));
    }
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::check_rule;

    #[test]
    fn a_computed_number_of_zero() {
        check_rule(
            &RULE,
            "haas-mill",
            "G90 G54 G0 X0. Y0. Z1. A0. B0.\n#1=2.\nG143 H[#1-2.] X1. Y1. Z1. A5. B5.\nG49\nG143 H[#1-1.] X1. Y1. Z1. A5. B5.\nG49\nG143 H#500 X1. Y1. Z1. A5. B5.\nG49\nM30\n",
            &expect![[r#"
                3 | G143 H[#1-2.] X1. Y1. Z1. A5. B5.
                  |      ^^^^^^^^ error[five-axis-length-without-offset] 5-axis length compensation with no length (`G143` with `H` of 0)
            "#]],
        );
    }

    #[test]
    fn a_computed_number_is_no_missing_one() {
        check_rule(&RULE, "haas-mill", "G90\nG143 H#500 X1. Y1. Z1. A5. B5.\nM30\n", &expect![[""]]);
    }

    #[test]
    fn a_length_that_was_cancelled_may_be_remembered() {
        check_rule(
            &RULE,
            "haas-mill",
            "G90 G43 H1 Z1.\nG49\nG143 X1. Y1. Z1. A5. B5.\nM30\n",
            &expect![[r#"
                3 | G143 X1. Y1. Z1. A5. B5.
                  | ^^^^ warning[five-axis-length-without-offset] 5-axis length compensation without a length offset (`G143` without `H`)
            "#]],
        );
    }

    #[test]
    fn a_safety_line_gives_no_length() {
        check_rule(
            &RULE,
            "haas-mill",
            "G17 G40 G49 G80 G90\nT1 M6\nG143 X1. Y1. Z1. A5. B5.\nG49\nM30\n",
            &expect![[r#"
                3 | G143 X1. Y1. Z1. A5. B5.
                  | ^^^^ error[five-axis-length-without-offset] 5-axis length compensation without a length offset (`G143` without `H`)
            "#]],
        );
    }

    #[test]
    fn a_subprogram_takes_its_callers_length() {
        check_rule(&RULE, "haas-mill", "O100\nG143 X1. Y1. Z1. A5. B5.\nM99\n", &expect![[""]]);
    }

    #[test]
    fn in_a_loop_it_is_told_once() {
        check_rule(
            &RULE,
            "haas-mill",
            "#1=0\nWHILE [#1 LT 3] DO1\nG143 X1. Y1. Z1. A5. B5.\n#1=#1+1\nEND1\nM30\n",
            &expect![[r#"
                3 | G143 X1. Y1. Z1. A5. B5.
                  | ^^^^ error[five-axis-length-without-offset] 5-axis length compensation without a length offset (`G143` without `H`)
            "#]],
        );
    }
}
