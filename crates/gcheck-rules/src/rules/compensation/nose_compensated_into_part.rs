//! Compensation of a lathe tool's nose to the side on which the part is.

use gcheck_controls::Effect;
use gcheck_engine::{At, Event, Fact, Role, TravelKind};

use crate::declare::declare_rule;
use crate::facts::compensation::{is_left, is_on};
use crate::facts::tool_words::ToolWords;
use crate::facts::turned::{Side, Spot, Turned, UNDER, end};
use crate::facts::turning::{is_turned, profile, profile_blocks, turns_the_part};
use crate::{Finding, MakeShared, PathCx, PathRule, Remembers, Report, Run, Uses, Watch, remembers};

declare_rule! {
    /// On a lathe the outside of the part is turned toward the chuck with the nose compensated to the left (`G41`), or a bore
    /// with the nose compensated to the right (`G42`): to the side on which the part is.
    ///
    /// What is the outside shows by the side from which the tool or its cycle comes, and to which it leaves: a tool that is fed outward past
    /// all that it cut, and goes on from there outward or out of the part, is not in a bore. Of a profile it shows for
    /// `G71` and `G70` by its diameters.
    ///
    /// ## Why it matters
    /// The nose is shifted into the part by its radius, so tapers, radii and chamfers are cut too deep, by up to twice the
    /// error that compensation is there to remove. Mostly `G41` and `G42` are mixed up.
    ///
    /// ## Reported
    /// ```nc,reported,fanuc-lathe
    /// G21 G18 G99 G40 T0101
    /// G97 S800 M3
    /// G0 X44. Z2.
    /// G41 X38.
    /// G1 Z-30. F.2
    /// X44. Z-36.
    /// G40 G0 X100. Z50.
    /// M30
    /// ```
    /// ## Not reported
    /// ```nc,quiet,fanuc-lathe
    /// G21 G18 G99 G40 T0101
    /// G97 S800 M3
    /// G0 X44. Z2.
    /// G42 X38.
    /// G1 Z-30. F.2
    /// X44. Z-36.
    /// G40 G0 X100. Z50.
    /// M30
    /// ```
    rule "nose-compensated-into-part" in "compensation" {
        summary: "nose of a lathe tool compensated to the side of the part",
        severity: Warning,
        tier: Path,
        since: "0.1.0",
        run: Run::Path {
            watch: Watch::MOVES.union(Watch::BLOCKS),
            make: || Box::new(NoseCompensatedIntoPart::default()),
        },
    }
}

#[derive(Default, Clone, PartialEq)]
struct NoseCompensatedIntoPart {
    /// The block that switches on what was reported.
    told: Option<At>,
    /// A cut whose side the tool shows when it leaves.
    waiting: Option<Waiting>,
}

remembers!(NoseCompensatedIntoPart: told, waiting);

#[derive(Clone, PartialEq)]
struct Waiting {
    on: At,
    side: Side,
    /// The largest radius of the cut, in millimetres, and whether a later one was fed out past it: then it was not in the air.
    radius: f64,
    goes_past: bool,
    finding: Finding,
}

remembers!(Waiting: on, finding);

/// Diameters that differ by less are one, in the units of the program.
const SAME: f64 = 0.01;

impl PathRule for NoseCompensatedIntoPart {
    fn memory(&mut self) -> Remembers<'_> {
        Remembers::All(self)
    }

    fn shares(&self) -> Option<MakeShared> {
        Some(Turned::shared)
    }

    fn concerns(&self, program: &Uses<'_>) -> bool {
        is_turned(program) && program.may(is_on)
    }

    fn block(&mut self, cx: &PathCx<'_>, report: &mut Report<'_>) {
        if cx.has_effect(|effect| matches!(effect, Effect::RoughAlongZ | Effect::FinishProfile)) {
            self.judge_profile(cx, report);
        }
    }

    fn moved(&mut self, cx: &PathCx<'_>, event: &Event, report: &mut Report<'_>) {
        let Some(turned) = Turned::of(cx) else { return };
        let Event::Travel(travel) = event else { return };
        if travel.kind == TravelKind::Rapid {
            let to = end(cx, travel);
            let out = turned.here().map(|from| to[0] - from[0]);
            let is_clear = turned.here().is_some_and(|from| clears(from, to));
            self.leave(turned.leaves(out), is_clear, report);
            return;
        }
        if let Some(waiting) = &mut self.waiting {
            waiting.goes_past |= end(cx, travel)[0] > waiting.radius + UNDER;
        }
        let Some(is_left) = is_left(cx) else { return };
        let Some(on) = set_on(cx) else { return };
        let is_new = self.told != Some(on) && self.waiting.is_none();
        if travel.kind != TravelKind::Feed || !is_new || !turned.knows(cx) {
            return;
        }
        let Some(from) = turned.here() else { return };
        // The side is known of cuts toward the chuck alone.
        let side = turned.side_of(cx, [from, end(cx, travel)], travel.expanded);
        let to = end(cx, travel);
        let is_deep = from[1] - to[1] > UNDER && to[1] < -UNDER && from[0].min(to[0]) > UNDER;
        let may_be_outside =
            side == Side::Unknown && is_deep && !travel.expanded && !ToolWords::of(cx).may_bore();
        let is_wrong = matches!((side, is_left), (Side::Outside, true) | (Side::Inside, false))
            || may_be_outside && is_left;
        let Some(name) = cx.code_name(Role::Compensation).filter(|_| is_wrong) else { return };
        // A side that only the way out shows can be the outside alone.
        let shown = if side == Side::Unknown { Side::Outside } else { side };
        let Some(finding) = finding(cx, on, &name, shown) else { return };
        let finding = finding.also(cx.range(), "turned here, toward the chuck");
        if travel.expanded {
            // Where a cycle begins shows its side.
            self.told = Some(on);
            report.add(finding);
        } else {
            self.waiting = Some(Waiting { on, side, radius: from[0].max(to[0]), goes_past: false, finding });
        }
    }
}

