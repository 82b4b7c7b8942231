//! A turning cycle whose profile turns back.

use gcheck_controls::{Effect, LetterSet};

use crate::declare::declare_rule;
use crate::facts::turning::{Point, is_roughing, profile};
use crate::{PathCx, PathRule, Report, Run, Severity, Uses, Watch};

declare_rule! {
    /// The profile of a roughing cycle turns back: X and Z must only rise or only fall from its first block to its
    /// last.
    ///
    /// ## Why it matters
    /// The control stops with an alarm, or leaves the undercut uncut and plunges into it in the last pass. Most often a
    /// sign or a digit is wrong. A profile with pockets needs the second form of the cycle, whose first block names
    /// both axes, if the control has it.
    ///
    /// ## Reported
    /// ```nc,reported,haas-lathe
    /// G20 G54 T0101
    /// G97 S500 M3
    /// G0 X3. Z.1
    /// G71 P10 Q20 D.05 U.02 W.005 F.01
    /// N10 G0 X1.
    /// G1 Z-1. F.005
    /// X.5 Z-1.5
    /// N20 X2. Z-2.
    /// M30
    /// ```
    /// ## Not reported
    /// ```nc,quiet,haas-lathe
    /// G20 G54 T0101
    /// G97 S500 M3
    /// G0 X3. Z.1
    /// G71 P10 Q20 D.05 U.02 W.005 F.01
    /// N10 G0 X1.
    /// G1 Z-1. F.005
    /// X1.5 Z-1.5
    /// N20 X2. Z-2.
    /// M30
    /// ```
    rule "turning-profile-turns-back" in "cycles" {
        summary: "turning cycle whose profile turns back",
        severity: Warning,
        tier: Path,
        since: "0.1.0",
        run: Run::Path { watch: Watch::BLOCKS, make: || Box::new(TurningProfileTurnsBack) },
    }
}

struct TurningProfileTurnsBack;

impl PathRule for TurningProfileTurnsBack {
    fn concerns(&self, program: &Uses<'_>) -> bool {
        program.may(is_roughing)
    }

    fn block(&mut self, cx: &PathCx<'_>, report: &mut Report<'_>) {
        if !cx.has_effect(is_roughing) {
            return;
        }
        let Some(profile) = profile(cx) else { return };
        // A first block that names both axes chooses the form of the cycle that allows pockets.
        let has_pockets = profile.first_axes.intersects(LetterSet::of("XU"))
            && profile.first_axes.intersects(LetterSet::of("ZW"));
        // The retract at rapid does not belong to the profile.
        let count = profile.points.iter().rposition(|point| !point.is_rapid).map_or(0, |last| last + 1);
        let points = profile.points.get(..count).unwrap_or_default();
        if has_pockets {
            let is_along_z = cx.has_effect(|effect| effect == Effect::RoughAlongZ);
            let dropped = is_along_z.then(|| drop(&profile.start, points)).flatten();
            if let Some(point) = dropped.and_then(|at| points.get(at)) {
                report.add(
                    cx.finding(&META, point.range.clone(), "the profile of the turning cycle drops straight in X")
                        .label("a vertical wall behind the tool as it moves along Z")
                        .also(cx.range(), "the cycle that follows the profile")
                        .note("this form of the cycle allows pockets, but few tools can cut a vertical wall behind them")
                        .help("check the diameter, or give the wall an angle that the tool can cut")
                        .at_most(Severity::Info),
                );
            }
            return;
        }
        for (axis, way) in [
            ('X', points.iter().map(|point| point.x).collect::<Vec<_>>()),
            ('Z', points.iter().map(|point| point.z).collect()),
        ] {
            let Some(at) = turn(&way) else { continue };
            let Some(point) = points.get(at) else { continue };
            let message = format!("the profile of the turning cycle turns back in {axis}");
            report.add(
                cx.finding(&META, point.range.clone(), message)
                    .label(format!("{axis} reverses its direction here"))
                    .also(cx.range(), "the cycle that follows the profile")
                    .note("passes follow a profile whose X and Z only rise or only fall")
                    .help("check the sign and value of the word, or begin the profile with both axes if the control allows pockets"),
            );
            return;
        }
    }
}

