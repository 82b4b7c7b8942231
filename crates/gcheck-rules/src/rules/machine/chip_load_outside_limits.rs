//! A chip load outside the limits of the tool.

use std::collections::BTreeSet;

use gcheck_engine::{At, Event, Fact, Position, TravelKind};

use crate::declare::declare_rule;
use crate::facts::edge;
use crate::{PathCx, PathRule, Report, Run, Uses, Watch};
use crate::{Remembers, remembers};

declare_rule! {
    /// What each tooth cuts is outside the range that the configuration gives for the tool: feed over speed of the spindle
    /// over teeth (`[tools] chip_load`, `teeth`).
    ///
    /// Below the range only moves across count, because a tool plunges slower. The rule is silent about tools without a
    /// range: none is guessed. Each pair of a feed and a speed is reported once.
    ///
    /// ## Why it matters
    /// A tooth that cuts too much breaks. One that cuts too little rubs: it hardens the material and wears out.
    ///
    /// ## Reported
    /// Tool 1 has four teeth that cut 0.02 to 0.06 mm:
    /// ```nc,reported,fanuc-mill
    /// G21 G90 G94 G17
    /// T1 M6
    /// S3000 M3
    /// G0 X0. Y0.
    /// G1 X50. F1200.
    /// M30
    /// ```
    /// ## Not reported
    /// ```nc,quiet,fanuc-mill
    /// G21 G90 G94 G17
    /// T1 M6
    /// S3000 M3
    /// G0 X0. Y0.
    /// G1 X50. F600.
    /// M30
    /// ```
    /// ## How to fix it
    /// * Correct `F` or `S`: the chip load is the feed a minute, divided by the speed and by the number of teeth.
    /// * If the tool may cut so much, correct its `chip_load` or `teeth` under `[tools]`.
    rule "chip-load-outside-limits" in "machine" {
        summary: "chip load outside the tool's range",
        severity: Warning,
        tier: Path,
        since: "0.1.0",
        run: Run::Path { watch: Watch::MOVES, make: || Box::new(ChipLoadOutsideLimits::default()) },
    }
}

#[derive(Default, Clone, PartialEq)]
struct ChipLoadOutsideLimits {
    /// The blocks that gave feed or speed, whichever is later, where it was reported.
    told: BTreeSet<Option<At>>,
}

remembers!(ChipLoadOutsideLimits: told);

impl PathRule for ChipLoadOutsideLimits {
    fn memory(&mut self) -> Remembers<'_> {
        Remembers::All(self)
    }

    fn concerns(&self, program: &Uses<'_>) -> bool {
        program.environment.machine.engine.cutting.values().any(|cutting| cutting.chip_load.is_some())
    }

    fn moved(&mut self, cx: &PathCx<'_>, event: &Event, report: &mut Report<'_>) {
        let (from, to): (&Position, &Position) = match event {
            Event::Travel(travel) if travel.kind == TravelKind::Feed => (&travel.from, &travel.to),
            Event::Arc(arc) => (&arc.from, &arc.to),
            _ => return,
        };
        let Some((tool, cutting)) = edge::cutting(cx) else { return };
        let (Some((low, high)), Some((per_turn, turns))) = (cutting.chip_load, edge::feed_per_turn(cx))
        else {
            return;
        };
        let Some(load) = cutting.load(per_turn) else { return };
        // Numbers are rounded, and so are the limits.
        let above = load.0 > high * 1.005;
        let below = load.0 < low * 0.995 && edge::goes_across(from, to);
        if !above && !below {
            return;
        }
        if !self.told.insert(edge::feed_or_speed_set_by(cx)) {
            return;
        }
        let limit = if above { high } else { low };
        let teeth = cutting.teeth.unwrap_or_default();
        let of_material = cutting.material.as_ref().map_or_else(String::new, |name| format!(" in {name}"));
        let finding = cx
            .finding(
                &META,
                cx.range(),
                format!(
                    "a tooth of T{tool} cuts {}, {} its limit of {}{of_material}",
                    edge::fine(cx, load.0),
                    if above { "above" } else { "below" },
                    edge::fine(cx, limit)
                ),
            )
            .label(format!("{} a turn at {turns:.0} rpm, {teeth} teeth", edge::fine(cx, per_turn)))
            .help("correct `F` or `S`, or the range in the configuration");
        let finding = cx.resting_on(finding, Fact::Feed, "the feed");
        report.add(cx.resting_on(finding, Fact::Speed, "the speed"));
    }
}

/// Does the tool move at least as far across as along itself?
#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::{META, RULE};
    use crate::testing::{World, check_rule, check_rule_in};

    #[test]
    fn below_the_range_only_moves_across_count() {
        check_rule_in(
            &RULE,
            "linuxcnc",
            "G21 G90 G94 G17\nT1 M6\nS6000 M3\nG0 X0 Y0 Z5\nG1 Z-1 F100\nX20\nX40 F600\nM2\n",
            &World::of_examples(&META),
            &expect![[r#"
                6 | X20
                  | ^^^ warning[chip-load-outside-limits] a tooth of T1 cuts 0.0042 mm, below its limit of 0.02 mm
            "#]],
        );
    }

    #[test]
    fn a_feed_per_turn_needs_only_the_teeth() {
        check_rule_in(
            &RULE,
            "fanuc-mill",
            "G21 G90 G95 G17\nT1 M6\nS6000 M3\nG0 X0. Y0.\nG1 X20. F.5\nM30\n",
            &World::of_examples(&META),
            &expect![[r#"
                5 | G1 X20. F.5
                  | ^^^^^^^^^^^ warning[chip-load-outside-limits] a tooth of T1 cuts 0.125 mm, above its limit of 0.06 mm
            "#]],
        );
    }

    #[test]
    fn nothing_configured_nothing_said() {
        check_rule(&RULE, "fanuc-mill", "G21 G94\nT1 M6\nS100 M3\nG1 X50. F9000.\nM30\n", &expect![[""]]);
    }
}
