//! A cylinder's code that names the rotary axis and nothing for it to do.

use gcheck_controls::{Effect, LetterSet};
use gcheck_program::BlockFlags;

use crate::declare::declare_rule;
use crate::facts::word_sets::choice;
use crate::{BlockCx, Finding, Reads, Report, Run, limit};

declare_rule! {
    /// Cylindrical mapping names the rotary axis, and neither the linear axis to wrap around it nor a size.
    ///
    /// ## Why it matters
    /// The linear axis is what begins the mapping. Without it the block changes nothing, and the next moves are straight ones
    /// beside the part that was to turn.
    ///
    /// ## Reported
    /// ```nc,reported,haas-mill
    /// G107 A0.
    /// ```
    /// ## Not reported
    /// A size alone is the new size of the cylinder.
    /// ```nc,quiet,haas-mill
    /// G107 A0. Y0.
    /// G107 A0. Q2.5
    /// G107
    /// ```
    rule "cylinder-begins-nothing" in "mapping" {
        summary: "cylinder without the axis to wrap around it, and without a size",
        severity: Warning,
        tier: Block,
        since: "0.1.0",
        run: Run::BlockAndValues { trigger: BlockFlags::CODE, reads: Reads::Codes, check },
    }
}

const LINEAR: LetterSet = LetterSet::of("XYZ");
const ROTARY: LetterSet = LetterSet::of("ABC");
const SIZES: LetterSet = LetterSet::of("QR");

fn check(cx: &BlockCx<'_>, report: &mut Report<'_>) {
    if cx.control().semantics().cylinder.is_none() {
        return;
    }
    let Some((_, code)) = cx.codes().find(|(_, code)| code.effect() == Effect::CylinderMapping) else {
        return;
    };
    let letters = cx.block().letters;
    if letters.intersects(LINEAR.or(SIZES)) {
        return;
    }
    let rotary = code.reads().or(code.disputed()).and(ROTARY);
    let Some(word) = cx.words().iter().find(|word| rotary.contains(word.letter)) else { return };
    let (name, entry) = (cx.written(code), code.entry());
    report.add(
        Finding::new(&META, cx.range(word), format!("this block does not begin a cylinder (`{name}`)"))
            .label("the rotary axis alone changes nothing")
            .note(format!(
                "`{}` ({}) begins with the linear axis that is wrapped around the part  [{}]",
                entry.code, entry.title, entry.source
            ))
            .help(format!("name the axis to wrap beside it ({}): `Y0.`", choice(code.reads().and(LINEAR))))
            .at_most(limit(entry.confidence)),
    );
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::check_rule;

    #[test]
    fn the_rotary_axis_is_marked() {
        check_rule(
            &RULE,
            "haas-mill",
            "G107 A0.\nG107 B#1\nG107 A0. R2.\nG107 A0. X0.\nG107\nG107 C0.\n",
            &expect![[r#"
                1 | G107 A0.
                  |      ^^^ warning[cylinder-begins-nothing] this block does not begin a cylinder (`G107`)
                2 | G107 B#1
                  |      ^^^ warning[cylinder-begins-nothing] this block does not begin a cylinder (`G107`)
                6 | G107 C0.
                  |      ^^^ warning[cylinder-begins-nothing] this block does not begin a cylinder (`G107`)
            "#]],
        );
    }

    #[test]
    fn an_angle_that_is_a_radius_is_another_form() {
        check_rule(&RULE, "fanuc-mill", "G107 C50.\nG107 C0\n", &expect![[""]]);
    }
}
