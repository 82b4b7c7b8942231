//! A cylinder whose diameter the program does not give.

use std::ops::Range;

use gcheck_controls::Effect;
use gcheck_engine::{Cylinder, Event};
use gcheck_program::Word;

use crate::declare::declare_rule;
use crate::{PathCx, PathRule, Report, Run, Watch};

declare_rule! {
    /// Cylindrical mapping begins without a size, and no earlier block gave the rotary axis a size.
    ///
    /// ## Why it matters
    /// The diameter is the last one that any program gave this axis since power-on, else that of the control's setting.
    /// A contour that is wrapped around the wrong diameter is stretched, and ends in the wrong place.
    ///
    /// ## Reported
    /// ```nc,reported,haas-mill
    /// G107 Y0. A0.
    /// G1 Y1. F10.
    /// M30
    /// ```
    /// ## Not reported
    /// ```nc,quiet,haas-mill
    /// G107 Y0. A0. Q2.5
    /// G1 Y1. F10.
    /// M30
    /// ```
    /// The size from an earlier block remains in effect.
    /// ```nc,quiet,haas-mill
    /// G107 A0. R1.25
    /// G107 Y0. A0.
    /// G1 Y1. F10.
    /// M30
    /// ```
    rule "cylinder-diameter-from-setting" in "mapping" {
        summary: "cylinder whose diameter the program does not give",
        severity: Info,
        tier: Path,
        since: "0.1.0",
        run: Run::Path { watch: Watch::CHANGES, make: || Box::new(CylinderDiameterFromSetting) },
    }
}

struct CylinderDiameterFromSetting;

impl PathRule for CylinderDiameterFromSetting {
    fn changed(&mut self, cx: &PathCx<'_>, event: &Event, report: &mut Report<'_>) {
        let Event::Cylinder(Some(cylinder)) = event else { return };
        let given = cx.state().diameters().of(cylinder.rotary);
        // A called program may rely on the size that its caller gave.
        if given.is_some_and(|size| size != 0.0) || given.is_none() && cx.is_called_only() {
            return;
        }
        judge(cx, cylinder, given.is_some(), report);
    }
}

fn judge(cx: &PathCx<'_>, cylinder: &Cylinder, gone_back: bool, report: &mut Report<'_>) {
    let Some(rules) = &cx.model.semantics().cylinder else { return };
    let axis = cylinder.rotary.name();
    let setting = cx.environment.machine.engine.cylinder_setting(cylinder.rotary, rules);
    // The setting is configured.
    if setting.is_some_and(|number| cx.environment.machine.settings.contains_key(number)) {
        return;
    }
    let name = cx.name_of_effect(Effect::CylinderMapping).unwrap_or_default();
    let of_setting = setting.and_then(|number| cx.control().setting(number)).map_or_else(
        || "the control's setting".to_owned(),
        |entry| format!("setting {} ({})", entry.number, entry.title),
    );
    let mut finding = cx
        .finding(
            &META,
            if gone_back { size_range(cx) } else { code_range(cx) },
            if gone_back {
                format!("a size of zero leaves the cylinder's diameter to a setting (`{name}`)")
            } else {
                format!("the cylinder's diameter is not in the program (`{name}`)")
            },
        )
        .note(if gone_back {
            format!("the last size of {axis} is zero, so {of_setting} counts")
        } else {
            format!(
                "without a size the last one that {axis} was given since power-on counts, by whatever program, else \
                 {of_setting}"
            )
        })
        .help(format!("give the diameter with `Q` or the radius with `R`, or configure {of_setting}"));
    finding = if gone_back {
        finding.label(format!("{axis} uses {of_setting}"))
    } else {
        finding.label(format!("no earlier block gives {axis} a size"))
    };
    report.add(finding);
}

/// Bytes of the code.
fn code_range(cx: &PathCx<'_>) -> Range<u32> {
    cx.effect_range(|effect| effect == Effect::CylinderMapping)
}

/// Bytes of the word that gives a size, else of the code.
fn size_range(cx: &PathCx<'_>) -> Range<u32> {
    let is_size = |word: &Word| matches!(word.letter.ascii(), b'Q' | b'R');
    cx.find_word(cx.origin().at, is_size).unwrap_or_else(|| code_range(cx))
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::{World, check_rule, check_rule_in, findings, only, words};

    #[test]
    fn zero_goes_back_to_the_setting() {
        check_rule(
            &RULE,
            "haas-mill",
            "G107 A0. Q3.\nG107 Y0. A0. Q0.\nG107\nG107 Y0. B0.\nG107\nG107 Y0. A0. Q#1\nM30\n",
            &expect![[r#"
                2 | G107 Y0. A0. Q0.
                  |              ^^^ info[cylinder-diameter-from-setting] a size of zero leaves the cylinder's diameter to a setting (`G107`)
                4 | G107 Y0. B0.
                  | ^^^^ info[cylinder-diameter-from-setting] the cylinder's diameter is not in the program (`G107`)
                6 | G107 Y0. A0. Q#1
                  |              ^^^ info[cylinder-diameter-from-setting] a size of zero leaves the cylinder's diameter to a setting (`G107`)
            "#]],
        );
    }

    #[test]
    fn a_setting_that_is_told_is_enough() {
        let mut world = World::default();
        world.machine.settings.insert("34".to_owned(), "4".to_owned());
        world.machine.engine.settings.insert("34".to_owned(), "4".to_owned());
        check_rule_in(
            &RULE,
            "haas-mill",
            "G107 Y0. A0.\nG107 Y0. B0.\nM30\n",
            &world,
            &expect![[r#"
            2 | G107 Y0. B0.
              | ^^^^ info[cylinder-diameter-from-setting] the cylinder's diameter is not in the program (`G107`)
        "#]],
        );
    }

    #[test]
    fn a_called_program_may_count_on_its_caller() {
        check_rule(&RULE, "haas-mill", "O2000\nG107 Y0. A0.\nM99\n", &expect![[""]]);
    }

    #[test]
    fn a_size_on_some_path_is_left_to_the_reader() {
        check_rule(
            &RULE,
            "haas-mill",
            "IF [#100 EQ 1] GOTO 5\nG107 A0. Q3.\nN5 G107 Y0. A0.\nM30\n",
            &expect![[""]],
        );
    }

    #[test]
    fn what_it_says() {
        let say = |program: &str| {
            let found = findings(&only(&RULE), "haas-mill", program, &World::default());
            found.iter().map(words).collect::<String>()
        };
        expect![[r#"
            the cylinder's diameter is not in the program (`G107`)
              here: no earlier block gives A a size
              note: without a size the last one that A was given since power-on counts, by whatever program, else setting 34 (4th axis diameter)
              help: give the diameter with `Q` or the radius with `R`, or configure setting 34 (4th axis diameter)
        "#]].assert_eq(&say("G107 Y0. A0.\nM30\n"));
        expect![[r#"
            a size of zero leaves the cylinder's diameter to a setting (`G107`)
              here: A uses setting 34 (4th axis diameter)
              note: the last size of A is zero, so setting 34 (4th axis diameter) counts
              help: give the diameter with `Q` or the radius with `R`, or configure setting 34 (4th axis diameter)
        "#]].assert_eq(&say("G107 Y0. A0. Q0.\nM30\n"));
    }
}
