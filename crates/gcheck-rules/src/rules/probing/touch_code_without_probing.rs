//! A code for a touch without a probing move.

use gcheck_controls::Effect;
use gcheck_engine::Touch;

use crate::declare::declare_rule;
use crate::facts::probing::is_touch;
use crate::{Finding, PathCx, PathRule, Report, Run, Severity, Watch};

declare_rule! {
    /// A code keeps a touch (`M75`) or checks for one (`M78`, `M79`), and neither its block nor an earlier one probes;
    /// or `M75` is in a block that moves without probing.
    ///
    /// ## Why it matters
    /// The usual cause is `G1` instead of `G31`: the axes then move through the surface at feed, and no point is kept.
    ///
    /// ## Reported
    /// ```nc,reported,haas-mill
    /// G90 G54 G0 X0. Y5.
    /// G91 G1 Y-1. F10. M75
    /// G90
    /// M30
    /// ```
    /// ## Not reported
    /// ```nc,quiet,haas-mill
    /// G90 G54 G0 X0. Y5.
    /// G91 G31 Y-1. F10. M75
    /// G0 Y-8.
    /// G136 Y1. F10.
    /// M79
    /// G90
    /// M30
    /// ```
    rule "touch-code-without-probing" in "probing" {
        summary: "keeps or checks a touch where nothing probes",
        severity: Error,
        tier: Path,
        since: "0.1.0",
        run: Run::Path { watch: Watch::BLOCKS, make: || Box::new(TouchCodeWithoutProbing) },
    }
}

struct TouchCodeWithoutProbing;

impl PathRule for TouchCodeWithoutProbing {
    fn block(&mut self, cx: &PathCx<'_>, report: &mut Report<'_>) {
        let keeps = cx.has_effect(|effect| effect == Effect::KeepTouch);
        if !keeps && !cx.has_effect(asks) || cx.has_effect(is_touch) {
            return;
        }
        let moves = cx.names_axes();
        let nothing = cx.state().touched() == Touch::None && !cx.is_called_only();
        if keeps && moves {
            report.add(finding(
                cx,
                Effect::KeepTouch,
                "keeps a touch in a block that does not probe",
                "this move",
            ));
        } else if keeps && nothing {
            report.add(finding(cx, Effect::KeepTouch, "keeps a touch, but nothing was probed", "the move"));
        } else if nothing {
            let effect = if cx.has_effect(|effect| effect == Effect::AlarmIfTouched) {
                Effect::AlarmIfTouched
            } else {
                Effect::AlarmIfNotTouched
            };
            let finding = finding(cx, effect, "checks for a touch, but nothing was probed", "the move");
            report.add(finding.at_most(Severity::Warning));
        }
    }
}

fn asks(effect: Effect) -> bool {
    matches!(effect, Effect::AlarmIfTouched | Effect::AlarmIfNotTouched)
}

fn finding(cx: &PathCx<'_>, of: Effect, what: &str, which: &str) -> Finding {
    let name = cx.name_of_effect(of).unwrap_or_default();
    let skip = cx.name_of_effect(Effect::Skip).unwrap_or_default();
    cx.finding(&META, cx.effect_range(|effect| effect == of), format!("`{name}` {what}"))
        .label(format!("belongs on a block with `{skip}`"))
        .help(format!("make {which} a probing move: `{skip} … F… {name}`"))
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::check_rule;

    #[test]
    fn a_feed_move_touches_nothing() {
        check_rule(
            &RULE,
            "haas-mill",
            "G91 G31 X1. F10.\nG1 X1. F10. M75\nG90\nM30\n",
            &expect![[r#"
            2 | G1 X1. F10. M75
              |             ^^^ error[touch-code-without-probing] `M75` keeps a touch in a block that does not probe
        "#]],
        );
    }

    #[test]
    fn a_code_alone_speaks_of_the_probing_move_before_it() {
        check_rule(&RULE, "haas-mill", "G91 G31 X1. F10.\nM75\nM79\nG90\nM30\n", &expect![[""]]);
        check_rule(
            &RULE,
            "haas-mill",
            "M75\nM78\nM79\nM30\n",
            &expect![[r#"
            1 | M75
              | ^^^ error[touch-code-without-probing] `M75` keeps a touch, but nothing was probed
            2 | M78
              | ^^^ warning[touch-code-without-probing] `M78` checks for a touch, but nothing was probed
            3 | M79
              | ^^^ warning[touch-code-without-probing] `M79` checks for a touch, but nothing was probed
        "#]],
        );
    }

    #[test]
    fn a_caller_may_have_probed() {
        check_rule(&RULE, "haas-mill", "O9100\nM79\nM99\n", &expect![[""]]);
        check_rule(&RULE, "haas-mill", "G65 P9100\nM79\nM75\nM30\n", &expect![[""]]);
    }
}
