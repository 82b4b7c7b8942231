//! A turning cycle that starts inside its profile.

use gcheck_controls::{Effect, LetterSet};
use gcheck_engine::At;

use crate::declare::declare_rule;
use crate::facts::turning::{Point, Profile, cuts_in_passes, is_roughing, profile};
use crate::{PathCx, PathRule, Report, Run, Uses, Watch};

declare_rule! {
    /// The tool is inside the profile when a roughing cycle begins, or so near to the chuck that the first block of the profile
    /// goes at rapid into the part; this also where the profile is finished. The same holds for a start nearer to the centre than
    /// the whole profile, if the profile is an outside one: its X grows toward the chuck, and the finishing allowance is
    /// that of an outside. A finishing cycle is reported whose way back to its start goes through the profile that a roughing
    /// cycle has cut.
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
        program.may(cuts_in_passes)
    }

    fn block(&mut self, cx: &PathCx<'_>, report: &mut Report<'_>) {
        let is_finish = cx.has_effect(|effect| effect == Effect::FinishProfile);
        if !is_finish && !cx.has_effect(cuts_in_passes) {
            return;
        }
        let along_x = cx.has_effect(|effect| effect == Effect::RoughAlongX);
        let Some(profile) = profile(cx) else { return };
        if let Some(begin) = begin_behind_start(&profile).filter(|_| !along_x) {
            behind_face(cx, &profile, begin, report);
            return;
        }
        if is_finish {
            finish_from_inside(cx, &profile, report);
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

/// After the profile, a finishing cycle goes back to its start at rapid. Does that way lead through the part?
fn finish_from_inside(cx: &PathCx<'_>, profile: &Profile, report: &mut Report<'_>) {
    // The allowance of the roughing cycle tells an outside from a bore.
    let Some(allowance) = allowance_of_roughing(cx) else { return };
    let is_outside = allowance > 0.0;
    let sign = if is_outside { 1.0 } else { -1.0 };
    let (start, points) = (&profile.start, &profile.points);
    let Some(last) = points.last() else { return };
    let Some(units) = cx.state().units(cx.model) else { return };
    let under = -1.0 / units.in_mm();
    // Only a start in front of the face, and beyond it the end of the profile.
    if profile.grows_to_chuck() != Some(is_outside) || start.z < 0.0 || last.z > under {
        return;
    }
    let back = |z: f64| start.x + (z - start.z) / (last.z - start.z) * (last.x - start.x);
    let levels = std::iter::once(under).chain(points.iter().map(|point| point.z)).filter(|z| *z <= under);
    let is_through =
        |z: &f64| profile_at(points, *z).is_some_and(|x| (x - back(*z)) * sign > 1.0 / units.in_mm());
    let Some(met) = levels.into_iter().find(is_through) else { return };
    let x = trimmed(start.x);
    report.add(
        cx.finding(&META, cx.range(), format!("the finishing cycle starts inside its profile (`X{x}`)"))
            .label("after the profile the tool returns here at rapid, through the part")
            .also(
                last.range.clone(),
                format!("the profile ends at `X{} Z{}`", trimmed(last.x), trimmed(last.z)),
            )
            .note(format!(
                "the way back is at X {} where the profile is at X {} (Z {})",
                trimmed(back(met)),
                trimmed(profile_at(points, met).unwrap_or(f64::NAN)),
                trimmed(met)
            ))
            .help(if is_outside {
                format!("start outside the stock, beyond `X{}`", trimmed(last.x))
            } else {
                format!("start inside the bore, nearer to the centre than `X{}`", trimmed(last.x))
            }),
    );
}

/// The X of the profile at a level, before its last block.
fn profile_at(points: &[Point], z: f64) -> Option<f64> {
    let before_last = points.get(..points.len().checked_sub(1)?)?;
    before_last.windows(2).find_map(|pair| {
        let [from, to] = pair else { return None };
        let (low, high) = (from.z.min(to.z), from.z.max(to.z));
        let is_along = high - low > SLACK && (low..=high).contains(&z);
        is_along.then(|| from.x + (z - from.z) / (to.z - from.z) * (to.x - from.x))
    })
}

/// The allowance in X of the roughing cycle before this block that cuts the same profile.
fn allowance_of_roughing(cx: &PathCx<'_>) -> Option<f64> {
    let here = cx.origin().at;
    let profile = cx.known_number('P')?;
    let first = here.block.saturating_sub(MAX_BEFORE);
    (first..here.block).rev().find_map(|block| {
        let place = cx.place_of(At { block, ..here })?;
        let words = place.table.words(place.block());
        let number = |letter: u8| {
            let mut of_letter = words.iter().filter(|word| word.letter.ascii() == letter);
            of_letter.next().and_then(gcheck_program::Word::number)
        };
        let is_same = words.iter().any(|word| is_roughing(cx.model.effect(word.code)))
            && number(b'P').is_some_and(|named| (named - profile).abs() < SLACK);
        if is_same { number(b'U').filter(|allowance| *allowance != 0.0) } else { None }
    })
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

/// Blocks before a finishing cycle that are searched for its roughing cycle.
const MAX_BEFORE: u32 = 1000;
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
    fn a_profile_that_is_cut_again_and_again() {
        let program = |x: &str| {
            format!(
                "G21 G40 G99\nT0101\nG96 S140 M3\nG0 X{x} Z10.\nG73 U6. W3. R4\nG73 P50 Q60 U.5 W.2 F.25\nN50 G0 X60. Z3.\nG1 Z-20. F.15\nX80. Z-35.\nN60 X112. Z-81.\nM30\n"
            )
        };
        check_rule(
            &RULE,
            "fanuc-lathe",
            &program("100."),
            &expect![[r#"
            6 | G73 P50 Q60 U.5 W.2 F.25
              | ^^^^^^^^^^^^^^^^^^^^^^^^ warning[turning-start-inside-profile] the turning cycle starts inside its profile (`X100.`)
        "#]],
        );
        check_rule(&RULE, "fanuc-lathe", &program("130."), &expect![[""]]);
    }

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
    fn a_finish_that_returns_through_the_part() {
        let outside = |x: &str| {
            format!(
                "G21 G40 G99\nT0101\nG96 S200 M3\nG0 X64. Z2.\nG71 U2. R0.5\nG71 P10 Q20 U0.4 W0.1 F0.25\nN10 G0 X30.\nG1 Z-20. F0.1\nX40. Z-25.\nZ-40.\nN20 X62.\nG0 X150. Z100.\nT0303\nG0 X{x} Z2.\nG70 P10 Q20\nM30\n"
            )
        };
        let bore = |x: &str| {
            format!(
                "G21 G40 G99\nT0404\nG96 S150 M3\nG0 X18. Z2.\nG71 U1.5 R0.5\nG71 P10 Q20 U-0.4 W0.1 F0.2\nN10 G0 X46.\nG1 Z-20. F0.1\nX34. Z-30.\nN20 X20.\nG0 Z50.\nT0505\nG0 X{x} Z2.\nG70 P10 Q20\nM30\n"
            )
        };
        check_rule(
            &RULE,
            "fanuc-lathe",
            &outside("20."),
            &expect![[r#"
            15 | G70 P10 Q20
               | ^^^^^^^^^^^ warning[turning-start-inside-profile] the finishing cycle starts inside its profile (`X20.`)
        "#]],
        );
        check_rule(
            &RULE,
            "fanuc-lathe",
            &bore("60."),
            &expect![[r#"
            14 | G70 P10 Q20
               | ^^^^^^^^^^^ warning[turning-start-inside-profile] the finishing cycle starts inside its profile (`X60.`)
        "#]],
        );
        for program in [outside("64."), outside("62."), bore("20."), bore("18."), bore("19.")] {
            check_rule(&RULE, "fanuc-lathe", &program, &expect![[""]]);
        }
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
