//! A move beyond the configured travel.

use gcheck_controls::Effect;
use gcheck_engine::{Axis, Event, Position};
use gcheck_geometry::Mm;

use crate::declare::declare_rule;
use crate::{PathCx, PathRule, Report, Run, Severity, Uses, Watch};
use crate::{Remembers, remembers};

declare_rule! {
    /// A move ends outside the configured travel of an axis.
    ///
    /// The rule needs the configured travel and a known position in machine coordinates: from the configured work
    /// offsets and tool lengths, or because the block is in machine coordinates (`G53`).
    ///
    /// ## Why it matters
    /// The control stops with a soft limit alarm in the middle of the part, or the axis runs into the limit switch.
    ///
    /// ## Reported
    /// With 500 mm of travel each way and `G54` at machine zero:
    /// ```nc,reported,fanuc-mill
    /// G21 G90 G54 G0 X10. Y0.
    /// X600.
    /// M30
    /// ```
    /// ## Not reported
    /// ```nc,quiet,fanuc-mill
    /// G21 G90 G54 G0 X10. Y0.
    /// X400.
    /// M30
    /// ```
    /// The position of `G55` is not configured.
    /// ```nc,quiet,fanuc-mill
    /// G21 G90 G55 G0 X600. Y0.
    /// M30
    /// ```
    /// ## How to fix it
    /// * Check the work offset and the tool length in `gcheck.toml`: a sign or a digit there moves everything.
    /// * If they are right, move the part on the table, or turn it.
    /// * If the axis goes further, correct `travel` under `[machine]`.
    rule "move-outside-travel" in "machine" {
        summary: "move beyond the configured travel",
        severity: Error,
        tier: Path,
        since: "0.1.0",
        run: Run::Path { watch: Watch::MOVES, make: || Box::new(MoveOutsideTravel { is_outside: [false; 9] }) },
    }
}

#[derive(Clone, PartialEq)]
struct MoveOutsideTravel {
    /// By axis: the last move ended outside, so further moves are not reported again.
    is_outside: [bool; 9],
}

remembers!(MoveOutsideTravel);

impl PathRule for MoveOutsideTravel {
    fn memory(&mut self) -> Remembers<'_> {
        Remembers::All(self)
    }

    fn concerns(&self, program: &Uses<'_>) -> bool {
        !program.environment.machine.engine.travel.is_empty()
    }

    fn moved(&mut self, cx: &PathCx<'_>, event: &Event, report: &mut Report<'_>) {
        let travel = &cx.environment.machine.engine.travel;
        let Some(to) = end_of(event) else { return };
        let machine = machine_words(cx)
            .unwrap_or_else(|| cx.state().to_machine(&to, cx.model, &cx.environment.machine.engine));
        for (axis, (lowest, highest)) in travel {
            let Some(told) = self.is_outside.get_mut(axis.index()) else { continue };
            let Some(value) = machine.get(*axis) else {
                *told = false;
                continue;
            };
            // A control decides what is outside in its own increments.
            let beyond = (lowest - value).max(value - highest);
            let is_outside = beyond > 1e-3;
            if std::mem::replace(told, is_outside) || !is_outside {
                continue;
            }
            let shown = |value: f64| {
                if axis.is_rotary() { format!("{value:.3}°") } else { cx.shown(Mm(value)) }
            };
            let end = if value > *highest { "upper" } else { "lower" };
            let limit = if value > *highest { *highest } else { *lowest };
            let name = axis.name();
            let finding = cx
                .finding(
                    &META,
                    cx.letter_range(name),
                    format!("`{name}` goes {} beyond the machine's travel", shown(beyond)),
                )
                .label(format!("machine position {}, {end} limit {}", shown(value), shown(limit)))
                .help("check the work offset and the tool length that are configured, or move the part");
            report.add(if cx.is_on_every_path() { finding } else { finding.at_most(Severity::Warning) });
        }
    }
}

/// The point of a block in machine coordinates, which needs no work offset to be known.
fn machine_words(cx: &PathCx<'_>) -> Option<Position> {
    if !cx.has_effect(|effect| effect == Effect::MachineCoordinates) {
        return None;
    }
    let (units, place) = (cx.state().units(cx.model)?, cx.place()?);
    let mut point = Position::UNKNOWN;
    for word in place.table.words(place.block()) {
        // A number without a point may count something smaller than a unit.
        if let (Some(axis), Some(value), true) = (Axis::of(word.letter), word.number(), word.shape.point) {
            let value = if axis.is_rotary() { value } else { value * units.in_mm() };
            let is_diameter = axis == Axis::X && cx.state().is_diameter(cx.model) != Some(false);
            point.set(axis, if is_diameter { value / 2.0 } else { value });
        }
    }
    Some(point)
}

fn end_of(event: &Event) -> Option<Position> {
    match event {
        Event::Travel(travel) => Some(travel.to),
        Event::Arc(arc) => Some(arc.to),
        Event::Curve(curve) => Some(curve.to),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::{META, RULE};
    use crate::testing::{World, check_rule, check_rule_in};

    #[test]
    fn the_word_that_leads_out_is_marked_once() {
        check_rule_in(
            &RULE,
            "fanuc-mill",
            "G21 G90 G54 G0 X0. Y0.\nX600.\nX610.\nX0.\nG1 Y-500.5 F100.\nM30\n",
            &World::of_examples(&META),
            &expect![[r#"
                2 | X600.
                  | ^^^^^ error[move-outside-travel] `X` goes 100 mm beyond the machine's travel
                5 | G1 Y-500.5 F100.
                  |    ^^^^^^^ error[move-outside-travel] `Y` goes 0.5 mm beyond the machine's travel
            "#]],
        );
    }

    #[test]
    fn machine_coordinates_are_compared_as_they_stand() {
        check_rule_in(
            &RULE,
            "haas-mill",
            "G20 G90 G55\nG53 G0 Z-20.\nM30\n",
            &World::of_examples(&META),
            &expect![[r#"
                2 | G53 G0 Z-20.
                  |        ^^^^^ error[move-outside-travel] `Z` goes 0.315 in beyond the machine's travel
            "#]],
        );
    }

    #[test]
    fn nothing_configured_nothing_said() {
        check_rule(&RULE, "fanuc-mill", "G21 G90 G53 G0 X9000.\nM30\n", &expect![[""]]);
    }
}
