//! A finishing allowance whose sign takes the rough cut into the finished contour.

use gcheck_controls::Letter;

use crate::declare::declare_rule;
use crate::facts::turning::{Point, Profile, cuts_in_passes, profile};
use crate::{PathCx, PathRule, Report, Run, Uses, Watch};

declare_rule! {
    /// The finishing allowance of a turning cycle (`U` in X, `W` in Z) has the sign that puts it on the wrong side of the
    /// profile: `U` is negative outside, or positive in a bore; `W` points into the shoulders.
    ///
    /// The side is told by where the tool is when the cycle begins: the stock lies between it and the profile. If the
    /// tool is neither outside nor inside the whole profile, nothing is reported; nor if the tool is inside a profile whose
    /// X grows toward the chuck, with the allowance of an outside: then the start is wrong.
    ///
    /// ## Why it matters
    /// The cycle leaves the allowance by shifting the profile by `U` and `W`. With the wrong sign the rough passes cut that
    /// much too deep, and nothing is left to finish: the part is scrap.
    ///
    /// ## Reported
    /// ```nc,reported,fanuc-lathe
    /// G21 T0101
    /// G96 S180 M3
    /// G0 X52. Z2.
    /// G71 U2. R.5
    /// G71 P10 Q20 U-0.4 W0.1 F0.25
    /// N10 G0 X20.
    /// G1 Z-20. F0.12
    /// X30. Z-25.
    /// N20 X52.
    /// M30
    /// ```
    /// ```nc,reported,haas-lathe
    /// G20 T101
    /// G96 S500 M3
    /// G0 X2.1 Z.1
    /// G71 P1 Q2 U-.02 W.005 D.08 F.012
    /// N1 G0 X1.
    /// G1 Z-1. F.005
    /// N2 X2.1
    /// M30
    /// ```
    /// ## Not reported
    /// ```nc,quiet,fanuc-lathe
    /// G21 T0101
    /// G96 S180 M3
    /// G0 X52. Z2.
    /// G71 U2. R.5
    /// G71 P10 Q20 U0.4 W0.1 F0.25
    /// N10 G0 X20.
    /// G1 Z-20. F0.12
    /// X30. Z-25.
    /// N20 X52.
    /// M30
    /// ```
    rule "allowance-into-contour" in "cycles" {
        summary: "finishing allowance on the wrong side of the profile",
        severity: Warning,
        tier: Path,
        since: "0.1.0",
        run: Run::Path { watch: Watch::BLOCKS, make: || Box::new(AllowanceIntoContour) },
    }
}

struct AllowanceIntoContour;

impl PathRule for AllowanceIntoContour {
    fn concerns(&self, program: &Uses<'_>) -> bool {
        program.may(cuts_in_passes)
    }

    fn block(&mut self, cx: &PathCx<'_>, report: &mut Report<'_>) {
        if !cx.has_effect(cuts_in_passes) || cx.is_malformed() {
            return;
        }
        let letters = cx.origin().letters;
        let wanted = ['U', 'W'].into_iter().filter(|letter| letters.contains(Letter::of(*letter)));
        let given: Vec<(char, f64)> =
            wanted.filter_map(|letter| Some((letter, cx.known_number(letter)?))).collect();
        if given.iter().all(|(_, value)| *value == 0.0) {
            return;
        }
        let Some(profile) = profile(cx) else { return };
        for (letter, value) in given {
            let across = letter == 'U';
            let Some(side) = side(&profile, across).filter(|side| side * value < 0.0) else { continue };
            // Another rule reports the start.
            if across && side < 0.0 && profile.grows_to_chuck() == Some(true) {
                continue;
            }
            let (where_to, cut) = match (across, side > 0.0) {
                (true, true) => ("outside the profile", "the rough cut goes below the finished diameter"),
                (true, false) => ("inside the profile", "the rough cut goes beyond the finished bore"),
                (false, _) => {
                    ("before the shoulders of the profile", "the rough cut goes into the shoulders")
                }
            };
            let is_pointed = cx.word(letter).is_none_or(|word| word.shape.point || word.is_computed());
            let shown = |value: f64| if is_pointed { trimmed(value) } else { format!("{value:.0}") };
            let word = format!("{letter}{}", shown(value));
            // A profile that shrinks toward the chuck is a bore, and so is this allowance, unless it is turned from the chuck side.
            let may_be_bore = across && side > 0.0 && profile.grows_to_chuck() == Some(false);
            let start = trimmed(profile.start.x);
            let message = if may_be_bore {
                format!("start (`X{start}`) and finishing allowance (`{word}`) do not fit together")
            } else {
                format!("finishing allowance on the wrong side of the profile (`{word}`)")
            };
            let mut finding = cx.finding(&META, cx.letter_range(letter), message).label(cut);
            if let Some(first) = profile.points.first() {
                finding = finding.also(first.range.clone(), "the profile begins here");
            }
            let finding = finding.note(format!("the tool starts {where_to}, so the stock is on that side"));
            report.add(if may_be_bore {
                finding.help(format!(
                    "for a bore, start nearer to the centre than the profile; for an outside, write `{letter}{}`",
                    shown(-value)
                ))
            } else {
                finding.help(format!("write `{letter}{}`", shown(-value)))
            });
        }
    }
}

