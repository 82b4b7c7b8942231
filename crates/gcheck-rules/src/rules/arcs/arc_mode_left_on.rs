//! A block that looks like a straight move while an arc mode is active.

use std::collections::BTreeSet;

use gcheck_controls::{Effect, LetterSet};
use gcheck_engine::{ArcFault, At, Fact, Fault, Role};

use crate::declare::declare_rule;
use crate::{PathCx, PathRule, Report, Run, Severity, Watch};
use crate::{Remembers, remembers};

declare_rule! {
    /// A block gives only an end point, while the motion mode is still an arc (`G2`, `G3`) from an earlier block.
    ///
    /// ## Why it matters
    /// A `G1` or `G0` is missing after the arc. The control stops with an alarm, or moves straight to the point,
    /// whatever was meant; on some controls a parameter decides.
    ///
    /// ## Reported
    /// ```nc,reported,haas-mill
    /// G17 G21 G90 G0 X0 Y0
    /// G2 X10. Y0 I5. F100.
    /// X20.
    /// M30
    /// ```
    /// ## Not reported
    /// ```nc,quiet,haas-mill
    /// G17 G21 G90 G0 X0 Y0
    /// G2 X10. Y0 I5. F100.
    /// X20. I5.
    /// G1 X30.
    /// M30
    /// ```
    rule "arc-mode-left-on" in "arcs" {
        summary: "end point alone while an arc mode is active",
        severity: Error,
        tier: Path,
        since: "0.1.0",
        run: Run::Path { watch: Watch::FAULTS, make: || Box::new(ArcModeLeftOn::default()) },
    }
}

#[derive(Default, Clone, PartialEq)]
struct ArcModeLeftOn {
    /// Blocks that chose the reported arcs: the first block without a centre stands for those after it.
    told: BTreeSet<Option<At>>,
}

remembers!(ArcModeLeftOn: told);

/// What the setting is about that lets a control go straight, and its value then.
const SETTING: (&str, &str) = ("arc without radius and centre", "straight line");

impl PathRule for ArcModeLeftOn {
    fn memory(&mut self) -> Remembers<'_> {
        Remembers::All(self)
    }

    fn fault(&mut self, cx: &PathCx<'_>, fault: &Fault, report: &mut Report<'_>) {
        if *fault != Fault::Arc(ArcFault::NoCentre) || cx.origin().letters.intersects(LetterSet::of("IJKR")) {
            return;
        }
        // In a block that names the arc itself a word is missing: other rules report that.
        if cx.has_effect(Effect::is_arc)
            || !cx.state().effect(Role::Motion, cx.model).is_some_and(Effect::is_arc)
        {
            return;
        }
        let Some(code) = cx.code_name(Role::Motion) else { return };
        let fact = Fact::Mode(Role::Motion);
        let setting = cx.control().settings().iter().find(|setting| setting.title == SETTING.0);
        let value =
            setting.and_then(|setting| cx.environment.setting(&setting.number)).map(|(value, _)| value);
        if value == Some(SETTING.1) || !self.told.insert(cx.definitions().set_by(fact)) {
            return;
        }
        let mut finding = cx
            .finding(&META, cx.range(), format!("end point alone while the motion mode is an arc (`{code}`)"))
            .label("neither centre nor radius")
            .help("write `G1` or `G0` if the move is straight, else give the centre or the radius");
        finding = match setting {
            // Programs rely on it where the control goes straight.
            Some(setting) if value.is_none() => finding
                .note(format!("setting {} decides: a straight line, or an alarm", setting.number))
                .at_most(Severity::Info),
            _ if cx.model.semantics().strict => finding,
            _ => finding.at_most(Severity::Warning),
        };
        report.add(cx.resting_on(finding, fact, &format!("`{code}`")));
    }
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::check_rule;

    #[test]
    fn the_first_block_is_marked() {
        check_rule(
            &RULE,
            "linuxcnc",
            "G17 G21 G90 G0 X0 Y0\nG2 X10 I5 F100\nX20\nY5\nG1 X0\nM2\n",
            &expect![[r#"
                3 | X20
                  | ^^^ error[arc-mode-left-on] end point alone while the motion mode is an arc (`G2`)
            "#]],
        );
    }

    #[test]
    fn an_arc_that_is_named_is_judged_by_another_rule() {
        check_rule(&RULE, "haas-mill", "G17 G90 G0 X0 Y0\nG2 X10. F10.\nM30\n", &expect![[""]]);
    }

    #[test]
    fn a_setting_may_let_the_control_go_straight() {
        let program = "G17 G21 G90 G0 X0. Y0.\nG2 X10. I5. F100.\nX20.\nM30\n";
        check_rule(
            &RULE,
            "fanuc-mill",
            program,
            &expect![[r#"
                3 | X20.
                  | ^^^^ info[arc-mode-left-on] end point alone while the motion mode is an arc (`G2`)
            "#]],
        );
    }

    #[test]
    fn codes_that_take_the_axes_for_themselves_move_no_arc() {
        check_rule(
            &RULE,
            "haas-mill",
            "G17 G90 G0 X0 Y0\nG2 X1. I.5 F10.\nG53 Z0\nG92 X0\nM30\n",
            &expect![[""]],
        );
    }
}
