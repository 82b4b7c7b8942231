//! A fine or back bore that brings the tool off the wall by nothing.

use std::collections::BTreeSet;

use gcheck_controls::{Effect, LetterSet};
use gcheck_engine::{At, Event, Fact, Role};

use crate::declare::declare_rule;
use crate::facts::cycles::{cycle_range, is_cycle};
use crate::{PathCx, PathRule, Report, Run, Uses, Watch, limit};
use crate::{Remembers, remembers};

declare_rule! {
    /// A fine or back bore has neither `Q` nor `I` and `J`, and the control takes that for no shift.
    ///
    /// ## Why it matters
    /// The bar stops at an angle so that its edge can come off the wall. Without a shift the edge stays on it: a fine bore
    /// is scratched from end to end on the way out, and a back bore drives its edge into the hole on the way in.
    ///
    /// ## Reported
    /// ```nc,reported,haas-mill
    /// G20 G90 G54 G0 X0. Y0. Z1. S900 M3
    /// G76 Z-.6 R.1 F5.
    /// G80
    /// M30
    /// ```
    /// ## Not reported
    /// ```nc,quiet,haas-mill
    /// G20 G90 G54 G0 X0. Y0. Z1. S900 M3
    /// G76 Z-.6 R.1 Q.01 F5.
    /// X1.
    /// G80
    /// M30
    /// ```
    rule "bore-without-shift" in "cycles" {
        summary: "fine or back bore without a shift off the wall",
        severity: Warning,
        tier: Path,
        since: "0.1.0",
        run: Run::Path { watch: Watch::CUTS, make: || Box::new(BoreWithoutShift::default()) },
    }
}

#[derive(Default, Clone, PartialEq)]
struct BoreWithoutShift {
    /// Blocks that began the reported cycles.
    told: BTreeSet<Option<At>>,
}

remembers!(BoreWithoutShift: told);

impl PathRule for BoreWithoutShift {
    fn memory(&mut self) -> Remembers<'_> {
        Remembers::All(self)
    }

    fn concerns(&self, program: &Uses<'_>) -> bool {
        program.may(is_bore)
    }

    fn cut(&mut self, cx: &PathCx<'_>, event: &Event, report: &mut Report<'_>) {
        let Event::Travel(travel) = event else { return };
        let rules = &cx.model.semantics().cycles;
        let active = cx
            .state()
            .active_cycle(cx.model)
            .filter(|ix| ix.is_some())
            .and_then(|ix| cx.control().code_at(ix));
        let Some(code) = active.filter(|code| is_bore(code.effect())) else { return };
        // Elsewhere the cycle is refused, which is another finding.
        if !travel.expanded || !rules.shift_optional || !cx.state().cycle().lacks(LetterSet::of("QIJ")) {
            return;
        }
        if !self.told.insert(cx.definitions().set_by(Fact::Mode(Role::Cycle))) {
            return;
        }
        let name = code.number();
        let is_back = code.effect() == Effect::CycleBackBore;
        let (bore, what) = if is_back {
            ("back bore", "the edge goes through the hole where it cuts")
        } else {
            ("fine bore", "the edge comes out along the wall that it has cut")
        };
        let by = rules
            .shift_setting
            .as_ref()
            .map_or_else(String::new, |number| format!(", in the direction of Setting {number}"));
        report.add(
            cx.finding(&META, cycle_range(cx), format!("{bore} without a shift off the wall (`{name}`)"))
                .label(what)
                .note(format!("without `Q`, `I` and `J` the tool does not shift  [{}]", code.entry().source))
                .help(format!("give the shift as `Q`{by}, or as `I` and `J`"))
                .at_most(limit(code.entry().confidence)),
        );
    }
}

fn is_bore(effect: Effect) -> bool {
    is_cycle(effect) && effect.shifts_boring_bar()
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::{World, check_rule, findings, only, words};

    #[test]
    fn it_is_told_once_for_a_series() {
        check_rule(
            &RULE,
            "haas-mill",
            "G20 G90 G54 G0 X0. Y0. Z1. S900 M3\nG76 Z-.6 R.1 F5.\nX1.\nX2.\nG80\nG77 Z-.5 R-1.6 F5.\nG80\nM30\n",
            &expect![[r#"
                2 | G76 Z-.6 R.1 F5.
                  | ^^^ warning[bore-without-shift] fine bore without a shift off the wall (`G76`)
                6 | G77 Z-.5 R-1.6 F5.
                  | ^^^ warning[bore-without-shift] back bore without a shift off the wall (`G77`)
            "#]],
        );
    }

    #[test]
    fn a_shift_of_the_same_series_stays() {
        check_rule(
            &RULE,
            "haas-mill",
            "G20 G90 G54 G0 X0. Y0. Z1. S900 M3\nG76 Z-.6 R.1 I.02 F5.\nX1.\nG80\nG81 Z-.5 R.1\nG80\nM30\n",
            &expect![[""]],
        );
    }

    #[test]
    fn what_it_says() {
        let text = "G20 G90 G54 G0 X0. Y0. Z1. S900 M3\nG76 Z-.6 R.1 F5.\nG80\nM30\n";
        let found = findings(&only(&RULE), "haas-mill", text, &World::default());
        expect![[r#"
            fine bore without a shift off the wall (`G76`)
              here: the edge comes out along the wall that it has cut
              note: without `Q`, `I` and `J` the tool does not shift  [HM17 p.289; Haas 96-8000 June 1999 (easymanua.ls page 182); Haas online manual, g77-back-bore; Haas 96-8000 June 1999 (easymanua.ls page 188)]
              help: give the shift as `Q`, in the direction of Setting 27, or as `I` and `J`
        "#]].assert_eq(&words(&found[0]));
    }
}
