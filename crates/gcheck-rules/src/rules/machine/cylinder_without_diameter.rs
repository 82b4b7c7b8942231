//! A cylinder without a diameter.

use gcheck_controls::Effect;
use gcheck_engine::Event;

use crate::declare::declare_rule;
use crate::{PathCx, PathRule, Report, Run, Watch};

declare_rule! {
    /// Cylindrical mapping begins with a diameter of zero: the program does not give one, and the control's setting is
    /// zero.
    ///
    /// ## Why it matters
    /// With a diameter of zero a length has no angle. The control stops, or the rotary axis moves unpredictably.
    ///
    /// ## Reported
    /// With `34 = 0` under `[settings]`:
    /// ```nc,reported,haas-mill
    /// G107 Y0. A0. Q0.
    /// G1 Y1. F10.
    /// M30
    /// ```
    /// ## Not reported
    /// ```nc,quiet,haas-mill
    /// G107 Y0. A0. Q2.5
    /// G1 Y1. F10.
    /// M30
    /// ```
    /// ## How to fix it
    /// * Give the diameter with `Q`, or the radius with `R`, in the block that begins the mapping.
    /// * Or give the setting the diameter of the part, on the control and in `[settings]` of `gcheck.toml`.
    rule "cylinder-without-diameter" in "machine" {
        summary: "cylinder with a diameter of zero",
        severity: Warning,
        tier: Path,
        since: "0.1.0",
        run: Run::Path { watch: Watch::CHANGES, make: || Box::new(CylinderWithoutDiameter) },
    }
}

struct CylinderWithoutDiameter;

impl PathRule for CylinderWithoutDiameter {
    fn changed(&mut self, cx: &PathCx<'_>, event: &Event, report: &mut Report<'_>) {
        let Event::Cylinder(Some(cylinder)) = event else { return };
        if cylinder.diameter != 0.0 {
            return;
        }
        let Some(rules) = &cx.model.semantics().cylinder else { return };
        let axis = cylinder.rotary.name();
        let setting = cx.environment.machine.engine.cylinder_setting(cylinder.rotary, rules);
        let setting = setting.unwrap_or_default();
        let name = cx.name_of_effect(Effect::CylinderMapping).unwrap_or_default();
        let finding = cx
            .finding(
                &META,
                cx.effect_range(|effect| effect == Effect::CylinderMapping),
                format!("the cylinder has no diameter (`{name}`)"),
            )
            .label(format!("neither the program nor setting {setting} gives {axis} one"))
            .note(format!("setting {setting} is 0, and the control uses it when the size is zero"))
            .help("give the diameter with `Q` or the radius with `R`");
        report.add(match cx.state().diameters().of(cylinder.rotary) {
            Some(_) => finding,
            None => {
                finding.assuming(format!("no program before this one gave cylinders on {axis} a diameter"))
            }
        });
    }
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::{World, check_rule, check_rule_in, findings, only, words};

    fn world() -> World<'static> {
        let mut world = World::default();
        for settings in [&mut world.machine.settings, &mut world.machine.engine.settings] {
            settings.insert("34".to_owned(), "0".to_owned());
        }
        world
    }

    #[test]
    fn a_setting_of_zero_is_no_diameter() {
        let program = "G107 Y0. A0.\nG107 A0. Q2.\nG107 Y0. A0.\nG107 Y0. A0. R0.\nM30\n";
        check_rule_in(
            &RULE,
            "haas-mill",
            program,
            &world(),
            &expect![[r#"
            1 | G107 Y0. A0.
              | ^^^^ warning[cylinder-without-diameter] the cylinder has no diameter (`G107`)
            4 | G107 Y0. A0. R0.
              | ^^^^ warning[cylinder-without-diameter] the cylinder has no diameter (`G107`)
        "#]],
        );
    }

    #[test]
    fn a_setting_that_nobody_told_may_be_anything() {
        check_rule(&RULE, "haas-mill", "G107 Y0. A0. Q0.\nM30\n", &expect![[""]]);
    }

    #[test]
    fn what_it_says() {
        let found = findings(&only(&RULE), "haas-mill", "G107 Y0. A0.\nM30\n", &world());
        expect![[r#"
            the cylinder has no diameter (`G107`)
              here: neither the program nor setting 34 gives A one
              note: setting 34 is 0, and the control uses it when the size is zero
              assuming: no program before this one gave cylinders on A a diameter
              help: give the diameter with `Q` or the radius with `R`
        "#]]
        .assert_eq(&found.iter().map(words).collect::<String>());
    }
}
