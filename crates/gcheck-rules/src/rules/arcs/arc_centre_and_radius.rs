//! An arc that gives its centre and its radius.

use gcheck_engine::{ArcFault, Fault};

use crate::declare::declare_rule;
use crate::{PathCx, PathRule, Report, Run, Watch, limit};

declare_rule! {
    /// A block under an arc mode gives a centre and a radius, on a control that takes one of them.
    ///
    /// Where the control's page excludes the two words from a block with `G2` or `G3`, `words-exclude-each-other`
    /// reports that block.
    ///
    /// ## Why it matters
    /// The control stops with an alarm: it cannot know which of the two was meant.
    ///
    /// ## Reported
    /// ```nc,reported,linuxcnc
    /// G17 G21 G90 G0 X0 Y0
    /// G2 X10 Y0 I5 F100
    /// X20 I5 R5
    /// M2
    /// ```
    /// ## Not reported
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
        run: Run::Path { watch: Watch::FAULTS, make: || Box::new(ArcCentreAndRadius) },
    }
}

struct ArcCentreAndRadius;

impl PathRule for ArcCentreAndRadius {
    fn fault(&mut self, cx: &PathCx<'_>, fault: &Fault, report: &mut Report<'_>) {
        if *fault != Fault::Arc(ArcFault::CentreAndRadius) || is_told(cx) {
            return;
        }
        let is_centre = |word: &gcheck_program::Word| matches!(word.letter.ascii(), b'I' | b'J' | b'K');
        report.add(
            cx.finding(&META, cx.letter_range('R'), "arc with a centre and a radius (`R`)")
                .label("an arc takes only one of the two")
                .also(cx.word_range(is_centre), "the centre is given here")
                .help("remove the centre or the radius")
                .fix_if(cx.removal_of('R', "remove the radius"))
                .at_most(limit(cx.model.semantics().confidence)),
        );
    }
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
    fn where_the_radius_wins_nothing_is_wrong() {
        check_rule(
            &RULE,
            "fanuc-mill",
            "G17 G21 G90 G0 X0. Y0.\nG2 X10. I5. R5. F100.\nM30\n",
            &expect![[""]],
        );
    }
}
