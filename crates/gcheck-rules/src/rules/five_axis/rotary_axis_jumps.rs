//! A rotary axis that turns far in one block at feed.

use gcheck_controls::{Effect, Letter};
use gcheck_engine::{Axis, Event, Fact, Role, Travel, TravelKind};
use gcheck_geometry::Mm;

use crate::declare::declare_rule;
use crate::facts::reach;
use crate::{Finding, PathCx, PathRule, Report, Run, Uses, Watch};
use crate::{Remembers, remembers};

declare_rule! {
    /// One block at feed turns a rotary axis much further than the path needs.
    ///
    /// * While the tip of the tool follows the path (`G43.4`, `G234`): by 120 degrees or more. A change of that size is a
    ///   solution with other angles for nearly the same direction of the tool.
    /// * While the tip follows the path and the tool is within one degree of parallel to the axis that turns: by 20 degrees or
    ///   more for each millimetre. There a small change of direction turns the axis far. One stretch of such moves is reported
    ///   once.
    /// * Without that mode, in the work of a tool that turns two rotary axes while linear ones move: by more than half a turn,
    ///   where the same direction is a short way off and the moves before turned as little as that. The angle went over a full
    ///   turn, and the axis goes all the way back.
    ///
    /// A fourth axis that turns alone may turn as far as it likes: wrapped work and spirals do.
    ///
    /// ## Why it matters
    /// The tip stays on the path, so that the linear axes swing around the part at full speed, or the control slows down to what
    /// the rotary axis can do and the cut dwells in one place. Without tip control the axis drags the tool around the part. Head,
    /// holder or table may hit the part or a fixture.
    ///
    /// ## Reported
    /// ```nc,reported,fanuc-mill
    /// G21 G90 G94
    /// G43.4 H1
    /// G0 X0. Y0. Z10. B10. C5.
    /// G1 X1. B1. C5. F500.
    /// G1 X2. B-.5 C-175.
    /// M30
    /// ```
    /// ```nc,reported,haas-mill
    /// G21 G90
    /// G0 X0. Y0. Z10. B0. C0.
    /// G93 G1 X10. B20. C10. F20.
    /// G1 X20. B30. C20. F20.
    /// G1 X30. B-310. C20. F20.
    /// M30
    /// ```
    /// ## Not reported
    /// ```nc,quiet,fanuc-mill
    /// G21 G90 G94
    /// G43.4 H1
    /// G0 X0. Y0. Z10. B10. C5.
    /// G1 X1. B1. C5. F500.
    /// G1 X2. B2. C15.
    /// M30
    /// ```
    /// A spiral around the fourth axis:
    /// ```nc,quiet,haas-mill
    /// G21 G90 G94
    /// G0 X0. Y0. Z10. A0.
    /// G1 X1. A10. F500.
    /// G1 X50. A3600.
    /// G1 X51. A3610.
    /// M30
    /// ```
    rule "rotary-axis-jumps" in "five_axis" {
        summary: "a rotary axis turns far in one block at feed",
        severity: Warning,
        tier: Path,
        since: "0.1.0",
        run: Run::Path {
            watch: Watch::MOVES.union(Watch::CHANGES),
            make: || Box::new(RotaryAxisJumps::default()),
        },
    }
}

/// Degrees in one block under tip control.
const FAR: f64 = 120.0;
/// Degrees for each millimetre of the tip's way.
const STEEP: f64 = 20.0;
/// Degrees in one block that are too few to matter near a pole.
const SLIGHT: f64 = 1.0;
/// Degrees between tool and axis.
const POLE: f64 = 1.0;
/// A turn that is so much further than those before is none of theirs.
const JUMP: f64 = 6.0;
/// Turns of an axis that are kept.
const KEPT: usize = 4;

const ROTARY: [Axis; 3] = [Axis::A, Axis::B, Axis::C];

#[derive(Default, Clone, PartialEq)]
struct RotaryAxisJumps {
    /// By rotary axis: how far it turned in the last moves at feed that turned it, the last one first.
    turns: [[Option<f64>; KEPT]; 3],
    /// A move of this tool turned two rotary axes while linear ones moved.
    is_five_axis: bool,
    /// The last move was near a pole, and steep.
    at_pole: bool,
}

remembers!(RotaryAxisJumps);

impl PathRule for RotaryAxisJumps {
    fn memory(&mut self) -> Remembers<'_> {
        Remembers::All(self)
    }

    fn concerns(&self, program: &Uses<'_>) -> bool {
        let letters = program.file_index.letters;
        let named = "ABC".chars().filter(|axis| letters.contains(Letter::of(*axis))).count();
        named >= 2 || program.may(|effect| effect == Effect::ToolCentrePoint)
    }

    fn changed(&mut self, _: &PathCx<'_>, event: &Event, _: &mut Report<'_>) {
        if matches!(event, Event::ToolChange(_)) {
            *self = Self::default();
        }
    }

    fn moved(&mut self, cx: &PathCx<'_>, event: &Event, report: &mut Report<'_>) {
        let Event::Travel(travel) = event else { return };
        if travel.kind != TravelKind::Feed || travel.expanded || reach::is_on_the_face(cx) {
            self.at_pole = false;
            return;
        }
        let turns = ROTARY.map(|axis| Some(travel.to.get(axis)? - travel.from.get(axis)?));
        let found = match cx.state().effect(Role::Length, cx.model) {
            Some(Effect::ToolCentrePoint) => far(cx, &turns).or_else(|| self.near_pole(cx, travel, &turns)),
            Some(_) => self.back_around(cx, travel, &turns),
            None => None,
        };
        if let Some(finding) = found {
            report.add(finding);
        }
        self.keep(travel, &turns);
    }
}

