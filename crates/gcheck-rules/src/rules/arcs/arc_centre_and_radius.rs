//! An arc that gives its centre and its radius.

use gcheck_controls::{Effect, Letter, LetterSet};
use gcheck_engine::{ArcFault, Event, Fault, Role, Units};
use gcheck_geometry::{Mm, Plane};
use gcheck_program::Word;

use crate::declare::declare_rule;
use crate::facts::arcs::counts_least_increments;
use crate::{PathCx, PathRule, Report, Run, Severity, Watch, limit};

declare_rule! {
    /// A block under an arc mode gives a centre and a radius, on a control that takes one of them. Or it gives a centre
    /// that is not as far from the start as the radius says, on a control that takes the radius and ignores the centre.
    ///
    /// Where the control's page excludes the two words from a block with `G2` or `G3`, `words-exclude-each-other`
    /// reports that block.
    ///
    /// ## Why it matters
    /// The control stops with an alarm, because it cannot know which of the two was meant. Or it cuts an arc of another
    /// size than the centre words say.
    ///
    /// ## Reported
    /// ```nc,reported,linuxcnc
    /// G17 G21 G90 G0 X0 Y0
    /// G2 X10 Y0 I5 F100
    /// X20 I5 R5
    /// M2
    /// ```
    /// ```nc,reported,fanuc-mill
    /// G17 G21 G90 G0 X0. Y0.
    /// G2 X20. Y0. I10. J0. R11. F100.
    /// M30
    /// ```
    /// ## Not reported
    /// A centre that agrees with the radius:
    /// ```nc,quiet,fanuc-mill
    /// G17 G21 G90 G0 X0. Y0.
    /// G2 X20. Y0. I10. J0. R10. F100.
    /// M30
    /// ```
    /// ```nc,quiet,linuxcnc
    /// G17 G21 G90 G0 X0 Y0
    /// G2 X10 Y0 I5 F100
    /// X20 R5
    /// M2
    /// ```
    rule "arc-centre-and-radius" in "arcs" {
        summary: "arc with a centre and a radius",
        severity: Error,
        tier: Path,
        fixable: OnRequest,
        since: "0.1.0",
        run: Run::Path { watch: Watch::FAULTS.union(Watch::ARCS), make: || Box::new(ArcCentreAndRadius) },
    }
}

struct ArcCentreAndRadius;

impl PathRule for ArcCentreAndRadius {
    fn fault(&mut self, cx: &PathCx<'_>, fault: &Fault, report: &mut Report<'_>) {
        if *fault != Fault::Arc(ArcFault::CentreAndRadius) || is_told(cx) {
            return;
        }
        let is_centre = |word: &Word| matches!(word.letter.ascii(), b'I' | b'J' | b'K');
        report.add(
            cx.finding(&META, cx.letter_range('R'), "arc with a centre and a radius (`R`)")
                .label("an arc takes only one of the two")
                .also(cx.word_range(is_centre), "the centre is given here")
                .help("remove the centre or the radius")
                .fix_if(cx.removal_of('R', "remove the radius"))
                .at_most(limit(cx.model.semantics().confidence)),
        );
    }

    fn moved(&mut self, cx: &PathCx<'_>, event: &Event, report: &mut Report<'_>) {
        let Event::Arc(arc) = event else { return };
        if arc.expanded || !cx.model.semantics().arcs.radius_wins || is_told(cx) {
            return;
        }
        let Some((distance, radius)) = contradiction(cx, arc.plane) else { return };
        let is_centre = |word: &Word| matches!(word.letter.ascii(), b'I' | b'J' | b'K');
        let shown = |length: f64| cx.shown(Mm(length * cx.state().units(cx.model).map_or(1.0, Units::in_mm)));
        let (distance, radius) = (shown(distance), shown(radius));
        report.add(
            cx.finding(
                &META,
                cx.letter_range('R'),
                "centre and radius of the arc contradict each other (`R`)",
            )
            .label(format!("the arc gets this radius, {radius}"))
            .also(cx.word_range(is_centre), format!("this centre is {distance} from the start"))
            .note("this control takes the radius and ignores the centre")
            .help("correct the one that is wrong, and remove the other")
            .at_most(Severity::Warning),
        );
    }
}