/// Does a rapid move from where the cut ended go outward, or along Z out of the part? In a bore it would go through the wall.
fn clears(from: Spot, to: Spot) -> bool {
    to[0] > from[0] + UNDER || to[0] > from[0] - SAME && to[1] > UNDER
}

impl NoseCompensatedIntoPart {
    /// The tool leaves what it cut, to this side as far as that shows. A bore may be approached from outside as well.
    fn leave(&mut self, leaves: Side, is_clear: bool, report: &mut Report<'_>) {
        let Some(waiting) = self.waiting.take() else { return };
        let is_sure = match waiting.side {
            Side::Inside => leaves != Side::Outside,
            Side::Unknown => leaves == Side::Outside && is_clear && waiting.goes_past,
            Side::Outside => leaves == Side::Outside,
        };
        if is_sure {
            self.told = Some(waiting.on);
            report.add(waiting.finding);
        }
    }

    /// A profile that switches compensation on by itself: only its cycle moves along it.
    fn judge_profile(&mut self, cx: &PathCx<'_>, report: &mut Report<'_>) {
        let (Some((first, last)), Some(profile)) = (profile_blocks(cx), profile(cx)) else { return };
        let own = (first.block..=last.block).find_map(|block| {
            let at = At { block, ..first };
            let place = cx.place_of(at)?;
            let mut codes = place.table.words(place.block()).iter().map(|word| word.code);
            Some((at, codes.rfind(|code| is_on(cx.model.effect(*code)))?))
        });
        let Some((on, code)) = own.filter(|(on, _)| self.told != Some(*on)) else { return };
        let is_left =
            matches!(cx.model.effect(code), Effect::CompensationLeft | Effect::CompensationLeftByDiameter);
        // The tool begins where the cycle takes nothing off: outside of the largest diameter, or inside of the least.
        let begins = profile.start.x;
        let is_outside = profile.points.iter().all(|point| point.x < begins + SAME);
        let is_inside = profile.points.iter().all(|point| point.x > begins - SAME);
        let side = match profile.grows_to_chuck() {
            Some(true) if is_outside => Side::Outside,
            Some(false) if is_inside => Side::Inside,
            _ => return,
        };
        if (side == Side::Outside) != is_left || !cx.is_certain() || !turns_the_part(cx) {
            return;
        }
        let Some(finding) = finding(cx, on, &cx.name_of(code), side) else { return };
        self.told = Some(on);
        report.add(finding.also(cx.range(), "turned by this cycle"));
    }
}

/// The block that switches on the compensation in effect.
fn set_on(cx: &PathCx<'_>) -> Option<At> {
    cx.definitions().set_by(Fact::Mode(Role::Compensation))
}

