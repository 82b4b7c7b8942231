//! Inches and millimetres in one program.

use gcheck_controls::Effect;
use gcheck_engine::{Event, Fact, Role, Units};

use crate::declare::declare_rule;
use crate::{PathCx, PathRule, Report, Run, Severity, Uses, Watch};
use crate::{Remembers, remembers};

declare_rule! {
    /// A program changes from inches to millimetres, or back, after it has moved.
    ///
    /// ## Why it matters
    /// Everything after it counts 25.4 times as much or as little: positions, and on most controls the feed and the
    /// offsets that were given before. Often a section of another program was pasted in.
    ///
    /// ## Reported
    /// ```nc,reported,fanuc-mill
    /// G20 G90 G54
    /// G0 X1. Y1.
    /// G21
    /// G0 X10. Y10.
    /// M30
    /// ```
    /// ## Not reported
    /// ```nc,quiet,fanuc-mill
    /// G20 G90 G54
    /// G0 X1. Y1.
    /// G20
    /// G0 X2.
    /// M30
    /// ```
    rule "units-changed" in "modal" {
        summary: "units changed within a program",
        severity: Warning,
        tier: Path,
        since: "0.1.0",
        run: Run::Path {
            watch: Watch::BLOCKS.union(Watch::RAPIDS).union(Watch::CUTS),
            make: || Box::new(UnitsChanged { has_moved: false, is_told: false }),
        },
    }
}

#[derive(Clone, PartialEq)]
struct UnitsChanged {
    has_moved: bool,
    is_told: bool,
}

remembers!(UnitsChanged);

impl PathRule for UnitsChanged {
    fn memory(&mut self) -> Remembers<'_> {
        Remembers::All(self)
    }

    fn concerns(&self, program: &Uses<'_>) -> bool {
        program.may(|effect| effect == Effect::Inch) && program.may(|effect| effect == Effect::Millimetre)
    }

    fn block(&mut self, cx: &PathCx<'_>, report: &mut Report<'_>) {
        let units = |effect| match effect {
            Effect::Inch => Some(Units::Inch),
            Effect::Millimetre => Some(Units::Mm),
            _ => None,
        };
        let is_units = |effect| units(effect).is_some();
        if !self.has_moved || self.is_told || cx.depth() > 1 || !cx.has_effect(is_units) {
            return;
        }
        let new = cx.codes().iter().rev().find_map(|code| units(cx.model.effect(*code)));
        let fact = Fact::Mode(Role::Units);
        let (Some(new), Some(old)) = (new, cx.state().units(cx.model)) else { return };
        let Some(code) = cx.state().mode(Role::Units).only() else { return };
        if new == old || cx.definitions().set_by(fact).is_none() {
            return;
        }
        self.is_told = true;
        let name = |units| match units {
            Units::Inch => "inches",
            Units::Mm => "millimetres",
        };
        let message = format!("the program changes from {} to {}", name(old), name(new));
        let finding = cx
            .finding(&META, cx.effect_range(is_units), message)
            .label(format!("from here on numbers count {}", name(new)))
            .help("write the program in one unit; check what was pasted in");
        // Where a setting fixes the unit, one of the two codes is an alarm.
        let finding = match &cx.model.semantics().units_setting {
            Some(number) => {
                finding.note(format!("setting {number} fixes the unit: one of the two codes is an alarm"))
            }
            None => finding.at_most(Severity::Info),
        };
        report.add(cx.resting_on(finding, fact, &format!("`{}`", cx.name_of(code))));
    }

    fn rapid(&mut self, cx: &PathCx<'_>, _: &Event, _: &mut Report<'_>) {
        self.has_moved = true;
        cx.enough();
    }

    fn cut(&mut self, cx: &PathCx<'_>, _: &Event, _: &mut Report<'_>) {
        self.has_moved = true;
        cx.enough();
    }
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::check_rule;

    #[test]
    fn the_change_is_marked_once() {
        check_rule(
            &RULE,
            "linuxcnc",
            "G20\nG0 X1\nG21\nG0 X10\nG20\nG0 X1\nM2\n",
            &expect![[r#"
                3 | G21
                  | ^^^ info[units-changed] the program changes from inches to millimetres
            "#]],
        );
    }

    #[test]
    fn before_the_first_move_nothing_has_counted() {
        check_rule(&RULE, "linuxcnc", "G20\nG21\nG0 X1\nM2\n", &expect![[""]]);
    }
}
