//! 5-axis tool length compensation that is not switched off.

use gcheck_controls::Effect;
use gcheck_engine::{At, Ending, Fact, Role};

use crate::declare::declare_rule;
use crate::facts::boundary::{Boundary, boundary, boundary_range, ends_at_tape_mark};
use crate::facts::five_axis::is_along_tool;
use crate::facts::modes::{ActiveMode, left_on};
use crate::{PathCx, PathRule, Report, Run, Severity, Watch};
use crate::{Remembers, remembers};

declare_rule! {
    /// 5-axis length compensation (`G143`) is still on when the tool is changed, the axes return to their reference
    /// position or the program ends.
    ///
    /// ## Why it matters
    /// The axes return with the length along the tilted tool, and only the named axes move; the next tool begins with
    /// the correction of this one.
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
        fixable: OnRequest,
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
        if let Some(place) = boundary(cx) {
            let resets = place == Boundary::ProgramEnd && cx.end_resets(Role::Length);
            self.judge(cx, boundary_range(cx, place), place.words(), resets, report);
        }
        let returns = |effect| matches!(effect, Effect::ReturnReference(_));
        // Another rule reports incremental words.
        if cx.has_effect(returns) && !cx.has_effect(|effect| effect == Effect::Incremental) {
            let range = cx.effect_range(returns);
            self.judge(cx, range, "at the reference return", false, report);
        }
    }

    fn ended(&mut self, cx: &PathCx<'_>, ending: Ending, report: &mut Report<'_>) {
        if ends_at_tape_mark(cx, ending) {
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
        let Some(ActiveMode::Certain(code)) = left_on(cx, Role::Length, is_along_tool) else { return };
        let fact = Fact::Mode(Role::Length);
        let set_by = cx.definitions().set_by(fact);
        if set_by.is_none() || set_by == self.told {
            return;
        }
        self.told = set_by;
        let name = cx.name_of(code);
        let cancel = cx.name_of_effect(Effect::LengthOff).unwrap_or_default();
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
