//! Inches and millimetres in one program.

use gcheck_controls::Effect;
use gcheck_engine::{At, Event, Fact, Role, Units};

use crate::declare::declare_rule;
use crate::{PathCx, PathRule, Report, Run, Severity, Uses, Watch};
use crate::{Remembers, remembers};

declare_rule! {
    /// A program changes from inches to millimetres, or back, after it has moved; or a subprogram changes the units that its caller
    /// has chosen, and the caller moves on. Moves to places of the machine (`G53`, `G28`) do not count.
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
            make: || Box::new(UnitsChanged::default()),
        },
    }
}

#[derive(Default, Clone, PartialEq)]
struct UnitsChanged {
    has_moved: bool,
    is_told: bool,
    /// The units of the last move of the main program, and the block that set them.
    main: Option<Units>,
    main_set: Option<At>,
    /// The last block of the main program that chose units.
    own: Option<At>,
}

remembers!(UnitsChanged: main_set, own);

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
        if cx.depth() == 1 && cx.has_effect(is_units) {
            self.own = Some(cx.origin().at);
        }
        if !self.has_moved || self.is_told || cx.depth() > 1 || !cx.has_effect(is_units) {
            return;
        }
        let new = cx.codes().iter().rev().find_map(|code| units(cx.model.effect(*code)));
        let fact = Fact::Mode(Role::Units);
        let (Some(new), Some(old)) = (new, cx.state().units(cx.model)) else { return };
        let Some(code) = cx.state().mode(Role::Units).only() else { return };
        // After a subprogram, the units of its caller again.
        let is_back = self.main == Some(new) && cx.definitions().set_by(fact) != self.main_set;
        if new == old || is_back || cx.definitions().set_by(fact).is_none() {
            return;
        }
        self.is_told = true;
        let message = format!("the program changes from {} to {}", words(old), words(new));
        let finding = cx
            .finding(&META, cx.effect_range(is_units), message)
            .label(format!("from here on numbers count {}", words(new)))
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

    fn rapid(&mut self, cx: &PathCx<'_>, _: &Event, report: &mut Report<'_>) {
        self.moves(cx, report);
    }

    fn cut(&mut self, cx: &PathCx<'_>, _: &Event, report: &mut Report<'_>) {
        self.moves(cx, report);
    }
}

impl UnitsChanged {
    fn moves(&mut self, cx: &PathCx<'_>, report: &mut Report<'_>) {
        if cx.has_effect(Effect::goes_to_machine_place) {
            return;
        }
        self.has_moved = true;
        let fact = Fact::Mode(Role::Units);
        if self.is_told || cx.depth() != 1 {
            return;
        }
        let Some(now) = cx.state().units(cx.model) else { return };
        let set = cx.definitions().set_by(fact);
        let (before, by) = (self.main.replace(now), std::mem::replace(&mut self.main_set, set));
        // What the control started with, the program has not chosen.
        let Some(old) = before.filter(|old| *old != now && by.is_some() && by != set) else { return };
        // Chosen by the main program itself, it was told there.
        if set.is_none() || set == self.own || cx.is_called_only() {
            return;
        }
        self.is_told = true;
        let Some(code) = cx.state().mode(Role::Units).only() else { return };
        let name = cx.name_of(code);
        let finding = cx
            .finding(&META, cx.range(), format!("a subprogram has left {} on (`{name}`)", words(now)))
            .label(format!("the moves before the call count {}", words(old)))
            .help("choose the units again after the call, or write the subprogram in those of its caller");
        report.add(cx.resting_on(finding, fact, &format!("`{name}`")));
    }
}

fn words(units: Units) -> &'static str {
    match units {
        Units::Inch => "inches",
        Units::Mm => "millimetres",
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
    fn a_subprogram_leaves_other_units_on() {
        let program = |after: &str, end: &str| {
            format!("O1\nG21 G90 G54\nG0 X0. Y0.\nM98 P100\n{after}X10.\nM30\nO100\nG20\nG0 X1.\n{end}M99\n")
        };
        check_rule(
            &RULE,
            "fanuc-mill",
            &program("", ""),
            &expect![[r#"
            5 | X10.
              | ^^^^ warning[units-changed] a subprogram has left inches on (`G20`)
        "#]],
        );
        check_rule(&RULE, "fanuc-mill", &program("G21\n", ""), &expect![[""]]);
        check_rule(&RULE, "fanuc-mill", &program("", "G21\n"), &expect![[""]]);
    }

    #[test]
    fn a_subprogram_chooses_the_units_for_all() {
        for first in ["G53 G0 Z0.", "G91 G28 Z0", "G0 Z50."] {
            check_rule(
                &RULE,
                "haas-mill",
                &format!(
                    "O1\n{first}\nM98 P8000\nT1 M6\nG54 G0 X10. Y10.\nM30\nO8000\nG21 G90 G40 G80 G49\nM99\n"
                ),
                &expect![[""]],
            );
        }
        check_rule(&RULE, "haas-mill", "G20 G53 G0 Z0.\nG21\nG0 X10.\nM30\n", &expect![[""]]);
    }

    #[test]
    fn before_the_first_move_nothing_has_counted() {
        check_rule(&RULE, "linuxcnc", "G20\nG21\nG0 X1\nM2\n", &expect![[""]]);
    }
}
