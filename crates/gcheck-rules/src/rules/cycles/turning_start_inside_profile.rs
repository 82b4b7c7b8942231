//! A turning cycle that starts inside its profile.

use gcheck_controls::{Effect, LetterSet};

use crate::declare::declare_rule;
use crate::facts::turning::{Point, Profile, is_roughing, profile};
use crate::{PathCx, PathRule, Report, Run, Uses, Watch};

declare_rule! {
    /// The tool is inside the profile when a roughing cycle begins, or so near to the chuck that the first block of the profile
    /// goes at rapid into the part; this also where the profile is finished. The same holds for a start nearer to the centre than
    /// the whole profile, if the profile is an outside one: its X grows toward the chuck, and the finishing allowance is
    /// that of an outside.
    ///
    /// ## Why it matters
    /// Each pass starts from the tool's position, and after it the tool returns there at rapid: through the part.
    ///
    /// ## Reported
    /// ```nc,reported,haas-lathe
    /// G20 G54 T0101
    /// G97 S500 M3
    /// G0 X1.5 Z.1
    /// G71 P10 Q20 D.05 U.02 W.005 F.01
    /// N10 G0 X1.
    /// G1 Z-1. F.005
    /// N20 X2. Z-2.
    /// M30
    /// ```
    /// ## Not reported
    /// ```nc,quiet,haas-lathe
    /// G20 G54 T0101
    /// G97 S500 M3
    /// G0 X2.1 Z.1
    /// G71 P10 Q20 D.05 U.02 W.005 F.01
    /// N10 G0 X1.
    /// G1 Z-1. F.005
    /// N20 X2. Z-2.
    /// M30
    /// ```
    rule "turning-start-inside-profile" in "cycles" {
        summary: "turning cycle that starts inside its profile",
        severity: Warning,
        tier: Path,
        since: "0.1.0",
        run: Run::Path { watch: Watch::BLOCKS, make: || Box::new(TurningStartInsideProfile) },
    }
}

struct TurningStartInsideProfile;

impl PathRule for TurningStartInsideProfile {
    fn concerns(&self, program: &Uses<'_>) -> bool {
        program.may(is_roughing)
    }

    fn block(&mut self, cx: &PathCx<'_>, report: &mut Report<'_>) {
        let is_finish = cx.has_effect(|effect| effect == Effect::FinishProfile);
        if !is_finish && !cx.has_effect(is_roughing) {
            return;
        }
        let along_x = cx.has_effect(|effect| effect == Effect::RoughAlongX);
        let Some(profile) = profile(cx) else { return };
        if let Some(begin) = begin_behind_start(&profile).filter(|_| !along_x) {
            behind_face(cx, &profile, begin, report);
            return;
        }
        if is_finish {
            return;
        }
        if !along_x && is_below_outside(cx, &profile) {
            below_outside(cx, &profile, report);
            return;
        }
        let level = |point: &Point| if along_x { point.z } else { point.x };
        let mut cut = profile.points.iter().skip(1).filter(|point| !point.is_rapid);
        let (Some(first), Some(last)) = (profile.points.first(), cut.clone().next_back()) else { return };
        // Outward from the first block: the tool must be at the end of the profile, or beyond.
        let start = level(&profile.start);
        let outward = if level(first) <= start { 1.0 } else { -1.0 };
        let beyond = |point: &Point| (level(point) - start) * outward;
        let Some(worst) = cut.find(|point| beyond(point) > SLACK) else { return };
        // A profile that begins outside the tool, or runs the other way, is not judged.
        if beyond(first) > 0.0 || beyond(last) <= 0.0 {
            return;
        }
        let axis = if along_x { 'Z' } else { 'X' };
        let message = format!("the turning cycle starts inside its profile (`{axis}{}`)", trimmed(start));
        report.add(
            cx.finding(&META, cx.range(), message)
                .label("the tool returns to its present position at rapid")
                .also(worst.range.clone(), format!("the profile reaches `{axis}{}`", trimmed(level(worst))))
                .help("move outside the stock before the cycle"),
        );
    }
}

/// The point that the profile comes back out to, where its first block goes at rapid into the part: toward the centre, nearer
/// to the chuck than the face at which it begins.
fn begin_behind_start(profile: &Profile) -> Option<&Point> {
    let Profile { start, points, first_axes } = profile;
    let (first, begin) = (points.first()?, points.get(1)?);
    let across = !first_axes.intersects(LetterSet::of("ZW")) && first.is_rapid && first.x < start.x - SLACK;
    let is_outside = points.iter().all(|point| point.x <= start.x + SLACK);
    let goes_on = points.iter().skip(2).all(|point| point.z <= begin.z + SLACK);
    (across && is_outside && goes_on && begin.z > start.z + SLACK && !begin.is_rapid).then_some(begin)
}

fn behind_face(cx: &PathCx<'_>, profile: &Profile, begin: &Point, report: &mut Report<'_>) {
    let z = trimmed(profile.start.z);
    let Some(first) = profile.points.first() else { return };
    report.add(
        cx.finding(&META, cx.range(), format!("the turning cycle starts inside its profile (`Z{z}`)"))
            .label("the tool is nearer to the chuck than the start of the profile")
            .also(
                first.range.clone(),
                format!("goes at rapid to `X{}` there, into the part", trimmed(first.x)),
            )
            .also(begin.range.clone(), format!("the profile begins at `Z{}`", trimmed(begin.z)))
            .help(format!("start in front of `Z{}`", trimmed(begin.z))),
    );
}

