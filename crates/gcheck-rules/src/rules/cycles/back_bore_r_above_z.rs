//! A back bore that cuts downward.

use std::collections::BTreeSet;

use gcheck_controls::Effect;
use gcheck_engine::{At, Event, Fact, Role};
use gcheck_geometry::Mm;

use crate::declare::declare_rule;
use crate::facts::cycles::cycle_range;
use crate::{PathCx, PathRule, Report, Run, Uses, Watch, limit};
use crate::{Remembers, remembers};

declare_rule! {
    /// The retract plane (`R`) of a back bore lies above the level that it cuts to (`Z`).
    ///
    /// ## Why it matters
    /// A back bore goes through the hole to `R`, past the bottom of the part, and cuts from there up to `Z`. With `R` above
    /// `Z` it cuts downward from inside the part, and the bar comes out with its edge in the work.
    ///
    /// ## Reported
    /// ```nc,reported,haas-mill
    /// G20 G90 G54 G0 X0. Y0. Z.1 S900 M3
    /// G77 Z-1.6 R-.5 Q.1 F10.
    /// G80
    /// M30
    /// ```
    /// ## Not reported
    /// ```nc,quiet,haas-mill
    /// G20 G90 G54 G0 X0. Y0. Z.1 S900 M3
    /// G77 Z-.5 R-1.6 Q.1 F10.
    /// G80
    /// M30
    /// ```
    rule "back-bore-r-above-z" in "cycles" {
        summary: "back bore whose R lies above Z",
        severity: Warning,
        tier: Path,
        since: "0.1.0",
        run: Run::Path { watch: Watch::CUTS, make: || Box::new(BackBoreRAboveZ::default()) },
    }
}

#[derive(Default, Clone, PartialEq)]
struct BackBoreRAboveZ {
    /// Blocks that began the reported cycles.
    told: BTreeSet<Option<At>>,
}

remembers!(BackBoreRAboveZ: told);

impl PathRule for BackBoreRAboveZ {
    fn memory(&mut self) -> Remembers<'_> {
        Remembers::All(self)
    }

    fn concerns(&self, program: &Uses<'_>) -> bool {
        program.may(|effect| effect == Effect::CycleBackBore)
    }

    fn cut(&mut self, cx: &PathCx<'_>, event: &Event, report: &mut Report<'_>) {
        let Event::Travel(travel) = event else { return };
        let Some(ix) = cx.state().active_cycle(cx.model).filter(|ix| ix.is_some()) else { return };
        let Some(code) = cx.control().code_at(ix) else { return };
        // Where the cycle names the level of its cut by another word, `R` is above the hole as in any cycle.
        let cuts_to_z = code.effect() == Effect::CycleBackBore && !cx.model.semantics().cycles.rise_to_r;
        if !travel.expanded || !cuts_to_z || cx.model.drills_across(ix) {
            return;
        }
        let words = cx.state().cycle();
        let above = words.r - words.z;
        // False for unknown numbers.
        let is_above = above > 1e-4;
        if !is_above || !self.told.insert(cx.definitions().set_by(Fact::Mode(Role::Cycle))) {
            return;
        }
        let name = code.number();
        report.add(
            cx.finding(&META, cycle_range(cx), format!("back bore with `R` above `Z` (`{name}`)"))
                .label(format!("`R` is {} above `Z`: the cut goes downward", cx.shown(Mm(above))))
                .note(format!("`{name}` cuts from `R`, past the bottom of the part, up to `Z`  [{}]", code.entry().source))
                .help("give `R` the level past the bottom of the part, and `Z` the level that the cut goes up to")
                .at_most(limit(code.entry().confidence)),
        );
    }
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
            "G20 G90 G54 G0 X0. Y0. Z.1 S900 M3\nG77 Z-1.6 R-.5 Q.1 F10.\nX1.\nG80\nM30\n",
            &expect![[r#"
                2 | G77 Z-1.6 R-.5 Q.1 F10.
                  | ^^^ warning[back-bore-r-above-z] back bore with `R` above `Z` (`G77`)
            "#]],
        );
    }

    #[test]
    fn where_another_word_names_the_cut_r_is_above_the_hole() {
        check_rule(
            &RULE,
            "linuxcnc",
            "G21 G90 S900 M3 F100\nG0 X0 Y0 Z3\nG87 X1 Y1 Z-2.5 R1 I0.2 J0.3 K-1\nG80\nM2\n",
            &expect![[""]],
        );
    }

    #[test]
    fn what_it_says() {
        let text = "G20 G90 G54 G0 X0. Y0. Z.1 S900 M3\nG77 Z-1.6 R-.5 Q.1 F10.\nG80\nM30\n";
        let found = findings(&only(&RULE), "haas-mill", text, &World::default());
        expect![[r#"
            back bore with `R` above `Z` (`G77`)
              here: `R` is 1.1 in above `Z`: the cut goes downward
              note: `G77` cuts from `R`, past the bottom of the part, up to `Z`  [Haas online manual, g77-back-bore; Haas 96-8000 June 1999 (easymanua.ls page 188); HM17 p.290]
              help: give `R` the level past the bottom of the part, and `Z` the level that the cut goes up to
        "#]].assert_eq(&words(&found[0]));
    }
}