/// That what a block switches on is the wrong one for a cut on this side.
fn finding(cx: &PathCx<'_>, on: At, name: &str, side: Side) -> Option<Finding> {
    let (what, right) = match side {
        Side::Outside => ("the outside of the part is", Effect::CompensationRight),
        Side::Inside => ("the bore is", Effect::CompensationLeft),
        Side::Unknown => return None,
    };
    let right = cx.name_of_effect(right)?;
    let word = cx.find_word(on, |word| is_on(cx.model.effect(word.code)));
    let range = word.or_else(|| cx.range_of(on))?;
    Some(
        cx.finding(&META, range, format!("the nose is compensated into the part (`{name}`)"))
            .label(format!("{what} on that side of the path"))
            .help(format!("check the code: turned this way it takes `{right}`")),
    )
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::check_rule;

    fn outside(on: &str) -> String {
        format!(
            "G21 G18 G99 G40 T0101\nG97 S800 M3\nG0 X44. Z2.\n{on} X38.\nG1 Z-30. F.2\nX44. Z-36.\nG40 G0 X100. Z50.\nM30\n"
        )
    }

    fn bore(on: &str) -> String {
        format!(
            "G21 G18 G99 G40 T0404 (BORING BAR)\nG97 S800 M3\nG0 X18. Z2.\n{on} X40.\nG1 Z-35. F.1\nX38. Z-36.\nG40 G0 X18.\nZ50.\nM30\n"
        )
    }

    #[test]
    fn mixed_up() {
        check_rule(
            &RULE,
            "fanuc-lathe",
            &outside("G41"),
            &expect![[r#"
            4 | G41 X38.
              | ^^^ warning[nose-compensated-into-part] the nose is compensated into the part (`G41`)
        "#]],
        );
        check_rule(
            &RULE,
            "fanuc-lathe",
            &bore("G42"),
            &expect![[r#"
            4 | G42 X40.
              | ^^^ warning[nose-compensated-into-part] the nose is compensated into the part (`G42`)
        "#]],
        );
    }

    #[test]
    fn as_it_should_be() {
        for program in [outside("G42"), bore("G41"), outside("G40")] {
            check_rule(&RULE, "fanuc-lathe", &program, &expect![[""]]);
        }
    }

    #[test]
    fn an_outside_that_only_the_way_out_shows() {
        let far = |on: &str, out: &str| {
            format!(
                "G21 G18 G99 G40 T0101\nG97 S800 M3\nG0 X60. Z2.\n{on} X30.\nG1 Z-20. F.2\nX40. Z-25.\n{out}\nG40 G0 X100. Z50.\nM30\n"
            )
        };
        check_rule(
            &RULE,
            "fanuc-lathe",
            &far("G41", "X50."),
            &expect![[r#"
            4 | G41 X30.
              | ^^^ warning[nose-compensated-into-part] the nose is compensated into the part (`G41`)
        "#]],
        );
        for program in [
            far("G42", "X50."),
            // Into a bore, and out of it: the retract comes first.
            far("G41", "X24.\nG0 Z5."),
            far("G41", "X50.").replace("T0101", "T0101 (BORING BAR)"),
            far("G41", "G0 Z5."),
            // Along Z in the air to a groove, whose wall is cut then.
            far("G41", "X60.").replace("X30.\nG1 Z-20. F.2\nX40. Z-25.", "G1 Z-20. F1.\nX40. F.1"),
        ] {
            check_rule(&RULE, "fanuc-lathe", &program, &expect![[""]]);
        }
    }

    #[test]
    fn a_bore_that_is_approached_from_outside() {
        for program in [
            "G21 G18 G99 G40\nT0404\nG97 S800 M3\nG0 X50. Z5.\nZ2.\nG41 G0 X44.\nG1 Z-20. F.1\nX30.\nG40 G0 X28.\nZ50.\nM30\n",
            "G20 G18 G99 G40 T0404\nG97 S800 M3\nG0 X2. Z.2\nG41 X1.75\nG1 Z-.8 F.005\nX1.25\nG40 G0 X1.2\nZ1.\nM30\n",
            // Straight out: which side it was does not show.
            "G20 G18 G99 G40 T0404\nG97 S800 M3\nG0 X2. Z.2\nG41 X1.75\nG1 Z-.8 F.005\nG40 G0 Z1.\nM30\n",
        ] {
            check_rule(&RULE, "fanuc-lathe", program, &expect![[""]]);
        }
    }

    #[test]
    fn in_the_profile_of_a_cycle() {
        let program = |code: &str, cycle: &str| {
            format!(
                "G21 G18 G99 G40 T0101\nG97 S800 M3\nG0 X52. Z2.\n{cycle}N10 G0 {code} X26.\nG1 Z0. F.1\nX30. Z-2.\nZ-30.\nX40. Z-35.\nZ-50.\nN20 G40 X52.\nG0 X150. Z100.\nT0202\nG97 S1000 M3\nG0 X52. Z2.\nG70 P10 Q20\nG0 X150. Z100.\nM30\n"
            )
        };
        let rough = "G71 U2. R.5\nG71 P10 Q20 U.4 W.1 F.25\n";
        check_rule(
            &RULE,
            "fanuc-lathe",
            &program("G41", rough),
            &expect![[r#"
            6 | N10 G0 G41 X26.
              |        ^^^ warning[nose-compensated-into-part] the nose is compensated into the part (`G41`)
        "#]],
        );
        check_rule(&RULE, "fanuc-lathe", &program("G42", rough), &expect![[""]]);
        let bore = "G21 G18 G99 G40 T0101\nG97 S800 M3\nG0 X18. Z2.\nG71 U2. R.5\nG71 P10 Q20 U-.4 W.1 F.25\nN10 G0 G42 X40.\nG1 Z-20. F.1\nX30.\nZ-30.\nN20 G40 X18.\nG0 X150. Z100.\nM30\n";
        check_rule(
            &RULE,
            "fanuc-lathe",
            bore,
            &expect![[r#"
            6 | N10 G0 G42 X40.
              |        ^^^ warning[nose-compensated-into-part] the nose is compensated into the part (`G42`)
        "#]],
        );
        check_rule(&RULE, "fanuc-lathe", &bore.replace("G42", "G41"), &expect![[""]]);
    }
}
