//! A program that moves before its units are stated.

use gcheck_controls::{Effect, LetterSet};
use gcheck_engine::Event;

use crate::declare::declare_rule;
use crate::facts::modes::ignores_distance_mode;
use crate::facts::units;
use crate::{PathCx, PathRule, Report, Run, Watch};
use crate::{Remembers, remembers};

declare_rule! {
    /// A program moves before it states inches (`G20`) or millimetres (`G21`).
    ///
    /// ## Why it matters
    /// The units are those of a setting, or of the last program. If they are wrong, every distance is 25.4 times too
    /// long or too short.
    ///
    /// ## Reported
    /// ```nc,reported,haas-mill
    /// G90 G54 G0 X1. Y2.
    /// M30
    /// ```
    /// ## Not reported
    /// ```nc,quiet,haas-mill
    /// G20 G90 G54 G0 X1. Y2.
    /// M30
    /// ```
    rule "units-not-stated" in "modal" {
        summary: "moves before `G20` or `G21` is stated",
        severity: Info,
        tier: Path,
        recommended: false,
        sets: [Strict],
        since: "0.1.0",
        run: Run::Path {
            watch: Watch::RAPIDS.union(Watch::CUTS),
            make: || Box::new(UnitsNotStated { is_done: false }),
        },
    }
}

#[derive(Clone, PartialEq)]
struct UnitsNotStated {
    is_done: bool,
}

remembers!(UnitsNotStated);

impl PathRule for UnitsNotStated {
    fn memory(&mut self) -> Remembers<'_> {
        Remembers::All(self)
    }

    fn rapid(&mut self, cx: &PathCx<'_>, _: &Event, report: &mut Report<'_>) {
        self.first_move(cx, report);
    }

    fn cut(&mut self, cx: &PathCx<'_>, _: &Event, report: &mut Report<'_>) {
        self.first_move(cx, report);
    }
}

impl UnitsNotStated {
    fn first_move(&mut self, cx: &PathCx<'_>, report: &mut Report<'_>) {
        if self.is_done {
            cx.enough();
            return;
        }
        if ignores_distance_mode(cx) || !cx.origin().letters.intersects(LetterSet::of("XYZUVW")) {
            return;
        }
        self.is_done = true;
        let is_stated = units::are_stated(cx) || cx.is_after_unknown_program();
        if is_stated || cx.is_called_only() {
            return;
        }
        let (Some(inch), Some(metric)) =
            (cx.name_of_effect(Effect::Inch), cx.name_of_effect(Effect::Millimetre))
        else {
            return;
        };
        report.add(
            cx.finding(
                &META,
                cx.range(),
                format!("moves before inches or millimetres are stated (`{inch}`, `{metric}`)"),
            )
            .label("uses the units that the control has at that moment")
            .help(format!(
                "state `{inch}` or `{metric}` at the head of the program, or configure the machine's units"
            )),
        );
    }
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::MachineFacts;
    use crate::testing::{World, check_rule, check_rule_in};

    #[test]
    fn the_first_move_is_marked() {
        check_rule(
            &RULE,
            "fanuc-lathe",
            "T0101\nG28 U0. W0.\nG0 X1. Z2.\nX2.\nM30\n",
            &expect![[r#"
            3 | G0 X1. Z2.
              | ^^^^^^^^^^ info[units-not-stated] moves before inches or millimetres are stated (`G20`, `G21`)
        "#]],
        );
    }

    #[test]
    fn configured_units_are_known() {
        let machine = MachineFacts { units_are_told: true, ..MachineFacts::default() };
        let world = World { machine, ..World::default() };
        check_rule_in(&RULE, "fanuc-mill", "G90 G54 G0 X1.\nM30\n", &world, &expect![[""]]);
    }

    #[test]
    fn a_subprogram_moves_in_the_units_of_its_caller() {
        check_rule(&RULE, "haas-mill", "O10\nG0 X1.\nM99\n", &expect![[""]]);
    }
}
