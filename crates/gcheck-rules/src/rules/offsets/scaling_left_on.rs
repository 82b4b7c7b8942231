//! Scaling that the program leaves on.

use gcheck_controls::Effect;
use gcheck_engine::{Ending, Event, Role};

use crate::boundary::Boundary;
use crate::carried::Carried;
use crate::memory::{Remembers, remembers};
use crate::meta::declare_rule;
use crate::{PathCx, PathRule, Report, Run, Uses, Watch};

declare_rule! {
    /// Scaling is still on where the program ends, or the next tool cuts with it and nothing in the program switches it off.
    ///
    /// ## Why it matters
    /// The next program, the next part or the next tool is cut in another size.
    ///
    /// ## Reported
    /// ```nc,reported,fanuc-mill
    /// G51 X0. Y0. P2000
    /// G1 X10. F100.
    /// M30
    /// ```
    /// ## Not reported
    /// ```nc,quiet,fanuc-mill
    /// G51 X0. Y0. P2000
    /// G1 X10. F100.
    /// G50
    /// M30
    /// ```
    rule "scaling-left-on" in "offsets" {
        summary: "scaling left on",
        severity: Warning,
        tier: Path,
        mends: OnRequest,
        since: "0.1.0",
        run: Run::Path {
            watch: Watch::BLOCKS.union(Watch::CUTS).union(Watch::ENDS),
            make: || Box::new(ScalingLeftOn::default()),
        },
    }
}

#[derive(Clone, Default, PartialEq)]
struct ScalingLeftOn {
    carried: Carried,
}

remembers!(ScalingLeftOn: carried);

impl PathRule for ScalingLeftOn {
    fn memory(&mut self) -> Remembers<'_> {
        Remembers::All(self)
    }

    fn concerns(&self, program: &Uses<'_>) -> bool {
        program.may(|effect| effect == Effect::ScalingOn)
    }

    fn block(&mut self, cx: &PathCx<'_>, report: &mut Report<'_>) {
        self.carried.block(cx);
        if cx.boundary() == Some(Boundary::ProgramEnd) && !self.carried.is_told {
            judge(cx, report);
        }
    }

    fn cut(&mut self, cx: &PathCx<'_>, _: &Event, report: &mut Report<'_>) {
        let mode = (Role::Scaling, Effect::ScalingOn, Effect::ScalingOff);
        if let Some(finding) = self.carried.cut(cx, &META, mode, "the scaling") {
            report.add(finding);
        }
    }

    fn ended(&mut self, cx: &PathCx<'_>, ending: Ending, report: &mut Report<'_>) {
        if cx.ends_at_tape_mark(ending) && !self.carried.is_told {
            judge(cx, report);
        }
    }
}

fn judge(cx: &PathCx<'_>, report: &mut Report<'_>) {
    let is_on = |effect| effect == Effect::ScalingOn;
    let Some(finding) = cx.left_at_end(&META, Role::Scaling, is_on, "scaling") else { return };
    let cancel = cx.cancel_of(Effect::ScalingOff).unwrap_or_default();
    report.add(
        finding
            .assuming("the end of the program keeps it, as the control's book leaves to a parameter")
            .help(format!("switch scaling off with `{cancel}` before the program ends"))
            .fix_if(cx.block_before(Some(&cancel))),
    );
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::check_rule;

    #[test]
    fn the_end_is_marked() {
        check_rule(
            &RULE,
            "fanuc-mill",
            "G51 X0. Y0. P2000\nG1 X10. F100.\nM30\n",
            &expect![[r#"
            3 | M30
              | ^^^ warning[scaling-left-on] scaling is still on at the end of the program (`G51`)
        "#]],
        );
    }

    #[test]
    fn the_first_cut_of_the_next_tool_is_marked() {
        check_rule(
            &RULE,
            "haas-mill",
            "T1 M6\nG51 X0. Y0. P2.\nG1 X1. F10.\nT2 M6\nG0 X2.\nG1 X1. F5.\nM30\n",
            &expect![[r#"
                6 | G1 X1. F5.
                  | ^^^^^^^^^^ warning[scaling-left-on] the tool cuts with the scaling of the tool before (`G51`)
            "#]],
        );
    }

    #[test]
    fn an_end_that_resets_it_is_silent() {
        check_rule(&RULE, "haas-mill", "G51 X0. Y0. P2.\nG1 X1. F10.\nM30\n", &expect![[""]]);
    }
}
