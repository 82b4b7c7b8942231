//! A radius or an angle where the control does not take it.

use gcheck_controls::{Confidence, Effect, Letter, LetterSet};
use gcheck_engine::{Fact, Fault, Role};

use crate::declare::declare_rule;
use crate::{PathCx, PathRule, Report, Run, Watch, limit};

declare_rule! {
    /// A move gives its end by a radius (`@`) or an angle (`^`) and by `X` or `Y`, too, or another plane than XY is selected.
    ///
    /// ## Why it matters
    /// The control stops with an error at the block.
    ///
    /// ## Reported
    /// ```nc,reported,linuxcnc
    /// G21 G90
    /// G0 @5 X1
    /// M2
    /// ```
    /// ```nc,reported,linuxcnc
    /// G21 G90 G18
    /// G0 @5 ^45
    /// M2
    /// ```
    /// ## Not reported
    /// ```nc,quiet,linuxcnc
    /// G21 G90 G17
    /// G0 @5 ^45
    /// ^60 Z2
    /// X1 Y1
    /// M2
    /// ```
    rule "polar-word-refused" in "words" {
        summary: "radius or angle where the control does not take it",
        severity: Error,
        tier: Path,
        control_specific: true,
        since: "0.1.0",
        run: Run::Path { watch: Watch::FAULTS, make: || Box::new(PolarWordRefused) },
    }
}

struct PolarWordRefused;

impl PathRule for PolarWordRefused {
    fn fault(&mut self, cx: &PathCx<'_>, fault: &Fault, report: &mut Report<'_>) {
        let letters = cx.origin().letters;
        let is_polar = |letter: Letter| matches!(letter, Letter::AT | Letter::CARET);
        // Another rule reports words that a code of the block forbids.
        if *fault != Fault::Conflict
            || !letters.iter().any(is_polar)
            || cx.has_effect(|effect| effect == Effect::MachineCoordinates)
        {
            return;
        }
        let range = cx.word_range(|word| is_polar(word.letter));
        let confidence =
            |letter| cx.control().letter(letter).map(|entry| (entry.confidence, entry.source.as_str()));
        let (confidence, source) = letters
            .iter()
            .filter(|letter| is_polar(*letter))
            .find_map(confidence)
            .unwrap_or((Confidence::Assumed, ""));
        let both = letters.and(LetterSet::of("XY")).iter().next();
        let message = match both {
            Some(axis) => format!("radius or angle beside `{axis}`"),
            None => "radius or angle outside of the XY plane".to_owned(),
        };
        let finding = cx
            .finding(&META, range, message)
            .label("gives `X` and `Y` together with the other polar word")
            .note(format!(
                "`@` and `^` give the point in the XY plane, in the place of `X` and `Y`  [{source}]"
            ))
            .at_most(limit(confidence));
        report.add(match both {
            Some(axis) => finding.help(format!("give the point by `@` and `^`, or by `{axis}`")),
            None => {
                let finding = finding.help("select `G17` before this block");
                let plane = cx.code_name(Role::Plane).unwrap_or_default();
                cx.resting_on(finding, Fact::Mode(Role::Plane), &format!("`{plane}`"))
            }
        });
    }
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::check_rule;

    #[test]
    fn the_word_is_marked() {
        check_rule(
            &RULE,
            "linuxcnc",
            "G21 G90 G0 X1 Y1\n@5 Y#1\n^30\nG1 X2 ^3 F100\nG19\nG1 @3\nG17\nG1 @3\nM2\n",
            &expect![[r#"
                2 | @5 Y#1
                  | ^^ error[polar-word-refused] radius or angle beside `Y`
                4 | G1 X2 ^3 F100
                  |       ^^ error[polar-word-refused] radius or angle beside `X`
                6 | G1 @3
                  |    ^^ error[polar-word-refused] radius or angle outside of the XY plane
            "#]],
        );
    }

    #[test]
    fn a_plane_of_the_same_block_comes_after_the_judgement() {
        check_rule(&RULE, "linuxcnc", "G21 G90 G17\nG18 G0 @5 ^45\nM2\n", &expect![[""]]);
    }
}
