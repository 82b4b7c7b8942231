//! A drill that turns counter-clockwise.

use gcheck_controls::{Effect, Letter, LetterSet};
use gcheck_engine::{At, Axis, Event, Travel, TravelKind};

use crate::declare::declare_rule;
use crate::facts::cutting::turns_backwards;
use crate::facts::cycles::drills_by_cycle;
use crate::facts::tool_comment::ToolComment;
use crate::facts::turned_backwards::{Called, TurnedBackwards, may_turn_backwards};
use crate::{PathCx, PathRule, Report, Run, Uses, Watch};
use crate::{Remembers, remembers};

declare_rule! {
    /// A drilling cycle, or a feed move straight down, while the spindle turns counter-clockwise (`M4`), with a tool that its
    /// comment calls a drill. A comment that names a left-hand drill is accepted (`LH`, `LEFT`).
    ///
    /// A deep drill that is fed backwards into its pilot hole, and started forward there before it drills on, is not reported.
    ///
    /// ## Why it matters
    /// A drill cuts only clockwise (`M3`). Turning backwards, it rubs, gets hot and breaks.
    ///
    /// ## Reported
    /// ```nc,reported,haas-mill
    /// T4 M6 (5.1 DRILL)
    /// G21 G90 G54 G0 X0. Y0.
    /// S2000 M4
    /// G43 H4 Z10.
    /// G81 Z-12. R2. F150.
    /// G80
    /// M30
    /// ```
    /// ## Not reported
    /// ```nc,quiet,haas-mill
    /// T4 M6 (5.1 DRILL LH)
    /// G21 G90 G54 G0 X0. Y0.
    /// S2000 M4
    /// G43 H4 Z10.
    /// G81 Z-12. R2. F150.
    /// G80
    /// M30
    /// ```
    rule "drill-turns-backwards" in "spindle" {
        summary: "drill that turns counter-clockwise",
        severity: Warning,
        tier: Path,
        since: "0.1.0",
        run: Run::Path { watch: Watch::CUTS, make: || Box::new(DrillTurnsBackwards::default()) },
    }
}

#[derive(Default, Clone, PartialEq)]
struct DrillTurnsBackwards {
    turned: TurnedBackwards,
}

remembers!(DrillTurnsBackwards: turned);

/// How its tool is called.
const CALLED: Called = Called { tool: "drill", in_short: "drill", cuts: "drills", named: "a drill" };

/// Millimetres: less is not a move.
const WAY: f64 = 0.01;

impl PathRule for DrillTurnsBackwards {
    fn memory(&mut self) -> Remembers<'_> {
        Remembers::All(self)
    }

    fn concerns(&self, program: &Uses<'_>) -> bool {
        may_turn_backwards(program)
    }

    fn cut(&mut self, cx: &PathCx<'_>, event: &Event, report: &mut Report<'_>) {
        let Event::Travel(travel) = event else { return };
        if drills(cx, travel)
            && (travel.expanded || !turns_forward_next(cx))
            && let Some(finding) = self.turned.judge(cx, &META, &CALLED, is_drill)
        {
            report.add(finding);
        }
    }
}

/// Is it a stroke of a drilling cycle, or a feed move straight down?
fn drills(cx: &PathCx<'_>, travel: &Travel) -> bool {
    if travel.expanded {
        return drills_by_cycle(cx);
    }
    let way = |axis: Axis| travel.to.raw(axis) - travel.from.raw(axis);
    travel.kind == TravelKind::Feed && way(Axis::X).hypot(way(Axis::Y)) < WAY && way(Axis::Z) < -WAY
}

/// Blocks after the move in which the spindle starts forward before the tool moves on.
const SOON: u32 = 4;

fn goes_out(effect: Effect) -> bool {
    matches!(effect, Effect::Rapid | Effect::MachineCoordinates | Effect::ReturnReference(_))
}

/// Does the spindle start forward before the tool moves again? A deep drill goes into its pilot hole backwards, so that its lips do
/// not catch.
fn turns_forward_next(cx: &PathCx<'_>) -> bool {
    let here = cx.origin().at;
    let mut is_forward = false;
    let shows = |block: u32| {
        let place = cx.place_of(At { block, ..here })?;
        let effects = || place.table.words(place.block()).iter().map(|word| cx.model.effect(word.code));
        is_forward |= effects().any(|effect| effect.starts_spindle() && !turns_backwards(effect));
        // Then it drills on; a tool that goes out has made its hole.
        let drills_on = place.block().letters.contains(Letter::of('Z')) && !effects().any(goes_out);
        place.block().letters.intersects(LetterSet::of("XYZT")).then_some(is_forward && drills_on)
    };
    (here.block + 1..=here.block.saturating_add(SOON)).find_map(shows) == Some(true)
}