/// Is the start nearer to the centre than the whole of an outside profile?
fn is_below_outside(cx: &PathCx<'_>, profile: &Profile) -> bool {
    let allowance = cx.known_number('U').unwrap_or(0.0);
    let start = profile.start.x;
    allowance > 0.0
        && profile.grows_to_chuck() == Some(true)
        && profile.points.iter().all(|point| point.x > start - SLACK)
}

fn below_outside(cx: &PathCx<'_>, profile: &Profile, report: &mut Report<'_>) {
    let x = trimmed(profile.start.x);
    let (Some(first), Some(largest)) =
        (profile.points.first(), profile.points.iter().max_by(|a, b| a.x.total_cmp(&b.x)))
    else {
        return;
    };
    let message = format!("the turning cycle starts inside the stock (`X{x}`)");
    report.add(
        cx.finding(&META, cx.range(), message)
            .label("each pass begins here, nearer to the centre than the profile")
            .also(first.range.clone(), format!("the profile begins at `X{}`", trimmed(first.x)))
            .also(largest.range.clone(), format!("and grows to `X{}` toward the chuck", trimmed(largest.x)))
            .note("a profile that grows toward the chuck is the outside of a part, and so is this allowance")
            .help(format!("move outside the stock before the cycle, beyond `X{}`", trimmed(largest.x))),
    );
}

/// In units of the program.
const SLACK: f64 = 0.01;

fn trimmed(number: f64) -> String {
    let text = format!("{number:.3}");
    text.trim_end_matches('0').to_owned()
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::check_rule;

    #[test]
    fn a_finish_that_starts_behind_the_face() {
        let program = |z: &str| {
            format!(
                "G20 G99 G54 T0101\nG97 S500 M3\nG0 X2.1 Z.1\nG71 P10 Q20 D.05 U.02 W.005 F.01\nN10 G0 X1.3\nG1 Z0. F.006\nX1.5 Z-.1\nZ-1.\nN20 X2.1\nG0 X2.1 Z{z}\nG70 P10 Q20\nM30\n"
            )
        };
        check_rule(
            &RULE,
            "haas-lathe",
            &program("-.1"),
            &expect![[r#"
            11 | G70 P10 Q20
               | ^^^^^^^^^^^ warning[turning-start-inside-profile] the turning cycle starts inside its profile (`Z-0.1`)
        "#]],
        );
        check_rule(&RULE, "haas-lathe", &program(".1"), &expect![[""]]);
    }

    #[test]
    fn a_start_where_the_facing_ended() {
        check_rule(
            &RULE,
            "fanuc-lathe",
            "G21 G99 T0101\nG97 S500 M3\nG0 X64. Z0.\nG1 X-1.6 F.2\nG0 Z2.\nG71 U2. R1.\nG71 P10 Q20 U.4 W.1 F.3\nN10 G0 X26.\nG1 Z-30. F.15\nN20 X62.\nM30\n",
            &expect![[r#"
                7 | G71 P10 Q20 U.4 W.1 F.3
                  | ^^^^^^^^^^^^^^^^^^^^^^^ warning[turning-start-inside-profile] the turning cycle starts inside the stock (`X-1.6`)
            "#]],
        );
    }

    #[test]
    fn facing_counts_along_the_part() {
        check_rule(
            &RULE,
            "fanuc-lathe",
            "G21 T0101\nG97 S500 M3\nG0 X60. Z-5.\nG72 W2. R1.\nG72 P10 Q20 U0.5 W0.1 F0.25\nN10 G0 Z-20.\nG1 X30.\nN20 Z0.\nM30\n",
            &expect![[r#"
                5 | G72 P10 Q20 U0.5 W0.1 F0.25
                  | ^^^^^^^^^^^^^^^^^^^^^^^^^^^ warning[turning-start-inside-profile] the turning cycle starts inside its profile (`Z-5.`)
            "#]],
        );
    }

    #[test]
    fn a_bore_is_started_inside_it() {
        check_rule(
            &RULE,
            "fanuc-lathe",
            "G21 T0101\nG97 S500 M3\nG0 X18. Z5.\nG71 U2. R1.\nG71 P10 Q20 U-0.5 W0.1 F0.25\nN10 G0 X40.\nG1 Z-20.\nX30. Z-25.\nN20 X20.\nM30\n",
            &expect![[""]],
        );
    }

    #[test]
    fn an_outside_profile_beyond_the_start_has_its_stock_there() {
        let program = |u: &str| {
            format!(
                "G21 T0101\nG97 S500 M3\nG0 X28. Z2.\nG71 U2. R1.\nG71 P10 Q20 {u} W0.1 F0.25\nN10 G0 X30.\nG1 Z-20.\nX40. Z-25.\nN20 X50.\nM30\n"
            )
        };
        check_rule(
            &RULE,
            "fanuc-lathe",
            &program("U0.5"),
            &expect![[r#"
            5 | G71 P10 Q20 U0.5 W0.1 F0.25
              | ^^^^^^^^^^^^^^^^^^^^^^^^^^^ warning[turning-start-inside-profile] the turning cycle starts inside the stock (`X28.`)
        "#]],
        );
        // A recess that is bored.
        check_rule(&RULE, "fanuc-lathe", &program("U-0.5"), &expect![[""]]);
    }
}
