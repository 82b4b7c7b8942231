//! A return from a reference position that the program never went to.

use gcheck_controls::Effect;

use crate::declare::declare_rule;
use crate::{PathCx, PathRule, Remembers, Report, Run, Uses, Watch, remembers};

declare_rule! {
    /// The tool returns from the reference position (`G29`), and the program has not gone to it before (`G28`).
    ///
    /// ## Why it matters
    /// The way leads through the point that the last `G28` passed. Without one in the program it is a point of some
    /// program before, and the tool goes there at rapid.
    ///
    /// ## Reported
    /// ```nc,reported,haas-mill
    /// G90 G54 G0 X0. Y0.
    /// G29 X1.
    /// M30
    /// ```
    /// ## Not reported
    /// ```nc,quiet,haas-mill
    /// G90 G54 G0 X0. Y0.
    /// G28 G91 X0.
    /// G90 G29 X1.
    /// M30
    /// ```
    rule "reference-point-never-set" in "motion" {
        summary: "return by a reference point of another program",
        severity: Warning,
        tier: Path,
        since: "0.1.0",
        run: Run::Path { watch: Watch::BLOCKS, make: || Box::new(ReferencePointNeverSet { was_set: false }) },
    }
}

#[derive(Clone, PartialEq)]
struct ReferencePointNeverSet {
    /// Some block before went to the reference position.
    was_set: bool,
}

remembers!(ReferencePointNeverSet);

impl PathRule for ReferencePointNeverSet {
    fn memory(&mut self) -> Remembers<'_> {
        Remembers::All(self)
    }

    fn concerns(&self, program: &Uses<'_>) -> bool {
        program.may(returns)
    }

    fn block(&mut self, cx: &PathCx<'_>, report: &mut Report<'_>) {
        self.was_set |= cx.has_effect(|effect| matches!(effect, Effect::ReturnReference(_)));
        if !cx.has_effect(returns) || self.was_set || cx.is_called_only() || cx.is_after_unknown_program() {
            return;
        }
        let go = cx.name_of_effect(Effect::ReturnReference(1)).unwrap_or_default();
        report.add(
            cx.finding(
                &META,
                cx.effect_range(returns),
                format!("the tool returns by a point that the program did not set before (no `{go}`)"),
            )
            .label("goes through the point of some program before, at rapid")
            .help(format!("go to the reference position with `{go}` before this, or move there with `G0`")),
        );
    }
}

fn returns(effect: Effect) -> bool {
    effect == Effect::ReturnFromReference
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::check_rule;

    #[test]
    fn a_program_that_is_called_may_rest_on_its_caller() {
        check_rule(&RULE, "haas-mill", "G29 X1.\nM99\n", &expect![[""]]);
        check_rule(
            &RULE,
            "haas-mill",
            "G29 X1.\nM30\n",
            &expect![[r#"
            1 | G29 X1.
              | ^^^ warning[reference-point-never-set] the tool returns by a point that the program did not set before (no `G28`)
        "#]],
        );
    }
}