fn is_drill(comment: &ToolComment) -> bool {
    comment.has(&["DRILL", "DRILLS", "DRILLING"]) && !comment.has(&["MILL"]) && !comment.is_left_hand()
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::{World, check_rule, findings, only, words};

    fn program(comment: &str, start: &str, cut: &str) -> String {
        format!(
            "T4 M6 ({comment})\nG21 G90 G54 G0 X0. Y0.\nS900 {start}\nG43 H4 Z5.\n{cut}\nG80\nG0 Z5.\nM30\n"
        )
    }

    #[test]
    fn straight_down_at_feed_too() {
        check_rule(
            &RULE,
            "fanuc-mill",
            &program("5.1 drill", "M4", "G1 Z-9. F90."),
            &expect![[r#"
            3 | S900 M4
              |      ^^ warning[drill-turns-backwards] the drill turns backwards (`M4`)
        "#]],
        );
        check_rule(&RULE, "fanuc-mill", &program("5.1 drill", "M3", "G1 Z-9. F90."), &expect![[""]]);
    }

    #[test]
    fn into_its_pilot_hole_a_deep_drill_goes_backwards() {
        let entry = "G1 Z-9. F300.\nS2500 M3\nG4 P500\nG1 Z-80. F90.";
        check_rule(&RULE, "haas-mill", &program("5.1 deep drill", "M4", entry), &expect![[""]]);
        let entry = "G1 Z-9. F300.\n(IN THE PILOT HOLE)\nM3 S2500 M8\nZ-80. F90.";
        check_rule(&RULE, "fanuc-mill", &program("5.1 deep drill", "M4", entry), &expect![[""]]);
        // The hole is made when the spindle turns forward.
        let out = program("5.1 drill", "M4", "G1 Z-19. F90.\nM3\nG0 Z5.");
        assert_eq!(
            crate::testing::findings(
                &crate::testing::only(&RULE),
                "haas-mill",
                &out,
                &crate::testing::World::default()
            )
            .len(),
            1
        );
        check_rule(
            &RULE,
            "haas-mill",
            &program("5.1 deep drill", "M4", "G1 Z-9. F300.\nZ-80. F90.\nM3"),
            &expect![[r#"
                3 | S900 M4
                  |      ^^ warning[drill-turns-backwards] the drill turns backwards (`M4`)
            "#]],
        );
    }

    #[test]
    fn tools_that_turn_so() {
        for comment in ["5.1 DRILL LEFT HAND", "5.1 L.H. DRILL", "DRILL MILL", "6 MM END MILL"] {
            check_rule(&RULE, "haas-mill", &program(comment, "M4", "G81 Z-9. R2. F90."), &expect![[""]]);
        }
        // A tap, and a boring bar.
        check_rule(&RULE, "haas-mill", &program("DRILL TAP", "M4", "G74 Z-9. R2. F90."), &expect![[""]]);
        check_rule(
            &RULE,
            "haas-mill",
            &program("BORE AFTER DRILL", "M4", "G86 Z-9. R2. F90."),
            &expect![[""]],
        );
    }

    #[test]
    fn the_list_at_the_head_names_the_drill() {
        let program = program("", "M4", "G81 Z-9. R2. F90.");
        check_rule(
            &RULE,
            "haas-mill",
            &format!("O1\n(T3 TAP)\n(T4 5.1 DRILL)\n{}", program.replace("()", "")),
            &expect![[r#"
                6 | S900 M4
                  |      ^^ warning[drill-turns-backwards] the drill turns backwards (`M4`)
            "#]],
        );
    }

    #[test]
    fn what_it_says() {
        let program = program("5.1 DRILL", "M4", "G83 Z-9. R2. Q3. F90.");
        let found = findings(&only(&RULE), "haas-mill", &program, &World::default());
        expect![[r#"
            the drill turns backwards (`M4`)
              here: counter-clockwise
              there: drills here
              there: names a drill
              help: start the spindle with `M3`, or name the drill left-hand (`LH`)
        "#]]
        .assert_eq(&found.iter().map(words).collect::<String>());
    }
}