/// How far two radii may differ, as a part of the radius and in words of the program: what a postprocessor rounds away.
const AGREE_WITHIN: f64 = 0.002;

/// How far the centre is from the start, and the radius, where the block gives both and they do not agree; as the program
/// counts.
fn contradiction(cx: &PathCx<'_>, plane: Plane) -> Option<(f64, f64)> {
    let letters = cx.origin().letters;
    let [first, second] = match plane {
        Plane::Xy => ['I', 'J'],
        Plane::Zx => ['K', 'I'],
        Plane::Yz => ['J', 'K'],
    };
    // Under compensation an arc comes when the next move is known: the plane must be this block's.
    let is_given = letters.contains(Letter::of('R')) && letters.intersects(LetterSet::of("IJK"));
    if !is_given || cx.state().plane(cx.model) != Some(plane) || counts_least_increments(cx) {
        return None;
    }
    // A centre measured from the origin says nothing without the start.
    if cx.state().effect(Role::ArcCentre, cx.model) == Some(Effect::ArcCentreAbsolute) {
        return None;
    }
    let part = |letter: char| match cx.word(letter) {
        Some(_) => cx.known_number(letter),
        None => Some(0.0),
    };
    let distance = part(first)?.hypot(part(second)?);
    let radius = cx.known_number('R')?.abs();
    let agrees = (distance - radius).abs() <= AGREE_WITHIN * f64::max(1.0, radius);
    // Zeros for a centre are left over from a template.
    (!agrees && distance > 0.0).then_some((distance, radius))
}

/// Does a code of the block say that the words exclude each other? Then that has been reported.
fn is_told(cx: &PathCx<'_>) -> bool {
    let codes = cx.codes();
    let mut codes = codes.iter().filter_map(|ix| cx.control().code_at(*ix));
    codes.any(|code| code.entry().not_together.iter().flatten().any(|letters| letters == "R"))
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::check_rule;

    #[test]
    fn the_radius_is_marked() {
        check_rule(
            &RULE,
            "haas-mill",
            "G17 G20 G90 G0 X0. Y0.\nG2 X1. I.5 R.5 F10.\nX2. I.5 R.5\nM30\n",
            &expect![[r#"
                2 | G2 X1. I.5 R.5 F10.
                  |            ^^^ warning[arc-centre-and-radius] arc with a centre and a radius (`R`)
                3 | X2. I.5 R.5
                  |         ^^^ warning[arc-centre-and-radius] arc with a centre and a radius (`R`)
            "#]],
        );
    }

    #[test]
    fn where_the_radius_wins_a_centre_must_agree_with_it() {
        check_rule(
            &RULE,
            "fanuc-mill",
            "G17 G21 G90 G0 X0. Y0.\nG2 X20. I10. J0. R11. F100.\nG18 X20. Z0. R10. K10.01\n#1=11.\nG17 X40. Y0. I10. R[#1-1.]\nX60. I10. R#1\nX80. I#500 R11.\nX100. I0. J0. R11.\nM30\n",
            &expect![[r#"
                2 | G2 X20. I10. J0. R11. F100.
                  |                  ^^^^ warning[arc-centre-and-radius] centre and radius of the arc contradict each other (`R`)
                6 | X60. I10. R#1
                  |           ^^^ warning[arc-centre-and-radius] centre and radius of the arc contradict each other (`R`)
            "#]],
        );
    }

    #[test]
    fn where_the_radius_wins_nothing_is_wrong() {
        check_rule(
            &RULE,
            "fanuc-mill",
            "G17 G21 G90 G0 X0. Y0.\nG2 X10. I5. R5. F100.\nM30\n",
            &expect![[""]],
        );
    }
}
