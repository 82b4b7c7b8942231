//! A length along the tool that nobody switched off.

use gcheck_controls::Effect;
use gcheck_engine::{At, Ending, Fact, Role};

use crate::boundary::{Boundary, LeftOn};
use crate::five_axis::is_along_tool;
use crate::memory::{Remembers, remembers};
use crate::meta::declare_rule;
use crate::{PathCx, PathRule, Report, Run, Severity, Watch};

declare_rule! {
    /// 5-axis length compensation (`G143`) is still on where the tool is changed, the axes return to their reference
    /// position or the program ends.
    ///
    /// ## Why it matters
    /// The way home is made with the length along the tilted tool, and only on the axes that are named; the next tool begins
    /// with the correction of this one.
    ///
    /// ## Reported
    /// ```nc,reported,haas-mill
    /// G90 G143 H1 X0. Y0. Z1. A0. B0.
    /// G0 X1. Y1. Z1. A5. B5.
    /// T2 M6
    /// M30
    /// ```
    /// ```nc,reported,haas-mill
    /// G90 G143 H1 X0. Y0. Z1. A0. B0.
    /// G28
    /// G49
    /// M30
    /// ```
    /// ## Not reported
    /// ```nc,quiet,haas-mill
    /// G90 G143 H1 X0. Y0. Z1. A0. B0.
    /// G0 X1. Y1. Z1. A5. B5.
    /// G49 Z5.
    /// G28
    /// T2 M6
    /// M30
    /// ```
    rule "five-axis-length-left-on" in "five_axis" {
        summary: "5-axis length compensation left on",
        severity: Warning,
        tier: Path,
        mends: OnRequest,
        since: "0.1.0",
        run: Run::Path {
            watch: Watch::BLOCKS.union(Watch::ENDS),
            make: || Box::new(FiveAxisLengthLeftOn { told: None }),
        },
    }
}

#[derive(Clone, PartialEq)]
struct FiveAxisLengthLeftOn {
    /// The block that switched on what was reported last.
    told: Option<At>,
}

remembers!(FiveAxisLengthLeftOn: told);

impl PathRule for FiveAxisLengthLeftOn {
    fn memory(&mut self) -> Remembers<'_> {
        Remembers::All(self)
    }

    fn block(&mut self, cx: &PathCx<'_>, report: &mut Report<'_>) {
        if let Some(place) = cx.boundary() {
            let resets = place == Boundary::ProgramEnd && cx.end_resets(Role::Length);
            self.judge(cx, cx.boundary_range(place), place.words(), resets, report);
        }
        let returns = |effect| matches!(effect, Effect::ReturnReference(_));
        // Incremental words have a rule of their own.
        if cx.has_effect(returns) && !cx.has_effect(|effect| effect == Effect::Incremental) {
            let range = cx.effect_range(returns);
            self.judge(cx, range, "at the reference return", false, report);
        }
    }

    fn ended(&mut self, cx: &PathCx<'_>, ending: Ending, report: &mut Report<'_>) {
        if cx.ends_at_tape_mark(ending) {
            let resets = cx.end_resets(Role::Length);
            self.judge(cx, cx.range(), Boundary::ProgramEnd.words(), resets, report);
        }
    }
}

impl FiveAxisLengthLeftOn {
    fn judge(
        &mut self,
        cx: &PathCx<'_>,
        range: std::ops::Range<u32>,
        place: &str,
        end_resets: bool,
        report: &mut Report<'_>,
    ) {
        let Some(LeftOn::Surely(code)) = cx.left_on(Role::Length, is_along_tool) else { return };
        let fact = Fact::Mode(Role::Length);
        let set_by = cx.trace().set_by(fact);
        if set_by.is_none() || set_by == self.told {
            return;
        }
        self.told = set_by;
        let name = cx.name_of(code);
        let cancel = cx.cancel_of(Effect::LengthOff).unwrap_or_default();
        let finding = cx
            .finding(&META, range, format!("5-axis length compensation is still on {place} (`{name}`)"))
            .label("the length is along the tilted tool here")
            .help(format!("end it with `{cancel}` and a move of Z away from the part before this block"))
            .fix_if(cx.block_before(Some(&cancel)));
        let finding = if end_resets {
            finding.note("the end of the program switches it off on this control").at_most(Severity::Info)
        } else {
            finding
        };
        report.add(cx.resting_on(finding, fact, &format!("`{name}`")));
    }
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::check_rule;

    #[test]
    fn an_end_that_resets_it_is_worth_knowing() {
        check_rule(
            &RULE,
            "haas-mill",
            "G90 G143 H1 X0. Y0. Z1. A0. B0.\nM30\n",
            &expect![[r#"
            2 | M30
              | ^^^ info[five-axis-length-left-on] 5-axis length compensation is still on at the end of the program (`G143`)
        "#]],
        );
    }

    #[test]
    fn another_length_code_or_no_length_ends_it() {
        check_rule(
            &RULE,
            "haas-mill",
            "G90 G143 H1 X0. Y0. Z1. A0. B0.\nG43 H1 Z2.\nT2 M6\nG143 H2 X0. Y0. Z1. A0. B0.\nH0\nT1 M6\nM30\n",
            &expect![[""]],
        );
    }

    #[test]
    fn told_once_for_each_time_it_is_switched_on() {
        check_rule(
            &RULE,
            "haas-mill",
            "G90 G143 H1 X0. Y0. Z1. A0. B0.\nT2 M6\nT3 M6\nG143 H3 X0. Y0. Z1. A0. B0.\nG28\nT4 M6\nM30\n",
            &expect![[r#"
                2 | T2 M6
                  |    ^^ warning[five-axis-length-left-on] 5-axis length compensation is still on at the tool change (`G143`)
                5 | G28
                  | ^^^ warning[five-axis-length-left-on] 5-axis length compensation is still on at the reference return (`G143`)
            "#]],
        );
    }
}
