//! A rapid move of a lathe out of a bore through its wall.

use gcheck_controls::Effect;
use gcheck_engine::{At, Event};
use gcheck_geometry::Mm;

use crate::declare::declare_rule;
use crate::facts::turned::{SLACK, Spot, Turned, UNDER, end};
use crate::facts::turning::{is_turned, shown_radius};
use crate::{MakeShared, PathCx, PathRule, Remembers, Report, Run, Uses, Watch, remembers};

declare_rule! {
    /// A tool of a lathe is in a bore that the program has turned, and moves outwards in X at rapid, to beyond the wall of
    /// the bore.
    ///
    /// A cut is that of a bore if a roughing cycle or a turning pass begins nearer to the centre, if the tool comes to it
    /// outwards and leaves it inwards, or if the comment at the tool change names a boring bar.
    ///
    /// ## Why it matters
    /// The boring bar is driven into the wall. Mostly the retract along Z is missing.
    ///
    /// ## Reported
    /// ```nc,reported,fanuc-lathe
    /// G21 G99 T0404
    /// G97 S900 M3
    /// G0 X18. Z2.
    /// G71 U1. R.5
    /// G71 P10 Q20 U-0.4 W0.1 F.2
    /// N10 G0 X40.
    /// G1 Z-35. F.1
    /// N20 X18.
    /// G70 P10 Q20
    /// G0 X35.
    /// Z-30.
    /// G0 X150.
    /// M30
    /// ```
    /// ## Not reported
    /// ```nc,quiet,fanuc-lathe
    /// G21 G99 T0404
    /// G97 S900 M3
    /// G0 X18. Z2.
    /// G71 U1. R.5
    /// G71 P10 Q20 U-0.4 W0.1 F.2
    /// N10 G0 X40.
    /// G1 Z-35. F.1
    /// N20 X18.
    /// G70 P10 Q20
    /// G0 X35.
    /// Z-30.
    /// G0 Z2.
    /// G0 X150.
    /// M30
    /// ```
    rule "rapid-through-bore-wall" in "motion" {
        summary: "rapid move of a lathe out of a bore through its wall",
        severity: Warning,
        tier: Path,
        since: "0.1.0",
        run: Run::Path {
            watch: Watch::RAPIDS,
            make: || Box::new(RapidThroughBoreWall::default()),
        },
    }
}

#[derive(Default, Clone, PartialEq)]
struct RapidThroughBoreWall {
    /// The move that was reported.
    told: Option<At>,
}

remembers!(RapidThroughBoreWall: told);

impl PathRule for RapidThroughBoreWall {
    fn memory(&mut self) -> Remembers<'_> {
        Remembers::All(self)
    }

    fn shares(&self) -> Option<MakeShared> {
        Some(Turned::shared)
    }

    fn concerns(&self, program: &Uses<'_>) -> bool {
        is_turned(program)
    }

    fn rapid(&mut self, cx: &PathCx<'_>, event: &Event, report: &mut Report<'_>) {
        let Some(turned) = Turned::of(cx) else { return };
        if let (Event::Travel(travel), Some(here)) = (event, turned.here())
            && (!travel.expanded || cx.has_effect(Effect::goes_to_machine_place))
            && turned.knows(cx)
            && self.told != Some(cx.origin().at)
        {
            self.judge(cx, turned, here, end(cx, travel), report);
        }
    }
}

impl RapidThroughBoreWall {
    fn judge(&mut self, cx: &PathCx<'_>, turned: &Turned, from: Spot, to: Spot, report: &mut Report<'_>) {
        if from[0] < SLACK || from[1] > -UNDER {
            return;
        }
        let Some((wall, cut)) = turned.bore(from[1]) else { return };
        let is_through = if to[0].is_nan() {
            cx.has_effect(Effect::goes_to_machine_place)
        } else {
            // On a slant the tool may be out of the bore before it is as wide.
            let rise = if to[1].is_nan() { 0.0 } else { to[1] - from[1] };
            let at_wall = from[1] + (wall - from[0]) / (to[0] - from[0]) * rise;
            to[0] > wall + UNDER && at_wall < -UNDER
        };
        if !is_through || from[0] > wall + SLACK || turned.is_open_across(from[1], wall, UNDER) {
            return;
        }
        self.told = Some(cx.origin().at);
        let shown = |radius: f64| shown_radius(cx, radius);
        let finding = cx
            .finding(&META, cx.range(), "rapid move out of a bore, through its wall")
            .label(format!("outwards at Z {}, from inside the bore", cx.shown(Mm(from[1]))))
            .also(cut.bytes.clone(), format!("the bore is turned to X {} here", shown(wall)))
            .assuming("the bore is not wider there before the program starts")
            .help("retract along Z first, in a block of its own (`G0 Z…`)");
        report.add(finding);
    }
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::check_rule;

    fn bored(comment: &str, way: &str) -> String {
        format!(
            "G21 G99 G40\nT0404 {comment}\nG97 S900 M3\nG0 X20. Z2.\nX40.\nG1 Z-30. F.1\n{way}\nG0 Z100.\nM30\n"
        )
    }

    #[test]
    fn a_boring_bar_that_does_not_retract() {
        check_rule(
            &RULE,
            "fanuc-lathe",
            &bored("(BORING BAR)", "G0 X150."),
            &expect![[r#"
            7 | G0 X150.
              | ^^^^^^^^ warning[rapid-through-bore-wall] rapid move out of a bore, through its wall
        "#]],
        );
        check_rule(
            &RULE,
            "fanuc-lathe",
            &bored("(BORING BAR)", "G28 U0"),
            &expect![[r#"
            7 | G28 U0
              | ^^^^^^ warning[rapid-through-bore-wall] rapid move out of a bore, through its wall
        "#]],
        );
        check_rule(&RULE, "fanuc-lathe", &bored("(BORING BAR)", "G0 X38.\nG0 Z2.\nX150."), &expect![[""]]);
        // It may be a shoulder.
        check_rule(&RULE, "fanuc-lathe", &bored("", "G0 X150."), &expect![[""]]);
    }

    #[test]
    fn come_to_outwards_and_left_inwards_is_a_bore() {
        check_rule(
            &RULE,
            "haas-lathe",
            &bored("", "X38.\nG0 Z2.\nX36.\nZ-20.\nX60."),
            &expect![[r#"
            11 | X60.
               | ^^^^ warning[rapid-through-bore-wall] rapid move out of a bore, through its wall
        "#]],
        );
    }

    #[test]
    fn a_tool_that_cuts_in_from_outside_goes_out_there() {
        let parted = bored("(BORING BAR)", "G0 X38.\nG0 Z100.\nT0606\nG0 X60. Z-25.\nG1 X39. F.05\nG0 X60.");
        check_rule(&RULE, "fanuc-lathe", &parted, &expect![[""]]);
    }

    #[test]
    fn a_slant_out_of_the_face_is_free() {
        check_rule(&RULE, "fanuc-lathe", &bored("(BORING BAR)", "G0 X39.\nZ-2.\nX60. Z60."), &expect![[""]]);
    }
}