/// On which side of the whole profile the tool starts: 1 beyond it in the positive direction, -1 in the negative one.
fn side(profile: &Profile, across: bool) -> Option<f64> {
    let level = |point: &Point| if across { point.x } else { point.z };
    let start = level(&profile.start);
    let levels = profile.points.iter().map(level);
    let least = levels.clone().fold(f64::INFINITY, f64::min);
    let most = levels.fold(f64::NEG_INFINITY, f64::max);
    // A profile of one level tells no side; a bore is not beyond the centre.
    if most - least <= SLACK {
        return None;
    }
    if start >= most - SLACK {
        Some(1.0)
    } else if start <= least + SLACK {
        Some(-1.0)
    } else {
        None
    }
}

/// In units of the program.
const SLACK: f64 = 0.01;

fn trimmed(number: f64) -> String {
    let text = format!("{number:.4}");
    let text = text.trim_end_matches('0');
    text.to_owned()
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::{World, check_rule, findings, only, words};

    fn bore(u: &str, w: &str) -> String {
        format!(
            "G21 T0101\nG97 S500 M3\nG0 X18. Z5.\nG71 U2. R1.\nG71 P10 Q20 U{u} W{w} F0.25\nN10 G0 X40.\nG1 Z-20.\nX30. Z-25.\nN20 X18.\nM30\n"
        )
    }

    #[test]
    fn a_bore_has_its_stock_inside() {
        check_rule(&RULE, "fanuc-lathe", &bore("-0.5", "0.1"), &expect![[""]]);
        check_rule(
            &RULE,
            "fanuc-lathe",
            &bore("0.5", "0.1"),
            &expect![[r#"
            5 | G71 P10 Q20 U0.5 W0.1 F0.25
              |             ^^^^ warning[allowance-into-contour] finishing allowance on the wrong side of the profile (`U0.5`)
        "#]],
        );
    }

    #[test]
    fn shoulders_have_their_stock_before_them() {
        check_rule(
            &RULE,
            "fanuc-lathe",
            &bore("-0.5", "-0.1"),
            &expect![[r#"
            5 | G71 P10 Q20 U-0.5 W-0.1 F0.25
              |                   ^^^^^ warning[allowance-into-contour] finishing allowance on the wrong side of the profile (`W-0.1`)
        "#]],
        );
    }

    #[test]
    fn facing_and_pattern_repeating_too() {
        let faced = |u: &str| {
            format!(
                "G21 T0101\nG97 S500 M3\nG0 X60. Z2.\nG72 W2. R1.\nG72 P10 Q20 U{u} W0.1 F0.25\nN10 G0 Z-20.\nG1 X30.\nN20 Z0.\nM30\n"
            )
        };
        check_rule(&RULE, "fanuc-lathe", &faced("0.5"), &expect![[""]]);
        check_rule(
            &RULE,
            "fanuc-lathe",
            &faced("-0.5"),
            &expect![[r#"
            5 | G72 P10 Q20 U-0.5 W0.1 F0.25
              |             ^^^^^ warning[allowance-into-contour] finishing allowance on the wrong side of the profile (`U-0.5`)
        "#]],
        );
        let repeated = |u: &str| {
            format!(
                "G21 T0101\nG97 S500 M3\nG0 X60. Z2.\nG73 U5. W2. R3\nG73 P10 Q20 U{u} W0.1 F0.25\nN10 G0 X20.\nG1 Z-20.\nN20 X50. Z-30.\nM30\n"
            )
        };
        check_rule(&RULE, "fanuc-lathe", &repeated("0.5"), &expect![[""]]);
        check_rule(
            &RULE,
            "fanuc-lathe",
            &repeated("-0.5"),
            &expect![[r#"
            5 | G73 P10 Q20 U-0.5 W0.1 F0.25
              |             ^^^^^ warning[allowance-into-contour] finishing allowance on the wrong side of the profile (`U-0.5`)
        "#]],
        );
    }

    #[test]
    fn a_computed_allowance_counts_a_computed_profile_does_not() {
        let program = bore("#1", "0.1").replace("G21", "#1=0.5\nG21");
        check_rule(
            &RULE,
            "fanuc-lathe",
            &program,
            &expect![[r#"
            6 | G71 P10 Q20 U#1 W0.1 F0.25
              |             ^^^ warning[allowance-into-contour] finishing allowance on the wrong side of the profile (`U0.5`)
        "#]],
        );
        check_rule(&RULE, "fanuc-lathe", &bore("0.5", "0.1").replace("X40.", "X#2"), &expect![[""]]);
    }

    #[test]
    fn an_outside_with_its_start_in_the_stock_has_the_right_sign() {
        check_rule(
            &RULE,
            "fanuc-lathe",
            "G21 T0101\nG97 S500 M3\nG0 X28. Z2.\nG71 U2. R1.\nG71 P10 Q20 U0.5 W0.1 F0.25\nN10 G0 X30.\nG1 Z-20.\nX40. Z-25.\nN20 X50.\nM30\n",
            &expect![[""]],
        );
    }

    #[test]
    fn a_bore_that_is_started_outside_of_it() {
        let program = bore("-0.4", "0.1").replace("X18.", "X42.").replace("N20 X42.", "N20 X22.");
        let found = findings(&only(&RULE), "fanuc-lathe", &program, &World::default());
        expect![[r#"
            start (`X42.`) and finishing allowance (`U-0.4`) do not fit together
              here: the rough cut goes below the finished diameter
              there: the profile begins here
              note: the tool starts outside the profile, so the stock is on that side
              help: for a bore, start nearer to the centre than the profile; for an outside, write `U0.4`
        "#]]
        .assert_eq(&found.iter().map(words).collect::<String>());
    }

    #[test]
    fn a_start_beside_the_profile_tells_nothing() {
        check_rule(&RULE, "fanuc-lathe", &bore("0.5", "0.1").replace("G0 X18.", "G0 X32."), &expect![[""]]);
    }
}
