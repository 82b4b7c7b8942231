//! A grooving tool that moves along the part while it is in its groove.

use gcheck_engine::{At, Event, Fact, TravelKind};
use gcheck_geometry::Mm;

use crate::declare::declare_rule;
use crate::facts::tool_words::ToolWords;
use crate::facts::turned::{Spot, Turned, UNDER, end, is_level, is_one, is_other_part};
use crate::facts::turning::is_turned;
use crate::{MakeShared, PathCx, PathRule, Remembers, Report, Run, Uses, Watch, remembers};

declare_rule! {
    /// A tool of a lathe has plunged into a diameter that the program turned, and moves away along Z before it has left the
    /// groove: at rapid, or far out of the part at feed.
    ///
    /// ## Why it matters
    /// The blade is pushed sideways into the wall of the groove, and breaks. Mostly the block that draws it out in X is
    /// missing.
    ///
    /// ## Reported
    /// ```nc,reported,fanuc-lathe
    /// G21 G18 G99 T0101
    /// G97 S800 M3
    /// G0 X44. Z2.
    /// X38.
    /// G1 Z-60. F.2
    /// G0 X44.
    /// Z50.
    /// T0303
    /// G0 X42. Z-30.
    /// G1 X26. F.08
    /// G0 X100. Z50.
    /// M30
    /// ```
    /// ## Not reported
    /// ```nc,quiet,fanuc-lathe
    /// G21 G18 G99 T0101
    /// G97 S800 M3
    /// G0 X50. Z2.
    /// X38.
    /// G1 Z-60. F.2
    /// G0 X60. Z50.
    /// T0303
    /// G0 X42. Z-30.
    /// G1 X26. F.08
    /// G0 X42.
    /// X100. Z50.
    /// M30
    /// ```
    rule "groove-left-sideways" in "motion" {
        summary: "tool moves away along Z while it is in its groove",
        severity: Warning,
        tier: Path,
        since: "0.1.0",
        run: Run::Path {
            watch: Watch::MOVES.union(Watch::CHANGES),
            make: || Box::new(GrooveLeftSideways::default()),
        },
    }
}

#[derive(Default, Clone, PartialEq)]
struct GrooveLeftSideways {
    groove: Option<Groove>,
}

remembers!(GrooveLeftSideways: groove);

/// A plunge that the tool has not left.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Groove {
    tool: Option<At>,
    /// The radius at which the first plunge began: millimetres.
    top: f64,
    bottom: Spot,
    at: At,
}

remembers!(Groove: tool, at);

/// The wall of a groove is at least as thick: millimetres.
const WALL: f64 = 3.0;
/// So far outside of the part no tool is fed to cut: millimetres, of the radius.
const AWAY: f64 = 20.0;
/// A way along Z that a groove leaves to its tool: millimetres.
const PLAY: f64 = 0.5;

impl PathRule for GrooveLeftSideways {
    fn memory(&mut self) -> Remembers<'_> {
        Remembers::All(self)
    }

    fn shares(&self) -> Option<MakeShared> {
        Some(Turned::shared)
    }

    fn concerns(&self, program: &Uses<'_>) -> bool {
        is_turned(program)
    }

    fn changed(&mut self, cx: &PathCx<'_>, event: &Event, _: &mut Report<'_>) {
        if is_other_part(cx, event) {
            self.groove = None;
        }
    }

    fn moved(&mut self, cx: &PathCx<'_>, event: &Event, report: &mut Report<'_>) {
        let groove = self.groove.take();
        let Some(turned) = Turned::of(cx) else { return };
        if let (Event::Travel(travel), Some(from)) = (event, turned.here())
            && turned.knows(cx)
        {
            let to = end(cx, travel);
            let is_away = match travel.kind {
                TravelKind::Rapid => true,
                // Nearer to the part it may turn the wall.
                TravelKind::Feed => {
                    turned.outside_along(from[1]).is_some_and(|(wall, _)| to[0] > wall + AWAY)
                }
                _ => false,
            };
            if is_away && !travel.expanded {
                leave(cx, turned, groove, from, to, report);
            } else if travel.kind == TravelKind::Feed && !travel.expanded {
                let tool = cx.definitions().set_by(Fact::Tool);
                // A groove is made in several steps.
                let deeper = groove
                    .filter(|groove| groove.tool == tool && is_one(groove.bottom, from) && digs(from, to));
                let words = ToolWords::of(cx);
                // Only of a tool for grooves a plunge into what is not known is one.
                let is_unturned = words.grooves() && digs_unturned(turned, from, to);
                let begins = (turned.plunges(from, to) || is_unturned) && !words.bores();
                let new = begins.then(|| Groove { tool, top: from[0], bottom: to, at: cx.origin().at });
                self.groove = deeper.map(|groove| Groove { bottom: to, ..groove }).or(new);
            }
        }
    }
}