/// How far each rotary axis turns, where that is known.
type Turns = [Option<f64>; 3];

/// The axis that turns furthest, with its degrees.
fn furthest(turns: &Turns) -> Option<(Axis, f64)> {
    let known = ROTARY.into_iter().zip(turns).filter_map(|(axis, turn)| Some((axis, turn.as_ref()?.abs())));
    known.max_by(|a, b| a.1.total_cmp(&b.1))
}

fn far(cx: &PathCx<'_>, turns: &Turns) -> Option<Finding> {
    let (axis, degrees) = furthest(turns).filter(|(_, by)| *by >= FAR)?;
    let finding = cx
        .finding(
            &META,
            cx.range(),
            format!("{} turns {degrees:.0} degrees in one block at feed", axis.name()),
        )
        .label(format!("the tip stays on the path while {} turns", axis.name()))
        .help("retract before the axis turns, or have the CAM system avoid the change of solution");
    Some(resting_on_tip(cx, finding))
}

fn resting_on_tip(cx: &PathCx<'_>, finding: Finding) -> Finding {
    let name = cx.code_name(Role::Length).unwrap_or_default();
    cx.resting_on(finding, Fact::Mode(Role::Length), &format!("`{name}`"))
}

/// Is the tool parallel to the turning axis, within a degree, with the other one at this angle?
fn is_pole(turning: Axis, other: Axis, angle: f64) -> bool {
    let upright = match (turning, other) {
        (Axis::C, _) => angle,
        (Axis::A, Axis::B) | (Axis::B, Axis::A) => angle - 90.0,
        _ => return false,
    };
    let off = upright.rem_euclid(180.0);
    off.min(180.0 - off) <= POLE
}

/// Does a straight move also move linear axes?
fn moves_linear(travel: &Travel) -> bool {
    reach::length(&travel.from, &travel.to).is_some() && !reach::only_turns(&travel.from, &travel.to)
}

impl RotaryAxisJumps {
    fn near_pole(&mut self, cx: &PathCx<'_>, travel: &Travel, turns: &Turns) -> Option<Finding> {
        let was_at_pole = std::mem::take(&mut self.at_pole);
        let (axis, degrees) = furthest(turns)?;
        let mut others = ROTARY.into_iter().filter(|other| {
            *other != axis
                && [&travel.from, &travel.to]
                    .iter()
                    .all(|place| place.get(*other).is_some_and(|angle| is_pole(axis, *other, angle)))
        });
        let other = others.next()?;
        let length = reach::length(&travel.from, &travel.to).filter(|_| moves_linear(travel))?;
        if degrees < STEEP * length || degrees < SLIGHT {
            return None;
        }
        self.at_pole = true;
        if was_at_pole {
            return None;
        }
        let (name, angle) = (axis.name(), travel.to.get(other)?);
        let mut finding = cx
            .finding(
                &META,
                cx.range(),
                format!("{name} turns {degrees:.0} degrees within {} of the path", cx.shown(Mm(length))),
            )
            .label(format!("at {} {angle:.2}° the tool is nearly parallel to the axis of {name}", other.name()))
            .help("tilt the part or the tool by a few degrees more, or have the CAM system keep away from the pole");
        let machine = &cx.environment.machine.engine;
        if let (Some(rate), Some(minutes)) =
            (reach::rate(machine, axis), reach::minutes(cx, &travel.from, &travel.to))
            && degrees / minutes > rate
        {
            finding = finding.note(format!(
                "the feed asks {name} for {:.0} deg/min, and it turns {rate:.0} deg/min at most: the cut slows down here",
                degrees / minutes
            ));
        }
        Some(resting_on_tip(cx, finding))
    }

