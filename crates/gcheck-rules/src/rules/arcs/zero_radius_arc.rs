//! An arc without size.

use gcheck_controls::Letter;
use gcheck_engine::{ArcFault, Fault};
use gcheck_geometry::Plane;

use crate::declare::declare_rule;
use crate::facts::arcs::{counts_least_increments, limited_by_arc_facts};
use crate::{PathCx, PathRule, Report, Run, Watch};

declare_rule! {
    /// The centre of an arc lies on its start or end, or its radius is zero.
    ///
    /// ## Why it matters
    /// There is no such arc: the control stops with an alarm, or moves straight to the end point through the part.
    ///
    /// ## Reported
    /// ```nc,reported,linuxcnc
    /// G17 G21 G90 G0 X0 Y0
    /// G2 X10 Y0 I0 J0 F100
    /// M2
    /// ```
    /// ## Not reported
    /// ```nc,quiet,linuxcnc
    /// G17 G21 G90 G0 X0 Y0
    /// G2 X10 Y0 I5 J0 F100
    /// M2
    /// ```
    rule "zero-radius-arc" in "arcs" {
        summary: "arc with a radius of zero",
        severity: Error,
        tier: Path,
        since: "0.1.0",
        run: Run::Path { watch: Watch::FAULTS, make: || Box::new(ZeroRadiusArc) },
    }
}

struct ZeroRadiusArc;

impl PathRule for ZeroRadiusArc {
    fn fault(&mut self, cx: &PathCx<'_>, fault: &Fault, report: &mut Report<'_>) {
        if *fault != Fault::Arc(ArcFault::ZeroRadius) {
            return;
        }
        if counts_least_increments(cx) || has_centre_word_across(cx) {
            return;
        }
        let is_size = |word: &gcheck_program::Word| matches!(word.letter.ascii(), b'I' | b'J' | b'K' | b'R');
        let finding = cx
            .finding(&META, cx.word_range(is_size), "arc with a radius of zero")
            .label("the centre lies on the start or the end of the arc")
            .help("give the distance from the start to the centre, or write a straight move (`G1`)");
        report.add(limited_by_arc_facts(cx, finding));
    }
}

/// Has the block the centre word of the axis that is perpendicular to its plane, and not a zero? The word is what is wrong then.
fn has_centre_word_across(cx: &PathCx<'_>) -> bool {
    let across = match cx.state().plane(cx.model) {
        Some(Plane::Xy) => 'K',
        Some(Plane::Zx) => 'J',
        Some(Plane::Yz) => 'I',
        None => return false,
    };
    cx.has_word(|word| {
        word.letter == Letter::of(across) && word.number().is_some_and(|number| number.abs() > 0.0)
    })
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::check_rule;

    #[test]
    fn the_words_of_the_centre_or_the_radius_are_marked() {
        check_rule(
            &RULE,
            "linuxcnc",
            "G17 G21 G90 G0 X0 Y0\nG2 X10 Y0 I0 J0 F100\nG3 X20 Y0 R0\nM2\n",
            &expect![[r#"
                2 | G2 X10 Y0 I0 J0 F100
                  |           ^^ error[zero-radius-arc] arc with a radius of zero
                3 | G3 X20 Y0 R0
                  |           ^^ error[zero-radius-arc] arc with a radius of zero
            "#]],
        );
    }

    #[test]
    fn the_centre_word_of_another_plane_is_reported_elsewhere() {
        check_rule(
            &RULE,
            "haas-mill",
            "G20 G90 G54 G0 X3. Y1. Z.05\nG18\nG2 I0 J.25 Z-.1 F12.\nM30\n",
            &expect![[""]],
        );
    }

    #[test]
    fn a_centre_that_is_not_known_is_not_judged() {
        check_rule(&RULE, "haas-mill", "G17 G90 G0 X1. Y0\nG2 X2. Y0 I#100 F10.\nM30\n", &expect![[""]]);
    }
}