/// The first position that reverses the direction of those before it.
fn turn(way: &[f64]) -> Option<usize> {
    let mut sign = 0.0;
    way.windows(2)
        .position(|pair| {
            let step = pair.last().copied().unwrap_or_default() - pair.first().copied().unwrap_or_default();
            if step.abs() <= SLACK {
                return false;
            }
            let turns = step * sign < 0.0;
            sign = step.signum();
            turns
        })
        .map(|before| before + 1)
}

/// The first of some points that a wall of a pocket leads down to, straight in X.
fn drop(start: &Point, points: &[Point]) -> Option<usize> {
    // A tool outside the profile turns, one inside bores.
    let up = if points.iter().all(|point| point.x <= start.x) {
        1.0
    } else if points.iter().all(|point| point.x >= start.x) {
        -1.0
    } else {
        return None;
    };
    let mut rose = false;
    points
        .windows(2)
        .position(|pair| {
            let [from, to] = pair else { return false };
            let step = (to.x - from.x) * up;
            // The face, cut to the middle before the profile rises, is not a pocket.
            let drops = rose && step < -SLACK && (to.z - from.z).abs() <= SLACK;
            rose |= step > SLACK;
            drops
        })
        .map(|before| before + 1)
}

/// In units of the program: controls let a profile turn back by this much.
const SLACK: f64 = 0.001;

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::check_rule;

    #[test]
    fn the_block_that_turns_is_marked() {
        check_rule(
            &RULE,
            "fanuc-lathe",
            "G21 T0101\nG97 S500 M3\nG0 X60. Z5.\nG71 U2. R1.\nG71 P10 Q20 U0.5 W0.1 F0.25\nN10 G0 X30.\nG1 Z-20.\nZ20.\nN20 X50.\nM30\n",
            &expect![[r#"
                8 | Z20.
                  | ^^^^ warning[turning-profile-turns-back] the profile of the turning cycle turns back in Z
            "#]],
        );
    }

    #[test]
    fn a_first_block_of_both_axes_takes_pockets() {
        check_rule(
            &RULE,
            "haas-lathe",
            "G20 G54 T0101\nG97 S500 M3\nG0 X3. Z.1\nG71 P10 Q20 D.05 U.02 W.005 F.01\nN10 G0 X1. Z.1\nG1 Z-1. F.005\nX.5 Z-1.5\nN20 X2. Z-2.\nM30\n",
            &expect![[""]],
        );
    }

    #[test]
    fn a_pocket_with_an_upright_wall_behind_the_tool() {
        let turn = |profile: &str, found: &expect_test::Expect| {
            let program = format!(
                "G20 G54 T0101\nG97 S500 M3\nG0 X3. Z.1\nG71 P10 Q20 D.05 U.02 W.005 F.01\n{profile}\nG0 X4.\nM30\n"
            );
            check_rule(&RULE, "haas-lathe", &program, found);
        };
        turn(
            "N10 G0 X0. Z.1\nG1 Z0. F.005\nX1.\nZ-.5\nX.5\nZ-1.25\nN20 X1.4",
            &expect![[r#"
            9 | X.5
              | ^^^ info[turning-profile-turns-back] the profile of the turning cycle drops straight in X
        "#]],
        );
        // A wall at an angle, and a face in front of the profile.
        turn("N10 G0 X0. Z.1\nG1 X1. Z0. F.005\nZ-.5\nX.5 Z-1.\nZ-1.25\nN20 X1.4", &expect![[""]]);
        turn("N10 G0 X2. Z.1\nG1 Z0. F.005\nX0.\nX1.\nZ-1.\nN20 X2.5", &expect![[""]]);
    }

    #[test]
    fn boring_goes_down() {
        check_rule(
            &RULE,
            "fanuc-lathe",
            "G21 T0101\nG97 S500 M3\nG0 X18. Z5.\nG71 U2. R1.\nG71 P10 Q20 U-0.5 W0.1 F0.25\nN10 G0 X40.\nG1 Z-20.\nX30. Z-25.\nN20 X20.\nM30\n",
            &expect![[""]],
        );
    }
}
