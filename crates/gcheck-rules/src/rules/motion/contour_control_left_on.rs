//! Look-ahead on command that is still on when the tool is changed.

use gcheck_controls::Effect;
use gcheck_engine::{At, Event};

use crate::declare::declare_rule;
use crate::facts::boundary::{Boundary, boundary, boundary_range, is_before};
use crate::{PathCx, PathRule, Report, Run, Uses, Watch};
use crate::{Remembers, remembers};

declare_rule! {
    /// The contour control that the work of one tool switches on (`G5.1 Q1`, `G8 P1`) is still on when the next tool comes.
    ///
    /// A mode from before the first tool is meant for all of them, and the end of the program switches it off.
    ///
    /// ## Why it matters
    /// The control takes few codes while it looks ahead on command: canned cycles, and on some series length compensation, raise
    /// an alarm. The next tool also runs with the corners and accelerations that were meant for the one before.
    ///
    /// ## Reported
    /// ```nc,reported,fanuc-mill
    /// T1 M6
    /// G90 G54 G0 X0. Y0.
    /// G5.1 Q1
    /// G1 X10. F1000.
    /// T2 M6
    /// G0 X0.
    /// M30
    /// ```
    /// ## Not reported
    /// ```nc,quiet,fanuc-mill
    /// T1 M6
    /// G90 G54 G0 X0. Y0.
    /// G5.1 Q1
    /// G1 X10. F1000.
    /// G5.1 Q0
    /// T2 M6
    /// G0 X0.
    /// M30
    /// ```
    /// ```nc,quiet,fanuc-mill
    /// T1 M6
    /// G90 G54 G0 X0. Y0.
    /// G5.1 Q1
    /// G1 X10. F1000.
    /// M30
    /// ```
    rule "contour-control-left-on" in "motion" {
        summary: "contour control on at the tool change",
        severity: Info,
        tier: Path,
        fixable: OnRequest,
        since: "0.1.0",
        run: Run::Path {
            watch: Watch::BLOCKS.union(Watch::CHANGES),
            make: || Box::new(ContourControlLeftOn::default()),
        },
    }
}

#[derive(Default, Clone, PartialEq)]
struct ContourControlLeftOn {
    /// Where the first tool comes.
    first_tool: Option<At>,
    /// The block that switched it on, while it is on.
    on: Option<At>,
    /// It is the older look-ahead.
    is_look_ahead: bool,
}

remembers!(ContourControlLeftOn: first_tool, on);

impl PathRule for ContourControlLeftOn {
    fn memory(&mut self) -> Remembers<'_> {
        Remembers::All(self)
    }

    fn concerns(&self, program: &Uses<'_>) -> bool {
        program.may(|effect| matches!(effect, Effect::ContourControl | Effect::LookAheadControl))
    }

    fn changed(&mut self, cx: &PathCx<'_>, event: &Event, _: &mut Report<'_>) {
        match event {
            Event::ContourControl { on: true, .. } => {
                self.on = Some(cx.origin().at);
                self.is_look_ahead = cx.has_effect(|effect| effect == Effect::LookAheadControl);
            }
            Event::ContourControl { on: false, .. } | Event::End => self.on = None,
            _ => {}
        }
    }

    fn block(&mut self, cx: &PathCx<'_>, report: &mut Report<'_>) {
        if boundary(cx) != Some(Boundary::ToolChange) {
            return;
        }
        let Some(first) = self.first_tool else {
            self.first_tool = Some(cx.origin().at);
            return;
        };
        // A program that nobody has may have switched it off.
        let is_certain = cx.state().contour_control().is_some_and(|level| !level.is_nan());
        let Some(on) = self.on.filter(|on| is_before(first, *on)) else { return };
        self.on = None;
        if !is_certain {
            return;
        }
        let (effect, switch) =
            if self.is_look_ahead { (Effect::LookAheadControl, 'P') } else { (Effect::ContourControl, 'Q') };
        let Some(name) = cx.name_of_effect(effect) else { return };
        let cancel = format!("{name} {switch}0");
        let place = Boundary::ToolChange;
        let message = format!("contour control is still on {} (`{name} {switch}1`)", place.words());
        let mut finding = cx
            .finding(&META, boundary_range(cx, place), message)
            .label("the next tool begins with it")
            .help(format!("switch it off with `{cancel}` where the cut ends"))
            .fix_if(cx.block_before(Some(&cancel)));
        if let Some(range) = cx.range_of(on) {
            finding = finding.also(range, "switched on here");
        }
        report.add(finding);
    }
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::check_rule;

    #[test]
    fn once_for_each_time_it_is_switched_on() {
        check_rule(
            &RULE,
            "fanuc-mill",
            "T1 M6\nG8 P1\nG1 X10. F1000.\nT2 M6\nG1 X20.\nT3 M6\nG5.1 Q1 R2\nG1 X30.\nT4 M6\nM30\n",
            &expect![[r#"
                4 | T2 M6
                  |    ^^ info[contour-control-left-on] contour control is still on at the tool change (`G8 P1`)
                9 | T4 M6
                  |    ^^ info[contour-control-left-on] contour control is still on at the tool change (`G5.1 Q1`)
            "#]],
        );
    }

    #[test]
    fn what_a_program_that_is_not_here_does_to_it_is_not_known() {
        let program = |call: &str| {
            format!("T1 M6\nG90 G54 G0 X0. Y0.\nG5.1 Q1\nG1 X10. F1000.\n{call}\nT2 M6\nG0 X0.\nM30\n")
        };
        check_rule(&RULE, "fanuc-mill", &program("G65 P9010"), &expect![[""]]);
        check_rule(&RULE, "fanuc-mill", &program("M98 P4711"), &expect![[""]]);
    }

    #[test]
    fn from_the_head_it_is_meant_for_all_tools() {
        check_rule(
            &RULE,
            "fanuc-mill",
            "G5.1 Q1\nT1 M6\nG1 X10. F1000.\nT2 M6\nG1 X20.\nM30\n",
            &expect![[""]],
        );
    }
}