/// Does a cut go straight across, deeper?
fn digs(from: Spot, to: Spot) -> bool {
    is_level(from, to) && to[0] < from[0]
}

/// Does a cut go straight across, away from the face, into a part that this program has not turned there?
fn digs_unturned(turned: &Turned, from: Spot, to: Spot) -> bool {
    let is_unturned = [0.0, -WALL].iter().all(|way| turned.least_outside(to[1] + way).is_none());
    digs(from, to) && is_unturned && to[0] > UNDER && to[1] < -WALL && from[0] - to[0] > 2.0 * UNDER
}

fn leave(
    cx: &PathCx<'_>,
    turned: &Turned,
    groove: Option<Groove>,
    from: Spot,
    to: Spot,
    report: &mut Report<'_>,
) {
    let tool = cx.definitions().set_by(Fact::Tool);
    let Some(groove) = groove.filter(|groove| groove.tool == tool && is_one(groove.bottom, from)) else {
        return;
    };
    let along = to[1] - from[1];
    if along.is_nan() || along.abs() <= PLAY {
        return;
    }
    // A step in a face is short.
    let walls =
        [PLAY, WALL].map(|way| turned.outside_along(from[1] + way * along.signum()).map(|(wall, _)| wall));
    let (wall, is_turned) = match walls {
        [Some(wall), Some(beyond)] if from[0] <= beyond - UNDER => (wall, true),
        // Toward the chuck there is what the first plunge began above.
        [None, None] if along < -WALL => (groove.top - UNDER, false),
        _ => return,
    };
    let radius = from[0] + (to[0] - from[0]) * PLAY / along.abs();
    let is_open = |way: f64| {
        let left = turned.least_outside(from[1] + way * along.signum());
        left.is_some_and(|(left, _)| left < from[0] + UNDER)
    };
    if radius > wall - UNDER || is_open(PLAY) || is_open(WALL) {
        return;
    }
    let is_diameter = cx.state().is_diameter(cx.model) == Some(true);
    let wall = cx.shown(Mm(if is_diameter { wall * 2.0 } else { wall }));
    let mut finding = cx
        .finding(&META, cx.range(), "the tool moves along Z while it is in its groove")
        .label(if is_turned {
            format!("the part beside the groove is turned to X {wall}")
        } else {
            "nothing of this program has cut beside the groove".to_owned()
        });
    if let Some(range) = cx.range_of(groove.at) {
        finding = finding.also(range, "the tool plunges here");
    }
    report.add(finding.help("draw the tool out in X first, in a block of its own (`G0 X…`)"));
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::{Called, World, check_rule, check_rule_in};

    fn program(plunge: &str, out: &str) -> String {
        format!(
            "G21 G18 G99 T0101\nG97 S800 M3\nG0 X44. Z2.\nX38.\nG1 Z-60. F.2\nG0 X44.\nZ50.\nT0303\nG0 X42. Z-30.\n{plunge}\n{out}\nM30\n"
        )
    }

    #[test]
    fn from_groove_to_groove_in_a_part_that_is_turned_elsewhere() {
        let grooves = |out: &str| {
            format!(
                "G21 G18 G99 T0505 (3MM GROOVE)\nG97 S900 M3\nG0 X45. Z5.\nZ-10.\nX41.\nG1 X36. F.06\nX32.\nG4 U.3\n{out}G0 Z-18.\nX60.\nM30\n"
            )
        };
        check_rule(
            &RULE,
            "fanuc-lathe",
            &grooves(""),
            &expect![[r#"
            9 | G0 Z-18.
              | ^^^^^^^^ warning[groove-left-sideways] the tool moves along Z while it is in its groove
        "#]],
        );
        check_rule(&RULE, "fanuc-lathe", &grooves("G0 X41.\n"), &expect![[""]]);
        // Another tool may have come to its place at feed.
        check_rule(&RULE, "fanuc-lathe", &grooves("").replace("3MM GROOVE", "OD TURN"), &expect![[""]]);
        // Toward the front it may leave a shoulder.
        check_rule(&RULE, "fanuc-lathe", &grooves("").replace("Z-18.", "Z5."), &expect![[""]]);
    }

    #[test]
    fn a_dwell_at_the_bottom_draws_nothing_out() {
        check_rule(
            &RULE,
            "fanuc-lathe",
            &program("G1 X26. F.08\nG4 X.5", "G0 X100. Z50."),
            &expect![[r#"
                12 | G0 X100. Z50.
                   | ^^^^^^^^^^^^^ warning[groove-left-sideways] the tool moves along Z while it is in its groove
            "#]],
        );
        check_rule(&RULE, "fanuc-lathe", &program("G1 X26. F.08\nG0 X42.", "G0 X100. Z50."), &expect![[""]]);
    }

    #[test]
    fn the_way_home_at_feed() {
        check_rule(
            &RULE,
            "fanuc-lathe",
            &program("G1 X26. F.08", "X150. Z100."),
            &expect![[r#"
                11 | X150. Z100.
                   | ^^^^^^^^^^^ warning[groove-left-sideways] the tool moves along Z while it is in its groove
            "#]],
        );
        check_rule(&RULE, "fanuc-lathe", &program("G1 X26. F.08", "X40. Z-28."), &expect![[""]]);
    }

    #[test]
    fn a_way_out_of_a_bore_is_no_plunge() {
        let turned = "G21 G18 G99 T0101\nG97 S800 M3\nG0 X44. Z2.\nX40.\nG1 Z-30. F.2\nG0 X44.\nZ50.\n";
        let bored = "T0505 (DRILL 16)\nG0 X0. Z2.\nG1 Z-28. F.1\nG0 Z50.\nX100.\nT0202\nG0 X20. Z2.\nG1 Z-22. F.1\nX19.\nG0 Z50.\nM30\n";
        check_rule(&RULE, "fanuc-lathe", &format!("{turned}{bored}"), &expect![[""]]);
    }

    #[test]
    fn in_a_wide_groove_the_tool_may_move() {
        let wide = "G1 X26. F.08\nG0 X42.\nZ-32.5\nG1 X26. F.08\nG0 X42.\nZ-35.\nG1 X26. F.08";
        check_rule(&RULE, "fanuc-lathe", &program(wide, "G0 Z-34."), &expect![[""]]);
    }

    #[test]
    fn a_program_of_another_file_drew_it_out() {
        let retract = Called(9000, "O9000\nG0 X150.\nZ100.\nM99\n");
        let world = World { programs: &retract, ..World::default() };
        let program = program("G1 X26. F.08\nM98 P9000", "G0 Z50.");
        check_rule_in(&RULE, "fanuc-lathe", &program, &world, &expect![[""]]);
    }

    #[test]
    fn a_face_has_no_wall() {
        let facing = program("", "").replace("G0 X42. Z-30.\n", "G0 X42. Z0.\nG1 X-1. F.1\nG0 X50. Z5.");
        check_rule(&RULE, "fanuc-lathe", &facing, &expect![[""]]);
    }
}