    /// Without tip control: all the way back after a full turn.
    fn back_around(&self, cx: &PathCx<'_>, travel: &Travel, turns: &Turns) -> Option<Finding> {
        if !self.is_five_axis || !moves_linear(travel) {
            return None;
        }
        let all = ROTARY.into_iter().zip(turns).zip(&self.turns);
        let mut jumps = all.filter_map(|((axis, turn), before)| {
            let turn = turn.as_ref()?.abs();
            let usual = before.iter().flatten().fold(0.0_f64, |most, turn| most.max(turn.abs()));
            let short = (360.0 - turn).abs();
            // Between 0 and 360 degrees the control may keep the angle within a turn, and go the short way.
            let is_within_turn =
                [&travel.from, &travel.to].iter().all(|at| (0.0..=360.0).contains(&at.raw(axis)));
            let is_jump = turn > 180.0 && usual > 0.0 && turn > JUMP * usual && short <= usual * 2.0;
            (is_jump && !is_within_turn).then_some((axis, turn, short))
        });
        let (axis, degrees, short) = jumps.next()?;
        let name = axis.name();
        Some(
            cx.finding(&META, cx.range(), format!("{name} turns {degrees:.0} degrees in one block at feed"))
                .label(format!("the tool cuts while {name} goes nearly a full turn"))
                .note(format!("the same direction is {short:.0} degrees away, and the moves before turn {name} no further"))
                .assuming(format!("{name} goes as far as its word says, not the short way"))
                .help(format!("let the angle of {name} go on beyond a full turn, or retract and turn it back at rapid")),
        )
    }

    fn keep(&mut self, travel: &Travel, turns: &Turns) {
        let moves = |turn: &Option<f64>| turn.is_some_and(|turn| turn.abs() > 1e-6);
        self.is_five_axis |= moves_linear(travel) && turns.iter().filter(|turn| moves(turn)).count() >= 2;
        for (kept, turn) in self.turns.iter_mut().zip(turns) {
            if moves(turn) {
                kept.rotate_right(1);
                if let Some(last) = kept.first_mut() {
                    *last = *turn;
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::check_rule;

    #[test]
    fn turning_at_rapid_or_without_the_mode_is_meant() {
        check_rule(
            &RULE,
            "fanuc-mill",
            "G21 G90 G94\nG1 X0. C0. F100.\nC170.\nG43.4 H1\nG0 X0. Y0. Z10. B0. C0.\nC180.\nM30\n",
            &expect![""],
        );
    }

    #[test]
    fn each_jump_is_told() {
        check_rule(
            &RULE,
            "haas-mill",
            "G20 G90 G94\nG234 H1 X0. Y0. Z1. B0. C0.\nG1 X1. B5. C10. F50.\nX2. C200.\nX3. C10.\nM30\n",
            &expect![[r#"
                4 | X2. C200.
                  | ^^^^^^^^^ warning[rotary-axis-jumps] C turns 190 degrees in one block at feed
                5 | X3. C10.
                  | ^^^^^^^^ warning[rotary-axis-jumps] C turns 190 degrees in one block at feed
            "#]],
        );
    }

    #[test]
    fn near_the_pole_a_stretch_is_told_once() {
        check_rule(
            &RULE,
            "haas-mill",
            "G21 G90 G94\nG234 H1 X0. Y0. Z1. B1. C0.\nG1 X10. F1000.\nX11. B.05\nX11.5 B.02 C45.\nX12. B.05 C100.\nX13. B45. C119.\nX14. B0. C120.\nX14.1 C100.\nM30\n",
            &expect![[r#"
                5 | X11.5 B.02 C45.
                  | ^^^^^^^^^^^^^^^ warning[rotary-axis-jumps] C turns 45 degrees within 0.5 mm of the path
                9 | X14.1 C100.
                  | ^^^^^^^^^^^ warning[rotary-axis-jumps] C turns 20 degrees within 0.1 mm of the path
            "#]],
        );
    }

    #[test]
    fn a_tilted_tool_may_turn() {
        check_rule(
            &RULE,
            "haas-mill",
            "G21 G90 G94\nG234 H1 X0. Y0. Z1. B30. C0.\nG1 X.5 C45. F1000.\nX1. C90.\nM30\n",
            &expect![""],
        );
    }

    #[test]
    fn without_tip_control_the_neighbours_tell() {
        let jump = "G21 G90 G93 G0 X0. Y0. Z10. B0. C0.\nG1 X10. B20. C10. F9.\nX20. B-330. C20. F9.\nX30. B-320. C20. F9.\nM30\n";
        check_rule(
            &RULE,
            "haas-mill",
            jump,
            &expect![[r#"
            3 | X20. B-330. C20. F9.
              | ^^^^^^^^^^^^^^^^^^^^ warning[rotary-axis-jumps] B turns 350 degrees in one block at feed
        "#]],
        );
        // Each block turns as far, or the control may keep the angle within a turn.
        for quiet in [
            "G21 G90 G93 G0 X0. Y0. Z10. B0. C0.\nG1 X10. B300. C10. F9.\nX20. B0. C20. F9.\nM30\n",
            "G21 G90 G93 G0 X0. Y0. Z10. B0. C340.\nG1 X10. B10. C350. F9.\nX20. B10. C0. F9.\nM30\n",
            "G21 G90 G93 G0 X0. Y0. Z10. B0. C0.\nG1 X10. B20. C10. F9.\nG0 Z90.\nG0 B-330.\nM30\n",
            "G21 G90 G93 G0 X0. Y0. Z10. B0. C0.\nG1 X10. B20. C10. F9.\nX20. C-3600. F9.\nM30\n",
        ] {
            check_rule(&RULE, "haas-mill", quiet, &expect![""]);
        }
    }
}
