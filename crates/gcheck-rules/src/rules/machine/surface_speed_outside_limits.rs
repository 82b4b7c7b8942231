//! A surface speed outside the limits of the tool.

use std::collections::BTreeSet;

use gcheck_controls::Effect;
use gcheck_engine::{Abstract, At, Domain, Event, Fact, Role, Spindle, Units};
use gcheck_geometry::Rpm;

use crate::declare::declare_rule;
use crate::facts::cutting::is_cut;
use crate::facts::edge;
use crate::facts::turning::turns_the_part;
use crate::{PathCx, PathRule, Report, Run, Uses, Watch};
use crate::{Remembers, remembers};

declare_rule! {
    /// The edge of the tool runs slower or faster than the range that the configuration gives for the tool
    /// (`[tools] surface_speed`): its diameter times the speed of the spindle that turns it, or where the part turns the `S` of
    /// constant surface speed (`G96`).
    ///
    /// The rule is silent about tools without a range: none is guessed. Each speed is reported once.
    ///
    /// ## Why it matters
    /// An edge that runs too fast for its coating and the material burns within minutes. One that runs too slowly builds up
    /// material and breaks.
    ///
    /// ## Reported
    /// Tool 1 has a diameter of 10 mm and runs 60 to 160 m a minute:
    /// ```nc,reported,fanuc-mill
    /// G21 G90 G94 G17
    /// T1 M6
    /// S8000 M3
    /// G0 X0. Y0.
    /// G1 X50. F1000.
    /// M30
    /// ```
    /// ```nc,reported,fanuc-lathe
    /// G21 G99 G18
    /// T0101
    /// G50 S3000
    /// G96 S300 M3
    /// G0 X50. Z2.
    /// G1 Z-20. F0.2
    /// M30
    /// ```
    /// ## Not reported
    /// ```nc,quiet,fanuc-lathe
    /// G21 G99 G18
    /// T0101
    /// G50 S3000
    /// G96 S120 M3
    /// G0 X50. Z2.
    /// G1 Z-20. F0.2
    /// M30
    /// ```
    /// ```nc,quiet,fanuc-mill
    /// G21 G90 G94 G17
    /// T1 M6
    /// S4000 M3
    /// G0 X0. Y0.
    /// G1 X50. F600.
    /// M30
    /// ```
    /// ## How to fix it
    /// * Change `S` so that the edge runs within the range: the finding gives the value.
    /// * If the tool may run so, correct `surface_speed` or `diameter` under `[tools]`.
    rule "surface-speed-outside-limits" in "machine" {
        summary: "surface speed outside the tool's range",
        severity: Warning,
        tier: Path,
        since: "0.1.0",
        run: Run::Path { watch: Watch::CUTS, make: || Box::new(SurfaceSpeedOutsideLimits::default()) },
    }
}

#[derive(Default, Clone, PartialEq)]
struct SurfaceSpeedOutsideLimits {
    /// The blocks that gave the speed, or the tool, where it was reported.
    told: BTreeSet<Option<At>>,
}

remembers!(SurfaceSpeedOutsideLimits: told);

impl PathRule for SurfaceSpeedOutsideLimits {
    fn memory(&mut self) -> Remembers<'_> {
        Remembers::All(self)
    }

    fn concerns(&self, program: &Uses<'_>) -> bool {
        program.environment.machine.engine.cutting.values().any(|cutting| cutting.surface_speed.is_some())
    }

    fn cut(&mut self, cx: &PathCx<'_>, event: &Event, report: &mut Report<'_>) {
        if !is_cut(cx, event) {
            return;
        }
        let Some((number, cutting)) = edge::cutting(cx) else { return };
        let (Some((low, high)), Some(run)) = (cutting.surface_speed, runs(cx, number)) else { return };
        let speed = run.speed;
        let above = speed > high * 1.005;
        if speed.is_nan() || !above && speed >= low * 0.995 {
            return;
        }
        let set_by =
            [Fact::Speed, Fact::Tool].map(|fact| cx.definitions().set_by(fact)).into_iter().max().flatten();
        if !self.told.insert(set_by) {
            return;
        }
        let shown = |metres: f64| match cx.state().units(cx.model) {
            Some(Units::Inch) => format!("{:.0} ft/min", metres / 0.3048),
            _ => format!("{metres:.0} m/min"),
        };
        let limit = if above { high } else { low };
        let of_material = cutting.material.as_ref().map_or_else(String::new, |name| format!(" in {name}"));
        let finding = cx
            .finding(
                &META,
                cx.range(),
                format!(
                    "the edge of T{number} runs {}, {} its limit of {}{of_material}",
                    shown(speed),
                    if above { "above" } else { "below" },
                    shown(limit)
                ),
            )
            .label(run.by)
            .help(format!(
                "{}{:.0}{}, or correct the range in the configuration",
                run.set.0,
                run.set.1 * limit / speed,
                run.set.2
            ));
        report.add(cx.resting_on(finding, Fact::Speed, "the speed"));
    }
}

/// How the edge runs.
struct Runs {
    /// Metres a minute.
    speed: f64,
    /// What makes it so.
    by: String,
    /// What sets it: "turn at ", a number, " rpm".
    set: (&'static str, f64, &'static str),
}

fn runs(cx: &PathCx<'_>, tool: u32) -> Option<Runs> {
    let state = cx.state();
    let code = state.mode(Role::SpindleMode).only()?;
    let is_by_surface = cx.model.effect(code) == Effect::SurfaceSpeed;
    if !is_by_surface && cx.is_mill() {
        let (turns, tool) = (edge::turns(cx)?, cx.environment.machine.engine.tools.get(&tool)?);
        return Some(Runs {
            speed: tool.surface_speed(Rpm(turns)),
            by: format!("{turns:.0} rpm at a diameter of {}", cx.shown(tool.diameter)),
            set: ("turn at ", turns, " rpm"),
        });
    }
    if !is_by_surface || !turns_the_part(cx) || state.spindle().is_none_or(|way| way == Spindle::Stopped) {
        return None;
    }
    let number = Abstract::known(state.speed()).filter(|number| *number > 0.0)?;
    let metres = if state.units(cx.model)? == Units::Inch { number * 0.3048 } else { number };
    Some(Runs {
        speed: metres,
        by: format!("constant surface speed of {number} (`{}`)", cx.name_of(code)),
        set: ("write S", number, ""),
    })
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::{META, RULE};
    use crate::testing::{World, check_rule, check_rule_in};

    #[test]
    fn too_slow_for_this_tool_and_no_range_for_another() {
        check_rule_in(
            &RULE,
            "haas-mill",
            "G20 G90 G94 G17\nT1 M6\nS1000 M3\nG0 X0. Y0.\nG1 X5. F10.\nX6.\nT2 M6\nS8000 M3\nG1 X0. F10.\nM30\n",
            &World::of_examples(&META),
            &expect![[r#"
                5 | G1 X5. F10.
                  | ^^^^^^^^^^^ warning[surface-speed-outside-limits] the edge of T1 runs 103 ft/min, below its limit of 197 ft/min
            "#]],
        );
    }

    #[test]
    fn nothing_configured_nothing_said() {
        check_rule(&RULE, "fanuc-mill", "G21 G94\nT1 M6\nS90000 M3\nG1 X50. F900.\nM30\n", &expect![[""]]);
    }
}
