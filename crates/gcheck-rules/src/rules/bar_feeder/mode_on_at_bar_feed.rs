//! A mode of cutting that is still on while the bar is fed.

use gcheck_controls::{CodeIx, Effect};
use gcheck_engine::{Event, Fact, Role, Truth};

use crate::declare::declare_rule;
use crate::facts::bar_feed::{bar_feed_range, bar_feeder, lengths};
use crate::{PathCx, PathRule, Report, Run, Watch};

declare_rule! {
    /// The bar is fed (`G105`) while nose compensation, a canned cycle, polar interpolation, cylindrical mapping or a live
    /// tool is still on.
    ///
    /// ## Why it matters
    /// At the bar feed one part ends and the next begins. A mode that is left on belongs to the part that was cut off,
    /// and the next part begins with it.
    ///
    /// ## Reported
    /// ```nc,reported,haas-lathe
    /// G42 G0 X1. Z0.1
    /// G1 Z-1. F0.01
    /// M5
    /// G105 J1.75
    /// M99
    /// ```
    /// ## Not reported
    /// ```nc,quiet,haas-lathe
    /// G42 G0 X1. Z0.1
    /// G1 Z-1. F0.01
    /// G40 G0 X3.
    /// M5
    /// G105 J1.75
    /// M99
    /// ```
    rule "mode-on-at-bar-feed" in "bar_feeder" {
        summary: "bar fed while a mode of cutting is on",
        severity: Warning,
        tier: Path,
        since: "0.1.0",
        run: Run::Path { watch: Watch::CHANGES, make: || Box::new(ModeOnAtBarFeed) },
    }
}

struct ModeOnAtBarFeed;

impl PathRule for ModeOnAtBarFeed {
    fn changed(&mut self, cx: &PathCx<'_>, event: &Event, report: &mut Report<'_>) {
        if bar_feeder(cx).is_none() || lengths(event).is_none() {
            return;
        }
        for role in [Role::Compensation, Role::Cycle, Role::PolarInterpolation, Role::Cylinder] {
            let Some(code) = cx.state().mode(role).only().filter(|code| *code != CodeIx::NONE) else {
                continue;
            };
            let Some((what, off)) = on(cx.model.effect(code), role) else { continue };
            let name = cx.name_of(code);
            let off = off.and_then(|off| cx.name_of_effect(off)).unwrap_or_else(|| name.clone());
            let finding = cx
                .finding(
                    &META,
                    bar_feed_range(cx),
                    format!("{what} is still on while the bar is fed (`{name}`)"),
                )
                .label("the next part begins with it")
                .help(format!("end it with `{off}` before the bar is fed"));
            report.add(cx.resting_on(finding, Fact::Mode(role), &format!("`{name}`")));
        }
        if cx.state().live_tool() == Truth::True {
            let off = cx.name_of_effect(Effect::LiveToolOff).unwrap_or_default();
            report.add(
                cx.finding(&META, bar_feed_range(cx), "live tool still turns while the bar is fed")
                    .label("the turret may be near the bar")
                    .help(format!("stop it with `{off}` before the bar is fed")),
            );
        }
    }
}

/// What is on, and the effect that ends it.
fn on(effect: Effect, role: Role) -> Option<(&'static str, Option<Effect>)> {
    Some(match (role, effect) {
        (Role::Compensation, Effect::CompensationLeft | Effect::CompensationRight) => {
            ("nose compensation", Some(Effect::CompensationOff))
        }
        (Role::Cycle, effect) if effect != Effect::CycleCancel => ("canned cycle", Some(Effect::CycleCancel)),
        (Role::PolarInterpolation, Effect::PolarInterpolationOn) => {
            ("polar interpolation", Some(Effect::PolarInterpolationOff))
        }
        (Role::Cylinder, Effect::CylinderMapping) => ("cylindrical mapping", None),
        _ => return None,
    })
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::check_rule;

    #[test]
    fn cycles_live_tools_and_interpolation() {
        check_rule(
            &RULE,
            "haas-lathe",
            "G0 X0. Z0.1\nG97 S800 M3\nG83 Z-1. Q0.2 R0.1 F0.004\nM5\nG105 J1.75\nG80\nG105 J1.75\nM30\n",
            &expect![[r#"
                5 | G105 J1.75
                  | ^^^^ warning[mode-on-at-bar-feed] canned cycle is still on while the bar is fed (`G83`)
            "#]],
        );
        check_rule(
            &RULE,
            "haas-lathe",
            "M133 P1000\nG112\nM5\nG105 J1.75\nM30\n",
            &expect![[r#"
            4 | G105 J1.75
              | ^^^^ warning[mode-on-at-bar-feed] live tool still turns while the bar is fed
            4 | G105 J1.75
              | ^^^^ warning[mode-on-at-bar-feed] polar interpolation is still on while the bar is fed (`G112`)
        "#]],
        );
    }

    #[test]
    fn what_the_cutoff_program_ends_is_off() {
        check_rule(
            &RULE,
            "haas-lathe",
            "O1\nG42 G0 X1. Z0.1\nG105 J1.75 P2\nM30\nO2\nG40 G0 X3.\nM99\n",
            &expect![[""]],
        );
    }

    #[test]
    fn on_some_path_it_is_named_with_its_condition() {
        check_rule(
            &RULE,
            "haas-lathe",
            "IF [#500 EQ 1] GOTO 5\nG42 G0 X1. Z0.1\nN5 M5\nG105 J1.75\nM30\n",
            &expect![[r#"
                4 | G105 J1.75
                  | ^^^^ info[mode-on-at-bar-feed] nose compensation is still on while the bar is fed (`G42`), when `#500` is not 1
            "#]],
        );
    }
}
