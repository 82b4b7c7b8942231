//! A lathe that drills beside the centre of its turning part.

use gcheck_controls::{Effect, Machine};
use gcheck_engine::{Axis, Event, Spindle, TravelKind, Truth};
use gcheck_geometry::Mm;

use crate::declare::declare_rule;
use crate::facts::cycles::{cycle_name, is_drilling};
use crate::facts::live_tool::may_be_live;
use crate::{PathCx, PathRule, Report, Run, Uses, Watch};

declare_rule! {
    /// A drilling or tapping cycle of a lathe goes along Z beside the centre, while the part turns and no live tool does.
    ///
    /// A tool that works with the C axis, or after an M code of the machine builder, may be a live one: it is not judged.
    ///
    /// ## Why it matters
    /// A drill that does not turn cuts on the centre of a turning part only. Beside it the part runs against the flank
    /// of the drill, and the drill breaks: often the X of a turning tool was copied.
    ///
    /// ## Reported
    /// ```nc,reported,haas-lathe
    /// T0303
    /// G97 S900 M3
    /// G0 G54 X2.1 Z0.2
    /// G83 Z-1.9 R0.1 Q0.25 F0.008
    /// G80
    /// M30
    /// ```
    /// ## Not reported
    /// ```nc,quiet,haas-lathe
    /// T0303
    /// G97 S900 M3
    /// G0 G54 X0. Z0.2
    /// G83 Z-1.9 R0.1 Q0.25 F0.008
    /// G80
    /// M30
    /// ```
    rule "drilled-beside-the-centre" in "cycles" {
        summary: "drilling cycle beside the centre of a turning part",
        severity: Warning,
        tier: Path,
        since: "0.1.0",
        run: Run::Path { watch: Watch::CUTS, make: || Box::new(DrilledBesideTheCentre) },
    }
}

struct DrilledBesideTheCentre;

/// Millimetres: a correction of the centre is less.
const OFF_CENTRE: f64 = 1.0;

impl PathRule for DrilledBesideTheCentre {
    fn concerns(&self, program: &Uses<'_>) -> bool {
        program.environment.control().machine() == Machine::Lathe && program.may(drills)
    }

    fn cut(&mut self, cx: &PathCx<'_>, event: &Event, report: &mut Report<'_>) {
        let Event::Travel(travel) = event else { return };
        let cycle = cx.state().active_cycle(cx.model).filter(|code| code.is_some() && travel.expanded);
        if travel.kind != TravelKind::Feed || !cycle.is_some_and(|code| drills(cx.model.effect(code))) {
            return;
        }
        let turns = cx.state().spindle().is_some_and(Spindle::turns);
        let (from, to) = (&travel.from, &travel.to);
        let goes_along = (from.raw(Axis::X) - to.raw(Axis::X)).abs() < f64::EPSILON
            && (from.raw(Axis::Z) - to.raw(Axis::Z)).abs() > f64::EPSILON;
        // A place that is not known is NaN, and not beside anything.
        let is_beside = to.raw(Axis::X).abs() > OFF_CENTRE;
        let may_turn = cx.state().live_tool() != Truth::False;
        if !turns || may_turn || !goes_along || !is_beside || may_be_live(cx) {
            return;
        }
        let away = cx.shown(Mm(to.raw(Axis::X).abs()));
        report.add(
            cx.finding(
                &META,
                cx.range(),
                format!("`{}` drills beside the centre of the turning part", cycle_name(cx)),
            )
            .label(format!("{away} beside the centre"))
            .note("the spindle turns the part, and no live tool is on")
            .help("give `X0.` before the cycle, or start the live tool"),
        );
    }
}

fn drills(effect: Effect) -> bool {
    is_drilling(effect) || matches!(effect, Effect::CycleTap | Effect::CycleLeftTap)
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::check_rule;

    fn program(start: &str, x: &str) -> String {
        format!("G21\nT0303\n{start}\nG0 G54 {x} Z5.\nG83 Z-30. R2. Q5. F0.1\nG80\nM30\n")
    }

    #[test]
    fn a_turning_part_is_drilled_at_its_centre() {
        check_rule(
            &RULE,
            "haas-lathe",
            &program("G97 S900 M3", "X40."),
            &expect![[r#"
                5 | G83 Z-30. R2. Q5. F0.1
                  | ^^^^^^^^^^^^^^^^^^^^^^ warning[drilled-beside-the-centre] `G83` drills beside the centre of the turning part
            "#]],
        );
        check_rule(&RULE, "haas-lathe", &program("G97 S900 M3", "X0."), &expect![[""]]);
        check_rule(&RULE, "haas-lathe", &program("G97 S900 M3", "X#500"), &expect![[""]]);
    }

    #[test]
    fn a_live_tool_drills_anywhere() {
        check_rule(&RULE, "haas-lathe", &program("M154\nG97 P900 M133", "X40."), &expect![[""]]);
        check_rule(&RULE, "haas-lathe", &program("M5", "X40."), &expect![[""]]);
        for start in ["M13 S1500", "G97 S1500 M3\nM45", "G97 S1500 M3\nG0 C0."] {
            check_rule(&RULE, "fanuc-lathe", &program(start, "X40."), &expect![[""]]);
        }
        check_rule(
            &RULE,
            "fanuc-lathe",
            &program("M45\nT0404\nG97 S900 M3", "X40."),
            &expect![[r#"
            7 | G83 Z-30. R2. Q5. F0.1
              | ^^^^^^^^^^^^^^^^^^^^^^ warning[drilled-beside-the-centre] `G83` drills beside the centre of the turning part
        "#]],
        );
        let indexed = program("G97 S900 M3", "X40.").replace("Z-30.", "Z-30. H30.");
        check_rule(&RULE, "fanuc-lathe", &indexed, &expect![[""]]);
    }
}
