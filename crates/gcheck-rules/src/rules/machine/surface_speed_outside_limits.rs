//! A surface speed outside the limits of the tool.

use std::collections::BTreeSet;

use gcheck_engine::{At, Event, Fact, Units};
use gcheck_geometry::Rpm;

use crate::declare::declare_rule;
use crate::facts::cutting::is_cut;
use crate::facts::edge;
use crate::{PathCx, PathRule, Report, Run, Uses, Watch};
use crate::{Remembers, remembers};

declare_rule! {
    /// The edge of the tool runs slower or faster than the range that the configuration gives for the tool: its diameter times
    /// the speed of the spindle (`[tools] surface_speed`, `diameter`).
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
    /// ## Not reported
    /// ```nc,quiet,fanuc-mill
    /// G21 G90 G94 G17
    /// T1 M6
    /// S4000 M3
    /// G0 X0. Y0.
    /// G1 X50. F600.
    /// M30
    /// ```
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
        if !cx.is_mill() || !is_cut(cx, event) {
            return;
        }
        let Some((number, cutting)) = edge::cutting(cx) else { return };
        let (Some((low, high)), Some(turns)) = (cutting.surface_speed, edge::turns(cx)) else { return };
        let Some(tool) = cx.environment.machine.engine.tools.get(&number) else { return };
        let speed = tool.surface_speed(Rpm(turns));
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
            .label(format!("{turns:.0} rpm at a diameter of {}", cx.shown(tool.diameter)))
            .help(format!(
                "turn at {:.0} rpm, or correct the range in the configuration",
                turns * limit / speed
            ));
        report.add(cx.resting_on(finding, Fact::Speed, "the speed"));
    }
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
